/* Stress between a layer and the smooth base on which it slides. */
#include "bem/bem.h"
#include "base/units.h"
#include "rolling/body/body.h"
#include "rolling/body/internal.h"
#include "rolling/body/surface.h"
#include "rolling/notes/note.h"
#include "rolling/solve/solution.h"

#include <math.h>

double rb_rolling_tension_of_base(const rb_rolling_case *rc, const rb_rolling_body *body,
                                  const rb_rolling_solution *s, double sign)
{
    enum { POINTS = 60 };
    const double mm = rb_unit_stored(s->units, "mm", 1.0),
                 MPa = rb_unit_stored(s->units, "MPa", 1.0),
                 from = mm * s->contact_from - 4.0 * body->layer,
                 to = mm * s->contact_to + 4.0 * body->layer;
    double length[RB_ROLLING_TERMS], xy[2 * POINTS], stress[3 * POINTS], most = 0.0;
    rb_arena scratch = {0};
    const size_t n = (size_t)s->n;
    double *x = rb_arena_doubles(&scratch, n, 3), *p = x ? x + n : NULL, *q = x ? p + n : NULL;
    rb_bem_layer_field *field = NULL;

    if (!x)
        return NAN;
    for (int i = 0; i < s->n; i++) {
        x[i] = mm * s->x[i];
        p[i] = MPa * s->p[i];
        q[i] = sign * MPa * s->q[i];
    }
    for (int k = 0; k < POINTS; k++) {
        xy[2 * k] = from + k * (to - from) / (POINTS - 1);
        xy[2 * k + 1] = body->layer;
    }
    const rb_bem_surface surface = rb_rolling_halfplane_surface(rc, body, length);
    const rb_bem_edge_load load = {s->n, x, p, q};
    const rb_bem_points points = {POINTS, xy};
    rb_status status = rb_bem_halfplane_stress_linear(&load, points, stress);
    if (status == RB_OK)
        status = rb_bem_layer_field_create(&surface, &load, &field, NULL);
    if (status == RB_OK)
        status = rb_bem_layer_field_add(field, points, stress, NULL);
    rb_bem_layer_field_free(field);
    for (int k = 0; k < POINTS && status == RB_OK; k++)
        most = fmax(most, stress[3 * k + 1]);
    rb_arena_free(&scratch);
    return status == RB_ENOMEM ? NAN : most / MPa;
}
