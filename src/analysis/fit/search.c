/* Lesser sums of squares around the numbers of a fit (theory-solvers.md, D5).  Where elements move
 * with the numbers, the sum has small jumps, between which derivatives lead to a minimum that is
 * none. Here every sum is that of new elements, where these move, and differences over wide steps
 * pass over the jumps: Gauss's and Newton's method with secants whose steps become smaller
 * (implicit filtering). */
#include "analysis/fit/fit.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Steps of a number that is positive are factors exp(+-h), of others parts of its scale. */
static const double STEPS[] = {0.7, 0.25, 0.08, 0.025};
enum { LEVELS = sizeof STEPS / sizeof STEPS[0], MOVES = 12 };
/* Over twice this step to either side a curve of forces must be smooth. */
static const double ROUGH_STEP = 0.04;
/* A lesser sum counts if it is less by this part of the variance of a point, and of all squares. */
static const double WORTH = 0.2, WORTH_OF_ALL = 1e-9;

typedef struct {
    fit_problem *p;
    double squares; /* of the measured forces */
    double least, theta[RB_CASE_FIT_MAX];
    rb_message *why;
} search;

/* The sum that would be worth to go to. */
static double worth(const search *s)
{
    const fit_problem *p = s->p;
    if (isinf(s->least)) /* the present numbers have no solution */
        return INFINITY;
    return s->least - WORTH * s->least / (p->points - p->n) - WORTH_OF_ALL * s->squares;
}

/* The numbers a step h d from the present ones, within their bounds. */
static void step_from(const search *s, double h, const double *d, double *theta)
{
    for (int j = 0; j < s->p->n; j++) {
        const rb_case_parameter *of = &s->p->fit->parameter[j];
        const double x = s->theta[j];
        theta[j] = d[j] == 0.0               ? x
                   : of->positive && x > 0.0 ? x * exp(h * d[j])
                                             : x + h * d[j] * fmax(fabs(x), of->scale);
        rb_case_fit_clip(of, &theta[j]);
    }
}

/* Goes to theta if its sum is worth it.  *goes: 1 then. */
static rb_status look_at(search *s, const double *theta, int *goes)
{
    const size_t bytes = (size_t)s->p->n * sizeof *theta;
    const double limit = worth(s);
    double sum;

    *goes = 0;
    if (memcmp(theta, s->theta, bytes) == 0)
        return RB_OK;
    const rb_status status = rb_case_fit_sum(s->p, theta, limit, NULL, &sum, s->why);
    *goes = status == RB_OK && sum < limit;
    if (*goes) {
        s->least = sum;
        memcpy(s->theta, theta, bytes);
    }
    return status;
}

/* Direction k of 2 n: number k/2 up or down, alone; of another 2 n: the others follow it as the
 * derivatives say.  0: there is no such direction; -1: no memory. */
static int direction(const search *s, int k, double *d)
{
    const fit_problem *p = s->p;
    const int n = p->n, j = k / 2 % n, follow = k >= 2 * n;
    const double sign = k % 2 ? -1.0 : 1.0;
    double A[RB_CASE_FIT_MAX * RB_CASE_FIT_MAX], b[RB_CASE_FIT_MAX], singular[RB_CASE_FIT_MAX];
    lapack_int rank, m = 0;

    memset(d, 0, (size_t)n * sizeof *d);
    d[j] = sign;
    if (!follow)
        return 1;
    /* unit steps of the numbers, as step_from takes them */
    double unit[RB_CASE_FIT_MAX];
    for (int i = 0; i < n; i++)
        unit[i] = p->fit->parameter[i].positive && s->theta[i] > 0.0
                      ? s->theta[i]
                      : fmax(fabs(s->theta[i]), p->fit->parameter[i].scale);
    for (int r = 0; r < n; r++) {
        int column = 0;
        if (r == j)
            continue;
        b[m] = -sign * unit[j] * unit[r] * fit_dot(p->points, fit_column(p, r), fit_column(p, j));
        for (int c = 0; c < n; c++)
            if (c != j)
                A[m + column++ * (n - 1)] =
                    unit[c] * unit[r] * fit_dot(p->points, fit_column(p, r), fit_column(p, c));
        m++;
    }
    const int info =
        m == 0 ? 1 : LAPACKE_dgelsd(LAPACK_COL_MAJOR, m, m, 1, A, m, b, m, singular, 1e-9, &rank);
    if (info != 0)
        return rb_lapack_status(info) == RB_ENOMEM ? -1 : 0;
    m = 0;
    for (int i = 0; i < n; i++)
        if (i != j)
            d[i] = fmin(fmax(b[m++], -2.0), 2.0);
    return 1;
}

/* To a neighbour whose sum is less.  Derivatives hold for small steps, and numbers are well alone
 * for large ones.  *goes: 1: there is one. */
static rb_status to_neighbour(search *s, double h, int *goes)
{
    static const double NEAR = 0.3, FAR = 0.2;
    const int n = s->p->n, from = h > FAR || n == 1 ? 0 : 2 * n, to = h > NEAR ? 2 * n : 4 * n;
    double d[RB_CASE_FIT_MAX], theta[RB_CASE_FIT_MAX];
    rb_status status = RB_OK;

    *goes = 0;
    for (int k = from; k < to && status == RB_OK && !*goes; k++) {
        const int there_is = direction(s, k, d);
        if (there_is < 0)
            return RB_ENOMEM;
        if (there_is) {
            step_from(s, h, d, theta);
            status = look_at(s, theta, goes);
        }
    }
    return status;
}

/* A step of Gauss and Newton with secants over +-h.  *goes: 1: to a lesser sum. */
static rb_status secant_step(search *s, double h, int *goes)
{
    const fit_problem *p = s->p;
    const size_t points = (size_t)p->points, n = (size_t)p->n;
    rb_arena scratch = {0};
    double *J = rb_arena_doubles(&scratch, points, n), *b = rb_arena_doubles(&scratch, points, 1),
           *f = rb_arena_doubles(&scratch, points, 2), singular[RB_CASE_FIT_MAX],
           d[RB_CASE_FIT_MAX] = {0.0}, theta[RB_CASE_FIT_MAX], sum;
    lapack_int rank = 0;
    rb_status status = scratch.failed ? RB_ENOMEM : RB_OK;

    *goes = 0;
    if (status == RB_OK)
        status = rb_case_fit_sum(s->p, s->theta, INFINITY, b, &sum, s->why);
    for (size_t j = 0; j < n && status == RB_OK; j++) {
        double sums[2] = {INFINITY, INFINITY};
        for (int side = 0; side < 2 && status == RB_OK; side++) {
            memset(d, 0, sizeof d);
            d[j] = side ? -1.0 : 1.0;
            step_from(s, h, d, theta);
            status = rb_case_fit_sum(s->p, theta, INFINITY, f + (size_t)side * points, &sums[side],
                                     s->why);
        }
        for (size_t k = 0; k < points; k++) {
            const double up = isfinite(sums[0]) ? f[k] : b[k],
                         down = isfinite(sums[1]) ? f[points + k] : b[k];
            J[k + j * points] = (up - down) / (isfinite(sums[0]) + isfinite(sums[1]));
        }
        if (!isfinite(sums[0]) && !isfinite(sums[1]))
            memset(J + j * points, 0, points * sizeof *J);
    }
    for (size_t k = 0; k < points && status == RB_OK; k++)
        b[k] = -b[k];
    const int info = status != RB_OK || !isfinite(sum)
                         ? 1
                         : LAPACKE_dgelsd(LAPACK_COL_MAJOR, p->points, p->n, 1, J, p->points, b,
                                          p->points, singular, 1e-6, &rank);
    if (rb_lapack_status(info) == RB_ENOMEM)
        status = RB_ENOMEM;
    if (info == 0)
        /* secants say little beyond a few of their steps */
        for (double part = 1.0; part > 0.2 && status == RB_OK && !*goes; part *= 0.5) {
            for (size_t j = 0; j < n; j++)
                d[j] = part * fmin(fmax(b[j], -3.0), 3.0);
            step_from(s, h, d, theta);
            status = look_at(s, theta, goes);
        }
    return rb_arena_done(&scratch, status);
}

rb_status rb_case_fit_search(fit_problem *p, double squares, double *theta, int *found,
                             rb_message *why)
{
    search s = {.p = p, .squares = squares, .why = why};
    const size_t bytes = (size_t)p->n * sizeof *theta;
    rb_status status = RB_OK;

    *found = 0;
    if (!p->moves && p->accepted < 0) { /* trials on the same elements follow an accepted one */
        status = rb_case_fit_try(p, theta, &s.least, why);
        if (status == RB_OK)
            status = rb_case_fit_accept(p, theta, why);
        if (status > 0 && status != RB_INTERRUPTED)
            status = RB_OK;
    }
    if (status == RB_OK)
        status = rb_case_fit_sum(p, theta, INFINITY, NULL, &s.least, why);
    memcpy(s.theta, theta, bytes);
    for (int k = 0; k < LEVELS && status == RB_OK; k++) {
        int goes = 1, secants = 1;
        for (int move = 0; move < MOVES && goes && status == RB_OK; move++) {
            status = to_neighbour(&s, STEPS[k], &goes);
            *found |= goes;
            while (status == RB_OK && goes && secants)
                status = secant_step(&s, STEPS[k], &secants);
        }
    }
    memcpy(theta, s.theta, bytes);
    return status;
}

rb_status rb_case_fit_roughness(fit_problem *p, const double *theta, double *roughness,
                                rb_message *why)
{
    /* orthogonal to parabolas over five equal steps (Savitzky and Golay) */
    static const double cubic[] = {-1.0, 2.0, 0.0, -2.0, 1.0},
                        quartic[] = {1.0, -4.0, 6.0, -4.0, 1.0};
    enum { AT = 5, HERE = AT / 2 };
    search s = {.p = p, .why = why};
    const size_t points = (size_t)p->points;
    rb_arena scratch = {0};
    double *f = rb_arena_doubles(&scratch, points, AT), d[RB_CASE_FIT_MAX], squares = 0.0;
    int widest = 0, known;
    rb_status status = scratch.failed ? RB_ENOMEM : RB_OK;

    memcpy(s.theta, theta, (size_t)p->n * sizeof *theta);
    for (int j = 1; j < p->n; j++)
        if (p->fit->parameter[j].deviation / fabs(theta[j]) >
            p->fit->parameter[widest].deviation / fabs(theta[widest]))
            widest = j;
    known = direction(&s, (p->n > 1 ? 2 * p->n : 0) + 2 * widest, d);
    if (known < 0)
        status = RB_ENOMEM;
    for (int k = 0; k < AT && status == RB_OK && known; k++) {
        double way[RB_CASE_FIT_MAX], at[RB_CASE_FIT_MAX], sum, *own = f + (size_t)k * points;
        for (int j = 0; j < p->n; j++)
            way[j] = (k - HERE) * d[j];
        step_from(&s, ROUGH_STEP, way, at);
        for (int j = 0; j < p->n; j++) { /* an end of its range must not shorten a step */
            const rb_case_parameter *of = &p->fit->parameter[j];
            known &= k == HERE || (at[j] > of->low && at[j] < of->high);
        }
        if (!known)
            break;
        status = rb_case_fit_sum(p, at, INFINITY, own, &sum, why);
        known = status == RB_OK && isfinite(sum);
    }
    for (size_t k = 0; k < points && known && status == RB_OK; k++) {
        double third = 0.0, fourth = 0.0;
        for (size_t i = 0; i < AT; i++) {
            third += cubic[i] * f[i * points + k];
            fourth += quartic[i] * f[i * points + k];
        }
        squares += 0.5 * (third * third / 10.0 + fourth * fourth / 70.0);
    }
    *roughness = sqrt(squares / p->points);
    return rb_arena_done(&scratch, status);
}
