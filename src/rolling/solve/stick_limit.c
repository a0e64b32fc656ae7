/* The pressure at a limit of stick between unlike bodies (theory-solvers.md 5.1, E4), which the
 * elements beside it do not show. */
#include "rolling/case/derived.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>

/* Of a stick zone the two elements at either limit are disturbed by up to 1.5 %, and the three
 * behind them are trusted.  The third one still is by 1e-4, up or down as the limit lies in an
 * element, which the parabola makes eight times as much: in a long zone, whose parabola goes far
 * enough, they begin with the fourth. */
enum { DISTURBED = 2, TRUSTED = 3, LEAST = 2 * DISTURBED + TRUSTED, LONG = 20 };

/* A parabola through three points, t = 0 first: y = y0 + slope t + bend t^2. */
typedef struct {
    double y0, slope, bend;
} parabola;

static parabola through(const double t[TRUSTED], const double y[TRUSTED])
{
    const double first = (y[1] - y[0]) / t[1], second = (y[2] - y[0]) / t[2];
    const double bend = (second - first) / (t[2] - t[1]);
    return (parabola){y[0], first - bend * t[1], bend};
}

static double at(const parabola *of, double t)
{
    return of->y0 + t * (of->slope + t * of->bend);
}

/* The first t > 0 where it, falling from y0 > 0, is zero; NAN: nowhere. */
static double zero_of(const parabola *of)
{
    const double square = gsl_pow_2(of->slope) - 4.0 * of->bend * of->y0;
    return square >= 0.0 && of->slope < 0.0 ? 2.0 * of->y0 / (sqrt(square) - of->slope) : NAN;
}

int rb_rolling_stick_limit_of(const rb_rolling_case *rc, const rb_rolling_tractions *of, int last,
                              int side, rb_rolling_stick_limit *limit)
{
    const int slips = last + side;
    int stuck = 0;

    if (slips < 0 || slips >= of->n || of->zone[slips] <= RB_ZONE_STICK)
        return 0;
    for (int i = last; i >= 0 && i < of->n && of->zone[i] == RB_ZONE_STICK && stuck < LONG;
         i -= side)
        stuck++;
    if (stuck < LEAST)
        return 0;
    const double beta = rb_rolling_derive(rc).dundurs;
    if (beta == 0.0 || rc->interlayer_normal > 0.0 || rc->interlayer_tangential > 0.0)
        return 0;
    const int from = last - (stuck < LONG ? DISTURBED : DISTURBED + 1) * side;
    const double ratio = of->q[slips] / of->p[slips], x = of->x[from];
    const double exponent = 0.5 - side * atan(beta * ratio) / M_PI;
    const double unused = ratio * of->p[from] - of->q[from]; /* of the bound, not 0 */
    double t[TRUSTED], squared[TRUSTED], straight[TRUSTED];
    for (int k = 0; k < TRUSTED; k++) {
        const int j = from - k * side;
        const double part = (ratio * of->p[j] - of->q[j]) / unused;
        if (!(part > 0.0))
            return 0;
        t[k] = side * (of->x[j] - x);
        squared[k] = gsl_pow_2(of->p[j]);
        straight[k] = pow(part, 1.0 / exponent);
    }
    const parabola of_unused = through(t, straight), of_p = through(t, squared);
    /* between the midpoints of the last element but one that sticks and the second that slips, or
     * the first one at the end of the mesh */
    const int beyond = slips + side < 0 || slips + side >= of->n ? slips : slips + side;
    const double end = zero_of(&of_unused);
    if (!(end > side * (of->x[last - side] - x) && end < side * (of->x[beyond] - x)))
        return 0;
    const double vertex = of_p.bend < 0.0 ? -0.5 * of_p.slope / of_p.bend : end;
    const double highest = fmin(fmax(vertex, 0.0), end);
    *limit = (rb_rolling_stick_limit){sqrt(fmax(at(&of_p, highest), 0.0)), x + side * highest};
    return 1;
}
