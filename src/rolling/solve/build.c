/* A case on a given mesh: bodies, contact problem and state are built and solved there.  Every
 * solve on any mesh passes through rb_rolling_model_resolve. */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/solve/coarse.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/model.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RATIO_ROUNDS = 40 };

/* Slip below this part of its scale is none. */
static const double AT_REST = 1e-9;

/* Where all of a period touches and sticks, equal friction everywhere moves nothing (P1): a shift
 * does not say how large it is. */
static rb_status check_determined(const rb_rolling_model *model, rb_message *why)
{
    const rb_contact_problem *p = &model->problem;

    if (!rb_rolling_fills_period(model->rc, &model->mesh) || p->force_given ||
        rb_rolling_mean_shears(model->rc))
        return RB_OK;
    for (int i = 0; i < p->n; i++)
        if (model->state.zone[i] == RB_ZONE_SEPARATED || p->bound[i] == 0.0 ||
            fabs(model->state.lambda[i]) > AT_REST * p->slip_length)
            return RB_OK;
    return rb_fail(why, RB_SINGULAR,
                   "all of the period touches and sticks, so that the force does not follow from "
                   "the shift; give --force");
}

rb_status rb_rolling_model_resolve(rb_rolling_model *model, int warm, rb_message *why)
{
    const double start = rb_seconds();
    const int iterates = rb_rolling_law_depends_on_state(model->rc);
    rb_status s =
        iterates ? rb_rolling_law_solve(model, warm, why)
                 : rb_rolling_problem_solve(&model->problem, model->rc, warm, &model->state, why);

    if (!iterates)
        model->iterations += model->state.iterations;
    model->seconds_lcp += rb_seconds() - start;
    if (s >= 0)
        model->half_width = rb_rolling_contact_half_width(
            model->rc, fmax(0.0, rb_contact_load(&model->problem, &model->state)));
    if (s == RB_OK)
        s = model->state.status = rb_rolling_check_enclosed(model, &model->state, why);
    if (s == RB_OK)
        s = model->state.status = check_determined(model, why);
    return s;
}

/* The end of a solve with status s.  A given creepage ratio refers to the load, which
 * approach control only finds: secants to the creepage that is the one of the load found
 * with it, as nearly as rounding lets them. */
static rb_status meet_ratio(rb_rolling_model *model, rb_status s, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    double step = NAN, excess_before = NAN, missing = INFINITY;

    if (isnan(rc->creep_ratio) || rc->formulation == RB_STATIC || model->problem.load_given)
        return s;
    for (int k = 0; s == RB_OK; k++) {
        const double xi = rb_rolling_creepage_of_ratio(model, rc->creep_ratio);
        const double excess = model->problem.xi - xi;
        missing = fabs(excess / xi);
        if (!(missing > 1e-13) || k == RATIO_ROUNDS)
            break;
        const double slope = k > 0 ? (excess - excess_before) / step : 1.0;
        step = -excess / (slope > 0.1 && slope < 10.0 ? slope : 1.0);
        excess_before = excess;
        model->problem.xi += step;
        s = rb_rolling_model_resolve(model, 1, why);
    }
    if (s == RB_OK && missing > fmax(rc->contact.tol, model->problem.rounding))
        s = model->state.status =
            rb_fail(why, RB_MAXITER,
                    "creep-ratio: the load changes with the creepage; after %d rounds "
                    "the two differ by %.2g of the creepage",
                    RATIO_ROUNDS, missing);
    return s;
}

rb_status rb_rolling_model_control(rb_rolling_model *model, rb_message *why)
{
    rb_rolling_set_control(model->rc, &model->problem);
    return meet_ratio(model, rb_rolling_model_resolve(model, 1, why), why);
}

int rb_rolling_gave_up(const rb_rolling_model *model)
{
    return model->problem.step_limit > 0 && model->state.status > 0;
}

/* Bodies, where they are not kept, contact problem and a state of zeros on the model's
 * mesh. */
static rb_status set_up(rb_rolling_model *model, int kept, rb_message *why)
{
    rb_status s = RB_OK;

    rb_contact_problem_free(&model->problem);
    if (!kept)
        rb_rolling_bodies_free(&model->bodies);
    if (model->far && !kept)
        s = rb_rolling_bodies_near(model->rc, model->far, &model->mesh, &model->bodies, why);
    else if (!kept)
        s = rb_rolling_bodies_create(model->rc, &model->plan, &model->mesh, &model->bodies, why);
    if (s == RB_OK)
        s = rb_rolling_problem_create(model->rc, &model->mesh, &model->bodies, NULL,
                                      &model->problem, why);
    if (s == RB_OK && model->plan.start)
        rb_rolling_start_bounds(model->rc, model->plan.start, &model->bodies, &model->problem);
    return s == RB_OK ? rb_contact_state_alloc(model->mesh.n, &model->state) : s;
}

rb_status rb_rolling_model_on_mesh(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   rb_rolling_mesh *mesh, rb_rolling_model *model, rb_message *why)
{
    const rb_status s = rb_rolling_model_set_case(model, rc, why);

    model->plan = plan ? *plan : rb_rolling_plan_of(rc);
    model->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    return s == RB_OK ? set_up(model, 0, why) : s;
}

rb_status rb_rolling_model_of_result(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                     const rb_rolling_elements *elements, rb_rolling_model *model,
                                     rb_message *why)
{
    rb_rolling_mesh mesh = {0};
    const rb_status s = rb_rolling_mesh_of_result(rc, elements, &mesh, why);

    return s == RB_OK ? rb_rolling_model_on_mesh(rc, plan, &mesh, model, why) : s;
}

rb_status rb_rolling_model_build(rb_rolling_model *model, rb_rolling_mesh *mesh, rb_message *why)
{
    /* What serves again: the bodies on the same elements; zones and tractions of elements whose
     * edges have been followed to these. */
    const int kept = model->same_bodies && model->mesh.n == mesh->n &&
                     memcmp(model->mesh.ends, mesh->ends,
                            ((size_t)model->mesh.n + 2) * sizeof *model->mesh.ends) == 0;
    const int near =
        model->state.p && model->state.status == RB_OK && model->rc->mesh != RB_MESH_UNIFORM;
    rb_rolling_mesh old_mesh = model->mesh;
    rb_contact_state old = model->state;
    double *bound = near ? rb_rolling_friction_of(model) : NULL;

    /* Half-planes under the same elements, all made longer by one factor, are not computed anew. */
    double scale, along;
    const int stretched =
        near && model->rc->mesh == RB_MESH_FITTED && model->rc->formulation == RB_STEADY &&
        model->problem.load_given && !model->problem.yield && !model->plan.start &&
        rb_rolling_bodies_stretch(model->rc, &old_mesh, mesh, &model->bodies, &scale, &along);
    rb_status s;

    /* Bodies, contact problem (K1)-(K3), and a state of zeros, on the new elements. */
    memset(&model->state, 0, sizeof model->state);
    model->mesh = *mesh;
    memset(mesh, 0, sizeof *mesh);
    if (stretched) {
        s = rb_rolling_problem_stretch(model->rc, &model->mesh, &model->bodies, scale, along,
                                       &model->problem, why);
        s = s == RB_OK ? rb_contact_state_alloc(model->mesh.n, &model->state) : s;
    } else {
        s = set_up(model, kept, why);
    }
    /* Where to begin: a small contact with nothing, as Lemke's method does; one that is followed
     * with the state before; a large one, which has no matrix, with fewer elements. */
    const int large = s == RB_OK && !model->bodies.F;
    const int warm = large || (s == RB_OK && near && model->rc->mesh == RB_MESH_FITTED);
    if (warm && near)
        rb_rolling_start_near(&old_mesh, &old, bound, model);
    else if (large)
        s = rb_rolling_start_from_coarse(model, why);
    free(bound);
    rb_contact_state_free(&old);
    rb_rolling_mesh_free(&old_mesh);
    /* The solve; a large contact whose start was bad once more from fewer elements. */
    if (s == RB_OK)
        s = meet_ratio(model, rb_rolling_model_resolve(model, warm, why), why);
    if (large && near && (s == RB_MAXITER || s == RB_SINGULAR)) {
        s = rb_rolling_start_from_coarse(model, why);
        if (s == RB_OK)
            s = meet_ratio(model, rb_rolling_model_resolve(model, 1, why), why);
    }
    /* A large contact that has failed gets a matrix: Lemke's method asks for it, and so does a
     * tolerance below GMRES's own. */
    const int inaccurate = s == RB_OK && model->state.residual > model->rc->contact.tol;
    const int most =
        model->problem.step_limit > 0 ? RB_ROLLING_STRONG_BY_MATRIX_UP_TO : RB_ROLLING_LARGE - 1;
    if (s < 0 || s == RB_ZONE || s == RB_INTERRUPTED || (s == RB_OK && !inaccurate) || !large ||
        model->mesh.n > most)
        return s;
    s = rb_rolling_model_add_matrix(model, why);
    if (s == RB_OK)
        s = rb_rolling_model_resolve(model, inaccurate, why);
    return meet_ratio(model, s, why);
}
