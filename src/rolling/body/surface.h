/* The half-plane or layer that answers like a body close to a load. */
#ifndef ROLLBEM_ROLLING_BODY_SURFACE_H
#define ROLLBEM_ROLLING_BODY_SURFACE_H

#include "bem/bem.h"
#include "rolling/body/internal.h"

/* length: array for the lengths V tau, which the surface borrows, like the ratios of the body. */
static inline rb_bem_surface rb_rolling_surface_of(const rb_rolling_case *rc,
                                                   const rb_rolling_body *body,
                                                   double length[RB_ROLLING_TERMS])
{
    return rb_rolling_kind_of(body)->surface(rc, body, length);
}

#endif
