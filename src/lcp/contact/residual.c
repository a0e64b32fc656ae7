/* The residual of a solution (4.4): how far tractions and motion, by themselves, violate the scaled
 * (K1)-(K3); and the zones that they mean. */
#include "lcp/contact/internal.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

rb_contact_zone rb_contact_sliding_zone(double lambda)
{
    return lambda >= 0.0 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_SLIP_POSITIVE;
}

rb_status rb_contact_state_alloc(int n, rb_contact_state *state)
{
    memset(state, 0, sizeof *state);
    state->n = n;
    state->p = rb_alloc((size_t)n, 1);
    state->q = rb_alloc((size_t)n, 1);
    state->lambda = rb_alloc((size_t)n, 1);
    state->plastic = rb_alloc((size_t)n, 1);
    state->zone = rb_alloc_int((size_t)n);
    if (state->p && state->q && state->lambda && state->plastic && state->zone)
        return RB_OK;
    rb_contact_state_free(state);
    return RB_ENOMEM;
}

void rb_contact_state_free(rb_contact_state *state)
{
    free(state->p);
    free(state->q);
    free(state->lambda);
    free(state->plastic);
    free(state->zone);
    memset(state, 0, sizeof *state);
}

void rb_contact_copy_start(const rb_contact_state *from, rb_contact_state *to)
{
    const size_t count = (size_t)to->n;

    memcpy(to->zone, from->zone, count * sizeof(int));
    memcpy(to->p, from->p, count * sizeof(double));
    memcpy(to->q, from->q, count * sizeof(double));
    to->delta = from->delta;
    to->xi = from->xi;
}

void rb_contact_kinematics(const rb_contact_problem *problem, const rb_contact_state *state,
                           double *gap, double *lambda)
{
    for (int i = 0; i < problem->n; i++) {
        gap[i] = problem->d_N[i] - state->delta;
        lambda[i] = problem->d_T[i] + state->xi * problem->e_T[i];
    }
    rb_contact_operator_add(problem->op, state->p, state->q, gap, lambda);
}

/* Coulomb's law in natural form: min(lambda+, gamma+) and min(lambda-, gamma-), with
 * gamma+- = mu p +- q (K3); the larger, for scaled arguments.  A layer yields by the same
 * law with its plastic slip and its yield stress (Y1). */
static double friction_violation(double lambda, double gamma_plus, double gamma_minus)
{
    const double plus = fmin(fmax(lambda, 0.0), gamma_plus);
    const double minus = fmin(fmax(-lambda, 0.0), gamma_minus);
    return fmax(fabs(plus), fabs(minus));
}

/* How the elements have moved; n each. */
typedef struct {
    double *gap, *lambda, *yielded;
} motion;

rb_status rb_contact_residual(const rb_contact_problem *problem, const rb_contact_state *state,
                              rb_contact_violation *v)
{
    const int n = problem->n;
    double *gap = rb_alloc((size_t)n, 3);

    if (!gap)
        return RB_ENOMEM;
    const motion m = {gap, gap + n, gap + 2 * n};
    memset(v, 0, sizeof *v);
    rb_contact_kinematics(problem, state, m.gap, m.lambda);
    if (problem->yield)
        rb_contact_yielded(problem, state->plastic, NULL, m.yielded);
    /* Given load and force, relative to themselves. */
    double worst = 0.0;

    if (problem->load_given)
        worst = fabs(rb_contact_load(problem, state) - problem->load) / problem->load;
    if (problem->force_given) {
        const double most = rb_contact_capacity(problem, state);
        const double wanted = problem->force + problem->force_ratio * most -
                              problem->axle * rb_contact_moment(problem, state);
        /* The force on a free axle cannot be known closer than to some units of rounding of the
         * pressures, whose moments nearly cancel.  Next to mu P this is more than a tolerance where
         * mu is less than about 1e-7. */
        enum { UNITS = 4 };
        double moments = 0.0;
        for (int i = 0; i < n && problem->axle > 0.0; i++)
            moments += fabs(problem->moment_N[i] * state->p[i]);
        const double off = fabs(rb_contact_force(problem, state) - wanted) -
                           UNITS * DBL_EPSILON * problem->axle * moments;
        worst = fmax(worst, fmax(0.0, off) / most);
    }
    v->scaled = worst;
    for (int i = 0; i < n; i++) {
        /* The four values of one element, each kept where it is the largest so far. */
        const double tangential = rb_contact_friction_scale(problem), length = problem->slip_length,
                     limit = problem->bound[i] * state->p[i];
        const double gamma_plus = limit + state->q[i], gamma_minus = limit - state->q[i];
        /* (K1) min(y_N, r_N) = 0, and (K3), in units in which all four are of order one. */
        const double contact =
            fabs(fmin(m.gap[i] / problem->gap_length, state->p[i] / problem->stress));
        double coulomb = friction_violation((m.lambda[i] - state->plastic[i]) / length,
                                            gamma_plus / tangential, gamma_minus / tangential);

        if (problem->yield) {
            const double yield = rb_contact_yield_stress(problem, i, m.yielded[i]);
            coulomb = fmax(coulomb, friction_violation(state->plastic[i] / length,
                                                       (yield + state->q[i]) / tangential,
                                                       (yield - state->q[i]) / tangential));
            v->friction = fmax(v->friction, fabs(state->q[i]) - yield);
        }
        v->scaled = fmax(v->scaled, fmax(contact, coulomb));
        v->gap = fmax(v->gap, contact * problem->gap_length);
        v->slip = fmax(v->slip, coulomb * problem->slip_length);
        v->friction = fmax(v->friction, -fmin(gamma_plus, gamma_minus));
        /* fmax drops a NaN, which must not pass for a solution. */
        if (isnan(state->p[i]) || isnan(state->q[i]))
            v->scaled = INFINITY;
    }
    if (!isfinite(state->delta) || !isfinite(state->xi))
        v->scaled = INFINITY;
    free(gap);
    return RB_OK;
}

/* Of two complementary numbers the larger one says which of both is zero: slip outweighs what
 * friction lacks of its bound, or it is rounding and the element sticks.  Scaled arguments. */
static rb_contact_zone zone_of(double p, double lambda, double gamma_plus, double gamma_minus,
                               int frictionless)
{
    if (!(p > 0.0))
        return RB_ZONE_SEPARATED;
    if (frictionless)
        return rb_contact_sliding_zone(lambda);
    if (lambda > gamma_plus)
        return RB_ZONE_SLIP_NEGATIVE;
    if (-lambda > gamma_minus)
        return RB_ZONE_SLIP_POSITIVE;
    return RB_ZONE_STICK;
}

void rb_contact_classify(const rb_contact_problem *problem, double tol, rb_contact_state *state)
{
    const double tangential = rb_contact_friction_scale(problem), length = problem->slip_length;
    double next = 0.0, second = 0.0;

    /* From the leading edge on: accumulated plastic slip comes with the material (Y1). */
    for (int i = problem->n - 1; i >= 0; i--) {
        const double limit = problem->bound[i] * state->p[i], q = state->q[i];
        const double u = problem->recall[0] * next + problem->recall[1] * second +
                         problem->own * fabs(state->plastic[i]);
        state->zone[i] = zone_of(
            state->p[i] / problem->stress - tol, (state->lambda[i] - state->plastic[i]) / length,
            (limit + q) / tangential, (limit - q) / tangential, problem->bound[i] == 0.0);
        if (problem->yield && state->zone[i] == RB_ZONE_STICK) {
            /* What neither slips nor is separated may yield, by more than its stress lacks. */
            const double plastic = state->plastic[i];
            const double lacks = (rb_contact_yield_stress(problem, i, u) - fabs(q)) / tangential;

            if (fabs(plastic) / length > fmax(lacks, 0.0))
                state->zone[i] = plastic > 0.0 ? RB_ZONE_YIELD_NEGATIVE : RB_ZONE_YIELD_POSITIVE;
        }
        second = next;
        next = u;
    }
}
