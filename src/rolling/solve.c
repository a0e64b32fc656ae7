/* From case to solution in one call. */
#include "rolling/internal.h"

#include <string.h>

rb_status rb_rolling_solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                                 rb_rolling_solution *solution, rb_message *why)
{
    memset(model, 0, sizeof *model);
    return rb_rolling_solve_model_again(rc, model, solution, why);
}

rb_status rb_rolling_solve_model_again(const rb_rolling_case *rc, rb_rolling_model *model,
                                       rb_rolling_solution *solution, rb_message *why)
{
    const double start = rb_seconds();
    rb_rolling_history history = {0};
    rb_status s;

    if (rb_rolling_has_steps(rc)) {
        rb_rolling_model_free(model);
        s = rb_rolling_history_run(rc, NULL, NULL, model, &history, why);
    } else {
        s = rb_rolling_end(model, rb_rolling_model_again(rc, model, why), why);
    }
    rb_rolling_history_free(&history);
    memset(solution, 0, sizeof *solution);
    if (s >= 0 && model->state.p) {
        const rb_status t = rb_rolling_model_solution(model, solution, why);
        if (t != RB_OK)
            s = t;
    }
    if (s == RB_OK && rc->formulation == RB_STEADY && rb_rolling_largest_mu(rc) > 0.0)
        s = rb_rolling_free_creepage_if_any(model, &solution->free_creepage, why);
    if (s >= 0)
        solution->status = s;
    solution->seconds_total = rb_seconds() - start;
    return s;
}

rb_status rb_rolling_solve(const rb_rolling_case *rc, rb_rolling_solution *solution,
                           rb_message *why)
{
    rb_rolling_model model;
    const rb_status s = rb_rolling_solve_model(rc, &model, solution, why);

    rb_rolling_model_free(&model);
    return s;
}
