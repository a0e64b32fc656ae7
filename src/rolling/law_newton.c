/* Newton's method for friction that depends on the state (theory.md F1): it solves b =
 * T(b), where T(b) are the coefficients of the law for the contact solved with the bounds
 * b.  The derivative of T along a direction is a difference of two solved contacts, so
 * that the method works for all laws, for coupled bodies and for operators without a
 * matrix. */
#include "rolling/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 30, DIRECTIONS = 100, HALVINGS = 8 };
/* The largest change of the natural residual that a derivative is taken over: contacts
 * are solved to about the square of it. */
static const double DIFFERENCE = 1e-7;
/* Elements with less pressure, as a part of p0, take what the law gives them. */
static const double NO_PRESSURE = 1e-9;

typedef struct {
    rb_rolling_model *model;
    int n, *left;              /* contact problems that may still be solved */
    double *b, *trial, *T;     /* n */
    double *weight;            /* n: p/(mu p0), which makes a natural residual of a mu */
    double *r, *step;          /* n: weight (T(b) - b); weight times the change of b */
    double *direction, *image; /* n x DIRECTIONS */
    rb_message *why;
} newton;

/* r at the bounds `trial`; in a derivative the present weights are used. */
static rb_status residual_of(newton *w, int new_weights, double *r)
{
    rb_rolling_model *model = w->model;
    rb_contact_problem *p = &model->problem;

    if ((*w->left)-- <= 0)
        return RB_MAXITER;
    for (int i = 0; i < w->n; i++)
        w->trial[i] = fmax(w->trial[i], 0.0);
    rb_contact_set_friction(p, p->mu, w->trial);
    rb_status s = rb_rolling_problem_solve(p, model->rc, 1, &model->state, w->why);
    model->iterations += model->state.iterations;
    if (s == RB_OK)
        s = rb_rolling_law_coefficients(model, w->T, w->why);
    for (int i = 0; i < w->n && s == RB_OK; i++) {
        if (new_weights)
            w->weight[i] = model->state.p[i] / (p->mu * p->stress);
        r[i] = w->weight[i] > NO_PRESSURE ? w->weight[i] * (w->T[i] - w->trial[i]) : 0.0;
    }
    return s;
}

static void set_trial(newton *w, double part, const double *change)
{
    for (int i = 0; i < w->n; i++)
        w->trial[i] =
            w->b[i] + (w->weight[i] > NO_PRESSURE ? part * change[i] / w->weight[i] : 0.0);
}

/* r + r' step = 0 by Krylov's directions, each the image of the one before, of which the
 * images are made orthogonal (Orthodir; the residuals are those of GMRES). */
static rb_status newton_step(newton *w, double norm)
{
    const size_t n = (size_t)w->n;
    double left = norm, rest[2];
    double *residual = rb_alloc(n, 1);
    rb_status s = residual ? RB_OK : RB_ENOMEM;

    memset(w->step, 0, n * sizeof *w->step);
    for (size_t i = 0; i < n && s == RB_OK; i++)
        residual[i] = w->direction[i] = -w->r[i];
    for (int k = 0; s == RB_OK && k < DIRECTIONS && k < w->n && left > 1e-3 * norm; k++) {
        double *d = w->direction + n * (size_t)k, *a = w->image + n * (size_t)k;
        if (k > 0)
            memcpy(d, a - n, n * sizeof *d);
        /* What r changes by along a direction. */
        const double size = DIFFERENCE / rb_norm_inf((size_t)w->n, d);

        set_trial(w, size, d);
        s = residual_of(w, 0, a);
        for (int i = 0; i < w->n && s == RB_OK; i++)
            a[i] = (a[i] - w->r[i]) / size;
        rest[0] = s == RB_OK ? cblas_dnrm2(w->n, a, 1) : 0.0;
        for (int j = 0; j < k && s == RB_OK; j++) {
            const size_t at = n * (size_t)j;
            const double share = cblas_ddot(w->n, w->image + at, 1, a, 1);
            cblas_daxpy(w->n, -share, w->image + at, 1, a, 1);
            cblas_daxpy(w->n, -share, w->direction + at, 1, d, 1);
        }
        rest[1] = s == RB_OK ? cblas_dnrm2(w->n, a, 1) : 0.0;
        if (!(rest[1] > 1e-8 * rest[0])) /* the space has no more directions */
            break;
        cblas_dscal(w->n, 1.0 / rest[1], a, 1);
        cblas_dscal(w->n, 1.0 / rest[1], d, 1);
        const double part = cblas_ddot(w->n, residual, 1, a, 1);
        cblas_daxpy(w->n, part, d, 1, w->step, 1);
        cblas_daxpy(w->n, -part, a, 1, residual, 1);
        left = cblas_dnrm2(w->n, residual, 1);
    }
    free(residual);
    return s;
}

/* Halves the step until r becomes less; RB_MAXITER: it does not. */
static rb_status line_search(newton *w, double *norm)
{
    rb_status s = RB_OK;
    double part = 1.0;

    for (int k = 0; k < HALVINGS && s == RB_OK; k++, part *= 0.5) {
        set_trial(w, part, w->step);
        memcpy(w->direction, w->weight, (size_t)w->n * sizeof *w->weight);
        s = residual_of(w, 1, w->image);
        const double now = cblas_dnrm2(w->n, w->image, 1);
        if (s == RB_OK && now <= (1.0 - 0.1 * part) * *norm) {
            *norm = now;
            memcpy(w->r, w->image, (size_t)w->n * sizeof *w->r);
            memcpy(w->b, w->trial, (size_t)w->n * sizeof *w->b);
            return RB_OK;
        }
        memcpy(w->weight, w->direction, (size_t)w->n * sizeof *w->weight);
    }
    return s == RB_OK ? RB_MAXITER : s;
}

rb_status rb_rolling_law_newton(rb_rolling_model *model, double enough, int *left, rb_message *why)
{
    const size_t n = (size_t)model->problem.n;
    double *scratch = rb_alloc(n, 6 + 2 * DIRECTIONS);
    newton w = {.model = model, .n = (int)n, .left = left, .why = why};

    if (!scratch)
        return rb_fail(why, RB_ENOMEM, "out of memory for Newton's method");
    double **const part[] = {&w.b, &w.trial, &w.T, &w.weight, &w.r, &w.step};
    for (size_t k = 0; k < 6; k++)
        *part[k] = scratch + k * n;
    w.direction = scratch + 6 * n;
    w.image = w.direction + DIRECTIONS * n;
    memcpy(w.trial, model->problem.bound, n * sizeof *w.trial);
    rb_status s = residual_of(&w, 1, w.r);
    memcpy(w.b, w.trial, n * sizeof *w.b);
    double norm = cblas_dnrm2(w.n, w.r, 1);
    int k = 0;
    for (; k < STEPS && s == RB_OK && rb_norm_inf(n, w.r) > enough; k++) {
        s = newton_step(&w, norm);
        if (s == RB_OK)
            s = line_search(&w, &norm);
    }
    if (s == RB_OK && rb_norm_inf(n, w.r) > enough)
        s = RB_MAXITER;
    if (s == RB_OK)
        rb_contact_set_friction(&model->problem, model->problem.mu, w.T);
    free(scratch);
    return s;
}
