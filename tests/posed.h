/* The contact problem of a case on few equal elements. */
#ifndef ROLLBEM_TESTS_POSED_H
#define ROLLBEM_TESTS_POSED_H

#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

enum { N = 9, M = N + 1 };

typedef struct {
    rb_rolling_case rc;
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    rb_contact_problem p;
    rb_contact_matrix K;
} posed;

static inline rb_rolling_case posed_plane(rb_rolling_formulation formulation)
{
    rb_rolling_case rc =
        rolling_case("support halfplane poisson 0.3 contact-elements %d load 500", N);
    rc.formulation = formulation;
    return rc;
}

static inline posed pose(const rb_rolling_case *rc, const rb_rolling_past *past)
{
    posed d = {.rc = *rc};
    CHECK_OK(rb_rolling_mesh_uniform(rc, NULL, -1.0, 0.8, &d.mesh, &message));
    CHECK_OK(rb_rolling_bodies_create(rc, NULL, &d.mesh, &d.bodies, &message));
    CHECK_OK(rb_rolling_problem_create(rc, &d.mesh, &d.bodies, past, &d.p, &message));
    d.K = rb_contact_operator_matrix(d.p.op);
    return d;
}

static inline void release(posed *d)
{
    rb_contact_problem_free(&d->p);
    rb_rolling_bodies_free(&d->bodies);
    rb_rolling_mesh_free(&d->mesh);
}

#endif
