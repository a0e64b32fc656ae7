/* Equilibria of bimatrix games by the method of Lemke and Howson (SIAM Journal 12, 1964),
 * in the form with two tableaus (Cottle, Pang, Stone, section 4.4). */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the largest entry below which ratios tie, and entries are no pivots. */
static const double SAME = 1e-11, SMALL = 1e-11;

/* s = 1 - P v >= 0, v >= 0: the best replies of one player, P the other player's payoffs
 * made positive.  A column per label: a label belongs to a strategy, that is to one v
 * and, in the other tableau, to one s.  Row-major: rows of labels + 1 numbers, the last
 * one the right-hand side. */
typedef struct {
    int rows, width;
    double *T;  /* rows x width */
    int *basis; /* rows: labels */
    int first;  /* label of the s of row 0 */
} tableau;

static double *row_of(const tableau *t, int row)
{
    return t->T + (size_t)row * (size_t)t->width;
}

/* In an arena that may have failed. */
static void tableau_create(int rows, int labels, int first, rb_arena *memory, tableau *t)
{
    *t = (tableau){.rows = rows, .width = labels + 1, .first = first};
    t->T = rb_arena_doubles(memory, (size_t)rows, (size_t)labels + 1);
    t->basis = rb_arena_ints(memory, (size_t)rows);
    for (int r = 0; r < rows && !memory->failed; r++) {
        row_of(t, r)[first + r] = 1.0;
        row_of(t, r)[labels] = 1.0;
        t->basis[r] = first + r;
    }
}

/* The row that blocks the entering label: least ratio of the right-hand side, then of the
 * columns of s, which are the basis inverse, one after the other (lexicographic). */
static int blocking_row(const tableau *t, int entering, int *tied)
{
    double most = 0.0;
    int count = 0;
    for (int r = 0; r < t->rows; r++)
        most = fmax(most, fabs(row_of(t, r)[entering]));
    for (int r = 0; r < t->rows; r++)
        if (row_of(t, r)[entering] > SMALL * most)
            tied[count++] = r;
    for (int k = -1; k < t->rows && count > 1; k++) {
        const int column = k < 0 ? t->width - 1 : t->first + k;
        double least = INFINITY, size = 0.0;
        int kept = 0;
        for (int i = 0; i < count; i++) {
            const double ratio = row_of(t, tied[i])[column] / row_of(t, tied[i])[entering];
            least = fmin(least, ratio);
            size = fmax(size, fabs(ratio));
        }
        for (int i = 0; i < count; i++) {
            const double *row = row_of(t, tied[i]);
            if (row[column] / row[entering] - least <= SAME * fmax(fabs(least), SAME * size))
                tied[kept++] = tied[i];
        }
        count = kept;
    }
    return count ? tied[0] : -1;
}

static void pivot(tableau *t, int row, int entering)
{
    double *own = row_of(t, row);
    cblas_dscal(t->width, 1.0 / own[entering], own, 1);
    own[entering] = 1.0;
    for (int r = 0; r < t->rows; r++) {
        double *other = row_of(t, r);
        const double factor = other[entering];
        if (r == row || factor == 0.0)
            continue;
        cblas_daxpy(t->width, -factor, own, 1, other, 1);
        other[entering] = 0.0;
        if (other[t->width - 1] < 0.0) /* rounding of a tie */
            other[t->width - 1] = 0.0;
    }
    t->basis[row] = entering;
}

/* x = the v of the tableau, which add up to 1. */
static void strategy(const tableau *t, int first, int count, double *x)
{
    double sum = 0.0;
    memset(x, 0, (size_t)count * sizeof *x);
    for (int r = 0; r < t->rows; r++) {
        const int k = t->basis[r] - first;
        if (k >= 0 && k < count)
            sum += x[k] = fmax(row_of(t, r)[t->width - 1], 0.0);
    }
    if (sum > 0.0)
        cblas_dscal(count, 1.0 / sum, x, 1);
}

/* The least of a player's payoffs, and how far the largest is above it (1 where all are
 * equal). */
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
    return (payoffs){low, high > low ? high - low : 1.0};
}

/* In [0, 1]: adding to payoffs and multiplying them changes no equilibrium. */
static double scaled(payoffs p, const rb_lcp_game *g, const double *P, int i, int j)
{
    return (P[(size_t)i + (size_t)j * (size_t)g->ld] - p.low) / p.wide;
}

/* Labels 0 ... m - 1 are the rows of the game, the others its columns. */
typedef struct {
    int m, labels;
    tableau of_x, of_y;
    int *tied; /* labels: scratch */
    const rb_lcp_options *opt;
    rb_lcp_info *info;
} lemke_howson;

/* Number of a label's variable for the trace: z in its own tableau, w in the other. */
static int variable(const lemke_howson *l, const tableau *t, int label)
{
    const int is_z = (label < l->m) == (t == &l->of_x);
    return is_z ? l->labels + label : label;
}

/* Drops the label, and then in turn every label that the last pivot has doubled, from the
 * tableau where it can enter, until the dropped one is back. */
static rb_status follow_path(lemke_howson *l, int dropped)
{
    tableau *t = dropped < l->m ? &l->of_x : &l->of_y;
    int entering = dropped, leaving = -1;
    const double start = rb_seconds();
    while (leaving != dropped) {
        const rb_status s = rb_lcp_check_limits(l->info, l->opt, l->labels, start);
        if (s != RB_OK)
            return s;
        const int row = blocking_row(t, entering, l->tied);
        if (row < 0)
            return rb_fail(&l->info->msg, RB_INACCURATE,
                           "lcp: rounding errors are too large after %d pivots", l->info->iters);
        leaving = t->basis[row];
        pivot(t, row, entering);
        /* After the pivot on that row of t. */
        const rb_lcp_pivot seen = {.pivot = l->info->iters,
                                   .entering = variable(l, t, entering),
                                   .leaving = variable(l, t, leaving),
                                   .row = t == &l->of_x ? l->m + row : row,
                                   .ratio = row_of(t, row)[t->width - 1],
                                   .attempt = l->opt->attempt,
                                   .n = l->labels};
        if (l->opt->trace)
            l->opt->trace(&seen, l->opt->trace_context);
        l->info->iters++;
        entering = leaving;
        t = t == &l->of_x ? &l->of_y : &l->of_x;
    }
    return RB_OK;
}

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

rb_status rb_lcp_bimatrix(const rb_lcp_game *g, int label, const rb_lcp_options *opt, double *z,
                          rb_lcp_info *info)
{
    rb_lcp_info unread;
    const rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    lemke_howson l = {.opt = &o, .info = info ? info : &unread};
    *l.info = (rb_lcp_info){.res = NAN, .scaled = NAN, .row = -1, .ray_variable = -1};
    rb_status s = check_input(g, label, &l.info->msg);
    if (s != RB_OK)
        return s;
    rb_arena memory = {0};
    double *regret = rb_arena_doubles(&memory, (size_t)g->m + (size_t)g->n, 1), payoff[2];
    l.m = g->m;
    l.labels = g->m + g->n;
    l.tied = rb_arena_ints(&memory, (size_t)l.labels);
    tableau_create(g->n, l.labels, g->m, &memory, &l.of_x);
    tableau_create(g->m, l.labels, 0, &memory, &l.of_y);
    if (memory.failed)
        return rb_arena_done(&memory, out_of_memory(g, &l.info->msg));
    const payoffs of_a = payoffs_of(g, g->A), of_b = payoffs_of(g, g->B);
    for (int j = 0; j < g->n; j++)
        for (int i = 0; i < g->m; i++) {
            row_of(&l.of_x, j)[i] = 1.0 + scaled(of_b, g, g->B, i, j);
            row_of(&l.of_y, i)[g->m + j] = 1.0 + scaled(of_a, g, g->A, i, j);
        }
    s = follow_path(&l, label);
    strategy(&l.of_x, 0, g->m, z);
    strategy(&l.of_y, g->m, g->n, z + g->m);
    l.info->res = rb_lcp_bimatrix_regret(g, z, regret, payoff);
    if (s == RB_OK) {
        const double size = fmax(of_a.wide, of_b.wide);
        l.info->scaled = size > 0.0 ? l.info->res / size : l.info->res;
        s = rb_lcp_assess(l.info);
    }
    return rb_arena_done(&memory, s);
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
    s = rb_lcp_enumerate(&(rb_lcp_problem){order, M, order, q}, NULL, NULL, all, why);
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
