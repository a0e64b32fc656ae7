/* Growth of cracks by Paris's law: against cracks that have that length from the start,
 * by its order of convergence, in other units, and what is refused. */
#include "check.h"
#include "rollbem/api.h"

#include <gsl/gsl_math.h>

static rb_api *contact(const char *units, const char *half_width, const char *radius,
                       const char *young)
{
    rb_api *a = rb_api_create_for("crack");
    const char *const words[] = {"units",  units,  "support", "halfplane",  "similar",
                                 "yes",    "mu",   "0",       "half-width", half_width,
                                 "radius", radius, "young",   young,        NULL};
    assert_non_null(a);
    for (int k = 0; words[k]; k += 2)
        if (rb_api_set(a, words[k], words[k + 1]) != RB_OK)
            fail_msg("%s", rb_api_message(a));
    return a;
}

static void pass(rb_api *a, const char *const *words)
{
    const char *names[20], *values[20];
    int n = 0;
    for (; words[2 * n]; n++) {
        names[n] = words[2 * n];
        values[n] = words[2 * n + 1];
    }
    if (rb_api_crack(a, n, names, values) != RB_OK)
        fail_msg("%s", rb_api_message(a));
}

/* The last entry. */
static double last(rb_api *a, const char *name)
{
    int rows, columns;
    const double *x = rb_api_array(a, name, &rows, &columns);
    assert_non_null(x);
    return x[rows - 1];
}

TEST(straight_growth)
{
    static const char *const grown[] = {"paris", "1e-12,2",        "grow-steps", "2", "grow-to",
                                        "1.6",   "crack-friction", "0.2",        NULL},
                             *const longer[] = {"crack-length", "1.6", "crack-friction", "0.2",
                                                NULL};
    int rows, columns;
    held_api *a = contact("mm", "1", "1000", "94500"), *b = contact("mm", "1", "1000", "94500");
    pass(a, grown);
    pass(b, longer);
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
    static const char *const steps[] = {"3", "6", "12"};
    double N[3];
    held_api *a = contact("mm", "1", "1000", "94500");
    for (int k = 0; k < 3; k++) {
        const char *const words[] = {"paris",          "1e-12,3",    "paris-range",
                                     "mode-II",        "grow-steps", steps[k],
                                     "crack-elements", "20",         NULL};
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
    char law[60];
    snprintf(law, sizeof law, "%.17g,3", 1e-12 * 1e-3 / gsl_pow_3(1e6 * sqrt(1e-3)));
    const char *const mm[] = {"paris", "1e-12,3", "grow-steps", "1", NULL}, *const si[] = {
                                                                                "paris", law,
                                                                                "grow-steps", "1",
                                                                                NULL};
    held_api *a = contact("mm", "1", "1000", "94500"), *b = contact("si", "0.001", "1", "94500e6");
    pass(a, mm);
    pass(b, si);
    CHECK_REL(last(b, "crack.growth.cycles"), last(a, "crack.growth.cycles"), 1e-9, "SI");
    CHECK_REL(last(b, "crack.growth.rate"), last(a, "crack.growth.rate"), 1e-9, "mm");
}

/* Across the largest tension the first turn is the kink angle of the first pass. */
TEST(turns)
{
    static const char *const words[] = {"paris",      "1e-12,3", "growth", "tension",
                                        "grow-steps", "2",       NULL};
    int rows, columns;
    held_api *a = contact("mm", "1", "1000", "94500");
    pass(a, words);
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
    static const char *const words[] = {"paris", "1e-12,3",     "growth", "tension", "grow-steps",
                                        "24",    "crack-angle", "15",     NULL};
    int rows, columns;
    held_api *a = contact("mm", "1", "1000", "94500");
    pass(a, words);
    const double *angle = rb_api_array(a, "crack.growth.angle", &rows, &columns);
    assert_int_equal(rows, 25);
    for (int i = 1; i < rows; i++)
        CHECK_MAX(5.0, fabs(angle[i] - angle[i - 1]), "turn %d", i);
}

TEST(rests_below_the_threshold)
{
    static const char *const words[] = {"paris", "1e-12,3", "threshold", "100", NULL};
    int rows, columns;
    held_api *a = contact("mm", "1", "1000", "94500");
    pass(a, words);
    assert_non_null(rb_api_array(a, "crack.growth.rate", &rows, &columns));
    assert_int_equal(rows, 1);
    CHECK_ABS(last(a, "crack.growth.rate"), 0.0, 0.0, "rests");
}

TEST(bad_growth)
{
    static const struct {
        const char *name[2], *value[2], *says;
    } bad[] = {{{"paris", "grow-steps"}, {"1e-12", "3"}, "two numbers"},
               {{"paris", "grow-steps"}, {"1e-12,-3", "3"}, "paris"},
               {{"paris", "grow-to"}, {"1e-12,3", "0.5"}, "grow-to"},
               {{"threshold", "grow-steps"}, {"3", "3"}, "--paris"},
               {{"growth", "grow-steps"}, {"tension", "3"}, "--paris"},
               {{"paris", "unloaded"}, {"1e-12,3", "yes"}, "load"}};
    held_api *a = contact("mm", "1", "1000", "94500");
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        assert_true(rb_api_crack(a, 2, bad[k].name, bad[k].value) < 0);
        if (!strstr(rb_api_message(a), bad[k].says))
            fail_msg("%s", rb_api_message(a));
    }
}

RUN_TESTS(NULL, NULL)
