/* Elastic constants of the bodies for the plane problem of the case. */
#include "rolling/body/internal.h"

rb_bem_material rb_rolling_material(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return rb_bem_material_in_plane(rc->plane, body->young, body->poisson);
}

rb_bem_material rb_rolling_base_material(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return body->cover > 0.0
               ? rb_bem_material_in_plane(rc->plane, body->core_young, body->core_poisson)
               : rb_bem_material_in_plane(rc->plane, body->base_young, body->base_poisson);
}

/* At -1/2 and below, nu/(1 + nu) is no Poisson's ratio of plane strain. */
rb_status rb_rolling_check_poisson(const rb_rolling_case *rc, const char *option, double poisson,
                                   rb_message *why)
{
    if (rc->plane != RB_PLANE_STRESS || poisson > -0.5)
        return RB_OK;
    return rb_refuse(why, option, "expected in (-0.5, 0.5] in plane stress, got %g", poisson);
}
