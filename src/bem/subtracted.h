/* What the half-plane's solutions leave of unit loads on contact elements (B10). */
#ifndef ROLLBEM_BEM_SUBTRACTED_H
#define ROLLBEM_BEM_SUBTRACTED_H

#include "bem/system.h"

/* Borrows the system.  RB_ENOMEM; free in any case. */
typedef struct rb_subtracted rb_subtracted;
rb_status rb_subtracted_create(const rb_bem_system *system, rb_subtracted **subtracted);
void rb_subtracted_free(rb_subtracted *subtracted);

/* X: ld x 2 contact_n, overwritten by the right-hand sides for a unit traction on each contact
 * element in x and in y.  RB_ENOMEM, RB_INTERRUPTED. */
rb_status rb_subtracted_loads(const rb_subtracted *subtracted, double *X);
/* Adds the half-plane's own displacements of the contact and the upstream element to what was
 * solved for. */
void rb_subtracted_add_strips(const rb_subtracted *subtracted, double *X);

#endif
