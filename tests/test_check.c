/* Results verified without the solver: valid ones of every kind are, any number that is
 * changed is found, what cannot be checked is refused. */
#include "cli_run.h"
#include "program/certificate/certificate.h"
#include "program/report/report.h"

#define SMALL " --contact-elements 16 --mu 0.3 "
#define TINY " --contact-elements 8 --mu 0.3 "
#define STEADY " --formulation steady "
#define STATES " --states "

static const char *const cases[] = {
    SMALL "--creep 0.1",
    SMALL "--support halfplane --load 100 --force-ratio 0.5",
    SMALL "--support halfplane --poisson 0.3 --load 100 --creep-ratio 0.4 --mesh fitted" STEADY,
    SMALL "--support hub --load 1000 --force-ratio 0.4 --mesh fitted --normals surface" STEADY,
    SMALL "--support halfplane --load 100 --creep 1e-4 --slip-operator second" STEADY,
    SMALL "--support arc --approach 0.01 --creep-ratio 0.4 --young-b 210000 --poisson-b 0.3 "
          "--radius-b 80 --gap parabola" STEADY,
    TINY
    "--support halfplane --young-b 70000 --poisson-b 0.3 --wheel-load 1000 --transverse-radius "
    "80 --creep-ratio 0.4 --strips 3" STEADY,
};

enum { CASES = sizeof cases / sizeof cases[0] };

/* Sequences of steps, by load and approach, force, creepage and shift; bodies that relax;
 * steps of another length than an element's. */
static const char *const histories[] = {
    SMALL STATES "--support halfplane --load 100 --young-b 210000 --increments 3 --shift 1e-4",
    SMALL STATES "--support halfplane --similar --half-width 0.3 --formulation transient "
                 "--distance 0.3 --force-ratio -0.5 --steps 4",
    SMALL STATES "--support halfplane --load 100 --relaxation-time 0.01,0.1 "
                 "--relaxation-ratio 1,0.5 --speed 100 --formulation transient --distance "
                 "0.3 --creep 1e-3",
};

enum { HISTORIES = sizeof histories / sizeof histories[0] };

static const char *const stresses[] = {
    "stress " SMALL "--support halfplane --load 100 --creep-ratio 0.4 --mesh fitted "
    "--grid 5x4 --shakedown" STEADY,
    "stress " SMALL "--support hub --load 100 --mesh fitted --outer-elements 24 "
    "--creep-ratio 0.5 --grid 6x4 --depth 0.4" STEADY,
    "stress " SMALL "--load 100 --creep-ratio 0.5 --points inside.txt" STEADY,
};

enum { STRESSES = sizeof stresses / sizeof stresses[0] };

static void write_points(void)
{
    assert_int_equal(shell("printf '0.1 0.02\n-0.1 0.3\n5 40\n' > inside.txt; "
                           "printf -- '-3 0.09\n-1 0.01\n0 0\n1 0.01\n3 0.09\n' > v.txt"),
                     0);
}

static rb_status certify(const json_t *root, rb_certificate_outcome *found, rb_message *why)
{
    FILE *lines = tmpfile();
    rb_case *words =
        rb_case_create(json_object_get(root, "crack") ? RB_CASE_CRACK : RB_CASE_SINGLE);
    assert_non_null(lines);
    assert_non_null(words);
    const rb_status s = rb_certificate_check(lines, "result", root, words, found, why);
    rb_case_free(words);
    fclose(lines);
    return s;
}

/* A case of "--name value" pairs. */
static rb_case *case_of(const char *given)
{
    char text[600], *name, *value;
    rb_case *words = rb_case_create(RB_CASE_SINGLE);
    assert_non_null(words);
    snprintf(text, sizeof text, "%s", given);
    for (name = strtok(text, " "); name; name = strtok(NULL, " ")) {
        value = strtok(NULL, " ");
        assert_non_null(value);
        CHECK_STATUS(rb_case_set(words, name + 2, value, RB_GIVEN_ARGUMENT, &message), RB_OK);
    }
    CHECK_STATUS(rb_case_resolve(words, &message), RB_OK);
    return words;
}

static void write_controls(void)
{
    assert_int_equal(
        shell("printf 'time load shift\\n0 10 0\\n0.1 100 1e-4\\n0.3 100 "
              "2e-4\\n0.4 20 0\\n' > rest.txt; printf 'distance load "
              "force\\n0 50 0\\n0 100 10\\n0.2 80 20\\n0.4 100 -10\\n' > "
              "way.txt; printf 'distance mu creep_ratio\\n0 0.3 0.5\\n"
              "0.4 0.3 0.5\\n0.8 0.1 0.5\\n' > wet.txt; printf 'mu load "
              "shift\\n0.2 100 0\\n0.4 120 1e-4\\n' > dry.txt; printf 'time "
              "load\\n0 100\\n1e-3 100\\n3e-3 50\\n' > calm.txt; printf 'load shift\\n100 0\\n60 "
              "1e-4\\n0 2e-4\\n100 1e-4\\n' > lift.txt; printf 'time load shift mu\\n0 200 1e-3 "
              "0.3\\n0.01 0 1e-3 0.2\\n5 0 1e-3 0.2\\n5.01 200 1.2e-3 0.2\\n' > heal.txt; printf "
              "'load force_ratio\\n90 0\\n90 0.6\\n90 -0.6\\n90 0.6\\n' > fret.txt"),
        0);
}

TEST(results_are_valid)
{
    static const char *const more[] = {
        "--support halfplane --load 100 --mu 0 --formulation steady --creep 1e-3",
        "--support halfplane --half-width 0.05 --similar",
        /* at rest on a smooth base Q = 0, which has derivatives like a force that is given */
        "--support halfplane --layer-thickness 2 --layer-base smooth --base-young 20000 "
        "--contact-elements 15 --approach 0.04 --derivatives=all",
        "--support halfplane --load 100 --mesh uniform --creep 1e-3" STEADY,
        /* fewer than the mesh has that would follow from the rest */
        "--support halfplane --load 100 --mesh uniform --slip-operator second --creep 1e-3 "
        "--contact-elements 5" STEADY,
        "--support arc --load 100 --mesh fitted --contact-elements 60 --creep 1e-3" STEADY,
        "--support hub --contact-elements 60 --mu 0.05 --poisson 0 --mesh aligned --tol 1e-8 "
        "--approach 0.01 --shift 1e-4 --similar --radius-b 60 --support-b hub",
        "--support hub --load 100 --similar --support-b hub --radius-b 30 --mu 0.1",
        "--support halfplane --load 100 --layer-thickness 1 --mu 0.2" STEADY "--creep 1e-4",
        "--support halfplane --load 100 --relaxation-time 0.01,0.1 --relaxation-ratio 1,2 "
        "--speed 10 --mu 0.2 --free-axle" STEADY,
        "--support halfplane --load 100 --mu 0.3 --creep-ratio 0.4 --contact-elements 1600" STEADY,
        "--support halfplane --load 100 --interlayer-normal 1e-6 --mesh aligned --mu 0.3 "
        "--creep-ratio 0.4" STEADY,
        "--support halfplane --load 100 --speed 1000 --conductivity 50 --heat-capacity 3.6 "
        "--mu 0.3 --creep-ratio 0.4" STEADY,
        "--support hub --hub-ratio 0.3 --young 1000 --poisson 0.4 --load 100 --force 10 "
        "--relaxation-time 1e-3,1e-2 --relaxation-ratio 1,2 --speed 1000 --mu 0.3 "
        "--mesh fitted --contact-elements 30" STEADY,
        "--support hub --cover-thickness 2 --core-young 2000 --young 8 --poisson 0.48 "
        "--half-width 4 --relaxation-time 1e-3 --relaxation-ratio 1 --speed 1000 --mu "
        "0.3 --creep-ratio 0.4 --normals surface --contact-elements 30" STEADY,
        "--support hub --cover-thickness 2 --young 8 --poisson 0.4 --load 1 --force-ratio -0.8 "
        "--relaxation-time 1e-3 --relaxation-ratio 1 --speed 1000 --mu 0.3 --young-b 20 "
        "--poisson-b 0.3 --radius-b 40 --relaxation-time-b 1e-4 --relaxation-ratio-b 2 "
        "--layer-thickness-b 1 --base-young-b 100 --contact-elements 30" STEADY,
        "--support hub --cover-thickness 4 --load 5000 --mu 0.3 --creep-ratio 0.4 --mesh aligned "
        "--contact-elements 40" STEADY,
        "--support hub --cover-thickness 4 --load 5000 --mu 0.3 --creep-ratio 0.4 --mesh uniform "
        "--contact-elements 160" STEADY,
        "--example paper",
        "--example hertz",
        "--example carter",
        "--example two-bodies",
        "--support hub --load 1000 --mu 0.3 --states --increments 4 --shift 0.001",
        "--support arc --approach 0.01 --mu 0.3 --states --formulation transient "
        "--distance 0.3 --creep-ratio 0.4",
        "--support halfplane --load 100 --mu 0.2 --states --formulation transient "
        "--distance 0.3 --creep 1e-3 --speed 3000 --conductivity 50 --heat-capacity 3.6",
        "--support halfplane --load 100 --mu 0.2 --states --formulation transient "
        "--distance 0.3 --force-ratio 0.4 --interlayer-tangential 1e-6 "
        "--layer-thickness 1 --young-b 3000 --increments 3",
        "--support hub --cover-thickness 5 --history rest.txt --formulation static "
        "--time-step 0.05 --mu 0.3 --states --relaxation-time 0.1 --relaxation-ratio 2",
        "--support halfplane --history lift.txt --mu 0.3 --states --young-b 3000 "
        "--contact-elements 20",
        "--support halfplane --history lift.txt --mu 0.3 --states --similar --increments 3",
        "--support halfplane --history fret.txt --mu 0.3 --states --similar --fretting "
        "--formulation static --contact-elements 30",
        "--support halfplane --load 100 --mu 0.3 --states --similar --formulation transient "
        "--creep 1e-3 --distance 3 --steps 2",
        "--support halfplane --history way.txt --formulation transient --mu 0.3 "
        "--states --gap parabola",
        "--support halfplane --similar --load 100 --history wet.txt --formulation "
        "transient --states",                       /* symmetric: its moment is rounding */
        "--support hub --history dry.txt --states", /* mu of the column, not of --mu */
        "--support hub --history calm.txt --mu 3 --states --contact-elements 20 "
        "--relaxation-time 1e-3 --relaxation-ratio 1",                  /* Q is rounding */
        "--support halfplane --load 0.25 --contact-elements 12",        /* a load below 1 */
        "--support halfplane --load 100 --contact-elements 12 --trace", /* by Lemke then
                                                                         */
        /* largest stresses in two places, on flat tops, next to other peaks, grids on the
         * ends of elements: a search ends elsewhere in the problem that is built again */
        "stress --support hub --load 100 --mu 0 --contact-elements 20 --grid 5x4",
        "stress --support halfplane --load 100 --mu 3 --contact-elements 31 --grid 5x4 "
        "--young-b 1e4 --radius-b 30 --mesh fitted",
        "stress --support arc --load 100 --mu 3 --contact-elements 20 --grid 5x4 --gap v.txt",
        "stress --support halfplane --load 100 --mu 0.3 --creep 1e-3 --gap v.txt "
        "--contact-elements 12 --grid 5x4 --shakedown" STEADY,
        /* two peaks, of which the one that is printed is lower by 2e-9 */
        "stress --radius 48.6053 --young 619.638 --poisson -0.5 --support hub --hub-ratio 0.350134 "
        "--load 7.5501 --mu 1e-9 --creep 0.017621 --contact-elements 31 --mesh fitted "
        "--grid 5x4" STEADY,
        /* next to incompressible, ut is rounding of un */
        "--support hub --mu 0.3 --mesh fitted --contact-elements 45 --load 100 "
        "--poisson 0.49 --young-b 1e5 --radius-b 80",
        /* its moment is rounding, and does not say from which step on it is steady */
        "--support halfplane --radius 311.738 --young 53.0919 --poisson -0.99 --radius-b "
        "182.150383828 --young-b 102.984482106 --poisson-b -0.199681 --approach 0.60666 --mu 1e-9 "
        "--gap parabola --formulation transient --creep-ratio -0.0438487 --distance 0.449681 "
        "--steps 2 --states --contact-elements 24",
        /* apart, with all but nothing left of what was there before */
        "--support halfplane --history heal.txt --states --contact-elements 12 "
        "--relaxation-time 0.01 --relaxation-ratio 1 --friction-law exponential --mu-fall 0.1 "
        "--memory 5e-3,2",
    };
    write_controls();
    write_points();
    for (size_t k = 0; k < CASES + HISTORIES + STRESSES + sizeof more / sizeof *more; k++) {
        char line[600];
        const size_t after = CASES + HISTORIES;
        if (!is_in_turn((int)k, k >= after + STRESSES ? 9 : 6))
            continue;
        const char *given = k < CASES              ? cases[k]
                            : k < after            ? histories[k - CASES]
                            : k < after + STRESSES ? stresses[k - after]
                                                   : more[k - after - STRESSES];
        snprintf(line, sizeof line,
                 "\"$R\" %s --json --quiet --output r.json 2>trace && \"$R\" check r.json", given);
        if (shell(line) != 0)
            print_error("%s\n%s%s", given, out, err);
        int numbers = 0; /* at least p, q and the gap of twelve elements */
        const char *valid = strstr(out, "r.json: valid: ");
        assert_non_null(valid);
        assert_int_equal(sscanf(valid, "r.json: valid: %d numbers", &numbers), 1);
        assert_true(numbers >= 36);
        assert_string_equal(err, "");
    }
}

/* One part in a million; what is zero but for rounding becomes 1e-3. */
static double changed(double x)
{
    return fabs(x) > 1e-9 ? x * (1.0 + 1e-6) : x + 1e-3;
}

static int missed;

static void expect_found(const json_t *root, const char *given, const char *key, int i)
{
    rb_certificate_outcome found = {.prove = 0};
    rb_message why = {.text = ""};
    if (certify(root, &found, &why) == RB_OK && found.violations == 0) {
        print_error("%s: a change of %s[%d] was not found\n", given, key, i);
        missed++;
    }
}

static void expect_violations(const json_t *root, int wanted)
{
    rb_certificate_outcome found = {.prove = 0};
    CHECK_STATUS(certify(root, &found, &message), RB_OK);
    assert_int_equal(found.violations, wanted);
}

/* A radius that a table of the gap has stays when that of B changes: the inputs name it. */
TEST(derivatives_of_a_radius_that_a_table_has)
{
    FILE *file = fopen("parabola.txt", "w");
    assert_non_null(file);
    for (int i = -150; i <= 150; i++)
        fprintf(file, "%.10g %.10g\n", 0.04 * i, 0.04 * i * 0.04 * i / 100.0);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(
        rollbem("--support halfplane --formulation static --contact-elements 14 "
                "--young-b 2e5 --radius-b -80 --gap parabola.txt --approach 0.04 --shift 0.002 "
                "--derivatives=hertz_half_width --json --output r.json"),
        0);
    CHECK_RUN(rollbem("check r.json"), 0, out, "r.json: valid");
    unlink("r.json");
    unlink("parabola.txt");
}

/* Given values that the result does not meet, and those that it does not depend on. */
/* Of one step and several, of a table, and with the proof in the result; bounds that are too good
 * are noticed, and tractions that belong to no solution. */
TEST(results_are_proved_without_the_solver)
{
    assert_int_equal(rollbemf("%s --json --output r.json", cases[2]), 0);
    CHECK_RUN(rollbem("check --prove r.json"), 0, out, "r.json: proved: zones exact, p within ");
    assert_int_equal(rollbemf("%s --json --output r.json", histories[1]), 0);
    CHECK_RUN(rollbem("check --prove r.json"), 0, out, "(5 of 5 steps proved)");
    assert_int_equal(rollbemf("%s --output r.tsv", cases[1]), 0);
    CHECK_RUN(rollbem("check --prove r.tsv"), 0, out, "r.tsv: proved: zones exact, p within ");
    CHECK_RUN(rollbemf("%s --prove --json --output r.json", cases[2]), 0, err,
              "  proof     proved");
    CHECK_RUN(rollbem("check r.json"), 0, out, "r.json: valid");
    assert_int_equal(shell("sed -i 's/\"stored_within\": [0-9.e-]*/\"stored_within\": 1e-20/' "
                           "r.json"),
                     0);
    CHECK_RUN(rollbem("check r.json"), 1, out, "violated: proof: stored_within");
    unlink("r.json");
    unlink("r.tsv");
}

TEST(every_changed_input_is_found)
{
    missed = 0;
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, 6))
            continue;
        int changes = 0;
        json_t *root = run_json(cases[k]), *value;
        json_t *all = json_object_get(root, "inputs"), *names = json_copy(all);
        const char *key;
        json_object_foreach(names, key, value)
        {
            if (!json_is_real(value))
                continue;
            json_object_set_new(all, key, json_real(changed(json_real_value(value))));
            expect_found(root, cases[k], key, 0);
            json_object_set(all, key, value);
            changes++;
        }
        json_decref(names);
        json_decref(root);
        assert_true(changes > 10);
    }
    assert_int_equal(missed, 0);
}

/* What the result itself says against a given value, with the hash made to fit. */
TEST(inputs_belong_to_the_result)
{
    static const struct {
        int which;
        const char *key;
    } inputs[] = {{0, "mu"},          {0, "young"}, {0, "radius"},      {0, "creep"},
                  {1, "force-ratio"}, {1, "load"},  {2, "creep-ratio"}, {2, "poisson"},
                  {3, "hub-ratio"},   {4, "creep"}, {5, "approach"},    {5, "radius-b"}};
    for (size_t k = 0; k < sizeof inputs / sizeof *inputs; k++) {
        held_json *root = run_json(cases[inputs[k].which]);
        json_t *all = json_object_get(root, "inputs");
        const double x = json_number_value(json_object_get(all, inputs[k].key)) * (1.0 + 1e-5);
        char value[40];
        rb_certificate_outcome found = {.prove = 0};
        json_object_set_new(all, inputs[k].key, json_real(x));
        rb_case *words = case_of(cases[inputs[k].which]);
        snprintf(value, sizeof value, "%.17g", x);
        CHECK_STATUS(rb_case_set(words, inputs[k].key, value, RB_GIVEN_ARGUMENT, &message), RB_OK);
        CHECK_STATUS(rb_case_resolve(words, &message), RB_OK);
        json_object_set_new(root, "input_hash", rb_report_json_input_hash(words));
        rb_case_free(words);
        CHECK_STATUS(certify(root, &found, &message), RB_OK);
        assert_true(found.violations > 0);
    }
}

/* The table of a gap, changed by what does not change the contact. */
TEST(files_belong_to_the_result)
{
    assert_int_equal(
        shell("awk 'BEGIN {for (x = -4; x < 4.01; x += 0.25) print x, x * x / 50}' > "
              "g.txt; \"$R\" --support halfplane --load 100 --mu 0.3 --gap g.txt --json "
              "--quiet --output r.json && \"$R\" check r.json"),
        0);
    assert_int_equal(shell("echo '# seen' >> g.txt; \"$R\" check r.json"), 1);
    assert_string_equal(out, "r.json: violated: input_hash: a file that the inputs name is not the "
                             "one of the result, or has changed since (g.txt of --gap)\n");
}

/* A load that is searched for is the same to the last bit where the zone that it had is given. */
TEST(searched_loads_are_found_again)
{
    static const char *const searched[] = {
        "--support halfplane --similar --max-pressure 50 --gap um.tsv",
        "--support halfplane --similar --max-pressure 150 --gap um.tsv",
        ("--support halfplane --similar --max-pressure 200 --gap um.tsv --mu 0.1 "
         "--formulation steady --creep-ratio 0.4"),
        "--support hub --max-pressure 150 --mu 0 --contact-elements 40",
        "--support halfplane --max-pressure 150 --mu 3 --mesh uniform"};
    assert_int_equal(shell("awk 'BEGIN {print \"x [mm]\\tgap [um]\"; for (x = -3; x < 3.01; x += "
                           "0.1) print x \"\\t\" x * x / 0.1}' > um.tsv"),
                     0);
    for (size_t k = 0; k < sizeof searched / sizeof *searched; k++)
        if (is_in_turn((int)k, 4))
            if (shellf("\"$R\" %s --json --quiet --output r.json && \"$R\" check r.json",
                       searched[k]) != 0)
                fail_msg("%s: %s%s", searched[k], out, err);
}

static void check_says(const char *make, int code, const char *part)
{
    const int got = shellf("{ %s ; } >r.json 2>/dev/null; \"$R\" check r.json", make);
    const char *text = code == 1 ? out : err;
    if (got != code || !strstr(text, part))
        print_error("%s: exit %d\n%s%s", make, got, out, err);
    assert_int_equal(got, code);
    assert_non_null(strstr(text, part));
    assert_null(strstr(out, "r.json: valid"));
}

/* The member of that name, or the entry of that number. */
static json_t *member(json_t *from, const char *name)
{
    return json_is_array(from) ? json_array_get(from, strtoul(name, NULL, 10))
                               : json_object_get(from, name);
}

/* Puts a value of JSON into its place, names and numbers with / between; "": takes away
 * what is there. */
static void edit(json_t *root, const char *path, const char *value)
{
    char text[100], *name, *next;
    json_t *new_one = *value ? json_loads(value, JSON_DECODE_ANY, NULL) : NULL;
    snprintf(text, sizeof text, "%s", path);
    for (name = text; (next = strchr(name, '/')) != NULL; name = next + 1) {
        *next = '\0';
        root = member(root, name);
    }
    const size_t i = strtoul(name, NULL, 10);
    const int done = json_is_array(root) ? new_one ? json_array_set_new(root, i, new_one)
                                                   : json_array_remove(root, i)
                     : new_one ? json_object_set_new(root, name, new_one)
                                         : json_object_del(root, name);
    if (done != 0)
        fail_msg("%s cannot be changed to '%s'", path, value);
}

/* What the check of a result with that change says; "": it is valid. */
static const char *said_of(const json_t *root, const char *path, const char *value)
{
    static char text[400000];
    FILE *lines = tmpfile();
    rb_case *words = rb_case_create(RB_CASE_SINGLE);
    json_t *other = json_deep_copy(root);
    rb_certificate_outcome found = {.prove = 0};
    rb_message why = {.text = ""};
    edit(other, path, value);
    const rb_status s = rb_certificate_check(lines, "r", other, words, &found, &why);
    rewind(lines);
    text[fread(text, 1, sizeof text - 1, lines)] = '\0';
    assert_int_equal(found.violations > 0, text[0] != '\0');
    if (s != RB_OK) {
        if (s != RB_EFORMAT)
            print_error("%s = %s: %s\n", path, value, why.text);
        CHECK_STATUS(s, RB_EFORMAT);
        snprintf(text, sizeof text, "%s", why.text);
    }
    fclose(lines);
    rb_case_free(words);
    json_decref(other);
    return text;
}

/* Of --all-solutions each is judged by itself; the last number of the last one counts. */
TEST(all_solutions_are_judged)
{
    IN_TURN(0, 3);
    static const char given[] =
        "--support halfplane --similar --radius 460 --young 209920 --poisson 0.28 --load "
        "3111.08 --speed 45000 --mu 0.18 --friction-law exponential --mu-fall 0.12 "
        "--slip-scale 5 --mesh uniform --slip-operator upstream --contact-elements 93 "
        "--zone 4.65 --creep 0.0009999 --all-solutions" STEADY;
    char line[600];
    snprintf(line, sizeof line,
             "\"$R\" %s --json --quiet --output all.json && \"$R\" check all.json", given);
    assert_int_equal(shell(line), 0);
    assert_non_null(strstr(out, "all.json: valid: "));
    assert_null(strstr(out, "residual 0\n")); /* the largest of all solutions */

    json_t *root = run_json(given), *all = json_object_get(root, "solutions");
    held_case *words = rb_case_create(RB_CASE_SINGLE);
    rb_certificate_outcome found = {.prove = 0};
    assert_int_equal(json_array_size(all), 3);
    for (int change = 0; change < 4; change++) {
        FILE *lines = tmpfile();
        json_t *wrong = json_deep_copy(root), *list = json_object_get(wrong, "solutions");
        json_t *q = json_object_get(json_object_get(json_array_get(list, 2), "table"), "q_MPa");
        char text[400] = "";
        assert_non_null(lines);
        if (change == 1) /* friction of an element that sticks */
            json_array_set_new(q, 60,
                               json_real(json_number_value(json_array_get(q, 60)) * (1.0 + 1e-6)));
        if (change == 2)
            json_array_set(list, 2, json_array_get(list, 1));
        if (change == 3)
            json_array_remove(list, 0), json_array_remove(list, 0);
        CHECK_STATUS(rb_certificate_check(lines, "r", wrong, words, &found, &message), RB_OK);
        rewind(lines);
        if (change == 0)
            assert_int_equal(found.violations, 0);
        else
            assert_non_null(fgets(text, sizeof text, lines));
        if (change == 1)
            assert_non_null(strstr(text, "r: solution 3: violated: "));
        if (change == 2)
            assert_string_equal(text, "r: violated: solutions 2 and 3 are the same\n");
        if (change == 3)
            assert_string_equal(text, "r: violated: the result is none of its solutions\n");
        fclose(lines);
        json_decref(wrong);
    }
    static const struct {
        const char *path, *value, *part;
    } edits[] = {
        {"solutions", "[]", "cannot be checked: no list of solutions"},
        {"solutions", "{}", "cannot be checked: no list of solutions"},
        {"solutions/1", "{}", "solution 2: cannot be checked: expected a summary and a"},
        {"solutions/1/table", "", "solution 2: cannot be checked: expected a summary and"},
        {"solutions/1/more", "1", "violated: solutions.2.more is no result of this case"},
        {"summary/status", "\"x\"", "r: cannot be checked: its status is"},
    };
    for (size_t k = 0; k < sizeof edits / sizeof *edits; k++)
        if (!strstr(said_of(root, edits[k].path, edits[k].value), edits[k].part))
            fail_msg("%s = %s: %s", edits[k].path, edits[k].value,
                     said_of(root, edits[k].path, edits[k].value));

    /* none of all slips: what is compared by its largest friction */
    json_t *still = json_deep_copy(root);
    for (size_t k = 0; k < 2; k++) {
        json_t *q =
            member(member(member(member(still, "solutions"), k ? "1" : "0"), "table"), "q_MPa");
        for (size_t i = 0; i < json_array_size(q); i++)
            json_array_set_new(q, i, json_real(0.0));
    }
    assert_non_null(strstr(said_of(still, "summary/iterations", "1000"),
                           "r: violated: solutions 1 and 2 are the same\n"));
    json_decref(still);

    /* one on other elements is another one */
    json_t *coarse =
        run_json("--support halfplane --similar --radius 460 --young 209920 --poisson 0.28 --load "
                 "3111.08 --speed 45000 --mu 0.18 --friction-law exponential --mu-fall 0.12 "
                 "--slip-scale 5 --mesh uniform --slip-operator upstream --contact-elements 92 "
                 "--zone 4.65 --creep 0.0009999 --all-solutions" STEADY);
    json_array_set(member(root, "solutions"), 2, member(member(coarse, "solutions"), "0"));
    assert_non_null(strstr(said_of(root, "summary/iterations", "1000"), "is missing"));
    json_decref(coarse);
    json_decref(root);
}

/* ---- Tables ------------------------------------------------------------------------ */

static int violations_of(const char *text, const rb_case *words)
{
    rb_certificate_outcome found = {.prove = 0};
    rb_message why = {.text = ""};
    FILE *lines = tmpfile();
    assert_non_null(lines);
    const rb_status s = rb_certificate_check_table(lines, "table", text, words, &found, &why);
    fclose(lines);
    return s == RB_OK ? found.violations : -1;
}

/* The number in that place of a line of them, changed. */
static void change_cell(const char *text, const char *line, int column, char *changed_text)
{
    for (int j = 0; j < column; j++)
        line = strchr(line, '\t') + 1;
    char *end;
    const double x = strtod(line, &end);
    const int is_zone = *end == '\n'; /* the last column of these cases */
    sprintf(changed_text, "%.*s%.17g%s", (int)(line - text), text,
            is_zone ? (double)(((int)x + 1) % 4) : changed(x), end);
}

/* A part of the cells, so that every column and every row is among them. */
TEST(every_changed_number_of_a_table_is_found)
{
    static char text[sizeof out], changed_text[sizeof out];
    for (int k = 0; k < CASES; k++) {
        if (!is_in_turn(k, 6))
            continue;
        int changes = 0;
        held_case *words = case_of(cases[k]);
        assert_int_equal(rollbem(cases[k]), 0);
        memcpy(text, out, sizeof text);
        assert_int_equal(violations_of(text, words), 0);
        int row = 0;
        for (const char *line = text; *line; line = strchr(line, '\n') + 1) {
            if (*line == '#' || *line == 'x')
                continue;
            for (int j = row++ % 5; j < 10; j += 5) {
                change_cell(text, line, j, changed_text);
                if (violations_of(changed_text, words) == 0)
                    print_error("%s: row %d, column %d\n", cases[k], row, j);
                assert_int_not_equal(violations_of(changed_text, words), 0);
                changes++;
            }
        }
        assert_true(changes > 30);
    }
}

/* Rounding of what is computed again adds no note to a force of 0.001 mu P and takes none away. */
TEST(a_note_begins_at_no_number_that_is_given)
{
    assert_int_equal(shell("for nu in 0 0.1 0.2 0.3 0.4; do \"$R\" --support halfplane --similar "
                           "--load 50 --mu 0.05 --young 10 --contact-elements 16 --formulation "
                           "steady --force-ratio 0.001 --poisson $nu --json --quiet >n.json; "
                           "\"$R\" check n.json || exit; done"),
                     0);
}

/* From the command line that the table quotes: a case file, options behind it, words in
 * quotes, several contacts. */
TEST(tables_are_valid_by_their_comments)
{
    static const char *const tables[] = {
        "case.ini --creep-ratio 0.2 --dump d",
        "--example carter --trace",
        "--support halfplane --load 100 --mu 0.3 --gap \"it's two humps.txt\"",
        "--support halfplane --load 100 --mu 0.3 --formulation steady --free-axle "
        "--layer-thickness 1",
        "--support hub --approach 0.01 --force-ratio -0.4 --mu 0.1",
        "--support halfplane --load 100 --mu 0.3 --formulation steady --free-axle",
        "--support halfplane --load 100 --mu 0.3 --formulation steady --creep-ratio 0 "
        "--yield-stress 20 --mesh uniform --interlayer-tangential 1e-5"};
    char line[600];
    assert_int_equal(
        shell("printf '[body-a]\\nsupport = halfplane\\n[friction]\\nmu = 0.3\\n[normal]\\n"
              "load = 100\\n[problem]\\nformulation = steady\\n' > case.ini; "
              "awk 'BEGIN {for (x = -4; x < 4.01; x += 0.25) { a = x < 0 ? -x - 2 : x - 2; "
              "print x, a * a / 50 }}' > \"it's two humps.txt\""),
        0);
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(line, sizeof line,
                 "\"$R\" %s --quiet > t.tsv 2>/dev/null; rm -rf d; \"$R\" check t.tsv "
                 "&& [ ! -e d ]",
                 tables[k]);
        const int code = shell(line);
        if (code || err[0])
            print_error("%s\n%s%s", tables[k], out, err);
        assert_int_equal(code, 0);
        assert_non_null(strstr(out, "t.tsv: valid: "));
    }
    /* Lines as an editor on Windows ends them; a return within a line hides nothing behind it. */
    snprintf(line, sizeof line, "\"$R\" %s --quiet | sed 's/$/\r/' > t.tsv; \"$R\" check t.tsv",
             tables[2]);
    assert_int_equal(shell(line), 0);
    snprintf(line, sizeof line,
             "\"$R\" %s --quiet | sed '/^# patch 2/s/$/ \r and more/' > t.tsv; \"$R\" check t.tsv",
             tables[2]);
    assert_int_equal(shell(line), 1);
    snprintf(line, sizeof line,
             "\"$R\" %s --quiet | sed '/^# patch 2/s/P = ./P = 7/' > t.tsv; \"$R\" check t.tsv",
             tables[2]);
    assert_int_equal(shell(line), 1);
    assert_non_null(strstr(out, "comments.10, entry 15: printed 7"));
    snprintf(line, sizeof line,
             "\"$R\" %s --quiet | sed '/^# patch 1/d' > t.tsv; \"$R\" check t.tsv", tables[2]);
    assert_int_equal(shell(line), 1);
    assert_string_equal(out, "t.tsv: violated: comments: 10 entries, expected 11\n");
    snprintf(line, sizeof line,
             "\"$R\" %s --quiet | sed '/^# patch 2/s/from/from x/' > t.tsv; \"$R\" check t.tsv",
             tables[2]);
    assert_int_equal(shell(line), 1);
    assert_non_null(strstr(out, "t.tsv: violated: comments.10: 20 entries, expected 19"));
    snprintf(line, sizeof line,
             "\"$R\" %s --quiet | sed '/^# .* solved; residual/s/residual.*/residual 1e-3/' "
             "> t.tsv; \"$R\" check t.tsv",
             tables[4]);
    assert_int_equal(shell(line), 1);
    assert_non_null(strstr(out, ": printed 0.001, recomputed"));
}

/* The residual of a table has three digits: the last one may have been rounded up or down, and no
 * more.  With this tolerance the residual is that of the law, far above rounding. */
TEST(what_a_comment_states_is_rounded)
{
    static const char run[] =
        "\"$R\" --similar --support halfplane --half-width 1 --radius 100 --mu .2 "
        "--friction-law exponential --mu-fall .1 --slip-scale 500 --speed 100000 "
        "--formulation steady --creep-ratio .5 --contact-elements 40 --tol 1e-6 --quiet";
    char line[600];
    for (int more = -2; more <= 2; more++) {
        snprintf(line, sizeof line,
                 "%s | awk '/; residual/ {r = $NF; n = length(r); e = substr(r, n - 3); "
                 "d = substr(r, 1, n - 4); sub(/residual .*/, sprintf(\"residual %%.2f%%s\", "
                 "d + %d / 100, e))} 1' > t.tsv; \"$R\" check t.tsv",
                 run, more);
        assert_int_equal(shell(line), abs(more) > 1);
        assert_non_null(strstr(out, abs(more) > 1 ? "violated: comments" : "t.tsv: valid"));
    }
}

TEST(tables_that_cannot_be_checked_are_refused)
{
    static const char half[] = "\"$R\" --support halfplane --load 100 --mu 0.3 ";
    char line[500];
    static const struct {
        const char *options, *part;
    } kinds[] = {{"--increments 3 --shift 1e-4", "take --json --states"},
                 {"--formulation steady --creep 1e-3 --units si", "units other than mm"},
                 {"--format csv", "expected the JSON of a result, or a table with its comments"},
                 {"| sed 's/--mu 0.3/--mu x/'",
                  "r.json: cannot be checked: the command line in its comments: --mu: expected"},
                 {"| sed 's/--mu 0.3/none.ini/'", "none.ini: No such file"},
                 {"| sed '/^# static/d'", "expected a table of a single case, with its comments"},
                 {"| sed '/^# static/s/residual .*/residual x/'",
                  "expected a table of a single case, with its comments"},
                 {"| sed '1s/^/# ; residual 1\\n/'", "its status is not solved"},
                 {"| sed '/^# static/s/solved/not solved/'", "its status is not solved"},
                 {"| sed '/^[-0-9]/d'", "no numbers"},
                 {"| awk '!/^[-0-9]/ || n++ < 2'", "its table has no elements"},
                 {"| sed '/^-/s/\t/\tx/'", "expected a number"},
                 {"| sed 's/h_mm/width/'", "table: expected"}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line, "%s%s", half, kinds[k].options);
        check_says(line, 65, kinds[k].part);
    }
    check_says("\"$R\" curve --support halfplane --load 100 --mu 0.3 --from 0 --to 1 --points 3",
               65, "a table of rollbem curve (only tables of single cases can)");
    check_says("printf '# rollbem 0.1.0\\n# rollbem \\\\\\n1 2\\n'", 65, "r.json: cannot");
    check_says("printf '# rollbem 0.1.0\\n# rollbem\\n1 2\\n'", 65,
               "expected a table of a single case, with its comments");
    check_says("echo 1 2", 65, "expected the JSON of a result, or a table");
}

/* ---- Derivatives ------------------------------------------------------------------- */

/* Of each control and operator, on elements that stay, grow and are fitted, of columns, by
 * inputs at an end of their range, with standard deviations. */
static const char *const slopes[] = {
    TINY "--support halfplane --load 100 --creep-ratio 0.4 --derivatives --tolerance "
         "mu=0.02,radius=1%" STEADY,
    TINY "--support halfplane --approach 0.001 --creep-ratio 0.4 --mesh fitted --poisson 0.3 "
         "--derivatives tangential_load,creepage,p,slip" STEADY,
    TINY "--support hub --load 100 --force-ratio 0.4 --similar --derivatives "
         "approach,contact_to,q --tolerance load=1%" STEADY,
    TINY "--support halfplane --similar --layer-thickness 1 --base-young 3e5 --load 100 "
         "--creep 1e-4 --derivatives approach,tangential_load,max_strain" STEADY,
    "--contact-elements 24 --mu 0.3 --support halfplane --similar --load 100 --creep-ratio 0.4 "
    "--smooth-derivatives tangential_load,approach" STEADY,
    TINY STATES "--support halfplane --load 100 --young-b 210000 --increments 2 --shift 1e-4 "
                "--derivatives tangential_load,approach --tolerance mu=0.02",
    TINY STATES "--support halfplane --similar --load 100 --formulation transient --distance 0.5 "
                "--force-ratio -0.5 --steps 3 --derivatives creepage:mu",
};

/* The names of an object, or the numbers of the entries of a list. */
static json_t *members(const json_t *of)
{
    json_t *names = json_is_object(of) ? json_copy((json_t *)of) : json_object();
    char number[20];

    for (unsigned i = 0; i < (unsigned)json_array_size(of); i++) {
        snprintf(number, sizeof number, "%u", i);
        json_object_set(names, number, json_array_get(of, i));
    }
    return names;
}

/* What all numbers below change a result by when an input changes by its value. */
static double largest_effect(const json_t *of, const json_t *inputs, double weight)
{
    double most = json_is_number(of) ? fabs(json_number_value(of)) * weight : 0.0;
    json_t *names = members(of), *value;
    const char *key;

    json_object_foreach(names, key, value)
    {
        const json_t *input = json_object_get(inputs, key);
        most = fmax(most,
                    largest_effect(value, inputs, input ? fabs(json_number_value(input)) : weight));
    }
    json_decref(names);
    return most;
}

/* Changes every text, every null and by `part` every number below, but those by inputs that are
 * 0; returns how many.  Below a hundredth of the largest effect, a part of that. */
static int change_slopes(json_t *of, const json_t *inputs, double part, double most, double weight)
{
    json_t *names = members(of), *value;
    int changes = 0;
    const char *key;

    json_object_foreach(names, key, value)
    {
        const json_t *input = json_object_get(inputs, key);
        const double by = input ? fabs(json_number_value(input)) : weight;
        const double x = json_number_value(value), least = 1e-2 * most / by;
        if (json_is_object(value) || json_is_array(value))
            changes += change_slopes(value, inputs, part, most, by);
        else if (!json_is_number(value) || (by > 0.0 && most > 0.0)) {
            char place[40];
            json_t *other = json_is_string(value) ? json_string("other")
                            : json_is_null(value)
                                ? json_real(1.0)
                                : json_real(x + copysign(part * fmax(fabs(x), least), x));
            snprintf(place, sizeof place, "%.39s", key);
            changes++;
            if (json_is_array(of))
                json_array_set_new(of, strtoul(place, NULL, 10), other);
            else
                json_object_set_new(of, place, other);
        }
    }
    json_decref(names);
    return changes;
}

/* Each has its own line. */
static int change_all_slopes(json_t *root, json_t *in, const char *name, double part)
{
    json_t *own = json_object_get(in, name), *kept = json_deep_copy(own), *one;
    const json_t *inputs = json_object_get(root, "inputs");
    const char *key;
    int changes = 0;

    json_object_foreach(own, key, one)
    {
        const double x = json_number_value(one), most = largest_effect(one, inputs, 1.0);
        if (!json_is_number(one))
            changes += change_slopes(one, inputs, part, most, 1.0);
        else if (x != 0.0) {
            json_real_set(one, x * (1.0 + part));
            changes++;
        }
    }
    expect_violations(root, changes);
    json_object_set_new(in, name, kept);
    return changes;
}

TEST(every_changed_derivative_is_found)
{
    static const char *const names[] = {"derivatives", "smooth_derivatives", "tolerances"};
    int changes = 0, results = 0;
    for (size_t k = 0; k < sizeof slopes / sizeof *slopes; k++) {
        if (!is_in_turn((int)k, 2))
            continue;
        results++;
        held_json *root = run_json(slopes[k]);
        json_t *history = json_object_get(root, "history"), *in = history ? history : root;
        expect_violations(root, 0);
        for (size_t j = 0; j < sizeof names / sizeof *names; j++)
            changes += change_all_slopes(root, in, names[j], 1e-4);
    }
    assert_true(changes > 70 * results);
}

/* Numbers of the elements, texts, what derivatives do not belong to, a number that B has of its
 * own, and the command line. */
TEST(derivatives_belong_to_the_result)
{
    static const struct {
        const char *path, *value, *part;
    } edits[] = {
        {"derivatives/tangential_load", "", "violated: derivatives.tangential_load is missing"},
        {"derivatives", "", "violated: derivatives is missing"},
        {"derivatives_of", "", "violated: derivatives is no result of this case"},
        {"derivatives_of", "\"approach\"", "derivatives.tangential_load is no result of this case"},
        {"derivatives/more", "1", "violated: derivatives.more is no result of this case"},
        {"derivatives/approach/more", "1", "violated: derivatives.approach.more is no result"},
        {"derivatives/approach/mu", "", "violated: derivatives.approach.mu is missing"},
        {"derivatives/approach/interlayer-normal", "1", "interlayer-normal: printed 1, should be"},
        {"derivatives_are", "\"x\"", "violated: derivatives_are: printed \"x\", should be"},
        {"derivatives_over_x/tangential_load/gap/9", "1", "tangential_load.gap, entry 10: "},
        {"derivatives_over_x/approach/mu/9", "1", "derivatives_over_x.approach.mu, entry 10"},
        {"without_derivatives/mu", "\"x\"", "violated: without_derivatives.mu is no result of"},
        {"smooth_derivatives", "{}", "cannot be checked: smooth derivatives: the zone of element"},
        {"uncertain_inputs", "", "violated: tolerances is no result of this case"},
        {"tolerances", "", "violated: tolerances is missing"},
        {"tolerances/approach", "", "violated: tolerances.approach is missing"},
        {"own_of_b", "[1]", "violated: own_of_b is no result of this case"},
        {"uncertain_inputs/mu", "0.021", "violated: tolerances.tangential_load: printed"},
        {"uncertain_inputs/mo", "0.021", "'mo' is not a number of"},
        {"tolerances/more", "1", "violated: tolerances.more is no result of this case"},
    };
    held_json *root = run_json(slopes[0]);
    for (size_t k = 0; k < sizeof edits / sizeof *edits; k++)
        if (!strstr(said_of(root, edits[k].path, edits[k].value), edits[k].part))
            fail_msg("%s = %s: %s", edits[k].path, edits[k].value,
                     said_of(root, edits[k].path, edits[k].value));
    held_json *steps = run_json(histories[0]);
    assert_non_null(
        strstr(said_of(steps, "derivatives", "{}"), "violated: derivatives is no result"));
    static const char *const of_steps[] = {"derivatives",
                                           "derivatives/approach",
                                           "derivatives/approach/mu",
                                           "derivatives/approach/mu/1",
                                           "tolerances",
                                           "tolerances/approach",
                                           "tolerances/approach/1"};
    held_json *sloped = run_json(slopes[5]);
    assert_non_null(
        strstr(said_of(steps, "history/tolerances", "{}"), "history.tolerances is no result"));
    for (size_t k = 0; k < sizeof of_steps / sizeof *of_steps; k++) {
        char path[80];
        snprintf(path, sizeof path, "history/%s", of_steps[k]);
        if (!strstr(said_of(sloped, path, ""), "violated: "))
            fail_msg("%s was taken away", path);
    }
    assert_int_equal(
        shell("\"$R\" --contact-elements 8 --mu 0.3 --support halfplane --load 100 --young-b 1e5 "
              "--poisson-b 0.1 --derivatives approach --tolerance mu=0.02 --json --quiet >r.json; "
              "\"$R\" check r.json && sed 's/mu=0.02/mu=0.03/' r.json >r2.json; "
              "\"$R\" check r2.json"),
        1);
    assert_non_null(strstr(out, "violated: command: uncertain_inputs is not what it asks for"));
}

/* Of numbers and of columns, with one of them or both; and whether sides that differ by a rounding
 * are printed as one number is decided by it. */
TEST(two_equal_sides_are_one_number)
{
    static const char *const numbers[] = {"derivatives/approach/mu", "derivatives/p/mu",
                                          "history/derivatives/approach/mu/1"};
    static const int of[] = {0, 1, 5};
    held_json *ends =
        run_json(TINY "--support halfplane --load 100 --creep-ratio 0.4 --poisson 0.5 "
                      "--derivatives p,approach" STEADY);
    assert_string_equal(said_of(ends, "derivatives_of", "\"p,approach\""), "");
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        held_json *root = run_json(slopes[of[k]]);
        json_t *one = root;
        char path[80], both[2000], *text;
        snprintf(path, sizeof path, "%s", numbers[k]);
        for (char *name = strtok(path, "/"); name; name = strtok(NULL, "/"))
            one = member(one, name);
        text = json_dumps(one, JSON_ENCODE_ANY | JSON_REAL_PRECISION(17));
        snprintf(both, sizeof both, "[%s,%s]", text, text);
        assert_string_equal(said_of(root, numbers[k], both), "");
        snprintf(both, sizeof both, "[%s,1]", text);
        assert_non_null(strstr(said_of(root, numbers[k], both), "violated: "));
        free(text);
    }
}

/* Where B has a number that it would have from A, derivatives are by A's alone. */
TEST(numbers_that_b_has_by_itself_are_its_own)
{
    static const char *const of_b[] = {
        "layer-thickness=1 layer-thickness-b=1",
        "layer-thickness=1 base-young=3e5 base-poisson=0.3 base-young-b=3e5 base-poisson-b=0.3",
        ("speed=1000 relaxation-time=1e-3 relaxation-ratio=1 relaxation-time-b=1e-3 "
         "relaxation-ratio-b=1"),
        "speed=1000 conductivity=50 heat-capacity=3.6 conductivity-b=50"};
    for (size_t k = 0; k < sizeof of_b / sizeof *of_b; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        const int code =
            shellf("printf '%%s\n' similar=yes %s >b.ini; \"$R\" --support halfplane "
                   "--load 100 --creep-ratio 0.4" TINY STEADY "--json --quiet --derivatives b.ini "
                   ">r.json && \"$R\" check r.json",
                   of_b[k]);
        if (code != 0)
            fail_msg("%s: %s%s", of_b[k], out, err);
    }
}

/* Error bars are taken as stated, on the mesh where they have ended; all else is computed again. */
TEST(results_with_error_bars_are_checked_on_their_mesh)
{
    static const char *const bars[] = {
        "--support halfplane --similar --half-width 1 --formulation steady --creep-ratio 0.4 "
        "--accuracy 1e-3",
        "--support halfplane --half-width 1 --mu 0.3 --accuracy 1e-2",
        /* free rolling on more elements than were asked for */
        "--support halfplane --half-width 1 --contact-elements 20 --formulation steady "
        "--creep-ratio "
        "0.3 --mu 0.4 --accuracy 2e-2",
        "--support halfplane --similar --half-width 1 --contact-elements 20 --error",
        "--support hub --load 100 --formulation steady --force-ratio 0.3 --contact-elements 20 "
        "--accuracy 3e-2",
        /* a thin rim, the boundary of which becomes twice as fine */
        "--support hub --hub-ratio 0.9 --young 1000 --poisson 0.5 --half-width 2.5 --mesh fitted "
        "--contact-elements 24 --mu 0.3 --formulation steady --creep-ratio 0.4 --accuracy 1.5e-2"};
    static const struct {
        const char *path, *value, *part;
    } of_mesh[] = {{"summary/free_creepage", "0.01", "summary.free_creepage: printed 0.01"},
                   {"summary/accuracy_elements", "19", "accuracy_elements: expected 20 to"},
                   {"summary/accuracy_elements", "20", "and inputs have 20"},
                   {"summary/accuracy_elements", "", "accuracy_elements is missing"},
                   {"summary/accuracy_boundary", "1", "accuracy_boundary is no result"},
                   {"summary/accuracy_boundary", "0.5", "accuracy_boundary: expected 1 to 32"}},
      changed[] = {{"summary/errors/max_pressure", "-1", "errors: max_pressure is printed as -1"},
                   {"summary/errors/half_width", "", "summary.errors.half_width is missing"},
                   {"summary/errors/mu", "1", "summary.errors.mu is no result of this case"},
                   {"summary/errors/approach", "\"x\"", "summary.errors.approach: printed"},
                   {"summary/max_pressure", "400", "summary.max_pressure: printed 400"}};

    for (size_t k = 0; k < sizeof bars / sizeof *bars; k++)
        for (int json = 0; json < 2; json++) {
            if (!is_in_turn((int)k, 3))
                continue;
            assert_int_equal(shellf("\"$R\" %s%s >r.json 2>/dev/null; \"$R\" check r.json", bars[k],
                                    json ? " --json" : ""),
                             0);
            assert_int_equal(strstr(out, "; error bars are taken as stated") != NULL, json);
        }
    held_json *root = run_json(bars[2]);
    for (size_t k = 0; k < sizeof of_mesh / sizeof *of_mesh; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        const char *said = said_of(root, of_mesh[k].path, of_mesh[k].value);
        if (!strstr(said, of_mesh[k].part))
            fail_msg("%s: '%s' lacks '%s'", of_mesh[k].path, said, of_mesh[k].part);
    }
    held_json *with_bars = run_json(bars[3]);
    for (size_t k = 0; k < sizeof changed / sizeof *changed; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        const char *said = said_of(with_bars, changed[k].path, changed[k].value);
        if (!strstr(said, changed[k].part))
            fail_msg("%s: '%s' lacks '%s'", changed[k].path, said, changed[k].part);
    }
}

TEST(what_cannot_be_checked_is_refused)
{
    static const char half[] = "\"$R\" --support halfplane --load 100 --mu 0.3 --json ";
    char line[500];
    const struct {
        const char *options, *part;
    } kinds[] = {{"--formulation transient --creep 1e-3 --distance 0.1", "take --states"},
                 {"--increments 3 --shift 1e-4", "take --states"},
                 {"--increments 3 --shift 1e-4 --error --states", "error bars"},
                 {"--formulation steady --creep 1e-3 --units si", "units other than mm"}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        snprintf(line, sizeof line, "%s%s", half, kinds[k].options);
        check_says(line, 65, kinds[k].part);
    }
    check_says("\"$R\" curve --support halfplane --load 100 --mu 0.3 --from 0 --to 1 --points 3 "
               "--json",
               65, "cannot be checked");
    check_says("\"$R\" stress --support halfplane --load 100 --contact-elements 12 "
               "--increments 3 --shift 1e-4 --json",
               65, "check the contact alone, by the same case without `stress`, with");
    assert_int_equal(rollbem("--support halfplane --load 100 --increments 3 --states"), 64);
    assert_int_equal(rollbem("--support halfplane --load 100 --states --json"), 64);
    check_says("\"$R\" --approach 1e-9 --zone 5 --json", 65, "cannot be checked");
    snprintf(line, sizeof line, "%s | sed 's/\"gap_mm\": \\[/& 0,/'", half);
    check_says(line, 1, "gap_mm");
    check_says("echo '[]'", 65, "expected the JSON of a result");
    check_says("echo '{'", 65, "expected the JSON of a result");
    check_says("echo '{}'", 65, "not a result of schema");
    snprintf(line, sizeof line, "%s | sed 's/\"mu\": 0.3/\"mu\": \"x/'", half);
    check_says(line, 65, "r.json");
    snprintf(line, sizeof line, "%s | sed '/\"approach\": [0-9]/s/: ./: 9/'", half);
    check_says(line, 1, "violated: gap");
    assert_int_equal(rollbem("check none.json"), 66);
    assert_int_equal(rollbem("check"), 64);
}

/* ---- Everything that a result says ------------------------------------------------- */

/* What is of the machine that has solved, and of the way to the solution. */
static int is_beyond_checking(const char *path)
{
    static const char *const ends[] = {"/iterations", "/integrals", "/openblas"};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++)
        if (strlen(path) > strlen(ends[k]) &&
            strcmp(path + strlen(path) - strlen(ends[k]), ends[k]) == 0)
            return 1;
    return strstr(path, "/seconds/") != NULL;
}

typedef struct {
    json_t *root;
    const char *given;
    double part;         /* that numbers are changed by */
    const char *without; /* members of the result that are left as they are */
    int share;           /* one change of so many is made in each run, all of them in 120 turns */
    int found, changes, missed;
} tampering;

/* By the certificate, or else by the program, which has the command line to read as well. */
static void expect_noticed(tampering *t, const char *path, const char *what)
{
    const int is_program = strcmp(path, "/command") == 0 || strcmp(path, "/depth") == 0 ||
                           strstr(path, "yield_shear") || strcmp(what, "taken away") == 0;
    rb_certificate_outcome found = {.prove = 0};
    rb_message why = {.text = ""};
    if (!is_in_turn(t->found++, t->share))
        return;
    t->changes++;
    if (certify(t->root, &found, &why) != RB_OK || found.violations > 0)
        return;
    if (is_program) {
        assert_int_equal(json_dump_file(t->root, "changed.json", JSON_REAL_PRECISION(17)), 0);
        if (shell("\"$R\" check changed.json") != 0)
            return;
    }
    print_error("%s: %s %s was not noticed\n", t->given, path, what);
    t->missed++;
}

/* Numbers by a part; a word loses its first letter, or gets one.  At the place of a largest stress
 * it is flat: there a part in a hundred, and K_I and K_II have their extremes at positions. */
static json_t *other_value(const tampering *t, const char *path, const json_t *value)
{
    const char *end = strrchr(path, '/'), *of_slopes = strstr(path, "derivatives/");
    const int is_flat = strstr(path, "maxima/") && end[2] == '\0';
    if (json_is_string(value))
        return json_string(json_string_value(value)[0] ? json_string_value(value) + 1 : "x");
    if (json_is_integer(value) && strstr(path, "/zone/"))
        return json_integer((json_integer_value(value) + 1) % 4);
    if (json_is_integer(value))
        return json_integer(json_integer_value(value) + 1);
    if (json_is_real(value) && of_slopes) { /* a part of the largest effect, at least */
        const json_t *in = json_object_get(json_object_get(t->root, "history"), "derivatives"),
                     *inputs = json_object_get(t->root, "inputs");
        char result[40], input[40];
        if (sscanf(of_slopes, "derivatives/%39[^/]/%39[^/]", result, input) != 2)
            return NULL;
        in = json_object_get(in ? in : json_object_get(t->root, "derivatives"), result);
        const double by = fabs(json_number_value(json_object_get(inputs, input)));
        if (by == 0.0) /* its effect is that of no number */
            return NULL;
        const double least = 1e-2 * largest_effect(in, inputs, 1.0) / by;
        return json_real(json_real_value(value) +
                         t->part * fmax(fabs(json_real_value(value)), least));
    }
    if (json_is_real(value)) {
        const double x = json_real_value(value);
        return json_real(is_flat ? x + 0.01 : fabs(x) > 1e-9 ? x * (1.0 + t->part) : x + 1e-3);
    }
    return json_is_boolean(value) ? json_boolean(!json_is_true(value)) : json_real(1.0);
}

/* Each value of the tree in turn is changed, each member taken away, and to each object one added;
 * of lists two entries, unless ROLLBEM_TEST_ALL. */
static void tamper(tampering *t, json_t *at, const char *path)
{
    const int all = getenv("ROLLBEM_TEST_ALL") != NULL, is_object = json_is_object(at);
    json_t *names = members(at), *value;
    const size_t n = json_object_size(names);
    const char *key;
    char own[240];
    size_t i = 0;

    if (is_object) {
        json_object_set_new(at, "one-more", json_real(1.0));
        snprintf(own, sizeof own, "%s/one-more", path);
        expect_noticed(t, own, "added");
        json_object_del(at, "one-more");
    }
    json_object_foreach(names, key, value)
    {
        snprintf(own, sizeof own, "%s/%s", path, key);
        const size_t entry = i++;
        if (!is_object && !all && n > 2 && entry != n / 3 && entry != 2 * n / 3)
            continue;
        if (is_object && strcmp(key, "command") != 0) {
            json_object_del(at, key);
            expect_noticed(t, own, "taken away");
            json_object_set(at, key, value);
        }
        if (json_is_object(value) || json_is_array(value)) {
            if (!strstr(t->without, own))
                tamper(t, value, own);
            continue;
        }
        if (is_beyond_checking(own))
            continue;
        json_t *other = other_value(t, own, value);
        if (!other)
            continue;
        if (is_object)
            json_object_set_new(at, key, other);
        else
            json_array_set_new(at, entry, other);
        expect_noticed(t, own, "changed");
        if (is_object)
            json_object_set(at, key, value);
        else
            json_array_set(at, entry, value);
    }
    json_decref(names);
}

/* One result of each kind, by the program, so that a value that is never compared is found here,
 * also one that is not there yet.  A run has a part of the kinds, the next one others. */
TEST(whatever_is_changed_is_noticed)
{
    static const char *const kinds[] = {
        TINY "--support halfplane --load 100 --creep-ratio 0.4" STEADY,
        TINY "--support halfplane --load 100 --shift 1e-4 --increments 2" STATES,
        TINY "--support halfplane --half-width 0.3 --formulation transient --distance "
             "0.2 --steps 2 --force-ratio 0.3" STATES,
        TINY "--support halfplane --load 100 --relaxation-time 0.01 --relaxation-ratio 1 "
             "--speed 100 --formulation transient --distance 0.2 --creep 1e-3" STATES,
        TINY "--support hub --history calm.txt --relaxation-time 1e-3 --relaxation-ratio 1" STATES,
        "stress " TINY "--support halfplane --load 100 --creep-ratio 0.4 --grid 2x2" STEADY,
        "stress " TINY "--support halfplane --load 100 --creep-ratio 0.4 --shakedown "
        "--yield-shear 300 --grid 2x2" STEADY,
        "stress " TINY "--load 100 --outer-elements 24 --creep-ratio 0.5 --points near.txt" STEADY,
        "crack " TINY "--support halfplane --similar --half-width 1 --radius 1000 "
        "--crack-elements 8 --steps 30 --passes 2 --fluid trapped --creep-ratio "
        "-3" STEADY STATES,
        "crack " TINY "--support halfplane --similar --half-width 1 --radius 1000 "
        "--crack-elements 8 --fluid trapped --closing located --steps 30 --creep-ratio "
        "-3" STEADY STATES,
        "crack " TINY "--support halfplane --similar --half-width 1 --radius 1000 "
        "--crack-elements 8 --crack-depth 0.3 --increments 3 --shift 1e-4" STATES,
        "crack " TINY "--support halfplane --similar --half-width 1 --radius 1000 "
        "--crack-elements 8 --unloaded --remote-stress 3" STATES,
        TINY "--support halfplane --radius-b -200 --young-b 3e4 --plane stress --approach "
             "1e-3 --shift 1e-5 --increments 2" STATES,
        TINY "--support hub --hub-ratio 0.6 --cover-thickness 5 --core-young 2e5 --load 100 "
             "--creep-ratio 0.4 --relaxation-time 1e-3 --relaxation-ratio 1 --speed 1000" STEADY,
        TINY "--support halfplane --load 100 --creep-ratio 0.4 --conductivity 50 "
             "--heat-capacity 3.6 --speed 20 --interlayer-tangential 1e-6" STEADY,
        TINY "--support halfplane --load 100 --shift 1e-4 --interlayer-tangential 1e-6 "
             "--yield-stress 10 --hardening 1e4",
        TINY "--support halfplane --load 100 --creep-ratio 0.4 --gap bumps.txt" STEADY,
        TINY "--support halfplane --load 100 --creep-ratio 0.4 --speed 1000 --friction-law "
             "exponential --mu-fall 0.1 --slip-scale 10 --all-solutions" STEADY,
        TINY "--support halfplane --load 100 --creep-ratio 0.4 --derivatives "
             "tangential_load,approach,p --tolerance mu=0.02,radius=1%" STEADY,
        TINY STATES "--support halfplane --load 100 --young-b 210000 --increments 2 --shift "
                    "1e-4 --derivatives tangential_load --tolerance mu=0.02",
    };
    const size_t n = sizeof kinds / sizeof *kinds;
    const int all = getenv("ROLLBEM_TEST_ALL") != NULL;
    tampering t = {.without = ""};
    write_controls();
    assert_int_equal(shell("printf '0.1 0.02\n-0.1 0.3\n' > near.txt; awk 'BEGIN {for (x "
                           "= -3; x < 3.01; x += 0.05) print x, x * x / 100 + 0.001 * "
                           "cos(12 * x)}' > bumps.txt"),
                     0);
    for (size_t k = 0; k < n; k++) {
        if (!is_in_turn((int)k, 20))
            continue;
        /* what two places or two roundings decide is right near either, not between them */
        t.part = is_in_turn((int)k, 40) ? 1e-4 : 0.5;
        t.given = kinds[k];
        t.root = run_json(kinds[k]);
        expect_violations(t.root, 0);
        /* inputs are the same of all kinds; a limit of shakedown takes long to be found, the
         * largest stress of a wheel and the hub of a cover as well: their contact is that of other
         * kinds */
        const int is_long = strstr(kinds[k], "--shakedown") || strstr(kinds[k], "--points") ||
                            strstr(kinds[k], "--core-young");
        t.without = k == 0 || all                   ? "/"
                    : is_long && kinds[k][0] == 's' ? "/inputs/units/summary/table/grid"
                                                    : "/inputs/units";
        t.share = 3;
        const int before = t.changes;
        tamper(&t, t.root, "");
        print_message("%d changes of %s\n", t.changes - before, kinds[k]);
        assert_true(t.share * (t.changes - before) > 50); /* or its values were not reached */
        json_decref(t.root);
    }
    assert_int_equal(t.missed, 0);
}

/* Of every other command, in one line; of verify, which takes long: test_cli. */
TEST(results_of_other_commands_are_refused)
{
    static const char half[] = "--support halfplane --similar --load 500 "
                               "--contact-elements 12 --formulation steady ";
    static const struct {
        const char *command, *options, *part;
    } other[] = {
        {"curve", "--from 0 --to 1 --points 3", "results with 'curve'"},
        {"sweep", "--creep-ratio 0.4 --vary-1 'mu 0.1,0.2'", "(only single cases,"},
        {"wear", "--creep-ratio 0.4 --cycles 1e4 --wear-coefficient 1e-8", "'wear'"},
        {"crack", "--creep-ratio 0.4 --crack-length 1 --crack-angle 30", "--states"},
        {"design", "--minimise max_pressure --over radius=20:100", "'design'"},
        {"fit", "creep.tsv --fit mu", "'parameters'"},
    };
    static const char *const without_case[] = {
        "example bar --json",
        "example truss --json",
        "lcp lcp.txt --json",
        "friction two-blocks.dat --json",
        "compare two-blocks.dat --json",
        "examples --json",
    };
    char line[500];
    write_file("creep.tsv", "creep_ratio\tforce_ratio\n0.2\t-0.36\n0.4\t-0.64\n"
                            "0.7\t-0.91\n");
    write_file("lcp.txt", "2\n2 1\n1 2\n-1\n-1\n");
    assert_int_equal(shell("cp \"$PROJECT\"/examples/friction/two-blocks.dat two-blocks.dat"), 0);
    for (size_t k = 0; k < sizeof other / sizeof *other; k++) {
        if (!is_in_turn((int)k, 6))
            continue;
        snprintf(line, sizeof line, "\"$R\" %s %s%s --json --quiet", other[k].command, half,
                 other[k].options);
        check_says(line, 65, other[k].part);
        assert_int_equal(shell("\"$R\" check r.json 2>&1 | wc -l | grep -qx 1"), 0);
    }
    for (size_t k = 0; k < sizeof without_case / sizeof *without_case; k++) {
        if (!is_in_turn((int)k, 6))
            continue;
        snprintf(line, sizeof line, "\"$R\" %s", without_case[k]);
        check_says(line, 65, "(only single cases, histories, stress");
    }
}

/* ---- Files that somebody else names ------------------------------------------------ */

/* A result from anybody names devices, pipes, files that are nobody's business. */
TEST(files_of_others_are_left_alone)
{
    static const struct {
        const char *file, *part;
    } bad[] = {
        {"/dev/zero", "/dev/zero: expected a regular file"},
        {"/dev/urandom", "/dev/urandom: expected a regular file"},
        {"pipe", "pipe: expected a regular file"},
        {"../outside.txt", "../outside.txt: not in the folder of/"},
        {"of/link", "of/link: not in the folder of/"},
        {"of/../secret.txt", "of/../secret.txt: not in the folder of/"},
        {"/etc/passwd", "/etc/passwd: not in the folder of/"},
        {"of/large", "of/large: more than 64 MB"},
        {"of", "of: expected a regular file"},
        {"of/none.txt", "of/none.txt: No such file"},
        {"of/secret.txt", "of/secret.txt: not what is expected of this file"},
        {"of/names.txt", "of/names.txt: not what is expected of this file"},
    };
    static const char *const options[] = {"gap", "worn", "friction-law", "history"};
    assert_int_equal(
        shell("mkdir -p of; mkfifo pipe; echo 'Xy9 Zq7' > secret.txt; cp secret.txt of; "
              "ln -s /etc/hostname of/link; echo 'load mu Xy9' > of/names.txt; echo '1 1 "
              "1' >> "
              "of/names.txt; truncate -s 65M of/large; echo '0 0' > ../outside.txt; awk "
              "'BEGIN {for (x = -4; x < 4.01; x += 0.25) print x, x * x / 50}' > g.txt; "
              "cp g.txt of; \"$R\" --support halfplane --load 100 --mu 0.3 --gap of/g.txt "
              "--contact-elements 12 --json --quiet --output of/r.json && \"$R\" check "
              "of/r.json"),
        0);
    json_t *root = json_load_file("of/r.json", 0, NULL);
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
            if (!is_in_turn((int)(i + k), 8)) /* each file by one option, each option with some */
                continue;
            json_t *wrong = json_deep_copy(root), *inputs = json_object_get(wrong, "inputs");
            if (i > 0)
                json_object_set_new(inputs, "gap", json_string("exact"));
            json_object_set_new(inputs, options[i], json_string(bad[k].file));
            if (strcmp(options[i], "history") == 0)
                json_object_set_new(wrong, "history", json_pack("{s:{}}", "states"));
            assert_int_equal(json_dump_file(wrong, "of/wrong.json", 0), 0);
            json_decref(wrong);
            const int code = shell("timeout 20 \"$R\" check of/wrong.json");
            if ((code != 65 && code != 66) || !strstr(err, bad[k].part))
                print_error("%s = %s: exit %d\n%s", options[i], bad[k].file, code, err);
            assert_true(code == 65 || code == 66);
            assert_non_null(strstr(err, bad[k].part));
            assert_null(strstr(err, "Xy9"));
        }
    /* whoever knows where the result comes from may allow it */
    json_object_set_new(json_object_get(root, "inputs"), "gap", json_string("g.txt"));
    assert_int_equal(json_dump_file(root, "of/wrong.json", 0), 0);
    assert_int_equal(shell("\"$R\" check of/wrong.json"), 65);
    assert_non_null(strstr(err, "g.txt: not in the folder of/"));
    assert_int_equal(shell("\"$R\" check --any-folder of/wrong.json"), 1);
    assert_non_null(strstr(out, "input_hash: a file")); /* the path is one of the inputs */
    /* but no more than regular files of any folder, without their content */
    static const struct {
        const char *file, *part;
    } nowhere[] = {{"/dev/zero", "/dev/zero: expected a regular file"},
                   {"pipe", "pipe: expected a regular file"},
                   {"of/large", "of/large: more than 64 MB"},
                   {"secret.txt", "secret.txt: not what is expected of this file"}};
    for (size_t k = 0; k < sizeof nowhere / sizeof *nowhere; k++) {
        json_object_set_new(json_object_get(root, "inputs"), "gap", json_string(nowhere[k].file));
        assert_int_equal(json_dump_file(root, "of/wrong.json", 0), 0);
        /* the sanitizers reserve more addresses than any limit */
        assert_int_equal(shell(SANITIZED ? "timeout 20 \"$R\" check --any-folder of/wrong.json"
                                         : "ulimit -v 4000000; timeout 20 \"$R\" check "
                                           "--any-folder of/wrong.json"),
                         65);
        assert_non_null(strstr(err, nowhere[k].part));
        assert_null(strstr(err, "Xy9"));
    }
    json_decref(root);
    /* the command line in the comments of a table names files, too */
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        char line[300];
        for (int is_case = 0; is_case < 2; is_case++) {
            if (!is_in_turn(2 * (int)k + is_case, 8))
                continue;
            snprintf(line, sizeof line,
                     "printf 'x_mm p_MPa\n# rollbem 0.1.0\n# rollbem %s%s\n' > of/t; "
                     "timeout 20 \"$R\" check of/t",
                     is_case ? "" : "--gap ", bad[k].file);
            const int code = shell(line);
            if (code != 65 || !strstr(err, bad[k].part))
                print_error("table, %s: exit %d\n%s", bad[k].file, code, err);
            assert_int_equal(code, 65);
            assert_non_null(strstr(err, bad[k].part));
            assert_null(strstr(err, "Xy9"));
        }
    }
    assert_int_equal(shell("rm -f ../outside.txt"), 0);
}

/* An empty file has no lines; a name that is no UTF-8 is a name that is not expected. */
TEST(odd_bytes_are_named)
{
    assert_int_equal(shell(": > empty; \"$R\" check empty"), 65);
    assert_non_null(strstr(err, "empty: cannot be checked: expected the JSON"));
    assert_int_equal(shell("printf 'x_mm' > empty; \"$R\" check empty"), 65);
    assert_int_equal(
        shell("\"$R\" --support halfplane --load 100 --mu 0.3 --contact-elements 12 "
              "--output t.tsv --quiet; LC_ALL=C sed '1s/un_mm/u\\xffn_mm/' t.tsv > u.tsv; "
              "\"$R\" check u.tsv"),
        1);
    assert_non_null(strstr(out, "violated: table.un_mm is missing"));
}

/* ---- Results that somebody has changed --------------------------------------------- */

/* A line for each thing that is missing, of another kind, or against a law. */
TEST(every_edit_is_named)
{
    static const struct {
        const char *given;
        struct {
            const char *path, *value, *part;
        } edit[51];
    } results[] = {
        {"--support halfplane --load 100 --mu 0.3 --creep-ratio 0.4 --mesh uniform "
         "--contact-elements 12" STEADY,
         {
             {"summary/iterations", "1000", ""},
             {"summary/iterations", "-1", "summary.iterations: printed -1"},
             {"summary/seconds/total", "-1", "summary.seconds.total: printed -1"},
             {"summary/seconds", "", "summary.seconds is missing"},
             {"summary/seconds", "-1", "summary.seconds: printed -1"},
             {"summary/openblas", "", "summary.openblas is missing"},
             {"summary/free_creepage", "1", "summary.free_creepage: printed 1"},
             {"summary/free_creepage", "\"x\"", "summary.free_creepage: printed \"x\""},
             {"schema", "\"rollbem/2\"", "r: cannot be checked: not a result of schema"},
             {"inputs", "", "inputs, summary or table is missing"},
             {"summary", "[]", "inputs, summary or table is missing"},
             {"table", "", "inputs, summary or table is missing"},
             {"errors", "{}", "violated: errors is no result of this case"},
             {"history", "{}", "its inputs and its history do not belong together"},
             {"inputs/error", "true", "summary.errors is missing"},
             {"inputs/accuracy", "0.01", "summary.accuracy_elements is missing"},
             {"inputs/accuracy", "1", "inputs: --accuracy: expected"},
             {"summary/errors", "{}", "errors is no result of this case"},
             {"inputs/units", "\"si\"", "units other than mm"},
             {"units/system", "\"si\"", "units other than mm"},
             {"summary/status", "\"iteration limit\"", "its status is not"},
             {"table/x_mm", "[0, 1]", "its table has no elements"},
             {"inputs/length", "1", "inputs: unknown option 'length'"},
             {"inputs/mu", "\"much\"", "inputs: --mu: expected a number"},
             {"inputs/load", "{}", "r: cannot be checked: inputs: "},
             {"inputs/tol", "", "'tol' of inputs cannot be built again"},
             {"inputs/gap-smoothing", "null", "'gap-smoothing' of inputs cannot be"},
             {"inputs/shift", "", "'shift' of inputs cannot be built again"},
             {"inputs/shift-b", "null", "cannot be checked: inputs have other names"},
             {"inputs", "[]", "inputs, summary or table is missing"},
             {"summary", "", "inputs, summary or table is missing"},
             {"table", "[]", "inputs, summary or table is missing"},
             {"inputs/error", "", "'error' of inputs cannot be built again"},
             {"inputs/accuracy", "", "'accuracy' of inputs cannot be built again"},
             {"inputs/similar", "", "'similar' of inputs cannot be built again"},
             {"inputs/formulation", "", "'formulation' of inputs cannot be built again"},
             {"table/p_MPa", "[0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]",
              "r: violated: the given load: printed 0, recomputed 100 ("},
             {"input_hash", "\"0\"", "are not those of the result"},
             {"table/h_mm/3", "-0.1", "r: table: element 4 is out of order"},
             {"table/x_mm/5", "-9", "r: table: element 6 is out of order"},
             {"table/x_mm/5", "null", "r: table: x_mm of element 6 is no number"},
             {"table/h_mm", "", "numbers in h_mm"},
             {"table/p_MPa", "", "numbers in p_MPa"},
             {"table/q_MPa/2", "", "numbers in q_MPa"},
             {"table/zone", "", "numbers in zone"},
             {"table/shift_mm", "", "numbers in shift_mm"},
             {"table/zone/5", "1.5", "r: table: zone of element 6 is 1.5"},
             {"table/zone/5", "4", "r: table: zone of element 6 is 4"},
             {"table/zone/0", "-1", "r: table: zone of element 1 is -1"},
             {"summary/creepage", "null", "no approach, shift or creepage"},
             {"summary/approach", "", "no approach, shift or creepage"},
         }},
        {"--support halfplane --load 100 --mu 0.3 --creep-ratio 0.4 --mesh uniform "
         "--contact-elements 12" STEADY,
         {
             {"history", "null", "take --states"},
             {"table/p_MPa/6", "-1", "violated: pressure of element 7: -1 < 0"},
             {"table/p_MPa/6", "-1", "zone of element 7: 2 at a pressure of -1"},
             {"table/p_MPa/0", "1", "violated: zone of element 1: 0 at a pressure of 1"},
             {"table/p_MPa/0", "1", "violated: the contact reaches an end of the table"},
             {"table/p_MPa/11", "1", "violated: the contact reaches an end of the"},
             {"table/q_MPa/6", "1e4", "of element 7: |q| exceeds mu p by"},
             {"table/zone/6", "1", "violated: stick of element 7: it slips by"},
             {"table/zone/6", "3", "violated: slip of element 7: q - mu p ="},
             {"table/q_MPa/6", "0", "violated: slip of element 7: q + mu p ="},
             {"table/shift_mm/6", "-1", "violated: slip of element 7: q + mu p = "},
             {"table/gap_mm/6", "1", "violated: table.gap_mm, entry 7: printed 1"},
             {"table/un_mm/6", "", "violated: table.un_mm: 11 entries, expected 12"},
             {"table/ut_mm/6", "1", "violated: table.ut_mm, entry 7: printed 1"},
             {"table/more", "[]", "violated: table.more is no result of this case"},
             {"summary/more", "1", "violated: summary.more is no result of this case"},
             {"summary/datum", "", "summary.datum is missing, should be 36.78"},
             {"summary/load_error", "", "load_error is missing, should be"},
             {"summary/support_balance", "1", "support_balance: printed 1, should be null"},
             {"summary/contact", "\"x\"", "violated: summary.contact: printed \"x\", should be 6"},
             {"summary/edges", "\"x\"", "summary.edges: printed \"x\", should be \"bounded\""},
             {"summary/iterations", "1000", ""},
             {"summary/normal_load", "101", "violated: summary.normal_load: printed 101"},
             {"summary/tangential_load", "1", "violated: summary.tangential_load: printed 1"},
             {"summary/creepage", "0", "violated: the given creep_ratio: printed 0"},
             {"summary/boundary_matrix", "\"hierarchical\"", "boundary_matrix"},
         }},
        {"--support hub --cover-thickness 2 --young 8 --poisson 0.4 --load 1 --mu 0.3 "
         "--force-ratio -0.8 --relaxation-time 1e-3 --relaxation-ratio 1 --speed 1000 "
         "--mesh fitted --contact-elements 30" STEADY,
         {
             {"notes", "[]", ""},
             {"summary/hysteresis", "0.0074", "violated: summary.hysteresis: printed "},
             {"summary/hysteresis", "0.0069", "violated: summary.hysteresis: printed "},
             {"summary/hysteresis", "null", "violated: summary.hysteresis: printed null"},
         }},
        {"--support halfplane --load 100 --mu 0.3 --creep-ratio -0.4 --mesh uniform "
         "--contact-elements 12" STEADY,
         {
             {"table/zone/8", "2", "violated: slip of element 9: q + mu p ="},
             {"table/q_MPa/8", "0", "violated: slip of element 9: q - mu p ="},
             {"table/shift_mm/8", "1", "violated: slip of element 9: q - mu p = "},
         }},
        {"--support halfplane --load 100 --mu 0.3 --creep-ratio 0.3 --yield-stress 20 "
         "--interlayer-tangential 1e-5 --mesh uniform --contact-elements 14" STEADY,
         {
             {"summary/iterations", "1000", ""},
             {"table/zone/9", "4", "violated: yield of element 10: |q| is off its yield"},
             {"table/zone/9", "6", "r: table: zone of element 10 is 6"},
             {"table/q_MPa/5", "-30", "yield stress of element 6: |q| exceeds it by"},
             {"table/plastic_mm", "", "numbers in plastic_mm"},
         }},
        {"--support halfplane --load 100 --mu 0.3 --gap humps.txt --contact-elements 20",
         {
             {"summary/patches/1/normal_load", "1",
              "violated: summary.patches.2.normal_load: printed 1"},
             {"summary/patches/0/to", "null", "violated: summary.patches.1.to: printed null"},
             {"summary/patches/0/more", "1", "patches.1.more is no result of this case"},
             {"summary/patches/1", "", "summary.patches: 1 entries, expected 2"},
             {"summary/creepage", "1", "violated: summary.creepage: printed 1, recomputed 0 "},
         }},
        {"--support halfplane --load 100 --mu 0.3 --increments 3 --shift 1e-4 "
         "--contact-elements 12" STATES,
         {
             {"summary/iterations", "1000", ""},
             {"history", "", "its inputs and its history do not belong together"},
             {"history", "[]", "its inputs and its history do not belong together"},
             {"history/states", "", "depends on the steps before it: take --states"},
             {"history/states", "[]", "depends on the steps before it: take --states"},
             {"inputs/increments", "1", "its inputs and its history do not belong"},
             {"history/approach", "[]", "r: cannot be checked: no steps"},
             {"history/states/p_MPa", "", "r: expected 6 steps in p_MPa"},
             {"history/states/q_MPa/0", "", "r: expected 6 steps in q_MPa"},
             {"history/states/shift_mm/1/4", "", "numbers in shift_mm"},
             {"history/states/shift_mm/1/4", "null", "shift_mm of element 5 is no number"},
             {"history/states/zone", "", "r: expected 6 steps in zone"},
             {"history/states/zone/2/4", "4", "violated: step 3: yield of element 5"},
             {"history/states/zone/2/4", "6", "zone of element 5 is 6"},
             {"history/states/zone/2/4", "-1", "zone of element 5 is -1"},
             {"history/states/zone/2/4", "0.5", "zone of element 5 is 0.5"},
             {"history/states/motion", "", "numbers in motion"},
             {"table/x_mm/3", "null", "x_mm of element 4 is no number"},
             {"table/h_mm", "", "numbers in h_mm"},
             {"history/states/motion/1", "1", "violated: step 2: the given shift or"},
             {"history/states/p_MPa/1/5", "1", "violated: step 2: "},
             {"history/approach/1", "1", "violated: step 2: gap of element"},
             {"history/normal_load/1", "", "history.normal_load: 5 entries, expected 6"},
             {"history/stick/1", "7.5", "violated: history.stick, entry 2: printed 7.5"},
             {"history/residual/1", "1", "violated: history.residual, entry 2: printed 1"},
             {"history/half_width", "1", "violated: history.half_width: printed 1"},
             {"history/steady_from", "\"x\"", "history.steady_from: printed \"x\", should be"},
             {"history/more", "1", "violated: history.more is no result of this case"},
         }},
        {"--support halfplane --load 100 --mu 0.3 --shift 1e-4 --contact-elements 12 "
         "--grid 3x4 --shakedown",
         {
             {"summary/iterations", "1000", ""},
             {"grid", "", "r: cannot be checked: "},
             {"grid/nx", "4", "cannot be checked: its grid is not nx by ny points"},
             {"grid/nx", "1", "cannot be checked: its grid is not nx by ny points"},
             {"grid/ny", "null", "cannot be checked: its grid is not nx by ny points"},
             {"grid/ny", "0", "cannot be checked: its grid is not nx by ny points"},
             {"grid/x_mm", "", "cannot be checked: its grid is not nx by ny points"},
             {"grid/y_mm", "[]", "violated: grid.y_mm: 0 entries, expected 12"},
             {"grid/more", "[]", "violated: grid.more is no result of this case"},
             {"grid/sxx_MPa/2", "null", "violated: grid.sxx_MPa, entry 3: printed null"},
             {"maxima/max_shear", "1", "violated: maxima.max_shear: printed 1, should be {"},
             {"shakedown", "1", "violated: shakedown: printed 1, should be {"},
         }},
        {"--support halfplane --load 100 --mu 0.3 --shift 1e-4 --contact-elements 12 "
         "--points inside.txt",
         {
             {"points/x_mm", "[]", "numbers in y_mm"},
             {"points", "{\"x_mm\": [], \"y_mm\": []}", "r: cannot be checked: "},
             {"points/y_mm/1", "", "numbers in y_mm"},
             {"points/x_mm/1", "null", "x_mm of element 2 is no number"},
         }},
    };
    write_points();
    assert_int_equal(shell("awk 'BEGIN {for (x = -4; x < 4.01; x += 0.25) { a = x < 0 ? "
                           "-x - 2 : x - 2; print x, a * a / 50 }}' > humps.txt"),
                     0);
    int wrong = 0;
    for (size_t k = 0; k < sizeof results / sizeof *results; k++) {
        char line[600];
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(line, sizeof line, "%s%s",
                 strstr(results[k].given, "--grid") || strstr(results[k].given, "--points")
                     ? "stress "
                     : "",
                 results[k].given);
        held_json *root = run_json(line);
        for (size_t i = 0; i < 50 && results[k].edit[i].path; i++) {
            const char *path = results[k].edit[i].path, *value = results[k].edit[i].value,
                       *part = results[k].edit[i].part;
            const char *said = said_of(root, path, value);
            if (*part ? strstr(said, part) != NULL : *said == '\0')
                continue;
            print_error("result %zu, %s = %s: '%s' wanted; said: %s\n", k, path, value, part, said);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

/* Which half of a material was not given stands in the notes, and not in the inputs: it is judged
 * by the value that it names. */
TEST(what_is_said_of_a_material_is_checked)
{
    static const char *const materials[][2] = {
        {"--outer-elements 30 --young 210000", "--young without --poisson: nu = 0.1 is"},
        {"--outer-elements 30 --young 60ShoreA --poisson 0.49 --load 5",
         "--young of 60 ShoreA is E = 3.605 MPa"},
        {"--support halfplane --young 7e4 --poisson .2 --layer-thickness 1 --base-young 2e5 --load "
         "99",
         "--base-young without --base-poisson: nu = 0.1 is"}};
    for (size_t k = 0; k < sizeof materials / sizeof *materials; k++) {
        held_json *root = run_jsonf("%s --contact-elements 12", materials[k][0]);
        const json_t *notes = json_object_get(root, "notes");
        const char *last = json_string_value(json_array_get(notes, json_array_size(notes) - 1));
        assert_non_null(strstr(NOT_NULL(last), materials[k][1]));
        assert_int_equal(json_dump_file(root, "r.json", 0), 0);
        CHECK_RUN(rollbem("check r.json"), 0, out, "r.json: valid");
    }
    assert_int_equal(shell("sed -i 's/nu = 0.1 is/nu = 0.2 is/' r.json"), 0);
    CHECK_RUN(rollbem("check r.json"), 1, out, "violated: notes");
}

RUN_TESTS(enter_folder, leave_folder)
