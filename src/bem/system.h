/* The factored mixed system, shared by its own file and the condensation. */
#ifndef ROLLBEM_BEM_SYSTEM_H
#define ROLLBEM_BEM_SYSTEM_H

#include "bem/boundary.h"

#include <lapacke.h>

typedef struct rb_hierarchical rb_hierarchical;
typedef struct rb_bond rb_bond;

/* Unknowns: the displacement where the traction is given or kept, else the traction,
 * measured in shear/length of the element so that all columns of A are of order one.
 * Their order is that of the contour, turned so that the contact and the upstream element
 * come last: the back substitution for them alone is then a small one. */
struct rb_bem_system {
    rb_bem_mesh mesh;
    rb_bem_material material;
    int dofs;   /* 2n */
    int ld;     /* of A and Gc */
    int offset; /* the dof that comes first */
    double *A;  /* LU, 2n x 2n; NULL where a hierarchical one stands instead: */
    rb_hierarchical *h;
    int is_assembled; /* A is the matrix itself, for few loads */
    rb_bond *bond;    /* to an elastic core; NULL: none */
    double *b;        /* of the given values, 2n */
    double *Gc;       /* columns of the contact tractions, 2n x 2 contact_n */
    double *unit;     /* of each element's tractions, n [stress] */
    lapack_int *pivot;
    double tolerance; /* of a hierarchical matrix */
    double rcond, seconds_assembly, seconds_factor;
};

/* The unknowns are numbered around the body from the neighbour of the upstream element on.  Those
 * of the contact and of the upstream element, which alone are wanted (B5), come last: back
 * substitution gives them first and stops there. */
static inline double *rb_bem_system_column(const rb_bem_system *s, int dof)
{
    return s->A + (size_t)((dof - s->offset + s->dofs) % s->dofs) * (size_t)s->ld;
}

/* As rb_bem_system_create_within, the matrix dense or hierarchical; bond: to an elastic core, taken
 * over; NULL: none. */
rb_status rb_bem_system_make(const rb_bem_mesh *mesh, rb_bem_material material, int dense,
                             double compression, rb_bond *bond, rb_bem_system **system,
                             rb_message *why);

/* A = L U, from a matrix that is assembled; or its hierarchical form.  RB_SINGULAR, RB_ENOMEM. */
rb_status rb_bem_system_factor(rb_bem_system *system, rb_message *why);

/* Solutions of A X = B in place, leading dimension ld, by GMRES, of a matrix that is assembled;
 * rows as in rb_bem_system_solve_columns.  RB_ENOMEM; RB_MAXITER: not of all
 * columns, the others are as they were. */
rb_status rb_bem_system_iterate(const rb_bem_system *s, int columns, double *X);

/* As rb_bem_system_create, the matrix dense or hierarchical at any size: to compare. */
rb_status rb_bem_system_create_as(const rb_bem_mesh *mesh, rb_bem_material material, int dense,
                                  rb_bem_system **system, rb_message *why);

/* u and t (2n each) under other given values than the mesh's: value (2n) holds u where
 * the displacement is given, t elsewhere, also on the contact. */
rb_status rb_bem_system_solve_values(const rb_bem_system *system, const double *value, double *u,
                                     double *t);

/* Normal into the body and tangent of contact element j, as rows: frame[0] = n, frame[1] = t. */
void rb_bem_contact_frame(const rb_bem_mesh *mesh, int j, rb_bem_normals normals,
                          double frame[2][2]);

/* RB_EINVAL unless the body lies on the inner side of every contact element. */
rb_status rb_bem_check_convex(const rb_bem_system *system, rb_message *why);

/* Solutions of A X = B in place, 2n x columns, leading dimension 2n; rows in, as the
 * dofs; out, as the unknowns.  RB_ENOMEM. */
rb_status rb_bem_system_solve_columns(const rb_bem_system *s, int columns, double *X);

#endif
