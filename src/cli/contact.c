/* rollbem contact FILE.inp: the two-dimensional cases of an input file of CONTACT. */
#include "cli/cli.h"
#include "cli/output.h"
#include "cli/rows.h"
#include "cli/wait.h"
#include "rollbem/case.h"

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
    "could be run, or one was not solved; 65 malformed file; 66 no such file.\n";

typedef struct {
    const rb_io_contact_case *in;
    rb_case_contact c;
    const rb_rolling_solution *before; /* of the case before; NULL: none */
    rb_rolling_solution s;             /* n = 0: not run */
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

/* A case: its row of the table and its object. */
typedef struct {
    int number;
    const char *status, *left_out;
    double FN, FX, FX_REL, CKSI, PEN, PMAX, FRIC_POWER, NPOT, NCON, NADH, NSLIP, P, Q, line,
        residual, NPLAST;
} case_row;

#define ROW(name, column, kind, member) CLI_ROW(case_row, name, column, kind, member)
#define NUMBER(name, member) ROW(name, name, NUMBER, member)

static const cli_row case_rows[] = {ROW("case", "case", WHOLE, number),
                                    ROW("status", "status", WORDS, status),
                                    ROW("left_out", NULL, TEXT, left_out),
                                    NUMBER("FN", FN),
                                    NUMBER("FX", FX),
                                    NUMBER("FX_REL", FX_REL),
                                    NUMBER("CKSI", CKSI),
                                    NUMBER("PEN", PEN),
                                    NUMBER("PMAX", PMAX),
                                    NUMBER("FRIC_POWER", FRIC_POWER),
                                    NUMBER("NPOT", NPOT),
                                    NUMBER("NCON", NCON),
                                    NUMBER("NADH", NADH),
                                    NUMBER("NSLIP", NSLIP),
                                    NUMBER("P_N/mm", P),
                                    NUMBER("Q_N/mm", Q),
                                    NUMBER("line", line),
                                    NUMBER("residual", residual),
                                    NUMBER("NPLAST", NPLAST)};

#undef ROW
#undef NUMBER

enum { CASE_ROWS = sizeof case_rows / sizeof *case_rows };

static const char columns[] = "case status FN FX FX_REL CKSI PEN PMAX FRIC_POWER NPOT NCON NADH "
                              "NSLIP P_N/mm Q_N/mm line residual NPLAST";

/* An element of a case, in the table alone. */
typedef struct {
    int number, zone;
    double X, H, PN, PX, S, UPL;
} element_row;

#define COLUMN(kind, column, member) CLI_ROW(element_row, NULL, column, kind, member)

static const cli_row element_rows[] = {COLUMN(WHOLE, "case", number), COLUMN(NUMBER, "X", X),
                                       COLUMN(NUMBER, "H", H),        COLUMN(NUMBER, "PN", PN),
                                       COLUMN(NUMBER, "PX", PX),      COLUMN(NUMBER, "S", S),
                                       COLUMN(WHOLE, "zone", zone),   COLUMN(NUMBER, "UPL", UPL)};

enum { ELEMENT_ROWS = sizeof element_rows / sizeof *element_rows };

static const char element_columns[] = "case X H PN PX S zone UPL";

/* x + 0.0: no -0; NAN where the case was not run. */
static case_row case_row_of(const contact_runs *all, int k)
{
    const contact_run *r = &all->run[k];
    const rb_rolling_solution *s = &r->s;
    const rb_io_contact_case *in = r->in;
    const double known = s->n > 0 ? 0.0 : NAN, sign = r->c.sign, width = r->c.width;
    const int yielding = s->yielding > 0 ? s->yielding : 0;
    return (case_row){.number = k + 1,
                      .status = r->c.runs ? rb_status_text(r->status) : "not run",
                      .left_out = r->c.left_out,
                      .FN = s->normal_load * width + known,
                      .FX = sign * s->tangential_load * width + known,
                      .FX_REL = sign * s->force_ratio + known,
                      .CKSI = sign * (in->digit.T >= 2 ? s->creepage : s->tangential_shift) + known,
                      .PEN = s->approach + known,
                      .PMAX = s->max_pressure + known,
                      .FRIC_POWER = rb_case_contact_power(in, &r->c, r->before, s) + known,
                      .NPOT = s->n + known,
                      .NCON = s->contact + known,
                      .NADH = s->stick + known,
                      .NSLIP = s->slipping - yielding + known,
                      .P = s->normal_load + known,
                      .Q = s->tangential_load + known,
                      .line = in->line + known,
                      .residual = s->residual + known,
                      .NPLAST = yielding + known};
}

static rb_status print(FILE *out, const void *context, rb_message *why)
{
    const contact_runs *all = context;
    (void)why;
    if (all->o->style.format != RB_REPORT_JSON) {
        const char *names = all->o->tractions ? element_columns : columns;
        rb_report_cells cells = rb_report_cells_begin(out, &all->o->style, names);
        rb_report_comment_origin(&cells, cli_command_line());
        for (int k = 0; k < all->n; k++)
            if (all->run[k].c.left_out[0])
                rb_report_comment(&cells, "case %d leaves out %s", k + 1, all->run[k].c.left_out);
        for (int k = 0; k < all->n; k++) {
            const rb_rolling_solution *s = &all->run[k].s;
            const case_row row = case_row_of(all, k);
            if (!all->o->tractions)
                cli_rows_cells(&cells, names, CASE_ROWS, case_rows, &row);
            for (int j = 0; all->o->tractions && j < s->n; j++) {
                const rb_case_contact *c = &all->run[k].c;
                const int i = c->sign < 0.0 ? s->n - 1 - j : j;
                const element_row element = {.number = k + 1,
                                             .X = c->centre + c->sign * s->x[i],
                                             .H = s->gap[i],
                                             .PN = s->p[i],
                                             .PX = c->sign * s->q[i] + 0.0,
                                             .S = c->sign * s->slip[i] + 0.0,
                                             .zone = s->zone[i],
                                             .UPL = s->plastic ? s->plastic[i] : 0.0};
                cli_rows_cells(&cells, names, ELEMENT_ROWS, element_rows, &element);
            }
        }
        return rb_report_flush(out);
    }
    json_t *root = rb_report_json_start(cli_command_line()), *cases = json_array();
    for (int k = 0; k < all->n; k++) {
        const case_row row = case_row_of(all, k);
        json_t *one = cli_rows_json(CASE_ROWS, case_rows, &row, 1);
        if (all->o->tractions && all->run[k].s.n > 0)
            rb_report_json_set(&one, "table", rb_report_json_table(&all->run[k].s));
        rb_report_json_append(&cases, one);
    }
    rb_report_json_set(&root, "file", rb_report_json_text(all->path));
    rb_report_json_set(&root, "cases", cases);
    return rb_report_json_write(out, root);
}

/* ---- Command ----------------------------------------------------------------------- */

int cli_contact(int argc, char **argv)
{
    contact_options o = {0};
    cli_args args = {0};
    const cli_spec spec = {"rollbem contact [OPTION...] FILE.inp",
                           about,
                           notes,
                           {{options, OPTIONS, &o, NULL, NULL}},
                           1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands != 1)
        code = cli_fail(CLI_USAGE, "contact: expected one FILE.inp, got %d files", args.operands);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    contact_runs all = {.o = &o};
    rb_io_contact_case *cases = NULL;
    cli_exit worst = CLI_OK;
    int ran = 0;
    if (code == CLI_CONTINUE) {
        rb_message why = {""};
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
        for (int k = 0; k < all.n; k++) {
            contact_run *r = &all.run[k];
            r->before = k > 0 ? &all.run[k - 1].s : NULL;
            rb_case_contact_follow(k > 0 ? &all.run[k - 1].c : NULL, r->before, &r->c);
            if (!r->c.runs)
                continue;
            ran++;
            cli_wait_begin();
            r->status = rb_case_contact_solve(&r->c, r->before, &r->s, &r->why);
            cli_wait_end();
            if (r->status != RB_OK) {
                const cli_exit one = r->status == RB_EINVAL ? CLI_DATA : cli_exit_of(r->status);
                cli_fail(one, "%s:%d: case %d: %s", all.path, r->in->line, k + 1,
                         rb_status_reason(r->status, &r->why));
                worst = one > worst ? one : worst;
            }
        }
        for (int k = 0; k < all.n; k++) {
            /* What is left out of a case, each reason at its first case only. */
            const contact_run *r = &all.run[k];
            int as_before = 0;
            for (int j = 0; j < k && !as_before; j++)
                as_before = all.run[j].c.runs == r->c.runs &&
                            strcmp(all.run[j].c.left_out, r->c.left_out) == 0;
            if (r->c.left_out[0] && !all.o->quiet && !as_before) {
                int alike = 0;
                for (int j = k + 1; j < all.n; j++)
                    alike += all.run[j].c.runs == r->c.runs &&
                             strcmp(all.run[j].c.left_out, r->c.left_out) == 0;
                char more[40] = "";
                if (alike > 0)
                    snprintf(more, sizeof more, ", and %d more case%s", alike,
                             alike > 1 ? "s" : "");
                cli_fail(CLI_OK,
                         r->c.runs ? "%s:%d: case %d%s solved without %s"
                                   : "%s:%d: case %d%s skipped: %s is not supported",
                         all.path, r->in->line, k + 1, more, r->c.left_out);
            }
        }
        code = cli_write_file(all.o->output, print, &all);
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
