/* Gauss-Seidel over the contacts, *Acary* (12), with the adaptive stop (14). */
#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEPS 100000
#define LOOK_EVERY 200 /* sweeps between looks at (13) that (14) did not ask for */

typedef struct {
    rb_friction_task *task;
    rb_friction_blocks blocks;
    double *rho;        /* 2 per contact */
    double *fixed;      /* contacts: rho of the fixed point, which adapts */
    double *inverse;    /* d x d per contact: of W's own block */
    int *regular;       /* contacts: that inverse exists */
    int use_projection; /* local solver: fixed point instead of Newton */
} sweeper;

static rb_status sweeper_init(rb_friction_task *task, int use_projection, sweeper *s)
{
    const int nc = task->contacts;
    *s = (sweeper){.task = task,
                   .use_projection = use_projection,
                   .rho = rb_alloc((size_t)nc, 2),
                   .fixed = rb_alloc((size_t)nc, 1),
                   .inverse = rb_alloc((size_t)nc, (size_t)(task->d * task->d)),
                   .regular = rb_alloc_int((size_t)nc)};
    rb_status st = s->rho && s->fixed && s->inverse && s->regular ? RB_OK : RB_ENOMEM;
    if (st == RB_OK)
        st = rb_friction_blocks_init(task->local, &s->blocks);
    if (st == RB_OK)
        rb_friction_blocks_rho(&s->blocks, s->rho);
    const size_t dd = (size_t)(task->d * task->d);
    for (int c = 0; st == RB_OK && c < nc; c++) {
        s->fixed[c] = fmin(s->rho[2 * c], s->rho[2 * c + 1]);
        s->regular[c] = rb_friction_contact_invert(
            task->d, s->blocks.x + (size_t)s->blocks.diag[c] * dd,
            s->inverse + (size_t)c * dd);
    }
    return st;
}

static void sweeper_free(sweeper *s)
{
    rb_friction_blocks_free(&s->blocks);
    free(s->regular);
    free(s->inverse);
    free(s->fixed);
    free(s->rho);
}

/* One contact with the others held; returns ||change||^2. */
static double relax(sweeper *s, int c, double *local_steps)
{
    const rb_friction_problem *p = s->task->local;
    const int d = p->dimension;
    double *r = s->task->r + c * d, old[3], q[3], change = 0.0;
    const double *W = s->blocks.x + (size_t)s->blocks.diag[c] * (size_t)(d * d);
    rb_friction_blocks_row(&s->blocks, c, s->task->r, q);
    for (int a = 0; a < d; a++) {
        old[a] = r[a];
        q[a] += p->q[c * d + a];
        for (int b = 0; b < d; b++)
            q[a] -= W[a + b * d] * r[b];
    }
    const rb_friction_contact alone = {.d = d,
                                       .mu = p->mu[c],
                                       .rho_n = s->rho[2 * c],
                                       .rho_t = s->rho[2 * c + 1],
                                       .W = W,
                                       .q = q,
                                       .inverse =
                                           s->regular[c] ? s->inverse + c * d * d : NULL};
    *local_steps += s->use_projection
                        ? rb_friction_contact_fixed_point(&alone, &s->fixed[c], r)
                        : rb_friction_contact_newton(&alone, r);
    for (int a = 0; a < d; a++)
        change += (r[a] - old[a]) * (r[a] - old[a]);
    return change;
}

/* ||r_{k+1} - r_k|| / ||r_{k+1}||, (14) */
static double sweep(sweeper *s)
{
    const rb_friction_task *t = s->task;
    double change = 0.0, steps = 0.0;
    for (int c = 0; c < t->contacts; c++)
        change += relax(s, c, &steps);
    t->info->flops += 2.0 * s->blocks.p[t->contacts] * t->d * t->d + 80.0 * steps;
    const double norm = rb_friction_norm((size_t)t->m, t->r);
    return norm > 0.0 ? sqrt(change) / norm : sqrt(change);
}

/* Early on, where a few sweeps may do, it looks at every power of two. */
static int looks_now(int k, int limit)
{
    return k % LOOK_EVERY == 0 || k == limit || (k < LOOK_EVERY && (k & (k - 1)) == 0);
}

static rb_status sweep_until(sweeper *s, int limit)
{
    rb_friction_task *t = s->task;
    double tau = t->opt.tol, error = rb_friction_task_error(t);
    if (rb_friction_task_accepts(t, error))
        return RB_OK;
    for (int k = 1; k <= limit; k++) {
        const double change = sweep(s);
        t->info->iters++;
        if (rb_friction_task_late(t))
            return RB_INTERRUPTED;
        if (change > tau && !looks_now(k, limit))
            continue;
        error = rb_friction_task_error(t);
        if (rb_friction_task_accepts(t, error))
            return RB_OK;
        if (!isfinite(error))
            return RB_SINGULAR;
        if (change <= 1e-16) /* the sweeps stand still short of the tolerance */
            return RB_INACCURATE;
        if (change <= tau)
            tau = fmin(0.5 * change, 0.9 * change * t->opt.tol / error);
    }
    return RB_MAXITER;
}

rb_status rb_friction_sweeps(rb_friction_task *task, int use_projection, int limit)
{
    sweeper s;
    rb_status st = sweeper_init(task, use_projection, &s);
    if (st == RB_OK)
        st = sweep_until(&s, limit);
    sweeper_free(&s);
    return st;
}

static int limit_of(const rb_friction_task *task)
{
    return task->opt.max_iters ? task->opt.max_iters : SWEEPS;
}

rb_status rb_friction_nsgs_ac(rb_friction_task *task)
{
    return rb_friction_sweeps(task, 0, limit_of(task));
}

rb_status rb_friction_nsgs_fp(rb_friction_task *task)
{
    return rb_friction_sweeps(task, 1, limit_of(task));
}

#define SWEEPS_BEFORE 100
#define STEPS_BEFORE_SEARCH 30

/* 100 sweeps find the rough state, Newton the digits: without line search as in *Acary*,
 * and where that cycles once more from the rough state with it. */
rb_status rb_friction_nsn_ac_hybrid(rb_friction_task *task)
{
    rb_status st = rb_friction_sweeps(task, 0, SWEEPS_BEFORE);
    if (st != RB_MAXITER && st != RB_INACCURATE)
        return st;
    const rb_friction_options given = task->opt;
    const size_t m = (size_t)task->m;
    double *rough = rb_alloc(m, 1);
    if (!rough)
        return RB_ENOMEM;
    memcpy(rough, task->r, m * sizeof *rough);
    if (!given.max_iters || given.max_iters > STEPS_BEFORE_SEARCH)
        task->opt.max_iters = STEPS_BEFORE_SEARCH;
    st = rb_friction_nsn_ac_nls(task);
    task->opt = given;
    if (st == RB_MAXITER || st == RB_SINGULAR) {
        memcpy(task->r, rough, m * sizeof *rough);
        st = rb_friction_nsn_ac(task);
    }
    free(rough);
    return st;
}
