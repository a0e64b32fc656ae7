/* The least sum of squares of a fit (theory-solvers.md, D5): Levenberg's and Marquardt's method
 * (GSL's) and, where zones change at the minimum, Gauss and Newton's method for residuals
 * with kinks. */
#include "analysis/fit/fit.h"

#include <gsl/gsl_multifit_nlinear.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

/* Of a round. */
enum { STEPS = 100 };
/* A part of chi^2 that is not worth a step. */
static const double CONVERGED = 1e-10;
/* Where the model has several solutions, the sum of squares has jumps, and less than this part is
 * not worth a search among them. */
static const double CONVERGED_WITH_JUMPS = 1e-2;
/* A part that an undamped step may be trusted with. */
static const double NEAR = 0.6;

/* ---- Trials ------------------------------------------------------------------------ */

void rb_case_fit_clip(const rb_case_parameter *of, double *x)
{
    const double inside = 1e-9 * of->scale;

    *x = fmin(fmax(*x, of->low + (of->low_open ? inside : 0.0)),
              of->high - (of->high_open ? inside : 0.0));
}

int rb_case_fit_is_held(const fit_problem *p, int j, double x)
{
    const rb_case_parameter *of = &p->fit->parameter[j];
    const double down = fit_dot(p->points, fit_column(p, j), p->f), near = 1e-8 * of->scale;

    return (x <= of->low + near && down > 0.0) || (x >= of->high - near && down < 0.0);
}

/* An element that is in another zone at a trial than at the accepted numbers.  Where it
 * changes, the residual of its point is continuous, but its derivatives are not. */
typedef struct {
    int point, element, zone[2];
    /* With the accepted numbers: what the residual of the point is more in the other zone,
     * and the derivatives of that. */
    double more, rate[RB_CASE_FIT_MAX];
    double sign; /* of `more` in the zone that the element has; 0: not known yet */
} kink;
/* So many are taken into account, three choices for each. */
enum { KINKS = 3 };

/* What GSL's solver asks, in the scales of the parameters: residuals at every trial,
 * their derivatives where it accepts one. */
typedef struct {
    fit_problem *p;
    double theta[RB_CASE_FIT_MAX]; /* of the last trial, within its bounds */
    double accepted[RB_CASE_FIT_MAX];
    gsl_vector *x;       /* the accepted numbers over their scales */
    int known, has_rows; /* 1: theta has f and chi^2; it was accepted, and has J */
    int clipped, held[RB_CASE_FIT_MAX];
    double chi2, accepted_chi2, worst;
    double promise; /* what the linear model promises, as a part of accepted_chi2 */
    kink kink[KINKS];
    int most;         /* steps */
    int kinks, stops; /* stops: 1: a trial that is worse, beyond kinks, stops GSL's solver */
    rb_status status; /* of the last trial */
    rb_status accepted_status;
    const rb_case_fit_observer *observer;
    rb_message *why;
} state;

static double over_scale(const state *at, const double *theta, size_t j)
{
    return theta[j] / at->p->fit->parameter[j].scale;
}

/* Makes x the last trial. */
static void evaluate_at(const gsl_vector *x, state *at)
{
    /* A step changes the distance from an end that does not belong to the range, which is
     * no minimum, by this factor at most. */
    static const double MOST = 10.0;
    fit_problem *p = at->p;
    double theta[RB_CASE_FIT_MAX];
    const size_t bytes = (size_t)p->n * sizeof *theta;

    at->clipped = 0;
    for (int j = 0; j < p->n; j++) {
        const rb_case_parameter *of = &p->fit->parameter[j];
        const double wanted = gsl_vector_get(x, (size_t)j) * of->scale,
                     above = at->accepted[j] - of->low, below = of->high - at->accepted[j];
        theta[j] = wanted;
        rb_case_fit_clip(of, &theta[j]);
        if (p->accepted >= 0 && of->low_open && of->low == of->from && isfinite(of->low))
            theta[j] = fmin(fmax(theta[j], of->low + above / MOST), of->low + above * MOST);
        if (p->accepted >= 0 && of->high_open && of->high == of->to && isfinite(of->high))
            theta[j] = fmin(fmax(theta[j], of->high - below * MOST), of->high - below / MOST);
        at->clipped |= theta[j] != wanted;
    }
    if (at->known && memcmp(theta, at->theta, bytes) == 0)
        return;
    memcpy(at->theta, theta, bytes);
    at->known = 1;
    at->has_rows = p->accepted >= 0 && memcmp(theta, at->accepted, bytes) == 0;
    if (!at->has_rows) {
        at->status = rb_case_fit_try(p, theta, &at->chi2, at->why);
        return;
    }
    at->status = RB_OK;
    at->chi2 = at->accepted_chi2;
    for (int k = 0; k < p->points; k++)
        p->f[k] = rb_case_fit_residual(p, k, p->fit->model[k]);
}

rb_status rb_case_fit_tell(rb_case_fit *fit, const rb_case_fit_observer *o, double chi2,
                           const double *theta, rb_message *why)
{
    fit->iterations++;
    return o && o->step && o->step(fit->iterations, chi2, fit->n, theta, o->context)
               ? rb_fail(why, RB_INTERRUPTED, "fit: interrupted after %d step%s", fit->iterations,
                         rb_plural(fit->iterations))
               : RB_OK;
}

static rb_status report_accepted(const state *at)
{
    return rb_case_fit_tell(at->p->fit, at->observer, at->accepted_chi2, at->accepted, at->why);
}

/* ---- Kinks ------------------------------------------------------------------------- */

/* Adds the elements that have other zones at the last trial.  Returns 1: there are some,
 * and not too many. */
static int find_kinks(state *at)
{
    const fit_problem *p = at->p;
    int found = 0;

    for (int k = 0; k < p->points; k++) {
        const rb_contact_state *now = &p->at[k].solved[p->accepted].state,
                               *then = &p->at[k].solved[p->accepted == 0].state;
        for (int i = 0; i < now->n; i++) {
            int known = now->zone[i] == then->zone[i];
            for (int j = 0; j < at->kinks; j++)
                known |= at->kink[j].point == k && at->kink[j].element == i;
            if (!known && at->kinks == KINKS)
                return 0;
            if (!known)
                at->kink[at->kinks++] =
                    (kink){k, i, {now->zone[i], then->zone[i]}, 0.0, {0.0}, 0.0};
            found |= !known;
        }
    }
    return found;
}

/* Computes `more` of a kink and its derivatives. */
static rb_status look_beyond(const state *at, kink *of)
{
    fit_problem *p = at->p;
    const int k = of->point, own = p->at[k].solved[p->accepted].state.zone[of->element];
    double f = NAN;
    const rb_status s = rb_case_fit_extend(p, at->accepted, k, of->element,
                                           of->zone[of->zone[0] == own], &f, of->rate, at->why);

    of->more = f - rb_case_fit_residual(p, k, p->fit->model[k]);
    for (int j = 0; j < p->n; j++)
        of->rate[j] -= fit_column(p, j)[k];
    if (of->sign == 0.0)
        of->sign = of->more < 0.0 ? -1.0 : 1.0;
    return s;
}

/* GSL's solver stops with it at a trial that is worse, beyond kinks. */
enum { BEYOND_KINKS = GSL_EROUND };
/* Where a step goes at a kink. */
enum { STAYS, ENDS, CROSSES, CHOICES };

/* The step d, over scales, to the least sum of squares of residuals that are linear on
 * either side of each kink: the least of those that go where they are meant to go. */
static rb_status step_to_least(const state *at, int kinks, double *d, double *least)
{
    const fit_problem *p = at->p;
    const size_t points = (size_t)p->points, ld = (size_t)p->n;
    double *A = rb_alloc(points, ld + 1);
    int number[RB_CASE_FIT_MAX],
        n = 0, choices = 1; /* number: of those that move f and that no bound holds */

    *least = INFINITY;
    memset(d, 0, ld * sizeof *d);
    if (!A)
        return rb_fail(at->why, RB_ENOMEM, "out of memory for a step");
    double *f = A + points * ld;
    for (int j = 0; j < p->n; j++)
        if (!at->held[j] && rb_norm_inf(points, fit_column(p, j)) > 0.0)
            number[n++] = j;
    for (int j = 0; j < kinks; j++)
        choices *= CHOICES;
    for (int choice = 0; choice < choices; choice++) {
        double B[KINKS][RB_CASE_FIT_MAX], end[KINKS], x[RB_CASE_FIT_MAX], sum = 0.0;
        int ends = 0, holds = 1;
        for (size_t k = 0; k < points; k++) {
            f[k] = -rb_case_fit_residual(p, (int)k, p->fit->model[k]);
            for (int i = 0; i < n; i++)
                A[k * ld + (size_t)i] =
                    fit_column(p, number[i])[k] * p->fit->parameter[number[i]].scale;
        }
        for (int j = 0, rest = choice; j < kinks; j++, rest /= CHOICES) {
            const kink *of = &at->kink[j];
            const int crosses = rest % CHOICES == CROSSES;
            f[of->point] -= crosses ? of->more : 0.0;
            end[ends] = -of->more;
            for (int i = 0; i < n; i++) {
                B[ends][i] = of->rate[number[i]] * p->fit->parameter[number[i]].scale;
                A[(size_t)of->point * ld + (size_t)i] += crosses ? B[ends][i] : 0.0;
            }
            ends += rest % CHOICES == ENDS;
        }
        const int info = ends > n ? 1
                                  : LAPACKE_dgglse(LAPACK_ROW_MAJOR, p->points, n, ends, A, p->n,
                                                   B[0], RB_CASE_FIT_MAX, f, end, x);
        if (rb_lapack_status(info) == RB_ENOMEM) {
            free(A);
            return rb_fail(at->why, RB_ENOMEM, "out of memory for a step");
        }
        if (info != 0)
            continue;
        for (int k = n - ends; k < p->points; k++)
            sum += f[k] * f[k];
        for (int j = 0, rest = choice; j < kinks; j++, rest /= CHOICES) {
            const kink *of = &at->kink[j];
            double more = of->more;
            for (int i = 0; i < n; i++)
                more += of->rate[number[i]] * p->fit->parameter[number[i]].scale * x[i];
            holds &=
                rest % CHOICES == ENDS || (rest % CHOICES == CROSSES) == (more * of->sign < 0.0);
        }
        if (!holds || !(sum < *least))
            continue;
        *least = sum;
        for (int i = 0; i < n; i++)
            d[number[i]] = x[i];
    }
    free(A);
    return RB_OK;
}

/* Accepts the last trial, which was x. */
static void accept(const gsl_vector *x, state *at)
{
    fit_problem *p = at->p;
    double d[RB_CASE_FIT_MAX], least = 0.0;

    if (at->status != RB_OK || at->has_rows)
        return;
    at->accepted_status = rb_case_fit_accept(p, at->theta, at->why);
    at->has_rows = at->stops = 1;
    memcpy(at->accepted, at->theta, sizeof at->theta);
    at->accepted_chi2 = at->chi2;
    gsl_vector_memcpy(at->x, x);
    for (size_t j = 0; j < (size_t)p->n && at->clipped; j++)
        gsl_vector_set(at->x, j, over_scale(at, at->accepted, j));
    for (int j = 0; j < p->n && at->accepted_status == RB_OK; j++)
        at->held[j] = rb_case_fit_is_held(p, j, at->theta[j]);
    if (at->accepted_status == RB_OK)
        at->accepted_status = step_to_least(at, 0, d, &least);
    at->promise = isfinite(least) ? 1.0 - least / at->accepted_chi2 : 1.0;
}

/* Gauss's and Newton's method from the accepted numbers, where the least sum of squares
 * may lie at kinks.  *done: 1: it has converged; 0: a step was not successful. */
static rb_status descend_at_kinks(state *at, int *done)
{
    fit_problem *p = at->p;
    double d[RB_CASE_FIT_MAX], least;
    gsl_vector *x = gsl_vector_alloc((size_t)p->n);
    int goes_on = 1;
    rb_status s = x ? RB_OK : rb_fail(at->why, RB_ENOMEM, "out of memory for a step");

    while (s == RB_OK && goes_on) {
        rb_status beyond = RB_OK;
        for (int j = 0; j < at->kinks && beyond == RB_OK; j++)
            beyond = look_beyond(at, &at->kink[j]);
        s = beyond == RB_ENOMEM ? beyond : step_to_least(at, at->kinks, d, &least);
        *done = s == RB_OK && beyond == RB_OK && isfinite(least) &&
                at->accepted_chi2 - least <= CONVERGED * at->accepted_chi2;
        if (s != RB_OK || beyond != RB_OK || *done || !isfinite(least))
            break;
        for (size_t j = 0; j < (size_t)p->n; j++)
            gsl_vector_set(x, j, gsl_vector_get(at->x, j) + d[j]);
        evaluate_at(x, at);
        if (at->status == RB_OK && at->chi2 < at->accepted_chi2) {
            accept(x, at);
            s = at->accepted_status == RB_OK ? report_accepted(at) : at->accepted_status;
            goes_on = p->fit->iterations < at->most;
        } else {
            s = at->status == RB_ENOMEM ? at->status : RB_OK;
            goes_on = at->status == RB_OK && !at->has_rows && find_kinks(at);
        }
    }
    at->kinks = at->stops = 0;
    gsl_vector_free(x);
    return s;
}

/* ---- Levenberg and Marquardt ------------------------------------------------------- */

/* Where a point has no solution the residuals are larger than any so far. */
static int residuals(const gsl_vector *x, void *context, gsl_vector *f)
{
    state *at = context;

    evaluate_at(x, at);
    if (at->status == RB_ENOMEM)
        return GSL_ENOMEM;
    const int fails = at->status != RB_OK;
    for (int k = 0; k < at->p->points; k++)
        gsl_vector_set(f, (size_t)k, fails ? at->worst : at->p->f[k]);
    if (!fails)
        at->worst = fmax(at->worst, 10.0 * sqrt(at->chi2));
    at->kinks = 0;
    const int is_worse =
        !fails && at->p->accepted >= 0 && !at->has_rows && at->chi2 >= at->accepted_chi2;
    return is_worse && at->stops && at->promise <= NEAR && find_kinks(at) ? BEYOND_KINKS
                                                                          : GSL_SUCCESS;
}

static int rows(const gsl_vector *x, void *context, gsl_matrix *J)
{
    state *at = context;
    fit_problem *p = at->p;

    evaluate_at(x, at);
    accept(x, at);
    if (at->status != RB_OK || at->accepted_status != RB_OK)
        return GSL_EFAILED;
    for (int j = 0; j < p->n; j++)
        for (int k = 0; k < p->points; k++)
            gsl_matrix_set(J, (size_t)k, (size_t)j,
                           at->held[j] ? 0.0 : fit_column(p, j)[k] * p->fit->parameter[j].scale);
    return GSL_SUCCESS;
}

rb_status rb_case_fit_descend(fit_problem *p, double *theta, const rb_case_fit_observer *observer,
                              rb_message *why)
{
    const size_t n = (size_t)p->n, points = (size_t)p->points;
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    how.scale = gsl_multifit_nlinear_scale_marquardt;
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, points, n);
    state at = {.p = p,
                .x = gsl_vector_alloc(n),
                .worst = 1.0,
                .most = p->fit->iterations + STEPS,
                .observer = observer,
                .why = why};
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .df = rows, .n = points, .p = n, .params = &at};
    gsl_vector *x = gsl_vector_alloc(n);
    int done = 0;
    rb_status s = w && x && at.x ? RB_OK : rb_fail(why, RB_ENOMEM, "out of memory for a fit");

    for (size_t j = 0; j < n && s == RB_OK; j++)
        gsl_vector_set(x, j, over_scale(&at, theta, j));
    if (s == RB_OK)
        evaluate_at(x, &at); /* says why the start has no solution */
    s = s == RB_OK ? at.status : s;
    if (s == RB_OK && gsl_multifit_nlinear_init(x, &fdf, w) != GSL_SUCCESS)
        s = at.accepted_status != RB_OK ? at.accepted_status
                                        : rb_fail(why, RB_INACCURATE, "fit: no start");
    while (s == RB_OK && !done && p->fit->iterations < at.most) {
        const double chi2 = at.accepted_chi2;
        const int ended = gsl_multifit_nlinear_iterate(w);
        s = at.status == RB_ENOMEM ? at.status : at.accepted_status;
        if (s == RB_OK && ended == BEYOND_KINKS) {
            s = descend_at_kinks(&at, &done);
        } else if (s == RB_OK) {
            done = ended != GSL_SUCCESS || chi2 - at.accepted_chi2 <= CONVERGED * chi2 ||
                   at.promise <= CONVERGED;
            s = report_accepted(&at);
        }
        done |= p->kappa > 1.0 && chi2 - at.accepted_chi2 <= CONVERGED_WITH_JUMPS * chi2;
        if (s == RB_OK && !done && (at.clipped || ended == BEYOND_KINKS)) {
            /* goes on from the bound, or from the kinks */
            gsl_vector_memcpy(x, at.x);
            gsl_multifit_nlinear_init(x, &fdf, w);
        }
    }
    if (p->accepted >= 0)
        memcpy(theta, at.accepted, n * sizeof *theta);
    p->fit->chi_square = at.accepted_chi2;
    if (w)
        gsl_multifit_nlinear_free(w);
    gsl_vector_free(x);
    gsl_vector_free(at.x);
    return s == RB_OK && !done
               ? rb_fail(why, RB_MAXITER,
                         "fit: not converged after %d steps. Try fewer elements "
                         "(--contact-elements 40), fewer numbers, or another start (--start)",
                         STEPS)
               : s;
}
