/* rollbem lcp FILE...: Lemke's method on problems from files. */
#include "cli/cli.h"
#include "cli/output.h"

#include "rollbem/io.h"
#include "rollbem/lcp.h"
#include "rollbem/report.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>

typedef struct {
    double tol;
    int solver, max_pivots, rule, trace, solution;
    rb_report_style style;
    const char *q, *cover, *output;
} lcp_options;

enum { AUTO, LEMKE, NEWTON };

static const rb_choice solvers[] = {
    {"auto", AUTO}, {"lemke", LEMKE}, {"newton", NEWTON}, {NULL, 0}};

/* Of this order on a matrix that is stored sparse is solved without a dense tableau. */
enum { LARGE = 500 };

static const rb_choice rules[] = {{"lexicographic", RB_LCP_LEXICOGRAPHIC},
                                  {"first-index", RB_LCP_FIRST_INDEX},
                                  {NULL, 0}};

#define PLACE(member) offsetof(lcp_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("problem", "Problem"),
    RB_TEXT_LINE("q", PLACE(q), "FILE",
                 "q of a Matrix Market file: n numbers, plain or Matrix Market",
                 .file = RB_FILE_READ),
    RB_GROUP_LINE("solver", "Solver"),
    RB_CHOICE_LINE(
        "solver", PLACE(solver), solvers,
        "auto: newton on sparse matrices of order 500 and more, lemke otherwise "
        "and where newton fails"),
    RB_NUMBER_LINE("tol", PLACE(tol), "", RB_ABOVE(0.0),
                   "residual that counts as solved, as a part of max |q|"),
    RB_INTEGER_LINE("max-pivots", PLACE(max_pivots), RB_FROM_TO(1, 1e9),
                    "iteration limit", .unset = "lemke 50 n + 1000, newton 10 n + 100"),
    RB_TEXT_LINE("cover", PLACE(cover), "FILE",
                 "covering vector d >= 0, d > 0 where q < 0: n numbers, as --q",
                 .unset = "ones", .file = RB_FILE_READ),
    RB_CHOICE_LINE("rule", PLACE(rule), rules,
                   "which row leaves when ratios tie; first-index can cycle"),
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("trace", PLACE(trace), "a row per pivot instead of one per file"),
    RB_FLAG_LINE("solution", PLACE(solution),
                 "a row per unknown, z and w = M z + q, instead of one per file"),
    CLI_STYLE_LINES(PLACE(style)),
    RB_TEXT_LINE("output", PLACE(output), "FILE",
                 "where the table or JSON goes, whole or not at all",
                 .unset = "standard output", .file = RB_FILE_WRITTEN),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves linear complementarity problems z >= 0, w = M z + q >= 0, z'w = 0 by Lemke's "
    "method\n"
    "(any matrix, dense) or block principal pivoting (newton: sparse, sure for "
    "P-matrices).\n"
    "FILE: plain text: n, the n rows of M, q (# starts a comment), such as\n"
    "    2\n"
    "    2 1   1 2   -5 -6\n"
    "or the text format of Siconos, or M in Matrix Market with q in --q FILE; - is "
    "standard "
    "input.";

static const char notes[] =
    "One row per file: its name, status, n, pivots, residual max |min(z, w)| recomputed "
    "from z,\n"
    "seconds; with --trace or --solution these stand in # lines. newton counts linear "
    "systems. Pivots name the variables w(1) ... w(n), "
    "z(1) ... z(n) and the artificial "
    "z0.\n"
    "After a file that fails the others are still solved.\n"
    "Exit codes, the largest of all files: 0 solved; 1 secondary ray, iteration limit or "
    "residual\n"
    "above the tolerance; 64 wrong command line; 65 malformed file; 66 no such file; 70 "
    "internal;\n"
    "73 cannot write.\n";

typedef struct {
    const lcp_options *o;
    rb_report_cells cells;
    const char *file; /* at hand */
    json_t *problems,
        *pivots; /* JSON only, NULL without memory; pivots of the file at hand */
} lcp_run;

typedef struct {
    const char *file, *status, *solver;
    int n; /* 0: not read */
    rb_lcp_info info;
    double floor, seconds;
    rb_sparse M;           /* owned */
    const double *q;       /* borrowed */
    double *cover, *z, *w; /* owned; cover NULL: ones */
} lcp_result;

static int is_json(const lcp_options *o)
{
    return o->style.format == RB_REPORT_JSON;
}

/* ---- Trace ------------------------------------------------------------------------ */

static const char *variable(int n, int v, char room[24])
{
    if (v == 2 * n)
        return "z0";
    snprintf(room, 24, "%c(%d)", v < n ? 'w' : 'z', v % n + 1);
    return room;
}

static void trace(const rb_lcp_pivot *p, void *context)
{
    lcp_run *run = context;
    char in[24], out[24];
    const char *entering = variable(p->n, p->entering, in);
    const char *leaving = variable(p->n, p->leaving, out);
    if (is_json(run->o))
        rb_report_json_append(&run->pivots,
                              json_pack("{s:s, s:s, s:i, s:o, s:o}", "entering", entering,
                                        "leaving", leaving, "row", p->row + 1, "ratio",
                                        rb_report_json_number(p->ratio), "z0",
                                        rb_report_json_number(p->z0)));
    else {
        rb_report_cell_text(&run->cells, run->file);
        rb_report_cell_whole(&run->cells, p->pivot + 1);
        rb_report_cell_text(&run->cells, entering);
        rb_report_cell_text(&run->cells, leaving);
        rb_report_cell_whole(&run->cells, p->row + 1);
        rb_report_cell_number(&run->cells, p->ratio);
        rb_report_cell_number(&run->cells, p->z0);
        rb_report_cells_end_row(&run->cells);
    }
}

/* ---- Output ----------------------------------------------------------------------- */

static json_t *vector(int n, const double *x)
{
    return x ? rb_report_json_numbers(n, x) : json_null();
}

static void add_problem(lcp_run *run, const lcp_result *r)
{
    const int known = r->n > 0;
    json_t *p = json_object();
    rb_report_json_set(&p, "file", rb_report_json_text(r->file));
    rb_report_json_set(&p, "solver", json_string(r->solver));
    rb_report_json_set(&p, "status", json_string(r->status));
    rb_report_json_set(&p, "contacts", json_null());
    rb_report_json_set(&p, "dimension", known ? json_integer(r->n) : json_null());
    rb_report_json_set(&p, "iterations",
                       known ? json_integer(r->info.iters) : json_null());
    rb_report_json_set(&p, "residual", rb_report_json_number(r->info.res));
    rb_report_json_set(&p, "floor", rb_report_json_number(r->floor));
    rb_report_json_set(&p, "seconds", rb_report_json_number(r->seconds));
    if (run->o->solution) {
        rb_report_json_set(&p, "z", vector(r->n, r->z));
        rb_report_json_set(&p, "w", vector(r->n, r->w));
    }
    if (run->o->trace)
        rb_report_json_set(&p, "pivots", json_incref(run->pivots));
    rb_report_json_append(&run->problems, p);
}

/* The row of a file, or its # line where the rows are pivots or unknowns. */
static void print_problem(lcp_run *run, const lcp_result *r)
{
    rb_report_cells *c = &run->cells;
    if (!r->n)
        return;
    if (run->o->trace || run->o->solution) {
        rb_report_comment(c, "%s: %s, n = %d, %d pivots, residual %.3g, %.3g s", r->file,
                          r->status, r->n, r->info.iters, r->info.res, r->seconds);
    } else {
        rb_report_cell_text(c, r->file);
        rb_report_cell_words(c, r->status);
        rb_report_cell_whole(c, r->n);
        rb_report_cell_whole(c, r->info.iters);
        rb_report_cell_number(c, r->info.res);
        rb_report_cell_number(c, r->seconds);
        rb_report_cells_end_row(c);
    }
    for (int i = 0; i < r->n && run->o->solution && r->z; i++) {
        rb_report_cell_text(c, r->file);
        rb_report_cell_whole(c, i + 1);
        rb_report_cell_number(c, r->z[i]);
        rb_report_cell_number(c, r->w[i]);
        rb_report_cells_end_row(c);
    }
}

/* ---- One file --------------------------------------------------------------------- */

/* What rounding of the data allows at least: 1e-14 max (|M| z + |q|). */
static double rounding_floor(const lcp_result *r)
{
    double *size = rb_alloc((size_t)r->n, 1), floor = NAN;
    if (!size)
        return floor;
    for (int i = 0; i < r->n; i++)
        size[i] = fabs(r->q[i]);
    for (int j = 0; j < r->n; j++)
        for (int k = r->M.p[j]; k < r->M.p[j + 1]; k++)
            size[r->M.i[k]] += fabs(r->M.x[k]) * r->z[j];
    floor = 1e-14 * rb_norm_inf((size_t)r->n, size);
    free(size);
    return floor;
}

/* "solved" is what the recomputed residual says, not the method. */
static cli_exit judge(const lcp_options *o, lcp_result *r, rb_status s)
{
    const double size = rb_norm_inf((size_t)r->n, r->q);
    r->status = rb_status_text(s);
    if (s != RB_OK)
        return CLI_UNSOLVED;
    if (r->info.res <= o->tol * size)
        return CLI_OK;
    r->status =
        r->info.res <= r->floor ? "solved-to-rounding" : rb_status_text(RB_INACCURATE);
    return r->info.res <= r->floor ? CLI_OK : CLI_UNSOLVED;
}

static cli_exit failed(lcp_result *r, rb_status s, const char *text)
{
    r->status = rb_status_text(s);
    r->n = 0;
    return cli_fail(cli_exit_of(s), "%s", text[0] ? text : rb_status_text(s));
}

static rb_status run_lemke(lcp_run *run, rb_io_matrix *M, lcp_result *r)
{
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = run->o->max_pivots;
    opt.rule = (rb_lcp_rule)run->o->rule;
    opt.cover = r->cover;
    opt.trace = run->o->trace ? trace : NULL;
    opt.trace_context = run;
    if (rb_io_matrix_to_dense(M) != RB_OK)
        return rb_fail(&r->info.msg, RB_ENOMEM,
                       "lcp: no memory for a dense matrix of order %d", r->n);
    return rb_lcp_lemke(r->n, M->dense, r->n, r->q, &opt, r->z, &r->info);
}

static int wants_newton(const lcp_options *o, const rb_io_matrix *M)
{
    const int of_lemke = o->trace || o->cover || o->rule != RB_LCP_LEXICOGRAPHIC;
    return o->solver == NEWTON ||
           (o->solver == AUTO && !M->dense && M->rows >= LARGE && !of_lemke);
}

static cli_exit run_solver(lcp_run *run, rb_io_matrix *M, lcp_result *r)
{
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = run->o->max_pivots;
    const double start = rb_seconds();
    const int newton = wants_newton(run->o, M);
    rb_status s = RB_OK;
    if (newton) {
        r->solver = "newton";
        s = rb_lcp_newton(&r->M, r->q, &opt, r->z, &r->info);
    }
    if (!newton || (s > 0 && run->o->solver == AUTO)) {
        r->solver = "lemke";
        s = run_lemke(run, M, r);
    }
    r->seconds = rb_seconds() - start;
    if (s < 0) { /* RB_EINVAL: the numbers are of a file */
        rb_message why;
        rb_fail(&why, s, "%s: %s", r->file, r->info.msg.text);
        return failed(r, s == RB_EINVAL ? RB_EFORMAT : s, why.text);
    }
    r->info.res = rb_lcp_residual_sparse(&r->M, r->q, r->z, r->w);
    r->floor = rounding_floor(r);
    const cli_exit code = judge(run->o, r, s);
    if (s == RB_MAXITER)
        cli_fail(code, "%s: no solution after --max-pivots %d", r->file, r->info.iters);
    else if (code != CLI_OK)
        cli_fail(code, "%s: %s", r->file, s == RB_OK ? r->status : r->info.msg.text);
    return code;
}

static cli_exit solve_problem(lcp_run *run, rb_io_lcp *p, lcp_result *r)
{
    r->n = p->n;
    r->z = rb_alloc((size_t)p->n, 1);
    r->w = rb_alloc((size_t)p->n, 1);
    if (rb_io_matrix_to_sparse(&p->M, &r->M) != RB_OK || !r->z || !r->w)
        return failed(r, RB_ENOMEM, "out of memory");
    r->q = p->q;
    return run_solver(run, &p->M, r);
}

static cli_exit solve_file(lcp_run *run, const char *path)
{
    rb_io_lcp p;
    rb_message why;
    lcp_result r = {.file = path,
                    .solver = "lemke",
                    .info = {.res = NAN},
                    .floor = NAN,
                    .seconds = NAN};
    cli_exit code;
    run->file = path;
    run->pivots = is_json(run->o) && run->o->trace ? json_array() : NULL;
    rb_status s = rb_io_lcp_read(path, run->o->q, &p, &why);
    if (s == RB_OK && run->o->cover)
        s = rb_io_vector_read(run->o->cover, p.n, "cover", &r.cover, &why);
    if (s == RB_OK)
        code = solve_problem(run, &p, &r);
    else
        code = failed(&r, s, why.text);
    if (is_json(run->o))
        add_problem(run, &r);
    else
        print_problem(run, &r);
    json_decref(run->pivots);
    rb_sparse_free(&r.M);
    free(r.cover);
    free(r.z);
    free(r.w);
    rb_io_lcp_free(&p);
    return code;
}

/* ---- Command ---------------------------------------------------------------------- */

static const char *columns_of(const lcp_options *o)
{
    return o->trace      ? "file pivot entering leaving row ratio z0"
           : o->solution ? "file i z w"
                         : "file status n pivots residual seconds";
}

static const char conventions[] = "z >= 0, w = M z + q >= 0, z'w = 0";

typedef struct {
    const lcp_options *o;
    const cli_args *args;
    cli_exit *worst;
} lcp_files;

static rb_status solve_files(FILE *out, const void *context, rb_message *why)
{
    const lcp_files *all = context;
    lcp_run run = {.o = all->o};
    (void)why;
    if (is_json(all->o)) {
        run.problems = json_array();
    } else {
        run.cells = rb_report_cells_begin(out, &all->o->style, columns_of(all->o));
        rb_report_comment_origin(&run.cells, cli_command_line());
    }
    for (int i = 0; i < all->args->operands; i++) {
        const cli_exit code = solve_file(&run, all->args->operand[i]);
        *all->worst = code > *all->worst ? code : *all->worst;
    }
    return is_json(all->o) ? cli_write_problems(out, conventions, run.problems) : RB_OK;
}

int cli_lcp(int argc, char **argv)
{
    lcp_options o = {.tol = 1e-10};
    cli_args args = {0};
    const cli_spec spec = {"rollbem lcp [OPTION...] FILE...",
                           about,
                           notes,
                           {{options, OPTIONS, &o, NULL}},
                           1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands < 1)
        code = cli_fail(CLI_USAGE, "lcp: expected at least one FILE");
    if (code == CLI_CONTINUE && o.solver == NEWTON && (o.trace || o.cover || o.rule))
        code = cli_fail(
            CLI_USAGE,
            "lcp: --trace, --cover and --rule are Lemke's: not with --solver newton");
    if (code == CLI_CONTINUE && o.trace && o.solution && !is_json(&o))
        code = cli_fail(CLI_USAGE, "lcp: --trace and --solution are two tables: one of "
                                   "them, or both with --json");
    if (code == CLI_CONTINUE && o.q && args.operands > 1)
        code = cli_fail(CLI_USAGE, "lcp: --q goes with one FILE, got %d", args.operands);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE) {
        cli_exit worst = CLI_OK;
        const lcp_files all = {&o, &args, &worst};
        code = cli_write_file(o.output, solve_files, &all);
        code = code == CLI_OK ? worst : code;
    }
    cli_args_free(&args);
    return code;
}
