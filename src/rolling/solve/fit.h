/* Elements that meet the edges of the contact. */
#ifndef ROLLBEM_ROLLING_SOLVE_FIT_H
#define ROLLBEM_ROLLING_SOLVE_FIT_H

#include "rolling/case/inputs.h"

/* ---- align.c -------------------------------------------------------------------- */

/* Solves on equal elements whose ends coincide with both edges, after a first solution.
 * If the edges do not converge, other equal elements are used, and model->equal_instead
 * is set. RB_EINVAL: several patches. */
rb_status rb_rolling_solve_aligned(rb_rolling_model *model, rb_message *why);
/* The same, starting from the present edges of the model. */
rb_status rb_rolling_model_realign(rb_rolling_model *model, rb_message *why);

/* ---- fit.c ---------------------------------------------------------------------- */

/* Solves on elements fitted to the contact edges; if these do not converge, on equal
 * elements, and model->equal_instead is set. */
rb_status rb_rolling_solve_fitted(rb_rolling_model *model, rb_message *why);
/* Shift of a contact edge, in half-widths, beyond which a mesh is fitted or aligned again where
 * a solution follows another one. */
#define RB_ROLLING_REFIT 0.01
/* Builds a fitted mesh and bodies again for the present edges of the model, and
 * solves. */
rb_status rb_rolling_model_refit(rb_rolling_model *model, rb_message *why);
/* Solves on the same number of equal elements across the contact, without fitting their
 * ends. */
rb_status rb_rolling_solve_equal_instead(rb_rolling_model *model, rb_message *why);

/* From the edges of another solution with the same wheels to elements fitted to the edges of the
 * model's case.  Where the elements are short the far field of the other solution is as good as the
 * model's own: it then keeps that and has no systems of boundary elements.  model: as
 * rb_rolling_model_begin leaves it. */
rb_status rb_rolling_fit_beside(const rb_rolling_model *beside, rb_rolling_model *model,
                                rb_message *why);

#endif
