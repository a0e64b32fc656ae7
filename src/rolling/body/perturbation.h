/* Changes of bodies to first order, under the tractions of a solved model. */
#ifndef ROLLBEM_ROLLING_BODY_PERTURBATION_H
#define ROLLBEM_ROLLING_BODY_PERTURBATION_H

#include "rolling/solve/variant.h"

/* Adds to w (2m) what the bodies of v, on its mesh, displace more than those of the model under the
 * tractions of the model, to first order; x, h: m, of the elements of v, written where A changes.
 * RB_INACCURATE: elements outside the contact come or go. */
rb_status rb_rolling_perturbation_add(rb_rolling_perturbation *perturbation,
                                      const rb_rolling_model *v, double *w, double *x, double *h,
                                      rb_message *why);

#endif
