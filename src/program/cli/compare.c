/* rollbem compare FILE...: performance profiles of friction solvers (Dolan and More). */
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

typedef enum { COST_FLOPS, COST_SECONDS, COST_ITERATIONS } cost_kind;

typedef struct {
    const char *solvers;
    double tol, limit;
    int cost, measure, max_iters;
    rb_report_style style;
    const char *plot, *output, *profiles;
    cli_pictures pictures;
    int given[20];
} compare_options;

static const rb_choice costs[] = {
    {"flops", COST_FLOPS}, {"seconds", COST_SECONDS}, {"iterations", COST_ITERATIONS}, {NULL, 0}};

#define PLACE(member) offsetof(compare_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("compare", "Comparison"),
    RB_TEXT_LINE("solvers", PLACE(solvers), "A,B,...", "which solvers",
                 .unset = "all that rollbem friction has"),
    RB_NUMBER_LINE("tol", PLACE(tol), "", RB_ABOVE(0.0),
                   "error, recomputed, that counts as solved"),
    RB_CHOICE_LINE("measure", PLACE(measure), cli_friction_measures,
                   "which error decides, as for rollbem friction"),
    RB_NUMBER_LINE("limit", PLACE(limit), "s", RB_ABOVE(0.0), "time for one solver on one problem"),
    RB_INTEGER_LINE("max-iters", PLACE(max_iters), RB_FROM_TO(1, 1e9), "iteration limit",
                    .unset = "each solver's own"),
    RB_CHOICE_LINE("cost", PLACE(cost), costs, "cost that the profiles and the picture compare"),
    RB_GROUP_LINE("output", "Output"),
    CLI_STYLE_LINES(PLACE(style)),
    RB_TEXT_LINE("plot", PLACE(plot), "FILE", "picture of the profiles: " RB_REPORT_KINDS,
                 .unset = "none", .file = RB_FILE_PICTURE),
    CLI_PICTURE_LINES(PLACE(pictures)),
    RB_TEXT_LINE("output", PLACE(output), "FILE",
                 "where the table of the runs or JSON goes, whole or not at all",
                 .unset = "standard output", .file = RB_FILE_WRITTEN),
    RB_TEXT_LINE("profiles", PLACE(profiles), "FILE",
                 "where the table of the profiles goes: tau, then rho of each solver",
                 .unset = "none", .file = RB_FILE_WRITTEN),
};

enum { OPTIONS = sizeof options / sizeof options[0], TAUS = 61 };

_Static_assert(OPTIONS <= 20, "given");

static const char about[] =
    "Runs friction solvers on problems from files and compares them: a table of the runs and,\n"
    "with --profiles, --plot or --json, the share rho_s(tau) of problems that solver s solves at a "
    "cost of at most tau times the\n"
    "least one. FILE: as for rollbem friction.";

static const char notes[] =
    "A run counts as failed, at infinite cost, when the error recomputed from r is above both\n"
    "the tolerance and the rounding floor, when the time limit is passed, or when the solver does\n"
    "not take the problem. Files that cannot be read are named and left out.\n"
    "Exit codes, the largest of all files: 0 all runs done, whatever their outcome; 64, 65, 66, "
    "70,\n"
    "73 as for rollbem friction; 1 when no file could be compared.\n";

typedef struct {
    rb_status status;
    rb_friction_info info;
} run_result;

typedef struct {
    const compare_options *o;
    int solvers, problems; /* problems: those that could be read */
    const char **solver;   /* names of static storage */
    char *names;           /* copy of --solvers, cut at its commas */
    const char **file;     /* problems */
    run_result *result;    /* solvers per problem */
    double tau[TAUS], *rho;
    rb_arena memory; /* of the arrays */
} comparison;

/* ---- Which solvers ----------------------------------------------------------------- */

static cli_exit choose_solvers(comparison *c)
{
    int n;
    const rb_friction_solver *all = rb_friction_solvers(&n);
    const char *given = c->o->solvers ? c->o->solvers : "";
    c->solver = rb_arena_zeros(&c->memory, (size_t)n, sizeof *c->solver); /* none is given twice */
    c->names = rb_arena_zeros(&c->memory, strlen(given) + 1, 1);
    if (c->memory.failed)
        return cli_fail(CLI_INTERNAL, "out of memory");
    strcpy(c->names, given);
    if (!c->o->solvers)
        for (int k = 0; k < n; k++)
            c->solver[c->solvers++] = all[k].name;
    for (char *name = c->names, *comma; c->o->solvers && name; name = comma) {
        comma = strchr(name, ',');
        if (comma)
            *comma++ = '\0';
        const rb_friction_solver *solver;
        const cli_exit code = cli_friction_solver("solvers", name, &solver);
        if (code != CLI_CONTINUE)
            return code;
        for (int s = 0; s < c->solvers; s++)
            if (c->solver[s] == solver->name)
                return cli_fail(CLI_USAGE, "--solvers: '%s' is given twice", name);
        c->solver[c->solvers++] = solver->name;
    }
    return CLI_CONTINUE;
}

/* ---- Runs -------------------------------------------------------------------------- */

static cli_exit run_file(comparison *c, const char *path)
{
    rb_friction_problem p;
    rb_message why = {.text = ""};
    cli_spool read;
    rb_status s = cli_spool_begin(path, &read, &why);
    if (s == RB_OK)
        s = rb_friction_read(cli_spool_path(&read), &p, &why);
    cli_spool_rename(&read, &why);
    cli_spool_end(&read);
    if (s == RB_OK && p.contacts == 0) {
        rb_friction_problem_free(&p);
        s = rb_fail(&why, RB_EFORMAT, "%s: no contact, nothing to compare", path);
    }
    if (s != RB_OK)
        return cli_say(s, &why);
    const size_t m = (size_t)(p.dimension * p.contacts);
    double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1);
    const rb_friction_solution solution = {r, u, NULL};
    rb_friction_options opt = rb_friction_defaults();
    opt.tol = c->o->tol;
    opt.measure = (rb_friction_measure_name)c->o->measure;
    opt.seconds = c->o->limit;
    opt.max_iters = c->o->max_iters;
    cli_exit code = r && u ? CLI_OK : cli_fail(CLI_INTERNAL, "out of memory");
    for (int k = 0; code == CLI_OK && k < c->solvers; k++) {
        run_result *one = &c->result[c->problems * c->solvers + k];
        cli_wait_begin();
        one->status = rb_friction_solve(c->solver[k], &p, &opt, &solution, &one->info);
        cli_wait_end();
        if (one->status == RB_ENOMEM)
            code = cli_fail(CLI_INTERNAL, "%s: %s: out of memory", path, c->solver[k]);
    }
    if (code == CLI_OK)
        c->file[c->problems++] = path;
    free(u);
    free(r);
    rb_friction_problem_free(&p);
    return code;
}

/* ---- Output ------------------------------------------------------------------------ */

static rb_status print_profiles(FILE *out, const void *context, rb_message *why)
{
    const comparison *c = context;
    rb_report_cells cells = rb_report_cells_begin(out, &c->o->style, "");
    (void)why;
    rb_report_cell_text(&cells, "tau");
    for (int s = 0; s < c->solvers; s++)
        rb_report_cell_text(&cells, c->solver[s]);
    rb_report_cells_end_row(&cells);
    rb_report_comment_origin(&cells, cli_command_line());
    rb_report_comment(&cells, "profiles over %s, %d problem%s", costs[c->o->cost].name, c->problems,
                      rb_plural(c->problems));
    for (int k = 0; k < TAUS; k++) {
        rb_report_cell_number(&cells, c->tau[k]);
        for (int s = 0; s < c->solvers; s++)
            rb_report_cell_number(&cells, c->rho[k + s * TAUS]);
        rb_report_cells_end_row(&cells);
    }
    return rb_report_flush(out);
}

static rb_status write_results(FILE *out, const void *context, rb_message *why)
{
    const comparison *c = context;
    cli_rows rows = cli_rows_begin(
        out, &c->o->style, "file solver status iterations residual floor flops seconds scaled");
    (void)why;
    for (int k = 0; k < c->problems * c->solvers; k++) {
        const run_result *one = &c->result[k];
        const rb_friction_info *info = &one->info;
        const char *status = one->status == RB_EINVAL
                                 ? "not taken"
                                 : rb_friction_status_text(one->status, c->o->tol, info);
        const cli_value values[] = {CLI_TEXT("file", "file", c->file[k / c->solvers]),
                                    CLI_TEXT("solver", "solver", c->solver[k % c->solvers]),
                                    CLI_WORDS("status", "status", status),
                                    CLI_WHOLE("iterations", "iterations", info->iters),
                                    CLI_NUMBER("residual", "residual", info->residual),
                                    CLI_NUMBER("scaled_residual", "scaled", info->scaled),
                                    CLI_NUMBER("floor", "floor", info->floor),
                                    CLI_NUMBER("flops", "flops", info->flops),
                                    CLI_NUMBER("seconds", "seconds", info->seconds)};
        cli_rows_add(&rows, sizeof values / sizeof *values, values);
    }
    if (!rows.is_json)
        return rb_report_flush(out);
    json_t *root = rb_report_json_start(cli_command_line()), *profiles = json_object();
    rb_report_json_set(&root, "cost", json_string(costs[c->o->cost].name));
    rb_report_json_set(&root, "measure", json_string(cli_friction_measures[c->o->measure].name));
    rb_report_json_set(&root, "tol", rb_report_json_number(c->o->tol));
    rb_report_json_set(&root, "runs", rows.list);
    rb_report_json_set(&root, "tau", rb_report_json_numbers(TAUS, c->tau));
    for (int s = 0; s < c->solvers; s++)
        rb_report_json_set(&profiles, c->solver[s],
                           rb_report_json_numbers(TAUS, c->rho + s * TAUS));
    rb_report_json_set(&root, "profiles", profiles);
    return rb_report_json_write(out, root);
}

static rb_status draw_profiles(FILE *out, rb_report_canvas canvas, const void *context,
                               rb_message *why)
{
    const comparison *c = context;
    const rb_report_profiles profiles = {.problems = c->problems,
                                         .solvers = c->solvers,
                                         .n = TAUS,
                                         .solver = c->solver,
                                         .measure = costs[c->o->cost].name,
                                         .tau = c->tau,
                                         .rho = c->rho};
    return rb_report_profiles_picture(out, canvas, &profiles, why);
}

/* ---- Command ----------------------------------------------------------------------- */

static cli_exit compare_files(comparison *c, int n, char **files)
{
    const size_t runs = (size_t)n * (size_t)c->solvers;
    c->file = rb_arena_zeros(&c->memory, (size_t)n, sizeof *c->file);
    c->result = rb_arena_zeros(&c->memory, runs, sizeof *c->result);
    c->rho = rb_arena_doubles(&c->memory, TAUS, (size_t)c->solvers);
    double *cost = rb_arena_doubles(&c->memory, runs, 1);
    if (c->memory.failed)
        return cli_fail(CLI_INTERNAL, "out of memory");
    cli_exit worst = CLI_OK, code;
    for (int k = 0; k < n; k++) {
        code = run_file(c, files[k]);
        worst = code > worst ? code : worst;
        if (code == CLI_INTERNAL)
            return code;
    }
    if (!c->problems)
        return worst;              /* of the files that cannot be read */
    for (int k = 0; k < TAUS; k++) /* 1 ... 1000, twenty in a decade */
        c->tau[k] = pow(10.0, 0.05 * k);
    for (int p = 0; p < c->problems; p++)
        for (int s = 0; s < c->solvers; s++) {
            const run_result *one = &c->result[p * c->solvers + s];
            const int solved = one->status == RB_OK && one->info.seconds <= c->o->limit;
            cost[p + s * c->problems] = !solved                      ? INFINITY
                                        : c->o->cost == COST_SECONDS ? one->info.seconds
                                        : c->o->cost == COST_FLOPS   ? fmax(one->info.flops, 1.0)
                                                                     : fmax(one->info.iters, 1.0);
        }
    rb_friction_profile(c->problems, c->solvers, cost, TAUS, c->tau, c->rho);
    code = cli_write_file(c->o->output, write_results, c);
    if (code == CLI_OK && c->o->profiles)
        code = cli_write_file(c->o->profiles, print_profiles, c);
    if (code == CLI_OK)
        code = cli_draw_file(&c->o->pictures, "plot", c->o->plot, draw_profiles, c);
    return code > worst ? code : worst;
}

int cli_compare(int argc, char **argv)
{
    compare_options o = {.tol = 1e-8, .limit = 1000.0};
    comparison c = {.o = &o};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem compare [OPTION...] FILE...",
                           .about = about,
                           .notes = notes,
                           .sets = {{options, OPTIONS, &o, o.given, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands < 1)
        code = cli_fail(CLI_USAGE, "compare: expected at least one FILE");
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE)
        code = choose_solvers(&c);
    if (code == CLI_CONTINUE)
        code = compare_files(&c, args.operands, args.operand);
    rb_arena_free(&c.memory);
    cli_args_free(&args);
    return code;
}
