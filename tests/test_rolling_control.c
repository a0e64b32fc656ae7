/* Given loads and forces up to full sliding, and the two solvers against each other. */
#include "cases.h"
#include "check.h"
#include "lcp/friction/friction.h"
#include "rolling/rolling.h"
#include "numbers.h"
#include "solved.h"

#include <float.h>

static double log_uniform(double a, double b)
{
    return exp(between(log(a), log(b)));
}

/* Half-planes of any materials in steady or static contact, creepage or force given. */
static rb_rolling_case random_case(double mu_from, double mu_to)
{
    rb_rolling_case rc = rolling_case("young %g", log_uniform(1e3, 1e6));
    rc.a.poisson = between(-0.3, 0.5);
    rc.b.young = log_uniform(1e3, 1e6);
    rc.b.poisson = between(0.0, 0.5);
    rc.elastic_b = rand() % 2;
    rc.b.radius = rand() % 2 ? INFINITY : log_uniform(10.0, 1000.0);
    set(&rc, "support halfplane gap parabola formulation %s", rand() % 4 ? "steady" : "static");
    rc.half_width = log_uniform(1e-6, 1e-2) * rc.a.radius;
    rc.mu = log_uniform(mu_from, mu_to);
    if (rand() % 2)
        rc.force_ratio = rand() % 4 ? between(-0.999, 0.999) : rand() % 2 ? 0.999 : -0.999;
    else if (rc.formulation == RB_STEADY)
        rc.creep_ratio = between(-2.0, 2.0);
    else
        rc.shift = rc.mu * rc.half_width * rc.half_width / rc.a.radius * between(-3.0, 3.0);
    rc.contact_elements = 15 + rand() % 45;
    return rc;
}

/* The force of a free axle is known as closely as the moment of the pressures, which nearly cancel:
 * next to the friction of a very small mu that is more than the tolerance. */
TEST(a_free_axle_is_met_to_the_rounding_of_its_moment)
{
    static const char *const bodies[] = {"", "young-b 70000 poisson-b 0.33"};
    static const double radius[] = {10.0, 50.0, 100.0};
    for (int k = 0; k < 12; k++) {
        rb_rolling_case rc = rolling_case("support halfplane formulation steady mu 1e-9 free-axle");
        set(&rc, "radius %g half-width %g contact-elements %d %s", radius[k % 3], 0.3 + 0.14 * k,
            k % 2 ? 20 : 40, bodies[k / 6]);
        OWNED(rb_rolling_solution) s;
        CHECK_OK(rb_rolling_solve(&rc, &s, &message));
        CHECK_MAX(s.residual, 1e-10, "residual %d", k);
        CHECK_MAX(fabs(s.resistance_moment + s.tangential_load * radius[k % 3]),
                  4.0 * DBL_EPSILON * s.normal_load * s.half_width, "torque of the axle %d", k);
    }
}

TEST(lemke_and_newton_agree_on_500_cases)
{
    srand(11);
    for (int k = 0; k < 500; k++) {
        rb_rolling_case rc = with(random_case(1e-4, 1.0), "solver lemke");
        OWNED(rb_rolling_model) model;
        OWNED(rb_contact_state) newton;
        if (rb_rolling_model_create(&rc, &model, &message) != RB_OK)
            fail_msg("case %d: %s", k, message.text);
        CHECK_OK(rb_contact_state_alloc(model.mesh.n, &newton));
        rc.contact.solver = RB_SOLVER_NEWTON;
        CHECK_OK(rb_rolling_problem_solve(&model.problem, &rc, 0, &newton, NULL));
        for (int i = 0; i < newton.n; i++) {
            CHECK_ABS(newton.p[i], model.state.p[i], 1e-8 * model.problem.stress,
                      "p, case %d element %d", k, i);
            CHECK_ABS(newton.q[i], model.state.q[i], 1e-8 * model.problem.stress,
                      "q, case %d element %d", k, i);
        }
    }
}

TEST(force_control_never_fails_on_the_halfplane)
{
    srand(12);
    for (int k = 0; k < 400; k++) {
        rb_rolling_case rc = random_case(1e-6, 10.0);
        OWNED(rb_rolling_solution) s;
        set(&rc, "formulation steady creep-ratio nan shift nan");
        rc.force_ratio = k % 4 ? between(-0.999, 0.999) : k % 8 ? 0.999 : -0.999;
        if (rb_rolling_solve(&rc, &s, &message) != RB_OK)
            fail_msg("case %d, mu = %g, Q/(mu P) = %g: %s", k, rc.mu, rc.force_ratio, message.text);
        CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-10, "case %d", k);
        CHECK_MAX(s.load_error, 1e-10, "case %d", k);
        CHECK_MAX(s.residual, 1e-10, "case %d", k);
    }
}

TEST(full_sliding_gives_the_least_creepage)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        rb_rolling_case rc = rolling_case(
            "support halfplane formulation steady half-width 0.05 force-ratio %g", (double)sign);
        rb_rolling_solution s;
        CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
        CHECK_ABS(s.force_ratio, sign, 1e-10, "force");
        assert_int_equal(s.stick, 0);
        CHECK_MAX(s.residual, 1e-10, "residual");
        const double least = s.creepage;
        rb_rolling_solution_free(&s);
        rc.force_ratio = NAN;
        rc.creep = least * 0.999; /* a little less: something sticks */
        CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
        assert_true(s.stick > 0);
        rb_rolling_solution_free(&s);
        rc.creep = least * 1.001;
        CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
        assert_int_equal(s.stick, 0);
        rb_rolling_solution_free(&s);
    }
}

/* On tilted elements all that slides has another ratio than 1: a little more than 1 on a
 * small contact, so that something sticks; less on a large one, where there is no answer
 * and none is given out as one. */
TEST(full_sliding_of_tilted_elements_is_checked)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_solution s;
    set(&rc, "formulation steady gap parabola normals surface force-ratio 1 half-width %g",
        1e-3 * rc.a.radius);
    CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
    CHECK_ABS(s.force_ratio, 1.0, 1e-10, "force");
    CHECK_MAX(s.residual, 1e-10, "residual");
    assert_true(s.stick > 0);
    rb_rolling_solution_free(&s);
    rc.half_width = 0.1 * rc.a.radius;
    assert_true(rb_rolling_solve(&rc, &s, NULL) > 0);
    assert_true(s.residual > 1e-3);
    rb_rolling_solution_free(&s);
}

/* The friction of the one element in stick comes out of numbers as large as the pressure: below mu
 * = 1e-8 a given force was rounding.  A cone solver, which has a creepage, leaves no stick at all.
 */
TEST(force_control_never_fails_where_friction_is_tiny)
{
    static const char *const bodies[] = {"support halfplane", "support halfplane similar",
                                         "support halfplane young-b 2e5 poisson-b 0.28",
                                         "support arc", "support hub young-b 2e5 radius-b 80"};
    static const char *const solvers[] = {"newton", "lemke", "lemke lcp-form kwak"};
    static const double mu[] = {1e-7, 1e-9, 1e-12, 1e-20, 1e-60};

    srand(14);
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++)
        for (size_t k = 0; k < sizeof mu / sizeof *mu; k++)
            for (size_t m = 0; m < sizeof solvers / sizeof *solvers; m++) {
                rb_rolling_case rc =
                    rolling_case("%s load 500 contact-elements %d", bodies[b], 12 + rand() % 20);
                set(&rc, "solver %s formulation %s mu %g force-ratio %g", solvers[m],
                    rand() % 2 ? "steady" : "static", mu[k], between(-0.95, 0.95));
                OWNED(rb_rolling_solution) s;
                if (rb_rolling_solve(&rc, &s, &message) != RB_OK)
                    fail_msg("%s, mu %g, %s: %s", bodies[b], mu[k], solvers[m], message.text);
                CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-10, "%s, mu %g, %s", bodies[b], mu[k],
                          solvers[m]);
                CHECK_MAX(s.residual, 1e-10, "%s, mu %g, %s", bodies[b], mu[k], solvers[m]);
            }
    rb_rolling_case rc = rolling_case("support hub load 500 mu 1e-14 force-ratio 0.5");
    set(&rc, "contact-elements 15");
    OWNED(rb_rolling_solution) s;
    rc.contact.solver = RB_SOLVER_CONE;
    rc.contact.cone_solver = rb_friction_cone_solver("nsgs-ac");
    CHECK_OK(rb_rolling_solve(&rc, &s, &message));
    CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-10, "by a cone solver");
}

TEST(approach_control_finds_the_force_too_large)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_solution s;
    set(&rc, "support halfplane formulation steady approach 1e-4 force-ratio -0.5");
    CHECK_OK(rb_rolling_solve(&rc, &s, &message));
    CHECK_ABS(s.force_ratio, -0.5, 1e-10, "force ratio under approach control");
    const double bound = rc.mu * s.normal_load;
    rb_rolling_solution_free(&s);

    set(&rc, "force-ratio nan force %g", 0.7 * bound);
    CHECK_OK(rb_rolling_solve(&rc, &s, &message));
    CHECK_REL(s.tangential_load, 0.7 * bound, 1e-10, "force under approach control");
    rb_rolling_solution_free(&s);

    rc.force = 1.5 * bound;
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "friction carries at most");
    rb_rolling_solution_free(&s);
}

TEST(the_creepage_ratio_is_met_under_approach_control)
{
    rb_rolling_case rc =
        rolling_case("support halfplane formulation steady approach 1e-3 creep-ratio 0.4");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.creep_ratio, 0.4, 1e-10, "xi R/(mu a)");
}

/* A solve that misses its tolerance leaves its own tractions, with the force that was
 * asked for, whatever else was solved to learn whether friction can carry that force. */
TEST(a_failed_force_leaves_its_iterate)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    OWNED(rb_rolling_solution) s;
    set(&rc, "support halfplane formulation steady approach 1e-4 force 1e-3 tol 1e-300");
    CHECK_STATUS(rb_rolling_solve(&rc, &s, NULL), RB_INACCURATE);
    CHECK_REL(s.tangential_load, 1e-3, 1e-9, "force");
    CHECK_MAX(s.residual, 1e-10, "residual");
    assert_true(s.stick > 0);
}

/* Wide contacts answer a creepage with load: plain substitution was 2.5e-9 off after 40
 * rounds and called that solved. */
TEST(the_creepage_ratio_is_met_where_the_load_depends_on_it)
{
    rb_rolling_case rc = rolling_case("poisson 0.38 mu 1.616 approach 1.898 formulation steady "
                                      "creep-ratio 1.36 contact-elements 13 mesh fitted");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.creep_ratio, 1.36, 1e-12, "xi R/(mu a)");
}

/* With the tolerance between the residual of the case and that of its free rolling, the
 * case is solved and says only that the free creepage is unknown. */
TEST(a_failed_free_creepage_leaves_the_case_solved)
{
    int unknown = 0;
    for (int n = 20; n < 32; n++) {
        rb_rolling_case rc = rolling_case("support halfplane formulation steady half-width 0.1 "
                                          "creep-ratio 0.4 contact-elements %d",
                                          n);
        rb_rolling_solution s;
        OWNED(rb_rolling_curve) c;
        CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
        rc.contact.tol = s.residual * (1.0 + 1e-6);
        rb_rolling_solution_free(&s);
        CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
        CHECK_OK(s.status);
        unknown += isnan(s.free_creepage);
        rb_rolling_solution_free(&s);
        CHECK_OK(rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.4, 0.4, 1, RB_UNITS_MM}, &c,
                                        NULL));
    }
    assert_true(unknown > 0);
}

RUN_TESTS(NULL, NULL)
