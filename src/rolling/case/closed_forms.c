/* Closed forms of theory-solvers.md 6. */
#include "rolling/case/closed_forms.h"

#include <math.h>

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_ellint.h>

/* sqrt(1 - x^2), 0 outside [-1, 1] */
static double ellipse(double x)
{
    return fabs(x) < 1.0 ? sqrt((1.0 - x) * (1.0 + x)) : 0.0;
}

double rb_closed_hertz_half_width(double load, double radius, double modulus)
{
    return sqrt(4.0 * load * radius / (M_PI * modulus));
}

double rb_closed_hertz_load(double half_width, double radius, double modulus)
{
    return M_PI * modulus * half_width * half_width / (4.0 * radius);
}

/* E* int_0^a x g'(x)/sqrt(a^2 - x^2) dx of the gap g; K - E = k^2/3 R_D(0, 1 - k^2, 1). */
double rb_closed_circle_load(double half_width, double radius, double modulus)
{
    const double k = half_width / radius;
    return modulus * radius * k * k / 3.0 *
           gsl_sf_ellint_RD(0.0, (1.0 - k) * (1.0 + k), 1.0, GSL_PREC_DOUBLE);
}

double rb_closed_hertz_max_pressure(double load, double half_width)
{
    return 2.0 * load / (M_PI * half_width);
}

double rb_closed_hertz_pressure(double max_pressure, double half_width, double x)
{
    return max_pressure * ellipse(x / half_width);
}

double rb_closed_half_cylinder_approach(double load, double radius, double plane_modulus,
                                        double half_width)
{
    return load / (M_PI * plane_modulus) * (2.0 * log(4.0 * radius / half_width) - 1.0);
}

/* xi > 0 brakes: the friction on A points to -x */
static double opposing(double s)
{
    return s > 0.0 ? -1.0 : 1.0;
}

double rb_closed_carter_force_ratio(double s)
{
    const double size = fmin(fabs(s), 1.0);
    return opposing(s) * size * (2.0 - size);
}

double rb_closed_carter_creep_ratio(double force_ratio)
{
    const double size = fmin(fabs(force_ratio), 1.0);
    /* 1 - sqrt(1 - r) without cancellation */
    return opposing(force_ratio) * size / (1.0 + sqrt(1.0 - size));
}

double rb_closed_carter_traction(double mu, double max_pressure, double half_width, double s,
                                 double x)
{
    const double stick = half_width * (1.0 - fmin(fabs(s), 1.0));
    double q = ellipse(x / half_width);
    if (stick > 0.0)
        q -= stick / half_width * ellipse((x - (half_width - stick)) / stick);
    return opposing(s) * mu * max_pressure * q;
}

double rb_closed_cattaneo_stick(double force_ratio)
{
    return sqrt(fmax(0.0, 1.0 - fabs(force_ratio)));
}

double rb_closed_cattaneo_traction(double mu, double max_pressure, double half_width,
                                   double force_ratio, double x)
{
    const double c = rb_closed_cattaneo_stick(force_ratio);
    double q = ellipse(x / half_width);
    if (c > 0.0)
        q -= c * ellipse(x / (c * half_width));
    return copysign(mu * max_pressure * q, force_ratio);
}

rb_closed_worn rb_closed_worn_limit(double stick)
{
    /* twice the depth is acosh(x/c) - x sqrt(x^2 - c^2), largest at x^2 = (1 + c^2)/2 and 0 at b */
    const double c = stick, deepest = sqrt(0.5 * (1.0 + c * c));
    double from = deepest, b = 2.0;
    for (int k = 0; k < 60; k++) {
        const double x = 0.5 * (from + b);
        *(acosh(x / c) > x * sqrt(x * x - c * c) ? &from : &b) = x;
    }
    const double edge = sqrt(b * b - c * c);
    return (rb_closed_worn){
        .volume = edge * (b * b - 1.0) - gsl_pow_3(edge) / 3.0,
        .depth = 0.5 * (acosh(deepest / c) - deepest * sqrt(deepest * deepest - c * c)),
        .mid_pressure = (1.0 + c * c) / (2.0 * c)};
}

double rb_closed_spence_friction(double beta, double stick)
{
    if (!(stick > 0.0 && stick < 1.0))
        return NAN; /* GSL would end the program */
    const double other = sqrt((1.0 - stick) * (1.0 + stick));

    return beta * gsl_sf_ellint_Kcomp(stick, GSL_PREC_DOUBLE) /
           gsl_sf_ellint_Kcomp(other, GSL_PREC_DOUBLE);
}

double rb_closed_bentall_johnson_slip(double beta, double half_width, double radius)
{
    /* asin x0 + x0 sqrt(1 - x0^2) = pi/4 by Newton; k = sqrt(1 - x0^2)/2 */
    double x = 0.4;
    for (int i = 0; i < 8; i++)
        x -= (asin(x) + x * ellipse(x) - M_PI_4) / (2.0 * ellipse(x));
    return 2.0 * fabs(beta) * half_width / radius * ellipse(x) / 2.0;
}

rb_closed_bentall_johnson rb_closed_bentall_johnson_stick(double beta, double hertz_half_width,
                                                          double radius, double modulus)
{
    rb_closed_bentall_johnson b;
    b.eta = atanh(beta) / M_PI;
    b.half_width = hertz_half_width / sqrt(1.0 + 4.0 * b.eta * b.eta);
    b.creepage = 2.0 * fabs(b.eta) * b.half_width / radius;
    b.mid_pressure = modulus * b.half_width / (2.0 * radius * sqrt(1.0 - beta * beta));
    return b;
}

double rb_closed_flash_temperature(double heat, double half_width, double speed, double effusivity)
{
    return 2.1883067 * heat * sqrt(half_width) / (effusivity * sqrt(M_PI * speed));
}

/* McEwen: sxy/p0 under Hertz's pressure and q = friction p, a = 1. */
static double shear_below(double friction, double x, double y)
{
    const double c = 1.0 - x * x + y * y, d = sqrt(c * c + 4.0 * x * x * y * y);
    const double m = sqrt(0.5 * (d + c)), n = copysign(sqrt(fmax(0.0, 0.5 * (d - c))), x);
    const double r = m * m + n * n;

    return -n * (m * m - y * y) / r - friction * (m * (1.0 + (y * y + n * n) / r) - 2.0 * y);
}

double rb_closed_shakedown_limit(double friction)
{
    enum { POINTS = 80 };
    static const double way[8][2] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                     {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
    double most = fabs(friction); /* at the surface */

    for (int side = -1; side <= 1; side += 2) {
        double x = 0.0, y = 0.0, found = 0.0;
        for (int i = 0; i <= POINTS; i++)
            for (int j = 1; j <= POINTS; j++) {
                const double u = side * 2.0 * i / POINTS, v = 2.0 * j / POINTS,
                             shear = fabs(shear_below(friction, u, v));
                if (shear > found) {
                    x = u;
                    y = v;
                    found = shear;
                }
            }
        for (double step = 4.0 / POINTS; step > 1e-9; step *= 0.5)
            for (int k = 0; k < 8; k++) {
                const double u = x + step * way[k][0], v = fmax(0.0, y + step * way[k][1]),
                             shear = fabs(shear_below(friction, u, v));
                if (shear > found) {
                    x = u;
                    y = v;
                    found = shear;
                }
            }
        most = fmax(most, found);
    }
    return 1.0 / most;
}
