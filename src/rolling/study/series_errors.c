/* Error bars of curves and histories: every entry of a column has one, as a scalar of a
 * solution has (theory-solvers.md 5.1). */
#include "rolling/case/derived.h"
#include "rolling/case/internal.h"
#include "rolling/results/columns.h"
#include "rolling/solve/law.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"
#include "rolling/study/internal.h"
#include "rolling/study/study.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rb_rolling_error_columns(const rb_rolling_results *columns, int rows, int runs,
                              const void *const run[], const void *another, const void *own,
                              void *errors)
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
            e[i] = (another ? rb_rolling_contact_error_of_phases(
                                  coarser, value[i], rb_rolling_column(column, another)[i])
                            : rb_rolling_contact_error(coarser, value[i])) +
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
        rb_rolling_error_columns(&rb_rolling_curve_columns, curve->n, runs, found, NULL, curve,
                                 errors);
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

/* placed: what the coarser runs found, at the steps of the run itself; another: likewise of one
 * between them, NULL where it was not solved; element: the longest one in contact. */
static rb_status history_errors(const rb_rolling_case *rc, const rb_rolling_history placed[],
                                const rb_rolling_history *another, double element,
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
    rb_rolling_error_columns(columns, own->n, runs, run, another, own, errors);
    /* What each mesh is off by: the tolerance of the solver, which a value that vanishes by
     * symmetry does not show, and of an edge, which equal elements show to a part of one. */
    double rounding = rc->contact.tol, P = 0.0, p0 = 0.0;
    for (int i = 0; i < own->n; i++) {
        rounding = fmax(rounding, own->residual[i]);
        P = fmax(P, own->normal_load[i]);
        p0 = fmax(p0, own->max_pressure[i]);
    }
    for (int k = 0; k < columns->n; k++) {
        const rb_rolling_result *r = &columns->row[k];
        if (!r->error_bar || !rb_rolling_has_column(r, errors))
            continue;
        const int is_edge = r->error_bar == RB_SCALE_WIDTH && rc->mesh == RB_MESH_UNIFORM;
        const double least =
            rounding * rb_rolling_error_unit(rc, r->error_bar, P, p0, own->half_width) +
            (is_edge ? 0.1 * element : 0.0);
        for (int i = 0; i < own->n; i++)
            rb_rolling_column(r, errors)[i] += least;
    }
    double pressure, mu; /* of tables that are finer than the elements */
    s = rb_rolling_missed_by_elements(rc, &pressure, &mu);
    for (int i = 0; i < own->n && s == RB_OK; i++) {
        errors->max_pressure[i] += pressure;
        errors->tangential_load[i] += mu * own->normal_load[i];
        if (mu > 0.0)
            errors->force_ratio[i] += mu / rb_rolling_largest_mu(rc);
    }
    /* Work of rows at rest in finite steps, whose error is of first order: twice what half as many
     * steps change. */
    double of_steps = 0.0;
    for (int i = 0; i < own->n; i++)
        errors->friction_work[i] += of_steps += 2.0 * own->halved_work[i];
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
        /* All elements slip, though A does not slide faster than stick allows, which is mu a/R and
         * what pressure strains unlike surfaces apart: one of them may hide stick, and Q falls
         * short of mu P by the square of its part of the contact, as Carter's. */
        const double most_slip = 1.2 *
                                 (rb_rolling_largest_mu(rc) + fabs(rb_rolling_derive(rc).dundurs)) *
                                 rb_rolling_error_strain(rc, a);
        if (!rests && own->stick[i] == 0 && !rb_rolling_force_is_given(rc) &&
            fabs(own->creepage[i]) <= most_slip) {
            const double share = 1.0 / ((double)contact * contact),
                         friction = share * rb_rolling_largest_mu(rc) * own->normal_load[i];
            errors->tangential_load[i] += friction;
            errors->force_ratio[i] += share;
            errors->torque_a[i] += friction * rb_rolling_larger_radius(rc);
            if (errors->torque_b)
                errors->torque_b[i] += friction * rb_rolling_larger_radius(rc);
        }
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

int rb_rolling_errors_of_cycle(const rb_rolling_history *h, rb_rolling_errors *errors)
{
    *errors = rb_rolling_no_row(RB_OK).errors;
    if (h->cycle_errors)
        errors->scalar.fretting = *h->cycle_errors;
    return h->cycle_errors != NULL;
}

/* Another run of the same way: what of it has error bars, at the steps of `own`, and its cycle. */
static rb_status run_again(const rb_rolling_case *rc, const rb_rolling_program *program,
                           const rb_rolling_observer *observer, const rb_rolling_history *own,
                           rb_rolling_history *placed, rb_rolling_solution *cycle, rb_message *why)
{
    rb_rolling_model model = {0};
    rb_rolling_history history = {0};
    rb_status s = rb_rolling_history_run(rc, program, observer, &model, &history, why);

    if (s == RB_OK) {
        const rb_rolling_results *columns = &rb_rolling_history_columns;
        s = rb_rolling_columns_alloc(columns, rc, 0, own->n, placed);
        for (int i = 0; i < columns->n && s == RB_OK; i++) {
            const rb_rolling_result *r = &columns->row[i];
            if (r->error_bar && rb_rolling_has_column(r, &history))
                place_column(&history, rb_rolling_column(r, &history), r->is_mean, own,
                             rb_rolling_column(r, placed));
        }
    }
    if (s == RB_OK && rc->fretting)
        s = cycle_of(&model, cycle, why);
    rb_rolling_model_free(&model);
    rb_rolling_history_free(&history);
    return s;
}

/* The case on one of the meshes whose spread is the bar. */
static rb_rolling_case mesh_case(const rb_rolling_case *rc, const rb_rolling_history *own, int k)
{
    rb_rolling_case other = rb_rolling_error_run(rc, k);

    /* rows of several steps stay, their steps are longer on a coarser mesh */
    if (rc->steps > 0 && own->substeps[own->n - 1] > 1)
        other.steps = rc->steps;
    return other;
}

rb_status rb_rolling_history_with_errors(const rb_rolling_case *rc,
                                         const rb_rolling_program *program,
                                         const rb_rolling_observer *observer,
                                         rb_rolling_model *model, rb_rolling_history *history,
                                         rb_message *why)
{
    rb_rolling_history placed[RB_ERROR_MESHES] = {0};
    rb_rolling_solution cycle[RB_ERROR_MESHES] = {{0}};
    rb_rolling_observer passed = observer ? *observer : (rb_rolling_observer){0};
    const rb_rolling_observer through = {passed.step ? see_coarser : NULL, &passed};
    const int runs = rb_rolling_error_runs(rc);
    rb_status s = rb_rolling_error_check(rc, why);

    memset(model, 0, sizeof *model);
    memset(history, 0, sizeof *history);
    if (s == RB_OK && program && program->time)
        s = rb_refuse(why, "error,history",
                      "a history in time has no error bars; compare with half the time step and "
                      "twice the contact elements");
    if (s == RB_OK)
        s = rb_rolling_history_run(rc, program, observer, model, history, why);
    for (int k = 0; k < runs && s == RB_OK; k++) {
        const rb_rolling_case coarser = mesh_case(rc, history, k);
        s = run_again(&coarser, program, &through, history, &placed[k], &cycle[k], why);
    }
    int has_another = 0;
    if (s == RB_OK) {
        const rb_rolling_case other = mesh_case(rc, history, RB_ERROR_ANOTHER_RUN);
        const rb_status found =
            run_again(&other, program, &through, history, &placed[RB_ERROR_ANOTHER_RUN],
                      &cycle[RB_ERROR_ANOTHER_RUN], why);
        has_another = found == RB_OK;
        s = found < 0 || found == RB_INTERRUPTED || rc->fretting ? found : RB_OK;
    }
    if (s == RB_OK && rc->fretting)
        s = cycle_errors(rc, cycle, &cycle[RB_ERROR_ANOTHER_RUN], model, history, why);
    if (s == RB_OK)
        s = (history->errors = calloc(1, sizeof *history->errors))
                ? history_errors(rc, placed, has_another ? &placed[RB_ERROR_ANOTHER_RUN] : NULL,
                                 rb_rolling_longest_element(model->state.n, model->state.zone,
                                                            model->bodies.f.h),
                                 history, history->errors)
                : RB_ENOMEM;
    for (int k = 0; k < RB_ERROR_MESHES; k++)
        rb_rolling_history_free(&placed[k]);
    return s;
}
