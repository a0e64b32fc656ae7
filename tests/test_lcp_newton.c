/* Block principal pivoting on sparse matrices: against Lemke, on P-matrices where plain
 * Newton steps go round in circles, warm, and on what it cannot solve. */
#include "check.h"

#include "rollbem/lcp.h"

static unsigned long long state_of_random = 20;

static double uniform(void)
{
    state_of_random = state_of_random * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state_of_random >> 11) / 9007199254740992.0 - 0.5;
}

/* max |min(z, M z + q)|, from the dense matrix. */
static double natural_residual(int n, const double *M, const double *q, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        double w = q[i];
        for (int j = 0; j < n; j++)
            w += M[i + j * n] * z[j];
        worst = fmax(worst, fabs(fmin(z[i], w)));
    }
    return worst;
}

/* Positive definite, not symmetric, half of it zeros: a positive diagonal and a skew
 * part. */
static void random_problem(int n, double *M, double *q)
{
    memset(M, 0, (size_t)(n * n) * sizeof *M);
    for (int i = 0; i < n; i++) {
        q[i] = 4.0 * uniform();
        M[i + i * n] = 1.0 + fabs(uniform());
        for (int j = 0; j < i; j++) {
            const double skew = uniform() > 0.0 ? 2.0 * uniform() : 0.0;
            M[i + j * n] = skew;
            M[j + i * n] = -skew;
        }
    }
}

TEST(p_matrices_are_solved_as_by_lemke)
{
    enum { N = 40 };
    double M[N * N], q[N], z[N], want[N];
    for (int k = 0; k < 300; k++) {
        const int n = 1 + k % N;
        OWNED(rb_sparse) a;
        rb_lcp_info info;
        random_problem(n, M, q);
        CHECK_OK(rb_sparse_from_dense(n, n, M, n, &a));
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M, n, q}, NULL, want, NULL));
        CHECK_OK(rb_lcp_newton(&a, q, NULL, z, &info));
        CHECK_MAX(natural_residual(n, M, q, z), 1e-12 * (1.0 + rb_norm_inf((size_t)n, z)),
                  "problem %d", k);
        for (int i = 0; i < n; i++)
            CHECK_ABS(z[i], want[i], 1e-9 * (1.0 + rb_norm_inf((size_t)n, want)),
                      "problem %d, z(%d)", k, i + 1);
        rb_lcp_options warm = rb_lcp_defaults();
        memcpy(want, z, sizeof want);
        warm.start = want;
        CHECK_OK(rb_lcp_newton(&a, q, &warm, z, &info));
        assert_int_equal(info.iters, 1);
    }
}

/* M = [1 0 2; 2 1 0; 0 2 1], a P-matrix, q = -(1, 1, 1): exchanging every negative
 * component changes between two sets for ever. */
TEST(cycling_newton_steps_end_by_single_ones)
{
    const double M[] = {1.0, 2.0, 0.0, 0.0, 1.0, 2.0, 2.0, 0.0, 1.0};
    const double q[] = {-1.0, -1.0, -1.0}, start[] = {1.0, 0.0, 0.0};
    OWNED(rb_sparse) a;
    rb_lcp_info info;
    double z[3];
    rb_lcp_options opt = rb_lcp_defaults();
    opt.start = start;
    CHECK_OK(rb_sparse_from_dense(3, 3, M, 3, &a));
    CHECK_OK(rb_lcp_newton(&a, q, &opt, z, &info));
    CHECK_MAX(natural_residual(3, M, q, z), 1e-15, "residual");
    opt.max_iters = 1;
    CHECK_STATUS(rb_lcp_newton(&a, q, &opt, z, &info), RB_MAXITER);
}

TEST(what_it_cannot_solve_is_said)
{
    const double M[] = {0.0, 1.0, 1.0, 0.0}, q[] = {-1.0, 1.0};
    const double bad[] = {NAN, 1.0};
    OWNED(rb_sparse) a;
    rb_lcp_info info;
    double z[2];
    CHECK_OK(rb_sparse_from_dense(2, 2, M, 2, &a));
    CHECK_STATUS(rb_lcp_newton(&a, q, NULL, z, &info), RB_SINGULAR);
    assert_non_null(strstr(info.msg.text, "order 1 is singular"));
    CHECK_STATUS(rb_lcp_newton(&a, bad, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "q(1) = nan"));
    a.x[0] = INFINITY;
    CHECK_STATUS(rb_lcp_newton(&a, q, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "M(2, 1) = inf"));
}

/* z_2 = -0.1 would be rounding beside z_1 = 1e16, but not in w_1 = -1 + 1e-16 z_1 + z_2:
 * in the scale of the columns both are near 1. */
TEST(columns_of_any_scale_are_solved)
{
    const double M[] = {1e-16, 0.0, 1.0, 1.0}, q[] = {-1.0, 0.1}, both[] = {1.0, 1.0};
    rb_lcp_options opt = rb_lcp_defaults();
    OWNED(rb_sparse) a;
    rb_lcp_info info;
    double z[2];
    CHECK_OK(rb_sparse_from_dense(2, 2, M, 2, &a));
    opt.start = both;
    CHECK_OK(rb_lcp_newton(&a, q, &opt, z, &info));
    CHECK_REL(z[0], 1e16, 1e-15, "z(1)");
    CHECK_ABS(z[1], 0.0, 0.0, "z(2)");
}

/* z_2 = -0.1 is rounding beside z_1 = 1e16 and becomes zero, which leaves w_3 = z_2 + z_3
 * - 1 = 0.1 where z_3 = 1.1: that is seen, and solved in a scale that balances q too. */
TEST(a_large_row_hides_no_small_one)
{
    const double M[] = {1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0};
    const double q[] = {-1e16, 0.1, -1.0}, all[] = {1.0, 1.0, 1.0};
    rb_lcp_options opt = rb_lcp_defaults();
    OWNED(rb_sparse) a;
    rb_lcp_info info;
    double z[3];
    CHECK_OK(rb_sparse_from_dense(3, 3, M, 3, &a));
    opt.start = all;
    CHECK_OK(rb_lcp_newton(&a, q, &opt, z, &info));
    CHECK_ABS(z[1], 0.0, 0.0, "z(2)");
    CHECK_REL(z[2], 1.0, 1e-15, "z(3)");
    CHECK_MAX(info.scaled, 1e-15, "residual");
    const double wrong[] = {1e16, 0.0, 1.1};
    double scaled;
    int row;
    CHECK_OK(
        rb_lcp_scaled_residual(&(rb_lcp_mixed_problem){.M = &a, .q = q}, wrong, &scaled, &row));
    CHECK_REL(scaled, 0.1 / 2.1, 1e-9, "residual of row 3 as a part of its terms");
    assert_int_equal(row, 2);
}

static rb_status solve_anew(void *context)
{
    const double q[] = {-5.0, -6.0};
    double z[2];
    return rb_lcp_newton(context, q, NULL, z, NULL);
}

TEST(short_memory_is_reported)
{
    const double M[] = {2.0, 1.0, 1.0, 2.0}, q[] = {-5.0, -6.0};
    OWNED(rb_sparse) a;
    CHECK_OK(rb_sparse_from_dense(2, 2, M, 2, &a));
    for (int i = 0, refused = 1; refused; i++) {
        double z[2];
        refused = REFUSED_FROM(i, rb_lcp_newton(&a, q, NULL, z, NULL));
    }
    assert_true(alloc_fail_each(solve_anew, &a) > 2);
}

RUN_TESTS(NULL, NULL)
