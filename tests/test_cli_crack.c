/* rollbem crack: the tables of an independent program through the command line, in every
 * unit, from case files; loads of every kind go through or are refused in one line. */
#include "cli_run.h"

#include <gsl/gsl_math.h>

#define CONTACT "--similar --support halfplane --half-width 1 --radius 1000 "
#define HERTZ "crack " CONTACT
#define BRAKED "--formulation steady --creep-ratio 3 "
#define DRIVEN "--formulation steady --creep-ratio -3 "

static double in_summary(const json_t *root, const char *name)
{
    return number_in(json_object_get(root, "summary"), name);
}

/* p0 sqrt(pi a), a = 1 mm, of the computed contact. */
static double scale_of(const json_t *root)
{
    return sqrt(M_PI) * number_in(json_object_get(root, "contact"), "max_pressure");
}

TEST(edge_cracks)
{
    static const double want[][3] = {{90, 1.12152226, 0.0},
                                     {75, 1.068546, 0.173807},
                                     {60, 0.920100, 0.305800},
                                     {45, 0.704910, 0.364491},
                                     {30, 0.462431, 0.336140}};
    char line[200];
    for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
        snprintf(line, sizeof line, HERTZ "--unloaded --remote-stress 3 --crack-angle %g",
                 want[k][0]);
        held_json *root = run_json(line);
        CHECK_ABS(in_summary(root, "K_I_max") / (3.0 * sqrt(M_PI)), want[k][1], 2.5e-4,
                  "K_I at %g degrees", want[k][0]);
        CHECK_ABS(in_summary(root, "K_II_max") / (3.0 * sqrt(M_PI)), want[k][2], 2e-4,
                  "K_II at %g degrees", want[k][0]);
    }
}

TEST(passes)
{
    static const struct {
        const char *load;
        double K_II_min, K_II_max, K_I_max, K_II[6];
    } want[] = {{"--mu 0 --crack-friction 0.1",
                 -.09154,
                 .15226,
                 .0002,
                 {-.02567, .03211, .15226, -.00518, -.09116, -.00617}},
                {"--mu 0 --crack-friction 0.3",
                 -.05491,
                 .06401,
                 0,
                 {-.02366, -.00368, .06401, .06401, -.04651, -.00695}},
                {"--mu 0.1 " BRAKED "--crack-friction 0.3",
                 -.05736,
                 .05546,
                 .00485,
                 {-.03968, -.01912, .05546, .05546, -.02563, .00152}}};
    static const size_t step[] = {45, 55, 65, 75, 80, 120};
    char line[300];
    for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
        snprintf(line, sizeof line, HERTZ "--formulation steady --steps 120 %s", want[k].load);
        held_json *root = run_json(line);
        const json_t *table = json_object_get(root, "table");
        const double unit = scale_of(root);
        CHECK_ABS(in_summary(root, "K_II_min") / unit, want[k].K_II_min, 1e-4, "min");
        CHECK_ABS(in_summary(root, "K_II_max") / unit, want[k].K_II_max, 1e-4, "max");
        CHECK_ABS(in_summary(root, "delta_K_II") / unit, want[k].K_II_max - want[k].K_II_min, 2e-4,
                  "range");
        CHECK_ABS(in_summary(root, "K_I_max") / unit, want[k].K_I_max, 1e-4, "K_I");
        CHECK_ABS(in_summary(root, "K_I_min"), 0.0, 1e-12, "K_I");
        for (int i = 0; i < 6; i++)
            CHECK_ABS(entry(table, "K_II", step[i]) / unit, want[k].K_II[i], 1e-4, "%s, step %zu",
                      want[k].load, step[i]);
        assert_int_equal(json_array_size(json_object_get(table, "x")), 121);
        CHECK_ABS(entry(table, "x", 120), 6.0, 1e-12, "x");
        for (size_t i = 0; i < 121; i++) {
            const double apart = entry(table, "open_length", i),
                         stuck = entry(table, "stick_length", i);
            CHECK_MAX(-apart, 0.0, "open");
            CHECK_MAX(apart + stuck, 1.0, "of a length of 1");
        }
    }
}

/* K_I max and the fluid's pressure of an independent program, whose volume is that of the
 * last position with an open mouth; and with the place of closing 0.2724 p0 sqrt(pi a) in
 * the limit of 80 and 160 elements, of second order. */
TEST(trapped)
{
    static const double reference[][3] = {
        {10, 0.332, 1.088}, {20, 0.336, 1.104}, {40, 0.337, 1.104}};
    double error[2];
    char line[300];
    for (int k = 0; k < 3; k++) {
        const int n = (int)reference[k][0];
        snprintf(line, sizeof line,
                 HERTZ DRIVEN "--mu 0.3 --crack-elements %d --steps %d --fluid trapped", n, 6 * n);
        held_json *root = run_json(line);
        CHECK_ABS(in_summary(root, "K_I_max") / scale_of(root), reference[k][1], 1e-3,
                  "K_I, %d elements", n);
        CHECK_ABS(in_summary(root, "fluid_pressure_max") * sqrt(M_PI) / scale_of(root),
                  reference[k][2], 2e-3, "fluid");
    }
    for (int k = 0; k < 2; k++) {
        snprintf(line, sizeof line,
                 HERTZ DRIVEN
                 "--mu 0.3 --crack-elements %d --steps 240 --fluid trapped --closing located",
                 20 << k);
        held_json *root = run_json(line);
        error[k] = 0.2724 - in_summary(root, "K_I_max") / scale_of(root);
        CHECK_ABS(in_summary(root, "fluid_pressure_max") * sqrt(M_PI) / scale_of(root), 1.0909,
                  k ? 6e-4 : 3e-3, "fluid, between positions");
    }
    CHECK_ABS(error[1], 3.4e-3, 3e-4, "40 elements");
    CHECK_ABS(error[0] / error[1], 3.3, 0.5, "order");
}

/* The same physics in other units, and through a case file. */
TEST(units_and_case_files)
{
    held_json *mm = run_json(HERTZ "--mu 0 --remote-stress 20 --crack-mouth 0.2"),
              *si = run_json("crack --units si --similar --support halfplane --half-width 1mm "
                             "--radius 1 --young 94500e6 --mu 0 --remote-stress 20MPa "
                             "--crack-mouth 0.2");
    write_file("case.ini", "[body-a]\nradius = 1000\nsupport = halfplane\n[body-b]\nsimilar = "
                           "yes\n[normal]\nhalf-width = 1\n[friction]\nmu = 0\n[crack]\n"
                           "remote-stress = 20MPa\ncrack-mouth = 0.2\nfluid = none\n");
    held_json *file = run_json("crack case.ini");
    static const char *const names[] = {"K_I_max", "K_II_max", "K_II_min", "delta_K_II"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const double want = in_summary(mm, names[k]);
        /* MPa sqrt(mm) in Pa sqrt(m) */
        CHECK_REL(in_summary(si, names[k]), want * 1e6 / sqrt(1000.0), 1e-9, "%s", names[k]);
        CHECK_REL(in_summary(file, names[k]), want, 0.0, "%s", names[k]);
    }
    /* six half-widths before the mouth */
    CHECK_REL(entry(json_object_get(si, "table"), "x", 0), -5.8e-3, 1e-12, "x");
    CHECK_ABS(number_in(json_object_get(file, "inputs"), "remote-stress"), 20.0, 0.0, "inputs");
}

/* A wheel rolls without friction: transient and steady are the same load. */
TEST(histories)
{
    held_json *steady = run_json(HERTZ "--mu 0 --mesh uniform --contact-elements 80 --zone 1.3 "
                                       "--steps 60"),
              *transient = run_json(HERTZ "--mu 0 --formulation transient --distance 12 --steps 60 "
                                          "--contact-elements 80 --zone 1.3"),
              *still = run_json(HERTZ "--mu 0.3 --increments 4 --shift 2e-4 --crack-mouth 0.9");
    const json_t *a = json_object_get(steady, "table"), *b = json_object_get(transient, "table"),
                 *c = json_object_get(still, "table");
    const size_t n = json_array_size(json_object_get(b, "x"));
    const size_t pressed = n - 60; /* steps at rest, at --from */
    for (size_t k = 1; k <= 60; k++) {
        CHECK_ABS(entry(b, "x", pressed + k - 1), entry(a, "x", k), 1e-9, "x");
        CHECK_ABS(entry(b, "K_II", pressed + k - 1), entry(a, "K_II", k), 1e-6, "step %zu", k);
    }
    for (size_t k = 0; k < json_array_size(json_object_get(c, "x")); k++)
        CHECK_ABS(entry(c, "x", k), 0.0, 0.0, "it stays");
    CHECK_MAX(1e-3, fabs(entry(c, "K_II", 3)), "pressing tears the crack");
}

TEST(error_bars)
{
    held_json *root = run_json(HERTZ "--mu 0 --formulation steady --crack-elements 20 --error");
    const json_t *errors = json_object_get(json_object_get(root, "summary"), "errors");
    const double unit = scale_of(root);
    CHECK_MAX(fabs(in_summary(root, "delta_K_II") / unit - 0.2438),
              number_in(errors, "delta_K_II") / unit, "the bar holds the error");
    CHECK_MAX(number_in(errors, "delta_K_II") / unit, 3e-3, "and is not wide");
}

TEST(below_the_surface)
{
    held_json *root = run_json(HERTZ "--mu 0 --crack-depth 0.4 --crack-angle 0 --crack-mouth "
                                     "-0.5 --crack-friction 0.1 --from -7 --to 7 --steps 140");
    /* a horizontal crack under a symmetric load: the ends change places */
    CHECK_REL(in_summary(root, "K_II_max_upper"), -in_summary(root, "K_II_min"), 0.1, "ends");
    CHECK_MAX(in_summary(root, "K_I_max"), 0.03 * in_summary(root, "delta_K_II"),
              "pressed together, but for what sliding near the surface opens");
}

TEST(pictures)
{
    assert_int_equal(rollbem("crack --help"), 0);
    assert_non_null(strstr(out, "in that picture [a] (0)")); /* below the contact */
    assert_int_equal(rollbem(HERTZ "--mu 0 --plot a.svg --plot-crack b.svg --at 0.5 --orbit "
                                   "c.svg --quiet"),
                     0);
    assert_int_equal(shell("for f in a b c; do grep -q '</svg>' $f.svg || exit 1; done"), 0);
    /* one that grows: a mark for each of three lengths beyond the first */
    assert_int_equal(rollbem(HERTZ "--mu 0 --plot-crack d.svg --plot-script d.gp --quiet "
                                   "--paris 1e-12,3 --grow-steps 3 --growth tension"),
                     0);
    assert_int_equal(shell("sed -n '/^.tips/,/^EOD/p' d.gp | wc -l"), 0);
    assert_int_equal(atoi(out), 6); /* with the ends of the block and its heading */
    /* a contact that stands still is drawn over its steps */
    assert_int_equal(rollbem("crack --increments 2 --plot e.svg --plot-script e.gp --quiet"), 0);
    assert_int_equal(shell("grep -c \"x_label = 'step'\" e.gp"), 0);
    assert_int_equal(rollbem("crack --increments 2 --orbit f.svg --quiet"), 0);
}

/* A crack at 90 degrees stays below its mouth to the last digit, also when it has grown. */
TEST(right_angles_are_right)
{
    assert_int_equal(rollbem(HERTZ "--mu 0 --crack-angle 90 --remote-stress 1 --paris 1e-9,3 "
                                   "--grow-steps 3 --json"),
                     0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *tip = json_object_get(json_object_get(root, "growth"), "tip_x");
    assert_int_equal(json_array_size(tip), 4);
    for (size_t k = 0; k < 4; k++)
        assert_true(json_number_value(json_array_get(tip, k)) == 0.0);
}

/* The face on the side of +x, to which K_II > 0 refers, lies above at 30 degrees and below at
 * 150, where the mirrored crack has the opposite K_II. */
TEST(faces_are_named_as_they_lie)
{
    static const struct {
        const char *angle, *plus, *minus;
    } cracks[] = {{"30", "upper", "lower"}, {"90", "right", "left"}, {"150", "lower", "upper"}};
    double K[3];
    for (size_t k = 0; k < sizeof cracks / sizeof *cracks; k++) {
        char line[300];
        snprintf(line, sizeof line,
                 HERTZ "--mu 0 --crack-friction 0 --quiet --units si --plot-crack f.svg "
                       "--plot-script f.gp --json --crack-angle %s",
                 cracks[k].angle);
        held_json *root = run_json(line);
        K[k] = in_summary(root, k == 2 ? "K_II_min" : "K_II_max");
        snprintf(line, sizeof line,
                 "grep -q 'face1_name = .%s face' f.gp && grep -q 'face0_name = .%s face' f.gp && "
                 "grep -q '■ %s face slips to the tip' f.gp && grep -q 'MPa·m' f.gp",
                 cracks[k].plus, cracks[k].minus, cracks[k].plus);
        assert_int_equal(shell(line), 0);
    }
    CHECK_REL(K[2], -K[0], 1e-9, "K_II of the mirrored crack");
    assert_int_equal(rollbem(HERTZ "--mu 0"), 0);
    assert_non_null(strstr(out, "the face on the side of +x, the upper one below 90 degrees"));
}

/* Supports, laws, meshes, heat, bores, gap tables, force control, steps and histories,
 * and every example that is a case: solved, or refused in one line. */
TEST(loads_of_every_kind)
{
#define STEADY "--mu 0.3 --formulation steady --creep-ratio 0.5 "
    static const char *const through[] = {
        "crack",
        HERTZ "--mu 0.3",
        HERTZ "--mu 0.3 --shift 1e-4",
        HERTZ "--mu 0.3 --force-ratio 0.5",
        HERTZ "--mu 0.3 --formulation steady --force-ratio 0.5",
        HERTZ "--mu 0.3 --formulation steady --creep 5e-4 --support hub",
        HERTZ STEADY "--support arc",
        HERTZ STEADY "--mu-fall 0.1 --slip-scale 100 --friction-law exponential --speed 1000",
        HERTZ STEADY "--mu-fall 0.1 --slip-scale 100 --friction-law rational --speed 1000",
        HERTZ STEADY "--conductivity 50 --heat-capacity 3.8 --speed 1000",
        HERTZ STEADY "--plane stress",
        HERTZ STEADY "--radius-b -1200",
        HERTZ STEADY "--mesh uniform --contact-elements 300",
        HERTZ STEADY "--mesh fitted",
        HERTZ STEADY "--mesh aligned",
        HERTZ "--mu 0.3 --formulation steady --creep-ratio 0.4 --gap gap.txt",
        HERTZ "--mu 0.3 --formulation transient --distance 8 --creep 5e-4 --steps 48",
        HERTZ "--mu 0.3 --formulation transient --history way.txt --steps 48",
        HERTZ "--fluid pressure --passes 2",
        "crack --similar --support halfplane --radius 1000 --mu 0.3 --history shift.txt",
        "crack --example rail",
        "crack --example roll",
        "crack --example heat",
        "crack --example falling-friction",
        "crack --example wear",
        "crack --example two-bodies",
        "crack --example hertz",
        "crack --example paper",
        "crack --example by-hand",
        "crack --example carter",
        "crack --example cattaneo-to-carter"};
    static const char *const refused[][2] = {
        {HERTZ STEADY "--layer-thickness 2", "homogeneous and elastic only"},
        {HERTZ STEADY "--relaxation-time 0.1 --relaxation-ratio 1 --speed 100",
         "homogeneous and elastic only"},
        {HERTZ "--mu 0.3 --history shift.txt", "the history has a column load"},
        {HERTZ "--mu 0.3 --over creep", "unknown option '--over'"}};
    write_file("gap.txt", "x gap\n-4 0.008\n-2 0.002\n0 0\n2 0.002\n4 0.008\n");
    write_file("way.txt", "distance creep\n0 0\n4 1e-3\n");
    write_file("shift.txt", "load shift\n20 0\n40 1e-4\n40 -1e-4\n");
    for (size_t k = 0; k < sizeof through / sizeof *through; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        held_json *root = run_json(through[k]);
        CHECK_MAX(in_summary(root, "residual"), 1e-8, "%s", through[k]);
        CHECK_MAX(-in_summary(root, "K_I_min"), 1e-12, "%s", through[k]);
        CHECK_MAX(1e-3, in_summary(root, "delta_K_II"), "%s", through[k]);
    }
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++)
        check_refused(refused[k][0], 64, refused[k][1]);
    check_refused("crack --example layer", 65, "homogeneous and elastic only");
}

/* What means nothing is refused by its name, and so is what would have no digits: a crack of 1e5
 * half-widths, whose elements are longer than the contact, had a K_II a third off. */
TEST(what_means_nothing_is_refused)
{
    static const char *const refused[][2] = {
        {"--history shift.txt --steps 4", "--steps: a contact at rest stays at --from"},
        {"--half-width 1 --mu 0 --unloaded --remote-stress 5 --from 1", "--from: not together"},
        {"--half-width 1 --mu 0 --unloaded --remote-stress 5 --to 1", "--to: not together"},
        {"--half-width 1 --mu 0 --unloaded --remote-stress 5 --steps 9", "--steps: not together"},
        {"--half-width 1 --mu 0 --unloaded --remote-stress 5 --passes 2", "--passes: nothing"},
        {"--half-width 1 --mu 0 --grow-steps 3", "--grow-steps: of a crack that grows"},
        {"--half-width 1 --mu 0 --paris-range mode-II", "--paris-range: of a crack that grows"},
        {"--half-width 1 --mu 0 --crack-length 1e5", "--crack-length: 40 elements along a crack"},
        {"--half-width 1 --mu 0 --crack-elements 20 --paris 1e-9,3 --grow-to 1e4 --grow-steps 1",
         "--crack-elements: 20 elements along a crack of 10000 half-widths"},
        {"--half-width 1 --mu 0 --at 1", "--at: only with --plot-crack"},
        {"--half-width 1 --mu 0 --crack-length 1e300", "--crack-length: expected a size"},
        {"--half-width 1 --mu 0 --crack-depth 1e12", "--crack-depth: at 1e+12 half-widths"},
        {"--half-width 1 --mu 0 --crack-mouth 1e17", "--crack-mouth: at 1e+17 half-widths"},
        {"--half-width 1 --mu 0 --crack-friction 1e300", "--crack-friction: expected a size"},
        {"--half-width 1 --mu 0 --remote-stress 1e300", "--remote-stress: expected a size"},
        {"--half-width 1 --mu 0 --from -1e6", "--from: 120 steps of 8333.38 half-widths"},
        {"--half-width 1 --mu 0 --to 1e300", "--to: expected a size"}};
    char line[200];

    write_file("shift.txt", "load shift\n20 0\n40 1e-4\n40 -1e-4\n");
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line, "crack --similar --support halfplane %s", refused[k][0]);
        check_refused(line, 64, refused[k][1]);
    }
}

/* A long crack feels the contact as a point force: K_II grows with 1/sqrt(length). */
TEST(a_long_crack_feels_a_point_force)
{
    double scaled[2];

    for (int k = 0; k < 2; k++) {
        char line[200];
        snprintf(line, sizeof line,
                 HERTZ "--mu 0 --crack-angle 90 --crack-friction 0 --crack-length %d "
                       "--crack-elements %d --steps 24 --contact-elements 20",
                 k ? 3000 : 300, k ? 160 : 80);
        held_json *root = run_json(line);
        scaled[k] = in_summary(root, "K_II_max") * sqrt(k ? 3000.0 : 300.0);
        CHECK_MAX(-in_summary(root, "K_I_min"), 0.0, "K_I of %d", k);
    }
    CHECK_REL(scaled[1], scaled[0], 5e-3, "K_II sqrt(length)");
}

/* Under a stiff wheel K_II falls by a sixth, between similar bodies by less; where the
 * crack is far from the contact nothing changes. */
TEST(coupled)
{
    static const struct {
        const char *bodies;
        double alone, coupled;
    } want[] = {{"--young 1e13 --young-b 1e5", 0.1508, 0.1268}, {"--similar", 0.1508, 0.137}};
    char line[300];
    for (size_t k = 0; k < 2; k++)
        for (int both = 0; both < 2; both++) {
            if (!is_in_turn((int)k, 2))
                continue;
            snprintf(line, sizeof line,
                     "crack %s --support halfplane --half-width 1 --radius 1000 --mu 0 "
                     "--crack-elements 10 --contact-elements 32 --steps 60 %s",
                     want[k].bodies, both ? "--coupled" : "");
            held_json *root = run_json(line);
            CHECK_ABS(in_summary(root, "K_II_max") / scale_of(root),
                      both ? want[k].coupled : want[k].alone, 2e-3, "%s", line);
            if (both)
                CHECK_MAX(1.1 * scale_of(root) / sqrt(M_PI), in_summary(root, "max_pressure"),
                          "at the mouth it is singular");
        }
    held_json *far = run_json(HERTZ "--mu 0 --contact-elements 32 --crack-elements 10 --coupled "
                                    "--crack-mouth 9 --from -9 --to -8 --steps 4");
    CHECK_REL(in_summary(far, "max_pressure") * sqrt(M_PI), scale_of(far), 3e-3, "far away");
    /* steady contacts of so many elements are solved without a matrix */
    if (is_in_turn(0, 4)) {
#define MANY HERTZ "--mu 0 --contact-elements 200 --crack-elements 10 --coupled "
        held_json *rest = run_json(MANY), *steady = run_json(MANY "--formulation steady");
        CHECK_REL(in_summary(steady, "K_II_max"), in_summary(rest, "K_II_max"), 1e-9, "K_II max");
    }
    check_refused("crack --support halfplane --half-width 1 --mu 0 --coupled", 64, "rigid");
    check_refused(HERTZ "--mu 0.1 --coupled", 64, "--mu 0");
    check_refused(HERTZ "--mu 0 --coupled --fluid trapped", 64, "without fluid");
    check_refused(HERTZ "--mu 0 --coupled --unloaded --remote-stress 1", 64,
                  "--coupled: not together with --unloaded");
}

/* Friction of 0.4 between the faces turns the crack of 45 degrees upwards by 70.5 degrees
 * (pure K_II): a step of three half-widths leaves the body, the summary and the note say
 * so. */
TEST(back_to_the_surface)
{
    static const char *const line =
        HERTZ "--mu 0 --crack-friction 0.4 --crack-angle 45 --paris 1e-12,3 --growth "
              "tension --grow-to 4 --grow-steps %d --units inch --half-width 1mm --radius "
              "1000mm --young 94500MPa";
    char text[300];
    for (int steps = 1; steps <= 8; steps += 7) {
        snprintf(text, sizeof text, line, steps);
        held_json *root = run_json(text);
        const json_t *growth = json_object_get(root, "growth");
        const size_t n = json_array_size(json_object_get(growth, "length"));
        CHECK_ABS(entry(growth, "angle", 0), 45.0, 1e-9, "as it is given");
        if (steps == 1) {
            assert_true(json_is_true(json_object_get(growth, "surfaced")));
            assert_int_equal(n, 1);
            /* behind the note that the rest of the material is assumed */
            assert_non_null(
                strstr(json_string_value(json_array_get(json_object_get(root, "notes"), 1)),
                       "back to the surface beyond a length of 0.03937 in: a piece"));
        } else {
            CHECK_ABS(entry(growth, "angle", 1), 45.0 - 70.528779365, 1e-6, "upwards");
            for (size_t k = 0; k < n; k++)
                CHECK_MAX(entry(growth, "tip_y", k), 0.0, "below the surface");
        }
    }
}

/* A study of cracks is `rollbem crack` case by case, with its error bars, in units, from
 * a case file, and it goes on where it was cut. */
#define VARIED "sweep cracks.ini --vary-1 'crack-length 0.5 1' --vary-2 'crack-angle 30 60' "

/* The error bar of a number of the pass holds this value, and is at most so wide. */
static void check_bar(const char *line, const char *name, double want, double most)
{
    held_json *root = run_json(line);
    const double bar = number_in(json_object_get(json_object_get(root, "summary"), "errors"), name);
    CHECK_ABS(in_summary(root, name), want, bar, "%s", line);
    CHECK_MAX(bar, most, "%s", line);
}

/* Cracks much shorter than the contact, and the bars of their K: another mesh of contact and
 * crack, and other positions, stay within them. */
TEST(short_cracks)
{
    static const struct {
        const char *options, *name;
        double want; /* of 800 contact elements, 80 of the crack, 2400 positions */
    } rows[] = {
        {"--mu 0 --crack-angle 30 --crack-friction 0.1 --crack-length 0.05 ", "delta_K_II", 0.5925},
        {"--mu 0 --fluid trapped --crack-length 0.1147 ", "K_I_max", 0.6262},
        {"--mu 0 --fluid trapped --closing located --crack-length 0.1147 ", "K_I_max", 0.6262},
        {"--mu 0.3 --formulation steady --creep-ratio -3 --fluid trapped --closing located "
         "--crack-length 0.1147 ",
         "K_I_max", 4.0836}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        char line[400];
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(line, sizeof line,
                 "crack --similar --support halfplane --radius 1000 --half-width 1 "
                 "--crack-elements 20 --error %s",
                 rows[k].options);
        check_bar(line, rows[k].name, rows[k].want, k == 1 ? INFINITY : 0.12 * rows[k].want);
    }
}

/* Where the contact changes from step to step its errors go to and fro with the mesh: twice the
 * difference between two meshes held neither of these. */
TEST(bars_of_histories_hold)
{
    static const struct {
        const char *options, *name;
        double want, most; /* of 1000 contact elements, 80 of the crack; of 1500, 200 */
    } rows[] = {{"--mu 0.3 --half-width 1 --formulation transient --distance 12 --creep-ratio 0.5 "
                 "--crack-angle 90 --crack-length 0.3 --crack-friction 0.3",
                 "K_II_max", 4.7540, 0.1},
                {"--mu 0.5 --formulation static --history there.txt --crack-angle 45 "
                 "--crack-length 0.1 --crack-friction 0 --from 0.9",
                 "K_II_min", -5.16977, 0.02}};
    write_file("there.txt", "load force_ratio\n90 0\n90 0.5\n60 0.2\n90 -0.5\n90 0.3\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        char line[500];
        snprintf(line, sizeof line,
                 "crack --similar --support halfplane --gap parabola --young 210000 --poisson 0.3 "
                 "--radius 1000 --error %s",
                 rows[k].options);
        check_bar(line, rows[k].name, rows[k].want, rows[k].most);
    }
}

/* The half-width is that of the loads of the history; lengths with a unit need none. */
TEST(fretting_has_its_own_half_width)
{
#define FRETTING                                                                                   \
    "crack --similar --support halfplane --gap parabola --young 210000 --poisson 0.3 --radius "    \
    "1000 --mu 0.5 --formulation static --history fretting.txt --crack-angle 90 --crack-friction " \
    "0 --contact-elements 100 "
    write_file("fretting.txt", "load force_ratio\n90.62286500739786 0\n90.62286500739786 0.6\n"
                               "90.62286500739786 0\n90.62286500739786 -0.6\n"
                               "90.62286500739786 0\n90.62286500739786 0.6\n");
    held_json *root = run_json(FRETTING "--crack-length 0.05 --from 1 --error"),
              *mm = run_json(FRETTING "--crack-length 0.05mm --from 1000um");
    CHECK_REL(in_summary(root, "half_width"), 1.0, 1e-6, "half-width");
    CHECK_REL(in_summary(root, "K_I_max"), 9.717, 5e-4, "K_I");
    CHECK_REL(in_summary(mm, "K_I_max"), in_summary(root, "K_I_max"), 1e-6, "with units");
    const json_t *errors = json_object_get(json_object_get(root, "summary"), "errors");
    CHECK_ABS(in_summary(root, "delta_K_II"), 4.4663, number_in(errors, "delta_K_II"),
              "in its bar");
    CHECK_ABS(in_summary(mm, "crack_length"), 0.05, 1e-12, "length");
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(mm, "inputs"), "crack-length")),
        "0.05mm");
    held_json *unloaded = run_json(FRETTING "--unloaded --remote-stress 10 --crack-length 0.05");
    CHECK_REL(in_summary(unloaded, "K_I_max"), 11.2152 * sqrt(M_PI * 0.05), 1e-3, "of 0.05 mm");
    check_refused("crack --support halfplane --mu 0 --unloaded --remote-stress 10", 64,
                  "give them with a unit");
    held_json *absolute = run_json("crack --support halfplane --mu 0 --unloaded --remote-stress 10 "
                                   "--crack-angle 90 --crack-length 0.05mm");
    CHECK_REL(in_summary(absolute, "K_I_max"), 11.2152 * sqrt(M_PI * 0.05), 1e-3, "the same");
    /* under an approach the half-width is that of the load that is computed */
    held_json *approach =
        run_json("crack --similar --support halfplane --gap parabola --radius 1000 "
                 "--approach 0.002 --mu 0 --crack-elements 8 --steps 30");
    CHECK_REL(in_summary(approach, "half_width"),
              number_in(json_object_get(approach, "contact"), "hertz_half_width"), 1e-12,
              "half-width");
}

/* What a pass says of its positions: only what is so. */
TEST(positions_say_what_they_miss)
{
#define SHORT_PASS                                                                                 \
    "crack --similar --support halfplane --radius 1000 --half-width 1 --crack-elements 8 "         \
    "--contact-elements 20 --mu 0 "
    static const struct {
        const char *line, *note;
        int says;
    } rows[] = {{SHORT_PASS "--crack-mouth -0.5", "from the mouth", 0},
                {SHORT_PASS "--crack-mouth -0.5 --from -6", "5.5 half-widths from the mouth", 1},
                {SHORT_PASS "--steps 120", "Positions are", 0},
                {SHORT_PASS "--steps 120 --crack-length 0.05", "take at most 0.005", 1},
                {SHORT_PASS "--crack-length 0.05", "Positions are", 0},
                {SHORT_PASS "--formulation transient --creep 0 --distance 3",
                 "does not reach the crack: it ends 2", 1},
                {SHORT_PASS "--formulation transient --creep 0 --distance 7", "does not reach", 0},
                {SHORT_PASS "--to -3", "does not reach the crack: it ends 2", 1}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        held_json *root = run_json(rows[k].line);
        const json_t *notes = json_object_get(root, "notes");
        int said = 0;
        for (size_t i = 0; i < json_array_size(notes); i++)
            said |= strstr(json_string_value(json_array_get(notes, i)), rows[k].note) != NULL;
        if (said != rows[k].says)
            fail_msg("%s: '%s' is %s", rows[k].line, rows[k].note, said ? "said" : "not said");
    }
}

TEST(studies)
{
    static const char *const names[] = {"K_I_max", "K_II_max", "delta_K_II", "K_II_min_at"};
    char line[300], heading[60];
    write_file("cracks.ini", "[body-a]\nradius = 1000\nsupport = halfplane\n[body-b]\nsimilar = "
                             "yes\n[normal]\nhalf-width = 1\n[friction]\nmu = 0\n[crack]\n"
                             "remote-stress = 20MPa\ncrack-elements = 12\n");
    json_t *study = run_json(VARIED "--units inch --error --jobs 2");
    const json_t *table = json_object_get(study, "table");
    for (size_t k = 0; k < 4; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(line, sizeof line,
                 "crack cracks.ini --units inch --error --crack-length %g --crack-angle %d",
                 k < 2 ? 0.5 : 1.0, k % 2 ? 60 : 30);
        held_json *one = run_json(line);
        const json_t *errors = json_object_get(json_object_get(one, "summary"), "errors");
        for (size_t j = 0; j < sizeof names / sizeof *names; j++) {
            const char *unit = j == 3 ? "in" : "psi.in^0.5";
            snprintf(heading, sizeof heading, "%s_%s", names[j], unit);
            CHECK_REL(entry(table, heading, k), in_summary(one, names[j]), 1e-12, "%s", heading);
            snprintf(heading, sizeof heading, "error_%s_%s", names[j], unit);
            if (j < 3)
                CHECK_REL(entry(table, heading, k), number_in(errors, names[j]), 1e-9, "%s",
                          heading);
        }
    }
    CHECK_ABS(number_in(json_object_get(study, "inputs"), "crack-elements"), 12.0, 0.0, "inputs");
    json_decref(study);

    assert_int_equal(rollbem(VARIED "--quiet --output all.tsv --map m.svg"), 0);
    assert_int_equal(shell("head -6 all.tsv > part.tsv && grep -q '</svg>' m.svg"), 0);
    assert_int_equal(shell("sed -i 's/all.tsv --map m.svg/part.tsv/' part.tsv"), 0);
    assert_int_equal(rollbem(VARIED "--quiet --output part.tsv"), 0);
    assert_int_equal(shell("grep -v '^#' all.tsv > a; grep -v '^#' part.tsv | cmp - a"), 0);
    assert_int_equal(rollbem(VARIED "--crack-friction 0.4 --quiet --output part.tsv"),
                     73); /* another study */

    /* loads with steps of their own; trapped fluid; a coupled contact */
    json_t *steps =
        run_json("sweep " CONTACT "--mu 0.3 --increments 3 --shift 2e-4 --vary-1 'crack-mouth "
                 "0.7 0.9' --crack-elements 10");
    CHECK_MAX(1e-4, fabs(entry(json_object_get(steps, "table"), "K_II_max_MPa.mm^0.5", 1)),
              "pressing tears the crack");
    json_decref(steps);
    held_json *both =
        run_json("sweep " CONTACT "--mu 0 --coupled --vary-1 'contact-elements 16 24' "
                 "--crack-elements 8 --steps 48 --results half_width");
    CHECK_MAX(25.0, entry(json_object_get(both, "table"), "max_pressure_MPa", 1),
              "that of the contact that feels the crack");
    CHECK_REL(entry(json_object_get(both, "table"), "half_width_mm", 1), 1.0, 0.1,
              "of the contact");

#define STUDY "sweep " CONTACT "--mu 0 "
    check_refused(STUDY "--vary-1 'crack-angle 30 180'", 64,
                  "case 2: crack-angle: expected more than 0");
    check_refused(STUDY "--vary-1 'crack-elements 3 30'", 64, "case 1: crack-elements");
    check_refused(STUDY "--vary-1 'crack-angle 30' --derivatives half_width", 64, "have none");
    check_refused(STUDY "--vary-1 'fluid 1 2'", 64, "none, trapped or pressure");
    check_refused(STUDY "--vary-1 'crack-angle 30' --paris 1e-12,3", 64, "--paris");
    check_refused(STUDY "--vary-1 'crack-angle 30' --results max_shear", 64,
                  "no result 'max_shear'");
    check_refused(STUDY "--vary-1 'crack-angle 30' --error --results error_half_width", 64,
                  "no error bar");
    check_refused(STUDY "--vary-1 'steps 10' --crack-angle 30", 64, "jump over");
    check_refused(STUDY "--vary-1 'crack-angle 30' --accuracy 0.1", 64, "refine");
    assert_int_equal(rollbem(STUDY "--vary-1 'crack-angle 10 30' --crack-elements 20"),
                     64); /* known with its first solution only: the row says so */
}

/* The complete passes, or the complete lengths, are there. */
/* Ended after so many seconds; NULL: before a pass, or a length, was complete. */
static json_t *interrupted(const char *options, double seconds)
{
    char line[500];
    snprintf(line, sizeof line,
             "rm -f long.json; \"$R\" " HERTZ "--mu 0.3 --steps 200 %s --json --quiet --output "
             "long.json & p=$!; " WHEN_CAUGHT(INT_CAUGHT) "sleep %g; kill -INT $p; wait $p",
             options, seconds);
    assert_int_equal(shell(line), 1);
    return json_load_file("long.json", 0, NULL);
}

TEST(an_interrupted_run_keeps_its_passes)
{
    static const char *const more[] = {"--passes 1000", "--paris 1e-9,3 --grow-steps 60"};
    for (int k = 0; k < 2; k++) {
        if (!is_in_turn(k, 2))
            continue;
        char words[100];
        held_json *root = NULL;
        for (double seconds = 0.1; !root && seconds < 30.0; seconds *= 2.0) /* slow machines */
            root = interrupted(more[k], seconds);
        assert_non_null(root);
        const json_t *grown = json_object_get(json_object_get(root, "growth"), "length");
        const double n = k == 0 ? in_summary(root, "passes") : (double)json_array_size(grown);
        snprintf(words, sizeof words, "interrupted after %s %.0f of %s", k == 0 ? "pass" : "length",
                 n, k == 0 ? "1000" : "61");
        assert_non_null(strstr(err, words));
        assert_true(n >= 1.0);
        const json_t *said = json_object_get(json_object_get(root, "summary"), "status");
        assert_string_equal(json_string_value(said), "interrupted");
        CHECK_REL((double)json_array_size(json_object_get(json_object_get(root, "table"), "K_I")),
                  k == 0 ? 201.0 * n : 201.0, 0.0, "whole passes");
    }
}

TEST(refusals)
{
    check_refused(HERTZ "--crack-angle 0", 64, "outside body B");
    check_refused(HERTZ "--crack-angle 180", 64, "outside body B");
    check_refused(HERTZ "--crack-angle -30", 64, "outside body B");
    check_refused(HERTZ "--crack-depth -1", 64, "--crack-depth: expected a number >= 0");
    check_refused(HERTZ "--crack-angle 12 --crack-elements 20", 64, "at least 40 elements");
    check_refused(HERTZ "--crack-angle 170 --crack-elements 20", 64, "at least 40 elements");
    check_refused(HERTZ "--crack-length 0", 64, "--crack-length");
    check_refused(HERTZ "--crack-elements 3", 64, "--crack-elements");
    check_refused(HERTZ "--steps 10", 64, "jump over the crack");
    check_refused(HERTZ "--from 2 --to 2", 64, "rolls towards +x");
    check_refused(HERTZ "--fluid trapped --crack-depth 1", 64, "mouth");
    check_refused(HERTZ "--closing located", 64, "only for --fluid trapped");
    check_refused(HERTZ "--unloaded", 64, "--remote-stress");
    check_refused(HERTZ "--unloaded --remote-stress 1 --fluid pressure", 64, "--unloaded");
    check_refused(HERTZ "--unloaded --remote-stress 1 --plot a.png", 64, "--plot");
    check_refused(HERTZ "--layer-thickness-b 3", 64, "body B");
    check_refused(HERTZ "--radius-b 2", 64, "half-plane");
    check_refused(HERTZ "--formulation transient --distance 12 --creep 0 --to 3", 64, "--to");
    check_refused(HERTZ "--formulation transient --distance 12 --creep 0 --steps 8", 64,
                  "jumps over the crack");
    check_refused(HERTZ "--accuracy 0.01", 64, "but no refinement");
    write_file("bad.ini", "[crack]\ncrack-angle = 0\n");
    check_refused("crack bad.ini", 65, "bad.ini");
}

RUN_TESTS(enter_folder, leave_folder)
