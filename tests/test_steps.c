/* examples/steps: the method in one file computes what the program computes, column by column. */
#define _XOPEN_SOURCE 700
#include "cli_run.h"

enum { ROWS = 60, COLUMNS = 7 };
static const char *const names[COLUMNS] = {"x_mm",     "gap_mm", "p_MPa", "q_MPa",
                                           "shift_mm", "slip",   "zone"};

static const struct {
    const char *steps, *program;
} cases[] = {
    {"0.3 0.1", "--mu 0.3 --creep 0.1 --zone 35"},
    {"0 0.1", "--mu 0 --creep 0.1 --zone 35"},
    {"0.1 0.1 static wheel 0 32", "--mu 0.1 --creep 0.1 --zone 32"},
    {"0.3 0.1 static wheel 5e5", "--mu 0.3 --creep 0.1 --zone 35 --load 5e5"},
    {"0.1 0.1 static halfplane 0 45", "--mu 0.1 --creep 0.1 --zone 45 --support halfplane"},
    {"0.3 0.1 steady", "--mu 0.3 --creep 0.1 --zone 35 --formulation steady"},
    {"0.3 0.001 steady halfplane 1000 1.1",
     "--mu 0.3 --creep 0.001 --zone 1.1 --formulation steady --support halfplane --load 1000"},
    {"0.3 -0.006 steady halfplane 1000 1.1",
     "--mu 0.3 --creep -0.006 --zone 1.1 --formulation steady --support halfplane --load 1000"},
};

/* The columns of a table in `out`; its head names them, lines of # are not rows. */
static void columns_of(double value[COLUMNS][ROWS])
{
    int place[COLUMNS], fields = 0, rows = 0;
    char *save = NULL, *line = strtok_r(out, "\n", &save), *rest = NULL;

    for (int c = 0; c < COLUMNS; c++)
        place[c] = -1;
    for (char *name = strtok_r(line, "\t", &rest); name; name = strtok_r(NULL, "\t", &rest)) {
        for (int c = 0; c < COLUMNS; c++)
            if (strcmp(name, names[c]) == 0)
                place[c] = fields;
        fields++;
    }
    while ((line = strtok_r(NULL, "\n", &save))) {
        if (line[0] == '#')
            continue;
        assert_true(rows < ROWS);
        for (int f = 0; f < fields; f++) {
            const double number = strtod(line, &line);
            for (int c = 0; c < COLUMNS; c++)
                if (place[c] == f)
                    value[c][rows] = number;
        }
        rows++;
    }
    assert_int_equal(rows, ROWS);
    for (int c = 0; c < COLUMNS; c++)
        if (place[c] < 0)
            fail_msg("no column %s", names[c]);
}

/* So many parts of the cases take turns. */
static void check_against_program(const char *run, int parts)
{
    static double one[COLUMNS][ROWS], other[COLUMNS][ROWS];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (!is_in_turn((int)k, parts))
            continue;
        CHECK_RUN(shellf("%s %s", run, cases[k].steps), 0, err, "solved");
        columns_of(one);
        assert_int_equal(rollbemf("%s --mesh uniform --quiet", cases[k].program), 0);
        columns_of(other);
        for (int c = 0; c < COLUMNS; c++) {
            double largest = 1e-300, off = 0.0;
            for (int i = 0; i < ROWS; i++) {
                largest = fmax(largest, fabs(other[c][i]));
                off = fmax(off, fabs(one[c][i] - other[c][i]));
            }
            CHECK_MAX(off / largest, 1e-10, "%s, %s", cases[k].steps, names[c]);
        }
    }
}

TEST(one_file_in_C_computes_what_the_program_computes)
{
    check_against_program("\"${R%/*}/steps\"", 1);
}

TEST(one_file_in_Python_computes_what_the_program_computes)
{
    if (shell("/usr/bin/python3 -c 'import numpy'")) {
        print_message("[  SKIPPED ] one_file_in_Python: no NumPy\n");
        skip();
    }
    check_against_program("/usr/bin/python3 \"$PROJECT/examples/steps/steps.py\"", 4);
}

/* It can be read aloud in an afternoon. */
TEST(they_are_short)
{
    assert_int_equal(shell("wc -l <\"$PROJECT/examples/steps/steps.c\""), 0);
    assert_in_range(atoi(out), 1, 400);
}

RUN_TESTS(enter_folder, leave_folder)
