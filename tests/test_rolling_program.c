/* The program of a history: the case of each of its steps, its refusals, and the program
 * that a case brings along. */
#include "check.h"
#include "study/internal.h"

#include <string.h>

static rb_rolling_case relaxing(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.a.memory = (rb_rolling_memory){1, {2.0}, {0.5}};
    rc.load = 10.0;
    return rc;
}

static rb_rolling_case rolling(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.formulation = RB_TRANSIENT;
    rc.load = 10.0;
    return rc;
}

/* ---- The case of a step ------------------------------------------------------------ */

TEST(no_part_of_a_row_is_longer_than_the_time_step)
{
    const double time[] = {0.0, 1.0, 3.0, 3.0, 3.3}, load[] = {1.0, 2.0, 6.0, 7.0, 8.0};
    const rb_rolling_program program = {.n = 5, .time = time, .load = load},
                             timeless = {.n = 5, .load = load};
    static const struct {
        double step;
        int parts[5];
    } rows[] = {
        {0.0, {1, 1, 1, 1, 1}},  {0.5, {1, 2, 4, 1, 1}},
        {0.3, {1, 4, 7, 1, 1}},  {0.1, {1, 10, 20, 1, 3}}, /* 0.3/0.1, to rounding */
        {10.0, {1, 1, 1, 1, 1}}, {1e-9, {1, 10000000, 10000000, 1, 10000000}}};
    rb_rolling_case rc = relaxing();
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        for (int r = 0; r < 5; r++) {
            rc.time_step = rows[k].step;
            assert_int_equal(rb_rolling_program_parts(&program, &rc, r),
                             rows[k].parts[r]);
            assert_int_equal(rb_rolling_program_parts(&timeless, &rc, r), 1);
        }
    for (int part = 1; part <= 4; part++)
        CHECK_ABS(rb_rolling_program_row(&program, &rc, 2, part, 4).load, 2.0 + part, 0.0,
                  "part %d of the way from 2 to 6", part);
    CHECK_ABS(rb_rolling_program_row(&program, &rc, 0, 1, 1).load, 1.0, 0.0, "row 1");
    assert_true(isnan(rb_rolling_program_row(&program, &rc, 2, 1, 2).approach));
}

/* Loads are those of the end of a step, creepages the mean over it, exact over rows that
 * lie inside. */
TEST(a_rolled_step_has_the_mean_creepage)
{
    const double distance[] = {0.0, 1.0, 3.0}, creep[] = {0.0, 1.0, 5.0},
                 load[] = {10.0, 20.0, 40.0}, equal[] = {0.1, 0.1, 0.1};
    const rb_rolling_program program = {
        .n = 3, .distance = distance, .creep = creep, .load = load, .force_ratio = equal};
    static const struct {
        double from, to, creep, load;
    } steps[] = {{0.0, 0.5, 0.25, 15.0},      {0.0, 1.0, 0.5, 20.0},
                 {0.5, 1.5, 1.125, 25.0}, /* 0.75 and 1.5, half each */
                 {0.0, 2.0, 1.25, 30.0},      {2.0, 3.0, 4.0, 40.0},
                 {0.0, 3.0, 13.0 / 6.0, 40.0}};
    const rb_rolling_case rc = rolling();
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        const rb_rolling_case at =
            rb_rolling_program_step(&program, &rc, steps[k].from, steps[k].to);
        CHECK_REL(at.creep, steps[k].creep, 1e-15, "step %zu: creepage", k);
        CHECK_REL(at.load, steps[k].load, 1e-15, "step %zu: load", k);
        CHECK_ABS(at.force_ratio, 0.1, 0.0, "to the last digit");
        assert_true(isnan(at.approach));
    }
}

/* At rest a creepage means nothing: the first step goes on from the last row there. */
TEST(rolling_begins_with_the_last_row_at_rest)
{
    const double distance[] = {0.0, 0.0, 0.0, 1.0}, creep[] = {9.0, 5.0, 1.0, 3.0};
    const rb_rolling_program program = {.n = 4, .distance = distance, .creep = creep},
                             still = {.n = 3, .distance = distance}, timeless = {.n = 3};
    const rb_rolling_case rc = rolling();
    CHECK_REL(rb_rolling_program_step(&program, &rc, 0.0, 0.5).creep, 1.5, 1e-15,
              "mean of 1 and 2");
    CHECK_REL(rb_rolling_program_step(&program, &rc, 0.5, 1.0).creep, 2.5, 1e-15, "then");
    assert_int_equal(rb_rolling_program_at_rest(&program), 3);
    assert_int_equal(rb_rolling_program_at_rest(&still), 3);
    assert_int_equal(rb_rolling_program_at_rest(&timeless), 3);
}

TEST(results_refer_to_the_largest_mu)
{
    const double mu[] = {0.1, 0.4, 0.2};
    rb_rolling_case rc = rolling();
    const rb_rolling_program with = {.n = 3, .mu = mu}, without = {.n = 3},
                             empty = {.n = 0, .mu = mu};
    CHECK_ABS(rb_rolling_program_base(&with, &rc).mu, 0.4, 0.0, "largest");
    assert_int_equal(rb_rolling_program_base(&with, &rc).friction.follows_way, 1);
    CHECK_ABS(rb_rolling_program_base(&without, &rc).mu, 0.3, 0.0, "the case's");
    assert_int_equal(rb_rolling_program_base(&without, &rc).friction.follows_way, 0);
    CHECK_ABS(rb_rolling_program_base(&empty, &rc).mu, 0.3, 0.0, "the case's");
}

/* ---- Refusals ---------------------------------------------------------------------- */

#define REFUSED(words, rc, ...)                                                          \
    do {                                                                                 \
        const rb_rolling_program program = {__VA_ARGS__};                                \
        const rb_rolling_case one = rc;                                                  \
        rb_message why = {""};                                                           \
        CHECK_STATUS(rb_rolling_program_check(&program, &one, &why), RB_EINVAL);         \
        if (!strstr(why.text, words))                                                    \
            fail_msg("'%s' does not say '%s'", why.text, words);                         \
    } while (0)
#define ACCEPTED(rc, ...)                                                                \
    do {                                                                                 \
        const rb_rolling_program program = {__VA_ARGS__};                                \
        const rb_rolling_case one = rc;                                                  \
        rb_message why = {""};                                                           \
        if (rb_rolling_program_check(&program, &one, &why) != RB_OK)                     \
            fail_msg("%s", why.text);                                                    \
    } while (0)

TEST(programs_that_make_no_sense_are_refused)
{
    const double d[] = {0.0, 0.0, 1.0}, late[] = {0.1, 0.2, 1.0},
                 back[] = {0.0, 2.0, 1.0}, twice[] = {0.0, 1.0, 1.0},
                 load[] = {1.0, 2.0, 3.0}, none[] = {1.0, NAN, 3.0},
                 far[] = {0.0, 0.4, 0.8}, pull[] = {1.0, 2.0, -3.0};
    rb_rolling_case rest = rb_rolling_case_defaults(), steady = rest, table = rest;
    steady.formulation = RB_STEADY;
    table.friction = (rb_rolling_friction){.law = RB_FRICTION_table,
                                           .table = {.n = 3, .x = d, .y = load}};

    ACCEPTED(rest, .n = 3, .load = load);
    ACCEPTED(rolling(), .n = 3, .distance = d, .load = load);
    ACCEPTED(relaxing(), .n = 3, .time = d, .load = load);
    REFUSED("expected 1 row", rest, .n = 0, .load = load);
    REFUSED("steady rolling has none", steady, .n = 3, .load = load);
    REFUSED("needs a column distance", rolling(), .n = 3, .load = load);
    REFUSED("is for transient", rest, .n = 3, .distance = d, .load = load);
    REFUSED("column time is for static", rolling(), .n = 3, .distance = d, .time = d);
    REFUSED("is for viscoelastic bodies", rest, .n = 3, .time = d);
    REFUSED("column mu cannot be combined with a table", table, .n = 3, .mu = load);
    REFUSED("row 2: load is not a number", rest, .n = 3, .load = none);
    REFUSED("row 1: expected distance 0", rolling(), .n = 3, .distance = late);
    REFUSED("row 3: distance 1 is less", rolling(), .n = 3, .distance = back);
    REFUSED("row 3: distance 1 twice", rolling(), .n = 3, .distance = twice);
    REFUSED("needs a column time", relaxing(), .n = 3, .load = load);
    REFUSED("row 1: expected time 0", relaxing(), .n = 3, .time = late);
    REFUSED("row 3: time 1 is before", relaxing(), .n = 3, .time = back);
    REFUSED("history: row 3: load: expected > 0, got -3", rest, .n = 3, .load = pull);

    rb_rolling_case fine = relaxing();
    fine.time_step = 1.0000001e-7; /* 1e7 steps */
    ACCEPTED(fine, .n = 3, .time = d);
    fine.time_step = 4e-8; /* of a row no more than 1e7 count */
    ACCEPTED(fine, .n = 2, .time = twice);
    REFUSED("time step: 4e-08 s makes 2e+07 steps", fine, .n = 3, .time = far,
            .load = load);
}

/* ---- The program of a case --------------------------------------------------------- */

static void check_rows(const double *got, const double *wanted, int n, const char *what)
{
    for (int r = 0; r < n; r++)
        CHECK_ABS(got[r], wanted[r], 1e-15 * fabs(wanted[r]), "row %d: %s", r, what);
}

TEST(increments_press_first_and_load_then)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_program program;
    rc.increments = 2;
    rc.approach = 0.1;
    rc.shift = 0.02;
    double *columns = rb_rolling_program_of_case(&rc, &program);
    static const double approach[] = {0.05, 0.1, 0.1, 0.1},
                        shift[] = {0.0, 0.0, 0.01, 0.02};
    assert_int_equal(program.n, 4);
    assert_null(program.load);
    assert_null(program.distance);
    check_rows(program.approach, approach, 4, "approach");
    check_rows(program.shift, shift, 4, "shift");
    free(columns);

    rc.approach = rc.shift = NAN;
    rc.load = 10.0;
    columns = rb_rolling_program_of_case(&rc, &program);
    assert_int_equal(program.n, 2); /* a shift of 0 loads nothing */
    CHECK_ABS(program.load[0], 5.0, 0.0, "half the load");
    CHECK_ABS(program.load[1], 10.0, 0.0, "the load");
    free(columns);

    rc.force = -2.0;
    columns = rb_rolling_program_of_case(&rc, &program);
    assert_int_equal(program.n, 4);
    assert_null(program.shift);
    CHECK_ABS(program.force[2], -1.0, 0.0, "half the force");
    free(columns);
}

TEST(a_transient_rolls_under_its_loads)
{
    rb_rolling_case rc = rolling();
    rb_rolling_program program;
    rc.distance = 3.0;
    rc.increments = 2;
    rc.force_ratio = 0.5;
    double *columns = rb_rolling_program_of_case(&rc, &program);
    static const double load[] = {5.0, 10.0, 10.0, 10.0, 10.0},
                        ratio[] = {0.0, 0.0, 0.25, 0.5, 0.5},
                        distance[] = {0.0, 0.0, 0.0, 0.0, 3.0};
    assert_int_equal(program.n, 5);
    check_rows(program.load, load, 5, "load");
    check_rows(program.force_ratio, ratio, 5, "Q/(mu P)");
    check_rows(program.distance, distance, 5, "distance");
    free(columns);

    rc.force_ratio = NAN;
    rc.creep = 0.001;
    rc.increments = 1;
    columns = rb_rolling_program_of_case(&rc, &program);
    assert_int_equal(program.n, 2); /* driven by its creepage: no force at rest */
    assert_null(program.force);
    assert_null(program.force_ratio);
    assert_null(program.shift);
    free(columns);
}

RUN_TESTS(NULL, NULL)
