/* A row of a history, step by step: each step starts from the state the last one left (theory.md
 * 4.2). */
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/history/row.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/power.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <string.h>

/* Of the program at rest, `done` of `all` parts behind its row before; 0 where it has no times. */
static double time_at(const history_state *r, int done, int all)
{
    const double *t = r->program->time;

    if (!t || r->row == 0)
        return 0.0;
    return done == all ? t[r->row] : t[r->row - 1] + (t[r->row] - t[r->row - 1]) * done / all;
}

/* What must hold after every step. */
static rb_status name_step(const history_state *r, rb_status s, rb_message *reason, rb_message *why)
{
    if (s == RB_OK)
        return s;
    rb_fail(why, s, "step %d: %.260s", r->history->n + 1, rb_status_reason(s, reason));
    if (why) /* what the step blames */
        memcpy(why->about, reason->about, sizeof why->about);
    return s;
}

int rb_rolling_row_is_at_rest(const history_state *r)
{
    return r->history->n < r->at_rest;
}

int rb_rolling_row_steps_at_rest(const history_state *r)
{
    const int increments = r->program == &r->own || r->rc->time_step > 0.0 ? 1 : r->rc->increments;
    return rb_rolling_program_steps(r->program, r->rc, r->row, increments);
}

/* Sets up the next step: its case from the program, the particles brought to where the step leaves
 * them, gap, bounds and controls. w_T and yielded: of the state before, where the material comes
 * from (4.2). */
rb_status rb_rolling_row_begin_step(history_state *r, rb_message *why)
{
    rb_rolling_model *model = r->model;
    rb_contact_problem *p = &model->problem;
    const int k = r->history->n, rests = rb_rolling_row_is_at_rest(r),
              is_first = k == 0 && r->step == 0;
    const double c = rests ? 0.0 : r->history->step / r->steps, mu_before = model->rc->mu;
    const rb_rolling_past past = {r->particles.w_T, model->carried.yielded, c};
    rb_rolling_case step;
    rb_message reason = {.text = ""};

    if (rests) {
        /* At rest: part `done` of all steps between two rows of the program. */
        const int all = rb_rolling_program_parts(r->program, r->rc, r->row) * r->steps,
                  done = r->part * r->steps + r->step;
        const double interval = time_at(r, done + 1, all) - time_at(r, done, all);
        r->to = 0.0;
        r->stride = (rb_rolling_stride){0.0, interval, is_first};
        step = rb_rolling_program_row(r->program, r->rc, r->row, done + 1, all);
    } else {
        /* In rolling: from `done` to `done` + 1 lengths c; distances of the program are in
         * half-widths. */
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
    rb_status s = name_step(
        r, r->program->mu ? rb_rolling_program_check_case(&step, &reason) : RB_OK, &reason, why);
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
void rb_rolling_row_end_step(history_state *r, rb_status s)
{
    rb_rolling_history *h = r->history;
    const rb_rolling_model *model = r->model;
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    const int k = h->n, rests = rb_rolling_row_is_at_rest(r),
              rolls = model->rc->formulation == RB_TRANSIENT, done = ++r->step;

    if (rests && rb_rolling_law_depends_on_state(model->rc))
        see_fall(r, r->shift);
    if (rests)
        r->shift += state->xi; /* xi of a step at rest is an increment (4.2) */
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

rb_status rb_rolling_row_solve_step(const history_state *r, rb_message *why)
{
    if (is_apart(&r->model->problem))
        return part(r->model, why);
    return rb_rolling_row_is_at_rest(r) ? rb_rolling_model_resolve(r->model, r->step > 0, why)
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

int rb_rolling_row_is_not_unique(const history_state *r)
{
    const rb_rolling_model *model = r->model;
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *state = &model->state;
    int stick = 0;

    if (!p->force_given || rb_rolling_carries_more_with_slip(model->rc) || !(p->mu > 0.0) ||
        rb_rolling_law_depends_on_state(model->rc))
        return 0;
    for (int i = 0; i < state->n; i++)
        stick += state->zone[i] == RB_ZONE_STICK;
    return rb_rolling_slips_both_ways(state->n, state->zone) &&
           stick == rb_rolling_count_at_bound(model->rc, state->n, state->zone, state->p, state->q,
                                              p->bound, p->mu);
}

rb_status rb_rolling_row_compute(history_state *r, int steps, rb_message *why)
{
    rb_status s = RB_OK;

    r->steps = steps;
    r->not_unique = 0;
    memset(&r->fall, 0, sizeof r->fall);
    rb_rolling_cycle_begin_row(r->model->cycle);
    for (int i = 0; i < steps && s == RB_OK; i++) {
        rb_message reason = {.text = ""};
        s = rb_rolling_row_begin_step(r, why);
        if (s != RB_OK)
            return s;
        s = r->found && i + 1 == steps ? take_found(r, &reason)
                                       : rb_rolling_row_solve_step(r, &reason);
        if (s == RB_INTERRUPTED)
            return rb_fail(why, s, "interrupted after step %d of %d", r->history->n, r->rows);
        s = name_step(r, s, &reason, why);
        if (s >= 0)
            rb_rolling_row_end_step(r, s);
        if (s == RB_OK && i + 1 < steps)
            r->not_unique |= rb_rolling_row_is_not_unique(r);
        if (s == RB_OK)
            s = rb_rolling_check_crushed(r->model, why);
    }
    return s;
}
