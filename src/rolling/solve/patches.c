/* Where the contact begins and ends: its patches and their edges (theory-solvers.md 5.1). */
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"

#include <gsl/gsl_math.h>

/* An exponent of the pressure at an edge below which it is steep there. */
static const double STEEP = 0.45;

double rb_rolling_edge_exponent(const rb_rolling_case *rc, double length,
                                const rb_contact_state *state, int j, int side)
{
    const int inner = j - side, n = state->n,
              slides = rb_rolling_is_at_bound(n, state->zone, state->p, state->q, j) &&
                       rb_rolling_is_at_bound(n, state->zone, state->p, state->q, inner) &&
                       (state->zone[j] == state->zone[inner] || state->zone[j] == RB_ZONE_STICK ||
                        state->zone[inner] == RB_ZONE_STICK) &&
                       state->q[inner] * state->q[j] > 0.0;
    const double beta = rb_rolling_derive(rc).dundurs;

    return rb_rolling_interlayer_is_soft(rc, length) ? 1.0
           : slides ? 0.5 + side * atan(beta * state->q[j] / state->p[j]) / M_PI
                    : 0.5;
}

/* 1: the contact goes on at the other end of a period, or ends with the punch. */
static int ends_with_mesh(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                          const rb_contact_state *state, int open)
{
    const int goes_on = rb_rolling_fills_period(rc, mesh) && state->zone[0] != RB_ZONE_SEPARATED &&
                        state->zone[mesh->n - 1] != RB_ZONE_SEPARATED;
    return (open < 0 || open >= mesh->n) && (goes_on || rc->mesh == RB_MESH_PUNCH);
}

/* The edge of the run whose outermost element on that side is `outer`.  This element is
 * only partly in contact, so the power law goes through the next two, or where it is
 * steep through the two behind its neighbour, which then is disturbed too.  Contact is
 * decided at midpoints: the edge lies between those of the last loaded and of the first
 * open element.  run->bounded: set where this interval is all that is known, because p
 * does not fall or the power law misses the interval by more than its length. */
static double edge(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                   const rb_contact_state *state, int side, rb_rolling_run *run)
{
    const int bounded = side < 0 ? RB_LEFT_BOUNDED : RB_RIGHT_BOUNDED;
    const int outer = side > 0 ? run->last : run->first, open = outer + side;
    const double end = mesh->ends[side > 0 ? outer + 1 : outer];
    const double nearest = rb_rolling_midpoint(mesh, outer);
    const double farthest = open >= 0 && open < mesh->n ? rb_rolling_midpoint(mesh, open) : end;
    int j = outer - side;

    if (ends_with_mesh(rc, mesh, state, open))
        return end;
    if (run->last - run->first + 1 < RB_ROLLING_PATCH_LEAST) {
        run->bounded |= bounded;
        return end;
    }
    /* i, j: elements near the edge. */
    const double exponent =
        rb_rolling_edge_exponent(rc, mesh->ends[j + 1] - mesh->ends[j], state, j, side);
    if (exponent < STEEP)
        j -= side;
    if (!(state->p[j] < state->p[j - side])) {
        run->bounded |= bounded;
        return end;
    }
    /* Where the power law through elements i and j, the outer one, reaches zero. */
    const int i = j - side;
    const double fall = pow(state->p[j] / state->p[i], 1.0 / exponent);

    const double x =
        rb_rolling_midpoint(mesh, j) +
        (rb_rolling_midpoint(mesh, j) - rb_rolling_midpoint(mesh, i)) * fall / (1.0 - fall);
    const double off = fmax(side * (nearest - x), side * (x - farthest));
    if (off > fabs(farthest - nearest))
        run->bounded |= bounded;
    return side > 0 ? fmin(fmax(x, nearest), farthest) : fmax(fmin(x, nearest), farthest);
}

int rb_rolling_next_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                          const rb_contact_state *state, int at, rb_rolling_run *run)
{
    while (at < state->n && state->zone[at] == RB_ZONE_SEPARATED)
        at++;
    if (at >= state->n)
        return 0;
    *run = (rb_rolling_run){.first = at};
    while (at < state->n && state->zone[at] != RB_ZONE_SEPARATED)
        at++;
    run->last = at - 1;
    const int length = at - run->first;
    if (rc->mesh == RB_MESH_ALIGNED && length >= RB_ROLLING_ALIGNED_LEAST) {
        run->from = rb_rolling_aligned_edge(rc, mesh, state->p, run->first, -1);
        run->to = rb_rolling_aligned_edge(rc, mesh, state->p, run->last, 1);
        return 1;
    }
    run->from = edge(rc, mesh, state, -1, run);
    run->to = edge(rc, mesh, state, 1, run);
    return 1;
}

int rb_rolling_next_merged_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                 const rb_contact_state *state, int at, rb_rolling_run *run)
{
    /* Where A slides, F_NN - mu F_NT of (K5) has its largest entries beside the diagonal,
     * not on it, once mu beta > 1 or so: every other element opens, however small they
     * are. */
    const int one_place = rb_rolling_is_convex(rc), alternates = rb_rolling_mu_beta(rc) > 1.0;
    rb_rolling_run next;

    if (!rb_rolling_next_patch(rc, mesh, state, at, run))
        return 0;
    while (rb_rolling_next_patch(rc, mesh, state, run->last + 1, &next) &&
           (one_place || (alternates && next.first == run->last + 2))) {
        run->last = next.last;
        run->to = next.to;
    }
    return 1;
}

void rb_rolling_contact_edges(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              const rb_contact_state *state, double *from, double *to)
{
    rb_rolling_run run = {.last = -1};

    *from = *to = NAN;
    for (int at = 0; rb_rolling_next_patch(rc, mesh, state, at, &run); at = run.last + 1) {
        if (isnan(*from))
            *from = run.from;
        *to = run.to;
    }
}
