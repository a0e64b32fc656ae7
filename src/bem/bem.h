/* What src/rolling and src/analysis use of the boundary elements besides rollbem/bem.h: fast
 * products, layers, memory, wheels. */
#ifndef ROLLBEM_SRC_BEM_BEM_H
#define ROLLBEM_SRC_BEM_BEM_H

#include "bem/boundary.h"

/* ---- Changes of a body ------------------------------------------------------------ */

/* A body under given tractions r = (r_N, r_T) of its contact (2 contact_n), and what they displace
 * more where it is a slightly different one. */
typedef struct rb_bem_loaded rb_bem_loaded;
/* system: borrowed; subtracted: as in rb_bem_condense_subtracted.  RB_EINVAL: it is bonded to an
 * elastic core; RB_ENOMEM. */
rb_status rb_bem_loaded_create(const rb_bem_system *system, rb_bem_normals normals, int subtracted,
                               const double *r, rb_bem_loaded **loaded, rb_message *why);
/* (B13) w of rb_bem_flexibility (2m) of the body with this boundary, which has the same elements at
 * slightly different places, and of this material, less w of the system's body: exact to first
 * order in the change of H and G, by the factors of the system alone.  One thread at a time.
 * RB_ENOMEM. */
rb_status rb_bem_loaded_change(rb_bem_loaded *loaded, const rb_bem_mesh *mesh,
                               rb_bem_material material, double *change);
void rb_bem_loaded_free(rb_bem_loaded *loaded);

/* ---- Bodies whose response depends on the distance alone --------------------------- */

/* (V2) The memory of a half-plane keeps ln(sqrt(r^2 + d^2)/r) of a load that has moved on by r,
 * where the elastic displacement is ln(d/|x|): what the first has over the second, as a
 * function of r/d >= 0, and its mean G over exp(-u) du at r = u L, as a function of d/L > 0. */
double rb_bem_memory_beyond_datum(double ratio);
double rb_bem_memory_of_datum(double datum_over_length);
/* The same mean for a strip of width d of a half-space that rests far away (CONTACT), whose
 * displacement is asinh(d/(2|x|)). */
double rb_bem_memory_of_strip(double width_over_length);

/* Bonded layers from the surface down; borrowed. */
struct rb_bem_stack {
    int n;                                     /* at least 2 */
    const double *thickness, *young, *poisson; /* n each */
};

/* A body whose influence function depends on the distance alone (a wheel's does not).  It
 * is a half-plane (Flamant, theory.md 3), elastic or viscoelastic in steady rolling
 * towards +x, or a layer of this material bonded to a rigid or elastic base.  All
 * pointers are borrowed. */
struct rb_bem_surface {
    rb_bem_material material; /* of the half-plane or layer; if viscoelastic, the glassy
                                 (instantaneous) constants */
    double datum;             /* where along the half-plane or elastic base a load moves nothing */
    double datum_tangential;  /* the same for tangential displacement; only for a
                                 homogeneous half-plane; 0: datum */
    double datum_memory;      /* of a homogeneous half-plane in steady rolling: sum f_k G(d/L_k), by
                                 which the memory of loads that have passed differs from that of
                                 ln(d/|x|) (V2), see rb_bem_memory_of_datum; 0 for a wheel's */
    int terms;                /* number of relaxation times of the creep compliance 1 + sum f_k (1 -
                                 exp(-t/tau_k)) */
    const double *ratio;      /* terms: f_k >= 0 */
    const double *length;     /* terms: rolling speed times tau_k [length], >= 0 */
    double thickness;         /* of the layer; 0: half-plane */
    int elastic_base;         /* of the layer; 0: rigid */
    rb_bem_material base;
    int smooth_base;           /* of one elastic layer: it slides on its base without friction and
                                  does not leave it (L9); its displacement along the surface has no
                                  datum */
    const rb_bem_stack *stack; /* of several elastic layers, the first of which is that of
                                  `material` and `thickness`; NULL: one */
    double period; /* of tractions that repeat themselves along an elastic half-plane [length]: its
                      displacement has the mean 0 and no datum (P1); 0: none */
};

/* An elastic half-plane whose displacement is zero at the distance datum > 0 along the surface from
 * the loaded point. */
rb_bem_surface rb_bem_halfplane(rb_bem_material material, double datum);

/* As rb_bem_flexibility_halfplane, of any such body. */
rb_status rb_bem_flexibility_surface(int n_c, const double *ends, const rb_bem_surface *body,
                                     rb_bem_flexibility *f, rb_message *why);

/* As rb_bem_flexibility_surface for equal elements, as a Toeplitz operator: products by Fourier
 * transforms take n log n operations and memory for a few n numbers.  The sum of two Toeplitz
 * operators (rb_bem_flexibility_pair) is a Toeplitz operator.  Only one thread at a time
 * may call apply.  RB_EINVAL: as there, or elements of different lengths. */
rb_status rb_bem_flexibility_toeplitz(int n_c, const double *ends, const rb_bem_surface *body,
                                      rb_bem_flexibility *f, rb_message *why);

/* A full disc, fixed at its centre. */
typedef struct {
    double radius;
    rb_bem_material material;
} rb_bem_disc;

/* Exact solution of an elastic disc whose rim carries uniform tractions (p_r, p_t) on an
 * arc of angular width h, 0 < h < 2 pi: displacement of the rim (u_r outwards, u_t
 * counter-clockwise) at `angle`, counter-clockwise from the middle of the arc, up to a
 * rigid motion.  A force and a couple at the centre balance the resultant.  response
 * [length/stress]: 2 x 2 column-major, rows (u_r, u_t), columns (p_r, p_t). */
rb_status rb_bem_disc_response(const rb_bem_disc *disc, double h, double angle, double response[4]);

/* The flexibility of a disc in closed form.  Only the contact, at the lowest point, has
 * elements (equal arcs; ends as in rb_bem_mesh_cylinder).  A force and a moment at the
 * centre carry the load.  Displacements are relative to the centre, without the infinite
 * translation of a point force and without mean rotation.  The operator is Toeplitz in
 * the directions of the surface.  RB_EINVAL: as above, or arcs of different lengths. */
rb_status rb_bem_flexibility_disc(int n_c, const double *ends, const rb_bem_disc *disc,
                                  rb_bem_normals normals, rb_bem_flexibility *f, rb_message *why);

/* Matrix W of the displacements w = W r at any points x of the surface, for tractions r
 * constant on n strips with the n + 1 ends.  W: 2 points x 2n, column-major, rows (w_N,
 * w_T).  RB_EINVAL: invalid sizes or body; RB_ENOMEM. */
rb_status rb_bem_surface_displacement(const rb_bem_surface *body, int n, const double *ends,
                                      int points, const double *x, double *W);

/* Adds to w the normal displacements w_N at the points x under tractions that are
 * constant on strips, without forming a matrix.  Errors as of rb_bem_flexibility_surface. */
rb_status rb_bem_surface_add_normal(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    int points, const double *x, double *w);

/* Weights of one step of a viscoelastic body (V6), for a load linear in time over the
 * step (or linear along a length): filtered load after the step = kept * (filtered load
 * before) + before * (load before) + after * (load after). */
typedef struct {
    double kept, before, after;
} rb_bem_fading;
/* time: relaxation time; step > 0, in the same unit. */
rb_bem_fading rb_bem_fading_over(double time, double step);

/* A wheel with rotational symmetry: a ring of one material, or a cover on a core that is
 * rigid or is a ring on a rigid hub; in steady rolling towards +x its material may be
 * viscoelastic.  Pointers are borrowed. */
struct rb_bem_wheel {
    double radius, inner;     /* outer and inner radius of the material, bonded at `inner` */
    rb_bem_material material; /* its glassy (instantaneous) constants */
    int terms;
    const double *ratio, *length;
    double hub; /* radius of the rigid hub below an elastic core; 0: rigid at `inner` */
    rb_bem_material core;
};

/* The flexibility of the glassy wheel by its waves around the circumference (B12): no
 * boundary elements outside the contact, n_c^2 work.  ends as in rb_bem_mesh_cylinder;
 * the elements are arcs, f->h holds their chords.  RB_EINVAL: invalid radii, materials or
 * ends; RB_SINGULAR: the core hardly holds the cover; RB_ENOMEM. */
rb_status rb_bem_flexibility_wheel(int n_c, const double *ends, const rb_bem_wheel *wheel,
                                   rb_bem_normals normals, rb_bem_flexibility *f, rb_message *why);

/* As rb_bem_flexibility_wheel, by products of Fourier transforms, n log n work, to 1e-10 of the
 * largest displacement.  apply serves one thread at a time.  A cover that is very thin against its
 * elements gets the dense matrix. */
rb_status rb_bem_flexibility_wheel_products(int n_c, const double *ends, const rb_bem_wheel *wheel,
                                            rb_bem_normals normals, rb_bem_flexibility *f,
                                            rb_message *why);

/* A flat body in the same way, on elements of any lengths, such as those of a wheel that it
 * touches; a layer that is very thin against its elements gets the dense matrix. */
rb_status rb_bem_flexibility_surface_products(int n_c, const double *ends,
                                              const rb_bem_surface *body, rb_bem_flexibility *f,
                                              rb_message *why);

/* Displacement w of points x on the lower half of the glassy wheel along the normal of
 * the obstacle, into the body, under strips of p and q along that normal and tangent.
 * RB_EINVAL, RB_ENOMEM. */
rb_status rb_bem_wheel_normal(const rb_bem_wheel *wheel, const rb_bem_edge_load *load, int points,
                              const double *x, double *w);

/* Adds the viscoelastic part (V8) to the flexibility of the glassy wheel, which was
 * made with these normals.  ends: of the contact elements, as in
 * rb_bem_mesh_cylinder.  f becomes a dense matrix.  RB_EINVAL: invalid radii, materials
 * or relaxation terms; RB_ENOMEM. */
rb_status rb_bem_flexibility_add_memory(const rb_bem_wheel *wheel, rb_bem_normals normals,
                                        const double *ends, rb_bem_flexibility *f, rb_message *why);

/* ---- Products by Fourier transforms ----------------------------------------------- */

/* Circulant preconditioners for a line of equal elements: approximate inverses of F_NN or
 * F_TT (apply) and of A F_TT (apply_difference), where (A w)_i = sum over k of stencil_k
 * w_{i-1+k}.  The stencil (0, 1, -1, 0) is the difference to the upstream element,
 * towards +x.  local: the stencil of A for the compliance that was added to f.  w and r
 * have n entries each and may be the same array.  One thread at a time. */
typedef struct rb_bem_circulant rb_bem_circulant;
rb_status rb_bem_circulant_create(const rb_bem_flexibility *f, const double stencil[4],
                                  const double local[4], rb_bem_circulant **circulant);
void rb_bem_circulant_apply(const rb_bem_circulant *c, const double *w, double *r);
void rb_bem_circulant_apply_difference(const rb_bem_circulant *c, const double *w, double *r);
/* Approximate inverse of 1 + hardening F_TT, for an interface whose friction grows with
 * its plastic slip by the factor hardening. */
void rb_bem_circulant_apply_yielding(const rb_bem_circulant *c, double hardening, const double *w,
                                     double *r);
void rb_bem_circulant_free(rb_bem_circulant *circulant);

/* w_i = sum over j of t_(i-j) r_j (n each, w may be r) by Fourier transforms; t: those of
 * distances 1 - n ... n - 1.  NULL without memory.  One thread at a time. */
typedef struct rb_bem_convolution rb_bem_convolution;
rb_bem_convolution *rb_bem_convolution_create(int n, const double *t);
void rb_bem_convolution_apply(const rb_bem_convolution *c, const double *r, double *w);
void rb_bem_convolution_free(rb_bem_convolution *convolution);

/* ---- Interior (B8) ---------------------------------------------------------------- */

/* Stress of a body under contact tractions, accurate up to the loaded surface: the near
 * field of the tractions is in closed form (B10).  load: linear between n nodes x, which
 * are measured along the contour from the start of the first contact element; p into the
 * body, q along each element; what lies beyond the contact elements is left out.  The
 * field borrows the system.  RB_EINVAL: the body does not lie on the inner side of every
 * contact element. */
typedef struct rb_bem_field rb_bem_field;
rb_status rb_bem_field_create(const rb_bem_system *system, const rb_bem_edge_load *load,
                              rb_bem_field **field, rb_message *why);
rb_status rb_bem_field_stress(const rb_bem_field *field, rb_bem_points points, double *stress,
                              rb_message *why);
void rb_bem_field_free(rb_bem_field *field);

/* (B20) Stress in the cover of a wheel, on an elastic core or a rigid one.  load: linear between
 * nodes, the abscissae of which are measured along the circle from its lowest point; borrowed.
 * RB_EINVAL: thinner than this part of the radius; a point lies outside the cover. */
#define RB_BEM_RING_THINNEST 1e-4
typedef struct rb_bem_ring_field rb_bem_ring_field;
rb_status rb_bem_ring_field_create(const rb_bem_wheel *wheel, const rb_bem_edge_load *load,
                                   rb_bem_ring_field **field, rb_message *why);
rb_status rb_bem_ring_field_stress(const rb_bem_ring_field *field, rb_bem_points points,
                                   double *stress, rb_message *why);
void rb_bem_ring_field_free(rb_bem_ring_field *field);

/* As rb_bem_halfplane_stress for tractions that are linear between n nodes and zero outside; two
 * nodes at one place are a jump.  Where q does not jump sxx is finite everywhere.  Use it for
 * points within a few contact widths: rounding errors grow with the ratio of their distance to the
 * spacing of the nodes. */
rb_status rb_bem_halfplane_stress_linear(const rb_bem_edge_load *load, rb_bem_points points,
                                         double *stress);

/* Stress in a layer or in the base below it under given tractions (L5).  load: tractions
 * at nodes.  The arrays of body and load must exist until the field is freed.  The first
 * call with points computes the Fourier components of the field, and one whose points
 * extend over more than those before and twice the width of the load computes them again.
 * RB_EINVAL: body is no layer, a point lies outside, or the points extend too far for so
 * thin a layer. */
typedef struct rb_bem_layer_field rb_bem_layer_field;
rb_status rb_bem_layer_field_create(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    rb_bem_layer_field **field, rb_message *why);
/* stress: 3 per point.  On input it holds sxx, syy, sxy of a half-plane of the layer's
 * material.  For points in the layer the difference between layer and half-plane is
 * added; for points below the layer the stress is overwritten. */
rb_status rb_bem_layer_field_add(rb_bem_layer_field *field, rb_bem_points points, double *stress,
                                 rb_message *why);
void rb_bem_layer_field_free(rb_bem_layer_field *field);

#endif
