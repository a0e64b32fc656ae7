/* The wall's parts: geometry, joints, and the system that moves. */
#ifndef ROLLBEM_FEM_WALL_H
#define ROLLBEM_FEM_WALL_H

#include "fem/fem.h"

enum { COURSES = 5, BLOCKS = 12, UPPER_SUPPORT = BLOCKS, LOWER_SUPPORT = -1 };

/* A box of n[0] x n[1] x n[2] nodes, the first index fastest. */
typedef struct {
    double low[3], size[3];
    int n[3], course, first; /* first: its first node in the mesh */
} wall_block;

typedef struct {
    wall_block block[BLOCKS];
    int nodes, elements;
} wall_layout;

wall_layout wall_lay_out(const rb_fem_wall_options *o);
rb_status wall_build_mesh(const wall_layout *layout, rb_fem_mesh *mesh);

/* A node that meets the face of another block or a support.  N = sign e_axis points from
 * that other body to the node's block. */
typedef struct {
    int node, other, axis;
    double sign;
} wall_contact;

/* joints: NULL only counts. */
int wall_find_contacts(const wall_layout *layout, wall_contact *contacts);
/* dofs of the mesh and, last, the upper support's vertical one. */
rb_status wall_contact_map(const wall_layout *layout, const rb_fem_mesh *mesh, int contacts,
                           const wall_contact *contact, rb_sparse *H);
/* Axis of component k of a contact's frame (N, T1, T2). */
int wall_axis(const wall_contact *c, int k);

/* M v' = F - K u + H r: of the elastic wall or of the rigid one. */
typedef struct {
    int dofs;
    rb_sparse M, K, H;
    double *weight; /* dofs: gravity */
    double *press;  /* dofs: of a unit force on the upper support */
} wall_system;

void wall_system_free(wall_system *s);
rb_status wall_elastic_system(const wall_layout *layout, const rb_fem_mesh *mesh, int contacts,
                              const wall_contact *contact, wall_system *s, rb_message *why);
/* Six freedoms a block and the support's: R' M R, 0, R' H, R' weight.  R: kept by the
 * caller for displacements. */
rb_status wall_rigid_system(const wall_layout *layout, const rb_fem_mesh *mesh,
                            const wall_system *elastic, rb_sparse *R, wall_system *s);

#endif
