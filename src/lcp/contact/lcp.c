/* The LCP of the contact problem: the pivoted form (K5), with the rows and columns that a
 * given load and a given force (K6) and a layer that yields (Y1) add to it, and Kwak's
 * (K4), which is a principal pivot of all that. */
#include "lcp/contact/lcp_order.h"

#include <cblas.h>

void rb_contact_lcp_free(rb_contact_lcp *lcp)
{
    rb_arena_free(&lcp->memory);
    *lcp = (rb_contact_lcp){0};
}

/* n x n, column-major. */
typedef struct {
    const double *x;
    int ld;
} operand;

static void add_block(int n, double factor, operand A, double *M, int ldm)
{
    for (int j = 0; j < n; j++)
        cblas_daxpy(n, factor, A.x + (size_t)j * A.ld, 1, M + (size_t)j * ldm, 1);
}

/* The same with column j times bound_j. */
static void add_bounded(int n, double factor, const double *bound, operand A, double *M, int ldm)
{
    for (int j = 0; j < n; j++)
        cblas_daxpy(n, factor * bound[j], A.x + (size_t)j * A.ld, 1, M + (size_t)j * ldm, 1);
}

static void add_diagonal(int n, double value, double *M, int ldm)
{
    for (int i = 0; i < n; i++)
        M[i + (size_t)i * ldm] += value;
}

/* +1 in its own direction of sliding, -1 mirrored. */
static double orientation(const rb_contact_lcp *lcp)
{
    return lcp->mirrored ? -1.0 : 1.0;
}

/* xi = xi0 + s xi', s = -sgn xi0: from full sliding back towards the given force. */
static double xi_direction(const rb_contact_lcp *lcp)
{
    return lcp->xi0 > 0.0 ? -1.0 : 1.0;
}

/* An equation of the border (K6): sign (a_N'r_N + a_T'r_T - value) = 0. */
typedef struct {
    int row;
    double sign;
    const double *a_N, *a_T;
    double value;
} border_row;

/* ---- Pivoted form (K5) ------------------------------------------------------------- */

static void pivoted_border(const rb_contact_problem *p, border_row e, rb_contact_lcp *lcp)
{
    const double o = orientation(lcp);

    for (int j = 0; j < p->n; j++) {
        lcp->M[e.row + (size_t)j * lcp->size] = e.sign * (e.a_N[j] - o * p->bound[j] * e.a_T[j]);
        lcp->M[e.row + (size_t)(p->n + j) * lcp->size] = e.sign * o * e.a_T[j];
    }
    lcp->b[e.row] = -e.sign * e.value;
}

/* z = (r_N, gamma, nu), w = (y_N, l, mu r_N - o r_T), o the orientation:
 * gamma = mu r_N + o r_T, l - nu = o T_T lambda.  force_N, force_T (n): row of the given
 * force. */
static void pivoted_form(const rb_contact_problem *p, const double *force_N, const double *force_T,
                         rb_contact_lcp *lcp)
{
    const int n = p->n, ld = lcp->size;
    const double o = orientation(lcp);
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    const operand F_NN = {K.F, K.ldf}, F_NT = {K.F + (size_t)n * K.ldf, K.ldf}, S_N = {K.S, n},
                  S_T = {K.S + (size_t)n * n, n};
    double *r_N = lcp->M, *gamma = lcp->M + (size_t)n * ld, *nu = gamma + (size_t)n * ld;

    /* Gap (K1) with r_T = o (gamma - mu r_N) put in: y_N = d_N + (F_NN - o F_NT mu) r_N + o F_NT
     * gamma. */
    add_block(n, 1.0, F_NN, r_N, ld);
    add_bounded(n, -o, p->bound, F_NT, r_N, ld);
    add_block(n, o, F_NT, gamma, ld);
    /* Slip (K2), S = A [F_TN F_TT]: l = o d_T + (o S_N - S_T mu) r_N + S_T gamma + nu. */
    add_block(n, o, S_N, r_N + n, ld);
    add_bounded(n, -1.0, p->bound, S_T, r_N + n, ld);
    add_block(n, 1.0, S_T, gamma + n, ld);
    add_diagonal(n, 1.0, nu + n, ld);
    /* Coulomb (K3) on the other side of the cone: mu r_N - o r_T = 2 mu r_N - gamma. */
    for (int i = 0; i < n; i++)
        r_N[2 * n + i + (size_t)i * ld] += 2.0 * p->bound[i];
    add_diagonal(n, -1.0, gamma + 2 * n, ld);
    /* The right-hand side: gaps of the undeformed bodies, and the slip that the rolling or the
     * shift imposes, d_T + xi e_T. */
    for (int i = 0; i < n; i++) {
        lcp->b[i] = p->d_N[i];
        lcp->b[n + i] = o * (p->d_T[i] + (p->force_given ? lcp->xi0 : p->xi) * p->e_T[i]);
    }
    /* (K6) A given force makes xi an unknown with a column of its own; a given load and a given
     * force have a row each. */
    if (p->force_given)
        cblas_daxpy(n, o * xi_direction(lcp), p->e_T, 1,
                    lcp->M + (size_t)rb_contact_xi_column(p) * ld + n, 1);
    if (p->load_given)
        pivoted_border(
            p, (border_row){rb_contact_delta_column(p), 1.0, p->load_N, p->load_T, p->load}, lcp);
    if (p->force_given)
        pivoted_border(
            p,
            (border_row){rb_contact_xi_column(p), -xi_direction(lcp), force_N, force_T, p->force},
            lcp);
}

/* ---- Both -------------------------------------------------------------------------- */

static void fill(int n, double value, double *x)
{
    for (int i = 0; i < n; i++)
        x[i] = value;
}

/* Dimensionless unknowns: stress, mu stress and two lengths (4.4). */
static void make_dimensionless(const rb_contact_problem *p, rb_contact_lcp *lcp)
{
    const int n = p->n, delta = rb_contact_delta_column(p), xi = rb_contact_xi_column(p);
    const size_t length = (size_t)n, ld = (size_t)lcp->size;
    const double bound = rb_contact_friction_scale(p);

    fill(n, p->stress, lcp->z_scale);
    fill(delta - n, p->slip_length, lcp->z_scale + n);
    fill(n, p->gap_length, lcp->w_scale);
    fill(delta - n, bound, lcp->w_scale + n);
    if (lcp->form == RB_LCP_PIVOTED) {
        fill(n, bound, lcp->z_scale + n);
        fill(n, p->slip_length, lcp->w_scale + n);
    }
    if (p->load_given) {
        lcp->z_scale[delta] = p->gap_length;
        lcp->w_scale[delta] = p->stress * rb_norm_1(length, p->load_N, 1);
    }
    if (p->force_given) {
        lcp->z_scale[xi] = p->slip_length / (rb_norm_1(length, p->e_T, 1) / n);
        lcp->w_scale[xi] = bound * rb_norm_1(length, p->force_T, 1);
    }
    for (size_t j = 0; j < ld; j++)
        for (size_t i = 0; i < ld; i++)
            lcp->M[i + j * ld] *= lcp->z_scale[j] / lcp->w_scale[i];
    for (size_t i = 0; i < ld; i++)
        lcp->b[i] /= lcp->w_scale[i];
}

/* Pivoted form (K5) with its border (K6), the layer that yields (Y1), Kwak's form (K4) by a
 * principal pivot of all that, the datum of the approach, and units of the contact. */
rb_status rb_contact_lcp_create(const rb_contact_problem *p, rb_contact_lcp_form form, int mirrored,
                                double xi0, rb_contact_lcp *lcp, rb_message *why)
{
    const size_t n = (size_t)p->n,
                 size = (size_t)(rb_contact_delta_column(p) + p->load_given + p->force_given);
    rb_arena scratch = {0};

    *lcp = (rb_contact_lcp){.size = (int)size,
                            .form = form,
                            .yields = p->yield != NULL,
                            .mirrored = form == RB_LCP_PIVOTED && mirrored,
                            .xi0 = xi0};
    if (!rb_contact_operator_matrix(p->op).F)
        return rb_fail(why, RB_EINVAL, "%d contact elements are too many for an LCP", p->n);
    lcp->M = rb_arena_doubles(&lcp->memory, size, size);
    lcp->b = rb_arena_doubles(&lcp->memory, size, 1);
    lcp->z_scale = rb_arena_doubles(&lcp->memory, size, 1);
    lcp->w_scale = rb_arena_doubles(&lcp->memory, size, 1);
    double *force_N = rb_arena_doubles(&scratch, n, 1), *force_T = rb_arena_doubles(&scratch, n, 1);
    rb_status s = lcp->memory.failed || scratch.failed ? RB_ENOMEM : RB_OK;
    if (s == RB_OK) {
        rb_contact_force_row(p, force_N, force_T);
        pivoted_form(p, force_N, force_T, lcp);
    }
    if (s == RB_OK && p->yield)
        rb_contact_lcp_add_yield(p, lcp);
    if (s == RB_OK && form == RB_LCP_KWAK)
        s = rb_contact_kwak_form(p, lcp);
    rb_arena_free(&scratch);
    if (s != RB_OK) {
        rb_contact_lcp_free(lcp);
        return rb_fail(why, s, "LCP of %d contact elements: %s", p->n, rb_status_text(s));
    }
    /* The approach enters every gap; where it is unknown, delta = delta0 + delta' starts below the
     * first touch, also for a half-plane whose datum is close to the surface. */
    double lowest = p->d_N[0];
    for (size_t i = 1; i < n; i++)
        lowest = fmin(lowest, p->d_N[i]);
    lcp->delta0 = p->load_given ? lowest - 10.0 * p->gap_length : p->delta;
    for (size_t i = 0; i < n; i++) {
        lcp->b[i] -= lcp->delta0;
        if (p->load_given)
            lcp->M[i + (size_t)rb_contact_delta_column(p) * size] = -1.0;
    }
    make_dimensionless(p, lcp);
    return RB_OK;
}

/* From z back to tractions and motion: p = r_N, q = r_T = o (gamma - mu r_N) (K3), delta and xi by
 * (K6), the plastic slip by (Y1). */
void rb_contact_lcp_recover(const rb_contact_problem *p, const rb_contact_lcp *lcp, const double *z,
                            rb_contact_state *state)
{
    const int n = p->n;

    state->delta = lcp->delta0;
    if (p->load_given)
        state->delta += lcp->z_scale[rb_contact_delta_column(p)] * z[rb_contact_delta_column(p)];
    state->xi = p->xi;
    if (p->force_given)
        state->xi = lcp->xi0 + xi_direction(lcp) * lcp->z_scale[rb_contact_xi_column(p)] *
                                   z[rb_contact_xi_column(p)];
    for (int i = 0; i < n; i++) {
        /* gamma: an unknown of the pivoted form, a row w = M z + b of Kwak's */
        int plus = rb_contact_yield_index(p, i, 0), minus = rb_contact_yield_index(p, i, 1);
        double gamma = lcp->z_scale[n + i] * z[n + i];
        if (lcp->form == RB_LCP_KWAK) {
            const int row = rb_contact_kwak_place(p, n + i);
            gamma = lcp->w_scale[row] *
                    (cblas_ddot(lcp->size, lcp->M + row, lcp->size, z, 1) + lcp->b[row]);
            plus = rb_contact_kwak_place(p, plus);
            minus = rb_contact_kwak_place(p, minus);
        }
        state->p[i] = lcp->z_scale[i] * z[i];
        state->plastic[i] =
            p->yield ? orientation(lcp) * p->slip_length * (z[plus] - z[minus]) : 0.0;
        state->q[i] = orientation(lcp) * (gamma - p->bound[i] * state->p[i]);
    }
    state->lcp_form = lcp->form;
}
