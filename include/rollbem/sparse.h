/* Sparse matrices in compressed columns, the layout of CSparse and CHOLMOD. */
#ifndef ROLLBEM_SPARSE_H
#define ROLLBEM_SPARSE_H

#include "rollbem/base.h"

typedef struct {
    int rows, cols;
    int *p;    /* cols + 1 column pointers; owned */
    int *i;    /* p[cols] row indices, increasing within a column; owned */
    double *x; /* p[cols] values; owned */
} rb_sparse;

/* From nz triplets (entries at the same place are added).  RB_EINVAL: an index out of
 * range; RB_ENOMEM. */
rb_status rb_sparse_from_triplets(int rows, int cols, int nz, const int *row, const int *col,
                                  const double *x, rb_sparse *a);
rb_status rb_sparse_copy(const rb_sparse *a, rb_sparse *b);
rb_status rb_sparse_transpose(const rb_sparse *a, rb_sparse *t);
void rb_sparse_free(rb_sparse *a);

/* y = alpha A x + beta y, and the same with the transpose. */
void rb_sparse_apply(double alpha, const rb_sparse *a, const double *x, double beta,
                     double *y);
void rb_sparse_apply_transposed(double alpha, const rb_sparse *a, const double *x,
                                double beta, double *y);

#endif
