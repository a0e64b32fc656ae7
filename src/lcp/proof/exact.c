/* Whether the point of a basis solves a problem as its numbers stand: z and w are enclosed as in
 * docs/proof.md, and where an enclosure holds zero residues tell whether the number is zero. */
#include "lcp/proof/exact.h"
#include "lcp/proof/bounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* z = point->z + correction, within `off`: n each, zero where z is not solved for. */
typedef struct {
    const lcp_point *point;
    const double *correction, *off;
    unsigned char *zeros;
    int has_zeros; /* they were computed */
} enclosed;

/* 1, 0, -1, or RB_SIGN_UNKNOWN: of a number within `error` of value, which is zero if the residue
 * of i has the bit. */
static int sign_of(enclosed *e, double value, double error, int i, int bit)
{
    if (fabs(value) > error)
        return value > 0.0 ? 1 : -1;
    if (!e->has_zeros)
        rb_lcp_zeros(e->point, e->zeros);
    e->has_zeros = 1;
    return e->zeros[i] & bit ? 0 : RB_SIGN_UNKNOWN;
}

/* Of z_i - bound. */
static int sign_of_z(enclosed *e, int i, double bound, int bit)
{
    if (isinf(bound))
        return bound > 0.0 ? -1 : 1;
    proof_dot sum = {e->point->z[i], 0.0, fabs(e->point->z[i])};
    double error;
    proof_add(&sum, -bound, 1.0);
    proof_add(&sum, e->correction[i], 1.0);
    const double value = proof_value(&sum, 3, &error);
    return sign_of(e, value, proof_up(2, error + e->off[i]), i, bit);
}

/* w_i = M z + q and the bound of its error. */
static double enclosed_row(const lcp_point *point, const double *correction, const double *off,
                           int i, double *error)
{
    const rb_lcp_problem *p = point->p;
    proof_dot sum = {p->q[i], 0.0, fabs(p->q[i])};
    double unknown = 0.0;
    for (int j = 0; j < p->n; j++) {
        const double a = p->M[(size_t)i + (size_t)j * (size_t)p->ldm];
        proof_add(&sum, a, point->z[j]);
        if (correction) {
            proof_add(&sum, a, correction[j]);
            unknown += fabs(a) * off[j];
        }
    }
    const double value = proof_value(&sum, 2 * (size_t)p->n + 1, error);
    *error = sum.size > 0.0 ? proof_up(2, *error + proof_up((size_t)p->n, unknown)) : 0.0;
    return value;
}

/* 1: w_i may have this sign on this side. */
static int may_be(lcp_side side, int is_fixed, int sign)
{
    return side == LCP_LEFT_OUT || is_fixed || sign == 0 ||
           (sign > 0 ? side == LCP_AT_LOWER : side == LCP_AT_UPPER);
}

/* Of all numbers of an enclosed point. */
static rb_status look_at_signs(enclosed *e, const lcp_side *side)
{
    const lcp_point *point = e->point;
    const int n = point->p->n;
    rb_status s = RB_OK;
    for (int c = 0; c < point->m; c++) {
        const int i = point->column[c];
        const int above = sign_of_z(e, i, rb_lcp_lower(point->lower, i), LCP_Z_IS_LOWER);
        const int below = sign_of_z(e, i, rb_lcp_upper(point->upper, i), LCP_Z_IS_UPPER);
        if (above == -1 || below == 1)
            return RB_NO_SOLUTION;
        s = above == RB_SIGN_UNKNOWN || below == RB_SIGN_UNKNOWN ? RB_UNDECIDED : s;
    }
    for (int i = 0; i < n; i++) {
        int solved_for = 0;
        for (int r = 0; r < point->m; r++)
            solved_for |= point->row[r] == i;
        if (solved_for)
            continue;
        double error;
        const double w = enclosed_row(point, e->correction, e->off, i, &error);
        const int sign = w == 0.0 && error == 0.0 ? 0 : sign_of(e, w, error, i, LCP_W_IS_ZERO);
        const int fixed = rb_lcp_lower(point->lower, i) >= rb_lcp_upper(point->upper, i);
        if (sign == RB_SIGN_UNKNOWN)
            s = may_be(side[i], fixed, 1) && may_be(side[i], fixed, -1) ? s : RB_UNDECIDED;
        else if (!may_be(side[i], fixed, sign))
            return RB_NO_SOLUTION;
    }
    return s;
}

rb_status rb_lcp_is_exact(const lcp_point *point, const lcp_side *side, unsigned char *zeros)
{
    const rb_lcp_problem *p = point->p;
    const size_t n = (size_t)p->n, m = (size_t)point->m;
    rb_arena memory = {0};
    double *correction = rb_arena_doubles(&memory, n, 6), *off = correction + n, *b = off + n,
           *radius = b + n, *x = radius + n, *within = x + n;
    double *A = malloc((m ? m * m : 1) * sizeof *A);
    proof_inverse inverse = {0};
    rb_status s = !A || memory.failed ? RB_ENOMEM : rb_proof_arithmetic() ? RB_OK : RB_UNDECIDED;
    if (s != RB_OK) {
        free(A);
        return rb_arena_done(&memory, s);
    }
    for (size_t r = 0; r < m; r++) {
        const int i = point->row[r];
        b[r] = enclosed_row(point, NULL, NULL, i, radius + r);
        for (size_t c = 0; c < m; c++)
            A[r + c * m] = p->M[(size_t)i + (size_t)point->column[c] * (size_t)p->ldm];
    }
    s = rb_proof_inverse(point->m, A, 0.0, &inverse) ? RB_OK : RB_ENOMEM;
    if (s == RB_OK && !(inverse.norm < 0.99))
        s = RB_UNDECIDED;
    if (s == RB_OK) {
        enclosed e = {point, correction, off, zeros, 0};
        memset(correction, 0, 2 * n * sizeof *correction);
        for (int fine = PROOF_FINE;
             fine == PROOF_FINE || (fine == PROOF_FINEST && s == RB_UNDECIDED); fine++) {
            rb_proof_solve(&inverse, b, radius, fine, x, within);
            for (size_t c = 0; c < m; c++) {
                correction[point->column[c]] = x[c];
                off[point->column[c]] = within[c];
            }
            s = look_at_signs(&e, side);
        }
        if (s == RB_OK && !e.has_zeros)
            rb_lcp_zeros(point, zeros);
        for (int c = 0; s == RB_OK && c < point->m; c++) {
            const int i = point->column[c];
            point->z[i] = zeros[i] & LCP_Z_IS_LOWER   ? rb_lcp_lower(point->lower, i)
                          : zeros[i] & LCP_Z_IS_UPPER ? rb_lcp_upper(point->upper, i)
                                                      : point->z[i] + correction[i];
        }
    }
    rb_proof_inverse_free(&inverse);
    return rb_arena_done(&memory, s);
}
