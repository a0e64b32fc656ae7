/* From a case to its solution in one call, and the solution of a model. */
#ifndef ROLLBEM_ROLLING_SOLVE_SOLUTION_H
#define ROLLBEM_ROLLING_SOLVE_SOLUTION_H

#include "lcp/contact/contact.h"
#include "rolling/case/inputs.h"

/* The same as rb_rolling_solve, but the model is kept for stresses or further solves;
 * free both in any case. */
rb_status rb_rolling_solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                                 rb_rolling_solution *solution, rb_message *why);
/* The same for a model that has been solved before, see rb_rolling_model_reuse. */
rb_status rb_rolling_solve_model_reuse(const rb_rolling_case *rc, rb_rolling_model *model,
                                       rb_rolling_solution *solution, rb_message *why);

/* Solves a case on equal elements between from and to; the contact may lie anywhere in
 * between.  Of the mesh options of the case only contact_elements is used.  solution is
 * overwritten; free it in any case. */
rb_status rb_rolling_solve_between(const rb_rolling_case *rc, double from, double to,
                                   rb_rolling_solution *solution, rb_message *why);

/* As rb_rolling_model_solution, after a solve that began at `begun` (rb_seconds) and has ended with
 * status s, as far as there is a state; with status and time.  Returns the status of both. */
rb_status rb_rolling_end_solve(const rb_rolling_model *model, rb_status s, double begun,
                               rb_rolling_solution *solution, rb_message *why);
/* The solution without the residuals and temperatures, which stay 0, and the balance of the
 * support, which is NAN. */
rb_status rb_rolling_bare_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                   rb_message *why);
/* The same without what takes products, either: gap, displacements, slip at rest, strain energy and
 * powers that bodies lose are 0 or NAN.  Enough for notes on a step. */
rb_status rb_rolling_tractions_solution(const rb_rolling_model *model,
                                        rb_rolling_solution *solution, rb_message *why);

/* Friction power per area and unit speed [stress], n values with sum power h =
 * dissipation; wear laws use it.  In steady rolling the slip is known between midpoints,
 * and half of it is assigned to each of the two elements (theory-solvers.md 6).  NAN in
 * static. */
void rb_rolling_friction_power(const rb_rolling_solution *s, double *power);

/* rb_contact_prove of the state of a model.  Where its friction depends on the state, the
 * coefficients are those with which the iteration has ended: unique is "fixed friction". */
rb_status rb_rolling_model_prove(const rb_rolling_model *model, rb_contact_proof *proof,
                                 rb_message *why);

/* ---- Free rolling, strips ------------------------------------------------------- */

/* The creepage at which Q = 0 (steady, mu > 0), on the model's mesh.  The model's
 * solution is not changed, but the data that it keeps for further solves is. */
rb_status rb_rolling_free_creepage(rb_rolling_model *model, double *creepage, rb_message *why);
/* The force of the whole ellipse at the creepage of the solved model, by the strips that its case
 * asks for, each solved on its own; force is left as it is where it asks for none.  A strip without
 * a solution: its status, NAN. */
rb_status rb_rolling_solve_strips(const rb_rolling_model *model, double *force, rb_message *why);

#endif
