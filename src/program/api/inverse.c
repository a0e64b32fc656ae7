/* What is asked of a case backwards: numbers fitted to measurements, designs. */
#include "analysis/fit/fit_case.h"
#include "program/api/internal.h"

#include "analysis/design/design.h"
#include "base/io/io.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A copy of the case, which options for the question do not change.  NULL: no memory. */
static rb_case *copy_case(rb_api *a, const char *arrays, rb_case_purpose purpose)
{
    rb_case *c = rb_case_copy(a->words);

    rb_api_forget_arrays(a, arrays);
    rb_api_forget_notes(a);
    rb_api_forget_call(a);
    if (c)
        rb_case_set_purpose(c, purpose);
    return c;
}

/* Refuses what the command line refuses. */
static rb_status check_range(const rb_option *o, double value, rb_message *why)
{
    char expected[80];

    return rb_option_in_range(o, value)
               ? RB_OK
               : rb_fail(why, RB_EINVAL, "--%s: expected %s, got %g", o->name,
                         rb_option_expected(o, expected, sizeof expected), value);
}

/* An array of the handle; those of one call begin with "fit." or "design.". */
static rb_status keep_numbers(rb_api *a, const char *name, int rows, int columns, const double *x)
{
    return rb_api_copy_array(a, name, rows, columns, x) ? RB_OK : RB_ENOMEM;
}

static rb_status keep_text(char **kept, const char *text)
{
    const size_t size = strlen(text) + 1;

    free(*kept);
    if ((*kept = malloc(size)) != NULL)
        memcpy(*kept, text, size);
    return *kept ? RB_OK : RB_ENOMEM;
}

/* ---- Fits -------------------------------------------------------------------------- */

/* Called after each step of a fit: shows how far it is, and passes on a stop. */
static int see_step(int iteration, double chi_square, int n, const double *value, void *context)
{
    (void)chi_square, (void)n, (void)value;
    rb_api *a = context;
    a->done = iteration;
    return a->stopped;
}

/* In the units of the case; what the data do not determine is NAN. */
static rb_status keep_parameters(rb_api *a, const rb_case_fit *fit, rb_units units)
{
    enum { VALUE, FROM, TO, DEVIATION, MESH, IDENTIFIED, AT_BOUND, COLUMNS };
    static const char *const names[COLUMNS] = {
        "fit.value", "fit.interval.from", "fit.interval.to", "fit.deviation",
        "fit.mesh",  "fit.identified",    "fit.at_bound"};
    double x[COLUMNS][RB_CASE_FIT_MAX], correlation[RB_CASE_FIT_MAX * RB_CASE_FIT_MAX];
    const int n = fit->n, solved = fit->status == RB_OK;
    rb_status s = RB_OK;

    for (int j = 0; j < n; j++) {
        const rb_case_parameter *p = &fit->parameter[j];
        const double of[] = {p->value, p->interval[0], p->interval[1], p->deviation, p->mesh};
        /* Without a solution the last numbers are shown, without intervals. */
        for (int k = VALUE; k <= MESH; k++)
            x[k][j] = (solved && p->identified) || (!solved && k == VALUE)
                          ? rb_unit_shown(units, p->unit, of[k])
                          : NAN;
        x[IDENTIFIED][j] = solved && p->identified;
        x[AT_BOUND][j] = solved && p->at_bound;
        for (int i = 0; i < n; i++)
            correlation[i + j * n] = i == j ? 1.0 : solved ? p->correlation[i] : NAN;
    }
    for (int k = 0; k < COLUMNS && s == RB_OK; k++)
        s = keep_numbers(a, names[k], n, 1, x[k]);
    return s == RB_OK ? keep_numbers(a, "fit.correlation", n, n, correlation) : s;
}

/* The measured curve, the fitted one and its band, n points each; creepages have no unit. */
static rb_status keep_points(rb_api *a, const rb_case_data *d, const rb_case_fit *fit,
                             rb_units units)
{
    const char *unit = d->measure == RB_CASE_FORCE ? "N/mm" : "-";
    const double *const columns[] = {d->force, fit->model, fit->band};
    const char *const names[] = {d->measure == RB_CASE_FORCE         ? "fit.force"
                                 : d->measure == RB_CASE_FORCE_RATIO ? "fit.force_ratio"
                                                                     : "fit.force_over_load",
                                 "fit.fitted", "fit.band"};
    rb_status s = keep_numbers(a, d->is_ratio ? "fit.creep_ratio" : "fit.creep", d->n, 1, d->creep);

    for (int k = 0; k < 3 && s == RB_OK; k++) {
        api_array *made = rb_api_copy_array(a, names[k], d->n, 1, columns[k]);
        s = made ? RB_OK : RB_ENOMEM;
        for (int i = 0; made && i < d->n; i++)
            made->at[i] = rb_unit_shown(units, unit, made->at[i]);
    }
    return s;
}

/* Numbers of the whole fit; the noise has the unit of the forces unless deviations are given, of
 * which it is a multiple. */
static rb_status keep_fit(rb_api *a, const rb_case_data *d, const rb_case_fit *fit, rb_units units)
{
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"fit.chi_square", fit->chi_square},
                   {"fit.degrees_of_freedom", fit->degrees_of_freedom},
                   {"fit.noise", d->measure == RB_CASE_FORCE && !d->sigma
                                     ? rb_unit_shown(units, "N/mm", fit->noise)
                                     : fit->noise},
                   {"fit.kappa", fit->kappa},
                   {"fit.iterations", fit->iterations}};
    rb_status s = keep_parameters(a, fit, units);

    if (fit->status != RB_OK)
        return s;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers && s == RB_OK; k++)
        s = keep_numbers(a, numbers[k].name, 1, 1, &numbers[k].value);
    if (s == RB_OK)
        s = keep_points(a, d, fit, units);
    return s == RB_OK ? keep_text(&a->said[API_FIT_SENTENCES], fit->sentences) : s;
}

/* Reads the table from path unless it has rows; frees it. */
static int fit_table(rb_api *a, const char *path, rb_io_table *t, const rb_case_fit_words *w,
                     double level)
{
    static const rb_option of_level = RB_FIT_LEVEL_LINE(0), of_sigma = RB_FIT_SIGMA_LINE(0);
    rb_case *c = copy_case(a, "fit.", RB_CASE_CURVE);
    rb_case_data data = {0};
    rb_case_fit fit = {.level = level};
    const rb_case_fit_observer observer = {see_step, a};
    rb_status s = c ? rb_api_check_refusals(a, &a->why) : RB_ENOMEM;

    if (s == RB_OK)
        s = check_range(&of_level, level, &a->why);
    if (s == RB_OK && !isnan(w->sigma))
        s = check_range(&of_sigma, w->sigma, &a->why);
    /* The table and the words are read first: they may change the case, which is resolved
     * afterwards. */
    if (s == RB_OK)
        s = rb_case_fit_read(c, w, path, t, &data, &fit, &a->why);
    if (s == RB_OK)
        s = rb_case_resolve(c, &a->why);
    if (s == RB_OK) {
        rb_api_call_begins(a);
        s = rb_case_fit_solve(c, &data, &observer, &fit, &a->why);
        s = rb_api_call_ends(a, s);
        if (s >= 0 && keep_fit(a, &data, &fit, rb_case_resolved(c)->units) != RB_OK)
            s = RB_ENOMEM;
    }
    if (s != RB_OK && c)
        s = rb_case_locate(c, s, &a->why);
    rb_case_fit_free(&fit);
    rb_io_table_free(t);
    rb_case_free(c);
    return rb_api_ended(a, s);
}

int rb_api_fit(rb_api *a, int columns, const char *const *column, int rows, const double *data,
               const char *names, const char *start, const char *bounds, double sigma, double level)
{
    const rb_case_fit_words w = {names, start, bounds, sigma};
    rb_io_table t = {.rows = rows, .columns = columns};

    if (rows < 1 || columns < 1)
        return rb_api_refuse(a, "data: %d rows and %d columns", rows, columns);
    const size_t n = (size_t)rows * (size_t)columns;
    /* A table as if it had been read from a file: names of columns, and the numbers column by
     * column. */
    t.x = rb_alloc((size_t)rows, (size_t)columns);
    t.name = calloc((size_t)columns, sizeof *t.name);
    int full = t.x && t.name;
    for (int j = 0; j < columns && full; j++)
        full = keep_text(&t.name[j], column[j]) == RB_OK;
    if (!full) {
        a->why.text[0] = '\0';
        rb_io_table_free(&t);
        return rb_api_ended(a, RB_ENOMEM);
    }
    memcpy(t.x, data, n * sizeof *data);
    return fit_table(a, "data", &t, &w, level);
}

int rb_api_fit_file(rb_api *a, const char *path, const char *names, const char *start,
                    const char *bounds, double sigma, double level)
{
    const rb_case_fit_words w = {names, start, bounds, sigma};
    rb_io_table t = {0};

    return fit_table(a, path, &t, &w, level);
}

/* ---- Designs ----------------------------------------------------------------------- */

static int see_evaluation(int evaluation, double value, const double *x, void *context)
{
    (void)value, (void)x;
    rb_api *a = context;
    a->done = evaluation;
    return a->stopped;
}

static double shown(const rb_rolling_result *r, rb_units units, double x)
{
    return rb_unit_shown(units, r ? r->unit : NULL, x);
}

/* Of the variables, and of the results under constraints, with blanks between. */
static rb_status keep_names(rb_api *a, const rb_design *d)
{
    const size_t size = ((size_t)d->n + RB_DESIGN_CONSTRAINTS) * (sizeof d->variable->name + 1);
    char *text = malloc(size);
    rb_status s = text ? RB_OK : RB_ENOMEM;

    for (int of = 0; of < 2 && s == RB_OK; of++) {
        *text = '\0';
        for (int j = 0, n = of ? d->constraints : d->n; j < n; j++)
            rb_append(text, size, "%s%s", j ? " " : "",
                      of ? rb_design_result_name(d->constraint[j].result) : d->variable[j].name);
        s = keep_text(&a->said[of ? API_DESIGN_CONSTRAINTS : API_DESIGN_VARIABLES], text);
    }
    free(text);
    return s;
}

/* In the units of the case. */
static rb_status keep_design(rb_api *a, const rb_design *d, rb_units units)
{
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"design.result", rb_unit_shown(units, rb_design_unit(d), d->value)},
                   {"design.result.start", rb_unit_shown(units, rb_design_unit(d), d->start)},
                   {"design.evaluations", d->evaluations}};
    rb_status s = keep_names(a, d);

    for (size_t k = 0; k < sizeof numbers / sizeof *numbers && s == RB_OK; k++)
        s = keep_numbers(a, numbers[k].name, 1, 1, &numbers[k].value);
    /* Each variable where the search ended and where it began; constraints x 3: at least or at
     * most, bound, value. */
    api_array *value = s == RB_OK ? rb_api_make_array(a, "design.value", d->n, 1) : NULL;
    api_array *start = value ? rb_api_make_array(a, "design.start", d->n, 1) : NULL;
    api_array *of = NULL, *x = NULL;
    if (start && d->constraints > 0)
        of = rb_api_make_array(a, "design.constraint", d->constraints, 3);
    if (start && d->gap_n > 0)
        x = rb_api_copy_array(a, "design.gap.x", d->gap_n, 1, d->gap_x);
    if (!start || (d->constraints > 0 && !of) || (d->gap_n > 0 && !x))
        return RB_ENOMEM;
    for (int j = 0; j < d->n; j++) {
        const rb_design_variable *v = &d->variable[j];
        value->at[j] = rb_unit_shown(units, v->unit, v->value);
        start->at[j] = rb_unit_shown(units, v->unit, v->start);
    }
    for (int k = 0; k < d->constraints; k++) {
        const rb_design_constraint *c = &d->constraint[k];
        of->at[k] = c->at_least;
        of->at[k + d->constraints] = shown(c->result, units, c->bound);
        of->at[k + 2 * d->constraints] = shown(c->result, units, c->value);
    }
    for (int i = 0; i < d->gap_n; i++)
        x->at[i] = rb_unit_shown(units, "mm", x->at[i]);
    return RB_OK;
}

int rb_api_design(rb_api *a, const char *result, int largest, const char *over, const char *subject,
                  double span, int evaluations)
{
    static const rb_option most = RB_DESIGN_EVALUATIONS_LINE(0), width = RB_DESIGN_SPAN_LINE(0);
    rb_case *c = copy_case(a, "design.", RB_CASE_DESIGN);
    rb_design d = {.largest = largest, .most = evaluations};
    const rb_design_observer observer = {see_evaluation, a};
    rb_status s = c ? rb_api_check_refusals(a, &a->why) : RB_ENOMEM;

    if (s == RB_OK)
        s = check_range(&most, evaluations, &a->why);
    if (s == RB_OK && !isnan(span))
        s = check_range(&width, span, &a->why);
    /* Lengths of the caller are in the units of the case, which are known once it is resolved. */
    if (s == RB_OK)
        s = rb_case_resolve(c, &a->why);
    if (s == RB_OK) {
        d.span = isnan(span) ? 0.0 : rb_unit_stored(rb_case_resolved(c)->units, "mm", span);
        s = rb_design_objective(result, &d, &a->why);
    }
    if (s == RB_OK)
        s = rb_design_variables(c, over, &d, &a->why);
    if (s == RB_OK)
        s = rb_design_constraints(c, subject, &d, &a->why);
    a->total = evaluations;
    if (s == RB_OK) {
        rb_api_call_begins(a);
        s = rb_design_solve(c, &observer, &d, &a->why);
        s = rb_api_call_ends(a, s);
        if (s >= 0 && !isnan(d.value) && keep_design(a, &d, rb_case_resolved(c)->units) != RB_OK)
            s = RB_ENOMEM;
    }
    if (s != RB_OK && c)
        s = rb_case_locate(c, s, &a->why);
    rb_design_free(&d);
    rb_case_free(c);
    return rb_api_ended(a, s);
}
