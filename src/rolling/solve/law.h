/* Friction laws (theory-rolling.md 4.11). */
#ifndef ROLLBEM_ROLLING_SOLVE_LAW_H
#define ROLLBEM_ROLLING_SOLVE_LAW_H

#include "rolling/case/inputs.h"

rb_status rb_rolling_law_check(const rb_rolling_case *rc, rb_message *why);
/* Value of the table at x: linear between its points, constant beyond them. */
double rb_rolling_table_at(const rb_rolling_table *table, double x);
/* 1 if the law depends on the slip velocity. */
int rb_rolling_law_depends_on_slip(const rb_rolling_friction *f);
double rb_rolling_law_mu(const rb_rolling_case *rc, double x, double v, double temperature);
/* The coefficient at rest and without heating. */
double rb_rolling_law_at_rest(const rb_rolling_case *rc, double x);
/* Largest -dmu/dv of a particle that passes an element of this length, or an upper bound if two
 * terms have different slip scales or friction remembers (theory-rolling.md F3). */
double rb_rolling_law_steepest(const rb_rolling_case *rc, double length);

/* The coefficients (n) of the law for the state. */
rb_status rb_rolling_law_coefficients(rb_rolling_model *model, double *mu, rb_message *why);
/* Sets first bounds: coefficients of fast sliding up to x, and those at rest beyond. */
rb_status rb_rolling_law_start(rb_rolling_model *model, double x, rb_message *why);
/* law_newton.c: Newton's method from the present bounds, until these and the bounds of
 * the law differ by at most `enough` in the natural residual.  left: number of contact
 * problems that may still be solved.  RB_MAXITER: this number is used up, or the residual
 * does not decrease. */
rb_status rb_rolling_law_newton(rb_rolling_model *model, double enough, int *left, rb_message *why);
/* Solves the model's problem by iteration if the law depends on the state. */
rb_status rb_rolling_law_solve(rb_rolling_model *model, int warm, rb_message *why);

#endif
