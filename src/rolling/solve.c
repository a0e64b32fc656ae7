/* From case to solution in one call, whatever the case is: at rest, steady, or step by step. */
#include "rolling/history/history.h"
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <string.h>

/* 1: it has all its parts, of one mesh; 0: it was interrupted while it was built. */
static int is_whole(const rb_rolling_model *model)
{
    const int n = model->mesh.n;
    return model->state.p && model->problem.op && model->state.n == n && model->problem.n == n &&
           model->bodies.f.n == n;
}

rb_status rb_rolling_end_solve(const rb_rolling_model *model, rb_status s, double begun,
                               rb_rolling_solution *solution, rb_message *why)
{
    memset(solution, 0, sizeof *solution);
    if (s >= 0 && is_whole(model)) {
        const rb_status t = rb_rolling_model_solution(model, solution, why);
        s = t == RB_OK ? s : t;
    }
    if (s >= 0)
        solution->status = s;
    solution->seconds_total = rb_seconds() - begun;
    return s;
}

rb_status rb_rolling_solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                                 rb_rolling_solution *solution, rb_message *why)
{
    memset(model, 0, sizeof *model);
    return rb_rolling_solve_model_reuse(rc, model, solution, why);
}

rb_status rb_rolling_solve_model_reuse(const rb_rolling_case *rc, rb_rolling_model *model,
                                       rb_rolling_solution *solution, rb_message *why)
{
    const double start = rb_seconds();
    rb_rolling_history history = {0};
    rb_status s;

    if (rb_rolling_has_steps(rc)) {
        rb_rolling_model_free(model);
        s = rb_rolling_history_run(rc, NULL, NULL, model, &history, why);
    } else {
        s = rb_rolling_check_layer_resolved(model, rb_rolling_model_reuse(rc, NULL, model, why),
                                            why);
    }
    rb_rolling_history_free(&history);
    s = rb_rolling_end_solve(model, s, start, solution, why);
    if (s == RB_OK && rc->formulation == RB_STEADY && rb_rolling_largest_mu(rc) > 0.0) {
        s = rb_rolling_free_creepage_if_any(model, &solution->free_creepage, why);
        solution->seconds_total = rb_seconds() - start;
    }
    if (s == RB_OK && rc->strips > 0) {
        s = rb_rolling_solve_strips(model, &solution->ellipse_force, why);
        solution->seconds_total = rb_seconds() - start;
        solution->status = s >= 0 ? s : solution->status;
    }
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

rb_status rb_rolling_solve_between(const rb_rolling_case *rc, double from, double to,
                                   rb_rolling_solution *solution, rb_message *why)
{
    const double start = rb_seconds();
    rb_rolling_model model = {0};
    rb_rolling_mesh mesh = {0};
    rb_status s = rb_rolling_case_check(rc, why);

    if (s == RB_OK)
        s = rb_rolling_model_begin(rc, NULL, &model, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_uniform(rc, NULL, from, to, &mesh, why);
    if (s == RB_OK)
        s = rb_rolling_model_build(&model, &mesh, why);
    s = rb_rolling_end_solve(&model, s, start, solution, why);
    rb_rolling_mesh_free(&mesh);
    rb_rolling_model_free(&model);
    return s;
}
