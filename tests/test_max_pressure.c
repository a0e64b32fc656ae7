/* The largest pressure as the load: Hertz's formula, layers, a quartic gap, wheels by the way back,
 * and what is refused. */
#include "cli_run.h"
#include "random_case.h"

#include <gsl/gsl_math.h>
#include <jansson.h>
#include <math.h>

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

#define FLAT "--support halfplane --gap parabola --mu 0 "
#define LAYER FLAT "--radius 100 --young 1000 --layer-thickness 2 "

/* Layers: Chebyshev polynomials, seven digits; the quartic gap: a closed form. */
TEST(loads_of_pressures)
{
    static const struct {
        const char *line;
        double load, tolerance, half_width;
    } rows[] = {
        {FLAT "--similar --young 206000 --poisson 0.3 --radius 23.5 --radius-b 23.5 --max-pressure "
              "1500",
         733.7945, 1e-7, 0.3114320},
        {FLAT "--young 210000 --poisson 0.3 --radius 50 --young-b 70000 --poisson-b 0.33 "
              "--max-pressure 600",
         964.9088, 1e-7, 1.023800},
        {LAYER "--poisson 0.3 --max-pressure 20", 65.02324, 2e-4, 2.153450},
        {LAYER "--poisson 0.3 --max-pressure 100", 735.5238, 2e-4, 5.215593},
        {LAYER "--poisson 0.5 --max-pressure 20", 51.99160, 2e-4, 1.716565},
        {LAYER "--poisson 0.5 --max-pressure 100", 511.9665, 2e-4, 3.672729},
        {LAYER "--poisson 0.3 --base-young 210000 --base-poisson 0.3 --max-pressure 20", 65.17816,
         2e-4, 2.158396},
        {LAYER "--poisson 0.3 --base-young 210000 --base-poisson 0.3 --max-pressure 100", 740.7084,
         2e-4, 5.249948},
        {"--support halfplane --gap quartic.txt --young 105000 --poisson 0.3 --mu 0 "
         "--contact-elements 200 --max-pressure 1000",
         3048.891, 2e-4, 1.829977}};
    FILE *file = NOT_NULL(fopen("quartic.txt", "w"));
    fprintf(file, "x gap\n");
    for (int i = -400; i <= 400; i++)
        fprintf(file, "%.10g %.14g\n", 0.01 * i, 1e-3 * gsl_pow_4(0.01 * i));
    fclose(file);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_json *root = run_json(rows[k].line);
        CHECK_REL(of_summary(root, "normal_load"), rows[k].load, rows[k].tolerance, "%s",
                  rows[k].line);
        CHECK_REL(of_summary(root, "half_width"), rows[k].half_width, 8e-3, "%s", rows[k].line);
    }
}

/* The way back: under the load that is found the pressure is the one that was asked for, on the
 * same mesh; with every regime that a search takes. */
TEST(the_way_back)
{
    static const char *const lines[] = {
        "--support hub --gap parabola --young 210000 --poisson 0.3 --mu 0.3 --formulation steady "
        "--creep 0.001 --contact-elements 40",
        "--support arc --young 210000 --poisson 0.3 --mu 0.3 --mesh uniform --contact-elements 40",
        "--support halfplane --gap parabola --young 210000 --poisson 0.3 --mu 0.4 --formulation "
        "steady --force-ratio 0.5 --contact-elements 40",
        "--support halfplane --gap parabola --young 2000 --poisson 0.4 --mu 0.3 --formulation "
        "steady "
        "--creep 0.001 --relaxation-time 0.01 --relaxation-ratio 2 --speed 100 --contact-elements "
        "40",
        "--support halfplane --gap parabola --young 210000 --poisson 0.3 --mu 0.2 "
        "--interlayer-normal 1e-6 --interlayer-tangential 1e-6 --contact-elements 40",
        "--support hub --cover-thickness 6 --young 20 --poisson 0.45 --mu 0.2 --contact-elements "
        "30"};
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        const double wanted = k == 5 ? 2.0 : k == 3 ? 20.0 : 700.0;
        char line[600];
        snprintf(line, sizeof line, "%s --max-pressure %g", lines[k], wanted);
        held_json *root = run_json(line);
        CHECK_REL(of_summary(root, "max_pressure"), wanted, 2e-10, "%s", line);
        const json_t *inputs = json_object_get(root, "inputs");
        const double zone = number_in(inputs, "zone");
        char size[60] = "";
        if (zone > 0.0)
            snprintf(size, sizeof size, "--zone %.17g", zone);
        snprintf(line, sizeof line, "%s --mesh %s %s --load %.17g", lines[k],
                 json_string_value(json_object_get(inputs, "mesh")), size,
                 of_summary(root, "normal_load"));
        held_json *back = run_json(line);
        CHECK_REL(of_summary(back, "max_pressure"), wanted, 1e-8, "%s", line);
    }
}

/* Hertz's load of a table is so large that its contact would reach the end of the table; the load
 * that is searched for is smaller.  A pressure that no contact inside the table has is refused. */
TEST(a_table_that_ends_beyond_the_contact)
{
#define SKEW                                                                                       \
    "--support halfplane --gap skew.txt --young 210000 --poisson 0.3 --young-b 50000 "             \
    "--poisson-b 0.1 --mu 0.4 --contact-elements 60 "
    static const char *const lines[] = {SKEW "--formulation steady --creep-ratio 0.4",
                                        SKEW "--formulation static --force-ratio 0.5",
                                        SKEW "--formulation static --mesh uniform"};
    FILE *file = NOT_NULL(fopen("skew.txt", "w"));
    fprintf(file, "x gap\n");
    for (int i = -60; i <= 60; i++) {
        const double x = 0.05 * i;
        fprintf(file, "%.10g %.14g\n", x, x * x / 200.0 + 1e-3 * gsl_pow_3(x));
    }
    fclose(file);
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        char line[600];
        snprintf(line, sizeof line, "%s --max-pressure 295", lines[k]);
        held_json *root = run_json(line);
        CHECK_REL(of_summary(root, "max_pressure"), 295.0, 2e-10, "%s", line);
        snprintf(line, sizeof line, "%s --max-pressure 3000", lines[k]);
        check_refused(line, 1, "no load was found whose contact stays within the table");
    }
}

/* Random cases, and the same with exchanged bodies: the way back, and the same load. */
static void draw(random_case *c, int k, int exchanged)
{
    const char *const of[] = {exchanged ? "-b" : "", exchanged ? "" : "-b"};
    *c = (random_case){.state = (uint64_t)k * 40503u + 7u, .line = ""};
    random_add(c, "--support halfplane --gap parabola --contact-elements %d --mu %g ",
               20 + random_choice(c, 20), random_choice(c, 2) ? random_between(c, 0.05, 0.6) : 0.0);
    for (int body = 0; body < 2; body++) {
        const double young = random_log(c, 2e3, 2e5);
        random_add(c, "--young%s %g --poisson%s %g --radius%s %g ", of[body], young, of[body],
                   random_between(c, 0.0, 0.45), of[body], random_between(c, 20.0, 200.0));
        if (random_choice(c, 3) == 0)
            random_add(c, "--layer-thickness%s %g --base-young%s %g --base-poisson%s 0.3 ",
                       of[body], random_log(c, 0.3, 3.0), of[body], young * random_log(c, 0.2, 5.0),
                       of[body]);
    }
    if (random_choice(c, 4) == 0)
        random_add(c, "--interlayer-normal %g ", random_log(c, 1e-7, 1e-5));
}

TEST(random_cases_go_back)
{
    for (int k = 0; k < 100; k++) {
        random_case c, other;
        if (!is_in_turn(k, 10))
            continue;
        draw(&c, k, 0);
        draw(&other, k, 1);
        char line[980];
        snprintf(line, sizeof line, "%.950s --max-pressure 10", c.line);
        held_json *root = run_json(line);
        const double load = of_summary(root, "normal_load");
        if (strstr(line, "layer") || !strstr(line, "--mu 0 ")) /* searched for; else Hertz's */
            CHECK_REL(of_summary(root, "max_pressure"), 10.0, 2e-10, "case %d: %s", k, line);
        else
            CHECK_REL(2.0 * load / (M_PI * of_summary(root, "hertz_half_width")), 10.0, 1e-9,
                      "case %d: %s", k, line);
        snprintf(line, sizeof line, "%.950s --max-pressure 10", other.line);
        held_json *exchanged = run_json(line);
        CHECK_REL(of_summary(exchanged, "normal_load"), load, 1e-7, "case %d: %s", k, line);
    }
}

/* Where Hertz's formula says the load, its derivatives and every sequence of states follow. */
TEST(hertz_has_derivatives_and_steps)
{
#define STEEL                                                                                      \
    "--support halfplane --gap parabola --similar --young 206000 --poisson 0.3 --radius 23.5 "     \
    "--max-pressure 1500 "
    held_json *root = run_json(STEEL "--mu 0 --derivatives=normal_load,hertz_half_width");
    /* with a third body the formula does not hold, not even with a little of one */
    const json_t *without = json_object_get(root, "without_derivatives");
    assert_non_null(strstr(json_string_value(json_object_get(without, "interlayer-normal")),
                           "under --max-pressure Hertz's formula"));
    const json_t *all = json_object_get(root, "derivatives");
    const json_t *load = json_object_get(all, "normal_load");
    const double P = of_summary(root, "normal_load");
    CHECK_REL(number_in(load, "max-pressure"), 2.0 * P / 1500.0, 1e-6, "d ln P/d ln X = 2");
    CHECK_REL(number_in(load, "radius"), P / 23.5, 1e-6, "d ln P/d ln R = 1");
    CHECK_REL(number_in(load, "young"), -P / 206000.0, 1e-6, "d ln P/d ln E = -1");
    assert_int_equal(rollbem("curve " STEEL "--mu 0.3 --points 3 --contact-elements 20 --quiet"),
                     0);
    assert_int_equal(rollbem("wear " STEEL "--mu 0.3 --shift 1e-3 --cycles 1e3 --wear-coefficient "
                             "1e-10 --wear-steps 2 --contact-elements 20 --quiet"),
                     0);
    assert_int_equal(rollbem(STEEL "--mu 0.3 --formulation transient --distance 0.2 --creep 1e-3 "
                                   "--contact-elements 20 --quiet"),
                     0);
}

TEST(doors_and_refusals)
{
    if (shell("\"$R\" " LAYER
              "--poisson 0.3 --max-pressure 20 --contact-elements 20 --json --quiet "
              "--output p.json && \"$R\" check p.json"))
        fail_msg("%s%s", out, err);
    check_refused(LAYER "--max-pressure 20 --load 3", 64, "exclude each other");
    check_refused(LAYER "--max-pressure 20 --half-width 1", 64, "exclude each other");
    check_refused(LAYER "--max-pressure 0", 64, "--max-pressure: expected a number > 0");
    check_refused("curve " LAYER "--mu 0.3 --max-pressure 20", 64, "give --load");
    check_refused(LAYER "--mu 0.3 --max-pressure 20 --error", 64, "error bars only where Hertz");
    check_refused(LAYER "--max-pressure 20 --contact-elements 20 --derivatives", 64,
                  "Hertz's formula says the load; here it is searched for, and another input would "
                  "have another load. At a fixed one: --load ");
    /* the moment of the pressures has rounding errors above what such friction could balance */
    check_refused(
        "--young 17000 --poisson 0.2 --support hub --similar --max-pressure 200 --mu 1e-18 "
        "--formulation steady --free-axle --gap parabola --contact-elements 5",
        1, "max-pressure: its search ended under");
    write_file("loads.txt", "load shift\n100 0\n");
    check_refused(FLAT "--max-pressure 20 --history loads.txt", 64,
                  "the history has a column load");
    FILE *file = NOT_NULL(fopen("corner.txt", "w"));
    fprintf(file, "x gap\n");
    for (int i = -300; i <= 300; i++)
        fprintf(file, "%.10g %.14g\n", 0.01 * i, fmax(0.0, 0.005 * abs(i) - 0.5));
    fclose(file);
    check_refused("--support halfplane --young 2e5 --poisson 0.3 --gap corner.txt --mu 0 "
                  "--max-pressure 500",
                  64, "unbounded at a corner of the gap: give --load");
}

RUN_TESTS(enter_folder, leave_folder)
