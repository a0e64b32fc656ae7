/* rollbem lcp FILE...: complementarity problems and bimatrix games from files. */
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "program/cli/wait.h"

#include "base/io/io.h"
#include "lcp/lcp.h"
#include "program/report/report.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>

typedef struct {
    double tol, seconds;
    int game, solver, all, label, max_pivots, rule, trace, solution, prove;
    rb_report_style style;
    const char *q, *lower, *upper, *cover, *start, *output;
} lcp_options;

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

typedef struct {
    cli_problems files;
    const lcp_options *o;
    const char *file; /* the current file */
    cli_rows pivots;  /* of it, for JSON alone */
} lcp_run;

typedef struct {
    const char *file, *status, *solver;
    int n; /* 0: not read */
    rb_lcp_info info;
    double floor, seconds;
    rb_sparse M;                           /* owned, as the vectors */
    rb_lcp_mixed_problem boxed;            /* borrows M, lower, upper, and q of the file */
    double *lower, *upper, *cover, *start; /* n each, or NULL */
    double *z, *w;                         /* n x solutions */
    int solutions;                         /* 1 but for --all */
    int singular, undecided;               /* --all: bases */
    int *singular_basis, *nearby;          /* --all: of each solution, or NULL; owned */
    int sets, *set, *member;               /* --game --all: as of rb_lcp_solutions; owned */
    double payoff[2];                      /* --game, the first solution */
    rb_lcp_proof proof;                    /* --prove, of one solution; owned */
    int is_counted;                        /* 1: --all --prove has run: */
    rb_lcp_number number;                  /* owned */
    int is_empty;                          /* 1: n = 0, which is solved */
} lcp_result;

/* ---- Trace ------------------------------------------------------------------------ */

static const char *variable(int n, int v, char buffer[24])
{
    if (v == 2 * n)
        return "z0";
    snprintf(buffer, 24, "%c(%d)", v < n ? 'w' : 'z', v % n + 1);
    return buffer;
}

static void trace(const rb_lcp_pivot *p, void *context)
{
    lcp_run *run = context;
    char in[24], out[24];
    const cli_value values[] = {CLI_TEXT(NULL, "file", run->file),
                                CLI_WHOLE(NULL, "pivot", p->pivot + 1),
                                CLI_TEXT("entering", "entering", variable(p->n, p->entering, in)),
                                CLI_TEXT("leaving", "leaving", variable(p->n, p->leaving, out)),
                                CLI_WHOLE("row", "row", p->row + 1),
                                CLI_NUMBER("ratio", "ratio", p->ratio),
                                CLI_NUMBER("z0", "z0", p->z0)};
    cli_rows_add(run->files.rows.is_json ? &run->pivots : &run->files.rows,
                 sizeof values / sizeof *values, values);
}

static json_t *vector(int n, const double *x)
{
    return x ? rb_report_json_numbers(n, x) : json_null();
}

/* ---- A problem --------------------------------------------------------------------- */

/* A scaled residual that rounding leaves. */
static const double ROUNDING = 1e-14;

static cli_exit failed(lcp_result *r, rb_status s, const rb_message *why)
{
    r->status = rb_status_text(s);
    r->n = 0;
    return cli_fail(cli_exit_of(s), "%s", rb_status_reason(s, why));
}

static rb_lcp_options solver_options(lcp_run *run, const lcp_result *r)
{
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = run->o->max_pivots;
    opt.seconds = run->o->seconds;
    opt.rule = (rb_lcp_rule)run->o->rule;
    opt.cover = r->cover;
    opt.start = r->start;
    opt.trace = run->o->trace ? trace : NULL;
    opt.trace_context = run;
    return opt;
}

/* The numbers are of a file: RB_EINVAL is its fault. */
static cli_exit invalid(lcp_result *r, rb_status s, const rb_message *msg)
{
    rb_message why = {.text = ""};
    rb_fail(&why, s, "%s: %s", r->file, msg->text);
    return failed(r, s == RB_EINVAL ? RB_EFORMAT : s, &why);
}

/* "solved" is what the recomputed residual says, not the method. */
static cli_exit say_end(const lcp_options *o, lcp_result *r, rb_status s)
{
    cli_exit code = s == RB_OK ? CLI_OK : CLI_UNSOLVED;
    r->status = rb_status_text(s);
    if (s == RB_OK && r->info.scaled > o->tol && r->info.scaled <= ROUNDING)
        r->status = "solved-to-rounding";
    else if (s == RB_OK && !(r->info.scaled <= o->tol)) {
        code = CLI_UNSOLVED;
        r->status = rb_status_text(RB_INACCURATE);
        rb_fail(&r->info.msg, RB_INACCURATE,
                "the residual of row %d is %.2g of its terms, above --tol %g", r->info.row + 1,
                r->info.scaled, o->tol);
    }
    if (s == RB_MAXITER)
        cli_fail(code, "%s: no solution after --max-pivots %d", r->file,
                 o->max_pivots ? o->max_pivots : r->info.iters);
    else if (code != CLI_OK)
        cli_fail(code, "%s: %s", r->file, r->info.msg.text);
    return code;
}

/* What is proved of z, on standard error; s: of rb_lcp_prove. */
static cli_exit say_proof(lcp_result *r, rb_status s, cli_exit code)
{
    char text[400];
    if (s < 0)
        return invalid(r, s, &(rb_message){.text = "out of memory"});
    fprintf(stderr, "rollbem: %s: %s\n", r->file,
            rb_report_proof_text(&r->proof, text, sizeof text));
    return code;
}

/* How many solutions there are; s: of rb_lcp_prove_number. */
static cli_exit say_number(lcp_result *r, rb_status s, cli_exit code)
{
    char text[400];
    if (s == RB_INTERRUPTED || s < 0)
        return failed(r, s, &(rb_message){.text = ""});
    r->is_counted = 1;
    fprintf(stderr, "rollbem: %s: %s%s\n", r->file,
            rb_report_number_text(&r->number, text, sizeof text),
            s == RB_TIME_LIMIT ? " (time limit)" : "");
    return code;
}

/* ---- All solutions ----------------------------------------------------------------- */

/* What the enumeration has found, and what it could not decide.  end: RB_OK, RB_TIME_LIMIT. */
static cli_exit say_all(const lcp_options *o, lcp_result *r, const rb_lcp_solutions *all,
                        rb_status end)
{
    int singular_only = 0, nearby = 0;
    r->info.iters = all->bases;
    r->singular = all->singular;
    r->undecided = all->undecided;
    for (int k = 0; k < all->count; k++)
        singular_only += r->singular_basis[k];
    for (int k = 0; r->nearby && k < all->count; k++)
        nearby += r->nearby[k];
    cli_note_enumeration(r->file, "bases", all->count, nearby, singular_only, all->undecided,
                         all->bases);
    int mixed = 0; /* sets with more than one */
    for (int k = 0; k < r->sets; k++)
        mixed += r->set[k + 1] - r->set[k] > 1;
    if (mixed)
        fprintf(stderr,
                "rollbem: %s: note: %d extreme equilibria in %d maximal set%s; all others are "
                "mixtures within a set\n",
                r->file, all->count, r->sets, rb_plural(r->sets));
    if (o->game && all->count && r->sets == 0)
        fprintf(
            stderr,
            "rollbem: %s: note: %d extreme equilibria, in more than 1000 maximal sets, which are "
            "not listed\n",
            r->file, all->count);
    if (all->count && end == RB_OK)
        return say_end(o, r, RB_OK);
    if (!all->count)
        r->info.res = r->info.scaled = r->floor = NAN;
    r->status = rb_status_text(end != RB_OK ? end : all->undecided ? RB_UNDECIDED : RB_NO_SOLUTION);
    if (end != RB_OK)
        return cli_fail(CLI_UNSOLVED, "%s: %s", r->file, r->info.msg.text);
    if (all->undecided)
        return cli_fail(CLI_UNSOLVED, "%s: none found, %d of %d complementary bases undecided",
                        r->file, all->undecided, all->bases);
    const char *bases = all->bases == 1 ? "basis" : "bases";
    return all->singular ? cli_fail(CLI_UNSOLVED,
                                    "%s: no solution (%d complementary %s; %d singular, each "
                                    "excluded)",
                                    r->file, all->bases, bases, all->singular)
                         : cli_fail(CLI_UNSOLVED, "%s: no solution (%d complementary %s)", r->file,
                                    all->bases, bases);
}

/* r->z, the solutions, is taken over from all, and r->w made as large. */
static rb_status take_all(lcp_result *r, rb_lcp_solutions *all)
{
    free(r->z);
    free(r->w);
    r->z = all->z;
    r->singular_basis = all->singular_basis;
    r->nearby = all->nearby;
    all->singular_basis = all->nearby = NULL;
    r->sets = all->sets;
    r->set = all->set;
    r->member = all->member;
    all->set = all->member = NULL;
    r->w = rb_alloc((size_t)all->n, (size_t)all->count);
    r->solutions = all->count;
    r->solver = "enumeration";
    all->z = NULL;
    return r->w ? RB_OK : rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
}

static cli_exit run_all(lcp_run *run, rb_io_matrix *M, lcp_result *r)
{
    rb_lcp_solutions all = {0};
    const double start = rb_seconds();
    rb_status s = rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
    if (rb_io_matrix_to_dense(M) == RB_OK)
        s = rb_lcp_enumerate(&(rb_lcp_problem){r->n, M->dense, r->n, r->boxed.q}, r->lower,
                             r->upper, run->o->seconds, &all, &r->info.msg);
    r->seconds = rb_seconds() - start;
    const rb_status end = s;
    if (s >= 0)
        s = take_all(r, &all);
    if (s != RB_OK)
        return invalid(r, s, &r->info.msg);
    r->floor = all.count ? rb_lcp_rounding_floor(&r->boxed, r->z, r->w) : NAN;
    r->info.res = r->info.scaled = 0.0;
    for (int k = 0; k < all.count; k++) {
        const double *z = r->z + (size_t)k * (size_t)r->n;
        double *w = r->w + (size_t)k * (size_t)r->n, scaled;
        const double res = rb_lcp_residual_mixed(&r->boxed, z, w);
        int row;
        if (rb_lcp_scaled_residual(&r->boxed, z, &scaled, &row) != RB_OK)
            return invalid(r, RB_ENOMEM, &(rb_message){.text = "out of memory"});
        r->info.res = fmax(r->info.res, res);
        if (!(scaled <= r->info.scaled)) {
            r->info.scaled = scaled;
            r->info.row = row;
        }
    }
    const cli_exit code = say_all(run->o, r, &all, end);
    if (!run->o->prove || end != RB_OK)
        return code;
    return say_number(
        r, rb_lcp_prove_number(&r->boxed, NULL, all.count, r->z, run->o->seconds, &r->number),
        code);
}

static cli_exit solve_lcp(lcp_run *run, lcp_result *r)
{
    const lcp_options *o = run->o;
    rb_io_lcp p;
    rb_message why = {.text = ""};
    rb_status s = rb_io_lcp_read(r->file, o->q, &p, &why);
    if (s == RB_OK && p.n == 0) { /* nothing is unknown */
        r->status = rb_status_text(RB_OK);
        r->is_empty = 1;
        r->info.res = r->info.scaled = r->seconds = 0.0;
        rb_io_lcp_free(&p);
        return CLI_OK;
    }
    /* The vectors of the options, each of n numbers. */
    if (s == RB_OK && o->lower)
        s = rb_io_bounds_read(o->lower, p.n, "lower", &r->lower, &why);
    if (s == RB_OK && o->upper)
        s = rb_io_bounds_read(o->upper, p.n, "upper", &r->upper, &why);
    if (s == RB_OK && o->cover)
        s = rb_io_vector_read(o->cover, p.n, "cover", &r->cover, &why);
    if (s == RB_OK && o->start)
        s = rb_io_vector_read(o->start, p.n, "start", &r->start, &why);
    if (s == RB_OK) {
        r->n = p.n;
        r->z = rb_alloc((size_t)p.n, 1);
        r->w = rb_alloc((size_t)p.n, 1);
        if (!r->z || !r->w || rb_io_matrix_to_sparse(&p.M, &r->M) != RB_OK)
            s = rb_fail(&why, RB_ENOMEM, "out of memory");
        r->boxed = (rb_lcp_mixed_problem){&r->M, p.q, r->lower, r->upper};
    }
    cli_exit code = CLI_CONTINUE;
    if (s != RB_OK)
        code = failed(r, s, &why);
    else if (o->all)
        code = run_all(run, &p.M, r);
    if (code == CLI_CONTINUE) {
        const rb_lcp_options opt = solver_options(run, r);
        const double start = rb_seconds();
        s = rb_lcp_solve(solvers[o->solver].name, &r->boxed, &opt, r->z, &r->info);
        r->seconds = rb_seconds() - start;
        if (s >= 0) {
            r->solver = r->info.solver;
            r->floor = rb_lcp_rounding_floor(&r->boxed, r->z, r->w);
            r->info.res = rb_lcp_residual_mixed(&r->boxed, r->z, r->w);
            if (rb_lcp_scaled_residual(&r->boxed, r->z, &r->info.scaled, &r->info.row) != RB_OK)
                s = rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
        }
        code = s < 0 ? invalid(r, s, &r->info.msg) : say_end(o, r, s);
        if (o->prove && s >= 0)
            code = say_proof(r, rb_lcp_prove_or_exclude(&r->boxed, r->z, &r->proof), code);
    }
    rb_io_lcp_free(&p);
    return code;
}

/* ---- Games ------------------------------------------------------------------------- */

static cli_exit solve_game(lcp_run *run, lcp_result *r)
{
    rb_io_bimatrix g;
    rb_message why = {.text = ""};
    rb_status s = rb_io_bimatrix_read(r->file, &g, &why);
    if (s == RB_OK && run->o->label > g.m + g.n)
        s = rb_fail(&why, RB_EINVAL, "--label: expected one of the %d strategies of %.200s, got %d",
                    g.m + g.n, r->file, run->o->label);
    if (s != RB_OK) {
        rb_io_bimatrix_free(&g);
        return failed(r, s, &why);
    }
    const rb_lcp_options opt = solver_options(run, r);
    const rb_lcp_game game = {g.m, g.n, g.A, g.B, g.m};
    const double start = rb_seconds();
    rb_lcp_solutions all = {0};
    s = rb_fail(&r->info.msg, RB_ENOMEM, "out of memory");
    r->n = g.m + g.n;
    r->solver = "lemke-howson";
    r->z = rb_alloc((size_t)r->n, 1);
    r->w = rb_alloc((size_t)r->n, 1);
    if (run->o->all)
        s = rb_lcp_bimatrix_enumerate(&game, run->o->seconds, &all, &r->info.msg);
    else if (r->z && r->w)
        s = rb_lcp_bimatrix(&game, run->o->trace && !run->o->label ? 0 : run->o->label - 1, &opt,
                            r->z, &r->info);
    r->seconds = rb_seconds() - start;
    const rb_status end = s;
    if (run->o->all && s >= 0)
        s = take_all(r, &all);
    if (s >= 0) {
        /* z = (x, y), w = what each strategy loses, of all solutions; the residual is the
         * worst, the payoffs are those of the first. */
        const size_t entries = (size_t)game.m * (size_t)game.n, n = (size_t)r->n;
        r->info.res = 0.0;
        for (int k = r->solutions - 1; k >= 0; k--)
            r->info.res =
                fmax(r->info.res, rb_lcp_bimatrix_regret(&game, r->z + (size_t)k * n,
                                                         r->w + (size_t)k * n, r->payoff));
        const double size = fmax(rb_norm_inf(entries, game.A), rb_norm_inf(entries, game.B));
        r->floor = 1e-14 * size;
        r->info.scaled = size > 0.0 ? r->info.res / size : r->info.res;
    }
    cli_exit code = s < 0         ? invalid(r, s, &r->info.msg)
                    : run->o->all ? say_all(run->o, r, &all, end)
                                  : say_end(run->o, r, s);
    if (run->o->prove && run->o->all && end == RB_OK && s >= 0)
        code = say_number(
            r, rb_lcp_prove_game_number(&game, r->solutions, r->z, run->o->seconds, &r->number),
            code);
    else if (run->o->prove && s >= 0 && !run->o->all)
        code = say_proof(r, rb_lcp_prove_game(&game, r->z, &r->proof), code);
    rb_io_bimatrix_free(&g);
    return code;
}

/* ---- One file ---------------------------------------------------------------------- */

/* 0: nothing is known of the problem, which was not read. */
static int is_known(const lcp_result *r)
{
    return r->n > 0 || r->is_empty;
}

/* What --game, --all, --solution, --prove and --trace add to the object of the file. */
static void add_members(const lcp_run *run, cli_rows *rows, const lcp_result *r)
{
    const lcp_options *o = run->o;
    const int known = is_known(r);
    if (o->game) {
        cli_rows_set(rows, "payoffs", known ? rb_report_json_numbers(2, r->payoff) : json_null());
        cli_rows_set(rows, "label",
                     r->info.label >= 0 ? json_integer(r->info.label + 1) : json_null());
    }
    if (o->all) {
        json_t *list = json_array(), *sets = r->sets ? json_array() : json_null();
        for (int k = 0; k < r->solutions; k++) {
            json_t *one =
                json_pack("{s:o, s:o, s:b, s:b}", "z", vector(r->n, r->z + (size_t)k * r->n), "w",
                          vector(r->n, r->w + (size_t)k * r->n), "singular_basis",
                          r->singular_basis ? r->singular_basis[k] : 0, "nearby",
                          r->nearby ? r->nearby[k] : 0);
            if (k < r->number.proofs)
                rb_report_json_set(&one, "proof", rb_report_json_proof(&r->number.proof[k]));
            rb_report_json_append(&list, one);
        }
        for (int k = 0; k < r->sets; k++) {
            json_t *members = json_array();
            for (int l = r->set[k]; l < r->set[k + 1]; l++)
                rb_report_json_append(&members, json_integer(r->member[l] + 1));
            rb_report_json_append(&sets, members);
        }
        cli_rows_set(rows, "solutions", list);
        cli_rows_set(rows, "singular", known ? json_integer(r->singular) : json_null());
        cli_rows_set(rows, "undecided", known ? json_integer(r->undecided) : json_null());
        if (o->game)
            cli_rows_set(rows, "sets", sets);
        else
            json_decref(sets);
    } else if (o->solution) {
        cli_rows_set(rows, "z", vector(r->n, r->z));
        cli_rows_set(rows, "w", vector(r->n, r->w));
    }
    if (o->prove && o->all)
        cli_rows_set(rows, "number",
                     r->is_counted ? rb_report_json_number_of_solutions(&r->number) : json_null());
    else if (o->prove)
        cli_rows_set(rows, "proof", r->proof.n ? rb_report_json_proof(&r->proof) : json_null());
    if (o->trace)
        cli_rows_set(rows, "pivots", json_incref(run->pivots.list));
}

/* A # line of the file, and a row per unknown of each solution. */
static void list_unknowns(const lcp_run *run, cli_rows *rows, const lcp_result *r)
{
    char residual[40] = "", label[40] = ""; /* without a solution there is none */
    const char *counted = run->o->all          ? r->info.iters == 1 ? "basis" : "bases"
                          : r->info.iters == 1 ? "pivot"
                                               : "pivots";
    if (isfinite(r->info.res))
        snprintf(residual, sizeof residual, ", scaled residual %.3g", r->info.scaled);
    if (r->info.label >= 0)
        snprintf(label, sizeof label, " from label %d", r->info.label + 1);
    rb_report_comment(&rows->cells, "%s: %s by %s%s, n = %d, %d %s%s, %.3g s", r->file, r->status,
                      r->solver, label, r->n, r->info.iters, counted, residual, r->seconds);
    for (int k = 0; k < r->sets; k++) {
        char text[400] = "";
        for (int l = r->set[k]; l < r->set[k + 1]; l++)
            rb_append(text, sizeof text, " %d", r->member[l] + 1);
        rb_report_comment(&rows->cells, "maximal set %d: solutions%s", k + 1, text);
    }
    for (int k = 0; k < r->solutions && !run->o->trace && r->z; k++)
        for (int i = 0; i < r->n; i++) {
            const size_t at = (size_t)k * (size_t)r->n + (size_t)i;
            const rb_lcp_proof *proof = k < r->number.proofs ? &r->number.proof[k] : &r->proof;
            const double within =
                proof->proved ? fabs(r->z[at] - proof->z[i]) + proof->error[i] : NAN;
            const cli_value unknown[] = {
                CLI_TEXT(NULL, "file", r->file), CLI_WHOLE(NULL, "solution", k + 1),
                CLI_WHOLE(NULL, "i", i + 1),     CLI_NUMBER(NULL, "z", r->z[at]),
                CLI_NUMBER(NULL, "w", r->w[at]), CLI_NUMBER(NULL, "within", within)};
            cli_rows_add(rows, sizeof unknown / sizeof *unknown, unknown);
        }
}

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
    if (!run->o->trace)
        cli_wait_begin();
    const cli_exit code = run->o->game ? solve_game(run, &r) : solve_lcp(run, &r);
    if (!run->o->trace)
        cli_wait_end();
    const int known = is_known(&r);
    char proof[60] = "-";
    if (r.proof.n)
        rb_report_proof_status(&r.proof, proof, sizeof proof);
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
        add_members(run, rows, &r);
    } else if (known && (run->o->trace || run->o->solution || run->o->all))
        list_unknowns(run, rows, &r);
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
                       .o = &o};
        code = cli_solve_problems(&run.files, &args, o.output);
    }
    cli_args_free(&args);
    return code;
}
