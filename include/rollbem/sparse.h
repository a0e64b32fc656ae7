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

/* A matrix in coordinate form, whose entries come in any order; those at the same place
 * are added.  Start with {.rows = m, .cols = n}. */
typedef struct {
    int rows, cols;
    int nz, room;
    int *row, *col;   /* room; owned */
    double *x;        /* room; owned */
    rb_status status; /* RB_ENOMEM once there was no memory for an entry, or there were
                         more than INT_MAX of them, which an rb_sparse cannot hold */
} rb_triplets;

void rb_triplets_add(rb_triplets *t, int row, int col, double x);
/* factor A, whose size is that of t or less. */
void rb_triplets_add_matrix(rb_triplets *t, double factor, const rb_sparse *a);
/* Room for some more at once; rb_triplets_add makes room for its own entry.  Returns
 * t->status. */
rb_status rb_triplets_reserve(rb_triplets *t, size_t more);
void rb_triplets_free(rb_triplets *t);

/* t stays.  RB_EINVAL: an index out of range; RB_ENOMEM. */
rb_status rb_sparse_from_triplets(const rb_triplets *t, rb_sparse *a);
/* From a column-major dense matrix, lda >= rows; exact zeros are left out. */
rb_status rb_sparse_from_dense(int rows, int cols, const double *dense, int lda,
                               rb_sparse *a);
rb_status rb_sparse_copy(const rb_sparse *a, rb_sparse *b);
rb_status rb_sparse_transpose(const rb_sparse *a, rb_sparse *t);
void rb_sparse_free(rb_sparse *a);

/* y = alpha A x + beta y, and the same with the transpose. */
void rb_sparse_apply(double alpha, const rb_sparse *a, const double *x, double beta,
                     double *y);
void rb_sparse_apply_transposed(double alpha, const rb_sparse *a, const double *x,
                                double beta, double *y);

/* C = A B.  RB_EINVAL: A has not as many columns as B rows; RB_ENOMEM. */
rb_status rb_sparse_multiply(const rb_sparse *a, const rb_sparse *b, rb_sparse *c);

/* part[i]: number, from 0, of the connected component of the graph of A + A' that i
 * belongs to.  A square. */
rb_status rb_sparse_components(const rb_sparse *a, int *count, int *part);

/* Numerical rank by rank-revealing QR (SuiteSparseQR), with its default tolerance
 * 20 (rows + cols) eps max column norm. */
rb_status rb_sparse_rank(const rb_sparse *a, int *rank);

/* ---- LU of a square matrix whose pattern stays (UMFPACK) --------------------------- */

typedef struct rb_sparse_lu rb_sparse_lu;

/* Orders the pattern; no numbers yet.  RB_EINVAL: not square. */
rb_status rb_sparse_lu_create(const rb_sparse *a, rb_sparse_lu **lu);
/* Operations of one factorisation of a matrix of this pattern, which is symmetric. */
rb_status rb_sparse_lu_estimate(const rb_sparse *a, double *flops);
/* Factors a, which has the pattern given to create and must outlive the solves.
 * flops (NULL: not wanted) grows by the operations done. */
rb_status rb_sparse_lu_factor(rb_sparse_lu *lu, const rb_sparse *a, double *flops);
rb_status rb_sparse_lu_solve(const rb_sparse_lu *lu, const double *b, double *x);
/* Without refinement of the solution. */
rb_status rb_sparse_lu_solve_once(const rb_sparse_lu *lu, const double *b, double *x);
/* Stored in both factors, once there are numbers. */
double rb_sparse_lu_entries(const rb_sparse_lu *lu);
rb_status rb_sparse_lu_solve_transposed(const rb_sparse_lu *lu, const double *b,
                                        double *x);
void rb_sparse_lu_free(rb_sparse_lu *lu);

/* ---- Cholesky of a symmetric positive definite matrix (CHOLMOD) -------------------- */

typedef struct rb_sparse_cholesky rb_sparse_cholesky;

/* Factors K (both triangles stored; the upper one is read).  RB_SINGULAR: not positive
 * definite to rounding (a pivot below 1e-11 of the largest, with unit diagonal). */
rb_status rb_sparse_cholesky_create(const rb_sparse *k, rb_sparse_cholesky **factor);
rb_status rb_sparse_cholesky_solve(rb_sparse_cholesky *factor, const double *b,
                                   double *x);
/* W = H' K^-1 H, symmetric to the last digit: solves with a few columns of H at a time,
 * no inverse.  K in separate blocks (unconnected bodies) leaves W sparse. */
rb_status rb_sparse_cholesky_congruence(rb_sparse_cholesky *factor, const rb_sparse *h,
                                        rb_sparse *w);
double rb_sparse_cholesky_flops(const rb_sparse_cholesky *factor);
/* Stored in the factor. */
double rb_sparse_cholesky_entries(const rb_sparse_cholesky *factor);
void rb_sparse_cholesky_free(rb_sparse_cholesky *factor);

RB_PUBLIC_END

#endif
