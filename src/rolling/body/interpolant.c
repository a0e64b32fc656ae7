/* The curve through the points of a table: cubic splines, whose curvature is continuous, between
 * the corners of the data, and no curve that leaves its points.  A spline through a corner swings
 * over several rows to either side of it, a spline through a wall by a multiple of its height. */
#include "base/base.h"
#include "rolling/body/interpolant.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_poly.h>
#include <gsl/gsl_spline.h>
#include <stdlib.h>
#include <string.h>

enum {
    WINDOW = 4, /* rows on either side that a corner is compared with */
    LEAST_OTHERS = 3,
    ROUNDS = 20
};
/* A corner's curvature is so many times the root mean square of those around it. */
static const double CONTRAST = 6.0;
/* The second difference of rounded numbers on a straight line is less than this part of them. */
static const double ROUNDED = 3e-6;
/* Parts of the range of the rows around an interval: a curve that leaves its two points by more is
 * none, where the data have an extremum between them and where they are monotone. */
static const double MOST_BEYOND = 0.25, MOST_BEYOND_MONOTONE = 0.05;
/* A jump of the slope that is less than this part of it is no corner. */
static const double VISIBLE = 1e-3;
/* What rounding makes a monotone curve leave its points by, as a part of the same range. */
static const double ROUNDING = 1e-12;

struct rb_rolling_interpolant {
    int n, corners, untold;
    double *x, *y;           /* n; owned, like the rest */
    double *before, *behind; /* n: slopes on either side of a point; they differ at corners */
    double *corner, *bend;   /* abscissae of the corners and how much steeper the curve is behind */
    int *is_break;           /* n: 1: one spline ends here and another one begins */
    int *is_limited;         /* n: 1: the slope is that of the monotone curve */
    int *is_untold;          /* n: 1: there are too few rows around to tell a corner here */
    rb_arena memory;
};

typedef rb_rolling_interpolant curve;

/* ---- Corners ----------------------------------------------------------------------- */

static double chord(const curve *c, int i)
{
    return (c->y[i + 1] - c->y[i]) / (c->x[i + 1] - c->x[i]);
}

/* Second derivative by rows i - 1, i and i + 1. */
static double curvature(const curve *c, int i)
{
    return 2.0 * (chord(c, i) - chord(c, i - 1)) / (c->x[i + 1] - c->x[i - 1]);
}

/* The nearest row on that side (1, -1) in the window where the slope turns back by half of what it
 * turns at row i or more: the other end of a wall.  0: none. */
static int other_end(const curve *c, int i, int side)
{
    const double own = curvature(c, i);

    for (int j = i + side; j >= 1 && j + 1 < c->n && abs(j - i) <= WINDOW; j += side)
        if (curvature(c, j) * own < 0.0 && fabs(curvature(c, j)) >= 0.5 * fabs(own))
            return j;
    return 0;
}

/* The nearest row on that side in the window that turns as row i does, by half as much or more,
 * behind rows that turn by little: the other end of a straight piece, as of a flat between two
 * chamfers.  0: none. */
static int other_end_of_straight(const curve *c, int i, int side)
{
    const double own = curvature(c, i);

    for (int j = i + side; j >= 1 && j + 1 < c->n && abs(j - i) <= WINDOW; j += side) {
        if (CONTRAST * fabs(curvature(c, j)) < fabs(own))
            continue;
        return j != i + side && curvature(c, j) * own >= 0.5 * gsl_pow_2(own) ? j : 0;
    }
    return 0;
}

/* Whether the slope jumps at row i: by much more than it changes from row to row around it, but
 * for a neighbour, where the corner lies between the two, and for the other end of a wall or of a
 * straight piece.  -1: there are too few rows around it to say. */
static int has_corner(const curve *c, int i)
{
    const double own = fabs(curvature(c, i));
    const double before = i > 1 ? fabs(curvature(c, i - 1)) : 0.0,
                 behind = i + 2 < c->n ? fabs(curvature(c, i + 1)) : 0.0;
    const int neighbour = before > behind ? i - 1 : i + 1;
    const int set_apart[] = {CONTRAST * fmax(before, behind) < own ? i : neighbour,
                             other_end(c, i, -1), other_end(c, i, 1),
                             other_end_of_straight(c, i, -1), other_end_of_straight(c, i, 1)};
    double sum = 0.0, size = fabs(c->y[i]);
    int others = 0;

    for (int j = i - WINDOW; j <= i + WINDOW; j++) {
        int is_apart = j < 1 || j + 1 >= c->n || j == i;
        for (size_t k = 0; k < sizeof set_apart / sizeof *set_apart; k++)
            is_apart |= j == set_apart[k];
        if (is_apart)
            continue;
        sum += gsl_pow_2(curvature(c, j));
        size = fmax(size, fabs(c->y[j]));
        others++;
    }
    const double step = fmin(c->x[i] - c->x[i - 1], c->x[i + 1] - c->x[i]),
                 bend = fabs(chord(c, i) - chord(c, i - 1));
    if (!(bend * step > ROUNDED * size))
        return 0;
    return others < LEAST_OTHERS ? -1 : own > CONTRAST * sqrt(sum / others);
}

/* ---- One spline -------------------------------------------------------------------- */

/* Second derivative at row i of the cubic through it and the next three rows on that side (1, -1);
 * of the parabola where the spline has three rows only. */
static double end_curvature(const curve *c, int i, int side, int rows)
{
    const double *x = c->x;
    const int a = i + side, b = a + side;
    const double first = curvature(c, a);

    if (rows < 4)
        return first;
    const double third = (curvature(c, b) - first) / (x[b + side] - x[i]);
    return first + third * ((x[i] - x[a]) + (x[i] - x[b]));
}

/* Slopes of the spline through rows first ... last.  Its second derivative is zero at the ends of
 * the table; at a corner it is that of the rows beside it. */
static rb_status set_slopes(curve *c, int first, int last, double *scratch)
{
    const int rows = last - first + 1;
    const double *x = c->x + first, from = x[0], length = x[rows - 1] - from;

    if (rows == 2) {
        c->behind[first] = c->before[last] = chord(c, first);
        return RB_OK;
    }
    const double at_first = first > 0 ? end_curvature(c, first, 1, rows) : 0.0,
                 at_last = last + 1 < c->n ? end_curvature(c, last, -1, rows) : 0.0,
                 growth = (at_last - at_first) / length;
    for (int k = 0; k < rows; k++) { /* less a cubic that has these two curvatures */
        const double t = x[k] - from;
        scratch[k] = c->y[first + k] - t * t * (0.5 * at_first + growth * t / 6.0);
    }
    gsl_spline *spline = gsl_spline_alloc(gsl_interp_cspline, (size_t)rows);
    if (!spline || gsl_spline_init(spline, x, scratch, (size_t)rows) != 0) {
        gsl_spline_free(spline);
        return RB_ENOMEM;
    }
    for (int k = 0; k < rows; k++) {
        const double t = x[k] - from;
        const double slope =
            gsl_spline_eval_deriv(spline, x[k], NULL) + t * (at_first + 0.5 * growth * t);
        if (k > 0)
            c->before[first + k] = slope;
        if (k + 1 < rows)
            c->behind[first + k] = slope;
    }
    gsl_spline_free(spline);
    return RB_OK;
}

/* The same of the monotone curve (Steffen, 1990) at the rows that are limited. */
static rb_status limit_slopes(curve *c, int first, int last)
{
    const int rows = last - first + 1;
    int limited = 0;

    for (int i = first; i <= last; i++)
        limited += c->is_limited[i];
    if (limited == 0 || rows < 3)
        return RB_OK;
    gsl_spline *monotone = gsl_spline_alloc(gsl_interp_steffen, (size_t)rows);
    if (!monotone || gsl_spline_init(monotone, c->x + first, c->y + first, (size_t)rows) != 0) {
        gsl_spline_free(monotone);
        return RB_ENOMEM;
    }
    for (int i = first; i <= last; i++) {
        const double slope = gsl_spline_eval_deriv(monotone, c->x[i], NULL);
        if (c->is_limited[i] && i > first)
            c->before[i] = slope;
        if (c->is_limited[i] && i < last)
            c->behind[i] = slope;
    }
    gsl_spline_free(monotone);
    return RB_OK;
}

static rb_status set_all_slopes(curve *c, double *scratch)
{
    rb_status s = RB_OK;

    for (int first = 0, last; first + 1 < c->n && s == RB_OK; first = last) {
        for (last = first + 1; last + 1 < c->n && !c->is_break[last];)
            last++;
        s = set_slopes(c, first, last, scratch);
        if (s == RB_OK)
            s = limit_slopes(c, first, last);
    }
    return s;
}

/* ---- Does it leave its points? ----------------------------------------------------- */

/* Hermite's cubic in interval i, t from 0 to 1. */
static double cubic(const curve *c, int i, double t)
{
    const double h = c->x[i + 1] - c->x[i], rise = c->y[i + 1] - c->y[i];
    const double a = h * c->behind[i] - rise, b = rise - h * c->before[i + 1];

    return c->y[i] + t * (rise + (1.0 - t) * (a * (1.0 - t) + b * t));
}

/* By how much the curve in interval i is above both of its points, or below both. */
static double beyond(const curve *c, int i)
{
    const double h = c->x[i + 1] - c->x[i], rise = c->y[i + 1] - c->y[i];
    const double a = h * c->behind[i] - rise, b = rise - h * c->before[i + 1];
    const double low = fmin(c->y[i], c->y[i + 1]), high = fmax(c->y[i], c->y[i + 1]);
    double t[2] = {-1.0, -1.0}, most = 0.0;

    /* where the derivative rise + a (1 - t)(1 - 3 t) + b t (2 - 3 t) vanishes */
    gsl_poly_solve_quadratic(3.0 * (a - b), 2.0 * b - 4.0 * a, rise + a, t, t + 1);
    for (int k = 0; k < 2; k++)
        if (t[k] > 0.0 && t[k] < 1.0)
            most = fmax(most, fmax(low - cubic(c, i, t[k]), cubic(c, i, t[k]) - high));
    return most;
}

static double range_around(const curve *c, int i)
{
    double low = c->y[i], high = low;

    for (int j = i; j >= 0 && j >= i - 2; j--) {
        low = fmin(low, c->y[j]);
        high = fmax(high, c->y[j]);
        if (c->is_break[j])
            break;
    }
    for (int j = i + 1; j < c->n && j <= i + 3; j++) {
        low = fmin(low, c->y[j]);
        high = fmax(high, c->y[j]);
        if (c->is_break[j])
            break;
    }
    return high - low;
}

/* Intervals beside rows of which nobody can say whether they are corners: a curve that turns there
 * would be invented. */
static int is_untold(const curve *c, int i)
{
    return c->is_untold[i] || c->is_untold[i + 1];
}

/* 1: the data may have an extremum between rows i and i + 1: they fall before it and rise behind
 * it, or the other way round.  Beyond the ends of the table nothing is known. */
static int may_turn(const curve *c, int i)
{
    if (c->is_break[i] || c->is_break[i + 1])
        return 0;
    return i == 0 || i + 2 == c->n || chord(c, i - 1) * chord(c, i + 1) < 0.0;
}

/* Breaks the spline at either end of intervals in which it leaves its points, or makes it monotone
 * there where it does so by little.  Returns the number of rows that are treated otherwise now.
 * todo: n, scratch. */
static int treat_swings(curve *c, int *todo)
{
    enum { NOTHING, LIMIT, BREAK };
    int changed = 0;

    for (int i = 0; i + 1 < c->n; i++) {
        const int turns = may_turn(c, i) && !is_untold(c, i);
        const double by = beyond(c, i), range = range_around(c, i);
        const double most = (turns ? MOST_BEYOND : MOST_BEYOND_MONOTONE) * range;
        todo[i] = by > most && range > 0.0          ? BREAK
                  : !turns && by > ROUNDING * range ? LIMIT
                                                    : NOTHING;
    }
    for (int i = 0; i + 1 < c->n; i++)
        for (int k = i; todo[i] != NOTHING && k <= i + 1; k++) {
            int *kind = todo[i] == BREAK ? c->is_break : c->is_limited;
            changed += !kind[k];
            kind[k] = 1;
        }
    return changed;
}

/* ---- The curve --------------------------------------------------------------------- */

rb_status rb_rolling_interpolant_create(int n, const double *x, const double *y, int is_smooth,
                                        rb_rolling_interpolant **interpolant)
{
    curve *c = calloc(1, sizeof *c);
    rb_arena scratch = {0};

    *interpolant = NULL;
    if (!c)
        return RB_ENOMEM;
    const size_t rows = (size_t)n;
    c->n = n;
    c->x = rb_arena_doubles(&c->memory, rows, 1);
    c->y = rb_arena_doubles(&c->memory, rows, 1);
    c->before = rb_arena_doubles(&c->memory, rows, 1);
    c->behind = rb_arena_doubles(&c->memory, rows, 1);
    c->corner = rb_arena_doubles(&c->memory, rows, 1);
    c->bend = rb_arena_doubles(&c->memory, rows, 1);
    c->is_break = rb_arena_ints(&c->memory, rows);
    c->is_limited = rb_arena_ints(&c->memory, rows);
    c->is_untold = rb_arena_ints(&c->memory, rows);
    double *values = rb_arena_doubles(&scratch, rows, 1);
    int *todo = rb_arena_ints(&scratch, rows);
    rb_status s = c->memory.failed || scratch.failed ? RB_ENOMEM : RB_OK;

    if (s == RB_OK) {
        memcpy(c->x, x, rows * sizeof *x);
        memcpy(c->y, y, rows * sizeof *y);
        for (int i = 1; i + 1 < n && !is_smooth; i++) {
            const int corner = has_corner(c, i);
            c->is_break[i] = corner > 0;
            c->is_untold[i] = corner < 0;
            c->untold += corner < 0;
        }
        s = set_all_slopes(c, values);
    }
    for (int k = 0; k < ROUNDS && s == RB_OK && !is_smooth && treat_swings(c, todo) > 0; k++)
        s = set_all_slopes(c, values);
    rb_arena_free(&scratch);
    if (s != RB_OK) {
        rb_rolling_interpolant_free(c);
        return s;
    }
    for (int i = 1; i + 1 < n; i++) {
        const double bend = c->behind[i] - c->before[i],
                     steep = fmax(fabs(chord(c, i - 1)), fabs(chord(c, i)));
        if (c->is_break[i] && fabs(bend) > VISIBLE * steep) {
            c->corner[c->corners] = x[i];
            c->bend[c->corners++] = bend;
        }
    }
    *interpolant = c;
    return RB_OK;
}

void rb_rolling_interpolant_free(rb_rolling_interpolant *c)
{
    if (c)
        rb_arena_free(&c->memory);
    free(c);
}

double rb_rolling_interpolant_at(const rb_rolling_interpolant *c, double x)
{
    if (x <= c->x[0])
        return c->y[0] + (x - c->x[0]) * c->behind[0];
    if (x >= c->x[c->n - 1])
        return c->y[c->n - 1] + (x - c->x[c->n - 1]) * c->before[c->n - 1];
    const int i = (int)gsl_interp_bsearch(c->x, x, 0, (size_t)c->n - 1);
    return cubic(c, i, (x - c->x[i]) / (c->x[i + 1] - c->x[i]));
}

int rb_rolling_interpolant_rows(const rb_rolling_interpolant *c, const double **x)
{
    *x = c->x;
    return c->n;
}

int rb_rolling_interpolant_corners(const rb_rolling_interpolant *c, const double **x,
                                   const double **bend)
{
    *x = c->corner;
    *bend = c->bend;
    return c->corners;
}

int rb_rolling_interpolant_untold(const rb_rolling_interpolant *c)
{
    return c->untold;
}
