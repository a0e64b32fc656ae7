/* Subsurface stress: table, JSON, lines for people. */
#include "report/internal.h"

#include <jansson.h>
#include <math.h>

int rb_report_stress_is_inside(const rb_report_stress *s, int k)
{
    return !s->inside || s->inside[k];
}

/* ---- Maxima ------------------------------------------------------------------------ */

static const struct {
    const char *key, *name;
    size_t offset; /* in rb_rolling_stress_maxima */
} maxima[] = {
    {"max_shear", "maximum shear", offsetof(rb_rolling_stress_maxima, max_shear)},
    {"von_mises", "von Mises", offsetof(rb_rolling_stress_maxima, von_mises)},
    {"orthogonal_shear", "orthogonal shear |sxy|",
     offsetof(rb_rolling_stress_maxima, orthogonal_shear)},
    {"tension", "largest principal stress", offsetof(rb_rolling_stress_maxima, tension)}};

enum { MAXIMA = sizeof maxima / sizeof maxima[0] };

static const rb_rolling_extremum *extremum(const rb_rolling_stress_maxima *all, int k)
{
    return (const rb_rolling_extremum *)((const char *)all + maxima[k].offset);
}

static void print_quantity(FILE *out, double value, const double *error, const char *unit)
{
    fprintf(out, "%.6g", value);
    if (error && isfinite(*error))
        fprintf(out, " +- %.2g", *error);
    fprintf(out, " %s", unit);
}

static void print_maximum(FILE *out, const rb_report_stress *s, int k)
{
    const rb_rolling_extremum *m = extremum(s->maxima, k);
    const rb_rolling_extremum *e = s->errors ? extremum(s->errors, k) : NULL;
    fprintf(out, "%-24s ", maxima[k].name);
    print_quantity(out, m->value, e ? &e->value : NULL, "MPa");
    fputs(" at x = ", out);
    print_quantity(out, m->x, e ? &e->x : NULL, "mm, y = ");
    print_quantity(out, m->y, e ? &e->y : NULL, "mm");
    fprintf(out, "; %.5g p0\n", m->value / s->s->max_pressure);
}

void rb_report_stress_summary(FILE *out, const rb_report_stress *s)
{
    fprintf(out, "stress in A under p0 = %.6g MPa, a = %.5g mm\n", s->s->max_pressure,
            s->s->half_width);
    for (int k = 0; k < MAXIMA; k++) {
        fputs("  ", out);
        print_maximum(out, s, k);
    }
}

/* ---- Table ------------------------------------------------------------------------- */

static void print_headers(FILE *out, const rb_report_stress *s, const char *command)
{
    rb_report_print_head(out, command);
    fputs("# tension positive; y > 0 inside A; the grid follows A's surface\n", out);
    for (int k = 0; k < MAXIMA; k++) {
        fputs("# ", out);
        print_maximum(out, s, k);
    }
}

rb_status rb_report_stress_table(FILE *out, const rb_report_stress *s,
                                 const char *command, int bare)
{
    const rb_rolling_results *columns = &rb_rolling_stress_scalars;
    char heading[RB_ROLLING_HEADING];
    if (!bare)
        print_headers(out, s, command);
    for (int j = 0; j < columns->n; j++)
        fprintf(out, "%s%s",
                j > 0  ? "\t"
                : bare ? ""
                       : "# ",
                rb_rolling_heading(&columns->row[j], heading));
    fputc('\n', out);
    for (int k = 0; k < s->n; k++)
        for (int j = 0; j < columns->n && rb_report_stress_is_inside(s, k); j++)
            fprintf(out, "%.17g%c", rb_rolling_number(&columns->row[j], &s->at[k]),
                    j + 1 < columns->n ? '\t' : '\n');
    return rb_report_print_end(out);
}

/* ---- JSON -------------------------------------------------------------------------- */

static json_t *json_extremum(const rb_rolling_extremum *m)
{
    json_t *object = json_object();
    rb_report_json_set(&object, "value", rb_report_json_number(m->value));
    rb_report_json_set(&object, "x", rb_report_json_number(m->x));
    rb_report_json_set(&object, "y", rb_report_json_number(m->y));
    return object;
}

static json_t *json_maxima(const rb_report_stress *s)
{
    json_t *all = json_object();
    for (int k = 0; k < MAXIMA; k++) {
        json_t *one = json_extremum(extremum(s->maxima, k));
        if (s->errors)
            rb_report_json_set(&one, "errors", json_extremum(extremum(s->errors, k)));
        rb_report_json_set(&all, maxima[k].key, one);
    }
    return all;
}

void rb_report_json_stress(json_t **root, const rb_report_stress *s)
{
    json_t *points = json_object();
    rb_report_json_set(root, "maxima", json_maxima(s));
    if (s->nx > 0) {
        rb_report_json_set(&points, "nx", json_integer(s->nx));
        rb_report_json_set(&points, "ny", json_integer(s->ny));
    }
    for (int j = 0; j < rb_rolling_stress_scalars.n; j++) {
        const rb_rolling_result *r = &rb_rolling_stress_scalars.row[j];
        char heading[RB_ROLLING_HEADING];
        json_t *list = json_array();
        for (int k = 0; k < s->n; k++)
            rb_report_json_append(&list,
                                  rb_report_json_number(rb_rolling_number(r, &s->at[k])));
        rb_report_json_set(&points, rb_rolling_heading(r, heading), list);
    }
    rb_report_json_set(root, s->nx > 0 ? "grid" : "points", points);
}
