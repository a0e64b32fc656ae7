/* The wall in motion: backward Euler, one friction problem a step. */
#include "fem/wall.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double most_force = 30e3, drive = 1e-3; /* N, m/s */
static const double mu_blocks = 0.83, mu_supports = 0.53;

typedef struct {
    double *f, *w;
    int iterations;
} recorded_step;

struct rb_fem_wall {
    rb_fem_wall_options options;
    wall_layout layout;
    rb_fem_mesh mesh;
    int contacts, solved;
    wall_contact *contact;
    rb_sparse R; /* rigid: nodal velocities of the freedoms; empty else */
    wall_system system;
    rb_sparse A;            /* M + dt^2 K */
    double *u, *v, *r, *ur; /* displacements, velocities, impulses, relative velocities */
    double *mu;
    recorded_step *record; /* press + shear */
    rb_arena memory;       /* of the arrays */
};

rb_fem_wall_options rb_fem_wall_defaults(void)
{
    return (rb_fem_wall_options){
        .fine = {14, 10, 3}, .coarse = {5, 3, 3}, .dt = 1e-2, .press = 10, .shear = 65};
}

rb_status rb_fem_wall_create(const rb_fem_wall_options *options, rb_fem_wall **wall,
                             rb_message *why)
{
    const rb_fem_wall_options *o = options;
    *wall = NULL;
    for (int k = 0; k < 3; k++) {
        const int least = k == 1 ? 2 : 3;
        if (o->fine[k] < least || o->coarse[k] < least || o->fine[k] > 200 || o->coarse[k] > 200)
            return rb_fail(why, RB_EINVAL, "wall: %d and %d nodes in direction %d", o->fine[k],
                           o->coarse[k], k);
    }
    if (!(o->dt > 0.0) || o->press < 1 || o->shear < 0)
        return rb_fail(why, RB_EINVAL, "wall: dt = %g, %d + %d steps", o->dt, o->press, o->shear);
    rb_fem_wall *w = calloc(1, sizeof *w);
    if (!w)
        return RB_ENOMEM;
    w->options = *o;
    w->layout = wall_lay_out(&w->options);
    w->contacts = wall_find_contacts(&w->layout, NULL);
    w->contact = rb_arena_zeros(&w->memory, (size_t)w->contacts, sizeof *w->contact);
    rb_status s = w->contact ? wall_build_mesh(&w->layout, &w->mesh) : RB_ENOMEM;
    if (s == RB_OK) {
        wall_find_contacts(&w->layout, w->contact);
        s = wall_elastic_system(&w->layout, &w->mesh, w->contacts, w->contact, &w->system, why);
    }
    if (s == RB_OK && w->options.rigid) {
        wall_system elastic = w->system;
        s = wall_rigid_system(&w->layout, &w->mesh, &elastic, &w->R, &w->system);
        wall_system_free(&elastic);
    }
    if (s == RB_OK) {
        const size_t n = (size_t)w->system.dofs, m = 3 * (size_t)w->contacts;
        w->u = rb_arena_doubles(&w->memory, n, 1);
        w->v = rb_arena_doubles(&w->memory, n, 1);
        w->r = rb_arena_doubles(&w->memory, m, 1);
        w->ur = rb_arena_doubles(&w->memory, m, 1);
        w->mu = rb_arena_doubles(&w->memory, (size_t)w->contacts, 1);
        w->record = rb_arena_zeros(&w->memory, (size_t)rb_fem_wall_steps(w), sizeof *w->record);
        if (w->memory.failed)
            s = RB_ENOMEM;
    }
    for (int i = 0; s == RB_OK && i < w->contacts; i++) {
        const int other = w->contact[i].other;
        w->mu[i] = other == LOWER_SUPPORT || other == UPPER_SUPPORT ? mu_supports : mu_blocks;
    }
    /* M + dt^2 K: the two have the same pattern when elastic; K is empty when rigid. */
    if (s == RB_OK)
        s = rb_sparse_copy(&w->system.M, &w->A);
    for (int k = 0; s == RB_OK && k < w->system.K.p[w->system.K.cols]; k++)
        w->A.x[k] += w->options.dt * w->options.dt * w->system.K.x[k];
    if (s == RB_OK)
        *wall = w;
    else
        rb_fem_wall_free(w);
    return s;
}

void rb_fem_wall_free(rb_fem_wall *w)
{
    if (!w)
        return;
    for (int k = 0; w->record && k < rb_fem_wall_steps(w); k++) {
        free(w->record[k].f);
        free(w->record[k].w);
    }
    rb_fem_mesh_free(&w->mesh);
    wall_system_free(&w->system);
    rb_sparse_free(&w->R);
    rb_sparse_free(&w->A);
    rb_arena_free(&w->memory);
    free(w);
}

int rb_fem_wall_contacts(const rb_fem_wall *wall)
{
    return wall->contacts;
}

int rb_fem_wall_dofs(const rb_fem_wall *wall)
{
    return wall->system.dofs;
}

int rb_fem_wall_steps(const rb_fem_wall *wall)
{
    return 1 + wall->options.press + wall->options.shear;
}

rb_status rb_fem_wall_rank(const rb_fem_wall *wall, int *rank)
{
    return rb_sparse_rank(&wall->system.H, rank);
}

const rb_fem_mesh *rb_fem_wall_mesh(const rb_fem_wall *wall)
{
    return &wall->mesh;
}

rb_status rb_fem_wall_displacements(const rb_fem_wall *wall, double *u)
{
    double *dofs = rb_alloc((size_t)wall->mesh.dofs + 1, 1);
    if (!dofs)
        return RB_ENOMEM;
    if (wall->options.rigid)
        rb_sparse_apply(1.0, &wall->R, wall->u, 0.0, dofs);
    else
        memcpy(dofs, wall->u, (size_t)wall->system.dofs * sizeof *dofs);
    for (int k = 0; k < 3 * wall->mesh.nodes; k++)
        u[k] = dofs[wall->mesh.dof[k]];
    free(dofs);
    return RB_OK;
}

/* ---- One step ---------------------------------------------------------------------- */

static double force_at(const rb_fem_wall *w, int step)
{
    return most_force * fmin(1.0, (double)step / w->options.press);
}

/* f = M v0 + dt (F - K u0); w_N = gap/dt, w_T1 = -drive at the upper support. */
static void step_vectors(const rb_fem_wall *wall, double *f, double *w)
{
    const rb_fem_wall *c = wall;
    const wall_system *s = &wall->system;
    const double dt = c->options.dt, force = force_at(c, c->solved);
    rb_sparse_apply(1.0, &s->M, c->v, 0.0, f);
    rb_sparse_apply(-dt, &s->K, c->u, 1.0, f);
    for (int i = 0; i < s->dofs; i++)
        f[i] += dt * (s->weight[i] + force * s->press[i]);
    rb_sparse_apply_transposed(1.0 / dt, &s->H, c->u, 0.0, w);
    for (int i = 0; i < c->contacts; i++) {
        const int driven = c->contact[i].other == UPPER_SUPPORT && c->solved > c->options.press;
        w[3 * i + 1] = driven ? -drive : 0.0;
        w[3 * i + 2] = 0.0;
    }
}

/* The matrices are borrowed: only f, w may be written. */
static rb_friction_problem borrowed_problem(const rb_fem_wall *w, int step)
{
    return (rb_friction_problem){.form = RB_FRICTION_GLOBAL,
                                 .dimension = 3,
                                 .contacts = w->contacts,
                                 .mu = w->mu,
                                 .dofs = w->system.dofs,
                                 .K = w->A,
                                 .H = w->system.H,
                                 .f = w->record[step].f,
                                 .w = w->record[step].w};
}

static int is_stopped(const rb_friction_progress *at, void *context)
{
    const rb_fem_wall *w = context;
    (void)at;
    return w->options.stopped && w->options.stopped(w->options.context);
}

rb_status rb_fem_wall_advance(rb_fem_wall *wall, const char *solver, double tol,
                              rb_fem_wall_step *step, rb_message *why)
{
    if (wall->solved >= rb_fem_wall_steps(wall))
        return rb_fail(why, RB_EINVAL, "wall: all %d steps are done", wall->solved);
    recorded_step *now = &wall->record[wall->solved];
    rb_friction_info info = {0};
    free(now->f);
    free(now->w);
    now->f = rb_alloc((size_t)wall->system.dofs, 1);
    now->w = rb_alloc(3, (size_t)wall->contacts);
    rb_status s = now->f && now->w ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        step_vectors(wall, now->f, now->w);
    if (wall->solved == 0) {
        /* The first step, under the weight alone, starts from contacts that all press a
         * little: at r = 0 the blocks fall together and every joint between them is
         * undecided. */
        double weight = 0.0;
        for (int i = 0; i < wall->system.dofs; i++)
            weight += fabs(wall->system.weight[i]);
        for (int i = 0; i < wall->contacts; i++)
            wall->r[3 * i] = wall->options.dt * weight / wall->contacts;
    }
    if (s == RB_OK) {
        /* In global form: its Newton systems stay sparse, W would not.  From the impulses
         * of the previous step: a third of the Newton steps that r = 0 takes. */
        const rb_friction_problem problem = borrowed_problem(wall, wall->solved);
        rb_friction_options options = rb_friction_defaults();
        options.tol = tol;
        options.r0 = wall->r;
        options.progress = is_stopped;
        options.context = wall;
        const rb_friction_solution solution = {wall->r, wall->ur, wall->v};
        s = rb_friction_solve(solver, &problem, &options, &solution, &info);
    }
    if (s < RB_OK)
        return rb_fail(why, s, "wall, step %d: %s", wall->solved + 1,
                       info.msg.text[0] ? info.msg.text : rb_status_text(s));
    if (s == RB_INTERRUPTED)
        return rb_fail(why, s, "interrupted after step %d", wall->solved);
    const int k = wall->solved;
    step->time = (k + 1) * wall->options.dt;
    step->compression = force_at(wall, k);
    step->drift = drive * wall->options.dt * fmax(0, k - wall->options.press);
    step->iterations = info.iters;
    step->residual = info.residual;
    step->seconds = info.seconds;
    double largest = 0.0;
    for (int i = 0; i < wall->contacts; i++)
        largest = fmax(largest, wall->r[3 * i]);
    step->shear = 0.0;
    step->stick = step->slip = step->separated = 0;
    for (int i = 0; i < wall->contacts; i++) {
        const double *r = wall->r + 3 * i;
        const double friction = hypot(r[1], r[2]), limit = wall->mu[i] * r[0];
        if (wall->contact[i].other == UPPER_SUPPORT)
            step->shear += r[1] / wall->options.dt;
        if (r[0] <= 1e-6 * largest)
            step->separated++;
        else if (friction >= (1.0 - 1e-6) * limit)
            step->slip++;
        else
            step->stick++;
    }
    now->iterations = info.iters;
    for (int i = 0; i < wall->system.dofs; i++)
        wall->u[i] += wall->options.dt * wall->v[i];
    wall->solved++;
    return s == RB_OK ? s
                      : rb_fail(why, s, "wall, step %d: %s, residual %.3g", wall->solved,
                                rb_status_text(s), info.residual);
}

/* ---- Problems for others ----------------------------------------------------------- */

rb_status rb_fem_wall_problem(const rb_fem_wall *wall, int step, rb_friction_problem *problem)
{
    memset(problem, 0, sizeof *problem);
    if (step < 0 || step >= wall->solved)
        return RB_EINVAL;
    const rb_friction_problem own = borrowed_problem(wall, step);
    *problem = own;
    problem->mu = rb_copy((size_t)own.contacts, own.mu);
    problem->f = rb_copy((size_t)own.dofs, own.f);
    problem->w = rb_copy(3 * (size_t)own.contacts, own.w);
    memset(&problem->K, 0, sizeof problem->K);
    memset(&problem->H, 0, sizeof problem->H);
    rb_status s = problem->mu && problem->f && problem->w ? RB_OK : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_sparse_copy(&own.K, &problem->K);
    if (s == RB_OK)
        s = rb_sparse_copy(&own.H, &problem->H);
    if (s != RB_OK)
        rb_friction_problem_free(problem);
    return s;
}

rb_status rb_fem_wall_select(const rb_fem_wall *wall, int count, int *step)
{
    const int n = wall->solved - 1;
    if (count < 1 || count > n)
        return RB_EINVAL;
    int *order = rb_alloc_int((size_t)n);
    if (!order)
        return RB_ENOMEM;
    for (int k = 1; k <= n; k++) { /* stable insertion: equals stay in time */
        int at = k - 1;
        for (; at > 0 && wall->record[order[at - 1]].iterations > wall->record[k].iterations; at--)
            order[at] = order[at - 1];
        order[at] = k;
    }
    for (int k = 0; k < count; k++)
        step[k] = order[count > 1 ? (k * (n - 1) + (count - 1) / 2) / (count - 1) : n - 1];
    free(order);
    return RB_OK;
}
