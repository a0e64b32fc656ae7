/* Kolosov-Muskhelishvili potentials of a force F at the origin of the half-plane y > 0:
 *   phi = -F/(2 pi) ln z,  psi = conj(F)/(2 pi) ln z,
 *   2G u = kappa phi - z conj(phi') - conj(psi),
 * integrated over the strip.  With a, b the distances of z from its two ends (complex),
 *   Lambda = int dz/(z - s) = ln a - ln b,  L = int ln(z - s) ds. */
#include "bem/complex.h"
#include "bem/kernels.h"
#include "bem/strip.h"

#include <gsl/gsl_math.h>
#include <math.h>

rb_strip rb_strip_between(double complex from, double complex to, rb_bem_material material,
                          double unit)
{
    const double h = cabs(to - from);

    return rb_strip_in(
        (rb_strip){.middle = 0.5 * (from + to), .along = (to - from) / h, .h = h, .unit = unit},
        material);
}

rb_strip rb_strip_in(rb_strip strip, rb_bem_material material)
{
    strip.shear = material.shear;
    strip.kappa = 3.0 - 4.0 * material.poisson;
    return strip;
}

rb_strip rb_strip_on(const rb_bem_mesh *mesh, int j, rb_bem_material material, double unit)
{
    return rb_strip_between(complex_of(mesh->x0[j], mesh->y0[j]),
                            complex_of(mesh->x1[j], mesh->y1[j]), material, unit);
}

double complex rb_strip_midpoint(const rb_bem_mesh *mesh, int j)
{
    return complex_of(0.5 * (mesh->x0[j] + mesh->x1[j]), 0.5 * (mesh->y0[j] + mesh->y1[j]));
}

double complex rb_strip_outward(const rb_bem_mesh *mesh, int j)
{
    const double dx = mesh->x1[j] - mesh->x0[j], dy = mesh->y1[j] - mesh->y0[j];
    return complex_of(dy, -dx) / hypot(dx, dy);
}

static double complex to_local(const rb_strip *strip, double complex z)
{
    return conj(strip->along) * (z - strip->middle);
}

double rb_strip_depth(const rb_strip *strip, double complex z)
{
    return cimag(to_local(strip, z));
}

/* The point in the strip's frame; what rounding has put above the edge is on it, from
 * inside. */
static double complex below(const rb_strip *strip, double complex z)
{
    const double complex local = to_local(strip, z);
    return complex_of(creal(local), cimag(local) > 0.0 ? cimag(local) : 0.0);
}

/* |z|^2: no square here is near overflow. */
static double square(double complex z)
{
    return gsl_pow_2(creal(z)) + gsl_pow_2(cimag(z));
}

/* Lambda, far away without cancellation: a series.  d = -y, but the angle of an edge point within
 * the strip is -pi, which is that of y = +0. */
static double complex log_ratio(double complex z, double h)
{
    const double a = 0.5 * h, rho = square(z);
    rb_view_angles v = {.X = creal(z), .d = -cimag(z), .rho = rho};

    if (rho > gsl_pow_2(rb_far.reach * a)) {
        rb_turn_far(a, rb_far.terms, h / rho, &v);
        return complex_of(v.Lam, v.Th);
    }
    return complex_of(rb_Lam_near(a, &v), -rb_atan2(h * cimag(z), rho - a * a));
}

/* Lambda' = 1/a - 1/b; the compiler's own division guards against overflow, and is slow. */
static double complex log_ratio_slope(double complex z, double h)
{
    const double complex ab = z * z - 0.25 * h * h;
    return -h / square(ab) * conj(ab);
}

/* ln |a| + ln |b|, distances in the unit, and the angle of a, at (x, y). */
RB_INLINE double log_ends(double x, double y, double a, double per_unit)
{
    const double right = (x + a) * per_unit, left = (x - a) * per_unit, up = y * per_unit;
    return 0.5 * rb_log((right * right + up * up) * (left * left + up * up));
}

/* 2G u = -kappa F L + conj(F) (h + 2iy conj(Lambda)) - F conj(L), over 2 pi, in the strip's frame;
 * turned, F = conj(along) f.  L = z Lambda + h/2 (ln a + ln b) - h, where ln b = ln a - Lambda. */
static rb_strip_answer displacement(const rb_strip *strip, double complex at, double complex lambda,
                                    double ends, double angle)
{
    const double h = strip->h, C = 1.0 / (4.0 * M_PI * strip->shear);
    const double complex L =
        at * lambda + 0.5 * h * complex_of(ends, 2.0 * angle - cimag(lambda)) - h;

    return (rb_strip_answer){-C * (strip->kappa * L + conj(L)),
                             C * strip->along * strip->along *
                                 (h + 2.0 * I * cimag(at) * conj(lambda))};
}

rb_strip_answer rb_strip_displacement(const rb_strip *strip, double complex z)
{
    const double a = 0.5 * strip->h;
    const double complex at = below(strip, z);
    return displacement(strip, at, log_ratio(at, strip->h),
                        log_ends(creal(at), cimag(at), a, 1.0 / strip->unit),
                        rb_atan2(cimag(at), creal(at) + a));
}

void rb_strip_displacements(const rb_strip *strip, int n, const double *x, const double *y,
                            const double complex *view, rb_strip_answer *answer)
{
    const double a = 0.5 * strip->h, per_unit = 1.0 / strip->unit, mx = creal(strip->middle),
                 my = cimag(strip->middle), tx = creal(strip->along), ty = cimag(strip->along);
    double X[RB_STRIP_POINTS], Y[RB_STRIP_POINTS], ends[RB_STRIP_POINTS], angle[RB_STRIP_POINTS];

    /* In loops of their own, which compilers turn into vectors. */
    for (int i = 0; i < n; i++) {
        const double dx = x[i] - mx, dy = y[i] - my, up = tx * dy - ty * dx;
        X[i] = tx * dx + ty * dy;
        Y[i] = up > 0.0 ? up : 0.0;
    }
    for (int i = 0; i < n; i++)
        ends[i] = log_ends(X[i], Y[i], a, per_unit);
    for (int i = 0; i < n; i++)
        angle[i] = rb_atan2(Y[i], X[i] + a);
    for (int i = 0; i < n; i++)
        answer[i] = displacement(strip, complex_of(X[i], Y[i]), -view[i], ends[i], angle[i]);
}

/* sxx + syy = 4 Re phi' = -(F Lambda + conj(F Lambda))/pi,
 * syy - sxx + 2i sxy = 2(conj(z) phi'' + psi') = (F (Lambda + 2iy Lambda') + conj(F)
 * Lambda)/pi; bent = Lambda + 2iy Lambda'. */
static rb_strip_answer traction(const rb_strip *strip, double complex lambda, double complex bent,
                                double complex normal)
{
    const double C = -0.5 / M_PI;
    const double complex n = conj(strip->along) * normal;

    return (rb_strip_answer){C * (lambda * n + conj(n * lambda)),
                             C * strip->along * strip->along * (conj(lambda) * n + conj(n * bent))};
}

rb_strip_answer rb_strip_traction(const rb_strip *strip, double complex z, double complex normal)
{
    const double complex at = below(strip, z), lambda = log_ratio(at, strip->h);
    return traction(strip, lambda, lambda + 2.0 * I * cimag(at) * log_ratio_slope(at, strip->h),
                    normal);
}

rb_strip_answer rb_strip_traction_of(const rb_strip *strip, double complex view,
                                     double complex turned, double complex normal)
{
    /* a boundary element looks back: from the point to the strip; y Lambda' = -conj(q Z) there */
    return traction(strip, -view, -view - 2.0 * I * strip->along * strip->along * conj(turned),
                    normal);
}

/* With w = z - s and F = f_z - slope w, f_z = f + slope z:
 * int F/w ds = f_z Lambda - slope h,  int F/w^2 ds = f_z (1/b - 1/a) - slope Lambda. */
void rb_strip_linear_stress(const rb_strip *strip, double complex z, double complex f,
                            double complex slope, double stress[3])
{
    const double h = strip->h, close = 1e-13 * strip->unit;
    double complex at = below(strip, z);
    /* At the ends the logarithm of a strip is infinite; those of its neighbours, whose
     * traction goes on from there, cancel it if they take the same distance.  It is that
     * of the unit, so large that the rounding of coordinates is not felt in it. */
    const double end = creal(at) < 0.0 ? -0.5 * h : 0.5 * h;
    if (square(at - end) < close * close)
        at = complex_of(end, close);
    const double complex lambda = log_ratio(at, h);
    const double complex turn = conj(strip->along), middle = turn * f;
    /* far away the slope is not felt, and would cost digits */
    const double complex rise = square(at) < gsl_pow_2(1e4 * h) ? turn * slope : 0.0;
    const double complex f_z = middle + rise * at, g_z = conj(middle) + conj(rise) * at;
    const double complex first = f_z * lambda - rise * h;
    const double complex second = -f_z * log_ratio_slope(at, h) - rise * lambda;
    const double mean = -2.0 * creal(first) / M_PI; /* sxx + syy */
    const double complex local =
        (first - 2.0 * I * cimag(at) * second + g_z * lambda - conj(rise) * h) / M_PI;
    const double complex difference = local * turn * turn; /* syy - sxx + 2i sxy */

    stress[0] = 0.5 * (mean - creal(difference));
    stress[1] = 0.5 * (mean + creal(difference));
    stress[2] = 0.5 * cimag(difference);
}
