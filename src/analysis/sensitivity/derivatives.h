/* Derivatives of a case in words: of one solution, in columns along a curve, a study or a history,
 * and what follows from uncertain inputs. */
#ifndef ROLLBEM_SRC_ANALYSIS_SENSITIVITY_DERIVATIVES_H
#define ROLLBEM_SRC_ANALYSIS_SENSITIVITY_DERIVATIVES_H

#include "analysis/sensitivity/sensitivity.h"
#include "rolling/case/case.h"

/* ---- Derivatives (sensitivity.h) --------------------------------------------------- */

/* One number of a case with the derivatives of all results with respect to it. */
typedef struct {
    char name[40];    /* of the option; "mu-fall-2": the second number of its list */
    const char *unit; /* of the option */
    double value;     /* [unit] */
    rb_status status; /* RB_OK; otherwise there are no derivatives, and why has the reason */
    rb_message why;
    rb_sensitivity_derivative d;
} rb_case_derivative;

/* A number that the case uses, and how the case depends on it. */
typedef struct {
    char name[40];
    const rb_option *option;
    int entry; /* place in the list of the option, from 0 */
    rb_sensitivity_input input;
    const rb_case *c;
} rb_case_number;
/* All numbers of a resolved case that can be varied; at most RB_CASE_NUMBERS_MAX. number:
 * array of RB_CASE_NUMBERS_MAX entries; it must not be moved, because its entries contain
 * pointers into it. RB_ENOMEM. */
rb_status rb_case_numbers(const rb_case *c, rb_case_number *number, int *n, rb_message *why);

typedef struct {
    int n;
    rb_case_derivative *of;           /* in the order of the options; owned */
    int smooth;                       /* 1: by rb_case_differentiate_smoothly; without over_x */
    int degenerate;                   /* number of elements on the border of two zones */
    rb_sensitivity_elements elements; /* whether elements move when an input changes */
    int n_x;        /* number of elements; 0: over_x was not computed (law that depends on the
                       state, an element on a border, or RB_ROLLING_LARGE elements and more) */
    double *over_x; /* for every rb_case_over_x in turn n_x derivatives with respect to the
                       gap at each element [unit/length], then n_x with respect to its
                       friction coefficient, with fixed elements and fixed creepage; owned */
    rb_units units; /* of results and numbers; mm at first */
} rb_case_derivatives;

/* Differentiates the results of a solved model of the case with respect to the n named
 * numbers (n = 0: all numbers).  all is overwritten; free it in any case. */
rb_status rb_case_differentiate(const rb_case *c, const rb_rolling_model *model, int n,
                                const char *const *names, rb_case_derivatives *all,
                                rb_message *why);
/* The same with smooth derivatives (theory-solvers.md, D8). */
rb_status rb_case_differentiate_smoothly(const rb_case *c, const rb_rolling_model *model, int n,
                                         const char *const *names, rb_case_derivatives *all,
                                         rb_message *why);
/* Says whether the elements move while an input changes: "on the elements of the solution,
 * which do not move". */
const char *rb_case_derivatives_are(const rb_case_derivatives *all);
/* The result `name` if it has derivatives, otherwise NULL.  *is_column is 1 if it has one
 * entry per element. */
const rb_rolling_result *rb_case_derivative_result(const char *name, int *is_column);
/* RB_EINVAL, and why says that `name` is no result of the table that has derivatives, with
 * the one that may have been meant; more: another name that would be accepted (NULL:
 * none). */
rb_status rb_case_refuse_result(const char *name, const rb_rolling_results *table, const char *more,
                                rb_message *why);

/* ---- Derivatives in columns: along a curve, over a study, step by step -------------- */

typedef struct {
    const rb_rolling_result *result;
    char input[40];   /* as rb_case_number.name */
    const char *unit; /* of the input */
} rb_case_slope;

enum { RB_CASE_SLOPES_MAX = 1024, RB_CASE_SLOPE_HEADING = 120 };

typedef struct {
    const rb_rolling_results *table; /* rb_rolling_solution_scalars, or of a history
                                        rb_rolling_history_columns */
    int n, rows;
    rb_case_slope *of; /* n: columns; owned */
    double *value;     /* rows x n x 2, row after row: for a falling and for a growing input
                          (the same where both are alike; of histories always); NAN: none;
                          owned */
    int degenerate;    /* of a history: steps in which elements stand between two zones */
    int stay;          /* of a history: 1: elements of an automatic zone are frozen */
    int without;       /* of a curve: points that have no derivatives, and why the last one
                          has none; of a history: rows, the last ones, and why the first of them */
    rb_message reason;
    const char *tolerance; /* of a curve or a study: uncertain inputs, for the standard
                              deviations of its points or cases; NULL: none; borrowed */
    int deviations;        /* of a study: how many results have them */
    const rb_rolling_result *deviation[RB_ROW_OWN];
    rb_units units; /* mm at first */
} rb_case_slopes;

/* Chooses the columns by words: "all", or a list, separated by commas, of RESULT (with
 * respect to every number of the resolved case) and RESULT:OPTION.  RB_EINVAL: no such
 * result or number, or more than `most` columns.  Free slopes in any case. */
rb_status rb_case_slopes_choose(const rb_case *c, const rb_rolling_results *table,
                                const char *words, int most, rb_case_slopes *slopes,
                                rb_message *why);
/* Adds the standard deviations of those of the n results that have derivatives to the
 * columns of a study; c: one of its cases; tolerance is borrowed.  RB_EINVAL: as of
 * rb_case_read_tolerances, or more than RB_ROW_OWN columns. */
rb_status rb_case_slopes_add_deviations(const rb_case *c, const char *tolerance, int n,
                                        const rb_rolling_result *const *result,
                                        rb_case_slopes *slopes, rb_message *why);
/* Allocates the given number of rows, without values.  RB_ENOMEM. */
rb_status rb_case_slopes_alloc(int rows, rb_case_slopes *slopes);
/* Computes one row of derivatives from a solved model of the case; row: 2 n values, NAN
 * before.  deviation: overwritten with the standard deviations of its results by `tolerance`,
 * of which per cent are those of the case's own numbers; NULL: not wanted. */
rb_status rb_case_slopes_at(const rb_case *c, const rb_rolling_model *model,
                            const rb_case_slopes *slopes, double *row,
                            rb_rolling_solution *deviation, rb_message *why);
/* The same as one number per column, as rb_case_slope_value, and behind them the standard
 * deviations of the results of `deviation`, together at most RB_ROW_OWN; a case without
 * derivatives has NAN.  RB_ENOMEM alone. */
rb_status rb_case_slopes_row(const rb_case *c, const rb_rolling_model *model,
                             const rb_case_slopes *slopes, double *row, rb_message *why);
/* The derivative for a growing input, or for a falling one if the input cannot grow. */
double rb_case_slope_value(const rb_case_slopes *slopes, int row, int k);
/* Writes the name of a column: "d_tangential_load_N/mm_by_radius_mm". */
const char *rb_case_slope_heading(const rb_case_slope *of, rb_units units,
                                  char text[RB_CASE_SLOPE_HEADING]);
/* Writes what must be known to read the columns: points without derivatives, steps with
 * one-sided ones.  0: nothing, note is empty. */
int rb_case_slopes_note(const rb_case_slopes *slopes, rb_message *note);
/* Converts a derivative from mm, N, MPa to other units. */
double rb_case_slope_shown(const rb_case_slope *of, rb_units units, double x);
void rb_case_slopes_convert(rb_case_slopes *slopes, rb_units units);
void rb_case_slopes_free(rb_case_slopes *slopes);

/* Chooses the columns of a curve (words NULL: none) and checks uncertain inputs, as
 * rb_case_read_tolerances reads them (NULL: none); the purpose of the case must be a curve. */
rb_status rb_case_curve_choose(const rb_case *c, const rb_rolling_range *range, const char *words,
                               const char *tolerance, rb_case_slopes *slopes, rb_message *why);
/* rb_rolling_curve_observe with these derivatives and standard deviations at each point
 * (point NULL: nobody observes).  RB_EINVAL: no point has derivatives. */
rb_status rb_case_curve_solve(const rb_case *c, const rb_rolling_range *range, double mu,
                              rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                              rb_case_slopes *slopes, rb_message *why);
/* RB_EINVAL: histories of the resolved case have no derivatives: a given approach, or
 * RB_ROLLING_LARGE elements and more (of bodies that relax only their solution tells). */
rb_status rb_case_slopes_check_steps(const rb_case *c, rb_message *why);

/* Uncertain inputs with their standard deviations, as in "mu=0.02,radius=1%"; the inputs
 * are independent. */
enum { RB_CASE_TOLERANCES_MAX = 32 };
typedef struct {
    int n;
    char name[RB_CASE_TOLERANCES_MAX][40];
    const char *unit[RB_CASE_TOLERANCES_MAX];                                /* of the options */
    double value[RB_CASE_TOLERANCES_MAX], deviation[RB_CASE_TOLERANCES_MAX]; /* mm, N, MPa */
} rb_case_tolerances;

/* Reads such a text.  RB_EINVAL: a name is not a number of the case, or a deviation is
 * not >= 0; why names it. */
rb_status rb_case_read_tolerances(const rb_case *c, const char *text, rb_case_tolerances *t,
                                  rb_message *why);
/* Derivatives by these inputs as standard deviations take them: smooth where there are smooth
 * ones, because a deviation spans many changes of zones; otherwise those of the discrete case. */
rb_status rb_case_differentiate_by_tolerances(const rb_case *c, const rb_rolling_model *model,
                                              const rb_case_tolerances *t, rb_case_derivatives *all,
                                              rb_message *why);
/* Standard deviations of all results of a solved case to first order, each in the field of the
 * result (NAN: none), in mm, N, MPa.  RB_EINVAL: an input has no derivatives. */
rb_status rb_case_deviations(const rb_case *c, const rb_rolling_model *model,
                             const rb_case_tolerances *t, rb_rolling_solution *deviation,
                             rb_message *why);
/* The same from derivatives in mm, N, MPa that include these inputs. */
rb_status rb_case_propagate(const rb_case_tolerances *t, const rb_case_derivatives *all,
                            rb_rolling_solution *deviation, rb_message *why);

/* Derivatives of the history whose states are given, carried from step to step; if the two
 * sides differ, those for growing inputs.  slopes: which ones, or NULL.  t: NULL, or inputs whose
 * standard deviations become, to first order, the `deviations` of the history (NULL without t).
 * RB_EINVAL: as rb_case_slopes_check_steps, or too many elements. */
rb_status rb_case_slopes_of_steps(const rb_case *c, const rb_rolling_states *states,
                                  rb_case_slopes *slopes, const rb_case_tolerances *t,
                                  rb_rolling_history *history, rb_message *why);

/* From mm, N, MPa to other units, once. */
void rb_case_derivatives_convert(rb_case_derivatives *all, rb_units units);
void rb_case_derivatives_free(rb_case_derivatives *all);

/* ---- For the other analyses --------------------------------------------------------- */

/* As rb_case_differentiate, but without over_x. */
rb_status rb_case_differentiate_by_numbers(const rb_case *c, const rb_rolling_model *model, int n,
                                           const char *const *names, rb_case_derivatives *all,
                                           rb_message *why);
/* Puts the option before a refusal of its text.  Returns s. */
rb_status rb_case_name_option(const char *option, rb_status s, rb_message *why);

/* Adds a name unless it is among the n; returns how many there are then. */
int rb_case_add_name(const char *name[RB_CASE_NUMBERS_MAX], int n, const char *one);
/* The inputs of the columns, each once; returns how many. */
int rb_case_slope_inputs(const rb_case_slopes *s, const char *name[RB_CASE_NUMBERS_MAX]);

#endif
