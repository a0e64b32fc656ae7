/* Active sets: with every element's zone known the contact problem is linear.  Newton's
 * method for the piecewise linear problem is to solve, to correct the zones and to solve
 * again; the same solve polishes what Lemke found. */
#include "lcp/contact/internal.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 60, STAGGERED_ROUNDS = 3 };
/* Steps without fewer zones to correct than before, after which the path is followed. */
enum { STALL_SWEEPS = 20 };
/* From so many elements on a cold start solves for pairs of them first. */
enum { HALVED = 100 };

static int corrected_zone(const rb_contact_problem *p, rb_contact_unknowns unknowns,
                          const rb_contact_state *state, const double *gap, int i)
{
    const double limit = p->bound[i] * state->p[i], q = state->q[i], slip = state->lambda[i];
    const int zone = state->zone[i];

    if ((unknowns & RB_NORMAL) && zone != RB_ZONE_SEPARATED && state->p[i] < 0.0)
        return RB_ZONE_SEPARATED;
    if (zone == RB_ZONE_SEPARATED) {
        if (!(unknowns & RB_NORMAL) || gap[i] >= 0.0)
            return zone;
        return rb_contact_sliding_zone(slip);
    }
    if (!(unknowns & RB_TANGENTIAL))
        return zone;
    if (zone == RB_ZONE_STICK)
        return q < -limit ? RB_ZONE_SLIP_NEGATIVE : q > limit ? RB_ZONE_SLIP_POSITIVE : zone;
    if (p->bound[i] == 0.0)
        return rb_contact_sliding_zone(slip);
    return rb_contact_slope(zone) * slip > 0.0 ? RB_ZONE_STICK : zone;
}

static int stick_count(int n, const int *zone)
{
    int sticks = 0;
    for (int i = 0; i < n; i++)
        sticks += zone[i] == RB_ZONE_STICK;
    return sticks;
}

/* A given force fixes xi only while something sticks. */
static void hold_one(const rb_contact_problem *p, const rb_contact_state *state, int *zone)
{
    if (stick_count(p->n, zone) > 0)
        return;
    /* Of several stuck elements that all want to slide, the one that wants it least. */
    int held = -1;
    double least = INFINITY;

    for (int i = 0; i < p->n; i++) {
        const double excess = fabs(state->q[i]) - p->bound[i] * state->p[i];
        if (state->zone[i] == RB_ZONE_STICK && state->p[i] > 0.0 && excess < least) {
            least = excess;
            held = i;
        }
    }
    if (held >= 0 && stick_count(p->n, state->zone) == 1) {
        /* A single stuck element that must carry too much friction of sign o: the
         * creepage has to move until the next element that slides against o comes to
         * rest. */
        const double o = state->q[held] > 0.0 ? 1.0 : -1.0;
        int next = held;
        double slowest = INFINITY;

        for (int i = 0; i < p->n; i++)
            if (state->p[i] > 0.0 && rb_contact_slope(state->zone[i]) * o < 0.0 &&
                fabs(state->lambda[i] / p->e_T[i]) < slowest) {
                slowest = fabs(state->lambda[i] / p->e_T[i]);
                next = i;
            }
        held = next;
    }
    if (held >= 0)
        zone[held] = RB_ZONE_STICK;
}

typedef struct {
    double *gap;
    int *zone, *moves;         /* corrected ones; which of them only_grow keeps */
    int *start, *best, *grown; /* the first ones; those with the fewest corrections so far, of all
                                  elements and where zones only grow */
} workspace;

/* Whether element i changes with its neighbour j where zones only grow: an open element begins to
 * touch beside a contact, one at an edge takes any zone, and others take the zone of j or the one
 * that j changes to. */
static int changes_with(const int *zone, const workspace *ws, int i, int j)
{
    const int wanted = ws->zone[i];

    return wanted != zone[i] &&
           (zone[i] == RB_ZONE_SEPARATED ? zone[j] != RB_ZONE_SEPARATED
            : zone[j] == RB_ZONE_SEPARATED
                ? 1
                : zone[j] == wanted || (ws->moves[j] && ws->zone[j] == wanted));
}

/* Takes back the corrections of elements amid a zone, so that only its limits move. */
static void only_grow(int n, const int *zone, workspace *ws)
{
    for (int i = 0; i < n; i++)
        ws->moves[i] = i > 0 && changes_with(zone, ws, i, i - 1);
    for (int i = n - 2; i >= 0; i--)
        ws->moves[i] |= changes_with(zone, ws, i, i + 1);
    for (int i = 0; i < n; i++)
        if (!ws->moves[i])
            ws->zone[i] = zone[i];
}

/* Solves and corrects until the zones stay: RB_OK; RB_MAXITER when a set of zones comes
 * back, which ends every cycle, or the corrections no longer become fewer.  best: the zones with
 * the fewest of them.  growing: corrections amid a zone wait. */
static rb_status correct_zones(rb_contact_problem *p, rb_contact_unknowns unknowns, int growing,
                               workspace *ws, int *best, rb_contact_state *state)
{
    const size_t bytes = (size_t)p->n * sizeof(int);
    uint64_t hash[MAX_STEPS];
    int least = INT_MAX, waited = 0;

    for (int step = 0; step < MAX_STEPS && waited < STALL_SWEEPS; step++) {
        int first = 0;
        hash[step] = rb_hash(RB_HASH_START, state->zone, bytes);
        while (hash[first] != hash[step])
            first++;
        if (first < step) /* seen before */
            break;
        const rb_status s = rb_contact_solve_zones(p, unknowns, state);
        if (s != RB_OK)
            return s;
        state->iterations++;
        rb_contact_kinematics(p, state, ws->gap, state->lambda);
        if (p->trace)
            p->trace(state, p->trace_context);
        int changes = 0;

        for (int i = 0; i < p->n; i++)
            ws->zone[i] = corrected_zone(p, unknowns, state, ws->gap, i);
        if (growing)
            only_grow(p->n, state->zone, ws);
        if (p->force_given && (unknowns & RB_TANGENTIAL))
            hold_one(p, state, ws->zone);
        for (int i = 0; i < p->n; i++)
            changes += ws->zone[i] != state->zone[i];
        if (changes == 0)
            return RB_OK;
        waited = unknowns == RB_BOTH && changes >= least ? waited + 1 : 0;
        if (changes < least) {
            least = changes;
            memcpy(best, state->zone, bytes);
        }
        memcpy(state->zone, ws->zone, bytes);
    }
    return RB_MAXITER;
}

/* Where both groups are unknown and the steps go round in circles, a path leads on, unless the
 * state of the last step lacks no more than rounding.  Between unlike bodies under large friction
 * single elements amid a zone open or stick in the problem of the next step, so that zones scatter:
 * from the start again only the limits of the zones move, and the path begins at the nearest zones
 * found so; else at the nearest ones of all, or at the first. */
static rb_status iterate_zones(rb_contact_problem *p, rb_contact_unknowns unknowns, workspace *ws,
                               rb_contact_state *state)
{
    const size_t bytes = (size_t)p->n * sizeof(int);
    rb_contact_violation violation;

    memcpy(ws->start, state->zone, bytes);
    rb_status s = correct_zones(p, unknowns, 0, ws, ws->best, state);
    if (s != RB_MAXITER || unknowns != RB_BOTH)
        return s;
    s = rb_contact_residual(p, state, &violation);
    if (s != RB_OK || violation.scaled <= p->rounding)
        return s == RB_OK ? RB_MAXITER : s;
    memcpy(state->zone, ws->start, bytes);
    s = correct_zones(p, unknowns, 1, ws, ws->grown, state);
    if (s == RB_MAXITER)
        memcpy(state->zone, ws->grown, bytes);
    if (s == RB_OK || s == RB_MAXITER)
        s = rb_contact_follow_path(p, state);
    const int *const others[] = {ws->best, ws->start};
    for (int k = 0; k < 2 && s > 0 && rb_contact_has_steps_left(p, state); k++) {
        memcpy(state->zone, others[k], bytes);
        s = rb_contact_follow_path(p, state);
    }
    return s;
}

/* Normal problem with the friction held, tangential problem with the pressure held, in
 * turn: exact after one round where the two are not coupled. */
static rb_status alternate(rb_contact_problem *p, int rounds, workspace *ws,
                           rb_contact_state *state)
{
    rb_status s = RB_OK;

    for (int round = 0; round < rounds && s >= 0 && s != RB_SINGULAR; round++) {
        s = iterate_zones(p, RB_NORMAL, ws, state);
        if (s >= 0 && s != RB_SINGULAR)
            s = iterate_zones(p, RB_TANGENTIAL, ws, state);
    }
    return s;
}

/* Whether friction moves the normal problem or pressure the tangential one: by what they
 * do to gaps and slips, or by friction's part of a given load. */
static int is_coupled(const rb_contact_problem *p)
{
    return p->op->response.coupled ||
           (p->load_given && rb_norm_1((size_t)p->n, p->load_T, 1) > 0.0);
}

/* From the zones of the state. */
static rb_status from_zones(rb_contact_problem *p, workspace *ws, rb_contact_state *state)
{
    return is_coupled(p) ? iterate_zones(p, RB_BOTH, ws, state) : alternate(p, 1, ws, state);
}

static void forget_factors(const rb_contact_problem *p)
{
    if (p->op->kind->forget)
        p->op->kind->forget(p->op);
}

rb_status rb_contact_newton(rb_contact_problem *problem, int warm, rb_contact_state *state)
{
    workspace ws = {.gap = rb_alloc((size_t)problem->n, 1),
                    .zone = rb_alloc_int(5 * (size_t)problem->n)};
    rb_status s = ws.gap && ws.zone ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        ws.moves = ws.zone + problem->n;
        ws.start = ws.moves + problem->n;
        ws.best = ws.start + problem->n;
        ws.grown = ws.best + problem->n;
    }
    if (s == RB_OK && warm)
        s = from_zones(problem, &ws, state);
    else if (s == RB_OK) {
        s = RB_MAXITER;
        if (problem->n >= HALVED) {
            /* From the zones and tractions of the same problem on half as many elements; its
             * steps count. */
            rb_contact_problem half = {0};
            rb_contact_state coarse = {0};
            s = rb_contact_halve(problem, &half);
            if (s == RB_OK)
                s = rb_contact_state_alloc(half.n, &coarse);
            if (s == RB_OK)
                s = rb_contact_newton(&half, 0, &coarse);
            if (s == RB_OK)
                rb_contact_start_from_half(&coarse, state);
            state->iterations += coarse.iterations;
            rb_contact_state_free(&coarse);
            rb_contact_problem_free(&half);
            if (s == RB_OK)
                s = from_zones(problem, &ws, state);
        }
        if (s > 0) {
            /* From nothing: everything in frictionless contact, to begin with.  An LU of all
             * tractions and those of one group each never take memory together: no later
             * solve would use both (memory.c). */
            memset(state->p, 0, (size_t)problem->n * sizeof(double));
            memset(state->q, 0, (size_t)problem->n * sizeof(double));
            state->delta = problem->delta;
            state->xi = problem->force_given ? 0.0 : problem->xi;
            for (int i = 0; i < problem->n; i++)
                state->zone[i] = RB_ZONE_STICK;
            forget_factors(problem);
            const int coupled = is_coupled(problem);
            s = alternate(problem, coupled ? STAGGERED_ROUNDS : 1, &ws, state);
            if (s >= 0 && coupled) {
                forget_factors(problem);
                s = iterate_zones(problem, RB_BOTH, &ws, state);
            }
        }
    }
    free(ws.gap);
    free(ws.zone);
    return s;
}

/* ---- Completed to a state ----------------------------------------------------------- */

/* What Newton has ended with, as s says.  On large contacts an element whose traction is
 * rounding may come and go: a cycle that ends in a solution is one. */
rb_status rb_contact_end_newton(rb_contact_problem *problem, const rb_contact_options *options,
                                rb_status s, rb_contact_state *state)
{
    if (s < 0)
        return s;
    state->solver = RB_SOLVER_NEWTON;
    const rb_status t = rb_contact_complete(problem, 1, state);
    s = t < 0 ? t : s;
    /* GMRES ends at a tolerance of its own; for a smaller one the matrix solves alone */
    if (s == RB_OK && !rb_contact_is_solved(s, problem, options, state) &&
        rb_contact_dense_has_products(problem->op)) {
        rb_contact_operator_add_products(problem->op, NULL);
        s = rb_contact_complete(problem, 0, state);
    }
    if (s == RB_MAXITER && problem->rounding > 0.0 &&
        rb_contact_is_solved(RB_OK, problem, options, state))
        s = RB_OK;
    return s;
}

rb_status rb_contact_by_newton(rb_contact_problem *problem, const rb_contact_options *options,
                               int warm, rb_contact_state *state)
{
    rb_phase("contact by Newton's method");
    return rb_contact_end_newton(problem, options, rb_contact_newton(problem, warm, state), state);
}
