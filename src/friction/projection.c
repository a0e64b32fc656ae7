/* Projection on the cones with a step rho that adapts itself: fixed point
 * r = P_K(r - rho uhat(r)) and extragradient (Korpelevich, Khobotov). */
#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 50000

typedef struct {
    rb_friction_task *task;
    const rb_friction_blocks *blocks;
    double *uhat, *p, *up; /* at r; the projected point; uhat there */
    double rho;
} projector;

static rb_status projector_init(rb_friction_task *task, projector *s)
{
    const size_t m = (size_t)task->m;
    *s = (projector){.task = task, .uhat = rb_alloc(m, 3)};
    double *rho = rb_alloc((size_t)task->contacts, 2);
    rb_status st = s->uhat && rho ? RB_OK : RB_ENOMEM;
    if (st == RB_OK)
        st = rb_friction_task_blocks(task, &s->blocks);
    if (st == RB_OK) {
        s->p = s->uhat + m;
        s->up = s->p + m;
        rb_friction_blocks_rho(s->blocks, rho);
        s->rho = rho[0];
    }
    free(rho);
    return st;
}

static void projector_free(projector *s)
{
    free(s->uhat);
}

static void uhat_at(const projector *s, const double *r, double *uhat)
{
    const rb_friction_problem *p = s->task->local;
    const int d = p->dimension;
    rb_friction_blocks_apply(s->blocks, r, uhat);
    for (int c = 0; c < p->contacts; c++) {
        for (int a = 0; a < d; a++)
            uhat[c * d + a] += p->q[c * d + a];
        uhat[c * d] += p->mu[c] * rb_friction_tangential(d, uhat + c * d);
    }
    s->task->info->flops += 2.0 * s->blocks->p[p->contacts] * d * d + 8.0 * s->task->m;
}

/* p = P_K(r - rho uhat) */
static void project_all(const projector *s, const double *uhat, double *p)
{
    const rb_friction_task *t = s->task;
    for (int k = 0; k < t->m; k++)
        p[k] = t->r[k] - s->rho * uhat[k];
    for (int c = 0; c < t->contacts; c++)
        rb_friction_project(t->d, t->local->mu[c], p + c * t->d, p + c * t->d);
    t->info->flops += 12.0 * t->m;
}

static double distance(int n, const double *x, const double *y)
{
    double sum = 0.0;
    for (int k = 0; k < n; k++)
        sum += (x[k] - y[k]) * (x[k] - y[k]);
    return sqrt(sum);
}

/* One step from r, uhat; ||r_{k+1} - r_k|| / ||r_{k+1}||.  rho shrinks until the step
 * passes, and grows where it passed easily. */
static double advance(projector *s, int extragradient)
{
    rb_friction_task *t = s->task;
    double step, ratio;
    for (;;) {
        project_all(s, s->uhat, s->p);
        uhat_at(s, s->p, s->up);
        step = distance(t->m, s->p, t->r);
        ratio = step > 0.0 ? s->rho * distance(t->m, s->up, s->uhat) / step : 0.0;
        if (!(ratio > RB_FRICTION_UPK_MOST))
            break;
        s->rho *= RB_FRICTION_UPK_SHRINK;
    }
    if (extragradient) {
        project_all(s, s->up, s->p);
        step = distance(t->m, s->p, t->r);
        uhat_at(s, s->p, s->up);
    }
    memcpy(t->r, s->p, (size_t)t->m * sizeof(double));
    memcpy(s->uhat, s->up, (size_t)t->m * sizeof(double));
    if (step > 0.0 && ratio < RB_FRICTION_UPK_LEAST)
        s->rho /= RB_FRICTION_UPK_SHRINK;
    const double norm = rb_friction_norm((size_t)t->m, t->r);
    return norm > 0.0 ? step / norm : step;
}

static rb_status iterate(projector *s, int extragradient, int limit)
{
    rb_friction_task *t = s->task;
    double tau = t->opt.tol, error = rb_friction_task_error(t);
    if (rb_friction_task_accepts(t, error))
        return RB_OK;
    uhat_at(s, t->r, s->uhat);
    for (int k = 1; k <= limit; k++) {
        const double change = advance(s, extragradient);
        t->info->iters++;
        if (rb_friction_task_late(t))
            return RB_INTERRUPTED;
        if (change > tau && k % 200 && k < limit)
            continue;
        error = rb_friction_task_error(t);
        if (rb_friction_task_accepts(t, error))
            return RB_OK;
        if (!isfinite(error))
            return RB_SINGULAR;
        if (change <= 1e-17)
            return RB_INACCURATE;
        if (change <= tau)
            tau = fmin(0.5 * change, 0.9 * change * t->opt.tol / error);
    }
    return RB_MAXITER;
}

static rb_status solve(rb_friction_task *task, int extragradient)
{
    projector s;
    rb_status st = projector_init(task, &s);
    if (st == RB_OK)
        st = iterate(&s, extragradient, rb_friction_task_left(task, STEPS));
    projector_free(&s);
    return st;
}

rb_status rb_friction_fixed_point(rb_friction_task *task)
{
    return solve(task, 0);
}

rb_status rb_friction_extragradient(rb_friction_task *task)
{
    return solve(task, 1);
}
