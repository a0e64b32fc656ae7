/* The force of a whole ellipse by strips that are solved one by one (E3). */
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"

#include <gsl/gsl_math.h>

/* The same contact under an ellipse that is narrower by `part`, at this creepage: R_eq stays. */
static rb_rolling_case strip_of(const rb_rolling_case *rc, double part, double creepage)
{
    rb_rolling_case strip = *rc;

    strip.strips = 0;
    strip.ellipse.a *= part;
    strip.ellipse.pressure *= part;
    strip.zone *= part;
    strip.creep = creepage;
    strip.creep_ratio = strip.force = strip.force_ratio = NAN;
    strip.free_axle = 0;
    return strip;
}

/* The coefficients of the model at the places that are as far from the edges of the strip: what
 * falls with the slip has several solutions, and a strip takes the one beside its neighbour's. */
static rb_status start_beside(const rb_rolling_model *model, double part, rb_arena *scratch,
                              rb_rolling_table *start)
{
    const size_t n = (size_t)model->mesh.n;
    double *x = rb_arena_doubles(scratch, n, 1), *mu = rb_arena_doubles(scratch, n, 1);

    if (scratch->failed)
        return RB_ENOMEM;
    for (size_t i = 0; i < n; i++) {
        x[i] = part * model->bodies.f.x[i];
        mu[i] = model->problem.bound[i];
    }
    *start = (rb_rolling_table){model->mesh.n, x, mu};
    return RB_OK;
}

/* Q of the strip of this part. */
static rb_status solve_strip(const rb_rolling_model *model, double part, double *force,
                             rb_message *why)
{
    const rb_rolling_case rc = strip_of(model->rc, part, model->state.xi);
    rb_rolling_plan plan = rb_rolling_plan_of(&rc);
    rb_rolling_model strip = {.freely = NULL};
    rb_rolling_table start;
    rb_arena scratch = {0};
    rb_status s = RB_OK;

    if (rb_rolling_law_depends_on_state(&rc)) {
        s = start_beside(model, part, &scratch, &start);
        plan.start = &start;
    }
    if (s == RB_OK)
        s = rb_rolling_model_reuse(&rc, &plan, &strip, why);
    *force = s == RB_OK ? rb_rolling_model_force(&strip) : NAN;
    rb_rolling_model_free(&strip);
    return rb_arena_done(&scratch, s);
}

/* Two strips beside the middle are the same: half of them are solved, and the middle one of an odd
 * number is the model itself. */
rb_status rb_rolling_solve_strips(const rb_rolling_model *model, double *force, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const int n = rc->strips;
    double sum = 0.0, carried = 0.0;

    if (n == 0)
        return RB_OK;
    for (int j = 0; j < (n + 1) / 2; j++) {
        const int is_middle = 2 * j + 1 == n;
        const double part = is_middle ? 1.0 : sin((j + 0.5) * M_PI / n),
                     weight = (is_middle ? 1.0 : 2.0) * part;
        double Q = rb_rolling_model_force(model);
        rb_message reason = {.text = ""};
        const rb_status s = is_middle ? RB_OK : solve_strip(model, part, &Q, &reason);
        if (s != RB_OK) {
            *force = NAN;
            return rb_fail(why, s, "strips: the strip of the width %g a has no solution: %.400s",
                           part, rb_status_reason(s, &reason));
        }
        sum += weight * Q;
        carried += weight * part * part;
    }
    *force = rc->wheel_load * sum / (carried * rb_rolling_derive(rc).load);
    return RB_OK;
}
