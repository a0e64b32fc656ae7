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

/* The problem of a game, and (x, y) with the payoffs of the best replies for count z; free all. */
typedef struct {
    rb_sparse M;
    double *q, *lower, *z; /* q owns both: m + n + 2, m + n + 2, (m + n + 2) x count */
    rb_lcp_mixed_problem problem;
} posed_game;

static rb_status pose_game(const rb_lcp_game *g, int count, const double *z, posed_game *p)
{
    const size_t strategies = (size_t)g->m + (size_t)g->n, order = strategies + 2;
    double *regret = rb_alloc(strategies, 1);
    *p = (posed_game){.q = rb_alloc(order, 2 + (size_t)count)};
    rb_status s = RB_ENOMEM;
    if (p->q && regret) {
        p->lower = p->q + order;
        p->z = p->lower + order;
        s = rb_lcp_of_game(g, &p->M, p->q, p->lower);
    }
    for (size_t k = 0; s == RB_OK && k < (size_t)count; k++) {
        memcpy(p->z + k * order, z + k * strategies, strategies * sizeof *z);
        rb_lcp_bimatrix_regret(g, z + k * strategies, regret, p->z + k * order + strategies);
    }
    free(regret);
    p->problem = (rb_lcp_mixed_problem){&p->M, p->q, p->lower, NULL};
    return s;
}

static void free_game(posed_game *p)
{
    rb_sparse_free(&p->M);
    free(p->q);
}

rb_status rb_lcp_prove_game(const rb_lcp_game *g, const double *z, rb_lcp_proof *proof)
{
    posed_game p;
    *proof = (rb_lcp_proof){.row = -1};
    rb_status s = pose_game(g, 1, z, &p);
    if (s == RB_OK)
        s = rb_lcp_prove(&p.problem, p.z, proof);
    free_game(&p);
    return s;
}

/* Probabilities are 1 at most, and the payoffs of the best replies the largest payoffs. */
rb_status rb_lcp_prove_game_number(const rb_lcp_game *g, int count, const double *z, double seconds,
                                   rb_lcp_number *number)
{
    const int strategies = g->m + g->n;
    double *most = rb_alloc((size_t)strategies + 2, 1);
    posed_game p;
    *number = (rb_lcp_number){.most = -1};
    rb_status s = pose_game(g, count, z, &p);
    if (s == RB_OK && !most)
        s = RB_ENOMEM;
    if (s == RB_OK) {
        for (int i = 0; i < strategies; i++)
            most[i] = 1.0;
        for (int i = 0; i < g->m; i++)
            for (int j = 0; j < g->n; j++) {
                const size_t at = (size_t)i + (size_t)j * (size_t)g->ld;
                most[strategies] = fmax(most[strategies], fabs(g->A[at]));
                most[strategies + 1] = fmax(most[strategies + 1], fabs(g->B[at]));
            }
        s = rb_lcp_prove_number(&p.problem, most, count, p.z, seconds, number);
    }
    free_game(&p);
    free(most);
    return s;
}
