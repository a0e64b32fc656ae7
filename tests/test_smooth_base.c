/* A layer that slides on its base and does not leave it (L9): indentation by series, elastic bases,
 * a strip between two equal rolls, and what is refused. */
#include "cli_run.h"
#include "numbers.h"

#include <math.h>

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

/* E* = 1 with any nu, R = 500: P_h = pi a^2/2000, and a/1000, a^2/1000 of a half-plane. */
TEST(indentation_of_a_layer_on_a_rigid_base)
{
    static const struct {
        double a, load, pressure, approach;
    } rows[] = {{0.1, 1.0051971, 1.0052038, 3.1617095}, {0.5, 1.1225783, 1.1260473, 1.7606220},
                {1.0, 1.4226461, 1.4569765, 1.3833476}, {2.0, 2.2004952, 2.3754551, 1.1849719},
                {5.0, 4.7130681, 5.3605393, 1.0721077}, {10.0, 8.9477890, 10.357401, 1.0357401}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const double a = rows[k].a, nu = k % 2 ? 0.3 : 0.0;
        held_json *root = run_jsonf("--support halfplane --gap parabola --radius 500 --young %.15g "
                                    "--poisson %g --mu 0 --layer-thickness 1 --layer-base smooth "
                                    "--load %.15g --mesh fitted --contact-elements 100",
                                    1.0 - nu * nu, nu, 0.0005 * acos(-1.0) * a * a * rows[k].load);
        CHECK_REL(of_summary(root, "half_width"), a, 2e-4, "a of a/d = %g", a);
        CHECK_REL(of_summary(root, "max_pressure"), 0.001 * a * rows[k].pressure, 5e-4,
                  "p0 of a/d = %g", a);
        CHECK_REL(of_summary(root, "approach"), 0.001 * a * a * rows[k].approach, 2e-4,
                  "of a/d = %g", a);
    }
}

TEST(indentation_of_a_layer_on_an_elastic_base)
{
    static const struct {
        double a, c, load, pressure;
    } rows[] = {{1.0, 0.01, 1.4107669, 1.4438310},
                {1.0, 0.1, 1.3147560, 1.3378136},
                {1.0, 1.0, 0.8498680, 0.8321203},
                {1.0, 10.0, 0.3301159, 0.2958422},
                {2.0, 1.0, 0.8245591, 0.7994843}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const double a = rows[k].a;
        held_json *root = run_jsonf("--support halfplane --gap parabola --radius 500 --young 0.91 "
                                    "--poisson 0.3 --mu 0 --layer-thickness 1 --layer-base smooth "
                                    "--base-young %.15g --base-poisson 0.3 --load %.15g "
                                    "--mesh fitted --contact-elements 100",
                                    0.91 / rows[k].c, 0.0005 * acos(-1.0) * a * a * rows[k].load);
        CHECK_REL(of_summary(root, "half_width"), a, 2e-4, "a of c = %g", rows[k].c);
        CHECK_REL(of_summary(root, "max_pressure"), 0.001 * a * rows[k].pressure, 5e-4,
                  "p0 of c = %g", rows[k].c);
    }
}

/* Half of a strip of thickness 2d under a rigid roll, R = C = 1 by P = pi E* C^2/(4R). */
#define STRIP_OF                                                                                   \
    "--support halfplane --gap parabola --radius 100 --layer-base smooth --formulation steady "    \
    "--mesh uniform --contact-elements 200 "
#define STRIP STRIP_OF "--young 0.91e3 --poisson 0.3 --load 0.785398163397448 "

TEST(a_strip_between_two_equal_rolls)
{
    static const double thin[] = {0.25, 0.5, 1.0, 2.0}, mu[] = {0.02, 0.1, 0.3},
                        free[][3] = {{-0.1605, -0.1247, -0.0984},
                                     {-0.0853, -0.0507, -0.0274},
                                     {0.0226, 0.0486, 0.0627},
                                     {0.1277, 0.1368, 0.1418}};
    /* E* = 1000, R = 100, P: C = sqrt(4 P R/(pi E*)) */
    const double C = sqrt(4.0 * 0.785398163397448 * 100.0 / (acos(-1.0) * 1e3));
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            held_json *root =
                run_jsonf(STRIP "--layer-thickness %.15g --mu %g --force 0", C / thin[i], mu[j]);
            CHECK_ABS(of_summary(root, "creepage") * 100.0 / C, free[i][j], 1.5e-3,
                      "C/d = %g, mu = %g", thin[i], mu[j]);
        }
}

/* The same of nu = 1/2, and of nu = 0.3 between rolls of the strip's material, whose C is that of
 * the pair; a part in each turn. */
TEST(strips_of_other_pairs)
{
    static const double thin[] = {0.25, 0.5, 1.0, 2.0}, mu[] = {0.02, 0.1, 0.3},
                        half[][3] = {{0.0927, 0.0927, 0.0927},
                                     {0.1704, 0.1700, 0.1700},
                                     {0.3011, 0.2742, 0.2740},
                                     {0.4778, 0.4217, 0.3768}},
                        elastic[][3] = {{NAN, NAN, NAN},
                                        {NAN, 0.08445, 0.08445},
                                        {NAN, 0.13165, 0.13165},
                                        {NAN, 0.16832, 0.16481}};
    const double pi = acos(-1.0), C = sqrt(0.1 / pi);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            if (!is_in_turn(3 * i + j, 3))
                continue;
            held_json *root = run_jsonf(STRIP_OF "--young 750 --poisson 0.5 --load %.15g "
                                                 "--layer-thickness %.15g --mu %g --force 0",
                                        0.25 * pi * 10.0 * C * C, C / thin[i], mu[j]);
            CHECK_ABS(of_summary(root, "creepage") * 100.0 / C, half[i][j], 1.5e-3,
                      "nu 0.5, C/d = %g, mu = %g", thin[i], mu[j]);
            if (isnan(elastic[i][j]))
                continue;
            held_json *pair =
                run_jsonf(STRIP_OF "--young 910 --poisson 0.3 --young-b 910 --poisson-b 0.3 --load "
                                   "%.15g --layer-thickness %.15g --mu %g --force 0",
                          0.25 * pi * 5.0 * C * C, C / thin[i], mu[j]);
            CHECK_ABS(of_summary(pair, "creepage") * 100.0 / C, elastic[i][j], 1e-3,
                      "elastic rolls, C/d = %g, mu = %g", thin[i], mu[j]);
        }
}

/* Under a vanishing friction that turns round once in the contact (mu -> 0), xi R/a is that of the
 * displacements of the pressure; first-order elements. */
TEST(strips_without_friction)
{
    static const double a[] = {0.1, 0.5, 1.0}, load[] = {1.0051971, 1.1225783, 1.4226461},
                        nu[] = {0.0, 0.3, 0.5},
                        want[][3] = {{-0.42150, -0.31478, -0.23516},
                                     {-0.22436, -0.09434, 0.04686},
                                     {0.03850, 0.19959, 0.42289}};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            held_json *root = run_jsonf(
                "--support halfplane --gap parabola --radius 100 --young %.15g --poisson %g "
                "--layer-base smooth --formulation steady --mesh fitted --contact-elements 100 "
                "--mu "
                "1e-5 --force 0 --load %.15g --layer-thickness %.15g",
                1e3 * (1.0 - nu[i] * nu[i]), nu[i], 0.025 * acos(-1.0) * load[j], 0.1 / a[j]);
            CHECK_ABS(of_summary(root, "creepage") * 1e3, want[i][j], 2.5e-3, "nu %g, a/d %g",
                      nu[i], a[j]);
        }
}

/* Traction stretches the strip on one side and presses it together on the other. */
TEST(two_creepages_of_a_strip)
{
    static const double rows[][3] = {{-0.6, 0.1097, 0.0861},
                                     {-0.3, 0.0736, 0.0618},
                                     {0.3, 0.0289, 0.0407},
                                     {0.6, 0.0070, 0.0306}};
    const double C = sqrt(4.0 * 0.785398163397448 * 100.0 / (acos(-1.0) * 1e3));
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_json *root =
            run_jsonf(STRIP "--layer-thickness %.15g --mu 0.1 --force-ratio %g", C, rows[k][0]);
        const double xi = of_summary(root, "creepage"), ahead = of_summary(root, "creepage_ahead"),
                     Q = of_summary(root, "tangential_load");
        CHECK_ABS(xi * 100.0 / C, rows[k][1], 1.5e-3, "xi of %g", rows[k][0]);
        CHECK_ABS(ahead * 100.0 / C, rows[k][2], 1.5e-3, "ahead of %g", rows[k][0]);
        CHECK_REL(ahead - xi, Q / (2.0 * 1e3 * C), 1e-9, "stretch");
        CHECK_REL(xi - of_summary(root, "creepage_behind"), Q / (2.0 * 1e3 * C), 1e-9, "stretch");
    }
    static const double rough[][4] = {{-0.6, 0.2040, 0.1333, 0.3160},
                                      {-0.3, 0.1236, 0.0883, 0.2229},
                                      {0.3, 0.0079, 0.0433, 0.0623},
                                      {0.6, -0.0548, 0.0159, -0.0289}};
    for (size_t k = 0; k < sizeof rough / sizeof *rough; k++) {
        if (!is_in_turn((int)k, 2))
            continue;
        held_json *root =
            run_jsonf(STRIP "--layer-thickness %.15g --mu 0.3 --force-ratio %g", C, rough[k][0]);
        CHECK_ABS(of_summary(root, "creepage") * 100.0 / C, rough[k][1], 1.5e-3, "%g", rough[k][0]);
        CHECK_ABS(of_summary(root, "creepage_ahead") * 100.0 / C, rough[k][2], 1.5e-3, "%g",
                  rough[k][0]);
        held_json *thin = run_jsonf(STRIP "--layer-thickness %.15g --mu 0.3 --force-ratio %g",
                                    0.5 * C, rough[k][0]);
        CHECK_ABS(of_summary(thin, "creepage") * 100.0 / C, rough[k][3], 1.5e-3, "C/d 2, %g",
                  rough[k][0]);
    }
}

/* A quarter in each turn: layers on A, on B or both, at rest and rolling; every number is computed
 * again from the state. */
TEST(hundred_results_are_valid)
{
    unsigned long long seed = 7;
    for (int k = 0; k < 100; k++) {
        char b[200] = "", line[900];
        const double d = exp(1.5 * uniform_of(&seed)), nu = 0.24 + 0.24 * uniform_of(&seed),
                     mu = 0.25 + 0.2 * uniform_of(&seed), ratio = 0.8 * uniform_of(&seed),
                     stiff = 1000.0 * exp(3.0 * uniform_of(&seed));
        if (!is_in_turn(k, 8))
            continue;
        if (k % 3 > 0)
            snprintf(b, sizeof b, "--young-b 2500 --poisson-b 0.35 --layer-thickness-b %.15g %s",
                     2.0 * d, k % 3 > 1 ? "--layer-base-b smooth" : "");
        snprintf(line, sizeof line,
                 "--support halfplane --gap parabola --radius 100 --young 1000 --poisson %.15g "
                 "--mu %.15g --load 5 --layer-thickness %.15g --layer-base %s --force-ratio %.15g "
                 "--contact-elements 40 --formulation %s %s",
                 nu, mu, d, k % 3 == 2 ? "bonded" : "smooth", ratio, k % 2 ? "steady" : "static",
                 b);
        if (k % 5 > 2)
            rb_append(line, sizeof line, " --base-young %.15g --base-poisson 0.3", stiff);
        if (rollbemf("%s --json --quiet --output state.json", line) != 0 ||
            rollbem("check state.json") != 0)
            fail_msg("%s: %s%s", line, out, err);
    }
}

TEST(what_is_refused)
{
#define LAYER "--support halfplane --load 1 --layer-base smooth "
    static const struct {
        const char *line, *words;
    } rows[] = {
        {LAYER, "a base has its layer on it"},
        {LAYER "--layer-thickness 2 --shift 1e-3", "a shift means nothing"},
        {LAYER "--layer-thickness 2 --formulation transient --distance 1", "from step to step"},
        {LAYER "--layer-thickness 2 --increments 3", "in one step"},
        {LAYER "--layer-thickness 2 --formulation steady --speed 10 --relaxation-time 1 "
               "--relaxation-ratio 1",
         "of one elastic layer only"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, 64, rows[k].words);
}

RUN_TESTS(enter_folder, leave_folder)
