/* Declarations shared by the files of this folder. */
#ifndef ROLLBEM_REPORT_INTERNAL_H
#define ROLLBEM_REPORT_INTERNAL_H

#include "program/report/report.h"

/* Name of the solver that found the solution, as in the option `solver`. */
const char *rb_report_solver(const rb_rolling_solution *s);

/* The name of a unit in the system; "1" of NULL and "-", which are none. */
const char *rb_report_unit_name(rb_units units, const char *unit);

/* Returns 0 if x is only a rounding error of a sum of terms of this size, otherwise x;
 * for output to readers. */
double rb_report_tidy(double x, double size);
/* The creepage; 0 where a given force leaves nothing but rounding of it. */
double rb_report_creepage(const rb_rolling_solution *s);

/* ---- Columns by the tables of results ---------------------------------------------- */

/* What tables and pictures in the axes of textbooks are divided by, in units of the solution. */
typedef struct {
    double length, pressure, friction; /* a, p0, mu p0: without friction p0 */
    double mu;
} rb_report_scales;
rb_report_scales rb_report_scales_of(const rb_rolling_case *rc, const rb_rolling_solution *s);

/* The columns of a struct, or the numbers of an array of structs: values, error bars or
 * standard deviations; of error bars only those that there are. */
typedef struct {
    const rb_rolling_results *columns;
    const void *owner;
    enum { RB_REPORT_VALUES, RB_REPORT_ERRORS, RB_REPORT_DEVIATIONS } kind;
    rb_units units;
    size_t size;                    /* of a struct of the array; 0: owner has columns */
    const rb_report_scales *scales; /* NULL: numbers with units */
    const rb_rolling_case *rc;      /* whose results an array of structs shows; NULL: all */
} rb_report_columns;

/* 1: the column is there and shown. */
int rb_report_shows(const rb_report_columns *c, const rb_rolling_result *r);
double rb_report_entry(const rb_report_columns *c, const rb_rolling_result *r, int i);

/* Writes the headings of all parts as one row, and # lines with version, command,
 * conventions. */
rb_report_cells rb_report_begin_columns(FILE *out, const rb_report_style *style,
                                        const char *command, int parts,
                                        const rb_report_columns *part);
/* Write the headings, or entry i of every column, as cells of the current row. */
void rb_report_cell_headings(rb_report_cells *c, int parts, const rb_report_columns *part);
void rb_report_cell_entries(rb_report_cells *c, int i, int parts, const rb_report_columns *part);
/* The same of derivatives, where there are any. */
void rb_report_cell_slope_headings(rb_report_cells *c, const rb_case_slopes *s);
void rb_report_cell_slopes(rb_report_cells *c, const rb_case_slopes *s, int row);
/* What they are, and what must be known of those of each of n tables, as # lines; mu: the
 * coefficients of friction that tell several tables apart. */
void rb_report_comment_slopes(const rb_report_cells *c, int n, const rb_case_slopes *s,
                              const double *mu);
/* What the columns are divided by, if they are, as # lines. */
void rb_report_comment_scales(const rb_report_cells *c, const rb_report_columns *columns);
/* # lines with version, command, conventions. */
void rb_report_comment_head(const rb_report_cells *c, const char *command);
/* A note as a line of text, its first word in colour. */
void rb_report_note(FILE *out, const char *text, int colour);
/* Writes the notes as # lines.  notes: may be NULL; RB_ENOMEM: they are not complete. */
rb_status rb_report_comment_notes(const rb_report_cells *c, const rb_rolling_note_list *notes);
/* Rows of entries, to the end of the table.  RB_EWRITE: see errno. */
rb_status rb_report_end_columns(rb_report_cells *c, int rows, int parts,
                                const rb_report_columns *part);

/* Sets a list for each column, with its name or (headed = 1) its heading. */
void rb_report_json_columns(struct json_t **object, int rows, const rb_report_columns *c,
                            int headed);
/* A list for each of the steps: n numbers or whole numbers, `apart` entries from step to step;
 * by: what each number is divided by; NULL: nothing. */
struct json_t *rb_report_json_lists(int steps, int n, size_t apart, const double *x,
                                    const int *whole, const double *by);

/* An object of numbers. */
typedef struct {
    const char *name;
    double x;
} rb_report_named;
struct json_t *rb_report_json_named(int n, const rb_report_named *number);

/* ---- Stress ------------------------------------------------------------------------ */

int rb_report_stress_is_inside(const rb_report_stress *s, int k);

/* ---- Behind the solution ----------------------------------------------------------- */

/* Removes the files that rb_report_trace has written to the folder. */
void rb_report_remove_tableaux(const char *folder);

/* ---- Pictures ---------------------------------------------------------------------- */

/* Font size of keys. */
double rb_report_key_font(rb_report_canvas canvas);
/* Place of panels that start at `left` and have only a title above them.  A picture for a
 * column of print has no title (the caption replaces it): its panels are higher, and
 * begin further to the right, because the letters are larger. */
typedef struct {
    int titled;
    double right, up; /* in parts of the canvas */
} rb_report_place;
rb_report_place rb_report_place_of(rb_report_canvas canvas);
/* What the bodies are, the text `bodies` of a template. */
void rb_report_let_bodies(FILE *script, const rb_rolling_case *rc, rb_units units);
/* The title of a band in the key, the text `band_title` of a template, with the largest half-width,
 * because a narrow band is hidden by its curve; unit: "" of pure numbers. */
void rb_report_let_band(FILE *script, int is_error, double most, const char *unit, int titled);
/* The format of the numbers of a logarithmic axis: the powers alone where numbers would be longer
 * than their tics. */
const char *rb_report_log_format(double from, double to);
/* The zone of element i as pictures and strips show it: what touches without friction neither
 * sticks nor slips. */
enum { RB_REPORT_FRICTIONLESS = 6 };
int rb_report_zone(const rb_rolling_solution *s, int i);
/* A unit of an axis: values divided by `size` are in units of `name`. */
typedef struct {
    double size;
    const char *name;
} rb_report_unit;

/* A unit in which numbers up to `largest` are neither too long nor too small; unit: "MPa",
 * "MPa.mm^0.5" or "mm". */
rb_report_unit rb_report_axis_unit(rb_units units, const char *unit, double largest);
/* Lengths about a contact of half-width a, in the system's unit or, where that has too
 * many digits, in a: "[mm]", "/ a". */
typedef struct {
    double size;
    char label[16];
} rb_report_length;
rb_report_length rb_report_length_axis(rb_units units, double a);
/* The power of ten for showing small numbers up to `largest`; 0 for other numbers. */
int rb_report_exponent(double largest);
/* The next of 1, 2, 5 times a power of ten; the one before, at most x. */
double rb_report_round_step(double step);
double rb_report_round_down(double x);
/* "MPa.mm^0.5" as gnuplot writes it, exponents raised.  Returns text. */
const char *rb_report_raised(const char *unit, char text[40]);
/* So many digits, as 2·10^{5} where %g says 2e+05.  Returns text. */
const char *rb_report_number(double x, int digits, char text[40]);
/* The same in a text of the block in which it stands. */
#define RB_REPORT_NUMBER(x, digits) rb_report_number(x, digits, (char[40]){""})
/* "  [10^{-3} mm]", what an axis counts in, behind its name; "" for pure numbers: no power
 * of ten and no unit, which is "" or "-".  Returns text. */
const char *rb_report_counted_in(int exponent, const char *unit, char text[64]);
#define RB_REPORT_COUNTED_IN(exponent, unit) rb_report_counted_in(exponent, unit, (char[64]){""})
/* Number of labels that fit into this part of the canvas without touching. */
double rb_report_labels_in(double height);

/* Contour lines of a field on nx x ny points, x first. */
typedef struct {
    int nx, ny;
    /* x, y, value of point k in units of the axes; NAN: none */
    void (*point)(const void *of, int k, double at[3]);
    const void *of;
    double from[2], to[2]; /* of the axes x and y */
    int logarithmic[2];
    double first, step, last; /* levels */
    double letter[2];         /* font size of the numbers over width and height of the panel */
    const double *mark;       /* x, y that no number may cover, or NULL */
} rb_report_contours;

/* Writes the block $name: x, y and level, a row for each number at the lines. */
void rb_report_contour_numbers(FILE *script, const char *name, const rb_report_contours *contours);

typedef enum {
    RB_REPORT_FOUR_THIRDS,
    RB_REPORT_WIDE,   /* 12:5 */
    RB_REPORT_SCREEN, /* 16:9 */
    RB_REPORT_PANELS  /* the same, with panels side by side, which a column has no room for
                       */
} rb_report_shape;

/* Runs gnuplot on a script, which contains data blocks and no file names.  out receives
 * the complete picture or nothing.  RB_EHELPER: gnuplot is missing, has failed, or took
 * longer than `seconds`; RB_EWRITE: the disk is full; RB_ENOMEM. */
rb_status rb_report_gnuplot(FILE *script, rb_report_picture_kind kind, double seconds, FILE *out,
                            rb_message *why);

/* Copies a picture of TikZ, whose texts gnuplot hands on as they are, with these texts as LaTeX
 * sets them.  RB_EWRITE: see errno; RB_ENOMEM. */
rb_status rb_report_tex(FILE *picture, FILE *out);

/* Width and height of the canvas in font sizes of so many points. */
void rb_report_letters_in(rb_report_canvas canvas, rb_report_shape shape, double font,
                          double letters[2]);
double rb_report_width_over_height(rb_report_canvas canvas, rb_report_shape shape);

/* What a template of a picture reads, written one after the other: numbers, whole numbers, texts,
 * and tables as blocks, each with a line of headings. */
void rb_report_let(FILE *script, const char *name, double x);
void rb_report_let_whole(FILE *script, const char *name, int n);
void rb_report_let_text(FILE *script, const char *name, const char *format, ...) RB_PRINTF(3, 4);
/* The names that columns have for mm, MPa, N/mm, as mm, MPa, N_mm. */
void rb_report_let_units(FILE *script, rb_units units);
/* The block $name of a table that `write` writes with bare headings. */
typedef rb_status rb_report_write_table(FILE *out, const void *of, const rb_report_style *style);
void rb_report_let_table(FILE *script, const char *name, rb_report_write_table *write,
                         const void *of);

/* Draws a picture by the template of this name (pictures/NAME.gp) or the canvas's own, from
 * what `inputs` writes; or writes the whole script. */
typedef void rb_report_script(FILE *script, rb_report_canvas canvas, const void *view);
rb_status rb_report_draw(FILE *out, rb_report_canvas canvas, rb_report_shape shape,
                         const char *picture, rb_report_script *inputs, const void *view,
                         rb_message *why);

#endif
