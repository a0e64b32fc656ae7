/* The model of a case as an object: its case, what it owns, and the matrices that it may get later.
 */
#include "rolling/body/far_field.h"
#include "rolling/case/internal.h"
#include "rolling/solve/cycle.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/solve/given_tractions.h"
#include "rolling/solve/temperature.h"

#include <stdlib.h>
#include <string.h>

void rb_rolling_forget_free_rolling(rb_rolling_model *model)
{
    if (model->freely)
        rb_rolling_model_free(model->freely);
    free(model->freely);
    model->freely = NULL;
}

rb_status rb_rolling_model_set_case(rb_rolling_model *model, const rb_rolling_case *rc,
                                    rb_message *why)
{
    rb_rolling_case *copy = malloc(sizeof *copy);

    if (!copy)
        return rb_fail(why, RB_ENOMEM, "out of memory for a case");
    *copy = *rc;
    free((void *)model->rc);
    model->rc = copy;
    rb_rolling_forget_free_rolling(model);
    return RB_OK;
}

rb_status rb_rolling_model_begin(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why)
{
    *model = (rb_rolling_model){.plan = plan ? *plan : rb_rolling_plan_of(rc)};
    return rb_rolling_model_set_case(model, rc, why);
}

void rb_rolling_model_free(rb_rolling_model *model)
{
    free((void *)model->rc);
    rb_contact_state_free(&model->state);
    rb_contact_problem_free(&model->problem);
    rb_rolling_bodies_free(&model->bodies);
    rb_rolling_mesh_free(&model->mesh);
    free(model->carried.temperature);
    free(model->carried.yielded);
    /* What few models have: */
    if (model->conduction)
        rb_rolling_conduction_free(model->conduction);
    if (model->given)
        rb_rolling_given_free(model->given);
    if (model->cycle)
        rb_rolling_cycle_free(model->cycle);
    if (model->far)
        rb_rolling_far_field_free(model->far);
    rb_rolling_forget_free_rolling(model);
    memset(model, 0, sizeof *model);
}

/* All of it, or nothing: the operator of the problem uses what the bodies have. */
rb_status rb_rolling_model_add_matrix(rb_rolling_model *model, rb_message *why)
{
    rb_rolling_bodies stored;

    if (model->bodies.F || model->mesh.n >= RB_ROLLING_LARGE)
        return RB_OK;
    rb_status s =
        rb_rolling_bodies_with_matrix(model->rc, &model->mesh, &model->bodies, &stored, why);
    if (s == RB_OK)
        s = rb_rolling_problem_renew_operator(model->rc, &stored, &model->problem, why);
    rb_bem_flexibility *left = s == RB_OK ? &model->bodies.f : &stored.f;
    rb_bem_flexibility_free(left);
    if (s == RB_OK)
        model->bodies = stored;
    else
        rb_bem_flexibility_free(&stored.transforms);
    return s;
}
