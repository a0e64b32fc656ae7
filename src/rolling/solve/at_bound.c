/* Elements that slide, and those that stick with all their friction: where elements slide towards
 * both sides and no more is held, a given force does not tell the motion. */
#include "rolling/rolling.h"
#include "rolling/solve/zone.h"

#include <math.h>

int rb_rolling_count_at_bound(int n, const int *zone, const double *p, const double *q,
                              const double *mu, double one)
{
    const double at_bound = 1.0 - 1e-9;
    int count = 0;

    for (int i = 0; i < n; i++)
        count += zone[i] == RB_ZONE_STICK && fabs(q[i]) >= at_bound * (mu ? mu[i] : one) * p[i];
    return count;
}

int rb_rolling_slips_both_ways(int n, const int *zone)
{
    int negative = 0, positive = 0;

    for (int i = 0; i < n; i++) {
        negative |= zone[i] == RB_ZONE_SLIP_NEGATIVE;
        positive |= zone[i] == RB_ZONE_SLIP_POSITIVE;
    }
    return negative && positive;
}
