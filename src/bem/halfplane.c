/* Stress in the half-plane y >= 0 loaded on y = 0 by constant strips (Flamant), or by
 * tractions that are linear between nodes. */
#include "bem/internal.h"
#include "bem/complex.h"
#include "bem/kernels.h"
#include "bem/surface.h"
#include "base/blas.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* From Flamant's  s_ij = -(2/pi) (p y + q x) x_i x_j/r^4, in the letters of kernels.h with
 * t = +x, so that d = y:  dQ = q_ (2 d^2 - dot), d2P = -2 d X q_, q_ = cross/W:
 *     sxx = -(p/pi) (Th - dQ) + (q/pi) (2 Lam + d2P)
 *     syy = -(p/pi) (Th + dQ) - (q/pi) d2P
 *     sxy = -(p/pi) d2P       - (q/pi) (Th - dQ)
 * The strip's own ends, where a jump of q makes sxx infinite, get the finite part. */
static void add_strip(const rb_element *strip, double p, double q, double x, double y,
                      double *stress)
{
    rb_view_angles v = rb_see(strip, x, y);
    if (v.W > 0.0) {
        v = rb_view_angles_of(strip, x, y);
    } else {
        v.q = v.Lam = 0.0;
        v.Th = 0.5 * M_PI;
    }
    const double dQ = v.q * (2.0 * v.d * v.d - (v.rho - strip->a * strip->a)),
                 d2P = -2.0 * v.d * v.X * v.q;
    stress[0] += (-p * (v.Th - dQ) + q * (2.0 * v.Lam + d2P)) / M_PI;
    stress[1] += (-p * (v.Th + dQ) - q * d2P) / M_PI;
    stress[2] += (-p * d2P - q * (v.Th - dQ)) / M_PI;
}

/* From here on, in half-widths of the load, two line loads per strip (Gauss) are exact to rounding,
 * while the angles and logarithms of ends that are so near to each other lose digits. */
static const double LINES = 1e4;

/* Flamant's line load (p, q), divided by no power of r that overflows. */
static void add_line(double p, double q, double x, double y, double *stress)
{
    const double r = hypot(x, y), c = x / r, s = y / r,
                 radial = -(p * s + q * c) * M_2_PI / r; /* the only stress */

    stress[0] += radial * c * c;
    stress[1] += radial * s * s;
    stress[2] += radial * c * s;
}

/* Tractions that are linear, from p, q at `from` to those at `to`. */
static void add_lines(double from, double to, const double p[2], const double q[2], double x,
                      double y, double *stress)
{
    const double h = to - from, near = 0.5 - 0.5 / sqrt(3.0);

    for (int k = 0; k < 2; k++) {
        const double part = k ? 1.0 - near : near;
        add_line(0.5 * h * (p[0] + part * (p[1] - p[0])), 0.5 * h * (q[0] + part * (q[1] - q[0])),
                 x - (from + part * h), y, stress);
    }
}

/* Far from all strips, in half-widths of the load from its middle, 48 terms of a series
 * are exact to 2^-48.  It pays for more points than it has terms. */
enum { TERMS = 48 };
static const double FAR = 2.0;

/* Muskhelishvili's Phi of the mirrored body y <= 0, f = p + i q on strips from x to x':
 *     2 pi i Phi = sum f (ln(x' - z) - ln(x - z)) = -sum_m v^m sum f (u'^m - u^m)/m
 * with v = half/(z - middle), u = (x - middle)/half.  Of tractions that are linear between
 * nodes, with the slopes f_u, and zero at both ends
 *     2 pi i Phi = sum_m v^m/m sum f_u (u'^(m + 1) - u^(m + 1))/(m + 1). */
typedef struct {
    double middle, half;
    double complex moment[TERMS + 1]; /* of v^m, without 1/m */
} far_field;

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
    /* two nodes at one place are a jump; elements have a length */
    const int jumps = xs == load->n;
    for (int i = 0; i + 1 < xs; i++)
        if (!(load->x[i] < load->x[i + 1] || (jumps && load->x[i] == load->x[i + 1])))
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
    const double first = load->x[0], last = load->x[n];
    far_field far = {.middle = 0.5 * (first + last), .half = 0.5 * (last - first)};
    for (int i = 0; is_series && i < n; i++) {
        const double u = (load->x[i] - far.middle) / far.half,
                     next = (load->x[i + 1] - far.middle) / far.half;
        double complex at = complex_of(load->q[i], -load->p[i]) / (-2.0 * M_PI), to = at;
        for (int m = 1; m <= TERMS; m++) {
            at *= u;
            to *= next;
            far.moment[m] += to - at;
        }
    }
    int stop = 0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * n > rb_pairs_for_threads)
    for (int k = 0; k < points.n; k++) {
        if (rb_interrupted_in_loop(&stop))
            continue;
        const double x = points.xy[2 * k], y = points.xy[2 * k + 1];
        const double away = hypot(x - far.middle, y);
        double sum[3] = {0.0, 0.0, 0.0};
        if (away >= LINES * far.half)
            for (int i = 0; i < n; i++)
                add_lines(load->x[i], load->x[i + 1], (double[]){load->p[i], load->p[i]},
                          (double[]){load->q[i], load->q[i]}, x, y, sum);
        else if (is_series && away >= FAR * far.half)
            far_stress(&far, complex_of(x, -y), sum);
        else
            for (int i = 0; i < n; i++)
                add_strip(&strip[i], load->p[i], load->q[i], x, y, sum);
        for (int c = 0; c < 3; c++)
            stress[3 * k + c] = sum[c];
    }
    free(strip);
    return stop ? RB_INTERRUPTED : RB_OK;
}

/* ---- Tractions that are linear between nodes --------------------------------------- */

/* ln(to - i y) - ln(from - i y), to - from = h, to its own digits also where it is small. */
static double complex log_of_ends(double from, double to, double h, double y)
{
    /* w = h/2 over the middle: 2 atanh(w), as a series where that is short */
    const double middle = 0.5 * (from + to), square = middle * middle + y * y;
    if (h * h < 4e-3 * square) {
        const double re = 0.5 * h * middle / square, im = 0.5 * h * y / square;
        const double re2 = re * re - im * im, im2 = 2.0 * re * im;
        double sum_re = 1.0 / 11.0, sum_im = 0.0;
        for (int k = 9; k >= 1; k -= 2) {
            const double next = sum_re * re2 - sum_im * im2 + 1.0 / k;
            sum_im = sum_re * im2 + sum_im * re2;
            sum_re = next;
        }
        return complex_of(2.0 * (re * sum_re - im * sum_im), 2.0 * (re * sum_im + im * sum_re));
    }
    /* the logarithm of the farther end's distance over the nearer one's */
    const double sum = from + to, near = sum < 0.0 ? to : from,
                 apart = 0.5 * log1p(h * fabs(sum) / (near * near + y * y));
    return complex_of(sum < 0.0 ? -apart : apart, atan2(y * h, from * to + y * y));
}

/* sxx is finite on the surface but for jumps of q.
 *
 * With g = -p + i q on y = 0 and Phi = (1/2 pi i) int g(t)/(t - z) dt (Muskhelishvili):
 *     sxx + syy = 4 Re Phi(z),
 *     syy - i sxy = Phi(z) - Phi(z*) + (z - z*) Phi'(z)*.
 * An interval between nodes t and t + h, on which g has the slope g', adds
 *     g(z) L + g' h to 2 pi i Phi,   g' L to 2 pi i Phi',   L = ln(t + h - z) - ln(t - z),
 * g(z) being g continued, and a jump [g] at t adds [g]/(t - z) to 2 pi i Phi'.  L is computed to
 * its own digits, also where it is small. */
rb_status rb_bem_halfplane_stress_linear(const rb_bem_edge_load *load, rb_bem_points points,
                                         double *stress)
{
    const int n = load->n;
    const double *nodes = load->x, *p = load->p, *q = load->q;
    if (n < 2 || !rb_bem_edge_load_is_valid(load, n, points))
        return RB_EINVAL;
    const double tiny = 1e-20 * (nodes[n - 1] - nodes[0]);
    double *rise_re = rb_alloc((size_t)n, 2), *rise_im = rise_re ? rise_re + n : NULL;
    if (!rise_re)
        return RB_ENOMEM;
    for (int j = 0; j + 1 < n; j++) {
        if (nodes[j] == nodes[j + 1])
            continue; /* a jump: no length, no share */
        rise_re[j] = (p[j] - p[j + 1]) / (nodes[j + 1] - nodes[j]);
        rise_im[j] = (q[j + 1] - q[j]) / (nodes[j + 1] - nodes[j]);
    }
    const int is_series = points.n > TERMS && n > 2;
    far_field far = {.middle = 0.5 * (nodes[0] + nodes[n - 1]),
                     .half = 0.5 * (nodes[n - 1] - nodes[0])};
    for (int j = 0; is_series && j + 1 < n; j++) {
        const double u = (nodes[j] - far.middle) / far.half,
                     next = (nodes[j + 1] - far.middle) / far.half;
        if (nodes[j] == nodes[j + 1]) {
            double complex jump = complex_of(q[j + 1] - q[j], p[j] - p[j + 1]) / (2.0 * M_PI);
            for (int m = 1; m <= TERMS; m++)
                far.moment[m] += jump *= u;
            continue;
        }
        double complex at =
            complex_of(q[j + 1] - q[j], p[j] - p[j + 1]) / (next - u) / (2.0 * M_PI);
        double complex to = at * next;
        at *= u;
        for (int m = 1; m <= TERMS; m++) {
            at *= u;
            to *= next;
            far.moment[m] += (to - at) / (m + 1);
        }
    }
    int stop = 0;
#pragma omp parallel for num_threads(rb_blas_loop_threads())                                       \
    schedule(static) if ((double)points.n * n > rb_pairs_for_threads)
    for (int i = 0; i < points.n; i++) {
        if (rb_interrupted_in_loop(&stop))
            continue;
        /* The logarithms at a node itself cancel, if both intervals see it from as near. */
        const double x = points.xy[2 * i], y = fmax(points.xy[2 * i + 1], tiny);
        const double away = hypot(x - far.middle, y);
        if (away >= LINES * far.half) {
            double *sum = stress + 3 * i;
            sum[0] = sum[1] = sum[2] = 0.0;
            for (int j = 0; j + 1 < n; j++)
                add_lines(nodes[j], nodes[j + 1], p + j, q + j, x, points.xy[2 * i + 1], sum);
            continue;
        }
        if (is_series && away >= FAR * far.half) {
            far_stress(&far, complex_of(x, -y), stress + 3 * i);
            continue;
        }
        /* of z and of its mirror image, whose L is the conjugate, and of Phi' */
        double above_re = 0.0, above_im = 0.0, below_re = 0.0, below_im = 0.0, slope_re = 0.0,
               slope_im = 0.0;
        for (int j = 0; j + 1 < n; j++) {
            const double h = nodes[j + 1] - nodes[j], from = nodes[j] - x, to = nodes[j + 1] - x;
            const double re = rise_re[j], im = rise_im[j];
            if (h == 0.0) {
                const double complex jump =
                    complex_of(p[j] - p[j + 1], q[j + 1] - q[j]) / complex_of(from, -y);
                slope_re += creal(jump);
                slope_im += cimag(jump);
                continue;
            }
            const double complex L = log_of_ends(from, to, h, y);
            const double log_re = creal(L), log_im = cimag(L);
            const double on_re = -p[j] - re * from, on_im = q[j] - im * from;
            const double at_re = on_re - y * im, at_im = on_im + y * re, /* g(z) */
                mirrored_re = on_re + y * im, mirrored_im = on_im - y * re;
            above_re += at_re * log_re - at_im * log_im + re * h;
            above_im += at_re * log_im + at_im * log_re + im * h;
            below_re += mirrored_re * log_re + mirrored_im * log_im + re * h;
            below_im += mirrored_im * log_re - mirrored_re * log_im + im * h;
            slope_re += re * log_re - im * log_im;
            slope_im += re * log_im + im * log_re;
        }
        const double complex above = complex_of(above_re, above_im),
                             below = complex_of(below_re, below_im),
                             slope = complex_of(slope_re, slope_im);
        const double complex c = 1.0 / (2.0 * M_PI * I);
        const double complex normal = c * above - c * below + 2.0 * I * y * conj(c * slope);
        stress[3 * i] = 4.0 * creal(c * above) - creal(normal);
        stress[3 * i + 1] = creal(normal);
        stress[3 * i + 2] = -cimag(normal);
    }
    free(rise_re);
    return stop ? RB_INTERRUPTED : RB_OK;
}
