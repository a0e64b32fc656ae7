/* The certificate of the stress below the surface: from the tractions that the result
 * prints, at the same points. */
#include "program/certificate/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What a better place may have more of, of the largest pressure: a search ends on top of
 * a flat maximum somewhere; a wheel's surface has corners. */
static double search_slack(const rb_certificate *c)
{
    const int is_flat = rb_rolling_body_can(&c->model.rc->a, RB_BODY_FLAT);
    return (is_flat ? 1e-6 : 1e-3) * c->again.max_pressure;
}

/* A wheel's stress next to its surface magnifies the rounding of the ends of elements,
 * and an approximated matrix has other digits for other ends. */
static double slack_of_stress(const rb_certificate *c, const char *path, double want)
{
    const char *key = rb_certificate_last(path);
    const double most = c->again.max_pressure;
    if (strcmp(key, "x_mm") == 0 || strcmp(key, "y_mm") == 0)
        return 1e-12 * c->again.half_width;
    return 1e-9 * fabs(want) + most * (c->hierarchical                                      ? 1e-5
                                       : rb_rolling_body_can(&c->model.rc->a, RB_BODY_FLAT) ? 1e-12
                                                                                            : 1e-7);
}

/* Given points are taken as they are: a list in one row. */
static rb_status points_again(rb_certificate *c, const json_t *printed, rb_rolling_stress_grid *row,
                              rb_message *why)
{
    const int n = (int)json_array_size(json_object_get(printed, "x_mm"));
    double *x = rb_alloc((size_t)n, 4), *y = x ? x + n : NULL, *xy = x ? y + n : NULL;
    rb_status s = x ? RB_OK : RB_ENOMEM;

    if (s == RB_OK)
        s = rb_certificate_column(c->name, printed, "x_mm", n, x, why);
    if (s == RB_OK)
        s = rb_certificate_column(c->name, printed, "y_mm", n, y, why);
    if (s == RB_OK && !(row->at = calloc((size_t)n, sizeof *row->at)))
        s = RB_ENOMEM;
    for (int k = 0; k < n && s == RB_OK; k++) {
        xy[2 * k] = x[k];
        xy[2 * k + 1] = y[k];
    }
    if (s == RB_OK)
        s = rb_rolling_stress_at(&c->model, n, xy, row->at, why);
    row->nx = n;
    free(x);
    return s;
}

/* ---- Largest stresses -------------------------------------------------------------- */

/* The stresses at the places that are printed: where a flat or symmetric maximum has
 * several places, a search may end at another one. */
static rb_status maxima_again(rb_certificate *c, const json_t *printed, double depth,
                              rb_rolling_stress_maxima *there, rb_message *why)
{
    rb_rolling_stress_maxima found;
    rb_status s = rb_rolling_stress_maxima_find(&c->model, depth, &found, why);

    for (int k = 0; rb_rolling_maximum(there, k); k++) {
        const char *name = rb_rolling_maxima_scalars.row[3 * k].name;
        const json_t *one = json_object_get(printed, name);
        const char *material = json_string_value(json_object_get(one, "material"));
        rb_rolling_extremum *at = rb_rolling_maximum(there, k);
        *at = (rb_rolling_extremum){rb_certificate_member(one, "value"),
                                    rb_certificate_member(one, "x"),
                                    rb_certificate_member(one, "y"), RB_MATERIAL_BODY};
        while (material && at->material < RB_MATERIAL_BASE &&
               strcmp(material, rb_rolling_place_name(at->material)) != 0)
            at->material++;
        if (s != RB_OK)
            continue;
        /* Its place has to lie in the depth that was given, and no other may have more. */
        const rb_rolling_extremum *more = rb_rolling_maximum(&found, k);
        const double below = at->y - rb_rolling_surface(c->model.rc, at->x);
        if (depth > 0.0 && !(below <= depth * (1.0 + 1e-9)))
            rb_certificate_violated(c, "maxima.%s: %g below the surface, searched down to %g", name,
                                    below, depth);
        if (!(more->value <= at->value + search_slack(c)))
            rb_certificate_violated(c, "maxima.%s: printed %.17g, but %.17g at (%g, %g)", name,
                                    at->value, more->value, more->x, more->y);
    }
    if (s != RB_OK)
        return s;
    s = rb_rolling_stress_maxima_at(&c->model, there, why);
    if (s == RB_EINVAL)
        rb_certificate_violated(c, "maxima: %s", why->text);
    return s == RB_EINVAL ? RB_OK : s;
}

/* The same of the place that decides. */
static rb_status shakedown_again(rb_certificate *c, const json_t *printed,
                                 rb_rolling_shakedown *there, rb_message *why)
{
    rb_rolling_shakedown found;
    rb_status s = rb_rolling_shakedown_find(&c->model, &found, why);

    *there = (rb_rolling_shakedown){
        rb_certificate_member(printed, "shear_yield"), rb_certificate_member(printed, "x"),
        rb_certificate_member(printed, "y"), rb_certificate_member(printed, "residual")};
    if (s != RB_OK)
        return s;
    rb_certificate_expect(c, "shakedown.shear_yield", 0, there->shear_yield, found.shear_yield,
                          search_slack(c));
    s = rb_rolling_shakedown_at(&c->model, there, why);
    if (s == RB_EINVAL)
        rb_certificate_violated(c, "shakedown: %s", why->text);
    return s == RB_EINVAL ? RB_OK : s;
}

rb_status rb_certificate_stress(rb_certificate *c, const json_t *root, rb_message *why)
{
    const json_t *printed = json_object_get(root, "grid");
    const json_t *shakedown = json_object_get(root, "shakedown");
    const double depth = json_number_value(json_object_get(root, "depth")); /* 0: null */
    const int is_grid = printed != NULL;
    rb_rolling_stress_grid grid = {0};
    rb_rolling_stress_maxima maxima;
    rb_rolling_shakedown limit;
    rb_status s;

    if (is_grid) { /* its points follow from its size */
        const double nx = rb_certificate_member(printed, "nx");
        const double ny = rb_certificate_member(printed, "ny");
        const size_t n = json_array_size(json_object_get(printed, "x_mm"));
        s = nx >= 2.0 && ny >= 2.0 && nx * ny == (double)n
                ? rb_rolling_stress_on_grid(&c->model, (int)nx, (int)ny, depth, &grid, why)
                : rb_certificate_refuse(c->name, "its grid is not nx by ny points", why);
    } else
        s = points_again(c, json_object_get(root, "points"), &grid, why);
    if (s == RB_OK)
        s = maxima_again(c, json_object_get(root, "maxima"), depth, &maxima, why);
    if (s == RB_OK && shakedown)
        s = shakedown_again(c, shakedown, &limit, why);
    if (s == RB_OK) {
        /* What the program would print of them now. */
        const rb_report_stress stress = {.nx = is_grid ? grid.nx : 0,
                                         .ny = grid.ny,
                                         .n = is_grid ? grid.nx * grid.ny : grid.nx,
                                         .depth = depth,
                                         .at = grid.at,
                                         .maxima = &maxima,
                                         .shakedown = shakedown ? &limit : NULL,
                                         .yield_shear =
                                             rb_certificate_member(shakedown, "yield_shear"),
                                         .s = &c->again};
        json_t *again = json_object(), *part;
        const char *key;
        rb_report_json_stress(&again, &stress);
        json_object_foreach(again, key, part)
        {
            rb_certificate_compare(c, key, 0, json_object_get(root, key), part, slack_of_stress);
        }
        s = again ? RB_OK : RB_ENOMEM;
        json_decref(again);
    }
    rb_rolling_stress_grid_free(&grid);
    return s;
}
