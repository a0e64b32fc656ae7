/* Where a particle was one step ago, when a step is not one element: between the
 * midpoints and beyond them. */
#include "rolling/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* n elements of length h, the first one's midpoint at 0, seen from places s. */
typedef struct {
    int n;
    double h;
    int places;
    double *s;
} line;

/* T rows of the half-plane with a body's elasticity.  sum: places x 2n, added to;
 * coupling: -1 for body B, which is mirrored. */
static rb_status add_halfplane(const rb_rolling_case *rc, const rb_rolling_body *body,
                               double coupling, const line *of, double *sum)
{
    const int n = of->n;
    const size_t rows = (size_t)of->places, columns = 2 * (size_t)n;
    double length[RB_ROLLING_TERMS];
    const rb_bem_surface surface = rb_rolling_surface_of(rc, body, length);
    double *ends = rb_alloc((size_t)n + 1, 1), *W = rb_alloc(2 * rows, columns);
    rb_status status = ends && W ? RB_OK : RB_ENOMEM;

    for (int i = 0; i <= n && status == RB_OK; i++)
        ends[i] = (i - 0.5) * of->h;
    if (status == RB_OK)
        status = rb_bem_surface_displacement(&surface, n, ends, of->places, of->s, W);
    for (size_t j = 0; j < columns && status == RB_OK; j++)
        cblas_daxpy(of->places, j < (size_t)n ? coupling : 1.0, W + rows + j * 2 * rows, 1,
                    sum + j * rows, 1);
    free(ends);
    free(W);
    return status;
}

/* Of all elastic bodies, at places from `first` on, h apart; sum: overwritten. */
static rb_status halfplanes(const rb_rolling_case *rc, int n, double h, int places, double first,
                            double *sum)
{
    const line of = {n, h, places, rb_alloc((size_t)places, 1)};
    rb_status status = of.s ? RB_OK : RB_ENOMEM;

    for (int i = 0; i < places && status == RB_OK; i++)
        of.s[i] = first + i * h;
    if (status == RB_OK)
        status = add_halfplane(rc, &rc->a, 1.0, &of, sum);
    if (status == RB_OK && rc->elastic_b)
        status = add_halfplane(rc, &rc->b, -1.0, &of, sum);
    free(of.s);
    return status;
}

rb_status rb_rolling_former_place_create(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                                         double step, rb_rolling_former_place *ahead)
{
    const int n = bodies->f.n, m = bodies->f.m;
    const double h = bodies->f.h[n / 2];
    rb_status s = RB_ENOMEM;

    *ahead = (rb_rolling_former_place){.n = n, .step = step};
    if (bodies->F) { /* every pair of points and elements by its own */
        double *W_T = ahead->W_T = rb_alloc((size_t)n, 2 * (size_t)n);
        double *rest = rb_alloc((size_t)m, 2 * (size_t)n);
        s = W_T && rest ? halfplanes(rc, n, h, n, step, W_T) : RB_ENOMEM;
        if (s == RB_OK)
            s = halfplanes(rc, n, h, m, 0.0, rest);
        for (size_t j = 0; j < 2 * (size_t)n && s == RB_OK; j++)
            for (size_t i = 0; i < (size_t)m; i++)
                rest[i + j * m] = bodies->F[(size_t)m + i + j * 2 * (size_t)m] - rest[i + j * m];
        /* What the bodies have over half-planes is smooth along the surface: linear in
         * between, at step / h elements from each of the m = n + 1 midpoints, the last
         * one's line going on. */
        for (int i = 0; i < n && s == RB_OK; i++) {
            const double place = i + step / h;
            const int before = place < n - 1 ? (int)place : n - 1;
            const double t = place - before;
            cblas_daxpy(2 * n, 1.0 - t, rest + before, m, W_T + i, n);
            cblas_daxpy(2 * n, t, rest + before + 1, m, W_T + i, n);
        }
        free(rest);
    } else {
        /* half-planes: only the distance of point and element counts */
        ahead->response = rb_alloc(2 * (size_t)n - 1, 2);
        if (ahead->response)
            s = halfplanes(rc, 1, h, 2 * n - 1, step - (n - 1) * h, ahead->response);
    }
    if (s != RB_OK)
        rb_rolling_former_place_free(ahead);
    return s;
}

void rb_rolling_former_place_apply(const rb_rolling_former_place *ahead,
                                   const rb_rolling_bodies *bodies, const double *p,
                                   const double *q, double *w_T)
{
    const int n = ahead->n;

    memcpy(w_T, bodies->f.w0 + n + 1, (size_t)n * sizeof *w_T);
    for (int j = 0; j < n; j++) {
        const size_t at = (size_t)j * (size_t)n;
        const double *of_p = ahead->W_T ? ahead->W_T + at : ahead->response + n - 1 - j;
        const double *of_q = of_p + (ahead->W_T ? (size_t)n * (size_t)n : 2 * (size_t)n - 1);
        if (p[j] != 0.0)
            cblas_daxpy(n, p[j], of_p, 1, w_T, 1);
        if (q[j] != 0.0)
            cblas_daxpy(n, q[j], of_q, 1, w_T, 1);
    }
    if (ahead->response && bodies->f.compliance) {
        /* What the interface yields `step` ahead of each midpoint, linear in between, as
         * F has it where there is one; nothing beyond the last element. */
        const double *own = bodies->f.compliance + bodies->f.n,
                     elements = ahead->step / bodies->f.h[bodies->f.n / 2];

        for (int i = 0; i < bodies->f.n; i++) {
            const int before = (int)(i + elements);
            const double t = i + elements - before;
            if (before < bodies->f.n)
                w_T[i] += (1.0 - t) * own[before] * q[before];
            if (before + 1 < bodies->f.n)
                w_T[i] += t * own[before + 1] * q[before + 1];
        }
    }
}

void rb_rolling_former_place_free(rb_rolling_former_place *ahead)
{
    free(ahead->W_T);
    free(ahead->response);
    memset(ahead, 0, sizeof *ahead);
}

/* One row of W_T, upstream of the contact where `upstream` is 1: half-planes at a
 * midpoint beyond the mesh, and what the bodies have over them at the nearest midpoints
 * of the mesh, continued on a line. */
static rb_status add_outside(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                             int upstream, double *W_T)
{
    const int n = bodies->f.n, m = bodies->f.m, near = upstream ? n : 0,
              next = upstream ? n - 1 : 1, at[3] = {upstream ? n + 1 : -1, near, next};
    const double h = bodies->f.h[n / 2], weight[3] = {1.0, -2.0, 1.0};
    double *plane = rb_alloc(2 * (size_t)n, 1), *row = W_T + upstream;
    rb_status s = plane ? RB_OK : RB_ENOMEM;

    for (int k = 0; k < (bodies->F ? 3 : 1) && s == RB_OK; k++) {
        memset(plane, 0, 2 * (size_t)n * sizeof *plane);
        s = halfplanes(rc, n, h, 1, at[k] * h, plane);
        cblas_daxpy(2 * n, weight[k], plane, 1, row, 2);
    }
    if (s == RB_OK && bodies->F) {
        cblas_daxpy(2 * n, 2.0, bodies->F + m + near, 2 * m, row, 2);
        cblas_daxpy(2 * n, -1.0, bodies->F + m + next, 2 * m, row, 2);
    }
    free(plane);
    return s;
}

rb_status rb_rolling_displacement_outside(const rb_rolling_case *rc,
                                          const rb_rolling_bodies *bodies, double *W_T)
{
    const rb_status s = add_outside(rc, bodies, 0, W_T);
    return s == RB_OK ? add_outside(rc, bodies, 1, W_T) : s;
}
