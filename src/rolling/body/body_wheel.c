/* Wheels, whose boundary has elements all around: on a clamped arc, on a rigid hub, and
 * with a cover on a core. */
#include "rolling/body/internal.h"
#include "rolling/solve/model.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>

int rb_rolling_has_elastic_core(const rb_rolling_body *body)
{
    return body->cover > 0.0 && body->core_young > 0.0;
}

/* Around a cover nothing changes with the angle: without boundary elements, unless they
 * are asked for. */
static int goes_by_waves(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return body->cover > 0.0 && rc->near_field == RB_NEAR_FIELD_AUTO;
}

/* src/bem knows no options: what it refuses is that of the first ones, or of the
 * others. */
static rb_status name_options(rb_status s, int other, const char *first, const char *second,
                              rb_message *why)
{
    return s == RB_EINVAL ? rb_refuse(why, other ? second : first, "%s", why ? why->text : "") : s;
}

static const char of_rings[] = "hub-ratio,cover-thickness,radius",
                  of_rings_b[] = "hub-ratio-b,cover-thickness-b,radius-b";

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
    /* is it also wrong with as many elements as fit? */
    rb_bem_cylinder graded = *cylinder;
    graded.outer_elements = 0;
    s = rb_bem_mesh_cylinder(&graded, mesh->n, mesh->ends, boundary, NULL);
    rb_bem_mesh_free(boundary);
    return name_options(RB_EINVAL, s == RB_OK, "zone,arc,arc-b", "outer-elements", why);
}

/* The boundary elements of a wheel, of its cover alone where the core is rigid, of both
 * where it is elastic. */
static rb_status wheel_system(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                              const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                              rb_bem_system **system, rb_message *why)
{
    const rb_bem_material material = rb_rolling_material(rc, body);
    rb_bem_cylinder cylinder;
    rb_bem_mesh boundary = {0}, core = {0};
    rb_status s = boundary_mesh(plan, body, mesh, &cylinder, &boundary, why);

    if (s == RB_OK && rb_rolling_has_elastic_core(body)) {
        s = name_options(rb_bem_mesh_core(&cylinder, &boundary, &core, why), body == &rc->b,
                         of_rings, of_rings_b, why);
        if (s == RB_OK)
            s = rb_bem_system_create_bonded(&boundary, material, &core,
                                            rb_rolling_base_material(rc, body), system, why);
    } else if (s == RB_OK) {
        s = rb_bem_system_create_within(&boundary, material, plan->compression, system, why);
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

rb_status rb_rolling_boundary_system(const rb_rolling_model *model, rb_bem_system **system,
                                     rb_message *why)
{
    return wheel_system(model->rc, &model->plan, &model->rc->a, &model->mesh, system, why);
}

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

int rb_rolling_subtracts(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                         const rb_rolling_body *body)
{
    return plan->near_field == RB_NEAR_FIELD_AUTO ? rc->mesh == RB_MESH_FITTED || body->cover > 0.0
                                                  : plan->near_field == RB_NEAR_FIELD_EXACT;
}

static rb_status wheel_flexibility(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                   const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                   rb_rolling_body_flexibility *one_body, rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const rb_bem_wheel wheel = rb_rolling_wheel_of(rc, body, length);
    const double start = rb_seconds();
    const int by_waves = goes_by_waves(rc, body);
    rb_status s = by_waves ? name_options(rb_bem_flexibility_wheel(mesh->n, mesh->ends, &wheel,
                                                                   rc->normals, &one_body->f, why),
                                          body == &rc->b, of_rings, of_rings_b, why)
                           : wheel_system(rc, plan, body, mesh, &one_body->system, why);

    if (s == RB_OK && !by_waves) {
        rb_bem_system_seconds(one_body->system, &one_body->seconds_assembly,
                              &one_body->seconds_factor);
        s = (rb_rolling_subtracts(rc, plan, body) ? rb_bem_condense_subtracted : rb_bem_condense)(
            one_body->system, rc->normals, &one_body->f, why);
    }
    if (s == RB_OK && body->memory.n > 0) {
        /* What memory adds to the glassy wheel in steady rolling, which is all that asks for the
         * flexibility of a body with memory. */
        s = rb_rolling_memory_before(&one_body->f, &one_body->memory);
        if (s == RB_OK)
            s = rb_bem_flexibility_add_memory(&wheel, rc->normals, mesh->ends, &one_body->f, why);
        if (s == RB_OK)
            rb_rolling_memory_after(&one_body->f, one_body->memory);
    }
    one_body->seconds_condense =
        rb_seconds() - start - one_body->seconds_assembly - one_body->seconds_factor;
    return s;
}

/* Hysteresis of pairs with a wheel is made of the matrix. */
static int wheel_transformed(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return goes_by_waves(rc, body) && rc->formulation == RB_STEADY && rc->a.memory.n == 0 &&
           !(rc->elastic_b && rc->b.memory.n > 0);
}

static rb_status wheel_transforms(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                  const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                  rb_rolling_body_flexibility *one_body, rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const rb_bem_wheel wheel = rb_rolling_wheel_of(rc, body, length);
    (void)plan;
    return name_options(rb_bem_flexibility_wheel_products(mesh->n, mesh->ends, &wheel, rc->normals,
                                                          &one_body->f, why),
                        body == &rc->b, of_rings, of_rings_b, why);
}

/* Along the arc, where the logarithm of a disc is that of a half-plane (B10). */
static rb_status wheel_near(const rb_rolling_case *rc, const rb_rolling_plan *plan,
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

enum { WHEEL = RB_BODY_BOUNDARY | RB_BODY_ELASTIC | RB_BODY_STRESS };

/* ---- A clamped arc ----------------------------------------------------------------- */

static const rb_rolling_parameter arc_parameters[] = {{.option = "arc"}, {.option = NULL}};

const rb_rolling_body_kind rb_rolling_arc = {.name = "arc",
                                             .support = RB_BEM_ARC,
                                             .can = WHEEL | RB_BODY_HOMOGENEOUS,
                                             .parameters = arc_parameters,
                                             .flexibility = wheel_flexibility,
                                             .near = wheel_near,
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
                                             .can = WHEEL | RB_BODY_HOMOGENEOUS | RB_BODY_TURNS,
                                             .parameters = hub_parameters,
                                             .flexibility = wheel_flexibility,
                                             .near = wheel_near,
                                             .transformed = wheel_transformed,
                                             .transforms = wheel_transforms,
                                             .surface = rb_rolling_halfplane_surface};

/* ---- A cover on a core ------------------------------------------------------------- */

static int has_cover(const rb_rolling_body *body)
{
    return body->cover > 0.0;
}

static rb_status check_cover(const rb_rolling_case *rc, const rb_rolling_body *b, const char *which,
                             rb_message *why)
{
    const char *thickness = *which ? "cover-thickness-b" : "cover-thickness";
    if (b->cover != 0.0 && b->support != RB_BEM_HUB)
        return rb_refuse(why, thickness, "its core holds the wheel, add --support%s hub", which);
    if (!(b->cover < fabs(b->radius)))
        return rb_refuse(why, thickness, "expected less than the radius, %g mm, got %g mm",
                         b->radius, b->cover);
    /* boundary elements hardly tell how an incompressible cover presses on its core all around */
    if (rb_rolling_has_elastic_core(b) && !goes_by_waves(rc, b) &&
        rb_rolling_material(rc, b).poisson > RB_ROLLING_COMPRESSIBLE)
        return rb_refuse(
            why, *which ? "near-field,poisson-b" : "near-field,poisson",
            "boundary elements of a cover on an elastic core need --poisson%s of 0.499 "
            "at most, got %g; leave --near-field out",
            which, b->poisson);
    return rb_rolling_has_elastic_core(b)
               ? rb_rolling_check_poisson(rc, *which ? "core-poisson-b" : "core-poisson",
                                          b->core_poisson, why)
               : RB_OK;
}

static const rb_rolling_parameter cover_parameters[] = {
    {"core-young", has_cover, "a core has its cover on it, see --cover-thickness"},
    {"core-poisson", has_cover, "a core has its cover on it, see --cover-thickness"},
    {.option = NULL}};

const rb_rolling_body_kind rb_rolling_cover = {.name = "cover",
                                               .support = RB_BEM_HUB,
                                               .holds = has_cover,
                                               .can = WHEEL | RB_BODY_TURNS,
                                               .parameters = cover_parameters,
                                               .check = check_cover};
