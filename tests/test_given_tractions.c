/* The stress below given tractions: strips of the textbooks, both bodies, layers, tables of
 * rollbem. */
#include "cases.h"
#include "cli_run.h"
#include "solved.h"

#include <jansson.h>

enum { PLACES = 4 };
static const double at[PLACES][2] = {{0, 0.5}, {0.5, 0.25}, {1, 0.1}, {-1.5, 0.5}};

/* a = 1 and p0 or q0 = 1; sxx, syy, sxy by quadrature (Johnson, Contact Mechanics, 2.5 and 2.6). */
static const struct {
    const char *name;
    int n;
    double x[3], p[3], q[3], want[PLACES][3], beside; /* sxx at the surface, x = 1.5 */
} loads[] = {{"uniform pressure",
              2,
              {-1, 1},
              {1, 1},
              {0, 0},
              {{-.450185, -.959481, 0},
               {-.620906, -.978790, -.055059},
               {-.468222, -.499974, -.317516},
               {-.285109, -.089226, .146912}},
              0.0},
             {"uniform friction",
              2,
              {-1, 1},
              {0, 0},
              {1, 1},
              {{0, 0, -.450185},
               {-.582032, -.055059, -.620906},
               {-1.590421, -.317516, -.468222},
               {.669536, .146912, -.285109}},
              -1.024600},
             {"triangle of pressure",
              3,
              {-1, 0, 1},
              {0, 1, 0},
              {0, 0, 0},
              {{-.192533, -.704833, 0},
               {-.335666, -.494939, -.152454},
               {-.134661, -.031647, -.045245},
               {-.129242, -.025167, .054000}},
              0.0},
             {"triangle of friction",
              3,
              {-1, 0, 1},
              {0, 0, 0},
              {0, 1, 0},
              {{0, 0, -.192533},
               {-.498273, -.152454, -.335666},
               {-.742062, -.045245, -.134661},
               {.342222, .054000, -.129242}},
              -.463305}};

static rb_rolling_case flat(const char *more)
{
    return rolling_case("similar young 210000 poisson 0.3 support halfplane gap parabola %s", more);
}

static void stress_of(const rb_rolling_case *rc, int load, int of_b, int n, const double *xy,
                      rb_rolling_stress *to)
{
    OWNED(rb_rolling_model) model = {0};
    rb_rolling_solution s;
    rb_rolling_mirror *mirror = NULL;
    CHECK_OK(rb_rolling_model_of_nodes(rc, loads[load].n, loads[load].x, loads[load].p,
                                       loads[load].q, &model, &s, &message));
    if (of_b)
        CHECK_OK(rb_rolling_mirror_create(&model, &mirror, &message));
    CHECK_OK(rb_rolling_stress_at(of_b ? &mirror->model : &model, n, xy, to, &message));
    if (of_b)
        rb_rolling_mirror_stress(n, to, NULL);
    rb_rolling_mirror_free(mirror);
}

TEST(strips_of_the_textbooks)
{
    const rb_rolling_case rc = flat("");
    for (int k = 0; k < 4; k++) {
        /* alone, and among many points, where a series takes the far ones (a jump's moments) */
        enum { MANY = 60 };
        double xy[2 * (PLACES + 1)], many[2 * MANY];
        rb_rolling_stress s[PLACES + 1], of_many[MANY], one;
        for (int i = 0; i < PLACES; i++) {
            xy[2 * i] = at[i][0];
            xy[2 * i + 1] = at[i][1];
        }
        xy[2 * PLACES] = 1.5;
        xy[2 * PLACES + 1] = 0.0;
        stress_of(&rc, k, 0, PLACES + 1, xy, s);
        for (int i = 0; i < PLACES; i++) {
            CHECK_ABS(s[i].sxx, loads[k].want[i][0], 6e-7, "%s: sxx %d", loads[k].name, i);
            CHECK_ABS(s[i].syy, loads[k].want[i][1], 6e-7, "%s: syy %d", loads[k].name, i);
            CHECK_ABS(s[i].sxy, loads[k].want[i][2], 6e-7, "%s: sxy %d", loads[k].name, i);
            CHECK_ABS(s[i].szz, 0.3 * (s[i].sxx + s[i].syy), 1e-15, "%s: szz", loads[k].name);
        }
        CHECK_ABS(s[PLACES].sxx, loads[k].beside, 6e-7, "%s: surface", loads[k].name);
        for (int i = 0; i < MANY; i++) {
            many[2 * i] = 3.5 + 0.1 * i;
            many[2 * i + 1] = 0.3 * (i + 1);
        }
        stress_of(&rc, k, 0, MANY, many, of_many);
        for (int i = 0; i < MANY; i += 7) {
            stress_of(&rc, k, 0, 1, many + 2 * i, &one);
            CHECK_ABS(of_many[i].sxx, one.sxx, 1e-13, "%s: far sxx", loads[k].name);
            CHECK_ABS(of_many[i].syy, one.syy, 1e-13, "%s: far syy", loads[k].name);
            CHECK_ABS(of_many[i].sxy, one.sxy, 1e-13, "%s: far sxy", loads[k].name);
        }
    }
}

/* The shear of uniform pressure is p/pi on the circle through the ends; B's friction is A's turned
 * round; a layer of the base's material is no layer. */
TEST(circle_body_b_and_a_layer_that_is_none)
{
    const rb_rolling_case rc = flat(""),
                          layered = flat("layer-thickness 0.4 base-young 210000 base-poisson 0.3 "
                                         "layer-thickness-b 0.4 base-young-b 210000 "
                                         "base-poisson-b 0.3");
    for (int k = 1; k < 8; k++) {
        const double angle = 0.39 * k, xy[2] = {cos(angle), sin(angle)};
        rb_rolling_stress s;
        stress_of(&rc, 0, 0, 1, xy, &s);
        CHECK_REL(s.max_shear, 1.0 / acos(-1.0), 1e-13, "on the circle, %g", angle);
    }
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < PLACES; i++) {
            rb_rolling_stress a, b, bonded;
            /* all loads here are even: B at x is A at -x with sxy turned */
            const double other[2] = {-at[i][0], at[i][1]};
            stress_of(&rc, k, 0, 1, other, &a);
            stress_of(&rc, k, 1, 1, at[i], &b);
            CHECK_ABS(b.sxx, a.sxx, 1e-14, "%s: B", loads[k].name);
            CHECK_ABS(b.syy, a.syy, 1e-14, "%s: B", loads[k].name);
            CHECK_ABS(b.sxy, a.sxy, 1e-14, "%s: B", loads[k].name);
            stress_of(&layered, k, 1, 1, at[i], &bonded);
            CHECK_ABS(bonded.sxx, b.sxx, 1e-9, "%s: layer %d", loads[k].name, i);
            CHECK_ABS(bonded.sxy, b.sxy, 1e-9, "%s: layer %d", loads[k].name, i);
        }
}

#define RUN                                                                                        \
    "--support halfplane --similar --gap parabola --load 100 --mu 0.3 --creep-ratio 0.4 "          \
    "--formulation steady "

/* A table of rollbem has the stress of its own run. */
TEST(a_printed_table_has_the_stress_of_its_run)
{
    static const char *const body[] = {"a", "b"};
    for (int k = 0; k < 2; k++) {
        char line[900];
        snprintf(line, sizeof line,
                 "\"$R\" " RUN "--quiet --output run.tsv && "
                 "\"$R\" stress " RUN "--grid 7x5 --quiet --json --output own.json --body %s && "
                 "\"$R\" stress --similar --tractions run.tsv --grid 7x5 --quiet --json --body %s",
                 body[k], body[k]);
        if (shell(line))
            fail_msg("%s%s", out, err);
        held_json *again = json_loads(out, 0, NULL), *own = json_load_file("own.json", 0, NULL);
        static const char *const columns[] = {"sxx_MPa", "syy_MPa", "sxy_MPa", "von_mises_MPa"};
        for (int c = 0; c < 4; c++) {
            const json_t *a = json_object_get(json_object_get(own, "grid"), columns[c]),
                         *b = json_object_get(json_object_get(again, "grid"), columns[c]);
            assert_int_equal(json_array_size(a), 35);
            for (size_t i = 0; i < json_array_size(a); i++)
                CHECK_ABS(json_number_value(json_array_get(b, i)),
                          json_number_value(json_array_get(a, i)), 1e-9, "%s %zu", columns[c], i);
        }
        const json_t *totals = json_object_get(again, "tractions");
        CHECK_REL(number_in(totals, "normal_load"), 100.0, 1e-9, "P");
    }
}

/* On the surface, where tractions jump; and what is refused, each in one line. */
TEST(jumps_and_what_is_refused)
{
    static const struct {
        const char *rows, *more, *says;
    } lines[] = {
        {"-1 1\\n1 1\\n", "--points p.tsv", NULL},
        {"-1 0 1\\n1 0 1\\n", "--points p.tsv", "q jumps at x = 1 mm"},
        {"-1 0 1\\n1 0 1\\n", "--shakedown", "shakedown: the friction jumps"},
        {"1 1\\n0 1\\n", "", "x has to increase"},
        {"0 1\\n0 1\\n", "", "two rows at different places"},
        {"0 0\\n1 0\\n", "", "all tractions are zero"},
        {"0 1\\n1 1\\n", "--load 3", "--load: with --tractions no contact is solved"},
        {"0 1\\n1 1\\n", "--mu 0.3", "--mu: with --tractions no contact is solved"},
        {"0 1\\n1 1\\n", "--example rail", "--example: with --tractions"},
        {"0 1\\n1 1\\n", "--support hub", "a wheel is not flat"},
        {"0 1\\n1 1\\n", "--body b", "B is rigid"},
        {"0 1\\n1 1\\n", "--error", "--error: with --tractions"},
        {"0 1\\n1 1\\n", "--cite", "--cite: with --tractions"},
        {"0 1\\n1 1\\n", "--shakedown-map m.png", "--shakedown-map: "},
    };
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        char line[500];
        snprintf(
            line, sizeof line,
            "printf '1 0\\n' > p.tsv; printf -- '%s' > t.tsv; \"$R\" stress --tractions t.tsv %s",
            lines[k].rows, lines[k].more);
        const int code = shell(line);
        if (lines[k].says) {
            assert_int_not_equal(code, 0);
            if (!strstr(err, lines[k].says) || strchr(err, '\n') != err + strlen(err) - 1)
                fail_msg("%s: %s", lines[k].more, err);
            continue;
        }
        assert_int_equal(code, 0); /* the mean of both sides */
        assert_non_null(strstr(out, "\n1\t0\t-0.5\t-0.5\t"));
    }
    if (shell(
            "printf -- '-1 -1 0\\n1 -1 0\\n' > t.tsv; \"$R\" stress --tractions t.tsv --grid 3x3"))
        fail_msg("%s", err);
    assert_non_null(strstr(out, "p < 0 in 2 rows: the surface is pulled there"));
}

/* A result stores its tractions: the stress of nodes, jumps, elements, layers and B is computed
 * again from them, and a traction, a sum or a stress that has been changed is noticed. */
TEST(results_can_be_checked)
{
    static const char *const cases[] = {
        "t.tsv --grid 5x4", "t.tsv --grid 5x4 --similar --body b",
        "t.tsv --grid 5x4 --layer-thickness 0.3 --base-young 70000 --base-poisson 0.3",
        "smooth.tsv --shakedown --points p.tsv", "e.tsv --grid 5x4"};
    static const char *const changes[] = {"s/ 100.0,$/ 100.1,/", "s/\"normal_load\": /&1/",
                                          "s/\"von_mises\": /\"moses\": /",
                                          "s/\"friction_jumps\": 2/\"friction_jumps\": 1/"};
    if (shell("printf -- '-1 100 20\n1 100 20\n' > t.tsv; printf -- '-1 0 0\n0 100 9\n1 0 0\n' "
              "> smooth.tsv; printf '0.1 0.2\n-3 1\n' > p.tsv; \"$R\" --support halfplane "
              "--load 100 --mu 0.3 --formulation steady --creep-ratio 0.4 --contact-elements 20 "
              "> e.tsv"))
        fail_msg("%s", err);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        if (shellf("\"$R\" stress --tractions %s --json --output t.json --quiet && \"$R\" check "
                   "t.json",
                   cases[k]) ||
            !strstr(out, "valid"))
            fail_msg("%s: %s%s", cases[k], out, err);
    for (size_t k = 0; k < sizeof changes / sizeof *changes; k++)
        if (shellf("\"$R\" stress --tractions %s --json --output t.json --quiet && sed '%s' t.json "
                   "> changed.json && ! cmp -s t.json changed.json",
                   cases[0], changes[k]) ||
            shell("\"$R\" check changed.json") != 1)
            fail_msg("%s: %s%s", changes[k], out, err);
    assert_int_equal(shell("sed 's/\"x_mm\"/\"x\"/' t.json > changed.json; \"$R\" check "
                           "changed.json"),
                     65);
    assert_non_null(strstr(err, "its tractions have no rows"));
}

RUN_TESTS(enter_folder, leave_folder)
