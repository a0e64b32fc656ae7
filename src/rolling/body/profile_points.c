/* A measured gap as a curve: through its points or, where they carry noise, the smoothest curve
 * that stays as close to them as the noise is large.  The pressure follows the curvature of the
 * gap, which a cubic spline keeps continuous. */
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "rolling/case/check.h"
#include "rolling/case/internal.h"

#include <gsl/gsl_math.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_INTERVALS = 1000, /* of the smoothing spline */
    BAND = 4,              /* a point and a third difference see four coefficients */
    HALVINGS = 50
};
/* Of the smoothing parameter: nothing changes below the first, and the second smooths
 * over a hundred intervals.  Beyond that the equations lose their digits. */
static const double WEAKEST = 1e-6, STRONGEST = 1e12;

/* ---- Checks ------------------------------------------------------------------------ */

rb_status rb_rolling_points_check(const char *what, int n, const double *x, const double *gap,
                                  rb_message *why)
{
    if (n < 3)
        return rb_refuse(why, what, "a table needs 3 points or more, got %d", n);
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]) || !isfinite(gap[i]))
            return rb_refuse_row(why, what, i + 1, "not a finite number");
    for (int i = 1; i < n; i++)
        if (x[i] <= x[i - 1])
            return rb_refuse_row(why, what, i + 1, "expected an x larger than in the row before");
    return RB_OK;
}

/* ---- Smoothing --------------------------------------------------------------------- */

/* A smoothing spline (P-spline of Eilers and Marx, 1996): cubic B-splines on equal
 * intervals, whose coefficients c minimise
 *     (m/n) sum (spline(x_i) - residual_i)^2 + lambda sum (third differences of c)^2,
 * so that a parabola costs nothing.  residual: the points less their best parabola, which
 * keeps the digits where lambda is large. */
typedef struct {
    int n, m; /* points, intervals */
    const double *x;
    double parabola[3];
    double *residual;      /* n */
    double *normal, *band; /* BAND x (m + 3), lower: of the points; with the penalty */
    double *load, *c;      /* m + 3: right-hand side, coefficients */
} smoothing;

/* Interval of x and the four B-splines that are not zero there. */
static int basis(const smoothing *s, double x, double b[BAND])
{
    const double t = (x - s->x[0]) / (s->x[s->n - 1] - s->x[0]) * s->m;
    const int k = (int)fmin(t, s->m - 1);
    const double u = t - k, v = 1.0 - u;

    b[0] = v * v * v / 6.0;
    b[1] = (3.0 * u * u * (u - 2.0) + 4.0) / 6.0;
    b[2] = (3.0 * v * v * (v - 2.0) + 4.0) / 6.0;
    b[3] = u * u * u / 6.0;
    return k;
}

static double value(const smoothing *s, double x)
{
    double b[BAND], sum = 0.0;
    const int k = basis(s, x, b);

    for (int i = 0; i < BAND; i++)
        sum += b[i] * s->c[k + i];
    return sum;
}

static double parabola(const smoothing *s, double x)
{
    const double t = (x - s->x[0]) / (s->x[s->n - 1] - s->x[0]);
    return s->parabola[0] + t * (s->parabola[1] + t * s->parabola[2]);
}

static rb_status take_parabola(smoothing *s, const double *gap)
{
    const int n = s->n;
    rb_arena scratch = {0};
    double *A = rb_arena_doubles(&scratch, (size_t)n, 3),
           *b = rb_arena_doubles(&scratch, (size_t)n, 1);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int i = 0; i < n; i++) {
        A[i] = 1.0;
        A[i + n] = (s->x[i] - s->x[0]) / (s->x[n - 1] - s->x[0]);
        A[i + 2 * (size_t)n] = A[i + n] * A[i + n];
        b[i] = gap[i];
    }
    const int failed = LAPACKE_dgels(LAPACK_COL_MAJOR, 'N', n, 3, 1, A, n, b, n);
    memcpy(s->parabola, b, sizeof s->parabola);
    for (int i = 0; i < n; i++)
        s->residual[i] = gap[i] - parabola(s, s->x[i]);
    return rb_arena_done(&scratch, failed ? RB_ENOMEM : RB_OK);
}

/* Root mean square distance of the points from the spline of this lambda. */
static double distance_of(smoothing *s, double lambda)
{
    static const double third[BAND] = {-1.0, 3.0, -3.0, 1.0};
    const int size = s->m + 3;
    double sum = 0.0;

    memcpy(s->band, s->normal, sizeof(double) * BAND * (size_t)size);
    memcpy(s->c, s->load, sizeof(double) * (size_t)size);
    for (int k = 0; k < s->m; k++)
        for (int p = 0; p < BAND; p++)
            for (int q = p; q < BAND; q++)
                s->band[(size_t)BAND * (size_t)(k + p) + (size_t)(q - p)] +=
                    lambda * third[p] * third[q];
    if (LAPACKE_dpbsv(LAPACK_COL_MAJOR, 'L', size, BAND - 1, 1, s->band, BAND, s->c, size) != 0)
        return INFINITY;
    for (int i = 0; i < s->n; i++)
        sum += gsl_pow_2(value(s, s->x[i]) - s->residual[i]);
    return sqrt(sum / s->n);
}

/* The curve itself: the ends of the intervals and the smoothed values there. */
typedef struct {
    int n;
    double *x, *gap; /* n; in scratch memory */
} points;

static rb_status smooth(int n, const double *x, const double *gap, double noise, rb_arena *scratch,
                        points *curve)
{
    const int m = n - 1 < MOST_INTERVALS ? n - 1 : MOST_INTERVALS;
    const size_t size = (size_t)m + 3;
    smoothing s = {.n = n,
                   .m = m,
                   .x = x,
                   .residual = rb_arena_doubles(scratch, (size_t)n, 1),
                   .normal = rb_arena_doubles(scratch, BAND, size),
                   .band = rb_arena_doubles(scratch, BAND, size),
                   .load = rb_arena_doubles(scratch, size, 1),
                   .c = rb_arena_doubles(scratch, size, 1)};

    *curve = (points){m + 1, rb_arena_doubles(scratch, (size_t)m + 1, 1),
                      rb_arena_doubles(scratch, (size_t)m + 1, 1)};
    const rb_status status = scratch->failed ? RB_ENOMEM : take_parabola(&s, gap);
    if (status != RB_OK)
        return status;
    const double weight = (double)m / n;
    for (int i = 0; i < n; i++) {
        double b[BAND];
        const int k = basis(&s, x[i], b);
        for (int p = 0; p < BAND; p++) {
            s.load[k + p] += weight * b[p] * s.residual[i];
            for (int q = p; q < BAND; q++)
                s.normal[(size_t)BAND * (size_t)(k + p) + (size_t)(q - p)] += weight * b[p] * b[q];
        }
    }
    /* The largest lambda that leaves the points within the noise (Morozov's principle).
     * Of n points with that noise the sum of squares is n +- sqrt(2n) times its square;
     * curves up to twice that deviation are within it. */
    const double bound = noise * sqrt(1.0 + 2.0 * sqrt(2.0 / n));
    double low = WEAKEST, high = STRONGEST;

    for (int k = 0; k < HALVINGS; k++) {
        const double lambda = sqrt(low * high);
        *(distance_of(&s, lambda) > bound ? &high : &low) = lambda;
    }
    distance_of(&s, low);
    for (int k = 0; k <= m; k++) {
        curve->x[k] = k < m ? x[0] + (x[n - 1] - x[0]) * k / m : x[n - 1];
        curve->gap[k] = parabola(&s, curve->x[k]) + value(&s, curve->x[k]);
    }
    return RB_OK;
}

/* ---- Its radius -------------------------------------------------------------------- */

/* Part of the range of the gap in which the contact is looked for, and how far the gap may be off
 * the parabola there, as a part of its rise: a root mean square. */
static const double LOW_PART = 0.1, OFF_PARABOLA = 0.25;
enum { PLACES = 400 };

/* 1/g'' of the parabola that is nearest to the gap where it is low, around its smallest value. NAN:
 * the gap is no parabola there, or none that opens upwards. */
static double radius_of(const rb_rolling_profile *p, double lowest)
{
    const double step = (p->to - p->from) / PLACES, least = rb_rolling_profile_gap(p, lowest);
    double most = least, x[PLACES + 1], gap[PLACES + 1];

    for (int k = 0; k <= PLACES; k++)
        most = fmax(most, rb_rolling_profile_gap(p, p->from + k * step));
    /* the interval around the lowest place, by steps that are fine enough for it */
    const double level = least + LOW_PART * (most - least);
    double from = lowest, to = lowest;
    while (from - step >= p->from && rb_rolling_profile_gap(p, from - step) <= level)
        from -= step;
    while (to + step <= p->to && rb_rolling_profile_gap(p, to + step) <= level)
        to += step;
    for (int k = 0; k < 40; k++) { /* up to the level on either side */
        const double part = step * exp2(-k - 1);
        if (from - part >= p->from && rb_rolling_profile_gap(p, from - part) <= level)
            from -= part;
        if (to + part <= p->to && rb_rolling_profile_gap(p, to + part) <= level)
            to += part;
    }
    const double half = 0.5 * (to - from), middle = 0.5 * (from + to), *corner, *bend;
    const int corners = rb_rolling_profile_corners(p, &corner, &bend);
    for (int k = 0; k < corners; k++)
        if (corner[k] >= from && corner[k] <= to)
            return NAN;
    if (!(half > 0.0) || !(level > least))
        return NAN;
    /* the normal equations of a parabola on places that are alike on either side */
    const int n = PLACES + 1;
    double x2 = 0.0, x4 = 0.0, sum = 0.0, first = 0.0, second = 0.0, off = 0.0;
    for (int k = 0; k < n; k++) {
        x[k] = 2.0 * k / PLACES - 1.0;
        gap[k] = rb_rolling_profile_gap(p, middle + half * x[k]) - least;
        x2 += gsl_pow_2(x[k]);
        x4 += gsl_pow_4(x[k]);
        sum += gap[k];
        first += x[k] * gap[k];
        second += gsl_pow_2(x[k]) * gap[k];
    }
    const double c = (n * second - x2 * sum) / (n * x4 - x2 * x2);
    for (int k = 0; k < n; k++)
        off += gsl_pow_2(gap[k] - (sum - c * x2) / n - x[k] * (first / x2 + x[k] * c));
    return c > 0.0 && sqrt(off / n) <= OFF_PARABOLA * c ? half * half / (2.0 * c) : NAN;
}

/* ---- The curve --------------------------------------------------------------------- */

/* is_smooth: 1: without corners; is_punch: 1: the body ends with the table. */
static rb_status create_profile(int n, const double *x, const double *gap, double noise,
                                int is_smooth, int is_punch, rb_rolling_profile **profile,
                                rb_message *why)
{
    *profile = NULL;
    rb_status s = rb_rolling_points_check("gap", n, x, gap, why);
    if (s == RB_OK)
        s = rb_rolling_check_number("gap-smoothing", noise, why);
    if (s == RB_OK && noise > 0.0 && !(1e-9 * fmax(fabs(x[0]), fabs(x[n - 1])) < x[n - 1] - x[0]))
        s = rb_refuse(why, "gap", "all points lie at x = %g", x[0]);
    if (s != RB_OK)
        return s;
    /* The contact starts where the gap is smallest: inside the table, or the table has not
     * the contact in it. */
    const int end = gap[0] < gap[n - 1] ? 0 : n - 1;
    int lowest = end;
    for (int i = 1; i < n - 1; i++)
        lowest = gap[i] < gap[lowest] ? i : lowest;
    if (lowest == end && !is_punch)
        return rb_refuse_row(
            why, "gap", end + 1,
            "the smallest gap, %g mm, is at an end of the table, which must enclose the contact; "
            "gaps are positive where the bodies are apart, and a punch that ends there has --mesh "
            "punch",
            gap[end]);
    rb_rolling_profile *p = calloc(1, sizeof *p);
    rb_arena scratch = {0};
    points smoothed = {0};
    s = !p ? RB_ENOMEM : noise > 0.0 ? smooth(n, x, gap, noise, &scratch, &smoothed) : RB_OK;
    if (s == RB_OK) {
        const size_t rows = (size_t)(noise > 0.0 ? smoothed.n : n);
        const double *at = noise > 0.0 ? smoothed.x : x, *y = noise > 0.0 ? smoothed.gap : gap;
        p->from = at[0];
        p->to = at[rows - 1];
        s = rb_rolling_interpolant_create((int)rows, at, y, is_smooth, &p->curve);
        if (s == RB_OK)
            p->radius = lowest == end ? NAN : radius_of(p, x[lowest]);
    }
    rb_arena_free(&scratch);
    if (s != RB_OK) {
        rb_rolling_profile_free(p);
        return rb_fail(why, s, "out of memory for a gap of %d points", n);
    }
    *profile = p;
    return RB_OK;
}

rb_status rb_rolling_profile_create(int n, const double *x, const double *gap, double noise,
                                    rb_rolling_profile **profile, rb_message *why)
{
    return create_profile(n, x, gap, noise, noise > 0.0, 0, profile, why);
}

rb_status rb_rolling_profile_punch(int n, const double *x, const double *gap, double noise,
                                   rb_rolling_profile **profile, rb_message *why)
{
    return create_profile(n, x, gap, noise, noise > 0.0, 1, profile, why);
}

rb_status rb_rolling_profile_smooth(int n, const double *x, const double *gap,
                                    rb_rolling_profile **profile, rb_message *why)
{
    return create_profile(n, x, gap, 0.0, 1, 0, profile, why);
}
