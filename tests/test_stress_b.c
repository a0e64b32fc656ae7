/* The stress in body B: exchanged bodies, with the signs turned, have each other's stress; values
 * of closed tractions; and every door. */
#include "cases.h"
#include "cli_run.h"
#include "random_case.h"
#include "solved.h"

#include <gsl/gsl_math.h>
#include <jansson.h>

HELD_TYPE(rb_rolling_mirror, rb_rolling_mirror_free)
#define held_mirror HELD(rb_rolling_mirror)

/* ---- Exchange ---------------------------------------------------------------------- */

/* One body, by its number of a random case; of: "" or "-b". */
static void add_body(random_case *c, int number, const char *of)
{
    random_case own = {.state = c->state + 977u * (uint64_t)number, .line = ""};
    const int kind = random_choice(&own, 8);
    const double young = random_log(&own, 1e3, 2e5), nu = random_between(&own, 0.0, 0.48),
                 thick = random_log(&own, 0.2, 3.0);
    random_add(c, "young%s %g poisson%s %g radius%s %g ", of, young, of, nu, of,
               random_between(&own, 80.0, 160.0));
    random_add(c, "support%s %s ", of, kind == 0 ? "arc" : kind <= 2 ? "hub" : "halfplane");
    if (kind == 2)
        random_add(c, "hub-ratio%s 0.5 cover-thickness%s %g ", of, of, 10.0 * thick);
    if (kind == 3 || kind == 4)
        random_add(c, "layer-thickness%s %g ", of, thick);
    if (kind == 4)
        random_add(c, "base-young%s %g base-poisson%s 0.3 ", of, young * random_log(&own, 0.2, 5.0),
                   of);
}

/* Case k, or with exchanged bodies. */
static rb_rolling_case draw(int k, int exchanged)
{
    random_case c = {.state = (uint64_t)k * 40503u, .line = ""};
    add_body(&c, exchanged ? 2 : 1, "");
    add_body(&c, exchanged ? 1 : 2, "-b");
    const double sign = exchanged ? -1.0 : 1.0, mu = random_between(&c, 0.05, 0.9),
                 drive = sign * random_between(&c, -0.02, 0.02);
    random_add(&c, "gap parabola half-width 1 zone 2 mesh uniform contact-elements %d mu %g ",
               24 + random_choice(&c, 30), mu);
    random_add(&c,
               k % 3 == 0   ? "formulation static shift %g "
               : k % 3 == 1 ? "formulation steady creep %g "
                            : "formulation transient distance 0.4 creep %g ",
               drive);
    return rolling_case("%s", c.line);
}

static int is_flat(const rb_rolling_case *rc)
{
    return rb_rolling_can(rc, RB_BODY_FLAT);
}

static void exchange(int k)
{
    enum { POINTS = 6 };
    static const double at[POINTS][2] = {{0, 0.3},     {0.4, 0.7}, {-0.8, 0.12},
                                         {0.95, 0.06}, {-1.7, 2},  {0.1, 1.5}};
    const rb_rolling_case rc = draw(k, 0), other = draw(k, 1);
    rb_rolling_model model = {0}, swapped = {0};
    OWNED(rb_rolling_solution) s = {0}, t = {0};
    if (rb_rolling_case_check(&rc, NULL) != RB_OK || rb_rolling_mirror_check(&rc, NULL) != RB_OK)
        return;
    CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, &message));
    CHECK_OK(rb_rolling_solve_model(&other, &swapped, &t, &message));
    /* elements of a wheel are chords of A's circle: x is not the same to the last digit */
    const double share = is_flat(&rc) ? 1e-8 : 2e-3, p0 = s.max_pressure;
    CHECK_REL(t.max_pressure, p0, share, "case %d: p0", k);
    CHECK_ABS(t.tangential_load, -s.tangential_load, share * s.normal_load, "case %d: Q", k);
    held_mirror *b = NULL;
    CHECK_OK(rb_rolling_mirror_create(&model, &b, &message));
    double xy[2 * POINTS];
    rb_rolling_stress of_b[POINTS], of_a[POINTS];
    int n = 0;
    for (int i = 0; i < POINTS; i++)
        if (!(other.a.layer > 0.0 && other.a.base_young == 0.0 && at[i][1] > other.a.layer)) {
            xy[2 * n] = at[i][0]; /* below a layer on a rigid base there is nothing */
            xy[2 * n++ + 1] = at[i][1] + rb_rolling_surface(&other, at[i][0]);
        }
    if (n > 0) {
        CHECK_OK(rb_rolling_stress_at(&b->model, n, xy, of_b, &message));
        CHECK_OK(rb_rolling_stress_at(&swapped, n, xy, of_a, &message));
    }
    rb_rolling_mirror_stress(n, of_b, NULL);
    for (int i = 0; i < n; i++) {
        CHECK_ABS(of_b[i].y, -of_a[i].y, 0.0, "case %d: place %d", k, i);
        CHECK_ABS(of_b[i].sxx, of_a[i].sxx, 5.0 * share * p0, "case %d: sxx %d", k, i);
        CHECK_ABS(of_b[i].syy, of_a[i].syy, 5.0 * share * p0, "case %d: syy %d", k, i);
        CHECK_ABS(of_b[i].sxy, -of_a[i].sxy, 5.0 * share * p0, "case %d: sxy %d", k, i);
        CHECK_ABS(of_b[i].von_mises, of_a[i].von_mises, 9.0 * share * p0, "case %d: %d", k, i);
    }
    if (k % 5 == 0) { /* the search takes longer */
        OWNED(rb_rolling_stress_maxima) most = {.bonds = 0};
        OWNED(rb_rolling_stress_maxima) most_a = {.bonds = 0};
        CHECK_OK(rb_rolling_stress_maxima_of_b(&model, 0.0, &most, &message));
        CHECK_OK(rb_rolling_stress_maxima_find(&swapped, 0.0, &most_a, &message));
        for (int i = 0; rb_rolling_maximum(&most, i); i++) {
            const double of_b_now = rb_rolling_maximum(&most, i)->value,
                         of_a_then = rb_rolling_maximum(&most_a, i)->value;
            /* no bond, or nothing below it */
            assert_int_equal(isnan(of_b_now), isnan(of_a_then));
            if (!isnan(of_b_now))
                CHECK_ABS(of_b_now, of_a_then, 9.0 * share * p0, "case %d: maximum %d", k, i);
        }
    }
    rb_rolling_model_free(&model);
    rb_rolling_model_free(&swapped);
}

TEST(exchanged_bodies_have_each_others_stress)
{
    for (int k = 0; k < 120; k++)
        if (is_in_turn(k, 8))
            exchange(k);
}

/* ---- Values ------------------------------------------------------------------------ */

/* Carter, mu .3, xi R/(mu a) = .5, nu .3: closed tractions, stresses of strips in closed form, per
 * p0; B's friction is A's with the other sign, but its stick zone is not mirrored. */
TEST(partial_slip_is_no_mirror_image)
{
    static const double rows[][7] = {{0, 0.5, -0.37320, -0.92702, 0.07362, 0.54729, 0.56029},
                                     {0.5, 0.25, -0.67949, -0.86176, 0.22243, 0.46456, 0.51803},
                                     {-0.8, 0.1, -0.15510, -0.54514, 0.01369, 0.53698, 0.36644},
                                     {0.9, 0.05, -0.64486, -0.43373, 0.13765, 0.29737, 0.36988}};
    rb_rolling_case rc = rolling_case(
        "similar young 210000 poisson 0.3 radius 1000 support halfplane gap parabola "
        "half-width 1 mu 0.3 formulation steady creep-ratio 0.5 mesh fitted contact-elements 200");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    held_mirror *b = NULL;
    const double p0 = 210000.0 / 0.91 / 4000.0;
    CHECK_OK(rb_rolling_mirror_create(&model, &b, &message));
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_rolling_stress s, a;
        CHECK_OK(rb_rolling_stress_at(&b->model, 1, rows[k], &s, &message));
        CHECK_OK(rb_rolling_stress_at(&model, 1, rows[k], &a, &message));
        rb_rolling_mirror_stress(1, &s, NULL);
        CHECK_ABS(s.y, -rows[k][1], 0.0, "below");
        CHECK_ABS(s.sxx / p0, rows[k][2], 1e-4, "sxx at %g", rows[k][0]);
        CHECK_ABS(s.syy / p0, rows[k][3], 1e-4, "syy at %g", rows[k][0]);
        CHECK_ABS(s.sxy / p0, rows[k][4], 1e-4, "sxy at %g", rows[k][0]);
        CHECK_ABS(a.von_mises / p0, rows[k][5], 1e-4, "von Mises of A at %g", rows[k][0]);
        CHECK_ABS(s.von_mises / p0, rows[k][6], 1e-4, "von Mises at %g", rows[k][0]);
    }
    /* 2 mu p0 (2 sqrt s - s) at the trailing edge of B, 2 mu p0 s at the leading one of A */
    OWNED(rb_rolling_stress_maxima) most = {.bonds = 0};
    CHECK_OK(rb_rolling_stress_maxima_of_b(&model, 0.0, &most, &message));
    CHECK_REL(most.tension.value / p0, 0.6 * (2.0 * sqrt(0.5) - 0.5), 1e-3, "tension in B");
    CHECK_ABS(most.tension.x, -1.0, 2e-3, "at the trailing edge");
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &most, &message));
    CHECK_REL(most.tension.value / p0, 0.6 * 0.5, 5e-3, "tension in A");
    CHECK_ABS(most.tension.x, 1.0, 2e-3, "at the leading edge");
}

#define UNLIKE                                                                                     \
    "stress --support halfplane --gap parabola --young 210000 --poisson 0.3 "                      \
    "--young-b 70000 --poisson-b 0.33 --load 100 --grid 2x2 "

/* Steel on aluminium: largest von Mises stress in each; two equal discs between two loads. */
TEST(each_body_has_its_own_maximum)
{
    static const struct {
        const char *line, *body;
        double value, depth;
    } rows[] = {{UNLIKE "--radius 50 --mu 0", "a", 107.6876, 0.2321},
                {UNLIKE "--radius 50 --mu 0", "b", 105.6366, -0.2398},
                {UNLIKE "--radius 20 --mu 0.3 --force 0 --mesh uniform --contact-elements 300", "a",
                 175.988, 0.1571},
                {UNLIKE "--radius 20 --mu 0.3 --force 0 --mesh uniform --contact-elements 300", "b",
                 166.631, -0.1308}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char line[400];
        snprintf(line, sizeof line, "%s --body %s", rows[k].line, rows[k].body);
        held_json *root = run_json(line);
        const json_t *most = json_object_get(json_object_get(root, "maxima"), "von_mises");
        CHECK_REL(number_in(most, "value"), rows[k].value, 3e-4, "%s", line);
        CHECK_ABS(number_in(most, "y"), rows[k].depth, 2e-3, "%s", line);
        assert_string_equal(json_string_value(json_object_get(root, "body")), rows[k].body);
    }
}

/* First yield (Tresca) beside shakedown: p0/k = 1/.30028 and 4 under Hertz's pressure. */
TEST(first_yield_comes_before_shakedown)
{
    held_json *root = run_json("stress --similar --support halfplane --gap parabola --young 210000 "
                               "--poisson 0.3 --mu 0 --load 100 --body b --shakedown --grid 2x2");
    const json_t *limit = json_object_get(root, "shakedown");
    CHECK_REL(number_in(limit, "first_yield"), 1.0 / 0.30028, 1e-3, "Tresca");
    CHECK_REL(number_in(limit, "limit"), 4.0, 2e-3, "Melan");
}

/* Carter's tractions: inside, A and B need different yield stresses; at the surface both need the
 * same, p0/k = 1/(mu sqrt(4 s (1 - s) + s^3)), and in B that decides at mu .3, s .5. */
TEST(shakedown_of_b_is_decided_at_its_surface)
{
    static const struct {
        double mu, s, a, a_depth, b, b_depth;
    } rows[] = {{0.3, 0.5, 3.0215, 0.359, 3.1427, 0.0}, {0.25, 0.7, 3.0751, 0.392, 3.1053, 0.431}};
    CHECK_ABS(1.0 / (0.3 * sqrt(4.0 * 0.5 * 0.5 + 0.125)), 3.1427, 5e-5, "the closed form");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        for (int n = 100; n <= 101; n++) {
            /* equal elements need not end where the stick zone does */
            rb_rolling_case rc = rolling_case(
                "similar young 210000 poisson 0.3 radius 1000 support halfplane gap parabola "
                "half-width 1 mu %g formulation steady creep-ratio %g mesh %s contact-elements %d",
                rows[k].mu, rows[k].s, n % 2 ? "uniform" : "fitted", n);
            OWNED(rb_rolling_model) model = solved_model(&rc);
            held_mirror *b = NULL;
            rb_rolling_shakedown of_a, of_b;
            const double p0 = 210000.0 / 0.91 / 4000.0;
            CHECK_OK(rb_rolling_mirror_create(&model, &b, &message));
            CHECK_OK(rb_rolling_shakedown_find(&model, &of_a, &message));
            CHECK_OK(rb_rolling_shakedown_find(&b->model, &of_b, &message));
            CHECK_REL(p0 / of_a.shear_yield, rows[k].a, 5e-4, "A, mu = %g", rows[k].mu);
            CHECK_ABS(of_a.y, rows[k].a_depth, 5e-3, "A, depth");
            CHECK_REL(p0 / of_b.shear_yield, rows[k].b, 6e-4, "B, mu = %g", rows[k].mu);
            CHECK_ABS(of_b.y, rows[k].b_depth, 5e-3, "B, depth");
        }
}

/* ---- Doors ------------------------------------------------------------------------- */

TEST(certificates_know_the_body)
{
    static const char *const more[] = {
        "--similar --support halfplane --gap parabola --mu 0.3 --creep-ratio 0.5 --formulation "
        "steady --load 100 --shakedown",
        "--support hub --young-b 90000 --poisson-b 0.2 --support-b hub --radius-b 80 --mu 0.3 "
        "--load 1000 --creep 1e-3 --formulation steady --contact-elements 24"};
    for (int k = 0; k < 2; k++) {
        char line[700];
        if (!is_in_turn(k, 2))
            continue;
        snprintf(line, sizeof line,
                 "\"$R\" stress %s --body b --grid 4x3 --json --quiet --output b.json && "
                 "\"$R\" check b.json",
                 more[k]);
        if (shell(line))
            fail_msg("%s%s", out, err);
        assert_int_equal(
            shell("sed 's/\"body\": *\"b\"/\"body\": \"a\"/' b.json > a.json && \"$R\" "
                  "check a.json"),
            1);
        assert_non_null(strstr(out, "violated"));
    }
}

TEST(what_is_refused_in_b)
{
    check_refused("stress --body b --mu 0.3", 64, "B is rigid and has no stress");
    write_file("above.txt", "x y\n0 -0.1\n0 0.5\n");
    check_refused("stress --similar --support halfplane --body b --points above.txt", 65,
                  "above.txt:3: (0, 0.5) mm lies above body B: y <= 0");
    check_refused("stress --similar --body c", 64, "--body");
    check_refused("sweep --vary-1 'mu 0.1 0.2' --results von_mises_b", 64, "B is rigid");
}

/* Studies have the stress of both, by name, with error bars. */
TEST(studies_have_both_bodies)
{
    held_json *root = run_json(UNLIKE "--radius 50 --mu 0 --contact-elements 30 --body b --error");
    const json_t *most = json_object_get(json_object_get(root, "maxima"), "von_mises");
    assert_int_equal(
        shell("\"$R\" sweep --support halfplane --gap parabola --young 210000 --poisson "
              "0.3 --young-b 70000 --poisson-b 0.33 --load 100 --radius 50 --mu 0 "
              "--contact-elements 30 --error --vary-1 'load 100' --results "
              "von_mises_b --quiet | grep -v '^#' | awk 'NR == 1 { for (i = 1; i <= NF; "
              "i++) at[$i] = i } NR == 2 { print $at[\"von_mises_b_MPa\"], "
              "$at[\"error_von_mises_b_MPa\"] }'"),
        0);
    double value = NAN, bar = NAN;
    assert_int_equal(sscanf(out, "%lf %lf", &value, &bar), 2);
    CHECK_REL(value, number_in(most, "value"), 1e-12, "value");
    CHECK_REL(bar, number_in(json_object_get(most, "errors"), "value"), 1e-9, "bar");
}

RUN_TESTS(enter_folder, leave_folder)
