/* Active sets: with every element's zone known the contact problem is linear.  Newton's
 * method for the piecewise linear problem is to solve, to correct the zones and to solve
 * again; the same solve polishes what Lemke found. */
#include "rolling/internal.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 60, STAGGERED_ROUNDS = 3 };

/* r_T = slope mu r_N of a zone; 0 in stick, where r_T is an unknown of its own. */
static double slope(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE   ? -1.0
           : zone == RB_ZONE_SLIP_POSITIVE ? 1.0
                                           : 0.0;
}

/* Unknowns of the reduced system: r_N of the elements in contact and delta, r_T of those
 * in stick and xi; or one of these two groups alone, the other held fixed. */
typedef struct {
    rb_rolling_unknowns unknowns;
    int contacts, sticks, load, force, size;
    int *contact, *stick;          /* element numbers */
    double *control_N, *control_T; /* n: row of the given force */
    double *gap, *lambda;          /* n: with the unknowns at zero */
    double *A, *x;                 /* size x size, size */
    lapack_int *pivots;
} reduced;

static void reduced_free(reduced *r)
{
    free(r->contact);
    free(r->stick);
    free(r->control_N);
    free(r->control_T);
    free(r->gap);
    free(r->lambda);
    free(r->A);
    free(r->x);
    free(r->pivots);
}

static rb_status reduced_alloc(const rb_rolling_problem *p, const int *zone,
                               rb_rolling_unknowns unknowns, reduced *r)
{
    const size_t n = (size_t)p->n;

    memset(r, 0, sizeof *r);
    r->unknowns = unknowns;
    r->contact = rb_alloc_int(n);
    r->stick = rb_alloc_int(n);
    r->control_N = rb_alloc(n, 1);
    r->control_T = rb_alloc(n, 1);
    r->gap = rb_alloc(n, 1);
    r->lambda = rb_alloc(n, 1);
    if (!r->contact || !r->stick || !r->control_N || !r->control_T || !r->gap ||
        !r->lambda)
        return RB_ENOMEM;
    for (int i = 0; i < p->n; i++) {
        if ((unknowns & RB_NORMAL) && zone[i] != RB_ZONE_SEPARATED)
            r->contact[r->contacts++] = i;
        if ((unknowns & RB_TANGENTIAL) && zone[i] == RB_ZONE_STICK)
            r->stick[r->sticks++] = i;
    }
    r->load = (unknowns & RB_NORMAL) && p->load_given;
    r->force = (unknowns & RB_TANGENTIAL) && p->force_given;
    r->size = r->contacts + r->sticks + r->load + r->force;
    r->A = rb_alloc((size_t)r->size, (size_t)r->size);
    r->x = rb_alloc((size_t)r->size, 1);
    r->pivots = calloc((size_t)r->size + 1, sizeof *r->pivots);
    rb_rolling_force_row(p, r->control_N, r->control_T);
    return r->A && r->x && r->pivots ? RB_OK : RB_ENOMEM;
}

static double force_scale(const rb_rolling_problem *p)
{
    return p->mu * p->stress * cblas_dasum(p->n, p->load_N, 1);
}

/* One column: the answers of gaps, slips, load and force to a unit of an unknown that
 * stands for tractions (t_N, t_T) at element j. */
static void traction_column(const rb_rolling_problem *p, const reduced *r, int j,
                            double t_N, double t_T, double *column)
{
    const double *F_N = p->F + (size_t)j * p->ldf, *F_T = F_N + (size_t)p->n * p->ldf;
    const double *S_N = p->S + (size_t)j * p->n, *S_T = S_N + (size_t)p->n * p->n;
    const double gap = p->stress / p->gap_length, slip = p->stress / p->slip_length;
    int row = 0;

    for (int k = 0; k < r->contacts; k++, row++)
        column[row] = gap * (t_N * F_N[r->contact[k]] + t_T * F_T[r->contact[k]]);
    for (int k = 0; k < r->sticks; k++, row++)
        column[row] = slip * (t_N * S_N[r->stick[k]] + t_T * S_T[r->stick[k]]);
    if (r->load)
        column[row++] = (t_N * p->load_N[j] + t_T * p->load_T[j]) * p->stress / p->load;
    if (r->force)
        column[row] =
            (t_N * r->control_N[j] + t_T * r->control_T[j]) * p->stress / force_scale(p);
}

/* Where both groups are unknown, friction of a slipping element follows its pressure. */
static void reduced_matrix(const rb_rolling_problem *p, const int *zone, reduced *r)
{
    const size_t size = (size_t)r->size;
    const double coupled = r->unknowns == RB_BOTH ? p->mu : 0.0;
    double *column = r->A;

    for (int k = 0; k < r->contacts; k++, column += size) {
        const int j = r->contact[k];
        traction_column(p, r, j, 1.0, slope(zone[j]) * coupled, column);
    }
    for (int k = 0; k < r->sticks; k++, column += size)
        traction_column(p, r, r->stick[k], 0.0, 1.0, column);
    if (r->load) {
        for (int k = 0; k < r->contacts; k++)
            column[k] = -1.0;
        column += size;
    }
    if (r->force)
        for (int k = 0; k < r->sticks; k++)
            column[r->contacts + k] = p->e_T[r->stick[k]] / p->e_T[0];
}

/* Sets the unknowns of the state to zero and the friction of slipping elements to its
 * bound; what is left is the right-hand side. */
static void clear_unknowns(const rb_rolling_problem *p, const reduced *r,
                           rb_rolling_state *state)
{
    for (int i = 0; i < p->n; i++) {
        const int zone = state->zone[i];
        if ((r->unknowns & RB_NORMAL) || zone == RB_ZONE_SEPARATED)
            state->p[i] = 0.0;
        if ((r->unknowns & RB_TANGENTIAL) || zone == RB_ZONE_SEPARATED)
            state->q[i] = slope(zone) * p->mu * state->p[i];
    }
    if (r->unknowns & RB_NORMAL)
        state->delta = p->load_given ? 0.0 : p->delta;
    if (r->unknowns & RB_TANGENTIAL)
        state->xi = p->force_given ? 0.0 : p->xi;
}

static void reduced_right_side(const rb_rolling_problem *p, const rb_rolling_state *state,
                               reduced *r)
{
    int row = 0;

    rb_rolling_kinematics(p, state, r->gap, r->lambda);
    for (int k = 0; k < r->contacts; k++)
        r->x[row++] = -r->gap[r->contact[k]] / p->gap_length;
    for (int k = 0; k < r->sticks; k++)
        r->x[row++] = -r->lambda[r->stick[k]] / p->slip_length;
    if (r->load)
        r->x[row++] = 1.0 - cblas_ddot(p->n, p->load_T, 1, state->q, 1) / p->load;
    if (r->force)
        r->x[row] = (p->force - cblas_ddot(p->n, r->control_N, 1, state->p, 1) -
                     cblas_ddot(p->n, r->control_T, 1, state->q, 1)) /
                    force_scale(p);
}

static void reduced_result(const rb_rolling_problem *p, const reduced *r,
                           rb_rolling_state *state)
{
    int row = 0;

    for (int k = 0; k < r->contacts; k++) {
        const int i = r->contact[k];
        state->p[i] = p->stress * r->x[row++];
        if (r->unknowns == RB_BOTH)
            state->q[i] = slope(state->zone[i]) * p->mu * state->p[i];
    }
    for (int k = 0; k < r->sticks; k++)
        state->q[r->stick[k]] = p->stress * r->x[row++];
    if (r->load)
        state->delta = p->gap_length * r->x[row++];
    if (r->force)
        state->xi = p->slip_length / p->e_T[0] * r->x[row];
}

static int is_finite(int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return 0;
    return 1;
}

rb_status rb_rolling_solve_zones(const rb_rolling_problem *problem,
                                 rb_rolling_unknowns unknowns, rb_rolling_state *state)
{
    reduced r;
    rb_status s = reduced_alloc(problem, state->zone, unknowns, &r);

    if (s == RB_OK) {
        clear_unknowns(problem, &r, state);
        reduced_matrix(problem, state->zone, &r);
        reduced_right_side(problem, state, &r);
        const lapack_int fault = r.size == 0
                                     ? 0
                                     : LAPACKE_dgesv(LAPACK_COL_MAJOR, r.size, 1, r.A,
                                                     r.size, r.pivots, r.x, r.size);
        if (fault != 0 || !is_finite(r.size, r.x))
            s = RB_SINGULAR;
    }
    if (s == RB_OK)
        reduced_result(problem, &r, state);
    reduced_free(&r);
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
    return slope(zone) * slip > 0.0 ? RB_ZONE_STICK : zone;
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
        if (state->p[i] > 0.0 && slope(state->zone[i]) * o < 0.0 &&
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
static rb_status iterate(const rb_rolling_problem *p, rb_rolling_unknowns unknowns,
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
static rb_status alternate(const rb_rolling_problem *p, int rounds, workspace *ws,
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

rb_status rb_rolling_newton(const rb_rolling_problem *problem, int warm,
                            rb_rolling_state *state)
{
    workspace ws = {rb_alloc((size_t)problem->n, 1), rb_alloc_int((size_t)problem->n)};
    rb_status s = ws.gap && ws.zone ? RB_OK : RB_ENOMEM;

    if (s == RB_OK && !warm)
        cold_start(problem, state);
    if (s == RB_OK && (!warm || !problem->coupled))
        s = alternate(problem, problem->coupled ? STAGGERED_ROUNDS : 1, &ws, state);
    if (s >= 0 && problem->coupled)
        s = iterate(problem, RB_BOTH, &ws, state);
    free(ws.gap);
    free(ws.zone);
    return s;
}
