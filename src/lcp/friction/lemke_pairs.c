/* Plane problems with W as the linear complementarity problem of Stewart and Trinkle
 * (1996), order 4 n_c: r_T = r+ - r-, and lambda, the speed of the slip, u_N = W r + q >=
 * 0,  with r_N, u_T + lambda       >= 0,             with r+, -u_T + lambda      >= 0,
 * with r-, mu r_N - r+ - r-   >= 0,             with lambda. For W = H' K^-1 H, q = w +
 * H' K^-1 f its matrix is copositive, and each z that solves the problem with q = 0 has
 * z'q = 0 as long as no forces without effect, H r = 0, do work on w.  So Lemke's path
 * cannot end on a ray, however many contacts are redundant.  In the form of order 3 n_c
 * (lemke.c) z = (0, 0, u-) solves the problem with q = 0, and u-'q_T may be negative: its
 * path can end on a ray or wander through thousands of pivots. */
#include "lcp/friction/internal.h"
#include "lcp/lcp.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>

static void add_entry(rb_triplets *t, int row, int col, double x)
{
    if (x != 0.0)
        rb_triplets_add(t, row, col, x);
}

/* A pivot solves with the LU of a part of M and applies a hundred exchanges or so. */
double rb_friction_lemke_pairs_flops(const rb_friction_task *task, double pivots)
{
    const rb_friction_problem *w = task->shared->local;
    const double m = task->m;
    const double entries = w->form == RB_FRICTION_LOCAL_SPARSE ? w->Ws.p[task->m] : m * m;
    return pivots * (4.5 * entries + 100.0 * m);
}

rb_status rb_friction_lemke_pairs(rb_friction_task *task)
{
    const rb_friction_problem *local = task->shared->local;
    const int nc = task->contacts, left = rb_friction_task_left(task, INT_MAX);
    const rb_friction_blocks *w;
    rb_lcp_options opt = rb_lcp_defaults();
    rb_lcp_info info = {0};
    rb_sparse M = {0};
    rb_status s = rb_friction_task_blocks(task, &w);
    if (s != RB_OK || !left)
        return s != RB_OK ? s : RB_MAXITER;
    double *q = rb_alloc(4 * (size_t)nc, 2), *z = q ? q + 4 * (size_t)nc : NULL;
    /* W in the given units, in which the cover of ones opens all contacts at one speed, and
     * its mean diagonal: with W and q divided by it all unknowns but lambda are forces. */
    const double *D = task->shared->scaling.unit;
    double sum = 0.0;
    for (int c = 0; c < w->contacts; c++) {
        const double *x = w->x + 4 * (size_t)w->diag[c];
        sum += (fabs(x[0]) + fabs(x[3])) / (D ? D[c] * D[c] : 1.0);
    }
    const double unit = sum > 0.0 ? sum / (2.0 * w->contacts) : 1.0;
    static const double sign[] = {1.0, 1.0, -1.0};
    rb_triplets t = {.rows = 4 * nc, .cols = 4 * nc};
    for (int c = 0; c < nc; c++) {
        for (int k = w->p[c]; k < w->p[c + 1]; k++) {
            const double by = unit * (D ? D[c] * D[w->i[k]] : 1.0);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) {
                    const double x = w->x[4 * (size_t)k + (a > 0) + 2 * (b > 0)];
                    add_entry(&t, a * nc + w->i[k], b * nc + c, sign[a] * sign[b] * x / by);
                }
        }
        add_entry(&t, nc + c, 3 * nc + c, 1.0);
        add_entry(&t, 2 * nc + c, 3 * nc + c, 1.0);
        add_entry(&t, 3 * nc + c, c, local->mu[c]);
        add_entry(&t, 3 * nc + c, nc + c, -1.0);
        add_entry(&t, 3 * nc + c, 2 * nc + c, -1.0);
    }
    s = q ? rb_sparse_from_triplets(&t, &M) : RB_ENOMEM;
    rb_triplets_free(&t);
    for (int c = 0; s == RB_OK && c < nc; c++) {
        const double by = unit * (D ? D[c] : 1.0);
        q[c] = local->q[2 * c] / by;
        q[nc + c] = local->q[2 * c + 1] / by;
        q[2 * nc + c] = -q[nc + c];
        q[3 * nc + c] = 0.0;
    }
    opt.max_iters = left < INT_MAX ? left : 0;
    opt.seconds = task->deadline > 0.0 ? fmax(task->deadline - rb_seconds(), 1e-9) : 0.0;
    if (s == RB_OK) {
        s = rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = q}, &opt, z, &info);
        task->info->iters += info.iters;
        task->info->flops += rb_friction_lemke_pairs_flops(task, info.iters);
    }
    if (s == RB_OK) {
        for (int c = 0; c < nc; c++) {
            const double limit = task->problem->mu[c] * z[c];
            task->r[2 * c] = z[c];
            task->r[2 * c + 1] = fmin(fmax(z[nc + c] - z[2 * nc + c], -limit), limit);
        }
        rb_friction_scale(&task->shared->scaling, task->r, NULL);
        if (!rb_friction_task_accepts(task, rb_friction_task_error(task)))
            s = RB_INACCURATE;
    }
    rb_sparse_free(&M);
    free(q);
    return s;
}
