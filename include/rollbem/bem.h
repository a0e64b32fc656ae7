/* Plane-strain boundary elements: constant elements on straight lines, closed-form
 * integrals, condensation to the contact.  Friction does not appear here.  Equation tags
 * (B1) ... (B9): docs/theory.md. */
#ifndef ROLLBEM_BEM_H
#define ROLLBEM_BEM_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

/* ---- Elasticity ------------------------------------------------------------------ */

/* An isotropic material, with the constants that enter the formulas of plane strain. */
typedef struct {
    double shear;   /* G > 0 [stress] */
    double poisson; /* nu in (-1, 0.5]; in plane stress nu/(1 + nu) */
} rb_bem_material;

rb_bem_material rb_bem_material_from_young(double young, double poisson);

/* ---- Meshes (B4) ----------------------------------------------------------------- */

typedef enum {
    RB_BEM_TRACTION,     /* traction given, displacement unknown */
    RB_BEM_DISPLACEMENT, /* displacement given, traction unknown */
    RB_BEM_CONTACT       /* traction and displacement are kept: the traction is an input of the
                            condensed system */
} rb_bem_condition;

/* A mesh of any number of closed polygons.  The body lies on the left of each polygon
 * (outer contours counter-clockwise, holes clockwise).  Element j runs from (x0, y0)[j]
 * to (x1, y1)[j]. The contact elements, if any, are contiguous (numbers contact_first to
 * contact_first + contact_n - 1) and ordered by increasing x; their condition is
 * RB_BEM_CONTACT in both directions.  The element after them is the upstream element
 * (theory.md 4.2); it is free of traction, and its displacement is kept.  The functions that take a
 * mesh refuse one whose contours do not close, whose elements have no length or whose contact
 * elements are not contiguous: RB_EINVAL, and why names the element. */
typedef struct {
    int n;
    double *x0, *y0, *x1, *y1;   /* n each [length]; owned */
    rb_bem_condition *condition; /* 2n: (x, y) of each element; owned */
    double *value;               /* 2n: given traction [stress] or displacement; owned */
    int contact_first, contact_n;
} rb_bem_mesh;

rb_status rb_bem_mesh_alloc(int n, rb_bem_mesh *mesh); /* all traction-free */
void rb_bem_mesh_free(rb_bem_mesh *mesh);

typedef enum {
    RB_BEM_ARC,      /* clamped arc at the top */
    RB_BEM_HUB,      /* rigid core of radius hub_ratio R */
    RB_BEM_HALFPLANE /* no cylinder boundary: Flamant (B6) */
} rb_bem_support;

/* A cylinder whose lowest point is the origin and whose centre is (0, R) (B7, B9). */
typedef struct {
    double radius;
    rb_bem_support support; /* RB_BEM_ARC or RB_BEM_HUB */
    double arc;             /* half-angle of the clamped arc [rad], in (0, pi/2] */
    double hub_ratio;       /* in (0, 1) */
    double cover;           /* RB_BEM_HUB: thickness of a cover [length]; only the cover is meshed,
                               and it is fixed where it is bonded to its core; 0: no cover */
    int outer_elements;     /* number of elements on the outer circle outside the contact,
                               including the upstream one; a symmetric mesh gets one more if
                               the number is odd; 0: chosen so that neighbours differ in
                               length by at most a fifth */
    double refinement;      /* factor on the number of elements outside the contact and on the
                               hub; 0: 1 */
} rb_bem_cylinder;

/* Meshes a cylinder.  ends: n_c + 2 increasing abscissae |x| < R, the ends of n_c contact
 * elements and of the upstream element after them.  Outside the contact the elements grow
 * geometrically; symmetric ends give a symmetric mesh.  RB_EINVAL: the contact elements
 * reach the support, the ends do not increase, or the numbers of elements are out of
 * range; mesh is then empty. */
rb_status rb_bem_mesh_cylinder(const rb_bem_cylinder *cylinder, int n_c, const double *ends,
                               rb_bem_mesh *mesh, rb_message *why);

/* ---- Influence (B1-B3) ----------------------------------------------------------- */

/* A straight element from (x0, y0) to (x1, y1). */
typedef struct {
    double x0, y0, x1, y1;
} rb_bem_segment;

/* 2 x 2 blocks, column-major.  Row: direction of the unit load at p; column: component of
 * displacement (H) or traction (G) on the element. */
typedef struct {
    double H[4], G[4];
} rb_bem_blocks;

/* Integrals over one element for the source point p = (px, py).  self: p is the midpoint
 * of this element; H then includes the free term 1/2. */
rb_bem_blocks rb_bem_element_integrals(rb_bem_segment element, double px, double py, int self,
                                       rb_bem_material material);

/* H u = G t (B1).  2n x 2n, column-major, ld >= 2n; dofs x0, y0, x1, y1, ...  G may be
 * NULL.  H [-], G [length/stress].  The logarithm in G is that of r divided by the
 * diagonal of the bounding box of the mesh: the choice does not matter for tractions in
 * equilibrium, and no result then depends on the unit of length.  Uses all processors. */
rb_status rb_bem_assemble(const rb_bem_mesh *mesh, rb_bem_material material, double *H, double *G,
                          int ld, rb_message *why);

/* ---- Mixed problems and condensation (B4-B6) -------------------------------------- */

/* The factorised system A x = b of *Addi* (14); opaque. */
typedef struct rb_bem_system rb_bem_system;

/* Assembles and factorises the system once (LU).  The mesh is copied.  RB_EINVAL: the
 * body has no support, so that three rigid motions remain (the message says so), or the
 * material or the mesh is invalid; RB_SINGULAR; RB_ENOMEM. */
rb_status rb_bem_system_create(const rb_bem_mesh *mesh, rb_bem_material material,
                               rb_bem_system **system, rb_message *why);

void rb_bem_system_free(rb_bem_system *system);

/* Displacement u and traction t of every element (2n each, global x, y) under the mesh's
 * given values and the contact tractions t_contact (2 contact_n, global; NULL: zero). */
rb_status rb_bem_system_solve(const rb_bem_system *system, const double *t_contact, double *u,
                              double *t);

/* ---- Flexibility of the contact (B5) ---------------------------------------------- */

/* Whose normal n (into the body; A: +y) and tangent t (+x) the contact uses: those of the
 * flat obstacle, or those of each element as in *Addi* (18) (theory.md 4.3). */
typedef enum { RB_BEM_NORMALS_OBSTACLE, RB_BEM_NORMALS_SURFACE } rb_bem_normals;

/* w = w0 + F r: r = (r_N, r_T), 2n tractions on A along n and t, one per contact element;
 * w = (w_N, w_T), 2m displacements, m = n + 1: the n contact midpoints and the midpoint
 * of the upstream element, which carries no traction. F is stored as a dense matrix or as
 * a Toeplitz operator; the calls are the same for both. */
typedef struct rb_bem_flexibility rb_bem_flexibility;
struct rb_bem_flexibility {
    int n, m;
    double *x;          /* m midpoints [length]; owned */
    double *h;          /* m element lengths; owned */
    double *w0;         /* 2m [length]; owned */
    double *compliance; /* 2n [length/stress]: compliance of an interface on the elements,
                           n normal, then n tangential values; NULL: no interface, or F
                           includes it; owned */
    void (*apply)(const rb_bem_flexibility *f, const double *r, double *w); /* w = F r */
    rb_status (*matrix)(const rb_bem_flexibility *f, double *F, int ldf);   /* 2m x 2n */
    /* Adds the mirror image of b to a, without w0, and returns 1 if both are of this
     * kind; returns 0 if not.  NULL: two operators of this kind cannot be added. */
    int (*add_mirrored)(rb_bem_flexibility *a, const rb_bem_flexibility *b);
    void (*free_data)(void *data);
    void *data; /* private data of these functions; owned */
};

/* Condenses a cylinder's system to its contact: one solve with 2n right-hand sides. */
rb_status rb_bem_condense(const rb_bem_system *system, rb_bem_normals normals,
                          rb_bem_flexibility *f, rb_message *why);

/* Tractions on the edge y = 0 of a half-plane y >= 0; borrowed. */
typedef struct {
    int n;
    const double *x;     /* ends of n strips (n + 1), or n nodes; increasing */
    const double *p, *q; /* n: along +y, into the body (pressure), and along +x */
} rb_bem_edge_load;

/* The flexibility of an elastic half-plane (Flamant, theory.md 3) whose displacement is zero at the
 * distance datum > 0 along the surface from the loaded point.  ends as in rb_bem_mesh_cylinder, but
 * without the bound R. */
rb_status rb_bem_flexibility_halfplane(int n_c, const double *ends, rb_bem_material material,
                                       double datum, rb_bem_flexibility *f, rb_message *why);

/* Two bodies in contact (4.5): F_A + F_B.  B is computed as an upper body and mirrored,
 * so its coupling blocks enter with the opposite sign.  Takes ownership of a and b and
 * leaves both empty, also on failure.  RB_EINVAL: the points of a and b differ. */
rb_status rb_bem_flexibility_pair(rb_bem_flexibility *a, rb_bem_flexibility *b,
                                  rb_bem_flexibility *f, rb_message *why);

/* w = F r, without w0. */
void rb_bem_flexibility_apply(const rb_bem_flexibility *f, const double *r, double *w);
/* F: 2m x 2n column-major, ldf >= 2m. */
rb_status rb_bem_flexibility_matrix(const rb_bem_flexibility *f, double *F, int ldf);

void rb_bem_flexibility_free(rb_bem_flexibility *f);

/* ---- Interior (B8) ---------------------------------------------------------------- */

/* Points at which a field is evaluated. */
typedef struct {
    int n;
    const double *xy; /* x0, y0, x1, y1, ...; borrowed */
} rb_bem_points;

/* A body and the complete solution on its boundary; all pointers are borrowed. */
typedef struct {
    const rb_bem_mesh *mesh;
    rb_bem_material material;
    const double *u, *t; /* 2n each, of rb_bem_system_solve */
} rb_bem_boundary;

/* Displacement (2 per point) and stress (sxx, syy, sxy per point) at points inside the
 * body.  Either output may be NULL.  Element-wise constant u would jump at the ends of
 * elements; u is therefore interpolated linearly between midpoints, so that the stress
 * stays accurate close to the boundary.  At points on the surface the stress follows from
 * the tractions, the tangential strain and Hooke's law. */
rb_status rb_bem_interior(const rb_bem_boundary *body, rb_bem_points points, double *displacement,
                          double *stress, rb_message *why);

/* Stress below tractions that are constant on n strips [x[i], x[i+1]].  stress: 3 per
 * point (sxx, syy, sxy); on y = 0 the limit from inside. */
rb_status rb_bem_halfplane_stress(const rb_bem_edge_load *load, rb_bem_points points,
                                  double *stress);

RB_PUBLIC_END

#endif
