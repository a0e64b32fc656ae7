/* Where the elements lie: potential contact, edges, coarse meshes. */
#ifndef ROLLBEM_ROLLING_SOLVE_ZONE_H
#define ROLLBEM_ROLLING_SOLVE_ZONE_H

#include "rolling/case/inputs.h"

/* ---- zone.c --------------------------------------------------------------------- */

/* Solves on equal elements in the given potential contact, or in one that is found and
 * encloses the contact.  coarse: elements may be too long for separate patches; later
 * searches begin with the potential contact of this one.  RB_ZONE: no potential contact
 * was found; RB_NO_CONTACT. */
rb_status rb_rolling_solve_zone(rb_rolling_model *model, int coarse, rb_message *why);

/* The same on the elements of a punch. */
rb_status rb_rolling_solve_punch(rb_rolling_model *model, rb_message *why);

/* The first potential contact, from the undeformed gap: its ends, the smallest gap and that at the
 * edges of the contact. */
void rb_rolling_first_zone(const rb_rolling_case *rc, double *from, double *to, double *least,
                           double *level);

/* ---- layer_resolved.c --------------------------------------------------------- */

/* RB_EINVAL: a layer, cover or rim is compressed by all of its thickness. */
rb_status rb_rolling_check_crushed(const rb_rolling_model *model, rb_message *why);
/* Called at the end of a solution, a history or a curve with status s.  RB_EINVAL: a
 * layer or cover is crushed, or needs shorter elements than those in contact, which may
 * also be the reason for a failure.  Only meshes of results are checked; coarse meshes
 * used before may be too coarse. */
rb_status rb_rolling_check_layer_resolved(const rb_rolling_model *model, rb_status s,
                                          rb_message *why);

/* ---- missed_contact.c ----------------------------------------------------------- */

enum { RB_MOST_OVERLAPS = 16 };

/* Intervals in which the bodies overlap although no midpoint of an element lies there. */
typedef struct {
    int count;
    double from[RB_MOST_OVERLAPS], to[RB_MOST_OVERLAPS];
} rb_rolling_overlap;

/* Searches along all of a gap that is not convex; under a convex one (rb_rolling_is_convex) the
 * bodies cannot touch outside the contact (theory-solvers.md 5.1).  RB_ENOMEM. */
rb_status rb_rolling_find_overlap(const rb_rolling_model *model, const rb_contact_state *state,
                                  rb_rolling_overlap *overlap);

/* ---- enclosed.c --------------------------------------------------------------- */

/* RB_ZONE: an element at an end of the mesh is in contact, so that the contact may extend
 * further, or the bodies overlap where there is no midpoint of an element.  state: of the
 * model's problem. */
rb_status rb_rolling_check_enclosed(const rb_rolling_model *model, const rb_contact_state *state,
                                    rb_message *why);

/* ---- resolution.c --------------------------------------------------------------- */

/* The number of elements, `least` or more, whose midpoints show what the tables of gap,
 * irregularity, worn depth and friction say, on the mesh of the case.  RB_ENOMEM. */
rb_status rb_rolling_elements_for_tables(const rb_rolling_case *rc, int least, int *elements);
/* What those of the case miss of the tables, 0 if they are enough: amplitude of the pressure
 * [stress], mean error of the coefficient of friction.  RB_ENOMEM. */
rb_status rb_rolling_missed_by_elements(const rb_rolling_case *rc, double *pressure, double *mu);

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

/* ---- coarse.c ------------------------------------------------------------------- */

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

/* ---- pressed.c ------------------------------------------------------------------ */

/* Solves a trial of a search.  s: its numbers, without columns, the moment of the pressure among
 * them also in static; widest: NULL, or the half-width of the potential contact that it needs. */
rb_status rb_rolling_try(const rb_rolling_case *trial, rb_rolling_solution *s, double *widest,
                         rb_message *why);

#endif
