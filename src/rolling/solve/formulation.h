/* The contact problem of a model: what changes from step to step. */
#ifndef ROLLBEM_ROLLING_SOLVE_FORMULATION_H
#define ROLLBEM_ROLLING_SOLVE_FORMULATION_H

#include "lcp/contact/contact.h"
#include "rolling/case/inputs.h"

/* ---- formulation.c -------------------------------------------------------------- */

/* The creepage of ratio xi R/(mu a), mu the largest coefficient, and the ratio of a
 * creepage: NAN without friction or contact. */
double rb_rolling_creepage_of_ratio(const rb_rolling_model *model, double ratio);
double rb_rolling_ratio_of_creepage(const rb_rolling_model *model, double creepage);

void rb_rolling_set_past(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                         const rb_rolling_past *past, rb_contact_problem *p);
void rb_rolling_set_control(const rb_rolling_case *rc, rb_contact_problem *p);
/* All that friction and given load, motion and force determine: bounds, control and
 * scales. */
void rb_rolling_set_given(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                          rb_contact_problem *p);
/* Another operator of the same bodies, after these have got a matrix.  The problem keeps its
 * own where there is no memory. */
rb_status rb_rolling_problem_renew_operator(const rb_rolling_case *rc,
                                            const rb_rolling_bodies *bodies, rb_contact_problem *p,
                                            rb_message *why);
/* The same problem after rb_rolling_bodies_stretch, steady and with a given load: it keeps its
 * operator, and with that the LU of the last zones. */
rb_status rb_rolling_problem_stretch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                     const rb_rolling_bodies *bodies, double scale, double along,
                                     rb_contact_problem *p, rb_message *why);
/* The problem of bodies and an operator that belong to another one, which stays their
 * owner: p->op must be NULL before p is freed.  w0 of the bodies adds to gap and slip. */
rb_status rb_rolling_problem_share(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                   const rb_rolling_bodies *bodies, rb_contact_operator *op,
                                   rb_contact_problem *p, rb_message *why);
/* The given rigid shift or its default: a tenth of the approach, 0 under load control. */
double rb_rolling_wanted_shift(const rb_rolling_case *rc);
/* d_N, from the gaps of the mesh. */
void rb_rolling_set_gap(const rb_rolling_mesh *mesh, const rb_rolling_bodies *bodies,
                        rb_contact_problem *p);

/* yield.c: the layer that yields (Y1) in a problem whose operator is set.  RB_EINVAL: it softens by
 * more than has a unique solution; RB_ENOMEM. */
rb_status rb_rolling_set_yield(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                               rb_contact_problem *p, rb_message *why);

/* Accumulated plastic slip of the interface at the elements (n). */
void rb_rolling_yielded(const rb_rolling_model *model, double *yielded);

/* ---- law.c, law_iteration.c ----------------------------------------------------- */

/* First bounds of the elements for the iteration: those at rest, or the given start. */
void rb_rolling_start_bounds(const rb_rolling_case *rc, const rb_rolling_table *start,
                             const rb_rolling_bodies *bodies, rb_contact_problem *p);

/* A creepage at which the whole contact slides; the search for a given force starts
 * there. */
double rb_rolling_sliding_creepage(const rb_rolling_case *rc, const rb_contact_problem *p);

/* ---- model.c -------------------------------------------------------------------- */

/* 1: the last solve has taken all the steps that strong coupling has without a matrix. */
int rb_rolling_gave_up(const rb_rolling_model *model);

/* Sets another case on the same elements, for the next step of a history or the next
 * point of a curve; mesh, bodies and problem are not changed. */
rb_status rb_rolling_model_set_case(rb_rolling_model *model, const rb_rolling_case *rc,
                                    rb_message *why);
/* Bodies and contact problem on a mesh, which is the model's afterwards, with a state of zeros;
 * plan NULL: the case's. Free the model in any case. */
rb_status rb_rolling_model_on_mesh(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   rb_rolling_mesh *mesh, rb_rolling_model *model, rb_message *why);
/* Frees model->freely. */
void rb_rolling_forget_free_rolling(rb_rolling_model *model);

/* ---- create.c ------------------------------------------------------------------- */

/* The free-rolling creepage as a result: NAN if it is not found, which does not change
 * the status of the solved case.  RB_ENOMEM. */
rb_status rb_rolling_free_creepage_if_any(rb_rolling_model *model, double *creepage,
                                          rb_message *why);

#endif
