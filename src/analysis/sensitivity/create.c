/* A solved model with the factors of its Jacobian: what it has to be, what it needs besides,
 * which of its elements are at the border of two zones. */
#include "analysis/sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>

/* Both sides of a complementary pair below this part of their scales are 0. */
static const double BORDER = 1e-9;
/* The residual of a state that has derivatives. */
static const double SOLVED = 1e-8;

/* ---- What a model has to be -------------------------------------------------------- */

static rb_status check_model(const rb_rolling_model *model, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const rb_contact_state *state = &model->state;
    const int dense = model->bodies.F != NULL;
    rb_contact_violation violation;

    if (!state->p || state->status != RB_OK)
        return rb_fail(why, RB_INACCURATE, "derivatives: the case was not solved");
    if (!isnan(rc->pressed_by))
        return rb_fail(
            why, RB_EINVAL,
            "derivatives: under --max-pressure only where Hertz's formula says the "
            "load; here it is searched for, and another input would have another load. At a "
            "fixed one: --load %.10g N/mm",
            rc->pressed_by);
    if (rc->period > 0.0)
        return rb_fail(why, RB_EINVAL, "derivatives: with a period not known");
    if (!isnan(rc->tilted_by))
        return rb_fail(why, RB_EINVAL,
                       "derivatives: with --moment not known; give the tilt that it makes, --tilt "
                       "%.10g",
                       rc->tilted_by);
    if (!dense && (rb_rolling_law_depends_on_state(rc) || model->problem.yield))
        return rb_fail(why, RB_EINVAL,
                       "derivatives: friction that depends on the state, or an interface "
                       "that yields, needs matrices: fewer than %d elements",
                       RB_ROLLING_LARGE);
    for (int i = 0; i < state->n && model->problem.hardening == 0.0; i++)
        if (rb_contact_slips_and_yields(&model->problem, state, i))
            return rb_fail(why, RB_EINVAL,
                           "derivatives: at element %d the interface yields without hardening "
                           "while the surfaces slide",
                           i + 1);
    const rb_status s = rb_contact_residual(&model->problem, state, &violation);
    if (s == RB_OK && !(violation.scaled <= fmax(SOLVED, model->problem.rounding)))
        return rb_fail(why, RB_INACCURATE,
                       "derivatives: the residual of the solution is %.2g, expected %g",
                       violation.scaled, SOLVED);
    return s;
}

/* ---- Making one -------------------------------------------------------------------- */

/* make: from the model the copy that takes its place. */
static rb_status take_own(rb_sensitivity *s,
                          rb_status (*make)(const rb_rolling_model *, rb_rolling_model *,
                                            rb_message *),
                          rb_message *why)
{
    const rb_rolling_model *model = s->model;

    s->own = calloc(1, sizeof *s->own);
    if (!s->own)
        return rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    s->model = s->own;
    return make(model, s->own, why);
}

/* A model that was solved without a matrix, with one. */
static rb_status take_matrix(rb_sensitivity *s, rb_message *why)
{
    return s->model->bodies.F || s->n >= RB_ROLLING_LARGE
               ? RB_OK
               : take_own(s, rb_rolling_variant_with_matrix, why);
}

/* closely: a model whose boundaries are compressed is replaced by one of closer ones. */
static rb_status create_sensitivity(const rb_rolling_model *model, const rb_sensitivity *like,
                                    int closely, rb_sensitivity **made, rb_message *why)
{
    rb_sensitivity *s = *made = calloc(1, sizeof *s);
    rb_status status = RB_OK;

    if (!s)
        return rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    s->model = model;
    s->n = model->problem.n;
    if (closely && rb_rolling_is_compressed(model))
        status = take_own(s, rb_rolling_variant_closely, why);
    else if (model->problem.yield || rb_rolling_law_depends_on_state(model->rc))
        status = take_matrix(s, why);
    if (status == RB_OK)
        status = check_model(s->model, why);
    const rb_contact_problem *p = &s->model->problem;
    const rb_contact_state *state = &s->model->state;
    s->border = calloc((size_t)s->n, 1);
    s->slip = rb_alloc((size_t)s->n, 2);
    if (status == RB_OK && !(s->border && s->slip))
        status = RB_ENOMEM;
    if (status == RB_OK)
        rb_contact_kinematics(p, state, s->slip + s->n, s->slip);
    for (int i = 0; i < s->n && status == RB_OK; i++) {
        const double gap = s->slip[s->n + i], slip = fabs(s->slip[i]);
        const double left = p->bound[i] * state->p[i] - fabs(state->q[i]);
        const int zone = state->zone[i];
        if (zone == RB_ZONE_SEPARATED)
            s->border[i] = gap < BORDER * p->gap_length ? BORDER_GAP : 0;
        else if (state->p[i] < BORDER * p->stress)
            s->border[i] = BORDER_GAP;
        else if (p->bound[i] > 0.0 && zone == RB_ZONE_STICK)
            s->border[i] = left < BORDER * rb_contact_friction_scale(p) ? BORDER_SLIP : 0;
        else if (p->bound[i] > 0.0 && zone <= RB_ZONE_SLIP_POSITIVE)
            s->border[i] = slip < BORDER * p->slip_length ? BORDER_SLIP : 0;
        else if (p->bound[i] == 0.0 && zone <= RB_ZONE_SLIP_POSITIVE)
            s->border[i] = slip < BORDER * p->slip_length ? BORDER_REST : 0;
        s->contact += zone != RB_ZONE_SEPARATED;
        s->at_rest += s->border[i] == BORDER_REST;
        s->degenerate += s->border[i] != 0 && s->border[i] != BORDER_REST;
    }
    if (status == RB_OK && (s->degenerate || s->at_rest < s->contact) && s->degenerate + s->at_rest)
        status = take_matrix(s, why);
    if (status == RB_OK && !(s->perturbation = rb_rolling_perturbation_create(s->model)))
        status = RB_ENOMEM;
    if (status == RB_OK)
        status = rb_sensitivity_law(s, why);
    if (status == RB_OK && s->model->bodies.F)
        status = rb_sensitivity_factor(s, s->model->state.zone, like, &s->factors);
    else if (status == RB_OK && s->degenerate)
        status = rb_fail(why, RB_EINVAL,
                         "derivatives: %d elements stand between two zones, which needs "
                         "matrices: fewer than %d elements",
                         s->degenerate, RB_ROLLING_LARGE);
    /* singular only between zones: then the tangent tries the others */
    if (status == RB_SINGULAR && !s->degenerate)
        rb_fail(why, status, "derivatives: the Jacobian is singular here");
    return status == RB_SINGULAR && s->degenerate ? RB_OK : status;
}

/* The creepage of free rolling is a solution of its own, on the same elements where
 * they are equal. */
static rb_status roll_freely(rb_sensitivity *s, rb_message *why)
{
    const rb_rolling_model *model = s->model;
    const rb_rolling_case *rc = model->rc, freely = rb_rolling_without_force(rc);
    rb_rolling_model *v;
    rb_status status;

    if (rc->formulation != RB_STEADY || !(rb_rolling_largest_mu(rc) > 0.0) ||
        !rb_contact_operator_response(model->problem.op).coupled)
        return RB_OK;
    if (model->freely) /* the solve has found it */
        return create_sensitivity(model->freely, NULL, 0, &s->free_rolling, why);
    v = s->freely = calloc(1, sizeof *v);
    if (!v)
        return rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    status = rc->mesh == RB_MESH_UNIFORM ? rb_rolling_variant_solve(model, &freely, v, why)
                                         : rb_rolling_model_create(&freely, v, why);
    return status == RB_OK ? create_sensitivity(v, NULL, 0, &s->free_rolling, why) : status;
}

rb_status rb_sensitivity_create(const rb_rolling_model *model, int results, rb_sensitivity **s,
                                rb_message *why)
{
    rb_message reason = {.text = ""};
    rb_status status;

    *s = NULL;
    if (results && rb_rolling_has_steps(model->rc)) /* what steps carried is gone after the last */
        return rb_fail(why, RB_EINVAL,
                       "derivatives: this case has several steps; ask for those of its "
                       "history, step by step");
    status = create_sensitivity(model, NULL, results, s, why);
    if (status == RB_OK && results)
        status = rb_rolling_model_solution(model, &(*s)->solution, why);
    if (status == RB_OK && results) {
        status = roll_freely(*s, &reason);
        if (status > 0 || status == RB_EINVAL) { /* it has none; the others have */
            rb_sensitivity_free((*s)->free_rolling);
            (*s)->free_rolling = NULL;
            status = RB_OK;
        }
        if (status == RB_OK)
            status = rb_sensitivity_set_motion(*s);
        if (status != RB_OK)
            rb_fail(why, status, "%s", rb_status_reason(status, &reason));
    }
    if (status != RB_OK) {
        rb_sensitivity_free(*s);
        *s = NULL;
    }
    return status;
}

rb_status rb_sensitivity_create_like(const rb_rolling_model *model, const rb_sensitivity *like,
                                     rb_sensitivity **s, rb_message *why)
{
    const rb_status status = create_sensitivity(model, like, 0, s, why);

    if (status != RB_OK) {
        rb_sensitivity_free(*s);
        *s = NULL;
    }
    return status;
}

void rb_sensitivity_free(rb_sensitivity *s)
{
    if (!s)
        return;
    rb_sensitivity_free(s->free_rolling);
    if (s->freely)
        rb_rolling_variant_free(s->model, s->freely);
    free(s->freely);
    rb_rolling_solution_free(&s->solution);
    rb_sensitivity_derivative_free(&s->motion[0]);
    rb_sensitivity_derivative_free(&s->motion[1]);
    free(s->border);
    free(s->slip);
    free(s->law_slip);
    free(s->law_force);
    free(s->law_xi);
    rb_sensitivity_factors_free(s->factors);
    rb_rolling_perturbation_free(s->perturbation);
    if (s->own)
        rb_rolling_model_free(s->own);
    free(s->own);
    free(s);
}

int rb_sensitivity_degenerate(const rb_sensitivity *s)
{
    return s->degenerate;
}

rb_sensitivity_elements rb_sensitivity_motion(const rb_sensitivity *s)
{
    return (rb_sensitivity_elements)s->moves;
}
