/* The discrete frictional contact problem of two surfaces and its solvers: Lemke's
 * method, Newton's method, or a cone solver of the caller.  The wheel and the formulation
 * (static, steady, transient) do not appear here: an operator gives the displacements due
 * to tractions, and arrays give the motion of the surfaces.  Equation tags (K1) ... (K6):
 * docs/theory.md.  Only one thread at a time may use an operator. */
#ifndef ROLLBEM_CONTACT_H
#define ROLLBEM_CONTACT_H

#include "rollbem/base.h"
#include "rollbem/lcp.h"

RB_PUBLIC_BEGIN

/* ---- The operator: displacements due to tractions ---------------------------------- */

/* The operator gives the gaps F_N r and slips S r, S = A F_T (K2), of tractions r = (r_N,
 * r_T) on n elements; opaque. */
typedef struct rb_contact_operator rb_contact_operator;

/* An operator with matrices, which every solver accepts.  F: the n rows of the gaps, 2n columns,
 * leading dimension ldf, borrowed.  S: n x 2n; the function takes ownership of it, also on failure.
 * RB_ENOMEM. */
rb_status rb_contact_operator_dense(int n, const double *F, int ldf, double *S,
                                    rb_contact_operator **op);

/* Like all functions that free something, this one accepts NULL. */
void rb_contact_operator_free(rb_contact_operator *op);

struct rb_contact_state;

/* ---- The problem ------------------------------------------------------------------- */

typedef void rb_contact_newton_trace(const struct rb_contact_state *state, void *context);

/* Gap (K1): y_N = d_N + F_N (r_N, r_T) - delta >= 0, complementary to r_N.
 * Slip (K2): T_T lambda = d_T + S (r_N, r_T) + xi e_T.
 * Forces: P = load_N'r_N + load_T'r_T, Q = force_N'r_N + force_T'r_T.
 * Moment of the load about x = 0: M = moment_N'r_N + moment_T'r_T.
 * xi: the creepage, or the rigid shift of a contact at rest. */
typedef struct {
    int n;
    rb_contact_operator *op; /* owned, like the arrays; copies of the struct share them */
    double *bound;           /* n: friction coefficient of each element, |r_T| <= bound r_N */
    double mu;               /* largest of the bounds; scale of friction */
    double *d_N, *d_T;       /* n [length] */
    double *e_T;             /* n: [length] per unit of xi */
    double *load_N, *load_T, *force_N, *force_T; /* n [length] */
    double *moment_N, *moment_T;                 /* n [length^2] */

    int load_given;  /* 1: P = load, delta is an unknown; 0: delta is given */
    int force_given; /* 1: Q = force + force_ratio times the maximum friction force (mu P
                        for one coefficient), xi is an unknown; 0: xi is given */
    double load, delta, force, force_ratio, xi;
    double axle; /* free axle (V4): 1/R_A, and the given force is the value above minus
                    axle M; otherwise 0 [1/length] */

    /* A plastic layer between the surfaces (Y1): |r_T| <= max(0, yield + hardening u) on each
     * element.  u_i = recall[0] u_i+1 + recall[1] u_i+2 + own |plastic_i| is the plastic slip
     * accumulated in this problem; the plastic slip is a part of the slip T_T lambda. */
    double *yield;         /* n [stress]: the bound at u = 0; owned; NULL: no plastic layer */
    double hardening;      /* [stress/length]; < 0: softening */
    double recall[2], own; /* u is transported with the material: 1, 0, 1 to first order,
                              4/3, -1/3, 2/3 to second order; 0, 0, 1: no transport */

    int differences; /* 1: slips are differences between neighbouring elements; 0:
                        displacements */
    double stress, gap_length, slip_length; /* scales of r, y_N, lambda (4.4) */
    double rounding; /* rounding error of the scaled residual with products, where
                        differences of neighbouring gaps are small compared with the
                        displacements; 0 with matrices */
    double sliding;  /* > 0: an |xi| at which the whole contact slides; searches start there */
    int step_limit;  /* > 0: steps after which a problem without a matrix is given up */
    const char *force_unit; /* printed after forces in error messages; NULL: none */

    /* Called in each step of Newton's method, before the zones are corrected, with the
     * zones and the tractions that follow from them; NULL: not called. */
    rb_contact_newton_trace *trace;
    /* Called after every pivot of Lemke's method; pivot->attempt is 0 for the pivoted
     * form, 1 for its mirror image, 2 for Kwak's form; NULL: not called. */
    rb_lcp_trace *pivot_trace;
    int trace_tableau;   /* 1: pass the whole tableau to pivot_trace */
    void *trace_context; /* of both; borrowed */
} rb_contact_problem;

/* Allocates the arrays, all zero, for the elements of the operator.  The problem takes
 * ownership of the operator, also on failure.  RB_ENOMEM. */
rb_status rb_contact_problem_alloc(rb_contact_operator *op, rb_contact_problem *problem);

void rb_contact_problem_free(rb_contact_problem *problem);

/* One coefficient of friction for all elements (bound NULL), or one for each: n values between 0
 * and mu, which are copied.  May also be called between two solves; warm starts remain valid. */
void rb_contact_set_friction(rb_contact_problem *problem, double mu, const double *bound);

/* ---- The state: unknowns of a problem ---------------------------------------------- */

typedef enum {
    RB_SOLVER_AUTO,
    RB_SOLVER_LEMKE,
    RB_SOLVER_NEWTON,
    RB_SOLVER_CONE /* a cone solver that the caller passes in the options */
} rb_contact_solver;

typedef enum { RB_LCP_PIVOTED, RB_LCP_KWAK } rb_contact_lcp_form;

typedef enum {
    RB_ZONE_SEPARATED = 0,
    RB_ZONE_STICK = 1,
    RB_ZONE_SLIP_NEGATIVE = 2,  /* r_T = -mu r_N: A's surface slides towards +x */
    RB_ZONE_SLIP_POSITIVE = 3,  /* r_T = +mu r_N */
    RB_ZONE_YIELD_NEGATIVE = 4, /* r_T = -(yield + hardening u): the layer yields */
    RB_ZONE_YIELD_POSITIVE = 5  /* r_T = +(yield + hardening u) */
} rb_contact_zone;

typedef struct rb_contact_state {
    int n;
    double *p, *q, *lambda; /* r_N, r_T, T_T lambda; owned */
    double *plastic;        /* plastic part of lambda; owned */
    int *zone;              /* rb_contact_zone; owned */
    double delta, xi;
    rb_status status;
    rb_contact_solver solver;
    rb_contact_lcp_form lcp_form;
    int mirrored; /* this and xi0: as in rb_contact_lcp, of the LCP that was solved */
    double xi0;
    int iterations;
    double residual;
    double refused_at; /* creepage, or shift, of the largest force where the given one is more
                          than that; otherwise 0 */
} rb_contact_state;

/* What is proved of a state (docs/proof.md): the discrete problem has a solution with these
 * zones.  Bounds and distances as parts of the largest pressure. */
enum { RB_CONTACT_UNDECIDED = 8 };
typedef struct {
    int asked, proved;       /* asked 0: no proof was tried */
    const char *reason;      /* why not; static text */
    char where[32];          /* the condition that is not proved, such as gap[17]; "": none */
    double bound_p, bound_q; /* of p and q as computed again by the proof */
    double stored_within;    /* of the state's own p and q */
    int undecided;           /* elements whose zone is open: two zones meet there to rounding */
    int element[RB_CONTACT_UNDECIDED]; /* the first of them, from 1 */
    int isolated;  /* no other solution has nearly the same tractions, gaps and slips */
    double nearby; /* p and q solve a problem exactly whose data, coefficients of friction included,
                      differ by at most this part */
    double margin, norm; /* as of rb_lcp_proof */
    /* Whether the tractions are proved to be the only ones for these coefficients of friction:
     * "frictionless", "uncoupled", "energy", "at its creepage" (of which there may be another for
     * the force), "pressure" (p alone), "not shown"; NULL: no proof was tried */
    const char *unique;
    int steps, steps_proved; /* of a case with steps; 0: none */
} rb_contact_proof;

rb_status rb_contact_state_alloc(int n, rb_contact_state *state);
void rb_contact_state_free(rb_contact_state *state);

/* Largest violations of (K1)-(K3) and of the given load and force, recomputed from p, q,
 * delta and xi alone. */
typedef struct {
    double scaled;    /* natural residual of the scaled problem (4.4) */
    double gap, slip; /* [length] */
    double friction;  /* [stress] */
} rb_contact_violation;

rb_status rb_contact_residual(const rb_contact_problem *problem, const rb_contact_state *state,
                              rb_contact_violation *violation);

/* ---- The LCP (K4, K5, K6) ---------------------------------------------------------- */

/* The scaled LCP: M z + b >= 0 complementary to z >= 0; the physical unknown is z_scale_j
 * z_j.  Size 3n, or 5n with a plastic layer (Y1), plus one row for a given load and one
 * for a given force (K6). */
typedef struct {
    int size;
    double *M, *b;             /* size x size column-major, size */
    double *z_scale, *w_scale; /* size */
    rb_contact_lcp_form form;
    int yields;         /* 1: after the first 3n unknowns follow plastic slips and distances to
                           the yield stress */
    int mirrored;       /* pivoted form: unknowns (gamma-, lambda+) instead of (gamma+, lambda-)
                         */
    double delta0, xi0; /* values of delta and xi at which the unknowns of the borders are 0 (K6) */
    rb_arena memory;    /* of the arrays */
} rb_contact_lcp;

/* RB_EINVAL: the operator has no matrices; RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_lcp_create(const rb_contact_problem *problem, rb_contact_lcp_form form,
                                int mirrored, double xi0, rb_contact_lcp *lcp, rb_message *why);
void rb_contact_lcp_free(rb_contact_lcp *lcp);
/* Computes p, q, delta and xi from z, then lambda and the zones from the problem. */
void rb_contact_lcp_recover(const rb_contact_problem *problem, const rb_contact_lcp *lcp,
                            const double *z, rb_contact_state *state);

/* ---- Solvers ----------------------------------------------------------------------- */

/* The problem with given delta and xi as a problem on Coulomb's cones: u = W r + q, two
 * numbers [N, T] per element, scaled to order one. */
typedef struct {
    int n;
    double *mu; /* n; owned, as W and q */
    double *W;  /* 2n x 2n column-major */
    double *q;  /* 2n */
} rb_contact_cone;

/* A cone solver: a name, and the function that solves by the method of this name. */
typedef struct {
    const char *name; /* borrowed; NULL: none */
    /* r: 2n, written; the iterations are added to *iterations.  NULL: no solver has this name. */
    rb_status (*solve)(const char *name, const rb_contact_cone *cone, double tol, double *r,
                       int *iterations, rb_message *why);
} rb_contact_cone_solver;

typedef struct {
    rb_contact_solver solver;
    rb_contact_cone_solver cone_solver; /* RB_SOLVER_CONE */
    rb_contact_lcp_form lcp_form;       /* the first one that Lemke tries */
    double tol; /* tolerance of the scaled natural residual; at least problem->rounding is
                   used */
} rb_contact_options;

/* The defaults: RB_SOLVER_AUTO, the pivoted form first, a tolerance of 1e-10. */
rb_contact_options rb_contact_defaults(void);

/* Solves with the chosen solver and, if it fails, with another one; state->solver is the
 * one that succeeded.  warm: 1 to start from the zones of the state. */
rb_status rb_contact_solve(rb_contact_problem *problem, const rb_contact_options *options, int warm,
                           rb_contact_state *state, rb_message *why);

RB_PUBLIC_END

#endif
