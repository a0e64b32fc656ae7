/* The state of a sequence of steps of wear; of worn.c and wear_step.c alone. */
#ifndef ROLLBEM_ROLLING_HISTORY_WORN_H
#define ROLLBEM_ROLLING_HISTORY_WORN_H

#include "rolling/history/internal.h"
#include "rolling/solve/model.h"

typedef struct {
    const rb_rolling_wear *wear;
    rb_rolling_case rc;     /* on the present mesh, with the worn depth so far */
    rb_rolling_model model; /* mesh, bodies and the contact after the last step */
    int n;
    rb_arena memory;          /* of the arrays */
    double *x, *depth;        /* n: midpoints, and what is worn off there [length] */
    double *rate;             /* n: depth that a step wears per pressure [length/stress] */
    double *start;            /* n: depth at the start of the step [length] */
    double *pressed;          /* n positions: pressure under the present gap [stress] */
    double *first;            /* n positions: that of the first stage of a step */
    double *now;              /* n positions: that of the last stage */
    double *path;             /* n: way that the surfaces slide in a cycle [length] */
    rb_rolling_stroke stroke; /* of fretting, if it is not small */
    double *softer;           /* flexibility with the compliance on its diagonal, or, where there
                                 is no matrix, 2n: the interface's with it */
    double slid;              /* from the middle to either side in a cycle, mean of the contact */
    int was_worn;             /* 1: the case brings a worn depth */
    double work;              /* of friction in a cycle [force] */
    double track;             /* volume per unit width that B has lost where A slides or rolls on a
                                 plane [length^2] */
    double passage;           /* depth of that track in one passage of A [length] */
    rb_rolling_wear_history *history;
    rb_rolling_solution *last;
    const rb_rolling_wear_observer *observer; /* or NULL */
} wear_state;

/* Positions of A over B at which the contact is solved. */
static inline int rb_rolling_wear_positions(const wear_state *r)
{
    return r->stroke.positions > 0 ? r->stroke.positions : 1;
}

static inline rb_rolling_table rb_rolling_worn_so_far(const wear_state *r)
{
    return (rb_rolling_table){r->n, r->x, r->depth};
}

/* ---- wear_step.c ---------------------------------------------------------------- */

/* (W4) The diagonally implicit method of second order with weights 1 - gamma and gamma: both are
 * positive, so that nothing wears negatively, and the pressure at its end is that under its gap. */
#define GAMMA (1.0 - M_SQRT1_2)

/* The contact of these bodies with what is worn off so far.  sense: of full sliding, the sign of q;
 * 0: as it is pressed. */
rb_status rb_rolling_set_worn_problem(wear_state *r, const rb_rolling_bodies *bodies, double sense,
                                      rb_message *why);
/* A stage under the gap there is, to the pressures `now`.  before: those of the stage before. */
rb_status rb_rolling_press_worn(wear_state *r, double part, const double *before, rb_message *why);
/* What the pressure p wears off in a part of a step. */
void rb_rolling_wear_off(wear_state *r, double part, const double *p);
/* What the present pressure carries [force/length], where A slides. */
double rb_rolling_carried_load(const wear_state *r);
/* (W4) A part of a step; *mean: the load that its wear has carried, averaged.  halved: 0. */
rb_status rb_rolling_wear_advance(wear_state *r, double part, int halved, double *mean,
                                  rb_message *why);

#endif
