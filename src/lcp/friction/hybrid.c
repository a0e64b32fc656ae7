/* Gauss-Seidel for an approximate solution, then Newton without line search, *Acary*.
 *
 * Number of sweeps: a few show whether they help.  If they reduce the error well, most
 * contacts are in their final states and Newton's method needs one or two steps.  If they
 * do not, their result is a worse start than the given one (examples/fem/wall-study.md), and a
 * hundred sweeps would be wasted. */
#include "lcp/friction/internal.h"

#include <stdlib.h>
#include <string.h>

#define FIRST_SWEEPS 7
#define WORTH 0.3 /* of the error before: above, Newton starts where the sweeps did */
#define MANY_SWEEPS 100
#define STEPS_BEFORE_SEARCH 30

static int goes_on(rb_status s)
{
    return s == RB_MAXITER || s == RB_INACCURATE || s == RB_SINGULAR;
}

static rb_status plain_newton(rb_friction_task *task)
{
    return rb_friction_run(task, &rb_friction_newton, RB_FRICTION_ALART_CURNIER,
                           STEPS_BEFORE_SEARCH);
}

static rb_status run_hybrid(rb_friction_task *task, int variant)
{
    const size_t bytes = (size_t)task->m * sizeof(double);
    double *start = rb_alloc((size_t)task->m, 1);
    if (!start)
        return RB_ENOMEM;
    memcpy(start, task->r, bytes);
    rb_status st = RB_MAXITER;
    if (!(variant & RB_FRICTION_HUNDRED_SWEEPS)) {
        const double before = rb_friction_task_error(task);
        st = rb_friction_run(task, &rb_friction_sweeps, RB_FRICTION_SWEEP_ANDERSON, FIRST_SWEEPS);
        if (goes_on(st)) {
            if (rb_friction_task_error(task) > WORTH * before)
                memcpy(task->r, start, bytes);
            st = plain_newton(task);
        }
        if (goes_on(st))
            memcpy(task->r, start, bytes);
    }
    /* Where that cycles: the hundred sweeps of *Acary*, Newton from there, and if need be
     * once more with line search. */
    if (goes_on(st)) {
        st = rb_friction_run(task, &rb_friction_sweeps, 0, MANY_SWEEPS);
        memcpy(start, task->r, bytes);
        if (goes_on(st))
            st = plain_newton(task);
        if (goes_on(st)) {
            memcpy(task->r, start, bytes);
            st = rb_friction_run(task, &rb_friction_newton,
                                 RB_FRICTION_ALART_CURNIER | RB_FRICTION_LINE_SEARCH, 0);
        }
    }
    free(start);
    return st;
}

const rb_friction_method rb_friction_hybrid = {.run = run_hybrid};
