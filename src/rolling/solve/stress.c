/* Subsurface stress of body A (B8): closed-form strips on the half-plane, with the waves
 * of its layer (L5), Somigliana's identity on a wheel. */
#include "rolling/solve/results.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_multimin.h>
#include <stdlib.h>
#include <string.h>

enum { GRID_X = 64, GRID_Y = 40, SURFACE_X = 512, SEARCH_STEPS = 100, STARTS = 4, CLIMBS = 3 };
static const double SIZES[CLIMBS] = {0.05, 0.01, 0.002}; /* of simplices, half-widths */
static const double CONVERGED = 1e-6;                    /* size of their last one */

/* Below a layer on a rigid base there is nothing to stress. */
static double deepest(const rb_rolling_case *rc)
{
    return rc->a.layer > 0.0 && rc->a.base_young == 0.0 ? rc->a.layer : INFINITY;
}

double rb_rolling_surface(const rb_rolling_case *rc, double x)
{
    return rb_rolling_body_can(&rc->a, RB_BODY_FLAT) ? 0.0 : rb_bem_circle_height(rc->a.radius, x);
}

/* ---- The field of a solved model --------------------------------------------------- */

typedef struct {
    const rb_rolling_model *model;
    rb_bem_field *wheel;             /* NULL for a half-plane; owned */
    rb_bem_system *made;             /* NULL: that of the model, if any; owned */
    rb_bem_layer_field *layer;       /* NULL: of one material; owned */
    double *nodes;                   /* of a half-plane; owned */
    rb_bem_edge_load linear;         /* the tractions between them */
    double length[RB_ROLLING_TERMS]; /* of its memory, which the layer borrows */
} field;

static void field_free(field *f)
{
    rb_bem_field_free(f->wheel);
    rb_bem_system_free(f->made);
    rb_bem_layer_field_free(f->layer);
    free(f->nodes);
}

rb_status rb_rolling_stress_check(const rb_rolling_case *rc, rb_message *why)
{
    if (!rb_rolling_body_can(&rc->a, RB_BODY_STRESS))
        return rb_fail(why, RB_EINVAL, "stress: inside such a body it is not known");
    /* given tractions make the same stress in a body that relaxes everywhere alike */
    return rc->a.memory.n == 0 || !rb_rolling_has_elastic_core(&rc->a)
               ? RB_OK
               : rb_fail(why, RB_EINVAL,
                         "stress: in a cover that relaxes on an elastic core it depends on "
                         "the past; take a rigid core, or a half-plane with a layer");
}

static const rb_bem_system *system_of(const field *f)
{
    return f->made ? f->made : f->model->bodies.system_a;
}

static rb_status field_create(const rb_rolling_model *model, field *f, rb_message *why)
{
    memset(f, 0, sizeof *f);
    f->model = model;
    rb_status s = rb_rolling_stress_check(model->rc, why);
    if (s == RB_OK && rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT)) {
        /* Constant strips jump in q, which makes sxx infinite at their ends: tractions
         * linear between the midpoints do not, and have the same error of second order. */
        const size_t m = (size_t)model->mesh.n;
        const rb_bem_surface surface = rb_rolling_surface_of(model->rc, &model->rc->a, f->length);
        f->nodes = rb_alloc(m + 2, 3);
        if (!f->nodes)
            return RB_ENOMEM;
        double *x = f->nodes, *p = x + m + 2, *q = p + m + 2;
        x[0] = model->mesh.ends[0];
        x[m + 1] = model->mesh.ends[m];
        for (size_t i = 0; i < m; i++)
            x[i + 1] = 0.5 * (model->mesh.ends[i] + model->mesh.ends[i + 1]);
        memcpy(p + 1, model->state.p, m * sizeof(double));
        memcpy(q + 1, model->state.q, m * sizeof(double));
        f->linear = (rb_bem_edge_load){(int)m + 2, x, p, q};
        return model->rc->a.layer > 0.0
                   ? rb_bem_layer_field_create(&surface, &f->linear, &f->layer, why)
                   : RB_OK;
    }
    if (s == RB_OK && !model->bodies.system_a)
        s = rb_rolling_boundary_system(model, &f->made, why);
    if (s != RB_OK)
        return s;
    double *t = rb_alloc(2 * (size_t)model->mesh.n, 1);
    if (!t)
        return RB_ENOMEM;
    rb_rolling_contact_tractions(model, t);
    s = rb_bem_field_create(system_of(f), t, &f->wheel, why);
    free(t);
    return s;
}

/* A wheel's surface is a polygon: points between it and the circle, which the polygon
 * cuts off, are moved onto it. */
static void lift_onto_polygon(const rb_bem_mesh *mesh, int n, double *xy)
{
    for (int k = 0; k < n; k++) {
        /* The element below x that runs towards +x: on the underside of the wheel. */
        const double x = xy[2 * k];
        int below = -1;
        for (int i = 0; i < mesh->n; i++)
            if (mesh->x0[i] < mesh->x1[i] && mesh->x0[i] <= x && x <= mesh->x1[i] &&
                (below < 0 || mesh->y0[i] < mesh->y0[below]))
                below = i;
        const int j = below;
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
static rb_status evaluate(const field *f, int n, const double *xy, rb_arena *scratch, double *sigma,
                          rb_message *why)
{
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
        rb_status s = rb_bem_halfplane_stress_linear(&f->linear, (rb_bem_points){n, xy}, sigma);
        for (int k = 0; k < n; k++) {
            if (s != RB_OK)
                return s;
            if (hypot(xy[2 * k] - ends[0], xy[2 * k + 1]) > far)
                s = rb_bem_halfplane_stress(&load, (rb_bem_points){1, xy + 2 * k}, sigma + 3 * k);
        }
        return s == RB_OK && f->layer
                   ? rb_bem_layer_field_add(f->layer, (rb_bem_points){n, xy}, sigma, why)
                   : s;
    }
    double *moved = rb_arena_doubles(scratch, (size_t)n, 2);
    if (!moved)
        return RB_ENOMEM;
    memcpy(moved, xy, 2 * (size_t)n * sizeof(double));
    lift_onto_polygon(rb_bem_system_mesh(system_of(f)), n, moved);
    return rb_bem_field_stress(f->wheel, (rb_bem_points){n, moved}, sigma, why);
}

static rb_status stress_of_field(const field *f, int n, const double *xy, rb_rolling_stress *stress,
                                 rb_message *why)
{
    const rb_rolling_case *rc = f->model->rc;
    rb_arena scratch = {0};
    double *sigma = rb_arena_doubles(&scratch, (size_t)n, 3);

    rb_phase("stress inside the body");
    const rb_status status = sigma ? evaluate(f, n, xy, &scratch, sigma, why) : RB_ENOMEM;
    if (status != RB_OK)
        return rb_arena_done(&scratch, status);
    for (int k = 0; k < n; k++) {
        const int below = rc->a.layer > 0.0 && xy[2 * k + 1] > rc->a.layer;
        const double lateral = rc->plane == RB_PLANE_STRESS ? 0.0
                               : below                      ? rc->a.base_poisson
                                                            : rc->a.poisson;
        rb_rolling_stress s = {.x = xy[2 * k],
                               .y = xy[2 * k + 1],
                               .sxx = sigma[3 * k],
                               .syy = sigma[3 * k + 1],
                               .sxy = sigma[3 * k + 2]};
        const double mean = 0.5 * (s.sxx + s.syy);
        s.szz = lateral * (s.sxx + s.syy);
        s.max_shear = hypot(0.5 * (s.sxx - s.syy), s.sxy);
        s.principal_1 = mean + s.max_shear;
        s.principal_2 = mean - s.max_shear;
        s.hydrostatic = (s.sxx + s.syy + s.szz) / 3.0;
        s.von_mises = sqrt(
            0.5 * (gsl_pow_2(s.sxx - s.syy) + gsl_pow_2(s.syy - s.szz) + gsl_pow_2(s.szz - s.sxx)) +
            3.0 * gsl_pow_2(s.sxy));
        stress[k] = s;
    }
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_rolling_stress_at(const rb_rolling_model *model, int n, const double *xy,
                               rb_rolling_stress *stress, rb_message *why)
{
    field f;
    rb_status s =
        n < 1 ? rb_fail(why, RB_EINVAL, "stress: %d points", n) : field_create(model, &f, why);

    if (n < 1)
        return s;
    if (s == RB_OK)
        s = stress_of_field(&f, n, xy, stress, why);
    field_free(&f);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the stress at %d points", n) : s;
}

/* ---- Maxima ------------------------------------------------------------------------ */

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
    double nearly;    /* what a start may have less than the best, of that */
    rb_status status; /* of the evaluations so far */
} search;

static rb_status stress_below(const search *s, double x, double depth, rb_rolling_stress *at)
{
    const double xy[] = {x, rb_rolling_surface(s->f->model->rc, x) + depth};
    return stress_of_field(s->f, 1, xy, at, NULL);
}

/* Outside of low ... high the mirror image: a simplex does not feel the end as a wall, on
 * which it would collapse short of the top. */
static double folded(double x, double low, double high)
{
    const double inside = x < low ? 2.0 * low - x : x > high ? 2.0 * high - x : x;
    return fmin(fmax(inside, low), high);
}

static double place_x(const search *s, const gsl_vector *place)
{
    return folded(gsl_vector_get(place, 0) * s->scale, s->from, s->to);
}

static double place_depth(const search *s, const gsl_vector *place)
{
    return folded(gsl_vector_get(place, 1) * s->scale, 0.0, s->depth);
}

/* Smaller is better. */
static double search_value(const gsl_vector *place, void *context)
{
    search *s = context;
    rb_rolling_stress at;
    const rb_status status = stress_below(s, place_x(s, place), place_depth(s, place), &at);

    if (status == RB_OK)
        return -s->of(&at);
    if (status != RB_EINVAL) /* that is a place in the hub */
        s->status = status;
    return GSL_DBL_MAX;
}

/* Climbs from a place to the top; the simplex points away from the middle, so that mirror
 * images of a stress have mirror images of searches. */
static rb_status climb(search *s, double size, gsl_multimin_fminimizer *m, gsl_vector *place,
                       gsl_vector *step, rb_rolling_extremum *best)
{
    gsl_multimin_function function = {search_value, 2, s};
    rb_rolling_stress at;

    gsl_vector_set(place, 0, best->x / s->scale);
    gsl_vector_set(place, 1, (best->y - rb_rolling_surface(s->f->model->rc, best->x)) / s->scale);
    gsl_vector_set(step, 0, best->x < 0.5 * (s->from + s->to) ? -size : size);
    gsl_vector_set(step, 1, size);
    gsl_multimin_fminimizer_set(m, &function, place, step);
    for (int k = 0; k < SEARCH_STEPS && gsl_multimin_fminimizer_size(m) > CONVERGED; k++)
        gsl_multimin_fminimizer_iterate(m);
    const double depth = place_depth(s, m->x);
    const rb_status status =
        s->status == RB_OK ? stress_below(s, place_x(s, m->x),
                                          /* on the surface, as far as the search can tell */
                                          depth < 10.0 * CONVERGED * s->scale ? 0.0 : depth, &at)
                           : s->status;
    if (status == RB_OK && s->of(&at) > best->value)
        *best = (rb_rolling_extremum){s->of(&at), at.x, at.y};
    return status;
}

/* 1: no neighbour on the grid has more.  Points outside the body are no number. */
static int is_peak(const search *s, const rb_rolling_stress_grid *grid, int k)
{
    const int i = k % grid->nx, j = k / grid->nx;
    for (int v = j - (j > 0); v <= j + (j + 1 < grid->ny); v++)
        for (int u = i - (i > 0); u <= i + (i + 1 < grid->nx); u++)
            if (s->of(&grid->at[v * grid->nx + u]) > s->of(&grid->at[k]))
                return 0;
    return !isnan(s->of(&grid->at[k]));
}

/* Several peaks may be nearly as high, and the highest one of the grid need not have the
 * highest top.  best: of the places looked at before. */
static rb_status maximum(search *s, const rb_rolling_stress_grid *grid, rb_rolling_extremum *best)
{
    rb_status status = RB_OK;
    int peak = -1;
    for (int k = 0; k < STARTS && status == RB_OK; k++) {
        /* The highest peak that is lower than the last one, or behind it. */
        int next = -1;
        for (int j = 0; j < grid->nx * grid->ny; j++) {
            const double here = s->of(&grid->at[j]);
            const double limit = peak < 0 ? INFINITY : s->of(&grid->at[peak]);
            if ((here < limit || (here == limit && j > peak)) &&
                (next < 0 || here > s->of(&grid->at[next])) && is_peak(s, grid, j))
                next = j;
        }
        peak = next;
        const rb_rolling_stress *at = peak < 0 ? NULL : &grid->at[peak];
        if (!at || s->of(at) < best->value - s->nearly * fabs(best->value))
            break;
        rb_rolling_extremum top = {s->of(at), at->x, at->y};
        /* A simplex may collapse short of the top, into a dip between two of its corners: a
         * smaller one goes on from there. */
        gsl_multimin_fminimizer *m =
            gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, 2);
        gsl_vector *place = gsl_vector_alloc(2), *step = gsl_vector_alloc(2);
        status = m && place && step ? RB_OK : RB_ENOMEM;

        for (int i = 0; i < CLIMBS && status == RB_OK &&
                        (i == 0 || gsl_multimin_fminimizer_size(m) > CONVERGED);
             i++)
            status = climb(s, SIZES[i], m, place, step, &top);
        gsl_multimin_fminimizer_free(m);
        gsl_vector_free(place);
        gsl_vector_free(step);
        if (top.value > best->value)
            *best = top;
    }
    return status;
}

/* The box that is looked at under a contact, or a patch of it, between two edges. */
static search box_under(const rb_rolling_model *model, double from, double to, double depth)
{
    const double a = 0.5 * (to - from);
    search box = {.scale = a,
                  .from = from - a,
                  .to = to + a,
                  .depth = depth > 0.0 ? depth : fmin(2.5 * a, deepest(model->rc))};

    if (!rb_rolling_body_can(&model->rc->a, RB_BODY_FLAT)) { /* stay below its own equator */
        const double widest = 0.9 * model->rc->a.radius;
        box.from = fmax(box.from, -widest);
        box.to = fmin(box.to, widest);
    }
    return box;
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
            inside[k] = xy[2 * k + 1] >= 0.0 && xy[2 * k + 1] <= deepest(model->rc);
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
    lift_onto_polygon(&mesh, n, moved);
    for (int k = 0; k < n; k++) {
        /* An odd number of elements lies straight below a point inside. */
        const double x = moved[2 * k], y = moved[2 * k + 1];
        int odd = 0;
        for (int j = 0; j < mesh.n; j++) {
            const double x0 = mesh.x0[j], x1 = mesh.x1[j];
            if ((x0 <= x) != (x1 <= x))
                odd ^= mesh.y0[j] + (x - x0) / (x1 - x0) * (mesh.y1[j] - mesh.y0[j]) <= y;
        }
        inside[k] = y != xy[2 * k + 1] || odd;
    }
    rb_bem_mesh_free(&mesh);
    return rb_arena_done(&scratch, RB_OK);
}

/* Of grid->nx x grid->ny points; the depth of the rows grows like a power.  Free the grid in
 * any case. */
static rb_status make_grid(const field *f, const search *box, int power,
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

    for (int k = 0; k < n; k++) {
        xy[2 * k] = box->from + (box->to - box->from) * (k % grid->nx) / (grid->nx - 1);
        xy[2 * k + 1] = rb_rolling_surface(f->model->rc, xy[2 * k]) +
                        box->depth * gsl_pow_int((double)(k / grid->nx) / (grid->ny - 1), power);
    }
    rb_status s = rb_rolling_inside(f->model, n, xy, grid->inside);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* Keeps the points inside the body, in their order. */
    int m = 0;
    for (int k = 0; k < n; k++)
        if (grid->inside[k]) {
            kept[2 * m] = xy[2 * k];
            kept[2 * m++ + 1] = xy[2 * k + 1];
        }
    s = stress_of_field(f, m, kept, at, why);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* From the m answers back to the places of the grid. */
    m = 0;
    for (int k = 0; k < n; k++)
        if (grid->inside[k])
            grid->at[k] = at[m++];
        else
            grid->at[k] = (rb_rolling_stress){xy[2 * k], xy[2 * k + 1], NAN, NAN, NAN, NAN,
                                              NAN,       NAN,           NAN, NAN, NAN};
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_rolling_stress_on_grid(const rb_rolling_model *model, int nx, int ny, double depth,
                                    rb_rolling_stress_grid *grid, rb_message *why)
{
    double from, to;

    memset(grid, 0, sizeof *grid);
    if (nx < 2 || ny < 2 || (double)nx * ny > 1e8)
        return rb_fail(why, RB_EINVAL, "grid: expected 2 x 2 ... 1e8 points, got %d x %d", nx, ny);
    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    if (!(from < to))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    const search box = box_under(model, from, to, depth);
    field f;
    rb_status s = field_create(model, &f, why);
    if (s == RB_OK) {
        *grid = (rb_rolling_stress_grid){.nx = nx, .ny = ny};
        s = make_grid(&f, &box, 1, grid, why);
    }
    field_free(&f);
    if (s != RB_OK)
        rb_rolling_stress_grid_free(grid);
    return s == RB_ENOMEM
               ? rb_fail(why, s, "out of memory for the stress at %d x %d points", nx, ny)
               : s;
}

/* ---- All maxima -------------------------------------------------------------------- */

enum { MEASURES = 4 };
static measure *const measures[MEASURES] = {max_shear, von_mises, orthogonal_shear, tension};

static rb_rolling_extremum *of_measure(rb_rolling_stress_maxima *m, int k)
{
    rb_rolling_extremum *const all[MEASURES] = {&m->max_shear, &m->von_mises, &m->orthogonal_shear,
                                                &m->tension};
    return all[k];
}

rb_status rb_rolling_stress_maxima_find(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why)
{
    static const double nearly[] = {0.05, 0.002};
    static const int size[][2] = {{GRID_X, GRID_Y}, {SURFACE_X, 2}};
    const rb_rolling_extremum none = {-INFINITY, NAN, NAN};
    rb_rolling_run run = {.last = -1};
    field f = {0};
    rb_status s = field_create(model, &f, why);
    int patches = 0;

    *maxima = (rb_rolling_stress_maxima){none, none, none, none};
    while (s == RB_OK &&
           rb_rolling_next_patch(model->rc, &model->mesh, &model->state, run.last + 1, &run)) {
        search all = box_under(model, run.from, run.to, depth);
        all.f = &f;
        all.depth = fmin(all.depth, deepest(model->rc));
        /* From a grid that is finer where the stress changes faster, and from two rows at
         * the surface, where friction that changes from element to element makes narrow
         * peaks. */
        for (int k = 0; k < 2 && s == RB_OK; k++) {
            rb_rolling_stress_grid grid = {.nx = size[k][0], .ny = size[k][1]};
            search box = all;
            if (k > 0)
                box.depth = all.depth / gsl_pow_2(GRID_Y - 1.0); /* of the first row */
            s = make_grid(&f, &box, 2, &grid, why);
            all.nearly = nearly[k];
            /* Each where it is larger than what was found so far. */
            for (int i = 0; i < MEASURES && s == RB_OK; i++) {
                all.of = measures[i];
                s = maximum(&all, &grid, of_measure(maxima, i));
            }
            rb_rolling_stress_grid_free(&grid);
        }
        patches++;
    }
    field_free(&f);
    if (s == RB_ENOMEM)
        return rb_fail(why, s, "out of memory for the largest stresses");
    return s == RB_OK && patches == 0 ? rb_fail(why, RB_NO_CONTACT, "no contact, no stress") : s;
}

rb_status rb_rolling_stress_maxima_at(const rb_rolling_model *model,
                                      rb_rolling_stress_maxima *maxima, rb_message *why)
{
    double xy[2 * MEASURES];
    rb_rolling_stress at[MEASURES];

    for (int k = 0; k < MEASURES; k++) {
        xy[2 * k] = of_measure(maxima, k)->x;
        xy[2 * k + 1] = of_measure(maxima, k)->y;
    }
    const rb_status s = rb_rolling_stress_at(model, MEASURES, xy, at, why);
    if (s != RB_OK)
        return s;
    for (int k = 0; k < MEASURES; k++)
        of_measure(maxima, k)->value = measures[k](&at[k]);
    return RB_OK;
}
