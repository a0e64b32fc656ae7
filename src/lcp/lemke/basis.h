/* A basis of w - M z - d t = q for sparse M: its LU and the exchanges since (product form
 * of the inverse).  Private to src/lcp. */
#ifndef LCP_BASIS_H
#define LCP_BASIS_H

#include "lcp/lcp.h"

/* Variables: w_i = i, z_i = n + i, t = 2n.  Of each pair w_i, z_i at most one is basic,
 * and both are nonbasic for one pair at most, when t is basic.  The basis matrix B has a
 * column e_i for w_i, -M_:i for z_i, -d for t.
 *
 * LU of B: with F the basic z and R the rows whose w is nonbasic, only [M_RF d_R] needs
 * to be factored; the other w follow.  An exchange of the variable of slot r for one with
 * y = B^-1 (its column) leaves the LU as it is and keeps y: x = B_new^-1 b is B^-1 b with
 *     x_r <- x_r / y_r,  then  x_s <- x_s - y_s x_r  for the other slots s. */
typedef struct {
    int n;
    const rb_sparse *M; /* borrowed */
    double *d;          /* n */
    int *variable;      /* n: the basic variable of each slot */
    int *slot;          /* 2n + 1: of each variable, or -1 */

    rb_sparse A;         /* [M_RF d_R] at the last factorisation */
    rb_sparse_lu *lu;    /* NULL: A is empty */
    int *row, *position; /* n: R, and where in R each row is, or -1 */
    double *g, *rhs, *x; /* n */
    int place_of_t;      /* its slot at the last factorisation, or -1 */
    double work;         /* operations of the LU */
    double operations;   /* of all LUs and solutions so far */

    int exchanges;
    int *pivot;      /* slot r of each exchange */
    double *scale;   /* y_r */
    size_t *start;   /* entries of exchange k: start[k] ... start[k + 1] - 1 */
    size_t capacity; /* for entries */
    int *index;      /* the other slots where y is not zero; owned */
    double *value;   /* y there; owned */
    double pending;  /* operations that the exchanges have cost so far */
    rb_arena memory; /* of the other arrays */
} lcp_basis;

/* Memory alone: the caller chooses what is basic, in variable and slot, and factors. */
rb_status rb_lcp_basis_create(const rb_sparse *M, lcp_basis *b);
void rb_lcp_basis_free(lcp_basis *b);

/* LU of the basis as it stands.  The slots change: slot i holds w_i or z_i, t the one
 * that is left.  RB_SINGULAR, RB_ENOMEM: the basis is of no use any more. */
rb_status rb_lcp_basis_factor(lcp_basis *b);
/* 1 when a new LU is cheaper than to go on with the exchanges. */
int rb_lcp_basis_is_long(const lcp_basis *b);

/* y = B^-1 g by slots; g: n by rows.  refined: with a correction by the residual. */
rb_status rb_lcp_basis_solve(lcp_basis *b, const double *g, int refined, double *y);
/* y = B^-1 (column of the variable). */
rb_status rb_lcp_basis_column(lcp_basis *b, int variable, double *y);
/* The variable replaces the one of the slot; y: its column as above.  RB_ENOMEM. */
rb_status rb_lcp_basis_exchange(lcp_basis *b, int slot, int variable, const double *y);

#endif
