/* Arrays by their names: those that calls have made, and those that are made when they are asked
 * for. */
#include "program/api/internal.h"

#include "rolling/case/closed_forms.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Arrays ------------------------------------------------------------------------ */

api_array *rb_api_find_array(rb_api *a, const char *name)
{
    for (int k = 0; k < a->arrays; k++)
        if (strcmp(a->made[k]->name, name) == 0)
            return a->made[k];
    return NULL;
}

void rb_api_forget_arrays(rb_api *a, const char *beginning)
{
    int kept = 0;
    for (int k = 0; k < a->arrays; k++)
        if (strncmp(a->made[k]->name, beginning, strlen(beginning)) == 0) {
            free(a->made[k]->at);
            free(a->made[k]);
        } else
            a->made[kept++] = a->made[k];
    a->arrays = kept;
    if (kept == 0) {
        free(a->made);
        a->made = NULL;
    }
}

api_array *rb_api_make_array(rb_api *a, const char *name, int rows, int columns)
{
    api_array **more = realloc(a->made, ((size_t)a->arrays + 1) * sizeof *more);
    api_array *made = more ? calloc(1, sizeof *made) : NULL;
    a->made = more ? more : a->made;
    if (!made || !(made->at = rb_alloc((size_t)rows, (size_t)columns))) {
        free(made);
        return NULL;
    }
    snprintf(made->name, sizeof made->name, "%s", name);
    made->rows = rows;
    made->columns = columns;
    memset(made->at, 0, sizeof(double) * (size_t)rows * (size_t)columns);
    return a->made[a->arrays++] = made;
}

api_array *rb_api_copy_array(rb_api *a, const char *name, int rows, int columns, const double *x)
{
    api_array *made = x ? rb_api_make_array(a, name, rows, columns) : NULL;
    if (made)
        memcpy(made->at, x, sizeof(double) * (size_t)rows * (size_t)columns);
    return made;
}

/* ---- Units ------------------------------------------------------------------------- */

/* The part of the name behind a beginning; NULL: it begins otherwise. */
static const char *behind(const char *name, const char *beginning)
{
    const size_t n = strlen(beginning);
    return strncmp(name, beginning, n) == 0 ? name + n : NULL;
}

/* The unit in mm, N, MPa of all numbers of an array; NULL: they have none, or are those of a
 * problem that was handed over, of an LCP, or in the units of the case already. */
static const char *unit_of_array(const rb_api *a, const char *name)
{
    static const struct {
        const char *beginning;
        const rb_rolling_results *results;
    } tables[] = {{"history.error.", &rb_rolling_history_columns},
                  {"history.tolerance.", &rb_rolling_history_columns},
                  {"history.", &rb_rolling_history_columns},
                  {"curve.tolerance.", &rb_rolling_curve_columns},
                  {"curve.error.", &rb_rolling_curve_columns},
                  {"curve.", &rb_rolling_curve_columns},
                  {"wear.", &rb_rolling_wear_columns},
                  {"patch.", &rb_rolling_patch_scalars},
                  {"stress.", &rb_rolling_stress_scalars},
                  {"crack.summary.", &rb_case_crack_scalars},
                  {"crack.growth.", &rb_case_crack_growth_columns},
                  {"crack.", &rb_case_crack_columns},
                  {"sweep.tolerance.", &rb_rolling_solution_scalars},
                  {"sweep.", &rb_rolling_solution_scalars},
                  {"sweep.", &rb_case_crack_scalars},
                  {"tolerance.", &rb_rolling_solution_scalars},
                  {"", &rb_rolling_solution_columns}};
    /* what no table has; a beginning ends with a point */
    static const char *const others[][2] = {
        {"friction_power", "MPa"}, {"ends", "mm"},          {"gap0", "mm"},
        {"F", "mm/MPa"},           {"G", "mm/MPa"},         {"mesh.", "mm"},
        {"closed.", "MPa"},        {"wear.profile.", "mm"}, {"crack.path.", "mm"},
        {"crack.node.x", "mm"},    {"crack.node.y", "mm"},  {"crack.node.length", "mm"},
        {"crack.opening", "mm"},   {"crack.sliding", "mm"}, {"crack.pressure", "MPa"},
        {"crack.friction", "MPa"}, {"step.x", "mm"},        {"step.p", "MPa"},
        {"step.q", "MPa"},         {"pivot.p", "MPa"},      {"pivot.q", "MPa"},
        {"newton.p", "MPa"},       {"newton.q", "MPa"},     {"guess.p", "MPa"},
        {"guess.q", "MPa"},        {"guess.gap", "mm"},     {"guess.shift", "mm"}};
    if (strcmp(name, "wear.way") == 0)
        return a->wear.slides ? "mm" : NULL;
    if (strcmp(name, "wear.work") == 0)
        return a->wear.slides || a->wear.rolls ? "N/mm" : "N";
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
        const char *rest = behind(name, others[k][0]);
        if (rest && (!*rest || rest[-1] == '.'))
            return others[k][1];
    }
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        const char *rest = behind(name, tables[k].beginning);
        const rb_rolling_result *r = rest ? rb_rolling_find_result(tables[k].results, rest) : NULL;
        if (r)
            return r->unit;
    }
    return NULL;
}

static rb_units units_of(const rb_api *a, const char *name)
{
    return behind(name, "sweep.") ? a->study_units : rb_case_resolved(a->words)->units;
}

/* From mm, N, MPa to the units of the case: n numbers of an array from the first on. */
static void convert_array(const rb_api *a, api_array *made, int first, int n)
{
    rb_unit_factor f;
    const rb_units units = units_of(a, made->name);
    if (rb_unit_of_system(units, unit_of_array(a, made->name), &f))
        for (int i = first; i < first + n; i++)
            made->at[i] = rb_unit_over(&f, made->at[i]);
    else if (behind(made->name, "maxima."))
        for (int i = first; i < first + n; i++)
            made->at[i] = rb_unit_shown(units, i == 0 ? "MPa" : i < 3 ? "mm" : NULL, made->at[i]);
}

/* A number that is handed over, in mm, N, MPa. */
double rb_api_stored(const rb_api *a, const char *unit, double x)
{
    return rb_unit_stored(rb_case_units(a->words, RB_GIVEN_ARGUMENT), unit, x);
}

double rb_api_shown(const rb_api *a, const char *unit, double x)
{
    return rb_unit_shown(rb_case_resolved(a->words)->units, unit, x);
}

/* Adds one column to an array that grows step by step. */
rb_status rb_api_add_column(rb_api *a, const char *name, int rows, const double *x)
{
    api_array *to = rb_api_find_array(a, name);
    if (!to)
        return rb_api_copy_array(a, name, rows, 1, x) ? RB_OK : RB_ENOMEM;
    const size_t size = sizeof(double) * (size_t)rows * ((size_t)to->columns + 1);
    double *longer = realloc(to->at, size);
    if (!longer)
        return RB_ENOMEM;
    to->at = longer;
    memcpy(&longer[(size_t)rows * (size_t)to->columns], x, sizeof(double) * (size_t)rows);
    to->columns++;
    if (to->shown) /* somebody has looked at it */
        convert_array(a, to, rows * (to->columns - 1), rows);
    return RB_OK;
}

/* Adds zones and tractions of a step to its arrays. */
rb_status rb_api_add_state(rb_api *a, const char *beginning, const rb_contact_state *state)
{
    double *zone = rb_alloc((size_t)state->n, 1);
    const struct {
        const char *name;
        const double *x;
    } parts[] = {{"zone", zone}, {"p", state->p}, {"q", state->q}};
    rb_status s = zone ? RB_OK : RB_ENOMEM;

    for (int i = 0; zone && i < state->n; i++)
        zone[i] = state->zone[i];
    for (int k = 0; k < 3 && s == RB_OK; k++) {
        char name[40];
        snprintf(name, sizeof name, "%s.%s", beginning, parts[k].name);
        s = rb_api_add_column(a, name, state->n, parts[k].x);
    }
    free(zone);
    return s;
}

/* ---- Made when they are asked for
 * ---------------------------------------------------------------------- */

static api_array *model_array(rb_api *a, const char *name)
{
    rb_rolling_model *model = &a->result.model;
    const int n = model->mesh.n, size = a->lcp.size;
    if (strcmp(name, "ends") == 0)
        return rb_api_copy_array(a, name, n + 2, 1, model->mesh.ends);
    if (strcmp(name, "gap0") == 0)
        return rb_api_copy_array(a, name, n, 1, model->mesh.gap);
    if (strcmp(name, "F") == 0 && model->state.p &&
        rb_rolling_model_add_matrix(model, &a->why) != RB_OK)
        return NULL;
    if (strcmp(name, "F") == 0)
        return rb_api_copy_array(a, name, 2 * n + 2, 2 * n, model->bodies.F);
    if (strcmp(name, "lcp.M") == 0)
        return rb_api_copy_array(a, name, size, size, a->lcp.M);
    if (strcmp(name, "lcp.q") == 0)
        return rb_api_copy_array(a, name, size, 1, a->lcp.b);
    rb_bem_mesh mesh;
    api_array *made = NULL;
    if (rb_rolling_boundary_mesh(&a->result.model, 0, &mesh, &a->why) != RB_OK)
        return NULL;
    const struct {
        const char *name;
        const double *at;
    } places[] = {
        {"mesh.x0", mesh.x0}, {"mesh.y0", mesh.y0}, {"mesh.x1", mesh.x1}, {"mesh.y1", mesh.y1}};
    for (size_t k = 0; k < sizeof places / sizeof *places && mesh.n > 0; k++)
        if (strcmp(name, places[k].name) == 0)
            made = rb_api_copy_array(a, name, mesh.n, 1, places[k].at);
    if (mesh.n > 0 && (strcmp(name, "H") == 0 || strcmp(name, "G") == 0)) {
        const rb_rolling_case *rc = a->result.model.rc;
        api_array *H = rb_api_make_array(a, "H", 2 * mesh.n, 2 * mesh.n);
        api_array *G = rb_api_make_array(a, "G", 2 * mesh.n, 2 * mesh.n);
        if (!H || !G ||
            rb_bem_assemble(&mesh, rb_rolling_material(rc, &rc->a), H->at, G->at, 2 * mesh.n,
                            &a->why) != RB_OK) {
            rb_api_forget_arrays(a, "H");
            rb_api_forget_arrays(a, "G");
            made = NULL;
        } else
            made = strcmp(name, "H") == 0 ? H : G;
    }
    rb_bem_mesh_free(&mesh);
    return made;
}

/* Hertz and Carter at the elements' midpoints. */
static api_array *closed_array(rb_api *a, const char *name)
{
    const rb_resolved_case *c = rb_case_resolved(a->words);
    const rb_rolling_solution *s = &a->result.solution;
    const int friction = strcmp(name, "closed.q") == 0;
    if ((!friction && strcmp(name, "closed.p") != 0) || s->n == 0 ||
        !rb_rolling_carter_holds(&c->rc))
        return NULL;
    const double half = s->hertz_half_width, mu = rb_rolling_largest_mu(&c->rc);
    const double highest = rb_closed_hertz_max_pressure(s->normal_load, half);
    api_array *made = rb_api_make_array(a, name, s->n, 1);
    const double creep = mu > 0.0 ? s->creep_ratio : 0.0;
    for (int i = 0; made && i < s->n; i++)
        made->at[i] = friction ? rb_closed_carter_traction(mu, highest, half, creep, s->x[i])
                               : rb_closed_hertz_pressure(highest, half, s->x[i]);
    return made;
}

int rb_api_has_entries(const api_entries *of, const rb_rolling_result *r)
{
    return of->owner && of->rows > 0 && (of->size || rb_rolling_has_column(r, of->owner));
}

/* NULL: there are none, or no memory. */
api_array *rb_api_make_entries(rb_api *a, const api_entries *of, const rb_rolling_result *r)
{
    char name[120];
    snprintf(name, sizeof name, "%s%s", of->beginning, r->name);
    api_array *made =
        rb_api_has_entries(of, r) ? rb_api_make_array(a, name, of->rows, of->columns) : NULL;
    for (int i = 0; made && i < of->rows * of->columns; i++)
        made->at[i] = of->size
                          ? rb_rolling_number(r, (const char *)of->owner + (size_t)i * of->size)
                          : rb_rolling_entry(r, of->owner, i);
    return made;
}

/* An entry of the tables whose columns are arrays, by the beginning of its name: those of
 * the solution begin with nothing. */
static api_array *series_array(rb_api *a, const char *name)
{
    const rb_case_result *r = &a->result;
    const rb_rolling_solution *s = &r->solution;
    const api_entries series[] = {
        {"history.error.", &rb_rolling_history_columns, r->history.errors, r->history.n, 1, 0},
        {"history.tolerance.", &rb_rolling_history_columns, r->history.deviations, r->history.n, 1,
         0},
        {"history.", &rb_rolling_history_columns, &r->history, r->history.n, 1, 0},
        {"curve.tolerance.", &rb_rolling_curve_columns, a->curve.deviations, a->curve.n, 1, 0},
        {"curve.error.", &rb_rolling_curve_columns, &a->curve_errors, a->curve_errors.n, 1, 0},
        {"curve.", &rb_rolling_curve_columns, &a->curve, a->curve.n, 1, 0},
        {"wear.error.", &rb_rolling_wear_columns, a->wear.errors, a->wear.n, 1, 0},
        {"wear.", &rb_rolling_wear_columns, &a->wear, a->wear.n, 1, 0},
        {"patch.", &rb_rolling_patch_scalars, s->patch, s->patches, 1, sizeof *s->patch},
        {"", &rb_rolling_solution_columns, s, s->n, 1, 0}};
    size_t n, k = 0;
    while (strncmp(name, series[k].beginning, n = strlen(series[k].beginning)) != 0)
        k++;
    const rb_rolling_result *row = rb_rolling_find_result(series[k].table, name + n);
    return row ? rb_api_make_entries(a, &series[k], row) : NULL;
}

/* Of result `name` with respect to all inputs, the two sides of each beside each other. */
static api_array *derivative_array(rb_api *a, const char *name, const char *result)
{
    const rb_case_derivatives *all = &a->derivatives;
    int is_column;
    const rb_rolling_result *r = rb_case_derivative_result(result, &is_column);
    const int values = strcmp(result, "value") == 0;
    for (int k = 0; k < 2 * RB_CASE_OVER_X_N && all->n_x > 0; k++) {
        char known[40];
        snprintf(known, sizeof known, "%s.%s", rb_case_over_x_names[k / 2], k % 2 ? "mu" : "gap");
        if (strcmp(known, result) != 0)
            continue;
        const rb_rolling_result *of =
            rb_rolling_find_result(&rb_rolling_solution_scalars, rb_case_over_x_names[k / 2]);
        const double by = k % 2 ? 1.0 : rb_api_shown(a, "mm", 1.0); /* by mu, by the gap */
        api_array *made = rb_api_copy_array(a, name, all->n_x, 1, all->over_x + k * all->n_x);
        for (int i = 0; made && i < all->n_x; i++)
            made->at[i] = rb_api_shown(a, of->unit, made->at[i]) / by;
        return made;
    }
    const int rows = !values && is_column ? a->result.solution.n : 1;
    api_array *made = all->n > 0 && (r || values)
                          ? rb_api_make_array(a, name, rows, values ? all->n : 2 * all->n)
                          : NULL;

    for (int k = 0; made && k < all->n; k++) {
        const rb_case_derivative *of = &all->of[k];
        const double by = rb_api_shown(a, of->unit, 1.0);
        if (values)
            made->at[k] = rb_api_shown(a, of->unit, of->value);
        for (int side = 0; side < 2 && !values; side++) {
            const int from = of->status == RB_OK && of->d.sides == 1 ? 0 : side;
            const rb_rolling_solution *d = &of->d.value[from];
            const int has = of->status == RB_OK && of->d.has[from] &&
                            (!is_column || rb_rolling_has_column(r, d));
            for (int i = 0; i < rows; i++)
                made->at[i + rows * (2 * k + side)] =
                    !has ? NAN
                         : rb_api_shown(a, r->unit,
                                        is_column ? rb_rolling_entry(r, d, i)
                                                  : rb_rolling_number(r, d)) /
                               by;
        }
    }
    return made;
}

const char *const rb_api_slopes_of[API_SLOPES_N] = {
    [API_SLOPES_CURVE] = "curve", [API_SLOPES_HISTORY] = "history", [API_SLOPES_SWEEP] = "sweep"};

/* "tangential_load:mu". */
const char *rb_api_slope_name(const rb_case_slope *of, char text[100])
{
    snprintf(text, 100, "%s:%s", of->result->name, of->input);
    return text;
}

/* Both sides of each point of a curve; otherwise the one number of each row. */
static api_array *slope_array(rb_api *a, const char *name)
{
    static const char derivative_[] = ".derivative.";

    for (int of = 0; of < API_SLOPES_N; of++) {
        const rb_case_slopes *s = &a->slopes[of];
        const size_t n = strlen(rb_api_slopes_of[of]), m = sizeof derivative_ - 1;
        const int sides = of == API_SLOPES_CURVE ? 2 : 1;
        char text[100];
        int k = 0;
        if (s->rows == 0 || strncmp(name, rb_api_slopes_of[of], n) != 0 ||
            strncmp(name + n, derivative_, m) != 0)
            continue;
        while (k < s->n && strcmp(name + n + m, rb_api_slope_name(&s->of[k], text)) != 0)
            k++;
        api_array *made = k < s->n ? rb_api_make_array(a, name, s->rows, sides) : NULL;
        for (int row = 0; made && row < s->rows; row++) {
            const double *both = s->value + 2 * ((size_t)row * (size_t)s->n + (size_t)k);
            const rb_units units = units_of(a, name);
            made->at[row] = rb_case_slope_shown(
                &s->of[k], units, sides == 2 ? both[0] : rb_case_slope_value(s, row, k));
            if (sides == 2)
                made->at[s->rows + row] = rb_case_slope_shown(&s->of[k], units, both[1]);
        }
        return made;
    }
    return NULL;
}

static api_array *tolerance_array(rb_api *a, const char *name, const char *result)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n && a->has_deviation; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &a->deviation);
        if (rb_sensitivity_has(r) && strcmp(r->name, result) == 0)
            return rb_api_copy_array(a, name, 1, 1, &x);
    }
    return NULL;
}

const double *rb_api_array(rb_api *a, const char *name, int *rows, int *columns)
{
    api_array *made = rb_api_find_array(a, name);
    if (!made)
        made = slope_array(a, name);
    if (!made)
        made = series_array(a, name);
    if (!made && strcmp(name, "friction_power") == 0) {
        const rb_rolling_solution *s = &a->result.solution;
        made = s->n > 0 ? rb_api_make_array(a, name, s->n, 1) : NULL;
        if (made)
            rb_rolling_friction_power(s, made->at);
    }
    if (!made && strncmp(name, "closed.", 7) == 0)
        made = closed_array(a, name);
    if (!made && strncmp(name, "derivative.", 11) == 0)
        made = derivative_array(a, name, name + 11);
    if (!made && strncmp(name, "tolerance.", 10) == 0)
        made = tolerance_array(a, name, name + 10);
    if (!made && a->result.model.mesh.n > 0) {
        a->stopped = 0;
        a->interrupted = 0;
        rb_api_call_begins(a);
        made = model_array(a, name);
        rb_api_call_ends(a, RB_OK);
    }
    if (made && !made->shown)
        convert_array(a, made, 0, made->rows * made->columns);
    if (made)
        made->shown = 1;
    *rows = made ? made->rows : 0;
    *columns = made ? made->columns : 0;
    return made ? made->at : NULL;
}
