/* Stress in the half-plane y >= 0 loaded on y = 0 by constant strips (Flamant). */
#include "bem/internal.h"
#include "bem/complex.h"
#include "bem/kernels.h"
#include "rollbem/blas.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* One strip seen from (x, y), in the letters of kernels.h with t = +x, so that d = y; the
 * strip's own ends, where a jump of q makes sxx infinite, get the finite part. */
static rb_view_angles see_strip(const rb_element *strip, double x, double y)
{
    rb_view_angles v = rb_see(strip, x, y);
    if (v.W > 0.0)
        return rb_view_angles_of(strip, x, y);
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
    const rb_view_angles v = see_strip(strip, x, y);
    const double q_ = v.q, dQ = q_ * (2.0 * v.d * v.d - (v.rho - strip->a * strip->a)),
                 d2P = -2.0 * v.d * v.X * q_;
    stress[0] += (-p * (v.Th - dQ) + q * (2.0 * v.Lam + d2P)) / M_PI;
    stress[1] += (-p * (v.Th + dQ) - q * d2P) / M_PI;
    stress[2] += (-p * d2P - q * (v.Th - dQ)) / M_PI;
}

/* Far from all strips, in half-widths of the load from its middle, 48 terms of a series
 * are exact to 2^-48.  It pays for more points than it has terms. */
enum { TERMS = 48 };
static const double FAR = 2.0;

/* Muskhelishvili's Phi of the mirrored body y <= 0, f = p + i q on strips from x to x':
 *     2 pi i Phi = sum f (ln(x' - z) - ln(x - z)) = -sum_m v^m sum f (u'^m - u^m)/m
 * with v = half/(z - middle), u = (x - middle)/half. */
typedef struct {
    double middle, half;
    double complex moment[TERMS + 1]; /* of v^m, without 1/m */
} far_field;

static far_field far_field_of(const rb_bem_edge_load *load)
{
    const double first = load->x[0], last = load->x[load->n];
    far_field f = {.middle = 0.5 * (first + last), .half = 0.5 * (last - first)};

    for (int i = 0; i < load->n; i++) {
        const double u = (load->x[i] - f.middle) / f.half,
                     next = (load->x[i + 1] - f.middle) / f.half;
        double complex at = complex_of(load->q[i], -load->p[i]) / (-2.0 * M_PI), to = at;
        for (int m = 1; m <= TERMS; m++) {
            at *= u;
            to *= next;
            f.moment[m] += to - at;
        }
    }
    return f;
}

/* syy + i sxy = Phi(z) - Phi(conj z) + (z - conj z) conj(Phi'(z)), sxx + syy = 4 Re Phi;
 * z is the point's mirror image, whose shear has the other sign. */
static void far_stress(const far_field *f, double complex z, double *stress)
{
    const double complex v = f->half / (z - f->middle), above = conj(v);
    const int terms = (int)fmin(TERMS, ceil(TERMS * M_LN2 / -log(cabs(v))));
    double complex Phi = 0.0, Phi_above = 0.0, slope = 0.0;

    for (int m = terms; m >= 1; m--) {
        Phi = (Phi + f->moment[m] / m) * v;
        Phi_above = (Phi_above + f->moment[m] / m) * above;
        slope = (slope - f->moment[m]) * v;
    }
    slope *= v / f->half;
    const double complex vertical = Phi - Phi_above + (z - conj(z)) * conj(slope);
    stress[0] = 4.0 * creal(Phi) - creal(vertical);
    stress[1] = creal(vertical);
    stress[2] = cimag(vertical);
}

int rb_bem_edge_load_is_valid(const rb_bem_edge_load *load, int xs, rb_bem_points points)
{
    if (load->n < 1 || points.n < 0)
        return 0;
    for (int i = 0; i + 1 < xs; i++)
        if (!(load->x[i] < load->x[i + 1]))
            return 0;
    for (int k = 0; k < points.n; k++)
        if (!(points.xy[2 * k + 1] >= 0.0))
            return 0;
    return 1;
}

rb_status rb_bem_halfplane_stress(const rb_bem_edge_load *load, rb_bem_points points,
                                  double *stress)
{
    const int n = load->n;
    if (!rb_bem_edge_load_is_valid(load, n + 1, points))
        return RB_EINVAL;
    rb_element *strip = malloc((size_t)n * sizeof *strip);
    if (!strip)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        strip[i] = rb_element_make(load->x[i], 0.0, load->x[i + 1], 0.0, 1.0);
    const int is_series = points.n > TERMS && n > 1;
    const far_field far = is_series ? far_field_of(load) : (far_field){0.0, 0.0, {0.0}};
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * n > rb_pairs_for_threads)
    for (int k = 0; k < points.n; k++) {
        const double x = points.xy[2 * k], y = points.xy[2 * k + 1];
        double sum[3] = {0.0, 0.0, 0.0};
        if (is_series && hypot(x - far.middle, y) >= FAR * far.half)
            far_stress(&far, complex_of(x, -y), sum);
        else
            for (int i = 0; i < n; i++)
                add_strip(&strip[i], load->p[i], load->q[i], x, y, sum);
        for (int c = 0; c < 3; c++)
            stress[3 * k + c] = sum[c];
    }
    free(strip);
    return RB_OK;
}
