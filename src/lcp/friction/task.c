/* The state of one solve: functions that the methods call, and the functions that run
 * methods. */
#include "lcp/friction/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- What methods on one problem share --------------------------------------------- */

/* The scaled problem and its measure, which all methods of a portfolio share; the condensed form
 * and the blocks are made when a method needs them. */
rb_status rb_friction_shared_init(const rb_friction_problem *problem, rb_friction_shared *shared,
                                  rb_message *why)
{
    *shared = (rb_friction_shared){.given = problem};
    if (rb_friction_scaling_init(problem, &shared->scaling) != RB_OK)
        return RB_ENOMEM;
    shared->problem = &shared->scaling.problem;
    if (problem->form != RB_FRICTION_GLOBAL)
        shared->local = shared->problem;
    const size_t m = (size_t)(problem->dimension * problem->contacts);
    const size_t n = problem->form == RB_FRICTION_GLOBAL ? (size_t)problem->dofs : 0;
    shared->memory = malloc((m + 2 * n) * sizeof(double));
    if (!shared->memory)
        return RB_ENOMEM;
    const rb_status s = rb_friction_measure_init(&shared->scaling, &shared->measure);
    if (s == RB_SINGULAR)
        return rb_fail(why, s,
                       "K is singular even with every contact held: the structure has "
                       "motions without any velocity at the contacts");
    return s;
}

/* New mu, q or f: what depends on W, K and H alone is kept. */
rb_status rb_friction_shared_reload(rb_friction_shared *shared)
{
    const rb_friction_problem *p = shared->problem;
    rb_friction_scaling_reload(shared->given, &shared->scaling);
    rb_status s = rb_friction_measure_reload(&shared->measure);
    for (int c = 0; shared->contact && c < p->contacts; c++)
        shared->contact[c].mu = p->mu[c];
    if (s != RB_OK || shared->local != &shared->condensed)
        return s;
    for (int c = 0; c < p->contacts; c++)
        shared->condensed.mu[c] = p->mu[c];
    return rb_friction_measure_spring_load(&shared->measure, shared->condensed.q);
}

void rb_friction_shared_free(rb_friction_shared *shared)
{
    rb_friction_measure_free(&shared->measure);
    rb_friction_scaling_free(&shared->scaling);
    rb_friction_blocks_free(&shared->blocks);
    free(shared->contact);
    free(shared->memory);
    rb_friction_problem_free(&shared->condensed);
    *shared = (rb_friction_shared){0};
}

/* The local form of a global problem, made once. */
rb_status rb_friction_task_condense(rb_friction_task *task)
{
    rb_friction_shared *shared = task->shared;
    if (shared->local)
        return RB_OK;
    const rb_status s = rb_friction_condense_counted(shared->problem, &shared->condensed,
                                                     &task->info->flops, &task->info->msg);
    if (s == RB_OK)
        shared->local = &shared->condensed;
    return s;
}

rb_status rb_friction_task_blocks(rb_friction_task *task, const rb_friction_blocks **blocks)
{
    rb_friction_shared *shared = task->shared;
    *blocks = &shared->blocks;
    return shared->blocks.x ? RB_OK : rb_friction_blocks_init(shared->local, &shared->blocks);
}

rb_status rb_friction_task_contacts(rb_friction_task *task, rb_friction_contact **contacts)
{
    rb_friction_shared *shared = task->shared;
    if (!shared->contact)
        shared->contact = calloc((size_t)task->contacts, sizeof *shared->contact);
    *contacts = shared->contact;
    return *contacts ? RB_OK : RB_ENOMEM;
}

void rb_friction_info_clear(rb_friction_info *info, const char *solver)
{
    info->solver = solver;
    info->iters = 0;
    info->residual = info->scaled = info->worst = INFINITY;
    info->contact = -1;
    info->measure = RB_FRICTION_BY_SCALED;
    info->floor = info->flops = info->seconds = 0.0;
    info->msg.text[0] = '\0';
}

/* The start of the caller in the scaled units, or zero. */
void rb_friction_task_start(rb_friction_task *task)
{
    const rb_friction_options *opt = &task->opt;
    const double *unit = task->shared->scaling.unit;
    for (int k = 0; k < task->m; k++)
        task->r[k] = !opt->r0 ? 0.0 : unit ? opt->r0[k] / unit[k / task->d] : opt->r0[k];
    for (int i = 0; i < task->n; i++)
        task->v[i] = opt->v0 ? opt->v0[i] : 0.0;
}

/* ---- The measure ------------------------------------------------------------------- */

static void count_measure(rb_friction_task *task)
{
    const rb_friction_problem *p = task->problem;
    const double m = task->m;
    task->info->flops += 25.0 * m;
    if (p->form == RB_FRICTION_LOCAL_DENSE)
        task->info->flops += 2.0 * m * m;
    else if (p->form == RB_FRICTION_LOCAL_SPARSE)
        task->info->flops += 2.0 * p->Ws.p[task->m];
    else
        task->info->flops += 4.0 * p->H.p[task->m] + 2.0 * p->K.p[task->n];
}

/* An iterate at or below the tolerance that is so large that the measure does not see it
 * is no candidate. */
void rb_friction_task_seen(rb_friction_task *task, double error)
{
    rb_friction_record *best = task->best;
    if (task->opt.progress) {
        const rb_friction_progress at = {task->info->solver, task->info->iters, task->info->flops,
                                         error};
        task->shared->stop |= task->opt.progress(&at, task->opt.context) != 0;
    }
    if (!(error < best->error) ||
        (error <= task->opt.tol &&
         !(rb_friction_measure_resolution(task->measure, task->r) <= task->opt.tol)))
        return;
    best->error = error;
    best->solver = task->info->solver;
    memcpy(best->r, task->r, (size_t)task->m * sizeof(double));
    memcpy(best->r + task->m, task->v, (size_t)task->n * sizeof(double));
}

double rb_friction_task_error(rb_friction_task *task)
{
    double error;
    task->measured =
        rb_friction_measure_error(task->measure, task->r, task->v, task->u, &error, NULL);
    count_measure(task);
    rb_friction_task_seen(task, error);
    return error;
}

/* A floor beyond this means an iterate that runs away, not rounding. */
#define LARGEST_FLOOR 1e-6

int rb_friction_task_accepts(const rb_friction_task *task, double error)
{
    double allowed = task->opt.tol;
    if (!(error <= allowed) && !(error <= LARGEST_FLOOR))
        return 0;
    const double least = rb_friction_measure_resolution(task->measure, task->r);
    /* the floor costs as much as the error: ask only when it can matter */
    if (error > allowed || least > allowed)
        allowed = fmax(allowed, fmin(LARGEST_FLOOR,
                                     rb_friction_measure_floor(task->measure, task->r, task->v)));
    if (!(error <= allowed && least <= allowed))
        return 0;
    /* A contact that is small beside the others is not seen in the norm over all.  Asked
     * last, because it costs a product. */
    return task->measure->acary || allowed > task->opt.tol ||
           rb_friction_measure_worst(task->measure, task->r, task->u, task->v, NULL) <=
               task->opt.tol;
}

int rb_friction_prove(rb_friction_task *task)
{
    rb_friction_info *info = task->info;
    task->measured = rb_friction_measure_error(task->measure, task->r, task->v, task->u,
                                               &info->scaled, &info->residual);
    info->floor = rb_friction_measure_floor(task->measure, task->r, task->v);
    info->worst =
        rb_friction_measure_worst(task->measure, task->r, task->u, task->v, &info->contact);
    count_measure(task);
    info->measure = task->opt.measure;
    task->proved = rb_friction_task_accepts(task, rb_friction_deciding(info));
    return task->proved;
}

/* ---- Limits ------------------------------------------------------------------------ */

/* How many iterations a method with a limit of its own may still make. */
int rb_friction_task_left(const rb_friction_task *task, int own)
{
    const int most = task->opt.max_iters;
    if (!most)
        return own;
    const int left = most > task->info->iters ? most - task->info->iters : 0;
    return left < own ? left : own;
}

int rb_friction_task_goes_on(const rb_friction_task *task)
{
    return rb_friction_task_spent(task) < task->budget && rb_friction_task_left(task, 1);
}

int rb_friction_task_late(const rb_friction_task *task)
{
    return task->shared->stop || rb_interrupted() ||
           (task->deadline > 0.0 && rb_seconds() > task->deadline);
}

double rb_friction_task_spent(const rb_friction_task *task)
{
    return task->info->flops + task->beside;
}

/* A step that would exceed the allowance is put off; the method then ends its turn. */
int rb_friction_task_affords(rb_friction_task *task, double flops)
{
    if (!(rb_friction_task_spent(task) + flops > task->budget))
        return 1;
    task->budget = rb_friction_task_spent(task);
    return 0;
}

/* ---- Whether an iterate is the end ------------------------------------------------- */

rb_status rb_friction_task_status(rb_friction_task *task, double error, int stands)
{
    if (rb_friction_task_accepts(task, error))
        return RB_OK;
    if (error <= task->opt.tol && task->tries > 0) {
        task->tries--;
        task->nearly = 1;
        task->budget = rb_friction_task_spent(task);
        return RB_MAXITER;
    }
    if (!isfinite(error))
        return task->measured == RB_OK ? RB_SINGULAR : task->measured;
    return stands ? RB_INACCURATE : RB_MAXITER;
}

rb_status rb_friction_task_assess(rb_friction_task *task)
{
    const rb_status s = rb_friction_task_status(task, rb_friction_task_error(task), 0);
    return s == RB_MAXITER && rb_friction_task_late(task) ? RB_INTERRUPTED : s;
}

/* At which change of the iterate the error is computed next: it is worth its cost when it may have
 * become small enough. */
double rb_friction_task_next_look(const rb_friction_task *task, double change, double error)
{
    return fmin(0.5 * change, 0.9 * change * task->opt.tol / error);
}

/* ---- Runs -------------------------------------------------------------------------- */

rb_status rb_friction_run(rb_friction_task *task, const rb_friction_method *method, int variant,
                          int limit)
{
    if (method->run)
        return method->run(task, variant);
    void *state = malloc(method->size);
    if (!state)
        return RB_ENOMEM;
    const int given = task->opt.max_iters;
    if (limit)
        task->opt.max_iters = task->info->iters + rb_friction_task_left(task, limit);
    rb_status s = method->start(task, variant, state);
    if (s == RB_OK)
        s = method->go_on(state);
    method->finish(state);
    free(state);
    task->opt.max_iters = given;
    return s;
}

void rb_friction_task_recall(rb_friction_task *task)
{
    const rb_friction_record *best = task->best;
    if (!isfinite(best->error))
        return;
    memcpy(task->r, best->r, (size_t)task->m * sizeof(double));
    memcpy(task->v, best->r + task->m, (size_t)task->n * sizeof(double));
    task->info->solver = best->solver;
}
