/* A proof that nothing holds the bodies of a problem in global form: there is no equilibrium,
 * whatever the reactions are. */
#include "lcp/friction/internal.h"
#include "lcp/proof/absent.h"
#include "lcp/proof/bounds.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

/* Degrees of freedom at most, of dense eigenvectors; steps of the search at most, operations
 * at most, and the share of friction by which its cones are wider than the given ones. */
enum { MOST_FLOATING = 400, STEPS = 5000 };
static const double OPERATIONS = 1e9, WIDER = 1e-6;

/* K v = H r + f.  A motion z that costs nothing, z'K = 0, that no contact resists, (H'z)_c in K*
 * and so z'H r >= 0 for every r in K, and that the forces drive, z'f > 0, has no equilibrium:
 * 0 = z'K v = z'H r + z'f > 0.  With the columns of Z a basis of such z without the contacts,
 * A = Z'H and b = Z'f, it is z = Z (A x + b) at the least |A x + b|^2 over x in K, if that is
 * not 0 (the same theorem as in infeasible.c). */
typedef struct {
    const rb_friction_problem *p;
    int n, m, nullity;
    double *Z;                  /* n x nullity */
    double *A, *b;              /* nullity x m, nullity */
    double *x, *ahead, *before; /* m each: iterate, extrapolated, last one */
    double *d, *gradient;       /* nullity, m: A x + b, A'd */
    double *z, *rounded;        /* n each */
    double *first, *second;     /* n each: the terms of a sum */
    rb_arena memory;
} floating;

/* The motions that cost nothing, by the eigenvectors of S K S with a unit diagonal. */
static rb_status find_free_motions(floating *s)
{
    const int n = s->n;
    const rb_sparse *K = &s->p->K;
    double *k = rb_arena_doubles(&s->memory, (size_t)n, (size_t)n),
           *scale = rb_arena_doubles(&s->memory, (size_t)n, 2), *value = scale + n;
    if (s->memory.failed)
        return RB_ENOMEM;
    for (int j = 0; j < n; j++) {
        const double own = rb_sparse_diagonal(K, j);
        scale[j] = own > 0.0 ? 1.0 / sqrt(own) : 1.0;
    }
    for (int j = 0; j < n; j++)
        for (int l = K->p[j]; l < K->p[j + 1]; l++)
            k[K->i[l] + j * n] += K->x[l] * scale[K->i[l]] * scale[j];
    if (LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'L', n, k, n, value) != 0)
        return RB_ENOMEM;
    while (s->nullity < n && value[s->nullity] <= 1e-11 * value[n - 1])
        s->nullity++;
    s->Z = k;
    for (int j = 0; j < s->nullity; j++)
        for (int i = 0; i < n; i++)
            k[i + j * n] *= scale[i];
    return RB_OK;
}

/* A and b, each contact in the unit in which its largest entry is 1. */
static rb_status project_on_free_motions(floating *s)
{
    const int d = s->p->dimension, k = s->nullity;
    const rb_sparse *H = &s->p->H;
    s->A = rb_arena_doubles(&s->memory, (size_t)k, (size_t)s->m + 2);
    s->b = s->A + (size_t)k * (size_t)s->m;
    s->d = s->b + k;
    s->x = rb_arena_doubles(&s->memory, (size_t)s->m, 4);
    s->ahead = s->x + s->m;
    s->before = s->ahead + s->m;
    s->gradient = s->before + s->m;
    if (s->memory.failed)
        return RB_ENOMEM;
    for (int a = 0; a < k; a++) {
        const double *z = s->Z + (size_t)a * (size_t)s->n;
        for (int i = 0; i < s->n; i++)
            s->b[a] += z[i] * s->p->f[i];
        for (int j = 0; j < s->m; j++)
            for (int l = H->p[j]; l < H->p[j + 1]; l++)
                s->A[a + j * k] += z[H->i[l]] * H->x[l];
    }
    for (int c = 0; c < s->p->contacts; c++) {
        double *columns = s->A + c * d * k;
        const double most = rb_norm_inf((size_t)(d * k), columns);
        for (int i = 0; most > 0.0 && i < d * k; i++)
            columns[i] /= most;
    }
    return RB_OK;
}

/* d = A x + b, and the gradient A'd. */
static void set_gradient(floating *s, const double *x)
{
    const int k = s->nullity;
    memcpy(s->d, s->b, (size_t)k * sizeof *s->d);
    for (int j = 0; j < s->m; j++)
        for (int a = 0; x && x[j] != 0.0 && a < k; a++)
            s->d[a] += s->A[a + j * k] * x[j];
    for (int j = 0; j < s->m; j++) {
        s->gradient[j] = 0.0;
        for (int a = 0; a < k; a++)
            s->gradient[j] += s->A[a + j * k] * s->d[a];
    }
}

/* z = Z d at the least |d|, by projected gradients.  |A|_F^2 is not below |A|^2. */
static void search_motion(floating *s)
{
    const int k = s->nullity;
    const double work = 4.0 * k * s->m, size = rb_friction_norm((size_t)(k * s->m), s->A);
    rb_friction_descent descent = {.p = s->p,
                                   .wider = 1.0 + WIDER,
                                   .length = size > 0.0 ? 1.0 / (size * size) : 0.0,
                                   .x = s->x,
                                   .ahead = s->ahead,
                                   .before = s->before,
                                   .gradient = s->gradient,
                                   .t = 1.0,
                                   .last = INFINITY};
    for (int step = 0; step < STEPS && step * work < OPERATIONS; step++) {
        set_gradient(s, s->ahead);
        if (rb_friction_descend(&descent, rb_friction_norm((size_t)k, s->d)) <= 1e-15)
            break;
    }
    set_gradient(s, s->x);
    for (int i = 0; i < s->n; i++) {
        s->z[i] = 0.0;
        for (int a = 0; a < k; a++)
            s->z[i] += s->Z[i + (size_t)a * (size_t)s->n] * s->d[a];
    }
}

/* The exact sign of z' and a column; *value, *size: the sum and that of the moduli. */
static int sign_of(floating *s, const rb_sparse *of, int column, const double *z, double *value,
                   double *size)
{
    int count = 0;
    *value = *size = 0.0;
    for (int l = of->p[column]; l < of->p[column + 1]; l++)
        if (z[of->i[l]] != 0.0) {
            s->first[count] = of->x[l];
            s->second[count++] = z[of->i[l]];
            *value += of->x[l] * z[of->i[l]];
            *size += fabs(of->x[l] * z[of->i[l]]);
        }
    return rb_exact_sign((size_t)count, s->first, s->second);
}

/* 1: z proves it of the numbers as they are given.  Sums that must be zero are so exactly, others
 * count where they are beyond their rounding. */
static int proves(floating *s, const double *z)
{
    const int d = s->p->dimension;
    double value, size;
    for (int j = 0; j < s->n; j++)
        if (sign_of(s, &s->p->K, j, z, &value, &size) != 0)
            return 0;
    for (int c = 0; c < s->p->contacts; c++) {
        double h[3] = {0.0}, sum = 0.0;
        int by_sign = 1; /* along the normal alone, or not at all */
        for (int a = 0; a < d; a++) {
            const int sign = sign_of(s, &s->p->H, c * d + a, z, &h[a], &size);
            sum += size;
            by_sign &= sign == 0 || (a == 0 ? sign == 1 : s->p->mu[c] == 0.0);
        }
        const double rounding = proof_error((size_t)s->n + 16, (1.0 + s->p->mu[c]) * sum);
        if (!by_sign && !(h[0] - s->p->mu[c] * rb_friction_tangential(d, h) > rounding))
            return 0;
    }
    return rb_exact_sign((size_t)s->n, z, s->p->f) == 1;
}

/* Of z as the search has left it but for what is next to nothing, and of its multiples that
 * are nearly whole numbers. */
static int proves_nearly(floating *s)
{
    for (int by = 0; by <= PROOF_MULTIPLES; by++) {
        if (!rb_proof_nearly_whole((size_t)s->n, s->z, by, s->rounded))
            continue;
        for (int i = 0; !by && i < s->n; i++)
            if (fabs(s->rounded[i]) < 1e-9)
                s->rounded[i] = 0.0;
        if (proves(s, s->rounded))
            return 1;
    }
    return 0;
}

rb_status rb_friction_floats(const rb_friction_problem *global, int *floats)
{
    floating s = {.p = global, .n = global->dofs, .m = global->dimension * global->contacts};
    *floats = 0;
    if (global->form != RB_FRICTION_GLOBAL || global->lengths || s.n < 1 || s.n > MOST_FLOATING)
        return RB_OK;
    s.z = rb_arena_doubles(&s.memory, (size_t)s.n, 4);
    s.rounded = s.z + s.n;
    s.first = s.rounded + s.n;
    s.second = s.first + s.n;
    rb_status st = s.memory.failed ? RB_ENOMEM : find_free_motions(&s);
    if (st == RB_OK && s.nullity > 0) {
        st = project_on_free_motions(&s);
        if (st == RB_OK) {
            search_motion(&s);
            *floats = proves_nearly(&s);
        }
    }
    rb_arena_free(&s.memory);
    return st;
}
