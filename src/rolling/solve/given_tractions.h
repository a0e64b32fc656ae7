/* Models of given tractions, for the stress below them. */
#ifndef ROLLBEM_ROLLING_SOLVE_GIVEN_TRACTIONS_H
#define ROLLBEM_ROLLING_SOLVE_GIVEN_TRACTIONS_H

#include "bem/bem.h"
#include "rolling/case/inputs.h"

/* Tractions on A that are given: linear between nodes, two at one place are a jump. */
typedef struct rb_rolling_given {
    rb_bem_edge_load load; /* in memory */
    rb_arena memory;
} rb_rolling_given;
void rb_rolling_given_free(rb_rolling_given *given);
/* A model without bodies that solves nothing, for the stress below given tractions.  x: places of
 * n rows, linear between them and zero outside; s: its loads, its largest pressure, or friction
 * without one, as max_pressure, and half the loaded width.  RB_EFORMAT: the rows cannot be used.
 * Free the model in any case. */
rb_status rb_rolling_model_of_nodes(const rb_rolling_case *rc, int n, const double *x,
                                    const double *p, const double *q, rb_rolling_model *model,
                                    rb_rolling_solution *s, rb_message *why);
/* The same of the elements of a solved contact: midpoints, lengths, tractions and zones. */
rb_status rb_rolling_model_of_elements(const rb_rolling_case *rc, int n, const double *x,
                                       const double *h, const double *p, const double *q,
                                       const double *zone, rb_rolling_model *model,
                                       rb_rolling_solution *s, rb_message *why);
/* Rows of a table of tractions: nodes, or with h and zone elements; all borrowed. */
typedef struct {
    int n;
    const double *x, *p, *q, *h, *zone;
} rb_rolling_traction_rows;
/* By one of the two functions above. */
rb_status rb_rolling_model_of_rows(const rb_rolling_case *rc, const rb_rolling_traction_rows *rows,
                                   rb_rolling_model *model, rb_rolling_solution *s,
                                   rb_message *why);
/* The largest stresses leave out such a part of half the loaded width around jumps of friction. */
#define RB_ROLLING_LEFT_OUT 1e-3
/* The next place from node *k on where given friction jumps, so that sxx is unbounded at the
 * surface there; NAN: there is no more.  *k: set behind it. */
double rb_rolling_next_friction_jump(const rb_rolling_model *model, int *k);
/* Whether it jumps at this place. */
int rb_rolling_friction_jumps_at(const rb_rolling_model *model, double x);

#endif
