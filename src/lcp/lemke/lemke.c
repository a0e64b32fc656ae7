/* Lemke's method with a lexicographic rule (Cottle, Pang, Stone, algorithm 4.4.5): from
 * the first pivot to the ratio test, the path of complementary pivots and its end. */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A solution with a row whose residual is above this part of its terms is spoilt by
 * rounding. */
static const double SPOILT = 1e-10;

rb_lcp_options rb_lcp_defaults(void)
{
    return (rb_lcp_options){.rule = RB_LCP_LEXICOGRAPHIC};
}

/* ---- The ratio test: which row leaves ---------------------------------------------- */

static double largest(int n, const double *x)
{
    return fabs(x[cblas_idamax(n, x, 1)]);
}

/* x = the column of a nonbasic variable.  Rounding errors that stand for zeros are set to
 * zero: they would decide between rows that tie, and might be taken for pivots. */
static void clean_column(lemke *l, int variable, double *x)
{
    rb_lcp_tableau_column(&l->t, -1 - l->t.place[variable], x);
    const double noise = DROP * largest(l->n, x);
    for (int i = 0; i < l->n; i++)
        if (fabs(x[i]) <= noise)
            x[i] = 0.0;
}

/* l->a = the column of the entering variable. */
static void driving_column(lemke *l, int entering)
{
    rb_lcp_tableau_fetch(&l->t, -1 - l->t.place[entering], l->a);
    clean_column(l, entering, l->a);
}

/* The row that blocks the variable whose column is l->a; -1: none does.  z0 leaves as
 * soon as it can, because that is a solution. */
static int blocking_row(lemke *l)
{
    enum { LANES = 16 };
    const int n = l->n, z0_row = l->t.place[2 * n];
    const double *a = l->a, *q = l->t.q;
    const double a_max = largest(n, a), q_max = largest(n, q), noise = -NOISE * a_max;
    double *ratio = l->other, least[LANES];

    /* No branches, because the signs of a follow no pattern; the least ratio in lanes that
     * need not wait for each other's comparison. */
    for (int i = 0; i < n; i++) {
        const double down = a[i] < noise ? -a[i] : 1.0;
        const double x = (q[i] > 0.0 ? q[i] : 0.0) / down;
        ratio[i] = a[i] < noise ? x : INFINITY;
    }
    int at = 0;
    for (int k = 0; k < LANES; k++)
        least[k] = INFINITY;
    for (; at + LANES <= n; at += LANES)
        for (int k = 0; k < LANES; k++)
            least[k] = ratio[at + k] < least[k] ? ratio[at + k] : least[k];
    for (; at < n; at++)
        least[0] = ratio[at] < least[0] ? ratio[at] : least[0];
    for (int k = 1; k < LANES; k++)
        least[0] = least[k] < least[0] ? least[k] : least[0];
    if (!isfinite(least[0]))
        return -1;

    /* The rows that tie: the least ratio brings them to zero within rounding, and their
     * own ratio is so close to it that taking it instead leaves no row visibly negative. */
    const double step = least[0], zero = TIE * (q_max + step * a_max);
    const double most = step + NEAR * fmax(step, q_max / a_max);
    int count = 0;
    for (int i = 0; i < n; i++)
        if (ratio[i] <= most && q[i] + step * a[i] <= zero)
            l->tied[count++] = i;
    for (int k = 0; k < count; k++)
        if (l->tied[k] == z0_row)
            return z0_row;
    if (!count)
        return -1;

    /* The lexicographic rule.  The basis inverse restricted to the column of w_j is -T_:w_j
     * where w_j is nonbasic, a unit vector where it is basic.  Columns are looked at only
     * as long as rows tie. */
    for (int j = 0; l->posed.opt.rule != RB_LCP_FIRST_INDEX && j < n && count > 1; j++) {
        const int row = l->t.place[j];
        int kept = 0;
        if (row >= 0) {
            /* w_j is basic in this row, which has a one in that column of the basis
             * inverse; the other rows, of which there is one at least, have a zero and
             * win. */
            for (int k = 0; k < count; k++)
                if (l->tied[k] != row)
                    l->tied[kept++] = l->tied[k];
        } else {
            rb_lcp_tableau_fetch(&l->t, -1 - row, NULL);
            clean_column(l, j, l->other);
            /* Keeps the tied rows with the least x_i/a_i, x being minus a column of the
             * basis inverse. */
            double first = INFINITY;
            for (int k = 0; k < count; k++)
                first = fmin(first, l->other[l->tied[k]] / a[l->tied[k]]);
            const double same = NOISE * (largest(n, l->other) + fabs(first) * largest(n, a));
            for (int k = 0; k < count; k++)
                if (first * a[l->tied[k]] - l->other[l->tied[k]] <= same)
                    l->tied[kept++] = l->tied[k];
        }
        count = kept;
    }
    return l->tied[0];
}

/* ---- The path ---------------------------------------------------------------------- */

/* Exchanges the entering variable, whose column is in l->a, with the basic one of the
 * row, which is returned. */
static int pivot(lemke *l, int row, int entering)
{
    lcp_tableau *t = &l->t;
    const int leaving = t->basis[row], iter = l->info->iters++;
    rb_lcp_tableau_pivot(t, row, -1 - t->place[entering], l->a);
    if (l->posed.opt.trace) {
        /* Hands the pivot to the trace, with the whole tableau where that is wanted. */
        rb_lcp_pivot record = {.pivot = iter,
                               .entering = entering,
                               .leaving = leaving,
                               .row = row,
                               .ratio = t->q[row],
                               .z0 = lemke_z0(l),
                               .attempt = l->posed.opt.attempt,
                               .n = l->n,
                               .basis = t->basis,
                               .value = t->q,
                               .nonbasis = t->nonbasis};
        const size_t n = (size_t)l->n;
        if (l->image) {
            rb_lcp_tableau_flush(&l->t);
            for (int c = 0; c <= l->n; c++)
                rb_lcp_tableau_column(&l->t, c, l->image + (size_t)c * n);
            memcpy(l->image + n * (n + 1), l->t.q, n * sizeof(double));
        }
        record.tableau = l->image;
        l->posed.opt.trace(&record, l->posed.opt.trace_context);
    }
    return leaving;
}

rb_status rb_lcp_check_limits(rb_lcp_info *info, const rb_lcp_options *opt, int n, double start)
{
    const int most = opt->max_iters ? opt->max_iters : 50 * n + 1000;
    if (info->iters >= most)
        return rb_fail(&info->msg, RB_MAXITER, "lcp: no solution after max_iters = %d pivot%s",
                       most, rb_plural(most));
    if (opt->seconds > 0.0 && rb_seconds() - start > opt->seconds)
        return rb_fail(&info->msg, RB_TIME_LIMIT, "lcp: no solution after %d pivot%s in %g s",
                       info->iters, rb_plural(info->iters), opt->seconds);
    if (rb_interrupted())
        return rb_fail(&info->msg, RB_INTERRUPTED, "lcp: interrupted after %d pivot%s", info->iters,
                       rb_plural(info->iters));
    return RB_OK;
}

rb_status rb_lcp_assess(rb_lcp_info *info)
{
    return info->scaled <= SPOILT
               ? RB_OK
               : rb_fail(&info->msg, RB_INACCURATE,
                         "lcp: rounding errors make the solution inaccurate: the "
                         "residual of row %d is %.2g of its terms after %d step%s",
                         info->row + 1, info->scaled, info->iters, rb_plural(info->iters));
}

static rb_status fail_memory(lemke *l)
{
    const double n = l->n;
    return rb_fail(&l->info->msg, RB_ENOMEM,
                   "lcp: out of memory for a tableau of order %d (%.3g MB)", l->n,
                   8e-6 * n * (n + 2.0));
}

static void take_generic_cover(lemke *l)
{
    double *cover = l->weight + l->n + 1;
    rb_lcp_generic_cover(l->n, cover);
    l->data.cover = cover;
    l->work.ones = 0;
}

/* The path with ones is left: another one from the beginning, with a generic cover. */
static rb_status begin_again(lemke *l)
{
    l->short_path = 0;
    l->leaving = -1;
    l->checked = l->rebuilt = l->info->iters;
    l->info->ray_variable = -1;
    l->info->msg.text[0] = '\0';
    take_generic_cover(l);
    rb_lcp_tableau_free(&l->t);
    return rb_lcp_tableau_create(&l->data, &l->t) == RB_OK ? RB_OK : fail_memory(l);
}

/* Lemke's path: z0 enters and makes w = q + M z + d z0 >= 0; then the complement of what has left
 * enters, until z0 leaves or vanishes (solved) or nothing blocks the entering variable (secondary
 * ray). */
static rb_status follow_path(void *state)
{
    lemke *l = state;
    const int z0 = 2 * l->n;
    int row = 0;
    if (l->leaving < 0) {
        /* The row of the first pivot: the lexicographic minimum of (q_i, e_i)/d_i, that
         * is the least q_i/d_i and among equal ones the last; none when q >= 0.  Where
         * d_i = 0 q_i is not negative, and no z0 changes w_i. */
        row = -1;
        double least = 0.0;
        for (int i = 0; i < l->n; i++) {
            if (l->data.p.q[i] >= 0.0)
                continue;
            const double ratio = l->data.p.q[i] / rb_lcp_cover(&l->data, i);
            const int wins =
                l->posed.opt.rule == RB_LCP_LEXICOGRAPHIC ? ratio <= least : ratio < least;
            if (wins) {
                least = ratio;
                row = i;
            }
        }
        if (row < 0)
            return RB_OK;
        driving_column(l, z0);
        l->leaving = pivot(l, row, z0);
        l->start = l->refreshed = lemke_z0(l);
    }
    while (!rb_lcp_pauses(&l->work)) {
        /* The complement of what has left enters: w_i after z_i, z_i after w_i, so that z'w stays
         * zero. */
        const int entering = rb_lcp_complement(l->n, l->leaving);
        rb_status s = rb_lcp_check_limits(l->info, &l->posed.opt, l->n, l->task->began);
        if (s == RB_OK) {
            /* It grows until a basic variable falls to zero: that one blocks it. */
            driving_column(l, entering);
            row = blocking_row(l);
            /* A pivot near rounding and the absence of one are believed only when the
             * column holds for the original matrix; else the tableau is rebuilt and the
             * column formed once more. */
            const int holds = row < 0 ? rb_lcp_lemke_column_holds(l, entering)
                                      : l->rebuilt == l->info->iters ||
                                            fabs(l->a[row]) > DOUBT * largest(l->n, l->a);
            if (!holds && (s = rb_lcp_lemke_rebuild(l)) == RB_OK) {
                driving_column(l, entering);
                row = blocking_row(l);
            }
            if (s != RB_ENOMEM) /* a basis that is singular leaves the tableau as it was */
                s = RB_OK;
        }
        if (s == RB_OK && row < 0) {
            /* Nothing blocks it: z moves along a ray, by so much per unit of what enters. */
            for (int i = 0; i < l->n; i++) {
                const int at = l->t.place[l->n + i];
                l->other[i] = at >= 0 ? l->a[at] : (double)(entering == l->n + i);
            }
            s = rb_lcp_fail_ray(l->info, &l->posed, entering, lemke_z0(l), l->other);
        }
        /* A path with ones that is long or fails is left for one with a generic cover. */
        if (l->short_path &&
            (s == RB_RAY || s == RB_NUMERICAL || l->info->iters >= l->short_path)) {
            s = begin_again(l);
            return s == RB_OK ? follow_path(l) : s;
        }
        if (s != RB_OK)
            return s;
        /* Entering and blocking variable change places.  When z0 has left, w = M z + q: z solves
         * the problem. */
        l->leaving = pivot(l, row, entering);
        l->work.used += rb_lcp_work_of_pivot(l->n);
        if (l->leaving == z0)
            return RB_OK;
        /* Rounding errors of the pivots are taken out, and z0 that has vanished is as good as one
         * that has left. */
        s = rb_lcp_lemke_keep_accurate(l);
        if (s != RB_OK || lemke_z0(l) <= VANISHED * l->start)
            return s;
    }
    return RB_OK;
}

/* ---- All together ------------------------------------------------------------------ */

static rb_status begin_lemke(const lcp_task *task, int balance_q, rb_lcp_info *info, void *state)
{
    lemke *l = state;
    const int n = task->M.n;
    *l = (lemke){.work.allowed = INFINITY, .task = task, .leaving = -1, .n = n, .info = info};
    rb_status s = rb_lcp_pose(&task->M, task->q, NULL, NULL, task->opt, balance_q, &l->posed);
    if (s == RB_ENOMEM)
        s = fail_memory(l);
    else {
        const lcp_posed *p = &l->posed;
        l->data = (lcp_data){{n, p->M.dense, p->M.ld, p->q}, p->opt.cover};
        const int traced = p->opt.trace && p->opt.trace_tableau;
        const rb_status status = rb_lcp_tableau_create(&l->data, &l->t);
        l->a = rb_alloc((size_t)l->n + 1, 7);
        l->tied = rb_alloc_int((size_t)l->n);
        l->image = traced ? rb_alloc((size_t)l->n, (size_t)l->n + 2) : NULL;
        if (status != RB_OK || !l->a || !l->tied || (traced && !l->image))
            s = fail_memory(l);
        else {
            l->other = l->a + (size_t)l->n;
            l->scratch = l->other + (size_t)l->n;
            l->r = l->scratch + (size_t)l->n;
            l->sum = l->r + (size_t)l->n;
            l->weight = l->sum + (size_t)l->n;
            s = RB_OK;
        }
    }
    if (s == RB_OK) {
        l->work.ones = !l->data.cover;
        if (l->work.ones && l->task->generic == LCP_GENERIC_FOR_TIES)
            l->short_path = rb_lcp_pivots_with_ones(n, l->data.p.q);
        if (l->work.ones && l->task->generic == LCP_GENERIC)
            take_generic_cover(l);
    }
    return s;
}

static rb_status end_lemke(void *state, rb_status s, double *z)
{
    lemke *l = state;
    const lcp_task *task = l->task;
    if (s >= 0) {
        rb_lcp_lemke_answer(l, s == RB_OK, z);
        rb_lcp_scale_back(&l->posed, z);
        if (rb_lcp_measure(&task->M, &l->posed.scale, task->q, NULL, NULL, z, l->info) != RB_OK)
            s = fail_memory(l);
    }
    if (s == RB_OK)
        s = rb_lcp_assess(l->info);
    rb_lcp_tableau_free(&l->t);
    free(l->a);
    free(l->tied);
    free(l->image);
    rb_lcp_posed_free(&l->posed);
    return s;
}

const lcp_method rb_lcp_tableau_method = {"lemke", sizeof(lemke), begin_lemke, follow_path,
                                          end_lemke};

rb_status rb_lcp_run(const lcp_method *method, const lcp_task *task, void *state, double *z,
                     rb_lcp_info *info)
{
    int first = 0;
    rb_status s = RB_OK;
    for (int balance_q = 0; balance_q < 2; balance_q++) {
        *info = RB_LCP_INFO_NONE;
        s = method->begin(task, balance_q, info, state);
        if (s == RB_OK)
            s = method->go_on(state);
        s = method->end(state, s, z);
        info->iters += first;
        first = info->iters;
        if (s != RB_INACCURATE)
            break;
    }
    info->solver = method->name;
    return s;
}

rb_status rb_lcp_lemke(const rb_lcp_problem *p, const rb_lcp_options *opt, double *z,
                       rb_lcp_info *info)
{
    const rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    const rb_status s = rb_lcp_check_dense(p, &o, &info->msg);
    if (s != RB_OK)
        return s;
    const lcp_task task = {
        .M = {.n = p->n, .dense = p->M, .ld = p->ldm}, .q = p->q, .opt = &o, .began = rb_seconds()};
    lemke l;
    return rb_lcp_run(&rb_lcp_tableau_method, &task, &l, z, info);
}
