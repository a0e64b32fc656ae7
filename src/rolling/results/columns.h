/* Columns of a solution. */
#ifndef ROLLBEM_ROLLING_RESULTS_COLUMNS_H
#define ROLLBEM_ROLLING_RESULTS_COLUMNS_H

#include "rolling/results/results.h"

/* Zeros for every column of the table that the case has; the owner's others stay NULL.
 * What there is on RB_ENOMEM is freed as if it were complete. */
rb_status rb_rolling_columns_alloc(const rb_rolling_results *table, const rb_rolling_case *rc,
                                   unsigned varies, int rows, void *owner);
void rb_rolling_columns_free(const rb_rolling_results *table, void *owner);

/* Tractions of the state on A in global x, y: 2 per contact element. */
void rb_rolling_contact_tractions(const rb_rolling_model *model, double *t);

/* Lengths of the elements in contact and of those among them that stick. */
void rb_rolling_zone_lengths(int n, const int *zone, const double *h, double *contact,
                             double *stick);

#endif
