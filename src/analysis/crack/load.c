/* The stress below the tractions where there is no crack, as nodal forces (C5). */
#include "analysis/crack/internal.h"

#include <stdlib.h>
#include <string.h>

enum { POINTS = 6 };

double rb_crack_pressure(const rb_bem_edge_load *load, rb_crack_load_kind kind, double x)
{
    const int intervals = kind == RB_CRACK_NODES ? load->n - 1 : load->n;
    for (int i = 0; i < intervals; i++)
        if (load->x[i] <= x && x < load->x[i + 1])
            return kind == RB_CRACK_STRIPS
                       ? load->p[i]
                       : load->p[i] + (load->p[i + 1] - load->p[i]) * (x - load->x[i]) /
                                          (load->x[i + 1] - load->x[i]);
    return 0.0;
}

rb_status rb_crack_load(const rb_crack *c, const rb_bem_edge_load *load, rb_crack_load_kind kind,
                        double x, double tension, double *T)
{
    const size_t points = (size_t)c->shape.elements * POINTS;
    const int entries = load ? load->n : 0;
    gsl_integration_glfixed_table *const rule[2] = {gsl_integration_glfixed_table_alloc(POINTS),
                                                    NULL};
    rb_crack_point *point = calloc(points, sizeof *point);
    double *xy = rb_alloc(points, 5), *stress = xy ? xy + 2 * points : NULL;
    double *q = rb_alloc((size_t)entries + 1, 1);
    rb_status s = rule[0] && point && xy && q ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) { /* B is the mirror image of a body y > 0; q is the friction on A */
        for (int k = 0; k < c->shape.elements; k++)
            rb_crack_points(&c->element[k], 0, 0, rule, point + k * POINTS);
        for (size_t k = 0; k < points; k++) {
            xy[2 * k] = creal(point[k].z) - x;
            xy[2 * k + 1] = -cimag(point[k].z);
        }
        for (int i = 0; i < entries; i++)
            q[i] = -load->q[i];
        if (load)
            s = (kind == RB_CRACK_NODES ? rb_bem_halfplane_stress_linear : rb_bem_halfplane_stress)(
                &(rb_bem_edge_load){entries, load->x, load->p, q}, (rb_bem_points){(int)points, xy},
                stress);
    }
    memset(T, 0, 2 * (size_t)c->n * sizeof *T);
    for (size_t k = 0; k < points && s == RB_OK; k++) {
        const int element = (int)k / POINTS;
        const double sxx = stress[3 * k] + tension, syy = stress[3 * k + 1],
                     sxy = -stress[3 * k + 2];
        const double complex n = I * c->element[element].t;
        const double complex traction =
            sxx * creal(n) + sxy * cimag(n) + I * (sxy * creal(n) + syy * cimag(n));
        for (int end = 0; end < 2; end++) {
            const int j = element + end - c->first;
            if (j < 0 || j >= c->n)
                continue;
            const double weight = point[k].weight * point[k].hat[end];
            T[j] += weight * creal(traction * conj(I * c->t[j]));
            T[j + c->n] += weight * creal(traction * conj(c->t[j]));
        }
    }
    if (rule[0])
        gsl_integration_glfixed_table_free(rule[0]);
    free(point);
    free(xy);
    free(q);
    return s;
}
