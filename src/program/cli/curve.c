/* rollbem curve: the tangential force over the creepage, or the resistance to rolling
 * over the speed. */
#include "program/cli/case.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>

/* --from and --to are texts because what they are values of is known from --over alone. */
typedef struct {
    const char *end[2]; /* NULL: the default */
    double from, to;    /* creepages, or speeds [mm/s] */
    int points, over;   /* rb_rolling_variable */
    const char *derivatives, *tolerance;
} range_options;

typedef struct {
    range_options range;
    rb_report_curves curves;
    rb_report_curves drawn;     /* as many where the picture has its own */
    rb_rolling_note_list notes; /* on the points of all curves */
} curve;

enum { FROM = 1, TO = 2 }; /* places in the table */

static const double default_end[] = {0.0, 1.5};

#define PLACE(member) offsetof(curve, range.member)

static const rb_option options[] = {
    RB_GROUP_LINE("curve", "Range of the curve"),
    RB_TEXT_LINE("from", PLACE(end[0]), "X", "first value; a speed [mm/s] may have a unit",
                 .unset = "0"),
    RB_TEXT_LINE("to", PLACE(end[1]), "X", "last value", .unset = "1.5"),
    RB_INTEGER_LINE("points", PLACE(points), RB_FROM_TO(2, RB_ROLLING_MOST_POINTS),
                    "equally spaced (speeds: in their logarithm), both ends among them"),
    RB_CHOICE_LINE("over", PLACE(over), rb_case_curve_variables,
                   "what is varied: xi R/(mu a), xi itself, or the speed"),
    RB_TEXT_LINE("derivatives", PLACE(derivatives), "RESULT,...",
                 "columns with the derivatives of these results of single cases at every point, "
                 "with respect to all numbers, or RESULT:OPTION to one",
                 .unset = "none", .alone = "all"),
    RB_TEXT_LINE(
        "tolerance", PLACE(tolerance), "NAME=X,...",
        "standard deviations of inputs, as mu=0.02,radius=1%: a column deviation_... with that "
        "of each result at every point, to first order",
        .unset = "none"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert((int)OPTIONS <= (int)CLI_COMMAND_OPTIONS_MAX, "given");

static const char about[] =
    "Computes a creep curve, the tangential force of steady rolling over the\n"
    "creepage, on one mesh with warm starts, and prints a row per creepage. --mu accepts several "
    "values separated by commas and gives one curve for each.\n"
    "The picture shows -Q/(mu P), or for several mu -Q/P over xi, and Carter's law\n"
    "for similar bodies.\n"
    "If friction depends on the slip or the temperature, the curve is also computed\n"
    "for decreasing creepage: column branch, and a second line in the picture.\n"
    "--over speed shows the rolling resistance M/(P R) of viscoelastic bodies, else\n"
    "the friction that depends on the slip or the temperature (under a given force\n"
    "the creepage); creepage or force is then given by --creep, --force or\n"
    "--free-axle as in a single case.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Example: rollbem curve --similar --support halfplane --load 500 --plot curve.png\n";

/* ---- The range --------------------------------------------------------------------- */

static const char *unit_of(const range_options *r)
{
    return r->over == RB_OVER_SPEED ? "mm/s" : "-";
}

/* One end, as it is stored; place: FROM or TO. */
static cli_exit read_end(cli_case_run *run, int place, double *end)
{
    const range_options *r = &((const curve *)run->own)->range;
    const char *text = r->end[place - FROM], *name = options[place].name;
    const rb_option number = {
        .name = name, .kind = RB_OPTION_NUMBER, .unit = unit_of(r), .range = RB_ANY};
    int *given = &run->set.given[place];
    const rb_option_set set = {&number, 1, end, given, &run->set.plain[place]};
    char what[300];
    rb_message why = {.text = ""};
    *end = default_end[place - FROM];
    if (!text)
        return CLI_CONTINUE;
    rb_option_source(&number, *given, cli_case_file_of(&run->args), what, sizeof what);
    if (rb_option_assign(&set, 0, *given, what, text, &why) != RB_OK)
        return cli_fail(*given > 0 ? CLI_DATA : CLI_USAGE, "%s", why.text);
    rb_case_store(run->words, &set, end);
    return CLI_CONTINUE;
}

/* ---- Solve ------------------------------------------------------------------------ */

static rb_rolling_range range_of(const range_options *r)
{
    return (rb_rolling_range){(rb_rolling_variable)r->over, r->from, r->to, r->points, RB_UNITS_MM};
}

static rb_status solve_curves(const rb_case *words, const rb_resolved_case *c,
                              const range_options *range, rb_report_curves *curves, rb_message *why)
{
    rb_rolling_range all = range_of(range);
    const rb_numbers one = {1, {c->rc.mu}};
    const rb_numbers *mus = c->mus.n > 0 ? &c->mus : &one;
    rb_rolling_case rc = c->rc;
    rb_status s = RB_OK;
    all.units = c->units;
    for (int k = 0; k < mus->n && s >= 0 && (s == RB_OK || curves->curve[k - 1].unsolved > 0);
         k++) {
        const rb_status before = s;
        rb_message reason = {.text = ""};
        rc.mu = curves->mu[k] = mus->value[k];
        if (range->derivatives || range->tolerance) {
            s = rb_case_curve_choose(words, &all, range->derivatives, range->tolerance,
                                     &curves->slopes[k], &reason);
            if (s == RB_OK)
                s = rb_case_curve_solve(words, &all, rc.mu, NULL, NULL, &curves->curve[k],
                                        &curves->slopes[k], &reason);
        } else if (c->error)
            s = rb_rolling_curve_with_errors(&rc, &all, NULL, NULL, &curves->curve[k],
                                             &curves->error[k], &reason);
        else
            s = rb_rolling_curve_solve(&rc, &all, &curves->curve[k], &reason);
        curves->n += s >= 0;
        /* an option that is refused is named by itself */
        if (s != RB_OK && mus->n > 1 && before == RB_OK && !reason.about[0])
            rb_fail(why, s, "mu = %g: %.480s", rc.mu, rb_status_reason(s, &reason));
        else if (s != RB_OK && (before == RB_OK || s < 0))
            *why = reason;
        s = s == RB_OK ? before : s;
    }
    curves->has_errors = c->error && s == RB_OK; /* an unfinished curve has none */
    curves->rc = &c->rc;
    return s;
}

static void convert(rb_report_curves *curves, rb_units units)
{
    for (int k = 0; k < curves->n; k++) {
        rb_rolling_curve_convert(&curves->curve[k], units);
        rb_rolling_curve_convert(&curves->error[k], units);
        rb_case_slopes_convert(&curves->slopes[k], units);
    }
}

static rb_rolling_note_list notes_on_points(const rb_report_curves *curves)
{
    rb_rolling_study_notes found = {.rows = 0};

    for (int k = 0; k < curves->n; k++)
        rb_rolling_join_study_notes(&found, &curves->curve[k].notes);
    return rb_rolling_list_study_notes(&found, "point");
}

/* Those that are solved, and the one that was refused, if there is one. */
static void free_curves(rb_report_curves *curves)
{
    for (int k = 0; k <= curves->n && k < RB_REPORT_CURVES; k++) {
        rb_rolling_curve_free(&curves->curve[k]);
        rb_rolling_curve_free(&curves->error[k]);
        rb_case_slopes_free(&curves->slopes[k]);
    }
}

static rb_status solve_all_curves(cli_case_run *run, rb_message *why)
{
    curve *r = run->own;
    rb_status s = solve_curves(run->words, run->c, &r->range, &r->curves, why);
    if (s == RB_OK) {
        /* Equal ratios are different creepages where mu differs, and the curves of a
         * picture over xi would end one after another: it has its own, over all the
         * creepages that occur. */
        range_options common = r->range;
        if (run->o.plot && common.over == RB_OVER_CREEP_RATIO && r->curves.n >= 2) {
            common.over = RB_OVER_CREEP;
            common.from = INFINITY;
            common.to = -INFINITY;
            for (int k = 0; k < r->curves.n; k++) {
                const rb_rolling_curve *c = &r->curves.curve[k];
                common.from = fmin(common.from, fmin(c->creepage[0], c->creepage[c->rising - 1]));
                common.to = fmax(common.to, fmax(c->creepage[0], c->creepage[c->rising - 1]));
            }
            common.derivatives = NULL;
            s = solve_curves(run->words, run->c, &common, &r->drawn, why);
        }
    }
    convert(&r->curves, run->c->units);
    const int k = r->curves.n - 1;
    r->notes = notes_on_points(&r->curves);
    run->of_rows = &r->notes;
    if (k >= 0 && r->curves.curve[k].last.n > 0)
        run->solution = &r->curves.curve[k].last; /* cited */
    convert(&r->drawn, run->c->units);
    run->printable = s >= 0 && r->curves.n > 0 && r->curves.curve[0].n > 0;
    return s;
}

/* ---- Print ------------------------------------------------------------------------ */

static void add_inputs(const cli_case_run *run, json_t **inputs)
{
    const range_options *r = &((const curve *)run->own)->range;
    const rb_units units = run->c->units;
    rb_report_json_set(inputs, "from", json_real(rb_unit_shown(units, unit_of(r), r->from)));
    rb_report_json_set(inputs, "to", json_real(rb_unit_shown(units, unit_of(r), r->to)));
    rb_report_json_set(inputs, "points", json_integer(r->points));
    rb_report_json_set(inputs, "over", json_string(rb_case_curve_variables[r->over].name));
}

static void add_json(const cli_case_run *run, json_t **root)
{
    rb_report_json_curves(root, &((const curve *)run->own)->curves);
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    return rb_report_curve_table(out, &((const curve *)run->own)->curves, run->notes,
                                 cli_command_line(), &run->o.style);
}

static rb_status draw_curve(FILE *out, rb_report_canvas canvas, const void *context,
                            rb_message *why)
{
    const cli_case_run *run = context;
    const curve *r = run->own;
    return rb_report_curve_picture(out, canvas, &run->c->rc,
                                   r->drawn.n == r->curves.n ? &r->drawn : &r->curves,
                                   (rb_rolling_variable)r->range.over, why);
}

static const cli_case_file files[] = {{"plot", .draw = draw_curve}, {NULL, NULL, NULL}};

static void summarise_curve(FILE *out, const cli_case_run *run)
{
    rb_report_curve_summary(out, &((const curve *)run->own)->curves);
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit choose_purpose(cli_case_run *run)
{
    if (((const curve *)run->own)->range.over == RB_OVER_SPEED)
        rb_case_set_purpose(run->words, RB_CASE_SPEEDS);
    return CLI_CONTINUE;
}

static cli_exit check_curve(cli_case_run *run)
{
    range_options *r = &((curve *)run->own)->range;
    cli_exit code = read_end(run, FROM, &r->from);
    if (code == CLI_CONTINUE)
        code = read_end(run, TO, &r->to);
    if (code != CLI_CONTINUE)
        return code;
    if (r->from == r->to)
        return cli_case_refuse(run->words, "to,from",
                               "expected two different values as --from and --to");
    /* The picture shows the force as a part of the friction, mu P. */
    rb_rolling_case rc = run->c->rc;
    int frictionless = rb_rolling_largest_mu(&rc) == 0.0;
    for (int k = 0; k < run->c->mus.n; k++) {
        rc.mu = run->c->mus.value[k];
        frictionless |= rb_rolling_largest_mu(&rc) == 0.0;
    }
    if (run->o.plot && frictionless && r->over != RB_OVER_SPEED)
        return cli_case_refuse(run->words, "plot", "no curve to draw at mu = 0");
    /* Names of results and of numbers. */
    const rb_rolling_range range = range_of(r);
    rb_case_slopes slopes;
    rb_message why = {.text = ""};
    if ((r->derivatives || r->tolerance) && run->c->error)
        return cli_case_refuse(run->words, r->derivatives ? "derivatives" : "tolerance",
                               "not together with error bars");
    if (!r->derivatives && !r->tolerance)
        return CLI_CONTINUE;
    const rb_status s =
        rb_case_curve_choose(run->words, &range, r->derivatives, r->tolerance, &slopes, &why);
    rb_case_slopes_free(&slopes);
    return cli_case_refused(run->words, s, &why);
}

static const cli_case_command command = {
    .synopsis = "rollbem curve [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_CURVE,
    .second = RB_CASE_SPEEDS,
    .options = options,
    .option_n = OPTIONS,
    .files = files,
    .prepare = choose_purpose,
    .check = check_curve,
    .solve = solve_all_curves,
    .table = write_table,
    .inputs = add_inputs,
    .json = add_json,
    .summarise = summarise_curve,
};

int cli_curve(int argc, char **argv)
{
    /* a megabyte, of which most commands touch nothing: what describes itself comes here, too */
    curve *r = calloc(1, sizeof *r);
    if (!r)
        return cli_fail(CLI_INTERNAL, "out of memory");
    r->range.points = 61;
    const cli_exit code = cli_case_run_command(&command, r, argc, argv);
    free_curves(&r->curves);
    free_curves(&r->drawn);
    free(r);
    return code;
}
