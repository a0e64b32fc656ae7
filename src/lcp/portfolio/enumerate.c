/* All solutions of a small problem: every complementary basis is tried. */
#include "lcp/lemke/lemke.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parts of the largest value: below RIGHT a wrong sign is rounding, below SAME two
 * solutions are one.  A matrix with a smaller reciprocal condition than SINGULAR has no
 * inverse. */
static const double RIGHT = 1e-11, SAME = 1e-9, SINGULAR = 1e-13;

/* Bases that are tried at most. */
static const double MOST_BASES = 4194304.0;

typedef enum { AT_LOWER, AT_UPPER, BETWEEN } place;

typedef struct {
    int n;
    rb_lcp_problem p;
    const double *lower, *upper;
    place *at;             /* n */
    double *A, *x;         /* n x n, n: system of the z between their bounds */
    int *inside, *swap;    /* n, 2n: those z; pivots, and work of dgecon */
    double *z, *w, *terms; /* n; terms: of the rows of w, by modulus */
    double *work;          /* 4n, of dgecon */
} search;

static int is_place(const search *s, int i, place at)
{
    const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
    return at == AT_LOWER   ? isfinite(low)
           : at == AT_UPPER ? isfinite(high) && high > low
                            : high > low;
}

/* M z + q, with the z that are between their bounds as they stand. */
static void product(search *s)
{
    memcpy(s->w, s->p.q, (size_t)s->n * sizeof *s->w);
    cblas_dgemv(CblasColMajor, CblasNoTrans, s->n, s->n, 1.0, s->p.M, s->p.ldm, s->z, 1, 1.0, s->w,
                1);
}

/* z of the basis; 0: its matrix has no inverse. */
static int basic_point(search *s)
{
    int m = 0;
    for (int i = 0; i < s->n; i++) {
        s->z[i] = s->at[i] == AT_LOWER   ? rb_lcp_lower(s->lower, i)
                  : s->at[i] == AT_UPPER ? rb_lcp_upper(s->upper, i)
                                         : 0.0;
        if (s->at[i] == BETWEEN)
            s->inside[m++] = i;
    }
    if (m == 0)
        return 1;
    product(s);
    for (int c = 0; c < m; c++) {
        const double *column = s->p.M + (size_t)s->inside[c] * (size_t)s->p.ldm;
        for (int r = 0; r < m; r++)
            s->A[r + c * m] = column[s->inside[r]];
        s->x[c] = -s->w[s->inside[c]];
    }
    double rcond = 0.0;
    const double norm = LAPACKE_dlange(LAPACK_COL_MAJOR, '1', m, m, s->A, m);
    if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, m, m, s->A, m, s->swap) != 0 ||
        LAPACKE_dgecon_work(LAPACK_COL_MAJOR, '1', m, s->A, m, norm, &rcond, s->work,
                            s->swap + s->n) != 0 ||
        rcond < SINGULAR)
        return 0;
    LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'N', m, 1, s->A, m, s->swap, s->x, m);
    for (int c = 0; c < m; c++)
        s->z[s->inside[c]] = s->x[c];
    return 1;
}

/* The bounds of z and the signs of w, which the basis alone does not give; and that the
 * rows of z between their bounds are still zero, which large entries of M may spoil
 * where a z was put on a bound. */
static int is_solution(search *s)
{
    /* What is outside of the box by rounding is put on it. */
    const double slack = RIGHT * rb_norm_inf((size_t)s->n, s->z);
    for (int i = 0; i < s->n; i++) {
        const double low = rb_lcp_lower(s->lower, i), high = rb_lcp_upper(s->upper, i);
        if (s->z[i] < low - slack || s->z[i] > high + slack)
            return 0;
        s->z[i] = fmin(fmax(s->z[i], low), high);
    }
    product(s);
    /* The terms of every row of M z + q, whose rounding is a part of them. */
    for (int i = 0; i < s->n; i++) {
        const double *row = s->p.M + i;
        s->terms[i] = fabs(s->p.q[i]);
        for (int j = 0; j < s->n; j++)
            s->terms[i] += fabs(row[(size_t)j * (size_t)s->p.ldm] * s->z[j]);
    }
    const double most = rb_norm_inf((size_t)s->n, s->terms);
    /* entries near the largest double can give a point that is no numbers */
    if (!isfinite(rb_norm_inf((size_t)s->n, s->z)) || !isfinite(most))
        return 0;
    for (int i = 0; i < s->n; i++) {
        const int fixed = rb_lcp_lower(s->lower, i) >= rb_lcp_upper(s->upper, i);
        const double small = RIGHT * (s->at[i] == BETWEEN ? most : s->terms[i]);
        if (s->at[i] != AT_UPPER && s->w[i] < -small && !fixed)
            return 0;
        if (s->at[i] != AT_LOWER && s->w[i] > small)
            return 0;
    }
    return 1;
}

void rb_lcp_solutions_free(rb_lcp_solutions *all)
{
    if (!all)
        return;
    free(all->z);
    *all = (rb_lcp_solutions){0};
}

/* Adds z, unless it is known already.  RB_ENOMEM. */
static rb_status keep(const search *s, rb_lcp_solutions *all)
{
    const size_t n = (size_t)s->n, count = (size_t)all->count, bytes = n * sizeof *s->z;
    const double near = SAME * rb_norm_inf(n, s->z);
    for (size_t k = 0; k < count; k++) {
        double apart = 0.0;
        for (size_t i = 0; i < n; i++)
            apart = fmax(apart, fabs(all->z[k * n + i] - s->z[i]));
        if (apart <= near)
            return RB_OK;
    }
    if ((count & (count - 1)) == 0) { /* full: room for twice as many */
        double *z = realloc(all->z, (count ? 2 * count : 1) * bytes);
        if (!z)
            return RB_ENOMEM;
        all->z = z;
    }
    memcpy(all->z + n * (size_t)all->count++, s->z, bytes);
    return RB_OK;
}

/* The first place of z_i that there is from `at` on; 0: there is none. */
static int place_from(search *s, int i, int at)
{
    for (; at <= BETWEEN; at++)
        if (is_place(s, i, (place)at)) {
            s->at[i] = (place)at;
            return 1;
        }
    return 0;
}

rb_status rb_lcp_enumerate(const rb_lcp_problem *p, const double *lower, const double *upper,
                           rb_lcp_solutions *all, rb_message *why)
{
    const int n = p->n;
    const size_t order = (size_t)n;
    search s = {.n = n, .p = *p, .lower = lower, .upper = upper};
    *all = (rb_lcp_solutions){.n = n};
    const rb_lcp_options plain = rb_lcp_defaults();
    rb_status status = rb_lcp_check_dense(&s.p, &plain, why);
    if (status == RB_OK)
        status = rb_lcp_check_boxes(n, lower, upper, why);
    if (status != RB_OK)
        return status;
    double bases = 1.0;
    for (int i = 0; i < n; i++)
        bases *= is_place(&s, i, AT_LOWER) + is_place(&s, i, AT_UPPER) + is_place(&s, i, BETWEEN);
    if (bases > MOST_BASES)
        return rb_fail(why, RB_EINVAL,
                       "lcp: all solutions: %.3g complementary bases: expected at most "
                       "%.3g, that is order 22 without bounds",
                       bases, MOST_BASES);
    rb_arena scratch = {0};
    s.at = rb_arena_zeros(&scratch, order, sizeof *s.at);
    s.A = rb_arena_doubles(&scratch, order, order);
    s.x = rb_arena_doubles(&scratch, order, 1);
    s.z = rb_arena_doubles(&scratch, order, 1);
    s.w = rb_arena_doubles(&scratch, order, 1);
    s.terms = rb_arena_doubles(&scratch, order, 1);
    s.work = rb_arena_doubles(&scratch, order, 4);
    s.inside = rb_arena_ints(&scratch, order);
    s.swap = rb_arena_ints(&scratch, 2 * order);
    status = scratch.failed ? RB_ENOMEM : RB_OK;
    for (int i = 0; status == RB_OK && i < n; i++)
        place_from(&s, i, AT_LOWER);
    for (int digit = 0; status == RB_OK && digit < n;) {
        const int regular = basic_point(&s);
        all->bases++;
        all->singular += !regular;
        if (regular && is_solution(&s))
            status = keep(&s, all);
        if (status == RB_OK && rb_interrupted())
            status = rb_fail(why, RB_INTERRUPTED, "lcp: interrupted after %d bases", all->bases);
        /* The next basis, the places being the digits of a number. */
        for (digit = 0; digit < n && !place_from(&s, digit, (int)s.at[digit] + 1); digit++)
            place_from(&s, digit, AT_LOWER);
    }
    rb_arena_free(&scratch);
    if (status == RB_OK)
        return RB_OK;
    rb_lcp_solutions_free(all);
    return status == RB_INTERRUPTED
               ? status
               : rb_fail(why, status, "lcp: out of memory for all solutions of order %d", n);
}
