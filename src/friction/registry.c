/* The solvers by name, and the one door through which they are called. */
#include "friction/internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Same order in both tables; auto is the first and runs others. */
static const rb_friction_solver solvers[] = {
    {"auto", "one method after the other until one meets the tolerance", 0},
    {"nsn-ac", "Newton on Alart-Curnier's function, line search", 0},
    {"nsn-ac-nls", "the same without line search", 0},
    {"nsn-jm", "Newton on Jean-Moreau's function, line search", 0},
    {"nsn-jm-nls", "the same without line search", 0},
    {"nsn-nm", "Newton on the natural map, line search", 0},
    {"nsn-nm-nls", "the same without line search", 0},
    {"nsn-fb", "Newton on Fischer-Burmeister's function, line search", 0},
    {"nsn-fb-nls", "the same without line search", 0},
    {"nsn-ac-hybrid", "7 sweeps, then nsn-ac-nls; if need be 100, then nsn-ac",
     RB_FRICTION_NEEDS_W},
    {"nsgs-ac", "Gauss-Seidel, Newton at each contact", RB_FRICTION_NEEDS_W},
    {"nsgs-aa", "the same with Anderson's acceleration", RB_FRICTION_NEEDS_W},
    {"nsgs-fp", "Gauss-Seidel, fixed point at each contact", RB_FRICTION_NEEDS_W},
    {"fixed-point", "projection with adaptive step", RB_FRICTION_NEEDS_W},
    {"extragradient", "projection, twice per step", RB_FRICTION_NEEDS_W},
    {"soclcp-smoothing", "smoothing and regularisation on Kanno's cones", 0},
    {"lemke", "Lemke's pivots on an LCP of size 3 n_c", RB_FRICTION_ONLY_2D},
};
static rb_friction_method *const methods[] = {
    rb_friction_auto,          rb_friction_nsn_ac,
    rb_friction_nsn_ac_nls,    rb_friction_nsn_jm,
    rb_friction_nsn_jm_nls,    rb_friction_nsn_nm,
    rb_friction_nsn_nm_nls,    rb_friction_nsn_fb,
    rb_friction_nsn_fb_nls,    rb_friction_nsn_ac_hybrid,
    rb_friction_nsgs_ac,       rb_friction_nsgs_aa,
    rb_friction_nsgs_fp,       rb_friction_fixed_point,
    rb_friction_extragradient, rb_friction_soclcp_smoothing,
    rb_friction_lemke,
};

const rb_friction_solver *rb_friction_solvers(int *count)
{
    *count = (int)(sizeof solvers / sizeof *solvers);
    return solvers;
}

rb_friction_options rb_friction_defaults(void)
{
    return (rb_friction_options){.tol = 1e-8};
}

const char *rb_friction_status_text(rb_status s, double tol, const rb_friction_info *info)
{
    if (s == RB_OK && info && info->residual > tol)
        return "solved-to-rounding";
    return rb_status_text(s);
}

/* ---- What solvers ask
 * ------------------------------------------------------------------ */

double rb_friction_task_error(rb_friction_task *task)
{
    double error;
    const rb_friction_problem *p = task->problem;
    const rb_status s =
        rb_friction_measure_error(task->measure, task->r, task->v, task->u, &error);
    const double m = task->m;
    task->info->flops += 25.0 * m;
    if (p->form == RB_FRICTION_LOCAL_DENSE)
        task->info->flops += 2.0 * m * m;
    else if (p->form == RB_FRICTION_LOCAL_SPARSE)
        task->info->flops += 2.0 * p->Ws.p[task->m];
    else
        task->info->flops += 4.0 * p->H.p[task->m] + 2.0 * p->K.p[task->n];
    return s == RB_OK ? error : INFINITY;
}

/* A floor beyond this means an iterate that runs away, not rounding. */
#define LARGEST_FLOOR 1e-6

/* r - P_K(r - uhat) in numbers of size ||r||: below this it says nothing, and is exactly
 * 0 for any r that is large enough. */
static double resolution(const rb_friction_task *task)
{
    return DBL_EPSILON * rb_friction_norm((size_t)task->m, task->r) /
           task->measure->scale;
}

int rb_friction_task_accepts(const rb_friction_task *task, double error)
{
    double allowed = task->opt.tol;
    if (!(error <= allowed) && !(error <= LARGEST_FLOOR))
        return 0;
    const double least = resolution(task);
    /* the floor costs as much as the error: ask only when it can matter */
    if (error > allowed || least > allowed)
        allowed = fmax(allowed,
                       fmin(LARGEST_FLOOR,
                            rb_friction_measure_floor(task->measure, task->r, task->v)));
    return error <= allowed && least <= allowed;
}

int rb_friction_task_left(const rb_friction_task *task, int own)
{
    const int most = task->opt.max_iters;
    if (!most)
        return own;
    const int left = most > task->info->iters ? most - task->info->iters : 0;
    return left < own ? left : own;
}

int rb_friction_task_late(const rb_friction_task *task)
{
    return task->deadline > 0.0 && rb_seconds() > task->deadline;
}

/* ---- One call
 * -------------------------------------------------------------------------- */

static int find_solver(const char *name)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++)
        if (!strcmp(all[k].name, name))
            return k;
    return -1;
}

static rb_status check_call(const char *name, const rb_friction_problem *p,
                            const rb_friction_options *opt, int *chosen, rb_message *why)
{
    *chosen = find_solver(name);
    if (*chosen < 0)
        return rb_fail(why, RB_EINVAL, "no friction solver named '%s'", name);
    if (!(opt->tol > 0.0) || opt->max_iters < 0 || !(opt->seconds >= 0.0))
        return rb_fail(why, RB_EINVAL, "tol = %g, max_iters = %d, seconds = %g", opt->tol,
                       opt->max_iters, opt->seconds);
    const rb_status s = rb_friction_problem_check(p, why);
    if (s == RB_OK && (solvers[*chosen].needs & RB_FRICTION_ONLY_2D) && p->dimension != 2)
        return rb_fail(why, RB_EINVAL, "%s solves problems in 2D only", name);
    return s;
}

int rb_friction_prove(rb_friction_task *task)
{
    task->info->residual = rb_friction_task_error(task);
    task->info->floor = rb_friction_measure_floor(task->measure, task->r, task->v);
    return rb_friction_task_accepts(task, task->info->residual);
}

rb_status rb_friction_run(rb_friction_task *task, rb_friction_method *method)
{
    const rb_status s = method(task);
    if (s < 0)
        return s;
    if (rb_friction_prove(task))
        return RB_OK;
    return s == RB_OK ? RB_INACCURATE : s;
}

rb_status rb_friction_task_condense(rb_friction_task *task)
{
    if (task->local)
        return RB_OK;
    const rb_status s =
        rb_friction_condense(task->problem, &task->condensed, &task->info->msg);
    if (s == RB_OK)
        task->local = &task->condensed;
    return s;
}

rb_status rb_friction_task_blocks(rb_friction_task *task,
                                  const rb_friction_blocks **blocks)
{
    *blocks = &task->blocks;
    return task->blocks.x ? RB_OK : rb_friction_blocks_init(task->local, &task->blocks);
}

static rb_status prepare(rb_friction_task *task, int needs)
{
    rb_status s = RB_OK;
    if (task->problem->form != RB_FRICTION_GLOBAL)
        task->local = task->problem;
    if (needs & RB_FRICTION_NEEDS_W)
        s = rb_friction_task_condense(task);
    if (s != RB_OK)
        return s;
    s = rb_friction_measure_init(task->problem, task->measure);
    if (s == RB_SINGULAR)
        return rb_fail(&task->info->msg, s,
                       "K is singular even with every contact held: the structure has "
                       "motions that no contact sees");
    return s;
}

static void load_start(rb_friction_task *task)
{
    const rb_friction_options *opt = &task->opt;
    for (int k = 0; k < task->m; k++)
        task->r[k] = opt->r0 ? opt->r0[k] : 0.0;
    for (int i = 0; i < task->n; i++)
        task->v[i] = opt->v0 ? opt->v0[i] : 0.0;
}

rb_status rb_friction_solve(const char *solver, const rb_friction_problem *problem,
                            const rb_friction_options *opt, double *r, double *u,
                            double *v, rb_friction_info *info)
{
    const double start = rb_seconds();
    const rb_friction_options used = opt ? *opt : rb_friction_defaults();
    const char *name = solver ? solver : "auto";
    int chosen;
    rb_friction_info unwanted;
    if (!info)
        info = &unwanted;
    *info = (rb_friction_info){.solver = name, .residual = INFINITY};
    rb_status s = check_call(name, problem, &used, &chosen, &info->msg);
    if (s != RB_OK)
        return s;

    rb_friction_measure measure = {0};
    const int n = problem->form == RB_FRICTION_GLOBAL ? problem->dofs : 0;
    double *own_v = v || !n ? NULL : rb_alloc((size_t)n, 1);
    rb_friction_task task = {.problem = problem,
                             .measure = &measure,
                             .opt = used,
                             .info = info,
                             .d = problem->dimension,
                             .contacts = problem->contacts,
                             .m = problem->dimension * problem->contacts,
                             .n = n,
                             .deadline = used.seconds > 0.0 ? start + used.seconds : 0.0,
                             .r = r,
                             .u = u,
                             .v = v   ? v
                                  : n ? own_v
                                      : r}; /* n = 0: never touched */
    info->solver = solvers[chosen].name;
    s = task.v ? prepare(&task, solvers[chosen].needs) : RB_ENOMEM;
    if (s == RB_OK) {
        load_start(&task);
        s = chosen ? rb_friction_run(&task, methods[chosen]) : rb_friction_auto(&task);
    }
    rb_friction_measure_free(&measure);
    rb_friction_blocks_free(&task.blocks);
    rb_friction_problem_free(&task.condensed);
    free(own_v);
    info->seconds = rb_seconds() - start;
    return s;
}
