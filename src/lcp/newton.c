/* Block principal pivoting (Judice and Pires, Computers and Operations Research 21,
 * 1994): Newton's method on min(z, M z + q) = 0, guarded so that it ends for every
 * P-matrix. */
#include "lcp/lemke.h"
#include "lcp/scale.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A component counts as negative below this part of the largest. */
static const double NEGATIVE = 1e-13;

/* Steps that exchange all negative components without there being fewer of them. */
enum { CHANCES = 10 };

typedef struct {
    rb_lcp_mixed_problem p;
    double *z, *w, *rhs, *x; /* n each; z is the caller's */
    int *number;             /* n: of i among the basic z, or -1 */
    int *wrong, m;           /* n: the negative components, and how many */
    rb_sparse A;             /* M of the basic z; room for all of M */
    rb_lcp_info *info;
} newton;

/* A = M_FF for the basic z, F. */
static void basic_part(newton *s)
{
    const rb_sparse *M = s->p.M;
    rb_sparse *A = &s->A;
    int size = 0, nz = 0;
    for (int j = 0; j < M->cols; j++)
        if (s->number[j] >= 0)
            s->number[j] = size++;
    for (int j = 0; j < M->cols; j++) {
        if (s->number[j] < 0)
            continue;
        A->p[s->number[j]] = nz;
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            if (s->number[M->i[k]] >= 0) {
                A->i[nz] = s->number[M->i[k]];
                A->x[nz++] = M->x[k];
            }
    }
    A->p[size] = nz;
    A->rows = A->cols = size;
}

/* M_FF z_F = -q_F, the other z are zero. */
static rb_status solve_basic(newton *s)
{
    const int n = s->p.M->rows;
    rb_sparse_lu *lu = NULL;
    basic_part(s);
    for (int i = 0; i < n; i++)
        if (s->number[i] >= 0)
            s->rhs[s->number[i]] = -s->p.q[i];
    rb_status status = RB_OK;
    if (s->A.rows > 0)
        status = rb_sparse_lu_create(&s->A, &lu);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_factor(lu, &s->A, NULL);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_solve(lu, s->rhs, s->x);
    rb_sparse_lu_free(lu);
    for (int i = 0; status == RB_OK && i < n; i++)
        s->z[i] = s->number[i] >= 0 ? s->x[s->number[i]] : 0.0;
    if (status == RB_SINGULAR)
        return rb_fail(&s->info->msg, status,
                       "lcp: newton: a principal submatrix of order %d is singular after "
                       "%d steps",
                       s->A.rows, s->info->iters);
    return status == RB_OK ? status
                           : rb_fail(&s->info->msg, RB_ENOMEM,
                                     "lcp: newton: out of memory for a factorisation");
}

/* s->wrong: where the basic z or the basic w is negative. */
static void find_negative(newton *s)
{
    const int n = s->p.M->rows;
    rb_lcp_residual_mixed(&s->p, s->z, s->w);
    const double small_z = NEGATIVE * rb_norm_inf((size_t)n, s->z);
    const double small_w =
        NEGATIVE * fmax(rb_norm_inf((size_t)n, s->w), rb_norm_inf((size_t)n, s->p.q));
    s->m = 0;
    for (int i = 0; i < n; i++)
        if (s->number[i] >= 0 ? s->z[i] < -small_z : s->w[i] < -small_w)
            s->wrong[s->m++] = i;
}

/* Exchanges z_i and w_i of the negative components from the first on. */
static void exchange(newton *s, int first)
{
    for (int k = first; k < s->m; k++)
        s->number[s->wrong[k]] = s->number[s->wrong[k]] >= 0 ? -1 : 0;
}

/* All negative components are exchanged at once, which is a Newton step, as long as their
 * number keeps falling or has not stalled too often; then only the last one, which ends
 * for P-matrices (Murty), until there are fewer of them than ever before. */
static rb_status iterate(newton *s, int max_iters)
{
    int fewest = s->p.M->rows + 1, chances = CHANCES;
    while (s->info->iters < max_iters) {
        const rb_status status = solve_basic(s);
        if (status != RB_OK)
            return status;
        s->info->iters++;
        find_negative(s);
        if (s->m == 0)
            return RB_OK;
        if (s->m < fewest) {
            fewest = s->m;
            chances = CHANCES;
            exchange(s, 0);
        } else if (chances > 0) {
            chances--;
            exchange(s, 0);
        } else {
            exchange(s, s->m - 1);
        }
    }
    return rb_fail(&s->info->msg, RB_MAXITER,
                   "lcp: newton: no solution after max_iters = %d steps", max_iters);
}

static rb_status fail_memory(newton *s)
{
    const rb_sparse *M = s->p.M;
    return rb_fail(&s->info->msg, RB_ENOMEM,
                   "lcp: newton: out of memory for order %d with %d entries", M->rows,
                   M->p[M->cols]);
}

static rb_status allocate(newton *s)
{
    const size_t n = (size_t)s->p.M->rows, nz = (size_t)s->p.M->p[s->p.M->cols];
    s->w = rb_alloc(n, 3);
    s->number = rb_alloc_int(2 * n);
    s->A.p = rb_alloc_int(n + 1);
    s->A.i = rb_alloc_int(nz + 1);
    s->A.x = rb_alloc(nz + 1, 1);
    if (!s->w || !s->number || !s->A.p || !s->A.i || !s->A.x)
        return fail_memory(s);
    s->rhs = s->w + n;
    s->x = s->rhs + n;
    s->wrong = s->number + n;
    return RB_OK;
}

/* From one start, on the problem in its scale.  RB_INACCURATE: the end does not solve. */
static rb_status solve(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                       int always, double *z, rb_lcp_info *info)
{
    const int n = M->rows;
    const lcp_matrix all = {.n = n, .sparse = M};
    newton s = {.p = {.M = M, .q = q}, .z = z, .info = info};
    lcp_scale scale = {0};
    lcp_scaled scaled = {0};
    *info = (rb_lcp_info){.res = NAN, .scaled = NAN, .row = -1, .ray_variable = -1};
    rb_status status = rb_lcp_scale_create(&all, q, always, &scale);
    if (status == RB_OK && scale.needed)
        status = rb_lcp_scaled_create(&all, &scale, q, NULL, NULL, opt, &scaled);
    if (scaled.q)
        s.p = (rb_lcp_mixed_problem){.M = &scaled.sparse, .q = scaled.q};
    status = status == RB_ENOMEM ? fail_memory(&s) : allocate(&s);
    if (status == RB_OK) {
        for (int i = 0; i < n; i++)
            s.number[i] = (opt->start ? opt->start[i] > 0.0 : q[i] < 0.0) ? 0 : -1;
        memset(z, 0, (size_t)n * sizeof *z);
        status = iterate(&s, opt->max_iters ? opt->max_iters : 10 * n + 100);
        for (int i = 0; i < n; i++)
            z[i] = fmax(z[i], 0.0);
        if (scaled.q)
            rb_lcp_scale_back(&scale, n, z);
        if (rb_lcp_measure(&all, &scale, q, NULL, NULL, z, info) != RB_OK)
            status = fail_memory(&s);
    }
    if (status == RB_OK)
        status = rb_lcp_assess(info);
    free(s.w);
    free(s.number);
    rb_sparse_free(&s.A);
    rb_lcp_scaled_free(&scaled);
    rb_lcp_scale_free(&scale);
    return status;
}

rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                        double *z, rb_lcp_info *info)
{
    rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread = {0};
    info = info ? info : &unread;
    *info = (rb_lcp_info){.res = NAN, .scaled = NAN, .row = -1, .ray_variable = -1};
    o.cover = NULL;
    o.trace = NULL;
    rb_status s = rb_lcp_check_sparse(M, q, &o, &info->msg);
    if (s == RB_OK)
        s = solve(M, q, &o, 0, z, info);
    if (s == RB_INACCURATE) {
        const int first = info->iters;
        s = solve(M, q, &o, 1, z, info);
        info->iters += first;
    }
    return s;
}
