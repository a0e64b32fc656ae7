/* rollbem fit: numbers of a case fitted to a measured creep curve. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"
#include "program/cli/wait.h"
#include "base/io/io.h"
#include "program/report/report.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *names, *bounds, *start, *resume; /* options */
    double sigma, level;
    int progress;
    rb_io_table table;
    rb_case_data data;
    rb_case_fit fit;
    int tells; /* 1: steps on standard error */
    rb_units units;
    uint64_t fingerprint;          /* of the case, what is fitted, and the data */
    int steps;                     /* those of runs before, and of this one */
    double value[RB_CASE_FIT_MAX]; /* after so many steps, in mm, N, MPa */
    rb_status kept;                /* of writing them */
    rb_message why;
} fitting;

#define PLACE(member) offsetof(fitting, member)

static const rb_option options[] = {
    RB_GROUP_LINE("fit", "What is fitted"),
    RB_TEXT_LINE("fit", PLACE(names), "NAME,...",
                 "numbers of the case by their options, such as mu,mu-fall,slip-scale,"
                 "interlayer-tangential; creep-offset: a constant added to the measured creepage",
                 .unset = "none"),
    RB_FIT_SIGMA_LINE(PLACE(sigma)),
    RB_TEXT_LINE("start", PLACE(start), "NAME=X,...",
                 "values to start from, such as those of an earlier fit",
                 .unset = "the case's, or from the data"),
    RB_TEXT_LINE("bounds", PLACE(bounds), "NAME=A:B,...", "ranges of the numbers",
                 .unset = "those of the options"),
    RB_FIT_LEVEL_LINE(PLACE(level)),
    RB_TEXT_LINE("resume", PLACE(resume), "FILE",
                 "keeps the numbers of every step in FILE: after an interruption the same command "
                 "goes on from there; a fit that ends removes it",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    RB_FLAG_LINE("progress", PLACE(progress),
                 "print every step even when standard error is not a terminal"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Fits numbers of a case to a measured creep curve by least squares with exact\n"
    "derivatives, and prints them with intervals, correlations and the fitted curve.\n"
    "DATA has a row per point and named columns: creep or creep_ratio (xi R/(mu a));\n"
    "force, force_ratio (Q/(mu P), mu the largest coefficient of the law) or\n"
    "force_over_load (Q/P); and load, speed, temperature, sigma if they vary.\n"
    "Several tests can be written in one file, one below the other. As everywhere, a\n"
    "braked wheel has xi > 0 and Q < 0.\n"
    "Intervals hold the noise in the data; --error adds what the mesh leaves in the\n"
    "numbers, by fits with half and 0.7 of the elements.  A result around which the sum of\n"
    "squares is less, or jumps from element to element, is refused as not converged.\n"
    "A fit is refused if its model has several solutions (kappa > 1). A number that\n"
    "the data do not determine is reported as not identified, without a value.\n";

static const char notes[] =
    "Example: rollbem fit creep.tsv --fit mu,creep-offset --similar --support halfplane "
    "--load 500\n"
    "\nExit codes: 0 fitted; 1 not fitted, or some numbers are not identified; 64, 65, "
    "66,\n"
    "70, 73 as of the other commands.\n";

/* ---- Results ------------------------------------------------------------------------- */

static rb_report_fit shown(const cli_case_run *run)
{
    const fitting *f = run->own;
    return (rb_report_fit){&f->fit, &f->data, run->c->units};
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    const rb_report_fit fit = shown(run);
    return rb_report_fit_table(out, &fit, cli_command_line(), &run->o.style);
}

static void add_json(const cli_case_run *run, json_t **root)
{
    const rb_report_fit fit = shown(run);
    rb_report_json_fit(root, &fit);
}

static rb_status draw_fit(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const rb_report_fit fit = shown(context);
    return rb_report_fit_picture(out, canvas, &fit, why);
}

static const cli_case_file files[] = {{"plot", .draw = draw_fit}, {NULL, NULL, NULL}};

static void summarise_fit(FILE *out, const cli_case_run *run)
{
    const rb_report_fit fit = shown(run);
    rb_report_fit_summary(out, &fit);
}

/* ---- Resume ------------------------------------------------------------------------ */

static rb_status write_numbers(FILE *out, const void *context, rb_message *why)
{
    const fitting *f = context;
    (void)why;
    fprintf(out, "fit %016" PRIx64 " step %d\n", f->fingerprint, f->steps);
    for (int j = 0; j < f->fit.n; j++)
        fprintf(out, "%s %.17g\n", f->fit.parameter[j].name, f->value[j]);
    return rb_report_flush(out);
}

/* 1: the text holds numbers of this fit, which it starts from. */
static int read_numbers(const char *text, fitting *f)
{
    uint64_t fingerprint;
    int at = 0, whole = 0;
    if (sscanf(text, "fit %16" SCNx64 " step %d%n", &fingerprint, &f->steps, &at) != 2 ||
        fingerprint != f->fingerprint || text[at] != '\n' || f->steps < 1)
        return 0;
    for (int j = 0; j < f->fit.n; j++) {
        rb_case_parameter *p = &f->fit.parameter[j];
        char name[sizeof p->name], number[40];
        if (sscanf(text + at, "%39s %39s%n", name, number, &whole) != 2 ||
            strcmp(name, p->name) != 0 || !rb_option_number(number, &p->start))
            return 0;
        at += whole;
    }
    return strcmp(text + at, "\n") == 0;
}

static cli_exit resume(cli_case_run *run)
{
    fitting *f = run->own;
    rb_message why = {.text = ""};
    char *text = NULL;
    size_t size;
    const rb_io_table *t = &f->table;
    if (!f->resume)
        return CLI_CONTINUE;
    rb_status s = rb_report_input_hash(run->words, &f->fingerprint, &why);
    if (s == RB_OK) {
        const char *const words[] = {RB_VERSION, f->names, f->bounds ? f->bounds : ""};
        for (size_t k = 0; k < sizeof words / sizeof *words; k++)
            f->fingerprint = rb_hash(f->fingerprint, words[k], strlen(words[k]) + 1);
        for (int j = 0; j < t->columns; j++)
            f->fingerprint = rb_hash(f->fingerprint, t->name[j], strlen(t->name[j]) + 1);
        f->fingerprint =
            rb_hash(f->fingerprint, t->x, (size_t)t->rows * (size_t)t->columns * sizeof *t->x);
        s = rb_io_read_text(f->resume, &text, &size, &why);
    }
    if (s == RB_ENOENT)
        return CLI_CONTINUE;
    if (s != RB_OK)
        return cli_say(s, &why);
    const int known = read_numbers(text, f);
    free(text);
    f->fit.iterations = f->steps;
    if (!known)
        return cli_fail(CLI_CANTWRITE,
                        "--resume: %s holds no numbers of this fit, and would be overwritten: "
                        "remove it, or give another name",
                        f->resume);
    if (!run->o.quiet)
        fprintf(stderr,
                "rollbem: %s holds the numbers after %d step%s: the fit goes on from there\n",
                f->resume, f->steps, rb_plural(f->steps));
    return CLI_CONTINUE;
}

/* ---- Command ----------------------------------------------------------------------- */

static int report_step(int iteration, double chi_square, int n, const double *value, void *context)
{
    fitting *f = context;
    f->steps = iteration;
    if (f->resume && f->kept == RB_OK) {
        memcpy(f->value, value, (size_t)n * sizeof *value);
        f->kept = cli_write_to(f->resume, write_numbers, f, &f->why);
    }
    if (f->tells) {
        cli_wait_rest();
        fprintf(stderr, "step %d: sum of squares %.6g;", iteration, chi_square);
        for (int j = 0; j < n; j++)
            fprintf(stderr, " %s=%.6g", f->fit.parameter[j].name,
                    rb_unit_shown(f->units, f->fit.parameter[j].unit, value[j]));
        fputc('\n', stderr);
    }
    return f->kept != RB_OK || cli_interrupted();
}

/* The best numbers so far are kept, so that --start goes on from there. */
static rb_status solve_fit(cli_case_run *run, rb_message *why)
{
    fitting *f = run->own;
    const rb_case_fit_observer observer = {report_step, f};
    f->tells = !run->o.quiet && (f->progress || isatty(STDERR_FILENO));
    f->units = run->c->units;
    cli_interrupts_catch();
    rb_status s = rb_case_fit_solve(run->words, &f->data, &observer, &f->fit, why);
    cli_interrupts_leave();
    if (f->kept != RB_OK) {
        *why = f->why;
        s = f->kept;
    }
    if (s > 0 && s != RB_INACCURATE && f->resume && f->steps > 0)
        fprintf(stderr, "%s holds the numbers so far: the same command goes on from there\n",
                f->resume);
    else if (s > 0 && s != RB_INACCURATE) {
        fprintf(stderr, "so far: --start ");
        for (int j = 0; j < f->fit.n; j++)
            fprintf(stderr, "%s%s=%.17g", j ? "," : "", f->fit.parameter[j].name,
                    rb_unit_shown(f->units, f->fit.parameter[j].unit, f->fit.parameter[j].value));
        fputc('\n', stderr);
    }
    run->printable = s == RB_OK;
    run->incomplete = f->fit.unidentified > 0;
    return s;
}

static cli_exit prepare_fit(cli_case_run *run)
{
    fitting *f = run->own;
    rb_message why = {.text = ""};
    if (run->args.operands < 1)
        return cli_fail(CLI_USAGE, "fit needs DATA, and at most one case file");
    if (!f->names)
        return cli_fail(CLI_USAGE, "fit needs --fit NAME,...");
    const rb_case_fit_words words = {f->names, f->start, f->bounds, f->sigma};
    f->fit.level = f->level;
    const rb_status s = rb_case_fit_read(run->words, &words, run->args.operand[0], &f->table,
                                         &f->data, &f->fit, &why);
    return cli_case_refused(run->words, s, &why);
}

static const cli_case_command command = {
    .synopsis = "rollbem fit DATA --fit NAME,... [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_CURVE,
    .options = options,
    .option_n = OPTIONS,
    .operands = 1,
    .files = files,
    .prepare = prepare_fit,
    .check = resume,
    .solve = solve_fit,
    .table = write_table,
    .json = add_json,
    .summarise = summarise_fit,
};

int cli_fit(int argc, char **argv)
{
    fitting f = {.sigma = NAN, .level = 0.95};
    const cli_exit code = cli_case_run_command(&command, &f, argc, argv);
    /* it has ended, and its results are written */
    if (f.resume && f.steps > 0 && (code == CLI_OK || code == CLI_UNSOLVED) &&
        (f.fit.status == RB_OK || f.fit.status == RB_INACCURATE))
        unlink(f.resume);
    rb_case_fit_free(&f.fit);
    rb_io_table_free(&f.table);
    return code;
}
