/* rollbem design: minimum or maximum of a result over numbers of a case. */
#include "cli/case.h"
#include "cli/interrupt.h"
#include "cli/wait.h"
#include "rollbem/design.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <unistd.h>

typedef struct {
    const char *least, *largest, *over, *subject; /* options */
    int most;
    double span;
    rb_design design;
    int tells; /* 1: evaluations on standard error */
} designing;

#define PLACE(member) offsetof(designing, member)

static const rb_option options[] = {
    RB_GROUP_LINE("design", "What is designed"),
    RB_TEXT_LINE("minimise", PLACE(least), "RESULT",
                 "a result of the summary, or pressure_ripple: root mean square deviation of the "
                 "pressure from its mean over all elements, divided by the mean",
                 .unset = "none"),
    RB_TEXT_LINE("maximise", PLACE(largest), "RESULT", "the same, maximised", .unset = "none"),
    RB_TEXT_LINE("over", PLACE(over), "NAME=A:B,...",
                 "numbers of the case by their options, with bounds; gap=A:B: every value of the "
                 "table of --gap, which may change by A to B",
                 .unset = "none"),
    RB_TEXT_LINE("subject", PLACE(subject), "RESULT<=X,...",
                 "constraints on results, <= or >=", .unset = "none"),
    RB_NUMBER_LINE("span", PLACE(span), "mm", RB_ABOVE(0),
                   "half-width of the span of pressure_ripple, about x = 0",
                   .unset = "all elements"),
    RB_INTEGER_LINE("evaluations", PLACE(most), RB_FROM_TO(1, 100000), "solved cases at most"),
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
    "\nExit codes: 0 found; 1 not at rest, or constraints that cannot be met; 64, 65, 66,\n"
    "70, 73 as of the other commands.\n";

typedef struct {
    const designing *f;
    rb_case *words;
    const cli_output *o;
} results;

static rb_status write_results(FILE *out, const void *context, rb_message *why)
{
    const results *r = context;
    const rb_units units = rb_case_resolved(r->words)->units;
    (void)why;
    if (r->o->style.format != RB_REPORT_JSON)
        return rb_report_design_table(out, &r->f->design, units, cli_command_line(), &r->o->style);
    json_t *root = cli_case_json(r->words, NULL, NULL, rb_report_json_inputs(r->words));
    rb_report_json_design(&root, &r->f->design, units);
    return rb_report_json_write(out, root);
}

static int tell(int evaluation, double value, const double *x, void *context)
{
    const designing *f = context;
    const rb_design *d = &f->design;
    if (f->tells) {
        cli_wait_rest();
        fprintf(stderr, "evaluation %d: %s %.8g", evaluation,
                d->result ? d->result->name : "pressure_ripple", value);
        for (int j = 0; j < d->n && j < 4; j++)
            fprintf(stderr, " %s=%.6g", d->variable[j].name, x[j]);
        fputc('\n', stderr);
    }
    return cli_interrupted();
}

int cli_design(int argc, char **argv)
{
    designing f = {.most = 200, .span = NAN};
    cli_output o = {.output = NULL};
    cli_args args = {0};
    rb_message why = {""};
    int given[OPTIONS] = {0};
    rb_case *words = cli_case_create(RB_CASE_SINGLE);
    if (!words)
        return CLI_INTERNAL;
    const cli_spec spec = {
        "rollbem design --minimise RESULT --over NAME=A:B [OPTION...] [CASE.ini]",
        about,
        notes,
        {rb_case_options(words), {options, OPTIONS, &f, given, NULL}, cli_output_set(&o)},
        3};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 1)
        code = cli_fail(CLI_USAGE, "design takes at most one case file");
    if (code == CLI_CONTINUE && args.operands == 1)
        code = cli_say(rb_case_read(words, args.operand[0], 2, spec.sets + 1, &why), &why);
    if (code == CLI_CONTINUE && !rb_design_available())
        code = cli_fail(CLI_USAGE, "design: this rollbem was built without NLopt (libnlopt-dev)");
    if (code == CLI_CONTINUE)
        code = cli_case_resolve(&spec, words, &args);
    if (code == CLI_CONTINUE && !f.least == !f.largest)
        code = cli_fail(CLI_USAGE, "design needs --minimise RESULT or --maximise RESULT");
    if (code == CLI_CONTINUE) {
        rb_design *d = &f.design;
        d->largest = f.largest != NULL;
        d->most = f.most;
        d->span = isnan(f.span)
                      ? 0.0
                      : rb_unit_stored(rb_case_units(words, RB_GIVEN_ARGUMENT), "mm", f.span);
        rb_status s = rb_design_objective(d->largest ? f.largest : f.least, d, &why);
        if (s == RB_OK)
            s = rb_design_variables(words, f.over, d, &why);
        if (s == RB_OK)
            s = rb_design_constraints(words, f.subject, d, &why);
        code = cli_say(s, &why);
    }
    if (code == CLI_CONTINUE) {
        const rb_design_observer observer = {tell, &f};
        const results r = {&f, words, &o};
        const rb_design *d = &f.design;
        f.tells = !o.quiet && isatty(STDERR_FILENO);
        cli_interrupts_catch();
        if (!o.quiet)
            cli_wait_begin();
        const rb_status s = rb_design_solve(words, &observer, &f.design, &why);
        if (!o.quiet)
            cli_wait_end();
        cli_interrupts_leave();
        code = CLI_OK;
        /* What was found so far is printed too. */
        if (s == RB_OK || ((s == RB_MAXITER || s == RB_INTERRUPTED) && !isnan(d->value)))
            code = cli_write_file(o.output, write_results, &r);
        if (s == RB_OK && code == CLI_OK && !o.quiet)
            fprintf(stderr, "design: %s %.6g, at the start %.6g, %d evaluations\n",
                    d->result ? d->result->name : "pressure_ripple", d->value, d->start,
                    d->evaluations);
        if (s != RB_OK)
            code = cli_case_refused(words, s, &why);
    }
    rb_design_free(&f.design);
    cli_args_free(&args);
    rb_case_free(words);
    return code;
}
