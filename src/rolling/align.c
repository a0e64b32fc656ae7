/* Equal elements aligned with the contact: both edges are ends of elements, so that the
 * second-order slip operator has its second order (theory.md 4.7). */
#include "rolling/internal.h"

enum {
    FIRST = 30,     /* elements at least that the first edges are found with */
    COARSEST = 400, /* elements at most on the first level */
    LEVEL = 4,      /* binary digits fewer than on the next level: a sixteenth of it */
    ROUNDS = 10,
    BEYOND = 4 /* separated elements kept beyond either edge */
};
/* Edges that have come to rest, and edges that never will, in elements. */
static const double AT_REST = 1e-4, NEAR_REST = 5e-2;

/* The edges of the only patch.  RB_EINVAL: there are several; *known: 0 where it has too
 * few elements to tell. */
static rb_status find_edges(const rb_rolling_model *model, double *from, double *to,
                            int *known, rb_message *why)
{
    rb_rolling_run run = {.last = -1}, other;

    rb_rolling_next_patch(model->rc, &model->mesh, &model->state, 0, &run);
    *known = run.last - run.first + 1 >= RB_ROLLING_ALIGNED_LEAST;
    if (rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1,
                              &other) &&
        !rb_rolling_is_convex(model->rc))
        return rb_fail(
            why, RB_EINVAL,
            "mesh aligned: the contact has several patches, and equal elements "
            "cannot end at all their edges; use mesh fitted or uniform");
    *from = run.from;
    *to = run.to;
    return RB_OK;
}

/* `across` elements between the edges and some beyond them. */
static rb_status solve_on(rb_rolling_model *model, int across, double from, double to,
                          rb_message *why)
{
    const double h = (to - from) / across;
    rb_rolling_plan plan = model->plan;
    rb_rolling_mesh mesh;

    plan.elements = across + 2 * BEYOND;
    const rb_status s = rb_rolling_mesh_uniform(model->rc, &plan, from - BEYOND * h,
                                                to + BEYOND * h, &mesh, why);
    return s == RB_OK ? rb_rolling_model_build(model, &mesh, why) : s;
}

/* *rest: 0 where the edges did not come to rest, or no solution was found. */
static rb_status align(rb_rolling_model *model, int *rest, rb_message *why)
{
    const int across = model->plan.elements;
    double from, to, moved = INFINITY;
    int known;
    rb_status s = find_edges(model, &from, &to, &known, why);

    for (int round = 0; round < ROUNDS && known && s == RB_OK && moved > AT_REST;
         round++) {
        const double left = from, right = to, h = (to - from) / across;
        s = solve_on(model, across, from, to, why);
        if (s == RB_OK)
            s = find_edges(model, &from, &to, &known, why);
        moved = fmax(fabs(from - left), fabs(to - right)) / h;
    }
    *rest = s == RB_OK && known && moved <= NEAR_REST;
    return s == RB_ZONE ? RB_OK : s;
}

rb_status rb_rolling_model_realign(rb_rolling_model *model, rb_message *why)
{
    int rest;
    const rb_status s = align(model, &rest, why);

    model->equal_instead = s >= 0 && !rest;
    return model->equal_instead ? rb_rolling_solve_equal_instead(model, why) : s;
}

/* The first elements know an edge to a part of their own length, which is many lengths of
 * the last ones: level by level an edge stays well within the elements kept beyond it,
 * and on the last level one round is left. */
rb_status rb_rolling_solve_aligned(rb_rolling_model *model, rb_message *why)
{
    const int across = model->plan.elements;
    int digits = 0, rest = 1;

    while (across >> digits > COARSEST)
        digits += LEVEL;
    if (model->rc->zone == 0.0)
        model->plan.elements = (int)fmax(FIRST, (across >> digits) / 2);
    rb_status s = rb_rolling_solve_zone(model, 1, why);
    for (; s == RB_OK && rest && digits > 0; digits -= LEVEL) {
        model->plan.elements = across >> digits;
        s = align(model, &rest, why);
        model->iterations = 0; /* those of the last level count */
    }
    model->plan.elements = across;
    return s == RB_OK ? rb_rolling_model_realign(model, why) : s;
}
