/* Contacts on an ellipse (E2, E3). */
#ifndef ROLLBEM_ROLLING_CASE_ELLIPSE_H
#define ROLLBEM_ROLLING_CASE_ELLIPSE_H

#include "rolling/case/inputs.h"

/* 1: rolls steadily on an ellipse between alike bodies under one coefficient of friction; and the
 * force of all of it at the creepage xi R_eq/(mu a) (E3).  kalker: NAN where his table ends. */
int rb_rolling_ellipse_slides_alike(const rb_rolling_case *rc);
void rb_rolling_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                               double *kalker);
/* NAN where there is none; of the strips that the case asks for, `strips` is set by
 * rb_rolling_solve_strips. */
void rb_rolling_set_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                                   double *kalker);

#endif
