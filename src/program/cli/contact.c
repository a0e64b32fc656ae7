/* rollbem contact FILE.inp: the two-dimensional cases of an input file of CONTACT. */
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "program/cli/wait.h"
#include "rolling/case/case.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    rb_report_style style;
    int tractions, quiet;
    const char *output;
} contact_options;

#define PLACE(member) offsetof(contact_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("tractions", PLACE(tractions),
                 "a row per element of every case instead of one per case"),
    CLI_STYLE_LINES(PLACE(style)),
    CLI_OUTPUT_LINE(PLACE(output)),
    RB_FLAG_LINE("quiet", PLACE(quiet), "do not list the features that are left out"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Runs the cases of an input file of CONTACT (module 3) that are two-dimensional:\n"
    "one row of elements, MY = 1, a parabola or a circle as gap or Hertzian input of a\n"
    "line contact (IPOTCN = -4, -5), Coulomb friction or friction that falls with the\n"
    "slip, elastic or viscoelastic half-spaces, with a third body that may yield;\n"
    "pressed (T = 0), shifted (T = 1), rolled step by step (T = 2) or steadily (T = 3).\n"
    "A case with P = 0 goes on from the case before. The elements are those of the file.\n"
    "A line for each reason says what is left out, and of which cases.\n"
    "docs/contact.md has the names and signs of both programs.";

static const char notes[] =
    "Columns in CONTACT's names, signs and units (N over the width DY, MPa, mm), then P, Q\n"
    "[N/mm] and the residual. FX_REL is FX/(FSTAT FN); FRIC_POWER is that of CONTACT, < 0.\n"
    "NPLAST elements yield, NSLIP others slip; UPL is what the third body has yielded.\n"
    "Exit codes: 0 all cases that could be run are solved; 1 less than half of the cases\n"
    "could be run, or one was not solved; 65 a case cannot be read, the others are run;\n"
    "66 no such file.\n";

typedef struct {
    const rb_io_contact_case *in;
    rb_case_contact c;
    rb_rolling_solution s; /* n = 0: not run */
    rb_status status;
    rb_message why;
} contact_run;

typedef struct {
    const contact_options *o;
    const char *path;
    int n;
    contact_run *run;
} contact_runs;

/* ---- Results in CONTACT's words ---------------------------------------------------- */

static const char columns[] = "case status FN FX FX_REL CKSI PEN PMAX FRIC_POWER NPOT NCON NADH "
                              "NSLIP P_N/mm Q_N/mm line residual NPLAST",
                  element_columns[] = "case X H PN PX S zone UPL";

/* x + 0.0: no -0; NAN where the case was not run. */
#define NUMBER(name, x) CLI_NUMBER(name, name, (x) + known)

static rb_status print_cases(FILE *out, const void *context, rb_message *why)
{
    const contact_runs *all = context;
    const int tractions = all->o->tractions;
    cli_rows rows = cli_rows_begin(out, &all->o->style, tractions ? element_columns : columns);
    (void)why;
    for (int k = 0; k < all->n && !rows.is_json; k++)
        if (all->run[k].c.left_out[0])
            rb_report_comment(&rows.cells, "case %d leaves out %s", k + 1, all->run[k].c.left_out);
    for (int k = 0; k < all->n; k++) {
        const contact_run *r = &all->run[k];
        const rb_rolling_solution *s = &r->s, *before = k > 0 ? &all->run[k - 1].s : NULL;
        const double sign = r->c.sign;
        if (rows.is_json || !tractions) {
            const double known = s->n > 0 ? 0.0 : NAN, width = r->c.width;
            const int yielding = s->yielding > 0 ? s->yielding : 0;
            const cli_value values[] = {
                CLI_WHOLE("case", "case", k + 1),
                CLI_WORDS("status", "status", r->c.runs ? rb_status_text(r->status) : "not run"),
                CLI_TEXT("left_out", NULL, r->c.left_out),
                NUMBER("FN", s->normal_load * width),
                NUMBER("FX", sign * s->tangential_load * width),
                NUMBER("FX_REL", sign * s->force_ratio),
                NUMBER("CKSI", sign * (r->in->digit.T >= 2 ? s->creepage : s->tangential_shift)),
                NUMBER("PEN", s->approach),
                NUMBER("PMAX", s->max_pressure),
                NUMBER("FRIC_POWER", rb_case_contact_power(r->in, &r->c, before, s)),
                NUMBER("NPOT", s->n),
                NUMBER("NCON", s->contact),
                NUMBER("NADH", s->stick),
                NUMBER("NSLIP", s->slipping - yielding),
                NUMBER("P_N/mm", s->normal_load),
                NUMBER("Q_N/mm", s->tangential_load),
                NUMBER("line", r->in->line),
                NUMBER("residual", s->residual),
                NUMBER("NPLAST", yielding)};
            cli_rows_add(&rows, sizeof values / sizeof *values, values);
        }
        if (rows.is_json && tractions && s->n > 0)
            cli_rows_set(&rows, "table", rb_report_json_table(s));
        /* The elements along the x of the file. */
        for (int j = 0; j < s->n && tractions && !rows.is_json; j++) {
            const int i = sign < 0.0 ? s->n - 1 - j : j;
            const cli_value values[] = {CLI_WHOLE(NULL, "case", k + 1),
                                        CLI_NUMBER(NULL, "X", r->c.centre + sign * s->x[i]),
                                        CLI_NUMBER(NULL, "H", s->gap[i]),
                                        CLI_NUMBER(NULL, "PN", s->p[i]),
                                        CLI_NUMBER(NULL, "PX", sign * s->q[i] + 0.0),
                                        CLI_NUMBER(NULL, "S", sign * s->slip[i] + 0.0),
                                        CLI_WHOLE(NULL, "zone", s->zone[i]),
                                        CLI_NUMBER(NULL, "UPL", s->plastic ? s->plastic[i] : 0.0)};
            cli_rows_add(&rows, sizeof values / sizeof *values, values);
        }
    }
    if (!rows.is_json)
        return rb_report_flush(out);
    json_t *root = rb_report_json_start(cli_command_line());
    rb_report_json_set(&root, "file", rb_report_json_text(all->path));
    rb_report_json_set(&root, "cases", rows.list);
    return rb_report_json_write(out, root);
}

#undef NUMBER

/* ---- Command ----------------------------------------------------------------------- */

static int is_left_out_alike(const contact_run *a, const contact_run *b)
{
    return a->c.runs == b->c.runs && strcmp(a->c.left_out, b->c.left_out) == 0;
}

int cli_contact(int argc, char **argv)
{
    contact_options o = {0};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem contact [OPTION...] FILE.inp",
                           .about = about,
                           .notes = notes,
                           .sets = {{options, OPTIONS, &o, NULL, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands != 1)
        code = cli_fail(CLI_USAGE, "contact: expected one FILE.inp, got %d files", args.operands);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    contact_runs all = {.o = &o};
    rb_io_contact_case *cases = NULL;
    cli_exit worst = CLI_OK;
    if (code == CLI_CONTINUE) {
        rb_message why = {.text = ""};
        all.path = args.operand[0];
        code = cli_say(rb_io_contact_read(all.path, &all.n, &cases, &why), &why);
    }
    if (code == CLI_CONTINUE && !(all.run = calloc((size_t)all.n, sizeof *all.run)))
        code = cli_fail(CLI_INTERNAL, "out of memory");
    if (code == CLI_CONTINUE) {
        for (int k = 0; k < all.n; k++) {
            all.run[k].in = &cases[k];
            rb_case_from_contact(&cases[k], &all.run[k].c);
        }
        /* each case from what the one before has left */
        int ran = 0;
        for (int k = 0; k < all.n; k++) {
            contact_run *r = &all.run[k];
            const contact_run *before = k > 0 ? &all.run[k - 1] : NULL;
            const rb_rolling_solution *left = before ? &before->s : NULL;
            rb_case_contact_follow(before ? &before->c : NULL, left, &r->c);
            if (!r->c.runs)
                continue;
            ran++;
            cli_wait_begin();
            r->status = rb_case_contact_solve(&r->c, left, &r->s, &r->why);
            cli_wait_end();
            if (r->status == RB_OK)
                continue;
            const cli_exit one = r->status == RB_EINVAL ? CLI_DATA : cli_exit_of(r->status);
            cli_fail(one, "%s:%d: case %d: %s", all.path, r->in->line, k + 1,
                     rb_status_reason(r->status, &r->why));
            worst = one > worst ? one : worst;
        }
        /* what is left out of the cases, each reason at its first case only */
        for (int k = 0; k < all.n && !o.quiet; k++) {
            const contact_run *r = &all.run[k];
            int as_before = 0, alike = 0;
            for (int j = 0; j < k; j++)
                as_before |= is_left_out_alike(&all.run[j], r);
            for (int j = k + 1; j < all.n; j++)
                alike += is_left_out_alike(&all.run[j], r);
            if (!r->c.left_out[0] || as_before)
                continue;
            char more[40] = "";
            if (alike > 0)
                snprintf(more, sizeof more, ", and %d more case%s", alike, alike > 1 ? "s" : "");
            cli_fail(CLI_OK,
                     r->c.runs ? "%s:%d: case %d%s solved without %s"
                               : "%s:%d: case %d%s skipped: %s is not supported",
                     all.path, r->in->line, k + 1, more, r->c.left_out);
        }
        for (int k = 0; k < all.n; k++)
            if (cases[k].unread[0])
                worst = CLI_DATA > worst ? CLI_DATA : worst;
        /* a table of cases none of which was run says nothing; JSON has the reasons */
        code = ran > 0 || o.style.format == RB_REPORT_JSON
                   ? cli_write_file(all.o->output, print_cases, &all)
                   : CLI_OK;
        if (code != CLI_OK)
            worst = code;
        else if (ran == 0)
            worst = cli_fail(CLI_UNSOLVED, "%s: no case that could be run", all.path);
        else if (ran < all.n) { /* with most of them missing, the file has not been run */
            const cli_exit missing = 2 * ran < all.n ? CLI_UNSOLVED : CLI_OK;
            cli_fail(missing, "%s: %d of %d cases run, %d skipped", all.path, ran, all.n,
                     all.n - ran);
            worst = missing > worst ? missing : worst;
        }
        for (int k = 0; k < all.n; k++)
            rb_rolling_solution_free(&all.run[k].s);
        code = worst;
    }
    free(all.run);
    free(cases);
    cli_args_free(&args);
    return code;
}
