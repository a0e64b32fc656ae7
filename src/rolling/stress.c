/* Subsurface stress of body A (B8): closed-form strips on the half-plane, Somigliana's
 * identity on a wheel. */
#include "rolling/internal.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_multimin.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_X = 64, GRID_Y = 40, SEARCH_STEPS = 200 };

double rb_rolling_surface(const rb_rolling_case *rc, double x)
{
    const double R = rc->a.radius;
    return rc->a.support == RB_BEM_HALFPLANE ? 0.0 : x * x / (R + sqrt(R * R - x * x));
}

/* ---- The field of a solved model ------------------------------------------------------
 */

typedef struct {
    const rb_rolling_model *model;
    double *u, *t; /* boundary values of a wheel; NULL for a half-plane; owned */
} field;

static void field_free(field *f)
{
    free(f->u);
    free(f->t);
}

static rb_status field_create(const rb_rolling_model *model, field *f)
{
    memset(f, 0, sizeof *f);
    f->model = model;
    if (!model->bodies.system_a)
        return RB_OK;
    const size_t n = (size_t)rb_bem_system_mesh(model->bodies.system_a)->n;
    f->u = rb_alloc(n, 2);
    f->t = rb_alloc(n, 2);
    return f->u && f->t ? rb_rolling_boundary_values(model, f->u, f->t) : RB_ENOMEM;
}

/* The element below x that runs towards +x: on the underside of the wheel. */
static int element_below(const rb_bem_mesh *mesh, double x)
{
    int below = -1;
    for (int j = 0; j < mesh->n; j++)
        if (mesh->x0[j] <= x && x <= mesh->x1[j] && mesh->x0[j] < mesh->x1[j] &&
            (below < 0 || mesh->y0[j] < mesh->y0[below]))
            below = j;
    return below;
}

/* A wheel's surface is a polygon: points between it and the circle, which the polygon
 * cuts off, are moved onto it. */
static void lift_onto_polygon(const rb_bem_mesh *mesh, int n, double *xy)
{
    for (int k = 0; k < n; k++) {
        const int j = element_below(mesh, xy[2 * k]);
        if (j < 0)
            continue;
        const double width = mesh->x1[j] - mesh->x0[j];
        const double s = (xy[2 * k] - mesh->x0[j]) / width;
        const double y = mesh->y0[j] + s * (mesh->y1[j] - mesh->y0[j]);
        if (xy[2 * k + 1] < y && y - xy[2 * k + 1] < 0.1 * width)
            xy[2 * k + 1] = y;
    }
}

/* sxx, syy, sxy at each point. */
static rb_status evaluate(const field *f, int n, const double *xy, double *sigma,
                          rb_message *why)
{
    const rb_rolling_model *model = f->model;

    if (!f->u) {
        for (int k = 0; k < n; k++)
            if (!(xy[2 * k + 1] >= 0.0))
                return rb_fail(why, RB_EINVAL,
                               "point %d at (%g, %g) lies above the surface", k + 1,
                               xy[2 * k], xy[2 * k + 1]);
        return rb_bem_halfplane_stress(model->mesh.n, model->mesh.ends, model->state.p,
                                       model->state.q, n, xy, sigma);
    }
    double *moved = rb_alloc((size_t)n, 2);
    if (!moved)
        return RB_ENOMEM;
    const rb_bem_mesh *mesh = rb_bem_system_mesh(model->bodies.system_a);
    memcpy(moved, xy, 2 * (size_t)n * sizeof(double));
    lift_onto_polygon(mesh, n, moved);
    const rb_status s = rb_bem_interior(
        mesh, rb_bem_material_from_young(model->rc.a.young, model->rc.a.poisson), f->u,
        f->t, n, moved, NULL, sigma, why);
    free(moved);
    return s;
}

static rb_rolling_stress derive(double x, double y, const double *sigma, double poisson)
{
    rb_rolling_stress s = {
        .x = x, .y = y, .sxx = sigma[0], .syy = sigma[1], .sxy = sigma[2]};
    const double mean = 0.5 * (s.sxx + s.syy);

    s.szz = poisson * (s.sxx + s.syy);
    s.max_shear = hypot(0.5 * (s.sxx - s.syy), s.sxy);
    s.principal_1 = mean + s.max_shear;
    s.principal_2 = mean - s.max_shear;
    s.hydrostatic = (s.sxx + s.syy + s.szz) / 3.0;
    s.von_mises = sqrt(0.5 * (gsl_pow_2(s.sxx - s.syy) + gsl_pow_2(s.syy - s.szz) +
                              gsl_pow_2(s.szz - s.sxx)) +
                       3.0 * gsl_pow_2(s.sxy));
    return s;
}

static rb_status stress_of_field(const field *f, int n, const double *xy,
                                 rb_rolling_stress *stress, rb_message *why)
{
    double *sigma = rb_alloc((size_t)n, 3);
    if (!sigma)
        return RB_ENOMEM;
    const rb_status s = evaluate(f, n, xy, sigma, why);
    for (int k = 0; k < n && s == RB_OK; k++)
        stress[k] =
            derive(xy[2 * k], xy[2 * k + 1], sigma + 3 * k, f->model->rc.a.poisson);
    free(sigma);
    return s;
}

rb_status rb_rolling_stress_at(const rb_rolling_model *model, int n, const double *xy,
                               rb_rolling_stress *stress, rb_message *why)
{
    field f;
    rb_status s =
        n < 1 ? rb_fail(why, RB_EINVAL, "stress: %d points", n) : field_create(model, &f);

    if (n < 1)
        return s;
    if (s == RB_OK)
        s = stress_of_field(&f, n, xy, stress, why);
    field_free(&f);
    return s == RB_ENOMEM ? rb_fail(why, s, "no memory for the stress at %d points", n)
                          : s;
}

/* ---- Maxima
 * ------------------------------------------------------------------------------ */

typedef double measure(const rb_rolling_stress *s);

static double max_shear(const rb_rolling_stress *s)
{
    return s->max_shear;
}

static double von_mises(const rb_rolling_stress *s)
{
    return s->von_mises;
}

static double orthogonal_shear(const rb_rolling_stress *s)
{
    return fabs(s->sxy);
}

static double tension(const rb_rolling_stress *s)
{
    return s->principal_1;
}

/* A search for the place (x, y) of a maximum within the box below the surface. */
typedef struct {
    const field *f;
    measure *of;
    double scale; /* half-width: unit of the search */
    double from, to, depth;
    rb_status status; /* of the evaluations so far */
} search;

static rb_status stress_below(const search *s, double x, double depth,
                              rb_rolling_stress *at)
{
    const double xy[] = {x, rb_rolling_surface(&s->f->model->rc, x) + depth};
    return stress_of_field(s->f, 1, xy, at, NULL);
}

/* Smaller is better; outside the box the nearest point of it counts. */
static double search_value(const gsl_vector *place, void *context)
{
    search *s = context;
    const double x = gsl_vector_get(place, 0) * s->scale;
    const double depth = gsl_vector_get(place, 1) * s->scale;
    const double inside_x = fmin(fmax(x, s->from), s->to);
    const double inside_depth = fmin(fmax(depth, 0.0), s->depth);
    rb_rolling_stress at;

    const rb_status status = stress_below(s, inside_x, inside_depth, &at);
    if (status != RB_OK) {
        s->status = status;
        return GSL_DBL_MAX;
    }
    const double away = hypot(x - inside_x, depth - inside_depth) / s->scale;
    return -s->of(&at) * (1.0 - away);
}

static rb_status refine(search *s, rb_rolling_extremum *best)
{
    const double surface = rb_rolling_surface(&s->f->model->rc, best->x);
    gsl_multimin_fminimizer *m =
        gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
    gsl_vector *start = gsl_vector_alloc(2), *step = gsl_vector_alloc(2);
    gsl_multimin_function function = {search_value, 2, s};
    rb_status status = m && start && step ? RB_OK : RB_ENOMEM;

    if (status == RB_OK) {
        gsl_vector_set(start, 0, best->x / s->scale);
        gsl_vector_set(start, 1, (best->y - surface) / s->scale);
        gsl_vector_set_all(step, 0.05);
        gsl_multimin_fminimizer_set(m, &function, start, step);
        for (int k = 0; k < SEARCH_STEPS && gsl_multimin_fminimizer_size(m) > 1e-6; k++)
            if (gsl_multimin_fminimizer_iterate(m))
                break;
        const double x = fmin(fmax(gsl_vector_get(m->x, 0) * s->scale, s->from), s->to);
        const double depth =
            fmin(fmax(gsl_vector_get(m->x, 1) * s->scale, 0.0), s->depth);
        rb_rolling_stress at;
        status = s->status == RB_OK ? stress_below(s, x, depth, &at) : s->status;
        if (status == RB_OK && s->of(&at) > best->value)
            *best = (rb_rolling_extremum){s->of(&at), at.x, at.y};
    }
    if (m)
        gsl_multimin_fminimizer_free(m);
    if (start)
        gsl_vector_free(start);
    if (step)
        gsl_vector_free(step);
    return status;
}

static rb_status maximum(search *s, const rb_rolling_stress *grid,
                         rb_rolling_extremum *best)
{
    *best = (rb_rolling_extremum){-INFINITY, NAN, NAN};
    for (int k = 0; k < GRID_X * GRID_Y; k++)
        if (s->of(&grid[k]) > best->value)
            *best = (rb_rolling_extremum){s->of(&grid[k]), grid[k].x, grid[k].y};
    return refine(s, best);
}

static void grid_points(const search *s, double *xy)
{
    for (int j = 0; j < GRID_Y; j++)
        for (int i = 0; i < GRID_X; i++, xy += 2) {
            xy[0] = s->from + (s->to - s->from) * i / (GRID_X - 1);
            xy[1] = rb_rolling_surface(&s->f->model->rc, xy[0]) +
                    s->depth * gsl_pow_2((double)j / (GRID_Y - 1));
        }
}

static rb_status all_maxima(search *s, rb_rolling_stress_maxima *maxima, rb_message *why)
{
    measure *const measures[] = {max_shear, von_mises, orthogonal_shear, tension};
    rb_rolling_extremum *const results[] = {&maxima->max_shear, &maxima->von_mises,
                                            &maxima->orthogonal_shear, &maxima->tension};
    const size_t points = GRID_X * GRID_Y;
    double *xy = rb_alloc(points, 2);
    rb_rolling_stress *grid = calloc(points, sizeof *grid);
    rb_status status = xy && grid ? RB_OK : RB_ENOMEM;

    if (status == RB_OK) {
        grid_points(s, xy);
        status = stress_of_field(s->f, (int)points, xy, grid, why);
    }
    for (int k = 0; k < 4 && status == RB_OK; k++) {
        s->of = measures[k];
        status = maximum(s, grid, results[k]);
    }
    free(xy);
    free(grid);
    return status;
}

rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why)
{
    field f;
    double from, to;
    rb_status s = field_create(model, &f);

    rb_rolling_contact_edges(&model->mesh, model->state.p, &from, &to);
    const double a = 0.5 * (to - from);
    search box = {.f = &f,
                  .scale = a,
                  .from = from - a,
                  .to = to + a,
                  .depth = depth > 0.0 ? depth : 2.5 * a};
    if (s == RB_OK && f.u) { /* a wheel: stay below its own equator */
        const double widest = 0.9 * model->rc.a.radius;
        box.from = fmax(box.from, -widest);
        box.to = fmin(box.to, widest);
    }
    if (s == RB_OK && !(a > 0.0))
        s = rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    if (s == RB_OK)
        s = all_maxima(&box, maxima, why);
    field_free(&f);
    return s;
}
