/* The operator that has its matrices, and the LU that Newton keeps of them. */
#ifndef ROLLBEM_CONTACT_DENSE_H
#define ROLLBEM_CONTACT_DENSE_H

#include "lcp/contact/internal.h"

/* The LU for the zones of earlier solves, one for each of rb_contact_unknowns. */
typedef struct rb_contact_factors rb_contact_factors;

typedef struct {
    rb_contact_operator base;
    double *S;                     /* owned, as the factors */
    rb_contact_factors *factors;   /* empty at first and when cleared */
    rb_contact_operator *products; /* NULL: none; owned */
    /* Of a given load the LU has this [length/load] times the load of each element more in its
     * column of F_NN, which only adds to delta: so it serves elements of another length, too. */
    double along;
} rb_contact_dense;

rb_status rb_contact_factors_create(rb_contact_factors **factors);
void rb_contact_factors_clear(rb_contact_factors *factors);
void rb_contact_factors_free(rb_contact_factors *factors);
/* What has been made with `from` along is that of `to`; the rest is cleared. */
void rb_contact_factors_move(rb_contact_factors *factors, double from, double to);

/* Which LU: of the tractions for earlier zones where these have not changed too much, or
 * else, or at once, for the present ones; or of all unknowns together, which is not kept:
 * the tractions alone may have no inverse where the load or the force is given. */
typedef enum { RB_LU_KEPT, RB_LU_NEW, RB_LU_WHOLE, RB_LU_KINDS } rb_contact_lu;

/* The reduced problem of some zones, for several right-hand sides one after the other: what has
 * changed since the LU is eliminated once. */
typedef struct rb_contact_elimination rb_contact_elimination;
/* Borrows the problem and its factors; end it in any case.  RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_elimination_begin(const rb_contact_problem *problem, const int *zone,
                                       rb_contact_lu lu, rb_contact_reduced *r,
                                       rb_contact_elimination **elimination);
/* r->x: the right-hand side, then the solution; r->growth: how many digits have cancelled. */
void rb_contact_elimination_solve(rb_contact_elimination *elimination, rb_contact_reduced *r);
void rb_contact_elimination_end(rb_contact_elimination *elimination);

/* pairs.c: F and S of the elements in pairs; a pair has one traction, the mean gap and
 * slip. */
rb_status rb_contact_dense_halve(const rb_contact_operator *fine, int differences,
                                 rb_contact_operator **half);

#endif
