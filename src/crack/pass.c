/* Contact of the faces step by step (C6), with trapped fluid as one more row of the LCP
 * (C7), and stress intensities (C8). */
#include "crack/internal.h"

#include "rollbem/lcp.h"

#include <cblas.h>
#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Of a step: how far the mouth may still be from closing when the fluid is trapped. */
static const double CLOSING = 1e-5;

/* ---- State ------------------------------------------------------------------------- */

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

/* ---- One step ---------------------------------------------------------------------- */

/* d = F (T + p_f e), scaled; slips count from those of the state. */
static void set_load(rb_crack *c, const double *T, double pressure,
                     const rb_crack_state *before, double *room)
{
    const int n = c->n;
    rb_contact_problem *p = &c->problem;
    for (int j = 0; j < n; j++) {
        room[j] = (T[j] + pressure * c->hat[j]) / c->scale[j];
        room[n + j] = T[n + j] / c->scale[j];
        p->d_N[j] = 0.0;
        p->d_T[j] = -before->D[n + j] * c->scale[j];
    }
    rb_contact_operator_add(p->op, room, room + n, p->d_N, p->d_T);
}

/* e'D_N of gaps of the scaled problem. */
static double volume_of(const rb_crack *c, const double *gap)
{
    double volume = 0.0;
    for (int j = 0; j < c->n; j++)
        volume += c->hat[j] * gap[j] / c->scale[j];
    return volume;
}

static rb_status solve_dry(rb_crack *c, rb_message *why)
{
    const rb_contact_options options = {
        .solver = RB_SOLVER_AUTO, .lcp_form = RB_LCP_PIVOTED, .tol = RB_CRACK_TOLERANCE};
    const rb_status s =
        rb_contact_solve(&c->problem, &options, c->warm, &c->contact, why);
    c->warm = s == RB_OK;
    return s;
}

/* Zones from tractions and slips; what is below rounding of the scales counts as zero. */
static void classify(const rb_crack *c, const double *slip)
{
    const rb_contact_state *of = &c->contact;
    for (int j = 0; j < c->n; j++) {
        const double p = of->p[j], q = of->q[j], least = 1e-9 * c->problem.stress;
        const int slides = c->problem.mu == 0.0 || c->problem.mu * p - fabs(q) <= least;
        of->zone[j] = p <= least                             ? RB_ZONE_SEPARATED
                      : !slides                              ? RB_ZONE_STICK
                      : (q != 0.0 ? q < 0.0 : slip[j] > 0.0) ? RB_ZONE_SLIP_NEGATIVE
                                                             : RB_ZONE_SLIP_POSITIVE;
    }
}

/* The LCP of the step with one more unknown, p_f, and one more row, the fluid's room:
 * y_f = e'D_N - V_0 >= 0, complementary to p_f >= 0.  Its first n rows are the gaps: what
 * p_f adds to them and to the slips, and the row of the volume, follow from F e alone.
 * *pressure: p_f; the problem is that of the load without fluid. */
static rb_status solve_trapped(rb_crack *c, double volume, int mirrored, double *pressure,
                               rb_message *why)
{
    rb_contact_problem *p = &c->problem;
    rb_contact_lcp dry = {0}, unit = {0};
    const int n = c->n;
    double *room = rb_alloc(4, (size_t)n);
    double *M = NULL, *q = NULL, *z = NULL;
    rb_lcp_info info = {0};

    rb_status s = room
                      ? rb_contact_lcp_create(p, RB_LCP_PIVOTED, mirrored, 0.0, &dry, why)
                      : RB_ENOMEM;
    const int size = dry.size + 1;
    if (s == RB_OK) {
        M = rb_alloc((size_t)size, (size_t)size);
        q = rb_alloc((size_t)size, 1);
        z = rb_alloc((size_t)size, 1);
        s = M && q && z ? RB_OK : RB_ENOMEM;
    }
    if (s == RB_OK) { /* the right-hand side of unit pressure alone is its column */
        rb_contact_problem loaded = *p;
        loaded.d_N = room + 2 * n;
        loaded.d_T = room + 3 * n;
        for (int j = 0; j < n; j++)
            room[j] = c->hat[j] / c->scale[j];
        rb_contact_operator_add(p->op, room, room + n, loaded.d_N, loaded.d_T);
        s = rb_contact_lcp_create(&loaded, RB_LCP_PIVOTED, mirrored, 0.0, &unit, why);
    }
    if (s == RB_OK) {
        /* sizes of one of p_f and y_f, so that the new diagonal entry is one */
        const double stress = p->stress / rb_norm_inf((size_t)n, room);
        double sum = 0.0;
        for (int i = 0; i < n; i++)
            sum += room[i] * unit.b[i] * unit.w_scale[i];
        const double size_f = stress * sum;
        for (int j = 0; j < size - 1; j++) {
            memcpy(M + (size_t)j * size, dry.M + (size_t)j * (size - 1),
                   ((size_t)size - 1) * sizeof *M);
            q[j] = dry.b[j];
            M[j + (size_t)(size - 1) * size] = stress * unit.b[j];
            for (int i = 0; i < n; i++)
                M[size - 1 + (size_t)j * size] +=
                    room[i] * dry.w_scale[i] * dry.M[i + (size_t)j * (size - 1)] / size_f;
        }
        M[(size_t)size * size - 1] = 1.0;
        for (int i = 0; i < n; i++)
            q[size - 1] += room[i] * dry.w_scale[i] * dry.b[i] / size_f;
        q[size - 1] -= volume / size_f;
        s = rb_lcp_lemke(&(rb_lcp_problem){size, M, size, q}, NULL, z, &info);
        *pressure = stress * z[size - 1];
        if (s == RB_OK) /* slips are recomputed from the loads with the fluid */
            for (int j = 0; j < n; j++) {
                p->d_N[j] += *pressure * room[2 * n + j];
                p->d_T[j] += *pressure * room[3 * n + j];
            }
        if (s == RB_OK) {
            rb_contact_lcp_recover(p, &dry, z, &c->contact);
            rb_contact_kinematics(p, &c->contact, room + 2 * n, room + 3 * n);
            classify(c, room + 3 * n);
        }
    }
    c->contact.residual = info.res;
    c->contact.iterations = info.iters;
    free(room);
    free(M);
    free(q);
    free(z);
    rb_contact_lcp_free(&dry);
    rb_contact_lcp_free(&unit);
    return s > 0 ? rb_fail(why, s, "%s", rb_status_reason(s, &info.msg)) : s;
}

void rb_crack_read_state(const rb_crack *c, const double *gap, const double *slip,
                         const double *scale, const rb_contact_state *of, int at,
                         rb_crack_state *state)
{
    const int n = c->n;

    state->open_length = state->stick_length = 0.0;
    for (int j = 0; j < n; j++) {
        const int i = at + j, zone = of->zone[i];
        state->D[j] = zone == RB_ZONE_SEPARATED ? gap[i] / scale[i] : 0.0;
        state->D[n + j] += slip[i] / scale[i];
        state->r[j] = of->p[i] * scale[i];
        state->r[n + j] = of->q[i] * scale[i];
        state->zone[j] = zone;
        state->open_length += zone == RB_ZONE_SEPARATED ? c->hat[j] : 0.0;
        state->stick_length += zone == RB_ZONE_STICK ? c->hat[j] : 0.0;
    }
    state->K_I = c->per_D * state->D[n - 1];
    state->K_II = c->per_D * state->D[2 * n - 1];
    state->K_I_upper = c->first ? c->per_D * state->D[0] : NAN;
    state->K_II_upper = c->first ? c->per_D * state->D[n] : NAN;
    state->residual = of->residual;
    state->iterations = of->iterations;
}

rb_status rb_crack_step(rb_crack *c, const double *T, rb_crack_fluid fluid,
                        double pressure, double scale, rb_crack_state *state,
                        rb_message *why)
{
    const size_t n = (size_t)c->n;
    rb_contact_problem *p = &c->problem;
    double *room = rb_alloc(2, n), *gap = rb_alloc(2, n);
    double p_f = fluid == RB_CRACK_PRESSURE ? pressure : 0.0;
    rb_status s = room && gap ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        p->stress = (scale > 0.0 ? scale : 1.0) * rb_norm_inf(n, c->hat) /
                    rb_norm_inf(n, c->scale);
        p->gap_length = p->stress;
        p->slip_length = p->stress * (p->mu > 0.0 ? p->mu : 1.0);
        set_load(c, T, p_f, state, room);
        s = solve_dry(c, why);
    }
    if (s == RB_OK && fluid == RB_CRACK_TRAPPED) {
        rb_contact_kinematics(p, &c->contact, gap, gap + n);
        const double volume = volume_of(c, gap);
        /* an open mouth lets the fluid in and out; a closed one keeps what is there */
        if (c->contact.zone[0] == RB_ZONE_SEPARATED) {
            state->volume = volume;
        } else if (volume < state->volume) {
            s = solve_trapped(c, state->volume, 0, &p_f, why);
            if (s > 0)
                s = solve_trapped(c, state->volume, 1, &p_f, why);
        }
    }
    if (s == RB_OK) {
        rb_contact_kinematics(p, &c->contact, gap, gap + n);
        rb_crack_read_state(c, gap, gap + n, c->scale, &c->contact, 0, state);
        state->fluid_pressure = p_f;
    }
    free(room);
    free(gap);
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory") : s;
}

/* ---- A pass ------------------------------------------------------------------------ */

void rb_crack_history_free(rb_crack_history *h)
{
    free(h->x);
    free(h->D);
    free(h->zone);
    memset(h, 0, sizeof *h);
}

static rb_status history_alloc(const rb_crack *c, size_t n, int coupled,
                               rb_crack_history *h)
{
    memset(h, 0, sizeof *h);
    h->nodes = c->n;
    h->x = rb_alloc(n, 10);
    h->D = rb_alloc(n, 2 * (size_t)c->n);
    h->zone = rb_alloc_int(n * (size_t)c->n);
    if (!h->x || !h->D || !h->zone) {
        rb_crack_history_free(h);
        return RB_ENOMEM;
    }
    double **const column[] = {&h->K_I,          &h->K_II,           &h->open_length,
                               &h->stick_length, &h->fluid_pressure, &h->residual,
                               &h->K_I_upper,    &h->K_II_upper};
    for (size_t k = 0; k < (c->first ? 8 : 6); k++)
        *column[k] = h->x + (k + 1) * n;
    h->max_pressure = coupled ? h->x + 9 * n : NULL;
    return RB_OK;
}

static void record(const rb_crack_state *state, double x, rb_crack_history *h)
{
    const size_t n = (size_t)state->n, k = (size_t)h->n++;
    h->x[k] = x;
    h->K_I[k] = state->K_I;
    h->K_II[k] = state->K_II;
    if (h->K_I_upper) {
        h->K_I_upper[k] = state->K_I_upper;
        h->K_II_upper[k] = state->K_II_upper;
    }
    h->open_length[k] = state->open_length;
    h->stick_length[k] = state->stick_length;
    h->fluid_pressure[k] = state->fluid_pressure;
    h->residual[k] = state->residual;
    memcpy(h->D + k * 2 * n, state->D, 2 * n * sizeof *h->D);
    memcpy(h->zone + k * n, state->zone, n * sizeof *h->zone);
}

/* Pressure of the load where the mouth is. */
static double pressure_at(const rb_bem_edge_load *load, double x)
{
    for (int i = 0; i < load->n; i++)
        if (load->x[i] <= x && x < load->x[i + 1])
            return load->p[i];
    return 0.0;
}

static double largest_stress(const rb_crack_passage *p)
{
    double largest = fabs(p->tension);
    for (int k = 0; k < p->loads; k++) {
        const size_t n = (size_t)p->load[k].n;
        largest = fmax(largest, rb_norm_inf(n, p->load[k].p));
        largest = fmax(largest, rb_norm_inf(n, p->load[k].q));
    }
    return largest;
}

/* Nodal forces on the way from step k - 1 to step k; part = 1: in step k. */
static rb_status load_between(const rb_crack *c, const rb_crack_passage *p, int k,
                              double part, double *T)
{
    const size_t m = 2 * (size_t)c->n;
    const rb_bem_edge_load *now = p->loads > 0 ? &p->load[p->loads > 1 ? k : 0] : NULL;
    if (part == 1.0)
        return rb_crack_load(c, now, p->x[k], p->tension, T);
    const double x = p->x[k - 1] + part * (p->x[k] - p->x[k - 1]);
    const rb_status s = rb_crack_load(c, now, x, p->tension, T);
    if (s != RB_OK || p->loads < 2)
        return s;
    double *before = rb_alloc(m, 1);
    const rb_status t =
        before ? rb_crack_load(c, now - 1, x, p->tension, before) : RB_ENOMEM;
    for (size_t i = 0; i < m && t == RB_OK; i++)
        T[i] = part * T[i] + (1.0 - part) * before[i];
    free(before);
    return t;
}

/* What is trapped is the volume at the place where the mouth closes, and near it the
 * crack closes fast: the state becomes that just before this place, by bisection.
 * *solved: 1: the mouth stays open in the whole step, and the state is that at its end.
 */
static rb_status approach_closing(rb_crack *c, const rb_crack_passage *p, int k,
                                  double scale, double *T, rb_crack_state *state,
                                  int *solved, rb_message *why)
{
    rb_crack_state trial;
    double open = 0.0, closed = 1.0;
    rb_status s = rb_crack_state_alloc(c, &trial);

    for (double part = 1.0; closed - open > CLOSING && s == RB_OK;
         part = 0.5 * (open + closed)) {
        memcpy(trial.D, state->D, 2 * (size_t)c->n * sizeof *trial.D);
        s = load_between(c, p, k, part, T);
        trial.volume = 0.0; /* so that nothing is trapped */
        if (s == RB_OK)
            s = rb_crack_step(c, T, RB_CRACK_TRAPPED, 0.0, scale, &trial, why);
        if (s == RB_OK && trial.zone[0] == RB_ZONE_SEPARATED) {
            const rb_crack_state passed = *state;
            *state = trial;
            trial = passed;
            open = part;
        } else {
            closed = part;
        }
    }
    rb_crack_state_free(&trial);
    *solved = open == 1.0;
    return s;
}

rb_status rb_crack_pass(rb_crack *c, const rb_crack_passage *p, rb_crack_history *h,
                        rb_message *why)
{
    memset(h, 0, sizeof *h);
    if (p->steps < 1 || p->passes < 1 ||
        (p->loads != 0 && p->loads != 1 && p->loads != p->steps))
        return rb_fail(why, RB_EINVAL, "crack: %d steps, %d passes, %d loads", p->steps,
                       p->passes, p->loads);
    if (p->fluid != RB_CRACK_DRY && c->first)
        return rb_fail(
            why, RB_EINVAL,
            "crack: fluid enters at the mouth; a crack below the surface has none");
    if (p->fluid != RB_CRACK_DRY && p->wheel)
        return rb_fail(why, RB_EINVAL, "crack: a coupled crack cannot contain fluid");
    rb_phase("passes over the crack");
    const double scale = largest_stress(p);
    double *T = rb_alloc(2, (size_t)c->n);
    rb_crack_state state = {0};
    rb_status s =
        T ? history_alloc(c, (size_t)p->steps * (size_t)p->passes, p->wheel != NULL, h)
          : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_crack_state_alloc(c, &state);
    c->warm = 0;
    for (int k = 0; k < p->steps * p->passes && s == RB_OK; k++) {
        const int step = k % p->steps;
        const rb_bem_edge_load *load =
            p->loads > 0 ? &p->load[p->loads > 1 ? step : 0] : NULL;
        const double at_mouth =
            load ? pressure_at(load, c->shape.path.x[0] - p->x[step]) : 0.0;
        double max_pressure = 0.0;
        int solved = 0;
        rb_message reason = {""};
        if (p->fluid == RB_CRACK_TRAPPED && p->locate_closing && step > 0 &&
            state.zone[0] == RB_ZONE_SEPARATED && state.fluid_pressure == 0.0)
            s = approach_closing(c, p, step, scale, T, &state, &solved, &reason);
        if (s == RB_OK && !solved)
            s = rb_crack_load(c, p->wheel ? NULL : load, p->x[step], p->tension, T);
        if (s == RB_OK && p->wheel)
            s = rb_crack_step_coupled(c, p->wheel, p->x[step], T, scale, &state,
                                      &max_pressure, &reason);
        else if (s == RB_OK && !solved)
            s = rb_crack_step(c, T, p->fluid, at_mouth, scale, &state, &reason);
        if (s == RB_OK && p->wheel)
            h->max_pressure[h->n] = max_pressure;
        if (s == RB_OK)
            record(&state, p->x[step], h);
        else if (s > 0)
            rb_fail(why, s, "crack: step %d, contact at x = %g: %.300s", k + 1,
                    p->x[step], rb_status_reason(s, &reason));
    }
    rb_crack_state_free(&state);
    free(T);
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory for %d steps",
                                    p->steps * p->passes)
                          : s;
}

/* ---- What a pass comes to ---------------------------------------------------------- */

/* Tension across the direction theta ahead of the tip is cos(theta/2) (K_I cos^2(theta/2)
 * - 3/2 K_II sin theta)/sqrt(2 pi r); largest where its slope is zero. */
static double largest_tension(double K_I, double K_II, double *theta)
{
    *theta = K_II == 0.0
                 ? 0.0
                 : 2.0 * atan2(K_I - sqrt(K_I * K_I + 8.0 * K_II * K_II), 4.0 * K_II);
    if (K_II < 0.0) /* the other half of the plane: tan is the same */
        *theta = 2.0 * atan2(sqrt(K_I * K_I + 8.0 * K_II * K_II) - K_I, -4.0 * K_II);
    const double c = cos(0.5 * *theta);
    return c * (K_I * c * c - 1.5 * K_II * sin(*theta));
}

rb_crack_summary rb_crack_summarise(const rb_crack_history *h, int passes)
{
    const int steps = h->n / GSL_MAX(passes, 1);
    rb_crack_summary s = {.from = h->n - steps, .pass_change = NAN};

    s.K_I_max = s.K_II_max = s.open_max = s.fluid_pressure_max = -INFINITY;
    s.max_pressure = h->max_pressure ? rb_norm_inf((size_t)h->n, h->max_pressure) : NAN;
    s.K_I_min = s.K_II_min = INFINITY;
    s.K_I_max_upper = s.K_II_max_upper = s.K_I_min_upper = s.K_II_min_upper = NAN;
    for (int k = s.from; k < h->n; k++) {
        if (h->K_I[k] > s.K_I_max) {
            s.K_I_max = h->K_I[k];
            s.K_I_max_at = h->x[k];
            s.K_II_at_K_I_max = h->K_II[k];
        }
        if (h->K_II[k] > s.K_II_max) {
            s.K_II_max = h->K_II[k];
            s.K_II_max_at = h->x[k];
        }
        if (h->K_II[k] < s.K_II_min) {
            s.K_II_min = h->K_II[k];
            s.K_II_min_at = h->x[k];
        }
        s.K_I_min = fmin(s.K_I_min, h->K_I[k]);
        double theta;
        const double tension = largest_tension(h->K_I[k], h->K_II[k], &theta);
        if (k == s.from || tension > s.K_theta_max) {
            s.K_theta_max = tension;
            s.kink_angle = theta * (180.0 / M_PI);
        }
        s.open_max = fmax(s.open_max, h->open_length[k]);
        s.fluid_pressure_max = fmax(s.fluid_pressure_max, h->fluid_pressure[k]);
    }
    for (int k = 0; k < h->n; k++)
        s.residual = fmax(s.residual, h->residual[k]);
    for (int k = s.from; k < h->n && h->K_I_upper; k++) {
        s.K_I_max_upper = fmax(s.K_I_max_upper, h->K_I_upper[k]);
        s.K_I_min_upper = fmin(s.K_I_min_upper, h->K_I_upper[k]);
        s.K_II_max_upper = fmax(s.K_II_max_upper, h->K_II_upper[k]);
        s.K_II_min_upper = fmin(s.K_II_min_upper, h->K_II_upper[k]);
    }
    s.delta_K_I = s.K_I_max - s.K_I_min;
    s.delta_K_II = s.K_II_max - s.K_II_min;
    for (int k = 0; k < steps && passes > 1; k++) {
        const double change =
            fmax(fabs(h->K_I[s.from + k] - h->K_I[s.from - steps + k]),
                 fabs(h->K_II[s.from + k] - h->K_II[s.from - steps + k]));
        s.pass_change = k == 0 ? change : fmax(s.pass_change, change);
    }
    return s;
}
