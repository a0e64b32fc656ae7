/* Temperatures of the surfaces. */
#ifndef ROLLBEM_ROLLING_SOLVE_TEMPERATURE_H
#define ROLLBEM_ROLLING_SOLVE_TEMPERATURE_H

#include "rolling/case/inputs.h"

/* Temperature rise at a point of the surface caused by a unit heat flux that enters the
 * body between the distances `from` < `to` upstream of the point (T1), at any Peclet
 * number; conductivity > 0. */
double rb_rolling_heat_response(const rb_rolling_heat *body, double speed, double from, double to);

/* Its temperatures, if it has such columns, and the highest.  RB_ENOMEM, RB_SINGULAR. */
rb_status rb_rolling_set_temperature(const rb_rolling_model *model, rb_rolling_solution *solution,
                                     rb_message *why);

/* Highest of the temperatures t of elements in contact, by a parabola through the warmest
 * one and its neighbours, and its place; NAN without contact.  x, zone, t: n. */
void rb_rolling_peak_temperature(int n, const double *x, const int *zone, const double *t,
                                 double *value, double *at);

/* Temperatures of steady rolling from x, h, zone, q, slip and shift of the solution, into
 * t_a and t_b, n each.  heats: the elements heat that heat in it; the solution itself, or, where it
 * is differentiated, the one of whose elements none shall begin to heat.  conduction: kept from
 * call to call on the same elements, NULL at first; free it with rb_rolling_conduction_free in any
 * case.  RB_ENOMEM, RB_SINGULAR. */
struct rb_rolling_conduction;
void rb_rolling_conduction_free(struct rb_rolling_conduction *conduction);
rb_status rb_rolling_solution_heat(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                   const rb_rolling_solution *heats,
                                   struct rb_rolling_conduction **conduction, double *t_a,
                                   double *t_b, double *heat_a, double *heat_b, rb_message *why);

#endif
