/* Whether elements are short enough for what they stand on. */
#ifndef ROLLBEM_ROLLING_SOLVE_RESOLUTION_H
#define ROLLBEM_ROLLING_SOLVE_RESOLUTION_H

#include "rolling/case/inputs.h"

/* ---- resolution.c --------------------------------------------------------------- */

/* The number of elements, `least` or more, whose midpoints show what the tables of gap,
 * irregularity, worn depth and friction say, on the mesh of the case.  RB_ENOMEM. */
rb_status rb_rolling_elements_for_tables(const rb_rolling_case *rc, int least, int *elements);
/* What those of the case miss of the tables, 0 if they are enough: amplitude of the pressure
 * [stress], mean error of the coefficient of friction.  RB_ENOMEM. */
rb_status rb_rolling_missed_by_elements(const rb_rolling_case *rc, double *pressure, double *mu);

/* ---- layer_resolved.c --------------------------------------------------------- */

/* RB_EINVAL: a layer, cover or rim is compressed by all of its thickness. */
rb_status rb_rolling_check_crushed(const rb_rolling_model *model, rb_message *why);
/* Called at the end of a solution, a history or a curve with status s.  RB_EINVAL: a
 * layer or cover is crushed, or needs shorter elements than those in contact, which may
 * also be the reason for a failure.  Only meshes of results are checked; coarse meshes
 * used before may be too coarse. */
rb_status rb_rolling_check_layer_resolved(const rb_rolling_model *model, rb_status s,
                                          rb_message *why);

#endif
