/* Generic covering vectors d of w = q + M z + d z0: on one of them neither ties nor the long paths
 * of Murty and Fathi depend. */
#include "lcp/lemke/lemke.h"

#include <math.h>

/* Entries of a generic cover differ by this part: enough to make the paths of Murty and
 * Fathi short, and little enough for other paths to stay as long as with ones. */
static const double GENERIC = 0.0625;

void rb_lcp_generic_cover(int n, double *cover)
{
    unsigned long long seed = 20260101;
    for (int i = 0; i < n; i++)
        cover[i] = 1.0 + GENERIC * (rb_lcp_random(&seed) - 0.5);
}

/* The least entry of q ties with another one within this part of it. */
static const double SAME = 1e-6;

int rb_lcp_pivots_with_ones(int n, const double *q)
{
    double least = INFINITY, next = INFINITY;
    for (int i = 0; i < n; i++) {
        next = fmin(next, fmax(least, q[i]));
        least = fmin(least, q[i]);
    }
    return next - least <= SAME * fabs(least) ? 4 + n / 16 : 0;
}
