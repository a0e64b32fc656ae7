/* A structure that may touch obstacles, and its state. */
#include "rollbem/fem.h"

#include <lapacke.h>
#include <math.h>
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

static void spread(const rb_sparse *K, double *dense)
{
    for (int j = 0; j < K->cols; j++)
        for (int k = K->p[j]; k < K->p[j + 1]; k++)
            dense[K->i[k] + (size_t)K->rows * (size_t)j] = K->x[k];
}

rb_status rb_fem_nullity(const rb_sparse *K, int *nullity, double *largest)
{
    const int n = K->rows;
    double *dense = rb_alloc((size_t)n, (size_t)n), *value = rb_alloc((size_t)n, 1);
    rb_status s = dense && value ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        spread(K, dense);
        const int info = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'N', 'U', n, dense, n, value);
        s = info > 0 ? RB_MAXITER : rb_lapack_status(info);
    }
    if (s == RB_OK) {
        *nullity = 0;
        for (int k = 0; k < n; k++)
            *nullity += fabs(value[k]) <= 1e-12 * value[n - 1];
        if (largest)
            *largest = value[n - 1];
    }
    free(dense);
    free(value);
    return s;
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
