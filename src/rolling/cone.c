/* The bridge to the cone solvers: a contact problem with given approach and creepage as
 * u = W r + q in the frame [N, T] of each element (theory.md 5). */
#include "rolling/internal.h"

#include <stdlib.h>
#include <string.h>

rb_status rb_rolling_cone_problem(const rb_rolling_problem *p, double delta, double xi,
                                  rb_friction_problem *cone, rb_message *why)
{
    const size_t n = (size_t)p->n, m = 2 * n;
    const double gap = p->stress / p->gap_length, slip = p->stress / p->slip_length;

    memset(cone, 0, sizeof *cone);
    cone->form = RB_FRICTION_LOCAL_DENSE;
    cone->dimension = 2;
    cone->contacts = p->n;
    cone->mu = rb_alloc(n, 1);
    cone->W = rb_alloc(m, m);
    cone->q = rb_alloc(m, 1);
    if (!cone->mu || !cone->W || !cone->q) {
        rb_friction_problem_free(cone);
        return rb_fail(why, RB_ENOMEM, "out of memory for a cone problem of %d contacts",
                       p->n);
    }
    for (size_t j = 0; j < m; j++) {
        const size_t column = 2 * (j % n) + j / n;
        for (size_t i = 0; i < n; i++) {
            cone->W[2 * i + column * m] = gap * p->F[i + j * (size_t)p->ldf];
            cone->W[2 * i + 1 + column * m] = slip * p->S[i + j * n];
        }
    }
    for (size_t i = 0; i < n; i++) {
        cone->mu[i] = p->mu;
        cone->q[2 * i] = (p->d_N[i] - delta) / p->gap_length;
        cone->q[2 * i + 1] = (p->d_T[i] + xi * p->e_T[i]) / p->slip_length;
    }
    return RB_OK;
}

rb_status rb_rolling_cone_solve(const rb_rolling_problem *p, const char *solver,
                                rb_rolling_state *state, rb_message *why)
{
    const size_t m = 2 * (size_t)p->n;
    rb_friction_problem cone;
    rb_friction_options options = rb_friction_defaults();
    rb_friction_info info;
    rb_status s = rb_rolling_cone_problem(p, state->delta, state->xi, &cone, why);

    if (s != RB_OK)
        return s;
    double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1);
    s = r && u ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        options.tol = 1e-12;
        s = rb_friction_solve(solver, &cone, &options, r, u, NULL, &info);
        if (s != RB_OK)
            rb_fail(why, s, "%s: %.240s", solver, info.msg.text);
        state->iterations += info.iters;
    }
    for (int i = 0; i < p->n && s >= 0; i++) {
        state->p[i] = p->stress * r[2 * i];
        state->q[i] = p->stress * r[2 * i + 1];
    }
    free(r);
    free(u);
    rb_friction_problem_free(&cone);
    return s;
}

rb_status rb_rolling_cone_write(const char *path, const rb_rolling_model *model,
                                rb_message *why)
{
    const rb_rolling_problem *p = &model->problem;
    const rb_rolling_state *state = &model->state;
    rb_friction_problem cone;

    if (!p->F)
        return rb_fail(why, RB_EINVAL, "%d elements are too many for a dense W", p->n);
    double *r = rb_alloc(2 * (size_t)p->n, 1);
    rb_status s = r ? rb_rolling_cone_problem(p, state->delta, state->xi, &cone, why)
                    : rb_fail(why, RB_ENOMEM, "out of memory for %d contacts", p->n);
    if (s == RB_OK) {
        for (int i = 0; i < p->n; i++) {
            r[2 * i] = state->p[i] / p->stress;
            r[2 * i + 1] = state->q[i] / p->stress;
        }
        s = rb_friction_write(path, &cone, r, NULL, NULL, "rolling contact by rollbem",
                              why);
        rb_friction_problem_free(&cone);
    }
    free(r);
    return s;
}
