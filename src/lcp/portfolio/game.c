/* Complementarity problems that are bimatrix games: M = [0 A; B' 0] with positive A and
 * B, q < 0.  Lemke's path for covering vectors without a zero ends on a ray there; Lemke
 * and Howson's does not (Cottle, Pang, Stone, section 4.4). */
#include "lcp/portfolio/methods.h"

#include <math.h>
#include <string.h>

/* side[i]: 0 for the row player's unknowns, 1 for the column player's; *m: how many 0.
 * Returns 0 where it is no game. */
static int read_sides(const rb_sparse *M, const double *q, int *side, int *m)
{
    const int n = M->cols, of_other = M->p[1] - M->p[0];
    memset(side, 0, (size_t)n * sizeof *side);
    for (int k = M->p[0]; k < M->p[1]; k++)
        side[M->i[k]] = 1;
    *m = n - of_other;
    for (int j = 0; j < n; j++) {
        if (!(q[j] < 0.0) || M->p[j + 1] - M->p[j] != (side[j] ? *m : of_other))
            return 0;
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            if (!(M->x[k] > 0.0 && side[M->i[k]] != side[j]))
                return 0;
    }
    return of_other > 0 && *m > 0;
}

rb_status rb_lcp_game_solve(const rb_sparse *M, const double *q, const rb_lcp_options *opt,
                            double *z, rb_lcp_info *info)
{
    const size_t n = (size_t)M->cols;
    int m = 0, count[2] = {0, 0};
    rb_arena scratch = {0};
    int *side = rb_arena_ints(&scratch, n), *of = rb_arena_ints(&scratch, n);
    if (side && of && !read_sides(M, q, side, &m))
        return rb_arena_done(&scratch, RB_SINGULAR);
    const size_t rows = (size_t)m, columns = n - rows;
    double *A = rb_arena_doubles(&scratch, rows, columns),
           *B = rb_arena_doubles(&scratch, rows, columns),
           *mixed = rb_arena_doubles(&scratch, n, 1), *regret = rb_arena_doubles(&scratch, n, 1),
           *unit = rb_arena_doubles(&scratch, n, 1), payoff[2];
    lcp_scale scale = {0};
    rb_status s = scratch.failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        const rb_lcp_game game = {m, (int)columns, A, B, m};
        for (size_t i = 0; i < n; i++)
            of[i] = count[side[i]]++;
        /* Payoffs of the row player (A, m x n) and of the column player (B): minus the
         * costs in units of -q, each unknown in a unit of its own that makes its largest
         * cost near 1. */
        for (size_t j = 0; j < n; j++) {
            const int begin = M->p[j], end = M->p[j + 1];
            double most = 0.0;
            for (int k = begin; k < end; k++)
                most = fmax(most, M->x[k] / -q[M->i[k]]);
            unit[j] = exp2(-floor(log2(most)));
            for (int k = begin; k < end; k++) {
                const int i = M->i[k], row = side[j] ? of[i] : of[j], col = side[j] ? of[j] : of[i];
                (side[j] ? A : B)[(size_t)row + (size_t)col * rows] = M->x[k] / q[i] * unit[j];
            }
        }
        s = rb_lcp_bimatrix_rounds(&game, opt, rb_seconds(), mixed, info);
        rb_lcp_bimatrix_regret(&game, mixed, regret, payoff);
        /* y over the row player's costs, x over the column player's */
        for (size_t i = 0; i < n; i++)
            z[i] = mixed[side[i] ? m + of[i] : of[i]] / -payoff[!side[i]] * unit[i];
    }
    const lcp_matrix all = {.n = M->cols, .sparse = M};
    if (s == RB_OK)
        s = rb_lcp_scale_create(&all, q, 0, &scale);
    if (s == RB_OK)
        s = rb_lcp_measure(&all, &scale, q, NULL, NULL, z, info);
    if (s == RB_OK)
        s = rb_lcp_assess(info);
    if (s == RB_ENOMEM)
        rb_fail(&info->msg, s, "lcp: out of memory for a game of order %d", M->cols);
    info->solver = "lemke-howson";
    rb_lcp_scale_free(&scale);
    return rb_arena_done(&scratch, s);
}
