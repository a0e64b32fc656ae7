/* rollbem wear: what sliding, fretting or rolling takes off. */
#include "cli/case.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "rollbem/io.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int law, steps, increments, every;
    double coefficient, slide, cycles;
    const char *snapshots, *profile;
    int given[10], plain[10];
} wear_options;

#define PLACE(member) offsetof(wear_options, member)

static const rb_choice laws[] = {
    {"archard", RB_WEAR_ARCHARD}, {"dissipation", RB_WEAR_DISSIPATION}, {NULL, 0}};

static const rb_option options[] = {
    RB_GROUP_LINE("wear", "Wear"),
    RB_CHOICE_LINE("wear-law", PLACE(law), laws,
                   "depth = K p s (Archard), or K times the work of friction per area"),
    RB_NUMBER_LINE("wear-coefficient", PLACE(coefficient), "1/MPa", RB_ABOVE(0),
                   "K: worn volume per load and way, or per work, mm3/(N mm)",
                   .unset = "none: it must be given"),
    RB_NUMBER_LINE("slide", PLACE(slide), "mm", RB_ABOVE(0),
                   "static: A slides over B, towards +x, by this in all",
                   .unset = "A frets, or rolls"),
    RB_NUMBER_LINE("cycles", PLACE(cycles), "-", RB_ABOVE(0),
                   "static: fretting cycles between the shift or force and its opposite; "
                   "steady: turns of the wheel"),
    RB_INTEGER_LINE("wear-steps", PLACE(steps), RB_FROM_TO(1, 1000000),
                    "parts of the way or of the cycles; each is implicit, and stable "
                    "however long it is"),
    RB_INTEGER_LINE("quarter", PLACE(increments), RB_FROM_TO(1, 100000),
                    "increments of a quarter of a fretting cycle"),
    RB_TEXT_LINE("snapshots", PLACE(snapshots), "DIR",
                 "tractions and worn depth as step_000000.tsv, ...", .unset = "none",
                 .file = RB_FILE_FOLDER),
    RB_INTEGER_LINE("every", PLACE(every), RB_FROM(1),
                    "steps from one snapshot to the next; the last step has one too"),
    RB_TEXT_LINE("profile", PLACE(profile), "FILE",
                 "what is worn off at the end, rows x, depth: for --worn, also of "
                 "a run that goes on from there",
                 .unset = "none", .file = RB_FILE_WRITTEN),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 10, "given");

static const char about[] =
    "Wears body A: sliding over B (--slide), fretting between --shift or --force and "
    "its\n"
    "opposite (--cycles), or rolling steadily (--formulation steady, --cycles turns),\n"
    "where a round wheel stays round and its radius shrinks. Prints a row per step:\n"
    "way, worn volume, depth, contact. The gap is updated implicitly: the pressure at "
    "the\n"
    "end of a step is the one that wears it.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Example: rollbem wear --similar --support halfplane --gap parabola --load 200 \\\n"
    "           --slide 1e6 --wear-coefficient 1e-10 --plot worn.png\n";

/* ---- Run -------------------------------------------------------------------------- */

typedef struct {
    const rb_case *words;
    const wear_options *options;
    const cli_output *o;
    rb_report_wear report;
    rb_rolling_wear_history history;
    rb_rolling_solution last;
    const rb_rolling_solution *shown; /* of the snapshot at hand */
    rb_status failed;                 /* of a snapshot */
    rb_message why;
} result;

static rb_status write_snapshot(FILE *out, const void *context, rb_message *why)
{
    const result *r = context;
    (void)why;
    return rb_report_table(out, NULL, r->shown, cli_command_line(), &r->o->style);
}

static rb_status save_snapshot(result *r, const rb_rolling_solution *s, int step)
{
    char name[40];
    snprintf(name, sizeof name, "step_%06d.%s", step,
             r->o->style.format == RB_REPORT_CSV ? "csv" : "tsv");
    char *path = rb_io_join(r->options->snapshots, name);
    r->shown = s;
    const rb_status status = path ? cli_write_to(path, write_snapshot, r, &r->why)
                                  : rb_fail(&r->why, RB_ENOMEM, "out of memory");
    free(path);
    return status;
}

static int after_step(rb_rolling_solution *s, const rb_rolling_wear_history *h, int step,
                      int steps, void *context)
{
    result *r = context;
    rb_rolling_solution_convert(s, rb_case_units(r->words));
    const int due = step % r->options->every == 0 || step == steps;
    if (r->options->snapshots && due)
        r->failed = save_snapshot(r, s, step);
    if (r->failed == RB_OK)
        r->failed = rb_report_wear_keep(&r->report, s, h, step, steps);
    return cli_interrupted() || r->failed != RB_OK;
}

static rb_status run(result *r, const rb_settled_case *c, rb_message *why)
{
    const wear_options *w = r->options;
    const rb_rolling_wear wear = {.law = w->law,
                                  .coefficient = w->coefficient,
                                  .slides = !isnan(w->slide),
                                  .way = isnan(w->slide) ? w->cycles : w->slide,
                                  .steps = w->steps,
                                  .increments = w->increments};
    r->report.history = &r->history;
    rb_status s = w->snapshots ? rb_io_make_folder(w->snapshots, why) : RB_OK;
    if (s != RB_OK)
        return s;
    cli_interrupts_catch();
    s = rb_rolling_wear_run(&c->rc, &wear, &(rb_rolling_wear_observer){after_step, r},
                            &r->history, &r->last, why);
    cli_interrupts_leave();
    rb_rolling_wear_history_convert(&r->history, rb_case_units(r->words));
    if (r->failed == RB_OK)
        return s;
    *why = r->why;
    return r->failed;
}

/* ---- Print ------------------------------------------------------------------------ */

static rb_status print_json(FILE *out, const result *r)
{
    const wear_options *w = r->options;
    const rb_units units = rb_case_units(r->words);
    json_t *inputs = rb_report_json_inputs(r->words);
    rb_report_json_set(&inputs, "wear-law", json_string(laws[w->law].name));
    rb_report_json_set(&inputs, "wear-coefficient",
                       json_real(rb_unit_shown(units, "1/MPa", w->coefficient)));
    rb_report_json_set(&inputs, "slide",
                       rb_report_json_number(rb_unit_shown(units, "mm", w->slide)));
    rb_report_json_set(&inputs, "cycles", rb_report_json_number(w->cycles));
    rb_report_json_set(&inputs, "wear-steps", json_integer(w->steps));
    rb_report_json_set(&inputs, "quarter", json_integer(w->increments));
    json_t *root = cli_case_json(r->words, &r->last, inputs);
    rb_report_json_set(&root, "wear", rb_report_json_wear(&r->report));
    rb_report_json_set(&root, "summary", rb_report_json_summary(&r->last));
    rb_report_json_set(&root, "table", rb_report_json_table(&r->last));
    return rb_report_json_write(out, root);
}

static rb_status print(FILE *out, const void *context, rb_message *why)
{
    const result *r = context;
    (void)why;
    return r->o->style.format == RB_REPORT_JSON
               ? print_json(out, r)
               : rb_report_wear_table(out, &r->report, cli_command_line(), &r->o->style);
}

static rb_status print_profile(FILE *out, const void *context, rb_message *why)
{
    const rb_rolling_solution *s = &((const result *)context)->last;
    (void)why;
    const char *mm = rb_unit_name(s->units, "mm");
    fprintf(out, "x_%s\tdepth_%s\n# %s\n", mm, mm, cli_command_line());
    for (int i = 0; i < s->n; i++)
        fprintf(out, "%.17g\t%.17g\n", s->x[i], s->worn[i]);
    return rb_report_flush(out);
}

static rb_status draw(FILE *out, rb_report_canvas canvas, const void *context,
                      rb_message *why)
{
    const result *r = context;
    return rb_report_wear_picture(out, canvas, &r->report, why);
}

static cli_exit show(const result *r)
{
    cli_exit code = cli_write_file(r->o->output, print, r);
    if (code == CLI_OK && r->options->profile)
        code = cli_write_file(r->options->profile, print_profile, r);
    const rb_rolling_case *rc = &rb_case_settled(r->words)->rc;
    if (code == CLI_OK && !r->o->quiet) {
        rb_report_notes(stderr, rc, &r->last);
        rb_report_wear_summary(stderr, &r->report);
    }
    if (code == CLI_OK && r->o->cite)
        rb_report_citations(stderr, rc, &r->last);
    if (code == CLI_OK)
        code = cli_draw_file(&r->o->pictures, "plot", r->o->plot, draw, r);
    return code;
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit check(const wear_options *w, const rb_settled_case *c)
{
    const int rolls = c->rc.formulation == RB_STEADY;
    if (isnan(w->coefficient))
        return cli_fail(CLI_USAGE, "wear needs --wear-coefficient");
    if (!isnan(w->slide) && !isnan(w->cycles))
        return cli_fail(CLI_USAGE, "--slide and --cycles exclude each other");
    if (isnan(w->slide) && isnan(w->cycles))
        return cli_fail(CLI_USAGE, "wear needs --slide or --cycles");
    if (rolls && w->profile)
        return cli_fail(CLI_USAGE,
                        "--profile: a wheel that rolls stays round; see the radius");
    return CLI_CONTINUE;
}

static cli_exit solve(const rb_case *words, const wear_options *w, const cli_output *o)
{
    result r = {.words = words, .options = w, .o = o};
    rb_message why = {""};
    cli_exit code = CLI_OK;
    const rb_status s = run(&r, rb_case_settled(words), &why);
    if (s >= 0 && r.history.n > 0)
        code = show(&r);
    if (code == CLI_OK && s != RB_OK)
        code = cli_case_refused(words, s, &why);
    rb_report_wear_free(&r.report);
    rb_rolling_wear_history_free(&r.history);
    rb_rolling_solution_free(&r.last);
    return code;
}

int cli_wear(int argc, char **argv)
{
    cli_output o = {0};
    wear_options w = {.coefficient = NAN,
                      .slide = NAN,
                      .cycles = NAN,
                      .steps = 20,
                      .increments = 8,
                      .every = 1};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_WEAR);
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {"rollbem wear [OPTION...] [CASE.ini]",
                           about,
                           notes,
                           {rb_case_options(c),
                            {options, OPTIONS, &w, w.given, w.plain},
                            cli_output_set(&o),
                            cli_example_set()},
                           4};
    cli_exit code = cli_case_parse(&spec, argc, argv, c, &args);
    if (code == CLI_CONTINUE) {
        rb_option_store(&spec.sets[1], rb_case_settled(c)->units, rb_case_file_units(c),
                        &w);
        code = check(&w, rb_case_settled(c));
    }
    if (code == CLI_CONTINUE)
        code = solve(c, &w, &o);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
