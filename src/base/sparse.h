/* Sparse matrices, besides rollbem/sparse.h: products, factorisations. */
#ifndef ROLLBEM_SRC_BASE_SPARSE_H
#define ROLLBEM_SRC_BASE_SPARSE_H

#include "base/base.h"
#include "rollbem/sparse.h"

/* y = alpha A x + beta y. */
void rb_sparse_apply(double alpha, const rb_sparse *a, const double *x, double beta, double *y);

/* Adds factor times A; A has at most as many rows and columns as t. */
void rb_triplets_add_matrix(rb_triplets *t, double factor, const rb_sparse *a);
/* Reserves memory for `more` further entries at once.  This is optional, because
 * rb_triplets_add enlarges the arrays itself.  Returns t->status. */
rb_status rb_triplets_reserve(rb_triplets *t, size_t more);

/* b is a copy of a.  RB_ENOMEM. */
rb_status rb_sparse_copy(const rb_sparse *a, rb_sparse *b);
rb_status rb_sparse_transpose(const rb_sparse *a, rb_sparse *t);

/* A_jj, 0 where it has no entry. */
double rb_sparse_diagonal(const rb_sparse *a, int j);

/* y = alpha A' x + beta y. */
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

#endif
