/* Error bars from runs that are made up or solved here, and the way to an accuracy. */
#include "rollbem/closed_forms.h"
#include "study/internal.h"
#include "solved.h"

#include <float.h>
#include <string.h>

static rb_rolling_case carter(int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    rc.elastic_b = 1;
    rc.load = 500.0;
    rc.formulation = RB_STEADY;
    rc.creep_ratio = 0.5;
    rc.contact_elements = elements;
    return rc;
}

TEST(bars_are_three_or_five_times_the_spread)
{
    static const double runs[][3] = {
        {1.0, 1.2, 1.1},
        {3.0, 2.0, 1.0},
        {2.0, 2.5, 3.0},
        {1.0, 1.0, 1.0},
        {1.0, 1.0 - 2e-16, 2.0}}; /* the last turns by rounding alone */
    static const double wanted[] = {5.0 * 0.2, 3.0 * 2.0, 3.0 * 1.0, 0.0, 3.0 * 1.0};
    for (int k = 0; k < 5; k++) {
        CHECK_ABS(rb_rolling_contact_error(runs[k], runs[k][2]), wanted[k], 1e-14,
                  "contact %d", k);
        CHECK_ABS(rb_rolling_boundary_error(3, runs[k], 4.0), 2.0 * (4.0 - runs[k][2]),
                  1e-14, "boundary %d", k);
        CHECK_ABS(rb_rolling_boundary_error(2, runs[k], 4.0), 0.0, 0.0, "no boundary");
    }
    const double gone[] = {NAN, 1.0, 1.0};
    assert_true(isnan(rb_rolling_contact_error(gone, 1.0)));
    assert_true(isnan(rb_rolling_contact_error(runs[0], NAN)));
}

TEST(coarser_runs_have_half_and_seven_tenths)
{
    static const int elements[] = {20, 28, 40}, steps[] = {4, 5, 7};
    static const double boundary[] = {3.0, 3.0, 1.5};
    rb_rolling_case rc = carter(40);
    assert_int_equal(rb_rolling_error_runs(&rc), 2);
    rc.elastic_b = 1;
    rc.b.support = RB_BEM_HUB;
    assert_int_equal(rb_rolling_error_runs(&rc), 3);
    rc.elastic_b = 0; /* not read */
    assert_int_equal(rb_rolling_error_runs(&rc), 2);
    rc.a.support = RB_BEM_ARC;
    assert_int_equal(rb_rolling_error_runs(&rc), 3);
    rc.outer_refinement = 3.0;
    rc.steps = 7;
    for (int k = 0; k < 3; k++) {
        const rb_rolling_case run = rb_rolling_error_run(&rc, k);
        assert_int_equal(run.contact_elements, elements[k]);
        assert_int_equal(run.steps, steps[k]);
        CHECK_ABS(run.outer_refinement, boundary[k], 1e-15, "run %d", k);
    }
    rc.outer_refinement = 0.0;
    rc.steps = 0;
    CHECK_ABS(rb_rolling_error_run(&rc, 2).outer_refinement, 0.5, 0.0, "of one");
    CHECK_ABS(rb_rolling_error_run(&rc, 0).outer_refinement, 1.0, 0.0, "of one");
    assert_int_equal(rb_rolling_error_run(&rc, 0).steps, 0);
}

TEST(too_few_elements_cannot_be_halved)
{
    rb_rolling_case rc = carter(12);
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_OK);
    rc.contact_elements = 11;
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "expected 12 contact elements or more, got 11"));
    rc.contact_elements = 12;
    rc.outer_elements = 15; /* nothing to a half-plane */
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_OK);
    rc.a.support = RB_BEM_HUB;
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "expected 16 outer elements or more, got 15"));
    rc.outer_elements = 16;
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_OK);
    rc.outer_elements = 0;
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_OK);
}

TEST(the_power_of_an_edge_is_that_of_a_root)
{
    rb_rolling_case rc = carter(40);
    CHECK_REL(rb_rolling_edge_power(&rc, 500.0, -0.01, 2.0, 0.25),
              0.3 * 500.0 * 0.01 * 0.125, 1e-12, "similar bodies");
    rc.elastic_b = 0;
    const double beta = rb_rolling_derive(&rc).dundurs;
    CHECK_REL(rb_rolling_edge_power(&rc, 500.0, 0.01, 2.0, 0.04),
              0.3 * 500.0 * (0.01 + beta * 2.0 / 50.0) * 0.008, 1e-12, "unlike ones");
}

/* Every scalar with a bar: three spreads of solutions found here, and what no mesh tells
 * apart, recomputed; of a plain case and of one whose slip turns round over few elements.
 */
static void check_bars(const rb_rolling_case *rc)
{
    rb_rolling_solution own, run[2];
    rb_rolling_errors e;
    rb_message why = {""};
    if (rb_rolling_solve_with_errors(rc, &own, &e, &why) != RB_OK)
        fail_msg("%s", why.text);
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = rb_rolling_error_run(rc, k);
        run[k] = solved(&coarser);
    }
    const double rounding = fmax(own.residual, rc->contact.tol), a = own.hertz_half_width;
    const double P = own.normal_load, R = rb_rolling_radius(rc);
    const double h = rb_rolling_longest_element(own.n, own.zone, own.h);
    const struct {
        rb_rolling_error_scale scale;
        double least;
    } scales[] = {
        {RB_SCALE_LOAD, rounding * P},
        {RB_SCALE_FRICTION, rounding * rc->mu * P},
        {RB_SCALE_ONE, rounding},
        {RB_SCALE_APPROACH, rounding * fabs(own.approach)},
        {RB_SCALE_CREEPAGE, rounding * fmax(rc->mu * a / R, fabs(own.creepage))},
        {RB_SCALE_WIDTH, rounding * a},
        {RB_SCALE_PRESSURE, rounding * own.max_pressure},
        {RB_SCALE_POWER,
         rb_rolling_edge_power(rc, P, own.creepage, a, h / (2.0 * own.half_width))},
        {RB_SCALE_MOMENT, rounding * P * a},
        {RB_SCALE_STRAIN, rounding * a / R},
        {RB_SCALE_WORK, rounding * P * a / R},
        {RB_SCALE_ELEMENT, h}};
    int seen = 0;
    for (int j = 0; j < rb_rolling_solution_scalars.n; j++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[j];
        const double v[] = {rb_rolling_number(r, &run[0]), rb_rolling_number(r, &run[1])};
        for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
            const double value = rb_rolling_number(r, &own);
            if (r->error_bar != scales[k].scale || isnan(value + v[0] + v[1]))
                continue;
            const double bar = rb_rolling_contact_error(v, value) + scales[k].least;
            CHECK_REL(rb_rolling_number(r, &e.scalar), bar, 1e-9, "%s", r->name);
            seen++;
        }
        if (r->error_bar == RB_SCALE_NONE && r->kind != RB_RESULT_WHOLE)
            assert_true(isnan(rb_rolling_number(r, &e.scalar)));
    }
    assert_true(seen >= 12);
    for (int k = 0; k < 2; k++)
        rb_rolling_solution_free(&run[k]);
    rb_rolling_solution_free(&own);
}

TEST(every_scalar_has_its_bar)
{
    rb_rolling_case rc = carter(40);
    check_bars(&rc);
    rc.elastic_b = 0;
    rc.creep_ratio = NAN;
    rc.force_ratio = -0.5;
    check_bars(&rc);
}

/* ---- Histories --------------------------------------------------------------------- */

TEST(a_history_has_bars_of_its_steps)
{
    const double distance[] = {0.0, 0.0, 0.6}, load[] = {300.0, 500.0, 500.0},
                 force[] = {0.0, -50.0, -60.0};
    const rb_rolling_program program = {
        .n = 3, .distance = distance, .load = load, .force = force};
    rb_rolling_case rc = carter(24);
    rb_rolling_model model;
    rb_rolling_history h, run[2];
    rb_message why = {""};
    rc.formulation = RB_TRANSIENT;
    rc.creep_ratio = NAN;
    rc.load = NAN;
    if (rb_rolling_history_with_errors(&rc, &program, NULL, &model, &h, &why) != RB_OK)
        fail_msg("%s", why.text);
    rb_rolling_model_free(&model);
    assert_non_null(h.errors);
    assert_int_equal(h.errors->n, h.n);
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = rb_rolling_error_run(&rc, k);
        CHECK_STATUS(
            rb_rolling_history_run(&coarser, &program, NULL, &model, &run[k], &why),
            RB_OK);
        rb_rolling_model_free(&model);
    }
    for (int i = 0; i < 2; i++) { /* at rest: the same steps */
        const double at[] = {run[0].approach[i], run[1].approach[i]};
        CHECK_ABS(h.errors->approach[i], rb_rolling_contact_error(at, h.approach[i]),
                  1e-14, "approach of step %d", i);
    }
    /* the last one ends where theirs ends; its bar is no less than its own and its
     * neighbour's */
    const int last = h.n - 1;
    const double end[] = {run[0].approach[run[0].n - 1], run[1].approach[run[1].n - 1]};
    assert_true(h.errors->approach[last] >=
                rb_rolling_contact_error(end, h.approach[last]));
    assert_true(h.errors->approach[last] >= 0.0);
    for (int i = 2; i < h.n; i++)
        assert_true(h.errors->creepage[i] >= 0.0 && h.errors->dissipation[i] > 0.0);
    for (int k = 0; k < 2; k++)
        rb_rolling_history_free(&run[k]);
    rb_rolling_history_free(&h);
    assert_null(h.errors);

    rb_rolling_case memory = carter(24);
    const rb_rolling_program timed = {.n = 2, .time = distance, .load = load};
    memory.formulation = RB_STATIC;
    memory.creep_ratio = NAN;
    memory.a.memory = (rb_rolling_memory){1, {1.0}, {0.5}};
    CHECK_STATUS(rb_rolling_history_with_errors(&memory, &timed, NULL, &model, &h, &why),
                 RB_EINVAL);
    assert_non_null(strstr(why.text, "a history in time has none"));
    rb_rolling_history_free(&h);
}

/* ---- To an accuracy ---------------------------------------------------------------- */

TEST(an_accuracy_is_reached_by_more_elements)
{
    static const double accuracy[] = {0.9, 0.05, 0.01};
    int before = 0;
    for (int k = 0; k < 3; k++) {
        const rb_rolling_case rc = carter(24);
        rb_rolling_solution s;
        rb_rolling_errors e;
        rb_message why = {""};
        int elements;
        if (rb_rolling_solve_to_accuracy(&rc, accuracy[k], &s, &e, &elements, &why) !=
            RB_OK)
            fail_msg("%s", why.text);
        CHECK_MAX(e.scalar.force_ratio, accuracy[k], "Q/(mu P)");
        CHECK_MAX(e.scalar.half_width / s.half_width, accuracy[k], "half-width");
        CHECK_MAX(e.scalar.max_pressure / s.max_pressure, accuracy[k], "p0");
        CHECK_ABS(s.force_ratio, -0.75, accuracy[k], "Carter");
        assert_true(elements >= before && (k == 0) == (elements == 24));
        before = elements;
        rb_rolling_solution_free(&s);
    }
    CHECK_MAX(before, 1600, "elements");
}

/* Unlike bodies under little friction: their creepage of free rolling (Bentall and
 * Johnson) is hundreds of mu a/R, and its error is judged by itself. */
TEST(little_friction_asks_for_no_more_elements)
{
    rb_rolling_case rc = carter(40);
    rb_rolling_solution s;
    rb_rolling_errors e;
    rb_message why = {""};
    int elements;
    rc.b.young = rc.a.young / 40.0;
    rc.creep_ratio = NAN;
    rc.force = 0.0;
    rc.mu = 1e-4;
    if (rb_rolling_solve_to_accuracy(&rc, 0.2, &s, &e, &elements, &why) != RB_OK)
        fail_msg("%s", why.text);
    const double unit = rc.mu * s.hertz_half_width / rc.a.radius;
    const double exact = rb_closed_bentall_johnson_slip(
        fabs(rb_rolling_derive(&rc).dundurs), s.hertz_half_width, rc.a.radius);
    CHECK_MAX(elements, 80, "elements");
    CHECK_MAX(e.scalar.creepage, 0.2 * fabs(s.creepage), "the error of the creepage");
    assert_true(e.scalar.creepage > 5.0 * unit);
    CHECK_ABS(fabs(s.creepage), exact, e.scalar.creepage, "Bentall and Johnson");
    rb_rolling_solution_free(&s);
}

TEST(what_is_no_accuracy_is_refused)
{
    static const double accuracy[] = {0.0, 1.0, -0.1, NAN};
    for (int k = 0; k < 4; k++) {
        const rb_rolling_case rc = carter(20);
        rb_rolling_solution s;
        rb_rolling_errors e;
        rb_message why = {""};
        int elements;
        CHECK_STATUS(
            rb_rolling_solve_to_accuracy(&rc, accuracy[k], &s, &e, &elements, &why),
            RB_EINVAL);
        assert_non_null(strstr(why.text, "accuracy: expected in (0, 1)"));
    }
}

/* Each that makes coarser runs refuses a case that cannot be halved. */
TEST(nothing_is_halved_below_its_least)
{
    rb_rolling_case rc = carter(4);
    rb_rolling_solution s = {0};
    rb_rolling_errors errors;
    rb_rolling_curve curve, bars;
    rb_rolling_model model;
    rb_rolling_history h;
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_error_check(&rc, &why), RB_EINVAL);
    CHECK_STATUS(rb_rolling_estimate_errors(&rc, &s, NULL, &errors, &why), RB_EINVAL);
    assert_true(isnan(errors.scalar.normal_load));
    CHECK_STATUS(rb_rolling_curve_with_errors(&rc, &(rb_rolling_range){0, 0.0, 1.0, 2},
                                              &curve, &bars, &why),
                 RB_EINVAL);
    rc.formulation = RB_TRANSIENT;
    rc.distance = 1.0;
    CHECK_STATUS(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &h, &why),
                 RB_EINVAL);
    rb_rolling_history_free(&h);
    rb_rolling_model_free(&model);
}

/* The limit is told with what was reached; equal elements hear of fitted ones. */
TEST(an_accuracy_that_no_mesh_has_is_refused_at_once)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = carter(12);
        rb_rolling_solution s;
        rb_rolling_errors errors;
        rb_message why = {""};
        int elements;
        rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        CHECK_STATUS(
            rb_rolling_solve_to_accuracy(&rc, 1e-12, &s, &errors, &elements, &why),
            RB_INACCURATE);
        assert_int_equal(elements, 12);
        assert_non_null(strstr(why.text, "accuracy 1e-12 not reached with 12 elements"));
        assert_int_equal(strstr(why.text, "a fitted mesh needs fewer") != NULL, !k);
        rb_rolling_solution_free(&s);
    }
}

/* Memory that is refused to a later round leaves the best solution so far. */
TEST(a_later_round_that_fails_leaves_the_one_before)
{
    int none = 0, some = 0;
    for (int count = 50; count < 3000; count = count * 5 / 4) {
        rb_rolling_case rc = carter(12);
        rb_rolling_solution s;
        rb_rolling_errors errors;
        rb_message why = {""};
        int elements;
        alloc_fail_after(count);
        const rb_status status =
            rb_rolling_solve_to_accuracy(&rc, 0.05, &s, &errors, &elements, &why);
        const int failed = alloc_failed();
        alloc_succeed();
        if (failed && elements > 0) {
            CHECK_STATUS(status, RB_INACCURATE);
            CHECK_REL(s.normal_load, 500.0, 1e-9, "the load");
            assert_true(elements >= 12 && isfinite(errors.scalar.force_ratio));
        }
        none += failed && elements == 0;
        some += failed && elements > 0;
        rb_rolling_solution_free(&s);
    }
    assert_true(none > 0 && some > 0);
}

/* Under a given force the creepage is what has to be accurate, in units of full sliding.
 */
TEST(a_given_force_has_an_accurate_creepage)
{
    static const double accuracy[] = {0.1, 0.05, 0.02};
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = carter(12);
        rb_rolling_solution s;
        rb_rolling_errors e;
        rb_message why = {""};
        int elements;
        rc.creep_ratio = NAN;
        rc.force_ratio = -0.9;
        rc.mesh = k < 3 ? RB_MESH_UNIFORM : RB_MESH_FITTED;
        if (rb_rolling_solve_to_accuracy(&rc, accuracy[k % 3], &s, &e, &elements, &why) !=
            RB_OK)
            fail_msg("%s", why.text);
        CHECK_MAX(e.scalar.creepage * rb_rolling_radius(&rc) / (rc.mu * s.half_width),
                  accuracy[k % 3], "case %d", k);
        rb_rolling_solution_free(&s);
    }
}

/* Twice the elements make twice the steps: what is told is the solution of that case. */
TEST(accuracy_takes_more_steps_too)
{
    rb_rolling_case rc = carter(12);
    rb_rolling_solution s;
    rb_rolling_errors errors;
    int elements;
    rc.formulation = RB_TRANSIENT;
    rc.distance = 1.0;
    rc.steps = 4;
    CHECK_STATUS(rb_rolling_solve_to_accuracy(&rc, 0.3, &s, &errors, &elements, NULL),
                 RB_OK);
    assert_true(elements > 12 && elements % 12 == 0);
    rc.contact_elements = elements;
    rc.steps = 4 * elements / 12;
    rb_rolling_solution same = solved(&rc);
    CHECK_REL(s.tangential_load, same.tangential_load, 1e-12, "Q");
    rb_rolling_solution_free(&same);
    rb_rolling_solution_free(&s);
}

RUN_TESTS(NULL, NULL)
