/* Input files of CONTACT: our own in every way of writing them, the same cases by the
 * program's own options, and CONTACT's examples below ROLLBEM_DATA. */
#include "cli_run.h"
#include "rolling/case/case.h"
#include "base/io/io_contact.h"

#include <gsl/gsl_math.h>

/* Steel on steel, R = 300, P = 250 N/mm over a width of 100; the digits, the line of
 * forces, the angle of rolling, grid and gap are filled in. */
static const char frame[] = "%% our own\n"
                            " 3 MODULE\n"
                            "  20%d1%d0   P-B-T-N-F-S\n"
                            "  022020   L-D-C-M-Z-E\n"
                            " 0000331   H-G-I-A-O-W-R\n"
                            "   100   100    30      1     1e-6   MAXGS ...\n"
                            "  25000. %s 0. 0.   FN, CKSI, CETA, CPHI\n"
                            "   0.25  0.25   FSTAT, FKIN\n"
                            "%s   0.3   0.3   82000.  82000.   POISS 1,2, GG 1,2\n"
                            "%s   1   1   IBASE, IPLAN\n"
                            "   %s\n"
                            " 0 MODULE\n";
#define ROLLS " 0.0  0.05 1000.\n"
#define BACK " 180d  0.05 1000.\n"
#define GRID " 1\n 60 1 -1.5 -50. 0.05 100.\n"
#define GAP "0.00166666666666666667 0. 0. 0. 0. 0."

static json_t *run_file(const char *options, int t, int f, const char *force, const char *angle,
                        const char *grid, const char *gap)
{
    char text[2000], line[200];
    snprintf(text, sizeof text, frame, t, f, force, angle, grid, gap);
    write_file("own.inp", text);
    snprintf(line, sizeof line, "contact own.inp %s", options);
    held_json *root = run_json(line);
    json_t *one = json_incref(json_array_get(json_object_get(root, "cases"), 0));
    assert_string_equal(json_string_value(json_object_get(one, "status")), "solved");
    return one;
}

/* The same case by options of our own. */
TEST(a_case_is_the_one_of_our_options)
{
    static const struct {
        int t, f;
        const char *force, *ours;
    } all[] = {{3, 0, "-0.0004", "--formulation steady --creep -0.0004"},
               {3, 1, "0.6", "--formulation steady --force-ratio 0.6"},
               {1, 1, "-0.7", "--formulation static --force-ratio -0.7"},
               {1, 0, "-0.0004", "--formulation static"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char line[500];
        held_json *got =
            run_file("", all[k].t, all[k].f, all[k].force, all[k].t == 3 ? ROLLS : "", GRID, GAP);
        snprintf(line, sizeof line,
                 "--support halfplane --similar --radius 300 --young 213200 --poisson 0.3 "
                 "--gap parabola --load 250 --mu 0.25 --mesh uniform --zone 1.5 "
                 "--contact-elements 60 --datum 100 --datum-b 100 %s",
                 all[k].ours);
        /* the strip's tangential datum is 100 exp(nu/(1 - nu)): of both bodies that is
         * worth 2 nu (1 + nu)/(pi E) of displacement per force more each */
        if (all[k].t == 1 && all[k].f == 0)
            snprintf(line + strlen(line), sizeof line - strlen(line), " --shift %.17g",
                     -0.0004 +
                         4.0 * 0.3 * 1.3 / (acos(-1.0) * 213200.0) * number_in(got, "FX") / 100.0);
        json_t *wanted = run_json(line), *s = json_object_get(wanted, "summary");
        CHECK_REL(number_in(got, "FX_REL"), number_in(s, "force_ratio"), 1e-9, "%s", line);
        CHECK_REL(number_in(got, "PEN"), number_in(s, "approach"), 1e-9, "%s", line);
        CHECK_REL(number_in(got, "PMAX"), number_in(s, "max_pressure"), 1e-9, "%s", line);
        CHECK_REL(number_in(got, "FX"), 100.0 * number_in(s, "tangential_load"), 1e-9,
                  "FX is Q DY: %s", line);
        CHECK_ABS(number_in(got, "NADH"), number_in(s, "stick"), 0.0, "%s", line);
        json_decref(wanted);
    }
}

/* CONTACT writes 1e20 where nothing yields; from more than 1e10 on it reads that so. */
TEST(a_huge_yield_stress_is_none)
{
    rb_io_contact_case in = {.module = 3,
                             .digit = {.M = 4, .T = 3, .N = 1, .P = 2},
                             .my = 1,
                             .mx = 10,
                             .base = 1,
                             .b = {1e-3},
                             .dx = 0.1,
                             .dy = 1.0,
                             .from = -0.5,
                             .normal = 10.0,
                             .shear = {8e4, 8e4},
                             .poisson = {0.3, 0.3},
                             .fstat = 0.3,
                             .fkin = 0.3,
                             .layer = 0.01,
                             .layer_shear = 100.0,
                             .hardening = 5.0};
    static const double stress[] = {30.0, 1e10, 1.1e10, 1e20};
    for (int k = 0; k < 4; k++) {
        rb_case_contact c;
        in.yield = stress[k];
        rb_case_from_contact(&in, &c);
        assert_true(c.runs);
        CHECK_ABS(c.rc.yield_stress, k < 2 ? stress[k] : 0.0, 0.0, "TAU_C0 = %g", in.yield);
        CHECK_ABS(c.rc.hardening, k < 2 ? 5.0 : 0.0, 0.0, "K_TAU, TAU_C0 = %g", in.yield);
    }
}

/* Rolling towards -x is the mirror image. */
TEST(rolling_back_turns_the_signs)
{
    held_json *there = run_file("", 3, 0, "-0.0004", ROLLS, GRID, GAP);
    held_json *back = run_file("", 3, 0, "0.0004", BACK, GRID, GAP);
    CHECK_REL(number_in(back, "FX"), -number_in(there, "FX"), 1e-12, "FX");
    CHECK_REL(number_in(back, "CKSI"), -number_in(there, "CKSI"), 1e-12, "CKSI");
    assert_true(number_in(there, "FX") > 0.0);
}

/* The four ways of telling a grid, and a gap whose lowest point is elsewhere. */
TEST(grids_and_gaps_are_those_of_the_file)
{
    static const char *const grids[] = {" 2\n 60 1 -1.5 -50. 1.5 50.\n",
                                        " 3\n 60 1 -1.475 0. 0.05 100.\n"};
    held_json *wanted = run_file("", 3, 0, "-0.0004", ROLLS, GRID, GAP);
    for (int k = 0; k < 2; k++) {
        held_json *got = run_file("", 3, 0, "-0.0004", ROLLS, grids[k], GAP);
        CHECK_REL(number_in(got, "FX"), number_in(wanted, "FX"), 1e-9, "grid %d", k);
    }
    /* (x - 1)^2/(2R) = B1 x^2 - 2 B1 x + const */
    held_json *moved = run_file("", 3, 0, "-0.0004", ROLLS, " 1\n 60 1 -0.5 -50. 0.05 100.\n",
                                "0.00166666666666666667 0. 0. -0.0033333333333333333 0. 0.");
    CHECK_REL(number_in(moved, "FX"), number_in(wanted, "FX"), 1e-9, "moved by 1");
}

static void two_cases(const char *second)
{
    char text[3000];
    const int n = snprintf(text, sizeof text, frame, 3, 0, "-0.0004", ROLLS, GRID, GAP);
    snprintf(text + n - 10, sizeof text - (size_t)n + 10, "\n%s\n 0 MODULE\n", second);
    write_file("two.inp", text);
}

TEST(cases_go_on_from_the_one_before)
{
    two_cases(" 3 MODULE\n 203110\n 100000\n 0101331\n 25000. 0.6 0. 0.\n");
    assert_int_equal(rollbem("contact two.inp --json"), 0);
    held_json *root = json_loads(out, 0, NULL);
    json_t *second = json_array_get(json_object_get(root, "cases"), 1);
    CHECK_REL(number_in(second, "FX_REL"), 0.6, 1e-9, "FX of the second case");
    CHECK_ABS(number_in(second, "NPOT"), 60.0, 0.0, "the grid of the first");
}

TEST(what_is_left_out_is_named)
{
    static const struct {
        const char *second, *wanted;
    } all[] = {{" 1 MODULE\n 1 2 3\n", "case 2 skipped: module 1"},
               {" 3 MODULE\n 203100\n 120000\n 0101331\n 25000. -.0004 0. 0.\n 1\n"
                " 20 20 -1. -1. .1 .1\n",
                "three dimensions (MY = 20"},
               {" 3 MODULE\n 102100\n 100000\n 0101331\n 25000. -.0004 0. 0.\n",
                "another state to go on from (P = 1; 0 and 2 are read)"},
               {" 3 MODULE\n 203100\n 000000\n 0101331\n 25000. -.0004 0. 0.\n .3 .2\n",
                "another friction law (L = 0): mu = 0.3"},
               {" 3 MODULE\n 203100\n 100000\n 0101331\n 25000. -.0004 .1 0.\n", "CETA"},
               {" 3 MODULE\n 203100\n 120000\n 0101331\n 25000. -.0004 0. 0.\n -3\n"
                " 20 1 1. 1. 1.2\n",
                "a contact ellipse (IPOTCN = -3;"},
               {" 3 MODULE\n 203100\n 120000\n 0101331\n -1. -.0004 0. 0.\n -5\n"
                " 20 1 1. 1. 1.2\n",
                "Hertzian input without a positive load, radius or length (IPOTCN = -5)"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        two_cases(all[k].second);
        assert_int_equal(rollbem("contact two.inp"), 0);
        if (!strstr(err, all[k].wanted))
            fail_msg("'%s' is not in: %s", all[k].wanted, err);
        assert_non_null(strstr(err, "two.inp:16: case 2"));
        assert_non_null(strstr(out, "# case 2 leaves out"));
    }
}

/* ---- Sequences and Hertzian input -------------------------------------------------- */

/* The frame's case behind `first` digits, then `count` cases that go on from it. */
static void sequence(int t, int f, const char *force, const char *angle, int count,
                     const char *next)
{
    char text[9000];
    size_t n =
        (size_t)snprintf(text, sizeof text, frame, t, f, force, t >= 2 ? angle : "", GRID, GAP);
    char *end = strstr(text, " 0 MODULE");
    n = (size_t)(end - text);
    for (int k = 0; k < count; k++)
        n += (size_t)snprintf(text + n, sizeof text - n, "%s", next);
    snprintf(text + n, sizeof text - n, " 0 MODULE\n");
    write_file("steps.inp", text);
}

/* The k-th case, counted from 0, of a file whose cases all run. */
static json_t *case_of(const char *file, size_t k)
{
    char line[200];
    snprintf(line, sizeof line, "contact %s", file);
    held_json *root = run_json(line);
    json_t *one = json_incref(json_array_get(json_object_get(root, "cases"), k));
    assert_string_equal(json_string_value(json_object_get(one, "status")), "solved");
    return one;
}

#define STEP                                                                                       \
    " 3 MODULE\n 002110\n 102000\n 0101331\n 25000. .6 0. 0.\n 0. %s 1000.\n"                      \
    " .3 .3 82000. 82000.\n"
#define NEXT " 3 MODULE\n 002110\n 100000\n 0101331\n 25000. .6 0. 0.\n"

/* From rest: the steps of our own transient rolling, by one element and by 0.7. The force
 * stays what it was at rest, so that the depth where the strip rests does not matter. */
TEST(steps_are_those_of_our_transients)
{
    static const char *const lengths[] = {"0.05", "0.035"};
    enum { STEPS = 8 };
    for (int k = 0; k < 2; k++) {
        char next[200], line[700];
        const double step = atof(lengths[k]);
        snprintf(next, sizeof next, STEP, lengths[k]);
        sequence(1, 1, "0.6", "", STEPS, next);
        held_json *got = case_of("steps.inp", STEPS);
        const double a = sqrt(4.0 * 300.0 * 250.0 * 2.0 * 0.91 / 213200.0 / M_PI);
        snprintf(line, sizeof line,
                 "--support halfplane --similar --radius 300 --young 213200 --poisson 0.3 "
                 "--gap parabola --load 250 --mu 0.25 --mesh uniform --zone 1.5 "
                 "--contact-elements 60 --datum 100 --datum-b 100 --formulation transient "
                 "--force-ratio 0.6 --steps %d --distance %.17g",
                 STEPS, STEPS * step / a);
        json_t *root = run_json(line), *s = json_object_get(root, "summary");
        CHECK_REL(number_in(got, "CKSI"), number_in(s, "creepage"), 1e-9, "CKSI");
        CHECK_REL(number_in(got, "FX_REL"), 0.6, 1e-12, "FX");
        CHECK_ABS(number_in(got, "NADH"), number_in(s, "stick"), 0.0, "stick");
        json_decref(root);
    }
}

/* Rolled on for long, steps end in steady rolling, which they stay in. */
TEST(steps_end_in_steady_rolling)
{
    char next[200];
    sequence(3, 1, "0.6", ROLLS, 3, NEXT);
    json_t *steady = case_of("steps.inp", 0), *on = case_of("steps.inp", 3);
    CHECK_REL(number_in(on, "CKSI"), number_in(steady, "CKSI"), 1e-9, "it stays steady");
    CHECK_REL(number_in(on, "FRIC_POWER"), number_in(steady, "FRIC_POWER"), 1e-8, "power");
    json_decref(on);
    snprintf(next, sizeof next, STEP, "0.05");
    sequence(1, 1, "0.6", "", 1, next);
    assert_int_equal(shell("sed -i '/0 MODULE/d' steps.inp; for k in $(seq 200); do "
                           "printf '" NEXT "'; done >>steps.inp"),
                     0);
    on = case_of("steps.inp", 201);
    CHECK_REL(number_in(on, "CKSI"), number_in(steady, "CKSI"), 1e-6, "becomes steady");
    json_decref(on);
    json_decref(steady);
}

/* Cattaneo's problem does not care in how many steps the force grows; back and forth
 * leaves Mindlin's remainder. */
TEST(shifts_add_up)
{
    static const char half[] = " 3 MODULE\n 001100\n 100000\n 0101331\n 25000. -.0002 0. 0.\n";
    static const char back[] = " 3 MODULE\n 001100\n 100000\n 0101331\n 25000. .0002 0. 0.\n";
    sequence(1, 0, "-0.0004", "", 0, "");
    held_json *once = case_of("steps.inp", 0);
    sequence(1, 0, "-0.0002", "", 1, half);
    json_t *twice = case_of("steps.inp", 1);
    CHECK_REL(number_in(twice, "FX"), number_in(once, "FX"), 1e-9, "two halves");
    CHECK_REL(number_in(twice, "CKSI"), -0.0002, 1e-12, "the step's own shift");
    json_decref(twice);
    sequence(1, 0, "-0.0002", "", 1, back);
    twice = case_of("steps.inp", 1);
    assert_true(number_in(twice, "FX") < 0.0 &&
                fabs(number_in(twice, "FX")) < 0.2 * number_in(once, "FX"));
    json_decref(twice);
}

/* Of a rectangle with Hertz's pressure the load tells the half-length or the curvature. */
TEST(hertzian_input_is_the_grid_it_means)
{
    const double a = sqrt(4.0 * 300.0 * 250.0 * 2.0 * 0.91 / 213200.0 / M_PI);
    char grid[3][200];
    snprintf(grid[0], sizeof *grid, " 1\n 60 1 %.17g -50. %.17g 100.\n", -1.25 * a, 2.5 * a / 60);
    snprintf(grid[1], sizeof *grid, " -4\n 60 1 0.00166666666666666667 50. 1.25\n");
    snprintf(grid[2], sizeof *grid, " -5\n 60 1 %.17g 50. 1.25\n", a);
    held_json *wanted = run_file("", 3, 0, "-0.0004", ROLLS, grid[0], GAP);
    for (int k = 1; k < 3; k++) {
        held_json *got = run_file("", 3, 0, "-0.0004", ROLLS, grid[k], GAP);
        CHECK_REL(number_in(got, "FX"), number_in(wanted, "FX"), 1e-9, "FX, %s", grid[k]);
        CHECK_REL(number_in(got, "FN"), 25000.0, 1e-12, "FN, %s", grid[k]);
        CHECK_REL(number_in(got, "PEN"), number_in(wanted, "PEN"), 1e-9, "PEN");
        CHECK_ABS(number_in(got, "NADH"), number_in(wanted, "NADH"), 0.0, "NADH");
    }
}

/* R = 0: the next case has no line MODULE; numbers may go on on the next line. */
TEST(a_module_that_stays_has_more_cases)
{
    sequence(3, 0, "-0.0004", ROLLS, 0, "");
    assert_int_equal(
        shell("sed -i 's/0000331/0000330/;s/^ 60 1 -1.5/ 60 1 % MX, MY\\n -1.5/;"
              "s/ 0 MODULE/% next\\n 203110\\n 100000\\n 0101330\\n 25000. 0.6 0. 0.\\n"
              " 203110\\n 100000\\n 0101331\\n 25000. 0.3 0. 0.\\n/' steps.inp"),
        0);
    static const double wanted[] = {0.6, 0.3};
    for (size_t k = 0; k < 2; k++) {
        held_json *one = case_of("steps.inp", k + 1);
        CHECK_REL(number_in(one, "FX_REL"), wanted[k], 1e-9, "FX of case %zu", k + 2);
    }
}

/* A step needs the elements and the direction of the case before. */
TEST(steps_elsewhere_are_refused)
{
    sequence(3, 0, "0.0004", BACK, 1,
             " 3 MODULE\n 002100\n 102000\n 0101331\n 25000. -.0004 0. 0.\n"
             " 0. 0.05 1000.\n .3 .3 82000. 82000.\n");
    CHECK_RUN(rollbem("contact steps.inp"), 0, err, "case 2 skipped: a step against the direction");
    sequence(3, 0, "-0.0004", ROLLS, 1,
             " 3 MODULE\n 002100\n 120000\n 0101331\n 25000. -.0004 0. 0.\n"
             " 1\n 50 1 -1.5 -50. .06 100.\n");
    assert_int_equal(rollbem("contact steps.inp"), 65);
    assert_non_null(strstr(err, "case 2: a step: the state before has other elements"));
}

/* Each reason once; one line in the end; most cases skipped is not success. */
TEST(skipped_cases_are_counted)
{
    static const char step[] = " 3 MODULE\n 213100\n 100000\n 0101331\n 25000. -.0004 0. 0.\n";
    char two[400], three[800];
    snprintf(two, sizeof two, "%s", step);
    snprintf(three, sizeof three, "%s%s%s", step, step, step);
    two_cases(two);
    CHECK_RUN(rollbem("contact two.inp"), 0, err, "two.inp: 1 of 2 cases run, 1 skipped\n");
    two_cases(three);
    CHECK_RUN(rollbem("contact two.inp"), 1, err, "case 2, and 2 more cases skipped: ");
    assert_null(strstr(err, "case 3"));
    assert_non_null(strstr(err, "two.inp: 1 of 4 cases run, 3 skipped\n"));
}

/* A case of our frame, changed by a line of sed: what is left out of it, and whether it
 * is run all the same. */
TEST(what_is_left_out_is_said)
{
    static const struct {
        int code;
        const char *change, *said;
    } all[] = {
        {1, "s/ 3 MODULE/ 1 MODULE/",
         "skipped: module 1 (module 3 alone is read) is not supported"},
        {1, "s/^ 1$/ -1/", "skipped: a contact ellipse (IPOTCN = -1;"},
        {1, "s/^ 1$/ -5/", "skipped: Hertzian input without a positive load"},
        {1, "s/022020   L/2022020   L/", "skipped: friction of its own in every row"},
        {1, "s/0000331/0000333/", "skipped: a case that the file itself does not calculate"},
        {1, "s/1   1   IBASE/3   1   IBASE/;s/^   0.0016/ 1 2 &/", "skipped: IBASE = 3"},
        {1, "s/0.0016666/-0.0016666/", "skipped: a gap without curvature"},
        {1, "s/203100/002100/", "skipped: a step from a case without a result"},
        {1, "s/203100/001100/;/1000\\.$/d", "a step from a case without a result"},
        {1, "s/203100/302100/", "another state to go on from (P = 3;"},
        {1, "s/203100/202100/;s/0.0  0.05 1000/0.0  0 1000/", "no length (DQ = 0)"},
        {1, "s/203100/002100/;s/022020   L/022120   L/;/POISS/a 1 1 1 1",
         "a step of viscoelastic bodies"},
        {1, "s/203100/213100/", "skipped: approximate pressure (B = 1)"},
        {1, "s/203100/203000/;s/25000\\./0.02/", "reaches the end of the potential contact"},
        {1, "s/022020   L/022220   L/;/POISS/a 1 1 1 1", "the simplified theory (M = 2) is not"},
        {1, "s/022020   L/022320   L/;/POISS/a 1 1 1 1", "the simplified theory (M = 3) is not"},
        {0, "s/022020   L/022920   L/;/POISS/a 1 1 1 1", "the material (M = 9)"},
        {0, "s/1   1   IBASE/1   2   IBASE/;/^   0.0016/a 1 2 3 4 5 6", "the planform (IPLAN = 2)"},
        {0, "s/ 0000331/ 1000331/", "temperatures (H = 1)"},
        {0, "s/ 0000331/ 3000331/;/POISS/a 1 2 3 4\\n 1 2 3 4", "temperatures (H = 3)"},
        {0, "s/022020/022022/", "the rigid slip per element (E = 2)"},
        {0, "s/0.25  0.25/0.3 0.25/", "another friction law (L = 0): mu = 0.3"},
        {0, "s/-0.0004 0. 0./-0.0004 0.1 0./", "CETA, FY and CPHI"},
        {0, "s/0.0  0.05 1000/0.0  0.5 1000/", "the step DQ = 0.5"},
        {0, "s/022020   L/022120   L/;/POISS/a 0.5 0.5 0.001 0.001", ""},
        {0, "s/022020   L/022120   L/;/POISS/a 0.5 0.5 0 0", ""},
        {0, "s/022020   L/022420   L/;/POISS/a 800 0.02 30 0", ""}};
    char text[2000], line[600];
    snprintf(text, sizeof text, frame, 3, 0, "-0.0004", ROLLS, GRID, GAP);
    write_file("own.inp", text);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line,
                 "sed '%s' own.inp >changed.inp; \"$R\" contact changed.inp --json", all[k].change);
        const int code = shell(line);
        if (code != all[k].code || !strstr(err, all[k].said))
            fail_msg("%s: %d, %s", all[k].change, code, err);
    }
}

/* Three cases: the words behind the module are a comment; one that is not of this program, or
 * cannot be read, leaves the others alone. */
TEST(other_cases_of_a_file_are_run)
{
    static const struct {
        const char *file, *change, *said;
        int code, status[3]; /* 1: solved */
        double creepage[3];
    } all[] = {
        {"contact-lower.inp", "", "", 0, {1, 1, 1}, {-.00024, -.00048, -.00012}},
        {"contact-lower.inp",
         "s/MODULE//;s/module/% of CONTACT/",
         "",
         0,
         {1, 1, 1},
         {-.00024, -.00048, -.00012}},
        {"contact-lower.inp", "s/MODULE/Module/", "", 0, {1, 1, 1}, {-.00024, -.00048, -.00012}},
        {"contact-m2.inp",
         "",
         "contact-m2.inp:15: case 2 skipped: the simplified theory (M = 2)",
         0,
         {1, 0, 1},
         {-.00024, 0, -.00024}},
        {"contact-l6.inp",
         "",
         "case 2 skipped: friction that changes with the temperature (L = 6",
         0,
         {1, 0, 1},
         {-.00024, 0, -.00024}},
        {"contact-lower.inp",
         "s/-0.00048/what/",
         "case 2 skipped: what cannot be read (line 20: expected FN or PEN, CKSI or FX",
         65,
         {1, 0, 1},
         {-.00024, 0, -.00012}}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const int code = shellf("sed '%s' \"$PROJECT/tests/data/%s\" >%s; \"$R\" contact %s --json",
                                all[k].change, all[k].file, all[k].file, all[k].file);
        held_json *root = json_loads(out, 0, NULL);
        const json_t *cases = json_object_get(root, "cases");
        if (code != all[k].code || !strstr(err, all[k].said) || json_array_size(cases) != 3)
            fail_msg("%zu: %d, %s", k, code, err);
        for (size_t j = 0; j < 3; j++) {
            const json_t *one = json_array_get(cases, j);
            assert_string_equal(json_string_value(json_object_get(one, "status")),
                                all[k].status[j] ? "solved" : "not run");
            if (all[k].status[j])
                CHECK_REL(number_in(one, "CKSI"), all[k].creepage[j], 1e-12, "%zu, case %zu", k,
                          j + 1);
        }
    }
    /* a case that takes over values of one that is not read is not run either */
    assert_int_equal(shell("sed 's/-0.00048/what/;29,$ {s/022020/122020/;/FSTAT/d}' "
                           "\"$PROJECT/tests/data/contact-lower.inp\" >two.inp; "
                           "\"$R\" contact two.inp"),
                     65);
    assert_non_null(strstr(err, "case 3 skipped: what cannot be read (it takes over values of"));
    /* nothing that could be run: no table of nothing */
    assert_int_equal(shell("sed 's/  55   1   -1.0500/  55   3   -1.0500/' "
                           "\"$PROJECT/tests/data/contact-lower.inp\" >three.inp; "
                           "\"$R\" contact three.inp"),
                     1);
    assert_string_equal(out, "");
    assert_non_null(strstr(err, "case 1, and 2 more cases skipped: three dimensions (MY = 3 rows"));
}

TEST(bad_files_are_refused)
{
    write_file("bad.inp", " 3 MODULE\n 203100\n 022020\n 0000331\n 1 2\n");
    check_refused("contact bad.inp", 65, "bad.inp:5: expected MAXGS, MAXIN");
    check_refused("contact bad.inp --output bad.inp", 64, "--output");
    check_refused("contact bad.inp --output none/out.tsv", 73, "none/out.tsv");
    write_file("bad.inp", "mu = 0.3\n");
    check_refused("contact bad.inp", 65, "not an input file of CONTACT");
    write_file("bad.inp", " 3 MODULE\n 203100\n");
    check_refused("contact bad.inp", 65, "the digits L-D-C-M-Z-E, got 'the end of");
    write_file("bad.inp", " 3 MODULE\n 203100\n 022020\n 0000331\n 1 2 3 4 5\n 25000. -0.0004 "
                          "0. 0.\n 0.25 0.25\n 0. 0.05 1000.\n 0.3 0.3 82000. 82000.\n 1\n "
                          "1.6e12 1 0. 0. 1. 1.\n");
    check_refused("contact bad.inp", 65, "bad.inp:11: MX: expected whole numbers, got 1.6e+12");
    check_refused("contact none.inp", 66, "none.inp");
    check_refused("contact", 64, "FILE.inp");
}

/* Every line that the digits ask for is read, and each of its numbers kept. */
TEST(every_number_has_its_name)
{
    rb_io_contact_case *c;
    int n;
    write_file("all.inp", "%% every line that there is\n"
                          " 3   MODULE\n 203110\n 022422\n 13203310\n of debugging\n"
                          " 1 2 3 4 5\n 0.5 1 -1 1.1\n 25000, 0.5 0.6 0.7 a comment\n 0.3 0.25\n"
                          " 90d 0.05 1000\n 0.28 0.29 81000 82000\n 800 0.02 30 7\n"
                          " 1 2 3 4\n 5 6 7 8\n of plastic heat\n"
                          " 4\n 3 2 10 20 14 21\n 2 1\n 2 7 8 9 10\n 3 4\n\n"
                          " 3 MODULE\n 103000\n 422122\n 00100000\n -1 2 3 4\n"
                          " 0.3 0.1 0.2 0.05 0.4\n 0.9 0.8\n"
                          " 1.5707963267948966 0.1 10\n .1 .2 3 4\n .5 .6 .7 .8\n"
                          " 2\n 4 2 0 0 2 1\n 1 1\n 1 2 3 4 5 6\n"
                          " 3 MODULE\n 203100\n 520000\n 00100000\n 25000. 0.6 0. 0.\n"
                          " 1 2 3 4 5\n 6 7\n 3\n 5 1 1 1 0.5 0.25\n"
                          " 3 MODULE\n 200100\n 100000\n 10\n 1 2 3 4 5\n 1 0.6 0. 0.\n"
                          " 4 MODULE\n 0 MODULE\n 3 MODULE\n");
    CHECK_OK(rb_io_contact_read("all.inp", &n, &c, &message));
    assert_int_equal(n, 5);
    assert_true(c[0].line == 2 && c[0].module == 3 && c[4].module == 4);
    const rb_io_contact_digits *d = &c[0].digit;
    assert_true(d->P == 2 && d->B == 0 && d->T == 3 && d->N == 1 && d->F == 1 && d->S == 0);
    assert_true(d->L == 0 && d->D == 2 && d->C == 2 && d->M == 4 && d->Z == 2 && d->E == 2);
    assert_true(d->X == 1 && d->H == 3 && d->G == 2);
    assert_true(c[3].digit.X == 0 && c[3].digit.H == 0 && c[3].digit.G == 0);
    const struct {
        double got, want;
    } all[] = {{c->normal, 25000},
               {c->tangential, 0.5},
               {c->side, 0.6},
               {c->spin, 0.7},
               {c->fstat, 0.3},
               {c->fkin, 0.25},
               {c->chi, 90},
               {c->dq, 0.05},
               {c->velocity, 1000},
               {c->poisson[0], 0.28},
               {c->poisson[1], 0.29},
               {c->shear[0], 81000},
               {c->shear[1], 82000},
               {c->layer_shear, 800},
               {c->layer, 0.02},
               {c->yield, 30},
               {c->hardening, 7},
               {c->potential, 4},
               {c->mx, 3},
               {c->my, 2},
               {c->dx, 2},
               {c->dy, 1},
               {c->from, 9},
               {c->base, 2},
               {c->plan, 1},
               {c->start, -1},
               {c->centre, 7},
               {c->radius, 8},
               {c[1].fkin, 0.3},
               {c[1].fstat, 0.45},
               {c[1].fall[0], 0.1},
               {c[1].slip_scale[0], 0.2},
               {c[1].fall[1], 0.05},
               {c[1].slip_scale[1], 0.4},
               {c[1].memory, 0.9},
               {c[1].memory_slip, 0.8},
               {c[1].chi, 90},
               {c[1].ratio[0], 0.5},
               {c[1].ratio[1], 0.6},
               {c[1].time[0], 0.7},
               {c[1].time[1], 0.8},
               {c[1].layer, 0.02},
               {c[1].from, 0},
               {c[1].dx, 0.5},
               {c[1].dy, 0.5},
               {c[1].b[0], 1},
               {c[1].b[5], 6},
               {c[1].radius, 8},
               {c[1].law, 4},
               {c[2].law, 5},
               {c[2].fstat, 1},
               {c[2].fall[1], 4},
               {c[2].slip_scale[1], 5},
               {c[2].memory_slip, 7},
               {c[2].from, 0.75},
               {c[2].dx, 0.5},
               {c[2].dy, 0.25},
               {c[2].b[5], 6},
               {c[3].law, 5},
               {c[3].fstat, 1},
               {c[3].mx, 5}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        CHECK_ABS(all[k].got, all[k].want, 1e-13 * fabs(all[k].want), "number %zu", k);
    free(c);
}

#define DIGITS " 3 MODULE\n 203100\n 022020\n 331\n 1 2 3 4 5\n"
#define BODIES DIGITS " 1 2 3 4\n .3 .3\n 0 1 1\n .3 .3 1 1\n"

/* Each line that is short, and each count that is none, with its place. */
TEST(short_lines_are_named)
{
    static const struct {
        const char *text, *said;
    } all[] = {
        {" 3 MODULE\n 20310000x\n", ":2: expected"},
        {" 3 MODULE\n 203100203\n", ":2: expected the digits P-B-T-N-F-S, got '203100203'"},
        {" 3 MODULE\n x\n", ":2: expected the digits P-B-T-N-F-S, got 'x'"},
        {DIGITS " 1 2 3\n", ":6: expected FN or PEN, CKSI or FX, CETA or FY, CPHI, got '1 2 3'"},
        {DIGITS " 1 2 3 inf\n", ":6: expected FN"},
        {DIGITS " 1 2 3 4\n 0.3\n", ":7: expected FSTAT, FKIN"},
        {DIGITS " 1 2 3 4\n .3 .3\n 0 1\n", ":8: expected CHI, DQ, VELOC"},
        {BODIES " 0\n", ":10: expected IPOTCN from 1 to 4, or negative, got '0'"},
        {BODIES " 5\n", "got '5'"},
        {BODIES " 1.5\n", ":10: IPOTCN: expected whole numbers, got 1.5"},
        {BODIES " 1\n 1 1 0 0 1\n", ":11: expected MX, MY and the grid"},
        {BODIES " 1\n 0 1 0 0 1 1\n", ":11: expected MX, MY >= 1 and DX > 0, got 'another grid'"},
        {BODIES " 1\n 1 0 0 0 1 1\n", "got 'another grid'"},
        {BODIES " 1\n 1 1 0 0 0 1\n", "got 'another grid'"},
        {BODIES " 4\n 1 1 0 0 1 1\n", /* one midpoint has no distance */
         "got 'another grid'"},
        {BODIES " 1\n 1 1 0 0 1 1\n 1.5 1\n", ":12: IBASE: expected whole numbers, got 1.5"},
        {BODIES " 1\n 1 1 0 0 1 1\n 1 1\n 1 2 3 4 5\n", ":13: expected B1, ..., B6"},
        {BODIES " 1\n 1 1 0 0 1 1\n 2 1\n 1 2\n", ":13: expected NN, XM, RX1, Y1, DY1"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_io_contact_case *c;
        int n = 7;
        write_file("short.inp", all[k].text);
        CHECK_SAYS(rb_io_contact_read("short.inp", &n, &c, &message), RB_EFORMAT, all[k].said);
        assert_true(n == 0 && !c);
    }
}

TEST(cases_without_memory_are_refused)
{
    write_file("three.inp", " 1 MODULE\n 1 MODULE\n 1 MODULE\n");
    rb_status s = RB_ENOMEM;
    for (int k = 0; s != RB_OK; k++) {
        rb_io_contact_case *c;
        int n;
        alloc_fail_after(k);
        s = rb_io_contact_read("three.inp", &n, &c, NULL);
        alloc_succeed();
        assert_true(s == RB_ENOMEM ? n == 0 && !c : n == 3);
        free(c);
    }
}

/* ---- CONTACT's examples ------------------------------------------------------------ */

static const char *data(const char *name)
{
    static char path[600];
    const char *folder_of_data = getenv("ROLLBEM_DATA");
    if (!folder_of_data)
        skip();
    snprintf(path, sizeof path, "%s/contact/%s", folder_of_data, name);
    if (access(path, R_OK) != 0)
        skip();
    return path;
}

/* Figures of carter2d.ref_out. */
TEST(carters_example_is_met)
{
    char line[700];
    snprintf(line, sizeof line, "contact %s", data("carter2d.inp"));
    held_json *root = run_json(line);
    json_t *one = json_array_get(json_object_get(root, "cases"), 0);
    CHECK_REL(number_in(one, "FN"), 35780.0, 1e-9, "FN");
    CHECK_ABS(number_in(one, "FX"), 6955.0, 0.5, "FX");
    CHECK_ABS(number_in(one, "FX_REL"), 0.6480, 0.5e-4, "FX/FSTAT/FN");
    CHECK_ABS(number_in(one, "PEN"), 6.492e-3, 0.5e-6, "approach");
    CHECK_ABS(number_in(one, "PMAX"), 113.9, 0.05, "PMAX");
    CHECK_ABS(number_in(one, "FRIC_POWER"), -47.62, 0.005, "frictional power");
    /* as docs/contact.md prints ours */
    CHECK_ABS(number_in(one, "FX"), 6955.4, 0.06, "FX");
    CHECK_ABS(number_in(one, "FX_REL"), 0.64798, 6e-6, "FX/FSTAT/FN");
    CHECK_ABS(number_in(one, "PEN"), 6.4915e-3, 6e-8, "approach");
    CHECK_ABS(number_in(one, "PMAX"), 113.90, 6e-3, "PMAX");
    CHECK_ABS(number_in(one, "FRIC_POWER"), -47.622, 6e-4, "frictional power");
    CHECK_ABS(number_in(one, "NCON"), 50.0, 0.0, "elements in contact");
    CHECK_ABS(number_in(one, "NADH"), 30.0, 0.0, "in adhesion");
    CHECK_ABS(number_in(one, "NSLIP"), 20.0, 0.0, "in slip");
}

/* Friction that falls with the slip: the steady case, FX 1.109E+05, FX/FSTAT/FN 0.5941,
 * power -4849, 45 in adhesion, 36 in slip. */
TEST(falling_friction_is_met)
{
    char line[700];
    snprintf(line, sizeof line, "contact %s --quiet", data("veldep_fric.inp"));
    held_json *root = run_json(line);
    for (size_t k = 0; k <= 2; k += 2) {
        json_t *one = json_array_get(json_object_get(root, "cases"), k);
        CHECK_REL(number_in(one, "FX"), 1.109e5, 5e-4, "FX, case %zu", k + 1);
        CHECK_ABS(number_in(one, "FX_REL"), 0.5941, 5e-4, "FX/FSTAT/FN");
        CHECK_REL(number_in(one, "FRIC_POWER"), -4849.0, 5e-4, "frictional power");
        CHECK_ABS(number_in(one, "FX"), 1.1094e5, 6.0, "FX as docs/contact.md prints ours");
        CHECK_ABS(number_in(one, "FX_REL"), 0.59433, 6e-6, "FX/FSTAT/FN");
        CHECK_ABS(number_in(one, "FRIC_POWER"), -4851.0, 0.6, "frictional power");
        CHECK_ABS(number_in(one, "NADH"), 45.0, 0.0, "in adhesion");
        CHECK_ABS(number_in(one, "NSLIP"), 36.0, 0.0, "in slip");
        CHECK_MAX(number_in(one, "residual"), 1e-10, "residual");
    }
}

/* The steps of the same file: from below, and ten from above, of which the seventh finds
 * the branch that slips more again. */
TEST(transient_falling_friction_is_met)
{
    static const struct {
        double ratio, power;
        int stick;
    } want[] = {{0.5977, -30.64, 77},   {0.0, 0.0, 0},        {0.5702, -36560.0, 34},
                {0.5739, -5.025, 79},   {0.5774, -40.39, 77}, {0.5806, -132.1, 75},
                {0.5835, -293.8, 73},   {0.5860, -528.2, 71}, {0.5882, -821.9, 69},
                {0.5714, -25630.0, 36}, {0.5751, -5.239, 79}};
    /* as docs/contact.md prints ours */
    static const double ours[] = {0.59790, 0.0,     0.57047, 0.57419, 0.57766, 0.58084,
                                  0.58371, 0.58624, 0.58846, 0.57158, 0.57530};
    char line[700];
    snprintf(line, sizeof line, "contact %s --quiet", data("veldep_fric.inp"));
    json_t *root = run_json(line), *cases = json_object_get(root, "cases");
    assert_int_equal(json_array_size(cases), 53);
    for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
        const json_t *one = json_array_get(cases, k + 1);
        if (want[k].stick == 0)
            continue;
        /* CONTACT ends its search at 1e-3 of the slip velocity */
        CHECK_ABS(number_in(one, "FX_REL"), want[k].ratio, 4e-4, "case %zu", k + 2);
        CHECK_ABS(number_in(one, "FX_REL"), ours[k], 6e-6, "case %zu", k + 2);
        if (k == 0)
            CHECK_ABS(number_in(one, "FRIC_POWER"), -30.68, 6e-3, "case %zu", k + 2);
        CHECK_REL(number_in(one, "FRIC_POWER"), want[k].power, 1e-2, "case %zu", k + 2);
        CHECK_ABS(number_in(one, "NADH"), want[k].stick, 0.0, "case %zu", k + 2);
        CHECK_ABS(number_in(one, "NCON"), 81.0, 0.0, "case %zu", k + 2);
    }
    json_decref(root);
}

/* Figures of testbank/examples_plast/catt2d_plast.ref_out, whose problem is that of
 * carter_plast: pressed and shifted, then rolled on step by step. */
TEST(plastic_steps_are_met)
{
    static const struct {
        double ratio, power;
        int stick, slip, yield;
    } want[] = {{0.6000, 0.0, 14, 8, 4},    {0.6051, -24.88, 17, 4, 5},
                {0.6100, -26.12, 16, 4, 6}, {0.6146, -27.41, 14, 4, 8},
                {0.6189, -28.73, 13, 4, 9}, {0.6230, -30.17, 12, 4, 10}};
    write_file("plastic.inp",
               " 3 MODULE\n 201110\n 022420\n 002341\n 999 100 30 1 1e-5\n"
               " 35780. 0.6 0. 0.\n 0.5 0.5\n 0.28 0.28 82000. 82000.\n"
               " 82000. 0. 35. 123000.\n 3\n 30 1 -1.16 0. 0.08 200.\n 1 1\n"
               " 0.001 0. 0. 0. 0. 0.\n"
               " 3 MODULE\n 002100\n 102400\n 102341\n 35780. -0.0004 0. 0.\n"
               " 0. 0.08 30000.\n 0.28 0.28 82000. 82000.\n 82000. 0. 35. 123000.\n");
    assert_int_equal(shell("for k in 1 2 3 4; do printf ' 3 MODULE\\n 002100\\n 101400\\n "
                           "102341\\n 35780. -0.0004 0. 0.\\n'; done >>plastic.inp"),
                     0);
    json_t *root = run_json("contact plastic.inp"), *cases = json_object_get(root, "cases");
    assert_int_equal(json_array_size(cases), 6);
    for (size_t k = 0; k < 6; k++) {
        const json_t *one = json_array_get(cases, k);
        CHECK_ABS(number_in(one, "FX_REL"), want[k].ratio, 1e-4, "case %zu", k + 1);
        if (k > 0)
            CHECK_REL(number_in(one, "FRIC_POWER"), want[k].power, 5e-4, "case %zu", k + 1);
        if (k == 8 || k == 11) { /* as docs/contact.md prints ours */
            CHECK_ABS(number_in(one, "FX_REL"), k == 8 ? 0.64366 : 0.54299, 6e-6, "case %zu",
                      k + 1);
            CHECK_ABS(number_in(one, "FRIC_POWER"), k == 8 ? -133.37 : -5.9575,
                      k == 8 ? 6e-3 : 6e-5, "case %zu", k + 1);
        }
        CHECK_ABS(number_in(one, "NADH"), want[k].stick, 0.0, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NSLIP"), want[k].slip, 0.0, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NPLAST"), want[k].yield, 0.0, "case %zu", k + 1);
    }
    json_decref(root);
}

/* Figures of testbank/examples_plast/carter_plast.ref_out: a third body that hardens
 * strongly, hardens, neither, and softens, on three grids. */
TEST(plastic_examples_are_met)
{
    static const struct {
        double ratio, power;
        int stick, slip, yield;
    } want[] = {
        {0.6562, -126.1, 12, 11, 3},  {0.6420, -92.34, 11, 8, 7},   {0.5959, -26.86, 9, 4, 13},
        {0.5509, -11.41, 8, 3, 15},   {0.6478, -130.9, 25, 21, 5},  {0.6340, -97.86, 22, 15, 14},
        {0.5896, -31.36, 19, 7, 25},  {0.5457, -9.425, 17, 4, 30},  {0.6436, -133.4, 52, 41, 8},
        {0.6299, -99.53, 46, 29, 26}, {0.5864, -30.12, 39, 12, 50}, {0.5430, -5.958, 34, 5, 62}};
    char line[700];
    snprintf(line, sizeof line, "contact %s", data("carter_plast.inp"));
    json_t *root = run_json(line), *cases = json_object_get(root, "cases");
    assert_int_equal(json_array_size(cases), 12);
    for (size_t k = 0; k < 12; k++) {
        const json_t *one = json_array_get(cases, k);
        CHECK_ABS(number_in(one, "FX_REL"), want[k].ratio, 1e-4, "case %zu", k + 1);
        CHECK_REL(number_in(one, "FRIC_POWER"), want[k].power, 5e-4, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NADH"), want[k].stick, 0.0, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NSLIP"), want[k].slip, 0.0, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NPLAST"), want[k].yield, 0.0, "case %zu", k + 1);
        assert_string_equal(json_string_value(json_object_get(one, "left_out")), "");
    }
    json_decref(root);
}

/* Figures of examples/visc_cylindr.ref_out: two cylinders of PA6 with four times of
 * relaxation, and two that are elastic.  A memory of 2000 mm is longer than the strip of
 * 1000 mm is wide, whose three-dimensional kernel CKSI there feels (1.3e-3); the approach
 * feels it in full. */
TEST(viscoelastic_cylinders_are_met)
{
    static const struct {
        double shear, tau, creep, approach, pressure, power;
        int contact, stick;
    } want[] = {{1143.0, 0.0, 1.378e-2, 2.508, 60.32, -1438.0, 80, 51},
                {1143.0, 0.009, 1.365e-2, 2.367, 78.74, -913.7, 62, 37},
                {1143.0, 0.045, 1.152e-2, 2.063, 84.72, -952.0, 57, 36},
                {1143.0, 2.0, 9.932e-3, 1.455, 85.31, -1010.0, 56, 35},
                {571.5, -1.0, 1.378e-2, 2.508, 60.32, -1438.0, 80, 51},
                {1143.0, -1.0, 9.792e-3, 1.324, 85.31, -1007.0, 56, 36}};
    enum { CASES = sizeof want / sizeof *want };
    char text[600 * CASES] = "", memory[60];
    for (size_t k = 0; k < CASES; k++) {
        const int relaxes = want[k].tau >= 0.0;
        snprintf(memory, sizeof memory, " 1. 1. %g %g\n", want[k].tau, want[k].tau);
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 " 3 MODULE\n 203120\n 022%d20\n 0001341\n 100 100 30 1 1e-5\n"
                 " 600000. -0.6 0. 0.\n 0.3 0.3\n 0. 0.16 1000.\n 0.4 0.4 %g %g\n%s"
                 " 3\n 99 1 -7.92 0. 0.16 1000.\n 1 1\n 0.01 0. 0. 0. 0. 0.\n",
                 relaxes, want[k].shear, want[k].shear, relaxes ? memory : "");
    }
    write_file("polymer.inp", text);
    json_t *root = run_json("contact polymer.inp"), *cases = json_object_get(root, "cases");
    assert_int_equal(json_array_size(cases), CASES);
    for (size_t k = 0; k < CASES; k++) {
        const json_t *one = json_array_get(cases, k);
        CHECK_ABS(number_in(one, "PEN"), want[k].approach, 0.5e-3, "case %zu", k + 1);
        CHECK_REL(number_in(one, "CKSI"), want[k].creep, k == 3 ? 1.4e-3 : 4e-4, "case %zu", k + 1);
        CHECK_REL(number_in(one, "PMAX"), want[k].pressure, 2e-4, "case %zu", k + 1);
        CHECK_REL(number_in(one, "FRIC_POWER"), want[k].power, 5e-4, "case %zu", k + 1);
        if (k == 1) { /* as docs/contact.md prints CONTACT's approach, and ours */
            CHECK_ABS(number_in(one, "PEN"), 2.36736, 2e-5, "approach");
            CHECK_ABS(number_in(one, "PEN"), 2.36735, 6e-6, "approach");
            CHECK_ABS(number_in(one, "CKSI"), 1.36501e-2, 6e-8, "creepage");
            CHECK_ABS(number_in(one, "PMAX"), 78.738, 6e-4, "pressure");
            CHECK_ABS(number_in(one, "FRIC_POWER"), -913.55, 6e-3, "power");
        }
        CHECK_ABS(number_in(one, "NCON"), want[k].contact, 0.0, "case %zu", k + 1);
        CHECK_ABS(number_in(one, "NADH"), want[k].stick, 0.0, "case %zu", k + 1);
    }
    json_decref(root);
}

TEST(other_examples_are_run_or_named)
{
    static const struct {
        const char *name;
        int code, cases;
        const char *wanted;
    } all[] = {{"cattaneo.inp", 1, 2, "three dimensions (MY = 19"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        assert_int_equal(rollbemf("contact %s --json", data(all[k].name)), all[k].code);
        assert_non_null(strstr(err, all[k].wanted));
        held_json *root = json_loads(out, 0, NULL);
        const size_t cases = json_array_size(json_object_get(root, "cases"));
        if (all[k].cases)
            assert_int_equal(cases, all[k].cases);
        else
            assert_true(cases > 40);
    }
}

RUN_TESTS(enter_folder, leave_folder)
