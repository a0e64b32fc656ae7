/* Where a gap without an axis of symmetry is low: a measured one, a worn one, or one that is
 * tilted. */
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/zone.h"

#include <math.h>

enum { POINTS = 4096 };

/* Where the gap reaches `level` between x, where it is less, and x + step. */
static double crossing(const rb_rolling_case *rc, double x, double step, double level)
{
    for (int k = 0; k < 50; k++) {
        step *= 0.5;
        if (rb_rolling_initial_gap(rc, x + step) <= level)
            x += step;
    }
    return x;
}

void rb_rolling_low_gap(const rb_rolling_case *rc, double first_x, double last_x, double rise,
                        double *from, double *to, double *least, double *level)
{
    const double step = (last_x - first_x) / POINTS, approach = rb_rolling_derive(rc).approach;
    int lowest = 0, first = 0, last = POINTS;

    *least = INFINITY;
    for (int k = 0; k <= POINTS; k++)
        if (rb_rolling_initial_gap(rc, first_x + k * step) < *least) {
            *least = rb_rolling_initial_gap(rc, first_x + k * step);
            lowest = k;
        }
    *level = *least + rise;
    if (!isnan(approach)) /* beyond it not even rigid bodies touch */
        *level = fmin(*level, approach);
    while (first < lowest && rb_rolling_initial_gap(rc, first_x + first * step) > *level)
        first++;
    while (last > lowest && rb_rolling_initial_gap(rc, first_x + last * step) > *level)
        last--;
    *from = crossing(rc, first_x + first * step, -step, *level);
    *to = crossing(rc, first_x + last * step, step, *level);
    if (!(*to - *from > 0.0)) {
        *from -= step;
        *to += step;
    }
}
