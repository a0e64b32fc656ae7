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

RB_PUBLIC_BEGIN

/* ---- Case ------------------------------------------------------------------------ */

typedef enum { RB_STATIC, RB_STEADY, RB_TRANSIENT } rb_rolling_formulation;
typedef enum { RB_GAP_PARABOLA, RB_GAP_EXACT, RB_GAP_TABLE, RB_GAP_WAVE } rb_rolling_gap;
typedef enum {
    RB_MESH_UNIFORM,
    RB_MESH_FITTED,
    RB_MESH_ALIGNED, /* equal elements whose ends meet both edges of the contact */
    RB_MESH_PUNCH    /* shorter towards both ends of a gap table, at which A ends */
} rb_rolling_mesh_kind;
/* A of steady rolling (theory.md 4.2): the difference to the element upstream, or the
 * second-order difference of equal elements. */
typedef enum { RB_SLIP_UPSTREAM, RB_SLIP_SECOND } rb_rolling_slip_operator;

/* How displacements of a wheel close to a load are computed: by its boundary elements
 * alone, as in *Addi*, or by the exact solution of a strip load on the half-plane plus
 * boundary elements for the remainder (B10). */
typedef enum {
    RB_NEAR_FIELD_AUTO, /* exact on fitted meshes */
    RB_NEAR_FIELD_PLAIN,
    RB_NEAR_FIELD_EXACT
} rb_rolling_near_field;

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

/* A layer on a smooth base slides on it without friction and does not leave it. */
typedef enum { RB_BASE_BONDED, RB_BASE_SMOOTH } rb_rolling_base;

typedef struct {
    double young, poisson; /* [stress], [-]; of a viscoelastic body the glassy
                              (instantaneous) modulus */
    double radius;         /* [length]; of body B also INFINITY: a plane; < 0: a bore around A */
    rb_bem_support support;
    rb_rolling_base layer_base; /* how a layer is held */
    double arc;                 /* half-angle of the clamped arc [degrees] */
    double hub_ratio;           /* radius of the rigid hub / radius */
    double datum;               /* half-plane: where along it a load moves nothing; 0: 2R/e */
    double strip;               /* homogeneous half-plane: in place of a datum, the width of a strip
                                   of a half-space that rests far away, as in CONTACT; 0: a datum */
    double layer;               /* half-plane: thickness of a layer of this material, bonded to a
                                   base [length]; 0: no layer */
    double base_young, base_poisson; /* of the base; young 0: rigid */
    double cover;                    /* hub: thickness of a cover of this material, bonded to a core
                                        [length]; 0: none */
    double core_young, core_poisson; /* of the core, a ring on the rigid hub; young 0:
                                        everything below the cover is rigid */
    const rb_bem_stack *stack;       /* half-plane: several layers, the first of which has `layer`,
                                        `young` and `poisson`; NULL: one at most; borrowed */
    rb_rolling_memory memory;        /* viscoelasticity of the material; n = 0: elastic */
} rb_rolling_body;

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

void rb_rolling_profile_free(rb_rolling_profile *profile);

/* ---- Friction laws (theory-rolling.md 4.11) ------------------------------------------------ */

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

/* Hertz's ellipse: semi-axes along and across the rolling direction, largest pressure, approach,
 * and the radius of a cylinder that has this a and this pressure, which is not the rolling radius.
 */
typedef struct {
    double a, b, pressure, approach, radius; /* radius 0: not found */
} rb_rolling_ellipse;

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
    /* static, elastic half-planes: gap and tractions repeat themselves along x, and loads are those
     * of one period [length]; 0: one contact alone.  amplitude: of RB_GAP_WAVE, whose gap is
     * D (1 - cos(2 pi x/L)) (theory-rolling.md 4.16). */
    double period, amplitude;
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

    double approach, load, half_width, max_pressure; /* one of; all NAN: approach = R/2 */
    double pressed_by; /* the load that makes the largest pressure max_pressure, where Hertz's
                          formula does not say it (rb_rolling_find_load); otherwise NAN */

    /* Instead of a load per width: the load [force] of a contact that is curved across the rolling
     * direction, too, and these radii (INFINITY: flat; < 0: concave).  The case is the strip
     * through the middle of the ellipse that rb_rolling_find_ellipse finds. */
    double wheel_load, transverse_radius, transverse_radius_b;
    rb_rolling_ellipse ellipse;
    int strips; /* steady: of the ellipse, each solved for its force; 0: none, the closed form of
                   bodies that are alike */

    /* static: one of shift, force, force_ratio loads the contact (all NAN: the shift is a
     * tenth of the given approach, as in *Addi*, or 0 under load control); creep or
     * creep_ratio only enter (12). steady, transient: one of creep, creep_ratio, force,
     * force_ratio. */
    double shift, creep, creep_ratio, force, force_ratio;
    /* Uniform stress along the surface of A and of B, far from the contact and before it [stress],
     * tension > 0: it strains the bodies (theory-rolling.md 4.13).  Half-planes of one elastic
     * material. */
    double bulk_stress, bulk_stress_b;
    /* static, half-planes: A is turned by the tilt, the gap is g0 - tilt x (> 0: lower at +x), or
     * by so much that the pressure has this moment int x p dx [force]; one of, NAN: no moment. */
    double tilt, moment;
    double tilted_by; /* the tilt that makes the moment (rb_rolling_find_tilt); otherwise NAN */
    int free_axle;    /* steady: A's axle is free of torque, Q = -M/R_A (theory-bodies.md V4), and
                         creepage and force are not given */

    rb_rolling_formulation formulation;
    int increments;   /* static, transient: if above 1, the bodies are first pressed and
                         then loaded tangentially, each in this number of increments
                         (theory-solvers.md 5.3) */
    double speed;     /* rolling speed [length/s]; must be > 0 if a rolling body is viscoelastic
                         or conducts heat, or if friction depends on the slip velocity */
    double time_step; /* static program of viscoelastic bodies: longest time step between
                         two rows [s]; 0: one step per row */
    double distance;  /* transient: rolled distance / Hertz half-width */
    int steps;        /* transient */
    int fretting;     /* 1: of a history at rest whose rows end with a cycle, what fretting does to
                         each element in the last one */
    int cycle_from, cycle_to; /* rows, from 1, between whose ends that cycle lies instead; 0: none
                                 are given */

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
 * growing ones outside each edge (theory-solvers.md 5.1). */
rb_status rb_rolling_mesh_fitted(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                 double from, double to, rb_rolling_mesh *mesh, rb_message *why);

void rb_rolling_mesh_free(rb_rolling_mesh *mesh);

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

/* What is to be known of the rows of a history at rest; rows are counted from 1, 0: none. */
typedef struct {
    int changed;       /* the row whose tractions still depend on its steps */
    double changes;    /* by how much, as a part of what the load makes */
    int jumped;        /* the first row in which the contact jumps to full sliding (F6) */
    double jump_shift; /* before the jump [length] */
    double jump_force; /* likewise [force/length] */
} rb_rolling_rows;

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

/* The largest value along the surface, and its x. */
typedef struct {
    double value, at;
} rb_rolling_peak;

/* Work of friction in the last cycle of a history [force], and the largest values of its columns in
 * rb_rolling_solution; that of SWT is also looked for at the edges. */
typedef struct {
    double work;
    rb_rolling_peak fretting_work, slip_range, ruiz_1, ruiz_2, swt, tresca_shear;
    rb_rolling_peak ruiz_2_b, swt_b, tresca_shear_b;
} rb_rolling_fretting;

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
        *temperature_b;      /* of the surfaces; NULL if the case has no heat conduction */
    double *heat_a, *heat_b; /* that enters them per area [stress * length/time]; likewise */
    double *worn;            /* worn depth [length]; NULL if nothing is worn */
    double *mu;              /* friction coefficients; NULL: the same for all elements */
    /* Of the last cycle of a history (theory-rolling.md 4.17), NULL without `fretting`: work of
     * friction [force/length], range of the slip [length], Ruiz's two parameters [force/length],
     * [stress * force/length], largest tension along x, parameter of Smith, Watson and Topper and
     * largest shear of all planes [stress]; those that depend on the body also of B. */
    double *fretting_work, *slip_range, *ruiz_1;
    double *tension, *ruiz_2, *swt, *tresca_shear;
    double *tension_b, *ruiz_2_b, *swt_b, *tresca_shear_b;

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
    rb_rolling_ellipse ellipse;          /* NAN: there is none */
    /* steady, of an ellipse between alike bodies, or by the strips that the case asks for: Q of the
     * whole of it; and of alike bodies with the
     * slope of Kalker's C11 [force]; otherwise NAN */
    double ellipse_force, ellipse_force_kalker;
    /* of layers on smooth bases: the creepage of what is unstrained ahead of the contact, and
     * behind it (L9); NAN: there is none */
    double creepage_ahead, creepage_behind;
    double mean_pressure, contact_share; /* with a period L: P/L [stress], and the part of L in
                                            contact; otherwise NAN */
    double tilt;                         /* of A; NAN: neither tilt nor moment is given */
    double bulk_strain;                  /* of A less that of B; by bulk stress, which may differ
                                            from step to step */
    double largest_bulk_strain;          /* magnitude of the larger of both */
    double creepage, free_creepage;      /* xi; xi at Q = 0 (steady); NAN otherwise, or if no
                                            such xi was found */
    double hertz_half_width;             /* rb_rolling_contact_half_width of the load P; used in
                                            creep_ratio; NAN: the gap has no radius */
    double creep_ratio, force_ratio;     /* xi R/(mu a), Q/(mu P); NAN at mu = 0 */
    double half_width;                   /* of the contact, from edge to edge [length] */
    double datum;                        /* of A; NAN where it has none [length] */
    double contact_from, contact_to;     /* outermost edges (theory-solvers.md 5.1) */
    double nip_width;                    /* contact_to - contact_from [length] */
    int edges_bounded;            /* 1: some edge of some patch is only known to an element */
    int equal_instead;            /* 1: equal elements were used, because fitting the mesh to the
                                     contact edges did not converge */
    rb_rolling_rows rows;         /* of its history */
    int stick_edge;               /* 1: as in rb_rolling_wear_history */
    double max_pressure;          /* p0 [stress] */
    int contact, stick, slipping; /* numbers of elements; slipping includes yielding */
    int yielding; /* number of elements whose interface yields; -1: no yield stress */
    double stick_from,
        stick_to;              /* outermost ends of the sticking elements; NAN if nothing sticks */
    double stick_length;       /* total length of the sticking elements, less than stick_to -
                                  stick_from if some in between slip [length] */
    int slip_violations;       /* number of elements whose slip does not oppose the friction */
    double dissipation;        /* power per unit speed [force/length] */
    double resistance_moment;  /* M = int x p dx [force]; NAN in static without tilt */
    double resistance_ratio;   /* M/(P R), the coefficient of rolling resistance */
    double hysteresis_factor;  /* Tabor's, (3 pi/2) M/(P a), a half the width of the contact; steady
                                  rolling of bodies that relax, otherwise NAN */
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
    double heat_into_a, heat_into_b; /* the heat that enters each body [force/time]; like the next
                                        NAN without heat conduction */
    double heat_share_a; /* heat_into_a over their sum; NAN if the bodies are not equally warm
                            far away */
    double peclet;       /* V a/(2 diffusivity of A), a the half-width */
    rb_rolling_fretting fretting; /* NAN without it */
    double kappa;           /* (F3) for a friction law that depends on the state; above 1 there may
                               be several solutions; otherwise NAN */
    rb_contact_proof proof; /* asked 0: none was asked for */
    double seconds_assembly, seconds_factor, seconds_condense, seconds_lcp, seconds_total;
} rb_rolling_solution;

void rb_rolling_solution_free(rb_rolling_solution *s);

/* ---- The results by name ----------------------------------------------------------- */

/* Notes on results that must be read with care, one line each, every one of which the state
 * as solved bears out (src/rolling/solve/notes.c). */
enum { RB_ROLLING_NOTES = 55, RB_ROLLING_NOTE_LENGTH = 320 };

/* The notes on all rows: how many have a note of each kind, the first of them from 0, and what it
 * says of that one. */
typedef struct {
    int rows, count[RB_ROLLING_NOTES], first[RB_ROLLING_NOTES];
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
} rb_rolling_study_notes;

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
    double shift;         /* in a history: rigid shift of the earlier steps, to be added to the
                             state's [length] */
    unsigned varies;      /* in a history: columns of the program, rb_rolling_program_varies */
    int equal_instead;    /* 1: equal elements were used, because fitting the mesh to the
                             contact edges did not converge */
    rb_rolling_rows rows; /* of its history */
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
    struct rb_rolling_cycle *cycle; /* what fretting has done so far in the last cycle of its
                                       history; NULL: not asked for; owned */
    struct rb_rolling_given *given; /* tractions that were given instead of solved for; NULL: those
                                       of the state; owned */
    struct rb_rolling_far_field *far; /* what the rest of wheels adds, while only the edges of the
                                         contact are searched for; NULL: bodies have systems; owned
                                       */
    struct rb_rolling_model *freely;  /* solved free rolling of the same case, if it was
                                         computed on elements of its own; otherwise NULL;
                                         owned */
} rb_rolling_model;

/* Chooses the potential contact (or the fitted mesh), builds the bodies and solves.  On a
 * positive status the model holds the last iterate; RB_ZONE: the contact does not end
 * within the given zone, the wheel or the table.  model: overwritten; free it in any
 * case. */
rb_status rb_rolling_model_create(const rb_rolling_case *rc, rb_rolling_model *model,
                                  rb_message *why);

void rb_rolling_model_free(rb_rolling_model *model);

/* The LCP whose solution is the model's state, or the one that Lemke's method tries
 * first. */
rb_status rb_rolling_model_lcp(const rb_rolling_model *model, rb_contact_lcp *lcp, rb_message *why);

/* Computes the solution from the state: tractions, slip, zones, forces and their
 * residuals. */
rb_status rb_rolling_model_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                    rb_message *why);

/* Temperatures of steady rolling from x, h, zone, q, slip and shift of the solution, into
 * t_a and t_b, n each.  conduction: kept from call to call on the same elements, NULL at first;
 * free it with rb_rolling_conduction_free in any case.  RB_ENOMEM, RB_SINGULAR. */
struct rb_rolling_conduction;

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
    const double *bulk_stress, *bulk_stress_b, *tilt;
} rb_rolling_program; /* all borrowed */

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
    double *bulk_stress, *bulk_stress_b, *tilt; /* likewise at the end of the step [stress], [-];
                                                   NULL if the program has no such column */
    double *torque_a,
        *torque_b;     /* M + Q R_A and M - Q R_B [force]; torque_b: NULL if B is a plane */
    double half_width; /* unit of the distances [length] */
    double step;       /* of a rolled row [length]; 0 in a static history */
    rb_rolling_rows rows;
    double cycle_work; /* work of friction in the last cycle [force]; NAN: the rows do not end with
                          a whole cycle */
    int cycle_rows;    /* its rows; 0: likewise */
    int steady_from;   /* first step from which the state is steady until the end, or -1 */
    rb_units units;    /* of all values here */
    struct rb_rolling_history *errors;     /* error bar of every entry; NULL: not computed; owned */
    rb_rolling_fretting *cycle_errors;     /* error bars of what the last solution has of the cycle,
                                              without places; NULL: not computed; owned */
    struct rb_rolling_history *deviations; /* standard deviation of every entry that has
                                              derivatives (rb_case_slopes_of_steps); NULL: not
                                              computed; owned */
} rb_rolling_history;

void rb_rolling_history_free(rb_rolling_history *history);

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

/* ---- Wear -------------------------------------------------------------------------- */

typedef enum {
    RB_WEAR_ARCHARD,    /* depth = K int p |ds| */
    RB_WEAR_DISSIPATION /* depth = K int |q| |ds| */
} rb_rolling_wear_law;

/* Wear of A, and of B according to its share.  There are three cases.  Sliding over B
 * towards +x (static, `slides`): B's wear is spread over its track and does not change
 * the gap.  Fretting between the shift or force of the case and its opposite (static):
 * both bodies wear in the contact, and where all of it slides over more than a tenth of the
 * half-width each by its own profile (theory-rolling.md 4.9, W5).  Steady rolling: round bodies
 * stay round, and their radii change. */
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
typedef struct rb_rolling_wear_history {
    int n;
    double *way;       /* sliding distance so far [length], or number of cycles or turns */
    double *worn;      /* volume of A per unit width [length^2] */
    double *max_depth; /* [length] */
    double *radius;    /* of A [length] */
    /* The same of B; NULL if B does not wear, radius_b also if B is a plane.  If A slides
     * or rolls over a plane: the depth of one passage. */
    double *worn_b, *max_depth_b, *radius_b;
    double *work;   /* of friction: per sliding or rolling distance [force/length], or per
                       cycle [force] */
    double *stroke; /* fretting: A slides to -stroke ... stroke over B, mean of the contact
                       [length]; NULL otherwise */
    double *approach, *normal_load, *max_pressure, *contact_from, *contact_to;
    double *residual; /* of the contact under the worn gap */
    double radius_before, radius_b_before;
    int slides, rolls; /* both 0: fretting */
    int positions;     /* along the stroke at which the contact was solved; 0: the stroke is small.
                          Then pressure, contact and the worn depth of the solution, which is that
                          of both bodies, belong to the middle of the stroke. */
    int stick_edge;    /* 1: a part of the contact sticks in every cycle and wears nothing; at its
                          edge the pressure grows without bound */
    rb_units units;    /* of all values here */
    struct rb_rolling_wear_history *errors; /* error bars of the columns that have them; NULL: not
                                               estimated; owned */
} rb_rolling_wear_history;

void rb_rolling_wear_history_free(rb_rolling_wear_history *history);

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
    double *torque_a, *torque_b;                  /* likewise; torque_b: NULL if B is a plane */
    double *max_temperature;                      /* NULL if the case has no heat conduction */
    double *ellipse_force, *ellipse_force_kalker; /* as in rb_rolling_solution; NULL: none */
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
    double temperature;              /* in steady rolling with heat conduction */
} rb_rolling_stress;

/* Stress of a solved model at n points xy (x0, y0, x1, y1, ...).  For a wheel the points
 * must lie inside it or on its surface, for a half-plane at y >= 0.  Otherwise RB_EINVAL;
 * why has the number k of the first such point, counted from 0 as in xy[2k]. */
rb_status rb_rolling_stress_at(const rb_rolling_model *model, int n, const double *xy,
                               rb_rolling_stress *stress, rb_message *why);

/* The material of A that a place lies in: on a bond the stress along it jumps. */
typedef enum {
    RB_MATERIAL_BODY,  /* A is of one material */
    RB_MATERIAL_LAYER, /* a layer on a half-plane, the cover of a wheel */
    RB_MATERIAL_BASE,  /* the half-plane below the layers */
    RB_MATERIAL_FIRST  /* the first of several layers; those below it are numbered on from here */
} rb_rolling_place;

/* Value and place of a maximum. */
typedef struct {
    double value, x, y;
    rb_rolling_place material;
} rb_rolling_extremum;

/* At the bond of a layer, of a cover: largest tension across it, shear along it, and tension along
 * it on either side.  0, without a place: none; NAN: there is no such side, or the search does not
 * go down to it. */
typedef struct {
    rb_rolling_extremum peel, shear, tension_above, tension_below;
} rb_rolling_bond_maxima;

typedef struct {
    rb_rolling_extremum max_shear, tresca_shear, von_mises;
    rb_rolling_extremum orthogonal_shear; /* largest |sxy| */
    rb_rolling_extremum tension;          /* largest principal stress */
    rb_rolling_extremum compression;      /* the smallest principal stress, with the other sign */
    int bonds;                    /* of the layers, or that of a cover, from the surface down */
    rb_rolling_bond_maxima *bond; /* owned */
} rb_rolling_stress_maxima;

void rb_rolling_stress_maxima_free(rb_rolling_stress_maxima *maxima);

/* Finds the maxima in all of A: on its surface, along a bond on both sides of it, and
 * inside; or not deeper than `depth` [length], if that is not 0.  At the ends of a clamped
 * arc the stress is infinite: what lies within one element of them is left out.  Free the maxima in
 * any case. */
rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why);

/* Shakedown of A, a half-plane under repeated rolling (theory-bodies.md S1): the yield stress in
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

/* ---- Error bars (theory-solvers.md 5.1) ---------------------------------------------------- */

/* Estimated discretisation errors. */
typedef struct {
    rb_rolling_solution scalar; /* the error of each result with an error bar, in the field of the
                                   result; NAN if the result is NAN in the solution or in a coarser
                                   run, or if there is no estimate; no columns */
    rb_rolling_stress_maxima stress, stress_b; /* errors of values and places in A and in B; NAN
                                                  unless requested */
} rb_rolling_errors;

/* Solves a case and estimates errors from the spread over n/2, 0.7 n and n contact
 * elements, and from the change when wheels have half as many elements outside the
 * contact.  On a positive status the solution holds the last iterate; free it in any
 * case. */
rb_status rb_rolling_solve_with_errors(const rb_rolling_case *rc, rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, rb_message *why);

/* Refines contact and boundary until the estimates of P, Q, p0, half-width and creepage
 * are at most `accuracy` relative.  *elements: number of contact elements used at the
 * end; 0: nothing was solved.  With the best estimate: RB_INACCURATE if 6400 contact elements
 * or 64 times the default boundary elements do not suffice, RB_ENOMEM if the memory does not. */
rb_status rb_rolling_solve_to_accuracy(const rb_rolling_case *rc, double accuracy,
                                       rb_rolling_solution *solution, rb_rolling_errors *errors,
                                       int *elements, rb_message *why);

/* Solves a case in one call; of a case with several steps the solution is that of the
 * last step.  On a positive status it holds the last iterate.  solution is overwritten;
 * free it in any case. */
rb_status rb_rolling_solve(const rb_rolling_case *rc, rb_rolling_solution *solution,
                           rb_message *why);

RB_PUBLIC_END

#endif
