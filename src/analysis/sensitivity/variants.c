/* Variants of a solved model, at the values of an input nearby, and what they tell of the
 * equations (theory-solvers.md, D2, D4): built anew on the same elements, or on elements that are
 * moved. */
#include "analysis/sensitivity/internal.h"

#include <string.h>

/* Flexibilities of wheels have a longer step where steps even longer lead to no end of the
 * input's range. */
static const double NEAR = 40.0;

/* ---- Variants ---------------------------------------------------------------------- */

int rb_sensitivity_has_wheels(const rb_rolling_model *model)
{
    return model->bodies.system_a || model->bodies.system_b;
}

/* Step and stencil: both ways where the range allows it. */
rb_status rb_sensitivity_choose_places(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                       rb_sensitivity_variants *v, rb_message *why)
{
    const double longest = RB_SENSITIVITY_STEP_OF_BODIES * input->scale, x = input->value;
    const int falls = x + longest > input->to;
    rb_rolling_case rc;
    const rb_status status =
        input->vary ? input->vary(input->context, x + (falls ? -longest : longest), &rc, why)
                    : RB_OK;

    if (status != RB_OK)
        return status;
    v->bodies = !input->vary || !rb_rolling_same_bodies(&rc, s->model->rc);
    v->own = input->vary && rb_rolling_is_compressed(s->model) &&
             rb_rolling_variant_builds(s->model, &rc, v->results);
    v->step = (v->bodies ? RB_SENSITIVITY_STEP_OF_BODIES : RB_SENSITIVITY_STEP) * input->scale;
    v->scale = input->scale;
    if (v->results && v->bodies && rb_sensitivity_has_wheels(s->model) &&
        rb_sensitivity_stencil_of(input, NEAR * v->step) == &rb_sensitivity_middle) {
        v->step *= RB_STEP_OF_WHEELS;
        v->is_long = 1;
    }
    const rb_sensitivity_stencil *at = rb_sensitivity_stencil_of(input, v->step);
    /* where slip or heat brings mu to 0, a smaller mu is no case */
    if (at == &rb_sensitivity_middle && rb_rolling_law_depends_on_state(s->model->rc) &&
        input->vary && input->vary(input->context, x - 2.0 * v->step, &rc, why) == RB_EINVAL)
        at = &rb_sensitivity_ahead;
    if (!at)
        return rb_fail(why, RB_EINVAL, "derivatives: the input cannot vary within its range");
    v->at = *at;
    return RB_OK;
}

static rb_rolling_case on_the_same_elements(const rb_rolling_case *rc, const rb_rolling_case *of,
                                            int n)
{
    rb_rolling_case varied = *rc;

    varied.mesh = of->mesh;
    varied.slip_operator = of->slip_operator;
    varied.outer_refinement = of->outer_refinement;
    varied.outer_elements = of->outer_elements;
    varied.contact_elements = of->mesh == RB_MESH_UNIFORM ? n : of->contact_elements;
    return varied;
}

void rb_sensitivity_variants_free(rb_sensitivity_variants *v)
{
    for (int k = 0; k < v->at.n; k++)
        if (v->of[k])
            rb_rolling_variant_free(v->of[k], &v->model[k]);
}

static rb_status variants_at_places(const rb_rolling_model *base, const rb_sensitivity_input *input,
                                    const rb_sensitivity_variants *others, int freely,
                                    rb_sensitivity_variants *v, rb_message *why)
{
    rb_status s = RB_OK;

    for (int k = 0; k < v->at.n && s == RB_OK; k++) {
        const double by = v->at.place[k] * v->step;
        /* Another model's variant has the flexibility too, if it was computed for it on the same
         * elements; by formula it has that of its own tractions alone. */
        const rb_rolling_model *other = others ? &others->model[k] : NULL;
        const int lends = other && others->step == v->step && other->bodies.f.data &&
                          other->bodies.f.data != others->base->bodies.f.data &&
                          other->mesh.n == base->mesh.n &&
                          memcmp(others->base->mesh.ends, base->mesh.ends,
                                 (size_t)base->mesh.n * sizeof *base->mesh.ends) == 0;
        const rb_rolling_model *of = v->of[k] = lends ? other : base;
        rb_rolling_case rc;
        if (!input->vary) {
            const rb_sensitivity_move *m = input->context;
            s = m->kind == SHIFT
                    ? rb_rolling_variant_move(base, v->perturbation, by, 1.0, &v->model[k], why)
                    : rb_rolling_variant_move(base, v->perturbation, -by * m->centre / m->half,
                                              1.0 + by / m->half, &v->model[k], why);
        } else {
            s = input->vary(input->context, input->value + by, &rc, why);
            if (s != RB_OK)
                return s;
            rc = on_the_same_elements(&rc, base->rc, base->mesh.n);
            if (freely)
                rc = rb_rolling_without_force(&rc);
            s = rb_rolling_variant_create(of, &rc, v->results, of == base && v->own,
                                          of == base ? v->perturbation : NULL, &v->model[k], why);
            if (s == RB_OK && of != base)
                rb_rolling_variant_set(&base->state, NULL, 0.0, &v->model[k].state);
        }
        if (s == RB_OK && !rb_rolling_same_sides(base, &v->model[k]))
            s = rb_fail(why, RB_INACCURATE,
                        "the elements outside the contact change with the input");
    }
    return s;
}

/* others: for the same values of the input, of the model in free rolling its model; or NULL.
 * The step is made smaller where the elements outside the contact change within it. */
rb_status rb_sensitivity_variants_create(const rb_rolling_model *base,
                                         const rb_sensitivity_input *input,
                                         const rb_sensitivity_variants *others, int freely,
                                         rb_sensitivity_variants *v, rb_message *why)
{
    enum { TRIALS = 3 };
    const int trials = TRIALS + v->is_long;
    rb_status s = RB_INACCURATE;

    for (int k = 0; k < trials && s == RB_INACCURATE; k++) {
        if (k > 0) {
            rb_sensitivity_variants_free(v);
            memset(v->model, 0, sizeof v->model);
            v->step *= v->is_long ? 1.0 / RB_STEP_OF_WHEELS : 0.1;
            v->is_long = 0;
        }
        s = variants_at_places(base, input, others, freely, v, why);
    }
    return s;
}

/* D2: how the equations change while the unknowns stay. */
rb_status rb_sensitivity_rates_at(const rb_sensitivity *s, rb_sensitivity_variants *v,
                                  rb_sensitivity_rate *rate, rb_message *why)
{
    rb_sensitivity_rate left;
    rb_status status = rb_sensitivity_rate_alloc(s->n, &left);

    for (int k = 0; k < v->at.n && status == RB_OK; k++)
        status = rb_sensitivity_add_variant(s, &v->model[k], v->at.weight[k] / v->step, &left, rate,
                                            why);
    rb_sensitivity_rate_free(&left);
    return status;
}

/* By what the varied case gives, where it differs in nothing else.  0: it does. */
static int rates_of_given(const rb_sensitivity *s, const rb_sensitivity_input *input,
                          const rb_sensitivity_variants *v, rb_sensitivity_rate *rate, double *mu,
                          rb_status *status, rb_message *why)
{
    rb_sensitivity_rate left = {0};
    int is_given = 1;

    *status = rb_sensitivity_rate_alloc(s->n, &left);
    /* the last place tells: the first one may be the value itself, where nothing differs */
    for (int k = v->at.n - 1; k >= 0 && is_given && *status == RB_OK; k--) {
        const double weight = v->at.weight[k] / v->step;
        rb_rolling_case rc;
        rb_contact_problem given;
        *status = input->vary(input->context, input->value + v->at.place[k] * v->step, &rc, why);
        if (*status != RB_OK)
            break;
        rc = on_the_same_elements(&rc, s->model->rc, s->n);
        is_given = rb_rolling_variant_given(s->model, &rc, left.bound, &given, status, why);
        if (!is_given)
            break;
        rb_sensitivity_given(s->model, &given, &s->model->state, &left);
        rb_sensitivity_rate_add(&left, weight, rate);
        *mu += weight * given.mu;
    }
    rb_sensitivity_rate_free(&left);
    return is_given;
}

rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why)
{
    rb_sensitivity_variants v = {.base = s->model, .perturbation = s->perturbation};
    rb_status status = rb_sensitivity_choose_places(s, input, &v, why);

    memset(rate, 0, sizeof *rate);
    *mu = 0.0;
    if (v.at.n == rb_sensitivity_middle.n)
        v.at = rb_sensitivity_nearest;
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, rate);
    if (status != RB_OK || rates_of_given(s, input, &v, rate, mu, &status, why))
        return status;
    if (status == RB_OK)
        status = rb_sensitivity_variants_create(s->model, input, NULL, 0, &v, why);
    if (status == RB_OK)
        status = rb_sensitivity_rates_at(s, &v, rate, why);
    for (int k = 0; k < v.at.n && status == RB_OK; k++)
        *mu += v.at.weight[k] / v.step * v.model[k].problem.mu;
    rb_sensitivity_variants_free(&v);
    return status;
}
