/* rollbem curve: the tangential force over the creepage, or the resistance to rolling
 * over the speed. */
#include "cli/case.h"
#include "cli/output.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

/* --from and --to are texts because what they are values of is known from --over alone.
 */
typedef struct {
    const char *end[2]; /* NULL: the default */
    double from, to;    /* creepages, or speeds [mm/s] */
    int points, over;   /* rb_rolling_variable */
    int given[5];
} range_options;

enum { FROM = 1, TO = 2 }; /* places in the table */

static const double default_end[] = {0.0, 1.5};

#define PLACE(member) offsetof(range_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("curve", "Range of the curve"),
    RB_TEXT_LINE("from", PLACE(end[0]), "X",
                 "first value; a speed [mm/s] may have a unit", .unset = "0"),
    RB_TEXT_LINE("to", PLACE(end[1]), "X", "last value", .unset = "1.5"),
    RB_INTEGER_LINE("points", PLACE(points), RB_FROM_TO(2, 1000000),
                    "equally spaced (speeds: in their logarithm), both ends among them"),
    RB_CHOICE_LINE("over", PLACE(over), rb_case_curve_variables,
                   "what is varied: xi R/(mu a), xi itself, or the speed of bodies "
                   "that relax"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS == 5, "given");

static const char about[] =
    "Computes a creep curve, the tangential force of steady rolling over the\n"
    "creepage, on one mesh with warm starts, and prints a row per creepage. --mu\n"
    "takes several values with commas between: a curve each.\n"
    "The picture shows -Q/(mu P), or -Q/P over xi where there are several mu, and\n"
    "Carter's law (similar bodies) beside it.\n"
    "Where friction depends on the slip or the temperature the creepage goes back "
    "again:\n"
    "the column branch, and a second line in the picture.\n"
    "--over speed shows the resistance to rolling, M/(P R), of bodies that relax;\n"
    "--creep, --force or --free-axle then drive the wheel as in a single case.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Example: rollbem curve --similar --support halfplane --load 500 --plot curve.png\n";

/* ---- The range --------------------------------------------------------------------- */

static const char *unit_of(const range_options *r)
{
    return r->over == RB_OVER_SPEED ? "mm/s" : "-";
}

/* One end, as it is stored; place: FROM or TO. */
static cli_exit read_end(const rb_case *words, const cli_args *args, range_options *r,
                         int place, double *end)
{
    const char *text = r->end[place - FROM], *name = options[place].name;
    const rb_option number = {
        .name = name, .kind = RB_OPTION_NUMBER, .unit = unit_of(r), .range = RB_ANY};
    int plain = 0, *given = &r->given[place];
    const rb_option_set set = {&number, 1, end, given, &plain};
    char what[300];
    rb_message why;
    *end = default_end[place - FROM];
    if (!text)
        return CLI_CONTINUE;
    if (*given > 0)
        snprintf(what, sizeof what, "%.200s:%d: %s", args->operand[0], *given, name);
    else
        snprintf(what, sizeof what, "--%s", name);
    if (rb_option_assign(&set, 0, *given, what, text, &why) != RB_OK)
        return cli_fail(*given > 0 ? CLI_DATA : CLI_USAGE, "%s", why.text);
    rb_option_store(&set, rb_case_units(words), rb_case_file_units(words), end);
    return CLI_CONTINUE;
}

static cli_exit read_range(const rb_case *words, const cli_args *args, range_options *r)
{
    cli_exit code = read_end(words, args, r, FROM, &r->from);
    if (code == CLI_CONTINUE)
        code = read_end(words, args, r, TO, &r->to);
    return code == CLI_CONTINUE && r->from == r->to
               ? cli_fail(CLI_USAGE, "--from and --to: expected two different values")
               : code;
}

/* ---- Solve ------------------------------------------------------------------------ */

typedef struct {
    const rb_case *words;
    const rb_settled_case *c;
    const range_options *range;
    const cli_output *o;
    rb_report_curves curves;
    rb_report_curves drawn; /* as many where the picture has its own */
} result;

/* The picture shows the force as a part of the friction, mu P. */
static cli_exit check_picture(const rb_settled_case *c, const range_options *r,
                              const cli_output *o)
{
    rb_rolling_case rc = c->rc;
    int frictionless = rb_rolling_largest_mu(&rc) == 0.0;
    for (int k = 0; k < c->mus.n; k++) {
        rc.mu = c->mus.value[k];
        frictionless |= rb_rolling_largest_mu(&rc) == 0.0;
    }
    return o->plot && frictionless && r->over != RB_OVER_SPEED
               ? cli_fail(CLI_USAGE, "--plot: no curve to draw at mu = 0")
               : CLI_CONTINUE;
}

static rb_status solve_curve(const rb_rolling_case *rc, const range_options *r,
                             int with_errors, rb_rolling_curve *curve,
                             rb_rolling_curve *errors, rb_message *why)
{
    const rb_rolling_range range = {(rb_rolling_variable)r->over, r->from, r->to,
                                    r->points};
    return with_errors ? rb_rolling_curve_with_errors(rc, &range, curve, errors, why)
                       : rb_rolling_curve_solve(rc, &range, curve, why);
}

static rb_status solve_curves(const rb_settled_case *c, const range_options *range,
                              rb_report_curves *curves, rb_message *why)
{
    const rb_numbers one = {1, {c->rc.mu}};
    const rb_numbers *mus = c->mus.n > 0 ? &c->mus : &one;
    rb_rolling_case rc = c->rc;
    rb_status s = RB_OK;
    for (int k = 0; k < mus->n && s == RB_OK; k++) {
        rb_message reason = {""};
        rc.mu = curves->mu[k] = mus->value[k];
        s = solve_curve(&rc, range, c->error, &curves->curve[k], &curves->error[k],
                        &reason);
        curves->n += s >= 0;
        if (s != RB_OK && mus->n > 1)
            rb_fail(why, s, "mu = %g: %.280s", rc.mu, reason.text);
        else if (s != RB_OK)
            *why = reason;
    }
    curves->has_errors = c->error && s == RB_OK; /* an unfinished curve has none */
    return s;
}

/* Equal ratios are different creepages where mu differs, and the curves of a picture over
 * xi would end one after another: it has its own, over all the creepages that occur. */
static rb_status solve_drawn(result *r, rb_message *why)
{
    range_options common = *r->range;
    if (!r->o->plot || common.over != RB_OVER_CREEP_RATIO || r->curves.n < 2)
        return RB_OK;
    common.over = RB_OVER_CREEP;
    common.from = INFINITY;
    common.to = -INFINITY;
    for (int k = 0; k < r->curves.n; k++) {
        const rb_rolling_curve *c = &r->curves.curve[k];
        common.from = fmin(common.from, fmin(c->creepage[0], c->creepage[c->rising - 1]));
        common.to = fmax(common.to, fmax(c->creepage[0], c->creepage[c->rising - 1]));
    }
    return solve_curves(r->c, &common, &r->drawn, why);
}

static void convert(rb_report_curves *curves, rb_units units)
{
    for (int k = 0; k < RB_REPORT_CURVES; k++) {
        rb_rolling_curve_convert(&curves->curve[k], units);
        rb_rolling_curve_convert(&curves->error[k], units);
    }
}

static void free_curves(rb_report_curves *curves)
{
    for (int k = 0; k < RB_REPORT_CURVES; k++) {
        rb_rolling_curve_free(&curves->curve[k]);
        rb_rolling_curve_free(&curves->error[k]);
    }
}

/* ---- Print ------------------------------------------------------------------------ */

static rb_status print_json(FILE *out, const result *r)
{
    json_t *inputs = rb_report_json_inputs(r->words);
    const char *unit = unit_of(r->range);
    rb_report_json_set(&inputs, "from",
                       json_real(rb_unit_shown(r->c->units, unit, r->range->from)));
    rb_report_json_set(&inputs, "to",
                       json_real(rb_unit_shown(r->c->units, unit, r->range->to)));
    rb_report_json_set(&inputs, "points", json_integer(r->range->points));
    rb_report_json_set(&inputs, "over",
                       json_string(rb_case_curve_variables[r->range->over].name));
    json_t *root = cli_case_json(r->words, NULL, inputs);
    rb_report_json_curves(&root, &r->curves);
    return rb_report_json_write(out, root);
}

static rb_status print(FILE *out, const void *context, rb_message *why)
{
    const result *r = context;
    (void)why;
    return r->o->style.format == RB_REPORT_JSON
               ? print_json(out, r)
               : rb_report_curve_table(out, &r->curves, cli_command_line(), &r->o->style);
}

static rb_status draw(FILE *out, rb_report_canvas canvas, const void *context,
                      rb_message *why)
{
    const result *r = context;
    return rb_report_curve_picture(out, canvas, &r->c->rc,
                                   r->drawn.n == r->curves.n ? &r->drawn : &r->curves,
                                   (rb_rolling_variable)r->range->over, why);
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit show(const result *r)
{
    cli_exit code = cli_write_file(r->o->output, print, r);
    if (code == CLI_OK && !r->o->quiet)
        rb_report_curve_summary(stderr, &r->curves);
    if (code == CLI_OK && r->o->cite) {
        rb_rolling_case steady = r->c->rc;
        steady.formulation = RB_STEADY;
        rb_report_citations(stderr, &steady, NULL);
    }
    if (code == CLI_OK)
        code = cli_draw_file(&r->o->pictures, "plot", r->o->plot, draw, r);
    return code;
}

static cli_exit solve(const rb_case *words, const range_options *range,
                      const cli_output *o)
{
    const rb_settled_case *c = rb_case_settled(words);
    result r = {.words = words, .c = c, .range = range, .o = o};
    rb_message why = {""};
    cli_exit code = CLI_OK;
    rb_status s = solve_curves(c, range, &r.curves, &why);
    if (s == RB_OK)
        s = solve_drawn(&r, &why);
    convert(&r.curves, c->units);
    convert(&r.drawn, c->units);
    if (s >= 0 && r.curves.n > 0 && r.curves.curve[0].n > 0)
        code = show(&r);
    if (code == CLI_OK && s != RB_OK)
        code = cli_case_refused(words, s, &why);
    free_curves(&r.curves);
    free_curves(&r.drawn);
    return code;
}

int cli_curve(int argc, char **argv)
{
    cli_output o = {0};
    range_options range = {.points = 61};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_CURVE);
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {"rollbem curve [OPTION...] [CASE.ini]",
                           about,
                           notes,
                           {rb_case_options(c),
                            {options, OPTIONS, &range, range.given, NULL},
                            cli_output_set(&o),
                            cli_example_set()},
                           4};
    cli_exit code = cli_case_read(&spec, argc, argv, c, &args);
    if (range.over == RB_OVER_SPEED)
        rb_case_set_purpose(c, RB_CASE_SPEEDS);
    if (code == CLI_CONTINUE)
        code = cli_case_settle(&spec, c, &args);
    if (code == CLI_CONTINUE)
        code = read_range(c, &args, &range);
    if (code == CLI_CONTINUE)
        code = check_picture(rb_case_settled(c), &range, &o);
    if (code == CLI_CONTINUE)
        code = solve(c, &range, &o);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
