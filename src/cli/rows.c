#include "cli/rows.h"

#include <string.h>

json_t *cli_rows_json(int n, const cli_row *rows, const void *values, int known)
{
    json_t *object = json_object();
    for (int k = 0; k < n; k++) {
        const void *at = (const char *)values + rows[k].place;
        json_t *value = NULL;
        if (!rows[k].name)
            continue;
        switch (rows[k].kind) {
        case CLI_ROW_TEXT:
        case CLI_ROW_WORDS:
            value = rb_report_json_text(*(const char *const *)at);
            break;
        case CLI_ROW_MESSAGE: {
            const char *text = ((const rb_message *)at)->text;
            value = *text ? rb_report_json_text(text) : json_null();
            break;
        }
        case CLI_ROW_WHOLE:
            value = known ? json_integer(*(const int *)at) : json_null();
            break;
        case CLI_ROW_SIZE:
            value = *(const int *)at > 0 ? json_integer(*(const int *)at) : json_null();
            break;
        case CLI_ROW_NUMBER:
            value = rb_report_json_number(*(const double *)at);
            break;
        case CLI_ROW_NONE:
            value = json_null();
            break;
        }
        rb_report_json_set(&object, rows[k].name, value);
    }
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
