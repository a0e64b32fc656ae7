/* Corners of worn and measured surfaces, at which the pressure is infinite: how much of it shorter
 * elements would see. */
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"

#include <gsl/gsl_math.h>

/* How much steeper a corner makes the surface, times the logarithm of what shorter elements see of
 * it more; before, behind: how far the surface is straight or smooth on either side. */
static double rise_at(double turn, double before, double behind, double element, double times)
{
    const double shorter = times * fmin(before, behind) / element;
    return turn > 0.0 && shorter > 1.0 ? turn * log(fmin(times, shorter)) : 0.0;
}

double rb_rolling_rise_at_corners(const rb_rolling_case *rc, double from, double to, double element,
                                  double times)
{
    const double *x = rc->worn.x, *y = rc->worn.y, *bend;
    double most = 0.0;

    if (rc->interlayer_normal > 0.0) /* which rounds the corner off */
        return 0.0;
    for (int i = 0; i < rc->worn.n; i++) {
        const double before = i > 0 ? x[i] - x[i - 1] : INFINITY;
        const double behind = i + 1 < rc->worn.n ? x[i + 1] - x[i] : INFINITY;
        const double turn = (i + 1 < rc->worn.n ? (y[i + 1] - y[i]) / behind : 0.0) -
                            (i > 0 ? (y[i] - y[i - 1]) / before : 0.0);
        if (x[i] > from && x[i] < to)
            most = fmax(most, rise_at(turn, before, behind, element, times));
    }
    const int corners =
        rc->gap == RB_GAP_TABLE ? rb_rolling_profile_corners(rc->profile, &x, &bend) : 0;
    for (int i = 0; i < corners; i++)
        if (x[i] > from && x[i] < to)
            most =
                fmax(most, rise_at(bend[i], i > 0 ? x[i] - x[i - 1] : INFINITY,
                                   i + 1 < corners ? x[i + 1] - x[i] : INFINITY, element, times));
    return rb_rolling_derive(rc).modulus * most / (2.0 * M_PI);
}
