/* Declarations shared by the files of this folder. */
#ifndef ROLLBEM_SENSITIVITY_INTERNAL_H
#define ROLLBEM_SENSITIVITY_INTERNAL_H

#include "rollbem/sensitivity.h"

/* The equations of a state with given zones (D1), and the factorisation of their
 * Jacobian. */
struct rb_sensitivity {
    const rb_rolling_model *model; /* borrowed */
    int n, degenerate;
    int contact, at_rest;                   /* elements in contact; of these, with BORDER_REST */
    char *border;                           /* n: which pairs of an element are degenerate; owned */
    double *slip;                           /* 2n: T_T lambda and gap of the state; owned */
    double *law_slip, *law_force;           /* n x n: derivatives of the bounds with respect to
                                               slips and friction; NULL: zero; owned */
    rb_rolling_solution solution;           /* of the model, if results are differentiated */
    struct rb_sensitivity_factors *factors; /* for the zones of the model; owned */
    struct rb_sensitivity *free_rolling;    /* for free rolling of the same model; NULL: none */
    rb_rolling_model *freely;               /* the model in free rolling; owned */
    rb_rolling_model *own;                  /* a copy of the model with what derivatives need and it
                                               has not: a matrix, or boundaries compressed as closely as
                                               those of variants; NULL: it has all; owned */
    int moves;                              /* rb_sensitivity_elements, fixed at first */
    rb_sensitivity_derivative motion[2];    /* by elements that are stretched or shifted by 1 mm */
    double gain[4]; /* derivatives of the computed half-width and centre for these motions */
};

/* Degenerate complementary pairs. BORDER_REST: an element in contact that neither slides nor has
 * friction; only an input that brings it friction must find its zone. */
enum { BORDER_GAP = 1, BORDER_SLIP, BORDER_REST };

/* ---- equations.c ------------------------------------------------------------------- */

/* Fourth-order differences: around a value, and from it on. */
extern const rb_sensitivity_stencil rb_sensitivity_middle, rb_sensitivity_ahead;
/* The part of a residual that bounds and given values make, controls scaled as the
 * unknowns of the base are. */
void rb_sensitivity_given(const rb_rolling_model *base, const rb_contact_problem *problem,
                          const rb_contact_state *state, rb_sensitivity_rate *left);
/* Computes law_slip and law_force.  RB_ENOMEM. */
rb_status rb_sensitivity_law(rb_sensitivity *s, rb_message *why);

/* ---- differentiate.c --------------------------------------------------------------- */

/* Determines whether and how the elements move.  RB_ENOMEM. */
rb_status rb_sensitivity_set_motion(rb_sensitivity *s);
/* How the state moves where the equations alone change, by these rates; released: element
 * that sticks and begins to slip, or -1.  d: state[0], edges[0] and by[0], without results;
 * free it in any case. */
rb_status rb_sensitivity_along(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                               int released, rb_sensitivity_derivative *d, rb_message *why);
/* Sets to 0 what is rounding of the results over the scale of the input. */
void rb_sensitivity_clean(const rb_sensitivity *s, double scale, rb_rolling_solution *d);
/* Adds to side k of d, `factor` times, how all results change along such a line, where the
 * input is `ahead` of its value and the element changes its zone. */
rb_status rb_sensitivity_add_jump(const rb_sensitivity *s, const rb_sensitivity_derivative *line,
                                  int element, double factor, double ahead, int k,
                                  rb_sensitivity_derivative *d, rb_message *why);
/* The derivative of the creepage on side k, with what the motion of the elements adds. */
double rb_sensitivity_creepage(const rb_sensitivity *s, const rb_sensitivity_derivative *d, int k);

/* ---- jacobian.c -------------------------------------------------------------------- */

typedef struct rb_sensitivity_factors {
    int contacts, size;
    int first;           /* size of the first of two diagonal blocks: p and delta, if they
                            do not depend on q and xi; otherwise size */
    int *contact;        /* contacts: element numbers; owned */
    int *zone;           /* n: zones for which they were computed; owned */
    double *J, *unknown; /* size x size: LU of the diagonal blocks, in the order p, delta,
                            q, xi; size: scales of the unknowns; owned */
    double *row;         /* size: 1 over the scales of the equations; owned */
    int *pivot;          /* owned */
} rb_sensitivity_factors;

/* like: of a model whose factors may be the same, or NULL.  RB_SINGULAR, RB_ENOMEM. */
rb_status rb_sensitivity_factor(const rb_sensitivity *s, const int *zone,
                                const rb_sensitivity *like, rb_sensitivity_factors **factors);
void rb_sensitivity_factors_free(rb_sensitivity_factors *factors);
/* Returns what the creepage changes by with the load, where a creepage ratio is given
 * under an approach (the ratio is one of Hertz's half-width); otherwise 0. */
double rb_sensitivity_xi_by_load(const rb_rolling_model *model);
/* Solves J y' = -R'. */
rb_status rb_sensitivity_forward(const rb_sensitivity *s, const rb_sensitivity_factors *factors,
                                 const rb_sensitivity_rate *rate, rb_contact_state *tangent);

#endif
