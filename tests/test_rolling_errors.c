/* Error bars from runs that are made up or solved here, and the way to an accuracy. */
#include "rolling/case/closed_forms.h"
#include "cases.h"
#include "solved.h"

#include <float.h>

/* ---- Histories --------------------------------------------------------------------- */

/* ---- To an accuracy ---------------------------------------------------------------- */

TEST(an_accuracy_is_reached_by_more_elements)
{
    static const double accuracy[] = {0.9, 0.05, 0.01};
    int before = 0;
    for (int k = 0; k < 3; k++) {
        const rb_rolling_case rc = carter_case(24);
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors e;
        int elements;
        CHECK_OK(rb_rolling_solve_to_accuracy(&rc, accuracy[k], &s, &e, &elements, &message));
        CHECK_MAX(e.scalar.force_ratio, accuracy[k], "Q/(mu P)");
        CHECK_MAX(e.scalar.half_width / s.half_width, accuracy[k], "half-width");
        CHECK_MAX(e.scalar.max_pressure / s.max_pressure, accuracy[k], "p0");
        CHECK_ABS(s.force_ratio, -0.75, accuracy[k], "Carter");
        assert_true(elements >= before && (k == 0) == (elements == 24));
        before = elements;
    }
    CHECK_MAX(before, 1600, "elements");
}

/* Unlike bodies under little friction: their creepage of free rolling (Bentall and
 * Johnson) is hundreds of mu a/R, and its error is judged by itself. */
TEST(little_friction_asks_for_no_more_elements)
{
    rb_rolling_case rc = carter_case(40);
    OWNED(rb_rolling_solution) s;
    rb_rolling_errors e;
    int elements;
    rc.b.young = rc.a.young / 40.0;
    set(&rc, "creep-ratio nan force 0 mu 1e-4");
    CHECK_OK(rb_rolling_solve_to_accuracy(&rc, 0.2, &s, &e, &elements, &message));
    const double unit = rc.mu * s.hertz_half_width / rc.a.radius;
    const double exact = rb_closed_bentall_johnson_slip(fabs(rb_rolling_derive(&rc).dundurs),
                                                        s.hertz_half_width, rc.a.radius);
    CHECK_MAX(elements, 80, "elements");
    CHECK_MAX(e.scalar.creepage, 0.2 * fabs(s.creepage), "the error of the creepage");
    assert_true(e.scalar.creepage > 5.0 * unit);
    CHECK_ABS(fabs(s.creepage), exact, e.scalar.creepage, "Bentall and Johnson");
}

TEST(what_is_no_accuracy_is_refused)
{
    static const double accuracy[] = {0.0, 1.0, -0.1, NAN};
    for (int k = 0; k < 4; k++) {
        const rb_rolling_case rc = carter_case(20);
        rb_rolling_solution s;
        rb_rolling_errors e;
        int elements;
        CHECK_SAYS(rb_rolling_solve_to_accuracy(&rc, accuracy[k], &s, &e, &elements, &message),
                   RB_EINVAL, "accuracy: expected a number in (0, 1)");
    }
}

/* The limit is told with what was reached; equal elements hear of fitted ones. */
TEST(an_accuracy_that_no_mesh_has_is_refused_at_once)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = carter_case(12);
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors errors;
        int elements;
        rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        CHECK_STATUS(rb_rolling_solve_to_accuracy(&rc, 1e-12, &s, &errors, &elements, &message),
                     RB_INACCURATE);
        assert_int_equal(elements, 12);
        assert_non_null(strstr(message.text, "accuracy 1e-12 not reached with 12 elements"));
        assert_int_equal(strstr(message.text, "a fitted mesh needs fewer") != NULL, !k);
    }
}

/* The pressure has a singularity, at which no mesh has the accuracy: where stick ends between
 * unlike bodies under much friction, and under a stiff layer at rest whose stick is not resolved.
 * That is said after few elements, with the result that lacks it. */
TEST(an_accuracy_of_a_singular_pressure_is_given_up_soon)
{
    static const struct {
        const char *options;
        int most;
    } row[] = {{"formulation steady mu 3 creep-ratio 0.4", 240},
               {"formulation static mu 0.3 shift 1e-4 layer-thickness 0.05 base-young 10000 "
                "base-poisson 0.1",
                400}};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = rb_rolling_case_defaults();
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors errors;
        int elements;
        set(&rc, "support halfplane half-width 0.5 mesh fitted contact-elements 100 %s",
            row[k].options);
        CHECK_STATUS(rb_rolling_solve_to_accuracy(&rc, 3e-3, &s, &errors, &elements, &message),
                     RB_INACCURATE);
        assert_true(elements >= 100 && elements <= row[k].most);
        assert_non_null(strstr(message.text, " of max_pressure"));
        assert_true(errors.scalar.max_pressure > 3e-3 * s.max_pressure);
    }
}

/* Memory that is refused to a later round leaves the best solution so far. */
TEST(a_later_round_that_fails_leaves_the_one_before)
{
    int none = 0, some = 0;
    for (int count = 50; count < 3000; count = count * 5 / 4) {
        rb_rolling_case rc = carter_case(12);
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors errors;
        int elements;
        alloc_fail_after(count);
        const rb_status status =
            rb_rolling_solve_to_accuracy(&rc, 0.05, &s, &errors, &elements, &message);
        const int failed = alloc_failed();
        alloc_succeed();
        if (failed && elements > 0) {
            CHECK_STATUS(status, RB_ENOMEM);
            assert_non_null(strstr(message.text, ": out of memory beyond "));
            CHECK_REL(s.normal_load, 500.0, 1e-9, "the load");
            assert_true(elements >= 12 && isfinite(errors.scalar.force_ratio));
        }
        none += failed && elements == 0;
        some += failed && elements > 0;
    }
    assert_true(none > 0 && some > 0);
}

/* Under a given force the creepage is what has to be accurate, in units of full sliding. */
TEST(a_given_force_has_an_accurate_creepage)
{
    static const double accuracy[] = {0.1, 0.05, 0.02};
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = carter_case(12);
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors e;
        int elements;
        set(&rc, "creep-ratio nan force-ratio -0.9 mesh %s", k < 3 ? "uniform" : "fitted");
        CHECK_OK(rb_rolling_solve_to_accuracy(&rc, accuracy[k % 3], &s, &e, &elements, &message));
        CHECK_MAX(e.scalar.creepage * rb_rolling_radius(&rc) / (rc.mu * s.half_width),
                  accuracy[k % 3], "case %d", k);
    }
}

/* Twice the elements make twice the steps: what is told is the solution of that case. */
TEST(accuracy_takes_more_steps_too)
{
    rb_rolling_case rc = with(carter_case(12), "formulation transient distance 1 steps 4");
    OWNED(rb_rolling_solution) s;
    rb_rolling_errors errors;
    int elements;
    CHECK_OK(rb_rolling_solve_to_accuracy(&rc, 0.3, &s, &errors, &elements, NULL));
    assert_true(elements > 12 && elements % 12 == 0);
    set(&rc, "contact-elements %d steps %d", elements, 4 * elements / 12);
    OWNED(rb_rolling_solution) same = solved(&rc);
    CHECK_REL(s.tangential_load, same.tangential_load, 1e-12, "Q");
}

RUN_TESTS(NULL, NULL)
