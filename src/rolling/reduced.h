/* The linear problem that is left when every element's zone is known; what the dense and
 * the matrix-free solve share. */
#ifndef ROLLBEM_ROLLING_REDUCED_H
#define ROLLBEM_ROLLING_REDUCED_H

#include "rolling/internal.h"

/* Unknowns: r_N of the elements in contact and delta, r_T of those in stick and xi; or
 * one of these two groups alone, the other held fixed.  Their order: contacts, sticks,
 * delta (given load), xi (given force); rows alike: gaps, slips, load, force; all scaled
 * to numbers of order one. */
typedef struct {
    rb_rolling_unknowns unknowns;
    int contacts, sticks, load, force, size;
    int *contact, *stick;          /* element numbers */
    double *control_N, *control_T; /* n: row of the given force */
    double *gap, *lambda;          /* n: with the unknowns at zero */
    double *start;                 /* size: the unknowns as the state had them */
    double *x;                     /* size: right-hand side, then solution */
} rb_rolling_reduced;

rb_status rb_rolling_reduced_alloc(const rb_rolling_problem *problem,
                                   rb_rolling_unknowns unknowns,
                                   const rb_rolling_state *state, rb_rolling_reduced *r);
void rb_rolling_reduced_free(rb_rolling_reduced *r);

/* r_T = slope mu r_N of a zone; 0 in stick, where r_T is an unknown of its own. */
double rb_rolling_slope(int zone);
/* Friction of slipping elements that follows an unknown pressure: mu, or 0 where the
 * pressure is not moved together with it. */
double rb_rolling_reduced_mu(const rb_rolling_problem *problem,
                             const rb_rolling_reduced *r);
/* Scale of the row of the given force. */
double rb_rolling_force_scale(const rb_rolling_problem *problem);

/* Sets the unknowns of the state to zero and the friction of slipping elements to its
 * bound; what is left is the right-hand side. */
void rb_rolling_reduced_right_side(const rb_rolling_problem *problem,
                                   rb_rolling_state *state, rb_rolling_reduced *r);
/* r->x into the state. */
void rb_rolling_reduced_result(const rb_rolling_problem *problem,
                               const rb_rolling_reduced *r, rb_rolling_state *state);

/* ---- matrix_free.c --------------------------------------------------------------------
 */

/* Solves the reduced problem by products with the flexibility, from r->start. */
rb_status rb_rolling_reduced_krylov(const rb_rolling_problem *problem, const int *zone,
                                    rb_rolling_reduced *r);

#endif
