/* A certificate of a history: each step is checked with the past that follows from the
 * earlier states, so that the slip is relative to the step before. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Steps ------------------------------------------------------------------------- */

typedef struct {
    rb_certificate *c;
    const json_t *residual; /* printed, an entry per step */
    rb_status status;
} step_check;

static int assess_step(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                       int steps, void *context)
{
    step_check *j = context;
    rb_certificate *c = j->c;

    (void)model; /* it is the certificate's own */
    (void)steps;
    c->step = step + 1;
    rb_certificate_tolerances(c, rb_certificate_number(json_array_get(j->residual, (size_t)step)));
    rb_certificate_given(c, h->normal_load[step]);
    rb_certificate_motion(c);
    j->status = rb_certificate_laws(c);
    c->step = 0;
    return j->status != RB_OK;
}

rb_status rb_certificate_follow(rb_certificate *c, const json_t *printed,
                                const rb_resolved_case *resolved, int n, rb_rolling_states *to,
                                rb_rolling_history *h, rb_message *why)
{
    const int steps = (int)json_array_size(json_object_get(printed, "approach"));
    step_check j = {c, json_object_get(printed, "residual"), RB_OK};
    const rb_rolling_observer observer = {assess_step, &j};
    const json_t *states = json_object_get(printed, "states");

    if (steps < 1)
        return rb_fail(why, RB_EFORMAT, "%s: cannot be checked: no steps", c->name);
    rb_status s = rb_rolling_states_alloc(n, steps, to);
    double *zone = rb_alloc((size_t)n, (size_t)steps), *substeps = rb_alloc((size_t)steps, 1);
    const struct {
        const json_t *table;
        const char *key;
        int n; /* 0: lists of all elements */
        double *to;
    } parts[] = {{c->table, "x_mm", n, to->x},
                 {c->table, "h_mm", n, to->h},
                 {states, "p_MPa", 0, to->p},
                 {states, "q_MPa", 0, to->q},
                 {states, "shift_mm", 0, to->lambda},
                 {states, "plastic_mm", 0, to->plastic},
                 {states, "zone", 0, zone},
                 {printed, "approach", steps, to->delta},
                 {printed, "substeps", steps, substeps},
                 {states, "motion", steps, to->xi}};
    if (s == RB_OK && (!zone || !substeps))
        s = RB_ENOMEM;
    for (size_t k = 0; k < sizeof parts / sizeof *parts && s == RB_OK; k++) {
        const char *key = parts[k].key;
        if (parts[k].to == to->plastic && !json_object_get(states, key))
            continue; /* nothing yields */
        s = parts[k].n > 0
                ? rb_certificate_column(c->name, parts[k].table, key, parts[k].n, parts[k].to, why)
                : rb_certificate_lists(c->name, "states: ", parts[k].table, key, steps, n,
                                       (size_t)n, parts[k].to, why);
    }
    for (size_t i = 0; i < (size_t)n * (size_t)steps && s == RB_OK; i++)
        if (!(zone[i] >= 0.0 && zone[i] <= 5.0) || zone[i] != floor(zone[i]))
            s = rb_fail(why, RB_EFORMAT, "%s: states: zone %g", c->name, zone[i]);
        else
            to->zone[i] = (int)zone[i];
    for (int k = 0; k < steps && s == RB_OK; k++)
        if (!(substeps[k] >= 1.0 && substeps[k] <= RB_ROLLING_MOST_STEPS) ||
            substeps[k] != floor(substeps[k]))
            s = rb_fail(why, RB_EFORMAT, "%s: history: %g substeps", c->name, substeps[k]);
        else
            to->substeps[k] = (int)substeps[k];
    free(zone);
    free(substeps);
    to->half_width = rb_certificate_member(printed, "half_width");
    if (json_object_get(printed, "row_changed")) { /* what more steps would change is not known */
        to->row_changes = rb_certificate_member(printed, "row_changes");
        to->row_changed = (int)json_integer_value(json_object_get(printed, "row_changed"));
    }
    to->program = resolved->program.n > 0 ? &resolved->program : NULL;
    if (s == RB_OK)
        s = rb_rolling_history_follow(&resolved->rc, to, &observer, &c->model, h, why);
    return j.status != RB_OK ? j.status : s;
}

/* ---- Columns ----------------------------------------------------------------------- */

/* rounding: of its numbers, as of a force that is none, or of the moment of a symmetric
 * pressure. */
static void compare_list(rb_certificate *c, const char *key, double rounding, const json_t *printed,
                         const json_t *again)
{
    double largest = 0.0;

    for (size_t k = 0; k < json_array_size(again); k++)
        largest = fmax(largest, fabs(rb_certificate_number(json_array_get(again, k))));
    if (json_array_size(printed) != json_array_size(again))
        rb_certificate_violated(c, "history: %zu numbers in %s, expected %zu",
                                json_array_size(printed), key, json_array_size(again));
    for (size_t k = 0; k < json_array_size(again); k++) {
        const double want = rb_certificate_number(json_array_get(again, k));
        const int whole = json_is_integer(json_array_get(again, k));
        c->step = (int)k + 1;
        rb_certificate_expect(c, key, 0, rb_certificate_number(json_array_get(printed, k)), want,
                              whole ? 0.0
                              : strcmp(key, "residual") == 0
                                  ? c->tol
                                  : 1e-9 * fabs(want) + 1e-12 * largest + rounding);
    }
    c->step = 0;
}

rb_status rb_certificate_compare_history(rb_certificate *c, const json_t *printed,
                                         const rb_rolling_history *h)
{
    rb_certificate_scales scales = {.half_width = h->half_width,
                                    .number = 1.0,
                                    .radius = rb_rolling_larger_radius(c->model.rc)};
    json_t *again = rb_report_json_history(h), *want;
    const char *key;

    if (!again)
        return RB_ENOMEM;
    for (int k = 0; k < h->n; k++) {
        scales.load = fmax(scales.load, h->normal_load[k]);
        scales.pressure = fmax(scales.pressure, h->max_pressure[k]);
    }
    json_object_foreach(again, key, want)
    {
        const json_t *value = json_object_get(printed, key);
        if (json_is_array(want))
            compare_list(c, key,
                         rb_certificate_rounding(&rb_rolling_history_columns, key, &scales, 0.0),
                         value, want);
        else if (json_is_real(want))
            rb_certificate_expect(c, key, 0, rb_certificate_number(value), json_real_value(want),
                                  1e-9 * fabs(json_real_value(want)));
        else if (!json_equal(value, want))
            rb_certificate_violated(c, "history: %s is not what it should be", key);
    }
    json_object_foreach((json_t *)printed, key, want)
    {
        if (!json_object_get(again, key) && strcmp(key, "states") != 0 &&
            strcmp(key, "derivatives") != 0 && strcmp(key, "derivatives_note") != 0 &&
            strcmp(key, "tolerances") != 0)
            rb_certificate_violated(c, "history: %s is no result of this case", key);
    }
    json_decref(again);
    return RB_OK;
}
