/* Nonsmooth Newton on either form: Phi(x) dx = -F(x), *Acary* (11), with and without line
 * search. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>

#define STEPS 200
#define MEMORY 5 /* merit values a step may rise to */
#define HALVINGS 12
#define LEAST_SHIFT 1e-12 /* of W's own blocks, added to W in the matrix (not in F) */
#define LARGEST_SHIFT 1e-3

typedef struct {
    rb_friction_task *task;
    rb_friction_function *function;
    rb_friction_system system;
    rb_friction_linearised at; /* the iterate; at.F owns all arrays */
    double *e;
    double *dr, *du, *dv;
    double *r, *u, *v; /* m, m, n: trial */
    double history[MEMORY];
    double shift;
    double last; /* operations of the last step; before it, an estimate */
    int k, limit, line_search, begun;
} newton;

static void finish_newton(void *state)
{
    newton *s = state;
    rb_friction_system_free(&s->system);
    free(s->at.F);
}

static rb_status start_newton(rb_friction_task *task, int variant, void *state)
{
    static rb_friction_function *const functions[] = {
        rb_friction_alart_curnier, rb_friction_jean_moreau, rb_friction_natural_map,
        rb_friction_fischer_burmeister};
    const size_t m = (size_t)task->m, n = (size_t)task->n, d = (size_t)task->d;
    newton *s = state;
    *s = (newton){.task = task,
                  .function = functions[variant & ~RB_FRICTION_LINE_SEARCH],
                  .line_search = variant & RB_FRICTION_LINE_SEARCH,
                  .limit = rb_friction_task_left(task, STEPS),
                  .shift = LEAST_SHIFT};
    s->at.F = rb_alloc(m * (5 + 2 * d) + 3 * n, 1);
    if (!s->at.F)
        return RB_ENOMEM;
    s->at.A = s->at.F + m;
    s->at.B = s->at.A + m * d;
    s->dr = s->at.B + m * d;
    s->du = s->dr + m;
    s->r = s->du + m;
    s->u = s->r + m;
    s->e = s->u + m;
    s->dv = s->e + n;
    s->v = s->dv + n;
    for (int k = 0; k < MEMORY; k++)
        s->history[k] = INFINITY;
    return rb_friction_system_init(task, task->n, &s->system);
}

/* F at (r, u), and A, B where wanted; returns ||F||^2 */
static double evaluate_map(newton *s, const double *r, const double *u, double *F)
{
    const rb_friction_task *t = s->task;
    const int d = t->d, dd = d * d;
    double sum = 0.0;
    for (int c = 0; c < t->contacts; c++) {
        const double *rho = s->system.rho + 2 * c;
        const rb_friction_cone cone = {d, t->problem->mu[c], rho[0], rho[1]};
        const rb_friction_linearised at = {F + c * d, s->at.A + c * dd, s->at.B + c * dd};
        s->function(&cone, r + c * d, u + c * d, &at);
        for (int a = 0; a < d; a++)
            sum += at.F[a] * at.F[a];
    }
    s->system.flops += 40.0 * t->m;
    return sum;
}

static rb_status step(newton *s)
{
    rb_friction_task *t = s->task;
    const double before = rb_friction_task_spent(t);
    /* F and its derivatives A by r and B by u; in the global form also e = K v - H r - f. */
    const double merit = evaluate_map(s, t->r, t->u, s->at.F);
    rb_friction_system_imbalance(&s->system, t->r, t->v, s->e);
    rb_status st = RB_SINGULAR;
    for (; st == RB_SINGULAR && s->shift <= LARGEST_SHIFT; s->shift *= 1e3) {
        /* W + shift / rho in the matrix keeps it regular where contacts are redundant;
         * the roots stay where they are. */
        const int d = s->task->d;
        for (int c = 0; c < s->task->contacts; c++)
            for (int b = 0; b < d; b++) {
                const double eta = s->shift / s->system.rho[2 * c + (b > 0)];
                for (int a = 0; a < d; a++)
                    s->at.A[(c * d + b) * d + a] += eta * s->at.B[(c * d + b) * d + a];
            }
        /* (11): (A + B W) dr = -F, or K dv - H dr = -e and A dr + B H' dv = -F. */
        st = rb_friction_system_step(&s->system, &s->at, s->e, s->dr, s->dv);
        if (st == RB_OK)
            break;
    }
    if (st == RB_OK) {
        /* du = W dr or H' dv: u is linear in the step, so that trials need no product. */
        rb_friction_system_velocity(&s->system, 0.0, s->dr, s->dv, s->du);
        const double e = rb_friction_norm((size_t)t->n, s->e), imbalance = e * e;
        double highest = merit + imbalance, lowest = INFINITY, length = 1.0;
        s->history[s->k % MEMORY] = merit + imbalance;
        for (int k = 0; k < MEMORY; k++)
            if (isfinite(s->history[k]))
                highest = fmax(highest, s->history[k]);
        /* Nonmonotone Armijo; the smallest merit seen where none is small enough.  Force
         * units throughout. */
        double at = 1.0;
        for (int k = 0; s->line_search && k <= HALVINGS; k++, at *= 0.5) {
            for (int i = 0; i < t->m; i++) {
                s->r[i] = t->r[i] + at * s->dr[i];
                s->u[i] = t->u[i] + at * s->du[i];
            }
            const double theta =
                evaluate_map(s, s->r, s->u, s->at.F) + (1.0 - at) * (1.0 - at) * imbalance;
            if (theta < lowest || theta <= (1.0 - 1e-4 * at) * highest)
                length = at;
            if (theta <= (1.0 - 1e-4 * at) * highest)
                break;
            lowest = fmin(lowest, theta);
        }
        for (int i = 0; i < t->m; i++)
            t->r[i] += length * s->dr[i];
        for (int i = 0; i < t->n; i++)
            t->v[i] += length * s->dv[i];
        t->info->iters++;
    }
    rb_friction_system_count(&s->system, t);
    s->last = rb_friction_task_spent(t) - before;
    return st;
}

static rb_status go_on_stepping(void *state)
{
    newton *s = state;
    rb_friction_task *t = s->task;
    rb_status st = rb_friction_system_begin(&s->system, t, &s->begun, &s->last);
    while (st == RB_MAXITER && s->k < s->limit && rb_friction_task_left(t, 1)) {
        if (!rb_friction_task_affords(t, s->last))
            return st;
        st = step(s);
        s->k++;
        if (st == RB_OK)
            st = rb_friction_task_assess(s->task);
    }
    return st;
}

const rb_friction_method rb_friction_newton = {.size = sizeof(newton),
                                               .start = start_newton,
                                               .go_on = go_on_stepping,
                                               .finish = finish_newton};
