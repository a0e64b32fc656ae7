/* Whether the mesh holds the whole contact (theory-solvers.md 5.1). */
#include "rolling/body/mesh.h"
#include "rolling/solve/model.h"
#include "rolling/solve/zone.h"

#include <math.h>

static rb_status check_end(const rb_rolling_model *model, const rb_contact_state *state, int right,
                           rb_message *why)
{
    const int n = model->mesh.n;
    const double x = model->mesh.ends[right ? n : 0];
    double from, to;

    if (state->zone[right ? n - 1 : 0] == RB_ZONE_SEPARATED)
        return RB_OK;
    rb_rolling_extent(model->rc, &from, &to);
    const double rounding = 1e-9 * (to - from);
    const int no_room = right ? x >= to - rounding : x <= from + rounding;
    if (no_room && model->rc->gap == RB_GAP_TABLE)
        return rb_fail(why, RB_ZONE,
                       "the contact reaches x = %g mm, and the gap table or the wheel has x "
                       "from %g to %g mm only",
                       x, from, to);
    if (no_room)
        return rb_fail(why, RB_ZONE, "the contact does not end within %g mm of the lowest point",
                       fabs(x));
    return rb_fail(why, RB_ZONE,
                   "the contact reaches the end of the potential contact at x = %g mm; "
                   "widen the zone",
                   x);
}

rb_status rb_rolling_check_enclosed(const rb_rolling_model *model, const rb_contact_state *state,
                                    rb_message *why)
{
    rb_rolling_overlap overlap = {0};
    const int has_ends = !rb_rolling_fills_period(model->rc, &model->mesh);
    rb_status s = RB_OK;

    if (model->rc->mesh == RB_MESH_PUNCH) /* nothing is outside */
        return RB_OK;
    for (int right = 0; right < 2 && has_ends && s == RB_OK; right++)
        s = check_end(model, state, right, why);
    if (s == RB_OK && !rb_rolling_is_convex(model->rc))
        s = rb_rolling_find_overlap(model, state, &overlap);
    if (s == RB_OK && overlap.count > 0)
        s = rb_fail(why, RB_ZONE,
                    "the bodies overlap from x = %g to %g mm, outside the potential "
                    "contact; widen the zone",
                    overlap.from[0], overlap.to[0]);
    return s;
}
