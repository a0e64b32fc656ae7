/* A case whose options are set by name.  One table holds every option of a case (name,
 * section, unit, range, choices, default, help).  The command line, case files, JSON
 * `inputs`, --help, studies and callers of this library all use this table.
 *
 *     rb_case *c = rb_case_create(RB_CASE_SINGLE);
 *     rb_case_set(c, "support", "halfplane", RB_GIVEN_ARGUMENT, &why);
 *     rb_case_set_number(c, "load", 500.0, &why);
 *     if (rb_case_resolve(c, &why) == RB_OK)
 *         rb_case_solve(rb_case_resolved(c), NULL, NULL, &result, &why);
 *     rb_case_result_free(&result);
 *     rb_case_free(c);
 *
 * Nothing here prints.  An error is a status and a message of one line: RB_EINVAL if an
 * argument is wrong, RB_EFORMAT if the content of a file is wrong, RB_ENOENT if there is
 * no such file. */
#ifndef ROLLBEM_CASE_H
#define ROLLBEM_CASE_H

#include "rollbem/base.h"
#include "rollbem/io.h"
#include "rollbem/io_contact.h"
#include "rollbem/crack.h"
#include "rollbem/options.h"
#include "rollbem/sensitivity.h"
#include "rollbem/units.h"

RB_PUBLIC_BEGIN

/* ---- Options --------------------------------------------------------------------- */

/* An option table, which begins with a heading, and the struct that holds its values. */
typedef struct {
    const rb_option *options;
    int n;
    void *target;
    int *given; /* n: source of each value, see below; NULL: not recorded */
    int *plain; /* n: 1 if the value is a number that was given without a unit; NULL: not
                   recorded */
} rb_option_set;

/* Source of a value: 0: the default; k > 0: line k of the case file; RB_GIVEN_ARGUMENT:
 * an argument, which has priority over the file; RB_GIVEN_NUMBER: rb_case_set_number and
 * rb_case_set_word. */
enum { RB_GIVEN_ARGUMENT = -1, RB_GIVEN_NUMBER = -2 };

/* Finds the option whose name is the first `length` characters of `name` in n sets.
 * Returns its set and writes its row into *index.  NULL: there is no such option; the
 * names of all options were then passed to guess. */
const rb_option_set *rb_option_find(int n, const rb_option_set *sets, const char *name,
                                    size_t length, int *index, rb_guess *guess);

/* Source of the value of the option `name`, as in `given`; 0: the default. */
int rb_option_given(const rb_option_set *set, const char *name);

/* Sets option k of the set from a text and records the source `by` in set->given, and in
 * set->plain whether a number had no unit.  A number with a unit is converted; a number
 * without one is stored as it is.  what: name of the option in messages ("--mu",
 * "case.ini:3: mu").  The text is borrowed.  RB_EINVAL: "what: expected ..., got
 * '...'". */
rb_status rb_option_assign(const rb_option_set *set, int k, int by, const char *what,
                           const char *text, rb_message *why);

/* The value as it is written in a case file.  Returns `buffer`, or the text itself for a
 * text option. */
const char *rb_option_text(const rb_option *option, const void *target, char buffer[64]);

/* Name of the file that is the value of the option; NULL: none. */
const char *rb_option_path(const rb_option *option, const void *target);
/* Writes the source of an option for messages: "--load", "case.ini:3: load".  Returns
 * buffer. */
const char *rb_option_source(const rb_option *option, int given, const char *path, char *buffer,
                             size_t size);

/* 1: the whole text is one finite number. */
int rb_option_number(const char *text, double *value);

/* ---- Cases ----------------------------------------------------------------------- */

typedef struct rb_case rb_case;

/* The purpose of a case.  Options that do not apply to a purpose are refused. */
typedef enum {
    RB_CASE_SINGLE,
    RB_CASE_CURVE,  /* a creep curve: steady by default, several mu */
    RB_CASE_SPEEDS, /* a curve over the speed: likewise */
    RB_CASE_STRESS, /* the stress below the surface */
    RB_CASE_WEAR,   /* the wear of sliding, fretting or rolling */
    RB_CASE_CRACK,  /* the load of a crack */
    RB_CASE_STUDY,  /* the base of a parameter study */
    RB_CASE_DESIGN  /* the case whose numbers a design varies */
} rb_case_purpose;

/* 0: every case of that purpose refuses the option. */
int rb_case_takes(rb_case_purpose purpose, const char *option);

/* The words for the variables of a curve, rb_rolling_variable. */
extern const rb_choice rb_case_curve_variables[];

/* Creates a case with the default values; it is already resolved.  NULL: no memory. */
rb_case *rb_case_create(rb_case_purpose purpose);
/* Changes the purpose, with its defaults; call rb_case_resolve afterwards. */
void rb_case_set_purpose(rb_case *c, rb_case_purpose purpose);
/* The option `solver` may also name the cone solvers that `find` knows (NULL: none). */
void rb_case_use_cone_solvers(rb_case *c, rb_contact_cone_finder *find);
/* Restricts files, for options from an untrusted source such as a result to be checked.
 * A file that an option names must then be a regular file of at most 64 MB in the folder
 * or below it, after links are followed (folder: borrowed; NULL: anywhere).  Messages do
 * not quote the content of the file. */
void rb_case_confine(rb_case *c, const char *folder);
/* Reads a file that an option or the command line names.  The text ends with a zero byte,
 * and the caller owns it.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_case_read_input(const rb_case *c, const char *path, char **text, size_t *size,
                             rb_message *why);
/* Copies a case.  The copy borrows files and texts of c, so free it before c.  NULL: no
 * memory. */
rb_case *rb_case_copy(const rb_case *c);
void rb_case_free(rb_case *c);

/* The option table with the values as given; borrowed. */
rb_option_set rb_case_options(rb_case *c);
/* All n options and headings, in the order of the help; their offsets refer to
 * rb_resolved_case. */
const rb_option *rb_case_describe(int *n);
/* The option of this name, or NULL. */
const rb_option *rb_case_option(const char *name);
/* The word of option `name` for the choice `value`; NULL: there is none. */
const char *rb_case_word(const char *name, int value);
/* Name of the section of an option. */
const char *rb_case_section(const rb_option *option);

/* Sets an option.  by: RB_GIVEN_ARGUMENT, or the line of the case file.  The text is
 * copied.  RB_EINVAL: there is no such option, or the value is out of range. */
rb_status rb_case_set(rb_case *c, const char *name, const char *text, int by, rb_message *why);
/* The same for options whose value is a number. */
rb_status rb_case_set_number(rb_case *c, const char *name, double value, rb_message *why);
/* The same for a word, which is borrowed: many cases may be set one after the other. */
rb_status rb_case_set_word(rb_case *c, const char *name, const char *word, rb_message *why);

/* Reads a case file.  Values that were set by an argument are kept.  also: n further
 * tables whose keys the file may contain.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_case_read(rb_case *c, const char *path, int n, const rb_option_set *also,
                       rb_message *why);

/* The same from the text of a case file; name: name of the file in messages. */
rb_status rb_case_read_text(rb_case *c, const char *name, const char *text, rb_message *why);

/* Computes rb_resolved_case from the given values: refuses contradictions, fills in body
 * B and the mesh, reads the files of gap and history, and checks the result.  Call it
 * again after every change. */
rb_status rb_case_resolve(rb_case *c, rb_message *why);

/* The resolved values; borrowed, valid until c changes. */
const rb_resolved_case *rb_case_resolved(const rb_case *c);
/* The units of numbers without a unit from the source `by`; the case file (by > 0) has
 * its own. */
rb_units rb_case_units(const rb_case *c, int by);
/* A number of the command line, alone or with a unit that `unit` may be counted in, as it is
 * stored.  RB_EINVAL: it is none. */
rb_status rb_case_read_number(const rb_case *c, const char *text, const char *unit, double *x,
                              rb_message *why);
/* Converts the given numbers of a set that have no unit to mm, N, MPa and stores them in
 * target, a struct of the same type as set->target. */
void rb_case_store(const rb_case *c, const rb_option_set *set, void *target);
/* Number of rows of the table of the gap; 0: there is no table.  x, gap: borrowed until c
 * changes. */
int rb_case_gap_rows(const rb_case *c, const double **x, const double **gap);
/* 1: a column of the history replaces the value of the option. */
int rb_case_is_replaced(const rb_case *c, const rb_option *option);
/* 1: transient rolling, a static history or increments. */
int rb_case_has_steps(const rb_resolved_case *resolved);

/* ---- Solving ----------------------------------------------------------------------- */

typedef struct {
    rb_rolling_model model;       /* without a state if error bars were computed */
    rb_rolling_solution solution; /* n = 0: no solution */
    rb_rolling_history history;   /* n = 0: not a sequence of steps */
    int has_errors; /* 1: errors holds those of the solution; a history has errors of each
                       step */
    rb_rolling_errors errors;
    int elements; /* number needed for the required accuracy; 0: none required */
} rb_case_result;

/* Solves a case: steady and static cases at once, transients and histories step by step,
 * with error bars or to the accuracy given in the case.  step is called with the model
 * after each step; it may be NULL.  Free the result in any case. */
rb_status rb_case_solve(const rb_resolved_case *resolved, rb_rolling_step *step, void *context,
                        rb_case_result *result, rb_message *why);
/* The same, but result holds the result of an earlier case (or is {0}); its model is used
 * again as by rb_rolling_model_reuse.  Steps and error bars are computed from the
 * beginning. */
rb_status rb_case_solve_again(const rb_resolved_case *resolved, rb_rolling_step *step,
                              void *context, rb_case_result *result, rb_message *why);
/* Converts the result from mm, N, MPa to the units of the case for printing; the model
 * stays in mm, N, MPa. */
void rb_case_result_convert(rb_case_result *result, rb_units units);
void rb_case_result_free(rb_case_result *result);

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

enum { RB_CASE_NUMBERS_MAX = 64 };
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

/* Results with derivatives with respect to gap and mu of every element. */
typedef enum {
    RB_CASE_OVER_X_LOAD,
    RB_CASE_OVER_X_FORCE,
    RB_CASE_OVER_X_APPROACH,
    RB_CASE_OVER_X_CREEPAGE,
    RB_CASE_OVER_X_N
} rb_case_over_x;
extern const char *const rb_case_over_x_names[RB_CASE_OVER_X_N];

/* Differentiates the results of a solved model of the case with respect to the n named
 * numbers (n = 0: all numbers).  all is overwritten; free it in any case. */
rb_status rb_case_differentiate(const rb_case *c, const rb_rolling_model *model, int n,
                                const char *const *names, rb_case_derivatives *all,
                                rb_message *why);
/* The same with smooth derivatives (theory.md, D8). */
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
/* Standard deviations of all results to first order, each in the field of the result
 * (NAN: none).  all: derivatives in mm, N, MPa that include these inputs.  RB_EINVAL: an
 * input has no derivatives. */
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

/* ---- Cracks ------------------------------------------------------------------------ */

/* Lengths of a crack that were given with a unit, as bits. */
enum {
    RB_CRACK_LENGTH = 1,
    RB_CRACK_MOUTH = 2,
    RB_CRACK_DEPTH = 4,
    RB_CRACK_FROM = 8,
    RB_CRACK_TO = 16,
    RB_CRACK_GROW_TO = 32
};

/* A crack in body B under the contact of a case, as given by the user.  Lengths are in
 * half-widths of the contact (rb_case_crack_result), or in mm where their bit is set; the
 * angle is in degrees. */
typedef struct {
    double length, angle, mouth, depth, friction;
    int elements;
    double from, to; /* positions of the contact; NAN: not given */
    int passes;
    int fluid;            /* rb_crack_fluid */
    int locate_closing;   /* as in rb_crack_passage */
    double remote_stress; /* [stress] */
    int unloaded, coupled;
    double paris;         /* C; NAN: the crack does not grow */
    rb_numbers paris_law; /* C and m, with lengths and K in the units of the case */
    int paris_range;      /* rb_case_crack_range */
    int tension;          /* 1: grows perpendicular to the largest tension, 0: straight ahead */
    double threshold, grow_to; /* [K]; length, NAN: twice the length of the crack */
    int grow_steps;
    int in_mm; /* bits of lengths */
} rb_case_crack;

/* The range of K during a pass that determines the growth of the crack. */
typedef enum {
    RB_CRACK_MIXED,  /* (dK_I^4 + 8 dK_II^4)^(1/4) (Tanaka) */
    RB_CRACK_MODE_II /* dK_II */
} rb_case_crack_range;

/* Growth of a crack at its lower tip by da/dN = C dK^m.  One entry per length; the first
 * is the given length.  Arrays are owned. */
typedef struct {
    int n; /* 0: growth was not computed */
    double *length, *tip_x, *tip_y, *angle, *K_I_max, *delta_K_II, *delta_K, *rate,
        *cycles;  /* cycles until the crack has this length */
    int rests;    /* 1: the crack stops, because dK is below the threshold at the last length
                   */
    int surfaced; /* 1: the crack has reached the surface again, so that a piece breaks
                     out */
    rb_crack_path path;
} rb_case_crack_growth;

/* Summary of the last pass, which begins at step `from`. */
typedef struct {
    int from;
    double K_I_max, K_I_min, K_II_max, K_II_min, delta_K_I, delta_K_II;
    double K_I_max_at, K_II_max_at, K_II_min_at; /* x */
    double K_II_at_K_I_max;                      /* K_II at the moment of the largest K_I */
    double K_theta_max;                          /* largest rb_crack_largest_tension of the pass */
    double kink_angle;                           /* its direction, from t towards n [degrees] */
    double K_I_max_upper, K_I_min_upper, K_II_max_upper, K_II_min_upper; /* or NAN */
    double open_max, fluid_pressure_max;
    double pass_change;  /* largest change of K from the pass before; NAN with one pass */
    double max_pressure; /* of the contact, if it depends on the crack; otherwise NAN */
    double residual;
} rb_case_crack_summary;

rb_case_crack_summary rb_case_crack_summarise(const rb_crack_history *history, int passes);

rb_case_crack rb_case_crack_defaults(void);
/* The options of the section [crack]; their offsets refer to rb_case_crack. */
extern const rb_option rb_case_crack_options[];
extern const int rb_case_crack_options_n;
/* A second set of options of the case, which takes them from now on: rb_case_set knows their
 * names, and the inputs of a case of RB_CASE_CRACK contain them. */
rb_option_set rb_case_crack_set(rb_case *c);
/* The crack of the resolved case in mm, N, MPa; NULL: it takes none. */
const rb_case_crack *rb_case_crack_of(const rb_case *c);

enum { RB_CASE_CRACK_NOTES = 8 };
typedef struct {
    rb_case_result contact; /* the contact; solution.n = 0: unloaded */
    double half_width;      /* unit of the lengths of the crack: that of the load, in a history of
                               the largest one (rb_rolling_contact_half_width) [length]; NAN:
                               nothing loads the crack, and no load is given */
    int positions; /* of a pass, where the program has added some to those of the track; otherwise
                      0 */
    double *position; /* [length]; owned */
    rb_status status; /* RB_INTERRUPTED: some passes or lengths are missing */
    int passes;
    rb_crack_shape shape;
    rb_rolling_states states; /* of the contact, if it has steps; otherwise n = 0 */
    rb_crack_history history;
    rb_case_crack_summary summary;
    int has_errors;
    rb_case_crack_summary errors; /* error of each number of the summary */
    rb_case_crack_growth growth;
    int notes;
    char note[RB_CASE_CRACK_NOTES][200]; /* notes on how to read the result */
    int note_kind[RB_CASE_CRACK_NOTES];  /* which of those that there may be: 0, 1, ... */
    int note_kinds;                      /* how many were thought of so far */
    rb_units units;                      /* of all values except shape and contact.model */
} rb_case_crack_result;

/* The crack with its lengths in mm, a being the unit of those without one (NAN: they are NAN), and
 * with the positions that are not given. */
rb_case_crack rb_case_crack_lengths(const rb_resolved_case *resolved, const rb_case_crack *crack,
                                    double a);

/* Checks the crack, the positions, and whether the case can load a crack. */
rb_status rb_case_crack_check(const rb_resolved_case *resolved, const rb_case_crack *crack,
                              rb_message *why);
/* Solves the contact and moves it over the crack; if the case wants error bars, this is
 * repeated with twice as many elements.  In transient rolling the position of the contact
 * is `from` plus the rolled distance; in a static history it stays at `from`. The observer,
 * or NULL, sees the steps of the contact and of the crack.  RB_INTERRUPTED: it ended them; if
 * history.n > 0 the result is that of the passes, or lengths, that were complete.  Free the
 * result in any case. */
rb_status rb_case_crack_solve(const rb_resolved_case *resolved, const rb_case_crack *crack,
                              const rb_crack_observer *observer, rb_case_crack_result *result,
                              rb_message *why);

/* Where the contact stands, and its tractions there. */
typedef struct {
    int n;
    double *x; /* n positions [length] */
    int loads; /* as in rb_crack_passage */
    rb_bem_edge_load *load;
    rb_crack_load_kind kind;
    double *ends;
    rb_arena memory; /* of the arrays; those of a result with positions are its own */
} rb_case_crack_track;

/* The case of the contact that loads the crack: of a coupled one on equal elements that reach
 * beyond the contact. */
rb_resolved_case rb_case_crack_contact(const rb_resolved_case *resolved,
                                       const rb_case_crack *crack);

/* So many times as many elements of the contact, positions that the program chooses, elements of
 * the crack, and steps of a history or equal ones as the case says. */
typedef struct {
    double contact, positions;
    int crack, steps;
} rb_case_crack_mesh;
extern const rb_case_crack_mesh rb_case_crack_own_mesh; /* once as many */

/* The track of result->contact and result->states, whose arrays it borrows; also sets
 * half_width, shape, passes and notes of the result.  Where the program chooses the positions,
 * those of the result are taken if there are any.  RB_EINVAL: a step of the contact jumps over the
 * crack; a length is out of range. */
rb_status rb_case_crack_follow(const rb_resolved_case *resolved, const rb_case_crack *crack,
                               const rb_case_crack_mesh *finer, rb_case_crack_result *result,
                               rb_case_crack_track *track, rb_message *why);
void rb_case_crack_track_free(rb_case_crack_track *track);
/* The passage of such a track without a wheel. */
rb_crack_passage rb_case_crack_passage(const rb_case_crack *crack,
                                       const rb_case_crack_track *track);

void rb_case_crack_convert(rb_case_crack_result *result, rb_units units);
void rb_case_crack_free(rb_case_crack_result *result);
/* 1: the number of the summary has a meaning for such a crack. */
int rb_case_crack_has_result(const rb_rolling_result *result, const rb_case_crack *crack);
/* A row of a parameter study (rb_rolling_sweep): numbers of the contact in row->solution,
 * of the summary in row->own. */
rb_status rb_case_crack_row(const rb_resolved_case *resolved, const rb_case_crack *crack,
                            rb_rolling_row *row, rb_message *why);
/* A number of rb_case_crack_scalars in such a row, or its error bar. */
double rb_case_crack_of_row(const rb_rolling_result *result, int is_error,
                            const rb_rolling_row *row);
/* The numbers of rb_case_crack_summary and the columns of rb_crack_history and of
 * rb_case_crack_growth. */
extern const rb_rolling_results rb_case_crack_scalars, rb_case_crack_columns,
    rb_case_crack_growth_columns;
/* Table k of all results, those of rb_rolling_result_tables and of cracks; NULL: there
 * are no more. */
const rb_rolling_result_table *rb_case_result_table(int k);

/* ---- Fits to measured creep curves (theory.md, D5) ---------------------------------- */

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

/* ---- Cases of CONTACT (docs/contact.md) -------------------------------------------- */

/* A two-dimensional case of CONTACT.  The x of CONTACT is centre + sign x; its CKSI and
 * FX are sign times creepage and Q.  sign is -1 if it rolls towards -x (CHI = 180
 * degrees).  rc may contain pointers into the struct, so the struct must not be moved. */
typedef struct {
    rb_rolling_case rc;
    double from, to; /* ends of its line of elements */
    double width;    /* width on which its forces act, DY [mm] */
    double centre, sign;
    int goes_on;            /* 1: continues from the state of the case before, P = 0 */
    double step;            /* DQ of T = 2; 0: static or steady */
    rb_rolling_table start; /* first friction coefficients of the iteration, INISLP */
    double start_mu;
    int runs;           /* 0: the case cannot be run, left_out has the reason */
    char left_out[400]; /* features of the case that are not supported here; "" if none */
} rb_case_contact;

void rb_case_from_contact(const rb_io_contact_case *in, rb_case_contact *c);
/* For a case that continues the case before (NULL: none) with this solution (n = 0: not
 * solved): sets runs to 0 if that is not possible. */
void rb_case_contact_follow(const rb_case_contact *before, const rb_rolling_solution *solution,
                            rb_case_contact *c);
/* Solves a case with runs = 1.  before: the solution of the case before; solution is
 * overwritten; free it in any case.  Errors as for rb_rolling_solve_between and
 * rb_rolling_step_between. */
rb_status rb_case_contact_solve(const rb_case_contact *c, const rb_rolling_solution *before,
                                rb_rolling_solution *solution, rb_message *why);
/* FRIC_POWER as defined in CONTACT [N m/s], < 0: sum over the elements of friction times
 * slip, without the power dissipated by plastic deformation of the third body.  NAN if
 * the case does not roll. */
double rb_case_contact_power(const rb_io_contact_case *in, const rb_case_contact *c,
                             const rb_rolling_solution *before, const rb_rolling_solution *s);

/* ---- Sources of errors ------------------------------------------------------------- */

/* 1: an option of body B that --similar copies from A. */
int rb_case_is_copied_to_b(const char *option);
/* 1: an option of body B that is given and otherwise would have A's value, with which it
 * would vary. */
int rb_case_is_own_of_b(const rb_case *c, const char *option);
/* Source of the value of the option `name`; 0: the default. */
int rb_case_given(const rb_case *c, const char *name);
/* Converts an error s of rollbem/rolling.h to an error of this case: if the wrong value
 * is in a file, the message gets the file and the line.  Returns the status to report. */
rb_status rb_case_locate(const rb_case *c, rb_status s, rb_message *why);

RB_PUBLIC_END

#endif
