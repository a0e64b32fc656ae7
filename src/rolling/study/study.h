/* Curves, error bars, several solutions of one case, studies of many. */
#ifndef ROLLBEM_ROLLING_STUDY_STUDY_H
#define ROLLBEM_ROLLING_STUDY_STUDY_H

#include "base/units.h"
#include "rolling/history/history.h"
#include "rolling/history/wear.h"
#include "rolling/notes/notes.h"

/* ---- Several solutions (theory-rolling.md F5) ----------------------------------- */

/* Several solutions of one steady case, ordered by decreasing force. */
typedef struct {
    int n;
    rb_rolling_solution *solution; /* the residual of each is computed; owned */
    int starts, failed; /* starts of the iteration that were tried, and those that did not
                           converge */
} rb_rolling_solutions;

/* Finds different solutions of a steady model with a given creepage under a friction law
 * that depends on the state: the model's solution, and those to which the iteration
 * converges on the model's mesh when slip is assumed behind a given place; up to 200
 * places are tried (theory-rolling.md F5).  Solutions to which it does not converge are not
 * found.  The model then holds the last state.  RB_EINVAL: other cases. all: overwritten;
 * free it in any case. */
rb_status rb_rolling_find_solutions(rb_rolling_model *model, rb_rolling_solutions *all,
                                    rb_message *why);
void rb_rolling_solutions_free(rb_rolling_solutions *all);

/* ---- Creep curves --------------------------------------------------------------- */

/* The variable of a curve. */
typedef enum {
    RB_OVER_CREEP_RATIO,
    RB_OVER_CREEP,
    RB_OVER_SPEED /* viscoelastic bodies only */
} rb_rolling_variable;

typedef struct {
    rb_rolling_variable over;
    double from, to;
    int points;
    rb_units units; /* of what notes say; from and to are in mm */
} rb_rolling_range;

/* One entry per creepage or speed; owned. */
typedef struct rb_rolling_curve {
    int n;
    double *creepage, *creep_ratio, *force_ratio;
    double *tangential_load, *normal_load;
    double *stick_ratio; /* stuck length / length in contact */
    double *yield_ratio; /* the same of the interface that yields; NULL if it cannot */
    double stick_step;   /* largest change of these ratios by one element */
    double *dissipation; /* power per unit speed */
    double *residual;
    double *speed; /* [length/s]; 0 if no speed is given, because no body is viscoelastic */
    double *resistance_moment, *resistance_ratio, *hysteresis; /* as in rb_rolling_solution */
    double *torque_a, *torque_b;                  /* likewise; torque_b: NULL if B is a plane */
    double *max_temperature;                      /* NULL if the case has no heat conduction */
    double *ellipse_force, *ellipse_force_kalker; /* as in rb_rolling_solution; NULL: none */
    int *branch;   /* 1: computed in the direction from `from` to `to`, 2: in the opposite
                      direction; NULL if friction does not depend on the state */
    double *kappa; /* as in rb_rolling_solution; NULL likewise */
    int rising;    /* number of points of branch 1, which come first */
    int unsolved;  /* points without a solution: NAN but for what is varied and, if the search for
                      one began, kappa of its end */
    double free_creepage, half_width, seconds;
    int iterations;
    rb_rolling_solution last; /* solution at the last point, for notes, but with the largest kappa
                                 and the smallest dissipation of all points; n = 0: none */
    rb_rolling_study_notes notes;        /* on the points */
    struct rb_rolling_curve *deviations; /* standard deviation of every entry that has
                                            derivatives (rb_case_curve_solve); NULL: not
                                            computed; owned */
    rb_units units;                      /* of all values here */
} rb_rolling_curve;

void rb_rolling_curve_free(rb_rolling_curve *curve);
/* From mm, N, MPa to other units; call it once only. */
void rb_rolling_curve_convert(rb_rolling_curve *c, rb_units units);

/* Steady rolling at `points` equally spaced creepages or creepage ratios from `from` to
 * `to`, under the load or approach of rc; its given creepage or force is ignored.  All
 * points use one mesh, one factorisation and warm starts; a fitted mesh is fitted again
 * if an edge has moved by more than 1 %.  With RB_OVER_SPEED the points are equally
 * spaced in the logarithm of the speed, creepage or force is that of rc, and every speed
 * has its own mesh and flexibility.  If the friction law depends on the state, the curve
 * is followed to the last creepage and back to the first, each point from the one before:
 * 2 * points entries. */
rb_status rb_rolling_curve_solve(const rb_rolling_case *rc, const rb_rolling_range *range,
                                 rb_rolling_curve *curve, rb_message *why);

/* Sees the model at point k; its refusal ends the curve. */
typedef rb_status rb_rolling_point(const rb_rolling_model *model, int k, void *context,
                                   rb_message *why);
/* As rb_rolling_curve_solve, watched. */
rb_status rb_rolling_curve_observe(const rb_rolling_case *rc, const rb_rolling_range *range,
                                   rb_rolling_point *point, void *context, rb_rolling_curve *curve,
                                   rb_message *why);

/* ---- Error bars (theory-solvers.md 5.1) ----------------------------------------- */

/* Solves a case and estimates errors from the spread over n/2, 0.7 n and n contact
 * elements, and from the change when wheels have half as many elements outside the
 * contact.  On a positive status the solution holds the last iterate; free it in any
 * case. */
rb_status rb_rolling_solve_with_errors(const rb_rolling_case *rc, rb_rolling_solution *solution,
                                       rb_rolling_errors *errors, rb_message *why);

/* Refines contact and boundary until the estimates of P, Q, p0, half-width and creepage
 * are at most `accuracy` relative.  *elements: number of contact elements used at the
 * end; 0: nothing was solved.  With the best estimate: RB_INACCURATE if 6400 contact elements
 * or 64 times the default boundary elements do not suffice, RB_ENOMEM if the memory does not. */
rb_status rb_rolling_solve_to_accuracy(const rb_rolling_case *rc, double accuracy,
                                       rb_rolling_solution *solution, rb_rolling_errors *errors,
                                       int *elements, rb_message *why);
/* Says in a solution which mesh of the case an accuracy has ended with. */
void rb_rolling_set_accuracy(const rb_rolling_case *refined, rb_rolling_solution *solution);

/* Estimates the errors of a case that is already solved; solution: complete, in mm, N,
 * MPa.  stress, stress_b: its maxima in all of A and of B if error bars for them are wanted,
 * otherwise NULL.  Free the errors in any case. */
rb_status rb_rolling_estimate_errors(const rb_rolling_case *rc, const rb_rolling_solution *solution,
                                     const rb_rolling_stress_maxima *stress,
                                     const rb_rolling_stress_maxima *stress_b,
                                     rb_rolling_errors *errors, rb_message *why);

/* The number of coarser runs whose differences are the error bars: 2, with wheels 3. */
int rb_rolling_error_runs(const rb_rolling_case *rc);

/* Computes a curve and its errors: errors->force_ratio[k] and the other columns belong to
 * the k-th creepage; errors->residual has no meaning.  This takes twice as long as the
 * curve alone.  point (may be NULL) also sees the points of the coarser curves.  Free
 * both in any case. */
rb_status rb_rolling_curve_with_errors(const rb_rolling_case *rc, const rb_rolling_range *range,
                                       rb_rolling_point *point, void *context,
                                       rb_rolling_curve *curve, rb_rolling_curve *errors,
                                       rb_message *why);

/* Computes a history with history->errors (their residual has no meaning), from n/2, 0.7 n and
 * 0.85 n elements.  The coarser runs also have longer steps, so that the errors include those of
 * the step length.
 * After the main run the observer is called for the coarser runs with model and history
 * NULL.  Free model and history in any case. */
rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         const rb_rolling_observer *observer,
                                         rb_rolling_model *model, rb_rolling_history *history,
                                         rb_message *why);

/* The error bars of what fretting has done in the last cycle, NAN of all else.  0: there are none.
 */
int rb_rolling_errors_of_cycle(const rb_rolling_history *history, rb_rolling_errors *errors);

/* Of its bonds. */
void rb_rolling_errors_free(rb_rolling_errors *errors);

/* As rb_rolling_wear_run, with error bars in history->errors: from n/2, 0.7 n, 0.85 n and n
 * elements, the boundary outside, half as many steps, and half as many increments of fretting. That
 * of a pressure with a stick edge is NAN.  The observer sees the run itself. */
rb_status rb_rolling_wear_with_errors(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                                      const rb_rolling_wear_observer *observer,
                                      rb_rolling_wear_history *history, rb_rolling_solution *last,
                                      rb_message *why);

/* ---- Parameter studies ---------------------------------------------------------- */

enum { RB_ROW_OWN = 128, RB_ROW_BONDS = 128 };

/* A number of a bond, by rb_rolling_maximum_number. */
typedef struct {
    int k, part, of_b;
} rb_rolling_bond_number;

/* The results of one case of a study: numbers only, no columns; NAN if a case has no such
 * result. */
typedef struct {
    rb_rolling_solution solution;              /* with the status of the case */
    rb_rolling_errors errors;                  /* NAN without RB_ROW_ERRORS */
    rb_rolling_stress_maxima stress, stress_b; /* without bonds; NAN without RB_ROW_STRESS, ..._B */
    double bond[RB_ROW_BONDS], bond_error[RB_ROW_BONDS]; /* what the sweep names; otherwise NAN */
    double own[RB_ROW_OWN];     /* values computed by `measure` of the sweep; otherwise NAN */
    rb_rolling_row_notes notes; /* in the units of the sweep */
} rb_rolling_row;

/* A row without columns, of numbers that are not there (NAN). */
rb_rolling_row rb_rolling_no_row(rb_status status);

/* bits of rb_rolling_sweep.also */
enum { RB_ROW_ERRORS = 1, RB_ROW_STRESS = 2, RB_ROW_STRESS_B = 4 };

/* From mm, N, MPa to other units. */
void rb_rolling_row_convert(rb_rolling_row *row, rb_units units);

/* A study of the cases first ... first + count - 1, solved by processes of this machine
 * (0: as many as it has processors), one thread each.  `make` makes case k and `measure`
 * computes row->own; both run in these processes.  `see` and `tick` run in the calling
 * process: `see` receives the rows in order, `tick` is called every few milliseconds with
 * the number of rows passed to `see`; a return value other than 0 ends the study.  A
 * process that crashes is replaced and its case is tried once more; if it crashes again,
 * the case gets RB_ENOMEM. */
typedef struct {
    int first, count, workers;
    unsigned also; /* what to compute besides the solution: bits RB_ROW_... */
    int bonds;     /* numbers of bonds, which need RB_ROW_STRESS or ..._B */
    const rb_rolling_bond_number *bond;
    rb_units units; /* of what notes say */
    rb_status (*make)(int k, rb_rolling_case *rc, void *context);
    /* The history of the case that `make` made last, or NULL: the row has the results behind its
     * last row, and of errors those of the cycle; `measure` is not called.  NULL: no case has one.
     */
    const rb_rolling_program *(*program)(void *context);
    /* own: row->own of the case that `make` made last; model: its solved model; may be
     * NULL */
    rb_status (*measure)(const rb_rolling_model *model, double *own, void *context,
                         rb_message *why);
    /* NULL, or in the place of all that: solves case k, of which row has no numbers yet,
     * and returns its status */
    rb_status (*solve)(int k, rb_rolling_row *row, void *context, rb_message *why);
    int (*see)(int k, const rb_rolling_row *row, void *context);
    int (*tick)(int finished, void *context); /* or NULL */
    void *context;
} rb_rolling_sweep;

/* Solves case k in the calling process in the same way as a process of the study does.
 * why: the reason if the case is not solved, see row->solution.status. */
void rb_rolling_sweep_case(const rb_rolling_sweep *sweep, int k, rb_rolling_row *row,
                           rb_message *why);
/* Runs the study.  RB_INTERRUPTED: `see` or `tick` ended it.  In any case no process is
 * left running. */
rb_status rb_rolling_sweep_run(const rb_rolling_sweep *sweep, rb_message *why);

/* A pool of worker processes, as seen by the process that distributes the cases. */
typedef struct rb_rolling_pool {
    int (*idle)(
        struct rb_rolling_pool *pool); /* number of further cases that the pool accepts now */
    rb_status (*submit)(struct rb_rolling_pool *pool,
                        int k); /* submits case k; idle() must be > 0 */
    /* 1: case *k is done, and row is written; 0: no case was done within the given
     * milliseconds; a negative status: the pool has failed. */
    int (*collect)(struct rb_rolling_pool *pool, int milliseconds, int *k, rb_rolling_row *row);
    void (*stop)(struct rb_rolling_pool *pool); /* ends all processes at once and frees the pool */
} rb_rolling_pool;

/* Starts the pool of rb_rolling_sweep_run: sweep->workers processes, at most
 * sweep->count.  sweep is borrowed. */
rb_status rb_rolling_pool_start(const rb_rolling_sweep *sweep, rb_rolling_pool **pool,
                                rb_message *why);
/* The same as rb_rolling_sweep_run with a given pool; the pool is stopped in any case. */
rb_status rb_rolling_sweep_by(const rb_rolling_sweep *sweep, rb_rolling_pool *pool,
                              rb_message *why);

#endif
