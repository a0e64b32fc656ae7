/* Half-planes, which have translation symmetry: of one material, as a layer on a base,
 * and viscoelastic. */
#include "bem/bem.h"
#include "rolling/body/gap.h"
#include "rolling/body/internal.h"
#include "rolling/case/derived.h"

#include <gsl/gsl_math.h>

/* The ends of a strip are held by the half-space: w_N = 0 at the depth of its width, as in the
 * plane, but w_T at width exp(nu/(1 - nu)), because Cerruti's displacement
 * (1 - nu)/r + nu x^2/r^3 has a second part. */
static double depth_of_datum(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    if (rc->period > 0.0) /* where ln|2 sin(pi s/L)| is zero near the load */
        return rc->period / (2.0 * M_PI);
    if (body->strip > 0.0)
        return body->strip;
    if (body->datum > 0.0)
        return body->datum;
    double from, to, radius = isfinite(body->radius) ? fabs(body->radius) : rc->a.radius;

    if (!isfinite(radius)) { /* of a gap without a radius: as deep as its table is wide */
        rb_rolling_profile_range(rc->profile, &from, &to);
        radius = 0.5 * (to - from);
    }
    return 2.0 * radius / M_E;
}

void rb_rolling_memory_lengths(const rb_rolling_case *rc, const rb_rolling_body *body,
                               double length[RB_ROLLING_TERMS])
{
    for (int k = 0; k < body->memory.n; k++)
        length[k] = rc->speed * body->memory.time[k];
}

rb_bem_surface rb_rolling_halfplane_surface(const rb_rolling_case *rc, const rb_rolling_body *body,
                                            double length[RB_ROLLING_TERMS])
{
    const int elastic_base = body->layer > 0.0 && body->base_young > 0.0;
    const double datum = depth_of_datum(rc, body), nu = body->poisson;
    double datum_memory = 0.0;

    rb_rolling_memory_lengths(rc, body, length);
    for (int k = 0; k < body->memory.n && body->layer == 0.0; k++)
        if (length[k] > 0.0)
            datum_memory += body->memory.ratio[k] *
                            (body->strip > 0.0 ? rb_bem_memory_of_strip(datum / length[k])
                                               : rb_bem_memory_of_datum(datum / length[k]));
    return (rb_bem_surface){
        .material = rb_rolling_material(rc, body),
        .datum = datum,
        .period = rc->period,
        .datum_tangential = body->strip > 0.0 ? datum * exp(nu / (1.0 - nu)) : 0.0,
        .datum_memory = datum_memory,
        .terms = body->memory.n,
        .ratio = body->memory.ratio,
        .length = length,
        .thickness = body->layer,
        .elastic_base = elastic_base,
        .base = elastic_base ? rb_rolling_base_material(rc, body) : (rb_bem_material){0},
        .smooth_base = body->layer_base == RB_BASE_SMOOTH,
        .stack = body->stack};
}

typedef rb_status maker(int n, const double *ends, const rb_bem_surface *surface,
                        rb_bem_flexibility *f, rb_message *why);

static rb_status make_halfplane(maker *how, const rb_rolling_case *rc, const rb_rolling_body *body,
                                const rb_rolling_mesh *mesh, rb_rolling_body_flexibility *one_body,
                                rb_message *why)
{
    double length[RB_ROLLING_TERMS];
    const double start = rb_seconds();
    const rb_bem_surface surface = rb_rolling_halfplane_surface(rc, body, length);
    rb_status s = how(mesh->n, mesh->ends, &surface, &one_body->f, why);
    if (s == RB_OK && one_body->keeps_memory && body->memory.n > 0) {
        rb_bem_surface glassy = surface;
        rb_bem_flexibility f = {0};
        glassy.terms = 0;
        s = how(mesh->n, mesh->ends, &glassy, &f, why);
        if (s == RB_OK)
            s = rb_rolling_memory_before(&f, &one_body->memory);
        if (s == RB_OK)
            s = rb_bem_flexibility_store(&one_body->f);
        if (s == RB_OK)
            rb_rolling_memory_after(&one_body->f, one_body->memory);
        rb_bem_flexibility_free(&f);
    }
    one_body->seconds_condense = rb_seconds() - start;
    return s;
}

static rb_status halfplane_flexibility(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                       const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                       rb_rolling_body_flexibility *one_body, rb_message *why)
{
    (void)plan; /* nothing lies outside the contact */
    return make_halfplane(rb_bem_flexibility_surface, rc, body, mesh, one_body, why);
}

/* Equal elements beside a wheel A are equal arcs of the wheel. */
static rb_status halfplane_transforms(const rb_rolling_case *rc, const rb_rolling_plan *plan,
                                      const rb_rolling_body *body, const rb_rolling_mesh *mesh,
                                      rb_rolling_body_flexibility *one_body, rb_message *why)
{
    (void)plan; /* nothing lies outside the contact */
    const int are_equal = rc->a.support == RB_BEM_HALFPLANE && !rb_rolling_mesh_is_graded(rc);
    return make_halfplane(are_equal ? rb_bem_flexibility_toeplitz
                                    : rb_bem_flexibility_surface_products,
                          rc, body, mesh, one_body, why);
}

enum { HALFPLANE = RB_BODY_FLAT | RB_BODY_TURNS };

/* ---- Of one material --------------------------------------------------------------- */

static int on_rigid_base(const rb_rolling_body *body)
{
    return body->layer > 0.0 && body->base_young == 0.0;
}

static int not_on_rigid_base(const rb_rolling_body *body)
{
    return !on_rigid_base(body);
}

static double datum(const rb_rolling_case *rc, const rb_rolling_body *body)
{
    return on_rigid_base(body) || rc->period > 0.0 ? NAN : depth_of_datum(rc, body);
}

static const rb_rolling_parameter halfplane_parameters[] = {
    {.option = "datum"},
    {"datum", not_on_rigid_base, "on a rigid base the displacement is absolute"},
    {.option = NULL}};

const rb_rolling_body_kind rb_rolling_halfplane = {.name = "half-plane",
                                                   .support = RB_BEM_HALFPLANE,
                                                   .can = HALFPLANE | RB_BODY_HOMOGENEOUS |
                                                          RB_BODY_ELASTIC | RB_BODY_STRESS,
                                                   .parameters = halfplane_parameters,
                                                   .flexibility = halfplane_flexibility,
                                                   .transforms = halfplane_transforms,
                                                   .surface = rb_rolling_halfplane_surface,
                                                   .datum = datum};

/* ---- With layers ------------------------------------------------------------------- */

int rb_rolling_layers(const rb_rolling_body *body)
{
    return body->stack ? body->stack->n : body->layer > 0.0;
}

rb_rolling_layer_properties rb_rolling_layer_of(const rb_rolling_body *body, int k)
{
    const rb_bem_stack *all = body->stack;
    return all ? (rb_rolling_layer_properties){all->thickness[k], all->young[k], all->poisson[k]}
               : (rb_rolling_layer_properties){body->layer, body->young, body->poisson};
}

double rb_rolling_bond_depth(const rb_rolling_body *body, int bond)
{
    double depth = 0.0;
    for (int k = 0; k < bond; k++)
        depth += rb_rolling_layer_of(body, k).thickness;
    return depth;
}

double rb_rolling_layers_depth(const rb_rolling_body *body)
{
    return rb_rolling_bond_depth(body, rb_rolling_layers(body));
}

double rb_rolling_poisson_at(const rb_rolling_body *body, double depth)
{
    const int layers = rb_rolling_layers(body);
    double bond = 0.0;
    for (int k = 0; k < layers; k++) {
        const rb_rolling_layer_properties layer = rb_rolling_layer_of(body, k);
        bond += layer.thickness;
        if (depth <= bond)
            return layer.poisson;
    }
    return layers > 0 ? body->base_poisson : body->poisson;
}

static rb_status check_layer(const rb_rolling_case *rc, const rb_rolling_body *b, const char *which,
                             rb_message *why)
{
    const char *layers = *which ? "layers-b" : "layers";
    if (rb_rolling_has_layer(b) && b->support != RB_BEM_HALFPLANE)
        return rb_refuse(why,
                         b->stack ? layers
                         : *which ? "layer-thickness-b"
                                  : "layer-thickness",
                         "for the support halfplane only, got a wheel");
    if (b->stack && b->memory.n > 0)
        return rb_refuse(why, *which ? "relaxation-time-b" : "relaxation-time",
                         "several layers are elastic; a layer that relaxes is one "
                         "(--layer-thickness)");
    if (b->stack && rc->plane == RB_PLANE_STRESS)
        return rb_refuse(why, "plane", "stress: several layers are in plane strain; leave it out");
    if (b->layer_base == RB_BASE_SMOOTH && (b->stack || b->memory.n > 0))
        return rb_refuse(why, *which ? "layer-base-b" : "layer-base",
                         "smooth: of one elastic layer only");
    return rb_rolling_has_layer(b) && b->base_young > 0.0
               ? rb_rolling_check_poisson(rc, *which ? "base-poisson-b" : "base-poisson",
                                          b->base_poisson, why)
               : RB_OK;
}

static const rb_rolling_parameter layer_parameters[] = {
    {"base-young", rb_rolling_has_layer, "a base has its layer on it, see --layer-thickness"},
    {"base-poisson", rb_rolling_has_layer, "a base has its layer on it, see --layer-thickness"},
    {"layer-base", rb_rolling_has_layer, "a base has its layer on it, see --layer-thickness"},
    {.option = NULL}};

const rb_rolling_body_kind rb_rolling_layer = {.name = "layer",
                                               .support = RB_BEM_HALFPLANE,
                                               .holds = rb_rolling_has_layer,
                                               .can = HALFPLANE | RB_BODY_ELASTIC | RB_BODY_STRESS,
                                               .parameters = layer_parameters,
                                               .check = check_layer};

/* ---- With memory ------------------------------------------------------------------- */

static const rb_rolling_parameter relaxation_parameters[] = {{.option = NULL}};

const rb_rolling_body_kind rb_rolling_relaxation = {.name = "relaxation",
                                                    .support = RB_BEM_HALFPLANE,
                                                    .holds = rb_rolling_has_memory,
                                                    .can = RB_BODY_FLAT | RB_BODY_TURNS |
                                                           RB_BODY_BOUNDARY | RB_BODY_STRESS,
                                                    .parameters = relaxation_parameters};
