/* The certificate of the stress below the surface: from the tractions that the result
 * prints, at the same points. */
#include "report/certificate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How well a search finds the place of a flat maximum, in half-widths. */
static const double PLACE = 1e-5;

/* A wheel's stress next to the ends of its elements magnifies the rounding of the ends,
 * and an approximated matrix has other digits for other ends. */
static double allowed_for(const rb_certificate *c, const char *key, double want)
{
    const double a = c->again.half_width, most = c->again.max_pressure;
    if (strcmp(key, "x") == 0 || strcmp(key, "y") == 0)
        return PLACE * a;
    if (strcmp(key, "x_mm") == 0 || strcmp(key, "y_mm") == 0)
        return 1e-12 * a;
    return 1e-9 * fabs(want) + most * (c->hierarchical ? 1e-5
                                       : rb_rolling_body_can(&c->model.rc.a, RB_BODY_FLAT)
                                           ? 1e-12
                                           : 1e-8);
}

static void compare_number(rb_certificate *c, const char *name, int element,
                           const json_t *printed, const json_t *again)
{
    const char *dot = strrchr(name, '.');
    const double want = rb_certificate_number(again);
    const double number = json_is_null(again) && !json_is_null(printed)
                              ? INFINITY
                              : rb_certificate_number(printed);
    rb_certificate_expect(c, name, element, number, want,
                          allowed_for(c, dot ? dot + 1 : name, want));
}

/* Every number of a list. */
static void compare_list(rb_certificate *c, const char *name, const json_t *printed,
                         const json_t *again)
{
    if (json_array_size(printed) != json_array_size(again))
        rb_certificate_violated(c, "%s: %zu numbers, expected %zu", name,
                                json_array_size(printed), json_array_size(again));
    for (size_t i = 0; i < json_array_size(again); i++)
        compare_number(c, name, (int)i + 1, json_array_get(printed, i),
                       json_array_get(again, i));
}

/* Every number of `again`, in objects of objects, against the one printed in its place.
 */
static void compare(rb_certificate *c, const char *name, const json_t *printed,
                    const json_t *again)
{
    const char *key;
    json_t *value;
    char inner[120];

    if (json_is_array(again))
        compare_list(c, name, printed, again);
    else if (!json_is_object(again))
        compare_number(c, name, 0, printed, again);
    else if (json_object_size(printed) != json_object_size(again))
        rb_certificate_violated(c, "%s: %zu entries, expected %zu", name,
                                json_object_size(printed), json_object_size(again));
    json_object_foreach((json_t *)again, key, value)
    {
        snprintf(inner, sizeof inner, "%s.%s", name, key);
        compare(c, inner, json_object_get(printed, key), value);
    }
}

/* The grid's points follow from its size. */
static rb_status grid_again(rb_certificate *c, const json_t *printed, double depth,
                            rb_rolling_stress_grid *grid, rb_message *why)
{
    const double nx = rb_certificate_member(printed, "nx");
    const double ny = rb_certificate_member(printed, "ny");
    const size_t n = json_array_size(json_object_get(printed, "x_mm"));
    if (!(nx >= 2.0 && ny >= 2.0 && nx * ny == (double)n))
        return rb_certificate_refuse(c->name, "its grid is not nx by ny points", why);
    return rb_rolling_stress_on_grid(&c->model, (int)nx, (int)ny, depth, grid, why);
}

/* Given points are taken as they are: a list in one row. */
static rb_status points_again(rb_certificate *c, const json_t *printed,
                              rb_rolling_stress_grid *row, rb_message *why)
{
    const int n = (int)json_array_size(json_object_get(printed, "x_mm"));
    double *x = rb_alloc((size_t)n, 4), *y = x + n, *xy = y + n;
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

/* What the program would print of them now. */
static rb_status compare_all(rb_certificate *c, const json_t *root,
                             const rb_report_stress *stress)
{
    json_t *again = json_object(), *value;
    const char *key;

    rb_report_json_stress(&again, stress);
    json_object_foreach(again, key, value)
        compare(c, key, json_object_get(root, key), value);
    const rb_status s = again ? RB_OK : RB_ENOMEM;
    json_decref(again);
    return s;
}

rb_status rb_certificate_stress(rb_certificate *c, const json_t *root, rb_message *why)
{
    const json_t *printed = json_object_get(root, "grid");
    const json_t *shakedown = json_object_get(root, "shakedown");
    const double depth = json_number_value(json_object_get(root, "depth")); /* 0: null */
    const int is_grid = printed != NULL;
    rb_rolling_stress_grid grid = {0};
    rb_rolling_stress_maxima maxima;
    rb_rolling_shakedown found;
    rb_status s = is_grid ? grid_again(c, printed, depth, &grid, why)
                          : points_again(c, json_object_get(root, "points"), &grid, why);

    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(&c->model, depth, &maxima, why);
    if (s == RB_OK && shakedown)
        s = rb_rolling_shakedown_find(&c->model, &found, why);
    if (s == RB_OK)
        s = compare_all(c, root,
                        &(rb_report_stress){.nx = is_grid ? grid.nx : 0,
                                            .ny = grid.ny,
                                            .n = is_grid ? grid.nx * grid.ny : grid.nx,
                                            .depth = depth,
                                            .at = grid.at,
                                            .maxima = &maxima,
                                            .shakedown = shakedown ? &found : NULL,
                                            .yield_shear = rb_certificate_member(
                                                shakedown, "yield_shear"),
                                            .s = &c->again});
    rb_rolling_stress_grid_free(&grid);
    return s;
}
