/* Problems of any matrix by branching: of one pair after the other it is fixed whether z_i is at
 * a bound or w_i is zero, depth first.  Under each choice the linear program of the inequalities
 * that remain minimises the sum of z and w; where it has no solution, the choice has none.  So
 * the search ends with a solution, or with the proof that there is none. */
#include "lcp/proof/linear.h"
#include "lcp/portfolio/methods.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A pair violates its condition above this part of the largest |q|. */
static const double APART = 1e-7;

/* Choices that are tried at most, seconds where the caller sets no limit, and choices between
 * two looks at the clock. */
static const int MOST_CHOICES = 2000000;
static const double LONGEST = 10.0;
enum { BETWEEN_LOOKS = 64 };

/* A singular value below this part of the largest one does not fix z. */
static const double RANK = 1e-11;

enum { SIDES = 3 };

/* What is fixed at one depth: a pair, its sides from the nearest one on, and how many of them
 * were tried. */
typedef struct {
    int pair, tried, count;
    lcp_side side[SIDES];
} level;

typedef struct {
    int n;
    const rb_lcp_mixed_problem *given;
    lcp_scale scale; /* of it, in which z is measured */
    const lcp_posed *posed;
    const double *q, *lower, *upper; /* n each: of posed, q near 1 */
    double unit;                     /* times these they are those of posed */
    lcp_linear *linear;
    lcp_side *side;       /* n */
    level *fixed;         /* n: by depth */
    double *z, *w, *best; /* n each; best: z in the caller's units */
    double *A, *x, *work; /* n x n, n, n: system of the z between their bounds */
    int *inside, *place;  /* n each: those z, and where each index stands among them, or -1 */
    int choices, undecided;
} search;

/* The sides that pair i can have, the one first that is nearest to z and w. */
static int list_sides(const search *s, int i, lcp_side sides[SIDES])
{
    const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
    double far[SIDES];
    int count = 0;
    for (int k = 0; k < SIDES; k++) {
        const lcp_side side = (lcp_side[]){LCP_AT_LOWER, LCP_AT_UPPER, LCP_BETWEEN}[k];
        if (side == LCP_AT_LOWER ? !isfinite(low)
                                 : low == high || (side == LCP_AT_UPPER && !isfinite(high)))
            continue;
        const double d = side == LCP_AT_LOWER   ? fmax(s->z[i] - low, -s->w[i])
                         : side == LCP_AT_UPPER ? fmax(high - s->z[i], s->w[i])
                                                : fabs(s->w[i]);
        int at = count++;
        for (; at > 0 && far[at - 1] > d; at--) {
            far[at] = far[at - 1];
            sides[at] = sides[at - 1];
        }
        far[at] = d;
        sides[at] = side;
    }
    return count;
}

/* The z of the program solved once more as what it is near to.  1: it is a solution as
 * measured, in s->best.  Negative: RB_ENOMEM. */
static int is_solution(search *s, rb_lcp_info *info)
{
    const int n = s->n;
    const lcp_matrix *M = &s->posed->M;
    int m = 0, rank = 0;
    for (int i = 0; i < n; i++) {
        lcp_side sides[SIDES];
        list_sides(s, i, sides);
        const lcp_side side = s->side[i] == LCP_OPEN ? sides[0] : s->side[i];
        s->place[i] = side == LCP_BETWEEN ? m : -1;
        if (side == LCP_BETWEEN)
            s->inside[m++] = i;
        else
            s->z[i] = side == LCP_AT_UPPER ? s->upper[i] : rb_lcp_lower(s->lower, i);
    }
    /* The least change of z that makes these w zero: the only one, where the matrix is
     * regular. */
    for (int pass = 0; m > 0 && pass < 2; pass++) {
        memset(s->A, 0, (size_t)m * (size_t)m * sizeof *s->A);
        for (int r = 0; r < m; r++)
            s->x[r] = -s->q[s->inside[r]];
        for (int j = 0; j < n; j++) {
            const lcp_column a = rb_lcp_column(M, j);
            for (int k = 0; k < a.count; k++) {
                const int r = s->place[a.row ? a.row[k] : k];
                if (r < 0)
                    continue;
                s->x[r] -= a.x[k] * s->z[j];
                if (s->place[j] >= 0)
                    s->A[r + (size_t)s->place[j] * (size_t)m] = a.x[k];
            }
        }
        const int failed =
            LAPACKE_dgelsd(LAPACK_COL_MAJOR, m, m, 1, s->A, m, s->x, m, s->work, RANK, &rank);
        if (rb_lapack_status(failed) == RB_ENOMEM)
            return RB_ENOMEM;
        for (int c = 0; failed == 0 && c < m; c++) {
            const int i = s->inside[c];
            s->z[i] =
                fmin(fmax(s->z[i] + s->x[c], rb_lcp_lower(s->lower, i)), rb_lcp_upper(s->upper, i));
        }
    }
    for (int i = 0; i < n; i++)
        s->best[i] = s->z[i] * s->unit;
    rb_lcp_scale_back(s->posed, s->best);
    if (!isfinite(rb_norm_inf((size_t)n, s->best)))
        return 0;
    const rb_lcp_mixed_problem *p = s->given;
    for (int i = 0; i < n; i++) /* on its bound, not a rounding beside it */
        s->best[i] = s->z[i] <= rb_lcp_lower(s->lower, i)   ? rb_lcp_lower(p->lower, i)
                     : s->z[i] >= rb_lcp_upper(s->upper, i) ? rb_lcp_upper(p->upper, i)
                                                            : s->best[i];
    const lcp_matrix all = {.n = n, .sparse = p->M};
    if (rb_lcp_measure(&all, &s->scale, p->q, p->lower, p->upper, s->best, info) != RB_OK)
        return RB_ENOMEM;
    return rb_lcp_assess(info) == RB_OK;
}

/* The pair that violates its condition most, of those that are open; -1: all are fixed. */
static int worst_pair(const search *s, double *apart)
{
    int at = -1;
    *apart = -INFINITY;
    for (int i = 0; i < s->n; i++) {
        const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
        const double own = fabs(fmax(fmin(s->z[i] - low, s->w[i]), s->z[i] - high));
        if (s->side[i] == LCP_OPEN && low < high && own > *apart) {
            *apart = own;
            at = i;
        }
    }
    return at;
}

/* RB_OK, RB_NO_SOLUTION, RB_UNDECIDED; RB_MAXITER: a limit of the search; RB_TIME_LIMIT,
 * RB_INTERRUPTED, RB_ENOMEM. */
static rb_status run_branches(search *s, const rb_lcp_options *opt, double began, rb_lcp_info *info)
{
    const double now = rb_seconds();
    const int most = opt->max_iters ? opt->max_iters : MOST_CHOICES;
    for (int depth = 0;;) {
        if (s->choices >= most)
            return RB_MAXITER;
        if (s->choices % BETWEEN_LOOKS == 0) {
            if (rb_interrupted())
                return RB_INTERRUPTED;
            if (opt->seconds > 0.0 && rb_seconds() - began > opt->seconds)
                return RB_TIME_LIMIT;
            if (opt->seconds <= 0.0 && rb_seconds() - now > LONGEST)
                return RB_MAXITER;
        }
        s->choices++;
        const rb_status left = rb_lcp_linear_least(s->linear, s->side, s->z, s->w);
        int pair = -1;
        if (left == RB_OK) {
            double apart;
            pair = worst_pair(s, &apart);
            level *next = &s->fixed[depth];
            if (pair >= 0) {
                next->pair = pair;
                next->tried = 0;
                next->count = list_sides(s, pair, next->side);
            }
            if (pair < 0 || apart <= APART) {
                const int yes = is_solution(s, info);
                if (yes)
                    return yes < 0 ? RB_ENOMEM : RB_OK;
                s->undecided += pair < 0;
            }
            depth += pair >= 0; /* one deeper */
        } else
            s->undecided += left != RB_NO_SOLUTION;
        /* Back to the last pair of which a side is left, and on with that side. */
        while (depth > 0 && s->fixed[depth - 1].tried == s->fixed[depth - 1].count)
            s->side[s->fixed[--depth].pair] = LCP_OPEN;
        if (depth == 0)
            return s->undecided ? RB_UNDECIDED : RB_NO_SOLUTION;
        level *last = &s->fixed[depth - 1];
        s->side[last->pair] = last->side[last->tried++];
    }
}

rb_status rb_lcp_branch(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double began,
                        double *z, rb_lcp_info *info)
{
    const int n = p->M->cols;
    const size_t order = (size_t)n;
    const rb_lcp_options plain = rb_lcp_defaults();
    const lcp_matrix M = {.n = n, .sparse = p->M};
    rb_arena scratch = {0};
    lcp_posed posed = {0};
    rb_lcp_info own = *info;
    search s = {.n = n, .given = p, .posed = &posed, .unit = 1.0};
    double *ends = rb_arena_doubles(&scratch, order, 3);
    s.side = rb_arena_zeros(&scratch, order, sizeof *s.side);
    s.fixed = rb_arena_zeros(&scratch, order, sizeof *s.fixed);
    s.inside = rb_arena_ints(&scratch, order);
    s.place = rb_arena_ints(&scratch, order);
    s.z = rb_arena_doubles(&scratch, order, 5);
    s.A = rb_arena_doubles(&scratch, order, order);
    rb_status status = scratch.failed ? RB_ENOMEM : rb_lcp_scale_create(&M, p->q, 0, &s.scale);
    if (status == RB_OK)
        status = rb_lcp_pose(&M, p->q, p->lower, p->upper, &plain, 1, &posed);
    if (status == RB_OK) {
        s.w = s.z + order;
        s.best = s.w + order;
        s.x = s.best + order;
        s.work = s.x + order;
        const lcp_near_one near = rb_lcp_bring_near_one(&posed, ends);
        s.unit = near.unit;
        s.q = near.q;
        s.lower = near.lower;
        s.upper = near.upper;
        status = rb_lcp_linear_create(&posed.M, s.q, s.lower, s.upper, &s.linear);
    }
    if (status == RB_OK)
        status = run_branches(&s, opt, began, &own);
    if (status == RB_OK) {
        memcpy(z, s.best, order * sizeof *z);
        own.solver = "branching";
        own.msg.text[0] = '\0';
        own.ray_variable = -1;
        *info = own;
    }
    info->iters += s.choices;
    rb_lcp_linear_free(s.linear);
    rb_lcp_posed_free(&posed);
    rb_lcp_scale_free(&s.scale);
    return rb_arena_done(&scratch, status);
}
