#include "rolling/internal.h"

#include <cblas.h>
#include <gsl/gsl_math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_bodies_free(rb_rolling_bodies *bodies)
{
    rb_bem_flexibility_free(&bodies->f);
    rb_bem_system_free(bodies->system_a);
    rb_bem_system_free(bodies->system_b);
    memset(bodies, 0, sizeof *bodies);
}

static double depth_of_datum(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const double radius = isfinite(body->radius) ? body->radius : rc->a.radius;
    return body->datum > 0.0 ? body->datum : 2.0 * radius / M_E;
}

double rb_rolling_datum(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    const int on_rigid_base = body->layer > 0.0 && body->base_young == 0.0;
    return body->support != RB_BEM_HALFPLANE || on_rigid_base ? NAN
                                                              : depth_of_datum(rc, body);
}

rb_bem_surface rb_rolling_surface_of(const rb_rolling_case *rc,
                                     const rb_rolling_body *body,
                                     double length[RB_ROLLING_TERMS])
{
    for (int k = 0; k < body->memory.n; k++)
        length[k] = rc->speed * body->memory.time[k];
    const int elastic_base = body->layer > 0.0 && body->base_young > 0.0;
    return (rb_bem_surface){
        .material = rb_bem_material_from_young(body->young, body->poisson),
        .datum = depth_of_datum(rc, body),
        .terms = body->memory.n,
        .ratio = body->memory.ratio,
        .length = length,
        .thickness = body->layer,
        .elastic_base = elastic_base,
        .base = elastic_base
                    ? rb_bem_material_from_young(body->base_young, body->base_poisson)
                    : (rb_bem_material){0}};
}

static int body_is_homogeneous(const rb_rolling_body *body)
{
    return body->layer == 0.0 && body->cover == 0.0 && body->memory.n == 0;
}

int rb_rolling_is_homogeneous(const rb_rolling_case *rc)
{
    return body_is_homogeneous(&rc->a) && (!rc->elastic_b || body_is_homogeneous(&rc->b));
}

int rb_rolling_is_large(const rb_rolling_case *rc, const rb_rolling_mesh *mesh)
{
    /* products know one operator for bodies and third body */
    const int two_operators =
        rc->slip_operator == RB_SLIP_SECOND && rc->interlayer_tangential > 0.0;
    return mesh->n >= RB_ROLLING_LARGE && !two_operators &&
           (rc->solver == RB_SOLVER_AUTO || rc->solver == RB_SOLVER_NEWTON) &&
           rc->mesh != RB_MESH_FITTED && rc->a.support == RB_BEM_HALFPLANE &&
           (!rc->elastic_b || rc->b.support == RB_BEM_HALFPLANE);
}

/* Of a cover as well: its stretch under the load is what one wants to know. */
static int wants_exact_field(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return rc->near_field == RB_NEAR_FIELD_AUTO
               ? rc->mesh == RB_MESH_FITTED || body->cover > 0.0
               : rc->near_field == RB_NEAR_FIELD_EXACT;
}

/* The boundary elements of a wheel, of its cover alone where the core is rigid, of both
 * where it is elastic. */
static rb_status cylinder_system(const rb_rolling_body *body,
                                 const rb_bem_cylinder *cylinder,
                                 const rb_rolling_mesh *mesh, rb_bem_system **system,
                                 rb_message *why)
{
    const rb_bem_material material =
        rb_bem_material_from_young(body->young, body->poisson);
    rb_bem_mesh boundary = {0}, core = {0};
    rb_status s = rb_bem_mesh_cylinder(cylinder, mesh->n, mesh->ends, &boundary, why);

    if (s == RB_OK && body->cover > 0.0 && body->core_young > 0.0) {
        s = rb_bem_mesh_core(cylinder, &boundary, &core, why);
        if (s == RB_OK)
            s = rb_bem_system_create_bonded(
                &boundary, material, &core,
                rb_bem_material_from_young(body->core_young, body->core_poisson), system,
                why);
    } else if (s == RB_OK) {
        s = rb_bem_system_create(&boundary, material, system, why);
    }
    rb_bem_mesh_free(&core);
    rb_bem_mesh_free(&boundary);
    return s;
}

static rb_status cylinder_flexibility(const rb_rolling_case *rc,
                                      const rb_rolling_body *body,
                                      const rb_rolling_mesh *mesh, rb_bem_system **system,
                                      rb_rolling_bodies *bodies, rb_bem_flexibility *f,
                                      rb_message *why)
{
    const rb_bem_cylinder cylinder = {.radius = body->radius,
                                      .support = body->support,
                                      .arc = body->arc * M_PI / 180.0,
                                      .hub_ratio = body->hub_ratio,
                                      .cover = body->cover,
                                      .outer_elements = rc->outer_elements,
                                      .refinement = rc->outer_refinement};
    rb_status s = cylinder_system(body, &cylinder, mesh, system, why);

    if (s == RB_OK) {
        double assembly, factor;
        rb_bem_system_seconds(*system, &assembly, &factor);
        bodies->seconds_assembly += assembly;
        bodies->seconds_factor += factor;
        const double start = rb_seconds();
        s = (wants_exact_field(rc, body) ? rb_bem_condense_subtracted
                                         : rb_bem_condense)(*system, rc->normals, f, why);
        bodies->seconds_condense += rb_seconds() - start;
    }
    return s;
}

static rb_status body_flexibility(const rb_rolling_case *rc, const rb_rolling_body *body,
                                  const rb_rolling_mesh *mesh, rb_bem_system **system,
                                  rb_rolling_bodies *bodies, rb_bem_flexibility *f,
                                  rb_message *why)
{
    if (body->support != RB_BEM_HALFPLANE)
        return cylinder_flexibility(rc, body, mesh, system, bodies, f, why);
    double length[RB_ROLLING_TERMS];
    const double start = rb_seconds();
    const rb_bem_surface surface = rb_rolling_surface_of(rc, body, length);
    const rb_status s =
        rb_rolling_is_large(rc, mesh)
            ? rb_bem_flexibility_toeplitz(mesh->n, mesh->ends, &surface, f, why)
            : rb_bem_flexibility_surface(mesh->n, mesh->ends, &surface, f, why);
    bodies->seconds_condense += rb_seconds() - start;
    return s;
}

int rb_rolling_carter_holds(const rb_rolling_case *rc)
{
    const int flat = rc->a.support == RB_BEM_HALFPLANE &&
                     (!rc->elastic_b || rc->b.support == RB_BEM_HALFPLANE);
    return rc->formulation == RB_STEADY && rc->mu > 0.0 && rc->friction.n == 0 &&
           rc->interlayer_normal == 0.0 && rc->interlayer_tangential == 0.0 && flat &&
           rc->gap != RB_GAP_TABLE && rb_rolling_is_homogeneous(rc) && rc->worn_n == 0 &&
           fabs(rb_rolling_derive(rc).dundurs) < 1e-9;
}

/* Without the boundaries of wheels, which rb_bem_system_create looks at. */
static rb_status check_memory(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              rb_message *why)
{
    char what[80];

    snprintf(what, sizeof what, "a contact of %d elements", mesh->n);
    return rb_memory_check(rb_rolling_bytes(rc, mesh->n, 0, 2 * mesh->n), what, why);
}

static rb_status add_interlayer(const rb_rolling_case *rc, rb_bem_flexibility *f)
{
    const int n = f->n;

    if (rc->interlayer_normal == 0.0 && rc->interlayer_tangential == 0.0)
        return RB_OK;
    double *own = rb_alloc((size_t)n, 2);
    for (int i = 0; own && i < n; i++) {
        own[i] = rc->interlayer_normal;
        own[n + i] = rc->interlayer_tangential;
    }
    const rb_status s =
        own ? rb_bem_flexibility_add_compliance(f, own, own + n) : RB_ENOMEM;
    free(own);
    return s;
}

rb_status rb_rolling_bodies_create(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                   rb_rolling_bodies *bodies, rb_message *why)
{
    memset(bodies, 0, sizeof *bodies);
    rb_bem_flexibility a = {0}, b = {0};
    rb_status s = check_memory(rc, mesh, why);

    if (s == RB_OK)
        s = body_flexibility(rc, &rc->a, mesh, &bodies->system_a, bodies, &a, why);
    if (s == RB_OK && rc->elastic_b) {
        s = body_flexibility(rc, &rc->b, mesh, &bodies->system_b, bodies, &b, why);
        if (s == RB_OK)
            s = rb_bem_flexibility_pair(&a, &b, &bodies->f, why);
    } else if (s == RB_OK) {
        bodies->f = a;
        memset(&a, 0, sizeof a);
    }
    if (s == RB_OK)
        s = add_interlayer(rc, &bodies->f);
    if (s == RB_OK)
        bodies->F = rb_bem_flexibility_stored(&bodies->f);
    rb_bem_flexibility_free(&a);
    rb_bem_flexibility_free(&b);
    if (s != RB_OK)
        rb_rolling_bodies_free(bodies);
    return s == RB_ENOMEM
               ? rb_fail(why, s, "out of memory for the flexibility of %d elements",
                         mesh->n)
               : s;
}

rb_status rb_rolling_displacement(const rb_rolling_bodies *bodies, const double *p,
                                  const double *q, double *w)
{
    const int n = bodies->f.n;
    double *r = rb_alloc(2 * (size_t)n, 1);

    if (!r)
        return RB_ENOMEM;
    memcpy(r, p, (size_t)n * sizeof *r);
    memcpy(r + n, q, (size_t)n * sizeof *r);
    rb_bem_flexibility_apply(&bodies->f, r, w);
    cblas_daxpy(2 * bodies->f.m, 1.0, bodies->f.w0, 1, w, 1);
    free(r);
    return RB_OK;
}
