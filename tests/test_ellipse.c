/* Hertz's ellipse of a wheel on a rail, and the strip through its middle. */
#include "cli_run.h"

#include <math.h>

#define STEEL "--support halfplane --similar --young 210000 --poisson 0.3 "

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

/* a, b, p0, approach, E* a/(2 p0) and pi a p0/2, by Carlson's integrals in another program. */
TEST(ellipses)
{
    static const struct {
        const char *line;
        double a, b, pressure, approach, radius;
    } rows[] = {{STEEL "--wheel-load 100kN --radius 460 "
                       "--transverse-radius-b 300 --mu 0.3",
                 7.161676, 5.387172, 1237.559, 0.104119, 333.862},
                {STEEL
                 "--wheel-load 100kN --radius 460 --transverse-radius-b 300 --transverse-radius "
                 "-500 --mu 0.3",
                 6.144483, 8.508753, 913.2509, 0.089304, 388.162},
                {STEEL "--wheel-load 100kN --radius 500 --transverse-radius 80 --mu 0.3", 8.865039,
                 2.656786, 2027.236, 0.122705, 252.287}};
    for (size_t k = 0; k < 3; k++) {
        held_json *root = run_jsonf("%s --contact-elements 240", rows[k].line);
        CHECK_REL(of_summary(root, "ellipse_a"), rows[k].a, 1e-6, "row %zu", k);
        CHECK_REL(of_summary(root, "ellipse_b"), rows[k].b, 1e-6, "row %zu", k);
        CHECK_REL(of_summary(root, "ellipse_pressure"), rows[k].pressure, 1e-6, "row %zu", k);
        CHECK_REL(of_summary(root, "ellipse_approach"), rows[k].approach, 1e-5, "row %zu", k);
        CHECK_REL(of_summary(root, "strip_radius"), rows[k].radius, 3e-6, "row %zu", k);
        CHECK_REL(of_summary(root, "normal_load"), 0.5 * acos(-1.0) * rows[k].a * rows[k].pressure,
                  1e-6, "row %zu", k);
        CHECK_REL(of_summary(root, "max_pressure"), rows[k].pressure, 2e-3, "row %zu", k);
        CHECK_REL(of_summary(root, "half_width"), rows[k].a, 5e-3, "row %zu", k);
    }
}

/* E* a/(2 p0) over the rolling radius, a/b from .1 to 10; a circle has pi/4. */
TEST(strip_radii)
{
    static const double want[][2] = {{0.1, 0.988926}, {0.2, 0.968602}, {0.5, 0.895903},
                                     {1, 0.785398},   {2, 0.630306},   {5, 0.409502},
                                     {10, 0.270671}};
    for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        /* the transverse radius of this a/b, by halving its logarithm */
        double low = log(0.05), high = log(2e5), ratio = 0.0, radius = 0.0;
        for (int i = 0; i < 28 && fabs(ratio / want[k][0] - 1.0) > 1e-6; i++) {
            const double middle = 0.5 * (low + high);
            held_json *root = run_jsonf(STEEL "--wheel-load 1kN --radius 100 --mu 0 "
                                              "--contact-elements 6 --transverse-radius %.15g",
                                        exp(middle));
            ratio = of_summary(root, "ellipse_a") / of_summary(root, "ellipse_b");
            radius = of_summary(root, "strip_radius");
            *(ratio > want[k][0] ? &low : &high) = middle;
        }
        CHECK_REL(radius / 100.0, want[k][1], 3e-6, "a/b = %g", want[k][0]);
    }
}

/* Carter's law with the radius of the strip; the axle's torque with that of rolling. */
TEST(the_strip_rolls)
{
    held_json *root =
        run_json(STEEL "--wheel-load 100kN --radius 460 --transverse-radius-b 300 --mu "
                       "0.3 --formulation steady --creep-ratio 0.4");
    const double a = of_summary(root, "ellipse_a"), Q = of_summary(root, "tangential_load");
    CHECK_ABS(of_summary(root, "force_ratio"), -0.64, 5e-4, "Carter");
    CHECK_REL(of_summary(root, "creepage"), 0.4 * 0.3 * a / of_summary(root, "strip_radius"), 1e-9,
              "creepage");
    CHECK_REL(of_summary(root, "torque_a"), Q * 460.0, 1e-6, "torque");
}

/* (E3) Q/(mu W) by strips, and with the slope of Kalker's C11: own integrals, and for nu = 1/4 a
 * solver in three dimensions that it meets to 2.5 %. */
TEST(force_of_the_whole)
{
    static const double strips[][2] = {{0.05, 0.114060506}, {0.1, 0.220631962}, {0.2, 0.411439707},
                                       {0.3, 0.572880187},  {0.5, 0.811119584}, {0.8, 0.980201331},
                                       {0.95, 0.999370944}, {1.3, 1.0}};
#define ROLLS                                                                                      \
    "--support halfplane --similar --young 210000 --poisson %g --wheel-load 100kN --radius 460 "   \
    "--mu 0.3 --formulation steady --transverse-radius-b %.12g --creep-ratio %g"
    for (size_t k = 0; k < sizeof strips / sizeof *strips; k++) {
        held_json *root = run_jsonf(ROLLS, 0.3, 300.0, k % 2 ? strips[k][0] : -strips[k][0]);
        CHECK_REL(of_summary(root, "ellipse_force"), (k % 2 ? -3e4 : 3e4) * strips[k][1], 1e-8,
                  "s = %g", strips[k][0]);
    }
    /* radii of the rail with a/b 1/2, 1, 2; the last is that of 3D */
    static const struct {
        double radius, ratio, s, corrected, solid;
    } rows[] = {{1307.6665, 0.5, 0.05, 0.1251, 0.1253},
                {460.0, 1.0, 0.05, 0.1417, 0.1411},
                {460.0, 1.0, 0.2, 0.497, 0.488},
                {460.0, 1.0, 0.5, 0.907, 0.892},
                {161.81496, 2.0, 0.2, 0.588, 0.573}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_json *root = run_jsonf(ROLLS, 0.25, rows[k].radius, rows[k].s);
        CHECK_REL(of_summary(root, "ellipse_a") / of_summary(root, "ellipse_b"), rows[k].ratio,
                  1e-3, "row %zu", k);
        const double Q = -of_summary(root, "ellipse_force_kalker") / 3e4;
        CHECK_ABS(Q, rows[k].corrected, 6e-4, "row %zu", k);
        CHECK_REL(Q, rows[k].solid, 0.03, "row %zu", k);
    }
    /* not of unlike bodies, and not where Kalker's table ends */
    held_json *unlike =
        run_json("--support halfplane --young 210000 --young-b 70000 --wheel-load 1kN --mu 0.3 "
                 "--radius 100 --transverse-radius 100 --formulation steady --creep-ratio 0.3");
    assert_null(json_object_get(json_object_get(unlike, "summary"), "ellipse_force"));
    held_json *middle = run_jsonf(ROLLS, 0.3, 300.0, 0.4);
    held_json *thin = run_jsonf(ROLLS, 0.3, 1e5, 0.4);
    assert_true(isnan(of_summary(thin, "ellipse_force_kalker")));
    CHECK_ABS(of_summary(thin, "ellipse_force") / 3e4, of_summary(middle, "ellipse_force") / 3e4,
              1e-9, "any ellipse");
}

/* (E3) Q by --strips is that of cases of their own at the nodes cos(phi) across the ellipse, whose
 * weights make them carry W: unlike bodies, friction that falls or is heated, a third body. */
TEST(strips_are_cases_of_their_own)
{
    static const struct {
        const char *bodies, *rolls;
        int strips;
    } rows[] = {
        {"--support halfplane --young 210000 --poisson 0.3 --young-b 73000 --poisson-b 0.33",
         "--mu 0.3 --creep 0.004", 5},
        {STEEL,
         "--mu 0.1 --friction-law exponential --mu-fall 0.1 --slip-scale 60 --speed 20000 "
         "--creep 0.002",
         4},
        {STEEL,
         "--mu 0.3 --mu-heat -0.1,20,300 --conductivity 50 --heat-capacity 3.6 --speed 20000 "
         "--temperature 20 --creep 0.003",
         4},
        {STEEL, "--mu 0.3 --interlayer-tangential 2e-6 --creep -0.002", 5},
        {STEEL, "--mu 0.3 --bulk-stress 100 --force-ratio -0.4", 3}};
    const double pi = acos(-1.0), W = 1e5;

    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const int n = rows[k].strips;
        held_json *whole = run_jsonf("%s %s --formulation steady --wheel-load 100kN --radius 460 "
                                     "--transverse-radius-b 300 --contact-elements 60 --strips %d",
                                     rows[k].bodies, rows[k].rolls, n);
        char rolls[300];
        snprintf(rolls, sizeof rolls, "%s", rows[k].rolls);
        char *force = strstr(rolls, "--force-ratio");
        if (force) /* the strips have the creepage that this makes */
            snprintf(force, sizeof rolls - (size_t)(force - rolls), "--creep %.17g",
                     of_summary(whole, "creepage"));
        double sum = 0.0, carried = 0.0;
        for (int j = 0; j < n; j++) {
            const double sine = sin((j + 0.5) * pi / n);
            held_json *strip = run_jsonf(
                "%s %s --formulation steady --gap parabola --radius %.17g --half-width %.17g "
                "--contact-elements 60",
                rows[k].bodies, rolls, of_summary(whole, "strip_radius"),
                of_summary(whole, "ellipse_a") * sine);
            sum += sine * of_summary(strip, "tangential_load");
            carried += sine * of_summary(strip, "normal_load");
        }
        CHECK_REL(of_summary(whole, "ellipse_force"), W * sum / carried, 1e-7, "row %zu", k);
    }
}

/* (E3) by both ways, and full sliding, which any number of strips has; a curve has the forces of
 * its points. */
TEST(strips_add_up)
{
    static const double s[] = {0.1, 0.3, 0.5, 0.8},
                        want[] = {0.220631962, 0.572880187, 0.811119584, 0.980201331};
    for (size_t k = 0; k < 4; k++) {
        held_json *nine = run_jsonf(ROLLS " --strips 9", 0.3, 300.0, s[k]);
        held_json *more = run_jsonf(ROLLS " --strips 15", 0.3, 300.0, s[k]);
        CHECK_ABS(of_summary(nine, "ellipse_force") / -3e4, want[k], 4.4e-4, "9, s = %g", s[k]);
        CHECK_ABS(of_summary(more, "ellipse_force") / -3e4, want[k], 1e-4, "15, s = %g", s[k]);
    }
    held_json *slides =
        run_json("--support halfplane --young 210000 --young-b 70000 --wheel-load 1kN --mu 0.3 "
                 "--radius 100 --transverse-radius 100 --formulation steady --creep 0.5 --strips 3 "
                 "--contact-elements 30");
    CHECK_REL(of_summary(slides, "ellipse_force"), -300.0, 1e-9, "full sliding");
#define UNLIKE                                                                                     \
    "--support halfplane --young 210000 --young-b 70000 --wheel-load 1kN --mu 0.3 --radius 100 "   \
    "--transverse-radius 100 --strips 3 --contact-elements 30 "
    held_json *curve = run_json("curve " UNLIKE "--from 0 --to 1 --points 3");
    for (size_t k = 0; k < 3; k++) {
        held_json *one = run_jsonf(UNLIKE "--formulation steady --creep-ratio %g", 0.5 * (double)k);
        CHECK_ABS(entry(json_object_get(curve, "curve"), "ellipse_force", k),
                  of_summary(one, "ellipse_force"), 0.05, "point %zu", k);
    }
}

/* a and p0 grow like the cube root of the load, what the strip carries per width like its square.
 */
TEST(derivatives)
{
    held_json *root =
        run_json(STEEL "--wheel-load 100kN --radius 460 --transverse-radius-b 300 --mu "
                       "0.3 --formulation steady --creep-ratio 0.4 "
                       "--derivatives=normal_load,half_width");
    const json_t *d = json_object_get(root, "derivatives");
    CHECK_REL(number_in(json_object_get(d, "normal_load"), "wheel-load"),
              of_summary(root, "normal_load") / 1.5e5, 1e-6, "P");
    CHECK_REL(number_in(json_object_get(d, "half_width"), "wheel-load"),
              of_summary(root, "half_width") / 3e5, 1e-3, "a");
}

TEST(what_is_refused)
{
    static const struct {
        const char *line, *words;
    } rows[] = {
        {STEEL "--wheel-load 1kN --radius 100 --mu 0", "bodies that touch along a line"},
        {STEEL
         "--wheel-load 1kN --radius 100 --transverse-radius -80 --transverse-radius-b 100 --mu 0",
         "must be > 0"},
        {STEEL "--wheel-load 1kN --radius 100 --transverse-radius 80 --load 100", "--load"},
        {STEEL "--load 1 --radius 100 --transverse-radius-b 80", "--transverse-radius-b: that of"},
        {STEEL "--wheel-load 1kN --radius 100 --transverse-radius 80 --gap exact",
         "needs --gap parabola"},
        {"wear " STEEL "--wheel-load 1kN --radius 100 --transverse-radius 80 --mu 0.3 --slide 100 "
         "--wear-coefficient 1e-8",
         "apart from its ellipse"},
        {STEEL "--load 10 --radius 100 --strips 9 --formulation steady --creep 0", "--wheel-load"},
        {STEEL "--wheel-load 1kN --radius 100 --transverse-radius 80 --strips 9 --mu 0.3",
         "--formulation steady"},
        {STEEL "--wheel-load 1kN --radius 100 --transverse-radius 80 --strips -1 --mu 0.3",
         "--strips: expected a whole number"},
        {"--wheel-load 1kN --transverse-radius 80", "half-planes of one elastic material"},
        {STEEL "--wheel-load 1kN --transverse-radius 80 --layer-thickness 3 --base-young 1e5",
         "half-planes of one elastic material"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, 64, rows[k].words);
}

RUN_TESTS(enter_folder, leave_folder)
