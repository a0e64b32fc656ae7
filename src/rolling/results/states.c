/* The states of the steps of a history, stored for rb_rolling_history_follow. */
#include "base/base.h"
#include "rolling/history/history.h"

#include <stdlib.h>
#include <string.h>

void rb_rolling_states_free(rb_rolling_states *s)
{
    free(s->x);
    free(s->p);
    free(s->delta);
    free(s->zone);
    free(s->substeps);
    memset(s, 0, sizeof *s);
}

rb_status rb_rolling_states_alloc(int n, int steps, rb_rolling_states *s)
{
    const size_t m = (size_t)n, all = (size_t)steps * m;

    *s = (rb_rolling_states){.n = n,
                             .steps = steps,
                             .x = rb_alloc(m, 2),
                             .p = rb_alloc(all, 4),
                             .delta = rb_alloc((size_t)steps, 2),
                             .zone = rb_alloc_int(all),
                             .substeps = rb_alloc_int((size_t)steps)};
    if (!s->x || !s->p || !s->delta || !s->zone || !s->substeps) {
        rb_rolling_states_free(s);
        return RB_ENOMEM;
    }
    s->h = s->x + m;
    s->q = s->p + all;
    s->lambda = s->q + all;
    s->plastic = s->lambda + all;
    s->xi = s->delta + steps;
    for (int k = 0; k < steps; k++)
        s->substeps[k] = 1;
    return RB_OK;
}

rb_status rb_rolling_states_keep(const rb_rolling_model *model, const rb_rolling_history *history,
                                 int step, int steps, rb_rolling_states *s)
{
    const rb_contact_state *state = &model->state;
    const size_t n = (size_t)model->mesh.n, at = (size_t)step * n;

    if (step == 0) {
        rb_rolling_states_free(s);
        if (rb_rolling_states_alloc(model->mesh.n, steps, s) != RB_OK)
            return RB_ENOMEM;
    }
    memcpy(s->x, model->bodies.f.x, n * sizeof *s->x);
    memcpy(s->h, model->bodies.f.h, n * sizeof *s->h);
    memcpy(s->p + at, state->p, n * sizeof *s->p);
    memcpy(s->q + at, state->q, n * sizeof *s->q);
    memcpy(s->lambda + at, state->lambda, n * sizeof *s->lambda);
    memcpy(s->plastic + at, state->plastic, n * sizeof *s->plastic);
    memcpy(s->zone + at, state->zone, n * sizeof *s->zone);
    s->delta[step] = state->delta;
    s->xi[step] = state->xi;
    s->substeps[step] = history->substeps[step];
    return RB_OK;
}

void rb_rolling_states_get(const rb_rolling_states *s, int step, rb_contact_state *state)
{
    const size_t n = (size_t)s->n, at = (size_t)step * n;

    memcpy(state->p, s->p + at, n * sizeof *state->p);
    memcpy(state->q, s->q + at, n * sizeof *state->q);
    memcpy(state->lambda, s->lambda + at, n * sizeof *state->lambda);
    memcpy(state->plastic, s->plastic + at, n * sizeof *state->plastic);
    memcpy(state->zone, s->zone + at, n * sizeof *state->zone);
    state->delta = s->delta[step];
    state->xi = s->xi[step];
    state->status = RB_OK;
}
