/* The discrete frictional contact problem of two surfaces and its solvers: Lemke's
 * method, Newton's method, or a cone solver of the caller.  This header knows no wheel
 * and no formulation: an operator gives the displacements due to tractions, and arrays
 * give the motion of the surfaces.  Equation tags (K1) ... (K6): docs/theory.md.  Only
 * one thread at a time may use an operator. */
#ifndef ROLLBEM_CONTACT_H
#define ROLLBEM_CONTACT_H

#include "rollbem/base.h"
#include "rollbem/lcp.h"

RB_PUBLIC_BEGIN

/* ---- The operator: displacements due to tractions ---------------------------------- */

/* Gaps F_N r and slips S r, S = A F_T (K2), of tractions r = (r_N, r_T) on n elements.
 * There are two kinds: matrices, which every solver takes, and products without matrices,
 * for Newton's method with GMRES. */
typedef struct rb_contact_operator rb_contact_operator;

/* Matrices.  F: gap rows 0 ... n-1 of 2n columns, ld = ldf, borrowed; S: n x 2n, taken
 * over, also on failure.  RB_ENOMEM. */
rb_status rb_contact_operator_dense(int n, const double *F, int ldf, double *S,
                                    rb_contact_operator **op);

/* Products, on a line of equal elements. */
typedef struct {
    /* r: 2n; *gap, *slip: n each, the context's own, until its next product. */
    void (*apply)(void *context, const double *r, const double **gap,
                  const double **slip);
    /* Approximate inverse of F_NN (tangential 0) or A F_TT (1); line: n, overwritten. */
    void (*precondition)(void *context, int tangential, double *line);
    void (*free)(void *context);
    void *context;
} rb_contact_products;

/* The context is taken over, also on failure.  RB_ENOMEM. */
rb_status rb_contact_operator_products(int n, const rb_contact_products *products,
                                       rb_contact_operator **op);

/* Gives `dense` the products of the same operator, to solve large systems with GMRES; if
 * GMRES does not converge, it uses its matrices.  `dense` takes the products over and
 * frees earlier ones.  NULL: matrices only. */
void rb_contact_operator_add_products(rb_contact_operator *dense,
                                      rb_contact_operator *products);

/* NULL is skipped, as everywhere. */
void rb_contact_operator_free(rb_contact_operator *op);

/* gap += F_N (p, q), slip += S (p, q); all n. */
void rb_contact_operator_add(rb_contact_operator *op, const double *p, const double *q,
                             double *gap, double *slip);

/* The matrices; F is NULL where there are none. */
typedef struct {
    const double *F; /* borrowed, as S */
    int ldf;
    const double *S; /* ld = n */
} rb_contact_matrix;
rb_contact_matrix rb_contact_operator_matrix(const rb_contact_operator *op);

/* Sizes of the answers to unit tractions, of which the scales of a problem are made. */
typedef struct {
    double gap, slip;    /* on the diagonals of F_NN and A F_TT */
    double coupled_slip; /* that unit pressures leave at the middle element */
    double reach;        /* sum of a row of F_NN over its diagonal; 0 with matrices */
    int coupled;         /* 0: pressure causes no slip and friction no gap */
} rb_contact_response;
rb_contact_response rb_contact_operator_response(const rb_contact_operator *op);

/* ---- The problem ------------------------------------------------------------------- */

struct rb_contact_state;
typedef void rb_contact_newton_trace(const struct rb_contact_state *state, void *context);

/* Gap (K1): y_N = d_N + F_N (r_N, r_T) - delta >= 0, complementary to r_N.
 * Slip (K2): T_T lambda = d_T + S (r_N, r_T) + xi e_T.
 * Forces: P = load_N'r_N + load_T'r_T, Q = force_N'r_N + force_T'r_T.
 * Moment of the load about x = 0: M = moment_N'r_N + moment_T'r_T.
 * xi: the creepage, or the rigid shift of a contact at rest. */
typedef struct {
    int n;
    rb_contact_operator *op; /* owned, as the arrays; copies of the struct share them */
    double *bound; /* n: |r_T| <= bound r_N of an element; what a friction law gives */
    double mu;     /* the scale of friction; no bound is larger */
    double *d_N, *d_T;                           /* n [length] */
    double *e_T;                                 /* n: [length] per unit of xi */
    double *load_N, *load_T, *force_N, *force_T; /* n [length] */
    double *moment_N, *moment_T;                 /* n [length^2] */

    int load_given;  /* 1: P = load, delta is an unknown; 0: delta is given */
    int force_given; /* 1: Q = force + force_ratio times the friction that is carried at
                        most (mu P for one coefficient), xi is an unknown; 0: xi is given
                      */
    double load, delta, force, force_ratio, xi;
    double axle; /* 1/R_A where the force is that less axle M (free
                    axle, V4); else 0 [1/length] */

    /* A layer between the surfaces yields (Y1): |r_T| <= yield + hardening u of an
     * element, and never less than 0, u_i = recall[0] u_i+1 + recall[1] u_i+2 + own
     * |plastic_i| what it has yielded in this problem; plastic is a part of the slip
     * T_T lambda. */
    double *yield;    /* n [stress]: the bound while u = 0; owned; NULL: no such layer */
    double hardening; /* [stress/length]; < 0: softening */
    double recall[2], own; /* 1, 0, 1 where u follows the material upstream by first
                              order, 4/3, -1/3, 2/3 by second; 0, 0, 1: it stays */

    int differences; /* 1: slips are differences along the elements; 0: displacements */
    double stress, gap_length, slip_length; /* scales of r, y_N, lambda (4.4) */
    double rounding; /* of the scaled residual of products: gaps between neighbours are
                        small against the displacement of all; 0 with matrices */
    /* Sees each step of Newton's method: the zones of the state and the tractions that
     * they lead to, before the zones are corrected; NULL: nobody. */
    rb_contact_newton_trace *trace;
    void *trace_context;
} rb_contact_problem;

/* Makes arrays of zeros for the elements of the operator.  The problem takes the operator
 * over, also on failure.  RB_ENOMEM. */
rb_status rb_contact_problem_alloc(rb_contact_operator *op, rb_contact_problem *problem);
/* The same, but somebody else owns the operator: set problem->op to NULL before you free
 * the problem. */
rb_status rb_contact_problem_borrow(rb_contact_operator *op, rb_contact_problem *problem);
void rb_contact_problem_free(rb_contact_problem *problem);

/* One coefficient of friction for all elements (bound NULL), or one for each: n values,
 * 0 ... mu, copied.  Also between solves: warm starts stay good. */
void rb_contact_set_friction(rb_contact_problem *problem, double mu, const double *bound);

/* A layer that yields at the same stress everywhere; the caller sets recall and own.
 * RB_ENOMEM. */
rb_status rb_contact_set_yield(rb_contact_problem *problem, double stress,
                               double hardening);
/* u (n) of the plastic slips (n). */
void rb_contact_yielded(const rb_contact_problem *problem, const double *plastic,
                        double *u);
/* The yield stress of element i that has yielded by u; INFINITY without a layer. */
double rb_contact_yield_stress(const rb_contact_problem *problem, int i, double u);

/* ---- The state: unknowns of a problem ---------------------------------------------- */

typedef enum {
    RB_ZONE_SEPARATED = 0,
    RB_ZONE_STICK = 1,
    RB_ZONE_SLIP_NEGATIVE = 2,  /* r_T = -mu r_N: A's surface slides towards +x */
    RB_ZONE_SLIP_POSITIVE = 3,  /* r_T = +mu r_N */
    RB_ZONE_YIELD_NEGATIVE = 4, /* r_T = -(yield + hardening u): the layer yields */
    RB_ZONE_YIELD_POSITIVE = 5  /* r_T = +(yield + hardening u) */
} rb_contact_zone;

typedef enum {
    RB_SOLVER_AUTO,
    RB_SOLVER_LEMKE,
    RB_SOLVER_NEWTON,
    RB_SOLVER_CONE /* one that the caller hands in */
} rb_contact_solver;

typedef enum { RB_LCP_PIVOTED, RB_LCP_KWAK } rb_contact_lcp_form;

typedef struct rb_contact_state {
    int n;
    double *p, *q, *lambda; /* r_N, r_T, T_T lambda; owned */
    double *plastic;        /* the part of lambda by which a layer yields; owned */
    int *zone;              /* rb_contact_zone; owned */
    double delta, xi;
    rb_status status;
    rb_contact_solver solver;
    rb_contact_lcp_form lcp_form;
    int mirrored; /* of the LCP that was solved */
    double xi0;
    int iterations;
    double residual;
} rb_contact_state;

rb_status rb_contact_state_alloc(int n, rb_contact_state *state);
void rb_contact_state_free(rb_contact_state *state);

/* gap (n) and lambda (n) of p, q, delta, xi. */
void rb_contact_kinematics(const rb_contact_problem *problem,
                           const rb_contact_state *state, double *gap, double *lambda);

/* Largest violations of (K1)-(K3) and of the given load and force, recomputed from p, q,
 * delta and xi alone. */
typedef struct {
    double scaled;    /* natural residual of the scaled problem (4.4) */
    double gap, slip; /* [length] */
    double friction;  /* [stress] */
} rb_contact_violation;

rb_status rb_contact_residual(const rb_contact_problem *problem,
                              const rb_contact_state *state,
                              rb_contact_violation *violation);

/* The scale of friction: the bound of the pressure p->stress under the largest
 * coefficient; without friction that pressure. */
double rb_contact_friction_scale(const rb_contact_problem *problem);
/* The largest friction force that the pressures of the state allow: mu P for one
 * coefficient. */
double rb_contact_capacity(const rb_contact_problem *problem,
                           const rb_contact_state *state);
/* P, Q and M of the state. */
double rb_contact_load(const rb_contact_problem *problem, const rb_contact_state *state);
double rb_contact_force(const rb_contact_problem *problem, const rb_contact_state *state);
double rb_contact_moment(const rb_contact_problem *problem,
                         const rb_contact_state *state);

/* ---- The LCP (K4, K5, K6) ---------------------------------------------------------- */

/* M z + b complementary to z, scaled: physical z_j = z_scale_j z_j.  Size 3n, or 5n where
 * a layer yields (Y1), plus one row for a given load and one for a given force (K6). */
typedef struct {
    int size;
    double *M, *b;             /* size x size column-major, size; owned */
    double *z_scale, *w_scale; /* size; owned */
    rb_contact_lcp_form form;
    int yields; /* 1: plastic slips and what is left of the yield stress behind the 3n */
    int mirrored; /* pivoted form: unknowns (gamma-, lambda+) instead of (gamma+, lambda-)
                   */
    double delta0, xi0;            /* where the bordered unknowns start */
    double *control_N, *control_T; /* n: row of the given force; owned */
} rb_contact_lcp;

/* RB_EINVAL: the operator has no matrices; RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_lcp_create(const rb_contact_problem *problem,
                                rb_contact_lcp_form form, int mirrored, double xi0,
                                rb_contact_lcp *lcp, rb_message *why);
void rb_contact_lcp_free(rb_contact_lcp *lcp);
/* p, q, delta, xi from z; lambda and zones are recomputed from the problem. */
void rb_contact_lcp_recover(const rb_contact_problem *problem, const rb_contact_lcp *lcp,
                            const double *z, rb_contact_state *state);

/* Name of one of its variables, numbered w, z, z0 (lcp.h), on n contact elements: "p[3]",
 * "lambda+[2]", "plastic+[2]"; behind those of the contact stand the given load and the
 * given force: "motion[1]", "force[1]".  Returns name. */
enum { RB_CONTACT_VARIABLE = 32 };
const char *rb_contact_lcp_variable(const rb_contact_lcp *lcp, int n, int variable,
                                    char name[RB_CONTACT_VARIABLE]);

/* ---- Solvers ----------------------------------------------------------------------- */

/* A problem with given delta and xi in Coulomb's cones: u = W r + q, two numbers [N, T]
 * per element, scaled to numbers of order one. */
typedef struct {
    int n;
    double *mu; /* n; owned, as W and q */
    double *W;  /* 2n x 2n column-major */
    double *q;  /* 2n */
} rb_contact_cone;

/* RB_EINVAL: the operator has no matrices; RB_ENOMEM. */
rb_status rb_contact_cone_create(const rb_contact_problem *problem, double delta,
                                 double xi, rb_contact_cone *cone, rb_message *why);
void rb_contact_cone_free(rb_contact_cone *cone);

/* Cone solvers by name, such as rb_friction_cone_solvers(). */
typedef struct {
    int (*knows)(const char *name);
    /* r: 2n, written; iterations: added to. */
    rb_status (*solve)(const char *name, const rb_contact_cone *cone, double tol,
                       double *r, int *iterations, rb_message *why);
} rb_contact_cone_solvers;

typedef struct {
    rb_contact_solver solver;
    const rb_contact_cone_solvers
        *cone_solvers;            /* RB_SOLVER_CONE; borrowed, as the next */
    const char *cone_solver;      /* its name */
    rb_contact_lcp_form lcp_form; /* the first one that Lemke tries */
    double tol; /* of the scaled natural residual; not below the problem's rounding */
    const char *force_unit; /* behind the forces in refusals; NULL: any consistent one */
    double sliding; /* > 0: an |xi| that makes everything slide, to start searches from */
    /* sees every pivot of Lemke, with trace_context; pivot->attempt is 0 in the pivoted
     * form, 1 in its mirror image, 2 in Kwak's; NULL: nobody */
    rb_lcp_trace *trace;
    void *trace_context;
    int trace_tableau; /* 1: with the whole tableau */
} rb_contact_options;

/* RB_SOLVER_AUTO, the pivoted form first, a tolerance of 1e-10, nobody who sees pivots.
 */
rb_contact_options rb_contact_defaults(void);

/* Solves by the wanted solver, and by the other one where that fails (state->solver says
 * which one did it).  warm: the zones of the state are a start. */
rb_status rb_contact_solve(rb_contact_problem *problem, const rb_contact_options *options,
                           int warm, rb_contact_state *state, rb_message *why);

/* The LCP that gave the state, where Lemke's method did; for any other state, or NULL,
 * the one that Lemke tries first. */
rb_status rb_contact_lcp_first(const rb_contact_problem *problem,
                               const rb_contact_options *options,
                               const rb_contact_state *state, rb_contact_lcp *lcp,
                               rb_message *why);

/* The linear problem of the zones that the state names, right or wrong: p, q, lambda,
 * delta and xi of the state, and the gap (n), which tell what a wrong guess violates.
 * RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_try_zones(rb_contact_problem *problem, rb_contact_state *state,
                               double *gap);

RB_PUBLIC_END

#endif
