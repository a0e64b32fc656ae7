/* Derivatives of a solved case with respect to its numbers (theory-solvers.md, D1 ... D4).  With
 * the zones of the solution the problem is linear; its tangent gives the derivatives of
 * tractions, approach and creepage, and from these follow the derivatives of all results.
 * Elements that the program has placed move with the contact, as they do in a solve with
 * another value. If the elements did not move while the contact grows, the derivative
 * would have an error that does not vanish with more elements (D6).  Elements at places
 * given in the case do not move.  Derivatives are exact up to rounding.  Differences are
 * taken only of the data of a problem (flexibility, gap, bounds, controls) and of how
 * results depend on the tractions, never of a solution.
 *
 * If an element is at the border of two zones (both sides of a complementary pair are 0),
 * the solution has two derivatives, one on each side, and both are given. */
#ifndef ROLLBEM_SENSITIVITY_H
#define ROLLBEM_SENSITIVITY_H

#include "base/base.h"
#include "rolling/rolling.h"

/* A solved model with the factors of its Jacobian; opaque. */
typedef struct rb_sensitivity rb_sensitivity;

/* results: 1: prepare derivatives of all results, including the free-rolling creepage,
 * which needs another solution; 0: only tangents, adjoints and rates.  model: solved,
 * borrowed; it must not change until s is freed.  With results = 1 it must be a case of
 * one step; with 0 it may be a step of a history, whose earlier steps are kept fixed.
 * RB_EINVAL: a case with steps, or a case without derivatives (why has the reason);
 * RB_SINGULAR, RB_ENOMEM.  RB_INACCURATE: the state is no solution. */
rb_status rb_sensitivity_create(const rb_rolling_model *model, int results, rb_sensitivity **s,
                                rb_message *why);
/* The same without results; factors that are those of `like` are copied from it (NULL:
 * none), for models that share their flexibility. */
rb_status rb_sensitivity_create_like(const rb_rolling_model *model, const rb_sensitivity *like,
                                     rb_sensitivity **s, rb_message *why);
void rb_sensitivity_free(rb_sensitivity *s);
/* How the elements move while an input changes. */
typedef enum {
    RB_SENSITIVITY_FIXED, /* not at all: given zone, several patches, or an element at the
                             border of two zones */
    RB_SENSITIVITY_ZONE,  /* equal elements of an automatic zone: with the half-width that it
                             follows (rb_rolling_zone_half_width) */
    RB_SENSITIVITY_EDGES  /* fitted elements: with the edges of the contact */
} rb_sensitivity_elements;

rb_sensitivity_elements rb_sensitivity_motion(const rb_sensitivity *s);
/* Number of elements at the border of two zones. */
int rb_sensitivity_degenerate(const rb_sensitivity *s);

/* Partial derivatives of the equations with respect to an input, for fixed unknowns; n
 * values each. */
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
/* Completes the variant.  Residual of the equations of the model's zones at its unknowns,
 * in the form of a rate (but not a difference): bound and yield are those of the variant,
 * from which a residual proper would subtract what the tractions ask for. */
rb_status rb_sensitivity_residual(const rb_rolling_model *base, rb_rolling_model *variant,
                                  rb_sensitivity_rate *left, rb_message *why);
/* Sets the coefficients of friction of a variant whose state is that of the model, or moved along
 * a tangent, to first order in the changes of the slips and of the friction.  RB_ENOMEM. */
rb_status rb_sensitivity_set_law(const rb_sensitivity *s, rb_rolling_model *variant,
                                 rb_message *why);
/* D2: rate += times what the equations of the model leave in the variant at the model's
 * unknowns, with the bounds of rb_sensitivity_set_law; by the weights of a difference formula the
 * sum over variants is a rate.  left: overwritten. */
rb_status rb_sensitivity_add_variant(const rb_sensitivity *s, rb_rolling_model *variant,
                                     double times, rb_sensitivity_rate *left,
                                     rb_sensitivity_rate *rate, rb_message *why);

/* D2: J y' = -R'.  y': derivatives of p, q, delta, xi for a growing (side 1) or falling
 * (-1) input; both are equal if no element is degenerate.  RB_MAXITER: the zones of a
 * degenerate element were not found. */
rb_status rb_sensitivity_tangent(const rb_sensitivity *s, const rb_sensitivity_rate *rate, int side,
                                 rb_contact_state *tangent, rb_message *why);

/* D3: weights of rates in the derivative of a number f = weight . (p, q, delta, xi): f' =
 * f_input + adjoint . R'.  One transposed solve per number, for any number of inputs.
 * weight has the form of a state, adjoint that of a rate.  For elements at the border of
 * two zones the zones of the state are used.  RB_EINVAL: a problem without matrices. */
rb_status rb_sensitivity_adjoint(const rb_sensitivity *s, const rb_contact_state *weight,
                                 rb_sensitivity_rate *adjoint, rb_message *why);
double rb_sensitivity_dot(const rb_sensitivity_rate *adjoint, const rb_sensitivity_rate *rate);

/* Solves v, a variant of the model that is close to it, from the solution of the model: by
 * Newton's method with its Jacobian, and with that of other zones where these change.
 * v has a residual within the tolerance of its case; RB_MAXITER, RB_SINGULAR: it has not. */
rb_status rb_sensitivity_follow(const rb_sensitivity *s, rb_rolling_model *v, rb_message *why);
/* Continues the solution of the model beyond the border of an element's zone: v, a variant
 * of the model, solves the equations with the element in `zone`, even if its gap,
 * tractions and slip ask for another one.  *extended: its Jacobian.  v, *extended: zero on
 * entry; free both in any case.  RB_EINVAL: no matrices; RB_MAXITER, RB_SINGULAR. */
rb_status rb_sensitivity_extend(const rb_sensitivity *s, int element, int zone, rb_rolling_model *v,
                                rb_sensitivity **extended, rb_message *why);

/* ---- With respect to numbers of a case --------------------------------------------- */

/* An input: a number of a case. */
typedef struct {
    double value;
    double scale;    /* > 0; difference steps are a small fraction of it */
    double from, to; /* its range */
    /* Makes the case with another value of this number. */
    rb_status (*vary)(void *context, double value, rb_rolling_case *rc, rb_message *why);
    void *context;
} rb_sensitivity_input;

/* Difference steps, parts of an input's scale: where flexibilities change, which are known to fewer
 * digits, and where they do not. */
#define RB_SENSITIVITY_STEP_OF_BODIES 5e-4
#define RB_SENSITIVITY_STEP 2e-5

/* Difference formula of fourth order for a first derivative. */
enum { RB_SENSITIVITY_PLACES = 5 };
typedef struct {
    int n;
    double place[RB_SENSITIVITY_PLACES], weight[RB_SENSITIVITY_PLACES]; /* in steps */
} rb_sensitivity_stencil;
/* A central formula if the range of the input allows it, otherwise a one-sided one; NULL:
 * neither is possible. */
const rb_sensitivity_stencil *rb_sensitivity_stencil_of(const rb_sensitivity_input *input,
                                                        double step);

/* Of a step of a history: derivatives of what is found at single elements, which a step of the
 * input may exchange for others. */
typedef struct {
    double contact_from, contact_to, max_pressure;
    double max_temperature; /* 0: not computed */
} rb_sensitivity_at_elements;

/* variant: the model at the places of the stencil, where the step has ended as it has in the
 * model; tangent: of the state of the model by the input.  RB_ENOMEM. */
rb_status rb_sensitivity_differentiate_at_elements(const rb_sensitivity *s,
                                                   const rb_sensitivity_input *input,
                                                   const rb_sensitivity_stencil *at, double step,
                                                   rb_rolling_model *const variant[],
                                                   const rb_contact_state *tangent,
                                                   rb_sensitivity_at_elements *d);

/* Computes the rate of the equations with respect to the input, for fits, from two values
 * of the input instead of four (seven digits); mu: derivative of the largest friction
 * coefficient.  rate: overwritten; free it in any case. */
rb_status rb_sensitivity_rates(const rb_sensitivity *s, const rb_sensitivity_input *input,
                               rb_sensitivity_rate *rate, double *mu, rb_message *why);

/* Derivatives of all results of the model, each in the field of the result: value[0] for
 * a falling, value[1] for a growing input.  Integers, residuals and places known only to
 * within one element have no derivative (NAN). */
typedef struct rb_sensitivity_derivative {
    int sides;  /* 1: value[0] holds for both; 2: they differ, or the range ends here */
    int has[2]; /* 0: the range of the input ends there */
    rb_rolling_solution value[2];
    rb_sensitivity_rate rate;  /* for the side that exists */
    rb_contact_state state[2]; /* of p, q, delta, xi, and slip in lambda, on elements that move
                                  as the input says alone */
    double edges[2][2];  /* half-width and centre between the edges that elements follow (D6), as
                            state */
    double by[2][2];     /* how much the elements are stretched and shifted besides */
    double strain[2][4]; /* of what compresses the layers (rb_rolling_strains) */
    struct rb_sensitivity_derivative *free_rolling; /* of the case in free rolling, without
                                                       results; NULL: none; owned */
    double stays[2]; /* smooth derivatives: changes of the input, < 0 and > 0, to first order,
                        where the next elements change between stick and slip */
} rb_sensitivity_derivative;

/* derivative: overwritten; free it in any case. */
rb_status rb_sensitivity_differentiate(const rb_sensitivity *s, const rb_sensitivity_input *input,
                                       rb_sensitivity_derivative *derivative, rb_message *why);
void rb_sensitivity_derivative_free(rb_sensitivity_derivative *derivative);

/* What derivatives jump by where the boundaries between stick and slip move by one element
 * (D8); opaque. */
typedef struct rb_sensitivity_jumps rb_sensitivity_jumps;
/* s: made with results, borrowed.  RB_EINVAL: an element exactly between two zones, a zone of
 * one element, friction with memory or heat, an interface that yields.  RB_SINGULAR,
 * RB_ENOMEM. */
rb_status rb_sensitivity_jumps_create(const rb_sensitivity *s, rb_sensitivity_jumps **jumps,
                                      rb_message *why);
void rb_sensitivity_jumps_free(rb_sensitivity_jumps *jumps);
/* Makes a derivative of s continuous where an element changes between stick and slip, and
 * sets `stays`.  RB_EINVAL: the input moves the edges of the contact over the elements. */
rb_status rb_sensitivity_smooth(const rb_sensitivity_jumps *jumps,
                                const rb_sensitivity_input *input,
                                rb_sensitivity_derivative *derivative, rb_message *why);

/* Multiplies all derivatives of one side by factor. */
void rb_sensitivity_scale(rb_rolling_solution *value, double factor);

/* Change of a result over the scale of an input below which it is a rounding error: a
 * fraction of its value and of the typical size of its unit in this case. */
double rb_sensitivity_rounding(const rb_rolling_case *rc, const rb_rolling_result *result,
                               double value);

/* 1: the result has a derivative. */
int rb_sensitivity_has(const rb_rolling_result *result);

#endif
