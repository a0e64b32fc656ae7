/* Without a matrix: a contact problem by way of less friction. */
#include "lcp/contact/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* On the way to all of the friction: where it begins at the earliest, and the least step,
 * as shares of it. */
enum { MOST_HALVINGS = 6 };
static const double LEAST_STEP = 1e-4;
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

rb_status rb_contact_by_friction(rb_contact_problem *problem, const rb_contact_options *options,
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
            s = rb_contact_proven(rb_contact_by_newton(problem, options, 0, state), problem,
                                  options, state);
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
                s = rb_contact_by_newton(problem, options, 1, state);
                if (rb_contact_is_solved(s, problem, options, state)) {
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
