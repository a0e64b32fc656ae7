/* Elements that slide or yield, and those that stick with all that they carry: where elements slide
 * towards both sides and no more is held, a given force does not tell the motion. */
#include "rolling/rolling.h"
#include "rolling/solve/zone.h"

#include <math.h>

int rb_rolling_carries_more_with_slip(const rb_rolling_case *rc)
{
    return rc->yield_stress > 0.0 && rc->hardening != 0.0;
}

int rb_rolling_count_at_bound(const rb_rolling_case *rc, int n, const int *zone, const double *p,
                              const double *q, const double *mu, double one)
{
    const double at_bound = 1.0 - 1e-9, most = rc->yield_stress > 0.0 ? rc->yield_stress : INFINITY;
    int count = 0;

    for (int i = 0; i < n; i++)
        count += zone[i] == RB_ZONE_STICK &&
                 fabs(q[i]) >= at_bound * fmin((mu ? mu[i] : one) * p[i], most);
    return count;
}

int rb_rolling_slips_both_ways(int n, const int *zone)
{
    int negative = 0, positive = 0;

    for (int i = 0; i < n; i++) {
        negative |= zone[i] == RB_ZONE_SLIP_NEGATIVE || zone[i] == RB_ZONE_YIELD_NEGATIVE;
        positive |= zone[i] == RB_ZONE_SLIP_POSITIVE || zone[i] == RB_ZONE_YIELD_POSITIVE;
    }
    return negative && positive;
}
