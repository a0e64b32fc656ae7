/* Where the dissipated energy goes: what wear laws take. */
#include "rolling/internal.h"

void rb_rolling_friction_power(const rb_rolling_solution *s, double *power)
{
    for (int i = 0; i < s->n; i++) {
        const double before = i > 0 ? s->shift[i - 1] : 0.0;
        if (s->formulation == RB_STEADY && s->slip_operator == RB_SLIP_UPSTREAM)
            power[i] = -0.5 * (s->shift[i] + before) * s->q[i] / s->h[i];
        else
            power[i] = s->formulation == RB_STATIC ? NAN : -s->slip[i] * s->q[i];
    }
}
