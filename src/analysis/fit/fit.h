/* A fit of numbers of a case to measured forces (theory-solvers.md, D5): what the files of this
 * folder share. */
#ifndef ROLLBEM_CASE_FIT_H
#define ROLLBEM_CASE_FIT_H

#include "analysis/fit/fit_case.h"
#include "rolling/case/words.h"

/* A measured point.  Points that share elements have these and their flexibility from
 * the first of them. */
typedef struct {
    int first;             /* number of the point with the elements */
    rb_rolling_model base; /* with the elements, if it is this one */
    /* Solved with the accepted numbers and with those of a trial: a variant of the base,
     * or of the first point's. */
    rb_rolling_model solved[2];
    rb_sensitivity *factors[2]; /* of these, where they are known */
} fit_point;

/* A case with number `varied` (-1: none) changed to `value`, as it was resolved for a
 * point. */
typedef struct {
    int varied, point;
    double value;
    rb_rolling_case rc;
} fit_case;

enum { FIT_CASES = (RB_SENSITIVITY_PLACES + 1) * RB_CASE_FIT_MAX + 1 };

typedef struct {
    const rb_case *c;
    const rb_case_data *data;
    rb_case_fit *fit;
    int n, points, offset; /* parameters; which one is the offset of creepage, or -1 */
    const rb_option *option[RB_CASE_FIT_MAX], *creep, *load, *speed, *temperature;
    fit_point *at;   /* points */
    int accepted;    /* which of `solved` is that of the accepted numbers; -1: none is */
    fit_case *known; /* FIT_CASES: cases with the numbers known_for */
    int known_n;
    double known_for[RB_CASE_FIT_MAX];
    int moves;     /* 1: elements move with the numbers */
    int *order;    /* points: those first that have ended a sum before all were solved */
    double *f, *J; /* points: residuals of the last trial; points x n: derivatives of those
                      of the accepted numbers */
    double staying[RB_CASE_FIT_MAX]; /* the largest entries of the columns of J on elements that
                                        stay */
    double kappa;                    /* the largest of all points, with the numbers of J */
} fit_problem;

/* ---- points.c ---------------------------------------------------------------------- */

/* Makes the elements of all points for the numbers theta.  *moved: 1: some are others
 * than before. */
rb_status rb_case_fit_place(fit_problem *p, const double *theta, int *moved, rb_message *why);
/* Solves all points for a trial: f and chi^2. */
rb_status rb_case_fit_try(fit_problem *p, const double *theta, double *chi2, rb_message *why);
/* Accepts the numbers of the last trial: factors, J, kappa and the forces of the fit. */
rb_status rb_case_fit_accept(fit_problem *p, const double *theta, rb_message *why);
/* The residual of point k, and its derivatives, with the accepted numbers and an element
 * in another zone (rb_sensitivity_extend). */
rb_status rb_case_fit_extend(fit_problem *p, const double *theta, int k, int element, int zone,
                             double *f, double *row, rb_message *why);
/* Gives J the derivatives on elements that move with the numbers (theory-solvers.md, D6); columns
 * of numbers that change nothing then are 0.  And kappa of the elements for theta. */
rb_status rb_case_fit_move(fit_problem *p, const double *theta, rb_message *why);
/* The sum of squares for theta, on elements of their own where these move, as far as it is below
 * `limit`: larger, or INFINITY, otherwise.  f: the residuals of all points, with limit INFINITY;
 * NULL: not asked for. INFINITY where a point has no solution. */
rb_status rb_case_fit_sum(fit_problem *p, const double *theta, double limit, double *f, double *sum,
                          rb_message *why);
/* The largest kappa (theory-rolling.md, F3) of the points for theta, without solving them:
 * pressures hardly depend on friction.  memory: the sliding distance of friction with memory; NAN:
 * the case's. */
rb_status rb_case_fit_kappa(fit_problem *p, const double *theta, double memory, double *kappa,
                            rb_message *why);
/* Frees the solutions of all points with the accepted numbers, or those of a trial. */
void rb_case_fit_release(fit_problem *p, int which);
/* Of a force that the model gives point k. */
double rb_case_fit_residual(const fit_problem *p, int k, double model);

/* ---- descent.c --------------------------------------------------------------------- */

/* Moves theta to the least sum of squares. */
rb_status rb_case_fit_descend(fit_problem *p, double *theta, const rb_case_fit_observer *observer,
                              rb_message *why);
/* After each step: 1 more.  RB_INTERRUPTED: the observer (or NULL) wants no other. */
rb_status rb_case_fit_tell(rb_case_fit *fit, const rb_case_fit_observer *o, double chi2,
                           const double *theta, rb_message *why);
/* 1: number j has the value x at a bound that the sum of squares, with f and J, presses against. */
int rb_case_fit_is_held(const fit_problem *p, int j, double x);
/* Moves a number into its bounds. */
void rb_case_fit_clip(const rb_case_parameter *of, double *x);

/* ---- search.c ---------------------------------------------------------------------- */

/* Looks for lesser sums around theta, with the J of the accepted numbers, and goes there.  *found:
 * 1: there was one.  squares: of all measured forces over their deviations. */
rb_status rb_case_fit_search(fit_problem *p, double squares, double *theta, int *found,
                             rb_message *why);

/* By how much the residuals leave parabolas where the number that is known least moves by 8 % to
 * either side, and the others follow it: a standard deviation. */
rb_status rb_case_fit_roughness(fit_problem *p, const double *theta, double *roughness,
                                rb_message *why);

/* ---- words.c ----------------------------------------------------------------------- */

/* RB_EINVAL: not the name of a number that can be fitted. */
rb_status rb_case_fit_check_name(const char *name, rb_message *why);

/* ---- For all of them --------------------------------------------------------------- */

/* GSL's header of BLAS and OpenBLAS's exclude each other. */
static inline double fit_dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Column j of J. */
static inline double *fit_column(const fit_problem *p, int j)
{
    return p->J + (size_t)j * (size_t)p->points;
}

#endif
