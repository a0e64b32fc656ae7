/* Block principal pivoting (Judice and Pires, Computers and Operations Research 21,
 * 1994): Newton's method on mid(z - lower, M z + q, z - upper) = 0, guarded so that it ends
 * for every P-matrix. */
#include "lcp/portfolio/methods.h"
#include "base/sizes.h"

#include <math.h>
#include <stdlib.h>

/* A component counts as negative below this part of the largest. */
static const double NEGATIVE = 1e-13;

/* Steps that exchange all negative components without there being fewer of them. */
enum { CHANCES = 10 };

/* Operations beside the factorisation: of ordering and analysis per entry of the factors,
 * of gathering and products per entry of M, and of what costs like n. */
static const double PER_FACTOR = 40.0, PER_ENTRY = 10.0, PER_ROW = 20.0;

/* Conjugate gradients instead of LU, from RB_LCP_GRADIENTS_FROM on: where the factors would have so
 * many entries per row, as they have in space; to this part of the right-hand side, and of the
 * basis that is the right one to the second or in LAST_STEPS, in so many steps at most. */
enum { GRADIENT_STEPS = 2000, LAST_STEPS = 300 };
static const double FULL = 100.0, GRADIENTS_TO = 1e-12, AT_LAST_TO = 1e-15;

enum { LOWER = -1, UPPER = -2 }; /* in place of a number: the bound of a nonbasic z */

typedef struct {
    lcp_work work;
    const lcp_task *task;
    lcp_posed posed;        /* the problem that is solved */
    rb_lcp_mixed_problem p; /* the same */
    int fewest, chances;
    int gradients;           /* 1: conjugate gradients, -1: not known yet */
    double *z, *w, *rhs, *x; /* n each */
    double *gradient;        /* 4 n, allocated when needed; owned */
    int *number;             /* n: of i among the basic z, or LOWER, UPPER */
    int *wrong, m;           /* n: the components out of their range, and how many */
    rb_sparse A;             /* M of the basic z; room for all of M */
    rb_arena memory;         /* of the arrays */
    rb_lcp_info *info;
} newton;

/* Whether M is symmetric with a positive diagonal, and its factors would be full. */
static rb_status choose_gradients(newton *s)
{
    const rb_sparse *M = s->p.M;
    const int n = M->cols;
    s->gradients = 0;
    if (n < RB_LCP_GRADIENTS_FROM)
        return RB_OK;
    for (int j = 0; j < n; j++)
        if (!(rb_sparse_diagonal(M, j) > 0.0))
            return RB_OK;
    int symmetric;
    double entries = 0.0;
    rb_status status = rb_sparse_is_symmetric(M, &symmetric);
    if (status == RB_OK && symmetric)
        status = rb_sparse_cholesky_estimate(M, &entries);
    s->gradients = entries > FULL * n;
    if (status == RB_OK && s->gradients && !(s->gradient = rb_alloc(4 * (size_t)n, 1)))
        status = RB_ENOMEM;
    return status;
}

/* M_FF z_F = rhs_F by conjugate gradients with the diagonal as preconditioner, from the
 * basic z as they are; vectors have all n components, those beside F are zero.
 * RB_MAXITER: not in GRADIENT_STEPS. */
static rb_status conjugate_gradients(newton *s, double to, const double *rhs)
{
    const rb_sparse *M = s->p.M;
    const int n = M->cols;
    double *r = s->gradient, *d = r + n, *Md = d + n, *inverse = Md + n;
    double size = 0.0, last = 0.0;
    for (int i = 0; i < n; i++) {
        const int basic = s->number[i] >= 0;
        inverse[i] = basic ? 1.0 / rb_sparse_diagonal(M, i) : 0.0;
        s->x[i] = basic ? s->z[i] : 0.0;
        r[i] = basic ? rhs[i] : 0.0;
        size += r[i] * r[i];
    }
    rb_sparse_apply(-1.0, M, s->x, 1.0, r);
    for (int k = 0; k <= GRADIENT_STEPS; k++) {
        double left = 0.0, along = 0.0, curvature = 0.0;
        for (int i = 0; i < n; i++) {
            r[i] = s->number[i] >= 0 ? r[i] : 0.0;
            left += r[i] * r[i];
            along += r[i] * r[i] * inverse[i];
        }
        const int late = to < GRADIENTS_TO && k == LAST_STEPS;
        if (left <= to * to * size || (late && left <= GRADIENTS_TO * GRADIENTS_TO * size)) {
            for (int i = 0; i < n; i++)
                s->z[i] = s->number[i] >= 0 ? s->x[i] : s->z[i];
            return RB_OK;
        }
        for (int i = 0; i < n; i++)
            d[i] = r[i] * inverse[i] + (k ? along / last * d[i] : 0.0);
        rb_sparse_apply(1.0, M, d, 0.0, Md);
        for (int i = 0; i < n; i++)
            curvature += d[i] * Md[i];
        if (!(curvature > 0.0)) /* M is not definite */
            break;
        for (int i = 0; i < n; i++) {
            s->x[i] += along / curvature * d[i];
            r[i] -= along / curvature * Md[i];
        }
        last = along;
        s->work.used += 2.0 * M->p[n] + 14.0 * n;
        if (rb_interrupted())
            break;
    }
    return RB_MAXITER;
}

/* M_FF z_F = rhs_F by a sparse LU. */
static rb_status by_factors(newton *s, const double *rhs)
{
    const rb_sparse *M = s->p.M;
    const int n = M->cols;
    rb_sparse_lu *lu = NULL;
    /* A = M_FF for the basic z, F. */
    rb_sparse *A = &s->A;
    int size = 0, nz = 0;
    for (int j = 0; j < n; j++)
        if (s->number[j] >= 0)
            s->number[j] = size++;
    for (int j = 0; j < n; j++) {
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
    for (int i = 0; i < n; i++)
        if (s->number[i] >= 0)
            s->rhs[s->number[i]] = rhs[i];
    rb_status status = RB_OK;
    if (size > 0)
        status = rb_sparse_lu_create(A, &lu);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_factor(lu, A, &s->work.used);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_solve(lu, s->rhs, s->x);
    if (lu && status == RB_OK)
        s->work.used += PER_FACTOR * rb_sparse_lu_entries(lu);
    rb_sparse_lu_free(lu);
    for (int i = 0; status == RB_OK && i < n; i++)
        s->z[i] = s->number[i] >= 0 ? s->x[s->number[i]] : s->z[i];
    return status;
}

/* M_FF z_F = -(q + M z_N)_F with the other z, N, at their bounds. */
static rb_status solve_basic(newton *s, double to)
{
    const rb_sparse *M = s->p.M;
    const int n = M->cols;
    rb_status status = s->gradients < 0 ? choose_gradients(s) : RB_OK;
    double *rhs = s->w, *bound = s->x;
    for (int i = 0; i < n; i++) {
        rhs[i] = -s->p.q[i];
        bound[i] = s->number[i] >= 0       ? 0.0
                   : s->number[i] == UPPER ? rb_lcp_upper(s->p.upper, i)
                                           : rb_lcp_lower(s->p.lower, i);
    }
    if (s->p.lower || s->p.upper) /* else all are zero */
        rb_sparse_apply(-1.0, M, bound, 1.0, rhs);
    for (int i = 0; i < n; i++)
        if (s->number[i] < 0)
            s->z[i] = bound[i];
    if (status == RB_OK)
        status = s->gradients ? conjugate_gradients(s, to, rhs) : by_factors(s, rhs);
    if (status == RB_MAXITER) {
        s->gradients = 0;
        status = by_factors(s, rhs);
    }
    s->work.used += PER_ENTRY * M->p[n] + PER_ROW * n;
    if (status == RB_SINGULAR)
        return rb_fail(&s->info->msg, status,
                       "lcp: newton: a principal submatrix of order %d is singular after "
                       "%d step%s",
                       s->A.rows, s->info->iters, rb_plural(s->info->iters));
    return status == RB_OK ? status
                           : rb_fail(&s->info->msg, status, "lcp: newton: no factorisation: %s",
                                     rb_status_text(status));
}

/* Of the components out of their range, from the first on: what was between the bounds goes
 * to the one it is beyond, what was at a bound is between. */
static void exchange(newton *s, int first)
{
    for (int k = first; k < s->m; k++) {
        const int i = s->wrong[k];
        s->number[i] = s->number[i] < 0 ? 0 : s->z[i] < rb_lcp_lower(s->p.lower, i) ? LOWER : UPPER;
    }
}

/* All negative components are exchanged at once, which is a Newton step, as long as their
 * number keeps falling or has not stalled too often; then only the last one, which ends
 * for P-matrices (Murty), until there are fewer of them than ever before. */
static rb_status exchange_pairs(void *state)
{
    newton *s = state;
    const rb_lcp_options *opt = s->task->opt;
    const int n = s->p.M->rows, most = opt->max_iters ? opt->max_iters : 10 * n + 100;
    while (!rb_lcp_pauses(&s->work)) {
        if (s->info->iters >= most)
            return rb_fail(&s->info->msg, RB_MAXITER,
                           "lcp: newton: no solution after max_iters = %d step%s", most,
                           rb_plural(most));
        if (opt->seconds > 0.0 && rb_seconds() - s->task->began > opt->seconds)
            return rb_fail(&s->info->msg, RB_TIME_LIMIT,
                           "lcp: newton: no solution after %d step%s in %g s", s->info->iters,
                           rb_plural(s->info->iters), opt->seconds);
        if (rb_interrupted())
            return rb_fail(&s->info->msg, RB_INTERRUPTED,
                           "lcp: newton: interrupted after %d step%s", s->info->iters,
                           rb_plural(s->info->iters));
        const rb_status status = solve_basic(s, GRADIENTS_TO);
        if (status != RB_OK)
            return status;
        s->info->iters++;
        /* s->wrong: where the basic z is beyond its bounds, or the basic w has the sign of the
         * other bound. */
        rb_lcp_residual_mixed(&s->p, s->z, s->w);
        const double small_z = NEGATIVE * rb_norm_inf((size_t)n, s->z);
        const double small_w =
            NEGATIVE * fmax(rb_norm_inf((size_t)n, s->w), rb_norm_inf((size_t)n, s->p.q));
        s->m = 0;
        for (int i = 0; i < n; i++) {
            const double low = rb_lcp_lower(s->p.lower, i), high = rb_lcp_upper(s->p.upper, i);
            const int wrong = s->number[i] >= 0
                                  ? s->z[i] < low - small_z || s->z[i] > high + small_z
                              : low == high           ? 0
                              : s->number[i] == UPPER ? s->w[i] > small_w
                                                      : s->w[i] < -small_w;
            if (wrong)
                s->wrong[s->m++] = i;
        }
        if (s->m == 0)
            return s->gradients > 0 ? solve_basic(s, AT_LAST_TO) : RB_OK;
        if (s->m < s->fewest) {
            s->fewest = s->m;
            s->chances = CHANCES;
            exchange(s, 0);
        } else if (s->chances > 0) {
            s->chances--;
            exchange(s, 0);
        } else if (s->task->hopes) {
            return rb_fail(&s->info->msg, RB_MAXITER,
                           "lcp: newton: no progress in the last %d of %d steps", CHANCES,
                           s->info->iters);
        } else {
            exchange(s, s->m - 1);
        }
    }
    return RB_OK;
}

static rb_status fail_memory(newton *s)
{
    const rb_sparse *M = s->task->M.sparse;
    return rb_fail(&s->info->msg, RB_ENOMEM,
                   "lcp: newton: out of memory for order %d with %d entries", M->rows,
                   M->p[M->cols]);
}

static rb_status begin_newton(const lcp_task *task, int balance_q, rb_lcp_info *info, void *state)
{
    newton *s = state;
    const rb_sparse *M = task->M.sparse;
    const double *start = task->opt->start;
    *s = (newton){.work.allowed = INFINITY,
                  .task = task,
                  .fewest = M->rows + 1,
                  .chances = CHANCES,
                  .gradients = -1,
                  .info = info};
    if (rb_lcp_pose(&task->M, task->q, task->lower, task->upper, task->opt, balance_q, &s->posed) ==
        RB_ENOMEM)
        return fail_memory(s);
    s->p = (rb_lcp_mixed_problem){s->posed.M.sparse, s->posed.q, s->posed.lower, s->posed.upper};
    const size_t n = (size_t)s->p.M->rows, nz = (size_t)s->p.M->p[s->p.M->cols];
    s->z = rb_arena_doubles(&s->memory, n, 1);
    s->w = rb_arena_doubles(&s->memory, n, 1);
    s->rhs = rb_arena_doubles(&s->memory, n, 1);
    s->x = rb_arena_doubles(&s->memory, n, 1);
    s->number = rb_arena_ints(&s->memory, n);
    s->wrong = rb_arena_ints(&s->memory, n);
    s->A.p = rb_arena_ints(&s->memory, n + 1);
    s->A.i = rb_arena_ints(&s->memory, nz);
    s->A.x = rb_arena_doubles(&s->memory, nz, 1);
    if (s->memory.failed)
        return fail_memory(s);
    const int boxes = s->p.lower || s->p.upper, fits = !boxes && !start && rb_lcp_coarse_fits(M);
    if (fits && M->rows >= RB_LCP_COARSE_FROM) {
        const rb_status coarse = rb_lcp_coarse_start(M, task->q, s->z, &s->work.used);
        if (coarse == RB_ENOMEM)
            return fail_memory(s);
        start = coarse == RB_OK ? s->z : NULL;
    }
    for (int i = 0; i < M->rows && !boxes; i++)
        s->number[i] = (start ? start[i] > 0.0 : fits ? 1 : task->q[i] < 0.0) ? 0 : LOWER;
    /* With bounds: all between them, or those of the start. */
    for (int i = 0; i < M->rows && boxes; i++) {
        const double low = rb_lcp_lower(task->lower, i), high = rb_lcp_upper(task->upper, i);
        s->number[i] = low == high                          ? LOWER
                       : !start                             ? 0
                       : isfinite(low) && start[i] <= low   ? LOWER
                       : isfinite(high) && start[i] >= high ? UPPER
                                                            : 0;
    }
    for (int i = 0; i < M->rows; i++) /* where conjugate gradients begin */
        s->z[i] = start ? start[i] / (s->posed.scaled ? s->posed.scale.col[i] : 1.0) : 0.0;
    return RB_OK;
}

/* RB_INACCURATE: the end does not solve. */
static rb_status end_newton(void *state, rb_status status, double *z)
{
    newton *s = state;
    const lcp_task *task = s->task;
    const int n = task->M.n;
    if (status >= 0) {
        for (int i = 0; i < n; i++)
            z[i] = fmin(fmax(s->z[i], rb_lcp_lower(s->p.lower, i)), rb_lcp_upper(s->p.upper, i));
        rb_lcp_scale_back(&s->posed, z);
        if (rb_lcp_measure(&task->M, &s->posed.scale, task->q, task->lower, task->upper, z,
                           s->info) != RB_OK)
            status = fail_memory(s);
    }
    if (status == RB_OK)
        status = rb_lcp_assess(s->info);
    free(s->gradient);
    rb_arena_free(&s->memory);
    rb_lcp_posed_free(&s->posed);
    return status;
}

const lcp_method rb_lcp_newton_method = {"newton", sizeof(newton), begin_newton, exchange_pairs,
                                         end_newton};

rb_status rb_lcp_newton_in_boxes(const rb_lcp_mixed_problem *p, int hopes,
                                 const rb_lcp_options *opt, double *z, rb_lcp_info *info)
{
    rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    o.cover = NULL;
    o.trace = NULL;
    const rb_status s = rb_lcp_check_mixed(p, &o, &info->msg);
    if (s != RB_OK)
        return s;
    const lcp_task task = {.M = {.n = p->M->rows, .sparse = p->M},
                           .q = p->q,
                           .lower = p->lower,
                           .upper = p->upper,
                           .opt = &o,
                           .hopes = hopes,
                           .began = rb_seconds()};
    newton state;
    return rb_lcp_run(&rb_lcp_newton_method, &task, &state, z, info);
}

rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt, double *z,
                        rb_lcp_info *info)
{
    return rb_lcp_newton_in_boxes(&(rb_lcp_mixed_problem){.M = M, .q = q}, 0, opt, z, info);
}
