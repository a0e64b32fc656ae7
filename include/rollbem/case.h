/* A case by names: one table holds every option of a case (name, section, unit, range,
 * choices, default, help), and whatever reads or shows a case is made from it: the
 * command line, case files, JSON `inputs`, --help, studies, and callers of this library.
 *
 *     rb_case *c = rb_case_create(RB_CASE_SINGLE);
 *     rb_case_set(c, "support", "halfplane", RB_GIVEN_ARGUMENT, &why);
 *     rb_case_set_number(c, "load", 500.0, &why);
 *     if (rb_case_resolve(c, &why) == RB_OK)
 *         rb_case_solve(rb_case_resolved(c), NULL, NULL, &result, &why);
 *     rb_case_result_free(&result);
 *     rb_case_free(c);
 *
 * Nothing here prints.  A refusal is a status and a line: RB_EINVAL where an argument is
 * wrong, RB_EFORMAT where a file is, RB_ENOENT where there is no such file. */
#ifndef ROLLBEM_CASE_H
#define ROLLBEM_CASE_H

#include "rollbem/base.h"
#include "rollbem/io_contact.h"
#include "rollbem/crack.h"
#include "rollbem/rolling.h"
#include "rollbem/sensitivity.h"
#include "rollbem/units.h"

#include <math.h>
#include <stddef.h>

RB_PUBLIC_BEGIN

/* ---- Options --------------------------------------------------------------------- */

typedef enum {
    RB_OPTION_GROUP,   /* no option: a heading; name is the section, help the title */
    RB_OPTION_NUMBER,  /* double */
    RB_OPTION_INTEGER, /* int */
    RB_OPTION_CHOICE,  /* int (an enum) */
    RB_OPTION_FLAG,    /* int: yes or no */
    RB_OPTION_TEXT     /* const char * */
} rb_option_kind;

typedef struct {
    double from, to;
    int from_open, to_open; /* 1: the end itself is not allowed */
} rb_range;

/* Numbers separated by commas. */
enum { RB_NUMBERS_MAX = 16 };

typedef struct {
    int n;
    double value[RB_NUMBERS_MAX];
} rb_numbers;

/* What the file is for that an option names. */
typedef enum {
    RB_FILE_NONE, /* the option names no file */
    RB_FILE_READ,
    RB_FILE_WRITTEN,
    RB_FILE_PICTURE, /* written too, its kind told by the end of the name */
    RB_FILE_FOLDER   /* that is written into */
} rb_option_file;

/* One option: what it is called, what it may be, and where its value goes in the struct
 * that the table belongs to. */
typedef struct {
    const char *name; /* --name, and the key in a case file */
    rb_option_kind kind;
    size_t offset;    /* of the value in the set's target */
    const char *unit; /* "mm"; "" for none; of a text: what stands for it in the help */
    rb_range range;   /* numbers and integers */
    const char *word; /* numbers: a word that stands for word_value, or NULL */
    double word_value;
    size_t list; /* numbers: when not 0, more of them may follow after commas; all are
                    stored here (rb_numbers), the first one as the value */
    const rb_choice *choices; /* ends with a NULL name */
    size_t path; /* choices: when not 0, any other word is a name, stored here
                    (const char *), and the value is path_value */
    int path_value;
    const char *path_name; /* of that other word in the help: FILE, NAME */
    rb_option_file file;   /* texts, and choices with another word */
    unsigned excludes;     /* of options that share a bit only one may be given */
    int frozen; /* numbers: 1: of the mesh, the steps or the solver, with respect to which
                   nothing is differentiated */
    const char *alone;    /* texts: the value of the option without one: where the next
                             argument is an option, a file or has a dot or slash; or NULL */
    const char *unset;    /* help: what stands for the default; NULL: the value itself */
    const char *one_only; /* why several numbers are refused; NULL: the range says it */
    int common;           /* 1: --help begins with it */
    const char *help;
} rb_option;

/* Ranges and lines of an option table: */
#define RB_ANY                                                                           \
    {                                                                                    \
        -INFINITY, INFINITY, 1, 1                                                        \
    }
#define RB_ABOVE(x)                                                                      \
    {                                                                                    \
        x, INFINITY, 1, 1                                                                \
    }
#define RB_FROM(x)                                                                       \
    {                                                                                    \
        x, INFINITY, 0, 1                                                                \
    }
#define RB_BETWEEN(x, y)                                                                 \
    {                                                                                    \
        x, y, 1, 1                                                                       \
    } /* (x, y) */
#define RB_FROM_TO(x, y)                                                                 \
    {                                                                                    \
        x, y, 0, 0                                                                       \
    } /* [x, y] */
#define RB_ABOVE_UPTO(x, y)                                                              \
    {                                                                                    \
        x, y, 1, 0                                                                       \
    } /* (x, y] */

#define RB_GROUP_LINE(section, title)                                                    \
    {                                                                                    \
        .name = section, .kind = RB_OPTION_GROUP, .help = title                          \
    }
#define RB_NUMBER_LINE(name_, place, unit_, range_, ...)                                 \
    {                                                                                    \
        .name = name_, .kind = RB_OPTION_NUMBER, .offset = place, .unit = unit_,         \
        .range = range_, .help = __VA_ARGS__                                             \
    }
#define RB_INTEGER_LINE(name_, place, range_, ...)                                       \
    {                                                                                    \
        .name = name_, .kind = RB_OPTION_INTEGER, .offset = place, .unit = "",           \
        .range = range_, .help = __VA_ARGS__                                             \
    }
#define RB_CHOICE_LINE(name_, place, choices_, ...)                                      \
    {                                                                                    \
        .name = name_, .kind = RB_OPTION_CHOICE, .offset = place, .unit = "",            \
        .choices = choices_, .help = __VA_ARGS__                                         \
    }
#define RB_FLAG_LINE(name_, place, ...)                                                  \
    {                                                                                    \
        .name = name_, .kind = RB_OPTION_FLAG, .offset = place, .unit = "",              \
        .help = __VA_ARGS__                                                              \
    }
#define RB_TEXT_LINE(name_, place, metavar, ...)                                         \
    {                                                                                    \
        .name = name_, .kind = RB_OPTION_TEXT, .offset = place, .unit = metavar,         \
        .help = __VA_ARGS__                                                              \
    }

/* A table, which begins with a heading, and the struct its values go to. */
typedef struct {
    const rb_option *options;
    int n;
    void *target;
    int *given; /* n: who gave the value, see below; NULL where nobody asks */
    int *plain; /* n: 1 where it is a number that came without a unit; NULL likewise */
} rb_option_set;

/* Who gave a value: nobody (0), line k > 0 of the case file, an argument that wins over
 * the file, or rb_case_set_number. */
enum { RB_GIVEN_ARGUMENT = -1, RB_GIVEN_NUMBER = -2 };

/* The option of that name (its first `length` characters) among n sets: its set, and its
 * place there in *index; NULL: there is none, and guess has tried the others' names. */
const rb_option_set *rb_option_find(int n, const rb_option_set *sets, const char *name,
                                    size_t length, int *index, rb_guess *guess);

/* Who gave the option of that name, as in `given`; 0: it has its default. */
int rb_option_given(const rb_option_set *set, const char *name);

/* One value for option k of the set, strictly, with its marks in given and plain; a
 * number may have a unit, a plain one stays as it is.  what: how messages call it
 * ("--mu", "case.ini:3: mu").  Text is borrowed.  RB_EINVAL: "what: expected ..., got
 * '...'". */
rb_status rb_option_assign(const rb_option_set *set, int k, int by, const char *what,
                           const char *text, rb_message *why);

/* "a number >= 0", "lemke, newton or auto": what the option wants.  Returns text. */
const char *rb_option_expected(const rb_option *option, char *text, size_t size);

/* The value as text of a case file; room for 64 bytes or the text itself. */
const char *rb_option_text(const rb_option *option, const void *target, char room[64]);

/* The file that the option names; NULL: none. */
const char *rb_option_path(const rb_option *option, const void *target);
/* Where an option came from in a message: "--load", "case.ini:3: load".  Returns room. */
const char *rb_option_source(const rb_option *option, int given, const char *path,
                             char *room, size_t size);

/* 1: the whole of text is one finite number. */
int rb_option_number(const char *text, double *value);

/* ---- Cases ----------------------------------------------------------------------- */

typedef struct rb_case rb_case;

/* The purpose of a case.  Options that have no meaning for a purpose are refused. */
typedef enum {
    RB_CASE_SINGLE,
    RB_CASE_CURVE,  /* a creep curve: steady by default, several mu */
    RB_CASE_SPEEDS, /* a curve over the speed: the same */
    RB_CASE_STRESS, /* the stress below the surface */
    RB_CASE_WEAR,   /* the wear of sliding, fretting or rolling */
    RB_CASE_CRACK,  /* the load of a crack */
    RB_CASE_STUDY   /* the base of a parameter study */
} rb_case_purpose;

/* What a curve may run over: rb_rolling_variable. */
extern const rb_choice rb_case_curve_variables[];

/* The defaults, resolved already.  NULL: no memory. */
rb_case *rb_case_create(rb_case_purpose purpose);
/* Changes a creep curve into one over the speed and back; resolve afterwards. */
void rb_case_set_purpose(rb_case *c, rb_case_purpose purpose);
/* Solvers that the option `solver` may name beside those of contact.h; borrowed.  Without
 * this there are none. */
void rb_case_use_cone_solvers(rb_case *c, const rb_contact_cone_solvers *solvers);
/* For options from a file of somebody else, such as a result to be checked.  A file that
 * such an option names must be a regular file of at most 64 MB below the folder, after
 * links are followed (folder: borrowed; NULL: anywhere).  Messages do not quote what the
 * file holds. */
void rb_case_confine(rb_case *c, const char *folder);
/* The text of a file that an option or the command line names, ended by a zero byte; the
 * caller owns the text.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_case_read_input(const rb_case *c, const char *path, char **text,
                             size_t *size, rb_message *why);
/* The copy borrows files and texts of c, so that c must live longer.  NULL: no memory. */
rb_case *rb_case_copy(const rb_case *c);
void rb_case_free(rb_case *c);

/* The table with the values as given, for those who read or show them; borrowed. */
rb_option_set rb_case_options(rb_case *c);
/* All n options and their headings, in the order of the help; their values stand in an
 * rb_resolved_case. */
const rb_option *rb_case_describe(int *n);
/* The option of that name; NULL: there is none. */
const rb_option *rb_case_option(const char *name);
/* The word that option `name` has for one of its choices; NULL: it has none. */
const char *rb_case_word(const char *name, int value);
/* The section that it stands in. */
const char *rb_case_section(const rb_option *option);

/* by: RB_GIVEN_ARGUMENT, or the line of the case file.  The text is copied.  RB_EINVAL:
 * no such option, or a value out of its range. */
rb_status rb_case_set(rb_case *c, const char *name, const char *text, int by,
                      rb_message *why);
/* Options of numbers only. */
rb_status rb_case_set_number(rb_case *c, const char *name, double value, rb_message *why);

/* Reads a case file.  Values that an argument has given stay.  also: n further tables
 * whose keys the file may hold.  RB_ENOENT, RB_EFORMAT, RB_ENOMEM. */
rb_status rb_case_read(rb_case *c, const char *path, int n, const rb_option_set *also,
                       rb_message *why);

/* The same from the text of a case file; name: what messages call it. */
rb_status rb_case_read_text(rb_case *c, const char *name, const char *text,
                            rb_message *why);

/* Makes a case from the given values: refuses contradictions, resolves body B and the
 * mesh, reads the files of gap and history, and checks the result.  Call it again after
 * every further change. */
rb_status rb_case_resolve(rb_case *c, rb_message *why);

/* Relaxation as it is typed: the first number, and all of them. */
typedef struct {
    double time, ratio;
    rb_numbers times, ratios;
} rb_case_memory;

/* Parameters of friction laws as they are typed: the first number, and all of them. */
typedef struct {
    double fall, slip_scale, memory, heat;
    rb_numbers falls, slip_scales, memories, heats;
} rb_case_law;

/* The values of a case, as resolved. */
typedef struct {
    rb_rolling_case rc;
    rb_rolling_derived derived; /* what follows from rc */
    const char *gap_file;       /* profile of the initial gap, or NULL */
    double gap_smoothing;       /* standard deviation of its noise [length] */
    int similar;                /* B is of A's material, with its layer, cover, memory */
    double young_b, poisson_b, radius_b;
    double conductivity_b, heat_capacity_b, temperature_b;
    rb_case_memory memory_a, memory_b;
    rb_numbers mus;            /* more than one: for curves */
    const char *friction_file; /* table of the friction law, or NULL */
    rb_case_law law;
    const char *irregularity_file; /* or NULL */
    const char *worn_file;         /* or NULL */
    const char *history_file;      /* or NULL */
    rb_rolling_program program;    /* its history; n = 0: none */
    int error;                     /* 1: estimate discretisation errors */
    double accuracy;               /* refine until they are below this; 0: no */
    rb_units units; /* of plain numbers, but for those of a case file, which says its own,
                       and of what is shown; the values here are in mm, N, MPa */
} rb_resolved_case;

/* Borrowed, valid until c changes. */
const rb_resolved_case *rb_case_resolved(const rb_case *c);
/* The system of the plain numbers of that giver: the case file (by > 0) has its own. */
rb_units rb_case_units(const rb_case *c, int by);
/* Plain numbers of the set that were given, beside the case or in its file, become mm, N,
 * MPa in target, a struct like the set's. */
void rb_case_store(const rb_case *c, const rb_option_set *set, void *target);
/* Rows of the table of the gap, 0: it comes from none; x, gap: borrowed until c changes.
 */
int rb_case_gap_rows(const rb_case *c, const double **x, const double **gap);
/* 1: a column of the history stands in the place of the option. */
int rb_case_is_replaced(const rb_case *c, const rb_option *option);
/* 1: transient rolling, a static history or increments. */
int rb_case_has_steps(const rb_resolved_case *resolved);

/* ---- Solving ----------------------------------------------------------------------- */

typedef struct {
    rb_rolling_model model;       /* without state where there are error bars */
    rb_rolling_solution solution; /* n = 0: there is none */
    rb_rolling_history history;   /* n = 0: not a sequence of steps */
    int has_errors;               /* of the solution; of a history each step has them */
    rb_rolling_errors errors;
    int elements; /* that the accuracy took; 0: not asked */
} rb_case_result;

/* Solves steady and static cases at once, transients and histories step by step, with the
 * error bars or the accuracy that the case asks for.  step is called with the model after
 * each step; it may be NULL.  Free the result in any case. */
rb_status rb_case_solve(const rb_resolved_case *resolved, rb_rolling_step *step,
                        void *context, rb_case_result *result, rb_message *why);
/* The same with the result of a case before it, or {0}, as rb_rolling_model_reuse takes
 * its model; steps and error bars begin anew. */
rb_status rb_case_solve_again(const rb_resolved_case *resolved, rb_rolling_step *step,
                              void *context, rb_case_result *result, rb_message *why);
/* Converts the result from mm, N, MPa to the units of the case, to show it; the model
 * keeps mm, N, MPa. */
void rb_case_result_convert(rb_case_result *result, rb_units units);
void rb_case_result_free(rb_case_result *result);

/* ---- Derivatives (sensitivity.h) --------------------------------------------------- */

/* One number of a case with the derivatives of all results with respect to it. */
typedef struct {
    char name[40];    /* of the option; "mu-fall-2": the second number of its list */
    const char *unit; /* of the option */
    double value;     /* [unit] */
    rb_status status; /* RB_OK, or there are none, and why says why not */
    rb_message why;
    rb_sensitivity_derivative d;
} rb_case_derivative;

/* A number that has a meaning in the case, and how the case varies with it. */
typedef struct {
    char name[40];
    const rb_option *option;
    int entry; /* of its list, from 0 */
    rb_sensitivity_input input;
    const rb_case *c;
} rb_case_number;

enum { RB_CASE_NUMBERS_MAX = 64 };
/* All numbers of a resolved case that can be varied; at most RB_CASE_NUMBERS_MAX. number:
 * each refers to its own place, so that the array must not move. RB_ENOMEM. */
rb_status rb_case_numbers(const rb_case *c, rb_case_number *number, int *n,
                          rb_message *why);

typedef struct {
    int n;
    rb_case_derivative *of;           /* in the order of the options; owned */
    int degenerate;                   /* elements between two zones */
    rb_sensitivity_elements elements; /* what they do while an input changes */
    int n_x; /* elements; 0: no vectors (a law that depends on the state, no matrix) */
    double *over_x; /* of every rb_case_over_x in turn: by the gap at each element
                       [unit/length], then by its coefficient of friction, n_x each, on
                       elements that stay and at the creepage as it is; owned */
    rb_units units; /* of results and numbers; mm at first */
} rb_case_derivatives;

/* What has derivatives by gap and mu of every element. */
typedef enum {
    RB_CASE_OVER_X_LOAD,
    RB_CASE_OVER_X_FORCE,
    RB_CASE_OVER_X_APPROACH,
    RB_CASE_OVER_X_CREEPAGE,
    RB_CASE_OVER_X_N
} rb_case_over_x;
extern const char *const rb_case_over_x_names[RB_CASE_OVER_X_N];

/* Of a solved model of the case, with respect to all of its numbers, or to those names
 * (n, or 0: all).  all: overwritten; free it in any case. */
rb_status rb_case_differentiate(const rb_case *c, const rb_rolling_model *model, int n,
                                const char *const *names, rb_case_derivatives *all,
                                rb_message *why);
/* A result that has derivatives; NULL: there is none of that name. *is_column: 1: it has
 * an entry per element. */
const rb_rolling_result *rb_case_derivative_result(const char *name, int *is_column);

/* ---- Derivatives in columns: along a curve, over a study, step by step --------------
 */

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
    double *value;  /* rows x n x 2, row after row: for a falling and for a growing input
                       (the same where both are alike; of histories always); NAN: none;
                       owned */
    int degenerate; /* of a history: steps in which elements stand between two zones */
    rb_units units; /* mm at first */
} rb_case_slopes;

/* The columns that words ask for: "all", or RESULT (by every number of the resolved
 * case) and RESULT:OPTION with commas between.  RB_EINVAL: no such result or number,
 * more than `most`.  Free it in any case. */
rb_status rb_case_slopes_choose(const rb_case *c, const rb_rolling_results *table,
                                const char *words, int most, rb_case_slopes *slopes,
                                rb_message *why);
/* Room for so many rows, without values.  RB_ENOMEM. */
rb_status rb_case_slopes_alloc(int rows, rb_case_slopes *slopes);
/* Those of a solved model of the case; row: 2 n, NAN before. */
rb_status rb_case_slopes_at(const rb_case *c, const rb_rolling_model *model,
                            const rb_case_slopes *slopes, double *row, rb_message *why);
/* For a growing input, or where it cannot grow for a falling one. */
double rb_case_slope_value(const rb_case_slopes *slopes, int row, int k);
/* "d_tangential_load_N/mm_by_radius_mm". */
const char *rb_case_slope_heading(const rb_case_slope *of, rb_units units,
                                  char text[RB_CASE_SLOPE_HEADING]);
/* A derivative in other units than mm, N, MPa. */
double rb_case_slope_shown(const rb_case_slope *of, rb_units units, double x);
void rb_case_slopes_convert(rb_case_slopes *slopes, rb_units units);
void rb_case_slopes_free(rb_case_slopes *slopes);

/* The columns of a curve, whose case has that purpose. */
rb_status rb_case_curve_choose(const rb_case *c, const rb_rolling_range *range,
                               const char *words, rb_case_slopes *slopes,
                               rb_message *why);
/* rb_rolling_curve_solve with those derivatives of each point. */
rb_status rb_case_curve_solve(const rb_case *c, const rb_rolling_range *range, double mu,
                              rb_rolling_curve *curve, rb_case_slopes *slopes,
                              rb_message *why);
/* Of the history that found these states, for growing inputs where the two sides differ.
 * RB_EINVAL: friction that depends on the state, an interface that yields, a given
 * approach. */
rb_status rb_case_slopes_of_steps(const rb_case *c, const rb_rolling_states *states,
                                  rb_case_slopes *slopes, rb_message *why);

/* Uncertain inputs, as in "mu=0.02,radius=1%": a standard deviation each, the inputs
 * independent. */
enum { RB_CASE_TOLERANCES_MAX = 32 };
typedef struct {
    int n;
    char name[RB_CASE_TOLERANCES_MAX][40];
    double value[RB_CASE_TOLERANCES_MAX],
        deviation[RB_CASE_TOLERANCES_MAX]; /* mm, N, MPa */
} rb_case_tolerances;

/* RB_EINVAL: what is no number of the case, or no deviation >= 0 (the line says which).
 */
rb_status rb_case_read_tolerances(const rb_case *c, const char *text,
                                  rb_case_tolerances *t, rb_message *why);
/* To first order: the standard deviations of all results, in their places (NAN: none).
 * all: in mm, N, MPa, with those inputs among them.  RB_EINVAL: an input has no
 * derivatives. */
rb_status rb_case_propagate(const rb_case_tolerances *t, const rb_case_derivatives *all,
                            rb_rolling_solution *deviation, rb_message *why);

/* From mm, N, MPa to other units, once. */
void rb_case_derivatives_convert(rb_case_derivatives *all, rb_units units);
void rb_case_derivatives_free(rb_case_derivatives *all);

/* ---- Cracks ------------------------------------------------------------------------ */

/* A crack in body B under the contact of a case, as it is typed: lengths in half-widths
 * of the contact, Hertz's of its load, as distances of histories; angle in degrees. */
typedef struct {
    double length, angle, mouth, depth, friction;
    int elements;
    double from, to; /* positions of the contact; NAN: not given */
    int passes;
    int fluid;            /* rb_crack_fluid */
    double remote_stress; /* [stress] */
    int unloaded, coupled;
    double paris;              /* C; NAN: the crack does not grow */
    rb_numbers paris_law;      /* C, m: in lengths and K of the case's units */
    int paris_range;           /* rb_case_crack_range */
    int tension;               /* 1: grows across the largest tension, 0: straight on */
    double threshold, grow_to; /* [K]; length in half-widths, NAN: twice the length */
    int grow_steps;
} rb_case_crack;

/* Which range of K over a pass makes a crack grow. */
typedef enum {
    RB_CRACK_MIXED,  /* (dK_I^4 + 8 dK_II^4)^(1/4) (Tanaka) */
    RB_CRACK_MODE_II /* dK_II */
} rb_case_crack_range;

/* A crack that grows by da/dN = C dK^m, at its lower tip: an entry per length, the first
 * one as it is given; owned. */
typedef struct {
    int n; /* 0: not asked for */
    double *length, *tip_x, *tip_y, *angle, *K_I_max, *delta_K_II, *delta_K, *rate,
        *cycles;  /* until it has that length */
    int rests;    /* 1: below the threshold at the last length */
    int surfaced; /* 1: it came back to the surface: a piece breaks out */
    rb_crack_path path;
} rb_case_crack_growth;

rb_case_crack rb_case_crack_defaults(void);
/* The options of such a crack, section [crack]; their values stand in an rb_case_crack.
 */
extern const rb_option rb_case_crack_options[];
extern const int rb_case_crack_options_n;

enum { RB_CASE_CRACK_NOTES = 6 };
typedef struct {
    rb_case_result contact; /* solution n = 0: unloaded */
    double half_width;      /* [length] */
    int passes;
    rb_crack_shape shape;
    rb_crack_history history;
    rb_crack_summary summary;
    int has_errors;
    rb_crack_summary errors; /* of each number of the summary */
    rb_case_crack_growth growth;
    int notes;
    char note[RB_CASE_CRACK_NOTES][200]; /* how the result is to be read */
    rb_units units;                      /* of all values but shape and contact.model */
} rb_case_crack_result;

/* What is wrong with the crack and its positions, or with the case as its load. */
rb_status rb_case_crack_check(const rb_resolved_case *resolved,
                              const rb_case_crack *crack, rb_message *why);
/* Solves the contact, passes it over the crack, and where the case asks for error bars
 * does so with twice as many elements too.  In transient rolling the contact stands at
 * `from` plus the rolled distance; in a static history it stays at `from`. Free the
 * result in any case. */
rb_status rb_case_crack_solve(const rb_resolved_case *resolved,
                              const rb_case_crack *crack, rb_case_crack_result *result,
                              rb_message *why);
void rb_case_crack_convert(rb_case_crack_result *result, rb_units units);
void rb_case_crack_free(rb_case_crack_result *result);
/* Numbers of rb_crack_summary and columns of rb_crack_history. */
extern const rb_rolling_results rb_case_crack_scalars, rb_case_crack_columns,
    rb_case_crack_growth_columns;
/* ---- Fits to measured creep curves (theory.md, D5) ----------------------------------
 */

enum { RB_CASE_FIT_MAX = 12 };

/* What the measured forces are. */
typedef enum {
    RB_CASE_FORCE,          /* Q */
    RB_CASE_FORCE_RATIO,    /* Q/(mu P), mu the largest coefficient of the law */
    RB_CASE_FORCE_OVER_LOAD /* Q/P */
} rb_case_measure;

/* n measured points; NULL columns: not measured, the case has the value.  Borrowed; mm,
 * N, MPa. */
typedef struct {
    int n, is_ratio; /* 1: creep is xi R/(mu a) */
    rb_case_measure measure;
    const double *creep, *force;
    const double *load, *speed, *temperature;
    const double *sigma; /* standard deviations of the forces; NULL: unknown, alike */
} rb_case_data;

/* A number of the case by the name of its option, or "creep-offset": the true creepage is
 * the measured one plus it.  The caller sets name, start (NAN: what the case or the data
 * say), low and high (-INFINITY, INFINITY: the option's range). */
typedef struct {
    char name[40];
    double start, low, high;
    /* found: */
    const char *unit;
    double value, interval[2], deviation; /* Student's interval; standard deviation */
    double correlation[RB_CASE_FIT_MAX];  /* with the others; NAN: not known */
    int identified, at_bound;
    double from, to, scale;
    int low_open, high_open, positive;
} rb_case_parameter;

typedef struct {
    int n;
    rb_case_parameter parameter[RB_CASE_FIT_MAX];
    double level; /* of the intervals, such as 0.95 */
    /* found: */
    rb_status status;
    int iterations, degrees_of_freedom, unidentified;
    double chi_square, noise; /* noise: of a force, in units of its sigma where given */
    double kappa;             /* the largest; 0: friction does not depend on the state */
    double *model,
        *band; /* forces of the fit and half-widths of their intervals; owned */
    char sentences[1000]; /* what the data do not tell, a line each */
} rb_case_fit;

typedef struct {
    /* Sees each step; a value other than 0 ends the fit. */
    int (*step)(int iteration, double chi_square, int n, const double *value,
                void *context);
    void *context;
} rb_case_fit_observer;

/* A falling friction law, a speed and the words beside them where the fit asks for
 * numbers of which the case says nothing.  Before it is resolved. */
rb_status rb_case_prepare_fit(rb_case *c, const rb_case_data *data,
                              const rb_case_fit *fit, rb_message *why);
/* The case's tangential control is not read.  RB_EINVAL: no such number, too few points;
 * RB_INACCURATE: kappa > 1; RB_MAXITER, RB_INTERRUPTED: values so far.  fit: n, names,
 * starts, bounds, level; free it in any case. */
rb_status rb_case_fit_solve(const rb_case *c, const rb_case_data *data,
                            const rb_case_fit_observer *observer, rb_case_fit *fit,
                            rb_message *why);
void rb_case_fit_free(rb_case_fit *fit);

/* ---- Cases of CONTACT (docs/contact.md) -------------------------------------------- */

/* A two-dimensional case of CONTACT.  Its x is centre + sign x, its CKSI and FX are sign
 * times creepage and Q: sign < 0 where it rolls towards -x (CHI = 180 degrees).  rc may
 * borrow from the struct itself, which stays where it is. */
typedef struct {
    rb_rolling_case rc;
    double from, to; /* ends of its line of elements */
    double width;    /* that its forces act on, DY [mm] */
    double centre, sign;
    int goes_on;            /* 1: from the state of the case before, P = 0 */
    double step;            /* DQ of T = 2; 0: it does not roll, or steadily */
    rb_rolling_table start; /* coefficients that a step is looked for from, INISLP */
    double start_mu;
    int runs;           /* 0: it is none of those that can be run, left_out says why */
    char left_out[400]; /* what CONTACT does in it that is not done here; "" */
} rb_case_contact;

void rb_case_from_contact(const rb_io_contact_case *in, rb_case_contact *c);
/* The case before (NULL: none) and its solution (n = 0: not solved): does not run where
 * it cannot go on from them. */
void rb_case_contact_follow(const rb_case_contact *before,
                            const rb_rolling_solution *solution, rb_case_contact *c);
/* One that runs.  before: as above; solution: overwritten; free it in any case.  Errors
 * as rb_rolling_solve_between and rb_rolling_step_between. */
rb_status rb_case_contact_solve(const rb_case_contact *c,
                                const rb_rolling_solution *before,
                                rb_rolling_solution *solution, rb_message *why);
/* FRIC_POWER as CONTACT counts it [N m/s], < 0: each element's friction times its own
 * slip, without what the third body takes by yielding.  NAN where nothing rolls. */
double rb_case_contact_power(const rb_io_contact_case *in, const rb_case_contact *c,
                             const rb_rolling_solution *before,
                             const rb_rolling_solution *s);

/* ---- Whose fault it is ------------------------------------------------------------- */

/* 1: an option of body B that --similar copies from A. */
int rb_case_is_copied_to_b(const char *option);
/* Who gave the option of that name; 0: it has its default. */
int rb_case_given(const rb_case *c, const char *name);
/* Turns a refusal s of rollbem/rolling.h into one of this case: the file and the line
 * where the error stands in one of them.  Returns the status that says which. */
rb_status rb_case_locate(const rb_case *c, rb_status s, rb_message *why);

RB_PUBLIC_END

#endif
