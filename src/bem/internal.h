/* Shared by the files of src/bem; not installed. */
#ifndef ROLLBEM_BEM_INTERNAL_H
#define ROLLBEM_BEM_INTERNAL_H

#include "bem/boundary.h"

/* Pairs of point and element from which several threads pay: fewer are done before the
 * others have woken, and waiting for them on a busy machine costs far more. */
static const double rb_pairs_for_threads = 2e5;

/* RB_EINVAL unless 0 < shear < infinity and -1 < nu <= 1/2. */
rb_status rb_bem_material_check(rb_bem_material material, rb_message *why);

/* RB_EINVAL unless n_c >= 1 and the n_c + 2 ends are finite and increase. */
rb_status rb_bem_ends_check(int n_c, const double *ends, rb_message *why);

rb_status rb_bem_mesh_copy(const rb_bem_mesh *from, rb_bem_mesh *to);

/* The length that sets the scale, in logarithms too: the diagonal of the square around a circle
 * as long as the longest contour.  A box around the elements would have kinks where they move and
 * another one becomes the widest. */
double rb_bem_mesh_size(const rb_bem_mesh *mesh);

/* next[j]: the element that begins where j ends; the mesh is checked. */
void rb_bem_mesh_next(const rb_bem_mesh *mesh, int *next);

/* RB_EINVAL unless the displacements that the mesh prescribes block all rigid motions;
 * the free ones are named. */
rb_status rb_bem_support_check(const rb_bem_mesh *mesh, rb_message *why);

/* s; unless that is RB_OK, f is freed and why says that there was no memory for it. */
rb_status rb_bem_flexibility_end(const char *what, int n_c, rb_status s, rb_bem_flexibility *f,
                                 rb_message *why);

/* A flexibility with x, h, w0 zeroed and nothing behind it. */
rb_status rb_bem_flexibility_points(int n, rb_bem_flexibility *f);
/* x and h of elements between these ends (n + 2). */
void rb_bem_flexibility_place(const double *ends, rb_bem_flexibility *f);

/* x, h and w0 of as many elements. */
void rb_bem_flexibility_copy_points(const rb_bem_flexibility *from, rb_bem_flexibility *to);
/* Columns of B, mirrored, onto those of A, 2m x 2n each; leading dimensions 2m and lda. */
void rb_bem_add_mirrored_columns(int n, int m, const double *B, double *A, int lda);

/* A flexibility with x, h, w0 zeroed and a dense matrix of zeros behind it; *F: that
 * matrix, 2m x 2n with leading dimension 2m, borrowed.  RB_ENOMEM leaves f empty. */
rb_status rb_bem_flexibility_dense(int n, rb_bem_flexibility *f, double **F);

#endif
