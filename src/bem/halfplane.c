/* The half-plane y >= 0 loaded on y = 0 (B6): Flamant's solution over constant strips. */
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

rb_status rb_bem_ends_check(int n_c, const double *ends, rb_message *why)
{
    if (n_c < 1 || !ends)
        return rb_fail(why, RB_EINVAL, "contact elements: %d, expected at least 1", n_c);
    for (int i = 0; i <= n_c; i++)
        if (!(isfinite(ends[i]) && isfinite(ends[i + 1]) && ends[i] < ends[i + 1]))
            return rb_fail(
                why, RB_EINVAL,
                "contact element %d from x = %g to %g: expected increasing ends", i,
                ends[i], ends[i + 1]);
    return RB_OK;
}

/* int ln|s/d| ds over the strip of half-length b whose midpoint lies X from the point.
 * Near: [s ln|s/d| - s].  Far: the difference of its two large parts is formed as
 * X ln((X + b)/(X - b)). */
static double strip_log(double X, double b, double d)
{
    const double s1 = X - b, s2 = X + b;
    if (fabs(X) < 4.0 * b) {
        const double l1 = s1 != 0.0 ? s1 * log(fabs(s1 / d)) : 0.0;
        const double l2 = s2 != 0.0 ? s2 * log(fabs(s2 / d)) : 0.0;
        return l2 - l1 - 2.0 * b;
    }
    const double far = X * 2.0 * atanh(b / X); /* X ln(s2/s1) */
    return far - 2.0 * b + b * log(s1 / d * (s2 / d));
}

/* int sgn(x - s) ds over the same strip: -2b where it lies ahead (X >= b). */
static double strip_sign(double X, double b)
{
    return -2.0 * fmin(fmax(X, -b), b);
}

/* w_N = -K int p ln|(x-s)/d| + c int q sgn(x-s),  K = 2(1-nu^2)/(pi E) = (1-nu)/(pi G)
 * w_T = -K int q ln|(x-s)/d| - c int p sgn(x-s),  c = (1-2nu)(1+nu)/(2E) = (1-2nu)/(4G)
 * Distances are differences of ends, exact where the ends nearly meet (B9). */
static void fill(int n, const double *ends, rb_bem_material material, double datum,
                 double *F)
{
    const double K = (1.0 - material.poisson) / (M_PI * material.shear);
    const double c = (1.0 - 2.0 * material.poisson) / (4.0 * material.shear);
    const size_t m = (size_t)n + 1;

    for (size_t j = 0; j < (size_t)n; j++) {
        double *N = F + j * 2 * m, *T = F + (j + (size_t)n) * 2 * m;
        const double b = 0.5 * (ends[j + 1] - ends[j]);
        for (size_t i = 0; i < m; i++) {
            const double X = 0.5 * ((ends[j] - ends[i]) + (ends[j + 1] - ends[i + 1]));
            N[i] = T[m + i] = -K * strip_log(X, b, datum);
            T[i] = c * strip_sign(X, b);
            N[m + i] = -T[i];
        }
    }
}

rb_status rb_bem_flexibility_halfplane(int n_c, const double *ends,
                                       rb_bem_material material, double datum,
                                       rb_bem_flexibility *f, rb_message *why)
{
    double *F = NULL;
    *f = (rb_bem_flexibility){0};
    rb_status s = rb_bem_material_check(material, why);
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s == RB_OK && !(datum > 0.0 && isfinite(datum)))
        s = rb_fail(why, RB_EINVAL, "datum = %g: expected a depth > 0", datum);
    if (s != RB_OK)
        return s;
    s = rb_bem_flexibility_dense(n_c, f, &F);
    if (s != RB_OK)
        return rb_fail(why, s, "half-plane: no memory for %d contact elements", n_c);
    for (int i = 0; i < f->m; i++) {
        f->x[i] = 0.5 * (ends[i] + ends[i + 1]);
        f->h[i] = ends[i + 1] - ends[i];
    }
    fill(n_c, ends, material, datum, F);
    return RB_OK;
}
