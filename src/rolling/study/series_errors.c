/* Error bars of curves and histories: every entry of a column has one, as a scalar of a
 * solution has (theory-solvers.md 5.1). */
#include "rolling/case/derived.h"
#include "rolling/results/columns.h"
#include "rolling/solve/law.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"
#include "rolling/study/internal.h"
#include "rolling/study/study.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of what the coarser runs found and of the series itself, over the same points. */
static void error_columns(const rb_rolling_results *columns, int rows, int runs,
                          const void *const run[], const void *own, void *errors)
{
    double coarser[RB_ERROR_RUNS];

    /* Each column with an error bar: of the contact mesh, of the elements outside it, and rounding
     * as a part of the largest entry. */
    for (int k = 0; k < columns->n; k++) {
        const rb_rolling_result *column = &columns->row[k];
        if (column->error_bar == RB_SCALE_NONE || !rb_rolling_has_column(column, own))
            continue;
        const double *value = rb_rolling_column(column, own);
        double *e = rb_rolling_column(column, errors), largest = 0.0;
        for (int i = 0; i < rows; i++)
            largest = fmax(largest, fabs(value[i]));
        for (int i = 0; i < rows; i++) {
            for (int r = 0; r < runs; r++)
                coarser[r] = rb_rolling_column(column, run[r])[i];
            e[i] = rb_rolling_contact_error(coarser, value[i]) +
                   rb_rolling_boundary_error(runs, coarser, value[i]) + DBL_EPSILON * largest;
        }
    }
}

/* ---- Curves ------------------------------------------------------------------------ */

rb_status rb_rolling_curve_with_errors(const rb_rolling_case *rc, const rb_rolling_range *range,
                                       rb_rolling_point *point, void *context,
                                       rb_rolling_curve *curve, rb_rolling_curve *errors,
                                       rb_message *why)
{
    rb_rolling_curve run[RB_ERROR_RUNS] = {0};
    const int runs = rb_rolling_error_runs(rc);
    rb_status s = rb_rolling_error_check(rc, why);

    memset(curve, 0, sizeof *curve);
    memset(errors, 0, sizeof *errors);
    if (s == RB_OK)
        s = rb_rolling_curve_observe(rc, range, point, context, curve, why);
    for (int k = 0; k < runs && s == RB_OK; k++) {
        const rb_rolling_case coarser = rb_rolling_error_run(rc, k);
        s = rb_rolling_curve_observe(&coarser, range, point, context, &run[k], why);
    }
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_curve_columns, rc, 0, curve->n, errors);
    if (s == RB_OK) {
        const void *found[RB_ERROR_RUNS];
        double free_creepage[RB_ERROR_RUNS];

        for (int k = 0; k < runs; k++) {
            found[k] = &run[k];
            free_creepage[k] = run[k].free_creepage;
        }
        errors->n = curve->n;
        errors->free_creepage =
            rb_rolling_contact_error(free_creepage, curve->free_creepage) +
            rb_rolling_boundary_error(runs, free_creepage, curve->free_creepage) +
            DBL_EPSILON * rb_rolling_largest_mu(rc) * rb_rolling_derive(rc).strain;
        error_columns(&rb_rolling_curve_columns, curve->n, runs, found, curve, errors);
        double pressure, mu = 0.0; /* of tables that are finer than the elements */
        s = rb_rolling_missed_by_elements(rc, &pressure, &mu);
        for (int i = 0; i < curve->n; i++) {
            if (mu > 0.0)
                errors->force_ratio[i] += mu / rb_rolling_largest_mu(rc);
            errors->stick_ratio[i] += curve->stick_step;
            if (errors->yield_ratio)
                errors->yield_ratio[i] += curve->stick_step;
            errors->dissipation[i] +=
                rb_rolling_edge_power(rc, curve->normal_load[i], curve->creepage[i],
                                      curve->half_width, curve->stick_step);
        }
    }
    for (int k = 0; k < runs; k++) {
        curve->seconds += run[k].seconds;
        rb_rolling_curve_free(&run[k]);
    }
    return s;
}

/* ---- Histories --------------------------------------------------------------------- */

static int steps_at_rest(const rb_rolling_history *h)
{
    int k = 0;
    while (k < h->n && h->distance[k] == 0.0)
        k++;
    return k;
}

/* Where the entry of a rolled step belongs. */
static double place_of_entry(const rb_rolling_history *h, int is_mean, int k, int rest)
{
    const double before = k > rest ? h->distance[k - 1] : 0.0;

    return is_mean ? 0.5 * (before + h->distance[k]) : h->distance[k];
}

/* A column at the steps of another history.  Rolling starts from the last state at rest,
 * but not a mean over a rolled step. */
static void place_column(const rb_rolling_history *from, const double *column, int is_mean,
                         const rb_rolling_history *to, double *out)
{
    const int rest = steps_at_rest(from);
    int k = is_mean ? rest : rest - 1;

    for (int i = 0; i < to->n; i++) {
        if (to->distance[i] == 0.0) {
            out[i] = column[i];
            continue;
        }
        const double x = place_of_entry(to, is_mean, i, rest);
        while (k + 2 < from->n && place_of_entry(from, is_mean, k + 1, rest) < x)
            k++;
        /* Linear between entries k and k + 1 of a column; beyond the last one that. */
        if (k + 1 >= from->n)
            out[i] = column[from->n - 1];
        else {
            const double x0 = place_of_entry(from, is_mean, k, rest),
                         x1 = place_of_entry(from, is_mean, k + 1, rest);
            out[i] = column[k] + (column[k + 1] - column[k]) * (x - x0) / (x1 - x0);
        }
    }
}

/* An error changes its sign wherever an edge passes an element: each rolled step takes
 * the largest of its own and its neighbours'. */
static rb_status widen_errors(const rb_rolling_history *h, double *error)
{
    const int rest = steps_at_rest(h), rolled = h->n - rest;
    double *own = rb_alloc((size_t)h->n, 1);

    if (!own)
        return RB_ENOMEM;
    memcpy(own, error, (size_t)h->n * sizeof *own);
    for (int i = 0; i < rolled; i++)
        for (int k = i > 0 ? i - 1 : 0; k <= i + 1 && k < rolled; k++)
            error[rest + i] = fmax(error[rest + i], own[rest + k]);
    free(own);
    return RB_OK;
}

/* placed: what the coarser runs found, at the steps of the run itself. */
static rb_status history_errors(const rb_rolling_case *rc, const rb_rolling_history placed[],
                                const rb_rolling_history *own, rb_rolling_history *errors)
{
    const int runs = rb_rolling_error_runs(rc);
    const rb_rolling_results *columns = &rb_rolling_history_columns;
    const void *run[RB_ERROR_RUNS];
    rb_status s = rb_rolling_columns_alloc(columns, rc, 0, own->n, errors);

    if (s != RB_OK)
        return s;
    errors->n = own->n;
    for (int k = 0; k < runs; k++)
        run[k] = &placed[k];
    error_columns(columns, own->n, runs, run, own, errors);
    double pressure, mu; /* of tables that are finer than the elements */
    s = rb_rolling_missed_by_elements(rc, &pressure, &mu);
    for (int i = 0; i < own->n && s == RB_OK; i++) {
        errors->max_pressure[i] += pressure;
        errors->tangential_load[i] += mu * own->normal_load[i];
        if (mu > 0.0)
            errors->force_ratio[i] += mu / rb_rolling_largest_mu(rc);
    }
    /* Slip over less than an element of each step, and what its work comes to. */
    double work = 0.0;
    for (int i = 0; i < own->n && s == RB_OK; i++) {
        const int contact = own->stick[i] + own->slipping[i], rests = i < steps_at_rest(own);
        const double a = 0.5 * (own->contact_to[i] - own->contact_from[i]);
        if (!(contact > 0 && a > 0.0))
            continue;
        const double before = i > 0 ? own->shift[i - 1] : 0.0;
        const double slip = rests ? (own->shift[i] - before) / a : own->creepage[i];
        const double power = rb_rolling_edge_power(rc, own->normal_load[i], slip, a, 1.0 / contact);
        const double rolled = i > 0 ? own->distance[i] - own->distance[i - 1] : own->distance[i];
        if (!rests)
            errors->dissipation[i] += power;
        work += power * (rests ? a : rolled * own->half_width);
        errors->friction_work[i] += work;
    }
    for (int k = 0; k < columns->n && s == RB_OK; k++)
        if (columns->row[k].error_bar && rb_rolling_has_column(&columns->row[k], errors))
            s = widen_errors(own, rb_rolling_column(&columns->row[k], errors));
    return s;
}

/* context: the observer of the run itself. */
static int see_coarser(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                       int steps, void *context)
{
    const rb_rolling_observer *of_run = context;

    (void)model;
    (void)history;
    return of_run->step(NULL, NULL, step, steps, of_run->context);
}

/* What fretting has done in the last cycle. */
static rb_status cycle_of(const rb_rolling_model *model, rb_rolling_solution *scalars,
                          rb_message *why)
{
    rb_rolling_solution solution;
    const rb_status s = rb_rolling_model_solution(model, &solution, why);
    *scalars = rb_rolling_scalars_of(&solution);
    rb_rolling_solution_free(&solution);
    return s;
}

/* A largest value "..._max" is that of an element: between it and its neighbours in contact there
 * may be more, as much as these differ from it.  What is largest at an edge has the uncertainty of
 * an element on either side. */
static double between_elements(const rb_rolling_result *r, const rb_rolling_solution *s)
{
    char name[40];
    snprintf(name, sizeof name, "%.*s", (int)strlen(r->name) - (int)strlen("_max"), r->name);
    const rb_rolling_result *column = rb_rolling_find_result(&rb_rolling_solution_columns, name);
    const double *x = column ? rb_rolling_column(column, s) : NULL, most = rb_rolling_number(r, s);
    double apart = 0.0;
    int i = 0;

    if (!x)
        return 0.0;
    for (int k = 1; k < s->n; k++)
        i = x[k] > x[i] ? k : i;
    if (most > x[i] * (1.0 + 1e-9))
        return most * 2.0 * s->h[i] / s->half_width;
    for (int k = i > 0 ? i - 1 : 0; k <= i + 1 && k < s->n; k++)
        if (s->p[k] > 0.0)
            apart = fmax(apart, fabs(x[i] - x[k]));
    return apart;
}

/* From the coarser runs, as all error bars, from another one because stick ends and edges pass
 * elements and three meshes agree by chance, and from what lies between elements. */
static rb_status cycle_errors(const rb_rolling_case *rc, const rb_rolling_solution run[],
                              const rb_rolling_solution *another, const rb_rolling_model *model,
                              rb_rolling_history *h, rb_message *why)
{
    const rb_rolling_results *scalars = &rb_rolling_solution_scalars;
    const int runs = rb_rolling_error_runs(rc);
    rb_rolling_solution own, errors = rb_rolling_no_row(RB_OK).solution;
    double coarser[RB_ERROR_RUNS];
    rb_status s = rb_rolling_model_solution(model, &own, why);

    h->cycle_errors = calloc(1, sizeof *h->cycle_errors);
    s = s == RB_OK && !h->cycle_errors ? RB_ENOMEM : s;
    for (int k = 0; k < scalars->n && s == RB_OK; k++) {
        const rb_rolling_result *r = &scalars->row[k];
        const int of_cycle = r->condition == RB_FOR_FRETTING || r->condition == RB_FOR_FRETTING_B;
        if (!of_cycle || !r->error_bar || !rb_rolling_has_result(r, rc, 0))
            continue;
        const double value = rb_rolling_number(r, &own);
        for (int j = 0; j < runs; j++)
            coarser[j] = rb_rolling_number(r, &run[j]);
        rb_rolling_set_number(
            r, &errors,
            rb_rolling_contact_error_with(coarser, value, rb_rolling_number(r, another), 0) +
                rb_rolling_boundary_error(runs, coarser, value) + between_elements(r, &own) +
                DBL_EPSILON * fabs(value));
    }
    if (s == RB_OK)
        *h->cycle_errors = errors.fretting;
    rb_rolling_solution_free(&own);
    return s;
}

/* The cycle on a mesh between the coarser ones and that of the case. */
static rb_status run_another(const rb_rolling_case *rc, const rb_rolling_program *program,
                             const rb_rolling_observer *observer, rb_rolling_solution *cycle,
                             rb_message *why)
{
    rb_rolling_case other = *rc;
    rb_rolling_model model = {0};
    rb_rolling_history history = {0};

    other.contact_elements = (int)(0.85 * rc->contact_elements);
    rb_status s = rb_rolling_history_run(&other, program, observer, &model, &history, why);
    if (s == RB_OK)
        s = cycle_of(&model, cycle, why);
    rb_rolling_model_free(&model);
    rb_rolling_history_free(&history);
    return s;
}

int rb_rolling_errors_of_cycle(const rb_rolling_history *h, rb_rolling_errors *errors)
{
    *errors = rb_rolling_no_row(RB_OK).errors;
    if (h->cycle_errors)
        errors->scalar.fretting = *h->cycle_errors;
    return h->cycle_errors != NULL;
}

/* Coarser runs of the same way, at its steps. */
static rb_status run_coarser(const rb_rolling_case *rc, const rb_rolling_program *program,
                             const rb_rolling_observer *observer, const rb_rolling_history *own,
                             rb_rolling_history placed[], rb_rolling_solution cycle[],
                             rb_message *why)
{
    rb_rolling_observer passed = observer ? *observer : (rb_rolling_observer){0};
    const rb_rolling_observer through = {passed.step ? see_coarser : NULL, &passed};
    const int runs = rb_rolling_error_runs(rc);
    rb_status s = RB_OK;

    for (int k = 0; k < runs && s == RB_OK; k++) {
        rb_rolling_case coarser = rb_rolling_error_run(rc, k);
        /* rows of several steps stay, their steps are longer on a coarser mesh */
        if (rc->steps > 0 && own->substeps[own->n - 1] > 1)
            coarser.steps = rc->steps;
        rb_rolling_model model = {0};
        rb_rolling_history history = {0};
        s = rb_rolling_history_run(&coarser, program, &through, &model, &history, why);
        if (s == RB_OK) {
            /* What of the history has error bars, at the steps of another one. */
            rb_rolling_history *out = &placed[k];
            const rb_rolling_results *columns = &rb_rolling_history_columns;
            s = rb_rolling_columns_alloc(columns, rc, 0, own->n, out);

            for (int i = 0; i < columns->n && s == RB_OK; i++) {
                const rb_rolling_result *r = &columns->row[i];
                if (r->error_bar && rb_rolling_has_column(r, &history))
                    place_column(&history, rb_rolling_column(r, &history), r->is_mean, own,
                                 rb_rolling_column(r, out));
            }
        }
        if (s == RB_OK && rc->fretting)
            s = cycle_of(&model, &cycle[k], why);
        rb_rolling_model_free(&model);
        rb_rolling_history_free(&history);
    }
    return s;
}

rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         const rb_rolling_observer *observer,
                                         rb_rolling_model *model, rb_rolling_history *history,
                                         rb_message *why)
{
    rb_rolling_history placed[RB_ERROR_RUNS] = {0};
    rb_rolling_solution cycle[RB_ERROR_RUNS] = {{0}}, another = {0};
    rb_rolling_observer passed = observer ? *observer : (rb_rolling_observer){0};
    const rb_rolling_observer through = {passed.step ? see_coarser : NULL, &passed};
    rb_status s = rb_rolling_error_check(rc, why);

    memset(model, 0, sizeof *model);
    memset(history, 0, sizeof *history);
    if (s == RB_OK && program && program->time)
        s = rb_refuse(why, "error,history",
                      "a history in time has no error bars; compare with half the time step and "
                      "twice the contact elements");
    if (s == RB_OK)
        s = rb_rolling_history_run(rc, program, observer, model, history, why);
    if (s == RB_OK)
        s = run_coarser(rc, program, observer, history, placed, cycle, why);
    if (s == RB_OK && rc->fretting)
        s = run_another(rc, program, &through, &another, why);
    if (s == RB_OK && rc->fretting)
        s = cycle_errors(rc, cycle, &another, model, history, why);
    if (s == RB_OK)
        s = (history->errors = calloc(1, sizeof *history->errors))
                ? history_errors(rc, placed, history, history->errors)
                : RB_ENOMEM;
    for (int k = 0; k < RB_ERROR_RUNS; k++)
        rb_rolling_history_free(&placed[k]);
    return s;
}

/* ---- Wear -------------------------------------------------------------------------- */

/* The error of the steps, from a run with others: what it deviates by at its own entries, linear
 * over the way. */
static rb_status add_step_errors(const rb_rolling_wear_history *own,
                                 const rb_rolling_wear_history *other,
                                 rb_rolling_wear_history *errors)
{
    const rb_rolling_results *columns = &rb_rolling_wear_columns;
    double *off = rb_alloc((size_t)other->n, 1);

    if (!off)
        return RB_ENOMEM;
    for (int k = 0; k < columns->n; k++) {
        const rb_rolling_result *c = &columns->row[k];
        if (!c->error_bar || !rb_rolling_has_column(c, own))
            continue;
        const rb_rolling_table mine = {own->n, own->way, rb_rolling_column(c, own)},
                               deviation = {other->n, other->way, off};
        const double *theirs = rb_rolling_column(c, other);
        double *e = rb_rolling_column(c, errors);
        for (int j = 0; j < other->n; j++)
            off[j] = fabs(theirs[j] - rb_rolling_table_at(&mine, other->way[j]));
        for (int i = 0; i < own->n; i++)
            e[i] += rb_rolling_table_at(&deviation, own->way[i]);
    }
    free(off);
    return RB_OK;
}

static rb_status wear_errors(const rb_rolling_case *rc, const rb_rolling_wear_history run[],
                             int runs, const rb_rolling_wear_history *other,
                             rb_rolling_wear_history *own)
{
    const void *found[RB_ERROR_RUNS];
    rb_rolling_wear_history *errors = own->errors = calloc(1, sizeof *errors);
    rb_status s = errors ? rb_rolling_columns_alloc(&rb_rolling_wear_columns, rc, 0, own->n, errors)
                         : RB_ENOMEM;

    if (s != RB_OK)
        return s;
    /* Columns that the run itself has not. */
    double **const absent[][2] = {{&errors->worn_b, &own->worn_b},
                                  {&errors->max_depth_b, &own->max_depth_b},
                                  {&errors->radius_b, &own->radius_b},
                                  {&errors->stroke, &own->stroke}};
    for (size_t k = 0; k < sizeof absent / sizeof *absent; k++)
        if (!*absent[k][1]) {
            free(*absent[k][0]);
            *absent[k][0] = NULL;
        }
    errors->n = own->n;
    errors->slides = own->slides;
    errors->rolls = own->rolls;
    memcpy(errors->way, own->way, (size_t)own->n * sizeof *own->way);
    for (int k = 0; k < runs; k++)
        found[k] = &run[k];
    error_columns(&rb_rolling_wear_columns, own->n, runs, found, own, errors);
    s = add_step_errors(own, other, errors);
    for (int i = 0; i < own->n && own->stick_edge; i++)
        errors->max_pressure[i] = NAN;
    return s;
}

rb_status rb_rolling_wear_with_errors(const rb_rolling_case *rc, const rb_rolling_wear *wear,
                                      const rb_rolling_wear_observer *observer,
                                      rb_rolling_wear_history *history, rb_rolling_solution *last,
                                      rb_message *why)
{
    rb_rolling_wear_history run[RB_ERROR_RUNS + 1] = {{0}};
    const int runs = rb_rolling_error_runs(rc);
    rb_status s = rb_rolling_error_check(rc, why);

    memset(history, 0, sizeof *history);
    memset(last, 0, sizeof *last);
    if (s == RB_OK)
        s = rb_rolling_wear_run(rc, wear, observer, history, last, why);
    for (int k = 0; k <= runs && s == RB_OK; k++) {
        rb_rolling_wear other = *wear;
        rb_rolling_solution end = {0};
        /* the last run has other steps: half as many, or two for one */
        const rb_rolling_case coarser = k < runs ? rb_rolling_error_run(rc, k) : *rc;
        if (k == runs)
            other.steps = wear->steps > 1 ? wear->steps / 2 : 2;
        s = rb_rolling_wear_run(&coarser, &other, NULL, &run[k], &end, why);
        rb_rolling_solution_free(&end);
    }
    if (s == RB_OK)
        s = wear_errors(rc, run, runs, &run[runs], history);
    for (int k = 0; k <= runs; k++)
        rb_rolling_wear_history_free(&run[k]);
    return s;
}
