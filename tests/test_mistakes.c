/* Typical mistakes: one line each, with the words that help; and the first minute:
 * examples, notes, a terminal. */
#include "cli_run.h"

static const struct {
    const char *arguments, *wanted;
} mistakes[] = {
    {"--vary 'mu 0.1 0.2'", "did you mean '--vary-1'"},
    {"sweep --vary 'mu 0.1 0.2'", "did you mean '--vary-1'"},
    {"curve --mu 0.1 0.2", "commas between, as --mu 0.1,0.2"},
    {"--mu 0.1 0.2", "commas between, as --mu 0.1,0.2"},
    {"--mu 0.1,0.2", "a curve takes several"},
    {"-mu 0.3", "options start with --, as --mu"},
    {"-o table.tsv", "as --output"},
    {"--E 210000", "did you mean '--young'"},
    {"--nu 0.3", "did you mean '--poisson'"},
    {"--friction 0.3", "did you mean '--mu'"},
    {"--creepage 0.01", "did you mean '--creep'"},
    {"--steady", "did you mean '--formulation steady'"},
    {"--halfplane", "did you mean '--support halfplane'"},
    {"--csv", "did you mean '--format csv'"},
    {"--elements 50", "did you mean '--contact-elements'"},
    {"--radus 460", "did you mean '--radius'"},
    {"--support half-plane", "arc, hub or halfplane"},
    {"--formulation rolling", "static, steady or transient"},
    {"--mu abc", "expected a number >= 0, got 'abc'"},
    {"--mu -0.3", "expected a number >= 0, got '-0.3'"},
    {"--poisson 0.6", "0.5"},
    {"--mu", "expected a number >= 0, got nothing"},
    {"--young 210GPA", "did you mean 'GPa'"},
    {"--young 210 GPa", "one case file at a time|No such file"},
    {"--radius 18inches", "did you mean 'inch'"},
    {"--load 100kN", "a number in one of N/mm, N/m"},
    {"--load 100 --approach 1", "exclude each other"},
    {"--formulation steady --shift 1", "shift"},
    {"--formulation transient --creep 0.001", "--distance or --history"},
    {"--young-b 70000 --similar", "exclude each other"},
    {"--poisson-b 0.3", "body B is rigid without --similar or --young-b"},
    {"--arc 30 --support hub", "of the support arc only"},
    {"--plot picture.jpg", ".png, .svg or .pdf"},
    {"--plot", "expected a name, got nothing"},
    {"--output nowhere/table.tsv", "nowhere/table.tsv"},
    {"cas.ini", "No such file"},
    {"curv", "did you mean 'curve'"},
    {"solve --mu 0.3", "rollbem [OPTION...] [CASE.ini] solves"},
    {"run hash.ini", "rollbem [OPTION...] [CASE.ini] solves"},
    {"hash.ini", "a comment begins with ';', got '460 # comment'"},
    {"typo.ini", "unknown key 'crep' (did you mean 'creep'"},
    {"section.ini", "belongs to section"},
    {"--gap one.txt --load 10", "one.txt:1: expected 2 numbers, got 1"},
    {"--example rial", "did you mean 'rail'"},
    {"--example rail good.ini", "one of them"},
    {"curve --creep 0.001", "the curve runs over --from"},
    {"curve --from 1 --to 1", "expected two different values"},
    {"sweep", "a study needs --vary-1 or --cases"},
    {"lcp", "expected at least one FILE"},
    {"example wheel", "expected bar, truss or wall"},
    {"--units metric", "mm, si or inch"},
};

static void forty_mistakes_get_a_line_that_helps(void **state)
{
    (void)state;
    int wrong = 0;
    write_file("hash.ini", "radius = 460 # comment\n");
    write_file("good.ini", "mu = 0.2\n");
    write_file("typo.ini", "crep = 0.001\n");
    write_file("section.ini", "[friction]\nradius = 460\n");
    write_file("one.txt", "1\n2\n3\n");
    assert_true(sizeof mistakes / sizeof *mistakes >= 40);
    for (size_t k = 0; k < sizeof mistakes / sizeof *mistakes; k++) {
        char first[200];
        const char *wanted = mistakes[k].wanted, *other = strchr(wanted, '|');
        const int code = rollbem(mistakes[k].arguments);
        snprintf(first, sizeof first, "%.*s", (int)strcspn(wanted, "|"), wanted);
        const size_t n = strlen(err);
        if ((!strstr(err, first) && !(other && strstr(err, other + 1))) || code < 64 ||
            n == 0 || strchr(err, '\n') != err + n - 1 || out[0]) {
            print_error("rollbem %s (%d): %s", mistakes[k].arguments, code, err);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
}

/* What is no error, and perhaps not what was meant. */
static void doubtful_values_are_noted(void **state)
{
    (void)state;
    static const char *const all[][2] = {
        {"", "linear elasticity does not hold"},
        {"--mu 0.3 --creep 0.1", "for rolling, --formulation steady"},
        {"--example rail", "rolls at creepage 0"},
        {"--example rail --creep 0.4", "is the creepage meant in %"},
        {"--arc 0.5", "is it meant in radians"},
        {"--example rail --radius 0.46", "linear elasticity does not hold"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        char line[200];
        rollbem(all[k][0]);
        const char *note = strstr(err, all[k][1]), *summary = strstr(err, "  load ");
        if (!note || !summary)
            fail_msg("rollbem %s: %s", all[k][0], err);
        assert_true(note < summary); /* before the numbers */
        const char *line_of_table = strstr(out, all[k][1]);
        assert_non_null(line_of_table);
        snprintf(line, sizeof line, "%s --json --quiet", all[k][0]);
        rollbem(line);
        assert_string_equal(err, "");
        json_t *root = json_loads(out, 0, NULL);
        int found = 0;
        size_t i;
        json_t *text;
        json_array_foreach(json_object_get(root, "notes"), i, text) found |=
            strstr(json_string_value(text), all[k][1]) != NULL;
        assert_true(found);
        json_decref(root);
    }
}

/* A creepage that the program found is not what somebody typed. */
static void found_creepage_is_not_doubted(void **state)
{
    (void)state;
    assert_int_equal(rollbem("--formulation steady --support hub --mu 1e-3 --free-axle "
                             "--approach 0.04 --contact-elements 40"),
                     0);
    assert_null(strstr(err, "is the creepage meant"));
}

static void examples_are_at_hand(void **state)
{
    (void)state;
    assert_int_equal(rollbem("examples"), 0);
    assert_non_null(strstr(out, "--example rail "));
    assert_non_null(strstr(out, "--example paper "));
    json_t *root = run_json("--example rail --creep-ratio 0.4");
    CHECK_REL(number_in(json_object_get(root, "summary"), "force_ratio"), -0.64, 1e-4,
              "Carter");
    json_decref(root);
    root = run_json("curve --example rail --points 3");
    json_decref(root);
    assert_int_equal(rollbem("sweep --example rail --vary-1 'mu 0.1 0.2' --quiet"), 0);
    assert_int_equal(rollbem("-h"), 0);
    assert_ptr_equal(strstr(out, "Usage: rollbem"), out);
}

/* On a terminal: the summary, then a short table; whoever asks for a form gets it. */
static void terminals_get_a_short_table(void **state)
{
    (void)state;
    if (shell("command -v script") != 0)
        skip();
    assert_int_equal(
        shell("script -qec \"'$R' --example rail --creep-ratio 0.4\" typescript"), 0);
    const char *summary = strstr(out, "  load "), *table = strstr(out, "p_MPa");
    assert_non_null(summary);
    assert_non_null(table);
    assert_true(summary < table);
    assert_null(strstr(out, "# rollbem"));
    int lines = 0;
    for (const char *c = out; *c; c++)
        lines += *c == '\n';
    assert_true(lines < 40);
    assert_int_equal(shell("script -qec \"'$R' --example rail --format tsv\" typescript"),
                     0);
    assert_non_null(strstr(out, "# rollbem"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forty_mistakes_get_a_line_that_helps),
        cmocka_unit_test(doubtful_values_are_noted),
        cmocka_unit_test(found_creepage_is_not_doubted),
        cmocka_unit_test(examples_are_at_hand),
        cmocka_unit_test(terminals_get_a_short_table),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
