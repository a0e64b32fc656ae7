/* The results by name: tables from which reports, studies and error bars are made. */
#ifndef ROLLBEM_ROLLING_RESULTS_RESULTS_H
#define ROLLBEM_ROLLING_RESULTS_RESULTS_H

#include "base/units.h"
#include "rolling/case/inputs.h"

typedef enum {
    RB_RESULT_NUMBER,
    RB_RESULT_WHOLE,  /* int */
    RB_RESULT_SECONDS /* a number: time spent on it */
} rb_rolling_result_kind;

/* The scale of a result with an error bar; its rounding error is proportional to this
 * scale. */
typedef enum {
    RB_SCALE_NONE,
    RB_SCALE_ONE,
    RB_SCALE_LOAD,     /* P */
    RB_SCALE_FRICTION, /* mu P */
    RB_SCALE_APPROACH,
    RB_SCALE_SHIFT,    /* mu a^2/R */
    RB_SCALE_CREEPAGE, /* mu a/R */
    RB_SCALE_WIDTH,    /* a */
    RB_SCALE_ELEMENT,  /* length of an element */
    RB_SCALE_PRESSURE, /* p0 */
    RB_SCALE_POWER,    /* mu P times the creepage */
    RB_SCALE_MOMENT,   /* P a */
    RB_SCALE_TORQUE,   /* P a and mu P R */
    RB_SCALE_STRAIN,   /* a/R */
    RB_SCALE_WORK,     /* P a/R */
    RB_SCALE_HEAT      /* rise of the temperature */
} rb_rolling_error_scale;

/* Which cases have a result.  For all other cases a number is NAN, a column is NULL, and
 * reports omit both. */
typedef enum {
    RB_FOR_ALL,
    RB_FOR_ACCURACY, /* solved to an accuracy, which the case does not know */
    RB_FOR_HEAT,
    RB_FOR_HEAT_INSIDE, /* heat of steady rolling */
    RB_FOR_WORN,
    RB_FOR_LAW,        /* friction coefficients that differ between elements */
    RB_FOR_MOVING_LAW, /* friction coefficients that depend on the state */
    RB_FOR_WAY,        /* friction coefficient from a column of a history */
    RB_FOR_BULK_WAY,   /* likewise bulk stress, that of B and tilt */
    RB_FOR_BULK_B_WAY,
    RB_FOR_TILT_WAY,
    RB_FOR_PERIOD,
    RB_FOR_MEMORY,
    RB_FOR_YIELD,
    RB_FOR_CYLINDER_B,
    RB_FOR_TILT,
    RB_FOR_ELLIPSE,
    RB_FOR_ELLIPSE_FORCE,
    RB_FOR_SMOOTH_BASE,
    RB_FOR_FRETTING,
    RB_FOR_FRETTING_B /* likewise of an elastic B */
} rb_rolling_condition;

/* Description of one result.  Tables, JSON, studies and error bars are made from these
 * rows. */
typedef struct {
    const char *name; /* in JSON */
    const char *unit; /* "mm"; NULL: none */
    rb_rolling_result_kind kind;
    size_t offset; /* of the value, or of the pointer to the column, in its struct */
    rb_rolling_error_scale error_bar; /* RB_SCALE_NONE: no discretisation error is estimated
                                       */
    int study;                        /* number of its column in a study; 0: none */
    int is_mean;       /* in a rolled step: 1: mean over the step, 0: value at its end */
    int no_derivative; /* 1: has no derivative: a residual, or a place known only to
                          within one element */
    rb_rolling_condition condition;
    const char *symbol; /* heads the column instead of the name; NULL: the name */
    const char *meaning;
} rb_rolling_result;

typedef struct {
    int n;
    const rb_rolling_result *row;
} rb_rolling_results;

/* The numbers of rb_rolling_solution, and its columns with one entry per element. */
extern const rb_rolling_results rb_rolling_solution_scalars, rb_rolling_solution_columns;
/* The numbers of rb_rolling_patch. */
extern const rb_rolling_results rb_rolling_patch_scalars;
/* The columns of rb_rolling_history, one entry per step, and of rb_rolling_curve, one
 * entry per creepage. */
extern const rb_rolling_results rb_rolling_history_columns, rb_rolling_curve_columns;
/* The columns of rb_rolling_wear_history, one entry per step. */
extern const rb_rolling_results rb_rolling_wear_columns;
/* The numbers of rb_rolling_stress, and of rb_rolling_stress_maxima: three rows for each
 * maximum, its value and its place; of rb_rolling_bond_maxima, with the names of bond 1. */
extern const rb_rolling_results rb_rolling_stress_scalars, rb_rolling_maxima_scalars,
    rb_rolling_maxima_b_scalars, rb_rolling_bond_scalars, rb_rolling_bond_b_scalars;

/* All these tables; an entry without a name ends the list. */
typedef struct {
    const char *name, *title;
    const rb_rolling_results *results;
} rb_rolling_result_table;
extern const rb_rolling_result_table rb_rolling_result_tables[];

/* The row with this name; NULL: there is none. */
const rb_rolling_result *rb_rolling_find_result(const rb_rolling_results *table, const char *name);
/* 1 if the case has this result.  varies: in a history with such columns. */
int rb_rolling_has_result(const rb_rolling_result *r, const rb_rolling_case *rc, unsigned varies);
/* 1 if the struct `owner` has this column. */
int rb_rolling_has_column(const rb_rolling_result *r, const void *owner);
/* The numbers of a solution without its columns, which remain with it. */
rb_rolling_solution rb_rolling_scalars_of(const rb_rolling_solution *solution);
/* The number, or entry i of the column, as a double; owner: the struct that the table
 * describes. */
double rb_rolling_number(const rb_rolling_result *r, const void *owner);
double rb_rolling_entry(const rb_rolling_result *r, const void *owner, int i);
/* The column itself, of numbers; NULL: the owner has none. */
double *rb_rolling_column(const rb_rolling_result *r, const void *owner);
void rb_rolling_set_number(const rb_rolling_result *r, void *owner, double value);
/* From mm, N, MPa to other units: the numbers, or the columns of so many rows, that have one. */
void rb_rolling_numbers_convert(const rb_rolling_results *table, void *owner, rb_units units);
void rb_rolling_columns_convert(const rb_rolling_results *table, int rows, void *owner,
                                rb_units units);

/* Writes the name with its unit, as in the heads of columns: "max_pressure_MPa".  Returns
 * heading. */
enum { RB_ROLLING_HEADING = 40 };
const char *rb_rolling_heading(const rb_rolling_result *r, rb_units units,
                               char heading[RB_ROLLING_HEADING]);

/* Column k = 1, 2, ... of a study; NULL after the last one. */
const rb_rolling_result *rb_rolling_study_column(int k);

/* ---- Units ---------------------------------------------------------------------- */

/* Convert from mm, N, MPa to other units; call them once only.  The field `units` tells
 * the present units. */
void rb_rolling_solution_convert(rb_rolling_solution *s, rb_units units);
void rb_rolling_history_convert(rb_rolling_history *h, rb_units units);

#endif
