/* rollbem fit: numbers of a case fitted to a measured creep curve. */
#include "cli/case.h"
#include "cli/interrupt.h"
#include "cli/wait.h"
#include "rollbem/io.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *names, *bounds, *start; /* options */
    double sigma, level;
    rb_io_table table;
    double *sigmas; /* of --sigma; owned */
    rb_case_data data;
    rb_case_fit fit;
    int tells; /* 1: steps on standard error */
} fitting;

#define PLACE(member) offsetof(fitting, member)

static const rb_option options[] = {
    RB_GROUP_LINE("fit", "What is fitted"),
    RB_TEXT_LINE("fit", PLACE(names), "NAME,...",
                 "numbers of the case by their options, such as mu,mu-fall,slip-scale,"
                 "interlayer-tangential; creep-offset: a constant added to the measured creepage",
                 .unset = "none"),
    RB_NUMBER_LINE("sigma", PLACE(sigma), "-", RB_ABOVE(0),
                   "standard deviation of the measured forces, in their units; a column "
                   "sigma gives one for each",
                   .unset = "from the residuals"),
    RB_TEXT_LINE("start", PLACE(start), "NAME=X,...",
                 "values to start from, such as those of an earlier fit",
                 .unset = "the case's, or from the data"),
    RB_TEXT_LINE("bounds", PLACE(bounds), "NAME=A:B,...", "ranges of the numbers",
                 .unset = "those of the options"),
    RB_NUMBER_LINE("level", PLACE(level), "-", RB_BETWEEN(0, 1), "of the intervals (Student's)"),
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
    "A fit is refused if its model has several solutions (kappa > 1). A number that\n"
    "the data do not determine is reported as not identified, without a value.\n";

static const char notes[] =
    "Example: rollbem fit creep.tsv --fit mu,creep-offset --similar --support halfplane "
    "--load 500\n"
    "\nExit codes: 0 fitted; 1 not fitted, or some numbers are not identified; 64, 65, "
    "66,\n"
    "70, 73 as of the other commands.\n";

/* ---- What is asked for --------------------------------------------------------------- */

static rb_case_parameter *parameter_of(fitting *f, const char *name, size_t n)
{
    for (int j = 0; j < f->fit.n; j++)
        if (strlen(f->fit.parameter[j].name) == n &&
            strncmp(f->fit.parameter[j].name, name, n) == 0)
            return &f->fit.parameter[j];
    return NULL;
}

/* NAME=X or NAME=A:B, commas between. */
static cli_exit read_values(fitting *f, const char *option, const char *text, int ranges)
{
    for (const char *at = text; at && *at;) {
        const size_t n = strcspn(at, "=,"), all = strcspn(at, ",");
        rb_case_parameter *p = parameter_of(f, at, n);
        double x, y;
        char end;
        const int found = at[n] != '=' ? 0
                          : ranges     ? sscanf(at + n + 1, "%lf:%lf%c", &x, &y, &end)
                                       : sscanf(at + n + 1, "%lf%c", &x, &end);
        if (!p ||
            (ranges ? found != 2 && !(found == 3 && end == ',')
                    : found != 1 && !(found == 2 && end == ',')) ||
            (ranges && !(x < y)))
            return cli_fail(CLI_USAGE, "--%s: expected %s of a fitted number, got '%.*s'", option,
                            ranges ? "NAME=A:B" : "NAME=X", (int)all, at);
        if (ranges) {
            p->low = x;
            p->high = y;
        } else {
            p->start = x;
        }
        at += all + (at[all] == ',');
    }
    return CLI_CONTINUE;
}

/* A column in mm, N, MPa; NULL: there is none. */
static const double *column(fitting *f, const char *name, const char *unit, rb_units units)
{
    for (int j = 0; j < f->table.columns && f->table.name; j++)
        if (strncmp(f->table.name[j], name, strlen(name)) == 0) {
            const char *rest = f->table.name[j] + strlen(name);
            if (*rest == '\0' ||
                (*rest == '_' && strcmp(unit, "-") != 0 && strncmp(rest, "_ratio", 6) != 0 &&
                 strncmp(rest, "_over", 5) != 0)) {
                rb_io_table_convert(&f->table, j, unit, units);
                return f->table.x + (size_t)j * (size_t)f->table.rows;
            }
        }
    return NULL;
}

static cli_exit read_data(fitting *f, const char *path, rb_units units)
{
    rb_message why = {""};
    rb_case_data *d = &f->data;
    const cli_exit code = cli_say(rb_io_table_read(path, &f->table, &why), &why);
    if (code != CLI_CONTINUE)
        return code;
    d->n = f->table.rows;
    d->creep = column(f, "creep", "-", units);
    d->is_ratio = !d->creep;
    if (!d->creep)
        d->creep = column(f, "creep_ratio", "-", units);
    d->force = column(f, "force", "N/mm", units);
    d->measure = RB_CASE_FORCE;
    if (!d->force && (d->force = column(f, "force_ratio", "-", units)) != NULL)
        d->measure = RB_CASE_FORCE_RATIO;
    if (!d->force && (d->force = column(f, "force_over_load", "-", units)) != NULL)
        d->measure = RB_CASE_FORCE_OVER_LOAD;
    d->load = column(f, "load", "N/mm", units);
    d->speed = column(f, "speed", "mm/s", units);
    d->temperature = column(f, "temperature", "K", units);
    d->sigma = column(f, "sigma", d->measure == RB_CASE_FORCE ? "N/mm" : "-", units);
    if (!d->creep || !d->force)
        return cli_fail(CLI_DATA,
                        "%s: expected a column creep or creep_ratio, and one of force, "
                        "force_ratio, force_over_load",
                        path);
    for (int k = 0; k < d->n && d->sigma; k++)
        if (!(d->sigma[k] > 0.0))
            return cli_fail(CLI_DATA, "%s:%d: sigma: expected > 0, got %g", path, f->table.line[k],
                            d->sigma[k]);
    if (!d->sigma && !isnan(f->sigma)) {
        f->sigmas = rb_alloc((size_t)d->n, 1);
        for (int k = 0; k < d->n && f->sigmas; k++)
            f->sigmas[k] =
                d->measure == RB_CASE_FORCE ? rb_unit_stored(units, "N/mm", f->sigma) : f->sigma;
        d->sigma = f->sigmas;
    }
    return CLI_CONTINUE;
}

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

static rb_status draw(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const rb_report_fit fit = shown(context);
    return rb_report_fit_picture(out, canvas, &fit, why);
}

static const cli_case_file files[] = {{"plot", .draw = draw}, {NULL, NULL, NULL}};

static void summarise(FILE *out, const cli_case_run *run)
{
    const rb_report_fit fit = shown(run);
    rb_report_fit_summary(out, &fit);
}

/* ---- Command ----------------------------------------------------------------------- */

static int tell(int iteration, double chi_square, int n, const double *value, void *context)
{
    const fitting *f = context;
    if (f->tells) {
        cli_wait_rest();
        fprintf(stderr, "step %d: sum of squares %.6g;", iteration, chi_square);
        for (int j = 0; j < n; j++)
            fprintf(stderr, " %s=%.6g", f->fit.parameter[j].name, value[j]);
        fputc('\n', stderr);
    }
    return cli_interrupted();
}

/* The best numbers so far are kept, so that --start goes on from there. */
static rb_status solve(cli_case_run *run, rb_message *why)
{
    fitting *f = run->own;
    const rb_case_fit_observer observer = {tell, f};
    f->tells = !run->o.quiet && isatty(STDERR_FILENO);
    cli_interrupts_catch();
    const rb_status s = rb_case_fit_solve(run->words, &f->data, &observer, &f->fit, why);
    cli_interrupts_leave();
    if (s > 0 && s != RB_INACCURATE) {
        fprintf(stderr, "so far: --start ");
        for (int j = 0; j < f->fit.n; j++)
            fprintf(stderr, "%s%s=%.17g", j ? "," : "", f->fit.parameter[j].name,
                    f->fit.parameter[j].value);
        fputc('\n', stderr);
    }
    run->printable = s == RB_OK;
    run->incomplete = f->fit.unidentified > 0;
    return s;
}

static cli_exit prepare(cli_case_run *run)
{
    fitting *f = run->own;
    rb_message why = {""};
    if (run->args.operands < 1)
        return cli_fail(CLI_USAGE, "fit needs DATA, and at most one case file");
    if (!f->names)
        return cli_fail(CLI_USAGE, "fit needs --fit NAME,...");
    for (const char *at = f->names; *at;) {
        const size_t n = strcspn(at, ",");
        if (n == 0 || n > 39 || parameter_of(f, at, n))
            return cli_fail(CLI_USAGE, "--fit: expected different names, got '%s'", f->names);
        if (f->fit.n == RB_CASE_FIT_MAX)
            return cli_fail(CLI_USAGE, "--fit: expected at most %d names", RB_CASE_FIT_MAX);
        rb_case_parameter *p = &f->fit.parameter[f->fit.n++];
        memcpy(p->name, at, n);
        p->start = NAN;
        p->low = -INFINITY;
        p->high = INFINITY;
        at += n + (at[n] == ',');
    }
    cli_exit code = read_values(f, "start", f->start, 0);
    if (code == CLI_CONTINUE)
        code = read_values(f, "bounds", f->bounds, 1);
    if (code == CLI_CONTINUE)
        code = read_data(f, run->args.operand[0], rb_case_units(run->words, RB_GIVEN_ARGUMENT));
    f->fit.level = f->level;
    return code == CLI_CONTINUE
               ? cli_say(rb_case_prepare_fit(run->words, &f->data, &f->fit, &why), &why)
               : code;
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
    .prepare = prepare,
    .solve = solve,
    .table = write_table,
    .json = add_json,
    .summarise = summarise,
};

int cli_fit(int argc, char **argv)
{
    fitting f = {.sigma = NAN, .level = 0.95};
    const cli_exit code = cli_case_run_command(&command, &f, argc, argv);
    rb_case_fit_free(&f.fit);
    rb_io_table_free(&f.table);
    free(f.sigmas);
    return code;
}
