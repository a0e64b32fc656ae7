/* The laws of friction by their formulas, their largest and steepest values, refusals. */
#include "refused.h"
#include "study/internal.h"

static rb_rolling_case law(rb_rolling_friction_law which, double m1, double m2)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.formulation = RB_STEADY;
    rc.friction =
        (rb_rolling_friction){.law = which, .fall = {m1, m2}, .slip_scale = {3.0, 7.0}};
    return rc;
}

/* A term without a fall has no scale: 0/0 would be no number. */
TEST(each_law_is_its_formula)
{
    static const double velocities[] = {0.0, 0.5, 3.0, 6.0, 7.0, 10.0, 14.0, 1e9};
    for (size_t k = 0; k < sizeof velocities / sizeof *velocities; k++) {
        const double v = velocities[k];
        rb_rolling_case rc = law(RB_FRICTION_exponential, 0.2, 0.1);
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + 0.2 * pow(0.5, v / 3.0) + 0.1 * pow(0.5, v / 7.0), 1e-14,
                  "exponential at %g", v);
        rc.friction.law = RB_FRICTION_rational;
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + 0.2 * 3.0 / (3.0 + v) + 0.1 * 49.0 / (49.0 + v * v), 1e-14,
                  "rational at %g", v);
        rc.friction.law = RB_FRICTION_linear;
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + (v < 6.0 ? 0.2 - 0.2 * v / 6.0 : 0.0) +
                      (v < 14.0 ? 0.1 - 0.1 * v / 14.0 : 0.0),
                  1e-14, "linear at %g", v);
        rc.friction.law = RB_FRICTION_constant;
        CHECK_ABS(rb_rolling_law_mu(&rc, 9.0, v, 0.0), 0.3, 0.0, "constant at %g", v);
        for (int one = 0; one < 2; one++) {
            rc = law(RB_FRICTION_exponential, one ? 0.2 : 0.0, one ? 0.0 : 0.1);
            rc.friction.slip_scale[one] = 0.0;
            CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                      0.3 + (one ? 0.2 * pow(0.5, v / 3.0) : 0.1 * pow(0.5, v / 7.0)),
                      1e-14, "one term at %g", v);
        }
    }
}

TEST(a_table_is_linear_between_its_rows)
{
    const double x[] = {-1.0, 0.0, 3.0}, y[] = {0.7, 0.7, 0.1};
    const rb_rolling_table t = {3, x, y}, one = {1, x + 1, y + 2};
    rb_rolling_case rc = law(RB_FRICTION_table, 0.0, 0.0);
    CHECK_ABS(rb_rolling_friction_at(&t, -9.0), 0.7, 0.0, "before");
    CHECK_ABS(rb_rolling_friction_at(&t, -1.0), 0.7, 0.0, "the first row");
    CHECK_ABS(rb_rolling_friction_at(&t, 0.0), 0.7, 0.0, "a row");
    CHECK_REL(rb_rolling_friction_at(&t, 1.0), 0.5, 1e-15, "between");
    CHECK_ABS(rb_rolling_friction_at(&t, 3.0), 0.1, 0.0, "the last row, to the digit");
    CHECK_ABS(rb_rolling_friction_at(&t, 9.0), 0.1, 0.0, "behind");
    const rb_rolling_table falls = {2, x + 1, y + 1};
    CHECK_REL(rb_rolling_friction_at(&falls, 1e-9), 0.7 - 0.2e-9, 1e-15, "behind a row");
    CHECK_REL(rb_rolling_friction_at(&falls, 1.5), 0.4, 1e-15, "in the middle of two");
    CHECK_ABS(rb_rolling_friction_at(&one, 5.0), 0.1, 0.0, "a single row");
    CHECK_ABS(rb_rolling_friction_at(&one, -5.0), 0.1, 0.0, "a single row");
    rc.friction.table = t;
    CHECK_REL(rb_rolling_law_mu(&rc, 1.0, 5.0, 0.0), 0.5, 1e-15, "of the place alone");
    CHECK_REL(rb_rolling_law_at_rest(&rc, 2.0), 0.3, 1e-14, "of the place alone");
    CHECK_ABS(rb_rolling_largest_mu(&rc), 0.7, 0.0, "largest");
    assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), 0);
    assert_int_equal(rb_rolling_law_depends_on_state(&rc), 0);
}

/* Whichever row has it; mu beside a table counts for nothing. */
TEST(the_largest_of_a_table_is_that_of_any_row)
{
    const double x[] = {-1.0, 0.0, 3.0};
    for (int at = 0; at < 3; at++) {
        const double y[] = {at == 0 ? 0.2 : 0.15, at == 1 ? 0.2 : 0.1,
                            at == 2 ? 0.2 : 0.05};
        rb_rolling_case rc = law(RB_FRICTION_table, 0.0, 0.0);
        rc.friction.table = (rb_rolling_table){3, x, y};
        CHECK_ABS(rb_rolling_largest_mu(&rc), 0.2, 0.0, "row %d", at);
    }
}

TEST(heat_adds_its_part)
{
    rb_rolling_case rc = law(RB_FRICTION_constant, 0.0, 0.0);
    rc.friction.heat = -0.2;
    rc.friction.heat_from = 100.0;
    rc.friction.heat_range = 50.0;
    CHECK_ABS(rb_rolling_law_mu(&rc, 0.0, 0.0, 20.0), 0.3, 0.0, "cold");
    CHECK_REL(rb_rolling_law_mu(&rc, 0.0, 0.0, 110.0), 0.26, 1e-14, "a fifth");
    CHECK_REL(rb_rolling_law_mu(&rc, 0.0, 0.0, 900.0), 0.1, 1e-14, "all of it");
    rc.heat_a.temperature = 125.0;
    CHECK_REL(rb_rolling_law_at_rest(&rc, 0.0), 0.2, 1e-14, "a warm body");
    assert_int_equal(rb_rolling_law_depends_on_state(&rc), 1);
    CHECK_ABS(rb_rolling_largest_mu(&rc), 0.3, 0.0, "heat takes off");
    rc.friction.heat = 0.2;
    CHECK_REL(rb_rolling_largest_mu(&rc), 0.5, 1e-15, "heat adds");
}

TEST(the_largest_coefficient_is_at_rest_or_fast)
{
    static const struct {
        double m1, m2, largest;
    } rows[] = {{0.2, 0.1, 0.6}, {0.2, -0.1, 0.5}, {-0.1, -0.2, 0.3}, {0.0, 0.0, 0.3}};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = law(RB_FRICTION_rational, rows[k].m1, rows[k].m2);
        CHECK_REL(rb_rolling_largest_mu(&rc), rows[k].largest, 1e-14, "row %d", k);
        assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), k < 3);
        assert_int_equal(rb_rolling_law_depends_on_state(&rc), k < 3);
        rc.formulation = RB_STATIC;
        assert_int_equal(rb_rolling_law_depends_on_state(&rc), 0);
        rc.friction.law = RB_FRICTION_constant; /* knows no falls */
        CHECK_ABS(rb_rolling_largest_mu(&rc), 0.3, 0.0, "row %d", k);
        assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), 0);
    }
}

/* The steepest fall of each term by differences; two terms by no less than their sum. */
TEST(the_steepest_fall_is_that_of_the_formula)
{
    static const rb_rolling_friction_law laws[] = {
        RB_FRICTION_exponential, RB_FRICTION_rational, RB_FRICTION_linear};
    for (int k = 0; k < 3; k++) {
        double of[2];
        for (int term = 0; term < 2; term++) {
            const rb_rolling_case rc = law(laws[k], term ? 0.0 : 0.2, term ? 0.1 : 0.0);
            of[term] = 0.0;
            for (double v = 0.0; v < 20.0; v += 1e-3)
                of[term] = fmax(of[term], (rb_rolling_law_mu(&rc, 0.0, v, 0.0) -
                                           rb_rolling_law_mu(&rc, 0.0, v + 1e-4, 0.0)) /
                                              1e-4);
            CHECK_REL(rb_rolling_law_steepest(&rc), of[term], 1e-3, "law %d, term %d", k,
                      term);
        }
        const rb_rolling_case both = law(laws[k], 0.2, 0.1),
                              rising = law(laws[k], 0.2, -0.1);
        CHECK_REL(rb_rolling_law_steepest(&both), of[0] + of[1], 1e-3, "both");
        CHECK_REL(rb_rolling_law_steepest(&rising), of[0], 1e-3,
                  "what rises is not steep");
    }
    const rb_rolling_case constant = law(RB_FRICTION_constant, 0.0, 0.0);
    CHECK_ABS(rb_rolling_law_steepest(&constant), 0.0, 0.0, "constant");
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(tables_of_no_friction_are_refused)
{
    const double x[3] = {-1.0, 0.0, 1.0}, back[3] = {-1.0, 1.0, 1.0},
                 gone[3] = {-1.0, NAN, 1.0}, mu[3] = {0.0, 0.2, 0.3},
                 less[3] = {0.2, -0.1, 0.3}, lost[3] = {0.2, NAN, 0.3};
#define MU(x, y)                                                                         \
    rc.friction.law = RB_FRICTION_table, rc.friction.table = (rb_rolling_table){3, x, y}
    ACCEPTED(MU(x, mu));
    REFUSED("friction table: expected a row", MU(x, mu); rc.friction.table.n = 0);
    REFUSED("friction table: row 3: expected x to increase, got 1", MU(back, mu));
    REFUSED("friction table: row 2: expected x to increase", MU(gone, mu));
    REFUSED("friction table: row 2: expected mu >= 0, got -0.1", MU(x, less));
    REFUSED("friction table: row 2: expected mu >= 0", MU(x, lost));
#undef MU
}

#define FALLS                                                                            \
    STEADY;                                                                              \
    rc.speed = 1.0;                                                                      \
    rc.friction.law = RB_FRICTION_rational;                                              \
    rc.friction.fall[1] = 0.1;                                                           \
    rc.friction.slip_scale[1] = 1.0

TEST(ranges_of_friction_laws)
{
    ACCEPTED(FALLS);
    ACCEPTED(FALLS; rc.formulation = RB_STATIC; rc.speed = 0.0);
    ACCEPTED(FALLS; rc.friction.slip_scale[0] = -1.0); /* of no fall */
    ACCEPTED(FALLS; rc.friction.fall[0] = -rc.mu; rc.friction.slip_scale[0] = 1.0);
    REFUSED("expected mu >= 0 everywhere", FALLS; rc.friction.fall[0] = -0.31;
            rc.friction.slip_scale[0] = 1.0);
    REFUSED("expected a slip scale > 0", FALLS; rc.friction.fall[0] = INFINITY);
    REFUSED("expected a slip scale > 0", FALLS; rc.friction.slip_scale[1] = 0.0);
    REFUSED("expected a slip scale > 0", FALLS; rc.friction.slip_scale[1] = INFINITY);
    REFUSED("friction law rational: needs the speed", FALLS; rc.speed = 0.0);
    REFUSED("friction law rational: needs the speed", FALLS; rc.speed = INFINITY);
    ACCEPTED(FALLS; rc.friction.memory = 1.0; rc.friction.memory_slip = 1.0);
    REFUSED("friction memory: expected", FALLS; rc.friction.memory = -1.0);
    REFUSED("friction memory: expected", FALLS; rc.friction.memory = INFINITY);
    REFUSED("friction memory: expected", FALLS; rc.friction.memory = 1.0);

    ACCEPTED(WARM; rc.friction.heat = -0.3; rc.friction.heat_range = 100.0);
    ACCEPTED(rc.friction.heat = -0.3; rc.friction.heat_range = 100.0); /* at rest */
    REFUSED("expected mu >= 0 everywhere", WARM; rc.friction.heat = -0.31;
            rc.friction.heat_range = 100.0);
    REFUSED("friction and heat: needs temperatures", STEADY; rc.friction.heat = -0.1;
            rc.friction.heat_range = 100.0);
    REFUSED("friction and heat: expected a change", WARM; rc.friction.heat = INFINITY);
    REFUSED("friction and heat: expected a change", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_range = 0.0);
    REFUSED("friction and heat: expected a change", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_range = INFINITY);
    REFUSED("friction and heat: expected a change", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_from = NAN; rc.friction.heat_range = 100.0);
}

RUN_TESTS(NULL, NULL)
