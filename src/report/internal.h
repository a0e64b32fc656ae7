/* What the files of the report room share. */
#ifndef ROLLBEM_REPORT_INTERNAL_H
#define ROLLBEM_REPORT_INTERNAL_H

#include "rollbem/report.h"

/* Column of the table: an array of the solution. */
typedef struct {
    const char *name; /* with its unit */
    size_t offset;    /* of the array's pointer in rb_rolling_solution */
    int whole;        /* 1: int, 0: double */
} rb_report_column;

extern const rb_report_column rb_report_columns[];
extern const int rb_report_column_n;

const double *rb_report_doubles(const rb_rolling_solution *s, const rb_report_column *c);
const int *rb_report_ints(const rb_rolling_solution *s, const rb_report_column *c);

/* For people: 0 where x is rounding of a sum of terms of that size. */
double rb_report_tidy(double x, double size);

/* ---- Series: tables and JSON of everything but the tractions ----------------------- */

/* One column, of doubles or of whole numbers. */
typedef struct {
    const char *name; /* in tables, with its unit */
    const char *key;  /* in JSON; NULL: name */
    const double *x;  /* borrowed */
    const int *k;     /* where x is NULL; borrowed */
    int is_error;     /* 1: error_NAME in tables */
} rb_report_series;

/* # lines with version, command, conventions. */
void rb_report_print_head(FILE *out, const char *command);
/* The names, on a # line unless bare. */
void rb_report_print_names(FILE *out, int columns, const rb_report_series *series,
                           int bare);
/* Copies series as errors; returns how many. */
int rb_report_add_errors(int columns, const rb_report_series *error,
                         rb_report_series *series);
void rb_report_print_row(FILE *out, int i, int columns, const rb_report_series *series);
void rb_report_print_rows(FILE *out, int rows, int columns,
                          const rb_report_series *series);
/* Flushes.  RB_EWRITE: see errno. */
rb_status rb_report_print_end(FILE *out);

void rb_report_json_series(struct json_t **object, int rows, int columns,
                           const rb_report_series *series);

/* ---- Stress ------------------------------------------------------------------------ */

/* Column of the stress at a point. */
typedef struct {
    const char *name, *key; /* with its unit; in VTK */
    size_t offset;          /* in rb_rolling_stress */
} rb_report_stress_column;

extern const rb_report_stress_column rb_report_stress_columns[];
enum { RB_REPORT_STRESS_COLUMNS = 11 };

double rb_report_stress_value(const rb_rolling_stress *at, int column);
int rb_report_stress_is_inside(const rb_report_stress *s, int k);

/* ---- Behind the solution -------------------------------------------------------------
 */

/* What rb_report_trace has left in the folder. */
void rb_report_remove_tableaux(const char *folder);

/* ---- Pictures ---------------------------------------------------------------------- */

/* The font of a key that would otherwise be larger. */
const char *rb_report_key_font(rb_report_picture_kind kind);
/* The next of 1, 2, 5 times a power of ten. */
double rb_report_round_step(double step);

typedef enum {
    RB_REPORT_SLIDE,  /* 4:3 */
    RB_REPORT_WIDE,   /* 12:5 */
    RB_REPORT_SCREEN, /* 16:9 */
    RB_REPORT_CHART   /* 3:2, smaller */
} rb_report_shape;

/* Runs gnuplot on a script, which names no file: data blocks only.  out gets the whole
 * picture or nothing.  RB_EHELPER: gnuplot is missing, refuses, or took longer than so
 * many seconds; RB_EWRITE: the disk is full; RB_ENOMEM. */
rb_status rb_report_gnuplot(FILE *script, rb_report_picture_kind kind, double seconds,
                            FILE *out, rb_message *why);

/* A picture from what `script` writes behind the settings of its kind and shape. */
typedef void rb_report_script(FILE *script, rb_report_picture_kind kind,
                              const void *view);
rb_status rb_report_draw(FILE *out, rb_report_picture_kind kind, rb_report_shape shape,
                         rb_report_script *script, const void *view, rb_message *why);

#endif
