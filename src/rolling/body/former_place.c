/* Where a particle was one step ago, when a step is not one element: between the
 * midpoints and beyond them. */
#include "rolling/body/former_place.h"
#include "rolling/body/internal.h"
#include "rolling/body/surface.h"

#include <cblas.h>
#include <string.h>

/* T rows of the bodies as half-planes: displacements at places from `first` on, h apart,
 * by tractions on n elements of length h, the first one's midpoint at 0.  Body B is
 * mirrored.  sum: places x 2n, added to. */
static rb_status add_halfplanes(const rb_rolling_case *rc, int n, double h, int places,
                                double first, double *sum)
{
    const size_t rows = (size_t)places, columns = 2 * (size_t)n;
    rb_arena scratch = {0};
    double *ends = rb_arena_doubles(&scratch, (size_t)n + 1, 1),
           *x = rb_arena_doubles(&scratch, rows, 1),
           *W = rb_arena_doubles(&scratch, 2 * rows, columns);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int i = 0; i <= n; i++)
        ends[i] = (i - 0.5) * h;
    for (int i = 0; i < places; i++)
        x[i] = first + i * h;
    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        double length[RB_ROLLING_TERMS];
        const rb_bem_surface surface = rb_rolling_surface_of(rc, b ? &rc->b : &rc->a, length);
        const rb_status s = rb_bem_surface_displacement(&surface, n, ends, places, x, W);

        if (s != RB_OK)
            return rb_arena_done(&scratch, s);
        for (size_t j = 0; j < columns; j++)
            cblas_daxpy(places, b && j < (size_t)n ? -1.0 : 1.0, W + rows + j * 2 * rows, 1,
                        sum + j * rows, 1);
    }
    return rb_arena_done(&scratch, RB_OK);
}

rb_status rb_rolling_former_place_create(const rb_rolling_case *rc, const rb_rolling_bodies *bodies,
                                         double step, rb_arena *memory,
                                         rb_rolling_former_place *ahead)
{
    const int n = bodies->f.n, m = bodies->f.m;
    const double h = bodies->f.h[n / 2];
    rb_arena scratch = {0};

    *ahead = (rb_rolling_former_place){.n = n};
    if (!bodies->F) { /* half-planes: only the distance of point and element counts */
        ahead->response = rb_arena_doubles(memory, 2 * (size_t)n - 1, 2);
        const rb_status s = ahead->response ? add_halfplanes(rc, 1, h, 2 * n - 1,
                                                             step - (n - 1) * h, ahead->response)
                                            : RB_ENOMEM;
        ahead->step = s == RB_OK ? step : 0.0;
        return s;
    }
    /* every pair of points and elements by its own */
    double *W_T = ahead->W_T = rb_arena_doubles(memory, (size_t)n, 2 * (size_t)n);
    double *rest = rb_arena_doubles(&scratch, (size_t)m, 2 * (size_t)n);
    rb_status s = W_T && rest ? add_halfplanes(rc, n, h, n, step, W_T) : RB_ENOMEM;
    if (s == RB_OK)
        s = add_halfplanes(rc, n, h, m, 0.0, rest);
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    for (size_t j = 0; j < 2 * (size_t)n; j++)
        for (size_t i = 0; i < (size_t)m; i++)
            rest[i + j * m] = bodies->F[(size_t)m + i + j * 2 * (size_t)m] - rest[i + j * m];
    /* What the bodies have over half-planes is smooth along the surface: linear in
     * between, at step / h elements from each of the m = n + 1 midpoints, the last one's
     * line going on. */
    for (int i = 0; i < n; i++) {
        const double place = i + step / h;
        const int before = place < n - 1 ? (int)place : n - 1;
        const double t = place - before;
        cblas_daxpy(2 * n, 1.0 - t, rest + before, m, W_T + i, n);
        cblas_daxpy(2 * n, t, rest + before + 1, m, W_T + i, n);
    }
    ahead->step = step;
    return rb_arena_done(&scratch, RB_OK);
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

/* Half-planes at the midpoints beyond the mesh, and what the bodies have over them at the
 * nearest midpoints of the mesh, continued on a line. */
rb_status rb_rolling_displacement_outside(const rb_rolling_case *rc,
                                          const rb_rolling_bodies *bodies, double *W_T)
{
    const int n = bodies->f.n, m = bodies->f.m, size = 2 * n;
    const double h = bodies->f.h[n / 2], weight[3] = {1.0, -2.0, 1.0};
    rb_arena scratch = {0};
    double *plane = rb_arena_doubles(&scratch, (size_t)size, 1);

    if (scratch.failed)
        return rb_arena_done(&scratch, RB_ENOMEM);
    for (int upstream = 0; upstream < 2; upstream++) {
        const int near = upstream ? n : 0, next = upstream ? n - 1 : 1,
                  at[3] = {upstream ? n + 1 : -1, near, next};
        double *row = W_T + upstream;

        for (int k = 0; k < (bodies->F ? 3 : 1); k++) {
            memset(plane, 0, (size_t)size * sizeof *plane);
            const rb_status s = add_halfplanes(rc, n, h, 1, at[k] * h, plane);
            if (s != RB_OK)
                return rb_arena_done(&scratch, s);
            cblas_daxpy(size, weight[k], plane, 1, row, 2);
        }
        if (bodies->F) {
            cblas_daxpy(size, 2.0, bodies->F + m + near, 2 * m, row, 2);
            cblas_daxpy(size, -1.0, bodies->F + m + next, 2 * m, row, 2);
        }
    }
    return rb_arena_done(&scratch, RB_OK);
}
