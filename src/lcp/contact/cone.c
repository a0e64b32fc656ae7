/* The bridge to the cone solvers of the caller: a contact problem with given approach and
 * creepage as u = W r + q in the frame [N, T] of each element (theory-solvers.md 5). */
#include "lcp/contact/internal.h"

#include <stdlib.h>
#include <string.h>

void rb_contact_cone_free(rb_contact_cone *cone)
{
    free(cone->mu);
    free(cone->W);
    free(cone->q);
    memset(cone, 0, sizeof *cone);
}

rb_status rb_contact_cone_create(const rb_contact_problem *p, double delta, double xi,
                                 rb_contact_cone *cone, rb_message *why)
{
    const size_t n = (size_t)p->n, m = 2 * n;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    const double gap = p->stress / p->gap_length, slip = p->stress / p->slip_length;

    *cone = (rb_contact_cone){.n = p->n};
    if (!K.F)
        return rb_fail(why, RB_EINVAL, "%d elements are too many for a dense W", p->n);
    cone->mu = rb_alloc(n, 1);
    cone->W = rb_alloc(m, m);
    cone->q = rb_alloc(m, 1);
    if (!cone->mu || !cone->W || !cone->q) {
        rb_contact_cone_free(cone);
        return rb_fail(why, RB_ENOMEM, "out of memory for a cone problem of %d contacts", p->n);
    }
    /* Blocks [N; T] of all elements become pairs [N, T] of each. */
    for (size_t j = 0; j < m; j++) {
        const size_t column = 2 * (j % n) + j / n;
        for (size_t i = 0; i < n; i++) {
            cone->W[2 * i + column * m] = gap * K.F[i + j * (size_t)K.ldf];
            cone->W[2 * i + 1 + column * m] = slip * K.S[i + j * n];
        }
    }
    for (size_t i = 0; i < n; i++) {
        cone->mu[i] = p->bound[i];
        cone->q[2 * i] = (p->d_N[i] - delta) / p->gap_length;
        cone->q[2 * i + 1] = (p->d_T[i] + xi * p->e_T[i]) / p->slip_length;
    }
    return RB_OK;
}

rb_status rb_contact_cone_solve(const rb_contact_problem *p, const rb_contact_options *options,
                                rb_contact_state *state, rb_message *why)
{
    const rb_contact_cone_solver *by = &options->cone_solver;
    rb_contact_cone cone;

    if (!by->solve)
        return rb_fail(why, RB_EINVAL, "there is no cone solver '%.60s'", by->name ? by->name : "");
    rb_status s = rb_contact_cone_create(p, state->delta, state->xi, &cone, why);
    if (s != RB_OK)
        return s;
    double *r = rb_alloc(2 * (size_t)p->n, 1);
    s = r ? by->solve(by->name, &cone, 1e-12, r, &state->iterations, why) : RB_ENOMEM;
    for (int i = 0; i < p->n && s >= 0; i++) {
        state->p[i] = p->stress * r[2 * i];
        state->q[i] = p->stress * r[2 * i + 1];
    }
    free(r);
    rb_contact_cone_free(&cone);
    return s;
}
