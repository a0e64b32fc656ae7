/* The half-plane y >= 0 loaded on y = 0 (B6): Flamant's solution over constant strips. */
#include "bem/internal.h"
#include "bem/kernels.h"

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

/* Displacement at distance X from the middle of a strip of half-length b:
 * w_N = -K int p ln|(x-s)/d| + c int q sgn(x-s),  K = 2(1-nu^2)/(pi E) = (1-nu)/(pi G)
 * w_T = -K int q ln|(x-s)/d| - c int p sgn(x-s),  c = (1-2nu)(1+nu)/(2E) = (1-2nu)/(4G)
 */
typedef struct {
    double K, c, datum;
} flamant;

static flamant flamant_of(rb_bem_material material, double datum)
{
    return (flamant){(1.0 - material.poisson) / (M_PI * material.shear),
                     (1.0 - 2.0 * material.poisson) / (4.0 * material.shear), datum};
}

/* Row i of m points, strip j of n: the four entries of the 2m x 2n matrix F. */
static void set_entries(const flamant *body, double X, double b, size_t i, size_t m,
                        size_t j, size_t n, double *F)
{
    double *N = F + j * 2 * m, *T = F + (j + n) * 2 * m;

    N[i] = T[m + i] = -body->K * strip_log(X, b, body->datum);
    T[i] = body->c * strip_sign(X, b);
    N[m + i] = -T[i];
}

/* Distances are differences of ends, exact where the ends nearly meet (B9). */
static void fill(int n, const double *ends, const flamant *body, double *F)
{
    const size_t m = (size_t)n + 1;

    for (size_t j = 0; j < (size_t)n; j++)
        for (size_t i = 0; i < m; i++)
            set_entries(body, 0.5 * ((ends[j] - ends[i]) + (ends[j + 1] - ends[i + 1])),
                        0.5 * (ends[j + 1] - ends[j]), i, m, j, (size_t)n, F);
}

rb_status rb_bem_halfplane_displacement(int n, const double *ends,
                                        rb_bem_material material, double datum,
                                        int points, const double *x, double *W)
{
    const flamant body = flamant_of(material, datum);

    if (rb_bem_material_check(material, NULL) != RB_OK || n < 1 || points < 1 ||
        !(datum > 0.0))
        return RB_EINVAL;
    for (size_t j = 0; j < (size_t)n; j++)
        for (size_t i = 0; i < (size_t)points; i++)
            set_entries(&body, 0.5 * ((ends[j] - x[i]) + (ends[j + 1] - x[i])),
                        0.5 * (ends[j + 1] - ends[j]), i, (size_t)points, j, (size_t)n,
                        W);
    return RB_OK;
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
    const flamant body = flamant_of(material, datum);
    fill(n_c, ends, &body, F);
    return RB_OK;
}

/* ---- Stress --------------------------------------------------------------------------
 */

/* One strip seen from (x, y), in the letters of kernels.h with t = +x, so that d = y; the
 * strip's own ends, where a jump of q makes sxx infinite, get the finite part. */
static rb_seen see_strip(const rb_element *strip, double x, double y)
{
    rb_seen v = rb_see(strip, x, y);
    if (v.W > 0.0)
        return rb_look(strip, x, y);
    v.q = v.Lam = 0.0;
    v.Th = 0.5 * M_PI;
    return v;
}

/* From Flamant's  s_ij = -(2/pi) (p y + q x) x_i x_j/r^4,  dQ = q_ (2 d^2 - dot),
 * d2P = -2 d X q_, q_ = cross/W:
 *     sxx = -(p/pi) (Th - dQ) + (q/pi) (2 Lam + d2P)
 *     syy = -(p/pi) (Th + dQ) - (q/pi) d2P
 *     sxy = -(p/pi) d2P       - (q/pi) (Th - dQ) */
static void add_strip(const rb_element *strip, double p, double q, double x, double y,
                      double *stress)
{
    const rb_seen v = see_strip(strip, x, y);
    const double q_ = v.q, dQ = q_ * (2.0 * v.d * v.d - (v.rho - strip->a * strip->a)),
                 d2P = -2.0 * v.d * v.X * q_;
    stress[0] += (-p * (v.Th - dQ) + q * (2.0 * v.Lam + d2P)) / M_PI;
    stress[1] += (-p * (v.Th + dQ) - q * d2P) / M_PI;
    stress[2] += (-p * d2P - q * (v.Th - dQ)) / M_PI;
}

rb_status rb_bem_halfplane_stress(int n, const double *ends, const double *p,
                                  const double *q, int points, const double *xy,
                                  double *stress)
{
    if (n < 1 || points < 0)
        return RB_EINVAL;
    for (int i = 0; i < n; i++)
        if (!(ends[i] < ends[i + 1]))
            return RB_EINVAL;
    for (int k = 0; k < points; k++)
        if (!(xy[2 * k + 1] >= 0.0))
            return RB_EINVAL;
    rb_element *strip = malloc((size_t)n * sizeof *strip);
    if (!strip)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        strip[i] = rb_element_make(ends[i], 0.0, ends[i + 1], 0.0, 1.0);
#pragma omp parallel for schedule(static) if ((double)points * n > rb_pairs_for_threads)
    for (int k = 0; k < points; k++) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (int i = 0; i < n; i++)
            add_strip(&strip[i], p[i], q[i], xy[2 * k], xy[2 * k + 1], sum);
        for (int c = 0; c < 3; c++)
            stress[3 * k + c] = sum[c];
    }
    free(strip);
    return RB_OK;
}
