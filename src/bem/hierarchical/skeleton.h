/* Interpolative decomposition: a few columns of a matrix and what the others are made of. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_SKELETON_H
#define ROLLBEM_BEM_HIERARCHICAL_SKELETON_H

#include "base/base.h"

#include <lapacke.h>

/* K = Q R P' by QR with column pivoting. */
typedef struct {
    int rows, columns, ld; /* ld: of K */
    int rank;              /* so many columns span the others, once factored */
    double *K;             /* its first columns: Q and R, once factored */
    double *scale;         /* of the reflectors */
    lapack_int *pivot;
    rb_arena memory; /* of the arrays */
} rb_skeleton;

/* K: rows x columns, zeroed. */
rb_status rb_skeleton_alloc(int rows, int columns, rb_skeleton *s);
void rb_skeleton_free(rb_skeleton *s);

/* Factors K; tolerance: of the rank, relative to the largest column. */
rb_status rb_skeleton_factor(rb_skeleton *s, double tolerance);

/* After it, for any number of columns kept: order: their numbers, then those of the
 * others, each ascending; T: kept x others: column order[kept + j] is the sum of columns
 * order[i] times T(i, j).  Columns kept beyond the rank take no part. */
rb_status rb_skeleton_split(const rb_skeleton *s, int kept, int *order, double *T);

/* Both, for as many columns as the rank says: order (columns) and T in the caller's
 * memory. */
rb_status rb_skeleton_reduce(rb_skeleton *s, double tolerance, rb_arena *memory, int *kept,
                             int **order, double **T);

#endif
