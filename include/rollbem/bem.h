/* Plane-strain boundary elements: constant elements on straight lines, closed-form
 * integrals, condensation to the contact.  Knows no friction.
 * Equation tags (B1) ... (B9): docs/theory.md. */
#ifndef ROLLBEM_BEM_H
#define ROLLBEM_BEM_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

/* ---- Elasticity ------------------------------------------------------------------ */

/* Long bodies, loads per unit length, or thin discs, loads per unit thickness. */
typedef enum { RB_PLANE_STRAIN, RB_PLANE_STRESS } rb_bem_plane;

/* Isotropic, with the constants that the formulas of plane strain take. */
typedef struct {
    double shear;   /* G > 0 [stress] */
    double poisson; /* nu in (-1, 0.5]; in plane stress nu/(1 + nu) */
} rb_bem_material;

rb_bem_material rb_bem_material_from_young(double young, double poisson);
/* The one place where plane stress is turned into plane strain (B2): poisson in
 * (-0.5, 0.5] of the material itself. */
rb_bem_material rb_bem_material_in_plane(rb_bem_plane plane, double young,
                                         double poisson);

/* ---- Meshes (B4) ----------------------------------------------------------------- */

typedef enum {
    RB_BEM_TRACTION,     /* traction given, displacement unknown */
    RB_BEM_DISPLACEMENT, /* displacement given, traction unknown */
    RB_BEM_CONTACT       /* both kept: traction is an input of the condensed system */
} rb_bem_condition;

/* Any number of closed polygons, each with the body on its left (outer contours
 * counter-clockwise, holes clockwise).  Element j runs from (x0, y0)[j] to (x1, y1)[j].
 * The contact elements, if any, are contiguous, contact_first ... + contact_n - 1, in the
 * order of increasing x, and both their directions are RB_BEM_CONTACT.  The element after
 * them is the upstream one (theory.md 4.2): traction-free, its displacement is kept. */
typedef struct {
    int n;
    double *x0, *y0, *x1, *y1;   /* n each [length]; owned */
    rb_bem_condition *condition; /* 2n: (x, y) of each element; owned */
    double *value;               /* 2n: given traction [stress] or displacement; owned */
    int contact_first, contact_n;
} rb_bem_mesh;

rb_status rb_bem_mesh_alloc(int n, rb_bem_mesh *mesh); /* all traction-free */
void rb_bem_mesh_free(rb_bem_mesh *mesh);
/* Of element j. */
double rb_bem_mesh_length(const rb_bem_mesh *mesh, int j);

/* Appends nothing itself: checks that every contour closes, no element has zero length,
 * contact elements are contiguous.  RB_EINVAL with the element's number in why. */
rb_status rb_bem_mesh_check(const rb_bem_mesh *mesh, rb_message *why);

typedef enum {
    RB_BEM_ARC,      /* clamped arc at the top */
    RB_BEM_HUB,      /* rigid core of radius hub_ratio R */
    RB_BEM_HALFPLANE /* no cylinder boundary: Flamant (B6) */
} rb_bem_support;

/* A cylinder whose lowest point is the origin, its centre (0, R) (B7, B9). */
typedef struct {
    double radius;
    rb_bem_support support; /* RB_BEM_ARC or RB_BEM_HUB */
    double arc;             /* half-angle of the clamped arc [rad], in (0, pi/2] */
    double hub_ratio;       /* in (0, 1) */
    double cover;           /* RB_BEM_HUB: thickness of a cover [length]; the mesh is the
                               cover's, held where it is bonded to its core; 0: none */
    int outer_elements;     /* so many on the outer circle outside the contact, with the
                               upstream one; one more for an odd number where the mesh
                               is symmetric; 0: chosen so that neighbours differ by at
                               most a fifth */
    double refinement;      /* so many times the elements outside the contact and on the
                               hub; 0: 1 */
} rb_bem_cylinder;

/* R - sqrt(R^2 - x^2) without cancellation (B9): height of a circle above its lowest
 * point, |x| <= R. */
double rb_bem_circle_height(double radius, double x);

/* ends: n_c + 2 increasing abscissae |x| < R: the ends of n_c contact elements and of the
 * upstream element after them.  Geometric grading outside; symmetric ends make a
 * symmetric mesh. RB_EINVAL: zone reaching the support, ends not increasing, counts
 * absurd. */
rb_status rb_bem_mesh_cylinder(const rb_bem_cylinder *cylinder, int n_c,
                               const double *ends, rb_bem_mesh *mesh, rb_message *why);

/* The core of a covered cylinder, a ring between the inner contour of its cover's mesh,
 * run backwards, and a rigid hub of hub_ratio R (B11).  RB_EINVAL: the hub reaches the
 * cover. */
rb_status rb_bem_mesh_core(const rb_bem_cylinder *cylinder, const rb_bem_mesh *cover,
                           rb_bem_mesh *core, rb_message *why);

/* ---- Influence (B1-B3) ----------------------------------------------------------- */

/* A straight element from (x0, y0) to (x1, y1). */
typedef struct {
    double x0, y0, x1, y1;
} rb_bem_segment;

/* Blocks 2 x 2, column-major: row = unit load direction at p, column = component on the
 * element. */
typedef struct {
    double H[4], G[4];
} rb_bem_blocks;

/* Integrals over one element seen from p = (px, py).  self: p is the element's own
 * midpoint; then H holds the free term 1/2. */
rb_bem_blocks rb_bem_element_integrals(rb_bem_segment element, double px, double py,
                                       int self, rb_bem_material material);

/* H u = G t (B1).  2n x 2n, column-major, ld >= 2n; dofs x0, y0, x1, y1, ...  G may be
 * NULL.  H [-], G [length/stress].  G's logarithm is that of r over the diagonal of the
 * box around the mesh: tractions in equilibrium do not feel the choice, and no result
 * depends on the unit of length.  Uses every processor. */
rb_status rb_bem_assemble(const rb_bem_mesh *mesh, rb_bem_material material, double *H,
                          double *G, int ld, rb_message *why);

/* ---- Mixed problems and condensation (B4-B6) -------------------------------------- */

/* The factored system A x = b of *Addi* (14); opaque. */
typedef struct rb_bem_system rb_bem_system;

/* Bytes that the system and its condensation take, to refuse absurd sizes beforehand. */
double rb_bem_system_bytes(int n, int n_c);

/* "AVX-512", "AVX2" or "plain": what the integrals run on here. */
const char *rb_bem_vector_name(void);

/* From so many elements on the matrix is hierarchical: the same flexibility to 1e-8,
 * about n log n work, memory of order n. */
enum { RB_BEM_HIERARCHICAL = 1500 };

/* One assembly and one LU.  The mesh is copied.  RB_EINVAL: no support (three rigid
 * motions remain; the message says so), bad material or mesh; RB_SINGULAR; RB_ENOMEM. */
rb_status rb_bem_system_create(const rb_bem_mesh *mesh, rb_bem_material material,
                               rb_bem_system **system, rb_message *why);
/* A cover bonded to an elastic core (B11): its inner contour, the last elements of the
 * mesh, moves as the core answers to the tractions there.  The matrix is dense at any
 * size. RB_EINVAL also where the two do not fit together, or the cover is incompressible.
 */
rb_status rb_bem_system_create_bonded(const rb_bem_mesh *cover, rb_bem_material material,
                                      const rb_bem_mesh *core,
                                      rb_bem_material core_material,
                                      rb_bem_system **system, rb_message *why);
void rb_bem_system_free(rb_bem_system *system);
const rb_bem_mesh *rb_bem_system_mesh(const rb_bem_system *system);
/* Reciprocal condition (1-norm, estimated) of the scaled matrix A; NAN where it is
 * hierarchical. */
double rb_bem_system_rcond(const rb_bem_system *system);
/* Seconds spent in assembly and in the LU. */
void rb_bem_system_seconds(const rb_bem_system *system, double *assembly, double *factor);

/* Displacement u and traction t of every element (2n each, global x, y) under the mesh's
 * given values and the contact tractions t_contact (2 contact_n, global; NULL: zero). */
rb_status rb_bem_system_solve(const rb_bem_system *system, const double *t_contact,
                              double *u, double *t);

/* ---- Flexibility of the contact (B5) ---------------------------------------------- */

/* Normal n into the body (A: +y) and tangent t (+x): of the flat obstacle, or of each
 * element as *Addi* (18) has it (4.3). */
typedef enum { RB_BEM_NORMALS_OBSTACLE, RB_BEM_NORMALS_SURFACE } rb_bem_normals;

/* w = w0 + F r: r = (r_N, r_T), 2n tractions on A along n and t, one per contact element;
 * w = (w_N, w_T), 2m displacements, m = n + 1: the n contact midpoints and the midpoint
 * of the upstream element, which carries no traction. A dense matrix or a
 * Toeplitz operator stands behind the same calls. */
typedef struct rb_bem_flexibility rb_bem_flexibility;
struct rb_bem_flexibility {
    int n, m;
    double *x;          /* m midpoints [length]; owned */
    double *h;          /* m element lengths; owned */
    double *w0;         /* 2m [length]; owned */
    double *compliance; /* 2n [length/stress]: of an interface on the elements, normal,
                           then tangential; NULL where there is none or F has it; owned */
    void (*apply)(const rb_bem_flexibility *f, const double *r, double *w); /* w = F r */
    rb_status (*matrix)(const rb_bem_flexibility *f, double *F, int ldf);   /* 2m x 2n */
    /* Adds b, the mirror image, to a (but w0) where both are of this kind; 0: they are
     * not.  NULL: no two of this kind become one. */
    int (*add_mirrored)(rb_bem_flexibility *a, const rb_bem_flexibility *b);
    void (*free_data)(void *data);
    void *data; /* owned, of the kind that these functions know */
};

/* Condenses a cylinder's system to its contact: one solve with 2n right-hand sides. */
rb_status rb_bem_condense(const rb_bem_system *system, rb_bem_normals normals,
                          rb_bem_flexibility *f, rb_message *why);

/* The same flexibility, more accurate close to the load (B10): each load is given the
 * exact solution of the half-plane on its element, and the boundary elements solve for
 * the smooth rest.  RB_EINVAL also where the body does not lie on the inner side of every
 * contact element. */
rb_status rb_bem_condense_subtracted(const rb_bem_system *system, rb_bem_normals normals,
                                     rb_bem_flexibility *f, rb_message *why);

/* A body whose surface answers alike everywhere, unlike a wheel's: displacement and
 * traction depend on distance alone.  A half-plane (kernels of theory.md, Flamant),
 * elastic or with fading memory in steady rolling towards +x, or a layer of that material
 * bonded to a rigid or elastic base.  All borrowed. */
typedef struct {
    rb_bem_material material; /* of the half-plane or layer; the glassy one with memory */
    double datum; /* depth of zero displacement of the half-plane or elastic base */
    double datum_tangential; /* the same along the surface, of a homogeneous half-plane
                                that forms a matrix; 0: datum */
    int terms; /* of the memory: creep compliance 1 + sum f_k (1 - exp(-t/tau_k)) */
    const double *ratio;  /* terms: f_k >= 0 */
    const double *length; /* terms: rolling speed times tau_k [length], >= 0 */
    double thickness;     /* of the layer; 0: half-plane */
    int elastic_base;     /* of the layer; 0: rigid */
    rb_bem_material base;
} rb_bem_surface;

/* Elastic, displacement zero at depth datum > 0 under the point. */
rb_bem_surface rb_bem_halfplane(rb_bem_material material, double datum);

/* ends as in rb_bem_mesh_cylinder, any real numbers. */
rb_status rb_bem_flexibility_surface(int n_c, const double *ends,
                                     const rb_bem_surface *body, rb_bem_flexibility *f,
                                     rb_message *why);

/* The same on equal elements as a Toeplitz operator: products by Fourier transforms,
 * n log n work, memory of a few n.  A pair of two such is again one.  apply serves one
 * thread at a time.  RB_EINVAL: as above, and elements of different lengths. */
rb_status rb_bem_flexibility_toeplitz(int n_c, const double *ends,
                                      const rb_bem_surface *body, rb_bem_flexibility *f,
                                      rb_message *why);

/* A whole disc, held at its centre. */
typedef struct {
    double radius;
    rb_bem_material material;
} rb_bem_disc;

/* The disc in closed form, without elements elsewhere on its boundary: equal arcs at the
 * lowest point, ends as in rb_bem_mesh_cylinder.  Its load is carried by a force and a
 * moment at the centre; displacements are those relative to the centre, less the
 * translation that a point force makes infinite there, and without mean rotation.
 * Toeplitz in the frames of the surface.  RB_EINVAL: as above, and arcs of different
 * lengths. */
rb_status rb_bem_flexibility_disc(int n_c, const double *ends, const rb_bem_disc *disc,
                                  rb_bem_normals normals, rb_bem_flexibility *f,
                                  rb_message *why);

/* The body seen at any points x of its surface: w = W r, W: 2 points x 2n column-major,
 * rows (w_N, w_T); ends: n + 1.  RB_EINVAL: sizes, body; RB_ENOMEM. */
rb_status rb_bem_surface_displacement(const rb_bem_surface *body, int n,
                                      const double *ends, int points, const double *x,
                                      double *W);

/* Tractions on the edge y = 0 of a half-plane y >= 0; borrowed. */
typedef struct {
    int n;
    const double *x;     /* ends of n strips (n + 1), or n nodes; increasing */
    const double *p, *q; /* n: along +y, into the body (pressure), and along +x */
} rb_bem_edge_load;

/* Adds w_N under constant strips to w, for points x: no matrix is formed.  As above. */
rb_status rb_bem_surface_add_normal(const rb_bem_surface *body,
                                    const rb_bem_edge_load *load, int points,
                                    const double *x, double *w);

/* A body with memory whose load is linear in time over a step, or whose past is linear
 * over a length (V6): what is remembered after it is kept * (what was before it) + before
 * * (load before) + after * (load after). */
typedef struct {
    double kept, before, after;
} rb_bem_fading;
/* time: of the memory; step > 0, in the same unit. */
rb_bem_fading rb_bem_fading_over(double time, double step);

/* A wheel with fading memory in steady rolling towards +x, which is alike at every angle:
 * a ring of one material, or a cover on a core that is rigid or a ring on a rigid hub.
 * Borrowed as in rb_bem_surface. */
typedef struct {
    double radius, inner;     /* of the material that remembers, bonded at `inner` */
    rb_bem_material material; /* the glassy one */
    int terms;
    const double *ratio, *length;
    double hub; /* radius of the rigid hub below an elastic core; 0: rigid at `inner` */
    rb_bem_material core;
} rb_bem_wheel;

/* Adds to the flexibility of the glassy wheel, condensed with these normals, what its
 * memory makes of it (V8).  ends: of the contact elements, as in rb_bem_mesh_cylinder.
 * f becomes a dense matrix.  RB_EINVAL: radii, materials, terms; RB_ENOMEM. */
rb_status rb_bem_flexibility_add_memory(const rb_bem_wheel *wheel, rb_bem_normals normals,
                                        const double *ends, rb_bem_flexibility *f,
                                        rb_message *why);

/* Two bodies in contact (4.5): F_A + F_B, B computed as the mirror image (an upper body),
 * so that its coupling blocks enter with the opposite sign.  Takes over a and b (both are
 * left empty), also on failure.  RB_EINVAL: their points differ. */
rb_status rb_bem_flexibility_pair(rb_bem_flexibility *a, rb_bem_flexibility *b,
                                  rb_bem_flexibility *f, rb_message *why);

/* Adds an interface that yields under each element by its own traction alone: its normal
 * and tangential compliance on the diagonal of F_NN and F_TT [length/stress], n values
 * each,
 * >= 0.  After bodies are paired.  RB_EINVAL, RB_ENOMEM. */
rb_status rb_bem_flexibility_add_compliance(rb_bem_flexibility *f, const double *normal,
                                            const double *tangential);

void rb_bem_flexibility_apply(const rb_bem_flexibility *f, const double *r, double *w);
/* F: 2m x 2n column-major, ldf >= 2m. */
rb_status rb_bem_flexibility_matrix(const rb_bem_flexibility *f, double *F, int ldf);
/* The dense matrix behind f, ld = 2m, borrowed; NULL where there is none. */
const double *rb_bem_flexibility_stored(const rb_bem_flexibility *f);
/* Puts a dense matrix behind f, whatever has been there.  RB_ENOMEM leaves f as it is. */
rb_status rb_bem_flexibility_store(rb_bem_flexibility *f);
void rb_bem_flexibility_free(rb_bem_flexibility *f);

/* Approximate inverses for iterative solvers, on a line of equal elements: of F_NN or
 * F_TT (apply), and of A F_TT, (A w)_i = sum over k of stencil_k w_{i-1+k}
 * (apply_difference; stencil (0, 1, -1, 0): the difference to the element upstream,
 * towards +x).  local: the stencil that A has on the compliance added to f.  w and r: n
 * each, may be the same.  One thread at a time. */
typedef struct rb_bem_circulant rb_bem_circulant;
rb_status rb_bem_circulant_create(const rb_bem_flexibility *f, const double stencil[4],
                                  const double local[4], rb_bem_circulant **circulant);
void rb_bem_circulant_apply(const rb_bem_circulant *c, const double *w, double *r);
void rb_bem_circulant_apply_difference(const rb_bem_circulant *c, const double *w,
                                       double *r);
void rb_bem_circulant_free(rb_bem_circulant *circulant);

/* ---- Interior (B8) ---------------------------------------------------------------- */

/* Points at which a field is asked for. */
typedef struct {
    int n;
    const double *xy; /* x0, y0, x1, y1, ...; borrowed */
} rb_bem_points;

/* A body with all values on its boundary; borrowed. */
typedef struct {
    const rb_bem_mesh *mesh;
    rb_bem_material material;
    const double *u, *t; /* 2n each, of rb_bem_system_solve */
} rb_bem_boundary;

/* Displacement (2 per point) and stress (sxx, syy, sxy per point) at points inside the
 * body.  Either output may be NULL.  Constant u jumps at element ends; here u is linear
 * between midpoints, so that stress stays accurate close to the boundary.  Points on the
 * surface itself use the tractions, the tangential strain and Hooke's law. */
rb_status rb_bem_interior(const rb_bem_boundary *body, rb_bem_points points,
                          double *displacement, double *stress, rb_message *why);

/* The same stress of a body under contact tractions, accurate right up to the loaded
 * surface: tractions linear between the midpoints, their strips in closed form (B10).
 * t_contact: 2 contact_n, global.  The field borrows the system.  RB_EINVAL: the body
 * does not lie on the inner side of every contact element. */
typedef struct rb_bem_field rb_bem_field;
rb_status rb_bem_field_create(const rb_bem_system *system, const double *t_contact,
                              rb_bem_field **field, rb_message *why);
rb_status rb_bem_field_stress(const rb_bem_field *field, rb_bem_points points,
                              double *stress, rb_message *why);
void rb_bem_field_free(rb_bem_field *field);

/* Stress below tractions that are constant on n strips [x[i], x[i+1]].  stress: 3 per
 * point (sxx, syy, sxy); on y = 0 the limit from inside. */
rb_status rb_bem_halfplane_stress(const rb_bem_edge_load *load, rb_bem_points points,
                                  double *stress);

/* The same below tractions that are linear between n nodes and zero at the first and the
 * last: sxx is finite everywhere.  For points within some widths of the load: digits go
 * with the distance over that of the nodes. */
rb_status rb_bem_halfplane_stress_linear(const rb_bem_edge_load *load,
                                         rb_bem_points points, double *stress);

/* The stress that a layer, or what lies below it, has under given tractions (L5).  body,
 * load: of nodes; what they borrow stays until the field is freed.  The first call for
 * points further apart than three times the load makes the waves of the field anew.
 * RB_EINVAL: no layer, points outside, places too far apart for so thin a layer. */
typedef struct rb_bem_layer_field rb_bem_layer_field;
rb_status rb_bem_layer_field_create(const rb_bem_surface *body,
                                    const rb_bem_edge_load *load,
                                    rb_bem_layer_field **field, rb_message *why);
/* stress: 3 points, sxx, syy, sxy of the half-plane of the layer's material: what the
 * layer has beside them is added; of points below the layer all of it is written. */
rb_status rb_bem_layer_field_add(rb_bem_layer_field *field, rb_bem_points points,
                                 double *stress, rb_message *why);
void rb_bem_layer_field_free(rb_bem_layer_field *field);

/* ---- A reference ------------------------------------------------------------------- */

/* Exact elastic disc: displacement of its rim (u_r outwards, u_t counter-clockwise) at
 * `angle` counter-clockwise from the middle of an arc of width h, 0 < h < 2 pi, under
 * uniform tractions (p_r, p_t); up to a rigid motion; the resultant is balanced by a
 * force and a couple at the centre.  response [length/stress]: 2 x 2 column-major, rows
 * (u_r, u_t), columns (p_r, p_t). */
rb_status rb_bem_disc_response(const rb_bem_disc *disc, double h, double angle,
                               double response[4]);

RB_PUBLIC_END

#endif
