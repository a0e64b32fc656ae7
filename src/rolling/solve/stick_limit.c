/* The pressure at a limit of stick between unlike bodies (theory-solvers.md 5.1, E4), which the
 * elements beside it do not show. */
#include "rolling/case/derived.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>

/* Of a stick zone the two elements at either limit are disturbed by up to 1.5 %, and the three
 * behind them are trusted.  The third one still is by 1e-4, up or down as the limit lies in an
 * element, which the parabola makes eight times as much: in a long zone, whose parabola goes far
 * enough, they begin with the fourth. */
enum { TRUSTED = 3, LONG = 20 };

/* Of steps: by so much of its pressure the last element but one that sticks leaves the parabola
 * of the trusted ones at most (1.6 % on 20 to 60 elements, mu up to 5).  It leaves it further where
 * the zone has a kink of its own: what slipped before sticks with the friction and the slip of
 * then, and the parabola of a part of the zone says nothing of the other one. */
static const double SMOOTH = 0.018;

static int slides(const rb_rolling_tractions *of, int i)
{
    return rb_rolling_is_at_bound(of->n, of->zone, of->p, of->q, i);
}

int rb_rolling_stick_limit_of(const rb_rolling_case *rc, const rb_rolling_tractions *of, int last,
                              int side, rb_rolling_stick_limit *limit)
{
    const int slips = last + side;
    int stuck = 0;

    if (slips < 0 || slips >= of->n || !slides(of, slips))
        return 0;
    for (int i = last;
         i >= 0 && i < of->n && of->zone[i] == RB_ZONE_STICK && !slides(of, i) && stuck < LONG;
         i -= side)
        stuck++;
    if (stuck < RB_ROLLING_LIMIT_LEAST)
        return 0;
    const double beta = rb_rolling_derive(rc).dundurs;
    if (beta == 0.0 || rc->interlayer_normal > 0.0 || rc->interlayer_tangential > 0.0)
        return 0;
    const int disturbed = stuck < LONG ? RB_ROLLING_DISTURBED : RB_ROLLING_DISTURBED + 1;
    const int from = last - disturbed * side;
    const double ratio = of->q[slips] / of->p[slips], x = of->x[from];
    const double exponent = 0.5 - side * atan(beta * ratio) / M_PI;
    const double unused = ratio * of->p[from] - of->q[from]; /* of the bound, not 0 */
    /* of places; of p^2 and of what is left of the bound, over their first one */
    double t[TRUSTED], squared[TRUSTED], straight[TRUSTED];
    for (int k = 0; k < TRUSTED; k++) {
        const int j = from - k * side;
        const double part = (ratio * of->p[j] - of->q[j]) / unused;
        if (!(part > 0.0))
            return 0;
        t[k] = side * (of->x[j] - x);
        squared[k] = gsl_pow_2(of->p[j] / of->p[from]);
        straight[k] = pow(part, 1.0 / exponent);
    }
    rb_rolling_parabola of_unused, of_p;
    const double end = rb_rolling_set_parabola(t, straight, &of_unused);
    rb_rolling_set_parabola(t, squared, &of_p);
    /* between the midpoints of the last element but one that sticks and the second that slips, or
     * the first one at the end of the mesh */
    const int beyond = slips + side < 0 || slips + side >= of->n ? slips : slips + side;
    if (!(end > side * (of->x[last - side] - x) && end < side * (of->x[beyond] - x)))
        return 0;
    const int inner = last - side;
    const double there = sqrt(fmax(rb_rolling_parabola_at(&of_p, side * (of->x[inner] - x)), 0.0));
    if (of->has_history && !(fabs(of->p[from] * there - of->p[inner]) <= SMOOTH * of->p[inner]))
        return 0;
    const double vertex = of_p.c < 0.0 ? -0.5 * of_p.b / of_p.c : end;
    const double highest = fmin(fmax(vertex, 0.0), end);
    *limit = (rb_rolling_stick_limit){
        of->p[from] * sqrt(fmax(rb_rolling_parabola_at(&of_p, highest), 0.0)), x + side * highest};
    return 1;
}
