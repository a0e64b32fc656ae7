/* Whether the bodies are alike, so that pressure and friction do not couple, and whether Carter's
 * solution holds (6). */
#include "rolling/body/body.h"
#include "rolling/case/internal.h"

#include <math.h>

/* 1: the bodies answer alike to the same tractions, but for a rigid displacement. */
static int are_alike(const rb_rolling_body *a, const rb_rolling_body *b)
{
    int alike = a->support == b->support && a->young == b->young && a->poisson == b->poisson &&
                a->layer == b->layer && a->stack == b->stack && a->cover == b->cover &&
                a->memory.n == b->memory.n;

    if (a->layer > 0.0)
        alike &= a->base_young == b->base_young && a->base_poisson == b->base_poisson &&
                 a->layer_base == b->layer_base;
    if (a->cover > 0.0)
        alike &= a->core_young == b->core_young && a->core_poisson == b->core_poisson;
    if (a->support != RB_BEM_HALFPLANE)
        alike &= a->radius == b->radius && a->arc == b->arc && a->hub_ratio == b->hub_ratio;
    for (int k = 0; alike && k < a->memory.n; k++)
        alike = a->memory.time[k] == b->memory.time[k] && a->memory.ratio[k] == b->memory.ratio[k];
    return alike;
}

int rb_rolling_couples(const rb_rolling_case *rc)
{
    return rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS)
               ? fabs(rb_rolling_derive(rc).dundurs) > 1e-9
               : !rc->elastic_b || !are_alike(&rc->a, &rc->b);
}

/* Similar homogeneous half-planes with constant friction and nothing between them. */
static int are_classical(const rb_rolling_case *rc)
{
    return rb_rolling_largest_mu(rc) > 0.0 && rc->friction.law == RB_FRICTION_constant &&
           !rb_rolling_law_depends_on_state(rc) && rc->interlayer_normal == 0.0 &&
           rc->interlayer_tangential == 0.0 && rc->yield_stress == 0.0 &&
           rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS) && rc->gap != RB_GAP_TABLE &&
           rc->worn.n == 0 && !rb_rolling_is_strained(rc) && !rb_rolling_couples(rc);
}

int rb_rolling_carter_holds(const rb_rolling_case *rc)
{
    return rc->formulation == RB_STEADY && are_classical(rc);
}

int rb_rolling_cattaneo_holds(const rb_rolling_case *rc)
{
    return rc->formulation == RB_STATIC && !rb_rolling_has_steps(rc) && are_classical(rc);
}
