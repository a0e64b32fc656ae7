/* Products with the matrix of what is given (B4), without the matrix: a tree of clusters,
 * a few of whose columns stand for all of them when seen from afar.  About n log n work.
 * Not installed. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_GIVEN_H
#define ROLLBEM_BEM_HIERARCHICAL_GIVEN_H

#include "bem/bem.h"

typedef struct rb_given rb_given;

/* unit: n, of each element's tractions.  tolerance: relative, of what a cluster's
 * skeleton says of its other columns.  RB_ENOMEM. */
rb_status rb_given_create(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                          double tolerance, rb_given **given);

/* X += G t - H u of some elements: value, 2 count x columns, has u where the displacement
 * is given and t elsewhere, in the order of `element` (count); X: 2n x columns. */
rb_status rb_given_multiply(const rb_given *given, int count, const int *element, int columns,
                            const double *value, double *X);

void rb_given_free(rb_given *given);

#endif
