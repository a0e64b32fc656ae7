/* What the rooms use of contact problems besides rollbem/contact.h. */
#ifndef ROLLBEM_SRC_LCP_CONTACT_CONTACT_H
#define ROLLBEM_SRC_LCP_CONTACT_CONTACT_H

#include "lcp/lcp.h"
#include "rollbem/contact.h"

/* ---- The operator: displacements due to tractions ---------------------------------- */

/* There are two kinds: operators with matrices, and operators with products only, for Newton's
 * method with GMRES. */

/* Functions of an operator with products, for a line of equal elements. */
typedef struct {
    /* r: 2n; *gap, *slip: n each, owned by the context and valid until its next
     * product. */
    void (*apply)(void *context, const double *r, const double **gap, const double **slip);
    /* Approximate inverse of F_NN (tangential 0) or A F_TT (1); line: n, overwritten. */
    void (*precondition)(void *context, int tangential, double *line);
    void (*free)(void *context);
    void *context;
    /* Approximate inverse of 1 + hardening F_TT, hardening > 0; NULL: not available. */
    void (*precondition_yielding)(void *context, double hardening, double *line);
} rb_contact_products;

/* Takes ownership of the context, also on failure.  RB_ENOMEM. */
rb_status rb_contact_operator_products(int n, const rb_contact_products *products,
                                       rb_contact_operator **op);

/* The matrices of an operator; F is NULL if it has none. */
typedef struct {
    const double *F; /* borrowed, as S */
    int ldf;
    const double *S; /* ld = n */
} rb_contact_matrix;
rb_contact_matrix rb_contact_operator_matrix(const rb_contact_operator *op);

/* Adds products of the same operator to `dense`, so that large systems are solved with
 * GMRES; if GMRES does not converge, the matrices are used.  `dense` takes ownership of
 * the products and frees earlier ones.  NULL: matrices only. */
void rb_contact_operator_add_products(rb_contact_operator *dense, rb_contact_operator *products);

/* gap += F_N (p, q), slip += S (p, q); all n. */
void rb_contact_operator_add(rb_contact_operator *op, const double *p, const double *q, double *gap,
                             double *slip);

/* Typical displacements under unit tractions; the scales of a problem are computed from
 * them. */
typedef struct {
    double gap, slip;    /* mean of the diagonals of F_NN and of A F_TT */
    double coupled_slip; /* slip of the middle element under unit pressures */
    double reach;        /* sum of a row of F_NN divided by its diagonal entry; 0 with matrices */
    int coupled;         /* 0: pressure causes no slip and friction no gap */
} rb_contact_response;
rb_contact_response rb_contact_operator_response(const rb_contact_operator *op);

/* The operator of elements `scale` times as long under half-planes, after its F has been scaled and
 * `along` [1/stress] times the length of an element added to F_NN (rb_bem_flexibility_stretch).
 * The next solves have a given load, as the last ones had: their LU is kept.  RB_EINVAL: it has no
 * matrix, or products beside it. */
rb_status rb_contact_operator_stretch(rb_contact_operator *op, double scale, double along);

/* ---- The problem ------------------------------------------------------------------- */

/* P, Q and M of the state. */
double rb_contact_load(const rb_contact_problem *problem, const rb_contact_state *state);
double rb_contact_force(const rb_contact_problem *problem, const rb_contact_state *state);
double rb_contact_moment(const rb_contact_problem *problem, const rb_contact_state *state);

/* As rb_contact_problem_alloc, but the caller keeps the operator: set problem->op to NULL before
 * you free the problem. */
rb_status rb_contact_problem_borrow(rb_contact_operator *op, rb_contact_problem *problem);

/* Adds a plastic layer with the same yield stress everywhere; the caller sets recall and
 * own. RB_ENOMEM. */
rb_status rb_contact_set_yield(rb_contact_problem *problem, double stress, double hardening);
/* Accumulated plastic slip u (n values) from the plastic slips (n values).  zone: n zones, whose
 * direction says which sign grows u, so that u is linear in the plastic slips; NULL: their sizes
 * count. */
void rb_contact_yielded(const rb_contact_problem *problem, const double *plastic, const int *zone,
                        double *u);
/* Yield stress of element i at the accumulated plastic slip u; INFINITY without a plastic
 * layer. */
double rb_contact_yield_stress(const rb_contact_problem *problem, int i, double u);

/* ---- The state: unknowns of a problem ---------------------------------------------- */

/* What a warm start needs of another state with as many elements: zones, tractions, approach and
 * creepage. */
void rb_contact_copy_start(const rb_contact_state *from, rb_contact_state *to);

/* 1: in element i the surfaces slide and the layer between them yields, too: |r_T| = bound r_N
 * and, with hardening, u is what raises the yield stress up to it (Y1). */
int rb_contact_slips_and_yields(const rb_contact_problem *problem, const rb_contact_state *state,
                                int i);
/* Sets the plastic slips from zones, pressures and slips: all of lambda where the layer yields
 * alone; what hardens it up to bound r_N where the surfaces slide, too, which is where the plastic
 * slip was not 0 before; else 0.  u: n accumulated plastic slips, or NULL. */
void rb_contact_set_plastic(const rb_contact_problem *problem, rb_contact_state *state, double *u);

/* Computes gap (n) and lambda (n) from p, q, delta and xi. */
void rb_contact_kinematics(const rb_contact_problem *problem, const rb_contact_state *state,
                           double *gap, double *lambda);

/* Scale of the tangential tractions: mu times the pressure problem->stress; without
 * friction that pressure itself. */
double rb_contact_friction_scale(const rb_contact_problem *problem);
/* The largest friction force that the pressures of the state allow: mu P for one
 * coefficient. */
double rb_contact_capacity(const rb_contact_problem *problem, const rb_contact_state *state);

/* ---- The LCP (K4, K5, K6) ---------------------------------------------------------- */

/* Writes the name of a variable of the LCP of n contact elements; variables are numbered
 * w, z, z0 as in lcp.h.  Examples: "p[3]", "lambda+[2]", "plastic+[2]".  The variables of
 * the given load and force come last: "motion[1]", "force[1]".  Returns name. */
enum { RB_CONTACT_VARIABLE = 32 };
const char *rb_contact_lcp_variable(const rb_contact_lcp *lcp, int n, int variable,
                                    char name[RB_CONTACT_VARIABLE]);

/* ---- Solvers ----------------------------------------------------------------------- */

/* RB_EINVAL: the operator has no matrices; RB_ENOMEM. */
rb_status rb_contact_cone_create(const rb_contact_problem *problem, double delta, double xi,
                                 rb_contact_cone *cone, rb_message *why);
void rb_contact_cone_free(rb_contact_cone *cone);

/* Finds a cone solver by its name, as rb_friction_cone_solver does. */
typedef rb_contact_cone_solver rb_contact_cone_finder(const char *name);

/* The LCP whose solution the state is, if Lemke's method found it; for any other state,
 * or NULL, the LCP that Lemke's method tries first. */
rb_status rb_contact_lcp_first(const rb_contact_problem *problem, const rb_contact_options *options,
                               const rb_contact_state *state, rb_contact_lcp *lcp, rb_message *why);

/* Solves the linear equations for the zones given in the state, whether they are right or
 * wrong.  Writes p, q, lambda, delta and xi into the state, and the gap (n); the
 * conditions that they violate show where the zones are wrong. RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_try_zones(rb_contact_problem *problem, rb_contact_state *state, double *gap);

/* ---- Proof ------------------------------------------------------------------------- */

/* Proves that the problem has a solution with the zones of the state, or tells what is not
 * proved.  Without matrices they are formed up to 1500 elements.  RB_OK: it ran, see
 * proof->proved; RB_SINGULAR, RB_INTERRUPTED, RB_ENOMEM. */
rb_status rb_contact_prove(const rb_contact_problem *problem, const rb_contact_state *state,
                           rb_contact_proof *proof, rb_message *why);

#endif
