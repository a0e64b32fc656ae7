/* Contacts that repeat themselves along the surface (P1): Westergaard's wave and what follows from
 * it, tables, a long period, and what is refused. */
#include "cli_run.h"

#include <math.h>

/* E* = 1, and no coupling; a wave of the length 1 and the amplitude .01. */
#define SOFT "--support halfplane --young 0.75 --poisson 0.5 "
#define WAVE SOFT "--gap wave --period 1 --amplitude 0.01 "
#define D 0.01

static double flattening(void)
{
    return acos(-1.0) * D; /* p* */
}

static double of_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

static double q_of(const json_t *root, size_t i)
{
    return entry(json_object_get(root, "table"), "q_MPa", i);
}

/* p0/p*, 2a/L and delta/D = f (1 - ln f) at f = P/(L p*); the error of p0 falls like n^-3/2. */
TEST(westergaard)
{
    static const double loads[] = {0.2479, 0.5974, 0.9, 1.3};
    const double pi = acos(-1.0), scale = flattening();
    for (size_t k = 0; k < 4; k++) {
        const double f = loads[k], share = f < 1.0 ? 2.0 / pi * asin(sqrt(f)) : 1.0,
                     peak = f < 1.0 ? 2.0 * f / sin(0.5 * pi * share) : f + 1.0,
                     delta = f < 1.0 ? f * (1.0 - log(f)) : 1.0;
        for (int n = 64; n <= 1024; n *= 4) {
            held_json *root = run_jsonf(WAVE "--mu 0 --zone 0.5 --contact-elements %d --load %.15g",
                                        n, f * scale);
            const double h = 1.0 / n;
            CHECK_REL(of_summary(root, "max_pressure"), peak * scale, 1.3 * pow(h, 1.5) + 6e-6,
                      "p0, f = %g, n = %d", f, n);
            CHECK_REL(of_summary(root, "approach"), delta * D, 0.4 * pow(h, 1.5) + 3e-6,
                      "approach, f = %g, n = %d", f, n);
            CHECK_ABS(of_summary(root, "contact_share"), share, 1.2 * h + 1e-9, "f = %g, n = %d", f,
                      n);
            CHECK_REL(of_summary(root, "mean_pressure"), f * scale, 1e-9, "f = %g", f);
        }
        /* in a potential contact that is found, and by the approach */
        held_json *found = run_jsonf(WAVE "--mu 0 --load %.15g", f * scale);
        CHECK_REL(of_summary(found, "max_pressure"), peak * scale, 2e-3, "f = %g", f);
        CHECK_ABS(of_summary(found, "contact_share"), share, 0.02, "f = %g", f);
        CHECK_REL(of_summary(found, "hertz_half_width"), 0.5 * share, 1e-9, "f = %g", f);
        if (f > 1.0)
            continue;
        held_json *given =
            run_jsonf(WAVE "--mu 0 --zone 0.5 --contact-elements 256 --approach %.15g", delta * D);
        CHECK_REL(of_summary(given, "mean_pressure"), f * scale, 5e-3, "approach, f = %g", f);
        held_json *pressed =
            run_jsonf(WAVE "--mu 0 --contact-elements 200 --max-pressure %.15g", peak * scale);
        CHECK_REL(of_summary(pressed, "mean_pressure"), f * scale, 2e-3, "p0, f = %g", f);
    }
}

/* q = mu [p(P) - p(P - Q/mu)], also element by element; in full contact, too. */
TEST(partial_slip)
{
    static const struct {
        double f, r, stick;
    } rows[] = {{0.5974, 0.6, 0.325156}, {1.3, 0.5, 0.596987}, {1.3, 0.1, 1.0}};
    const double mu = 0.3, scale = flattening();
    for (size_t k = 0; k < 3; k++) {
#define FINE WAVE "--zone 0.5 --contact-elements 256 "
        const double f = rows[k].f;
        held_json *root =
            run_jsonf(FINE "--mu %g --load %.15g --force-ratio %g", mu, f * scale, rows[k].r);
        held_json *less = run_jsonf(FINE "--mu 0 --load %.15g", (1.0 - rows[k].r) * f * scale);
        for (size_t i = 0; i < 256; i++)
            CHECK_ABS(q_of(root, i),
                      mu * (entry(json_object_get(root, "table"), "p_MPa", i) -
                            entry(json_object_get(less, "table"), "p_MPa", i)),
                      1e-9 * scale, "element %zu, row %zu", i, k);
        const double stick = of_summary(root, "stick_to") - of_summary(root, "stick_from");
        CHECK_ABS(stick, rows[k].stick, 2.0 / 256, "stick, row %zu", k);
        if (rows[k].r == 0.1) /* all of it sticks, under one friction */
            CHECK_REL(q_of(root, 0), mu * rows[k].r * f * scale, 1e-9, "even");
        if (rows[k].r == 0.5)
            CHECK_REL(q_of(root, 127) / (mu * scale), 0.6876, 1e-3, "q at the crest");
        held_json *steps = run_jsonf(FINE "--mu %g --load %.15g --force-ratio %g --increments 4",
                                     mu, f * scale, rows[k].r);
        CHECK_REL(q_of(steps, 127), q_of(root, 127), 1e-6, "steps, row %zu", k);
    }
}

/* Dundurs' beta .2, mu .2, Q = 0, by a prototype of its own with 512 elements. */
TEST(unlike_bodies)
{
#define COUPLED                                                                                    \
    "--support halfplane --young 0.859375 --poisson 0.375 --gap wave --period 1 --amplitude 0.01 " \
    "--zone 0.5 --contact-elements 512 --mu 0.2 --force 0 --load "
    const double scale = flattening();
    held_json *part = run_jsonf(COUPLED "%.15g", 0.5974 * scale);
    CHECK_ABS(of_summary(part, "contact_share"), 0.555, 3e-3, "contact");
    CHECK_ABS(of_summary(part, "stick_to") - of_summary(part, "stick_from"), 0.246, 4e-3, "stick");
    CHECK_REL(of_summary(part, "max_pressure") / scale, 1.5823, 2e-4, "p0");
    CHECK_REL(of_summary(part, "approach") / D, 0.9002, 2e-4, "approach");
    held_json *full = run_jsonf(COUPLED "%.15g", 1.2 * scale);
    CHECK_REL(of_summary(full, "contact_share"), 1.0, 1e-12, "contact");
    /* around crest and trough, where no friction is: its part of the elements */
    CHECK_ABS(of_summary(full, "stick") / 512.0, 0.484, 4e-3, "stick");
    CHECK_REL(of_summary(full, "max_pressure") / scale, 2.2417, 2e-4, "p0");
}

/* Neighbours far away are none: Hertz's contact, with the datum L/(2 pi). */
TEST(a_long_period)
{
    const double L = 60.0;
#define ALONE                                                                                      \
    "--support halfplane --young 1000 --poisson 0.5 --gap parabola --radius 100 --load 0.5 "       \
    "--mu 0.4 --force-ratio 0.5 --zone 0.4 --contact-elements 80 "
    held_json *many = run_jsonf(ALONE "--period %g", L);
    held_json *one = run_jsonf(ALONE "--datum %.15g", L / (2.0 * acos(-1.0)));
    const double a = of_summary(one, "half_width");
    static const char *const names[] = {"max_pressure", "approach", "tangential_shift",
                                        "half_width", "contact_from"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        CHECK_REL(of_summary(many, names[k]), of_summary(one, names[k]), 10.0 * a * a / (L * L),
                  "%s", names[k]);
}

/* On a layer of the thickness d a wave is flat from p* over L_N(2 pi d/L) on; by another program of
 * 512 elements, nu = 0.3, E* = 1000: mean pressures over that, 2a/L, p0 over that, delta/D. */
TEST(waves_on_layers)
{
    static const struct {
        const char *base;
        double d, LN, part, share, pressure, approach;
    } rows[] = {{"bonded", 0.1, 0.260660, 0.3, 0.461, 0.96115, 0.95808},
                {"bonded", 0.1, 0.260660, 0.7, 0.688, 1.63145, 1.62073},
                {"bonded", 0.3, 0.729991, 0.3, NAN, 1.02388, 0.97829},
                {"bonded", 0.3, 0.729991, 0.7, NAN, 1.65237, 1.68046},
                {"smooth", 0.1, 0.313152, 0.3, NAN, 0.96454, 0.96378},
                {"smooth", 0.1, 0.313152, 0.7, NAN, 1.63316, 1.63519}};
    const double flat = acos(-1.0); /* p* of D = 1e-3 */
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        held_json *root = run_jsonf("--support halfplane --gap wave --period 1 --amplitude 1e-3 "
                                    "--young 910 --poisson 0.3 --mu 0 --layer-thickness %g "
                                    "--layer-base %s --load %.15g --contact-elements 512",
                                    rows[k].d, rows[k].base, rows[k].part * flat / rows[k].LN);
        CHECK_REL(of_summary(root, "max_pressure"), rows[k].pressure * flat / rows[k].LN, 3e-5,
                  "p0 of %zu", k);
        CHECK_ABS(of_summary(root, "approach") * 1e3, rows[k].approach, 1e-5, "delta of %zu", k);
        if (!isnan(rows[k].share))
            CHECK_ABS(of_summary(root, "contact_share"), rows[k].share, 2.0 / 512.0, "2a/L of %zu",
                      k);
    }
}

/* Layers on rigid bases do not feel neighbours from some thicknesses on, pressure, friction and
 * coupling alike; a base of the layer's material makes none of them a layer; equal tractions
 * compress and shear a layer on a rigid base. */
TEST(rows_of_contacts_on_layers)
{
#define ROW                                                                                        \
    "--support halfplane --gap parabola --radius 100 --young 1000 --poisson 0.3 --mu 0.3 "         \
    "--formulation static --mesh uniform --zone 1.3 --contact-elements 60 --load 9 "               \
    "--force-ratio 0.5 "
    static const char *const layers[] = {"--layer-thickness 1",
                                         "--layer-thickness 1 --young-b 2000 --poisson-b 0.4 "
                                         "--layer-thickness-b 2"};
    static const char *const columns[] = {"p_MPa", "q_MPa", "un_mm", "ut_mm"};
    for (int k = 0; k < 3; k++) {
        const int is_base = k > 1;
        held_json *one = is_base ? run_json(ROW "--period 20") : run_jsonf(ROW "%s", layers[k]);
        held_json *many =
            is_base ? run_json(ROW "--layer-thickness 1 --base-young 1000 --base-poisson 0.3 "
                                   "--period 20")
                    : run_jsonf(ROW "%s --period 80", layers[k]);
        const json_t *a = json_object_get(one, "table"), *b = json_object_get(many, "table");
        for (size_t c = 0; c < 4; c++)
            for (size_t i = 0; i < 60; i++)
                CHECK_ABS(entry(b, columns[c], i), entry(a, columns[c], i), c < 2 ? 1e-9 : 1e-12,
                          "%s of %zu, row %d", columns[c], i, k);
    }
    /* all of it pressed: (1 + nu)(1 - 2 nu)/((1 - nu) E) d p and d q/G besides the waves */
    held_json *flat = run_json("--support halfplane --gap wave --period 1 --amplitude 1e-4 --young "
                               "1000 --poisson 0.3 --mu 0.3 --layer-thickness 0.2 --load 10 "
                               "--force 1 --contact-elements 64");
    CHECK_REL(of_summary(flat, "contact_share"), 1.0, 1e-12, "all of it");
    CHECK_REL(of_summary(flat, "approach"), 1e-4 + 0.2 * 10.0 * 1.3 * 0.4 / (0.7 * 1000.0), 1e-6,
              "compressed");
    CHECK_REL(of_summary(flat, "tangential_shift"), -0.2 * 1.0 / (1000.0 / 2.6), 1e-6, "sheared");
    assert_int_equal(rollbem("--support halfplane --gap wave --period 1 --amplitude 1e-4 --young "
                             "1000 --poisson 0.3 --mu 0.3 --layer-thickness 0.2 --approach 1e-3 "
                             "--shift 1e-5 --contact-elements 40 --json > flat.json"),
                     0);
    assert_int_equal(rollbem("check flat.json"), 0);
}

static void write_waves(const char *name, double from, double to, double phase)
{
    FILE *file = NOT_NULL(fopen(name, "w"));
    fprintf(file, "x gap\n");
    for (int i = 0; i <= 400; i++) {
        const double x = from + (to - from) * i / 400.0;
        fprintf(file, "%.12g %.15g\n", x, D * (1.0 - cos(2.0 * acos(-1.0) * (x - phase))));
    }
    fclose(file);
}

/* A table of the wave, of a wave that begins elsewhere, and of two waves. */
TEST(tables)
{
    const double P = 0.5974 * flattening();
#define TABLE SOFT "--mu 0 --contact-elements 256 "
    write_waves("one.txt", -0.5, 0.5, 0.0);
    write_waves("moved.txt", 0.0, 1.0, 0.3);
    write_waves("two.txt", -1.0, 1.0, 0.5);
    held_json *wave = run_jsonf(WAVE "--mu 0 --contact-elements 256 --zone 0.5 --load %.15g", P);
    held_json *one = run_jsonf(TABLE "--zone 0.5 --gap one.txt --period 1 --load %.15g", P);
    held_json *moved = run_jsonf(TABLE "--gap moved.txt --period 1 --load %.15g", P);
    held_json *two = run_jsonf(SOFT "--mu 0 --contact-elements 512 --zone 1 --gap two.txt "
                                    "--period 2 --load %.15g",
                               2.0 * P);
    const json_t *const all[] = {one, moved, two};
    static const double bounds[] = {1e-6, 1e-3, 1e-6};
    for (size_t k = 0; k < 3; k++) {
        CHECK_REL(of_summary(all[k], "max_pressure"), of_summary(wave, "max_pressure"), bounds[k],
                  "table %zu", k);
        CHECK_REL(of_summary(all[k], "approach"), of_summary(wave, "approach"), bounds[k],
                  "table %zu", k);
        CHECK_ABS(of_summary(all[k], "contact_share"), of_summary(wave, "contact_share"), 6e-3,
                  "table %zu", k);
    }
    CHECK_ABS(0.5 * (of_summary(moved, "contact_from") + of_summary(moved, "contact_to")), 0.3,
              1e-3, "its crest");
    assert_int_equal(json_array_size(json_object_get(json_object_get(two, "summary"), "patches")),
                     2);
}

/* A history loads and unloads, also parabolas; the document is checked. */
TEST(histories_and_check)
{
    write_file("up.txt", "load force_ratio\n0.01 0\n0.03 0\n0.05 0\n0.0187 0\n");
    held_json *path = run_json(WAVE "--mu 0.3 --zone 0.5 --contact-elements 64 --history up.txt");
    held_json *once = run_json(WAVE "--mu 0.3 --zone 0.5 --contact-elements 64 --load 0.0187");
    CHECK_REL(of_summary(path, "max_pressure"), of_summary(once, "max_pressure"), 1e-9, "p0");
    assert_int_equal(rollbem(WAVE "--mu 0.3 --load 0.0187 --force-ratio 0.6 --json > wave.json"),
                     0);
    assert_int_equal(rollbem("check wave.json"), 0);
    assert_int_equal(
        rollbem(WAVE "--mu 0.3 --load 0.04 --force-ratio 0.6 --prove --json > flat.json"), 0);
    assert_int_equal(rollbem("check flat.json"), 0);
    write_file("down.txt", "load shift\n200 1e-3\n400 2e-3\n");
    assert_int_equal(
        rollbem("--support halfplane --formulation static --gap parabola --period 30 "
                "--contact-elements 15 --history down.txt --states --json > down.json"),
        0);
    assert_int_equal(rollbem("check down.json"), 0);
}

/* Equal friction everywhere moves nothing: where all sticks the force is given, 0 by itself. */
TEST(all_of_a_period_sticks)
{
    static const char *const bodies[] = {WAVE "--mu 0.3", WAVE "--mu 0.9 --poisson 0.3",
                                         WAVE "--mu 0.3 --similar"};
    char line[256];
    for (size_t k = 0; k < sizeof bodies / sizeof *bodies; k++) {
        held_json *root = run_jsonf("%s --load 1 --contact-elements 64", bodies[k]);
        CHECK_ABS(of_summary(root, "tangential_load"), 0.0, 1e-12, "%s", bodies[k]);
        snprintf(line, sizeof line, "%s --load 1 --contact-elements 64 --shift 0", bodies[k]);
        assert_int_equal(rollbem(line), 1);
        assert_non_null(strstr(err, "does not follow from the shift"));
    }
}

TEST(what_is_refused)
{
    static const struct {
        const char *line, *why;
    } rows[] = {
        {SOFT "--gap wave --load 1", "--gap: a wave needs --period and --amplitude"},
        {WAVE, "--gap: a wave needs --load, --approach or --max-pressure"},
        {WAVE "--load 1 --zone 900", "--zone: 900 mm is more than half the period, "},
        {WAVE "--load 1 --radius 5", "that of a wave's crest follows from"},
        {WAVE "--similar --radius-b 5 --load 1", "a wave lies on a plane"},
        {SOFT "--gap parabola --amplitude 1 --load 1", "amplitude: that of a wave"},
        {WAVE "--approach 0.01", "nothing is open, and only --load tells more"},
        {WAVE "--half-width 0.1", "half-width: not with a period"},
        {WAVE "--load 1 --formulation steady", "period: it needs bodies at rest"},
        {"--support halfplane --gap wave --period 1 --amplitude 0.01 --load 1 --layers stack.txt",
         "period: it needs half-planes of one elastic material, or"},
        {WAVE "--load 1e-3 --layer-thickness 9e-4",
         "layer-thickness: with a period: a layer of a thousandth"},
        {WAVE "--load 1 --datum 1", "datum: not with a period"},
        {WAVE "--load 1 --tilt 0.1", "tilt: not with a period"},
        {WAVE "--load 1 --bulk-stress 0.1", "bulk-stress: not with a period"},
        {WAVE "--load 1 --mesh fitted", "mesh: not with a period"},
        {WAVE "--load 1 --derivatives=approach", "derivatives: with a period not known"},
        {SOFT "--gap parabola --radius 1 --period 2 --load 1", "stand that close only up to"},
        {SOFT "--radius 10 --period 2 --load 1", "needs --gap parabola, wave"},
        {SOFT "--gap open.txt --period 2 --load 1", "must end as it begins"},
        {SOFT "--gap open.txt --period 1 --load 1", "must be one period long"}};
    write_file("stack.txt", "0.1 1000 0.3\n0.2 500 0.3\n");
    write_file("open.txt", "x gap\n-1 1\n-0.5 0.25\n0 0\n0.5 0.25\n1 1.5\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        check_refused(rows[k].line, 64, rows[k].why);
    check_refused("stress " WAVE "--load 0.02", 64, "below contacts that repeat themselves");
    check_refused("crack " WAVE "--load 0.02", 64, "one contact alone");
    check_refused("wear " WAVE "--load 0.02 --slide 1", 64, "wear is that of one contact alone");
}

RUN_TESTS(enter_folder, leave_folder)
