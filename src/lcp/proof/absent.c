/* Absence by Farkas' lemma, with multipliers that a linear program finds. */
#include "lcp/proof/absent.h"

#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Unknowns of the linear program at most. */
enum { MOST_UNKNOWNS = 400 };

rb_status rb_proof_absence_create(const lcp_matrix *M, const double *q, const double *lower,
                                  const double *upper, const double *most, proof_absence *a)
{
    const rb_lcp_options plain = rb_lcp_defaults();
    const size_t n = (size_t)M->n;
    *a = (proof_absence){.M = M, .q = q, .lower = lower, .upper = upper, .most = most};
    a->memory = rb_alloc(n, 5);
    rb_status s = a->memory ? rb_lcp_pose(M, q, lower, upper, &plain, 1, &a->posed) : RB_ENOMEM;
    if (s != RB_OK)
        return s;
    const lcp_near_one near = rb_lcp_bring_near_one(&a->posed, a->memory);
    return rb_lcp_linear_create(&a->posed.M, near.q, near.lower, near.upper, &a->linear);
}

void rb_proof_absence_free(proof_absence *a)
{
    rb_lcp_linear_free(a->linear);
    if (a->memory)
        rb_lcp_posed_free(&a->posed);
    free(a->memory);
    *a = (proof_absence){0};
}

double rb_proof_absence_least_sum(proof_absence *a, const lcp_side *side)
{
    const size_t n = (size_t)a->M->n;
    double *y = a->memory + 3 * n, *rounded = y + n, least = 0.0;
    if (rb_lcp_linear_decide(a->linear, side, rounded) == RB_OK)
        return 0.0;
    rb_lcp_linear_multipliers(a->linear, y);
    for (size_t i = 0; i < n && a->posed.scaled; i++)
        y[i] *= a->posed.scale.row[i];
    for (int by = 0; by <= PROOF_MULTIPLES && least < INFINITY; by++)
        if (rb_proof_nearly_whole(n, y, by, rounded))
            least = fmax(
                least, rb_proof_least_sum(a->M, a->q, a->lower, a->upper, side, a->most, rounded));
    return least;
}

rb_status rb_lcp_prove_absence(const rb_lcp_mixed_problem *p, rb_lcp_proof *proof)
{
    const lcp_matrix M = {.n = p->M->rows, .sparse = p->M};
    const rb_lcp_options plain = rb_lcp_defaults();
    proof_absence absence;
    rb_status s = rb_lcp_check_mixed(p, &plain, NULL);
    proof->least_sum = 0.0;
    if (s != RB_OK || M.n > MOST_UNKNOWNS || !rb_proof_arithmetic())
        return s;
    s = rb_proof_absence_create(&M, p->q, p->lower, p->upper, NULL, &absence);
    if (s == RB_OK)
        proof->least_sum = rb_proof_absence_least_sum(&absence, NULL);
    rb_proof_absence_free(&absence);
    return s;
}

rb_status rb_lcp_prove_or_exclude(const rb_lcp_mixed_problem *p, const double *z,
                                  rb_lcp_proof *proof)
{
    const rb_status s = rb_lcp_prove(p, z, proof);
    const rb_status absence = s == RB_UNDECIDED ? rb_lcp_prove_absence(p, proof) : RB_OK;
    return absence == RB_OK ? s : absence;
}

rb_status rb_lcp_prove_answer(const rb_lcp_mixed_problem *p, double *z, rb_status *ended,
                              rb_lcp_proof *proof, rb_message *why)
{
    rb_status s = rb_lcp_prove_or_exclude(p, z, proof);

    if (*ended == RB_OK)
        return s;
    if (s == RB_OK) {
        /* Proved again, for the distance of the new z from the solution. */
        memcpy(z, proof->z, sizeof *z * (size_t)proof->n);
        rb_lcp_proof_free(proof);
        s = rb_lcp_prove(p, z, proof);
        *ended = RB_OK;
    } else if (s == RB_UNDECIDED && isinf(proof->least_sum) && *ended != RB_NO_SOLUTION)
        *ended = rb_fail(why, RB_NO_SOLUTION, "lcp: there is no solution, as the proof shows");
    return s;
}
