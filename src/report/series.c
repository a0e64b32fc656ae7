/* Tables of columns: what tractions, curves and histories have in common. */
#include "report/internal.h"

void rb_report_comment_head(const rb_report_cells *c, const char *command)
{
    rb_report_comment_origin(c, command);
    for (const char *const *line = rb_report_conventions; *line; line++)
        rb_report_comment(c, "%s", *line);
}

/* The k-th column of all parts, and its part; NULL: there are no more. */
static const rb_rolling_result *column(int k, int parts, const rb_report_columns *part,
                                       const rb_report_columns **of)
{
    for (int p = 0; p < parts; p++)
        for (int j = 0; j < part[p].columns->n; j++) {
            const rb_rolling_result *r = &part[p].columns->row[j];
            if ((part[p].errors && !r->error_bar) ||
                !rb_rolling_has_column(r, part[p].owner))
                continue;
            if (k-- == 0) {
                *of = &part[p];
                return r;
            }
        }
    return NULL;
}

void rb_report_cell_headings(rb_report_cells *c, int parts, const rb_report_columns *part)
{
    const rb_report_columns *of;
    const rb_rolling_result *r;
    char heading[RB_ROLLING_HEADING], name[RB_ROLLING_HEADING + 8];

    for (int k = 0; (r = column(k, parts, part, &of)); k++) {
        snprintf(name, sizeof name, "%s%s", of->errors ? "error_" : "",
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

void rb_report_cell_entries(rb_report_cells *c, int i, int parts,
                            const rb_report_columns *part)
{
    const rb_report_columns *of;
    const rb_rolling_result *r;

    for (int k = 0; (r = column(k, parts, part, &of)); k++)
        rb_report_cell_number(c, rb_rolling_entry(r, of->owner, i));
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
