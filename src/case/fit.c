/* Numbers of a case fitted to measured forces (theory.md, D5): Levenberg's and
 * Marquardt's method (GSL's) with exact derivatives.  Elements stay those of the first
 * solution of each point while the numbers move, so that the sum of squares is smooth. */
#include "case/internal.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_sort.h>
#include <lapacke.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A second round has the elements of the first one's result, if they are others. */
enum { STEPS = 100, ROUNDS = 2 };
/* The least and the largest of a coefficient of friction and its fall. */
static const double LEAST_MU = 0.01, MOST_MU = 3.0;
/* A correlation that is worth a word. */
static const double CORRELATED = 0.95;

/* A measured point.  Points that share elements have these and their flexibility from
 * the first of them. */
typedef struct {
    int first;             /* number of the point with the elements */
    rb_rolling_model base; /* with the elements, if it is this one */
    /* Solved with the accepted numbers and with those of a trial: a variant of the base,
     * or of the first point's. */
    rb_rolling_model solved[2];
    rb_sensitivity *factors[2]; /* of these, where they are known */
} point;

/* A case with number `varied` (-1: none) changed to `value`, as it was resolved for a
 * point. */
typedef struct {
    int varied, point;
    double value;
    rb_rolling_case rc;
} resolved;

enum { RESOLVED_MAX = (RB_SENSITIVITY_PLACES + 1) * RB_CASE_FIT_MAX + 1 };

typedef struct {
    const rb_case *c;
    const rb_case_data *data;
    rb_case_fit *fit;
    int n, points, offset; /* parameters; which one is the offset of creepage, or -1 */
    const rb_option *option[RB_CASE_FIT_MAX], *creep, *load, *speed, *temperature;
    point *at;       /* points */
    int accepted;    /* which of `solved` is that of the accepted numbers; -1: none is */
    resolved *known; /* RESOLVED_MAX: cases with the present numbers */
    int known_n;
    double *f, *J; /* points: residuals of the last trial; points x n: derivatives of those
                      of the accepted numbers */
    double kappa;  /* the largest of all points, with the accepted numbers */
} problem;

/* GSL's header of BLAS and OpenBLAS's exclude each other. */
static double dot(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Of J. */
static const double *column(const problem *p, int j)
{
    return p->J + (size_t)j * (size_t)p->points;
}

/* ---- One point ----------------------------------------------------------------------- */

/* A point with its parameters; number `varied` (-1: none) has another value. */
typedef struct {
    problem *p;
    const double *theta;
    int point, varied;
} place;

/* 1: both points differ by the creepage alone. */
static int are_alike(const rb_case_data *d, int i, int j)
{
    return (!d->load || d->load[i] == d->load[j]) && (!d->speed || d->speed[i] == d->speed[j]) &&
           (!d->temperature || d->temperature[i] == d->temperature[j]);
}

static rb_status resolve(const place *at, double value, rb_rolling_case *rc, rb_message *why)
{
    const problem *p = at->p;
    const rb_case_data *d = p->data;
    rb_case *copy = rb_case_copy(p->c);

    if (!copy)
        return rb_fail(why, RB_ENOMEM, "out of memory for a case");
    copy->purpose = RB_CASE_SINGLE;
    for (int j = 0; j < p->n; j++)
        if (j != p->offset)
            rb_case_assign(copy, p->option[j], j == at->varied ? value : at->theta[j]);
    rb_case_assign(copy, p->creep, d->creep[at->point]);
    if (d->load)
        rb_case_assign(copy, p->load, d->load[at->point]);
    if (d->speed)
        rb_case_assign(copy, p->speed, d->speed[at->point]);
    if (d->temperature)
        rb_case_assign(copy, p->temperature, d->temperature[at->point]);
    const rb_status s = rb_case_resolve(copy, why);
    if (s == RB_OK)
        *rc = copy->resolved.rc;
    rb_case_free(copy);
    return s;
}

/* The case of a point: options are resolved once for all that are alike. */
static rb_status case_at(void *context, double value, rb_rolling_case *rc, rb_message *why)
{
    const place *at = context;
    problem *p = at->p;
    const int of_creep = at->varied == p->offset, varied = of_creep ? -1 : at->varied;
    const double x = varied < 0 ? 0.0 : value;
    const resolved *known = p->known;
    rb_status s = RB_OK;

    while (known < p->known + p->known_n && !(known->varied == varied && known->value == x &&
                                              are_alike(p->data, known->point, at->point)))
        known++;
    if (known < p->known + p->known_n) {
        *rc = known->rc;
    } else {
        s = resolve(at, value, rc, why);
        if (s == RB_OK && p->known_n < RESOLVED_MAX)
            p->known[p->known_n++] = (resolved){varied, at->point, x, *rc};
    }
    const double offset = p->offset < 0 ? 0.0 : of_creep ? value : at->theta[p->offset];
    *(double *)(void *)((char *)rc + p->creep->offset - offsetof(rb_resolved_case, rc)) =
        p->data->creep[at->point] + offset;
    return s;
}

/* The model whose elements those of a solution are. */
static const rb_rolling_model *model_below(const problem *p, int k, int which)
{
    const int first = p->at[k].first;
    return first == k ? &p->at[k].base : &p->at[first].solved[which];
}

/* The force in the measure of the data. */
static double measure(const problem *p, const rb_rolling_model *model)
{
    const double Q = rb_contact_force(&model->problem, &model->state),
                 P = rb_contact_load(&model->problem, &model->state);

    return p->data->measure == RB_CASE_FORCE             ? Q
           : p->data->measure == RB_CASE_FORCE_OVER_LOAD ? Q / P
                                                         : Q / (model->problem.mu * P);
}

/* The derivatives of the force at a solved point with respect to all parameters: one
 * adjoint solve. */
static rb_status differentiate(problem *p, const double *theta, int k,
                               const rb_rolling_model *model, const rb_sensitivity *s, double *row,
                               rb_message *why)
{
    const rb_contact_problem *q = &model->problem;
    const double P = rb_contact_load(q, &model->state), f = measure(p, model);
    const int ratio = p->data->measure == RB_CASE_FORCE_RATIO;
    const double scale = p->data->measure == RB_CASE_FORCE ? 1.0
                         : ratio                           ? 1.0 / (q->mu * P)
                                                           : 1.0 / P;
    rb_contact_state weight = {0};
    rb_sensitivity_rate adjoint = {0}, rate = {0};
    rb_status status = rb_contact_state_alloc(q->n, &weight);

    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(q->n, &adjoint);
    for (int i = 0; i < q->n && status == RB_OK; i++) {
        const double share = p->data->measure == RB_CASE_FORCE ? 0.0 : f / P;
        weight.p[i] = scale * q->force_N[i] - share * q->load_N[i];
        weight.q[i] = scale * q->force_T[i] - share * q->load_T[i];
    }
    if (status == RB_OK)
        status = rb_sensitivity_adjoint(s, &weight, &adjoint, why);
    for (int j = 0; j < p->n && status == RB_OK; j++) {
        const rb_case_parameter *of = &p->fit->parameter[j];
        place at = {p, theta, k, j};
        const rb_sensitivity_input input = {theta[j], of->scale, of->from, of->to, case_at, &at};
        double mu_rate = 0.0;
        status = rb_sensitivity_rates(s, &input, &rate, &mu_rate, why);
        if (status == RB_OK)
            row[j] = rb_sensitivity_dot(&adjoint, &rate) - (ratio ? f / q->mu * mu_rate : 0.0);
        rb_sensitivity_rate_free(&rate);
    }
    rb_sensitivity_rate_free(&adjoint);
    rb_contact_state_free(&weight);
    return status;
}

static double sigma_of(const problem *p, int k)
{
    return p->data->sigma ? p->data->sigma[k] : 1.0;
}

/* Frees the solutions of all points with the accepted numbers, or those of a trial. */
static void release(problem *p, int which)
{
    for (int k = p->points - 1; p->at && k >= 0 && which >= 0; k--) {
        rb_sensitivity_free(p->at[k].factors[which]);
        p->at[k].factors[which] = NULL;
        rb_rolling_variant_free(model_below(p, k, which), &p->at[k].solved[which]);
    }
}

/* The factors of a solved point: with those of the first point with its elements. */
static rb_status factorise(problem *p, int k, int which, rb_message *why)
{
    rb_sensitivity **own = &p->at[k].factors[which], *like = p->at[p->at[k].first].factors[which];

    return *own ? RB_OK : rb_sensitivity_create_like(&p->at[k].solved[which], like, own, why);
}

/* Solves a point for a trial; the first of those that share elements makes the
 * flexibility.  It follows its solution with the accepted numbers or, if there is none,
 * the solution of the point before it. */
static rb_status solve_point(problem *p, const double *theta, int k, int trial, rb_message *why)
{
    const point *at = &p->at[k];
    const rb_rolling_model *of = model_below(p, k, trial);
    const int is_first = p->accepted < 0,
              follows = !is_first || (k > 0 && at->first == p->at[k - 1].first),
              from = is_first ? k - 1 : k, which = is_first ? trial : p->accepted;
    rb_rolling_model *v = &p->at[k].solved[trial];
    place here = {p, theta, k, -1};
    rb_rolling_case rc;
    rb_status s = case_at(&here, 0.0, &rc, why);

    if (s == RB_OK)
        s = at->first == k ? rb_rolling_variant_place(of, &rc, 0.0, 1.0, v, why)
                           : rb_rolling_variant_create(of, &rc, 0, v, why);
    if (s != RB_OK)
        return s;
    s = follows ? factorise(p, from, which, why) : RB_MAXITER;
    if (s == RB_OK)
        s = rb_sensitivity_follow(p->at[from].factors[which], v, why);
    if (s > 0) {
        rb_rolling_variant_set(follows ? &p->at[from].solved[which].state : &of->state, NULL, 0.0,
                               &v->state);
        s = rb_rolling_variant_complete(v, NULL, NULL, why);
        s = s == RB_OK ? rb_rolling_model_resolve(v, 1, why) : s;
    }
    return s;
}

/* All residuals for a trial, and chi^2. */
static rb_status try_numbers(problem *p, const double *theta, double *chi2, rb_message *why)
{
    const int trial = p->accepted == 0;
    rb_status s = RB_OK;

    release(p, trial);
    p->known_n = 0;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        s = solve_point(p, theta, k, trial, why);
        if (s == RB_OK)
            p->f[k] = (measure(p, &p->at[k].solved[trial]) - p->data->force[k]) / sigma_of(p, k);
    }
    *chi2 = s == RB_OK ? dot(p->points, p->f, p->f) : INFINITY;
    return s;
}

/* Accepts the numbers of the last trial: their factors and rows of derivatives. */
static rb_status accept_numbers(problem *p, const double *theta, rb_message *why)
{
    const int trial = p->accepted == 0;
    rb_status s = RB_OK;

    release(p, p->accepted);
    p->accepted = trial;
    p->kappa = 0.0;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        const rb_rolling_model *model = &p->at[k].solved[trial];
        double row[RB_CASE_FIT_MAX], kappa = NAN;
        s = factorise(p, k, trial, why);
        if (s == RB_OK && rb_rolling_law_depends_on_state(model->rc))
            s = rb_rolling_law_kappa(model, &kappa);
        if (s == RB_OK)
            s = differentiate(p, theta, k, model, p->at[k].factors[trial], row, why);
        if (s != RB_OK)
            break;
        p->kappa = fmax(p->kappa, kappa);
        p->fit->model[k] = measure(p, model);
        for (int j = 0; j < p->n; j++)
            p->J[(size_t)k + (size_t)j * (size_t)p->points] = row[j] / sigma_of(p, k);
    }
    return s;
}

/* Friction of similar bodies does not change the pressure: then the edges of the contact
 * do not depend on the creepage. */
static int shares_elements(const problem *p, int k, int with)
{
    const point *first = &p->at[with];
    const rb_contact_problem *q = &first->base.problem;

    return first->first == with && are_alike(p->data, k, with) &&
           !rb_contact_operator_response(q->op).coupled &&
           rb_norm_inf((size_t)q->n, q->load_T) == 0.0;
}

/* Makes the elements of all points for the numbers theta.  *moved: 1: some are others
 * than before. */
static rb_status place_elements(problem *p, const double *theta, int *moved, rb_message *why)
{
    rb_status s = RB_OK;

    *moved = 0;
    p->known_n = 0;
    release(p, p->accepted == 0);
    release(p, p->accepted);
    p->accepted = -1;
    for (int k = 0; k < p->points && s == RB_OK; k++) {
        point *of = &p->at[k];
        place at = {p, theta, k, -1};
        rb_rolling_case rc;
        rb_rolling_model fresh = {.mesh = {.n = 0}};

        of->first = 0;
        while (of->first < k && !shares_elements(p, k, of->first))
            of->first++;
        s = of->first < k ? RB_OK : case_at(&at, 0.0, &rc, why);
        if (s == RB_OK && of->first == k)
            s = rb_rolling_model_create(&rc, &fresh, why);
        const rb_rolling_mesh *old = &of->base.mesh, *mesh = &fresh.mesh;
        if (of->first == k && s == RB_OK)
            *moved |= old->n != mesh->n || memcmp(old->ends, mesh->ends,
                                                  ((size_t)mesh->n + 1) * sizeof *mesh->ends) != 0;
        rb_rolling_model_free(&of->base);
        of->base = fresh;
    }
    return s;
}

/* ---- Levenberg and Marquardt ------------------------------------------------------- */

static void within(const rb_case_parameter *of, double *x)
{
    const double inside = 1e-9 * of->scale;

    *x = fmin(fmax(*x, of->low + (of->low_open ? inside : 0.0)),
              of->high - (of->high_open ? inside : 0.0));
}

/* What GSL's solver asks, in the scales of the parameters: residuals at every trial,
 * their derivatives where it accepts one. */
typedef struct {
    problem *p;
    double theta[RB_CASE_FIT_MAX]; /* of the last trial, within its bounds */
    double accepted[RB_CASE_FIT_MAX];
    int known, has_rows; /* 1: theta has f and chi^2; it was accepted, and has J */
    int clipped;
    double chi2, accepted_chi2, worst;
    rb_status status; /* of the last trial */
    rb_status accepted_status;
    rb_message *why;
} state;

static void evaluate_at(const gsl_vector *x, state *at)
{
    problem *p = at->p;
    double theta[RB_CASE_FIT_MAX];

    at->clipped = 0;
    for (int j = 0; j < p->n; j++) {
        const double wanted = gsl_vector_get(x, (size_t)j) * p->fit->parameter[j].scale;
        theta[j] = wanted;
        within(&p->fit->parameter[j], &theta[j]);
        at->clipped |= theta[j] != wanted;
    }
    if (at->known && memcmp(theta, at->theta, (size_t)p->n * sizeof *theta) == 0)
        return;
    memcpy(at->theta, theta, (size_t)p->n * sizeof *theta);
    at->status = try_numbers(p, theta, &at->chi2, at->why);
    at->known = 1;
    at->has_rows = 0;
}

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
    return GSL_SUCCESS;
}

static int rows(const gsl_vector *x, void *context, gsl_matrix *J)
{
    state *at = context;
    problem *p = at->p;

    evaluate_at(x, at);
    if (at->status == RB_OK && !at->has_rows) {
        at->accepted_status = accept_numbers(p, at->theta, at->why);
        at->has_rows = 1;
        memcpy(at->accepted, at->theta, sizeof at->theta);
        at->accepted_chi2 = at->chi2;
    }
    if (at->status != RB_OK || at->accepted_status != RB_OK)
        return GSL_EFAILED;
    for (int j = 0; j < p->n; j++) {
        /* A bound that the sum of squares presses against holds a parameter. */
        const rb_case_parameter *of = &p->fit->parameter[j];
        const double down = dot(p->points, column(p, j), p->f);
        const double near = 1e-8 * of->scale;

        const int held = (at->theta[j] <= of->low + near && down > 0.0) ||
                         (at->theta[j] >= of->high - near && down < 0.0);
        for (int k = 0; k < p->points; k++)
            gsl_matrix_set(J, (size_t)k, (size_t)j,
                           held ? 0.0
                                : p->J[(size_t)k + (size_t)j * (size_t)p->points] *
                                      p->fit->parameter[j].scale);
    }
    return GSL_SUCCESS;
}

static rb_status descend(problem *p, double *theta, const rb_case_fit_observer *observer,
                         rb_message *why)
{
    const size_t n = (size_t)p->n, points = (size_t)p->points;
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    how.scale = gsl_multifit_nlinear_scale_marquardt;
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, points, n);
    gsl_vector *x = gsl_vector_alloc(n);
    state at = {.p = p, .worst = 1.0, .why = why};
    gsl_multifit_nlinear_fdf fdf = {.f = residuals, .df = rows, .n = points, .p = n, .params = &at};
    int done = 0;
    rb_status s = w && x ? RB_OK : rb_fail(why, RB_ENOMEM, "out of memory for a fit");

    for (size_t j = 0; j < n && s == RB_OK; j++)
        gsl_vector_set(x, j, theta[j] / p->fit->parameter[j].scale);
    if (s == RB_OK)
        evaluate_at(x, &at); /* says why the start has no solution */
    s = s == RB_OK ? at.status : s;
    if (s == RB_OK && gsl_multifit_nlinear_init(x, &fdf, w) != GSL_SUCCESS)
        s = at.accepted_status != RB_OK ? at.accepted_status
                                        : rb_fail(why, RB_INACCURATE, "fit: no start");
    for (int k = 0; k < STEPS && s == RB_OK && !done; k++) {
        const double chi2 = at.accepted_chi2;
        const int ended = gsl_multifit_nlinear_iterate(w);
        s = at.status == RB_ENOMEM ? at.status : at.accepted_status;
        done = ended != GSL_SUCCESS || chi2 - at.accepted_chi2 <= 1e-10 * chi2;
        memcpy(theta, at.accepted, n * sizeof *theta);
        p->fit->iterations++;
        if (s == RB_OK && at.clipped && !done) { /* goes on from the bound */
            for (size_t j = 0; j < n; j++)
                gsl_vector_set(x, j, theta[j] / p->fit->parameter[j].scale);
            gsl_multifit_nlinear_init(x, &fdf, w);
        }
        if (s == RB_OK && observer && observer->step &&
            observer->step(p->fit->iterations, at.accepted_chi2, p->n, theta, observer->context))
            s = rb_fail(why, RB_INTERRUPTED, "fit: interrupted after %d steps", p->fit->iterations);
    }
    p->fit->chi_square = at.accepted_chi2;
    if (w)
        gsl_multifit_nlinear_free(w);
    gsl_vector_free(x);
    return s == RB_OK && !done
               ? rb_fail(why, RB_MAXITER, "fit: not converged after %d steps", STEPS)
               : s;
}

/* ---- Intervals --------------------------------------------------------------------- */

/* (J'J)^-1, by the columns scaled to length 1; RB_SINGULAR with *which: the column that
 * the others make up. */
static rb_status covariance(const problem *p, double *C, int *which)
{
    const int n = p->n;
    double length[RB_CASE_FIT_MAX];

    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[i + j * n] = dot(p->points, column(p, i), column(p, j));
    for (int j = 0; j < n; j++)
        length[j] = sqrt(C[j + j * n]);
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[i + j * n] /= length[i] * length[j];
    for (int j = 0; j < n; j++)
        if (!(length[j] * p->fit->parameter[j].scale > 0.0)) {
            *which = j;
            return RB_SINGULAR;
        }
    const int info = LAPACKE_dpotrf(LAPACK_COL_MAJOR, 'L', n, C, n);
    for (int j = 0; j < n && info == 0; j++)
        if (C[j + j * n] < 1e-6) {
            *which = j;
            return RB_SINGULAR;
        }
    if (info != 0 || LAPACKE_dpotri(LAPACK_COL_MAJOR, 'L', n, C, n) != 0) {
        *which = info > 0 ? info - 1 : n - 1;
        return RB_SINGULAR;
    }
    for (int j = 0; j < n; j++)
        for (int i = j; i < n; i++)
            C[j + i * n] = C[i + j * n] /= length[i] * length[j];
    return RB_OK;
}

static void say(rb_case_fit *fit, const char *format, const char *name, const char *more)
{
    const size_t used = strlen(fit->sentences);
    if (used < sizeof fit->sentences)
        snprintf(fit->sentences + used, sizeof fit->sentences - used, format, name, more);
}

/* How many points lie where the force falls beyond its largest, by more than the noise. */
static int falling_points(const problem *p)
{
    const rb_case_data *d = p->data;
    const double noise = sqrt(p->fit->chi_square / fmax(1, p->points - p->n));
    int top = 0, falling = 0;

    for (int k = 1; k < p->points; k++)
        if (fabs(d->force[k]) > fabs(d->force[top]))
            top = k;
    for (int k = 0; k < p->points; k++)
        falling +=
            fabs(d->creep[k]) > fabs(d->creep[top]) &&
            fabs(d->force[top]) - fabs(d->force[k]) > 3.0 * noise * (d->sigma ? d->sigma[k] : 1.0);
    return falling;
}

static int is_of_fall(const rb_case_parameter *of)
{
    return strcmp(of->name, "slip-scale") == 0 || strcmp(of->name, "mu-fall") == 0;
}

static void not_identified(const problem *p, int j)
{
    rb_case_parameter *of = &p->fit->parameter[j];

    if (!of->identified)
        return;
    of->identified = 0;
    p->fit->unidentified++;
    if (is_of_fall(of) && falling_points(p) < 2)
        say(p->fit, "%sno point in the falling part: %s is not identified\n", "", of->name);
    else
        say(p->fit, "%sthe data do not determine %s: it is not identified\n", "", of->name);
}

static void set_intervals(problem *p, const double *theta)
{
    rb_case_fit *fit = p->fit;
    double C[RB_CASE_FIT_MAX * RB_CASE_FIT_MAX];
    const int n = p->n;
    int which = -1;

    fit->degrees_of_freedom = p->points - n;
    const double variance = p->data->sigma ? 1.0 : fit->chi_square / fit->degrees_of_freedom;
    const double t = gsl_cdf_tdist_Pinv(0.5 + 0.5 * fit->level, fit->degrees_of_freedom);
    const rb_status s = covariance(p, C, &which);

    fit->noise = sqrt(fit->chi_square / fit->degrees_of_freedom);
    for (int j = 0; j < n; j++) {
        rb_case_parameter *of = &fit->parameter[j];
        const double half = s == RB_OK ? t * sqrt(variance * C[j + j * n]) : INFINITY;
        of->value = theta[j];
        of->interval[0] = theta[j] - half;
        of->interval[1] = theta[j] + half;
        of->deviation = half / t;
        of->identified = 1;
        of->at_bound =
            theta[j] <= of->low + 1e-8 * of->scale || theta[j] >= of->high - 1e-8 * of->scale;
        for (int i = 0; i < n; i++)
            of->correlation[i] =
                s == RB_OK ? C[i + j * n] / sqrt(C[i + i * n] * C[j + j * n]) : NAN;
    }
    if (s != RB_OK)
        not_identified(p, which);
    for (int j = 0; j < n; j++) {
        const rb_case_parameter *of = &fit->parameter[j];
        const double half = 0.5 * (of->interval[1] - of->interval[0]);
        if ((is_of_fall(of) && falling_points(p) < 2) ||
            (of->positive && !(half < fabs(of->value))))
            not_identified(p, j);
        if (of->at_bound && of->identified)
            say(fit, "%s lies at an end of its range; its interval does not hold there%s\n",
                of->name, "");
        for (int i = 0; i < j; i++)
            if (fabs(of->correlation[i]) > CORRELATED)
                say(fit,
                    "%s and %s are correlated by more than 0.95: the data determine "
                    "only a combination of them\n",
                    fit->parameter[i].name, of->name);
    }
    /* the band of the fitted curve */
    for (int k = 0; k < p->points; k++) {
        double sum = 0.0;
        const double sigma = p->data->sigma ? p->data->sigma[k] : 1.0;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                sum += p->J[k + (size_t)i * (size_t)p->points] * C[i + j * n] *
                       p->J[k + (size_t)j * (size_t)p->points];
        fit->band[k] = s == RB_OK ? t * sigma * sqrt(variance * fmax(sum, 0.0)) : NAN;
    }
}

/* ---- Where to start ---------------------------------------------------------------- */

/* What the data themselves say: the largest force, the last one, the first slope, where
 * the force is 0. */
static double start_of(const problem *p, const char *name)
{
    const rb_case_data *d = p->data;
    const rb_rolling_derived *derived = &p->c->resolved.derived;
    double most = 0.0, far = 0.0, near = INFINITY, last = 0.0, slope = 0.0, zero = 0.0;
    double *slip = rb_alloc((size_t)p->points, 1);
    int falls = 0;

    for (int j = 0; j < p->n; j++)
        falls |= strcmp(p->fit->parameter[j].name, "mu-fall") == 0;
    for (int k = 0; k < p->points; k++) {
        /* |Q/P| of a point, as well as it is known before the fit. */
        const rb_resolved_case *c = &p->c->resolved;
        const double P = p->data->load ? p->data->load[k] : c->derived.load;

        const double xi = fabs(d->creep[k]),
                     f = fabs(p->data->force[k]) * (p->data->measure == RB_CASE_FORCE ? 1.0 / P
                                                    : p->data->measure == RB_CASE_FORCE_RATIO
                                                        ? c->rc.mu
                                                        : 1.0);
        most = fmax(most, f);
        if (xi >= far) {
            far = xi;
            last = f;
        }
        if (xi > 0.0 && xi < near) {
            near = xi;
            slope = f / xi;
        }
        if (slip)
            slip[k] = xi * (d->speed ? d->speed[k] : p->c->resolved.rc.speed);
        if (k > 0 && d->force[k] * d->force[k - 1] < 0.0)
            zero = d->creep[k - 1] - d->force[k - 1] * (d->creep[k] - d->creep[k - 1]) /
                                         (d->force[k] - d->force[k - 1]);
    }
    if (slip)
        gsl_sort(slip, 1, (size_t)p->points);
    const double middle = slip ? slip[p->points / 2] : NAN;
    free(slip);
    const double stiff = 2.0 * derived->radius / derived->half_width;
    return strcmp(name, "mu") == 0           ? fmax(falls ? 0.95 * last : most, LEAST_MU)
           : strcmp(name, "mu-fall") == 0    ? fmax(most - last, 0.1 * most)
           : strcmp(name, "slip-scale") == 0 ? middle
           : strcmp(name, "interlayer-tangential") == 0
               ? 0.1 * derived->half_width / derived->modulus *
                     fmin(fmax(stiff / slope - 1.0, 0.2), 10.0)
           : strcmp(name, "creep-offset") == 0 ? -zero
                                               : NAN;
}

static rb_status set_parameter(problem *p, int j, rb_message *why)
{
    rb_case_parameter *of = &p->fit->parameter[j];
    const rb_option *o =
        strcmp(of->name, "creep-offset") == 0 ? p->creep : rb_case_option(of->name);
    const rb_rolling_derived *d = &p->c->resolved.derived;

    if (!o || o->kind != RB_OPTION_NUMBER || o->frozen ||
        (o == p->creep && strcmp(of->name, "creep") == 0))
        return rb_fail(why, RB_EINVAL, "--fit: '%s' is not a number that can be fitted to forces",
                       of->name);
    p->option[j] = o;
    of->unit = o->unit;
    const int offset = o == p->creep;
    if (offset)
        p->offset = j;
    const double own = *(const double *)(const void *)((const char *)&p->c->resolved + o->offset);
    const int by = p->c->given[o - rb_case_table];
    const int given = by != 0 && by != RB_GIVEN_NUMBER; /* else it was prepared */
    const double guess = start_of(p, of->name);
    of->value = !isnan(of->start)  ? of->start
                : !offset && given ? own
                : isfinite(guess)  ? guess
                                   : own;
    of->from = offset ? -INFINITY : o->range.from;
    of->to = offset ? INFINITY : o->range.to;
    of->low_open = o->range.from_open;
    of->high_open = o->range.to_open;
    of->positive =
        !offset && o->range.from == 0.0 && (o->range.from_open || strcmp(of->name, "mu") == 0);
    of->low = fmax(of->low, strcmp(of->name, "mu") == 0        ? LEAST_MU
                            : strcmp(of->name, "mu-fall") == 0 ? 0.0
                                                               : of->from);
    of->high = fmin(of->high, strncmp(of->name, "mu", 3) == 0 || strcmp(of->name, "mu-fall") == 0
                                  ? MOST_MU
                                  : of->to);
    if (!isfinite(of->value))
        return rb_fail(why, RB_EINVAL, "--fit: %s has no value to start from; give --%s", of->name,
                       of->name);
    of->scale = of->value != 0.0                 ? fabs(of->value)
                : offset                         ? 0.1 * d->half_width / d->radius
                : strcmp(o->unit, "mm/MPa") == 0 ? 1e-2 * d->half_width / d->modulus
                                                 : 1e-2;
    within(of, &of->value);
    return RB_OK;
}

static int is_fitted(const rb_case_fit *fit, const char *name)
{
    int found = 0;
    for (int j = 0; j < fit->n; j++)
        found |= strcmp(fit->parameter[j].name, name) == 0;
    return found;
}

rb_status rb_case_prepare_fit(rb_case *c, const rb_case_data *data, const rb_case_fit *fit,
                              rb_message *why)
{
    const int falls = is_fitted(fit, "mu-fall") || is_fitted(fit, "slip-scale");
    rb_status s = RB_OK;

    if (falls && !rb_case_given(c, "friction-law"))
        s = rb_case_set(c, "friction-law", "exponential", RB_GIVEN_NUMBER, why);
    if (s == RB_OK && falls && !rb_case_given(c, "mu-fall"))
        s = rb_case_set_number(c, "mu-fall", 0.1, why);
    if (s == RB_OK && falls && !rb_case_given(c, "slip-scale"))
        s = rb_case_set_number(c, "slip-scale", 1.0, why);
    if (s == RB_OK && data->speed && !rb_case_given(c, "speed"))
        s = rb_case_set_number(c, "speed", 1.0, why);
    if (s == RB_OK && data->load && !rb_case_given(c, "load") && !rb_case_given(c, "half-width") &&
        !rb_case_given(c, "approach"))
        s = rb_case_set_number(c, "load", data->load[0], why);
    return s;
}

/* ---- All together ------------------------------------------------------------------ */

static int falls_unidentified(const rb_case_fit *fit)
{
    int found = 0;
    for (int j = 0; j < fit->n; j++)
        found |= is_of_fall(&fit->parameter[j]) && !fit->parameter[j].identified;
    return found;
}

rb_status rb_case_fit_solve(const rb_case *c, const rb_case_data *data,
                            const rb_case_fit_observer *observer, rb_case_fit *fit, rb_message *why)
{
    const size_t points = (size_t)data->n;
    problem p = {.c = c,
                 .data = data,
                 .fit = fit,
                 .n = fit->n,
                 .points = data->n,
                 .offset = -1,
                 .accepted = -1,
                 .creep = rb_case_option(data->is_ratio ? "creep-ratio" : "creep"),
                 .load = rb_case_option("load"),
                 .speed = rb_case_option("speed"),
                 .temperature = rb_case_option("temperature")};
    double theta[RB_CASE_FIT_MAX];
    int moved = 1;
    rb_status s = RB_OK;

    if (data->n <= fit->n)
        return rb_fail(why, RB_EINVAL, "--fit: %d points are not enough for %d parameters", data->n,
                       fit->n);
    p.at = calloc(points, sizeof *p.at);
    p.known = calloc(RESOLVED_MAX, sizeof *p.known);
    p.f = rb_alloc(points, 1);
    p.J = rb_alloc(points, (size_t)fit->n);
    fit->model = rb_alloc(points, 1);
    fit->band = rb_alloc(points, 1);
    if (!p.at || !p.known || !p.f || !p.J || !fit->model || !fit->band)
        s = rb_fail(why, RB_ENOMEM, "out of memory for a fit of %d points", data->n);
    for (int j = 0; j < fit->n && s == RB_OK; j++) {
        s = set_parameter(&p, j, why);
        theta[j] = fit->parameter[j].value;
    }
    if (s == RB_OK && p.offset >= 0 && data->is_ratio)
        s = rb_fail(why, RB_EINVAL,
                    "--fit creep-offset: needs creepages, a column creep and no ratios");
    if (s == RB_OK)
        s = place_elements(&p, theta, &moved, why);
    for (int round = 0; round < ROUNDS && s == RB_OK && moved; round++) {
        s = descend(&p, theta, observer, why);
        if (s == RB_OK && round + 1 < ROUNDS)
            s = place_elements(&p, theta, &moved, why);
    }
    for (int j = 0; j < fit->n && s != RB_EINVAL && s != RB_ENOMEM; j++)
        fit->parameter[j].value = theta[j];
    fit->kappa = p.kappa;
    if (s == RB_OK)
        set_intervals(&p, theta);
    /* a fall that the data do not tell has a kappa that they do not tell */
    if (s == RB_OK && p.kappa > 1.0 && !falls_unidentified(fit))
        s = rb_fail(why, RB_INACCURATE,
                    "fit: kappa = %.3g at the best fit: above 1 the model itself has "
                    "several solutions; give friction a memory (--memory), or fit that too",
                    p.kappa);
    fit->status = s;
    release(&p, p.accepted == 0);
    release(&p, p.accepted);
    for (size_t k = 0; p.at && k < points; k++)
        rb_rolling_model_free(&p.at[k].base);
    free(p.at);
    free(p.known);
    free(p.f);
    free(p.J);
    return s;
}

void rb_case_fit_free(rb_case_fit *fit)
{
    free(fit->model);
    free(fit->band);
    fit->model = fit->band = NULL;
}
