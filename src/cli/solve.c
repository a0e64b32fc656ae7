/* rollbem [OPTION...] [CASE.ini]: solves one case and prints what came out. */
#include "cli/case.h"
#include "cli/output.h"
#include "cli/run.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    int trace, all_solutions, states;
    const char *dump, *fclib, *history_table, *history_plot;
    cli_steps steps;
} solve_options;

#define PLACE(member) offsetof(solve_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Behind the solution"),
    RB_TEXT_LINE("dump", PLACE(dump), "DIR",
                 "mesh, H, G, F, M, b as Matrix Market files; with --trace also tableaux",
                 .unset = "none", .file = RB_FILE_FOLDER),
    RB_TEXT_LINE("fclib", PLACE(fclib), "FILE",
                 "the contact problem with its approach and creepage as FCLib (HDF5), "
                 "for rollbem friction and others",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    RB_FLAG_LINE("trace", PLACE(trace),
                 "every pivot of Lemke's method, on standard error"),
    RB_FLAG_LINE(
        "all-solutions", PLACE(all_solutions),
        "steady, friction that depends on the slip or the temperature: solutions "
        "that differ, each with its residual, on standard error and as solutions "
        "in JSON"),

    RB_GROUP_LINE("output", "Steps of a transient or of a static history"),
    RB_TEXT_LINE("history-table", PLACE(history_table), "FILE",
                 "one row per step; standard output has the tractions of the last one",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    RB_TEXT_LINE("history-plot", PLACE(history_plot), "FILE",
                 "picture of creepage or shift, force and stick over the way: .png, "
                 ".svg or .pdf",
                 .unset = "none", .file = RB_FILE_PICTURE),
    RB_TEXT_LINE("snapshots", PLACE(steps.snapshots), "DIR",
                 "tractions on the way as step_000001.tsv (or .csv), ...",
                 .unset = "none", .file = RB_FILE_FOLDER),
    RB_INTEGER_LINE("every", PLACE(steps.every), RB_FROM(1),
                    "steps from one snapshot to the next; the last step has one too"),
    RB_FLAG_LINE("states", PLACE(states),
                 "with --json: tractions, slip displacement and zone of every element at "
                 "every step as history.states, which rollbem check asks for"),
    RB_FLAG_LINE("progress", PLACE(steps.progress),
                 "a line on standard error now and then; terminals get it anyway"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves one case of rolling contact, a cylinder A on a body B, by boundary\n"
    "elements and a linear complementarity problem, and prints the tractions element\n"
    "by element. Without options: the example of Addi, Adly, Goeleven, Thera (2006).\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "In static contact --shift, --force or --force-ratio loads it; --creep or\n"
    "--creep-ratio only enter the slip computed afterwards. In steady and transient\n"
    "rolling one of --creep, --creep-ratio, --force, --force-ratio drives it.\n"
    "\n"
    "A static case is one step from no contact to the last state. Bodies of different\n"
    "materials are not pressed so with friction: a point that comes into contact late\n"
    "has moved freely until then. --increments N presses gradually; --history takes\n"
    "any other sequence.\n"
    "\n"
    "Distances, of --distance and of a history, count in half-widths a: Hertz's of the\n"
    "load, the largest one of a history (under a given approach, of the load that the\n"
    "largest approach brings at rest). Its length stands above --history-table's rows.\n"
    "\n"
    "Exit codes: 0 solved; 1 not solved (what there is, is printed); 64 wrong values\n"
    "on the command line, 65 in a file; 66 no such file; 70 internal; 73 cannot write.\n";

typedef struct {
    const rb_case *words;
    const rb_settled_case *c;
    const solve_options *options;
    const cli_output *o;
    const rb_case_result *r;
    const rb_rolling_solutions *all; /* n = 0: not asked for */
    const rb_rolling_states *states; /* n = 0: likewise */
} result;

/* ---- Output ----------------------------------------------------------------------- */

static json_t *history_json(const result *it)
{
    json_t *history = rb_report_json_history(&it->r->history);
    if (it->states->n > 0)
        rb_report_json_set(&history, "states", rb_report_json_states(it->states));
    return history;
}

static rb_status write_json(FILE *out, const result *it)
{
    json_t *root =
        cli_case_json(it->words, &it->r->solution, rb_report_json_inputs(it->words));
    json_t *summary = rb_report_json_summary(&it->r->solution);
    if (it->r->has_errors)
        rb_report_json_set(&summary, "errors", rb_report_json_errors(&it->r->errors));
    rb_report_json_set(&root, "summary", summary);
    rb_report_json_set(&root, "table", rb_report_json_table(&it->r->solution));
    if (it->r->history.n > 0)
        rb_report_json_set(&root, "history", history_json(it));
    if (it->all->n > 0)
        rb_report_json_set(&root, "solutions", rb_report_json_solutions(it->all));
    return rb_report_json_write(out, root);
}

static rb_status write_table(FILE *out, const void *context, rb_message *why)
{
    const result *it = context;
    (void)why;
    if (it->o->style.format == RB_REPORT_JSON)
        return write_json(out, it);
    return it->o->brief
               ? rb_report_brief_table(out, &it->r->solution, cli_terminal_width())
               : rb_report_table(out, &it->c->rc, &it->r->solution, cli_command_line(),
                                 &it->o->style);
}

static rb_status write_history(FILE *out, const void *context, rb_message *why)
{
    const result *it = context;
    (void)why;
    return rb_report_history(out, &it->r->history, cli_command_line(), &it->o->style);
}

static rb_status draw(FILE *out, rb_report_canvas canvas, const void *context,
                      rb_message *why)
{
    const result *it = context;
    return rb_report_picture(out, canvas, &it->c->rc, &it->r->solution, why);
}

static rb_status draw_history(FILE *out, rb_report_canvas canvas, const void *context,
                              rb_message *why)
{
    const result *it = context;
    return rb_report_history_picture(out, canvas, &it->c->rc, &it->r->history, why);
}

static cli_exit show_behind(const solve_options *so, const rb_rolling_model *model)
{
    rb_message why = {""};
    cli_exit code = CLI_CONTINUE;
    if (so->fclib)
        code = cli_say_of("fclib", rb_report_fclib(so->fclib, model, &why), &why);
    if (so->dump && code == CLI_CONTINUE)
        code = cli_say_of("dump", rb_report_dump(so->dump, model, &why), &why);
    if (so->trace && code == CLI_CONTINUE)
        code = cli_say_of("trace", rb_report_trace(stderr, so->dump, model, &why), &why);
    return code == CLI_CONTINUE ? CLI_OK : code;
}

static void tell_people(const result *it)
{
    rb_report_notes(stderr, &it->c->rc, &it->r->solution);
    rb_report_summary(stderr, &it->r->solution, cli_terminal_width());
    if (it->r->has_errors)
        rb_report_errors(stderr, &it->r->solution, &it->r->errors);
    if (it->all->n > 0)
        rb_report_solutions(stderr, it->all);
    if (it->r->history.n > 0)
        rb_report_history_summary(stderr, &it->r->history);
}

static cli_exit print_result(const result *it)
{
    const solve_options *so = it->options;
    const cli_output *o = it->o;
    /* first what may yet refuse: then there is no table either */
    cli_exit code = show_behind(so, &it->r->model);
    if (code == CLI_OK && o->brief && !o->quiet)
        tell_people(it);
    if (code == CLI_OK)
        code = cli_write_file(o->output, write_table, it);
    if (code == CLI_OK && so->history_table && it->r->history.n > 0)
        code = cli_write_file(so->history_table, write_history, it);
    if (code == CLI_OK && !o->brief && !o->quiet)
        tell_people(it);
    if (code == CLI_OK && o->cite)
        rb_report_citations(stderr, &it->c->rc, &it->r->solution);
    if (code == CLI_OK)
        code = cli_draw_file(&o->pictures, "plot", o->plot, draw, it);
    if (code == CLI_OK && it->r->history.n > 0)
        code = cli_draw_file(&o->pictures, "history-plot", so->history_plot, draw_history,
                             it);
    return code;
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit solve(const solve_options *so, const cli_output *o, const rb_case *words)
{
    const rb_settled_case *c = rb_case_settled(words);
    rb_case_result r;
    rb_message why = {""};
    rb_rolling_solutions all = {0};
    rb_rolling_states states = {0};
    cli_steps steps = so->steps;
    steps.states = so->states ? &states : NULL;
    rb_status status = cli_run_case(c, &steps, &r, &why);
    const result it = {words, c, so, o, &r, &all, &states};
    if (status == RB_OK && so->all_solutions)
        status = rb_rolling_find_solutions(&r.model, &all, &why);
    rb_case_result_convert(&r, c->units);
    for (int k = 0; k < all.n; k++)
        rb_rolling_solution_convert(&all.solution[k], c->units);
    cli_exit code = CLI_OK;
    if (status >= 0 && r.solution.n > 0)
        code = print_result(&it);
    if (code == CLI_OK && status != RB_OK)
        code = cli_case_refused(words, status, &why);
    rb_rolling_states_free(&states);
    rb_rolling_solutions_free(&all);
    rb_case_result_free(&r);
    return code;
}

/* Options of steps mean nothing without any. */
static cli_exit check_steps(const int *given, const rb_settled_case *c)
{
    int steps = 0;
    for (int i = 0; i < OPTIONS && !rb_case_has_steps(c); i++) {
        steps |= strcmp(options[i].name, "history-table") == 0; /* the first of them */
        if (steps && given[i])
            return cli_fail(
                given[i] > 0 ? CLI_DATA : CLI_USAGE,
                "--%s: for --formulation transient, --history or --increments",
                options[i].name);
    }
    return CLI_CONTINUE;
}

/* With error bars of a solution there is no model to show (run.h). */
static cli_exit check_behind(const solve_options *so, const rb_settled_case *c)
{
    const int model_kept = rb_case_has_steps(c) || !(c->error || c->accuracy > 0.0);
    if ((so->dump || so->trace || so->fclib) && !model_kept)
        return cli_fail(CLI_USAGE,
                        "--dump, --fclib and --trace: not together with error bars");
    if (so->all_solutions &&
        (c->rc.formulation != RB_STEADY || !model_kept || !rb_rolling_law_moves(&c->rc)))
        return cli_fail(CLI_USAGE,
                        "--all-solutions: of steady rolling without error bars, with "
                        "friction that depends on the slip or the temperature");
    if (so->all_solutions && (so->dump || so->trace || so->fclib))
        return cli_fail(CLI_USAGE, "--all-solutions: not together with --dump, --fclib, "
                                   "--trace, which show one of them");
    if (so->all_solutions &&
        (!isnan(c->rc.force) || !isnan(c->rc.force_ratio) || c->rc.free_axle))
        return cli_fail(CLI_USAGE,
                        "--all-solutions: at a given creepage, not under a given force");
    if (so->trace && c->rc.solver != RB_SOLVER_AUTO && c->rc.solver != RB_SOLVER_LEMKE)
        return cli_fail(CLI_USAGE, "--trace: only --solver lemke pivots");
    return CLI_CONTINUE;
}

/* Where the states of the steps are printed, and in which units. */
static cli_exit check_states(const solve_options *so, const cli_output *o,
                             const rb_settled_case *c)
{
    if (so->states && (o->style.format != RB_REPORT_JSON || c->units != RB_UNITS_MM))
        return cli_fail(CLI_USAGE, "--states: with --json and in mm, N, MPa only");
    return CLI_CONTINUE;
}

/* Only Lemke's method has pivots to trace. */
static cli_exit choose_pivots(rb_case *c)
{
    rb_message why;
    if (rb_case_settled(c)->rc.solver != RB_SOLVER_AUTO)
        return CLI_CONTINUE;
    rb_status s = rb_case_set(c, "solver", "lemke", RB_GIVEN_ARGUMENT, &why);
    if (s == RB_OK)
        s = rb_case_settle(c, &why);
    return cli_say(s, &why);
}

int cli_solve(int argc, char **argv)
{
    cli_output o = {0};
    solve_options so = {.steps.every = 1};
    cli_args args = {0};
    int given[OPTIONS] = {0};
    rb_case *c = cli_case_create(RB_CASE_SINGLE);
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {"rollbem [OPTION...] [CASE.ini]",
                           about,
                           notes,
                           {rb_case_options(c),
                            cli_output_set(&o),
                            {options, OPTIONS, &so, given, NULL},
                            cli_example_set()},
                           4};
    cli_exit code = cli_case_parse(&spec, argc, argv, c, &args);
    if (code == CLI_CONTINUE)
        code = check_steps(given, rb_case_settled(c));
    if (code == CLI_CONTINUE)
        code = check_behind(&so, rb_case_settled(c));
    if (code == CLI_CONTINUE && so.trace)
        code = choose_pivots(c);
    so.steps.style = o.style;
    cli_output_settle(&o);
    if (code == CLI_CONTINUE)
        code = check_states(&so, &o, rb_case_settled(c));
    so.steps.terminal = !o.quiet && isatty(STDERR_FILENO);
    if (code == CLI_CONTINUE)
        code = solve(&so, &o, c);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
