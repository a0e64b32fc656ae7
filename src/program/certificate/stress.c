/* The stress below the surface again, from the tractions that the result stores: on the same grid
 * or at the same points, with its maxima and its shakedown. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What another place may lack of the largest value, as a part of the largest pressure: a search
 * ends on top of a flat maximum somewhere; a wheel's surface has corners. */
static const double FLAT = 1e-10, CORNERS = 1e-3;
/* A place is searched for until it is known to this part of the half-width; one that is farther
 * away, but not much, is not that of the maximum. */
static const double SEARCHED = 1e-6, NEAR = 1e-3;

/* The body: A, or the image of B, and the sign of y in it. */
typedef struct {
    const rb_rolling_model *model;
    const rb_rolling_solution *solution;
    double up;
} body;

static double slack_of(const body *b)
{
    const int is_flat = rb_rolling_body_can(&b->model->rc->a, RB_BODY_FLAT);
    return (is_flat ? FLAT : CORNERS) * b->solution->max_pressure;
}

/* 1: it is neither the place that was found nor another one. */
static int is_beside(const body *b, double x, double y, double x_found, double y_found)
{
    const double apart = hypot(x - x_found, y - y_found) / b->solution->half_width;
    return apart > SEARCHED && apart < NEAR;
}

/* Given points are taken as they are: a list in one row. */
static rb_status points_again(rb_certificate *c, const json_t *printed, const body *b,
                              rb_rolling_stress_grid *row, rb_message *why)
{
    const int n = (int)json_array_size(json_object_get(printed, "x_mm"));
    double *x = rb_alloc((size_t)n, 4), *y = x ? x + n : NULL, *xy = x ? y + n : NULL;
    rb_status s = x ? RB_OK : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_certificate_list(c, printed, "x_mm", n, x, why);
    if (s == RB_OK)
        s = rb_certificate_list(c, printed, "y_mm", n, y, why);
    if (s == RB_OK && !(row->at = calloc((size_t)n, sizeof *row->at)))
        s = RB_ENOMEM;
    for (int k = 0; k < n && s == RB_OK; k++) {
        xy[2 * k] = x[k];
        xy[2 * k + 1] = b->up * y[k];
    }
    if (s == RB_OK)
        s = rb_rolling_stress_at(b->model, n, xy, row->at, why);
    row->nx = n;
    free(x);
    return s;
}

/* The largest stresses, found again; one that is printed at another place stays there if none is
 * larger: where a maximum is flat or symmetric a search may end at either. */
static rb_status maxima_again(rb_certificate *c, const json_t *printed, double depth, const body *b,
                              rb_rolling_stress_maxima *maxima, rb_message *why)
{
    rb_rolling_stress_maxima there = {.bonds = 0};
    rb_status s = rb_rolling_stress_maxima_find(b->model, depth, maxima, why);

    if (s == RB_OK)
        s = rb_rolling_stress_maxima_alloc(maxima->bonds, &there);
    if (s != RB_OK)
        return s;
    for (int k = 0; rb_rolling_maximum(&there, k); k++) {
        rb_rolling_maximum_result described;
        const json_t *one =
            json_object_get(printed, rb_rolling_describe_maximum(k, 0, 0, &described)->name);
        *rb_rolling_maximum(&there, k) = *rb_rolling_maximum(maxima, k);
        const char *material = rb_certificate_word(one, "material");
        const double x = rb_certificate_stored(c, one, "x"),
                     y = b->up * rb_certificate_stored(c, one, "y"),
                     below = y - rb_rolling_surface(b->model->rc, x);
        rb_rolling_extremum *at = rb_rolling_maximum(&there, k);
        if (!isfinite(x) || !isfinite(y) || (depth > 0.0 && !(below <= depth * (1.0 + 1e-9))) ||
            is_beside(b, x, y, at->x, at->y))
            continue;
        at->x = x;
        at->y = y;
        const int place = rb_rolling_place_named(material);
        at->material = place < 0 ? RB_MATERIAL_BODY : (rb_rolling_place)place;
    }
    rb_message outside;
    s = rb_rolling_stress_maxima_at(b->model, &there, &outside);
    for (int k = 0; rb_rolling_maximum(&there, k) && s == RB_OK; k++)
        if (rb_rolling_maximum(&there, k)->value >=
            rb_rolling_maximum(maxima, k)->value - slack_of(b))
            *rb_rolling_maximum(maxima, k) = *rb_rolling_maximum(&there, k);
    rb_rolling_stress_maxima_free(&there);
    return s == RB_ENOMEM ? s : RB_OK;
}

/* The same of the place that decides on shakedown. */
static rb_status shakedown_again(rb_certificate *c, const json_t *printed, const body *b,
                                 rb_rolling_shakedown *limit, rb_message *why)
{
    rb_status s = rb_rolling_shakedown_find(b->model, limit, why);
    rb_rolling_shakedown there = {.x = rb_certificate_stored(c, printed, "x"),
                                  .y = b->up * rb_certificate_stored(c, printed, "y"),
                                  .residual = rb_certificate_stored(c, printed, "residual")};
    rb_message outside;

    if (s != RB_OK || !isfinite(there.x + there.y + there.residual) ||
        is_beside(b, there.x, there.y, limit->x, limit->y))
        return s;
    s = rb_rolling_shakedown_at(b->model, &there, &outside);
    if (s == RB_OK && fabs(there.shear_yield - limit->shear_yield) <= slack_of(b))
        *limit = there;
    return s == RB_ENOMEM ? s : RB_OK;
}

rb_status rb_certificate_restore_stress(rb_certificate *c, const json_t *root,
                                        const rb_case_result *r, rb_certificate_stress *s,
                                        rb_message *why)
{
    const json_t *grid = json_object_get(root, "grid"),
                 *shakedown = json_object_get(root, "shakedown");
    const double depth = json_number_value(json_object_get(root, "depth")); /* 0: null */
    const int whole = json_is_true(json_object_get(root, "whole"));
    const int of_b = strcmp(rb_certificate_word(root, "body"), "b") == 0;
    rb_rolling_mirror *mirror = NULL;

    memset(s, 0, sizeof *s);
    rb_status status = of_b ? rb_rolling_mirror_create(&r->model, &mirror, why) : RB_OK;
    if (status != RB_OK)
        return status;
    const body b = {mirror ? &mirror->model : &r->model, &r->solution, of_b ? -1.0 : 1.0};
    if (grid) { /* its points follow from its size */
        const double nx = rb_certificate_member(grid, "nx"), ny = rb_certificate_member(grid, "ny");
        const size_t n = json_array_size(json_object_get(grid, "x_mm"));
        status = nx >= 2.0 && ny >= 2.0 && nx * ny == (double)n
                     ? rb_rolling_stress_on_grid(b.model, (int)nx, (int)ny,
                                                 whole ? INFINITY : depth, &s->grid, why)
                     : rb_certificate_refuse(c, "its grid is not nx by ny points", why);
    } else
        status = points_again(c, json_object_get(root, "points"), &b, &s->grid, why);
    if (status == RB_OK)
        status = maxima_again(c, json_object_get(root, "maxima"), depth, &b, &s->maxima, why);
    if (status == RB_OK && shakedown)
        status = shakedown_again(c, shakedown, &b, &s->limit, why);
    rb_rolling_mirror_free(mirror);
    if (status == RB_OK && of_b) {
        if (grid)
            rb_rolling_mirror_grid(&s->grid);
        rb_rolling_mirror_stress(grid ? 0 : s->grid.nx, s->grid.at, &s->maxima);
        s->limit.y = 0.0 - s->limit.y;
    }
    if (status == RB_OK)
        status = rb_rolling_temperature_inside(r->model.rc, &r->solution, of_b,
                                               grid ? s->grid.nx * s->grid.ny : s->grid.nx,
                                               s->grid.at, why);
    s->shown = (rb_report_stress){.of_b = of_b,
                                  .nx = grid ? s->grid.nx : 0,
                                  .ny = s->grid.ny,
                                  .n = grid ? s->grid.nx * s->grid.ny : s->grid.nx,
                                  .whole = whole,
                                  .depth = depth,
                                  .at = s->grid.at,
                                  .maxima = &s->maxima,
                                  .shakedown = shakedown ? &s->limit : NULL,
                                  .yield_shear = rb_certificate_member(shakedown, "yield_shear"),
                                  .rc = r->model.rc,
                                  .s = &r->solution};
    return status;
}

rb_status rb_certificate_restore_given(rb_certificate *c, const json_t *root,
                                       const rb_resolved_case *resolved, rb_case_result *r,
                                       rb_certificate_given *given, rb_message *why)
{
    static const char *const keys[] = {"x_mm", "p_MPa", "q_MPa", "h_mm", "zone"};
    enum { COLUMNS = sizeof keys / sizeof *keys };
    const json_t *stored = json_object_get(root, "tractions");
    const int n = (int)json_array_size(json_object_get(stored, keys[0])),
              columns = json_object_get(stored, "h_mm") ? COLUMNS : 3;
    const uint64_t moving = c->moving;
    rb_message reason = {.text = ""};
    rb_status s = RB_OK;

    if (n < 2)
        return rb_certificate_refuse(c, "its tractions have no rows", why);
    if (!(given->numbers = rb_alloc((size_t)n, COLUMNS)))
        return RB_ENOMEM;
    for (int k = 0; k < columns && s == RB_OK; k++) {
        /* places stay as they are, two at one place are a jump, and so do zones */
        c->moving = k == 1 || k == 2 ? c->moving : 0;
        s = rb_certificate_list(c, stored, keys[k], n, given->numbers + (size_t)k * (size_t)n, why);
        c->moving = c->moving ? c->moving : moving;
    }
    if (s != RB_OK)
        return s;
    const double *at = given->numbers;
    given->rows = (rb_rolling_traction_rows){n,
                                             at,
                                             at + n,
                                             at + 2 * (size_t)n,
                                             columns > 3 ? at + 3 * (size_t)n : NULL,
                                             columns > 3 ? at + 4 * (size_t)n : NULL};
    s = rb_rolling_model_of_rows(&resolved->rc, &given->rows, &r->model, &r->solution, &reason);
    return s == RB_OK || s == RB_ENOMEM ? s : rb_certificate_refuse(c, reason.text, why);
}
