/* The program as its users meet it: exit codes, the one line of each error, whole files
 * or none, the same numbers in every format.  B: the build directory, default build. */
#include "cli_run.h"
#include "base/io/io.h"
#include "lcp/lcp.h"

#include <sys/stat.h>

/* A quick, exact case. */
#define QUICK "--support halfplane --load 100 --contact-elements 24"

/* ---- Errors on the command line ---------------------------------------------------- */

static const struct {
    const char *arguments;
    int code;
    const char *part;
} bad_arguments[] = {
    {"--mu -0.1", 64, "--mu: expected a number >= 0, got '-0.1'"},
    {"--mu abc", 64, "--mu: expected a number >= 0, got 'abc'"},
    {"--mu=", 64, "--mu: expected a number >= 0, got ''"},
    {"--mu 0.3x", 64, "got '0.3x'"},
    {"--mu ' 0.3'", 64, "got ' 0.3'"},
    {"--mu nan", 64, "got 'nan'"},
    {"--mu inf", 64, "got 'inf'"},
    {"--mu 1e999", 64, "got '1e999'"},
    {"--mu", 64, "--mu: expected a number >= 0, got nothing"},
    {"--poisson 0.51", 64, "--poisson: expected a number in (-1, 0.5], got '0.51'"},
    {"--poisson -1", 64, "--poisson: expected a number in (-1, 0.5], got '-1'"},
    {"--radius 0", 64, "--radius: expected a number > 0, got '0'"},
    {"--radius -50", 64, "--radius: expected a number > 0, got '-50'"},
    {"--young 0", 64, "--young: expected a number > 0, got '0'"},
    {"--load 0", 64, "--load: expected a number > 0"},
    {"--hub-ratio 1", 64, "--hub-ratio: expected a number in (0, 1), got '1'"},
    {"--arc 91", 64, "--arc: expected a number in (0, 90], got '91'"},
    {"--zone -1", 64, "--zone: expected a number > 0 or auto, got '-1'"},
    {"--contact-elements 60.5", 64, "--contact-elements: expected a whole number"},
    {"--contact-elements 99999999999", 64,
     "--contact-elements: expected a whole number in [3, 16777216], got '9999"},
    {"--contact-elements 2147483648", 64, "in [3, 16777216], got '2147483648'"},
    {"--contact-elements 99999999999999999999999", 64, "in [3, 16777216]"},
    {"--relaxation-time 1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17", 64,
     "--relaxation-time: expected at most 16 numbers"},
    {"--contact-elements -2147483649", 64,
     "--contact-elements: expected a whole number in [3, 16777216]"},
    {"--contact-elements 2", 64, "--contact-elements: expected a whole number in [3, 16777216]"},
    {"--formulation stedy", 64, "--formulation: expected static"},
    {"--support hook", 64, "--support: expected arc, hub or halfplane, got 'hook'"},
    {"--json=perhaps", 64, "--json: expected yes or no, got 'perhaps'"},
    {"--crep 0.1", 64, "unknown option '--crep' (did you mean '--creep'?)"},
    {"--raduis 5", 64, "unknown option '--raduis' (did you mean '--radius'?)"},
    {"--verzion", 64, "unknown option '--verzion' (did you mean '--version'?)"},
    {"--xyzzy", 64, "unknown option '--xyzzy'\n"},
    {"wear --tolerance mu=0.1", 64,
     "unknown option '--tolerance' (it is an option of rollbem, rollbem curve, rollbem sweep)"},
    {"lcp --mu 3", 64, "rollbem curve, rollbem sweep and others)"},
    {"-m 0.3", 64, "unknown option '-m'"},
    {"--output --json", 64, "--output: expected a name, got nothing"},
    {"--approach 1 --load 5", 64, "--approach and --load exclude each other"},
    {"--load 5 --half-width=1", 64, "--load and --half-width exclude each other"},
    {"--creep 0.1 --creep-ratio 1", 64, "--creep and --creep-ratio exclude each other"},
    {"--shift 1 --force 1", 64, "--shift and --force exclude each other"},
    {"--formulation steady --creep 0.1 --force 1", 64, "--creep and --force exclude each other"},
    {"--formulation steady --shift 1", 64, "shift"},
    {"--support hub --cover-thickness 4 --similar --load 10", 64,
     "--cover-thickness: its core holds the wheel, add --support-b hub"},
    {"--support halfplane --layer-thickness 1 --young 8 --poisson 0.3 --approach 3", 64,
     "the layer is compressed by 300 % of its thickness"},
    {"--support hub --cover-thickness 2 --young 8 --poisson 0.3 --approach 2.1", 64,
     "the cover is compressed by 105 % of its thickness"},
    {"--similar --young-b 1000", 64, "--similar and --young-b exclude each other"},
    {"--radius-b 50", 64, "--radius-b: body B is rigid without --similar or --young-b"},
    {"--plot a.bmp", 64, "--plot: expected a name ending in .png, .svg, .pdf, .eps or .tex"},
    {"--gap nowhere.txt", 66, "nowhere.txt"},
    {"nowhere.ini", 66, "nowhere.ini: No such file"},
    {"verfy", 66, "(did you mean 'verify'?)"},
    {"help xyzzy", 64, "help: nothing about 'xyzzy'"},
    {"help frobnicate mesh", 64, "help: nothing about 'frobnicate mesh'"},
    {"--contact-elements 10000000 --zone 10", 64, "GB of memory"},
    {"--force-ratio 1.5", 64, "friction carries at most 1"},
    {"--error --dump d", 64, "--dump: not together with error bars"},
    {"--smooth-derivatives --error", 64, "--smooth-derivatives: not together with error bars"},
    {"--increments 2 --approach 1 --derivatives all", 64, "under a given approach the unit of"},
    {"--increments 2 --load 1 --contact-elements 20000 --tolerance mu=1%", 64, "fewer than 1500"},
    {"--smooth-derivatives --formulation static --increments 3", 64,
     "--smooth-derivatives: not for a case with steps"},
    {"--smooth-derivatives --derivatives", 64,
     "--smooth-derivatives: not together with --derivatives"},
    {"--smooth-derivatives --tolerance mu=0.1", 64,
     "--smooth-derivatives: not together with --tolerance"},
    {"--smooth-derivatives max_temperature", 64,
     "--smooth-derivatives: this case has no max_temperature"},
    {"--derivatives approach,tangential_load:mu", 64,
     "--derivatives: expected RESULT without :OPTION, got 'tangential_load:mu'"},
    {"--derivatives p,temperature", 64, "--derivatives: this case has no temperature"},
    {"--smooth-derivatives solver", 64,
     "--smooth-derivatives: expected a result that has derivatives"},
    {"--support halfplane --similar --formulation steady --creep -1e-3 --interlayer-tangential "
     "1e-6 "
     "--yield-stress 30 --smooth-derivatives",
     64, "smooth derivatives: not for friction with memory or heat, or an interface that yields"},
    {"--support halfplane --load 500 --mu 0 --smooth-derivatives", 64,
     "slide in opposite directions without friction; take the exact derivatives"},
    {"design --support halfplane --load 500 --minimise max_pressure --maximise half_width "
     "--over radius=20:200",
     64, "--maximise: not together with --minimise"},
    {"--accuracy 0.1 --trace", 64, "--trace: not together with error bars"},
    {"--support halfplane --load 9 --contact-elements 2100 --fclib f.hdf5", 64,
     "--fclib: 2100 elements are too many for a dense W"},
    {"--support halfplane --hub-ratio 0.5", 64, "--hub-ratio: it needs the support hub"},
    {"--hub-ratio 0.5", 64, "--hub-ratio: it needs the support hub"},
    {"--support halfplane --outer-elements 40", 64,
     "rollbem: --outer-elements: it needs a wheel, half-planes have no elements around them"},
    {"--support halfplane --near-field plain", 64,
     "rollbem: --near-field: it needs a wheel, half-planes have no elements around them"},
    {"--support hub --datum 5", 64, "--datum: it needs the support halfplane"},
    {"--support hub --arc 5", 64, "--arc: it needs the support arc"},
    {"--similar --support halfplane --support-b hub --datum-b 5", 64,
     "--datum-b: it needs the support halfplane"},
    {"--young 1e300", 64, "--young: expected a size of 1e-100 to 1e+100"},
    {"--radius 1e-300", 64, "radius: expected a size of 1e-100 to 1e+100"},
    {"--load 1e300", 64, "load: expected a size of 1e-100 to 1e+100"},
    {"--mu 1e300", 64, "--mu: expected a size of 1e-100 to 1e+100"},
    {"--shift 1e300", 64, "--shift: expected a size of 1e-100 to 1e+100"},
    {"--zone 1e-300", 64, "--zone: expected a size of 1e-100 to 1e+100"},
    {"--support halfplane --datum 1e200", 64, "--datum: expected a size of 1e-100 to 1e+100"},
    {"--support halfplane --similar --datum-b 1e-300", 64, "--datum-b: expected a size of 1e-100"},
    {"--support halfplane --layer-thickness 1e200", 64, "--layer-thickness: expected a size of"},
    {"--support halfplane --interlayer-normal 1e200", 64, "--interlayer-normal: expected a size"},
    {"--half-width 60", 64, "half-width: expected less than the radius of either body, 50"},
    {"--support halfplane --similar --radius-b 2 --half-width 3", 64,
     "half-width: expected less than the radius of either body, 2"},
    {"--support halfplane --load 100 --young 1 --layer-thickness 0.01 --poisson 0.495 "
     "--mesh uniform --contact-elements 20",
     64, "--layer-thickness: with nu = 0.495 the elements"},
    {"--layer-thickness 2", 64, "rollbem: --layer-thickness: for the support halfplane only"},
    {"--slip-operator second", 64, "rollbem: --slip-operator: second is only for steady rolling"},
    {"wear --mu-heat 0.1,20,300", 64, "--mu-heat: wear has no temperatures"},
    {"--mu-heat 0.1,20,300", 64, "--mu-heat: needs temperatures, add --conductivity"},
    {"--free-axle", 64, "rollbem: --free-axle: it needs steady rolling"},
    {"--support halfplane --load 100 --young-b 1000 --layer-thickness-b 0.01 --poisson-b "
     "0.495 --mesh uniform --contact-elements 20",
     64, "--layer-thickness-b: with nu = 0.495 the elements"},
    {"--trace --solver newton", 64, "--trace: only --solver lemke pivots"},
    {"--support hub --contact-elements 3 --zone 47.5 --approach 1", 64,
     "no room for the element before it within the radius, 50 mm"},
};

TEST(bad_arguments_are_refused)
{
    for (size_t k = 0; k < sizeof bad_arguments / sizeof bad_arguments[0]; k++)
        if (is_in_turn((int)k, 8))
            check_refused(bad_arguments[k].arguments, bad_arguments[k].code, bad_arguments[k].part);
}

TEST(two_case_files_are_refused)
{
    check_refused("a.ini b.ini", 64, "'a.ini' and 'b.ini'");
    check_refused("-- --mu", 66, "--mu: No such file");
}

/* ---- Errors in case files ---------------------------------------------------------- */

static const struct {
    const char *text;
    const char *part;
} bad_files[] = {
    {"[friction]\nmu = 0.3\ncrep = 0.1\n", "case.ini:3: unknown key 'crep' (did you mean "
                                           "'creep'?)"},
    {"[frction]\nmu = 0.3\n", "case.ini:2: unknown section 'frction' (did you mean 'friction'?)"},
    {"[normal]\nmu = 0.3\n", "case.ini:2: key 'mu' belongs to section [friction], not [normal]"},
    {"# a comment\n\n  mu = abc\n", "case.ini:3: mu: expected a number >= 0, got 'abc'"},
    {"mu = nan\n", "case.ini:1: mu: expected a number >= 0, got 'nan'"},
    {"mu = 0.1\nmu = 0.2\n", "case.ini:2: key 'mu' was given before, in line 1"},
    {"mu = 0.1\nnonsense\n", "case.ini:2: expected [section] or key = value"},
    {"approach = 1\nload = 5\n", "case.ini:1: approach and case.ini:2: load exclude"},
    {"formulation = steady\nshift = 1\n", "case.ini:2: shift"},
    {"contact-elements = 10000000\nzone = 10\n", "GB of memory"},
};

TEST(bad_files_are_refused_with_their_line)
{
    for (size_t k = 0; k < sizeof bad_files / sizeof bad_files[0]; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        write_file("case.ini", bad_files[k].text);
        check_refused("case.ini", 65, bad_files[k].part);
    }
}

TEST(long_line_is_refused)
{
    char text[1200] = "mu = 0.3\nradius = ";
    memset(text + strlen(text), '1', 900);
    write_file("case.ini", text);
    check_refused("case.ini", 65, "case.ini:2: line too long");
}

TEST(bad_profile_is_refused)
{
    write_file("gap.txt", "0 1\n1 x\n");
    check_refused("--gap gap.txt", 65, "gap.txt:2: expected a number, got 'x'");
}

/* ---- Case files against options ---------------------------------------------------- */

static double member(const json_t *root, const char *group, const char *name)
{
    const json_t *value = json_object_get(json_object_get(root, group), name);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

TEST(case_file_equals_options)
{
    write_file("case.ini", "[body-a]\nsupport = halfplane\nradius = 40 ; mm\n"
                           "[normal]\n  load = 100\n[mesh]\n  contact-elements = 24\n"
                           "[friction]\n\tmu=0.2\n");
    held_json *a = run_json("case.ini");
    held_json *b = run_json(QUICK " --radius 40 --mu=0.2");
    assert_int_equal(json_equal(json_object_get(a, "inputs"), json_object_get(b, "inputs")), 1);
    assert_int_equal(json_equal(json_object_get(a, "table"), json_object_get(b, "table")), 1);
}

TEST(command_line_wins_over_the_file)
{
    write_file("case.ini", "support = halfplane\nload = 100\nmu = 0.2\n"
                           "contact-elements = 24\n");
    held_json *root = run_json("--mu 0.4 case.ini --half-width 0.3");
    CHECK_ABS(member(root, "inputs", "mu"), 0.4, 0.0, "mu");
    CHECK_ABS(member(root, "inputs", "half-width"), 0.3, 0.0, "half-width");
    assert_true(isnan(member(root, "inputs", "load"))); /* of the same group */
    CHECK_REL(member(root, "summary", "hertz_half_width"), 0.3, 1e-9, "half-width");
}

TEST(output_options_stand_in_the_file_too)
{
    write_file("case.ini", "support = halfplane\nload = 100\ncontact-elements = 24\n"
                           "[output]\njson = yes\nquiet = yes\n");
    assert_int_equal(rollbem("case.ini"), 0);
    assert_int_equal(out[0], '{');
    assert_string_equal(err, "");
    assert_int_equal(rollbem("--json=no case.ini"), 0);
    assert_int_equal(strncmp(out, "x_mm\t", 5), 0);
}

/* ---- Results ----------------------------------------------------------------------- */

TEST(json_and_table_hold_the_same_numbers)
{
    static const char *const names[] = {"x_mm",  "h_mm",  "gap_mm",   "p_MPa", "q_MPa",
                                        "un_mm", "ut_mm", "shift_mm", "slip",  "zone"};
    held_json *root = run_json(QUICK " --shift 0.001");
    const json_t *table = json_object_get(root, "table");
    assert_int_equal(rollbem(QUICK " --shift 0.001 --header=bare --quiet"), 0);
    assert_string_equal(err, "");
    char *line = strtok(out, "\n");
    assert_string_equal(line, "x_mm\th_mm\tgap_mm\tp_MPa\tq_MPa\tun_mm\tut_mm\tshift_mm\t"
                              "slip\tzone");
    size_t row = 0;
    for (line = strtok(NULL, "\n"); line; line = strtok(NULL, "\n"), row++)
        for (int j = 0; j < 10; j++) {
            const json_t *column = json_object_get(table, names[j]);
            CHECK_ABS(strtod(line, &line), json_number_value(json_array_get(column, row)), 0.0,
                      "%s row %zu", names[j], row);
        }
    assert_int_equal(row, 24);
    assert_int_equal(json_array_size(json_object_get(table, "x_mm")), 24);
}

/* P and Q summed from the table; |q| <= mu p; slip and zones by their words. */
TEST(table_obeys_its_own_conventions)
{
    held_json *root = run_json(QUICK " --formulation steady --creep-ratio 0.5 --mu 0.3");
    const json_t *table = json_object_get(root, "table");
    double P = 0.0, Q = 0.0;
    for (size_t i = 0; i < json_array_size(json_object_get(table, "h_mm")); i++) {
        const double h = json_number_value(json_array_get(json_object_get(table, "h_mm"), i));
        const double p = json_number_value(json_array_get(json_object_get(table, "p_MPa"), i));
        const double q = json_number_value(json_array_get(json_object_get(table, "q_MPa"), i));
        const int zone = (int)json_integer_value(json_array_get(json_object_get(table, "zone"), i));
        P += p * h;
        Q += q * h;
        assert_true(p >= 0.0);
        CHECK_MAX(fabs(q), 0.3 * p + 1e-9, "row %zu", i);
        if (zone == 2)
            CHECK_ABS(q, -0.3 * p, 1e-9, "row %zu", i);
        if (zone == 3)
            CHECK_ABS(q, 0.3 * p, 1e-9, "row %zu", i);
        if (zone == 0)
            CHECK_ABS(p, 0.0, 0.0, "row %zu", i);
    }
    CHECK_REL(P, 100.0, 1e-9, "P");
    CHECK_REL(Q, member(root, "summary", "tangential_load"), 1e-12, "Q");
    assert_true(Q < 0.0); /* braked */
}

/* Fitted is the default of steady rolling under a given load; what is asked for wins. */
TEST(the_mesh_asked_for_is_used)
{
    static const struct {
        const char *options, *mesh;
    } cases[] = {{"", "fitted"},
                 {"--mesh fitted", "fitted"},
                 {"--mesh uniform", "uniform"},
                 {"--mesh uniform --contact-elements 24", "uniform"},
                 {"--zone 2", "uniform"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char command[200];
        snprintf(command, sizeof command,
                 "--support halfplane --half-width 0.5 --formulation steady %s", cases[k].options);
        held_json *root = run_json(command);
        assert_string_equal(
            json_string_value(json_object_get(json_object_get(root, "inputs"), "mesh")),
            cases[k].mesh);
    }
}

TEST(header_names_the_command)
{
    CHECK_RUN(rollbem(QUICK " --gap exact --quiet -- "), 0, out, "# rollbem " RB_VERSION "\n");
    assert_non_null(strstr(out, "--contact-elements 24 --gap exact --quiet --\n"));
    write_file("it's.ini", "support = halfplane\nload = 100\ncontact-elements = 24\n");
    CHECK_RUN(rollbem("\"it's.ini\""), 0, out, "# rollbem 'it'\\''s.ini'\n");
}

TEST(readme_case_is_solved)
{
    CHECK_RUN(rollbem("--mu 0.3 --creep 0.1"), 0, err, "static: solved");
    assert_non_null(strstr(err, "S*"));
    assert_non_null(strstr(err, "--formulation steady")); /* the note */
}

TEST(version_help_and_usage)
{
    assert_int_equal(rollbem("--version"), 0);
    assert_string_equal(out, "rollbem " RB_VERSION "\n");
    CHECK_RUN(rollbem("--help"), 0, out, "--creep-ratio X");
    assert_non_null(strstr(out, "braked"));
    assert_non_null(strstr(out, "[MPa], > 0 (94500)"));
    CHECK_RUN(rollbem("--usage"), 0, out, "[--mu X]");
    CHECK_RUN(rollbem("help"), 0, out, "rollbem verify");
    for (char *line = strtok(out, "\n"); line; line = strtok(NULL, "\n"))
        CHECK_MAX((double)strlen(line), 100.0, "%s", line);
}

/* help WORD, --help=GROUP, --help=all, examples by either name. */
TEST(words_are_found)
{
    static const struct {
        const char *arguments, *there, *absent;
    } cases[] = {{"help temperature", "--conductivity X", "--zone"},
                 {"help temperature", "max_temperature [K]", "lcp-form"},
                 {"help GPa", "a unit of --young", "--mu "},
                 {"help basis", "Glossary\n  basis ", "--mu "},
                 {"help gnuplot", "Questions\n  Can I use it without gnuplot?", "--mu "},
                 {"help E", "--young X", "--mu X"},
                 {"help what is aligned", "Which mesh", "--mu "},
                 {"help 'How do I cite it?'", "CITATION.cff", "--zone"},
                 {"help relaxation time", "--relaxation-time X", "--zone"},
                 {"help lcp", "Usage: rollbem lcp", "Glossary"},
                 {"--help=mesh", "--contact-elements N", "--mu X"},
                 {"--help=mu", "--mu X", "--zone"},
                 {"curve --help=curve", "--points N", "--mu X"},
                 {"--help=all", "--zone X", "Glossary"},
                 {"--help=fringe", "Glossary", "--zone"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        assert_int_equal(rollbem(cases[k].arguments), 0);
        if (!strstr(out, cases[k].there) || strstr(out, cases[k].absent))
            fail_msg("rollbem %s: %s", cases[k].arguments, out);
    }
    static char whole[sizeof out];
    assert_int_equal(rollbem("--example rail --creep-ratio 0.4 --header=bare"), 0);
    strcpy(whole, out);
    assert_int_equal(rollbem("example rail --creep-ratio 0.4 --header=bare"), 0);
    assert_string_equal(out, whole);
    check_refused("sweep --vary-1 'mu 0.1' --results banana", 64,
                  "there are iterations, residual,");
}

/* Words of the books and the trades, each with a line of its own in the glossary. */
TEST(words_of_the_trades_are_found)
{
    char words[] =
        "adhesion, anisotropic, animation, bearing, belt, Blok, boundary lubrication, "
        "Boussinesq, braking, Brazilian, brush, bulge, bulk modulus, Burmister, calender, "
        "cam, cast iron, coating, conformal, contact filter, contour, corrugation, "
        "damping, diametral, dimensionless, dissipated energy, driven, durometer, dwell, EHL, "
        "elastomer, equivalent radius, Excel, face width, FASTSIM, fatigue, first yield, "
        "Flamant, footprint, full adhesion, Galin, gross slip, hardness, heat partition, "
        "Hertzian, hollow, Hunter, impact, indenter, isochromatic, Jaeger, Kalker, "
        "kinetic, LaTeX, locked, loss factor, lubricant, Maxwell, Mindlin, misalignment, "
        "Monte Carlo, needle, notebook, octahedral, p/p0, pandas, partial slip, periodic, "
        "photoelastic, pin, pitting, plasticity, PLI, Polach, point contact, punch, Pusey, pure "
        "rolling, raceway, ratchetting, ratcheting, RCF, reduced modulus, residual "
        "stress, reversal, rpm, Ruiz, sand, Shore, slide-to-roll, Spence, spin, squeal, "
        "SRR, standard linear solid, stick-slip, subsurface, SWT, tan delta, tensile, "
        "third-body, third body, tilt, tire, tooth, toughness, traction coefficient, "
        "tractive, twin disc, tyre, uncertainty, wavy, wear rate, wheel flat, Winkler";
    int k = 0;
    for (char *rest = words, *word; (word = strtok_r(rest, ",", &rest)) != NULL;) {
        if (!is_in_turn(k++, 8))
            continue;
        if (shellf("\"$R\" help %s", word) != 0 || !strstr(out, "Glossary"))
            fail_msg("rollbem help%s: %s%s", word, out, err);
    }
    /* all options that the glossary names are some command's */
    CHECK_RUN(
        shellf("for c in '' curve stress wear crack sweep fit design contact rubber; do \"$R\" $c "
               "--help=all; done >help; grep -o -- '--[a-z][a-z0-9-]*' %s/docs/glossary.md | "
               "sort -u | while read -r o; do grep -q -e \"$o\" help || echo $o; done; echo .",
               getenv("PWD")),
        0, out, ".\n");
    assert_string_equal(out, ".\n");
}

TEST(examples_are_given_as_json)
{
    check_refused("verify now", 64, "unexpected 'now'");
    assert_int_equal(rollbem("examples --json"), 0);
    json_t *root = json_loads(out, 0, NULL), *all = json_object_get(root, "examples");
    assert_true(json_array_size(all) > 10);
    for (size_t k = 0; k < json_array_size(all); k++) {
        const json_t *one = json_array_get(all, k);
        const char *kind = json_string_value(json_object_get(one, "kind"));
        const char *about = json_string_value(json_object_get(one, "about"));
        assert_true(strcmp(kind, "case") == 0 || strcmp(kind, "finite elements") == 0);
        assert_true(strlen(about) > 20 && about[strlen(about) - 1] != ' ');
    }
    json_decref(root);
}

/* In turn with the same list in Python (test_doors.py); what verify prints: tests/recorded/verify.
 */
TEST(references_are_given_as_json)
{
    if (!is_in_turn(2, 8))
        skip();
    assert_int_equal(rollbem("verify --json"), 0);
    write_file("r.json", out);
    json_t *root = json_loads(out, 0, NULL), *all = json_object_get(root, "references");
    assert_true(json_array_size(all) > 100);
    for (size_t k = 0; k < json_array_size(all); k++) {
        const json_t *one = json_array_get(all, k);
        const double wanted = number_in(one, "wanted"), error = number_in(one, "error");
        assert_true(json_is_true(json_object_get(one, "holds")));
        assert_true(error <= number_in(one, "bound"));
        const double off = fabs(number_in(one, "got") - wanted);
        if (json_is_true(json_object_get(one, "relative")))
            CHECK_ABS(error * fabs(wanted), off, 1e-12 * fabs(wanted), "error of %zu", k);
    }
    json_decref(root);
    check_refused("check r.json", 65, "(only single cases, histories, stress");
}

/* What the completion for bash offers behind words, the last of which is being written. */
TEST(completion_offers_names)
{
    static const struct {
        const char *words, *there, *absent;
    } rows[] = {
        {"rollbem --example ca", " cattaneo-to-carter ", " rail "},
        {"rollbem --derivatives ''", " force_ratio ", " iterations "},
        {"rollbem help cr", " crack ", " curve "},
        {"rollbem sweep --results force_ratio,max_s", " force_ratio,max_shear ", " max_shear "},
        {"rollbem sweep --show ''", " von_mises ", " radius "},
        {"rollbem sweep --vary-1 cr", " creep-ratio ", " radius "},
        {"rollbem sweep --over ''", " radius ", " force_ratio "},
        {"rollbem curve --over ''", " creep-ratio ", " radius "},
        {"rollbem design --minimise max_p", " max_pressure ", " radius "},
        {"rollbem design --over ra", " radius ", " force_ratio "},
        {"rollbem fit data --fit mu,mu", " mu,mu-fall ", " mu-fall "}};
    assert_int_equal(rollbem("--completion=bash"), 0);
    write_file("completion", out);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        assert_int_equal(shellf("bash -c \". ./completion; COMP_WORDS=(%s); "
                                "COMP_CWORD=\\$((\\${#COMP_WORDS[@]} - 1)); _rollbem; "
                                "printf ' %%s ' \\\"\\${COMPREPLY[@]}\\\"\"",
                                rows[k].words),
                         0);
        if (!strstr(out, rows[k].there) || strstr(out, rows[k].absent))
            fail_msg("%s: %s", rows[k].words, out);
    }
}

/* As first word the completion for bash offers every command that the help lists. */
TEST(completion_offers_every_command)
{
    assert_int_equal(shell("\"$R\" --completion=bash > completion && bash -c '. ./completion; "
                           "COMP_WORDS=(rollbem \"\"); COMP_CWORD=1; _rollbem; "
                           "printf \" %s \" \"${COMPREPLY[@]}\"'"),
                     0);
    char offered[sizeof out], word[40];
    strcpy(offered, out);
    assert_int_equal(rollbem("help"), 0);
    int commands = 0;
    for (const char *line = strstr(out, "\n  rollbem "); line;
         line = strstr(line + 1, "\n  rollbem "))
        if (sscanf(line, "\n  rollbem %39[a-z] ", word) == 1) {
            char as_offered[50];
            snprintf(as_offered, sizeof as_offered, " %s ", word);
            if (!strstr(offered, as_offered))
                fail_msg("not offered: %s", word);
            commands++;
        }
    assert_true(commands > 10);
}

/* What a command always refuses stands in none of its lists. */
TEST(no_list_shows_an_option_that_is_refused)
{
    static const struct {
        const char *command, *refused;
    } rows[] = {
        {"curve --points 2", "accuracy history distance steps irregularity increments time-step"},
        {"stress --grid 3x3", "accuracy"},
        {"wear --wear-coefficient 1e-9 --slide 1",
         "accuracy history increments distance steps irregularity relaxation-time "
         "relaxation-ratio-b yield-stress hardening conductivity heat-capacity-b"},
        {"crack --crack-length 1", "accuracy"},
        {"sweep --vary-1 'mu .1 .2' --crack-length .1", "accuracy paris threshold grow-to"},
        {"fit data --fit mu", "accuracy history creep shift force-ratio distance"},
        {"design --maximise force_ratio --over mu=.1:.2", "error accuracy history increments"}};
    write_file("data", "creep_ratio force_ratio\n.2 -.3\n.4 -.6\n.6 -.8\n");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (!is_in_turn((int)k, 6))
            continue;
        char names[300], command[24], said[80], *rest = names;
        strcpy(names, rows[k].refused);
        sscanf(rows[k].command, "%23s", command);
        assert_int_equal(
            shellf("for f in help usage describe=man describe=markdown; do \"$R\" %s --$f; done |"
                   " sed 's/\\\\//g'; \"$R\" --completion=fish | grep \"from %s'\" | "
                   "sed 's/ -l / --/'",
                   command, command),
            0);
        SCRATCH char *lists = strdup(out);
        for (const char *name; (name = strtok_r(rest, " ", &rest)) != NULL;) {
            int found = 0;
            snprintf(said, sizeof said, "--%s", name);
            for (const char *at = lists; (at = strstr(at, said)) != NULL; at += strlen(said))
                /* as an entry, not in a sentence about another one */
                found += !strchr("-abcdefghijklmnopqrstuvwxyz", at[strlen(said)]) &&
                         (strncmp(at - 2, "  ", 2) == 0 || strchr("[B`", at[-1]));
            if (found)
                fail_msg("%s shows %s", command, said);
            char arguments[200];
            const int flag = strcmp(name, "error") == 0;
            snprintf(arguments, sizeof arguments, "%s %s%s", rows[k].command, said,
                     flag                             ? ""
                     : strcmp(name, "accuracy") == 0  ? " .1"
                     : strcmp(name, "paris") == 0     ? " 1e-9,3"
                     : strcmp(name, "threshold") == 0 ? " 3"
                                                      : " 9");
            check_refused(arguments, 64, said);
        }
    }
}

/* What the schema describes of a case is what a result holds, no more and no less. */
TEST(the_schema_describes_every_input)
{
    held_json *result = run_json("--support halfplane --load 100"),
              *schema = run_json("--describe=schema");
    json_t *inputs = json_object_get(result, "inputs"),
           *described = json_object_get(
               json_object_get(json_object_get(schema, "properties"), "inputs"), "properties");
    const char *name;
    json_t *value;
    assert_true(json_object_size(inputs) > 50);
    assert_int_equal(json_object_size(described), json_object_size(inputs));
    json_object_foreach(inputs, name, value) if (!json_object_get(described, name))
        fail_msg("not described: %s", name);
}

TEST(not_solved_is_1)
{
    CHECK_RUN(rollbem("--approach 1e-9 --zone 5"), 1, err, "no contact");
    assert_null(strstr(err, "nan"));
    assert_non_null(strstr(out, "x_mm")); /* what there is, is printed */
    CHECK_RUN(rollbem("--approach 25 --zone 5"), 1, err, "zone");
    /* a solver that ends without a contact under a load does not widen the zone to nan */
    assert_int_equal(rollbem("--support halfplane --radius 69.4903 --young-b 210000 "
                             "--poisson-b .5 --radius-b 5 --support-b arc --gap parabola "
                             "--mu 2 --load 1.2e6 --formulation steady "
                             "--creep-ratio 1.2 --mesh fitted --solver nsn-jm-nls"),
                     1);
    assert_null(strstr(err, "nan"));
    /* nor are the few elements of the first solution too long for the lower half of a wheel */
    CHECK_RUN(rollbem("--support halfplane --young-b 210000 --radius-b 5 --support-b arc "
                      "--gap parabola --mu 2 --load 1.2e6 --formulation steady "
                      "--creep-ratio 1.2 --mesh fitted --contact-elements 30"),
              1, err, "the contact does not end within 4.75 mm");
    /* a cone solver that gives up on its own measure where the case's residual is met */
    assert_int_equal(rollbem("--support hub --similar --mu 0.1 --half-width 2 "
                             "--force-ratio 1 --contact-elements 55 --solver nsn-fb"),
                     0);
}

/* --similar is what naming everything of B would be, but for what B has by itself. */
TEST(similar_copies_all_that_a_has)
{
    static const char *const of[][3] = {
        {"--support halfplane --layer-thickness 2 --base-young 3e5 --base-poisson 0.2",
         "--layer-thickness-b 2 --base-young-b 3e5 --base-poisson-b 0.2", "none"},
        {"--support hub --radius-b 60 --support-b hub --cover-thickness 4 --core-young 2e5",
         "--cover-thickness-b 4 --core-young-b 2e5 --core-poisson-b 0.1", ""},
        {"--support halfplane --relaxation-time 0.01,0.1 --relaxation-ratio 1,0.5 --speed 9",
         "--relaxation-time-b 0.01,0.1 --relaxation-ratio-b 1,0.5", ""}};
    for (int k = 0; k < 3; k++) {
        static const char common[] = "--load 100 --formulation steady --force 0 "
                                     "--contact-elements 20 ";
        char words[600];
        snprintf(words, sizeof words, "%s%s --similar", common, of[k][0]);
        json_t *copied = run_json(words);
        snprintf(words, sizeof words, "%s%s --young-b 94500 --poisson-b 0.1 %s", common, of[k][0],
                 of[k][1]);
        held_json *named = run_json(words);
        CHECK_REL(member(copied, "summary", "max_pressure"),
                  member(named, "summary", "max_pressure"), 1e-13, "kind %d: p0", k);
        CHECK_ABS(member(copied, "summary", "creepage"), member(named, "summary", "creepage"),
                  1e-12, "kind %d: xi", k);
        json_decref(copied);
        snprintf(words, sizeof words,
                 "\"$R\" %s%s --similar %s --json > copied.json 2>/dev/null && \"$R\" "
                 "check copied.json > /dev/null",
                 common, of[k][0], of[k][2][0] ? "--layer-thickness-b none" : "");
        assert_int_equal(shell(words), 0);
    }
}

/* ---- Steps ------------------------------------------------------------------------- */

static size_t history_length(const json_t *root, const char *name)
{
    return json_array_size(json_object_get(json_object_get(root, "history"), name));
}

TEST(static_history_from_a_table)
{
    write_file("history.txt", "load force_ratio\n50 0\n100 0.5\n100 -0.5\n");
    held_json *root = run_json("--support halfplane --similar --contact-elements 24 "
                               "--gap parabola --history history.txt");
    assert_int_equal(history_length(root, "normal_load"), 3);
    assert_int_equal(history_length(root, "stick"), 3);
    CHECK_REL(member(root, "summary", "normal_load"), 100.0, 1e-9, "last load");
    CHECK_ABS(member(root, "summary", "force_ratio"), -0.5, 1e-9, "last force");
}

TEST(transient_rolls_step_by_step)
{
    held_json *root = run_json(QUICK " --similar --formulation transient --distance 1 "
                                     "--creep-ratio 0.5 --history-table steps.tsv");
    const size_t steps = history_length(root, "creepage");
    assert_true(steps > 5);
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(root, "summary"), "formulation")),
        "transient");
    OWNED(rb_io_table) t;
    CHECK_OK(rb_io_table_read("steps.tsv", &t, &message));
    assert_int_equal(t.columns, 19);
    assert_int_equal(t.rows, steps);
    CHECK_ABS(t.x[steps - 1 + 5 * steps], member(root, "summary", "tangential_load"), 1e-9,
              "Q of the last step");
}

/* A column replaces what a case file says, as the command line does. */
TEST(columns_win_over_the_case_file)
{
    write_file("history.txt", "load force_ratio\n50 0\n100 0.5\n");
    write_file("case.ini", "load = 7\nforce = 2\nsupport = halfplane\nsimilar = yes\n"
                           "gap = parabola\ncontact-elements = 24\n");
    held_json *root = run_json("case.ini --history history.txt");
    CHECK_REL(member(root, "summary", "normal_load"), 100.0, 1e-9, "last load");
    assert_true(json_is_null(json_object_get(json_object_get(root, "inputs"), "load")));
    check_refused("case.ini --history history.txt --load 5", 64,
                  "--load: the history has a column load");
    check_refused("--half-width 5 --history history.txt", 64,
                  "--half-width: the history has a column load");
    check_refused("--force 5 --history history.txt", 64,
                  "--force: the history has a column force_ratio");
    write_file("case.ini", "load = 7\nhistory = history.txt\n");
    check_refused("case.ini", 65, "case.ini:1: load: the history has a column load");
}

/* The unit of distance is told, and the rows end where the table does. */
TEST(distances_have_a_unit)
{
    write_file("history.txt", "distance load force_ratio\n0 100 0\n1 400 .5\n2 100 .5\n");
    held_json *root = run_json("--support halfplane --similar --gap parabola --contact-elements 24 "
                               "--formulation transient --history history.txt --history-table "
                               "steps.tsv");
    const json_t *history = json_object_get(root, "history");
    const size_t last = history_length(root, "distance") - 1;
    const double a = number_in(history, "half_width");
    char told[100];
    CHECK_ABS(entry(history, "distance", last), 2.0, 0.0, "the end of the way");
    CHECK_REL(entry(history, "normal_load", last), 100.0, 1e-9, "and its load");
    CHECK_REL(a, sqrt(4.0 * 400.0 * 50.0 * 2.0 * 0.99 / (3.14159265358979 * 94500.0)), 1e-9,
              "Hertz's half-width of the largest load");
    CHECK_REL(entry(history, "max_pressure", last), member(root, "summary", "max_pressure"), 1e-12,
              "p0");
    assert_int_equal(shell("grep -h '^# distance in a' steps.tsv"), 0);
    snprintf(told, sizeof told, "# distance in a = %.9g mm", a);
    assert_int_equal(strncmp(out, told, strlen(told)), 0);
    assert_int_equal(shell("\"$R\" --help | grep -c 'half-widths of the largest'"), 0);
}

/* Nothing touches where the surface is missing: null in JSON, nan in tables. */
TEST(lost_contact_has_no_ratios)
{
    write_file("hole.txt", "1.5 0\n2 .3\n4 1\n6 1\n8 .3\n9 0\n");
    held_json *root = run_json("--support halfplane --similar --gap parabola --contact-elements 24 "
                               "--formulation transient --approach .03 --creep .001 --distance 8 "
                               "--irregularity hole.txt --history-table steps.tsv --history-plot "
                               "steps.svg");
    const json_t *history = json_object_get(root, "history");
    int lost = 0;
    for (size_t i = 0; i < history_length(root, "distance"); i++)
        if (entry(history, "normal_load", i) == 0.0) {
            lost++;
            assert_true(json_is_null(json_array_get(json_object_get(history, "force_ratio"), i)));
            assert_true(json_is_null(json_array_get(json_object_get(history, "contact_to"), i)));
        }
    assert_true(lost > 3);
    assert_int_equal(shell("grep -v '^#' steps.tsv | grep -E -i -e '-nan|inf'"), 1);
    assert_int_equal(shell("grep -c NaN steps.tsv"), 0);
    /* and where the last state is such a one, people see none either */
    assert_int_equal(rollbem("--support halfplane --similar --gap parabola "
                             "--contact-elements 24 --formulation transient --approach "
                             ".03 --creep .001 --distance 4 --irregularity hole.txt"),
                     0);
    assert_non_null(strstr(err, "P = 0 N/mm"));
    assert_null(strstr(err, "nan"));
    assert_null(strstr(err, "inf"));
}

/* Increments come with their history, in studies with the last state only. */
TEST(increments_press_gradually)
{
    held_json *root = run_json("--support halfplane --gap parabola --load 100 "
                               "--contact-elements 40 --increments 5 --force-ratio .3 --error");
    assert_int_equal(history_length(root, "normal_load"), 10);
    CHECK_REL(entry(json_object_get(root, "history"), "normal_load", 0), 20.0, 1e-9,
              "the first increment");
    CHECK_ABS(member(root, "summary", "force_ratio"), 0.3, 1e-9, "the last state");
    json_t *table = json_object_get(json_object_get(root, "history"), "errors");
    assert_int_equal(json_array_size(json_object_get(table, "max_pressure")), 10);
    const double stick = member(root, "summary", "stick");
    assert_int_equal(rollbem("sweep --support halfplane --gap parabola --load 100 "
                             "--contact-elements 40 --force-ratio .3 --quiet "
                             "--vary-1 'increments 1 5'"),
                     0);
    write_file("study.tsv", out);
    assert_int_equal(shell("tail -1 study.tsv | cut -f14"), 0);
    CHECK_ABS(atof(out), stick, 0.0, "of the study's second case");
    write_file("history.txt", "load\n50\n");
    check_refused("curve --increments 5 --load 10", 64, "--increments:");
    check_refused("--formulation steady --increments 5", 64, "--increments:");
    held_json *rows = run_json("--support halfplane --gap parabola --contact-elements 24 "
                               "--history history.txt --increments 5");
    CHECK_ABS(entry(json_object_get(rows, "history"), "substeps", 0), 5.0, 0.0, "steps of a row");
    assert_int_equal(rollbem("--support halfplane --load 100 --mu 0 --increments 2"), 0);
    assert_null(strstr(err, "of work")); /* there is no friction */
}

TEST(irregularities_are_of_transients)
{
    write_file("open.txt", "1 0\n2 .3\n4 1\n");
    check_refused("--irregularity open.txt", 64, "--irregularity: only for transient rolling");
    check_refused("--formulation steady --irregularity open.txt", 64, "--irregularity:");
    check_refused("curve --irregularity open.txt", 64, "--irregularity:");
    check_refused("--formulation transient --creep 1e-3 --distance 1 --irregularity open.txt", 65,
                  "open.txt:3: expected gap 0 where it ends");
    check_refused("--formulation transient --creep 1e-3 --distance 1 --irregularity nowhere.txt",
                  66, "nowhere.txt");
}

TEST(bad_histories_are_refused)
{
    write_file("history.txt", "distance load\n0 50\n1 50\n");
    check_refused("--history history.txt", 65, "static contact does not roll");
    write_file("history.txt", "distance load\n1 50\n2 50\n");
    check_refused("--formulation transient --history history.txt", 65,
                  "history.txt:2: expected distance 0");
    write_file("history.txt", "load forc\n1 1\n");
    check_refused("--history history.txt", 65, "unknown column 'forc' (did you mean 'force'?)");
    write_file("history.txt", "1 1\n");
    check_refused("--history history.txt", 65, "expected a line that names the columns");
    write_file("history.txt", "load\n1\nx\n");
    check_refused("--history history.txt", 65, "history.txt:3:");
    check_refused("--history nowhere.txt", 66, "nowhere.txt");
    check_refused("--formulation steady --history history.txt", 64, "no history");
    check_refused("--distance 2", 64, "--distance: it needs transient rolling");
    check_refused("--formulation transient --creep 1e-3", 64, "--distance or --history");
    write_file("case.ini", "steps = 5\n");
    check_refused("case.ini", 65, "case.ini:1: steps: it needs transient rolling");
}

/* The steps that were finished are there. */
TEST(interrupted_run_keeps_its_steps)
{
    assert_int_equal(shell("\"$R\" " QUICK " --similar --formulation transient --distance 100000 "
                           "--creep-ratio 0.5 --json --quiet --output long.json & "
                           "p=$!; " WHEN_CAUGHT(INT_CAUGHT) "sleep 0.5; kill -INT $p; wait $p"),
                     1);
    assert_non_null(strstr(err, "interrupted after step"));
    held_json *root = NOT_NULL(json_load_file("long.json", 0, NULL));
    assert_true(history_length(root, "creepage") >= 1);
}

/* Files and pipes end, devices need not. */
TEST(devices_are_refused)
{
    static const char *const lines[] = {"--support halfplane --load 100 --gap /dev/zero",
                                        "--support halfplane --load 100 --worn /dev/urandom",
                                        "--support halfplane --load 100 --history /dev/zero",
                                        "/dev/zero",
                                        "stress --points /dev/zero",
                                        "lcp /dev/zero",
                                        "friction /dev/zero",
                                        "contact /dev/urandom",
                                        "check /dev/zero",
                                        "sweep /dev/zero"};
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        const int code = shellf("ulimit -t 10; timeout 20 \"$R\" %s", lines[k]);
        if (code != 65 || !strstr(err, ": a device, expected a file or a pipe"))
            fail_msg("%s: exit %d: %s", lines[k], code, err);
    }
    assert_int_equal(shell("printf -- '-3 0.09\n0 0\n3 0.09\n' | \"$R\" --support "
                           "halfplane --load 100 --gap /dev/stdin --quiet"),
                     0);
    if (!is_in_turn(0, 4))
        return;
    assert_int_equal(shell("yes '1 2' | head -c 300M | \"$R\" --support halfplane --load "
                           "100 --gap /dev/stdin"),
                     65);
    assert_non_null(strstr(err, "/dev/stdin: more than 256 MB"));
}

/* So many threads ended in a signal of OpenMP's. */
TEST(threads_are_bounded)
{
    assert_int_equal(shell("OMP_NUM_THREADS=100000 \"$R\" stress --support halfplane "
                           "--load 100 --contact-elements 100 --grid 60x60 --quiet"),
                     0);
    assert_string_equal(err, "");
}

/* An OpenBLAS that is older than the processor chooses kernels of 2004. */
TEST(kernels_are_those_of_the_processor_or_of_the_user)
{
    assert_int_equal(shell("OPENBLAS_CORETYPE=Prescott \"$R\" --json --quiet"), 0);
    if (!strstr(out, "\"openblas\": \"Prescott\""))
        skip(); /* an OpenBLAS with kernels of one kind */
    assert_int_equal(shell("env -u OPENBLAS_CORETYPE \"$R\" --json --quiet"), 0);
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        assert_null(strstr(out, "\"openblas\": \"Prescott\""));
#endif
}

/* Under nohup it goes on when the terminal goes; without, it is interrupted. */
TEST(a_terminal_that_goes_interrupts_unless_nohup)
{
    for (int nohup = 0; nohup < 2; nohup++) {
        char line[500];
        snprintf(line, sizeof line,
                 "%s \"$R\" " QUICK " --similar --formulation transient --distance 100000 "
                 "--creep-ratio 0.5 --quiet --output gone.tsv & p=$!; " WHEN_CAUGHT(
                     "%s") "kill -HUP $p; %s wait $p",
                 /* the tests themselves may run under nohup */
                 nohup ? "trap '' HUP;" : "env --default-signal=HUP",
                 nohup ? INT_CAUGHT : HUP_CAUGHT,
                 nohup ? "sleep 0.3; kill -INT $p || exit 9;" : "");
        CHECK_RUN(shell(line), 1, err, "interrupted after step");
    }
}

/* ---- Error bars -------------------------------------------------------------------- */

/* s = 0.4: exact Q/(mu P) = -0.64. */
TEST(error_bars_hold_the_truth)
{
    json_t *root = run_json("--support halfplane --similar --gap parabola --load 100 "
                            "--formulation steady --creep-ratio 0.4 --mesh fitted --error");
    const json_t *summary = json_object_get(root, "summary");
    const double error =
        json_number_value(json_object_get(json_object_get(summary, "errors"), "force_ratio"));
    CHECK_ABS(member(root, "summary", "force_ratio"), -0.64, error, "force ratio");
    assert_true(error > 0.0 && error < 0.01);
    json_decref(root);
    root = run_json("--support halfplane --similar --gap parabola --load 100 "
                    "--formulation steady --creep-ratio 0.4 --mesh fitted --accuracy 1e-3");
    CHECK_REL(member(root, "summary", "force_ratio"), -0.64, 1e-3, "force ratio");
    json_decref(root);
    CHECK_RUN(rollbem(QUICK " --error"), 0, err, "max_pressure");
    check_refused("--accuracy 2", 64, "--accuracy: expected a number in (0, 1) or off");
    check_refused("--formulation transient --distance 1 --creep 0 --accuracy 1e-3", 64,
                  "--accuracy: only for static and steady cases");
}

/* ---- Behind the solution ----------------------------------------------------------- */

static double *read_matrix(const char *name, int rows, int cols)
{
    rb_io_matrix m;
    const rb_status s = rb_io_matrix_market_read(name, &m, &message);
    if (s != RB_OK)
        fail_msg("%s", message.text);
    assert_int_equal(m.rows, rows);
    assert_int_equal(m.cols, cols);
    assert_int_equal(rb_io_matrix_to_dense(&m), RB_OK);
    return m.dense;
}

/* The dumped LCP solved again gives the pressures of the table; the first tableau of the
 * trace, after z0 has entered, holds M and b. */
TEST(dump_holds_the_problem)
{
    enum { N = 6, SIZE = 3 * N };
    held_json *root = run_json("--approach 5 --zone 20 --contact-elements 6 --dump d --trace "
                               "2>trace");
    SCRATCH double *M = read_matrix("d/M.mtx", SIZE, SIZE), *b = read_matrix("d/b.mtx", SIZE, 1);
    double *scale = read_matrix("d/z_scale.mtx", SIZE, 1), z[SIZE];
    SCRATCH double *F = read_matrix("d/F.mtx", 2 * (N + 1), 2 * N);
    rb_lcp_info info;
    assert_int_equal(rb_lcp_lemke(&(rb_lcp_problem){SIZE, M, SIZE, b}, NULL, z, &info), RB_OK);
    const json_t *table = json_object_get(root, "table");
    for (size_t i = 0; i < N; i++) {
        const double p = json_number_value(json_array_get(json_object_get(table, "p_MPa"), i));
        CHECK_ABS(z[i] * scale[i], p, 1e-8 * 1e4, "p[%zu]", i);
    }
    assert_true(F[0] > 0.0);
    char last[40], row[60];
    snprintf(last, sizeof last, "d/tableau_%d.mtx", info.iters);
    free(read_matrix(last, SIZE, SIZE + 2));
    snprintf(row, sizeof row, "pivot %4d ", info.iters);
    slurp("trace", err, sizeof err);
    assert_non_null(strstr(err, row));
    assert_non_null(strstr(err, "z0           enters"));
    free(read_matrix("d/contact.mtx", N, 3));
    free(scale);
}

/* H annihilates the two translations. */
TEST(dumped_influence_moves_rigidly)
{
    OWNED(rb_io_matrix) m;
    assert_int_equal(rollbem("--approach 5 --zone 20 --contact-elements 6 --dump h"), 0);
    assert_int_equal(rb_io_matrix_market_read("h/H.mtx", &m, NULL), RB_OK);
    assert_int_equal(rb_io_matrix_to_dense(&m), RB_OK);
    for (int i = 0; i < m.rows; i++)
        for (int d = 0; d < 2; d++) {
            double sum = 0.0;
            for (int j = d; j < m.cols; j += 2)
                sum += m.dense[i + (size_t)j * (size_t)m.rows];
            CHECK_ABS(sum, 0.0, 1e-12, "row %d", i);
        }
}

static double table_entry(const json_t *root, const char *column, int i)
{
    const json_t *table = json_object_get(root, "table");
    return json_number_value(json_array_get(json_object_get(table, column), (size_t)i));
}

/* Row i, column j of a Toeplitz block from its first and last column. */
static double toeplitz(const double *first, const double *last, int n, int i, int j)
{
    return i >= j ? first[i - j] : last[n - 1 + i - j];
}

/* Where no matrix is formed, four columns are dumped; with the tractions of the table
 * they give its displacements. */
TEST(dump_of_a_large_contact_holds_its_flexibility)
{
    enum { N = 1500, M = N + 1 };
    held_json *root = run_json("--support halfplane --half-width 0.05 --contact-elements "
                               "1500 --shift 1e-5 --dump large");
    SCRATCH double *F = read_matrix("large/F_columns.mtx", 2 * M, 4);
    const double *NN = F, *NT = F + 4 * M; /* first columns; the last ones follow */
    double largest = 0.0;
    for (int i = 0; i < N; i++)
        largest = fmax(largest, fabs(table_entry(root, "un_mm", i)));
    for (int i = 0; i < N; i += 7) {
        double un = 0.0, ut = 0.0;
        for (int j = 0; j < N; j++) {
            const double p = table_entry(root, "p_MPa", j), q = table_entry(root, "q_MPa", j);
            un += toeplitz(NN, NN + 2 * M, N, i, j) * p + toeplitz(NT, NT + 2 * M, N, i, j) * q;
            ut += toeplitz(NN + M, NN + 3 * M, N, i, j) * p +
                  toeplitz(NT + M, NT + 3 * M, N, i, j) * q;
        }
        CHECK_ABS(un, table_entry(root, "un_mm", i), 1e-12 * largest, "un of %d", i);
        CHECK_ABS(ut, table_entry(root, "ut_mm", i), 1e-12 * largest, "ut of %d", i);
    }
    free(read_matrix("large/contact.mtx", N, 3));
    assert_int_equal(system("test \"$(ls -A large | tr '\\n' ' ')\" = "
                            "'F_columns.mtx contact.mtx '"),
                     0);
    assert_int_equal(rollbem("--support halfplane --half-width 0.05 --contact-elements "
                             "1500 --fclib large.h5 --dump none"),
                     64);
    assert_non_null(strstr(err, "--fclib: 1500 elements are too many"));
    assert_int_not_equal(system("test -e large.h5 || test -e none"), 0);
}

TEST(dump_that_cannot_be_written)
{
    assert_int_equal(rollbem(QUICK " --dump /nonexistent/d"), 73);
    write_file("file", "");
    CHECK_RUN(rollbem(QUICK " --dump file"), 73, err, "file: cannot write: Not a directory");
    CHECK_RUN(rollbem(QUICK " --solver newton --trace"), 64, err, "--solver lemke pivots");
}

/* The solution is Newton's, of a start with the zones of the mesh before: Lemke's pivots
 * can be seen all the same. */
TEST(trace_of_a_case_that_newton_solved)
{
    assert_int_equal(rollbem("--support arc --similar --radius-b 50 --support-b arc --formulation "
                             "static --mesh fitted --contact-elements 40 --gap parabola --mu 1e-3 "
                             "--load 800 --force-ratio -0.4 --near-field exact --trace"),
                     0);
    assert_non_null(strstr(err, "pivot    1 "));
}

/* The reason is told, not that there is nothing to draw. */
TEST(no_picture_of_no_steps)
{
    write_file("steep.txt", "load shift\n800 1\n800 2\n");
    assert_int_equal(rollbem("--support hub --formulation static --history steep.txt "
                             "--zone 0.1 --contact-elements 20 --history-plot h.svg"),
                     1);
    assert_non_null(strstr(err, "the contact is not within the potential contact"));
    assert_null(strstr(err, "no steps to draw"));
}

/* ---- Writing ----------------------------------------------------------------------- */

TEST(output_is_whole_or_not_there)
{
    struct stat st;
    assert_int_equal(rollbem(QUICK " --quiet --output table.tsv"), 0);
    assert_string_equal(out, "");
    assert_int_equal(stat("table.tsv", &st), 0);
    assert_int_equal(rollbem(QUICK " --quiet"), 0);
    static char table[100000];
    slurp("table.tsv", table, sizeof table);
    assert_string_equal(strstr(table, "# x to"), strstr(out, "# x to"));

    check_refused(QUICK " --output /nonexistent/table.tsv", 73, "/nonexistent/table.tsv");
    check_refused("--mu abc --output none.tsv", 64, "--mu");
    assert_int_not_equal(stat("none.tsv", &st), 0);
    check_refused("--formulation steady --shift 1 --output none.tsv", 64, "shift");
    assert_int_not_equal(stat("none.tsv", &st), 0);
    assert_int_equal(shell("ls | grep -c none"), 1); /* nor a temporary file */
}

TEST(full_device_is_73)
{
    if (access("/dev/full", W_OK) != 0)
        skip();
    CHECK_RUN(shell("\"$R\" " QUICK " --quiet >/dev/full"), 73, err, "No space left");
    assert_int_equal(shell("\"$R\" --help >/dev/full"), 73);
    assert_int_equal(shell("\"$R\" --completion=bash >/dev/full"), 73); /* before the last flush */
    assert_non_null(strstr(err, "No space left"));
    assert_int_equal(shell("\"$R\" " QUICK " --quiet --json >/dev/full"), 73);
    assert_int_equal(rollbem(QUICK " --quiet --output /dev/full"), 73);
}

/* The reader is gone before anything is written. */
TEST(closed_pipe_is_73)
{
    assert_int_equal(shell("{ sleep 0.2; \"$R\" " QUICK " --quiet; echo $? >code; } | true; "
                           "sleep 0.4; exit $(cat code)"),
                     73);
    assert_string_equal(err, ""); /* | head has seen enough */
}

TEST(pictures_are_written_or_not_there)
{
    struct stat st;
    assert_int_equal(rollbem(QUICK " --quiet --plot picture.png"), 0);
    assert_int_equal(stat("picture.png", &st), 0);
    assert_true(st.st_size > 10000);
    /* a name full of what shells and gnuplot would read */
    assert_int_equal(rollbem(QUICK " --quiet --plot \"a'b;touch x \\$(touch y).svg\""), 0);
    assert_int_equal(stat("a'b;touch x $(touch y).svg", &st), 0);
    assert_int_not_equal(stat("x", &st), 0);
    assert_int_not_equal(stat("y", &st), 0);
    assert_int_equal(rollbem(QUICK " --quiet --plot /nonexistent/a.png"), 73);
    assert_int_equal(shell("PATH=/nonexistent \"$R\" " QUICK " --quiet --plot none.png"), 70);
    assert_non_null(strstr(err, "gnuplot is not installed"));
    assert_int_not_equal(stat("none.png", &st), 0);
}

/* ---- The run ----------------------------------------------------------------------- */

/* What goes for one command that solves a case goes for all. */
/* At half of full sliding the stick zone ends at 0 but for rounding. */
TEST(rounding_about_0_is_0)
{
    assert_int_equal(rollbem("--support halfplane --similar --load 500 --creep-ratio 0.5 "
                             "--formulation steady"),
                     0);
    assert_non_null(strstr(err, "; stick 0 ... 0.81"));
    /* where no element sticks, Q = 0 has a range of shifts */
    assert_int_equal(rollbem("--support halfplane --load 100 --mu .01 --force 0 "
                             "--contact-elements 40"),
                     0);
    assert_non_null(strstr(err, "slide towards both sides: the shift is not unique"));
    assert_int_equal(rollbem("--support halfplane --load 100 --mu .01 --force-ratio 1"), 0);
    assert_null(strstr(err, "not unique"));
    /* not of something small in small units */
    assert_int_equal(rollbem("--support halfplane --load 1e-12 --radius 1e-15 --format brief"), 0);
    assert_non_null(strstr(out, "e-17 "));
    /* no study of rounding */
    assert_int_equal(rollbem("sweep --support halfplane --load 3000 --vary-1 'mu .1 .2' --quiet "
                             "--vary-2 'young 1e5 2e5' --show tangential_load --map a.png "
                             "--plot-script a.gp && grep 'all 0 but for rounding' a.gp"),
                     0);
}

TEST(commands_on_a_case_offer_the_same)
{
    static const char *const commands[] = {
        "", "stress --grid 5x4", "wear --cycles 1 --wear-coefficient 1e-10", "curve --points 3"};
    for (size_t k = 0; k < sizeof commands / sizeof *commands; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        char line[300];
        snprintf(line, sizeof line, "%s --example rail --contact-elements 12 --mesh uniform --cite",
                 commands[k]);
        held_json *root = run_json(line);
        assert_true(json_is_object(json_object_get(root, "units")));
        assert_true(json_is_object(json_object_get(root, "inputs")));
        assert_true(json_is_array(json_object_get(root, "notes")));
        assert_non_null(strstr(err, "This run rests on"));
    }
}

/* A table of --history-table is a history: it gives the same steps again. */
TEST(history_tables_are_histories)
{
#define STEPS "--similar --support halfplane --contact-elements 30 --quiet "
    static const struct {
        const char *first, *again;
    } runs[] = {
        {"--formulation transient --load 100 --creep-ratio 0.4 --distance 1",
         "--formulation transient"},
        {"--formulation transient --load 100 --creep-ratio 1.5 --distance 3",
         "--formulation transient"},
        {"--formulation transient --load 100 --force-ratio -0.5 --distance 1 --increments 3",
         "--formulation transient"},
        {"--load 100 --shift 0.001 --increments 4", ""},
        {"--load 100 --force-ratio 0.4 --increments 4 --units si --radius 0.05 --young 9.45e10",
         "--units mm"},
        {"--formulation transient --load 100 --creep-ratio 0.4 --distance 1 --error",
         "--formulation transient"},
        {"--load 100 --shift 0.001 --increments 2 --mu 0 --format csv", "--mu 0"}};
    for (size_t k = 0; k < sizeof runs / sizeof *runs; k++) {
        OWNED(rb_io_table) a, b;
        const double *q[2];
        static const rb_io_column of_Q[] = {{"tangential_load", NULL, "N/mm", RB_IO_COLUMN_NEEDED},
                                            {NULL, NULL, "-", RB_IO_COLUMN_UNUSED}};
        assert_int_equal(rollbemf(STEPS "%s --history-table a.tsv && \"$R\" " STEPS
                                        "%s --history a.tsv --history-table b.tsv",
                                  runs[k].first, runs[k].again),
                         0);
        CHECK_OK(rb_io_table_read("a.tsv", &a, &message));
        CHECK_OK(rb_io_table_read("b.tsv", &b, &message));
        assert_int_equal(a.rows, b.rows);
        CHECK_OK(rb_io_table_assign("a", &a, 2, of_Q, RB_UNITS_MM, &q[0], &message));
        const double *first = q[0];
        CHECK_OK(rb_io_table_assign("b", &b, 2, of_Q, RB_UNITS_MM, &q[0], &message));
        for (int i = 0; i < a.rows; i++)
            CHECK_ABS(q[0][i], first[i], 1e-8 * fabs(first[a.rows - 1]), "%s, Q of row %d",
                      runs[k].first, i + 1);
    }
    CHECK_RUN(rollbem(STEPS "--history a.tsv --shift 0.1"), 64, err,
              "--shift: the history has a column shift");
}

RUN_TESTS(enter_folder, leave_folder)
