/* Definite matrices with a proof: nothing is assumed of the Cholesky factor, whose residual is
 * bounded. */
#include "lcp/lcp.h"
#include "lcp/proof/bounds.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

/* Entries may differ from those of A by so many units of rounding. */
static const double RADIUS = 16.0;

rb_status rb_lcp_prove_definite(int n, const double *A, int ld, const double *d,
                                const double *radius, int *definite)
{
    const size_t order = (size_t)n, lead = (size_t)ld;
    rb_arena scratch = {0};
    double *S = rb_arena_doubles(&scratch, order, order),
           *L = rb_arena_doubles(&scratch, order, order),
           *by = rb_arena_doubles(&scratch, order, 5), *rows = by + order, *radii = rows + order,
           *sums = radii + order, *ones = sums + order;
    *definite = 0;
    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (size_t i = 0; i < order; i++) {
        const double own = d[i] * A[i + i * lead];
        if (!(d[i] > 0.0 && own > 0x1p-500 && own < 0x1p500))
            return rb_arena_done(&scratch, RB_OK);
        by[i] = ldexp(1.0, -(int)rint(0.5 * log2(own)));
        ones[i] = 1.0;
    }
    /* S = (D A + A'D)/2 with a diagonal near 1, by powers of two */
    for (size_t j = 0; j < order; j++)
        for (size_t i = 0; i < order; i++) {
            const double a = d[i] * A[i + j * lead], b = d[j] * A[j + i * lead],
                         scale = by[i] * by[j];
            S[i + j * order] = 0.5 * (a + b) * scale;
            radii[i] += RADIUS * PROOF_U * (fabs(a) + fabs(b)) * scale + PROOF_TINY;
            if (radius)
                radii[i] += (radius[i + j * order] + radius[j + i * order]) * scale;
        }
    double noise = 0.0, worst = 0.0;
    for (size_t i = 0; i < order; i++) {
        radii[i] = proof_up(order + 4, radii[i]);
        noise = fmax(noise, radii[i]);
    }
    /* c I is more than the residual of L L' = S - c I and what S is wrong by */
    const double c = 4.0 * (noise + 4.0 * (double)n * (double)n * PROOF_U);
    rb_proof_abs_product(n, n, S, n, ones, sums);
    for (size_t j = 0; j < order; j++) {
        S[j + j * order] -= c;
        for (size_t i = j; i < order; i++)
            L[i + j * order] = S[i + j * order];
    }
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, L, n) != 0)
        return rb_arena_done(&scratch, RB_OK);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, n, n, n, -1.0, L, n, L, n, 1.0, S, n);
    for (size_t j = 0; j < order; j++) /* |L|'1 */
        for (size_t i = j; i < order; i++)
            rows[j] += fabs(L[i + j * order]);
    for (size_t j = 0; j < order; j++)
        rows[j] = proof_up(order, rows[j]);
    rb_proof_abs_product(n, n, L, n, rows, by);
    rb_proof_abs_product(n, n, S, n, ones, rows);
    int yes = 1;
    for (size_t i = 0; i < order; i++) {
        const double bound =
            proof_up(order, rows[i]) +
            proof_error(order + 2, proof_up(order, by[i]) + proof_up(order, sums[i]) + c) +
            radii[i] + (double)n * (double)n * PROOF_TINY;
        yes &= proof_up(4, bound) < c; /* NaN: no */
        worst = fmax(worst, bound);
    }
    *definite = yes && worst < c;
    return rb_arena_done(&scratch, RB_OK);
}
