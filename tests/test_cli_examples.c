/* The recorded outputs of examples/ against what the program prints today, numbers
 * compared as numbers.  Run from the project's root; B: the build directory. */
#include "pages.h"
#include "base/io/io.h"

#include <unistd.h>

static char folder[] = "/tmp/rollbem-examples-XXXXXX";

static const char *build_folder(void)
{
    const char *build = getenv("B");
    return build ? build : "build";
}

static void read_table(const char *path, rb_io_table *t)
{
    rb_message why = {.text = ""};
    if (rb_io_table_read(path, t, &why) != RB_OK)
        print_error("%s\n", why.text);
    assert_string_equal(why.text, "");
    assert_non_null(t->name);
}

/* Every column to 1e-7 of its largest entry; zones exactly; residuals are rounding, and
 * so is the moment of similar bodies, of P a. */
static double tolerance_of(const char *name, double scale)
{
    if (strcmp(name, "zone") == 0)
        return 0.0;
    if (strcmp(name, "residual") == 0 || strcmp(name, "resistance_moment_N") == 0)
        return 1e-7 * scale + 1e-9;
    return 1e-7 * scale + 1e-12;
}

static void compare_tables(const char *got_path, const char *wanted_path)
{
    OWNED(rb_io_table) got, wanted;
    read_table(got_path, &got);
    read_table(wanted_path, &wanted);
    assert_int_equal(got.rows, wanted.rows);
    assert_int_equal(got.columns, wanted.columns);
    for (int j = 0; j < wanted.columns; j++) {
        const char *name = wanted.name[j];
        const double *x = wanted.x + j * wanted.rows;
        const double tol = tolerance_of(name, rb_norm_inf((size_t)wanted.rows, x));
        assert_string_equal(got.name[j], name);
        for (int i = 0; i < wanted.rows; i++)
            CHECK_ABS(got.x[i + j * wanted.rows], x[i], tol, "%s: row %d, %s", wanted_path, i + 1,
                      name);
    }
}

TEST(tables_are_as_recorded)
{
    static const struct {
        const char *command, *output, *wanted;
    } cases[] = {{"examples/paper/case.ini", "--output", "paper/output"},
                 {"examples/paper/case-mu01.ini", "--output", "paper/output-mu01"},
                 {"examples/hertz/case.ini", "--output", "hertz/output"},
                 {"examples/carter/case.ini", "--output", "carter/output"},
                 {"examples/by-hand/case.ini", "--output", "by-hand/output"},
                 {"examples/two-bodies/case.ini", "--output", "two-bodies/output"},
                 {"examples/cattaneo-to-carter/case.ini", "--output /dev/null --history-table",
                  "cattaneo-to-carter/history"},
                 {"curve examples/rail/case.ini --points 31 --contact-elements 50", "--output",
                  "rail/curve"},
                 {"stress examples/rail/case.ini --force-ratio -0.6 --grid 13x7", "--output",
                  "rail/stress"}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        char got[200], wanted[200];
        if (!is_in_turn((int)k, 3))
            continue;
        snprintf(got, sizeof got, "%s/table.tsv", folder);
        snprintf(wanted, sizeof wanted, "examples/%s.tsv", cases[k].wanted);
        assert_int_equal(run("%s/rollbem %s --quiet %s %s", build_folder(), cases[k].command,
                             cases[k].output, got),
                         0);
        compare_tables(got, wanted);
    }
}

TEST(figures_of_the_paper_are_drawn)
{
    IN_TURN(0, 4);
    assert_int_equal(
        run("ROLLBEM=%s/rollbem examples/paper/figures %s/figures", build_folder(), folder), 0);
    for (int k = 2; k <= 6; k++)
        assert_int_equal(run("test -s %s/figures/figure%d.png", folder, k), 0);
}

/* The next word of a file; 0 at its end. */
static int next_word(FILE *file, char word[100])
{
    return fscanf(file, "%99s", word) == 1;
}

/* Words alike; numbers within the digits that the page shows. */
static void compare_pages(const char *got_path, const char *wanted_path)
{
    FILE *got = fopen(got_path, "r"), *wanted = fopen(wanted_path, "r");
    char a[100], b[100];
    int words = 0;
    assert_non_null(got);
    assert_non_null(wanted);
    while (next_word(wanted, b)) {
        char *end_a, *end_b;
        assert_int_equal(next_word(got, a), 1);
        const double x = strtod(a, &end_a), y = strtod(b, &end_b);
        if (*end_a == '\0' && *end_b == '\0')
            CHECK_ABS(x, y, 0.011 + 1e-6 * fabs(y), "word %d: %s, %s", words, a, b);
        else
            assert_string_equal(a, b);
        words++;
    }
    assert_int_equal(next_word(got, a), 0);
    assert_true(words > 1000);
    fclose(got);
    fclose(wanted);
}

TEST(by_hand_is_computed_again_by_octave)
{
    if (run("command -v octave >/dev/null") != 0)
        skip();
    char page[200];
    snprintf(page, sizeof page, "%s/page.txt", folder);
    assert_int_equal(run("ROLLBEM=%s/rollbem examples/by-hand/make-page %s/dump >%s",
                         build_folder(), folder, page),
                     0);
    assert_int_equal(run("grep -q DIFFERS %s", page), 1);
    compare_pages(page, "examples/by-hand/page.txt");
}

TEST(blocks_of_the_readme_print_what_it_shows)
{
    assert_int_equal(run_page("README.md", 3, 1, folder), 0);
}

TEST(commands_of_the_examples_run)
{
    assert_int_equal(run_page("examples/README.md", 4, 1, folder), 0);
}

/* What the sections of this turn have written besides pictures. */
static void expect_written(const char *file, const char *shown_by)
{
    assert_int_equal(run("[ ! -e %s/%s ] || test -s %s/%s", folder, shown_by, folder, file), 0);
}

TEST(commands_of_the_cookbook_run)
{
    assert_int_equal(run_page("docs/cookbook.md", 20, 8, folder), 0);
    expect_written("states/step_000050.tsv", "states");
}

TEST(commands_of_the_cracks_run)
{
    assert_int_equal(run_page("docs/crack.md", 2, 8, folder), 0);
}

static int make_folder(void **state)
{
    return mkdtemp(folder) ? link_folder(folder) : -1;
}

static int remove_folder(void **state)
{
    return run("rm -rf %s", folder);
}

RUN_TESTS(make_folder, remove_folder)
