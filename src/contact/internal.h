/* What the files of this folder share: the two kinds of operators, and the linear problem
 * that is left when every element's zone is known. */
#ifndef ROLLBEM_CONTACT_INTERNAL_H
#define ROLLBEM_CONTACT_INTERNAL_H

#include "rollbem/contact.h"

#include <math.h>

/* ---- reduced.c --------------------------------------------------------------------- */

/* Which unknowns a solve moves: (r_N, delta), (r_T, xi) or both. */
typedef enum { RB_NORMAL = 1, RB_TANGENTIAL = 2, RB_BOTH = 3 } rb_contact_unknowns;

/* Unknowns: r_N of the elements in contact and delta, r_T of those in stick and xi; or
 * one of these two groups alone, the other held fixed.  Their order: contacts, sticks,
 * delta (given load), xi (given force); rows alike: gaps, slips, load, force; all scaled
 * to numbers of order one. */
typedef struct {
    rb_contact_unknowns unknowns;
    int contacts, sticks, load, force, size;
    int *contact, *stick;          /* element numbers */
    double *control_N, *control_T; /* n: row of the given force */
    double force_scale;            /* of that row */
    double *gap, *lambda;          /* n: with the unknowns at zero */
    double *start;                 /* size: the unknowns as the state had them */
    double *x;                     /* size: right-hand side, then solution */
    int changes;                   /* of unknowns since the LU that solved it */
    int slight;                    /* unknowns whose friction has turned a little since */
    double growth;                 /* of tractions without borders over those with */
} rb_contact_reduced;

rb_status rb_contact_reduced_alloc(const rb_contact_problem *problem,
                                   rb_contact_unknowns unknowns,
                                   const rb_contact_state *state, rb_contact_reduced *r);
void rb_contact_reduced_free(rb_contact_reduced *r);
/* Row of the given force: control_N'r_N + control_T'r_T = force, n each. */
void rb_contact_force_row(const rb_contact_problem *problem, double *control_N,
                          double *control_T);
/* mu times the resultant of the scale pressure: the scale of the given force. */
double rb_contact_force_scale(const rb_contact_problem *problem);

/* r_T = slope bound r_N of a zone; 0 in stick, where r_T is an unknown of its own. */
static inline double rb_contact_slope(int zone)
{
    return zone == RB_ZONE_SLIP_NEGATIVE   ? -1.0
           : zone == RB_ZONE_SLIP_POSITIVE ? 1.0
                                           : 0.0;
}
/* r_T of an element per unit of its unknown pressure: its bound in the direction that its
 * zone says, or 0 where the pressure is not moved together with it. */
static inline double rb_contact_reduced_friction(const rb_contact_problem *p,
                                                 const rb_contact_reduced *r,
                                                 const int *zone, int i)
{
    return rb_contact_slope(zone[i]) * (r->unknowns == RB_BOTH ? p->bound[i] : 0.0);
}

/* Sets the unknowns of the state to zero and the friction of slipping elements to its
 * bound. */
void rb_contact_reduced_clear(const rb_contact_problem *problem,
                              const rb_contact_reduced *r, rb_contact_state *state);
/* r->x: what the equations lack with the unknowns as the state has them. */
void rb_contact_reduced_right_side(const rb_contact_problem *problem,
                                   const rb_contact_state *state, rb_contact_reduced *r);
/* Adds r->x to the unknowns of the state.  RB_SINGULAR where it is not finite. */
rb_status rb_contact_reduced_add(const rb_contact_problem *problem,
                                 const rb_contact_reduced *r, rb_contact_state *state);

/* ---- gmres.c ----------------------------------------------------------------------- */

/* [A B; C 0]: inner unknowns, and at most two at the border.  The functions get `of`. */
typedef struct {
    int inner, borders;
    void (*multiply)(const void *of, const double *x, double *y);
    void (*precondition)(const void *of, const double *b, double *x); /* x ~ A^-1 b */
    void (*border_column)(const void *of, int k, double *column);     /* of B */
    void (*border_rows)(const void *of, const double *x, double *y);  /* y = C x */
    const void *of;
} rb_contact_linear;

/* Kept from solve to solve: fresh memory costs more than the arithmetic.  Zeros but for
 * the size to begin with. */
enum { RB_CONTACT_BASIS = 100 };
typedef struct {
    size_t size;                         /* the most unknowns */
    double *basis[RB_CONTACT_BASIS + 1]; /* on demand; owned, as work */
    double *work;
} rb_contact_gmres_room;
void rb_contact_gmres_free(rb_contact_gmres_room *room);

/* From x.  RB_OK also where the residual no longer falls: then it is rounding, or the
 * residual of the whole problem tells it.  RB_ENOMEM. */
rb_status rb_contact_gmres(const rb_contact_linear *linear, rb_contact_gmres_room *room,
                           const double *b, double *x);

/* ---- operator.c: what every kind has ----------------------------------------------- */

/* Of F_NN, A F_TT, or 1 + hardening F_TT. */
typedef enum {
    RB_INVERSE_NORMAL,
    RB_INVERSE_TANGENTIAL,
    RB_INVERSE_YIELDING
} rb_contact_inverse;

typedef struct {
    void (*add)(rb_contact_operator *op, const double *p, const double *q, double *gap,
                double *slip);
    /* Solves the reduced problem for the zones of the state.  RB_SINGULAR, RB_ENOMEM. */
    rb_status (*solve)(const rb_contact_problem *problem, rb_contact_state *state,
                       rb_contact_reduced *r);
    /* Of products; NULL: matrices.  Linear problems other than the reduced one, and what
     * makes an approximate inverse of them (line: n, overwritten). */
    rb_status (*gmres)(rb_contact_operator *op, const rb_contact_linear *linear,
                       const double *b, double *x);
    void (*precondition)(rb_contact_operator *op, rb_contact_inverse of, double hardening,
                         double *line);
    /* What earlier solves have left for later ones; NULL: nothing. */
    void (*forget)(rb_contact_operator *op);
    /* The operator of the elements in pairs; NULL: pairs do not start a solve. */
    rb_status (*halve)(const rb_contact_operator *op, int differences,
                       rb_contact_operator **half);
    void (*free)(rb_contact_operator *op);
} rb_contact_kind;

/* Each kind's own struct begins with it. */
struct rb_contact_operator {
    const rb_contact_kind *kind;
    int n;
    rb_contact_matrix matrix;
    rb_contact_response response;
};

/* ---- problem.c --------------------------------------------------------------------- */

/* Arrays of zeros for the n elements of a problem whose operator is set; frees it where
 * there is no memory. */
rb_status rb_contact_problem_alloc_rows(rb_contact_problem *problem);

/* ---- dense.c ----------------------------------------------------------------------- */

/* 1: matrices with products at their side, whose solves end at a tolerance of GMRES. */
int rb_contact_dense_has_products(const rb_contact_operator *op);
/* The operator whose products solve a system of so many unknowns sooner than an LU: op
 * itself or what it has at its side; NULL: none. */
rb_contact_operator *rb_contact_operator_by_products(rb_contact_operator *op,
                                                     int unknowns);

/* ---- pairs.c ----------------------------------------------------------------------- */

/* The problem with its elements in pairs, forces added; for rb_contact_problem_free.
 * RB_MAXITER: of products there is none; RB_ENOMEM. */
rb_status rb_contact_halve(const rb_contact_problem *fine, rb_contact_problem *half);
/* Every element takes over what its pair has. */
void rb_contact_start_from_half(const rb_contact_state *half, rb_contact_state *state);

/* ---- cone.c ------------------------------------------------------------------------ */

/* p and q for the state's delta and xi, by the caller's cone solver.  RB_EINVAL: it is
 * not known. */
rb_status rb_contact_cone_solve(const rb_contact_problem *problem,
                                const rb_contact_options *options,
                                rb_contact_state *state, rb_message *why);

/* ---- residual.c -------------------------------------------------------------------- */

/* Of an element in contact that slides by lambda. */
rb_contact_zone rb_contact_sliding_zone(double lambda);
/* Zones from p, q and lambda; entries below tol times the scales count as zero. */
void rb_contact_classify(const rb_contact_problem *problem, double tol,
                         rb_contact_state *state);

/* ---- newton.c ---------------------------------------------------------------------- */

/* One exact solve with the zones of the state held fixed.  RB_SINGULAR: p and q have lost
 * their values. */
rb_status rb_contact_solve_zones(rb_contact_problem *problem,
                                 rb_contact_unknowns unknowns, rb_contact_state *state);

/* Newton, from the zones of the state (warm) or by alternating normal and tangential
 * problems first.  RB_MAXITER where it cycles, RB_SINGULAR. */
rb_status rb_contact_newton(rb_contact_problem *problem, int warm,
                            rb_contact_state *state);

/* ---- path.c ------------------------------------------------------------------------ */

/* From the zones of the state, which should be nearly right, by changing one element at a
 * time.  RB_MAXITER where the path ends without a solution, RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_follow_path(rb_contact_problem *problem, rb_contact_state *state);

/* ---- yield.c ----------------------------------------------------------------------- */

/* 1: friction of the state, which knows no layer, is above the yield stress. */
int rb_contact_yields(const rb_contact_problem *problem, const rb_contact_state *state);
/* Newton for a problem with a layer that yields, from the zones of the state: at once,
 * or, where it is the solution without the layer, following the yield stress down from
 * one that nothing reaches.  RB_MAXITER, RB_SINGULAR, RB_ENOMEM. */
rb_status rb_contact_yield_newton(rb_contact_problem *problem, int follows,
                                  rb_contact_state *state);
/* One exact solve with the laws that the state obeys; its zones. */
rb_status rb_contact_yield_polish(const rb_contact_problem *problem,
                                  rb_contact_state *state);

#endif
