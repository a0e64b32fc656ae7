/* Sequences of contact problems, each starting from the state the last one left: static
 * increments and transient rolling (theory.md 4.2). */
#include "rolling/body/internal.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/history/history.h"
#include "rolling/history/internal.h"
#include "rolling/solve/columns.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/power.h"
#include "rolling/solve/stress.h"
#include "rolling/solve/variant.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Steps of a row at rest are halved until its tractions change by less than this part of what
 * the load makes, or than a tenth of what an element has, or until there are so many. */
static const double ROW_CHANGES = 1e-3, OF_AN_ELEMENT = 0.1;
enum { ROW_STEPS = 1024 };
/* Friction that falls by more than this part of mu P in a step may have jumped, and has if that
 * does not become half in a quarter of it. */
static const double FALLS = 2e-3;
enum { LOOKED_BACK = 3, STEPS_TO_JUMP = 32 };

void rb_rolling_history_free(rb_rolling_history *h)
{
    struct rb_rolling_history *const beside[] = {h->errors, h->deviations};

    for (int k = 0; k < 2; k++) {
        if (beside[k])
            rb_rolling_history_free(beside[k]);
        free(beside[k]);
    }
    free(h->cycle_errors);
    rb_rolling_columns_free(&rb_rolling_history_columns, h);
    memset(h, 0, sizeof *h);
}

/* ---- Steps ------------------------------------------------------------------------- */

/* A row is an entry of the history.  It is computed in one step or more, of which the last one
 * is recorded. */
typedef struct {
    rb_rolling_case base;                /* the case with equal elements, for the steps */
    rb_rolling_program own;              /* of the case, where none is given */
    rb_arena columns;                    /* of own */
    const rb_rolling_case *rc;           /* base */
    const rb_rolling_program *program;   /* own, or the given one */
    const rb_rolling_observer *observer; /* or NULL */
    const rb_rolling_states *found;      /* of the rows, to follow without solving; or NULL */
    const rb_rolling_model *like;        /* whose bodies may be borrowed; or NULL */
    const rb_rolling_mesh *elements;     /* that `scale` moves the ends of; or NULL */
    double compression;                  /* of boundaries, where states are found */
    double scale;                        /* of `elements` */
    int is_variant;                      /* 1: of the history that has found them */
    rb_rolling_model *model;
    rb_rolling_history *history;
    int rows;     /* in all */
    int at_rest;  /* of them, before the bodies roll */
    int rolled;   /* steps of a row that rolls */
    double shift; /* rigid shift so far [length] */
    rb_rolling_particles particles;
    rb_rolling_steady steady;
    int frets_from, frets_to; /* row after which the cycle of --fretting begins, and its last */
    int row, part;            /* of the program: rows towards this one that are done */
    int step, steps;          /* of the present row: done, and in all */
    rb_rolling_stride stride; /* the current step */
    double to;                /* [half-widths]: where it ends */
    struct {
        double of_P;         /* how far Q falls, as a part of mu P */
        double shift, force; /* before */
    } fall;                  /* the largest in a step of the row to full sliding (F6) */
} history_state;

/* Of the program at rest, `done` of `all` parts behind its row before; 0 where it has no times. */
static double time_at(const history_state *r, int done, int all)
{
    const double *t = r->program->time;

    if (!t || r->row == 0)
        return 0.0;
    return done == all ? t[r->row] : t[r->row - 1] + (t[r->row] - t[r->row - 1]) * done / all;
}

/* What must hold after every step. */
static rb_status assess(const history_state *r, rb_status s, rb_message *reason, rb_message *why)
{
    if (s == RB_OK)
        return s;
    rb_fail(why, s, "step %d: %.260s", r->history->n + 1, rb_status_reason(s, reason));
    if (why) /* what the step blames */
        memcpy(why->about, reason->about, sizeof why->about);
    return s;
}

/* The next row is one at rest. */
static int is_at_rest(const history_state *r)
{
    return r->history->n < r->at_rest;
}

/* Steps of the next row at rest where they do not depend on the answer; 0: they do. */
static int steps_at_rest(const history_state *r)
{
    const int increments = r->program == &r->own || r->rc->time_step > 0.0 ? 1 : r->rc->increments;
    return rb_rolling_program_steps(r->program, r->rc, r->row, increments);
}

/* Steps of the next row, where its state is given. */
static int steps_found(const history_state *r)
{
    const int known = is_at_rest(r) ? steps_at_rest(r) : r->is_variant ? 0 : r->rolled;
    return known > 0 ? known : r->found->substeps[r->history->n];
}

/* The problem of the next step: at rest, where the rigid shift or the given force moves
 * the contact towards a row of the program, or on the way. */
static rb_status begin_step(history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_contact_problem *p = &model->problem;
    const int k = r->history->n, rests = is_at_rest(r), is_first = k == 0 && r->step == 0;
    const double c = rests ? 0.0 : r->history->step / r->steps, mu_before = model->rc->mu;
    const rb_rolling_past past = {r->particles.w_T, model->carried.yielded, c};
    rb_rolling_case step;
    rb_message reason = {.text = ""};

    if (rests) {
        const int all = rb_rolling_program_parts(r->program, r->rc, r->row) * r->steps,
                  done = r->part * r->steps + r->step;
        const double interval = time_at(r, done + 1, all) - time_at(r, done, all);
        r->to = 0.0;
        r->stride = (rb_rolling_stride){0.0, interval, is_first};
        step = rb_rolling_program_row(r->program, r->rc, r->row, done + 1, all);
    } else {
        const double length = c / r->history->half_width;
        const int done = (k - r->at_rest) * r->steps + r->step;
        r->to = k + 1 == r->rows && r->step + 1 == r->steps
                    ? r->program->distance[r->program->n - 1]
                    : (done + 1) * length;
        r->stride = (rb_rolling_stride){c, rb_rolling_relaxes(r->rc) ? c / r->rc->speed : 0.0, 0};
        step = rb_rolling_program_step(r->program, r->rc, done * length, r->to);
    }
    /* The rows are checked beforehand; between two of them mu and the load both vary, and
     * their product may be less than a force that is linear. */
    rb_status s = assess(r, r->program->mu ? rb_rolling_program_check_case(&step, &reason) : RB_OK,
                         &reason, why);
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
    if (s == RB_OK && r->program->tilt) {
        s = rb_rolling_mesh_set_gap(model->rc, &model->mesh);
        rb_rolling_set_gap(&model->mesh, &model->bodies, p);
    }
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
    rb_rolling_set_past(model->rc, &model->bodies, is_first ? NULL : &past, p);
    rb_rolling_set_control(model->rc, p);
    if (rests)
        p->xi -= p->force_given ? 0.0 : r->shift;
    return RB_OK;
}

/* Whether the step, the present one, takes away friction that the one before had, and all
 * slides. */
static void see_fall(history_state *r, double shift_before)
{
    const rb_rolling_history *h = r->history;
    const rb_contact_state *state = &r->model->state;
    const int k = h->n, before = r->step > 1 ? k : k - 1;
    const double mu = r->model->rc->mu, P = rb_rolling_model_load(r->model);

    for (int i = 0; i < state->n; i++)
        if (state->zone[i] == RB_ZONE_STICK)
            return;
    if (before < 0 || !(mu * P > 0.0) || !(h->normal_load[before] > 0.0))
        return;
    const double Q = h->tangential_load[before],
                 fell = (fabs(Q) / h->normal_load[before] -
                         fabs(rb_rolling_model_force(r->model)) / P) /
                        mu;
    if (fell > r->fall.of_P) {
        r->fall.of_P = fell;
        r->fall.shift = shift_before;
        r->fall.force = Q;
    }
}

/* What follows from the state that the step has found.  Means over a row are those of its
 * steps, which have one length. */
static void end_step(history_state *r, rb_status s)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_model *model = r->model;
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const int k = h->n, rests = is_at_rest(r), rolls = model->rc->formulation == RB_TRANSIENT,
              done = ++r->step;

    if (rests && rb_rolling_law_depends_on_state(model->rc))
        see_fall(r, r->shift);
    if (rests)
        r->shift += state->xi;
    rb_rolling_particles_leave(&r->particles, &r->stride);
    rb_rolling_cycle_step(model);
    h->substeps[k] = done;
    h->distance[k] = r->to;
    h->shift[k] = r->shift;
    h->approach[k] = state->delta;
    h->normal_load[k] = rb_rolling_model_load(model);
    h->tangential_load[k] = rb_rolling_model_force(model);
    h->force_ratio[k] = rb_rolling_force_ratio(model);
    h->residual[k] = done > 1 ? fmax(h->residual[k], state->residual) : state->residual;
    h->max_pressure[k] = rb_rolling_peak_pressure(model);
    rb_rolling_contact_edges(model->rc, &model->mesh, state, &h->contact_from[k],
                             &h->contact_to[k]);
    double work = 0.0;
    if (rolls) {
        const double power = rb_rolling_dissipated_power(model->rc, p->n, state->lambda, state->q,
                                                         model->bodies.f.h, p->e_T);
        h->creepage[k] += (state->xi - h->creepage[k]) / done;
        h->dissipation[k] += (power - h->dissipation[k]) / done;
        work = power * r->stride.c;
    }
    for (int i = 0; i < p->n && !rolls; i++)
        work -= state->zone[i] > RB_ZONE_STICK
                    ? state->q[i] * state->lambda[i] * model->bodies.f.h[i]
                    : 0.0;
    h->step_work[k] = work + (done > 1 ? h->step_work[k] : 0.0);
    h->friction_work[k] = h->step_work[k] + (k > 0 ? h->friction_work[k - 1] : 0.0);
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
        const int all = rb_rolling_program_parts(r->program, r->rc, r->row) * r->steps;
        h->time[k] = r->program->time ? time_at(r, r->part * r->steps + done, all)
                                      : r->to * h->half_width / r->rc->speed;
        h->lost_work[k] = r->particles.past.lost;
    }
    if (h->mu)
        h->mu[k] = model->rc->mu;
    if (h->bulk_stress)
        h->bulk_stress[k] = model->rc->bulk_stress;
    if (h->bulk_stress_b)
        h->bulk_stress_b[k] = model->rc->bulk_stress_b;
    if (h->tilt)
        h->tilt[k] = model->rc->tilt;
    h->stick[k] = h->slipping[k] = 0;
    for (int i = 0; i < p->n; i++) {
        h->stick[k] += state->zone[i] == RB_ZONE_STICK;
        h->slipping[k] += state->zone[i] > RB_ZONE_STICK;
    }
    if (!rests && s == RB_OK)
        rb_rolling_steady_see(&r->steady, model, h, r->to * h->half_width);
    if (done < r->steps && s == RB_OK)
        return;
    h->n++;
    r->step = 0;
    if (rests && ++r->part == rb_rolling_program_parts(r->program, r->rc, r->row)) {
        r->part = 0;
        r->row++;
    }
}

/* The element that touches first. */
static int first_to_touch(const rb_contact_problem *p)
{
    int k = 0;

    for (int i = 1; i < p->n; i++)
        k = p->d_N[i] < p->d_N[k] ? i : k;
    return k;
}

/* The approach at first touch: of the parabola through that element and its neighbours. */
static double touch(const rb_contact_problem *p, const double *x)
{
    const int k = first_to_touch(p);
    double rise = 0.0, off;

    if (k > 0 && k < p->n - 1) {
        const double d[2] = {x[k - 1] - x[k], x[k + 1] - x[k]},
                     f[2] = {p->d_N[k] - p->d_N[k - 1], p->d_N[k] - p->d_N[k + 1]};
        if (!rb_rolling_vertex(d, f, &rise, &off))
            rise = 0.0;
    }
    return fabs(p->d_N[k] - rise) > 1e-12 * rise ? p->d_N[k] - rise : 0.0;
}

/* 1: under what the step gives, the bodies do not touch: without a load, or not so near. */
static int is_apart(const rb_contact_problem *p)
{
    return p->load_given ? p->load == 0.0 : p->delta <= p->d_N[first_to_touch(p)];
}

/* The state of bodies that do not touch: what moves them goes on, without friction. */
static rb_status part(rb_rolling_model *model, rb_message *why)
{
    rb_contact_problem *p = &model->problem;
    rb_contact_state *state = &model->state;
    const size_t n = (size_t)state->n;
    rb_arena scratch = {0};
    double *gap = rb_arena_doubles(&scratch, n, 1);

    memset(state->p, 0, n * sizeof *state->p);
    memset(state->q, 0, n * sizeof *state->q);
    memset(state->plastic, 0, n * sizeof *state->plastic);
    memset(state->zone, 0, n * sizeof *state->zone);
    state->delta = p->load_given ? touch(p, model->bodies.f.x) : p->delta;
    model->half_width = 0.0;
    if (!isnan(model->rc->creep_ratio) && model->rc->formulation == RB_TRANSIENT)
        p->xi = rb_rolling_creepage_of_ratio(model, model->rc->creep_ratio);
    state->xi = p->force_given ? 0.0 : p->xi;
    state->residual = 0.0;
    state->status = RB_OK;
    if (scratch.failed)
        return rb_fail(why, rb_arena_done(&scratch, RB_ENOMEM), "out of memory");
    rb_contact_kinematics(p, state, gap, state->lambda);
    rb_arena_free(&scratch);
    return rb_rolling_model_friction(model, why); /* particles remember their coefficients */
}

static rb_status solve_step(const history_state *r, rb_message *why)
{
    if (is_apart(&r->model->problem))
        return part(r->model, why);
    return is_at_rest(r) ? rb_rolling_model_resolve(r->model, r->step > 0, why)
                         : rb_rolling_model_control(r->model, why);
}

/* The given state of a row, with the residual that it leaves. */
static rb_status take_found(const history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_contact_state *state = &model->state;
    rb_contact_violation v = {.scaled = NAN};

    rb_rolling_states_get(r->found, r->history->n, state);
    model->half_width =
        rb_rolling_contact_half_width(model->rc, fmax(0.0, rb_rolling_model_load(model)));
    if (!isnan(model->rc->creep_ratio) && model->rc->formulation == RB_TRANSIENT)
        model->problem.xi = rb_rolling_creepage_of_ratio(model, model->rc->creep_ratio);
    rb_status s = rb_rolling_model_friction(model, why);
    if (s == RB_OK)
        s = rb_contact_residual(&model->problem, state, &v);
    state->residual = v.scaled;
    return s;
}

/* A row in this number of steps. */
static rb_status compute_row(history_state *r, int steps, rb_message *why)
{
    rb_status s = RB_OK;

    r->steps = steps;
    memset(&r->fall, 0, sizeof r->fall);
    rb_rolling_cycle_begin_row(r->model->cycle);
    for (int i = 0; i < steps && s == RB_OK; i++) {
        rb_message reason = {.text = ""};
        s = begin_step(r, why);
        if (s != RB_OK)
            return s;
        s = r->found && i + 1 == steps ? take_found(r, &reason) : solve_step(r, &reason);
        if (s == RB_INTERRUPTED)
            return rb_fail(why, s, "interrupted after step %d of %d", r->history->n, r->rows);
        s = assess(r, s, &reason, why);
        if (s >= 0)
            end_step(r, s);
        if (s == RB_OK)
            s = rb_rolling_check_crushed(r->model, why);
    }
    return s;
}

/* ---- Rows at rest in as many steps as they need ------------------------------------- */

/* What a row at rest changes, to compute it again in other steps. */
typedef struct {
    rb_rolling_states state; /* one */
    int row, part;
    double shift, half_width, interval, mu_given, strain;
    double *past; /* coefficients of friction, plastic slip, displacements that the bodies bring,
                     and what those that relax remember */
} bookmark;

static void bookmark_free(bookmark *b)
{
    rb_rolling_states_free(&b->state);
    free(b->past);
}

static rb_status bookmark_set(const history_state *r, bookmark *b)
{
    const rb_rolling_model *model = r->model;
    const size_t n = (size_t)model->mesh.n, m = n + 1;
    const size_t size = rb_rolling_memory_track_size(&r->particles.past);

    *b = (bookmark){.row = r->row,
                    .part = r->part,
                    .shift = r->shift,
                    .half_width = model->half_width,
                    .interval = r->particles.interval,
                    .mu_given = r->particles.mu_given,
                    .strain = r->particles.strain,
                    .past = rb_alloc(2 * n + 2 * m + size, 1)};
    if (!b->past)
        return RB_ENOMEM;
    rb_rolling_memory_track_save(&r->particles.past, b->past + 2 * n + 2 * m);
    if (r->history->n == 0) /* bodies that relax have no problem yet, and others no past */
        return RB_OK;
    memcpy(b->past, model->problem.bound, n * sizeof *b->past);
    if (model->carried.yielded)
        memcpy(b->past + n, model->carried.yielded, n * sizeof *b->past);
    memcpy(b->past + 2 * n, model->bodies.f.w0, 2 * m * sizeof *b->past);
    return rb_rolling_states_keep(model, r->history, 0, 1, &b->state);
}

static rb_status bookmark_return(bookmark *b, history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    const size_t n = (size_t)model->mesh.n, m = n + 1;
    rb_status s = RB_OK;

    r->row = b->row;
    r->part = b->part;
    r->shift = b->shift;
    model->half_width = b->half_width;
    r->particles.mu_given = b->mu_given;
    r->particles.strain = b->strain;
    rb_rolling_memory_track_restore(&r->particles.past, b->past + 2 * n + 2 * m);
    if (model->carried.yielded)
        memcpy(model->carried.yielded, b->past + n, n * sizeof *b->past);
    if (--r->history->n == 0) {
        r->particles.interval = b->interval; /* the first step builds them again */
        rb_rolling_start_bounds(model->rc, NULL, &model->bodies, &model->problem);
        return RB_OK;
    }
    if (rb_rolling_relaxes(r->rc))
        s = rb_rolling_particles_bodies(&r->particles, b->interval, why);
    if (s != RB_OK)
        return s;
    memcpy(model->bodies.f.w0, b->past + 2 * n, 2 * m * sizeof *b->past);
    memcpy(model->problem.bound, b->past, n * sizeof *b->past);
    rb_rolling_states_get(&b->state, 0, &model->state);
    return RB_OK;
}

/* How much the tractions of a state differ from others, as a part of what the load makes. */
static double differs(const rb_rolling_model *model, const rb_rolling_states *other)
{
    const rb_contact_state *state = &model->state;
    const double *h = model->bodies.f.h, P = rb_rolling_model_load(model),
                 mu = fmin(1.0, rb_rolling_largest_mu(model->rc));
    double of_p = 0.0, of_q = 0.0;

    for (int i = 0; i < state->n; i++) {
        of_p += fabs(state->p[i] - other->p[i]) * h[i];
        of_q += fabs(state->q[i] - other->q[i]) * h[i];
    }
    return P > 0.0 ? fmax(of_p, mu > 0.0 ? of_q / mu : 0.0) / P : 0.0;
}

static double tolerated(const rb_rolling_model *model)
{
    int contact = 0;

    for (int i = 0; i < model->state.n; i++)
        contact += model->state.p[i] > 0.0;
    return fmax(ROW_CHANGES, OF_AN_ELEMENT / fmax(1.0, contact));
}

/* 1: the pressure is that of the other state. */
static int is_pressure(const rb_rolling_model *model, const rb_rolling_states *other)
{
    const double p0 = rb_norm_inf((size_t)model->state.n, model->state.p);
    int same = 1;

    for (int i = 0; i < model->state.n; i++)
        same &= fabs(model->state.p[i] - other->p[i]) <= 1e-9 * p0;
    return same;
}

/* 1: a row at rest has one answer, in however many steps it is computed: without contact at its
 * end, without friction and memory, or if a force or shift alone moved bodies that are not
 * coupled, no bulk stress strained them, and no law changed on the way. */
static int is_one_step_enough(const history_state *r, const bookmark *before)
{
    const rb_rolling_model *model = r->model;
    const int coupled = rb_contact_operator_response(model->problem.op).coupled, row = before->row,
              is_first = before->state.n == 0;
    const double *mu = r->program->mu;

    if (rb_rolling_relaxes(r->rc))
        return 0;
    return model->problem.mu == 0.0 || rb_rolling_model_load(model) == 0.0 ||
           (!coupled && rb_rolling_bulk_strain(model->rc) == before->strain &&
            !(mu && row > 0 && mu[row] != mu[row - 1]) &&
            !rb_rolling_law_depends_on_state(model->rc) &&
            (is_first || is_pressure(model, &before->state)));
}

/* The falls in a step of the row in as many steps, half as many and so on: what falls on a path
 * falls half as far in half a step; a jump does not. */
static int is_gradual(const double fall[LOOKED_BACK])
{
    return !(fall[0] > 0.5 * fall[LOOKED_BACK - 1]);
}

/* 1: the row in `steps` does not tell whether the contact has jumped on the way, or from where. */
static int may_jump(const history_state *r, int steps, const double fall[LOOKED_BACK])
{
    const rb_rolling_history *h = r->history;
    const int row = h->n - 1;

    if (!rb_rolling_law_depends_on_state(r->model->rc))
        return 0;
    return steps < STEPS_TO_JUMP
               ? fall[0] > FALLS || (h->stick[row] == 0 && h->slipping[row] > 0 &&
                                     (row == 0 || h->stick[row - 1] > 0))
               : fall[0] > FALLS && (is_gradual(fall) || fabs(fall[0] - fall[1]) > FALLS);
}

static void note_jump(const history_state *r)
{
    rb_rolling_rows *rows = &r->model->rows;

    if (rows->jumped > 0)
        return;
    rows->jumped = r->history->n;
    rows->jump_shift = r->fall.shift;
    rows->jump_force = r->fall.force;
}

/* Steps are halved until the state at the end of the row no longer depends on them. */
static rb_status compute_row_at_rest(history_state *r, rb_message *why)
{
    const int given = steps_at_rest(r);
    double fall[LOOKED_BACK] = {0.0};
    bookmark start;
    rb_rolling_states coarser = {0};
    rb_status s;

    if (given > 0)
        return compute_row(r, given, why);
    s = bookmark_set(r, &start);
    if (s == RB_OK)
        s = compute_row(r, 1, why);
    double change = s == RB_OK && !is_one_step_enough(r, &start) ? INFINITY : 0.0;
    int steps = 1;
    while (s == RB_OK && steps < ROW_STEPS &&
           (change > tolerated(r->model) || may_jump(r, steps, fall))) {
        steps *= 2;
        s = rb_rolling_states_keep(r->model, r->history, 0, 1, &coarser);
        if (s == RB_OK)
            s = bookmark_return(&start, r, why);
        if (s == RB_OK)
            s = compute_row(r, steps, why);
        if (s == RB_OK)
            change = differs(r->model, &coarser);
        for (int k = LOOKED_BACK - 1; k > 0; k--)
            fall[k] = fall[k - 1];
        fall[0] = r->fall.of_P;
    }
    if (s == RB_OK && steps >= STEPS_TO_JUMP && fall[0] > FALLS && !is_gradual(fall))
        note_jump(r);
    if (s == RB_OK && change > tolerated(r->model) && change > r->model->rows.changes) {
        r->model->rows.changes = change;
        r->model->rows.changed = r->history->n;
    }
    rb_rolling_states_free(&coarser);
    bookmark_free(&start);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the steps of a row") : s;
}

/* The row at which the last cycle begins: the last row and the one before it are prescribed as it
 * and the one before it; -1: none is. */
static int begin_of_cycle(const rb_rolling_program *program)
{
    const int last = program->n - 1;
    int j = last - 1;

    while (j > 0 && !(rb_rolling_program_is_same(program, j, last) &&
                      rb_rolling_program_is_same(program, j - 1, last - 1)))
        j--;
    return j > 0 ? j : -1;
}

/* The same for --fretting, which sees by the friction whether the cycle closes: the row before may
 * differ, as when the force rises from zero the first time. */
static int begin_of_fretting(const rb_rolling_program *program)
{
    const int last = program->n - 1;
    int j = begin_of_cycle(program);

    if (j >= 0)
        return j;
    for (j = last - 1; j >= 0 && !rb_rolling_program_is_same(program, j, last);)
        j--;
    return j;
}

/* Without `fretting` -1.  A body whose stress is not known is refused before anything is solved. */
static rb_status prepare_cycle(history_state *r, rb_message *why)
{
    const int from = r->rc->cycle_from, to = r->rc->cycle_to, rows = r->program->n;

    r->frets_from = -1;
    r->frets_to = rows - 1;
    if (!r->rc->fretting)
        return RB_OK;
    if (to > 0 && !(from >= 1 && from < to && to <= rows))
        return rb_refuse(why, "cycle",
                         "expected two rows of the history, 1 to %d, the earlier one first, got "
                         "%d,%d",
                         rows, from, to);
    rb_status s = rb_rolling_stress_check(r->rc, why);
    if (s == RB_OK && r->rc->elastic_b)
        s = rb_rolling_mirror_check(r->rc, why);
    r->frets_from = to > 0 ? from - 1 : begin_of_fretting(r->program);
    r->frets_to = to > 0 ? to - 1 : r->frets_to;
    return s == RB_OK && r->frets_from < 0
               ? rb_refuse(why, "fretting",
                           "the rows of the history end with no cycle; the last row must prescribe "
                           "what a row before it does, or --cycle name two rows")
               : s;
}

/* How much of mu p0 the friction at the end of a cycle may differ from that at its beginning. */
static const double CLOSES = 1e-6;

static rb_status check_cycle(const history_state *r, rb_message *why)
{
    const double misses = rb_rolling_cycle_misses(r->model);
    char end[30] = "the last one";

    if (misses <= CLOSES)
        return RB_OK;
    if (r->rc->cycle_to > 0)
        snprintf(end, sizeof end, "row %d", r->frets_to + 1);
    return rb_refuse(why, "fretting,cycle",
                     "the cycle from row %d of the history to %s does not close, "
                     "friction differs by %.2g mu p0; append the rows of the cycle once more",
                     r->frets_from + 1, end, misses);
}

/* After a row. */
static rb_status follow_cycle(const history_state *r, rb_message *why)
{
    const int row = r->row - 1;
    rb_status s = RB_OK;

    if (row == r->frets_from)
        s = rb_rolling_cycle_begin(r->model, why);
    else if (row > r->frets_from && row <= r->frets_to)
        s = rb_rolling_cycle_end_row(r->model, why);
    if (s == RB_OK && row == r->frets_to) {
        s = check_cycle(r, why);
        rb_rolling_cycle_end(r->model);
    }
    return s;
}

/* The last cycle, or the one that is asked for. */
static void find_cycle(const history_state *r)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_program *program = r->program;
    const int given = r->rc->cycle_to > 0, last = given ? r->frets_to : program->n - 1,
              j = program->distance || h->n != program->n ? -1
                  : given                                 ? r->frets_from
                                                          : begin_of_cycle(program);

    h->cycle_work = j < 0 ? (double)NAN : h->friction_work[last] - h->friction_work[j];
    h->cycle_rows = j < 0 ? 0 : last - j;
}

static rb_status all_rows(history_state *r, rb_message *why)
{
    const rb_rolling_observer *o = r->observer;

    for (int k = 0; k < r->rows; k++) {
        const int rests = is_at_rest(r);
        const rb_status s = r->found ? compute_row(r, steps_found(r), why)
                            : rests  ? compute_row_at_rest(r, why)
                                     : compute_row(r, r->rolled, why);
        if (s != RB_OK)
            return s;
        if (r->rc->fretting && r->part == 0) {
            const rb_status of_cycle = follow_cycle(r, why);
            if (of_cycle != RB_OK)
                return of_cycle;
        }
        if (r->found && r->found->rows.jumped == r->history->n)
            note_jump(r);
        if (o && o->step && o->step(r->model, r->history, k, r->rows, o->context))
            return rb_fail(why, RB_INTERRUPTED, "interrupted after step %d of %d", k + 1, r->rows);
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
    if (rb_rolling_law_depends_on_slip(&widest.friction)) {
        widest.mu = rb_rolling_law_at_rest(&widest, 0.0);
        widest.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
    }
    widest.zone = zone;
    widest.load = largest(program->load, program->n, widest.load);
    widest.approach = largest(program->approach, program->n, widest.approach);
    widest.shift = widest.creep = widest.creep_ratio = widest.force = NAN;
    widest.force_ratio = 0.0;
    if (!r->found)
        return rb_rolling_model_create(&widest, r->model, why);
    if (r->like)
        return rb_rolling_variant_place(r->like, &widest, 0.0, r->scale, r->model, why);
    rb_rolling_plan plan = rb_rolling_plan_of(&widest);
    rb_rolling_mesh mesh = {0};
    plan.compression = r->compression;
    if (r->elements) { /* equal arcs, also of another circle */
        const double *ends = r->elements->ends;
        const int n = plan.elements = r->elements->n;
        const rb_status s = rb_rolling_mesh_uniform(&widest, &plan, r->scale * ends[0],
                                                    r->scale * ends[n], &mesh, why);
        return s == RB_OK ? rb_rolling_model_on_mesh(&widest, &plan, &mesh, r->model, why) : s;
    }
    const rb_rolling_elements elements = {
        .are_equal = 1, .n = r->found->n, .x = r->found->x, .h = r->found->h};
    return rb_rolling_model_of_result(&widest, &plan, &elements, r->model, why);
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
    model->varies = rb_rolling_program_varies(r->program);
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
    /* Rows that roll, and their steps.  Where the case does not say, a row is one step of one
     * element, or of as little less as brings the last one to the last row: a single short step
     * would find a creepage that is mostly error.  Of a variant of a history there are as many as
     * there.  Longer rows are computed in equal steps of at most an element. */
    const int rows = rb_rolling_program_at_rest(r->program), n = r->program->n;
    const double way = rows < n ? r->program->distance[n - 1] * h->half_width : 0.0;
    const double elements = way / rb_rolling_middle_length(model),
                 shortest = ceil(elements * (1.0 - 1e-9));
    r->at_rest = 0;
    for (int row = 0; row < rows; row++)
        r->at_rest += rb_rolling_program_parts(r->program, r->rc, row);
    const double count = way == 0.0         ? 0.0
                         : r->rc->steps > 0 ? r->rc->steps
                         : r->is_variant    ? fmax(1.0, r->found->steps - r->at_rest)
                                            : shortest;
    const double each = way == 0.0 || count > shortest ? 1.0
                        : r->is_variant && r->found->steps > r->at_rest
                            ? r->found->substeps[r->at_rest]
                            : ceil(elements / count * (1.0 - 1e-9));

    if (count * each > RB_ROLLING_MOST_STEPS)
        return rb_refuse(why, "distance", "%g half-widths are %.3g steps; expected at most %g",
                         way / h->half_width, count * each, (double)RB_ROLLING_MOST_STEPS);
    if (count > shortest && rb_rolling_relaxes(r->rc) && !r->found)
        return rb_refuse(why, "steps",
                         "viscoelastic bodies roll by one element in each step; expected at "
                         "most %g with these elements, got %g",
                         shortest, count);
    r->rows = r->at_rest + (int)count;
    r->rolled = (int)each;
    if (r->found && r->found->steps != r->rows)
        return rb_refuse(why, "history", "%d steps, the program has %d", r->found->steps, r->rows);
    h->step = way == 0.0 ? 0.0 : way / count;
    h->steady_from = -1;
    r->row = r->part = r->step = 0;
    r->particles = (rb_rolling_particles){.rc = r->rc,
                                          .model = model,
                                          .step = h->step / r->rolled,
                                          .steps = r->at_rest + (int)(count * each),
                                          .keeps_elements = r->found != NULL};
    s = rb_rolling_particles_create(&r->particles, why);
    if (s == RB_OK)
        s = rb_rolling_steady_create(model->mesh.n, &r->particles.memory, &r->steady);
    return s == RB_OK ? rb_rolling_columns_alloc(&rb_rolling_history_columns, r->rc, model->varies,
                                                 r->rows, h)
                      : s;
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
    /* a variant is nearly what was checked, and may be beyond a bound by as much */
    rb_status s = r->is_variant ? RB_OK
                  : program     ? rb_rolling_program_check_base(program, &whole, why)
                                : rb_rolling_case_check(&whole, why);
    if (s == RB_OK && !program && rc->formulation == RB_TRANSIENT && rc->distance == 0.0)
        s = rb_refuse(why, "distance", "expected > 0, got 0");
    if (s == RB_OK && !program) {
        rb_rolling_press_by_load(&r->base); /* a column of loads replaces it */
        s = rb_rolling_program_of_case(rc, &r->columns, &r->own);
    }
    if (s == RB_OK && !r->is_variant)
        s = rb_rolling_program_check(r->program, r->rc, why);
    return s == RB_OK ? prepare_cycle(r, why) : s;
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
            s = rb_rolling_check_layer_resolved(model, all_rows(r, why), why);
            r->history->steady_from = rb_rolling_steady_from(&r->steady, r->rc, r->history);
            find_cycle(r);
            if (r->found) {
                model->rows.changed = r->found->rows.changed;
                model->rows.changes = r->found->rows.changes;
            }
            r->history->rows = model->rows;
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
               : rb_refuse(why, "history", "half-width %g: expected > 0", states->half_width);
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
                           .elements = of ? &of->model.mesh : NULL,
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
    if (f->r.step == 0)
        f->r.steps = steps_found(&f->r);
    return begin_step(&f->r, why);
}

int rb_rolling_follower_ends_row(const rb_rolling_follower *f)
{
    return f->r.step + 1 == f->r.steps;
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
