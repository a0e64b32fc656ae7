/* Derivatives without the jumps at changes of zones (theory.md, D8). Where stick meets
 * slip, the tangent tells at which values of the input the two elements there change their
 * zones. The jump of the derivative at the nearer value follows from the exchange of one
 * equation. Up to half of it is added, so that the derivative is continuous there. */
#include "sensitivity/internal.h"

#include <math.h>
#include <stdlib.h>

/* A pressure that changes by less than this part of its scale stays as it is. */
static const double NO_CHANGE = 1e-9;

/* How a boundary between stick and slip moves by one element. */
enum { BEGINS_TO_SLIP, BEGINS_TO_STICK };

typedef struct {
    int element[2];                /* neighbours: the one that sticks, the one that slips */
    rb_rolling_solution change[2]; /* jumps of all derivatives where either of them changes its
                                      zone, if its condition changes by 1 per input; owned */
} boundary;

struct rb_sensitivity_jumps {
    const rb_sensitivity *s; /* borrowed */
    int n;
    boundary *at; /* owned */
};

void rb_sensitivity_jumps_free(rb_sensitivity_jumps *jumps)
{
    for (int k = 0; jumps && k < 2 * jumps->n; k++)
        rb_rolling_solution_free(&jumps->at[k / 2].change[k % 2]);
    if (jumps)
        free(jumps->at);
    free(jumps);
}

/* ---- Conditions of zones ----------------------------------------------------------- */

/* 0 apart, 1 stick, -1 and 2 slip. */
static int kind_of(const rb_sensitivity *s, int i)
{
    const int zone = i < 0 || i >= s->n ? RB_ZONE_SEPARATED : s->model->state.zone[i];
    return zone == RB_ZONE_SLIP_NEGATIVE ? -1 : zone == RB_ZONE_SLIP_POSITIVE ? 2 : zone;
}

/* Is 0 where element i changes its zone: the distance of friction from its bound in stick,
 * the slip in slip. */
static double condition(const rb_sensitivity *s, int way, int i)
{
    const rb_contact_state *x = &s->model->state;

    return way == BEGINS_TO_SLIP ? s->model->problem.bound[i] * x->p[i] - fabs(x->q[i])
                                 : s->solution.shift[i];
}

/* Its derivative, where the coefficient of friction alone has the derivative bound. */
static double condition_rate(const rb_sensitivity *s, int way, int i, double bound,
                             const rb_rolling_solution *d)
{
    const rb_contact_state *x = &s->model->state;

    return way == BEGINS_TO_SLIP ? s->model->problem.bound[i] * d->p[i] + bound * x->p[i] -
                                       (x->q[i] < 0.0 ? -d->q[i] : d->q[i])
                                 : d->shift[i];
}

/* ---- Exchanges --------------------------------------------------------------------- */

/* Without the equation of the element the solution may move along one line; there it moves
 * as far as the condition asks for. */
static rb_status exchange(const rb_sensitivity *s, int way, boundary *b, rb_sensitivity_rate *rate,
                          rb_message *why)
{
    const int i = b->element[way];
    double *left_out = way == BEGINS_TO_SLIP ? &rate->slip[i] : &rate->bound[i];
    const double by = way == BEGINS_TO_SLIP ? s->model->problem.slip_length : s->model->problem.mu;

    *left_out = by;
    const rb_status status = rb_sensitivity_along(s, rate, &b->change[way], why);
    *left_out = 0.0;
    if (status != RB_OK)
        return status;
    /* what slips by -by obeys the law */
    const double bound = way == BEGINS_TO_SLIP && s->law_slip
                             ? -by * s->law_slip[(size_t)i * (size_t)(s->n + 1)]
                             : 0.0,
                 g = condition_rate(s, way, i, bound, &b->change[way]);
    if (!isnormal(g))
        return rb_fail(why, RB_SINGULAR, "smooth derivatives: element %d cannot change its zone",
                       i + 1);
    rb_sensitivity_scale(&b->change[way], -1.0 / g);
    return RB_OK;
}

static rb_status check(const rb_sensitivity *s, rb_message *why)
{
    const rb_rolling_friction *f = &s->model->rc->friction;

    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "smooth derivatives: made without results");
    if (s->degenerate > 0)
        return rb_fail(why, RB_EINVAL,
                       "smooth derivatives: %d element%s exactly between two zones; change an "
                       "input slightly",
                       s->degenerate, s->degenerate == 1 ? " stands" : "s stand");
    if (s->model->problem.yield || f->memory != 0.0 || f->heat != 0.0)
        return rb_fail(why, RB_EINVAL,
                       "smooth derivatives: not for friction with memory or heat, or an interface "
                       "that yields");
    for (int i = 0; i < s->n; i++) {
        const int left = kind_of(s, i - 1), own = kind_of(s, i), right = kind_of(s, i + 1);
        if (own * right == -2 || (left * own * right != 0 && left != own && right != own))
            return rb_fail(why, RB_EINVAL,
                           "smooth derivatives: the zone of element %d is too short; give more "
                           "elements",
                           i + 1);
    }
    return RB_OK;
}

static int is_boundary(const rb_sensitivity *s, int i)
{
    return kind_of(s, i) * kind_of(s, i + 1) != 0 && kind_of(s, i) != kind_of(s, i + 1);
}

rb_status rb_sensitivity_jumps_create(const rb_sensitivity *s, rb_sensitivity_jumps **made,
                                      rb_message *why)
{
    rb_sensitivity_rate rate = {0};
    rb_sensitivity_jumps *jumps = *made = calloc(1, sizeof *jumps);
    rb_status status = check(s, why);
    int all = 0;

    for (int i = 0; i + 1 < s->n; i++)
        all += is_boundary(s, i);
    if (jumps)
        *jumps = (rb_sensitivity_jumps){s, 0, calloc((size_t)all + 1, sizeof *jumps->at)};
    if (status == RB_OK &&
        (!jumps || !jumps->at || rb_sensitivity_rate_alloc(s->n, &rate) != RB_OK))
        status = rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    for (int i = 0; i + 1 < s->n && status == RB_OK; i++) {
        /* a zone of one element at an edge of the contact belongs to the edge, if there is
         * another boundary */
        if (!is_boundary(s, i) || (all > 1 && (kind_of(s, i - 1) == 0 || kind_of(s, i + 2) == 0)))
            continue;
        boundary *b = &jumps->at[jumps->n++];
        b->element[BEGINS_TO_SLIP] = kind_of(s, i) == 1 ? i : i + 1;
        b->element[BEGINS_TO_STICK] = kind_of(s, i) == 1 ? i + 1 : i;
        for (int way = 0; way < 2 && status == RB_OK; way++)
            status = exchange(s, way, b, &rate, why);
    }
    rb_sensitivity_rate_free(&rate);
    if (status == RB_OK)
        return status;
    rb_sensitivity_jumps_free(jumps);
    *made = NULL;
    return status;
}

/* ---- Of an input ------------------------------------------------------------------- */

static void add_jumps(const rb_sensitivity_jumps *jumps, const rb_sensitivity_rate *rate,
                      double *part, rb_rolling_solution *d)
{
    for (int k = 0; k < jumps->n; k++) {
        double at[2], by[2];
        for (int way = 0; way < 2; way++) {
            const int i = jumps->at[k].element[way];
            by[way] = condition_rate(jumps->s, way, i, rate->bound[i], d);
            at[way] = -condition(jumps->s, way, i) / by[way];
        }
        const int nearer = fabs(at[1]) < fabs(at[0]);
        part[2 * k] = part[2 * k + 1] = 0.0;
        if (isfinite(at[0]) && isfinite(at[1]) && at[0] * at[1] < 0.0)
            part[2 * k + nearer] = by[nearer] * (0.5 - fabs(at[nearer] / (at[1] - at[0])));
    }
    for (int k = 0; k < 2 * jumps->n; k++)
        if (part[k] != 0.0)
            rb_sensitivity_add(d, part[k], &jumps->at[k / 2].change[k % 2]);
}

rb_status rb_sensitivity_smooth(const rb_sensitivity_jumps *jumps,
                                const rb_sensitivity_input *input,
                                rb_sensitivity_derivative *derivative, rb_message *why)
{
    const rb_sensitivity *s = jumps->s;
    const double least = NO_CHANGE * s->model->problem.stress;
    double *part = rb_alloc(2 * (size_t)jumps->n + 1, 1), *next = derivative->stays;
    int edges_move = 0;

    if (!part)
        return rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    for (int k = 0; k < 2; k++) {
        rb_rolling_solution *d = &derivative->value[k];
        if (!derivative->has[k])
            continue;
        /* changes of the input where the next elements change their zones, to first order */
        next[0] = -INFINITY;
        next[1] = INFINITY;
        for (int i = 0; i < s->n; i++) {
            const int way = kind_of(s, i) == 1 ? BEGINS_TO_SLIP : BEGINS_TO_STICK;
            const double at =
                -condition(s, way, i) / condition_rate(s, way, i, derivative->rate.bound[i], d);
            if (kind_of(s, i) != 0 && isfinite(at))
                next[at > 0.0] = at > 0.0 ? fmin(next[1], at) : fmax(next[0], at);
        }
        /* an edge of the contact that moves from element to element */
        for (int i = 0; i + 1 < s->n && s->moves != RB_SENSITIVITY_EDGES; i++) {
            const int in = kind_of(s, i) ? i : i + 1, out = kind_of(s, i) ? i + 1 : i;
            if (kind_of(s, in) && !kind_of(s, out) && fabs(d->p[in]) * input->scale > least)
                edges_move |= d->p[in] * d->gap[out] < 0.0;
        }
        add_jumps(jumps, &derivative->rate, part, d);
        if (s->free_rolling)
            d->free_creepage = NAN; /* of a solution with its own zones */
        if (jumps->n > 0)           /* an element that begins to slip dissipates too */
            d->dissipation = d->max_temperature = NAN;
    }
    free(part);
    return edges_move ? rb_fail(why, RB_EINVAL,
                                "smooth derivatives: the input moves the edges of the contact over "
                                "the elements; "
                                "give --mesh aligned or fitted")
                      : RB_OK;
}
