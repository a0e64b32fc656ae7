/* The references that the program holds itself against (theory.md 6): closed forms,
 * published values. */
#ifndef ROLLBEM_VERIFY_H
#define ROLLBEM_VERIFY_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

/* One reference value against the program's. */
typedef struct {
    char what[80];
    double wanted, got;
    double error, bound; /* |got - wanted|, over |wanted| where relative */
    int relative;
    int holds;
    const char *why; /* of a solution that failed; NULL otherwise */
} rb_verify_check;

typedef void rb_verify_each_check(const rb_verify_check *check, void *context);

/* Every reference, one call of each per value.  The number of those that do not hold. */
int rb_verify_run(rb_verify_each_check *each, void *context);

RB_PUBLIC_END

#endif
