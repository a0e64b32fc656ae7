/* State variables that particles carry from step to step (theory.md 4.2, 4.10, 4.11, V5):
 * one row of functions for each kind. */
#include "rolling/body/body.h"
#include "rolling/case/internal.h"
#include "rolling/history/internal.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"

#include <math.h>
#include <string.h>

double rb_rolling_middle_length(const rb_rolling_model *model)
{
    return model->bodies.f.h[model->mesh.n / 2];
}

/* 1: a step of this length moves particles by one element. */
static int moves_by_element(const rb_rolling_particles *r, double c)
{
    const double h = rb_rolling_middle_length(r->model);
    return fabs(c - h) <= 1e-9 * h;
}

/* ---- Bodies that relax ------------------------------------------------------------- */

/* They come without a past.  Behind the mesh it counts for as long as its slowest term
 * remembers, or for all the way. */
static rb_status create_past(rb_rolling_particles *r, rb_message *why)
{
    enum { FORGOTTEN = 36 }; /* exp(-36) is below rounding */
    const rb_rolling_case *rc = r->rc;
    const rb_rolling_memory *const memory[2] = {&rc->a.memory, &rc->b.memory};
    double slowest = 0.0;
    rb_status s = RB_OK;

    r->interval = -1.0;
    if (r->step > 0.0 && !r->keeps_elements) {
        /* Elements as long as a step, so that the past moves from one to the next. */
        rb_rolling_model *model = r->model;
        const double from = model->mesh.ends[0], to = model->mesh.ends[model->mesh.n];
        const double middle = 0.5 * (from + to), step = r->step;
        rb_rolling_plan plan = model->plan;
        rb_rolling_mesh mesh;

        plan.elements = (int)ceil((to - from) / step * (1.0 - 1e-9));
        const double half = 0.5 * plan.elements * step;
        s = rb_rolling_mesh_uniform(r->rc, &plan, middle - half, middle + half, &mesh, why);
        if (s == RB_OK) {
            rb_rolling_mesh_free(&model->mesh);
            model->mesh = mesh;
            rb_contact_state_free(&model->state);
            s = rb_contact_state_alloc(mesh.n, &model->state);
        }
    }
    for (int b = 0; b < 1 + rc->elastic_b; b++)
        for (int k = 0; k < memory[b]->n; k++)
            slowest = fmax(slowest, memory[b]->time[k]);
    const double tail =
        r->step > 0.0 ? fmin(r->steps, FORGOTTEN * slowest * rc->speed / r->step) : 0.0;
    return s == RB_OK ? rb_rolling_memory_track_create(rc, &r->model->mesh, (int)ceil(tail),
                                                       &r->memory, &r->past, why)
                      : s;
}

rb_status rb_rolling_particles_bodies(rb_rolling_particles *r, double interval, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_status s = RB_OK;

    if (!(fabs(interval - r->interval) <= 1e-9 * interval)) {
        const rb_rolling_case step = rb_rolling_memory_case(r->rc, interval);
        rb_contact_problem_free(&model->problem);
        rb_rolling_bodies_free(&model->bodies);
        s = rb_rolling_bodies_create(&step, NULL, &model->mesh, &model->bodies, why);
        if (s == RB_OK)
            s = rb_rolling_problem_create(model->rc, &model->mesh, &model->bodies, NULL,
                                          &model->problem, why);
        r->interval = interval;
    }
    return s;
}

/* In every step they are others: elastic ones of that interval, displaced by what came
 * before. */
static rb_status bring_past(rb_rolling_particles *r, const rb_rolling_stride *stride,
                            rb_message *why)
{
    rb_rolling_model *model = r->model;
    const rb_status s = rb_rolling_particles_bodies(r, stride->interval, why);

    if (s != RB_OK)
        return s;
    rb_rolling_memory_track_begin(&r->past, stride->interval, stride->c > 0.0, model->bodies.f.w0);
    rb_rolling_set_gap(&model->mesh, &model->bodies, &model->problem);
    return RB_OK;
}

static void leave_past(rb_rolling_particles *r, const rb_rolling_stride *stride)
{
    const rb_contact_state *state = &r->model->state;

    rb_rolling_memory_track_end(&r->past, stride->interval, state->p, state->q);
}

/* ---- Displacement ------------------------------------------------------------------ */

static rb_status create_displacement(rb_rolling_particles *r, rb_message *why)
{
    const size_t n = (size_t)r->model->mesh.n;

    (void)why;
    r->w_T = rb_arena_doubles(&r->memory, n, 1);
    r->w = rb_arena_doubles(&r->memory, 2 * (n + 1), 1);
    return r->memory.failed ? RB_ENOMEM : RB_OK;
}

/* w_T of the present tractions and strains at the same places (c = 0), or where the particles
 * are that a step of length c brings to them. */
static rb_status bring_displacement(rb_rolling_particles *r, const rb_rolling_stride *stride,
                                    rb_message *why)
{
    const rb_contact_state *state = &r->model->state;
    const rb_rolling_bodies *bodies = &r->model->bodies;
    const int n = state->n, m = n + 1, element = moves_by_element(r, stride->c);
    rb_status s = RB_OK;

    (void)why;
    if (stride->c > 0.0 && !element) {
        if (r->ahead.step == 0.0)
            s = rb_rolling_former_place_create(r->rc, bodies, stride->c, &r->memory, &r->ahead);
        if (s == RB_OK)
            rb_rolling_former_place_apply(&r->ahead, bodies, state->p, state->q, r->w_T);
    } else {
        s = rb_rolling_displacement(bodies, state->p, state->q, r->w);
        memcpy(r->w_T, r->w + m + element, (size_t)n * sizeof(double));
    }
    for (int i = 0; i < n && s == RB_OK && r->strain != 0.0; i++)
        r->w_T[i] += r->strain * (bodies->f.x[i] + stride->c);
    return s;
}

static void leave_displacement(rb_rolling_particles *r, const rb_rolling_stride *stride)
{
    (void)stride;
    r->strain = rb_rolling_bulk_strain(r->model->rc);
}

/* ---- Coefficients of friction ------------------------------------------------------ */

static rb_status create_friction(rb_rolling_particles *r, rb_message *why)
{
    (void)why;
    r->mu = rb_arena_doubles(&r->memory, (size_t)r->model->mesh.n, 1);
    return r->mu ? RB_OK : RB_ENOMEM;
}

/* Those at the former places of the particles.  At rest particles carry how far they are above the
 * kinetic coefficient, which a program may change; and where bodies have a time, what has not slid
 * in the step before has healed since then (F6). */
static rb_status bring_friction(rb_rolling_particles *r, const rb_rolling_stride *stride,
                                rb_message *why)
{
    const rb_contact_problem *p = &r->model->problem;
    const double *x = r->model->bodies.f.x;
    const rb_rolling_table now = {p->n, x, p->bound};

    const rb_rolling_friction *f = &r->rc->friction;
    const double healed = stride->c == 0.0 && f->memory > 0.0
                              ? exp(-f->memory_slip * stride->interval / f->memory)
                              : 1.0;

    (void)why;
    if (stride->c == 0.0 && !(f->memory > 0.0))
        return RB_OK;
    for (int i = 0; i < p->n; i++) {
        const double rest = rb_rolling_law_at_rest(r->model->rc, x[i]);
        r->mu[i] = stride->c > 0.0 ? rb_rolling_table_at(&now, x[i] + stride->c)
                                   : p->bound[i] + (r->model->rc->mu - r->mu_given);
        if (stride->c == 0.0 && r->model->state.zone[i] <= RB_ZONE_STICK)
            r->mu[i] = rest + (r->mu[i] - rest) * healed;
    }
    r->model->carried.mu = r->mu;
    return RB_OK;
}

static void leave_friction(rb_rolling_particles *r, const rb_rolling_stride *stride)
{
    (void)stride;
    r->mu_given = r->model->rc->mu;
}

/* ---- An interface that yields ------------------------------------------------------ */

static int yields(const rb_rolling_case *rc)
{
    return rc->yield_stress > 0.0;
}

static rb_status create_yielded(rb_rolling_particles *r, rb_message *why)
{
    const size_t n = (size_t)r->model->mesh.n;

    (void)why;
    r->yielded = rb_arena_doubles(&r->memory, n + 1, 1);
    r->model->carried.yielded = rb_alloc(n, 1);
    return r->yielded && r->model->carried.yielded ? RB_OK : RB_ENOMEM;
}

/* What it has yielded where the particles come from: linear between midpoints; nothing
 * beyond the last one, where it is new. */
static rb_status bring_yielded(rb_rolling_particles *r, const rb_rolling_stride *stride,
                               rb_message *why)
{
    const double *x = r->model->bodies.f.x;
    const int n = r->model->mesh.n;
    const double c =
        moves_by_element(r, stride->c) ? rb_rolling_middle_length(r->model) : stride->c;

    (void)why;
    rb_rolling_yielded(r->model, r->yielded);
    r->yielded[n] = 0.0;
    for (int i = 0, j = 0; i < n; i++) {
        while (j < n && x[j + 1] <= x[i] + c)
            j++;
        const double share = j < n ? (x[i] + c - x[j]) / (x[j + 1] - x[j]) : 0.0;
        r->model->carried.yielded[i] =
            j < n ? (1.0 - share) * r->yielded[j] + share * r->yielded[j + 1] : 0.0;
    }
    return RB_OK;
}

/* ---- Heat -------------------------------------------------------------------------- */

/* Both surfaces begin with the temperature of their bodies. */
static rb_status create_heat(rb_rolling_particles *r, rb_message *why)
{
    const int n = r->model->mesh.n;
    double *temperature = r->model->carried.temperature = rb_alloc((size_t)n, 1);

    if (!temperature)
        return RB_ENOMEM;
    for (int i = 0; i < n; i++)
        temperature[i] = r->rc->heat_a.temperature;
    r->model->carried.heat = &r->heat;
    r->heat =
        (rb_rolling_heat_track){.n = n, .h = rb_rolling_middle_length(r->model), .step = r->step};
    return rb_rolling_heat_track_create(r->rc, r->model->half_width, &r->memory, &r->heat, why);
}

static rb_status bring_heat(rb_rolling_particles *r, const rb_rolling_stride *stride,
                            rb_message *why)
{
    if (stride->c == 0.0)
        return RB_OK;
    rb_rolling_heat_track_advance(&r->heat);
    const double given = r->model->rc->creep;
    return isnan(given) ? RB_OK
                        : rb_rolling_heat_track_check(r->rc, r->heat.half_width, given, why);
}

static void leave_heat(rb_rolling_particles *r, const rb_rolling_stride *stride)
{
    rb_rolling_model *model = r->model;

    if (stride->c > 0.0)
        rb_rolling_heat_track_step(model->rc, &model->state, &r->heat, model->carried.temperature);
}

/* ---- All of them ------------------------------------------------------------------- */

typedef struct {
    int (*is_carried)(const rb_rolling_case *rc); /* NULL: in every case */
    rb_status (*create)(rb_rolling_particles *r, rb_message *why);
    /* From where the last step left the particles to where this one has them. */
    rb_status (*bring)(rb_rolling_particles *r, const rb_rolling_stride *stride, rb_message *why);
    /* What the step, solved, leaves with them; NULL: the model has it. */
    void (*leave)(rb_rolling_particles *r, const rb_rolling_stride *stride);
    int without_past; /* 1: also brought into the first step */
} memory;

/* What looks at the bodies of the step before stands before those that change. */
static const memory memories[] = {
    {NULL, create_displacement, bring_displacement, leave_displacement, 0},
    {rb_rolling_law_depends_on_state, create_friction, bring_friction, leave_friction, 0},
    {yields, create_yielded, bring_yielded, NULL, 0},
    {rb_rolling_has_heat, create_heat, bring_heat, leave_heat, 0},
    {rb_rolling_relaxes, create_past, bring_past, leave_past, 1}};
enum { MEMORIES = sizeof memories / sizeof *memories };

static int is_carried(const memory *m, const rb_rolling_particles *r)
{
    return !m->is_carried || m->is_carried(r->rc);
}

/* Backwards: the elements of bodies that relax are those of all others. */
rb_status rb_rolling_particles_create(rb_rolling_particles *r, rb_message *why)
{
    for (int k = MEMORIES - 1; k >= 0; k--) {
        const rb_status s = is_carried(&memories[k], r) ? memories[k].create(r, why) : RB_OK;
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

rb_status rb_rolling_particles_bring(rb_rolling_particles *r, const rb_rolling_stride *stride,
                                     rb_message *why)
{
    if (stride->is_first) /* also where the first row is computed again in other steps */
        r->model->carried.mu = NULL;
    for (int k = 0; k < MEMORIES; k++) {
        const int brings =
            is_carried(&memories[k], r) && (memories[k].without_past || !stride->is_first);
        const rb_status s = brings ? memories[k].bring(r, stride, why) : RB_OK;
        if (s != RB_OK)
            return s;
    }
    return RB_OK;
}

void rb_rolling_particles_leave(rb_rolling_particles *r, const rb_rolling_stride *stride)
{
    for (int k = 0; k < MEMORIES; k++)
        if (is_carried(&memories[k], r) && memories[k].leave)
            memories[k].leave(r, stride);
}

void rb_rolling_particles_free(rb_rolling_particles *r)
{
    if (r->model) { /* borrows them */
        r->model->carried.mu = NULL;
        r->model->carried.heat = NULL;
    }
    rb_rolling_memory_track_free(&r->past);
    rb_arena_free(&r->memory);
    memset(r, 0, sizeof *r);
}
