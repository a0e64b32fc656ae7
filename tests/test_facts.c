/* Facts that must agree: the same physics asked for in two ways gives the same answer, to
 * the last digit where the arithmetic is the same. */
#include "cli_run.h"
#include "base/blas.h"
#include "rolling/case/case.h"

/* ---- Two answers ------------------------------------------------------------------- */

static const char *const columns[] = {"x_mm",  "h_mm",  "gap_mm",   "p_MPa", "q_MPa",
                                      "un_mm", "ut_mm", "shift_mm", "slip"};
enum { X, H, GAP, P, Q, UN, UT, SHIFT, SLIP, COLUMNS };

static const json_t *table_of(const json_t *root)
{
    return json_object_get(root, "table");
}

static double summary_of(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

static double largest(const json_t *root, int column)
{
    const json_t *list = json_object_get(table_of(root), columns[column]);
    double most = 0.0;
    for (size_t i = 0; i < json_array_size(list); i++)
        most = fmax(most, fabs(entry(table_of(root), columns[column], i)));
    return most;
}

/* Column j of b is factor times that of a, but for tol times the largest entry. */
static void check_column(const json_t *a, const json_t *b, int j, double factor, double tol,
                         const char *what)
{
    const size_t n = json_array_size(json_object_get(table_of(a), columns[j]));
    const double size = fabs(factor) * largest(a, j);
    assert_true(n > 0);
    assert_int_equal(json_array_size(json_object_get(table_of(b), columns[j])), n);
    for (size_t i = 0; i < n; i++)
        CHECK_ABS(entry(table_of(b), columns[j], i), factor * entry(table_of(a), columns[j], i),
                  tol * size, "%s: %s of element %zu", what, columns[j], i + 1);
}

static void check_scalar(const json_t *a, const json_t *b, const char *name, double factor,
                         double tol, const char *what)
{
    const double one = summary_of(a, name), other = summary_of(b, name);
    if (isnan(one) && isnan(other))
        return;
    CHECK_ABS(other, factor * one, tol * fabs(factor * one), "%s: %s", what, name);
}

/* a and b are the same answer. */
static void check_same(const json_t *a, const json_t *b, double tol, const char *what)
{
    static const char *const scalars[] = {"normal_load",      "tangential_load", "approach",
                                          "tangential_shift", "creepage",        "half_width",
                                          "max_pressure",     "free_creepage",   "dissipation",
                                          "stick_from",       "stick_to",        "contact"};
    for (int j = 0; j < COLUMNS; j++)
        check_column(a, b, j, 1.0, tol, what);
    for (size_t k = 0; k < sizeof scalars / sizeof scalars[0]; k++)
        check_scalar(a, b, scalars[k], 1.0, tol, what);
}

/* ---- Mirror ------------------------------------------------------------------------ */

/* The upper body becomes the lower one: friction on A, creepage and shift change their
 * sign. */
static void check_mirror(const char *rest, const char *control, double value, const char *one,
                         const char *other, double tol)
{
    char line[800];
    snprintf(line, sizeof line, "%s %s --%s %.17g", one, rest, control, value);
    held_json *a = run_json(line);
    snprintf(line, sizeof line, "%s %s --%s %.17g", other, rest, control, -value);
    held_json *b = run_json(line);
    const double length = fmax(largest(a, UN), largest(a, UT)) / largest(a, SHIFT);
    check_column(a, b, X, 1.0, tol, line);
    check_column(a, b, P, 1.0, tol, line);
    check_column(a, b, Q, -1.0, tol, line);
    check_column(a, b, UN, 1.0, tol, line);
    check_column(a, b, UT, -1.0, tol, line);
    check_column(a, b, SHIFT, -1.0, tol * fmax(length, 1.0), line);
    check_scalar(a, b, "normal_load", 1.0, tol, line);
    check_scalar(a, b, "approach", 1.0, tol, line);
    check_scalar(a, b, "tangential_load", -1.0, tol, line);
    check_scalar(a, b, "creepage", -1.0, tol, line);
    check_scalar(a, b, "free_creepage", -1.0, 1e2 * tol, line);
    check_scalar(a, b, "dissipation", 1.0, 1e2 * tol, line);
}

TEST(test_mirror)
{
    static const char *const planes[] = {
        "--support halfplane --young 60000 --poisson 0.31 --radius 50 --young-b 210000 "
        "--poisson-b 0.28 --radius-b 80",
        "--support halfplane --young 210000 --poisson 0.28 --radius 80 --young-b 60000 "
        "--poisson-b 0.31 --radius-b 50"};
    static const char *const wheels[] = {
        "--support hub --young 60000 --poisson 0.31 --radius 50 --young-b 210000 "
        "--poisson-b 0.28 --radius-b 50 --support-b arc",
        "--support arc --young 210000 --poisson 0.28 --radius 50 --young-b 60000 "
        "--poisson-b 0.31 --radius-b 50 --support-b hub"};
    static const char *const rest[] = {
        "--formulation steady --half-width 1 --mu 0.3 --contact-elements 30",
        "--formulation steady --approach 0.05 --mu 3 --contact-elements 31 --mesh uniform",
        "--formulation transient --distance 0.5 --load 700 --mu 0.1 --contact-elements 30",
        "--formulation static --load 700 --mu 0.1 --contact-elements 30"};
    for (int k = 0; k < 4; k++) {
        const char *control = k == 3 ? "shift" : k == 1 ? "force-ratio" : "creep-ratio";
        const double value = k == 3 ? 2e-3 : 0.4;
        if (!is_in_turn(k, 4))
            continue;
        check_mirror(rest[k], control, value, planes[0], planes[1], 1e-9);
        check_mirror(rest[k], control, value, wheels[0], wheels[1], 1e-8);
    }
}

/* ---- Scaling ----------------------------------------------------------------------- */

/* Lengths times L and stresses times E, powers of two.  On half-planes and of the
 * stresses every digit stays; boundary elements take logarithms of lengths. */
static void check_scaling(const char *format, double L, double E)
{
    const int exact = L == 1.0 || strstr(format, "halfplane");
    const double tol = exact ? 0.0 : 1e-9;
    char line[800];
    snprintf(line, sizeof line, format, 50.0, 94500.0, 700.0, 80.0, 2e5);
    held_json *a = run_json(line);
    snprintf(line, sizeof line, format, L * 50.0, E * 94500.0, L * E * 700.0, L * 80.0, E * 2e5);
    held_json *b = run_json(line);
    static const int of_length[] = {X, H, GAP, UN, UT, SHIFT}, of_stress[] = {P, Q};
    for (size_t k = 0; k < sizeof of_length / sizeof of_length[0]; k++)
        check_column(a, b, of_length[k], L, tol, line);
    for (size_t k = 0; k < sizeof of_stress / sizeof of_stress[0]; k++)
        check_column(a, b, of_stress[k], E, tol, line);
    check_column(a, b, SLIP, 1.0, tol, line);
    check_scalar(a, b, "tangential_load", L * E, tol, line);
    check_scalar(a, b, "approach", L, tol, line);
    check_scalar(a, b, "half_width", L, tol, line);
    check_scalar(a, b, "creepage", 1.0, tol, line);
    check_scalar(a, b, "dissipation", L * E, tol, line);
}

TEST(test_scaling)
{
    static const char *const cases[] = {
        "--support halfplane --formulation steady --creep-ratio 0.4 --contact-elements 30 "
        "--radius %.17g --young %.17g --load %.17g --radius-b %.17g --young-b %.17g",
        "--support hub --support-b arc --formulation steady --force-ratio 0.4 "
        "--contact-elements 20 "
        "--radius %.17g --young %.17g --load %.17g --radius-b %.17g --young-b %.17g",
        "--support arc --formulation transient --distance 0.3 --creep-ratio 0.4 "
        "--contact-elements 20 "
        "--radius %.17g --young %.17g --load %.17g --radius-b %.17g --young-b %.17g"};
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        check_scaling(cases[k], 1.0, 1024.0);
        check_scaling(cases[k], 4096.0, 1.0);
        check_scaling(cases[k], 0x1p-20, 0x1p-3);
    }
}

/* ---- Without friction -------------------------------------------------------------- */

/* Half-planes of one E* are one: whose the material is does not matter to the pressure.
 * And increments of the load end where one load does. */
TEST(test_no_friction)
{
    held_json *pair = run_json("--support halfplane --formulation static --mu 0 --load 700 "
                               "--young 100000 --poisson 0 --young-b 300000 --poisson-b 0 "
                               "--gap parabola --shift 0");
    held_json *one = run_json("--support halfplane --formulation static --mu 0 --load 700 "
                              "--young 75000 --poisson 0 --gap parabola --shift 0");
    write_file("steps.txt", "load shift\n100 0\n400 0\n700 0\n");
    held_json *steps = run_json("--support halfplane --formulation static --mu 0 --young 75000 "
                                "--poisson 0 --gap parabola --history steps.txt");
    check_column(one, pair, X, 1.0, 1e-12, "one E*");
    check_column(one, pair, P, 1.0, 1e-10, "one E*");
    check_scalar(one, pair, "half_width", 1.0, 1e-10, "one E*");
    CHECK_REL(summary_of(steps, "approach"), summary_of(one, "approach"), 1e-3, "steps");
    CHECK_REL(summary_of(steps, "max_pressure"), summary_of(one, "max_pressure"), 5e-3, "steps");
}

/* ---- Refinement -------------------------------------------------------------------- */

/* Four times the elements: what is left of the difference is a quarter or less. */
static void check_refinement(const char *rest)
{
    static const char *const names[] = {"tangential_load", "max_pressure"};
    char line[800];
    double value[2][3];
    for (int k = 0; k < 3; k++) {
        snprintf(line, sizeof line, "%s --contact-elements %d", rest, 20 << (2 * k));
        held_json *root = run_json(line);
        for (int i = 0; i < 2; i++)
            value[i][k] = summary_of(root, names[i]);
    }
    for (int i = 0; i < 2; i++)
        CHECK_MAX(fabs(value[i][2] - value[i][1]),
                  0.4 * fabs(value[i][1] - value[i][0]) + 1e-6 * fabs(value[i][2]),
                  "%s: %s = %.9g, %.9g, %.9g", rest, names[i], value[i][0], value[i][1],
                  value[i][2]);
}

TEST(test_refinement)
{
    static const char *const cases[] = {
        "--support halfplane --formulation steady --load 700 --creep-ratio 0.4",
        ("--support halfplane --formulation steady --load 700 --young-b 2e5 --mesh uniform "
         "--creep-ratio 0.4"),
        "--support hub --formulation steady --load 700 --similar --creep-ratio -0.4",
        "--support halfplane --formulation static --load 700 --shift 1e-3 --similar"};
    for (int k = 0; k < 4; k++)
        if (is_in_turn(k, 4))
            check_refinement(cases[k]);
}

/* ---- The same case by other ways --------------------------------------------------- */

static const char *const supports[] = {"--support halfplane", "--support hub --similar",
                                       "--support arc --young-b 2e5 --radius-b 80 --support-b hub"};

/* A history of one increment is the increment. */
TEST(test_static_history_of_one_step)
{
    char line[500];
    write_file("one.txt", "load shift\n700 1e-3\n");
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        snprintf(line, sizeof line, "%s --formulation static --history one.txt --increments 1",
                 supports[k]);
        held_json *history = run_json(line);
        snprintf(line, sizeof line, "%s --formulation static --load 700 --shift 1e-3", supports[k]);
        held_json *single = run_json(line);
        check_same(single, history, 1e-11, line);
    }
}

/* What has not rolled yet is static. */
TEST(test_transient_at_rest)
{
    static const int same[] = {X, H, GAP, P, Q, UN, UT};
    char line[500];
    write_file("rest.txt", "distance load\n0 700\n");
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        snprintf(line, sizeof line, "%s --formulation transient --history rest.txt --increments 1",
                 supports[k]);
        held_json *rest = run_json(line);
        snprintf(line, sizeof line, "%s --formulation static --load 700", supports[k]);
        held_json *single = run_json(line);
        for (size_t j = 0; j < sizeof same / sizeof same[0]; j++)
            check_column(single, rest, same[j], 1.0, 1e-12, line);
    }
}

/* Each point of a curve is a case. */
TEST(test_curve)
{
    char line[500];
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        const char *rest = "--mesh uniform --zone 1.5 --load 700 --contact-elements 31";
        assert_int_equal(
            rollbemf("curve %s %s --from -0.5 --to 1 --points 4 --json --quiet", supports[k], rest),
            0);
        held_json *root = json_loads(out, 0, NULL);
        const json_t *curve = json_object_get(root, "curve");
        for (size_t i = 0; i < 4; i++) {
            snprintf(line, sizeof line, "%s %s --formulation steady --creep-ratio %.17g",
                     supports[k], rest, -0.5 + 0.5 * (double)i);
            held_json *single = run_json(line);
            CHECK_REL(entry(curve, "tangential_load", i), summary_of(single, "tangential_load"),
                      1e-9, "%s", line);
            CHECK_REL(entry(curve, "normal_load", i), summary_of(single, "normal_load"), 1e-9, "%s",
                      line);
            CHECK_REL(entry(curve, "creepage", i), summary_of(single, "creepage"), 1e-12, "%s",
                      line);
            CHECK_ABS(entry(curve, "dissipation", i), summary_of(single, "dissipation"), 1e-9, "%s",
                      line);
            CHECK_REL(number_in(curve, "free_creepage"), summary_of(single, "free_creepage"), 1e-6,
                      "%s", line);
        }
    }
}

/* The number of case `row` (1: the first) in the column of that name. */
static double cell(const char *text, int row, const char *name)
{
    const char *head = text, *place = strstr(head, name), *line = head;
    int column = 0;
    for (const char *p = head; p < place; p++)
        column += *p == '\t';
    for (int k = 0; k < row; k += *line != '#')
        line = strchr(line, '\n') + 1;
    for (int j = 0; j < column; j++)
        line = strchr(line, '\t') + 1;
    return strtod(line, NULL);
}

/* Each row of a study is a case, to the last digit. */
TEST(test_sweep)
{
    static char study[sizeof out];
    char line[500];
    for (int k = 0; k < 3; k++) {
        snprintf(line, sizeof line,
                 "sweep %s --formulation steady --load 700 --contact-elements 21 "
                 "--vary-1 'creep-ratio 0.2 0.4' --vary-2 'mu 0.1 0.3' --jobs 2 --quiet",
                 supports[k]);
        assert_int_equal(rollbem(line), 0);
        memcpy(study, out, sizeof out);
        for (int row = 1; row <= 4; row++) {
            snprintf(line, sizeof line,
                     "%s --formulation steady --load 700 --contact-elements 21 "
                     "--creep-ratio %g --mu %g",
                     supports[k], row <= 2 ? 0.2 : 0.4, row % 2 ? 0.1 : 0.3);
            held_json *single = run_json(line);
            CHECK_REL(cell(study, row, "tangential_load_N/mm"),
                      summary_of(single, "tangential_load"), 0.0, "%s", line);
            CHECK_REL(cell(study, row, "approach_mm"), summary_of(single, "approach"), 0.0, "%s",
                      line);
            CHECK_REL(cell(study, row, "free_creepage"), summary_of(single, "free_creepage"), 0.0,
                      "%s", line);
        }
    }
}

/* The library's words are the program's. */
TEST(test_library)
{
    static const char *const words[][2] = {{"formulation", "steady"},
                                           {"load", "700"},
                                           {"creep-ratio", "0.4"},
                                           {"similar", "yes"},
                                           {"contact-elements", "40"}};
    if (!getenv("OPENBLAS_NUM_THREADS"))
        rb_blas_threads(1); /* as the program */
    static const char *const held[] = {"halfplane", "hub", "arc"};
    for (int k = 0; k < 3; k++) {
        char line[300];
        OWNED(rb_rolling_solution) s;
        held_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
        CHECK_OK(rb_case_set(c, "support", held[k], RB_GIVEN_ARGUMENT, &message));
        for (int j = 0; j < 5; j++)
            CHECK_OK(rb_case_set(c, words[j][0], words[j][1], RB_GIVEN_ARGUMENT, &message));
        CHECK_OK(rb_case_resolve(c, &message));
        CHECK_OK(rb_rolling_solve(&rb_case_resolved(c)->rc, &s, &message));
        snprintf(line, sizeof line,
                 "--support %s --formulation steady --load 700 --creep-ratio 0.4 --similar "
                 "--contact-elements 40",
                 held[k]);
        held_json *root = run_json(line);
        for (int i = 0; i < s.n; i++) {
            CHECK_ABS(entry(table_of(root), "q_MPa", (size_t)i), s.q[i], 0.0, "%s", line);
            CHECK_ABS(entry(table_of(root), "p_MPa", (size_t)i), s.p[i], 0.0, "%s", line);
        }
        CHECK_ABS(summary_of(root, "tangential_load"), s.tangential_load, 0.0, "%s", line);
        CHECK_ABS(summary_of(root, "free_creepage"), s.free_creepage, 0.0, "%s", line);
    }
}

RUN_TESTS(enter_folder, leave_folder)
