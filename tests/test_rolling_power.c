/* Powers of made-up slip and friction, recomputed, and that they add up. */
#include "check.h"
#include "study/internal.h"

enum { N = 5 };

static double shift[N] = {0.3, -0.1, 0.0, 0.2, 0.7}, q[N] = {1.0, -2.0, 3.0, 0.5, 4.0},
              h[N] = {0.5, 0.25, 1.0, 2.0, 0.125}, slip[N] = {0.1, 0.2, -0.3, 0.4, 0.5},
              e_T[N] = {2.0, 3.0, 4.0, 5.0, 6.0};

TEST(steady_slip_lies_between_two_midpoints)
{
    const rb_rolling_solution s = {
        .n = N, .shift = shift, .q = q, .h = h, .slip = slip, .formulation = RB_STEADY};
    rb_rolling_case rc = rb_rolling_case_defaults();
    double power[N], sum = 0.0;
    rc.formulation = RB_STEADY;
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < N; i++) {
        const double before = i > 0 ? shift[i - 1] : 0.0;
        CHECK_REL(power[i], -0.5 * (before + shift[i]) * q[i] / h[i], 1e-15, "%d", i);
        sum += power[i] * h[i];
    }
    CHECK_REL(rb_rolling_dissipated_power(&rc, N, shift, q, h, e_T), sum, 1e-14, "all");
    CHECK_REL(sum, -0.5 * (0.3 * -1.0 + -0.1 * 1.0 + 0.2 * 4.5 + 0.7 * 4.0), 1e-14,
              "sum of lambda_i (q_i + q_i+1)/2");
}

/* Beside the edges the mean friction of an element in contact and an open one is no
 * friction of anything that slips. */
TEST(what_sticks_dissipates_nothing)
{
    double opens[N] = {0.3, 0.0, 0.0, 0.0, -0.1}, sticks[N] = {0.0, -2.0, 3.0, 0.5, 0.0};
    const rb_rolling_solution s = {.n = N,
                                   .shift = opens,
                                   .q = sticks,
                                   .h = h,
                                   .slip = slip,
                                   .formulation = RB_STEADY};
    rb_rolling_case rc = rb_rolling_case_defaults();
    double power[N];
    rc.formulation = RB_STEADY;
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < N; i++)
        CHECK_ABS(power[i], 0.0, 0.0, "%d", i);
    CHECK_ABS(rb_rolling_dissipated_power(&rc, N, opens, sticks, h, e_T), 0.0, 0.0, "D");
    CHECK_ABS(rb_rolling_slid_pressure(&rc, N, opens, sticks, h, e_T), 0.0, 0.0, "wear");
}

TEST(other_slip_belongs_to_its_element)
{
    rb_rolling_solution s = {
        .n = N, .shift = shift, .q = q, .h = h, .slip = slip, .formulation = RB_STEADY};
    rb_rolling_case rc = rb_rolling_case_defaults();
    double power[N], want = 0.0;
    for (int i = 0; i < N; i++)
        want -= shift[i] / e_T[i] * q[i] * h[i];
    s.slip_operator = RB_SLIP_SECOND;
    for (int k = 0; k < 2; k++) {
        rc.formulation = s.formulation = k ? RB_TRANSIENT : RB_STEADY;
        rc.slip_operator = s.slip_operator = k ? RB_SLIP_UPSTREAM : RB_SLIP_SECOND;
        rb_rolling_friction_power(&s, power);
        for (int i = 0; i < N; i++)
            CHECK_REL(power[i], -slip[i] * q[i], 1e-15, "%d", i);
        CHECK_REL(rb_rolling_dissipated_power(&rc, N, shift, q, h, e_T), want, 1e-14,
                  "all");
    }
    rc.formulation = s.formulation = RB_STATIC;
    rb_rolling_friction_power(&s, power);
    for (int i = 0; i < N; i++)
        assert_true(isnan(power[i]));
    assert_true(isnan(rb_rolling_dissipated_power(&rc, N, shift, q, h, e_T)));
}

TEST(elastic_bodies_lose_nothing)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    const rb_rolling_model model = {.rc = &rc};
    double power;
    CHECK_STATUS(rb_rolling_hysteresis(&model, &power), RB_OK);
    assert_true(isnan(power)); /* static */
    rc.formulation = RB_STEADY;
    CHECK_STATUS(rb_rolling_hysteresis(&model, &power), RB_OK);
    CHECK_ABS(power, 0.0, 0.0, "steady");
}

RUN_TESTS(NULL, NULL)
