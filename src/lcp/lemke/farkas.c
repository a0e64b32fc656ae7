/* Proofs that there is a solution, or that there is none. */
#include "lcp/lemke/farkas.h"
#include "lcp/lemke/lemke.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

/* What has a wrong sign below this part of its terms is looked at as rounding; and what is
 * left of it must not let in any z below so many times the largest |q|. */
static const double ROUNDING = 1e-9, FAR = 1e8;

typedef struct {
    double least, most;
} interval;

/* Where y_i may lie: y_i w_i >= 0 for every w_i that side and bounds allow. */
static interval of_multiplier(lcp_side side, double low, double high)
{
    if (low == high || side == LCP_LEFT_OUT)
        return (interval){0.0, 0.0};
    if (side == LCP_BETWEEN)
        return (interval){-INFINITY, INFINITY};
    const int at_lower = side == LCP_AT_LOWER || (side == LCP_OPEN && isfinite(low));
    const int at_upper = side == LCP_AT_UPPER || (side == LCP_OPEN && isfinite(high));
    return (interval){at_upper && !at_lower ? -INFINITY
                      : at_lower            ? 0.0
                                            : -INFINITY,
                      at_lower && !at_upper ? INFINITY
                      : at_upper            ? 0.0
                                            : INFINITY};
}

double rb_lcp_multiplier(lcp_side side, double low, double high, double y)
{
    const interval may = of_multiplier(side, low, high);
    return fmin(fmax(y, may.least), may.most);
}

int rb_lcp_excludes(const lcp_matrix *M, const double *q, const double *lower, const double *upper,
                    const lcp_side *side, double *y)
{
    const int n = M->n;
    const double most = rb_norm_inf((size_t)n, y);
    double value = 0.0, terms = 0.0, wrong = 0.0;
    for (int i = 0; i < n; i++) {
        const interval own = of_multiplier(side ? side[i] : LCP_OPEN, rb_lcp_lower(lower, i),
                                           rb_lcp_upper(upper, i));
        const double x = fmin(fmax(y[i], own.least), own.most);
        if (!(fabs(x - y[i]) <= ROUNDING * most))
            return 0;
        y[i] = x;
        value += q[i] * x;
        terms += fabs(q[i] * x);
    }
    /* y'w = y'q + c'z with c = M'y: the largest that it comes to within the bounds. */
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        const lcp_side at = side ? side[j] : LCP_OPEN;
        const double low = rb_lcp_lower(lower, j), high = rb_lcp_upper(upper, j);
        double c = 0.0, size = 0.0;
        for (int k = 0; k < a.count; k++) {
            c += a.x[k] * y[a.row ? a.row[k] : k];
            size += fabs(a.x[k]);
        }
        const double z = at == LCP_AT_LOWER || at == LCP_LEFT_OUT ? low
                         : at == LCP_AT_UPPER                     ? high
                         : c > 0.0                                ? high
                                                                  : low;
        if (c == 0.0 || z == 0.0)
            continue;
        if (!isinf(z)) {
            value += c * z;
            terms += fabs(c * z);
        } else if (fabs(c) <= ROUNDING * most * size)
            wrong = fmax(wrong, fabs(c));
        else
            return 0;
    }
    return value < -(4.0 + n) * DBL_EPSILON * terms &&
           -value >= FAR * wrong * rb_norm_inf((size_t)n, q);
}
