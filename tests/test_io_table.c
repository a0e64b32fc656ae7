/* Tables of numbers: what is read, and how a bad one is refused. */
#include "check.h"
#include "base/io/io.h"

#include <unistd.h>

static rb_status read_bytes(const char *text, size_t n, rb_io_table *t, rb_message *why)
{
    char name[] = "/tmp/rollbem-table-XXXXXX";
    const int fd = mkstemp(name);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, n), (int)n);
    close(fd);
    const rb_status s = rb_io_table_read(name, t, why);
    unlink(name);
    return s;
}

static rb_status read_text(const char *text, rb_io_table *t, rb_message *why)
{
    return read_bytes(text, strlen(text), t, why);
}

static void check_history(const char *text, int first_line)
{
    OWNED(rb_io_table) t;
    const rb_status s = read_text(text, &t, &message);
    if (s != RB_OK)
        fail_msg("%s", message.text);
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
        {"0,5;1,5\n1.5;2\n", ":2: expected a number, got '1.5'; decimals have a comma in line 1"},
        {"x;y\n1.234,5;2\n", ":2: expected a number, got '1.234,5' in column 'x'"},
        {"load;force\n1;\n", ":2: expected 2 numbers (load, force), got 1"},
        {"load;force\n1;2%\n", ":2: expected a number, got '2%' in column 'force'"},
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
        rb_message why = {.text = ""};
        if (read_text(bad[k].text, &t, &why) != RB_EFORMAT)
            fail_msg("not refused: %s", bad[k].text);
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

static const rb_io_column gap[] = {{"x", "position", "mm", RB_IO_COLUMN_NEEDED},
                                   {"gap", "clearance", "mm", RB_IO_COLUMN_NEEDED}};

/* As people and spreadsheets write one table: x = -5 mm and 5 mm, gap = 2.5 um and 54 um. */
TEST(headings_say_names_and_units)
{
    static const char *const text[] = {"x_mm,gap_um\n-5,2.5\n5,54\n",
                                       "\"x [mm]\",\"gap [um]\"\n-5,2.5\n5,54\n",
                                       "x (mm), gap (um)\n-5, 2.5\n5, 54\n",
                                       "x/mm,gap/um\n-5,2.5\n5,54\n",
                                       "x / mm, gap / um\n-5,2.5\n5,54\n",
                                       "x [mm] gap [um]\n-5 2.5\n5 54\n",
                                       "# x [mm]  gap [um]\n-5 2.5\n5 54\n",
                                       "# x in mm gap in um\n-5 2.5\n5 54\n",
                                       "x in mm,gap in um\n-5,2.5\n5,54\n",
                                       "x mm\tgap um\n-5\t2.5\n5\t54\n",
                                       "x_mm,gap_micron\n-5,2.5\n5,54\n",
                                       "x_MM,gap_UM\n-5,2.5\n5,54\n",
                                       "X_mm,Gap_microns\n-5,2.5\n5,54\n",
                                       "x..mm.,gap..um.\n-5,2.5\n5,54\n",
                                       "x,gap\nmm,um\n-5,2.5\n5,54\n",
                                       "x;gap\n[mm];[µm]\n-5;2,5\n5;54\n",
                                       "x_m,gap_nm\n-0.005,2500\n0.005,54e3\n",
                                       "x_cm,gap_m\n-0.5,2.5e-6\n0.5,54e-6\n",
                                       "gap_um,x_mm\n2.5,-5\n54,5\n",
                                       "position_mm,clearance_um\n-5,2.5\n5,54\n",
                                       "\xef\xbb\xbfx [mm];gap [µm]\r\n-5,0;2,5\r\n5,0;54,0\r\n",
                                       "x (mm)\tgap (\xb5m)\n-5,0\t2,5\n5,0\t54\n", /* Latin-1 */
                                       "x mm, gap um\n-5,0 2,5\n5,0 54,0\n",
                                       "sep=;\nx_mm;gap_um\n-5;2,5\n5;54\n",
                                       "x_mm;gap_um;;\n-5;2.5;;\n5;54;;\n;;;\n",
                                       "\xff\xfex\0_\0m\0m\0;\0g\0a\0p\0_\0u\0m\0\n\0-\0005\0;"
                                       "\0002\0,\0005\0\n\0005\0;\0005\0004\0\n\0",
                                       "\xfe\xff\0x\0_\0m\0m\0;\0g\0a\0p\0_\0u\0m\0\n\0-\0005\0;"
                                       "\0002\0,\0005\0\n\0005\0;\0005\0004\0\n"};
    enum { TEXTS = sizeof text / sizeof *text };
    for (int k = 0; k < TEXTS; k++) {
        OWNED(rb_io_table) t;
        const double *x[2];
        const size_t n = k < TEXTS - 2 ? strlen(text[k]) : 2 * 24 + 2;
        rb_message why = {.text = ""};
        if (read_bytes(text[k], n, &t, &why) != RB_OK ||
            rb_io_table_assign("g", &t, 2, gap, RB_UNITS_MM, x, &why) != RB_OK)
            fail_msg("%d: %s", k, why.text);
        assert_int_equal(t.rows, 2);
        CHECK_REL(x[0][0], -5.0, 1e-15, "x, %d", k);
        CHECK_REL(x[0][1], 5.0, 1e-15, "x, %d", k);
        CHECK_REL(x[1][0], 0.0025, 1e-15, "gap, %d", k);
        CHECK_REL(x[1][1], 0.054, 1e-15, "gap, %d", k);
    }
}

TEST(headings_that_are_not_understood_are_named)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"x_mm,gap_furlong\n1,2\n", "column 'gap_furlong': expected gap in one of mm, m, cm, um,"},
        {"x_mm,gap_MPa\n1,2\n", "column 'gap_MPa': expected gap in one of mm,"},
        {"x_mm,banana\n1,2\n", "unknown column 'banana'; expected x_mm, gap_mm"},
        {"x_mm,gpa\n1,2\n", "unknown column 'gpa' (did you mean 'gap'?)"},
        {"x_mm,gap_um,note\n1,2,3\n", "unknown column 'note'"},
        {"gap_um,gap_mm\n1,2\n", "columns 'gap_um' and 'gap_mm' are both gap"},
        {"x_mm\n1\n", "expected a column gap_mm"},
        {"# x [mm], gap [furlong]\n1 2\n", "column 'gap [furlong]'"},
        {"# width [mm], gap [um]\n1 2\n", "unknown column 'width [mm]'"},
        {"x,gap\n1,2\n3,NaN\n", "g:3: expected a number, got none in column 'gap'"},
        {"x;gap\n;2\n", "g:2: expected a number, got none in column 'x'"},
        {"x,gap\n1,\n", "g:2: expected a number, got none in column 'gap'"},
        {"1 2 3\n", "g:1: expected 2 numbers, got 3"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        OWNED(rb_io_table) t;
        const double *x[2];
        CHECK_OK(read_text(bad[k].text, &t, &message));
        CHECK_SAYS(rb_io_table_assign("g", &t, 2, gap, RB_UNITS_MM, x, &message), RB_EFORMAT,
                   bad[k].part);
    }
    /* of as many words as there are columns, but about something else */
    OWNED(rb_io_table) t;
    const double *x[2];
    CHECK_OK(read_text("# steel wheel\n1 2\n", &t, &message));
    CHECK_OK(rb_io_table_assign("g", &t, 2, gap, RB_UNITS_SI, x, &message));
    assert_null(t.name);
    CHECK_REL(x[1][0], 2000.0, 1e-15, "gap in m by the system");
}

/* A unit in a heading counts; else the column has that of the system. */
TEST(units_of_columns_are_those_of_their_names)
{
    OWNED(rb_io_table) t;
    const double *x[2];
    CHECK_OK(read_text("x_mm gap\n1 2\n3 4\n", &t, NULL));
    CHECK_OK(rb_io_table_assign("g", &t, 2, gap, RB_UNITS_SI, x, &message));
    CHECK_ABS(x[0][1], 3.0, 0.0, "x in mm by its name");
    CHECK_REL(x[1][1], 4000.0, 1e-15, "gap in m by the system");
}

/* "0,5" between tabs is a half; between nothing else than commas it is two numbers. */
TEST(commas_are_decimal_or_separate)
{
    static const struct {
        const char *text;
        int columns;
        double first;
    } all[] = {{"0,5\t1,25\n2\t3\n", 2, 0.5}, {"0,5 -1,25\n", 2, 0.5},   {"0,5;1,25\n", 2, 0.5},
               {"0,5,1,25\n", 4, 0.0},        {"0, 5, 1, 25\n", 4, 0.0}, {"0.5;1.25\n", 2, 0.5},
               {"2\t3\n0,5\t1,25\n", 2, 2.0}, {"0;5;1\n", 3, 0.0}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        OWNED(rb_io_table) t;
        CHECK_OK(read_text(all[k].text, &t, &message));
        assert_int_equal(t.columns, all[k].columns);
        CHECK_ABS(t.x[0], all[k].first, 0.0, "%s", all[k].text);
    }
}

/* What is no text is named, and what reads it. */
TEST(files_of_other_programs_are_named)
{
    static const struct {
        const char *bytes;
        size_t n;
        const char *part;
    } all[] = {{"\x93NUMPY\1\0v", 9, "got an array of NumPy (.npy); the Python package reads it"},
               {"PK\3\4\0\0", 6, "got a zip archive"},
               {"\xd0\xcf\x11\xe0\0", 5, "got an Excel workbook; save it as CSV"},
               {"\x89HDF\r\n\x1a\n\0", 9, "got an HDF5 file"},
               {"\x1f\x8b\x08\0", 4, "got compressed by gzip; unpack it"},
               {"1 2\n\0", 5, ":2: a zero byte, expected text"},
               {"\xff\xfe\1\xd8x\0", 6, "half a character of UTF-16"},
               {"\xff\xfex", 3, "half a character of UTF-16"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_io_table t;
        CHECK_SAYS(read_bytes(all[k].bytes, all[k].n, &t, &message), RB_EFORMAT, all[k].part);
    }
}

/* As the program writes numbers that do not exist; only a column that is read needs all. */
TEST(unused_columns_may_have_no_numbers)
{
    static const rb_io_column of_x[] = {{"x", NULL, "mm", RB_IO_COLUMN_NEEDED},
                                        {NULL, NULL, "-", RB_IO_COLUMN_UNUSED}};
    static const char *const text[] = {"x_mm\tedge_mm\n1\tNaN\n2\t3\n", "x_mm,edge\n1,\n2,3\n",
                                       "edge,x_mm\n,1\n3,2\n", "edge,x_mm,a\r\n,1,\r\n3,2,4\r\n"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        OWNED(rb_io_table) t;
        const double *x[2];
        CHECK_OK(read_text(text[k], &t, &message));
        CHECK_OK(rb_io_table_assign("g", &t, 2, of_x, RB_UNITS_MM, x, &message));
        CHECK_ABS(x[0][1] - x[0][0], 1.0, 0.0, "x, %zu", k);
        assert_true(t.x[0] != t.x[0] || t.x[2] != t.x[2]);
    }
}

TEST(cells_may_be_words)
{
    char name[] = "/tmp/rollbem-table-XXXXXX";
    static const char *const text[] = {"name,support,load\nold rail,halfplane,5\n,hub,7.5\n",
                                       "name\tsupport\tload\nold rail\thalfplane\t5\n\thub\t7,5\n",
                                       "name;support;load\n\"old rail\";halfplane;5\n;hub;7,5\n"};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        OWNED(rb_io_table) t;
        strcpy(strrchr(name, '-'), "-XXXXXX");
        const int fd = mkstemp(name);
        assert_int_equal(write(fd, text[k], strlen(text[k])), (int)strlen(text[k]));
        close(fd);
        CHECK_OK(rb_io_table_read_words(name, &t, &message));
        assert_int_equal(t.rows, 2);
        assert_string_equal(t.word[0], "old rail");
        assert_string_equal(t.word[1], "");
        assert_string_equal(t.word[3], "hub");
        assert_null(t.word[4]);
        CHECK_ABS(t.x[5], 7.5, 0.0, "load");
        assert_true(isnan(t.x[2]));
        for (int i = 0, refused = 1; refused; i++) {
            OWNED(rb_io_table) again;
            refused = REFUSED_FROM(i, rb_io_table_read_words(name, &again, NULL));
        }
        unlink(name);
    }
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
