/* Displacements of a layer bonded to a rigid or elastic base (L3): the difference from
 * the element integrals of the half-plane, computed from the table of its kernel. */
#include "bem/layers/layer.h"
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>

rb_status rb_bem_layer_remainder_of(const rb_bem_surface *body, double reach,
                                    rb_bem_layer_remainder *k)
{
    const double base = rb_bem_layer_base_compliance(body), d = body->thickness,
                 everywhere = base > 0.0 ? base * log(body->datum / d) : 0.0;

    *k = (rb_bem_layer_remainder){.table = rb_bem_layer_table_of(body, reach / d),
                                  .scale = (1.0 - body->material.poisson) /
                                           (M_PI * body->material.shear),
                                  .everywhere = {everywhere, body->smooth_base ? 0.0 : everywhere},
                                  .d = d};
    return k->table ? RB_OK : RB_ENOMEM;
}

rb_bem_layer_kernel rb_bem_layer_primitive(const rb_bem_layer_remainder *k, double x)
{
    rb_bem_layer_kernel e = rb_bem_layer_integral(k->table, x / k->d);
    e.of[0] = k->scale * (e.of[0] * k->d + k->everywhere[0] * x);
    e.of[1] = k->scale * (e.of[1] * k->d + k->everywhere[1] * x);
    e.of[2] *= k->scale * k->d;
    return e;
}

static double reach_of(int points, const double *x, int n, const double *ends)
{
    double low = ends[0], high = ends[n];
    for (int i = 0; i < points; i++) {
        low = fmin(low, x[i]);
        high = fmax(high, x[i]);
    }
    return high - low;
}

/* Of the point at x under the strip between the two ends, times its length. */
static rb_bem_layer_kernel under(const rb_bem_layer_remainder *k, double x, const double ends[2])
{
    const double h = ends[1] - ends[0], by = k->scale * h,
                 X = 0.5 * ((x - ends[0]) + (x - ends[1]));
    rb_bem_layer_kernel e = rb_bem_layer_mean(k->table, X / k->d, 0.5 * h / k->d);
    e.of[0] = by * (e.of[0] + k->everywhere[0]);
    e.of[1] = by * (e.of[1] + k->everywhere[1]);
    e.of[2] *= by;
    return e;
}

/* Adds what the strip does at a point, to the point's entries of two columns, of u_N and m rows
 * below of u_T: under pressure and under friction.  The coupling is odd in x: its signs differ. */
static void add_at(rb_bem_layer_kernel e, double *pressure, double *friction, size_t m)
{
    pressure[0] += e.of[0];
    pressure[m] -= e.of[2];
    friction[0] += e.of[2];
    friction[m] += e.of[1];
}

/* ---- Of a period --------------------------------------------------------------------- */

/* Beyond, exp(-al) is rounding: the waves of a period that feel the base. */
static const double DEEPEST = 40.0;

/* The waves k = m 2 pi/L, m = 1 ... n, of (L3), Z[3 m - 3] over m, and the means over a period
 * under tractions of 1 on all of it (P1). */
typedef struct {
    int n;
    double scale, wave, mean[2], *Z; /* scale: as of rb_bem_layer_remainder; owned */
} period_waves;

static rb_status waves_of_period(const rb_bem_surface *body, period_waves *w)
{
    const rb_bem_material m = body->material;
    const double d = body->thickness, L = body->period;
    const int is_rigid = !body->elastic_base;

    *w = (period_waves){.n = (int)ceil(DEEPEST * L / (2.0 * M_PI * d)),
                        .scale = (1.0 - m.poisson) / (M_PI * m.shear),
                        .wave = 2.0 * M_PI / L};
    if (is_rigid)
        w->mean[0] =
            d / (2.0 * m.shear) *
            (body->smooth_base ? 1.0 - m.poisson : (1.0 - 2.0 * m.poisson) / (1.0 - m.poisson));
    if (is_rigid && !body->smooth_base)
        w->mean[1] = d / m.shear;
    w->Z = rb_alloc((size_t)w->n, 3);
    for (int j = 1; j <= w->n && w->Z; j++) {
        const double al = j * w->wave * d;
        double complex Z[3];
        rb_bem_layer_remainder_at(body, al, Z);
        if (body->smooth_base) /* the membrane is one of its waves here */
            Z[1] += 0.5 * (1.0 / al + 2.0) * exp(-2.0 * al);
        for (int c = 0; c < 3; c++)
            w->Z[3 * (j - 1) + c] = creal(Z[c]) / j;
    }
    return w->Z ? RB_OK : RB_ENOMEM;
}

/* As `under`: a wave over x, averaged over the point's strip.  exp(i k x) of each wave is the one
 * before it, turned once more. */
static rb_bem_layer_kernel under_waves(const period_waves *w, double L, double x,
                                       const double ends[2])
{
    const double h = ends[1] - ends[0], X = 0.5 * ((x - ends[0]) + (x - ends[1])),
                 half = 0.5 * w->wave * h;
    const double complex turn = cexp(I * w->wave * X), widen = cexp(I * half);
    double complex at = turn, wide = widen;
    rb_bem_layer_kernel e = {{0.0}};

    for (int j = 0; j < w->n; j++, at *= turn, wide *= widen) {
        const double *Z = w->Z + 3 * j, mean = cimag(wide) / ((j + 1) * half);
        e.of[0] += Z[0] * mean * creal(at);
        e.of[1] += Z[1] * mean * creal(at);
        e.of[2] += Z[2] * mean * cimag(at);
    }
    for (int c = 0; c < 3; c++)
        e.of[c] = h * (w->scale * e.of[c] + (c < 2 ? w->mean[c] / L : 0.0));
    return e;
}

static rb_status add_period(const rb_bem_surface *body, int points, const double *x, int n,
                            const double *ends, double *W)
{
    const size_t m = (size_t)points, columns = (size_t)n;
    period_waves w;
    const rb_status s = waves_of_period(body, &w);

#pragma omp parallel for schedule(static) if ((double)points * n > rb_pairs_for_threads)
    for (size_t j = 0; j < (s == RB_OK ? columns : 0); j++) {
        for (size_t i = 0; i < m; i++)
            add_at(under_waves(&w, body->period, x[i], ends + j), W + i + j * 2 * m,
                   W + i + (j + columns) * 2 * m, m);
    }
    free(w.Z);
    return s;
}

static rb_status add_normal_of_period(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                      int points, const double *x, double *u)
{
    period_waves w;
    const rb_status s = waves_of_period(body, &w);

    for (int i = 0; i < points && s == RB_OK; i++)
        for (int j = 0; j < load->n; j++) {
            const rb_bem_layer_kernel e = under_waves(&w, body->period, x[i], load->x + j);
            u[i] += e.of[0] * load->p[j] + e.of[2] * load->q[j];
        }
    free(w.Z);
    return s;
}

/* ---- All together -------------------------------------------------------------------- */

rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points, const double *x, int n,
                                     const double *ends, double *W)
{
    const size_t m = (size_t)points, columns = (size_t)n;
    rb_bem_layer_remainder k;
    if (body->period > 0.0)
        return add_period(body, points, x, n, ends, W);
    const rb_status s = rb_bem_layer_remainder_of(body, reach_of(points, x, n, ends), &k);

    if (s != RB_OK)
        return s;
#pragma omp parallel for schedule(static) if ((double)points * n > rb_pairs_for_threads)
    for (size_t j = 0; j < columns; j++) {
        for (size_t i = 0; i < m; i++)
            add_at(under(&k, x[i], ends + j), W + i + j * 2 * m, W + i + (j + columns) * 2 * m, m);
    }
    rb_bem_layer_table_release(k.table);
    return RB_OK;
}

rb_status rb_bem_layer_add_normal(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                  int points, const double *x, double *w)
{
    rb_bem_layer_remainder k;
    if (body->period > 0.0)
        return add_normal_of_period(body, load, points, x, w);
    const rb_status s = rb_bem_layer_remainder_of(body, reach_of(points, x, load->n, load->x), &k);

    if (s != RB_OK)
        return s;
#pragma omp parallel for schedule(static) if ((double)points * load->n > rb_pairs_for_threads)
    for (int i = 0; i < points; i++)
        for (int j = 0; j < load->n; j++) {
            const rb_bem_layer_kernel e = under(&k, x[i], load->x + j);
            w[i] += e.of[0] * load->p[j] + e.of[2] * load->q[j];
        }
    rb_bem_layer_table_release(k.table);
    return RB_OK;
}
