/* Equilibria of bimatrix games by the method of Lemke and Howson (SIAM Journal 12, 1964),
 * in the form with two tableaus (Cottle, Pang, Stone, section 4.4). */
#include "lcp/lemke.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the largest entry below which ratios tie, and entries are no pivots. */
static const double TIE = 1e-11, NOISE = 1e-11;

/* s = 1 - P v >= 0, v >= 0: the best replies of one player, P the other player's payoffs
 * made positive.  A column per label: a label belongs to a strategy, that is to one v
 * and, in the other tableau, to one s.  Row-major: rows of labels + 1 numbers, the last
 * one the right-hand side. */
typedef struct {
    int rows, width;
    double *T;  /* rows x width; owned */
    int *basis; /* rows: labels; owned */
    int first;  /* label of the s of row 0 */
} tableau;

static double *row_of(const tableau *t, int row)
{
    return t->T + (size_t)row * (size_t)t->width;
}

static rb_status create(int rows, int labels, int first, tableau *t)
{
    *t = (tableau){.rows = rows, .width = labels + 1, .first = first};
    t->T = rb_alloc((size_t)rows, (size_t)labels + 1);
    t->basis = rb_alloc_int((size_t)rows);
    if (!t->T || !t->basis)
        return RB_ENOMEM;
    for (int r = 0; r < rows; r++) {
        row_of(t, r)[first + r] = 1.0;
        row_of(t, r)[labels] = 1.0;
        t->basis[r] = first + r;
    }
    return RB_OK;
}

static void release(tableau *t)
{
    free(t->T);
    free(t->basis);
}

/* The row that blocks the entering label: least ratio of the right-hand side, then of the
 * columns of s, which are the basis inverse, one after the other (lexicographic). */
static int blocking_row(const tableau *t, int entering, int *tied)
{
    double most = 0.0;
    int count = 0;
    for (int r = 0; r < t->rows; r++)
        most = fmax(most, fabs(row_of(t, r)[entering]));
    for (int r = 0; r < t->rows; r++)
        if (row_of(t, r)[entering] > NOISE * most)
            tied[count++] = r;
    for (int k = -1; k < t->rows && count > 1; k++) {
        const int column = k < 0 ? t->width - 1 : t->first + k;
        double least = INFINITY, size = 0.0;
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const double ratio =
                row_of(t, tied[i])[column] / row_of(t, tied[i])[entering];
            least = fmin(least, ratio);
            size = fmax(size, fabs(ratio));
        }
        for (int i = 0; i < count; i++) {
            const double *row = row_of(t, tied[i]);
            if (row[column] / row[entering] - least <=
                TIE * fmax(fabs(least), TIE * size))
                tied[kept++] = tied[i];
        }
        count = kept;
    }
    return count ? tied[0] : -1;
}

static void pivot(tableau *t, int row, int entering)
{
    double *own = row_of(t, row);
    cblas_dscal(t->width, 1.0 / own[entering], own, 1);
    own[entering] = 1.0;
    for (int r = 0; r < t->rows; r++) {
        double *other = row_of(t, r);
        const double factor = other[entering];
        if (r == row || factor == 0.0)
            continue;
        cblas_daxpy(t->width, -factor, own, 1, other, 1);
        other[entering] = 0.0;
        if (other[t->width - 1] < 0.0) /* rounding of a tie */
            other[t->width - 1] = 0.0;
    }
    t->basis[row] = entering;
}

/* x = the v of the tableau, which add up to 1. */
static void strategy(const tableau *t, int first, int count, double *x)
{
    double sum = 0.0;
    memset(x, 0, (size_t)count * sizeof *x);
    for (int r = 0; r < t->rows; r++) {
        const int k = t->basis[r] - first;
        if (k >= 0 && k < count)
            sum += x[k] = fmax(row_of(t, r)[t->width - 1], 0.0);
    }
    if (sum > 0.0)
        cblas_dscal(count, 1.0 / sum, x, 1);
}

static double least_of(int m, int n, const double *A, int ld)
{
    double least = INFINITY;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++)
            least = fmin(least, A[(size_t)i + (size_t)j * (size_t)ld]);
    return least;
}

static double spread_of(int m, int n, const double *A, int ld)
{
    double most = 0.0;
    const double least = least_of(m, n, A, ld);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++)
            most = fmax(most, A[(size_t)i + (size_t)j * (size_t)ld] - least);
    return most > 0.0 ? most : 1.0;
}

/* Payoffs from 1 to 2: adding to them and multiplying them changes no equilibrium. */
static void fill(int m, int n, const double *A, const double *B, int ld, tableau *of_x,
                 tableau *of_y)
{
    const double low_a = least_of(m, n, A, ld), wide_a = spread_of(m, n, A, ld);
    const double low_b = least_of(m, n, B, ld), wide_b = spread_of(m, n, B, ld);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            const size_t at = (size_t)i + (size_t)j * (size_t)ld;
            row_of(of_x, j)[i] = 1.0 + (B[at] - low_b) / wide_b;
            row_of(of_y, i)[m + j] = 1.0 + (A[at] - low_a) / wide_a;
        }
}

static void tell_trace(const rb_lcp_options *opt, const rb_lcp_info *info, int labels,
                       int entering, int leaving, int row, double ratio)
{
    const rb_lcp_pivot seen = {.pivot = info->iters,
                               .entering = entering,
                               .leaving = leaving,
                               .row = row,
                               .ratio = ratio,
                               .attempt = opt->attempt,
                               .n = labels};
    if (opt->trace)
        opt->trace(&seen, opt->trace_context);
}

/* Drops the label, and then in turn every label that the last pivot has doubled, from the
 * tableau where it can enter, until the dropped one is back. */
static rb_status follow_path(int m, int labels, int dropped, tableau *of_x, tableau *of_y,
                             const rb_lcp_options *opt, int *tied, rb_lcp_info *info)
{
    tableau *t = dropped < m ? of_x : of_y;
    int entering = dropped, leaving = -1;
    const double start = rb_seconds();
    while (leaving != dropped) {
        const rb_status s = rb_lcp_check_limits(info, opt, start);
        if (s != RB_OK)
            return s;
        const int row = blocking_row(t, entering, tied);
        if (row < 0)
            return rb_fail(&info->msg, RB_INACCURATE,
                           "lcp: rounding has spoilt the path after %d pivots",
                           info->iters);
        leaving = t->basis[row];
        pivot(t, row, entering);
        const int enters_v = (entering < m) == (t == of_x);
        const int leaves_v = (leaving < m) == (t == of_x);
        tell_trace(opt, info, labels, entering + (enters_v ? labels : 0),
                   leaving + (leaves_v ? labels : 0), t == of_x ? m + row : row,
                   row_of(t, row)[t->width - 1]);
        info->iters++;
        entering = leaving;
        t = t == of_x ? of_y : of_x;
    }
    return RB_OK;
}

double rb_lcp_bimatrix_regret(int m, int n, const double *A, const double *B, int ld,
                              const double *x, const double *y, double *regret,
                              double payoff[2])
{
    double worst = 0.0;
    payoff[0] = payoff[1] = -INFINITY;
    cblas_dgemv(CblasColMajor, CblasNoTrans, m, n, -1.0, A, ld, y, 1, 0.0, regret, 1);
    cblas_dgemv(CblasColMajor, CblasTrans, m, n, -1.0, B, ld, x, 1, 0.0, regret + m, 1);
    for (int k = 0; k < m + n; k++)
        payoff[k >= m] = fmax(payoff[k >= m], -regret[k]);
    for (int k = 0; k < m + n; k++) {
        const double z = k < m ? x[k] : y[k - m];
        regret[k] += payoff[k >= m];
        if (isnan(z) || isnan(regret[k]))
            return NAN;
        worst = fmax(worst, fmin(z, regret[k]));
    }
    return worst;
}

static rb_status check_input(int m, int n, const double *A, const double *B, int ld,
                             int label, rb_message *why)
{
    if (m < 1 || n < 1 || ld < m)
        return rb_fail(why, RB_EINVAL,
                       "lcp: a game of %d by %d, ld = %d: expected 1 <= m "
                       "<= ld, 1 <= n",
                       m, n, ld);
    if (label < 0 || label >= m + n)
        return rb_fail(why, RB_EINVAL, "lcp: label %d: expected 1 to %d", label + 1,
                       m + n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            const size_t at = (size_t)i + (size_t)j * (size_t)ld;
            if (!isfinite(A[at]) || !isfinite(B[at]))
                return rb_fail(why, RB_EINVAL,
                               "lcp: %c(%d, %d): expected a finite number",
                               isfinite(A[at]) ? 'B' : 'A', i + 1, j + 1);
        }
    return RB_OK;
}

rb_status rb_lcp_bimatrix(int m, int n, const double *A, const double *B, int ld,
                          int label, const rb_lcp_options *opt, double *x, double *y,
                          rb_lcp_info *info)
{
    rb_lcp_info unread;
    rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    tableau of_x = {0}, of_y = {0};
    info = info ? info : &unread;
    *info = (rb_lcp_info){.res = NAN, .ray_variable = -1};
    rb_status s = check_input(m, n, A, B, ld, label, &info->msg);
    if (s != RB_OK)
        return s;
    const int labels = m + n;
    if (!o.max_iters)
        o.max_iters = 50 * labels + 1000;
    int *tied = rb_alloc_int((size_t)labels);
    double *regret = rb_alloc((size_t)labels, 1), payoff[2];
    if (create(n, labels, m, &of_x) != RB_OK || create(m, labels, 0, &of_y) != RB_OK ||
        !tied || !regret)
        s = rb_fail(&info->msg, RB_ENOMEM, "lcp: out of memory for a game of %d by %d", m,
                    n);
    if (s == RB_OK) {
        fill(m, n, A, B, ld, &of_x, &of_y);
        s = follow_path(m, labels, label, &of_x, &of_y, &o, tied, info);
        strategy(&of_x, 0, m, x);
        strategy(&of_y, m, n, y);
        info->res = rb_lcp_bimatrix_regret(m, n, A, B, ld, x, y, regret, payoff);
    }
    if (s == RB_OK)
        s = rb_lcp_judge(info, fmax(spread_of(m, n, A, ld), spread_of(m, n, B, ld)));
    release(&of_x);
    release(&of_y);
    free(tied);
    free(regret);
    return s;
}

/* ---- All equilibria ---------------------------------------------------------------- */

/* Each half of a solution becomes a strategy: its probabilities add up to 1. */
static void normalise(int m, int n, rb_lcp_solutions *all)
{
    for (int k = 0; k < all->count; k++) {
        double *x = all->z + (size_t)k * (size_t)(m + n), *y = x + m;
        cblas_dscal(m, 1.0 / rb_norm_1((size_t)m, x, 1), x, 1);
        cblas_dscal(n, 1.0 / rb_norm_1((size_t)n, y, 1), y, 1);
    }
}

/* With payoffs turned into costs a, b > 0 an equilibrium is, but for the length of its
 * halves, a solution of the LCP with M = [0 a; b' 0] and q = -1 (Cottle, Pang, Stone,
 * section 1.2); w >= 0 leaves neither half of it zero. */
rb_status rb_lcp_bimatrix_enumerate(int m, int n, const double *A, const double *B,
                                    int ld, rb_lcp_solutions *all, rb_message *why)
{
    const int order = m + n;
    *all = (rb_lcp_solutions){0};
    rb_status s = check_input(m, n, A, B, ld, 0, why);
    if (s != RB_OK)
        return s;
    double *M = rb_alloc((size_t)order, (size_t)order + 1), *q = NULL;
    if (!M)
        return rb_fail(why, RB_ENOMEM, "lcp: out of memory for a game of %d by %d", m, n);
    q = M + (size_t)order * (size_t)order;
    const double low_a = least_of(m, n, A, ld), wide_a = spread_of(m, n, A, ld);
    const double low_b = least_of(m, n, B, ld), wide_b = spread_of(m, n, B, ld);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            const size_t at = (size_t)i + (size_t)j * (size_t)ld;
            M[i + (m + j) * order] = 2.0 - (A[at] - low_a) / wide_a;
            M[m + j + i * order] = 2.0 - (B[at] - low_b) / wide_b;
        }
    for (int k = 0; k < order; k++)
        q[k] = -1.0;
    s = rb_lcp_enumerate(order, M, order, q, NULL, NULL, all, why);
    if (s == RB_OK)
        normalise(m, n, all);
    free(M);
    return s;
}
