/* Fits of a case in words to measured numbers. */
#ifndef ROLLBEM_SRC_ANALYSIS_FIT_FIT_CASE_H
#define ROLLBEM_SRC_ANALYSIS_FIT_FIT_CASE_H

#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"

/* ---- Fits to measured creep curves (theory-solvers.md, D5) ---------------------------------- */

enum { RB_CASE_FIT_MAX = 12 };

/* The quantity that was measured as force. */
typedef enum {
    RB_CASE_FORCE,          /* Q */
    RB_CASE_FORCE_RATIO,    /* Q/(mu P), mu the largest coefficient of the law */
    RB_CASE_FORCE_OVER_LOAD /* Q/P */
} rb_case_measure;

/* n measured points.  A column is NULL if it was not measured; the value of the case then
 * applies.  Borrowed; mm, N, MPa. */
typedef struct {
    int n, is_ratio; /* 1: creep is xi R/(mu a) */
    rb_case_measure measure;
    const double *creep, *force;
    const double *load, *speed, *temperature;
    const double *sigma; /* standard deviations of the forces; NULL: unknown and equal */
} rb_case_data;

/* A parameter of a fit: a number of the case, named as its option, or "creep-offset",
 * which is added to the measured creepage.  The caller sets name, start (NAN: chosen from
 * the case or the data), low and high (-INFINITY, INFINITY: the range of the option). */
typedef struct {
    char name[40];
    double start, low, high;
    /* found: */
    const char *unit;
    double value, interval[2], deviation; /* Student's interval; standard deviation */
    double mesh; /* what the mesh leaves in the value, of a case with error bars; NAN: not known */
    double correlation[RB_CASE_FIT_MAX]; /* with the other parameters; NAN: not known */
    int identified, at_bound;
    double from, to, scale;
    int low_open, high_open, positive;
} rb_case_parameter;

typedef struct {
    int n;
    rb_case_parameter parameter[RB_CASE_FIT_MAX];
    double level; /* confidence level of the intervals, for example 0.95 */
    /* found: */
    rb_status status;
    int iterations; /* steps; on entry those of a fit that this one continues */
    int degrees_of_freedom, unidentified;
    double chi_square, noise; /* noise: standard deviation of a force, as a multiple of
                                 sigma if sigma is given */
    double kappa;             /* the largest value; 0: friction does not depend on the state */
    double *model, *band;     /* forces of the fit and half-widths of their intervals; owned */
    char sentences[1000];     /* what the data do not determine, one line each */
} rb_case_fit;

typedef struct {
    /* Called after each step; a return value other than 0 ends the fit. */
    int (*step)(int iteration, double chi_square, int n, const double *value, void *context);
    void *context;
} rb_case_fit_observer;

/* What is fitted, in words. */
typedef struct {
    const char *names;          /* "mu,creep-offset" */
    const char *start, *bounds; /* "mu=0.3,load=2kN/m"; "mu=0.1:0.6"; NULL: none.  Numbers without
                                   a unit are in the units of the case */
    double sigma;               /* standard deviation of all forces; NAN: unknown, or a column */
} rb_case_fit_words;

/* Reads these words into fit and the data of a table with named columns, and prepares the case
 * (rb_case_prepare_fit).  The table is that of the file path unless it has rows; then path is what
 * it is called in messages, and without table->line they name rows.  It is converted to mm, N, MPa,
 * and data borrows from it.  RB_EINVAL: names or values of other numbers than can be fitted;
 * RB_EFORMAT: a column is missing or misspelt, or a value is not finite. */
rb_status rb_case_fit_read(rb_case *c, const rb_case_fit_words *words, const char *path,
                           rb_io_table *table, rb_case_data *data, rb_case_fit *fit,
                           rb_message *why);

/* Sets options that a fit needs and the case does not give: a velocity-dependent friction
 * law, a speed and related options.  Call it before rb_case_resolve. */
rb_status rb_case_prepare_fit(rb_case *c, const rb_case_data *data, const rb_case_fit *fit,
                              rb_message *why);
/* Fits the parameters to the data, which give creepages and forces (RB_CASE_CURVE refuses
 * those of a case).
 * On entry fit has n, names, starts, bounds, level and iterations; free it in any case.  RB_EINVAL:
 * a name is not a number of the case, or there are too few points; RB_INACCURATE: kappa > 1;
 * RB_MAXITER: no minimum was found, or numbers around it have a lesser sum of squares, or the
 * elements let the sum jump by more than the noise: fit holds the last values, as after
 * RB_INTERRUPTED. */
rb_status rb_case_fit_solve(const rb_case *c, const rb_case_data *data,
                            const rb_case_fit_observer *observer, rb_case_fit *fit,
                            rb_message *why);
void rb_case_fit_free(rb_case_fit *fit);

#endif
