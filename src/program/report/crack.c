/* Cracks: table over the positions, JSON, lines for people, pictures. */
#include "program/report/internal.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>

static rb_report_columns columns_of(const rb_case_crack_result *r)
{
    return (rb_report_columns){
        .columns = &rb_case_crack_columns, .owner = &r->history, .units = r->units};
}

static rb_report_columns growth_columns_of(const rb_case_crack_result *r)
{
    return (rb_report_columns){
        .columns = &rb_case_crack_growth_columns, .owner = &r->growth, .units = r->units};
}

static const char sign_of_K[] =
    "crack in B: K_I >= 0 opens it, K_II > 0: the face on the side of +x, the upper one below 90 "
    "degrees, slides towards the tip; x: where the contact stands";

static const char about_growth[] =
    "growth: a row per length of the crack; cycles: passes until it has that length; sharp tip, "
    "linear elasticity, no wear of the mouth";

/* From the upper end to the tip, straight, before it grows. */
static double length_of(const rb_case_crack_result *r)
{
    const rb_crack_path *path = &r->shape.path;
    return rb_unit_shown(
        r->units, "mm",
        hypot(path->x[path->pieces] - path->x[0], path->y[path->pieces] - path->y[0]));
}

/* A crack that grows: its lengths; otherwise the positions of the contact. */
rb_status rb_report_crack_table(FILE *out, const rb_case_crack_result *r,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style)
{
    const int grows = r->growth.n > 0;
    const rb_report_columns columns = grows ? growth_columns_of(r) : columns_of(r);
    rb_report_cells c = rb_report_begin_columns(out, style, command, 1, &columns);
    rb_report_comment(&c, "%s", grows ? about_growth : sign_of_K);
    const rb_status noted = rb_report_comment_notes(&c, notes);
    if (noted != RB_OK)
        return noted;
    for (int k = 0; k < r->notes; k++)
        rb_report_comment(&c, "note: %s", r->note[k]);
    return rb_report_end_columns(&c, grows ? r->growth.n : r->history.n, 1, &columns);
}

/* ---- Nodes ------------------------------------------------------------------------- */

typedef struct {
    const rb_case_crack_result *r;
    double *hat, *x, *y, *t_x, *t_y; /* of the nodes; hat owns them all */
    double at;                       /* where the contact shall stand, half-widths */
} view;

static rb_status see(const rb_case_crack_result *r, view *v, rb_message *why)
{
    rb_crack *crack = NULL;
    const size_t n = (size_t)r->history.nodes;
    rb_status s = rb_crack_create(&r->shape, &crack, why);
    v->r = r;
    v->hat = rb_alloc(n, 5);
    if (s == RB_OK && !v->hat)
        s = RB_ENOMEM;
    if (s == RB_OK) {
        v->x = v->hat + n;
        v->y = v->x + n;
        v->t_x = v->y + n;
        v->t_y = v->t_x + n;
        rb_crack_places(crack, v->x, v->y, v->hat, v->t_x, v->t_y);
    }
    rb_crack_free(crack);
    return s;
}

/* ---- JSON -------------------------------------------------------------------------- */

static json_t *numbers(const rb_case_crack_summary *s)
{
    json_t *object = json_object();
    for (int k = 0; k < rb_case_crack_scalars.n; k++)
        rb_report_json_set(
            &object, rb_case_crack_scalars.row[k].name,
            rb_report_json_number(rb_rolling_number(&rb_case_crack_scalars.row[k], s)));
    return object;
}

void rb_report_json_crack(json_t **root, const rb_case_crack_result *r)
{
    const rb_report_columns columns = columns_of(r);
    json_t *summary = numbers(&r->summary), *table = json_object();
    json_t *notes = json_array(), *known = json_object_get(*root, "notes");

    rb_report_json_set(&summary, "status", json_string(rb_status_text(r->status)));
    rb_report_json_set(&summary, "half_width", rb_report_json_number(r->half_width));
    rb_report_json_set(&summary, "crack_length", rb_report_json_number(length_of(r)));
    rb_report_json_set(&summary, "passes", json_integer(r->passes));
    rb_report_json_set(&summary, "last_pass_from", json_integer(r->summary.from));
    if (r->has_errors)
        rb_report_json_set(&summary, "errors", numbers(&r->errors));
    rb_report_json_columns(&table, r->history.n, &columns, 0);
    for (size_t k = 0; known && k < json_array_size(known); k++)
        rb_report_json_append(&notes, json_incref(json_array_get(known, k)));
    for (int k = 0; k < r->notes; k++)
        rb_report_json_append(&notes, json_string(r->note[k]));
    rb_report_json_set(root, "notes", notes);
    rb_report_json_set(root, "crack", json_string(sign_of_K));
    if (r->contact.solution.n > 0)
        rb_report_json_set(root, "contact", rb_report_json_summary(&r->contact.solution));
    rb_report_json_set(root, "summary", summary);
    rb_report_json_set(root, "table", table);
    if (r->growth.n > 0) {
        const rb_report_columns growth = growth_columns_of(r);
        json_t *grown = json_object();
        rb_report_json_columns(&grown, r->growth.n, &growth, 0);
        rb_report_json_set(&grown, "rests", json_boolean(r->growth.rests));
        rb_report_json_set(&grown, "surfaced", json_boolean(r->growth.surfaced));
        rb_report_json_set(root, "growth", grown);
    }
}

void rb_report_json_crack_faces(json_t **root, const rb_case_crack_result *r)
{
    const rb_crack_history *h = &r->history;
    const int n = h->nodes;
    json_t *faces = NULL; /* without memory */
    view v = {0};

    if (see(r, &v, NULL) == RB_OK) {
        faces = json_object();
        rb_report_json_set(&faces, "x_mm", rb_report_json_numbers(n, v.x));
        rb_report_json_set(&faces, "y_mm", rb_report_json_numbers(n, v.y));
        rb_report_json_set(&faces, "length_mm", rb_report_json_numbers(n, v.hat));
        const size_t both = 2 * (size_t)n; /* halves N and T in each step */
        json_t *zones = rb_report_json_lists(h->n, n, (size_t)n, NULL, h->zone, NULL);
        json_t *D_N = rb_report_json_lists(h->n, n, both, h->D, NULL, NULL);
        json_t *D_T = rb_report_json_lists(h->n, n, both, h->D + n, NULL, NULL);
        json_t *p = rb_report_json_lists(h->n, n, both, h->r, NULL, v.hat);
        json_t *q = rb_report_json_lists(h->n, n, both, h->r + n, NULL, v.hat);
        rb_report_json_set(&faces, "opening_mm", D_N);
        rb_report_json_set(&faces, "sliding_mm", D_T);
        rb_report_json_set(&faces, "p_MPa", p);
        rb_report_json_set(&faces, "q_MPa", q);
        rb_report_json_set(&faces, "zone", zones);
        rb_report_json_set(&faces, "fluid_volume_mm2",
                           rb_report_json_numbers(h->n, h->fluid_volume));
        if (h->wheel)
            rb_report_json_set(
                &faces, "contact_p_MPa",
                rb_report_json_lists(h->n, h->elements, (size_t)h->elements, h->wheel, NULL, NULL));
    }
    rb_report_json_set(root, "faces", faces);
    if (r->contact.solution.n > 0)
        rb_report_json_set(root, "contact_table", rb_report_json_table(&r->contact.solution));
    if (r->contact.history.n > 0) {
        json_t *history = rb_report_json_history(&r->contact.history);
        rb_report_json_set(&history, "states", rb_report_json_states(&r->states));
        rb_report_json_set(root, "history", history);
    }
    free(v.hat);
}

/* ---- For people -------------------------------------------------------------------- */

static void print_bar(FILE *out, const rb_case_crack_result *r, double error)
{
    if (r->has_errors)
        fprintf(out, " (+- %.2g)", error);
}

void rb_report_crack_summary(FILE *out, const rb_case_crack_result *r, int colour)
{
    const rb_case_crack_summary *s = &r->summary, *e = &r->errors;
    const char *K = rb_unit_name(r->units, "MPa.mm^0.5"), *mm = rb_unit_name(r->units, "mm");

    for (int k = 0; k < r->notes; k++)
        rb_report_note(out, r->note[k], colour);
    const int alone = r->contact.solution.n == 0, steps = r->history.n / r->passes;
    fprintf(out, "crack: length %.5g %s, ", length_of(r), mm);
    if (alone)
        fprintf(out, steps > 1 ? "%d cycle%s of the stress" : "one stress", r->passes,
                r->passes > 1 ? "s" : "");
    else
        fprintf(out, "%d positions, %d pass%s", steps, r->passes, r->passes > 1 ? "es" : "");
    if (isnan(r->half_width))
        fputc('\n', out);
    else
        fprintf(out, ", half-width %.5g %s\n", r->half_width, mm);
    fprintf(out, "  K_I       %.5g ... %.5g", s->K_I_min, s->K_I_max);
    print_bar(out, r, e->K_I_max);
    if (alone)
        fprintf(out, " %s\n", K);
    else
        fprintf(out, " %s, largest with the contact at x = %.4g %s, K_II = %.4g there\n", K,
                s->K_I_max_at, mm, s->K_II_at_K_I_max);
    fprintf(out, "  K_II      %.5g ... %.5g, range %.5g", s->K_II_min, s->K_II_max, s->delta_K_II);
    print_bar(out, r, e->delta_K_II);
    if (alone)
        fprintf(out, " %s\n", K);
    else
        fprintf(out, " %s, at x = %.4g and %.4g %s\n", K, s->K_II_min_at, s->K_II_max_at, mm);
    if (!isnan(s->K_I_max_upper))
        fprintf(out, "  upper end K_I %.5g ... %.5g, K_II %.5g ... %.5g %s\n", s->K_I_min_upper,
                s->K_I_max_upper, s->K_II_min_upper, s->K_II_max_upper, K);
    if (s->fluid_pressure_max > 0.0)
        fprintf(out, "  fluid     at most %.5g %s\n", s->fluid_pressure_max,
                rb_unit_name(r->units, "MPa"));
    if (!isnan(s->pass_change))
        fprintf(out, "  passes    the last one changed K by at most %.2g %s\n", s->pass_change, K);
    if (r->growth.n > 0) {
        const int last = r->growth.n - 1;
        fprintf(out, "  growth    from %.4g to %.4g %s in %.4g %s%s\n", r->growth.length[0],
                r->growth.length[last], mm, r->growth.cycles[last], alone ? "cycles" : "passes",
                r->growth.rests      ? ", where it rests"
                : r->growth.surfaced ? ", then to the surface"
                                     : "");
    }
    fprintf(out, "  residual  %.2g\n", s->residual);
}

/* ---- Picture: K over the position, zones below --------------------------------------- */

/* The faces on the + side, which is that of +x, and on the other one, as they lie. */
typedef struct {
    const char *plus, *minus;
} faces;

static faces faces_of(const rb_case_crack_result *r)
{
    const rb_crack_path *path = &r->shape.path;
    const double dx = path->x[path->pieces] - path->x[0], dy = path->y[path->pieces] - path->y[0];
    const double steep = 0.2 * hypot(dx, dy);
    return dx > steep    ? (faces){"upper", "lower"}
           : dx < -steep ? (faces){"lower", "upper"}
                         : (faces){"right", "left"};
}

/* What the colours mean, at the bottom of the picture; open: 1, where there is something to
 * be seen of it.  A column, whose letters are larger, takes two lines. */
static void let_zone_key(FILE *out, rb_report_canvas canvas, const char *slips, int open)
{
    static const struct {
        int zone, line;
        double in_column, x;
        const char *box, *name;
    } zones[] = {{RB_ZONE_SEPARATED, 0, 0.03, 0.14, "□", "open"},
                 {RB_ZONE_STICK, 0, 0.2, 0.24, "■", "stick"},
                 {RB_ZONE_SLIP_NEGATIVE, 1, 0.03, 0.34, "■", "face slips to the tip"},
                 {RB_ZONE_SLIP_POSITIVE, 1, 0.66, 0.66, "■", "away from the tip"}};
    const int titled = rb_report_place_of(canvas).titled;
    int n = 0;
    for (size_t k = open ? 0 : 1; k < sizeof zones / sizeof *zones; k++) {
        const int slip = zones[k].zone == RB_ZONE_SLIP_NEGATIVE;
        char name[20];
        n++;
        rb_format(name, sizeof name, "zone%d", n);
        rb_report_let_text(out, name, "%s %s%s%s", zones[k].box, slip ? slips : "", slip ? " " : "",
                           titled || zones[k].zone != RB_ZONE_SLIP_POSITIVE ? zones[k].name
                                                                            : "away from it");
        rb_format(name, sizeof name, "zone_x%d", n);
        rb_report_let(out, name, titled ? zones[k].x : zones[k].in_column);
        rb_format(name, sizeof name, "zone_y%d", n);
        rb_report_let(out, name, titled || zones[k].line ? 0.025 : 0.065);
        rb_format(name, sizeof name, "zone_of%d", n);
        rb_report_let_whole(out, name, zones[k].zone);
    }
    rb_report_let_whole(out, "zone_names", n);
}

/* Steps of the last pass. */
static int first_of(const rb_case_crack_result *r)
{
    return r->summary.from;
}

/* Of the axes of K and of the pressure in the crack. */
typedef struct {
    rb_report_unit K, fluid;
} axes;

static axes axes_of(const rb_case_crack_result *r)
{
    const rb_case_crack_summary *s = &r->summary;
    const double K = fmax(fmax(s->K_I_max, s->K_II_max), -s->K_II_min);
    return (axes){rb_report_axis_unit(r->units, "MPa.mm^0.5", K),
                  rb_report_axis_unit(r->units, "MPa", s->fluid_pressure_max)};
}

/* A contact that stands still over the crack is drawn over its steps. */
static int stands_still(const rb_case_crack_result *r)
{
    return r->history.x[r->history.n - 1] == r->history.x[first_of(r)];
}

/* Over what is drawn: the position in half-widths, or the number of the step. */
static double abscissa(const rb_case_crack_result *r, int k)
{
    return stands_still(r) ? k - first_of(r) + 1 : r->history.x[k] / r->half_width;
}

static const char *abscissa_label(const rb_case_crack_result *r)
{
    return stands_still(r) ? "step" : "position of the contact / a";
}

static void write_steps(FILE *out, const rb_case_crack_result *r)
{
    const rb_crack_history *h = &r->history;
    const axes unit = axes_of(r);
    fputs("$K << EOD\nx K_I K_II fluid\n", out);
    for (int k = first_of(r); k < h->n; k++)
        fprintf(out, "%.9g %.9g %.9g %.9g\n", abscissa(r, k), h->K_I[k] / unit.K.size,
                h->K_II[k] / unit.K.size, h->fluid_pressure[k] / unit.fluid.size);
    fputs("EOD\n", out);
}

/* A box for each run of nodes in one zone at one position: x, s, half-sizes, zone. */
static void write_zones(FILE *out, const rb_case_crack_result *r, const double *hat)
{
    const rb_crack_history *h = &r->history;
    const double unit = rb_unit_shown(r->units, "mm", 1.0) / r->half_width;
    fputs("$zones << EOD\nx along half_x half_along zone\n", out);
    for (int k = first_of(r); k < h->n; k++) {
        const int *zone = h->zone + (size_t)k * h->nodes;
        const double x = abscissa(r, k), left = k > first_of(r) ? x - abscissa(r, k - 1) : 0.0;
        const double right = k + 1 < h->n ? abscissa(r, k + 1) - x : 0.0;
        double from = 0.0, to = 0.0;
        for (int j = 0; j < h->nodes; j++) {
            to += hat[j] * unit;
            if (j + 1 < h->nodes && zone[j + 1] == zone[j])
                continue;
            fprintf(out, "%.9g %.9g %.9g %.9g %d\n", x + 0.25 * (right - left), 0.5 * (from + to),
                    0.26 * (left + right), 0.5 * (to - from), zone[j]);
            from = to;
        }
    }
    fputs("EOD\n", out);
}

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_crack_table(out, of, NULL, "", style);
}

static void let_title(FILE *out, const view *v)
{
    const rb_case_crack_result *r = v->r;
    const rb_crack_path *path = &r->shape.path;
    const double dx = path->x[path->pieces] - path->x[0], dy = path->y[0] - path->y[path->pieces];

    rb_report_let_table(out, "table", write_table, r);
    rb_report_let_units(out, r->units);
    rb_report_let_text(
        out, "title",
        "{/:Bold Crack}   length %.4g a at %.4g° to the surface,  μ of the faces %.3g,  a = %s %s",
        length_of(r) / r->half_width, atan2(dy, dx) * 180.0 / 3.14159265358979, r->shape.friction,
        RB_REPORT_NUMBER(r->half_width, 4), rb_unit_name(r->units, "mm"));
}

static void write_K(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_case_crack_result *r = v->r;
    const rb_crack_history *h = &r->history;
    const double a = r->half_width;
    const axes shown = axes_of(r);
    char unit[40];
    double along = 0.0; /* the whole crack, in half-widths */

    for (int j = 0; j < h->nodes; j++)
        along += v->hat[j] / rb_unit_stored(r->units, "mm", a);
    let_title(out, v);
    write_steps(out, r);
    write_zones(out, r, v->hat);
    rb_report_let(out, "x_from", abscissa(r, first_of(r)));
    rb_report_let(out, "x_to", abscissa(r, h->n - 1));
    rb_report_let_text(out, "x_label", "%s", abscissa_label(r));
    rb_report_let_text(out, "K_label", "K  [%s]", rb_report_raised(shown.K.name, unit));
    rb_report_let_whole(out, "wet", r->summary.fluid_pressure_max > 0.0);
    rb_report_let_text(out, "fluid_label", "fluid  [%s]", shown.fluid.name);
    rb_report_let(out, "fluid_to", 1.15 * r->summary.fluid_pressure_max / shown.fluid.size);
    rb_report_let(out, "along_step", rb_report_round_step(along / 4.0));
    let_zone_key(out, canvas, faces_of(r).plus, 1);
}

rb_status rb_report_crack_picture(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                                  rb_message *why)
{
    view v = {0};
    rb_status s = see(r, &v, why);
    if (s == RB_OK && r->history.n - first_of(r) < 2)
        s = rb_fail(why, RB_EINVAL, "one position alone is no picture over positions");
    if (s == RB_OK)
        s = rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "crack", write_K, &v, why);
    free(v.hat);
    return s;
}

/* ---- Picture: K_II over K_I ---------------------------------------------------------- */

static void write_orbit(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    char unit[40];
    const char *K = rb_report_raised(axes_of(v->r).K.name, unit);

    (void)canvas;
    let_title(out, v);
    write_steps(out, v->r);
    rb_report_let_text(out, "position", "%s", abscissa_label(v->r));
    rb_report_let_text(out, "x_label", "K_{I}  [%s]", K);
    rb_report_let_text(out, "y_label", "K_{II}  [%s]", K);
}

rb_status rb_report_crack_orbit(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                                rb_message *why)
{
    view v = {.r = r};
    if (r->history.n - first_of(r) < 2)
        return rb_fail(why, RB_EINVAL, "one position alone is no orbit");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "orbit", write_orbit, &v, why);
}

/* ---- Picture: the crack open and torn ------------------------------------------------ */

/* A block of data; x and y in units of `unit`. */
static void write_points(FILE *out, const char *block, int n, const double *x, const double *y,
                         double unit)
{
    fprintf(out, "$%s << EOD\nx y\n", block);
    for (int i = 0; i < n; i++)
        fprintf(out, "%.9g %.9g\n", x[i] / unit, y[i] / unit);
    fputs("EOD\n", out);
}

/* Both faces, displaced by half of D each, times a round magnification. */
static void write_open(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_case_crack_result *r = v->r;
    const rb_crack_history *h = &r->history;
    const rb_report_place place = rb_report_place_of(canvas);
    const rb_crack_path *path = &r->shape.path;
    const int n = h->nodes;
    int k = first_of(r); /* the position nearest to the one asked for */
    for (int i = k; i < h->n; i++)
        if (fabs(h->x[i] - v->at * r->half_width) <= fabs(h->x[k] - v->at * r->half_width))
            k = i;
    const double unit = rb_unit_stored(r->units, "mm", r->half_width); /* a in mm */
    const double at = h->x[k] / r->half_width;
    char name[40];

    rb_report_let_table(out, "table", write_table, r);
    rb_report_let_units(out, r->units);
    const double *D_N = h->D + (size_t)k * 2 * (size_t)n, *D_T = D_N + n;
    const int *zone = h->zone + (size_t)k * (size_t)n;
    double largest = 0.0, deepest = 0.0, from = INFINITY, to = -INFINITY;

    const rb_case_crack_growth *g = &r->growth;
    const rb_crack_path *whole = g->n > 1 ? &g->path : path;
    for (int i = 0; i <= whole->pieces; i++) {
        from = fmin(from, whole->x[i] / unit);
        to = fmax(to, whole->x[i] / unit);
        deepest = fmax(deepest, -whole->y[i] / unit);
    }
    if (g->n > 1) { /* its way below the faces, which are those of the first length */
        write_points(out, "way", whole->pieces + 1, whole->x, whole->y, unit);
        write_points(out, "tips", g->n - 1, g->tip_x + 1, g->tip_y + 1, r->half_width);
    }
    for (int j = 0; j < n; j++)
        largest = fmax(largest, hypot(D_N[j], D_T[j]) / r->half_width);
    const double size = fmax(to - from, deepest);
    const double times = largest > 0.0 ? rb_report_round_step(0.03 * size / largest) : 1.0;
    for (int side = -1; side <= 1; side += 2) {
        const double factor = 0.5 * side * times / r->half_width;
        fprintf(out, "$face%d << EOD\nx y zone touches\n", (side + 1) / 2);
        if (path->y[0] < 0.0)
            fprintf(out, "%.9g %.9g 0 0\n", path->x[0] / unit, path->y[0] / unit);
        for (int j = 0; j < n; j++) {
            const double dx = -v->t_y[j] * D_N[j] + v->t_x[j] * D_T[j],
                         dy = v->t_x[j] * D_N[j] + v->t_y[j] * D_T[j];
            fprintf(out, "%.9g %.9g %d %d\n", v->x[j] / unit + factor * dx,
                    v->y[j] / unit + factor * dy, zone[j], zone[j] != RB_ZONE_SEPARATED);
        }
        fprintf(out, "%.9g %.9g 0 0\nEOD\n", path->x[path->pieces] / unit,
                path->y[path->pieces] / unit);
    }
    const rb_report_unit K = axes_of(r).K;
    rb_report_let_text(out, "title",
                       "{/:Bold Crack}   contact at x = %s a,  displacements of the faces × %s",
                       RB_REPORT_NUMBER(rb_report_tidy(at, 1.0), 4), RB_REPORT_NUMBER(times, 3));
    rb_report_let_text(out, "K_there", "K_{I} = %s,  K_{II} = %s %s",
                       RB_REPORT_NUMBER(h->K_I[k] / K.size, 4),
                       RB_REPORT_NUMBER(h->K_II[k] / K.size, 4), rb_report_raised(K.name, name));
    const faces face = faces_of(r);
    let_zone_key(out, canvas, face.plus, 0);
    const double margin = 0.25 * size, step = rb_report_round_step(0.2 * size);
    /* more of the body, until the panel is filled at equal scales */
    const double left = 0.12 + place.right, high = 0.68,
                 aspect = rb_report_width_over_height(canvas, RB_REPORT_FOUR_THIRDS) *
                          (0.965 - left) / high,
                 width = to - from + 2.0 * margin, height = deepest + 1.6 * margin,
                 beside = fmax(aspect * height - width, 0.0);
    const double bottom = -deepest - margin - fmax(width / aspect - height, 0.0);
    from -= 0.5 * beside + margin;
    to += 0.5 * beside + margin;
    const struct {
        const char *name;
        double x;
    } numbers[] = {{"left", left},
                   {"high", high},
                   {"x_from", from},
                   {"x_to", to},
                   {"bottom", bottom},
                   {"y_to", 0.6 * margin},
                   {"step", step},
                   /* the contact above, where it is within the picture */
                   {"contact_from", fmin(fmax(at - 1.0, from), to)},
                   {"contact_to", fmin(fmax(at + 1.0, from), to)},
                   {"contact_high", 0.15 * margin}};
    for (size_t j = 0; j < sizeof numbers / sizeof *numbers; j++)
        rb_report_let(out, numbers[j].name, numbers[j].x);
    rb_report_let_text(out, "faces", "faces × %s", RB_REPORT_NUMBER(times, 3));
    rb_report_let_text(out, "face0_name", "%s face", face.minus);
    rb_report_let_text(out, "face1_name", "%s face", face.plus);
    rb_report_let_whole(out, "grows", g->n > 1);
}

rb_status rb_report_crack_open(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                               double at, rb_message *why)
{
    view v = {.at = at};
    rb_status s = see(r, &v, why);
    if (s == RB_OK)
        s = rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "crack_open", write_open, &v, why);
    free(v.hat);
    return s;
}
