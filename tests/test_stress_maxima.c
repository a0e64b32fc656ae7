/* The largest stresses: the tension behind a sliding contact, stresses at bonds and inside
 * wheels, and the search against a dense scan of the program's own points. */
#include "cases.h"
#include "cli_run.h"
#include "random_case.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* ---- The tension at the edge ------------------------------------------------------- */

#define STEEL                                                                                      \
    "--similar --support halfplane --gap parabola --young 210000 --poisson 0.3 --radius 1000 "

static double largest(const json_t *root, const char *name, const char *of)
{
    return number_in(json_object_get(json_object_get(root, "maxima"), name), of);
}

/* 2 mu p0 in full sliding, and in partial slip times sqrt(Q/(mu P)), behind the contact, by
 * Hertz's p0: within a thousandth on all meshes. */
TEST(the_tension_behind_a_contact_is_2_mu_p0)
{
    static const char *const meshes[] = {"uniform", "aligned", "fitted", "uniform --zone 1.31"};
    static const int elements[] = {50, 160};
    for (int m = 0; m < 4; m++)
        for (int k = 0; k < 2; k++)
            for (int slides = 0; slides < 2; slides++) {
                char line[400];
                if (!is_in_turn(m + 2 * k + slides, 4))
                    continue;
                snprintf(line, sizeof line,
                         "stress " STEEL "--half-width 1 --grid 2x2 --mesh %s "
                         "--contact-elements %d %s",
                         meshes[m], elements[k],
                         slides ? "--formulation steady --mu 0.3333333333333333 --creep-ratio 5"
                                : "--formulation static --mu 0.5 --force-ratio 0.6");
                held_json *root = run_json(line);
                const double p0 =
                    2.0 * number_in(json_object_get(root, "summary"), "normal_load") / M_PI;
                CHECK_REL(largest(root, "tension", "value") / p0, slides ? 2.0 / 3.0 : sqrt(0.6),
                          1e-3, "%s", line);
                CHECK_ABS(largest(root, "tension", "x"), slides ? 1.0 : -1.0, 2e-3, "%s", line);
            }
}

/* Mindlin and Deresiewicz: after a reversal it is 2 mu p0 (sqrt(q) - 2 sqrt(dq/2)). */
TEST(reversed_friction_leaves_its_tension)
{
    static const struct {
        double to, want;
    } rows[] = {{0.6, 0.774597}, {0.0, 0.320848}, {-0.3, 0.567044}};
    const double P = M_PI * 210000.0 / 2.0 / 0.91 / 4000.0, p0 = 2.0 * P / M_PI;
    for (int k = 0; k < 3; k++) {
        char text[300];
        snprintf(text, sizeof text, "load force\n%.15g 0\n%.15g %.15g\n%.15g %.15g\n", P, P,
                 0.3 * P, P, 0.5 * rows[k].to * P);
        write_file("reversal.txt", text);
        held_json *root = run_json("stress " STEEL "--mu 0.5 --formulation static --history "
                                   "reversal.txt --contact-elements 100 --grid 2x2");
        CHECK_REL(largest(root, "tension", "value") / p0, rows[k].want, 1e-3, "back to %g",
                  rows[k].to);
    }
}

/* A wheel's edge has the half-plane's. */
TEST(a_wheel_slides_as_a_half_plane)
{
    held_json *root = run_json("stress --similar --support hub --support-b halfplane --gap "
                               "parabola --young 2500 --poisson 0.3 --radius 50 --half-width "
                               "0.05 --mu 0.3 --formulation steady --creep 0.01 "
                               "--contact-elements 50 --grid 2x2");
    const double p0 = number_in(json_object_get(root, "summary"), "max_pressure");
    CHECK_REL(largest(root, "tension", "value"), 0.6 * p0, 2e-3, "2 mu p0");
}

/* (B20) So does a cover; and where contact elements are longer than a sleeve is thick its stress is
 * that on shorter ones, and no element far away has more. */
TEST(covers_have_no_elements_around_them)
{
    if (is_in_turn(0, 3)) {
        held_json *root = run_json(
            "stress --young-b 2500 --poisson-b 0.3 --support hub --support-b halfplane --gap "
            "parabola --young 2500 --poisson 0.3 --radius 50 --half-width 0.05 --mu 0.3 "
            "--formulation steady --creep 0.01 --contact-elements 50 --cover-thickness 10 "
            "--core-young 2500 --core-poisson 0.3 --grid 2x2");
        CHECK_REL(largest(root, "tension", "value"),
                  0.6 * number_in(json_object_get(root, "summary"), "max_pressure"), 5e-3,
                  "2 mu p0");
    }
    static const struct {
        const char *elements;
        double most;
    } meshes[] = {{"40 --outer-elements 300", 0.05}, {"60", 0.01}, {"160", 1e-4}};
    for (int k = 0; k < 3; k++) {
        char line[400];
        if (!is_in_turn(k, 3))
            continue;
        snprintf(line, sizeof line,
                 "stress --support hub --cover-thickness 0.15 --radius 100 --young 5000 --poisson "
                 "0.45 --core-young 100 --core-poisson 0.3 --hub-ratio 0.5 --gap parabola --load "
                 "5 --mu 0 --grid 2x2 --contact-elements %s",
                 meshes[k].elements);
        held_json *sleeve = run_json(line);
        CHECK_REL(largest(sleeve, "tension", "value"), 0.75516, meshes[k].most, "%s", line);
        CHECK_MAX(fabs(largest(sleeve, "tension", "x")), 4.0, "%s", line);
    }
}

/* Below a sleeve that bends the pressure rises towards its edge and falls off within two elements:
 * the nodes there carry the load of the elements, and no parabola that has 2 % more of P. */
TEST(nodes_at_an_edge_carry_its_load)
{
    static const int elements[] = {60, 100, 240};
    for (int k = 0; k < 3; k++) {
        char line[400];
        if (!is_in_turn(k, 3))
            continue;
        snprintf(line, sizeof line,
                 "stress --support hub --cover-thickness 0.15 --radius 100 --young 5000 --poisson "
                 "0.45 --core-young 100 --core-poisson 0.3 --hub-ratio 0.5 --gap parabola --load "
                 "1.4 --mu 0 --grid 2x2 --contact-elements %d",
                 elements[k]);
        held_json *root = run_json(line);
        CHECK_REL(largest(root, "von_mises", "value"), 5.8500, 5e-4, "%s", line);
        CHECK_REL(largest(root, "tension", "value"), 2.170, 1e-3, "%s", line);
    }
}

/* ---- Values and places ------------------------------------------------------------- */

#define FLAT "--support halfplane --gap parabola --mu 0 "

/* A film on a soft base bends, and pulls at the bond; a disc between two loads is pulled
 * apart, 2 P/(pi D) on its axis; a thin film has the strain of its base. */
TEST(maxima_lie_where_they_are)
{
    static const struct {
        const char *line, *name;
        double want, tolerance, depth;
        const char *material;
    } rows[] = {
        {FLAT "--young 1e5 --poisson 0.3 --radius 20 --layer-thickness 1 --base-young 1000 "
              "--base-poisson 0.3 --load 10",
         "tension", 46.56, 1e-3, 1.0, "layer"},
        {FLAT "--young 70GPa --poisson 0.17 --radius 100 --layer-thickness 0.15 --base-young "
              "2.4GPa --base-poisson 0.37 --load 21.84",
         "tension", 24.58, 1e-3, 0.15, "layer"},
        {FLAT "--young 5000 --poisson 0.45 --radius 100 --layer-thickness 0.15 --base-young 100 "
              "--base-poisson 0.3 --load 1.4",
         "tension", 1.8393, 1e-3, 0.15, "layer"},
        {FLAT "--young 440GPa --poisson 0.25 --radius 10 --layer-thickness 0.5um --base-young "
              "210GPa --base-poisson 0.3 --load 100",
         "compression", 1272.17, 2e-4, 0.0, "layer"},
        {FLAT "--young 440GPa --poisson 0.25 --radius 10 --layer-thickness 0.5um --base-young "
              "210GPa --base-poisson 0.3 --load 100",
         "max_shear", 0.30028 * 858.25, 2e-3, 0.0582, "base"},
        {"--support arc --arc 1 --young 210000 --poisson 0.3 --radius 50 --gap parabola --load "
         "1000 --mu 0 --contact-elements 30",
         "tension", 2000.0 / M_PI / 100.0, 5e-3, -1.0, "body"},
        {"--support hub --hub-ratio 0.5 --young 210000 --poisson 0.3 --radius 50 --gap parabola "
         "--load 1000 --mu 0 --contact-elements 60 --outer-elements 400",
         "tension", 12.8755, 1e-3, 3.75, "body"}, /* Michell's series on a held bore */
        /* stiff sleeves on a soft core: Michell's series of both rings under the pressures of the
         * contact, of the first one to m = 30000 */
        {"--support hub --cover-thickness 0.15 --radius 100 --young 5000 --poisson 0.45 "
         "--core-young 100 --core-poisson 0.3 --hub-ratio 0.5 --gap parabola --load 1.4 --mu 0 "
         "--contact-elements 40",
         "tension", 2.166, 3e-3, 0.1523, "layer"},
        {"--support hub --cover-thickness 0.5 --radius 100 --young 5000 --poisson 0.45 "
         "--core-young 100 --core-poisson 0.3 --hub-ratio 0.5 --gap parabola --load 1.4 --mu 0 "
         "--contact-elements 60",
         "tension", 9.5959, 4e-3, 0.5, "layer"},
        {"--support hub --cover-thickness 2 --radius 100 --young 5000 --poisson 0.45 "
         "--core-young 100 --core-poisson 0.3 --hub-ratio 0.5 --gap parabola --load 1.4 --mu 0 "
         "--contact-elements 60",
         "tension", 2.6445, 2e-4, 2.0, "layer"},
        /* a cover of its core's material is the wheel on a held bore */
        {"--support hub --hub-ratio 0.5 --young 210000 --poisson 0.3 --radius 50 --gap parabola "
         "--load 1000 --mu 0 --contact-elements 60 --cover-thickness 10 --core-young 210000 "
         "--core-poisson 0.3",
         "tension", 12.8755, 2e-3, 3.75, "layer"},
        /* Smith and Liu: at the surface, nu = 1/4; a thin disc, whose third stress is 0 */
        {"--similar --support halfplane --gap parabola --young 210000 --poisson 0.25 --radius "
         "1000 --half-width 1 --mu 0.333333333333 --formulation steady --creep-ratio 5",
         "tresca_shear", 0.43 * 56.0, 2e-3, 0.0, "body"},
        {"--similar --support halfplane --gap parabola --young 210000 --poisson 0.25 --radius "
         "1000 --half-width 1 --mu 0.333333333333 --formulation steady --creep-ratio 5",
         "max_shear", 0.357 * 56.0, 2e-3, -1.0, "body"},
        {"--similar --support halfplane --gap parabola --young 210000 --poisson 0.25 --radius "
         "1000 --half-width 1 --mu 0 --plane stress",
         "tresca_shear", 0.5 * 52.5, 1e-3, 0.0, "body"},
    };
    json_t *root = NULL;
    int line_of = 0;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (k == 0 || strcmp(rows[k].line, rows[k - 1].line) != 0) {
            char line[600];
            snprintf(line, sizeof line, "stress %s --grid 2x2", rows[k].line);
            json_decref(root);
            root = is_in_turn(line_of++, 4) ? run_json(line) : NULL;
        }
        if (!root)
            continue;
        const json_t *one = json_object_get(json_object_get(root, "maxima"), rows[k].name);
        CHECK_REL(number_in(one, "value"), rows[k].want, rows[k].tolerance, "%s: %s", rows[k].line,
                  rows[k].name);
        if (rows[k].depth >= 0.0)
            CHECK_ABS(number_in(one, "y"), rows[k].depth, 0.02 * rows[k].depth + 1e-9,
                      "%s: depth of %s", rows[k].line, rows[k].name);
        assert_string_equal(json_string_value(json_object_get(one, "material")), rows[k].material);
    }
    json_decref(root);
}

/* Both sides of a bond have the same place, and the base's is printed as such: its digits
 * are checked, and in other units it has the same value. */
TEST(a_bond_has_two_sides_in_any_unit)
{
#define STIFF_BASE                                                                                 \
    "stress --support halfplane --gap parabola --mu 0.5 --formulation steady --creep 0.2 "         \
    "--young 2GPa --poisson 0.45 --radius 100mm --layer-thickness 0.5mm "                          \
    "--base-young 200GPa --base-poisson 0.3 --load 5kN/mm --contact-elements 30 --grid 2x2 "
    if (shell("\"$R\" " STIFF_BASE "--json --quiet --output bond.json && \"$R\" check bond.json"))
        fail_msg("%s%s", out, err);
    held_json *mm = NOT_NULL(json_load_file("bond.json", 0, NULL));
    held_json *si = run_json(STIFF_BASE "--units si");
    const json_t *one = json_object_get(json_object_get(mm, "maxima"), "tension"),
                 *other = json_object_get(json_object_get(si, "maxima"), "tension");
    assert_string_equal(json_string_value(json_object_get(one, "material")), "base");
    assert_string_equal(json_string_value(json_object_get(other, "material")), "base");
    CHECK_ABS(number_in(one, "y"), 0.5, 1e-9, "at the bond");
    CHECK_REL(number_in(other, "value"), 1e6 * number_in(one, "value"), 1e-9, "in Pa");
}

/* ---- Against a dense scan ---------------------------------------------------------- */

static rb_rolling_extremum *maximum_of(rb_rolling_stress_maxima *m, int k)
{
    return rb_rolling_maximum(m, k);
}

static double measured(const rb_rolling_stress *s, int k)
{
    const double values[] = {s->max_shear, s->tresca_shear, s->von_mises,
                             fabs(s->sxy), s->principal_1,  -s->principal_2};
    return values[k];
}

/* Half of them coatings, the others wheels. */
static void draw(random_case *c, int k)
{
    c->state = (uint64_t)k;
    c->line[0] = '\0';
    const double young = random_log(c, 1e2, 5e5), ratio = random_log(c, 0.01, 100.0);
    random_add(c, "gap parabola young %g poisson %g radius 100 mu %g contact-elements %d ", young,
               random_between(c, 0.0, 0.48), k % 4 < 2 ? 0.0 : random_between(c, 0.05, 0.8),
               20 + random_choice(c, 50));
    if (k % 4 >= 2)
        random_add(c, "formulation steady creep %g ", random_log(c, 1e-4, 1e-1));
    if (k % 2 == 0) {
        /* the load that makes a film of the base's modulus touch over about a */
        const double a = random_log(c, 0.1, 5.0), film = a * random_log(c, 0.02, 10.0);
        const double modulus = film > a ? young : young / ratio;
        random_add(c, "support halfplane layer-thickness %g load %g ", film,
                   M_PI * modulus * a * a / 400.0);
        if (random_choice(c, 4))
            random_add(c, "base-young %g base-poisson %g ", young / ratio,
                       random_between(c, 0.0, 0.48));
        return;
    }
    random_add(c, "load %g ", M_PI * young * 0.01 * random_log(c, 0.05, 2.0) / 4.0);
    const int kind = random_choice(c, 4);
    if (kind == 0)
        random_add(c, "support arc arc %g ", random_log(c, 2.0, 60.0));
    else if (kind == 1)
        random_add(c, "support hub hub-ratio %g ", random_between(c, 0.1, 0.9));
    else
        random_add(c, "support hub hub-ratio 0.5 cover-thickness %g ", random_log(c, 2.0, 40.0));
    if (kind == 3)
        random_add(c, "core-young %g core-poisson 0.3 ", young * random_log(c, 0.1, 10.0));
}

/* Points of a dense scan: on the surface, on both sides of the bond, and between, out to
 * several widths of what is loaded; of a wheel all around. */
static int scan(const rb_rolling_model *model, double *xy, int most)
{
    enum { ALONG = 110, DOWN = 18 };
    const rb_rolling_body *a = &model->rc->a;
    const int is_flat = rb_rolling_body_can(a, RB_BODY_FLAT);
    double from, to;
    rb_rolling_contact_edges(model->rc, &model->mesh, &model->state, &from, &to);
    const double w = to - from, R = a->radius;
    const double inner = a->cover > 0.0             ? R - a->cover
                         : a->support == RB_BEM_HUB ? a->hub_ratio * R
                                                    : 0.0;
    const double height = !is_flat ? R - inner : a->layer > 0.0 ? a->layer : 3.0 * w;
    const double widest = is_flat ? 4.0 * w + 4.0 * a->layer : M_PI * R;
    int n = 0;
    for (int i = 0; i <= 2 * ALONG; i++) {
        /* even under the contact, growing outside */
        const double u = (double)(i - ALONG) / ALONG,
                     s = 0.5 * (from + to) +
                         copysign(fabs(u) < 0.5
                                      ? 1.2 * w * fabs(u)
                                      : 0.6 * w * pow(widest / (0.6 * w), 2.0 * fabs(u) - 1.0),
                                  u);
        for (int j = 0; j <= DOWN; j++) {
            double depth = height * pow((double)j / DOWN, 2.0);
            for (int side = 0; side < 1 + (is_flat && a->base_young > 0.0); side++) {
                if (side)
                    depth = fmax(height + 2.0 * w * pow((double)j / DOWN, 2.0),
                                 nextafter(height, INFINITY));
                assert_true(n < most);
                const double angle = s / R;
                xy[2 * n] = is_flat ? s : (R - depth) * sin(angle);
                xy[2 * n + 1] = is_flat ? depth : R - (R - depth) * cos(angle);
                /* next to the ends of a clamped arc the stress is infinite */
                const double end = M_PI - a->arc * M_PI / 180.0;
                if (a->support == RB_BEM_ARC &&
                    fmin(hypot(xy[2 * n] - R * sin(end), xy[2 * n + 1] - R + R * cos(end)),
                         hypot(xy[2 * n] + R * sin(end), xy[2 * n + 1] - R + R * cos(end))) <
                        0.3 * R)
                    continue;
                n++;
            }
        }
    }
    return n;
}

static void compare(int k)
{
    enum { MOST = 30000 };
    static double xy[2 * MOST];
    static rb_rolling_stress at[MOST];
    static int inside[MOST];
    random_case c;
    draw(&c, k);
    rb_rolling_case rc = rolling_case("%s", c.line);
    rb_rolling_model model;
    if (rb_rolling_model_create(&rc, &model, &message) != RB_OK)
        return; /* options that do not go together */
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, &message));
    int n = scan(&model, xy, MOST), kept = 0;
    CHECK_OK(rb_rolling_inside(&model, n, xy, inside));
    for (int i = 0; i < n; i++)
        if (inside[i]) {
            xy[2 * kept] = xy[2 * i];
            xy[2 * kept++ + 1] = xy[2 * i + 1];
        }
    CHECK_OK(rb_rolling_stress_at(&model, kept, xy, at, &message));
    /* behind them are those of the bond */
    for (int j = 0; j < rb_rolling_maxima_scalars.n / 3; j++) {
        int best = 0;
        for (int i = 0; i < kept; i++)
            best = measured(&at[i], j) > measured(&at[best], j) ? i : best;
        const double found = maximum_of(&m, j)->value, sampled = measured(&at[best], j);
        const double p0 = rb_rolling_peak_pressure(&model);
        if (!(found >= sampled - 1e-3 * fabs(sampled) - 1e-6 * p0))
            fail_msg("case %d, %s: %s = %g at (%g, %g), but %g at (%g, %g); p0 = %g", k, c.line,
                     rb_rolling_maxima_scalars.row[3 * j].name, found, maximum_of(&m, j)->x,
                     maximum_of(&m, j)->y, sampled, at[best].x, at[best].y, p0);
    }
    for (int i = 0; i < kept && rc.a.layer > 0.0; i++) {
        const double least = 1e-6 * rb_rolling_peak_pressure(&model);
        if (at[i].y != rc.a.layer)
            continue;
        CHECK_MAX(fabs(at[i].sxy) * (1.0 - 1e-3), m.bond[0].shear.value + least,
                  "case %d, %s: shear at the bond", k, c.line);
        CHECK_MAX(isnan(m.bond[0].peel.x) ? 0.0 : at[i].syy * (1.0 - 1e-3),
                  m.bond[0].peel.value + least, "case %d, %s: peel", k, c.line);
        CHECK_MAX(isnan(m.bond[0].tension_above.x) ? 0.0 : at[i].sxx * (1.0 - 1e-3),
                  m.bond[0].tension_above.value + least, "case %d, %s: tension above", k, c.line);
    }
    rb_rolling_model_free(&model);
}

TEST(no_point_of_a_scan_has_more)
{
    for (int k = 0; k < 500; k++)
        if (is_in_turn(k, 160))
            compare(k);
}

/* A tension far behind the contact, where friction stretches a stiff film on a soft base, and two
 * nearly equal ones on the axis of a wheel: below its contact on a ridge that is narrower than the
 * points are apart there. */
TEST(peaks_that_were_once_missed)
{
    static const int seeds[] = {318, 361};
    for (int k = 0; k < 2; k++)
        if (is_in_turn(k, 2))
            compare(seeds[k]);
}

/* ---- Bonds ------------------------------------------------------------------------- */

/* A layer of the base's material: Hertz's stress at its depth, and behind full sliding a little
 * peel; a coating; B is the exchanged A. */
TEST(bonds_have_peel_shear_and_tension)
{
#define ALIKE                                                                                      \
    "--similar --young 210000 --poisson 0.3 --radius 1000 --half-width 1 --base-young 210000 "     \
    "--base-poisson 0.3 --contact-elements 200 --mesh fitted "
    static const struct {
        const char *line, *name;
        double value, x, tolerance, x_tolerance; /* value over p0 where below 1; NAN x: none */
    } rows[] = {{ALIKE "--mu 0 --layer-thickness 0.5", "bond_1_shear", 0.25, 0.8660, 1e-3, 1e-3},
                {ALIKE "--mu 0 --layer-thickness 0.5", "bond_1_peel", 0.0, NAN, 0.0, 0.0},
                {ALIKE "--mu 0 --layer-thickness 0.75", "bond_1_shear", 0.2390, 0.8899, 1e-3, 1e-3},
                {ALIKE "--mu 0 --layer-thickness 1", "bond_1_shear", 0.21796, 0.9502, 1e-3, 1e-3},
                {ALIKE "--mu 0.3 --formulation steady --creep -1 --layer-thickness 0.5",
                 "bond_1_shear", 0.33971, 0.8660, 1e-3, 1e-3},
                {ALIKE "--mu 0.3 --formulation steady --creep -1 --layer-thickness 0.5",
                 "bond_1_peel", 0.00125, -2.690, 5e-3, 5e-3},
                {ALIKE "--mu 0.3 --formulation steady --creep -1 --layer-thickness 0.5 --body b "
                       "--layer-thickness-b 0.5 --base-young-b 210000 --base-poisson-b 0.3",
                 "bond_1_peel", 0.00125, 2.690, 5e-3, 5e-3},
                {FLAT
                 "--young 70GPa --poisson 0.17 --radius 100 --layer-thickness 0.15 --base-young "
                 "2.4GPa --base-poisson 0.37 --load 21.84 --contact-elements 200 --mesh fitted",
                 "bond_1_tension_above", 24.447, 0.5126, 1e-3, 2e-3}};
    json_t *root = NULL;
    int line_of = 0;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char line[700];
        snprintf(line, sizeof line, "stress --support halfplane --gap parabola %s --grid 2x2",
                 rows[k].line);
        if (k == 0 || strcmp(rows[k].line, rows[k - 1].line) != 0) {
            json_decref(root);
            root = is_in_turn(line_of++, 2) ? run_json(line) : NULL;
        }
        if (!root)
            continue;
        const json_t *most = json_object_get(json_object_get(root, "maxima"), rows[k].name);
        const double p0 = number_in(json_object_get(root, "summary"), "max_pressure"),
                     value = number_in(most, "value");
        CHECK_ABS(value / (rows[k].value < 1.0 ? p0 : 1.0), rows[k].value,
                  rows[k].tolerance * rows[k].value, "%s: %s", line, rows[k].name);
        if (isnan(rows[k].x))
            assert_true(json_is_null(json_object_get(most, "x")));
        else
            CHECK_ABS(number_in(most, "x"), rows[k].x, rows[k].x_tolerance * fabs(rows[k].x), "%s",
                      line);
    }
    json_decref(root);
}

/* Its certificate; a rigid base has one side; without a bond there is nothing to tell; a cover has
 * the directions of its circle: under equal pressure all around they would show no shear. */
TEST(bonds_go_through_the_doors)
{
    static const struct {
        const char *line, *has, *has_not;
    } rows[] = {
        {"--support halfplane --gap parabola --layer-thickness 1 --mu 0.2 --force-ratio 0.5 "
         "--load 10 --young 1000 --radius 50",
         "bond_1_tension_above", "bond_1_tension_below"},
        {"--support halfplane --gap parabola --similar --mu 0.2 --load 10", "compression",
         "bond_1"},
        {"--support halfplane --gap parabola --layer-thickness 1 --base-young 1e4 "
         "--base-poisson 0.3 --depth 0.5 --load 10 --young 1000 --radius 50",
         "compression", "bond_1"},
        {"--support hub --radius 50 --cover-thickness 5 --young 10 --poisson 0.45 --load 1 "
         "--mu 0.5 --contact-elements 20",
         "bond_1_shear", "bond_1_tension_below"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char line[700];
        snprintf(line, sizeof line,
                 "\"$R\" stress %s --grid 3x3 --json --quiet --output b.json && "
                 "\"$R\" check b.json && cat b.json",
                 rows[k].line);
        if (shell(line))
            fail_msg("%s: %s%s", rows[k].line, out, err);
        assert_non_null(strstr(out, rows[k].has));
        assert_null(strstr(out, rows[k].has_not));
    }
}

RUN_TESTS(enter_folder, leave_folder)
