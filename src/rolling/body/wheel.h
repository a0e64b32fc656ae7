/* What the files of wheels share: boundary elements (body_wheel.c) and waves (body_ring.c). */
#ifndef ROLLBEM_ROLLING_BODY_WHEEL_H
#define ROLLBEM_ROLLING_BODY_WHEEL_H

#include "rolling/body/internal.h"

/* The abilities of every wheel. */
#define RB_BODY_WHEEL (RB_BODY_BOUNDARY | RB_BODY_ELASTIC | RB_BODY_STRESS)

/* 1: by waves, without boundary elements: around a cover nothing changes with the angle.  Boundary
 * elements where they are asked for. */
static inline int rb_rolling_goes_by_waves(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return body->cover > 0.0 && rc->near_field == RB_NEAR_FIELD_AUTO;
}
rb_status rb_rolling_flexibility_by_waves(const rb_rolling_case *rc, const rb_rolling_body *body,
                                          const rb_rolling_mesh *mesh, rb_bem_flexibility *f,
                                          rb_message *why);
/* What memory adds to the glassy wheel in steady rolling, which is all that asks for the
 * flexibility of a body with memory (V8). */
rb_status rb_rolling_add_wheel_memory(const rb_rolling_case *rc, const rb_rolling_body *body,
                                      const rb_rolling_mesh *mesh,
                                      rb_rolling_body_flexibility *one_body, rb_message *why);
/* Rows of the table of bodies: whether waves go by Fourier transforms, and these; what is near to
 * the loads, as a half-plane along the arc. */
int rb_rolling_wheel_transformed(const rb_rolling_case *rc, const rb_rolling_body *body);
rb_status rb_rolling_wheel_transforms(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                      const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                      rb_rolling_body_flexibility *one_body, rb_message *why);
rb_status rb_rolling_wheel_near(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                rb_rolling_body_flexibility *one_body, rb_message *why);

/* src/bem knows no options: what it refuses is that of the first ones, or of the others. */
static inline rb_status rb_rolling_name_options(rb_status s, int other, const char *first,
                                                const char *second, rb_message *why)
{
    return s == RB_EINVAL ? rb_refuse(why, other ? second : first, "%s", why ? why->text : "") : s;
}
extern const char rb_rolling_of_rings[], rb_rolling_of_rings_b[];

#endif
