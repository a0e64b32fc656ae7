/* Friction that depends on the state (theory-rolling.md F2, F3): its iteration, and what it says of
 * how many solutions there may be. */
#ifndef ROLLBEM_ROLLING_SOLVE_LAW_ITERATION_H
#define ROLLBEM_ROLLING_SOLVE_LAW_ITERATION_H

#include "rolling/case/inputs.h"

/* The coefficients (n) of the law for the state. */
rb_status rb_rolling_law_coefficients(rb_rolling_model *model, double *mu, rb_message *why);
/* Sets first bounds: coefficients of fast sliding up to x, and those at rest beyond. */
rb_status rb_rolling_law_start(rb_rolling_model *model, double x, rb_message *why);
/* law_newton.c: Newton's method from the present bounds, until these and the bounds of
 * the law differ by at most `enough` in the natural residual.  left: number of contact
 * problems that may still be solved.  RB_MAXITER: this number is used up, or the residual
 * does not decrease. */
rb_status rb_rolling_law_newton(rb_rolling_model *model, double enough, int *left, rb_message *why);
/* kappa (theory-rolling.md F3) of the state, for friction that depends on the state.  Above 1 a
 * single element, or a step, may have several solutions.  RB_ENOMEM. */
rb_status rb_rolling_law_kappa(const rb_rolling_model *model, double *kappa);
/* In steady rolling kappa is the largest of those of the elements: that of one, and the element
 * that has the largest; -1: none, or not steady. */
double rb_rolling_law_kappa_of(const rb_rolling_model *model, int element);
int rb_rolling_law_kappa_element(const rb_rolling_model *model);

/* What part of the coefficient that it had before it a particle keeps behind element i, of friction
 * with a memory (theory-rolling.md F2). */
double rb_rolling_law_kept(const rb_rolling_model *model, int i);

/* Sets the friction coefficients of the model's problem to those that the friction law
 * gives for its state, and likewise a given force; the residual of the state then
 * includes the friction law.  RB_ENOMEM. */
rb_status rb_rolling_model_friction(rb_rolling_model *model, rb_message *why);

#endif
