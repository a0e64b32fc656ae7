/* A model of tractions that are given, on which no contact is solved. */
#include "rolling/body/body.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/model.h"
#include "rolling/stress/stress.h"
#include "rolling/study/study.h"

#include <math.h>
#include <stdlib.h>

/* Resultants, largest traction and half-width.  The integrals are exact, since the tractions are
 * linear between nodes. */
static void set_totals(const rb_bem_edge_load *load, rb_rolling_solution *s)
{
    double most_p = 0.0, most_q = 0.0;
    for (int k = 0; k < load->n; k++) {
        most_p = fmax(most_p, fabs(load->p[k]));
        most_q = fmax(most_q, fabs(load->q[k]));
    }
    for (int k = 0; k + 1 < load->n; k++) {
        const double h = load->x[k + 1] - load->x[k], p0 = load->p[k], p1 = load->p[k + 1];
        s->normal_load += 0.5 * h * (p0 + p1);
        s->tangential_load += 0.5 * h * (load->q[k] + load->q[k + 1]);
        s->resistance_moment +=
            h / 6.0 *
            (p0 * (2.0 * load->x[k] + load->x[k + 1]) + p1 * (load->x[k] + 2.0 * load->x[k + 1]));
    }
    s->max_pressure = most_p > 0.0 ? most_p : most_q;
    s->half_width = 0.5 * (load->x[load->n - 1] - load->x[0]);
    s->contact_from = load->x[0];
    s->contact_to = load->x[load->n - 1];
}

/* A model with n elements and no body. */
static rb_status begin_given(const rb_rolling_case *rc, int n, rb_rolling_model *model,
                             rb_rolling_solution *s, rb_message *why)
{
    *model = (rb_rolling_model){.rc = NULL};
    *s = rb_rolling_no_row(RB_OK).solution; /* what no contact has is not there */
    s->normal_load = s->tangential_load = s->resistance_moment = s->max_pressure = 0.0;
    rb_status status = rb_rolling_stress_check(rc, why);
    if (status == RB_OK && !rb_rolling_body_can(&rc->a, RB_BODY_FLAT))
        status = rb_fail(why, RB_EINVAL,
                         "tractions: of a half-plane, or of a layer on one; a wheel is not flat: "
                         "take --support halfplane");
    if (status == RB_OK)
        status = rb_rolling_model_set_case(model, rc, why);
    if (status == RB_OK)
        status = rb_contact_state_alloc(n, &model->state);
    if (status != RB_OK)
        return status;
    model->mesh = (rb_rolling_mesh){.n = n, .ends = rb_alloc((size_t)n + 2, 1)};
    return model->mesh.ends ? RB_OK : RB_ENOMEM;
}

/* The rows, and where the outermost ones are not zero a second node of zero at their place: the
 * tractions jump there. */
static rb_status set_nodes(int n, const double *x, const double *p, const double *q,
                           rb_rolling_given *g)
{
    double *to = rb_arena_doubles(&g->memory, (size_t)n + 2, 3);
    if (!to)
        return RB_ENOMEM;
    double *to_p = to + n + 2, *to_q = to_p + n + 2;
    int m = 0;
    for (int k = -1; k <= n; k++) {
        const int is_row = k >= 0 && k < n, i = k < 0 ? 0 : k < n ? k : n - 1;
        if (!is_row && p[i] == 0.0 && q[i] == 0.0)
            continue;
        to[m] = x[i];
        to_p[m] = is_row ? p[i] : 0.0;
        to_q[m++] = is_row ? q[i] : 0.0;
    }
    g->load = (rb_bem_edge_load){m, to, to_p, to_q};
    return RB_OK;
}

rb_status rb_rolling_model_of_nodes(const rb_rolling_case *rc, int n, const double *x,
                                    const double *p, const double *q, rb_rolling_model *model,
                                    rb_rolling_solution *s, rb_message *why)
{
    for (int k = 1; k < n; k++)
        if (!(x[k] >= x[k - 1]) || (k > 1 && x[k] == x[k - 2]))
            return rb_fail(why, RB_EFORMAT,
                           "x = %g mm: x has to increase from row to row, and two rows at most, a "
                           "jump, may have the same",
                           x[k]);
    if (n < 2 || !(x[n - 1] > x[0]))
        return rb_fail(why, RB_EFORMAT, "tractions need two rows at different places");
    rb_status status = begin_given(rc, n - 1, model, s, why);
    if (status != RB_OK)
        return status;
    model->given = calloc(1, sizeof *model->given);
    if (!model->given || set_nodes(n, x, p, q, model->given) != RB_OK)
        return RB_ENOMEM;
    /* patches are looked for in elements: those between the rows */
    for (int k = 0; k < n; k++)
        model->mesh.ends[k] = x[k];
    model->mesh.ends[n] = x[n - 1];
    int is_loaded = 0;
    for (int k = 0; k + 1 < n; k++) {
        model->state.p[k] = 0.5 * (p[k] + p[k + 1]);
        model->state.q[k] = 0.5 * (q[k] + q[k + 1]);
        const int loaded = p[k] != 0.0 || p[k + 1] != 0.0 || q[k] != 0.0 || q[k + 1] != 0.0;
        model->state.zone[k] = loaded ? RB_ZONE_STICK : RB_ZONE_SEPARATED;
        is_loaded |= loaded;
    }
    if (!is_loaded)
        return rb_fail(why, RB_EFORMAT, "all tractions are zero");
    set_totals(&model->given->load, s);
    return RB_OK;
}

rb_status rb_rolling_model_of_elements(const rb_rolling_case *rc, int n, const double *x,
                                       const double *h, const double *p, const double *q,
                                       const double *zone, rb_rolling_model *model,
                                       rb_rolling_solution *s, rb_message *why)
{
    /* a table does not say how it came about: ends of stick are taken as those of steady rolling */
    rb_rolling_case steady = *rc;
    steady.formulation = RB_STEADY;
    rb_status status = begin_given(&steady, n, model, s, why);
    if (status != RB_OK)
        return status;
    for (int k = 0; k < n; k++) {
        const double from = x[k] - 0.5 * h[k];
        if (!(h[k] > 0.0) || (k > 0 && fabs(from - model->mesh.ends[k]) > 1e-6 * h[k]))
            return rb_fail(why, RB_EFORMAT,
                           "x = %g mm: with a column h the rows are elements, each of which begins "
                           "where the one before it ends",
                           x[k]);
        if (!(zone[k] >= 0.0 && zone[k] <= RB_ZONE_YIELD_POSITIVE && zone[k] == floor(zone[k])))
            return rb_fail(why, RB_EFORMAT, "x = %g mm: zone %g: expected 0 to 5", x[k], zone[k]);
        if (k == 0)
            model->mesh.ends[0] = from;
        model->mesh.ends[k + 1] = x[k] + 0.5 * h[k];
        model->state.p[k] = p[k];
        model->state.q[k] = q[k];
        model->state.zone[k] = (int)zone[k];
    }
    model->mesh.ends[n + 1] = model->mesh.ends[n];
    rb_rolling_contact_edges(rc, &model->mesh, &model->state, &s->contact_from, &s->contact_to);
    if (!(s->contact_from < s->contact_to))
        return rb_fail(why, RB_NO_CONTACT, "no contact, no stress");
    for (int k = 0; k < n; k++) {
        s->normal_load += p[k] * h[k];
        s->tangential_load += q[k] * h[k];
        s->resistance_moment += p[k] * x[k] * h[k];
        s->max_pressure = fmax(s->max_pressure, fabs(p[k]));
    }
    s->half_width = 0.5 * (s->contact_to - s->contact_from);
    return RB_OK;
}

rb_status rb_rolling_model_of_rows(const rb_rolling_case *rc, const rb_rolling_traction_rows *rows,
                                   rb_rolling_model *model, rb_rolling_solution *s, rb_message *why)
{
    if (!rows->h != !rows->zone)
        return rb_fail(why, RB_EFORMAT, "elements need both columns, h and zone");
    return rows->h
               ? rb_rolling_model_of_elements(rc, rows->n, rows->x, rows->h, rows->p, rows->q,
                                              rows->zone, model, s, why)
               : rb_rolling_model_of_nodes(rc, rows->n, rows->x, rows->p, rows->q, model, s, why);
}
