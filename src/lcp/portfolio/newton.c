/* Block principal pivoting (Judice and Pires, Computers and Operations Research 21,
 * 1994): Newton's method on min(z, M z + q) = 0, guarded so that it ends for every
 * P-matrix. */
#include "lcp/lemke/lemke.h"

#include <math.h>

/* A component counts as negative below this part of the largest. */
static const double NEGATIVE = 1e-13;

/* Steps that exchange all negative components without there being fewer of them. */
enum { CHANCES = 10 };

/* Operations beside the factorisation: of ordering and analysis per entry of the factors,
 * of gathering and products per entry of M, and of what costs like n. */
static const double PER_FACTOR = 40.0, PER_ENTRY = 10.0, PER_ROW = 20.0;

typedef struct {
    lcp_work work;
    const lcp_task *task;
    lcp_posed posed;        /* the problem that is solved */
    rb_lcp_mixed_problem p; /* the same */
    int fewest, chances;
    double *z, *w, *rhs, *x; /* n each */
    int *number;             /* n: of i among the basic z, or -1 */
    int *wrong, m;           /* n: the negative components, and how many */
    rb_sparse A;             /* M of the basic z; room for all of M */
    rb_arena memory;         /* of the arrays */
    rb_lcp_info *info;
} newton;

/* M_FF z_F = -q_F, the other z are zero. */
static rb_status solve_basic(newton *s)
{
    const int n = s->p.M->rows;
    rb_sparse_lu *lu = NULL;
    /* A = M_FF for the basic z, F. */
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
    for (int i = 0; i < n; i++)
        if (s->number[i] >= 0)
            s->rhs[s->number[i]] = -s->p.q[i];
    rb_status status = RB_OK;
    if (s->A.rows > 0)
        status = rb_sparse_lu_create(&s->A, &lu);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_factor(lu, &s->A, &s->work.used);
    if (lu && status == RB_OK)
        status = rb_sparse_lu_solve(lu, s->rhs, s->x);
    if (lu && status == RB_OK)
        s->work.used += PER_FACTOR * rb_sparse_lu_entries(lu);
    s->work.used += PER_ENTRY * s->p.M->p[n] + PER_ROW * n;
    rb_sparse_lu_free(lu);
    for (int i = 0; status == RB_OK && i < n; i++)
        s->z[i] = s->number[i] >= 0 ? s->x[s->number[i]] : 0.0;
    if (status == RB_SINGULAR)
        return rb_fail(&s->info->msg, status,
                       "lcp: newton: a principal submatrix of order %d is singular after "
                       "%d steps",
                       s->A.rows, s->info->iters);
    return status == RB_OK ? status
                           : rb_fail(&s->info->msg, status, "lcp: newton: no factorisation: %s",
                                     rb_status_text(status));
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
static rb_status iterate(void *state)
{
    newton *s = state;
    const rb_lcp_options *opt = s->task->opt;
    const int n = s->p.M->rows, most = opt->max_iters ? opt->max_iters : 10 * n + 100;
    while (!rb_lcp_pauses(&s->work)) {
        if (s->info->iters >= most)
            return rb_fail(&s->info->msg, RB_MAXITER,
                           "lcp: newton: no solution after max_iters = %d steps", most);
        if (opt->seconds > 0.0 && rb_seconds() - s->task->began > opt->seconds)
            return rb_fail(&s->info->msg, RB_TIME_LIMIT,
                           "lcp: newton: no solution after %d steps in %g s", s->info->iters,
                           opt->seconds);
        if (rb_interrupted())
            return rb_fail(&s->info->msg, RB_INTERRUPTED, "lcp: newton: interrupted after %d steps",
                           s->info->iters);
        const rb_status status = solve_basic(s);
        if (status != RB_OK)
            return status;
        s->info->iters++;
        /* s->wrong: where the basic z or the basic w is negative. */
        rb_lcp_residual_mixed(&s->p, s->z, s->w);
        const double small_z = NEGATIVE * rb_norm_inf((size_t)n, s->z);
        const double small_w =
            NEGATIVE * fmax(rb_norm_inf((size_t)n, s->w), rb_norm_inf((size_t)n, s->p.q));
        s->m = 0;
        for (int i = 0; i < n; i++)
            if (s->number[i] >= 0 ? s->z[i] < -small_z : s->w[i] < -small_w)
                s->wrong[s->m++] = i;
        if (s->m == 0)
            return RB_OK;
        if (s->m < s->fewest) {
            s->fewest = s->m;
            s->chances = CHANCES;
            exchange(s, 0);
        } else if (s->chances > 0) {
            s->chances--;
            exchange(s, 0);
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

static rb_status begin(const lcp_task *task, int balance_q, rb_lcp_info *info, void *state)
{
    newton *s = state;
    const rb_sparse *M = task->M.sparse;
    const double *start = task->opt->start;
    *s = (newton){.work.allowed = INFINITY,
                  .task = task,
                  .fewest = M->rows + 1,
                  .chances = CHANCES,
                  .info = info};
    if (rb_lcp_pose(&task->M, task->q, NULL, NULL, task->opt, balance_q, &s->posed) == RB_ENOMEM)
        return fail_memory(s);
    s->p = (rb_lcp_mixed_problem){.M = s->posed.M.sparse, .q = s->posed.q};
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
    const int fits = !start && rb_lcp_coarse_fits(M);
    if (fits && M->rows >= LCP_COARSE_FROM) {
        const rb_status coarse = rb_lcp_coarse_start(M, task->q, s->z, &s->work.used);
        if (coarse == RB_ENOMEM)
            return fail_memory(s);
        start = coarse == RB_OK ? s->z : NULL;
    }
    for (int i = 0; i < M->rows; i++)
        s->number[i] = (start ? start[i] > 0.0 : fits ? 1 : task->q[i] < 0.0) ? 0 : -1;
    return RB_OK;
}

/* RB_INACCURATE: the end does not solve. */
static rb_status end(void *state, rb_status status, double *z)
{
    newton *s = state;
    const lcp_task *task = s->task;
    const int n = task->M.n;
    if (status >= 0) {
        for (int i = 0; i < n; i++)
            z[i] = fmax(s->z[i], 0.0);
        rb_lcp_scale_back(&s->posed, z);
        if (rb_lcp_measure(&task->M, &s->posed.scale, task->q, NULL, NULL, z, s->info) != RB_OK)
            status = fail_memory(s);
    }
    if (status == RB_OK)
        status = rb_lcp_assess(s->info);
    rb_arena_free(&s->memory);
    rb_lcp_posed_free(&s->posed);
    return status;
}

const lcp_method rb_lcp_newton_method = {"newton", sizeof(newton), begin, iterate, end};

rb_status rb_lcp_newton(const rb_sparse *M, const double *q, const rb_lcp_options *opt, double *z,
                        rb_lcp_info *info)
{
    rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    o.cover = NULL;
    o.trace = NULL;
    const rb_status s = rb_lcp_check_sparse(M, q, &o, &info->msg);
    if (s != RB_OK)
        return s;
    const lcp_task task = {
        .M = {.n = M->rows, .sparse = M}, .q = q, .opt = &o, .began = rb_seconds()};
    newton state;
    return rb_lcp_run(&rb_lcp_newton_method, &task, &state, z, info);
}
