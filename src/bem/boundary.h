/* Boundary elements and the flexibility of a contact: what src/rolling asks of every body. */
#ifndef ROLLBEM_BEM_BOUNDARY_H
#define ROLLBEM_BEM_BOUNDARY_H

#include "base/base.h"
#include "base/sizes.h"
#include "rollbem/bem.h"

/* Bodies that few cases have (bem.h). */
typedef struct rb_bem_stack rb_bem_stack;
typedef struct rb_bem_surface rb_bem_surface;
typedef struct rb_bem_wheel rb_bem_wheel;

/* ---- Elasticity ------------------------------------------------------------------ */

/* Long bodies, loads per unit length, or thin discs, loads per unit thickness. */
typedef enum { RB_PLANE_STRAIN, RB_PLANE_STRESS } rb_bem_plane;

/* 1: 1 - 2 nu is below 1e-9: then what is left of the term that the pressure of a hub works on
 * drowns in the rounding of the others. */
int rb_bem_is_incompressible(rb_bem_material material);

/* Converts plane stress to plane strain (B2); nowhere else is this done.  young, poisson:
 * those of the real material; in plane stress poisson is in (-0.5, 0.5]. */
rb_bem_material rb_bem_material_in_plane(rb_bem_plane plane, double young, double poisson);

/* Estimated reciprocal condition number (1-norm) of the scaled matrix A; NAN if A is
 * hierarchical. */
double rb_bem_system_rcond(const rb_bem_system *system);

/* ---- Meshes (B4) ----------------------------------------------------------------- */

/* What all functions ask of a mesh (rb_bem_mesh). */
rb_status rb_bem_mesh_check(const rb_bem_mesh *mesh, rb_message *why);

/* Length of element j. */
double rb_bem_mesh_length(const rb_bem_mesh *mesh, int j);

/* Height of a circle above its lowest point, R - sqrt(R^2 - x^2), |x| <= R, without
 * cancellation (B9). */
double rb_bem_circle_height(double radius, double x);

/* The most elements of the contact, and outside it, of a cylinder's mesh. */
enum { RB_BEM_MOST_ELEMENTS = 1000000 };

/* Meshes the core of a covered cylinder (B11): a ring between the inner contour of the
 * cover's mesh, in reversed order, and a rigid hub of radius hub_ratio R.  RB_EINVAL: the
 * hub reaches the cover. */
rb_status rb_bem_mesh_core(const rb_bem_cylinder *cylinder, const rb_bem_mesh *cover,
                           rb_bem_mesh *core, rb_message *why);

/* ---- Mixed problems and condensation (B4-B6) -------------------------------------- */

/* Bytes that the system and its condensation need; serves to refuse sizes that are too
 * large. */
double rb_bem_system_bytes(int n, int n_c);

/* The instruction set that the integrals use on this processor: "AVX-512", "AVX2" or
 * "plain". */
const char *rb_bem_vector_name(void);

/* With RB_BEM_HIERARCHICAL elements or more the matrix is hierarchical: the flexibility agrees
 * to 1e-8, the work is about n log n, the memory of order n. */

/* As rb_bem_system_create; a hierarchical matrix is compressed to the relative tolerance
 * `compression`, if that is less than usual (at most 1e-9), for systems whose difference is
 * taken. */
rb_status rb_bem_system_create_within(const rb_bem_mesh *mesh, rb_bem_material material,
                                      double compression, rb_bem_system **system, rb_message *why);
/* The same for a few loads, of rb_bem_displacement_subtracted alone: a dense matrix is not
 * factored.
 */
rb_status rb_bem_system_create_for_few(const rb_bem_mesh *mesh, rb_bem_material material,
                                       double compression, rb_bem_system **system, rb_message *why);
/* A cover bonded to an elastic core (B11).  The inner contour of the cover (the last
 * elements of its mesh) has the displacement that the tractions there cause in the core.
 * The matrix is dense at any size.  RB_EINVAL also if the two meshes do not match, or if
 * the cover is incompressible. */
rb_status rb_bem_system_create_bonded(const rb_bem_mesh *cover, rb_bem_material material,
                                      const rb_bem_mesh *core, rb_bem_material core_material,
                                      rb_bem_system **system, rb_message *why);

/* Its elements; borrowed. */
const rb_bem_mesh *rb_bem_system_mesh(const rb_bem_system *system);

/* Seconds spent in assembly and in the LU. */
void rb_bem_system_seconds(const rb_bem_system *system, double *assembly, double *factor);

/* ---- Flexibility of the contact (B5) ---------------------------------------------- */

/* As rb_bem_condense, but more accurate close to the load (B10): the exact half-plane
 * solution of each loaded element is subtracted, and the boundary elements solve for the
 * smooth remainder.  RB_EINVAL also if the body does not lie on the inner side of every
 * contact element. */
rb_status rb_bem_condense_subtracted(const rb_bem_system *system, rb_bem_normals normals,
                                     rb_bem_flexibility *f, rb_message *why);

/* The same under a few loads alone, each a column (r_N, r_T) of r, 2 contact_n x loads: w, 2m x
 * loads, is F r of that flexibility, w0 (2m) its own, m = contact_n + 1.  A system for few loads is
 * solved by GMRES, and factored where that does not converge. */
rb_status rb_bem_displacement_subtracted(rb_bem_system *system, rb_bem_normals normals, int loads,
                                         const double *r, double *w, double *w0, rb_message *why);

/* Adds a compliant interface whose deformation at an element depends only on the traction
 * of this element: normal and tangential compliance on the diagonals of F_NN and F_TT
 * [length/stress], n values each, >= 0.  Call it after rb_bem_flexibility_pair.
 * RB_EINVAL, RB_ENOMEM. */
rb_status rb_bem_flexibility_add_compliance(rb_bem_flexibility *f, const double *normal,
                                            const double *tangential);

/* Adds w, 2m, to column j of the matrix of f.  RB_EINVAL: f does not store one. */
rb_status rb_bem_flexibility_add_column(rb_bem_flexibility *f, int j, const double *w);
/* To elements `scale` times as long, wherever they stand, of half-planes: the displacement by a
 * logarithm of the distance adds `along` [1/stress] times the length of a loaded element to F_NN
 * and F_TT.  ends: as of rb_bem_flexibility_surface.  RB_EINVAL: f does not store a matrix. */
rb_status rb_bem_flexibility_stretch(rb_bem_flexibility *f, const double *ends, double scale,
                                     double along);
/* The dense matrix of f, ld = 2m, borrowed; NULL if f does not store one. */
const double *rb_bem_flexibility_stored(const rb_bem_flexibility *f);
/* The same flexibility as a dense matrix. */
rb_status rb_bem_flexibility_as_matrix(const rb_bem_flexibility *f, rb_bem_flexibility *dense);
/* Converts f to a dense matrix.  RB_ENOMEM leaves f unchanged. */
rb_status rb_bem_flexibility_store(rb_bem_flexibility *f);

#endif
