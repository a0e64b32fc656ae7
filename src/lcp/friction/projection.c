/* Projection on the cones with a step rho that adapts itself: fixed point
 * r = P_K(r - rho uhat(r)) and extragradient (Korpelevich, Khobotov). */
#include "lcp/friction/internal.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#define STEPS 50000
#define LEAST_CHANGE 1e-17 /* of r, below which the steps stand still */
#define MEASURE_EVERY 200  /* steps between evaluations of the measure that no change asked for */

typedef struct {
    rb_friction_task *task;
    const rb_friction_blocks *blocks;
    double *uhat, *p, *up; /* at r; the projected point; uhat there */
    double rho, tau;       /* tau: change at which the measure is worth a look */
    int k, limit, extragradient, begun;
} projector;

static void uhat_at(const projector *s, const double *r, double *uhat)
{
    const rb_friction_problem *p = s->task->shared->local;
    const int d = p->dimension;
    rb_friction_blocks_apply(s->blocks, r, uhat);
    for (int c = 0; c < p->contacts; c++) {
        for (int a = 0; a < d; a++)
            uhat[c * d + a] += p->q[c * d + a];
        uhat[c * d] += p->mu[c] * rb_friction_tangential(d, uhat + c * d);
    }
    s->task->info->flops += 2.0 * s->blocks->p[p->contacts] * d * d + 8.0 * s->task->m;
}

static rb_status start_projections(rb_friction_task *task, int variant, void *state)
{
    const size_t m = (size_t)task->m;
    projector *s = state;
    *s = (projector){.task = task,
                     .uhat = rb_alloc(m, 3),
                     .rho = task->measure->rho[0],
                     .tau = task->opt.tol,
                     .limit = rb_friction_task_left(task, STEPS),
                     .extragradient = variant == RB_FRICTION_EXTRAGRADIENT};
    const rb_status st = s->uhat ? rb_friction_task_blocks(task, &s->blocks) : RB_ENOMEM;
    if (st != RB_OK)
        return st;
    s->p = s->uhat + m;
    s->up = s->p + m;
    uhat_at(s, task->r, s->uhat);
    return RB_OK;
}

static void finish_projections(void *state)
{
    free(((projector *)state)->uhat);
}

/* p = P_K(r - rho uhat) */
static void project_all(const projector *s, const double *uhat, double *p)
{
    const rb_friction_task *t = s->task;
    for (int k = 0; k < t->m; k++)
        p[k] = t->r[k] - s->rho * uhat[k];
    for (int c = 0; c < t->contacts; c++)
        rb_friction_project(t->d, t->problem->mu[c], p + c * t->d, p + c * t->d);
    t->info->flops += 12.0 * t->m;
}

static rb_status go_on_projecting(void *state)
{
    projector *s = state;
    rb_friction_task *t = s->task;
    rb_status st = s->begun ? RB_MAXITER : rb_friction_task_assess(t);
    s->begun = 1;
    while (st == RB_MAXITER && s->k < s->limit && rb_friction_task_goes_on(t)) {
        /* One step from r, uhat; ||r_{k+1} - r_k|| / ||r_{k+1}||.  rho shrinks until the
         * step passes, and grows where it passed easily.  Below the normal numbers it
         * shrinks no more: a problem with velocities beyond 1e300 has no step that
         * passes. */
        double step, ratio;
        for (;;) {
            project_all(s, s->uhat, s->p);
            uhat_at(s, s->p, s->up);
            step = rb_distance((size_t)t->m, s->p, t->r);
            ratio = step > 0.0 ? s->rho * rb_distance((size_t)t->m, s->up, s->uhat) / step : 0.0;
            if (!(ratio > RB_FRICTION_UPK_MOST) || s->rho < DBL_MIN)
                break;
            s->rho *= RB_FRICTION_UPK_SHRINK;
        }
        if (s->extragradient) {
            /* Korpelevich: the step from r with uhat of the point where the first one led. */
            project_all(s, s->up, s->p);
            step = rb_distance((size_t)t->m, s->p, t->r);
            uhat_at(s, s->p, s->up);
        }
        memcpy(t->r, s->p, (size_t)t->m * sizeof(double));
        memcpy(s->uhat, s->up, (size_t)t->m * sizeof(double));
        if (step > 0.0 && ratio < RB_FRICTION_UPK_LEAST)
            s->rho /= RB_FRICTION_UPK_SHRINK;
        const double norm = rb_friction_norm((size_t)t->m, t->r);
        const double change = norm > 0.0 ? step / norm : step;
        s->k++;
        t->info->iters++;
        if (rb_friction_task_late(t))
            return RB_INTERRUPTED;
        if (change <= s->tau || s->k % MEASURE_EVERY == 0 || s->k == s->limit) {
            const double error = rb_friction_task_error(t);
            st = rb_friction_task_status(t, error, change <= LEAST_CHANGE);
            if (change <= s->tau)
                s->tau = rb_friction_task_next_look(t, change, error);
        }
    }
    return st;
}

const rb_friction_method rb_friction_projections = {.size = sizeof(projector),
                                                    .start = start_projections,
                                                    .go_on = go_on_projecting,
                                                    .finish = finish_projections};
