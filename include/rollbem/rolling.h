/* Rolling contact in two dimensions: case -> contact mesh -> flexibility -> LCP -> solver
 * -> solution.  Each arrow is one public function with one struct in and one out, so that
 * one may stop after any of them and print what is there.
 * Conventions (theory.md 2): A rolls towards +x, material passes the contact from +x to -x;
 * creepage xi > 0 is a braked wheel: A's surface slides towards +x over the ground, the
 * friction on A points to -x, Q < 0.  Loads are per unit length (plane strain).
 * Equation tags (K1) ... (K6): docs/theory.md. */
#ifndef ROLLBEM_ROLLING_H
#define ROLLBEM_ROLLING_H

#include "rollbem/base.h"
#include "rollbem/bem.h"
#include "rollbem/lcp.h"

/* ---- Case ------------------------------------------------------------------------ */

typedef enum { RB_STATIC, RB_STEADY, RB_TRANSIENT } rb_rolling_formulation;
typedef enum { RB_GAP_PARABOLA, RB_GAP_EXACT, RB_GAP_TABLE } rb_rolling_gap;
typedef enum { RB_MESH_UNIFORM, RB_MESH_FITTED } rb_rolling_mesh_kind;
typedef enum { RB_SOLVER_AUTO, RB_SOLVER_LEMKE, RB_SOLVER_NEWTON } rb_rolling_solver;
typedef enum { RB_LCP_PIVOTED, RB_LCP_KWAK } rb_rolling_lcp_form;

typedef struct {
    double young, poisson;  /* [stress], [-] */
    double radius;          /* [length]; INFINITY: a plane (body B only) */
    rb_bem_support support;
    double arc;             /* half-angle of the clamped arc [degrees] */
    double hub_ratio;       /* radius of the rigid hub / radius */
    double datum;           /* half-plane: depth of zero displacement; 0: 2R/e */
} rb_rolling_body;

/* Every input of one case.  Quantities of which "one of" is asked are NAN when not given.
 * rb_rolling_case_defaults() is the example of *Addi* (theory.md 7). */
typedef struct {
    rb_rolling_body a, b;
    int elastic_b; /* 0: B is a rigid plane and b is not read */

    rb_rolling_gap gap;
    int profile_n;                    /* RB_GAP_TABLE: points of the initial gap */
    const double *profile_x, *profile_gap; /* [length]; borrowed */

    double mu;

    double approach, load, half_width; /* one of; all NAN: approach = R/2 */

    /* static: one of shift, force, force_ratio loads the contact (all NAN: shift = R/20 in
     * the default case, 0 otherwise); creep or creep_ratio only enter (12).
     * steady, transient: one of creep, creep_ratio, force, force_ratio. */
    double shift, creep, creep_ratio, force, force_ratio;

    rb_rolling_formulation formulation;
    double distance; /* transient: rolled distance / Hertz half-width */
    int steps;       /* transient */

    rb_rolling_mesh_kind mesh;
    int contact_elements; /* uniform: in the potential contact; fitted: across the contact */
    double zone;          /* half-width of the potential contact [length]; 0: automatic */
    int outer_elements;   /* 0: automatic */
    rb_bem_normals normals;

    rb_rolling_solver solver;
    rb_rolling_lcp_form lcp_form;
    double tol; /* of the scaled natural residual */
} rb_rolling_case;

rb_rolling_case rb_rolling_case_defaults(void);

/* Ranges and contradictions.  RB_EINVAL with one line in why. */
rb_status rb_rolling_case_check(const rb_rolling_case *rc, rb_message *why);

/* ---- Solution -------------------------------------------------------------------- */

typedef enum {
    RB_ZONE_SEPARATED = 0,
    RB_ZONE_STICK = 1,
    RB_ZONE_SLIP_NEGATIVE = 2, /* r_T = -mu r_N: A's surface slides towards +x */
    RB_ZONE_SLIP_POSITIVE = 3  /* r_T = +mu r_N */
} rb_rolling_zone;

typedef struct {
    int n;        /* contact elements, in the order of increasing x */
    double *x, *h; /* midpoints and lengths [length]; owned, as all arrays here */
    double *gap;   /* y_N [length] */
    double *p, *q; /* r_N >= 0 and r_T on A [stress] */
    double *un, *ut; /* w_N, w_T of A (of A and B together where both are elastic) */
    double *shift;   /* T_T lambda [length]; 0 in stick */
    double *slip;    /* relative slip velocity [-]: (12) in static, shift/distance else */
    int *zone;       /* rb_rolling_zone */

    rb_status status;
    rb_rolling_formulation formulation;
    rb_rolling_solver solver; /* that gave the answer */
    rb_rolling_lcp_form lcp_form;
    int iterations;  /* pivots or Newton steps, of all solves */
    double residual; /* natural residual of the scaled problem, recomputed from p, q, shift */
    double residual_gap, residual_slip; /* the physical ones: [length], [length] */
    double residual_friction;           /* [stress] */

    double normal_load, tangential_load; /* P = sum p h, Q = sum q h [force/length] */
    double load_error;                   /* |P - wanted|/wanted; NAN without load control */
    double support_balance;              /* (reaction + load)/P; NAN for half-planes */
    double approach, tangential_shift;   /* delta; rigid shift (static) [length] */
    double creepage, free_creepage;      /* xi; xi at Q = 0 (steady), else NAN */
    double hertz_half_width;             /* of P and the combined radius: scale of the ratios */
    double creep_ratio, force_ratio;     /* xi R/(mu a), Q/(mu P); NAN at mu = 0 */
    double half_width;                   /* where p^2 extrapolates to zero [length] */
    double contact_from, contact_to;     /* its edges */
    double max_pressure;                 /* p0 [stress] */
    int contact, stick, slipping;        /* elements */
    double stick_from, stick_to;         /* element ends; NAN without stick */
    int slip_violations;                 /* slip that does not oppose the friction */
    double dissipation;                  /* power per unit speed [force/length] */
    double seconds_assembly, seconds_factor, seconds_condense, seconds_lcp, seconds_total;
} rb_rolling_solution;

void rb_rolling_solution_free(rb_rolling_solution *s);

/* From case to solution in one call.  On a positive status the solution holds what there
 * is.  solution: overwritten; free it in any case. */
rb_status rb_rolling_solve(const rb_rolling_case *rc, rb_rolling_solution *solution,
                           rb_message *why);

#endif
