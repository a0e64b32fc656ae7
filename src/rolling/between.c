/* A case on a given line of equal elements, as other programs' input files have it. */
#include "rolling/internal.h"

#include <string.h>

rb_status rb_rolling_solve_between(const rb_rolling_case *rc, double from, double to,
                                   rb_rolling_solution *solution, rb_message *why)
{
    rb_rolling_model model = {.rc = *rc};
    rb_rolling_mesh mesh = {0};
    const double start = rb_seconds();

    memset(solution, 0, sizeof *solution);
    rb_status s = rb_rolling_case_check(rc, why);
    if (s == RB_OK)
        s = rb_rolling_mesh_uniform(&model.rc, from, to, &mesh, why);
    if (s == RB_OK)
        s = rb_rolling_model_build(&model, &mesh, why);
    if (s >= 0 && model.state.p) {
        const rb_status t = rb_rolling_model_solution(&model, solution, why);
        s = t == RB_OK ? s : t;
        solution->status = s;
        solution->seconds_total = rb_seconds() - start;
    }
    rb_rolling_mesh_free(&mesh);
    rb_rolling_model_free(&model);
    return s;
}
