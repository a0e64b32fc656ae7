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

#endif
