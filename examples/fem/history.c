/* A history of loads, increment by increment, on the condensed structure. */
#include "fem/fem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void free_step(rb_fem_step *step)
{
    free(step->contact);
    free(step->u);
    free(step->r);
    free(step->du);
    free(step->gap);
}

void rb_fem_history_free(rb_fem_history *history)
{
    if (!history)
        return;
    for (int k = 0; k < history->steps; k++)
        free_step(&history->step[k]);
    free(history->step);
    *history = (rb_fem_history){0, NULL, 0.0};
}

static double tangential(int d, const double *x)
{
    return d == 2 ? fabs(x[1]) : hypot(x[1], x[2]);
}

typedef struct {
    const rb_fem_model *model;
    rb_fem_condensation *condensation;
    const rb_fem_structure *condensed;
    rb_fem_state state;      /* of the condensed structure */
    double *load_c, *v, *du; /* condensed unknowns twice, then dimension x contacts */
    double *u;               /* all unknowns */
} runner;

/* The increment's friction problem: v and the new reactions in physical units. */
static rb_status solve_increment(runner *run, const char *solver, double tol, rb_fem_step *step,
                                 double *length, rb_message *why)
{
    rb_friction_problem problem;
    rb_friction_options options = rb_friction_defaults();
    rb_friction_info info = {0};
    rb_fem_units units;
    rb_status s = rb_fem_problem(run->condensed, run->load_c, &run->state, &problem, &units);
    if (s != RB_OK)
        return s;
    options.tol = tol;
    const rb_friction_solution solution = {run->state.r, run->du, run->v};
    s = rb_friction_solve(solver, &problem, &options, &solution, &info);
    for (int k = 0; k < run->condensed->H.cols; k++)
        run->state.r[k] *= units.force;
    for (int k = 0; k < run->condensed->dofs; k++)
        run->state.u[k] += run->v[k] *= units.length;
    step->status = s;
    step->iterations = info.iters;
    step->residual = info.residual;
    *length = units.length;
    const char *reason = rb_status_reason(s, &info.msg);
    if (s != RB_OK && isfinite(info.residual))
        rb_fail(why, s, "%s: %s after %d iteration%s, residual %.3g", solver, reason, info.iters,
                rb_plural(info.iters), info.residual);
    else if (s != RB_OK) /* it has not begun */
        rb_fail(why, s, "%s", reason);
    rb_friction_problem_free(&problem);
    return s;
}

/* From the condensed state to nodes and contacts. */
static rb_status record(runner *run, const double *load, double length, rb_fem_step *step)
{
    const rb_fem_structure *s = run->condensed;
    const rb_fem_mesh *mesh = &run->model->mesh;
    const rb_status status = rb_fem_expand(run->condensation, load, run->state.u, run->u);
    if (status != RB_OK)
        return status;
    for (int i = 0; i < mesh->dimension * mesh->nodes; i++)
        step->u[i] = mesh->dof[i] >= 0 ? run->u[mesh->dof[i]] : 0.0;
    memcpy(step->r, run->state.r, (size_t)s->H.cols * sizeof *step->r);
    rb_sparse_apply_transposed(1.0, &s->H, run->v, 0.0, step->du);
    rb_sparse_apply_transposed(1.0, &s->H, run->state.u, 0.0, run->du);
    for (int i = 0; i < s->contacts; i++)
        step->gap[i] = s->gap[i] + run->du[s->dimension * i];
    /* Separated: r_N below 1e-9 of the largest.  Slip: friction at its limit (1e-8) and
     * an increment above 1e-9 of the largest one; least: what counts as no displacement
     * at all. */
    const double least = 1e-3 * length;
    const int d = s->dimension;
    double r_max = 0.0, du_max = least;
    for (int i = 0; i < s->contacts; i++) {
        r_max = fmax(r_max, step->r[d * i]);
        du_max = fmax(du_max, tangential(d, step->du + d * i));
    }
    step->stick = step->slip = step->separated = 0;
    for (int i = 0; i < s->contacts; i++) {
        const double limit = s->mu[i] * step->r[d * i];
        if (step->r[d * i] <= 1e-9 * r_max) {
            step->contact[i] = RB_FEM_SEPARATED;
            step->separated++;
        } else if (limit - tangential(d, step->r + d * i) <= 1e-8 * limit &&
                   tangential(d, step->du + d * i) > 1e-9 * du_max) {
            step->contact[i] = RB_FEM_SLIP;
            step->slip++;
        } else {
            step->contact[i] = RB_FEM_STICK;
            step->stick++;
        }
    }
    return RB_OK;
}

rb_status rb_fem_run(const rb_fem_model *model, const char *solver, double tol,
                     rb_fem_history *history, rb_message *why)
{
    const double start = rb_seconds();
    runner run;
    memset(&run, 0, sizeof run);
    run.model = model;
    *history = (rb_fem_history){0, calloc((size_t)model->steps, sizeof *history->step), 0.0};
    rb_status s =
        history->step ? rb_fem_condense(&model->structure, &run.condensation, why) : RB_ENOMEM;
    if (s == RB_OK) {
        run.condensed = rb_fem_condensed(run.condensation);
        run.load_c = rb_alloc((size_t)run.condensed->dofs, 1);
        run.v = rb_alloc((size_t)run.condensed->dofs, 1);
        run.du = rb_alloc((size_t)run.condensed->H.cols, 1);
        run.u = rb_alloc((size_t)model->mesh.dofs, 1);
        s = run.load_c && run.v && run.du && run.u ? rb_fem_state_alloc(run.condensed, &run.state)
                                                   : RB_ENOMEM;
    }
    for (int k = 0; s == RB_OK && k < model->steps; k++) {
        const size_t d = (size_t)model->mesh.dimension, n = (size_t)model->structure.contacts;
        rb_fem_step *step = &history->step[history->steps++];
        step->contact = calloc(n, sizeof *step->contact);
        step->u = rb_alloc(d, (size_t)model->mesh.nodes);
        step->r = rb_alloc(d, n);
        step->du = rb_alloc(d, n);
        step->gap = rb_alloc(n, 1);
        if (!step->contact || !step->u || !step->r || !step->du || !step->gap) {
            free_step(&history->step[--history->steps]);
            s = RB_ENOMEM;
            break;
        }
        const double *load = model->load + (size_t)k * (size_t)model->mesh.dofs;
        double length = 1.0;
        s = rb_fem_condense_load(run.condensation, load, run.load_c);
        if (s == RB_OK)
            s = solve_increment(&run, solver, tol, step, &length, why);
        if (!(s < RB_OK)) {
            const rb_status recorded = record(&run, load, length, step);
            s = recorded == RB_OK ? s : recorded;
        }
        if (s > 0 && !isfinite(step->residual)) /* it has not begun */
            free_step(&history->step[--history->steps]);
    }
    rb_fem_condensation_free(run.condensation);
    rb_fem_state_free(&run.state);
    free(run.load_c);
    free(run.v);
    free(run.du);
    free(run.u);
    history->seconds = rb_seconds() - start;
    return s;
}

rb_fem_sums rb_fem_sum(const rb_fem_model *model, const rb_fem_step *step)
{
    const int d = model->mesh.dimension;
    const double *last = step->u + d * (model->mesh.nodes - 1);
    rb_fem_sums sums = {.corner = {last[0], last[1]}};
    for (int i = 0; i < model->structure.contacts; i++) {
        const double *r = step->r + d * i, *du = step->du + d * i;
        sums.normal += r[0];
        for (int k = 1; k < d; k++)
            sums.tangential[k - 1] += r[k];
        sums.increment = fmax(sums.increment, d == 2 ? fabs(du[1]) : hypot(du[1], du[2]));
    }
    return sums;
}
