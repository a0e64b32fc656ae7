/* Proofs that there is a solution, or that there is none.  Private to src/lcp. */
#ifndef LCP_FARKAS_H
#define LCP_FARKAS_H

#include "lcp/lemke/scale.h"

/* What is fixed of a pair z_i, w_i. */
typedef enum {
    LCP_OPEN,     /* nothing: z_i within its bounds, w_i with the sign that all of them allow */
    LCP_AT_LOWER, /* z_i = lower_i, w_i >= 0 */
    LCP_AT_UPPER, /* z_i = upper_i, w_i <= 0 */
    LCP_BETWEEN,  /* w_i = 0 */
    LCP_LEFT_OUT  /* z_i = lower_i, w_i any number */
} lcp_side;

/* 1: the bounds (n each, or NULL) allow z_i to be there. */
int rb_lcp_is_place(const double *lower, const double *upper, int i, lcp_side at);

/* y_i, or the nearest number with y_i w_i >= 0 for every w_i that side and bounds allow. */
double rb_lcp_multiplier(lcp_side side, double low, double high, double y);

/* 1: y proves that no z within its bounds has the signs of w = M z + q that `side` (n;
 * NULL: all open) asks for: y'w < 0 for all of them, and >= 0 for the signs (Farkas).
 * Products within 1e-9 of their terms may be zero; whether numbers near y make them so is
 * shown without rounding.  y: n, changed: what has a wrong sign by rounding becomes 0. */
int rb_lcp_excludes(const lcp_matrix *M, const double *q, const double *lower, const double *upper,
                    const lcp_side *side, double *y);

/* What the z of these sides have at least as the sum of their distances from their lower bounds, by
 * Farkas' lemma with the multipliers y, outward rounding and exact signs: infinite where there
 * is none, 0 where y shows nothing.  most: n, |z_j| <= most_j is known of every solution; NULL:
 * nothing is. */
double rb_proof_least_sum(const lcp_matrix *M, const double *q, const double *lower,
                          const double *upper, const lcp_side *side, const double *most,
                          const double *y);

/* rounded: n whole numbers near y/max |y| times `by`, which is 1, 2, ...; with by = 0 that itself.
 * 1: all lie within 1e-5.  Sums of few whole numbers have no rounding errors: they can be zero. */
int rb_proof_nearly_whole(size_t n, const double *y, int by, double *rounded);
enum { PROOF_MULTIPLES = 64 };

#endif
