/* rollbem design: minimum or maximum of a result over numbers of a case. */
#include "program/cli/case.h"
#include "program/cli/interrupt.h"
#include "program/cli/wait.h"
#include "analysis/design/design.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *least, *largest, *over, *subject; /* options */
    int most;
    double span;
    rb_design design;
    rb_units units;
    int tells; /* 1: evaluations on standard error */
} designing;

#define PLACE(member) offsetof(designing, member)

static const rb_option options[] = {
    RB_GROUP_LINE("design", "What is designed"),
    RB_TEXT_LINE(
        "minimise", PLACE(least), "RESULT",
        "a result of the summary, or pressure_ripple: root mean square deviation of the "
        "pressure from its mean over all elements, divided by the mean; or a number of the "
        "case that --over varies",
        .unset = "none"),
    RB_TEXT_LINE("maximise", PLACE(largest), "RESULT", "the same, maximised", .unset = "none"),
    RB_TEXT_LINE("over", PLACE(over), "NAME=A:B,...",
                 "numbers of the case by their options, with bounds; gap=A:B: every value of the "
                 "table of --gap, which may change by A to B",
                 .unset = "none"),
    RB_TEXT_LINE("subject", PLACE(subject), "RESULT<=X,...",
                 "constraints on results, <= or >=", .unset = "none"),
    RB_DESIGN_SPAN_LINE(PLACE(span)),
    RB_DESIGN_EVALUATIONS_LINE(PLACE(most)),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Minimises or maximises a result over numbers of a case within bounds, with\n"
    "constraints on other results, by sequential quadratic programming with exact\n"
    "gradients (NLopt's SLSQP). The search starts at the values of the case and\n"
    "finds a local optimum; others may exist. Prints one row per variable.\n";

static const char notes[] =
    "Example: rollbem design --support halfplane --similar --load 500 \\\n"
    "           --minimise max_pressure --over radius=20:200\n"
    "         rollbem design --support halfplane --similar --load 500 \\\n"
    "           --minimise radius --over radius=20:200 --subject 'max_pressure<=600'\n"
    "\nExit codes: 0 found; 1 not at rest, or constraints that cannot be met; 64, 65, 66,\n"
    "70, 73 as of the other commands.\n";

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    return rb_report_design_table(out, &((const designing *)run->own)->design, run->c->units,
                                  cli_command_line(), &run->o.style);
}

static void add_json(const cli_case_run *run, json_t **root)
{
    rb_report_json_design(root, &((const designing *)run->own)->design, run->c->units);
}

/* "" of a pure number. */
static const char *unit_of(const rb_design *d, rb_units units)
{
    const char *unit = rb_design_unit(d) ? rb_design_unit(d) : "1";
    return strcmp(unit, "1") != 0 && strcmp(unit, "-") != 0 ? rb_unit_name(units, unit) : "";
}

static void summarise_design(FILE *out, const cli_case_run *run)
{
    const rb_design *d = &((const designing *)run->own)->design;
    const rb_units units = run->c->units;
    const char *unit = rb_design_unit(d), *name = unit_of(d, units);
    if (d->status == RB_OK)
        fprintf(out, "design: %s %.6g%s%s, at the start %.6g%s%s, %d evaluation%s\n",
                rb_design_name(d), rb_unit_shown(units, unit, d->value), *name ? " " : "", name,
                rb_unit_shown(units, unit, d->start), *name ? " " : "", name, d->evaluations,
                rb_plural(d->evaluations));
}

static int report_evaluation(int evaluation, double value, const double *x, void *context)
{
    const designing *f = context;
    const rb_design *d = &f->design;
    if (f->tells) {
        cli_wait_rest();
        fprintf(stderr, "evaluation %d: %s %.8g", evaluation, rb_design_name(d),
                rb_unit_shown(f->units, rb_design_unit(d), value));
        for (int j = 0; j < d->n && j < 4; j++)
            fprintf(stderr, " %s=%.6g", d->variable[j].name,
                    rb_unit_shown(f->units, d->variable[j].unit, x[j]));
        fputc('\n', stderr);
    }
    return cli_interrupted();
}

static rb_status solve_design(cli_case_run *run, rb_message *why)
{
    designing *f = run->own;
    const rb_design_observer observer = {report_evaluation, f};
    f->tells = !run->o.quiet && isatty(STDERR_FILENO);
    f->units = run->c->units;
    cli_interrupts_catch();
    const rb_status s = rb_design_solve(run->words, &observer, &f->design, why);
    cli_interrupts_leave();
    /* What was found so far is printed too. */
    run->printable =
        s == RB_OK || ((s == RB_MAXITER || s == RB_INTERRUPTED) && !isnan(f->design.value));
    return s;
}

static cli_exit check_design(cli_case_run *run)
{
    designing *f = run->own;
    rb_design *d = &f->design;
    rb_message why = {.text = ""};
    if (f->least && f->largest)
        return cli_case_refuse(run->words, "maximise,minimise", "not together with --minimise");
    if (!f->least && !f->largest)
        return cli_fail(CLI_USAGE, "design needs --minimise RESULT or --maximise RESULT");
    d->largest = f->largest != NULL;
    d->most = f->most;
    d->span = isnan(f->span) ? 0.0 : f->span;
    rb_status s = rb_design_objective(d->largest ? f->largest : f->least, d, &why);
    if (s == RB_OK)
        s = rb_design_variables(run->words, f->over, d, &why);
    if (s == RB_OK)
        s = rb_design_constraints(run->words, f->subject, d, &why);
    return cli_case_refused(run->words, s, &why);
}

static const cli_case_command command = {
    .synopsis = "rollbem design --minimise RESULT --over NAME=A:B [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_DESIGN,
    .options = options,
    .option_n = OPTIONS,
    .check = check_design,
    .solve = solve_design,
    .table = write_table,
    .json = add_json,
    .summarise = summarise_design,
};

int cli_design(int argc, char **argv)
{
    designing f = {.most = 200, .span = NAN};
    const cli_exit code = cli_case_run_command(&command, &f, argc, argv);
    rb_design_free(&f.design);
    return code;
}
