/* The layer between the surfaces that yields (theory-rolling.md, Y1): its yield stress and the
 * plastic slip that is accumulated along the contact, u_i = recall[0] u_i+1 + recall[1] u_i+2 + own
 * s_i. */
#include "lcp/contact/lcp_order.h"

#include <math.h>

rb_status rb_contact_set_yield(rb_contact_problem *p, double stress, double hardening)
{
    if (!p->yield)
        p->yield = rb_alloc((size_t)p->n, 1);
    if (!p->yield)
        return RB_ENOMEM;
    for (int i = 0; i < p->n; i++)
        p->yield[i] = stress;
    p->hardening = hardening;
    return RB_OK;
}

void rb_contact_yielded(const rb_contact_problem *p, const double *plastic, const int *zone,
                        double *u)
{
    double next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) {
        const double size = !zone || zone[i] <= RB_ZONE_STICK ? fabs(plastic[i])
                            : zone[i] == RB_ZONE_SLIP_POSITIVE || zone[i] == RB_ZONE_YIELD_POSITIVE
                                ? -plastic[i]
                                : plastic[i];
        u[i] = p->recall[0] * next + p->recall[1] * second + p->own * size;
        second = next;
        next = u[i];
    }
}

int rb_contact_slips_and_yields(const rb_contact_problem *p, const rb_contact_state *state, int i)
{
    return p->yield && state->plastic[i] != 0.0 &&
           (state->zone[i] == RB_ZONE_SLIP_NEGATIVE || state->zone[i] == RB_ZONE_SLIP_POSITIVE);
}

void rb_contact_set_plastic(const rb_contact_problem *p, rb_contact_state *state, double *u)
{
    double next = 0.0, second = 0.0;

    for (int i = p->n - 1; i >= 0; i--) { /* upstream first */
        const int zone = state->zone[i],
                  positive = zone == RB_ZONE_SLIP_POSITIVE || zone == RB_ZONE_YIELD_POSITIVE;
        const double before = p->recall[0] * next + p->recall[1] * second,
                     against = positive ? -1.0 : 1.0;
        double own = 0.0;
        if (zone > RB_ZONE_SLIP_POSITIVE)
            own = against * state->lambda[i];
        else if (p->hardening != 0.0 && rb_contact_slips_and_yields(p, state, i))
            own = ((p->bound[i] * state->p[i] - p->yield[i]) / p->hardening - before) / p->own;
        state->plastic[i] = against * own;
        second = next;
        next = before + p->own * own;
        if (u)
            u[i] = next;
    }
}

double rb_contact_yield_stress(const rb_contact_problem *p, int i, double u)
{
    return p->yield ? fmax(p->yield[i] + p->hardening * u, 0.0) : INFINITY;
}

/* ---- In the LCP --------------------------------------------------------------------- */

/* s+ and s- take their parts of o T_T lambda, o r_T = gamma - mu r_N; and yield +
 * hardening u, u from the unit plastic slips of each element j. */
void rb_contact_lcp_add_yield(const rb_contact_problem *p, rb_contact_lcp *lcp)
{
    const size_t n = (size_t)p->n, ld = (size_t)lcp->size;

    for (size_t i = 0; i < n; i++)
        for (int sign = 0; sign < 2; sign++) {
            const double o = sign ? -1.0 : 1.0;
            const size_t k = (size_t)rb_contact_yield_index(p, (int)i, sign);
            lcp->M[n + i + k * ld] = -o;
            lcp->M[k + (n + i) * ld] = o;
            lcp->M[k + i * ld] = -o * p->bound[i];
        }
    for (int j = 0; j < p->n; j++) {
        double u = p->own, next = 0.0;
        for (int i = j; i >= 0 && u != 0.0; i--) {
            for (int k = 0; k < 4; k++)
                lcp->M[rb_contact_yield_index(p, i, k % 2) +
                       (size_t)rb_contact_yield_index(p, j, k / 2) * ld] += p->hardening * u;
            const double before = p->recall[0] * u + p->recall[1] * next;
            next = u;
            u = before;
        }
        for (int sign = 0; sign < 2; sign++)
            lcp->b[rb_contact_yield_index(p, j, sign)] += p->yield[j];
    }
}
