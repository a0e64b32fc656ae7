/* Histories: static increments and transient rolling. */
#ifndef ROLLBEM_ROLLING_HISTORY_HISTORY_H
#define ROLLBEM_ROLLING_HISTORY_HISTORY_H

#include "rolling/case/inputs.h"

/* Prescribed quantities of a history, one row per time or distance.  A column replaces
 * the value of the case; with NULL the value of the case applies.  Without distance the
 * rows are increments of a static history.  With distance they are transient rolling:
 * rows at distance 0 are static increments; between the others load, approach and force
 * are linear, and each step has the mean creepage.  mu applies to the whole contact and
 * is linear between rows, too; in a friction law that depends on the state it replaces
 * the mu of the formula; it cannot be combined with a table over x.  Distances must not
 * decrease; their unit is Hertz's half-width of the largest load of the program (or of
 * the static load at its largest approach). Static contact of viscoelastic bodies needs
 * the time [s] of each row, which starts with 0 and must not decrease: between two rows
 * everything is linear in time; two rows at the same time are a jump. */
typedef struct {
    int n;
    const double *distance, *time;
    const double *mu;
    const double *load, *approach;                                   /* at most one */
    const double *shift, *creep, *creep_ratio, *force, *force_ratio; /* at most one */
    const double *bulk_stress, *bulk_stress_b, *tilt;
} rb_rolling_program; /* all borrowed */

void rb_rolling_history_free(rb_rolling_history *history);

typedef struct {
    rb_rolling_step *step; /* NULL: not called */
    void *context;
} rb_rolling_observer;

/* Computes the steps of the program (NULL: the values of the case; the bodies are pressed
 * at rest in its increments, then rolled over rc->distance).  A transient has rc->steps
 * steps of equal length, or, if that is 0, so many that no step is longer than an
 * element; the last step ends at the last row.  If the contact becomes wider than an
 * automatic zone, the run starts again with step 0 on a wider zone.  observer may be
 * NULL.  model and history are overwritten; they hold the finished steps also on
 * RB_INTERRUPTED and other positive statuses.  model->rc is the case of the last step.
 * Free both in any case. */
rb_status rb_rolling_history_run(const rb_rolling_case *rc, const rb_rolling_program *program,
                                 const rb_rolling_observer *observer, rb_rolling_model *model,
                                 rb_rolling_history *history, rb_message *why);

/* The columns of a program and their names in tables. */
typedef struct {
    const char *name;
    const char *also; /* other names that people give it, "normal load|P"; NULL: none */
    const char *unit; /* in mm, N, MPa (rollbem/units.h) */
    size_t column;    /* offset of its pointer in rb_rolling_program */
    size_t value;     /* offset in rb_rolling_case of the value that it replaces; distance and
                         time: SIZE_MAX */
    int is_mean;      /* 1: a rolled step uses the mean over the step, 0: the value at its end
                       */
} rb_rolling_program_column;

enum { RB_ROLLING_PROGRAM_COLUMNS = 13 };
extern const rb_rolling_program_column rb_rolling_program_columns[RB_ROLLING_PROGRAM_COLUMNS];

/* Columns of a program that are columns of its history, too. */
enum { RB_VARIES_MU = 1, RB_VARIES_BULK = 2, RB_VARIES_BULK_B = 4, RB_VARIES_TILT = 8 };
unsigned rb_rolling_program_varies(const rb_rolling_program *program);

/* The case that results of the program refer to; if the program has a column mu, its mu
 * is the largest value. */
rb_rolling_case rb_rolling_program_base(const rb_rolling_program *program,
                                        const rb_rolling_case *rc);

/* The same for one step that starts from the tractions, friction coefficients and plastic
 * slip of the solution `before` on the same elements, in mm, N, MPa (NULL: no contact
 * before): rolling by `step` [length] (RB_TRANSIENT), or a shift or load at rest
 * (RB_STATIC, step 0). The iteration of a friction law starts from the coefficients
 * `start` (rb_rolling_plan), or from those before (NULL).  RB_EINVAL: steady rolling,
 * other elements, viscoelastic bodies, or temperatures. */
rb_status rb_rolling_step_between(const rb_rolling_case *rc, double from, double to,
                                  const rb_rolling_solution *before, const rb_rolling_table *start,
                                  double step, rb_rolling_solution *solution, rb_message *why);

/* ---- The states of a history ---------------------------------------------------- */

/* The solutions of the steps of a history: n elements, `steps` states. */
typedef struct {
    const rb_rolling_program
        *program; /* the program of the history; NULL: the values of the case; borrowed */
    int n, steps;
    double *x, *h; /* n: midpoints and lengths [length]; owned, like all arrays here */
    double *p, *q, *lambda, *plastic; /* steps x n, one step after the other; plastic: the part of
                                         lambda that the interface yields */
    int *zone;
    int *substeps;     /* steps: in how many steps the row was computed */
    double *delta;     /* steps: approach */
    double *xi;        /* steps: rigid shift of a static step [length], creepage of a rolled step */
    double half_width; /* unit of the distances [length] */
    rb_rolling_rows rows; /* of its history */
} rb_rolling_states;

/* On RB_ENOMEM states is empty. */
rb_status rb_rolling_states_alloc(int n, int steps, rb_rolling_states *states);
/* Copies the state and the elements of the model after a step into states.  Step 0 begins with
 * new memory for all steps: a run that starts again may have other elements.  RB_ENOMEM. */
rb_status rb_rolling_states_keep(const rb_rolling_model *model, const rb_rolling_history *history,
                                 int step, int steps, rb_rolling_states *states);
/* Copies tractions, slip and its plastic part, zones, delta and xi of a step into a state of as
 * many elements; its status becomes RB_OK. */
void rb_rolling_states_get(const rb_rolling_states *states, int step, rb_contact_state *state);
void rb_rolling_states_free(rb_rolling_states *states);

/* ---- Following given states ----------------------------------------------------- */

/* Goes through the program of the given states without solving.  After each step the
 * model has the contact problem of the step, which depends on the earlier states, and the
 * given state with its residual; friction that depends on the state has the coefficients of
 * the given one.  Otherwise like rb_rolling_history_run.  RB_EINVAL: the number of steps
 * differs. */
rb_status rb_rolling_history_follow(const rb_rolling_case *rc, const rb_rolling_states *states,
                                    const rb_rolling_observer *observer, rb_rolling_model *model,
                                    rb_rolling_history *history, rb_message *why);

/* The same step by step, with states that the caller sets: opaque. */
typedef struct rb_rolling_follower rb_rolling_follower;

/* of: another follower, before its first step, whose bodies are borrowed where rc has the
 * same (NULL: none), and which lives longer; scale: of the elements of the states, which
 * are borrowed.  Free it in any case. */
rb_status rb_rolling_follower_create(const rb_rolling_case *rc, const rb_rolling_states *states,
                                     const rb_rolling_follower *of, double scale,
                                     rb_rolling_follower **follower, rb_message *why);
/* The model has the problem of the next step, with the past that the states before it
 * left. */
rb_status rb_rolling_follower_begin(rb_rolling_follower *follower, rb_message *why);
/* 1: the step that has begun is the last one of a row, whose state is among the given ones;
 * 0: it ends inside the row. */
int rb_rolling_follower_ends_row(const rb_rolling_follower *follower);
/* Whose state is to be set between begin and end; borrowed. */
rb_rolling_model *rb_rolling_follower_model(rb_rolling_follower *follower);
/* Solves the step, from the state that the model has, on the elements of the states. */
rb_status rb_rolling_follower_solve(rb_rolling_follower *follower, rb_message *why);
/* Takes the state that the model has, complete, as that of the step. */
void rb_rolling_follower_end(rb_rolling_follower *follower);
/* Of the steps so far; borrowed. */
const rb_rolling_history *rb_rolling_follower_history(const rb_rolling_follower *follower);
void rb_rolling_follower_free(rb_rolling_follower *follower);

#endif
