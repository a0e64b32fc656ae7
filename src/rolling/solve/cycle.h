/* What fretting has done in the last cycle of a history (Q1). */
#ifndef ROLLBEM_ROLLING_SOLVE_CYCLE_H
#define ROLLBEM_ROLLING_SOLVE_CYCLE_H

#include "rolling/case/inputs.h"

/* Of each element: work of friction, slip in contact so far, the least and the largest of it,
 * largest friction. */
enum {
    RB_CYCLE_WORK,
    RB_CYCLE_SLIP,
    RB_CYCLE_LEAST_SLIP,
    RB_CYCLE_MOST_SLIP,
    RB_CYCLE_FRICTION,
    RB_CYCLE_SUMS
};
/* Of each place of a body's surface, the elements and behind them two edges. */
enum {
    RB_CYCLE_TENSION,
    RB_CYCLE_LEAST_STRAIN,
    RB_CYCLE_MOST_STRAIN,
    RB_CYCLE_SHEAR,
    RB_CYCLE_EXTREMES
};

/* What fretting has done to each element in the last cycle of a history (Q1). */
typedef struct rb_rolling_cycle {
    int n, bodies;
    int is_over; /* 1: its last row is done */
    double edge[2];
    double *sums, *kept; /* RB_CYCLE_SUMS x n, now and at the end of the last row */
    double *extreme;     /* bodies x RB_CYCLE_EXTREMES x (n + 2) */
    double *q;           /* n: friction where the cycle began */
    rb_arena memory;
} rb_rolling_cycle;

void rb_rolling_cycle_free(rb_rolling_cycle *cycle);
double *rb_rolling_cycle_extreme(const rb_rolling_cycle *cycle, int body, int which);
/* Its columns and largest values of a solution; NAN where the model has none. */
void rb_rolling_cycle_results(const rb_rolling_model *model, rb_rolling_solution *s);

#endif
