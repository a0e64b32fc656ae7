/* What the half-plane's solutions leave of unit loads on contact elements (B10). */
#ifndef ROLLBEM_BEM_SUBTRACTED_H
#define ROLLBEM_BEM_SUBTRACTED_H

#include "bem/system.h"

/* Borrows the system.  RB_ENOMEM; free in any case. */
typedef struct rb_subtracted rb_subtracted;
rb_status rb_subtracted_create(const rb_bem_system *system, rb_subtracted **subtracted);
void rb_subtracted_free(rb_subtracted *subtracted);

/* Loads: unit tractions on each contact element in x and in y, 2 contact_n of them (R: NULL), or
 * combinations of these, the columns of R (2 contact_n x loads).  X, ld x loads, is overwritten by
 * their right-hand sides.  RB_ENOMEM, RB_INTERRUPTED. */
rb_status rb_subtracted_loads(const rb_subtracted *subtracted, int loads, const double *R,
                              double *X);
/* Adds the half-plane's own displacements of the contact and the upstream element to what was
 * solved for.  RB_ENOMEM. */
rb_status rb_subtracted_add_strips(const rb_subtracted *subtracted, int loads, const double *R,
                                   double *X);

#endif
