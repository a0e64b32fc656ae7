/* The stress field below a solved model. */
#ifndef ROLLBEM_ROLLING_STRESS_FIELD_H
#define ROLLBEM_ROLLING_STRESS_FIELD_H

#include "rolling/stress/stress.h"

/* ---- stress.c ------------------------------------------------------------------- */

/* The stress in A below the tractions of a solved model, which it borrows. */
typedef struct rb_rolling_field rb_rolling_field;
rb_status rb_rolling_field_create(const rb_rolling_model *model, rb_rolling_field **field,
                                  rb_message *why);
void rb_rolling_field_free(rb_rolling_field *field);
/* As rb_rolling_stress_at. */
rb_status rb_rolling_field_at(const rb_rolling_field *field, int n, const double *xy,
                              rb_rolling_stress *stress, rb_message *why);
/* Its tractions, linear between nodes. */
const rb_bem_edge_load *rb_rolling_field_load(const rb_rolling_field *field);

/* ---- given_tractions.c ---------------------------------------------------------- */

/* From one end of what is loaded to the other: edges of the contact, NAN without one, or the first
 * and the last of given nodes. */
void rb_rolling_loaded_between(const rb_rolling_model *model, double *from, double *to);
/* On the surface, where given tractions jump: the mean of both sides; sxx NAN where q jumps. */
void rb_rolling_given_on_jump(const rb_rolling_model *model, double x, double *sigma);

#endif
