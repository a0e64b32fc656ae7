/* Equilibria of bimatrix games by the method of Lemke and Howson (SIAM Journal 12, 1964),
 * in the form with two tableaus (Cottle, Pang, Stone, section 4.4). */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>

/* The least of a player's payoffs, and a power of two by which the largest is at most above
 * it (1 where all are equal): integers stay exact, and what ties in them. */
typedef struct {
    double low, wide;
} payoffs;

static payoffs payoffs_of(const rb_lcp_game *g, const double *P)
{
    double low = INFINITY, high = -INFINITY;
    for (int j = 0; j < g->n; j++)
        for (int i = 0; i < g->m; i++) {
            low = fmin(low, P[(size_t)i + (size_t)j * (size_t)g->ld]);
            high = fmax(high, P[(size_t)i + (size_t)j * (size_t)g->ld]);
        }
    return (payoffs){low, high > low ? exp2(ceil(log2(high - low))) : 1.0};
}

/* In [0, 1]: adding to payoffs and multiplying them changes no equilibrium. */
static double scaled(payoffs p, const rb_lcp_game *g, const double *P, int i, int j)
{
    return (P[(size_t)i + (size_t)j * (size_t)g->ld] - p.low) / p.wide;
}

/* Payoffs in [0, 1]: adding to them and multiplying them changes no equilibrium. */
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

static rb_status check_input(const rb_lcp_game *g, int label, rb_message *why)
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
    const payoffs of_a = payoffs_of(g, g->A), of_b = payoffs_of(g, g->B);
    const double size = fmax(of_a.wide, of_b.wide);
    for (int j = 0; j < g->n; j++)
        for (int i = 0; i < g->m; i++) {
            a[i + j * g->m] = scaled(of_a, g, g->A, i, j);
            b[i + j * g->m] = scaled(of_b, g, g->B, i, j);
        }
    const howson_game positive = {g->m, g->n, a, b};
    rb_status s = RB_NUMERICAL;
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
    rb_status s = check_input(g, label == -1 ? 0 : label, &info->msg);
    if (s != RB_OK)
        return s;
    if (label == -1)
        return rb_lcp_bimatrix_rounds(g, &o, began, z, info);
    const double rows = fmax(g->m, g->n), labels = g->m + g->n + 1.0;
    if (!o.max_iters)
        o.max_iters = (int)fmin(ALL_WORK / (2.0 * rows * labels), 1e9);
    return solve_by_label(g, label, &o, began, z, info);
}

/* ---- All equilibria ---------------------------------------------------------------- */

/* With payoffs turned into costs a, b > 0 an equilibrium is, but for the length of its
 * halves, a solution of the LCP with M = [0 a; b' 0] and q = -1 (Cottle, Pang, Stone,
 * section 1.2); w >= 0 leaves neither half of it zero. */
rb_status rb_lcp_bimatrix_enumerate(const rb_lcp_game *g, rb_lcp_solutions *all, rb_message *why)
{
    const int m = g->m, order = g->m + g->n;
    *all = (rb_lcp_solutions){0};
    rb_status s = check_input(g, 0, why);
    if (s != RB_OK)
        return s;
    double *M = rb_alloc((size_t)order, (size_t)order + 1);
    if (!M)
        return out_of_memory(g, why);
    double *q = M + (size_t)order * (size_t)order;
    const payoffs of_a = payoffs_of(g, g->A), of_b = payoffs_of(g, g->B);
    for (int j = 0; j < g->n; j++)
        for (int i = 0; i < m; i++) {
            M[i + (m + j) * order] = 2.0 - scaled(of_a, g, g->A, i, j);
            M[m + j + i * order] = 2.0 - scaled(of_b, g, g->B, i, j);
        }
    for (int k = 0; k < order; k++)
        q[k] = -1.0;
    s = rb_lcp_enumerate(&(rb_lcp_problem){order, M, order, q}, NULL, NULL, 0.0, all, why);
    if (s == RB_OK) {
        /* Each half of a solution becomes a strategy: its probabilities add up to 1. */
        for (int k = 0; k < all->count; k++) {
            double *x = all->z + (size_t)k * (size_t)all->n, *y = x + g->m;
            cblas_dscal(g->m, 1.0 / rb_norm_1((size_t)g->m, x, 1), x, 1);
            cblas_dscal(g->n, 1.0 / rb_norm_1((size_t)g->n, y, 1), y, 1);
        }
    }
    free(M);
    return s;
}
