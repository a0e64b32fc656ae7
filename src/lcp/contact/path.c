/* The piecewise linear path (Katzenelson's method; theory-solvers.md 5).  Terms are added to the
 * data of the problem such that the zones of the state solve it; they are multiplied by
 * t, which goes from 1 to 0.  p, q, slips and gaps are linear in t up to the point where
 * the first element leaves its zone; only this element then changes its zone.  If it
 * could stay in its new zone only for larger t, the path turns to larger t, as in Lemke's
 * method when the artificial variable grows. */
#include "lcp/contact/internal.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

/* Paths from zones that are nearly right take ten, and where the limits of zones are far from
 * theirs, up to one for every fourth element. */
enum { BENDS = 40, ELEMENTS_PER_BEND = 4 };
/* A path that has turned and gone so far seldom comes back: most of them end at infinity. */
static const double FAR = 10.0;

/* What an element's law wants to be positive: two numbers at most. */
enum { MARGINS = 2 };

typedef struct {
    double *p, *q, *slip, *gap; /* n */
} point;

typedef struct {
    rb_contact_problem *problem;
    rb_contact_state *state; /* its zones are those of the path */
    point whole, none;       /* solutions of the zones for t = 1 and t = 0 */
    double *d_N, *d_T;       /* n: the problem's own */
    double *more_N, *more_T; /* n: what t = 1 adds */
    double load, force;      /* the problem's own */
    double more_load, more_force;
    double t, way; /* where the path is; -1: towards 0, 1: away from it */
} path;

static void set_data(path *k, double t)
{
    rb_contact_problem *p = k->problem;

    for (int i = 0; i < p->n; i++) {
        p->d_N[i] = k->d_N[i] + t * k->more_N[i];
        p->d_T[i] = k->d_T[i] + t * k->more_T[i];
    }
    p->load = k->load + t * k->more_load;
    p->force = k->force + t * k->more_force;
}

/* The state becomes the solution of its zones for t; copied to x. */
static rb_status solve_for(path *k, double t, point *x)
{
    const size_t bytes = (size_t)k->problem->n * sizeof(double);

    set_data(k, t);
    const rb_status s = rb_contact_try_zones(k->problem, k->state, x->gap);
    k->state->iterations++;
    memcpy(x->p, k->state->p, bytes);
    memcpy(x->q, k->state->q, bytes);
    memcpy(x->slip, k->state->lambda, bytes);
    return s;
}

static rb_status solve_both(path *k)
{
    const rb_contact_problem *p = k->problem;
    rb_status s = solve_for(k, 1.0, &k->whole);

    if (s == RB_OK)
        s = solve_for(k, 0.0, &k->none);
    if (s == RB_OK && p->trace)
        p->trace(k->state, p->trace_context);
    return s;
}

/* ---- Bends ------------------------------------------------------------------------- */

/* In contact and sliding: the pressure, and the slip against the friction. */
static void margins_of(const path *k, const point *x, int i, double margin[MARGINS])
{
    const int zone = k->state->zone[i];
    const double bound = k->problem->bound[i];

    margin[1] = INFINITY;
    if (zone == RB_ZONE_SEPARATED) {
        margin[0] = x->gap[i];
    } else if (zone == RB_ZONE_STICK) {
        margin[0] = bound * x->p[i] - x->q[i];
        margin[1] = bound * x->p[i] + x->q[i];
    } else {
        margin[0] = x->p[i];
        if (bound > 0.0)
            margin[1] = -rb_contact_slope(zone) * x->slip[i];
    }
}

typedef struct {
    double t;
    int element, margin; /* -1: none; the margin that ends there */
} bend;

/* Its element into the zone behind; returns which margin there begins with zero. */
static int cross(path *k, const bend *at)
{
    const int i = at->element;
    int *zone = &k->state->zone[i], begins = 0;
    const double slip = k->none.slip[i] + at->t * (k->whole.slip[i] - k->none.slip[i]);

    if (*zone == RB_ZONE_SEPARATED) {
        *zone = rb_contact_sliding_zone(slip);
    } else if (*zone == RB_ZONE_STICK) {
        *zone = at->margin == 0 ? RB_ZONE_SLIP_POSITIVE : RB_ZONE_SLIP_NEGATIVE;
        begins = 1;
    } else if (at->margin == 0) {
        *zone = RB_ZONE_SEPARATED;
    } else {
        begins = *zone == RB_ZONE_SLIP_NEGATIVE;
        *zone = RB_ZONE_STICK;
    }
    k->t = at->t;
    return begins;
}

static rb_status follow_path(path *k)
{
    rb_status s = solve_for(k, 0.0, &k->none);

    if (s == RB_OK) {
        /* What violates the laws of its zones changes its sign, of each element by a factor of
         * its own, so that they do not reach their bounds all at once. */
        static const double golden = 0.6180339887498949;

        for (int i = 0; i < k->problem->n; i++) {
            const double factor = 0.5 + 0.5 * fmod(golden * i, 1.0);
            const double slope = rb_contact_slope(k->state->zone[i]);
            k->none.p[i] *= k->none.p[i] < 0.0 ? -factor : 1.0;
            k->none.gap[i] *= k->none.gap[i] < 0.0 ? -factor : 1.0;
            k->none.slip[i] *= slope * k->none.slip[i] > 0.0 ? -factor : 1.0;
            const double limit = k->problem->bound[i] * k->none.p[i];
            if (k->state->zone[i] != RB_ZONE_STICK)
                k->none.q[i] = slope * limit;
            else if (fabs(k->none.q[i]) > limit)
                k->none.q[i] = copysign(factor * limit, k->none.q[i]);
        }
        /* What the problem lacks for this state to be the solution of its zones. */
        rb_contact_problem *p = k->problem;
        rb_contact_state *state = k->state;
        const size_t bytes = (size_t)p->n * sizeof(double);
        double *control_N = k->whole.p, *control_T = k->whole.q; /* scratch */

        memcpy(state->p, k->none.p, bytes);
        memcpy(state->q, k->none.q, bytes);
        rb_contact_kinematics(p, state, k->more_N, k->more_T);
        for (int i = 0; i < p->n; i++) {
            const int open = state->zone[i] == RB_ZONE_SEPARATED,
                      sticks = state->zone[i] == RB_ZONE_STICK;
            k->more_N[i] = (open ? k->none.gap[i] : 0.0) - k->more_N[i];
            k->more_T[i] = (sticks ? 0.0 : k->none.slip[i]) - k->more_T[i];
        }
        if (p->load_given)
            k->more_load = rb_contact_load(p, state) - p->load;
        if (p->force_given) {
            rb_contact_force_row(p, control_N, control_T);
            k->more_force = cblas_ddot(p->n, control_N, 1, state->p, 1) +
                            cblas_ddot(p->n, control_T, 1, state->q, 1) - p->force;
        }
        s = solve_both(k);
    }
    const int most = BENDS + k->problem->n / ELEMENTS_PER_BEND;
    for (int count = 0;
         s == RB_OK && count < most && rb_contact_has_steps_left(k->problem, k->state); count++) {
        bend at = {k->way * INFINITY, -1, 0};

        for (int i = 0; i < k->problem->n; i++) {
            double whole[MARGINS], none[MARGINS];
            margins_of(k, &k->whole, i, whole);
            margins_of(k, &k->none, i, none);
            for (int m = 0; m < MARGINS && isfinite(none[m]); m++) {
                const double slope = whole[m] - none[m];
                const double t = k->way * fmax(k->way * (-none[m] / slope), k->way * k->t);
                if (k->way * slope < 0.0 && k->way * (t - at.t) < 0.0)
                    at = (bend){t, i, m};
            }
        }
        if (k->way < 0.0 && at.t <= 0.0)
            return RB_OK;
        if (at.element < 0 || at.t > FAR)
            return RB_RAY;
        const int begins = cross(k, &at);
        s = rb_interrupted() ? RB_INTERRUPTED : solve_both(k);
        /* Where the margin that begins at the bend grows, the path goes on. */
        double whole[MARGINS], none[MARGINS];

        margins_of(k, &k->whole, at.element, whole);
        margins_of(k, &k->none, at.element, none);
        k->way = whole[begins] > none[begins] ? 1.0 : -1.0;
    }
    return s == RB_OK ? RB_MAXITER : s;
}

rb_status rb_contact_follow_path(rb_contact_problem *problem, rb_contact_state *state)
{
    const size_t n = (size_t)problem->n;
    double *x = rb_alloc(n, 12);
    if (!x)
        return RB_ENOMEM;
    path k = {.problem = problem,
              .state = state,
              .whole = {x, x + n, x + 2 * n, x + 3 * n},
              .none = {x + 4 * n, x + 5 * n, x + 6 * n, x + 7 * n},
              .d_N = x + 8 * n,
              .d_T = x + 9 * n,
              .more_N = x + 10 * n,
              .more_T = x + 11 * n,
              .load = problem->load,
              .force = problem->force,
              .t = 1.0,
              .way = -1.0};

    memcpy(k.d_N, problem->d_N, n * sizeof(double));
    memcpy(k.d_T, problem->d_T, n * sizeof(double));
    const rb_status s = follow_path(&k);
    set_data(&k, 0.0);
    free(x);
    return s == RB_RAY ? RB_MAXITER : s;
}
