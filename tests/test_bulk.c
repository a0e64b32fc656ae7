/* Bulk stress: the closed form of a displaced stick zone, paths and cycles of other prototypes, the
 * creepage that strains shift, stress and cracks, and what is refused. */
#include "cli_run.h"

#include <math.h>

/* Similar steel, p0 = 1000 MPa, mu p0 = 500 MPa. */
#define SIMILAR                                                                                    \
    "--support halfplane --similar --young 210000 --poisson 0.3 --gap parabola --radius 100 "      \
    "--max-pressure 1000 --mu 0.5 "
static const double TRACTION = 500.0, MODULUS = 210000.0 / 1.82, HALF_WIDTH = 2e5 / MODULUS,
                    COMPLIANCE = 0.91 / 210000.0;

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

static const json_t *column(const json_t *root, const char *table, const char *name)
{
    return NOT_NULL(json_object_get(json_object_get(root, table), name));
}

static double at(const json_t *list, size_t i)
{
    return json_number_value(json_array_get(list, i));
}

/* q/(mu p0) at x/a, linear between midpoints. */
static double friction_at(const json_t *root, double x)
{
    const json_t *place = column(root, "table", "x_mm"), *q = column(root, "table", "q_MPa");
    size_t i = 0;
    x *= HALF_WIDTH;
    while (i + 2 < json_array_size(place) && at(place, i + 1) < x)
        i++;
    const double part = (x - at(place, i)) / (at(place, i + 1) - at(place, i));
    return ((1.0 - part) * at(q, i) + part * at(q, i + 1)) / TRACTION;
}

static double ellipse(double x)
{
    return fabs(x) < 1.0 ? sqrt(1.0 - x * x) : 0.0;
}

/* In one step Q and X displace the stick zone as long as it lies in the contact. */
TEST(stick_is_displaced)
{
    static const double stress[] = {0.0, 0.4, 1.0, 1.2, 1.4}, r = 0.6;
    for (int sign = -1; sign <= 1; sign += 2)
        for (size_t k = 0; k < 5; k++) {
            held_json *root =
                run_jsonf(SIMILAR "--force-ratio %g --bulk-stress-b %g --contact-elements 200",
                          sign * r, TRACTION * stress[k]);
            const double c = sqrt(1.0 - r), x0 = -sign * stress[k] / 4.0, h = 0.015;
            const json_t *x = column(root, "table", "x_mm"), *q = column(root, "table", "q_MPa");
            double sum = 0.0;
            for (size_t i = 0; i < json_array_size(x); i++) {
                const double u = at(x, i) / HALF_WIDTH,
                             want = sign * (ellipse(u) - c * ellipse((u - x0) / c));
                sum += pow(at(q, i) / TRACTION - want, 2.0);
            }
            CHECK_MAX(sqrt(sum / (double)json_array_size(x)), 5e-3, "X = %g mu p0", stress[k]);
            CHECK_ABS(of_summary(root, "stick_from") / HALF_WIDTH, x0 - c, h, "X = %g", stress[k]);
            CHECK_ABS(of_summary(root, "stick_to") / HALF_WIDTH, x0 + c, h, "X = %g", stress[k]);
        }
}

/* The same strain in A, of the other sign, or of an A whose own it is, displaces it likewise. */
TEST(only_the_difference_counts)
{
    held_json *b = run_json(SIMILAR "--force-ratio 0.6 --bulk-stress-b 300");
    held_json *a = run_json(SIMILAR "--force-ratio 0.6 --bulk-stress -300");
    held_json *both = run_json(SIMILAR "--force-ratio 0.6 --bulk-stress 200 --bulk-stress-b 500");
    const json_t *q = column(b, "table", "q_MPa");
    for (size_t i = 0; i < json_array_size(q); i++) {
        CHECK_ABS(at(column(a, "table", "q_MPa"), i), at(q, i), 1e-7, "A, element %zu", i);
        CHECK_ABS(at(column(both, "table", "q_MPa"), i), at(q, i), 1e-7, "both, element %zu", i);
    }
}

/* Beyond the limit one step is not a path: q(-.9 -.8 -.5 0 .5)/(mu p0) by a prototype of its own,
 * 400 elements. */
TEST(one_step_is_not_a_path)
{
    static const struct {
        double stress;
        int increments;
        double from, to, q[5];
    } rows[] = {{2.5, 1, -0.850, 0.0325, {-0.4359, -0.1925, 0.1927, 0.7978, 0.8660}},
                {2.5, 50, -0.92, 0.0325, {-0.4339, -0.1933, 0.1926, 0.7977, 0.8660}},
                {4.0, 1, -0.695, -0.2125, {-0.4359, -0.6, 0.1170, 1.0, 0.8660}},
                {4.0, 50, -0.81, -0.2125, {-0.4359, -0.5988, 0.1159, 1.0, 0.8660}}};
    static const double place[] = {-0.9, -0.8, -0.5, 0.0, 0.5};
    for (size_t k = 0; k < 4; k++) {
        if (rows[k].increments > 1 && !is_in_turn((int)k / 2, 2))
            continue;
        held_json *root = run_jsonf(SIMILAR "--force-ratio 0.6 --bulk-stress-b %g --increments %d "
                                            "--contact-elements 200",
                                    TRACTION * rows[k].stress, rows[k].increments);
        CHECK_ABS(of_summary(root, "stick_from") / HALF_WIDTH, rows[k].from, 0.02, "row %zu", k);
        CHECK_ABS(of_summary(root, "stick_to") / HALF_WIDTH, rows[k].to, 0.01, "row %zu", k);
        for (int i = 0; i < 5; i++)
            CHECK_ABS(friction_at(root, place[i]), rows[k].q[i], 4e-3, "row %zu at %g", k,
                      place[i]);
    }
}

/* Rows from one corner of a path (force ratio, X/(mu p0)) to the next, in equal steps. */
static void write_path(int corners, const double (*corner)[2], int steps)
{
    FILE *file = NOT_NULL(fopen("path.txt", "w"));
    fprintf(file, "force_ratio bulk_stress_b\n");
    for (int k = 0; k + 1 < corners; k++)
        for (int i = 1; i <= steps; i++) {
            const double part = (double)i / steps, *from = corner[k], *to = corner[k + 1];
            fprintf(file, "%.12g %.12g\n", from[0] + part * (to[0] - from[0]),
                    TRACTION * (from[1] + part * (to[1] - from[1])));
        }
    fclose(file);
}

#define ALONG SIMILAR "--history path.txt --increments 1 --contact-elements "

TEST(the_order_counts)
{
    static const struct {
        double corner[3][2], from, to, q[2];
    } rows[] = {{{{0, 0}, {0, 1}, {0.6, 1}}, -0.820, 0.385, {0.2783, 0.4165}},
                {{{0, 0}, {0.6, 0}, {0.6, 1}}, -0.895, 0.365, {0.3758, 0.4518}},
                {{{0, 0}, {0.3, 0.5}, {0.6, 1}}, -0.8825, 0.3825, {0.2851, 0.4190}}};
    for (size_t k = 0; k < 3; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        write_path(3, rows[k].corner, 20);
        held_json *root = run_json(ALONG "300");
        CHECK_ABS(of_summary(root, "stick_from") / HALF_WIDTH, rows[k].from, 0.01, "row %zu", k);
        CHECK_ABS(of_summary(root, "stick_to") / HALF_WIDTH, rows[k].to, 0.01, "row %zu", k);
        for (int i = 0; i < 2; i++)
            CHECK_ABS(friction_at(root, -0.5 + 0.5 * i), rows[k].q[i], 1e-3, "row %zu", k);
    }
}

/* Friction work per cycle over (mu p0 a)^2/E*, and at Q = 0 the tractions of the closed form with
 * twice the correction. */
TEST(cycles)
{
    static const struct {
        double stress, work, tolerance;
    } rows[] = {
        {0.0, 0.16805, 4e-3}, {0.4, 0.20575, 4e-3}, {1.0, 0.40368, 3e-3}, {2.5, 1.5951, 3e-3}};
    enum { QUARTER = 10 };
    const double unit = pow(TRACTION * HALF_WIDTH, 2.0) / MODULUS;
    for (size_t k = 0; k < 4; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        const double r = 0.6, X = rows[k].stress,
                     corner[][2] = {{0, 0}, {r, X}, {0, 0},   {-r, -X}, {0, 0},
                                    {r, X}, {0, 0}, {-r, -X}, {0, 0},   {r, X}};
        write_path(10, corner, QUARTER);
        held_json *root = run_json(ALONG "200");
        const json_t *work = column(root, "history", "friction_work");
        const size_t last = json_array_size(work) - 1;
        CHECK_REL((at(work, last) - at(work, last - 4 * QUARTER)) / unit, rows[k].work,
                  rows[k].tolerance, "work per cycle, X = %g mu p0", X);
    }
    static const double unloaded[][2] = {{0, 0}, {0.6, 1.0}, {0, 0}};
    write_path(3, unloaded, QUARTER);
    held_json *root = run_json(ALONG "300");
    const double c = sqrt(0.4), x0 = -0.25, reversed = sqrt(0.7), back = 0.5 * x0;
    CHECK_ABS(of_summary(root, "stick_from") / HALF_WIDTH, back - reversed, 0.01, "unloaded");
    CHECK_ABS(of_summary(root, "stick_to") / HALF_WIDTH, back + reversed, 0.01, "unloaded");
    for (int i = -1; i <= 1; i++) {
        const double x = 0.5 * i,
                     want = ellipse(x) - c * ellipse((x - x0) / c) -
                            2.0 * (ellipse(x) - reversed * ellipse((x - back) / reversed));
        CHECK_ABS(friction_at(root, x), want, 1e-3, "unloaded at %g", x);
    }
}

/* Steel and aluminium: pressed in one step, then Q and X of B in fifty. */
TEST(dissimilar)
{
    static const struct {
        const char *bodies;
        double from, to, stick_from, stick_to, p, q;
    } rows[] = {{"--young 210000 --poisson 0.3 --young-b 73000 --poisson-b 0.33", -0.979, 1.029,
                 -0.979, 0.500, 0.99298, 0.38330},
                {"--young 73000 --poisson 0.33 --young-b 210000 --poisson-b 0.3", -1.023, 0.979,
                 -0.880, 0.253, 1.01832, 0.48526}};
    const double modulus = 60458.8, a = sqrt(4.0 * 200.0 * 100.0 / (acos(-1.0) * modulus)),
                 p0 = modulus * a / 200.0;
    FILE *file = NOT_NULL(fopen("unlike.txt", "w"));
    fprintf(file, "force_ratio bulk_stress_b\n");
    for (int i = 0; i <= 50; i++)
        fprintf(file, "%.12g %.12g\n", 0.6 * i / 50, 0.5 * p0 * i / 50);
    fclose(file);
    for (size_t k = 0; k < 2; k++) {
        if (!is_in_turn((int)k, 2))
            continue;
        held_json *root = run_jsonf("--support halfplane --gap parabola --radius 100 --load 200 "
                                    "--mu 0.5 %s --history unlike.txt --increments 1 --zone %.12g "
                                    "--contact-elements 400",
                                    rows[k].bodies, 1.1 * a);
        const double h = 2.2 / 400, wider = 1.5 * h;
        CHECK_ABS(of_summary(root, "contact_from") / a, rows[k].from, wider, "row %zu", k);
        CHECK_ABS(of_summary(root, "contact_to") / a, rows[k].to, wider, "row %zu", k);
        CHECK_ABS(of_summary(root, "stick_from") / a, rows[k].stick_from, 2.0 * h, "row %zu", k);
        CHECK_ABS(of_summary(root, "stick_to") / a, rows[k].stick_to, 2.0 * h, "row %zu", k);
        const json_t *x = column(root, "table", "x_mm");
        const size_t i = json_array_size(x) / 2 - 1; /* its end is x = 0 */
        const json_t *p = column(root, "table", "p_MPa"), *q = column(root, "table", "q_MPa");
        CHECK_ABS(0.5 * (at(p, i) + at(p, i + 1)) / p0, rows[k].p, 2e-4, "p(0), row %zu", k);
        CHECK_ABS(0.5 * (at(q, i) + at(q, i + 1)) / (0.5 * p0), rows[k].q, 1e-3, "q(0), row %zu",
                  k);
    }
}

/* Steady rolling: at given Q the creepage, and that of free rolling, is shifted by the difference
 * of the strains, and nothing else changes; rolling from rest comes there. */
TEST(creepage_is_shifted)
{
    static const char *const bodies[] = {
        SIMILAR "--force-ratio 0.3 ", SIMILAR "--force-ratio 0.3 --mesh aligned ",
        SIMILAR "--force-ratio -1 ",
        "--support halfplane --gap parabola --radius 100 --load 200 --mu 0.3 --young 210000 "
        "--poisson 0.3 --young-b 73000 --poisson-b 0.33 --force-ratio -0.4 "};
    const double X = 150.0;
    for (size_t k = 0; k < 4; k++) {
        held_json *before = run_jsonf("%s --formulation steady", bodies[k]);
        held_json *strained = run_jsonf("%s --formulation steady --bulk-stress %g", bodies[k], X);
        const double shift = X * COMPLIANCE, xi = of_summary(before, "creepage"),
                     free = of_summary(before, "free_creepage");
        CHECK_ABS(of_summary(strained, "creepage") - xi, shift, 1e-8 * shift, "row %zu", k);
        CHECK_ABS(of_summary(strained, "free_creepage") - free, shift, 1e-8 * shift, "row %zu", k);
        const json_t *was = column(before, "table", "q_MPa"),
                     *is = column(strained, "table", "q_MPa");
        for (size_t i = 0; i < json_array_size(was); i++)
            CHECK_ABS(at(is, i), at(was, i), 1e-6, "row %zu, element %zu", k, i);
        held_json *given = run_jsonf("%.*s --creep %.15g --formulation steady --bulk-stress %g",
                                     (int)(strstr(bodies[k], "--force-ratio") - bodies[k]),
                                     bodies[k], xi + shift, X);
        CHECK_REL(of_summary(given, "tangential_load"), of_summary(before, "tangential_load"), 2e-4,
                  "row %zu, given creepage", k);
    }
    held_json *before = run_json(SIMILAR "--force-ratio -0.5 --formulation transient --distance 5");
    held_json *after = run_json(SIMILAR "--force-ratio -0.5 --formulation transient --distance 5 "
                                        "--bulk-stress-b 150");
    CHECK_ABS(of_summary(after, "creepage") - of_summary(before, "creepage"), -X * COMPLIANCE,
              2e-3 * X * COMPLIANCE, "rolling from rest");
}

/* X adds to sxx, nu X to szz; a residual stress takes it away again, so that the shakedown limit
 * stays. */
TEST(stress_inside)
{
    static const char *const body[] = {"a", "b"};
    write_file("points.txt", "0 0.5\n1 2\n-3 4\n20 60\n");
    write_file("below.txt", "0 -0.5\n1 -2\n-3 -4\n20 -60\n");
    for (int k = 0; k < 2; k++) {
        json_t *root[2];
        for (int with = 0; with < 2; with++) {
            char line[600];
            snprintf(line, sizeof line,
                     "stress " SIMILAR "--mu 0 --body %s --points "
                     "%s --shakedown %s",
                     body[k], k ? "below.txt" : "points.txt",
                     !with ? ""
                     : k   ? "--bulk-stress-b 120"
                           : "--bulk-stress 120");
            root[with] = run_json(line);
        }
        static const struct {
            const char *name;
            double more;
        } part[] = {{"sxx_MPa", 120.0}, {"syy_MPa", 0.0}, {"sxy_MPa", 0.0}, {"szz_MPa", 36.0}};
        for (int i = 0; i < 4; i++)
            for (size_t j = 0; j < 4; j++)
                CHECK_ABS(at(column(root[1], "points", part[i].name), j) -
                              at(column(root[0], "points", part[i].name), j),
                          part[i].more, 1e-9, "%s of %s at point %zu", part[i].name, body[k], j);
        CHECK_REL(number_in(json_object_get(root[1], "shakedown"), "shear_yield"),
                  number_in(json_object_get(root[0], "shakedown"), "shear_yield"), 1e-6, "%s",
                  body[k]);
        json_decref(root[0]);
        json_decref(root[1]);
    }
}

/* Bodies that are strained alike have the tractions of unstrained ones, also in partial slip, and
 * shakedown needs a residual stress that takes the bulk stress away. */
TEST(strained_alike)
{
    static const char *const slips[] = {"--formulation static --force-ratio 0.6",
                                        "--formulation steady --force-ratio -0.6"};
    static const char *const part[] = {"sxx_MPa", "syy_MPa", "sxy_MPa", "szz_MPa"};
    static const double more[] = {120.0, 0.0, 0.0, 36.0};
    write_file("points.txt", "0 0.5\n1 2\n-3 4\n");
    for (size_t k = 0; k < sizeof slips / sizeof *slips; k++) {
        held_json *none =
                      run_jsonf("stress " SIMILAR "%s --points points.txt --shakedown", slips[k]),
                  *both = run_jsonf("stress " SIMILAR "%s --points points.txt --shakedown "
                                    "--bulk-stress 120 --bulk-stress-b 120",
                                    slips[k]);
        for (int i = 0; i < 4; i++)
            for (size_t j = 0; j < 3; j++)
                CHECK_ABS(at(column(both, "points", part[i]), j) -
                              at(column(none, "points", part[i]), j),
                          more[i], 1e-9, "%s, %s at point %zu", slips[k], part[i], j);
        const json_t *free_of_it = json_object_get(none, "shakedown"),
                     *with_it = json_object_get(both, "shakedown");
        CHECK_REL(number_in(with_it, "shear_yield"), number_in(free_of_it, "shear_yield"), 1e-9,
                  "%s", slips[k]);
        CHECK_ABS(number_in(with_it, "residual") - number_in(free_of_it, "residual"), -120.0, 1e-6,
                  "%s", slips[k]);
    }
}

/* An edge crack of B feels it as a remote stress; far from the contact K_I = 1.1215 X sqrt(pi l).
 */
TEST(cracks)
{
#define CRACK                                                                                      \
    "crack " SIMILAR "--crack-length 0.05mm --crack-angle 90 --from -100 --steps 300 --mu 0 "
    held_json *bulk = run_json(CRACK "--bulk-stress-b 80");
    held_json *remote = run_json(CRACK "--remote-stress 80");
    const json_t *K = column(bulk, "table", "K_I"), *other = column(remote, "table", "K_I");
    CHECK_REL(at(K, 0), 1.1215 * 80.0 * sqrt(acos(-1.0) * 0.05), 5e-3, "far away");
    for (size_t i = 0; i < json_array_size(K); i++)
        CHECK_ABS(at(K, i), at(other, i), 1e-9, "position %zu", i);
    CHECK_RUN(shell("\"$R\" " CRACK "--bulk-stress-b 80 --states --json --quiet > c.json && "
                    "\"$R\" check c.json"),
              0, out, "valid");
}

/* Derivatives against differences. */
TEST(derivatives)
{
    held_json *root = run_json(SIMILAR "--force-ratio 0.6 --bulk-stress-b 200 --zone 2.2 "
                                       "--derivatives=tangential_shift");
    const json_t *d = json_object_get(json_object_get(root, "derivatives"), "tangential_shift");
    double shift[2];
    for (int k = 0; k < 2; k++) {
        held_json *beside = run_jsonf(SIMILAR "--force-ratio 0.6 --bulk-stress-b %g --zone 2.2",
                                      200.0 + (k ? 1e-3 : -1e-3));
        shift[k] = of_summary(beside, "tangential_shift");
    }
    CHECK_REL(number_in(d, "bulk-stress-b"), (shift[1] - shift[0]) / 2e-3, 1e-5, "shift");
    held_json *rolls =
        run_json(SIMILAR "--force-ratio 0.6 --bulk-stress-b 200 --formulation steady "
                         "--derivatives=creepage");
    d = json_object_get(json_object_get(rolls, "derivatives"), "creepage");
    CHECK_REL(number_in(d, "bulk-stress-b"), -COMPLIANCE, 1e-8, "creepage");
}

/* The notes of a single case, where a column of a history has the bulk stress. */
TEST(histories_have_the_notes)
{
    static const struct {
        const char *line, *rows, *single, *note;
    } cases[] = {
        {"--formulation transient ", "distance creep bulk_stress\n0 1e-3 20\n1 1e-3 50\n",
         "--distance 1 --creep 1e-3 --bulk-stress 50",
         "note: The creepage is that of the unstrained bodies: the bulk stresses shift every "
         "creepage by 0.0002167."},
        {"", "shift bulk_stress\n0 20\n0 5e4\n", "--shift 0 --bulk-stress 5e4",
         "note: The strains are far beyond linear elasticity (bulk strain = 0.22)"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char line[500];
        write_file("bulk.txt", cases[k].rows);
        snprintf(line, sizeof line, SIMILAR "%s %s", cases[k].line, cases[k].single);
        assert_int_equal(rollbem(line), 0);
        assert_non_null(strstr(err, cases[k].note));
        snprintf(line, sizeof line, SIMILAR "%s --history bulk.txt", cases[k].line);
        assert_int_equal(rollbem(line), 0);
        assert_non_null(strstr(err, cases[k].note));
    }
}

TEST(what_is_refused)
{
#define ONE_MATERIAL "it needs half-planes of one elastic material"
    static const struct {
        const char *line, *words;
    } rows[] = {
        {"--support halfplane --load 100 --bulk-stress-b 10", "a rigid body B is not strained"},
        {"--load 100 --bulk-stress 10", ONE_MATERIAL},
        {SIMILAR "--bulk-stress-b 10 --support-b hub --radius-b 80", ONE_MATERIAL},
        {SIMILAR "--bulk-stress 10 --layer-thickness 2 --base-young 1000", ONE_MATERIAL},
        {SIMILAR "--bulk-stress 10 --relaxation-time 1 --relaxation-ratio 1 --speed 10 "
                 "--formulation steady",
         ONE_MATERIAL},
        {SIMILAR "--bulk-stress nan", "expected a number"},
        {"wear " SIMILAR "--bulk-stress 10 --cycles 10 --force-ratio 0.5 --wear-coefficient 1e-8",
         "steady rolling only"},
        {"crack " SIMILAR "--bulk-stress-b 10 --unloaded --remote-stress 3",
         "--unloaded takes --remote-stress"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, 64, rows[k].words);
}

RUN_TESTS(enter_folder, leave_folder)
