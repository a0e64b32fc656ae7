/* What the rest of wheels adds to half-planes. */
#ifndef ROLLBEM_ROLLING_BODY_FAR_FIELD_H
#define ROLLBEM_ROLLING_BODY_FAR_FIELD_H

#include "rolling/body/internal.h"

/* 1 if the bodies have a far field of which few points tell all: wheels of one elastic material
 * whose near field is subtracted, and gaps that say nothing about places without elements. */
int rb_rolling_has_far_field(const rb_rolling_case *rc);
/* From the matrix of a model that has solved its boundaries; matched: as by
 * rb_rolling_far_field_match. RB_ENOMEM. */
rb_status rb_rolling_far_field_create(const rb_rolling_model *model, int matched,
                                      rb_rolling_far_field **far, rb_message *why);
/* From then on the field moves fitted elements, as many as the model has, under tractions like the
 * model's as the boundaries do, with the errors of boundary elements, which are not smooth: solves
 * the boundaries on the mesh of the model for its tractions alone.  RB_ENOMEM, or what boundaries
 * refuse. */
rb_status rb_rolling_far_field_match(const rb_rolling_model *model, rb_rolling_far_field *far,
                                     rb_message *why);
/* 1: it has been matched with so many elements. */
int rb_rolling_far_field_matches(const rb_rolling_far_field *far, int elements);
void rb_rolling_far_field_free(rb_rolling_far_field *far);
/* Adds it to a flexibility that is stored.  RB_ENOMEM. */
rb_status rb_rolling_far_field_add(const rb_rolling_far_field *far, rb_bem_flexibility *f);

#endif
