/* rollbem example bar|truss|wall: the finite-element examples of the two papers. */
#include "program/cli/interrupt.h"
#include "program/cli/output.h"
#include "program/cli/rows.h"
#include "program/cli/solvers.h"
#include "program/cli/wait.h"

#include "base/io/io.h"
#include "fem/pictures.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *name; /* bar, truss or wall */
    const char *solver, *output, *plot;
    double tol, step, mu, load; /* mu, load < 0: the published ones */
    rb_report_style style;
    int quiet;
    int layout, nodes;         /* truss */
    int mesh, rigid, problems; /* wall */
    cli_pictures pictures;
    int given[20];
} example_options;

static const rb_choice layouts[] = {{"upper-inside", RB_FEM_UPPER_INSIDE},
                                    {"upper-overhanging", RB_FEM_UPPER_OVERHANGING},
                                    {NULL, 0}};

enum { MESH_COARSE, MESH_MEDIUM, MESH_FINE };

static const rb_choice meshes[] = {
    {"coarse", MESH_COARSE}, {"medium", MESH_MEDIUM}, {"fine", MESH_FINE}, {NULL, 0}};

#define PLACE(member) offsetof(example_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("example", "Example"),
    RB_TEXT_LINE("solver", PLACE(solver), "NAME", "friction solver, as in `rollbem friction`",
                 .unset = "bar nsn-nm, truss and wall nsn-ac"),
    RB_NUMBER_LINE("tol", PLACE(tol), "", RB_ABOVE(0.0), "tolerance of the friction solver"),
    RB_NUMBER_LINE("mu", PLACE(mu), "", RB_FROM(0.0), "bar, truss: friction coefficient",
                   .unset = "bar 1.3, truss 0.12"),
    RB_NUMBER_LINE("load", PLACE(load), "", RB_ABOVE(0.0),
                   "bar: pressure on top, and its growth on the right, per increment [MPa]; truss: "
                   "force on an inner node at gamma = 1 [N]",
                   .unset = "bar 0.01, truss 102900"),
    RB_CHOICE_LINE("layout", PLACE(layout), layouts,
                   "truss: the upper nodes; the paper has its layout in a figure only"),
    RB_INTEGER_LINE("nodes", PLACE(nodes), RB_FROM_TO(2, 100), "truss: contact nodes per side"),
    RB_CHOICE_LINE("mesh", PLACE(mesh), meshes,
                   "wall: 161, 606 or 1722 contact points; fine: as large as the paper's"),
    RB_NUMBER_LINE("step", PLACE(step), "s", RB_ABOVE(0.0), "wall: length of a time step"),
    RB_FLAG_LINE("rigid", PLACE(rigid), "wall: rigid blocks, the same contact points"),
    RB_INTEGER_LINE("problems", PLACE(problems), RB_FROM_TO(1, 75),
                    "wall: how many problems go to the folder"),
    CLI_STYLE_LINES(PLACE(style)),
    RB_TEXT_LINE("output", PLACE(output), "PATH",
                 "bar, truss: file for the table or JSON; wall: folder for its problems (FCLib)",
                 .unset = "none"),
    CLI_PLOT_LINES(PLACE(plot), PLACE(pictures)),
    RB_FLAG_LINE("quiet", PLACE(quiet), "do not print times; wall: no line per step"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS <= 20, "given");

static const char about[] =
    "Solves a finite-element example and prints one row per increment.\n"
    "  bar    Kanno, example 3.2: plane-strain bar on an obstacle, pushed from its end\n"
    "  truss  Kanno, example 3.1: double-layer grid of bars, loaded, then unloaded\n"
    "  wall   after Acary (2017): 12 elastic blocks in running bond, pressed and sheared;\n"
    "         implicit dynamics, backward Euler; one step under its weight, 10 in\n"
    "         which the force grows to 30 kN, 65 in which the upper support moves\n"
    "Units: bar and truss N, mm, MPa; wall SI. x to the right, the last axis up; normal\n"
    "reactions >= 0 push up.";

/* ---- Writing ----------------------------------------------------------------------- */

/* The end of a table, or the JSON of an example with its steps. */
static rb_status end_steps(FILE *out, const example_options *o, const cli_rows *rows)
{
    if (!rows->is_json)
        return rb_report_flush(out);
    json_t *root = rb_report_json_start(cli_command_line()), *inputs = json_object();
    rb_report_json_set(&inputs, "example", json_string(o->name));
    rb_report_json_set(&inputs, "solver", json_string(o->solver));
    rb_report_json_set(&inputs, "tol", rb_report_json_number(o->tol));
    if (strcmp(o->name, "wall") != 0) {
        rb_report_json_set(&inputs, "mu", rb_report_json_number(o->mu));
        rb_report_json_set(&inputs, strcmp(o->name, "bar") == 0 ? "load_MPa" : "load_N",
                           rb_report_json_number(o->load));
    }
    if (strcmp(o->name, "truss") == 0) {
        rb_report_json_set(&inputs, "layout", json_string(layouts[o->layout].name));
        rb_report_json_set(&inputs, "nodes", json_integer(o->nodes));
    } else if (strcmp(o->name, "wall") == 0) {
        rb_report_json_set(&inputs, "mesh", json_string(meshes[o->mesh].name));
        rb_report_json_set(&inputs, "rigid", json_boolean(o->rigid));
        rb_report_json_set(&inputs, "step_s", rb_report_json_number(o->step));
    }
    rb_report_json_set(&root, "inputs", inputs);
    rb_report_json_set(&root, "steps", rows->list);
    return rb_report_json_write(out, root);
}

/* A number of that name in table and JSON. */
#define NUMBER(name, x) CLI_NUMBER(name, name, x)
#define WHOLE(name, x) CLI_WHOLE(name, name, x)

/* ---- Bar and truss ----------------------------------------------------------------- */

typedef struct {
    const example_options *o;
    int is_bar;
    const rb_fem_model *model;
    const rb_fem_history *history;
} example_run;

static rb_status write_history(FILE *out, const void *context, rb_message *why)
{
    const example_run *r = context;
    cli_rows rows = cli_rows_begin(
        out, &r->o->style,
        r->is_bar ? "step stick slip separated corner_ux_mm corner_uy_mm normal_sum_N "
                    "tangential_sum_N iterations residual"
                  : "step stick slip separated max_increment_mm normal_sum_N iterations residual");
    (void)why;
    for (int k = 0; k < r->history->steps; k++) {
        enum { COMMON = 7 };
        const rb_fem_step *s = &r->history->step[k];
        const rb_fem_sums sums = rb_fem_sum(r->model, s);
        cli_value values[COMMON + 4] = {
            CLI_WHOLE(NULL, "step", k + 1),   CLI_TEXT("status", NULL, rb_status_text(s->status)),
            WHOLE("stick", s->stick),         WHOLE("slip", s->slip),
            WHOLE("separated", s->separated), WHOLE("iterations", s->iterations),
            NUMBER("residual", s->residual)};
        int n = COMMON;
        if (r->is_bar) {
            values[n++] = NUMBER("corner_ux_mm", sums.corner[0]);
            values[n++] = NUMBER("corner_uy_mm", sums.corner[1]);
        } else
            values[n++] = NUMBER("max_increment_mm", sums.increment);
        values[n++] = NUMBER("normal_sum_N", sums.normal);
        if (r->is_bar)
            values[n++] = NUMBER("tangential_sum_N", sums.tangential[0]);
        cli_rows_add(&rows, n, values);
    }
    return end_steps(out, r->o, &rows);
}

static rb_status draw_history(FILE *out, rb_report_canvas canvas, const void *context,
                              rb_message *why)
{
    const example_run *r = context;
    return (r->is_bar ? rb_fem_picture_bar : rb_fem_picture_truss)(out, canvas, r->model,
                                                                   r->history, why);
}

static cli_exit run_history(const example_options *o)
{
    rb_fem_model model;
    rb_fem_history history;
    rb_message why = {.text = ""};
    const int is_bar = strcmp(o->name, "bar") == 0;
    const cli_exit made =
        cli_say(is_bar ? rb_fem_model_bar(160, 16, &model, &why)
                       : rb_fem_model_truss((rb_fem_layout)o->layout, o->nodes, &model, &why),
                &why);
    if (made != CLI_CONTINUE)
        return made;
    rb_fem_model_change(&model, o->mu,
                        o->load / (is_bar ? RB_FEM_BAR_PRESSURE : RB_FEM_TRUSS_LOAD));
    if (!o->quiet)
        cli_wait_begin();
    const rb_status s = rb_fem_run(&model, o->solver, o->tol, &history, &why);
    if (!o->quiet)
        cli_wait_end();
    const example_run r = {o, is_bar, &model, &history};
    const int begun = s >= RB_OK && history.steps > 0;
    cli_exit code = CLI_OK;
    if (begun)
        code = cli_write_file(o->output, write_history, &r);
    if (begun && code == CLI_OK)
        code = cli_draw_file(&o->pictures, "plot", o->plot, draw_history, &r);
    if (s != RB_OK && code == CLI_OK)
        code = cli_say(s, &why);
    rb_fem_history_free(&history);
    rb_fem_model_free(&model);
    return code;
}

/* ---- Wall -------------------------------------------------------------------------- */

typedef struct {
    const example_options *o;
    rb_fem_wall *wall;
    rb_fem_wall_step *step;
    int steps;
} wall_run;

static rb_status write_wall(FILE *out, const void *context, rb_message *why)
{
    const wall_run *run = context;
    cli_rows rows = cli_rows_begin(out, &run->o->style,
                                   "time_s compression_N shear_N drift_m stick slip separated "
                                   "iterations residual seconds");
    (void)why;
    for (int k = 0; k < run->steps; k++) {
        const rb_fem_wall_step *s = &run->step[k];
        const cli_value values[] = {
            NUMBER("time_s", s->time),        NUMBER("compression_N", s->compression),
            NUMBER("shear_N", s->shear),      NUMBER("drift_m", s->drift),
            WHOLE("stick", s->stick),         WHOLE("slip", s->slip),
            WHOLE("separated", s->separated), WHOLE("iterations", s->iterations),
            NUMBER("residual", s->residual),  NUMBER("seconds", s->seconds)};
        cli_rows_add(&rows, sizeof values / sizeof *values, values);
    }
    return end_steps(out, run->o, &rows);
}

static rb_status draw_wall(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const wall_run *run = context;
    return rb_fem_picture_wall(out, canvas, run->wall, run->steps, run->step, why);
}

static int is_interrupted(void *context)
{
    (void)context;
    return cli_interrupted();
}

static cli_exit finish_wall(const wall_run *run)
{
    const example_options *o = run->o;
    cli_exit code = cli_write_file(NULL, write_wall, run);
    if (code == CLI_OK)
        code = cli_draw_file(&o->pictures, "plot", o->plot, draw_wall, run);
    if (code == CLI_OK && o->output) {
        int chosen[75];
        rb_message why = {.text = ""};
        const int solved = run->steps - 1; /* the first step, under the weight, is none */
        const int count = run->o->problems < solved ? run->o->problems : solved;
        rb_status s = rb_io_make_folder(run->o->output, &why);
        if (s == RB_OK && count > 0)
            s = rb_fem_wall_select(run->wall, count, chosen);
        for (int k = 0; s == RB_OK && k < count; k++) {
            const int step = chosen[k];
            char name[40], title[200];
            rb_friction_problem problem = {0};
            snprintf(name, sizeof name, "wall-%02d.hdf5", k + 1);
            snprintf(title, sizeof title, "rollbem wall, step %d, solved in %d iteration%s",
                     step + 1, run->step[step].iterations, rb_plural(run->step[step].iterations));
            char *path = rb_io_join(run->o->output, name);
            s = path ? rb_fem_wall_problem(run->wall, step, &problem) : RB_ENOMEM;
            if (s == RB_OK)
                s = rb_friction_write(path, &problem, NULL, title, &why);
            rb_friction_problem_free(&problem);
            free(path);
        }
        code = s == RB_OK ? CLI_OK : cli_say(s, &why);
    }
    return code;
}

static cli_exit run_wall(const example_options *o)
{
    static const int fine[2][3] = {{4, 3, 3}, {8, 6, 3}}, coarse[2][3] = {{3, 2, 3}, {4, 3, 3}};
    rb_fem_wall_options w = rb_fem_wall_defaults();
    if (o->mesh != MESH_FINE) {
        memcpy(w.fine, fine[o->mesh], sizeof w.fine);
        memcpy(w.coarse, coarse[o->mesh], sizeof w.coarse);
    }
    w.rigid = o->rigid;
    w.dt = o->step;
    w.stopped = is_interrupted;
    wall_run run = {.o = o};
    rb_message why = {.text = ""};
    rb_status s = rb_fem_wall_create(&w, &run.wall, &why);
    if (s != RB_OK)
        return cli_say(s, &why);
    if (!o->quiet) {
        const int contacts = rb_fem_wall_contacts(run.wall);
        int rank;
        fprintf(stderr, "wall: %d contact points, %d degrees of freedom\n", contacts,
                rb_fem_wall_dofs(run.wall));
        if (rb_fem_wall_rank(run.wall, &rank) == RB_OK)
            fprintf(stderr, "H has rank %d: %d time%s hyperstatic\n", rank, 3 * contacts - rank,
                    rb_plural(3 * contacts - rank));
    }
    const int planned = rb_fem_wall_steps(run.wall);
    run.step = calloc((size_t)planned, sizeof *run.step);
    s = run.step ? RB_OK : rb_fail(&why, RB_ENOMEM, "out of memory");
    cli_interrupts_catch();
    while (s == RB_OK && run.steps < planned && !cli_interrupted()) {
        rb_fem_wall_step *step = &run.step[run.steps];
        s = rb_fem_wall_advance(run.wall, o->solver, o->tol, step, &why);
        if (s < RB_OK || s == RB_INTERRUPTED)
            break;
        run.steps++;
        if (!o->quiet)
            fprintf(stderr, "step %d of %d: shear %.0f N, %d iteration%s, %.2f s\n", run.steps,
                    planned, rint(step->shear) + 0.0, /* no -0 */
                    step->iterations, rb_plural(step->iterations), step->seconds);
    }
    cli_interrupts_leave();
    if (s == RB_OK && run.steps < planned)
        s = rb_fail(&why, RB_INTERRUPTED, "interrupted after step %d", run.steps);
    cli_exit code = s == RB_OK ? CLI_OK : cli_say(s, &why);
    if (run.steps > 0) {
        const cli_exit finished = finish_wall(&run);
        code = code == CLI_OK ? finished : code;
    }
    free(run.step);
    rb_fem_wall_free(run.wall);
    return code;
}

/* ---- Command ----------------------------------------------------------------------- */

static const struct {
    const char *name, *about, *solver; /* the quickest */
    double mu, load;                   /* the published ones; 0: no option */
    cli_exit (*run)(const example_options *o);
} finite_elements[] = {
    {"bar", "an elastic bar on an obstacle, pushed from its end (Kanno, example 3.2)", "nsn-nm",
     RB_FEM_BAR_MU, RB_FEM_BAR_PRESSURE, run_history},
    {"truss", "a double-layer grid of bars, loaded, then unloaded (Kanno, 3.1)", "nsn-ac",
     RB_FEM_TRUSS_MU, RB_FEM_TRUSS_LOAD, run_history},
    {"wall", "12 elastic blocks in running bond, pressed and sheared (after Acary 2017)", "nsn-ac",
     0.0, 0.0, run_wall}};
enum { FINITE_ELEMENTS = sizeof finite_elements / sizeof finite_elements[0] };

int cli_example(int argc, char **argv)
{
    if (argc > 1 && cli_example_is_case(argv[1])) {
        /* One of the cases of --example. */
        char **words = calloc((size_t)argc + 2, sizeof *words), option[] = "--example";
        if (!words)
            return cli_fail(CLI_INTERNAL, "out of memory");
        words[0] = argv[0];
        words[1] = option;
        for (int k = 1; k < argc; k++)
            words[k + 1] = argv[k];
        const int code = cli_run("", argc + 1, words);
        free(words);
        return code;
    }
    example_options o = {.tol = 1e-10,
                         .mu = -1.0,
                         .load = -1.0,
                         .step = 1e-2,
                         .nodes = 12,
                         .mesh = MESH_FINE,
                         .problems = 50};
    cli_args args = {0};
    const cli_spec spec = {.synopsis = "rollbem example [OPTION...] bar|truss|wall",
                           .about = about,
                           .sets = {{options, OPTIONS, &o, o.given, NULL}},
                           .set_n = 1};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE)
        code = cli_check_files(&spec, &args);
    if (code == CLI_CONTINUE && args.operands != 1)
        code = cli_fail(CLI_USAGE, "example: expected one of bar, truss, wall");
    const char *name = args.operand ? args.operand[0] : NULL;
    if (code == CLI_CONTINUE && o.output) { /* a folder or a file */
        rb_message why = {.text = ""};
        code = cli_say(strcmp(name, "wall") == 0 ? rb_io_folder_check(o.output, &why)
                                                 : rb_io_writer_check(o.output, &why),
                       &why);
    }
    const rb_friction_solver *solver;
    if (code == CLI_CONTINUE && o.solver)
        code = cli_friction_solver("solver", o.solver, &solver);
    if (code == CLI_CONTINUE) {
        rb_guess guess = {.word = name};
        int k = 0;
        while (k < FINITE_ELEMENTS && strcmp(finite_elements[k].name, name) != 0)
            rb_guess_try(&guess, finite_elements[k++].name);
        if (k < FINITE_ELEMENTS) {
            o.name = name;
            o.solver = o.solver ? o.solver : finite_elements[k].solver;
            const int fixed = finite_elements[k].load == 0.0;
            code =
                fixed && (o.mu >= 0.0 || o.load > 0.0)
                    ? cli_fail(CLI_USAGE,
                               "example: --mu and --load belong to bar and truss, not to %s", name)
                    : CLI_CONTINUE;
            o.mu = o.mu >= 0.0 ? o.mu : finite_elements[k].mu;
            o.load = o.load > 0.0 ? o.load : finite_elements[k].load;
            code = code == CLI_CONTINUE ? finite_elements[k].run(&o) : code;
        } else
            code = cli_fail(CLI_USAGE,
                            "example: expected bar, truss, wall or a name that `rollbem examples` "
                            "lists, got '%s'%s",
                            name, rb_guess_text(&guess, ""));
    }
    cli_args_free(&args);
    return code;
}

/* ---- rollbem examples ---------------------------------------------------------------- */

static void list_example(json_t **list, const char *name, const char *kind, const char *what)
{
    json_t *one = json_object();
    const size_t n = strlen(what);
    rb_report_json_set(&one, "name", json_string(name));
    rb_report_json_set(&one, "kind", json_string(kind));
    rb_report_json_set(&one, "about", json_stringn(what, n > 0 && what[n - 1] == ' ' ? n - 1 : n));
    rb_report_json_append(list, one);
}

static rb_status write_examples(FILE *out, const void *context, rb_message *why)
{
    json_t *root = rb_report_json_start(cli_command_line()), *list = json_array();
    char name[60], text[1000];
    (void)context;
    (void)why;
    for (int k = 0; cli_example_about(k, name, sizeof name, text, sizeof text); k++)
        list_example(&list, strrchr(name, ' ') + 1, "case", text);
    for (int k = 0; k < FINITE_ELEMENTS; k++)
        list_example(&list, finite_elements[k].name, "finite elements", finite_elements[k].about);
    rb_report_json_set(&root, "examples", list);
    return rb_report_json_write(out, root);
}

int cli_examples(int argc, char **argv)
{
    static const rb_option json_option[] = {
        RB_GROUP_LINE("output", "Output"),
        RB_FLAG_LINE("json", 0, "names and descriptions as JSON"),
    };
    int json = 0;
    const cli_spec spec = {
        .synopsis = "rollbem examples [--json]",
        .about = "Lists the cases that --example NAME starts from, and what they are.",
        .sets = {{json_option, sizeof json_option / sizeof json_option[0], &json, NULL, NULL}},
        .set_n = 1};
    cli_args args = {0};
    cli_exit code = cli_parse(&spec, argc, argv, &args);
    if (code == CLI_CONTINUE && args.operands > 0)
        code = cli_fail(CLI_USAGE, "examples: unexpected '%s'", args.operand[0]);
    if (code == CLI_CONTINUE && json)
        code = cli_write_file(NULL, write_examples, NULL);
    if (code == CLI_CONTINUE) {
        char name[60], text[1000];
        FILE *pager = cli_open_pager();
        puts("rollbem --example NAME solves one; every command that takes a case takes it.");
        for (int k = 0; cli_example_about(k, name, sizeof name, text, sizeof text); k++)
            cli_print_entry(name, text);
        puts("rollbem example NAME solves finite elements with friction.");
        for (int k = 0; k < FINITE_ELEMENTS; k++) {
            snprintf(name, sizeof name, "example %s", finite_elements[k].name);
            cli_print_entry(name, finite_elements[k].about);
        }
        cli_close_pager(pager);
        code = CLI_OK;
    }
    cli_args_free(&args);
    return code;
}
