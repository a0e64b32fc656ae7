/* The factored matrix of a mixed problem, without ever having been there as a whole:
 * recursive skeletonisation (Martinsson and Rokhlin 2005, Ho and Ying 2016).  What a
 * cluster of elements and all that lies far from it exchange has low rank: a few of its
 * rows and columns, the skeleton, stand for all; the others are eliminated.  Two
 * clusters' skeletons are a cluster of the next level.  About n log n work, memory of
 * order n.  Not installed. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_HIERARCHICAL_H
#define ROLLBEM_BEM_HIERARCHICAL_HIERARCHICAL_H

#include "bem/boundary.h"

typedef struct rb_hierarchical rb_hierarchical;

/* Unknowns in the order of the dofs: displacements where the traction is given or kept,
 * else tractions over `unit` (n, one per element).  tolerance: relative, of what a
 * cluster's skeleton says of the others.  RB_SINGULAR, RB_ENOMEM.  Uses every processor. */
rb_status rb_hierarchical_create(const rb_bem_mesh *mesh, rb_bem_material material,
                                 const double *unit, double tolerance, rb_hierarchical **h);
/* X: 2n x columns, leading dimension 2n, overwritten by the solutions. */
rb_status rb_hierarchical_solve(const rb_hierarchical *h, int columns, double *X);
void rb_hierarchical_free(rb_hierarchical *h);

#endif
