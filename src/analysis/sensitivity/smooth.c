/* Derivatives without the jumps at changes of zones (theory-solvers.md, D8). Where stick meets
 * slip, the tangent tells at which values of the input the two elements there change their
 * zones. The jump of the derivative at the nearer value follows from the exchange of one
 * equation. Up to half of it is added, so that the derivative is continuous there. */
#include "analysis/sensitivity/internal.h"

#include <math.h>
#include <string.h>
#include <stdlib.h>

/* A pressure that changes by less than this part of its scale stays as it is. */
static const double NO_CHANGE = 1e-9;
/* A boundary stays where its conditions change by less than this part of their scales over that
 * of an input: this is rounding.  What is not linear is taken within a part of the input. */
static const double STAYS = 1e-6, NEAR = 0.1;

/* How a boundary between stick and slip moves by one element. */
enum { BEGINS_TO_SLIP, BEGINS_TO_STICK };

typedef struct {
    int element[2];                    /* neighbours: the one that sticks, the one that slips */
    rb_sensitivity_derivative line[2]; /* along which the state may move where either of them
                                          changes its zone; owned */
    double rate[2];                    /* of its condition along the line */
} boundary;

struct rb_sensitivity_jumps {
    const rb_sensitivity *s; /* borrowed */
    int n;
    boundary *at;                 /* owned */
    rb_sensitivity_jumps *freely; /* of free rolling; NULL: none; owned */
};

void rb_sensitivity_jumps_free(rb_sensitivity_jumps *jumps)
{
    if (!jumps)
        return;
    for (int k = 0; k < 2 * jumps->n; k++)
        rb_sensitivity_derivative_free(&jumps->at[k / 2].line[k % 2]);
    rb_sensitivity_jumps_free(jumps->freely);
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
                                 : x->lambda[i];
}

/* Its derivative, on elements that stay. */
static double rate_of(const rb_sensitivity *s, int way, int i, const rb_sensitivity_rate *rate,
                      const rb_contact_state *y)
{
    const rb_contact_state *x = &s->model->state;

    return way == BEGINS_TO_SLIP
               ? s->model->problem.bound[i] * y->p[i] + (rate ? rate->bound[i] * x->p[i] : 0.0) -
                     (x->q[i] < 0.0 ? -y->q[i] : y->q[i])
               : y->lambda[i];
}

static double condition_rate(const rb_sensitivity *s, int way, int i,
                             const rb_sensitivity_rate *rate, const rb_sensitivity_derivative *d,
                             int k)
{
    double sum = rate_of(s, way, i, rate, &d->state[k]);

    for (int m = 0; m < 2; m++)
        if (d->by[k][m] != 0.0)
            sum += d->by[k][m] * rate_of(s, way, i, &s->motion[m].rate, &s->motion[m].state[0]);
    return sum;
}

/* ---- Exchanges --------------------------------------------------------------------- */

/* Without the equation of the element the solution may move along one line. */
static rb_status exchange(const rb_sensitivity *s, int way, boundary *b, rb_sensitivity_rate *rate,
                          rb_message *why)
{
    const int i = b->element[way], slips = way == BEGINS_TO_SLIP;
    double *left_out = slips ? &rate->slip[i] : &rate->bound[i];
    const double by = slips ? s->model->problem.slip_length : s->model->problem.mu;

    /* what slips by -by obeys the law, as far as it depends on the slip, as its neighbours do */
    const double *by_slip = slips && s->law_slip ? s->law_slip + (size_t)i * (size_t)s->n : NULL;
    for (int j = 0; j < s->n && by_slip; j++)
        rate->bound[j] = j != i ? -by * by_slip[j] : 0.0;
    *left_out = by;
    const rb_status status = rb_sensitivity_along(s, rate, slips ? i : -1, &b->line[way], why);
    *left_out = 0.0;
    if (by_slip)
        rate->bound[i] = -by * by_slip[i];
    if (status == RB_OK)
        b->rate[way] = condition_rate(s, way, i, rate, &b->line[way], 0);
    memset(rate->bound, 0, (size_t)s->n * sizeof *rate->bound);
    return status == RB_OK && !isnormal(b->rate[way])
               ? rb_fail(why, RB_SINGULAR, "smooth derivatives: element %d cannot change its zone",
                         i + 1)
               : status;
}

static rb_status fail_short_zone(int i, rb_message *why)
{
    return rb_fail(why, RB_EINVAL,
                   "smooth derivatives: the zone of element %d is too short; give more elements",
                   i + 1);
}

static rb_status check_smooth(const rb_sensitivity *s, rb_message *why)
{
    const rb_rolling_friction *f = &s->model->rc->friction;

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
        if (own * right == -2 && s->model->problem.bound[i] == 0.0)
            return rb_fail(why, RB_EINVAL,
                           "smooth derivatives: elements %d and %d slide in opposite directions "
                           "without friction; take the exact derivatives",
                           i + 1, i + 2);
        if (own * right == -2 || (left * own * right != 0 && left != own && right != own))
            return fail_short_zone(i, why);
    }
    return RB_OK;
}

static int is_boundary(const rb_sensitivity *s, int i)
{
    return kind_of(s, i) * kind_of(s, i + 1) != 0 && kind_of(s, i) != kind_of(s, i + 1);
}

static rb_status create_jumps(const rb_sensitivity *s, rb_sensitivity_jumps **made, rb_message *why)
{
    rb_sensitivity_rate rate = {0};
    rb_sensitivity_jumps *jumps = *made = calloc(1, sizeof *jumps);
    rb_status status = check_smooth(s, why);
    int all = 0;

    for (int i = 0; i + 1 < s->n; i++)
        all += is_boundary(s, i);
    if (jumps)
        *jumps = (rb_sensitivity_jumps){s, 0, calloc((size_t)all + 1, sizeof *jumps->at), NULL};
    if (status == RB_OK &&
        (!jumps || !jumps->at || rb_sensitivity_rate_alloc(s->n, &rate) != RB_OK))
        status = rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    for (int i = 0; i + 1 < s->n && status == RB_OK; i++) {
        /* a zone of one element at an edge of the contact belongs to the edge, if there is
         * another boundary; where it is the only one, its end would be a jump without measure */
        const int before = kind_of(s, i - 1) == 0, behind = kind_of(s, i + 2) == 0;
        if (!is_boundary(s, i) || (all > 1 && (before || behind)))
            continue;
        if (before || behind) {
            status = fail_short_zone(before ? i : i + 1, why);
            break;
        }
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

rb_status rb_sensitivity_jumps_create(const rb_sensitivity *s, rb_sensitivity_jumps **made,
                                      rb_message *why)
{
    rb_message reason;

    *made = NULL;
    if (s->solution.n == 0)
        return rb_fail(why, RB_EINVAL, "smooth derivatives: made without results");
    rb_status status = create_jumps(s, made, why);
    /* free rolling may have none where the case has */
    if (status == RB_OK && s->free_rolling &&
        create_jumps(s->free_rolling, &(*made)->freely, &reason) == RB_ENOMEM) {
        rb_sensitivity_jumps_free(*made);
        *made = NULL;
        status = rb_fail(why, RB_ENOMEM, "out of memory for derivatives");
    }
    return status;
}

/* ---- Of an input ------------------------------------------------------------------- */

/* Adds to side k of d, of the same rolling as the jumps, what is between the sides of the next
 * change of each boundary. */
static rb_status add_jumps(const rb_sensitivity_jumps *jumps, double scale, int k,
                           rb_sensitivity_derivative *d, double *creepage, rb_message *why)
{
    const rb_sensitivity *s = jumps->s;
    const rb_contact_problem *p = &s->model->problem;
    const double most = NEAR * scale, size[2] = {rb_contact_friction_scale(p), p->slip_length};
    rb_status status = RB_OK;

    for (int b = 0; b < jumps->n && status == RB_OK; b++) {
        const boundary *it = &jumps->at[b];
        double at[2], by[2];
        for (int way = 0; way < 2; way++) {
            by[way] = condition_rate(s, way, it->element[way], &d->rate, d, k);
            at[way] = -condition(s, way, it->element[way]) / by[way];
        }
        if (!isfinite(at[0]) || !isfinite(at[1]) || !(at[0] * at[1] < 0.0) ||
            fmin(fabs(by[0]) / size[0], fabs(by[1]) / size[1]) * scale < STAYS)
            continue;
        const int next = fabs(at[1]) < fabs(at[0]);
        const double part = 0.5 - fabs(at[next] / (at[1] - at[0])),
                     factor = -part * by[next] / it->rate[next];
        *creepage += factor * rb_sensitivity_creepage(s, &it->line[next], 0);
        if (s->solution.n > 0 && factor != 0.0)
            status = rb_sensitivity_add_jump(s, &it->line[next], it->element[next], factor,
                                             fmax(-most, fmin(at[next], most)), k, d, why);
    }
    return status;
}

/* Motion of the end x of an element. */
static double motion_at(const rb_sensitivity *s, const double by[2], double x)
{
    double edges[2];

    if (s->moves == RB_SENSITIVITY_FIXED)
        return 0.0;
    if (s->moves == RB_SENSITIVITY_ZONE) {
        const rb_rolling_case *rc = s->model->rc;
        return by[0] * x / rb_rolling_zone_half_width(rc, rb_rolling_derive(rc).load);
    }
    rb_sensitivity_edges_of(s->model, edges);
    return by[1] + by[0] * (x - edges[1]) / edges[0];
}

/* How fast stick grows over the boundary between a sticking and a slipping element: by one element
 * from where the one begins to slip to where the other one begins to stick. */
static double growth_of_stick(const rb_sensitivity *s, double scale, int stick, int slip,
                              const rb_sensitivity_derivative *d, int k)
{
    const rb_contact_problem *p = &s->model->problem;
    const double *h = s->model->bodies.f.h,
                 by[2] = {condition_rate(s, BEGINS_TO_SLIP, stick, &d->rate, d, k),
                          condition_rate(s, BEGINS_TO_STICK, slip, &d->rate, d, k)},
                 at[2] = {-condition(s, BEGINS_TO_SLIP, stick) / by[0],
                          -condition(s, BEGINS_TO_STICK, slip) / by[1]};

    if (fmax(fabs(by[0]) / rb_contact_friction_scale(p), fabs(by[1]) / p->slip_length) * scale <
        STAYS)
        return 0.0;
    /* where both conditions grow the boundary hardly moves: by what one grows faster, in the middle
     * between both elements */
    return 0.5 * (h[stick] + h[slip]) *
           (at[0] * at[1] < 0.0 ? 1.0 / (at[1] - at[0]) : 0.25 * (1.0 / at[1] - 1.0 / at[0]));
}

double rb_sensitivity_stick_length(const rb_sensitivity *s, double scale,
                                   const rb_sensitivity_derivative *d, int k)
{
    const double *ends = s->model->mesh.ends;
    int first = 0, last = s->n - 1;
    double sum = 0.0;

    if (s->degenerate > 0 || s->model->problem.yield)
        return NAN;
    while (first < s->n && !kind_of(s, first))
        first++;
    while (last >= 0 && !kind_of(s, last))
        last--;
    for (int i = first; i <= last + 1; i++) {
        const int left = kind_of(s, i - 1), right = kind_of(s, i), starts = right == 1;
        if ((left == 1) == starts)
            continue;
        if (i == first || i == last + 1)
            sum += starts ? -d->value[k].contact_from : d->value[k].contact_to;
        else
            sum += (starts ? -1.0 : 1.0) * motion_at(s, d->by[k], ends[i]) +
                   (left * right == 0
                        ? 0.0
                        : growth_of_stick(s, scale, starts ? i : i - 1, starts ? i - 1 : i, d, k));
    }
    return sum;
}

/* Changes of the input where the next elements change their zones, to first order. */
static void set_stays(const rb_sensitivity *s, int k, rb_sensitivity_derivative *d)
{
    double *next = d->stays;

    next[0] = -INFINITY;
    next[1] = INFINITY;
    for (int i = 0; i < s->n; i++) {
        const int way = kind_of(s, i) == 1 ? BEGINS_TO_SLIP : BEGINS_TO_STICK;
        const double at = -condition(s, way, i) / condition_rate(s, way, i, &d->rate, d, k);
        if (kind_of(s, i) != 0 && isfinite(at))
            next[at > 0.0] = at > 0.0 ? fmin(next[1], at) : fmax(next[0], at);
    }
}

/* 1: an edge of the contact moves from element to element. */
static int edges_move(const rb_sensitivity *s, double scale, const rb_rolling_solution *d)
{
    const double least = NO_CHANGE * s->model->problem.stress;

    for (int i = 0; i + 1 < s->n && s->moves != RB_SENSITIVITY_EDGES; i++) {
        const int in = kind_of(s, i) ? i : i + 1, out = kind_of(s, i) ? i + 1 : i;
        if (kind_of(s, in) && !kind_of(s, out) && fabs(d->p[in]) * scale > least &&
            fabs(d->gap[out]) * scale > STAYS * s->model->problem.gap_length &&
            d->p[in] * d->gap[out] < 0.0)
            return 1;
    }
    return 0;
}

rb_status rb_sensitivity_smooth(const rb_sensitivity_jumps *jumps,
                                const rb_sensitivity_input *input,
                                rb_sensitivity_derivative *derivative, rb_message *why)
{
    rb_status status = RB_OK;

    for (int k = 0; k < 2 && status == RB_OK; k++) {
        rb_rolling_solution *d = &derivative->value[k];
        double creepage = d->free_creepage, unused = 0.0;
        if (!derivative->has[k])
            continue;
        if (edges_move(jumps->s, input->scale, d))
            return rb_fail(why, RB_EINVAL,
                           "smooth derivatives: the input moves the edges of the contact over the "
                           "elements; %s",
                           jumps->s->model->equal_instead
                               ? "fitting the mesh to them did not converge: take more elements, "
                                 "or --derivatives"
                               : "give --mesh aligned or fitted");
        set_stays(jumps->s, k, derivative);
        const double stuck = d->stick_length; /* is smooth already */
        status = add_jumps(jumps, input->scale, k, derivative, &unused, why);
        d->stick_length = stuck;
        if (status == RB_OK && derivative->free_rolling)
            status = jumps->freely ? add_jumps(jumps->freely, input->scale, k,
                                               derivative->free_rolling, &creepage, why)
                                   : RB_OK;
        d->free_creepage = derivative->free_rolling && !jumps->freely ? NAN : creepage;
        rb_sensitivity_clean(jumps->s, input->scale, d);
    }
    return status;
}
