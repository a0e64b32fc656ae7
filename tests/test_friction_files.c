/* Problems from the files of other projects, and to them: every number arrives where it
 * belongs, in every form that a file can have. */
#include "check.h"
#include "lcp/friction/friction.h"
#include "base/io/io_fclib.h"
#include "scratch.h"

static void put(const char *text)
{
    FILE *f = NOT_NULL(fopen(path, "w"));
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

/* d, contacts; 0: dense, rows, columns, rows, columns; W by columns; q; mu. */
static const char full[] = "2 1 0 2 2 2 2\n4 1 2 3\n-5 -6\n0.5\n";
static const char half[] = "2 1 0 2 2 2 2\n4 0 0 3\n-5 -6\n0.5\n";
/* d, contacts, M; H; f; w; mu. */
static const char global[] = "2 1 0 3 3 3 3\n2 0 0 0 3 0 0 0 4\n0 3 2 3 2\n1 0 5 0 1 0\n"
                             "7 8 9\n0.1 0.2\n0.3\n";
/* As many motions as rows of contacts: its head is that of a local problem too. */
static const char two_ways[] = "2 1 0 2 2 2 2\n2 0 0 4\n0 2 2 2 2\n1 0 0 5\n7 8\n0.1 0.2\n0.3\n";
/* n, cones; M; q; where the cones start; slopes. */
static const char cones[] = "4 2 0 4 4 4 4\n"
                            "8 1 2 4 1 6 3 5 2 3 9 7 4 5 7 10\n-1 -2 -3 -4\n0 3 4\n2 5\n";

static void read_whole(const char *text, rb_friction_file kind, rb_friction_problem *p)
{
    put(text);
    CHECK_OK(rb_friction_read_as(path, kind, p, &message));
    assert_string_equal(message.text, "");
}

TEST(local_problems_come_from_text)
{
    static const double W[] = {4.0, 1.0, 2.0, 3.0};
    rb_friction_problem p;
    read_whole(full, RB_FRICTION_FILE_ANY, &p);
    assert_int_equal(p.form, RB_FRICTION_LOCAL_DENSE);
    assert_int_equal(p.dimension, 2);
    assert_int_equal(p.contacts, 1);
    for (int k = 0; k < 4; k++)
        CHECK_ABS(p.W[k], W[k], 0.0, "W[%d]", k);
    for (int k = 0; k < 2; k++)
        CHECK_ABS(p.q[k], -5.0 - k, 0.0, "q[%d]", k);
    CHECK_ABS(p.mu[0], 0.5, 0.0, "mu");
    rb_friction_problem_free(&p);
    read_whole(half, RB_FRICTION_FILE_ANY, &p); /* half of it is zero: sparse */
    assert_int_equal(p.form, RB_FRICTION_LOCAL_SPARSE);
    assert_null(p.W);
    assert_int_equal(p.Ws.p[2], 2);
    CHECK_ABS(p.Ws.x[0], 4.0, 0.0, "W_NN");
    CHECK_ABS(p.Ws.x[1], 3.0, 0.0, "W_TT");
    CHECK_ABS(p.q[1], -6.0, 0.0, "q");
    rb_friction_problem_free(&p);
}

TEST(global_problems_come_from_text)
{
    for (int named = 0; named < 2; named++) {
        OWNED(rb_friction_problem) p;
        read_whole(global, named ? RB_FRICTION_FILE_SICONOS_GLOBAL : RB_FRICTION_FILE_ANY, &p);
        assert_int_equal(p.form, RB_FRICTION_GLOBAL);
        assert_int_equal(p.dofs, 3);
        for (int k = 0; k < 3; k++) {
            CHECK_ABS(p.K.x[k], 2.0 + k, 0.0, "K[%d]", k);
            CHECK_ABS(p.f[k], 7.0 + k, 0.0, "f[%d]", k);
        }
        assert_int_equal(p.H.p[1], 2);
        CHECK_ABS(p.H.x[0], 1.0, 0.0, "H(1, 1)");
        CHECK_ABS(p.H.x[1], 5.0, 0.0, "H(3, 1)");
        CHECK_ABS(p.H.x[2], 1.0, 0.0, "H(2, 2)");
        CHECK_ABS(p.w[0], 0.1, 0.0, "w_N");
        CHECK_ABS(p.w[1], 0.2, 0.0, "w_T");
        CHECK_ABS(p.mu[0], 0.3, 0.0, "mu");
    }
}

/* What the head leaves open is told by the length; where neither form has it, the message
 * is that of the local one. */
TEST(a_head_of_both_forms_is_followed_to_the_end)
{
    rb_friction_problem p;
    read_whole(two_ways, RB_FRICTION_FILE_ANY, &p);
    assert_int_equal(p.form, RB_FRICTION_GLOBAL);
    CHECK_ABS(p.K.x[1], 4.0, 0.0, "K(2, 2)");
    CHECK_ABS(p.H.x[1], 5.0, 0.0, "H(2, 2)");
    CHECK_ABS(p.mu[0], 0.3, 0.0, "mu");
    rb_friction_problem_free(&p);
    char text[300], wanted[1200];
    snprintf(text, sizeof text, "%s 99", full);
    put(text);
    CHECK_STATUS(rb_friction_read(path, &p, &message), RB_EFORMAT);
    snprintf(wanted, sizeof wanted,
             "%s:5: after the last number: expected an integer from 0 to 1, got '99'", path);
    assert_string_equal(message.text, wanted);
}

/* A cone ||x_T|| <= x_0 / slope becomes one of slope 1 by x_0 / slope in the place of
 * x_0; a half-line has none. */
TEST(cones_get_the_slope_one)
{
    static const double M[] = {8.0, 1.0, 2.0, 4.0, 1.0, 6.0, 3.0, 5.0,
                               2.0, 3.0, 9.0, 7.0, 4.0, 5.0, 7.0, 10.0};
    OWNED(rb_friction_soclcp_data) d;
    put(cones);
    CHECK_OK(rb_friction_soclcp_read(path, &d, &message));
    assert_int_equal(d.problem.n, 4);
    assert_int_equal(d.problem.cones, 2);
    assert_int_equal(d.problem.size[0], 3);
    assert_int_equal(d.problem.size[1], 1);
    CHECK_ABS(d.tau[0], 2.0, 0.0, "slope");
    CHECK_ABS(d.tau[1], 1.0, 0.0, "of a half-line");
    for (int j = 0; j < 4; j++) {
        CHECK_ABS(d.problem.q[j], (-1.0 - j) / (j ? 1.0 : 2.0), 0.0, "q[%d]", j);
        for (int i = 0; i < 4; i++)
            CHECK_ABS(d.problem.M[i + 4 * j], M[i + 4 * j] / ((i ? 1.0 : 2.0) * (j ? 1.0 : 2.0)),
                      0.0, "M(%d, %d)", i, j);
    }
    rb_friction_soclcp_data_free(NULL);
}

TEST(what_is_no_friction_problem_is_refused)
{
    static const struct {
        const char *text;
        rb_friction_file kind;
        const char *words;
    } all[] = {
        {cones, RB_FRICTION_FILE_SICONOS_SOCLCP, "a problem on cones, not one of friction"},
        {cones, RB_FRICTION_FILE_ANY, "a problem on cones, not one of friction"},
        {"2 0 2 2 2 2 1 3 3 2 5 6", RB_FRICTION_FILE_ANY, "see 'rollbem lcp'"},
        {"2 1 0 2 2 2 2 4 1 2 3 -5 -6 -0.5", RB_FRICTION_FILE_ANY, "mu of contact 1 is -0.5"},
        {"2 1 0 3 3 3 3 2 0 0 1 3 0 0 0 4 0 3 2 3 2 1 0 5 0 1 0 7 8 9 0 0 0.3",
         RB_FRICTION_FILE_ANY, "K is not symmetric"},
        {"2 1 0 2 2 2 2 4 1 2", RB_FRICTION_FILE_SICONOS, ""},
        {full, RB_FRICTION_FILE_FCLIB, ""},
        {"nothing", RB_FRICTION_FILE_ANY, ""}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_friction_problem p;
        put(all[k].text);
        CHECK_STATUS(rb_friction_read_as(path, all[k].kind, &p, &message), RB_EFORMAT);
        if (!strstr(message.text, all[k].words) || !strstr(message.text, path))
            fail_msg("row %zu: %s", k, message.text);
        assert_null(p.mu);
    }
    static const struct {
        const char *text, *words;
    } of_cones[] = {
        {"2 1 0 2 2 2 2 2 1 1 3 -5 -6 0 2 0", "slope of cone 1 is 0, expected > 0"},
        {"2 2 0 2 2 2 2 2 1 1 3 -5 -6 0 1 2 1 -3", "slope of cone 2 is -3, expected > 0"},
        {full, ""}};
    for (size_t k = 0; k < sizeof of_cones / sizeof *of_cones; k++) {
        rb_friction_soclcp_data d;
        put(of_cones[k].text);
        CHECK_SAYS(rb_friction_soclcp_read(path, &d, &message), RB_EFORMAT, of_cones[k].words);
        assert_null(d.M);
    }
}

static void check_vector(const char *name, size_t n, const double *x, const double *want)
{
    assert_int_equal(x != NULL, want != NULL);
    for (size_t k = 0; x && k < n; k++)
        CHECK_ABS(x[k], want[k], 0.0, "%s[%zu]", name, k);
}

/* What FCLib's file has is what was written, the solution with it where there is one. */
TEST(problems_go_into_fclib_and_come_back)
{
    static const char *const texts[] = {full, half, global};
    double r[] = {1.5, 2.5}, u[] = {3.5, 4.5}, v[] = {5.5, 6.5, 7.5};
    for (int k = 0; k < 6; k++) {
        OWNED(rb_friction_problem) p, back;
        OWNED(rb_io_fclib) file;
        const rb_friction_solution at = {r, u, v};
        const int solved = k / 3;
        read_whole(texts[k % 3], RB_FRICTION_FILE_ANY, &p);
        const int is_global = p.form == RB_FRICTION_GLOBAL;
        CHECK_OK(rb_friction_write(path, &p, solved ? &at : NULL, "title", &message));
        CHECK_OK(rb_io_fclib_read(path, &file, &message));
        assert_int_equal(file.global, is_global);
        check_vector("r", 2, file.r, solved ? r : NULL);
        check_vector("u", 2, file.u, solved ? u : NULL);
        check_vector("v", 3, file.v, solved && is_global ? v : NULL);
        CHECK_OK(rb_friction_read(path, &back, &message));
        check_vector("mu", 1, back.mu, p.mu);
        check_vector("q", 2, back.q, p.q);
        check_vector("f", 3, back.f, p.f);
        check_vector("w", 2, back.w, p.w);
        for (int i = 0; p.W && i < 4; i++)
            CHECK_ABS(back.Ws.x[i], p.W[i], 0.0, "W");
        for (int i = 0; p.Ws.p && i < 2; i++)
            CHECK_ABS(back.Ws.x[i], p.Ws.x[i], 0.0, "W");
        for (int i = 0; is_global && i < 3; i++) {
            CHECK_ABS(back.K.x[i], p.K.x[i], 0.0, "K");
            CHECK_ABS(back.H.x[i], p.H.x[i], 0.0, "H");
        }
    }
}

static rb_status read_problem(void *context)
{
    OWNED(rb_friction_problem) p;
    return rb_friction_read_as(path, *(rb_friction_file *)context, &p, &message);
}

static rb_status read_cones(void *context)
{
    OWNED(rb_friction_soclcp_data) d;
    (void)context;
    return rb_friction_soclcp_read(path, &d, &message);
}

TEST(short_memory_is_reported)
{
    static const char *const texts[] = {full, half, global};
    rb_friction_file kind;
    for (int k = 0; k < 6; k++) {
        kind = k < 3    ? RB_FRICTION_FILE_ANY
               : k == 5 ? RB_FRICTION_FILE_SICONOS_GLOBAL
                        : RB_FRICTION_FILE_SICONOS;
        put(texts[k % 3]);
        assert_true(alloc_fail_each(read_problem, &kind) > 3);
    }
    put(cones);
    assert_true(alloc_fail_each(read_cones, NULL) > 3);
}

RUN_TESTS(make_path, remove_path)
