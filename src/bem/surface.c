/* Displacement of bodies whose influence function depends on the distance only, under
 * constant strips: the half-plane of Flamant (B6), with fading memory (V2), and the layer
 * on a base (L3). */
#include "bem/internal.h"
#include "bem/kernels.h"
#include "bem/layers/layer.h"
#include "bem/surface.h"

#include <gsl/gsl_math.h>
#include <math.h>

rb_bem_surface rb_bem_halfplane(rb_bem_material material, double datum)
{
    return (rb_bem_surface){.material = material, .datum = datum};
}

rb_status rb_bem_surface_check(const rb_bem_surface *body, rb_message *why)
{
    rb_status s = rb_bem_material_check(body->material, why);
    if (s == RB_OK && body->thickness > 0.0 && body->elastic_base)
        s = rb_bem_material_check(body->base, why);
    if (s != RB_OK)
        return s;
    if (!(body->thickness >= 0.0 && isfinite(body->thickness)))
        return rb_fail(why, RB_EINVAL, "layer of thickness %g: expected >= 0", body->thickness);
    const rb_bem_stack *stack = body->stack;
    if (stack && (stack->n < 2 || body->terms > 0 || body->thickness != stack->thickness[0]))
        return rb_fail(why, RB_EINVAL, "stack: expected two elastic layers or more, got %d",
                       stack->n);
    if (body->smooth_base && (body->thickness == 0.0 || stack || body->terms > 0))
        return rb_fail(why, RB_EINVAL, "smooth base: of one elastic layer only");
    for (int k = 0; stack && k < stack->n && s == RB_OK; k++)
        s = stack->thickness[k] > 0.0 && isfinite(stack->thickness[k])
                ? rb_bem_material_check(
                      rb_bem_material_from_young(stack->young[k], stack->poisson[k]), why)
                : rb_fail(why, RB_EINVAL, "layer %d of thickness %g: expected > 0", k + 1,
                          stack->thickness[k]);
    if (s != RB_OK)
        return s;
    if (!(body->period >= 0.0 && isfinite(body->period)))
        return rb_fail(why, RB_EINVAL, "period = %g: expected >= 0", body->period);
    if (body->period > 0.0 && (stack || body->terms > 0))
        return rb_fail(why, RB_EINVAL,
                       "period: of an elastic half-plane or one elastic layer only");
    if (body->period > 0.0 && body->thickness > 0.0 && body->thickness < 1e-3 * body->period)
        return rb_fail(why, RB_EINVAL,
                       "period: expected a layer of a thousandth of it or more, got %g",
                       body->thickness / body->period);
    const int has_datum = body->period == 0.0 && (body->thickness == 0.0 || body->elastic_base);
    if (has_datum && !(body->datum > 0.0 && isfinite(body->datum)))
        return rb_fail(why, RB_EINVAL, "datum = %g: expected a depth > 0", body->datum);
    for (int k = 0; k < body->terms; k++)
        if (!(body->ratio[k] >= 0.0 && isfinite(body->ratio[k]) && body->length[k] >= 0.0 &&
              isfinite(body->length[k])))
            return rb_fail(why, RB_EINVAL,
                           "memory term %d: ratio %g, length %g: expected numbers >= 0", k + 1,
                           body->ratio[k], body->length[k]);
    return RB_OK;
}

/* ---- One strip --------------------------------------------------------------------- */

/* int ln|s/d| ds over the strip of half-length b whose midpoint lies X from the point, |X| >= 4 b.
 * The difference of its two large parts is formed as X ln((X + b)/(X - b)), which is
 * 2 b (1 + t^2/3 + t^4/5 ...) with t = b/X, to rounding.  Without branches, so that loops are
 * vectorised. */
RB_INLINE double strip_log_far(double X, double b, double d)
{
    const double t = b / X, u = t * t, uu = u * u, uuuu = uu * uu;
    /* in pairs: a chain of thirteen would wait for each product */
    const double low = (1.0 / 3 + u * (1.0 / 5)) + uu * (1.0 / 7 + u * (1.0 / 9)),
                 middle = (1.0 / 11 + u * (1.0 / 13)) + uu * (1.0 / 15 + u * (1.0 / 17)),
                 high = (1.0 / 19 + u * (1.0 / 21)) + uu * (1.0 / 23 + u * (1.0 / 25));
    const double rise = u * (low + uuuu * (middle + uuuu * (high + uuuu * (1.0 / 27))));
    return b * (2.0 * rise + rb_log((X - b) / d * ((X + b) / d)));
}

/* The same anywhere.  Near: [s ln|s/d| - s]. */
static inline double strip_log(double X, double b, double d)
{
    const double s1 = X - b, s2 = X + b;
    if (fabs(X) < 4.0 * b) {
        const double l1 = s1 != 0.0 ? s1 * log(fabs(s1 / d)) : 0.0;
        const double l2 = s2 != 0.0 ? s2 * log(fabs(s2 / d)) : 0.0;
        return l2 - l1 - 2.0 * b;
    }
    return strip_log_far(X, b, d);
}

/* int ln(sin z/z) ds, z = pi s/L, over a strip of half-length b whose midpoint lies X from the
 * point: Gauss's rule on less than a sixteenth of the period, |s| < 0.6 L, meets it to 1e-16. */
static double strip_sinc(double X, double b, double period)
{
    static const double at[] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521},
                        weight[] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    double sum = 0.0;

    for (int k = 0; k < 6; k++) {
        const double s = X + (k % 2 ? b : -b) * at[k / 2], z = M_PI * s / period;
        sum += s != 0.0 ? weight[k / 2] * log(sin(z) / z) : 0.0;
    }
    return b * sum;
}

/* (P1) int ln|2 sin(pi s/L)| ds: the logarithm of the distance over L/(2 pi) near the strip, and a
 * smooth rest, on parts of the strip, each at its image next to the point. */
static double periodic_log(double X, double b, double period)
{
    const int parts = (int)ceil(32.0 * b / period);
    const double half = b / parts;
    double sum = 0.0;

    for (int k = 0; k < parts; k++) {
        const double at = remainder(X - b + (2 * k + 1) * half, period);
        sum += strip_log(at, half, period / (2.0 * M_PI)) + strip_sinc(at, half, period);
    }
    return sum;
}

rb_bem_strip_kernel rb_bem_strip_kernel_of(const rb_bem_surface *body)
{
    const rb_bem_material m = body->material;
    rb_bem_strip_kernel k = {body,
                             (1.0 - m.poisson) / (M_PI * m.shear),
                             (1.0 - 2.0 * m.poisson) / (4.0 * m.shear),
                             body->thickness > 0.0 ? body->thickness : body->datum,
                             1.0,
                             0.0,
                             0.0};
    k.raised = body->thickness > 0.0 ? 0.0 : k.K * body->datum_memory;
    for (int j = 0; j < body->terms; j++)
        k.slow += body->ratio[j];
    if (body->datum_tangential > 0.0)
        k.sheared = k.K * k.slow * log(body->datum_tangential / body->datum);
    return k;
}

/* w_N at a point under unit p and under unit q. */
typedef struct {
    double p, q;
} normal_entry;

static inline normal_entry entry_of(const rb_bem_strip_kernel *k, double X, double b)
{
    const double period = k->body->period;
    if (period > 0.0) {
        /* in the place of sgn(x - s) the saw sgn(u) - 2 u/L, u = x - s between -L and L */
        X = remainder(X, period);
        return (normal_entry){-k->K * periodic_log(X, b, period),
                              k->c * (-2.0 * fmin(fmax(X, -b), b) + 4.0 * X * b / period)};
    }
    /* int sgn(x - s) ds over the same strip: -2b where it lies ahead (X >= b). */
    double log = k->slow * strip_log(X, b, k->depth),
           sign = k->slow * (-2.0 * fmin(fmax(X, -b), b));
    if (k->body->terms > 0) {
        double log_memory, sign_memory;
        rb_bem_memory_integrals(k->body, -X, b, &log_memory, &sign_memory);
        log += log_memory;
        sign += sign_memory;
    }
    return (normal_entry){2.0 * b * k->raised - k->K * log, k->c * sign};
}

/* ---- Many -------------------------------------------------------------------------- */

/* W, 2m x 2n: displacements of the m points x under n strips.  Each point is the middle
 * between low[i] and high[i]: distances are differences of these and of the ends, exact
 * where the ends nearly meet (B9). */
static rb_status displacements(const rb_bem_surface *body, int n, const double *ends, int points,
                               const double *low, const double *high, const double *x, double *W)
{
    const rb_bem_strip_kernel k = rb_bem_strip_kernel_of(body);
    const size_t m = (size_t)points, alike = body->period > 0.0 || body->terms > 0 ? 0 : m;

    for (size_t j = 0; j < (size_t)n; j++) {
        double *N = W + j * 2 * m, *T = W + (j + (size_t)n) * 2 * m;
        const double b = 0.5 * (ends[j + 1] - ends[j]);
        if (rb_interrupted())
            return RB_INTERRUPTED;
        /* most points are far from the strip: all of them as if they were, in a loop that is
         * vectorised */
        for (size_t i = 0; i < alike; i++) {
            const double X = 0.5 * ((ends[j] - low[i]) + (ends[j + 1] - high[i]));
            N[i] = k.K * k.slow * -strip_log_far(X, b, k.depth) + 2.0 * b * k.raised;
            T[i] = copysign(2.0 * b * k.c * k.slow, -X);
        }
        for (size_t i = 0; i < m; i++) {
            const double X = 0.5 * ((ends[j] - low[i]) + (ends[j + 1] - high[i]));
            if (i >= alike || fabs(X) < 4.0 * b) {
                const normal_entry e = entry_of(&k, X, b);
                N[i] = e.p;
                T[i] = e.q;
            }
            T[m + i] = N[i] + 2.0 * b * k.sheared;
            N[m + i] = -T[i];
        }
    }
    return body->thickness > 0.0 ? rb_bem_layer_add_remainder(body, points, x, n, ends, W) : RB_OK;
}

rb_status rb_bem_surface_displacement(const rb_bem_surface *body, int n, const double *ends,
                                      int points, const double *x, double *W)
{
    if (rb_bem_surface_check(body, NULL) != RB_OK || n < 1 || points < 1)
        return RB_EINVAL;
    return displacements(body, n, ends, points, x, x, x, W);
}

rb_status rb_bem_surface_add_normal(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    int points, const double *x, double *w)
{
    const double *ends = load->x;
    if (rb_bem_surface_check(body, NULL) != RB_OK || load->n < 1 || points < 1)
        return RB_EINVAL;
    const rb_bem_strip_kernel kernel = rb_bem_strip_kernel_of(body);
    for (int j = 0; j < load->n; j++)
        for (int i = 0; i < points; i++) {
            const normal_entry e =
                entry_of(&kernel, 0.5 * ((ends[j] - x[i]) + (ends[j + 1] - x[i])),
                         0.5 * (ends[j + 1] - ends[j]));
            w[i] += e.p * load->p[j] + e.q * load->q[j];
        }
    return body->thickness > 0.0 ? rb_bem_layer_add_normal(body, load, points, x, w) : RB_OK;
}

rb_status rb_bem_flexibility_surface(int n_c, const double *ends, const rb_bem_surface *body,
                                     rb_bem_flexibility *f, rb_message *why)
{
    double *F = NULL;
    *f = (rb_bem_flexibility){0};
    rb_status s = rb_bem_surface_check(body, why);
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s != RB_OK)
        return s;
    s = rb_bem_flexibility_dense(n_c, f, &F);
    if (s == RB_OK) {
        rb_bem_flexibility_place(ends, f);
        s = displacements(body, n_c, ends, n_c + 1, ends, ends + 1, f->x, F);
    }
    return rb_bem_flexibility_end("half-plane", n_c, s, f, why);
}

rb_status rb_bem_flexibility_halfplane(int n_c, const double *ends, rb_bem_material material,
                                       double datum, rb_bem_flexibility *f, rb_message *why)
{
    const rb_bem_surface body = rb_bem_halfplane(material, datum);
    return rb_bem_flexibility_surface(n_c, ends, &body, f, why);
}
