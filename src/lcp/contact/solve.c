/* The order in which the attempts of Lemke's method and Newton's method are made. */
#include "lcp/contact/internal.h"
#include "base/sizes.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* On the way to all of the friction: where it begins at the earliest, and the least step,
 * as shares of it. */
enum { MOST_HALVINGS = 6 };
static const double LEAST_STEP = 1e-4;
/* Below this part of the stress scale a traction is rounding. */
static const double ROUNDING = 1e-12;

static rb_status measure(const rb_contact_problem *problem, rb_contact_state *state)
{
    rb_contact_violation violation;
    const rb_status s = rb_contact_residual(problem, state, &violation);

    if (s == RB_OK)
        state->residual = violation.scaled;
    return s;
}

/* lambda, zones and residual of p, q, delta, xi.  exact: they solve the equations of
 * their zones already, as Newton's do. */
static rb_status complete(rb_contact_problem *problem, int exact, rb_contact_state *state)
{
    rb_arena scratch = {0};
    double *gap = rb_arena_doubles(&scratch, (size_t)problem->n, 1);
    /* A cone solver leaves rounding where its elements are separated: no traction there.
     * What is more than rounding stays, and the residual tells it. */
    const double most = ROUNDING * problem->stress;

    if (!gap)
        return rb_arena_done(&scratch, RB_ENOMEM);
    rb_contact_kinematics(problem, state, gap, state->lambda);
    rb_contact_classify(problem, ROUNDING, state);
    for (int i = 0; i < problem->n; i++)
        if (state->zone[i] == RB_ZONE_SEPARATED && fabs(state->p[i]) <= most &&
            fabs(state->q[i]) <= most)
            state->p[i] = state->q[i] = 0.0;
    rb_status s = measure(problem, state);
    if (s == RB_OK && !exact) {
        /* One solve with the zones of the state, kept when that makes it better. */
        const size_t bytes = (size_t)problem->n * sizeof(double);
        rb_contact_state trial;
        s = rb_contact_state_alloc(problem->n, &trial);
        if (s == RB_OK) {
            memcpy(trial.zone, state->zone, (size_t)problem->n * sizeof(int));
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
            s = measure(problem, &trial);
        if (s == RB_OK && trial.residual < state->residual) {
            memcpy(state->p, trial.p, bytes);
            memcpy(state->q, trial.q, bytes);
            memcpy(state->plastic, trial.plastic, bytes);
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

/* What the artificial variable of Lemke's method lifts: every row alike; or what is
 * negative at the start, unevenly, so that elements do not change their zones all at
 * once. */
typedef enum { EVEN, UNEVEN } covering;

typedef struct {
    int number;
    rb_contact_lcp_form form;
    int mirrored;
    double xi0;
} attempt;

/* Pivoted form in its own orientation, mirrored, and Kwak's (theory.md K5). */
enum { OWN, MIRRORED, KWAK, FORMS };

/* The order of attempts.  Most paths end after one pivot per unknown.  Between unlike
 * bodies under large friction a path may take fifty, where another form or another
 * covering vector leads to a solution in three. */
static const struct {
    int form;
    covering cover;
} order_of_attempts[] = {{OWN, EVEN},   {KWAK, EVEN},     {KWAK, UNEVEN},
                         {OWN, UNEVEN}, {MIRRORED, EVEN}, {MIRRORED, UNEVEN}};
enum { ATTEMPTS = sizeof order_of_attempts / sizeof *order_of_attempts };

/* Pivots of an attempt: in two rounds few for all, in the last one as many as Lemke's
 * method allows by itself (0), evenly covered. */
enum { ROUNDS = 3 };

rb_contact_options rb_contact_defaults(void)
{
    return (rb_contact_options){.solver = RB_SOLVER_AUTO, .lcp_form = RB_LCP_PIVOTED, .tol = 1e-10};
}

/* Kwak's form alone where the case asks for it.  Returns the first one to try. */
static int plan_forms(const rb_contact_problem *problem, const rb_contact_options *options,
                      attempt at[FORMS])
{
    /* Direction in which A's surface slides, of the given creepage or against the force. */
    double sum = 0.0;

    for (int i = 0; i < problem->n; i++)
        sum += problem->d_T[i] + problem->xi * problem->e_T[i];
    const int backwards =
        problem->force_given ? problem->force + problem->force_ratio > 0.0 : sum < 0.0;
    const double xi0 = (backwards ? -1.0 : 1.0) * problem->sliding;

    at[OWN] = (attempt){0, RB_LCP_PIVOTED, backwards, xi0};
    at[MIRRORED] = (attempt){1, RB_LCP_PIVOTED, !backwards, xi0};
    at[KWAK] = (attempt){2, RB_LCP_KWAK, 0, xi0};
    return options->lcp_form == RB_LCP_KWAK ? KWAK : OWN;
}

/* Attempt by attempt until one has a solution: its LCP, the path, and the state that the
 * unknowns mean.  Kwak's matrix may have no inverse. */
static rb_status solve_lemke(rb_contact_problem *problem, const rb_contact_options *options,
                             rb_contact_state *state, rb_message *why)
{
    static const double golden = 0.6180339887498949, little = 1e-4;
    attempt all[FORMS];
    const int first = plan_forms(problem, options, all);
    int unfinished[ATTEMPTS] = {0};
    rb_status s = RB_RAY;

    rb_phase("contact by Lemke's method");
    for (int turn = 0; turn < ROUNDS * ATTEMPTS; turn++) {
        const int round = turn / ATTEMPTS, k = turn % ATTEMPTS;
        const attempt *at = &all[order_of_attempts[k].form];
        rb_lcp_options pivoting = rb_lcp_defaults();
        rb_contact_lcp lcp = {0};
        rb_lcp_info info = {0};
        double *cover = NULL;
        if (!(order_of_attempts[k].form >= first && (round == 0 || unfinished[k]) &&
              (round + 1 < ROUNDS || order_of_attempts[k].cover == EVEN)))
            continue;
        if (rb_interrupted())
            return RB_INTERRUPTED;
        s = rb_contact_lcp_create(problem, at->form, at->mirrored, at->xi0, &lcp, why);
        double *z = s == RB_OK ? rb_alloc((size_t)lcp.size, 1) : NULL;
        const int uneven = s == RB_OK && order_of_attempts[k].cover == UNEVEN;
        if (uneven) /* NULL: ones */
            cover = rb_alloc((size_t)lcp.size, 1);
        for (int i = 0; i < lcp.size && cover; i++)
            cover[i] = (lcp.b[i] < 0.0 ? 1.0 : little) * (0.5 + fmod(0.5 + golden * i, 1.0));
        if (s == RB_OK && (!z || (uneven && !cover)))
            s = RB_ENOMEM;
        if (s == RB_OK) {
            pivoting.cover = cover;
            pivoting.max_iters = round + 1 < ROUNDS ? (round ? 15 : 5) * lcp.size + 100 : 0;
            pivoting.trace = problem->pivot_trace;
            pivoting.trace_context = problem->trace_context;
            pivoting.trace_tableau = problem->trace_tableau;
            pivoting.attempt = at->number;
            const rb_lcp_problem p = {lcp.size, lcp.M, lcp.size, lcp.b};
            s = rb_lcp_lemke(&p, &pivoting, z, &info);
            state->iterations += info.iters;
            if (s < 0)
                rb_fail(why, s, "%s", info.msg.text);
        }
        if (z && s >= 0) {
            rb_contact_lcp_recover(problem, &lcp, z, state);
            state->solver = RB_SOLVER_LEMKE;
            state->mirrored = at->mirrored;
            state->xi0 = at->xi0;
            const rb_status t = complete(problem, 0, state);
            s = t < 0 ? t : s;
        }
        free(cover);
        free(z);
        rb_contact_lcp_free(&lcp);
        if (s < 0 || (s == RB_OK && state->residual <= options->tol))
            return s;
        unfinished[k] = s == RB_MAXITER;
    }
    return s;
}

rb_status rb_contact_lcp_first(const rb_contact_problem *problem, const rb_contact_options *options,
                               const rb_contact_state *state, rb_contact_lcp *lcp, rb_message *why)
{
    attempt at[FORMS];
    const int first = plan_forms(problem, options, at);

    if (state && state->solver == RB_SOLVER_LEMKE)
        return rb_contact_lcp_create(problem, state->lcp_form, state->mirrored, state->xi0, lcp,
                                     why);
    return rb_contact_lcp_create(problem, at[first].form, at[first].mirrored, at[first].xi0, lcp,
                                 why);
}

static int is_solved(rb_status s, const rb_contact_problem *problem,
                     const rb_contact_options *options, const rb_contact_state *state)
{
    return s == RB_OK && state->residual <= fmax(options->tol, problem->rounding);
}

/* s, but where the residual says that a solution is none. */
static rb_status proven(rb_status s, const rb_contact_problem *problem,
                        const rb_contact_options *options, const rb_contact_state *state)
{
    return s == RB_OK && !is_solved(s, problem, options, state) ? RB_INACCURATE : s;
}

/* What Newton has ended with, as s says.  On large contacts an element whose traction is
 * rounding may come and go: a cycle that ends in a solution is one. */
static rb_status end_newton(rb_contact_problem *problem, const rb_contact_options *options,
                            rb_status s, rb_contact_state *state)
{
    if (s < 0)
        return s;
    state->solver = RB_SOLVER_NEWTON;
    const rb_status t = complete(problem, 1, state);
    s = t < 0 ? t : s;
    /* GMRES ends at a tolerance of its own; for a smaller one the matrix solves alone */
    if (s == RB_OK && !is_solved(s, problem, options, state) &&
        rb_contact_dense_has_products(problem->op)) {
        rb_contact_operator_add_products(problem->op, NULL);
        s = complete(problem, 0, state);
    }
    if (s == RB_MAXITER && problem->rounding > 0.0 && is_solved(RB_OK, problem, options, state))
        s = RB_OK;
    return s;
}

static rb_status solve_newton(rb_contact_problem *problem, const rb_contact_options *options,
                              int warm, rb_contact_state *state)
{
    rb_phase("contact by Newton's method");
    return end_newton(problem, options, rb_contact_newton(problem, warm, state), state);
}

/* ---- Without a matrix: by way of less friction ------------------------------------- */

/* The problem's friction, of which a share acts; a share of 1 gives it back. */
typedef struct {
    double mu, share, *bound; /* n; owned */
} friction;

static void take_share(const friction *of, double share, rb_contact_problem *problem)
{
    problem->mu = share * of->mu;
    for (int i = 0; i < problem->n; i++)
        problem->bound[i] = share * of->bound[i];
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

static rb_status solve_by_friction(rb_contact_problem *problem, const rb_contact_options *options,
                                   rb_contact_state *state)
{
    const size_t n = (size_t)problem->n;
    friction of = {problem->mu, 1.0, rb_alloc(n, 1)};
    rb_contact_state good;
    rb_status s = rb_contact_state_alloc(problem->n, &good);

    if (s == RB_OK && !of.bound)
        s = RB_ENOMEM;
    if (s == RB_OK) {
        memcpy(of.bound, problem->bound, n * sizeof *of.bound);
        /* A first share, a half or less, for which Newton's steps end without a start. */
        s = RB_MAXITER;

        for (int k = 0; k < MOST_HALVINGS && s > 0 && rb_contact_has_steps_left(problem, state);
             k++) {
            take_share(&of, of.share *= 0.5, problem);
            s = proven(solve_newton(problem, options, 0, state), problem, options, state);
        }
        if (s == RB_OK) {
            /* Newton's steps that go round in circles end from the zones of a problem with nearly
             * the same friction.  From a small share the zones are followed to all of it, in steps
             * that are halved where Newton fails and doubled where three in a row succeed. */
            double step = of.share;
            int row = 0;

            rb_contact_copy_start(state, &good);
            while (s == RB_OK && of.share < 1.0 && step > LEAST_STEP &&
                   rb_contact_has_steps_left(problem, state)) {
                const double next = fmin(1.0, of.share + step);
                take_share(&of, next, problem);
                s = solve_newton(problem, options, 1, state);
                if (is_solved(s, problem, options, state)) {
                    of.share = next;
                    step *= ++row % 3 ? 1.0 : 2.0;
                    rb_contact_copy_start(state, &good);
                } else if (s >= 0) {
                    step *= 0.5;
                    row = 0;
                    s = RB_OK;
                    rb_contact_copy_start(&good, state);
                }
            }
            s = s == RB_OK && of.share < 1.0 ? RB_MAXITER : s;
        }
        problem->mu = of.mu;
        memcpy(problem->bound, of.bound, n * sizeof *of.bound);
    }
    rb_contact_state_free(&good);
    free(of.bound);
    return s;
}

/* ---- The order of attempts --------------------------------------------------------- */

/* The order of solvers: the wanted one first; where it ends without a solution, the other
 * one.  A warm start is Newton's: it costs a few steps where Lemke would start from the
 * beginning. */
typedef enum { LEMKE, NEWTON_WARM, NEWTON_COLD } method;
enum { METHODS = 3 };

static rb_status solve_yielding(rb_contact_problem *problem, const rb_contact_options *options,
                                int warm, rb_contact_state *state, rb_message *why);

/* The method of a problem whose tangential drive friction can follow. */
static rb_status solve_given(rb_contact_problem *problem, const rb_contact_options *options,
                             int warm, rb_contact_state *state, rb_message *why)
{
    method order[METHODS];

    if (problem->yield)
        return solve_yielding(problem, options, warm, state, why);
    const int has_matrix = rb_contact_operator_matrix(problem->op).F != NULL;
    const int newton_first =
        !has_matrix || options->solver == RB_SOLVER_NEWTON ||
        (options->solver == RB_SOLVER_AUTO && (warm || problem->n > RB_CONTACT_LEMKE_UP_TO));
    int count = 0;

    if (newton_first && warm)
        order[count++] = NEWTON_WARM;
    else if (!newton_first)
        order[count++] = LEMKE;
    order[count++] = NEWTON_COLD;
    if (has_matrix)
        order[count++] = LEMKE;
    rb_status s = RB_RAY;

    for (int k = 0; k < count && s >= 0 && (k == 0 || rb_contact_has_steps_left(problem, state));
         k++) {
        s = order[k] == LEMKE ? solve_lemke(problem, options, state, why)
                              : solve_newton(problem, options, order[k] == NEWTON_WARM, state);
        if (is_solved(s, problem, options, state))
            break;
    }
    if (s >= 0 && !is_solved(s, problem, options, state) &&
        !rb_contact_operator_matrix(problem->op).F && problem->mu > 0.0 &&
        rb_contact_has_steps_left(problem, state))
        s = solve_by_friction(problem, options, state);
    return proven(s, problem, options, state);
}

/* ---- A layer that yields ----------------------------------------------------------- */

static rb_status solve_yield_newton(rb_contact_problem *problem, const rb_contact_options *options,
                                    int follows, rb_contact_state *state)
{
    const rb_status s = rb_contact_yield_newton(problem, follows, state);

    return proven(end_newton(problem, options, s, state), problem, options, state);
}

/* Where the friction of the surfaces without the layer stays below its yield stress, that
 * is the solution; else the start, at once or step by step. */
static rb_status solve_from_coulomb(rb_contact_problem *problem, const rb_contact_options *options,
                                    int warm, int follows, rb_contact_state *state, rb_message *why)
{
    double *const yield = problem->yield;

    memset(state->plastic, 0, (size_t)problem->n * sizeof *state->plastic);
    problem->yield = NULL;
    const rb_status s = solve_given(problem, options, warm, state, why);
    problem->yield = yield;
    if (s < 0 || (s == RB_OK && !rb_contact_yields(problem, state)))
        return s;
    return s > 0 && follows ? s : solve_yield_newton(problem, options, follows, state);
}

static rb_status check_capacity(rb_contact_problem *problem, const rb_contact_options *options,
                                rb_contact_state *refused, rb_message *why);

static int holds_yielding(const rb_contact_state *state)
{
    int yields = 0;
    for (int i = 0; i < state->n; i++)
        yields |= state->zone[i] >= RB_ZONE_YIELD_NEGATIVE || state->plastic[i] != 0.0;
    return yields;
}

/* Newton's method in a few steps nearly always; a force that cannot be carried is found
 * before the long ways. */
static rb_status solve_yielding(rb_contact_problem *problem, const rb_contact_options *options,
                                int warm, rb_contact_state *state, rb_message *why)
{
    const int lemke =
        options->solver == RB_SOLVER_LEMKE && rb_contact_operator_matrix(problem->op).F != NULL;
    const int yields = warm && holds_yielding(state);
    rb_status s = RB_MAXITER;

    if (lemke) {
        s = proven(solve_lemke(problem, options, state, why), problem, options, state);
    } else if (yields) {
        s = solve_yield_newton(problem, options, 0, state);
    }
    if (s > 0)
        s = solve_from_coulomb(problem, options, warm && !yields, 0, state, why);
    if (s > 0 && problem->force_given) {
        const rb_status t = check_capacity(problem, options, state, why);
        s = t < 0 ? t : s;
    }
    if (s > 0)
        s = solve_from_coulomb(problem, options, 0, 1, state, why);
    if (s > 0 && !lemke && problem->n <= RB_CONTACT_LEMKE_UP_TO &&
        rb_contact_operator_matrix(problem->op).F)
        s = solve_lemke(problem, options, state, why);
    return proven(s, problem, options, state);
}

/* ---- Full sliding ------------------------------------------------------------------ */

int rb_contact_slides_fully(const rb_contact_problem *problem)
{
    return problem->force_given && problem->force == 0.0 && problem->axle == 0.0 &&
           fabs(problem->force_ratio) >= 1.0 - 1e-12;
}

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
        const rb_status s = solve_given(&given, options, 0, state, why);
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
static rb_status solve_full_sliding(rb_contact_problem *problem, const rb_contact_options *options,
                                    rb_contact_state *state, rb_message *why)
{
    rb_status s = solve_sliding(problem, options, problem->force_ratio > 0.0, state, why);
    if (s == RB_OK)
        s = measure(problem, state);
    if (s == RB_OK && !is_solved(s, problem, options, state))
        s = solve_given(problem, options, 0, state, why);
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
            s = solve_given(&given, options, k > 1, state, NULL);
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
static rb_status check_capacity(rb_contact_problem *problem, const rb_contact_options *options,
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

/* The cone solvers know neither a given load nor a given force: delta and xi of such a
 * case are those that our own solvers find. */
static rb_status solve_cone(rb_contact_problem *problem, const rb_contact_options *options,
                            rb_contact_state *state, rb_message *why)
{
    rb_status s = RB_OK;

    state->delta = problem->delta;
    state->xi = problem->xi;
    if (rb_contact_slides_fully(problem))
        s = solve_full_sliding(problem, options, state, why);
    else if (problem->load_given || problem->force_given)
        s = solve_given(problem, options, 0, state, why);
    if (s == RB_OK)
        s = rb_contact_cone_solve(problem, options, state, why);
    if (s < 0)
        return s;
    const rb_status t = complete(problem, 0, state);
    state->solver = RB_SOLVER_CONE;
    if (t < 0)
        return t;
    /* the case's residual decides, whatever the cone solver thinks of its own */
    const rb_status checked = proven(RB_OK, problem, options, state);
    return checked == RB_OK || s == RB_OK ? checked : s;
}

/* A given force that all methods fail on, as where a contact returns to the state of an earlier
 * step and elements are undecided between stick and slip.  Q falls where xi grows: xi by bisection,
 * where Newton's method knows xi, and from each of these solutions Newton's steps for the force
 * itself. */
static rb_status solve_by_creepage(rb_contact_problem *problem, const rb_contact_options *options,
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
            s = solve_given(&given, options, k > 0, &known, NULL);
            if (s != RB_OK)
                break;
            const double force = cblas_ddot(problem->n, row, 1, known.p, 1) +
                                 cblas_ddot(problem->n, row + n, 1, known.q, 1);
            *(force > problem->force ? &low : &high) = given.xi;
            rb_contact_copy_start(&known, state);
            s = proven(solve_newton(problem, options, 1, state), problem, options, state);
        }
        state->iterations += known.iterations;
    }
    rb_contact_state_free(&known);
    free(row);
    return s;
}

rb_status rb_contact_solve(rb_contact_problem *problem, const rb_contact_options *options, int warm,
                           rb_contact_state *state, rb_message *why)
{
    state->iterations = 0;
    state->refused_at = 0.0;
    rb_status s = options->solver == RB_SOLVER_CONE ? solve_cone(problem, options, state, why)
                  : rb_contact_slides_fully(problem)
                      ? solve_full_sliding(problem, options, state, why)
                      : solve_given(problem, options, warm, state, why);

    if (s > 0 && problem->force_given && (problem->force != 0.0 || problem->axle > 0.0)) {
        const rb_status t = check_capacity(problem, options, state, why);
        if (t < 0)
            return t;
    }
    if (s > 0 && problem->force_given && options->solver != RB_SOLVER_CONE && !problem->yield &&
        !rb_contact_slides_fully(problem)) {
        const rb_status t = solve_by_creepage(problem, options, state);
        s = t <= 0 ? t : s;
    }
    if (s > 0)
        rb_fail(why, s, "%s; scaled residual %.3g", rb_status_text(s), state->residual);
    state->status = s;
    return s;
}
