/* Alternating directions (ADMM): the linear system on one side, the cones on the other.
 *
 *     (W + P) r = P (z - y) - q - s,    s = mu ||u_T|| e_N of the step before,
 *     z = P_K(r' + y),   y += r' - z,   r' = ALPHA r + (1 - ALPHA) z,
 *
 * P = penalty W_NN of each contact.  -P y tends to uhat.  W + P has one factorisation as
 * long as the penalty stays, and an inverse however redundant the contacts are; the
 * penalty follows the balance of the two residuals, ||r - z|| and the change of z, at
 * iterations that lie ever farther apart.  The iteration is accelerated as the sweeps
 * are. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ITERATIONS 50000
#define ALPHA 1.6
#define FIRST_PENALTY 0.1
#define BALANCE 3.0      /* one residual so many times the other: the penalty moves */
#define MEASURE_EVERY 10 /* iterations between evaluations of the measure */

typedef struct {
    rb_friction_task *task;
    rb_friction_system system;
    double *A, *B;         /* m d each: P and 1, for the system */
    double *z, *y, *s, *r; /* m */
    double *x, *before;    /* m: z + y, the state of the iteration, and the one before */
    double penalty;
    double primal, dual; /* squares of the residuals since the penalty was looked at */
    int k, limit, next;  /* next: when the penalty is looked at */
    int begun, factored;
    double cost; /* of the first factorisation at most; 0 once it is done */
    rb_anderson anderson;
} admm;

/* z, y and s from the state x = z + y */
static void split(admm *a)
{
    const rb_friction_task *t = a->task;
    const int d = t->d;
    for (int c = 0; c < t->contacts; c++) {
        const double unit = a->penalty / t->measure->rho[2 * c], mu = t->problem->mu[c];
        double u[3];
        rb_friction_project(d, mu, a->x + c * d, a->z + c * d);
        for (int i = c * d; i < (c + 1) * d; i++) {
            a->y[i] = a->x[i] - a->z[i];
            u[i - c * d] = -unit * a->y[i];
        }
        a->s[c * d] = mu * rb_friction_tangential(d, u);
    }
}

static rb_status factor(admm *a)
{
    rb_friction_task *t = a->task;
    const int d = t->d;
    for (int c = 0; c < t->contacts; c++)
        for (int i = 0; i < d; i++)
            a->A[(c * d + i) * d + i] = a->penalty / t->measure->rho[2 * c];
    const rb_status st = rb_friction_local_factor(&a->system, a->A, a->B);
    rb_friction_system_count(&a->system, t);
    return st;
}

static void finish_admm(void *state)
{
    admm *a = state;
    rb_anderson_free(&a->anderson);
    rb_friction_system_free(&a->system);
    free(a->A);
}

static rb_status start_admm(rb_friction_task *task, int variant, void *state)
{
    (void)variant;
    const size_t m = (size_t)task->m, d = (size_t)task->d;
    admm *a = state;
    *a = (admm){.task = task,
                .A = rb_alloc(m, 2 * d + 6),
                .penalty = FIRST_PENALTY,
                .limit = rb_friction_task_left(task, ITERATIONS),
                .next = MEASURE_EVERY};
    if (!a->A)
        return RB_ENOMEM;
    a->B = a->A + m * d;
    a->z = a->B + m * d;
    a->y = a->z + m;
    a->s = a->y + m;
    a->r = a->s + m;
    a->x = a->r + m;
    a->before = a->x + m;
    for (size_t i = 0; i < m; i++)
        a->B[i * d + i % d] = 1.0;
    memcpy(a->x, task->r, m * sizeof(double));
    split(a);
    rb_status st = rb_anderson_init(task->m, &a->anderson);
    if (st == RB_OK)
        st = rb_friction_system_init(task, 0, &a->system);
    return st;
}

static rb_status go_on_alternating(void *state)
{
    admm *a = state;
    rb_friction_task *t = a->task;
    if (!a->begun)
        memcpy(t->r, a->z, (size_t)t->m * sizeof(double));
    rb_status st = rb_friction_system_begin(&a->system, t, &a->begun, &a->cost);
    if (st == RB_MAXITER && !rb_friction_task_affords(t, a->cost))
        return st;
    if (st == RB_MAXITER && !a->factored) {
        st = factor(a);
        a->factored = 1;
        a->cost = 0.0;
        if (st != RB_OK)
            return st;
        st = RB_MAXITER;
    }
    while (st == RB_MAXITER && a->k < a->limit && rb_friction_task_goes_on(t)) {
        /* One iteration from z, y and s, which belong to the state `before`. */
        const double *q = t->shared->local->q, *rho = t->measure->rho;
        const int d = t->d;
        memcpy(a->before, a->x, (size_t)t->m * sizeof(double));
        /* (W + P) r = P (z - y) - q - s */
        for (int i = 0; i < t->m; i++)
            a->r[i] = a->penalty / rho[2 * (i / d)] * (a->z[i] - a->y[i]) - q[i] - a->s[i];
        st = rb_friction_local_solve(&a->system, a->r);
        if (st != RB_OK)
            return st;
        /* x = r' + y, of which the next z is the projection; the residuals as velocities. */
        for (int i = 0; i < t->m; i++) {
            const double unit = a->penalty / rho[2 * (i / d)], z = a->z[i];
            a->x[i] = ALPHA * a->r[i] + (1.0 - ALPHA) * z + a->y[i];
            a->primal += unit * unit * (a->r[i] - z) * (a->r[i] - z);
            a->dual += unit * unit * (a->x[i] - a->before[i]) * (a->x[i] - a->before[i]);
        }
        rb_anderson_step(&a->anderson, a->before, a->x, a->r);
        split(a); /* z = P_K(x), y = x - z, s of -P y */
        t->info->flops += (46.0 + 8.0 * a->anderson.used) * t->m;
        rb_friction_system_count(&a->system, t);
        a->k++;
        t->info->iters++;
        if (a->k == a->next) {
            /* A larger penalty holds r and z together, a smaller one lets z move. */
            const double ratio = sqrt(a->primal / a->dual), former = a->penalty;
            a->primal = a->dual = 0.0;
            a->next = 2 * a->k;
            if (isfinite(ratio) && (ratio >= BALANCE || ratio <= 1.0 / BALANCE)) {
                a->penalty *= fmax(0.02, fmin(50.0, ratio));
                for (int i = 0; i < t->m; i++) /* P y, the velocity, stays */
                    a->x[i] = a->z[i] + a->y[i] * former / a->penalty;
                split(a);
                rb_anderson_forget(&a->anderson);
                st = factor(a);
            }
        }
        if (st == RB_OK) {
            st = RB_MAXITER;
            if (a->k % MEASURE_EVERY == 0 || a->k == a->limit) {
                memcpy(t->r, a->z, (size_t)t->m * sizeof(double));
                st = rb_friction_task_assess(t);
            }
        }
    }
    return st;
}

const rb_friction_method rb_friction_admm = {
    .size = sizeof(admm), .start = start_admm, .go_on = go_on_alternating, .finish = finish_admm};
