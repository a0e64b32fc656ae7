#include "cli/rows.h"

#include <string.h>

static json_t *json_of(const cli_row *row, const void *at, int known)
{
    const char *text;
    switch (row->kind) {
    case CLI_ROW_TEXT:
    case CLI_ROW_WORDS:
        return rb_report_json_text(*(const char *const *)at);
    case CLI_ROW_MESSAGE:
        text = ((const rb_message *)at)->text;
        return *text ? rb_report_json_text(text) : json_null();
    case CLI_ROW_WHOLE:
        return known ? json_integer(*(const int *)at) : json_null();
    case CLI_ROW_SIZE:
        return *(const int *)at > 0 ? json_integer(*(const int *)at) : json_null();
    case CLI_ROW_NUMBER:
        return rb_report_json_number(*(const double *)at);
    case CLI_ROW_NULL:
        break;
    }
    return json_null();
}

json_t *cli_rows_json(int n, const cli_row *rows, const void *values, int known)
{
    json_t *object = json_object();
    for (int k = 0; k < n; k++)
        if (rows[k].name)
            rb_report_json_set(&object, rows[k].name,
                               json_of(&rows[k], (const char *)values + rows[k].place, known));
    return object;
}

void cli_rows_cells(rb_report_cells *c, const char *columns, int n, const cli_row *rows,
                    const void *values)
{
    for (size_t length; *columns; columns += length + strspn(columns + length, " ")) {
        length = strcspn(columns, " ");
        for (int k = 0; k < n; k++) {
            const cli_row *row = &rows[k];
            const void *at = (const char *)values + row->place;
            if (!row->column || strlen(row->column) != length ||
                memcmp(row->column, columns, length) != 0)
                continue;
            if (row->kind == CLI_ROW_TEXT)
                rb_report_cell_text(c, *(const char *const *)at);
            else if (row->kind == CLI_ROW_WORDS)
                rb_report_cell_words(c, *(const char *const *)at);
            else if (row->kind == CLI_ROW_NUMBER)
                rb_report_cell_number(c, *(const double *)at);
            else
                rb_report_cell_whole(c, *(const int *)at);
        }
    }
    rb_report_cells_end_row(c);
}
