/* What the pictures of the finite-element examples share. */
#ifndef ROLLBEM_REPORT_FEM_INTERNAL_H
#define ROLLBEM_REPORT_FEM_INTERNAL_H

#include "report/internal.h"
#include "rollbem/report_fem.h"

/* 1, 2 or 5 times a power of ten, at most x. */
double rb_report_fem_round(double x);

#endif
