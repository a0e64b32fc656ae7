/* Searches for the load, the ellipse or the tilt of a case. */
#ifndef ROLLBEM_ROLLING_SOLVE_PRESSED_H
#define ROLLBEM_ROLLING_SOLVE_PRESSED_H

#include "rolling/case/inputs.h"

/* Finds the load under which the largest pressure of the solved case is that of the case, within
 * 1e-10; sets pressed_by and, of equal elements without one, zone.  RB_EINVAL: the gap has
 * corners. */
rb_status rb_rolling_find_load(rb_rolling_case *rc, rb_message *why);
/* Sets the ellipse of a case with a wheel load. */
rb_status rb_rolling_find_ellipse(rb_rolling_case *rc, rb_message *why);
/* Sets tilted_by, and the zone, of a case with a given moment: solves it some times. */
rb_status rb_rolling_find_tilt(rb_rolling_case *rc, rb_message *why);

/* Solves a trial of a search.  s: its numbers, without columns, the moment of the pressure among
 * them also in static; widest: NULL, or the half-width of the potential contact that it needs. */
rb_status rb_rolling_try(const rb_rolling_case *trial, rb_rolling_solution *s, double *widest,
                         rb_message *why);

#endif
