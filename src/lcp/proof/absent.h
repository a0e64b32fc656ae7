/* Proofs that there is no solution.  Private to src/lcp. */
#ifndef LCP_PROOF_ABSENT_H
#define LCP_PROOF_ABSENT_H

#include "lcp/lemke/lemke.h"
#include "lcp/portfolio/linear.h"

/* What the z of these sides have at least as the sum of their distances from their lower bounds, by
 * Farkas' lemma with the multipliers y, outward rounding and exact signs: infinite where there
 * is none, 0 where y shows nothing.  most: n, |z_j| <= most_j is known of every solution; NULL:
 * nothing is. */
double rb_proof_least_sum(const lcp_matrix *M, const double *q, const double *lower,
                          const double *upper, const lcp_side *side, const double *most,
                          const double *y);

/* The same with multipliers that a linear program finds, and the multiples of them that are
 * nearly whole numbers. */
typedef struct {
    const lcp_matrix *M;
    const double *q, *lower, *upper, *most;
    lcp_posed posed; /* owned, as the two below */
    double *memory;  /* 5 n */
    lcp_linear *linear;
} proof_absence;

/* Borrows the problem.  RB_ENOMEM; free in any case. */
rb_status rb_proof_absence_create(const lcp_matrix *M, const double *q, const double *lower,
                                  const double *upper, const double *most, proof_absence *a);
void rb_proof_absence_free(proof_absence *a);
double rb_proof_absence_least_sum(proof_absence *a, const lcp_side *side);

/* rounded: n whole numbers near y/max |y| times `by`, which is 1, 2, ...; with by = 0 that itself.
 * 1: all lie within 1e-5.  Sums of few whole numbers have no rounding errors: they can be zero. */
int rb_proof_nearly_whole(size_t n, const double *y, int by, double *rounded);
enum { PROOF_MULTIPLES = 64 };

#endif
