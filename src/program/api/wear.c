/* Wear of a case over its steps. */
#include "program/api/internal.h"

#include <string.h>

static int stop_wear(rb_rolling_solution *s, const rb_rolling_wear_history *h, int step, int steps,
                     void *context)
{
    (void)s;
    (void)h;
    rb_api *a = context;
    a->total = steps;
    a->done = step;
    return a->stopped;
}

int rb_api_wear(rb_api *a, const char *law, double coefficient, double share, double slide,
                double cycles, int steps, int quarter)
{
    const rb_rolling_wear how = {.law = strcmp(law, "archard") == 0 ? RB_WEAR_ARCHARD
                                                                    : RB_WEAR_DISSIPATION,
                                 .coefficient = rb_api_stored(a, "1/MPa", coefficient),
                                 .share = share,
                                 .slides = !isnan(slide),
                                 .way = isnan(slide) ? cycles : rb_api_stored(a, "mm", slide),
                                 .steps = steps,
                                 .increments = quarter};
    rb_rolling_solution last = {0};
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, "wear.");
    rb_rolling_wear_history_free(&a->wear);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK && how.law == RB_WEAR_DISSIPATION && strcmp(law, "dissipation") != 0)
        s = rb_fail(&a->why, RB_EINVAL, "wear law: expected archard or dissipation, got '%.100s'",
                    law);
    if (s == RB_OK && !isnan(slide) && !isnan(cycles))
        s = rb_fail(&a->why, RB_EINVAL, "slide and cycles exclude each other");
    if (s == RB_OK)
        s = rb_case_resolve(a->words, &a->why);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = (rb_case_resolved(a->words)->error ? rb_rolling_wear_with_errors : rb_rolling_wear_run)(
            &rb_case_resolved(a->words)->rc, &how, &(rb_rolling_wear_observer){stop_wear, a},
            &a->wear, &last, &a->why);
    s = rb_api_call_ends(a, s);
    if (s >= 0 && last.worn &&
        (!rb_api_copy_array(a, "wear.profile.x", last.n, 1, last.x) ||
         !rb_api_copy_array(a, "wear.profile.depth", last.n, 1, last.worn)))
        s = RB_ENOMEM;
    rb_rolling_solution_free(&last);
    return rb_api_ended(a, s);
}
