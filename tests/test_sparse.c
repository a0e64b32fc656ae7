#include "check.h"
#include "base/base.h"
#include "base/sparse.h"

#include <limits.h>
#include <suitesparse/SuiteSparse_config.h>
#include <sys/resource.h>
#include <unistd.h>

static double next_random(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / (1u << 24) - 0.5;
}

/* rows x cols with about `share` of its entries, and the same matrix dense */
static void random_pair(int rows, int cols, double share, rb_sparse *a, double *dense)
{
    unsigned seed = 17u + (unsigned)(rows * cols);
    memset(dense, 0, (size_t)(rows * cols) * sizeof *dense);
    OWNED(rb_triplets) t = {.rows = rows, .cols = cols};
    for (int k = 0; k < rows * cols; k++) {
        if (next_random(&seed) + 0.5 > share)
            continue;
        const int i = rows - 1 - k % rows, j = k / rows;
        const double x = next_random(&seed);
        rb_triplets_add(&t, i, j, x);
        dense[i + j * rows] += x;
    }
    /* the same places once more, in another order: they add up */
    for (int k = t.nz - 1; k >= 0; k -= 3) {
        rb_triplets_add(&t, t.row[k], t.col[k], 0.25);
        dense[t.row[k] + t.col[k] * rows] += 0.25;
    }
    CHECK_OK(rb_sparse_from_triplets(&t, a));
}

TEST(products_agree_with_the_dense_matrix)
{
    enum { M = 31, N = 17 };
    double dense[M * N], x[N], xt[M], y[M], yt[N], want[M], want_t[N];
    rb_sparse a, t, c;
    random_pair(M, N, 0.3, &a, dense);
    for (int j = 0; j < N; j++)
        x[j] = 0.5 - j;
    for (int i = 0; i < M; i++)
        xt[i] = 1.0 + i, y[i] = i, want[i] = -2.0 * i;
    for (int j = 0; j < N; j++) {
        yt[j] = j, want_t[j] = 0.5 * j;
        for (int i = 0; i < M; i++) {
            want[i] += 3.0 * dense[i + j * M] * x[j];
            want_t[j] += 2.0 * dense[i + j * M] * xt[i];
        }
    }
    rb_sparse_apply(3.0, &a, x, -2.0, y);
    rb_sparse_apply_transposed(2.0, &a, xt, 0.5, yt);
    for (int i = 0; i < M; i++)
        CHECK_ABS(y[i], want[i], 1e-13, "row %d", i);
    for (int j = 0; j < N; j++)
        assert_true(rb_sparse_diagonal(&a, j) == dense[j + j * M]);
    for (int j = 0; j < N; j++)
        CHECK_ABS(yt[j], want_t[j], 1e-12, "column %d", j);

    CHECK_OK(rb_sparse_transpose(&a, &t));
    CHECK_OK(rb_sparse_transpose(&t, &c));
    assert_memory_equal(a.p, c.p, (N + 1) * sizeof *a.p);
    assert_memory_equal(a.i, c.i, (size_t)a.p[N] * sizeof *a.i);
    assert_memory_equal(a.x, c.x, (size_t)a.p[N] * sizeof *a.x);
    for (int j = 0; j < N; j++)
        for (int k = a.p[j] + 1; k < a.p[j + 1]; k++)
            assert_true(a.i[k - 1] < a.i[k]);
    rb_sparse_free(&c);
    rb_sparse_free(&t);

    CHECK_OK(rb_sparse_from_dense(M - 1, N, dense, M, &c));
    memset(y, 0, sizeof y);
    rb_sparse_apply(1.0, &c, x, 0.0, y);
    rb_sparse_apply(1.0, &a, x, 0.0, want);
    for (int i = 0; i < M - 1; i++)
        CHECK_ABS(y[i], want[i], 1e-14, "row %d from dense", i);
    rb_sparse_free(&c);
    rb_sparse_free(&a);
}

TEST(products_of_matrices_agree_with_dense_ones)
{
    enum { M = 23, N = 17, L = 29 };
    double left[M * N], right[N * L], got[M * L] = {0.0};
    rb_sparse a, b, c;
    random_pair(M, N, 0.2, &a, left);
    random_pair(N, L, 0.3, &b, right);
    CHECK_OK(rb_sparse_multiply(&a, &b, &c));
    assert_int_equal(c.rows, M);
    assert_int_equal(c.cols, L);
    for (int j = 0; j < L; j++)
        for (int k = c.p[j]; k < c.p[j + 1]; k++) {
            assert_true(k == c.p[j] || c.i[k] > c.i[k - 1]);
            got[c.i[k] + j * M] = c.x[k];
        }
    for (int j = 0; j < L; j++)
        for (int i = 0; i < M; i++) {
            double want = 0.0;
            for (int k = 0; k < N; k++)
                want += left[i + k * M] * right[k + j * N];
            CHECK_ABS(got[i + j * M], want, 1e-14, "entry %d, %d", i, j);
        }
    rb_sparse_free(&c);
    CHECK_STATUS(rb_sparse_multiply(&b, &a, &c), RB_EINVAL);
    assert_null(c.p);
    for (int fail = 0; fail < 4; fail++) {
        alloc_fail_after(fail);
        CHECK_STATUS(rb_sparse_multiply(&a, &b, &c), RB_ENOMEM);
        alloc_succeed();
    }
    rb_sparse_free(&a);
    rb_sparse_free(&b);
}

TEST(places_outside_are_refused)
{
    int row[] = {0, 2}, col[] = {0, 1}, low[] = {0, -1};
    double x[] = {1.0, 2.0};
    OWNED(rb_sparse) a;
    CHECK_STATUS(
        rb_sparse_from_triplets(
            &(rb_triplets){.rows = 2, .cols = 2, .nz = 2, .row = row, .col = col, .x = x}, &a),
        RB_EINVAL);
    CHECK_STATUS(
        rb_sparse_from_triplets(
            &(rb_triplets){.rows = 3, .cols = 1, .nz = 2, .row = row, .col = col, .x = x}, &a),
        RB_EINVAL);
    CHECK_STATUS(
        rb_sparse_from_triplets(
            &(rb_triplets){.rows = 3, .cols = 3, .nz = 2, .row = row, .col = low, .x = x}, &a),
        RB_EINVAL);
    CHECK_STATUS(rb_sparse_from_triplets(&(rb_triplets){.rows = -1, .cols = 3}, &a), RB_EINVAL);
    CHECK_STATUS(rb_sparse_from_dense(3, 1, x, 2, &a), RB_EINVAL);
    rb_sparse_free(NULL);
}

/* Second differences on n points; free ends when `held` is 0 (null vector: ones). */
static void chain(int n, int held, rb_sparse *k)
{
    OWNED(rb_triplets) t = {.rows = n, .cols = n};
    for (int i = 0; i < n; i++) {
        rb_triplets_add(&t, i, i, (i > 0) + (i < n - 1) + held * (i == 0));
        if (i + 1 < n) {
            rb_triplets_add(&t, i, i + 1, -1.0);
            rb_triplets_add(&t, i + 1, i, -1.0);
        }
    }
    CHECK_OK(rb_sparse_from_triplets(&t, k));
}

TEST(ranks_are_seen)
{
    rb_sparse k;
    int rank;
    chain(60, 1, &k);
    CHECK_OK(rb_sparse_rank(&k, &rank));
    assert_int_equal(rank, 60);
    rb_sparse_free(&k);
    chain(60, 0, &k);
    CHECK_OK(rb_sparse_rank(&k, &rank));
    assert_int_equal(rank, 59);
    rb_sparse_free(&k);
}

TEST(lu_solves_and_names_singular_matrices)
{
    enum { N = 40 };
    double dense[N * N], x[N], b[N], y[N], flops = 0.0;
    OWNED(rb_sparse) a, k;
    rb_sparse_lu *lu;
    random_pair(N, N, 0.2, &a, dense);
    for (int i = 0; i < N; i++)
        x[i] = 1.0 - 0.1 * i;
    CHECK_OK(rb_sparse_lu_create(&a, &lu));
    CHECK_STATUS(rb_sparse_lu_solve(lu, x, y), RB_EINVAL);
    for (int twice = 0; twice < 2; twice++) {
        rb_sparse_apply(1.0, &a, x, 0.0, b);
        CHECK_OK(rb_sparse_lu_factor(lu, &a, &flops));
        CHECK_OK(rb_sparse_lu_solve(lu, b, y));
        for (int i = 0; i < N; i++)
            CHECK_ABS(y[i], x[i], 1e-11, "x[%d]", i);
        rb_sparse_apply_transposed(1.0, &a, x, 0.0, b);
        CHECK_OK(rb_sparse_lu_solve_transposed(lu, b, y));
        for (int i = 0; i < N; i++)
            CHECK_ABS(y[i], x[i], 1e-11, "transposed, x[%d]", i);
        a.x[3] *= 1.5; /* another matrix of the same pattern */
    }
    assert_true(flops > 0.0);
    rb_sparse_lu_free(lu);

    chain(N, 0, &k);
    CHECK_OK(rb_sparse_lu_create(&k, &lu));
    k.x[0] = k.x[1] = 0.0;
    CHECK_STATUS(rb_sparse_lu_factor(lu, &k, NULL), RB_SINGULAR);
    rb_sparse_lu_free(lu);
    rb_sparse_lu_free(NULL);
    k.rows--;
    CHECK_STATUS(rb_sparse_lu_create(&k, &lu), RB_EINVAL);
}

TEST(cholesky_solves_condenses_and_refuses)
{
    enum { N = 30, M = 6 };
    double dense[N * M], b[N], y[N], x[M], got[M], want[M];
    rb_sparse k, h, w;
    rb_sparse_cholesky *f;
    chain(N, 1, &k);
    random_pair(N, M, 0.4, &h, dense);
    CHECK_OK(rb_sparse_cholesky_create(&k, &f));
    CHECK_OK(rb_sparse_cholesky_congruence(f, &h, &w));
    assert_true(rb_sparse_cholesky_flops(f) > 0.0);
    for (int j = 0; j < M; j++)
        x[j] = j - 2.0;
    rb_sparse_apply(1.0, &h, x, 0.0, b);
    CHECK_OK(rb_sparse_cholesky_solve(f, b, y));
    rb_sparse_apply(-1.0, &k, y, 1.0, b);
    CHECK_MAX(rb_norm_inf(N, b), 1e-12, "K y = b");
    rb_sparse_apply_transposed(1.0, &h, y, 0.0, want);
    rb_sparse_apply(1.0, &w, x, 0.0, got);
    for (int j = 0; j < M; j++)
        CHECK_ABS(got[j], want[j], 1e-11, "W x, row %d", j);
    rb_sparse_free(&w);
    rb_sparse_free(&h);
    rb_sparse_free(&k);
    rb_sparse_cholesky_free(f);
    rb_sparse_cholesky_free(NULL);

    chain(N, 0, &k);
    CHECK_STATUS(rb_sparse_cholesky_create(&k, &f), RB_SINGULAR);
    assert_null(f);
    k.rows--;
    CHECK_STATUS(rb_sparse_cholesky_create(&k, &f), RB_EINVAL);
    rb_sparse_free(&k);
}

/* W of unconnected bodies is sparse, and so is what it takes to make it: here 6000^2
 * entries with their places would need 576 MB. */
TEST(a_sparse_congruence_takes_little_memory)
{
#if SANITIZED
    skip(); /* it takes address space of its own */
#elif defined(__linux__)
    enum { N = 6000 };
    struct rlimit before, tight;
    unsigned long pages = 0;
    OWNED(rb_sparse) one, w;
    rb_sparse_cholesky *f;
    OWNED(rb_triplets) t = {.rows = N, .cols = N};
    FILE *statm = NOT_NULL(fopen("/proc/self/statm", "r"));
    assert_int_equal(fscanf(statm, "%lu", &pages), 1);
    fclose(statm);
    for (int i = 0; i < N; i++)
        rb_triplets_add(&t, i, i, 1.0);
    CHECK_OK(rb_sparse_from_triplets(&t, &one));
    CHECK_OK(rb_sparse_cholesky_create(&one, &f));
    getrlimit(RLIMIT_AS, &before);
    tight = before;
    tight.rlim_cur = pages * (rlim_t)sysconf(_SC_PAGESIZE) + (200 << 20);
    setrlimit(RLIMIT_AS, &tight);
    const rb_status s = rb_sparse_cholesky_congruence(f, &one, &w);
    setrlimit(RLIMIT_AS, &before);
    CHECK_OK(s);
    assert_int_equal(w.p[N], N);
    CHECK_ABS(w.x[N - 1], 1.0, 1e-15, "identity");
    rb_sparse_cholesky_free(f);
#endif
}

static rb_status build_and_factor(void)
{
    int row[] = {0, 1, 1}, col[] = {0, 0, 1};
    double v[] = {2.0, 1.0, 3.0}, dense[] = {1.0, 0.0, 0.0, 1.0};
    OWNED(rb_sparse) a = {0}, b = {0}, t = {0}, d = {0}, w = {0};
    rb_sparse_lu *lu = NULL;
    rb_sparse_cholesky *f = NULL;
    rb_status s = rb_sparse_from_triplets(
        &(rb_triplets){.rows = 2, .cols = 2, .nz = 3, .row = row, .col = col, .x = v}, &a);
    if (s == RB_OK)
        s = rb_sparse_copy(&a, &b);
    if (s == RB_OK)
        s = rb_sparse_transpose(&a, &t);
    if (s == RB_OK)
        s = rb_sparse_from_dense(2, 2, dense, 2, &d);
    if (s == RB_OK)
        s = rb_sparse_lu_create(&a, &lu);
    if (s == RB_OK)
        s = rb_sparse_cholesky_create(&d, &f);
    if (s == RB_OK)
        s = rb_sparse_cholesky_congruence(f, &a, &w);
    rb_sparse_cholesky_free(f);
    rb_sparse_lu_free(lu);
    return s;
}

TEST(failing_allocations_are_reported)
{
    int count = 0;
    for (rb_status s = RB_ENOMEM; s != RB_OK; count++) {
        alloc_fail_after(count);
        s = build_and_factor();
        const int refused = alloc_failed();
        alloc_succeed();
        assert_int_equal(s == RB_ENOMEM, refused);
    }
    assert_true(count > 10);
}

static void *no_memory(size_t size)
{
    (void)size;
    return NULL;
}

static void *no_zeroed_memory(size_t n, size_t size)
{
    (void)n;
    (void)size;
    return NULL;
}

static void *no_more_memory(void *p, size_t size)
{
    (void)p;
    (void)size;
    return NULL;
}

/* SuiteSparse asks by itself. */
TEST(suitesparse_without_memory_is_reported)
{
    const double dense[] = {2.0, 1.0, 1.0, 3.0};
    const struct SuiteSparse_config_struct as_it_was = SuiteSparse_config;
    OWNED(rb_sparse) a;
    rb_sparse_lu *lu = NULL, *early = NULL;
    rb_sparse_cholesky *f = NULL, *none = NULL;
    double b[] = {1.0, 2.0}, x[2], flops;
    int rank;
    CHECK_OK(rb_sparse_from_dense(2, 2, dense, 2, &a));
    CHECK_OK(rb_sparse_cholesky_create(&a, &f));
    CHECK_OK(rb_sparse_lu_create(&a, &lu));
    SuiteSparse_config.malloc_func = no_memory;
    SuiteSparse_config.calloc_func = no_zeroed_memory;
    SuiteSparse_config.realloc_func = no_more_memory;
    const rb_status of[] = {rb_sparse_rank(&a, &rank),         rb_sparse_lu_create(&a, &early),
                            rb_sparse_lu_factor(lu, &a, NULL), rb_sparse_cholesky_create(&a, &none),
                            rb_sparse_cholesky_solve(f, b, x), rb_sparse_lu_estimate(&a, &flops)};
    SuiteSparse_config = as_it_was;
    for (size_t k = 0; k < sizeof of / sizeof *of; k++)
        if (of[k] != RB_ENOMEM)
            fail_msg("call %zu: %s", k, rb_status_text(of[k]));
    assert_null(early);
    assert_null(none);
    CHECK_OK(rb_sparse_cholesky_solve(f, b, x));
    CHECK_REL(x[0], 0.2, 1e-15, "x_0");
    CHECK_REL(x[1], 0.6, 1e-15, "x_1");
    rb_sparse_lu_free(lu);
    rb_sparse_cholesky_free(f);
}

/* Each of the numbers that make a matrix, wrong in turn. */
TEST(impossible_sizes_are_refused)
{
    static const struct {
        int rows, cols, row, col;
    } all[] = {{-1, 2, 0, 0}, {2, -1, 0, 0}, {2, 2, -1, 0},
               {2, 2, 2, 0},  {2, 2, 0, -1}, {2, 2, 0, 2}};
    const double one[] = {1.0};
    rb_sparse a;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        int row = all[k].row, col = all[k].col;
        double x = 1.0;
        CHECK_STATUS(rb_sparse_from_triplets(&(rb_triplets){.rows = all[k].rows,
                                                            .cols = all[k].cols,
                                                            .nz = 1,
                                                            .row = &row,
                                                            .col = &col,
                                                            .x = &x},
                                             &a),
                     RB_EINVAL);
        assert_null(a.p);
    }
    CHECK_STATUS(rb_sparse_from_dense(-1, 1, one, 1, &a), RB_EINVAL);
    CHECK_STATUS(rb_sparse_from_dense(1, -1, one, 1, &a), RB_EINVAL);
    CHECK_STATUS(rb_sparse_from_dense(1, 1, one, 0, &a), RB_EINVAL);
    assert_true(a.rows == 0 && a.cols == 0 && !a.p);
    rb_sparse_cholesky *f;
    int none[] = {0};
    CHECK_STATUS(rb_sparse_cholesky_create(&(rb_sparse){.p = none}, &f), RB_EINVAL);
}

/* There is no room: an entry that is missing must not go unseen. */
TEST(triplets_without_room_stay_refused)
{
    OWNED(rb_triplets) t = {.rows = 2, .cols = 2};
    rb_sparse a;
    rb_triplets_add(&t, 0, 0, 1.0);
    CHECK_STATUS(rb_triplets_reserve(&t, (size_t)INT_MAX), RB_ENOMEM);
    assert_int_equal(t.nz, 1);
    CHECK_STATUS(rb_triplets_reserve(&t, 1), RB_ENOMEM);
    for (int k = 0; k < 40; k++)
        rb_triplets_add(&t, 1, 1, 1.0);
    CHECK_STATUS(rb_sparse_from_triplets(&t, &a), RB_ENOMEM);
}

/* As many entries as columns, and yet not diagonal. */
TEST(what_looks_diagonal_is_factored)
{
    const double crossed[] = {0.0, 1.0, 1.0, 0.0}, below[] = {1.0, 1.0, 0.0, 0.0};
    const double negative[] = {2.0, 0.0, 0.0, -1.0}, right[] = {4.0, 0.0, 0.0, 2.0};
    const double *const refused[] = {crossed, below, negative};
    const double b[] = {1.0, 1.0};
    double x[2];
    rb_sparse a;
    rb_sparse_cholesky *f;
    for (int k = 0; k < 3; k++) {
        CHECK_OK(rb_sparse_from_dense(2, 2, refused[k], 2, &a));
        CHECK_STATUS(rb_sparse_cholesky_create(&a, &f), RB_SINGULAR);
        assert_null(f);
        rb_sparse_free(&a);
    }
    CHECK_OK(rb_sparse_from_dense(2, 2, right, 2, &a));
    CHECK_OK(rb_sparse_cholesky_create(&a, &f));
    CHECK_OK(rb_sparse_cholesky_solve(f, b, x));
    CHECK_REL(x[0], 0.25, 1e-15, "x_0");
    CHECK_REL(x[1], 0.5, 1e-15, "x_1");
    CHECK_REL(rb_sparse_cholesky_entries(f), 2.0, 0.0, "entries");
    CHECK_REL(rb_sparse_cholesky_flops(f), 2.0, 0.0, "operations");
    rb_sparse_cholesky_free(f);
    rb_sparse_free(&a);
}

/* Twenty-four decades between the units of two unknowns are no bad condition. */
TEST(units_of_the_unknowns_do_not_matter)
{
    const double k[] = {1e-12, 0.5, 0.5, 1e12}, b[] = {1e-6, 1e6};
    double x[2]; /* times the roots of the diagonal: [1 .5; .5 1] (2/3, 2/3) = (1, 1) */
    OWNED(rb_sparse) a;
    rb_sparse_cholesky *f;
    CHECK_OK(rb_sparse_from_dense(2, 2, k, 2, &a));
    CHECK_OK(rb_sparse_cholesky_create(&a, &f));
    CHECK_OK(rb_sparse_cholesky_solve(f, b, x));
    CHECK_REL(x[0], 2e6 / 3.0, 1e-14, "x_0");
    CHECK_REL(x[1], 2e-6 / 3.0, 1e-14, "x_1");
    rb_sparse_cholesky_free(f);
}

TEST(only_square_matrices_have_components)
{
    const double dense[] = {1.0, 2.0};
    rb_sparse wide, none;
    int count = 7, part[2];
    CHECK_OK(rb_sparse_from_dense(1, 2, dense, 1, &wide));
    CHECK_STATUS(rb_sparse_components(&wide, &count, part), RB_EINVAL);
    assert_int_equal(count, 0);
    CHECK_STATUS(rb_sparse_from_triplets(&(rb_triplets){.status = RB_ENOMEM}, &none), RB_ENOMEM);
    rb_sparse_free(&wide);
}

/* Before there are numbers there is nothing to solve with. */
TEST(a_factor_without_numbers_solves_nothing)
{
    const double dense[] = {2.0, 0.0, 0.0, 4.0}, zero[] = {0.0, 0.0, 0.0, 0.0};
    const double b[] = {2.0, 4.0};
    double x[2];
    OWNED(rb_sparse) a, none;
    rb_sparse_lu *lu;
    CHECK_OK(rb_sparse_from_dense(2, 2, dense, 2, &a));
    CHECK_OK(rb_sparse_lu_create(&a, &lu));
    CHECK_STATUS(rb_sparse_lu_solve(lu, b, x), RB_EINVAL);
    CHECK_STATUS(rb_sparse_lu_solve_once(lu, b, x), RB_EINVAL);
    CHECK_OK(rb_sparse_lu_factor(lu, &a, NULL));
    CHECK_OK(rb_sparse_lu_solve(lu, b, x));
    for (int i = 0; i < 2; i++)
        CHECK_REL(x[i], 1.0, 1e-15, "x[%d]", i);
    for (int k = 0; k < a.p[2]; k++)
        a.x[k] = 0.0;
    CHECK_STATUS(rb_sparse_lu_factor(lu, &a, NULL), RB_SINGULAR);
    rb_sparse_lu_free(lu);
    CHECK_OK(rb_sparse_from_dense(2, 2, zero, 2, &none));
    assert_int_equal(none.p[2], 0);
}

RUN_TESTS(NULL, NULL)
