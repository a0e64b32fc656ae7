/* Friction problems that the generator of examples/packings prints. */
#ifndef ROLLBEM_TESTS_PACKING_H
#define ROLLBEM_TESTS_PACKING_H

#include "check.h"
#include "lcp/friction/friction.h"

#include <unistd.h>

/* The problem that `packings ARGUMENTS` prints; W, if there is one, sparse. */
static inline void packing(const char *arguments, rb_friction_problem *p)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char name[] = "/tmp/rollbem-packing-XXXXXX", command[400];
    const int file = mkstemp(name);
    assert_true(file >= 0);
    close(file);
    snprintf(command, sizeof command, "%s/packings %s > %s", build, arguments, name);
    assert_int_equal(system(command), 0);
    const rb_status s = rb_friction_read(name, p, &message);
    unlink(name);
    if (s != RB_OK)
        print_error("%s\n", message.text);
    CHECK_OK(s);
    const int m = p->dimension * p->contacts;
    if (p->form == RB_FRICTION_GLOBAL)
        return;
    if (p->form == RB_FRICTION_LOCAL_DENSE)
        CHECK_OK(rb_sparse_from_dense(m, m, p->W, m, &p->Ws));
    p->form = RB_FRICTION_LOCAL_SPARSE;
}

#endif
