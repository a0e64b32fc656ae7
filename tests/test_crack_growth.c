/* Growth of cracks by Paris's law: against cracks that have that length from the start,
 * by its order of convergence, in other units, and what is refused. */
#include "check.h"
#include "rollbem/api.h"

#include <gsl/gsl_math.h>

/* Similar half-planes without friction, with these words besides. */
static rb_api *contact(const char *words)
{
    rb_api *a = NOT_NULL(rb_api_create_for("crack"));
    char text[200], *rest = text;
    snprintf(text, sizeof text, "support halfplane similar yes mu 0 %s", words);
    for (char *name; (name = strtok_r(rest, " ", &rest));)
        if (rb_api_set(a, name, strtok_r(NULL, " ", &rest)) != RB_OK)
            fail_msg("%s", rb_api_message(a));
    return a;
}

static rb_api *steel(void)
{
    return contact("half-width 1 radius 1000 young 94500");
}

static int try(rb_api *a, const char *words)
{
    const char *names[10], *values[10];
    char text[200], *rest = text;
    int n = 0;
    snprintf(text, sizeof text, "%s", words);
    for (; (names[n] = strtok_r(rest, " ", &rest)); n++)
        values[n] = strtok_r(NULL, " ", &rest);
    return rb_api_crack(a, n, names, values);
}

static void pass(rb_api *a, const char *words)
{
    if (try(a, words) != RB_OK)
        fail_msg("%s", rb_api_message(a));
}

/* The last entry. */
static double last(rb_api *a, const char *name)
{
    int rows, columns;
    const double *x = NOT_NULL(rb_api_array(a, name, &rows, &columns));
    return x[rows - 1];
}

TEST(straight_growth)
{
    int rows, columns;
    held_api *a = steel(), *b = steel();
    pass(a, "paris 1e-12,2 grow-steps 2 grow-to 1.6 crack-friction 0.2");
    pass(b, "crack-length 1.6 crack-friction 0.2");
    const double K = last(b, "crack.summary.delta_K_II");
    CHECK_REL(last(a, "crack.growth.delta_K_II"), K, 1e-9, "as if it had been so long");
    CHECK_REL(last(a, "crack.growth.length"), 1.6, 1e-14, "length");
    CHECK_REL(last(a, "crack.growth.tip_y"), -0.8, 1e-12, "tip");
    const double *dK = rb_api_array(a, "crack.growth.delta_K", &rows, &columns);
    assert_int_equal(rows, 3);
    const double *rate = rb_api_array(a, "crack.growth.rate", &rows, &columns);
    const double opens = last(b, "crack.summary.K_I_max") - last(b, "crack.summary.K_I_min");
    CHECK_REL(dK[2], pow(gsl_pow_4(opens) + 8.0 * gsl_pow_4(K), 0.25), 1e-9, "Tanaka");
    CHECK_REL(rate[2], 1e-12 * dK[2] * dK[2], 1e-12, "Paris");
    CHECK_REL(last(a, "crack.growth.cycles"),
              0.15 * (1.0 / rate[0] + 2.0 / rate[1] + 1.0 / rate[2]), 1e-12, "trapezia");
}

/* Cycles over the number of increments: second order. */
TEST(cycles_converge)
{
    double N[3];
    held_api *a = steel();
    for (int k = 0; k < 3; k++) {
        char words[100];
        snprintf(words, sizeof words,
                 "paris 1e-12,3 paris-range mode-II grow-steps %d crack-elements 20", 3 << k);
        pass(a, words);
        N[k] = last(a, "crack.growth.cycles");
    }
    const double order = log2((N[0] - N[1]) / (N[1] - N[2]));
    print_message("# order %.2f\n", order);
    assert_true(order > 1.8 && order < 2.3);
}

/* C in m and Pa m^0.5 gives the same passes. */
TEST(growth_in_other_units)
{
    char si[100];
    snprintf(si, sizeof si, "paris %.17g,3 grow-steps 1",
             1e-12 * 1e-3 / gsl_pow_3(1e6 * sqrt(1e-3)));
    held_api *a = steel(), *b = contact("units si half-width 0.001 radius 1 young 94500e6");
    pass(a, "paris 1e-12,3 grow-steps 1");
    pass(b, si);
    CHECK_REL(last(b, "crack.growth.cycles"), last(a, "crack.growth.cycles"), 1e-9, "SI");
    CHECK_REL(last(b, "crack.growth.rate"), 1e-3 * last(a, "crack.growth.rate"), 1e-9, "in m");
}

/* Across the largest tension the first turn is the kink angle of the first pass. */
TEST(turns)
{
    int rows, columns;
    held_api *a = steel();
    pass(a, "paris 1e-12,3 growth tension grow-steps 2");
    const double kink = last(a, "crack.summary.kink_angle");
    const double *angle = rb_api_array(a, "crack.growth.angle", &rows, &columns);
    CHECK_REL(angle[1], 30.0 - kink, 1e-9, "first turn");
    const double *x = rb_api_array(a, "crack.growth.tip_x", &rows, &columns);
    CHECK_REL(x[1] - x[0], 0.5 * cos(angle[1] * M_PI / 180.0), 1e-9, "step");
}

/* A piece an increment, with elements of its own beside those that are asked for: growth
 * of many turns comes to its end. */
TEST(turns_many_times)
{
    if (!is_in_turn(0, 3))
        skip();
    int rows, columns;
    held_api *a = steel();
    pass(a, "paris 1e-12,3 growth tension grow-steps 24 crack-angle 15");
    const double *angle = rb_api_array(a, "crack.growth.angle", &rows, &columns);
    assert_int_equal(rows, 25);
    for (int i = 1; i < rows; i++)
        CHECK_MAX(5.0, fabs(angle[i] - angle[i - 1]), "turn %d", i);
}

TEST(rests_below_the_threshold)
{
    int rows, columns;
    held_api *a = steel();
    pass(a, "paris 1e-12,3 threshold 100");
    assert_non_null(rb_api_array(a, "crack.growth.rate", &rows, &columns));
    assert_int_equal(rows, 1);
    CHECK_ABS(last(a, "crack.growth.rate"), 0.0, 0.0, "rests");
}

TEST(bad_growth)
{
    static const struct {
        const char *words, *says;
    } bad[] = {
        {"paris 1e-12 grow-steps 3", "two numbers"}, {"paris 1e-12,-3 grow-steps 3", "paris"},
        {"paris 1e-12,3 grow-to 0.5", "grow-to"},    {"threshold 3 grow-steps 3", "--paris"},
        {"growth tension grow-steps 3", "--paris"},  {"paris 1e-12,3 unloaded yes", "load"}};
    held_api *a = steel();
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        assert_true(try(a, bad[k].words) < 0);
        if (!strstr(rb_api_message(a), bad[k].says))
            fail_msg("%s", rb_api_message(a));
    }
}

RUN_TESTS(NULL, NULL)
