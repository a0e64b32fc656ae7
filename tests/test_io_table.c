/* Tables of numbers: what is read, and how a bad one is refused. */
#include "check.h"
#include "rollbem/io.h"

#include <unistd.h>

static rb_status read_text(const char *text, rb_io_table *t, rb_message *why)
{
    char name[] = "/tmp/rollbem-table-XXXXXX";
    const int fd = mkstemp(name);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), (int)strlen(text));
    close(fd);
    const rb_status s = rb_io_table_read(name, t, why);
    unlink(name);
    return s;
}

static void check_history(const char *text, int first_line)
{
    OWNED(rb_io_table) t;
    const rb_status s = read_text(text, &t, &heard);
    if (s != RB_OK)
        fail_msg("%s", heard.text);
    assert_int_equal(t.rows, 2);
    assert_int_equal(t.columns, 3);
    const double *load = NOT_NULL(rb_io_table_column(&t, "load"));
    const double *force = NOT_NULL(rb_io_table_column(&t, "force"));
    CHECK_ABS(load[1], 20.0, 0.0, "load");
    CHECK_ABS(force[0], -1.5, 0.0, "force");
    assert_null(rb_io_table_column(&t, "creep"));
    assert_int_equal(t.line[0], first_line);
}

/* As written by hand, with tabs or commas, and as the program writes its own tables. */
TEST(columns_are_named_in_three_ways)
{
    check_history("distance load force\n0 10 -1.5\n1 20 2\n", 2);
    check_history("# a run\n# distance\tload\tforce\n0\t10\t-1.5\n\n1\t20\t2\n", 3);
    check_history("distance, load, force # names\n# more\n0, 10, -1.5\n1, 20, 2", 3);
    /* as spreadsheets write them */
    check_history("\"distance\",\"load\",\"force\"\r\n\"0\",\"10\",\"-1.5\"\r\n1,20,2\r\n", 2);
}

TEST(names_may_be_missing)
{
    OWNED(rb_io_table) t;
    assert_int_equal(read_text("# two numbers a row\n1 2\n3 4 # end\n", &t, NULL), RB_OK);
    assert_null(t.name);
    assert_null(rb_io_table_column(&t, "load"));
    CHECK_ABS(t.x[2], 2.0, 0.0, "second column first");
    assert_int_equal(t.line[1], 3);
}

TEST(bad_tables_are_named_with_their_line)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"load force\n1 2\n3\n", ":3: expected 2 numbers (load, force), got 1"},
        {"load force\n1 2 3\n", ":2: expected 2 numbers (load, force), got 3"},
        {"# load\n1\n2 3\n", ":3: expected 1 number (load), got 2"},
        {"load force\n1 2\nend of it\n", ":3: expected a number, got 'end'"},
        {"load force\n1 nan\n", ":2: expected a number, got 'nan'"},
        {"load force\n1 1e999\n", ":2: expected a number, got '1e999'"},
        {"1 2\n3 4x\n", ":2: expected a number, got '4x'"},
        {"one 2\n", ":1: expected a number, got 'one'"},
        {"load load\n1 2\n", ":1: column 'load' is named twice"},
        {"load force\n", ": no numbers"},
        {"# load force\n\n", ": no numbers"},
        {"", ": no numbers"},
        {"# load load\n1 2\n", ":2: column 'load' is named twice"},
        {"load load force\n1 2 3\n", ":1: column 'load' is named twice"},
        {"load force load\n1 2 3\n", ":1: column 'load' is named twice"},
        {"1 2\n3 1234567890123456789012345678901234567890123456789012345678901x\n",
         "got '123456789012345678901234567890123456789012345678901234567890'"},
        {"1 2\n3 123456789012345678901234567890123456789012345678901234567x\n",
         "got '123456789012345678901234567890123456789012345678901234567x'"},
        {"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa "
         "bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb "
         "cccccccccccccccccccccccccccccccccccccccc "
         "dddddddddddddddddddddddddddddddddddddddd "
         "eeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeeee\n1\n",
         ":2: expected 5 numbers (aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa, bbbb"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        rb_io_table t;
        rb_message why = {""};
        assert_int_equal(read_text(bad[k].text, &t, &why), RB_EFORMAT);
        if (!strstr(why.text, bad[k].part))
            fail_msg("got '%s', want '%s'", why.text, bad[k].part);
        assert_null(t.x);
        assert_int_equal(t.rows, 0);
    }
    rb_io_table t;
    assert_int_equal(rb_io_table_read("/nonexistent", &t, NULL), RB_ENOENT);
}

/* The last comment before the numbers names the columns if it has as many words. */
TEST(comments_name_columns_or_not)
{
    static const struct {
        const char *text, *name;
    } all[] = {{"# load force\n# too many words here\n1 2\n", NULL},
               {"# too many words\n# load force\n1 2\n", "force"},
               {"# load force\n1 2 # two words\n3 4 # other words\n", NULL},
               {"# load force\n1 2\n3 4 # other words\n", "force"},
               {"#\n1 2\n", NULL}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        OWNED(rb_io_table) t;
        CHECK_OK(read_text(all[k].text, &t, NULL));
        assert_int_equal(t.columns, 2);
        assert_int_equal(rb_io_table_column(&t, "force") != NULL, all[k].name != NULL);
    }
}

TEST(long_tables_keep_every_row)
{
    enum { ROWS = 300 }; /* the room grows twice */
    static char text[20 * ROWS];
    int used = 0;
    for (int i = 0; i < ROWS; i++)
        used += sprintf(text + used, "%d,%d\r\n%s", i, -2 * i, i % 7 ? "" : "\n");
    OWNED(rb_io_table) t;
    CHECK_OK(read_text(text, &t, NULL));
    assert_int_equal(t.rows, ROWS);
    for (int i = 0; i < ROWS; i++) {
        CHECK_ABS(t.x[i], i, 0.0, "row %d", i);
        CHECK_ABS(t.x[ROWS + i], -2.0 * i, 0.0, "row %d", i);
        assert_int_equal(t.line[i], i + 1 + (i + 6) / 7);
    }
}

TEST(columns_are_counted_where_they_are_known)
{
    rb_io_table t;
    char name[] = "/tmp/rollbem-table-XXXXXX";
    static const char text[] = "# two\n\n1 2\n";
    const int fd = mkstemp(name);
    assert_int_equal(write(fd, text, sizeof text - 1), (int)sizeof text - 1);
    close(fd);
    CHECK_OK(rb_io_table_read_columns(name, 2, &t, &heard));
    assert_true(t.columns == 2 && t.x[1] == 2.0);
    rb_io_table_free(&t);
    CHECK_SAYS(rb_io_table_read_columns(name, 3, &t, &heard), RB_EFORMAT,
               ":3: expected 3 numbers, got 2");
    assert_null(t.x);
    unlink(name);
    CHECK_STATUS(rb_io_table_read_columns(name, 2, &t, &heard), RB_ENOENT);
}

/* A unit at the end of a name counts and is dropped; else the column has that of the
 * system. */
TEST(units_of_columns_are_those_of_their_names)
{
    rb_io_table t;
    CHECK_OK(read_text("x_m gap\n1 2\n3 4\n", &t, NULL));
    rb_io_table_convert(&t, 0, "mm", RB_UNITS_SI);
    rb_io_table_convert(&t, 1, "mm", RB_UNITS_SI);
    CHECK_REL(t.x[1], 3000.0, 1e-15, "x in m by its name");
    CHECK_REL(t.x[3], 4000.0, 1e-15, "gap in m by the system");
    assert_string_equal(t.name[0], "x");
    assert_string_equal(t.name[1], "gap");
    rb_io_table_free(&t);
    CHECK_OK(read_text("x_mm gap\n1 2\n", &t, NULL));
    rb_io_table_convert(&t, 0, "mm", RB_UNITS_SI);
    CHECK_ABS(t.x[0], 1.0, 0.0, "x in mm by its name");
    rb_io_table_free(&t);
    CHECK_OK(read_text("1 2\n", &t, NULL));
    rb_io_table_convert(&t, 1, "mm", RB_UNITS_SI);
    CHECK_ABS(t.x[0], 1.0, 0.0, "another column");
    CHECK_REL(t.x[1], 2000.0, 1e-15, "without names");
    rb_io_table_free(&t);
}

TEST(lines_of_any_length_are_read)
{
    enum { NUMBERS = 3000 };
    static char text[2 * NUMBERS + 1];
    OWNED(rb_io_table) t;
    for (int i = 0; i < NUMBERS; i++)
        memcpy(text + 2 * i, i + 1 < NUMBERS ? "1 " : "1\n", 2);
    assert_int_equal(read_text(text, &t, NULL), RB_OK);
    assert_int_equal(t.columns, NUMBERS);
}

TEST(tables_without_memory)
{
    char text[2000] = "load force\n";
    for (int i = 0; i < 200; i++)
        strcat(text, "1 2\n");
    for (int k = 0, refused = 1; refused; k++) {
        OWNED(rb_io_table) t;
        refused = REFUSED_FROM(k, read_text(text, &t, NULL));
    }
}

RUN_TESTS(NULL, NULL)
