/* Elements that slide or yield, and those that stick with all that they carry: where elements slide
 * towards both sides and no more is held, a given force does not tell the motion. */
#include "rolling/rolling.h"
#include "rolling/solve/law.h"
#include "rolling/solve/zone.h"

#include <math.h>

int rb_rolling_carries_more_with_slip(const rb_rolling_case *rc)
{
    return rc->yield_stress > 0.0 && rc->hardening != 0.0;
}

int rb_rolling_count_at_bound(const rb_rolling_case *rc, int n, const int *zone, const double *p,
                              const double *q, const double *mu, double one)
{
    const double at_bound = 1.0 - 1e-9, most = rc->yield_stress > 0.0 ? rc->yield_stress : INFINITY;
    int count = 0;

    for (int i = 0; i < n; i++)
        count += zone[i] == RB_ZONE_STICK &&
                 fabs(q[i]) >= at_bound * fmin((mu ? mu[i] : one) * p[i], most);
    return count;
}

int rb_rolling_slips_both_ways(int n, const int *zone)
{
    int negative = 0, positive = 0;

    for (int i = 0; i < n; i++) {
        negative |= zone[i] == RB_ZONE_SLIP_NEGATIVE || zone[i] == RB_ZONE_YIELD_NEGATIVE;
        positive |= zone[i] == RB_ZONE_SLIP_POSITIVE || zone[i] == RB_ZONE_YIELD_POSITIVE;
    }
    return negative && positive;
}

rb_status rb_rolling_take_middle(const rb_rolling_case *rc, const rb_contact_problem *p,
                                 rb_contact_state *state)
{
    double up = INFINITY, down = INFINITY; /* as far as the motion leaves all of them slide */
    int stick = 0;

    for (int i = 0; i < state->n; i++) {
        stick += state->zone[i] == RB_ZONE_STICK;
        if (state->zone[i] == RB_ZONE_SEPARATED || state->q[i] == 0.0)
            continue;
        const double slip = state->lambda[i] / p->e_T[i];
        if (state->q[i] > 0.0)
            up = fmin(up, fmax(-slip, 0.0));
        else
            down = fmin(down, fmax(slip, 0.0));
    }
    if (!p->force_given || p->yield || rb_rolling_law_depends_on_state(rc) ||
        !rb_rolling_slips_both_ways(state->n, state->zone) || !(up + down > 0.0) ||
        stick > rb_rolling_count_at_bound(rc, state->n, state->zone, state->p, state->q, p->bound,
                                          p->mu))
        return RB_OK;
    const double move = 0.5 * (up - down);
    rb_contact_violation v = {.scaled = NAN};

    state->xi += move;
    for (int i = 0; i < state->n; i++) {
        state->lambda[i] += move * p->e_T[i];
        if (state->zone[i] == RB_ZONE_STICK && state->q[i] != 0.0)
            state->zone[i] = state->q[i] < 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE;
    }
    const rb_status s = rb_contact_residual(p, state, &v);
    state->residual = v.scaled;
    return s;
}
