/* Derivatives of a solved case with respect to its numbers (theory.md, D1 ... D4), by the
 * linear problem with the zones of the solution: tractions, approach and creepage change
 * along the tangent of this problem, and every result changes with them.  Elements that
 * the program has placed move with the contact, as they do in a solve with another value.
 * If the elements stay while the contact grows, the derivative has an error that does not
 * vanish with more elements (D6); elements that the case places do stay.  Derivatives are
 * exact up to rounding.  Differences are taken only of the data of a problem
 * (flexibility, gap, bounds, controls) and of how results depend on the tractions, never
 * of a solution.
 *
 * If an element is at the border of two zones (both sides of a complementary pair are 0),
 * the solution has two derivatives, one on each side, and both are given. */
#ifndef ROLLBEM_SENSITIVITY_H
#define ROLLBEM_SENSITIVITY_H

#include "rollbem/base.h"
#include "rollbem/rolling.h"

RB_PUBLIC_BEGIN

/* A solved model with the factors of its Jacobian; opaque. */
typedef struct rb_sensitivity rb_sensitivity;

/* results: 1: of all results, with the creepage of free rolling, which is a solution of
 * its own; 0: for tangents, adjoints and rates alone. model: solved, borrowed, unchanged
 * as long as s lives; of one step, or without results of a step of a history, whose past
 * stays.  RB_EINVAL: steps, or what has no derivative (the line says what); RB_SINGULAR,
 * RB_ENOMEM.  RB_INACCURATE: the state is no solution. */
rb_status rb_sensitivity_create(const rb_rolling_model *model, int results,
                                rb_sensitivity **s, rb_message *why);
void rb_sensitivity_free(rb_sensitivity *s);
/* What the elements do while an input changes. */
typedef enum {
    RB_SENSITIVITY_FIXED, /* they stay: a given zone, several patches, a border */
    RB_SENSITIVITY_HERTZ, /* equal ones of an automatic zone: as Hertz's half-width */
    RB_SENSITIVITY_EDGES  /* fitted ones: with the edges of the contact */
} rb_sensitivity_elements;

rb_sensitivity_elements rb_sensitivity_motion(const rb_sensitivity *s);
/* Elements at the border of two zones. */
int rb_sensitivity_degenerate(const rb_sensitivity *s);

/* How the equations change with an input while the unknowns stay: their partial
 * derivatives, n each. */
typedef struct {
    int n;
    double *gap, *slip;        /* of the gap [length/input], of T_T lambda */
    double *bound;             /* of the coefficient of friction */
    double *yield;             /* of the yield stress of the interface */
    double normal, tangential; /* of the two controls' equations, scaled */
} rb_sensitivity_rate;

rb_status rb_sensitivity_rate_alloc(int n, rb_sensitivity_rate *rate);
void rb_sensitivity_rate_free(rb_sensitivity_rate *rate);
/* to += times rate. */
void rb_sensitivity_rate_add(const rb_sensitivity_rate *rate, double times,
                             rb_sensitivity_rate *to);
/* What is left of the equations of the model's zones at the unknowns that the variant
 * has: as a rate has it, and without a difference. */
void rb_sensitivity_residual(const rb_rolling_model *base,
                             const rb_rolling_model *variant, rb_sensitivity_rate *left);

/* D2: J y' = -R'.  y': p, q, delta, xi per unit of the input, for an input that grows
 * (side 1) or falls (-1); without degenerate elements both are the same.  RB_MAXITER: the
 * zones of a degenerate element were not found. */
rb_status rb_sensitivity_tangent(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                                 int side, rb_contact_state *tangent, rb_message *why);

/* D3: weights of rates in the derivative of a number f = weight . (p, q, delta, xi):
 * f' = f_input + adjoint . R'.  One transposed solve per number, for any number of
 * inputs.  weight, adjoint: as a state and as a rate.  At a border: of the zones that the
 * state has.  RB_EINVAL: a problem without matrices. */
rb_status rb_sensitivity_adjoint(const rb_sensitivity *s, const rb_contact_state *weight,
                                 rb_sensitivity_rate *adjoint, rb_message *why);
double rb_sensitivity_dot(const rb_sensitivity_rate *adjoint,
                          const rb_sensitivity_rate *rate);

/* ---- With respect to numbers of a case --------------------------------------------- */

/* A number that a case is made from. */
typedef struct {
    double value;
    double scale;    /* > 0: differences are taken over a small part of it */
    double from, to; /* its range */
    /* The case with another value of it. */
    rb_status (*vary)(void *context, double value, rb_rolling_case *rc, rb_message *why);
    void *context;
} rb_sensitivity_input;

/* A first derivative from values at so many places, of fourth order. */
enum { RB_SENSITIVITY_PLACES = 5 };
typedef struct {
    int n;
    double place[RB_SENSITIVITY_PLACES], weight[RB_SENSITIVITY_PLACES]; /* in steps */
} rb_sensitivity_stencil;
/* Both ways where the range of the input allows it, else one way; NULL: neither. */
const rb_sensitivity_stencil *rb_sensitivity_stencil_of(const rb_sensitivity_input *input,
                                                        double step);

/* How the equations change with the input; mu: how its largest coefficient does.  rate:
 * overwritten; free it in any case. */
rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why);

/* Derivatives of all results of the model, in the places of the results: value[0] for
 * a falling, value[1] for a growing input.  Whole numbers, proofs and places that are
 * known to an element only have none (NAN). */
typedef struct {
    int sides;  /* 1: value[0] holds for both; 2: they differ, or the range ends here */
    int has[2]; /* 0: the input cannot go there */
    rb_rolling_solution value[2];
    rb_sensitivity_rate rate; /* of the side that there is */
} rb_sensitivity_derivative;

/* derivative: overwritten; free it in any case. */
rb_status rb_sensitivity_differentiate(const rb_sensitivity *s,
                                       const rb_sensitivity_input *input,
                                       rb_sensitivity_derivative *derivative,
                                       rb_message *why);
void rb_sensitivity_derivative_free(rb_sensitivity_derivative *derivative);

/* Multiplies all derivatives of a side. */
void rb_sensitivity_scale(rb_rolling_solution *value, double factor);

/* The change of a result over the scale of an input that is rounding: a part of its value
 * and of what is usual for its unit in this case. */
double rb_sensitivity_rounding(const rb_rolling_case *rc, const rb_rolling_result *result,
                               double value);

/* 1: the result has a derivative. */
int rb_sensitivity_has(const rb_rolling_result *result);

RB_PUBLIC_END

#endif
