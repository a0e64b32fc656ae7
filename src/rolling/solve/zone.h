/* The potential contact, and whether it holds the whole contact. */
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

/* ---- low_gap.c ------------------------------------------------------------------ */

/* Between first_x and last_x the interval about the lowest place in which the gap is at most `rise`
 * above that, and no more than the approach; the smallest gap, and the level of the ends. */
void rb_rolling_low_gap(const rb_rolling_case *rc, double first_x, double last_x, double rise,
                        double *from, double *to, double *least, double *level);

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

/* ---- at_bound.c ------------------------------------------------------------- */

/* 1: a third body yields, and hardens or softens, so that a force tells the slip even where
 * nothing sticks. */
int rb_rolling_carries_more_with_slip(const rb_rolling_case *rc);
/* Of n elements with their coefficients mu (NULL: `one` everywhere): those that stick at the bound
 * of their friction, or of a third body that does not harden. */
int rb_rolling_count_at_bound(const rb_rolling_case *rc, int n, const int *zone, const double *p,
                              const double *q, const double *mu, double one);
/* 1: some of n elements slip or yield with q < 0 and others with q > 0. */
int rb_rolling_slips_both_ways(int n, const int *zone);
/* Where a given force does not tell the motion of a solved state, because nothing is held and
 * elements slide towards both sides: the middle of its range, which mirrored cases share.  Not with
 * a third body that yields, nor with coefficients that follow the slip.  RB_ENOMEM. */
rb_status rb_rolling_take_middle(const rb_rolling_case *rc, const rb_contact_problem *problem,
                                 rb_contact_state *state);

#endif
