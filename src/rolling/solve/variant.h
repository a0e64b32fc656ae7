/* Variants of a solved model: cases that differ slightly, on its elements. */
#ifndef ROLLBEM_ROLLING_SOLVE_VARIANT_H
#define ROLLBEM_ROLLING_SOLVE_VARIANT_H

#include "rolling/solve/model.h"

/* What the tractions of a solved model displace, kept for all variants of the model; of is
 * borrowed. NULL without memory. */
typedef struct rb_rolling_perturbation rb_rolling_perturbation;
rb_rolling_perturbation *rb_rolling_perturbation_create(const rb_rolling_model *of);
void rb_rolling_perturbation_free(rb_rolling_perturbation *perturbation);

/* A variant of a solved model: a case that differs slightly from the model's in some
 * number, on the same elements, with the model's state and zones, to be completed.  If
 * the flexibility is the same, it is borrowed from the model.  RB_INACCURATE: the number
 * of elements outside the contact differs.  results: 0 if only the equations are needed.
 * own_bodies: 1: the variant has a compressed boundary of its own instead of the model's,
 * so that all variants have it compressed as closely.  perturbation: of the model: where bodies
 * that change leave their flexibility to it, the variant has their change under the tractions of
 * the model alone, which is exact to first order; NULL: they are built.  variant: overwritten; free
 * it in any case. */
rb_status rb_rolling_variant_create(const rb_rolling_model *of, const rb_rolling_case *rc,
                                    int results, int own_bodies,
                                    rb_rolling_perturbation *perturbation,
                                    rb_rolling_model *variant, rb_message *why);
/* 1: such a variant is built with flexibilities of its own. */
int rb_rolling_variant_builds(const rb_rolling_model *of, const rb_rolling_case *rc, int results);
/* A variant with the model's case on elements whose ends x are moved to shift + scale
 * x. */
rb_status rb_rolling_variant_move(const rb_rolling_model *of, rb_rolling_perturbation *perturbation,
                                  double shift, double scale, rb_rolling_model *variant,
                                  rb_message *why);
/* Gap and coefficients of friction on elements moved to shift + scale x, n values each, where the
 * irregularity has come this much further; friction that does not depend on the place alone stays
 * that of the model.  RB_ENOMEM. */
rb_status rb_rolling_variant_data(const rb_rolling_model *of, double shift, double scale,
                                  double further, double *gap, double *bound, rb_message *why);
/* A variant with another case on elements whose ends x are moved to shift + scale x.  The
 * flexibility is computed again if they move or the bodies differ. */
rb_status rb_rolling_variant_place(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   double shift, double scale, rb_rolling_model *variant,
                                   rb_message *why);
/* 1: both cases have the same flexibility. */
int rb_rolling_same_bodies(const rb_rolling_case *x, const rb_rolling_case *y);
/* 1: the cases differ at most in friction and in given load, motion and force, which leave
 * mesh, bodies and all rows of the contact problem but its bounds as they are. */
int rb_rolling_same_rows(const rb_rolling_case *x, const rb_rolling_case *y);
/* A variant that is also solved, starting from the zones of the model. */
rb_status rb_rolling_variant_solve(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   rb_rolling_model *variant, rb_message *why);
/* 1: a variant has as many elements as the model on each side of its wheels, not only as
 * many together: else the flexibility jumps between them. */
int rb_rolling_same_sides(const rb_rolling_model *of, const rb_rolling_model *variant);
/* 1: a boundary of the model is so fine that its matrix is compressed. */
int rb_rolling_is_compressed(const rb_rolling_model *model);
/* The model itself solved again, its boundaries compressed as closely as those of its
 * variants. */
rb_status rb_rolling_variant_closely(const rb_rolling_model *of, rb_rolling_model *variant,
                                     rb_message *why);

/* The model itself with a matrix of its own, if it has fewer than RB_ROLLING_LARGE
 * elements. */
rb_status rb_rolling_variant_with_matrix(const rb_rolling_model *of, rb_rolling_model *variant,
                                         rb_message *why);
/* What the case of a variant gives at the state of the model, if it differs at most in
 * friction and in given load, motion and force: all else stays, so that no variant is
 * needed.  bound: n, written; problem: overwritten, borrows bound and all rows of the
 * model.  0: the case differs in more. */
int rb_rolling_variant_given(const rb_rolling_model *of, const rb_rolling_case *rc, double *bound,
                             rb_contact_problem *problem, rb_status *status, rb_message *why);
void rb_rolling_variant_free(const rb_rolling_model *of, rb_rolling_model *variant);
/* Sets the state of a variant to that of its model plus `part` times `along` (NULL: 0):
 * p, q, delta and xi; zones are the model's. */
void rb_rolling_variant_set(const rb_contact_state *of, const rb_contact_state *along, double part,
                            rb_contact_state *variant);
/* Computes from them slip (0 in stick), friction coefficients and Hertz's half-width of
 * the variant.  gap, slip: n, of all elements; NULL: not wanted. */
rb_status rb_rolling_variant_complete(rb_rolling_model *variant, double *gap, double *slip,
                                      rb_message *why);

#endif
