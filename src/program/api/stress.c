/* Stress below the surface: grid, points, maxima, and below given tractions. */
#include "program/api/internal.h"

#include <stdio.h>
#include <stdlib.h>

static rb_status keep_stress(rb_api *a, int nx, int ny, const rb_rolling_stress *at)
{
    const rb_rolling_results *table = &rb_rolling_stress_scalars;
    const api_entries all = {"stress.", table, at, nx, ny, sizeof *at};
    for (int k = 0; k < table->n; k++)
        if (rb_rolling_has_result(&table->row[k], a->result.model.rc, 0) &&
            !rb_api_make_entries(a, &all, &table->row[k]))
            return RB_ENOMEM;
    return RB_OK;
}

/* Temperatures under the heat of the solution, which is kept in the units that are shown. */
static rb_status add_temperature(rb_api *a, int n, rb_rolling_stress *at)
{
    rb_rolling_solution s = {0};
    if (!a->result.solution.temperature)
        return RB_OK;
    rb_status status = rb_rolling_model_solution(&a->result.model, &s, &a->why);
    if (status == RB_OK)
        status =
            rb_rolling_temperature_inside(a->result.model.rc, &s, a->stress_of_b, n, at, &a->why);
    rb_rolling_solution_free(&s);
    return status;
}

int rb_api_stress_of(rb_api *a, int of_b)
{
    a->stress_of_b = of_b != 0;
    return RB_OK;
}

int rb_api_tractions(rb_api *a, int n, const double *x, const double *p, const double *q)
{
    rb_message reason = {.text = ""};
    const rb_option_set all = rb_case_options(a->words);

    for (int k = 0; k < all.n; k++)
        if (all.given[k] && !rb_case_is_of_tractions(all.options[k].name))
            return rb_api_ended(a, rb_refuse(&a->why, all.options[k].name,
                                             "with given tractions no contact is solved; "
                                             "leave it out"));
    if (rb_api_resolve(a) < 0)
        return a->status;
    double *rows = n > 0 ? rb_alloc((size_t)n, 3) : NULL;
    if (n > 0 && !rows)
        return rb_api_ended(a, rb_fail(&a->why, RB_ENOMEM, "out of memory"));
    for (int k = 0; k < n; k++) {
        rows[k] = rb_api_stored(a, "mm", x[k]);
        rows[n + k] = rb_api_stored(a, "MPa", p[k]);
        rows[2 * n + k] = rb_api_stored(a, "MPa", q[k]);
    }
    rb_case_result *r = &a->result;
    rb_status s = rb_rolling_model_of_nodes(&rb_case_resolved(a->words)->rc, n, rows, rows + n,
                                            rows + 2 * n, &r->model, &r->solution, &reason);
    free(rows);
    if (s != RB_OK)
        rb_rolling_model_free(&r->model);
    return rb_api_ended(a, s == RB_OK ? s : rb_fail(&a->why, s, "%s", reason.text));
}

/* The model of the body that is asked for: A, or B in a mirror, to be freed. */
static rb_status begin_stress(rb_api *a, const char *arrays, rb_rolling_mirror **mirror,
                              const rb_rolling_model **model)
{
    *mirror = NULL;
    *model = &a->result.model;
    rb_api_forget_call(a);
    rb_api_forget_arrays(a, arrays);
    if (!a->result.model.state.p)
        return rb_fail(&a->why, RB_EINVAL, "%s",
                       a->result.has_errors
                           ? "the stress needs a case that is solved without error bars"
                           : "nothing is solved");
    if (!a->stress_of_b)
        return rb_rolling_stress_check(a->result.model.rc, &a->why);
    const rb_status s = rb_rolling_mirror_create(&a->result.model, mirror, &a->why);
    *model = s == RB_OK ? &(*mirror)->model : NULL;
    return s;
}

int rb_api_stress(rb_api *a, int nx, int ny, double depth)
{
    rb_rolling_stress_grid grid = {0};
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "stress.", &mirror, &model);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_on_grid(model, nx, ny, rb_api_stored(a, "mm", depth), &grid, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_grid(&grid);
    if (s == RB_OK)
        s = add_temperature(a, nx * ny, grid.at);
    if (s == RB_OK)
        s = keep_stress(a, nx, ny, grid.at);
    rb_rolling_stress_grid_free(&grid);
    return rb_api_ended(a, s);
}

int rb_api_stress_at(rb_api *a, int n, const double *xy)
{
    rb_rolling_stress *at = NULL;
    double *place = NULL;
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "stress.", &mirror, &model);
    if (s == RB_OK && n < 1)
        s = rb_fail(&a->why, RB_EINVAL, "stress: expected at least one point, got %d", n);
    if (s == RB_OK && (!(at = calloc((size_t)n, sizeof *at)) || !(place = rb_alloc((size_t)n, 2))))
        s = RB_ENOMEM;
    for (int k = 0; s == RB_OK && k < 2 * n; k++)
        place[k] = rb_api_stored(a, "mm", a->stress_of_b && k % 2 ? 0.0 - xy[k] : xy[k]);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_at(model, n, place, at, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_stress(n, at, NULL);
    if (s == RB_OK)
        s = add_temperature(a, n, at);
    if (s == RB_OK)
        s = keep_stress(a, n, 1, at);
    free(place);
    free(at);
    return rb_api_ended(a, s);
}

int rb_api_stress_maxima(rb_api *a, double depth)
{
    rb_rolling_stress_maxima m = {.bonds = 0};
    rb_rolling_mirror *mirror;
    const rb_rolling_model *model;
    rb_status s = begin_stress(a, "maxima.", &mirror, &model);
    rb_api_call_begins(a);
    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(model, rb_api_stored(a, "mm", depth), &m, &a->why);
    s = rb_api_call_ends(a, s);
    rb_rolling_mirror_free(mirror);
    if (s == RB_OK && a->stress_of_b)
        rb_rolling_mirror_stress(0, NULL, &m);
    for (int k = 0; s == RB_OK && rb_rolling_maximum(&m, k); k++) {
        const rb_rolling_extremum *at = rb_rolling_maximum(&m, k);
        const double x[] = {at->value, at->x, at->y, at->material};
        char name[64];
        rb_rolling_maximum_result named;
        snprintf(name, sizeof name, "maxima.%s",
                 rb_rolling_describe_maximum(k, 0, 0, &named)->name);
        if (!rb_api_copy_array(a, name, 4, 1, x))
            s = RB_ENOMEM;
    }
    rb_rolling_stress_maxima_free(&m);
    return rb_api_ended(a, s);
}
