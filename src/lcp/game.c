/* Complementarity problems that are bimatrix games: M = [0 A; B' 0] with positive A and
 * B, q < 0.  Lemke's path for covering vectors without a zero ends on a ray there; Lemke
 * and Howson's does not (Cottle, Pang, Stone, section 4.4). */
#include "lcp/lemke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Strategies that paths begin with. */
enum { LABELS = 16 };

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
    const int n = M->cols;
    int m = 0, count[2] = {0, 0};
    int *side = rb_alloc_int(2 * (size_t)n), *of = side ? side + n : NULL;
    double *A = NULL, *mixed = NULL, payoff[2];
    lcp_scale scale = {0};
    rb_status s = !side ? RB_ENOMEM : read_sides(M, q, side, &m) ? RB_OK : RB_SINGULAR;
    const size_t entries = s == RB_OK ? (size_t)m * (size_t)(n - m) : 0;
    if (s == RB_OK) {
        A = rb_alloc(entries, 2);
        mixed = rb_alloc((size_t)n, 3);
        s = A && mixed ? RB_OK : RB_ENOMEM;
    }
    if (s == RB_OK) {
        double *B = A + entries, *regret = mixed + n, *unit = regret + n;
        const rb_lcp_game game = {m, n - m, A, B, m};
        for (int i = 0; i < n; i++)
            of[i] = count[side[i]]++;
        /* Payoffs of the row player (A, m x n) and of the column player (B): minus the
         * costs in units of -q, each unknown in a unit of its own that makes its largest
         * cost near 1. unit: n. */
        for (int j = 0; j < M->cols; j++) {
            double most = 0.0;
            for (int k = M->p[j]; k < M->p[j + 1]; k++)
                most = fmax(most, M->x[k] / -q[M->i[k]]);
            unit[j] = exp2(-floor(log2(most)));
            for (int k = M->p[j]; k < M->p[j + 1]; k++) {
                const int i = M->i[k], row = side[j] ? of[i] : of[j];
                const int col = side[j] ? of[j] : of[i];
                (side[j] ? A : B)[(size_t)row + (size_t)col * (size_t)m] = M->x[k] / q[i] * unit[j];
            }
        }
        /* Paths that begin with one strategy can be long where others are short: one
         * after the other, with a limit that grows. */
        const int own = opt->max_iters;
        const double began = rb_seconds();
        rb_lcp_options o = *opt;
        s = RB_MAXITER;
        int iters = 0;
        for (int limit = 2 * n + 20; s == RB_MAXITER && limit < 50 * n + 1000; limit *= 2)
            for (int label = 0; s == RB_MAXITER && label < LABELS && label < n; label++) {
                o.max_iters = own && own < limit ? own : limit;
                s = rb_lcp_bimatrix(&game, label * (n / LABELS > 0 ? n / LABELS : 1), &o, mixed,
                                    info);
                iters += info->iters;
                if (opt->seconds > 0.0 && rb_seconds() - began > opt->seconds)
                    s = s == RB_MAXITER ? RB_INTERRUPTED : s;
            }
        info->iters = iters;
        rb_lcp_bimatrix_regret(&game, mixed, regret, payoff);
        /* y over the row player's costs, x over the column player's */
        for (int i = 0; i < n; i++)
            z[i] = mixed[side[i] ? m + of[i] : of[i]] / -payoff[!side[i]] * unit[i];
    }
    const lcp_matrix all = {.n = n, .sparse = M};
    if (s == RB_OK)
        s = rb_lcp_scale_create(&all, q, 0, &scale);
    if (s == RB_OK)
        s = rb_lcp_measure(&all, &scale, q, NULL, NULL, z, info);
    if (s == RB_OK)
        s = rb_lcp_assess(info);
    if (s == RB_ENOMEM)
        rb_fail(&info->msg, s, "lcp: out of memory for a game of order %d", n);
    info->solver = "lemke-howson";
    rb_lcp_scale_free(&scale);
    free(side);
    free(A);
    free(mixed);
    return s;
}
