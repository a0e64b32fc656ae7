/* The columns of one element in H and G, vectorised over the collocation points. */
#ifndef ROLLBEM_BEM_COLUMN_H
#define ROLLBEM_BEM_COLUMN_H

#include "bem/kernels.h"

/* Collocation points, padded to whole blocks by repeating the last one. */
typedef struct {
    int n;
    double *x; /* owned, with y and circle behind it */
    double *y;
    double *circle; /* centre and radius of a circle about each block */
} rb_points;

rb_status rb_points_make(int n, const double *x, const double *y, rb_points *points);
void rb_points_free(rb_points *points);

/* Writes the columns of element e: out[0], out[1] the two of H, out[2], out[3] those of
 * G, 2n each; NULL: not wanted.  self: the number of the point on e itself, or -1. */
typedef void rb_column_fn(const rb_constants *k, const rb_element *e, int self,
                          const rb_points *points, double *const out[4]);

/* What this processor can run, the best first; NULL past the last.  All give the same to
 * rounding. */
typedef struct {
    const char *name;
    rb_column_fn *fill;
} rb_column_variant;
const rb_column_variant *rb_column_variant_get(int i);

#endif
