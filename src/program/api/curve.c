/* Curves: points of one case over its creepage, its force or its speed. */
#include "program/api/internal.h"

#include <string.h>

/* Counts the points of a curve, and ends it where the caller has had enough. */
static rb_status count_point(const rb_rolling_model *model, int k, void *context, rb_message *why)
{
    (void)model, (void)k;
    rb_api *a = context;
    a->done++;
    return a->stopped ? rb_fail(why, RB_INTERRUPTED, "interrupted") : RB_OK;
}

int rb_api_curve(rb_api *a, const char *over, double from, double to, int points,
                 const char *derivatives, const char *tolerance)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_choice *variable = rb_case_curve_variables;
    while (variable->name && strcmp(variable->name, over) != 0)
        variable++;
    rb_api_forget_call(a);
    rb_api_forget_notes(a);
    rb_api_forget_slopes(a, API_SLOPES_CURVE);
    rb_api_forget_arrays(a, "curve.");
    rb_rolling_curve_free(&a->curve);
    rb_rolling_curve_free(&a->curve_errors);
    const int speeds = variable->name && variable->value == RB_OVER_SPEED;
    const char *unit = speeds ? "mm/s" : NULL;
    const rb_rolling_range range = {(rb_rolling_variable)variable->value,
                                    rb_api_stored(a, unit, from), rb_api_stored(a, unit, to),
                                    points, c->units};
    rb_api_call_begins(a);
    rb_status s = rb_api_check_refusals(a, &a->why);
    if (s == RB_OK) {
        /* Variables differ in the options that they refuse. */
        if (a->is_curve && range.over == RB_OVER_SPEED)
            rb_case_set_purpose(a->words, RB_CASE_SPEEDS);
        s = rb_case_resolve(a->words, &a->why);
        if (a->is_curve)
            rb_case_set_purpose(a->words, RB_CASE_CURVE);
        if (s != RB_OK) { /* the solution keeps its case */
            rb_message known;
            s = rb_case_locate(a->words, s, &a->why);
            rb_case_resolve(a->words, &known);
            return rb_api_ended(a, rb_api_call_ends(a, s));
        }
    }
    a->total = (c->error ? 1 + rb_rolling_error_runs(&c->rc) : 1) *
               (range.over != RB_OVER_SPEED && rb_rolling_law_depends_on_state(&c->rc) ? 2 * points
                                                                                       : points);
    rb_case_slopes *slopes = &a->slopes[API_SLOPES_CURVE];
    if (s == RB_OK && !variable->name)
        s = rb_fail(&a->why, RB_EINVAL,
                    "--over: expected creep-ratio, creep or speed, got '%.100s'", over);
    const int differentiated = derivatives || tolerance;
    if (s == RB_OK && differentiated && c->error)
        s = rb_fail(&a->why, RB_EINVAL, "--%s: not together with error bars",
                    derivatives ? "derivatives" : "tolerance");
    if (s == RB_OK && differentiated && c->rc.formulation != RB_STEADY)
        s = rb_fail(&a->why, RB_EINVAL,
                    "derivatives of a curve need a steady case; give --formulation steady");
    if (s == RB_OK && differentiated)
        s = rb_case_curve_choose(a->words, &range, derivatives, tolerance, slopes, &a->why);
    if (s == RB_OK)
        s = differentiated ? rb_case_curve_solve(a->words, &range, c->rc.mu, count_point, a,
                                                 &a->curve, slopes, &a->why)
            : c->error
                ? rb_rolling_curve_with_errors(&c->rc, &range, count_point, a, &a->curve,
                                               &a->curve_errors, &a->why)
                : rb_rolling_curve_observe(&c->rc, &range, count_point, a, &a->curve, &a->why);
    s = rb_api_call_ends(a, s);
    a->rows = a->curve.notes;
    a->row = "point";
    rb_case_slopes_note(slopes, &a->note);
    slopes->tolerance = NULL; /* the caller's */
    if (s != RB_OK) {
        rb_api_forget_slopes(a, API_SLOPES_CURVE);
        s = rb_case_locate(a->words, s, &a->why);
    }
    return rb_api_ended(a, s);
}
