/* Tables of columns: what tractions, curves and histories have in common. */
#include "program/report/internal.h"

#include <math.h>
#include <string.h>

/* ---- In units of the contact ------------------------------------------------------- */

int rb_report_has_scales(const rb_rolling_solution *s)
{
    return s->half_width > 0.0 && s->max_pressure > 0.0;
}

rb_report_scales rb_report_scales_of(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    const double mu = rb_rolling_largest_mu(rc), p0 = s->max_pressure;
    return (rb_report_scales){s->half_width, p0, mu > 0.0 ? mu * p0 : p0, mu};
}

/* What a column is divided by, as its heading says it; NULL: by nothing. */
static const char *divisor(const rb_report_columns *c, const rb_rolling_result *r, double *by)
{
    *by = 1.0;
    if (!c->scales || !r->unit)
        return NULL;
    const int is_length = strcmp(r->unit, "mm") == 0;
    if (!is_length && strcmp(r->unit, "MPa") != 0)
        return NULL;
    const int is_friction = !is_length && strcmp(r->name, "q") == 0 && c->scales->mu > 0.0;
    *by = is_length ? c->scales->length : is_friction ? c->scales->friction : c->scales->pressure;
    return is_length ? "/a" : is_friction ? "/(mu*p0)" : "/p0";
}

/* Books count it downwards. */
static int is_depth(const rb_report_columns *c, const rb_rolling_result *r)
{
    return c->scales && strcmp(r->name, "y") == 0;
}

static const char *heading_of(const rb_report_columns *c, const rb_rolling_result *r,
                              char heading[RB_ROLLING_HEADING])
{
    double by;
    const char *name = divisor(c, r, &by);
    if (!name)
        return rb_rolling_heading(r, c->units, heading);
    snprintf(heading, RB_ROLLING_HEADING, "%s%s",
             is_depth(c, r) ? "depth"
             : r->symbol    ? r->symbol
                            : r->name,
             name);
    return heading;
}

void rb_report_comment_scales(const rb_report_cells *c, const rb_report_columns *columns)
{
    const rb_report_scales *by = columns->scales;
    const char *mm = rb_unit_name(columns->units, "mm"), *MPa = rb_unit_name(columns->units, "MPa");
    if (!by)
        return;
    rb_report_comment(c, "a = %.9g %s, p0 = %.9g %s, mu = %.9g", by->length, mm, by->pressure, MPa,
                      by->mu);
}

/* ---- Columns ----------------------------------------------------------------------- */

void rb_report_comment_head(const rb_report_cells *c, const char *command)
{
    rb_report_comment_origin(c, command);
    for (const char *const *line = rb_report_conventions; *line; line++)
        rb_report_comment(c, "%s", *line);
}

/* Of errors those columns are shown that have error bars. */
int rb_report_shows(const rb_report_columns *c, const rb_rolling_result *r)
{
    return (c->kind != RB_REPORT_ERRORS || r->error_bar) &&
           (c->size > 0 ? !c->rc || rb_rolling_has_result(r, c->rc, 0)
                        : rb_rolling_has_column(r, c->owner));
}

double rb_report_entry(const rb_report_columns *c, const rb_rolling_result *r, int i)
{
    double by;
    const double x = c->size > 0
                         ? rb_rolling_number(r, (const char *)c->owner + (size_t)i * c->size)
                         : rb_rolling_entry(r, c->owner, i);
    return divisor(c, r, &by) ? (is_depth(c, r) ? fabs(x) : x) / by : x;
}

void rb_report_cell_headings(rb_report_cells *c, int parts, const rb_report_columns *part)
{
    static const char *const beginning[] = {"", "error_", "deviation_"};
    char heading[RB_ROLLING_HEADING], name[RB_ROLLING_HEADING + 12];

    for (const rb_report_columns *of = part; of < part + parts; of++)
        for (int j = 0; j < of->columns->n; j++) {
            const rb_rolling_result *r = &of->columns->row[j];
            if (!rb_report_shows(of, r))
                continue;
            snprintf(name, sizeof name, "%s%s", beginning[of->kind], heading_of(of, r, heading));
            rb_report_cell_text(c, name);
        }
}

rb_report_cells rb_report_begin_columns(FILE *out, const rb_report_style *style,
                                        const char *command, int parts,
                                        const rb_report_columns *part)
{
    rb_report_cells c = rb_report_cells_begin(out, style, "");
    rb_report_cell_headings(&c, parts, part);
    rb_report_cells_end_row(&c);
    rb_report_comment_head(&c, command);
    return c;
}

void rb_report_cell_entries(rb_report_cells *c, int i, int parts, const rb_report_columns *part)
{
    for (const rb_report_columns *of = part; of < part + parts; of++)
        for (int j = 0; j < of->columns->n; j++) {
            const rb_rolling_result *r = &of->columns->row[j];
            if (rb_report_shows(of, r))
                rb_report_cell_number(c, rb_report_entry(of, r, i));
        }
}

rb_status rb_report_end_columns(rb_report_cells *c, int rows, int parts,
                                const rb_report_columns *part)
{
    for (int i = 0; i < rows; i++) {
        rb_report_cell_entries(c, i, parts, part);
        rb_report_cells_end_row(c);
    }
    return rb_report_flush(c->out);
}
