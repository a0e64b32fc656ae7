/* One implicit step of wear (theory-rolling.md W1, W4, W5): two contact problems, each of which
 * includes the wear of its own stage, halved where that is steep. */
#include "rolling/body/mesh.h"
#include "rolling/history/worn.h"
#include "rolling/solve/formulation.h"

#include <gsl/gsl_math.h>
#include <string.h>

/* The contact of these bodies with what is worn off so far.  sense: of full sliding, the sign of q;
 * 0: as it is pressed. */
rb_status rb_rolling_set_worn_problem(wear_state *r, const rb_rolling_bodies *bodies, double sense,
                                      rb_message *why)
{
    rb_rolling_model *model = &r->model;

    rb_contact_problem_free(&model->problem);
    rb_rolling_case worn = *model->rc;
    worn.worn = rb_rolling_worn_so_far(r);
    if (!r->wear->slides) {
        worn.shift = sense == 0.0 ? 0.0 : NAN;
        worn.force_ratio = sense == 0.0 ? NAN : sense;
    }
    rb_status s = rb_rolling_model_set_case(model, &worn, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_set_gap(model->rc, &model->mesh);
    if (s == RB_OK)
        s = rb_rolling_problem_create(model->rc, &model->mesh, bodies, NULL, &model->problem, why);
    return s;
}

/* (W1) y = g + k ds p - delta + F_NN p: the pressure wears its own part of the step off, so that
 * the worn gap and the pressure belong together at its end, however long it is.  Leaves the
 * pressure in the state, and the depth as it was. */
static rb_status press_softer(wear_state *r, double part, double sense, rb_message *why)
{
    /* The bodies, whose arrays are borrowed, softer under each element by what a step
     * wears. */
    const size_t n = (size_t)r->n, m = n + 1;
    rb_rolling_bodies softer = r->model.bodies;

    if (softer.F) {
        memcpy(r->softer, softer.F, 4 * m * n * sizeof *r->softer);
        for (size_t i = 0; i < n; i++)
            r->softer[i + 2 * m * i] += part * r->rate[i];
        softer.F = r->softer;
    } else {
        for (size_t i = 0; i < 2 * n; i++)
            r->softer[i] = (softer.f.compliance ? softer.f.compliance[i] : 0.0) +
                           (i < n ? part * r->rate[i] : 0.0);
        softer.f.compliance = r->softer;
    }
    const rb_status s = rb_rolling_set_worn_problem(r, &softer, sense, why);
    return s == RB_OK ? rb_rolling_model_resolve(&r->model, 1, why) : s;
}

/* (W5) A stage at each position of the stroke, as (W1) with what the pressures before it would
 * wear and, there alone, what the new one wears besides. */
static rb_status press_positions(wear_state *r, double part, const double *before, rb_message *why)
{
    rb_rolling_stroke *stroke = &r->stroke;
    const double rate = part * r->rate[0];
    rb_status s = RB_OK;

    rb_rolling_stroke_wear(stroke, rate, r->wear->share, before);
    for (int j = 0; j < stroke->positions && s == RB_OK; j++) {
        const double *p = before + j * r->n;
        rb_rolling_stroke_depth(stroke, stroke->at[j], r->depth);
        for (int i = 0; i < r->n; i++)
            r->depth[i] -= rate * p[i];
        s = press_softer(r, part, stroke->sense[j], why);
        if (s == RB_OK)
            memcpy(r->now + j * r->n, r->model.state.p, (size_t)r->n * sizeof *r->now);
    }
    rb_rolling_stroke_wear(stroke, -rate, r->wear->share, before);
    return s;
}

/* A stage under the gap there is, to the pressures `now`.  before: those of the stage before. */
rb_status rb_rolling_press_worn(wear_state *r, double part, const double *before, rb_message *why)
{
    if (r->stroke.positions > 0)
        return press_positions(r, part, before, why);
    const rb_status s = press_softer(r, part, 0.0, why);
    if (s == RB_OK)
        memcpy(r->now, r->model.state.p, (size_t)r->n * sizeof *r->now);
    return s;
}

void rb_rolling_wear_off(wear_state *r, double part, const double *p)
{
    if (r->stroke.positions > 0)
        rb_rolling_stroke_wear(&r->stroke, part * r->rate[0], r->wear->share, p);
    else
        for (int i = 0; i < r->n; i++)
            r->depth[i] += part * r->rate[i] * p[i];
}

/* What the present pressure carries [force/length], where A slides. */
double rb_rolling_carried_load(const wear_state *r)
{
    double sum = 0.0;

    for (int i = 0; i < r->n; i++)
        sum += r->now[i] * r->model.bodies.f.h[i];
    return sum;
}

/* 1: elements that carried nothing under the pressure p now carry more than this part of the
 * largest one.  A stage wears them by its own weight alone, so that they stand out afterwards.
 * Those on which the contact had only begun to lean do so where they carry more than their
 * neighbours. */
static int has_grown(const wear_state *r, const double *p, double most)
{
    static const double COUNTS = 1e-3;
    const int all = r->n * rb_rolling_wear_positions(r);
    const double p0 = rb_norm_inf((size_t)all, r->pressed);

    for (int i = 0; i < all; i++) {
        const double before = i > 0 ? r->now[i - 1] : 0.0, next = i + 1 < all ? r->now[i + 1] : 0.0;
        const int stands_out = p[i] < 0.5 * r->now[i] && r->now[i] > fmax(before, next);
        if ((p[i] <= COUNTS * p0 || stands_out) && r->now[i] - p[i] > most * p0)
            return 1;
    }
    return 0;
}

/* 1: a stage takes so much of the pressure off an element that the two stages together would wear
 * more there than any number of short ones: below 1/(1 + gamma z), z the last one at which the
 * stability function (1 - (1 - 2 gamma) z)/(1 + gamma z)^2 is not negative. */
static int is_steep(const wear_state *r)
{
    static const double LEAST = (1.0 - 2.0 * GAMMA) / (1.0 - GAMMA), COUNTS = 1e-3;
    const int all = r->n * rb_rolling_wear_positions(r);
    const double p0 = rb_norm_inf((size_t)all, r->pressed);

    for (int i = 0; i < all; i++)
        if (r->pressed[i] > COUNTS * p0 && r->now[i] < LEAST * r->pressed[i])
            return 1;
    return 0;
}

/* (W4) A part of a step; *mean: the load that its wear has carried, averaged.  Where it is steep it
 * is halved, and at last one implicit stage, which is of first order and never wears too much. */
rb_status rb_rolling_wear_advance(wear_state *r, double part, int halved, double *mean,
                                  rb_message *why)
{
    static const double NEW_1 = 0.02, NEW_2 = 0.1;
    enum { MOST_HALVED = 4 };
    const size_t all = (size_t)(r->n * rb_rolling_wear_positions(r));
    rb_status s = rb_rolling_press_worn(r, GAMMA * part, r->pressed, why);
    int steep = s == RB_OK && (is_steep(r) || has_grown(r, r->pressed, NEW_1));

    if (s == RB_OK && !steep) {
        memcpy(r->first, r->now, all * sizeof *r->first);
        rb_rolling_wear_off(r, (1.0 - GAMMA) * part, r->first);
        *mean = (1.0 - GAMMA) * rb_rolling_carried_load(r);
        s = rb_rolling_press_worn(r, GAMMA * part, r->first, why);
        steep = s == RB_OK && has_grown(r, r->first, NEW_2);
        if (steep)
            rb_rolling_wear_off(r, (GAMMA - 1.0) * part, r->first);
        else if (s == RB_OK) {
            rb_rolling_wear_off(r, GAMMA * part, r->now);
            *mean += GAMMA * rb_rolling_carried_load(r);
        }
    }
    if (s == RB_OK && steep && halved < MOST_HALVED) {
        double half[2] = {0.0, 0.0};
        s = rb_rolling_wear_advance(r, 0.5 * part, halved + 1, &half[0], why);
        if (s == RB_OK)
            s = rb_rolling_wear_advance(r, 0.5 * part, halved + 1, &half[1], why);
        *mean = 0.5 * (half[0] + half[1]);
        return s;
    }
    if (s == RB_OK && steep) {
        s = rb_rolling_press_worn(r, part, r->pressed, why);
        if (s == RB_OK) {
            rb_rolling_wear_off(r, part, r->now);
            *mean = rb_rolling_carried_load(r);
        }
    }
    if (s == RB_OK)
        memcpy(r->pressed, r->now, all * sizeof *r->pressed);
    return s;
}
