/* What the files of this folder share, with those of rolling. */
#ifndef ROLLBEM_RESULTS_INTERNAL_H
#define ROLLBEM_RESULTS_INTERNAL_H

#include "rolling/internal.h"

/* ---- results.c --------------------------------------------------------------------- */

/* A row without columns, of numbers that are not there (NAN). */
rb_rolling_row rb_rolling_no_row(rb_status status);

/* Zeros for every column of the table that the case has; the owner's others stay NULL.
 * What there is on RB_ENOMEM is freed as if it were complete. */
rb_status rb_rolling_columns_alloc(const rb_rolling_results *table, const rb_rolling_case *rc,
                                   unsigned varies, int rows, void *owner);
void rb_rolling_columns_free(const rb_rolling_results *table, void *owner);

/* ---- solution.c -------------------------------------------------------------------- */

/* Tractions of the state on A in global x, y: 2 per contact element. */
void rb_rolling_contact_tractions(const rb_rolling_model *model, double *t);

/* ---- stress.c ---------------------------------------------------------------------- */

/* The stress in A below the tractions of a solved model, which it borrows. */
typedef struct rb_rolling_field rb_rolling_field;
rb_status rb_rolling_field_create(const rb_rolling_model *model, rb_rolling_field **field,
                                  rb_message *why);
void rb_rolling_field_free(rb_rolling_field *field);
/* As rb_rolling_stress_at. */
rb_status rb_rolling_field_at(const rb_rolling_field *field, int n, const double *xy,
                              rb_rolling_stress *stress, rb_message *why);
/* Its tractions, linear between nodes. */
const rb_bem_edge_load *rb_rolling_field_load(const rb_rolling_field *field);

/* ---- cycle.c ----------------------------------------------------------------------- */

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

/* ---- given_tractions.c ------------------------------------------------------------- */

/* From one end of what is loaded to the other: edges of the contact, NAN without one, or the first
 * and the last of given nodes. */
void rb_rolling_loaded_between(const rb_rolling_model *model, double *from, double *to);
/* On the surface, where given tractions jump: the mean of both sides; sxx NAN where q jumps. */
void rb_rolling_given_on_jump(const rb_rolling_model *model, double x, double *sigma);

/* Lengths of the elements in contact and of those among them that stick. */
void rb_rolling_zone_lengths(int n, const int *zone, const double *h, double *contact,
                             double *stick);

#endif
