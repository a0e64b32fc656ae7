/* A layer bonded to a rigid or elastic base (L1)-(L3): transfer functions of the layer,
 * and what they add to the half-plane's element integrals, by Gauss's rule over wave
 * numbers. */
#include "bem/layer.h"

#include <cblas.h>
#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

/* Beyond this product of wave number and thickness the remainder is below rounding. */
static const double LAST = 24.0;
enum {
    GAUSS = 16,
    HALVINGS = 12,
    CHUNK = 64 /* panels whose products are formed together */
};

/* ---- Transfer functions (L2) ---------------------------------------------------------
 */

/* Normalised displacements of the surface under unit waves of pressure and friction. */
typedef struct {
    double complex N, T, C;
} transfer;

/* 1 + sum f_k/(1 - i k L_k): compliance of the layer's material over its glassy one. */
static double complex creep(const rb_bem_surface *body, double k)
{
    double complex c = 1.0;
    for (int j = 0; j < body->terms; j++)
        c += body->ratio[j] / (1.0 - I * k * body->length[j]);
    return c;
}

/* Stress function f = p cosh + s sinh + C eta sinh + D (eta cosh - sinh), eta = k y, of
 * the layer 0 <= eta <= al: the surface carries p and s already, C and D follow from the
 * bond to the base.  All hyperbolic functions are multiplied by 2 exp(-al). */
typedef struct {
    double al, nu;
    double complex rho; /* compliance of the base over 1/(2 G) (0: rigid) */
    double beta;
} bonded_layer;

static void bond(const bonded_layer *layer, double p, double s, double complex *C,
                 double complex *D)
{
    const double al = layer->al, nu = layer->nu, beta = layer->beta;
    const double complex rho = layer->rho;
    const double decay = exp(-2.0 * al), c = 1.0 + decay, h = -expm1(-2.0 * al);
    const double f[4] = {c, h, al * h, al * c - h}, f1[4] = {h, c, h + al * c, al * h},
                 f2[4] = {c, h, 2.0 * c + al * h, h + al * c},
                 f3[4] = {h, c, 3.0 * h + al * c, 2.0 * c + al * h};
    double complex u[4], v[4];
    for (int j = 0; j < 4; j++) {
        v[j] = (1.0 - nu) * f3[j] - (2.0 - nu) * f1[j] - rho * (f[j] + beta * f1[j]);
        u[j] = (1.0 - nu) * f2[j] + nu * f[j] + rho * (f1[j] + beta * f[j]);
    }
    const double complex b1 = -(p * v[0] + s * v[1]), b2 = -(p * u[0] + s * u[1]);
    const double complex det = v[2] * u[3] - v[3] * u[2];
    *C = (b1 * u[3] - v[3] * b2) / det;
    *D = (v[2] * b2 - b1 * u[2]) / det;
}

/* (L2) at al = k d; layer and base elastic, `softer`: compliance of the layer's material
 * over the glassy one. */
static transfer transfer_at(const rb_bem_surface *body, double al, double complex softer)
{
    const double nu = body->material.poisson;
    bonded_layer layer = {.al = al, .nu = nu};
    double complex C[2], D[2];

    if (body->elastic_base) {
        const double nu_2 = body->base.poisson;
        layer.rho = 2.0 * (1.0 - nu_2) * body->material.shear / body->base.shear / softer;
        layer.beta = (1.0 - 2.0 * nu_2) / (2.0 * (1.0 - nu_2));
    }
    bond(&layer, 1.0, 0.0, &C[0], &D[0]);
    bond(&layer, 0.0, 1.0, &C[1], &D[1]);
    return (transfer){.N = D[0], .T = -C[1], .C = -C[0] - 0.5 / (1.0 - nu)};
}

/* What the layer has over the half-plane: Z = softer (L - (1, 1, beta)). */
static transfer remainder_at(const rb_bem_surface *body, double al)
{
    const double nu = body->material.poisson;
    const double complex softer = creep(body, al / body->thickness);
    const transfer L = transfer_at(body, al, softer);
    return (transfer){softer * (L.N - 1.0), softer * (L.T - 1.0),
                      softer * (L.C - (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)))};
}

/* The base's compliance over the layer's glassy one, to which L.N and L.T tend for long
 * waves; 0 for a rigid base. */
static double base_compliance(const rb_bem_surface *body)
{
    const rb_bem_material a = body->material, b = body->base;
    return body->elastic_base
               ? (1.0 - b.poisson) * a.shear / ((1.0 - a.poisson) * b.shear)
               : 0.0;
}

/* ---- Panels of wave numbers
 * ------------------------------------------------------------ */

/* Ends of the panels in al: narrow enough for cos(al x/d), halved towards zero. */
static double *make_panels(const rb_bem_surface *body, double reach, int *count)
{
    const double d = body->thickness;
    double width = fmin(1.0, 3.0 * d / reach), longest = 0.0;
    for (int j = 0; j < body->terms; j++)
        longest = fmax(longest, body->length[j]);
    const int halvings = HALVINGS + (longest > d ? (int)ceil(log2(longest / d)) : 0);
    const double panels = ceil(LAST / width);
    if (!(panels < 1e7))
        return NULL;
    width = LAST / panels;
    *count = (int)panels + halvings;
    double *end = rb_alloc((size_t)*count + 1, 1);
    if (!end)
        return NULL;
    for (int k = 1; k <= halvings; k++)
        end[k] = ldexp(width, k - halvings - 1);
    for (int k = halvings + 1; k <= *count; k++)
        end[k] = (k - halvings) * width;
    return end;
}

/* ---- Products -------------------------------------------------------------------------
 */

/* With waves exp(i k (x - s)) split into those of the points and those of the strips, the
 * remainder is a product of thin matrices: W += P D, P: cosines and sines of the points
 * (points x 2 nodes), D: those of the strips with the transfer functions (2 nodes x n).
 */
typedef struct {
    const rb_bem_surface *body;
    int points, n;          /* of points and strips; */
    const double *x, *ends; /* all borrowed */
    int nodes;
    double *P, *N, *T, *C; /* P: points x 2 nodes; the others 2 nodes x n */
    double M0;             /* what the longest waves add over the half-plane, and */
    double *constant;      /* n: that of each strip everywhere */
} waves;

static void waves_free(waves *w)
{
    free(w->P);
    free(w->N);
    free(w->constant);
}

/* w: with body, points and strips. */
static rb_status waves_start(waves *w)
{
    const size_t room = 2 * GAUSS * CHUNK, columns = (size_t)w->n;
    w->M0 = 1.0 - base_compliance(w->body);
    for (int k = 0; k < w->body->terms; k++)
        w->M0 += w->body->ratio[k];
    w->P = rb_alloc((size_t)w->points, room);
    w->N = rb_alloc(room, 3 * columns);
    w->constant = rb_alloc(columns, 1);
    if (!w->P || !w->N || !w->constant) {
        waves_free(w);
        return RB_ENOMEM;
    }
    w->T = w->N + room * columns;
    w->C = w->T + room * columns;
    return RB_OK;
}

/* Node k of the rule, at al with this weight: Re[Z exp(i k (x - s))] and, for the
 * coupling, Im[Z exp(i k (x - s))]. */
static void set_node(waves *w, int k, double al, double weight)
{
    const size_t room = 2 * GAUSS * CHUNK, even = 2 * (size_t)k, odd = even + 1;
    const double *x = w->x, *ends = w->ends, wave = al / w->body->thickness;
    const transfer Z = remainder_at(w->body, al);

    for (size_t i = 0; i < (size_t)w->points; i++) {
        w->P[i + even * (size_t)w->points] = cos(wave * x[i]);
        w->P[i + odd * (size_t)w->points] = sin(wave * x[i]);
    }
    for (size_t j = 0; j < (size_t)w->n; j++) {
        const double h = ends[j + 1] - ends[j], half = 0.5 * wave * h;
        const double s = 0.5 * (ends[j] + ends[j + 1]), c_s = cos(wave * s),
                     s_s = sin(wave * s), a = weight / al * h * sin(half) / half;
        w->N[even + j * room] = a * (creal(Z.N) * c_s + cimag(Z.N) * s_s);
        w->N[odd + j * room] = a * (creal(Z.N) * s_s - cimag(Z.N) * c_s);
        w->T[even + j * room] = a * (creal(Z.T) * c_s + cimag(Z.T) * s_s);
        w->T[odd + j * room] = a * (creal(Z.T) * s_s - cimag(Z.T) * c_s);
        w->C[even + j * room] = a * (-creal(Z.C) * s_s + cimag(Z.C) * c_s);
        w->C[odd + j * room] = a * (creal(Z.C) * c_s + cimag(Z.C) * s_s);
        w->constant[j] += weight / al * h * w->M0 * exp(-al);
    }
}

/* block += scale P D. */
static void add_block(waves *w, double scale, const double *D, double *block, int ld)
{
    if (w->nodes > 0)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, w->points, w->n,
                    2 * w->nodes, scale, w->P, w->points, D, 2 * GAUSS * CHUNK, 1.0,
                    block, ld);
}

static void add_products(waves *w, double scale, double *W)
{
    const size_t points = (size_t)w->points, half = (size_t)w->n * 2 * points;
    const int ld = 2 * w->points;
    add_block(w, scale, w->N, W, ld);
    add_block(w, scale, w->T, W + half + points, ld);
    add_block(w, scale, w->C, W + half, ld);
    add_block(w, -scale, w->C, W + points, ld);
    w->nodes = 0;
}

static double reach_of(const waves *w)
{
    double low = w->ends[0], high = w->ends[w->n];
    for (int i = 0; i < w->points; i++) {
        low = fmin(low, w->x[i]);
        high = fmax(high, w->x[i]);
    }
    return high - low;
}

/* Long waves move the whole surface: as (L3) has it, and by the datum of an elastic base.
 */
static void add_constants(const waves *w, double scale, double *W)
{
    const rb_bem_surface *body = w->body;
    const double *ends = w->ends;
    const size_t points = (size_t)w->points, n = (size_t)w->n;
    const double base = base_compliance(body);
    const double datum = base > 0.0 ? base * log(body->datum / body->thickness) : 0.0;

    for (size_t j = 0; j < n; j++) {
        const double c = scale * (w->constant[j] + datum * (ends[j + 1] - ends[j]));
        double *N = W + j * 2 * points, *T = W + (j + n) * 2 * points + points;
        for (size_t i = 0; i < points; i++) {
            N[i] += c;
            T[i] += c;
        }
    }
}

/* All panels, one node after the other. */
static void integrate(waves *w, const gsl_integration_glfixed_table *rule, int panels,
                      const double *end, double *W)
{
    const rb_bem_material m = w->body->material;
    const double scale = (1.0 - m.poisson) / (M_PI * m.shear);

    for (int k = 0; k < panels; k++) {
        for (size_t g = 0; g < GAUSS; g++) {
            double al, weight;
            gsl_integration_glfixed_point(end[k], end[k + 1], g, &al, &weight, rule);
            set_node(w, w->nodes++, al, weight);
        }
        if (w->nodes == GAUSS * CHUNK || k + 1 == panels)
            add_products(w, scale, W);
    }
    add_constants(w, scale, W);
}

rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points,
                                     const double *x, int n, const double *ends,
                                     double *W)
{
    int panels = 0;
    waves w = {.body = body, .points = points, .n = n, .x = x, .ends = ends};
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    double *end = make_panels(body, reach_of(&w), &panels);
    const rb_status s = rule && end ? waves_start(&w) : RB_ENOMEM;

    if (s == RB_OK) {
        integrate(&w, rule, panels, end, W);
        waves_free(&w);
    }
    free(end);
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    return s;
}
