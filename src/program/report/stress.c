/* Subsurface stress: table, JSON, summary. */
#include "program/report/internal.h"

#include <jansson.h>
#include <math.h>

int rb_report_stress_is_inside(const rb_report_stress *s, int k)
{
    return !s->inside || s->inside[k];
}

/* ---- Maxima ------------------------------------------------------------------------ */

static int count_maxima(const rb_rolling_stress_maxima *all)
{
    rb_rolling_stress_maxima copy = *all;
    int n = 0;
    while (rb_rolling_maximum(&copy, n))
        n++;
    return n;
}

static rb_rolling_extremum extremum(const rb_rolling_stress_maxima *all, int k)
{
    rb_rolling_stress_maxima copy = *all;
    return *rb_rolling_maximum(&copy, k);
}

/* "value +- error" with so many digits; 0 where it is below rounding. */
static const char *quantity(double value, double rounding, int digits, const double *error,
                            char text[48])
{
    const int known = error && isfinite(*error);
    const int n = snprintf(text, 48, "%.*g", digits, fabs(value) < rounding ? 0.0 : value);
    if (known)
        snprintf(text + n, 48 - (size_t)n, " +- %.2g", *error);
    return text;
}

/* NULL: it belongs to a bond, or a side of it, that the body does not have. */
static const char *maximum_text(const rb_report_stress *s, int k, char *line, size_t size)
{
    const rb_rolling_extremum of = extremum(s->maxima, k), *m = &of;
    const rb_rolling_extremum bar = s->errors ? extremum(s->errors, k) : of;
    const rb_rolling_extremum *e = s->errors ? &bar : NULL;
    /* a place is searched for until it is known to about a millionth of the half-width */
    const double place = 1e-6 * s->s->half_width, p0 = s->s->max_pressure;
    char value[48], x[48], y[48], place_name[RB_ROLLING_PLACE];
    rb_rolling_maximum_result described;
    const char *meaning = rb_rolling_describe_maximum(k, 0, 0, &described)->meaning;
    if (isnan(m->value))
        return NULL;
    if (isnan(m->x)) {
        snprintf(line, size, "%-24s none", meaning);
        return line;
    }
    const int is_named = m->material != RB_MATERIAL_BODY,
              is_numbered = m->material >= RB_MATERIAL_FIRST;
    snprintf(line, size, "%-24s %s %s at x = %s, y = %s %s%s%s; %.5g p0", meaning,
             quantity(m->value, 1e-12 * p0, 6, e ? &e->value : NULL, value),
             rb_unit_name(s->s->units, "MPa"), quantity(m->x, place, 4, e ? &e->x : NULL, x),
             quantity(m->y, place, 4, e ? &e->y : NULL, y), rb_unit_name(s->s->units, "mm"),
             !is_named     ? ""
             : is_numbered ? ", in "
                           : ", in the ",
             is_named ? rb_rolling_place_name(m->material, place_name) : "",
             fabs(m->value) < 1e-12 * p0 ? 0.0 : m->value / p0);
    return line;
}

/* The largest p0 that shakes down, and where the case stands against it. */
static const char *shakedown_text(const rb_report_stress *s, char *line, size_t size)
{
    const rb_rolling_shakedown *d = s->shakedown;
    const double limit = s->s->max_pressure / d->shear_yield;
    const double own = s->s->max_pressure / s->yield_shear;
    const int n = snprintf(line, size,
                           "%-24s p0 <= %.5g k, decided at x = %.4g %s, y = %.4g %s; first yield "
                           "at p0 = %.5g k",
                           "shakedown", limit, d->x, rb_unit_name(s->s->units, "mm"), d->y,
                           rb_unit_name(s->s->units, "mm"),
                           s->s->max_pressure / s->maxima->tresca_shear.value);
    if (isfinite(own))
        snprintf(line + n, size - (size_t)n, "; here p0 = %.5g k: %s", own,
                 own <= limit ? "shakes down" : "does not shake down");
    return line;
}

void rb_report_stress_take(rb_report_stress *s, const rb_rolling_traction_rows *tractions,
                           const rb_rolling_model *model)
{
    s->tractions = tractions;
    s->pulls = s->jumps = 0;
    s->by_friction = 1;
    for (int k = 0; k < tractions->n; k++) {
        s->pulls += tractions->p[k] < 0.0;
        s->by_friction &= tractions->p[k] == 0.0;
    }
    for (int k = 0; !isnan(rb_rolling_next_friction_jump(model, &k));)
        s->jumps++;
}

/* Totals of given tractions, and what a reader of them has to know: of the lines 0 to
 * GIVEN_LINES - 1 those that are not NULL. */
enum { GIVEN_LINES = 3 };
static const char *given_text(const rb_report_stress *s, int k, char *line, size_t size)
{
    const rb_units units = s->s->units;
    const char *force = rb_unit_name(units, "N/mm");
    if (!s->tractions)
        return NULL;
    if (k == 0)
        snprintf(line, size,
                 "given tractions: P = %.6g %s, Q = %.6g %s, M = %.6g %s; p0 = %.6g %s, "
                 "the largest %s",
                 s->s->normal_load, force, s->s->tangential_load, force, s->s->resistance_moment,
                 rb_unit_name(units, "N"), s->s->max_pressure, rb_unit_name(units, "MPa"),
                 s->by_friction ? "|q|" : "|p|");
    else if (k == 1 && s->jumps)
        snprintf(line, size,
                 "q jumps: sxx is unbounded there, and the largest stresses leave out "
                 "%g a around each jump",
                 RB_ROLLING_LEFT_OUT);
    else if (k == 2 && s->pulls > 0)
        snprintf(line, size, "p < 0 in %d row%s: the surface is pulled there", s->pulls,
                 rb_plural(s->pulls));
    else
        return NULL;
    return line;
}

/* Of a wheel the temperature is that of a half-plane; NULL: the body is one, or has none. */
static const char *temperature_text(const rb_report_stress *s)
{
    const rb_rolling_result *column =
        rb_rolling_find_result(&rb_rolling_stress_scalars, "temperature");
    return rb_rolling_has_result(column, s->rc, 0) &&
                   !rb_rolling_body_can(s->of_b ? &s->rc->b : &s->rc->a, RB_BODY_FLAT)
               ? "temperature: of a half-plane under the same heat; the curvature of the body is "
                 "neglected"
               : NULL;
}

void rb_report_stress_summary(FILE *out, const rb_report_stress *s)
{
    void *before = rb_locale_begin();
    char line[400];
    const rb_units units = s->s->units;
    for (int k = 0; k < GIVEN_LINES; k++)
        if (given_text(s, k, line, sizeof line))
            fprintf(out, "%s\n", line);
    fprintf(out, "stress in %s", s->of_b ? "B" : "A");
    if (s->of_b)
        fprintf(out, " (E = %.6g %s, nu = %.4g)", rb_unit_shown(units, "MPa", s->rc->b.young),
                rb_unit_name(units, "MPa"), s->rc->b.poisson);
    fprintf(out, " under p0 = %.6g %s, a = %.5g %s\n", s->s->max_pressure,
            rb_unit_name(units, "MPa"), s->s->half_width, rb_unit_name(units, "mm"));
    for (int k = 0; k < count_maxima(s->maxima); k++)
        if (maximum_text(s, k, line, sizeof line))
            fprintf(out, "  %s\n", line);
    if (s->shakedown)
        fprintf(out, "  %s\n", shakedown_text(s, line, sizeof line));
    if (temperature_text(s))
        fprintf(out, "  %s\n", temperature_text(s));
    rb_locale_end(before);
}

/* ---- Table ------------------------------------------------------------------------- */

static rb_report_columns columns_of(const rb_report_stress *s)
{
    return (rb_report_columns){.columns = &rb_rolling_stress_scalars,
                               .owner = s->at,
                               .units = s->s->units,
                               .size = sizeof *s->at,
                               .rc = s->rc};
}

rb_status rb_report_stress_table(FILE *out, const rb_report_stress *s,
                                 const rb_rolling_note_list *notes, const char *command,
                                 const rb_report_style *style)
{
    const rb_report_scales by = rb_report_scales_of(s->rc, s->s);
    rb_report_columns columns = columns_of(s);
    char line[400];
    columns.scales = style->dimensionless ? &by : NULL;
    rb_report_cells c = rb_report_begin_columns(out, style, command, 1, &columns);
    rb_report_comment_scales(&c, &columns);

    const rb_status noted = rb_report_comment_notes(&c, notes);
    if (noted != RB_OK)
        return noted;
    for (int k = 0; k < GIVEN_LINES; k++)
        if (given_text(s, k, line, sizeof line))
            rb_report_comment(&c, "%s", line);
    rb_report_comment(&c, "tension positive; y %c 0 inside %c; the grid %s %c%s",
                      s->of_b ? '<' : '>', s->of_b ? 'B' : 'A',
                      s->whole ? "goes around" : "follows", s->of_b ? 'B' : 'A',
                      s->whole ? ", from its surface inwards" : "'s surface");
    for (int k = 0; k < count_maxima(s->maxima); k++)
        if (maximum_text(s, k, line, sizeof line))
            rb_report_comment(&c, "%s", line);
    if (s->shakedown)
        rb_report_comment(&c, "%s", shakedown_text(s, line, sizeof line));
    if (temperature_text(s))
        rb_report_comment(&c, "%s", temperature_text(s));
    for (int k = 0; k < s->n; k++) {
        if (!rb_report_stress_is_inside(s, k))
            continue;
        rb_report_cell_entries(&c, k, 1, &columns);
        rb_report_cells_end_row(&c);
    }
    return rb_report_flush(out);
}

/* ---- JSON -------------------------------------------------------------------------- */

static json_t *json_extremum(rb_rolling_extremum m)
{
    return rb_report_json_named(3, (rb_report_named[]){{"value", m.value}, {"x", m.x}, {"y", m.y}});
}

/* The rows as they were read, for those who check the result. */
static void set_rows(json_t **given, const rb_rolling_traction_rows *rows, rb_units units)
{
    const struct {
        const char *name, *unit;
        const double *x;
    } columns[] = {{"x", "mm", rows->x},
                   {"p", "MPa", rows->p},
                   {"q", "MPa", rows->q},
                   {"h", "mm", rows->h},
                   {"zone", NULL, rows->zone}};
    for (size_t c = 0; c < sizeof columns / sizeof *columns; c++) {
        const char *unit = columns[c].unit;
        char key[60];
        if (!columns[c].x)
            continue;
        json_t *list = json_array();
        for (int k = 0; k < rows->n; k++)
            rb_report_json_append(
                &list, rb_report_json_number(rb_unit_shown(units, unit, columns[c].x[k])));
        snprintf(key, sizeof key, unit ? "%s_%s" : "%s", columns[c].name,
                 unit ? rb_unit_name(units, unit) : "");
        rb_report_json_set(given, key, list);
    }
}

void rb_report_json_stress(json_t **root, const rb_report_stress *s)
{
    const rb_report_columns columns = columns_of(s);
    json_t *points = json_object();
    rb_report_json_set(root, "body", json_string(s->of_b ? "b" : "a"));
    if (s->tractions) {
        const rb_report_named totals[] = {{"normal_load", s->s->normal_load},
                                          {"tangential_load", s->s->tangential_load},
                                          {"resistance_moment", s->s->resistance_moment},
                                          {"largest", s->s->max_pressure},
                                          {"half_width", s->s->half_width},
                                          {"rows_pulled", s->pulls},
                                          {"friction_jumps", s->jumps}};
        json_t *given = rb_report_json_named(7, totals);
        set_rows(&given, s->tractions, s->s->units);
        rb_report_json_set(root, "tractions", given);
    }
    rb_report_json_set(root, "depth", rb_report_json_number(s->depth > 0.0 ? s->depth : NAN));
    if (s->whole)
        rb_report_json_set(root, "whole", json_true());
    json_t *all = json_object();
    for (int k = 0; k < count_maxima(s->maxima); k++) {
        const rb_rolling_extremum m = extremum(s->maxima, k);
        char place_name[RB_ROLLING_PLACE];
        rb_rolling_maximum_result described;
        if (isnan(m.value))
            continue;
        json_t *one = json_extremum(m);
        rb_report_json_set(&one, "material",
                           json_string(rb_rolling_place_name(m.material, place_name)));
        if (s->errors)
            rb_report_json_set(&one, "errors", json_extremum(extremum(s->errors, k)));
        rb_report_json_set(&all, rb_rolling_describe_maximum(k, 0, 0, &described)->name, one);
    }
    rb_report_json_set(root, "maxima", all);
    if (s->shakedown) {
        const rb_rolling_shakedown *d = s->shakedown;
        const rb_report_named numbers[] = {
            {"limit", s->s->max_pressure / d->shear_yield},
            {"first_yield", s->s->max_pressure / s->maxima->tresca_shear.value},
            {"shear_yield", d->shear_yield},
            {"x", d->x},
            {"y", d->y},
            {"residual", d->residual},
            {"yield_shear", s->yield_shear}};
        rb_report_json_set(root, "shakedown", rb_report_json_named(7, numbers));
    }
    if (s->nx > 0) {
        rb_report_json_set(&points, "nx", json_integer(s->nx));
        rb_report_json_set(&points, "ny", json_integer(s->ny));
    }
    rb_report_json_columns(&points, s->n, &columns, 1);
    rb_report_json_set(root, s->nx > 0 ? "grid" : "points", points);
}
