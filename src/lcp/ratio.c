#include "lcp/lemke.h"

#include <cblas.h>
#include <math.h>

/* Parts of the largest entry of a column: below DROP they are zeros, below NOISE no
 * pivots, below DOUBT pivots only in a tableau just rebuilt. Rows tie that the least
 * ratio brings below TIE of the largest constant, unless their own ratio is more than
 * NEAR away, relative to the step or to max |q| / max |a|.
 */
static const double DROP = 1e-13, NOISE = 1e-12, DOUBT = 1e-10, TIE = 1e-12, NEAR = 1e-10;

static double largest(int n, const double *x)
{
    return fabs(x[cblas_idamax(n, x, 1)]);
}

static void clean_column(lemke *l, int variable, double *x)
{
    rb_lcp_tableau_column(&l->t, -1 - l->t.place[variable], x);
    const double noise = DROP * largest(l->n, x);
    for (int i = 0; i < l->n; i++)
        if (fabs(x[i]) <= noise)
            x[i] = 0.0;
}

void rb_lcp_lemke_column(lemke *l, int variable)
{
    rb_lcp_lemke_prepare(l, -1 - l->t.place[variable]);
    clean_column(l, variable, l->a);
}

/* The row of the first pivot: the lexicographic minimum of (q_i, e_i)/d_i, that is the
 * least q_i/d_i and among equal ones the last; -1 when q >= 0. */
int rb_lcp_lemke_first_row(const lemke *l)
{
    int r = -1;
    double least = 0.0;
    for (int i = 0; i < l->n; i++) {
        const double ratio = l->data.q[i] / rb_lcp_cover(&l->data, i);
        const int wins =
            l->opt.rule == RB_LCP_LEXICOGRAPHIC ? ratio <= least : ratio < least;
        if (ratio < 0.0 && wins) {
            least = ratio;
            r = i;
        }
    }
    return r;
}

/* In lanes, so that comparisons need not wait for each other. */
static double least_of(int n, const double *x)
{
    enum { LANES = 16 };
    double least[LANES];
    int i = 0;
    for (int k = 0; k < LANES; k++)
        least[k] = INFINITY;
    for (; i + LANES <= n; i += LANES)
        for (int k = 0; k < LANES; k++)
            least[k] = x[i + k] < least[k] ? x[i + k] : least[k];
    for (; i < n; i++)
        least[0] = x[i] < least[0] ? x[i] : least[0];
    for (int k = 1; k < LANES; k++)
        least[0] = least[k] < least[0] ? least[k] : least[0];
    return least[0];
}

/* The least ratio, and the ratios (infinite where a row does not block); without
 * branches: signs follow no pattern. */
static double least_ratio(const lemke *l, double a_max, double *ratio)
{
    const double *a = l->a, *q = l->t.q, noise = -NOISE * a_max;
    for (int i = 0; i < l->n; i++) {
        const double down = a[i] < noise ? -a[i] : 1.0;
        const double x = (q[i] > 0.0 ? q[i] : 0.0) / down;
        ratio[i] = a[i] < noise ? x : INFINITY;
    }
    return least_of(l->n, ratio);
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
            rb_lcp_lemke_prepare_alone(l, -1 - l->t.place[j]);
            clean_column(l, j, l->other);
            count = keep_least(l, count, l->other);
        }
    }
    return l->tied[0];
}

/* The row that blocks the entering variable; -1: none does. */
int rb_lcp_lemke_blocking_row(lemke *l)
{
    const int count = tied_rows(l), z0_row = l->t.place[2 * l->n];
    if (!count)
        return -1;
    for (int k = 0; k < count; k++)
        if (l->tied[k] == z0_row)
            return z0_row; /* z0 leaves as soon as it can: that is a solution */
    return l->opt.rule == RB_LCP_FIRST_INDEX ? l->tied[0] : lexicographic_row(l, count);
}

int rb_lcp_lemke_pivot_holds(const lemke *l, int row)
{
    return l->rebuilt == l->info->iters || fabs(l->a[row]) > DOUBT * largest(l->n, l->a);
}
