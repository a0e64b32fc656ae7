/* Elastic constants: the shear modulus, and Poisson's ratio of plane strain; plane stress is plane
 * strain with nu/(1 + nu). */
#include "bem/internal.h"

#include <math.h>

rb_bem_material rb_bem_material_from_young(double young, double poisson)
{
    return (rb_bem_material){.shear = young / (2.0 * (1.0 + poisson)), .poisson = poisson};
}

rb_bem_material rb_bem_material_in_plane(rb_bem_plane plane, double young, double poisson)
{
    rb_bem_material m = rb_bem_material_from_young(young, poisson);
    if (plane == RB_PLANE_STRESS)
        m.poisson = poisson / (1.0 + poisson);
    return m;
}

rb_status rb_bem_material_check(rb_bem_material material, rb_message *why)
{
    if (!(material.shear > 0.0 && isfinite(material.shear)))
        return rb_fail(why, RB_EINVAL, "shear modulus = %g: expected > 0", material.shear);
    if (!(material.poisson > -1.0 && material.poisson <= 0.5))
        return rb_fail(why, RB_EINVAL, "Poisson's ratio = %g: expected in (-1, 0.5]",
                       material.poisson);
    return RB_OK;
}
