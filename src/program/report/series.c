/* Tables of columns: what tractions, curves and histories have in common. */
#include "program/report/internal.h"

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
           (c->size > 0 || rb_rolling_has_column(r, c->owner));
}

double rb_report_entry(const rb_report_columns *c, const rb_rolling_result *r, int i)
{
    return c->size > 0 ? rb_rolling_number(r, (const char *)c->owner + (size_t)i * c->size)
                       : rb_rolling_entry(r, c->owner, i);
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
            snprintf(name, sizeof name, "%s%s", beginning[of->kind],
                     rb_rolling_heading(r, of->units, heading));
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
