/* rollbem friction FILE...: frictional contact problems, and problems on second-order
 * cones, from files. */
#include "program/cli/cli.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "program/cli/solvers.h"
#include "program/cli/spool.h"
#include "program/cli/wait.h"

#include "lcp/friction/friction.h"
#include "program/report/report.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *solver;
    double tol, seconds;
    int max_iters, measure, kind, format, facts, solution, trace, all, prove;
    rb_report_style style;
    const char *output;
} friction_options;

static const rb_choice kinds[] = {{"any", RB_FRICTION_FILE_ANY},
                                  {"fclib", RB_FRICTION_FILE_FCLIB},
                                  {"siconos", RB_FRICTION_FILE_SICONOS},
                                  {"siconos-global", RB_FRICTION_FILE_SICONOS_GLOBAL},
                                  {"siconos-soclcp", RB_FRICTION_FILE_SICONOS_SOCLCP},
                                  {NULL, 0}};

/* --format once named the kind of the files; both meanings are taken. */
enum { KIND = 16 };

static const rb_choice formats[] = {{"tsv", RB_REPORT_TSV},
                                    {"csv", RB_REPORT_CSV},
                                    {"json", RB_REPORT_JSON},
                                    {"any", KIND + RB_FRICTION_FILE_ANY},
                                    {"fclib", KIND + RB_FRICTION_FILE_FCLIB},
                                    {"siconos", KIND + RB_FRICTION_FILE_SICONOS},
                                    {"siconos-soclcp", KIND + RB_FRICTION_FILE_SICONOS_SOCLCP},
                                    {NULL, 0}};

#define PLACE(member) offsetof(friction_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("solver", "Solver"),
    RB_TEXT_LINE("solver", PLACE(solver), "NAME", "which solver; names below"),
    RB_NUMBER_LINE("tol", PLACE(tol), "", RB_ABOVE(0.0), "tolerance of the error: see below"),
    RB_CHOICE_LINE(
        "measure", PLACE(measure), cli_friction_measures,
        "which error decides: scaled, or acary: (13), which depends on the units of the file"),
    RB_INTEGER_LINE("max-iters", PLACE(max_iters), RB_FROM_TO(1, 1e9), "iteration limit",
                    .unset = "the solver's own"),
    RB_NUMBER_LINE("seconds", PLACE(seconds), "s", RB_ABOVE(0.0), "time limit per file",
                   .unset = "none"),
    RB_FLAG_LINE("all", PLACE(all),
                 "all solutions of plane problems, by trying every state (8 contacts at most)"),
    RB_FLAG_LINE("prove", PLACE(prove),
                 "prove that there is a solution in these zones, and how near it is"),
    RB_CHOICE_LINE("kind", PLACE(kind), kinds, "format of the files, if it is not recognised"),
    RB_GROUP_LINE("output", "Output"),
    RB_FLAG_LINE("facts", PLACE(facts), "rank, degree of hyperstaticity, nullity of K, asymmetry"),
    RB_FLAG_LINE("solution", PLACE(solution),
                 "a row per component of reactions r and velocities u instead of one per file"),
    RB_FLAG_LINE("trace", PLACE(trace),
                 "every iterate with its error, also of the members of auto"),
    CLI_JSON_LINE(PLACE(style)),
    RB_CHOICE_LINE(
        "format", PLACE(format), formats,
        "of the results: a table with tabs, with commas, or JSON; or, as --kind, of the files"),
    CLI_HEADER_LINE(PLACE(style)),
    CLI_OUTPUT_LINE(PLACE(output)),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

static const char about[] =
    "Solves frictional contact problems u = W r + q (or K v = H r + f, u = H' v + w) with "
    "Coulomb's\n"
    "law in two and three dimensions, [N, T...] per contact, N first.\n"
    "FILE: FCLib (HDF5) or text format of Siconos; also Siconos' problems on second-order cones.";

static const char notes[] =
    "Prints one row per file (with --solution a # line): name, solver that found the\n"
    "solution, status, contacts, dimension, iterations, residual (*Acary* (13), ||r\n"
    "- P_K(r - uhat)|| / ||q||, recomputed from r), floor (the residual that\n"
    "rounding errors of the data can cause), seconds, scaled residual. The scaled\n"
    "residual decides: the distance of r W_NN and u from Coulomb's law over ||q||, in\n"
    "units of velocity, which does not depend on the units of the file; and no contact\n"
    "may miss the law by more than the tolerance of its own velocities. With --measure\n"
    "acary (13) decides. A note says if a problem is solved in the scaled measure only.\n"
    "Status solved-to-rounding: residual above the tolerance but not above the\n"
    "floor; infeasible: not solved, and proved to have no solution.\n"
    "--all lists every solution of a plane problem, a row per contact: separated,\n"
    "stick, slip+ (u_T > 0, r_T = -mu r_N), slip- (u_T < 0, r_T = mu r_N), several\n"
    "names on the border between them; status no-solution is proved, undecided not.\n"
    "--prove: a machine-checked proof that the problem with exactly these numbers has a\n"
    "solution with these zones, and the part of q and mu that the printed reactions are\n"
    "exact for (docs/proof.md).\n"
    "--trace prints every iterate with the solver, its iterations and operations so\n"
    "far, and the scaled residual; members of auto run in turns.\n"
    "If a file fails, the others are still solved.\n"
    "Exit codes, the largest of all files: 0 solved; 1 not solved; 64 wrong command line; 65\n"
    "malformed file, or one the solver does not take; 66 no such file; 70 internal; 73 cannot "
    "write.\n"
    "Solvers:\n";

typedef struct {
    cli_problems files;
    const friction_options *o;
    json_t *steps; /* --trace with --json: of the present file */
} friction_run;

typedef struct {
    const char *file, *status, *measure;
    cli_spool read;             /* it, or its copy */
    int contacts, dimension, m; /* m: 0 when not read */
    rb_friction_info info;
    rb_friction_facts facts;
    rb_message note;           /* on how the result is to be read; empty: none */
    double *r, *u;             /* m; owned */
    rb_friction_solutions all; /* --all; owned */
    int is_tried;              /* 1: --prove has run: */
    rb_friction_proof proof;
} friction_result;

/* ---- One file --------------------------------------------------------------------- */

static cli_exit failed(friction_result *r, rb_status s, const char *text)
{
    r->status = rb_status_text(s);
    r->m = 0;
    r->info.residual = r->info.scaled = r->info.floor = r->info.flops = r->info.seconds =
        r->facts.asymmetry = NAN;
    return cli_fail(s == RB_EINVAL ? CLI_DATA : cli_exit_of(s), "%s: %s", r->file,
                    text[0] ? text : rb_status_text(s));
}

static cli_exit unreadable(friction_result *r, rb_status s, rb_message *why)
{
    cli_spool_rename(&r->read, why);
    r->status = rb_status_text(s);
    r->info.residual = r->info.scaled = r->info.floor = r->info.flops = r->info.seconds =
        r->facts.asymmetry = NAN;
    return cli_say(s, why);
}

/* Beyond this many rows only --facts looks at W's shape: it costs a factorisation. */
#define MOST_ROWS 3000

static cli_exit assess_result(friction_run *run, friction_result *r, rb_status s)
{
    r->status = rb_friction_status_text(s, run->o->tol, &r->info);
    if (s < 0 || (s == RB_SINGULAR && r->info.msg.text[0]))
        return failed(r, s, r->info.msg.text);
    if (s == RB_OK && rb_friction_note(run->o->tol, &r->info, &r->note))
        cli_note(r->file, "%s", r->note.text);
    if (s == RB_OK)
        return CLI_OK;
    if (run->o->measure != RB_FRICTION_BY_ACARY && r->info.scaled <= run->o->tol)
        return cli_fail(
            CLI_UNSOLVED,
            "%s: %s: %s after %d iteration%s: contact %d misses Coulomb's law by %.2g of "
            "its own velocities",
            r->file, r->info.solver, r->status, r->info.iters, rb_plural(r->info.iters),
            r->info.contact + 1, r->info.worst);
    return cli_fail(CLI_UNSOLVED, "%s: %s: %s after %d iteration%s, %s %.2g", r->file,
                    r->info.solver, r->status, r->info.iters, rb_plural(r->info.iters),
                    run->o->measure == RB_FRICTION_BY_ACARY ? "residual (13)" : "scaled residual",
                    rb_friction_deciding(&r->info));
}

static int trace(const rb_friction_progress *at, void *context)
{
    friction_run *run = context;
    if (run->files.rows.is_json)
        rb_report_json_append(&run->steps,
                              json_pack("{s:s, s:i, s:o, s:o}", "solver", at->solver, "iterations",
                                        at->iters, "flops", rb_report_json_number(at->flops),
                                        "scaled_residual", rb_report_json_number(at->error)));
    else
        rb_report_comment(&run->files.rows.cells, "%s\t%d\t%.4g\t%.3g", at->solver, at->iters,
                          at->flops, at->error);
    return 0;
}

static rb_friction_options solver_options(friction_run *run)
{
    const friction_options *o = run->o;
    rb_friction_options opt = rb_friction_defaults();
    opt.tol = o->tol;
    opt.measure = (rb_friction_measure_name)o->measure;
    opt.max_iters = o->max_iters;
    opt.seconds = o->seconds;
    opt.progress = o->trace ? trace : NULL;
    opt.context = run;
    return opt;
}

/* What is proved of the reactions, on standard error. */
static cli_exit prove(friction_result *r, const rb_friction_problem *p, cli_exit code)
{
    rb_message why = {.text = ""};
    char text[600];
    const rb_status s = rb_friction_prove_zones(p, r->r, &r->proof, &why);
    if (s != RB_OK && s != RB_UNDECIDED)
        return failed(r, s, why.text);
    r->is_tried = 1;
    fprintf(stderr, "rollbem: %s: %s\n", r->file,
            rb_report_friction_proof_text(&r->proof, text, sizeof text));
    return code;
}

/* ---- All solutions ------------------------------------------------------------------ */

static const char *const state_names[RB_FRICTION_STATES] = {"separated", "stick", "slip+", "slip-"};

/* "stick|slip+" on the border between them. */
static const char *name_states(unsigned states, char *text, size_t size)
{
    text[0] = '\0';
    for (int k = 0; k < RB_FRICTION_STATES; k++)
        if (states >> k & 1)
            rb_append(text, size, "%s%s", text[0] ? "|" : "", state_names[k]);
    return text;
}

static cli_exit find_all(friction_run *run, friction_result *r, const rb_friction_problem *p)
{
    rb_message why = {.text = ""};
    const double start = rb_seconds();
    const rb_status s = rb_friction_all(p, run->o->seconds, &r->all, &why);
    r->info.solver = "enumeration";
    r->info.seconds = rb_seconds() - start;
    r->info.iters = r->all.tried;
    r->info.residual = r->info.scaled = r->info.floor = r->info.worst = NAN;
    r->info.contact = -1;
    if (s < 0 || s == RB_SINGULAR)
        return failed(r, s, why.text);
    int singular_only = 0, nearby = 0;
    for (int k = 0; k < r->all.count; k++) {
        rb_friction_errors e;
        const size_t at = (size_t)k * (size_t)r->m;
        singular_only += r->all.singular_state[k];
        nearby += r->all.nearby[k];
        if (rb_friction_error(p, r->all.r + at, NULL, NULL, &e) != RB_OK)
            return failed(r, RB_ENOMEM, "out of memory");
        r->info.residual = k ? fmax(r->info.residual, e.residual) : e.residual;
        r->info.scaled = k ? fmax(r->info.scaled, e.scaled) : e.scaled;
        r->info.worst = k ? fmax(r->info.worst, e.worst) : e.worst;
        r->info.floor = k ? fmax(r->info.floor, e.floor) : e.floor;
    }
    cli_note_enumeration(r->file, "states", r->all.count, nearby, singular_only, r->all.undecided,
                         r->all.tried);
    r->status = rb_status_text(s != RB_OK             ? s
                               : r->all.count         ? RB_OK
                               : r->all.undecided > 0 ? RB_UNDECIDED
                                                      : RB_NO_SOLUTION);
    if (s != RB_OK)
        return cli_fail(CLI_UNSOLVED, "%s: %s", r->file, why.text);
    if (r->all.count)
        return CLI_OK;
    if (r->all.undecided)
        return cli_fail(CLI_UNSOLVED, "%s: none found, %d of %d states undecided", r->file,
                        r->all.undecided, r->all.tried);
    return cli_fail(CLI_UNSOLVED, "%s: no solution (%d states; %d singular, each excluded)",
                    r->file, r->all.tried, r->all.singular);
}

/* A row per contact of each solution. */
static void list_all(const friction_run *run, const friction_result *r)
{
    cli_rows *rows = (cli_rows *)&run->files.rows;
    rb_report_comment(&rows->cells, "%s: %s by enumeration, %d contact%s, %d state%s, %.3g s",
                      r->file, r->status, r->contacts, rb_plural(r->contacts), r->all.tried,
                      rb_plural(r->all.tried), r->info.seconds);
    for (int k = 0; k < r->all.count; k++)
        for (int c = 0; c < r->contacts; c++) {
            const size_t at = (size_t)(2 * (k * r->contacts + c));
            char text[80];
            const cli_value row[] = {
                CLI_TEXT(NULL, "file", r->file),
                CLI_WHOLE(NULL, "solution", k + 1),
                CLI_WHOLE(NULL, "contact", c + 1),
                CLI_TEXT(NULL, "state",
                         name_states(r->all.states[k * r->contacts + c], text, sizeof text)),
                CLI_NUMBER(NULL, "r_N", r->all.r[at]),
                CLI_NUMBER(NULL, "r_T", r->all.r[at + 1]),
                CLI_NUMBER(NULL, "u_N", r->all.u[at]),
                CLI_NUMBER(NULL, "u_T", r->all.u[at + 1])};
            cli_rows_add(rows, sizeof row / sizeof *row, row);
        }
}

static json_t *json_of_all(const friction_result *r)
{
    json_t *list = json_array();
    for (int k = 0; k < r->all.count; k++) {
        json_t *states = json_array();
        for (int c = 0; c < r->contacts; c++) {
            char text[80];
            rb_report_json_append(
                &states,
                json_string(name_states(r->all.states[k * r->contacts + c], text, sizeof text)));
        }
        const size_t at = (size_t)k * (size_t)r->m;
        rb_report_json_append(
            &list,
            json_pack("{s:o, s:o, s:o, s:b, s:b}", "r", rb_report_json_numbers(r->m, r->all.r + at),
                      "u", rb_report_json_numbers(r->m, r->all.u + at), "states", states,
                      "singular_state", r->all.singular_state[k], "nearby", r->all.nearby[k]));
    }
    return list;
}

/* Notes on W; ranks on request, unsymmetric and indefinite W in any case. */
static cli_exit examine(const friction_run *run, const rb_friction_problem *p, friction_result *r)
{
    if (run->o->facts || r->m <= MOST_ROWS) {
        const rb_status s = rb_friction_examine(p, run->o->facts, &r->facts);
        if (s != RB_OK)
            return failed(r, s, rb_status_text(s));
        if (r->facts.asymmetry > 1e-12)
            cli_note(r->file, "W is not symmetric (|W - W'| is %.2g of |W|)", r->facts.asymmetry);
        if (r->facts.indefinite)
            cli_note(r->file, "W is indefinite: a solution may not exist or may not be unique");
    }
    const int several = p->dimension == 2 ? rb_friction_may_have_several(p) : 0;
    if (several)
        cli_note(r->file, "W_NN - mu |W_NT| < 0 at contact %d: there may be several solutions%s",
                 several, p->contacts <= RB_FRICTION_ALL_UP_TO ? "; --all lists them" : "");
    return CLI_OK;
}

/* A least load that is so many times what is given is worth a note. */
static const double MUCH = 1e3;

/* Why a problem may have no solution, which none of the solvers has found. */
static cli_exit look_for_reason(const rb_friction_problem *p, friction_result *r)
{
    double least, given;
    int floats = 0;

    if (rb_friction_floats(p, &floats) != RB_OK)
        return failed(r, RB_ENOMEM, "out of memory");
    if (floats) {
        r->status = "infeasible";
        cli_note(r->file, "no equilibrium exists: the forces drive a motion that neither K nor any "
                          "contact resists");
    } else if (rb_friction_has_no_solution(p, &least, &given)) {
        r->status = "infeasible";
        cli_note(r->file, "no solution exists: whatever the reactions are, they cannot prevent "
                          "penetration at all contacts");
    } else if (least > MUCH * given)
        cli_note(r->file,
                 "there is no solution with a sum W_NN r_N below %.2g; |q| adds up to %.2g",
                 0.95 * least, given); /* two digits are not above it */
    return CLI_UNSOLVED;
}

/* By the solver of the options, into r. */
static cli_exit solve_one(friction_run *run, const rb_friction_problem *p, friction_result *r)
{
    const rb_friction_options opt = solver_options(run);
    const rb_friction_solution solution = {r->r, r->u, NULL};
    if (!run->o->trace)
        cli_wait_begin();
    const rb_status s = rb_friction_solve(run->o->solver, p, &opt, &solution, &r->info);
    if (!run->o->trace)
        cli_wait_end();
    cli_exit code = assess_result(run, r, s);
    if (code == CLI_UNSOLVED)
        code = look_for_reason(p, r);
    if (run->o->prove && r->m > 0)
        code = prove(r, p, code);
    if (p->lengths) {
        /* Rolling contacts are solved as two contacts each and told as one of five
         * entries. */
        rb_friction_unite_rolling(p, r->r, r->u, r->r, r->u);
        r->contacts = p->contacts / 2;
        r->dimension = 5;
        r->m = r->dimension * r->contacts;
    }
    return code;
}

static cli_exit solve_friction(friction_run *run, friction_result *r)
{
    rb_friction_problem p;
    rb_message why = {.text = ""};
    const rb_status s =
        rb_friction_read_as(cli_spool_path(&r->read), (rb_friction_file)run->o->kind, &p, &why);
    if (s != RB_OK)
        return unreadable(r, s, &why);
    r->contacts = p.contacts;
    r->dimension = p.dimension;
    r->m = p.dimension * p.contacts;
    if (p.contacts == 0) { /* nothing is unknown */
        r->status = rb_status_text(RB_OK);
        r->info.residual = r->info.scaled = r->info.floor = r->info.seconds = 0.0;
        rb_friction_problem_free(&p);
        return CLI_OK;
    }
    if (p.asymmetry > 0.0)
        cli_note(r->file,
                 "K is not symmetric (|K - K'| is %.2g of |K|); its symmetric part is solved",
                 p.asymmetry);
    r->r = rb_alloc((size_t)r->m, 1);
    r->u = rb_alloc((size_t)r->m, 1);
    cli_exit code = r->r && r->u ? CLI_OK : failed(r, RB_ENOMEM, "out of memory");
    if (code == CLI_OK && run->o->prove && p.lengths)
        code = failed(r, RB_EINVAL, "--prove does not take rolling friction: leave it out");
    if (code == CLI_OK && run->o->all)
        code = find_all(run, r, &p);
    else if (code == CLI_OK)
        code = examine(run, &p, r);
    if (code == CLI_OK && !run->o->all)
        code = solve_one(run, &p, r);
    rb_friction_problem_free(&p);
    return code;
}

static cli_exit solve_cones(friction_run *run, friction_result *r)
{
    rb_friction_soclcp_data d;
    rb_message why = {.text = ""};
    rb_status s = rb_friction_soclcp_read(cli_spool_path(&r->read), &d, &why);
    if (s != RB_OK)
        return unreadable(r, s, &why);
    r->contacts = d.problem.cones;
    r->m = d.problem.n;
    r->r = rb_alloc((size_t)r->m, 1);
    r->u = rb_alloc((size_t)r->m, 1);
    cli_exit code = CLI_OK;
    if (!r->r || !r->u)
        code = failed(r, RB_ENOMEM, "out of memory");
    if (strcmp(run->o->solver, "auto") && strcmp(run->o->solver, "soclcp-smoothing"))
        code = failed(r, RB_EINVAL, "only soclcp-smoothing solves problems on cones");
    if (code == CLI_OK) {
        const rb_friction_options opt = solver_options(run);
        s = rb_friction_solve_soclcp(&d.problem, &opt, r->r, r->u, &r->info);
        /* Back from slope 1 to the slopes of the file. */
        for (int c = 0, at = 0; c < d.problem.cones; at += d.size[c++]) {
            r->r[at] /= d.tau[c];
            r->u[at] *= d.tau[c];
        }
        code = assess_result(run, r, s);
    }
    rb_friction_soclcp_data_free(&d);
    return code;
}

/* What --all, --solution, --prove and --trace add to the object of the file. */
static void add_members(const friction_run *run, cli_rows *rows, friction_result *r, int known)
{
    if (run->o->all) {
        cli_rows_set(rows, "solutions", known ? json_of_all(r) : json_null());
        cli_rows_set(rows, "singular", known ? json_integer(r->all.singular) : json_null());
        cli_rows_set(rows, "undecided", known ? json_integer(r->all.undecided) : json_null());
    } else if (run->o->solution) {
        cli_rows_set(rows, "r", r->r ? rb_report_json_numbers(r->m, r->r) : json_null());
        cli_rows_set(rows, "u", r->u ? rb_report_json_numbers(r->m, r->u) : json_null());
    }
    if (run->o->prove)
        cli_rows_set(rows, "proof",
                     r->is_tried ? rb_report_json_friction_proof(&r->proof) : json_null());
    if (run->o->trace)
        cli_rows_set(rows, "trace", json_incref(run->steps));
}

/* The row of the file, or a # line and a row per component of its solutions. */
static void list_rows(friction_run *run, friction_result *r, int n, const cli_value *values)
{
    cli_rows *rows = &run->files.rows;

    if (r->note.text[0])
        rb_report_comment(&rows->cells, "note: %s: %s", r->file, r->note.text);
    if (run->o->all)
        list_all(run, r);
    else if (!run->o->solution)
        cli_rows_add(rows, n, values);
    else
        rb_report_comment(
            &rows->cells, "%s: %s by %s, %d contact%s, %d iteration%s, residual %.3g, %.3g s",
            r->file, r->status, r->info.solver, r->contacts, rb_plural(r->contacts), r->info.iters,
            rb_plural(r->info.iters), r->info.residual, r->info.seconds);
    if (run->o->solution && run->o->facts)
        rb_report_comment(&rows->cells, "rank %d, hyperstaticity %d, nullity %d, asymmetry %.3g%s",
                          r->facts.rank, r->facts.hyperstaticity, r->facts.nullity,
                          r->facts.asymmetry, r->facts.indefinite ? ", indefinite" : "");
    for (int i = 0; i < r->m && run->o->solution && !run->o->all; i++) {
        const cli_value component[] = {CLI_TEXT(NULL, "file", r->file), CLI_WHOLE(NULL, "i", i + 1),
                                       CLI_NUMBER(NULL, "r", r->r[i]),
                                       CLI_NUMBER(NULL, "u", r->u[i])};
        cli_rows_add(rows, sizeof component / sizeof *component, component);
    }
}

/* Solves the file in the form that it has. */
static cli_exit solve_kind(friction_run *run, friction_result *r)
{
    rb_friction_file kind = (rb_friction_file)run->o->kind;
    rb_message why = {.text = ""};
    rb_status s = cli_spool_begin(r->file, &r->read, &why);
    if (s == RB_OK && kind == RB_FRICTION_FILE_ANY)
        s = rb_friction_file_kind(cli_spool_path(&r->read), &kind, &why);
    if (s != RB_OK)
        return unreadable(r, s, &why);
    if (kind != RB_FRICTION_FILE_SICONOS_SOCLCP)
        return solve_friction(run, r);
    if (run->o->all)
        return failed(r, RB_EINVAL, "--all does not read problems on cones");
    if (run->o->prove)
        return failed(r, RB_EINVAL, "--prove does not read problems on cones: leave it out");
    if (run->o->facts)
        return failed(r, RB_EINVAL, "--facts does not read problems on cones: leave it out");
    return solve_cones(run, r);
}

static cli_exit solve_file(void *context, const char *path)
{
    friction_run *run = context;
    friction_result r = {
        .file = path,
        .measure = cli_friction_measures[run->o->measure].name,
        .info = {.solver = run->o->solver, .residual = NAN, .scaled = NAN, .floor = NAN}};
    run->steps = json_array();
    const cli_exit code = solve_kind(run, &r);
    const int known = r.m > 0 || (r.dimension > 0 && code == CLI_OK);
    const int has_contacts = known && r.dimension > 0; /* cones have no law of their own */
    const rb_friction_info *info = &r.info;
    const rb_friction_facts *facts = &r.facts;
    const cli_value values[] = {
        CLI_TEXT("file", "file", r.file),
        CLI_TEXT("solver", "solver", info->solver),
        CLI_WORDS("status", "status", r.status),
        CLI_KNOWN("contacts", "contacts", r.contacts, known),
        CLI_KNOWN("dimension", "dimension", r.dimension, r.dimension > 0),
        CLI_KNOWN("iterations", "iterations", info->iters, known),
        CLI_NUMBER("residual", "residual", info->residual),
        CLI_NUMBER("scaled_residual", "scaled", info->scaled),
        CLI_NUMBER("worst_residual", NULL, has_contacts ? info->worst : NAN),
        CLI_KNOWN("worst_contact", NULL, info->contact + 1, has_contacts && info->contact >= 0),
        CLI_TEXT("measure", NULL, r.measure),
        CLI_TEXT("note", NULL, r.note.text[0] ? r.note.text : NULL),
        CLI_NUMBER("floor", "floor", info->floor),
        CLI_NUMBER("flops", NULL, info->flops),
        CLI_NUMBER("seconds", "seconds", info->seconds),
        CLI_WORDS(NULL, "proof",
                  !r.is_tried      ? "-"
                  : r.proof.proved ? "proved"
                                   : "not proved"),
        CLI_NUMBER(NULL, "within", r.proof.proved ? r.proof.stored_within : NAN),
        CLI_KNOWN("rank", "rank", facts->rank, known),
        CLI_KNOWN("hyperstaticity", "hyperstaticity", facts->hyperstaticity, known),
        CLI_KNOWN("nullity", "nullity", facts->nullity, known),
        CLI_NUMBER("asymmetry", "asymmetry", facts->asymmetry),
        CLI_KNOWN("indefinite", "indefinite", facts->indefinite, known)};
    enum { VALUES = sizeof values / sizeof *values, FACTS = 5 };
    cli_rows *rows = &run->files.rows;
    if (rows->is_json) {
        cli_rows_add(rows, run->o->facts ? VALUES : VALUES - FACTS, values);
        add_members(run, rows, &r, known);
    } else if (known)
        list_rows(run, &r, VALUES, values);
    cli_spool_end(&r.read);
    json_decref(run->steps);
    rb_friction_solutions_free(&r.all);
    free(r.r);
    free(r.u);
    return code;
}

/* ---- Command ---------------------------------------------------------------------- */

static const char conventions[] = "[N, T...] per contact, u = W r + q, uhat = u + mu ||u_T|| N, K* "
                                  "contains uhat, complementary to r in K";

int cli_friction(int argc, char **argv)
{
    friction_options o = {.solver = "auto", .tol = 1e-8};
    cli_args args = {0};
    const rb_friction_solver *solver;
    char text[6000];
    const size_t n = (size_t)snprintf(text, sizeof text, "%s", notes);
    cli_friction_solver_lines(text + n, sizeof text - n);
    const cli_spec spec = {.synopsis = "rollbem friction [OPTION...] FILE...",
                           .about = about,
                           .notes = text,
                           .sets = {{options, OPTIONS, &o, NULL, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (o.format >= KIND)
        o.kind = o.format - KIND;
    else if (o.format != RB_REPORT_TSV)
        o.style.format = (rb_report_format)o.format;
    if (code == CLI_CONTINUE && args.operands < 1)
        code = cli_fail(CLI_USAGE, "friction: expected at least one FILE");
    if (code == CLI_CONTINUE)
        code = cli_friction_solver("solver", o.solver, &solver);
    if (code == CLI_CONTINUE && o.all && (o.trace || o.facts || o.max_iters || o.measure))
        code = cli_fail(CLI_USAGE, "friction: --all tries every state: not with --trace, --facts, "
                                   "--max-iters or --measure");
    if (code == CLI_CONTINUE && o.all && o.prove)
        code = cli_fail(CLI_USAGE, "friction: --prove proves the solution that was found: not with "
                                   "--all");
    if (code == CLI_CONTINUE && o.prove && o.trace)
        code = cli_fail(CLI_USAGE, "friction: --prove is about the last iterate: not with --trace");
    if (code == CLI_CONTINUE && o.all && strcmp(o.solver, "auto") != 0)
        code = cli_fail(CLI_USAGE, "friction: --all tries every state: not with --solver");
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE) {
        char columns[160];
        snprintf(columns, sizeof columns, "%s%s%s",
                 o.all        ? "file solution contact state r_N r_T u_N u_T"
                 : o.solution ? "file i r u"
                              : "file solver status contacts dimension iterations residual floor "
                                "seconds scaled",
                 o.facts && !o.solution ? " rank hyperstaticity nullity asymmetry indefinite" : "",
                 o.prove && !o.solution ? " proof within" : "");
        friction_run run = {.files = {.style = &o.style,
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
