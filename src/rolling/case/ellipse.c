/* Hertz's ellipse of a wheel whose surfaces are curved across the rolling direction, too, and the
 * strip through its middle (E2). */
#include "rolling/body/body.h"
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/solve/pressed.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_spline.h>
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
        return rb_refuse(why, "transverse-radius,transverse-radius-b,wheel-load",
                         "the sum of both transverse curvatures, %g /mm, must be "
                         "> 0; bodies that touch along a line have a --load per width",
                         across);
    if (!(along > 0.0))
        return rb_refuse(why, "wheel-load", "needs the radius of A, --radius");
    if (!(fmin(along, across) > 1e-12 * fmax(along, across)))
        return rb_refuse(why, "transverse-radius,transverse-radius-b,wheel-load",
                         "the ellipse is too long; give --load per width");
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

/* (E3) Q/(mu W) of all strips of an ellipse, at the creepage s = xi R_eq/(mu a) >= 0, which is one
 * for all of them. */
static double by_strips(double s)
{
    const double t = sqrt(fmax(0.0, (1.0 - s) * (1.0 + s)));
    return s < 1.0 ? 1.0 + 1.5 * (s * acos(s) - t + t * t * t / 3.0) : 1.0;
}

/* Kalker's C11 over the one of strips, pi^2/(4 (1 - nu)): how much steeper the force of the ellipse
 * rises.  NAN: his table (1990, E.3) does not hold the case. */
static double steeper(double a_over_b, double nu)
{
    /* a/b up to 1, and the inverse of b/a; nu 0, 1/4, 1/2 */
    static const double at[] = {0.1, 0.2, 0.3,  0.4, 0.5,        0.6, 0.7, 0.8,
                                0.9, 1.0, 1.25, 2.0, 10.0 / 3.0, 5.0, 10.0},
                        C11[][3] = {{2.51, 3.31, 4.85}, {2.59, 3.37, 4.81}, {2.68, 3.44, 4.80},
                                    {2.78, 3.53, 4.82}, {2.88, 3.62, 4.83}, {2.98, 3.72, 4.91},
                                    {3.09, 3.81, 4.97}, {3.19, 3.91, 5.05}, {3.29, 4.01, 5.12},
                                    {3.40, 4.12, 5.20}, {3.65, 4.36, 5.42}, {4.37, 5.10, 6.11},
                                    {5.57, 6.34, 7.34}, {6.96, 7.78, 8.82}, {10.7, 11.7, 12.9}};
    enum { N = sizeof at / sizeof *at };
    double x[N], y[N];

    if (!(a_over_b >= at[0] && a_over_b <= at[N - 1] && nu >= 0.0 && nu <= 0.5))
        return NAN;
    /* 1/C11 of strips is linear in nu: a parabola for that of the table */
    const double l[3] = {(1.0 - 4.0 * nu) * (1.0 - 2.0 * nu), 8.0 * nu * (1.0 - 2.0 * nu),
                         2.0 * nu * (4.0 * nu - 1.0)};
    for (int i = 0; i < N; i++) {
        x[i] = log(at[i]);
        y[i] = l[0] / C11[i][0] + l[1] / C11[i][1] + l[2] / C11[i][2];
    }
    gsl_spline *curve = gsl_spline_alloc(gsl_interp_cspline, N);
    if (!curve)
        return NAN;
    gsl_spline_init(curve, x, y, N);
    const double inverse = gsl_spline_eval(curve, log(a_over_b), NULL);
    gsl_spline_free(curve);
    return 4.0 * (1.0 - nu) / (M_PI * M_PI * inverse);
}

int rb_rolling_ellipse_slides_alike(const rb_rolling_case *rc)
{
    return rb_rolling_has_ellipse(rc) && rb_rolling_carter_holds(rc);
}

void rb_rolling_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                               double *kalker)
{
    const double all = -copysign(rb_rolling_largest_mu(rc) * rc->wheel_load, creep_ratio),
                 s = fabs(creep_ratio),
                 factor = steeper(rc->ellipse.a / rc->ellipse.b,
                                  rb_rolling_material(rc, &rc->a).poisson);
    *strips = all * by_strips(s) + 0.0; /* -0 is 0 */
    *kalker = isnan(factor) ? NAN : all * by_strips(factor * s) + 0.0;
}

void rb_rolling_set_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                                   double *kalker)
{
    *strips = *kalker = NAN;
    if (rb_rolling_ellipse_slides_alike(rc))
        rb_rolling_ellipse_forces(rc, creep_ratio, strips, kalker);
    if (rc->strips > 0)
        *strips = NAN;
}
