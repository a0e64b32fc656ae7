/* The handle of rollbem/api.h, and its arrays. */
#ifndef ROLLBEM_API_INTERNAL_H
#define ROLLBEM_API_INTERNAL_H

#include "rollbem/api.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"

/* An array that was asked for. */
typedef struct {
    char name[120];
    int rows, columns;
    int shown;  /* 1: in the units of the case; 0: in mm, N, MPa */
    double *at; /* owned */
} api_array;

/* What has derivatives in columns, by the beginning of their names. */
typedef enum { API_SLOPES_CURVE, API_SLOPES_HISTORY, API_SLOPES_SWEEP, API_SLOPES_N } api_slopes;

/* Texts that a call has made, for rb_api_word. */
typedef enum {
    API_FIT_SENTENCES,
    API_DESIGN_VARIABLES,
    API_DESIGN_CONSTRAINTS,
    API_SAID_N
} api_said;

/* An option, or a case file, that was refused and has not been set since. */
typedef struct {
    char name[80];
    rb_message why;
} api_refusal;

/* What is described, field by field. */
typedef struct {
    const char *field, *text; /* NULL: none, written as "" */
} api_field;

/* Entries of a table of results: of columns of the owner, or numbers of an array of structs. */
typedef struct {
    const char *beginning; /* of the names of the arrays */
    const rb_rolling_results *table;
    const void *owner; /* NULL: there is none */
    int rows, columns;
    size_t size; /* of each of the structs; 0: columns */
} api_entries;

enum { API_CRACK_OPTIONS = 40 }; /* more than the table has */
enum { API_REFUSALS = 16 };      /* of more the last ones are the same entry */

/* Options of `rollbem crack` by their names and texts, in the units of the resolved case
 * a. */
rb_status rb_api_set_crack(rb_api *a, int n, const char *const *names, const char *const *values,
                           rb_case_crack *crack, rb_message *why);

struct rb_api {
    rb_case *words;
    int is_curve; /* its purpose: a curve, over the creepage or the speed */
    rb_case_result result;
    rb_rolling_model kept; /* of the last case, where only what drives it has changed */
    rb_rolling_curve curve, curve_errors; /* curve_errors.n = 0: not asked for */
    rb_case_derivatives derivatives;      /* n = 0: not asked for */
    rb_case_slopes slopes[API_SLOPES_N];  /* n = 0: not asked for */
    rb_rolling_states states;             /* of all steps; n = 0: a case without */
    rb_rolling_solution deviation;        /* after rb_api_tolerances, has_deviation */
    int has_deviation;
    rb_rolling_wear_history wear; /* n = 0: not asked for */
    int stress_of_b;              /* 1: the stress is asked for in body B */
    rb_contact_lcp lcp;
    int pivots; /* seen so far */
    double *tableau;
    int *nonbasis; /* the last pivot's, both owned */
    int iterations;
    double residual, scaled_residual;
    int by_acary;                /* (13) decides whether friction problems are solved */
    int proves;                  /* 1: problems that are handed over are also proved: */
    const char *proof_reason;    /* why the last one was not; static text */
    rb_message note;             /* on the last problem that was handed over; empty: none */
    rb_rolling_study_notes rows; /* on the points or cases of the last curve or sweep; rows = 0: it
                                    was neither */
    const char *row;             /* "point" or "case"; static text */
    const char *solver;          /* of the last problem that was handed over; static text */
    _Atomic int stopped;         /* by another thread, or a signal handler */
    int interrupted;             /* 1: the running call has seen that */
    rb_interrupt outside;        /* what the thread of the running call asked before */
    _Atomic int done, total;     /* of the running call, for another thread */
    rb_status status;
    rb_message why;
    api_refusal refused[API_REFUSALS];
    int refusals;
    char *said[API_SAID_N]; /* NULL: not asked for; owned */
    api_array **made;       /* arrays; owned, as each of them */
    int arrays;
    rb_units study_units; /* of the cases of the last sweep */
};

void rb_api_forget_notes(rb_api *a);
/* NULL: there is none of this name. */
api_array *rb_api_find_array(rb_api *a, const char *name);
/* A new array of zeros.  NULL: no memory. */
api_array *rb_api_make_array(rb_api *a, const char *name, int rows, int columns);
/* NULL also where x is. */
api_array *rb_api_copy_array(rb_api *a, const char *name, int rows, int columns, const double *x);
void rb_api_forget_arrays(rb_api *a, const char *beginning);
/* Adds one column to an array that grows step by step. */
rb_status rb_api_add_column(rb_api *a, const char *name, int rows, const double *x);
/* Adds zones and tractions of a step to its arrays. */
rb_status rb_api_add_state(rb_api *a, const char *beginning, const rb_contact_state *state);
int rb_api_has_entries(const api_entries *of, const rb_rolling_result *r);
/* NULL: there are none, or no memory. */
api_array *rb_api_make_entries(rb_api *a, const api_entries *of, const rb_rolling_result *r);

/* ---- Numbers and text -------------------------------------------------------------- */

/* A number that is handed over, in mm, N, MPa; and one of these in the units of the case. */
double rb_api_stored(const rb_api *a, const char *unit, double x);
double rb_api_shown(const rb_api *a, const char *unit, double x);
/* what, "" where it is NULL, copied into text, which is returned. */
const char *rb_api_written(const char *what, char *text, int size);
/* NULL: there is no such field. */
const char *rb_api_field_of(size_t n, const api_field *of, const char *field, char *text, int size);

/* ---- Derivatives ------------------------------------------------------------------- */

extern const char *const rb_api_slopes_of[API_SLOPES_N];
/* "tangential_load:mu". */
const char *rb_api_slope_name(const rb_case_slope *of, char text[100]);
/* Forgets the derivatives of this kind, with their arrays. */
void rb_api_forget_slopes(rb_api *a, api_slopes of);

/* ---- Calls ------------------------------------------------------------------------- */

/* What the last call left: its message, how far it came, and whether it was stopped. */
void rb_api_forget_call(rb_api *a);
/* A refusal that no file or argument has answered for names its option as one: --crack-angle. */
void rb_api_name_option(rb_message *why);
/* Keeps the status of a call, with a line that says it where the call has left none. */
int rb_api_ended(rb_api *a, rb_status s);
/* Ends a call with RB_EINVAL and this line. */
int rb_api_refuse(rb_api *a, const char *format, ...) RB_PRINTF(2, 3);

/* RB_EINVAL: an option was refused and has not been set since. */
rb_status rb_api_check_refusals(const rb_api *a, rb_message *why);

/* Around what may take long: it uses one thread of BLAS, and ends where rb_api_stop says so. */
void rb_api_call_begins(rb_api *a);
/* s, or RB_INTERRUPTED where that has ended it. */
rb_status rb_api_call_ends(rb_api *a, rb_status s);

#endif
