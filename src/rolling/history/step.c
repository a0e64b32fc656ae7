/* One step alone, from the state of a solution before it. */
#include "rolling/case/internal.h"
#include "rolling/history/history.h"
#include "rolling/history/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"

#include <math.h>
#include <string.h>

rb_status rb_rolling_step_between(const rb_rolling_case *rc, double from, double to,
                                  const rb_rolling_solution *before, const rb_rolling_table *start,
                                  double step, rb_rolling_solution *solution, rb_message *why)
{
    const double begun = rb_seconds();
    rb_rolling_model model = {0};
    rb_rolling_particles particles = {
        .rc = rc, .model = &model, .step = step, .steps = 1, .keeps_elements = 1};
    const rb_rolling_stride stride = {.c = step};
    rb_status s = rb_rolling_case_check(rc, why);

    memset(solution, 0, sizeof *solution);
    if (s == RB_OK &&
        (rc->formulation == RB_STEADY || rb_rolling_relaxes(rc) || rb_rolling_has_heat(rc)))
        s = rb_fail(why, RB_EINVAL,
                    "a step: not for steady rolling, viscoelastic bodies or temperatures");
    if (s == RB_OK && !(rc->formulation == RB_STATIC ? step == 0.0 : step > 0.0))
        s = rb_fail(why, RB_EINVAL, "a step: its length %g: expected > 0 where it rolls, 0 at rest",
                    step);
    if (s == RB_OK) {
        /* Equal elements between from and to, with nothing solved on them. */
        const int n = rc->contact_elements;
        double *x = rb_arena_doubles(&particles.memory, (size_t)n, 1),
               *h = rb_arena_doubles(&particles.memory, (size_t)n, 1);
        const rb_rolling_elements elements = {.n = n, .x = x, .h = h, .are_equal = 1};
        for (int i = 0; i < n && h; i++) {
            h[i] = (to - from) / n;
            x[i] = from + (i + 0.5) * h[i];
        }
        s = h ? rb_rolling_model_of_result(rc, NULL, &elements, &model, why)
              : rb_fail(why, RB_ENOMEM, "out of memory for %d elements", n);
    }
    if (s == RB_OK)
        s = rb_rolling_particles_create(&particles, why);
    if (s == RB_OK && before) {
        /* The state of the solution before, as far as a step looks at it. */
        const size_t n = (size_t)model.mesh.n, bytes = n * sizeof(double);
        const double *x = model.bodies.f.x, h = model.bodies.f.h[0];

        if (before->n != model.mesh.n || fabs(before->x[0] - x[0]) > 1e-6 * h ||
            fabs(before->x[n - 1] - x[n - 1]) > 1e-6 * h)
            s = rb_fail(why, RB_EINVAL, "a step: the state before has other elements");
        else {
            memcpy(model.state.p, before->p, bytes);
            memcpy(model.state.q, before->q, bytes);
            if (before->mu)
                memcpy(model.problem.bound, before->mu, bytes);
            if (before->plastic && model.carried.yielded)
                memcpy(model.carried.yielded, before->plastic, bytes);
        }
    }
    if (s == RB_OK)
        s = rb_rolling_particles_bring(&particles, &stride, why);
    if (s == RB_OK) {
        const rb_rolling_past past = {particles.w_T, model.carried.yielded, step};
        if (!before || start)
            rb_rolling_start_bounds(rc, start, &model.bodies, &model.problem);
        rb_rolling_set_past(rc, &model.bodies, &past, &model.problem);
        rb_rolling_set_control(rc, &model.problem);
        s = rb_rolling_model_resolve(&model, 0, why);
    }
    s = rb_rolling_end_solve(&model, s, begun, solution, why);
    rb_rolling_particles_free(&particles);
    rb_rolling_model_free(&model);
    return s;
}
