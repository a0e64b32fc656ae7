/* Powers and torques of a solution. */
#ifndef ROLLBEM_ROLLING_SOLVE_POWER_H
#define ROLLBEM_ROLLING_SOLVE_POWER_H

#include "rolling/case/inputs.h"

/* Power per unit speed of friction q (n) and slip displacement lambda (n); NAN for
 * static. */
double rb_rolling_dissipated_power(const rb_rolling_case *rc, int n, const double *lambda,
                                   const double *q, const double *h, const double *e_T);

/* int p abs(slip) dx per rolled distance, with slip and pressure multiplied as in the
 * power. */
double rb_rolling_slid_pressure(const rb_rolling_case *rc, int n, const double *lambda,
                                const double *p, const double *h, const double *e_T);

/* Torques that keep both bodies rolling against M and the force Q, > 0 if they drive
 * (theory-bodies.md V4); torque_b is NAN if B is a plane. */
void rb_rolling_torques(const rb_rolling_case *rc, double moment, double force, double *torque_a,
                        double *torque_b);

/* Power per unit speed that viscoelasticity dissipates, -int t Dw ds (theory-bodies.md V4): 0
 * for elastic bodies; steady rolling only, otherwise NAN.  RB_ENOMEM. */
rb_status rb_rolling_hysteresis(const rb_rolling_model *model, double *power);
/* Power per unit speed that the lever arms of wheels supply, which change as they deform
 * (theory-bodies.md V4): 0 for half-planes; steady rolling only, otherwise NAN.  hysteresis: the
 * result of the function above.  RB_ENOMEM. */
rb_status rb_rolling_lever_power(const rb_rolling_model *model, double hysteresis, double *power);

#endif
