/* Creep curves: one mesh and one factorisation for all creepages (theory.md 4.6). */
#include "rolling/internal.h"

#include <cblas.h>
#include <string.h>

/* Shift of a contact edge, in half-widths, beyond which a fitted mesh is fitted again. */
static const double REFIT = 0.01;

void rb_rolling_curve_free(rb_rolling_curve *c)
{
    rb_rolling_columns_free(&rb_rolling_curve_columns, c);
    memset(c, 0, sizeof *c);
}

static void record(const rb_rolling_model *model, rb_rolling_curve *c)
{
    const rb_rolling_problem *p = &model->problem;
    const rb_rolling_state *state = &model->state;
    const double P = rb_rolling_model_load(model), Q = rb_rolling_model_force(model);
    const double mu = p->mu;
    const int k = c->n++;
    double contact, stick;
    const double longest =
        rb_rolling_longest_element(p->n, state->zone, model->bodies.f.h);

    rb_rolling_zone_lengths(p->n, state->zone, model->bodies.f.h, &contact, &stick);
    c->creepage[k] = state->xi;
    c->creep_ratio[k] =
        mu > 0.0 ? state->xi * rb_rolling_radius(&model->rc) / (mu * model->half_width)
                 : NAN;
    c->normal_load[k] = P;
    c->tangential_load[k] = Q;
    c->force_ratio[k] = mu > 0.0 ? Q / (mu * P) : NAN;
    c->stick_ratio[k] = contact > 0.0 ? stick / contact : 0.0;
    if (contact > 0.0)
        c->stick_step = fmax(c->stick_step, longest / contact);
    c->dissipation[k] = rb_rolling_dissipated_power(&model->rc, p->n, state->lambda,
                                                    state->q, model->bodies.f.h, p->e_T);
    c->residual[k] = state->residual;
    c->half_width = model->half_width;
}

/* The whole search for the contact again. */
static rb_status start_anew(rb_rolling_model *model, rb_message *why)
{
    const rb_rolling_case rc = model->rc;
    const int iterations = model->iterations;

    rb_rolling_model_free(model);
    const rb_status s = rb_rolling_model_create(&rc, model, why);
    model->iterations += iterations;
    return s;
}

/* A fitted mesh whose contact has moved is fitted again; a potential contact that is
 * full is chosen anew. */
static rb_status follow_contact(rb_rolling_model *model, int fills, double edge[2],
                                rb_message *why)
{
    double from, to;

    rb_rolling_contact_edges(&model->rc, &model->mesh, &model->state, &from, &to);
    const double moved =
        fmax(fabs(from - edge[0]), fabs(to - edge[1])) / (0.5 * (edge[1] - edge[0]));
    if (!fills && !(model->rc.mesh != RB_MESH_UNIFORM && moved > REFIT))
        return RB_OK;
    const rb_status s = fills ? start_anew(model, why)
                        : model->rc.mesh == RB_MESH_ALIGNED
                            ? rb_rolling_model_realign(model, why)
                            : rb_rolling_model_refit(model, why);
    if (s == RB_OK)
        rb_rolling_contact_edges(&model->rc, &model->mesh, &model->state, &edge[0],
                                 &edge[1]);
    return s;
}

static void set_creepage(int over_creep, double value, rb_rolling_case *rc)
{
    rc->creep = over_creep ? value : NAN;
    rc->creep_ratio = over_creep ? NAN : value;
}

static rb_status all_points(rb_rolling_model *model, int over_creep, double from,
                            double to, int points, rb_rolling_curve *c, rb_message *why)
{
    double edge[2];
    rb_status s = RB_OK;

    rb_rolling_contact_edges(&model->rc, &model->mesh, &model->state, &edge[0], &edge[1]);
    for (int k = 0; k < points && s == RB_OK; k++) {
        const double t = points > 1 ? (double)k / (points - 1) : 0.0;
        set_creepage(over_creep, from + t * (to - from), &model->rc);
        s = rb_rolling_model_control(model, why);
        if (s == RB_OK || s == RB_ZONE)
            s = follow_contact(model, s == RB_ZONE, edge, why);
        if (s >= 0)
            record(model, c);
    }
    return s;
}

static rb_status check_curve(const rb_rolling_case *rc, int over_creep, double from,
                             double to, int points, rb_message *why)
{
    if (!isfinite(from) || !isfinite(to))
        return rb_fail(why, RB_EINVAL, "curve: from %g to %g: expected finite numbers",
                       from, to);
    if (points < 1 || points > 1000000)
        return rb_fail(why, RB_EINVAL, "points: expected 1 ... 1000000, got %d", points);
    if (!over_creep && rc->mu == 0.0)
        return rb_fail(why, RB_EINVAL,
                       "curve: xi R/(mu a) has no meaning at mu = 0; give creepages");
    return RB_OK;
}

rb_status rb_rolling_curve_solve(const rb_rolling_case *rc, int over_creep, double from,
                                 double to, int points, rb_rolling_curve *curve,
                                 rb_message *why)
{
    const double start = rb_seconds();
    rb_rolling_case steady = *rc;
    rb_rolling_model model = {0};
    rb_status s = check_curve(rc, over_creep, from, to, points, why);

    memset(curve, 0, sizeof *curve);
    curve->free_creepage = NAN;
    steady.formulation = RB_STEADY;
    steady.shift = steady.force = steady.force_ratio = NAN;
    set_creepage(over_creep, from, &steady);
    if (s == RB_OK)
        s = rb_rolling_columns_alloc(&rb_rolling_curve_columns, points, curve);
    if (s == RB_OK)
        s = rb_rolling_model_create(&steady, &model, why);
    if (s == RB_OK)
        s = all_points(&model, over_creep, from, to, points, curve, why);
    if (s == RB_OK && rc->mu > 0.0)
        s = rb_rolling_free_creepage_if_any(&model, &curve->free_creepage, why);
    curve->iterations = model.iterations;
    curve->seconds = rb_seconds() - start;
    rb_rolling_model_free(&model);
    return s;
}
