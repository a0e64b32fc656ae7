/* rollbem sweep: parameter studies over all processors. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"
#include "program/cli/pool.h"
#include "program/cli/study.h"
#include "program/report/report.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PLACE(member) offsetof(study_options, member)
/* The range is that of the count of first:last:count. */
#define VARY_LINE(name, place, help)                                                               \
    RB_TEXT_LINE(name, place, "SPEC", help, .unset = "none", .range = RB_FROM_TO(2, 1e7))

static const rb_option options[] = {
    RB_GROUP_LINE("sweep", "Study"),
    VARY_LINE("vary-1", PLACE(vary[0]),
              "an option and its values: 'mu 0.1 0.2 0.3', 'creep-ratio 0:1.5:31' (first, last, "
              "how many), 'load 1:1e4:9:log', 'support halfplane arc'"),
    VARY_LINE("vary-2", PLACE(vary[1]), "a second one: every combination is a case"),
    VARY_LINE("vary-3", PLACE(vary[2]), "a third one"),
    VARY_LINE("vary-4", PLACE(vary[3]), "a fourth one"),
    RB_TEXT_LINE("cases", PLACE(cases), "FILE",
                 "a case per row; the columns are named like the options, as 'load' or 'load "
                 "[kN/m]'; columns of other words are labels",
                 .unset = "none", .file = RB_FILE_READ),
    RB_INTEGER_LINE("sample", PLACE(sample), RB_FROM_TO(0, 1000000),
                    "number of random cases whose inputs scatter by --tolerance (a Latin hypercube "
                    "of normal distributions); prints mean and standard deviation of each result "
                    "to standard error; a sample with invalid inputs counts as not solved"),
    RB_TEXT_LINE(
        "tolerance", PLACE(tolerance), "NAME=X,...",
        "standard deviations of inputs, as mu=0.02,radius=1%: of those of --sample; without "
        "--sample a column deviation_... with that of each result in every case, to first "
        "order",
        .unset = "none"),
    RB_INTEGER_LINE("seed", PLACE(seed), RB_FROM_TO(0, 1000000000),
                    "of the sample: the same seed gives the same cases"),
    RB_TEXT_LINE(
        "results", PLACE(results), "A,B,...",
        "further results, by their names in JSON's `summary` or `maxima`: stick_length, "
        "contact_from, max_shear, von_mises, max_shear_y, ...; those of cracks, and of --history "
        "with --fretting, come by themselves",
        .unset = "none"),
    RB_TEXT_LINE("derivatives", PLACE(derivatives), "RESULT,...",
                 "columns with the derivatives of these results in every case, with respect to all "
                 "numbers, or RESULT:OPTION to one",
                 .unset = "none", .alone = "all"),
    CLI_PICTURE_LINE("plot", PLACE(plot), "picture of a result over an option that varies"),
    RB_TEXT_LINE("map", PLACE(map), "FILE",
                 "picture of a result over two options; every pair of their values must be a case",
                 .unset = "none", .file = RB_FILE_PICTURE),
    RB_TEXT_LINE("show", PLACE(show), "RESULT", "the result of the pictures, by its name",
                 .unset = "force_ratio; of cracks delta_K_II"),
    RB_TEXT_LINE("over", PLACE(over), "OPTION", "the option along x of the pictures",
                 .unset = "the one that varies fastest"),
    RB_TEXT_LINE("family", PLACE(family), "OPTION",
                 "--plot: a curve for each value of this one; --map: y",
                 .unset = "another one that varies"),
    CLI_PICTURE_LINES(PLACE(pictures)),
    CLI_STYLE_LINES(PLACE(style)),
    RB_TEXT_LINE("output", PLACE(output), "FILE",
                 "file for the rows, written as they are computed; if it already has the first "
                 "rows of this study, the study continues from there (a table with tabs; other "
                 "formats are written completely at the end)",
                 .unset = "standard output", .file = RB_FILE_WRITTEN),
    RB_FLAG_LINE("restart", PLACE(restart), "start again and overwrite the output file"),
    RB_INTEGER_LINE("jobs", PLACE(jobs), RB_FROM_TO(0, 256),
                    "processes; 0: as many as there are processors"),
    RB_FLAG_LINE("progress", PLACE(progress),
                 "print the time left even when standard error is not a terminal"),
    RB_FLAG_LINE("quiet", PLACE(quiet), "no summary on standard error"),
    RB_FLAG_LINE("cite", PLACE(cite), "print references to the methods used to standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 32, "given");

static const char about[] =
    "Solves many cases that differ in some options, one process per processor, and\n"
    "prints a row per case, in order. STUDY.ini is a case file with a section [sweep].\n"
    "The cases are all combinations of the values of vary-1 ... vary-4 and of the\n"
    "rows of --cases; the last one varies fastest. Under mpirun its processes share\n"
    "the work, each with a part of the processors of its machine. If an option of a\n"
    "crack is given or varies, the contact of each case moves over the crack as in\n"
    "`rollbem crack`, and the results are those of the crack.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES
    "Columns: case, the varied options, status (0 solved), then results and, with --error,\n"
    "their error bars.\n"
    "Example: rollbem sweep --similar --support halfplane --formulation steady \\\n"
    "           --load 500 --vary-1 'mu 0.1 0.3' --vary-2 'creep-ratio 0:1.5:31'\n"
    "         rollbem sweep examples/rail/case.ini --vary-1 'load 2000:20000:10' \\\n"
    "           --vary-2 'creep 0:0.008:21' --map force.png\n"
    "         rollbem sweep --similar --support halfplane --half-width 1 --mu 0 \\\n"
    "           --vary-1 'crack-length 0.5:2:7' --vary-2 'crack-angle 20:70:11' \\\n"
    "           --map K.png --show K_II_max\n";

/* ---- Cases ------------------------------------------------------------------------- */

/* Of every input and of the columns: tells whether a file holds rows of this study. */
static cli_exit find_fingerprint(study *st)
{
    rb_message why = {.text = ""};
    uint64_t hash;
    const rb_status s = rb_report_input_hash(st->base, &hash, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    hash = rb_hash(hash, RB_VERSION, sizeof RB_VERSION);
    if (st->slopes.tolerance)
        hash = rb_hash(hash, st->slopes.tolerance, strlen(st->slopes.tolerance));
    for (int k = 0; k < st->columns; k++) {
        const study_column *c = &st->column[k];
        hash = rb_hash(hash, c->name, strlen(c->name));
        hash = rb_hash(hash, c->value, (size_t)st->rows[c->factor] * sizeof(double));
        for (int i = 0; c->word && i < st->rows[c->factor]; i++)
            hash = c->word[i] ? rb_hash(hash, c->word[i], strlen(c->word[i]) + 1) : hash;
    }
    st->fingerprint = hash;
    return CLI_CONTINUE;
}

static int see_row(int k, const rb_rolling_row *row, void *context)
{
    study *st = context;
    rb_rolling_row shown = *row;

    rb_rolling_row_convert(&shown, rb_case_resolved(st->base)->units);
    rb_case_note_materials_of_row(st->base, &shown.notes); /* which are given is one for all */
    cli_study_write_notes(st, k, &shown.notes);
    cli_study_write_row(st, k, &shown);
    /* Means and deviations of a sample: of what has come in this run. */
    if (st->o->sample != 0 && shown.solution.status == RB_OK) {
        for (int j = 0; j < st->results; j++) {
            const double x = cli_study_result_value(st, j, &shown);
            if (st->summed == 0)
                st->first_result[j] = x;
            st->sum[j] += x - st->first_result[j];
            st->square[j] += (x - st->first_result[j]) * (x - st->first_result[j]);
        }
        st->summed++;
    }
    cli_study_count(st, k, row->solution.status);
    return ferror(st->out);
}

static rb_status make_case(int k, rb_rolling_case *rc, void *context)
{
    study *st = context;
    rb_message why = {.text = ""};
    const rb_status s = cli_study_try_one(st, k, &why);
    if (s == RB_OK)
        *rc = rb_case_resolved(st->one)->rc;
    return s;
}

static const rb_rolling_program *program_of_case(void *context)
{
    const study *st = context;
    const rb_resolved_case *one = rb_case_resolved(st->one);
    return one->program.n > 0 ? &one->program : NULL;
}

/* A case without derivatives has its results. */
static rb_status measure_slopes(const rb_rolling_model *model, double *own, void *context,
                                rb_message *why)
{
    const study *st = context;
    return rb_case_slopes_row(st->one, model, &st->slopes, own, why);
}

static rb_status solve_crack(int k, rb_rolling_row *row, void *context, rb_message *why)
{
    study *st = context;
    const rb_status s = cli_study_try_one(st, k, why);
    return s == RB_OK
               ? rb_case_crack_row(rb_case_resolved(st->one), rb_case_crack_of(st->one), row, why)
               : s;
}

/* ---- Progress ---------------------------------------------------------------------- */

/* Rows reach the file at least twice a second.  Where nobody looks on, a line after ten
 * seconds and whenever these have doubled says how far the study is. */
static int tick(int finished, void *context)
{
    study *st = context;
    const double now = rb_seconds(), spent = now - st->start;
    const int left = st->cases - st->first - finished;

    if (cli_interrupted())
        return 1;
    if (now - st->shown < 0.5)
        return 0;
    st->shown = now;
    const int terminal = isatty(STDERR_FILENO);
    const int is_due = spent >= st->told_next;
    while (st->told_next <= spent)
        st->told_next *= 2.0;
    if (!st->o->quiet && (is_due || (finished > 0 && (terminal || st->o->progress)))) {
        fprintf(stderr, "%scase %d of %d, ", terminal ? "\r" : "", st->first + finished, st->cases);
        fprintf(stderr, finished > 0 ? "%.0f s left%s" : "%.0f s so far%s",
                finished > 0 ? spent / finished * left : spent,
                terminal && left > 0 ? "\033[K" : "\n");
    }
    return !cli_study_flush(st);
}

/* ---- Command ----------------------------------------------------------------------- */

static rb_rolling_sweep sweep_of(study *st)
{
    unsigned also = rb_case_resolved(st->base)->error ? RB_ROW_ERRORS : 0;
    for (int k = 0; k < st->results; k++)
        also |= cli_study_stress_of(st, &st->result[k]);
    return (rb_rolling_sweep){.first = st->first,
                              .also = also,
                              .bonds = st->bonds,
                              .bond = st->bond,
                              .units = rb_case_resolved(st->base)->units,
                              .count = st->cases - st->first,
                              .workers = st->o->jobs,
                              .make = make_case,
                              .program = program_of_case,
                              .measure =
                                  st->slopes.n + st->slopes.deviations > 0 ? measure_slopes : NULL,
                              .solve = st->has_crack ? solve_crack : NULL,
                              .see = see_row,
                              .tick = tick,
                              .context = st};
}

static void print_summary(FILE *out, const void *context)
{
    const study *st = context;
    const rb_rolling_note_list said = rb_rolling_list_study_notes(&st->notes, "case");
    char heading[STUDY_HEADING];
    const double n = st->summed;

    rb_report_notes(out, &said, cli_is_coloured(stderr));
    fprintf(out, "study: %d case%s in %.3g s; not solved: %d of %d\n", st->ran, rb_plural(st->ran),
            st->spent, st->unsolved, st->cases);
    for (int j = 0; j < st->results && st->summed > 1; j++) {
        const double mean = st->sum[j] / n;
        const double variance = (st->square[j] - n * mean * mean) / (n - 1.0);
        const rb_rolling_result *r = st->result[j].r;
        const double rounding =
            rb_sensitivity_rounding(&rb_case_resolved(st->base)->rc, r, st->first_result[j] + mean);
        if (rb_sensitivity_has(r) && sqrt(fmax(variance, 0.0)) > rounding)
            fprintf(out, "  %-28s %.6g +- %.2g\n", cli_study_result_name(st, j, heading),
                    st->first_result[j] + mean, sqrt(variance));
    }
}

static cli_exit run_study(study *st)
{
    rb_message why = {.text = ""};
    const rb_rolling_sweep sweep = sweep_of(st);

    cli_interrupts_catch();
    st->start = st->shown = rb_seconds();
    st->told_next = isatty(STDERR_FILENO) ? 2.0 : 10.0;
    const rb_status s = cli_pool_run(&sweep, &why);
    cli_interrupts_leave();
    const double spent = rb_seconds() - st->start;
    if (s == RB_INTERRUPTED && ferror(st->out))
        return CLI_OK; /* cli_study_close says it */
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "%s%s", why.text,
                        st->path ? "; the same command continues from there" : "");
    st->complete = 1;
    st->ran = sweep.count;
    st->spent = spent;
    if (!st->o->quiet)
        cli_print_lines(print_summary, st);
    if (st->unsolved_case) {
        /* Rows have no place for words: the first that was not solved is solved once more. */
        rb_rolling_row row;
        rb_message reason = {.text = ""};
        rb_rolling_sweep_case(&sweep, st->unsolved_case - 1, &row, &reason);
        if (row.solution.status == RB_EINVAL && !reason.text[0]) /* a sample that is no case */
            cli_study_try_one(st, st->unsolved_case - 1, &reason);
        if (row.solution.status != RB_OK)
            cli_fail(CLI_UNSOLVED, "case %d is not solved: %s", st->unsolved_case,
                     reason.text[0] ? reason.text : rb_status_text(row.solution.status));
    }
    if (st->o->cite)
        cli_print_citations(&rb_case_resolved(st->base)->rc, NULL);
    if (st->no_memory > 0)
        cli_fail(CLI_INTERNAL, "out of memory in %d case%s, of status %d", st->no_memory,
                 rb_plural(st->no_memory), RB_ENOMEM);
    return (cli_exit)st->worst;
}

/* All that can be refused, and the output file. */
static cli_exit prepare_study(const cli_spec *spec, int argc, char **argv, rb_case *c,
                              cli_args *args, study *st)
{
    cli_exit code = cli_case_read(spec, argc, argv, c, args);

    st->file = cli_case_file_of(args);
    if (code == CLI_CONTINUE)
        code = cli_study_read(st);
    if (code == CLI_CONTINUE && st->o->sample > 0) {
        rb_message why = {.text = ""};
        code = cli_say(rb_case_resolve(c, &why), &why);
        if (code == CLI_CONTINUE)
            code = cli_study_sample(st, c);
    }
    /* with values, because other options may stand only beside one that varies */
    if (st->has_crack) /* its contact may be any that passes */
        rb_case_set_purpose(c, RB_CASE_CRACK);
    if (code == CLI_CONTINUE)
        code = cli_study_set_values(st, c, cli_study_first(st, c));
    if (code == CLI_CONTINUE)
        code = cli_case_resolve(spec, c, args);
    if (code == CLI_CONTINUE)
        code = cli_check_units(c, st->own, args);
    if (code == CLI_CONTINUE)
        code = cli_study_check(st);
    if (code == CLI_CONTINUE)
        code = cli_study_choose_results(st);
    if (code == CLI_CONTINUE)
        code = cli_study_prepare_pictures(st);
    if (code == CLI_CONTINUE)
        code = find_fingerprint(st);
    if (code == CLI_CONTINUE && !cli_pool_is_worker())
        code = cli_study_open(st);
    return code;
}

int cli_sweep(int argc, char **argv)
{
    study_options o = {0};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_STUDY);
    study st = {.base = c, .o = &o, .over = -1, .family = -1};
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {.synopsis = "rollbem sweep [OPTION...] [STUDY.ini]",
                           .about = about,
                           .notes = notes,
                           .refused = ",paris,paris-range,threshold,growth,grow-to,grow-steps,",
                           .purpose = RB_CASE_STUDY,
                           .second = RB_CASE_CRACK,
                           .sets = {rb_case_options(c),
                                    {options, OPTIONS, &o, o.given, NULL},
                                    rb_case_crack_set(c),
                                    cli_example_set()},
                           .set_n = 4};
    st.own = &spec.sets[1];
    rb_case_also_locate(c, st.own);
    st.cracks = &spec.sets[2];
    cli_exit code = cli_pool_begin(argc, argv);
    if (code != CLI_CONTINUE) {
        rb_case_free(c);
        return code;
    }
    code = prepare_study(&spec, argc, argv, c, &args, &st);
    code = cli_pool_agree(code, code == CLI_CONTINUE ? st.fingerprint : 0);
    if (cli_pool_is_worker()) {
        const rb_rolling_sweep sweep = sweep_of(&st);
        rb_message why = {.text = ""};
        if (code == CLI_CONTINUE)
            cli_pool_run(&sweep, &why);
        code = CLI_OK; /* rank 0 has the exit code */
    } else {
        if (code == CLI_CONTINUE)
            code = run_study(&st);
        if (st.out)
            code = cli_study_close(&st, code);
        if (st.complete)
            code = cli_study_draw(&st, code);
    }
    cli_pool_end();
    cli_study_free_columns(&st);
    free(st.drawn);
    free(st.band);
    rb_case_slopes_free(&st.slopes);
    json_decref(st.list);
    rb_case_free(st.one);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
