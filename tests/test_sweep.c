#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
/* Parameter studies: the library's processes and the program. */
#include "cases.h"
#include "cli_run.h"
#include "base/io/io.h"
#include "rolling/rolling.h"

#include <signal.h>
#include <sys/mman.h>

/* ---- The library ------------------------------------------------------------------- */

enum { CASES = 23 };

typedef struct {
    int first, counted, stop_at, kill_at;
    int *deaths; /* in memory that all processes share; NULL: die every time */
    rb_rolling_solution row[CASES];
} record;

static rb_status make(int k, rb_rolling_case *rc, void *context)
{
    const record *r = context;
    if (k == r->kill_at && (!r->deaths || ++*r->deaths == 1))
        raise(SIGKILL);
    *rc =
        rolling_case("support halfplane formulation steady half-width 1 creep-ratio %g", 0.05 * k);
    rc->contact_elements = k == 5 ? 1 : 40; /* too few: a case that fails */
    return RB_OK;
}

static int see(int k, const rb_rolling_row *row, void *context)
{
    record *r = context;
    assert_int_equal(k, r->first + r->counted); /* in order */
    r->row[r->counted++] = row->solution;
    return r->counted == r->stop_at;
}

static rb_status run(record *r, int workers, rb_message *why)
{
    const rb_rolling_sweep sweep = {.first = r->first,
                                    .count = CASES,
                                    .workers = workers,
                                    .make = make,
                                    .see = see,
                                    .context = r};
    return rb_rolling_sweep_run(&sweep, why);
}

TEST(rows_are_those_of_single_solutions)
{
    record r = {.first = 2, .kill_at = -1};
    CHECK_OK(run(&r, 3, NULL));
    assert_int_equal(r.counted, CASES);
    for (int i = 0; i < CASES; i++) {
        rb_rolling_case rc;
        OWNED(rb_rolling_solution) s;
        CHECK_OK(make(2 + i, &rc, &r));
        assert_int_equal(r.row[i].status, rb_rolling_solve(&rc, &s, NULL));
        if (2 + i == 5) {
            assert_int_equal(r.row[i].status, RB_EINVAL);
            assert_true(isnan(r.row[i].normal_load));
        } else {
            CHECK_ABS(r.row[i].tangential_load, s.tangential_load, 0.0, "Q of %d", i);
            CHECK_ABS(r.row[i].free_creepage, s.free_creepage, 0.0, "xi0 of %d", i);
            assert_int_equal(r.row[i].stick, s.stick);
        }
    }
}

/* The memory killer of the system may have taken it. */
TEST(a_case_is_tried_again_after_its_process_died)
{
    int *deaths =
        mmap(NULL, sizeof *deaths, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    record r = {.kill_at = 9, .deaths = deaths};
    CHECK_OK(run(&r, 2, NULL));
    assert_int_equal(*deaths, 2); /* once, and once more alive */
    for (int i = 0; i < CASES; i++)
        assert_int_equal(r.row[i].status, i == 5 ? RB_EINVAL : RB_OK);
    munmap(deaths, sizeof *deaths);
}

TEST(a_process_that_dies_loses_one_case)
{
    record r = {.kill_at = 9};
    CHECK_OK(run(&r, 2, NULL));
    for (int i = 0; i < CASES; i++)
        assert_int_equal(r.row[i].status, i == 9 ? RB_ENOMEM : i == 5 ? RB_EINVAL : RB_OK);
}

TEST(stops_when_told)
{
    record r = {.stop_at = 4, .kill_at = -1};
    CHECK_STATUS(run(&r, 0, &message), RB_INTERRUPTED);
    assert_int_equal(r.counted, 4);
    assert_non_null(strstr(message.text, "after case 4"));
    CHECK_STATUS(run(&r, -1, &message), RB_EINVAL);
    CHECK_STATUS(run(&r, 100000, &message), RB_EINVAL);
}

/* ---- The program ------------------------------------------------------------------- */

#define STUDY "sweep --support halfplane --formulation steady --load 500 --quiet "

static const struct {
    const char *arguments;
    int code;
    const char *part;
} bad[] = {
    {"", 64, "a study needs --vary-1 or --cases"},
    {"--vary-1 mu", 64, "--vary-1: expected an option and numbers"},
    {"--vary-1 'mu 0.1 x'", 64, "got 'mu 0.1 x'"},
    {"--vary-1 'mu 0:1:1'", 64, "got 'mu 0:1:1'"},
    {"--vary-1 'mu 0:1:5:log'", 64, "got 'mu 0:1:5:log'"},
    {"--vary-1 'solver 1'", 64, "'solver' is not an option of a case with a number as value"},
    {"--vary-1 'friction 1'", 64, "'friction' is not an option of a case"},
    {"--vary-1 'mu 0.1 -1'", 64, "case 2: mu: expected a number >= 0"},
    {"--vary-1 'mu 0.1' --vary-2 'mu 0.2'", 64, "'mu' varies already"},
    {"--vary-1 'half-width 1'", 64, "exclude each other"},
    {"--vary-1 'layers a.txt b.txt'", 64, "'layers' is the name of a file"},
    {"--vary-1 'mu 0.1' --accuracy 1e-3", 64, "--accuracy: a study has error bars"},
    {"--vary-1 'mu 0.1' --results error_approach", 64, "'error_approach' needs --error"},
    {"--vary-1 'mu 0.1' --error --results error_peclet", 64, "peclet has no error bar"},
    {"--vary-1 'mu 0.1' --error --results error_approch", 64, "(did you mean 'error_approach'?)"},
    {"--vary-1 'mu 0.1' --support hub --cover-thickness 5 --core-young 2e5 "
     "--relaxation-time 1 --relaxation-ratio 1 --speed 100 --results von_mises",
     64, "on an elastic core it depends on the past"},
    {"--cases nowhere", 66, "nowhere: No such file"},
    {"--vary-1 'mu 0:1:10000000' --vary-2 'load 1:2:10000000'", 64, "at most 1e8"},
    {"--vary-1 'mu 0.1' --output /no/such/file", 73, "/no/such/file: cannot write: No such file"},
    {"--vary-1 'mu 0.1' --jobs -1", 64, "--jobs: expected a whole number"},
};

TEST(bad_studies_are_refused)
{
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
        if (!is_in_turn((int)k, 8))
            continue;
        char line[400];
        snprintf(line, sizeof line, STUDY "%s", bad[k].arguments);
        check_refused(line, bad[k].code, bad[k].part);
    }
}

/* A grid from a file, times a table: every combination, the last varying fastest. */
TEST(grid_times_table)
{
    OWNED(rb_io_table) t;
    write_file("study.ini", "support = halfplane\nformulation = steady\n[normal]\nload = 500\n"
                            "[sweep]\ncases = cases\nvary-1 = creep-ratio 0:1:3\n");
    write_file("cases", "mu young\n0.1 2e5\n0.2 1e5\n");
    assert_int_equal(rollbem("sweep study.ini --quiet --contact-elements 40"), 0);
    write_file("rows", out);
    CHECK_OK(rb_io_table_read("rows", &t, NULL));
    assert_int_equal(t.rows, 6);
    const double *mu = rb_io_table_column(&t, "mu"), *young = rb_io_table_column(&t, "young"),
                 *ratio = rb_io_table_column(&t, "creep_ratio"),
                 *force = rb_io_table_column(&t, "force_ratio");
    assert_true(mu && young && ratio && force);
    for (int i = 0; i < 6; i++) {
        CHECK_ABS(mu[i], i < 3 ? 0.1 : 0.2, 0.0, "mu");
        CHECK_ABS(young[i], i < 3 ? 2e5 : 1e5, 0.0, "young");
        CHECK_ABS(ratio[i], 0.5 * (i % 3), 0.0, "creep ratio");
    }
}

/* The whole file at once, and cut off in the middle of a row and gone on with. */
/* What stands only beside an option that varies is not refused for its absence. */
TEST(options_may_need_the_one_that_varies)
{
    static const char *const all[] = {
        "--support hub --core-young 70000 --vary-1 'cover-thickness 5 10'",
        "--poisson-b .2 --vary-1 'young-b 1e5 2e5'",
        "--base-young 1e5 --base-poisson .2 --vary-1 'layer-thickness 5 10'",
        "--similar --heat-capacity 3.8 --speed 1000 --vary-1 'conductivity 10 50'",
        "--similar --relaxation-time .1 --relaxation-ratio 1 --vary-1 'speed 1 10'"};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (rollbemf(STUDY "--contact-elements 20 --header bare %s", all[k]) != 0)
            fail_msg("%s: %s", all[k], err);
        assert_non_null(strstr(out, "\n2\t"));
    }
    check_refused(STUDY "--heat-capacity 3.8 --vary-1 'mu .1 .2'", 64,
                  "only where friction heats the bodies: give --conductivity, too");
}

TEST(an_interrupted_study_goes_on)
{
    static const char study[] =
        STUDY "--contact-elements 30 --vary-1 'creep-ratio 0:1.5:31' --output study.tsv";
    static char whole[100000], again[100000];
    assert_int_equal(rollbem(study), 0);
    slurp("study.tsv", whole, sizeof whole);
    assert_int_equal(shell("head -c 2000 study.tsv >cut && cp cut study.tsv"), 0);
    assert_int_equal(rollbem(study), 0);
    slurp("study.tsv", again, sizeof again);
    assert_string_equal(again, whole);
    assert_int_equal(rollbem(study), 0); /* nothing left to do */
    slurp("study.tsv", again, sizeof again);
    assert_string_equal(again, whole);
    check_refused(STUDY "--vary-1 'creep-ratio 0:1:3' --output study.tsv", 73,
                  "study.tsv: has other contents");
    assert_int_equal(shell("printf '\\000\\n' >binary"), 0);
    check_refused(STUDY "--vary-1 'creep-ratio 0:1:3' --output binary", 73,
                  "binary: has other contents");
    assert_int_equal(rollbem(STUDY "--contact-elements 30 --vary-1 'creep-ratio 0:1:3' "
                                   "--output study.tsv --restart"),
                     0);
    slurp("study.tsv", again, sizeof again);
    assert_null(strstr(again, "of 31 cases"));
}

/* A table holds the rows that there are; JSON is whole or not there, whatever was there
 * before stays. */
TEST(an_interrupted_study_in_json_leaves_no_file)
{
    /* few cases are checked before signals are caught; they take minutes */
    write_file("whole.json", "before");
    assert_int_equal(shell("\"$R\" " STUDY
                           "--contact-elements 1000 --vary-1 'creep-ratio 0:1.5:5000' "
                           "--jobs 1 --json --output whole.json & p=$!; " WHEN_CAUGHT(
                               INT_CAUGHT) "kill -INT $p; wait $p"),
                     1);
    assert_int_equal(shell("cat whole.json; ls whole.json?* 2>/dev/null | wc -l"), 0);
    assert_string_equal(out, "before0\n");
}

/* A table that a case file in SI names is in SI; the study shows what it shows. */
TEST(tables_are_in_the_units_of_the_file_that_names_them)
{
    write_file("si.ini", "units = si\nsupport = halfplane\nyoung = 2e11\nradius = 0.3\n"
                         "contact-elements = 12\n[sweep]\ncases = si.txt\n");
    write_file("si.txt", "load\n100000\n200000\n");
    write_file("mm.txt", "load\n100\n200\n");
    assert_int_equal(rollbem("sweep --support halfplane --young 2e5 --radius 300 "
                             "--contact-elements 12 --cases mm.txt --header bare --quiet"),
                     0);
    assert_non_null(strstr(out, "\n1\t100\t"));
    CHECK_RUN(rollbem("sweep si.ini --units mm --header bare --quiet"), 0, out, "\n1\t100\t");
    assert_non_null(strstr(out, "\n2\t200\t"));
}

/* To first order, as rollbem --tolerance of each case; per cent are those of its own
 * numbers, units those of the study. */
TEST(tolerances_of_a_study_are_those_of_its_cases)
{
#define UNCERTAIN "--contact-elements 30 --tolerance mu=0.02,creep-ratio=10%,young=1% "
#define VARIED "--vary-1 'creep-ratio 0.3 0.8' "
    held_json *all = run_json(STUDY UNCERTAIN VARIED "--derivatives tangential_load:mu");
    held_json *in_si = run_json("sweep --support halfplane --formulation steady --load 500000 "
                                "--units si " UNCERTAIN VARIED);
    const json_t *table = json_object_get(all, "table");
    for (size_t k = 0; k < 2; k++) {
        held_json *one = run_json(k ? &(STUDY UNCERTAIN "--creep-ratio 0.8")[strlen("sweep ")]
                                    : &(STUDY UNCERTAIN "--creep-ratio 0.3")[strlen("sweep ")]);
        const json_t *want = json_object_get(one, "tolerances");
        const double Q = number_in(want, "tangential_load");
        CHECK_REL(entry(table, "deviation_tangential_load_N/mm", k), Q, 1e-12, "case %zu", k);
        CHECK_REL(entry(table, "deviation_max_strain", k), number_in(want, "max_strain"), 1e-12,
                  "case %zu", k);
        CHECK_REL(entry(json_object_get(in_si, "table"), "deviation_tangential_load_N/m", k),
                  1e3 * Q, 1e-9, "case %zu in SI", k);
    }
    /* what is uncertain is said, also in a table and of a curve */
    held_json *curve = run_json("curve --support halfplane --load 500 --points 3 " UNCERTAIN);
    const json_t *const roots[] = {all, in_si, curve};
    for (size_t k = 0; k < 3; k++) {
        const json_t *inputs = json_object_get(roots[k], "uncertain_inputs");
        assert_int_equal(json_object_size(inputs), 3);
        CHECK_ABS(number_in(inputs, "mu"), 0.02, 0.0, "mu");
        assert_string_equal(json_string_value(json_object_get(inputs, "creep-ratio")), "10%");
    }
    const char *const tables[] = {STUDY UNCERTAIN VARIED "--output u",
                                  "curve --support halfplane --load 500 --points 3 " UNCERTAIN
                                  "--output u"};
    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(rollbem(tables[k]), 0);
        assert_int_equal(
            shell("grep -q 'standard deviations of.* mu=0.02,creep-ratio=10%,young=1%' u"), 0);
    }
    /* with both the band is the error bar, and says so */
    for (int error = 0; error < 2; error++) {
        assert_int_equal(
            rollbem(error ? STUDY UNCERTAIN VARIED "--error --plot b.svg --plot-script b.gp --quiet"
                          : STUDY UNCERTAIN VARIED "--plot b.svg --plot-script b.gp --quiet"),
            0);
        assert_int_equal(shell(error ? "grep -q 'band: ± estimated error' b.gp"
                                     : "grep -q 'band: ± standard deviation' b.gp"),
                         0);
    }
    /* other deviations are another study */
    assert_int_equal(rollbem(STUDY UNCERTAIN VARIED "--output t"), 0);
    assert_int_equal(rollbem(STUDY UNCERTAIN VARIED "--output t"), 0);
    assert_int_equal(
        rollbem(STUDY "--contact-elements 30 --tolerance mu=0.03 " VARIED "--output t"), 73);
    assert_non_null(strstr(err, "has other contents"));
    check_refused(STUDY "--vary-1 'mu .1 .2' --tolerance zone=1", 64,
                  "--tolerance: 'zone' is not a number of this case");
    check_refused(STUDY "--vary-1 'crack-length .1 .2' --tolerance mu=1", 64,
                  "--tolerance: the K of cracks have no derivatives; give --sample");
}

TEST(cases_that_fail_are_rows_and_an_exit_code)
{
    assert_int_equal(rollbem("sweep --support halfplane --mu 0 --vary-1 'load 1 2' "
                             "--zone 0.001 --contact-elements 10"),
                     1);
    assert_non_null(strstr(err, "2 cases"));
    assert_non_null(strstr(err, "not solved: 2 of 2"));
    assert_non_null(strstr(err, "rollbem: case 1 is not solved: zone: the contact is not"));
}

/* Also where messages are not wanted; of the others nobody hears. */
TEST(the_first_case_that_fails_says_why)
{
    assert_int_equal(rollbem("sweep --support halfplane --load 100 --error --quiet "
                             "--vary-1 'contact-elements 16 10 8 20'"),
                     64);
    assert_string_equal(
        err, "rollbem: case 2 is not solved: contact-elements: error bars compare with half "
             "the elements: expected 12 contact elements or more, got 10\n");
    assert_int_equal(rollbem("sweep --support halfplane --load 100 --error --quiet "
                             "--vary-1 'contact-elements 16 20'"),
                     0);
    assert_string_equal(err, "");
}

#define THREE STUDY "--contact-elements 20 --vary-1 'creep-ratio 0:1:3' --output s.tsv "

static void check_not_resumed(const char *change, const char *part)
{
    static int row;
    if (!is_in_turn(row++, 5))
        return;
    assert_int_equal(rollbem(THREE "--restart"), 0);
    assert_int_equal(shell(change), 0);
    check_refused(THREE, 73, part);
}

/* Every line is one that this study would have written. */
TEST(what_is_no_row_of_the_study_is_refused)
{
    check_not_resumed("echo hello >>s.tsv", "s.tsv:9: not the row of case 4");
    check_not_resumed("sed -i '7s/.*/hello/' s.tsv", "s.tsv:7: not the row of case 2");
    check_not_resumed("sed -i 6d s.tsv", "s.tsv:6: not the row of case 1");
    check_not_resumed("sed -i '7s/0.5/0.6/' s.tsv", "s.tsv:7: not the row of case 2");
    check_not_resumed("sed -i '8s/\\t[^\\t]*$//' s.tsv", "s.tsv:8: not the row of case 3");
    check_not_resumed("sed -i '8s/[^\\t]*$//' s.tsv", "s.tsv:8: not the row of case 3");
    check_not_resumed("sed -i '8s/$/x/' s.tsv", "s.tsv:8: not the row of case 3");
    check_not_resumed("sed -i '8s/$/\\t0/' s.tsv", "s.tsv:8: not the row of case 3");
    check_not_resumed("sed -i '7s/\\t0\\t/\\tx\\t/' s.tsv", "s.tsv:7: not the row of case 2");
    check_not_resumed("sed -i '7s/\\t0\\t/ 0\\t/' s.tsv", "s.tsv:7: not the row of case 2");
    check_not_resumed("sed -i '1s/force_ratio/x/' s.tsv", "has other contents");
    check_not_resumed("sed -i '2s/$/x/' s.tsv", "has other contents");
    check_not_resumed("head -2 s.tsv >t; mv t s.tsv", "has other contents");
    check_not_resumed("printf x >s.tsv", "has other contents");
    check_not_resumed("sed -i '8p' s.tsv", "s.tsv:9: not the row of case 4");
}

/* What is in the file when the disk is full is whole, and the study goes on from there. */
TEST(a_full_disk_leaves_whole_rows)
{
    static const char study[] = STUDY "--contact-elements 30 --vary-1 'mu 0.1:0.3:12' ";
    static char whole[20000], part[20000];
    char line[600];
    assert_int_equal(rollbemf("%s --output whole.tsv", study), 0);
    slurp("whole.tsv", whole, sizeof whole);
    for (int blocks = 0; blocks < 3; blocks += 2) {
        snprintf(line, sizeof line,
                 "bash -c \"(ulimit -f %d; exec '$R' %s --output full.tsv 2>&1) | cat; exit "
                 "\\${PIPESTATUS[0]}\"",
                 blocks, study);
        CHECK_RUN(shell(line), 73, out, "rollbem: full.tsv: cannot write: File too large");
        if (blocks == 0) {
            assert_int_not_equal(access("full.tsv", F_OK), 0);
            continue;
        }
        slurp("full.tsv", part, sizeof part);
        const size_t n = strlen(part);
        assert_true(n > 0 && n < 2048 && part[n - 1] == '\n');
    }
    /* half a head in a file that was there and empty is taken back, too */
    snprintf(line, sizeof line,
             "touch empty.tsv; bash -c \"(ulimit -f 1; exec '$R' %s --output \\$(printf "
             "'./%%.0s' {1..400})empty.tsv 2>&1) | cat; exit \\${PIPESTATUS[0]}\"",
             study);
    assert_int_equal(shell(line), 73);
    slurp("empty.tsv", part, sizeof part);
    assert_string_equal(part, "");
    assert_int_equal(rollbemf("%s --output full.tsv", study), 0);
    slurp("full.tsv", part, sizeof part);
    assert_string_equal(strstr(part, "\n1\t"), strstr(whole, "\n1\t"));
}

/* The other formats have the same numbers and come whole. */
TEST(studies_come_in_three_formats)
{
    char head[20000];
    assert_int_equal(shell("\"$R\" " STUDY "--vary-1 'mu 0.1 0.3' --quiet"), 0);
    snprintf(head, sizeof head, "%.*s", (int)strcspn(out, "\n"), out);
    assert_int_equal(shell("\"$R\" " STUDY "--vary-1 'mu 0.1 0.3' --quiet --header bare "
                           "--output bare.tsv && head -1 bare.tsv && wc -l <bare.tsv"),
                     0);
    assert_int_equal(strncmp(out, head, strlen(head)), 0);
    assert_non_null(strstr(out, "\n3\n"));
    held_json *root = run_json(STUDY "--vary-1 'mu 0.1 0.3'");
    json_t *table = json_object_get(root, "table");
    CHECK_ABS(entry(table, "mu", 1), 0.3, 0.0, "mu of the second case");
    CHECK_ABS(entry(table, "case", 1), 2.0, 0.0, "its number");
    assert_non_null(json_object_get(table, "max_pressure_MPa"));
}

TEST(any_result_is_a_column_by_its_name)
{
    held_json *root = run_json(STUDY "--similar --vary-1 'creep-ratio 0.2 0.6' --results "
                                     "stick_length,contact_to,normal_load");
    json_t *table = json_object_get(root, "table");
    const double a = entry(table, "half_width_mm", 1);
    CHECK_REL(entry(table, "contact_to_mm", 1), a, 1e-4, "edge of the contact");
    CHECK_REL(entry(table, "stick_length_mm", 1), 2.0 * a * (1.0 - 0.6), 0.05, "Carter");
    check_refused(STUDY "--vary-1 'mu .1 .2' --results stick_lenght", 64,
                  "no result 'stick_lenght' (did you mean 'stick_length'?)");
}

TEST(studies_name_their_papers)
{
    assert_int_equal(rollbem(STUDY "--similar --contact-elements 20 --vary-1 'mu .1 .2' --cite"),
                     0);
    assert_non_null(strstr(err, "Carter"));
    assert_null(strstr(out, "Carter"));
}

/* Quantities with units are values of the study in its own system. */
TEST(values_may_have_units)
{
    json_t *root = run_json(STUDY "--similar --contact-elements 20 --vary-1 'load 100kN/m "
                                  "200 0.3MN/m' --vary-2 'young 100GPa:0.2e6:2'");
    json_t *table = json_object_get(root, "table");
    for (size_t k = 0; k < 6; k++) {
        CHECK_ABS(entry(table, "load", k), 100.0 * (double)(1 + k / 2), 1e-12, "load");
        CHECK_ABS(entry(table, "young", k), k % 2 ? 2e5 : 1e5, 1e-9, "E");
    }
    json_decref(root);
    write_file("si.ini", "units = si\nsimilar = yes\nsupport = halfplane\n[sweep]\n"
                         "vary-1 = load 1e5 200N/mm\n");
    root = run_json("sweep si.ini --contact-elements 20");
    table = json_object_get(root, "table");
    CHECK_ABS(entry(table, "load", 0), 1e5, 1e-9, "plain numbers of the file");
    CHECK_ABS(entry(table, "load", 1), 2e5, 1e-9, "with a unit");
    json_decref(root);
    check_refused(STUDY "--vary-1 'mu .1 .2' --seed 3", 64, "--seed: only with --sample");
    check_refused(STUDY "--vary-1 'load 100kN 200'", 64,
                  "--vary-1: load: expected a number in one of N/mm");
    check_refused(STUDY "--vary-1 'contact-elements 20mm'", 64,
                  "--vary-1: expected an option and numbers");
}

/* ---- Pictures ---------------------------------------------------------------------- */

#define GRID                                                                                       \
    STUDY "--similar --contact-elements 20 --vary-1 'load 100 400 900' "                           \
          "--vary-2 'creep-ratio 0 0.5 0.9 1.2' "

/* The numbers of a block of gnuplot's script, three a row or two; how many rows. */
/* The rows of the block $table: x, y, value; what comes behind it stays in `script_text`. */
static char script_text[100000];

static int read_rows(const char *script, double at[][3])
{
    int rows = 0;
    slurp(script, script_text, sizeof script_text);
    for (char *line = NOT_NULL(strstr(script_text, "$table << EOD\n"));
         strncmp(line, "EOD", 3) != 0; line = strchr(line, '\n') + 1)
        rows += *line != '\n' &&
                sscanf(line, "%lf %lf %lf", &at[rows][0], &at[rows][1], &at[rows][2]) == 3;
    return rows;
}

static int begins_like_a_picture(const char *name, const char *begin)
{
    char text[40000];
    slurp(name, text, sizeof text);
    return strncmp(text, begin, strlen(begin)) == 0;
}

/* The map has the numbers of the table, every x in the rows of every y. */
TEST(a_map_shows_the_table)
{
    OWNED(rb_io_table) t;
    double at[20][3];
    assert_int_equal(rollbem(GRID "--show dissipation --map m.svg --plot-script m.gp "
                                  "--output m.tsv"),
                     0);
    assert_true(begins_like_a_picture("m.svg", "<?xml"));
    CHECK_OK(rb_io_table_read("m.tsv", &t, NULL));
    const double *load = rb_io_table_column(&t, "load"),
                 *ratio = rb_io_table_column(&t, "creep_ratio"),
                 *power = rb_io_table_column(&t, "dissipation_Nmm");
    if (!power)
        power = rb_io_table_column(&t, "dissipation_N/mm");
    assert_true(load && ratio && power);
    assert_int_equal(read_rows("m.gp", at), 12);
    for (int i = 0; i < 12; i++) {
        CHECK_REL(at[i][0], ratio[i], 1e-8, "x of %d", i);
        CHECK_REL(at[i][1], load[i], 1e-8, "y of %d", i);
        CHECK_REL(at[i][2], power[i], 1e-8, "dissipation of %d", i);
    }
}

/* A table of cases is a grid in whatever order its rows come. */
TEST(a_table_of_cases_may_be_a_grid)
{
    double at[20][3];
    write_file("grid", "load creep-ratio\n400 .5\n100 .9\n100 .5\n400 .2\n100 .2\n400 .9\n");
    assert_int_equal(rollbem(STUDY "--similar --contact-elements 20 --cases grid --map "
                                   "g.png --over load --family creep-ratio --plot-script g.gp"),
                     0);
    assert_true(begins_like_a_picture("g.png", "\x89PNG"));
    assert_int_equal(read_rows("g.gp", at), 6);
    for (int i = 0; i < 6; i++) {
        static const double ratio[] = {0.2, 0.5, 0.9};
        CHECK_ABS(at[i][0], i % 2 ? 400.0 : 100.0, 0.0, "x");
        CHECK_ABS(at[i][1], ratio[i / 2], 0.0, "y");
    }
    write_file("holes", "load creep-ratio\n400 .5\n100 .9\n100 .5\n400 .2\n");
    check_refused(STUDY "--cases holes --map g.png", 64,
                  "--map: a map needs a case for every pair of creep-ratio and load");
}

/* A curve for each value of the family; the option that varies fastest lies along x. */
TEST(curves_are_those_of_the_family)
{
    double at[20][3];
    assert_int_equal(rollbem(GRID "--plot c.png --plot-script c.gp"), 0);
    assert_true(begins_like_a_picture("c.png", "\x89PNG"));
    assert_int_equal(read_rows("c.gp", at), 12);
    assert_non_null(strstr(script_text, "first = ' 0 4 8'\nlast = ' 3 7 11'\n"));
    CHECK_REL(at[9][2], -0.75, 0.02, "Carter at half the creepage");
    CHECK_REL(at[11][2], -1.0, 1e-6, "full sliding");
    assert_int_equal(rollbem(GRID "--plot c.png --over load --show max_pressure "
                                  "--plot-script c.gp"),
                     0);
    assert_int_equal(read_rows("c.gp", at), 12);
    assert_non_null(strstr(script_text, "first = ' 0 3 6 9'\n"));
    CHECK_REL(at[11][2] / at[9][2], 3.0, 1e-2, "Hertz: p0 goes as the root of the load");
    assert_int_equal(rollbem(STUDY "--vary-1 'load 0.05:0.9:5:log' --plot c.pdf "
                                   "--plot-script c.gp --show stick_length"),
                     0);
    slurp("c.gp", out, sizeof out);
    assert_non_null(strstr(out, "x_step = 0.0\n"));
    assert_non_null(strstr(out, "y_name = ''\n"));
}

/* A study that goes on, and one that is finished, draw what is in the file. */
TEST(a_resumed_study_draws_all_its_rows)
{
    static char whole[40000], again[40000];
    static const char study[] = GRID "--plot r.png --plot-script r.gp --output r.tsv";
    for (int cut = 0; cut < 3; cut++) {
        assert_int_equal(rollbem(study), 0);
        slurp("r.gp", cut ? again : whole, sizeof again);
        if (cut)
            assert_string_equal(strstr(again, "$table"), strstr(whole, "$table"));
        if (cut == 0)
            assert_int_equal(shell("head -n 9 r.tsv >cut && mv cut r.tsv"), 0);
    }
}

/* Cases without a solution leave a hole; the exit code tells of them. */
TEST(unsolved_cases_leave_holes)
{
    double at[20][3];
    assert_int_equal(rollbem(STUDY "--zone 1 --vary-1 'load 100 200 1e5' --plot h.png "
                                   "--show max_pressure --plot-script h.gp"),
                     1);
    assert_int_equal(read_rows("h.gp", at), 3);
    assert_true(isfinite(at[0][2]) && isfinite(at[1][2]) && isnan(at[2][2]));
    check_refused("sweep --support halfplane --mu 0 --load 5 --vary-1 'radius 10 20' "
                  "--header bare --output n.tsv --quiet --plot h.png",
                  64, "--plot: no case has a force_ratio");
}

/* What the file of a study says stands there, whatever varies. */
TEST(files_of_studies_are_blamed_by_line)
{
    static const struct {
        const char *line, *part;
    } wrong[] = {{"radius-b = -30", "f.ini:6: radius-b: a bore must be larger"},
                 {"hardening = -3", "f.ini:6: hardening: only for an interface that yields"},
                 {"cover-thickness-b = 1", "f.ini:6: cover-thickness-b: its core"},
                 {"shift = 1", "f.ini:6: shift: rolling is driven by"},
                 {"zone = 1e30", "f.ini:6: zone: 1e+30 mm is wider than"},
                 {"force-ratio = 3", "f.ini:6: force-ratio: Q/(mu P) = 3"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        if (!is_in_turn((int)k, 6))
            continue;
        char text[300];
        snprintf(text, sizeof text,
                 "radius = 50\nload = 500\nsupport = halfplane\nsimilar = yes\n"
                 "formulation = steady\n%s\n",
                 wrong[k].line);
        write_file("f.ini", text);
        check_refused("sweep f.ini --vary-1 'mu .1 .2'", 65, wrong[k].part);
    }
}

TEST(what_cannot_be_drawn_is_refused)
{
    static const struct {
        const char *arguments;
        const char *part;
    } all[] = {
        {"--over mu", "--over: there is no picture; --plot FILE or --map FILE asks"},
        {"--plot a.png --over mu", "--over: expected an option that varies, got 'mu'"},
        {"--plot a.png --over laod", "got 'laod' (did you mean 'load'?)"},
        {"--plot a.png --over load --family load", "--family: expected another option"},
        {"--plot a.png --show force_ration", "no result 'force_ration' (did you mean"},
        {"--plot a.png --show creep_ratio", "--show: creep_ratio varies"},
        {"--map a.png --vary-3 'mu .1 .2' ",
         "--map: cases 1 and 9 have the same mu and creep-ratio: more options vary"},
        {"--plot a.jpg", "--plot: expected a name ending in .png, .svg, .pdf, .eps or .tex"},
        {"--map a.gif", "--map: a .gif shows a history step by step (--history-plot FILE.gif)"},
        {"--plot-size 85mm", "--plot-size: there is no picture"},
        {"--plot a.png --map b.png --plot-script c.gp", "--plot-script: expected one picture"},
        {"--plot a.png --map a.png", "both would write 'a.png'"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 6))
            continue;
        char line[600];
        snprintf(line, sizeof line, GRID "%s", all[k].arguments);
        check_refused(line, 64, all[k].part);
    }
    check_refused(STUDY "--vary-1 'mu .1 .2' --map a.png", 64, "--map: a map needs two options");
    check_refused(STUDY "--vary-1 'mu .1 .1' --plot a.png", 64, "--plot: no option varies");
    check_refused(STUDY "--sample 5 --tolerance mu=.1,load=1% --map a.png", 64,
                  "--map: the cases of a sample are on no grid; --plot draws them");
    check_refused(STUDY "--sample 5 --tolerance mu=.1,load=1% --family mu --plot a.png", 64,
                  "--family: the cases of --sample are points");
    check_refused(STUDY "--vary-1 'load 1:99:20' --vary-2 'mu .1 .2' --plot a.png --family load",
                  64, "--plot: 20 values of load: at most 16 curves");
    check_refused(STUDY "--cases one --plot a.png", 66, "one: No such file");
}

/* The same numbers as those of a single case: its largest stresses and its error bars. */
TEST(rows_have_stresses_and_error_bars)
{
#define SLIDING                                                                                    \
    "--support halfplane --similar --mu 0.3 --formulation steady "                                 \
    "--creep-ratio 0.5 --contact-elements 40 --error "
    held_json *root = run_json("sweep " SLIDING "--vary-1 'load 100 400' --units si "
                               "--results max_shear,max_shear_y,tension");
    const json_t *table = json_object_get(root, "table");
    json_t *one = run_json("stress " SLIDING "--load 400 --units si");
    const json_t *shear = json_object_get(json_object_get(one, "maxima"), "max_shear"),
                 *bar = json_object_get(shear, "errors");
    CHECK_REL(entry(table, "max_shear_Pa", 1), number_in(shear, "value"), 1e-12, "shear");
    CHECK_REL(entry(table, "max_shear_y_m", 1), number_in(shear, "y"), 1e-12, "depth");
    CHECK_REL(entry(table, "error_max_shear_Pa", 1), number_in(bar, "value"), 1e-12,
              "error bar of the shear");
    json_decref(one);
    one = run_json(SLIDING "--load 400 --units si");
    const json_t *errors = json_object_get(json_object_get(one, "summary"), "errors");
    CHECK_REL(entry(table, "error_half_width_m", 1), number_in(errors, "half_width"), 1e-12,
              "error bar of the half-width");
    CHECK_REL(entry(table, "error_force_ratio", 1), number_in(errors, "force_ratio"), 1e-12,
              "error bar of the force");
    CHECK_REL(entry(table, "max_shear_Pa", 1) / entry(table, "max_shear_Pa", 0), 2.0, 1e-6,
              "stress goes as the root of the load");
    json_decref(one);
    double at[20][3];
    assert_int_equal(rollbem("sweep " SLIDING "--vary-1 'load 100 400 900' --plot e.svg "
                             "--show error_max_shear --plot-script e.gp --output e.tsv"),
                     0);
    assert_int_equal(read_rows("e.gp", at), 3);
    assert_true(at[0][2] > 0.0 && at[2][2] > at[0][2]);
    assert_int_equal(rollbem("sweep " SLIDING "--vary-1 'load 100 400 900' --plot e.svg "
                             "--show error_max_shear --plot-script e.gp --output e.tsv"),
                     0);
    assert_non_null(strstr(err, "e.tsv holds 3 of 3 cases"));
}

TEST(an_empty_file_is_a_start)
{
    char whole[20000], got[20000];
    assert_int_equal(rollbem(THREE "--restart"), 0);
    slurp("s.tsv", whole, sizeof whole);
    write_file("s.tsv", "");
    assert_int_equal(rollbem(THREE), 0);
    slurp("s.tsv", got, sizeof got);
    assert_string_equal(strstr(got, "# study"), strstr(whole, "# study"));
}

/* More than a page of command line, as a study of many values has. */
TEST(a_long_command_line_is_resumed)
{
    if (!is_in_turn(0, 8))
        skip();
    assert_int_equal(shell("v=$(seq -s' ' 0.0001 0.0001 0.1); "
                           "\"$R\" " STUDY "--contact-elements 10 --vary-1 \"mu $v\" "
                           "--output long.tsv && head -n 500 long.tsv >l && cp long.tsv w && "
                           "cp l long.tsv && \"$R\" " STUDY "--contact-elements 10 "
                           "--vary-1 \"mu $v\" --output long.tsv && cmp w long.tsv"),
                     0);
}

/* A study of a history with --fretting: each row is what the case alone has, with its bars. */
TEST(studies_of_fretting)
{
#define FRETS                                                                                      \
    "--support halfplane --similar --gap parabola --radius 100 --load 500 --history reversal.txt "
    static const char *const names[] = {"work_per_cycle", "ruiz_2_max", "swt_max",
                                        "tresca_shear_b_max"};
    OWNED(rb_io_table) t;
    write_file("reversal.txt", "force_ratio\n0\n0.6\n-0.6\n0.6\n");
    assert_int_equal(rollbem("sweep " FRETS "--fretting --error --quiet --contact-elements 30 "
                             "--vary-1 'mu 0.3 0.5' --results von_mises"),
                     0);
    write_file("rows", out);
    CHECK_OK(rb_io_table_read("rows", &t, NULL));
    assert_int_equal(t.rows, 2);
    for (int k = 0; k < 2; k++) {
        held_json *root = run_json(k ? FRETS "--fretting --error --contact-elements 30 --mu 0.5"
                                     : FRETS "--fretting --error --contact-elements 30 --mu 0.3");
        const json_t *summary = json_object_get(root, "summary");
        for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
            char bar[100], heading[80];
            const rb_rolling_result *r =
                rb_rolling_find_result(&rb_rolling_solution_scalars, names[i]);
            rb_rolling_heading(r, RB_UNITS_MM, heading);
            snprintf(bar, sizeof bar, "error_%s", heading);
            CHECK_REL(NOT_NULL(rb_io_table_column(&t, heading))[k], number_in(summary, names[i]),
                      1e-12, "%s", names[i]);
            CHECK_REL(NOT_NULL(rb_io_table_column(&t, bar))[k],
                      number_in(json_object_get(summary, "errors"), names[i]), 1e-12, "%s", bar);
        }
        assert_true(NOT_NULL(rb_io_table_column(&t, "von_mises_MPa"))[k] > 0.0);
        assert_null(rb_io_table_column(&t, "error_normal_load_N/mm"));
    }
    check_refused("sweep " FRETS "--vary-1 'mu 0.3'", 64, "only with --fretting");
    check_refused("sweep " FRETS "--fretting --vary-1 'mu 0.3' --derivatives swt_max", 64,
                  "has no derivatives");
    check_refused("sweep " FRETS "--fretting --vary-1 'mu 0.3' --tolerance mu=0.01", 64,
                  "has no derivatives");
    check_refused("sweep " FRETS "--fretting --vary-1 'mu 0.3' --crack-length 0.1", 64,
                  "only of a single case");
}

TEST(files_of_the_case_belong_to_the_study)
{
    static const char study[] = "sweep --support halfplane --formulation steady --load 100 "
                                "--quiet --gap gap.tsv --zone 0.4 --contact-elements 20 "
                                "--vary-1 'creep-ratio 0:1:3' --output g.tsv";
    assert_int_equal(shell("seq -2 0.1 2 | awk '{print $1, $1*$1/100}' >gap.tsv"), 0);
    assert_int_equal(rollbem(study), 0);
    assert_int_equal(rollbem(study), 0);
    assert_int_equal(shell("seq -2 0.1 2 | awk '{print $1, $1*$1/120}' >gap.tsv"), 0);
    check_refused(study, 73, "g.tsv: has other contents");
}

TEST(two_programs_on_one_file_are_refused)
{
    static const char line[] =
        "\"$R\" " STUDY "--contact-elements 200 --jobs 1 --vary-1 'creep-ratio 0:1:4000' "
        "--output both.tsv & p=$!; until [ -s both.tsv ]; do sleep 0.02; done; "
        "\"$R\" " STUDY "--contact-elements 200 --vary-1 'creep-ratio 0:1:4000' --output "
        "both.tsv; code=$?; \"$R\" " STUDY "--contact-elements 200 --vary-1 'creep-ratio 0:1:4000' "
        "--output both.tsv --restart; again=$?; kill $p; wait $p; [ $again = 73 ] && exit $code";
    CHECK_RUN(shell(line), 73, err, "both.tsv: another process is writing it");
}

TEST(a_finished_study_keeps_its_exit_code)
{
    static const char study[] = "sweep --support halfplane --mu 0 --vary-1 'load 1 2' "
                                "--zone 0.001 --contact-elements 10 --output f.tsv";
    assert_int_equal(rollbem(study), 1);
    CHECK_RUN(rollbem(study), 1, err, "holds 2 of 2 cases");
    assert_non_null(strstr(err, "not solved: 2 of 2"));
}

/* Words, labels and units of a table: each row is the case that the command line says. */
TEST(rows_of_a_table_have_words_and_labels)
{
    static const char *const cases[] = {
        "--support halfplane --mesh uniform --plane strain --load 500 --young 210GPa",
        "--support hub --mesh aligned --plane strain --load 600 --young 190GPa",
        "--support halfplane --mesh fitted --plane stress --load 700 --young 190GPa --similar"};
    write_file("words.csv", "name;support;mesh;plane;load [kN/m];young_GPa;similar;yield-stress\n"
                            "old rail;halfplane;uniform;strain;500,0;210;no;none\n"
                            "\"hub, worn\";hub;aligned;strain;600,0;190;no;none\n"
                            "disc;halfplane;fitted;stress;700000N/m;190GPa;yes;none\n");
#define ROLLS "--poisson 0.3 --formulation steady --creep-ratio 0.4 --contact-elements 20"
    assert_int_equal(rollbem("sweep " ROLLS " --cases words.csv --json --quiet"), 0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *table = json_object_get(root, "table");
    const json_t *names = json_object_get(table, "name");
    assert_string_equal(json_string_value(json_array_get(names, 1)), "hub, worn");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        held_json *one = run_jsonf(ROLLS " %s", cases[k]);
        CHECK_REL(entry(table, "tangential_load_N/mm", k),
                  number_in(json_object_get(one, "summary"), "tangential_load"), 1e-12,
                  "Q of row %zu", k + 1);
    }
    CHECK_ABS(entry(table, "load", 2), 700.0, 1e-9, "a unit in a cell");
    /* the same rows again, to the digit, where they are resumed */
    assert_int_equal(rollbem("sweep " ROLLS " --cases words.csv --output w.tsv --quiet"), 0);
    assert_int_equal(shell("head -6 w.tsv >x.tsv && cp w.tsv all.tsv && mv x.tsv w.tsv && "
                           "\"$R\" sweep " ROLLS " --cases words.csv --output w.tsv --quiet && "
                           "grep -v rollbem w.tsv >a && grep -v rollbem all.tsv >b && cmp a b && "
                           "grep -q '\"old rail\"' w.tsv"),
                     0);
    assert_int_equal(rollbem("sweep --support halfplane --load 100 --vary-1 'plane strain stress' "
                             "--vary-2 'mu 0.1 0.2' --header=bare --quiet"),
                     0);
    assert_non_null(strstr(out, "\n4\tstress\t0.2\t0\t"));
    static const struct {
        const char *table, *part;
    } wrong[] = {{"support,load\nhalfplan,1\n", ":2: support: expected arc, hub or halfplane, got"},
                 {"support,load\n3,1\n", ":2: support: expected arc, hub or halfplane, got '3'"},
                 {"load\nmuch\n", ":2: load: expected a number > 0, got 'much'"},
                 {"load\n5MPa\n", ":2: load: expected a number in one of N/mm"},
                 {"suport,load\nhub,1\n", "'suport' is not an option of a case"},
                 {"amount,load\n3,1\n", "'amount' is not an option of a case"},
                 {"units,load\nsi,1\n", "'units' is not an option of a case"},
                 {"similar,load\nmaybe,1\n", ":2: similar: expected yes or no, got 'maybe'"}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        write_file("wrong.csv", wrong[k].table);
        check_refused("sweep --cases wrong.csv --quiet", 65, wrong[k].part);
    }
}

/* Pictures of a table of cases are drawn whatever its grid; words stand at their places. */
TEST(tables_of_cases_are_drawn)
{
    write_file("cases.csv", "name,support,load,mu\na,halfplane,100,0.1\nb,hub,200,0.2\n"
                            "c,halfplane,200,0.3\nd,hub,300,0.1\n");
    static const struct {
        const char *options, *drawn;
    } all[] = {{"", "apart = 1"},
               {"--family support", "name2 = 'hub'"},
               {"--over support", "word2 = 'hub'"},
               {"--over name --show max_pressure", "word4 = 'd'"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        assert_int_equal(rollbemf("sweep " ROLLS " --cases cases.csv --plot p.svg --plot-script "
                                  "p.gp --quiet %s",
                                  all[k].options),
                         0);
        if (shellf("grep -qF \"%s\" p.gp", all[k].drawn) != 0)
            fail_msg("no %s", all[k].drawn);
    }
    assert_int_equal(rollbem("sweep --poisson 0.3 --support halfplane --formulation steady "
                             "--creep-ratio 0.4 --contact-elements 20 --load 100 --vary-1 'plane "
                             "strain stress' --vary-2 'mu 0.1 0.2' --plot p.svg --plot-script p.gp "
                             "--quiet"),
                     0);
    assert_int_equal(shell("grep -q \"name2 = 'stress'\" p.gp"), 0);
    check_refused("sweep --support halfplane --formulation steady --load 100 --vary-1 'plane "
                  "strain stress' --vary-2 'creep-ratio 0.1 0.2' --map p.svg",
                  64, "--map: a map needs two options with numbers, plane has words");
}

RUN_TESTS(enter_folder, leave_folder)
