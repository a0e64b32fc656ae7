/* The reduced problem without a matrix: GMRES on products of the flexibility.  On equal
 * elements the inverse of an endless line preconditions it: about ten products for any
 * number of elements. */
#include "rolling/reduced.h"

#include <cblas.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BASIS = 100, CYCLES = 6, BORDERS = 2 };
/* 2-norm of the scaled residual at which a solve ends. */
static const double TOLERANCE = 2e-11;

/* Kept from solve to solve: fresh memory costs more than the arithmetic. */
struct rb_rolling_krylov {
    rb_bem_circulant *inverse;
    double *basis[BASIS + 1]; /* 2n + 2 each, on demand */
    double *work;             /* 2n + 2 */
    double *line;             /* n */
};

void rb_rolling_krylov_free(struct rb_rolling_krylov *k)
{
    if (!k)
        return;
    rb_bem_circulant_free(k->inverse);
    for (int j = 0; j <= BASIS; j++)
        free(k->basis[j]);
    free(k->work);
    free(k->line);
    free(k);
}

rb_status rb_rolling_krylov_create(const rb_rolling_problem *p,
                                   struct rb_rolling_krylov **krylov)
{
    const size_t n = (size_t)p->n;
    struct rb_rolling_krylov *k = calloc(1, sizeof *k);

    *krylov = k;
    if (!k)
        return RB_ENOMEM;
    k->work = rb_alloc(2 * n + 2, 1);
    k->line = rb_alloc(n, 1);
    if (!k->work || !k->line)
        return RB_ENOMEM;
    return rb_bem_circulant_create(&p->f, p->stencil, &k->inverse);
}

/* ---- The system  [A B; C 0]: tractions, and delta and xi at its border --------------
 */

typedef struct {
    const rb_rolling_problem *p;
    const rb_rolling_reduced *r;
    const int *zone;
    int inner;                       /* tractions; the border comes after them */
    int borders;                     /* 0, 1 or 2 */
    double *image[BORDERS];          /* P^-1 B; owned */
    double schur[BORDERS * BORDERS]; /* -C P^-1 B */
} system_of;

/* Tractions of the unknowns into the problem's room for products. */
static void scatter(const system_of *s, const double *x)
{
    const rb_rolling_problem *p = s->p;
    const rb_rolling_reduced *r = s->r;
    const double mu = rb_rolling_reduced_mu(p, r);
    double *r_N = p->product, *r_T = r_N + p->n;

    memset(r_N, 0, 2 * (size_t)p->n * sizeof *r_N);
    for (int k = 0; k < r->contacts; k++) {
        const int i = r->contact[k];
        r_N[i] = p->stress * x[k];
        r_T[i] = rb_rolling_slope(s->zone[i]) * mu * r_N[i];
    }
    for (int k = 0; k < r->sticks; k++)
        r_T[r->stick[k]] = p->stress * x[r->contacts + k];
}

/* C x for the tractions that were scattered last. */
static void border_rows(const system_of *s, double *y)
{
    const rb_rolling_problem *p = s->p;
    const rb_rolling_reduced *r = s->r;
    const double *r_N = p->product, *r_T = r_N + p->n;

    if (r->load)
        *y++ = (cblas_ddot(p->n, p->load_N, 1, r_N, 1) +
                cblas_ddot(p->n, p->load_T, 1, r_T, 1)) /
               p->load;
    if (r->force)
        *y = (cblas_ddot(p->n, r->control_N, 1, r_N, 1) +
              cblas_ddot(p->n, r->control_T, 1, r_T, 1)) /
             r->force_scale;
}

/* Column k of B: delta opens no gap, xi makes slip. */
static void border_column(const system_of *s, int k, double *column)
{
    const rb_rolling_reduced *r = s->r;

    memset(column, 0, (size_t)r->size * sizeof *column);
    if (k == 0 && r->load)
        for (int i = 0; i < r->contacts; i++)
            column[i] = -1.0;
    else
        for (int i = 0; i < r->sticks; i++)
            column[r->contacts + i] = s->p->e_T[r->stick[i]] / s->p->e_T[0];
}

static void multiply(const system_of *s, const double *x, double *y)
{
    const rb_rolling_problem *p = s->p;
    const rb_rolling_reduced *r = s->r;
    double *w_N = p->product + 2 * (size_t)p->n, *w_T = w_N + p->n + 1;
    const double delta = r->load ? x[s->inner] : 0.0;
    const double xi = r->force ? x[s->inner + r->load] : 0.0;

    double *slip = p->krylov->line;

    scatter(s, x);
    rb_bem_flexibility_apply(&p->f, p->product, w_N);
    for (int k = 0; k < r->contacts; k++)
        *y++ = w_N[r->contact[k]] / p->gap_length - delta;
    memset(slip, 0, (size_t)p->n * sizeof *slip);
    rb_rolling_add_slip(p, p->product, w_T, slip);
    for (int k = 0; k < r->sticks; k++) {
        const int i = r->stick[k];
        *y++ = slip[i] / p->slip_length + xi * p->e_T[i] / p->e_T[0];
    }
    border_rows(s, y);
}

/* ---- The preconditioner  P = [A~ B; C 0] --------------------------------------------
 */

/* One group of tractions: `count` elements with numbers `at`; what slipping elements owe
 * to the pressure is left out of A~. */
static void precondition_group(const system_of *s, int steady, int count, const int *at,
                               double length, const double *b, double *x)
{
    const struct rb_rolling_krylov *krylov = s->p->krylov;
    double *line = krylov->line;

    if (count == 0)
        return;
    memset(line, 0, (size_t)s->p->n * sizeof *line);
    for (int k = 0; k < count; k++)
        line[at[k]] = b[k] * length / s->p->stress;
    if (steady)
        rb_bem_circulant_apply_difference(krylov->inverse, line, line);
    else
        rb_bem_circulant_apply(krylov->inverse, line, line);
    for (int k = 0; k < count; k++)
        x[k] = line[at[k]];
}

static void precondition_tractions(const system_of *s, const double *b, double *x)
{
    const rb_rolling_problem *p = s->p;
    const rb_rolling_reduced *r = s->r;
    const int c = r->contacts;

    precondition_group(s, 0, c, r->contact, p->gap_length, b, x);
    precondition_group(s, p->steady, r->sticks, r->stick, p->slip_length, b + c, x + c);
}

static void solve_border(const system_of *s, const double *g, double *z)
{
    const double *S = s->schur;

    if (s->borders == 1) {
        z[0] = g[0] / S[0];
        return;
    }
    const double det = S[0] * S[3] - S[1] * S[2];
    z[0] = (S[3] * g[0] - S[2] * g[1]) / det;
    z[1] = (S[0] * g[1] - S[1] * g[0]) / det;
}

static void precondition(const system_of *s, const double *b, double *x)
{
    double g[BORDERS], z[BORDERS];

    precondition_tractions(s, b, x);
    if (s->borders == 0)
        return;
    scatter(s, x);
    border_rows(s, g);
    for (int l = 0; l < s->borders; l++)
        g[l] = b[s->inner + l] - g[l];
    solve_border(s, g, z);
    for (int l = 0; l < s->borders; l++) {
        cblas_daxpy(s->inner, -z[l], s->image[l], 1, x, 1);
        x[s->inner + l] = z[l];
    }
}

static void system_free(system_of *s)
{
    for (int l = 0; l < BORDERS; l++)
        free(s->image[l]);
}

static rb_status system_make(const rb_rolling_problem *p, const int *zone,
                             const rb_rolling_reduced *r, system_of *s)
{
    double *column = p->krylov->work;

    *s = (system_of){.p = p,
                     .r = r,
                     .zone = zone,
                     .inner = r->contacts + r->sticks,
                     .borders = r->load + r->force};
    for (int l = 0; l < s->borders; l++) {
        s->image[l] = rb_alloc((size_t)r->size, 1);
        if (!s->image[l])
            return RB_ENOMEM;
        border_column(s, l, column);
        precondition_tractions(s, column, s->image[l]);
        scatter(s, s->image[l]);
        border_rows(s, s->schur + BORDERS * l);
    }
    for (int k = 0; k < BORDERS * BORDERS; k++)
        s->schur[k] = -s->schur[k];
    return RB_OK;
}

/* ---- GMRES (Saad and Schultz), preconditioned from the right ------------------------
 */

typedef struct {
    double H[BASIS][BASIS + 1]; /* columns of the Hessenberg matrix, rotated */
    double c[BASIS], s[BASIS];  /* rotations */
    double g[BASIS + 1];
} least_squares;

static double *basis_vector(const rb_rolling_problem *p, int j)
{
    double **v = &p->krylov->basis[j];
    if (!*v)
        *v = malloc((2 * (size_t)p->n + 2) * sizeof **v);
    return *v;
}

/* Column j: orthogonalised, its length in the last row; 0 where the space is exhausted.
 */
static int orthogonalise(const rb_rolling_problem *p, int size, int j, double *column)
{
    double *const *v = p->krylov->basis, *last = v[j + 1];

    for (int i = 0; i <= j; i++) {
        column[i] = cblas_ddot(size, last, 1, v[i], 1);
        cblas_daxpy(size, -column[i], v[i], 1, last, 1);
    }
    column[j + 1] = cblas_dnrm2(size, last, 1);
    if (!(column[j + 1] > 0.0))
        return 0;
    cblas_dscal(size, 1.0 / column[j + 1], last, 1);
    return 1;
}

/* Rotates column j into upper triangular form; returns the new residual. */
static double rotate(least_squares *q, int j)
{
    double *column = q->H[j];

    for (int i = 0; i < j; i++) {
        const double a = column[i], b = column[i + 1];
        column[i] = q->c[i] * a + q->s[i] * b;
        column[i + 1] = -q->s[i] * a + q->c[i] * b;
    }
    const double length = hypot(column[j], column[j + 1]);
    q->c[j] = column[j] / length;
    q->s[j] = column[j + 1] / length;
    column[j] = length;
    q->g[j + 1] = -q->s[j] * q->g[j];
    q->g[j] *= q->c[j];
    return fabs(q->g[j + 1]);
}

/* x += P^-1 V y after `count` steps; the vector behind the basis is room. */
static void add_correction(const system_of *s, least_squares *q, int count, double *x)
{
    const struct rb_rolling_krylov *k = s->p->krylov;
    double *sum = k->basis[count];

    for (int i = count - 1; i >= 0; i--) {
        for (int l = i + 1; l < count; l++)
            q->g[i] -= q->H[l][i] * q->g[l];
        q->g[i] /= q->H[i][i];
    }
    memset(sum, 0, (size_t)s->r->size * sizeof *sum);
    for (int i = 0; i < count; i++)
        cblas_daxpy(s->r->size, q->g[i], k->basis[i], 1, sum, 1);
    precondition(s, sum, k->work);
    cblas_daxpy(s->r->size, 1.0, k->work, 1, x, 1);
}

/* v_0 = b - A x, normalised; returns its length. */
static double begin_cycle(const system_of *s, const double *b, const double *x, double *v)
{
    const int size = s->r->size;

    multiply(s, x, v);
    for (int i = 0; i < size; i++)
        v[i] = b[i] - v[i];
    const double length = cblas_dnrm2(size, v, 1);
    if (length > 0.0)
        cblas_dscal(size, 1.0 / length, v, 1);
    return length;
}

/* One cycle from x; *residual: of x before it. */
static rb_status cycle(const system_of *s, const double *b, double tolerance,
                       least_squares *q, double *x, double *residual)
{
    const rb_rolling_problem *p = s->p;
    double *v = basis_vector(p, 0);
    int count = 0;

    if (!v)
        return RB_ENOMEM;
    q->g[0] = *residual = begin_cycle(s, b, x, v);
    for (double rest = *residual; count < BASIS && rest > tolerance; count++) {
        double *next = basis_vector(p, count + 1);
        if (!next)
            return RB_ENOMEM;
        precondition(s, p->krylov->basis[count], p->krylov->work);
        multiply(s, p->krylov->work, next);
        const int goes_on = orthogonalise(p, s->r->size, count, q->H[count]);
        rest = goes_on ? rotate(q, count) : (rotate(q, count), 0.0);
    }
    if (count > 0)
        add_correction(s, q, count, x);
    return RB_OK;
}

/* Cycles until the true residual is small, or no longer falls: then it is rounding. */
static rb_status gmres(const system_of *s, const double *b, double *x)
{
    const double rounding = 2.0 * DBL_EPSILON * cblas_dnrm2(s->r->size, b, 1);
    const double tolerance = fmax(TOLERANCE, rounding);
    least_squares *q = malloc(sizeof *q);
    rb_status status = q ? RB_OK : RB_ENOMEM;
    double before = INFINITY, residual = INFINITY;

    for (int k = 0; k < CYCLES && status == RB_OK; k++) {
        status = cycle(s, b, tolerance, q, x, &residual);
        if (!(residual > tolerance) || residual > 0.1 * before)
            break;
        before = residual;
    }
    free(q);
    return status;
}

rb_status rb_rolling_reduced_krylov(const rb_rolling_problem *p, const int *zone,
                                    rb_rolling_reduced *r)
{
    system_of s;
    rb_status status = RB_OK;

    if (r->size == 0)
        return RB_OK;
    status = system_make(p, zone, r, &s);
    if (status == RB_OK)
        status = gmres(&s, r->x, r->start);
    if (status == RB_OK)
        memcpy(r->x, r->start, (size_t)r->size * sizeof *r->x);
    system_free(&s);
    return status;
}
