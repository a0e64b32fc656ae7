/* A hundred random cases of each ability that has options of its own: bulk stress, waves, the load
 * of a wheel, a stress that cycles on a crack, hardness in the place of a modulus, layers on smooth
 * bases, punches.  tests/checker.c, which shares no code with the library, and `rollbem check`
 * judge each of them; besides each meets what is known without solving it: closed forms, other
 * words for the same case, the case seen in a mirror.  A few of them per run (make test-all:
 * all). */
#include "cli_run.h"
#include "random_case.h"

#include <gsl/gsl_sf_ellint.h>

enum { CASES = 100, TURNS = 25 };

static const double PI = 3.14159265358979323846;
static char checker[700];

/* The k-th case of an ability. */
static random_case begin(int ability, int k)
{
    random_case c = {.state = (uint64_t)(1000 * ability + k + 1) * 0x9e3779b97f4a7c15u};
    return c;
}

static int has(const random_case *c, const char *word)
{
    return strstr(c->line, word) != NULL;
}

/* The result of a command, which checker and certificate find right. */
static json_t *judged(const char *command, const char *line, int has_table)
{
    if (shellf("\"$R\" %s %s --json --quiet > json", command, line) != 0)
        fail_msg("rollbem %s %s: %s", command, line, err);
    json_t *root = NOT_NULL(json_load_file("json", 0, NULL));
    if (has_table && shellf("%s json", checker) != 0)
        fail_msg("rollbem %s %s: %s%s", command, line, out, err);
    if (shellf("\"$R\" check json") != 0)
        fail_msg("rollbem %s %s: %s%s", command, line, out, err);
    return root;
}

static double result(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

/* `now` has these results of `before`, times the sign. */
static void check_same(const json_t *before, const json_t *now, const char *line,
                       const char *const *names, double sign, double bound)
{
    for (; *names; names++) {
        const double x = result(before, *names), y = sign * result(now, *names);
        if (!(fabs(x - y) <= bound * fmax(fabs(x), 1e-6)) && !(isnan(x) && isnan(y)))
            fail_msg("%s: %s is %.12g, and %.12g", line, *names, x, y);
    }
}

static const char *const alike[] = {
    "normal_load", "approach", "max_pressure", "half_width", "dissipation", "stick_length", NULL};
static const char *const turned[] = {"tangential_load", "tilt", NULL};

/* Half-planes with a random radius, modulus and B: the line, and the modulus E* of both. */
static double random_halfplanes(random_case *c, double *strain_a, double *strain_b)
{
    const double young = random_log(c, 1.0, 3e5), nu = random_between(c, 0.0, 0.49),
                 young_b = young * random_log(c, 0.3, 3.0), nu_b = random_between(c, 0.0, 0.49);
    const int similar = random_choice(c, 2);
    random_add(c, "--support halfplane --radius %.8g --young %.15g --poisson %.15g",
               random_log(c, 1.0, 1000.0), young, nu);
    if (similar)
        random_add(c, " --similar");
    else
        random_add(c, " --young-b %.15g --poisson-b %.15g", young_b, nu_b);
    const double f = (1.0 - nu * nu) / young, g = similar ? f : (1.0 - nu_b * nu_b) / young_b;
    if (strain_a)
        *strain_a = f;
    if (strain_b)
        *strain_b = g;
    return 1.0 / (f + g);
}

/* At rest in a mirror, where force and tilt turn round; rolling, by the creepage (U1). */
TEST(bulk_stresses)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(1, k);
        double of_a, of_b;
        const double modulus = random_halfplanes(&c, &of_a, &of_b), mu = random_log(&c, 0.02, 1.0),
                     ratio = random_between(&c, -0.9, 0.9),
                     width = random_log(&c, 1e-4, 1e-2); /* a/R */
        const int steady = random_choice(&c, 2);
        double bulk[2];
        for (int b = 0; b < 2; b++)
            bulk[b] = random_choice(&c, 4)
                          ? mu * 0.5 * modulus * width * random_between(&c, -2.0, 2.0)
                          : 0.0;
        double radius;
        assert_int_equal(sscanf(strstr(c.line, "--radius"), "--radius %lf", &radius), 1);
        random_add(&c, " --gap parabola --mu %.15g --half-width %.15g --contact-elements %d%s", mu,
                   width * radius, 20 + random_choice(&c, 30),
                   steady ? " --formulation steady" : " --formulation static --mesh uniform");
        char line[1700];
#define PULLED "%s --force-ratio %.15g --bulk-stress %.15g --bulk-stress-b %.15g"
        snprintf(line, sizeof line, PULLED, c.line, ratio, bulk[0], bulk[1]);
        held_json *root = judged("", line, 1);
        snprintf(line, sizeof line, PULLED, c.line, steady ? ratio : -ratio, steady ? 0.0 : bulk[0],
                 steady ? 0.0 : bulk[1]);
        held_json *other = judged("", line, 1);
        if (steady) {
            const double strain = bulk[0] * of_a - bulk[1] * of_b;
            CHECK_ABS(result(root, "creepage") - result(other, "creepage"), strain,
                      1e-8 * mu * width, "%s", line);
            check_same(root, other, line, alike, 1.0, 1e-6);
        } else {
            check_same(root, other, line, alike, 1.0, 1e-6);
            check_same(root, other, line, turned, -1.0, 1e-6);
        }
    }
}

/* Westergaard's contact between alike bodies; all of them in a mirror. */
TEST(waves)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(2, k);
        const double modulus = random_halfplanes(&c, NULL, NULL),
                     period = random_log(&c, 0.1, 50.0), steep = random_log(&c, 1e-5, 1e-3),
                     amplitude = steep * period, full = PI * modulus * steep,
                     part = random_between(&c, 0.05, 1.3), ratio = random_between(&c, -0.9, 0.9);
        const int n = 40 + random_choice(&c, 40), is_alike = has(&c, "--similar");
        char line[1700], *radius = strstr(c.line, "--radius"), *behind = strstr(radius, "--young");
        memmove(radius, behind, strlen(behind) + 1); /* a wave has its own */
        random_add(&c,
                   " --gap wave --period %.15g --amplitude %.15g --mu %.15g --load %.15g "
                   "--contact-elements %d",
                   period, amplitude, random_log(&c, 0.02, is_alike ? 1.0 : 0.3),
                   part * full * period, n);
        if (!is_alike && random_choice(&c, 2))
            random_add(&c, " --layer-thickness %.15g --layer-base %s",
                       period * random_log(&c, 0.05, 0.5),
                       random_choice(&c, 2) ? "smooth" : "bonded");
        snprintf(line, sizeof line, "%s --force-ratio %.15g", c.line, ratio);
        held_json *root = judged("", line, 1);
        snprintf(line, sizeof line, "%s --force-ratio %.15g", c.line, -ratio);
        held_json *other = judged("", line, 1);
        check_same(root, other, line, alike, 1.0, 1e-6);
        check_same(root, other, line, turned, -1.0, 1e-6);
        CHECK_REL(result(root, "mean_pressure"), part * full, 1e-9, "%s", line);
        if (!is_alike)
            continue;
        const double half = asin(sqrt(fmin(part, 1.0))),
                     p0 = part < 1.0 ? 2.0 * part * full / sin(half) : full * (1.0 + part);
        CHECK_REL(result(root, "max_pressure"), p0, 0.5 / n, "%s", line);
        CHECK_REL(result(root, "approach"),
                  amplitude * (part < 1.0 ? part * (1.0 - log(part)) : 1.0), 0.3 / n, "%s", line);
    }
}

/* Hertz's ellipse by its integrals, and with the radii exchanged. */
TEST(loads_of_wheels)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(3, k);
        const double modulus = random_halfplanes(&c, NULL, NULL),
                     across = random_log(&c, 0.1, 10.0);
        double radius;
        assert_int_equal(sscanf(strstr(c.line, "--radius"), "--radius %lf", &radius), 1);
        const double second = radius * across, load = modulus * radius * radius *
                                                      fmin(1.0, across * across) *
                                                      random_log(&c, 1e-8, 1e-5);
        const int steady = random_choice(&c, 2);
        random_add(&c, " --mu %.15g --wheel-load %.15g --contact-elements %d",
                   random_log(&c, 0.02, 1.0), load, 20 + random_choice(&c, 20));
        if (steady)
            random_add(&c, " --formulation steady --creep-ratio %.15g --strips %d",
                       random_between(&c, -1.5, 1.5), random_choice(&c, 4));
        else
            random_add(&c, " --formulation static --force-ratio %.15g",
                       random_between(&c, -0.9, 0.9));
        char line[1700], *at = strstr(c.line, "--radius"), *behind = strstr(at, " --young");
        snprintf(line, sizeof line, "%s --transverse-radius %.15g", c.line, second);
        held_json *root = judged("", line, 1);
        snprintf(line, sizeof line, "%.*s--radius %.15g%s --transverse-radius %.15g",
                 (int)(at - c.line), c.line, second, behind, radius);
        held_json *other = judged("", line, 1);
        const double a = result(root, "ellipse_a"), b = result(root, "ellipse_b"),
                     p0 = result(root, "ellipse_pressure");
        CHECK_REL(result(other, "ellipse_a"), b, 1e-10, "%s", line);
        CHECK_REL(result(other, "ellipse_b"), a, 1e-10, "%s", line);
        CHECK_REL(result(other, "ellipse_pressure"), p0, 1e-10, "%s", line);
        CHECK_REL(result(other, "ellipse_approach"), result(root, "ellipse_approach"), 1e-10, "%s",
                  line);
        CHECK_REL(2.0 / 3.0 * PI * a * b * p0, load, 1e-10, "%s", line);
        /* curvatures 1/R = 2 p0/E* times integrals of the ratio (Johnson 4.25) */
        const double s = fmin(a, b), l = fmax(a, b), e = sqrt((1.0 - s / l) * (1.0 + s / l));
        const double K = gsl_sf_ellint_Kcomp(e, GSL_PREC_DOUBLE),
                     E = gsl_sf_ellint_Ecomp(e, GSL_PREC_DOUBLE);
        if (e > 1e-3) {
            const double flat = 2.0 * p0 * s * (K - E) / (modulus * e * e * l * l),
                         steep =
                             2.0 * p0 * s * (E * l * l / (s * s) - K) / (modulus * e * e * l * l);
            CHECK_REL(1.0 / fmin(radius, second), steep, 1e-7, "%s", line);
            CHECK_REL(1.0 / fmax(radius, second), flat, 1e-7, "%s", line);
        }
        CHECK_REL(result(root, "ellipse_approach"), p0 * s * K / modulus, 1e-10, "%s", line);
        CHECK_REL(result(root, "strip_radius"), modulus * a / (2.0 * p0), 1e-10, "%s", line);
        if (steady && has(&c, "--strips 0") && has(&c, "--similar"))
            continue;
        CHECK_REL(result(root, "normal_load"), 0.5 * PI * a * p0, 1e-9, "%s", line);
    }
}

/* Paris's law with the edge crack's K, without a contact. */
TEST(stresses_that_cycle)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(4, k);
        const double low = random_between(&c, -200.0, 150.0),
                     high = low + random_log(&c, 1.0, 300.0), from = random_log(&c, 0.1, 10.0),
                     to = from * random_between(&c, 1.2, 3.0), m = random_between(&c, 2.1, 4.0),
                     C = random_log(&c, 1e-13, 1e-9), range = fmax(high, 0.0) - fmax(low, 0.0);
        random_add(&c,
                   "--support halfplane --young %.15g --poisson %.15g --mu 0 --unloaded "
                   "--crack-angle 90 --crack-length %.15gmm --remote-stress %.15g,%.15g "
                   "--crack-friction %.15g",
                   random_log(&c, 1e3, 3e5), random_between(&c, 0.0, 0.49), from, low, high,
                   random_between(&c, 0.0, 0.5));
        char line[1700];
        snprintf(line, sizeof line, "%s --states", c.line);
        held_json *cycle = judged("crack", line, 0);
        const double K = 1.1215222552 * range * sqrt(PI * from);
        CHECK_ABS(result(cycle, "delta_K_I"), K, 1e-5 * fmax(K, 1.0), "%s", line);
        char grow[900];
        snprintf(grow, sizeof grow,
                 "crack %.600s --grow-to %.15gmm --grow-steps 40 --paris %.15g,%.15g", c.line, to,
                 C, m);
        held_json *root = run_json(grow);
        const json_t *cycles = json_object_get(json_object_get(root, "growth"), "cycles");
        if (!(range > 0.0)) {
            assert_int_equal(json_array_size(cycles), 1);
            continue;
        }
        const double power = 1.0 - 0.5 * m,
                     want = (pow(to, power) - pow(from, power)) /
                            (power * C * pow(1.1215222552 * range * sqrt(PI), m));
        CHECK_REL(json_number_value(json_array_get(cycles, 40)), want, 1e-3, "%s", line);
    }
}

static double by_gent(double s)
{
    return 0.0981 * (56.0 + 7.62336 * s) / (0.137505 * (254.0 - 2.54 * s));
}

/* The reading 100 erf(3.186e-4 sqrt(E/Pa)), by halving. */
static double by_standard(double s)
{
    double low = 0.0, high = 1e4;
    for (int i = 0; i < 200; i++) {
        const double E = 0.5 * (low + high);
        *(100.0 * erf(3.186e-4 * sqrt(1e6 * E)) < s ? &low : &high) = E;
    }
    return low;
}

/* A hardness is the modulus by Gent, with the band of three relations; readings outside are
 * refused. */
TEST(hardness)
{
    static const char *const same[] = {"normal_load",     "approach", "max_pressure", "half_width",
                                       "tangential_load", "creepage", "force_ratio",  NULL};
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(5, k);
        const double s = random_between(&c, 20.0, 90.0), E = by_gent(s),
                     nu = 0.5 - 0.02 * random_choice(&c, 2), radius = random_log(&c, 5.0, 300.0);
        random_add(&c, "--poisson %.15g --radius %.15g --mu %.15g --load %.15g", nu, radius,
                   random_log(&c, 0.02, 1.0), E * radius * random_log(&c, 1e-5, 1e-2));
        if (random_choice(&c, 2))
            random_add(&c, " --support hub --cover-thickness %.15g --outer-elements 100",
                       radius * random_between(&c, 0.05, 0.2));
        else
            random_add(&c, " --support halfplane --layer-thickness %.15g",
                       radius * random_log(&c, 0.02, 0.5));
        random_add(&c, " --formulation steady --force-ratio %.15g --contact-elements %d",
                   random_between(&c, -0.8, 0.8), 16 + random_choice(&c, 16));
        char line[1700];
        snprintf(line, sizeof line, "%s --young %.15gShoreA", c.line, s);
        held_json *root = judged("", line, 1);
        snprintf(line, sizeof line, "%s --young %.17g", c.line, E);
        held_json *other = judged("", line, 1);
        check_same(root, other, line, same, 1.0, 1e-8);
        snprintf(line, sizeof line, "rubber --shore %.15gA --json", s);
        assert_int_equal(rollbem(line), 0);
        held_json *band = NOT_NULL(json_loads(out, 0, NULL));
        const json_t *relations = json_object_get(band, "relations");
        const double want[] = {E, by_standard(s), pow(10.0, 0.0235 * s - 0.6403)};
        for (size_t j = 0; j < 3; j++)
            CHECK_REL(number_in(json_array_get(relations, j), "young"), want[j], 1e-9, "%s", line);
        const double outside =
            random_choice(&c, 2) ? random_between(&c, 0.0, 19.9) : random_between(&c, 90.1, 200.0);
        snprintf(line, sizeof line, "%s --young %.15gShoreA", c.line, outside);
        check_refused(line, 64, "--young");
    }
}

/* Only the friction stretches a layer on a smooth base (L9); at rest in a mirror; without friction
 * and on a rigid base E* says all. */
TEST(smooth_bases)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(6, k);
        const double young = random_log(&c, 1.0, 3e5), nu = random_between(&c, 0.0, 0.5),
                     width = random_log(&c, 1e-3, 3e-2),
                     thickness = width * random_log(&c, 0.2, 10.0),
                     load = 0.25 * PI * young / (1.0 - nu * nu) * width * width * 100.0,
                     ratio = random_between(&c, -0.9, 0.9);
        const int kind = random_choice(&c, 3), soft = random_choice(&c, 2);
        random_add(&c,
                   "--support halfplane --radius 100 --gap parabola --layer-thickness %.15g "
                   "--layer-base smooth --load %.15g --contact-elements %d",
                   100.0 * thickness, load, 24 + random_choice(&c, 24));
        if (soft && kind)
            random_add(&c, " --base-young %.15g --base-poisson 0.25",
                       young * random_log(&c, 0.3, 100.0));
        if (kind && !random_choice(&c, 3))
            random_add(&c, " --young-b %.15g --poisson-b 0.3", young * random_log(&c, 0.3, 10.0));
        char line[1700];
        if (kind == 0) {
            snprintf(line, sizeof line, "%s --mu 0 --young %.17g --poisson %.15g", c.line, young,
                     nu);
            held_json *root = judged("", line, 1);
            snprintf(line, sizeof line, "%s --mu 0 --young %.17g --poisson 0.2", c.line,
                     young / (1.0 - nu * nu) * 0.96);
            held_json *other = judged("", line, 1);
            check_same(root, other, line, alike, 1.0, 1e-7);
            continue;
        }
        random_add(&c, " --young %.15g --poisson %.15g --mu %.15g --formulation %s", young, nu,
                   random_log(&c, 0.02, 0.5), kind == 1 ? "static --mesh uniform" : "steady");
        snprintf(line, sizeof line, "%s --force-ratio %.15g", c.line, ratio);
        held_json *root = judged("", line, 1);
        if (kind == 1) {
            snprintf(line, sizeof line, "%s --force-ratio %.15g", c.line, -ratio);
            held_json *other = judged("", line, 1);
            check_same(root, other, line, alike, 1.0, 1e-6);
            check_same(root, other, line, turned, -1.0, 1e-6);
        } else {
            const double stretch = result(root, "tangential_load") * (1.0 - nu * nu) /
                                   (2.0 * young * 100.0 * thickness);
            CHECK_ABS(result(root, "creepage_ahead") - result(root, "creepage"), stretch,
                      1e-9 * (fabs(stretch) + width), "%s", line);
            CHECK_ABS(result(root, "creepage") - result(root, "creepage_behind"), stretch,
                      1e-9 * (fabs(stretch) + width), "%s", line);
        }
    }
}

/* A flat punch under a moment, without friction in closed form; with it in a mirror. */
TEST(punches)
{
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, TURNS))
            continue;
        random_case c = begin(7, k);
        const double half = random_log(&c, 0.1, 10.0), modulus = random_log(&c, 1.0, 3e5),
                     nu = random_between(&c, 0.0, 0.49),
                     load = modulus * half * random_log(&c, 1e-6, 1e-3),
                     part = random_between(&c, -0.8, 0.8), /* of the moment at which it topples */
            mu = random_choice(&c, 3) ? random_log(&c, 0.02, 0.8) : 0.0;
        const int n = 40 + random_choice(&c, 60);
        char table[200], line[1700];
        snprintf(table, sizeof table, "%.15g 0\n%.15g 0\n0 0\n%.15g 0\n%.15g 0\n", -half,
                 -0.5 * half, 0.5 * half, half);
        write_file("flat.txt", table);
        random_add(&c,
                   "--support halfplane --gap flat.txt --mesh punch --young %.15g --poisson "
                   "%.15g --load %.15g --mu %.15g --contact-elements %d",
                   modulus * (1.0 - nu * nu), nu, load, mu, n);
        const double force = mu > 0.0 ? mu * load * random_between(&c, -0.9, 0.9) : 0.0;
        snprintf(line, sizeof line, "%s --moment %.15g --force %.15g", c.line, part * load * half,
                 force);
        held_json *root = judged("", line, 1);
        snprintf(line, sizeof line, "%s --moment %.15g --force %.15g", c.line, -part * load * half,
                 -force);
        held_json *other = judged("", line, 1);
        check_same(root, other, line, alike, 1.0, 1e-6);
        check_same(root, other, line, turned, -1.0, 1e-6);
        CHECK_REL(result(root, "resistance_moment"), part * load * half, 1e-8, "%s", line);
        if (mu > 0.0)
            continue;
        /* beyond |M| = P a/2 a corner lifts off: M = P (a - l/4), l = 4 P/(pi E* X) */
        const double sign = part < 0.0 ? -1.0 : 1.0,
                     tilt = fabs(part) <= 0.5
                                ? 4.0 * part * load / (PI * modulus * half)
                                : sign * load / (PI * modulus * half * (1.0 - fabs(part)));
        CHECK_REL(result(root, "tilt"), tilt, 10.0 / (n * n), "%s", line);
    }
}

static int enter(void **state)
{
    const int entered = enter_folder(state);
    const char *slash = strrchr(program, '/');
    snprintf(checker, sizeof checker, "%.*s/tests/checker", (int)(slash - program), program);
    return entered;
}

RUN_TESTS(enter, leave_folder)
