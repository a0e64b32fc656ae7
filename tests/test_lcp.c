/* Lemke's method: ends, ties, planted problems, bad input, failing allocations. */
#include "check.h"
#include "base/io/io.h"
#include "lcp/lcp.h"
#include "numbers.h"

static unsigned long long seed = 20240229;

/* Uniform in [-1, 1). */
static double uniform(void)
{
    return uniform_of(&seed);
}

/* max |min(z, M z + q)|, written out independently of the library. */
static double natural_residual(int n, const double *M, int ldm, const double *q, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < n; i++) {
        double w = q[i];
        for (int j = 0; j < n; j++)
            w += M[i + j * ldm] * z[j];
        const double m = fabs(z[i] < w ? z[i] : w);
        if (!(m <= worst))
            worst = m;
    }
    return worst;
}

static double size_of(int n, const double *q)
{
    double size = 1.0;
    for (int i = 0; i < n; i++)
        size = fmax(size, fabs(q[i]));
    return size;
}

/* ---- Small problems worked by hand ------------------------------------------------ */

TEST(a_nonnegative_q_needs_no_pivot)
{
    const double M[] = {-1.0, 0.0, 0.0, -1.0}, q[] = {0.0, 2.0};
    double z[2] = {9.0, 9.0};
    rb_lcp_info info;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){2, M, 2, q}, NULL, z, &info));
    assert_int_equal(info.iters, 0);
    CHECK_ABS(z[0], 0.0, 0.0, "z");
    CHECK_ABS(z[1], 0.0, 0.0, "z");
    CHECK_ABS(info.res, 0.0, 0.0, "residual");
}

/* Siconos' lcp_deudeu: z = (4/3, 7/3), with ldm > n. */
TEST(two_by_two)
{
    const double M[] = {2.0, 1.0, NAN, 1.0, 2.0, NAN}, q[] = {-5.0, -6.0};
    double z[2];
    rb_lcp_info info;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){2, M, 3, q}, NULL, z, &info));
    CHECK_REL(z[0], 4.0 / 3.0, 1e-15, "z_0");
    CHECK_REL(z[1], 7.0 / 3.0, 1e-15, "z_1");
    CHECK_MAX(natural_residual(2, M, 3, q, z), 1e-15, "residual");
    double w[2];
    CHECK_MAX(rb_lcp_residual(&(rb_lcp_problem){2, M, 3, q}, z, w), 1e-15, "residual");
    CHECK_ABS(w[0], 0.0, 1e-15, "w");
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){2, M, 3, q}, NULL, z, NULL));
}

/* w = -z - 1 has no solution: z enters, nothing stops it, and that proves it. */
TEST(a_secondary_ray_names_its_variable)
{
    const double M[] = {-1.0}, q[] = {-1.0};
    double z[1];
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){1, M, 1, q}, NULL, z, &info), RB_NO_SOLUTION);
    assert_int_equal(info.ray_variable, 1);
    assert_int_equal(info.iters, 1);
    assert_non_null(strstr(info.msg.text, "z(1)"));
    CHECK_ABS(info.res, 1.0, 0.0, "residual of the last basic point");
}

/* w = (2 - z1, z1 - z2 - 1): z = (2, 0) and (2, 1) are solutions, which the ray of z2 does
 * not see. */
TEST(a_ray_that_proves_nothing)
{
    const double M[] = {-1.0, 1.0, 0.0, -1.0}, q[] = {2.0, -1.0};
    double z[2];
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){2, M, 2, q}, NULL, z, &info), RB_RAY);
    assert_int_equal(info.ray_variable, 3);
    assert_non_null(strstr(info.msg.text, "does not prove"));
    z[0] = 2.0;
    for (z[1] = 0.0; z[1] <= 1.0; z[1] += 1.0)
        CHECK_ABS(natural_residual(2, M, 2, q, z), 0.0, 0.0, "a solution");
}

/* ---- Planted problems ------------------------------------------------------------- */

typedef enum { P_MATRIX, COPOSITIVE_PLUS, NONSYMMETRIC, DEGENERATE, KINDS } kind;
enum { LARGEST = 200 };

static double M_[LARGEST * (LARGEST + 3)], B_[LARGEST * LARGEST], q_[LARGEST], z_[LARGEST];

static void gram(int n, int rank, int ldm, double *M)
{
    for (int i = 0; i < n * rank; i++)
        B_[i] = uniform();
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double s = 0.0;
            for (int k = 0; k < rank; k++)
                s += B_[i * rank + k] * B_[j * rank + k];
            M[i + j * ldm] = s / n;
        }
}

static void add_skew(int n, int ldm, double *M)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) {
            const double s = uniform();
            M[i + j * ldm] += s;
            M[j + i * ldm] -= s;
        }
}

static void dominant(int n, int ldm, double *M)
{
    for (int i = 0; i < n; i++) {
        double sum = 0.0;
        for (int j = 0; j < n; j++) {
            M[i + j * ldm] = uniform();
            sum += fabs(M[i + j * ldm]);
        }
        M[i + i * ldm] = 0.5 + sum;
    }
}

/* Positive semidefinite plus nonnegative, positive on the diagonal: copositive, and with
 * the plus property because z'Mz = 0 forces z = 0 (strictly copositive), or
 * rank-deficient and skew, where feasibility guarantees a solution. */
static void make_matrix(kind k, int n, int ldm, double *M)
{
    switch (k) {
    case P_MATRIX:
        gram(n, n, ldm, M);
        for (int i = 0; i < n; i++)
            M[i + i * ldm] += 0.1;
        add_skew(n, ldm, M);
        break;
    case COPOSITIVE_PLUS:
        gram(n, n / 2, ldm, M);
        add_skew(n, ldm, M);
        break;
    case NONSYMMETRIC:
        dominant(n, ldm, M);
        break;
    default:
        gram(n, n, ldm, M);
        for (int i = 0; i < n; i++)
            M[i + i * ldm] += 0.1;
        break;
    }
}

/* q such that a random z solves the problem; degenerate: in a third of the rows z and w
 * both vanish. */
static void plant(int n, int ldm, const double *M, int degenerate, double *q)
{
    double z[LARGEST];
    for (int i = 0; i < n; i++)
        z[i] = uniform() > 0.0 ? 1.0 + uniform() : 0.0;
    for (int i = 0; i < n; i++) {
        q[i] = 0.0;
        if (z[i] == 0.0 && !(degenerate && uniform() < 0.3))
            q[i] = 1.0 + uniform();
        for (int j = 0; j < n; j++)
            q[i] -= M[i + j * ldm] * z[j];
    }
}

TEST(planted_problems_are_solved)
{
    for (int k = 0; k < 1000; k++) {
        const kind which = (kind)(k % KINDS);
        const int n = k % 50 == 49 ? LARGEST : k % 10 == 9 ? 60 : 1 + k % 23, ldm = n + k % 3;
        rb_lcp_info info;
        make_matrix(which, n, ldm, M_);
        plant(n, ldm, M_, which == DEGENERATE, q_);
        const rb_status s = rb_lcp_lemke(&(rb_lcp_problem){n, M_, ldm, q_}, NULL, z_, &info);
        if (s != RB_OK)
            print_error("problem %d, kind %d, n = %d: %s\n", k, (int)which, n, info.msg.text);
        CHECK_OK(s);
        CHECK_MAX(natural_residual(n, M_, ldm, q_, z_), 1e-12 * size_of(n, q_),
                  "problem %d, kind %d, n = %d, %d pivots", k, (int)which, n, info.iters);
        CHECK_ABS(info.res, natural_residual(n, M_, ldm, q_, z_), 1e-13 * size_of(n, q_),
                  "the residual handed back, problem %d", k);
    }
}

/* Against a product written out, at a point that is no solution, across panels. */
TEST(the_residual_is_that_of_z)
{
    const int n = 150, ldm = 151;
    double w[150];
    make_matrix(NONSYMMETRIC, n, ldm, M_);
    for (int i = 0; i < n; i++) {
        q_[i] = uniform();
        z_[i] = uniform();
    }
    const double want = natural_residual(n, M_, ldm, q_, z_);
    CHECK_REL(rb_lcp_residual(&(rb_lcp_problem){n, M_, ldm, q_}, z_, NULL), want, 1e-13,
              "without w");
    CHECK_REL(rb_lcp_residual(&(rb_lcp_problem){n, M_, ldm, q_}, z_, w), want, 1e-13, "with w");
    double last = q_[n - 1];
    for (int j = 0; j < n; j++)
        last += M_[n - 1 + j * ldm] * z_[j];
    CHECK_REL(w[n - 1], last, 1e-12, "last w");
    z_[70] = NAN;
    assert_true(isnan(rb_lcp_residual(&(rb_lcp_problem){n, M_, ldm, q_}, z_, NULL)));
}

/* ---- Ties ------------------------------------------------------------------------- */

typedef struct {
    int count, repeated;
    int basis[64][3];
} bases;

static void keep_basis(const rb_lcp_pivot *pivot, void *context)
{
    bases *b = context;
    if (b->count == 64)
        return;
    for (int k = 0; k < b->count; k++)
        b->repeated += !memcmp(b->basis[k], pivot->basis, sizeof b->basis[k]);
    memcpy(b->basis[b->count++], pivot->basis, sizeof b->basis[0]);
}

/* Kostreva (1979): a P-matrix on which Lemke's method, taking the first of the rows that
 * tie, comes back to the same basis every six pivots. */
TEST(kostreva_cycles_only_without_the_lexicographic_rule)
{
    const double M[] = {1.0, 0.0, 2.0, 2.0, 1.0, 0.0, 0.0, 2.0, 1.0}, q[] = {-1.0, -1.0, -1.0};
    bases b = {0};
    double z[3];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = keep_basis;
    opt.trace_context = &b;
    opt.rule = RB_LCP_FIRST_INDEX;
    opt.max_iters = 44;
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){3, M, 3, q}, &opt, z, &info), RB_MAXITER);
    assert_int_equal(info.iters, 44);
    assert_int_equal(b.count, 44);
    for (int k = 8; k < 44; k++)
        assert_memory_equal(b.basis[k], b.basis[k - 6], sizeof b.basis[k]);

    b = (bases){0};
    opt.rule = RB_LCP_LEXICOGRAPHIC;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){3, M, 3, q}, &opt, z, &info));
    assert_int_equal(b.repeated, 0);
    for (int i = 0; i < 3; i++)
        CHECK_REL(z[i], 1.0 / 3.0, 1e-15, "z_%d", i);
}

/* Everything ties: small integers, q = -1, n up to 12. */
TEST(integer_problems_do_not_cycle)
{
    int solved = 0, rays = 0;
    for (int k = 0; k < 3000; k++) {
        const int n = 2 + k % 11;
        rb_lcp_info info;
        for (int i = 0; i < n * n; i++)
            M_[i] = floor(2 * (k & 1) + 2.5 * uniform());
        for (int i = 0; i < n; i++)
            q_[i] = uniform() > 0.6 ? 0.0 : -1.0;
        const rb_status s = rb_lcp_lemke(&(rb_lcp_problem){n, M_, n, q_}, NULL, z_, &info);
        assert_true(s == RB_OK || s == RB_RAY || s == RB_NO_SOLUTION);
        solved += s == RB_OK;
        rays += s == RB_RAY || s == RB_NO_SOLUTION;
        if (s == RB_OK)
            CHECK_MAX(natural_residual(n, M_, n, q_, z_), 1e-12, "problem %d, n = %d", k, n);
    }
    assert_true(solved > 500 && rays > 500);
}

/* Entries 0, 1, 2, ones on the diagonal: strictly copositive, every path ends in a
 * solution.  z and w are planted, integers with many zeros in both. */
static void make_copositive(int n)
{
    for (int i = 0; i < n * n; i++)
        M_[i] = uniform() > 0.6 ? floor(1.5 * (1.0 + uniform())) : 0.0;
    for (int i = 0; i < n; i++) {
        M_[i + i * n] = 1.0;
        q_[i] = uniform() > 0.3 ? floor(1.5 * (1.0 + uniform())) : 0.0;
    }
    for (int j = 0; j < n; j++) {
        z_[j] = uniform() > 0.3 ? 1.0 + (uniform() > 0.0) : 0.0;
        q_[j] = z_[j] > 0.0 ? 0.0 : q_[j];
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            q_[i] -= M_[i + j * n] * z_[j];
}

/* Hundreds of pivots through ties: here the rounding error of a zero, grown to 2e-12 of
 * its column, was taken for a pivot, in two of the four with OpenBLAS' kernels for
 * AVX-512, in the other two with those for AVX2. */
TEST(rounding_errors_are_no_pivots)
{
    const unsigned long long start[] = {2324, 4536, 1914, 2657}, before = seed;
    const int n = 145;
    for (int k = 0; k < 4; k++) {
        rb_lcp_info info;
        seed = start[k];
        make_copositive(n);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M_, n, q_}, NULL, z_, &info));
        CHECK_MAX(natural_residual(n, M_, n, q_, z_), 1e-12, "problem %d", k);
    }
    seed = before;
}

/* ---- Trace ------------------------------------------------------------------------ */

typedef struct {
    int n, ldm, count;
    const double *M, *q, *cover;
    int pivots[4 * LARGEST][2];
} watched;

/* Values of all variables, from any values of the nonbasic ones, satisfy
 * w = q + M z + cover z0. */
static void check_tableau(const rb_lcp_pivot *pivot, const watched *p)
{
    const int n = p->n;
    double x[2 * LARGEST + 1];
    for (int j = 0; j <= n; j++)
        x[pivot->nonbasis[j]] = uniform();
    for (int i = 0; i < n; i++) {
        double s = pivot->tableau[i + (n + 1) * n];
        for (int j = 0; j <= n; j++)
            s += pivot->tableau[i + j * n] * x[pivot->nonbasis[j]];
        x[pivot->basis[i]] = s;
    }
    for (int i = 0; i < n; i++) {
        double w = p->q[i] + p->cover[i] * x[2 * n];
        for (int j = 0; j < n; j++)
            w += p->M[i + j * p->ldm] * x[n + j];
        CHECK_ABS(x[i], w, 1e-9, "pivot %d, row %d", pivot->pivot, i);
    }
}

enum { ATTEMPT = 3 };

static void watch(const rb_lcp_pivot *pivot, void *context)
{
    watched *p = context;
    assert_int_equal(pivot->pivot, p->count);
    assert_int_equal(pivot->n, p->n);
    assert_int_equal(pivot->basis[pivot->row], pivot->entering);
    assert_true(pivot->ratio >= -1e-12 && pivot->z0 >= 0.0);
    p->pivots[p->count][0] = pivot->entering;
    p->pivots[p->count++][1] = pivot->leaving;
    assert_int_equal(pivot->attempt, ATTEMPT);
    for (int i = 0; i < p->n; i++)
        if (pivot->basis[i] == 2 * p->n)
            CHECK_ABS(pivot->value[i], pivot->z0, 1e-12 * (1.0 + pivot->z0), "z0");
    if (pivot->tableau)
        assert_memory_equal(pivot->value, pivot->tableau + p->n * (p->n + 1),
                            (size_t)p->n * sizeof *pivot->value);
    if (pivot->tableau)
        check_tableau(pivot, p);
}

static watched p_, p_full_;

/* The whole tableau is handed over and right; asking for it, so that every column is
 * brought up to date at every pivot, does not change the pivots. */
TEST(the_trace_sees_every_pivot)
{
    const int n = 180, ldm = 182;
    double cover[180];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    make_matrix(P_MATRIX, n, ldm, M_);
    plant(n, ldm, M_, 0, q_);
    for (int i = 0; i < n; i++)
        cover[i] = 1.5 + uniform();
    p_ = p_full_ = (watched){.n = n, .ldm = ldm, .M = M_, .q = q_, .cover = cover};
    opt.cover = cover;
    opt.trace = watch;
    opt.attempt = ATTEMPT;
    opt.trace_context = &p_;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M_, ldm, q_}, &opt, z_, &info));
    assert_int_equal(info.iters, p_.count);
    assert_true(info.iters > n / 2);
    opt.trace_context = &p_full_;
    opt.trace_tableau = 1;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M_, ldm, q_}, &opt, z_, &info));
    assert_int_equal(p_full_.count, p_.count);
    assert_memory_equal(p_full_.pivots, p_.pivots, sizeof p_.pivots);
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M_, ldm, q_}, NULL, z_, NULL)); /* no info */
}

TEST(the_iteration_limit_keeps_the_last_point)
{
    const int n = 40;
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    make_matrix(P_MATRIX, n, n, M_);
    plant(n, n, M_, 0, q_);
    opt.max_iters = 5;
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){n, M_, n, q_}, &opt, z_, &info), RB_MAXITER);
    assert_int_equal(info.iters, 5);
    assert_int_equal(info.ray_variable, -1);
    for (int i = 0; i < n; i++)
        assert_true(z_[i] >= 0.0);
    CHECK_REL(info.res, natural_residual(n, M_, n, q_, z_), 1e-12, "residual");
}

/* ---- Bad input and short memory ---------------------------------------------------- */

static void check_refused(int n, const double *M, int ldm, const double *q,
                          const rb_lcp_options *opt, const char *words)
{
    double z[2];
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(&(rb_lcp_problem){n, M, ldm, q}, opt, z, &info), RB_EINVAL);
    if (!strstr(info.msg.text, words))
        fail_msg("expected '%s' in: %s", words, info.msg.text);
}

TEST(bad_input_is_refused)
{
    const double M[] = {2.0, 1.0, 1.0, 2.0}, q[] = {-5.0, -6.0};
    const double M_nan[] = {2.0, 1.0, NAN, 2.0}, M_inf[] = {2.0, -INFINITY, 1.0, 2.0};
    const double q_nan[] = {1.0, NAN}, q_inf[] = {INFINITY, 1.0};
    const double zero[] = {1.0, 0.0}, less[] = {-1.0, 1.0}, no[] = {NAN, 1.0};
    rb_lcp_options opt = rb_lcp_defaults();
    check_refused(0, M, 2, q, NULL, "n = 0");
    check_refused(-4, M, 2, q, NULL, "n = -4");
    check_refused(2, M, 1, q, NULL, "ldm = 1");
    check_refused(2, M_nan, 2, q, NULL, "M(1, 2) = nan");
    check_refused(2, M_inf, 2, q, NULL, "M(2, 1) = -inf");
    check_refused(2, M, 2, q_nan, NULL, "q(2) = nan");
    check_refused(2, M, 2, q_inf, NULL, "q(1) = inf");
    opt.cover = zero;
    check_refused(2, M, 2, q, &opt, "cover(2) = 0");
    opt.cover = less;
    check_refused(2, M, 2, q, &opt, "cover(1) = -1");
    opt.cover = no;
    check_refused(2, M, 2, q, &opt, "cover(1) = nan");
    opt = rb_lcp_defaults();
    opt.max_iters = -1;
    check_refused(2, M, 2, q, &opt, "max_iters = -1");
}

/* No cover is needed where q is not negative, and sums that overflow are no infinities. */
TEST(odd_input_is_taken)
{
    const double M[] = {1.5e308, 1.5e308, 1.5e308, 1.5e308}, q[] = {1.0, 2.0}, cover[] = {0.0, 0.0};
    rb_lcp_options opt = rb_lcp_defaults();
    double z[2];
    opt.cover = cover;
    CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){2, M, 2, q}, &opt, z, NULL));
    CHECK_ABS(fmax(z[0], z[1]), 0.0, 0.0, "z");
}

static void ignore(const rb_lcp_pivot *pivot, void *context)
{
    (void)pivot;
    (void)context;
}

static rb_status solve_anew(void *context)
{
    double z[2];
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = ignore;
    opt.trace_tableau = 1;
    return rb_lcp_lemke(context, &opt, z, NULL);
}

TEST(short_memory_is_reported)
{
    const double M[] = {2.0, 1.0, 1.0, 2.0}, q[] = {-5.0, -6.0};
    rb_lcp_options opt = rb_lcp_defaults();
    opt.trace = ignore;
    opt.trace_tableau = 1;
    for (int i = 0, refused = 1; refused; i++) {
        double z[2];
        rb_lcp_info info;
        refused = REFUSED_FROM(i, rb_lcp_lemke(&(rb_lcp_problem){2, M, 2, q}, &opt, z, &info));
        assert_true(refused ? strstr(info.msg.text, "memory") != NULL : i > 5);
    }
    rb_lcp_problem p = {2, M, 2, q};
    assert_true(alloc_fail_each(solve_anew, &p) > 2);
}

/* ---- The public collection --------------------------------------------------------- */

typedef struct {
    const char *file;
    int n, pivots; /* of Siconos 4.4.0, by the collection's README */
} listed;

TEST(the_collection_is_solved)
{
    const listed files[] = {
        {"lcp_deudeu", 2, 2}, {"lcp_deudeu_block", 2, 2}, {"lcp_ortiz", 4, 2},
        {"lcp_mmc", 26, 22},  {"lcp_exp_murty", 6, 1},    {"lcp_CPS_2", 3, 4},
        {"lcp_CPS_4", 4, 4},  {"lcp_CPS_5", 2, 1},        {"lcp_Pang_isolated_sol", 3, 2},
    };
    for (size_t k = 0; k < sizeof files / sizeof files[0]; k++) {
        char name[80];
        OWNED(rb_io_lcp) p;
        rb_lcp_info info;
        double z[32];
        snprintf(name, sizeof name, "siconos/lcp/%s.dat", files[k].file);
        CHECK_OK(rb_io_siconos_read_lcp(outside_data(name), &p, &message));
        CHECK_OK(rb_io_matrix_to_dense(&p.M));
        assert_int_equal(p.n, files[k].n);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){p.n, p.M.dense, p.n, p.q}, NULL, z, &info));
        CHECK_MAX(natural_residual(p.n, p.M.dense, p.n, p.q, z), 1e-13 * size_of(p.n, p.q), "%s",
                  files[k].file);
        assert_int_equal(info.iters, files[k].pivots + 1); /* z0's entry is one */
    }
}

/* The LCP of a 2D friction problem: z = (r_N, r_T + mu r_N, lambda). */
static void friction_matrix(const rb_io_friction *p, double *M, double *q)
{
    const int nc = p->contacts, n = 3 * nc, ldw = 2 * nc;
    const double *W = p->W.dense;
    for (int j = 0; j < nc; j++)
        for (int i = 0; i < nc; i++) {
            const double *Wij = W + 2 * i + 2 * j * ldw, mu = p->mu[j];
            double *Mij = M + i + j * n;
            Mij[0] = Wij[0] - mu * Wij[ldw];
            Mij[nc] = Wij[1] - mu * Wij[ldw + 1];
            Mij[nc * n] = Wij[ldw];
            Mij[nc + nc * n] = Wij[ldw + 1];
        }
    for (int i = 0; i < nc; i++) {
        M[nc + i + (2 * nc + i) * n] = 1.0;
        M[2 * nc + i + i * n] = 2.0 * p->mu[i];
        M[2 * nc + i + (nc + i) * n] = -1.0;
        q[i] = p->q[2 * i];
        q[nc + i] = p->q[2 * i + 1];
    }
}

/* Two of them have contacts without neighbours whose q is about -1e-16.  The first path,
 * with no more pivots than Siconos takes, leaves z = 0 there, which is no solution in the
 * scale of those rows; a second one, with q balanced as well, solves them. */
TEST(plane_friction_problems_are_solved)
{
    const listed files[] = {
        {"FC2D_SliderCrankLagrangian00000", 2, 6}, {"FrictionContactProblem00394", 6, 11},
        {"FrictionContactProblem00031", 11, 21},  /* 16: see below */
        {"FrictionContactProblem00071", 89, 281}, /* 134 */
        {"FrictionContactProblem00727", 367, 678},
    };
    for (size_t k = 0; k < sizeof files / sizeof files[0]; k++) {
        char name[80];
        OWNED(rb_io_friction) p;
        rb_lcp_info info;
        snprintf(name, sizeof name, "siconos/fc2d/%s.dat", files[k].file);
        CHECK_OK(rb_io_siconos_read_friction(outside_data(name), 0, &p, NULL));
        CHECK_OK(rb_io_matrix_to_dense(&p.W));
        const int n = 3 * p.contacts;
        SCRATCH double *M = calloc((size_t)(n * n), sizeof *M), *q = calloc((size_t)n, sizeof *q);
        SCRATCH double *z = calloc((size_t)n, sizeof *z);
        friction_matrix(&p, M, q);
        CHECK_OK(rb_lcp_lemke(&(rb_lcp_problem){n, M, n, q}, NULL, z, &info));
        CHECK_MAX(natural_residual(n, M, n, q, z), 1e-12 * size_of(n, q), "%s", files[k].file);
        assert_true(info.iters <= files[k].pivots + 1);
    }
}

RUN_TESTS(NULL, NULL)
