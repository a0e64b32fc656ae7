/* rollbem [OPTION...] [CASE.ini]: solves one case and prints its results. */
#include "program/cli/case.h"
#include "program/cli/run.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    /* options */
    int trace, all_solutions, states, prove;
    const char *dump, *fclib, *history_table, *history_plot, *fretting_plot;
    const char *derivatives, *smooth, *tolerance;
    cli_steps steps;
    /* results */
    rb_case_result r;
    rb_rolling_solutions all; /* n = 0: not asked for */
    rb_rolling_states kept;   /* of every step; n = 0: likewise */
    rb_contact_proof proof;
    rb_report_derivatives shown;
    rb_case_derivatives slopes;
    rb_case_tolerances tolerances;
    rb_case_slopes slopes_of_steps; /* of every step */
} solved;

#define PLACE(member) offsetof(solved, member)

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Behind the solution"),
    RB_TEXT_LINE("dump", PLACE(dump), "DIR",
                 "mesh, H, G, F, M, b as Matrix Market files; with --trace also tableaux",
                 .unset = "none", .file = RB_FILE_FOLDER),
    RB_TEXT_LINE("fclib", PLACE(fclib), "FILE",
                 "the contact problem with its approach and creepage as FCLib (HDF5), "
                 "for rollbem friction and others",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    RB_FLAG_LINE("trace", PLACE(trace), "every pivot of Lemke's method, on standard error"),
    RB_FLAG_LINE("all-solutions", PLACE(all_solutions),
                 "steady, friction that depends on the slip or the temperature: solutions "
                 "that differ, each with its residual, on standard error and as solutions "
                 "in JSON"),
    RB_FLAG_LINE("prove", PLACE(prove),
                 "prove that the discrete problem has a solution with these zones, and bound the "
                 "distance of p and q from it; of a case with steps each step"),

    RB_TEXT_LINE("derivatives", PLACE(derivatives), "RESULT,...",
                 "derivatives of these results (without names: of all) with respect to "
                 "all numbers of the case: the table, or derivatives in JSON; p, q: of the "
                 "tractions; of a case with steps: of columns of its history, also RESULT:OPTION, "
                 "with respect to one number",
                 .unset = "none", .alone = "all"),
    RB_TEXT_LINE(
        "smooth-derivatives", PLACE(smooth), "RESULT,...",
        "as --derivatives, but without the jumps where an element changes between stick and "
        "slip: of second order on aligned and fitted elements; not for cases with steps",
        .unset = "none", .alone = "all"),
    RB_TEXT_LINE("tolerance", PLACE(tolerance), "NAME=X,...",
                 "standard deviations of inputs, as mu=0.02,radius=1%: prints those of all "
                 "results to first order to standard error, and as tolerances in JSON; of a case "
                 "with steps: of columns of its history, also in --history-table",
                 .unset = "none"),

    RB_GROUP_LINE("output", "Steps of a transient or of a static history"),
    RB_TEXT_LINE("history-table", PLACE(history_table), "FILE",
                 "one row per step; standard output has the tractions of the last one",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    CLI_PICTURE_LINE("history-plot", PLACE(history_plot),
                     "picture of creepage or shift, force and stick over the distance (.gif: the "
                     "tractions step by step)"),
    CLI_PICTURE_LINE("fretting-plot", PLACE(fretting_plot),
                     "with --fretting: picture of work, Ruiz's second parameter and SWT over x"),
    RB_TEXT_LINE("snapshots", PLACE(steps.snapshots), "DIR",
                 "tractions of steps as step_000001.tsv (or .csv), ...", .unset = "none",
                 .file = RB_FILE_FOLDER),
    RB_INTEGER_LINE("every", PLACE(steps.every), RB_FROM(1),
                    "number of steps between snapshots; the last step also has one"),
    RB_FLAG_LINE("states", PLACE(states),
                 "with --json: tractions, slip displacement and zone of every element at "
                 "every step as history.states, which rollbem check needs"),
    RB_FLAG_LINE("progress", PLACE(steps.progress),
                 "print progress even when standard error is not a terminal"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert((int)OPTIONS <= (int)CLI_COMMAND_OPTIONS_MAX, "given");

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
    "A static case is one step from no contact to the last state. For dissimilar bodies\n"
    "with friction one step is not the same as pressing gradually, because points that\n"
    "touch late have already moved: use --increments N. --history takes any other\n"
    "sequence, in which each row is computed in as many steps as its answer needs.\n"
    "\n"
    "The unit of distances, in --distance and in a history, is the half-width a of\n"
    "Hertz for the load; in a history for its largest load (under a given approach,\n"
    "for the static load at the largest approach). The head of --history-table\n"
    "prints its length.\n"
    "\n"
    "Exit codes: 0 solved; 1 not solved (the last iterate is printed); 64 wrong\n"
    "values on the command line, 65 in a file; 66 no such file; 70 internal; 73\n"
    "cannot write.\n";

/* ---- Output ----------------------------------------------------------------------- */

static void fill_in(const cli_case_run *run, rb_report_document *d)
{
    const solved *it = run->own;
    d->result = &it->r;
    d->states = it->states ? &it->kept : NULL;
    d->slopes = &it->slopes_of_steps;
    d->solutions = it->all.n > 0 ? &it->all : NULL;
    d->derivatives = it->derivatives && it->slopes_of_steps.n == 0 ? &it->shown : NULL;
    d->deviations = it->tolerance && it->r.history.n == 0 ? &it->shown : NULL;
    d->derivatives_of = it->derivatives;
    d->uncertain = it->tolerance ? &it->tolerances : NULL;
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    const solved *it = run->own;
    if (it->derivatives && it->slopes_of_steps.n > 0)
        return rb_report_step_slopes(out, &it->r.history, &it->slopes_of_steps, run->notes,
                                     cli_command_line(), &run->o.style);
    if (it->derivatives && !run->o.output && cli_reader_is_person())
        return rb_report_brief_derivatives(out, run->solution, &it->shown);
    if (it->derivatives)
        return rb_report_derivative_table(out, run->solution, &it->shown, run->notes,
                                          cli_command_line(), &run->o.style);
    return rb_report_table(out, &run->c->rc, run->solution, run->notes, cli_command_line(),
                           &run->o.style);
}

static rb_status write_history(FILE *out, const void *context, rb_message *why)
{
    const cli_case_run *run = context;
    const solved *it = run->own;
    (void)why;
    return rb_report_history(out, &it->r.history, run->notes, cli_command_line(), &run->o.style);
}

static rb_status draw_solve(FILE *out, rb_report_canvas canvas, const void *context,
                            rb_message *why)
{
    const cli_case_run *run = context;
    canvas.dimensionless = run->o.style.dimensionless;
    return rb_report_picture(out, canvas, &run->c->rc, run->solution, why);
}

static rb_status draw_history(FILE *out, rb_report_canvas canvas, const void *context,
                              rb_message *why)
{
    const cli_case_run *run = context;
    const solved *it = run->own;
    if (canvas.kind == RB_REPORT_GIF)
        return rb_report_frames(out, canvas, &run->c->rc, &it->r.history, &it->kept, why);
    return rb_report_history_picture(out, canvas, &run->c->rc, &it->r.history, why);
}

static rb_status draw_fretting(FILE *out, rb_report_canvas canvas, const void *context,
                               rb_message *why)
{
    const cli_case_run *run = context;
    return rb_report_fretting_picture(out, canvas, &run->c->rc, run->solution, why);
}

static const cli_case_file files[] = {{"history-table", .write = write_history},
                                      {"plot", .draw = draw_solve},
                                      {"history-plot", .draw = draw_history},
                                      {"fretting-plot", .draw = draw_fretting},
                                      {NULL, NULL, NULL}};

static cli_exit show_behind(const cli_case_run *run)
{
    solved *it = run->own;
    rb_rolling_model *model = &it->r.model;
    rb_message why = {.text = ""};
    cli_exit code = CLI_CONTINUE;
    if (it->fclib || it->dump || it->trace)
        code = cli_say_of("matrix", rb_rolling_model_add_matrix(model, &why), &why);
    if (it->fclib && code == CLI_CONTINUE)
        code = cli_say_of("fclib", rb_report_fclib(it->fclib, model, &why), &why);
    if (it->dump && code == CLI_CONTINUE)
        code = cli_say_of("dump", rb_report_dump(it->dump, model, &why), &why);
    if (it->trace && code == CLI_CONTINUE)
        code = cli_say_of("trace", rb_report_trace(stderr, it->dump, model, &why), &why);
    return code == CLI_CONTINUE ? CLI_OK : code;
}

static void summarise_solve(FILE *out, const cli_case_run *run)
{
    const solved *it = run->own;
    if (it->tolerance && it->r.history.n == 0)
        rb_report_tolerances(out, &it->r.solution, &it->shown);
    rb_report_summary(out, &it->r.solution, cli_terminal_width(STDERR_FILENO));
    if (it->r.has_errors)
        rb_report_errors(out, &it->r.solution, &it->r.errors,
                         isatty(STDERR_FILENO) ? cli_terminal_width(STDERR_FILENO) : 0);
    if (it->all.n > 0)
        rb_report_solutions(out, &it->all);
    if (it->r.history.n > 0)
        rb_report_history_summary(out, &run->c->rc, &it->r.history);
}

/* ---- Command ---------------------------------------------------------------------- */

/* What is not solved has none. */
static void drop_derivatives(solved *it)
{
    it->derivatives = it->tolerance = NULL;
    rb_case_slopes_free(&it->slopes_of_steps);
}

static int is_animated(const solved *it)
{
    rb_report_picture_kind kind;
    rb_message why;
    return it->history_plot && rb_report_picture_kind_of(it->history_plot, &kind, &why) == RB_OK &&
           kind == RB_REPORT_GIF;
}

static rb_status solve_case(cli_case_run *run, rb_message *why)
{
    solved *it = run->own;
    const rb_units units = run->c->units;
    it->steps.style = run->o.style;
    it->steps.terminal = !run->o.quiet && isatty(STDERR_FILENO);
    const int steps = rb_case_has_steps(run->c);
    it->steps.states =
        it->states || is_animated(it) || (steps && (it->derivatives || it->tolerance)) ? &it->kept
                                                                                       : NULL;
    it->steps.proof = it->prove ? &it->proof : NULL;
    it->steps.words = run->words;
    rb_status s = cli_run_case(run->c, &it->steps, &it->r, why);
    if (s == RB_OK && it->prove && !steps)
        s = rb_rolling_model_prove(&it->r.model, &it->proof, why);
    it->r.solution.proof = it->proof;
    if (s == RB_OK && it->all_solutions)
        s = rb_rolling_find_solutions(&it->r.model, &it->all, why);
    if (s == RB_OK && steps && (it->derivatives || it->tolerance)) {
        /* Of the columns of a history. */
        it->kept.program = run->c->program.n > 0 ? &run->c->program : NULL;
        it->kept.half_width = it->r.history.half_width;
        s = rb_case_slopes_of_steps(run->words, &it->kept,
                                    it->derivatives ? &it->slopes_of_steps : NULL,
                                    it->tolerance ? &it->tolerances : NULL, &it->r.history, why);
        if (s != RB_OK)
            drop_derivatives(it);
        rb_case_slopes_convert(&it->slopes_of_steps, run->c->units);
    } else if (s == RB_OK && (it->derivatives || it->tolerance)) {
        /* Of what is asked for, in the units that are shown. */
        if (it->derivatives)
            s = (it->smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(
                run->words, &it->r.model, 0, NULL, &it->slopes, why);
        if (s == RB_OK && it->tolerance)
            s = rb_case_deviations(run->words, &it->r.model, &it->tolerances, &it->shown.deviation,
                                   why);
        if (s != RB_OK) /* the case has its solution, and nothing beside it */
            drop_derivatives(it);
        rb_rolling_solution_convert(&it->shown.deviation, run->c->units);
        rb_case_derivatives_convert(&it->slopes, run->c->units);
        it->shown.all = &it->slopes;
    } else
        drop_derivatives(it);
    rb_case_result_convert(&it->r, units);
    for (int k = 0; k < it->all.n; k++)
        rb_rolling_solution_convert(&it->all.solution[k], units);
    if (it->r.history.n == 0) /* nothing to write, not even of the first step */
        it->history_table = it->history_plot = it->fretting_plot = NULL;
    run->solution = &it->r.solution;
    run->of_steps = it->r.of_steps;
    run->printable = s >= 0 && it->r.solution.n > 0;
    return s;
}

/* Only Lemke's method has pivots to trace. */
static cli_exit choose_pivots(rb_case *c)
{
    rb_message why = {.text = ""};
    if (rb_case_resolved(c)->rc.contact.solver != RB_SOLVER_AUTO)
        return CLI_CONTINUE;
    rb_status s = rb_case_set(c, "solver", "lemke", RB_GIVEN_ARGUMENT, &why);
    if (s == RB_OK)
        s = rb_case_resolve(c, &why);
    return cli_say(s, &why);
}

static cli_exit check_solve(cli_case_run *run)
{
    solved *it = run->own;
    const rb_resolved_case *c = run->c;
    const int has_steps = rb_case_has_steps(c);
    char name[300];
    rb_message why = {.text = ""};
    /* Options of steps mean nothing without any; the first of them is history-table. */
    for (int i = 0, of_steps = 0; i < OPTIONS && !has_steps; i++) {
        of_steps |= strcmp(options[i].name, "history-table") == 0;
        if (of_steps && run->set.given[i])
            return cli_fail(run->set.given[i] > 0 ? CLI_DATA : CLI_USAGE,
                            "%s: for --formulation transient, --history or --increments",
                            rb_option_source(&options[i], run->set.given[i],
                                             cli_case_file_of(&run->args), name, sizeof name));
    }
    if (it->fretting_plot && !c->rc.fretting)
        return cli_case_refuse(run->words, "fretting-plot", "needs --fretting");
    if (run->o.style.dimensionless && (it->derivatives || it->smooth || it->history_table ||
                                       it->history_plot || it->steps.snapshots))
        return cli_case_refuse(run->words, "dimensionless",
                               "of the tractions of the case, not together "
                               "with --%s",
                               it->derivatives     ? "derivatives"
                               : it->smooth        ? "smooth-derivatives"
                               : it->history_table ? "history-table"
                               : it->history_plot  ? "history-plot"
                                                   : "snapshots");
    /* With error bars of a solution there is no model to show (run.h). */
    const int model_kept = has_steps || !(c->error || c->accuracy > 0.0);
    if ((it->dump || it->trace || it->fclib) && !model_kept)
        return cli_case_refuse(run->words, "dump,fclib,trace", "not together with error bars");
    if (it->all_solutions &&
        (c->rc.formulation != RB_STEADY || !model_kept || !rb_rolling_law_depends_on_state(&c->rc)))
        return cli_case_refuse(run->words, "all-solutions",
                               "only for steady rolling without error bars, "
                               "with friction that depends on the slip or the temperature");
    if (it->all_solutions && (it->dump || it->trace || it->fclib))
        return cli_case_refuse(run->words, "all-solutions",
                               "not together with --dump, --fclib, "
                               "--trace, which show one of them");
    if (it->all_solutions && (!isnan(c->rc.force) || !isnan(c->rc.force_ratio) || c->rc.free_axle))
        return cli_case_refuse(run->words, "all-solutions",
                               "at a given creepage, not under a given force");
    if (it->prove && !model_kept)
        return cli_case_refuse(run->words, "prove", "not together with error bars");
    if (it->smooth && (it->derivatives || it->tolerance))
        return cli_case_refuse(run->words, "smooth-derivatives", "not together with --%s",
                               it->derivatives ? "derivatives" : "tolerance");
    if (it->smooth && (has_steps || !model_kept))
        return cli_case_refuse(run->words, "smooth-derivatives", "not %s",
                               has_steps ? "for a case with steps" : "together with error bars");
    if (it->smooth)
        it->derivatives = it->smooth;
    if ((it->derivatives || it->tolerance) && !model_kept)
        return cli_case_refuse(run->words, "derivatives,tolerance", "not together with error bars");
    if ((it->derivatives || it->tolerance) && has_steps && c->error)
        return cli_case_refuse(run->words, "derivatives,tolerance", "not together with error bars");
    if (it->trace && c->rc.contact.solver != RB_SOLVER_AUTO &&
        c->rc.contact.solver != RB_SOLVER_LEMKE)
        return cli_case_refuse(run->words, "trace", "only --solver lemke pivots");
    const cli_exit code = it->trace ? choose_pivots(run->words) : CLI_CONTINUE;
    if (code != CLI_CONTINUE)
        return code;
    /* Names of results and of numbers. */
    rb_status s = RB_OK;
    if (it->derivatives && has_steps)
        s = rb_case_slopes_choose(run->words, &rb_rolling_history_columns, it->derivatives,
                                  RB_CASE_SLOPES_MAX, &it->slopes_of_steps, &why);
    else if (it->derivatives &&
             (s = rb_report_derivatives_of(it->derivatives, c, &it->shown, &why)) != RB_OK)
        s = rb_case_name_option(it->smooth ? "smooth-derivatives" : "derivatives", s, &why);
    if (s == RB_OK && it->tolerance)
        s = rb_case_read_tolerances(run->words, it->tolerance, &it->tolerances, &why);
    if (s == RB_OK && (it->derivatives || it->tolerance) && has_steps)
        s = rb_case_slopes_check_steps(run->words, &why);
    if (s != RB_OK)
        return cli_case_refused(run->words, s, &why);
    /* Where the states of the steps are printed, and in which units. */
    if (it->states && (run->o.style.format != RB_REPORT_JSON || c->units != RB_UNITS_MM))
        return cli_case_refuse(run->words, "states", "with --json and in mm, N, MPa only");
    return CLI_CONTINUE;
}

static void ask_solve(const cli_case_run *run, json_t **members)
{
    static const char *const slopes[] = {"derivatives_of", "own_of_b", "uncertain_inputs"};
    const solved *it = run->own;
    const char *names = it->smooth ? it->smooth : it->derivatives;
    rb_case_tolerances t = {.n = 0};
    rb_message why;

    rb_report_json_set(members, "maxima", json_false());
    rb_report_json_set(members, "crack", json_false());
    rb_report_json_set(members, "solutions", json_boolean(it->all_solutions));
    rb_report_json_set(members, "summary", json_pack("{s:b}", "proof", it->prove));
    if (rb_case_has_steps(rb_case_resolved(run->words))) {
        json_t *history = json_object();
        rb_report_json_set(&history, "derivatives", json_boolean(it->derivatives != NULL));
        rb_report_json_set(&history, "states", json_boolean(it->states));
        rb_report_json_set(members, "history", history);
    } else
        rb_report_json_set(members, "derivatives", json_boolean(it->derivatives != NULL));
    rb_report_json_set(members, "smooth_derivatives", json_boolean(it->smooth != NULL));
    if (names || it->tolerance)
        rb_report_json_asked(members, names, run->words);
    if (it->tolerance && rb_case_read_tolerances(run->words, it->tolerance, &t, &why) == RB_OK)
        rb_report_json_uncertain(members, &t, RB_UNITS_MM);
    for (size_t k = 0; k < sizeof slopes / sizeof *slopes; k++)
        if (*members && !json_object_get(*members, slopes[k]))
            rb_report_json_set(members, slopes[k], json_false());
}

static const cli_case_need needs[] = {{"every", "snapshots"}, {NULL, NULL}};

static const cli_case_command command = {
    .synopsis = "rollbem [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_SINGLE,
    .options = options,
    .option_n = OPTIONS,
    .options_last = 1,
    .files = files,
    .needs = needs,
    .has_scales = 1,
    .check = check_solve,
    .solve = solve_case,
    .before_table = show_behind,
    .table = write_table,
    .document = fill_in,
    .asked = ask_solve,
    .summarise = summarise_solve,
};

cli_exit cli_solve_asks(int argc, char **argv, rb_case *words, int *case_files, json_t **asked)
{
    solved it = {.steps.every = 1};
    const cli_exit code = cli_case_asks(&command, &it, argc, argv, words, case_files, asked);
    return code == CLI_CONTINUE && it.trace ? choose_pivots(words) : code;
}

int cli_solve(int argc, char **argv)
{
    solved it = {.steps.every = 1};
    const cli_exit code = cli_case_run_command(&command, &it, argc, argv);
    rb_rolling_states_free(&it.kept);
    rb_rolling_solutions_free(&it.all);
    rb_case_derivatives_free(&it.slopes);
    rb_case_slopes_free(&it.slopes_of_steps);
    rb_case_result_free(&it.r);
    return code;
}
