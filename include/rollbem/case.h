/* A case whose options are set by name.  One table holds every option of a case (name,
 * section, unit, range, choices, default, help).  The command line, case files, JSON
 * `inputs`, --help, studies and callers of this library all use this table.
 *
 *     rb_case *c = rb_case_create(RB_CASE_SINGLE);
 *     rb_case_set(c, "support", "halfplane", RB_GIVEN_ARGUMENT, &why);
 *     rb_case_set_number(c, "load", 500.0, &why);
 *     if (rb_case_resolve(c, &why) == RB_OK)
 *         rb_case_solve(rb_case_resolved(c), NULL, NULL, &result, &why);
 *     rb_case_result_free(&result);
 *     rb_case_free(c);
 *
 * Nothing here prints.  An error is a status and a message of one line: RB_EINVAL if an
 * argument is wrong, RB_EFORMAT if the content of a file is wrong, RB_ENOENT if there is
 * no such file. */
#ifndef ROLLBEM_CASE_H
#define ROLLBEM_CASE_H

#include "rollbem/base.h"
#include "rollbem/rolling.h"

RB_PUBLIC_BEGIN

/* ---- Options --------------------------------------------------------------------- */

/* Source of a value: 0: the default; k > 0: line k of the case file; RB_GIVEN_ARGUMENT:
 * an argument, which has priority over the file; RB_GIVEN_NUMBER: rb_case_set_number. */
enum { RB_GIVEN_ARGUMENT = -1, RB_GIVEN_NUMBER = -2 };

/* ---- Cases ----------------------------------------------------------------------- */

typedef struct rb_case rb_case;

/* The purpose of a case.  Options that do not apply to a purpose are refused. */
typedef enum {
    RB_CASE_SINGLE,
    RB_CASE_CURVE,  /* a creep curve: steady by default, several mu */
    RB_CASE_SPEEDS, /* a curve over the speed: likewise */
    RB_CASE_STRESS, /* the stress below the surface */
    RB_CASE_WEAR,   /* the wear of sliding, fretting or rolling */
    RB_CASE_CRACK,  /* the load of a crack */
    RB_CASE_STUDY,  /* the base of a parameter study */
    RB_CASE_DESIGN  /* the case whose numbers a design varies */
} rb_case_purpose;

/* Creates a case with the default values; it is already resolved.  NULL: no memory. */
rb_case *rb_case_create(rb_case_purpose purpose);
void rb_case_free(rb_case *c);

/* Sets an option.  by: RB_GIVEN_ARGUMENT, or the line of the case file.  The text is
 * copied.  RB_EINVAL: there is no such option, or the value is out of range. */
rb_status rb_case_set(rb_case *c, const char *name, const char *text, int by, rb_message *why);
/* The same for options whose value is a number. */
rb_status rb_case_set_number(rb_case *c, const char *name, double value, rb_message *why);

/* Reads a case file.  Values that were set by an argument are kept.  RB_ENOENT, RB_EFORMAT,
 * RB_ENOMEM. */
rb_status rb_case_read(rb_case *c, const char *path, rb_message *why);

/* Resolves the given values: refuses contradictions, fills in body B and the mesh, reads the
 * files of gap and history, and checks the result.  Call it again after every change. */
rb_status rb_case_resolve(rb_case *c, rb_message *why);

/* The resolved values, in mm, N, MPa; opaque.  Borrowed, valid until c changes. */
typedef struct rb_resolved_case rb_resolved_case;
const rb_resolved_case *rb_case_resolved(const rb_case *c);
/* The case among them, for the steps of rollbem/rolling.h; borrowed likewise. */
const rb_rolling_case *rb_case_rolling(const rb_case *c);

/* ---- Solving ----------------------------------------------------------------------- */

typedef struct {
    rb_rolling_model model;       /* without a state if error bars were computed */
    rb_rolling_solution solution; /* n = 0: no solution */
    rb_rolling_history history;   /* n = 0: not a sequence of steps */
    int has_errors; /* 1: errors holds those of the solution; a history has errors of each
                       step */
    rb_rolling_errors errors;
    struct rb_rolling_study_notes *of_steps; /* notes on steps before the last; NULL: none; owned */
} rb_case_result;

/* Solves a case: steady and static cases at once, transients and histories step by step,
 * with error bars or to the accuracy given in the case.  step is called with the model
 * after each step; it may be NULL.  Free the result in any case. */
rb_status rb_case_solve(const rb_resolved_case *resolved, rb_rolling_step *step, void *context,
                        rb_case_result *result, rb_message *why);

void rb_case_result_free(rb_case_result *result);

RB_PUBLIC_END

#endif
