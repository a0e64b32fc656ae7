/* The linear equations of given zones (5.2): in each element that touches the gap is zero, and its
 * slip is zero or its friction at the bound.  Newton's method and the search for zones solve them.
 */
#include "lcp/contact/internal.h"

#include <cblas.h>
#include <string.h>

void rb_contact_reduced_free(rb_contact_reduced *r)
{
    rb_arena_free(&r->memory);
}

rb_status rb_contact_reduced_alloc(const rb_contact_problem *p, rb_contact_unknowns unknowns,
                                   const rb_contact_state *state, rb_contact_reduced *r)
{
    const int *zone = state->zone;
    const size_t n = (size_t)p->n;

    memset(r, 0, sizeof *r);
    r->unknowns = unknowns;
    r->contact = rb_arena_ints(&r->memory, n);
    r->stick = rb_arena_ints(&r->memory, n);
    r->control_N = rb_arena_doubles(&r->memory, n, 1);
    r->control_T = rb_arena_doubles(&r->memory, n, 1);
    r->gap = rb_arena_doubles(&r->memory, n, 1);
    r->lambda = rb_arena_doubles(&r->memory, n, 1);
    if (r->memory.failed)
        return RB_ENOMEM;
    /* Unknown: the pressure where the zone is not open, the friction where it is stick. */
    for (int i = 0; i < p->n; i++) {
        if ((unknowns & RB_NORMAL) && zone[i] != RB_ZONE_SEPARATED)
            r->contact[r->contacts++] = i;
        if ((unknowns & RB_TANGENTIAL) && zone[i] == RB_ZONE_STICK)
            r->stick[r->sticks++] = i;
    }
    r->force_scale = rb_contact_force_scale(p);
    r->load = (unknowns & RB_NORMAL) && p->load_given;
    r->force = (unknowns & RB_TANGENTIAL) && p->force_given;
    r->size = r->contacts + r->sticks + r->load + r->force;
    r->start = rb_arena_doubles(&r->memory, (size_t)r->size, 1);
    r->x = rb_arena_doubles(&r->memory, (size_t)r->size, 1);
    if (r->memory.failed)
        return RB_ENOMEM;
    int k = 0;

    for (int c = 0; c < r->contacts; c++)
        r->start[k++] = state->p[r->contact[c]] / p->stress;
    for (int c = 0; c < r->sticks; c++)
        r->start[k++] = state->q[r->stick[c]] / p->stress;
    if (r->load) /* unknown to begin with: NAN */
        r->start[k++] = isfinite(state->delta) ? state->delta / p->gap_length : 0.0;
    if (r->force)
        r->start[k] = state->xi * p->e_T[0] / p->slip_length;
    rb_contact_force_row(p, r->control_N, r->control_T);
    return RB_OK;
}

void rb_contact_reduced_clear(const rb_contact_problem *p, const rb_contact_reduced *r,
                              rb_contact_state *state)
{
    for (int i = 0; i < p->n; i++) {
        const int zone = state->zone[i];
        if ((r->unknowns & RB_NORMAL) || zone == RB_ZONE_SEPARATED)
            state->p[i] = 0.0;
        if ((r->unknowns & RB_TANGENTIAL) || zone == RB_ZONE_SEPARATED)
            state->q[i] = rb_contact_slope(zone) * p->bound[i] * state->p[i];
    }
    if (r->unknowns & RB_NORMAL)
        state->delta = p->load_given ? 0.0 : p->delta;
    if (r->unknowns & RB_TANGENTIAL)
        state->xi = p->force_given ? 0.0 : p->xi;
}

double rb_contact_reduced_force_lacks(const rb_contact_problem *p, const rb_contact_state *state,
                                      const rb_contact_reduced *r)
{
    return !r->force ? 0.0
                     : fabs(p->force - cblas_ddot(p->n, r->control_N, 1, state->p, 1) -
                            cblas_ddot(p->n, r->control_T, 1, state->q, 1)) /
                           r->force_scale;
}

void rb_contact_reduced_right_side(const rb_contact_problem *p, const rb_contact_state *state,
                                   rb_contact_reduced *r)
{
    int row = 0;

    /* The gap of each element in contact (K1), the slip of each one in stick (K2), the given load
     * and force (4.6): what of them is left is to vanish. */
    rb_contact_kinematics(p, state, r->gap, r->lambda);
    for (int k = 0; k < r->contacts; k++)
        r->x[row++] = -r->gap[r->contact[k]] / p->gap_length;
    for (int k = 0; k < r->sticks; k++)
        r->x[row++] = -r->lambda[r->stick[k]] / p->slip_length;
    if (r->load)
        r->x[row++] = 1.0 - rb_contact_load(p, state) / p->load;
    if (r->force)
        r->x[row] = (p->force - cblas_ddot(p->n, r->control_N, 1, state->p, 1) -
                     cblas_ddot(p->n, r->control_T, 1, state->q, 1)) /
                    r->force_scale;
}

rb_status rb_contact_reduced_add(const rb_contact_problem *p, const rb_contact_reduced *r,
                                 rb_contact_state *state)
{
    int row = 0;

    for (int i = 0; i < r->size; i++)
        if (!isfinite(r->x[i]))
            return RB_SINGULAR;

    /* Where an element slides its friction follows the pressure, |q| = bound p (K3). */
    for (int k = 0; k < r->contacts; k++) {
        const int i = r->contact[k];
        state->p[i] += p->stress * r->x[row++];
        if (r->unknowns == RB_BOTH && state->zone[i] != RB_ZONE_STICK)
            state->q[i] = rb_contact_slope(state->zone[i]) * p->bound[i] * state->p[i];
    }
    for (int k = 0; k < r->sticks; k++)
        state->q[r->stick[k]] += p->stress * r->x[row++];
    if (r->load)
        state->delta += p->gap_length * r->x[row++];
    if (r->force)
        state->xi += p->slip_length / p->e_T[0] * r->x[row];
    return RB_OK;
}

/* ---- Given zones ------------------------------------------------------------------- */

rb_status rb_contact_solve_zones(rb_contact_problem *problem, rb_contact_unknowns unknowns,
                                 rb_contact_state *state)
{
    rb_contact_reduced r;
    rb_status s = rb_interrupted() ? RB_INTERRUPTED : RB_OK;

    if (s != RB_OK)
        return s;
    s = rb_contact_reduced_alloc(problem, unknowns, state, &r);

    if (s == RB_OK)
        s = problem->op->kind->solve(problem, state, &r);
    rb_contact_reduced_free(&r);
    return s;
}

rb_status rb_contact_try_zones(rb_contact_problem *problem, rb_contact_state *state, double *gap)
{
    const rb_status s = rb_contact_solve_zones(problem, RB_BOTH, state);
    if (s == RB_OK)
        rb_contact_kinematics(problem, state, gap, state->lambda);
    return s;
}
