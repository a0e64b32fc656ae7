/* Derivatives of the results of a case with respect to one of its numbers (theory.md,
 * D4). At four (five at the end of a range) values of the number nearby the problem is
 * built anew on the same elements: its equations at the unknowns that are there give the
 * rates, and the results of the unknowns moved along the tangent their derivatives. */
#include "sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the input's scale: where flexibilities change, which are known to fewer
 * digits, and where they do not. */
static const double STEP_OF_BODIES = 5e-4, STEP = 2e-5;

/* A change of a result over the input's scale that is none, as a part of the result. */
static const double ROUNDING = 1e-12;

enum { PLACES = 5 };

/* A first derivative from values at so many places, of fourth order. */
typedef struct {
    int n;
    double place[PLACES], weight[PLACES];
} stencil;

static const stencil middle = {4, {-2, -1, 1, 2}, {1 / 12., -8 / 12., 8 / 12., -1 / 12.}};
static const stencil ahead = {
    5, {0, 1, 2, 3, 4}, {-25 / 12., 48 / 12., -36 / 12., 16 / 12., -3 / 12.}};
static const stencil behind = {
    5, {0, -1, -2, -3, -4}, {25 / 12., -48 / 12., 36 / 12., -16 / 12., 3 / 12.}};

int rb_sensitivity_has(const rb_rolling_result *r)
{
    return r->kind == RB_RESULT_NUMBER && !r->no_derivative;
}

void rb_sensitivity_derivative_free(rb_sensitivity_derivative *d)
{
    for (int k = 0; k < 2; k++)
        rb_rolling_solution_free(&d->value[k]);
    rb_sensitivity_rate_free(&d->rate);
    memset(d, 0, sizeof *d);
}

/* ---- Variants ---------------------------------------------------------------------- */

typedef struct {
    const rb_rolling_model *base;
    stencil at;
    double step;
    rb_rolling_model model[PLACES];
} variants;

/* Step and stencil: both ways where the range allows it. */
static rb_status choose_places(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               variants *v, rb_message *why)
{
    const double longest = STEP_OF_BODIES * input->scale, x = input->value;
    const int falls = x + longest > input->to;
    rb_rolling_case rc;
    const rb_status status =
        input->vary(input->context, x + (falls ? -longest : longest), &rc, why);

    if (status != RB_OK)
        return status;
    v->step = (rb_rolling_same_bodies(&rc, &s->model->rc) ? STEP : STEP_OF_BODIES) *
              input->scale;
    const int can_fall = x - 2.0 * v->step > input->from,
              can_grow = x + 2.0 * v->step < input->to;
    v->at = can_fall && can_grow ? middle : can_grow ? ahead : behind;
    return can_fall || can_grow
               ? RB_OK
               : rb_fail(why, RB_EINVAL, "derivatives: the input has no room to vary");
}

static rb_rolling_case on_the_same_elements(const rb_rolling_case *rc,
                                            const rb_rolling_case *of, int n)
{
    rb_rolling_case varied = *rc;

    varied.mesh = of->mesh;
    varied.slip_operator = of->slip_operator;
    varied.outer_refinement = of->outer_refinement;
    varied.outer_elements = of->outer_elements;
    varied.contact_elements = of->mesh == RB_MESH_UNIFORM ? n : of->contact_elements;
    return varied;
}

static void variants_free(variants *v)
{
    for (int k = 0; k < v->at.n; k++)
        rb_rolling_variant_free(v->base, &v->model[k]);
}

static rb_status variants_create(const rb_rolling_model *base,
                                 const rb_sensitivity_input *input, int freely,
                                 variants *v, rb_message *why)
{
    rb_status s = RB_OK;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        rb_rolling_case rc;
        s = input->vary(input->context, input->value + v->at.place[k] * v->step, &rc,
                        why);
        if (s != RB_OK)
            return s;
        rc = on_the_same_elements(&rc, &base->rc, base->mesh.n);
        if (freely) {
            rc.creep = rc.creep_ratio = rc.force = NAN;
            rc.free_axle = 0;
            rc.force_ratio = 0.0;
        }
        s = rb_rolling_variant_create(base, &rc, &v->model[k], why);
    }
    return s;
}

/* D2: how the equations change while the unknowns stay. */
static rb_status rates(const variants *v, rb_sensitivity_rate *rate)
{
    rb_sensitivity_rate left;
    const int n = v->base->mesh.n;
    rb_status s = rb_sensitivity_rate_alloc(n, &left);

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        const double weight = v->at.weight[k] / v->step;
        rb_sensitivity_residual(v->base, &v->model[k], &left);
        for (int i = 0; i < 4 * n; i++)
            rate->gap[i] += weight * left.gap[i];
        rate->normal += weight * left.normal;
        rate->tangential += weight * left.tangential;
    }
    rb_sensitivity_rate_free(&left);
    return s;
}

rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why)
{
    variants v = {.base = s->model};
    rb_status status = choose_places(s, input, &v, why);

    memset(rate, 0, sizeof *rate);
    if (status == RB_OK)
        status = variants_create(s->model, input, 0, &v, why);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, rate);
    if (status == RB_OK)
        status = rates(&v, rate);
    *mu = 0.0;
    for (int k = 0; k < v.at.n && status == RB_OK; k++)
        *mu += v.at.weight[k] / v.step * v.model[k].problem.mu;
    variants_free(&v);
    return status;
}

/* ---- Results ----------------------------------------------------------------------- */

static double *number_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return (double *)(void *)((char *)s + r->offset);
}

/* NULL: s has no such column, or it has no derivative. */
static double *column_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return rb_sensitivity_has(r) && rb_rolling_has_column(r, s)
               ? *(double **)(void *)((char *)s + r->offset)
               : NULL;
}

void rb_sensitivity_scale(rb_rolling_solution *s, double factor)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++)
        if (rb_sensitivity_has(&rb_rolling_solution_scalars.row[k]))
            *number_of(&rb_rolling_solution_scalars.row[k], s) *= factor;
    for (int k = 0; k < rb_rolling_solution_columns.n; k++) {
        double *x = column_of(&rb_rolling_solution_columns.row[k], s);
        for (int i = 0; i < s->n && x; i++)
            x[i] *= factor;
    }
}

/* In the place of the first one the derivative: weights times what the others have more
 * than it, so that what does not change has a derivative of exactly 0. */
static void combine(const stencil *at, double step, rb_rolling_solution *moved)
{
    rb_rolling_solution *d = &moved[0];

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const int has = rb_sensitivity_has(r);
        double sum = 0.0;
        for (int j = 1; j < at->n && has; j++)
            sum += at->weight[j] / step *
                   (rb_rolling_number(r, &moved[j]) - rb_rolling_number(r, d));
        if (r->kind != RB_RESULT_WHOLE)
            *number_of(r, d) = has ? sum : NAN;
    }
    for (int k = 0; k < rb_rolling_solution_columns.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_columns.row[k];
        double *x = column_of(r, d);
        for (int i = 0; i < d->n && x; i++) {
            double sum = 0.0;
            for (int j = 1; j < at->n; j++)
                sum += at->weight[j] / step * (column_of(r, &moved[j])[i] - x[i]);
            x[i] = sum;
        }
    }
}

/* (D4) the results at the places of the stencil, moved along the tangent. */
static rb_status differentiate_results(variants *v, const rb_contact_state *tangent,
                                       rb_rolling_solution *d, rb_message *why)
{
    rb_rolling_solution moved[PLACES] = {{0}};
    rb_status s = RB_OK;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        rb_rolling_variant_set(v->base, tangent, v->at.place[k] * v->step, &v->model[k]);
        s = rb_rolling_variant_complete(&v->model[k], why);
        if (s == RB_OK)
            s = rb_rolling_model_solution(&v->model[k], &moved[k], why);
    }
    if (s == RB_OK)
        combine(&v->at, v->step, moved);
    *d = moved[0];
    for (int k = 1; k < v->at.n; k++)
        rb_rolling_solution_free(&moved[k]);
    return s;
}

/* What follows from the rates on one side. */
static rb_status differentiate_side(const rb_sensitivity *s, variants *v, int side,
                                    const rb_sensitivity_rate *rate,
                                    rb_rolling_solution *d, rb_message *why)
{
    rb_contact_state tangent;
    rb_status status = rb_contact_state_alloc(s->n, &tangent);

    if (status == RB_OK)
        status = rb_sensitivity_tangent(s, rate, side, &tangent, why);
    if (status == RB_OK)
        status = differentiate_results(v, &tangent, d, why);
    rb_contact_state_free(&tangent);
    return status;
}

/* The creepage of free rolling has its own equations. */
static rb_status differentiate_free(const rb_sensitivity *s,
                                    const rb_sensitivity_input *input, const variants *of,
                                    int side, double *creepage, rb_message *why)
{
    const rb_sensitivity *freely = s->free_rolling;
    variants v = {.base = freely->model, .at = of->at, .step = of->step};
    rb_sensitivity_rate rate = {0};
    rb_contact_state tangent = {0};
    rb_status status = variants_create(freely->model, input, 1, &v, why);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(freely->n, &rate);
    if (status == RB_OK)
        status = rates(&v, &rate);
    if (status == RB_OK)
        status = rb_contact_state_alloc(freely->n, &tangent);
    if (status == RB_OK)
        status = rb_sensitivity_tangent(freely, &rate, side, &tangent, why);
    if (status == RB_OK)
        *creepage = tangent.xi;
    rb_contact_state_free(&tangent);
    rb_sensitivity_rate_free(&rate);
    variants_free(&v);
    return status;
}

static int rolls_freely_at_rest(const rb_sensitivity *s)
{
    const rb_rolling_model *model = s->model;

    return model->rc.formulation == RB_STEADY &&
           !rb_contact_operator_response(model->problem.op).coupled;
}

/* 1: both sides have the same derivatives, but for rounding. */
static int sides_agree(const rb_sensitivity_derivative *d)
{
    double worst = 0.0;

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &d->value[0]),
                     y = rb_rolling_number(r, &d->value[1]);
        if (rb_sensitivity_has(r) && !(isnan(x) && isnan(y)) && x != y)
            worst = fmax(worst, fabs(x - y) / fmax(fabs(x), fabs(y)));
    }
    return worst < 1e-8;
}

/* What is less than rounding of the result is no change. */
static void clean(const rb_rolling_solution *at, double scale, rb_rolling_solution *d)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r) &&
            fabs(*number_of(r, d)) * scale < ROUNDING * fabs(rb_rolling_number(r, at)))
            *number_of(r, d) = 0.0;
    }
}

rb_status rb_sensitivity_differentiate(const rb_sensitivity *s,
                                       const rb_sensitivity_input *input,
                                       rb_sensitivity_derivative *d, rb_message *why)
{
    variants v = {.base = s->model};
    const int two = s->degenerate > 0 || (s->free_rolling && s->free_rolling->degenerate);

    memset(d, 0, sizeof *d);
    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "derivatives: made without results");
    rb_status status = choose_places(s, input, &v, why);
    const int both = v.at.n == middle.n;
    const int from = both ? 0 : v.at.place[1] > 0.0, to = both ? two : from;
    d->sides = two || !both ? 2 : 1;
    if (status == RB_OK)
        status = variants_create(s->model, input, 0, &v, why);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &d->rate);
    if (status == RB_OK)
        status = rates(&v, &d->rate);
    for (int k = from; k <= to && status == RB_OK; k++) {
        const int side = k ? 1 : -1;
        d->has[k] = 1;
        status = differentiate_side(s, &v, side, &d->rate, &d->value[k], why);
        d->value[k].free_creepage = rolls_freely_at_rest(s) ? 0.0 : NAN;
        if (status == RB_OK && s->free_rolling)
            status =
                differentiate_free(s, input, &v, side, &d->value[k].free_creepage, why);
        if (status == RB_OK)
            clean(&s->solution, input->scale, &d->value[k]);
    }
    if (status == RB_OK && both && d->sides == 2 && sides_agree(d)) {
        rb_rolling_solution_free(&d->value[1]);
        d->has[1] = 0;
        d->sides = 1;
    }
    variants_free(&v);
    return status;
}
