/* What a command finds of a file or of a run, as rows: a name in JSON, a column of the
 * table, or both. */
#ifndef ROLLBEM_CLI_ROWS_H
#define ROLLBEM_CLI_ROWS_H

#include "rollbem/report.h"

#include <jansson.h>
#include <stddef.h>

typedef enum {
    CLI_ROW_TEXT,    /* const char * */
    CLI_ROW_WORDS,   /* the same, one word in the table */
    CLI_ROW_MESSAGE, /* rb_message, null when it is empty; in JSON alone */
    CLI_ROW_WHOLE,   /* int, null where nothing is known */
    CLI_ROW_SIZE,    /* int, null when it is 0 */
    CLI_ROW_NUMBER,  /* double */
    CLI_ROW_NONE     /* what other commands have there; in JSON alone */
} cli_row_kind;

typedef struct {
    const char *name, *column; /* NULL: not in JSON, not in the table */
    cli_row_kind kind;
    size_t place; /* in the struct of the values */
} cli_row;

/* kind: the name behind CLI_ROW_. */
#define CLI_ROW(type, name, column, kind, member)                                                  \
    {                                                                                              \
        name, column, CLI_ROW_##kind, offsetof(type, member)                                       \
    }

/* The members of an object, in the order of the rows.  known: 0 writes whole numbers as
 * null.  The object is NULL without memory, as those of rb_report_json_set. */
json_t *cli_rows_json(int n, const cli_row *rows, const void *values, int known);

/* The cells of a row of the table whose columns these words name. */
void cli_rows_cells(rb_report_cells *c, const char *columns, int n, const cli_row *rows,
                    const void *values);

#endif
