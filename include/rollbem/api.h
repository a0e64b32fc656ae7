/* The library for other languages: opaque handles, numbers, text and arrays of doubles.
 * The caller needs no struct of C.  The page in the browser uses this interface.
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
 * Options are those of rb_api_option, results those of the tables of rollbem/rolling.h.
 * A status is an rb_status: 0: solved; negative: the input was refused; positive: the
 * solver ended without a solution.  rb_api_message then has the reason. */
#ifndef ROLLBEM_API_H
#define ROLLBEM_API_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

typedef struct rb_api rb_api;

/* Creates a case with the default options for rb_api_solve.  NULL: no memory. */
rb_api *rb_api_create(void);
/* The same for one of the commands "solve", "curve", "stress", "crack", "wear" or
 * "sweep"; they differ in the options that they refuse and in some defaults.  NULL:
 * unknown command, or no memory. */
rb_api *rb_api_create_for(const char *purpose);
void rb_api_free(rb_api *a);

/* Reads the keys of a case file.  Options that rb_api_set has set keep their values. */
int rb_api_read(rb_api *a, const char *path);

/* Sets one option, with a text as in a case file.  A refused text changes no option; the case is
 * then refused with the same message until the option is set to a valid value (a file: until it is
 * read). The call discards the solution.  If only friction, load, approach, shift, creepage or
 * force were set since the last solve, the next solve reuses the flexibility. */
int rb_api_set(rb_api *a, const char *name, const char *text);
/* Checks that the options are consistent. */
int rb_api_resolve(rb_api *a);
/* Resolves and solves the case; of a sequence of steps every step is kept. */
int rb_api_solve(rb_api *a);
/* May be called from another thread or a signal handler.  Whatever takes long, a call or an
 * array that rb_api_array computes, ends within parts of a second with RB_INTERRUPTED (an
 * array: NULL); only an LU of thousands of unknowns is finished first.  Steps and passes that
 * were complete are kept.  The handle may be used and freed once the call has returned, not
 * before.  A stop that comes before a call begins is forgotten. */
void rb_api_stop(rb_api *a);
/* Stops the call of another thread, again and again, until that thread has stored a number other
 * than 0 in *over, behind the call. */
void rb_api_stop_until(rb_api *a, const volatile int *over);
/* Steps of a history, of wear or of a pass over a crack, points of a curve, cases of a sweep, steps
 * of a fit (of 0), or evaluations of a design, that the running call has done, of so many; 0 of 0
 * where the call does not count.  May be asked from another thread. */
void rb_api_progress(const rb_api *a, int *done, int *total);

/* Status and message of the last call that returned a status. */
int rb_api_status(const rb_api *a);
const char *rb_api_message(const rb_api *a);

/* ---- Descriptions, as text --------------------------------------------------------- */

/* Each of these functions writes at most `size` bytes and returns text, or NULL if there
 * is no such index or field. */

/* Field of option k = 0, 1, ...: "name", "section", "kind" (group, number, integer,
 * choice, flag, text), "unit", "expected" (the range in words), "from", "to", "choices"
 * (with blanks between), "word", "default", "excludes" (a bit mask), "help". */
const char *rb_api_option(int k, const char *field, char *text, int size);
/* The same of the options of a crack (rb_api_crack). */
const char *rb_api_crack_option(int k, const char *field, char *text, int size);
/* Field of result k of a table ("number", "column", "patch", "step", "point",
 * "wear", "stress", "maximum", "crack", "position" or "growth"): "name", "unit", "kind"
 * (number, whole, seconds), "meaning". */
const char *rb_api_result(const char *table, int k, const char *field, char *text, int size);
/* Value of an option after rb_api_resolve, a number in the units of the case. */
const char *rb_api_value(const rb_api *a, const char *name, char *text, int size);
/* The unit of a system ("mm", "si", "inch") that stands for one of mm, N, MPa, which the
 * descriptions name: "Pa" for "MPa" in SI.  NULL: there is no such system. */
const char *rb_api_unit(const char *system, const char *unit, char *text, int size);

/* ---- Results ----------------------------------------------------------------------- */

/* In the units of the case, its option `units`, as are all numbers that are handed over: mm, N
 * and MPa unless it says otherwise.  The matrices and vectors of an LCP (lcp.M, lcp.q, pivot.value
 * ...) stay in mm, N and MPa.
 *
 * A number of the solution by name, its error bar as "error.NAME"; or "carter" (1:
 * Carter's law holds), "radius", "modulus", "hertz_load"; "curve.mu" (that of
 * force_ratio), "curve.free_creepage", "curve.half_width", "history.half_width",
 * "history.steady_from" (counted from 0), "history.cycle_work", "history.cycle_rows",
 * "history.jump_row" (counted from 1), "history.jump_shift", "history.jump_force";
 * "task.iterations", "task.residual", "task.scaled_residual" of rb_api_lcp and rb_api_friction.
 * NAN: there is none. */
double rb_api_number(const rb_api *a, const char *name);
/* "status", in words; of a solution "formulation", "solver", "lcp-form"; "task.solver";
 * after rb_api_derivatives "elements": whether they move while an input changes; after
 * rb_api_fit "fit.sentences": what the data do not determine, a line each; after
 * rb_api_design "design.variables" and "design.constraints": names, blanks between.  Text
 * that stays until the next call, or NULL. */
const char *rb_api_word(const rb_api *a, const char *name);
/* Note k = 0, 1, ... on how the solution must be read; writes at most `size` bytes and
 * returns text.  After a curve or a sweep they are those on its points or cases, each with the
 * points or cases that it is true of.  NULL: there is no such note, or no solution. */
const char *rb_api_note(const rb_api *a, int k, char *text, int size);

/* An array by name, rows x columns, column by column; borrowed until the case changes or
 * the array is computed again.  NULL: there is no such array, or no memory.
 *   p, q, x, zone ...            columns of the solution, an entry per element
 *   friction_power               energy that wear takes, an entry per element
 *   patch.from ...               an entry per patch of the contact
 * history.distance ... of a case with steps, an entry per step;
 *                                history.error.distance ... where errors were asked for;
 *                                history.tolerance.approach ... after rb_api_tolerances;
 *                                history.derivative.approach:mu ... after
 *                                rb_api_step_derivatives
 *   step.p step.q step.zone      elements x steps
 *   step.x                       its midpoints
 *   ends gap0                    of the elements; the gap without load
 *   closed.p closed.q            Hertz and Carter where Carter's law holds ("carter")
 *   F                            displacements (w_N, w_T) by tractions (r_N, r_T)
 *   mesh.x0 mesh.y0 mesh.x1 mesh.y1   boundary of a wheel
 *   H G                          its boundary elements' matrices
 *   curve.creepage ...           after rb_api_curve, an entry per point; curve.error. ...
 *   curve.derivative.approach:mu ...   after rb_api_curve, points x 2: for a
 *                                falling and for a growing mu; NAN: none
 *   curve.tolerance.tangential_load ...   with uncertain inputs: standard deviations of the
 *                                columns that have derivatives
 *   lcp.M lcp.q                  after rb_api_pivots, M z + q
 *   pivot.entering pivot.leaving pivot.row pivot.ratio pivot.z0   an entry per pivot
 *   pivot.basis pivot.value      rows x pivots: basic variables, their values after it
 *   pivot.before pivot.column    rows x pivots: the values before it, and how they change
 *                                with the entering variable
 *   pivot.p pivot.q              elements x pivots: tractions after it
 *   newton.zone newton.p newton.q   after rb_api_newton, elements x steps: the zones that
 *                                each step assumes, and the tractions that they lead to
 *   guess.p guess.q guess.gap guess.shift   after rb_api_guess, an entry per element
 *   stress.x stress.y stress.max_shear ...  after rb_api_stress, nx x ny, or
 *                                rb_api_stress_at, an entry per point
 *   maxima.max_shear ...         after rb_api_stress_maxima: value, x, y, material (0: A is
 *                                of one, 1: its layer or cover, 2: the base below, 3: the
 *                                first of several layers, 4: the second, and so on); also
 *                                tresca_shear, von_mises, orthogonal_shear, tension,
 *                                compression; maxima.bond_1_peel, maxima.bond_1_shear,
 *                                maxima.bond_1_tension_above, maxima.bond_1_tension_below and
 *                                so on to the last bond, of layers and covers
 *   crack.x crack.K_I crack.K_II ...        after rb_api_crack, an entry per position
 *   crack.summary.K_I_max ...    one number each
 *   crack.growth.length crack.growth.cycles ...   with "paris", an entry per length
 *   crack.opening crack.sliding crack.zone  nodes x positions; so are crack.pressure and
 *                        crack.friction, the tractions of the faces
 *   crack.node.x crack.node.y crack.node.length   an entry per node: its place, and the
 *                                length that it stands for
 *   crack.node.t_x crack.node.t_y           the direction of the crack there
 *   crack.path.x crack.path.y    corners of the crack, from its mouth to the tip
 *   derivative.NAME              after rb_api_derivatives, of a number or a column of the
 *                                solution, rows x (2 per input): for a falling and for a
 *                                growing input; NAN: none
 *   derivative.value             the inputs' values
 *   derivative.NAME.gap derivative.NAME.mu   of normal_load, tangential_load, approach
 *                                and creepage, with respect to gap and mu of each element
 *   tolerance.NAME               after rb_api_tolerances, of a number of the solution: its
 *                                standard deviation
 *   fit.value fit.interval.from fit.interval.to fit.deviation   after rb_api_fit, an entry per
 *                                parameter; NAN: not identified
 *   fit.mesh                     what the mesh leaves in the values, of a case with error bars
 *   fit.identified fit.at_bound  1 or 0
 *   fit.correlation              parameters x parameters
 *   fit.creep fit.force fit.fitted fit.band   an entry per point: the data, by the name of their
 *                                column (fit.creep_ratio, fit.force_over_load ...), and the
 *                                fitted curve
 *   fit.chi_square fit.degrees_of_freedom fit.noise fit.kappa fit.iterations   one number each
 *   design.value design.start    after rb_api_design, an entry per variable, in the units of
 *                                the case
 *   design.gap.x                 places of those that are values of the table of the gap
 *   design.constraint            constraints x 3: 1 for >= or 0 for <=, bound, value
 *   design.result design.result.start design.evaluations   one number each
 *   wear.way wear.worn ...       after rb_api_wear, an entry per step
 *   wear.profile.x wear.profile.depth   the worn depth at the end, over x
 *   sweep.status sweep.NAME ...  after rb_api_sweep, an entry per case; of cracks also the
 *                                names of crack.summary
 *   sweep.derivative.approach:mu ...   after rb_api_sweep
 *   sweep.tolerance.approach ...   with uncertain inputs: standard deviations
 *   lcp.z lcp.w                  after rb_api_lcp, rb_api_lcp_sparse
 *   lcp.all                      after rb_api_lcp_all, n x solutions
 *   lcp.singular_basis           1: of a singular basis only, an entry per solution
 *   lcp.nearby                   1: a solution within rounding only, likewise
 *   lcp.bases                    how many were tried, are singular, and are undecided
 *   game.z game.regret game.payoff   after rb_api_game: both strategies below each other, what each
 *                                pays less than the best reply, and the two best replies
 *   game.all ...                 of all equilibria, as lcp.all
 *   friction.r friction.u        after rb_api_friction, dimension x contacts */
const double *rb_api_array(rb_api *a, const char *name, int *rows, int *columns);

/* Each of these functions computes the arrays that are named after it from the solved case. */

/* A creep curve of the case: steady rolling at `points` values between from and to of over,
 * "creep-ratio", "creep" or "speed", with error bars if the case has them.
 * derivatives: at every point those of the single case that the point is: RESULT (with respect to
 * every number of the case) or RESULT:OPTION, separated by commas; "all" in the place of RESULT;
 * NULL: none.  tolerance: uncertain inputs as of rb_api_tolerances, for curve.tolerance.NAME; NULL:
 * none; per cent are those of the point's own numbers.  With either the case must be steady and
 * have no error bars.  Without derivatives at some points rb_api_note says why. */
int rb_api_curve(rb_api *a, const char *over, double from, double to, int points,
                 const char *derivatives, const char *tolerance);
/* Lemke's method; variables are numbered w, z, z0 (rollbem/lcp.h). */
int rb_api_pivots(rb_api *a);
/* Newton's method from a contact that sticks everywhere. */
int rb_api_newton(rb_api *a);
/* Proves the solution, of steps the last one (docs/proof.md).  Then rb_api_number has proof.proved,
 * proof.undecided (elements), proof.isolated, proof.bound_p, proof.bound_q, proof.stored_within,
 * proof.nearby, proof.margin, proof.norm, and rb_api_word proof.reason and proof.unique. */
int rb_api_prove(rb_api *a);
/* "p[3]", "lambda+[2]", "z0": name of a variable of rb_api_pivots; NULL: there is none. */
const char *rb_api_variable(const rb_api *a, int variable, char *text, int size);
/* Solves the linear equations for the given zones (0 separated, 1 stick, 2 and 3 slip),
 * whether they are right or wrong. */
int rb_api_guess(rb_api *a, int n, const int *zone);
/* Whose stress the functions below compute from now on: 0: A's (as at first), 1: B's, at y <= 0. */
int rb_api_stress_of(rb_api *a, int of_b);
/* Instead of solving the case of a handle for "stress": pressure and friction on A at n places of a
 * half-plane, x increasing, linear between them and zero outside; twice the same x is a jump. */
int rb_api_tractions(rb_api *a, int n, const double *x, const double *p, const double *q);
/* Stress below the surface on nx x ny points, y increasing, down to a depth [length] (0:
 * automatic). */
int rb_api_stress(rb_api *a, int nx, int ny, double depth); /* INFINITY: of the whole wheel */
/* Moves the contact of a handle for "crack" over a crack in body B.  names and values: n
 * options of `rollbem crack` ("crack-angle", "45"). */
int rb_api_crack(rb_api *a, int n, const char *const *names, const char *const *values);
/* Computes the wear of a handle for "wear" like `rollbem wear`: law "archard" or "dissipation",
 * coefficient K [1/stress], share of B.  A slides by `slide` [length]; if that is NAN, A frets or
 * rolls for `cycles` cycles or turns.  steps: number of steps, each of which is implicit and stable
 * for any length; quarter: increments per quarter of a cycle of fretting. */
int rb_api_wear(rb_api *a, const char *law, double coefficient, double share, double slide,
                double cycles, int steps, int quarter);
/* Derivatives of every number and column of the solution with respect to every number of the case,
 * on the elements of the solution.  The case must have one step and no error bars. */
int rb_api_derivatives(rb_api *a);
/* The same arrays without the jumps where an element changes between stick and slip
 * (theory-solvers.md D8), as of `rollbem --smooth-derivatives`; none with respect to gap and mu of
 * each element. */
int rb_api_smooth_derivatives(rb_api *a);
/* Field of input k = 0, 1, ... of the derivatives: "name" (of its option; "mu-fall-2":
 * the second number of its list), "unit", "refusal" (the reason why it has no
 * derivatives, or ""). NULL: no such input or field. */
const char *rb_api_input(const rb_api *a, int k, const char *field, char *text, int size);
/* Derivatives of the columns of the history of a solved case with steps, after every step;
 * `derivatives` as of rb_api_curve, RESULT a column of the history.  Where the
 * two sides differ they are those for a growing input; then rb_api_note says so.  tolerance:
 * inputs as of rb_api_tolerances, for history.tolerance.NAME, computed in the same run over the
 * steps.  NULL: none of them. */
int rb_api_step_derivatives(rb_api *a, const char *derivatives, const char *tolerance);
/* Resolves the case and checks, before it is solved, what rb_api_step_derivatives and
 * rb_api_tolerances would be asked (NULL: nothing). */
int rb_api_check_derivatives(rb_api *a, const char *derivatives, const char *tolerance);
/* Field of array k = 0, 1, ... of derivatives of a "curve", of "history" or of a "sweep":
 * "name" (RESULT:OPTION, as in the name of the array), "result", "input", "unit" (of the
 * input).  NULL: no such array or field. */
const char *rb_api_derivative(const rb_api *a, const char *of, int k, const char *field, char *text,
                              int size);
/* Standard deviations of the numbers of the solution to first order, from those of inputs
 * as `rollbem --tolerance` takes them: "mu=0.02,radius=1%"; of a case with steps those of
 * the columns of its history.  Single solutions take smooth derivatives where there are any. */
int rb_api_tolerances(rb_api *a, const char *inputs);
/* Fits numbers of the case to measured forces, as `rollbem fit`.  data: rows x columns,
 * column by column, of these names; names, start (NULL: none) and bounds (NULL: none) as
 * --fit, --start, --bounds; sigma NAN: from a column or the residuals; level of the
 * intervals.  Numbers are in the units of the case unless they have one.  A positive
 * status leaves the numbers so far in fit.value. */
int rb_api_fit(rb_api *a, int columns, const char *const *column, int rows, const double *data,
               const char *names, const char *start, const char *bounds, double sigma,
               double level);
/* The same with the data of a file. */
int rb_api_fit_file(rb_api *a, const char *path, const char *names, const char *start,
                    const char *bounds, double sigma, double level);
/* Minimises (largest 1: maximises) a result over numbers of the case, as `rollbem design`:
 * over and subject (NULL: none) as --over and --subject, span NAN: all elements, at most
 * so many evaluations.  After RB_MAXITER or RB_INTERRUPTED the arrays hold the best values
 * so far, if there are any. */
int rb_api_design(rb_api *a, const char *result, int largest, const char *over, const char *subject,
                  double span, int evaluations);
/* Stress at n points x0, y0, x1, y1, ... inside A, y > 0. */
int rb_api_stress_at(rb_api *a, int n, const double *xy);
/* The largest stresses and their places, down to a depth [length] (0: automatic). */
int rb_api_stress_maxima(rb_api *a, double depth);

/* ---- Problems without a case ------------------------------------------------------- */

/* These functions do not use or change the case of the handle. */

/* z >= 0, M z + q >= 0, complementary; M n x n, column by column.  solver: "auto",
 * "lemke", "lemke-sparse" or "newton"; max_pivots 0: the solver's own limit. */
int rb_api_lcp(rb_api *a, int n, const double *M, const double *q, const char *solver,
               int max_pivots);
/* The same of a sparse M in compressed columns: p[j] ... p[j+1] - 1 are the entries of column j, i
 * their rows, which increase, x their values.  lower <= z <= upper, n each (rollbem/lcp.h); start:
 * the z of a similar problem; NULL: 0 and infinity, none.  seconds: time limit, 0: none. */
int rb_api_lcp_sparse(rb_api *a, int n, const int *p, const int *i, const double *x,
                      const double *q, const double *lower, const double *upper,
                      const double *start, const char *solver, int max_pivots, double seconds);
/* All solutions, of order 22 at most (rb_lcp_enumerate); M n x n, column by column. RB_NO_SOLUTION:
 * it is proved that there is none; RB_UNDECIDED. */
int rb_api_lcp_all(rb_api *a, int n, const double *M, const double *q, const double *lower,
                   const double *upper, double seconds);
/* An equilibrium of a game: payoffs A of the row player and B of the column player, m x n, column
 * by column; label: the strategy dropped first, 0 ... m + n - 1, rows first; -1: any.  all 1: all
 * extreme equilibria, for m + n up to 22.  seconds: time limit, 0: none. */
int rb_api_game(rb_api *a, int m, int n, const double *A, const double *B, int label, int all,
                int max_pivots, double seconds);
/* yes 1: the calls of this handle above and below also prove what they find (docs/proof.md), as
 * arrays "lcp.proof", "game.proof" (proved, undecided pairs, isolated, bound, stored_within,
 * nearby, margin, norm, least_sum of rb_lcp_proof), with "lcp.proof.z" and "lcp.proof.error" of
 * what is proved, "friction.proof" (proved, touching, isolated, bound, stored_within, nearby,
 * margin, norm, condensed, and contacts separated, in stick, in slip, without friction), and of all
 * solutions "lcp.number", "game.number" (at least, at most or NAN, bases left open).  The word
 * "task.proof.reason" says why nothing is proved. */
int rb_api_prove_problems(rb_api *a, int yes);
/* Chooses the residual that decides whether a problem is solved: "scaled" (default), or
 * "acary", (13) of Acary, which depends on units.  rb_api_note tells if a problem is
 * solved in the scaled measure only. */
int rb_api_friction_measure(rb_api *a, const char *measure);
/* Solves u = W r + q with Coulomb's law, `dimension` (2 or 3) rows per contact, the normal one
 * first; W column by column, one mu per contact.  solver: a name of `rollbem friction`. The
 * function has nine plain parameters so that other languages need no struct. */
int rb_api_friction(rb_api *a, int dimension, int contacts, const double *W, const double *q,
                    const double *mu, const char *solver, double tol, int max_iters);
/* The same with W in compressed columns, as of rb_api_lcp_sparse. */
int rb_api_friction_sparse(rb_api *a, int dimension, int contacts, const int *p, const int *i,
                           const double *x, const double *q, const double *mu, const char *solver,
                           double tol, int max_iters);
/* The same for the problem of a file, FCLib or Siconos. */
int rb_api_friction_file(rb_api *a, const char *path, const char *solver, double tol,
                         int max_iters);
/* A sweep: solves n cases with `workers` processes (0: one per processor); the call
 * resolves each case.  If a case is refused, the call ends before anything is solved.  derivatives
 * of each case and uncertain inputs as of rb_api_curve, at most 128 arrays; NULL: none.  For a
 * growing input where the two sides differ, NAN: none. */
int rb_api_sweep(rb_api *a, int n, rb_api *const *cases, const char *derivatives,
                 const char *tolerance, int workers);
/* The same with a crack below each contact: handles for "crack", and the same m options
 * of `rollbem crack` for each, whose texts are values[j + k m] in case k. */
int rb_api_sweep_cracks(rb_api *a, int n, rb_api *const *cases, int m, const char *const *names,
                        const char *const *values, int workers);

RB_PUBLIC_END

#endif
