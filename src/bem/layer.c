/* Displacements of a layer bonded to a rigid or elastic base (L3): the difference from
 * the element integrals of the half-plane, computed from the table of its kernel. */
#include "bem/layer.h"
#include "bem/internal.h"

#include <gsl/gsl_math.h>
#include <math.h>

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

rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points, const double *x, int n,
                                     const double *ends, double *W)
{
    const size_t m = (size_t)points, columns = (size_t)n;
    rb_bem_layer_remainder k;
    const rb_status s = rb_bem_layer_remainder_of(body, reach_of(points, x, n, ends), &k);

    if (s != RB_OK)
        return s;
#pragma omp parallel for schedule(static) if ((double)points * n > rb_pairs_for_threads)
    for (size_t j = 0; j < columns; j++) {
        double *pressure = W + j * 2 * m, *friction = W + (j + columns) * 2 * m;
        for (size_t i = 0; i < m; i++) {
            const rb_bem_layer_kernel e = under(&k, x[i], ends + j);
            pressure[i] += e.of[0];
            pressure[i + m] -= e.of[2];
            friction[i] += e.of[2];
            friction[i + m] += e.of[1];
        }
    }
    rb_bem_layer_table_release(k.table);
    return RB_OK;
}

rb_status rb_bem_layer_add_normal(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                  int points, const double *x, double *w)
{
    rb_bem_layer_remainder k;
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
