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
    double force_scale;            /* of that row */
    double *gap, *lambda;          /* n: with the unknowns at zero */
    double *start;                 /* size: the unknowns as the state had them */
    double *x;                     /* size: right-hand side, then solution */
    int changes;                   /* of unknowns since the LU that solved it */
    double growth;                 /* of tractions without borders over those with */
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

/* Sets the unknowns of the state to zero and the friction of slipping elements to its
 * bound. */
void rb_rolling_reduced_clear(const rb_rolling_problem *problem,
                              const rb_rolling_reduced *r, rb_rolling_state *state);
/* r->x: what the equations lack with the unknowns as the state has them. */
void rb_rolling_reduced_right_side(const rb_rolling_problem *problem,
                                   const rb_rolling_state *state, rb_rolling_reduced *r);
/* Adds r->x to the unknowns of the state. */
void rb_rolling_reduced_add(const rb_rolling_problem *problem,
                            const rb_rolling_reduced *r, rb_rolling_state *state);

/* ---- factors.c ------------------------------------------------------------------------
 */

/* Which LU: of the tractions for earlier zones where these have not changed too much, or
 * else, or at once, for the present ones; or of all unknowns together, which is not kept:
 * the tractions alone may have no inverse where the load or the force is given. */
typedef enum { RB_LU_KEPT, RB_LU_NEW, RB_LU_WHOLE, RB_LU_KINDS } rb_rolling_lu;

/* Solves the reduced problem.  RB_SINGULAR, RB_ENOMEM. */
rb_status rb_rolling_reduced_direct(rb_rolling_problem *problem, const int *zone,
                                    rb_rolling_lu lu, rb_rolling_reduced *r);

/* ---- matrix_free.c --------------------------------------------------------------------
 */

/* Solves the reduced problem by products with the flexibility, from r->start. */
rb_status rb_rolling_reduced_krylov(const rb_rolling_problem *problem, const int *zone,
                                    rb_rolling_reduced *r);

#endif
