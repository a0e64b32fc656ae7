/* States whose coefficients of friction depend on them (theory-rolling.md 4.11): the contact
 * problem with the coefficients of the state before, until they do not change. */
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/heat.h"
#include "rolling/solve/law.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- The coefficients of a state --------------------------------------------------- */

/* Of the surfaces of a solved state. */
static rb_status temperatures_of(rb_rolling_model *model, double *t, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const rb_contact_state *state = &model->state;
    const int n = state->n;
    rb_rolling_solution view = {.n = n,
                                .x = model->bodies.f.x,
                                .h = model->bodies.f.h,
                                .q = state->q,
                                .shift = state->lambda,
                                .zone = state->zone,
                                .creepage = state->xi,
                                .formulation = rc->formulation,
                                .slip_operator = rc->slip_operator};

    if (rc->formulation == RB_TRANSIENT) {
        if (!model->carried.heat)
            return rb_refuse(why, "conductivity,conductivity-b",
                             "the heat of the steps before is known only while their "
                             "history runs");
        rb_rolling_heat_track_step(rc, state, model->carried.heat, t);
        return RB_OK;
    }
    double *scratch = rb_alloc((size_t)n, 3), *power = scratch, *t_b = scratch + n;
    if (!scratch)
        return rb_fail(why, RB_ENOMEM, "out of memory for %d temperatures", n);
    view.slip = scratch + 2 * n;
    for (int i = 0; i < n; i++) {
        view.contact += state->zone[i] != RB_ZONE_SEPARATED;
        view.slip[i] = state->lambda[i] / model->problem.e_T[i];
    }
    rb_rolling_friction_power(&view, power);
    const rb_status s = rb_rolling_steady_temperature(rc, &view, power, power, &model->conduction,
                                                      t, t_b, NULL, NULL, why);
    free(scratch);
    return s;
}

/* How far element i slips; one that slips by the direction of its zone, so that derivatives exist
 * at the end of the zone. */
static double slid_distance(const rb_rolling_model *model, int i)
{
    const int zone = model->state.zone[i];
    const double lambda = model->state.lambda[i];

    return zone == RB_ZONE_SLIP_NEGATIVE   ? lambda
           : zone == RB_ZONE_SLIP_POSITIVE ? -lambda
                                           : fabs(lambda);
}

/* 1: the law takes the slip velocity at the midpoints, where it gives the coefficients. The
 * upstream difference is that half-way to the next one: on equal elements one error of first order
 * among others, on graded ones it would be the only one (F1). */
static int is_taken_at_midpoints(const rb_rolling_case *rc)
{
    return rc->formulation == RB_STEADY &&
           (rc->slip_operator == RB_SLIP_SECOND || rb_rolling_mesh_is_graded(rc));
}

/* Upstream differences are taken from both sides of a midpoint, linearly. What slips by the
 * direction of its zone does so unless the element behind it slips the other way. At rest slip
 * takes no time: it is kinetic at once (F6). */
static double slip_velocity(const rb_rolling_model *model, int i)
{
    const double *c = model->problem.e_T, *lambda = model->state.lambda;
    const double own = slid_distance(model, i) / c[i];

    if (model->rc->formulation == RB_STATIC)
        return INFINITY;
    if (i == 0 || model->rc->slip_operator == RB_SLIP_SECOND || !is_taken_at_midpoints(model->rc))
        return own * model->rc->speed;
    const double behind = lambda[i] * own < 0.0 ? -lambda[i - 1] : lambda[i - 1];
    const double slip = (c[i - 1] * own + c[i] * behind / c[i - 1]) / (c[i - 1] + c[i]);
    return model->rc->speed * (behind == 0.0 ? slip : fabs(slip));
}

double rb_rolling_law_kept(const rb_rolling_model *model, int i)
{
    const rb_rolling_friction *f = &model->rc->friction;
    const int next = i + 1 < model->state.n && model->state.zone[i + 1] != RB_ZONE_SEPARATED &&
                     model->rc->slip_operator == RB_SLIP_SECOND;
    const double *c = model->problem.e_T, own = slid_distance(model, i);
    /* with the mean velocity on the way from the next midpoint */
    const double slid = next ? 0.5 * (own + slid_distance(model, i + 1) / c[i + 1] * c[i]) : own,
                 least = model->rc->formulation == RB_STATIC
                             ? slid
                             : f->memory_slip * model->problem.e_T[i] / model->rc->speed;

    return exp(-fmax(slid, least) / f->memory);
}

/* Mean of exp(-t) from t = 0 to that of which `kept` is left. */
static double mean_kept(double kept)
{
    const double t = -log(kept);

    return t > 1e-5 ? -expm1(-t) / t : 1.0 - 0.5 * t;
}

/* From the leading edge on, in the order in which particles pass (F2); at rest particles stay, and
 * keep what they remember without contact too. */
static void set_coefficients(const rb_rolling_model *model, const double *temperature, double *mu)
{
    const rb_rolling_case *rc = model->rc;
    const rb_rolling_friction *f = &rc->friction;
    const rb_contact_state *state = &model->state;
    const double *x = model->bodies.f.x;
    double law = NAN; /* what the coefficient tends to, at the midpoint before */

    for (int i = state->n - 1; i >= 0; i--) {
        const double at_rest = f->memory != 0.0 || state->zone[i] == RB_ZONE_SEPARATED
                                   ? rb_rolling_law_at_rest(rc, x[i])
                                   : NAN;
        if (state->zone[i] == RB_ZONE_SEPARATED) {
            mu[i] =
                rc->formulation == RB_STATIC && model->carried.mu ? model->carried.mu[i] : at_rest;
            continue;
        }
        const double ahead =
            i + 1 < state->n && state->zone[i + 1] != RB_ZONE_SEPARATED ? law : NAN;
        law = rb_rolling_law_mu(rc, x[i], slip_velocity(model, i),
                                temperature ? temperature[i] : rc->heat_a.temperature);
        mu[i] = law;
        if (f->memory == 0.0)
            continue;
        const double before = rc->formulation == RB_STEADY
                                  ? (i + 1 < state->n ? mu[i + 1] : at_rest)
                                  : (model->carried.mu ? model->carried.mu[i] : at_rest);
        const double kept = rb_rolling_law_kept(model, i);
        mu[i] += (before - law) * kept;
        if (!isnan(ahead) && is_taken_at_midpoints(rc))
            mu[i] += (ahead - law) * (mean_kept(kept) - kept);
    }
}

rb_status rb_rolling_law_coefficients(rb_rolling_model *model, double *mu, rb_message *why)
{
    const int n = model->state.n, is_warm = model->rc->friction.heat != 0.0;
    double *temperature = is_warm ? rb_alloc((size_t)n, 1) : NULL;
    rb_status s = is_warm && !temperature ? RB_ENOMEM : RB_OK;

    if (s == RB_OK && is_warm)
        s = temperatures_of(model, temperature, why);
    if (s == RB_OK)
        set_coefficients(model, temperature, mu);
    free(temperature);
    return s;
}

/* ---- The force --------------------------------------------------------------------- */

static void set_force(rb_rolling_model *model)
{
    const rb_rolling_case *rc = model->rc;
    rb_contact_problem *p = &model->problem;

    if (!p->force_given || p->axle > 0.0)
        return;
    if (!isnan(rc->force_ratio))
        p->force = rc->force_ratio * p->mu * rb_rolling_model_load(model);
    else
        p->force = rc->force;
    p->force_ratio = 0.0;
}

rb_status rb_rolling_model_friction(rb_rolling_model *model, rb_message *why)
{
    rb_contact_problem *p = &model->problem;
    double *mu = rb_alloc((size_t)p->n, 1);
    rb_status s = mu ? RB_OK : RB_ENOMEM;

    if (s == RB_OK && rb_rolling_law_depends_on_state(model->rc)) {
        s = rb_rolling_law_coefficients(model, mu, why);
        set_force(model);
        if (s == RB_OK)
            rb_contact_set_friction(p, p->mu, mu);
    }
    free(mu);
    return s;
}

/* ---- The iteration at a given creepage --------------------------------------------- */

/* The step of a round.  Steps that grow and go on in the same direction leave one
 * solution for another (a jump), which takes some rounds.  Where they turn back and do
 * not become less, or go round for long, half as much of them is taken, and twice as much
 * where they have become less for long. */
typedef struct {
    double part, least, before;
    int most_waited;          /* rounds in which the steps need not become less */
    int turned, waited, fell; /* rounds */
    double *step;             /* n: of the round before */
} relaxation;

static void relax(relaxation *r, const rb_contact_problem *p, double change, double *mu)
{
    enum { TURNS = 4, FELL = 20 };
    const int less = change < 0.95 * r->least;
    double turns = 0.0;

    for (int i = 0; i < p->n; i++)
        turns += (mu[i] - p->bound[i]) * r->step[i];
    r->turned += turns < 0.0 && !less;
    r->waited = less ? 0 : r->waited + 1;
    r->fell = change < r->before ? r->fell + 1 : 0;
    r->least = fmin(r->least, change);
    r->before = change;
    if (r->fell == FELL) {
        r->part = fmin(2.0 * r->part, 1.0);
        r->fell = r->waited = 0;
    } else if (r->turned == TURNS || r->waited == r->most_waited) {
        r->part = fmax(0.5 * r->part, 1.0 / 256.0);
        r->turned = r->waited = 0;
        r->least = change;
    }
    for (int i = 0; i < p->n; i++) {
        r->step[i] = mu[i] - p->bound[i];
        mu[i] = p->bound[i] + r->part * r->step[i];
    }
}

static rb_status measure_residual(rb_rolling_model *model, rb_message *why)
{
    const double allowed = fmax(model->rc->contact.tol, model->problem.rounding);
    rb_contact_violation violation;
    const rb_status s = rb_contact_residual(&model->problem, &model->state, &violation);

    if (s != RB_OK)
        return s;
    model->state.residual = violation.scaled;
    return violation.scaled <= allowed
               ? RB_OK
               : rb_fail(why, RB_INACCURATE,
                         "friction law: the scaled residual with the coefficients of the "
                         "state is %.3g",
                         violation.scaled);
}

/* Which change of the coefficients, as a natural residual, is none. */
static double enough_of(const rb_rolling_model *model)
{
    return fmax(0.1 * model->rc->contact.tol, fmax(model->problem.rounding, 1e-14));
}

/* From the bounds that the problem has: (F1) v -> mu -> contact problem -> v.  Near a
 * solution, where the changes fall by themselves, rounds of many elements, without a
 * matrix, are accelerated.
 * RB_MAXITER: they still change. */
static rb_status go_round(rb_rolling_model *model, int warm, rb_message *why)
{
    enum { ROUNDS = 200, WAITED = 40 };
    static const double NEAR = 0.05, FALLS = 0.7;
    rb_contact_problem *p = &model->problem;
    rb_contact_state *state = &model->state;
    const double enough = enough_of(model);
    const int large = !rb_contact_operator_matrix(p->op).F;
    /* at rest the edge of slip moves by an element or less in a round (F6) */
    const int moves = model->rc->formulation == RB_STATIC ? p->n : 0, rounds = ROUNDS + 4 * moves;
    double change = INFINITY, *mu = rb_alloc((size_t)p->n, 2);
    relaxation r = {
        .part = 1.0, .least = INFINITY, .before = INFINITY, .most_waited = WAITED + moves};
    rb_anderson faster;
    rb_status s = rb_anderson_init(large ? p->n : 0, &faster);

    s = mu ? s : RB_ENOMEM;
    r.step = mu ? mu + p->n : NULL;
    for (int k = 0; k < rounds && s == RB_OK && change > enough; k++) {
        s = rb_rolling_problem_solve(p, model->rc, warm || k > 0, state, why);
        model->iterations += state->iterations;
        if (s == RB_OK)
            s = rb_rolling_law_coefficients(model, mu, why);
        if (s != RB_OK)
            break;
        /* The natural residual that coefficients in the place of the problem's would
         * leave. */
        const double before = change;

        change = 0.0;
        for (int i = 0; i < p->n; i++)
            change = fmax(change, fabs(mu[i] - p->bound[i]) * state->p[i] / (p->mu * p->stress));
        if (change > enough) {
            relax(&r, p, change, mu);
            if (large && r.part == 1.0 && change < NEAR && change < FALLS * before)
                rb_anderson_step(&faster, p->bound, mu, NULL);
            else
                rb_anderson_forget(&faster);
            for (int i = 0; i < p->n; i++)
                mu[i] = fmax(mu[i], 0.0);
        }
        rb_contact_set_friction(p, p->mu, mu);
    }
    rb_anderson_free(&faster);
    free(mu);
    return s == RB_OK && change > enough
               ? rb_fail(why, RB_MAXITER,
                         "friction law: after %d rounds and Newton's method the "
                         "coefficients still change, by %.2g of the largest",
                         rounds, change)
               : s;
}

/* Coefficients that are those of fast sliding up to x, and behind it those at rest. */
rb_status rb_rolling_law_start(rb_rolling_model *model, double x, rb_message *why)
{
    const rb_rolling_case *rc = model->rc;
    const double fastest = rc->formulation == RB_STATIC ? INFINITY : 1e3 * rc->speed,
                 *places = model->bodies.f.x;
    const double warmest = rc->friction.heat_from + 2.0 * rc->friction.heat_range;
    rb_contact_problem *p = &model->problem;
    double *mu = rb_alloc((size_t)p->n, 1);

    if (!mu)
        return rb_fail(why, RB_ENOMEM, "out of memory for a start");
    for (int i = 0; i < p->n; i++)
        mu[i] = places[i] < x ? rb_rolling_law_mu(rc, places[i], fastest, warmest)
                              : rb_rolling_law_at_rest(rc, places[i]);
    rb_contact_set_friction(p, p->mu, mu);
    free(mu);
    return RB_OK;
}

/* Where the iteration leaves every solution, because friction falls steeply there,
 * Newton's method goes on from where it has come, and from other starts. */
static rb_status iterate_coefficients(rb_rolling_model *model, int warm, rb_message *why)
{
    enum { STARTS = 6, MOST = 2000 };
    const double enough = enough_of(model);
    double from, to;
    int left = MOST;
    rb_status s = go_round(model, warm, why);

    if (s != RB_MAXITER)
        return s == RB_OK ? measure_residual(model, why) : s;
    s = rb_rolling_law_newton(model, enough, &left, why);
    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    for (int k = 0; k <= STARTS && s > 0 && left > 0; k++) {
        s = rb_rolling_law_start(model, from + (to - from) * k / STARTS, why);
        s = s == RB_OK ? go_round(model, 1, why) : s;
        if (s == RB_MAXITER)
            s = rb_rolling_law_newton(model, enough, &left, why);
    }
    return s == RB_OK ? measure_residual(model, why) : s;
}

/* ---- A given force ----------------------------------------------------------------- */

/* Q at a creepage that goes away from 0, in the direction in which it is wanted. */
typedef struct {
    rb_rolling_model *model;
    double *start; /* n: bounds that every solve begins with, so that Q is a function */
    double side, unit;
    double small; /* what two forces may differ by */
    rb_message *why;
} search;

/* What is wanted and not reached yet at creepage side x; < 0: too much. */
static rb_status lack(search *s, double x, double *f)
{
    rb_rolling_model *model = s->model;
    rb_contact_problem *p = &model->problem;

    p->force_given = 0;
    p->xi = s->side * x;
    rb_contact_set_friction(p, p->mu, s->start);
    const rb_status status = iterate_coefficients(model, 1, s->why);
    p->force_given = 1;
    set_force(model);
    *f = s->side *
         (rb_rolling_model_force(model) - p->force + p->axle * rb_contact_moment(p, &model->state));
    return status;
}

/* Goes on until the force is reached, x[0] and x[1] on either side of it, or does not
 * grow any more.  A force that still opposes the wanted direction is that before free
 * rolling: on its falling branch it grows first. */
static rb_status go_on(search *s, double x[3], double f[3])
{
    const double far = 1e6 * s->unit;
    double step = s->unit / 32.0;
    rb_status status = RB_OK;

    x[1] = x[0];
    f[1] = f[0];
    while (status == RB_OK && f[1] > 0.0 && x[1] < far) {
        const int opposed = s->side * rb_rolling_model_force(s->model) > 0.0;
        x[2] = x[1] + step;
        step *= 2.0;
        status = lack(s, x[2], &f[2]);
        if (status == RB_OK && f[2] >= f[1] && !opposed) {
            /* Between x[0] and x[2] the lack is least near x[1]: golden sections until it
             * is none, or as little as there is. */
            static const double GOLDEN = 0.381966011250105;

            while (status == RB_OK && f[1] > 0.0 && x[2] - x[0] > 1e-6 * x[2]) {
                const int right = x[2] - x[1] > x[1] - x[0];
                const double next = x[1] + GOLDEN * (right ? x[2] - x[1] : x[0] - x[1]);
                double g;
                status = lack(s, next, &g);
                /* behind a jump to full sliding the force is the same: then it is before it */
                const int better = right ? g < f[1] - s->small : g <= f[1] + s->small;
                const int end = right == better ? 0 : 2;
                x[end] = better ? x[1] : next;
                f[end] = better ? f[1] : g;
                if (better) {
                    x[1] = next;
                    f[1] = g;
                }
            }
            return status;
        }
        x[0] = x[1];
        f[0] = f[1];
        x[1] = x[2];
        f[1] = f[2];
    }
    return status;
}

/* Regula falsi (Illinois) between x[0], where the force is lacking, and x[1]. */
static rb_status find_force(search *s, double x[2], double f[2], double small)
{
    enum { ROUNDS = 200 };
    int kept = -1;

    for (int k = 0; k < ROUNDS; k++) {
        const double middle = 0.5 * (x[0] + x[1]);
        double next = x[0] + (x[1] - x[0]) * f[0] / (f[0] - f[1]), g;
        if (!(next > x[0] && next < x[1]) || k % 8 == 7)
            next = middle;
        const rb_status status = lack(s, next, &g);
        if (status != RB_OK || fabs(g) <= small)
            return status;
        if (!(middle > x[0] && middle < x[1]))
            break;
        const int end = g > 0.0 ? 0 : 1;
        x[end] = next;
        f[end] = g;
        if (kept == 1 - end)
            f[1 - end] *= 0.5;
        kept = 1 - end;
    }
    return rb_fail(
        s->why, RB_MAXITER, "friction law: at %s %g the force jumps past the given value",
        s->model->rc->formulation == RB_STATIC ? "a shift of" : "creepage", s->side * x[1]);
}

/* The iteration with a given force, from the current state.  A force that refers to the
 * load is set again until the load does not change any more.  RB_MAXITER: its creepage is
 * not one of those between which the force is reached. */
static rb_status solve_between(search *s, double from, double to, double small)
{
    enum { ROUNDS = 40 };
    rb_rolling_model *model = s->model;
    rb_contact_problem *p = &model->problem;
    double before = INFINITY;
    rb_status status = RB_OK;

    for (int k = 0; k < ROUNDS && status == RB_OK && fabs(p->force - before) > small; k++) {
        before = p->force;
        status = iterate_coefficients(model, 1, NULL);
        set_force(model);
    }
    const double x = s->side * model->state.xi;
    return status == RB_OK && !(x >= from && x <= to) ? RB_MAXITER : status;
}

/* From creepage 0 along the branch on which the force grows with the creepage (F4). */
static rb_status solve_force(rb_rolling_model *model, rb_message *why)
{
    rb_contact_problem *p = &model->problem;
    search by = {model, rb_alloc((size_t)p->n, 1), 1.0, 0.0, 0.0, why};
    double x[3] = {0.0}, f[3] = {0.0};
    rb_status s = by.start ? RB_OK : RB_ENOMEM;

    by.unit = rb_rolling_sliding_creepage(model->rc, p);
    if (s == RB_OK) {
        memcpy(by.start, p->bound, (size_t)p->n * sizeof *by.start);
        s = lack(&by, 0.0, &f[0]);
    }
    const double small = by.small =
        0.1 * fmax(model->rc->contact.tol, p->rounding) * rb_contact_capacity(p, &model->state);
    if (s == RB_OK && fabs(f[0]) > small) {
        by.side = f[0] > 0.0 ? 1.0 : -1.0;
        f[0] = fabs(f[0]);
        s = go_on(&by, x, f);
        if (s == RB_OK && f[1] > 0.0) {
            model->state.refused_at = by.side * x[1];
            const int rests = model->rc->formulation == RB_STATIC;
            s = rb_refuse(why, "force,force-ratio",
                          "Q = %.10g N/mm: with this friction law the largest is %g N/mm, "
                          "at %s %g%s",
                          p->force, rb_largest_shown(p->force + by.side * f[1]),
                          rests ? "a shift of" : "creepage",
                          by.side * x[1] + (rests ? model->shift : 0.0), rests ? " mm" : "");
        } else if (s == RB_OK) {
            /* The force is lacking at x[0] and reached at x[1].  Where a creepage has
             * several states and the search falls on one or another of them, the force
             * tells them apart. */
            const double from = x[0], to = x[1];
            const rb_status status = find_force(&by, x, f, small);

            s = status > 0 && solve_between(&by, from, to, small) == RB_OK ? RB_OK : status;
        }
    }
    free(by.start);
    return s == RB_OK ? measure_residual(model, why) : s;
}

/* From the solution of the same case on other elements: the force is reached close to its
 * creepage.  RB_MAXITER: it is not. */
static rb_status follow_force(rb_rolling_model *model)
{
    enum { ROUNDS = 40 };
    static const double CLOSE = 0.02;
    rb_contact_problem *p = &model->problem;
    const double xi = model->state.xi;
    const double unit = rb_rolling_sliding_creepage(model->rc, p);
    double before = INFINITY, small = 0.0;
    rb_status s = RB_OK;

    for (int k = 0; k < ROUNDS && s == RB_OK && fabs(p->force - before) > small; k++) {
        before = p->force;
        s = go_round(model, 1, NULL);
        set_force(model);
        small =
            0.1 * fmax(model->rc->contact.tol, p->rounding) * rb_contact_capacity(p, &model->state);
    }
    if (s == RB_OK && !(fabs(model->state.xi - xi) <= CLOSE * unit))
        s = RB_MAXITER;
    return s == RB_OK ? measure_residual(model, NULL) : s;
}

rb_status rb_rolling_law_solve(rb_rolling_model *model, int warm, rb_message *why)
{
    rb_contact_problem *p = &model->problem;
    const int follows = model->follows;
    rb_status s = RB_MAXITER;

    /* At rest, from the coefficients before the step: the rounds come down to the state with the
     * most friction, that which follows from them (F6). */
    if (model->rc->formulation == RB_STATIC) {
        rb_rolling_start_bounds(model->rc, NULL, &model->bodies, p);
        if (model->carried.mu)
            rb_contact_set_friction(p, p->mu, model->carried.mu);
    }
    model->follows = 0;
    if (p->force_given && follows) {
        s = follow_force(model);
        if (s > 0)
            rb_rolling_start_bounds(model->rc, model->plan.start, &model->bodies, p);
    }
    if (s > 0)
        s = p->force_given ? solve_force(model, why) : iterate_coefficients(model, warm, why);
    return model->state.status = s;
}

/* ---- Uniqueness -------------------------------------------------------------------- */

/* The largest eigenvalue of B diag(pressure), B the slips of unit friction, which is
 * nearly symmetric: the power method.  scratch: 4n, of zeros. */
static double largest_answer(const rb_contact_problem *p, const double *pressure, double *scratch)
{
    enum { ROUNDS = 40 };
    const size_t n = (size_t)p->n;
    double *none = scratch, *q = scratch + n, *gap = q + n, *slip = gap + n, norm = 0.0;

    for (size_t i = 0; i < n; i++)
        slip[i] = pressure[i] > 0.0;
    for (int k = 0; k < ROUNDS; k++) {
        const double size = rb_norm_inf(n, slip);
        for (size_t i = 0; i < n; i++) {
            q[i] = size > 0.0 && pressure[i] > 0.0 ? pressure[i] * slip[i] / size : 0.0;
            gap[i] = slip[i] = 0.0;
        }
        rb_contact_operator_add(p->op, none, q, gap, slip);
        for (size_t i = 0; i < n; i++)
            slip[i] = pressure[i] > 0.0 ? slip[i] : 0.0;
        norm = rb_norm_inf(n, slip);
    }
    return norm;
}

double rb_rolling_law_kappa_of(const rb_rolling_model *model, int element)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_matrix K = rb_contact_operator_matrix(p->op);
    const size_t n = (size_t)p->n, i = (size_t)element;
    const double own = K.F ? K.S[i + (n + i) * n] : rb_contact_operator_response(p->op).slip;

    return model->rc->speed * model->state.p[i] * own / p->e_T[i] *
           rb_rolling_law_steepest(model->rc, p->e_T[i]);
}

int rb_rolling_law_kappa_element(const rb_rolling_model *model)
{
    int most = -1;

    for (int i = 0; i < model->problem.n && model->rc->formulation == RB_STEADY; i++)
        if (most < 0 || rb_rolling_law_kappa_of(model, i) > rb_rolling_law_kappa_of(model, most))
            most = i;
    return most;
}

/* (F3) In steady rolling an element has neighbours that differ: what counts is its own
 * slip per traction.  In a step all elements may answer together. */
rb_status rb_rolling_law_kappa(const rb_rolling_model *model, double *kappa)
{
    const rb_contact_problem *p = &model->problem;
    const int most = rb_rolling_law_kappa_element(model);
    double *scratch;

    *kappa = most < 0 ? 0.0 : fmax(0.0, rb_rolling_law_kappa_of(model, most));
    if (model->rc->formulation == RB_STEADY)
        return RB_OK;
    *kappa = NAN;
    if (model->rc->formulation == RB_STATIC) /* it follows its path (F6) */
        return RB_OK;
    if (!(scratch = rb_alloc((size_t)p->n, 4)))
        return RB_ENOMEM;
    *kappa = model->rc->speed * largest_answer(p, model->state.p, scratch) / p->e_T[0] *
             rb_rolling_law_steepest(model->rc, p->e_T[0]);
    free(scratch);
    return RB_OK;
}
