/* Sequences of contact problems, each starting from the state the last one left: static
 * increments and transient rolling (theory.md 4.2). */
#include "rolling/history/internal.h"

#include <stdlib.h>
#include <string.h>

/* Change of the friction per rolled half-width, in units of its bound, below which a
 * state counts as steady. */
static const double STEADY_RATE = 1e-3;

void rb_rolling_history_free(rb_rolling_history *h)
{
    struct rb_rolling_history *const beside[] = {h->errors, h->deviations};

    for (int k = 0; k < 2; k++) {
        if (beside[k])
            rb_rolling_history_free(beside[k]);
        free(beside[k]);
    }
    rb_rolling_columns_free(&rb_rolling_history_columns, h);
    memset(h, 0, sizeof *h);
}

/* ---- Steps ------------------------------------------------------------------------- */

typedef struct {
    rb_rolling_case base;                /* the case with equal elements, for the steps */
    rb_rolling_program own;              /* of the case, where none is given */
    rb_arena columns;                    /* of own */
    const rb_rolling_case *rc;           /* base */
    const rb_rolling_program *program;   /* own, or the given one */
    const rb_rolling_observer *observer; /* or NULL */
    const rb_rolling_states *found;      /* to follow without solving; or NULL */
    const rb_rolling_model *like;        /* whose bodies may be borrowed; or NULL */
    double compression;                  /* of boundaries, where states are found */
    double scale;                        /* of the elements of `found` */
    int is_variant;                      /* 1: of the history that has found them */
    rb_rolling_model *model;
    rb_rolling_history *history;
    int steps;    /* in all */
    int at_rest;  /* of them, before the bodies roll */
    double shift; /* rigid shift so far [length] */
    rb_rolling_particles particles;
    double *q;                /* n: friction before the step; in the particles' memory */
    int row, part;            /* of the program: steps towards this row that are done */
    rb_rolling_stride stride; /* the current step */
    double to;                /* [half-widths]: where it ends */
} history_state;

/* Of the program at rest, so far; 0 where it has no times. */
static double time_of(const history_state *r)
{
    const double *t = r->program->time;

    if (!t || r->row + r->part == 0)
        return 0.0;
    if (r->part == 0) /* the row may be that behind the last one */
        return t[r->row - 1];
    const int parts = rb_rolling_program_parts(r->program, r->rc, r->row);
    return r->part == parts ? t[r->row]
                            : t[r->row - 1] + (t[r->row] - t[r->row - 1]) * r->part / parts;
}

/* What must hold after every step. */
static rb_status assess(const history_state *r, rb_status s, rb_message *reason, rb_message *why)
{
    if (s != RB_OK)
        rb_fail(why, s, "step %d: %.260s", r->history->n + 1, rb_status_reason(s, reason));
    return s;
}

/* The next step is one at rest. */
static int is_at_rest(const history_state *r)
{
    return r->history->n < r->at_rest;
}

/* The problem of the next step: at rest, where the rigid shift or the given force moves
 * the contact towards a row of the program, or on the way. */
static rb_status begin_step(history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_contact_problem *p = &model->problem;
    const int k = r->history->n, rests = is_at_rest(r),
              parts = rests ? rb_rolling_program_parts(r->program, r->rc, r->row) : 0;
    const double c = rests ? 0.0 : r->history->step, mu_before = model->rc->mu;
    const rb_rolling_past past = {r->particles.w_T, model->carried.yielded, c};
    rb_rolling_case step;
    rb_message reason = {""};

    if (rests) {
        const double before = time_of(r);
        r->part++;
        r->to = 0.0;
        r->stride = (rb_rolling_stride){0.0, time_of(r) - before, k == 0};
        step = rb_rolling_program_row(r->program, r->rc, r->row, r->part, parts);
    } else {
        const double part = c / r->history->half_width, from = (k - r->at_rest) * part;
        r->to = k + 1 == r->steps ? r->program->distance[r->program->n - 1]
                                  : (k - r->at_rest + 1) * part;
        r->stride = (rb_rolling_stride){c, rb_rolling_relaxes(r->rc) ? c / r->rc->speed : 0.0, 0};
        step = rb_rolling_program_step(r->program, r->rc, from, r->to);
        memcpy(r->q, model->state.q, (size_t)model->state.n * sizeof *r->q);
    }
    /* The rows are checked beforehand; between two of them mu and the load both vary, and
     * their product may be less than a force that is linear. */
    rb_status s =
        assess(r, r->program->mu ? rb_rolling_case_check(&step, &reason) : RB_OK, &reason, why);
    if (rests) {
        if (step.formulation == RB_TRANSIENT && isnan(step.force) && isnan(step.force_ratio))
            step.force_ratio = 0.0; /* driven by its creepage as soon as it rolls */
        step.formulation = RB_STATIC;
        model->shift = r->shift;
    }
    if (s == RB_OK)
        s = rb_rolling_model_set_case(model, &step, why);
    if (s == RB_OK)
        s = rb_rolling_particles_bring(&r->particles, &r->stride, why);
    if (s == RB_OK && !rests) {
        /* The irregularity has come nearer by the way so far. */
        model->mesh.passed = r->to * r->history->half_width;
        if (step.irregularity.n > 0) {
            s = rb_rolling_mesh_set_gap(model->rc, &model->mesh);
            rb_rolling_set_gap(&model->mesh, &model->bodies, p);
        }
    }
    if (s != RB_OK)
        return s;
    /* Coefficients that depend on the state stay as they are: the iteration begins with
     * them. */
    if (step.mu != mu_before && rb_rolling_law_depends_on_state(model->rc))
        rb_contact_set_friction(p, rb_rolling_largest_mu(model->rc), p->bound);
    else if (step.mu != mu_before)
        rb_rolling_start_bounds(model->rc, NULL, &model->bodies, p);
    rb_rolling_set_past(model->rc, &model->bodies, rests && k == 0 ? NULL : &past, p);
    rb_rolling_set_control(model->rc, p);
    if (rests) {
        p->xi -= p->force_given ? 0.0 : r->shift;
        r->row += r->part == parts;
        r->part %= parts;
    }
    return RB_OK;
}

/* What follows from the state that the step has found. */
static void end_step(history_state *r, rb_status s)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_model *model = r->model;
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;

    if (is_at_rest(r))
        r->shift += state->xi;
    else if (s == RB_OK) {
        /* Follows how long the friction has not changed. */
        const double bound =
            rb_contact_friction_scale(p) * STEADY_RATE * r->stride.c / h->half_width;
        int moves = 0;

        for (int i = 0; i < state->n; i++)
            moves += fabs(state->q[i] - r->q[i]) > bound;
        if (moves)
            h->steady_from = -1;
        else if (h->steady_from < 0)
            h->steady_from = h->n;
    }
    rb_rolling_particles_leave(&r->particles, &r->stride);
    const int k = h->n++, rolls = model->rc->formulation == RB_TRANSIENT;

    h->distance[k] = r->to;
    if (rolls)
        h->creepage[k] = state->xi;
    h->shift[k] = r->shift;
    h->approach[k] = state->delta;
    h->normal_load[k] = rb_rolling_model_load(model);
    h->tangential_load[k] = rb_rolling_model_force(model);
    h->force_ratio[k] = rb_rolling_force_ratio(model);
    h->residual[k] = state->residual;
    h->max_pressure[k] = rb_rolling_peak_pressure(model);
    rb_rolling_contact_edges(model->rc, &model->mesh, state, &h->contact_from[k],
                             &h->contact_to[k]);
    if (rolls)
        h->dissipation[k] = rb_rolling_dissipated_power(model->rc, p->n, state->lambda, state->q,
                                                        model->bodies.f.h, p->e_T);
    h->moment[k] = rb_contact_moment(p, state);
    double torque_b, hottest_at;
    rb_rolling_torques(model->rc, h->moment[k], h->tangential_load[k], &h->torque_a[k], &torque_b);
    if (h->torque_b)
        h->torque_b[k] = torque_b;
    if (h->max_temperature)
        rb_rolling_peak_temperature(p->n, model->bodies.f.x, state->zone,
                                    model->carried.temperature, &h->max_temperature[k],
                                    &hottest_at);
    if (h->time) {
        h->time[k] = r->program->time ? time_of(r) : r->to * h->half_width / r->rc->speed;
        h->lost_work[k] = r->particles.past.lost;
    }
    if (h->mu)
        h->mu[k] = model->rc->mu;
    for (int i = 0; i < p->n; i++) {
        h->stick[k] += state->zone[i] == RB_ZONE_STICK;
        h->slipping[k] += state->zone[i] > RB_ZONE_STICK;
    }
}

static rb_status solve_step(const history_state *r, rb_message *why)
{
    return is_at_rest(r) ? rb_rolling_model_resolve(r->model, 0, why)
                         : rb_rolling_model_control(r->model, why);
}

static rb_status all_steps(history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    const rb_rolling_observer *o = r->observer;

    for (int k = 0; k < r->steps; k++) {
        rb_message reason = {""};
        rb_status s = begin_step(r, why);
        if (s != RB_OK)
            return s;
        if (r->found) {
            /* The given state of this step, with the residual that it leaves. */
            rb_contact_state *state = &model->state;
            rb_contact_violation v = {.scaled = NAN};
            rb_rolling_states_get(r->found, k, state);
            model->half_width =
                rb_rolling_contact_half_width(model->rc, fmax(0.0, rb_rolling_model_load(model)));
            if (!isnan(model->rc->creep_ratio) && model->rc->formulation == RB_TRANSIENT)
                model->problem.xi = rb_rolling_creepage_of_ratio(model, model->rc->creep_ratio);
            s = rb_rolling_model_friction(model, &reason);
            if (s == RB_OK)
                s = rb_contact_residual(&model->problem, state, &v);
            state->residual = v.scaled;
        } else
            s = solve_step(r, &reason);
        if (s == RB_INTERRUPTED)
            return rb_fail(why, s, "interrupted after step %d of %d", k, r->steps);
        s = assess(r, s, &reason, why);
        if (s >= 0)
            end_step(r, s);
        if (s == RB_OK)
            s = rb_rolling_check_crushed(model, why);
        if (s != RB_OK)
            return s;
        if (o && o->step && o->step(model, r->history, k, r->steps, o->context))
            return rb_fail(why, RB_INTERRUPTED, "interrupted after step %d of %d", k + 1, r->steps);
    }
    return RB_OK;
}

/* ---- Preparation ------------------------------------------------------------------- */

static double largest(const double *column, int n, double own)
{
    double max = column ? column[0] : own;
    for (int r = 1; column && r < n; r++)
        max = fmax(max, column[r]);
    return max;
}

/* A mesh that holds the contact of the largest load, solved at rest; zone: 0, automatic. */
static rb_status widest_contact(const history_state *r, double zone, rb_message *why)
{
    const rb_rolling_program *program = r->program;
    rb_rolling_case widest = rb_rolling_memory_case(r->rc, INFINITY);

    widest.formulation = RB_STATIC;
    widest.increments = 1;
    widest.heat_a.conductivity = 0.0; /* nothing slides yet */
    widest.zone = zone;
    widest.load = largest(program->load, program->n, widest.load);
    widest.approach = largest(program->approach, program->n, widest.approach);
    widest.shift = widest.creep = widest.creep_ratio = widest.force = NAN;
    widest.force_ratio = 0.0;
    if (!r->found)
        return rb_rolling_model_create(&widest, r->model, why);
    if (r->like)
        return rb_rolling_variant_place(r->like, &widest, 0.0, r->scale, r->model, why);
    const size_t n = (size_t)r->found->n;
    rb_arena scratch = {0};
    double *x = rb_arena_doubles(&scratch, n, 1), *h = rb_arena_doubles(&scratch, n, 1);
    const rb_rolling_elements elements = {.are_equal = 1, .n = r->found->n, .x = x, .h = h};
    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM), "out of memory for %d elements",
                       r->found->n);
    for (size_t i = 0; i < n; i++) {
        x[i] = r->scale * r->found->x[i];
        h[i] = r->scale * r->found->h[i];
    }
    rb_rolling_plan plan = rb_rolling_plan_of(&widest);
    plan.compression = r->compression;
    return rb_arena_done(&scratch,
                         rb_rolling_model_of_result(&widest, &plan, &elements, r->model, why));
}

double rb_rolling_unit_of_distance(const rb_rolling_case *rc, double load)
{
    rb_rolling_case at_rest = *rc;

    at_rest.formulation = RB_STATIC;
    return rb_rolling_contact_half_width(&at_rest, load);
}

static rb_status prepare(history_state *r, double zone, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_rolling_history *h = r->history;
    rb_status s = widest_contact(r, zone, why);

    if (s != RB_OK)
        return s;
    r->shift = 0.0;
    model->mu_varies = r->program->mu != NULL;
    /* The unit of distances: the half-width of the largest load, of bodies that relax with
     * the glassy modulus; under a given approach of the load that the largest one
     * brings at rest.  Of a gap without a radius that of the contact at rest itself. */
    if (!rb_rolling_has_radius(r->rc)) {
        double from, to;
        rb_rolling_contact_edges(r->rc, &model->mesh, &model->state, &from, &to);
        if (!r->found)
            h->half_width = 0.5 * (to - from);
    } else if (model->problem.load_given && (r->found || rb_rolling_relaxes(r->rc)))
        h->half_width = rb_rolling_unit_of_distance(r->rc, model->problem.load);
    else if (!r->found)
        h->half_width = model->half_width;
    if (r->found) /* as solving would have left it */
        model->half_width = h->half_width;
    /* Step length and number.  Where the case does not say, a step is one element, or as
     * little less as brings the last one to the last row: a single short step would find a
     * creepage that is mostly error.  Of a variant of a history there are as many as there. */
    const int rows = rb_rolling_program_at_rest(r->program), n = r->program->n;
    const double way = rows < n ? r->program->distance[n - 1] * h->half_width : 0.0;
    const double elements = way / rb_rolling_middle_length(model);
    r->at_rest = 0;
    for (int row = 0; row < rows; row++)
        r->at_rest += rb_rolling_program_parts(r->program, r->rc, row);
    const double count = way == 0.0         ? 0.0
                         : r->rc->steps > 0 ? r->rc->steps
                         : r->is_variant    ? fmax(1.0, r->found->steps - r->at_rest)
                                            : ceil(elements * (1.0 - 1e-9));
    const double step = way == 0.0 ? 0.0 : way / count;

    if (count > RB_ROLLING_MOST_STEPS)
        return rb_fail(why, RB_EINVAL,
                       "distance: %g half-widths are %.3g steps; expected at most %g",
                       way / h->half_width, count, (double)RB_ROLLING_MOST_STEPS);
    r->steps = r->at_rest + (int)count;
    if (r->found && r->found->steps != r->steps)
        return rb_fail(why, RB_EINVAL, "history: %d steps, the program has %d", r->found->steps,
                       r->steps);
    h->step = step;
    h->steady_from = -1;
    r->row = r->part = 0;
    r->particles = (rb_rolling_particles){.rc = r->rc,
                                          .model = model,
                                          .step = step,
                                          .steps = r->steps,
                                          .keeps_elements = r->found != NULL};
    s = rb_rolling_particles_create(&r->particles, why);
    if (s != RB_OK)
        return s;
    r->q = rb_arena_doubles(&r->particles.memory, (size_t)model->mesh.n, 1);
    return r->q ? rb_rolling_columns_alloc(&rb_rolling_history_columns, r->rc, model->mu_varies,
                                           r->steps, h)
                : RB_ENOMEM;
}

/* The case and its program. */
static rb_status begin_program(history_state *r, const rb_rolling_case *rc, rb_message *why)
{
    const rb_rolling_program *program = r->program;
    const rb_rolling_case whole = program ? rb_rolling_program_base(program, rc) : *rc;

    r->base = whole;
    r->base.mesh = RB_MESH_UNIFORM;
    r->rc = &r->base;
    r->program = program ? program : &r->own;
    memset(r->model, 0, sizeof *r->model);
    rb_status s = rb_rolling_case_check(&whole, why);
    if (s == RB_OK && !program && rc->formulation == RB_TRANSIENT && rc->distance == 0.0)
        s = rb_fail(why, RB_EINVAL, "distance: expected > 0, got 0");
    if (s == RB_OK && !program) {
        r->base.half_width = NAN; /* a column of loads replaces it */
        s = rb_rolling_program_of_case(rc, &r->columns, &r->own);
    }
    return s == RB_OK ? rb_rolling_program_check(r->program, r->rc, why) : s;
}

/* Loads that move and surfaces that are irregular may widen the contact beyond that of
 * the largest load at rest: the run starts again on a wider zone then. */
static rb_status run_program(history_state *r, const rb_rolling_case *rc, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_status s = begin_program(r, rc, why);

    for (double zone = r->base.zone, wider = 1.0; s == RB_OK && wider > 0.0; zone = wider) {
        wider = 0.0;
        s = prepare(r, zone, why);
        if (s == RB_OK) {
            s = rb_rolling_check_layer_resolved(model, all_steps(r, why), why);
            if (s == RB_OK && r->history->step == 0.0 && !model->problem.load_given)
                /* nothing rolls, no distance is measured by a: it is that of the largest load */
                r->history->half_width = rb_rolling_contact_half_width(
                    r->rc, fmax(0.0, largest(r->history->normal_load, r->history->n, 0.0)));
            if (s == RB_ZONE && r->rc->zone == 0.0) {
                const double now = fmax(-model->mesh.ends[0], model->mesh.ends[model->mesh.n]);
                double from, to;
                rb_rolling_extent(r->rc, &from, &to);
                const double widest = fmax(-from, to);
                wider = now < 0.999 * widest ? fmin(1.3 * now, widest) : 0.0;
            }
        }
        rb_rolling_particles_free(&r->particles);
        if (wider > 0.0) {
            /* more than asked for, with patches */
            r->base.contact_elements = model->mesh.n;
            rb_rolling_model_free(model);
            rb_rolling_history_free(r->history);
            s = RB_OK;
        }
    }
    return rb_arena_done(&r->columns, s);
}

rb_status rb_rolling_history_run(const rb_rolling_case *rc, const rb_rolling_program *program,
                                 const rb_rolling_observer *observer, rb_rolling_model *model,
                                 rb_rolling_history *history, rb_message *why)
{
    history_state r = {
        .program = program, .observer = observer, .model = model, .history = history};

    memset(history, 0, sizeof *history);
    return run_program(&r, rc, why);
}

static rb_status check_followed(const rb_rolling_states *states, rb_message *why)
{
    return states->half_width > 0.0
               ? RB_OK
               : rb_fail(why, RB_EINVAL, "history: half-width %g: expected > 0",
                         states->half_width);
}

rb_status rb_rolling_history_follow(const rb_rolling_case *rc, const rb_rolling_states *states,
                                    const rb_rolling_observer *observer, rb_rolling_model *model,
                                    rb_rolling_history *history, rb_message *why)
{
    history_state r = {.program = states->program,
                       .observer = observer,
                       .found = states,
                       .compression = INFINITY,
                       .scale = 1.0,
                       .model = model,
                       .history = history};

    memset(history, 0, sizeof *history);
    memset(model, 0, sizeof *model);
    history->half_width = states->half_width;
    const rb_status s = check_followed(states, why);
    return s == RB_OK ? run_program(&r, rc, why) : s;
}

/* ---- Step by step, with states that the caller sets -------------------------------- */

struct rb_rolling_follower {
    history_state r;
    rb_rolling_model model;
    rb_rolling_history history;
    const rb_rolling_follower *of;
};

rb_status rb_rolling_follower_create(const rb_rolling_case *rc, const rb_rolling_states *states,
                                     const rb_rolling_follower *of, double scale,
                                     rb_rolling_follower **follower, rb_message *why)
{
    rb_rolling_follower *f = *follower = calloc(1, sizeof *f);

    if (!f)
        return rb_fail(why, RB_ENOMEM, "out of memory for a history");
    f->r = (history_state){.program = states->program,
                           .found = states,
                           .like = of && !rb_rolling_relaxes(rc) ? &of->model : NULL,
                           .compression = RB_ROLLING_CLOSE,
                           .scale = scale,
                           .is_variant = of != NULL,
                           .model = &f->model,
                           .history = &f->history};
    f->of = f->r.like ? of : NULL;
    f->history.half_width = states->half_width;
    rb_status s = check_followed(states, why);
    if (s == RB_OK)
        s = begin_program(&f->r, rc, why);
    return s == RB_OK ? prepare(&f->r, f->r.base.zone, why) : s;
}

rb_rolling_model *rb_rolling_follower_model(rb_rolling_follower *f)
{
    return &f->model;
}

const rb_rolling_history *rb_rolling_follower_history(const rb_rolling_follower *f)
{
    return &f->history;
}

rb_status rb_rolling_follower_begin(rb_rolling_follower *f, rb_message *why)
{
    return begin_step(&f->r, why);
}

rb_status rb_rolling_follower_solve(rb_rolling_follower *f, rb_message *why)
{
    return solve_step(&f->r, why);
}

void rb_rolling_follower_end(rb_rolling_follower *f)
{
    end_step(&f->r, RB_OK);
}

void rb_rolling_follower_free(rb_rolling_follower *f)
{
    if (!f)
        return;
    rb_rolling_particles_free(&f->r.particles);
    rb_arena_free(&f->r.columns);
    if (f->of)
        rb_rolling_variant_free(&f->of->model, &f->model);
    else
        rb_rolling_model_free(&f->model);
    rb_rolling_history_free(&f->history);
    free(f);
}
