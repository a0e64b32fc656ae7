/* rollbem wear: wear by sliding, fretting or rolling. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"
#include "program/cli/run.h"
#include "base/io/io.h"

#include <jansson.h>
#include <stddef.h>

typedef struct {
    /* options */
    int law, steps, increments, every;
    double coefficient, share, slide, cycles;
    const char *snapshots, *profile;
    /* results */
    rb_report_wear report;
    rb_rolling_wear_history history;
    rb_rolling_solution last;
    rb_rolling_study_notes notes; /* on the rows before the last one */
    rb_status failed;             /* of a snapshot or a note */
    rb_message why;
} wear;

#define PLACE(member) offsetof(wear, member)

static const rb_choice laws[] = {
    {"archard", RB_WEAR_ARCHARD}, {"dissipation", RB_WEAR_DISSIPATION}, {NULL, 0}};

static const rb_option options[] = {
    RB_GROUP_LINE("wear", "Wear"),
    RB_CHOICE_LINE("wear-law", PLACE(law), laws,
                   "depth = K p s (Archard), or K times the work of friction per area"),
    RB_WEAR_LINES(PLACE, slide, cycles),
    RB_TEXT_LINE("snapshots", PLACE(snapshots), "DIR",
                 "tractions and worn depth as step_000000.tsv, ...", .unset = "none",
                 .file = RB_FILE_FOLDER),
    RB_INTEGER_LINE("every", PLACE(every), RB_FROM(1),
                    "number of steps between snapshots; the last step also has one"),
    RB_TEXT_LINE("profile", PLACE(profile), "FILE",
                 "file for the worn depth at the end, rows x, depth; --worn reads it, "
                 "also to continue the run",
                 .unset = "none", .file = RB_FILE_WRITTEN),
};

enum { OPTIONS = sizeof options / sizeof options[0], INPUTS = 8 /* what comes before the files */ };

_Static_assert((int)OPTIONS <= (int)CLI_COMMAND_OPTIONS_MAX, "given");

static const char about[] =
    "Computes the wear of body A, and of B according to --wear-share: sliding over B\n"
    "(--slide), fretting between --shift or --force and its opposite (--cycles), or\n"
    "steady rolling (--formulation steady, --cycles turns), in which round bodies\n"
    "stay round and their radii change. Prints one row per step: distance or cycles,\n"
    "worn volume, depth, contact. The gap is updated implicitly: the wear of a step\n"
    "is computed from the pressure at its end.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Example: rollbem wear --similar --support halfplane --gap parabola --load 200 \\\n"
    "           --slide 1e6 --wear-coefficient 1e-10 --plot worn.png\n";

/* ---- Run -------------------------------------------------------------------------- */

static int after_step(rb_rolling_solution *s, const rb_rolling_wear_history *h, int step, int steps,
                      void *context)
{
    const cli_case_run *run = context;
    wear *w = run->own;
    rb_rolling_solution_convert(s, run->c->units);
    w->failed = rb_rolling_add_step_notes(&w->notes, &run->c->rc, s, step, steps + 1);
    if (w->failed != RB_OK)
        rb_fail(&w->why, w->failed, "out of memory for notes");
    if (w->failed == RB_OK && w->snapshots && (step % w->every == 0 || step == steps)) {
        const rb_rolling_note_list found = rb_case_find_notes(run->words, s, NULL);
        w->failed = cli_write_snapshot(w->snapshots, step, NULL, s, &found, &run->o.style, &w->why);
    }
    if (w->failed == RB_OK)
        w->failed = rb_report_wear_keep(&w->report, s, h, step, steps);
    return cli_interrupted() || w->failed != RB_OK;
}

static rb_status solve_wear(cli_case_run *run, rb_message *why)
{
    wear *w = run->own;
    const rb_rolling_wear how = {.law = w->law,
                                 .coefficient = w->coefficient,
                                 .share = w->share,
                                 .slides = !isnan(w->slide),
                                 .way = isnan(w->slide) ? w->cycles : w->slide,
                                 .steps = w->steps,
                                 .increments = w->increments};
    w->report.history = &w->history;
    rb_status s = w->snapshots ? rb_io_make_folder(w->snapshots, why) : RB_OK;
    if (s != RB_OK)
        return s;
    cli_interrupts_catch();
    s = (run->c->error ? rb_rolling_wear_with_errors : rb_rolling_wear_run)(
        &run->c->rc, &how, &(rb_rolling_wear_observer){after_step, run}, &w->history, &w->last,
        why);
    cli_interrupts_leave();
    rb_rolling_wear_history_convert(&w->history, run->c->units);
    if (w->failed != RB_OK) {
        *why = w->why;
        s = w->failed;
    }
    run->solution = &w->last;
    run->of_steps = &w->notes;
    run->printable = s >= 0 && w->history.n > 0;
    return s;
}

/* ---- Print ------------------------------------------------------------------------ */

static void add_inputs(const cli_case_run *run, json_t **inputs)
{
    rb_report_json_options(inputs, INPUTS, options, run->own, run->c->units);
}

static void add_json(const cli_case_run *run, json_t **root)
{
    const wear *w = run->own;
    rb_report_json_set(root, "wear", rb_report_json_wear(&w->report));
    rb_report_json_set(root, "summary", rb_report_json_summary(&w->last));
    rb_report_json_set(root, "table", rb_report_json_table(&w->last));
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    const wear *w = run->own;
    return rb_report_wear_table(out, &w->report, run->notes, cli_command_line(), &run->o.style);
}

static rb_status write_profile(FILE *out, const void *context, rb_message *why)
{
    const rb_rolling_solution *s = ((const cli_case_run *)context)->solution;
    char x[RB_NUMBER_TEXT], worn[RB_NUMBER_TEXT];
    (void)why;
    const char *mm = rb_unit_name(s->units, "mm");
    fprintf(out, "x_%s\tdepth_%s\n# %s\n", mm, mm, cli_command_line());
    for (int i = 0; i < s->n; i++)
        fprintf(out, "%s\t%s\n", rb_number_text(s->x[i], x), rb_number_text(s->worn[i], worn));
    return rb_report_flush(out);
}

static rb_status draw_wear(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const wear *w = ((const cli_case_run *)context)->own;
    return rb_report_wear_picture(out, canvas, &w->report, why);
}

static const cli_case_file files[] = {
    {"profile", .write = write_profile}, {"plot", .draw = draw_wear}, {NULL, NULL, NULL}};

static void summarise_wear(FILE *out, const cli_case_run *run)
{
    rb_report_wear_summary(out, &((const wear *)run->own)->report);
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit check_wear(cli_case_run *run)
{
    const wear *w = run->own;
    if (isnan(w->coefficient))
        return cli_fail(CLI_USAGE, "wear needs --wear-coefficient");
    if (!isnan(w->slide) && !isnan(w->cycles))
        return cli_case_refuse(run->words, "cycles,slide", "not together with --slide");
    if (isnan(w->slide) && isnan(w->cycles))
        return cli_fail(CLI_USAGE, "wear needs --slide or --cycles");
    if (run->c->rc.formulation == RB_STEADY && rb_option_given(&run->set, "quarter"))
        return cli_case_refuse(run->words, "quarter", "of fretting; a wheel that rolls has none");
    if (run->c->rc.formulation == RB_STEADY && w->profile)
        return cli_case_refuse(run->words, "profile",
                               "a wheel that rolls stays round; see the radius");
    return CLI_CONTINUE;
}

static const cli_case_need needs[] = {{"every", "snapshots"}, {"quarter", "cycles"}, {NULL, NULL}};

static const cli_case_command command = {
    .synopsis = "rollbem wear [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_WEAR,
    .options = options,
    .option_n = OPTIONS,
    .files = files,
    .needs = needs,
    .check = check_wear,
    .solve = solve_wear,
    .table = write_table,
    .inputs = add_inputs,
    .json = add_json,
    .summarise = summarise_wear,
};

int cli_wear(int argc, char **argv)
{
    wear w = {
        .coefficient = NAN, .slide = NAN, .cycles = NAN, .steps = 20, .increments = 8, .every = 1};
    const cli_exit code = cli_case_run_command(&command, &w, argc, argv);
    rb_report_wear_free(&w.report);
    rb_rolling_wear_history_free(&w.history);
    rb_rolling_solution_free(&w.last);
    return code;
}
