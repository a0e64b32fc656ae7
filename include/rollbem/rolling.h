/* Rolling contact in two dimensions: case -> contact mesh -> flexibility -> LCP -> solver
 * -> solution.  Each arrow is a public function that takes the structs before it and
 * fills the next one, so that a program can call each step alone and look at its result.
 * Conventions (theory.md 2): A rolls towards +x, material passes the contact from +x to
 * -x; a creepage xi > 0 means a braked wheel: A's surface slides towards +x over the
 * ground, the friction on A points to -x, and Q < 0.  Loads are per unit length (plane
 * strain). Equation tags (K1) ... (K6): docs/theory.md. */
#ifndef ROLLBEM_ROLLING_H
#define ROLLBEM_ROLLING_H

#include "rollbem/base.h"
#include "rollbem/bem.h"
#include "rollbem/contact.h"
#include "rollbem/units.h"

RB_PUBLIC_BEGIN

/* ---- Case ------------------------------------------------------------------------ */

typedef enum { RB_STATIC, RB_STEADY, RB_TRANSIENT } rb_rolling_formulation;
typedef enum { RB_GAP_PARABOLA, RB_GAP_EXACT, RB_GAP_TABLE } rb_rolling_gap;
typedef enum {
    RB_MESH_UNIFORM,
    RB_MESH_FITTED,
    RB_MESH_ALIGNED /* equal elements whose ends meet both edges of the contact */
} rb_rolling_mesh_kind;
/* A of steady rolling (theory.md 4.2): the difference to the element upstream, or the
 * second-order difference of equal elements. */
typedef enum { RB_SLIP_UPSTREAM, RB_SLIP_SECOND } rb_rolling_slip_operator;
/* From how many equal elements on half-planes are solved by Fourier transforms, without a
 * matrix: steady rolling, with every friction law (on aligned meshes as fast as the
 * matrix at 150 elements, 2 to 4 times faster at 800); static contact, steps and wear (as
 * fast at 300, twice as fast at 600, 2 to 5 times at 1200).  Below RB_ROLLING_LARGE a
 * matrix can be added where something needs it (rb_rolling_model_add_matrix); from there
 * on it would take seconds. */
enum { RB_ROLLING_TRANSFORMS = 150, RB_ROLLING_TRANSFORMS_STEPS = 400, RB_ROLLING_LARGE = 1500 };
/* How displacements of a wheel close to a load are computed: by its boundary elements
 * alone, as in *Addi*, or by the exact solution of a strip load on the half-plane plus
 * boundary elements for the remainder (B10). */
typedef enum {
    RB_NEAR_FIELD_AUTO, /* exact on fitted meshes */
    RB_NEAR_FIELD_PLAIN,
    RB_NEAR_FIELD_EXACT
} rb_rolling_near_field;

/* The most of each that a case may ask for: elements of the contact and on the circle outside
 * it, steps of a history, points of a curve. */
enum {
    RB_ROLLING_MOST_ELEMENTS = 1 << 24,
    RB_ROLLING_MOST_OUTER = RB_BEM_MOST_ELEMENTS,
    RB_ROLLING_MOST_STEPS = 10000000,
    RB_ROLLING_MOST_POINTS = 1000000
};

/* Viscoelasticity (V1): creep compliance J(t) = J_g [1 + sum f_k (1 - exp(-t/tau_k))],
 * Poisson's ratio constant. */
enum { RB_ROLLING_TERMS = 16 };
typedef struct {
    int n;                          /* 0: elastic */
    double time[RB_ROLLING_TERMS];  /* tau_k > 0 [s] */
    double ratio[RB_ROLLING_TERMS]; /* f_k >= 0 */
} rb_rolling_memory;

/* Thermal properties of a body for frictional heating (T1).  Units: with N, mm, s the
 * conductivity is N/(s K) = W/(m K) and the heat capacity MPa/K = MJ/(m^3 K). */
typedef struct {
    double conductivity;  /* [force/(time temperature)]; 0: no heat enters this body */
    double heat_capacity; /* density times specific heat [stress/temperature] */
    double temperature;   /* far from the contact */
} rb_rolling_heat;

typedef struct {
    double young, poisson; /* [stress], [-]; of a viscoelastic body the glassy
                              (instantaneous) modulus */
    double radius;         /* [length]; of body B also INFINITY: a plane; < 0: a bore around A */
    rb_bem_support support;
    double arc;       /* half-angle of the clamped arc [degrees] */
    double hub_ratio; /* radius of the rigid hub / radius */
    double datum;     /* half-plane: depth of zero displacement; 0: 2R/e */
    double strip;     /* homogeneous half-plane: in place of a datum, the width of a strip
                         of a half-space that rests far away, as in CONTACT; 0: a datum */
    double layer;     /* half-plane: thickness of a layer of this material, bonded to a
                         base [length]; 0: no layer */
    double base_young, base_poisson; /* of the base; young 0: rigid */
    double cover;                    /* hub: thickness of a cover of this material, bonded to a core
                                        [length]; 0: none */
    double core_young, core_poisson; /* of the core, a ring on the rigid hub; young 0:
                                        everything below the cover is rigid */
    rb_rolling_memory memory;        /* viscoelasticity of the material; n = 0: elastic */
} rb_rolling_body;

/* Properties of a body, as bits. */
typedef enum {
    RB_BODY_FLAT = 1,        /* its surface is a plane, otherwise a circle */
    RB_BODY_BOUNDARY = 2,    /* has boundary elements outside the contact, too */
    RB_BODY_HOMOGENEOUS = 4, /* of one elastic material: Hertz's half-width applies, and
                                the formulas of heat conduction, too */
    RB_BODY_ELASTIC = 8,     /* elastic: no hysteresis */
    RB_BODY_STRESS = 16,     /* the stress inside can be computed */
    RB_BODY_TURNS = 32       /* rotationally symmetric: its stiffness is the same at every angle */
} rb_rolling_ability;

/* An option that applies to some bodies only; the option of body B has the suffix
 * "-b". */
typedef struct {
    const char *option;                              /* NULL ends the list */
    int (*has_meaning)(const rb_rolling_body *body); /* NULL: every body of the row */
    const char *reason; /* end of the error message for other bodies; NULL: "of the
                           support ..." */
} rb_rolling_parameter;

/* The allowed words of the option `support`; an entry with name NULL ends the list. */
extern const rb_choice rb_rolling_supports[];

/* 1: the body has all properties of the sum `abilities`. */
int rb_rolling_body_can(const rb_rolling_body *body, int abilities);

/* Values y at n increasing abscissae x [length].  Borrowed. */
typedef struct {
    int n; /* 0: none */
    const double *x, *y;
} rb_rolling_table;

/* A measured gap g_0(x) [length]: n points with increasing x, interpolated by cubic
 * splines between the corners of the data; the pressure follows the curvature of the gap,
 * and that of a spline is continuous.  noise 0: the curve passes through the points.  noise > 0:
 * standard deviation of the noise of the points [length]; the spline is the smoothest curve whose
 * root mean square distance to the points is that small.  RB_EINVAL: too few points, x
 * does not increase, or the smallest gap is at an end, so that the table does not enclose
 * a contact; why names the row.  RB_ENOMEM. */
typedef struct rb_rolling_profile rb_rolling_profile;
rb_status rb_rolling_profile_create(int n, const double *x, const double *gap, double noise,
                                    rb_rolling_profile **profile, rb_message *why);
/* The same as one cubic spline without corners, which changes smoothly with its points: of a gap
 * that is searched for. */
rb_status rb_rolling_profile_smooth(int n, const double *x, const double *gap,
                                    rb_rolling_profile **profile, rb_message *why);
void rb_rolling_profile_free(rb_rolling_profile *profile);
/* The radius of the parabola that is nearest to the gap around its smallest value, in the lowest
 * tenth of its range [length]; NAN: the gap has none: it is flat, a roof or hollow there. */
double rb_rolling_profile_radius(const rb_rolling_profile *profile);
/* The first and the last x of the profile. */
void rb_rolling_profile_range(const rb_rolling_profile *profile, double *from, double *to);
/* The gap at any x.  Beyond the ends it is extrapolated by straight lines; a contact
 * there is not accepted. */
double rb_rolling_profile_gap(const rb_rolling_profile *profile, double x);

/* ---- Friction laws (theory.md 4.11) ------------------------------------------------ */

/* A law gives the coefficient of an element from its state: place x, slip velocity v,
 * temperature.  Each row of this table has the name of a law and one line about it.  The
 * function of the law is in src/rolling/solve/law.c; option, help, JSON and messages are made
 * from the row.  mu: the coefficient of the case; m and s: fall and slip_scale below. */
#define RB_ROLLING_FRICTION_LAWS(LAW)                                                              \
    LAW(constant, "mu everywhere")                                                                 \
    LAW(exponential, "mu + sum m 2^(-v/s) at the slip velocity v")                                 \
    LAW(rational, "mu + m1/(1 + v/s1) + m2/(1 + (v/s2)^2)")                                        \
    LAW(linear, "mu + sum m max(0, 1 - v/(2s))")

#define RB_FRICTION_LAW_NAME(name, help) RB_FRICTION_##name,
typedef enum {
    RB_ROLLING_FRICTION_LAWS(RB_FRICTION_LAW_NAME)
        RB_FRICTION_table, /* mu over x from a file; the option for it is the file's name
                            */
    RB_FRICTION_LAWS
} rb_rolling_friction_law;
#undef RB_FRICTION_LAW_NAME

typedef struct {
    rb_rolling_friction_law law;
    /* RB_FRICTION_table: mu over x, linear between the points and constant beyond them;
     * mu of the case is ignored. */
    rb_rolling_table table;
    double fall[2], slip_scale[2]; /* m >= -mu [-], s > 0 [length/s]; a term with m = 0 is absent */
    /* Friction memory with the sliding distance d: dmu/dt = -(max(v, s0)/d)(mu -
     * mu(v)). */
    double memory, memory_slip; /* d [length], 0: none; s0 > 0 [length/s] */
    /* mu changes linearly by heat while the surface temperature rises from heat_from to
     * heat_from + heat_range. */
    double heat, heat_from, heat_range; /* [-], 0: none; two temperatures */
} rb_rolling_friction;

/* All inputs of one case.  Of quantities with the comment "one of" at most one is given;
 * the others are NAN. rb_rolling_case_defaults() is the example of *Addi* (theory.md
 * 7). */
typedef struct {
    rb_bem_plane plane; /* strain, or stress of thin discs */
    rb_rolling_body a, b;
    int elastic_b; /* 0: B is a rigid plane and b is ignored */

    rb_rolling_heat heat_a, heat_b; /* temperatures are computed if A's conductivity is >
                                       0; heat_b is used also if B is rigid */

    rb_rolling_gap gap;
    const rb_rolling_profile *profile; /* RB_GAP_TABLE; borrowed */
    /* An irregularity of the surface that is added to the gap: a dent (> 0) or a bump (<
     * 0).  The first and the last value are 0; x is the place before rolling.  It moves
     * with the material towards -x; `passed` of a mesh is the distance moved. Not for
     * steady rolling. */
    rb_rolling_table irregularity;
    /* Worn depth in the contact frame, added to the gap: linear between the points, zero
     * beyond them [length]. */
    rb_rolling_table worn;

    /* Compliance of an interface between the surfaces (third body), whose deformation at
     * a point depends on the traction at this point only [length/stress]; 0: none. */
    double interlayer_normal, interlayer_tangential;
    /* Yield stress of this interface in shear [stress], 0: it does not yield; and its
     * increase per plastic slip [stress/length], < 0: softening. */
    double yield_stress, hardening;

    double mu; /* Coulomb's coefficient; of velocity-dependent laws the limit at large
                  slip velocity */
    rb_rolling_friction friction;

    double approach, load, half_width; /* one of; all NAN: approach = R/2 */

    /* static: one of shift, force, force_ratio loads the contact (all NAN: the shift is a
     * tenth of the given approach, as in *Addi*, or 0 under load control); creep or
     * creep_ratio only enter (12). steady, transient: one of creep, creep_ratio, force,
     * force_ratio. */
    double shift, creep, creep_ratio, force, force_ratio;
    int free_axle; /* steady: A's axle is free of torque, Q = -M/R_A (theory.md V4), and
                      creepage and force are not given */

    rb_rolling_formulation formulation;
    int increments;   /* static, transient: if above 1, the bodies are first pressed and
                         then loaded tangentially, each in this number of increments
                         (theory.md 5.3) */
    double speed;     /* rolling speed [length/s]; must be > 0 if a rolling body is viscoelastic
                         or conducts heat, or if friction depends on the slip velocity */
    double time_step; /* static program of viscoelastic bodies: longest time step between
                         two rows [s]; 0: one step per row */
    double distance;  /* transient: rolled distance / Hertz half-width */
    int steps;        /* transient */

    rb_rolling_mesh_kind mesh;
    int contact_elements;    /* uniform: in the potential contact; fitted: across the contact
                              */
    double zone;             /* half-width of the potential contact [length]; 0: automatic */
    int outer_elements;      /* 0: automatic */
    double outer_refinement; /* factor on the number of elements of wheels outside the
                                contact; 0: 1 */
    rb_bem_normals normals;
    rb_rolling_near_field near_field;       /* of wheels */
    rb_rolling_slip_operator slip_operator; /* steady; second: equal elements */

    rb_contact_options contact; /* how the contact problem is solved */
} rb_rolling_case;

rb_rolling_case rb_rolling_case_defaults(void);

/* The elastic constants of a body for the plane problem of the case; the second function:
 * those of the base or core below its layer or cover. */
rb_bem_material rb_rolling_material(const rb_rolling_case *rc, const rb_rolling_body *body);
rb_bem_material rb_rolling_base_material(const rb_rolling_case *rc, const rb_rolling_body *body);

/* The largest coefficient of the friction law; it is the mu of Q/(mu P) and of xi R/(mu
 * a). */
double rb_rolling_largest_mu(const rb_rolling_case *rc);
/* 1 if the coefficients depend on the solution, so that they have to be iterated: in
 * rolling, if the law depends on the slip velocity or on the temperature. */
int rb_rolling_law_depends_on_state(const rb_rolling_case *rc);
/* 1: A, and B if it is elastic, have all properties of `abilities`. */
int rb_rolling_can(const rb_rolling_case *rc, int abilities);

/* 1 if Carter's law applies: steady rolling of similar homogeneous half-planes whose gap
 * is not a table. */
int rb_rolling_carter_holds(const rb_rolling_case *rc);
/* 1: pressure displaces the surfaces along each other, and friction apart: the bodies are unlike,
 * and tractions have other exponents at the edges than the square root (E1). */
int rb_rolling_couples(const rb_rolling_case *rc);
/* 1: a body of the case is viscoelastic. */
int rb_rolling_relaxes(const rb_rolling_case *rc);

/* Checks ranges and contradictions.  RB_EINVAL with one line in why. */
rb_status rb_rolling_case_check(const rb_rolling_case *rc, rb_message *why);

/* Quantities that follow from a case without solving it. */
typedef struct {
    double radius;     /* 1/R = 1/R_A + 1/R_B [length] */
    double modulus;    /* E* [stress] */
    double dundurs;    /* beta [-] */
    double load;       /* given, or computed from the given half-width; NAN: the approach is
                          given */
    double approach;   /* given, or R/2; NAN: the load is given */
    double half_width; /* a: rb_rolling_contact_half_width of the load, or an estimate from the
                          approach */
    double stress;     /* the scale of the tractions: E* a/(2R), Hertz's p0, or 2P/(pi a) */
    double strain;     /* the scale of strains and creepages: a/R, or 2 stress/E* of a gap without
                          a radius */
} rb_rolling_derived;

rb_rolling_derived rb_rolling_derive(const rb_rolling_case *rc);
/* 1/R = 1/R_A + 1/R_B; Hertz's half-width of a load, and the load of a half-width.  INFINITY: the
 * gap is a table that has no radius, and none was given; what refers to one is NAN then. */
double rb_rolling_radius(const rb_rolling_case *rc);
int rb_rolling_has_radius(const rb_rolling_case *rc);
double rb_rolling_hertz_half_width(const rb_rolling_case *rc, double load);
/* The half-width a of the contact under a load by formula, the unit of distances and of xi R/(mu
 * a): Hertz's; with a third body that gives way and in steady rolling of bodies that relax theirs
 * (theory.md A1), to one or two per cent; of a gap without a radius half of where it is low. */
double rb_rolling_contact_half_width(const rb_rolling_case *rc, double load);
/* The unit of the distances of a history under this largest load: the same of the bodies at rest,
 * where nothing has relaxed yet. */
double rb_rolling_unit_of_distance(const rb_rolling_case *rc, double load);

/* The half-width that an automatic zone follows [length]: Hertz's, or, where it is larger, that
 * between rigid bodies with the normal compliance L_N of the third body, P = 2 a^3/(3 R L_N).
 * load: NaN: those of the given approach. */
double rb_rolling_zone_half_width(const rb_rolling_case *rc, double load);
double rb_rolling_hertz_load(const rb_rolling_case *rc, double half_width);
/* 1: a body has a finite thickness: a layer, a cover or a wheel on a hub. */
int rb_rolling_has_thickness(const rb_rolling_case *rc);
/* The larger radius of A and B; A's if B is a plane. */
double rb_rolling_larger_radius(const rb_rolling_case *rc);

/* ---- Case -> contact mesh -> flexibility ------------------------------------------- */

/* How a case is discretised, and where its solution begins.  A search for the mesh varies
 * these values and leaves the case unchanged. */
typedef struct {
    int elements; /* in the potential contact, or across that of a fitted mesh */
    rb_rolling_near_field near_field;
    int outer_elements;
    double outer_refinement; /* all four: as in rb_rolling_case */
    /* First coefficients of the iteration of a friction law; NULL: those at rest.  A law
     * that falls steeply has several solutions (kappa > 1), and the iteration then finds
     * one close to its start. */
    const rb_rolling_table *start; /* borrowed */
    double compression;            /* as in rb_bem_system_create_within; usual: INFINITY */
} rb_rolling_plan;

/* Compression of boundaries whose flexibility is subtracted from that of others nearby: what
 * hierarchical matrices leave out by chance is divided by the step between them. */
#define RB_ROLLING_CLOSE 1e-13

/* The plan with the values of the case; functions that get plan NULL use it. */
rb_rolling_plan rb_rolling_plan_of(const rb_rolling_case *rc);

/* The potential contact: n elements between ends[0] and ends[n] and the upstream element
 * [ends[n], ends[n + 1]] (theory.md 4.2). */
typedef struct {
    int n;
    double *ends;  /* n + 2 abscissae [length]; owned */
    double *gap;   /* n: g_0 at the midpoints, without approach [length]; owned */
    double passed; /* distance by which the irregularity has moved towards -x [length] */
} rb_rolling_mesh;

/* Equal elements between from and to. */
rb_status rb_rolling_mesh_uniform(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                  double from, double to, rb_rolling_mesh *mesh, rb_message *why);
/* Elements fitted to the contact edges [from, to]: ends at -cos(theta) between them, and
 * growing ones outside each edge (theory.md 5.1). */
rb_status rb_rolling_mesh_fitted(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 double from, double to, rb_rolling_mesh *mesh, rb_message *why);
/* The elements of a result; borrowed. */
typedef struct {
    int n;
    const double *x, *h; /* n: midpoints, lengths */
    int are_equal;
} rb_rolling_elements;

/* Reconstructs the mesh of a result: equal elements from the two outer ends, fitted
 * elements from every element. */
rb_status rb_rolling_mesh_of_result(const rb_rolling_case *rc, const rb_rolling_elements *elements,
                                    rb_rolling_mesh *mesh, rb_message *why);
void rb_rolling_mesh_free(rb_rolling_mesh *mesh);
/* The undeformed gap of the profile at x, including the worn depth. */
double rb_rolling_initial_gap(const rb_rolling_case *rc, double x);

/* The bodies of a case on a contact mesh.  The factorised systems are kept for later
 * solves. */
typedef struct {
    rb_bem_flexibility f;               /* of both bodies together; owned */
    rb_bem_system *system_a, *system_b; /* NULL for half-planes, covers and rigid bodies;
                                           owned */
    const double *F; /* 2m x 2n dense flexibility, ld = 2m, m = n + 1, owned by f; NULL if
                        products with f are used instead (large contacts) */
    rb_bem_flexibility transforms; /* the same operator as products, if Newton's method is
                                      faster with them than with F; n = 0: none; owned */
    double *memory[2];             /* of A and B, 2m x 2n each, in the frame of the body: the
                                      viscoelastic part of its flexibility; NULL if the body is
                                      elastic or no body is a wheel; owned */
    double seconds_assembly, seconds_factor, seconds_condense;
} rb_rolling_bodies;

rb_status rb_rolling_bodies_create(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   const rb_rolling_mesh *mesh, rb_rolling_bodies *bodies,
                                   rb_message *why);
void rb_rolling_bodies_free(rb_rolling_bodies *bodies);
/* w = w0 + F (p, q), 2m values, m = n + 1.  RB_ENOMEM. */
rb_status rb_rolling_displacement(const rb_rolling_bodies *bodies, const double *p, const double *q,
                                  double *w);

/* A row of the table of bodies (src/rolling/body/body.c).  A body has the row of its support
 * and one row for each addition (layer, cover, viscoelasticity).  It has those properties
 * that all its rows have. */
typedef struct rb_rolling_body_kind rb_rolling_body_kind;

/* Row k = 0, 1, ... of the table; NULL after the last one. */
const rb_rolling_body_kind *rb_rolling_body_kind_get(int k);
/* The row of the body's support. */
const rb_rolling_body_kind *rb_rolling_kind_of(const rb_rolling_body *body);
/* 1: it is a row of this body. */
int rb_rolling_body_is(const rb_rolling_body *body, const rb_rolling_body_kind *kind);
const char *rb_rolling_kind_name(const rb_rolling_body_kind *kind); /* in pictures */
rb_bem_support rb_rolling_kind_support(const rb_rolling_body_kind *kind);
/* The options that apply to some bodies only; an entry without a name ends the list. */
const rb_rolling_parameter *rb_rolling_kind_parameters(const rb_rolling_body_kind *kind);

/* ---- The formulation as a contact problem (contact.h) ------------------------------ */

/* The state from which a step of a static history or of transient rolling starts. */
typedef struct {
    const double *w_T;     /* displacements before the step: transient: at the former places x
                              + c; static: at the same places */
    const double *yielded; /* accumulated plastic slip of the interface at these places;
                              NULL: zero */
    double step;           /* rolled distance c of a transient step [length] */
} rb_rolling_past;

/* Builds the contact problem with A and d_T of the case's formulation; the solvers are
 * the same for all formulations.  past NULL: the step starts from rest. */
rb_status rb_rolling_problem_create(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                    const rb_rolling_bodies *bodies, const rb_rolling_past *past,
                                    rb_contact_problem *problem, rb_message *why);

/* Solves the problem with the solver of the case, and searches of a creepage by its scale,
 * problem->sliding: that of the case with the coefficients of friction that the problem has
 * now.  warm: 1 to start from the zones of the state. */
rb_status rb_rolling_problem_solve(rb_contact_problem *problem, const rb_rolling_case *rc, int warm,
                                   rb_contact_state *state, rb_message *why);

/* ---- Solution -------------------------------------------------------------------- */

/* A part of the contact with separated elements on either side. */
typedef struct {
    double from, to; /* edges [length] */
    double normal_load,
        tangential_load;       /* the part of P and Q that this patch carries [force/length] */
    double max_pressure, peak; /* largest pressure [stress] and its place [length] */
    int contact, stick;        /* elements */
    int bounded; /* RB_LEFT_BOUNDED, RB_RIGHT_BOUNDED: this edge is only known to lie within
                    one element, because p does not fall to zero there like (E1) of theory.md */
} rb_rolling_patch;
enum { RB_LEFT_BOUNDED = 1, RB_RIGHT_BOUNDED = 2 };

typedef struct {
    int n;           /* contact elements, in the order of increasing x */
    double *x, *h;   /* midpoints and lengths [length]; owned, as all arrays here */
    double *gap;     /* y_N [length] */
    double *p, *q;   /* r_N >= 0 and r_T on A [stress] */
    double *un, *ut; /* w_N, w_T of A (of A and B together where both are elastic) */
    double *shift;   /* T_T lambda [length]; 0 in stick */
    double *slip;    /* relative slip velocity [-]: (12) in static, shift/distance else */
    int *zone;       /* rb_contact_zone */
    double *plastic; /* accumulated plastic slip of the interface [length]; NULL if it
                        does not yield */
    double *temperature,
        *temperature_b; /* of the surfaces; NULL if the case has no heat conduction */
    double *worn;       /* worn depth [length]; NULL if nothing is worn */
    double *mu;         /* friction coefficients; NULL: the same for all elements */

    int patches;
    rb_rolling_patch *patch; /* in the order of increasing x; owned */

    rb_units units; /* of all values here */
    rb_status status;
    rb_rolling_formulation formulation;
    rb_rolling_slip_operator slip_operator;
    rb_contact_solver solver; /* the solver that found the solution */
    const char *cone_solver;  /* name of the cone solver if solver is RB_SOLVER_CONE;
                                 borrowed from the case */
    int large;                /* 1: solved with Fourier transforms; no matrix was formed */
    int boundary_elements;    /* of both bodies; 0: half-planes have none */
    int hierarchical;         /* 1: a boundary element matrix was hierarchical */
    rb_contact_lcp_form lcp_form;
    int iterations;  /* pivots or Newton steps, of all solves */
    double residual; /* natural residual of the scaled problem, recomputed from p, q,
                        shift */
    double residual_gap,
        residual_slip;        /* largest violations of the gap and slip conditions [length] */
    double residual_friction; /* and of the friction condition [stress] */

    double normal_load, tangential_load; /* P = sum p h, Q = sum q h [force/length] */
    double load_error;                   /* |P - wanted|/wanted; NAN without load control */
    double support_balance;              /* (reaction + load)/P; NAN for half-planes */
    double approach, tangential_shift;   /* delta; rigid shift (static) [length] */
    double creepage, free_creepage;      /* xi; xi at Q = 0 (steady); NAN otherwise, or if no
                                            such xi was found */
    double hertz_half_width;             /* rb_rolling_contact_half_width of the load P; used in
                                            creep_ratio; NAN: the gap has no radius */
    double creep_ratio, force_ratio;     /* xi R/(mu a), Q/(mu P); NAN at mu = 0 */
    double half_width;                   /* of the contact, from edge to edge [length] */
    double datum;                        /* of A; NAN where it has none [length] */
    double contact_from, contact_to;     /* outermost edges (theory.md 5.1) */
    double nip_width;                    /* contact_to - contact_from [length] */
    int edges_bounded;  /* 1: some edge of some patch is only known to an element */
    int equal_instead;  /* 1: equal elements were used, because fitting the mesh to the
                           contact edges did not converge */
    double row_changes; /* as in rb_rolling_history, like row_changed */
    int row_changed;
    double max_pressure;          /* p0 [stress] */
    int contact, stick, slipping; /* numbers of elements; slipping includes yielding */
    int yielding; /* number of elements whose interface yields; -1: no yield stress */
    double stick_from,
        stick_to;              /* outermost ends of the sticking elements; NAN if nothing sticks */
    double stick_length;       /* total length of the sticking elements, less than stick_to -
                                  stick_from if some in between slip [length] */
    int slip_violations;       /* number of elements whose slip does not oppose the friction */
    double dissipation;        /* power per unit speed [force/length] */
    double resistance_moment;  /* M = int x p dx [force]; NAN in static, like the ratio */
    double resistance_ratio;   /* M/(P R), the coefficient of rolling resistance */
    double hysteresis;         /* power per unit speed that viscoelasticity dissipates
                                  [force/length]; steady only, otherwise NAN */
    double lever_power;        /* power per unit speed that the lever arms of wheels supply, so that
                                  -xi Q + M/R + lever_power = dissipation + hysteresis
                                  [force/length]; 0 for half-planes; steady only */
    double torque_a;           /* M + Q R_A: external torque on A's axle [force]; > 0: in the
                                  direction in which A rolls, so it drives A; NAN in static */
    double torque_b;           /* M - Q R_B: the same for B; NAN also if B is a plane */
    double strain_energy;      /* of both bodies per unit thickness, from w_N = w_T = 0 [force];
                                  NAN for viscoelastic bodies and for an interface that yields */
    double max_strain;         /* compression of a layer, cover or rim divided by its thickness, the
                                  larger value of both bodies; for bodies without one a/(2R) */
    double max_temperature;    /* maximum in the contact; this and the next two are NAN if
                                  the case has no heat conduction */
    double max_temperature_at; /* [length] */
    double peclet;             /* V a/(2 diffusivity of A), a the half-width */
    double kappa; /* (F3) for a friction law that depends on the state; above 1 there may
                     be several solutions; otherwise NAN */
    double seconds_assembly, seconds_factor, seconds_condense, seconds_lcp, seconds_total;
} rb_rolling_solution;

void rb_rolling_solution_free(rb_rolling_solution *s);

/* ---- The results by name ----------------------------------------------------------- */

typedef enum {
    RB_RESULT_NUMBER,
    RB_RESULT_WHOLE,  /* int */
    RB_RESULT_SECONDS /* a number: time spent on it */
} rb_rolling_result_kind;

/* The scale of a result with an error bar; its rounding error is proportional to this
 * scale. */
typedef enum {
    RB_SCALE_NONE,
    RB_SCALE_ONE,
    RB_SCALE_LOAD,     /* P */
    RB_SCALE_FRICTION, /* mu P */
    RB_SCALE_APPROACH,
    RB_SCALE_SHIFT,    /* mu a^2/R */
    RB_SCALE_CREEPAGE, /* mu a/R */
    RB_SCALE_WIDTH,    /* a */
    RB_SCALE_ELEMENT,  /* length of an element */
    RB_SCALE_PRESSURE, /* p0 */
    RB_SCALE_POWER,    /* mu P times the creepage */
    RB_SCALE_MOMENT,   /* P a */
    RB_SCALE_TORQUE,   /* P a and mu P R */
    RB_SCALE_STRAIN,   /* a/R */
    RB_SCALE_WORK,     /* P a/R */
    RB_SCALE_HEAT      /* rise of the temperature */
} rb_rolling_error_scale;

/* Which cases have a result.  For all other cases a number is NAN, a column is NULL, and
 * reports omit both. */
typedef enum {
    RB_FOR_ALL,
    RB_FOR_HEAT,
    RB_FOR_WORN,
    RB_FOR_LAW,        /* friction coefficients that differ between elements */
    RB_FOR_MOVING_LAW, /* friction coefficients that depend on the state */
    RB_FOR_WAY,        /* friction coefficient from a column of a history */
    RB_FOR_MEMORY,
    RB_FOR_YIELD,
    RB_FOR_CYLINDER_B
} rb_rolling_condition;

/* Description of one result.  Tables, JSON, studies and error bars are made from these
 * rows. */
typedef struct {
    const char *name; /* in JSON */
    const char *unit; /* "mm"; NULL: none */
    rb_rolling_result_kind kind;
    size_t offset; /* of the value, or of the pointer to the column, in its struct */
    rb_rolling_error_scale error_bar; /* RB_SCALE_NONE: no discretisation error is estimated
                                       */
    int study;                        /* number of its column in a study; 0: none */
    int is_mean;       /* in a rolled step: 1: mean over the step, 0: value at its end */
    int no_derivative; /* 1: has no derivative: a residual, or a place known only to
                          within one element */
    rb_rolling_condition condition;
    const char *symbol; /* heads the column instead of the name; NULL: the name */
    const char *meaning;
} rb_rolling_result;

typedef struct {
    int n;
    const rb_rolling_result *row;
} rb_rolling_results;

/* The numbers of rb_rolling_solution, and its columns with one entry per element. */
extern const rb_rolling_results rb_rolling_solution_scalars, rb_rolling_solution_columns;
/* The numbers of rb_rolling_patch. */
extern const rb_rolling_results rb_rolling_patch_scalars;
/* The columns of rb_rolling_history, one entry per step, and of rb_rolling_curve, one
 * entry per creepage. */
extern const rb_rolling_results rb_rolling_history_columns, rb_rolling_curve_columns;
/* The columns of rb_rolling_wear_history, one entry per step. */
extern const rb_rolling_results rb_rolling_wear_columns;
/* The numbers of rb_rolling_stress, and of rb_rolling_stress_maxima: three rows for each
 * maximum, its value and its place. */
extern const rb_rolling_results rb_rolling_stress_scalars, rb_rolling_maxima_scalars;

/* All these tables; an entry without a name ends the list. */
typedef struct {
    const char *name, *title;
    const rb_rolling_results *results;
} rb_rolling_result_table;
extern const rb_rolling_result_table rb_rolling_result_tables[];

/* The row with this name; NULL: there is none. */
const rb_rolling_result *rb_rolling_find_result(const rb_rolling_results *table, const char *name);
/* 1 if the case has this result.  mu_varies: 1: in a history with a column mu. */
int rb_rolling_has_result(const rb_rolling_result *r, const rb_rolling_case *rc, int mu_varies);
/* 1 if the struct `owner` has this column. */
int rb_rolling_has_column(const rb_rolling_result *r, const void *owner);
/* The numbers of a solution without its columns, which remain with it. */
rb_rolling_solution rb_rolling_scalars_of(const rb_rolling_solution *solution);
/* The number, or entry i of the column, as a double; owner: the struct that the table
 * describes. */
double rb_rolling_number(const rb_rolling_result *r, const void *owner);
double rb_rolling_entry(const rb_rolling_result *r, const void *owner, int i);
/* The column itself, of numbers; NULL: the owner has none. */
double *rb_rolling_column(const rb_rolling_result *r, const void *owner);
void rb_rolling_set_number(const rb_rolling_result *r, void *owner, double value);
/* From mm, N, MPa to other units: the numbers, or the columns of so many rows, that have one. */
void rb_rolling_numbers_convert(const rb_rolling_results *table, void *owner, rb_units units);
void rb_rolling_columns_convert(const rb_rolling_results *table, int rows, void *owner,
                                rb_units units);

/* Writes the name with its unit, as in the heads of columns: "max_pressure_MPa".  Returns
 * heading. */
enum { RB_ROLLING_HEADING = 40 };
const char *rb_rolling_heading(const rb_rolling_result *r, rb_units units,
                               char heading[RB_ROLLING_HEADING]);

/* Column k = 1, 2, ... of a study; NULL after the last one. */
const rb_rolling_result *rb_rolling_study_column(int k);

/* Friction power per area and unit speed [stress], n values with sum power h =
 * dissipation; wear laws use it.  In steady rolling the slip is known between midpoints,
 * and half of it is assigned to each of the two elements (theory.md 6).  NAN in
 * static. */
void rb_rolling_friction_power(const rb_rolling_solution *s, double *power);

/* Notes on results that must be read with care, one line each, every one of which the state
 * as solved bears out (src/rolling/solve/notes.c). */
enum { RB_ROLLING_NOTES = 48, RB_ROLLING_NOTE_LENGTH = 320 };
typedef struct {
    int n;
    int kind[RB_ROLLING_NOTES]; /* which note, see rb_rolling_note_name */
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
} rb_rolling_note_list;
rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s);
/* "static-creepage", ... of kind k = 0, 1, ...; NULL after the last one. */
const char *rb_rolling_note_name(int k);

/* The notes on one row of a curve or a study: the first few of them. */
enum { RB_ROLLING_ROW_NOTES = 6 };
typedef struct {
    int n, kind[RB_ROLLING_ROW_NOTES];
    char text[RB_ROLLING_ROW_NOTES][RB_ROLLING_NOTE_LENGTH];
} rb_rolling_row_notes;
/* Those of a solved case in the units of the solution, but for those on columns of its table. */
rb_rolling_row_notes rb_rolling_find_row_notes(const rb_rolling_case *rc,
                                               const rb_rolling_solution *s);
/* One more, of a kind of the caller's from RB_ROLLING_OWN_NOTES on. */
enum { RB_ROLLING_OWN_NOTES = 36 };
void rb_rolling_add_note(rb_rolling_row_notes *notes, int kind, const char *text);
/* The notes on all rows: how many have a note of each kind, the first of them from 0, and what it
 * says of that one. */
typedef struct {
    int rows, count[RB_ROLLING_NOTES], first[RB_ROLLING_NOTES];
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
} rb_rolling_study_notes;
void rb_rolling_add_row_notes(rb_rolling_study_notes *all, int row,
                              const rb_rolling_row_notes *notes);
/* Further rows behind those of `all`. */
void rb_rolling_join_study_notes(rb_rolling_study_notes *all, const rb_rolling_study_notes *more);
/* One line for each kind, with the rows that it is true of; row: "case", "point". */
rb_rolling_note_list rb_rolling_list_study_notes(const rb_rolling_study_notes *all,
                                                 const char *row);
/* 1: the friction power is negative by more than rounding errors, which is an error of
 * the mesh; the text of the note about it. */
int rb_rolling_is_below_zero(double dissipation, double load);
const char *rb_rolling_below_zero(const rb_rolling_case *rc, const rb_rolling_solution *s);

/* Temperature rise at a point of the surface caused by a unit heat flux that enters the
 * body between the distances `from` < `to` upstream of the point (T1), at any Peclet
 * number; conductivity > 0. */
double rb_rolling_heat_response(const rb_rolling_heat *body, double speed, double from, double to);

/* ---- The model of a case -------------------------------------------------------- */

/* State variables of the friction law and of the interface that a step of a history takes
 * over from the step before, besides the displacements. */
typedef struct {
    double *temperature; /* n: of both surfaces after a rolled step; NULL: not computed */
    double *yielded;     /* n: accumulated plastic slip of the interface before the last step, at
                            the places where the particles were then [length]; NULL: zero */
    const double *mu;    /* n: friction coefficients of the particles before the step; NULL:
                            those at rest; borrowed, like heat */
    struct rb_rolling_heat_track *heat; /* heat of the earlier steps; NULL: none */
} rb_rolling_carried;

/* Everything between case and solution, kept for further solves on the same mesh. */
typedef struct rb_rolling_model {
    const rb_rolling_case *rc; /* a constant copy of the case, in a history of the last
                                  step's; borrows the profile; owned */
    rb_rolling_plan plan;      /* of the present mesh and bodies */
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    rb_contact_problem problem;
    rb_contact_state state;
    double shift;       /* in a history: rigid shift of the earlier steps, to be added to the
                           state's [length] */
    int mu_varies;      /* in a history: 1: the program has a column mu */
    int equal_instead;  /* 1: equal elements were used, because fitting the mesh to the
                           contact edges did not converge */
    double row_changes; /* as in rb_rolling_history, like row_changed */
    int row_changed;
    double first_from, first_to; /* ends of the equal elements with which the search for the edges
                                    began; the same value twice: none [length] */
    double half_width;           /* Hertz's half-width of the last computed load; used in the creep
                                    ratio */
    double seconds_lcp;
    int iterations;  /* of all solves so far */
    int follows;     /* 1: friction and creepage are, until the next solve, those of the case
                        on other elements */
    int same_bodies; /* 1: `bodies` need not be built again for `rc` on the same mesh */
    rb_rolling_carried carried;
    struct rb_rolling_conduction *conduction; /* how heat warms these elements, kept from
                                                 round to round of a friction law; NULL: not
                                                 known yet; owned */
    struct rb_rolling_model *freely;          /* solved free rolling of the same case, if it was
                                                 computed on elements of its own; otherwise NULL;
                                                 owned */
} rb_rolling_model;

/* 1 if the mesh has so many equal elements that it is solved by Fourier transforms,
 * without a matrix. */
int rb_rolling_is_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);
/* The same for a build that has Fourier transforms: the page has none, and takes the same
 * elements. */
int rb_rolling_suits_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);

/* Chooses the potential contact (or the fitted mesh), builds the bodies and solves.  On a
 * positive status the model holds the last iterate; RB_ZONE: the contact does not end
 * within the given zone, the wheel or the table.  model: overwritten; free it in any
 * case. */
rb_status rb_rolling_model_create(const rb_rolling_case *rc, rb_rolling_model *model,
                                  rb_message *why);
/* The same by another plan (NULL: that of the case), for a model of zeros, or one that has
 * solved a case which differs at most in friction, load, approach, shift, creepage or
 * force.  Its flexibility is used again if the equal elements have the same ends.  The
 * result is bitwise the same as without it. */
rb_status rb_rolling_model_reuse(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why);
/* Makes an empty model with a copy of the case; mesh and bodies are built later.  plan
 * NULL: that of the case. RB_ENOMEM; model: overwritten. */
rb_status rb_rolling_model_begin(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 rb_rolling_model *model, rb_message *why);
/* Takes ownership of the mesh, builds the bodies on it and solves.  RB_ZONE: solved, and
 * the contact does not end within the mesh. */
rb_status rb_rolling_model_build(rb_rolling_model *model, rb_rolling_mesh *mesh, rb_message *why);
/* Solves the model's problem again and adds to its times and counts; warm: 1 to start
 * from its zones.  RB_ZONE as above.  Every solve on any mesh calls this function. */
rb_status rb_rolling_model_resolve(rb_rolling_model *model, int warm, rb_message *why);
/* The same on the present mesh, from the present zones, after the given load, force or
 * motion of the model's case has changed. */
rb_status rb_rolling_model_control(rb_rolling_model *model, rb_message *why);
/* How many equal elements are used where so many cannot be fitted to the edges of the contact. */
int rb_rolling_equal_elements_instead(int elements);
/* Builds bodies and contact problem on the elements of a result, with a state of zeros,
 * and solves nothing.  plan: NULL: that of the case.  model: all zeros before; free it in
 * any case. */
rb_status rb_rolling_model_of_result(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                     const rb_rolling_elements *elements, rb_rolling_model *model,
                                     rb_message *why);
void rb_rolling_model_free(rb_rolling_model *model);

/* The boundary elements of A or B; n = 0 for half-planes and rigid bodies.  RB_EINVAL,
 * RB_ENOMEM. */
rb_status rb_rolling_boundary_mesh(const rb_rolling_model *model, int of_b, rb_bem_mesh *boundary,
                                   rb_message *why);

/* Forms the matrices of the flexibility and of the problem if the model was solved
 * without them and has fewer than RB_ROLLING_LARGE elements; other models are not
 * changed. RB_ENOMEM. */
rb_status rb_rolling_model_add_matrix(rb_rolling_model *model, rb_message *why);

/* The LCP whose solution is the model's state, or the one that Lemke's method tries
 * first. */
rb_status rb_rolling_model_lcp(const rb_rolling_model *model, rb_contact_lcp *lcp, rb_message *why);

/* Sets the friction coefficients of the model's problem to those that the friction law
 * gives for its state, and likewise a given force; the residual of the state then
 * includes the friction law.  RB_ENOMEM. */
rb_status rb_rolling_model_friction(rb_rolling_model *model, rb_message *why);

/* The case that rolls without a force. */
rb_rolling_case rb_rolling_without_force(const rb_rolling_case *rc);
/* The creepage at which Q = 0 (steady, mu > 0), on the model's mesh.  The model's
 * solution is not changed, but the data that it keeps for further solves is. */
rb_status rb_rolling_free_creepage(rb_rolling_model *model, double *creepage, rb_message *why);

/* P and Q of the state. */
double rb_rolling_model_load(const rb_rolling_model *model);
double rb_rolling_model_force(const rb_rolling_model *model);
/* Q divided by the maximum friction force mu P; NAN without friction or load. */
double rb_rolling_force_ratio(const rb_rolling_model *model);
/* The outer edges of all patches; NAN without contact. */
void rb_rolling_contact_edges(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              const rb_contact_state *state, double *from, double *to);
/* Computes the solution from the state: tractions, slip, zones, forces and their
 * residuals. */
rb_status rb_rolling_model_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                    rb_message *why);
/* The same after a solve that began at `begun` (rb_seconds) and has ended with status s, as far
 * as there is a state; with status and time.  Returns the status of both. */
rb_status rb_rolling_end_solve(const rb_rolling_model *model, rb_status s, double begun,
                               rb_rolling_solution *solution, rb_message *why);
/* The solution without the residuals and temperatures, which stay 0, and the balance of the
 * support, which is NAN. */
rb_status rb_rolling_variant_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                      rb_message *why);
/* Its temperatures, if it has such columns, and the highest.  RB_ENOMEM, RB_SINGULAR. */
rb_status rb_rolling_set_temperature(const rb_rolling_model *model, rb_rolling_solution *solution,
                                     rb_message *why);

/* Highest of the temperatures t of elements in contact, by a parabola through the warmest
 * one and its neighbours, and its place; NAN without contact.  x, zone, t: n. */
void rb_rolling_peak_temperature(int n, const double *x, const int *zone, const double *t,
                                 double *value, double *at);

/* Temperatures of steady rolling from x, h, zone, q, slip and shift of the solution, into
 * t_a and t_b, n each.  conduction: kept from call to call on the same elements, NULL at first;
 * free it with rb_rolling_conduction_free in any case.  RB_ENOMEM, RB_SINGULAR. */
struct rb_rolling_conduction;
void rb_rolling_conduction_free(struct rb_rolling_conduction *conduction);
rb_status rb_rolling_solution_heat(const rb_rolling_case *rc, const rb_rolling_solution *s,
                                   struct rb_rolling_conduction **conduction, double *t_a,
                                   double *t_b, rb_message *why);

/* What the tractions of a solved model displace, kept for all variants of the model; of is
 * borrowed. NULL without memory. */
typedef struct rb_rolling_perturbation rb_rolling_perturbation;
rb_rolling_perturbation *rb_rolling_perturbation_create(const rb_rolling_model *of);
void rb_rolling_perturbation_free(rb_rolling_perturbation *perturbation);

/* A variant of a solved model: a case that differs slightly from the model's in some
 * number, on the same elements, with the model's state and zones, to be completed.  If
 * the flexibility is the same, it is borrowed from the model.  RB_INACCURATE: the number
 * of elements outside the contact differs.  results: 0 if only the equations are needed.
 * own_bodies: 1: the variant has a compressed boundary of its own instead of the model's,
 * so that all variants have it compressed as closely.  perturbation: of the model: where bodies
 * that change leave their flexibility to it, the variant has their change under the tractions of
 * the model alone, which is exact to first order; NULL: they are built.  variant: overwritten; free
 * it in any case. */
rb_status rb_rolling_variant_create(const rb_rolling_model *of, const rb_rolling_case *rc,
                                    int results, int own_bodies,
                                    rb_rolling_perturbation *perturbation,
                                    rb_rolling_model *variant, rb_message *why);
/* 1: such a variant is built with flexibilities of its own. */
int rb_rolling_variant_builds(const rb_rolling_model *of, const rb_rolling_case *rc, int results);
/* A variant with the model's case on elements whose ends x are moved to shift + scale
 * x. */
rb_status rb_rolling_variant_move(const rb_rolling_model *of, rb_rolling_perturbation *perturbation,
                                  double shift, double scale, rb_rolling_model *variant,
                                  rb_message *why);
/* Gap and coefficients of friction on elements moved to shift + scale x, n values each, where the
 * irregularity has come this much further; friction that does not depend on the place alone stays
 * that of the model.  RB_ENOMEM. */
rb_status rb_rolling_variant_data(const rb_rolling_model *of, double shift, double scale,
                                  double further, double *gap, double *bound, rb_message *why);
/* A variant with another case on elements whose ends x are moved to shift + scale x.  The
 * flexibility is computed again if they move or the bodies differ. */
rb_status rb_rolling_variant_place(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   double shift, double scale, rb_rolling_model *variant,
                                   rb_message *why);
/* 1: both cases have the same flexibility. */
int rb_rolling_same_bodies(const rb_rolling_case *x, const rb_rolling_case *y);
/* The bodies of y displace so many times what those of x do, under any tractions: of one elastic
 * material each, they differ in Young's modulus alone, all by this factor.  0: they do not. */
double rb_rolling_softening(const rb_rolling_case *x, const rb_rolling_case *y);
/* A variant that is also solved, starting from the zones of the model. */
rb_status rb_rolling_variant_solve(const rb_rolling_model *of, const rb_rolling_case *rc,
                                   rb_rolling_model *variant, rb_message *why);
/* 1: a variant has as many elements as the model on each side of its wheels, not only as
 * many together: else the flexibility jumps between them. */
int rb_rolling_same_sides(const rb_rolling_model *of, const rb_rolling_model *variant);
/* 1: a boundary of the model is so fine that its matrix is compressed. */
int rb_rolling_is_compressed(const rb_rolling_model *model);
/* The model itself solved again, its boundaries compressed as closely as those of its
 * variants. */
rb_status rb_rolling_variant_closely(const rb_rolling_model *of, rb_rolling_model *variant,
                                     rb_message *why);
/* p0 of the model's state, MPa: the largest peak of all patches; 0 without contact. */
double rb_rolling_peak_pressure(const rb_rolling_model *model);
/* Compression of the layer, cover or rim of A and of B divided by its thickness: of each body
 * that by the approach and that by the pressure, the lesser of which holds; NAN: it has none.
 * max_strain is the larger one of both bodies. */
void rb_rolling_strains(const rb_rolling_case *rc, double approach, double pressure,
                        double strain[4]);
/* The model itself with a matrix of its own, if it has fewer than RB_ROLLING_LARGE
 * elements. */
rb_status rb_rolling_variant_with_matrix(const rb_rolling_model *of, rb_rolling_model *variant,
                                         rb_message *why);
/* What the case of a variant gives at the state of the model, if it differs at most in
 * friction and in given load, motion and force: all else stays, so that no variant is
 * needed.  bound: n, written; problem: overwritten, borrows bound and all rows of the
 * model.  0: the case differs in more. */
int rb_rolling_variant_given(const rb_rolling_model *of, const rb_rolling_case *rc, double *bound,
                             rb_contact_problem *problem, rb_status *status, rb_message *why);
void rb_rolling_variant_free(const rb_rolling_model *of, rb_rolling_model *variant);
/* Sets the state of a variant to that of its model plus `part` times `along` (NULL: 0):
 * p, q, delta and xi; zones are the model's. */
void rb_rolling_variant_set(const rb_contact_state *of, const rb_contact_state *along, double part,
                            rb_contact_state *variant);
/* Computes from them slip (0 in stick), friction coefficients and Hertz's half-width of
 * the variant.  gap, slip: n, of all elements; NULL: not wanted. */
rb_status rb_rolling_variant_complete(rb_rolling_model *variant, double *gap, double *slip,
                                      rb_message *why);

/* kappa (theory.md F3) of the state, for friction that depends on the state.  Above 1 a
 * single element, or a step, may have several solutions.  RB_ENOMEM. */
rb_status rb_rolling_law_kappa(const rb_rolling_model *model, double *kappa);
/* In steady rolling kappa is the largest of those of the elements: that of one, and the element
 * that has the largest; -1: none, or not steady. */
double rb_rolling_law_kappa_of(const rb_rolling_model *model, int element);
int rb_rolling_law_kappa_element(const rb_rolling_model *model);

/* What part of the coefficient that it had before it a particle keeps behind element i, of friction
 * with a memory (theory.md F2). */
double rb_rolling_law_kept(const rb_rolling_model *model, int i);

/* Several solutions of one steady case, ordered by decreasing force. */
typedef struct {
    int n;
    rb_rolling_solution *solution; /* the residual of each is computed; owned */
    int starts, failed; /* starts of the iteration that were tried, and those that did not
                           converge */
} rb_rolling_solutions;

/* Finds different solutions of a steady model with a given creepage under a friction law
 * that depends on the state: the model's solution, and those to which the iteration
 * converges on the model's mesh when slip is assumed behind a given place; up to 200
 * places are tried (theory.md F5).  Solutions to which it does not converge are not
 * found.  The model then holds the last state.  RB_EINVAL: other cases. all: overwritten;
 * free it in any case. */
rb_status rb_rolling_find_solutions(rb_rolling_model *model, rb_rolling_solutions *all,
                                    rb_message *why);
void rb_rolling_solutions_free(rb_rolling_solutions *all);

/* ---- Histories: static increments and transient rolling ---------------------------- */

/* Prescribed quantities of a history, one row per time or distance.  A column replaces
 * the value of the case; with NULL the value of the case applies.  Without distance the
 * rows are increments of a static history.  With distance they are transient rolling:
 * rows at distance 0 are static increments; between the others load, approach and force
 * are linear, and each step has the mean creepage.  mu applies to the whole contact and
 * is linear between rows, too; in a friction law that depends on the state it replaces
 * the mu of the formula; it cannot be combined with a table over x.  Distances must not
 * decrease; their unit is Hertz's half-width of the largest load of the program (or of
 * the static load at its largest approach). Static contact of viscoelastic bodies needs
 * the time [s] of each row, which starts with 0 and must not decrease: between two rows
 * everything is linear in time; two rows at the same time are a jump. */
typedef struct {
    int n;
    const double *distance, *time;
    const double *mu;
    const double *load, *approach;                                   /* at most one */
    const double *shift, *creep, *creep_ratio, *force, *force_ratio; /* at most one */
} rb_rolling_program;                                                /* all borrowed */

/* The columns of a program and their names in tables. */
typedef struct {
    const char *name;
    const char *also; /* other names that people give it, "normal load|P"; NULL: none */
    const char *unit; /* in mm, N, MPa (rollbem/units.h) */
    size_t column;    /* offset of its pointer in rb_rolling_program */
    size_t value;     /* offset in rb_rolling_case of the value that it replaces; distance and
                         time: SIZE_MAX */
    int is_mean;      /* 1: a rolled step uses the mean over the step, 0: the value at its end
                       */
} rb_rolling_program_column;

enum { RB_ROLLING_PROGRAM_COLUMNS = 10 };
extern const rb_rolling_program_column rb_rolling_program_columns[RB_ROLLING_PROGRAM_COLUMNS];

/* The case that results of the program refer to; if the program has a column mu, its mu
 * is the largest value. */
rb_rolling_case rb_rolling_program_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc);

/* One entry per step. */
typedef struct rb_rolling_history {
    int n;
    double *distance; /* rolled, at the end of the step, in half-widths; owned, like all
                         arrays here */
    double *creepage; /* mean over the step; 0 at rest */
    double *shift;    /* rigid shift so far (static steps) [length] */
    double *approach, *normal_load, *tangential_load, *force_ratio;
    double *residual;
    double *max_pressure;              /* p0 [stress]; 0 without contact */
    double *contact_from, *contact_to; /* edges [length]; NAN without contact */
    double *dissipation;               /* power per unit speed [force/length]; 0 at rest */
    double *moment;          /* int x p dx [force]; > 0: the pressure is shifted towards the
                                leading edge */
    int *stick, *slipping;   /* elements */
    int *substeps;           /* in how many steps the row was computed */
    double *step_work;       /* work that friction dissipates in the row [force] */
    double *friction_work;   /* the same so far */
    double *max_temperature; /* at the end of the step; NULL if the case has no heat
                                conduction */
    double *time;            /* at the end of the step [s]; NULL if no body is viscoelastic */
    double *lost_work;       /* energy dissipated by viscoelasticity so far [force]; NULL
                                likewise */
    double *mu;              /* mu of the case at the end of the step; NULL if it is the same in all
                                steps */
    double *torque_a,
        *torque_b;      /* M + Q R_A and M - Q R_B [force]; torque_b: NULL if B is a plane */
    double half_width;  /* unit of the distances [length] */
    double step;        /* of a rolled row [length]; 0 in a static history */
    double row_changes; /* by how much the tractions of a row at rest still depend on its steps,
                           as a part of what the load makes; 0: by no more than 1e-3 */
    int row_changed;    /* that row, counted from 1; 0: none */
    double cycle_work;  /* work of friction in the last cycle [force]; NAN: the rows do not end with
                           a whole cycle */
    int cycle_rows;     /* its rows; 0: likewise */
    int steady_from;    /* first step from which the state is steady until the end, or -1 */
    rb_units units;     /* of all values here */
    struct rb_rolling_history *errors;     /* error bar of every entry; NULL: not computed; owned */
    struct rb_rolling_history *deviations; /* standard deviation of every entry that has
                                              derivatives (rb_case_slopes_of_steps); NULL: not
                                              computed; owned */
} rb_rolling_history;

void rb_rolling_history_free(rb_rolling_history *history);

/* 1: the case, without a program, is a sequence of rolling steps or increments. */
int rb_rolling_has_steps(const rb_rolling_case *rc);

/* Called with the model after every step; a return value other than 0 ends the run. */
typedef int rb_rolling_step(const rb_rolling_model *model, const rb_rolling_history *history,
                            int step, int steps, void *context);

typedef struct {
    rb_rolling_step *step; /* NULL: not called */
    void *context;
} rb_rolling_observer;

/* Computes the steps of the program (NULL: the values of the case; the bodies are pressed
 * at rest in its increments, then rolled over rc->distance).  A transient has rc->steps
 * steps of equal length, or, if that is 0, so many that no step is longer than an
 * element; the last step ends at the last row.  If the contact becomes wider than an
 * automatic zone, the run starts again with step 0 on a wider zone.  observer may be
 * NULL.  model and history are overwritten; they hold the finished steps also on
 * RB_INTERRUPTED and other positive statuses.  model->rc is the case of the last step.
 * Free both in any case. */
rb_status rb_rolling_history_run(const rb_rolling_case *rc, const rb_rolling_program *program,
                                 const rb_rolling_observer *observer, rb_rolling_model *model,
                                 rb_rolling_history *history, rb_message *why);

/* The solutions of the steps of a history: n elements, `steps` states. */
typedef struct {
    const rb_rolling_program
        *program; /* the program of the history; NULL: the values of the case; borrowed */
    int n, steps;
    double *x, *h; /* n: midpoints and lengths [length]; owned, like all arrays here */
    double *p, *q, *lambda, *plastic; /* steps x n, one step after the other; plastic: the part of
                                         lambda that the interface yields */
    int *zone;
    int *substeps;     /* steps: in how many steps the row was computed */
    double *delta;     /* steps: approach */
    double *xi;        /* steps: rigid shift of a static step [length], creepage of a rolled step */
    double half_width; /* unit of the distances [length] */
    double row_changes; /* as in rb_rolling_history, like row_changed */
    int row_changed;
} rb_rolling_states;

/* On RB_ENOMEM states is empty. */
rb_status rb_rolling_states_alloc(int n, int steps, rb_rolling_states *states);
/* Copies the state and the elements of the model after a step into states.  Step 0 begins with
 * new memory for all steps: a run that starts again may have other elements.  RB_ENOMEM. */
rb_status rb_rolling_states_keep(const rb_rolling_model *model, const rb_rolling_history *history,
                                 int step, int steps, rb_rolling_states *states);
/* Copies tractions, slip and its plastic part, zones, delta and xi of a step into a state of as
 * many elements; its status becomes RB_OK. */
void rb_rolling_states_get(const rb_rolling_states *states, int step, rb_contact_state *state);
void rb_rolling_states_free(rb_rolling_states *states);

/* Goes through the program of the given states without solving.  After each step the
 * model has the contact problem of the step, which depends on the earlier states, and the
 * given state with its residual; friction that depends on the state has the coefficients of
 * the given one.  Otherwise like rb_rolling_history_run.  RB_EINVAL: the number of steps
 * differs. */
rb_status rb_rolling_history_follow(const rb_rolling_case *rc, const rb_rolling_states *states,
                                    const rb_rolling_observer *observer, rb_rolling_model *model,
                                    rb_rolling_history *history, rb_message *why);

/* The same step by step, with states that the caller sets: opaque. */
typedef struct rb_rolling_follower rb_rolling_follower;

/* of: another follower, before its first step, whose bodies are borrowed where rc has the
 * same (NULL: none), and which lives longer; scale: of the elements of the states, which
 * are borrowed.  Free it in any case. */
rb_status rb_rolling_follower_create(const rb_rolling_case *rc, const rb_rolling_states *states,
                                     const rb_rolling_follower *of, double scale,
                                     rb_rolling_follower **follower, rb_message *why);
/* The model has the problem of the next step, with the past that the states before it
 * left. */
rb_status rb_rolling_follower_begin(rb_rolling_follower *follower, rb_message *why);
/* 1: the step that has begun is the last one of a row, whose state is among the given ones;
 * 0: it ends inside the row. */
int rb_rolling_follower_ends_row(const rb_rolling_follower *follower);
/* Whose state is to be set between begin and end; borrowed. */
rb_rolling_model *rb_rolling_follower_model(rb_rolling_follower *follower);
/* Solves the step, from the state that the model has, on the elements of the states. */
rb_status rb_rolling_follower_solve(rb_rolling_follower *follower, rb_message *why);
/* Takes the state that the model has, complete, as that of the step. */
void rb_rolling_follower_end(rb_rolling_follower *follower);
/* Of the steps so far; borrowed. */
const rb_rolling_history *rb_rolling_follower_history(const rb_rolling_follower *follower);
void rb_rolling_follower_free(rb_rolling_follower *follower);

/* ---- Wear -------------------------------------------------------------------------- */

typedef enum {
    RB_WEAR_ARCHARD,    /* depth = K int p |ds| */
    RB_WEAR_DISSIPATION /* depth = K int |q| |ds| */
} rb_rolling_wear_law;

/* Wear of A, and of B according to its share.  There are three cases.  Sliding over B
 * towards +x (static, `slides`): B's wear is spread over its track and does not change
 * the gap.  Fretting between the shift or force of the case and its opposite (static):
 * both bodies wear in the contact.  Steady rolling: round bodies stay round, and their
 * radii change. */
typedef struct {
    rb_rolling_wear_law law;
    double coefficient; /* K [1/stress], of both bodies together */
    double share;       /* of B, 0 ... 1 */
    int slides;
    double way;     /* total sliding distance [length], or number of cycles or turns */
    int steps;      /* number of equal steps; each is implicit and stable for any length */
    int increments; /* fretting: number of increments per quarter of a cycle */
} rb_rolling_wear;

/* One entry per step; the first entry is the state before any wear.  Arrays are owned. */
typedef struct {
    int n;
    double *way;       /* sliding distance so far [length], or number of cycles or turns */
    double *worn;      /* volume of A per unit width [length^2] */
    double *max_depth; /* [length] */
    double *radius;    /* of A [length] */
    /* The same of B; NULL if B does not wear, radius_b also if B is a plane.  If A slides
     * or rolls over a plane: the depth of one passage. */
    double *worn_b, *max_depth_b, *radius_b;
    double *work; /* of friction: per sliding or rolling distance [force/length], or per
                     cycle [force] */
    double *approach, *normal_load, *max_pressure, *contact_from, *contact_to;
    double *residual; /* of the contact under the worn gap */
    double radius_before, radius_b_before;
    int slides, rolls; /* both 0: fretting */
    rb_units units;    /* of all values here */
} rb_rolling_wear_history;

void rb_rolling_wear_history_free(rb_rolling_wear_history *history);
/* Converts from mm, N, MPa to other units; call it once only. */
void rb_rolling_wear_history_convert(rb_rolling_wear_history *history, rb_units units);

/* Called with the solution after each step (0: before the first one); the function may
 * convert the solution to other units.  A return value other than 0 ends the run. */
typedef int rb_rolling_wear_step(rb_rolling_solution *solution,
                                 const rb_rolling_wear_history *history, int step, int steps,
                                 void *context);

typedef struct {
    rb_rolling_wear_step *step;
    void *context;
} rb_rolling_wear_observer;

/* Computes wear on a fixed mesh of equal elements; on half-planes elements are added when
 * the wear scar becomes wider than an automatic zone.  last: the solution after the last
 * finished step, with the worn depth as a column.  observer may be NULL.  history and
 * last are overwritten; they hold the finished steps also on RB_INTERRUPTED and other
 * positive statuses.  Free both in any case.  RB_EINVAL: nothing would wear. */
rb_status rb_rolling_wear_run(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                              const rb_rolling_wear_observer *observer,
                              rb_rolling_wear_history *history, rb_rolling_solution *last,
                              rb_message *why);

/* ---- Creep curves ------------------------------------------------------------------ */

/* The variable of a curve. */
typedef enum {
    RB_OVER_CREEP_RATIO,
    RB_OVER_CREEP,
    RB_OVER_SPEED /* viscoelastic bodies only */
} rb_rolling_variable;

typedef struct {
    rb_rolling_variable over;
    double from, to;
    int points;
    rb_units units; /* of what notes say; from and to are in mm */
} rb_rolling_range;

/* One entry per creepage or speed; owned. */
typedef struct rb_rolling_curve {
    int n;
    double *creepage, *creep_ratio, *force_ratio;
    double *tangential_load, *normal_load;
    double *stick_ratio; /* stuck length / length in contact */
    double *yield_ratio; /* the same of the interface that yields; NULL if it cannot */
    double stick_step;   /* largest change of these ratios by one element */
    double *dissipation; /* power per unit speed */
    double *residual;
    double *speed; /* [length/s]; 0 if no speed is given, because no body is viscoelastic */
    double *resistance_moment, *resistance_ratio, *hysteresis; /* as in rb_rolling_solution */
    double *torque_a, *torque_b; /* likewise; torque_b: NULL if B is a plane */
    double *max_temperature;     /* NULL if the case has no heat conduction */
    int *branch;   /* 1: computed in the direction from `from` to `to`, 2: in the opposite
                      direction; NULL if friction does not depend on the state */
    double *kappa; /* as in rb_rolling_solution; NULL likewise */
    int rising;    /* number of points of branch 1, which come first */
    int unsolved;  /* points without a solution: NAN but for what is varied and, if the search for
                      one began, kappa of its end */
    double free_creepage, half_width, seconds;
    int iterations;
    rb_rolling_solution last; /* solution at the last point, for notes, but with the largest kappa
                                 and the smallest dissipation of all points; n = 0: none */
    rb_rolling_study_notes notes;        /* on the points */
    struct rb_rolling_curve *deviations; /* standard deviation of every entry that has
                                            derivatives (rb_case_curve_solve); NULL: not
                                            computed; owned */
    rb_units units;                      /* of all values here */
} rb_rolling_curve;

/* Convert from mm, N, MPa to other units; call them once only.  The field `units` tells
 * the present units. */
void rb_rolling_solution_convert(rb_rolling_solution *s, rb_units units);
void rb_rolling_history_convert(rb_rolling_history *h, rb_units units);
void rb_rolling_curve_convert(rb_rolling_curve *c, rb_units units);

void rb_rolling_curve_free(rb_rolling_curve *curve);

/* Steady rolling at `points` equally spaced creepages or creepage ratios from `from` to
 * `to`, under the load or approach of rc; its given creepage or force is ignored.  All
 * points use one mesh, one factorisation and warm starts; a fitted mesh is fitted again
 * if an edge has moved by more than 1 %.  With RB_OVER_SPEED the points are equally
 * spaced in the logarithm of the speed, creepage or force is that of rc, and every speed
 * has its own mesh and flexibility.  If the friction law depends on the state, the curve
 * is followed to the last creepage and back to the first, each point from the one before:
 * 2 * points entries. */
rb_status rb_rolling_curve_solve(const rb_rolling_case *rc, const rb_rolling_range *range,
                                 rb_rolling_curve *curve, rb_message *why);
/* Sees the model at point k; its refusal ends the curve. */
typedef rb_status rb_rolling_point(const rb_rolling_model *model, int k, void *context,
                                   rb_message *why);
/* The same, watched. */
rb_status rb_rolling_curve_observe(const rb_rolling_case *rc, const rb_rolling_range *range,
                                   rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                                   rb_message *why);

/* ---- Subsurface stress of body A --------------------------------------------------- */

/* Plane strain at one point (x, y), y > 0 inside A; tension positive. */
typedef struct {
    double x, y;                     /* [length] */
    double sxx, syy, szz, sxy;       /* [stress] */
    double principal_1, principal_2; /* in the plane, the larger first */
    double max_shear;                /* in the plane: (principal_1 - principal_2)/2 */
    double tresca_shear;             /* half the largest difference of all three principal
                                        stresses, szz being one of them */
    double von_mises, hydrostatic;   /* hydrostatic = trace/3 */
} rb_rolling_stress;

/* RB_EINVAL: the stress inside A cannot be computed, because A has a viscoelastic cover
 * on an elastic core. */
rb_status rb_rolling_stress_check(const rb_rolling_case *rc, rb_message *why);

/* Stress of a solved model at n points xy (x0, y0, x1, y1, ...).  For a wheel the points
 * must lie inside it or on its surface, for a half-plane at y >= 0.  Otherwise RB_EINVAL;
 * why has the number k of the first such point, counted from 0 as in xy[2k]. */
rb_status rb_rolling_stress_at(const rb_rolling_model *model, int n, const double *xy,
                               rb_rolling_stress *stress, rb_message *why);

/* The tractions p and q of a state, between n + 1 ends along the contact, as nodes between which
 * they are linear (B14): the midpoints of the elements, and close to the edges of patches more of
 * them, where the tractions fall like a power of the distance.  The first and the last node
 * carry nothing.  ends: those of the mesh, or along another line; p, q likewise.  edge_nodes:
 * from an edge on, RB_ROLLING_EDGE_NODES for the stress at the edge itself.  load: in `memory`.
 * RB_ENOMEM. */
enum { RB_ROLLING_EDGE_NODES = 32 };
rb_status rb_rolling_traction_nodes(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                    const struct rb_contact_state *state, const double *ends,
                                    const double *p, const double *q, int edge_nodes,
                                    rb_arena *memory, rb_bem_edge_load *load);

/* Height of A's surface at x: 0 for a half-plane. */
double rb_rolling_surface(const rb_rolling_case *rc, double x);

/* The material of A that a place lies in: on a bond the stress along it jumps. */
typedef enum {
    RB_MATERIAL_BODY,  /* A is of one material */
    RB_MATERIAL_LAYER, /* a layer on a half-plane, the cover of a wheel */
    RB_MATERIAL_BASE   /* the half-plane below the layer */
} rb_rolling_place;

/* "body", "layer", "base". */
const char *rb_rolling_place_name(rb_rolling_place place);

/* Value and place of a maximum. */
typedef struct {
    double value, x, y;
    rb_rolling_place material;
} rb_rolling_extremum;

typedef struct {
    rb_rolling_extremum max_shear, tresca_shear, von_mises;
    rb_rolling_extremum orthogonal_shear; /* largest |sxy| */
    rb_rolling_extremum tension;          /* largest principal stress */
    rb_rolling_extremum compression;      /* the smallest principal stress, with the other sign */
} rb_rolling_stress_maxima;

/* The k-th of them, of which rb_rolling_maxima_scalars has the rows 3k, 3k + 1 and 3k + 2;
 * NULL: there are no more. */
rb_rolling_extremum *rb_rolling_maximum(rb_rolling_stress_maxima *maxima, int k);

/* From mm, N, MPa to other units. */
void rb_rolling_stress_convert(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *maxima,
                               rb_units units);

/* Finds the maxima in all of A: on its surface, along a bond on both sides of it, and
 * inside; or not deeper than `depth` [length], if that is not 0.  At the ends of a clamped
 * arc the stress is infinite: what lies within one element of them is left out. */
rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why);
/* Computes the values again at the places and in the materials given in maxima.  RB_EINVAL:
 * a place lies outside A. */
rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why);

/* inside[k] = 1 if point k lies in A or on its surface, so that rb_rolling_stress_at can
 * compute the stress there.  RB_ENOMEM. */
rb_status rb_rolling_inside(const rb_rolling_model *model, int n, const double *xy, int *inside);

/* Stress on a grid that follows A's surface, row by row; the first row is on the
 * surface. */
typedef struct {
    int nx, ny;
    rb_rolling_stress *at; /* nx x ny; stresses of points that are not inside are NAN; owned */
    int *inside;           /* nx x ny; owned */
} rb_rolling_stress_grid;

/* Shakedown of A, a half-plane under repeated rolling (theory.md S1): the yield stress in
 * shear k at which it just shakes down to elastic behaviour, the place that decides, and
 * the residual stress along x that rolling leaves there. */
typedef struct {
    double shear_yield; /* k [stress]; p0/k is 4 under Hertz's pressure without friction */
    double x, y;
    double residual; /* [stress] */
} rb_rolling_shakedown;

/* RB_EINVAL: a wheel, a layer; RB_NO_CONTACT, RB_ENOMEM. */
rb_status rb_rolling_shakedown_find(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                    rb_message *why);
/* Computes shear_yield and x again from the stress at the depth y and the given residual
 * stress. */
rb_status rb_rolling_shakedown_at(const rb_rolling_model *model, rb_rolling_shakedown *shakedown,
                                  rb_message *why);

/* Computes the stress on a grid over the same width and depth as the maxima; nx, ny >= 2.
 * grid: overwritten. */
rb_status rb_rolling_stress_on_grid(const rb_rolling_model *model, int nx, int ny, double depth,
                                    rb_rolling_stress_grid *grid, rb_message *why);
void rb_rolling_stress_grid_free(rb_rolling_stress_grid *grid);

/* Solves a case on equal elements between from and to; the contact may lie anywhere in
 * between.  Of the mesh options of the case only contact_elements is used.  solution is
 * overwritten; free it in any case. */
rb_status rb_rolling_solve_between(const rb_rolling_case *rc, double from, double to,
                                   rb_rolling_solution *solution, rb_message *why);
/* The same for one step that starts from the tractions, friction coefficients and plastic
 * slip of the solution `before` on the same elements, in mm, N, MPa (NULL: no contact
 * before): rolling by `step` [length] (RB_TRANSIENT), or a shift or load at rest
 * (RB_STATIC, step 0). The iteration of a friction law starts from the coefficients
 * `start` (rb_rolling_plan), or from those before (NULL).  RB_EINVAL: steady rolling,
 * other elements, viscoelastic bodies, or temperatures. */
rb_status rb_rolling_step_between(const rb_rolling_case *rc, double from, double to,
                                  const rb_rolling_solution *before, const rb_rolling_table *start,
                                  double step, rb_rolling_solution *solution, rb_message *why);

/* ---- Error bars (theory.md 5.1) ---------------------------------------------------- */

/* Estimated discretisation errors. */
typedef struct {
    rb_rolling_solution scalar; /* the error of each result with an error bar, in the field of the
                                   result; NAN if the result is NAN in the solution or in a coarser
                                   run, or if there is no estimate; no columns */
    rb_rolling_stress_maxima stress; /* errors of values and places; NAN unless requested */
} rb_rolling_errors;

/* Solves a case and estimates errors from the spread over n/2, 0.7 n and n contact
 * elements, and from the change when wheels have half as many elements outside the
 * contact.  On a positive status the solution holds the last iterate; free it in any
 * case. */
rb_status rb_rolling_solve_with_errors(const rb_rolling_case *rc, rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, rb_message *why);
/* Estimates the errors of a case that is already solved; solution: complete, in mm, N,
 * MPa.  stress: its maxima down to the default depth if error bars for them are wanted,
 * otherwise NULL. */
rb_status rb_rolling_estimate_errors(const rb_rolling_case *rc, const rb_rolling_solution *solution,
                                     const rb_rolling_stress_maxima *stress,
                                     rb_rolling_errors *errors, rb_message *why);

/* Refines contact and boundary until the estimates of P, Q, p0, half-width and creepage
 * are at most `accuracy` relative.  *elements: number of contact elements used at the
 * end; 0: nothing was solved.  With the best estimate: RB_INACCURATE if 6400 contact elements
 * or 64 times the default boundary elements do not suffice, RB_ENOMEM if the memory does not. */
rb_status rb_rolling_solve_to_accuracy(const rb_rolling_case *rc, double accuracy,
                                       rb_rolling_solution *solution, rb_rolling_errors *errors,
                                       int *elements, rb_message *why);

/* The number of coarser runs whose differences are the error bars: 2, with wheels 3. */
int rb_rolling_error_runs(const rb_rolling_case *rc);

/* Computes a curve and its errors: errors->force_ratio[k] and the other columns belong to
 * the k-th creepage; errors->residual has no meaning.  This takes twice as long as the
 * curve alone.  point (may be NULL) also sees the points of the coarser curves.  Free
 * both in any case. */
rb_status rb_rolling_curve_with_errors(const rb_rolling_case *rc, const rb_rolling_range *range,
                                       rb_rolling_point *point, void *context,
                                       rb_rolling_curve *curve, rb_rolling_curve *errors,
                                       rb_message *why);

/* Computes a history with history->errors (their residual has no meaning).  The coarser
 * runs also have longer steps, so that the errors include those of the step length.
 * After the main run the observer is called for the coarser runs with model and history
 * NULL.  Free model and history in any case. */
rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         const rb_rolling_observer *observer,
                                         rb_rolling_model *model, rb_rolling_history *history,
                                         rb_message *why);

/* Solves a case in one call; of a case with several steps the solution is that of the
 * last step.  On a positive status it holds the last iterate.  solution is overwritten;
 * free it in any case. */
rb_status rb_rolling_solve(const rb_rolling_case *rc, rb_rolling_solution *solution,
                           rb_message *why);

/* Peak memory in bytes that rb_rolling_solve needs; serves to refuse sizes that are too
 * large.  n: contact elements; boundary: boundary elements of one wheel (0: half-planes);
 * unknowns: size of Newton's last linear system, elements in contact plus sticking
 * elements, at most 2n. */
double rb_rolling_bytes(const rb_rolling_case *rc, int n, int boundary, int unknowns);

/* The same as rb_rolling_solve, but the model is kept for stresses or further solves;
 * free both in any case. */
rb_status rb_rolling_solve_model(const rb_rolling_case *rc, rb_rolling_model *model,
                                 rb_rolling_solution *solution, rb_message *why);
/* The same for a model that has been solved before, see rb_rolling_model_reuse. */
rb_status rb_rolling_solve_model_reuse(const rb_rolling_case *rc, rb_rolling_model *model,
                                       rb_rolling_solution *solution, rb_message *why);

/* ---- Parameter studies ----------------------------------------------------------- */

enum { RB_ROW_OWN = 128 };

/* The results of one case of a study: numbers only, no columns; NAN if a case has no such
 * result. */
typedef struct {
    rb_rolling_solution solution;    /* with the status of the case */
    rb_rolling_errors errors;        /* NAN without RB_ROW_ERRORS */
    rb_rolling_stress_maxima stress; /* NAN without RB_ROW_STRESS */
    double own[RB_ROW_OWN];          /* values computed by `measure` of the sweep; otherwise NAN */
    rb_rolling_row_notes notes;      /* in the units of the sweep */
} rb_rolling_row;

enum { RB_ROW_ERRORS = 1, RB_ROW_STRESS = 2 }; /* bits of rb_rolling_sweep.also */

/* From mm, N, MPa to other units. */
void rb_rolling_row_convert(rb_rolling_row *row, rb_units units);

/* A study of the cases first ... first + count - 1, solved by processes of this machine
 * (0: as many as it has processors), one thread each.  `make` makes case k and `measure`
 * computes row->own; both run in these processes.  `see` and `tick` run in the calling
 * process: `see` receives the rows in order, `tick` is called every few milliseconds with
 * the number of rows passed to `see`; a return value other than 0 ends the study.  A
 * process that crashes is replaced and its case is tried once more; if it crashes again,
 * the case gets RB_ENOMEM. */
typedef struct {
    int first, count, workers;
    unsigned also;  /* what to compute besides the solution: bits RB_ROW_... */
    rb_units units; /* of what notes say */
    rb_status (*make)(int k, rb_rolling_case *rc, void *context);
    /* own: row->own of the case that `make` made last; model: its solved model; may be
     * NULL */
    rb_status (*measure)(const rb_rolling_model *model, double *own, void *context,
                         rb_message *why);
    /* NULL, or in the place of all that: solves case k, of which row has no numbers yet,
     * and returns its status */
    rb_status (*solve)(int k, rb_rolling_row *row, void *context, rb_message *why);
    int (*see)(int k, const rb_rolling_row *row, void *context);
    int (*tick)(int seen, void *context); /* or NULL */
    void *context;
} rb_rolling_sweep;

/* Solves case k in the calling process in the same way as a process of the study does.
 * why: the reason if the case is not solved, see row->solution.status. */
void rb_rolling_sweep_case(const rb_rolling_sweep *sweep, int k, rb_rolling_row *row,
                           rb_message *why);
/* Runs the study.  RB_INTERRUPTED: `see` or `tick` ended it.  In any case no process is
 * left running. */
rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why);

/* A pool of worker processes, as seen by the process that distributes the cases. */
typedef struct rb_rolling_pool {
    int (*idle)(
        struct rb_rolling_pool *pool); /* number of further cases that the pool accepts now */
    rb_status (*submit)(struct rb_rolling_pool *pool,
                        int k); /* submits case k; idle() must be > 0 */
    /* 1: case *k is done, and row is written; 0: no case was done within the given
     * milliseconds; a negative status: the pool has failed. */
    int (*collect)(struct rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row);
    void (*stop)(struct rb_rolling_pool *pool); /* ends all processes at once and frees the pool */
} rb_rolling_pool;

/* Starts the pool of rb_rolling_sweep_run: sweep->workers processes, at most
 * sweep->count.  sweep is borrowed. */
rb_status rb_rolling_pool_start(const rb_rolling_sweep *sweep, rb_rolling_pool **pool,
                                rb_message *why);
/* The same as rb_rolling_sweep_run with a given pool; the pool is stopped in any case. */
rb_status rb_rolling_sweep_by(const rb_rolling_sweep *sweep, rb_rolling_pool *pool,
                              rb_message *why);

RB_PUBLIC_END

#endif
