/* rollbem stress: the stress below the surface of a body. */
#include "program/cli/case.h"
#include "program/cli/run.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    /* options */
    const char *grid, *points, *tractions, *vtk, *fringes, *map;
    double depth, fringe, yield_shear;
    int shakedown, of_b, whole;
    /* where the stress is asked for */
    int nx, ny;        /* of the grid */
    rb_io_table place; /* the file of points; rows = 0: the grid */
    double *xy;        /* place.rows pairs; owned */
    rb_io_table read;  /* the file of tractions */
    double *none;      /* zeros of it; owned */
    rb_rolling_traction_rows rows;
    /* results */
    rb_case_result run;
    rb_rolling_mirror *mirror; /* B, of run's model; NULL: A is asked for; owned */
    rb_rolling_stress_maxima maxima;
    rb_rolling_shakedown found;
    rb_rolling_errors errors;        /* with --error */
    rb_rolling_stress_grid at, fine; /* fine: of the pictures */
    rb_rolling_stress *at_points;    /* of the points */
    rb_report_stress table, picture;
} stress;

#define PLACE(member) offsetof(stress, member)

static const rb_choice bodies[] = {{"a", 0}, {"b", 1}, {NULL, 0}};

static const rb_option options[] = {
    RB_GROUP_LINE("stress", "Stress"),
    RB_CHOICE_LINE("body", PLACE(of_b), bodies,
                   "whose stress: A's, at y >= 0, or B's, at y <= 0 (rail, race, counter disc)"),
    RB_TEXT_LINE("grid", PLACE(grid), "NXxNY", "points along the surface and into the depth",
                 .unset = "61x41"),
    RB_NUMBER_LINE("depth", PLACE(depth), "mm", RB_ABOVE(0),
                   "of the grid and of the search for maxima; auto: a grid of 2.5 half-widths, "
                   "maxima in all of the body",
                   .word = "auto", .word_value = 0.0),
    RB_FLAG_LINE("whole", PLACE(whole),
                 "the grid and its pictures show the whole wheel: points around it, and from its "
                 "surface inwards; contours and fringes are those far from the contact"),
    RB_TEXT_LINE("points", PLACE(points), "FILE",
                 "instead of a grid: rows x, y [mm], y > 0 inside A, y < 0 inside B",
                 .unset = "none", .file = RB_FILE_READ),
    RB_TEXT_LINE("tractions", PLACE(tractions), "FILE",
                 "instead of a contact: rows x [mm], p, q [MPa] on A, linear between them, zero "
                 "outside, twice the same x: a jump; with h and zone: elements, as rollbem prints "
                 "them",
                 .unset = "none", .file = RB_FILE_READ),
    RB_TEXT_LINE("vtk", PLACE(vtk), "FILE", "for ParaView: .vtu, or .vti (half-planes only)",
                 .unset = "none", .file = RB_FILE_WRITTEN),
    CLI_PICTURE_LINE("fringes", PLACE(fringes), "picture of photoelastic fringes"),
    RB_NUMBER_LINE("fringe", PLACE(fringe), "MPa", RB_ABOVE(0),
                   "difference of the principal stresses from one fringe to the next; "
                   "auto: about ten fringes",
                   .word = "auto", .word_value = 0.0),
    RB_FLAG_LINE("shakedown", PLACE(shakedown),
                 "largest p0 at which residual stresses keep the body elastic under repeated "
                 "rolling (Melan, Tresca)"),
    RB_NUMBER_LINE("yield-shear", PLACE(yield_shear), "MPa", RB_ABOVE(0),
                   "yield stress k of the body in shear; shows the case in the map",
                   .unset = "not given"),
    CLI_PICTURE_LINE("shakedown-map", PLACE(map), "picture of p0/k over Q/P with the case"),
};

enum { OPTIONS = sizeof options / sizeof options[0] };

_Static_assert((int)OPTIONS <= (int)CLI_COMMAND_OPTIONS_MAX, "given");

/* Pictures are finer than tables, and fringes finer than contours. */
enum {
    CONTOURS_X = 161,
    CONTOURS_Y = 101,
    FRINGES_X = 241,
    FRINGES_Y = 151,
    WHOLE_FRINGES_X = 401
};

static const char about[] =
    "Solves a case and prints the stress in body A above the contact, or in B below it\n"
    "(--body b): the tensor (tension positive), principal stresses in the plane, the largest shear "
    "in the plane\n"
    "and of all planes (Tresca), von Mises, hydrostatic stress; in the header, the values\n"
    "and places of the maxima in all of the body, of two materials also which one. --plot draws\n"
    "contours of the in-plane shear and von Mises. The grid reaches a half-width beyond\n"
    "the contact and follows the surface of a wheel.\n"
    "\n" CLI_CASE_SIGNS;

static const char notes[] = CLI_CASE_NOTES "Example: rollbem stress --support halfplane "
                                           "--similar --load 500 --plot stress.png\n";

/* ---- What is asked for ------------------------------------------------------------ */

/* The grid's size; 0: its text has none. */
static int read_grid(stress *st)
{
    const double most = 1e8; /* of rb_rolling_stress_on_grid */
    int end = 0;
    st->nx = 61;
    st->ny = 41;
    return !st->grid ||
           (sscanf(st->grid, "%9dx%9d%n", &st->nx, &st->ny, &end) == 2 && !st->grid[end] &&
            st->nx >= 2 && st->ny >= 2 && (double)st->nx * st->ny <= most);
}

/* Given tractions act on a half-plane, and nothing is solved: what else a case has says nothing. */
static cli_exit prepare_stress(cli_case_run *run)
{
    const stress *st = run->own;
    if (!st->tractions)
        return CLI_CONTINUE;
    const rb_option_set all = rb_case_options(run->words), *set = &all;
    rb_message why = {.text = ""};
    char buffer[400];
    for (int k = 0; k < set->n; k++) {
        const int is_kept = !set->given[k] || rb_case_is_of_tractions(set->options[k].name);
        if (!is_kept && set->given[k] > 0 && !cli_case_file_of(&run->args))
            return cli_fail(CLI_USAGE, "--example: with --tractions no contact is solved; leave it "
                                       "out");
        if (!is_kept)
            return cli_fail(CLI_USAGE, "%s: with --tractions no contact is solved; leave it out",
                            rb_option_source(&set->options[k], set->given[k],
                                             cli_case_file_of(&run->args), buffer, sizeof buffer));
    }
    return rb_case_given(run->words, "support")
               ? CLI_CONTINUE
               : cli_say(rb_case_set(run->words, "support", "halfplane", RB_GIVEN_ARGUMENT, &why),
                         &why);
}

static cli_exit check_stress(cli_case_run *run)
{
    stress *st = run->own;
    rb_report_vtk_kind kind;
    rb_message why = {.text = ""};
    const rb_report_stress asked = {.of_b = st->of_b, .nx = st->points ? 0 : 1, .rc = &run->c->rc};
    const rb_status s =
        (st->of_b ? rb_rolling_mirror_check : rb_rolling_stress_check)(&run->c->rc, &why);
    if (s != RB_OK)
        return cli_case_refused(run->words, s, &why);
    if (st->tractions && !rb_rolling_can(&run->c->rc, RB_BODY_FLAT))
        return cli_case_refuse(run->words, "tractions",
                               "it needs a half-plane, or layers on one; a wheel is not flat: "
                               "take --support halfplane");
    if (st->tractions && run->o.cite)
        return cli_case_refuse(run->words, "cite",
                               "with --tractions no contact is solved, and nothing but "
                               "(B8) of docs/theory.md is used; leave it out");
    if (st->tractions && st->map)
        return cli_case_refuse(run->words, "shakedown-map",
                               "its limits are those of rolling; with --tractions take "
                               "--shakedown");
    if (st->vtk && (rb_report_vtk_kind_of(st->vtk, &kind, &why) != RB_OK ||
                    rb_report_vtk_check(kind, &asked, &why) != RB_OK))
        return cli_case_refuse(run->words, "vtk", "%s", why.text);
    if (st->map && run->c->rc.plane == RB_PLANE_STRESS)
        return cli_case_refuse(run->words, "shakedown-map",
                               "its limits are those of plane "
                               "strain; in plane stress take --shakedown");
    if (!read_grid(st))
        return cli_case_refuse(run->words, "grid",
                               "expected two numbers >= 2 such as 61x41, 1e8 points in all at "
                               "most, got '%s'",
                               st->grid);
    if (st->whole && rb_rolling_body_can(st->of_b ? &run->c->rc.b : &run->c->rc.a, RB_BODY_FLAT))
        return cli_case_refuse(
            run->words, "whole",
            "body %s is a half-plane, which has no end; the whole of a wheel needs "
            "--support%s arc or hub",
            st->of_b ? "B" : "A", st->of_b ? "-b" : "");
    if (st->whole && (st->points || st->depth > 0.0))
        return cli_case_refuse(run->words, "whole", "not together with --%s",
                               st->points ? "points" : "depth");
    if (st->grid && st->points)
        return cli_case_refuse(run->words, "points,grid", "not together with --grid");
    if (!st->points)
        return CLI_CONTINUE;
    static const rb_io_column places[] = {{"x", "position|pos", "mm", RB_IO_COLUMN_NEEDED},
                                          {"y", "depth|z", "mm", RB_IO_COLUMN_NEEDED}};
    const rb_units units = rb_case_units(run->words, rb_option_given(&run->set, "points"));
    const double *x[2];
    rb_status read = rb_io_table_read(st->points, &st->place, &why);
    if (read == RB_OK)
        read = rb_io_table_assign(st->points, &st->place, 2, places, units, x, &why);
    if (read != RB_OK)
        return cli_say(read, &why);
    st->xy = rb_alloc((size_t)st->place.rows, 2);
    if (!st->xy)
        return cli_fail(CLI_INTERNAL, "out of memory");
    for (int k = 0; k < st->place.rows; k++) {
        st->xy[2 * k] = x[0][k];
        st->xy[2 * k + 1] = x[1][k];
    }
    return CLI_CONTINUE;
}

/* ---- Stress ------------------------------------------------------------------------ */

static int wants_shakedown(const stress *st)
{
    return st->shakedown || st->map || !isnan(st->yield_shear);
}

static rb_report_stress of_grid(const cli_case_run *run, const rb_rolling_stress_grid *grid)
{
    const stress *st = run->own;
    rb_report_stress s = {.of_b = st->of_b,
                          .nx = grid->nx,
                          .ny = grid->ny,
                          .n = grid->nx * grid->ny,
                          .whole = st->whole,
                          .depth = rb_unit_shown(run->c->units, "mm", st->depth),
                          .at = grid->at,
                          .inside = grid->inside,
                          .maxima = &st->maxima,
                          .errors = !run->c->error ? NULL
                                    : st->of_b     ? &st->errors.stress_b
                                                   : &st->errors.stress,
                          .shakedown = wants_shakedown(st) ? &st->found : NULL,
                          .yield_shear = rb_unit_shown(run->c->units, "MPa", st->yield_shear),
                          .rc = &run->c->rc,
                          .s = &st->run.solution};
    if (st->tractions && st->run.model.rc)
        rb_report_stress_take(&s, &st->rows, &st->run.model);
    return s;
}

/* At the points of the file; the first one that is not in the body is named by its line. */
static rb_status solve_points(stress *st, const rb_rolling_model *model, rb_message *why)
{
    const int n = st->place.rows;
    int *inside = rb_alloc_int((size_t)n);
    st->at_points = calloc((size_t)n, sizeof *st->at_points);
    if (!inside || !st->at_points) {
        free(inside);
        return RB_ENOMEM;
    }
    for (int k = 0; k < n && st->of_b; k++)
        st->xy[2 * k + 1] = 0.0 - st->xy[2 * k + 1]; /* of the mirror image */
    rb_status s = rb_rolling_inside(model, n, st->xy, inside);
    for (int k = 0; k < n && s == RB_OK; k++)
        if (st->xy[2 * k + 1] == 0.0 && rb_rolling_friction_jumps_at(model, st->xy[2 * k]))
            s = rb_fail(why, RB_EFORMAT,
                        "%.200s:%d: q jumps at x = %g mm: sxx is unbounded there; take a point "
                        "beside it",
                        st->points, st->place.line[k], st->xy[2 * k]);
    for (int k = 0; k < n && s == RB_OK; k++) {
        const double x = st->xy[2 * k], y = st->xy[2 * k + 1];
        if (!inside[k] && st->of_b && y < 0.0)
            s = rb_fail(why, RB_EFORMAT, "%.200s:%d: (%g, %g) mm lies above body B: y <= 0",
                        st->points, st->place.line[k], x, -y);
        else if (!inside[k])
            s = rb_fail(why, RB_EFORMAT, "%.200s:%d: the point (%g, %g) mm lies outside body %s",
                        st->points, st->place.line[k], x, st->of_b ? 0.0 - y : y,
                        st->of_b ? "B" : "A");
    }
    if (s == RB_OK)
        s = rb_rolling_stress_at(model, n, st->xy, st->at_points, why);
    if (s == RB_OK && st->of_b)
        rb_rolling_mirror_stress(n, st->at_points, NULL);
    if (s == RB_OK)
        s = rb_rolling_temperature_inside(st->run.model.rc, &st->run.solution, st->of_b, n,
                                          st->at_points, why);
    free(inside);
    return s;
}

static rb_status solve_grid(const stress *st, const rb_rolling_model *model, int nx, int ny,
                            rb_rolling_stress_grid *grid, rb_message *why)
{
    const rb_status s =
        rb_rolling_stress_on_grid(model, nx, ny, st->whole ? INFINITY : st->depth, grid, why);
    if (s == RB_OK && st->of_b)
        rb_rolling_mirror_grid(grid);
    return s;
}

static rb_status estimate_errors(const cli_case_run *run, stress *st, rb_message *why)
{
    rb_rolling_stress_maxima maxima;
    rb_status s = (st->of_b ? rb_rolling_stress_maxima_of_b
                            : rb_rolling_stress_maxima_find)(&st->run.model, 0.0, &maxima, why);
    if (s == RB_OK)
        s = rb_rolling_estimate_errors(&run->c->rc, &st->run.solution, st->of_b ? NULL : &maxima,
                                       st->of_b ? &maxima : NULL, &st->errors, why);
    rb_rolling_stress_maxima_free(&maxima);
    return s;
}

/* A table of rollbem has h and zone: the tractions of elements, and their edges (B14). */
static rb_status read_tractions(const cli_case_run *run, stress *st, rb_message *why)
{
    enum { X, P, Q, H, ZONE };
    static const rb_io_column known[] = {
        [X] = {"x", "position|pos|coordinate", "mm", RB_IO_COLUMN_NEEDED},
        [P] = {"p", "pressure", "MPa", RB_IO_COLUMN_NEEDED},
        [Q] = {"q", "friction|traction", "MPa", RB_IO_COLUMN_OPTIONAL},
        [H] = {"h", NULL, "mm", RB_IO_COLUMN_OPTIONAL},
        [ZONE] = {"zone", NULL, "-", RB_IO_COLUMN_OPTIONAL},
        {NULL, NULL, "-", RB_IO_COLUMN_UNUSED}};
    enum { KNOWN = sizeof known / sizeof *known };
    const rb_units units = rb_case_units(run->words, rb_option_given(&run->set, "tractions"));
    const double *column[KNOWN] = {NULL};
    rb_message reason = {.text = ""};
    rb_io_table *table = &st->read;
    rb_status s = rb_io_table_read(st->tractions, table, why);
    const int headed = s == RB_OK && table->name != NULL;
    if (s == RB_OK)
        s = rb_io_table_assign(st->tractions, table,
                               headed                    ? (int)KNOWN
                               : table->columns == P + 1 ? P + 1
                                                         : Q + 1,
                               known, units, column, why);
    if (s == RB_OK && !(st->none = rb_alloc((size_t)table->rows, 1)))
        s = RB_ENOMEM;
    if (s != RB_OK)
        return s;
    st->rows = (rb_rolling_traction_rows){.n = table->rows,
                                          .x = column[X],
                                          .p = column[P],
                                          .q = column[Q] ? column[Q] : st->none,
                                          .h = column[H],
                                          .zone = column[ZONE]};
    s = rb_rolling_model_of_rows(&run->c->rc, &st->rows, &st->run.model, &st->run.solution,
                                 &reason);
    if (s != RB_OK && reason.text[0])
        rb_fail(why, s, "%.200s: %.400s", st->tractions, reason.text);
    return s;
}

static rb_status solve_stress(cli_case_run *run, rb_message *why)
{
    stress *st = run->own;
    /* The model belongs to a plain solution, whose error bars follow. */
    rb_resolved_case plain = *run->c;
    plain.error = 0;
    rb_status s =
        st->tractions ? read_tractions(run, st, why) : cli_run_case(&plain, NULL, &st->run, why);
    if (s == RB_OK && run->c->error)
        s = estimate_errors(run, st, why);
    if (s == RB_OK && st->of_b)
        s = rb_rolling_mirror_create(&st->run.model, &st->mirror, why);
    if (s == RB_OK) {
        const rb_rolling_model *model = st->mirror ? &st->mirror->model : &st->run.model;
        s = rb_rolling_stress_maxima_find(model, st->depth, &st->maxima, why);
        if (s == RB_OK && wants_shakedown(st))
            s = rb_rolling_shakedown_find(model, &st->found, why);
        if (s == RB_OK && st->place.rows > 0)
            s = solve_points(st, model, why);
        else if (s == RB_OK)
            s = solve_grid(st, model, st->nx, st->ny, &st->at, why);
        if (s == RB_OK) /* pictures have none */
            s = rb_rolling_temperature_inside(st->run.model.rc, &st->run.solution, st->of_b,
                                              st->at.nx * st->at.ny, st->at.at, why);
        if (s == RB_OK && st->fringes)
            s = solve_grid(st, model, st->whole ? WHOLE_FRINGES_X : FRINGES_X, FRINGES_Y, &st->fine,
                           why);
        else if (s == RB_OK && run->o.plot)
            s = solve_grid(st, model, CONTOURS_X, CONTOURS_Y, &st->fine, why);
        if (s == RB_OK && st->of_b) {
            rb_rolling_mirror_stress(0, NULL, &st->maxima);
            st->found.y = 0.0 - st->found.y;
        }
    }
    rb_rolling_stress_maxima none = {.bonds = 0};
    rb_rolling_shakedown *found = &st->found;
    rb_case_result_convert(&st->run, run->c->units);
    rb_rolling_solution_convert(&st->errors.scalar, run->c->units);
    rb_rolling_stress_convert(0, NULL, &st->errors.stress, run->c->units);
    rb_rolling_stress_convert(0, NULL, &st->errors.stress_b, run->c->units);
    rb_rolling_stress_convert(st->at_points ? st->place.rows : 0, st->at_points, &none,
                              run->c->units);
    rb_rolling_stress_convert(st->at.nx * st->at.ny, st->at.at, &st->maxima, run->c->units);
    rb_rolling_stress_convert(st->fine.nx * st->fine.ny, st->fine.at, &none, run->c->units);
    found->x = rb_unit_shown(run->c->units, "mm", found->x);
    found->y = rb_unit_shown(run->c->units, "mm", found->y);
    found->residual = rb_unit_shown(run->c->units, "MPa", found->residual);
    found->shear_yield = rb_unit_shown(run->c->units, "MPa", found->shear_yield);
    st->table = of_grid(run, &st->at);
    st->picture = of_grid(run, &st->fine);
    if (st->place.rows > 0) {
        st->table.n = st->place.rows;
        st->table.at = st->at_points;
    }
    run->solution = st->tractions ? NULL : &st->run.solution;
    run->printable = s == RB_OK;
    return s;
}

/* ---- Print ------------------------------------------------------------------------- */

static void fill_in(const cli_case_run *run, rb_report_document *d)
{
    const stress *st = run->own;
    d->result = st->tractions ? NULL : &st->run;
    d->stress = &st->table;
}

/* The points of the grid below the largest von Mises stress, which a person is shown. */
static int column_shown(const stress *st)
{
    int nearest = 0;
    for (int i = 0; i < st->at.nx; i++)
        if (fabs(st->at.at[i].x - st->maxima.von_mises.x) <
            fabs(st->at.at[nearest].x - st->maxima.von_mises.x))
            nearest = i;
    return nearest;
}

static int shows_column(const cli_case_run *run)
{
    const stress *st = run->own;
    return !run->o.output && cli_reader_is_person() && st->table.nx > 1 && st->table.ny > 1;
}

static rb_status write_table(FILE *out, const cli_case_run *run)
{
    const stress *st = run->own;
    /* tractions that are given are no solution of the case */
    const rb_rolling_note_list *said = st->tractions ? NULL : run->notes;
    if (shows_column(run)) {
        rb_report_stress below = st->table;
        rb_rolling_stress *at = calloc((size_t)below.ny, sizeof *at);
        int *inside = below.inside ? rb_alloc_int((size_t)below.ny) : NULL;
        rb_status s = at && (inside || !below.inside) ? RB_OK : RB_ENOMEM;
        for (int j = 0; j < below.ny && s == RB_OK; j++) {
            const int k = j * below.nx + column_shown(st);
            at[j] = below.at[k];
            if (inside)
                inside[j] = below.inside[k];
        }
        below.n = below.ny;
        below.at = at;
        below.inside = inside;
        if (s == RB_OK)
            s = rb_report_stress_table(out, &below, said, cli_command_line(), &run->o.style);
        free(inside);
        free(at);
        return s;
    }
    return rb_report_stress_table(out, &st->table, said, cli_command_line(), &run->o.style);
}

static rb_status write_vtk(FILE *out, const void *context, rb_message *why)
{
    const stress *st = ((const cli_case_run *)context)->own;
    rb_report_vtk_kind kind;
    const rb_status s = rb_report_vtk_kind_of(st->vtk, &kind, why);
    return s == RB_OK ? rb_report_vtk(out, kind, &st->table) : s;
}

static rb_status draw_stress(FILE *out, rb_report_canvas canvas, const void *context,
                             rb_message *why)
{
    const cli_case_run *run = context;
    const stress *st = run->own;
    canvas.dimensionless = run->o.style.dimensionless;
    return rb_report_stress_picture(out, canvas, &st->picture, why);
}

static rb_status draw_fringes(FILE *out, rb_report_canvas canvas, const void *context,
                              rb_message *why)
{
    const cli_case_run *run = context;
    const stress *st = run->own;
    canvas.dimensionless = run->o.style.dimensionless;
    return rb_report_fringes(out, canvas, &st->picture,
                             rb_unit_shown(run->c->units, "MPa", st->fringe), why);
}

static rb_status draw_map(FILE *out, rb_report_canvas canvas, const void *context, rb_message *why)
{
    const stress *st = ((const cli_case_run *)context)->own;
    return rb_report_shakedown_map(out, canvas, &st->table, why);
}

static const cli_case_file files[] = {{"vtk", .write = write_vtk},
                                      {"plot", .draw = draw_stress},
                                      {"fringes", .draw = draw_fringes},
                                      {"shakedown-map", .draw = draw_map},
                                      {NULL, NULL, NULL}};

static void summarise_stress(FILE *out, const cli_case_run *run)
{
    if (run->solution)
        rb_report_summary(out, run->solution, cli_terminal_width(STDERR_FILENO));
    rb_report_stress_summary(out, &((const stress *)run->own)->table);
    if (shows_column(run)) {
        const stress *st = run->own;
        const double x = st->at.at[column_shown(st)].x;
        fprintf(out, "  table     below x = %.4g %s; a file gets all %d points\n",
                fabs(x) < 1e-9 * st->run.solution.half_width ? 0.0 : x,
                rb_unit_name(run->c->units, "mm"), st->table.n);
    }
}

static void ask_stress(const cli_case_run *run, json_t **members)
{
    stress *st = run->own;
    json_t *grid = json_false(), *shakedown = json_false();

    if (!st->points && read_grid(st)) {
        grid = json_object();
        rb_report_json_set(&grid, "nx", json_integer(st->nx));
        rb_report_json_set(&grid, "ny", json_integer(st->ny));
    }
    if (wants_shakedown(st)) {
        shakedown = json_object();
        rb_report_json_set(&shakedown, "yield_shear", rb_report_json_number(st->yield_shear));
    }
    rb_report_json_set(members, "body", json_string(bodies[st->of_b].name));
    rb_report_json_set(members, "tractions", json_boolean(st->tractions != NULL));
    rb_report_json_set(members, "maxima", json_true());
    rb_report_json_set(members, "depth", rb_report_json_number(st->depth > 0.0 ? st->depth : NAN));
    rb_report_json_set(members, "grid", grid);
    rb_report_json_set(members, "whole", json_boolean(st->whole));
    rb_report_json_set(members, "points", json_boolean(st->points != NULL));
    rb_report_json_set(members, "shakedown", shakedown);
}

static const cli_case_need needs[] = {{"fringe", "fringes"}, {NULL, NULL}};

static const cli_case_command command = {
    .synopsis = "rollbem stress [OPTION...] [CASE.ini]",
    .about = about,
    .notes = notes,
    .purpose = RB_CASE_STRESS,
    .options = options,
    .option_n = OPTIONS,
    .files = files,
    .needs = needs,
    .has_scales = 1,
    .prepare = prepare_stress,
    .check = check_stress,
    .solve = solve_stress,
    .table = write_table,
    .document = fill_in,
    .asked = ask_stress,
    .summarise = summarise_stress,
};

cli_exit cli_stress_asks(int argc, char **argv, rb_case *words, int *case_files, json_t **asked)
{
    stress st = {.yield_shear = NAN};
    return cli_case_asks(&command, &st, argc, argv, words, case_files, asked);
}

int cli_stress(int argc, char **argv)
{
    stress st = {.yield_shear = NAN};
    const cli_exit code = cli_case_run_command(&command, &st, argc, argv);
    rb_rolling_mirror_free(st.mirror);
    rb_rolling_stress_maxima_free(&st.maxima);
    rb_rolling_errors_free(&st.errors);
    rb_case_result_free(&st.run);
    rb_rolling_stress_grid_free(&st.at);
    rb_rolling_stress_grid_free(&st.fine);
    free(st.at_points);
    rb_io_table_free(&st.place);
    rb_io_table_free(&st.read);
    free(st.none);
    free(st.xy);
    return code;
}
