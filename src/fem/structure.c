/* A structure that may touch obstacles, and its state. */
#include "rollbem/fem.h"

#include <stdlib.h>
#include <string.h>

void rb_fem_structure_free(rb_fem_structure *s)
{
    if (!s)
        return;
    rb_sparse_free(&s->K);
    rb_sparse_free(&s->H);
    free(s->mu);
    free(s->gap);
    memset(s, 0, sizeof *s);
}

rb_status rb_fem_state_alloc(const rb_fem_structure *s, rb_fem_state *state)
{
    state->u = rb_alloc((size_t)s->dofs, 1);
    state->r = rb_alloc((size_t)s->dimension, (size_t)s->contacts);
    if (state->u && state->r)
        return RB_OK;
    rb_fem_state_free(state);
    return RB_ENOMEM;
}

void rb_fem_state_free(rb_fem_state *state)
{
    if (!state)
        return;
    free(state->u);
    free(state->r);
    *state = (rb_fem_state){NULL, NULL};
}
