/* Proofs that there is no solution.  Private to src/lcp. */
#ifndef LCP_PROOF_ABSENT_H
#define LCP_PROOF_ABSENT_H

#include "lcp/lemke/lemke.h"
#include "lcp/proof/linear.h"

/* rb_proof_least_sum with multipliers that a linear program finds, and the multiples of them that
 * are nearly whole numbers. */
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

#endif
