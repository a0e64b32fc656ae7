/* The kernel of a stack (L7): its remainder over the half-plane of the first layer, expanded in
 * Legendre's polynomials on panels of wave numbers, which are integrated with exp(ikx) in closed
 * form.  So the cost does not depend on x, and nothing is asked of the poles of the remainder. */
#include "bem/layers/layer.h"
#include "bem/layers/stack.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_expint.h>
#include <stdlib.h>

/* Polynomials of a panel, Gauss points by which they are found, panels in an octave. */
enum { DEGREES = 20, GAUSS = 24, PER_OCTAVE = 3 };
/* From this wave number on, over that of the first layer, the remainder is below rounding. */
static const double LAST = 24.0;
/* Over the least wave number at which something changes: where the panels begin. */
static const double FIRST = 1e-8;

/* Coefficients of Z/sigma on middle - half ... middle + half. */
typedef struct {
    double middle, half;
    double c[3][DEGREES];
} panel;

struct rb_bem_stack_kernel {
    int n;
    double from;        /* where the panels begin */
    double first[3];    /* Z there */
    double constant[3]; /* what does not depend on X */
    panel *panel;
};

/* Z = L - (1, 1, beta) of pressure, friction and coupling (L1). */
static void remainder_at(const rb_bem_stack_rows *rows, double (*C)[2][2], double k, double Z[3])
{
    const rb_bem_stack_row *top = &rows->row[0];

    rb_bem_stack_compliances(rows, k, C, NULL);
    Z[0] = C[0][1][1] / top->half[1][1] - 1.0;
    Z[1] = C[0][0][0] / top->half[0][0] - 1.0;
    Z[2] = (C[0][0][1] - top->half[0][1]) / top->half[0][0];
}

static void set_panel(const rb_bem_stack_rows *rows, double (*C)[2][2],
                      const gsl_integration_glfixed_table *rule, double from, double to, panel *p)
{
    *p = (panel){.middle = 0.5 * (from + to), .half = 0.5 * (to - from)};
    for (size_t g = 0; g < GAUSS; g++) {
        double t, weight, Z[3], before = 0.0, legendre = 1.0;
        gsl_integration_glfixed_point(-1.0, 1.0, g, &t, &weight, rule);
        const double sigma = p->middle + p->half * t;
        remainder_at(rows, C, sigma / rows->row[0].thickness, Z);
        for (int n = 0; n < DEGREES; n++) {
            for (int c = 0; c < 3; c++)
                p->c[c][n] += (n + 0.5) * weight * legendre * Z[c] / sigma;
            const double next = ((2 * n + 1) * t * legendre - n * before) / (n + 1);
            before = legendre;
            legendre = next;
        }
    }
}

/* The least wave number, over that of the first layer, at which the remainder changes: the height
 * of all layers, longer where they are stiffer than the base and softer than the first one. */
static double least_scale(const rb_bem_stack_rows *rows)
{
    const double top = rows->row[0].half[0][0], d = rows->row[0].thickness;
    double softest = top, stiffest = top;

    for (int j = 1; j < rows->n + rows->elastic_base; j++) {
        softest = fmax(softest, rows->row[j].half[0][0]);
        stiffest = fmin(stiffest, rows->row[j].half[0][0]);
    }
    return d / rows->height * stiffest / softest;
}

rb_bem_stack_kernel *rb_bem_stack_kernel_create(const rb_bem_surface *body, double reach)
{
    rb_bem_stack_rows *rows = rb_bem_stack_rows_of(body);
    rb_bem_stack_kernel *kernel = calloc(1, sizeof *kernel);
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    double(*C)[2][2] = rows ? malloc(((size_t)rows->n + 1) * sizeof *C) : NULL;
    int ok = rows && kernel && rule && C;

    if (ok) {
        kernel->from = FIRST * fmin(least_scale(rows), 1.0 / fmax(1.0, reach));
        kernel->n = (int)ceil(PER_OCTAVE * log2(LAST / kernel->from));
        kernel->panel = calloc((size_t)kernel->n, sizeof *kernel->panel);
        ok = kernel->panel != NULL;
    }
    for (int k = 0; k < (ok ? kernel->n : 0); k++) {
        const double step = log(LAST / kernel->from) / kernel->n;
        set_panel(rows, C, rule, kernel->from * exp(step * k), kernel->from * exp(step * (k + 1)),
                  &kernel->panel[k]);
    }
    if (ok) {
        /* Below the panels Z exp(i sigma X) - Z(0) exp(-sigma) is linear, and Z nearly Z(0). */
        double Z_0[3];
        gsl_sf_result cut;
        gsl_sf_expint_E1_scaled_e(kernel->from, &cut);
        rb_bem_layer_longest_waves(body, Z_0);
        remainder_at(rows, C, kernel->from / rows->row[0].thickness, kernel->first);
        for (int c = 0; c < 2; c++)
            kernel->constant[c] =
                kernel->first[c] - Z_0[c] + Z_0[c] * (kernel->from - exp(-kernel->from) * cut.val);
    }
    free(C);
    rb_bem_stack_rows_free(rows);
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    if (ok)
        return kernel;
    rb_bem_stack_kernel_free(kernel);
    return NULL;
}

void rb_bem_stack_kernel_free(rb_bem_stack_kernel *kernel)
{
    if (!kernel)
        return;
    free(kernel->panel);
    free(kernel);
}

/* Spherical Bessel functions j_0 ... j_n-1 of w >= 0: upwards where that is stable, otherwise
 * downwards from where they vanish.  GSL's gsl_sf_bessel_jl_steed_array gives up where w is large.
 */
static void bessel(int n, double w, double *j)
{
    enum { ABOVE = 40 };

    if (w == 0.0) {
        for (int k = 0; k < n; k++)
            j[k] = k == 0;
        return;
    }
    if (w > n) {
        j[0] = sin(w) / w;
        j[1] = (j[0] - cos(w)) / w;
        for (int k = 1; k + 1 < n; k++)
            j[k + 1] = (2 * k + 1) / w * j[k] - j[k - 1];
        return;
    }
    /* sum (2k + 1) j_k^2 = 1, and the sign is that of j_0 or j_1 */
    double above = 0.0, here = 1e-100, squares = 0.0;
    for (int k = n + ABOVE; k >= 0; k--) {
        squares += (2 * k + 1) * here * here;
        if (k < n)
            j[k] = here;
        const double next = (2 * k + 1) / w * here - above;
        above = here;
        here = next;
        if (fabs(here) > 1e100 && k > 0) {
            here *= 1e-100;
            above *= 1e-100;
            squares *= 1e-200;
            for (int i = k; i < n; i++)
                j[i] *= 1e-100;
        }
    }
    const double s_0 = sin(w) / w, s_1 = (s_0 - cos(w)) / w;
    const int by_first = fabs(s_0) > fabs(s_1);
    const double sign = (by_first ? s_0 * j[0] : s_1 * j[1]) < 0.0 ? -1.0 : 1.0;
    for (int k = 0; k < n; k++)
        j[k] *= sign / sqrt(squares);
}

void rb_bem_stack_kernel_at(const rb_bem_stack_kernel *kernel, double X, double of[3])
{
    of[0] = kernel->constant[0];
    of[1] = kernel->constant[1];
    of[2] = kernel->first[2] * kernel->from * X;
    for (int k = 0; k < kernel->n; k++) {
        const panel *p = &kernel->panel[k];
        double j[DEGREES];
        bessel(DEGREES, p->half * X, j);
        /* int f exp(i sigma X) = 2 half exp(i middle X) sum c_n i^n j_n(half X) */
        const double re = 2.0 * p->half * cos(p->middle * X),
                     im = 2.0 * p->half * sin(p->middle * X);
        for (int c = 0; c < 3; c++) {
            double even = 0.0, odd = 0.0;
            for (int n = 0; n < DEGREES; n += 4) {
                even += p->c[c][n] * j[n] - p->c[c][n + 2] * j[n + 2];
                odd += p->c[c][n + 1] * j[n + 1] - p->c[c][n + 3] * j[n + 3];
            }
            of[c] += c < 2 ? re * even - im * odd : re * odd + im * even;
        }
    }
}
