/* `rollbem check`: verifies results of which nothing but their file is known, without solving. */
#ifndef ROLLBEM_CERTIFICATE_H
#define ROLLBEM_CERTIFICATE_H

#include "rolling/case/case.h"

#include <stdio.h>

struct json_t; /* jansson's */

/* The outcome of the check of a result. */
typedef struct {
    int violations, numbers; /* numbers: how many were compared with recomputed values */
    double residual;         /* of the printed state */
    int bars;                /* 1: it states error bars, which are not checked */
    int prove;               /* set by the caller: 1: also prove the solution */
    rb_contact_proof proof;  /* of the last state that was proved; steps: of a history */
} rb_certificate_outcome;

/* Checks the JSON of a case, of a history with its states, of the stress below a case, of all its
 * solutions, or of a crack with its states.  It builds the problem again from the inputs in the
 * JSON (words: a case with default values, for a crack of RB_CASE_CRACK, which receives them) and
 * from the states that are stored, writes the JSON again and compares.  Each violation is written
 * to out in one line.  RB_EFORMAT: this kind of result cannot be checked; RB_ENOMEM. */
rb_status rb_certificate_check(FILE *out, const char *name, const struct json_t *root,
                               rb_case *words, rb_certificate_outcome *found, rb_message *why);
/* The same for a table of rb_report_table.  words: the resolved inputs of the command
 * line in the comments of the table (rb_report_table_command). */
rb_status rb_certificate_check_table(FILE *out, const char *name, const char *text,
                                     const rb_case *words, rb_certificate_outcome *found,
                                     rb_message *why);

#endif
