/* Tractions that are given instead of solved for: where they begin, end and jump. */
#include "rolling/stress/field.h"
#include "rolling/solve/model.h"

#include <math.h>
#include <stdlib.h>

void rb_rolling_given_free(rb_rolling_given *given)
{
    if (!given)
        return;
    rb_arena_free(&given->memory);
    free(given);
}

/* One place, but for rounding. */
static int is_at(const rb_bem_edge_load *load, double place, double x)
{
    return fabs(x - place) <= 1e-12 * (load->x[load->n - 1] - load->x[0]);
}

double rb_rolling_next_friction_jump(const rb_rolling_model *model, int *k)
{
    const rb_bem_edge_load *load = model->given ? &model->given->load : NULL;
    for (; load && *k + 1 < load->n; ++*k)
        if (load->x[*k] == load->x[*k + 1] && load->q[*k] != load->q[*k + 1])
            return load->x[(*k)++];
    return NAN;
}

int rb_rolling_friction_jumps_at(const rb_rolling_model *model, double x)
{
    int k = 0;
    for (double at; !isnan(at = rb_rolling_next_friction_jump(model, &k));)
        if (is_at(&model->given->load, at, x))
            return 1;
    return 0;
}

void rb_rolling_given_on_jump(const rb_rolling_model *model, double x, double *sigma)
{
    const rb_bem_edge_load *load = &model->given->load;
    for (int k = 0; k + 1 < load->n; k++)
        if (load->x[k] == load->x[k + 1] && is_at(load, load->x[k], x)) {
            sigma[0] = load->q[k] != load->q[k + 1] ? NAN : sigma[0];
            sigma[1] = -0.5 * (load->p[k] + load->p[k + 1]);
            sigma[2] = -0.5 * (load->q[k] + load->q[k + 1]);
        }
}

/* The ends of what is loaded: of the given nodes, or of the patches. */
void rb_rolling_loaded_between(const rb_rolling_model *model, double *from, double *to)
{
    const rb_rolling_given *g = model->given;
    if (!g) {
        rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, from, to);
        return;
    }
    *from = g->load.x[0];
    *to = g->load.x[g->load.n - 1];
}
