/* The core: base, lcp, bem, contact, rolling, case and the plain tables of io, in an
 * archive of their own, solve a case without cone solvers, HDF5 and SuiteSparse (see the
 * Makefile, which links this program to nothing else). */
#include "check.h"
#include "rolling/case/case.h"

static rb_status solve_core(const char *const *words, rb_case_result *r, rb_message *why)
{
    held_case *c = rb_case_create(RB_CASE_SINGLE);
    rb_status s = RB_OK;

    for (; *words && s == RB_OK; words += 2)
        s = rb_case_set(c, words[0], words[1], 0, why);
    if (s == RB_OK)
        s = rb_case_resolve(c, why);
    if (s == RB_OK)
        s = rb_case_solve(rb_case_resolved(c), NULL, NULL, r, why);
    return s;
}

TEST(the_core_solves_a_case)
{
    static const char *const carter[] = {"support",     "halfplane", "similar", "yes",
                                         "formulation", "steady",    "load",    "300",
                                         "creep-ratio", "0.5",       NULL};
    static const char *const wheel[] = {"contact-elements", "12", NULL};
    rb_case_result r = {0};

    CHECK_OK(solve_core(carter, &r, &message));
    CHECK_ABS(r.solution.force_ratio, -0.75, 2e-3, "Carter: s (2 - s)");
    rb_case_result_free(&r);
    CHECK_OK(solve_core(wheel, &r, &message));
    CHECK_MAX(r.solution.residual, 1e-10, "residual");
    rb_case_result_free(&r);
}

TEST(cone_solvers_are_not_at_hand)
{
    static const char *const cone[] = {"solver", "nsn-ac", NULL};
    OWNED(rb_case_result) r = {0};

    CHECK_SAYS(solve_core(cone, &r, &message), RB_EINVAL, "nsn-ac");
}

RUN_TESTS(NULL, NULL)
