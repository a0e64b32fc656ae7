#include "lcp/lemke.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The constants are refined whenever z0 has fallen by this factor: otherwise z0 drowns in
 * rounding just when it should vanish. */
static const double REFRESH = 1e-3;

/* A solution whose residual is beyond this part of max |q| is none. */
static const double SPOILT = 1e-6;

rb_lcp_options rb_lcp_defaults(void)
{
    return (rb_lcp_options){.tol = 1e-13, .rule = RB_LCP_LEXICOGRAPHIC};
}

/* ---- Input ----------------------------------------------------------------------- */

/* The sum of absolute values tells at once that a column is finite. */
static rb_status check_column(int n, int j, const double *x, rb_message *why)
{
    if (isfinite(cblas_dasum(n, x, 1)))
        return RB_OK;
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return rb_fail(why, RB_EINVAL,
                           "lcp: M(%d, %d) = %g: expected a finite number", i + 1, j + 1,
                           x[i]);
    return RB_OK;
}

static rb_status check_numbers(int n, const double *M, int ldm, const double *q,
                               const double *cover, rb_message *why)
{
    for (int j = 0; j < n; j++)
        if (check_column(n, j, M + (size_t)j * (size_t)ldm, why) != RB_OK)
            return RB_EINVAL;
    for (int i = 0; i < n; i++) {
        if (!isfinite(q[i]))
            return rb_fail(why, RB_EINVAL, "lcp: q(%d) = %g: expected a finite number",
                           i + 1, q[i]);
        if (cover && !(isfinite(cover[i]) && cover[i] > 0.0))
            return rb_fail(why, RB_EINVAL, "lcp: cover(%d) = %g: expected a number > 0",
                           i + 1, cover[i]);
    }
    return RB_OK;
}

static rb_status check_input(int n, const double *M, int ldm, const double *q,
                             const rb_lcp_options *opt, rb_message *why)
{
    if (n < 1)
        return rb_fail(why, RB_EINVAL, "lcp: n = %d: expected at least 1", n);
    if (ldm < n)
        return rb_fail(why, RB_EINVAL, "lcp: ldm = %d: expected at least n = %d", ldm, n);
    if (opt->max_iters < 0)
        return rb_fail(why, RB_EINVAL, "lcp: max_iters = %d: expected >= 0",
                       opt->max_iters);
    if (!(opt->tol >= 0.0 && opt->tol < 1.0))
        return rb_fail(why, RB_EINVAL, "lcp: tol = %g: expected a number in [0, 1)",
                       opt->tol);
    return check_numbers(n, M, ldm, q, opt->cover, why);
}

/* ---- Pivots ---------------------------------------------------------------------- */

double rb_lcp_lemke_z0(const lemke *l)
{
    const int row = l->t.place[2 * l->n];
    return row >= 0 ? l->t.q[row] : 0.0;
}

static void take_image(lemke *l)
{
    const size_t n = (size_t)l->n;
    rb_lcp_tableau_flush(&l->t);
    for (int c = 0; c <= l->n; c++)
        rb_lcp_tableau_column(&l->t, c, l->image + (size_t)c * n);
    memcpy(l->image + n * (n + 1), l->t.q, n * sizeof(double));
}

/* Exchanges the nonbasic variable, whose column is in l->a, with the one of the row. */
static int pivot(lemke *l, int row, int entering)
{
    lcp_tableau *t = &l->t;
    const int leaving = t->basis[row], iter = l->info->iters++;
    rb_lcp_tableau_pivot(t, row, -1 - t->place[entering], l->a);
    if (l->opt.trace) {
        if (l->image)
            take_image(l);
        const rb_lcp_pivot seen = {
            iter, entering, leaving,     row,     t->q[row], rb_lcp_lemke_z0(l),
            l->n, t->basis, t->nonbasis, l->image};
        l->opt.trace(&seen, l->opt.trace_context);
    }
    return leaving;
}

static rb_status ray(lemke *l, int entering)
{
    const int n = l->n;
    l->info->ray_variable = entering;
    return rb_fail(&l->info->msg, RB_RAY,
                   "lcp: secondary ray after %d pivots: no row blocks %c(%d); z0 = %g",
                   l->info->iters, entering < n ? 'w' : 'z', entering % n + 1,
                   rb_lcp_lemke_z0(l));
}

/* The row that blocks the entering variable, whose column comes to l->a; -1: none does.
 * Where none does, or the pivot may be a rounding error, the column may be wrong. */
static rb_status find_row(lemke *l, int entering, int *row)
{
    rb_lcp_lemke_column(l, entering);
    *row = rb_lcp_lemke_blocking_row(l);
    if (*row >= 0 ? rb_lcp_lemke_pivot_holds(l, *row)
                  : rb_lcp_lemke_column_holds(l, entering))
        return RB_OK;
    const rb_status s = rb_lcp_lemke_rebuild(l);
    if (s == RB_OK) {
        rb_lcp_lemke_column(l, entering);
        *row = rb_lcp_lemke_blocking_row(l);
    }
    return s == RB_ENOMEM ? s : RB_OK;
}

/* Errors are looked at when z0 has fallen, and now and then. */
static rb_status keep_accurate(lemke *l)
{
    const int due = l->info->iters - l->checked >= 50 + l->n / 4;
    return due || rb_lcp_lemke_z0(l) <= REFRESH * l->refreshed ? rb_lcp_lemke_refresh(l)
                                                               : RB_OK;
}

/* After z0 has entered, until it leaves or vanishes. */
static rb_status follow_path(lemke *l, int entering)
{
    for (;;) {
        int row;
        rb_status s = find_row(l, entering, &row);
        if (s == RB_OK && row < 0)
            s = ray(l, entering);
        if (s != RB_OK)
            return s;
        const int leaving = pivot(l, row, entering);
        if (leaving == 2 * l->n)
            return RB_OK;
        s = keep_accurate(l);
        if (s != RB_OK || rb_lcp_lemke_z0(l) <= l->opt.tol * l->start)
            return s;
        if (l->info->iters >= l->opt.max_iters)
            return rb_fail(&l->info->msg, RB_MAXITER, "lcp: no solution after %d pivots",
                           l->info->iters);
        entering = rb_lcp_complement(l->n, leaving);
    }
}

static rb_status run(lemke *l)
{
    const int row = rb_lcp_lemke_first_row(l), z0 = 2 * l->n;
    if (row < 0)
        return RB_OK;
    rb_lcp_lemke_column(l, z0);
    const int leaving = pivot(l, row, z0);
    l->start = l->refreshed = rb_lcp_lemke_z0(l);
    return follow_path(l, rb_lcp_complement(l->n, leaving));
}

static rb_status judge(lemke *l)
{
    const double size = rb_norm_inf((size_t)l->n, l->data.q);
    return l->info->res <= SPOILT * size
               ? RB_OK
               : rb_fail(
                     &l->info->msg, RB_INACCURATE,
                     "lcp: rounding has spoilt the solution: residual %g after %d pivots",
                     l->info->res, l->info->iters);
}

/* ---- All together ---------------------------------------------------------------- */

static double largest_entry(const lcp_data *data)
{
    double largest = 0.0;
    for (int j = 0; j < data->n; j++) {
        const double *x = data->M + (size_t)j * (size_t)data->ldm;
        largest = fmax(largest, fabs(x[cblas_idamax(data->n, x, 1)]));
    }
    return largest;
}

static rb_status allocate(lemke *l)
{
    const size_t n = (size_t)l->n;
    const int traced = l->opt.trace && l->opt.trace_tableau;
    const rb_status s = rb_lcp_tableau_create(&l->data, &l->t);
    l->a = rb_alloc(n + 1, 6);
    l->tied = rb_alloc_int(2 * n + 1);
    l->image = traced ? rb_alloc(n, n + 2) : NULL;
    if (s != RB_OK || !l->a || !l->tied || (traced && !l->image))
        return rb_fail(&l->info->msg, RB_ENOMEM,
                       "lcp: no memory for a tableau of order %d (%.3g MB)", l->n,
                       8e-6 * (double)n * ((double)n + 2.0));
    l->other = l->a + n;
    l->scratch = l->other + n;
    l->r = l->scratch + n;
    l->sum = l->r + n;
    l->weight = l->sum + n;
    l->near = l->tied + n;
    return RB_OK;
}

static void release(lemke *l)
{
    rb_lcp_tableau_free(&l->t);
    free(l->a);
    free(l->tied);
    free(l->image);
}

rb_status rb_lcp_lemke(int n, const double *M, int ldm, const double *q,
                       const rb_lcp_options *opt, double *z, rb_lcp_info *info)
{
    rb_lcp_info unread;
    lemke l = {.n = n, .info = info ? info : &unread};
    *l.info = (rb_lcp_info){.res = NAN, .ray_variable = -1};
    l.opt = opt ? *opt : rb_lcp_defaults();
    l.data = (lcp_data){n, M, q, l.opt.cover, ldm};
    rb_status s = check_input(n, M, ldm, q, &l.opt, &l.info->msg);
    if (s != RB_OK)
        return s;
    if (!l.opt.max_iters)
        l.opt.max_iters = 50 * n + 1000;
    s = allocate(&l);
    if (s == RB_OK) {
        l.largest = largest_entry(&l.data);
        s = run(&l);
        rb_lcp_lemke_answer(&l, s == RB_OK, z);
    }
    if (s == RB_OK)
        s = judge(&l);
    release(&l);
    return s;
}
