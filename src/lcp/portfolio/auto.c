/* One call for all methods by name, and the portfolio: the structure of M determines the
 * first method; if it does not finish soon, all methods run in turns.
 *
 * In its first turn the first method may use as many operations as it needs on suitable
 * problems.  Then the methods continue in turns, each from its last iterate, until its
 * own operations reach its share of an allowance, which grows from round to round.
 * Operations are counted by formulas, so that the same problem is always solved in the
 * same way. */
#include "lcp/portfolio/methods.h"
#include "base/sizes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Structure --------------------------------------------------------------------- */

/* With fewer entries than this part of all a pivot by sparse factors is cheaper than one on a
 * tableau, from RB_LCP_SPARSE_PIVOTS_FROM on. */
static const double FEW = 0.02;

/* --solver lemke is a tableau below RB_LCP_LEMKE_SPARSE_FROM or above this part of all entries. */
static const double MANY = 0.1;

/* Newton's method goes first on sparse matrices whose diagonal is positive: on those of discretised
 * inequalities, which it solves always, and on others; and on those without negative entries whose
 * diagonal is positive where q is negative, from where it begins.  So many systems are its first
 * turn. */
enum { SURE_SYSTEMS = 40, HOPE_SYSTEMS = 3 };

typedef struct {
    int n;        /* order */
    int positive; /* 1: all diagonal entries are positive */
    int begins;   /* 1: those where q is negative are, and no entry at all is negative; 0 where too
                     much is filled for Newton's method to go first */
    double part;  /* filled */
} structure;

/* Entries that are not zero, as a part of all. */
static double filled(const rb_sparse *M)
{
    return M->p[M->cols] / ((double)M->cols * M->cols);
}

static structure read_structure(const rb_sparse *M, const double *q)
{
    const int n = M->cols;
    structure s = {n, 1, 1, filled(M)};
    s.begins = s.part <= MANY;
    for (int j = 0; (s.positive || s.begins) && j < n; j++) {
        const double x = rb_sparse_diagonal(M, j);
        s.positive &= x > 0.0;
        s.begins &= x > 0.0 || q[j] >= 0.0;
    }
    for (int k = 0; s.begins && k < M->p[n]; k++)
        s.begins = M->x[k] >= 0.0;
    return s;
}

/* ---- Members ------------------------------------------------------------------------- */

enum { TABLEAU, SPARSE, NEWTON, MEMBERS };

static const lcp_method *const methods[MEMBERS] = {&rb_lcp_tableau_method, &rb_lcp_sparse_method,
                                                   &rb_lcp_newton_method};

typedef struct {
    const lcp_method *method;
    double share;
    int systems; /* of its first turn alone; 0: by operations */
    lcp_task task;
    lcp_work *work;             /* its state, which begins with it; owned */
    int open, balance_q, ended; /* open: the state is that of a path that goes on */
    rb_lcp_info info;
} member;

typedef struct {
    int count;
    member member[MEMBERS];
    double *dense; /* n x n: M for the tableau; owned */
    double *z;     /* n: of the method that has just ended; owned */
} portfolio;

static void add_member(portfolio *p, int kind, double share, int systems, const lcp_task *task)
{
    p->member[p->count++] = (member){.method = methods[kind],
                                     .share = share,
                                     .systems = systems,
                                     .task = *task,
                                     .info = RB_LCP_INFO_NONE};
}

/* The order and the shares. */
static void choose_order(const lcp_task *task, portfolio *p)
{
    const rb_sparse *M = task->M.sparse;
    const structure s = read_structure(M, task->q);
    const int sparse_pivots = s.n >= RB_LCP_SPARSE_PIVOTS_FROM && s.part < FEW;
    const int first = sparse_pivots || s.n > RB_LCP_TABLEAU_UP_TO ? SPARSE : TABLEAU;
    const int sparse = (s.positive || s.begins) && s.part <= MANY;
    const int discretised =
        sparse && s.positive && s.n >= RB_LCP_NEWTON_HOPE_FROM && rb_lcp_coarse_fits(M);
    const int sure = discretised && s.n >= RB_LCP_NEWTON_SURE_FROM;
    const int newton_first =
        sure || (sparse && !discretised && s.n >= RB_LCP_NEWTON_HOPE_FROM) || task->opt->start;
    if (newton_first)
        add_member(p, NEWTON, 1.0, sure ? SURE_SYSTEMS : HOPE_SYSTEMS, task);
    add_member(p, first, 1.0, 0, task);
    if (!newton_first)
        add_member(p, NEWTON, s.positive ? 0.5 : 0.1, 0, task);
    if (first == TABLEAU || s.n <= RB_LCP_TABLEAU_UP_TO)
        add_member(p, first == TABLEAU ? SPARSE : TABLEAU, 0.5, 0, task);
}

static rb_status make_dense(const rb_sparse *M, double **dense)
{
    const size_t n = (size_t)M->cols;
    *dense = rb_alloc(n, n);
    for (size_t j = 0; *dense && j < n; j++)
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            (*dense)[(size_t)M->i[k] + j * n] = M->x[k];
    return *dense ? RB_OK : RB_ENOMEM;
}

static double used_by(const member *a)
{
    return a->work ? a->work->used : 0.0;
}

/* Goes on until its operations reach the allowance, or it ends, with p->z then. */
static rb_status take_turn(portfolio *p, member *a, double allowance)
{
    for (;;) {
        rb_status s = RB_OK;
        if (!a->open) {
            const int tableau = a->method == &rb_lcp_tableau_method, iters = a->info.iters;
            const double used = used_by(a);
            if (tableau && !p->dense)
                s = make_dense(a->task.M.sparse, &p->dense);
            if (tableau) {
                a->task.M.dense = p->dense;
                a->task.M.ld = a->task.M.n;
                a->task.generic = a->task.generic ? LCP_GENERIC : LCP_GENERIC_FOR_TIES;
            }
            a->work = a->work ? a->work : malloc(a->method->size);
            a->open = s == RB_OK && a->work;
            if (a->open) {
                a->info = RB_LCP_INFO_NONE;
                s = a->method->begin(&a->task, a->balance_q, &a->info, a->work);
                a->work->used += used;
                a->info.iters = iters;
            } else
                s = RB_ENOMEM;
        }
        if (s == RB_OK) {
            a->work->allowed = allowance;
            s = a->method->go_on(a->work);
            if (s == RB_OK && a->work->paused)
                return RB_OK;
        }
        if (a->open)
            s = a->method->end(a->work, s, p->z);
        a->open = 0;
        a->ended = s != RB_INACCURATE || a->balance_q;
        if (a->ended)
            return s;
        a->balance_q = 1;
    }
}

/* ---- Turns ------------------------------------------------------------------------- */

/* From round to round. */
static const double GROWTH = 1.25;

/* A path of a covering vector of ones that takes so many times the first turn may be one of the
 * long ones; another one begins. */
static const double LONG = 4.0;

/* Operations that Newton's method may always take after the pivots have failed. */
static const double LAST_CHANCE = 1e6;

static rb_status run_portfolio(const lcp_task *task, double *z, rb_lcp_info *info)
{
    portfolio p = {.z = rb_alloc((size_t)task->M.n, 1)};
    member *first = &p.member[0];
    /* Memory that one member lacks may be enough for the others. */
    rb_status s = RB_OK, said = RB_ENOMEM;
    *info = RB_LCP_INFO_NONE;
    choose_order(task, &p);
    /* The first method that pivots: how it has ended is what is said of a problem that none
     * has solved. */
    const member *spokesman = &p.member[first->method == &rb_lcp_newton_method];
    double allowance = 0.0, begun = 0.0; /* begun: by the first turn */
    int over = !p.z;
    for (int round = 0, open = p.count, last = 0; !over && open && !last; round++) {
        /* Where no pivots are left, but Newton's method has not ended: what it may use. */
        double sum = LAST_CHANCE;
        last = round > 0;
        for (int k = 0; k < p.count; k++) {
            sum += used_by(&p.member[k]);
            last &= (p.member[k].method == &rb_lcp_newton_method) != p.member[k].ended;
        }
        open = 0;
        if (round && first->open && first->work->ones && used_by(first) > LONG * begun) {
            first->method->end(first->work, RB_MAXITER, p.z);
            first->open = 0;
        }
        for (int k = 0; !over && k < (round ? p.count : 1); k++) {
            member *a = &p.member[k];
            if (a->ended)
                continue;
            if (round)
                s = take_turn(&p, a, last ? sum : allowance * a->share);
            else if (!a->systems) {
                /* As many pivots as a path that is not one of the long ones takes. */
                const double n = task->M.n, pivots = 2.0 * n + 50.0;
                s = take_turn(&p, a,
                              a->method == &rb_lcp_tableau_method
                                  ? pivots * rb_lcp_work_of_pivot(task->M.n)
                                  : pivots * (2000.0 + 40.0 * n));
            } else
                for (s = RB_OK; s == RB_OK && !a->ended && a->info.iters < a->systems;)
                    s = take_turn(&p, a, used_by(a) + 1.0);
            over = a->ended &&
                   (s == RB_OK || s == RB_NO_SOLUTION || s == RB_TIME_LIMIT || s == RB_INTERRUPTED);
            if (a->ended && s != RB_ENOMEM && (over || a == spokesman || said == RB_ENOMEM)) {
                memcpy(z, p.z, (size_t)task->M.n * sizeof *z);
                *info = a->info;
                info->solver = a->method->name;
                said = s;
            }
        }
        for (int k = 0; k < p.count; k++)
            open += !p.member[k].ended;
        begun = round ? begun : fmax(used_by(first), 1.0);
        allowance = round ? allowance * GROWTH : begun;
    }
    int iters = 0;
    for (int k = 0; k < p.count; k++) {
        member *a = &p.member[k];
        if (a->open)
            a->method->end(a->work, RB_MAXITER, p.z);
        iters += a->info.iters;
        free(a->work);
    }
    info->iters = iters;
    free(p.z);
    free(p.dense);
    if (said == RB_ENOMEM && !*info->msg.text)
        rb_fail(&info->msg, said, "lcp: out of memory for order %d", task->M.n);
    return said;
}

/* ---- By name ------------------------------------------------------------------------- */

static const rb_lcp_solver solvers[] = {
    {"auto", "the methods below in turns, first the one that suits the structure of M"},
    {"lemke", "Lemke's method on a tableau; large sparse problems as lemke-sparse"},
    {"lemke-sparse", "Lemke's method with a sparse LU, also for bounds"},
    {"newton", "block principal pivoting with a sparse LU, finite for P-matrices"}};
enum { AUTO, LEMKE, LEMKE_SPARSE, BLOCKS, SOLVERS };

const rb_lcp_solver *rb_lcp_solvers(int *count)
{
    *count = SOLVERS;
    return solvers;
}

/* 1: the diagonal is positive and larger than the others of every column, or of every
 * row; rows: n, zero. */
static int is_dominant(const rb_sparse *M, double *rows)
{
    int by_columns = 1, by_rows = 1;
    for (int j = 0; j < M->cols; j++) {
        double rest = 0.0, own = 0.0;
        for (int k = M->p[j]; k < M->p[j + 1]; k++) {
            const int i = M->i[k];
            if (i == j)
                own = M->x[k];
            else
                rest += fabs(M->x[k]);
            rows[i] += i == j ? M->x[k] : -fabs(M->x[k]);
        }
        by_columns &= own > rest * (1.0 + 1e-9);
    }
    for (int i = 0; i < M->cols; i++)
        by_rows &= rows[i] > 0.0;
    return by_columns || by_rows;
}

/* 1: M is symmetric with a Cholesky factor, or strictly dominated by a positive diagonal,
 * by rows or by columns: then there is one solution for every q and all bounds, and no
 * path of Lemke's method ends on a ray but by rounding errors. */
static int is_definite(const rb_sparse *M)
{
    rb_sparse_cholesky *factor = NULL;
    double *rows = rb_alloc((size_t)M->cols, 1);
    int symmetric = 0, yes = rows && is_dominant(M, rows);
    if (!yes && rb_sparse_is_symmetric(M, &symmetric) == RB_OK && symmetric)
        yes = rb_sparse_cholesky_create(M, &factor) == RB_OK;
    rb_sparse_cholesky_free(factor);
    free(rows);
    return yes;
}

static rb_status fail_hidden(rb_lcp_info *info)
{
    return rb_fail(&info->msg, RB_NUMERICAL,
                   "lcp: numerical failure after %d pivot%s: M is definite, so that there is a "
                   "solution, but rounding errors hide it",
                   info->iters, rb_plural(info->iters));
}

/* Paths that are tried in place of one that has ended where no exact path ends. */
enum { OTHER_COVERS = 3 };

/* s: how a path has ended that has not found the solution; a proof that there is none holds up to
 * rounding.  Where M is such that there is one for every q, rounding errors have ended it: paths
 * with other covering vectors are tried if the caller has asked for none. */
static rb_status retry_definite(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double *z,
                                rb_lcp_info *info, rb_status s)
{
    const int own = opt->cover || opt->trace || opt->rule != RB_LCP_LEXICOGRAPHIC;
    if ((s != RB_RAY && s != RB_NUMERICAL && s != RB_SINGULAR && s != RB_NO_SOLUTION) ||
        !is_definite(p->M))
        return s;
    const size_t n = (size_t)p->M->cols;
    double *cover = rb_alloc(n, 1);
    rb_lcp_options o = *opt;
    unsigned long long seed = 20260101;
    int iters = info->iters;
    s = cover ? RB_NUMERICAL : RB_ENOMEM;
    o.cover = cover;
    for (int k = 0; s == RB_NUMERICAL && !own && k < OTHER_COVERS; k++) {
        for (size_t i = 0; i < n; i++)
            cover[i] = rb_lcp_random(&seed);
        s = rb_lcp_mixed(p, &o, z, info);
        iters = info->iters += iters;
        if (s == RB_RAY || s == RB_SINGULAR || s == RB_INACCURATE || s == RB_NO_SOLUTION)
            s = RB_NUMERICAL;
    }
    free(cover);
    return s == RB_NUMERICAL ? fail_hidden(info) : s;
}

/* s: how all methods have ended.  Where that proves nothing, and the problem is not large,
 * branching finds a solution or proves that there is none.  max_iters limits it, too. */
static rb_status branch(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double began,
                        double *z, rb_lcp_info *info, rb_status s)
{
    if (p->M->cols > RB_LCP_BRANCH_UP_TO || (s != RB_RAY && s != RB_SINGULAR && s != RB_MAXITER &&
                                             s != RB_INACCURATE && s != RB_NUMERICAL))
        return s;
    const int before = info->iters;
    const rb_status found = rb_lcp_branch(p, opt, began, z, info);
    const int choices = info->iters - before;
    if (found == RB_NO_SOLUTION && is_definite(p->M))
        return fail_hidden(info);
    if (found == RB_NO_SOLUTION)
        rb_fail(
            &info->msg, found,
            "lcp: no solution: %d choice%s of what is zero, each excluded by linear programming",
            choices, rb_plural(choices));
    else if (found == RB_UNDECIDED)
        rb_fail(&info->msg, found,
                "lcp: none found: rounding errors leave some of %d choice%s of what is zero open",
                choices, rb_plural(choices));
    else if (found == RB_TIME_LIMIT)
        rb_fail(&info->msg, found,
                "lcp: no solution after %d pivot%s and %d choice%s of what is zero in %g s", before,
                rb_plural(before), choices, rb_plural(choices), opt->seconds);
    else if (found == RB_INTERRUPTED)
        rb_fail(&info->msg, found, "lcp: interrupted after %d choice%s of what is zero", choices,
                rb_plural(choices));
    return found == RB_MAXITER || found == RB_ENOMEM ? s : found;
}

rb_status rb_lcp_solve(const char *solver, const rb_lcp_mixed_problem *p, const rb_lcp_options *opt,
                       double *z, rb_lcp_info *info)
{
    const rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    int kind = AUTO;
    while (solver && kind < SOLVERS && strcmp(solver, solvers[kind].name) != 0)
        kind++;
    if (kind == SOLVERS)
        return rb_fail(&info->msg, RB_EINVAL,
                       "lcp: unknown solver '%.60s': expected auto, lemke, lemke-sparse "
                       "or newton",
                       solver);
    const int boxes = p->lower || p->upper;
    const rb_status s = rb_lcp_check_mixed(p, &o, &info->msg);
    if (s != RB_OK)
        return s;
    const double began = rb_seconds();
    const int path = o.trace || o.cover || o.rule != RB_LCP_LEXICOGRAPHIC;
    rb_status status = RB_SINGULAR;
    if (kind == BLOCKS)
        return rb_lcp_newton_in_boxes(p, 0, &o, z, info);
    if (kind == AUTO && !path && p->M->cols >= RB_LCP_DOMINATED_FROM) {
        status = rb_lcp_contraction(p, &o, began, z, info);
        if (status == RB_OK || status == RB_TIME_LIMIT || status == RB_INTERRUPTED)
            return status;
    }
    if (kind == AUTO && !path && !boxes) {
        const lcp_task task = {
            .M = {.n = p->M->cols, .sparse = p->M}, .q = p->q, .opt = &o, .began = began};
        status = rb_lcp_game_solve(p->M, p->q, &o, z, info);
        if (status != RB_OK && status >= 0)
            status = run_portfolio(&task, z, info);
        status = retry_definite(p, &o, z, info, status);
        return branch(p, &o, began, z, info, status);
    }
    if (kind == AUTO && !path) {
        /* In boxes Newton's method first, as long as it makes progress. */
        status = rb_lcp_newton_in_boxes(p, 1, &o, z, info);
        if (status == RB_OK || status == RB_TIME_LIMIT || status == RB_INTERRUPTED)
            return status;
        const int systems = info->iters;
        status = rb_lcp_mixed(p, &o, z, info);
        info->iters += systems;
        status = retry_definite(p, &o, z, info, status);
        return branch(p, &o, began, z, info, status);
    }
    const int large = p->M->cols >= RB_LCP_LEMKE_SPARSE_FROM && filled(p->M) < MANY;
    if (kind == LEMKE_SPARSE || boxes || o.start || large)
        return retry_definite(p, &o, z, info, rb_lcp_mixed(p, &o, z, info));
    const int n = p->M->cols;
    double *dense;
    status = make_dense(p->M, &dense);
    if (status == RB_OK)
        status = rb_lcp_lemke(&(rb_lcp_problem){n, dense, n, p->q}, &o, z, info);
    else
        rb_fail(&info->msg, status, "lcp: out of memory for a dense matrix of order %d", n);
    free(dense);
    return retry_definite(p, &o, z, info, status);
}
