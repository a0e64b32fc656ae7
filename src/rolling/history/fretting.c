/* Follows what fretting does to each element of the surfaces in one cycle of a history at rest:
 * work of friction, slip, stress and strain at the surface (Q1). */
#include "lcp/contact/contact.h"
#include "rolling/body/body.h"
#include "rolling/case/derived.h"
#include "rolling/history/internal.h"
#include "rolling/stress/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The strain along x of a stress that has no other part but those in the plane. */
static double strain_of(const rb_bem_material *m, const rb_rolling_stress *at)
{
    return ((1.0 - m->poisson) * at->sxx - m->poisson * at->syy) / (2.0 * m->shear);
}

/* The stress at the surface of a body, A of the model, under its present tractions.  The places
 * beside the elements are the edges of the first state that is seen. */
static rb_status see_surface(rb_rolling_cycle *c, int body, const rb_rolling_model *model,
                             rb_message *why)
{
    const int places = c->n + 2;
    const rb_bem_material m = rb_rolling_material(model->rc, &model->rc->a);
    double *const tension = rb_rolling_cycle_extreme(c, body, RB_CYCLE_TENSION),
                  *least = rb_rolling_cycle_extreme(c, body, RB_CYCLE_LEAST_STRAIN),
                  *most = rb_rolling_cycle_extreme(c, body, RB_CYCLE_MOST_STRAIN),
                  *shear = rb_rolling_cycle_extreme(c, body, RB_CYCLE_SHEAR);
    rb_arena scratch = {0};
    double *xy = rb_arena_doubles(&scratch, (size_t)places, 2);
    rb_rolling_stress *at = rb_arena_zeros(&scratch, (size_t)places, sizeof *at);
    rb_rolling_field *field = NULL;
    rb_status s = scratch.failed ? RB_ENOMEM : rb_rolling_field_create(model, &field, why);

    if (s == RB_OK && isnan(c->edge[0])) {
        const rb_bem_edge_load *load = rb_rolling_field_load(field);
        c->edge[0] = load->x[0];
        c->edge[1] = load->x[load->n - 1];
    }
    for (int k = 0; k < places && s == RB_OK; k++) {
        xy[2 * k] = k < c->n ? model->bodies.f.x[k] : c->edge[k - c->n];
        xy[2 * k + 1] = rb_rolling_surface(model->rc, xy[2 * k]);
    }
    if (s == RB_OK)
        s = rb_rolling_field_at(field, places, xy, at, why);
    for (int k = 0; k < places && s == RB_OK; k++) {
        const double strain = strain_of(&m, &at[k]);
        tension[k] = fmax(tension[k], at[k].sxx);
        least[k] = fmin(least[k], strain);
        most[k] = fmax(most[k], strain);
        shear[k] = fmax(shear[k], at[k].tresca_shear);
    }
    rb_rolling_field_free(field);
    return rb_arena_done(&scratch, s);
}

static rb_status see_bodies(const rb_rolling_model *model, rb_message *why)
{
    rb_rolling_cycle *c = model->cycle;
    rb_rolling_mirror *mirror = NULL;
    rb_status s = see_surface(c, 0, model, why);

    if (s == RB_OK && c->bodies > 1) {
        s = rb_rolling_mirror_create(model, &mirror, why);
        if (s == RB_OK)
            s = see_surface(c, 1, &mirror->model, why);
        rb_rolling_mirror_free(mirror);
    }
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for a cycle") : s;
}

rb_status rb_rolling_cycle_begin(rb_rolling_model *model, rb_message *why)
{
    const size_t n = (size_t)model->mesh.n;
    rb_rolling_cycle *c = calloc(1, sizeof *c);

    rb_rolling_cycle_free(model->cycle);
    model->cycle = c;
    if (!c)
        return rb_fail(why, RB_ENOMEM, "out of memory for a cycle");
    *c =
        (rb_rolling_cycle){.n = (int)n, .bodies = model->rc->elastic_b ? 2 : 1, .edge = {NAN, NAN}};
    c->sums = rb_arena_doubles(&c->memory, n, RB_CYCLE_SUMS);
    c->kept = rb_arena_doubles(&c->memory, n, RB_CYCLE_SUMS);
    c->extreme = rb_arena_doubles(&c->memory, n + 2, (size_t)c->bodies * RB_CYCLE_EXTREMES);
    c->q = rb_arena_doubles(&c->memory, n, 1);
    if (c->memory.failed)
        return rb_fail(why, RB_ENOMEM, "out of memory for a cycle");
    memset(c->kept, 0, n * RB_CYCLE_SUMS * sizeof *c->kept);
    memcpy(c->q, model->state.q, n * sizeof *c->q);
    for (size_t i = 0; i < n; i++)
        c->kept[RB_CYCLE_FRICTION * n + i] = fabs(c->q[i]);
    rb_rolling_cycle_begin_row(c);
    for (int b = 0; b < c->bodies; b++)
        for (int which = 0; which < RB_CYCLE_EXTREMES; which++)
            for (size_t k = 0; k < n + 2; k++)
                rb_rolling_cycle_extreme(c, b, which)[k] =
                    which == RB_CYCLE_LEAST_STRAIN ? INFINITY : -INFINITY;
    return see_bodies(model, why);
}

void rb_rolling_cycle_begin_row(rb_rolling_cycle *c)
{
    if (c)
        memcpy(c->sums, c->kept, (size_t)c->n * RB_CYCLE_SUMS * sizeof *c->kept);
}

void rb_rolling_cycle_step(const rb_rolling_model *model)
{
    const rb_rolling_cycle *c = model->cycle;
    const rb_contact_state *state = &model->state;

    for (int i = 0; c && !c->is_over && i < c->n; i++) {
        const double slip = state->zone[i] > RB_ZONE_STICK ? state->lambda[i] : 0.0;
        double *const at = c->sums + i;
        const size_t n = (size_t)c->n;
        at[RB_CYCLE_WORK * n] -= state->q[i] * slip;
        at[RB_CYCLE_SLIP * n] += slip;
        at[RB_CYCLE_LEAST_SLIP * n] = fmin(at[RB_CYCLE_LEAST_SLIP * n], at[RB_CYCLE_SLIP * n]);
        at[RB_CYCLE_MOST_SLIP * n] = fmax(at[RB_CYCLE_MOST_SLIP * n], at[RB_CYCLE_SLIP * n]);
        at[RB_CYCLE_FRICTION * n] = fmax(at[RB_CYCLE_FRICTION * n], fabs(state->q[i]));
    }
}

rb_status rb_rolling_cycle_end_row(const rb_rolling_model *model, rb_message *why)
{
    const rb_rolling_cycle *c = model->cycle;

    if (!c)
        return RB_OK;
    memcpy(c->kept, c->sums, (size_t)c->n * RB_CYCLE_SUMS * sizeof *c->kept);
    return see_bodies(model, why);
}

void rb_rolling_cycle_end(rb_rolling_model *model)
{
    if (model->cycle)
        model->cycle->is_over = 1;
}

double rb_rolling_cycle_misses(const rb_rolling_model *model)
{
    const rb_rolling_cycle *c = model->cycle;
    const double mu = rb_rolling_largest_mu(model->rc),
                 p0 = rb_norm_inf((size_t)c->n, model->state.p);
    double most = 0.0;

    for (int i = 0; i < c->n; i++)
        most = fmax(most, fabs(model->state.q[i] - c->q[i]));
    return most > 0.0 ? most / (mu * p0) : 0.0;
}
