/* Derivatives and tolerances of a solution, and of each row of curves, histories and sweeps. */
#include "program/api/internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_api_forget_slopes(rb_api *a, api_slopes of)
{
    char beginning[40];

    snprintf(beginning, sizeof beginning, "%s.derivative.", rb_api_slopes_of[of]);
    rb_api_forget_arrays(a, beginning);
    rb_case_slopes_free(&a->slopes[of]);
}

const char *rb_api_derivative(const rb_api *a, const char *of, int k, const char *field, char *text,
                              int size)
{
    char name[100];
    int j = 0;

    while (j < API_SLOPES_N && strcmp(of, rb_api_slopes_of[j]) != 0)
        j++;
    if (j == API_SLOPES_N || k < 0 || k >= a->slopes[j].n || size < 1)
        return NULL;
    const rb_case_slope *slope = &a->slopes[j].of[k];
    const api_field texts[] = {{"name", rb_api_slope_name(slope, name)},
                               {"result", slope->result->name},
                               {"input", slope->input},
                               {"unit", slope->unit}};
    return rb_api_field_of(4, texts, field, text, size);
}

static rb_status of_one_step(rb_api *a)
{
    return a->result.solution.n > 0 && a->result.model.state.p
               ? RB_OK
               : rb_fail(&a->why, RB_EINVAL,
                         "derivatives: of a solved case of one step, without error bars");
}

static rb_status differentiate_case(rb_api *a, int smooth)
{
    rb_api_forget_arrays(a, "derivative.");
    rb_case_derivatives_free(&a->derivatives);
    rb_api_call_begins(a);
    rb_status s = of_one_step(a);
    if (s == RB_OK)
        s = (smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(
            a->words, &a->result.model, 0, NULL, &a->derivatives, &a->why);
    s = rb_api_call_ends(a, s);
    if (s != RB_OK)
        rb_case_derivatives_free(&a->derivatives);
    return s;
}

int rb_api_derivatives(rb_api *a)
{
    rb_api_forget_call(a);
    return rb_api_ended(a, differentiate_case(a, 0));
}

int rb_api_smooth_derivatives(rb_api *a)
{
    rb_api_forget_call(a);
    return rb_api_ended(a, differentiate_case(a, 1));
}

/* What the derivatives of steps are computed from. */
static rb_status states_of_steps(rb_api *a)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_rolling_history *h = &a->result.history;

    a->states.program = c->program.n > 0 ? &c->program : NULL;
    a->states.half_width = h->half_width;
    return h->n == 0 ? rb_fail(&a->why, RB_EINVAL,
                               "derivatives of steps need a case with steps that has been solved")
           : c->error
               ? rb_fail(&a->why, RB_EINVAL, "derivatives of steps: not together with error bars")
           : a->states.steps != h->n
               ? rb_fail(&a->why, RB_EINVAL, "derivatives of steps: not all steps were solved")
               : RB_OK;
}

int rb_api_step_derivatives(rb_api *a, const char *derivatives, const char *tolerance)
{
    rb_case_slopes *s = derivatives ? &a->slopes[API_SLOPES_HISTORY] : NULL;
    rb_rolling_history *h = &a->result.history;
    rb_case_tolerances t;

    rb_api_forget_call(a);
    if (derivatives) {
        rb_api_forget_notes(a);
        rb_api_forget_slopes(a, API_SLOPES_HISTORY);
    }
    if (tolerance) {
        rb_api_forget_arrays(a, "history.tolerance.");
        if (h->deviations)
            rb_rolling_history_free(h->deviations);
        free(h->deviations);
        h->deviations = NULL;
    }
    rb_status status = states_of_steps(a);
    rb_api_call_begins(a);
    if (status == RB_OK && derivatives)
        status = rb_case_slopes_choose(a->words, &rb_rolling_history_columns, derivatives,
                                       RB_CASE_SLOPES_MAX, s, &a->why);
    if (status == RB_OK && tolerance)
        status = rb_case_read_tolerances(a->words, tolerance, &t, &a->why);
    if (status == RB_OK)
        status =
            rb_case_slopes_of_steps(a->words, &a->states, s, tolerance ? &t : NULL, h, &a->why);
    status = rb_api_call_ends(a, status);
    if (derivatives)
        rb_case_slopes_note(s, &a->note);
    if (status != RB_OK && derivatives)
        rb_api_forget_slopes(a, API_SLOPES_HISTORY);
    return rb_api_ended(a, status);
}

int rb_api_check_derivatives(rb_api *a, const char *derivatives, const char *tolerance)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    rb_case_slopes slopes = {0};
    rb_case_tolerances t;

    if (rb_api_resolve(a) < 0)
        return a->status;
    rb_status s = c->error ? rb_fail(&a->why, RB_EINVAL, "%s: not together with error bars",
                                     derivatives ? "derivatives" : "tolerances")
                           : RB_OK;
    if (s == RB_OK && derivatives)
        s = rb_case_slopes_choose(a->words, &rb_rolling_history_columns, derivatives,
                                  RB_CASE_SLOPES_MAX, &slopes, &a->why);
    if (s == RB_OK && tolerance)
        s = rb_case_read_tolerances(a->words, tolerance, &t, &a->why);
    if (s == RB_OK && (derivatives || (tolerance && rb_case_has_steps(c))))
        s = rb_case_slopes_check_steps(a->words, &a->why);
    rb_case_slopes_free(&slopes);
    return rb_api_ended(a, s);
}

int rb_api_tolerances(rb_api *a, const char *inputs)
{
    rb_case_tolerances t;

    if (a->result.history.n > 0)
        return rb_api_step_derivatives(a, NULL, inputs);
    rb_api_forget_arrays(a, "tolerance.");
    a->has_deviation = 0;
    rb_api_forget_call(a);
    rb_status s = of_one_step(a);
    if (s == RB_OK)
        s = rb_case_read_tolerances(a->words, inputs, &t, &a->why);
    if (s == RB_OK) {
        rb_api_call_begins(a);
        s = rb_api_call_ends(
            a, rb_case_deviations(a->words, &a->result.model, &t, &a->deviation, &a->why));
    }
    a->has_deviation = s == RB_OK;
    return rb_api_ended(a, s);
}

const char *rb_api_input(const rb_api *a, int k, const char *field, char *text, int size)
{
    const rb_case_derivatives *all = &a->derivatives;
    if (k < 0 || k >= all->n || size < 1)
        return NULL;
    const rb_case_derivative *of = &all->of[k];
    const api_field texts[] = {{"name", of->name},
                               {"unit", of->unit},
                               {"refusal", of->status == RB_OK ? NULL : of->why.text}};
    return rb_api_field_of(3, texts, field, text, size);
}
