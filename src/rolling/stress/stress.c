/* Subsurface stress of body A (B8): closed-form strips on the half-plane, with the waves
 * of its layer (L5), waves around a cover (B20), Somigliana's identity on a wheel. */
#include "rolling/body/internal.h"
#include "rolling/body/surface.h"
#include "rolling/results/columns.h"
#include "rolling/stress/field.h"
#include "rolling/solve/model.h"

#include <gsl/gsl_math.h>
#include <stdlib.h>
#include <string.h>

/* Below a layer on a rigid base there is nothing to stress. */
static double deepest_stressed(const rb_rolling_case *rc)
{
    return rc->a.layer > 0.0 && rc->a.base_young == 0.0 ? rb_rolling_layers_depth(&rc->a)
                                                        : INFINITY;
}

double rb_rolling_surface(const rb_rolling_case *rc, double x)
{
    return rb_rolling_body_can(&rc->a, RB_BODY_FLAT) ? 0.0 : rb_bem_circle_height(rc->a.radius, x);
}

/* ---- The field of a solved model --------------------------------------------------- */

struct rb_rolling_field {
    const rb_rolling_model *model;
    rb_bem_field *wheel;             /* NULL for a half-plane; owned */
    rb_bem_system *made;             /* NULL: that of the model, if any; owned */
    rb_bem_layer_field *layer;       /* NULL: of one material; owned */
    rb_bem_ring_field *ring;         /* of a cover; owned */
    rb_bem_edge_load nodes;          /* the tractions, linear between them; in memory */
    rb_bem_edge_load arc;            /* of a cover: they along its circle */
    double length[RB_ROLLING_TERMS]; /* of its memory, which the layer borrows */
    rb_arena memory;
};

void rb_rolling_field_free(rb_rolling_field *f)
{
    if (!f)
        return;
    rb_bem_field_free(f->wheel);
    rb_bem_system_free(f->made);
    rb_bem_layer_field_free(f->layer);
    rb_bem_ring_field_free(f->ring);
    rb_arena_free(&f->memory);
    free(f);
}

rb_status rb_rolling_stress_check(const rb_rolling_case *rc, rb_message *why)
{
    if (!rb_rolling_body_can(&rc->a, RB_BODY_STRESS))
        return rb_fail(why, RB_EINVAL, "stress: inside such a body it is not known");
    if (rc->period > 0.0)
        return rb_fail(why, RB_EINVAL,
                       "stress: below contacts that repeat themselves it is not computed; take one "
                       "contact alone, without --period");
    /* given tractions make the same stress in a body that relaxes everywhere alike */
    return rc->a.memory.n == 0 || !rb_rolling_has_elastic_core(&rc->a)
               ? RB_OK
               : rb_fail(why, RB_EINVAL,
                         "stress: in a cover that relaxes on an elastic core it depends on "
                         "the past; take a rigid core, or a half-plane with a layer");
}

static const rb_bem_system *system_of(const rb_rolling_field *f)
{
    return f->made ? f->made : f->model->bodies.system_a;
}

/* The tractions of a half-plane as nodes between which they are linear (B14), and the waves of its
 * layer (L5). */
static rb_status create_flat(rb_rolling_field *f, rb_message *why)
{
    const rb_rolling_model *model = f->model;
    const rb_bem_surface surface = rb_rolling_surface_of(model->rc, &model->rc->a, f->length);
    rb_status s = RB_OK;
    if (model->given)
        f->nodes = model->given->load;
    else
        s = rb_rolling_traction_nodes(model->rc, &model->mesh, &model->state, model->mesh.ends,
                                      model->state.p, model->state.q, RB_ROLLING_EDGE_NODES,
                                      &f->memory, &f->nodes);
    return s == RB_OK && model->rc->a.layer > 0.0
               ? rb_bem_layer_field_create(&surface, &f->nodes, &f->layer, why)
               : s;
}

/* By waves, along the circle; then the nodes are kept by their x. */
static rb_status create_cover(rb_rolling_field *f, rb_message *why)
{
    const rb_rolling_model *model = f->model;
    const double radius = model->rc->a.radius;
    const rb_bem_wheel wheel = rb_rolling_wheel_of(model->rc, &model->rc->a, f->length);
    const size_t n = (size_t)model->mesh.n;
    double *t = rb_arena_doubles(&f->memory, n, 2), *p = rb_arena_doubles(&f->memory, n, 1),
           *q = rb_arena_doubles(&f->memory, n, 1), *ends = rb_arena_doubles(&f->memory, n + 1, 1);
    if (f->memory.failed)
        return RB_ENOMEM;
    rb_rolling_contact_tractions(model, t);
    for (size_t i = 0; i <= n; i++)
        ends[i] = radius * asin(model->mesh.ends[i] / radius);
    for (size_t i = 0; i < n; i++) {
        /* From x and y to the normal and the tangent of the circle at the midpoint. */
        const double angle = 0.5 * (ends[i] + ends[i + 1]) / radius, x = cos(angle), y = sin(angle);
        q[i] = x * t[2 * i] + y * t[2 * i + 1];
        p[i] = x * t[2 * i + 1] - y * t[2 * i];
    }
    rb_status s = rb_rolling_traction_nodes(model->rc, &model->mesh, &model->state, ends, p, q,
                                            RB_ROLLING_EDGE_NODES, &f->memory, &f->arc);
    if (s == RB_OK)
        s = rb_bem_ring_field_create(&wheel, &f->arc, &f->ring, why);
    double *x = rb_arena_doubles(&f->memory, (size_t)f->arc.n, 1);
    for (int k = 0; x && k < f->arc.n; k++)
        x[k] = radius * sin(f->arc.x[k] / radius);
    f->nodes = f->arc;
    f->nodes.x = x;
    return s == RB_OK && !x ? RB_ENOMEM : s;
}

/* Along the contour, on which each element has its own normal and tangent; then the nodes
 * are kept by their x. */
static rb_status create_wheel(rb_rolling_field *f, rb_message *why)
{
    const rb_rolling_model *model = f->model;
    rb_status s =
        model->bodies.system_a ? RB_OK : rb_rolling_boundary_system(model, 0, 0, &f->made, why);
    if (s != RB_OK)
        return s;
    const rb_bem_mesh *mesh = rb_bem_system_mesh(system_of(f));
    const size_t n = (size_t)model->mesh.n;
    double *t = rb_arena_doubles(&f->memory, n, 2), *p = rb_arena_doubles(&f->memory, n, 1),
           *q = rb_arena_doubles(&f->memory, n, 1), *ends = rb_arena_doubles(&f->memory, n + 1, 1);
    if (f->memory.failed)
        return RB_ENOMEM;
    rb_rolling_contact_tractions(model, t);
    ends[0] = 0.0;
    for (size_t i = 0; i < n; i++) {
        const int j = mesh->contact_first + (int)i;
        const double h = rb_bem_mesh_length(mesh, j), x = (mesh->x1[j] - mesh->x0[j]) / h,
                     y = (mesh->y1[j] - mesh->y0[j]) / h;
        q[i] = x * t[2 * i] + y * t[2 * i + 1];
        p[i] = x * t[2 * i + 1] - y * t[2 * i];
        ends[i + 1] = ends[i] + h;
    }
    s = rb_rolling_traction_nodes(model->rc, &model->mesh, &model->state, ends, p, q,
                                  RB_ROLLING_EDGE_NODES, &f->memory, &f->nodes);
    if (s == RB_OK)
        s = rb_bem_field_create(system_of(f), &f->nodes, &f->wheel, why);
    double *x = rb_arena_doubles(&f->memory, (size_t)f->nodes.n, 1);
    for (int k = 0, i = 0; x && k < f->nodes.n; k++) {
        while (i + 1 < (int)n && f->nodes.x[k] > ends[i + 1])
            i++;
        const double part = (f->nodes.x[k] - ends[i]) / (ends[i + 1] - ends[i]);
        x[k] = model->mesh.ends[i] + part * (model->mesh.ends[i + 1] - model->mesh.ends[i]);
    }
    f->nodes.x = x;
    return s == RB_OK && !x ? RB_ENOMEM : s;
}

rb_status rb_rolling_field_create(const rb_rolling_model *model, rb_rolling_field **field,
                                  rb_message *why)
{
    *field = NULL;
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s != RB_OK)
        return s;
    rb_rolling_field *f = calloc(1, sizeof *f);
    if (!f)
        return RB_ENOMEM;
    f->model = model;
    /* The way in which stress is known depends on the body: closed form, waves around a cover, or
     * Somigliana's identity. */
    s = (rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT)                  ? create_flat
         : model->rc->a.cover > RB_BEM_RING_THINNEST * model->rc->a.radius ? create_cover
                                                                           : create_wheel)(f, why);
    if (s == RB_OK)
        *field = f;
    else
        rb_rolling_field_free(f);
    return s;
}

const rb_bem_edge_load *rb_rolling_field_load(const rb_rolling_field *f)
{
    return &f->nodes;
}

/* A wheel's contours are polygons: points between its outer one and the circle, which the
 * polygon cuts off, are moved onto it, and those next to it, such as y = 0 under a contact. */
static void lift_onto_polygon(const rb_bem_mesh *mesh, double radius, int n, double *xy)
{
    for (int k = 0; k < n; k++)
        for (int j = 0; j < mesh->n; j++) {
            /* The element of the outer contour, which runs counter-clockwise, that the ray
             * from the centre (0, R) through the point meets. */
            const double x0 = mesh->x0[j], y0 = mesh->y0[j], x = xy[2 * k], y = xy[2 * k + 1];
            const double dx = mesh->x1[j] - x0, dy = mesh->y1[j] - y0;
            const double from = x0 * (y - radius) - (y0 - radius) * x,
                         to = x * (y0 + dy - radius) - (y - radius) * (x0 + dx);
            if (!(from >= 0.0 && to >= 0.0))
                continue;
            const double h = hypot(dx, dy), inwards = ((y - y0) * dx - (x - x0) * dy) / h;
            const double square = radius * radius, a = 0.5 * h,
                         b = ((x - x0) * dx + (y - y0) * dy) / h - a;
            const double cut_off =
                (a - b) * (a + b) / (sqrt(square - b * b) + sqrt(square - a * a));
            if (inwards < 0.0 &&
                -inwards <= fmax(cut_off * (1.0 + 1e-9), fmin(0.1 * h, 1e-3 * radius))) {
                xy[2 * k] += inwards * dy / h;
                xy[2 * k + 1] -= inwards * dx / h;
            }
            break;
        }
}

/* sxx, syy, sxy at each point. */
static rb_status evaluate_stress(const rb_rolling_field *f, int n, const double *xy,
                                 rb_arena *scratch, double *sigma, rb_message *why)
{
    if (f->ring)
        return rb_bem_ring_field_stress(f->ring, (rb_bem_points){n, xy}, sigma, why);
    if (!f->wheel) {
        for (int k = 0; k < n; k++)
            if (!(xy[2 * k + 1] >= 0.0))
                return rb_fail(why, RB_EINVAL, "point %d at (%g, %g) lies outside the body", k,
                               xy[2 * k], xy[2 * k + 1]);
        /* Far away the strips keep more digits. */
        const rb_rolling_model *model = f->model;
        const double *ends = model->mesh.ends;
        const double width = ends[model->mesh.n] - ends[0], far = 20.0 * width;
        const rb_bem_edge_load load = {model->mesh.n, ends, model->state.p, model->state.q};
        rb_status s = rb_bem_halfplane_stress_linear(&f->nodes, (rb_bem_points){n, xy}, sigma);
        for (int k = 0; k < n; k++) {
            if (s != RB_OK)
                return s;
            if (!model->given && hypot(xy[2 * k] - ends[0], xy[2 * k + 1]) > far)
                s = rb_bem_halfplane_stress(&load, (rb_bem_points){1, xy + 2 * k}, sigma + 3 * k);
        }
        if (s == RB_OK && f->layer)
            s = rb_bem_layer_field_add(f->layer, (rb_bem_points){n, xy}, sigma, why);
        for (int k = 0; k < n && s == RB_OK && model->given; k++)
            if (xy[2 * k + 1] == 0.0)
                rb_rolling_given_on_jump(model, xy[2 * k], sigma + 3 * k);
        return s;
    }
    double *moved = rb_arena_doubles(scratch, (size_t)n, 2);
    if (!moved)
        return RB_ENOMEM;
    memcpy(moved, xy, 2 * (size_t)n * sizeof(double));
    lift_onto_polygon(rb_bem_system_mesh(system_of(f)), f->model->rc->a.radius, n, moved);
    return rb_bem_field_stress(f->wheel, (rb_bem_points){n, moved}, sigma, why);
}

rb_status rb_rolling_field_at(const rb_rolling_field *f, int n, const double *xy,
                              rb_rolling_stress *stress, rb_message *why)
{
    const rb_rolling_case *rc = f->model->rc;
    rb_arena scratch = {0};
    double *sigma = rb_arena_doubles(&scratch, (size_t)n, 3);

    rb_phase("stress inside the body");
    const rb_status status = sigma ? evaluate_stress(f, n, xy, &scratch, sigma, why) : RB_ENOMEM;
    if (status != RB_OK)
        return rb_arena_done(&scratch, status);
    for (int k = 0; k < n; k++) {
        /* Plane strain: szz = nu (sxx + syy), with nu of the material at this depth; plane stress:
         * 0. */
        const double lateral =
            rc->plane == RB_PLANE_STRESS ? 0.0 : rb_rolling_poisson_at(&rc->a, xy[2 * k + 1]);
        rb_rolling_stress s = {.x = xy[2 * k],
                               .y = xy[2 * k + 1],
                               .sxx = sigma[3 * k] + rc->bulk_stress,
                               .syy = sigma[3 * k + 1],
                               .sxy = sigma[3 * k + 2]};
        const double mean = 0.5 * (s.sxx + s.syy);
        s.szz = lateral * (s.sxx + s.syy);
        s.max_shear = hypot(0.5 * (s.sxx - s.syy), s.sxy);
        s.principal_1 = mean + s.max_shear;
        s.principal_2 = mean - s.max_shear;
        /* szz is the third principal stress. */
        s.tresca_shear = 0.5 * (fmax(s.principal_1, s.szz) - fmin(s.principal_2, s.szz));
        s.hydrostatic = (s.sxx + s.syy + s.szz) / 3.0;
        /* in units of the shear, whose square may underflow */
        int unit;
        frexp(s.tresca_shear, &unit);
        const double one = ldexp(1.0, unit), x_y = (s.sxx - s.syy) / one,
                     y_z = (s.syy - s.szz) / one, z_x = (s.szz - s.sxx) / one;
        s.von_mises = one * sqrt(0.5 * (gsl_pow_2(x_y) + gsl_pow_2(y_z) + gsl_pow_2(z_x)) +
                                 3.0 * gsl_pow_2(s.sxy / one));
        stress[k] = s;
    }
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_rolling_stress_at(const rb_rolling_model *model, int n, const double *xy,
                               rb_rolling_stress *stress, rb_message *why)
{
    rb_rolling_field *f;
    if (n < 1)
        return rb_fail(why, RB_EINVAL, "stress: %d points", n);
    rb_status s = rb_rolling_field_create(model, &f, why);
    if (s == RB_OK)
        s = rb_rolling_field_at(f, n, xy, stress, why);
    rb_rolling_field_free(f);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the stress at %d points", n) : s;
}

/* ---- Grid -------------------------------------------------------------------------- */

void rb_rolling_stress_grid_free(rb_rolling_stress_grid *grid)
{
    free(grid->at);
    free(grid->inside);
    memset(grid, 0, sizeof *grid);
}

rb_status rb_rolling_inside(const rb_rolling_model *model, int n, const double *xy, int *inside)
{
    if (rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT)) {
        for (int k = 0; k < n; k++)
            inside[k] = xy[2 * k + 1] >= 0.0 && xy[2 * k + 1] <= deepest_stressed(model->rc) &&
                        !(xy[2 * k + 1] == 0.0 && rb_rolling_friction_jumps_at(model, xy[2 * k]));
        return RB_OK;
    }
    rb_arena scratch = {0};
    double *moved = rb_arena_doubles(&scratch, (size_t)n, 2);
    rb_bem_mesh mesh = {0};
    const rb_status s = moved ? rb_rolling_boundary_mesh(model, 0, &mesh, NULL) : RB_ENOMEM;
    if (s != RB_OK) {
        rb_bem_mesh_free(&mesh);
        return rb_arena_done(&scratch, s);
    }
    memcpy(moved, xy, 2 * (size_t)n * sizeof(double));
    lift_onto_polygon(&mesh, model->rc->a.radius, n, moved);
    const double rounding = 1e-12 * model->rc->a.radius;
    for (int k = 0; k < n; k++) {
        /* An odd number of elements lies straight below a point inside; the end of an element, on
         * whose side rounding would decide, belongs to the body. */
        const double x = moved[2 * k], y = moved[2 * k + 1];
        int odd = 0, is_end = 0;
        for (int j = 0; j < mesh.n; j++) {
            const double x0 = mesh.x0[j], x1 = mesh.x1[j];
            is_end |= hypot(x - x0, y - mesh.y0[j]) <= rounding;
            if ((x0 <= x) != (x1 <= x))
                odd ^= mesh.y0[j] + (x - x0) / (x1 - x0) * (mesh.y1[j] - mesh.y0[j]) <= y;
        }
        inside[k] = x != xy[2 * k] || y != xy[2 * k + 1] || odd || is_end;
    }
    rb_bem_mesh_free(&mesh);
    return rb_arena_done(&scratch, RB_OK);
}

static rb_rolling_stress nothing_at(double x, double y)
{
    return (rb_rolling_stress){x, y, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
}

/* Under the contact between two edges and half as wide on either side of it, nx x ny points
 * down to the depth. */
static void place_below_contact(const rb_rolling_case *rc, double from, double to, double depth,
                                int nx, int ny, double *xy)
{
    /* a wheel's grid stays below its own equator */
    const double a = 0.5 * (to - from),
                 widest = rb_rolling_body_can(&rc->a, RB_BODY_FLAT) ? INFINITY : 0.9 * rc->a.radius,
                 left = fmax(from - a, -widest), right = fmin(to + a, widest),
                 deepest = depth > 0.0 ? depth : fmin(2.5 * a, deepest_stressed(rc));

    for (int k = 0; k < nx * ny; k++) {
        xy[2 * k] = left + (right - left) * (k % nx) / (nx - 1);
        xy[2 * k + 1] = rb_rolling_surface(rc, xy[2 * k]) + deepest * ((double)(k / nx) / (ny - 1));
    }
}

/* Around the whole wheel, ny circles of nx points from its surface to its centre, its hub or the
 * bond of its cover: closer to each other at the surface, and there at the contact and at the
 * support, where the stress changes most. */
static void place_around_wheel(const rb_rolling_body *a, int nx, int ny, double *xy)
{
    const double R = a->radius, CLOSER = 0.9;
    const double thickness = a->cover > 0.0             ? a->cover
                             : a->support == RB_BEM_HUB ? R * (1.0 - a->hub_ratio)
                                                        : R;

    for (int k = 0; k < nx * ny; k++) {
        const double part = 2.0 * (k % nx) / (nx - 1) - 1.0, inwards = (double)(k / nx) / (ny - 1),
                     angle = M_PI * part - 0.5 * CLOSER * sin(2.0 * M_PI * part),
                     depth = thickness * inwards * inwards;
        xy[2 * k] = (R - depth) * sin(angle) + 0.0;                                 /* no -0 */
        xy[2 * k + 1] = depth * cos(angle) + 2.0 * R * gsl_pow_2(sin(0.5 * angle)); /* (B9) */
    }
}

/* Free the grid in any case. */
static rb_status make_grid(const rb_rolling_model *model, double from, double to, double depth,
                           rb_rolling_stress_grid *grid, rb_message *why)
{
    const int n = grid->nx * grid->ny;
    rb_arena scratch = {0};
    double *xy = rb_arena_doubles(&scratch, (size_t)n, 2),
           *kept = rb_arena_doubles(&scratch, (size_t)n, 2);
    rb_rolling_stress *at = rb_arena_zeros(&scratch, (size_t)n, sizeof *at);
    grid->at = calloc((size_t)n, sizeof *grid->at);
    grid->inside = rb_alloc_int((size_t)n);
    if (scratch.failed || !grid->at || !grid->inside)
        return rb_arena_done(&scratch, RB_ENOMEM);

    if (isinf(depth))
        place_around_wheel(&model->rc->a, grid->nx, grid->ny, xy);
    else
        place_below_contact(model->rc, from, to, depth, grid->nx, grid->ny, xy);
    rb_status s = rb_rolling_inside(model, n, xy, grid->inside);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* Keeps the points inside the body, in their order. */
    int m = 0;
    for (int k = 0; k < n; k++)
        if (grid->inside[k]) {
            kept[2 * m] = xy[2 * k];
            kept[2 * m++ + 1] = xy[2 * k + 1];
        }
    s = rb_rolling_stress_at(model, m, kept, at, why);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* From the m answers back to the places of the grid. */
    m = 0;
    for (int k = 0; k < n; k++)
        if (grid->inside[k])
            grid->at[k] = at[m++];
        else
            grid->at[k] = nothing_at(xy[2 * k], xy[2 * k + 1]);
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_rolling_stress_on_grid(const rb_rolling_model *model, int nx, int ny, double depth,
                                    rb_rolling_stress_grid *grid, rb_message *why)
{
    double from, to;

    memset(grid, 0, sizeof *grid);
    if (nx < 2 || ny < 2 || (double)nx * ny > 1e8)
        return rb_fail(why, RB_EINVAL, "grid: expected 2 x 2 ... 1e8 points, got %d x %d", nx, ny);
    if (isinf(depth) && rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT))
        return rb_fail(why, RB_EINVAL,
                       "grid: a half-plane has no end that a grid could reach; give a depth");
    rb_rolling_loaded_between(model, &from, &to);
    if (!(from < to))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    *grid = (rb_rolling_stress_grid){.nx = nx, .ny = ny};
    const rb_status s = make_grid(model, from, to, depth, grid, why);
    if (s != RB_OK)
        rb_rolling_stress_grid_free(grid);
    return s == RB_ENOMEM
               ? rb_fail(why, s, "out of memory for the stress at %d x %d points", nx, ny)
               : s;
}
