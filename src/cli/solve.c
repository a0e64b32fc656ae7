/* rollbem [OPTION...] [CASE.ini]: solves one case and prints what came out. */
#include "cli/case.h"

#include "rollbem/io.h"
#include "rollbem/report.h"

#include <errno.h>
#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

typedef struct {
    int json, header, quiet, trace;
    const char *output, *plot, *dump;
} output_options;

enum { HEADER_FULL, HEADER_BARE };

static const cli_choice headers[] = {
    {"full", HEADER_FULL}, {"bare", HEADER_BARE}, {NULL, 0}};

#define PLACE(member) offsetof(output_options, member)

static const cli_option options[] = {
    CLI_GROUP_LINE("output", "Output"),
    CLI_FLAG_LINE("json", PLACE(json), "JSON instead of the table"),
    CLI_CHOICE_LINE("header", PLACE(header), headers,
                    "of the table: # lines and column names, or the names alone"),
    CLI_TEXT_LINE("output", PLACE(output), "FILE",
                  "where the table or JSON goes, whole or not at all",
                  .unset = "standard output"),
    CLI_TEXT_LINE("plot", PLACE(plot), "FILE",
                  "picture of tractions, slip and zones: .png, .svg or .pdf (by gnuplot)",
                  .unset = "none"),
    CLI_TEXT_LINE(
        "dump", PLACE(dump), "DIR",
        "mesh, H, G, F, M, b as Matrix Market files; with --trace also tableaux",
        .unset = "none"),
    CLI_FLAG_LINE("trace", PLACE(trace),
                  "every pivot of Lemke's method, on standard error"),
    CLI_FLAG_LINE("quiet", PLACE(quiet), "no summary and no notes on standard error"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves one case of rolling contact, a cylinder A on a body B, by boundary elements "
    "and a\n"
    "linear complementarity problem, and prints the tractions element by element. "
    "Without\n"
    "options: the example of Addi, Adly, Goeleven and Thera (2006).\n"
    "\n"
    "Signs: x to the right, y up; A is above and rolls towards +x, so the leading edge "
    "is at\n"
    "+x. Creepage xi = (V_A - V_B)/|V| > 0: A's surface slides towards +x over the "
    "ground (a\n"
    "braked wheel) and the friction q on A points to -x, Q < 0. Pressure p >= 0.\n"
    "Units: any consistent set; names say mm, MPa and N/mm (loads per unit length).";

static const char notes[] =
    "A case file holds the same names as keys, in the sections named in brackets or in "
    "none;\n"
    "the command line wins over the file.\n"
    "In static contact --shift, --force or --force-ratio loads it and --creep or "
    "--creep-ratio\n"
    "only enter the slip computed afterwards; in steady rolling one of --creep, "
    "--creep-ratio,\n"
    "--force, --force-ratio drives it.\n"
    "Exit codes: 0 solved; 1 not solved (what there is, is printed); 64 wrong values on "
    "the\n"
    "command line, 65 in a file; 66 no such file; 70 internal; 73 cannot write.\n";

/* ---- Output ----------------------------------------------------------------------- */

static rb_status write_json(FILE *out, const cli_case *c, const rb_rolling_solution *s)
{
    json_t *root = rb_report_json_start(cli_command_line());
    json_object_set_new(root, "inputs", cli_case_inputs(c));
    json_object_set_new(root, "summary", rb_report_json_summary(&c->rc, s));
    json_object_set_new(root, "table", rb_report_json_table(s));
    const rb_status status = rb_report_json_write(out, root);
    json_decref(root);
    return status;
}

static cli_exit write_result(rb_io_writer *w, const output_options *o, const cli_case *c,
                             const rb_rolling_solution *s)
{
    rb_message why;
    const rb_status written = o->json ? write_json(w->file, c, s)
                                      : rb_report_table(w->file, s, cli_command_line(),
                                                        o->header == HEADER_BARE);
    if (written != RB_OK) {
        const char *reason =
            written == RB_EWRITE ? strerror(errno) : rb_status_text(written);
        const cli_exit code = cli_fail(cli_exit_of(written), "%s: %s",
                                       o->output ? o->output : "standard output", reason);
        rb_io_writer_abandon(w);
        return code;
    }
    const rb_status s2 = rb_io_writer_commit(w, &why);
    return s2 == RB_OK ? CLI_OK : cli_fail(cli_exit_of(s2), "%s", why.text);
}

static cli_exit draw(const char *path, const cli_case *c, const rb_rolling_solution *s)
{
    rb_report_picture_kind kind;
    rb_io_writer w;
    rb_message why;
    rb_status status = rb_report_picture_kind_of(path, &kind, &why);
    if (status == RB_OK)
        status = rb_io_writer_open(path, &w, &why);
    if (status != RB_OK)
        return cli_fail(cli_exit_of(status), "--plot: %s", why.text);
    status = rb_report_picture(w.file, kind, &c->rc, s, &why);
    if (status == RB_OK) {
        status = rb_io_writer_commit(&w, &why);
        return status == RB_OK ? CLI_OK : cli_fail(cli_exit_of(status), "%s", why.text);
    }
    rb_io_writer_abandon(&w);
    return cli_fail(CLI_INTERNAL, "--plot: %s", why.text);
}

static int terminal_width(void)
{
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
    return 80;
}

static void tell_people(const cli_case *c, const rb_rolling_solution *s)
{
    rb_report_summary(stderr, s, terminal_width());
    rb_report_notes(stderr, &c->rc, s);
}

/* ---- Command ---------------------------------------------------------------------- */

static cli_exit show_behind(const output_options *o, const rb_rolling_model *model)
{
    rb_message why;
    rb_status s = RB_OK;
    if (o->dump)
        s = rb_report_dump(o->dump, model, &why);
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "--dump: %s", why.text);
    if (o->trace)
        s = rb_report_trace(stderr, o->dump, model, &why);
    if (s != RB_OK)
        return cli_fail(cli_exit_of(s), "--trace: %s", why.text);
    return CLI_OK;
}

static cli_exit print_solution(rb_io_writer *w, const output_options *o,
                               const cli_case *c, const rb_rolling_model *model,
                               const rb_rolling_solution *s)
{
    cli_exit code = write_result(w, o, c, s);
    if (code == CLI_OK)
        code = show_behind(o, model);
    if (code == CLI_OK && !o->quiet)
        tell_people(c, s);
    if (code == CLI_OK && o->plot)
        code = draw(o->plot, c, s);
    return code;
}

/* As rb_rolling_solve, the model kept for whoever wants to look behind the solution. */
static rb_status solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                             rb_rolling_solution *s, rb_message *why)
{
    const double start = rb_seconds();
    *s = (rb_rolling_solution){0};
    rb_status status = rb_rolling_model_create(rc, model, why);
    if (status >= 0 && model->state.p) {
        const rb_status t = rb_rolling_model_solution(model, s, why);
        status = t == RB_OK ? status : t;
    }
    if (status == RB_OK && rc->formulation == RB_STEADY && rc->mu > 0.0)
        status = rb_rolling_free_creepage(model, &s->free_creepage, why);
    if (status >= 0)
        s->status = status;
    s->seconds_total = rb_seconds() - start;
    return status;
}

/* Opens the output first: what cannot be written need not be solved. */
static cli_exit solve(const output_options *o, const cli_case *c)
{
    rb_rolling_model model;
    rb_rolling_solution s;
    rb_io_writer w;
    rb_message why = {""};
    rb_status status = rb_io_writer_open(o->output, &w, &why);
    if (status != RB_OK)
        return cli_fail(cli_exit_of(status), "%s", why.text);
    status = solve_model(&c->rc, &model, &s, &why);
    cli_exit code = CLI_OK;
    if (status >= 0 && s.n > 0)
        code = print_solution(&w, o, c, &model, &s);
    else
        rb_io_writer_abandon(&w);
    if (code == CLI_OK && status != RB_OK)
        code = cli_case_refused(c, status, &why);
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
    return code;
}

static cli_exit check_output(const output_options *o)
{
    rb_report_picture_kind kind;
    rb_message why;
    if (o->plot && rb_report_picture_kind_of(o->plot, &kind, &why) != RB_OK)
        return cli_fail(CLI_USAGE, "--plot: %s", why.text);
    return CLI_CONTINUE;
}

int cli_solve(int argc, char **argv)
{
    cli_case c;
    output_options o = {0};
    int given[OPTIONS] = {0};
    cli_args args = {0};
    cli_case_defaults(&c);
    const cli_spec spec = {"rollbem [OPTION...] [CASE.ini]",
                           about,
                           notes,
                           {cli_case_set(&c), {options, OPTIONS, &o, given}},
                           2};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE)
        code = cli_case_finish(&spec, &c, &args);
    if (code == CLI_CONTINUE)
        code = check_output(&o);
    if (o.trace && c.rc.solver == RB_SOLVER_AUTO)
        c.rc.solver = RB_SOLVER_LEMKE; /* the one that pivots */
    if (code == CLI_CONTINUE)
        code = solve(&o, &c);
    cli_args_free(&args);
    cli_case_free(&c);
    return code;
}
