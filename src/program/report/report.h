/* Writes solutions as tables, JSON, summaries and pictures.  Formats: docs/tables.md.
 * Numbers that are read back are exactly those that were computed: tables have the fewest
 * digits for this, JSON has 17. */
#ifndef ROLLBEM_REPORT_H
#define ROLLBEM_REPORT_H

#include "lcp/friction/friction.h"
#include "analysis/sensitivity/derivatives.h"
#include "analysis/crack/crack_case.h"
#include "analysis/fit/fit_case.h"
#include "rolling/case/case.h"
#include "analysis/design/design.h"
#include "analysis/prony/prony.h"
#include "rolling/rolling.h"

#include <stdio.h>

struct json_t; /* jansson's */

/* Lines of text on the signs of creepage, slip and zones; NULL ends the list. */
extern const char *const rb_report_conventions[];

/* ---- Tables of any kind ------------------------------------------------------------ */

/* TSV has the names of the columns, # lines and rows.  The names come first because numpy
 * reads them from the first line even if it is a comment; other readers skip comments
 * anywhere. CSV has names and rows only, for spreadsheets, which do not support comments;
 * a cell without a number is empty. */
typedef enum { RB_REPORT_TSV, RB_REPORT_JSON, RB_REPORT_CSV } rb_report_format;

typedef struct {
    rb_report_format format; /* of a table; for JSON there are separate functions below */
    int bare;                /* 1: no # lines */
    int dimensionless;       /* 1: of tractions and stress in the half-width and p0 */
} rb_report_style;

/* A table that is written cell by cell. */
typedef struct {
    FILE *out;
    rb_report_style style;
    int cells; /* number of cells written in the current row */
} rb_report_cells;

/* Writes the names of the columns, which are separated by blanks; if names is "", the
 * caller writes them as cells. */
rb_report_cells rb_report_cells_begin(FILE *out, const rb_report_style *style, const char *names);
/* Writes a text; it is quoted if it contains a separator, a blank, a quotation mark or
 * #. */
void rb_report_cell_text(rb_report_cells *c, const char *text);
/* Writes words with "-" instead of blanks, because numpy splits cells at blanks. */
void rb_report_cell_words(rb_report_cells *c, const char *words);
/* Writes a number with the fewest digits from which the same number is read again; if it
 * is not finite, NaN, or nothing in CSV. */
void rb_report_cell_number(rb_report_cells *c, double x);
void rb_report_cell_whole(rb_report_cells *c, int n);
void rb_report_cells_end_row(rb_report_cells *c);
/* Writes a # line if the style has such lines. */
void rb_report_comment(const rb_report_cells *c, const char *format, ...) RB_PRINTF(2, 3);
/* Writes # lines with version and command. */
void rb_report_comment_origin(const rb_report_cells *c, const char *command);
/* RB_EWRITE: see errno. */
rb_status rb_report_flush(FILE *out);

/* Properties of a terminal. */
typedef struct {
    int rows, columns;
    int colour;        /* 1: ANSI colours for zones and failures */
    const char *minor; /* names of columns, each between blanks, that are omitted first if
                          not all fit; NULL: none */
} rb_report_window;

/* Writes a table with tabs for a terminal, with five digits and the units below the
 * names.  If there are more rows than the window has, only every k-th row is shown, or,
 * if the first column is not a number, the rows in the middle are omitted.  Columns with
 * the same value in every row, and the names of columns that do not fit, are shown in
 * lines below. A single row that is too wide is shown with one line per column.  A text
 * that is not such a table is written unchanged.  The function changes text.  RB_ENOMEM,
 * RB_EWRITE. */
rb_status rb_report_terminal(FILE *out, char *text, const rb_report_window *window);
/* Writes lines of text, broken between words at the given width; returns the number of
 * lines. */
int rb_report_wrapped(FILE *out, const char *text, int width);

/* 1: the contact has a half-width and a largest pressure, which dimensionless tables and pictures
 * divide by. */
int rb_report_has_scales(const rb_rolling_solution *s);

/* ---- Table ------------------------------------------------------------------------ */

/* One row per contact element; # lines with version, command, conventions, status,
 * residual, and the notes (NULL: none).  rc: for dimensionless tables.  RB_EWRITE: see errno. */
rb_status rb_report_table(FILE *out, const rb_rolling_case *rc, const rb_rolling_solution *s,
                          const rb_rolling_note_list *notes, const char *command,
                          const rb_report_style *style);

/* The steps of a transient or a static history, one row each, below the notes (NULL: none); error
 * bars, if any, are in additional columns error_*. */
rb_status rb_report_history(FILE *out, const rb_rolling_history *h,
                            const rb_rolling_note_list *notes, const char *command,
                            const rb_report_style *style);

/* ---- JSON ------------------------------------------------------------------------- */

/* Objects returned here are new references, or NULL if there is no memory.
 * rb_report_json_set and _append take ownership of the value.  If the value is NULL or
 * cannot be stored, they free *object and set it to NULL; later calls do nothing. */
void rb_report_json_set(struct json_t **object, const char *name, struct json_t *value);
void rb_report_json_append(struct json_t **list, struct json_t *value);

/* {"schema", "version", "command", "conventions"}: the first members of every result. */
struct json_t *rb_report_json_start(const char *command);
/* {"system": "si", "length": "m", ...}. */
struct json_t *rb_report_json_units(rb_units units);
/* A text, also with bytes that are not UTF-8 (rb_printable). */
struct json_t *rb_report_json_text(const char *text);
/* A number; null for NaN and infinities. */
struct json_t *rb_report_json_number(double x);
struct json_t *rb_report_json_numbers(int n, const double *x);
/* "proved", "proved but for 2 pairs", "not proved"; the whole sentence; the object `proof`.
 * text: written and returned. */
const char *rb_report_proof_status(const rb_lcp_proof *proof, char *text, size_t size);
const char *rb_report_proof_text(const rb_lcp_proof *proof, char *text, size_t size);
struct json_t *rb_report_json_proof(const rb_lcp_proof *proof);
/* "proved: exactly 3 solutions", "proved: at least 2 solutions, at most 4; ..."; the object
 * `number`. */
const char *rb_report_number_text(const rb_lcp_number *number, char *text, size_t size);
struct json_t *rb_report_json_number_of_solutions(const rb_lcp_number *number);
/* The sentence and the object of reactions, and those of a contact. */
const char *rb_report_friction_proof_text(const rb_friction_proof *proof, char *text, size_t size);
struct json_t *rb_report_json_friction_proof(const rb_friction_proof *proof);
const char *rb_report_contact_proof_text(const rb_contact_proof *proof, char *text, size_t size);
struct json_t *rb_report_json_contact_proof(const rb_contact_proof *proof);
struct json_t *rb_report_json_summary(const rb_rolling_solution *s);
/* The value of an option in the struct of its table. */
struct json_t *rb_report_json_option(const rb_option *option, const void *values, rb_units units);
/* Sets each of n options in the object. */
void rb_report_json_options(struct json_t **inputs, int n, const rb_option *options,
                            const void *values, rb_units units);
/* Every value that the resolved case uses, defaults included, and those of its crack. */
struct json_t *rb_report_json_inputs(const rb_case *c);
/* A hash of these values and of the contents of the files that they name; it tells if two
 * results have the same inputs.  RB_ENOENT, RB_EFORMAT: of a file; RB_ENOMEM. */
rb_status rb_report_input_hash(const rb_case *c, uint64_t *hash, rb_message *why);
/* The hash as 16 hexadecimal digits; null if a file cannot be read any more; NULL: no
 * memory. */
struct json_t *rb_report_json_input_hash(const rb_case *c);
/* The columns of rb_report_table; the second function adds the power of friction in
 * rolling. */
struct json_t *rb_report_json_table_columns(const rb_rolling_solution *s);
struct json_t *rb_report_json_table(const rb_rolling_solution *s);
/* One line for each solution. */
void rb_report_solutions(FILE *out, const rb_rolling_solutions *all);
/* The JSON Schema of all results, rollbem/1. */
struct json_t *rb_report_json_schema(void);
struct json_t *rb_report_json_errors(const rb_rolling_errors *errors);
struct json_t *rb_report_json_history(const rb_rolling_history *h);
/* The states of all steps in mm and MPa as lists of lists; `motion` is the rigid shift
 * [mm] of a static step and the creepage of a rolled step. */
struct json_t *rb_report_json_states(const rb_rolling_states *s);

/* The command line, without `rollbem`, in the comments of a table of any command; owned
 * by the caller.  RB_EFORMAT: the table has none. */
rb_status rb_report_table_command(const char *text, char **line);
/* Writes json with a final newline and frees it.  RB_ENOMEM: json is NULL; RB_EWRITE. */
rb_status rb_report_json_write(FILE *out, struct json_t *json);

/* ---- Summaries for readers --------------------------------------------------------- */

/* Writes the zones of the elements as characters, from just before the contact to just
 * after it, at most width characters: o separated, * stick, S slip, = contact without friction, .
 * elsewhere.  strip: width + 1 characters, width >= 8. */
void rb_report_strip(const rb_rolling_solution *s, int width, char *strip);
/* A summary of a few lines; width: of the terminal. */
void rb_report_summary(FILE *out, const rb_rolling_solution *s, int width);
/* What both bodies are made of, in a line. */
void rb_report_bodies(FILE *out, const rb_rolling_case *rc, rb_units units);
/* Values with their error bars, as many in a line as its width has room for; 0: one. */
void rb_report_errors(FILE *out, const rb_rolling_solution *s, const rb_rolling_errors *e,
                      int width);
void rb_report_history_summary(FILE *out, const rb_rolling_case *rc, const rb_rolling_history *h);
/* Notes as an array of JSON, or as lines of text. */
struct json_t *rb_report_json_notes(const rb_rolling_note_list *notes);
void rb_report_notes(FILE *out, const rb_rolling_note_list *notes, int colour);

/* References to the methods used; s NULL: the solver is not known. */
void rb_report_citations(FILE *out, const rb_rolling_case *rc, const rb_rolling_solution *s);

/* ---- Pictures --------------------------------------------------------------------- */

typedef enum {
    RB_REPORT_PNG,
    RB_REPORT_SVG,
    RB_REPORT_PDF,
    RB_REPORT_EPS,
    RB_REPORT_TEX, /* TikZ, for \input into a LaTeX document with gnuplot-lua-tikz.sty */
    RB_REPORT_GIF  /* frame by frame: of a history only */
} rb_report_picture_kind;
/* Those of every picture, as help and refusals name them. */
#define RB_REPORT_KINDS ".png, .svg, .pdf, .eps or .tex"

/* Sizes for a column and a page of a paper, with letters of 6 and 7 points, and for a
 * slide, 16:9. */
typedef enum {
    RB_REPORT_OWN_SIZE,
    RB_REPORT_85MM,
    RB_REPORT_170MM,
    RB_REPORT_SLIDE
} rb_report_picture_size;

/* Format and size of a picture. */
typedef struct {
    rb_report_picture_kind kind;
    rb_report_picture_size size;
    int script;        /* 1: write gnuplot's input with the data instead of the picture */
    const char *own;   /* a template instead of the picture's, or NULL */
    int dimensionless; /* 1: x/a, p/p0, q/(mu p0), depth/a of tractions and stress */
} rb_report_canvas;

/* gnuplot makes all pictures; they are written completely or not at all.  RB_EHELPER:
 * gnuplot is missing or has failed; RB_EFORMAT: it does not understand the canvas's own template;
 * RB_EWRITE; RB_ENOMEM. */

/* By the end of the name.  RB_EINVAL: it is none of these. */
rb_status rb_report_picture_kind_of(const char *path, rb_report_picture_kind *kind,
                                    rb_message *why);

/* Tractions, friction bounds, zones and slip along the contact. */
rb_status rb_report_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                            const rb_rolling_solution *s, rb_message *why);

/* ---- Wear -------------------------------------------------------------------------- */

enum { RB_REPORT_WEAR_PROFILES = 6 };

/* Pressure and worn depth after a step. */
typedef struct {
    int n;
    double way;
    double *x, *p, *depth; /* owned: x holds them all */
} rb_report_wear_profile;

/* A computation of wear and the profiles that its picture shows. */
typedef struct {
    const rb_rolling_wear_history *history; /* borrowed */
    int profiles;
    rb_report_wear_profile profile[RB_REPORT_WEAR_PROFILES];
} rb_report_wear;

rb_status rb_report_wear_table(FILE *out, const rb_report_wear *w,
                               const rb_rolling_note_list *notes, const char *command,
                               const rb_report_style *style);
struct json_t *rb_report_json_wear(const rb_report_wear *w);
void rb_report_wear_summary(FILE *out, const rb_report_wear *w);
/* Stores the profile of the step if the picture shows this step.  s: in the units of the
 * picture; h: in mm, N, MPa.  RB_ENOMEM. */
rb_status rb_report_wear_keep(rb_report_wear *w, const rb_rolling_solution *s,
                              const rb_rolling_wear_history *h, int step, int steps);
rb_status rb_report_wear_picture(FILE *out, rb_report_canvas canvas, const rb_report_wear *w,
                                 rb_message *why);
void rb_report_wear_free(rb_report_wear *w);

/* ---- Cracks ------------------------------------------------------------------------ */

/* One row per position of the contact, all passes.  RB_EWRITE: see errno. */
rb_status rb_report_crack_table(FILE *out, const rb_case_crack_result *r,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style);
/* Sets "crack", "contact", "summary", "table", and adds to "notes". */
void rb_report_json_crack(struct json_t **root, const rb_case_crack_result *r);
/* Sets "faces", with a list per position, and the tractions of the contact,
 * "contact_table" or "history" with its states: what rollbem check needs.  In mm, N, MPa. */
void rb_report_json_crack_faces(struct json_t **root, const rb_case_crack_result *r);
/* A summary of a few lines, below its notes. */
void rb_report_crack_summary(FILE *out, const rb_case_crack_result *r, int colour);
/* Pictures of the last pass: K over the position with the zones of the faces below; K_II
 * over K_I; the crack at the position nearest to `at` [half-widths] with magnified
 * displacements of its faces. */
rb_status rb_report_crack_picture(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                                  rb_message *why);
rb_status rb_report_crack_orbit(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                                rb_message *why);
rb_status rb_report_crack_open(FILE *out, rb_report_canvas canvas, const rb_case_crack_result *r,
                               double at, rb_message *why);

/* ---- Creep curves ------------------------------------------------------------------ */

enum { RB_REPORT_CURVES = 16 };

/* One curve for each mu. */
typedef struct {
    int n; /* at least one */
    double mu[RB_REPORT_CURVES];
    rb_rolling_curve curve[RB_REPORT_CURVES];
    int has_errors;
    rb_rolling_curve error[RB_REPORT_CURVES]; /* with has_errors */
    const rb_rolling_case *rc;                /* of the curves */
    rb_case_slopes slopes[RB_REPORT_CURVES];  /* derivatives of each point; n = 0: not computed */
} rb_report_curves;

/* One row per mu and creepage; errors are in additional columns.  RB_EWRITE: see
 * errno. */
rb_status rb_report_curve_table(FILE *out, const rb_report_curves *curves,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style);
/* Sets "curve" to the curve of the first mu and, if there are several, "curves" to
 * all. */
void rb_report_json_curves(struct json_t **root, const rb_report_curves *curves);
/* A summary of a few lines. */
void rb_report_curve_summary(FILE *out, const rb_report_curves *curves);
/* Braking force -Q/(mu P) over xi R/(mu a) or xi; of several mu -Q/P over xi.  Carter's
 * law dashed; errors as bands. */
rb_status rb_report_curve_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                  const rb_report_curves *curves, rb_rolling_variable over,
                                  rb_message *why);

/* ---- Subsurface stress ------------------------------------------------------------- */

/* Stress at points of a body: a grid (nx x ny, row by row, y increasing) or, with nx = 0, n
 * points.  Grid points outside the body are left out. */
typedef struct {
    int of_b; /* 1: of body B */
    int nx, ny, n;
    int whole;                   /* 1: the grid is that of the whole wheel */
    double depth;                /* of the grid and of the maxima [length]; 0: 2.5 half-widths */
    const rb_rolling_stress *at; /* n; borrowed, as all here */
    const int *inside;           /* n; NULL: all */
    const rb_rolling_stress_maxima *maxima;
    const rb_rolling_stress_maxima *errors;    /* NULL: not computed */
    const rb_rolling_shakedown *shakedown;     /* NULL: not asked for */
    double yield_shear;                        /* k of A [stress]; NAN: not given */
    const rb_rolling_traction_rows *tractions; /* those given, whose totals s has; NULL: of a
                                                  contact */
    int pulls, jumps, by_friction; /* of these rows: with p < 0; where q jumps; p is zero in all */
    const rb_rolling_case *rc;
    const rb_rolling_solution *s;
} rb_report_stress;

/* Takes given tractions and counts in them, `model` being made of them. */
void rb_report_stress_take(rb_report_stress *s, const rb_rolling_traction_rows *tractions,
                           const rb_rolling_model *model);

/* One row per point; the maxima are in the header.  RB_EWRITE: see errno. */
rb_status rb_report_stress_table(FILE *out, const rb_report_stress *stress,
                                 const rb_rolling_note_list *notes, const char *command,
                                 const rb_report_style *style);
/* Sets "depth", "maxima", and "grid" or "points". */
void rb_report_json_stress(struct json_t **root, const rb_report_stress *stress);
/* The maxima, with their errors where known. */
void rb_report_stress_summary(FILE *out, const rb_report_stress *stress);
/* Contours of maximum shear and of von Mises over a grid. */
rb_status rb_report_stress_picture(FILE *out, rb_report_canvas canvas,
                                   const rb_report_stress *stress, rb_message *why);
/* Shakedown map: p0/k over Q/P with Johnson's curves and the point of the case. */
rb_status rb_report_shakedown_map(FILE *out, rb_report_canvas canvas,
                                  const rb_report_stress *stress, rb_message *why);
/* Photoelastic fringes: dark where sigma_1 - sigma_2 is a multiple of fringe [stress]; 0:
 * about ten of them. */
rb_status rb_report_fringes(FILE *out, rb_report_canvas canvas, const rb_report_stress *stress,
                            double fringe, rb_message *why);

/* Files of the Visualization Toolkit, for ParaView. */
typedef enum {
    RB_REPORT_VTI, /* regular grids: half-planes */
    RB_REPORT_VTU  /* any grid: quadrilaterals of points inside the body; points */
} rb_report_vtk_kind;

/* By the end of the name.  RB_EINVAL: neither .vti nor .vtu. */
rb_status rb_report_vtk_kind_of(const char *path, rb_report_vtk_kind *kind, rb_message *why);
/* RB_EINVAL: .vti for points or for the grid of a wheel, which follows its surface. */
rb_status rb_report_vtk_check(rb_report_vtk_kind kind, const rb_report_stress *stress,
                              rb_message *why);
/* RB_EWRITE: see errno.  RB_ENOMEM. */
rb_status rb_report_vtk(FILE *out, rb_report_vtk_kind kind, const rb_report_stress *stress);

/* ---- Steps ------------------------------------------------------------------------- */

/* Creepage or shift, force and stick over the rolled distance, or over the increments of
 * a static history; errors as bands. */
rb_status rb_report_history_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                    const rb_rolling_history *history, rb_message *why);
/* The tractions step by step, for RB_REPORT_GIF: a frame for each of at most 60 steps, of more for
 * as many at equal distances, at four frames in a second.  states: of all steps, in mm and MPa. */
rb_status rb_report_frames(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                           const rb_rolling_history *history, const rb_rolling_states *states,
                           rb_message *why);
/* Work of friction, Ruiz's second parameter and SWT of the last cycle over x. */
rb_status rb_report_fretting_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                     const rb_rolling_solution *s, rb_message *why);

/* ---- Parameter studies ------------------------------------------------------------- */

/* A column of a study's table. */
typedef struct {
    const char *name, *unit; /* unit in which it is shown; "": none */
    const double *value;     /* value for every case; NAN: not solved; NULL: no such quantity */
    const char *const *word; /* of x and y: words that stand for the values; NULL: none do */
} rb_report_quantity;

typedef struct {
    int n; /* cases, at least one */
    rb_report_quantity x,
        y; /* the varied quantities; one curve for each y, or the y axis of a map */
    rb_report_quantity shown;  /* the result */
    const rb_rolling_case *rc; /* a case with the bodies of all cases; NULL: the bodies differ */
    rb_units units;
    const double *half_width; /* of the band about the result, for every case; NULL: none */
    const char *band;         /* what it is: "estimated error" */
    int is_sample;            /* 1: the cases are points of a sample; without y */
    int points;               /* 1: the cases are on no grid: points, not curves */
    double rounding;          /* results that are all smaller are drawn as 0 */
} rb_report_study;

/* Checks a picture before the cases are solved.  RB_EINVAL: two cases at the same x and
 * y or a curve with a single point, unless they are points; more than RB_REPORT_CURVES curves;
 * for a map also words, or if a combination of x and y is missing. */
rb_status rb_report_study_check(const rb_report_study *study, int map, rb_message *why);
/* Curves of the result over x, one for each y, or the points of a sample; or a map of it over x
 * and y. */
rb_status rb_report_study_picture(FILE *out, rb_report_canvas canvas, const rb_report_study *study,
                                  int map, rb_message *why);

/* ---- Performance profiles ---------------------------------------------------------- */

/* rho_s(tau): fraction of the problems that solver s solves at a cost of at most tau
 * times the smallest cost of all solvers. */
typedef struct {
    int problems, solvers, n; /* n: values of tau */
    const char *const *solver;
    const char *measure; /* of the cost */
    const double *tau;   /* n */
    const double *rho;   /* n x solvers, column-major */
} rb_report_profiles;

rb_status rb_report_profiles_picture(FILE *out, rb_report_canvas canvas,
                                     const rb_report_profiles *profiles, rb_message *why);

/* ---- Prony series ------------------------------------------------------------------ */

/* Storage and loss modulus over the frequency: measured and fitted. */
typedef struct {
    const rb_prony_data *data;
    const rb_prony_series *series;
    rb_units units;
} rb_report_prony;

rb_status rb_report_prony_picture(FILE *out, rb_report_canvas canvas, const rb_report_prony *p,
                                  rb_message *why);

/* ---- Data behind the solution ------------------------------------------------------ */

/* Writes all data from which a solution was computed as Matrix Market files into a
 * folder: contact, mesh, H, G (of body A; with _b of body B; none for half-planes), F, M,
 * b and the scales of the LCP.  For a large contact, which has no matrices F and M, four
 * columns of F are written.  The folder is made if necessary, files of an older dump are
 * removed, and either all files are written or none.  docs/tables.md describes each file.
 * RB_EWRITE, RB_ENOMEM. */
rb_status rb_report_dump(const char *folder, const rb_rolling_model *model, rb_message *why);

/* Writes the model's problem, at its approach and creepage, and its tractions as an FCLib
 * file. RB_EINVAL: too large for a dense W; RB_EWRITE. */
rb_status rb_report_fclib(const char *path, const rb_rolling_model *model, rb_message *why);

/* Repeats Lemke's method and writes one line per pivot; with a folder also the tableau
 * after each pivot as tableau_1.mtx, ...  If another method found the solution, the LCP
 * is the one that Lemke's method would try first. */
rb_status rb_report_trace(FILE *out, const char *folder, const rb_rolling_model *model,
                          rb_message *why);

/* ---- Derivatives (case.h) ---------------------------------------------------------- */

enum { RB_REPORT_RESULTS_MAX = 64 };
/* The derivatives of a case that are shown. */
typedef struct {
    int n;     /* results by name; 0: all numbers */
    int named; /* 1: they were asked for by their names */
    const rb_rolling_result *result[RB_REPORT_RESULTS_MAX];
    int is_column[RB_REPORT_RESULTS_MAX];
    const rb_case_derivatives *all; /* borrowed; in the units of the output */
    rb_rolling_solution deviation;  /* standard deviations for given tolerances */
} rb_report_derivatives;

/* Reads a list of names of results, or "all".  RB_EINVAL: there is no such result, it has no
 * derivatives, or the case has it not. */
rb_status rb_report_derivatives_of(const char *names, const rb_resolved_case *c,
                                   rb_report_derivatives *d, rb_message *why);
/* Sets derivatives, or smooth_derivatives: {result: {input: number, or [left, right]}}; columns
 * have a list of numbers instead of a number. */
void rb_report_json_derivatives(struct json_t **root, const rb_report_derivatives *d);
/* tolerances: {result: standard deviation}. */
void rb_report_json_tolerances(struct json_t **root, const rb_report_derivatives *d);
/* derivatives_of: the names asked for (NULL: none); own_of_b: options of B that are given with the
 * value of A, with which B's otherwise vary. */
void rb_report_json_asked(struct json_t **root, const char *names, const rb_case *c);
/* uncertain_inputs: {input: standard deviation}. */
void rb_report_json_uncertain(struct json_t **root, const rb_case_tolerances *t, rb_units units);
/* The same of --tolerance of a curve or a study: numbers in the units of the result; what is given
 * in per cent of each value, or in other units, stays a text. */
void rb_report_json_uncertain_text(struct json_t **root, const char *text);
/* One row per result and input; the inputs of each result are ordered by the effect of
 * one per cent of the input. */
rb_status rb_report_derivative_table(FILE *out, const rb_rolling_solution *s,
                                     const rb_report_derivatives *d,
                                     const rb_rolling_note_list *notes, const char *command,
                                     const rb_report_style *style);
/* A short version on a terminal: the first rows of each result. */
rb_status rb_report_brief_derivatives(FILE *out, const rb_rolling_solution *s,
                                      const rb_report_derivatives *d);
void rb_report_tolerances(FILE *out, const rb_rolling_solution *s, const rb_report_derivatives *d);

/* The table of a history with derivatives: a row per step. */
rb_status rb_report_step_slopes(FILE *out, const rb_rolling_history *h, const rb_case_slopes *s,
                                const rb_rolling_note_list *notes, const char *command,
                                const rb_report_style *style);
/* derivatives: {result: {input: numbers, or where the two sides differ [left, right]}},
 * an entry per row; derivatives_note: rb_case_slopes_note. */
void rb_report_json_slopes(struct json_t **owner, const rb_case_slopes *s);

/* ---- Fits (case.h) ------------------------------------------------------------------ */

typedef struct {
    const rb_case_fit *fit; /* borrowed, as the data; in mm, N, MPa */
    const rb_case_data *data;
    rb_units units; /* that are shown */
} rb_report_fit;

/* parameters, residuals, fit (the curve and its band) and what belongs to them. */
void rb_report_json_fit(struct json_t **root, const rb_report_fit *f);
/* The fitted curve, a row per point, below comments with the parameters. */
rb_status rb_report_fit_table(FILE *out, const rb_report_fit *f, const char *command,
                              const rb_report_style *style);
void rb_report_fit_summary(FILE *out, const rb_report_fit *f);
/* Points, fitted curve of each test (rows of equal load, speed and temperature) and its band,
 * which is left out where some number is not identified. */
rb_status rb_report_fit_picture(FILE *out, rb_report_canvas canvas, const rb_report_fit *f,
                                rb_message *why);

/* ---- The JSON of a case, whole ------------------------------------------------------ */

/* What the JSON of a case shows beside its command line, inputs and units: a part that is NULL is
 * left out.  All is borrowed, in the units of the case. */
typedef struct {
    const char *command;
    const rb_case *words; /* resolved */
    const rb_rolling_note_list *notes;
    const rb_case_result *result;    /* summary, table and, of a sequence of steps, history */
    const rb_rolling_states *states; /* what its steps found; n = 0: not kept */
    const rb_case_slopes *slopes;    /* derivatives of its steps */
    const rb_report_stress *stress;
    const rb_case_crack_result *crack;
    int faces; /* 1: and its faces, with the contact that loads them */
    const rb_rolling_solutions *solutions;
    const rb_report_derivatives *derivatives; /* of the result */
    const rb_report_derivatives *deviations;  /* its standard deviations */
    const char *derivatives_of;               /* the names that were asked for */
    const rb_case_tolerances *uncertain;      /* the standard deviations that were given */
} rb_report_document;

struct json_t *rb_report_json_document(const rb_report_document *document);

/* ---- Designs ----------------------------------------------------------------------- */

/* A row per variable, below comments with the result and the constraints. */
rb_status rb_report_design_table(FILE *out, const rb_design *d, rb_units units, const char *command,
                                 const rb_report_style *style);
void rb_report_json_design(struct json_t **root, const rb_design *d, rb_units units);

#endif
