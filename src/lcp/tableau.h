/* The tableau of Lemke's method: basic = q + T nonbasic, with delayed updates.  Private
 * to the room lcp. */
#ifndef LCP_TABLEAU_H
#define LCP_TABLEAU_H

#include "rollbem/base.h"

/* w = q + M z + d z0; all borrowed. */
typedef struct {
    int n;
    const double *M, *q, *cover; /* cover: d, NULL: ones */
    int ldm;
} lcp_data;

static inline double rb_lcp_cover(const lcp_data *data, int i)
{
    return data->cover ? data->cover[i] : 1.0;
}

/* Variables: w_i = i, z_i = n + i, z0 = 2n, as in rollbem/lcp.h.
 *
 * A pivot on (r, c) exchanges the basic variable of row r with the nonbasic one of column
 * c.  With a = T_:c before it, p = a_r, and u = a except u_r = 1, any column x of T
 * becomes x_r <- 0;  x <- x - s u,  s = x_r / p          (column c itself: x <- 0, s =
 * -1/p) so that k pivots together are  T <- T - U S  with the pivot rows of T, and of the
 * earlier columns of U, set to zero: nothing cancels.  S follows from the k pivot rows by
 * a triangular solve: for one column (all that Lemke's method asks for) or, every `depth`
 * pivots, for all columns, followed by one matrix product. */
typedef struct {
    int n;
    double *T; /* n x (n + 1) column-major, as of the last flush; owned, as all here */
    double *q; /* n: the constants, always current */
    int *basis, *nonbasis; /* variable of each row (n), of each column (n + 1) */
    int *place;            /* of each variable: its row, or -1 - its column */

    int depth, k; /* pivots that U can hold, and that it holds */
    double *U;    /* n x depth */
    double *S;    /* depth x (n + 1) */
    double *L;    /* depth x depth, lower: row j = (U_rj before pivot j, p_j) */
    double *s;    /* depth */
    int *row;     /* depth: pivot rows */
    int *first;   /* depth: 1 if no earlier pivot since the flush had the same row */
    int *row_hit; /* n: 1 if the row was pivoted since the flush */
    int *col_hit; /* n + 1: the column's last pivot since the flush, or -1 */
} lcp_tableau;

/* T = [M, d]; basis w, nonbasis z, z0. */
rb_status rb_lcp_tableau_create(const lcp_data *data, lcp_tableau *t);
void rb_lcp_tableau_free(lcp_tableau *t);

/* a = T_:c, n. */
void rb_lcp_tableau_column(lcp_tableau *t, int c, double *a);
/* a: column c as rb_lcp_tableau_column gave it. */
void rb_lcp_tableau_pivot(lcp_tableau *t, int r, int c, const double *a);
/* Brings T up to date. */
void rb_lcp_tableau_flush(lcp_tableau *t);
/* T and q anew from the data and the basis.  RB_SINGULAR (t as before), RB_ENOMEM. */
rb_status rb_lcp_tableau_rebuild(const lcp_data *data, lcp_tableau *t);
/* T is up to date by other means. */
void rb_lcp_tableau_forget(lcp_tableau *t);

#endif
