/* The tableau of Lemke's method: basic = q + T nonbasic, with delayed updates.  Private
 * to src/lcp. */
#ifndef LCP_TABLEAU_H
#define LCP_TABLEAU_H

#include "lcp/lcp.h"

/* w = q + M z + d z0; borrowed. */
typedef struct {
    rb_lcp_problem p;
    const double *cover; /* n: d, NULL: ones */
} lcp_data;

static inline int rb_lcp_complement(int n, int variable)
{
    return variable < n ? variable + n : variable - n;
}

static inline double rb_lcp_cover(const lcp_data *data, int i)
{
    return data->cover ? data->cover[i] : 1.0;
}

/* Variables: w_i = i, z_i = n + i, z0 = 2n, as in rollbem/lcp.h.
 *
 * A pivot on (r, c) exchanges the basic variable of row r with the nonbasic one of column
 * c.  With a = T_:c before it, p = a_r, and u = a except u_r = 1, any column x of T
 * becomes x_r <- 0;  x <- x - s u,  s = x_r / p          (column c itself: x <- 0, s =
 * -1/p) so that the pivots of a block together are  x <- x - U s  with their rows of x,
 * and of the earlier columns of U, set to zero: nothing cancels.  s follows from those
 * rows by a triangular solve.
 *
 * Pivots are kept, and every column is brought up to date by itself: on the way of
 * Lemke's method most columns are asked for once or never. */
typedef struct {
    int n;
    const lcp_data *data; /* borrowed */
    double *T;            /* n x (n + 1): columns after `level` pivots each, in any order; owned, as
                             all here */
    double *q;            /* n: the constants, always current */
    int *basis, *nonbasis; /* variable of each row (n), of each column (n + 1) */
    int *place;            /* of each variable: its row, or -1 - its column */
    int *level;            /* n + 1 */
    int *slot;             /* n + 1: where column c stands in T; < 0: nowhere */
    int *spare, spares;    /* n + 1: free places in T, and how many */

    int depth, capacity, k; /* pivots of a block; that U can hold; that it holds */
    double *U;              /* n x capacity */
    double *L;   /* depth x capacity, lower by blocks: row j = (U_rj before pivot j, p_j) */
    int *row;    /* capacity: pivot rows */
    int *before; /* capacity: the last pivot on the same row before, or -1 */
    int *last;   /* n: the row's last pivot, or -1 */
    int *wanted; /* n + 1: columns chosen by the look-ahead; scratch */

    int group; /* columns brought up to date together */
    double *X; /* n x group */
    double *S; /* depth x group */
} lcp_tableau;

/* T = [M, d]; basis w, nonbasis z, z0. */
rb_status rb_lcp_tableau_create(const lcp_data *data, lcp_tableau *t);
void rb_lcp_tableau_free(lcp_tableau *t);

/* a = T_:c, n. */
void rb_lcp_tableau_column(lcp_tableau *t, int c, double *a);
/* a: column c as rb_lcp_tableau_column gave it. */
void rb_lcp_tableau_pivot(lcp_tableau *t, int r, int c, const double *a);
/* Pivots that T_:c has not seen. */
int rb_lcp_tableau_behind(const lcp_tableau *t, int c);
/* Brings these columns of T up to date; the order of `columns` is lost. */
void rb_lcp_tableau_advance(lcp_tableau *t, int count, int *columns);
/* Brings column c up to date if it is far behind and, where `driving` (the last driving
 * column, n) is not NULL, with it the columns that Lemke's method will probably ask for
 * next. */
void rb_lcp_tableau_fetch(lcp_tableau *t, int c, const double *driving);
/* x = the sum of weight_c T_:c; scratch: n. */
void rb_lcp_tableau_combine(lcp_tableau *t, const double *weight, double *scratch, double *x);
/* Brings T up to date. */
void rb_lcp_tableau_flush(lcp_tableau *t);
/* No pivot is kept: all columns that stand in T are up to date. */
void rb_lcp_tableau_no_pivots(lcp_tableau *t);
/* Computes T and q again from the data and the basis.  RB_SINGULAR: a pivot is zero (one
 * that is rounding shows in the residual), t is as before; RB_ENOMEM. */
rb_status rb_lcp_tableau_rebuild(lcp_tableau *t);

#endif
