/* The contact problem by Lemke's method: which LCP, (K5) in either orientation or (K4), which
 * covering vector, and how many pivots before the next attempt. */
#include "lcp/contact/internal.h"

#include <math.h>
#include <stdlib.h>

/* What the artificial variable of Lemke's method lifts: every row alike; or what is
 * negative at the start, unevenly, so that elements do not change their zones all at
 * once. */
typedef enum { EVEN, UNEVEN } covering;

/* An LCP of the contact problem. */
typedef struct {
    int number; /* for the trace */
    rb_contact_lcp_form form;
    int mirrored; /* 1: oriented against the direction of sliding (K5) */
    double xi0;   /* of full sliding, from which a given force is approached (K6) */
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
rb_status rb_contact_by_lemke(rb_contact_problem *problem, const rb_contact_options *options,
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
        /* Multiples of the golden section modulo 1 are all different, and far from each other. */
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
            const rb_status t = rb_contact_complete(problem, 0, state);
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
