/* Wear: of sliding, fretting and rolling. */
#ifndef ROLLBEM_ROLLING_HISTORY_WEAR_H
#define ROLLBEM_ROLLING_HISTORY_WEAR_H

#include "rolling/case/inputs.h"

typedef enum {
    RB_WEAR_ARCHARD,    /* depth = K int p |ds| */
    RB_WEAR_DISSIPATION /* depth = K int |q| |ds| */
} rb_rolling_wear_law;

/* Wear of A, and of B according to its share.  There are three cases.  Sliding over B
 * towards +x (static, `slides`): B's wear is spread over its track and does not change
 * the gap.  Fretting between the shift or force of the case and its opposite (static):
 * both bodies wear in the contact, and where all of it slides over more than a tenth of the
 * half-width each by its own profile (theory-rolling.md 4.9, W5).  Steady rolling: round bodies
 * stay round, and their radii change. */
typedef struct {
    rb_rolling_wear_law law;
    double coefficient; /* K [1/stress], of both bodies together */
    double share;       /* of B, 0 ... 1 */
    int slides;
    double way;     /* total sliding distance [length], or number of cycles or turns */
    int steps;      /* number of equal steps; each is implicit and stable for any length */
    int increments; /* fretting: number of increments per quarter of a cycle */
} rb_rolling_wear;

/* One entry per step; the first entry is the state before any wear.  Arrays are owned. */
typedef struct rb_rolling_wear_history {
    int n;
    double *way;       /* sliding distance so far [length], or number of cycles or turns */
    double *worn;      /* volume of A per unit width [length^2] */
    double *max_depth; /* [length] */
    double *radius;    /* of A [length] */
    /* The same of B; NULL if B does not wear, radius_b also if B is a plane.  If A slides
     * or rolls over a plane: the depth of one passage. */
    double *worn_b, *max_depth_b, *radius_b;
    double *work;   /* of friction: per sliding or rolling distance [force/length], or per
                       cycle [force] */
    double *stroke; /* fretting: A slides to -stroke ... stroke over B, mean of the contact
                       [length]; NULL otherwise */
    double *approach, *normal_load, *max_pressure, *contact_from, *contact_to;
    double *residual; /* of the contact under the worn gap */
    double radius_before, radius_b_before;
    int slides, rolls; /* both 0: fretting */
    int positions;     /* along the stroke at which the contact was solved; 0: the stroke is small.
                          Then pressure, contact and the worn depth of the solution, which is that
                          of both bodies, belong to the middle of the stroke. */
    int stick_edge;    /* 1: a part of the contact sticks in every cycle and wears nothing; at its
                          edge the pressure grows without bound */
    rb_units units;    /* of all values here */
    struct rb_rolling_wear_history *errors; /* error bars of the columns that have them; NULL: not
                                               estimated; owned */
} rb_rolling_wear_history;

void rb_rolling_wear_history_free(rb_rolling_wear_history *history);
/* Converts from mm, N, MPa to other units; call it once only. */
void rb_rolling_wear_history_convert(rb_rolling_wear_history *history, rb_units units);

/* Called with the solution after each step (0: before the first one); the function may
 * convert the solution to other units.  A return value other than 0 ends the run. */
typedef int rb_rolling_wear_step(rb_rolling_solution *solution,
                                 const rb_rolling_wear_history *history, int step, int steps,
                                 void *context);

typedef struct {
    rb_rolling_wear_step *step;
    void *context;
} rb_rolling_wear_observer;

/* Computes wear on a fixed mesh of equal elements; on half-planes elements are added when
 * the wear scar becomes wider than an automatic zone.  last: the solution after the last
 * finished step, with the worn depth as a column.  observer may be NULL.  history and
 * last are overwritten; they hold the finished steps also on RB_INTERRUPTED and other
 * positive statuses.  Free both in any case.  RB_EINVAL: nothing would wear. */
rb_status rb_rolling_wear_run(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                              const rb_rolling_wear_observer *observer,
                              rb_rolling_wear_history *history, rb_rolling_solution *last,
                              rb_message *why);

#endif
