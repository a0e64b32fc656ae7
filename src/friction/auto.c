/* The safeguarded choice: methods in the order in which they tend to be quick, each from
 * the start given, until one meets the tolerance; otherwise the best point seen. */
#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum {
    RESUME = 1,  /* from where the stage before ended, instead of the start */
    NEEDS_W = 2, /* condensed when first wanted; skipped where there is none */
    GIVEN_W = 4, /* only for problems that came in local form */
    ONLY_2D = 8,
    FROM_BEST = 16, /* from the best point so far */
    EARLY = 32      /* before long runs of sweeps; not where a factorisation is heavy */
} stage_flags;

typedef struct {
    const char *name;
    rb_friction_method *method;
    int limit; /* iterations; 0: the method's own */
    int flags;
} stage;

#define QUICK_SWEEPS 100

static rb_status quick_sweeps(rb_friction_task *task)
{
    return rb_friction_sweeps(
        task, RB_FRICTION_SWEEP_ANDERSON | RB_FRICTION_SWEEP_UNLESS_STALLED,
        rb_friction_task_left(task, QUICK_SWEEPS));
}

/* Some sweeps are cheap where W is there and solve most problems; where they stall,
 * Jean-Moreau's function is the one that cycles least from there.  The global form would
 * have to be condensed for them. */
static const stage stages[] = {
    {"nsgs-aa", quick_sweeps, QUICK_SWEEPS, GIVEN_W},
    {"nsn-jm-nls", rb_friction_nsn_jm_nls, 16, GIVEN_W | RESUME | EARLY},
    {"nsn-ac-nls", rb_friction_nsn_ac_nls, 12, GIVEN_W | FROM_BEST | EARLY},
    {"nsn-fb", rb_friction_nsn_fb, 15, GIVEN_W | EARLY},
    {"nsn-ac", rb_friction_nsn_ac, 25, GIVEN_W | EARLY},
    {"nsgs-aa", rb_friction_nsgs_aa, 1000, GIVEN_W},
    {"nsn-ac", rb_friction_nsn_ac, 40, EARLY},
    {"nsgs-aa", rb_friction_nsgs_aa, 1000, NEEDS_W},
    {"nsn-ac-nls", rb_friction_nsn_ac_nls, 30, NEEDS_W | RESUME | EARLY},
    {"nsn-fb", rb_friction_nsn_fb, 60, EARLY},
    {"nsn-nm", rb_friction_nsn_nm, 60, EARLY},
    {"nsn-jm", rb_friction_nsn_jm, 100, EARLY},
    {"soclcp-smoothing", rb_friction_soclcp_smoothing, 150, EARLY},
    {"lemke", rb_friction_lemke, 0, ONLY_2D},
    {"nsgs-fp", rb_friction_nsgs_fp, 5000, NEEDS_W},
    {"nsgs-ac", rb_friction_nsgs_ac, 20000, NEEDS_W},
    {"nsn-ac", rb_friction_nsn_ac, 60, FROM_BEST},
    {"nsn-fb", rb_friction_nsn_fb, 60, FROM_BEST},
    {"nsn-nm", rb_friction_nsn_nm, 60, FROM_BEST},
    {"nsn-jm", rb_friction_nsn_jm, 60, FROM_BEST},
    {"nsn-ac", rb_friction_nsn_ac, 400, 0},
    {"nsn-nm", rb_friction_nsn_nm, 500, FROM_BEST},
    {"nsgs-ac", rb_friction_nsgs_ac, 300000, NEEDS_W | FROM_BEST},
    {"extragradient", rb_friction_extragradient, 300000, NEEDS_W},
};

/* Dense tableaus beyond this take longer than what comes after. */
#define MOST_FOR_LEMKE 1000

typedef struct {
    double *start, *best; /* m + n each: r, v; start NULL: zero */
    int most;             /* iterations of all stages together; 0: no limit */
    double error;
    const char *solver;
} record;

static void load(rb_friction_task *task, const double *from)
{
    const size_t m = (size_t)task->m, n = (size_t)task->n;
    for (size_t k = 0; k < m; k++)
        task->r[k] = from ? from[k] : 0.0;
    for (size_t i = 0; i < n; i++)
        task->v[i] = from ? from[m + i] : 0.0;
}

/* 0: no memory */
static int store(const rb_friction_task *task, double **to)
{
    if (!*to)
        *to = rb_alloc((size_t)(task->m + task->n), 1);
    if (*to) {
        memcpy(*to, task->r, (size_t)task->m * sizeof **to);
        memcpy(*to + task->m, task->v, (size_t)task->n * sizeof **to);
    }
    return *to != NULL;
}

/* Long runs of sweeps on large problems stop here. */
#define MOST_OPERATIONS 1e11

static int affordable(const rb_friction_task *task, const stage *s)
{
    const double m = task->m;
    if (!task->local || !(s->flags & (NEEDS_W | GIVEN_W)))
        return s->limit;
    const double entries =
        task->local->form == RB_FRICTION_LOCAL_DENSE ? m * m : task->local->Ws.p[task->m];
    const double most = fmax(100.0, MOST_OPERATIONS / (2.0 * entries + 100.0 * m));
    return s->limit < most ? s->limit : (int)most;
}

static rb_status try_stage(rb_friction_task *task, const stage *s, record *rec)
{
    if (!(s->flags & RESUME))
        load(task, s->flags & FROM_BEST ? rec->best : rec->start);
    const int limit = affordable(task, s);
    task->opt.max_iters = rec->most;
    if (limit)
        task->opt.max_iters = task->info->iters + rb_friction_task_left(task, limit);
    const rb_status status = rb_friction_run(task, s->method);
    task->info->solver = s->name;
    if (status <= 0)
        return status;
    double error = task->info->residual;
    if (error <= task->opt.tol) /* r so large that the measure does not see it */
        error = INFINITY;
    if (error < rec->error || !rec->solver) {
        rec->error = error;
        rec->solver = s->name;
        if (!store(task, &rec->best))
            return RB_ENOMEM;
    }
    return status;
}

/* A dense LU of this order takes longer than a thousand sweeps. */
#define MOST_DENSE_ROWS 2500

static int heavy(const rb_friction_task *task)
{
    const double m = task->m;
    if (task->n || task->m <= MOST_DENSE_ROWS)
        return 0;
    return task->problem->form == RB_FRICTION_LOCAL_DENSE ||
           task->problem->Ws.p[task->m] > 0.1 * m * m;
}

/* W is condensed when the first stage asks for it. */
static int fits(rb_friction_task *task, const stage *s)
{
    if ((s->flags & EARLY) && heavy(task))
        return 0;
    if ((s->flags & ONLY_2D) && (task->d != 2 || task->contacts > MOST_FOR_LEMKE))
        return 0;
    if (s->flags & GIVEN_W)
        return !task->n;
    if (!(s->flags & NEEDS_W) || task->local)
        return 1;
    return task->measure->spring == 0.0 && rb_friction_task_condense(task) == RB_OK;
}

rb_status rb_friction_auto(rb_friction_task *task)
{
    const rb_friction_options given = task->opt;
    const size_t n = sizeof stages / sizeof *stages;
    record rec = {.most = given.max_iters, .error = INFINITY};
    rb_status s = RB_MAXITER;
    if ((given.r0 || given.v0) && !store(task, &rec.start))
        s = RB_ENOMEM;
    for (size_t k = 0; s > 0 && s != RB_INTERRUPTED && k < n; k++) {
        task->opt.max_iters = given.max_iters;
        if (k && !rb_friction_task_left(task, 1))
            break;
        if (fits(task, &stages[k]))
            s = try_stage(task, &stages[k], &rec);
    }
    if (s > 0 && s != RB_INTERRUPTED)
        s = RB_MAXITER; /* what the last stage stumbled on is not the reason */
    if (s > 0 && rec.solver) {
        load(task, rec.best);
        task->info->solver = rec.solver;
        rb_friction_prove(task);
    }
    task->opt = given;
    free(rec.best);
    free(rec.start);
    return s;
}
