/* The handle of a case: its options, its solution, what the last call left, and stopping one. */
#include "analysis/crack/crack_case.h"
#include "program/api/internal.h"

#include "lcp/friction/friction.h"

#include <gsl/gsl_errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* All results; the model stays aside where its bodies remain those of the case. */
static void forget_solution(rb_api *a, int same_bodies)
{
    if (!same_bodies || a->result.model.mesh.ends) {
        rb_rolling_model_free(&a->kept);
        a->kept = a->result.model;
        memset(&a->result.model, 0, sizeof a->result.model);
    }
    if (!same_bodies)
        rb_rolling_model_free(&a->kept);
    rb_api_forget_arrays(a, "");
    for (int k = 0; k < API_SAID_N; k++) {
        free(a->said[k]);
        a->said[k] = NULL;
    }
    rb_rolling_curve_free(&a->curve);
    rb_rolling_curve_free(&a->curve_errors);
    rb_contact_lcp_free(&a->lcp);
    rb_case_derivatives_free(&a->derivatives);
    for (int of = 0; of < API_SLOPES_N; of++)
        rb_case_slopes_free(&a->slopes[of]);
    rb_rolling_states_free(&a->states);
    a->has_deviation = 0;
    rb_rolling_wear_history_free(&a->wear);
    rb_case_result_free(&a->result);
    memset(&a->lcp, 0, sizeof a->lcp);
    memset(&a->result, 0, sizeof a->result);
    rb_api_forget_call(a);
}

rb_api *rb_api_create_for(const char *purpose)
{
    static const struct {
        const char *name;
        rb_case_purpose purpose;
    } known[] = {{"solve", RB_CASE_SINGLE}, {"curve", RB_CASE_CURVE}, {"stress", RB_CASE_STRESS},
                 {"crack", RB_CASE_CRACK},  {"wear", RB_CASE_WEAR},   {"sweep", RB_CASE_STUDY}};
    rb_api *a = calloc(1, sizeof *a);

    gsl_set_error_handler_off(); /* GSL's own one ends the program */
    for (size_t k = 0; a && k < sizeof known / sizeof *known; k++)
        if (strcmp(known[k].name, purpose) == 0)
            a->words = rb_case_create(known[k].purpose);
    if (a && !a->words) {
        free(a);
        a = NULL;
    }
    if (!a)
        return NULL;
    a->is_curve = strcmp(purpose, "curve") == 0;
    rb_case_use_cone_solvers(a->words, rb_friction_cone_solver);
    return a;
}

rb_api *rb_api_create(void)
{
    return rb_api_create_for("solve");
}

void rb_api_free(rb_api *a)
{
    if (!a)
        return;
    forget_solution(a, 0);
    rb_case_free(a->words);
    free(a);
}

/* Who does not look at the status of rb_api_set must not get the solution of another
 * case: what was refused last stands in the way until the same name is accepted. */
static int note_refusal(rb_api *a, const char *name, rb_status s)
{
    int k = 0;
    while (k < a->refusals && strncmp(a->refused[k].name, name, sizeof a->refused[k].name - 1) != 0)
        k++;
    if (k < a->refusals && s == RB_OK)
        a->refused[k] = a->refused[--a->refusals];
    rb_api_ended(a, s);
    if (s != RB_OK) {
        a->refusals += k == a->refusals && k < API_REFUSALS;
        api_refusal *here = &a->refused[k < API_REFUSALS ? k : API_REFUSALS - 1];
        snprintf(here->name, sizeof here->name, "%s", name);
        here->why = a->why;
    }
    return s;
}

int rb_api_set(rb_api *a, const char *name, const char *text)
{
    /* Options that change neither bodies nor mesh: the flexibility may serve again. */
    static const char *const driving[] = {"mu",    "load",        "approach", "half-width", "shift",
                                          "creep", "creep-ratio", "force",    "force-ratio"};
    int drives = 0;
    for (size_t k = 0; k < sizeof driving / sizeof *driving; k++)
        drives |= strcmp(name, driving[k]) == 0;
    forget_solution(a, drives);
    return note_refusal(a, name, rb_case_set(a->words, name, text, RB_GIVEN_ARGUMENT, &a->why));
}

int rb_api_read(rb_api *a, const char *path)
{
    forget_solution(a, 0);
    return note_refusal(a, path, rb_case_read(a->words, path, &a->why));
}

rb_status rb_api_check_refusals(const rb_api *a, rb_message *why)
{
    return a->refusals > 0 ? rb_fail(why, RB_EINVAL, "%s", a->refused[0].why.text) : RB_OK;
}

int rb_api_resolve(rb_api *a)
{
    forget_solution(a, 1);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK)
        s = rb_case_resolve(a->words, &a->why);
    return rb_api_ended(a, s);
}

static int keep_step(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                     int steps, void *context)
{
    rb_api *a = context;
    a->total = steps;
    a->done = step + 1;
    if (a->stopped || !model) /* no model: a run for error bars */
        return a->stopped;
    if (step == 0) { /* a run may start again on a wider zone */
        rb_api_forget_arrays(a, "step.");
        api_array *x = rb_api_make_array(a, "step.x", model->mesh.n, 1);
        for (int i = 0; x && i < x->rows; i++)
            x->at[i] = 0.5 * (model->mesh.ends[i] + model->mesh.ends[i + 1]);
        a->status = x ? RB_OK : RB_ENOMEM;
    }
    if (a->status == RB_OK)
        a->status = rb_rolling_states_keep(model, history, step, steps, &a->states);
    if (a->status == RB_OK)
        a->status = rb_api_add_state(a, "step", &model->state);
    return a->status != RB_OK;
}

void rb_api_forget_notes(rb_api *a)
{
    a->note.text[0] = '\0';
    memset(&a->rows, 0, sizeof a->rows);
}

int rb_api_solve(rb_api *a)
{
    rb_api_forget_notes(a);
    a->done = a->total = 0;
    if (rb_api_resolve(a) < 0)
        return a->status;
    a->result.model = a->kept;
    memset(&a->kept, 0, sizeof a->kept);
    rb_api_call_begins(a);
    rb_status s =
        rb_case_solve_again(rb_case_resolved(a->words), keep_step, a, &a->result, &a->why);
    s = rb_api_call_ends(a, s);
    if (s == RB_INTERRUPTED && a->status == RB_ENOMEM) /* a step could not be kept */
        s = rb_fail(&a->why, RB_ENOMEM, "out of memory");
    return rb_api_ended(a, s != RB_OK ? rb_case_locate(a->words, s, &a->why) : s);
}
