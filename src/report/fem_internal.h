/* What the pictures of the finite-element examples share. */
#ifndef ROLLBEM_REPORT_FEM_INTERNAL_H
#define ROLLBEM_REPORT_FEM_INTERNAL_H

#include "rollbem/report_fem.h"

/* A gnuplot script in the making, 16 : 9, its terminal set.  NULL: see errno. */
FILE *rb_report_fem_script(rb_report_picture_kind kind);
/* Runs it, closes it. */
rb_status rb_report_fem_draw(FILE *script, FILE *out, rb_message *why);
/* 1, 2 or 5 times a power of ten, at most x. */
double rb_report_fem_round(double x);

#endif
