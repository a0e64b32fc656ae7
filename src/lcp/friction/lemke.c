/* Plane problems as linear complementarity problems, for Lemke's method: of order 4 n_c
 * on a sparse LU (lemke_pairs.c), or of order 3 n_c on a dense tableau.
 *
 * Coulomb's law with u_T = u+ - u-, s+ = mu r_N + r_T, s- = mu r_N - r_T:
 *     u_N, r_N | u+, s+ | u-, s-  >= 0, complementary in pairs,   s+ + s- = 2 mu r_N,
 *     E u - W r = q:  E = 1, or E = 1 - k W where K is singular and W, q are those of the
 *     structure with springs k at the contacts.
 * Solved for w in one of three ways, which Lemke's method finds unequally easy:
 *     force basis         z = (r_N, s+, u-), w = (u_N, u+, s-): no inverse; needs E = 1
 *     displacement basis  z = (u_N, u+, s-), w = (r_N, s+, u-), as *Kanno*'s bar needs it
 *     stiffness basis     z = (u_N, u+, u-), w = (r_N, s+, s-), where even T is loose
 * The force basis takes the fewest pivots where W is regular.  Where contacts are
 * redundant its paths are long or end on a ray, and those of order 4 n_c do not. Each may
 * be mirrored (T -> -T), which exchanges + and -. */
#include "lcp/friction/internal.h"
#include "lcp/lcp.h"

#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <string.h>

typedef enum { FORCE, PAIRS, DISPLACEMENT, STIFFNESS } basis_kind; /* PAIRS: 4 n_c */

typedef struct {
    basis_kind kind;
    int mirror;
    double third; /* cover of the third group of rows; that of the first is 1, that of the
                     second 2 mu in the displacement and stiffness bases, else 1 */
    rb_lcp_rule rule;
} attempt;

static const attempt attempts[RB_FRICTION_LEMKE_ATTEMPTS] = {
    {FORCE, 0, 1.0, RB_LCP_LEXICOGRAPHIC}, /* dense W only */
    {PAIRS, 0, 1.0, RB_LCP_LEXICOGRAPHIC},
    {FORCE, 1, 1.0, RB_LCP_LEXICOGRAPHIC},
    /* r_N and s+ tie where a contact opens, and r_N, which has the lowest number, is to
       leave: after s+ the path ends on a ray */
    {DISPLACEMENT, 0, 1.0, RB_LCP_FIRST_INDEX},
    {DISPLACEMENT, 0, 0.01, RB_LCP_FIRST_INDEX},
    {DISPLACEMENT, 0, 100.0, RB_LCP_FIRST_INDEX},
    {DISPLACEMENT, 1, 1.0, RB_LCP_FIRST_INDEX},
    {STIFFNESS, 0, 1.0, RB_LCP_LEXICOGRAPHIC},
};

typedef struct {
    rb_friction_task *task;
    int nc, n;         /* n = 3 nc */
    double *W, *E, *q; /* 2 nc, dense, times `unit`; E NULL: identity */
    double unit;       /* [force/velocity], so that all unknowns are forces */
    double *M, *b;     /* n x n, n */
    double *basis;     /* n x n */
    double *z, *w, *cover;
    int *pivots;
    rb_arena memory; /* of all arrays */
} lemke;

/* ---- The equations E u - W r = q --------------------------------------------------- */

static void scatter(const rb_sparse *a, double *dense)
{
    for (int j = 0; j < a->cols; j++)
        for (int k = a->p[j]; k < a->p[j + 1]; k++)
            dense[a->i[k] + (size_t)j * (size_t)a->rows] = a->x[k];
}

/* T -> -T in every contact; twice is nothing. */
static void mirror(lemke *s)
{
    const size_t m = (size_t)s->task->m;
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < m; i++)
            if ((i + j) % 2) {
                s->W[i + j * m] = -s->W[i + j * m];
                if (s->E)
                    s->E[i + j * m] = -s->E[i + j * m];
            }
    for (size_t i = 1; i < m; i += 2)
        s->q[i] = -s->q[i];
}

/* ---- The two bases ----------------------------------------------------------------- */

/* Row i (of 2 nc, contact by contact N, T) goes to group N or T of the LCP. */
static size_t row_of(const lemke *s, size_t i)
{
    return i / 2 + (i % 2 ? (size_t)s->nc : 0);
}

/* (E u - W r)_i = q_i and s+ + s- - 2 mu r_N = 0, as
 *     of_force (r_N, s+, u-) + of_displacement (u_N, u+, s-) = b:
 * one of the two groups is z, the other the basis. */
static void equations(lemke *s, double *of_force, double *of_displacement)
{
    const size_t nc = (size_t)s->nc, n = (size_t)s->n, m = 2 * nc;
    for (size_t k = 0; k < n * n; k++)
        of_force[k] = of_displacement[k] = 0.0;
    for (size_t c = 0; c < nc; c++) {
        const double mu = s->task->problem->mu[c];
        for (size_t i = 0; i < m; i++) {
            const size_t row = row_of(s, i);
            const double wn = s->W[i + 2 * c * m], wt = s->W[i + (2 * c + 1) * m];
            const double en = s->E ? s->E[i + 2 * c * m] : i == 2 * c;
            const double et = s->E ? s->E[i + (2 * c + 1) * m] : i == 2 * c + 1;
            of_force[row + c * n] = -(wn - mu * wt); /* r_T = s+ - mu r_N */
            of_force[row + (nc + c) * n] = -wt;
            of_force[row + (m + c) * n] = -et;
            of_displacement[row + c * n] = en;
            of_displacement[row + (nc + c) * n] = et;
        }
        of_force[m + c + c * n] = -2.0 * mu;
        of_force[m + c + (nc + c) * n] = 1.0;
        of_displacement[m + c + (m + c) * n] = 1.0;
    }
    for (size_t i = 0; i < m; i++)
        s->b[row_of(s, i)] = s->q[i];
    for (size_t c = 0; c < nc; c++)
        s->b[m + c] = 0.0;
}

/* Pivots of one attempt: solvable problems take n to 3 n. */
#define MOST_PIVOTS(n) (10 * (n) + 1000)
/* Of the first one, which is followed by a form that is safe. */
#define MOST_AT_FIRST(n) (3 * (n) + 100)

static rb_status run_attempt(lemke *s, const attempt *a)
{
    rb_friction_task *t = s->task;
    rb_lcp_options opt = rb_lcp_defaults();
    rb_lcp_info info = {0};
    const int left = rb_friction_task_left(t, INT_MAX);
    if (!left)
        return RB_MAXITER;
    if (a->mirror)
        mirror(s);
    /* w = M z + b in the basis of the attempt. */
    rb_status st = a->kind == FORCE && s->E ? RB_SINGULAR : RB_OK;
    if (st == RB_OK) {
        const size_t order = (size_t)s->n, all = order * order;
        if (a->kind == FORCE)
            equations(s, s->M, s->basis); /* the basis is the identity */
        else
            equations(s, s->basis, s->M);
        if (a->kind == STIFFNESS) /* u- and s- change sides */
            for (size_t k = all - all / 3; k < all; k++) {
                const double x = s->basis[k];
                s->basis[k] = s->M[k];
                s->M[k] = x;
            }
        for (size_t k = 0; k < all; k++)
            s->M[k] = -s->M[k];
        int code = 0;
        if (a->kind != FORCE) {
            code = LAPACKE_dgetrf(LAPACK_COL_MAJOR, s->n, s->n, s->basis, s->n, s->pivots);
            t->info->flops += 8.0 / 3.0 * (double)all * (double)order;
        }
        if (a->kind != FORCE && code == 0)
            code = LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', s->n, s->n, s->basis, s->n, s->pivots,
                                  s->M, s->n);
        if (a->kind != FORCE && code == 0)
            code = LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', s->n, 1, s->basis, s->n, s->pivots, s->b,
                                  s->n);
        st = rb_lapack_status(code);
    }
    if (st == RB_OK) {
        for (int c = 0; c < s->nc; c++) {
            const double two_mu = 2.0 * s->task->problem->mu[c];
            const double second = a->kind != FORCE && two_mu > 0.0 ? two_mu : 1.0;
            s->cover[c] = 1.0;
            s->cover[s->nc + c] = second;
            s->cover[2 * s->nc + c] = a->third;
        }
        opt.cover = s->cover;
        opt.rule = a->rule;
        const int most = a == attempts ? MOST_AT_FIRST(s->n) : MOST_PIVOTS(s->n);
        opt.max_iters = left < most ? left : most;
        opt.seconds = t->deadline > 0.0 ? fmax(t->deadline - rb_seconds(), 1e-9) : 0.0;
        st = rb_lcp_lemke(&(rb_lcp_problem){s->n, s->M, s->n, s->b}, &opt, s->z, &info);
        t->info->iters += info.iters;
        t->info->flops += 2.0 * s->n * (double)s->n * info.iters;
    }
    if (a->mirror)
        mirror(s);
    if (st != RB_OK)
        return st;
    /* r and u from z and w */
    const int nc = s->nc, n = s->n;
    rb_lcp_residual(&(rb_lcp_problem){n, s->M, n, s->b}, s->z, s->w);
    const double *force = a->kind == FORCE ? s->z : s->w;
    const double *displacement = a->kind == FORCE ? s->w : s->z;
    const double *u_minus = a->kind == STIFFNESS ? s->z : force;
    const double sign = a->mirror ? -1.0 : 1.0;
    for (int c = 0; c < nc; c++) {
        const double mu = t->problem->mu[c], rn = fmax(0.0, force[c]);
        const double s_plus = fmin(fmax(0.0, force[nc + c]), 2.0 * mu * rn);
        t->r[2 * c] = rn;
        t->r[2 * c + 1] = sign * (s_plus - mu * rn);
        t->u[2 * c] = displacement[c] / s->unit;
        t->u[2 * c + 1] = sign * (displacement[nc + c] - u_minus[2 * nc + c]) / s->unit;
    }
    rb_friction_scale(&t->shared->scaling, t->r, t->u);
    if (t->n)
        st = rb_friction_measure_displacement(t->measure, t->r, t->u, t->v);
    if (st == RB_OK && !rb_friction_task_accepts(t, rb_friction_task_error(t)))
        st = RB_INACCURATE;
    return st;
}

static rb_status try_attempt(lemke *s, const attempt *a)
{
    rb_friction_task *t = s->task;
    const rb_friction_problem *w = t->shared->local;
    if (a->kind == PAIRS)
        return w ? rb_friction_lemke_pairs(t) : RB_SINGULAR;
    const double order = t->m;
    const int is_sparse = w && w->form == RB_FRICTION_LOCAL_SPARSE;
    /* No tableau where W is sparse, which the tableau would not be. */
    if (a == attempts && (!w || (is_sparse && w->Ws.p[w->Ws.cols] < 0.25 * order * order)))
        return RB_SINGULAR;
    rb_status st = RB_OK;
    if (!s->M) { /* no dense attempt was made yet */
        const size_t m = (size_t)t->m, n = 3 * (size_t)t->contacts;
        rb_arena *memory = &s->memory;
        s->nc = t->contacts;
        s->n = (int)n;
        s->W = rb_arena_doubles(memory, m, m);
        s->E = w ? NULL : rb_arena_doubles(memory, m, m);
        s->q = rb_arena_doubles(memory, m, 1);
        s->M = rb_arena_doubles(memory, n, n);
        s->b = rb_arena_doubles(memory, n, 1);
        s->basis = rb_arena_doubles(memory, n, n);
        s->z = rb_arena_doubles(memory, n, 1);
        s->w = rb_arena_doubles(memory, n, 1);
        s->cover = rb_arena_doubles(memory, n, 1);
        s->pivots = rb_arena_ints(memory, n);
        st = memory->failed ? RB_ENOMEM : RB_OK;
        if (st == RB_OK && w) {
            if (is_sparse)
                scatter(&w->Ws, s->W);
            else
                memcpy(s->W, w->W, m * m * sizeof *s->W);
            memcpy(s->q, w->q, m * sizeof *s->q);
        } else if (st == RB_OK) { /* K singular: W, q with springs k, and E = 1 - k W */
            rb_sparse held = {0};
            st = rb_friction_measure_spring_load(t->measure, s->q);
            if (st == RB_OK)
                st = rb_sparse_cholesky_congruence(t->measure->factor, &t->problem->H, &held);
            if (st == RB_OK)
                scatter(&held, s->W);
            for (size_t k = 0; st == RB_OK && k < m * m; k++)
                s->E[k] = (k % (m + 1) == 0) -
                          rb_friction_measure_spring(t->measure, (int)(k / m)) * s->W[k];
            rb_sparse_free(&held);
        }
        /* In the given units: where ones are the cover, all contacts open at one speed. */
        const double *unit = t->shared->scaling.unit;
        for (size_t j = 0; st == RB_OK && unit && j < m; j++) {
            for (size_t i = 0; i < m; i++) {
                s->W[i + j * m] /= unit[i / 2] * unit[j / 2];
                if (s->E)
                    s->E[i + j * m] *= unit[j / 2] / unit[i / 2];
            }
            s->q[j] /= unit[j / 2];
        }
        double trace = 0.0;
        for (size_t k = 0; st == RB_OK && k < m; k++)
            trace += fabs(s->W[k * (m + 1)]);
        s->unit = trace > 0.0 ? (double)m / trace : 1.0;
        for (size_t k = 0; st == RB_OK && k < m * m; k++)
            s->W[k] *= s->unit;
        for (size_t k = 0; st == RB_OK && k < m; k++)
            s->q[k] *= s->unit;
    }
    return st == RB_OK ? run_attempt(s, a) : st;
}

static rb_status run_lemke(rb_friction_task *task, int variant)
{
    const int from = variant ? variant - 1 : 0;
    const int to = variant ? variant : RB_FRICTION_LEMKE_ATTEMPTS;
    lemke s = {.task = task};
    rb_status first = RB_OK, st = RB_MAXITER;
    for (int k = from; st > 0 && k < to; k++) {
        st = try_attempt(&s, &attempts[k]);
        if (first == RB_OK || first == RB_SINGULAR)
            first = st; /* what went wrong first is what is told */
        if (st > 0 && rb_friction_task_late(task))
            first = st = RB_INTERRUPTED;
        if (st == RB_INTERRUPTED)
            break;
    }
    rb_arena_free(&s.memory);
    return st > 0 ? first : st;
}

const rb_friction_method rb_friction_lemke_method = {.run = run_lemke};
