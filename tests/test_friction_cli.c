/* `rollbem friction` and `rollbem compare` as their users meet them. */
#define _XOPEN_SOURCE 700
#include "cli_run.h"
#include "lcp/friction/friction.h"

/* One contact, W = 1: pressed with 2, drawn with 3 against mu = 0.5: slides, r = (2, -1). */
static const char SLIDING[] = "2 1 0 2 2 2 2 1 0 0 1 -2 3 0.5";
/* K = 0 cannot be in this format; W = 0 with q_N < 0 has no solution. */
static const char WITHOUT_SOLUTION[] = "2 1 0 2 2 2 2 0 0 0 0 -2 3 0.5";
static const char ZERO_Q[] = "2 1 0 2 2 2 2 1 0 0 1 0 0 0.5";
static const char UNSYMMETRIC[] = "2 1 0 2 2 2 2 1 0.2 0 -1 -2 3 0.1";
static const char CONE[] = "2 1 0 2 2 2 2 1 0 0 1 -2 3 0 2 0.5";

static int set_up(void **state)
{
    const int bad = enter_folder(state);
    if (bad)
        return bad;
    write_file("slides", SLIDING);
    write_file("no", WITHOUT_SOLUTION);
    write_file("zero", ZERO_Q);
    write_file("odd", UNSYMMETRIC);
    write_file("cone", CONE);
    write_file("nan", "2 1 0 2 2 2 2 1 0 0 nan -2 3 0.5");
    write_file("mu", "2 1 0 2 2 2 2 1 0 0 1 -2 3 -0.5");
    write_file("short", "2 1 0 2 2 2 2 1 0 0 1 -2");
    write_file("dimension", "4 1 0 4 4 4 4 1 0 0 1");
    write_file("empty", "");
    write_file("foreign.hdf5", "\x89HDF\r\n\x1a\n and then nothing of the kind");
    return 0;
}

TEST(reactions_are_proved)
{
    CHECK_RUN(rollbem("friction --prove slides"), 0, err, "slides: proved: 1 slip; isolated, ");
    assert_non_null(strstr(out, "scaled\tproof\twithin\n"));
    assert_non_null(strstr(err, "; exact for q and mu within "));
    CHECK_RUN(rollbem("friction --prove --json slides"), 0, out, "\"proof\": {");
    assert_non_null(strstr(out, "\"status\": \"proved\""));
    CHECK_RUN(rollbem("friction --prove --facts slides"), 0, out, "asymmetry\tindefinite\tproof");
    CHECK_RUN(rollbem("friction --prove no"), 1, err, "no: not proved: ");
    CHECK_RUN(rollbem("friction --kind siconos-soclcp --prove cone"), 65, err,
              "--prove does not read problems on cones");
    /* ranks of zero and a worst contact with an error of 0 were printed */
    CHECK_RUN(rollbem("friction --kind siconos-soclcp --facts --json cone"), 65, err,
              "--facts does not read problems on cones");
    assert_non_null(strstr(out, "\"rank\": null"));
    assert_non_null(strstr(out, "\"asymmetry\": null"));
    CHECK_RUN(rollbem("friction --kind siconos-soclcp --json cone"), 0, out,
              "\"worst_residual\": null");
    assert_non_null(strstr(out, "\"worst_contact\": null"));
    CHECK_RUN(rollbem("friction --prove --all slides"), 64, err, "not with --all");
    CHECK_RUN(rollbem("friction --prove --trace slides"), 64, err, "not with --trace");
}

/* A steep rod: three solutions, a row per contact of each. */
TEST(all_solutions_are_listed)
{
    write_file("rod", "2 1 0 2 2 2 2 1.8757797451792866 1.3639461402385225 1.3639461402385225 "
                      "3.124220254820713 0.5 3 2.2");
    CHECK_RUN(rollbem("friction --all rod"), 0, out,
              "file\tsolution\tcontact\tstate\tr_N\tr_T\tu_N\tu_T\n");
    assert_non_null(strstr(out, "\nrod\t1\t1\tseparated\t0\t0\t0.5\t3\n"));
    assert_non_null(strstr(out, "\nrod\t2\t1\tstick\t0.632432"));
    assert_non_null(strstr(out, "\nrod\t3\t1\tslip+\t0.444483"));
    CHECK_RUN(rollbem("friction rod"), 0, err,
              "W_NN - mu |W_NT| < 0 at contact 1: there may be several solutions; --all lists");
    CHECK_RUN(rollbem("friction --all no"), 1, err, "no solution (4 states; 3 singular, each");
    CHECK_RUN(rollbem("friction --all --json rod"), 0, out, "\"slip+\"");
    CHECK_RUN(rollbem("friction --all cone --kind siconos-soclcp"), 65, err, "cones");
    write_file("space", "3 1 0 3 3 3 3 1 0 0 0 1 0 0 0 1 -1 0 0 0.5");
    CHECK_RUN(rollbem("friction --all space"), 65, err, "in two dimensions only");
    CHECK_RUN(rollbem("friction --all --solver lemke rod"), 64, err, "not with --solver");
}

TEST(the_answer_can_be_checked)
{
    assert_int_equal(rollbem("friction --json --solution slides"), 0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *p = NOT_NULL(json_array_get(json_object_get(root, "problems"), 0));
    assert_string_equal(json_string_value(json_object_get(p, "status")), "solved");
    assert_string_equal(json_string_value(json_object_get(p, "file")), "slides");
    CHECK_ABS(entry(p, "r", 0), 2.0, 1e-7, "r_N");
    CHECK_ABS(entry(p, "r", 1), -1.0, 1e-7, "r_T");
    CHECK_ABS(entry(p, "u", 1), 2.0, 1e-7, "u_T");
    CHECK_MAX(number_in(p, "residual"), 1e-8, "residual");
    CHECK_ABS(number_in(p, "contacts"), 1.0, 0.0, "contacts");
    CHECK_ABS(number_in(p, "dimension"), 2.0, 0.0, "dimension");
    assert_true(number_in(p, "floor") > 0.0 && number_in(p, "seconds") > 0.0);
}

/* File, solver, status: what does not depend on the clock. */
TEST(compare_writes_its_file)
{
    const char *const command = "compare --solvers nsn-ac,lemke slides zero";
    assert_int_equal(rollbemf("%s --output runs.tsv", command), 0);
    assert_string_equal(out, "");
    assert_int_equal(shellf("\"$R\" %s >printed", command), 0);
    assert_int_equal(shell("for f in printed runs.tsv; do grep -v '^#' $f | cut -f 1-3 >$f.part; "
                           "done; cmp printed.part runs.tsv.part && grep -c . printed.part"),
                     0);
    assert_string_equal(out, "5\n");
    assert_int_equal(rollbem("compare --solvers nsn-ac slides --output runs.json --json"), 0);
    held_json *root = NOT_NULL(json_load_file("runs.json", 0, NULL));
}

TEST(every_solver_is_there_by_name)
{
    char names[] = "auto nsn-ac nsn-jm nsn-nm nsn-fb nsn-ac-nls nsn-jm-nls nsn-nm-nls nsn-fb-nls "
                   "nsn-ac-hybrid nsn-ac-hybrid-100 nsgs-ac nsgs-aa nsgs-fp admm fixed-point "
                   "extragradient soclcp-smoothing lemke",
         *rest = names;
    for (const char *name; (name = strtok_r(rest, " ", &rest));) {
        char line[100];
        snprintf(line, sizeof line, "friction --solver %s slides zero", name);
        if (rollbem(line) != 0)
            print_error("%s: %s%s", name, out, err);
        assert_non_null(strstr(out, "slides\t"));
        assert_int_equal(rollbem(line), 0);
    }
}

TEST(bad_files_get_a_line_each_and_the_others_run)
{
    const int code = rollbem("friction nan mu short dimension empty foreign.hdf5 nowhere slides");
    assert_int_equal(code, 66);
    static const char *const wanted[] = {
        "rollbem: nan",   "rollbem: mu",           "rollbem: short",  "rollbem: dimension",
        "rollbem: empty", "rollbem: foreign.hdf5", "rollbem: nowhere"};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
        if (!strstr(err, wanted[k]))
            fail_msg("no line '%s' in:\n%s", wanted[k], err);
    }
    int lines = 0;
    for (const char *c = err; *c; c++)
        lines += *c == '\n';
    assert_int_equal(lines, 7);
    assert_non_null(strstr(out, "slides\t"));
    check_refused("friction --output x mu", 65, "mu");
    check_refused("friction --output x nowhere", 66, "nowhere");
}

TEST(what_is_not_solved_says_so)
{
    CHECK_RUN(rollbem("friction no slides"), 1, err, "rollbem: no: ");
    assert_non_null(strstr(err, "rollbem: no: note: no solution exists"));
    assert_non_null(strstr(out, "\tinfeasible\t"));
    assert_int_equal(rollbem("friction --max-iters 1 --solver fixed-point slides"), 1);
    assert_null(strstr(err, "no solution exists"));
    assert_null(strstr(out, "\tinfeasible\t"));
    assert_non_null(strstr(out, "slides\t"));
    CHECK_RUN(rollbem("friction --facts odd zero"), 0, err, "not symmetric");
    assert_non_null(strstr(err, "indefinite"));
    assert_non_null(strstr(out, "\trank\thyperstaticity\t"));
    CHECK_RUN(rollbem("friction --facts --solution odd"), 0, out, "asymmetry 0.2, indefinite\n");
}

/* One row more than are looked at unasked.  W is the identity but for its last entries,
 * which are not symmetric. */
TEST(large_problems_are_looked_at_when_asked)
{
    enum { ROWS = 3002 };
    static double q[ROWS], mu[ROWS / 2];
    rb_friction_problem p = {
        .form = RB_FRICTION_LOCAL_SPARSE, .dimension = 2, .contacts = ROWS / 2, .mu = mu, .q = q};
    OWNED(rb_triplets) W = {.rows = ROWS, .cols = ROWS};
    for (int i = 0; i < ROWS; i++) {
        rb_triplets_add(&W, i, i, 1.0);
        q[i] = i % 2 == 0 ? -1.0 : 0.1;
        mu[i / 2] = 0.5;
    }
    rb_triplets_add(&W, ROWS - 2, ROWS - 1, 0.25);
    assert_int_equal(rb_sparse_from_triplets(&W, &p.Ws), RB_OK);
    assert_int_equal(rb_friction_write("large.hdf5", &p, NULL, "large", NULL), RB_OK);
    assert_int_equal(rollbem("friction large.hdf5"), 0);
    assert_string_equal(err, "");
    assert_int_equal(rollbem("friction --facts large.hdf5"), 0);
    assert_non_null(strstr(err, "large.hdf5: note: W is not symmetric (|W - W'| is 0.25"));
    rb_sparse_free(&p.Ws);
}

TEST(cones_and_forced_formats)
{
    assert_int_equal(rollbem("friction --format siconos-soclcp --solution cone"), 0);
    assert_non_null(strstr(out, "soclcp-smoothing"));
    assert_int_equal(rollbem("friction --format siconos-soclcp --solver soclcp-smoothing cone"), 0);
    check_refused("friction --output x --format siconos-soclcp --solver lemke cone", 65,
                  "only soclcp-smoothing");
    check_refused("friction --output x --kind fclib slides", 65, "not an HDF5 file");
    check_refused("friction --output x --format fclib slides", 65, "not an HDF5 file");
}

/* Siconos' text form of M v = H r + q, u = H' v + b.  In the plane one mass of 2 that
 * falls on the ground and sticks, with as many degrees of freedom as rows, which a local
 * problem has as well; in space one of four coordinates that slides. */
TEST(global_problems_are_read_as_text)
{
    write_file("plane", "2 1 0 2 2 2 2 2 0 0 2\n0 2 2 2 2 1 0 0 1\n-4 1\n0 0\n0.5\n");
    write_file("loose", "2 1 0 2 2 2 2 2 0 0 0\n0 2 2 2 2 1 0 0 1\n-4 1\n0 0\n0.5\n");
    assert_int_equal(rollbem("friction --solver extragradient loose"), 1);
    assert_string_equal(err, "rollbem: loose: K is singular to rounding (nullity 1): there "
                             "is no W to condense to\n");
    assert_int_equal(rollbem("friction --solution plane"), 0);
    double r[3], u[3];
    const char *at = strstr(out, "\nplane\t");
    for (int k = 0; k < 2; k++, at = strstr(at + 1, "\nplane\t")) {
        assert_non_null(at);
        assert_int_equal(sscanf(at, "\nplane\t%*d\t%lf\t%lf", r + k, u + k), 2);
    }
    CHECK_ABS(r[0], 4.0, 1e-7, "r_N");
    CHECK_ABS(r[1], -1.0, 1e-7, "r_T");
    CHECK_ABS(u[0], 0.0, 1e-7, "u_N");
    CHECK_ABS(u[1], 0.0, 1e-7, "u_T");
    write_file("space", "3 1 0 4 4 4 4\n2 0 0 0 0 3 0 0 0 0 4 0 0 0 0 5\n"
                        "0 4 3 4 3\n1 0 0 0 0 0 1 0 0 0 0 1\n-9.81 0 3 0\n0 0.5 0\n0.4\n");
    assert_int_equal(rollbem("friction --kind siconos-global --solution space"), 0);
    at = strstr(out, "\nspace\t");
    for (int k = 0; k < 3; k++, at = strstr(at + 1, "\nspace\t")) {
        assert_non_null(at);
        assert_int_equal(sscanf(at, "\nspace\t%*d\t%lf\t%lf", r + k, u + k), 2);
    }
    CHECK_ABS(r[0], 9.81, 1e-7, "r_N");
    CHECK_ABS(r[1], -0.4 * 9.81, 1e-7, "r_T1");
    CHECK_ABS(u[1], 0.5 + (3.0 - 0.4 * 9.81) / 4.0, 1e-7, "u_T1");
    write_file("space", "3 1 0 4 4 4 4\n2 0 0 0 0 3 0 0 0 0 4 0 0 0 0 5\n0 3 3 4 3\n");
    check_refused("friction --output x space", 65, "rows of the matrix: expected 4, got '3'");
}

/* Two blocks without stiffness on each other; the friction of the upper one is at most 0.5. */
TEST(a_pile_that_nothing_holds_has_no_equilibrium)
{
    for (int pushed = 0; pushed < 2; pushed++) {
        char text[300];
        snprintf(text, sizeof text,
                 "2 2 0 4 4 4 4\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n0 4 4 4 4\n"
                 "1 0 0 0 0 1 0 0 -1 0 1 0 0 -1 0 1\n-1 0 -1 %s\n0 0 0 0\n0.5 0.5\n",
                 pushed ? "0.501" : "0.499");
        write_file("pile", text);
        assert_int_equal(rollbem("friction --kind siconos-global pile"), pushed);
        assert_int_equal(strstr(out, "\tinfeasible\t") != NULL, pushed);
        assert_int_equal(strstr(err, "note: no equilibrium exists") != NULL, pushed);
    }
}

/* Texts of Siconos that hold other problems, and problems without a contact. */
TEST(kinds_of_files_are_told_apart)
{
    write_file("mixed", "1 1 2\n1 2\n3 4\n5 6\n");
    write_file("rolling", "5 1 0 5 5 5 5");
    write_file("rolling-2d", "2 2 0 4 4 4 4 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 -1 0 -1 0 0.5 0.5 "
                             "0.1 0.1");
    CHECK_RUN(rollbem("friction mixed"), 65, err, "a mixed linear complementarity problem (MLCP)");
    CHECK_RUN(rollbem("friction rolling"), 65, err,
              "a problem of rolling friction (RFC3D) of Siconos");
    CHECK_RUN(rollbem("friction rolling-2d"), 65, err, "with mu_r behind mu");
    write_file("none", "3 0 0 0 0\n0\n0\n");
    assert_int_equal(rollbem("friction --json --solution none slides"), 0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    const json_t *p = NOT_NULL(json_array_get(json_object_get(root, "problems"), 0));
    assert_string_equal(json_string_value(json_object_get(p, "status")), "solved");
    CHECK_ABS(number_in(p, "contacts"), 0.0, 0.0, "contacts");
    CHECK_RUN(rollbem("compare none"), 65, err, "none: no contact, nothing to compare");
}

/* K = diag(2, 2) with digits lost; its symmetric part is solved. */
TEST(a_small_asymmetry_of_k_is_taken_out)
{
    static const char K[] = "2 1 0 2 2 2 2 2 0 %s 2\n0 2 2 2 2 1 0 0 1\n-4 1\n0 0\n0.5\n";
    char text[100];
    snprintf(text, sizeof text, K, "1.2e-6");
    write_file("lost", text);
    CHECK_RUN(rollbem("friction --solution lost"), 0, err,
              "lost: note: K is not symmetric (|K - K'| is 6e-07 of |K|); its symmetric part");
    double r;
    assert_int_equal(sscanf(NOT_NULL(strstr(out, "\nlost\t1\t")), "\nlost\t1\t%lf", &r), 1);
    CHECK_ABS(r, 4.0, 1e-5, "r_N");
    snprintf(text, sizeof text, K, "2e-3");
    write_file("lost", text);
    CHECK_RUN(rollbem("friction lost"), 65, err, "K is not symmetric: |K - K'| = 0.001 of |K|");
    snprintf(text, sizeof text, K, "2e-9"); /* rounding */
    write_file("lost", text);
    assert_int_equal(rollbem("friction lost"), 0);
    assert_null(strstr(err, "note"));
}

/* The standard input and pipes are read to their end before anything is looked for in them. */
TEST(pipes_are_read)
{
    CHECK_RUN(shell("\"$R\" friction --json - <slides"), 0, out, "\"solved\"");
    CHECK_RUN(shell("cat slides | \"$R\" friction -"), 0, out, "solved");
    CHECK_RUN(shell("cat slides | \"$R\" compare --solvers nsn-ac -"), 0, out, "nsn-ac");
    CHECK_RUN(shell("rm -f p && mkfifo p && (cat slides >p & \"$R\" friction p)"), 0, out, "\np\t");
    CHECK_RUN(shell("cat empty | \"$R\" friction -"), 65, err, "rollbem: standard input");
    CHECK_RUN(shell("cat short | \"$R\" friction -"), 65, err, "rollbem: standard input:1:");
    CHECK_RUN(shell("mkdir -p t && TMPDIR=t \"$R\" friction - <foreign.hdf5; "
                    "test $? = 65 && ls t | wc -l"),
              0, out, "0\n");
    CHECK_RUN(shell("TMPDIR=nowhere \"$R\" friction - <slides"), 73, err,
              "standard input: cannot be copied to nowhere/rollbem-");
}

TEST(the_command_line_is_checked)
{
    check_refused("friction", 64, "FILE");
    check_refused("friction --solver nsn-acc slides", 64, "did you mean 'nsn-ac'");
    check_refused("friction --tol 0 slides", 64, "--tol");
    check_refused("friction --output /nowhere/x slides", 73, "/nowhere/x");
    check_refused("compare --solvers nsn-ac,nsn-ac slides", 64, "twice");
    check_refused("compare --solvers nsn-ac,newton slides", 64, "'newton'");
    check_refused("compare --plot x.txt slides", 64, "--plot");
    check_refused("compare", 64, "FILE");
}

TEST(profiles_are_printed)
{
    assert_int_equal(rollbem("compare --solvers nsn-ac,nsgs-ac,lemke --json slides zero no"), 0);
    held_json *root = NOT_NULL(json_loads(out, 0, NULL));
    assert_int_equal(json_array_size(json_object_get(root, "runs")), 9);
    const json_t *profiles = json_object_get(root, "profiles");
    const size_t last = json_array_size(json_object_get(root, "tau")) - 1;
    CHECK_ABS(entry(profiles, "nsn-ac", last), 2.0 / 3.0, 1e-12, "two of three");
    assert_int_equal(rollbem("compare --solvers auto slides nowhere --plot p.svg "
                             "--profiles p.tsv --plot-size 85mm --plot-script p.gp"),
                     66);
    assert_int_equal(shell("grep -q '^# profiles over flops, 1 problem$' p.tsv"), 0);
    assert_int_equal(shell("grep -q 'width=.321. height=.321.' p.svg && gnuplot -d p.gp | "
                           "cmp - p.svg"),
                     0);
}

/* In units in which W is 1e4 times as large, (13) with rho = 1 is content after one
 * sweep; the scaled measure does not see the units. */
TEST(the_chosen_measure_decides)
{
    static const char *const sweeps[] = {"scaled", "acary"};
    write_file("stiff", "3\n2\n0\n6 6\n6 6\n2e4 0 0 1e4 0 0\n0 2e4 0 0 1e4 0\n"
                        "0 0 2e4 0 0 1e4\n1e4 0 0 2e4 0 0\n0 1e4 0 0 2e4 0\n"
                        "0 0 1e4 0 0 2e4\n-3e4 1e4 0 -3e4 0 4e4\n0.3 0.3\n");
    for (int k = 0; k < 2; k++) {
        char line[200];
        snprintf(line, sizeof line,
                 "compare stiff --solvers nsgs-ac --tol 1e-2 --measure %s --cost iterations --json",
                 sweeps[k]);
        assert_int_equal(rollbem(line), 0);
        held_json *root = json_loads(out, 0, NULL);
        const json_t *run = json_array_get(json_object_get(root, "runs"), 0);
        CHECK_ABS(number_in(run, "iterations"), k == 0 ? 3.0 : 1.0, 0.0, "%s", sweeps[k]);
        assert_string_equal(json_string_value(json_object_get(root, "measure")), sweeps[k]);
        assert_string_equal(json_string_value(json_object_get(root, "cost")), "iterations");
    }
    check_refused("compare stiff --measure flops", 64, "--measure: expected scaled or");
}

RUN_TESTS(set_up, leave_folder)
