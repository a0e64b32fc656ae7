/* The matrix of a mixed problem as a hierarchical matrix (hmat-oss) and its LU: what lies
 * far apart has low rank; n log^2 n work and memory.  Not installed. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_H
#define ROLLBEM_BEM_HIERARCHICAL_H

#include "rollbem/bem.h"

typedef struct rb_hierarchical rb_hierarchical;

/* Unknowns in the order of the dofs: displacements where the traction is given or kept,
 * else tractions over `unit` (n, one per element).  tolerance: relative, of every block.
 */
rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance,
                                 rb_hierarchical **h);
rb_status rb_hierarchical_factor(rb_hierarchical *h);
/* X: 2n x columns, overwritten by the solutions. */
rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X);
/* Numbers stored / 4 n^2. */
double rb_hierarchical_ratio(const rb_hierarchical *h);
void rb_hierarchical_free(rb_hierarchical *h);

#endif
