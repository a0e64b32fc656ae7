/* A load that passes over a crack, position by position. */
#include "analysis/crack/internal.h"

#include <stdlib.h>
#include <string.h>

/* Of a step: how far the mouth may still be from closing when the fluid is trapped. */
static const double CLOSING = 1e-5;

/* ---- History ----------------------------------------------------------------------- */

enum { COLUMNS = 11 };

void rb_crack_history_free(rb_crack_history *h)
{
    free(h->x);
    free(h->D);
    free(h->zone);
    free(h->wheel);
    memset(h, 0, sizeof *h);
}

rb_status rb_crack_history_alloc(const rb_crack *c, int steps, int elements, rb_crack_history *h)
{
    const size_t n = (size_t)steps;
    memset(h, 0, sizeof *h);
    h->nodes = c->n;
    h->elements = elements;
    h->x = rb_alloc(n, COLUMNS);
    h->D = rb_alloc(n, 4 * (size_t)c->n);
    h->zone = rb_alloc_int(n * (size_t)c->n);
    h->wheel = elements > 0 ? rb_alloc(n, (size_t)elements) : NULL;
    if (!h->x || !h->D || !h->zone || (elements > 0 && !h->wheel)) {
        rb_crack_history_free(h);
        return RB_ENOMEM;
    }
    h->r = h->D + n * 2 * (size_t)c->n;
    h->K_I = h->x + n;
    h->K_II = h->K_I + n;
    h->open_length = h->K_II + n;
    h->stick_length = h->open_length + n;
    h->fluid_pressure = h->stick_length + n;
    h->fluid_volume = h->fluid_pressure + n;
    h->residual = h->fluid_volume + n;
    h->K_I_upper = c->first ? h->residual + n : NULL;
    h->K_II_upper = c->first ? h->residual + 2 * n : NULL;
    h->max_pressure = elements > 0 ? h->residual + 3 * n : NULL;
    return RB_OK;
}

/* In the order of rb_crack_history_alloc. */
static void record_state(const rb_crack_state *state, double x, size_t steps, rb_crack_history *h)
{
    const size_t n = (size_t)state->n, k = (size_t)h->n++, m = (size_t)h->elements;
    const double value[COLUMNS] = {x,
                                   state->K_I,
                                   state->K_II,
                                   state->open_length,
                                   state->stick_length,
                                   state->fluid_pressure,
                                   state->volume,
                                   state->residual,
                                   state->K_I_upper,
                                   state->K_II_upper,
                                   m > 0 ? rb_norm_inf(m, h->wheel + k * m) : 0.0};
    for (size_t i = 0; i < COLUMNS; i++)
        h->x[i * steps + k] = value[i];
    memcpy(h->D + k * 2 * n, state->D, 2 * n * sizeof *h->D);
    memcpy(h->r + k * 2 * n, state->r, 2 * n * sizeof *h->r);
    memcpy(h->zone + k * n, state->zone, n * sizeof *h->zone);
}

/* ---- Load -------------------------------------------------------------------------- */

static const rb_bem_edge_load *load_of(const rb_crack_passage *p, int k)
{
    return p->loads > 0 && !p->wheel ? &p->load[p->loads > 1 ? k : 0] : NULL;
}

static double tension_of(const rb_crack_passage *p, int k)
{
    return p->tensions ? p->tensions[k] : p->tension;
}

/* Near that place the crack closes fast: by bisection. */
rb_status rb_crack_close(rb_crack *c, const rb_crack_passage *p, int k, double scale, double *T,
                         rb_crack_state *state, rb_message *why)
{
    rb_crack_state trial;
    double open = 0.0, closed = 1.0;

    if (!p->locate_closing || p->fluid != RB_CRACK_TRAPPED || k == 0 ||
        state->zone[0] != RB_ZONE_SEPARATED || state->fluid_pressure != 0.0)
        return RB_OK;
    rb_status s = rb_crack_state_alloc(c, &trial);

    for (double part = 1.0; closed - open > CLOSING && s == RB_OK; part = 0.5 * (open + closed)) {
        memcpy(trial.D, state->D, 2 * (size_t)c->n * sizeof *trial.D);
        trial.volume = 0.0; /* so that nothing is trapped */
        /* Nodal forces on the way from step k - 1 to step k. */
        double *before = T + 2 * c->n;
        const double x = p->x[k - 1] + part * (p->x[k] - p->x[k - 1]);
        if (part == 1.0 && p->forces)
            memcpy(T, p->forces + 2 * (size_t)k * (size_t)c->n, 2 * (size_t)c->n * sizeof *T);
        else
            s = rb_crack_load(c, load_of(p, k), p->kind, x, tension_of(p, k), T);
        if (s == RB_OK && p->loads > 1)
            s = rb_crack_load(c, load_of(p, k - 1), p->kind, x, tension_of(p, k - 1), before);
        for (int i = 0; i < 2 * c->n && p->loads > 1; i++)
            T[i] = part * T[i] + (1.0 - part) * before[i];
        if (s == RB_OK)
            s = rb_crack_step(c, T, RB_CRACK_TRAPPED, 0.0, scale, &trial, why);
        const int is_open = trial.zone[0] == RB_ZONE_SEPARATED;
        if (part == 1.0 && is_open)
            break;
        if (s == RB_OK && is_open) {
            const rb_crack_state passed = *state;
            *state = trial;
            trial = passed;
            open = part;
        } else {
            closed = part;
        }
    }
    rb_crack_state_free(&trial);
    return s;
}

/* ---- A pass ------------------------------------------------------------------------ */

rb_status rb_crack_pass(rb_crack *c, const rb_crack_passage *p, rb_crack_history *h,
                        rb_message *why)
{
    memset(h, 0, sizeof *h);
    if (p->steps < 1 || p->passes < 1 || (p->loads != 0 && p->loads != 1 && p->loads != p->steps))
        return rb_fail(why, RB_EINVAL, "crack: %d steps, %d passes, %d loads", p->steps, p->passes,
                       p->loads);
    if (p->fluid != RB_CRACK_DRY && c->first)
        return rb_fail(why, RB_EINVAL,
                       "crack: fluid enters at the mouth; a crack below the surface has none");
    if (p->fluid != RB_CRACK_DRY && p->wheel)
        return rb_fail(why, RB_EINVAL, "crack: a coupled crack cannot contain fluid");
    rb_phase("passes over the crack");
    const int n = p->steps * p->passes;
    double scale = 0.0; /* the largest stress */
    for (int k = 0; k < p->steps; k++)
        scale = fmax(scale, fabs(tension_of(p, k)));
    for (int k = 0; k < p->loads; k++) {
        const size_t strips = (size_t)p->load[k].n;
        scale =
            fmax(scale, fmax(rb_norm_inf(strips, p->load[k].p), rb_norm_inf(strips, p->load[k].q)));
    }
    double *T = rb_alloc(4, (size_t)c->n);
    rb_crack_state state = {0};
    rb_status s = T ? rb_crack_history_alloc(c, n, p->wheel ? p->wheel->n : 0, h) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_crack_state_alloc(c, &state);
    c->faces.warm = c->coupled.warm = 0;
    for (int k = 0; k < n && s == RB_OK; k++) {
        const int step = k % p->steps;
        const double x = p->x[step];
        rb_message reason = {.text = ""};
        if (p->observer && p->observer->stopped(k, n, p->observer->context))
            s = RB_INTERRUPTED;
        if (s == RB_OK)
            s = rb_crack_close(c, p, step, scale, T, &state, &reason);
        const rb_bem_edge_load *load = load_of(p, step);
        const double at_mouth =
            load ? rb_crack_pressure(load, p->kind, c->shape.path.x[0] - x) : 0.0;
        if (p->forces)
            memcpy(T, p->forces + 2 * (size_t)step * (size_t)c->n, 2 * (size_t)c->n * sizeof *T);
        else if (s == RB_OK)
            s = rb_crack_load(c, load, p->kind, x, tension_of(p, step), T);
        if (s == RB_OK)
            s = p->wheel
                    ? rb_crack_step_coupled(c, p->wheel, x, T, scale, &state,
                                            h->wheel + (size_t)k * (size_t)h->elements, &reason)
                    : rb_crack_step(c, T, p->fluid, at_mouth, scale, &state, &reason);
        if (s == RB_INTERRUPTED) {
            h->n = k - step; /* the results are those of the last complete pass */
            rb_fail(why, s, "interrupted after pass %d of %d", k / p->steps, p->passes);
        } else if (s == RB_OK)
            record_state(&state, x, (size_t)n, h);
        else if (s > 0)
            rb_fail(why, s, "crack: step %d, contact at x = %g: %.300s", k + 1, x,
                    rb_status_reason(s, &reason));
    }
    rb_crack_state_free(&state);
    free(T);
    return s == RB_ENOMEM ? rb_fail(why, s, "crack: out of memory for %d steps", n) : s;
}

/* ---- Direction --------------------------------------------------------------------- */

/* Tension across the direction theta ahead of the tip is cos(theta/2) (K_I cos^2(theta/2)
 * - 3/2 K_II sin theta)/sqrt(2 pi r); largest where its slope is zero. */
double rb_crack_largest_tension(double K_I, double K_II, double *theta)
{
    *theta = K_II == 0.0 ? 0.0 : 2.0 * atan2(K_I - sqrt(K_I * K_I + 8.0 * K_II * K_II), 4.0 * K_II);
    if (K_II < 0.0) /* the other half of the plane: tan is the same */
        *theta = 2.0 * atan2(sqrt(K_I * K_I + 8.0 * K_II * K_II) - K_I, -4.0 * K_II);
    const double c = cos(0.5 * *theta);
    return c * (K_I * c * c - 1.5 * K_II * sin(*theta));
}
