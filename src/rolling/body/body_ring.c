/* Wheels as rings, by their waves around the circumference (B12): what covers are computed by, what
 * relaxes in steady rolling (V8), and the half-plane that answers like a wheel near to a load
 * (B10). */
#include "bem/bem.h"
#include "rolling/body/wheel.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

rb_bem_wheel rb_rolling_wheel_of(const rb_rolling_case *rc, const rb_rolling_body *body,
                                 double length[RB_ROLLING_TERMS])
{
    const double hub = body->hub_ratio * body->radius;
    rb_bem_wheel wheel = {.radius = body->radius,
                          .inner = body->cover > 0.0 ? body->radius - body->cover : hub,
                          .material = rb_rolling_material(rc, body),
                          .terms = body->memory.n,
                          .ratio = body->memory.ratio,
                          .length = length};

    if (rb_rolling_has_memory(body))
        rb_rolling_memory_lengths(rc, body, length);
    if (rb_rolling_has_elastic_core(body)) {
        wheel.hub = hub;
        wheel.core = rb_rolling_base_material(rc, body);
    }
    return wheel;
}

rb_status rb_rolling_flexibility_by_waves(const rb_rolling_case *rc, const rb_rolling_body *body,
                                          const rb_rolling_mesh *mesh, rb_bem_flexibility *f,
                                          rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const rb_bem_wheel wheel = rb_rolling_wheel_of(rc, body, length);
    return rb_rolling_name_options(
        rb_bem_flexibility_wheel(mesh->n, mesh->ends, &wheel, rc->normals, f, why), body == &rc->b,
        rb_rolling_of_rings, rb_rolling_of_rings_b, why);
}

rb_status rb_rolling_add_wheel_memory(const rb_rolling_case *rc, const rb_rolling_body *body,
                                      const rb_rolling_mesh *mesh,
                                      rb_rolling_body_flexibility *one_body, rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const rb_bem_wheel wheel = rb_rolling_wheel_of(rc, body, length);
    rb_status s = rb_rolling_memory_before(&one_body->f, &one_body->memory);

    if (s == RB_OK)
        s = rb_bem_flexibility_add_memory(&wheel, rc->normals, mesh->ends, &one_body->f, why);
    if (s == RB_OK)
        rb_rolling_memory_after(&one_body->f, one_body->memory);
    return s;
}

/* Hysteresis of pairs with a wheel is made of the matrix. */
int rb_rolling_wheel_transformed(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return rb_rolling_goes_by_waves(rc, body) && rc->formulation == RB_STEADY &&
           rc->a.memory.n == 0 && !(rc->elastic_b && rc->b.memory.n > 0);
}

rb_status rb_rolling_wheel_transforms(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                      const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                      rb_rolling_body_flexibility *one_body, rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const rb_bem_wheel wheel = rb_rolling_wheel_of(rc, body, length);
    (void)plan;
    return rb_rolling_name_options(rb_bem_flexibility_wheel_products(
                                       mesh->n, mesh->ends, &wheel, rc->normals, &one_body->f, why),
                                   body == &rc->b, rb_rolling_of_rings, rb_rolling_of_rings_b, why);
}

/* Along the arc, where the logarithm of a disc is that of a half-plane (B10). */
rb_status rb_rolling_wheel_near(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                rb_rolling_body_flexibility *one_body, rb_message *why)
{
    const double R = body->radius;
    const rb_bem_surface surface = rb_bem_halfplane(rb_rolling_material(rc, body), R);
    rb_bem_flexibility *f = &one_body->f;
    double *arc = rb_alloc((size_t)mesh->n + 2, 1);
    rb_status s = RB_ENOMEM;

    (void)plan;
    for (int i = 0; i < mesh->n + 2 && arc; i++)
        arc[i] = R * asin(mesh->ends[i] / R);
    if (arc)
        s = rb_bem_flexibility_surface(mesh->n, arc, &surface, f, why);
    for (int i = 0; i < f->m && s == RB_OK; i++) { /* chords, as boundary elements are */
        f->x[i] = 0.5 * (mesh->ends[i] + mesh->ends[i + 1]);
        f->h[i] = 2.0 * R * sin(0.5 * (arc[i + 1] - arc[i]) / R);
    }
    free(arc);
    return s;
}
