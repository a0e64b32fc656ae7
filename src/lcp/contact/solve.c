/* The order in which the attempts of Lemke's method and Newton's method are made. */
#include "lcp/contact/internal.h"
#include "base/sizes.h"

rb_contact_options rb_contact_defaults(void)
{
    return (rb_contact_options){.solver = RB_SOLVER_AUTO, .lcp_form = RB_LCP_PIVOTED, .tol = 1e-10};
}

/* The order of solvers: the wanted one first; where it ends without a solution, the other
 * one.  A warm start is Newton's: it costs a few steps where Lemke would start from the
 * beginning. */
typedef enum { LEMKE, NEWTON_WARM, NEWTON_COLD } method;
enum { METHODS = 3 };

/* The method of a problem whose tangential drive friction can follow.  Lemke's method ends in a
 * solution of nearly every problem, in time n^3 with a large factor; Newton's takes a few linear
 * solves, and may go round in circles.  Hence each is the other's second attempt. */
rb_status rb_contact_solve_given(rb_contact_problem *problem, const rb_contact_options *options,
                                 int warm, rb_contact_state *state, rb_message *why)
{
    method order[METHODS];

    if (problem->yield)
        return rb_contact_solve_yielding(problem, options, warm, state, why);
    const int has_matrix = rb_contact_operator_matrix(problem->op).F != NULL;
    const int newton_first =
        !has_matrix || options->solver == RB_SOLVER_NEWTON ||
        (options->solver == RB_SOLVER_AUTO && (warm || problem->n > RB_CONTACT_LEMKE_UP_TO));
    int count = 0;

    /* Without a matrix there is no tableau: Newton's method alone. */
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
        s = order[k] == LEMKE
                ? rb_contact_by_lemke(problem, options, state, why)
                : rb_contact_by_newton(problem, options, order[k] == NEWTON_WARM, state);
        if (rb_contact_is_solved(s, problem, options, state))
            break;
    }
    /* Last, also without a matrix: friction grows from nothing to its coefficient. */
    if (s >= 0 && !rb_contact_is_solved(s, problem, options, state) &&
        !rb_contact_operator_matrix(problem->op).F && problem->mu > 0.0 &&
        rb_contact_has_steps_left(problem, state))
        s = rb_contact_by_friction(problem, options, state);
    return rb_contact_proven(s, problem, options, state);
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
        s = rb_contact_solve_full_sliding(problem, options, state, why);
    else if (problem->load_given || problem->force_given)
        s = rb_contact_solve_given(problem, options, 0, state, why);
    if (s == RB_OK)
        s = rb_contact_cone_solve(problem, options, state, why);
    if (s < 0)
        return s;
    const rb_status t = rb_contact_complete(problem, 0, state);
    state->solver = RB_SOLVER_CONE;
    if (t < 0)
        return t;
    /* the case's residual decides, whatever the cone solver thinks of its own */
    const rb_status checked = rb_contact_proven(RB_OK, problem, options, state);
    return checked == RB_OK || s == RB_OK ? checked : s;
}

rb_status rb_contact_solve(rb_contact_problem *problem, const rb_contact_options *options, int warm,
                           rb_contact_state *state, rb_message *why)
{
    state->iterations = 0;
    state->refused_at = 0.0;
    rb_status s = options->solver == RB_SOLVER_CONE ? solve_cone(problem, options, state, why)
                  : rb_contact_slides_fully(problem)
                      ? rb_contact_solve_full_sliding(problem, options, state, why)
                      : rb_contact_solve_given(problem, options, warm, state, why);

    /* No solution: is there none, because friction carries less than the given force?  Else xi is
     * unknown in every method above, and may be found by bisection instead. */
    if (s > 0 && problem->force_given && (problem->force != 0.0 || problem->axle > 0.0)) {
        const rb_status t = rb_contact_check_capacity(problem, options, state, why);
        if (t < 0)
            return t;
    }
    if (s > 0 && problem->force_given && options->solver != RB_SOLVER_CONE && !problem->yield &&
        !rb_contact_slides_fully(problem)) {
        const rb_status t = rb_contact_by_creepage(problem, options, state);
        s = t <= 0 ? t : s;
    }
    if (s > 0)
        rb_fail(why, s, "%s; scaled residual %.3g", rb_status_text(s), state->residual);
    state->status = s;
    return s;
}
