/* Solves a resolved case of any formulation, with error bars or to an accuracy if
 * required. */
#include "rolling/case/case.h"

#include <stdlib.h>
#include <string.h>

/* Steps whose notes are kept on the way to whom they are shown. */
typedef struct {
    const rb_resolved_case *c;
    rb_rolling_step *step; /* NULL: nobody */
    void *context;
    rb_rolling_study_notes *notes;
    rb_status status;
    rb_message why;
} noted_steps;

static int note_step(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                     int steps, void *context)
{
    noted_steps *to = context;

    if (model) /* none: a run for error bars */
        to->status =
            rb_rolling_note_step(to->notes, &to->c->rc, to->c->units, model, step, steps, &to->why);
    return to->status != RB_OK || (to->step && to->step(model, history, step, steps, to->context));
}

rb_status rb_case_solve(const rb_resolved_case *c, rb_rolling_step *step, void *context,
                        rb_case_result *r, rb_message *why)
{
    memset(r, 0, sizeof *r);
    return rb_case_solve_again(c, step, context, r, why);
}

rb_status rb_case_solve_again(const rb_resolved_case *c, rb_rolling_step *step, void *context,
                              rb_case_result *r, rb_message *why)
{
    rb_rolling_model model = r->model;

    memset(&r->model, 0, sizeof r->model);
    rb_case_result_free(r);
    memset(r, 0, sizeof *r);
    if (!rb_case_has_steps(c) && !c->error && !(c->accuracy > 0.0)) {
        r->model = model;
        return rb_rolling_solve_model_reuse(&c->rc, &r->model, &r->solution, why);
    }
    rb_rolling_model_free(&model);
    if (rb_case_has_steps(c)) {
        const double start = rb_seconds();
        const rb_rolling_program *program = c->program.n > 0 ? &c->program : NULL;
        r->of_steps = calloc(1, sizeof *r->of_steps);
        if (!r->of_steps)
            return rb_fail(why, RB_ENOMEM, "out of memory for notes");
        noted_steps notes = {.c = c, .step = step, .context = context, .notes = r->of_steps};
        const rb_rolling_observer observer = {note_step, &notes};
        rb_status s = (c->error ? rb_rolling_history_with_errors : rb_rolling_history_run)(
            &c->rc, program, &observer, &r->model, &r->history, why);
        if (notes.status != RB_OK) {
            *why = notes.why;
            s = notes.status;
        }
        r->has_errors = s == RB_OK && rb_rolling_errors_of_cycle(&r->history, &r->errors);
        return rb_rolling_end_solve(&r->model, s, start, &r->solution, why);
    }
    r->has_errors = 1;
    int elements;
    if (c->accuracy > 0.0)
        return rb_rolling_solve_to_accuracy(&c->rc, c->accuracy, &r->solution, &r->errors,
                                            &elements, why);
    return rb_rolling_solve_with_errors(&c->rc, &r->solution, &r->errors, why);
}

void rb_case_result_convert(rb_case_result *r, rb_units units)
{
    rb_rolling_solution_convert(&r->solution, units);
    rb_rolling_solution_convert(&r->errors.scalar, units);
    rb_rolling_history_convert(&r->history, units);
}

void rb_case_result_free(rb_case_result *r)
{
    free(r->of_steps);
    r->of_steps = NULL;
    rb_rolling_solution_free(&r->solution);
    rb_rolling_history_free(&r->history);
    rb_rolling_model_free(&r->model);
}
