/* A structure that may touch obstacles, its state, and one increment as a problem of
 * friction. */
#include "fem/fem.h"

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

static void scale(size_t n, double factor, double *x)
{
    for (size_t i = 0; i < n; i++)
        x[i] *= factor;
}

rb_status rb_fem_problem(const rb_fem_structure *s, const double *load, const rb_fem_state *state,
                         rb_friction_problem *problem, rb_fem_units *units)
{
    const size_t m = (size_t)s->dimension * (size_t)s->contacts;
    memset(problem, 0, sizeof *problem);
    problem->form = RB_FRICTION_GLOBAL;
    problem->dimension = s->dimension;
    problem->contacts = s->contacts;
    problem->dofs = s->dofs;
    problem->mu = rb_alloc((size_t)s->contacts, 1);
    problem->f = rb_alloc((size_t)s->dofs, 1);
    problem->w = rb_alloc(m, 1);
    rb_status status = problem->mu && problem->f && problem->w ? RB_OK : RB_ENOMEM;
    if (status == RB_OK)
        status = rb_sparse_copy(&s->K, &problem->K);
    if (status == RB_OK)
        status = rb_sparse_copy(&s->H, &problem->H);
    if (status == RB_OK) {
        /* Forces by the largest load, lengths so that K has a mean diagonal of one. */
        double trace = 0.0;
        for (int j = 0; j < s->dofs; j++)
            trace += rb_sparse_diagonal(&s->K, j);
        const double force = rb_norm_inf((size_t)s->dofs, load);
        rb_fem_units u = {force > 0.0 ? force : 1.0, 1.0};
        if (trace > 0.0)
            u.length = u.force * s->dofs / trace;
        *units = u;
        /* f = F - K u, w = gap + H' u along the normals, both in their units. */
        const int d = s->dimension, rows = d * s->contacts;
        memcpy(problem->f, load, (size_t)s->dofs * sizeof *load);
        rb_sparse_apply(-1.0, &s->K, state->u, 1.0, problem->f);
        rb_sparse_apply_transposed(1.0, &s->H, state->u, 0.0, problem->w);
        for (int k = 0; k < rows; k++)
            problem->w[k] = k % d == 0 ? problem->w[k] + s->gap[k / d] : 0.0;
        memcpy(problem->mu, s->mu, (size_t)s->contacts * sizeof *s->mu);
        scale((size_t)s->dofs, 1.0 / units->force, problem->f);
        scale((size_t)rows, 1.0 / units->length, problem->w);
        scale((size_t)problem->K.p[s->dofs], units->length / units->force, problem->K.x);
    } else {
        rb_friction_problem_free(problem);
    }
    return status;
}
