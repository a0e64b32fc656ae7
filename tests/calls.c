/* The calls of rollbem/api.h on one case, in every state of its handle, for the net: none
 * may crash, refuse without a reason, claim success with a message, or change the solution.
 *
 *     calls smooth|exact|stress [--OPTION VALUE]...
 *
 * with these derivatives of a case of one step, or its stress, which cost most.  Each line
 * says what is wrong. */
#include "rollbem/api.h"

#include "rolling/case/case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static rb_api *handle;
static const char *state; /* of the handle */
static int is_solved;     /* or has ended without a solution: calls have what they need */
static const char *kind;  /* what is asked of a case of one step */

static void complain(const char *call, int status)
{
    printf("%s, %s: status %d, '%s'\n", state, call, status, rb_api_message(handle));
}

/* Status of a call, with its message. */
static int ended(const char *call, int status)
{
    const char *why = rb_api_message(handle);

    if (status != rb_api_status(handle) || (status == RB_OK) != (why[0] == '\0') ||
        status == RB_ENOMEM || strstr(why, "nan"))
        complain(call, status);
    return status;
}

/* The same of a call that needs a solution. */
static void asked(const char *call, int status)
{
    if (ended(call, status) >= 0 && !is_solved)
        complain(call, status);
}

/* Sum of the entries, of which each must be readable; NAN: there is no such array. */
static double sum_of(const char *name)
{
    int rows, columns;
    const double *x = rb_api_array(handle, name, &rows, &columns);
    double sum = x ? 0.0 : NAN;

    if (!x && (rows != 0 || columns != 0))
        complain(name, rows);
    for (int k = 0; x && k < rows * columns; k++)
        sum += isnan(x[k]) ? 0.0 : x[k];
    if (isinf(sum))
        complain(name, 0);
    return sum;
}

/* What a call may not change. */
typedef struct {
    double number[6];
} results;

static results results_now(void)
{
    return (results){{sum_of("p"), sum_of("q"), sum_of("shift"), sum_of("history.tangential_load"),
                      rb_api_number(handle, "tangential_load"), rb_api_number(handle, "approach")}};
}

static void compare(const results *before, double bound, const char *call)
{
    const results now = results_now();
    const double scale[] = {before->number[0], before->number[0], 1.0,
                            before->number[3], before->number[0], before->number[5]};

    for (int k = 0; k < 6; k++)
        if (!(fabs(now.number[k] - before->number[k]) <= bound * fabs(scale[k])) &&
            !(isnan(now.number[k]) && isnan(before->number[k])))
            printf("%s, %s: result %d is %.17g, was %.17g\n", state, call, k, now.number[k],
                   before->number[k]);
}

/* Every result by name that the calls have left, and the notes. */
static void print_results(void)
{
    char more[] = "derivative.tangential_load derivative.p derivative.q derivative.value "
                  "derivative.approach.gap derivative.creepage.mu tolerance.tangential_load "
                  "history.derivative.tangential_load:mu history.derivative.approach:load "
                  "history.tolerance.tangential_load curve.creepage curve.tangential_load "
                  "curve.derivative.tangential_load:mu curve.tolerance.tangential_load step.p "
                  "step.x step.zone patch.from friction_power closed.q ends gap0 F mesh.x0 lcp.M "
                  "lcp.q pivot.value pivot.before newton.p guess.gap stress.max_shear "
                  "maxima.von_mises",
         *rest = more;
    const rb_rolling_results *const tables[] = {&rb_rolling_solution_columns,
                                                &rb_rolling_history_columns};
    char text[700];

    for (const char *name; (name = strtok_r(rest, " ", &rest));)
        sum_of(name);
    for (int t = 0; t < 2; t++)
        for (int k = 0; k < tables[t]->n; k++) {
            snprintf(text, sizeof text, "%s%s", t ? "history." : "", tables[t]->row[k].name);
            sum_of(text);
        }
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++)
        rb_api_number(handle, rb_rolling_solution_scalars.row[k].name);
    for (int k = 0; rb_api_note(handle, k, text, sizeof text); k++)
        if (!text[0] || strstr(text, "nan"))
            complain(text, k);
    for (int k = 0; rb_api_input(handle, k, "name", text, sizeof text); k++)
        rb_api_input(handle, k, "refusal", text, sizeof text);
}

/* All that is computed from a solution, and its arrays. */
static void ask_all(void)
{
    enum { MOST = 3000 };
    static int zone[MOST];
    int n, one;

    rb_api_array(handle, "p", &n, &one);
    for (int i = 0; i < n && i < MOST; i++)
        zone[i] = i % 4;
    const int all = !is_solved || !isnan(rb_api_number(handle, "history.half_width"));
    if (all || strcmp(kind, "smooth") == 0)
        asked("smooth derivatives", rb_api_smooth_derivatives(handle));
    if (all || strcmp(kind, "exact") == 0) {
        asked("derivatives", rb_api_derivatives(handle));
        asked("tolerances", rb_api_tolerances(handle, "radius=1%,poisson=0.01"));
        asked("tolerances of nothing", rb_api_tolerances(handle, "nothing=1"));
    }
    if (all || strcmp(kind, "stress") == 0) {
        asked("stress", rb_api_stress(handle, 3, 2, 0.0));
        asked("stress at", rb_api_stress_at(handle, 1, (const double[]){0.1, 0.4}));
        asked("stress maxima", rb_api_stress_maxima(handle, 0.0));
    }
    asked("derivatives of steps", rb_api_step_derivatives(handle, "tangential_load:mu", NULL));
    asked("pivots", rb_api_pivots(handle));
    asked("newton", rb_api_newton(handle));
    asked("guess", rb_api_guess(handle, n < MOST ? n : MOST, zone));
    print_results();
}

static void set(const char *name, const char *text, int wanted)
{
    if (ended(name, rb_api_set(handle, name, text)) != wanted)
        complain(name, rb_api_status(handle));
}

/* 1: where only this option has changed, the flexibility serves again. */
static int drives(const char *name)
{
    static const char *const driving[] = {"load",  "approach",    "half-width", "shift",
                                          "creep", "creep-ratio", "force",      "force-ratio"};
    for (size_t k = 0; k < sizeof driving / sizeof *driving; k++)
        if (strcmp(name, driving[k]) == 0)
            return 1;
    return 0;
}

int main(int argc, char **argv)
{
    int driving = 0; /* the last argument that names such an option */

    handle = rb_api_create();
    state = "new";
    if (!handle || argc < 3)
        return 1;
    kind = argv[1];
    for (int i = 2; i < argc; i++) {
        const rb_option *o = rb_case_option(argv[i] + 2);
        const int has_value = o && o->kind != RB_OPTION_FLAG;
        if (!o || i + has_value >= argc)
            return 1;
        set(o->name, has_value ? argv[i + 1] : "yes", RB_OK);
        driving = drives(o->name) ? i : driving;
        i += has_value;
    }
    ask_all();

    state = "solved";
    is_solved = 1;
    const int status = ended("solve", rb_api_solve(handle));
    const results first = results_now();
    is_solved = status >= 0;
    ask_all();
    compare(&first, 0.0, "what is computed from it");

    state = "set again";
    is_solved = 0;
    if (driving) {
        set(argv[driving] + 2, argv[driving + 1], RB_OK);
        ask_all();
        if (ended("solve", rb_api_solve(handle)) != status)
            complain("solve", status);
        compare(&first, 1e-6, "solve");
    }

    state = "refused";
    set("mu", "-1", RB_EINVAL);
    ask_all();
    asked("solve", rb_api_solve(handle));
    asked("curve", rb_api_curve(handle, "creep-ratio", 0.0, 0.5, 2, NULL, NULL));
    rb_api_free(handle);
    return 0;
}
