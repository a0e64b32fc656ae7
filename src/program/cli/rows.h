/* Rows of what a command finds of a file, a run or a step: as lines of a table, or as
 * objects of a list in JSON. */
#ifndef ROLLBEM_CLI_ROWS_H
#define ROLLBEM_CLI_ROWS_H

#include "program/report/report.h"

#include <jansson.h>

/* A value with its name in JSON, the column of the table that shows it, or both; NULL: not
 * there. */
typedef struct {
    const char *name, *column;
    enum {
        CLI_VALUE_TEXT,  /* NULL: null, in JSON alone */
        CLI_VALUE_WORDS, /* one word in the table */
        CLI_VALUE_WHOLE,
        CLI_VALUE_NUMBER,
        CLI_VALUE_NONE /* null, in JSON alone */
    } kind;
    const char *text;
    int whole;
    double number;
} cli_value;

#define CLI_TEXT(name, column, x) ((cli_value){name, column, .kind = CLI_VALUE_TEXT, .text = (x)})
#define CLI_WORDS(name, column, x) ((cli_value){name, column, .kind = CLI_VALUE_WORDS, .text = (x)})
#define CLI_NUMBER(name, column, x)                                                                \
    ((cli_value){name, column, .kind = CLI_VALUE_NUMBER, .number = (x)})
#define CLI_WHOLE(name, column, x)                                                                 \
    ((cli_value){name, column, .kind = CLI_VALUE_WHOLE, .whole = (x)})
/* A whole number that is null where it is not known. */
#define CLI_KNOWN(name, column, x, is_known)                                                       \
    ((cli_value){name, column, .kind = (is_known) ? CLI_VALUE_WHOLE : CLI_VALUE_NONE, .whole = (x)})

typedef struct {
    const char *columns; /* of the table, with blanks between */
    int is_json;
    rb_report_cells cells; /* of the table */
    json_t *list, *row;    /* of JSON, for the command's root; row: its last; NULL without memory */
} cli_rows;

/* The head of the table, or an empty list. */
cli_rows cli_rows_begin(FILE *out, const rb_report_style *style, const char *columns);
/* A row of the table, or an object of the list. */
void cli_rows_add(cli_rows *r, int n, const cli_value *values);
/* One more member, taken over, of the last object of the list. */
void cli_rows_set(cli_rows *r, const char *name, json_t *value);

#endif
