/* What src/analysis and src/program use of cases in words besides rollbem/case.h. */
#ifndef ROLLBEM_SRC_ROLLING_CASE_CASE_H
#define ROLLBEM_SRC_ROLLING_CASE_CASE_H

#include "base/io/io.h"
#include "base/io/io_contact.h"
#include "base/units.h"
#include "rolling/case/options.h"
#include "rolling/rolling.h"
#include "rollbem/case.h"

/* ---- Options --------------------------------------------------------------------- */

/* All n options and headings, in the order of the help; their offsets refer to
 * rb_resolved_case. */
const rb_option *rb_case_describe(int *n);

/* As rb_case_read.  also: n further tables whose keys the file may contain. */
rb_status rb_case_read_with(rb_case *c, const char *path, int n, const rb_option_set *also,
                            rb_message *why);

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

/* Copies a case.  The copy borrows files and texts of c, so free it before c.  NULL: no
 * memory. */
rb_case *rb_case_copy(const rb_case *c);

/* 0: every case of that purpose refuses the option. */
int rb_case_takes(rb_case_purpose purpose, const char *option);

/* The words for the variables of a curve, rb_rolling_variable. */
extern const rb_choice rb_case_curve_variables[];

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

/* The option table with the values as given; borrowed. */
rb_option_set rb_case_options(rb_case *c);

/* The option of this name, or NULL. */
const rb_option *rb_case_option(const char *name);
/* The word of option `name` for the choice `value`; NULL: there is none. */
const char *rb_case_word(const char *name, int value);
/* Name of the section of an option. */
const char *rb_case_section(const rb_option *option);

/* As rb_case_set, for a word, which is borrowed: many cases may be set one after the other. */
rb_status rb_case_set_word(rb_case *c, const char *name, const char *word, rb_message *why);

/* As rb_case_read, from the text of a case file; name: name of the file in messages. */
rb_status rb_case_read_text(rb_case *c, const char *name, const char *text, rb_message *why);

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
/* 1: the option means something where tractions are given, on half-planes, and nothing is solved.
 */
int rb_case_is_of_tractions(const char *option);
int rb_case_has_steps(const rb_resolved_case *resolved);

/* ---- Solving ----------------------------------------------------------------------- */

/* As rb_case_solve, but result holds the result of an earlier case (or is {0}); its model is used
 * again as by rb_rolling_model_reuse.  Steps and error bars are computed from the
 * beginning. */
rb_status rb_case_solve_again(const rb_resolved_case *resolved, rb_rolling_step *step,
                              void *context, rb_case_result *result, rb_message *why);
/* Converts the result from mm, N, MPa to the units of the case for printing; the model
 * stays in mm, N, MPa. */
void rb_case_result_convert(rb_case_result *result, rb_units units);

/* ---- Derivatives (sensitivity.h) --------------------------------------------------- */

enum { RB_CASE_NUMBERS_MAX = 64 };

/* Results with derivatives with respect to gap and mu of every element. */
typedef enum {
    RB_CASE_OVER_X_LOAD,
    RB_CASE_OVER_X_FORCE,
    RB_CASE_OVER_X_APPROACH,
    RB_CASE_OVER_X_CREEPAGE,
    RB_CASE_OVER_X_N
} rb_case_over_x;
extern const char *const rb_case_over_x_names[RB_CASE_OVER_X_N];

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

/* What fills the crack. */
typedef enum {
    RB_CRACK_DRY,
    RB_CRACK_TRAPPED, /* incompressible fluid is trapped where the mouth closes */
    RB_CRACK_PRESSURE /* the contact pressure at the mouth acts on the faces */
} rb_crack_fluid;

/* A crack in body B under the contact of a case, as given by the user.  Lengths are in
 * half-widths of the contact (rb_case_crack_result), or in mm where their bit is set; the
 * angle is in degrees. */
typedef struct {
    double length, angle, mouth, depth, friction;
    int elements;
    double from, to; /* positions of the contact; NAN: not given */
    int passes;
    int fluid;                  /* rb_crack_fluid */
    int locate_closing;         /* as in rb_crack_passage */
    double remote_stress;       /* [stress]; of a cycle the lowest */
    rb_numbers remote_stresses; /* one that stays, or the lowest and the highest of a cycle */
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

rb_case_crack rb_case_crack_defaults(void);
/* The options of the section [crack]; their offsets refer to rb_case_crack. */
extern const rb_option rb_case_crack_options[];
extern const int rb_case_crack_options_n;
/* A second set of options of the case, which takes them from now on: rb_case_set knows their
 * names, and the inputs of a case of RB_CASE_CRACK contain them. */
rb_option_set rb_case_crack_set(rb_case *c);
/* The crack of the resolved case in mm, N, MPa; NULL: it takes none. */
const rb_case_crack *rb_case_crack_of(const rb_case *c);
/* The numbers of rb_case_crack_summary and the columns of rb_crack_history and of
 * rb_case_crack_growth. */
extern const rb_rolling_results rb_case_crack_scalars, rb_case_crack_columns,
    rb_case_crack_growth_columns;

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
/* Half a material, of E and nu one given: the other one is the built-in example's, and the sentence
 * says so.  k: 0, 1, ... until it returns NULL; the text, or "" where nothing
 * is to say. */
const char *rb_case_half_material(const rb_case *c, int k, char *text, size_t room);
/* A modulus that was given as a hardness: how far the relations differ.  k as before. */
const char *rb_case_hardness(const rb_case *c, int k, char *text, size_t room);
/* The notes on a solution of the case (NULL: none), in its units, those on steps before it (NULL:
 * none), and these sentences behind them. */
rb_rolling_note_list rb_case_find_notes(const rb_case *c, const rb_rolling_solution *s,
                                        const rb_rolling_study_notes *of_steps);
/* Adds these sentences to the notes on a result, or on a row of a study, of kinds that begin here,
 * behind those of cracks. */
enum { RB_CASE_MATERIAL_NOTES = RB_ROLLING_NOTES - 11 };
void rb_case_note_materials(const rb_case *c, rb_rolling_note_list *notes);
void rb_case_note_materials_of_row(const rb_case *c, rb_rolling_row_notes *notes);
/* Adds what is said, if it is such a sentence with the values of the case: for one whose words were
 * read from a result, which names all values and not which of them were given. */
void rb_case_confirm_materials(const rb_case *c, const char *said, rb_rolling_note_list *notes);
/* Converts an error s of rollbem/rolling.h to an error of this case: if the wrong value
 * is in a file, the message gets the file and the line, and its numbers are said in the units of
 * the case.  Returns the status to report. */
rb_status rb_case_locate(const rb_case *c, rb_status s, rb_message *why);
/* Options of a command beside those of the case, two sets at most, which errors may be about too;
 * the set is borrowed.  NULL: no longer. */
void rb_case_also_locate(rb_case *c, const rb_option_set *set);

#endif
