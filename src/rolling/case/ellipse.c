/* Hertz's ellipse of a wheel whose surfaces are curved across the rolling direction, too, and the
 * strip through its middle (E2). */
#include "rolling/internal.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_ellint.h>

/* Curvatures 1/(2R) of the gap along a long and a short semi-axis whose ratio is k <= 1: their
 * ratio. Carlson's R_D has no 0/0 at a circle. */
static double curvature_ratio(double k)
{
    return gsl_sf_ellint_RD(0.0, k * k, 1.0, GSL_PREC_DOUBLE) /
           gsl_sf_ellint_RD(0.0, 1.0, k * k, GSL_PREC_DOUBLE);
}

/* It grows with k: by halving ln k, which ends at rounding. */
static double axes_of(double ratio)
{
    enum { ROUNDS = 70 };
    double low = log(1e-7), high = 0.0;

    for (int i = 0; i < ROUNDS; i++) {
        const double middle = 0.5 * (low + high);
        *(curvature_ratio(exp(middle)) < ratio ? &low : &high) = middle;
    }
    return ratio >= 1.0 ? 1.0 : exp(0.5 * (low + high));
}

rb_status rb_rolling_find_ellipse(rb_rolling_case *rc, rb_message *why)
{
    rc->ellipse = (rb_rolling_ellipse){0};
    if (!rb_rolling_has_ellipse(rc))
        return RB_OK;
    const double along = 1.0 / rb_rolling_radius(rc),
                 across = 1.0 / rc->transverse_radius + 1.0 / rc->transverse_radius_b;
    if (!(across > 0.0))
        return rb_fail(why, RB_EINVAL,
                       "transverse-radius: the sum of both transverse curvatures, %g /mm, must be "
                       "> 0; bodies that touch along a line have a --load per width",
                       across);
    if (!(along > 0.0))
        return rb_fail(why, RB_EINVAL, "wheel-load: needs the radius of A, --radius");
    if (!(fmin(along, across) > 1e-12 * fmax(along, across)))
        return rb_fail(why, RB_EINVAL,
                       "transverse-radius: the ellipse is too long; give --load per width");
    const double modulus = rb_rolling_derive(rc).modulus, P = rc->wheel_load,
                 steep = 0.5 * fmax(along, across),
                 k = axes_of(fmin(along, across) / fmax(along, across)),
                 integral = gsl_sf_ellint_RD(0.0, 1.0, k * k, GSL_PREC_DOUBLE),
                 longer = cbrt(P * integral / (2.0 * M_PI * modulus * steep)), shorter = k * longer,
                 p0 = 1.5 * P / (M_PI * shorter * longer), a = along >= across ? shorter : longer;
    rc->ellipse = (rb_rolling_ellipse){
        .a = a,
        .b = along >= across ? longer : shorter,
        .pressure = p0,
        .approach = p0 * shorter / modulus *
                    gsl_sf_ellint_Kcomp(sqrt((1.0 - k) * (1.0 + k)), GSL_PREC_DOUBLE),
        .radius = modulus * a / (2.0 * p0)};
    return RB_OK;
}
