/* Declarations shared by the files of this folder. */
#ifndef ROLLBEM_SENSITIVITY_INTERNAL_H
#define ROLLBEM_SENSITIVITY_INTERNAL_H

#include "analysis/sensitivity/sensitivity.h"

/* The equations of a state with given zones (D1), and the factorisation of their
 * Jacobian. */
struct rb_sensitivity {
    const rb_rolling_model *model; /* borrowed */
    int n, degenerate;
    int contact, at_rest;         /* elements in contact; of these, with BORDER_REST */
    char *border;                 /* n: which pairs of an element are degenerate; owned */
    double *slip;                 /* 2n: T_T lambda and gap of the state; owned */
    double *law_slip, *law_force; /* n x n: derivatives of the bounds with respect to
                                     slips and friction; NULL: zero; owned */
    double *law_xi;               /* n: the same with respect to the creepage, by which the
                                     surfaces differ in speed (T1); NULL: zero; owned */
    rb_rolling_solution solution; /* of the model, if results are differentiated */
    struct rb_sensitivity_factors *factors; /* for the zones of the model; owned */
    struct rb_sensitivity *free_rolling;    /* for free rolling of the same model; NULL: none */
    rb_rolling_model *freely;               /* the model in free rolling; owned */
    rb_rolling_model *own;                  /* a copy of the model with what derivatives need and it
                                               has not: a matrix, or boundaries compressed as
                                               closely as those of variants; NULL: it has all;
                                               owned */
    rb_rolling_perturbation *perturbation;  /* of the model; owned */
    int moves;                              /* rb_sensitivity_elements, fixed at first */
    rb_sensitivity_derivative motion[2];    /* by elements that are stretched or shifted by 1 mm */
    double gain[4]; /* derivatives of the computed half-width and centre for these motions */
};

/* Degenerate complementary pairs. BORDER_REST: an element in contact that neither slides nor has
 * friction; only an input that brings it friction must find its zone. */
enum { BORDER_GAP = 1, BORDER_SLIP, BORDER_REST };

/* ---- equations.c ------------------------------------------------------------------- */

/* The part of a residual that bounds and given values make, controls scaled as the
 * unknowns of the base are. */
void rb_sensitivity_given(const rb_rolling_model *base, const rb_contact_problem *problem,
                          const rb_contact_state *state, rb_sensitivity_rate *left);
/* Computes law_slip and law_force.  RB_ENOMEM. */
rb_status rb_sensitivity_law(rb_sensitivity *s, rb_message *why);

/* ---- stencil.c --------------------------------------------------------------------- */

/* Fourth-order differences: around a value, and from it on; of second order around it. */
extern const rb_sensitivity_stencil rb_sensitivity_middle, rb_sensitivity_ahead,
    rb_sensitivity_nearest;

/* ---- variants.c -------------------------------------------------------------------- */

/* By how much the step of bodies is longer where they are wheels; and the part of an input's scale
 * of a step along the tangent within which no other element comes first, and the pressure beside
 * an edge hardly changes. */
#define RB_STEP_OF_WHEELS 4.0
#define RB_STEP_OF_STATE 5e-7

/* An input that cannot vary is a motion of the elements, of this kind. */
typedef struct {
    enum { STRETCH, SHIFT } kind;
    double centre, half; /* of what is stretched */
} rb_sensitivity_move;

/* The model at the values of an input nearby. */
typedef struct {
    const rb_rolling_model *base;
    rb_rolling_perturbation *perturbation; /* of the base */
    int results;                           /* 0: rates alone */
    int bodies;                            /* 1: they or the interlayer change with the input */
    int own; /* 1: the bodies do; where they are compressed, each place has its own */
    rb_sensitivity_stencil at;
    int is_long; /* 1: the step is the longer one of wheels */
    double step, scale;
    rb_rolling_model model[RB_SENSITIVITY_PLACES];
    const rb_rolling_model *of[RB_SENSITIVITY_PLACES]; /* that each has borrowed from */
} rb_sensitivity_variants;

int rb_sensitivity_has_wheels(const rb_rolling_model *model);
/* Step and stencil: both ways where the range allows it.  RB_EINVAL: it allows neither. */
rb_status rb_sensitivity_choose_places(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                       rb_sensitivity_variants *v, rb_message *why);
/* others: for the same values of the input, of the model in free rolling its model; or NULL.
 * The step is made smaller where the elements outside the contact change within it; RB_INACCURATE:
 * they do within every step. */
rb_status rb_sensitivity_variants_create(const rb_rolling_model *base,
                                         const rb_sensitivity_input *input,
                                         const rb_sensitivity_variants *others, int freely,
                                         rb_sensitivity_variants *v, rb_message *why);
void rb_sensitivity_variants_free(rb_sensitivity_variants *v);
/* D2: adds to rate how the equations change while the unknowns stay. */
rb_status rb_sensitivity_rates_at(const rb_sensitivity *s, rb_sensitivity_variants *v,
                                  rb_sensitivity_rate *rate, rb_message *why);

/* ---- results.c --------------------------------------------------------------------- */

/* d = keep d + weight (x - less) of all that has derivatives; NULL: nothing. */
void rb_sensitivity_blend(rb_rolling_solution *d, double keep, const rb_rolling_solution *x,
                          double weight, const rb_rolling_solution *less);
/* In the place of the second of the results moved to the places of a stencil the derivative. */
void rb_sensitivity_combine(const rb_sensitivity *s, const rb_sensitivity_stencil *at, double step,
                            rb_rolling_solution *moved);
/* (D4) derivatives of the results, whose picked ones are to be set. */
rb_status rb_sensitivity_results(const rb_sensitivity *s, rb_sensitivity_variants *v,
                                 const rb_contact_state *tangent, rb_rolling_solution *d,
                                 rb_message *why);
/* 1: the largest strain is that of no layer, a/(2R). */
int rb_sensitivity_follows_half_width(const rb_sensitivity *s);
/* Where both sides of a result are the same but for rounding, they are equal.  1: of all. */
int rb_sensitivity_unite_sides(rb_sensitivity_derivative *d);
/* Sets to 0 what is rounding of the results over the scale of the input. */
void rb_sensitivity_clean(const rb_sensitivity *s, double scale, rb_rolling_solution *d);

/* ---- picked.c ---------------------------------------------------------------------- */

/* Results that are found at elements which a change may exchange for others: the edges of
 * the contact, those that elements follow (D6), and the largest pressure. */
enum { FROM, TO, FOLLOWED_FROM, FOLLOWED_TO, PEAK, PICKED };
typedef struct {
    double of[PICKED];
} rb_sensitivity_picked;

/* Their derivatives by a tangent, and, v not NULL, by the input; state: of the model's size,
 * overwritten. */
rb_sensitivity_picked rb_sensitivity_differentiate_picked(const rb_sensitivity *s,
                                                          const rb_sensitivity_variants *v,
                                                          const rb_contact_state *tangent,
                                                          rb_contact_state *state);
/* Half-width and centre between the edges that elements follow. */
void rb_sensitivity_find_edges(rb_sensitivity_picked x, double edges[2]);
void rb_sensitivity_edges_of(const rb_rolling_model *model, double edges[2]);
/* Sets the edges of the contact, and what follows from them. */
void rb_sensitivity_set_edges(const rb_sensitivity *s, double from, double to,
                              rb_rolling_solution *d);
/* Sets what is picked; strain: becomes the derivatives of what compresses the layers.  v: NULL: no
 * input changes them. */
void rb_sensitivity_set_picked(const rb_sensitivity *s, const rb_sensitivity_variants *v,
                               rb_sensitivity_picked x, double approach, double strain[4],
                               rb_rolling_solution *d);
/* Sets the largest strain of side k from what compresses the layers. */
void rb_sensitivity_set_strain(const rb_sensitivity *s, int k, rb_sensitivity_derivative *d);
/* 1: two are compressed equally now, and not beside. */
int rb_sensitivity_strain_has_sides(const rb_sensitivity *s, const double strain[4]);

/* ---- smooth.c ---------------------------------------------------------------------- */

/* The derivative of the length of all that sticks on side k, whose other results are known: that
 * between two changes of zones, not that of the lengths of elements.  NAN: it is not known. */
double rb_sensitivity_stick_length(const rb_sensitivity *s, double scale,
                                   const rb_sensitivity_derivative *d, int k);

/* ---- differentiate.c --------------------------------------------------------------- */

/* Determines whether and how the elements move.  RB_ENOMEM. */
rb_status rb_sensitivity_set_motion(rb_sensitivity *s);
/* How the state moves where the equations alone change, by these rates; released: element
 * that sticks and begins to slip, or -1.  d: state[0], edges[0] and by[0], without results;
 * free it in any case. */
rb_status rb_sensitivity_along(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                               int released, rb_sensitivity_derivative *d, rb_message *why);
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
