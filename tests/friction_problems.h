/* Friction problems to be filled in, and the local sparse form of dense ones. */
#ifndef ROLLBEM_TESTS_FRICTION_PROBLEMS_H
#define ROLLBEM_TESTS_FRICTION_PROBLEMS_H

#include "check.h"
#include "lcp/friction/friction.h"

#include <stdlib.h>

/* The arrays are the caller's. */
static inline rb_friction_problem local_with(int d, int contacts, double *mu, double *W, double *q)
{
    return (rb_friction_problem){.form = RB_FRICTION_LOCAL_DENSE,
                                 .dimension = d,
                                 .contacts = contacts,
                                 .mu = mu,
                                 .W = W,
                                 .q = q};
}

/* All numbers are 0; to be freed by the caller, as the next. */
static inline rb_friction_problem zero_local(int d, int contacts)
{
    const size_t m = (size_t)(d * contacts);
    return local_with(d, contacts, rb_alloc((size_t)contacts, 1), rb_alloc(m, m), rb_alloc(m, 1));
}

/* Without K and H. */
static inline rb_friction_problem zero_global(int d, int contacts, int dofs)
{
    return (rb_friction_problem){.form = RB_FRICTION_GLOBAL,
                                 .dimension = d,
                                 .contacts = contacts,
                                 .dofs = dofs,
                                 .mu = rb_alloc((size_t)contacts, 1),
                                 .f = rb_alloc((size_t)dofs, 1),
                                 .w = rb_alloc((size_t)(d * contacts), 1)};
}

/* The same problem with W sparse; the dense W stays beside it. */
static inline void make_sparse(rb_friction_problem *p)
{
    const int m = p->dimension * p->contacts;
    CHECK_OK(rb_sparse_from_dense(m, m, p->W, m, &p->Ws));
    p->form = RB_FRICTION_LOCAL_SPARSE;
}

/* The same, and the dense W is freed. */
static inline void make_only_sparse(rb_friction_problem *p)
{
    make_sparse(p);
    free(p->W);
    p->W = NULL;
}

#endif
