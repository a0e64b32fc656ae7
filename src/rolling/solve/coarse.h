/* A solution on other elements as the start of the next one. */
#ifndef ROLLBEM_ROLLING_SOLVE_COARSE_H
#define ROLLBEM_ROLLING_SOLVE_COARSE_H

#include "rolling/case/inputs.h"

/* Number of elements of the coarser mesh on which a problem with n elements starts. */
int rb_rolling_coarse_elements(int n);
/* Interpolates tractions, zones, delta and xi from a solution with fewer elements on the
 * same line. */
void rb_rolling_start_from(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                           const rb_contact_state *coarse, const rb_rolling_mesh *fine_mesh,
                           rb_contact_state *fine);

/* The friction coefficients (n; owned by the caller) of a solved model; NULL: those of
 * the case, or the law may have other states, or no memory. */
double *rb_rolling_friction_of(const rb_rolling_model *model);
/* Interpolates them from the mesh to a model on other elements, whose next solve follows
 * them; NULL: none. */
void rb_rolling_follow_friction(const rb_rolling_mesh *mesh, const double *bound,
                                rb_rolling_model *fine);

/* Zones, tractions and friction of another mesh, where the elements of the model lie; of a fitted
 * mesh, whose elements have moved with the edges, element by element.  bound: of that mesh, or
 * NULL. */
void rb_rolling_start_near(const rb_rolling_mesh *old_mesh, const rb_contact_state *old,
                           const double *bound, rb_rolling_model *model);
/* Zones and tractions of a large contact, from fewer elements over the same line, which are solved
 * for that.  A positive status: strong coupling without a matrix has failed on those already. */
rb_status rb_rolling_start_from_coarse(rb_rolling_model *model, rb_message *why);

#endif
