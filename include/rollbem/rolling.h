/* Rolling contact in two dimensions: case -> contact mesh -> flexibility -> LCP -> solver ->
 * solution.  Each arrow is a function that takes the structs before it and fills the next one, so
 * that a program can call each step alone and look at its result.  Words make the case (case.h),
 * and api.h has curves, wear and studies.
 * Conventions (theory.md 2): A rolls towards +x, material passes the contact from +x to -x; a
 * creepage xi > 0 means a braked wheel: A's surface slides towards +x over the ground, the friction
 * on A points to -x, and Q < 0.  Loads are per unit length (plane strain).  Equation tags
 * (K1) ... (K6): docs/theory.md. */
#ifndef ROLLBEM_ROLLING_H
#define ROLLBEM_ROLLING_H

#include "rollbem/base.h"
#include "rollbem/bem.h"
#include "rollbem/contact.h"

RB_PUBLIC_BEGIN

/* ---- Case ------------------------------------------------------------------------ */

typedef enum { RB_STATIC, RB_STEADY, RB_TRANSIENT } rb_rolling_formulation;
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

/* Hertz's ellipse: semi-axes along and across the rolling direction, largest pressure, approach,
 * and the radius of a cylinder that has this a and this pressure, which is not the rolling radius.
 */
typedef struct {
    double a, b, pressure, approach, radius; /* radius 0: not found */
} rb_rolling_ellipse;

/* All inputs of one case; opaque.  rb_case_rolling (case.h) makes it from words. */
typedef struct rb_rolling_case rb_rolling_case;

/* Quantities that follow from a case without solving it. */
typedef struct {
    double radius;     /* 1/R = 1/R_A + 1/R_B [length] */
    double modulus;    /* E* [stress] */
    double dundurs;    /* beta [-] */
    double load;       /* given, or computed from the given half-width; NAN: the approach is
                          given */
    double approach;   /* given, or R/2; NAN: the load is given */
    double half_width; /* a: of the contact under the load by formula, or an estimate from the
                          approach */
    double stress;     /* the scale of the tractions: E* a/(2R), Hertz's p0, or 2P/(pi a) */
    double strain;     /* the scale of strains and creepages: a/R, or 2 stress/E* of a gap without
                          a radius */
} rb_rolling_derived;
rb_rolling_derived rb_rolling_derive(const rb_rolling_case *rc);

/* ---- Case -> contact mesh -> flexibility ------------------------------------------- */

/* How a case is discretised, and where its solution begins.  A search for the mesh varies
 * these values and leaves the case unchanged.  NULL: what the case says. */
typedef struct {
    int elements; /* in the potential contact, or across that of a fitted mesh */
    rb_rolling_near_field near_field;
    int outer_elements;
    double outer_refinement; /* all four: the options contact-elements, near-field, ... */
    /* First coefficients of the iteration of a friction law; NULL: those at rest.  A law
     * that falls steeply has several solutions (kappa > 1), and the iteration then finds
     * one close to its start. */
    const struct rb_rolling_table *start; /* borrowed */
    double compression; /* relative tolerance of a hierarchical matrix; usual: INFINITY */
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

/* The bodies of a case on a contact mesh.  The factorised systems are kept for later solves. */
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
    int changed;    /* the row whose tractions still depend on its steps */
    double changes; /* by how much, as a part of what the load makes */
    int jumped;     /* the first row in which the contact jumps to full sliding (F6) */
    double jump_shift, jump_force; /* before the jump [length], [force/length] */
    int not_unique; /* the first row but the last whose shift or creepage is any of a range */
} rb_rolling_rows;

enum { RB_LEFT_BOUNDED = 1, RB_RIGHT_BOUNDED = 2 };

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
    double accuracy_elements, accuracy_boundary; /* contact_elements, outer_refinement by which
                                 an accuracy came; NAN: of none, of half-planes */
    int hierarchical;                            /* 1: a boundary element matrix was hierarchical */
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
     * whole of it; and of alike bodies with the slope of Kalker's C11 [force]; otherwise NAN */
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
    double hertz_half_width;         /* half_width of rb_rolling_derived under the load P; used in
                                        creep_ratio; NAN: the gap has no radius */
    double creep_ratio, force_ratio; /* xi R/(mu a), Q/(mu P); NAN at mu = 0 */
    double half_width;               /* of the contact, from edge to edge [length] */
    double datum;                    /* of A; NAN where it has none [length] */
    double contact_from, contact_to; /* outermost edges (theory-solvers.md 5.1) */
    double nip_width;                /* contact_to - contact_from [length] */
    int edges_bounded;               /* 1: some edge of some patch is only known to an element */
    int equal_instead;               /* 1: equal elements were used, because fitting the mesh to the
                                        contact edges did not converge */
    rb_rolling_rows rows;            /* of its history */
    int stick_edge;      /* of wear, 1: a part of the contact sticks in every cycle and wears
                            nothing; at its edge the pressure grows without bound */
    double max_pressure; /* p0 [stress] */
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

/* ---- The model of a case -------------------------------------------------------- */

/* Private: what a step of a history takes over from the step before, besides displacements. */
typedef struct {
    double *temperature, *yielded;
    const double *mu;
    struct rb_rolling_heat_track *heat;
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
    int equal_instead;    /* 1: equal elements were used, because fitting the mesh to the
                             contact edges did not converge */
    rb_rolling_rows rows; /* of its history */
    double half_width; /* Hertz's half-width of the last computed load; used in the creep ratio */
    double seconds_lcp;
    int iterations; /* of all solves so far */
    /* private: what further solves and steps take over */
    unsigned varies;
    double first_from, first_to;
    int follows, same_bodies;
    rb_rolling_carried carried;
    struct rb_rolling_conduction *conduction;
    struct rb_rolling_cycle *cycle;
    struct rb_rolling_given *given;
    struct rb_rolling_far_field *far;
    struct rb_rolling_model *freely;
} rb_rolling_model;

/* Chooses the potential contact (or the fitted mesh), builds the bodies and solves.  On a positive
 * status the model holds the last iterate; RB_ZONE: the contact does not end within the given zone,
 * the wheel or the table.  model: overwritten; free it in any case. */
rb_status rb_rolling_model_create(const rb_rolling_case *rc, rb_rolling_model *model,
                                  rb_message *why);

void rb_rolling_model_free(rb_rolling_model *model);

/* The LCP whose solution is the model's state, or the one that Lemke's method tries first. */
rb_status rb_rolling_model_lcp(const rb_rolling_model *model, rb_contact_lcp *lcp, rb_message *why);

/* Computes the solution from the state: tractions, slip, zones, forces and their residuals. */
rb_status rb_rolling_model_solution(const rb_rolling_model *model, rb_rolling_solution *solution,
                                    rb_message *why);

/* ---- Histories: static increments and transient rolling ---------------------------- */

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
    double *halved_work;     /* by how much step_work differs from that in half as many steps, of a
                                row at rest that was computed in both; else 0 */
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
                                              derivatives; NULL: not computed; owned */
} rb_rolling_history;

/* Called with the model after every step; a return value other than 0 ends the run. */
typedef int rb_rolling_step(const rb_rolling_model *model, const rb_rolling_history *history,
                            int step, int steps, void *context);

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

/* Finds the maxima in all of A: on its surface, along a bond on both sides of it, and inside; or
 * not deeper than `depth` [length], if that is not 0.  At the ends of a clamped arc the stress is
 * infinite: what lies within one element of them is left out.  Free the maxima in any case. */
rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why);

/* ---- Error bars (theory-solvers.md 5.1) ---------------------------------------------------- */

/* Estimated discretisation errors. */
typedef struct {
    rb_rolling_solution scalar; /* the error of each result with an error bar, in the field of the
                                   result; NAN if the result is NAN in the solution or in a coarser
                                   run, or if there is no estimate; no columns */
    rb_rolling_stress_maxima stress, stress_b; /* errors of values and places in A and in B; NAN
                                                  unless requested */
} rb_rolling_errors;

/* Solves a case in one call; of a case with several steps the solution is that of the last step.
 * On a positive status it holds the last iterate.  solution is overwritten; free it in any case. */
rb_status rb_rolling_solve(const rb_rolling_case *rc, rb_rolling_solution *solution,
                           rb_message *why);

RB_PUBLIC_END

#endif
