/* Declarations shared by the files of this folder. */
#ifndef ROLLBEM_ROLLING_INTERNAL_H
#define ROLLBEM_ROLLING_INTERNAL_H

#include "rolling/case/options.h"
#include "rolling/rolling.h"

#include <math.h>

/* ---- case.c: quantities derived from a case ---------------------------------------- */

/* 1 if the boundary of wheels outside the contact is finer than needed for finding the
 * contact; the second function sets the plan to the default boundary. */
int rb_rolling_has_fine_boundary(const rb_rolling_plan *plan);
void rb_rolling_coarsen_boundary(rb_rolling_plan *plan);
/* 1: a bulk stress is given; and the strain along the surface that it makes in A less that in B
 * (U1): displacements differ by so much times x; and the larger of both, without its sign. */
int rb_rolling_is_strained(const rb_rolling_case *rc);
double rb_rolling_bulk_strain(const rb_rolling_case *rc);
double rb_rolling_largest_bulk_strain(const rb_rolling_case *rc);
/* 1: load, approach, half-width, largest pressure or the load of an ellipse; 0: approach = R/2. */
int rb_rolling_pressing_is_given(const rb_rolling_case *rc);
/* Forgets the half-width, largest pressure or wheel load that were given: load or approach are set
 * instead. */
void rb_rolling_press_by_load(rb_rolling_case *rc);
/* 1: the load is that of an ellipse (E2). */
int rb_rolling_has_ellipse(const rb_rolling_case *rc);
/* 1: the gap has a shape of its own, that of a table or a wave, not that of the bodies' radii. */
static inline int rb_rolling_gap_has_shape(const rb_rolling_case *rc)
{
    return rc->gap == RB_GAP_TABLE || rc->gap == RB_GAP_WAVE;
}
/* Checks the case of a program before its rows, which rb_rolling_program_check checks.  A program
 * of no rows: rb_rolling_case_check. */
rb_status rb_rolling_program_check_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc, rb_message *why);
/* 1: rolls steadily on an ellipse between alike bodies under one coefficient of friction; and the
 * force of all of it at the creepage xi R_eq/(mu a) (E3).  kalker: NAN where his table ends. */
int rb_rolling_ellipse_slides_alike(const rb_rolling_case *rc);
void rb_rolling_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                               double *kalker);
/* NAN where there is none; of the strips that the case asks for, `strips` is set by
 * rb_rolling_solve_strips. */
void rb_rolling_set_ellipse_forces(const rb_rolling_case *rc, double creep_ratio, double *strips,
                                   double *kalker);
/* 1: a layer on a rigid base gives way under equal pressure, or under equal friction, everywhere
 * (P1). */
int rb_rolling_mean_compresses(const rb_rolling_case *rc);
int rb_rolling_mean_shears(const rb_rolling_case *rc);
/* 1: a tilt or a moment is given; and the tilt (U3). */
int rb_rolling_is_tilted(const rb_rolling_case *rc);
double rb_rolling_tilt(const rb_rolling_case *rc);
/* 1: Q, a force ratio or a free axle is given, and no creepage. */
int rb_rolling_force_is_given(const rb_rolling_case *rc);

/* 1 if products are computed by Fourier transforms: half-planes, and covers in steady
 * rolling, with equal elements, solved by Newton's method. */
int rb_rolling_has_transforms(const rb_rolling_case *rc);

/* ---- options.c: the ranges of the option table --------------------------------------- */

/* Checks the numbers of a case: RB_EINVAL "young: expected a number > 0, got -1".  What
 * has its default is not given. */
rb_status rb_rolling_check_ranges(const rb_rolling_case *rc, const rb_rolling_case *defaults,
                                  rb_message *why);
/* Checks a number against the range of an option; of the one with this name. */
rb_status rb_rolling_check_option(const rb_option *option, double value, rb_message *why);
rb_status rb_rolling_check_number(const char *option, double value, rb_message *why);

/* ---- interpolant.c ----------------------------------------------------------------- */

/* A curve through n >= 3 points with increasing x: a cubic spline, with zero curvature at both
 * ends, that breaks off at the corners of the data and where it would leave them.  Beyond the ends
 * it goes straight on.  is_smooth: 1: one spline in any case.  RB_ENOMEM. */
typedef struct rb_rolling_interpolant rb_rolling_interpolant;
rb_status rb_rolling_interpolant_create(int n, const double *x, const double *y, int is_smooth,
                                        rb_rolling_interpolant **interpolant);
void rb_rolling_interpolant_free(rb_rolling_interpolant *interpolant);
double rb_rolling_interpolant_at(const rb_rolling_interpolant *interpolant, double x);
/* Number and abscissae of its points; of its corners, and by how much the slope is larger behind
 * each; borrowed. */
int rb_rolling_interpolant_rows(const rb_rolling_interpolant *interpolant, const double **x);
int rb_rolling_interpolant_corners(const rb_rolling_interpolant *interpolant, const double **x,
                                   const double **bend);
/* Number of its points with too few around them to tell a corner from a curve: beside these it
 * stays between its points. */
int rb_rolling_interpolant_untold(const rb_rolling_interpolant *interpolant);

/* ---- profile.c, profile_points.c --------------------------------------------------- */

struct rb_rolling_profile {
    rb_rolling_interpolant *curve; /* owned */
    double from, to, radius;
};

/* Corners of the profile, as of its interpolant. */
int rb_rolling_profile_corners(const rb_rolling_profile *profile, const double **x,
                               const double **bend);

/* Number and abscissae of the points of the spline; borrowed. */
int rb_rolling_profile_rows(const rb_rolling_profile *profile, const double **x);
/* Checks for three or more finite points with increasing x: RB_EINVAL "<what>: row
 * ...". */
rb_status rb_rolling_points_check(const char *what, int n, const double *x, const double *gap,
                                  rb_message *why);

/* ---- body_wheel.c ------------------------------------------------------------------ */

/* Factorises the boundary elements of A, a wheel, again; owned by the caller. */
rb_status rb_rolling_boundary_system(const rb_rolling_model *model, rb_bem_system **system,
                                     rb_message *why);
/* 1: the flexibility of the wheel has its near field in closed form. */
int rb_rolling_subtracts(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                         const rb_rolling_body *body);
/* A wheel on a hub or a cover; borrows length and the body. */
rb_bem_wheel rb_rolling_wheel_of(const rb_rolling_case *rc, const rb_rolling_body *body,
                                 double length[RB_ROLLING_TERMS]);

/* ---- perturbation.c ---------------------------------------------------------------- */

/* Adds to w (2m) what the bodies of v, on its mesh, displace more than those of the model under the
 * tractions of the model, to first order; x, h: m, of the elements of v, written where A changes.
 * RB_INACCURATE: elements outside the contact come or go. */
rb_status rb_rolling_perturbation_add(rb_rolling_perturbation *perturbation,
                                      const rb_rolling_model *v, double *w, double *x, double *h,
                                      rb_message *why);

/* ---- Rows of the table of bodies (body.c) ------------------------------------------ */

/* What the rest of wheels adds to half-planes. */
typedef struct rb_rolling_far_field rb_rolling_far_field;

/* The flexibility of one body. */
typedef struct {
    rb_bem_flexibility f;  /* owned */
    rb_bem_system *system; /* NULL without boundary elements; owned */
    int keeps_memory;      /* 1: compute `memory` for a half-plane, too */
    double *memory;        /* 2m x 2n: viscoelastic part of f, for pairs with a wheel in steady
                              rolling; otherwise NULL; owned */
    double seconds_assembly, seconds_factor, seconds_condense;
} rb_rolling_body_flexibility;

/* Builds the flexibility of A or B anew: w = w0 + F r (2m) of that body in its own frame, and x and
 * h of its elements (m; NULL: not wanted). */
rb_status rb_rolling_body_displacement(const rb_rolling_model *model, int of_b, const double *r,
                                       double *w, double *x, double *h, rb_message *why);

struct rb_rolling_body_kind {
    const char *name; /* in pictures */
    rb_bem_support support;
    int (*holds)(const rb_rolling_body *body); /* 1: the body has this
                                                  addition; NULL: the row of a support */
    int can;                                   /* a sum of rb_rolling_ability */
    const rb_rolling_parameter *parameters;
    /* Checks ranges of the parameters; for an addition it is called for every body, with
     * or without the addition.  which: "", or "-b" of body B.  NULL: nothing to check. */
    rb_status (*check)(const rb_rolling_case *rc, const rb_rolling_body *body, const char *which,
                       rb_message *why);

    /* Of the support only: */
    rb_status (*flexibility)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                             const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                             rb_rolling_body_flexibility *one_body, rb_message *why);
    /* That of the half-plane which answers like the body close to a load, along the same surface;
     * NULL: there is none beside the body itself. */
    rb_status (*near)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                      const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                      rb_rolling_body_flexibility *one_body, rb_message *why);
    /* The same for equal elements by Fourier transforms, without a matrix, for bodies for
     * which `transformed` returns 1 (NULL: half-planes); NULL: never. */
    int (*transformed)(const rb_rolling_case *rc, const rb_rolling_body *body);
    rb_status (*transforms)(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                            const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                            rb_rolling_body_flexibility *one_body, rb_message *why);
    /* The half-plane or layer that answers like the body close to a load. */
    rb_bem_surface (*surface)(const rb_rolling_case *rc, const rb_rolling_body *body,
                              double length[RB_ROLLING_TERMS]);
    /* Depth of zero displacement; NULL: not defined. */
    double (*datum)(const rb_rolling_case *rc, const rb_rolling_body *body);
};

/* All rows; NULL ends the list. */
extern const rb_rolling_body_kind *const rb_rolling_body_kinds[];

/* ---- body_wheel.c, body_halfplane.c: rows of the table in body.c ------------------- */

/* Poisson's ratio up to which boundary elements compute a cover on an elastic core. */
#define RB_ROLLING_COMPRESSIBLE 0.499
/* 1: a cover with an elastic core. */
int rb_rolling_has_elastic_core(const rb_rolling_body *body);
extern const rb_rolling_body_kind rb_rolling_arc, rb_rolling_hub, rb_rolling_cover;
extern const rb_rolling_body_kind rb_rolling_halfplane, rb_rolling_layer, rb_rolling_relaxation;
rb_bem_surface rb_rolling_halfplane_surface(const rb_rolling_case *rc, const rb_rolling_body *body,
                                            double length[RB_ROLLING_TERMS]);
/* L = V tau of each term. */
void rb_rolling_memory_lengths(const rb_rolling_case *rc, const rb_rolling_body *body,
                               double length[RB_ROLLING_TERMS]);
/* ---- material.c -------------------------------------------------------------------- */

/* Checks that nu, the value of an option, is in the range of plane stress, if that is the
 * problem. */
rb_status rb_rolling_check_poisson(const rb_rolling_case *rc, const char *option, double poisson,
                                   rb_message *why);

/* ---- body.c ------------------------------------------------------------------------ */

/* Checks a body.  RB_EINVAL: invalid values.  which: "", or "-b" of body B. */
rb_status rb_rolling_body_check(const rb_rolling_case *rc, const rb_rolling_body *body,
                                const char *which, int plane_allowed, rb_message *why);

/* The given datum of a half-plane, or 2R/e with R of the body (of A for a plane); NAN if
 * displacements are not relative to a datum: wheels, and layers on a rigid base. */
double rb_rolling_datum(const rb_rolling_case *rc, const rb_rolling_body *body);
/* The half-plane or layer that answers like the body close to a load.  length: array for
 * the lengths V tau, which the surface borrows, like the ratios of the body. */
rb_bem_surface rb_rolling_surface_of(const rb_rolling_case *rc, const rb_rolling_body *body,
                                     double length[RB_ROLLING_TERMS]);

/* ---- body_memory.c ----------------------------------------------------------------- */

/* Computes the viscoelastic part, memory = whole - glassy, 2m x 2n, in two calls: before
 * the viscoelastic part is added to the flexibility, and after. RB_ENOMEM. */
rb_status rb_rolling_memory_before(const rb_bem_flexibility *glassy, double **memory);
void rb_rolling_memory_after(const rb_bem_flexibility *whole, double *memory);

/* ---- bodies.c ---------------------------------------------------------------------- */

/* The same bodies with their matrix, where they have none: f and transforms are new, also after
 * a failure, the rest is borrowed. */
rb_status rb_rolling_bodies_with_matrix(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                        const rb_rolling_bodies *bodies, rb_rolling_bodies *stored,
                                        rb_message *why);

/* Both bodies by what is near to the loads: wheels by half-planes, and by the far field, where one
 * is given (otherwise NULL); without systems of boundary elements. */
rb_status rb_rolling_bodies_near(const rb_rolling_case *rc, const rb_rolling_far_field *far,
                                 const rb_rolling_mesh *mesh, rb_rolling_bodies *bodies,
                                 rb_message *why);

/* ---- model.c ----------------------------------------------------------------------- */

/* 1: the last solve has taken all the steps that strong coupling has without a matrix. */
int rb_rolling_gave_up(const rb_rolling_model *model);

/* ---- fit.c ------------------------------------------------------------------------- */

/* From the edges of another solution with the same wheels to elements fitted to the edges of the
 * model's case.  Where the elements are short the far field of the other solution is as good as the
 * model's own: it then keeps that and has no systems of boundary elements.  model: as
 * rb_rolling_model_begin leaves it. */
rb_status rb_rolling_fit_beside(const rb_rolling_model *beside, rb_rolling_model *model,
                                rb_message *why);

/* ---- far_field.c ------------------------------------------------------------------- */

/* 1 if the bodies have a far field of which few points tell all: wheels of one elastic material
 * whose near field is subtracted, and gaps that say nothing about places without elements. */
int rb_rolling_has_far_field(const rb_rolling_case *rc);
/* From the bodies of the model, which have a matrix.  RB_ENOMEM. */
rb_status rb_rolling_far_field_create(const rb_rolling_model *model, rb_rolling_far_field **far,
                                      rb_message *why);
void rb_rolling_far_field_free(rb_rolling_far_field *far);
/* Adds it to a flexibility that is stored.  RB_ENOMEM. */
rb_status rb_rolling_far_field_add(const rb_rolling_far_field *far, rb_bem_flexibility *f);

/* ---- mesh.c ------------------------------------------------------------------------ */

/* Computes the gaps at the midpoints with the irregularity at its present place.
 * RB_ENOMEM. */
rb_status rb_rolling_mesh_set_gap(const rb_rolling_case *rc, rb_rolling_mesh *mesh);

/* ---- pressed.c ----------------------------------------------------------------------- */

/* Solves a trial of a search.  s: its numbers, without columns, the moment of the pressure among
 * them also in static; widest: NULL, or the half-width of the potential contact that it needs. */
rb_status rb_rolling_try(const rb_rolling_case *trial, rb_rolling_solution *s, double *widest,
                         rb_message *why);

/* ---- former_place.c ---------------------------------------------------------------- */

/* Tangential displacement at the distance `step` upstream of each midpoint: w_T = w0_T +
 * W_T (p, q).  Equal elements, half-planes and wheels. */
typedef struct {
    int n;
    double step;      /* 0: there is none */
    double *W_T;      /* n x 2n; NULL without a dense flexibility */
    double *response; /* w_T of a unit p and of a unit q at 2n - 1 distances */
} rb_rolling_former_place;

/* ahead: overwritten; its arrays are memory's. */
rb_status rb_rolling_former_place_create(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                                         double step, rb_arena *memory,
                                         rb_rolling_former_place *ahead);
/* w_T: n, overwritten. */
void rb_rolling_former_place_apply(const rb_rolling_former_place *ahead,
                                   const rb_rolling_bodies *bodies, const double *p,
                                   const double *q, double *w_T);
/* w_T of unit tractions one element downstream of the contact and two upstream of it.
 * W_T: 2 x 2n, zeroed.  Equal elements.  RB_ENOMEM. */
rb_status rb_rolling_displacement_outside(const rb_rolling_case *rc,
                                          const rb_rolling_bodies *bodies, double *W_T);

/* ---- formulation.c: what changes from step to step --------------------------------- */

/* The creepage of ratio xi R/(mu a), mu the largest coefficient, and the ratio of a
 * creepage: NAN without friction or contact. */
double rb_rolling_creepage_of_ratio(const rb_rolling_model *model, double ratio);
double rb_rolling_ratio_of_creepage(const rb_rolling_model *model, double creepage);

void rb_rolling_set_past(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                         const rb_rolling_past *past, rb_contact_problem *p);
void rb_rolling_set_control(const rb_rolling_case *rc, rb_contact_problem *p);
/* All that friction and given load, motion and force determine: bounds, control and
 * scales. */
void rb_rolling_set_given(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                          rb_contact_problem *p);
/* Another operator of the same bodies, after these have got a matrix.  The problem keeps its
 * own where there is no memory. */
rb_status rb_rolling_problem_renew_operator(const rb_rolling_case *rc,
                                            const rb_rolling_bodies *bodies, rb_contact_problem *p,
                                            rb_message *why);
/* The problem of bodies and an operator that belong to another one, which stays their
 * owner: p->op must be NULL before p is freed.  w0 of the bodies adds to gap and slip. */
rb_status rb_rolling_problem_share(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                   const rb_rolling_bodies *bodies, rb_contact_operator *op,
                                   rb_contact_problem *p, rb_message *why);
/* The given rigid shift or its default: a tenth of the approach, 0 under load control. */
double rb_rolling_wanted_shift(const rb_rolling_case *rc);
/* d_N, from the gaps of the mesh. */
void rb_rolling_set_gap(const rb_rolling_mesh *mesh, const rb_rolling_bodies *bodies,
                        rb_contact_problem *p);

/* Accumulated plastic slip of the interface at the elements (n). */
void rb_rolling_yielded(const rb_rolling_model *model, double *yielded);

/* ---- law.c, law_iteration.c: friction laws ----------------------------------------- */

rb_status rb_rolling_law_check(const rb_rolling_case *rc, rb_message *why);
/* Value of the table at x: linear between its points, constant beyond them. */
double rb_rolling_table_at(const rb_rolling_table *table, double x);
/* 1 if the law depends on the slip velocity. */
int rb_rolling_law_depends_on_slip(const rb_rolling_friction *f);
double rb_rolling_law_mu(const rb_rolling_case *rc, double x, double v, double temperature);
/* The coefficient at rest and without heating. */
double rb_rolling_law_at_rest(const rb_rolling_case *rc, double x);
/* Largest -dmu/dv of a particle that passes an element of this length, or an upper bound if two
 * terms have different slip scales or friction remembers (theory-rolling.md F3). */
double rb_rolling_law_steepest(const rb_rolling_case *rc, double length);
/* First bounds of the elements for the iteration: those at rest, or the given start. */
void rb_rolling_start_bounds(const rb_rolling_case *rc, const rb_rolling_table *start,
                             const rb_rolling_bodies *bodies, rb_contact_problem *p);
/* The coefficients (n) of the law for the state. */
rb_status rb_rolling_law_coefficients(rb_rolling_model *model, double *mu, rb_message *why);
/* Sets first bounds: coefficients of fast sliding up to x, and those at rest beyond. */
rb_status rb_rolling_law_start(rb_rolling_model *model, double x, rb_message *why);
/* law_newton.c: Newton's method from the present bounds, until these and the bounds of
 * the law differ by at most `enough` in the natural residual.  left: number of contact
 * problems that may still be solved.  RB_MAXITER: this number is used up, or the residual
 * does not decrease. */
rb_status rb_rolling_law_newton(rb_rolling_model *model, double enough, int *left, rb_message *why);
/* Solves the model's problem by iteration if the law depends on the state. */
rb_status rb_rolling_law_solve(rb_rolling_model *model, int warm, rb_message *why);

/* A creepage at which the whole contact slides; the search for a given force starts
 * there. */
double rb_rolling_sliding_creepage(const rb_rolling_case *rc, const rb_contact_problem *p);

/* ---- heat.c ------------------------------------------------------------------------ */

/* 1 if temperatures are computed. */
int rb_rolling_has_heat(const rb_rolling_case *rc);
/* V a/(2 diffusivity); INFINITY if no heat enters the body. */
double rb_rolling_peclet(const rb_rolling_heat *body, double speed, double half_width);
/* The speed at which the surface of A (of_b: B) passes the contact, V (1 -+ xi/2), V the mean of
 * both; < 0: towards +x. */
double rb_rolling_surface_speed(const rb_rolling_case *rc, int of_b, double creepage);
/* Temperatures of both surfaces (n each) under the friction power per unit speed (n) of
 * a steady solution with tractions, slip and zones, and the heat per area that enters each (NULL:
 * not asked for).  conduction: where what the elements make of heat is kept, from NULL on; freed by
 * the caller. */
rb_status rb_rolling_steady_temperature(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                        const double *power,
                                        struct rb_rolling_conduction **conduction, double *t_a,
                                        double *t_b, double *heat_a, double *heat_b,
                                        rb_message *why);
/* Of transient rolling: each body takes heat as its effusivity and the root of its speed. */
void rb_rolling_heat_by_effusivity(const rb_rolling_case *rc, const double *power,
                                   rb_rolling_solution *s);
/* (T1) G(z): what heat between a point and z/P upstream of it adds to its temperature. */
double rb_rolling_moving_source(double z);

/* The heat of earlier steps, for the particles that are still in the mesh. */
typedef struct rb_rolling_heat_track {
    int n, rows, newest, known; /* rows: number of stored steps (ring buffer), of which
                                   `known` are filled */
    double h, step;             /* lengths of an element and of a step */
    double half_width;          /* [length] */
    double *heat;               /* rows x n [stress * length / time] */
} rb_rolling_heat_track;

/* Creates a track for track->n elements of length h, in memory.  RB_EINVAL: the Peclet number is
 * too small for heat conduction along the depth only. */
rb_status rb_rolling_heat_track_create(const rb_rolling_case *rc, double half_width,
                                       rb_arena *memory, rb_rolling_heat_track *track,
                                       rb_message *why);
/* RB_EINVAL: the same of either surface at a creepage. */
rb_status rb_rolling_heat_track_check(const rb_rolling_case *rc, double half_width, double creepage,
                                      rb_message *why);
/* Prepares the storage for the heat of the next rolled step. */
void rb_rolling_heat_track_advance(rb_rolling_heat_track *track);
/* Stores the heat of the newest step with the friction, slip displacement and creepage of its
 * state, and computes the temperature (n) of both surfaces at its end. */
void rb_rolling_heat_track_step(const rb_rolling_case *rc, const rb_contact_state *state,
                                rb_rolling_heat_track *track, double *temperature);

/* ---- coarse.c ---------------------------------------------------------------------- */

/* Number of elements of the coarser mesh on which a problem with n elements starts. */
int rb_rolling_coarse_elements(int n);
/* Interpolates tractions, zones, delta and xi from a solution with fewer elements on the
 * same line. */
void rb_rolling_start_from(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                           const rb_contact_state *coarse, const rb_rolling_mesh *fine_mesh,
                           rb_contact_state *fine);

/* The friction coefficients (n; owned by the caller) of a solved model; NULL: those of
 * the case, or the law may have other states, or no memory. */
double *rb_rolling_friction_of(const rb_rolling_model *model);
/* Interpolates them from the mesh to a model on other elements, whose next solve follows
 * them; NULL: none. */
void rb_rolling_follow_friction(const rb_rolling_mesh *mesh, const double *bound,
                                rb_rolling_model *fine);

/* ---- model.c ----------------------------------------------------------------------- */

/* Sets another case on the same elements, for the next step of a history or the next
 * point of a curve; mesh, bodies and problem are not changed. */
rb_status rb_rolling_model_set_case(rb_rolling_model *model, const rb_rolling_case *rc,
                                    rb_message *why);
/* Frees model->freely. */
void rb_rolling_forget_free_rolling(rb_rolling_model *model);

/* ---- create.c ---------------------------------------------------------------------- */

/* The free-rolling creepage as a result: NAN if it is not found, which does not change
 * the status of the solved case.  RB_ENOMEM. */
rb_status rb_rolling_free_creepage_if_any(rb_rolling_model *model, double *creepage,
                                          rb_message *why);

/* ---- missed_contact.c -------------------------------------------------------------- */

enum { RB_MOST_OVERLAPS = 16 };

/* Intervals in which the bodies overlap although no midpoint of an element lies there. */
typedef struct {
    int count;
    double from[RB_MOST_OVERLAPS], to[RB_MOST_OVERLAPS];
} rb_rolling_overlap;

/* Searches along the whole table; other gaps are convex, so that the bodies cannot touch
 * outside the contact (theory-solvers.md 5.1).  RB_ENOMEM. */
rb_status rb_rolling_find_overlap(const rb_rolling_model *model, const rb_contact_state *state,
                                  rb_rolling_overlap *overlap);

/* RB_ZONE: an element at an end of the mesh is in contact, so that the contact may extend
 * further, or the bodies overlap where there is no midpoint of an element.  state: of the
 * model's problem. */
rb_status rb_rolling_check_enclosed(const rb_rolling_model *model, const rb_contact_state *state,
                                    rb_message *why);

/* ---- zone.c ------------------------------------------------------------------------ */

/* RB_EINVAL: a layer, cover or rim is compressed by all of its thickness. */
rb_status rb_rolling_check_crushed(const rb_rolling_model *model, rb_message *why);
/* Called at the end of a solution, a history or a curve with status s.  RB_EINVAL: a
 * layer or cover is crushed, or needs shorter elements than those in contact, which may
 * also be the reason for a failure.  Only meshes of results are checked; coarse meshes
 * used before may be too coarse. */
rb_status rb_rolling_check_layer_resolved(const rb_rolling_model *model, rb_status s,
                                          rb_message *why);
/* Solves on equal elements in the given potential contact, or in one that is found and
 * encloses the contact.  coarse: elements may be too long for separate patches; later
 * searches begin with the potential contact of this one.  RB_ZONE: no potential contact
 * was found; RB_NO_CONTACT. */
rb_status rb_rolling_solve_zone(rb_rolling_model *model, int coarse, rb_message *why);

/* The same on the elements of a punch. */
rb_status rb_rolling_solve_punch(rb_rolling_model *model, rb_message *why);

/* The first potential contact, from the undeformed gap: its ends, the smallest gap and that at the
 * edges of the contact. */
void rb_rolling_first_zone(const rb_rolling_case *rc, double *from, double *to, double *least,
                           double *level);

/* ---- resolution.c ------------------------------------------------------------------ */

/* The number of elements, `least` or more, whose midpoints show what the tables of gap,
 * irregularity, worn depth and friction say, on the mesh of the case.  RB_ENOMEM. */
rb_status rb_rolling_elements_for_tables(const rb_rolling_case *rc, int least, int *elements);
/* What those of the case miss of the tables, 0 if they are enough: amplitude of the pressure
 * [stress], mean error of the coefficient of friction.  RB_ENOMEM. */
rb_status rb_rolling_missed_by_elements(const rb_rolling_case *rc, double *pressure, double *mu);

/* ---- align.c ----------------------------------------------------------------------- */

/* Solves on equal elements whose ends coincide with both edges, after a first solution.
 * If the edges do not converge, other equal elements are used, and model->equal_instead
 * is set. RB_EINVAL: several patches. */
rb_status rb_rolling_solve_aligned(rb_rolling_model *model, rb_message *why);
/* The same, starting from the present edges of the model. */
rb_status rb_rolling_model_realign(rb_rolling_model *model, rb_message *why);

/* ---- fit.c ------------------------------------------------------------------------- */

/* Solves on elements fitted to the contact edges; if these do not converge, on equal
 * elements, and model->equal_instead is set. */
rb_status rb_rolling_solve_fitted(rb_rolling_model *model, rb_message *why);
/* Shift of a contact edge, in half-widths, beyond which a mesh is fitted or aligned again where
 * a solution follows another one. */
#define RB_ROLLING_REFIT 0.01
/* Builds a fitted mesh and bodies again for the present edges of the model, and
 * solves. */
rb_status rb_rolling_model_refit(rb_rolling_model *model, rb_message *why);
/* Solves on the same number of equal elements across the contact, without fitting their
 * ends. */
rb_status rb_rolling_solve_equal_instead(rb_rolling_model *model, rb_message *why);

/* ---- mesh.c ------------------------------------------------------------------------ */

/* The worn depth at x. */
double rb_rolling_worn_depth(const rb_rolling_case *rc, double x);
/* How much the largest pressure rises where elements get so many times shorter, because
 * the slope of the worn table, or of the gap's, turns by s at a corner between `from` and
 * `to`: there the pressure is infinite, p = -E* s ln|x| / (2 pi) + ..., up to the next one. */
double rb_rolling_rise_at_corners(const rb_rolling_case *rc, double from, double to, double element,
                                  double times);
/* The same in the patches of a solution, in mm, N, MPa, but for corners so near an edge that the
 * surface is pressed on one side of them only. */
double rb_rolling_rise_in_patches(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                  double times);
/* The undeformed gap at n places, with the irregularity moved by `passed`.  RB_ENOMEM. */
rb_status rb_rolling_gap_along(const rb_rolling_case *rc, double passed, int n, const double *x,
                               double *gap);
/* 0: the bodies may touch in several places. */
int rb_rolling_is_convex(const rb_rolling_case *rc);
/* The interval in which elements may lie: on the lower half of every round body, within
 * the table and one period. */
void rb_rolling_extent(const rb_rolling_case *rc, double *from, double *to);

/* A patch for fitted elements, and how far the elements must extend beyond its edges. */
typedef struct {
    double from, to, margin_left, margin_right;
    double h_left, h_right; /* lengths of the elements from which the edges were computed; fit.c */
} rb_rolling_span;

/* The elements of a punch, whose pressure may be infinite at its ends. */
rb_status rb_rolling_mesh_punch(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                rb_rolling_mesh *mesh, rb_message *why);
rb_status rb_rolling_mesh_spans(const rb_rolling_case *rc, int all, int count,
                                const rb_rolling_span *span, rb_rolling_mesh *mesh,
                                rb_message *why);

/* ---- power.c ----------------------------------------------------------------------- */

/* Power per unit speed of friction q (n) and slip displacement lambda (n); NAN for
 * static. */
double rb_rolling_dissipated_power(const rb_rolling_case *rc, int n, const double *lambda,
                                   const double *q, const double *h, const double *e_T);

/* int p abs(slip) dx per rolled distance, with slip and pressure multiplied as in the
 * power. */
double rb_rolling_slid_pressure(const rb_rolling_case *rc, int n, const double *lambda,
                                const double *p, const double *h, const double *e_T);

/* Compression of the thinnest layer, cover or rim divided by its thickness; what: which
 * of them it is (may be NULL).  The approach is divided between two elastic bodies by
 * their compliances, but no body is compressed more than the pressure can compress its
 * material.  NAN: neither body has a layer, cover or rim. */
double rb_rolling_strain(const rb_rolling_case *rc, double approach, double pressure,
                         const char **what);

/* Torques that keep both bodies rolling against M and the force Q, > 0 if they drive
 * (theory-bodies.md V4); torque_b is NAN if B is a plane. */
void rb_rolling_torques(const rb_rolling_case *rc, double moment, double force, double *torque_a,
                        double *torque_b);

/* Power per unit speed that viscoelasticity dissipates, -int t Dw ds (theory-bodies.md V4): 0
 * for elastic bodies; steady rolling only, otherwise NAN.  RB_ENOMEM. */
rb_status rb_rolling_hysteresis(const rb_rolling_model *model, double *power);
/* Power per unit speed that the lever arms of wheels supply, which change as they deform
 * (theory-bodies.md V4): 0 for half-planes; steady rolling only, otherwise NAN.  hysteresis: the
 * result of the function above.  RB_ENOMEM. */
rb_status rb_rolling_lever_power(const rb_rolling_model *model, double hysteresis, double *power);

/* ---- patches.c --------------------------------------------------------------------- */

/* A patch: neighbouring elements first ... last in contact, and its edges. */
typedef struct {
    int first, last;
    double from, to;
    int bounded; /* edges that are only known to lie within one element, as in rb_rolling_patch */
} rb_rolling_run;

/* (E1) The power of the distance from the edge on that side (-1 left, +1 right) with which
 * the pressure starts there.  Where A slides with q = -+mu p up to the edge, it is
 * 1/2 + side atan(beta q/p)/pi; without friction, without coupling and in stick 1/2; on a
 * third body that is softer than the half-planes under an element of such a length 1.  j: an
 * element near the edge; a slip zone that does not hold its inner neighbour is too short. */
double rb_rolling_edge_exponent(const rb_rolling_case *rc, double length,
                                const rb_contact_state *state, int j, int side);

/* Smallest number of equal elements of a patch whose edges can be computed from the
 * pressure (theory-rolling.md 4.7). */
enum { RB_ROLLING_ALIGNED_LEAST = 9 };
/* And of any elements. */
enum { RB_ROLLING_PATCH_LEAST = 5 };

/* Vertex of the parabola through (0, 0) and two neighbours (d, f): its height and place.
 * 0: the parabola has no maximum. */
static inline int rb_rolling_vertex(const double d[2], const double f[2], double *rise, double *at)
{
    const double left = f[0] / d[0], right = f[1] / d[1];
    const double curvature = (right - left) / (d[1] - d[0]);
    const double slope = left - curvature * d[0];

    if (!(curvature < 0.0))
        return 0;
    *rise = -slope * slope / (4.0 * curvature);
    *at = -slope / (2.0 * curvature);
    return 1;
}
/* Finds the next patch from element `at` on; returns 0 if there is none. */
int rb_rolling_next_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                          const rb_contact_state *state, int at, rb_rolling_run *run);
/* The same, but patches are merged if more elements between them would not help: all
 * patches under a convex gap (single open elements next to an edge are ignored), and
 * patches that are separated by one open element if large friction between dissimilar
 * bodies opens every other element. */
int rb_rolling_next_merged_patch(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                 const rb_contact_state *state, int at, rb_rolling_run *run);
/* Computes the patches of a solution and the results that depend on all of them.
 * RB_ENOMEM. */
rb_status rb_rolling_set_patches(const rb_rolling_model *model, rb_rolling_solution *solution);

/* Length of the longest element in contact. */
double rb_rolling_longest_element(int n, const int *zone, const double *h);

#endif
