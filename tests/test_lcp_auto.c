/* Solvers of complementarity problems by name: all families of the bench in all scales,
 * what is claimed of them, and what the portfolio does with problems that have no
 * solution. */
#include "check.h"

#include "../tools/bench/lcp_families.h"
#include "lcp/lcp.h"

#define CHECK_TRUE(condition, ...)                                                                 \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            print_error(__VA_ARGS__);                                                              \
            fail();                                                                                \
        }                                                                                          \
    } while (0)

/* The largest |min(z, M z + q)|, in the units before scaling, as a part of its row's
 * terms or of a thousandth of the largest ones. */
static double judge(const lcp_family *f, const double *z, const double *column)
{
    long double *w = calloc((size_t)f->n, sizeof *w), *terms = calloc((size_t)f->n, sizeof *terms),
                most = 0.0L, worst = 0.0L;
    for (int i = 0; i < f->n; i++) {
        w[i] = f->q[i];
        terms[i] = fabs(f->q[i]);
    }
    for (int j = 0; j < f->n; j++)
        for (int k = f->M.p[j]; k < f->M.p[j + 1]; k++) {
            const long double t = (long double)f->M.x[k] * z[j] * column[j];
            w[f->M.i[k]] += t;
            terms[f->M.i[k]] += fabsl(t);
        }
    for (int i = 0; i < f->n; i++)
        most = fmaxl(most, terms[i]);
    for (int i = 0; i < f->n; i++) {
        const long double x = (long double)z[i] * column[i];
        worst = fmaxl(worst, fabsl(fminl(x, w[i])) / fmaxl(terms[i], 1e-3L * most));
    }
    free(w);
    free(terms);
    return (double)worst;
}

TEST(every_claim_is_true)
{
    static const int orders[] = {3, 8, 25, 65, 130, 320};
    static const double scales[] = {0.0, 8.0, 30.0};
    const int largest = getenv("ROLLBEM_TEST_ALL") ? 6 : 5;
    int count;
    const rb_lcp_solver *solvers = rb_lcp_solvers(&count);
    for (int kind = 0; kind < LCP_FAMILIES; kind++)
        for (int o = 0; o < largest; o++)
            for (int e = 0; e < 3; e++) {
                lcp_family f, scaled;
                if (!is_in_turn(kind + o + e, 3))
                    continue;
                assert_int_equal(lcp_family_create(kind, orders[o] + 7, &f), RB_OK);
                assert_int_equal(lcp_family_create(kind, orders[o] + 7, &scaled), RB_OK);
                SCRATCH double *column = malloc((size_t)f.n * sizeof *column);
                SCRATCH double *z = malloc((size_t)f.n * sizeof *z);
                lcp_family_scale(&scaled, scales[e], column);
                for (int s = 0; s < count; s++) {
                    const rb_lcp_mixed_problem p = {.M = &scaled.M, .q = scaled.q};
                    rb_lcp_info info;
                    const rb_status got = rb_lcp_solve(solvers[s].name, &p, NULL, z, &info);
                    if (s == 0)
                        CHECK_TRUE(got == RB_OK, "%s, order %d, 2^%g: %s", lcp_families[kind].name,
                                   f.n, scales[e], info.msg.text);
                    if (got == RB_OK)
                        CHECK_MAX(judge(&f, z, column), 1e-8, "%s by %s, order %d, 2^%g",
                                  lcp_families[kind].name, info.solver, f.n, scales[e]);
                }
                lcp_family_free(&f);
                lcp_family_free(&scaled);
            }
}

/* What the structure says: Newton's method for discretised inequalities and for what it
 * solves at once, Lemke's elsewhere, also where its path with ones is too long. */
TEST(the_solver_is_said)
{
    static const struct {
        int kind, n;
        const char *solver;
    } cases[] = {{0, 40, "lemke"},    {1, 40, "lemke"},         {2, 300, "newton"},
                 {3, 2500, "newton"}, {4, 400, "newton"},       {6, 100, "lemke"},
                 {7, 100, "lemke"},   {11, 30, "lemke-howson"}, {9, 60, "lemke"},
                 {10, 50, "lemke"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        lcp_family f;
        assert_int_equal(lcp_family_create(cases[k].kind, cases[k].n, &f), RB_OK);
        SCRATCH double *z = malloc((size_t)f.n * sizeof *z);
        rb_lcp_info info;
        CHECK_OK(rb_lcp_solve(NULL, &(rb_lcp_mixed_problem){.M = &f.M, .q = f.q}, NULL, z, &info));
        assert_string_equal(info.solver, cases[k].solver);
        lcp_family_free(&f);
    }
}

/* Where the least entry of q ties, the path with ones may be the shortest, or visit 2^n bases: it
 * is followed for a few pivots, and else left. */
TEST(short_paths_are_taken_where_q_ties)
{
    static const struct {
        int kind, n, most;
    } cases[] = {{12, 40, 2}, {12, 150, 2}, {0, 40, 60}, {10, 101, 10}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        lcp_family f;
        assert_int_equal(lcp_family_create(cases[k].kind, cases[k].n, &f), RB_OK);
        SCRATCH double *z = malloc((size_t)f.n * sizeof *z);
        rb_lcp_info info;
        CHECK_OK(rb_lcp_solve(NULL, &(rb_lcp_mixed_problem){.M = &f.M, .q = f.q}, NULL, z, &info));
        CHECK_TRUE(info.iters <= cases[k].most, "%s, order %d: %d pivots",
                   lcp_families[cases[k].kind].name, f.n, info.iters);
        lcp_family_free(&f);
    }
}

/* Zones from coarser problems: their edges are a few points off, not a hundred. */
TEST(coarser_problems_come_first)
{
    static const int kinds[] = {3, 4, 5}; /* obstacle, bearing, option */
    for (int k = 0; k < 3; k++) {
        lcp_family f;
        assert_int_equal(lcp_family_create(kinds[k], 2500, &f), RB_OK);
        SCRATCH double *z = malloc((size_t)f.n * sizeof *z),
                       *ones = malloc((size_t)f.n * sizeof *z);
        SCRATCH double *same = malloc((size_t)f.n * sizeof *z);
        for (int i = 0; i < f.n; i++)
            ones[i] = 1.0;
        rb_lcp_info info, plain;
        rb_lcp_options opt = rb_lcp_defaults();
        CHECK_OK(rb_lcp_newton(&f.M, f.q, NULL, z, &info));
        opt.start = ones; /* no coarser problem */
        CHECK_OK(rb_lcp_newton(&f.M, f.q, &opt, same, &plain));
        CHECK_TRUE(2 * info.iters < plain.iters, "%d systems, %d without coarser problems",
                   info.iters, plain.iters);
        for (int i = 0; i < f.n; i++)
            CHECK_ABS(z[i], same[i], 1e-11 * rb_norm_inf((size_t)f.n, same), "z(%d)", i);
        lcp_family_free(&f);
    }
}

/* w_1 = z_2 - z_1 - 1 and w_2 = -z_2 + z_1 - 1 add up to -2, k times. */
static void without_solution(int k, lcp_family *f)
{
    lcp_begin(f, 2 * k);
    for (int i = 0; i < k; i++) {
        lcp_add(f, 2 * i, 2 * i, -1.0);
        lcp_add(f, 2 * i, 2 * i + 1, 1.0);
        lcp_add(f, 2 * i + 1, 2 * i, 1.0);
        lcp_add(f, 2 * i + 1, 2 * i + 1, -1.0);
        f->q[2 * i] = f->q[2 * i + 1] = -1.0;
    }
    assert_int_equal(rb_sparse_from_triplets(&f->t, &f->M), RB_OK);
}

TEST(no_solution_is_said_by_lemke)
{
    static const int orders[] = {1, 20, 400};
    for (int k = 0; k < 3; k++) {
        lcp_family f;
        rb_lcp_info info;
        without_solution(orders[k], &f);
        SCRATCH double *z = malloc((size_t)f.n * sizeof *z);
        const rb_lcp_mixed_problem p = {.M = &f.M, .q = f.q};
        const rb_status s = rb_lcp_solve("auto", &p, NULL, z, &info);
        assert_true(s == RB_NO_SOLUTION || s == RB_RAY);
        assert_int_equal(strncmp(info.solver, "lemke", 5), 0);
        CHECK_TRUE(info.scaled > 1e-3, "a residual of %g", info.scaled);
        lcp_family_free(&f);
    }
}

/* Without ties in q auto takes Lemke's path for ones; if that is one of the long ones, another. */
TEST(the_path_of_ones_comes_first)
{
    enum { N = 60 };
    static double M[N * N], q[N], z[N];
    unsigned long long seed = 7;
    for (int long_path = 0; long_path < 2; long_path++) {
        rb_lcp_info own, info;
        OWNED(rb_sparse) sparse;
        for (int i = 0; i < N; i++) {
            for (int j = 0; j < N; j++) {
                seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
                M[i + j * N] = !long_path ? (double)(seed >> 40) / (1 << 24)
                               : i == j   ? 1.0
                               : i > j    ? 2.0
                                          : 0.0;
            }
            q[i] = long_path ? -1.0 - 1e-3 * i : M[i] - 0.9;
        }
        CHECK_OK(rb_sparse_from_dense(N, N, M, N, &sparse));
        const rb_lcp_mixed_problem p = {.M = &sparse, .q = q};
        const rb_status alone = rb_lcp_solve("lemke", &p, NULL, z, &own);
        CHECK_OK(rb_lcp_solve("auto", &p, NULL, z, &info));
        if (!long_path) {
            CHECK_OK(alone);
            assert_int_equal(info.iters, own.iters);
            assert_string_equal(info.solver, "lemke");
        } else
            CHECK_TRUE(info.iters < 3000, "%d pivots", info.iters);
    }
}

TEST(options_reach_the_methods)
{
    lcp_family f;
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    assert_int_equal(lcp_family_create(0, 40, &f), RB_OK);
    double z[40], ones[40], upper[40];
    for (int i = 0; i < 40; i++) {
        ones[i] = 1.0;
        upper[i] = 2.0;
    }
    const rb_lcp_mixed_problem p = {.M = &f.M, .q = f.q};
    const rb_lcp_mixed_problem box = {.M = &f.M, .q = f.q, .upper = upper};
    opt.cover = ones; /* Lemke's own path, of 2^40 pivots */
    opt.max_iters = 300;
    CHECK_STATUS(rb_lcp_solve("auto", &p, &opt, z, &info), RB_MAXITER);
    assert_int_equal(info.iters, 300);
    opt.cover = NULL;
    opt.max_iters = 5; /* of each method; then linear programming needs one choice */
    CHECK_OK(rb_lcp_solve("auto", &p, &opt, z, &info));
    assert_string_equal(info.solver, "branching");
    assert_int_equal(info.iters, 16);
    opt.max_iters = 0;
    CHECK_OK(rb_lcp_solve("auto", &box, &opt, z, &info));
    assert_string_equal(info.solver, "lemke-sparse");
    /* Murty's paths are long for single exchanges, too */
    CHECK_STATUS(rb_lcp_solve("newton", &box, &opt, z, &info), RB_MAXITER);
    CHECK_STATUS(rb_lcp_solve("simplex", &p, &opt, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "expected auto, lemke"));
    CHECK_OK(rb_lcp_solve("auto", &p, NULL, z, NULL));
    opt.start = z; /* of the solution: one system confirms it */
    CHECK_OK(rb_lcp_solve("auto", &p, &opt, z, &info));
    assert_string_equal(info.solver, "newton");
    assert_int_equal(info.iters, 1);
    opt.start = NULL;
    opt.seconds = 1e-9;
    CHECK_STATUS(rb_lcp_solve("auto", &p, &opt, z, &info), RB_TIME_LIMIT);
    f.M.x[3] = NAN;
    CHECK_STATUS(rb_lcp_solve("auto", &p, NULL, z, &info), RB_EINVAL);
    lcp_family_free(&f);
}

/* A skew problem of order 14 on which Newton's method meets a submatrix of order 9 that is
 * singular whatever its numbers are: UMFPACK says "different pattern" of it. */
TEST(one_method_that_fails_leaves_the_others)
{
    static const double upper[7][7] = {{0, 1, 1, 0, 2, 0, 0},   {-2, -2, 2, 1, 0, 0, 1},
                                       {-1, 2, -1, 2, 2, 1, 2}, {-2, 1, 1, 2, -2, -2, 0},
                                       {0, 1, 2, 1, 0, 2, 0},   {2, 0, 1, 2, -1, 0, -2},
                                       {2, 1, -2, 1, -2, 1, -1}};
    static const double q[] = {-5, 6, -2, -1, -6, -6, -2, -8, -4, 9, 10, -4, -4, 1};
    double M[14 * 14] = {0}, z[14], w[14];
    rb_lcp_info info;
    OWNED(rb_sparse) sparse;
    for (int i = 0; i < 7; i++)
        for (int j = 0; j < 7; j++) {
            M[i + (7 + j) * 14] = upper[i][j];
            M[7 + j + i * 14] = -upper[i][j];
        }
    CHECK_OK(rb_sparse_from_dense(14, 14, M, 14, &sparse));
    const rb_lcp_mixed_problem p = {.M = &sparse, .q = q};
    CHECK_STATUS(rb_lcp_solve("newton", &p, NULL, z, &info), RB_SINGULAR);
    assert_non_null(strstr(info.msg.text, "is singular"));
    CHECK_OK(rb_lcp_solve("auto", &p, NULL, z, &info));
    CHECK_MAX(rb_lcp_residual_mixed(&p, z, w), 1e-13, "residual");
}

static lcp_family short_of_memory;
static int solved_without;

static rb_status solve_with_little(void *context)
{
    const lcp_family *f = &short_of_memory;
    double *z = context;
    rb_lcp_info info;
    const rb_status s =
        rb_lcp_solve("auto", &(rb_lcp_mixed_problem){.M = &f->M, .q = f->q}, NULL, z, &info);
    solved_without += s == RB_OK && alloc_failed();
    return s;
}

/* One allocation that fails ends one method; the others go on. */
TEST(one_method_without_memory_leaves_the_others)
{
    static double z[100];
    assert_int_equal(lcp_family_create(2, 90, &short_of_memory), RB_OK);
    const int all = alloc_fail_each(solve_with_little, z);
    CHECK_TRUE(2 * solved_without > all, "solved %d of %d times", solved_without, all);
    lcp_family_free(&short_of_memory);
}

/* Every allocation fails once; a long path of which all methods have a turn. */
TEST(short_memory_is_reported)
{
    static const struct {
        int kind, n;
    } cases[] = {{0, 20}, {2, 90}, {3, 400}, {10, 70}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        lcp_family f;
        assert_int_equal(lcp_family_create(cases[k].kind, cases[k].n, &f), RB_OK);
        SCRATCH double *z = malloc((size_t)f.n * sizeof *z);
        const rb_lcp_mixed_problem p = {.M = &f.M, .q = f.q};
        rb_status s = RB_ENOMEM;
        for (int left = 0; s == RB_ENOMEM && left < 2000; left++) {
            rb_lcp_info info;
            alloc_fail_after(left);
            s = rb_lcp_solve("auto", &p, NULL, z, &info);
            alloc_succeed();
            if (s == RB_ENOMEM)
                assert_non_null(strstr(info.msg.text, "memory"));
        }
        CHECK_OK(s);
        lcp_family_free(&f);
    }
}

RUN_TESTS(NULL, NULL)
