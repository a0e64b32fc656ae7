/* The library for other languages: opaque handles, numbers, text and arrays of doubles,
 * no struct to mirror.  The page in a browser is made of it.
 *
 *     rb_api *a = rb_api_create();
 *     rb_api_set(a, "load", "500");
 *     if (rb_api_solve(a) < 0)
 *         puts(rb_api_message(a));
 *     double p0 = rb_api_number(a, "max_pressure");
 *     int rows, columns;
 *     const double *p = rb_api_array(a, "p", &rows, &columns);
 *     rb_api_free(a);
 *
 * Options and results are those of rb_case_describe and of the tables of
 * rollbem/rolling.h.  A status is an rb_status: 0 solved, negative refused, positive
 * ended without a solution; rb_api_message then says why. */
#ifndef ROLLBEM_API_H
#define ROLLBEM_API_H

typedef struct rb_api rb_api;

/* A case with the default options.  NULL: no memory. */
rb_api *rb_api_create(void);
void rb_api_free(rb_api *a);

/* One option by its name and the text of a case file.  A refused text changes nothing.
 * Whatever was solved before is forgotten; only where all options set since then are
 * friction, load, approach, shift, creepage or force, the next solve uses its flexibility
 * again. */
int rb_api_set(rb_api *a, const char *name, const char *text);
/* Whether the options agree with each other. */
int rb_api_settle(rb_api *a);
/* Settles and solves; of a sequence of steps each one is kept. */
int rb_api_solve(rb_api *a);

/* Of the last call that gave a status. */
int rb_api_status(const rb_api *a);
const char *rb_api_message(const rb_api *a);

/* ---- Descriptions, as text ----------------------------------------------------------
 * Each writes at most `size` bytes and returns text, or NULL: no such index or field. */

/* Field of option k = 0, 1, ...: "name", "section", "kind" (group, number, integer,
 * choice, flag, text), "unit", "expected" (the range in words), "from", "to", "choices"
 * (with blanks between), "word", "default", "excludes" (a bit mask), "help". */
const char *rb_api_option(int k, const char *field, char *text, int size);
/* Field of result k of a table ("number", "column", "step" or "point"): "name", "unit",
 * "kind" (number, whole, seconds), "meaning". */
const char *rb_api_result(const char *table, int k, const char *field, char *text,
                          int size);
/* Value of an option as settled. */
const char *rb_api_value(const rb_api *a, const char *name, char *text, int size);

/* ---- Results ------------------------------------------------------------------------
 */

/* A number of the solution by name; or "carter" (1: Carter's law holds), "radius",
 * "modulus", "hertz_load"; NAN: there is none. */
double rb_api_number(const rb_api *a, const char *name);

/* An array by name, rows x columns, column by column; borrowed until the case changes or
 * the array is made anew.  NULL: there is none, or no memory.
 *   p, q, x, zone ...            columns of the solution, an entry per element
 *   history.distance ...         of a sequence, an entry per step
 *   step.p step.q step.zone      elements x steps
 *   step.x                       its midpoints
 *   ends gap0                    of the elements; the gap without load
 *   F                            displacements (w_N, w_T) by tractions (r_N, r_T)
 *   mesh.x0 mesh.y0 mesh.x1 mesh.y1   boundary of a wheel
 *   H G                          its boundary elements' matrices
 *   curve.creepage ...           after rb_api_curve, an entry per point
 *   lcp.M lcp.q                  after rb_api_pivots, M z + q
 *   pivot.entering pivot.leaving pivot.row pivot.ratio pivot.z0   an entry per pivot
 *   pivot.basis pivot.value      rows x pivots: basic variables, and their values, after
 * it pivot.before pivot.column    rows x pivots: the values before it, and how they
 * change with the entering variable pivot.p pivot.q              elements x pivots:
 * tractions after it guess.p guess.q guess.gap guess.shift   after rb_api_guess, an entry
 * per element stress.x stress.y stress.max_shear stress.sxx ...   after rb_api_stress, nx
 * x ny */
const double *rb_api_array(rb_api *a, const char *name, int *rows, int *columns);

/* Each makes the arrays named after it from the case as it was solved. */

/* Steady rolling at so many creepage ratios from ... to. */
int rb_api_curve(rb_api *a, double from, double to, int points);
/* Lemke's method; variables are numbered w, z, z0 (rollbem/lcp.h). */
int rb_api_pivots(rb_api *a);
/* "p[3]", "lambda+[2]", "z0": name of a variable of rb_api_pivots; NULL: there is none.
 */
const char *rb_api_variable(const rb_api *a, int variable, char *text, int size);
/* The linear problem of these zones (0 separated, 1 stick, 2 and 3 slip), right or wrong.
 */
int rb_api_guess(rb_api *a, int n, const int *zone);
/* Stress below the surface of A on nx x ny points, to a depth in length (0: automatic).
 */
int rb_api_stress(rb_api *a, int nx, int ny, double depth);

#endif
