/* Sparse matrices in compressed columns, the layout of CSparse and CHOLMOD, and their
 * factorisations (SuiteSparse). */
#ifndef ROLLBEM_SPARSE_H
#define ROLLBEM_SPARSE_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

typedef struct {
    int rows, cols;
    int *p;    /* cols + 1 column pointers; owned */
    int *i;    /* p[cols] row indices, increasing within a column; owned */
    double *x; /* p[cols] values; owned */
} rb_sparse;

/* A matrix in coordinate form.  Entries may be added in any order; entries with the same
 * row and column are summed.  Start with {.rows = m, .cols = n}. */
typedef struct {
    int rows, cols;
    int nz, capacity; /* entries stored; entries that the arrays can hold */
    int *row, *col;   /* capacity; owned */
    double *x;        /* capacity; owned */
    rb_status status; /* RB_ENOMEM after an entry did not fit into memory, or after more
                         than INT_MAX entries, which an rb_sparse cannot hold */
} rb_triplets;

void rb_triplets_add(rb_triplets *t, int row, int col, double x);

void rb_triplets_free(rb_triplets *t);

/* Leaves t unchanged.  RB_EINVAL: an index out of range; RB_ENOMEM. */
rb_status rb_sparse_from_triplets(const rb_triplets *t, rb_sparse *a);
/* From a column-major dense matrix, lda >= rows; exact zeros are left out. */
rb_status rb_sparse_from_dense(int rows, int cols, const double *dense, int lda, rb_sparse *a);

void rb_sparse_free(rb_sparse *a);

RB_PUBLIC_END

#endif
