#include "program/cli/rows.h"

#include "program/cli/cli.h"

#include <string.h>

cli_rows cli_rows_begin(FILE *out, const rb_report_style *style, const char *columns)
{
    cli_rows r = {.columns = columns, .is_json = style->format == RB_REPORT_JSON};
    if (r.is_json)
        r.list = json_array();
    else {
        r.cells = rb_report_cells_begin(out, style, columns);
        rb_report_comment_origin(&r.cells, cli_command_line());
    }
    return r;
}

void cli_rows_add(cli_rows *r, int n, const cli_value *values)
{
    if (r->is_json) {
        r->row = json_object();
        rb_report_json_append(&r->list, r->row);
        for (const cli_value *v = values; v < values + n; v++)
            if (v->name)
                cli_rows_set(r, v->name,
                             v->kind == CLI_VALUE_NUMBER  ? rb_report_json_number(v->number)
                             : v->kind == CLI_VALUE_WHOLE ? json_integer(v->whole)
                             : v->text                    ? rb_report_json_text(v->text)
                                                          : json_null());
        return;
    }
    const char *column = r->columns;
    for (size_t length; *column; column += length + strspn(column + length, " ")) {
        length = strcspn(column, " ");
        for (const cli_value *v = values; v < values + n; v++) {
            if (!v->column || strlen(v->column) != length || strncmp(v->column, column, length))
                continue;
            if (v->kind == CLI_VALUE_TEXT)
                rb_report_cell_text(&r->cells, v->text);
            else if (v->kind == CLI_VALUE_WORDS)
                rb_report_cell_words(&r->cells, v->text);
            else if (v->kind == CLI_VALUE_WHOLE)
                rb_report_cell_whole(&r->cells, v->whole);
            else
                rb_report_cell_number(&r->cells, v->number);
        }
    }
    rb_report_cells_end_row(&r->cells);
}

void cli_rows_set(cli_rows *r, const char *name, json_t *value)
{
    if (r->list && json_object_set_new(r->row, name, value) == 0)
        return;
    json_decref(r->list);
    r->list = NULL;
}
