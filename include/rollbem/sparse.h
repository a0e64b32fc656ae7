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
/* Adds factor times A; A has at most as many rows and columns as t. */
void rb_triplets_add_matrix(rb_triplets *t, double factor, const rb_sparse *a);
/* Reserves memory for `more` further entries at once.  This is optional, because
 * rb_triplets_add enlarges the arrays itself.  Returns t->status. */
rb_status rb_triplets_reserve(rb_triplets *t, size_t more);
void rb_triplets_free(rb_triplets *t);

/* Leaves t unchanged.  RB_EINVAL: an index out of range; RB_ENOMEM. */
rb_status rb_sparse_from_triplets(const rb_triplets *t, rb_sparse *a);
/* From a column-major dense matrix, lda >= rows; exact zeros are left out. */
rb_status rb_sparse_from_dense(int rows, int cols, const double *dense, int lda, rb_sparse *a);
rb_status rb_sparse_copy(const rb_sparse *a, rb_sparse *b);
rb_status rb_sparse_transpose(const rb_sparse *a, rb_sparse *t);
void rb_sparse_free(rb_sparse *a);

/* A_jj, 0 where it has no entry. */
double rb_sparse_diagonal(const rb_sparse *a, int j);

/* y = alpha A x + beta y, and the same with the transpose. */
void rb_sparse_apply(double alpha, const rb_sparse *a, const double *x, double beta, double *y);
void rb_sparse_apply_transposed(double alpha, const rb_sparse *a, const double *x, double beta,
                                double *y);

/* C = A B.  RB_EINVAL: the number of columns of A is not the number of rows of B;
 * RB_ENOMEM. */
rb_status rb_sparse_multiply(const rb_sparse *a, const rb_sparse *b, rb_sparse *c);

/* symmetric: 1 if A = A', entry by entry.  RB_ENOMEM. */
rb_status rb_sparse_is_symmetric(const rb_sparse *a, int *symmetric);

/* Connected components of the graph of A + A', A square.  part[i]: number of the
 * component that node i belongs to, counted from 0. */
rb_status rb_sparse_components(const rb_sparse *a, int *count, int *part);

/* Numerical rank by rank-revealing QR (SuiteSparseQR), with its default tolerance
 * 20 (rows + cols) eps max column norm. */
rb_status rb_sparse_rank(const rb_sparse *a, int *rank);

/* ---- LU of square matrices with one fixed pattern (UMFPACK) --------------------------- */

typedef struct rb_sparse_lu rb_sparse_lu;

/* Symbolic factorisation: computes an ordering from the pattern of a.  RB_EINVAL: not
 * square. */
rb_status rb_sparse_lu_create(const rb_sparse *a, rb_sparse_lu **lu);
/* Estimated operations of one numerical factorisation of a matrix with this symmetric
 * pattern. */
rb_status rb_sparse_lu_estimate(const rb_sparse *a, double *flops);
/* Numerical factorisation of a, which must have the pattern given to create and must not
 * be freed before the last solve.  The operations done are added to *flops (may be
 * NULL). */
rb_status rb_sparse_lu_factor(rb_sparse_lu *lu, const rb_sparse *a, double *flops);
rb_status rb_sparse_lu_solve(const rb_sparse_lu *lu, const double *b, double *x);
/* The same without iterative refinement. */
rb_status rb_sparse_lu_solve_once(const rb_sparse_lu *lu, const double *b, double *x);
/* Number of entries of both factors, after the numerical factorisation. */
double rb_sparse_lu_entries(const rb_sparse_lu *lu);
rb_status rb_sparse_lu_solve_transposed(const rb_sparse_lu *lu, const double *b, double *x);
void rb_sparse_lu_free(rb_sparse_lu *lu);

/* ---- Cholesky of a symmetric positive definite matrix (CHOLMOD) -------------------- */

typedef struct rb_sparse_cholesky rb_sparse_cholesky;

/* Factors K (both triangles stored; the upper one is read).  RB_SINGULAR: not positive
 * definite to rounding (a pivot below 1e-11 of the largest, with unit diagonal). */
rb_status rb_sparse_cholesky_create(const rb_sparse *k, rb_sparse_cholesky **factor);
rb_status rb_sparse_cholesky_solve(rb_sparse_cholesky *factor, const double *b, double *x);
/* W = H' K^-1 H, symmetric to the last digit: the function solves with a few columns of H
 * at a time and forms no inverse.  If K consists of separate blocks (unconnected bodies),
 * W stays sparse. */
rb_status rb_sparse_cholesky_congruence(rb_sparse_cholesky *factor, const rb_sparse *h,
                                        rb_sparse *w);
/* Number of entries that the factor of a matrix with this pattern would have. */
rb_status rb_sparse_cholesky_estimate(const rb_sparse *k, double *entries);
double rb_sparse_cholesky_flops(const rb_sparse_cholesky *factor);
/* Number of entries of the factor. */
double rb_sparse_cholesky_entries(const rb_sparse_cholesky *factor);
void rb_sparse_cholesky_free(rb_sparse_cholesky *factor);

RB_PUBLIC_END

#endif
