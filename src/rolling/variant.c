/* The same contact on the same elements under a case that differs a little: what
 * derivatives of a solution are made from (theory.md, D1). */
#include "rolling/internal.h"

#include <stdlib.h>
#include <string.h>

/* The elements of `of` with the gap of rc.  Equal ones on a wheel are arcs of its circle
 * between ends that stay. */
static rb_status copy_mesh(const rb_rolling_case *rc, const rb_rolling_mesh *of,
                           int same_bodies, rb_rolling_mesh *mesh, rb_message *why)
{
    if (!same_bodies && rc->mesh == RB_MESH_UNIFORM &&
        !rb_rolling_body_can(&rc->a, RB_BODY_FLAT))
        return rb_rolling_mesh_uniform(rc, of->ends[0], of->ends[of->n], mesh, why);
    mesh->n = of->n;
    mesh->ends = rb_alloc((size_t)of->n + 2, 1);
    mesh->gap = rb_alloc((size_t)of->n, 1);
    if (!mesh->ends || !mesh->gap)
        return RB_ENOMEM;
    memcpy(mesh->ends, of->ends, ((size_t)of->n + 2) * sizeof *mesh->ends);
    return rb_rolling_mesh_set_gap(rc, mesh);
}

static int have_same_boundary(const rb_bem_system *x, const rb_bem_system *y)
{
    return !x || rb_bem_system_mesh(x)->n == rb_bem_system_mesh(y)->n;
}

rb_status rb_rolling_variant_create(const rb_rolling_model *of, const rb_rolling_case *rc,
                                    int same_bodies, rb_rolling_model *v, rb_message *why)
{
    memset(v, 0, sizeof *v);
    v->rc = *rc;
    v->equal_instead = of->equal_instead;
    rb_status s = copy_mesh(rc, &of->mesh, same_bodies, &v->mesh, why);
    if (s == RB_OK && same_bodies)
        v->bodies = of->bodies;
    else if (s == RB_OK)
        s = rb_rolling_bodies_create(rc, &v->mesh, &v->bodies, why);
    if (s == RB_OK && !(have_same_boundary(of->bodies.system_a, v->bodies.system_a) &&
                        have_same_boundary(of->bodies.system_b, v->bodies.system_b)))
        s = rb_fail(why, RB_INACCURATE,
                    "the elements outside the contact change with the input; give "
                    "--outer-elements");
    if (s == RB_OK)
        s = rb_rolling_problem_create(rc, &v->mesh, &v->bodies, NULL, &v->problem, why);
    if (s == RB_OK)
        s = rb_contact_state_alloc(of->mesh.n, &v->state);
    if (s == RB_OK)
        rb_rolling_variant_set(of, NULL, 0.0, v);
    return s == RB_OK ? rb_rolling_variant_complete(v, why) : s;
}

void rb_rolling_variant_free(const rb_rolling_model *of, rb_rolling_model *v)
{
    if (v->bodies.f.m && v->bodies.f.x == of->bodies.f.x)
        memset(&v->bodies, 0, sizeof v->bodies);
    rb_rolling_model_free(v);
}

void rb_rolling_variant_set(const rb_rolling_model *of, const rb_contact_state *along,
                            double part, rb_rolling_model *v)
{
    const rb_contact_state *from = &of->state;
    rb_contact_state *to = &v->state;

    for (int i = 0; i < from->n; i++) {
        to->p[i] = from->p[i] + (along ? part * along->p[i] : 0.0);
        to->q[i] = from->q[i] + (along ? part * along->q[i] : 0.0);
        to->zone[i] = from->zone[i];
    }
    to->delta = from->delta + (along ? part * along->delta : 0.0);
    to->xi = from->xi + (along ? part * along->xi : 0.0);
    to->status = from->status;
    to->solver = from->solver;
    to->lcp_form = from->lcp_form;
}

rb_status rb_rolling_variant_complete(rb_rolling_model *v, rb_message *why)
{
    rb_contact_state *state = &v->state;
    rb_contact_problem *p = &v->problem;
    const rb_rolling_case *rc = &v->rc;
    double *gap = rb_alloc((size_t)state->n, 1);

    if (!gap)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d elements", state->n);
    rb_contact_kinematics(p, state, gap, state->lambda);
    free(gap);
    for (int i = 0; i < state->n; i++) {
        state->lambda[i] *= state->zone[i] != RB_ZONE_STICK;
        state->plastic[i] =
            state->zone[i] > RB_ZONE_SLIP_POSITIVE ? state->lambda[i] : 0.0;
    }
    v->half_width = rb_rolling_hertz_half_width(rc, fmax(0.0, rb_rolling_model_load(v)));
    if (!p->force_given && !p->load_given && rc->formulation != RB_STATIC &&
        !isnan(rc->creep_ratio))
        p->xi = rb_rolling_creepage_of_ratio(v, rc->creep_ratio);
    return rb_rolling_model_friction(v, why);
}
