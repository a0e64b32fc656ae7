/* Solutions close to one whose Jacobian is known (theory-solvers.md, D1): Newton's method with
 * zones that may change from step to step. */
#include "analysis/sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>

/* The Jacobian at the present state of v, which need not be a solution. */
static rb_status linearise(const rb_rolling_model *v, const rb_sensitivity *like,
                           rb_sensitivity **made, rb_message *why)
{
    rb_sensitivity *s = calloc(1, sizeof *s);

    rb_sensitivity_free(*made);
    *made = s;
    if (!s)
        return rb_fail(why, RB_ENOMEM, "out of memory for a Jacobian");
    s->model = v;
    s->n = v->problem.n;
    const rb_status status = rb_sensitivity_law(s, why);
    return status == RB_OK ? rb_sensitivity_factor(s, v->state.zone, like, &s->factors) : status;
}

/* Gives every element the zone that its gap, tractions and slip ask for.  Returns how many
 * elements have another zone than before. */
static int change_zones(rb_rolling_model *v, const double *gap, const double *slip)
{
    const rb_contact_problem *p = &v->problem;
    rb_contact_state *x = &v->state;
    const double some = 0.1 * v->rc->contact.tol;
    int changed = 0;

    for (int i = 0; i < x->n; i++) {
        const int before = x->zone[i];
        const double wrong = before == RB_ZONE_SLIP_NEGATIVE ? -slip[i] : slip[i];
        if (before == RB_ZONE_SEPARATED) {
            if (gap[i] < -some * p->gap_length)
                x->zone[i] = slip[i] < 0.0 ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SLIP_NEGATIVE;
        } else if (x->p[i] < -some * p->stress) {
            x->zone[i] = RB_ZONE_SEPARATED;
            x->p[i] = x->q[i] = 0.0;
        } else if (before == RB_ZONE_STICK) {
            if (fabs(x->q[i]) - p->bound[i] * x->p[i] > some * rb_contact_friction_scale(p))
                x->zone[i] = x->q[i] > 0.0 ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SLIP_NEGATIVE;
        } else if (wrong > some * p->slip_length) {
            x->zone[i] = RB_ZONE_STICK;
        }
        changed += x->zone[i] != before;
    }
    return changed;
}

/* The equations of v with the Jacobian `at`, and with own ones where it does not do: like
 * the one of s.  may_change: 1: elements take the zones that they ask for. */
static rb_status iterate_equations(const rb_sensitivity *s, const rb_sensitivity *at,
                                   int may_change, rb_rolling_model *v, rb_sensitivity **own,
                                   rb_message *why)
{
    enum { STEPS = 20, JACOBIANS = 6 };
    /* Steps that shrink less are more of them than a new Jacobian costs. */
    static const double FAST = 0.15;
    const double enough = 0.1 * v->rc->contact.tol;
    rb_contact_state step = {0};
    rb_sensitivity_rate left = {0};
    double change = INFINITY, error = INFINITY;
    int jacobians = 0;
    rb_status status = rb_contact_state_alloc(s->n, &step);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &left);
    if (status == RB_OK)
        status = rb_sensitivity_residual(at->model, v, &left, why);
    for (int k = 0; k < STEPS && error > enough && status == RB_OK; k++) {
        const double before = change;
        for (int i = 0; i < s->n; i++)
            if (v->state.zone[i] > RB_ZONE_STICK && v->state.p[i] > 0.0) {
                left.bound[i] -= fabs(v->state.q[i]) / v->state.p[i];
                left.yield[i] -= fabs(v->state.q[i]);
            }
        status = at->factors ? rb_sensitivity_forward(at, at->factors, &left, &step)
                             : rb_sensitivity_tangent(at, &left, 1, &step, why);
        if (status != RB_OK)
            break;
        change = rb_norm_inf((size_t)s->n, step.q) / rb_contact_friction_scale(&v->problem);
        /* what steps that shrink as the last ones did leave */
        error = isfinite(before) ? change * fmin(1.0, change / before) : change;
        rb_rolling_variant_set(&v->state, &step, 1.0, &v->state);
        status = rb_sensitivity_residual(at->model, v, &left, why);
        const int changed =
            status == RB_OK && may_change ? change_zones(v, left.gap, left.slip) : 0;
        if (status != RB_OK || (!changed && change < FAST * before))
            continue;
        /* the matrix of other zones, or of a state that is closer */
        if (!at->factors || jacobians++ == JACOBIANS)
            break;
        change = error = INFINITY;
        status = rb_rolling_variant_complete(v, NULL, NULL, why);
        if (status == RB_OK)
            status = linearise(v, s, own, why);
        at = *own;
        if (status == RB_OK)
            status = rb_sensitivity_residual(at->model, v, &left, why);
    }
    rb_contact_state_free(&step);
    rb_sensitivity_rate_free(&left);
    return status == RB_OK && !(error <= enough) ? RB_MAXITER : status;
}

rb_status rb_sensitivity_follow(const rb_sensitivity *s, rb_rolling_model *v, rb_message *why)
{
    rb_contact_violation violation = {.scaled = NAN};
    rb_sensitivity *own = NULL;

    rb_rolling_variant_set(&s->model->state, NULL, 0.0, &v->state);
    rb_status status = iterate_equations(s, s, v->bodies.F && !v->problem.yield, v, &own, why);
    if (status == RB_OK || status == RB_MAXITER)
        status = rb_contact_residual(&v->problem, &v->state, &violation);
    v->state.residual = violation.scaled;
    rb_sensitivity_free(own);
    return status == RB_OK && !(violation.scaled <= v->rc->contact.tol) ? RB_MAXITER : status;
}

rb_status rb_sensitivity_extend(const rb_sensitivity *s, int element, int zone, rb_rolling_model *v,
                                rb_sensitivity **extended, rb_message *why)
{
    const rb_rolling_model *model = s->model;
    rb_status status = s->factors ? rb_rolling_variant_create(model, model->rc, 1, 0, NULL, v, why)
                                  : rb_fail(why, RB_EINVAL, "derivatives: no matrices");

    if (status != RB_OK)
        return status;
    v->state.zone[element] = zone;
    status = rb_rolling_variant_complete(v, NULL, NULL, why);
    if (status == RB_OK)
        status = linearise(v, s, extended, why);
    if (status == RB_OK)
        status = iterate_equations(s, *extended, 0, v, extended, why);
    return status == RB_OK ? linearise(v, s, extended, why) : status;
}
