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
    CHUNK = 64,  /* panels whose products are formed together */
    BLOCK = 1024 /* points whose waves stand in memory, where no matrix is formed */
};

/* ---- Transfer functions (L2) ------------------------------------------------------- */

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

/* The layer 0 <= eta <= al and its bond. */
typedef struct {
    double al, nu;
    double complex rho; /* compliance of the base over 1/(2 G) (0: rigid) */
    double beta;
} bonded_layer;

/* What a function f with the derivatives f[1], f[2], f[3] at eta = al lacks of following
 * the base, along the surface and across it. */
static void miss_bond(const bonded_layer *layer, const double f[4], double complex *v,
                      double complex *u)
{
    const double nu = layer->nu, beta = layer->beta;
    *v = (1.0 - nu) * f[3] - (2.0 - nu) * f[1] - layer->rho * (f[0] + beta * f[1]);
    *u = (1.0 - nu) * f[2] + nu * f[0] + layer->rho * (f[1] + beta * f[0]);
}

/* The half-plane's own function misses the bond by what comes down to it; the two that
 * grow make up for that.  All are multiplied by 2 exp(-al). */
void rb_bem_layer_wave_at(const rb_bem_surface *body, double al, rb_bem_layer_wave *wave)
{
    bonded_layer layer = {.al = al, .nu = body->material.poisson};
    const double decay = exp(-2.0 * al), c = 1.0 + decay, h = -expm1(-2.0 * al);
    const double falls[2][4] = {{2.0 * decay * (1.0 + al), -2.0 * decay * al,
                                 2.0 * decay * (al - 1.0), 2.0 * decay * (2.0 - al)},
                                {2.0 * decay * al, 2.0 * decay * (1.0 - al),
                                 2.0 * decay * (al - 2.0), 2.0 * decay * (3.0 - al)}};
    const double grows[2][4] = {{al * h, h + al * c, 2.0 * c + al * h, 3.0 * h + al * c},
                                {al * c - h, al * h, h + al * c, 2.0 * c + al * h}};
    double complex v[2], u[2], falling_v, falling_u;

    if (body->elastic_base) {
        const double nu_2 = body->base.poisson;
        layer.rho = 2.0 * (1.0 - nu_2) * body->material.shear / body->base.shear /
                    creep(body, al / body->thickness);
        layer.beta = (1.0 - 2.0 * nu_2) / (2.0 * (1.0 - nu_2));
    }
    for (int j = 0; j < 2; j++)
        miss_bond(&layer, grows[j], &v[j], &u[j]);
    const double complex per_det = 1.0 / (v[0] * u[1] - v[1] * u[0]);
    for (int j = 0; j < 2; j++) {
        miss_bond(&layer, falls[j], &falling_v, &falling_u);
        wave->c[j] = (v[1] * falling_u - falling_v * u[1]) * per_det;
        wave->d[j] = (falling_v * u[0] - v[0] * falling_u) * per_det;
    }
}

/* What the layer has over the half-plane (L2): Z = softer (L - (1, 1, beta)). */
static transfer remainder_at(const rb_bem_surface *body, double al)
{
    const double complex softer = creep(body, al / body->thickness);
    rb_bem_layer_wave w;
    rb_bem_layer_wave_at(body, al, &w);
    return (transfer){softer * w.d[0], -softer * w.c[1], -softer * w.c[0]};
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

/* ---- Panels of wave numbers -------------------------------------------------------- */

/* Ends of the panels in al: narrow enough for cos(al x/d), which the rule integrates to
 * rounding over ten radians, halved towards zero. */
static double *make_panels(const rb_bem_surface *body, double reach, int *count)
{
    const double d = body->thickness;
    double width = fmin(1.0, 10.0 * d / reach), longest = 0.0;
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

/* ---- Products ---------------------------------------------------------------------- */

/* With waves exp(i k (x - s)) split into those of the points and those of the strips, the
 * remainder is a product of thin matrices: W += P D', P: cosines and sines of the points
 * (points x 2 nodes), D: those of the strips with the transfer functions (n x 2 nodes).
 */
typedef struct {
    const rb_bem_surface *body;
    int points, n, nodes;
    const double *x, *ends;
    double *P, *N, *T, *C; /* P: points x 2 nodes; the others n x 2 nodes */
    double *constant;      /* n: what long waves add everywhere */
} waves;

static void waves_free(waves *w)
{
    free(w->P);
    free(w->N);
    free(w->constant);
}

static rb_status waves_alloc(waves *w)
{
    const size_t room = 2 * GAUSS * CHUNK, n = (size_t)w->n;
    w->P = rb_alloc((size_t)w->points, room);
    w->N = rb_alloc(n, 3 * room);
    w->constant = rb_alloc(n, 1);
    if (!w->P || !w->N || !w->constant) {
        waves_free(w);
        return RB_ENOMEM;
    }
    w->T = w->N + n * room;
    w->C = w->T + n * room;
    return RB_OK;
}

/* Node k of the rule, at al with this weight: Re[Z exp(i k (x - s))] and, for the
 * coupling, Im[Z exp(i k (x - s))]. */
static void set_node(waves *w, double al, double weight, double M0, int k)
{
    const size_t points = (size_t)w->points, n = (size_t)w->n;
    const double wave = al / w->body->thickness, long_waves = M0 * exp(-al);
    const transfer Z = remainder_at(w->body, al);
    double *P = w->P + 2 * (size_t)k * points, *N = w->N + 2 * (size_t)k * n,
           *T = w->T + 2 * (size_t)k * n, *C = w->C + 2 * (size_t)k * n;

    for (size_t i = 0; i < points; i++) {
        const double t = wave * w->x[i];
        P[i] = cos(t);
        P[i + points] = sin(t);
    }
    for (size_t j = 0; j < n; j++) {
        const double h = w->ends[j + 1] - w->ends[j], half = 0.5 * wave * h;
        const double t = wave * 0.5 * (w->ends[j] + w->ends[j + 1]), c = cos(t),
                     s = sin(t), a = weight / al * h * sin(half) / half;
        N[j] = a * (creal(Z.N) * c + cimag(Z.N) * s);
        N[j + n] = a * (creal(Z.N) * s - cimag(Z.N) * c);
        T[j] = a * (creal(Z.T) * c + cimag(Z.T) * s);
        T[j + n] = a * (creal(Z.T) * s - cimag(Z.T) * c);
        C[j] = a * (-creal(Z.C) * s + cimag(Z.C) * c);
        C[j + n] = a * (creal(Z.C) * c + cimag(Z.C) * s);
        w->constant[j] += weight / al * h * long_waves;
    }
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

/* Adds scale times the nodes that are set to what is wanted of them. */
typedef void add_nodes(waves *w, double scale, void *to);

/* (1 - nu)/(pi shear), by which every wave counts. */
static double scale_of(const rb_bem_surface *body)
{
    return (1.0 - body->material.poisson) / (M_PI * body->material.shear);
}

/* What long waves add under strip j: as (L3) has it, and by the datum of an elastic base.
 */
static double constant_of(const waves *w, int j)
{
    const double base = base_compliance(w->body);
    const double datum =
        base > 0.0 ? base * log(w->body->datum / w->body->thickness) : 0.0;
    return scale_of(w->body) * (w->constant[j] + datum * (w->ends[j + 1] - w->ends[j]));
}

/* All panels, one node after the other. */
static rb_status integrate(waves *w, add_nodes *add, void *to)
{
    int panels = 0;
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(GAUSS);
    double *end = make_panels(w->body, reach_of(w), &panels);
    double M0 = 1.0 - base_compliance(w->body);

    for (int k = 0; k < w->body->terms; k++)
        M0 += w->body->ratio[k];
    for (int k = 0; rule && end && k < panels; k++) {
        for (size_t g = 0; g < GAUSS; g++) {
            double al, weight;
            gsl_integration_glfixed_point(end[k], end[k + 1], g, &al, &weight, rule);
            set_node(w, al, weight, M0, w->nodes++);
        }
        if (w->nodes == GAUSS * CHUNK || k + 1 == panels) {
            add(w, scale_of(w->body), to);
            w->nodes = 0;
        }
    }
    const rb_status s = rule && end ? RB_OK : RB_ENOMEM;
    free(end);
    if (rule)
        gsl_integration_glfixed_table_free(rule);
    return s;
}

/* ---- The matrix of all points and strips ------------------------------------------- */

/* W (2 points x 2n), and points x n that pressure moves along and, with the other sign,
 * friction moves down. */
typedef struct {
    double *W, *coupling;
} matrix;

/* block += scale P D'. */
static void add_block(const waves *w, double scale, const double *D, double *block,
                      int ld)
{
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, w->points, w->n, 2 * w->nodes,
                scale, w->P, w->points, D, w->n, 1.0, block, ld);
}

static void add_to_matrix(waves *w, double scale, void *to)
{
    const size_t points = (size_t)w->points, half = (size_t)w->n * 2 * points;
    const matrix *m = to;
    add_block(w, scale, w->N, m->W, 2 * w->points);
    add_block(w, scale, w->T, m->W + half + points, 2 * w->points);
    add_block(w, scale, w->C, m->coupling, w->points);
}

rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points,
                                     const double *x, int n, const double *ends,
                                     double *W)
{
    waves w = {.body = body, .points = points, .n = n, .x = x, .ends = ends};
    matrix to = {W, rb_alloc((size_t)points, (size_t)n)};
    rb_status s = to.coupling ? waves_alloc(&w) : RB_ENOMEM;

    if (s != RB_OK) {
        free(to.coupling);
        return s;
    }
    s = integrate(&w, add_to_matrix, &to);
    for (int j = 0; j < n; j++) {
        const double c = constant_of(&w, j),
                     *coupling = to.coupling + (size_t)j * (size_t)points;
        double *pressure = W + (size_t)j * 2 * (size_t)points,
               *friction = W + (size_t)(j + n) * 2 * (size_t)points;
        for (int i = 0; i < points; i++) {
            pressure[i] += c;
            pressure[i + points] -= coupling[i];
            friction[i] += coupling[i];
            friction[i + points] += c;
        }
    }
    free(to.coupling);
    waves_free(&w);
    return s;
}

/* ---- The displacement under given tractions ---------------------------------------- */

typedef struct {
    const rb_bem_edge_load *load;
    double *amplitude; /* of every wave, 2 nodes */
    double *w;         /* of the points */
} displacement;

/* w += scale P (N' p + C' q). */
static void add_to_displacement(waves *w, double scale, void *to)
{
    const displacement *d = to;
    const int waves_n = 2 * w->nodes;
    cblas_dgemv(CblasColMajor, CblasTrans, w->n, waves_n, scale, w->N, w->n, d->load->p,
                1, 0.0, d->amplitude, 1);
    cblas_dgemv(CblasColMajor, CblasTrans, w->n, waves_n, scale, w->C, w->n, d->load->q,
                1, 1.0, d->amplitude, 1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, w->points, waves_n, 1.0, w->P, w->points,
                d->amplitude, 1, 1.0, d->w, 1);
}

/* For the points of `all`, whose waves are formed together. */
static rb_status add_block_of_points(waves *all, displacement *to)
{
    double everywhere = 0.0;
    for (int j = 0; j < all->n; j++)
        all->constant[j] = 0.0;
    const rb_status s = integrate(all, add_to_displacement, to);
    for (int j = 0; j < all->n; j++)
        everywhere += constant_of(all, j) * to->load->p[j];
    for (int i = 0; i < all->points; i++)
        to->w[i] += everywhere;
    return s;
}

rb_status rb_bem_layer_add_normal(const rb_bem_surface *body,
                                  const rb_bem_edge_load *load, int points,
                                  const double *x, double *w)
{
    waves all = {.body = body,
                 .points = points < BLOCK ? points : BLOCK,
                 .n = load->n,
                 .x = x,
                 .ends = load->x};
    displacement to = {load, rb_alloc(2 * GAUSS * CHUNK, 1), w};
    rb_status s = to.amplitude ? waves_alloc(&all) : RB_ENOMEM;

    if (s != RB_OK) {
        free(to.amplitude);
        return s;
    }
    for (int first = 0; first < points && s == RB_OK; first += BLOCK) {
        all.points = points - first < BLOCK ? points - first : BLOCK;
        all.x = x + first;
        to.w = w + first;
        s = add_block_of_points(&all, &to);
    }
    waves_free(&all);
    free(to.amplitude);
    return s;
}
