#include "rollbem/lcp.h"
#include "lcp/tableau.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Entries of the driving column below this part of its largest count as zero; ratios
 * closer than this, relative to the step or to max |q| / max |a|, count as tied. */
static const double NOISE = 1e-12, TIE = 1e-13, NEAR = 1e-10, DROP = 1e-13;

/* The constants are refined whenever z0 has fallen by this factor. */
static const double REFRESH = 1e-3;

typedef struct {
    int n;
    const double *M, *q, *cover;
    int ldm;
    rb_lcp_options opt;
    lcp_tableau t;
    double *a, *other; /* n: driving column; a column of the lexicographic comparison */
    double *image;     /* n x (n + 2) for the trace, or NULL */
    int *tied;         /* n: rows that tie */
    double start, refreshed; /* z0 after the first pivot, at the last refresh */
    rb_lcp_info *info;
} lemke;

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

/* ---- Which row leaves ------------------------------------------------------------ */

static double largest(int n, const double *x)
{
    return fabs(x[cblas_idamax(n, x, 1)]);
}

/* The column of a nonbasic variable without the rounding errors that stand for zeros:
 * they would decide between rows that tie, and may be taken for pivots. */
static void clean_column(lemke *l, int variable, double *x)
{
    rb_lcp_tableau_column(&l->t, -1 - l->t.place[variable], x);
    const double noise = DROP * largest(l->n, x);
    for (int i = 0; i < l->n; i++)
        if (fabs(x[i]) <= noise)
            x[i] = 0.0;
}

static double cover_of(const lemke *l, int i)
{
    return l->cover ? l->cover[i] : 1.0;
}

/* The row of the first pivot: the lexicographic minimum of (q_i, e_i)/d_i, that is the
 * least q_i/d_i and among equal ones the last; -1 when q >= 0. */
static int first_row(const lemke *l)
{
    int r = -1;
    double least = 0.0;
    for (int i = 0; i < l->n; i++) {
        const double ratio = l->q[i] / cover_of(l, i);
        const int wins =
            l->opt.rule == RB_LCP_LEXICOGRAPHIC ? ratio <= least : ratio < least;
        if (ratio < 0.0 && wins) {
            least = ratio;
            r = i;
        }
    }
    return r;
}

/* The least ratio, and the ratios (infinite where a row does not block). */
static double least_ratio(const lemke *l, double a_max, double *ratio)
{
    const double *a = l->a, *q = l->t.q, noise = -NOISE * a_max;
    double least = INFINITY;
    for (int i = 0; i < l->n; i++)
        ratio[i] = a[i] < noise ? (q[i] > 0.0 ? q[i] : 0.0) / -a[i] : INFINITY;
    for (int i = 0; i < l->n; i++)
        least = ratio[i] < least ? ratio[i] : least;
    return least;
}

/* The rows that tie: the least ratio brings them to zero within rounding, and theirs is
 * so close that taking it instead leaves no row visibly negative.  Their number, 0 when
 * no row blocks. */
static int tied_rows(lemke *l)
{
    const int n = l->n;
    const double *a = l->a, *q = l->t.q;
    const double a_max = largest(n, a), q_max = largest(n, q);
    double *ratio = l->other;
    const double least = least_ratio(l, a_max, ratio);
    if (!isfinite(least))
        return 0;
    const double zero = TIE * (q_max + least * a_max);
    const double most = least + NEAR * fmax(least, q_max / a_max);
    int count = 0;
    for (int i = 0; i < n; i++)
        if (ratio[i] <= most && q[i] + least * a[i] <= zero)
            l->tied[count++] = i;
    return count;
}

/* Keeps the tied rows with the least -x_i / -a_i: of a column of the basis inverse. */
static int keep_least(lemke *l, int count, const double *x)
{
    double least = INFINITY;
    for (int k = 0; k < count; k++)
        least = fmin(least, x[l->tied[k]] / l->a[l->tied[k]]);
    const double zero = NOISE * (largest(l->n, x) + fabs(least) * largest(l->n, l->a));
    int kept = 0;
    for (int k = 0; k < count; k++)
        if (least * l->a[l->tied[k]] - x[l->tied[k]] <= zero)
            l->tied[kept++] = l->tied[k];
    return kept;
}

/* w_j basic in this row: its row of the basis inverse has a one there, the others zero.
 */
static int drop_row(lemke *l, int count, int row)
{
    int kept = 0;
    for (int k = 0; k < count; k++)
        if (l->tied[k] != row)
            l->tied[kept++] = l->tied[k];
    return kept ? kept : count;
}

/* The basis inverse restricted to the column of w_j is -T_:w_j where w_j is nonbasic, a
 * unit vector where it is basic.  Columns are looked at only as long as rows tie. */
static int lexicographic_row(lemke *l, int count)
{
    for (int j = 0; j < l->n && count > 1; j++) {
        if (l->t.place[j] >= 0) {
            count = drop_row(l, count, l->t.place[j]);
        } else {
            clean_column(l, j, l->other);
            count = keep_least(l, count, l->other);
        }
    }
    return l->tied[0];
}

/* The row that blocks the entering variable; -1: none does. */
static int blocking_row(lemke *l)
{
    const int count = tied_rows(l), z0_row = l->t.place[2 * l->n];
    if (!count)
        return -1;
    for (int k = 0; k < count; k++)
        if (l->tied[k] == z0_row)
            return z0_row; /* z0 leaves as soon as it can: that is a solution */
    return l->opt.rule == RB_LCP_FIRST_INDEX ? l->tied[0] : lexicographic_row(l, count);
}

/* ---- Pivots ---------------------------------------------------------------------- */

static int complement(int n, int variable)
{
    return variable < n ? variable + n : variable - n;
}

static double z0_value(const lemke *l)
{
    const int row = l->t.place[2 * l->n];
    return row >= 0 ? l->t.q[row] : 0.0;
}

static void take_image(lemke *l)
{
    const size_t n = (size_t)l->n;
    rb_lcp_tableau_flush(&l->t);
    memcpy(l->image, l->t.T, n * (n + 1) * sizeof(double));
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
        const rb_lcp_pivot seen = {iter,        entering,    leaving, row,
                                   t->q[row],   z0_value(l), l->n,    t->basis,
                                   t->nonbasis, l->image};
        l->opt.trace(&seen, l->opt.trace_context);
    }
    return leaving;
}

/* q + M z + d z0 - w of the basic point, which is zero but for the pivots' rounding. */
static void defect(lemke *l, double *z, double *r)
{
    const int n = l->n, *place = l->t.place;
    const double z0 = z0_value(l);
    for (int i = 0; i < n; i++)
        z[i] = place[n + i] >= 0 ? l->t.q[place[n + i]] : 0.0;
    rb_lcp_residual(n, l->M, l->ldm, l->q, z, r);
    for (int i = 0; i < n; i++)
        r[i] += cover_of(l, i) * z0 - (place[i] >= 0 ? l->t.q[place[i]] : 0.0);
}

/* One step of iterative refinement of the constants: the tableau's columns of w hold
 * minus the basis inverse.  Without it z0 drowns in rounding just when it should vanish.
 */
static void refresh(lemke *l)
{
    const int n = l->n, *place = l->t.place;
    double *r = l->a;
    defect(l, l->other, r);
    rb_lcp_tableau_flush(&l->t);
    for (int i = 0; i < n; i++)
        if (place[i] >= 0)
            l->t.q[place[i]] += r[i];
    for (int i = 0; i < n; i++)
        if (place[i] < 0)
            cblas_daxpy(n, -r[i], l->t.T + (size_t)(-1 - place[i]) * (size_t)n, 1, l->t.q,
                        1);
    l->refreshed = z0_value(l);
}

static rb_status ray(lemke *l, int entering)
{
    const int n = l->n;
    l->info->ray_variable = entering;
    return rb_fail(&l->info->msg, RB_RAY,
                   "lcp: secondary ray after %d pivots: no row blocks %c(%d); z0 = %g",
                   l->info->iters, entering < n ? 'w' : 'z', entering % n + 1,
                   z0_value(l));
}

static rb_status follow_path(lemke *l)
{
    const int z0 = 2 * l->n;
    int row = first_row(l), entering = z0;
    if (row < 0)
        return RB_OK;
    for (;;) {
        clean_column(l, entering, l->a);
        if (entering != z0)
            row = blocking_row(l);
        if (row < 0)
            return ray(l, entering);
        const int leaving = pivot(l, row, entering);
        if (entering == z0)
            l->start = l->refreshed = z0_value(l);
        if (leaving != z0 && z0_value(l) <= REFRESH * l->refreshed)
            refresh(l);
        if (leaving == z0 || z0_value(l) <= l->opt.tol * l->start)
            return RB_OK;
        if (l->info->iters >= l->opt.max_iters)
            return rb_fail(&l->info->msg, RB_MAXITER, "lcp: no solution after %d pivots",
                           l->info->iters);
        entering = complement(l->n, leaving);
    }
}

/* ---- The answer ------------------------------------------------------------------ */

static void basic_point(const lemke *l, double *z)
{
    const int n = l->n;
    for (int i = 0; i < n; i++) {
        const int row = l->t.place[n + i];
        z[i] = row >= 0 ? fmax(l->t.q[row], 0.0) : 0.0;
    }
}

/* x += the solution of M_BB dx = -(M x + q)_B; M_BB factored in LU, r: n of scratch. */
static int correct(const lemke *l, int m, const int *index, const double *LU,
                   const int *piv, double *r, double *x)
{
    rb_lcp_residual(l->n, l->M, l->ldm, l->q, x, l->a);
    for (int k = 0; k < m; k++)
        r[k] = -l->a[index[k]];
    if (LAPACKE_dgetrs_work(LAPACK_COL_MAJOR, 'N', m, 1, LU, m, piv, r, m))
        return 0;
    for (int k = 0; k < m; k++)
        x[index[k]] += r[k];
    return 1;
}

/* The pivots' rounding errors are removed: z_B from the final basis B and the original
 * matrix, one factorisation (in the tableau's memory) and one correction.  Taken only
 * when it is the better of the two. */
static void polish(lemke *l, double *z, double *x)
{
    const int n = l->n;
    int *index = l->tied, *piv = l->t.basis, m = 0;
    double *LU = l->t.T;
    for (int i = 0; i < n; i++)
        if (l->t.place[n + i] >= 0)
            index[m++] = i;
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++)
            LU[i + (size_t)j * (size_t)m] =
                l->M[(size_t)index[i] + (size_t)index[j] * (size_t)l->ldm];
    if (m == 0 || LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, m, m, LU, m, piv))
        return;
    memset(x, 0, (size_t)n * sizeof *x);
    if (!correct(l, m, index, LU, piv, l->other, x) ||
        !correct(l, m, index, LU, piv, l->other, x))
        return;
    for (int i = 0; i < n; i++)
        x[i] = fmax(x[i], 0.0);
    const double res = rb_lcp_residual(n, l->M, l->ldm, l->q, x, NULL);
    if (res <= l->info->res) {
        memcpy(z, x, (size_t)n * sizeof *z);
        l->info->res = res;
    }
}

static rb_status allocate(lemke *l)
{
    const size_t n = (size_t)l->n;
    const int traced = l->opt.trace && l->opt.trace_tableau;
    rb_status s = rb_lcp_tableau_create(l->n, l->M, l->ldm, l->q, l->cover, &l->t);
    l->a = rb_alloc(n, 2);
    l->tied = rb_alloc_int(n);
    l->image = traced ? rb_alloc(n, n + 2) : NULL;
    if (s != RB_OK || !l->a || !l->tied || (traced && !l->image))
        return rb_fail(&l->info->msg, RB_ENOMEM,
                       "lcp: no memory for a tableau of order %d (%.3g MB)", l->n,
                       8e-6 * (double)n * ((double)n + 2.0));
    l->other = l->a + n;
    return RB_OK;
}

rb_status rb_lcp_lemke(int n, const double *M, int ldm, const double *q,
                       const rb_lcp_options *opt, double *z, rb_lcp_info *info)
{
    rb_lcp_info unread;
    lemke l = {.n = n, .M = M, .ldm = ldm, .q = q, .info = info ? info : &unread};
    *l.info = (rb_lcp_info){.res = NAN, .ray_variable = -1};
    l.opt = opt ? *opt : rb_lcp_defaults();
    l.cover = l.opt.cover;
    rb_status s = check_input(n, M, ldm, q, &l.opt, &l.info->msg);
    if (s != RB_OK)
        return s;
    if (!l.opt.max_iters)
        l.opt.max_iters = 50 * n + 1000;
    s = allocate(&l);
    if (s == RB_OK) {
        s = follow_path(&l);
        basic_point(&l, z);
        l.info->res = rb_lcp_residual(n, M, ldm, q, z, NULL);
        if (s == RB_OK)
            polish(&l, z, l.t.q);
    }
    rb_lcp_tableau_free(&l.t);
    free(l.a);
    free(l.tied);
    free(l.image);
    return s;
}
