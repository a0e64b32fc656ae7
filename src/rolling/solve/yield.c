/* The layer between the surfaces that yields, as a part of the contact problem (theory-rolling.md
 * Y1). */
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"

#include <math.h>

rb_status rb_rolling_set_yield(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                               rb_contact_problem *p, rb_message *why)
{
    const int rolls = rc->formulation == RB_STEADY,
              second = rolls && rc->slip_operator == RB_SLIP_SECOND;

    /* How far the interface has yielded where the material comes from: steadily rolled u follows
     * the slip by the difference that the local part of F_TT has (theory-rolling.md 4.10); in a
     * step it begins with what the past has left. */
    p->recall[0] = second ? 4.0 / 3.0 : rolls ? 1.0 : 0.0;
    p->recall[1] = second ? -1.0 / 3.0 : 0.0;
    p->own = second ? 2.0 / 3.0 : 1.0;
    if (rb_contact_set_yield(p, rc->yield_stress, rc->hardening) != RB_OK)
        return rb_fail(why, RB_ENOMEM, "out of memory for a contact problem of %d elements", p->n);

    /* A layer that softens has one answer to a slip only where its stress falls by less
     * than the friction that the slip sets free. */
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    double most = rb_contact_operator_response(p->op).slip, longest = 0.0;

    for (int i = 0; i < p->n; i++)
        longest = fmax(longest, bodies->f.h[i]);
    for (int i = 0; K.S && i < p->n; i++)
        most = fmax(most, K.S[i + (size_t)(p->n + i) * (size_t)p->n]);
    const double least = 1.0 / (p->own * most);
    return rc->hardening > -least
               ? RB_OK
               : rb_refuse(why, "hardening",
                           "softening by %g MPa/mm has no unique solution, "
                           "expected %g MPa/mm at most on elements of %.3g mm; shorter ones allow "
                           "more",
                           -rc->hardening, rb_largest_shown(least * (1.0 - 1e-9)), longest);
}
