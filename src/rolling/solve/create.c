/* From a case to its solved contact problem on the given kind of mesh, and the
 * free-rolling creepage. */
#include "rolling/body/far_field.h"
#include "rolling/case/internal.h"
#include "rolling/solve/fit.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_rolling_model_create(const rb_rolling_case *rc, rb_rolling_model *model,
                                  rb_message *why)
{
    memset(model, 0, sizeof *model);
    return rb_rolling_model_reuse(rc, NULL, model, why);
}

static rb_status solve_on_mesh(rb_rolling_model *model, rb_message *why)
{
    switch (model->rc->mesh) {
    case RB_MESH_FITTED:
        return rb_rolling_solve_fitted(model, why);
    case RB_MESH_ALIGNED:
        return rb_rolling_solve_aligned(model, why);
    case RB_MESH_PUNCH:
        return rb_rolling_solve_punch(model, why);
    default:
        return rb_rolling_solve_zone(model, 0, why);
    }
}

/* A force that is too much on the way to the mesh of the case may not be too much on it, and
 * the largest force that a refusal names is that on it.  So the contact that slides as it does
 * under the largest force gets its mesh, on which the force is tried again; edges that lie
 * elsewhere under this force get theirs. */
static rb_status solve_beside_sliding(rb_rolling_model *model, const rb_rolling_case *rc,
                                      rb_message *why)
{
    const rb_rolling_case wanted = *rc; /* rc may be the model's */
    rb_rolling_case sliding = rb_rolling_without_force(rc);
    double edge[4];

    sliding.force_ratio = NAN;
    *(rc->formulation == RB_STATIC ? &sliding.shift : &sliding.creep) = model->state.refused_at;
    rb_status s = rb_rolling_model_set_case(model, &sliding, why);
    if (s == RB_OK)
        s = solve_on_mesh(model, why);
    if (s == RB_OK) {
        rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &edge[0], &edge[1]);
        s = rb_rolling_model_set_case(model, &wanted, why);
    }
    if (s == RB_OK)
        s = rb_rolling_model_control(model, why);
    if (s != RB_OK || model->equal_instead || wanted.mesh == RB_MESH_UNIFORM ||
        wanted.mesh == RB_MESH_PUNCH)
        return s;
    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &edge[2], &edge[3]);
    const double moved = fmax(fabs(edge[2] - edge[0]), fabs(edge[3] - edge[1]));
    if (moved <= 0.5 * RB_ROLLING_REFIT * (edge[1] - edge[0]))
        return s;
    return wanted.mesh == RB_MESH_FITTED ? rb_rolling_model_refit(model, why)
                                         : rb_rolling_model_realign(model, why);
}

rb_status rb_rolling_model_reuse(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why)
{
    /* Bodies on the same equal elements are the dearest part of a case: they stay where `build`
     * finds the same ends. */
    rb_rolling_model kept = {.plan = plan ? *plan : rb_rolling_plan_of(rc)};
    const int equal = model->rc && model->rc->mesh == RB_MESH_UNIFORM;

    if (equal && rc->mesh == RB_MESH_UNIFORM && model->mesh.ends && model->bodies.f.m) {
        kept.mesh = model->mesh;
        kept.bodies = model->bodies;
        kept.same_bodies = 1;
        model->mesh = (rb_rolling_mesh){.ends = NULL};
        model->bodies = (rb_rolling_bodies){.F = NULL};
    }
    rb_rolling_model_free(model);
    *model = kept;
    rb_status s = rb_rolling_model_set_case(model, rc, why);
    if (s == RB_OK)
        s = rb_rolling_case_check(rc, why);
    if (s == RB_OK)
        s = solve_on_mesh(model, why);
    if (s == RB_EINVAL && model->state.refused_at != 0.0 && rc->formulation != RB_TRANSIENT)
        s = solve_beside_sliding(model, rc, why);
    model->same_bodies = 0;
    return s;
}

rb_rolling_case rb_rolling_without_force(const rb_rolling_case *rc)
{
    rb_rolling_case freely = *rc;

    freely.creep = freely.creep_ratio = freely.force = NAN;
    freely.free_axle = 0;
    freely.force_ratio = 0.0;
    return freely;
}

/* On a mesh of its own: a fitted one belongs to the contact that rolls freely.  That of a wheel is
 * found beside the mesh of the model, whose boundary is solved.  A model that has all its parts is
 * kept for derivatives. */
static rb_status roll_freely_anew(rb_rolling_model *model, double *creepage, rb_message *why)
{
    const rb_rolling_case rc = rb_rolling_without_force(model->rc);
    const int fits = rc.mesh == RB_MESH_FITTED && rb_rolling_has_far_field(&rc) &&
                     !model->equal_instead && model->state.status == RB_OK &&
                     !rb_rolling_law_depends_on_state(&rc);
    rb_status s = RB_MAXITER;

    rb_rolling_forget_free_rolling(model);
    rb_rolling_model *freely = model->freely = calloc(1, sizeof *freely);
    if (!freely)
        return RB_ENOMEM;
    if (fits)
        s = rb_rolling_model_begin(&rc, &model->plan, freely, why);
    if (fits && s == RB_OK)
        s = rb_rolling_fit_beside(model, freely, why);
    if (s > 0 || freely->equal_instead) {
        rb_rolling_model_free(freely);
        s = rb_rolling_model_create(&rc, freely, why);
    }
    if (s == RB_OK)
        *creepage = freely->state.xi;
    if (s != RB_OK || freely->far)
        rb_rolling_forget_free_rolling(model);
    return s;
}

/* On the same equal elements and with the same bodies, without a matrix unless it comes to
 * ask for one: starts on fewer elements. */
static rb_status roll_freely_large(rb_rolling_model *model, double *creepage, rb_message *why)
{
    const double from = model->mesh.ends[0], to = model->mesh.ends[model->mesh.n];
    const rb_rolling_case rc = rb_rolling_without_force(model->rc);
    rb_rolling_plan plan = model->plan;
    rb_rolling_model freely;
    rb_rolling_mesh mesh;

    plan.elements = model->mesh.n;
    rb_status s = rb_rolling_model_begin(&rc, &plan, &freely, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_uniform(&rc, &plan, from, to, &freely.mesh, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_uniform(&rc, &plan, from, to, &mesh, why);
    if (s == RB_OK) {
        freely.same_bodies = 1;
        freely.bodies = model->bodies;
        s = rb_rolling_model_build(&freely, &mesh, why);
        model->bodies = freely.bodies;
        freely.bodies = (rb_rolling_bodies){.F = NULL};
        if (model->bodies.F) {
            const rb_status t =
                rb_rolling_problem_renew_operator(model->rc, &model->bodies, &model->problem, why);
            /* the operator would use bodies that are gone */
            if (t != RB_OK)
                rb_contact_state_free(&model->state);
            s = t == RB_OK ? s : t;
        }
    }
    if (s == RB_OK)
        *creepage = freely.state.xi;
    rb_rolling_model_free(&freely);
    return s;
}

/* On the same elements with the model's matrix, from its zones. */
static rb_status roll_freely_dense(rb_rolling_model *model, double *creepage, rb_message *why)
{
    rb_contact_problem problem = model->problem; /* arrays stay the model's */
    rb_contact_state state;
    rb_status s = rb_contact_state_alloc(problem.n, &state);

    if (s != RB_OK)
        return s;
    /* Q = 0 is given and xi unknown (K6). */
    problem.force_given = 1;
    problem.force = problem.force_ratio = problem.axle = 0.0;
    memcpy(state.zone, model->state.zone, (size_t)problem.n * sizeof(int));
    s = rb_rolling_problem_solve(&problem, model->rc, 1, &state, why);
    if (s == RB_OK)
        s = rb_rolling_check_enclosed(model, &state, why);
    if (s == RB_OK)
        *creepage = state.xi;
    rb_contact_state_free(&state);
    return s;
}

rb_status rb_rolling_free_creepage(rb_rolling_model *model, double *creepage, rb_message *why)
{
    /* Similar bodies without a history roll freely at no creepage but that of their strains. */
    const double strain = rb_rolling_bulk_strain(model->rc);
    const rb_contact_problem *p = &model->problem;
    int rests = !rb_contact_operator_response(p->op).coupled;
    for (int i = 0; i < p->n && rests; i++)
        rests = p->d_T[i] + strain * p->e_T[i] == 0.0;
    *creepage = rests ? strain : NAN;
    if (rests)
        return RB_OK;
    if (model->rc->mesh != RB_MESH_UNIFORM || rb_rolling_law_depends_on_state(model->rc))
        return roll_freely_anew(model, creepage, why);
    const rb_status s = model->bodies.F ? roll_freely_dense(model, creepage, why)
                                        : roll_freely_large(model, creepage, why);
    return s == RB_ZONE && model->rc->zone == 0.0 ? roll_freely_anew(model, creepage, why) : s;
}

rb_status rb_rolling_free_creepage_if_any(rb_rolling_model *model, double *creepage,
                                          rb_message *why)
{
    rb_message reason = {.text = ""};
    const rb_status s = rb_rolling_free_creepage(model, creepage, &reason);

    if (s != RB_OK)
        *creepage = NAN;
    return s == RB_ENOMEM ? rb_fail(why, s, "%s", reason.text) : RB_OK;
}
