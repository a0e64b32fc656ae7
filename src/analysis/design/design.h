/* Minimises or maximises a result over numbers of a case within bounds, with constraints
 * on other results, by sequential quadratic programming (NLopt's SLSQP) with the exact
 * gradients of sensitivity.h.  This is not part of the core, because it needs NLopt. */
#ifndef ROLLBEM_DESIGN_H
#define ROLLBEM_DESIGN_H

#include "rolling/case/case.h"

enum { RB_DESIGN_CONSTRAINTS = 16 };

/* 1: this library was built with NLopt. */
int rb_design_available(void);

typedef struct {
    char name[40];
    const char *unit;
    double low, high; /* mm, N, MPa, like all values here */
    double start, value;
} rb_design_variable;

/* A result of a solution; NULL: the ripple of the pressure, which is the root mean square
 * deviation of the pressure from its mean over the span, divided by this mean. */
typedef struct {
    const rb_rolling_result *result;
    int at_least; /* 1: >= bound, 0: <= bound */
    double bound, value;
} rb_design_constraint;

typedef struct {
    const rb_rolling_result *result; /* NULL: the ripple, or the input */
    const rb_option *input;          /* a number of the case that is varied; NULL: a result */
    int input_at;                    /* its variable */
    int largest;                     /* 1: maximise, 0: minimise */
    int n;
    rb_design_variable *variable; /* n; owned */
    int gap_from, gap_n;          /* variables that are values of the table of the gap */
    const double *gap_x;          /* their places; borrowed from the case */
    int constraints;
    rb_design_constraint constraint[RB_DESIGN_CONSTRAINTS];
    double span;         /* half-width of the interval for the ripple [length]; 0: all elements */
    int most;            /* maximum number of evaluations; 0: 200 */
    double start, value; /* of the result */
    int evaluations;
    rb_status status;
} rb_design;

/* "radius=10:100,gap=-0.05:0.05": variables with their bounds in the units of the case;
 * gap: bounds on the change of every value of its table.  Allocates d->variable.
 * RB_EINVAL: a name is not a number of the case that can be varied, or its value is not
 * within the bounds. */
rb_status rb_design_variables(const rb_case *c, const char *text, rb_design *d, rb_message *why);
/* Reads constraints, for example "max_pressure<=400,tangential_load>=-50". */
rb_status rb_design_constraints(const rb_case *c, const char *text, rb_design *d, rb_message *why);
/* Sets the objective: a result that has derivatives, "pressure_ripple", or a number of the case
 * that rb_design_variables, called afterwards, finds among the variables. */
rb_status rb_design_objective(const char *name, rb_design *d, rb_message *why);

/* The name of a result, where NULL is the ripple. */
const char *rb_design_result_name(const rb_rolling_result *result);

/* The name and the unit of the objective; unit NULL: none. */
const char *rb_design_name(const rb_design *d);
const char *rb_design_unit(const rb_design *d);

/* Called after each evaluation; a return value other than 0 ends the search. */
typedef struct {
    int (*step)(int evaluation, double value, const double *x, void *context);
    void *context;
} rb_design_observer;

/* Searches the optimum, starting from the values of the case.  RB_EINVAL: a case with
 * steps or error bars, or no NLopt; RB_MAXITER, RB_INTERRUPTED: d holds the best values
 * so far; RB_INACCURATE: the constraints cannot be satisfied. */
rb_status rb_design_solve(const rb_case *c, const rb_design_observer *observer, rb_design *d,
                          rb_message *why);
void rb_design_free(rb_design *d);

#endif
