/* Friction problems in the local sparse form. */
#ifndef ROLLBEM_TESTS_SPARSE_FRICTION_H
#define ROLLBEM_TESTS_SPARSE_FRICTION_H

#include "check.h"
#include "rollbem/friction.h"

/* The same problem with W sparse; the dense W stays beside it. */
static inline void make_sparse(rb_friction_problem *p)
{
    const int m = p->dimension * p->contacts;
    CHECK_OK(rb_sparse_from_dense(m, m, p->W, m, &p->Ws));
    p->form = RB_FRICTION_LOCAL_SPARSE;
}

#endif
