/* Young's modulus of rubber by its hardness: the published relations, each by its own equation, and
 * hardnesses as values of options, through the library, case files and the program. */
#include "cli_run.h"
#include "rolling/case/case.h"
#include "rolling/case/rubber.h"

#include <math.h>

static const rb_rubber_scale *const shore_a = &rb_rubber_scales[RB_RUBBER_SHORE_A];

/* The numbers that were computed from the papers elsewhere, as they were rounded. */
TEST(relations_are_those_of_the_papers)
{
    static const struct {
        double shore, gent, bs903, qi, band;
    } rows[] = {{20, 0.732, 0.316, 0.676, 2.3}, {30, 1.142, 0.731, 1.161, 1.6},
                {40, 1.690, 1.355, 1.994, 1.5}, {50, 2.456, 2.241, 3.425, 1.5},
                {60, 3.605, 3.489, 5.884, 1.7}, {70, 5.521, 5.291, 10.11, 1.9},
                {80, 9.351, 8.090, 17.37, 2.1}, {90, 20.84, 13.33, 29.83, 2.2}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const double S = rows[k].shore, want[] = {rows[k].gent, rows[k].bs903, rows[k].qi};
        double young[3], least, largest;
        for (int j = 0; j < 3; j++) {
            young[j] = shore_a->relation[j].young(S);
            CHECK_ABS(young[j], want[j], want[j] < 10.0 ? 5e-4 : 5e-3, "%s at %g",
                      shore_a->relation[j].name, S);
        }
        rb_rubber_band(shore_a, S, &least, &largest);
        CHECK_ABS(largest / least, rows[k].band, 0.05 + 1e-9, "band at %g", S);
        /* each relation, put the other way round */
        CHECK_REL(rb_rubber_shore(young[0]), S, 1e-14, "Gent");
        CHECK_REL(young[0] * 0.137505 * 2.54 * (100.0 - S), 0.0981 * (56.0 + 7.62336 * S), 1e-14,
                  "Gent");
        CHECK_REL(100.0 * erf(3.186e-4 * sqrt(young[1] * 1e6)), S, 1e-14, "BS 903");
        CHECK_REL((log10(young[2]) + 0.6403) / 0.0235, S, 1e-14, "Qi");
    }
}

/* Depths of the ball: those of ISO 48 and of Hertz as they were computed elsewhere, and each law
 * put the other way round. */
TEST(depths_of_a_ball_are_those_of_both_laws)
{
    static const double rows[][3] = {{10, 84.6, 138},   {20, 33.2, 49.0},  {30, 19.2, 26.7},
                                     {40, 13.0, 17.3},  {60, 7.52, 9.42},  {80, 5.10, 6.12},
                                     {100, 3.77, 4.38}, {150, 2.18, 2.38}, {200, 1.48, 1.55}};
    const rb_rubber_scale *pj = &rb_rubber_scales[RB_RUBBER_PJ];
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const double depth = rows[k][0], iso = pj->relation[0].young(depth),
                     hertz = pj->relation[1].young(depth);
        CHECK_REL(iso, rows[k][1], 5e-3, "ISO 48 at %g", depth);
        CHECK_REL(hertz, rows[k][2], 5e-3, "Hertz at %g", depth);
        CHECK_REL(iso, 9.81 * pow(49.262 / depth, 1.0 / 0.74), 1e-4, "ISO 48 at %g", depth);
        CHECK_REL(hertz / 0.75 * 4.0 / 3.0 * sqrt(1.5875) * pow(depth / 100.0, 1.5), 9.81, 1e-14,
                  "Hertz at %g", depth);
    }
}

/* Spellings of 60 ShoreA, in every option of a modulus and every system of units. */
TEST(a_hardness_is_a_modulus)
{
    static const char *const text[] = {"60ShoreA", "60 ShoreA", "60 Shore A", "60shore-a",
                                       "6e1SHOREA"};
    const double want = shore_a->relation[0].young(60.0);
    const rb_option *o = rb_case_table;
    int moduli = 0;
    for (; o < rb_case_table + rb_case_table_n; o++) {
        if (o->kind != RB_OPTION_NUMBER)
            continue;
        for (size_t k = 0; k < sizeof text / sizeof *text; k++)
            for (int u = RB_UNITS_MM; u <= RB_UNITS_INCH; u++) {
                rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
                CHECK_OK(
                    rb_case_set(c, "units", rb_case_word("units", u), RB_GIVEN_ARGUMENT, &message));
                /* a modulus has no other word for its name */
                if (!strstr(o->name, "young")) {
                    CHECK_STATUS(rb_case_set(c, o->name, text[k], RB_GIVEN_ARGUMENT, &message),
                                 RB_EINVAL);
                } else {
                    moduli += k == 0 && u == RB_UNITS_MM;
                    CHECK_OK(rb_case_set(c, o->name, text[k], RB_GIVEN_ARGUMENT, &message));
                    const rb_option_set set = rb_case_options(c);
                    rb_resolved_case stored = *(const rb_resolved_case *)set.target;
                    rb_case_store(c, &set, &stored);
                    CHECK_REL(*(const double *)(const void *)((const char *)&stored + o->offset),
                              want, 1e-14, "--%s %s", o->name, text[k]);
                }
                rb_case_free(c);
            }
    }
    assert_int_equal(moduli, 6);
}

TEST(a_hardness_may_mean_nothing)
{
    static const struct {
        const char *text, *says;
    } rows[] = {{"95ShoreA", "young: expected a modulus, or a hardness of 20 to 90 ShoreA, outside "
                             "of which it tells no modulus"},
                {"19.99ShoreA", "got '19.99ShoreA'"},
                {"-60ShoreA", "20 to 90"},
                {"60ShoreD", "young: expected a modulus, or a hardness in ShoreA"},
                {"60Shore", "a hardness in ShoreA"},
                {"60ShoreA/2", "a hardness in ShoreA"},
                {"ShoreA", "a number > 0, got 'ShoreA'"},
                {"nanShoreA", "a number > 0"},
                {"60", NULL},
                {"20ShoreA", NULL},
                {"90ShoreA", NULL}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
        if (rows[k].says)
            CHECK_SAYS(rb_case_set(c, "young", rows[k].text, RB_GIVEN_ARGUMENT, &message),
                       RB_EINVAL, rows[k].says);
        else
            CHECK_OK(rb_case_set(c, "young", rows[k].text, RB_GIVEN_ARGUMENT, &message));
        rb_case_free(c);
    }
}

/* A given hardness is said, with the other relations in the units of the case; a modulus is not. */
TEST(a_hardness_is_said_with_its_band)
{
    static const struct {
        const char *name, *text, *units, *says;
    } rows[] = {
        {"young", "60ShoreA", "mm",
         "--young of 60 ShoreA is E = 3.605 MPa by Gent, 3.489 by BS 903, 5.884 by Qi, Joyce "
         "and Boyce, a factor of 1.7, and at rest"},
        {"young-b", "45.5ShoreA", "mm", "--young-b of 45.5 ShoreA is E = "},
        {"young", "60ShoreA", "si", "E = 3.605e+06 Pa by Gent, 3.489e+06 by BS 903"},
        {"young", "60ShoreA", "inch", "E = 522.9 psi by Gent, 506 by BS 903"},
        {"young", "3.605", "mm", NULL},
        {"young", "3.605MPa", "mm", NULL}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_case *c = NOT_NULL(rb_case_create(RB_CASE_SINGLE));
        char text[RB_ROLLING_NOTE_LENGTH];
        int said = 0;
        CHECK_OK(rb_case_set(c, "units", rows[k].units, RB_GIVEN_ARGUMENT, &message));
        CHECK_OK(rb_case_set(c, rows[k].name, rows[k].text, RB_GIVEN_ARGUMENT, &message));
        CHECK_OK(rb_case_resolve(c, &message));
        for (int j = 0; rb_case_hardness(c, j, text, sizeof text); j++)
            if (*text) {
                said++;
                if (!rows[k].says || !strstr(text, rows[k].says))
                    fail_msg("%s: %s", rows[k].text, text);
            }
        assert_int_equal(said, rows[k].says != NULL);
        rb_case_free(c);
    }
}

/* The same case as that of the modulus, from arguments and from a file in other units. */
TEST(programs_take_a_hardness)
{
    static const char rest[] = "--support halfplane --load 1 --radius 50 --poisson 0.5 "
                               "--contact-elements 20 --units mm";
    char young[32];
    rb_format(young, sizeof young, "%.17g", shore_a->relation[0].young(60.0));
    write_file("hard.ini", "[body-a]\nyoung = 60 ShoreA\n[units]\nunits = inch\n");
    held_json *want = run_jsonf("--young %s %s", young, rest);
    const double pressure = number_in(json_object_get(want, "summary"), "max_pressure");
    static const char *const given[] = {"--young 60ShoreA", "--young '60 ShoreA'", "hard.ini"};
    for (size_t k = 0; k < 3; k++) {
        held_json *got = run_jsonf("%s %s", given[k], rest);
        CHECK_REL(number_in(json_object_get(got, "summary"), "max_pressure"), pressure, 1e-14, "%s",
                  given[k]);
    }
    assert_int_equal(rollbem("hard.ini --poisson 0.5 --support halfplane --load 1 --units mm"), 0);
    assert_non_null(strstr(err, "note: --young of 60 ShoreA is E = 3.605 MPa by Gent"));
    check_refused("--young 60 ShoreA", 64, "write 60ShoreA without a blank");
    check_refused("--max-pressure 60ShoreA", 64, "--max-pressure: expected a number in one of MPa");
    check_refused("sweep --vary-1 'young 40ShoreA 60ShoreA'", 64, "young: expected a number");
}

/* rollbem rubber: each relation a row, and their band; one fact in all units. */
TEST(a_command_shows_the_band)
{
    static const char *const spelt[] = {"--shore 60A", "--shore 60", "--shore 60ShoreA",
                                        "--shore '60 shore A' --units si"};
    for (size_t k = 0; k < 4; k++) {
        assert_int_equal(rollbemf("rubber %s --json --quiet", spelt[k]), 0);
        held_json *root = NOT_NULL(json_loads(out, 0, NULL));
        const double unit = k == 3 ? 1e6 : 1.0;
        CHECK_REL(number_in(root, "young"), shore_a->relation[0].young(60.0) * unit, 1e-14, "E");
        CHECK_REL(number_in(root, "young_least"), shore_a->relation[1].young(60.0) * unit, 1e-14,
                  "least");
        CHECK_REL(number_in(root, "young_largest"), shore_a->relation[2].young(60.0) * unit, 1e-14,
                  "largest");
        assert_int_equal(json_array_size(json_object_get(root, "relations")), 3);
    }
    CHECK_RUN(rollbem("rubber --shore 60A"), 0, err,
              "60 ShoreA: E = 3.605 MPa by Gent, 3.489 to 5.884 by all, a factor of 1.7\n"
              "makers allow 5 points, 2.967 to 4.426 MPa by Gent");
    assert_non_null(strstr(out, "relation\tyoung_MPa\n# rollbem"));
    assert_non_null(strstr(out, "\nGent\t3.605"));
    CHECK_RUN(rollbem("rubber --pj 100"), 0, err,
              "100 P&J: E = 3.769 MPa by ISO 48, 3.769 to 4.38 by all, a factor of 1.2\n"
              "a cover thinner than 10 mm, ten times the depth, reads hard\n");
    check_refused("rubber", 64, "expected one of --shore 60A and --pj 100");
    check_refused("rubber --shore 60A --pj 100", 64, "expected one of");
    check_refused("rubber --shore 95A", 64, "--shore: expected a hardness of 20 to 90 ShoreA");
    check_refused("rubber --shore 60D", 64, "--shore: expected a hardness in ShoreA");
    check_refused("rubber --shore soft", 64, "--shore: expected a hardness such as 60A");
    check_refused("rubber --pj 5", 64, "[10, 200]");
    check_refused("rubber 60A", 64, "unexpected '60A'");
}

RUN_TESTS(enter_folder, leave_folder)
