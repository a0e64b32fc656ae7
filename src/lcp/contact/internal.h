/* Declarations shared by the files of this folder: the two kinds of operators, and the
 * linear problem for given zones. */
#ifndef ROLLBEM_CONTACT_INTERNAL_H
#define ROLLBEM_CONTACT_INTERNAL_H

#include "lcp/contact/contact.h"

#include <math.h>

/* ---- reduced.c --------------------------------------------------------------------- */

/* The unknowns of a linear problem: (r_N, delta), (r_T, xi) or both. */
typedef enum { RB_NORMAL = 1, RB_TANGENTIAL = 2, RB_BOTH = 3 } rb_contact_unknowns;

/* The linear problem for given zones.  Unknowns: r_N of the elements in contact and
 * delta, r_T of those in stick and xi; or one of these two groups, with the other one
 * fixed.  Order of the unknowns: contacts, sticks, delta (given load), xi (given force);
 * order of the rows: gaps, slips, load, force.  All are scaled to order one. */
typedef struct {
    rb_contact_unknowns unknowns;
    int contacts, sticks, load, force; /* load, force: 1 where it is given, so that delta, xi is
                                          an unknown, else 0 */
    int size;                          /* their sum */
    int *contact, *stick;              /* element numbers */
    double *control_N, *control_T;     /* n: row of the given force */
    double force_scale;                /* scale of this row */
    double *gap, *lambda;              /* n: with the unknowns at zero */
    double *start;                     /* size: the unknowns of the state at the beginning */
    double *x;                         /* size: right-hand side, then solution */
    int changes;                       /* number of unknowns changed since the LU that was used */
    int slight;      /* number of unknowns whose friction has changed slightly since then */
    double growth;   /* ratio of the tractions without borders to those with borders */
    rb_arena memory; /* of the arrays */
} rb_contact_reduced;

rb_status rb_contact_reduced_alloc(const rb_contact_problem *problem, rb_contact_unknowns unknowns,
                                   const rb_contact_state *state, rb_contact_reduced *r);
void rb_contact_reduced_free(rb_contact_reduced *r);

/* Slope in r_T = slope bound r_N of a zone; 0 in stick, where r_T is an unknown. */
static inline double rb_contact_slope(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE ? -1.0 : zone == RB_ZONE_SLIP_POSITIVE ? 1.0 : 0.0;
}
/* r_T of an element per unit of its unknown pressure: its bound with the sign of its
 * zone, or 0 if pressures and friction are not solved together. */
static inline double rb_contact_reduced_friction(const rb_contact_problem *p,
                                                 const rb_contact_reduced *r, const int *zone,
                                                 int i)
{
    return rb_contact_slope(zone[i]) * (r->unknowns == RB_BOTH ? p->bound[i] : 0.0);
}

/* Sets the unknowns of the state to zero and the friction of slipping elements to its
 * bound. */
void rb_contact_reduced_clear(const rb_contact_problem *problem, const rb_contact_reduced *r,
                              rb_contact_state *state);
/* Sets r->x to the residual of the equations at the unknowns of the state. */
void rb_contact_reduced_right_side(const rb_contact_problem *problem, const rb_contact_state *state,
                                   rb_contact_reduced *r);
/* What the given force lacks, as a part of its scale; 0: none is given. */
double rb_contact_reduced_force_lacks(const rb_contact_problem *problem,
                                      const rb_contact_state *state, const rb_contact_reduced *r);
/* Adds r->x to the unknowns of the state.  RB_SINGULAR: it is not finite. */
rb_status rb_contact_reduced_add(const rb_contact_problem *problem, const rb_contact_reduced *r,
                                 rb_contact_state *state);

/* One exact solve with the zones of the state held fixed.  RB_SINGULAR: p and q are
 * undefined. */
rb_status rb_contact_solve_zones(rb_contact_problem *problem, rb_contact_unknowns unknowns,
                                 rb_contact_state *state);

/* ---- operator.c: what every kind has ----------------------------------------------- */

/* Which operator to invert approximately: F_NN, A F_TT, or 1 + hardening F_TT. */
typedef enum { RB_INVERSE_NORMAL, RB_INVERSE_TANGENTIAL, RB_INVERSE_YIELDING } rb_contact_inverse;

/* A linear system for GMRES (gmres.h). */
typedef struct rb_contact_linear rb_contact_linear;

typedef struct {
    void (*add)(rb_contact_operator *op, const double *p, const double *q, double *gap,
                double *slip);
    /* Solves the reduced problem for the zones of the state.  RB_SINGULAR, RB_ENOMEM. */
    rb_status (*solve)(const rb_contact_problem *problem, rb_contact_state *state,
                       rb_contact_reduced *r);
    /* Only for products; NULL for matrices.  gmres solves other linear problems than the
     * reduced one; precondition applies an approximate inverse (line: n, overwritten). */
    rb_status (*gmres)(rb_contact_operator *op, const rb_contact_linear *linear, const double *b,
                       double *x);
    void (*precondition)(rb_contact_operator *op, rb_contact_inverse of, double hardening,
                         double *line);
    /* Frees data that earlier solves have stored for later ones; NULL: there is none. */
    void (*forget)(rb_contact_operator *op);
    /* Makes the operator for pairs of elements; NULL: solves do not start from pairs. */
    rb_status (*halve)(const rb_contact_operator *op, int differences, rb_contact_operator **half);
    void (*free)(rb_contact_operator *op);
} rb_contact_kind;

/* The struct of each kind begins with this struct. */
struct rb_contact_operator {
    const rb_contact_kind *kind;
    int n;
    rb_contact_matrix matrix;
    rb_contact_response response;
};

/* ---- problem.c --------------------------------------------------------------------- */

/* Allocates arrays of zeros for the n elements of a problem whose operator is set; frees
 * the operator if there is no memory. */
rb_status rb_contact_problem_alloc_rows(rb_contact_problem *problem);
/* Row of the given force: control_N'r_N + control_T'r_T = force, n each. */
void rb_contact_force_row(const rb_contact_problem *problem, double *control_N, double *control_T);
/* Scale of the given force: mu times the resultant of the scale pressure. */
double rb_contact_force_scale(const rb_contact_problem *problem);
/* 1: the given force is all that friction can carry. */
int rb_contact_slides_fully(const rb_contact_problem *problem);
/* 1: further steps and other starts may be tried. */
int rb_contact_has_steps_left(const rb_contact_problem *problem, const rb_contact_state *state);

/* ---- dense.c ----------------------------------------------------------------------- */

/* 1: an operator with matrices and products; its solves end at a tolerance of GMRES. */
int rb_contact_dense_has_products(const rb_contact_operator *op);
/* The operator whose products solve a system of this size faster than an LU: op itself or
 * the products added to it; NULL: none. */
rb_contact_operator *rb_contact_operator_by_products(rb_contact_operator *op, int unknowns);

/* ---- pairs.c ----------------------------------------------------------------------- */

/* Makes the problem with elements in pairs; free it with rb_contact_problem_free.
 * RB_MAXITER: not possible for products; RB_ENOMEM. */
rb_status rb_contact_halve(const rb_contact_problem *fine, rb_contact_problem *half);
/* Every element gets the values of its pair. */
void rb_contact_start_from_half(const rb_contact_state *half, rb_contact_state *state);

/* ---- cone.c ------------------------------------------------------------------------ */

/* Computes p and q for the state's delta and xi with the caller's cone solver.
 * RB_EINVAL: unknown solver. */
rb_status rb_contact_cone_solve(const rb_contact_problem *problem,
                                const rb_contact_options *options, rb_contact_state *state,
                                rb_message *why);

/* ---- residual.c -------------------------------------------------------------------- */

/* The zone of an element in contact that slides by lambda. */
rb_contact_zone rb_contact_sliding_zone(double lambda);

/* Zones from p, q and lambda; entries below tol times the scales count as zero. */
void rb_contact_classify(const rb_contact_problem *problem, double tol, rb_contact_state *state);

/* ---- newton.c ---------------------------------------------------------------------- */

/* Newton's method from the zones of the state (warm), or from the result of alternating
 * normal and tangential problems.  RB_MAXITER: it cycles; RB_SINGULAR. */
rb_status rb_contact_newton(rb_contact_problem *problem, int warm, rb_contact_state *state);
/* rb_contact_newton, completed. */
rb_status rb_contact_by_newton(rb_contact_problem *problem, const rb_contact_options *options,
                               int warm, rb_contact_state *state);
/* What Newton's method has ended with, as s says, completed. */
rb_status rb_contact_end_newton(rb_contact_problem *problem, const rb_contact_options *options,
                                rb_status s, rb_contact_state *state);

/* ---- complete.c -------------------------------------------------------------------- */

/* The scaled residual of the state.  RB_ENOMEM. */
rb_status rb_contact_measure(const rb_contact_problem *problem, rb_contact_state *state);
/* A given force fixes xi only while something sticks (4.6).  Where mu is so small that the friction
 * of the one element in stick is rounding of what the pressures do to it, none of the n zones is
 * stick: the element in contact that moves least, by lambda of the state, becomes it. */
void rb_contact_hold_slowest(const rb_contact_problem *problem, const rb_contact_state *state,
                             int *zone);
/* lambda, zones and residual of p, q, delta, xi.  exact: they solve the equations of
 * their zones already, as Newton's do.  RB_ENOMEM. */
rb_status rb_contact_complete(rb_contact_problem *problem, int exact, rb_contact_state *state);
/* 1: s is RB_OK, and the residual is within the tolerance. */
int rb_contact_is_solved(rb_status s, const rb_contact_problem *problem,
                         const rb_contact_options *options, const rb_contact_state *state);
/* s, but RB_INACCURATE where the residual says that a solution is none. */
rb_status rb_contact_proven(rb_status s, const rb_contact_problem *problem,
                            const rb_contact_options *options, const rb_contact_state *state);

/* ---- by_lemke.c -------------------------------------------------------------------- */

/* Lemke's method, attempt by attempt: forms and covering vectors (theory.md K5). */
rb_status rb_contact_by_lemke(rb_contact_problem *problem, const rb_contact_options *options,
                              rb_contact_state *state, rb_message *why);

/* ---- by_friction.c ----------------------------------------------------------------- */

/* Newton's method from a share of the friction to all of it. */
rb_status rb_contact_by_friction(rb_contact_problem *problem, const rb_contact_options *options,
                                 rb_contact_state *state);

/* ---- solve.c ----------------------------------------------------------------------- */

/* Solves a problem whose given load, force and motion friction can follow. */
rb_status rb_contact_solve_given(rb_contact_problem *problem, const rb_contact_options *options,
                                 int warm, rb_contact_state *state, rb_message *why);

/* ---- force.c ----------------------------------------------------------------------- */

/* A given force that is all that friction can carry (rb_contact_slides_fully). */
rb_status rb_contact_solve_full_sliding(rb_contact_problem *problem,
                                        const rb_contact_options *options, rb_contact_state *state,
                                        rb_message *why);
/* RB_EINVAL: a given force, or the resistance of a free axle, is more than friction carries;
 * refused->refused_at says at which creepage it carries most. */
rb_status rb_contact_check_capacity(rb_contact_problem *problem, const rb_contact_options *options,
                                    rb_contact_state *refused, rb_message *why);
/* A given force that all methods fail on: the creepage by bisection.  RB_MAXITER: not found. */
rb_status rb_contact_by_creepage(rb_contact_problem *problem, const rb_contact_options *options,
                                 rb_contact_state *state);
/* A layer that yields (Y1). */
rb_status rb_contact_solve_yielding(rb_contact_problem *problem, const rb_contact_options *options,
                                    int warm, rb_contact_state *state, rb_message *why);

/* ---- path.c ------------------------------------------------------------------------ */

/* Follows the path from the zones of the state, which should be nearly right, by changing
 * one element at a time.  RB_MAXITER: the path ends without a solution; RB_SINGULAR,
 * RB_ENOMEM. */
rb_status rb_contact_follow_path(rb_contact_problem *problem, rb_contact_state *state);

/* ---- yield.c ----------------------------------------------------------------------- */

/* 1: the friction of the state, which was computed without the layer, exceeds the yield
 * stress. */
int rb_contact_yields(const rb_contact_problem *problem, const rb_contact_state *state);
/* Newton's method for a problem with a plastic layer, from the zones of the state.
 * follows: 1: the state is the solution without the layer, and the yield stress is
 * reduced in steps from a value above the largest friction.  RB_MAXITER, RB_SINGULAR,
 * RB_ENOMEM. */
rb_status rb_contact_yield_newton(rb_contact_problem *problem, int follows,
                                  rb_contact_state *state);
/* Solves the linear problem with the laws that the elements of the state obey, and sets
 * the zones. */
rb_status rb_contact_yield_polish(const rb_contact_problem *problem, rb_contact_state *state);

#endif
