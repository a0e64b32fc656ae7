/* Contact of the faces (C3): one step of a history (C6), with trapped fluid as one more
 * row of the LCP (C7), and stress intensities (C8). */
#include "analysis/crack/internal.h"

#include "lcp/lcp.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The contact problem ----------------------------------------------------------- */

rb_status rb_crack_contact_alloc(const rb_crack *c, int m, rb_crack_contact *k)
{
    const size_t n = (size_t)(m + c->n);
    memset(k, 0, sizeof *k);
    k->n = (int)n;
    k->m = m;
    k->F = rb_alloc(2 * n, 2 * n);
    k->scale = rb_alloc(n, 5);
    k->gap = k->scale + n;
    k->slip = k->gap + n;
    k->scratch = k->slip + n;
    return k->F && k->scale ? rb_contact_state_alloc(k->n, &k->state) : RB_ENOMEM;
}

void rb_crack_contact_free(rb_crack_contact *k)
{
    rb_contact_problem_free(&k->problem);
    rb_contact_state_free(&k->state);
    free(k->F);
    free(k->scale);
    memset(k, 0, sizeof *k);
}

rb_status rb_crack_contact_pose(const rb_crack *c, rb_crack_contact *k)
{
    const size_t n = (size_t)k->n, m = 2 * n;
    rb_contact_operator *op = NULL;
    double *S = rb_alloc(n, m);
    if (!S)
        return RB_ENOMEM;
    for (size_t j = 0; j < n; j++)
        k->scale[j] = 1.0 / sqrt(k->F[j + j * m]);
    for (size_t j = 0; j < m; j++)
        for (size_t i = 0; i < m; i++)
            k->F[i + j * m] *= k->scale[i % n] * k->scale[j % n];
    for (size_t j = 0; j < m; j++)
        memcpy(S + j * n, k->F + n + j * m, n * sizeof *S);
    rb_contact_problem_free(&k->problem);
    rb_status s = rb_contact_operator_dense(k->n, k->F, (int)m, S, &op);
    if (s == RB_OK)
        s = rb_contact_problem_alloc(op, &k->problem);
    for (int j = 0; j < k->n; j++) /* a wheel has no friction */
        k->scratch[j] = j < k->m ? 0.0 : c->shape.friction;
    if (s == RB_OK)
        rb_contact_set_friction(&k->problem, c->shape.friction, k->scratch);
    return s;
}

void rb_crack_contact_load(const rb_crack *c, const double *T, double pressure, double size,
                           const rb_crack_state *before, rb_crack_contact *k)
{
    rb_contact_problem *p = &k->problem;
    memset(k->scratch, 0, 2 * (size_t)k->n * sizeof *k->scratch);
    memset(p->d_N, 0, (size_t)k->n * sizeof *p->d_N);
    memset(p->d_T, 0, (size_t)k->n * sizeof *p->d_T);
    for (int j = 0; j < c->n; j++) {
        const int i = k->m + j;
        k->scratch[i] = (T[j] + pressure * c->hat[j]) / k->scale[i];
        k->scratch[k->n + i] = T[c->n + j] / k->scale[i];
        p->d_T[i] = -before->D[c->n + j] * k->scale[i];
    }
    rb_contact_operator_add(p->op, k->scratch, k->scratch + k->n, p->d_N, p->d_T);
    p->stress = p->gap_length = size;
    p->slip_length = size * (p->mu > 0.0 ? p->mu : 1.0);
}

rb_status rb_crack_contact_solve(rb_crack_contact *k, rb_message *why)
{
    const rb_contact_options options = rb_contact_defaults();
    const rb_status s = rb_contact_solve(&k->problem, &options, k->warm, &k->state, why);
    k->warm = s == RB_OK;
    if (s == RB_OK)
        rb_contact_kinematics(&k->problem, &k->state, k->gap, k->slip);
    return s;
}

void rb_crack_contact_read(const rb_crack *c, const rb_crack_contact *k, rb_crack_state *state)
{
    const int n = c->n;

    state->open_length = state->stick_length = 0.0;
    for (int j = 0; j < n; j++) {
        const int i = k->m + j, zone = k->state.zone[i];
        /* a gap below zero is within the solver's tolerance of none */
        state->D[j] = zone == RB_ZONE_SEPARATED ? fmax(k->gap[i] / k->scale[i], 0.0) : 0.0;
        state->D[n + j] += k->slip[i] / k->scale[i];
        state->r[j] = k->state.p[i] * k->scale[i];
        state->r[n + j] = k->state.q[i] * k->scale[i];
        state->zone[j] = zone;
        state->open_length += zone == RB_ZONE_SEPARATED ? c->hat[j] : 0.0;
        state->stick_length += zone == RB_ZONE_STICK ? c->hat[j] : 0.0;
    }
    state->K_I = c->per_D * state->D[n - 1];
    state->K_II = c->per_D * state->D[2 * n - 1];
    state->K_I_upper = c->first ? c->per_D * state->D[0] : NAN;
    state->K_II_upper = c->first ? c->per_D * state->D[n] : NAN;
    state->residual = k->state.residual;
    state->iterations = k->state.iterations;
}

/* ---- Trapped fluid ----------------------------------------------------------------- */

/* The LCP of the step with one more unknown, p_f, and one more row, the free volume:
 * y_f = e'D_N - V_0 >= 0, complementary to p_f >= 0.  Its first n rows are the gaps; what
 * p_f adds to them and to the slips is the right-hand side of unit pressure alone.
 * *pressure: p_f; the problem is that of the load without fluid. */
static rb_status trapped_pressure(rb_crack *c, double volume, int mirrored, double *pressure,
                                  rb_message *why)
{
    rb_crack_contact *k = &c->faces;
    rb_contact_problem fluid = k->problem;
    rb_contact_lcp dry = {0}, unit = {0};
    rb_lcp_info info = {0};
    const int n = c->n;
    double *e = rb_alloc(2, (size_t)n), *d = rb_alloc(2, (size_t)n);
    double *M = NULL, *q = NULL, *z = NULL;
    rb_status s = e && d ? RB_OK : RB_ENOMEM;

    fluid.d_N = d;
    fluid.d_T = d + n;
    for (int j = 0; j < n && s == RB_OK; j++)
        e[j] = c->hat[j] / k->scale[j];
    if (s == RB_OK) {
        rb_contact_operator_add(fluid.op, e, e + n, fluid.d_N, fluid.d_T);
        s = rb_contact_lcp_create(&k->problem, RB_LCP_PIVOTED, mirrored, 0.0, &dry, why);
    }
    if (s == RB_OK)
        s = rb_contact_lcp_create(&fluid, RB_LCP_PIVOTED, mirrored, 0.0, &unit, why);
    const int last = dry.size, size = last + 1;
    if (s == RB_OK) {
        M = rb_alloc((size_t)size, (size_t)size);
        q = rb_alloc((size_t)size, 2);
        s = M && q ? RB_OK : RB_ENOMEM;
        z = q + size;
    }
    if (s == RB_OK) {
        const double unit_of_p = k->problem.stress / rb_norm_inf((size_t)n, e);
        for (int j = 0; j < last; j++) {
            memcpy(M + (size_t)j * size, dry.M + (size_t)j * last, (size_t)last * sizeof *M);
            M[j + (size_t)last * size] = unit_of_p * unit.b[j];
            q[j] = dry.b[j];
        }
        for (int i = 0; i < n; i++) /* e'D_N of the scaled rows */
            e[i] *= dry.w_scale[i];
        const double unit_of_y = cblas_ddot(n, e, 1, M + (size_t)last * size, 1);
        for (int j = 0; j < size; j++)
            M[last + (size_t)j * size] = cblas_ddot(n, e, 1, M + (size_t)j * size, 1) / unit_of_y;
        q[last] = (cblas_ddot(n, e, 1, q, 1) - volume) / unit_of_y;
        s = rb_lcp_lemke(&(rb_lcp_problem){size, M, size, q}, NULL, z, &info);
        *pressure = unit_of_p * z[last];
    }
    free(e);
    free(d);
    free(M);
    free(q);
    rb_contact_lcp_free(&dry);
    rb_contact_lcp_free(&unit);
    return s > 0 ? rb_fail(why, s, "%s", rb_status_reason(s, &info.msg)) : s;
}

/* ---- One step ---------------------------------------------------------------------- */

rb_status rb_crack_state_alloc(const rb_crack *c, rb_crack_state *state)
{
    const size_t n = (size_t)c->n;
    memset(state, 0, sizeof *state);
    state->n = c->n;
    state->D = rb_alloc(2, n);
    state->r = rb_alloc(2, n);
    state->zone = rb_alloc_int(n);
    if (state->D && state->r && state->zone)
        return RB_OK;
    rb_crack_state_free(state);
    return RB_ENOMEM;
}

void rb_crack_state_free(rb_crack_state *state)
{
    free(state->D);
    free(state->r);
    free(state->zone);
    memset(state, 0, sizeof *state);
}

rb_status rb_crack_step(rb_crack *c, const double *T, rb_crack_fluid fluid, double pressure,
                        double scale, rb_crack_state *state, rb_message *why)
{
    const size_t n = (size_t)c->n;
    rb_crack_contact *k = &c->faces;
    const double size =
        (scale > 0.0 ? scale : 1.0) * rb_norm_inf(n, c->hat) / rb_norm_inf(n, k->scale);
    double p_f = fluid == RB_CRACK_PRESSURE ? pressure : 0.0;

    rb_crack_contact_load(c, T, p_f, size, state, k);
    rb_status s = rb_crack_contact_solve(k, why);
    if (s == RB_OK && fluid == RB_CRACK_TRAPPED) {
        double volume = 0.0;
        for (size_t j = 0; j < n; j++)
            volume += c->hat[j] * k->gap[j] / k->scale[j];
        /* an open mouth lets the fluid in and out; a closed one keeps what is there */
        if (k->state.zone[0] == RB_ZONE_SEPARATED) {
            state->volume = volume;
        } else if (volume < state->volume) {
            s = trapped_pressure(c, state->volume, 0, &p_f, why);
            if (s > 0)
                s = trapped_pressure(c, state->volume, 1, &p_f, why);
            rb_crack_contact_load(c, T, p_f, size, state, k);
            if (s == RB_OK)
                s = rb_crack_contact_solve(k, why);
        }
    }
    if (s == RB_OK) {
        rb_crack_contact_read(c, k, state);
        state->fluid_pressure = p_f;
    }
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory") : s;
}
