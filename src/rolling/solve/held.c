/* Elements that hold the contact: where there are none, a given force does not tell the motion. */
#include "rolling/rolling.h"
#include "rolling/solve/zone.h"

#include <math.h>

int rb_rolling_held(int n, const int *zone, const double *p, const double *q, const double *mu,
                    double one)
{
    const double at_bound = 1.0 - 1e-9;
    int held = 0;

    for (int i = 0; i < n; i++)
        held += zone[i] == RB_ZONE_STICK && fabs(q[i]) < at_bound * (mu ? mu[i] : one) * p[i];
    return held;
}
