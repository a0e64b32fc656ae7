/* Active sets: with every element's zone known the contact problem is linear.  Newton's
 * method for the piecewise linear problem is to solve, to correct the zones and to solve
 * again; the same solve polishes what Lemke found. */
#include "rolling/internal.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_STEPS = 60 };

/* r_T = slope mu r_N of a zone; 0 in stick, where r_T is an unknown of its own. */
static double slope(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE   ? -1.0
           : zone == RB_ZONE_SLIP_POSITIVE ? 1.0
                                           : 0.0;
}

/* Unknowns of the reduced system: r_N of the elements in contact, r_T of those in stick,
 * delta and xi where they are not given. */
typedef struct {
    int contacts, sticks, size;
    int *contact, *stick;          /* element numbers */
    double *control_N, *control_T; /* n: row of the given force */
    double *A, *x;                 /* size x size, size */
    lapack_int *pivots;
} reduced;

static void reduced_free(reduced *r)
{
    free(r->contact);
    free(r->stick);
    free(r->control_N);
    free(r->control_T);
    free(r->A);
    free(r->x);
    free(r->pivots);
}

static rb_status reduced_alloc(const rb_rolling_problem *p, const int *zone, reduced *r)
{
    memset(r, 0, sizeof *r);
    r->contact = rb_alloc_int((size_t)p->n);
    r->stick = rb_alloc_int((size_t)p->n);
    r->control_N = rb_alloc((size_t)p->n, 1);
    r->control_T = rb_alloc((size_t)p->n, 1);
    if (!r->contact || !r->stick || !r->control_N || !r->control_T)
        return RB_ENOMEM;
    rb_rolling_force_row(p, r->control_N, r->control_T);
    for (int i = 0; i < p->n; i++) {
        if (zone[i] != RB_ZONE_SEPARATED)
            r->contact[r->contacts++] = i;
        if (zone[i] == RB_ZONE_STICK)
            r->stick[r->sticks++] = i;
    }
    r->size = r->contacts + r->sticks + p->load_given + p->force_given;
    r->A = rb_alloc((size_t)r->size, (size_t)r->size);
    r->x = rb_alloc((size_t)r->size, 1);
    r->pivots = calloc((size_t)r->size + 1, sizeof *r->pivots);
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
    if (p->load_given)
        column[row++] = (t_N * p->load_N[j] + t_T * p->load_T[j]) * p->stress / p->load;
    if (p->force_given)
        column[row++] =
            (t_N * r->control_N[j] + t_T * r->control_T[j]) * p->stress / force_scale(p);
}

static void reduced_matrix(const rb_rolling_problem *p, const int *zone, reduced *r)
{
    const size_t size = (size_t)r->size;
    double *column = r->A;

    for (int k = 0; k < r->contacts; k++, column += size) {
        const int j = r->contact[k];
        traction_column(p, r, j, 1.0, slope(zone[j]) * p->mu, column);
    }
    for (int k = 0; k < r->sticks; k++, column += size)
        traction_column(p, r, r->stick[k], 0.0, 1.0, column);
    if (p->load_given) {
        for (int k = 0; k < r->contacts; k++)
            column[k] = -1.0;
        column += size;
    }
    if (p->force_given)
        for (int k = 0; k < r->sticks; k++)
            column[r->contacts + k] = p->e_T[r->stick[k]] / p->e_T[0];
}

static void reduced_right_side(const rb_rolling_problem *p, reduced *r)
{
    const double delta = p->load_given ? 0.0 : p->delta,
                 xi = p->force_given ? 0.0 : p->xi;
    int row = 0;

    for (int k = 0; k < r->contacts; k++)
        r->x[row++] = (delta - p->d_N[r->contact[k]]) / p->gap_length;
    for (int k = 0; k < r->sticks; k++) {
        const int i = r->stick[k];
        r->x[row++] = -(p->d_T[i] + xi * p->e_T[i]) / p->slip_length;
    }
    if (p->load_given)
        r->x[row++] = 1.0;
    if (p->force_given)
        r->x[row++] = p->force / force_scale(p);
}

static void reduced_result(const rb_rolling_problem *p, const reduced *r,
                           rb_rolling_state *state)
{
    int row = 0;

    memset(state->p, 0, (size_t)p->n * sizeof(double));
    memset(state->q, 0, (size_t)p->n * sizeof(double));
    for (int k = 0; k < r->contacts; k++) {
        const int i = r->contact[k];
        state->p[i] = p->stress * r->x[row++];
        state->q[i] = slope(state->zone[i]) * p->mu * state->p[i];
    }
    for (int k = 0; k < r->sticks; k++)
        state->q[r->stick[k]] = p->stress * r->x[row++];
    state->delta = p->load_given ? p->gap_length * r->x[row++] : p->delta;
    state->xi = p->force_given ? p->slip_length / p->e_T[0] * r->x[row++] : p->xi;
}

static int is_finite(int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]))
            return 0;
    return 1;
}

rb_status rb_rolling_solve_zones(const rb_rolling_problem *problem,
                                 rb_rolling_state *state)
{
    reduced r;
    rb_status s = reduced_alloc(problem, state->zone, &r);

    if (s == RB_OK && r.size > 0) {
        reduced_matrix(problem, state->zone, &r);
        reduced_right_side(problem, &r);
        const lapack_int fault = LAPACKE_dgesv(LAPACK_COL_MAJOR, r.size, 1, r.A, r.size,
                                               r.pivots, r.x, r.size);
        if (fault != 0 || !is_finite(r.size, r.x))
            s = RB_SINGULAR;
    }
    if (s == RB_OK)
        reduced_result(problem, &r, state);
    reduced_free(&r);
    return s;
}

/* ---- Newton ------------------------------------------------------------------------ */

static int corrected_zone(const rb_rolling_problem *p, const rb_rolling_state *state,
                          const double *gap, int i)
{
    const double limit = p->mu * state->p[i], q = state->q[i], slip = state->lambda[i];

    switch (state->zone[i]) {
    case RB_ZONE_SEPARATED:
        if (gap[i] >= 0.0)
            return RB_ZONE_SEPARATED;
        return slip >= 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE;
    case RB_ZONE_SLIP_NEGATIVE:
        return state->p[i] < 0.0             ? RB_ZONE_SEPARATED
               : slip >= 0.0 || p->mu == 0.0 ? RB_ZONE_SLIP_NEGATIVE
                                             : RB_ZONE_STICK;
    case RB_ZONE_SLIP_POSITIVE:
        return state->p[i] < 0.0             ? RB_ZONE_SEPARATED
               : slip <= 0.0 || p->mu == 0.0 ? RB_ZONE_SLIP_POSITIVE
                                             : RB_ZONE_STICK;
    default:
        return state->p[i] < 0.0 ? RB_ZONE_SEPARATED
               : q < -limit      ? RB_ZONE_SLIP_NEGATIVE
               : q > limit       ? RB_ZONE_SLIP_POSITIVE
                                 : RB_ZONE_STICK;
    }
}

/* Returns how many zones changed. */
static int correct_zones(const rb_rolling_problem *p, rb_rolling_state *state,
                         const double *gap)
{
    int changes = 0;
    for (int i = 0; i < p->n; i++) {
        const int zone = corrected_zone(p, state, gap, i);
        changes += zone != state->zone[i];
        state->zone[i] = zone;
    }
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

rb_status rb_rolling_newton(const rb_rolling_problem *problem, rb_rolling_state *state)
{
    uint64_t seen[MAX_STEPS];
    double *gap = rb_alloc((size_t)problem->n, 1);
    rb_status s = gap ? RB_MAXITER : RB_ENOMEM;

    for (int step = 0; step < MAX_STEPS && s == RB_MAXITER; step++) {
        const uint64_t hash = fingerprint(problem->n, state->zone);
        if (seen_before(step, seen, hash))
            break;
        seen[step] = hash;
        s = rb_rolling_solve_zones(problem, state);
        if (s != RB_OK)
            break;
        state->iterations++;
        rb_rolling_kinematics(problem, state, gap, state->lambda);
        s = correct_zones(problem, state, gap) ? RB_MAXITER : RB_OK;
    }
    free(gap);
    return s;
}
