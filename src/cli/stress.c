/* rollbem stress: the stress below the surface of body A. */
#include "cli/case.h"
#include "cli/output.h"
#include "cli/run.h"

#include <jansson.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *grid, *points, *vtk, *fringes, *map;
    double depth, fringe, yield_shear;
    int shakedown, given[10], plain[10];
} stress_options;

#define PLACE(member) offsetof(stress_options, member)

static const rb_option options[] = {
    RB_GROUP_LINE("stress", "Stress"),
    RB_TEXT_LINE("grid", PLACE(grid), "NXxNY",
                 "points along the surface and into the depth", .unset = "61x41"),
    RB_NUMBER_LINE("depth", PLACE(depth), "mm", RB_ABOVE(0),
                   "of the grid and of the search for maxima; auto: 2.5 half-widths",
                   .word = "auto", .word_value = 0.0),
    RB_TEXT_LINE("points", PLACE(points), "FILE",
                 "instead of a grid: rows x, y [mm], y > 0 inside A", .unset = "none",
                 .file = RB_FILE_READ),
    RB_TEXT_LINE("vtk", PLACE(vtk), "FILE",
                 "for ParaView: .vtu, or .vti (half-planes only)", .unset = "none",
                 .file = RB_FILE_WRITTEN),
    RB_TEXT_LINE("fringes", PLACE(fringes), "FILE",
                 "picture of photoelastic fringes: .png, .svg or .pdf", .unset = "none",
                 .file = RB_FILE_PICTURE),
    RB_NUMBER_LINE("fringe", PLACE(fringe), "MPa", RB_ABOVE(0),
                   "difference of the principal stresses from one fringe to the next; "
                   "auto: about ten fringes",
                   .word = "auto", .word_value = 0.0),
    RB_FLAG_LINE(
        "shakedown", PLACE(shakedown),
        "largest p0 under which residual stresses keep A elastic, where the contact "
        "passes again and again (Melan, Tresca)"),
    RB_NUMBER_LINE("yield-shear", PLACE(yield_shear), "MPa", RB_ABOVE(0),
                   "yield stress k of A in shear: where the case stands",
                   .unset = "not given"),
    RB_TEXT_LINE("shakedown-map", PLACE(map), "FILE",
                 "picture of p0/k over Q/P with the case: .png, .svg or .pdf",
                 .unset = "none", .file = RB_FILE_PICTURE),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert(OPTIONS == 10, "given");

/* Pictures are finer than tables, and fringes finer than contours. */
enum { CONTOURS_X = 161, CONTOURS_Y = 101, FRINGES_X = 241, FRINGES_Y = 151 };

static const char about[] =
    "Solves a case and prints the stress in body A below the contact: the tensor\n"
    "(tension positive), principal stresses, maximum shear, von Mises, hydrostatic\n"
    "stress; in the header, the values and places of the maxima. --plot draws contours\n"
    "of maximum shear and von Mises. The grid reaches a half-width beyond the contact\n"
    "and follows the surface of a wheel.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES "Example: rollbem stress --support halfplane "
                                           "--similar --load 500 --plot stress.png\n";

/* ---- What is asked for ----------------------------------------------------------------
 */

typedef struct {
    int nx, ny;
    double depth;
    rb_io_table points; /* rows = 0: the grid */
    double *xy;         /* points.rows pairs; owned */
} places;

static cli_exit read_grid(const stress_options *o, places *p)
{
    int end = 0;
    p->nx = 61;
    p->ny = 41;
    p->depth = o->depth;
    if (o->grid && (sscanf(o->grid, "%5dx%5d%n", &p->nx, &p->ny, &end) != 2 ||
                    o->grid[end] || p->nx < 2 || p->ny < 2))
        return cli_fail(CLI_USAGE,
                        "--grid: expected two numbers >= 2 such as 61x41, got '%s'",
                        o->grid);
    if (o->grid && o->points)
        return cli_fail(CLI_USAGE, "--grid and --points exclude each other");
    return CLI_CONTINUE;
}

static cli_exit read_points(const stress_options *o, rb_units units, places *p)
{
    if (!o->points)
        return CLI_CONTINUE;
    rb_message why;
    const rb_status s = rb_io_table_read_columns(o->points, 2, &p->points, &why);
    const int n = p->points.rows;
    if (s != RB_OK)
        return cli_say(s, &why);
    p->xy = rb_alloc((size_t)n, 2);
    if (!p->xy)
        return cli_fail(CLI_INTERNAL, "out of memory");
    for (int j = 0; j < 2; j++)
        rb_io_table_convert(&p->points, j, "mm", units);
    for (int k = 0; k < n; k++) {
        p->xy[2 * k] = p->points.x[k];
        p->xy[2 * k + 1] = p->points.x[k + n];
    }
    return CLI_CONTINUE;
}

static cli_exit check_vtk(const stress_options *o, const rb_settled_case *c)
{
    rb_report_vtk_kind kind;
    rb_message why;
    const rb_report_stress asked = {.nx = o->points ? 0 : 1, .rc = &c->rc};
    if (o->vtk && (rb_report_vtk_kind_of(o->vtk, &kind, &why) != RB_OK ||
                   rb_report_vtk_check(kind, &asked, &why) != RB_OK))
        return cli_fail(CLI_USAGE, "--vtk: %s", why.text);
    return CLI_CONTINUE;
}

/* ---- Stress ---------------------------------------------------------------------------
 */

typedef struct {
    const rb_case *words;
    const rb_settled_case *c;
    const stress_options *options;
    const cli_output *o;
    const places *where;
    rb_case_result run;
    rb_rolling_stress_maxima maxima;
    rb_rolling_shakedown shakedown;
    rb_rolling_errors errors;          /* with --error */
    rb_rolling_stress_grid grid, fine; /* fine: of the pictures */
    rb_rolling_stress *at;             /* of the points */
    rb_report_stress table, picture;
} result;

static void result_free(result *r)
{
    rb_case_result_free(&r->run);
    rb_rolling_stress_grid_free(&r->grid);
    rb_rolling_stress_grid_free(&r->fine);
    free(r->at);
}

/* The first point that is not in the body is named by its line. */
static rb_status stress_at_points(result *r, rb_message *why)
{
    const places *p = r->where;
    const int n = p->points.rows;
    int *inside = rb_alloc_int((size_t)n);
    r->at = calloc((size_t)n, sizeof *r->at);
    rb_status s = inside && r->at ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_rolling_inside(&r->run.model, n, p->xy, inside);
    for (int k = 0; k < n && s == RB_OK; k++)
        if (!inside[k])
            s = rb_fail(why, RB_EFORMAT,
                        "%.200s:%d: the point (%g, %g) mm lies outside body A",
                        r->options->points, p->points.line[k], p->points.x[k],
                        p->points.x[k + n]);
    if (s == RB_OK)
        s = rb_rolling_stress_at(&r->run.model, n, p->xy, r->at, why);
    free(inside);
    return s;
}

static int wants_shakedown(const stress_options *o)
{
    return o->shakedown || o->map || !isnan(o->yield_shear);
}

static rb_report_stress of_grid(const result *r, const rb_rolling_stress_grid *grid)
{
    return (rb_report_stress){
        .nx = grid->nx,
        .ny = grid->ny,
        .n = grid->nx * grid->ny,
        .at = grid->at,
        .inside = grid->inside,
        .maxima = &r->maxima,
        .errors = r->c->error ? &r->errors.stress : NULL,
        .shakedown = wants_shakedown(r->options) ? &r->shakedown : NULL,
        .yield_shear = rb_unit_shown(r->c->units, "MPa", r->options->yield_shear),
        .rc = &r->c->rc,
        .s = &r->run.solution};
}

/* The model belongs to a plain solution, whose error bars follow. */
static rb_status run_case(result *r, rb_message *why)
{
    rb_settled_case plain = *r->c;
    rb_rolling_stress_maxima maxima;
    plain.error = 0;
    rb_status s = cli_run_case(&plain, NULL, &r->run, why);
    if (s == RB_OK && r->c->error)
        s = rb_rolling_stress_maxima_find(&r->run.model, 0.0, &maxima, why);
    if (s == RB_OK && r->c->error)
        s = rb_rolling_estimate_errors(&r->c->rc, &r->run.solution, &maxima, &r->errors,
                                       why);
    return s;
}

static void convert(result *r, rb_units units)
{
    rb_rolling_stress_maxima none = r->maxima;
    rb_case_result_convert(&r->run, units);
    rb_rolling_solution_convert(&r->errors.scalar, units);
    rb_rolling_stress_convert(0, NULL, &r->errors.stress, units);
    rb_rolling_stress_convert(r->at ? r->where->points.rows : 0, r->at, &none, units);
    rb_rolling_stress_convert(r->grid.nx * r->grid.ny, r->grid.at, &r->maxima, units);
    rb_rolling_stress_convert(r->fine.nx * r->fine.ny, r->fine.at, &none, units);
}

static rb_status find_stress(result *r, rb_message *why)
{
    const places *p = r->where;
    const rb_rolling_model *model = &r->run.model;
    rb_status s = rb_rolling_stress_maxima_find(model, p->depth, &r->maxima, why);
    if (s == RB_OK && wants_shakedown(r->options))
        s = rb_rolling_shakedown_find(model, &r->shakedown, why);
    if (s == RB_OK && p->points.rows > 0)
        s = stress_at_points(r, why);
    else if (s == RB_OK)
        s = rb_rolling_stress_on_grid(model, p->nx, p->ny, p->depth, &r->grid, why);
    if (s == RB_OK && r->options->fringes)
        s = rb_rolling_stress_on_grid(model, FRINGES_X, FRINGES_Y, p->depth, &r->fine,
                                      why);
    else if (s == RB_OK && r->o->plot)
        s = rb_rolling_stress_on_grid(model, CONTOURS_X, CONTOURS_Y, p->depth, &r->fine,
                                      why);
    convert(r, r->c->units);
    r->shakedown.x = rb_unit_shown(r->c->units, "mm", r->shakedown.x);
    r->shakedown.y = rb_unit_shown(r->c->units, "mm", r->shakedown.y);
    r->shakedown.residual = rb_unit_shown(r->c->units, "MPa", r->shakedown.residual);
    r->shakedown.shear_yield =
        rb_unit_shown(r->c->units, "MPa", r->shakedown.shear_yield);
    r->table = of_grid(r, &r->grid);
    r->picture = of_grid(r, &r->fine);
    if (p->points.rows > 0) {
        r->table.n = p->points.rows;
        r->table.at = r->at;
    }
    return s;
}

/* ---- Print ----------------------------------------------------------------------------
 */

static rb_status print_json(FILE *out, const result *r)
{
    json_t *root =
        cli_case_json(r->words, &r->run.solution, rb_report_json_inputs(r->words));
    rb_report_json_set(&root, "summary", rb_report_json_summary(&r->run.solution));
    rb_report_json_stress(&root, &r->table);
    return rb_report_json_write(out, root);
}

static rb_status print(FILE *out, const void *context, rb_message *why)
{
    const result *r = context;
    (void)why;
    return r->o->style.format == RB_REPORT_JSON
               ? print_json(out, r)
               : rb_report_stress_table(out, &r->table, cli_command_line(), &r->o->style);
}

static rb_status print_vtk(FILE *out, const void *context, rb_message *why)
{
    const result *r = context;
    rb_report_vtk_kind kind;
    const rb_status s = rb_report_vtk_kind_of(r->options->vtk, &kind, why);
    return s == RB_OK ? rb_report_vtk(out, kind, &r->table) : s;
}

static rb_status draw(FILE *out, rb_report_canvas canvas, const void *context,
                      rb_message *why)
{
    const result *r = context;
    return rb_report_stress_picture(out, canvas, &r->picture, why);
}

static rb_status draw_fringes(FILE *out, rb_report_canvas canvas, const void *context,
                              rb_message *why)
{
    const result *r = context;
    return rb_report_fringes(out, canvas, &r->picture,
                             rb_unit_shown(r->c->units, "MPa", r->options->fringe), why);
}

static rb_status draw_map(FILE *out, rb_report_canvas canvas, const void *context,
                          rb_message *why)
{
    const result *r = context;
    return rb_report_shakedown_map(out, canvas, &r->table, why);
}

static cli_exit show(const result *r)
{
    cli_exit code = cli_write_file(r->o->output, print, r);
    if (code == CLI_OK && !r->o->quiet) {
        rb_report_notes(stderr, &r->c->rc, &r->run.solution);
        rb_report_summary(stderr, &r->run.solution, cli_terminal_width());
        rb_report_stress_summary(stderr, &r->table);
    }
    if (code == CLI_OK && r->o->cite)
        rb_report_citations(stderr, &r->c->rc, &r->run.solution);
    if (code == CLI_OK && r->options->vtk)
        code = cli_write_file(r->options->vtk, print_vtk, r);
    if (code == CLI_OK)
        code = cli_draw_file(&r->o->pictures, "plot", r->o->plot, draw, r);
    if (code == CLI_OK)
        code = cli_draw_file(&r->o->pictures, "fringes", r->options->fringes,
                             draw_fringes, r);
    if (code == CLI_OK)
        code =
            cli_draw_file(&r->o->pictures, "shakedown-map", r->options->map, draw_map, r);
    return code;
}

/* ---- Command --------------------------------------------------------------------------
 */

static cli_exit solve(const rb_case *words, const stress_options *so, const places *where,
                      const cli_output *o)
{
    result r = {.words = words,
                .c = rb_case_settled(words),
                .options = so,
                .o = o,
                .where = where};
    rb_message why = {""};
    rb_status s = run_case(&r, &why);
    if (s == RB_OK)
        s = find_stress(&r, &why);
    cli_exit code = s == RB_OK ? show(&r) : CLI_OK;
    if (code == CLI_OK && s != RB_OK)
        code = cli_case_refused(words, s, &why);
    result_free(&r);
    return code;
}

static cli_exit check_known(const rb_case *c)
{
    rb_message why;
    const rb_status s = rb_rolling_stress_check(&rb_case_settled(c)->rc, &why);
    return s == RB_OK ? CLI_CONTINUE : cli_case_refused(c, s, &why);
}

static cli_exit check(const rb_case *c, const stress_options *so, places *where)
{
    cli_exit code = check_known(c);
    if (code == CLI_CONTINUE)
        code = check_vtk(so, rb_case_settled(c));
    if (code == CLI_CONTINUE)
        code = read_grid(so, where);
    const rb_units units = cli_units_of(c, options, OPTIONS, so->given, "points");
    return code == CLI_CONTINUE ? read_points(so, units, where) : code;
}

int cli_stress(int argc, char **argv)
{
    cli_output o = {0};
    stress_options so = {.yield_shear = NAN};
    places where = {0};
    cli_args args = {0};
    rb_case *c = cli_case_create(RB_CASE_STRESS);
    if (!c)
        return CLI_INTERNAL;
    const cli_spec spec = {"rollbem stress [OPTION...] [CASE.ini]",
                           about,
                           notes,
                           {rb_case_options(c),
                            {options, OPTIONS, &so, so.given, so.plain},
                            cli_output_set(&o),
                            cli_example_set()},
                           4};
    cli_exit code = cli_case_parse(&spec, argc, argv, c, &args);
    if (code == CLI_CONTINUE) {
        rb_option_store(&spec.sets[1], rb_case_settled(c)->units, rb_case_file_units(c),
                        &so);
        code = check(c, &so, &where);
    }
    if (code == CLI_CONTINUE)
        code = solve(c, &so, &where, &o);
    rb_io_table_free(&where.points);
    free(where.xy);
    cli_args_free(&args);
    rb_case_free(c);
    return code;
}
