/* Wheels, whose boundary has elements all around: on a clamped arc and on a rigid hub. */
#include "rolling/body/internal.h"
#include "rolling/body/wheel.h"
#include "rolling/solve/model.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

/* The closed polygon of the wheel (B4), graded from the contact's elements to those far away (B7),
 * with its support (B6). */
static rb_status boundary_mesh(const rb_rolling_plan *plan, const rb_rolling_body *body,
                               const rb_rolling_mesh *mesh, rb_bem_cylinder *cylinder,
                               rb_bem_mesh *boundary, rb_message *why)
{
    *cylinder = (rb_bem_cylinder){.radius = body->radius,
                                  .support = body->support,
                                  .arc = body->arc * M_PI / 180.0,
                                  .hub_ratio = body->hub_ratio,
                                  .cover = body->cover,
                                  .outer_elements = plan->outer_elements,
                                  .refinement = plan->outer_refinement};
    rb_status s = rb_bem_mesh_cylinder(cylinder, mesh->n, mesh->ends, boundary, why);
    if (s != RB_EINVAL)
        return s;
    /* The message names what is to be changed: is it also wrong with as many elements as fit? */
    rb_bem_cylinder graded = *cylinder;
    graded.outer_elements = 0;
    s = rb_bem_mesh_cylinder(&graded, mesh->n, mesh->ends, boundary, NULL);
    rb_bem_mesh_free(boundary);
    return rb_rolling_name_options(RB_EINVAL, s == RB_OK, "zone,arc,arc-b", "outer-elements", why);
}

/* The boundary elements of a wheel, of its cover alone where the core is rigid, of both
 * where it is elastic; few: only for a few loads of a wheel of one material. */
static rb_status wheel_system(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                              const rb_rolling_body *body, const rb_rolling_mesh *mesh, int few,
                              rb_bem_system **system, rb_message *why)
{
    const rb_bem_material material = rb_rolling_material(rc, body);
    rb_bem_cylinder cylinder;
    rb_bem_mesh boundary = {0}, core = {0};
    rb_status s = boundary_mesh(plan, body, mesh, &cylinder, &boundary, why);

    if (s == RB_OK && rb_rolling_has_elastic_core(body)) {
        s = rb_rolling_name_options(rb_bem_mesh_core(&cylinder, &boundary, &core, why),
                                    body == &rc->b, rb_rolling_of_rings, rb_rolling_of_rings_b,
                                    why);
        if (s == RB_OK)
            s = rb_bem_system_create_bonded(&boundary, material, &core,
                                            rb_rolling_base_material(rc, body), system, why);
    } else if (s == RB_OK) {
        s = (few ? rb_bem_system_create_for_few : rb_bem_system_create_within)(
            &boundary, material, plan->compression, system, why);
    }
    rb_bem_mesh_free(&core);
    rb_bem_mesh_free(&boundary);
    return s;
}

rb_status rb_rolling_boundary_mesh(const rb_rolling_model *model, int of_b, rb_bem_mesh *boundary,
                                   rb_message *why)
{
    rb_bem_cylinder cylinder;
    const rb_rolling_body *body = of_b ? &model->rc->b : &model->rc->a;
    *boundary = (rb_bem_mesh){0};
    return body->support == RB_BEM_HALFPLANE || (of_b && !model->rc->elastic_b)
               ? RB_OK
               : boundary_mesh(&model->plan, body, &model->mesh, &cylinder, boundary, why);
}

rb_status rb_rolling_boundary_system(const rb_rolling_model *model, int of_b, int few,
                                     rb_bem_system **system, rb_message *why)
{
    return wheel_system(model->rc, &model->plan, of_b ? &model->rc->b : &model->rc->a, &model->mesh,
                        few, system, why);
}

/* (B10) Constant elements err by some per cent next to a load.  That is left to equal elements,
 * which err more at the edges; graded elements and covers would lose what they gain. */
int rb_rolling_subtracts(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                         const rb_rolling_body *body)
{
    return plan->near_field == RB_NEAR_FIELD_AUTO ? rc->mesh == RB_MESH_FITTED || body->cover > 0.0
                                                  : plan->near_field == RB_NEAR_FIELD_EXACT;
}

/* By boundary elements all around, A x = b (B4), condensed to the contact, F (B5); a covered roll
 * by waves, which needs no elements outside the contact (B12). */
static rb_status wheel_flexibility(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                   rb_rolling_body_flexibility *one_body, rb_message *why)
{
    const double start = rb_seconds();
    const int by_waves = rb_rolling_goes_by_waves(rc, body);
    rb_status s = by_waves ? rb_rolling_flexibility_by_waves(rc, body, mesh, &one_body->f, why)
                           : wheel_system(rc, plan, body, mesh, 0, &one_body->system, why);

    if (s == RB_OK && !by_waves) {
        rb_bem_system_seconds(one_body->system, &one_body->seconds_assembly,
                              &one_body->seconds_factor);
        s = (rb_rolling_subtracts(rc, plan, body) ? rb_bem_condense_subtracted : rb_bem_condense)(
            one_body->system, rc->normals, &one_body->f, why);
    }
    if (s == RB_OK && body->memory.n > 0)
        s = rb_rolling_add_wheel_memory(rc, body, mesh, one_body, why);
    one_body->seconds_condense =
        rb_seconds() - start - one_body->seconds_assembly - one_body->seconds_factor;
    return s;
}

/* ---- A clamped arc ----------------------------------------------------------------- */

static const rb_rolling_parameter arc_parameters[] = {{.option = "arc"}, {.option = NULL}};

const rb_rolling_body_kind rb_rolling_arc = {.name = "arc",
                                             .support = RB_BEM_ARC,
                                             .can = RB_BODY_WHEEL | RB_BODY_HOMOGENEOUS,
                                             .parameters = arc_parameters,
                                             .flexibility = wheel_flexibility,
                                             .near = rb_rolling_wheel_near,
                                             .surface = rb_rolling_halfplane_surface};

/* ---- A rigid hub ------------------------------------------------------------------- */

static int shows_its_hub(const rb_rolling_body *body)
{
    return body->cover == 0.0 || rb_rolling_has_elastic_core(body);
}

static const rb_rolling_parameter hub_parameters[] = {
    {.option = "hub-ratio"},
    {"hub-ratio", shows_its_hub, "all below the cover is rigid without --core-young"},
    {.option = NULL}};

const rb_rolling_body_kind rb_rolling_hub = {.name = "hub",
                                             .support = RB_BEM_HUB,
                                             .can = RB_BODY_WHEEL | RB_BODY_HOMOGENEOUS |
                                                    RB_BODY_TURNS,
                                             .parameters = hub_parameters,
                                             .flexibility = wheel_flexibility,
                                             .near = rb_rolling_wheel_near,
                                             .transformed = rb_rolling_wheel_transformed,
                                             .transforms = rb_rolling_wheel_transforms,
                                             .surface = rb_rolling_halfplane_surface};
