/* The handle of rollbem/api.h, and its arrays. */
#ifndef CASE_API_H
#define CASE_API_H

#include "rollbem/api.h"
#include "rollbem/case.h"

/* An array that was asked for. */
typedef struct {
    char name[40];
    int rows, columns;
    double *at; /* owned */
} case_array;

enum { CASE_ARRAYS = 160 };

struct rb_api {
    rb_case *words;
    rb_case_result result;
    rb_rolling_model kept; /* of the last case, where only what drives it has changed */
    rb_rolling_curve curve, curve_errors; /* curve_errors.n = 0: not asked for */
    rb_rolling_lcp lcp;
    int pivots; /* seen so far */
    double *tableau;
    int *nonbasis; /* the last pivot's, both owned */
    int iterations;
    double residual, scaled_residual;
    const char *solver;  /* of the last problem that was handed over; static text */
    _Atomic int stopped; /* by another thread, or a signal handler */
    rb_status status;
    rb_message why;
    case_array made[CASE_ARRAYS];
    int arrays;
};

/* NULL: nobody has made one of that name. */
case_array *rb_case_find_array(rb_api *a, const char *name);
/* A new array of zeros.  NULL: no memory. */
case_array *rb_case_make_array(rb_api *a, const char *name, int rows, int columns);
/* NULL also where x is. */
case_array *rb_case_copy_array(rb_api *a, const char *name, int rows, int columns,
                               const double *x);
void rb_case_forget_arrays(rb_api *a, const char *beginning);
/* Keeps the status of a call, with a line that says it where the call has left none. */
int rb_case_ended(rb_api *a, rb_status s);

/* Around what may use BLAS. */
void rb_case_call_begins(void);
void rb_case_call_ends(void);

#endif
