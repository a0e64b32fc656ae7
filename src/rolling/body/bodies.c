/* The flexibility of both bodies and of what lies between them, F = F_A + F_B + compliance of the
 * interlayer (4.5, 4.10): each body by its row of the table of bodies. */
#include "rolling/body/far_field.h"
#include "rolling/case/internal.h"
#include "rolling/solve/model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_bodies_free(rb_rolling_bodies *bodies)
{
    rb_bem_flexibility_free(&bodies->f);
    rb_bem_flexibility_free(&bodies->transforms);
    rb_bem_system_free(bodies->system_a);
    rb_bem_system_free(bodies->system_b);
    free(bodies->memory[0]);
    free(bodies->memory[1]);
    memset(bodies, 0, sizeof *bodies);
}

/* Refuses what has no room before anything is computed; without the boundaries of wheels, which
 * rb_bem_system_create looks at. */
static rb_status check_memory(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                              rb_message *why)
{
    char what[80];

    snprintf(what, sizeof what, "a contact of %d elements", mesh->n);
    return rb_memory_check(rb_rolling_bytes(rc, mesh->n, 0, 2 * mesh->n), what, why);
}

static rb_status or_no_memory(rb_status s, int n, rb_message *why)
{
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the flexibility of %d elements", n)
                          : s;
}

/* The third body (4.10) gives way under the traction of its own element alone: a diagonal. */
static rb_status add_interlayer(const rb_rolling_case *rc, rb_bem_flexibility *f)
{
    const int n = f->n;

    if (rc->interlayer_normal == 0.0 && rc->interlayer_tangential == 0.0)
        return RB_OK;
    double *compliance = rb_alloc((size_t)n, 2);
    for (int i = 0; compliance && i < n; i++) {
        compliance[i] = rc->interlayer_normal;
        compliance[n + i] = rc->interlayer_tangential;
    }
    const rb_status s =
        compliance ? rb_bem_flexibility_add_compliance(f, compliance, compliance + n) : RB_ENOMEM;
    free(compliance);
    return s;
}

/* What is wanted of a body: its flexibility as a matrix; as products by Fourier transforms, for
 * many elements; or the near field of its loads alone, in closed form, while edges are searched
 * for: the far field hardly changes from mesh to mesh (far_field.h). */
typedef enum { WHOLE, BY_TRANSFORMS, NEAR } part;

static rb_status body_flexibility(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                  const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                  part wanted, rb_rolling_body_flexibility *one_body,
                                  rb_message *why)
{
    const rb_rolling_body_kind *kind = rb_rolling_kind_of(body);
    return (wanted == BY_TRANSFORMS ? kind->transforms
            : wanted == NEAR && kind->near
                ? kind->near
                : kind->flexibility)(rc, plan, body, mesh, one_body, why);
}

/* F = F_A + F_B (4.5), B mirrored, so that its coupling blocks change their sign.  f: that of both
 * bodies together; one_body: what else they have made. */
static rb_status join_bodies(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                             const rb_rolling_mesh *mesh, part wanted,
                             rb_rolling_body_flexibility one_body[2], rb_bem_flexibility *f,
                             rb_message *why)
{
    /* hysteresis is made of it, because what turns with a wheel costs nothing;
     * half-planes move straight on (theory-bodies.md V4) */
    one_body[0].keeps_memory = one_body[1].keeps_memory =
        rc->formulation == RB_STEADY && !rb_rolling_can(rc, RB_BODY_FLAT);
    rb_status s = body_flexibility(rc, plan, &rc->a, mesh, wanted, &one_body[0], why);

    if (s == RB_OK && rc->elastic_b) {
        s = body_flexibility(rc, plan, &rc->b, mesh, wanted, &one_body[1], why);
        if (s == RB_OK)
            s = rb_bem_flexibility_pair(&one_body[0].f, &one_body[1].f, f, why);
    } else if (s == RB_OK) {
        *f = one_body[0].f;
        memset(&one_body[0].f, 0, sizeof one_body[0].f);
    }
    rb_bem_flexibility_free(&one_body[0].f);
    rb_bem_flexibility_free(&one_body[1].f);
    return s;
}

/* Products cost n log n where the matrix costs n^2, so that Newton's method on
 * many elements of half-planes iterates with them. */
static rb_status add_transforms(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                rb_rolling_bodies *bodies, rb_message *why)
{
    rb_rolling_body_flexibility one_body[2] = {{.system = NULL}, {.system = NULL}};

    if (mesh->n < RB_ROLLING_PRODUCTS_BESIDE_FROM || !rb_rolling_has_transforms(rc))
        return RB_OK;
    const rb_status s =
        join_bodies(rc, NULL, mesh, BY_TRANSFORMS, one_body, &bodies->transforms, why);
    return s == RB_OK ? add_interlayer(rc, &bodies->transforms) : s;
}

rb_status rb_rolling_bodies_create(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   const rb_rolling_mesh *mesh, rb_rolling_bodies *bodies,
                                   rb_message *why)
{
    const rb_rolling_plan own = rb_rolling_plan_of(rc);
    memset(bodies, 0, sizeof *bodies);
    rb_rolling_body_flexibility one_body[2] = {{.system = NULL}, {.system = NULL}};
    const int large = rb_rolling_is_large(rc, mesh);
    rb_status s = check_memory(rc, mesh, why);

    if (s == RB_OK && rb_rolling_relaxes(rc) && rc->formulation != RB_STEADY)
        s = rb_refuse(why, "relaxation-time,relaxation-time-b",
                      "bodies that relax and do not roll steadily need a history "
                      "of steps in time");
    /* F = F_A + F_B (4.5): each by its row of the table, a matrix or, of many elements, products.
     */
    if (s == RB_OK)
        s = join_bodies(rc, plan ? plan : &own, mesh, large ? BY_TRANSFORMS : WHOLE, one_body,
                        &bodies->f, why);
    bodies->system_a = one_body[0].system;
    bodies->system_b = one_body[1].system;
    bodies->memory[0] = one_body[0].memory;
    bodies->memory[1] = one_body[1].memory;
    bodies->seconds_assembly = one_body[0].seconds_assembly + one_body[1].seconds_assembly;
    bodies->seconds_factor = one_body[0].seconds_factor + one_body[1].seconds_factor;
    bodies->seconds_condense = one_body[0].seconds_condense + one_body[1].seconds_condense;
    /* The third body between them gives way on the diagonals. */
    if (s == RB_OK && !large && !rb_bem_flexibility_stored(&bodies->f))
        s = rb_bem_flexibility_store(&bodies->f);
    if (s == RB_OK)
        s = add_interlayer(rc, &bodies->f);
    if (s == RB_OK)
        bodies->F = rb_bem_flexibility_stored(&bodies->f);
    /* Beside a matrix of many elements products, by which Newton's method solves sooner. */
    if (s == RB_OK && !large)
        s = add_transforms(rc, mesh, bodies, why);
    if (s != RB_OK)
        rb_rolling_bodies_free(bodies);
    return or_no_memory(s, mesh->n, why);
}

rb_status rb_rolling_bodies_near(const rb_rolling_case *rc, const rb_rolling_far_field *far,
                                 const rb_rolling_mesh *mesh, rb_rolling_bodies *bodies,
                                 rb_message *why)
{
    const rb_rolling_plan own = rb_rolling_plan_of(rc);
    rb_rolling_body_flexibility one_body[2] = {{.system = NULL}, {.system = NULL}};
    const double start = rb_seconds();
    rb_status s;

    memset(bodies, 0, sizeof *bodies);
    s = join_bodies(rc, &own, mesh, NEAR, one_body, &bodies->f, why);
    if (s == RB_OK)
        s = rb_bem_flexibility_store(&bodies->f);
    if (s == RB_OK && far)
        s = rb_rolling_far_field_add(far, &bodies->f);
    if (s == RB_OK)
        s = add_interlayer(rc, &bodies->f);
    if (s == RB_OK)
        bodies->F = rb_bem_flexibility_stored(&bodies->f);
    bodies->seconds_condense = rb_seconds() - start;
    if (s != RB_OK)
        rb_rolling_bodies_free(bodies);
    return or_no_memory(s, mesh->n, why);
}

rb_status rb_rolling_bodies_with_matrix(const rb_rolling_case *rc, const rb_rolling_mesh *mesh,
                                        const rb_rolling_bodies *bodies, rb_rolling_bodies *stored,
                                        rb_message *why)
{
    rb_status s = check_memory(rc, mesh, why);

    *stored = *bodies;
    stored->f = stored->transforms = (rb_bem_flexibility){0};
    if (s == RB_OK)
        s = rb_bem_flexibility_as_matrix(&bodies->f, &stored->f);
    if (s == RB_OK) {
        stored->F = rb_bem_flexibility_stored(&stored->f);
        s = add_transforms(rc, mesh, stored, why);
    }
    return or_no_memory(s, mesh->n, why);
}
