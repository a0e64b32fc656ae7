/* What a body may not be, by its rows of the table of bodies. */
#include "rolling/body/internal.h"

#include <math.h>

rb_status rb_rolling_body_check(const rb_rolling_case *rc, const rb_rolling_body *b,
                                const char *which, int plane_allowed, rb_message *why)
{
    const int plane = plane_allowed && b->radius == INFINITY,
              bore = plane_allowed && b->radius < 0.0;
    const char *support = *which ? "support-b" : "support";

    if (b->radius == 0.0)
        return rb_refuse(why, *which ? "radius-b" : "radius",
                         "expected > 0, or < 0 of a bore, got 0");
    if (!rb_rolling_kind_of(b))
        return rb_refuse(why, support, "there is no number %d", (int)b->support);
    if (bore && !(rb_rolling_kind_of(b)->can & RB_BODY_FLAT))
        return rb_refuse(why, support,
                         "a bore has no wheel's boundary, only the support halfplane");
    if (plane && !(rb_rolling_kind_of(b)->can & RB_BODY_FLAT))
        return rb_refuse(why, support, "a plane has the support halfplane only");
    rb_status s = rb_rolling_check_poisson(rc, *which ? "poisson-b" : "poisson", b->poisson, why);
    for (const rb_rolling_body_kind *const *kind = rb_rolling_body_kinds; *kind; kind++) {
        if (s != RB_OK)
            return s;
        if ((*kind)->check && ((*kind)->holds || (*kind)->support == b->support))
            s = (*kind)->check(rc, b, which, why);
    }
    return s;
}
