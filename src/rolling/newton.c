/* Active sets: with every element's zone known the contact problem is linear.  Newton's
 * method for the piecewise linear problem is to solve, to correct the zones and to solve
 * again; the same solve polishes what Lemke found. */
#include "rolling/reduced.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 60, STAGGERED_ROUNDS = 3 };
/* From so many elements on a cold start solves for pairs of them first. */
enum { HALVED = 100 };
/* Solves with one LU before it is given up, and the relative correction that is the last
 * one. */
enum { PASSES = 3 };
static const double SMALL = 1e-6;
/* Of the tractions before delta and xi take part: three digits cancel. */
static const double MOST_GROWTH = 1e3;

static int is_finite(int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return 0;
    return 1;
}

/* Solves, and where a kept LU served or digits were lost, solves again for what the
 * equations still lack, until a correction is small.  *settled: 0 where none was. */
static rb_status solve_direct(rb_rolling_problem *p, rb_rolling_lu lu,
                              rb_rolling_state *state, rb_rolling_reduced *r,
                              int *settled)
{
    double size = 0.0;

    *settled = 0;
    rb_rolling_reduced_clear(p, r, state);
    for (int pass = 0; pass < PASSES && !*settled; pass++) {
        rb_rolling_reduced_right_side(p, state, r);
        const rb_status s = rb_rolling_reduced_direct(p, state->zone, lu, r);
        if (s != RB_OK || !is_finite(r->size, r->x))
            return s < 0 ? s : RB_SINGULAR;
        rb_rolling_reduced_add(p, r, state);
        const double change = rb_norm_inf((size_t)r->size, r->x);
        *settled = (r->changes == 0 && r->growth < MOST_GROWTH) ||
                   (pass > 0 && change <= SMALL * size);
        size = fmax(size, change);
    }
    return RB_OK;
}

static rb_status solve_dense(rb_rolling_problem *p, rb_rolling_state *state,
                             rb_rolling_reduced *r)
{
    rb_status s = RB_OK;
    int settled = 0;

    for (int lu = RB_LU_KEPT; lu < RB_LU_KINDS && s >= 0 && !settled; lu++)
        s = solve_direct(p, (rb_rolling_lu)lu, state, r, &settled);
    return s;
}

static rb_status solve_products(rb_rolling_problem *p, rb_rolling_state *state,
                                rb_rolling_reduced *r)
{
    rb_rolling_reduced_clear(p, r, state);
    rb_rolling_reduced_right_side(p, state, r);
    const rb_status s = rb_rolling_reduced_krylov(p, state->zone, r);
    if (s != RB_OK || !is_finite(r->size, r->x))
        return s < 0 ? s : RB_SINGULAR;
    rb_rolling_reduced_add(p, r, state);
    return RB_OK;
}

rb_status rb_rolling_solve_zones(rb_rolling_problem *problem,
                                 rb_rolling_unknowns unknowns, rb_rolling_state *state)
{
    rb_rolling_reduced r;
    rb_status s = rb_rolling_reduced_alloc(problem, unknowns, state, &r);

    if (s == RB_OK)
        s = problem->F ? solve_dense(problem, state, &r)
                       : solve_products(problem, state, &r);
    rb_rolling_reduced_free(&r);
    return s;
}

rb_status rb_rolling_try_zones(rb_rolling_problem *problem, rb_rolling_state *state,
                               double *gap)
{
    const rb_status s = rb_rolling_solve_zones(problem, RB_BOTH, state);
    if (s == RB_OK)
        rb_rolling_kinematics(problem, state, gap, state->lambda);
    return s;
}

/* ---- Newton ------------------------------------------------------------------------ */

static int corrected_zone(const rb_rolling_problem *p, rb_rolling_unknowns unknowns,
                          const rb_rolling_state *state, const double *gap, int i)
{
    const double limit = p->mu * state->p[i], q = state->q[i], slip = state->lambda[i];
    const int zone = state->zone[i];

    if ((unknowns & RB_NORMAL) && zone != RB_ZONE_SEPARATED && state->p[i] < 0.0)
        return RB_ZONE_SEPARATED;
    if (zone == RB_ZONE_SEPARATED) {
        if (!(unknowns & RB_NORMAL) || gap[i] >= 0.0)
            return zone;
        return slip >= 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE;
    }
    if (!(unknowns & RB_TANGENTIAL))
        return zone;
    if (zone == RB_ZONE_STICK)
        return q < -limit  ? RB_ZONE_SLIP_NEGATIVE
               : q > limit ? RB_ZONE_SLIP_POSITIVE
                           : zone;
    if (p->mu == 0.0)
        return slip >= 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE;
    return rb_rolling_slope(zone) * slip > 0.0 ? RB_ZONE_STICK : zone;
}

static int stick_count(int n, const int *zone)
{
    int sticks = 0;
    for (int i = 0; i < n; i++)
        sticks += zone[i] == RB_ZONE_STICK;
    return sticks;
}

/* Of several stuck elements that all want to slide, the one that wants it least. */
static int least_excess(const rb_rolling_problem *p, const rb_rolling_state *state)
{
    int held = -1;
    double least = INFINITY;

    for (int i = 0; i < p->n; i++) {
        const double excess = fabs(state->q[i]) - p->mu * state->p[i];
        if (state->zone[i] == RB_ZONE_STICK && state->p[i] > 0.0 && excess < least) {
            least = excess;
            held = i;
        }
    }
    return held;
}

/* A single stuck element that must carry too much friction of sign o: the creepage has to
 * move until the next element that slides against o comes to rest. */
static int next_to_rest(const rb_rolling_problem *p, const rb_rolling_state *state,
                        int stuck)
{
    const double o = state->q[stuck] > 0.0 ? 1.0 : -1.0;
    int held = stuck;
    double least = INFINITY;

    for (int i = 0; i < p->n; i++)
        if (state->p[i] > 0.0 && rb_rolling_slope(state->zone[i]) * o < 0.0 &&
            fabs(state->lambda[i] / p->e_T[i]) < least) {
            least = fabs(state->lambda[i] / p->e_T[i]);
            held = i;
        }
    return held;
}

/* A given force fixes xi only while something sticks. */
static void hold_one(const rb_rolling_problem *p, const rb_rolling_state *state,
                     int *zone)
{
    if (stick_count(p->n, zone) > 0)
        return;
    int held = least_excess(p, state);
    if (held >= 0 && stick_count(p->n, state->zone) == 1)
        held = next_to_rest(p, state, held);
    if (held >= 0)
        zone[held] = RB_ZONE_STICK;
}

/* New zones into state; returns how many changed. */
static int correct_zones(const rb_rolling_problem *p, rb_rolling_unknowns unknowns,
                         rb_rolling_state *state, const double *gap, int *zone)
{
    int changes = 0;

    for (int i = 0; i < p->n; i++)
        zone[i] = corrected_zone(p, unknowns, state, gap, i);
    if (p->force_given && (unknowns & RB_TANGENTIAL))
        hold_one(p, state, zone);
    for (int i = 0; i < p->n; i++)
        changes += zone[i] != state->zone[i];
    memcpy(state->zone, zone, (size_t)p->n * sizeof(int));
    return changes;
}

/* FNV-1a over the zones: a set of zones that comes back means a cycle. */
static uint64_t fingerprint(int n, const int *zone)
{
    uint64_t hash = 14695981039346656037u;
    for (int i = 0; i < n; i++)
        hash = (hash ^ (uint64_t)zone[i]) * 1099511628211u;
    return hash;
}

static int seen_before(int count, const uint64_t *seen, uint64_t hash)
{
    for (int k = 0; k < count; k++)
        if (seen[k] == hash)
            return 1;
    return 0;
}

typedef struct {
    double *gap;
    int *zone;
} workspace;

/* Solves and corrects until the zones stay: RB_OK; RB_MAXITER when a set of zones comes
 * back, which ends every cycle. */
static rb_status iterate(rb_rolling_problem *p, rb_rolling_unknowns unknowns,
                         workspace *ws, rb_rolling_state *state)
{
    uint64_t seen[MAX_STEPS];

    for (int step = 0; step < MAX_STEPS; step++) {
        seen[step] = fingerprint(p->n, state->zone);
        if (seen_before(step, seen, seen[step]))
            return RB_MAXITER;
        const rb_status s = rb_rolling_solve_zones(p, unknowns, state);
        if (s != RB_OK)
            return s;
        state->iterations++;
        rb_rolling_kinematics(p, state, ws->gap, state->lambda);
        if (p->trace)
            p->trace(state, p->trace_context);
        if (correct_zones(p, unknowns, state, ws->gap, ws->zone) == 0)
            return RB_OK;
    }
    return RB_MAXITER;
}

/* Everything in frictionless contact, to begin with. */
static void cold_start(const rb_rolling_problem *p, rb_rolling_state *state)
{
    memset(state->p, 0, (size_t)p->n * sizeof(double));
    memset(state->q, 0, (size_t)p->n * sizeof(double));
    state->delta = p->delta;
    state->xi = p->force_given ? 0.0 : p->xi;
    for (int i = 0; i < p->n; i++)
        state->zone[i] = RB_ZONE_STICK;
}

/* Normal problem with the friction held, tangential problem with the pressure held, in
 * turn: exact after one round where the two are not coupled. */
static rb_status alternate(rb_rolling_problem *p, int rounds, workspace *ws,
                           rb_rolling_state *state)
{
    rb_status s = RB_OK;

    for (int round = 0; round < rounds && s >= 0 && s != RB_SINGULAR; round++) {
        s = iterate(p, RB_NORMAL, ws, state);
        if (s >= 0 && s != RB_SINGULAR)
            s = iterate(p, RB_TANGENTIAL, ws, state);
    }
    return s;
}

/* From the zones of the state. */
static rb_status from_zones(rb_rolling_problem *p, workspace *ws, rb_rolling_state *state)
{
    return p->coupled ? iterate(p, RB_BOTH, ws, state) : alternate(p, 1, ws, state);
}

/* An LU of all tractions and those of one group each never take memory together: no later
 * solve would use both (memory.c). */
static rb_status from_nothing(rb_rolling_problem *p, workspace *ws,
                              rb_rolling_state *state)
{
    cold_start(p, state);
    rb_rolling_factors_clear(p->factors);
    const rb_status s = alternate(p, p->coupled ? STAGGERED_ROUNDS : 1, ws, state);
    if (s < 0 || !p->coupled)
        return s;
    rb_rolling_factors_clear(p->factors);
    return iterate(p, RB_BOTH, ws, state);
}

/* Zones and tractions of the same problem on half as many elements; its steps count. */
static rb_status start_from_half(const rb_rolling_problem *p, rb_rolling_state *state)
{
    rb_rolling_problem half;
    rb_rolling_state coarse = {0};
    double *room = rb_rolling_halve(p, &half);
    rb_status s = room ? rb_rolling_state_alloc(half.n, &coarse) : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_rolling_factors_create(&half.factors);
    if (s == RB_OK)
        s = rb_rolling_newton(&half, 0, &coarse);
    if (s == RB_OK)
        rb_rolling_start_from_half(&coarse, state);
    state->iterations += coarse.iterations;
    rb_rolling_state_free(&coarse);
    if (room)
        rb_rolling_factors_free(half.factors);
    free(room);
    return s;
}

static rb_status from_half(rb_rolling_problem *p, workspace *ws, rb_rolling_state *state)
{
    const rb_status s = start_from_half(p, state);
    return s == RB_OK ? from_zones(p, ws, state) : s;
}

rb_status rb_rolling_newton(rb_rolling_problem *problem, int warm,
                            rb_rolling_state *state)
{
    workspace ws = {rb_alloc((size_t)problem->n, 1), rb_alloc_int((size_t)problem->n)};
    rb_status s = ws.gap && ws.zone ? RB_OK : RB_ENOMEM;

    if (s == RB_OK && warm)
        s = from_zones(problem, &ws, state);
    else if (s == RB_OK) {
        s = problem->F && problem->n >= HALVED ? from_half(problem, &ws, state)
                                               : RB_MAXITER;
        if (s > 0)
            s = from_nothing(problem, &ws, state);
    }
    free(ws.gap);
    free(ws.zone);
    return s;
}
