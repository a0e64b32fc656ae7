/* A that is turned at rest: a parabola, a punch with rounded edges, friction between unlike bodies,
 * and what is refused. */
#include "cli_run.h"

#include <math.h>

/* E* = 1, and no coupling. */
#define SOFT "--support halfplane --young 0.75 --poisson 0.5 --mu 0 "

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

/* A parabola stays one: moved by M/P, lowered by X^2 R/2. */
TEST(a_parabola_moves)
{
    static const char *const meshes[] = {"", "--mesh uniform --contact-elements 200 ",
                                         "--mesh uniform --contact-elements 200 --zone 5 "};
    const double R = 100.0, P = 0.03, arm = 1.2, a = sqrt(4.0 * P * R / acos(-1.0));
    held_json *upright = run_jsonf(SOFT "--gap parabola --radius 100 --load %g --mesh uniform "
                                        "--contact-elements 200",
                                   P);
    for (size_t k = 0; k < 3; k++) {
        held_json *root = run_jsonf(SOFT "--gap parabola --radius 100 --load %g %s--moment %.15g",
                                    P, meshes[k], P * arm);
        CHECK_REL(of_summary(root, "resistance_moment"), P * arm, 1e-9, "M, %s", meshes[k]);
        CHECK_REL(of_summary(root, "tilt"), arm / R, 2e-3, "tilt, %s", meshes[k]);
        CHECK_ABS(of_summary(root, "contact_from"), arm - a, 0.01 * a, "%s", meshes[k]);
        CHECK_ABS(of_summary(root, "contact_to"), arm + a, 0.01 * a, "%s", meshes[k]);
        CHECK_ABS(of_summary(upright, "approach") - of_summary(root, "approach"),
                  0.5 * arm * arm / R, 1e-5, "approach, %s", meshes[k]);
        /* the tilt that was found, given */
        held_json *given = run_jsonf(SOFT "--gap parabola --radius 100 --load %g %s--tilt %.15g", P,
                                     k < 2 ? "--mesh uniform --contact-elements 200 " : meshes[k],
                                     of_summary(root, "tilt"));
        CHECK_REL(of_summary(given, "resistance_moment"), P * arm, 5e-3, "way back, %s", meshes[k]);
    }
    held_json *left = run_json(SOFT "--gap parabola --radius 100 --load 0.03 --tilt -0.012");
    held_json *right = run_json(SOFT "--gap parabola --radius 100 --load 0.03 --tilt 0.012");
    CHECK_ABS(of_summary(left, "contact_from"), -of_summary(right, "contact_to"), 1e-9, "mirror");
    CHECK_REL(of_summary(left, "resistance_moment"), -of_summary(right, "resistance_moment"), 1e-9,
              "mirror");
}

/* Flat over |x| < b = .5, R = 1 at its edges, P = .4. */
static void write_punch(void)
{
    FILE *file = NOT_NULL(fopen("punch.txt", "w"));
    fprintf(file, "x gap\n");
    for (int i = -800; i <= 800; i++) {
        const double x = 0.0025 * i, beyond = fmax(0.0, fabs(x) - 0.5);
        fprintf(file, "%.10g %.14g\n", x, 0.5 * beyond * beyond);
    }
    fclose(file);
}

TEST(a_rounded_punch)
{
    static const struct {
        double tilt, from, to, moment, pressure;
    } rows[] = {{0.0, -1.083348, 1.083348, 0.0, 0.242119},
                {0.1, -0.934141, 1.223211, 0.091916, 0.276660},
                {0.2, -0.769920, 1.356145, 0.182165, 0.305095},
                {0.3, -0.569118, 1.483097, 0.268362, 0.328333}};
    write_punch();
    for (size_t k = 0; k < 4; k++) {
        held_json *root = run_jsonf(SOFT "--gap punch.txt --load 0.4 --tilt %g --zone 1.8 "
                                         "--contact-elements 360",
                                    rows[k].tilt);
        CHECK_ABS(of_summary(root, "contact_from"), rows[k].from, 6e-3, "tilt %g", rows[k].tilt);
        CHECK_ABS(of_summary(root, "contact_to"), rows[k].to, 6e-3, "tilt %g", rows[k].tilt);
        CHECK_REL(of_summary(root, "max_pressure"), rows[k].pressure, 3e-3, "tilt %g",
                  rows[k].tilt);
        if (rows[k].tilt == 0.0)
            continue;
        CHECK_REL(of_summary(root, "resistance_moment"), rows[k].moment, 1e-3, "tilt %g",
                  rows[k].tilt);
        held_json *back = run_jsonf(SOFT "--gap punch.txt --load 0.4 --moment %g --zone 1.8 "
                                         "--contact-elements 360",
                                    rows[k].moment);
        CHECK_REL(of_summary(back, "tilt"), rows[k].tilt, 2e-3, "way back, tilt %g", rows[k].tilt);
    }
}

/* Dundurs' beta .2857, mu .3, Q = 0, one step, by a prototype of its own. */
TEST(with_friction)
{
    write_punch();
    held_json *root = run_json("--support halfplane --young 0.91 --poisson 0.3 --mu 0.3 --gap "
                               "punch.txt --load 0.4 --force 0 --moment 0.09 --zone 1.5 "
                               "--contact-elements 300");
    CHECK_REL(of_summary(root, "tilt"), 0.097158, 3e-3, "tilt");
    CHECK_ABS(of_summary(root, "contact_from"), -0.92, 0.02, "from");
    CHECK_ABS(of_summary(root, "contact_to"), 1.20, 0.02, "to");
    CHECK_ABS(of_summary(root, "stick_from"), -0.25, 0.015, "stick from");
    CHECK_ABS(of_summary(root, "stick_to"), 0.66, 0.015, "stick to");
    CHECK_REL(of_summary(root, "max_pressure"), 0.2937, 3e-3, "p_max");
}

/* A column tilt, row by row, is a tilt given. */
TEST(a_history_tilts)
{
    write_file("tilts.txt", "load tilt\n0.03 0\n0.03 0.006\n0.03 0.012\n");
    held_json *rows = run_json(SOFT "--gap parabola --radius 100 --zone 4 --contact-elements 160 "
                                    "--history tilts.txt");
    held_json *one = run_json(SOFT "--gap parabola --radius 100 --zone 4 --contact-elements 160 "
                                   "--load 0.03 --tilt 0.012");
    CHECK_REL(of_summary(rows, "resistance_moment"), of_summary(one, "resistance_moment"), 1e-9,
              "M");
    CHECK_REL(of_summary(rows, "tilt"), 0.012, 1e-15, "tilt");
}

TEST(derivatives_by_the_tilt)
{
#define TILTED SOFT "--gap parabola --radius 100 --load 0.03 --zone 4 --contact-elements 160 "
    held_json *root = run_json(TILTED "--tilt 0.005 --derivatives=approach,resistance_moment");
    double M[2], delta[2];
    for (int k = 0; k < 2; k++) {
        held_json *beside = run_jsonf(TILTED "--tilt %.15g", 0.005 + (k ? 1e-8 : -1e-8));
        M[k] = of_summary(beside, "resistance_moment");
        delta[k] = of_summary(beside, "approach");
    }
    const json_t *d = json_object_get(root, "derivatives");
    CHECK_REL(number_in(json_object_get(d, "resistance_moment"), "tilt"), (M[1] - M[0]) / 2e-8,
              1e-5, "M");
    CHECK_REL(number_in(json_object_get(d, "approach"), "tilt"), (delta[1] - delta[0]) / 2e-8, 1e-5,
              "approach");
}

TEST(what_is_refused)
{
    static const struct {
        const char *line, *words;
    } rows[] = {
        {SOFT "--gap parabola --radius 100 --load 0.03 --tilt 0.01 --formulation steady",
         "of bodies at rest only"},
        {"--load 0.03 --tilt 0.01", "of elastic half-planes only"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --tilt 0.01 --moment 3", "--moment"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.1 --zone 3", "it topples"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --increments 3",
         "of one state only"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --error", "no error bars"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --derivatives",
         "give the tilt that it makes"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, 64, rows[k].words);
}

RUN_TESTS(enter_folder, leave_folder)
