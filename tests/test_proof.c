/* Proofs of contacts: cases of every support, control and formulation have the zones that were
 * found, and wrong tractions are told by their distance. */
#include "case_words.h"
#include "lcp/contact/contact.h"

static const struct {
    double within; /* what the bounds are at most, as parts of the largest tractions */
    words of;
} cases[] = {
    {1e-8, {{"support arc approach 0.5"}}},
    {1e-8, {{"support hub mu 3 formulation steady creep-ratio 0.5 contact-elements 40"}}},
    {1e-8,
     {{"support halfplane approach 0.01 formulation steady creep-ratio 0.4 contact-elements 30"}}},
    {1e-8, {{"support halfplane load 100 formulation steady force-ratio 0.4 contact-elements 31"}}},
    {1e-8, {{"support halfplane load 100 formulation steady force-ratio 1 contact-elements 30"}}},
    {1e-8, {{"support halfplane load 100 formulation steady free-axle yes contact-elements 30"}}},
    {1e-8, {{"support halfplane load 100 formulation steady creep-ratio 0 contact-elements 30"}}},
    {1e-8, {{"support halfplane load 100 mu 0 contact-elements 30"}}},
    {1e-8, {{"support halfplane load 100 shift 0 contact-elements 30 mesh uniform"}}},
    {1e-8, {{"support halfplane load 100 shift 0 contact-elements 31 mesh uniform"}}},
    {1e-8, {{"support halfplane load 100 force 5 mu 0.1 lcp-form kwak contact-elements 24"}}},
    {1e-8,
     {{"support halfplane load 100 formulation steady creep-ratio 0.4 contact-elements 60 ",
       "mesh fitted"}}},
    {1e-8,
     {{"support halfplane load 100 formulation steady creep-ratio 0.5 yield-stress 10 ",
       "contact-elements 30"}}},
    {1e-8,
     {{"support halfplane load 100 formulation steady creep-ratio 0.7 friction-law exponential ",
       "mu 0.3 mu-fall 0.1 slip-scale 10 speed 1000 contact-elements 30"}}},
    {1e-8,
     {{"support halfplane load 100 formulation transient force-ratio 0.4 distance 0.2 ",
       "contact-elements 24"}}},
    {1e-6,
     {{"support halfplane load 100 formulation steady creep-ratio 0.4 contact-elements 600 ",
       "solver newton"}}},
};

enum { CASES = sizeof cases / sizeof *cases };

TEST(solutions_have_the_zones_that_were_found)
{
    for (int k = 0; k < CASES; k++) {
        const double within = cases[k].within;
        const char *name = cases[k].of.word[0];
        held_case *c = case_of(RB_CASE_SINGLE, &cases[k].of, NULL, 0.0);
        rb_case_result r = {.has_errors = 0};
        rb_contact_proof proof;
        if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message) != RB_OK)
            fail_msg("%s: %s", name, message.text);
        CHECK_OK(rb_contact_prove(&r.model.problem, &r.model.state, &proof, &message));
        if (!proof.proved)
            fail_msg("%s: %s (%s)", name, proof.reason, proof.where);
        CHECK_MAX(proof.bound_p, within, "p: %s", name);
        CHECK_MAX(proof.bound_q, within, "q: %s", name);
        CHECK_MAX(proof.stored_within, within, "stored: %s", name);
        CHECK_MAX(proof.nearby, 1e-9, "nearby: %s", name);
        /* where all slides only just, the last element is without slip but for rounding */
        CHECK_MAX(proof.undecided, strstr(name, "force-ratio 1 ") != NULL, "undecided: %s", name);
        rb_case_result_free(&r);
    }
}

/* Tractions that are not the solution's, in the zones of the solution. */
TEST(wrong_tractions_are_far_from_what_is_proved)
{
    held_case *c = case_of(RB_CASE_SINGLE, &cases[2].of, NULL, 0.0);
    rb_case_result r = {.has_errors = 0};
    rb_contact_proof proof;
    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    rb_contact_state *found = &r.model.state;
    const int middle = found->n / 2;
    const double p0 = rb_norm_inf((size_t)found->n, found->p), before = found->p[middle];
    found->p[middle] = before * (1.0 + 1e-6);
    CHECK_OK(rb_contact_prove(&r.model.problem, found, &proof, &message));
    assert_true(proof.proved);
    CHECK_ABS(proof.stored_within, 1e-6 * before / p0, 1e-8, "distance");
    CHECK_MAX(1e-9, proof.nearby, "data nearby");
    rb_case_result_free(&r);
}

/* Without coupling by definiteness, with little coupling by energy; never where the datum is so
 * near that F_NN is indefinite. */
TEST(solutions_are_unique_where_that_is_shown)
{
    static const struct {
        words of;
        const char *unique;
    } rows[] = {
        {{{"similar yes support halfplane load 100 formulation steady creep-ratio 0.4 ",
           "contact-elements 30"}},
         "uncoupled"},
        {{{"similar yes support halfplane load 100 shift 1e-5 contact-elements 30"}}, "uncoupled"},
        {{{"support halfplane load 100 mu 0 contact-elements 30"}}, "frictionless"},
        {{{"support halfplane load 100 poisson 0.3 shift 1e-4 contact-elements 20"}}, "energy"},
        {{{"support halfplane load 100 poisson 0.45 mu 0.1 mesh uniform formulation steady ",
           "force-ratio 0.4 contact-elements 20"}},
         "at its creepage"},
        {{{"support halfplane load 100 poisson 0.3 formulation steady creep-ratio 0.4 ",
           "contact-elements 20"}},
         "not shown"},
        {{{"support halfplane approach 0.001 mu 0 datum 0.1 contact-elements 30"}}, "not shown"},
    };
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_case *c = case_of(RB_CASE_SINGLE, &rows[k].of, NULL, 0.0);
        rb_case_result r = {.has_errors = 0};
        rb_contact_proof proof;
        if (rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message) < 0)
            fail_msg("%s: %s", rows[k].of.word[0], message.text);
        CHECK_OK(rb_contact_prove(&r.model.problem, &r.model.state, &proof, &message));
        if (strcmp(proof.unique, rows[k].unique) != 0)
            fail_msg("%s: %s", rows[k].of.word[0], proof.unique);
        rb_case_result_free(&r);
    }
}

/* Of all matrices of order 3 with integers of -2 ... 2 and a diagonal of 0 ... 3 every seventh:
 * definite by Sylvester's minors of 2 S = A + A'; weights of powers of two change nothing. */
TEST(definite_matrices_are_told_from_others)
{
    const double d[] = {1.0, 1.0, 1.0};
    int shown = 0, definite_ones = 0;
    for (int k = 0; k < 1000000; k += 7) {
        int code = k, a[9], definite;
        double A[9];
        for (int i = 0; i < 9; i++) {
            const int values = i % 4 == 0 ? 4 : 5;
            a[i] = code % values - (i % 4 == 0 ? 0 : 2);
            code /= values;
            A[i] = a[i];
        }
        const int s01 = a[1] + a[3], s02 = a[2] + a[6], s12 = a[5] + a[7], s0 = 2 * a[0],
                  s1 = 2 * a[4], s2 = 2 * a[8];
        const int is = s0 > 0 && s0 * s1 - s01 * s01 > 0 &&
                       s0 * (s1 * s2 - s12 * s12) - s01 * (s01 * s2 - s12 * s02) +
                               s02 * (s01 * s12 - s1 * s02) >
                           0;
        CHECK_OK(rb_lcp_prove_definite(3, A, 3, d, NULL, &definite));
        if (definite && !is)
            fail_msg("matrix %d is not definite", k);
        shown += definite;
        definite_ones += is;
    }
    assert_int_equal(shown, definite_ones);
}

static rb_status prove_case(void *context)
{
    const rb_case_result *r = context;
    rb_contact_proof proof;
    return rb_contact_prove(&r->model.problem, &r->model.state, &proof, NULL);
}

TEST(proofs_without_memory_are_said)
{
    held_case *c = case_of(RB_CASE_SINGLE, &cases[10].of, NULL, 0.0);
    rb_case_result r = {.has_errors = 0};
    CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
    assert_true(alloc_fail_each(prove_case, &r) > 30);
    rb_case_result_free(&r);
}

RUN_TESTS(NULL, NULL)
