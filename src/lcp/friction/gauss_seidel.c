/* Gauss-Seidel over the contacts, *Acary* (12), with the adaptive stop (14). */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEPS 100000
#define LEAST_CHANGE 1e-16 /* of (14), below which the sweeps stand still */
#define MEASURE_EVERY 200  /* sweeps between looks at (13) that (14) did not ask for */

/* Anderson's acceleration, where the sweeps are accelerated and the first did not do. */
typedef struct {
    rb_anderson anderson;
    double *start;   /* m: r before the sweep; owns kept too */
    double *kept;    /* 2 m: r and u after the sweep of the least change */
    double least;    /* that change (14) */
    int since;       /* number of that sweep */
    int plain, rest; /* sweeps without acceleration: still to do, and next time */
    int fresh;       /* the acceleration has seen no sweep since it was left off */
} acceleration;

typedef struct {
    rb_friction_task *task;
    const rb_friction_blocks *blocks;
    rb_friction_contact *contact; /* of the task */
    double *lambda;               /* contacts: of the last slip */
    double *rho;                  /* 2 per contact; NULL until one contact needs it */
    double *fixed;                /* contacts: rho of the fixed point, which adapts */
    int flags;                    /* rb_friction_sweep_flags */
    acceleration *faster;         /* NULL: not begun */
    int k, limit;                 /* sweeps done, and at most */
    double tau;                   /* change (14) at which the measure is worth a look */
    double before;                /* the measure when it was last asked whether the sweeps stall */
    double touched, steps;        /* blocks, steps at single contacts: not yet counted */
    rb_status failed;
} sweeper;

static rb_status wanted_rho(sweeper *s)
{
    const size_t nc = (size_t)s->task->contacts;
    if (s->rho)
        return RB_OK;
    s->rho = rb_alloc(nc, 3);
    if (!s->rho)
        return RB_ENOMEM;
    const rb_status st = rb_friction_rho(s->task->shared->local, s->rho);
    s->fixed = s->rho + 2 * nc;
    for (size_t c = 0; c < nc; c++)
        s->fixed[c] = fmin(s->rho[2 * c], s->rho[2 * c + 1]);
    return st;
}

static rb_status start_sweeps(rb_friction_task *task, int flags, void *state)
{
    sweeper *s = state;
    *s = (sweeper){.task = task,
                   .flags = flags,
                   .limit = rb_friction_task_left(task, SWEEPS),
                   .tau = task->opt.tol};
    rb_status st = rb_friction_task_blocks(task, &s->blocks);
    if (st == RB_OK && (flags & RB_FRICTION_SWEEP_PROJECTION))
        st = wanted_rho(s);
    if (st != RB_OK)
        return st;
    st = rb_friction_task_contacts(task, &s->contact);
    s->lambda = malloc((size_t)task->contacts * sizeof *s->lambda);
    if (st != RB_OK || !s->lambda)
        return RB_ENOMEM;
    for (int c = 0; c < task->contacts; c++)
        s->lambda[c] = 0.0;
    /* u = W r + q of the task is kept up with every change of r. */
    const rb_friction_task *t = s->task;
    memcpy(t->u, t->shared->local->q, (size_t)t->m * sizeof(double));
    s->touched += rb_friction_blocks_add_all(s->blocks, t->r, t->u);
    return RB_OK;
}

static void finish_sweeps(void *state)
{
    sweeper *s = state;
    if (s->faster) {
        rb_anderson_free(&s->faster->anderson);
        free(s->faster->start);
        free(s->faster);
    }
    free(s->lambda);
    free(s->rho);
}

/* One contact with the others held; returns ||change||^2.  Inline, so that its short
 * loops are compiled for each dimension. */
static inline double relax(int d, sweeper *s, int c)
{
    double *r = s->task->r + c * d, *u = s->task->u + c * d;
    if (r[0] == 0.0 && r[1] == 0.0 && r[d - 1] == 0.0 && u[0] >= 0.0)
        return 0.0; /* it stays open */
    if (!s->contact[c].W)
        rb_friction_contact_init(s->task->d, s->task->shared->local->mu[c],
                                 s->blocks->x +
                                     (size_t)s->blocks->diag[c] * (size_t)(s->task->d * s->task->d),
                                 &s->contact[c]);
    const rb_friction_contact *contact = &s->contact[c];
    const double *W = contact->W;
    double dr[3], q[3], change = 0.0;
    for (int a = 0; a < d; a++) {
        dr[a] = -r[a];
        q[a] = u[a];
        for (int b = 0; b < d; b++)
            q[a] -= W[a + b * d] * r[b];
    }
    /* The new force of contact c where q is its velocity without it; steps taken. */
    if (s->flags & RB_FRICTION_SWEEP_PROJECTION)
        s->steps += rb_friction_contact_fixed_point(contact, &s->fixed[c], q, r);
    else {
        const int steps = rb_friction_contact_exact(contact, &s->lambda[c], q, r);
        if (steps)
            s->steps += steps;
        else {
            s->failed = wanted_rho(s);
            s->steps +=
                s->failed == RB_OK ? rb_friction_contact_newton(contact, s->rho + 2 * c, q, r) : 1;
        }
    }
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

/* What rounding of the velocities kept up cannot reach. */
#define SAFE_TOLERANCE 1e-12

/* The measure with the current velocities; recomputed where `refresh` or a close call
 * asks for it. */
static double current_error(sweeper *s, int refresh)
{
    rb_friction_task *t = s->task;
    const double tol = t->opt.tol;
    const double error = rb_friction_measure_of(t->measure, t->r, t->u);
    t->info->flops += 25.0 * t->m;
    const int clear = error > tol || (error <= 0.5 * tol && tol >= SAFE_TOLERANCE);
    if (!clear || refresh)
        return rb_friction_task_error(t);
    rb_friction_task_seen(t, error);
    return error;
}

/* Acceleration that has not lowered the change to FALL of the least one for STALL_SWEEPS
 * sweeps leads nowhere: the sweeps go on without it from their best state, REST of them
 * the first time and twice as many each time after. */
#define FALL 0.7
#define STALL_SWEEPS 100
#define REST 100

/* The next sweep starts from where the last ones point to. */
static rb_status accelerate(sweeper *s, double change)
{
    rb_friction_task *t = s->task;
    acceleration *a = s->faster;
    if (!a) {
        const size_t m = (size_t)t->m;
        a = s->faster = calloc(1, sizeof *a);
        if (!a)
            return RB_ENOMEM;
        a->start = rb_alloc(m, 3);
        a->kept = a->start + m;
        a->rest = REST;
        a->fresh = 1;
        if (!a->start || rb_anderson_init(t->m, &a->anderson) != RB_OK)
            return RB_ENOMEM;
    }
    if (a->plain > 0 && --a->plain > 0)
        return RB_OK;
    if (a->fresh || change < FALL * a->least) {
        const size_t m = (size_t)s->task->m;
        a->least = change;
        a->since = s->k;
        memcpy(a->kept, s->task->r, m * sizeof(double));
        memcpy(a->kept + m, s->task->u, m * sizeof(double));
    } else if (s->k - a->since >= STALL_SWEEPS) {
        const size_t m = (size_t)s->task->m;
        memcpy(s->task->r, a->kept, m * sizeof(double));
        memcpy(s->task->u, a->kept + m, m * sizeof(double));
        rb_anderson_forget(&a->anderson);
        a->plain = a->rest;
        a->rest *= 2;
        a->fresh = 1;
        return RB_OK;
    }
    if (!a->fresh) {
        rb_anderson_step(&a->anderson, a->start, t->r, t->u);
        t->info->flops += (6.0 + 8.0 * a->anderson.used) * t->m;
    }
    a->fresh = 0;
    memcpy(a->start, t->r, (size_t)t->m * sizeof(double));
    return RB_OK;
}

#define STALL_FROM 16
#define STALL 0.85

static rb_status go_on_sweeping(void *state)
{
    sweeper *s = state;
    rb_friction_task *t = s->task;
    if (s->k == 0 && t->opt.r0 && rb_friction_task_accepts(t, current_error(s, 0)))
        return RB_OK;
    while (s->k < s->limit && rb_friction_task_goes_on(t)) {
        /* (12): each contact with the newest forces of all others, which u holds. */
        double sum = 0.0;
        if (t->d == 2)
            for (int c = 0; c < t->contacts; c++)
                sum += relax(2, s, c);
        else
            for (int c = 0; c < t->contacts; c++)
                sum += relax(3, s, c);
        s->k++;
        t->info->iters++;
        t->info->flops += 2.0 * t->d * t->d * s->touched + 80.0 * s->steps;
        s->touched = s->steps = 0.0;
        const double norm = rb_friction_norm((size_t)t->m, t->r);
        /* ||r_{k+1} - r_k|| / ||r_{k+1}||, (14) */
        const double change = norm > 0.0 ? sqrt(sum) / norm : sqrt(sum);
        if (s->failed != RB_OK)
            return s->failed;
        if (rb_friction_task_late(t))
            return RB_INTERRUPTED;
        /* Early on, where a few sweeps may do, it measures at every power of two. */
        const int power_of_two = (s->k & (s->k - 1)) == 0;
        int stalled = 0;
        if (change <= s->tau || s->k % MEASURE_EVERY == 0 || s->k == s->limit ||
            (s->k < MEASURE_EVERY && power_of_two)) {
            const double error =
                current_error(s, s->k % MEASURE_EVERY == 0 || change <= LEAST_CHANGE);
            const rb_status st = rb_friction_task_status(t, error, change <= LEAST_CHANGE);
            if (st != RB_MAXITER)
                return st;
            if (s->k >= STALL_FROM / 2 && power_of_two) {
                /* The measure has hardly fallen while the number of sweeps doubled. */
                stalled = s->k >= STALL_FROM && error > STALL * s->before;
                s->before = error;
            }
            s->tau = rb_friction_task_next_look(t, change, error);
        }
        if ((s->flags & RB_FRICTION_SWEEP_ANDERSON) && s->k < s->limit &&
            accelerate(s, change) != RB_OK)
            return RB_ENOMEM;
        if (stalled && (s->flags & RB_FRICTION_SWEEP_YIELD) && isinf(t->budget))
            t->budget = rb_friction_task_spent(t);
    }
    return RB_MAXITER;
}

const rb_friction_method rb_friction_sweeps = {.size = sizeof(sweeper),
                                               .start = start_sweeps,
                                               .go_on = go_on_sweeping,
                                               .finish = finish_sweeps};
