/* Gauss-Seidel over the contacts, *Acary* (12), with the adaptive stop (14). */
#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEPS 100000
#define LEAST_CHANGE 1e-16 /* of (14), below which the sweeps stand still */
#define LOOK_EVERY 200     /* sweeps between looks at (13) that (14) did not ask for */

typedef struct {
    rb_friction_task *task;
    const rb_friction_blocks *blocks;
    rb_friction_contact *contact; /* contacts */
    double *rho;                  /* 2 per contact; NULL until one contact needs it */
    double *fixed;                /* contacts: rho of the fixed point, which adapts */
    int flags;                    /* rb_friction_sweep_flags */
    rb_friction_anderson anderson;
    double *start;         /* m, where accelerated: r before the sweep */
    double before;         /* (13) when it was last asked whether the sweeps stall */
    double touched, steps; /* blocks, steps at single contacts: to count operations */
    rb_status failed;
} sweeper;

/* u = W r + q of the task is kept up with every change of r. */
static void start_velocities(sweeper *s)
{
    const rb_friction_task *t = s->task;
    memcpy(t->u, t->local->q, (size_t)t->m * sizeof(double));
    s->touched += rb_friction_blocks_add_all(s->blocks, t->r, t->u);
}

static rb_status wanted_rho(sweeper *s)
{
    const size_t nc = (size_t)s->task->contacts;
    if (s->rho)
        return RB_OK;
    s->rho = rb_alloc(nc, 3);
    if (!s->rho)
        return RB_ENOMEM;
    rb_friction_blocks_rho(s->blocks, s->rho);
    s->fixed = s->rho + 2 * nc;
    for (size_t c = 0; c < nc; c++)
        s->fixed[c] = fmin(s->rho[2 * c], s->rho[2 * c + 1]);
    return RB_OK;
}

static rb_status sweeper_init(rb_friction_task *task, int flags, sweeper *s)
{
    *s = (sweeper){.task = task, .flags = flags};
    rb_status st = rb_friction_task_blocks(task, &s->blocks);
    if (st == RB_OK && (flags & RB_FRICTION_SWEEP_PROJECTION))
        st = wanted_rho(s);
    if (st != RB_OK)
        return st;
    s->contact = malloc((size_t)task->contacts * sizeof *s->contact);
    if (!s->contact)
        return RB_ENOMEM;
    for (int c = 0; c < task->contacts; c++)
        s->contact[c].W = NULL;
    start_velocities(s);
    return RB_OK;
}

static void sweeper_free(sweeper *s)
{
    rb_friction_anderson_free(&s->anderson);
    free(s->start);
    s->task->info->flops += 2.0 * s->task->d * s->task->d * s->touched + 80.0 * s->steps;
    free(s->contact);
    free(s->rho);
}

/* Made when the contact closes: many never do. */
static rb_friction_contact *wanted_contact(sweeper *s, int c)
{
    const int d = s->task->d;
    if (!s->contact[c].W)
        rb_friction_contact_init(
            d, s->task->local->mu[c],
            s->blocks->x + (size_t)s->blocks->diag[c] * (size_t)(d * d), &s->contact[c]);
    return &s->contact[c];
}

/* The new force of contact c where q is its velocity without it; steps taken. */
static int solve_contact(sweeper *s, int c, rb_friction_contact *contact, const double *q,
                         double *r)
{
    if (s->flags & RB_FRICTION_SWEEP_PROJECTION)
        return rb_friction_contact_fixed_point(contact, &s->fixed[c], q, r);
    const int steps = rb_friction_contact_exact(contact, q, r);
    if (steps)
        return steps;
    s->failed = wanted_rho(s);
    return s->failed == RB_OK ? rb_friction_contact_newton(contact, s->rho + 2 * c, q, r)
                              : 1;
}

/* One contact with the others held; returns ||change||^2. */
static double relax(sweeper *s, int c)
{
    const int d = s->task->d;
    double *r = s->task->r + c * d, *u = s->task->u + c * d;
    if (r[0] == 0.0 && r[1] == 0.0 && r[d - 1] == 0.0 && u[0] >= 0.0)
        return 0.0; /* it stays open */
    rb_friction_contact *contact = wanted_contact(s, c);
    const double *W = contact->W;
    double dr[3], q[3], change = 0.0;
    for (int a = 0; a < d; a++) {
        dr[a] = -r[a];
        q[a] = u[a];
        for (int b = 0; b < d; b++)
            q[a] -= W[a + b * d] * r[b];
    }
    s->steps += solve_contact(s, c, contact, q, r);
    for (int a = 0; a < d; a++) {
        dr[a] += r[a];
        change += dr[a] * dr[a];
    }
    if (change > 0.0) {
        rb_friction_blocks_add(s->blocks, c, dr, s->task->u);
        s->touched += s->blocks->p[c + 1] - s->blocks->p[c];
    }
    return change;
}

/* ||r_{k+1} - r_k|| / ||r_{k+1}||, (14) */
static double sweep(sweeper *s)
{
    const rb_friction_task *t = s->task;
    double change = 0.0;
    for (int c = 0; c < t->contacts; c++)
        change += relax(s, c);
    const double norm = rb_friction_norm((size_t)t->m, t->r);
    return norm > 0.0 ? sqrt(change) / norm : sqrt(change);
}

/* Early on, where a few sweeps may do, it looks at every power of two. */
static int looks_now(int k, int limit)
{
    return k % LOOK_EVERY == 0 || k == limit || (k < LOOK_EVERY && (k & (k - 1)) == 0);
}

/* What rounding of the velocities kept up cannot reach. */
#define SAFE_TOLERANCE 1e-12

/* (13) with the velocities at hand; recomputed where `refresh` or a close call asks for
 * it. */
static double look(sweeper *s, int refresh)
{
    rb_friction_task *t = s->task;
    const double tol = t->opt.tol;
    const double error =
        rb_friction_natural_norm(t->d, t->contacts, t->local->mu, t->r, t->u) /
        t->measure->scale;
    t->info->flops += 25.0 * t->m;
    const int clear = error > tol || (error <= 0.5 * tol && tol >= SAFE_TOLERANCE);
    return clear && !refresh ? error : rb_friction_task_error(t);
}

/* The next sweep starts from where the last ones point to. */
static rb_status accelerate(sweeper *s)
{
    rb_friction_task *t = s->task;
    if (s->start) {
        rb_friction_anderson_step(&s->anderson, s->start, t->r, t->u);
        t->info->flops += (6.0 + 8.0 * s->anderson.used) * t->m;
    } else { /* after the first sweep, which is often the last */
        s->start = rb_alloc((size_t)t->m, 1);
        if (!s->start || rb_friction_anderson_init(t->m, &s->anderson) != RB_OK)
            return RB_ENOMEM;
    }
    memcpy(s->start, t->r, (size_t)t->m * sizeof(double));
    return RB_OK;
}

#define STALL_FROM 16
#define STALL 0.85

/* (13) has hardly fallen while the number of sweeps doubled. */
static int stalled(sweeper *s, int k, double error)
{
    if (k < STALL_FROM / 2 || (k & (k - 1)) != 0)
        return 0;
    const double before = s->before;
    s->before = error;
    return k >= STALL_FROM && error > STALL * before;
}

/* After sweep k, which changed r by `change` (14); RB_MAXITER: it goes on.  tau: the
 * change at which the measure is worth a look. */
static rb_status judge(sweeper *s, int k, int limit, double change, double *tau)
{
    rb_friction_task *t = s->task;
    if (s->failed != RB_OK)
        return s->failed;
    if (rb_friction_task_late(t))
        return RB_INTERRUPTED;
    if (change > *tau && !looks_now(k, limit))
        return RB_MAXITER;
    const double error = look(s, k % LOOK_EVERY == 0 || change <= LEAST_CHANGE);
    if (rb_friction_task_accepts(t, error))
        return RB_OK;
    if (!isfinite(error))
        return RB_SINGULAR;
    if (change <= LEAST_CHANGE)
        return RB_INACCURATE;
    if ((s->flags & RB_FRICTION_SWEEP_UNLESS_STALLED) && stalled(s, k, error))
        return RB_INACCURATE;
    *tau = fmin(0.5 * change, 0.9 * change * t->opt.tol / error);
    return RB_MAXITER;
}

static rb_status sweep_until(sweeper *s, int limit)
{
    rb_friction_task *t = s->task;
    double tau = t->opt.tol;
    if (t->opt.r0 && rb_friction_task_accepts(t, look(s, 0)))
        return RB_OK;
    rb_status st = RB_MAXITER;
    for (int k = 1; st == RB_MAXITER && k <= limit; k++) {
        const double change = sweep(s);
        t->info->iters++;
        st = judge(s, k, limit, change, &tau);
        if (st == RB_MAXITER && (s->flags & RB_FRICTION_SWEEP_ANDERSON) && k < limit &&
            accelerate(s) != RB_OK)
            return RB_ENOMEM;
    }
    return st;
}

rb_status rb_friction_sweeps(rb_friction_task *task, int flags, int limit)
{
    sweeper s;
    rb_status st = sweeper_init(task, flags, &s);
    if (st == RB_OK)
        st = sweep_until(&s, limit);
    sweeper_free(&s);
    return st;
}

static int limit_of(const rb_friction_task *task)
{
    return rb_friction_task_left(task, SWEEPS);
}

rb_status rb_friction_nsgs_ac(rb_friction_task *task)
{
    return rb_friction_sweeps(task, 0, limit_of(task));
}

rb_status rb_friction_nsgs_aa(rb_friction_task *task)
{
    return rb_friction_sweeps(task, RB_FRICTION_SWEEP_ANDERSON, limit_of(task));
}

rb_status rb_friction_nsgs_fp(rb_friction_task *task)
{
    return rb_friction_sweeps(task, RB_FRICTION_SWEEP_PROJECTION, limit_of(task));
}
