/* Equilibria of bimatrix games by the method of Lemke and Howson (SIAM Journal 12, 1964),
 * in the form with two tableaus (Cottle, Pang, Stone, section 4.4). */
#include "lcp/portfolio/game.h"
#include "lcp/portfolio/methods.h"

#include <cblas.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>

/* Payoffs in [0, 1]. */
typedef struct {
    int m, n;
    const double *a, *b; /* m x n, column-major */
} howson_game;

/* ---- The path, in one precision and then in another -------------------------------- */

/* Ratios tie within this part of them. */
static const double SAME = 1e-11;

/* A number of a basic variable that looks random: a basis is the sum of those of its own
 * (splitmix64). */
static uint64_t hash_of(int variable)
{
    uint64_t x = 0x9e3779b97f4a7c15ULL * (uint64_t)(variable + 1);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

#define REAL double
#define IN(name) name##_in_double
/* Differences below this part of their terms are zero: on long paths the entries of a
 * tableau differ by 1e12 and more, so that no part of the largest one tells a pivot from
 * rounding. */
#define CANCELLED 1e-13
#include "lcp/portfolio/howson.h"
#undef REAL
#undef IN
#undef CANCELLED
#define REAL long double
#define IN(name) name##_in_long_double
#define CANCELLED 1e-13L
#include "lcp/portfolio/howson.h"

double rb_lcp_bimatrix_regret(const rb_lcp_game *g, const double *z, double *regret,
                              double payoff[2])
{
    const double *x = z, *y = z + g->m;
    const int m = g->m, n = g->n;
    double worst = 0.0;
    payoff[0] = payoff[1] = -INFINITY;
    cblas_dgemv(CblasColMajor, CblasNoTrans, m, n, -1.0, g->A, g->ld, y, 1, 0.0, regret, 1);
    cblas_dgemv(CblasColMajor, CblasTrans, m, n, -1.0, g->B, g->ld, x, 1, 0.0, regret + m, 1);
    for (int k = 0; k < m + n; k++)
        payoff[k >= m] = fmax(payoff[k >= m], -regret[k]);
    for (int k = 0; k < m + n; k++) {
        regret[k] += payoff[k >= m];
        if (isnan(z[k]) || isnan(regret[k]))
            return NAN;
        worst = fmax(worst, fmin(z[k], regret[k]));
    }
    return worst;
}

rb_status rb_lcp_game_check(const rb_lcp_game *g, int label, rb_message *why)
{
    const int m = g->m, n = g->n;
    if (m < 1 || n < 1 || g->ld < m)
        return rb_fail(why, RB_EINVAL,
                       "lcp: a game of %d by %d, ld = %d: expected 1 <= m "
                       "<= ld, 1 <= n",
                       m, n, g->ld);
    if (label < 0 || label >= m + n)
        return rb_fail(why, RB_EINVAL, "lcp: label %d: expected 1 to %d", label + 1, m + n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            const size_t at = (size_t)i + (size_t)j * (size_t)g->ld;
            if (!isfinite(g->A[at]) || !isfinite(g->B[at]))
                return rb_fail(why, RB_EINVAL, "lcp: %c(%d, %d): expected a finite number",
                               isfinite(g->A[at]) ? 'B' : 'A', i + 1, j + 1);
        }
    return RB_OK;
}

double rb_lcp_game_scale(const rb_lcp_game *g, double *a, double *b)
{
    double larger = 0.0;
    for (int player = 0; player < 2; player++) {
        const double *P = player ? g->B : g->A;
        double low = INFINITY, high = -INFINITY;
        for (int j = 0; j < g->n; j++)
            for (int i = 0; i < g->m; i++) {
                low = fmin(low, P[(size_t)i + (size_t)j * (size_t)g->ld]);
                high = fmax(high, P[(size_t)i + (size_t)j * (size_t)g->ld]);
            }
        /* A power of two: dividing by it makes no rounding errors. */
        const double wide = high > low ? exp2(ceil(log2(high - low))) : 1.0;
        for (int j = 0; j < g->n; j++)
            for (int i = 0; i < g->m; i++)
                (player ? b : a)[i + j * g->m] =
                    (P[(size_t)i + (size_t)j * (size_t)g->ld] - low) / wide;
        larger = fmax(larger, wide);
    }
    return larger;
}

static rb_status out_of_memory(const rb_lcp_game *g, rb_message *why)
{
    return rb_fail(why, RB_ENOMEM, "lcp: out of memory for a game of %d by %d", g->m, g->n);
}

/* The path of one label, of a game that has been checked; began: on rb_seconds(). */
static rb_status solve_by_label(const rb_lcp_game *g, int label, const rb_lcp_options *opt,
                                double began, double *z, rb_lcp_info *info)
{
    const size_t entries = (size_t)g->m * (size_t)g->n;
    rb_arena memory = {0};
    *info = RB_LCP_INFO_NONE;
    double *a = rb_arena_doubles(&memory, entries, 1), *b = rb_arena_doubles(&memory, entries, 1),
           *regret = rb_arena_doubles(&memory, (size_t)g->m + (size_t)g->n, 1), payoff[2];
    if (memory.failed)
        return rb_arena_done(&memory, out_of_memory(g, &info->msg));
    const double size = rb_lcp_game_scale(g, a, b);
    const howson_game positive = {g->m, g->n, a, b};
    rb_status s = RB_NUMERICAL;
    /* In doubles, and once more in long doubles where rounding has led the path astray. */
    for (int more = 0; more < 2 && (s == RB_NUMERICAL || s == RB_INACCURATE); more++) {
        s = more ? follow_path_in_long_double(&positive, label, opt, began, z, info)
                 : follow_path_in_double(&positive, label, opt, began, z, info);
        if (s == RB_ENOMEM)
            break;
        info->res = rb_lcp_bimatrix_regret(g, z, regret, payoff);
        info->scaled = size > 0.0 ? info->res / size : info->res;
        if (s == RB_OK)
            s = rb_lcp_assess(info);
    }
    if (s == RB_ENOMEM)
        out_of_memory(g, &info->msg);
    info->solver = "lemke-howson";
    info->label = label;
    return rb_arena_done(&memory, s);
}

/* Operations of all paths together, about half a minute, and labels that they begin with
 * where the caller has not chosen one. */
static const double ALL_WORK = 2e10;
enum { LABELS = 16 };

rb_status rb_lcp_bimatrix_rounds(const rb_lcp_game *g, const rb_lcp_options *opt, double began,
                                 double *z, rb_lcp_info *info)
{
    const int order = g->m + g->n, apart = order / LABELS > 0 ? order / LABELS : 1;
    const double per_pivot = (double)order * order;
    const int most = opt->max_iters ? opt->max_iters : INT_MAX;
    rb_lcp_options o = *opt;
    double left = opt->max_iters ? INFINITY : ALL_WORK;
    int iters = 0, unfinished = 1;
    rb_status s = RB_MAXITER;
    /* Paths of different labels differ in length by powers of ten, and nothing tells which is
     * short: all get the same few pivots, then twice as many, so that the shortest costs twice its
     * length times the labels at most. */
    for (double limit = 2.0 * order + 20.0; unfinished && left > 0.0; limit *= 2.0) {
        o.max_iters = (int)fmin(limit, most);
        unfinished = 0;
        for (int k = 0; k < LABELS && k < order; k++) {
            s = solve_by_label(g, k * apart, &o, began, z, info);
            iters = info->iters += iters;
            left -= per_pivot * o.max_iters;
            unfinished |= s == RB_MAXITER;
            /* where rounding errors have ended this path others may do without them */
            if (s != RB_MAXITER && s != RB_NUMERICAL && s != RB_INACCURATE)
                return s;
        }
        if (o.max_iters >= most)
            break;
    }
    return opt->max_iters && unfinished
               ? RB_MAXITER
               : rb_fail(&info->msg, RB_NUMERICAL,
                         "lcp: every game has an equilibrium, but the paths of %d labels have not "
                         "found one in %d pivots",
                         order < LABELS ? order : LABELS, iters);
}

rb_status rb_lcp_bimatrix(const rb_lcp_game *g, int label, const rb_lcp_options *opt, double *z,
                          rb_lcp_info *info)
{
    rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    const double began = rb_seconds();
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    rb_status s = rb_lcp_game_check(g, label == -1 ? 0 : label, &info->msg);
    if (s != RB_OK)
        return s;
    if (label == -1)
        return rb_lcp_bimatrix_rounds(g, &o, began, z, info);
    const double rows = fmax(g->m, g->n), labels = g->m + g->n + 1.0;
    if (!o.max_iters)
        o.max_iters = (int)fmin(ALL_WORK / (2.0 * rows * labels), 1e9);
    return solve_by_label(g, label, &o, began, z, info);
}
