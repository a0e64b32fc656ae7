/* Displacement and stress inside a body, point after point (B8); not installed. */
#ifndef ROLLBEM_BEM_INTERIOR_H
#define ROLLBEM_BEM_INTERIOR_H

#include "bem/bem.h"

/* rb_bem_interior on a mesh and of a material that are checked, for one point after the other:
 * body's pointers are borrowed.  RB_ENOMEM leaves NULL.  is_round: the polygon stands for
 * smooth contours, at whose corners there is nothing special. */
typedef struct rb_interior rb_interior;
rb_status rb_interior_create(const rb_bem_boundary *body, rb_interior **interior);
rb_status rb_interior_at(const rb_interior *interior, int is_round, rb_bem_points points,
                         double *displacement, double *stress, rb_message *why);
void rb_interior_free(rb_interior *interior);

#endif
