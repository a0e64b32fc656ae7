/* Tractions and motion, from whatever method, completed to a state: slip, zones, and the residual,
 * which alone says whether the problem is solved (4.4). */
#include "lcp/contact/internal.h"

#include <math.h>
#include <string.h>

/* Below this part of the stress scale a traction is rounding; below the second one a scaled
 * residual is, and does not tell which of two states is the better. */
static const double ROUNDING = 1e-12, SAME_RESIDUAL = 1e-14;

rb_status rb_contact_measure(const rb_contact_problem *problem, rb_contact_state *state)
{
    rb_contact_violation violation;
    const rb_status s = rb_contact_residual(problem, state, &violation);

    if (s == RB_OK)
        state->residual = violation.scaled;
    return s;
}

void rb_contact_hold_slowest(const rb_contact_problem *p, const rb_contact_state *state, int *zone)
{
    int slowest = -1;
    double least = INFINITY;

    for (int i = 0; i < p->n; i++) {
        const double speed = fabs(state->lambda[i] / p->e_T[i]);
        if (zone[i] == RB_ZONE_STICK)
            return;
        if (zone[i] != RB_ZONE_SEPARATED && speed < least) {
            least = speed;
            slowest = i;
        }
    }
    if (slowest >= 0)
        zone[slowest] = RB_ZONE_STICK;
}

/* lambda, zones and residual of p, q, delta, xi.  exact: they solve the equations of
 * their zones already, as Newton's do. */
rb_status rb_contact_complete(rb_contact_problem *problem, int exact, rb_contact_state *state)
{
    rb_arena scratch = {0};
    double *gap = rb_arena_doubles(&scratch, (size_t)problem->n, 1);
    /* A cone solver leaves rounding where its elements are separated: no traction there.
     * What is more than rounding stays, and the residual tells it. */
    const double most = ROUNDING * problem->stress;

    if (!gap)
        return rb_arena_done(&scratch, RB_ENOMEM);
    /* Gaps and slips of the tractions (K1, K2), and the zones that they mean. */
    rb_contact_kinematics(problem, state, gap, state->lambda);
    rb_contact_classify(problem, ROUNDING, state);
    for (int i = 0; i < problem->n; i++)
        if (state->zone[i] == RB_ZONE_SEPARATED && fabs(state->p[i]) <= most &&
            fabs(state->q[i]) <= most)
            state->p[i] = state->q[i] = 0.0;
    rb_status s = rb_contact_measure(problem, state);
    if (s == RB_OK && !exact) {
        /* One exact solve with the zones of the state (5.2), kept unless that makes it worse: the
         * rounding errors of a path of pivots are gone. */
        const size_t bytes = (size_t)problem->n * sizeof(double);
        rb_contact_state trial;
        s = rb_contact_state_alloc(problem->n, &trial);
        if (s == RB_OK) {
            memcpy(trial.zone, state->zone, (size_t)problem->n * sizeof(int));
            if (problem->force_given && !problem->yield)
                rb_contact_hold_slowest(problem, state, trial.zone);
            if (problem->yield) {
                memcpy(trial.p, state->p, bytes);
                memcpy(trial.q, state->q, bytes);
                memcpy(trial.lambda, state->lambda, bytes);
                memcpy(trial.plastic, state->plastic, bytes);
            }
            s = problem->yield ? rb_contact_yield_polish(problem, &trial)
                               : rb_contact_solve_zones(problem, RB_BOTH, &trial);
        }
        if (s == RB_OK)
            s = rb_contact_measure(problem, &trial);
        if (s == RB_OK && trial.residual < fmax(state->residual, SAME_RESIDUAL)) {
            memcpy(state->p, trial.p, bytes);
            memcpy(state->q, trial.q, bytes);
            memcpy(state->plastic, trial.plastic, bytes);
            if (!problem->yield)
                memcpy(state->zone, trial.zone, (size_t)problem->n * sizeof(int));
            state->delta = trial.delta;
            state->xi = trial.xi;
            state->residual = trial.residual;
        }
        rb_contact_state_free(&trial);
        s = s == RB_SINGULAR ? RB_OK : s;
        rb_contact_kinematics(problem, state, gap, state->lambda);
    }
    if (s != RB_OK)
        return rb_arena_done(&scratch, s);
    /* In stick the slip is zero, where it is rounding; without friction an element slides as it
     * moves. */
    for (int i = 0; i < problem->n; i++) {
        if (state->zone[i] == RB_ZONE_STICK)
            state->lambda[i] = 0.0;
        else if (state->zone[i] != RB_ZONE_SEPARATED && problem->bound[i] == 0.0)
            state->zone[i] = rb_contact_sliding_zone(state->lambda[i]);
        if (state->zone[i] <= RB_ZONE_STICK)
            state->plastic[i] = 0.0;
    }
    return rb_arena_done(&scratch, RB_OK);
}

int rb_contact_is_solved(rb_status s, const rb_contact_problem *problem,
                         const rb_contact_options *options, const rb_contact_state *state)
{
    return s == RB_OK && state->residual <= fmax(options->tol, problem->rounding);
}

/* s, but where the residual says that a solution is none. */
rb_status rb_contact_proven(rb_status s, const rb_contact_problem *problem,
                            const rb_contact_options *options, const rb_contact_state *state)
{
    return s == RB_OK && !rb_contact_is_solved(s, problem, options, state) ? RB_INACCURATE : s;
}
