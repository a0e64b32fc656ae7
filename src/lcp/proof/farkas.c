/* Absence by Farkas' lemma: 0 <= y'w = y'(M z + q) for all z and w of the sides, and a bound of the
 * right-hand side that is negative.  A coefficient (M'y)_j of a z_j without an upper bound must
 * not be positive: outward rounding never shows that of one that is zero, as they are for Lemke's
 * rays and for vertices of linear programs.  Such signs are computed without rounding for whole
 * numbers near a multiple of y, or y is enclosed as the solution of these equations. */
#include "lcp/proof/farkas.h"
#include "lcp/lemke/lemke.h"
#include "lcp/proof/bounds.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What has a wrong sign below this part of its terms may have it by rounding. */
static const double ROUNDING = 1e-9;

typedef struct {
    double least, most;
} interval;

int rb_lcp_is_place(const double *lower, const double *upper, int i, lcp_side at)
{
    const double low = rb_lcp_lower(lower, i), high = rb_lcp_upper(upper, i);
    return at == LCP_AT_LOWER   ? isfinite(low)
           : at == LCP_AT_UPPER ? isfinite(high) && high > low
                                : high > low;
}

/* Where y_i may lie: y_i w_i >= 0 for every w_i that side and bounds allow. */
static interval of_multiplier(lcp_side side, double low, double high)
{
    if (low == high || side == LCP_LEFT_OUT)
        return (interval){0.0, 0.0};
    if (side == LCP_BETWEEN)
        return (interval){-INFINITY, INFINITY};
    /* w_i >= 0 at a lower bound wants y_i >= 0, w_i <= 0 at an upper one y_i <= 0; between its
     * bounds w_i = 0, and any y_i does. */
    const int at_lower = side == LCP_AT_LOWER || (side == LCP_OPEN && isfinite(low));
    const int at_upper = side == LCP_AT_UPPER || (side == LCP_OPEN && isfinite(high));
    return (interval){at_upper && !at_lower ? -INFINITY
                      : at_lower            ? 0.0
                                            : -INFINITY,
                      at_lower && !at_upper ? INFINITY
                      : at_upper            ? 0.0
                                            : INFINITY};
}

double rb_lcp_multiplier(lcp_side side, double low, double high, double y)
{
    const interval may = of_multiplier(side, low, high);
    return fmin(fmax(y, may.least), may.most);
}

/* ---- Bounds ------------------------------------------------------------------------ */

/* Whose absence is asked for: of w = M z + q with the signs of `side`, z within bounds.  most: n,
 * |z_j| <= most_j is known of every solution; NULL: nothing is. */
typedef struct {
    const lcp_matrix *M;
    const double *q, *lower, *upper;
    const lcp_side *side;
    const double *most;
} farkas;

/* A sum that is to be bounded: of so many terms, with what their own errors come to. */
typedef struct {
    double value, size, error;
    size_t terms;
} upper_sum;

static void add_product(upper_sum *s, double a, double b, double error)
{
    s->value += a * b;
    s->size += fabs(a * b);
    s->error = proof_up(4, s->error + error);
    s->terms++;
}

/* (M'y)_j with its error, also of y within radius (n, or NULL); 0: it has no terms.  a, b: the
 * terms, n each. */
static size_t coefficient(const lcp_matrix *M, int j, const double *y, const double *radius,
                          double *a, double *b, double *value, double *error)
{
    const lcp_column column = rb_lcp_column(M, j);
    size_t count = 0;
    proof_dot sum = {0};
    double unknown = 0.0;
    for (int k = 0; k < column.count; k++) {
        const int i = column.row ? column.row[k] : k;
        if (column.x[k] == 0.0 || y[i] == 0.0)
            continue;
        a[count] = column.x[k];
        b[count++] = y[i];
        proof_add(&sum, column.x[k], y[i]);
        unknown += radius ? fabs(column.x[k]) * radius[i] : 0.0;
    }
    *value = *error = 0.0;
    if (count)
        *value = proof_value(&sum, count, error);
    *error = proof_up(4, *error + proof_up(count, unknown));
    return count;
}

/* As rb_proof_least_sum, for some y in a box: within radius of y, where the coefficients that
 * is_zero names are exactly zero (n each, or NULL: y itself). */
static double least_sum(const farkas *p, const double *y, const double *radius, const int *is_zero)
{
    const int n = p->M->n;
    const size_t order = (size_t)n;
    double *own = rb_alloc(order, 3), *a = own + order, *b = a + order, steepest = 0.0;
    upper_sum sum = {0};
    int useful = own != NULL;
    for (int i = 0; useful && i < n; i++) { /* y_i w_i >= 0 */
        const double low = rb_lcp_lower(p->lower, i), high = rb_lcp_upper(p->upper, i);
        const lcp_side at = p->side ? p->side[i] : LCP_OPEN;
        own[i] = rb_lcp_multiplier(at, low, high, y[i]);
        if (radius && y[i] != 0.0)
            useful &= rb_lcp_multiplier(at, low, high, y[i] - radius[i]) == y[i] - radius[i] &&
                      rb_lcp_multiplier(at, low, high, y[i] + radius[i]) == y[i] + radius[i];
        if (own[i] != 0.0)
            add_product(&sum, own[i], p->q[i], radius ? radius[i] * fabs(p->q[i]) : 0.0);
    }
    for (int j = 0; useful && j < n; j++) {
        const lcp_side at = p->side ? p->side[j] : LCP_OPEN;
        /* The interval of z_j by its side, and by what is known of every solution. */
        double low = at == LCP_AT_UPPER ? rb_lcp_upper(p->upper, j) : rb_lcp_lower(p->lower, j),
               high = at == LCP_AT_LOWER || at == LCP_LEFT_OUT ? low : rb_lcp_upper(p->upper, j), c,
               error;
        if (p->most) {
            low = fmax(low, -p->most[j]);
            high = fmin(high, p->most[j]);
        }
        const size_t terms =
            is_zero && is_zero[j] ? 0 : coefficient(p->M, j, own, radius, a, b, &c, &error);
        if (terms == 0)
            continue;
        if (isfinite(low) && isfinite(high)) /* at the end that makes the sum larger */
            add_product(&sum, c, c > 0.0 ? high : low, error * fmax(fabs(low), fabs(high)));
        else {
            /* An infinite end of z_j: only the sign of the coefficient counts, which has to be
             * certain. */
            const int sign = c - error > 0.0   ? 1
                             : c + error < 0.0 ? -1
                             : radius          ? RB_SIGN_UNKNOWN
                                               : rb_exact_sign(terms, a, b);
            if (isinf(low))
                useful = sign == 0 || (isfinite(high) && sign == 1);
            else if (sign != 0 && sign != -1)
                steepest = fmax(steepest, proof_up(4, c + error));
            if (sign != 0 && isfinite(isinf(low) ? high : low))
                add_product(&sum, c, isinf(low) ? high : low,
                            error * fabs(isinf(low) ? high : low));
        }
    }
    /* 0 <= value + steepest sum (z - lower) */
    const double gain =
        -(sum.value + proof_up(8, sum.error) + proof_error(sum.terms + 4, sum.size));
    free(own);
    if (!useful || !(gain > 0.0) || isnan(steepest))
        return 0.0;
    return steepest > 0.0 ? gain / steepest * (1.0 - 8.0 * PROOF_U) : INFINITY;
}

double rb_proof_least_sum(const lcp_matrix *M, const double *q, const double *lower,
                          const double *upper, const lcp_side *side, const double *most,
                          const double *y)
{
    const farkas p = {M, q, lower, upper, side, most};
    return least_sum(&p, y, NULL, NULL);
}

int rb_proof_nearly_whole(size_t n, const double *y, int by, double *rounded)
{
    const double most = rb_norm_inf(n, y);
    double off = most > 0.0 ? 0.0 : INFINITY;
    for (size_t i = 0; i < n; i++) {
        const double x = y[i] / most * (by ? by : 1.0), whole = by ? round(x) : x;
        off = fmax(off, fabs(x - whole));
        rounded[i] = whole;
    }
    return off <= 1e-5;
}

/* ---- Certainty --------------------------------------------------------------------- */

/* A number by which all y_i/max |y| become nearly whole, by the denominators of their continued
 * fractions; 0: there is none so small. */
static int common_multiple(size_t n, const double *y)
{
    static const double most = 1e6, within = 1e-7;
    const double size = rb_norm_inf(n, y);
    double by = 1.0;
    for (size_t i = 0; i < n && by <= most; i++) {
        /* Continued fraction of y_i times the number so far: its denominators are those of the best
         * approximations. */
        double rest = y[i] / size * by, before = 0.0, denominator = 1.0;
        const double x = rest;
        while (fabs(x * denominator - round(x * denominator)) > within &&
               by * denominator <= most) {
            rest = 1.0 / (rest - floor(rest));
            const double next = floor(rest) * denominator + before;
            before = denominator;
            denominator = next;
        }
        by *= denominator;
    }
    return by <= most ? (int)by : 0;
}

/* Rows with y_i != 0, and columns whose coefficient must vanish. */
typedef struct {
    int rows, columns, *row, *column, *is_zero;
} equations;

static equations find_equations(const farkas *p, const double *y, int *memory)
{
    static const double vanishes = 1e-11;
    /* Unknowns are the y_i that are not zero; equations, that the coefficients vanish which have
     * to. */
    const int n = p->M->n;
    equations e = {.row = memory, .column = memory + n, .is_zero = memory + 2 * n};
    for (int i = 0; i < n; i++)
        if (y[i] != 0.0)
            e.row[e.rows++] = i;
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(p->M, j);
        const lcp_side at = p->side ? p->side[j] : LCP_OPEN;
        double c = 0.0, size = 0.0;
        for (int k = 0; k < a.count; k++) {
            c += a.x[k] * y[a.row ? a.row[k] : k];
            size += fabs(a.x[k] * y[a.row ? a.row[k] : k]);
        }
        e.is_zero[j] = at != LCP_AT_LOWER && at != LCP_AT_UPPER && at != LCP_LEFT_OUT &&
                       (isinf(rb_lcp_upper(p->upper, j)) || isinf(rb_lcp_lower(p->lower, j))) &&
                       size > 0.0 && fabs(c) <= vanishes * size;
        if (e.is_zero[j])
            e.column[e.columns++] = j;
    }
    return e;
}

/* The block of M of these rows and columns, by rows of M. */
static void copy_block(const lcp_matrix *M, const equations *e, double *dense, int *place)
{
    for (int i = 0; i < M->n; i++)
        place[i] = -1;
    for (int i = 0; i < e->rows; i++)
        place[e->row[i]] = i;
    memset(dense, 0, (size_t)e->rows * (size_t)e->columns * sizeof *dense);
    for (int j = 0; j < e->columns; j++) {
        const lcp_column a = rb_lcp_column(M, e->column[j]);
        for (int k = 0; k < a.count; k++) {
            const int at = place[a.row ? a.row[k] : k];
            if (at >= 0)
                dense[(size_t)at + (size_t)j * (size_t)e->rows] = a.x[k];
        }
    }
}

/* Puts rows in front that are independent (order: e->rows; swap_of: e->columns).  0: LAPACK finds
 * too few. */
static int choose_rows(const equations *e, double *block, int *swap_of, int *order)
{
    if (LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, e->rows, e->columns, block, e->rows, swap_of) != 0)
        return 0;
    for (int i = 0; i < e->rows; i++)
        order[i] = i;
    for (int k = 0; k < e->columns; k++) {
        const int other = swap_of[k] - 1, kept = order[k];
        order[k] = order[other];
        order[other] = kept;
    }
    return 1;
}

/* 1: near y there is a solution of the equations that excludes all z: of the rows that LAPACK
 * chooses as that of a linear system with bounds, with the others as they are. */
static int encloses(const farkas *p, const double *y)
{
    const size_t n = (size_t)p->M->n;
    rb_arena memory = {0};
    int *whole = rb_arena_ints(&memory, 6 * n), *place = whole + 3 * n, *order = place + n,
        *swap_of = order + n, yes = 0;
    double *block = rb_arena_doubles(&memory, n, n), *own = rb_arena_doubles(&memory, n, 6),
           *radius = own + n, *b = radius + n, *unknown = b + n, *x = unknown + n, *off = x + n;
    if (memory.failed)
        return (int)rb_arena_done(&memory, RB_OK);
    const equations e = find_equations(p, y, whole);
    const size_t k = (size_t)e.columns, rows = (size_t)e.rows;
    if (e.columns > 0 && e.columns < e.rows) {
        copy_block(p->M, &e, block, place);
        yes = choose_rows(&e, block, swap_of, order);
        copy_block(p->M, &e, block, place);
    }
    /* k equations for k of the y_i, the other ones as they are: a regular linear system, whose
     * solution has proved bounds. */
    double *A = yes ? malloc(k * k * sizeof *A) : NULL;
    for (size_t j = 0; A && j < k; j++) {
        proof_dot sum = {0};
        for (size_t i = 0; i < rows; i++) {
            const double a = block[(size_t)order[i] + j * rows];
            if (i < k)
                A[j + i * k] = a;
            else
                proof_add(&sum, a, y[e.row[order[i]]]);
        }
        b[j] = proof_value(&sum, rows, unknown + j);
    }
    proof_inverse inverse = {0};
    yes = A && rb_proof_inverse(e.columns, A, 0.0, &inverse) && inverse.norm < 0.99;
    if (yes) {
        rb_proof_solve(&inverse, b, unknown, 1, x, off);
        memcpy(own, y, n * sizeof *own);
        for (size_t i = 0; i < k; i++) {
            own[e.row[order[i]]] = x[i];
            radius[e.row[order[i]]] = off[i];
        }
        yes = isinf(least_sum(p, own, radius, e.is_zero));
    }
    rb_proof_inverse_free(&inverse);
    rb_arena_free(&memory);
    return yes;
}

/* 1: y, whole numbers near a multiple of it, or some y near it exclude all z with certainty. */
static int is_certain(const farkas *p, const double *y)
{
    if (!rb_proof_arithmetic())
        return 0;
    const size_t n = (size_t)p->M->n;
    const int multiple = common_multiple(n, y);
    double *rounded = rb_alloc(n, 1);
    int yes = 0;
    for (int by = 0; rounded && !yes && by <= PROOF_MULTIPLES + 1; by++)
        if (rb_proof_nearly_whole(n, y, by <= PROOF_MULTIPLES ? by : multiple, rounded))
            yes = isinf(least_sum(p, rounded, NULL, NULL));
    free(rounded);
    return yes || encloses(p, y);
}

/* ---- The question ------------------------------------------------------------------ */

/* First in plain arithmetic, which is fast and mostly says no; only then with certainty. */
int rb_lcp_excludes(const lcp_matrix *M, const double *q, const double *lower, const double *upper,
                    const lcp_side *side, double *y)
{
    const int n = M->n;
    const double most = rb_norm_inf((size_t)n, y);
    double value = 0.0, terms = 0.0;
    for (int i = 0; i < n; i++) {
        const interval own = of_multiplier(side ? side[i] : LCP_OPEN, rb_lcp_lower(lower, i),
                                           rb_lcp_upper(upper, i));
        const double x = fmin(fmax(y[i], own.least), own.most);
        if (!(fabs(x - y[i]) <= ROUNDING * most))
            return 0;
        y[i] = x;
        value += q[i] * x;
        terms += fabs(q[i] * x);
    }
    /* y'w = y'q + c'z with c = M'y: the largest that it comes to within the bounds. */
    for (int j = 0; j < n; j++) {
        const lcp_column a = rb_lcp_column(M, j);
        const lcp_side at = side ? side[j] : LCP_OPEN;
        const double low = rb_lcp_lower(lower, j), high = rb_lcp_upper(upper, j);
        double c = 0.0, size = 0.0;
        for (int k = 0; k < a.count; k++) {
            c += a.x[k] * y[a.row ? a.row[k] : k];
            size += fabs(a.x[k]);
        }
        const double z = at == LCP_AT_LOWER || at == LCP_LEFT_OUT ? low
                         : at == LCP_AT_UPPER                     ? high
                         : c > 0.0                                ? high
                                                                  : low;
        if (c == 0.0 || z == 0.0)
            continue;
        if (!isinf(z)) {
            value += c * z;
            terms += fabs(c * z);
        } else if (!(fabs(c) <= ROUNDING * most * size))
            return 0;
    }
    const farkas p = {M, q, lower, upper, side, NULL};
    return value < -(4.0 + n) * DBL_EPSILON * terms && is_certain(&p, y);
}
