/* Lemke's method for sparse matrices and variables with bounds: w = M z + q + t d with z
 * within its bounds and w complementary to it, from a t for which a simple basis is a
 * solution down to t = 0 (Cottle, Pang, Stone, sections 4.4 and 4.5; Dirkse and Ferris,
 * Optimization Methods and Software 5, 1995, for bounds and for starts from a given
 * point). */
#include "lcp/lemke/basis.h"
#include "lcp/lemke/lemke.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A variable out of its range by this part of the largest of its kind is at its bound. */
static const double ROUNDING = 1e-13;

/* A path from a given point is given up when t is above this part of its first value. */
static const double AWAY = 1.0 + 1e-9;

enum { NONE = -1, OPPOSITE = -2 }; /* in place of a slot: no block; the other bound */

/* A free z(i) is basic from the beginning and never leaves.  Where the matrix of the free
 * z is singular, or such a path has not led to a solution, it is the difference of two
 * that are not negative: its own and one more, whose w is minus w(i).  Then all z can
 * start at a bound, whatever M is; but the rows of the two tie in every step. */
typedef struct {
    int n, *of;  /* order; n - rows of M: the i that each more belongs to; owned */
    rb_sparse M; /* owned when there are any */
    double *q, *lower, *upper, *start, *cover; /* n each; q owns all; of the options that
                                                  are NULL, NULL */
} split;

typedef struct {
    lcp_work work;
    const lcp_task *task;
    split f;
    lcp_posed posed; /* the problem that is solved */
    int underway;    /* 0: the path has not begun */
    int leaving;     /* what left last */
    int n;           /* order; it is larger than the caller's where free variables are split */
    const rb_sparse *M;
    const double *q, *lower, *upper; /* n; no box without a finite end */
    rb_lcp_options opt;
    lcp_basis b;
    int *at_upper;        /* n: the bound of a nonbasic z, and of w's sign with it */
    double *value;        /* n, by slots: the basic variables */
    double *generic;      /* n, by slots: their derivatives by the perturbation */
    double *shift;        /* n: q is q + e shift for a small e, which resolves ties */
    double *y, *g;        /* n: driving column by slots; right-hand side */
    int *tied, *at_bound; /* n: slots that tie; 2n + 1: variables exactly at a bound */
    double first_t;
    rb_lcp_info *info;
} mixed;

/* ---- Variables --------------------------------------------------------------------- */

typedef struct {
    double low, high;
} range;

static range range_of(const mixed *p, int v)
{
    const int n = p->n;
    if (v == 2 * n)
        return (range){0.0, INFINITY};
    if (v >= n)
        return (range){p->lower[v - n], p->upper[v - n]};
    if (p->lower[v] == p->upper[v]) /* z is fixed, w any number */
        return (range){-INFINITY, INFINITY};
    return p->at_upper[v] ? (range){-INFINITY, 0.0} : (range){0.0, INFINITY};
}

static double nonbasic_z(const mixed *p, int i)
{
    return p->at_upper[i] ? p->upper[i] : p->lower[i];
}

static double value_of_t(const mixed *p)
{
    const int slot = p->b.slot[2 * p->n];
    return slot >= 0 ? p->value[slot] : 0.0;
}

/* r = the sum of the basic columns times x. */
static void combine_columns(const mixed *p, const double *x, double *r)
{
    memset(r, 0, (size_t)p->n * sizeof *r);
    for (int s = 0; s < p->n; s++) {
        const int v = p->b.variable[s];
        if (v < p->n)
            r[v] += x[s];
        else
            for (int k = p->M->p[v - p->n]; k < p->M->p[v - p->n + 1]; k++)
                r[p->M->i[k]] -= p->M->x[k] * x[s];
    }
}

/* ---- The basic point from the data ------------------------------------------------- */

/* A new LU, and the constants from it: what was exactly at a bound stays there, because
 * rounding in its place would break ties. */
static rb_status refresh(mixed *p)
{
    for (int s = 0; s < p->n; s++) {
        const range r = range_of(p, p->b.variable[s]);
        p->at_bound[p->b.variable[s]] = p->value[s] == r.low || p->value[s] == r.high;
    }
    rb_status status = rb_lcp_basis_factor(&p->b);
    if (status == RB_OK) {
        /* g = q + M z of the nonbasic z. */
        memcpy(p->g, p->q, (size_t)p->n * sizeof *p->g);
        for (int j = 0; j < p->n; j++) {
            const double z = p->b.slot[p->n + j] < 0 ? nonbasic_z(p, j) : 0.0;
            for (int k = p->M->p[j]; z != 0.0 && k < p->M->p[j + 1]; k++)
                p->g[p->M->i[k]] += p->M->x[k] * z;
        }
        status = rb_lcp_basis_solve(&p->b, p->g, 1, p->value);
    }
    if (status == RB_OK)
        status = rb_lcp_basis_solve(&p->b, p->shift, 0, p->generic);
    if (status != RB_OK)
        return rb_fail(&p->info->msg, status,
                       status == RB_SINGULAR
                           ? "lcp: a basis is singular to rounding after %d pivot%s"
                           : "lcp: out of memory for the LU of a basis after %d pivot%s",
                       p->info->iters, rb_plural(p->info->iters));
    const double zero = ZERO * rb_norm_inf((size_t)p->n, p->value);
    for (int s = 0; s < p->n; s++) {
        const int v = p->b.variable[s];
        const range r = range_of(p, v);
        double *x = p->value + s;
        if (p->at_bound[v] && fabs(*x - r.low) <= zero)
            *x = r.low;
        else if (p->at_bound[v] && fabs(*x - r.high) <= zero)
            *x = r.high;
    }
    return RB_OK;
}

/* ---- Where the path begins --------------------------------------------------------- */

/* All z with bounds at one; with a start, those between their bounds basic. */
static rb_status first_basis(mixed *p, const double *start)
{
    const int n = p->n;
    for (int i = 0; i < n; i++) {
        const double z = start ? start[i] : -INFINITY;
        const int inside =
            (isinf(p->lower[i]) && isinf(p->upper[i])) || (p->lower[i] < z && z < p->upper[i]);
        p->at_upper[i] = !isfinite(p->lower[i]) || (start && z >= p->upper[i]);
        p->b.slot[i] = inside ? -1 : i;
        p->b.slot[n + i] = inside ? i : -1;
        p->b.variable[i] = inside ? n + i : i;
    }
    p->b.slot[2 * n] = -1;
    memset(p->shift, 0, (size_t)n * sizeof *p->shift);
    memset(p->value, 0, (size_t)n * sizeof *p->value);
    const rb_status s = refresh(p);
    if (s == RB_OK) {
        /* A basic variable that is out of its range by rounding is at its bound: the z of
         * a solution must be recognised as one. */
        double most_w = rb_norm_inf((size_t)p->n, p->q), most_z = 0.0;
        for (int k = 0; k < p->n; k++) {
            double *most = p->b.variable[k] < p->n ? &most_w : &most_z;
            *most = fmax(*most, fabs(p->value[k]));
        }
        for (int k = 0; k < p->n; k++) {
            const int v = p->b.variable[k];
            const range r = range_of(p, v);
            const double small = ROUNDING * (v < p->n ? most_w : most_z);
            double *x = p->value + k;
            if (*x < r.low && *x >= r.low - small)
                *x = r.low;
            else if (*x > r.high && *x <= r.high + small)
                *x = r.high;
        }
    }
    return s;
}

/* 1 where the basic variable is to grow with t, -1 where it is to fall: into its box. */
static double inwards(const mixed *p, int s)
{
    const range r = range_of(p, p->b.variable[s]);
    return isinf(r.high) || p->value[s] - r.low < r.high - p->value[s] ? 1.0 : -1.0;
}

static double violation(const mixed *p, int s)
{
    const range r = range_of(p, p->b.variable[s]);
    return fmax(r.low - p->value[s], p->value[s] - r.high);
}

/* The basic variables are to be value + t times y: for w the covering vector, for z so
 * much that where t makes all of them feasible z has not passed through its box. */
static rb_status choose_cover(mixed *p)
{
    double worst = 0.0;
    for (int s = 0; s < p->n; s++) {
        const int v = p->b.variable[s];
        const double cover = v < p->n && p->opt.cover ? p->opt.cover[v] : 1.0;
        p->y[s] = cover;
        if (violation(p, s) <= 0.0)
            continue;
        if (cover == 0.0)
            return rb_fail(&p->info->msg, RB_EINVAL,
                           "lcp: cover(%d) = 0: expected a number > 0, because w(%d) = %g "
                           "at the start has the wrong sign",
                           v + 1, v + 1, p->value[s]);
        worst = fmax(worst, violation(p, s) / cover);
    }
    for (int s = 0; s < p->n; s++) {
        const range r = range_of(p, p->b.variable[s]);
        const double out = fmax(violation(p, s), 0.0);
        if (p->b.variable[s] >= p->n)
            p->y[s] = out > 0.0 ? (out + fmin(out, 0.25 * (r.high - r.low))) / worst : 0.0;
        else if (isinf(r.low) && isinf(r.high))
            p->y[s] = 0.0;
        p->y[s] *= inwards(p, s);
    }
    combine_columns(p, p->y, p->b.d);
    return RB_OK;
}

/* ---- The ratio test ---------------------------------------------------------------- */

/* Where the basic variable of slot s moves at unit speed `delta` and meets its bound. */
static double distance(const mixed *p, int s, double delta)
{
    const range r = range_of(p, p->b.variable[s]);
    const double far = delta < 0.0 ? p->value[s] - r.low : r.high - p->value[s];
    return far > 0.0 ? far : 0.0;
}

/* find_slot with the column in p->y as it is.  width: between the bounds of the entering
 * variable. */
static int ratio_test(mixed *p, double sign, double width, double *step, int *count)
{
    const double most_y = rb_norm_inf((size_t)p->n, p->y);
    const double most_value = rb_norm_inf((size_t)p->n, p->value);
    double least = width;
    *count = 0;
    for (int k = 0; k < p->n; k++) {
        if (fabs(p->y[k]) <= NOISE * most_y)
            continue;
        const double ratio = distance(p, k, -sign * p->y[k]) / fabs(p->y[k]);
        least = ratio < least ? ratio : least;
    }
    if (isinf(least))
        return NONE;
    *step = least;
    const double zero = TIE * (most_value + least * most_y);
    /* where all of y is zero no slot ties, and any number or none will do */
    const double most = least + NEAR * fmax(least, most_value / most_y);
    for (int k = 0; k < p->n; k++) {
        const double size = fabs(p->y[k]);
        if (size <= NOISE * most_y)
            continue;
        const double far = distance(p, k, -sign * p->y[k]);
        if (far <= most * size && far - least * size <= zero)
            p->tied[(*count)++] = k;
    }
    /* Of the slots that tie the one that blocks first under the perturbation, t before
     * all.  most may have overflowed: a variable without another bound never comes to it. */
    const int opposite = isfinite(width) && width <= most;
    int slot = opposite ? OPPOSITE : NONE;
    double first = opposite ? 0.0 : INFINITY;
    for (int k = 0; k < *count; k++) {
        const int tied = p->tied[k];
        const double delta = -sign * p->y[tied], moves = p->generic[tied] / fabs(delta);
        const double ratio = delta < 0.0 ? moves : -moves;
        if (p->b.variable[tied] == 2 * p->n)
            return tied;
        if (p->opt.rule == RB_LCP_FIRST_INDEX && slot >= 0)
            continue;
        if (slot == NONE || ratio < first) {
            slot = tied;
            first = ratio;
        }
    }
    return slot;
}

/* The slot that blocks the entering variable, whose column comes to p->y, when it moves
 * by sign * step; OPPOSITE: its own other bound; NONE.  count: slots that tie.  A pivot
 * near rounding and the absence of one are believed only with a new LU. */
static rb_status find_slot(mixed *p, int entering, double sign, int *slot, double *step, int *count)
{
    const range own = range_of(p, entering);
    for (;;) {
        rb_status s = rb_lcp_basis_column(&p->b, entering, p->y);
        if (s != RB_OK)
            return rb_fail(&p->info->msg, s, "lcp: no column after %d pivot%s", p->info->iters,
                           rb_plural(p->info->iters));
        const double noise = DROP * rb_norm_inf((size_t)p->n, p->y);
        for (int k = 0; k < p->n; k++)
            if (fabs(p->y[k]) <= noise)
                p->y[k] = 0.0;
        *slot = ratio_test(p, sign, own.high - own.low, step, count);
        const int sure =
            *slot == OPPOSITE ||
            (*slot >= 0 && fabs(p->y[*slot]) > DOUBT * rb_norm_inf((size_t)p->n, p->y));
        if (sure || p->b.exchanges == 0)
            return RB_OK;
        s = refresh(p);
        if (s != RB_OK)
            return s;
    }
}

/* ---- The path ---------------------------------------------------------------------- */

static void tell_trace(const mixed *p, int entering, int leaving, int slot, double step)
{
    const rb_lcp_pivot record = {.pivot = p->info->iters,
                                 .entering = entering,
                                 .leaving = leaving,
                                 .row = slot >= 0 ? slot : p->b.n,
                                 .ratio = step,
                                 .z0 = value_of_t(p),
                                 .attempt = p->opt.attempt,
                                 .n = p->n,
                                 .basis = p->b.variable,
                                 .value = p->value};
    if (p->opt.trace)
        p->opt.trace(&record, p->opt.trace_context);
}

/* The entering variable moves by sign * step: the basic ones with it, those that tie to
 * their bounds exactly.  It then replaces the variable of the slot, or is at its other
 * bound. */
static rb_status exchange(mixed *p, int entering, double sign, double step, int slot, int count)
{
    const range own = range_of(p, entering);
    const double from = sign > 0.0 ? own.low : own.high;
    for (int s = 0; s < p->n; s++)
        p->value[s] -= sign * step * p->y[s];
    for (int k = 0; k < count; k++) {
        const int s = p->tied[k];
        const range r = range_of(p, p->b.variable[s]);
        p->value[s] = -sign * p->y[s] < 0.0 ? r.low : r.high;
    }
    if (slot == OPPOSITE) {
        tell_trace(p, entering, entering, slot, step);
        p->at_upper[entering - p->n] = sign > 0.0;
        return RB_OK;
    }
    const int leaving = p->b.variable[slot];
    const double change = p->generic[slot] / p->y[slot];
    if (leaving >= p->n && leaving < 2 * p->n)
        p->at_upper[leaving - p->n] = -sign * p->y[slot] > 0.0;
    for (int s = 0; s < p->n; s++)
        p->generic[s] -= change * p->y[s];
    p->generic[slot] = change;
    p->value[slot] = from + sign * step;
    if (rb_lcp_basis_exchange(&p->b, slot, entering, p->y) != RB_OK)
        return rb_fail(&p->info->msg, RB_ENOMEM, "lcp: out of memory after %d pivot%s",
                       p->info->iters, rb_plural(p->info->iters));
    tell_trace(p, entering, leaving, slot, step);
    return RB_OK;
}

/* Of a pivot, beside what the basis has counted. */
static const double PER_OPERATION = 0.35;

/* The path begins at the point, or with NULL at the bounds. */
static rb_status set_out(mixed *p, const double *start)
{
    p->underway = 1;
    p->leaving = NONE;
    rb_status s = first_basis(p, start);
    if (s == RB_OK) {
        /* The perturbation: generic, and such that every basic variable moves into its
         * box. */
        unsigned long long seed = 20260101;
        for (int i = 0; i < p->n; i++)
            p->generic[i] = inwards(p, i) * rb_lcp_random(&seed);
        combine_columns(p, p->generic, p->shift);
        s = choose_cover(p);
    }
    /* The slot that needs the largest t; none: the basic point is the solution. */
    int slot = NONE;
    p->first_t = 0.0;
    for (int k = 0; s == RB_OK && k < p->n; k++) {
        const double out = violation(p, k);
        if (out <= 0.0)
            continue;
        const double needs = out / fabs(p->y[k]);
        const int before = p->opt.rule == RB_LCP_LEXICOGRAPHIC && needs == p->first_t &&
                           p->generic[k] / p->y[k] < p->generic[slot] / p->y[slot];
        if (slot == NONE || needs > p->first_t || before) {
            slot = k;
            p->first_t = needs;
        }
    }
    if (slot == NONE)
        return s;
    /* t enters at the value that makes all basic variables feasible. */
    int *leaving = &p->leaving;
    const double t = p->first_t;
    const int v = p->b.variable[slot], grows = p->y[slot] > 0.0;
    for (int j = 0; j < p->n; j++)
        p->y[j] = -p->y[j];
    const rb_status status = exchange(p, 2 * p->n, 1.0, t, slot, 0);
    if (v >= p->n) /* it comes from outside its box, unlike in the ratio test */
        p->at_upper[v - p->n] = !grows;
    p->info->iters++;
    *leaving = v;
    return status;
}

/* From the first basis to t = 0: after w(i) z(i) enters, after z(i) w(i), with the sign
 * that belongs to the bound.  RB_RAY with ray_variable < 0: the path has gone away from t
 * = 0 beyond its beginning. */
static rb_status follow_path(mixed *p)
{
    const int n = p->n;
    int slot = NONE, count = 0;
    double step = 0.0;
    while (p->leaving != NONE && !rb_lcp_pauses(&p->work)) {
        const int entering = rb_lcp_complement(n, p->leaving);
        const double sign = p->at_upper[entering % n] ? -1.0 : 1.0;
        const double before = p->b.operations;
        rb_status s = rb_lcp_check_limits(p->info, &p->opt, n, p->task->began);
        if (s == RB_OK && rb_lcp_basis_is_long(&p->b))
            s = refresh(p);
        if (s == RB_OK)
            s = find_slot(p, entering, sign, &slot, &step, &count);
        if (s == RB_OK && slot == NONE) {
            double *direction = p->g;
            for (int i = 0; i < n; i++) {
                const int at = p->b.slot[n + i];
                direction[i] = at >= 0 ? -sign * p->y[at] : entering == n + i ? sign : 0.0;
            }
            s = rb_lcp_fail_ray(p->info, &p->posed, entering, value_of_t(p), direction);
        }
        if (s != RB_OK)
            return s;
        p->leaving = slot == OPPOSITE ? entering : p->b.variable[slot];
        s = exchange(p, entering, sign, step, slot, count);
        p->info->iters++;
        p->work.used += (1000.0 + 12.0 * n) + PER_OPERATION * (p->b.operations - before);
        if (s != RB_OK)
            return s;
        if (p->leaving == 2 * n || value_of_t(p) <= VANISHED * p->first_t)
            return refresh(p);
        if (p->opt.start && value_of_t(p) > AWAY * p->first_t)
            return RB_RAY;
    }
    return RB_OK;
}

static rb_status go_on(void *state)
{
    mixed *p = state;
    rb_status s = p->underway ? RB_OK : set_out(p, p->opt.start);
    if (s == RB_OK)
        s = follow_path(p);
    if (p->opt.start && (s == RB_RAY || s == RB_SINGULAR || s == RB_NUMERICAL)) {
        p->opt.start = NULL;
        s = set_out(p, NULL);
        if (s == RB_OK)
            s = follow_path(p);
    }
    return s;
}

/* ---- The problem without free variables -------------------------------------------- */

/* With `splits` 0 a copy of the vectors. */
static rb_status split_create(const rb_lcp_mixed_problem *p, int splits, const double *start,
                              const double *cover, split *f)
{
    const int n = p->M->rows;
    *f = (split){.n = n, .of = rb_alloc_int((size_t)n), .q = rb_alloc((size_t)n, 10)};
    int *number = rb_alloc_int((size_t)n);
    rb_status s = f->of && f->q && number ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        f->lower = f->q + 2 * n;
        f->upper = f->lower + 2 * n;
        f->start = start ? f->upper + 2 * n : NULL;
        f->cover = cover ? f->upper + 4 * n : NULL;
    }
    for (int i = 0; s == RB_OK && i < n; i++) {
        const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
        const int free_one = splits && isinf(low) && isinf(high);
        f->q[i] = p->q[i];
        f->lower[i] = free_one ? 0.0 : low;
        f->upper[i] = high;
        number[i] = free_one ? f->n : -1;
        if (start)
            f->start[i] = start[i];
        if (cover) /* of one half w has the wrong sign */
            f->cover[i] = free_one && cover[i] == 0.0 ? 1.0 : cover[i];
        if (!free_one)
            continue;
        f->q[f->n] = -p->q[i];
        f->upper[f->n] = INFINITY;
        if (start)
            f->start[f->n] = -start[i];
        if (cover)
            f->cover[f->n] = f->cover[i];
        f->of[f->n++ - n] = i;
    }
    if (s == RB_OK && f->n > n) { /* [M, -M_:F; -M_F:, M_FF] */
        rb_triplets t = {.rows = f->n, .cols = f->n};
        for (int j = 0; j < n; j++)
            for (int k = p->M->p[j]; k < p->M->p[j + 1]; k++)
                for (int more = 0; more < 4; more++) {
                    const int i = p->M->i[k], row = more & 1 ? number[i] : i;
                    const int col = more & 2 ? number[j] : j;
                    const double x = more == 1 || more == 2 ? -p->M->x[k] : p->M->x[k];
                    if (row >= 0 && col >= 0)
                        rb_triplets_add(&t, row, col, x);
                }
        s = rb_sparse_from_triplets(&t, &f->M);
        rb_triplets_free(&t);
    }
    free(number);
    return s;
}

/* ---- All together ------------------------------------------------------------------ */

double rb_lcp_residual_mixed(const rb_lcp_mixed_problem *p, const double *z, double *w)
{
    double worst = 0.0;
    memcpy(w, p->q, (size_t)p->M->rows * sizeof *w);
    rb_sparse_apply(1.0, p->M, z, 1.0, w);
    for (int i = 0; i < p->M->rows; i++) {
        const double low = z[i] - rb_lcp_lower(p->lower, i);
        const double high = z[i] - rb_lcp_upper(p->upper, i);
        if (isnan(z[i]) || isnan(w[i]))
            return NAN;
        worst = fmax(worst, fabs(fmax(fmin(low, w[i]), high)));
    }
    return worst;
}

double rb_lcp_rounding_floor(const rb_lcp_mixed_problem *p, const double *z, double *work)
{
    const rb_sparse *M = p->M;
    for (int i = 0; i < M->rows; i++)
        work[i] = fabs(p->q[i]);
    for (int j = 0; j < M->cols; j++)
        for (int k = M->p[j]; k < M->p[j + 1]; k++)
            work[M->i[k]] += fabs(M->x[k] * z[j]);
    return 1e-14 * rb_norm_inf((size_t)M->rows, work);
}

static rb_status begin_mixed(const lcp_task *task, int balance_q, rb_lcp_info *info, void *state)
{
    mixed *p = state;
    const rb_lcp_mixed_problem given = {task->M.sparse, task->q, task->lower, task->upper};
    const int n = task->M.n;
    *p = (mixed){.work.allowed = INFINITY, .task = task, .info = info, .opt = *task->opt};
    split *f = &p->f;
    rb_status s = split_create(&given, task->split, p->opt.start, p->opt.cover, f);
    const lcp_matrix all = {.n = f->n, .sparse = f->n > n ? &f->M : given.M};
    p->opt.start = f->start;
    p->opt.cover = f->cover;
    if (s == RB_OK)
        s = rb_lcp_pose(&all, f->q, f->lower, f->upper, &p->opt, balance_q, &p->posed);
    if (s == RB_ENOMEM)
        return rb_fail(&info->msg, s, "lcp: out of memory for order %d", n);
    const size_t order = (size_t)f->n;
    p->n = f->n;
    p->opt = p->posed.opt;
    p->M = p->posed.M.sparse;
    p->q = p->posed.q;
    p->lower = p->posed.lower;
    p->upper = p->posed.upper;
    p->value = rb_alloc(order, 5);
    p->at_upper = rb_alloc_int(4 * order + 1);
    s = rb_lcp_basis_create(p->M, &p->b);
    if (s != RB_OK || !p->value || !p->at_upper)
        return rb_fail(&info->msg, RB_ENOMEM, "lcp: out of memory for order %d", f->n);
    p->generic = p->value + order;
    p->shift = p->generic + order;
    p->y = p->shift + order;
    p->g = p->y + order;
    p->tied = p->at_upper + order;
    p->at_bound = p->tied + order;
    return RB_OK;
}

/* RB_INACCURATE: the end of the path does not solve. */
static rb_status end_mixed(void *state, rb_status s, double *z)
{
    mixed *p = state;
    const lcp_task *task = p->task;
    if (s >= 0) {
        /* z from the basic point, the halves of free ones together. */
        const double *col = p->posed.scaled ? p->posed.scale.col : NULL;
        for (int i = 0; i < p->n; i++) {
            const int slot = p->b.slot[p->n + i];
            double x = slot >= 0 ? p->value[slot] : nonbasic_z(p, i);
            x = fmin(fmax(x, p->lower[i]), p->upper[i]) * (col ? col[i] : 1.0);
            if (i < task->M.n)
                z[i] = x;
            else
                z[p->f.of[i - task->M.n]] -= x;
        }
        if (rb_lcp_measure(&task->M, &p->posed.scale, task->q, task->lower, task->upper, z,
                           p->info) != RB_OK)
            s = rb_fail(&p->info->msg, RB_ENOMEM, "lcp: out of memory for order %d", task->M.n);
    }
    if (s == RB_OK)
        s = rb_lcp_assess(p->info);
    rb_lcp_basis_free(&p->b);
    free(p->value);
    free(p->at_upper);
    rb_sparse_free(&p->f.M);
    free(p->f.of);
    free(p->f.q);
    rb_lcp_posed_free(&p->posed);
    return s;
}

const lcp_method rb_lcp_sparse_method = {"lemke-sparse", sizeof(mixed), begin_mixed, go_on,
                                         end_mixed};

rb_status rb_lcp_mixed(const rb_lcp_mixed_problem *p, const rb_lcp_options *opt, double *z,
                       rb_lcp_info *info)
{
    const rb_lcp_options o = opt ? *opt : rb_lcp_defaults();
    rb_lcp_info unread;
    info = info ? info : &unread;
    *info = RB_LCP_INFO_NONE;
    const rb_status s = rb_lcp_check_mixed(p, &o, &info->msg);
    if (s != RB_OK)
        return s;
    lcp_task task = {.M = {.n = p->M->rows, .sparse = p->M},
                     .q = p->q,
                     .lower = p->lower,
                     .upper = p->upper,
                     .opt = &o,
                     .began = rb_seconds()};
    int has_free = 0;
    for (int i = 0; i < p->M->rows; i++)
        has_free |= isinf(rb_lcp_lower(p->lower, i)) && isinf(rb_lcp_upper(p->upper, i));
    mixed state;
    rb_status end = rb_lcp_run(&rb_lcp_sparse_method, &task, &state, z, info);
    if (has_free &&
        (end == RB_SINGULAR || end == RB_RAY || end == RB_NUMERICAL || end == RB_INACCURATE)) {
        const int pivots = info->iters;
        task.split = 1;
        end = rb_lcp_run(&rb_lcp_sparse_method, &task, &state, z, info);
        info->iters += pivots;
    }
    return end;
}
