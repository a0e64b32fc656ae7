/* Comparison of the program with reference values (theory-solvers.md 6): closed forms and
 * published results. */
#ifndef ROLLBEM_VERIFY_H
#define ROLLBEM_VERIFY_H

#include "base/base.h"

/* One reference value and the value that the program computes. */
typedef struct {
    char what[80];
    double wanted, got;
    double error, bound; /* |got - wanted|, divided by |wanted| if relative */
    int relative;
    int holds;
    const char *why; /* reason why the solution failed; NULL if it did not */
} rb_verify_check;

typedef void rb_verify_each_check(const rb_verify_check *check, void *context);

/* Computes all references and calls `each` once per value.  Returns the number of checks
 * that do not hold. */
int rb_verify_run(rb_verify_each_check *each, void *context);

#endif
