/* Body B as an upper body: its image in a mirror at y = 0. */
#include "rolling/stress/stress.h"

#include <stdlib.h>

rb_status rb_rolling_mirror_check(const rb_rolling_case *rc, rb_message *why)
{
    const rb_rolling_case image = {.a = rc->b, .plane = rc->plane};

    if (!rc->elastic_b)
        return rb_fail(why, RB_EINVAL,
                       "stress: B is rigid and has no stress; give --young-b or --similar");
    return rb_rolling_stress_check(&image, why);
}

/* The mirror keeps the pressure and turns the friction round, which acts on B against A's; mesh,
 * zones and the boundary elements of B, which are those of an upper body, stay as they are. */
rb_status rb_rolling_mirror_create(const rb_rolling_model *model, rb_rolling_mirror **mirror,
                                   rb_message *why)
{
    *mirror = NULL;
    const rb_status s = rb_rolling_mirror_check(model->rc, why);
    if (s != RB_OK)
        return s;
    const int n = model->state.n;
    rb_rolling_mirror *m = calloc(1, sizeof *m);
    const int nodes = model->given ? model->given->load.n : 0;
    double *q = rb_alloc((size_t)n + (size_t)nodes + 1, 1);
    if (!m || !q) {
        free(m);
        free(q);
        return rb_fail(why, RB_ENOMEM, "stress: out of memory for body B");
    }
    for (int i = 0; i < n; i++)
        q[i] = -model->state.q[i];
    for (int i = 0; i < nodes; i++)
        q[n + i] = -model->given->load.q[i];
    m->rc = *model->rc;
    m->rc.a = model->rc->b;
    m->rc.b = model->rc->a;
    m->rc.bulk_stress = model->rc->bulk_stress_b;
    m->rc.bulk_stress_b = model->rc->bulk_stress;
    if (m->rc.a.datum == 0.0) /* of a plane it would be A's; the stress does not depend on it */
        m->rc.a.datum = 1.0;
    m->model = *model;
    m->model.rc = &m->rc;
    m->model.state.q = m->q = q;
    if (nodes > 0) {
        m->given = (rb_rolling_given){.load = model->given->load};
        m->given.load.q = q + n;
        m->model.given = &m->given;
    }
    m->model.bodies.system_a = model->bodies.system_b;
    m->model.bodies.system_b = model->bodies.system_a;
    *mirror = m;
    return RB_OK;
}

void rb_rolling_mirror_free(rb_rolling_mirror *mirror)
{
    if (!mirror)
        return;
    free(mirror->q);
    free(mirror);
}

void rb_rolling_mirror_stress(int n, rb_rolling_stress *at, rb_rolling_stress_maxima *maxima)
{
    for (int k = 0; k < n; k++) {
        at[k].y = 0.0 - at[k].y; /* no -0 on the surface */
        at[k].sxy = 0.0 - at[k].sxy;
    }
    for (int k = 0; maxima && rb_rolling_maximum(maxima, k); k++) {
        rb_rolling_extremum *m = rb_rolling_maximum(maxima, k);
        m->y = 0.0 - m->y;
    }
}

void rb_rolling_mirror_grid(rb_rolling_stress_grid *grid)
{
    rb_rolling_mirror_stress(grid->nx * grid->ny, grid->at, NULL);
    for (int j = 0; j < grid->ny / 2; j++)
        for (int i = 0; i < grid->nx; i++) {
            const int k = j * grid->nx + i, l = (grid->ny - 1 - j) * grid->nx + i;
            const rb_rolling_stress at = grid->at[k];
            const int inside = grid->inside[k];
            grid->at[k] = grid->at[l];
            grid->at[l] = at;
            grid->inside[k] = grid->inside[l];
            grid->inside[l] = inside;
        }
}

rb_status rb_rolling_stress_maxima_of_b(const rb_rolling_model *model, double depth,
                                        rb_rolling_stress_maxima *maxima, rb_message *why)
{
    rb_rolling_mirror *mirror;
    rb_status s = rb_rolling_mirror_create(model, &mirror, why);
    if (s == RB_OK)
        s = rb_rolling_stress_maxima_find(&mirror->model, depth, maxima, why);
    if (s == RB_OK)
        rb_rolling_mirror_stress(0, NULL, maxima);
    rb_rolling_mirror_free(mirror);
    return s;
}
