/* rollbem lcp FILE...: complementarity problems and bimatrix games from files. */
#include "program/cli/cli.h"
#include "program/cli/lcp_run.h"
#include "program/cli/output.h"
#include "program/cli/wait.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>

enum { AUTO, LEMKE, LEMKE_SPARSE, NEWTON };

static const rb_choice solvers[] = {{"auto", AUTO},
                                    {"lemke", LEMKE},
                                    {"lemke-sparse", LEMKE_SPARSE},
                                    {"newton", NEWTON},
                                    {NULL, 0}};

static const rb_choice rules[] = {
    {"lexicographic", RB_LCP_LEXICOGRAPHIC}, {"first-index", RB_LCP_FIRST_INDEX}, {NULL, 0}};

#define PLACE(member) offsetof(lcp_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("problem", "Problem"),
    RB_TEXT_LINE("q", PLACE(q), "FILE",
                 "q of a Matrix Market file: n numbers, plain or Matrix Market",
                 .file = RB_FILE_READ),
    RB_TEXT_LINE("lower", PLACE(lower), "FILE", "lower bounds of z: n numbers, as --q; -inf: none",
                 .unset = "zeros", .file = RB_FILE_READ),
    RB_TEXT_LINE("upper", PLACE(upper), "FILE",
                 "upper bounds of z, where w <= 0: n numbers, as --q; inf: none", .unset = "none",
                 .file = RB_FILE_READ),
    RB_FLAG_LINE("game", PLACE(game),
                 "FILE holds a bimatrix game: m, n, the m rows of A, the m rows of B"),
    RB_GROUP_LINE("solver", "Solver"),
    RB_CHOICE_LINE(
        "solver", PLACE(solver), solvers,
        "auto: all methods in turns, first the one that suits the structure of M, then, up to "
        "order 200, branching; lemke: with a tableau; lemke-sparse: with a sparse LU, also for "
        "bounds; newton: see above"),
    RB_NUMBER_LINE("tol", PLACE(tol), "", RB_ABOVE(0.0),
                   "tolerance of the scaled residual: see below"),
    RB_INTEGER_LINE("max-pivots", PLACE(max_pivots), RB_FROM_TO(1, 1e9),
                    "iteration limit of each method",
                    .unset = "lemke 50 n + 1000, newton 10 n + 100, games half a minute"),
    RB_NUMBER_LINE("seconds", PLACE(seconds), "s", RB_ABOVE(0.0), "time limit per file",
                   .unset = "none"),
    RB_TEXT_LINE("start", PLACE(start), "FILE",
                 "z of a similar problem to start from: n numbers, as --q", .unset = "the bounds",
                 .file = RB_FILE_READ),
    RB_FLAG_LINE(
        "all", PLACE(all),
        "all solutions, by trying every complementary basis (order 22 at most); --game: all "
        "extreme equilibria"),
    RB_INTEGER_LINE("label", PLACE(label), RB_FROM_TO(1, 1e9),
                    "--game: the strategy that the path begins with, rows then columns",
                    .unset = "several in turns; 1 with --trace"),
    RB_TEXT_LINE("cover", PLACE(cover), "FILE",
                 "covering vector d >= 0, d > 0 where q < 0: n numbers, as --q", .unset = "ones",
                 .file = RB_FILE_READ),
    RB_CHOICE_LINE("rule", PLACE(rule), rules,
                   "which row leaves when ratios tie; first-index can cycle"),
    RB_FLAG_LINE(
        "prove", PLACE(prove),
        "prove that there is a solution with these signs, and how near it is; or that there "
        "is none; --all: how many there are"),
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("trace", PLACE(trace), "a row per pivot instead of one per file"),
    RB_FLAG_LINE("solution", PLACE(solution),
                 "a row per unknown, z and w = M z + q, instead of one per file"),
    CLI_STYLE_LINES(PLACE(style)),
    CLI_OUTPUT_LINE(PLACE(output)),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves linear complementarity problems z >= 0, w = M z + q >= 0, z'w = 0 by Lemke's method\n"
    "(any matrix) and block principal pivoting (newton: sparse, sure for P-matrices).\n"
    "FILE: plain text: n, the n rows of M, q (# starts a comment), such as\n"
    "    2\n"
    "    2 1   1 2   -5 -6\n"
    "or the text format of Siconos, or M in Matrix Market with q in --q FILE; - is standard "
    "input.\n"
    "With --lower and --upper z lies in a box, w >= 0 at its lower end, <= 0 at its upper one,\n"
    "0 in between. --game: an equilibrium of a bimatrix game by Lemke and Howson's method.";

static const char notes[] =
    "One row per file: its name, status, n, pivots, residual max |min(z, w)| recomputed from z,\n"
    "seconds, scaled residual, the solver that gave the answer. The scaled residual decides: each "
    "row's residual\n"
    "as a part of its own terms |M| |z| + |q|, so that no units of rows and columns change it. "
    "With --trace,\n"
    "--solution or --all these stand in # lines. newton counts linear systems, auto sums those of "
    "all methods that\n"
    "had a turn, --all counts bases. Pivots name the variables w(1) ... w(n), z(1) ... z(n) and "
    "the\n"
    "artificial z0. Of a game z holds the probabilities of the row and then of the column\n"
    "strategies, w what each loses against the best reply; a last column has the label, the "
    "strategy\n"
    "that the path begins with.\n"
    "With --prove a machine-checked proof says that the problem with exactly these numbers has a\n"
    "solution with these signs, and how far the printed z are from it, or that it has none; with "
    "--all\n"
    "how many solutions it has (docs/proof.md).\n"
    "After a file that fails the others are still solved.\n"
    "Status: solved; no-solution: proved; secondary-ray, undecided: none was found, and none is\n"
    "excluded; iteration-limit, time-limit; numerical-failure: there is a solution, which "
    "rounding\n"
    "errors hide; residual-above-tolerance; singular-matrix (newton).\n"
    "Exit codes, the largest of all files: 0 solved; 1 not solved; 64 wrong command line; 65 "
    "malformed file; 66 no such file;\n"
    "70 internal; 73 cannot write.\n";

/* ---- One file ---------------------------------------------------------------------- */

static void free_result(lcp_result *r)
{
    rb_lcp_proof_free(&r->proof);
    rb_lcp_number_free(&r->number);
    rb_sparse_free(&r->M);
    free(r->lower);
    free(r->upper);
    free(r->cover);
    free(r->start);
    free(r->singular_basis);
    free(r->nearby);
    free(r->set);
    free(r->member);
    free(r->z);
    free(r->w);
}

/* One file: solved, and printed as one row, or with a row per pivot or per unknown. */
static cli_exit solve_file(void *context, const char *path)
{
    lcp_run *run = context;
    lcp_result r = {.file = path,
                    .solver = run->o->game ? "lemke-howson" : "lemke",
                    .info = {.res = NAN, .scaled = NAN, .row = -1, .label = -1},
                    .floor = NAN,
                    .seconds = NAN,
                    .solutions = 1};
    run->file = path;
    run->pivots = (cli_rows){.is_json = 1, .list = json_array()};
    /* Rows of a trace are progress enough. */
    if (!run->o->trace)
        cli_wait_begin();
    const cli_exit code = run->o->game ? cli_lcp_solve_game(run, &r) : cli_lcp_solve(run, &r);
    if (!run->o->trace)
        cli_wait_end();
    const int known = cli_lcp_is_known(&r);
    char proof[60] = "-";
    if (r.proof.n)
        rb_report_proof_status(&r.proof, proof, sizeof proof);
    /* One list of values for both forms: the first name is that in JSON, the second one that of the
     * column; NULL: not there. */
    const cli_value values[] = {
        CLI_TEXT("file", "file", r.file),
        CLI_TEXT("solver", "solver", r.solver),
        CLI_WORDS("status", "status", r.status),
        CLI_KNOWN("contacts", NULL, 0, 0), /* as of `friction` */
        CLI_KNOWN("dimension", "n", r.n, known),
        CLI_KNOWN("iterations", "pivots", r.info.iters, known),
        CLI_NUMBER("residual", "residual", r.info.res),
        CLI_NUMBER("scaled_residual", "scaled", r.info.scaled),
        CLI_NUMBER("floor", NULL, r.floor),
        CLI_NUMBER("seconds", "seconds", r.seconds),
        CLI_KNOWN(NULL, "label", r.info.label + 1, r.info.label >= 0),
        CLI_WORDS(NULL, "proof", proof),
        CLI_NUMBER(NULL, "within", r.proof.proved ? r.proof.stored_within : NAN)};
    enum { VALUES = sizeof values / sizeof *values };
    cli_rows *rows = &run->files.rows;
    if (rows->is_json) {
        cli_rows_add(rows, VALUES, values);
        cli_lcp_add_members(run, rows, &r);
    } else if (known && (run->o->trace || run->o->solution || run->o->all))
        cli_lcp_list_unknowns(run, rows, &r);
    else if (known)
        cli_rows_add(rows, VALUES, values);
    json_decref(run->pivots.list);
    free_result(&r);
    return code;
}

/* ---- Command ---------------------------------------------------------------------- */

static const char conventions[] =
    "z >= 0, w = M z + q >= 0, z'w = 0; bounds: w >= 0 at the lower, <= 0 at the upper one; games: "
    "z probabilities, w the loss of a strategy";

/* Options that ask for what the other method does. */
static cli_exit check_options(const lcp_options *o)
{
    const int path = o->trace || o->cover || o->rule;
    const int vectors = o->lower || o->upper || o->start || o->cover;
    if (o->solver == NEWTON && path)
        return cli_fail(
            CLI_USAGE,
            "lcp: --trace, --cover and --rule belong to Lemke's method: not with --solver newton");
    if (o->trace && o->solution && o->style.format != RB_REPORT_JSON)
        return cli_fail(
            CLI_USAGE,
            "lcp: --trace and --solution are two tables: one of them, or both with --json");
    if (o->all && (path || o->start || o->solver || o->max_pivots))
        return cli_fail(CLI_USAGE, "lcp: --all tries every basis: not with --solver, --start, "
                                   "--cover, --rule, --trace or --max-pivots");
    if (o->game && (vectors || o->q || o->solver || o->rule))
        return cli_fail(CLI_USAGE, "lcp: --game reads A and B alone: not with --q, --lower, "
                                   "--upper, --start, --cover, --solver or --rule");
    if (o->label && (!o->game || o->all))
        return cli_fail(CLI_USAGE, "lcp: --label belongs to Lemke and Howson's method: only with "
                                   "--game and without --all");
    return CLI_CONTINUE;
}

int cli_lcp(int argc, char **argv)
{
    lcp_options o = {.tol = 1e-10};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem lcp [OPTION...] FILE...",
                           .about = about,
                           .notes = notes,
                           .sets = {{options, OPTIONS, &o, NULL, NULL}},
                           .set_n = 1};
    /* Everything about the command line is refused before the first file is read. */
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands < 1)
        code = cli_fail(CLI_USAGE, "lcp: expected at least one FILE");
    if (code == CLI_CONTINUE)
        code = check_options(&o);
    if (code == CLI_CONTINUE && o.q && args.operands > 1)
        code = cli_fail(CLI_USAGE, "lcp: --q goes with one FILE, got %d", args.operands);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE) {
        /* The headings depend on what a row is: a pivot, an unknown or a file. */
        char columns[120];
        snprintf(columns, sizeof columns, "%s%s%s",
                 o.trace      ? "file pivot entering leaving row ratio z0"
                 : o.all      ? "file solution i z w"
                 : o.solution ? "file i z w"
                              : "file status n pivots residual seconds scaled solver",
                 o.game && !(o.trace || o.all || o.solution) ? " label" : "",
                 !o.prove || o.trace   ? ""
                 : o.solution || o.all ? " within"
                                       : " proof within");
        lcp_run run = {.files = {.style = &o.style,
                                 .columns = columns,
                                 .conventions = conventions,
                                 .solve = solve_file,
                                 .context = &run},
                       .o = &o,
                       .solver = solvers[o.solver].name};
        code = cli_solve_problems(&run.files, &args, o.output);
    }
    cli_args_free(&args);
    return code;
}
