/* Problems whose rows and columns are scaled by powers of two: the same solution in other
 * units.  Claims are judged in the units of the problem before it was scaled. */
#include "check.h"
#include "lcp/lcp.h"
#include "numbers.h"

enum { LARGEST = 60, KINDS = 5 };

typedef struct {
    int n;
    double M[LARGEST * LARGEST], q[LARGEST], row[LARGEST], col[LARGEST];
    double scaled[LARGEST * LARGEST], scaled_q[LARGEST];
} problem;

static unsigned long long seed = 28;

static double uniform(void)
{
    return uniform_of(&seed);
}

/* Dominant, symmetric with a skew part, sparse, small integers that tie, diagonal; a z
 * and w that solve it are planted.  Scales of 2^-e to 2^e. */
static void make(problem *p, int kind, int n, double e)
{
    double z[LARGEST];
    p->n = n;
    memset(p->M, 0, sizeof p->M);
    for (int i = 0; i < n; i++) {
        double sum = 0.5;
        for (int j = 0; j < n; j++) {
            double x = uniform();
            if (kind == 2 && fabs(uniform()) < 0.9)
                x = 0.0;
            if (kind == 3)
                x = round(x);
            if (kind == 4)
                x = 0.0;
            if (kind == 1 && j < i) {
                const double skew = x;
                p->M[j + i * n] -= skew;
                x = p->M[j + i * n] + 2.0 * skew;
            }
            if (i != j)
                p->M[i + j * n] = x;
            sum += fabs(x);
        }
        p->M[i + i * n] = kind == 1 ? 1.0 + n : sum;
    }
    for (int i = 0; i < n; i++) {
        z[i] = uniform() > 0.0 ? 1.5 + uniform() : 0.0;
        if (kind == 3)
            z[i] = round(z[i]);
        p->row[i] = exp2(round(e * uniform()));
        p->col[i] = exp2(round(e * uniform()));
    }
    for (int i = 0; i < n; i++) {
        p->q[i] = z[i] > 0.0 || (kind == 3 && uniform() > 0.0) ? 0.0 : 1.5 + uniform();
        for (int j = 0; j < n; j++) {
            p->q[i] -= p->M[i + j * n] * z[j];
            p->scaled[i + j * n] = p->row[i] * p->M[i + j * n] * p->col[j];
        }
        p->scaled_q[i] = p->row[i] * p->q[i];
    }
}

/* max |min(z, M z + q)| of the problem before it was scaled: its numbers are near 1. */
static double judge(const problem *p, const double *scaled_z)
{
    long double worst = 0.0L;
    for (int i = 0; i < p->n; i++) {
        long double w = p->q[i];
        for (int j = 0; j < p->n; j++)
            w += (long double)p->M[i + j * p->n] * scaled_z[j] * p->col[j];
        worst = fmaxl(worst, fabsl(fminl((long double)scaled_z[i] * p->col[i], w)));
    }
    return (double)worst;
}

/* By each solver; a claim that is wrong fails.  Returns how many solved it. */
static int solve_scaled(const problem *p, int k)
{
    const int n = p->n;
    const rb_lcp_problem dense = {n, p->scaled, n, p->scaled_q};
    double z[LARGEST];
    OWNED(rb_sparse) M;
    int solved = 0;
    CHECK_OK(rb_sparse_from_dense(n, n, p->scaled, n, &M));
    const rb_lcp_mixed_problem sparse = {.M = &M, .q = p->scaled_q};
    for (int solver = 0; solver < 3; solver++) {
        rb_lcp_info info;
        const rb_status s = solver == 0   ? rb_lcp_lemke(&dense, NULL, z, &info)
                            : solver == 1 ? rb_lcp_newton(&M, p->scaled_q, NULL, z, &info)
                                          : rb_lcp_mixed(&sparse, NULL, z, &info);
        if (s != RB_OK) {
            print_error("problem %d, n = %d, solver %d: %s\n", k, n, solver, info.msg.text);
            continue;
        }
        double scaled;
        solved++;
        CHECK_MAX(judge(p, z), 1e-11 * n, "problem %d, n = %d, solver %d", k, n, solver);
        CHECK_OK(rb_lcp_scaled_residual(&sparse, z, &scaled, NULL));
        CHECK_MAX(scaled, 1e-12, "problem %d, n = %d, solver %d", k, n, solver);
    }
    return solved;
}

TEST(claims_of_scaled_problems_are_right)
{
    static problem p;
    const int problems = 10000;
    int solved = 0;
    for (int k = 0; k < problems; k++) {
        make(&p, k % KINDS, k % 50 == 49 ? LARGEST : 1 + k % 17, 40.0);
        solved += solve_scaled(&p, k);
    }
    print_message("%d problems: %d of %d claims, none wrong\n", problems, solved, 3 * problems);
    assert_int_equal(solved, 3 * problems);
}

/* z = (1, 2, 0) in rows of 1e6, 1e-6, 1; without equilibration (2, 0, 0) was handed out. */
TEST(rows_in_other_units_change_nothing)
{
    const double base[] = {2.0, 1.0, 0.0, 1.0, 3.0, 1.0, 0.0, 1.0, 2.0}, q0[] = {-4, -7, 1};
    const double row[] = {1e6, 1e-6, 1.0};
    double M[9], q[3], z[3];
    rb_lcp_info info;
    for (int i = 0; i < 3; i++) {
        q[i] = row[i] * q0[i];
        for (int j = 0; j < 3; j++)
            M[i + 3 * j] = row[i] * base[i + 3 * j];
    }
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){3, M, 3, q}, NULL, z, &info));
    CHECK_REL(z[0], 1.0, 1e-14, "z(1)");
    CHECK_REL(z[1], 2.0, 1e-14, "z(2)");
    CHECK_ABS(z[2], 0.0, 0.0, "z(3)");
    OWNED(rb_lcp_solutions) all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){3, M, 3, q}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 1);
    CHECK_REL(all.z[0], 1.0, 1e-14, "enumerated z(1)");
    CHECK_REL(all.z[1], 2.0, 1e-14, "enumerated z(2)");
}

/* Powers of two change no digit of the measure, and a wrong small row is seen. */
TEST(the_scaled_residual_has_no_units)
{
    static problem p;
    double z[LARGEST], scaled_z[LARGEST];
    for (int k = 0; k < 100; k++) {
        const int n = 2 + k % 20;
        OWNED(rb_sparse) M, S;
        double plain, scaled;
        int row;
        make(&p, 1, n, 40.0);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, p.M, n, p.q}, NULL, z, NULL));
        z[k % n] += 1e-3;
        for (int i = 0; i < n; i++)
            scaled_z[i] = z[i] / p.col[i];
        CHECK_OK(rb_sparse_from_dense(n, n, p.M, n, &M));
        CHECK_OK(rb_sparse_from_dense(n, n, p.scaled, n, &S));
        CHECK_OK(
            rb_lcp_scaled_residual(&(rb_lcp_mixed_problem){.M = &M, .q = p.q}, z, &plain, NULL));
        CHECK_OK(rb_lcp_scaled_residual(&(rb_lcp_mixed_problem){.M = &S, .q = p.scaled_q}, scaled_z,
                                        &scaled, &row));
        assert_true(plain > 1e-5 && scaled > 1e-5);
        assert_true(scaled < 8.0 * plain && plain < 8.0 * scaled);
        assert_in_range(row, 0, n - 1);
    }
}

typedef struct {
    const problem *p;
    double worst;
    int pivots;
} follower;

/* basic = last column + columns times nonbasic satisfies w = M z + q of the caller, where
 * the nonbasic variables are zero. */
static void follow(const rb_lcp_pivot *pivot, void *context)
{
    follower *f = context;
    const problem *p = f->p;
    const int n = pivot->n;
    double x[2 * LARGEST + 1] = {0}, cover = NAN;
    for (int i = 0; i < n; i++) {
        x[pivot->basis[i]] = pivot->value[i];
        assert_true(pivot->value[i] == pivot->tableau[i + (size_t)(n + 1) * n]);
    }
    f->pivots++;
    for (int i = 0; i < n; i++) {
        double r = p->scaled_q[i] - x[i], size = fabs(p->scaled_q[i]) + fabs(x[i]);
        for (int j = 0; j < n; j++) {
            r += p->scaled[i + j * n] * x[n + j];
            size += fabs(p->scaled[i + j * n] * x[n + j]);
        }
        if (x[2 * n] == 0.0) {
            f->worst = fmax(f->worst, fabs(r) / size);
            continue;
        }
        /* r + d_i z0 = 0: d_i is a power of two, the scale of the row */
        cover = -r / x[2 * n];
        f->worst =
            fmax(f->worst, fabs(log2(cover) - round(log2(cover))) * fabs(cover * x[2 * n]) / size);
    }
}

TEST(the_trace_keeps_the_units_of_the_caller)
{
    static problem p;
    double z[LARGEST];
    for (int k = 0; k < 30; k++) {
        follower f = {.p = &p};
        rb_lcp_options opt = rb_lcp_defaults();
        opt.trace = follow;
        opt.trace_context = &f;
        opt.trace_tableau = 1;
        make(&p, k % 2, 2 + k % 13, 40.0);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){p.n, p.scaled, p.n, p.scaled_q}, &opt, z, NULL));
        CHECK_MAX(f.worst, 1e-12, "problem %d, %d pivots", k, f.pivots);
    }
}

/* In the scale of the first column, 1e-10, a start and a bound overflow: the start is left out,
 * and no solution comes near the bound. */
TEST(numbers_too_large_for_the_scale_are_taken)
{
    const double full[] = {2e20, 0.0, 0.0, 0.0, 2.0, 1.0, 0.0, 1.0, 2.0};
    const double q[] = {-1e10, -1.0, -1.0}, large[] = {1e305, 1e305, 1e305};
    const double want[] = {5e-11, 1.0 / 3.0, 1.0 / 3.0};
    rb_lcp_options opt = rb_lcp_defaults();
    OWNED(rb_sparse) M;
    double z[4][3];
    CHECK_OK(rb_sparse_from_dense(3, 3, full, 3, &M));
    CHECK_OK(
        rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = q, .upper = large}, NULL, z[0], NULL));
    opt.start = large;
    CHECK_OK(rb_lcp_mixed(&(rb_lcp_mixed_problem){.M = &M, .q = q}, &opt, z[1], NULL));
    CHECK_OK(rb_lcp_newton(&M, q, &opt, z[2], NULL));
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){3, full, 3, q}, &opt, z[3], NULL));
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 3; i++)
            CHECK_REL(z[k][i], want[i], 1e-14, "z(%d) of method %d", i + 1, k);
}

static rb_status solve_anew(void *context)
{
    const problem *p = context;
    double z[LARGEST], scaled;
    OWNED(rb_sparse) M = {0};
    rb_status s =
        rb_lcp_lemke(&(rb_lcp_problem){p->n, p->scaled, p->n, p->scaled_q}, NULL, z, NULL);
    if (s == RB_OK)
        s = rb_sparse_from_dense(p->n, p->n, p->scaled, p->n, &M);
    const rb_lcp_mixed_problem sparse = {.M = &M, .q = p->scaled_q};
    if (s == RB_OK)
        s = rb_lcp_newton(&M, p->scaled_q, NULL, z, NULL);
    if (s == RB_OK)
        s = rb_lcp_mixed(&sparse, NULL, z, NULL);
    if (s == RB_OK)
        s = rb_lcp_scaled_residual(&sparse, z, &scaled, NULL);
    return s;
}

TEST(short_memory_is_reported)
{
    static problem p;
    make(&p, 0, 6, 40.0);
    assert_true(alloc_fail_each(solve_anew, &p) > 20);
}

/* A basis within 4e-11 of a singular one has a solution of its own, far from the other one: the
 * bounds of rounding errors do not make them one. */
TEST(far_solutions_of_nearly_singular_bases_are_listed)
{
    const double e = 0x1p-36;
    const double M[] = {2 * e, 1,     -2 + e, -3 + 2 * e, -1 + 2 * e, e,  -1 - 2 * e, 2 - 2 * e,
                        2 - e, 1 + e, -e,     -2 + e,     3 + e,      -2, 2 - e,      -2 * e},
                 q[] = {3, -1, 2, 4}, far[] = {0, 82463372082.48, 82463372083.28, 41231686042.34};
    OWNED(rb_lcp_solutions) all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){4, M, 4, q}, NULL, NULL, 0.0, &all, &message));
    assert_int_equal(all.count, 2);
    assert_int_equal(all.undecided, 0);
    const int at = all.z[1] > 1e9 ? 0 : 1; /* by fractions */
    for (int i = 0; i < 4; i++) {
        CHECK_ABS(all.z[4 * at + i], far[i], 0.01, "z(%d), far", i + 1);
        CHECK_ABS(all.z[4 * (1 - at) + i],
                  i == 1   ? 2.0 - 5 * e
                  : i == 2 ? 1.0 - 3 * e
                           : 0.0,
                  1e-13, "z(%d)", i + 1);
    }
}

RUN_TESTS(NULL, NULL)
