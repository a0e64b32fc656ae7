/* The solvers by name: one row each, from which the calls, --solver, the help and the
 * documentation come. */
#include "friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SEARCH RB_FRICTION_LINE_SEARCH
#define WANTS_W RB_FRICTION_NEEDS_W
#define FLAT RB_FRICTION_ONLY_2D

static const rb_friction_solver solvers[] = {
    {"auto", "portfolio", "several methods in turn until one meets the tolerance", 0,
     &rb_friction_auto_method, 0},
    {"nsn-ac", "Newton", "on Alart-Curnier's function, with line search", 0,
     &rb_friction_newton, RB_FRICTION_ALART_CURNIER | SEARCH},
    {"nsn-ac-nls", "Newton", "the same without line search", 0, &rb_friction_newton,
     RB_FRICTION_ALART_CURNIER},
    {"nsn-jm", "Newton", "on Jean-Moreau's function, with line search", 0,
     &rb_friction_newton, RB_FRICTION_JEAN_MOREAU | SEARCH},
    {"nsn-jm-nls", "Newton", "the same without line search", 0, &rb_friction_newton,
     RB_FRICTION_JEAN_MOREAU},
    {"nsn-nm", "Newton", "on the natural map, with line search", 0, &rb_friction_newton,
     RB_FRICTION_NATURAL_MAP | SEARCH},
    {"nsn-nm-nls", "Newton", "the same without line search", 0, &rb_friction_newton,
     RB_FRICTION_NATURAL_MAP},
    {"nsn-fb", "Newton", "on Fischer-Burmeister's function, with line search", 0,
     &rb_friction_newton, RB_FRICTION_FISCHER_BURMEISTER | SEARCH},
    {"nsn-fb-nls", "Newton", "the same without line search", 0, &rb_friction_newton,
     RB_FRICTION_FISCHER_BURMEISTER},
    {"nsn-ac-hybrid", "sweeps, Newton",
     "7 sweeps, then nsn-ac-nls; if need be 100, then nsn-ac", WANTS_W,
     &rb_friction_hybrid, 0},
    {"nsgs-ac", "sweeps", "Gauss-Seidel, each contact solved exactly", WANTS_W,
     &rb_friction_sweeps, 0},
    {"nsgs-aa", "sweeps", "the same with Anderson's acceleration", WANTS_W,
     &rb_friction_sweeps, RB_FRICTION_SWEEP_ANDERSON},
    {"nsgs-fp", "sweeps", "Gauss-Seidel, fixed point at each contact", WANTS_W,
     &rb_friction_sweeps, RB_FRICTION_SWEEP_PROJECTION},
    {"fixed-point", "projection", "of all contacts at once, with adaptive step", WANTS_W,
     &rb_friction_projections, RB_FRICTION_FIXED_POINT},
    {"extragradient", "projection", "of all contacts at once, twice per step", WANTS_W,
     &rb_friction_projections, RB_FRICTION_EXTRAGRADIENT},
    {"admm", "splitting", "linear system and cones in turn", WANTS_W, &rb_friction_admm,
     0},
    {"soclcp-smoothing", "smoothing", "and regularisation on Kanno's cones", 0,
     &rb_friction_smoothing_method, 0},
    {"lemke", "pivots", "Lemke's on an LCP of size 3 n_c", FLAT,
     &rb_friction_lemke_method, 0},
};

const rb_friction_solver *rb_friction_solvers(int *count)
{
    *count = (int)(sizeof solvers / sizeof *solvers);
    return solvers;
}

const rb_friction_solver *rb_friction_solver_named(const char *name)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++)
        if (!strcmp(all[k].name, name))
            return &all[k];
    return NULL;
}

rb_friction_options rb_friction_defaults(void)
{
    return (rb_friction_options){.tol = 1e-8};
}

const char *rb_friction_status_text(rb_status s, double tol, const rb_friction_info *info)
{
    if (s == RB_OK && info && info->scaled > tol)
        return "solved-to-rounding";
    return rb_status_text(s);
}

/* ---- One call -------------------------------------------------------------------------
 */

static rb_status check_call(const char *name, const rb_friction_problem *p,
                            const rb_friction_options *opt,
                            const rb_friction_solver **chosen, rb_message *why)
{
    *chosen = rb_friction_solver_named(name);
    if (!*chosen)
        return rb_fail(why, RB_EINVAL, "no friction solver named '%s'", name);
    if (!(opt->tol > 0.0) || opt->max_iters < 0 || !(opt->seconds >= 0.0))
        return rb_fail(why, RB_EINVAL, "tol = %g, max_iters = %d, seconds = %g", opt->tol,
                       opt->max_iters, opt->seconds);
    const rb_status s = rb_friction_problem_check(p, why);
    if (s == RB_OK && ((*chosen)->needs & FLAT) && p->dimension != 2)
        return rb_fail(why, RB_EINVAL, "%s solves problems in 2D only", name);
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

/* What the method ends with is proved; where that is no solution, the best iterate is
 * what is handed back. */
static rb_status run_and_prove(rb_friction_task *task, const rb_friction_solver *solver)
{
    rb_status s = RB_OK;
    if (solver->needs & WANTS_W)
        s = rb_friction_task_condense(task);
    if (s != RB_OK)
        return s;
    load_start(task);
    s = rb_friction_run(task, solver->run, solver->variant, 0);
    if (s < 0)
        return s;
    if (s != RB_OK)
        rb_friction_task_recall(task);
    if (rb_friction_prove(task))
        return RB_OK;
    return s == RB_OK ? RB_INACCURATE : s;
}

rb_status rb_friction_solve(const char *solver, const rb_friction_problem *problem,
                            const rb_friction_options *opt, double *r, double *u,
                            double *v, rb_friction_info *info)
{
    const double start = rb_seconds();
    const rb_friction_options used = opt ? *opt : rb_friction_defaults();
    const char *name = solver ? solver : "auto";
    const rb_friction_solver *chosen;
    rb_friction_info unwanted;
    if (!info)
        info = &unwanted;
    *info = (rb_friction_info){.solver = name, .residual = INFINITY, .scaled = INFINITY};
    rb_status s = check_call(name, problem, &used, &chosen, &info->msg);
    if (s != RB_OK)
        return s;

    const int m = problem->dimension * problem->contacts;
    const int n = problem->form == RB_FRICTION_GLOBAL ? problem->dofs : 0;
    double *memory = malloc((size_t)(m + 2 * n) * sizeof *memory);
    rb_friction_shared shared = {0};
    rb_friction_record best = {.r = memory, .error = INFINITY};
    rb_friction_task task = {.shared = &shared,
                             .problem = problem,
                             .measure = &shared.measure,
                             .best = &best,
                             .opt = used,
                             .info = info,
                             .d = problem->dimension,
                             .contacts = problem->contacts,
                             .m = m,
                             .n = n,
                             .deadline = used.seconds > 0.0 ? start + used.seconds : 0.0,
                             .budget = INFINITY,
                             .r = r,
                             .u = u,
                             .v = v ? v : memory + m + n};
    info->solver = chosen->name;
    s = memory ? rb_friction_shared_init(problem, &shared, &info->msg) : RB_ENOMEM;
    if (s == RB_OK)
        s = run_and_prove(&task, chosen);
    rb_friction_shared_free(&shared);
    free(memory);
    info->seconds = rb_seconds() - start;
    return s;
}
