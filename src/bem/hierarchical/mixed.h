/* Any entries of the matrix of a mixed problem (B4), and what stands for all that is far
 * from a set of elements. */
#ifndef ROLLBEM_BEM_HIERARCHICAL_MIXED_H
#define ROLLBEM_BEM_HIERARCHICAL_MIXED_H

#include "bem/hierarchical/cluster.h"
#include "bem/column.h"
#include "bem/incompressible.h"
#include "bem/hierarchical/skeleton.h"

/* Rows: displacement at the midpoints.  Columns: the unknowns, displacements or, where
 * these are given, tractions over unit[j].  Dofs 2j, 2j + 1 in the clusters' order. */
typedef struct {
    int n;
    rb_element *element;     /* n, owned, as all here */
    rb_constants *constants; /* G times -unit */
    int *held;               /* 2n: 1 where the unknown is a traction */
    rb_bem_material material;
    double size; /* of the mesh, inside the logarithm */
    rb_held_contours contours;
} rb_mixed;

/* order: element j is the mesh's order[j]; unit in the mesh's order. */
rb_status rb_mixed_make(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                        int levels, int *order, rb_mixed *a);
void rb_mixed_free(rb_mixed *a);

/* Rows of A, and then two at each of some points on a circle. */
typedef struct {
    rb_points points;
    int rows, own;  /* own: of A */
    const int *row; /* own, borrowed */
    int elements;   /* of which the own rows are */
    int *element;   /* their numbers, ascending; owned */
    int *at;        /* the row's place in a column over all points */
} rb_mixed_rows;

/* row: ascending.  points: on the circle; 0: none. */
rb_status rb_mixed_rows_make(const rb_mixed *a, int rows, const int *row, const rb_circle *circle,
                             int points, rb_mixed_rows *r);
void rb_mixed_rows_free(rb_mixed_rows *r);

/* Entry (i, j) of a matrix at x[i row_step + j column_step]. */
typedef struct {
    double *x;
    size_t row_step, column_step;
} rb_matrix_view;

/* out(i, j) = A(row i, column[j]). */
rb_status rb_mixed_block(const rb_mixed *a, const rb_mixed_rows *r, int columns, const int *column,
                         rb_matrix_view out);

/* out(i, j) = A(row[i], column[j]); row: ascending. */
rb_status rb_mixed_entries(const rb_mixed *a, int rows, const int *row, int columns,
                           const int *column, rb_matrix_view out);

/* What columns do to rows, and to points of the circle: the skeleton's K, not factored. */
rb_status rb_mixed_see_columns(const rb_mixed *a, int rows, const int *row, const rb_circle *circle,
                               int points, int columns, const int *column, rb_skeleton *far_field);

/* The same as rb_mixed_block for loads along x and y on each of `points` parts of the circle; of
 * order one. */
rb_status rb_mixed_far(const rb_mixed *a, const rb_mixed_rows *r, rb_circle circle, int points,
                       rb_matrix_view out);

#endif
