/* Tangents of a solved contact (theory-solvers.md, D2), also if elements are at the border of two
 * zones. */
#include "analysis/sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is below this part of the largest change is none. */
static const double NO_CHANGE = 1e-9;
/* The same of data that are differences of products. */
static const double NO_CHANGE_OF_DATA = 1e-6;

/* ---- Of operators without matrices ------------------------------------------------- */

/* The problem of the model's zones, `part` of the way that the rates lead (linear). */
static rb_status solve_moved(const rb_sensitivity *s, const rb_sensitivity_rate *rate, double part,
                             rb_contact_state *x)
{
    const rb_contact_problem *base = &s->model->problem;
    const rb_contact_state *state = &s->model->state;
    const size_t n = (size_t)s->n;
    double *scratch = rb_alloc(n, 5);
    rb_contact_problem p = *base;

    if (!scratch)
        return RB_ENOMEM;
    /* d_N, d_T and given values moved along the rates; friction: what a change of mu adds in slip,
     * which the operator turns into gaps and slips. */
    double *friction = scratch + 2 * n, *none = scratch + 3 * n, *gap = scratch + 4 * n;
    p.d_N = scratch;
    p.d_T = scratch + n;
    for (size_t i = 0; i < n; i++) {
        p.d_N[i] = base->d_N[i] + part * rate->gap[i];
        p.d_T[i] = base->d_T[i] + part * rate->slip[i];
        friction[i] = state->zone[i] == RB_ZONE_SLIP_NEGATIVE   ? -1.0
                      : state->zone[i] == RB_ZONE_SLIP_POSITIVE ? 1.0
                                                                : 0.0;
        friction[i] *= part * rate->bound[i] * state->p[i];
        x->zone[i] = state->zone[i];
        x->p[i] = state->p[i];
        x->q[i] = state->q[i];
    }
    x->delta = state->delta;
    x->xi = state->xi;
    rb_contact_operator_add(p.op, none, friction, p.d_N, p.d_T);
    p.load -= part * rate->normal * base->load;
    p.delta -= part * rate->normal * base->gap_length;
    p.xi -= part * rate->tangential * base->slip_length / base->e_T[0];
    p.force -= part * rate->tangential * base->mu * base->stress * s->model->bodies.f.h[0];
    for (size_t i = 0; i < n; i++) {
        p.load -= base->load_T[i] * friction[i];
        p.force -= (base->force_T[i] + base->axle * base->moment_T[i] -
                    base->force_ratio * base->bound[i] * base->load_T[i]) *
                   friction[i];
    }
    const rb_status status = rb_contact_try_zones(&p, x, gap);
    for (size_t i = 0; i < n; i++)
        x->q[i] += friction[i];
    free(scratch);
    return status;
}

/* A part that moves the data by far more than they are: the products are solved to so
 * much, and the change is what counts. */
static const double FAR = 1e4;

static double long_part(const rb_sensitivity *s, const rb_sensitivity_rate *rate)
{
    const rb_contact_problem *p = &s->model->problem;
    const size_t n = (size_t)s->n;
    const double size = fmax(fmax(rb_norm_inf(n, rate->gap) / p->gap_length,
                                  rb_norm_inf(n, rate->slip) / p->slip_length),
                             fmax(rb_norm_inf(n, rate->bound) / fmax(p->mu, 1e-3),
                                  fmax(fabs(rate->normal), fabs(rate->tangential) / s->n)));

    return size > 0.0 ? FAR / size : FAR;
}

/* At the creepage that the rate says. */
static rb_status tangent_at_creepage(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                                     rb_contact_state *y)
{
    const rb_contact_state *x = &s->model->state;
    /* A linear problem: the difference of two solutions over the way between them is exact for any
     * way. */
    const double part = long_part(s, rate);
    const rb_status status = solve_moved(s, rate, part, y);

    for (int i = 0; i < s->n; i++) {
        y->p[i] = (y->p[i] - x->p[i]) / part;
        y->q[i] = (y->q[i] - x->q[i]) / part;
    }
    y->delta = (y->delta - x->delta) / part;
    y->xi = (y->xi - x->xi) / part;
    return status;
}

/* A creepage that follows the load brings its own tangent, as often as the load that it
 * changes asks for. */
static rb_status tangent_by_products(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                                     rb_contact_state *y)
{
    const rb_contact_problem *p = &s->model->problem;
    const double share = rb_sensitivity_xi_by_load(s->model);
    rb_contact_state by_xi = {0};
    rb_sensitivity_rate unit = {0};
    rb_status status = tangent_at_creepage(s, rate, y);

    if (status != RB_OK || share == 0.0)
        return status;
    status = rb_contact_state_alloc(s->n, &by_xi);
    if (status == RB_OK)
        status = rb_sensitivity_rate_alloc(s->n, &unit);
    unit.tangential = -p->e_T[0] / p->slip_length;
    if (status == RB_OK)
        status = tangent_at_creepage(s, &unit, &by_xi);
    /* The load changes xi by share, and xi the load by that of by_xi: the geometric series of
     * both. */
    const double more =
        status == RB_OK ? share * rb_contact_load(p, y) / (1.0 - share * rb_contact_load(p, &by_xi))
                        : 0.0;
    for (int i = 0; i < s->n && status == RB_OK; i++) {
        y->p[i] += more * by_xi.p[i];
        y->q[i] += more * by_xi.q[i];
    }
    y->delta += more * by_xi.delta;
    y->xi += more * by_xi.xi;
    rb_sensitivity_rate_free(&unit);
    rb_contact_state_free(&by_xi);
    return status;
}

/* ---- Between two zones ------------------------------------------------------------- */

/* What a side of a degenerate pair has to change by to decide. */
typedef struct {
    double traction, gap, slip;
} threshold;

static threshold threshold_of(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                              const rb_contact_state *y)
{
    const rb_contact_problem *p = &s->model->problem;
    const size_t n = (size_t)s->n;
    const double traction = fmax(rb_norm_inf(n, y->p), rb_norm_inf(n, y->q));

    return (threshold){
        NO_CHANGE * fmax(traction, rb_norm_inf(n, rate->bound) * p->stress),
        NO_CHANGE *
            fmax(p->gap_length / p->stress * traction + fabs(y->delta), rb_norm_inf(n, rate->gap)),
        NO_CHANGE * fmax(p->slip_length / p->stress * traction + fabs(y->xi) * p->e_T[0],
                         rb_norm_inf(n, rate->slip))};
}

/* 1: element i neither slides nor has friction, which its coefficient brings it now. */
static int begins_to_rub(const rb_sensitivity *s, const rb_sensitivity_rate *rate, size_t i)
{
    return s->border[i] == BORDER_REST && rate->bound[i] != 0.0;
}

/* The zone of element i at a border, if the tangent (times side) does not suit the one
 * that it has. */
static int next_zone(const rb_sensitivity *s, const rb_sensitivity_rate *rate, int side,
                     const rb_contact_state *y, const double *gap, const double *slip, int i,
                     int zone)
{
    const rb_contact_problem *p = &s->model->problem;
    const rb_contact_state *state = &s->model->state;
    const threshold least = threshold_of(s, rate, y);
    const int toward = state->q[i] > 0.0 ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SLIP_NEGATIVE;
    const double sign = toward == RB_ZONE_SLIP_POSITIVE ? 1.0 : -1.0;

    if (s->border[i] == BORDER_REST && zone == RB_ZONE_STICK)
        return side * rate->bound[i] * state->p[i] - fabs(y->q[i]) < -least.traction
                   ? (side * y->q[i] > 0.0 ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SLIP_NEGATIVE)
                   : zone;
    if (s->border[i] == BORDER_REST)
        return side * (zone == RB_ZONE_SLIP_POSITIVE ? 1.0 : -1.0) * (slip[i] + rate->slip[i]) >
                       least.slip
                   ? RB_ZONE_STICK
                   : zone;
    if (s->border[i] == BORDER_GAP && zone == RB_ZONE_SEPARATED)
        return side * (gap[i] + rate->gap[i]) < -least.gap
                   ? (s->slip[i] > 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE)
                   : zone;
    if (s->border[i] == BORDER_GAP)
        return side * y->p[i] < -least.traction ? RB_ZONE_SEPARATED : zone;
    const double left = p->bound[i] * y->p[i] + rate->bound[i] * state->p[i] - sign * y->q[i];
    if (zone == RB_ZONE_STICK)
        return side * left < -least.traction ? toward : zone;
    return side * sign * (slip[i] + rate->slip[i]) > least.slip ? RB_ZONE_STICK : zone;
}

/* One element at a time: the first of those whose zone does not suit (Murty's rule). */
static rb_status tangent_at_border(const rb_sensitivity *s, const rb_sensitivity_rate *rate,
                                   int side, rb_contact_state *y, rb_message *why)
{
    const rb_contact_problem *p = &s->model->problem;
    const size_t n = (size_t)s->n;
    const int pairs = s->degenerate + s->at_rest, most = 1 << (pairs < 10 ? pairs : 10);
    double *gap = rb_alloc(n, 2), *slip = gap ? gap + n : NULL;
    int *zone = rb_alloc_int(n), k = 0, moved = 1;
    rb_status status = gap && zone ? RB_OK : RB_ENOMEM;

    if (status == RB_OK)
        memcpy(zone, s->model->state.zone, n * sizeof *zone);
    for (size_t i = 0; i < n && status == RB_OK; i++)
        if (begins_to_rub(s, rate, i))
            zone[i] = RB_ZONE_STICK;
    for (; k <= most && moved && status == RB_OK; k++) {
        /* The tangent for these zones, and whether each element at a border goes where its zone
         * allows. */
        rb_sensitivity_factors *f;
        status = rb_sensitivity_factor(s, zone, NULL, &f);
        if (status == RB_OK)
            status = rb_sensitivity_forward(s, f, rate, y);
        rb_sensitivity_factors_free(f);
        for (size_t i = 0; i < n; i++) {
            gap[i] = -y->delta;
            slip[i] = y->xi * p->e_T[i];
        }
        rb_contact_operator_add(p->op, y->p, y->q, gap, slip);
        moved = 0;
        for (int i = 0; i < s->n && !moved && status == RB_OK; i++) {
            const int can_change =
                s->border[i] && (s->border[i] != BORDER_REST || begins_to_rub(s, rate, i));
            const int to =
                can_change ? next_zone(s, rate, side, y, gap, slip, i, zone[i]) : zone[i];
            moved = to != zone[i];
            zone[i] = to;
        }
    }
    free(gap);
    free(zone);
    return status == RB_OK && moved
               ? rb_fail(why, RB_MAXITER,
                         "derivatives: the zones beside %d elements at a border were not "
                         "found",
                         pairs)
               : status;
}

rb_status rb_sensitivity_tangent(const rb_sensitivity *s, const rb_sensitivity_rate *rate, int side,
                                 rb_contact_state *tangent, rb_message *why)
{
    const rb_contact_problem *p = &s->model->problem;
    const size_t n = (size_t)s->n;
    const double least = NO_CHANGE_OF_DATA * rb_norm_inf(n, rate->bound);
    int rub = 0;

    for (size_t i = 0; i < n && s->at_rest > 0; i++)
        rub += begins_to_rub(s, rate, i);
    /* Nothing changes but coefficients of friction, from 0 on, of surfaces that do not slide.
     * tangential: 0 / 0 where a force is given, which is 0 without friction. */
    if (rub > 0 && s->at_rest == s->contact && fabs(rate->normal) <= least &&
        !(fabs(rate->tangential) > least) && rb_norm_inf(n, rate->gap) <= least * p->gap_length &&
        rb_norm_inf(n, rate->slip) <= least * p->slip_length) {
        memset(tangent->p, 0, n * sizeof *tangent->p);
        memset(tangent->q, 0, n * sizeof *tangent->q);
        memset(tangent->lambda, 0, n * sizeof *tangent->lambda);
        tangent->delta = tangent->xi = 0.0;
        return RB_OK;
    }
    if (rub > 0 && !s->factors)
        return rb_fail(why, RB_EINVAL,
                       "derivatives: which way %d element%s without friction will slide is found "
                       "by matrices: give fewer than %d elements",
                       rub, rb_plural(rub), RB_ROLLING_LARGE);
    const rb_status status = !s->factors ? tangent_by_products(s, rate, tangent)
                             : s->degenerate || rub > 0
                                 ? tangent_at_border(s, rate, side, tangent, why)
                                 : rb_sensitivity_forward(s, s->factors, rate, tangent);
    return status == RB_SINGULAR
               ? rb_fail(why, status, "derivatives: the Jacobian is singular here")
               : status;
}
