/* A that is turned at rest: a parabola, a punch with rounded edges, friction between unlike bodies,
 * and what is refused. */
#include "cli_run.h"
#include "numbers.h"

#include <gsl/gsl_linalg.h>
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

/* A punch with square corners at +-a, E* = 1: its table ends there, and so do the elements. */
#define SQUARE "--support halfplane --gap square.txt --mesh punch --load 1 "

static void write_square(double a)
{
    FILE *file = NOT_NULL(fopen("square.txt", "w"));
    fprintf(file, "x gap\n%.10g 0\n0 0\n%.10g 0\n", -a, a);
    fclose(file);
}

/* Errors of the square corner fall with the square of the elements' number. */
TEST(a_square_punch)
{
    const double pi = acos(-1.0);
    double tilt[2], moment[2];
    write_square(1.0);
    for (int k = 0; k < 2; k++) {
        held_json *full = run_jsonf(SQUARE "--young 0.75 --poisson 0.5 --mu 0 --datum 1 "
                                           "--contact-elements %d --moment %.15g",
                                    50 * (k + 1), pi / 10.0);
        tilt[k] = of_summary(full, "tilt");
        CHECK_ABS(of_summary(full, "contact_from"), -1.0, 1e-15, "a corner");
        CHECK_REL(of_summary(full, "approach"), 0.441271, 8e-4 / (1 + 3 * k), "approach");
        held_json *part = run_jsonf(SQUARE "--young 0.75 --poisson 0.5 --mu 0 "
                                           "--contact-elements %d --tilt 0.9",
                                    50 * (k + 1));
        moment[k] = of_summary(part, "resistance_moment");
        CHECK_ABS(of_summary(part, "contact_from"), 1.0 - 4.0 / (0.9 * pi), 8e-3 / (1 + k), "from");
        CHECK_ABS(of_summary(part, "contact_to"), 1.0, 1e-15, "a corner");
    }
    CHECK_REL(tilt[1], 0.4, 2.1e-4, "tilt");
    CHECK_REL(moment[1], 1.0 - 1.0 / (0.9 * pi), 2.1e-4, "moment");
    assert_true((tilt[0] - 0.4) / (tilt[1] - 0.4) > 3.7);
    assert_true((moment[0] - 0.646322) / (moment[1] - 0.646322) > 3.7);
}

TEST(a_bonded_punch)
{
    static const double rows[][2] = {{0.3, 0.123018}, {0.45, 0.126897}};
    write_square(1.0);
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        held_json *root = run_jsonf(SQUARE "--young %.15g --poisson %g --mu 1e6 --force 0 "
                                           "--contact-elements 100 --moment 0.1",
                                    1.0 - rows[k][0] * rows[k][0], rows[k][0]);
        CHECK_REL(of_summary(root, "tilt"), rows[k][1], 2.5e-4, "nu %g", rows[k][0]);
    }
}

static double y_ln_y(double y)
{
    return y != 0.0 ? y * log(fabs(y)) : 0.0;
}

/* The tilt of a punch that nothing separates, by its own dense equations: P = E* = a = 1, M = 0.1,
 * nu = 0; tension allowed, no slip. */
static double glued_tilt(int n)
{
    const size_t N = 2 * (size_t)n + 3, X = 2 * (size_t)n;
    const double pi = acos(-1.0), beta = 0.5;
    gsl_matrix *A = gsl_matrix_calloc(N, N);
    gsl_vector *r = gsl_vector_calloc(N), *z = gsl_vector_calloc(N);
    gsl_permutation *p = gsl_permutation_alloc(N);
    int sign;
    for (size_t i = 0; i < (size_t)n; i++) {
        const double at = -0.5 * (cos(pi * (double)i / n) + cos(pi * (double)(i + 1) / n)),
                     h = cos(pi * (double)i / n) - cos(pi * (double)(i + 1) / n);
        for (size_t j = 0; j < (size_t)n; j++) {
            const double u = at + cos(pi * (double)j / n), v = at + cos(pi * (double)(j + 1) / n),
                         g = -2.0 / pi * (y_ln_y(u) - y_ln_y(v) - (u - v)),
                         b = beta * (fabs(u) - fabs(v));
            gsl_matrix_set(A, i, j, g);
            gsl_matrix_set(A, (size_t)n + i, (size_t)n + j, g);
            gsl_matrix_set(A, i, (size_t)n + j, b);
            gsl_matrix_set(A, (size_t)n + i, j, -b);
        }
        gsl_matrix_set(A, i, X, -1.0); /* approach, tilt, shift */
        gsl_matrix_set(A, i, X + 1, -at);
        gsl_matrix_set(A, (size_t)n + i, X + 2, -1.0);
        gsl_matrix_set(A, X, i, h);
        gsl_matrix_set(A, X + 1, i, h * at);
        gsl_matrix_set(A, X + 2, (size_t)n + i, h);
    }
    gsl_vector_set(r, X, 1.0);
    gsl_vector_set(r, X + 1, 0.1);
    assert_int_equal(gsl_linalg_LU_decomp(A, p, &sign), 0);
    assert_int_equal(gsl_linalg_LU_solve(A, p, r, z), 0);
    const double tilt = gsl_vector_get(z, X + 1);
    gsl_permutation_free(p);
    gsl_vector_free(z);
    gsl_vector_free(r);
    gsl_matrix_free(A);
    return tilt;
}

/* At nu = 0 the closed form pulls at the corners: it is that of a punch that is glued, 0.113450;
 * one that may lift off tilts to 0.1130, and touches nothing beside its corner. */
TEST(a_bonded_punch_lifts_off)
{
    const double glued[] = {glued_tilt(50), glued_tilt(100)};
    CHECK_REL(glued[1], 0.113450, 4e-4, "glued");
    assert_true((glued[0] - 0.113450) / (glued[1] - 0.113450) > 3.0);
    write_square(1.0);
    for (int n = 100; n <= 200; n *= 2) {
        held_json *root = run_jsonf(SQUARE "--young 1 --poisson 0 --mu 1e6 --force 0 "
                                           "--contact-elements %d --moment 0.1",
                                    n);
        CHECK_ABS(of_summary(root, "tilt"), 0.1130, 5e-5, "%d", n);
        assert_true(of_summary(root, "contact") < n);
    }
}

/* In random units, a quarter in each turn: the whole punch, or a part at one corner, carries. */
TEST(hundred_square_punches)
{
    unsigned long long seed = 11;
    const double pi = acos(-1.0);
    for (int k = 0; k < 100; k++) {
        const double a = exp(3.0 * uniform_of(&seed)), E = exp(8.0 + 4.0 * uniform_of(&seed)),
                     P = a * E * exp(-7.0 + 2.0 * uniform_of(&seed)),
                     share = 0.8 * uniform_of(&seed); /* M/(P a) */
        if (!is_in_turn(k, 4))
            continue;
        write_square(a);
        held_json *root = run_jsonf("--support halfplane --gap square.txt --mesh punch --mu 0 "
                                    "--young %.15g --poisson 0 --contact-elements 80 --load %.15g "
                                    "--moment %.15g",
                                    E, P, share * P * a);
        const double unit = 2.0 * P / (pi * E * a), size = fabs(share),
                     want = unit * (size <= 0.5 ? 2.0 * size : 0.5 / (1.0 - size));
        CHECK_REL(of_summary(root, "tilt"), copysign(want, share), 2e-3, "case %d: %g", k, share);
    }
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
         "it needs bodies at rest"},
        {"--load 0.03 --tilt 0.01", "it needs elastic half-planes"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --tilt 0.01 --moment 3", "--moment"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.1 --zone 3", "it topples"},
        {SQUARE "--moment 1.01", "M/P = 1.01 mm, and A touches between -1 and 1 mm at most: it "
                                 "topples"},
        {SQUARE "--zone 1", "the punch is the zone"},
        {SQUARE "--formulation steady", "it needs bodies at rest, in one step"},
        {SQUARE "--increments 2", "equal elements"},
        {SQUARE "--mesh uniform", "a punch that ends there has --mesh punch"},
        {"--support halfplane --load 1 --mesh punch", "add --gap FILE"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --increments 3",
         "it needs a single state"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --error", "no error bars"},
        {SOFT "--gap parabola --radius 100 --load 0.03 --moment 0.03 --derivatives",
         "give the tilt that it makes"}};
    write_square(1.0);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, strstr(rows[k].line, "--mesh uniform") ? 65 : 64,
                      rows[k].words);
}

RUN_TESTS(enter_folder, leave_folder)
