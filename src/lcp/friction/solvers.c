/* The solvers by name: one row each, from which the calls, --solver, the help and the
 * documentation come. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SEARCH RB_FRICTION_LINE_SEARCH
#define WANTS_W RB_FRICTION_NEEDS_W
#define FLAT RB_FRICTION_ONLY_2D

static const rb_friction_solver solvers[] = {
    {"auto", "portfolio", "several methods in turn until one meets the tolerance", 0,
     &rb_friction_auto_method, 0},
    {"nsn-ac", "Newton", "on Alart-Curnier's function, with line search", 0, &rb_friction_newton,
     RB_FRICTION_ALART_CURNIER | SEARCH},
    {"nsn-ac-nls", "Newton", "the same without line search", 0, &rb_friction_newton,
     RB_FRICTION_ALART_CURNIER},
    {"nsn-jm", "Newton", "on Jean-Moreau's function, with line search", 0, &rb_friction_newton,
     RB_FRICTION_JEAN_MOREAU | SEARCH},
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
    {"nsn-ac-hybrid", "sweeps, Newton", "7 sweeps, then nsn-ac-nls; if need be 100, then nsn-ac",
     WANTS_W, &rb_friction_hybrid, 0},
    {"nsn-ac-hybrid-100", "sweeps, Newton", "100 sweeps, then nsn-ac-nls, as in the paper", WANTS_W,
     &rb_friction_hybrid, RB_FRICTION_HUNDRED_SWEEPS},
    {"nsgs-ac", "sweeps", "Gauss-Seidel, each contact solved exactly", WANTS_W, &rb_friction_sweeps,
     0},
    {"nsgs-aa", "sweeps", "the same with Anderson's acceleration", WANTS_W, &rb_friction_sweeps,
     RB_FRICTION_SWEEP_ANDERSON},
    {"nsgs-fp", "sweeps", "Gauss-Seidel, fixed point at each contact", WANTS_W, &rb_friction_sweeps,
     RB_FRICTION_SWEEP_PROJECTION},
    {"fixed-point", "projection", "of all contacts at once, with adaptive step", WANTS_W,
     &rb_friction_projections, RB_FRICTION_FIXED_POINT},
    {"extragradient", "projection", "of all contacts at once, twice per step", WANTS_W,
     &rb_friction_projections, RB_FRICTION_EXTRAGRADIENT},
    {"admm", "splitting", "linear system and cones in turn", WANTS_W, &rb_friction_admm, 0},
    {"soclcp-smoothing", "smoothing", "and regularisation on Kanno's cones", 0,
     &rb_friction_smoothing_method, 0},
    {"lemke", "pivots", "Lemke's method on an LCP", FLAT, &rb_friction_lemke_method, 0},
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

const rb_friction_solver *rb_friction_solver_of(const rb_friction_method *method, int variant)
{
    const rb_friction_solver *row = solvers;
    while (row->run != method || row->variant != variant)
        row++;
    return row;
}

const char *rb_friction_status_text(rb_status s, double tol, const rb_friction_info *info)
{
    if (s == RB_OK && info && rb_friction_deciding(info) > tol)
        return "solved-to-rounding";
    return rb_status_text(s);
}

int rb_friction_note(double tol, const rb_friction_info *info, rb_message *note)
{
    const double allowed = fmax(tol, info->floor);
    if (!(info->scaled <= allowed) || !(info->residual > allowed))
        return 0;
    rb_fail(note, RB_OK,
            "the residual (13) of Acary, which depends on units, is %.2g, above --tol %g; "
            "the scaled residual %.2g decides, unless --measure acary asks for (13)",
            info->residual, tol, info->scaled);
    return 1;
}

/* ---- One call ---------------------------------------------------------------------- */

/* What was asked, and when. */
typedef struct {
    const rb_friction_solver *solver;
    rb_friction_options opt;
    rb_friction_solution at;
    rb_friction_info *info, unwanted;
    int timed;    /* there is a limit, or somebody wants to know: else the clock would take
                     a sixth of a call that has six contacts */
    double start; /* on rb_seconds() */
} call;

/* info may be NULL; c->at is the caller's to set. */
static rb_status begin_call(call *c, const char *name, const rb_friction_problem *p,
                            const rb_friction_options *given, rb_friction_info *info)
{
    c->opt = given ? *given : rb_friction_defaults();
    c->timed = info || c->opt.seconds > 0.0;
    c->start = c->timed ? rb_seconds() : 0.0;
    c->info = info ? info : &c->unwanted;
    name = name ? name : "auto";
    rb_friction_info_clear(c->info, name);
    c->info->measure = c->opt.measure;
    const rb_friction_options *opt = &c->opt;
    rb_message *why = &c->info->msg;
    c->solver = rb_friction_solver_named(name);
    if (!c->solver)
        return rb_fail(why, RB_EINVAL, "no friction solver named '%s'", name);
    if (!(opt->tol > 0.0) || opt->max_iters < 0 || !(opt->seconds >= 0.0))
        return rb_fail(why, RB_EINVAL, "tol = %g, max_iters = %d, seconds = %g", opt->tol,
                       opt->max_iters, opt->seconds);
    if ((c->solver->needs & FLAT) && p->dimension != 2)
        return rb_fail(why, RB_EINVAL, "%s solves problems in 2D only", name);
    return RB_OK;
}

struct rb_friction_handle {
    rb_friction_shared shared;
    double *last; /* m + n: r and v of the last solution; NULL: none yet */
};

static rb_status setup(const rb_friction_problem *problem, rb_friction_handle *handle,
                       rb_message *why)
{
    *handle = (rb_friction_handle){0};
    const rb_status s = rb_friction_problem_check(problem, why);
    return s == RB_OK ? rb_friction_shared_init(problem, &handle->shared, why) : s;
}

static void release(rb_friction_handle *handle)
{
    rb_friction_shared_free(&handle->shared);
    free(handle->last);
}

static rb_status solve_call(rb_friction_shared *shared, const call *c)
{
    const rb_friction_problem *problem = shared->problem;
    const int m = problem->dimension * problem->contacts;
    const int n = problem->form == RB_FRICTION_GLOBAL ? problem->dofs : 0;
    rb_friction_record best = {.r = shared->memory, .error = INFINITY};
    rb_friction_task task = {.shared = shared,
                             .problem = problem,
                             .measure = &shared->measure,
                             .best = &best,
                             .opt = c->opt,
                             .info = c->info,
                             .d = problem->dimension,
                             .contacts = problem->contacts,
                             .m = m,
                             .n = n,
                             .deadline = c->opt.seconds > 0.0 ? c->start + c->opt.seconds : 0.0,
                             .budget = INFINITY,
                             .r = c->at.r,
                             .u = c->at.u,
                             .v = c->at.v ? c->at.v : shared->memory + m + n};
    c->info->solver = c->solver->name;
    shared->stop = 0;
    shared->measure.acary = c->opt.measure == RB_FRICTION_BY_ACARY;
    rb_status s = c->solver->needs & WANTS_W ? rb_friction_task_condense(&task) : RB_OK;
    if (s == RB_OK) {
        /* A start at zero is no guess that might be the solution already. */
        int any = 0;
        for (int k = 0; task.opt.r0 && k < m; k++)
            any |= task.opt.r0[k] != 0.0;
        if (!any)
            task.opt.r0 = NULL;
        rb_friction_task_start(&task);
        s = rb_friction_run(&task, c->solver->run, c->solver->variant, 0);
        /* What the method ends with is proved, unless the portfolio has proved it; where
         * that is no solution, the best iterate is what is handed back. */
        if (s >= 0 && !task.proved) {
            if (s != RB_OK)
                rb_friction_task_recall(&task);
            if (rb_friction_prove(&task))
                s = RB_OK;
            else if (task.measured != RB_OK)
                s = task.measured;
            else if (s == RB_OK)
                s = RB_INACCURATE;
        }
    }
    if (s >= 0)
        rb_friction_scale_back(&shared->scaling, c->at.r, c->at.u);
    if (c->timed)
        c->info->seconds = rb_seconds() - c->start;
    return s;
}

rb_status rb_friction_solve(const char *name, const rb_friction_problem *problem,
                            const rb_friction_options *opt, const rb_friction_solution *solution,
                            rb_friction_info *info)
{
    rb_friction_handle handle;
    call c;
    rb_status s = begin_call(&c, name, problem, opt, info);
    if (s != RB_OK)
        return s;
    c.at = *solution;
    s = setup(problem, &handle, &c.info->msg);
    if (s == RB_OK)
        s = solve_call(&handle.shared, &c);
    release(&handle);
    return s;
}

/* ---- One structure, many loads ----------------------------------------------------- */

rb_status rb_friction_setup(const rb_friction_problem *problem, rb_friction_handle **handle,
                            rb_message *why)
{
    *handle = malloc(sizeof **handle);
    if (!*handle)
        return RB_ENOMEM;
    const rb_status s = setup(problem, *handle, why);
    if (s != RB_OK) {
        rb_friction_handle_free(*handle);
        *handle = NULL;
    }
    return s;
}

rb_status rb_friction_update(rb_friction_handle *handle, rb_message *why)
{
    const rb_status s = rb_friction_problem_check(handle->shared.given, why);
    return s == RB_OK ? rb_friction_shared_reload(&handle->shared) : s;
}

rb_status rb_friction_handle_solve(rb_friction_handle *handle, const char *name,
                                   const rb_friction_options *opt,
                                   const rb_friction_solution *solution, rb_friction_info *info)
{
    const rb_friction_problem *p = handle->shared.given;
    const size_t m = (size_t)(p->dimension * p->contacts);
    const size_t n = p->form == RB_FRICTION_GLOBAL ? (size_t)p->dofs : 0;
    call c;
    rb_status s = begin_call(&c, name, p, opt, info);
    if (s != RB_OK)
        return s;
    if (!c.opt.r0 && handle->last) {
        c.opt.r0 = handle->last;
        c.opt.v0 = handle->last + m;
    }
    c.at = *solution;
    if (!c.at.v)
        c.at.v = handle->shared.memory + m + n;
    s = solve_call(&handle->shared, &c);
    if (s == RB_OK) {
        /* The last solution is where the next call starts, unless that says otherwise. */
        if (!handle->last)
            handle->last = rb_alloc(m + n, 1);
        if (handle->last) {
            memcpy(handle->last, c.at.r, m * sizeof *c.at.r);
            if (n)
                memcpy(handle->last + m, c.at.v, n * sizeof *c.at.v);
        }
    }
    return s;
}

void rb_friction_handle_free(rb_friction_handle *handle)
{
    if (!handle)
        return;
    release(handle);
    free(handle);
}
