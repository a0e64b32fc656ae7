/* Block principal pivoting on sparse matrices: against Lemke, on P-matrices where plain
 * Newton steps go round in circles, warm, and on what it cannot solve. */
#include "check.h"

#include "lcp/lcp.h"

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

/* ---- Boxes ------------------------------------------------------------------------- */

/* max |mid(z - low, M z + q, z - high)| over the terms of its row, in long double. */
static double residual_in_box(const rb_lcp_mixed_problem *p, const double *z)
{
    const int n = p->M->cols;
    double worst = 0.0;
    SCRATCH long double *w = calloc(2 * (size_t)n, sizeof *w);
    long double *terms = w + n;
    for (int i = 0; i < n; i++)
        terms[i] = fabsl(w[i] = p->q[i]);
    for (int j = 0; j < n; j++)
        for (int k = p->M->p[j]; k < p->M->p[j + 1]; k++) {
            w[p->M->i[k]] += (long double)p->M->x[k] * z[j];
            terms[p->M->i[k]] += fabsl((long double)p->M->x[k] * z[j]);
        }
    for (int i = 0; i < n; i++) {
        const long double low = p->lower ? p->lower[i] : 0.0,
                          high = p->upper ? p->upper[i] : INFINITY;
        const long double r = fmaxl(fminl(z[i] - low, w[i]), z[i] - high);
        worst = fmax(worst, (double)(fabsl(r) / fmaxl(terms[i], 1e-6L)));
    }
    return worst;
}

/* Finite, open and free ones, and fixed variables. */
static void random_boxes(int n, double *low, double *high)
{
    for (int i = 0; i < n; i++) {
        const int kind = (int)(4.9 * (uniform() + 0.5));
        low[i] = kind < 2 ? 2.0 * uniform() : -INFINITY;
        high[i] = kind == 0 || kind == 2 ? fmax(low[i], -1.0) + fabs(uniform()) : INFINITY;
        if (kind == 4)
            low[i] = high[i] = uniform();
    }
}

TEST(boxes_are_solved_as_by_lemke)
{
    enum { N = 80 };
    static double M[N * N];
    double q[N], z[N], want[N], low[N], high[N];
    for (int k = 0; k < 96; k++) {
        const int n = 3 + k % (N - 2), kind = k % 3;
        OWNED(rb_sparse) a;
        rb_lcp_info info;
        random_problem(n, M, q);
        for (int i = 0; i < n && kind < 2; i++) { /* symmetric, dominant */
            double sum = 0.0;
            for (int j = 0; j < i; j++)
                M[j + i * n] = kind ? M[j + i * n] : M[i + j * n];
            for (int j = 0; j < n; j++)
                sum += fabs(M[i + j * n]);
            M[i + i * n] = sum + 0.1;
        }
        for (int i = 0; i < n && kind == 0; i++)
            for (int j = 0; j < i; j++)
                M[j + i * n] = M[i + j * n];
        random_boxes(n, low, high);
        CHECK_OK(rb_sparse_from_dense(n, n, M, n, &a));
        const rb_lcp_mixed_problem p = {&a, q, low, high};
        CHECK_OK(rb_lcp_mixed(&p, NULL, want, NULL));
        const rb_status s = rb_lcp_solve("newton", &p, NULL, z, &info);
        if (kind < 2)
            CHECK_OK(s);
        CHECK_OK(rb_lcp_solve("auto", &p, NULL, z, &info));
        CHECK_MAX(residual_in_box(&p, z), 1e-9, "problem %d by %s", k, info.solver);
        if (kind < 2)
            assert_string_equal(info.solver, "newton");
        for (int i = 0; i < n; i++)
            CHECK_ABS(z[i], want[i], 1e-8, "problem %d, z(%d)", k, i + 1);
        if (s == RB_OK) { /* a start at the solution needs one system */
            rb_lcp_options opt = rb_lcp_defaults();
            opt.start = want;
            CHECK_OK(rb_lcp_solve("newton", &p, &opt, z, &info));
            CHECK_MAX(info.iters, 1 + (k % 3 == 2), "problem %d, warm", k);
        }
    }
}

/* The diagonal and its neighbours in a cube or a square of n points. */
static rb_status laplacian(int n, int dimensions, rb_sparse *M)
{
    const int all = dimensions == 3 ? n * n * n : n * n;
    rb_triplets t = {.rows = all, .cols = all};
    for (int k = 0; k < all; k++) {
        rb_triplets_add(&t, k, k, 2.0 * dimensions);
        for (int d = 0, step = 1; d < dimensions; d++, step *= n)
            for (int side = -1; side <= 1; side += 2) {
                const int at = k / step % n + side;
                if (at >= 0 && at < n)
                    rb_triplets_add(&t, k, k + side * step, -1.0);
            }
    }
    const rb_status s = rb_sparse_from_triplets(&t, M);
    rb_triplets_free(&t);
    return s;
}

/* Elastic-plastic torsion of a square bar, |u| <= distance from the edge: 3000 pivots, a few
 * systems. */
TEST(torsion_takes_few_systems)
{
    enum { SIDE = 50, ALL = SIDE * SIDE };
    static double q[ALL], low[ALL], high[ALL], z[ALL];
    OWNED(rb_sparse) M;
    rb_lcp_info info;
    CHECK_OK(laplacian(SIDE, 2, &M));
    for (int k = 0; k < ALL; k++) {
        const double h = 1.0 / (SIDE + 1), x = (k % SIDE + 1) * h, y = (k / SIDE + 1) * h;
        high[k] = fmin(fmin(x, 1.0 - x), fmin(y, 1.0 - y));
        low[k] = -high[k];
        q[k] = (x > 0.5 ? 10.0 : -10.0) * h * h;
    }
    const rb_lcp_mixed_problem p = {&M, q, low, high};
    CHECK_OK(rb_lcp_solve(NULL, &p, NULL, z, &info));
    assert_string_equal(info.solver, "newton");
    CHECK_MAX(info.iters, 20, "systems");
    CHECK_MAX(residual_in_box(&p, z), 1e-13, "residual");
}

/* A membrane over an obstacle in a cube of 22^3: conjugate gradients; and the same with one
 * entry changed, so that M is not symmetric, by factors. */
TEST(large_systems_in_space_are_solved_by_gradients)
{
    enum { SIDE = 22, ALL = SIDE * SIDE * SIDE };
    static double q[ALL], z[2][ALL], g[ALL];
    OWNED(rb_sparse) M;
    CHECK_OK(laplacian(SIDE, 3, &M));
    for (int k = 0; k < ALL; k++) {
        double square = 0.0;
        for (int d = 0, step = 1; d < 3; d++, step *= SIDE) {
            const double x = (k / step % SIDE + 1.0) / (SIDE + 1.0) - 0.5;
            square += x * x;
        }
        g[k] = 0.3 - 2.0 * square;
    }
    rb_sparse_apply(1.0, &M, g, 0.0, q);
    const rb_lcp_mixed_problem p = {.M = &M, .q = q};
    for (int skew = 0; skew < 2; skew++) {
        rb_lcp_info info;
        M.x[1] *= skew ? 1.0 + 1e-14 : 1.0;
        CHECK_OK(rb_lcp_newton(&M, q, NULL, z[skew], &info));
        CHECK_MAX(residual_in_box(&p, z[skew]), 1e-11, "residual");
        CHECK_MAX(info.iters, 12, "systems");
    }
    for (int k = 0; k < ALL; k++)
        CHECK_ABS(z[0][k], z[1][k], 1e-11, "z(%d)", k + 1);
}

/* ---- Dominated rows ------------------------------------------------------------------ */

/* Four entries per row, the diagonal larger than they are by a factor: sweeps where it is 0.95
 * or less, other methods beyond. */
TEST(dominated_rows_are_swept)
{
    enum { N = 1000 };
    static double q[N], z[N], want[N], low[N], high[N];
    for (int k = 0; k < 6; k++) {
        const double ratio = k % 2 ? 0.96 : k < 4 ? 0.94 : 0.8;
        OWNED(rb_sparse) M;
        rb_triplets t = {.rows = N, .cols = N};
        rb_lcp_info info;
        for (int i = 0; i < N; i++) {
            double sum = 0.0;
            q[i] = uniform();
            low[i] = k / 2 == 1 ? -0.1 : 0.0;
            high[i] = k / 2 == 1 ? 0.2 : INFINITY;
            for (int e = 1; e <= 3; e++) {
                const double x = uniform();
                sum += fabs(x);
                rb_triplets_add(
                    &t, i, (i * 7 + e * 331) % N == i ? (i + 1) % N : (i * 7 + e * 331) % N, x);
            }
            rb_triplets_add(&t, i, i, sum / ratio);
        }
        CHECK_OK(rb_sparse_from_triplets(&t, &M));
        rb_triplets_free(&t);
        if (k / 2 == 2) /* columns in other units */
            for (int j = 0; j < N; j++)
                for (int e = M.p[j]; e < M.p[j + 1]; e++)
                    M.x[e] *= exp2(j % 41 - 20.0);
        const rb_lcp_mixed_problem p = {&M, q, low, high};
        const int swept = k % 2 == 0;
        CHECK_OK(rb_lcp_solve(NULL, &p, NULL, z, &info));
        assert_int_equal(strcmp(info.solver, "gauss-seidel") == 0, swept);
        if (swept)
            CHECK_MAX(info.iters, 4 + log(2.2e-16) / log(0.94), "sweeps");
        CHECK_OK(rb_lcp_solve("lemke-sparse", &p, NULL, want, NULL));
        for (int i = 0; i < N; i++)
            CHECK_ABS(z[i], want[i], 1e-11 * (1.0 + fabs(want[i])), "problem %d, z(%d)", k, i + 1);
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
