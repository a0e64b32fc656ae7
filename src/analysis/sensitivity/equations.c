/* The equations of a contact whose zones are known (theory-solvers.md, D1), and the derivatives
 * of the friction law with respect to slips and tractions. */
#include "analysis/sensitivity/internal.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* gap, slip, bound and yield stand behind each other in one array, 4 n. */
rb_status rb_sensitivity_rate_alloc(int n, rb_sensitivity_rate *rate)
{
    *rate = (rb_sensitivity_rate){.n = n, .gap = rb_alloc((size_t)n, 4)};
    if (!rate->gap)
        return RB_ENOMEM;
    rate->slip = rate->gap + n;
    rate->bound = rate->slip + n;
    rate->yield = rate->bound + n;
    return RB_OK;
}

void rb_sensitivity_rate_free(rb_sensitivity_rate *rate)
{
    free(rate->gap);
    memset(rate, 0, sizeof *rate);
}

void rb_sensitivity_rate_add(const rb_sensitivity_rate *rate, double times, rb_sensitivity_rate *to)
{
    for (int i = 0; i < 4 * rate->n; i++)
        to->gap[i] += times * rate->gap[i];
    to->normal += times * rate->normal;
    to->tangential += times * rate->tangential;
}

void rb_sensitivity_given(const rb_rolling_model *base, const rb_contact_problem *p,
                          const rb_contact_state *state, rb_sensitivity_rate *left)
{
    const rb_contact_problem *scale = &base->problem;

    memcpy(left->bound, p->bound, (size_t)left->n * sizeof *left->bound);
    /* What the given values miss, in the scales of J's rows. */
    left->normal = p->load_given ? (rb_contact_load(p, state) - p->load) / scale->load
                                 : (state->delta - p->delta) / scale->gap_length;
    left->tangential = p->force_given
                           ? (rb_contact_force(p, state) + p->axle * rb_contact_moment(p, state) -
                              p->force - p->force_ratio * rb_contact_capacity(p, state)) /
                                 (scale->mu * scale->stress * base->bodies.f.h[0])
                           : (state->xi - p->xi) * scale->e_T[0] / scale->slip_length;
}

/* R of (D1): gap, slip, bound and yield stress of the variant at its present tractions, and what
 * the given values miss. */
rb_status rb_sensitivity_residual(const rb_rolling_model *base, rb_rolling_model *variant,
                                  rb_sensitivity_rate *left, rb_message *why)
{
    const rb_contact_problem *p = &variant->problem;
    const rb_status s = rb_rolling_variant_complete(variant, left->gap, left->slip, why);

    if (s != RB_OK)
        return s;
    if (p->yield) {
        /* by the zones: slips that are nearly 0 may change their sign within a step */
        rb_contact_set_plastic(p, &variant->state, left->yield);
        for (int i = 0; i < left->n; i++)
            left->yield[i] = rb_contact_yield_stress(p, i, left->yield[i]);
    }
    rb_sensitivity_given(base, p, &variant->state, left);
    return RB_OK;
}

/* A law asks for the size of slips, and within the step small ones change their sign: the
 * coefficients are those of the slips and the friction of the model, and change by them as in J. */
rb_status rb_sensitivity_set_law(const rb_sensitivity *s, rb_rolling_model *variant,
                                 rb_message *why)
{
    const rb_contact_state *state = &s->model->state;
    const size_t n = (size_t)s->n;
    rb_contact_problem *p = &variant->problem;

    if (!s->law_slip)
        return RB_OK;
    double *slip = rb_alloc(n, 2);
    if (!slip)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d coefficients", s->n);
    double *friction = slip + n;
    memcpy(slip, variant->state.lambda, n * sizeof *slip);
    memcpy(friction, variant->state.q, n * sizeof *friction);
    memcpy(variant->state.lambda, state->lambda, n * sizeof *slip);
    memcpy(variant->state.q, state->q, n * sizeof *friction);
    const rb_status status = rb_rolling_model_friction(variant, why);
    memcpy(variant->state.lambda, slip, n * sizeof *slip);
    memcpy(variant->state.q, friction, n * sizeof *friction);
    for (size_t j = 0; j < n; j++) {
        if (state->zone[j] != RB_ZONE_STICK)
            cblas_daxpy(s->n, slip[j] - state->lambda[j], s->law_slip + j * n, 1, p->bound, 1);
        if (s->law_force)
            cblas_daxpy(s->n, friction[j] - state->q[j], s->law_force + j * n, 1, p->bound, 1);
    }
    free(slip);
    return status;
}

/* RB_EINVAL: an element in contact moves over a point of a table where this has two slopes. A
 * kink is as large over half the step as its half, what is smooth as its quarter. */
static rb_status check_knots(const rb_rolling_model *base, double shift, double stretch,
                             double further, rb_message *why)
{
    static const double by[] = {1.0, -1.0, 0.5, -0.5}, least = 1e-4, rounding = 1e-12;
    enum { PLACES = sizeof by / sizeof *by };
    const rb_rolling_case *rc = base->rc;
    const size_t n = (size_t)base->mesh.n;

    if (rc->irregularity.n == 0 && rc->friction.law != RB_FRICTION_table)
        return RB_OK;
    double *at = rb_alloc(n, 2 * PLACES);
    rb_status status = at ? RB_OK : RB_ENOMEM;
    for (size_t k = 0; k < PLACES && status == RB_OK; k++)
        status = rb_rolling_variant_data(base, by[k] * shift, 1.0 + by[k] * stretch,
                                         by[k] * further, at + k * n, at + (PLACES + k) * n, why);
    for (int of_bound = 0; of_bound < 2 && status == RB_OK; of_bound++) {
        const double *from = of_bound ? base->problem.bound : base->mesh.gap,
                     *x = at + (of_bound ? PLACES * n : 0);
        double rise = 0.0, size = 0.0;
        for (size_t i = 0; i < n; i++) {
            rise = fmax(rise, fabs(x[i] - from[i]));
            size = fmax(size, fabs(from[i]));
        }
        for (size_t i = 0; i < n && status == RB_OK; i++) {
            /* Second differences over the step and over its half. */
            const double bend = x[i] + x[n + i] - 2.0 * from[i],
                         half = x[2 * n + i] + x[3 * n + i] - 2.0 * from[i];
            if (base->state.zone[i] != RB_ZONE_SEPARATED && fabs(bend) < 3.0 * fabs(half) &&
                fabs(bend) > least * rise + rounding * size)
                status = rb_fail(why, RB_EINVAL,
                                 "derivatives: a row of the table of the %s lies under the "
                                 "midpoint of element %d, where both sides differ",
                                 of_bound ? "friction" : "irregularity", (int)i + 1);
        }
    }
    free(at);
    return status;
}

rb_status rb_sensitivity_add_variant(const rb_sensitivity *s, rb_rolling_model *variant,
                                     double times, rb_sensitivity_rate *left,
                                     rb_sensitivity_rate *rate, rb_message *why)
{
    static const double part = 0.04, rounding = 1e-12;
    const rb_rolling_model *base = s->model;
    const rb_rolling_mesh *from = &base->mesh, *to = &variant->mesh;
    const double width = from->ends[s->n] - from->ends[0],
                 scale = (to->ends[s->n] - to->ends[0]) / width,
                 shift = to->ends[0] - scale * from->ends[0], further = to->passed - from->passed;
    rb_status status = rb_sensitivity_residual(base, variant, left, why);

    if (status == RB_OK)
        status = rb_sensitivity_set_law(s, variant, why);
    if (status != RB_OK)
        return status;
    memcpy(left->bound, variant->problem.bound, (size_t)s->n * sizeof *left->bound);
    rb_sensitivity_rate_add(left, times, rate);
    if (fabs(scale - 1.0) <= rounding && fabs(shift) <= rounding * width &&
        fabs(further) <= rounding * width)
        return RB_OK;
    /* Tables of gap and friction over x have kinks, which the step of a flexibility would span: of
     * elements and irregularities that move, what these tables add is that of a short step. */
    status = check_knots(base, part * shift, part * (scale - 1.0), part * further, why);
    for (int k = 0; k < 2 && status == RB_OK; k++) {
        const double by = k ? 1.0 : part, weight = k ? -times : times / part;
        status = rb_rolling_variant_data(base, by * shift, 1.0 + by * (scale - 1.0), by * further,
                                         left->gap, left->bound, why);
        for (int i = 0; i < s->n && status == RB_OK; i++) {
            rate->gap[i] += weight * (left->gap[i] - from->gap[i]);
            rate->bound[i] += weight * (left->bound[i] - base->problem.bound[i]);
        }
    }
    return status;
}

/* ---- The law ----------------------------------------------------------------------- */

/* A step of the slip or friction of element i, ahead of which the law is smooth: laws ask for the
 * size of slips, heat for powers > 0, and memory for at least a slip of its own. It goes away from
 * the nearest kink, as a slip that is nearly 0 is too small to be a step. At rest it goes against
 * the friction. */
static double step_at(const rb_rolling_model *model, int of_friction, int i, double step)
{
    enum { PLACES_AHEAD = 4 };
    const double q = model->state.q[i],
                 x = of_friction                             ? q
                     : model->state.zone[i] == RB_ZONE_STICK ? 0.0
                                                             : model->state.lambda[i],
                 size = fabs(x),
                 away = x != 0.0  ? copysign(1.0, x)
                        : q > 0.0 ? -1.0
                                  : 1.0,
                 kink = of_friction ? 0.0
                                    : model->rc->friction.memory_slip * model->problem.e_T[i] /
                                          model->rc->speed;

    return size >= kink        ? away * step
           : 2.0 * size < kink ? away * fmin(step, (kink - size) / PLACES_AHEAD)
                               : -away * fmin(step, size / PLACES_AHEAD);
}

/* What the coefficients of the law move by (n) where the slips, or the frictions, of element `at`
 * and of every apart-th one from there on move by their steps: a derivative times the step.  Of
 * those with is_asked (n; NULL: all).  One that sticks begins to slip against its friction. */
static rb_status move_law(const rb_rolling_model *model, rb_rolling_model *v, int of_friction,
                          double step, int at, int apart, const int *is_asked, double *moved,
                          rb_message *why)
{
    const rb_sensitivity_stencil *places = &rb_sensitivity_ahead;
    const int n = model->problem.n;
    double *x = of_friction ? v->state.q : v->state.lambda;
    rb_status s = RB_OK;

    memset(moved, 0, (size_t)n * sizeof *moved);
    for (int k = 0; k < places->n && s == RB_OK; k++) {
        for (int i = at; i < n; i += apart)
            if (!is_asked || is_asked[i])
                x[i] += step_at(model, of_friction, i, step) * places->place[k];
        s = rb_rolling_model_friction(v, why);
        memcpy(v->state.lambda, model->state.lambda, (size_t)n * sizeof *x);
        memcpy(v->state.q, model->state.q, (size_t)n * sizeof *x);
        for (int i = 0; i < n; i++) {
            v->state.lambda[i] *= v->state.zone[i] != RB_ZONE_STICK;
            moved[i] += places->weight[k] * v->problem.bound[i];
        }
    }
    return s;
}

/* Steadily, or without memory, the coefficient of an element follows from its own slip, those of
 * its neighbours, and what is kept of the coefficient upstream (F1, F2): the slips of every third
 * element are changed at once. What sticks slips only where `sticks`. */
static rb_status fill_neighbours(rb_sensitivity *s, rb_rolling_model *v, double step, int sticks,
                                 double *moved, int *is_asked, rb_message *why)
{
    enum { APART = 3 };
    const rb_rolling_model *model = s->model;
    const int *zone = model->state.zone, last = s->n - 1,
              remembers = model->rc->friction.memory > 0;
    const size_t n = (size_t)s->n;
    rb_status status = RB_OK;

    for (int i = 0; i <= last; i++) /* what opens behind the contact counts, too */
        is_asked[i] = zone[i] == RB_ZONE_SEPARATED ? i < last && zone[i + 1] != RB_ZONE_SEPARATED
                                                   : (zone[i] == RB_ZONE_STICK) == sticks;
    for (int first = 0; first < APART && status == RB_OK; first++) {
        status = move_law(model, v, 0, step, first, APART, is_asked, moved, why);
        for (int i = 0; i <= last && status == RB_OK; i++) {
            const int j = i - 1 + (first - i + 1 + APART * s->n) % APART;
            if (zone[i] == RB_ZONE_SEPARATED || j < 0 || j > last || !is_asked[j])
                continue;
            const double kept = remembers && i < last ? rb_rolling_law_kept(model, i) : 0.0;
            s->law_slip[(size_t)i + (size_t)j * n] =
                (moved[i] - (kept > 0.0 ? kept * moved[i + 1] : 0.0)) / step_at(model, 0, j, step);
        }
    }
    for (int i = last - 1; i >= 0 && remembers && status == RB_OK; i--)
        if (zone[i] != RB_ZONE_SEPARATED)
            cblas_daxpy(s->n, rb_rolling_law_kept(model, i), s->law_slip + i + 1, s->n,
                        s->law_slip + i, s->n);
    return status;
}

/* Of all coefficients with respect to the creepage alone. */
static rb_status fill_by_creepage(rb_sensitivity *s, rb_rolling_model *v, rb_message *why)
{
    static const double step = 1e-3; /* of speeds over their mean */
    const rb_sensitivity_stencil *places = &rb_sensitivity_middle;
    const double xi = s->model->state.xi;
    rb_status status = RB_OK;

    for (int k = 0; k < places->n && status == RB_OK; k++) {
        v->state.xi = xi + places->place[k] * step;
        status = rb_rolling_model_friction(v, why);
        for (int i = 0; i < s->n; i++)
            s->law_xi[i] += places->weight[k] * v->problem.bound[i] / step;
    }
    v->state.xi = xi;
    return status;
}

/* Derivative of all coefficients with respect to the slip, or to the friction, of one element. */
static rb_status differentiate_law(const rb_rolling_model *model, rb_rolling_model *v,
                                   int of_friction, double step, int at, double *derivative,
                                   rb_message *why)
{
    const int n = model->problem.n;
    const rb_status s = move_law(model, v, of_friction, step, at, n, NULL, derivative, why);

    cblas_dscal(n, 1.0 / step_at(model, of_friction, at, step), derivative, 1);
    return s;
}

/* Where friction remembers in steps, or heats, every element asks all others. */
static rb_status fill_law(rb_sensitivity *s, rb_rolling_model *v, double *scratch, int *is_asked,
                          rb_message *why)
{
    const rb_rolling_model *model = s->model;
    const rb_rolling_friction *f = &model->rc->friction;
    const rb_contact_problem *p = &model->problem;
    const size_t n = (size_t)s->n;
    const double slip = 5e-5 * p->slip_length, stress = 5e-5 * p->mu * p->stress;
    rb_status status = RB_OK;

    if (f->heat == 0.0 && (f->memory == 0.0 || model->rc->formulation == RB_STEADY)) {
        status = fill_neighbours(s, v, slip, 0, scratch, is_asked, why);
        return status == RB_OK && f->memory == 0.0
                   ? fill_neighbours(s, v, slip, 1, scratch, is_asked, why)
                   : status;
    }
    /* The friction of an element heats by the slips at both its ends: that of an element that
     * sticks by the one behind it, where the next element slips; and what opens behind the
     * contact heats its last element. */
    if (s->law_xi)
        status = fill_by_creepage(s, v, why);
    for (size_t j = 0; j < n && status == RB_OK; j++) {
        const int *zone = model->state.zone, heats = s->law_force != NULL;
        if (zone[j] > RB_ZONE_STICK ||
            (heats && zone[j] == RB_ZONE_SEPARATED && j + 1 < n && zone[j + 1] != zone[j]))
            status = differentiate_law(model, v, 0, slip, (int)j, s->law_slip + j * n, why);
        if (status == RB_OK && heats &&
            (zone[j] > RB_ZONE_STICK ||
             (zone[j] == RB_ZONE_STICK && j > 0 && zone[j - 1] != zone[j])))
            status = differentiate_law(model, v, 1, stress, (int)j, s->law_force + j * n, why);
    }
    return status;
}

rb_status rb_sensitivity_law(rb_sensitivity *s, rb_message *why)
{
    const rb_rolling_model *model = s->model;
    const size_t n = (size_t)s->n;
    rb_rolling_model v = {.mesh = {.n = 0}};
    rb_status status = RB_OK;

    if (!rb_rolling_law_depends_on_state(model->rc))
        return RB_OK;
    s->law_slip = rb_alloc(n, n);
    const int heats = model->rc->friction.heat != 0.0;
    s->law_force = heats ? rb_alloc(n, n) : NULL;
    s->law_xi = heats ? rb_alloc(n, 1) : NULL;
    double *scratch = rb_alloc(n, 1);
    int *is_asked = rb_alloc_int(n);
    if (!s->law_slip || !scratch || !is_asked || (heats && (!s->law_force || !s->law_xi)))
        status = rb_fail(why, RB_ENOMEM, "out of memory for %d coefficients", s->n);
    if (status == RB_OK)
        status = rb_rolling_variant_create(model, model->rc, 1, 0, NULL, &v, why);
    v.carried.mu = model->carried.mu;
    v.carried.heat = model->carried.heat;
    if (status == RB_OK)
        status = rb_rolling_variant_complete(&v, NULL, NULL, why);
    if (status == RB_OK)
        status = fill_law(s, &v, scratch, is_asked, why);
    rb_rolling_variant_free(model, &v);
    free(is_asked);
    free(scratch);
    return status;
}
