/* Element integrals of a viscoelastic half-plane (V2): in steady rolling the displacement
 * is the elastic one plus exponential averages along the path of the particle
 * upstream. */
#include "bem/internal.h"
#include "bem/surface.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_expint.h>
#include <math.h>

/* exp(z) E1(z) for z > 0, the principal value -exp(z) Ei(-z) for z < 0. */
static double scaled_exponential_integral(double z)
{
    gsl_sf_result r = {0.0, 0.0};
    if (z > 0.0)
        gsl_sf_expint_E1_scaled_e(z, &r);
    else
        gsl_sf_expint_Ei_scaled_e(-z, &r);
    return z > 0.0 ? r.val : -r.val;
}

/* sum over k >= 1 of (-z)^k / (k k!) for |z| <= 1. */
static double entire_part(double z)
{
    double term = 1.0, sum = 0.0;
    for (int k = 1; fabs(term) > 1e-19; k++) {
        term *= -z / k;
        sum += term / k;
    }
    return sum;
}

/* Phi(y) = int_0^inf exp(-r/L) ln|y + r| dr, less the constant L (ln L - gamma): only
 * differences count, and elements that are short against L would lose their digits in it. */
static double log_average(double y, double L)
{
    const double z = y / L;
    if (z == 0.0)
        return 0.0;
    if (fabs(z) <= 1.0)
        return L * (-expm1(z) * (log(fabs(z)) + M_EULER) - exp(z) * entire_part(z));
    return L * (log(fabs(z)) + M_EULER + scaled_exponential_integral(z));
}

/* What E - 1 makes of |y|, less the constant L. */
static double sign_average(double y, double L)
{
    return y >= 0.0 ? 0.0 : 2.0 * L * expm1(y / L);
}

/* ---- Its datum ---------------------------------------------------------------------- */

double rb_bem_memory_beyond_datum(double ratio)
{
    return 0.5 * log1p(ratio * ratio);
}

/* int_0^inf exp(-u) fall(u/z) du with u = exp(s): on the whole line the trapezoidal rule of a
 * function that is analytic for |Im s| < pi/2 errs by exp(-pi^2/STEP), which is below rounding. */
static double mean_of(double fall(double), double z)
{
    static const double STEP = 0.25, FROM = -40.0, TO = 4.5;
    double sum = 0.0;

    for (double s = FROM; s < TO; s += STEP)
        sum += STEP * exp(s - exp(s)) * fall(exp(s) / z);
    return sum;
}

double rb_bem_memory_of_datum(double datum_over_length)
{
    return mean_of(rb_bem_memory_beyond_datum, datum_over_length);
}

/* asinh(1/(2x)) + ln x, x > 0 */
static double beyond_strip(double ratio)
{
    const double square = 4.0 * ratio * ratio;
    return log1p(0.5 * square / (1.0 + sqrt(1.0 + square)));
}

double rb_bem_memory_of_strip(double width_over_length)
{
    return mean_of(beyond_strip, width_over_length);
}

/* ---- Steps ---------------------------------------------------------------------------- */

rb_bem_fading rb_bem_fading_over(double time, double step)
{
    const double r = step / time;
    rb_bem_fading f = {.kept = exp(-r)};

    if (r < 1e-2) { /* the closed forms would lose digits */
        static const double of_before[] = {1.0 / 2,  1.0 / 3,   1.0 / 8,
                                           1.0 / 30, 1.0 / 144, 1.0 / 840},
                            of_after[] = {1.0 / 2,   1.0 / 6,   1.0 / 24,
                                          1.0 / 120, 1.0 / 720, 1.0 / 5040};
        for (int k = 5; k >= 0; k--) {
            f.before = r * (of_before[k] - f.before);
            f.after = r * (of_after[k] - f.after);
        }
    } else {
        f.before = -expm1(-r) / r - f.kept;
        f.after = 1.0 + expm1(-r) / r;
    }
    return f;
}

void rb_bem_memory_integrals(const rb_bem_surface *body, double x, double b, double *log,
                             double *sign)
{
    const double ahead = x + b, behind = x - b;
    *log = *sign = 0.0;
    for (int k = 0; k < body->terms; k++) {
        const double f = body->ratio[k], L = body->length[k];
        if (!(L > 0.0))
            continue; /* E is the identity */
        *log += f * (log_average(ahead, L) - log_average(behind, L));
        *sign += f * (sign_average(ahead, L) - sign_average(behind, L));
    }
}
