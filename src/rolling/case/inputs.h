/* The inputs of a case: bodies, friction, loads, motion, mesh. */
#ifndef ROLLBEM_ROLLING_CASE_INPUTS_H
#define ROLLBEM_ROLLING_CASE_INPUTS_H

#include "bem/boundary.h"
#include "rollbem/rolling.h"

typedef enum { RB_GAP_PARABOLA, RB_GAP_EXACT, RB_GAP_TABLE, RB_GAP_WAVE } rb_rolling_gap;
typedef enum {
    RB_MESH_UNIFORM,
    RB_MESH_FITTED,
    RB_MESH_ALIGNED, /* equal elements whose ends meet both edges of the contact */
    RB_MESH_PUNCH    /* shorter towards both ends of a gap table, at which A ends */
} rb_rolling_mesh_kind;

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
typedef struct rb_rolling_table {
    int n; /* 0: none */
    const double *x, *y;
} rb_rolling_table;

/* A gap that is given by points (body/gap.h); opaque. */
typedef struct rb_rolling_profile rb_rolling_profile;

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

/* All inputs of one case.  Of quantities with the comment "one of" at most one is given;
 * the others are NAN. rb_rolling_case_defaults() is the example of *Addi* (theory.md
 * 7). */
struct rb_rolling_case {
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
};

rb_rolling_case rb_rolling_case_defaults(void);

/* Checks ranges and contradictions.  RB_EINVAL with one line in why. */
rb_status rb_rolling_case_check(const rb_rolling_case *rc, rb_message *why);

#endif
