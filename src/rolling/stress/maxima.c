/* The largest stresses of body A (B8): looked for on its surface, along its bonds on both
 * sides of them, and inside; and the same computed again at known places. */
#include "rolling/body/body.h"
#include "rolling/stress/field.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/stress/search.h"

#include <math.h>

/* Of the layers of a half-plane, the last of which lies on the base, or of a cover. */
static int bonds_of(const rb_rolling_body *a)
{
    const int layers = rb_rolling_layers(a);
    return layers > 0 ? layers : a->cover > 0.0;
}

rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why)
{
    const rb_rolling_extremum none = {-INFINITY, NAN, NAN, RB_MATERIAL_BODY};
    rb_rolling_run run = {.last = -1};
    rb_arena memory = {0};
    rb_search f = {.model = model};

    *maxima = (rb_rolling_stress_maxima){.bonds = 0};
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s == RB_OK && rb_rolling_stress_maxima_alloc(bonds_of(&model->rc->a), maxima) != RB_OK)
        s = rb_fail(why, RB_ENOMEM, "out of memory for the largest stresses");
    if (s != RB_OK)
        return s;
    for (int i = 0; i < RB_SEARCH_IN_BODY; i++)
        *rb_rolling_maximum(maxima, i) = none;
    if (!rb_rolling_next_patch(model->rc, &model->mesh, &model->state, 0, &run))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    rb_phase("the largest stresses");
    s = rb_rolling_field_create(model, &f.field, why);
    if (s == RB_OK)
        s = rb_search_look(&f, depth, &memory, why);
    for (int i = 0; i < RB_SEARCH_IN_BODY && s == RB_OK; i++)
        s = rb_search_maximum(&f, rb_search_measure_of(i), rb_rolling_maximum(maxima, i), why);
    for (int k = 0; k < maxima->bonds && s == RB_OK; k++)
        s = rb_search_bond(&f, k, depth, maxima, why);
    if (s == RB_OK)
        s = rb_search_far(&f, depth, maxima, &memory, why);
    rb_rolling_field_free(f.field);
    rb_arena_free(&memory);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the largest stresses") : s;
}

rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why)
{
    const int measures = RB_SEARCH_IN_BODY + RB_SEARCH_OF_BOND * maxima->bonds;
    rb_arena memory = {0};
    double *xy = rb_arena_doubles(&memory, (size_t)measures, 2);
    rb_rolling_stress *at = rb_arena_zeros(&memory, (size_t)measures, sizeof *at);
    int n = 0, *which = rb_arena_zeros(&memory, (size_t)measures, sizeof *which);

    if (memory.failed)
        return rb_arena_done(&memory, RB_ENOMEM);
    for (int k = 0; k < measures; k++) {
        const rb_rolling_extremum *m = rb_rolling_maximum(maxima, k);
        if (isnan(m->x)) /* a bond without it, or none */
            continue;
        xy[2 * n] = m->x;
        xy[2 * n + 1] = m->y;
        /* digits that are lost in other units must not lead to the other side of the bond */
        const rb_rolling_body *a = &model->rc->a;
        for (int j = 0; j < rb_rolling_layers(a); j++) {
            const double bond = rb_rolling_bond_depth(a, j + 1);
            if (fabs(m->y - bond) < 1e-12 * bond)
                xy[2 * n + 1] = m->material == rb_search_strip_of(a, j + 1, INFINITY).material
                                    ? nextafter(bond, INFINITY)
                                    : bond;
        }
        which[n++] = k;
    }
    const rb_status s = rb_rolling_stress_at(model, n, xy, at, why);
    for (int k = 0; k < n && s == RB_OK; k++) {
        if (which[k] >= RB_SEARCH_IN_BODY && !rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT))
            rb_search_turn(model->rc->a.radius, &at[k]);
        rb_rolling_maximum(maxima, which[k])->value = rb_search_measure_of(which[k])(&at[k]);
    }
    return rb_arena_done(&memory, s);
}
