/* Linear programs under an LCP (GLPK).  Private to src/lcp. */
#ifndef LCP_LINEAR_H
#define LCP_LINEAR_H

#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"

/* The inequalities that remain of a problem when of some pairs it is fixed which of z_i and
 * w_i is at its end (lcp_side).  Starts from the last basis, so that similar choices take
 * few steps. */
typedef struct lcp_linear lcp_linear;

/* A posed problem with q and z in a unit, a power of two, in which the largest |q| is near 1. */
typedef struct {
    double unit;
    const double *q, *lower,
        *upper; /* n each, in the memory given; bounds NULL where posed's are */
} lcp_near_one;

/* memory: 3 n */
lcp_near_one rb_lcp_bring_near_one(const lcp_posed *posed, double *memory);

/* Borrows M, q (whose largest entry should be near 1) and the bounds.  RB_ENOMEM. */
rb_status rb_lcp_linear_create(const lcp_matrix *M, const double *q, const double *lower,
                               const double *upper, lcp_linear **linear);
void rb_lcp_linear_free(lcp_linear *linear);

/* Looks for z within its bounds with w = M z + q of the signs that `side` (n) asks for.
 * RB_OK: z (n) has them but for rounding; RB_NO_SOLUTION: there is none, which was checked
 * (rb_lcp_excludes); RB_UNDECIDED. */
rb_status rb_lcp_linear_decide(lcp_linear *linear, const lcp_side *side, double *z);

/* y: n, the multipliers with which the last call has ended, of the rows of the posed problem. */
void rb_lcp_linear_multipliers(const lcp_linear *linear, double *y);

/* The z among them whose distances from their bounds and |w| have the least sum, over the i
 * with one bound.  Statuses as above. */
rb_status rb_lcp_linear_least(lcp_linear *linear, const lcp_side *side, double *z, double *w);

#endif
