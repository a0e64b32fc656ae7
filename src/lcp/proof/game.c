/* An equilibrium of a bimatrix game as a problem with free unknowns, whose coefficients are the
 * payoffs themselves: u, v the payoffs of the best replies,
 *
 *     u - A y >= 0  complementary to x >= 0,    sum x = 1,
 *     v - B'x >= 0  complementary to y >= 0,    sum y = 1. */
#include "lcp/lcp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

rb_status rb_lcp_of_game(const rb_lcp_game *g, rb_sparse *M, double *q, double *lower)
{
    const int m = g->m, n = g->n, u = m + n, v = u + 1;
    rb_triplets t = {.rows = m + n + 2, .cols = m + n + 2};
    for (int i = 0; i < m; i++) {
        for (int j = 0; j < n; j++) {
            const size_t at = (size_t)i + (size_t)j * (size_t)g->ld;
            rb_triplets_add(&t, i, m + j, -g->A[at]);
            rb_triplets_add(&t, m + j, i, -g->B[at]);
        }
        rb_triplets_add(&t, i, u, 1.0);
        rb_triplets_add(&t, u, i, 1.0);
    }
    for (int j = 0; j < n; j++) {
        rb_triplets_add(&t, m + j, v, 1.0);
        rb_triplets_add(&t, v, m + j, 1.0);
    }
    for (int i = 0; i < m + n + 2; i++) {
        q[i] = i < u ? 0.0 : -1.0;
        lower[i] = i < u ? 0.0 : -INFINITY;
    }
    const rb_status s = t.status == RB_OK ? rb_sparse_from_triplets(&t, M) : t.status;
    rb_triplets_free(&t);
    return s;
}

rb_status rb_lcp_prove_game(const rb_lcp_game *g, const double *z, rb_lcp_proof *proof)
{
    const size_t order = (size_t)g->m + (size_t)g->n + 2;
    double *q = rb_alloc(order, 1), *lower = rb_alloc(order, 1), *start = rb_alloc(order, 1);
    rb_sparse M = {0};
    *proof = (rb_lcp_proof){.row = -1};
    rb_status s = q && lower && start ? rb_lcp_of_game(g, &M, q, lower) : RB_ENOMEM;
    if (s == RB_OK) {
        rb_lcp_bimatrix_regret(g, z, start, start + order - 2); /* for the payoffs */
        memcpy(start, z, (order - 2) * sizeof *start);
        s = rb_lcp_prove(&(rb_lcp_mixed_problem){&M, q, lower, NULL}, start, proof);
    }
    rb_sparse_free(&M);
    free(q);
    free(lower);
    free(start);
    return s;
}
