/* Friction laws (theory-rolling.md 4.11). */
#ifndef ROLLBEM_ROLLING_SOLVE_LAW_H
#define ROLLBEM_ROLLING_SOLVE_LAW_H

#include "rolling/case/inputs.h"

/* law_check.c: RB_EINVAL for numbers out of range. */
rb_status rb_rolling_law_check(const rb_rolling_case *rc, rb_message *why);
/* The least coefficient of the law. */
double rb_rolling_least_mu(const rb_rolling_case *rc);
/* Value of the table at x: linear between its points, constant beyond them. */
double rb_rolling_table_at(const rb_rolling_table *table, double x);
/* 1 if the law depends on the slip velocity. */
int rb_rolling_law_depends_on_slip(const rb_rolling_friction *f);
double rb_rolling_law_mu(const rb_rolling_case *rc, double x, double v, double temperature);
/* The coefficient at rest and without heating, where bodies that are not equally warm touch (T_m of
 * T2). */
double rb_rolling_law_at_rest(const rb_rolling_case *rc, double x);
/* Largest -dmu/dv of a particle that passes an element of this length, or an upper bound if two
 * terms have different slip scales or friction remembers (theory-rolling.md F3). */
double rb_rolling_law_steepest(const rb_rolling_case *rc, double length);

/* Solves the model's problem by iteration if the law depends on the state. */
rb_status rb_rolling_law_solve(rb_rolling_model *model, int warm, rb_message *why);

#endif
