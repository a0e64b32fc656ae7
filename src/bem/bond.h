/* A cover bonded to an elastic core (B11): what the core answers to the tractions of
 * their interface, so that the cover's boundary elements see it as a support that gives
 * way; not installed. */
#ifndef ROLLBEM_BEM_BOND_H
#define ROLLBEM_BEM_BOND_H

#include "bem/assemble.h"
#include "bem/system.h"

#include <complex.h>

/* Dofs of the interface count as in the cover's mesh, from its element `first` on. */
typedef struct rb_bond {
    int first, n, hub_n; /* elements of the interface, of the core's hub */
    rb_bem_mesh core;    /* the interface run backwards, then the hub; owned */
    rb_bem_material material;
    double *C; /* 2n x 2n: u of the interface = -C t, t the traction on the cover; owned */
    double *W; /* 2n x 2 hub_n: u of the interface for displacements of the hub; behind C */
} rb_bond;

/* The last elements of the cover are the interface, the first ones of the core are the
 * same run backwards.  RB_EINVAL where they are not; RB_SINGULAR, RB_ENOMEM. */
rb_status rb_bond_create(const rb_bem_mesh *cover, const rb_bem_mesh *core,
                         rb_bem_material material, rb_bond **bond, rb_message *why);
void rb_bond_free(rb_bond *bond);

/* On the bonded contour u = -C t: the columns of its tractions in the matrix of the cover, -G so
 * far, become -(G + H C).  RB_ENOMEM. */
rb_status rb_bond_add(rb_bem_system *cover, const rb_assembly *assembly);

/* The displacement ux + i uy of a strip's field at z. */
typedef double complex rb_bond_field(rb_bem_material material, double complex z,
                                     const void *context);

/* Where the strips of a load are subtracted (B10), in cover and core each in its own
 * material, the rest of the cover moves by value - C t_rest on the interface: value, 2n. */
rb_status rb_bond_left_over(const rb_bond *bond, const rb_bem_mesh *cover, rb_bem_material material,
                            rb_bond_field *field, const void *context, double *value);

#endif
