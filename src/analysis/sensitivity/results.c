/* Derivatives of results: how those of variants, moved along a tangent, change (theory-solvers.md,
 * D4); what of them is rounding. */
#include "analysis/sensitivity/internal.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A change of a result over the input's scale that is none, as a part of its size. */
static const double ROUNDING = 1e-11;

enum { PLACES = RB_SENSITIVITY_PLACES };

int rb_sensitivity_has(const rb_rolling_result *r)
{
    return r->kind == RB_RESULT_NUMBER && !r->no_derivative;
}

static double *number_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return (double *)(void *)((char *)s + r->offset);
}

/* NULL: s has no such column, or it has no derivative. */
static double *column_of(const rb_rolling_result *r, rb_rolling_solution *s)
{
    return rb_sensitivity_has(r) && rb_rolling_has_column(r, s)
               ? *(double **)(void *)((char *)s + r->offset)
               : NULL;
}

/* d = keep d + weight (x - less) of all that has derivatives; NULL: nothing. */
void rb_sensitivity_blend(rb_rolling_solution *d, double keep, const rb_rolling_solution *x,
                          double weight, const rb_rolling_solution *less)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r))
            *number_of(r, d) =
                (keep != 0.0 ? keep * *number_of(r, d) : 0.0) +
                (x ? weight * (rb_rolling_number(r, x) - (less ? rb_rolling_number(r, less) : 0.0))
                   : 0.0);
    }
    for (int k = 0; k < rb_rolling_solution_columns.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_columns.row[k];
        double *to = column_of(r, d);
        for (int i = 0; i < d->n && to; i++)
            to[i] = (keep != 0.0 ? keep * to[i] : 0.0) +
                    (x ? weight * (rb_rolling_entry(r, x, i) -
                                   (less ? rb_rolling_entry(r, less, i) : 0.0))
                       : 0.0);
    }
}

void rb_sensitivity_scale(rb_rolling_solution *s, double factor)
{
    rb_sensitivity_blend(s, factor, NULL, 0.0, NULL);
}

/* 1: the largest strain is that of no layer, a/(2R). */
int rb_sensitivity_follows_half_width(const rb_sensitivity *s)
{
    const rb_rolling_solution *at = &s->solution;

    return at->max_strain == 0.5 * at->half_width / rb_rolling_derive(s->model->rc).radius;
}

/* In the place of the second one the derivative: weights times what each has more than
 * the first one, so that what does not change has a derivative of exactly 0. */
void rb_sensitivity_combine(const rb_sensitivity *s, const rb_sensitivity_stencil *at, double step,
                            rb_rolling_solution *moved)
{
    const double half = s->solution.half_width;

    /* An edge that is found may jump between the places; what is proportional to the half-width
     * has the same factor beside it. */
    for (int j = 0; j < at->n; j++) {
        moved[j].peclet *= half / moved[j].half_width;
        if (rb_sensitivity_follows_half_width(s))
            moved[j].max_strain *= half / moved[j].half_width;
        moved[j].half_width = half;
    }
    for (int j = 1; j < at->n; j++)
        rb_sensitivity_blend(&moved[1], j > 1, &moved[j], at->weight[j] / step, &moved[0]);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (r->kind != RB_RESULT_WHOLE && !rb_sensitivity_has(r))
            *number_of(r, &moved[1]) = NAN;
    }
}

/* Derivatives of both temperatures (2n), from the results moved to the places of the stencil.  Only
 * powers > 0 heat, and small ones change their sign within the step: the elements heat that heat in
 * the solution, so that no kink is passed. */
static rb_status differentiate_heat(const rb_sensitivity *s, const rb_sensitivity_variants *v,
                                    const rb_rolling_solution *moved, double *warmer,
                                    rb_message *why)
{
    double *t = rb_alloc((size_t)s->n, 2);
    struct rb_rolling_conduction *conduction = NULL;
    rb_status status = t ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < v->at.n && status == RB_OK; k++) {
        status = rb_rolling_solution_heat(v->model[k].rc, &moved[k], &s->solution, &conduction, t,
                                          t + s->n, NULL, NULL, why);
        cblas_daxpy(2 * s->n, v->at.weight[k] / v->step, t, 1, warmer, 1);
    }
    rb_rolling_conduction_free(conduction);
    free(t);
    return status;
}

/* (D4) the results at the places of the stencil, moved along the tangent. */
rb_status rb_sensitivity_results(const rb_sensitivity *s, rb_sensitivity_variants *v,
                                 const rb_contact_state *tangent, rb_rolling_solution *d,
                                 rb_message *why)
{
    rb_rolling_solution moved[PLACES] = {{0}};
    double *warmer = s->solution.temperature ? rb_alloc((size_t)s->n, 2) : NULL;
    rb_status status = warmer || !s->solution.temperature ? RB_OK : RB_ENOMEM;
    /* though another element may come first at the places of the stencil */
    const int steepest =
        rb_rolling_law_depends_on_state(v->base->rc) ? rb_rolling_law_kappa_element(v->base) : -1;

    for (int k = 0; k < v->at.n && status == RB_OK; k++) {
        rb_rolling_variant_set(&v->base->state, tangent, v->at.place[k] * v->step,
                               &v->model[k].state);
        status = rb_rolling_variant_complete(&v->model[k], NULL, NULL, why);
        if (status == RB_OK)
            status = rb_rolling_bare_solution(&v->model[k], &moved[k], why);
        if (status == RB_OK && steepest >= 0)
            moved[k].kappa = rb_rolling_law_kappa_of(&v->model[k], steepest);
    }
    if (status == RB_OK && warmer)
        status = differentiate_heat(s, v, moved, warmer, why);
    if (status == RB_OK)
        rb_sensitivity_combine(s, &v->at, v->step, moved);
    if (status == RB_OK && warmer) {
        memcpy(moved[1].temperature, warmer, (size_t)s->n * sizeof *warmer);
        memcpy(moved[1].temperature_b, warmer + s->n, (size_t)s->n * sizeof *warmer);
    }
    *d = moved[1];
    for (int k = 0; k < v->at.n; k++)
        if (k != 1)
            rb_rolling_solution_free(&moved[k]);
    free(warmer);
    return status;
}

/* ---- Rounding ---------------------------------------------------------------------- */

/* Where both sides of a result are the same but for rounding, they are equal.  1: of all. */
int rb_sensitivity_unite_sides(rb_sensitivity_derivative *d)
{
    int all = 1;

    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(r, &d->value[0]), y = rb_rolling_number(r, &d->value[1]);
        if (!rb_sensitivity_has(r) || (isnan(x) && isnan(y)))
            continue;
        if (fabs(x - y) <= 1e-8 * fmax(fabs(x), fabs(y)))
            *number_of(r, &d->value[1]) = x;
        else
            all = 0;
    }
    return all;
}

double rb_sensitivity_rounding(const rb_rolling_case *rc, const rb_rolling_result *r, double value)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const char *unit = r->unit ? r->unit : "1";
    const double P = isnan(d.load) ? d.stress * d.half_width : d.load,
                 strain = d.half_width / d.radius;
    const int is_share = r->error_bar == RB_SCALE_ONE && !r->is_mean;
    const int is_loss =
        r->is_mean || r->error_bar == RB_SCALE_POWER || r->error_bar == RB_SCALE_WORK;
    const double usual = strcmp(unit, "mm") == 0              ? strain * d.half_width
                         : strcmp(unit, "MPa") == 0           ? d.stress
                         : strcmp(unit, "N/mm") == 0          ? (is_loss ? strain * P : P)
                         : strcmp(unit, "N") == 0             ? P * d.half_width
                         : strcmp(unit, "K") == 0 || is_share ? 1.0
                                                              : strain;

    return ROUNDING * fmax(usual, fabs(value));
}

void rb_sensitivity_clean(const rb_sensitivity *s, double scale, rb_rolling_solution *d)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        if (rb_sensitivity_has(r) &&
            fabs(*number_of(r, d)) * scale <
                rb_sensitivity_rounding(s->model->rc, r, rb_rolling_number(r, &s->solution)))
            *number_of(r, d) = 0.0;
    }
}
