/* A given force: full sliding, the most that friction or a layer carries, and a force that is
 * sought by its creepage; and layers that yield, which need to know the most, too. */
#include "lcp/contact/internal.h"
#include "base/sizes.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Full sliding ------------------------------------------------------------------ */

/* Every creepage beyond a least one will do: finds one by doubling, then the least, which
 * has the same tractions. */
static rb_status solve_sliding(rb_contact_problem *problem, const rb_contact_options *options,
                               int backwards, rb_contact_state *state, rb_message *why)
{
    const double sign = backwards ? -1.0 : 1.0;
    rb_contact_problem given = *problem; /* arrays stay the problem's */

    given.force_given = 0;
    given.xi = sign * problem->sliding;
    for (int k = 0; k < 40; k++, given.xi *= 2.0) {
        const rb_status s = rb_contact_solve_given(&given, options, 0, state, why);
        if (s != RB_OK)
            return s;
        /* Creepage by which the slowest element still slides; 0 where something sticks. */
        double spare = INFINITY;
        for (int i = 0; i < given.n; i++)
            if (state->zone[i] != RB_ZONE_SEPARATED)
                spare = state->zone[i] == RB_ZONE_STICK
                            ? 0.0
                            : fmin(spare, fabs(state->lambda[i] / given.e_T[i]));
        if (spare > 0.0 && sign * given.xi > 0.0) {
            if (problem->yield) /* less slip yields less */
                return RB_OK;
            state->xi -= sign * spare;
            for (int i = 0; i < problem->n; i++)
                state->lambda[i] -= sign * spare * problem->e_T[i];
            return RB_OK;
        }
    }
    return RB_MAXITER;
}

/* Where elements are tilted P has a part of the friction and Q one of the pressure: full
 * sliding is not the force that was given then. */
rb_status rb_contact_solve_full_sliding(rb_contact_problem *problem,
                                        const rb_contact_options *options, rb_contact_state *state,
                                        rb_message *why)
{
    rb_status s = solve_sliding(problem, options, problem->force_ratio > 0.0, state, why);
    if (s == RB_OK)
        s = rb_contact_measure(problem, state);
    if (s == RB_OK && !rb_contact_is_solved(s, problem, options, state))
        s = rb_contact_solve_given(problem, options, 0, state, why);
    return s;
}

/* Whether a given force is more than a layer that does not harden carries: RB_EINVAL. The
 * most is that of full sliding, or, where the layer softens, the largest along the creep
 * curve: beyond it more slip carries less. */
static rb_status check_layer(rb_contact_problem *problem, const rb_contact_options *options,
                             rb_contact_state *state, rb_contact_state *refused, rb_message *why)
{
    enum { POINTS = 40, SECTIONS = 30 };
    static const double GOLDEN = 0.381966011250105;
    const char *unit = problem->force_unit ? problem->force_unit : "";
    const int backwards = problem->force + problem->force_ratio > 0.0;
    rb_contact_problem given = *problem; /* arrays stay the problem's */
    double most = 0.0, at = 0.0;
    rb_status s = RB_OK;

    given.force_given = 0;
    if (problem->hardening < 0.0) {
        /* the best of equally distant creepages, then golden sections beside it */
        const double step = (backwards ? -1.0 : 1.0) * problem->sliding / POINTS;
        double inner = 0.0, outer = step * POINTS;
        for (int k = 1; k <= POINTS + SECTIONS && s == RB_OK; k++) {
            const int right = fabs(outer - at) > fabs(at - inner);
            given.xi = k <= POINTS ? step * k : at + GOLDEN * (right ? outer - at : inner - at);
            s = rb_contact_solve_given(&given, options, k > 1, state, NULL);
            const double force = fabs(rb_contact_force(problem, state));
            const int better = s == RB_OK && force > most;
            if (k > POINTS && better)
                *(right ? &inner : &outer) = at;
            else if (k > POINTS)
                *(right ? &outer : &inner) = given.xi;
            if (better) {
                most = force;
                at = given.xi;
            }
            if (k == POINTS) {
                inner = at - step;
                outer = at + step;
            }
        }
    } else {
        s = solve_sliding(problem, options, backwards, state, NULL);
        most = fabs(rb_contact_force(problem, state));
        at = state->xi;
    }
    const double Q = problem->force + problem->force_ratio * rb_contact_capacity(problem, state);
    if (s != RB_OK || fabs(Q) <= most)
        return s;
    refused->refused_at = at;
    return rb_refuse(why, "force", "Q = %.10g%s: the interface yields, and carries at most %g%s", Q,
                     unit, rb_largest_shown(most), unit);
}

/* Whether a given force is more than friction carries under the load that the approach
 * brings, or the resistance to rolling more than friction can turn: RB_EINVAL, and the refused
 * state says at which creepage friction carries most.  A layer that hardens carries with more
 * slip all that the friction of the surfaces does.  Full sliding, which has that load, is
 * solved in a state of its own, because the state that failed is what the caller prints. */
rb_status rb_contact_check_capacity(rb_contact_problem *problem, const rb_contact_options *options,
                                    rb_contact_state *refused, rb_message *why)
{
    const char *unit = problem->force_unit ? problem->force_unit : "";
    rb_contact_state sliding;
    double most = 0.0, resistance = 0.0;
    rb_status s = rb_contact_state_alloc(problem->n, &sliding);

    if (s == RB_OK && problem->yield && problem->hardening <= 0.0 && problem->axle == 0.0) {
        s = check_layer(problem, options, &sliding, refused, why);
        rb_contact_state_free(&sliding);
        return s < 0 ? s : RB_OK;
    }
    if (s == RB_OK)
        s = solve_sliding(problem, options, problem->force > 0.0, &sliding, NULL);
    if (s == RB_OK) {
        most = rb_contact_capacity(problem, &sliding);
        resistance = problem->axle * rb_contact_moment(problem, &sliding);
    }
    if (s == RB_OK && fmax(resistance, fabs(problem->force)) > most)
        refused->refused_at = sliding.xi;
    rb_contact_state_free(&sliding);
    if (s == RB_OK && resistance > most)
        return rb_refuse(why, "free-axle",
                         "the resistance to rolling M/R_A = %g%s is more than "
                         "friction carries, mu P = %g%s",
                         resistance, unit, most, unit);
    if (s == RB_OK && fabs(problem->force) > most)
        return rb_refuse(why, "force", "Q = %.10g%s: friction carries at most mu P = %g%s%s",
                         problem->force, unit, rb_largest_shown(most), unit,
                         problem->load_given ? "" : " at this approach");
    return s < 0 ? s : RB_OK;
}

/* ---- A force that all methods fail on --------------------------------------------- */

/* A given force that all methods fail on, as where a contact returns to the state of an earlier
 * step and elements are undecided between stick and slip.  Q falls where xi grows: xi by bisection,
 * where Newton's method knows xi, and from each of these solutions Newton's steps for the force
 * itself. */
rb_status rb_contact_by_creepage(rb_contact_problem *problem, const rb_contact_options *options,
                                 rb_contact_state *state)
{
    enum { HALVINGS = 50 };
    const size_t n = (size_t)problem->n;
    rb_contact_problem given = *problem; /* arrays stay the problem's */
    double *row = rb_alloc(n, 2), reach = problem->sliding;
    rb_contact_state known;
    rb_status s = rb_contact_state_alloc(problem->n, &known);

    if (s == RB_OK && !row)
        s = RB_ENOMEM;
    if (s == RB_OK) {
        /* Beyond this creepage, or shift, all slides, also where earlier steps have left some. None
         * is known where an element does not move with it (e_T = 0): then nothing is sought. */
        for (size_t i = 0; i < n; i++)
            reach = fmax(reach, problem->sliding + fabs(problem->d_T[i] / problem->e_T[i]));
        double low = -reach, high = reach;
        given.force_given = 0;
        rb_contact_force_row(problem, row, row + n);
        s = RB_MAXITER;
        for (int k = 0;
             k < HALVINGS && s > 0 && isfinite(reach) && rb_contact_has_steps_left(problem, &known);
             k++) {
            given.xi = 0.5 * (low + high);
            s = rb_contact_solve_given(&given, options, k > 0, &known, NULL);
            if (s != RB_OK)
                break;
            const double force = cblas_ddot(problem->n, row, 1, known.p, 1) +
                                 cblas_ddot(problem->n, row + n, 1, known.q, 1);
            *(force > problem->force ? &low : &high) = given.xi;
            rb_contact_copy_start(&known, state);
            rb_contact_hold_slowest(problem, &known, state->zone);
            s = rb_contact_proven(rb_contact_by_newton(problem, options, 1, state), problem,
                                  options, state);
        }
        state->iterations += known.iterations;
    }
    rb_contact_state_free(&known);
    free(row);
    return s;
}

/* ---- A layer that yields ----------------------------------------------------------- */

static rb_status solve_yield_newton(rb_contact_problem *problem, const rb_contact_options *options,
                                    int follows, rb_contact_state *state)
{
    const rb_status s = rb_contact_yield_newton(problem, follows, state);

    return rb_contact_proven(rb_contact_end_newton(problem, options, s, state), problem, options,
                             state);
}

/* Where the friction of the surfaces without the layer stays below its yield stress, that
 * is the solution; else the start, at once or step by step. */
static rb_status solve_from_coulomb(rb_contact_problem *problem, const rb_contact_options *options,
                                    int warm, int follows, rb_contact_state *state, rb_message *why)
{
    double *const yield = problem->yield;

    memset(state->plastic, 0, (size_t)problem->n * sizeof *state->plastic);
    problem->yield = NULL;
    const rb_status s = rb_contact_solve_given(problem, options, warm, state, why);
    problem->yield = yield;
    if (s < 0 || (s == RB_OK && !rb_contact_yields(problem, state)))
        return s;
    return s > 0 && follows ? s : solve_yield_newton(problem, options, follows, state);
}

static int holds_yielding(const rb_contact_state *state)
{
    int yields = 0;
    for (int i = 0; i < state->n; i++)
        yields |= state->zone[i] >= RB_ZONE_YIELD_NEGATIVE || state->plastic[i] != 0.0;
    return yields;
}

/* Newton's method in a few steps nearly always; a force that cannot be carried is found
 * before the long ways. */
rb_status rb_contact_solve_yielding(rb_contact_problem *problem, const rb_contact_options *options,
                                    int warm, rb_contact_state *state, rb_message *why)
{
    const int lemke =
        options->solver == RB_SOLVER_LEMKE && rb_contact_operator_matrix(problem->op).F != NULL;
    const int yields = warm && holds_yielding(state);
    rb_status s = RB_MAXITER;

    if (lemke) {
        s = rb_contact_proven(rb_contact_by_lemke(problem, options, state, why), problem, options,
                              state);
    } else if (yields) {
        s = solve_yield_newton(problem, options, 0, state);
    }
    if (s > 0)
        s = solve_from_coulomb(problem, options, warm && !yields, 0, state, why);
    if (s > 0 && problem->force_given) {
        const rb_status t = rb_contact_check_capacity(problem, options, state, why);
        s = t < 0 ? t : s;
    }
    if (s > 0)
        s = solve_from_coulomb(problem, options, 0, 1, state, why);
    if (s > 0 && !lemke && problem->n <= RB_CONTACT_LEMKE_UP_TO &&
        rb_contact_operator_matrix(problem->op).F)
        s = rb_contact_by_lemke(problem, options, state, why);
    return rb_contact_proven(s, problem, options, state);
}
