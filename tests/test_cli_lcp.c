/* `rollbem lcp` as its users meet it.  B: the build directory, default build. */
#define _XOPEN_SOURCE 700
#include "cli_run.h"

static const char GOOD[] = "2\n0\n2\n2\n2 2\n2 1\n1 2\n-5 -6\n";
static const char RAY[] = "1 0 1 1 1 1 -1 -1";
static const char KOSTREVA[] = "3 0 3 3 3 3 1 0 2 2 1 0 0 2 1 -1 -1 -1";

static int lcp(const char *arguments)
{
    return rollbemf("lcp %s", arguments);
}

static int enter(void **state)
{
    const int entered = enter_folder(state);
    write_file("good", GOOD);
    write_file("ray", RAY);
    write_file("kostreva", KOSTREVA);
    write_file("bad", "2 0 2 2 2 2 1 x 1 2 -5 -6");
    return entered;
}

/* Nothing else was left behind. */
static int leave(void **state)
{
    const char *names[] = {"good", "ray", "kostreva", "bad", "large", "out", "err", "p", "x", "y"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        unlink(names[i]);
    return chdir("/") || rmdir(folder);
}

TEST(a_line_per_file)
{
    char status[40];
    int n, pivots;
    double residual;
    assert_int_equal(lcp("good"), 0);
    assert_string_equal(err, "");
    const char *line = NOT_NULL(strstr(out, "\ngood\t"));
    assert_int_equal(sscanf(line, "\ngood\t%39s\t%d\t%d\t%lf", status, &n, &pivots, &residual), 4);
    assert_string_equal(status, "solved");
    assert_int_equal(n, 2);
    assert_int_equal(pivots, 3);
    CHECK_MAX(residual, 1e-14, "residual");
}

TEST(the_largest_exit_code_wins_and_all_files_run)
{
    CHECK_RUN(lcp("good ray"), 1, err, "ray: lcp: no solution");
    CHECK_RUN(lcp("bad ray good"), 65, out, "\ngood\tsolved");
    assert_non_null(strstr(err, "bad:1: matrix, number 2"));
    CHECK_RUN(lcp("missing bad good"), 66, out, "\ngood\tsolved");
    assert_non_null(strstr(err, "missing"));
    assert_int_equal(lcp("good --output /nowhere/at/all"), 73);
    assert_int_equal(lcp(""), 64);
    assert_int_equal(lcp("--tol -1 good"), 64);
    assert_int_equal(lcp("--rule bland good"), 64);
    CHECK_RUN(lcp("--trase good"), 64, err, "--trace");
}

/* Each word where it must be said, and beside it where it must not. */
TEST(status_words_say_what_is_known)
{
    static const char
        turned[] = "2 -2 -2 2 -2 1 -1",
        hilbert[] =
            "3 1 .5 .333333333333333 .5 .333333333333333 .25 .333333333333333 .25 .2 -1 -.7 -.5";
    static const struct {
        const char *problem, *arguments, *status;
        int code;
    } cases[] = {
        {GOOD, "", "solved", 0},
        {GOOD, "--tol 1e-300", "solved", 0}, /* the residual is zero */
        {hilbert, "", "solved", 0},
        {hilbert, "--tol 1e-300", "solved-to-rounding", 0},
        {"1 0 -1", "", "no-solution", 1},
        {"1 1e-12 -1", "", "solved", 0}, /* z = 1e12 */
        {"1 0 -1", "--all", "no solution", 1},
        {turned, "--solver lemke", "secondary-ray", 1},
        {turned, "", "solved", 0},
        {"2 0 1 -1 0 -1 -1", "--solver lemke", "no-solution", 1}, /* a ray that proves it */
        {"2 -2 -2 2 0 1 -1", "--solver newton", "singular-matrix", 1},
        {GOOD, "--solver newton", "solved", 0},
        {KOSTREVA, "--solver lemke --max-pivots 3", "iteration-limit", 1},
        {KOSTREVA, "--solver lemke --max-pivots 4", "solved", 0},
        {KOSTREVA, "--seconds 1e-9", "time-limit", 1},
        {KOSTREVA, "--seconds 100", "solved", 0},
        /* z = 1e14 (1, 1), which Lemke's pivots do not find, and 1e11 (1, 1) */
        {"2 1 -.99999999999999 -.99999999999999 1 -1 -1", "--solver lemke", "numerical-failure", 1},
        {"2 1 -.99999999999999 -.99999999999999 1 -1 -1", "", "solved", 0},
        {"2 1 -.99999999999 -.99999999999 1 -1 -1", "--solver lemke", "solved", 0},
        {"2 1 -.99999999999999 -.99999999999999 1 -1 -1", "--all", "solved by enumeration", 0},
        {"2 1 -1 -1 1 -1 -1", "--all", "no solution", 1},
        /* what is proved counts, whatever the method has found */
        {"2 -2 -2 0 1 1 -2", "--solver lemke", "secondary-ray", 1},
        {"2 -2 -2 0 1 1 -2", "--solver lemke --prove", "no-solution", 1},
        {"2 1 -1 -1 1 -1 -1", "--solver newton --prove", "no-solution", 1},
        {"2 -1 1 2 0 -1 -2", "--solver lemke", "secondary-ray", 1},
        {"2 -1 1 2 0 -1 -2", "--solver lemke --prove", "solved", 0},
        {turned, "--solver lemke --prove", "secondary-ray", 1},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        char arguments[200], said[60];
        write_file("p", cases[k].problem);
        snprintf(arguments, sizeof arguments, "p %s", cases[k].arguments);
        snprintf(said, sizeof said, strstr(arguments, "--all") ? "p: %s" : "p\t%s\t",
                 cases[k].status);
        CHECK_RUN(lcp(arguments), cases[k].code, out, said);
    }
}

/* Rounding leaves 9e-13 of the terms on Hilbert's matrix, far more than "to rounding" allows. */
TEST(a_residual_above_the_tolerance_is_named)
{
    enum { n = 30 };
    FILE *f = NOT_NULL(fopen("p", "w"));
    double q[n] = {0.0};
    fprintf(f, "%d\n", n);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            q[i] -= 1.0 / (i + j + 1);
            fprintf(f, "%.17g ", 1.0 / (i + j + 1));
        }
    for (int i = 0; i < n; i++)
        fprintf(f, "%.17g ", q[i]);
    fclose(f);
    CHECK_RUN(lcp("p --tol 1e-300"), 1, out, "p\tresidual-above-tolerance\t");
    assert_non_null(strstr(err, "of its terms, above --tol 1e-300"));
    CHECK_RUN(lcp("p"), 0, out, "p\tsolved\t");
}

TEST(the_tie_rule_can_be_chosen)
{
    assert_int_equal(lcp("--rule first-index --max-pivots 100 kostreva"), 1);
    assert_non_null(strstr(out, "iteration-limit\t3\t100"));
    assert_int_equal(lcp("kostreva"), 0);
}

TEST(trace_and_solution_are_tables)
{
    double z = 0.0, w = 1.0;
    CHECK_RUN(lcp("--trace good"), 0, out, "file\tpivot\tentering\tleaving\trow\tratio\tz0\n");
    assert_non_null(strstr(out, "\ngood\t1\tz0\tw(2)\t2\t6\t6\n"));
    assert_non_null(strstr(out, "\ngood\t2\tz(2)\tw(1)\t1\t1\t4\n"));
    assert_int_equal(lcp("--solution good"), 0);
    assert_ptr_equal(strstr(out, "file\ti\tz\tw\n"), out);
    const char *line = NOT_NULL(strstr(out, "\ngood\t1\t"));
    assert_int_equal(sscanf(line, "\ngood\t1\t%lf\t%lf", &z, &w), 2);
    CHECK_REL(z, 4.0 / 3.0, 1e-15, "z(1)");
    CHECK_ABS(w, 0.0, 1e-15, "w(1)");
    assert_int_equal(lcp("--solution --trace good"), 64);
}

/* z(1) and z(2) of the only problem that was printed. */
static void solution(double z[2])
{
    const char *line = NOT_NULL(strstr(out, "\t1\t"));
    assert_int_equal(sscanf(line, "\t1\t%lf\t%*f\n%*s\t2\t%lf", &z[0], &z[1]), 2);
}

/* M = [1 2; 2 1] in plain text begins like a Siconos file by blocks: 2, 1, 2, 2. */
TEST(plain_text_is_read)
{
    static const char *const files[] = {
        "# M is not positive definite\n2\n1 2 # row 1\n2 1\n-1 -2\n", "2 1 2 2 1 -1 -2",
        "2\n1 2\n2 1\n-1 -2\n# and so on"};
    for (int k = 0; k < 3; k++) {
        double z[2];
        write_file("p", files[k]);
        assert_int_equal(lcp("--solution p"), 0);
        solution(z);
        const double w1 = z[0] + 2.0 * z[1] - 1.0, w2 = 2.0 * z[0] + z[1] - 2.0;
        CHECK_ABS(fmax(fabs(fmin(z[0], w1)), fabs(fmin(z[1], w2))), 0.0, 1e-15, "file %d", k);
        CHECK_RUN(lcp("--solution - <p"), 0, out, "\n# -: solved by lemke, n = 2, ");
    }
}

static void refused(const char *text, const char *arguments, const char *words)
{
    write_file("p", text);
    assert_int_equal(lcp(arguments), 65);
    if (!strstr(err, words))
        fail_msg("expected '%s' in: %s", words, err);
}

TEST(what_is_no_problem_is_refused)
{
    refused("2\n1 2\n2 1\n-1\n", "p", "p:5: q, number 2: expected a finite number");
    refused("2\n1 2\n2 1\n-1\n", "- <p", "standard input:5: q, number 2");
    refused("2\n1 2\n2 x\n-1 1\n", "p", "p:3: M, row 2, number 2");
    refused("2\n1 2\n2 1\n-1 1 7\n", "p", "p:4: expected the end of the file");
    refused("", "p", "n: expected");
    refused("2 1 0 2 2 2 2 1 0 0 1 -1 0 0.5", "p", "friction problem");
    refused("%%MatrixMarket matrix array real general\n2 2\n1 0 0 1\n", "p", "--q");
    write_file("x", "-1 -1 -1");
    refused("%%MatrixMarket matrix array real general\n2 2\n1 0 0 1\n", "--q x p",
            "x:1: q: expected 2 numbers, got 3");
    refused("%%MatrixMarket matrix array real general\n3 2\n1 0 0 1 1 1\n", "--q x p",
            "expected a square matrix, got 3 by 2");
    refused("1 1 -1", "--q x p", "holds q itself");
    assert_int_equal(lcp("--q x p good"), 64);
}

TEST(matrix_market_is_read)
{
    double z[2];
    write_file("p", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 1\n2 2 2");
    write_file("x", "-5 -6 # q\n");
    assert_int_equal(lcp("--solution --q x p"), 0);
    solution(z);
    CHECK_REL(z[0], 4.0 / 3.0, 1e-15, "z(1)");
    CHECK_REL(z[1], 7.0 / 3.0, 1e-15, "z(2)");
    write_file("x", "%%MatrixMarket matrix array real general\n2 1\n-5\n-6\n");
    assert_int_equal(lcp("--solution --q - p <x"), 0);
    solution(z);
    CHECK_REL(z[1], 7.0 / 3.0, 1e-15, "z(2)");
}

/* Without an unknown there is nothing to solve. */
TEST(empty_problems_are_solved)
{
    write_file("none", "0\n");
    write_file("none.mtx", "%%MatrixMarket matrix array real general\n0 0\n");
    write_file("none.q", "");
    assert_int_equal(rollbem("lcp --json none"), 0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *p = NOT_NULL(json_array_get(json_object_get(root, "problems"), 0));
    assert_string_equal(json_string_value(json_object_get(p, "status")), "solved");
    CHECK_ABS(number_in(p, "dimension"), 0.0, 0.0, "n");
    CHECK_ABS(number_in(p, "residual"), 0.0, 0.0, "residual");
    assert_int_equal(rollbem("lcp --solution none"), 0);
    assert_int_equal(rollbem("lcp none.mtx --q none.q"), 0);
    assert_int_equal(unlink("none") | unlink("none.mtx") | unlink("none.q"), 0);
}

TEST(a_cover_may_hold_zeros_where_q_is_not_negative)
{
    double z[2];
    write_file("p", "2\n2 1\n-3 2\n-1 0.5\n");
    write_file("x", "1 0");
    assert_int_equal(lcp("--solution --cover x p"), 0);
    solution(z);
    CHECK_REL(z[0], 2.5 / 7.0, 1e-14, "z(1)");
    CHECK_REL(z[1], 2.0 / 7.0, 1e-14, "z(2)");
    write_file("x", "0 1");
    assert_int_equal(lcp("--cover x p"), 65);
    assert_non_null(strstr(err, "cover(1) = 0: expected a number > 0, because q(1) = -1"));
    write_file("x", "1 -1");
    assert_int_equal(lcp("--cover x p"), 65);
    write_file("x", "1 1 1");
    CHECK_RUN(lcp("--cover x p"), 65, err, "cover: expected 2 numbers, got 3");
}

/* Murty's example of order 11 takes 2^11 pivots, more than 50 n + 1000. */
TEST(the_cap_is_named)
{
    FILE *f = NOT_NULL(fopen("p", "w"));
    fprintf(f, "11\n");
    for (int k = 0; k < 121; k++)
        fprintf(f, "%d ", k / 11 > k % 11 ? 2 : k / 11 == k % 11);
    for (int k = 0; k < 11; k++)
        fprintf(f, "-1 ");
    fclose(f);
    CHECK_RUN(lcp("--solver lemke p"), 1, err, "no solution after --max-pivots 1550");
    CHECK_RUN(lcp("--solver lemke --max-pivots 2048 p"), 0, out, "solved\t11\t2048\t0\t");
    assert_int_equal(lcp("p"), 0); /* another covering vector, or Newton */
}

/* The obstacle problem of n x n points: M in p, q in x. */
static void obstacle(int n)
{
    assert_int_equal(shellf("O=\"${R%%/*}/obstacle\"; \"$O\" %d >p && \"$O\" -q %d >x", n, n), 0);
}

/* Of 100 x 100 points: without a dense tableau, which takes 800 MB. */
TEST(a_large_sparse_problem_needs_no_dense_tableau)
{
    double residual;
    obstacle(100);
    assert_int_equal(shellf("%s OPENBLAS_NUM_THREADS=1 \"$R\" lcp --q x p",
                            SANITIZED ? "" : "ulimit -v 600000;"),
                     0);
    assert_non_null(strstr(out, "\np\tsolved\t10000\t"));
    assert_int_equal(sscanf(strstr(out, "\np\t"), "\np\t%*s\t%*d\t%*d\t%lf", &residual), 1);
    CHECK_MAX(residual, 1e-15, "residual");
}

/* Lemke's method itself on 50 x 50 points: a dense tableau would be 50 MB larger. */
TEST(lemke_on_a_large_sparse_problem_needs_no_tableau)
{
    double residual;
    obstacle(50);
    assert_int_equal(lcp("--solver lemke --q x p"), 0);
    assert_int_equal(sscanf(strstr(out, "\np\t"), "\np\tsolved\t2500\t%*d\t%lf", &residual), 1);
    CHECK_MAX(residual, 1e-15, "residual");
    CHECK_RUN(lcp("--json --solver lemke --q x p"), 0, out, "\"lemke-sparse\"");
}

TEST(the_solver_can_be_chosen)
{
    double z[2];
    assert_int_equal(lcp("--solution --solver newton good"), 0);
    solution(z);
    CHECK_REL(z[0], 4.0 / 3.0, 1e-15, "z(1)");
    assert_int_equal(lcp("--solver newton ray"), 1);
    assert_int_equal(lcp("--solver newton --trace good"), 64);
    assert_int_equal(lcp("--solver simplex good"), 64);
    CHECK_RUN(lcp("--json --solver newton good"), 0, out, "newton");
}

/* w(1) < 0 at the upper end, w(2) = 0 in between. */
TEST(boxes_are_solved)
{
    double z[2];
    write_file("x", "1 inf # the upper bounds\n");
    assert_int_equal(lcp("--solution --upper x good"), 0);
    solution(z);
    CHECK_REL(z[0], 1.0, 1e-15, "z(1)");
    CHECK_REL(z[1], 2.5, 1e-15, "z(2)");
    assert_non_null(strstr(out, "\ngood\t1\t1\t-0.5\n"));
    CHECK_RUN(lcp("--trace --upper x good"), 0, out, "\tz0\n");
    assert_non_null(strstr(out, "\ngood\t1\tz0\t"));
    write_file("y", "-inf 3");
    assert_int_equal(lcp("--solution --lower y good"), 0);
    solution(z);
    CHECK_REL(z[0], 1.0, 1e-15, "z(1)");
    CHECK_REL(z[1], 3.0, 1e-15, "z(2)");
    write_file("y", "-inf 0");
    CHECK_RUN(lcp("--lower y --upper x good --solver newton"), 0, out, "\tnewton\n");
    write_file("y", "-inf inf");
    write_file("x", "1 -inf");
    CHECK_RUN(lcp("--lower y --upper x good"), 65, err, "good: lcp: bounds 2 are [inf, -inf]");
    write_file("x", "0 1 2");
    CHECK_RUN(lcp("--upper x good"), 65, err, "x:1: upper: expected 2 numbers, got 3");
    write_file("x", "1 nan");
    CHECK_RUN(lcp("--upper x good"), 65, err, "expected a number, inf or -inf, got 'nan'");
    write_file("x", "1 inf");
    assert_int_equal(lcp("--cover x good"), 65);
}

static int pivots_of(const char *file)
{
    char format[40];
    int pivots = -1;
    const char *line = NOT_NULL(strstr(out, file));
    snprintf(format, sizeof format, "%s\t%%*s\t%%*d\t%%d", file);
    assert_int_equal(sscanf(line, format, &pivots), 1);
    return pivots;
}

TEST(a_start_saves_the_pivots)
{
    write_file("x", "1.3 2.3");
    assert_int_equal(lcp("--start x --solver lemke good"), 0);
    assert_int_equal(pivots_of("\ngood"), 0);
    assert_int_equal(lcp("--start x --solver newton good"), 0);
    assert_int_equal(pivots_of("\ngood"), 1);
    write_file("x", "0 2.3");
    assert_int_equal(lcp("--start x good"), 0);
    assert_int_equal(lcp("--start missing good"), 66);
}

TEST(all_solutions_are_listed)
{
    write_file("p", "1 -1 1"); /* w = 1 - z: 0 and 1 */
    CHECK_RUN(lcp("--all p"), 0, out, "by enumeration, n = 1, 2 bases");
    assert_non_null(strstr(out, "\np\t1\t1\t0\t1\n"));
    assert_non_null(strstr(out, "\np\t2\t1\t1\t0\n"));
    CHECK_RUN(lcp("--all ray"), 1, err, "no solution (2 complementary bases)");
    assert_non_null(strstr(out, "# ray: no solution by enumeration, n = 1, 2 bases, "));
    assert_null(strstr(out, "nan"));
    assert_int_equal(lcp("--all --trace p"), 64);
    write_file("p", "1 0 0");
    CHECK_RUN(lcp("--all p"), 0, out, "solved by enumeration, n = 1, 2 bases");
    write_file("p", "1 0 -1");
    CHECK_RUN(lcp("--all p"), 1, err,
              "no solution (2 complementary bases; 1 singular, each excluded)");
    write_file("p", "1 1e-300 -1e300"); /* z = 1e600 */
    CHECK_RUN(lcp("--all p"), 1, err, "none found, 1 of 2 complementary bases undecided");
    assert_non_null(strstr(out, "undecided by enumeration"));
    write_file("p", "2  0 1 0 0  -1 0"); /* (t, 1) */
    CHECK_RUN(lcp("--all p"), 0, err, "belongs to singular bases only");
    CHECK_RUN(lcp("--all --json p"), 0, out, "\"singular_basis\": true");
    write_file("p", "2  1 0 -1 0  -1 0.9999999999999"); /* w2 = -1e-13 at z1 = 1 */
    CHECK_RUN(lcp("--all p"), 0, err, "1 of 1 solutions holds within rounding only");
    CHECK_RUN(lcp("--all --json p"), 0, out, "\"nearby\": true");
    write_file("p", "2  1 0 -1 0  -1 1");
    CHECK_RUN(lcp("--all --json p"), 0, out, "\"nearby\": false");
    assert_null(strstr(err, "rounding"));
    write_file("p", "2  2.0000000000000027 -2 2 -2  1.0000000000000355 1");
    CHECK_RUN(lcp("--all p"), 0, err, "at least 2 solutions: 1 of 4 bases is undecided");
    write_file("p", "1 0 0");
    CHECK_RUN(lcp("--all --json p"), 0, out, "\"solutions\"");
}

/* Of every example: two, a box, a sparse matrix, a game; and of a file without a solution. */
TEST(solutions_are_proved)
{
    static const char *const proved[] = {
        "$PROJECT/examples/lcp/two.txt",
        "$PROJECT/examples/lcp/murty.txt",
        "--upper $PROJECT/examples/lcp/rod-upper.txt $PROJECT/examples/lcp/rod.txt",
        "--q $PROJECT/examples/lcp/string-q.txt $PROJECT/examples/lcp/string.mtx",
        "--game $PROJECT/examples/lcp/game.txt",
        "--solver newton good",
        NULL};
    for (const char *const *file = proved; *file; file++) {
        assert_int_equal(rollbemf("lcp --prove --json %s", *file), 0);
        assert_non_null(strstr(err, ": proved: a solution with these signs, isolated"));
        held_json *root = NOT_NULL(json_loads(out, 0, NULL));
        const json_t *proof =
            json_object_get(json_array_get(json_object_get(root, "problems"), 0), "proof");
        assert_string_equal(json_string_value(json_object_get(proof, "status")), "proved");
        CHECK_MAX(json_number_value(json_object_get(proof, "stored_within")), 1e-13, "%s", *file);
        CHECK_MAX(json_number_value(json_object_get(proof, "nearby")), 1e-15, "%s", *file);
    }
    CHECK_RUN(lcp("--prove good"), 0, out, "scaled\tsolver\tproof\twithin\n");
    CHECK_RUN(lcp("--prove --solution good"), 0, out, "file\ti\tz\tw\twithin\n");
    CHECK_RUN(lcp("--prove ray"), 1, err, "ray: proved: there is no solution");
    write_file("large", "1 1e-320 -1\n"); /* z = 1e320 */
    CHECK_RUN(lcp("--prove large"), 1, err, "large: not proved: z is not finite");
    CHECK_RUN(lcp("--prove --json large"), 1, out, "\"reason\": \"z is not finite\"");
    CHECK_RUN(lcp("--prove --json ray"), 1, out, "\"status\": \"no solution\"");
    /* Lemke's last z has a wrong sign, which the proof exchanges: z = (1, 2). */
    write_file("p", "2 -1 1 2 0 -1 -2");
    CHECK_RUN(lcp("--prove --solver lemke --solution --header bare p"), 0, out, "\np\t1\t1\t0\t");
    assert_non_null(strstr(out, "\np\t2\t2\t0\t"));
    assert_non_null(strstr(err, "p: note: lemke found no solution (secondary ray); the proof found "
                                "this one from its last z"));
}

/* Of every example; of several, none, and infinitely many. */
TEST(numbers_of_solutions_are_proved)
{
    static const struct {
        const char *file, *number;
    } rows[] = {
        {"$PROJECT/examples/lcp/two.txt", "exactly 1 solution\n"},
        {"$PROJECT/examples/lcp/murty.txt", "exactly 1 solution\n"},
        {"$PROJECT/examples/lcp/rod.txt", "exactly 1 solution\n"},
        {"--upper $PROJECT/examples/lcp/rod-upper.txt $PROJECT/examples/lcp/rod.txt",
         "exactly 1 solution\n"},
        {"--q $PROJECT/examples/lcp/string-q.txt $PROJECT/examples/lcp/string.mtx",
         "exactly 1 solution\n"},
        {"--game $PROJECT/examples/lcp/game.txt", "exactly 3 solutions\n"},
        {"three", "exactly 3 solutions\n"},
        {"none", "there is no solution\n"},
        {"segment",
         "not proved: how many solutions there are; of 3 complementary bases it is open\n"},
    };
    write_file("three", "2  1 3  3 1  -2 -3");
    write_file("none", "2  0 1  -1 0  -1 -1");
    write_file("segment", "2  1 1  1 1  -1 -1");
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rollbemf("lcp --all --prove --json %s", rows[k].file);
        if (!strstr(err, rows[k].number))
            fail_msg("%s: %s", rows[k].file, err);
        held_json *root = NOT_NULL(json_loads(out, 0, NULL));
        const json_t *one = json_array_get(json_object_get(root, "problems"), 0),
                     *number = json_object_get(one, "number");
        assert_true(json_is_integer(json_object_get(number, "least")));
        for (size_t l = 0; l < json_array_size(json_object_get(one, "solutions")); l++)
            assert_true(json_is_object(
                json_object_get(json_array_get(json_object_get(one, "solutions"), l), "proof")));
    }
    CHECK_RUN(lcp("--all --prove three"), 0, out, "file\tsolution\ti\tz\tw\twithin\n");
    assert_int_equal(unlink("three") + unlink("none") + unlink("segment"), 0);
}

TEST(games_are_solved)
{
    write_file("p", "2 2 # battle of the sexes\n2 0 0 1\n1 0 0 2\n");
    assert_int_equal(lcp("--game --solution p"), 0);
    assert_non_null(strstr(out, "p\t1\t1\t0\np\t2\t0\t2\np\t3\t1\t0\np\t4\t0\t1\n"));
    assert_int_equal(lcp("--game --solution --label 2 p"), 0);
    assert_non_null(strstr(out, "p\t1\t0\t1\np\t2\t1\t0\np\t3\t0\t2\np\t4\t1\t0\n"));
    CHECK_RUN(lcp("--game --trace --json p"), 0, out, "\"payoffs\"");
    assert_non_null(strstr(out, "lemke-howson"));
    CHECK_RUN(lcp("--game --all p"), 0, out, "\np\t3\t4\t");
    assert_null(strstr(out, "\np\t4\t"));
    assert_int_equal(lcp("--game --label 5 p"), 64);
    assert_non_null(strstr(err, "--label: expected one of the 4 strategies of p, got 5"));
    CHECK_RUN(lcp("--game --max-pivots 1 p"), 1, err, "no solution after --max-pivots 1");
    assert_int_equal(lcp("--label 1 good"), 64);
    assert_int_equal(lcp("--game --upper x p"), 64);
    write_file("p", "2 2  2 0 0 1  1 0 0 2  7");
    CHECK_RUN(lcp("--game p"), 65, err, "expected the end of the file after m, n, A and B");
    write_file("p", "2 2  2 0 0 1  1 0 0");
    assert_int_equal(lcp("--game p"), 65);
}

static const char *text_of(const json_t *p, const char *key)
{
    return json_string_value(json_object_get(p, key));
}

TEST(json_holds_every_file)
{
    assert_int_equal(lcp("--json --trace --solution good ray bad"), 65);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    assert_string_equal(text_of(root, "schema"), "rollbem/1");
    const json_t *list = json_object_get(root, "problems");
    assert_int_equal(json_array_size(list), 3);
    const json_t *p = json_array_get(list, 0);
    assert_string_equal(text_of(p, "file"), "good");
    assert_string_equal(text_of(p, "solver"), "lemke");
    assert_string_equal(text_of(p, "status"), "solved");
    assert_int_equal(json_integer_value(json_object_get(p, "iterations")), 3);
    assert_int_equal(json_integer_value(json_object_get(p, "dimension")), 2);
    assert_int_equal(json_array_size(json_object_get(p, "pivots")), 3);
    CHECK_MAX(json_number_value(json_object_get(p, "residual")), 1e-14, "residual");
    CHECK_REL(json_number_value(json_array_get(json_object_get(p, "z"), 1)), 7.0 / 3.0, 1e-15,
              "z(2)");
    assert_string_equal(text_of(json_array_get(list, 1), "status"), "no solution");
    p = json_array_get(list, 2);
    assert_string_equal(text_of(p, "status"), "malformed file");
    assert_true(json_is_null(json_object_get(p, "residual")));
    assert_true(json_is_null(json_object_get(p, "z")));
}

TEST(the_collection_is_solved)
{
    char arguments[1100];
    snprintf(arguments, sizeof arguments, "%s/*.dat", outside_data("siconos/lcp"));
    assert_int_equal(lcp(arguments), 0);
    int solved = 0;
    for (const char *p = out; (p = strstr(p, "\tsolved\t")); p++)
        solved++;
    assert_true(solved >= 9);
}

RUN_TESTS(enter, leave)
