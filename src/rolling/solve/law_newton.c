/* Newton's method for friction that depends on the state (theory-rolling.md F1): it solves b =
 * T(b), where T(b) are the coefficients of the law for the contact solved with the bounds
 * b.  The derivative of T along a direction is a difference of two solved contacts, so
 * that the method works for all laws, for coupled bodies and for operators without a
 * matrix. */
#include "base/base.h"
#include "rolling/solve/law.h"
#include "rolling/solve/law_iteration.h"

#include <cblas.h>
#include <math.h>
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
    double *residual;          /* n: r + r' step, where the step is found */
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
    if (s != RB_OK)
        return s;
    for (int i = 0; i < w->n; i++) {
        if (new_weights)
            w->weight[i] = model->state.p[i] / (p->mu * p->stress);
        r[i] = w->weight[i] > NO_PRESSURE ? w->weight[i] * (w->T[i] - w->trial[i]) : 0.0;
    }
    return RB_OK;
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
    double left = norm, *residual = w->residual;

    memset(w->step, 0, n * sizeof *w->step);
    for (size_t i = 0; i < n; i++)
        residual[i] = w->direction[i] = -w->r[i];
    for (int k = 0; k < DIRECTIONS && k < w->n && left > 1e-3 * norm; k++) {
        double *d = w->direction + n * (size_t)k, *a = w->image + n * (size_t)k;
        if (k > 0)
            memcpy(d, a - n, n * sizeof *d);
        /* What r changes by along a direction. */
        const double size = DIFFERENCE / rb_norm_inf((size_t)w->n, d);

        set_trial(w, size, d);
        const rb_status s = residual_of(w, 0, a);
        if (s != RB_OK)
            return s;
        for (int i = 0; i < w->n; i++)
            a[i] = (a[i] - w->r[i]) / size;
        const double whole = cblas_dnrm2(w->n, a, 1);
        for (int j = 0; j < k; j++) {
            const size_t at = n * (size_t)j;
            const double share = cblas_ddot(w->n, w->image + at, 1, a, 1);
            cblas_daxpy(w->n, -share, w->image + at, 1, a, 1);
            cblas_daxpy(w->n, -share, w->direction + at, 1, d, 1);
        }
        const double rest = cblas_dnrm2(w->n, a, 1);
        if (!(rest > 1e-8 * whole)) /* the space has no more directions */
            break;
        cblas_dscal(w->n, 1.0 / rest, a, 1);
        cblas_dscal(w->n, 1.0 / rest, d, 1);
        const double part = cblas_ddot(w->n, residual, 1, a, 1);
        cblas_daxpy(w->n, part, d, 1, w->step, 1);
        cblas_daxpy(w->n, -part, a, 1, residual, 1);
        left = cblas_dnrm2(w->n, residual, 1);
    }
    return RB_OK;
}

/* Halves the step until r becomes less; RB_MAXITER: it does not. */
static rb_status line_search(newton *w, double *norm)
{
    double part = 1.0;

    for (int k = 0; k < HALVINGS; k++, part *= 0.5) {
        set_trial(w, part, w->step);
        memcpy(w->direction, w->weight, (size_t)w->n * sizeof *w->weight);
        const rb_status s = residual_of(w, 1, w->image);
        const double now = cblas_dnrm2(w->n, w->image, 1);
        if (s == RB_OK && now <= (1.0 - 0.1 * part) * *norm) {
            *norm = now;
            memcpy(w->r, w->image, (size_t)w->n * sizeof *w->r);
            memcpy(w->b, w->trial, (size_t)w->n * sizeof *w->b);
            return RB_OK;
        }
        memcpy(w->weight, w->direction, (size_t)w->n * sizeof *w->weight);
        if (s != RB_OK)
            return s;
    }
    return RB_MAXITER;
}

rb_status rb_rolling_law_newton(rb_rolling_model *model, double enough, int *left, rb_message *why)
{
    const size_t n = (size_t)model->problem.n;
    rb_arena scratch = {0};
    newton w = {.model = model,
                .n = (int)n,
                .left = left,
                .why = why,
                .b = rb_arena_doubles(&scratch, n, 1),
                .trial = rb_arena_doubles(&scratch, n, 1),
                .T = rb_arena_doubles(&scratch, n, 1),
                .weight = rb_arena_doubles(&scratch, n, 1),
                .r = rb_arena_doubles(&scratch, n, 1),
                .step = rb_arena_doubles(&scratch, n, 1),
                .residual = rb_arena_doubles(&scratch, n, 1),
                .direction = rb_arena_doubles(&scratch, n, DIRECTIONS),
                .image = rb_arena_doubles(&scratch, n, DIRECTIONS)};

    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM),
                       "out of memory for Newton's method");
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
    return rb_arena_done(&scratch, s);
}
