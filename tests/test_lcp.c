/* Lemke's method: ends, ties, planted problems, bad input, failing allocations. */
#include "check.h"
#include "rollbem/lcp.h"

#include <string.h>

static unsigned long long seed = 20240229;

/* Uniform in [-1, 1). */
static double uniform(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 4503599627370496.0 - 1.0;
}

/* max |min(z, M z + q)|, written out independently of the library. */
static double natural_residual(int n, const double *M, int ldm, const double *q,
                               const double *z)
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

static void a_nonnegative_q_needs_no_pivot(void **state)
{
    (void)state;
    const double M[] = {-1.0, 0.0, 0.0, -1.0}, q[] = {0.0, 2.0};
    double z[2] = {9.0, 9.0};
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(2, M, 2, q, NULL, z, &info), RB_OK);
    assert_int_equal(info.iters, 0);
    CHECK_ABS(z[0], 0.0, 0.0, "z");
    CHECK_ABS(z[1], 0.0, 0.0, "z");
    CHECK_ABS(info.res, 0.0, 0.0, "residual");
}

/* Siconos' lcp_deudeu: z = (4/3, 7/3), with ldm > n. */
static void two_by_two(void **state)
{
    (void)state;
    const double M[] = {2.0, 1.0, NAN, 1.0, 2.0, NAN}, q[] = {-5.0, -6.0};
    double z[2];
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(2, M, 3, q, NULL, z, &info), RB_OK);
    CHECK_REL(z[0], 4.0 / 3.0, 1e-15, "z_0");
    CHECK_REL(z[1], 7.0 / 3.0, 1e-15, "z_1");
    CHECK_MAX(natural_residual(2, M, 3, q, z), 1e-15, "residual");
    double w[2];
    CHECK_MAX(rb_lcp_residual(2, M, 3, q, z, w), 1e-15, "residual");
    CHECK_ABS(w[0], 0.0, 1e-15, "w");
    CHECK_STATUS(rb_lcp_lemke(2, M, 3, q, NULL, z, NULL), RB_OK);
}

/* w = -z - 1 has no solution: z enters and nothing stops it. */
static void a_secondary_ray_names_its_variable(void **state)
{
    (void)state;
    const double M[] = {-1.0}, q[] = {-1.0};
    double z[1];
    rb_lcp_info info;
    CHECK_STATUS(rb_lcp_lemke(1, M, 1, q, NULL, z, &info), RB_RAY);
    assert_int_equal(info.ray_variable, 1);
    assert_int_equal(info.iters, 1);
    assert_non_null(strstr(info.msg.text, "z(1)"));
    CHECK_ABS(info.res, 1.0, 0.0, "residual of the last basic point");
}

/* ---- Planted problems ------------------------------------------------------------- */

typedef enum { P_MATRIX, COPOSITIVE_PLUS, NONSYMMETRIC, DEGENERATE, KINDS } kind;
enum { LARGEST = 200 };

static double M_[LARGEST * (LARGEST + 3)], B_[LARGEST * LARGEST], q_[LARGEST],
    z_[LARGEST];

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

static void planted_problems_are_solved(void **state)
{
    (void)state;
    for (int k = 0; k < 1000; k++) {
        const kind which = (kind)(k % KINDS);
        const int n = k % 50 == 49  ? LARGEST
                      : k % 10 == 9 ? 60
                                    : 1 + k % 23,
                  ldm = n + k % 3;
        rb_lcp_info info;
        make_matrix(which, n, ldm, M_);
        plant(n, ldm, M_, which == DEGENERATE, q_);
        const rb_status s = rb_lcp_lemke(n, M_, ldm, q_, NULL, z_, &info);
        if (s != RB_OK)
            print_error("problem %d, kind %d, n = %d: %s\n", k, (int)which, n,
                        info.msg.text);
        CHECK_STATUS(s, RB_OK);
        CHECK_MAX(natural_residual(n, M_, ldm, q_, z_), 1e-12 * size_of(n, q_),
                  "problem %d, kind %d, n = %d, %d pivots", k, (int)which, n, info.iters);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_nonnegative_q_needs_no_pivot),
        cmocka_unit_test(two_by_two),
        cmocka_unit_test(a_secondary_ray_names_its_variable),
        cmocka_unit_test(planted_problems_are_solved),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
