/* Displacements where the particles of a contact were before, and just outside of it. */
#ifndef ROLLBEM_ROLLING_BODY_FORMER_PLACE_H
#define ROLLBEM_ROLLING_BODY_FORMER_PLACE_H

#include "rolling/case/inputs.h"

/* Tangential displacement at the distance `step` upstream of each midpoint: w_T = w0_T +
 * W_T (p, q).  Equal elements, half-planes and wheels. */
typedef struct {
    int n;
    double step;      /* 0: there is none */
    double *W_T;      /* n x 2n; NULL without a dense flexibility */
    double *response; /* w_T of a unit p and of a unit q at 2n - 1 distances */
} rb_rolling_former_place;

/* ahead: overwritten; its arrays are memory's. */
rb_status rb_rolling_former_place_create(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                                         double step, rb_arena *memory,
                                         rb_rolling_former_place *ahead);
/* w_T: n, overwritten. */
void rb_rolling_former_place_apply(const rb_rolling_former_place *ahead,
                                   const rb_rolling_bodies *bodies, const double *p,
                                   const double *q, double *w_T);
/* w_T of unit tractions one element downstream of the contact and two upstream of it.
 * W_T: 2 x 2n, zeroed.  Equal elements.  RB_ENOMEM. */
rb_status rb_rolling_displacement_outside(const rb_rolling_case *rc,
                                          const rb_rolling_bodies *bodies, double *W_T);

#endif
