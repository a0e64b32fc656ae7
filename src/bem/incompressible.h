/* A uniform pressure on a contour that is held all around takes no volume from an
 * incompressible body: div U = 0, so G has no answer to it and the matrix of the mixed
 * problem would be singular.  No displacement depends on it; a rank-one term for each
 * such contour, its normals times themselves, sets its mean to zero. */
#ifndef ROLLBEM_BEM_INCOMPRESSIBLE_H
#define ROLLBEM_BEM_INCOMPRESSIBLE_H

#include "bem/boundary.h"

typedef struct {
    int count;      /* contours; 0: nothing else is there */
    int *contour;   /* n: of each element, -1: none; owned */
    double *normal; /* 2n, outward over the root of the contour's elements; owned */
} rb_held_contours;

rb_status rb_held_contours_find(const rb_bem_mesh *mesh, rb_bem_material material,
                                rb_held_contours *held);
void rb_held_contours_free(rb_held_contours *held);

/* What the term adds to the entry of two dofs. */
static inline double rb_held_contours_term(const rb_held_contours *held, int row, int column)
{
    return held->contour[row / 2] == held->contour[column / 2]
               ? held->normal[row] * held->normal[column]
               : 0.0;
}

#endif
