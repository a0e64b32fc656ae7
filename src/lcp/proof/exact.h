/* What is exactly so of the point of a basis, as the numbers of its problem stand.  Private to
 * src/lcp. */
#ifndef LCP_PROOF_EXACT_H
#define LCP_PROOF_EXACT_H

#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"

/* regular.c: 1: the determinant of these m rows and columns (32 at most) is not zero, because
 * it is not zero modulo one of two primes near 2^61.  0: it is zero modulo both, and would
 * have to have both as factors otherwise. */
int rb_lcp_is_regular(const double *M, int ld, int m, const int *row, const int *column);

/* A problem, the m rows of w = M z + q and columns of z that are solved for, and the z. */
typedef struct {
    const rb_lcp_problem *p;
    const double *lower, *upper; /* n or NULL */
    int m;
    const int *row, *column;
    double *z; /* n; z_j that is not solved for has this value, the others are near it */
} lcp_point;

/* What is exactly so of the solution of w_row = 0. */
enum { LCP_Z_IS_LOWER = 1, LCP_Z_IS_UPPER = 2, LCP_W_IS_ZERO = 4 };

/* regular.c: which of them hold (n), by residues as in rb_lcp_is_regular; none where the order
 * is more than 32 or the system is singular. */
void rb_lcp_zeros(const lcp_point *point, unsigned char *zeros);

/* regular.c: 1: w_row = 0 has no solution, by residues modulo both primes. */
int rb_lcp_has_no_point(const lcp_point *point);

/* exact.c: whether the solution of w_row = 0 solves the problem as the numbers stand, w with the
 * signs of `side`.  RB_OK: it does, which is proved, z is it and zeros (n) are all that it has;
 * RB_NO_SOLUTION: it is proved that it does not; RB_UNDECIDED: some number is too near zero,
 * or the system too near a singular one; RB_ENOMEM. */
rb_status rb_lcp_is_exact(const lcp_point *point, const lcp_side *side, unsigned char *zeros);

#endif
