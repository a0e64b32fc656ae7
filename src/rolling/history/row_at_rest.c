/* A row at rest in as many steps as it needs. */
#include "rolling/case/internal.h"
#include "rolling/history/row.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"

#include <math.h>
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

/* What a row at rest changes, to compute it again in other steps. */
typedef struct {
    rb_rolling_states state; /* one */
    int row, part;
    double shift, half_width, interval, mu_given, strain;
    double *past; /* coefficients of friction, plastic slip, displacements that the bodies bring,
                     and what those that relax remember */
} checkpoint;

static void checkpoint_free(checkpoint *b)
{
    rb_rolling_states_free(&b->state);
    free(b->past);
}

static rb_status checkpoint_save(const history_state *r, checkpoint *b)
{
    const rb_rolling_model *model = r->model;
    const size_t n = (size_t)model->mesh.n, m = n + 1;
    const size_t size = rb_rolling_memory_track_size(&r->particles.past);

    *b = (checkpoint){.row = r->row,
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

static rb_status checkpoint_restore(checkpoint *b, history_state *r, rb_message *why)
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
static double change_of_tractions(const rb_rolling_model *model, const rb_rolling_states *other)
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
static int is_one_step_enough(const history_state *r, const checkpoint *before)
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

void rb_rolling_row_note_jump(const history_state *r)
{
    rb_rolling_rows *rows = &r->model->rows;

    if (rows->jumped > 0)
        return;
    rows->jumped = r->history->n;
    rows->jump_shift = r->fall.shift;
    rows->jump_force = r->fall.force;
}

rb_status rb_rolling_row_compute_at_rest(history_state *r, rb_message *why)
{
    const int given = rb_rolling_row_steps_at_rest(r);
    double fall[LOOKED_BACK] = {0.0};
    checkpoint start;
    rb_rolling_states coarser = {0};
    rb_status s;

    if (given > 0)
        return rb_rolling_row_compute(r, given, why);
    s = checkpoint_save(r, &start);
    if (s == RB_OK)
        s = rb_rolling_row_compute(r, 1, why);
    double change = s == RB_OK && !is_one_step_enough(r, &start) ? INFINITY : 0.0;
    int steps = 1;
    while (s == RB_OK && steps < ROW_STEPS &&
           (change > tolerated(r->model) || may_jump(r, steps, fall))) {
        const int row = r->history->n - 1;
        const double work = r->history->step_work[row];
        steps *= 2;
        s = rb_rolling_states_keep(r->model, r->history, 0, 1, &coarser);
        if (s == RB_OK)
            s = checkpoint_restore(&start, r, why);
        if (s == RB_OK)
            s = rb_rolling_row_compute(r, steps, why);
        if (s == RB_OK) {
            change = change_of_tractions(r->model, &coarser);
            r->history->halved_work[row] = fabs(r->history->step_work[row] - work);
        }
        for (int k = LOOKED_BACK - 1; k > 0; k--)
            fall[k] = fall[k - 1];
        fall[0] = r->fall.of_P;
    }
    if (s == RB_OK && steps >= STEPS_TO_JUMP && fall[0] > FALLS && !is_gradual(fall))
        rb_rolling_row_note_jump(r);
    if (s == RB_OK && change > tolerated(r->model) && change > r->model->rows.changes) {
        r->model->rows.changes = change;
        r->model->rows.changed = r->history->n;
    }
    rb_rolling_states_free(&coarser);
    checkpoint_free(&start);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for the steps of a row") : s;
}
