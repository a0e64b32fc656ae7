/* The row of covers in the table of bodies: a layer around a core that is rigid or a ring on the
 * hub. */
#include "rolling/body/wheel.h"

#include <math.h>

const char rb_rolling_of_rings[] = "hub-ratio,cover-thickness,radius",
           rb_rolling_of_rings_b[] = "hub-ratio-b,cover-thickness-b,radius-b";

static int has_cover(const rb_rolling_body *body)
{
    return body->cover > 0.0;
}

static rb_status check_cover(const rb_rolling_case *rc, const rb_rolling_body *b, const char *which,
                             rb_message *why)
{
    const char *thickness = *which ? "cover-thickness-b" : "cover-thickness";
    if (b->cover != 0.0 && b->support != RB_BEM_HUB)
        return rb_refuse(why, thickness, "its core holds the wheel, add --support%s hub", which);
    if (!(b->cover < fabs(b->radius)))
        return rb_refuse(why, thickness, "expected less than the radius, %g mm, got %g mm",
                         b->radius, b->cover);
    /* boundary elements hardly tell how an incompressible cover presses on its core all around */
    if (rb_rolling_has_elastic_core(b) && !rb_rolling_goes_by_waves(rc, b) &&
        rb_rolling_material(rc, b).poisson > RB_ROLLING_COMPRESSIBLE)
        return rb_refuse(
            why, *which ? "near-field,poisson-b" : "near-field,poisson",
            "boundary elements of a cover on an elastic core need --poisson%s of 0.499 "
            "at most, got %g; leave --near-field out",
            which, b->poisson);
    return rb_rolling_has_elastic_core(b)
               ? rb_rolling_check_poisson(rc, *which ? "core-poisson-b" : "core-poisson",
                                          b->core_poisson, why)
               : RB_OK;
}

static const rb_rolling_parameter cover_parameters[] = {
    {"core-young", has_cover, "a core has its cover on it, see --cover-thickness"},
    {"core-poisson", has_cover, "a core has its cover on it, see --cover-thickness"},
    {.option = NULL}};

const rb_rolling_body_kind rb_rolling_cover = {.name = "cover",
                                               .support = RB_BEM_HUB,
                                               .holds = has_cover,
                                               .can = RB_BODY_WHEEL | RB_BODY_TURNS,
                                               .parameters = cover_parameters,
                                               .check = check_cover};
