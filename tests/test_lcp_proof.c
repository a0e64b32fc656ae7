/* Proofs of solutions against fractions: what is proved is so, of problems that are regular,
 * degenerate, ill-conditioned, in any units, and of z that are no solutions. */
#include "check.h"

#include "integer_lcp.h"
#include "lcp/lcp.h"

enum { PROBLEMS = 10000, PARTS = 20 };

static rb_status prove_dense(int n, const double *M, const double *q, const double *lower,
                             const double *upper, const double *z, rb_lcp_proof *proof)
{
    OWNED(rb_sparse) sparse = {0};
    CHECK_OK(rb_sparse_from_dense(n, n, M, n, &sparse));
    const rb_lcp_mixed_problem p = {&sparse, q, lower, upper};
    return rb_lcp_prove(&p, z, proof);
}

/* ---- By hand ----------------------------------------------------------------------------- */

TEST(two_unknowns_are_proved)
{
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6}, z[] = {4.0 / 3, 7.0 / 3};
    OWNED(rb_lcp_proof) proof;
    CHECK_OK(prove_dense(2, M, q, NULL, NULL, z, &proof));
    assert_true(proof.proved && proof.isolated && proof.undecided == 0);
    for (int i = 0; i < 2; i++)
        CHECK_MAX(fabs(proof.z[i] - z[i]), proof.error[i], "z_%d", i);
    CHECK_MAX(proof.bound, 1e-14, "bound");
    CHECK_MAX(proof.stored_within, 1e-14, "stored numbers");
    CHECK_MAX(proof.nearby, 4e-16, "data nearby");
}

/* The stored numbers are compared, however wrong they are: the proof is of the solution that the
 * signs lead to. */
TEST(wrong_numbers_are_far_from_what_is_proved)
{
    const double M[] = {2, 1, 1, 2}, q[] = {-5, -6};
    for (int k = 0; k < 3; k++) {
        const double z[][2] = {{1.0, 2.0}, {0.0, 3.0}, {0.0, 0.0}}; /* too small; half; none */
        OWNED(rb_lcp_proof) proof;
        CHECK_OK(prove_dense(2, M, q, NULL, NULL, z[k], &proof));
        CHECK_MAX(fabs(proof.z[1] - 7.0 / 3), proof.error[1], "%d", k);
        CHECK_MAX(0.1, proof.stored_within, "%d", k);
        CHECK_MAX(0.1, proof.nearby, "%d", k);
    }
}

TEST(a_problem_without_a_solution_is_not_proved)
{
    const double M[] = {0, 0, 0, 1}, q[] = {-1, 0}, z[] = {1e9, 0};
    OWNED(rb_lcp_proof) proof;
    CHECK_STATUS(prove_dense(2, M, q, NULL, NULL, z, &proof), RB_UNDECIDED);
    assert_false(proof.proved);
    assert_true(proof.reason[0] != '\0');
}

TEST(bad_numbers_are_refused)
{
    const double good[] = {2, 1, 1, 2}, bad[] = {2, NAN, 1, 2}, q[] = {-5, -6};
    const double z[] = {1, 2}, far[] = {1, INFINITY}, none[] = {NAN, -6};
    rb_lcp_proof proof;
    CHECK_STATUS(prove_dense(2, bad, q, NULL, NULL, z, &proof), RB_EINVAL);
    CHECK_STATUS(prove_dense(2, good, none, NULL, NULL, z, &proof), RB_EINVAL);
    CHECK_STATUS(prove_dense(2, good, q, NULL, NULL, far, &proof), RB_EINVAL);
}

/* z_1 at 1, its upper end, z_2 free, z_3 fixed at 2, z_4 zero: z_2 = -(q_2 + z_1 + 2)/2. */
TEST(boxes_and_free_unknowns_are_proved)
{
    const double M[] = {3, 1, 0, 0, 1, 2, 0, 1, 0, 1, 1, 0, 0, 0, 0, 1};
    const double q[] = {-9, -4, 100, 3}, lower[] = {0, -INFINITY, 2, 0},
                 upper[] = {1, INFINITY, 2, INFINITY}, z[] = {1, 0.5, 2, 0};
    OWNED(rb_lcp_proof) proof;
    CHECK_OK(prove_dense(4, M, q, lower, upper, z, &proof));
    assert_true(proof.isolated);
    CHECK_MAX(fabs(proof.z[1] - 0.5), proof.error[1], "free");
    CHECK_MAX(proof.stored_within, 1e-14, "stored");
}

/* A separated element of Kwak's form (lambda+, lambda-), and one of the pivoted form whose slip is
 * zero by symmetry: which of its two parts is positive is undecided, and all else is proved. */
TEST(exact_zeros_are_found_by_structure)
{
    /* r_N separated (q = 1), gamma+ and lambda- of it: l = 0.5 r_N + 2 gamma + nu + slip */
    const double slip[] = {0.3, -0.3, 0.0};
    for (int k = 0; k < 3; k++) {
        const double M[] = {1, .5, .6, 0, 2, -1, 0, 1, 0}, q[] = {1, slip[k], 0};
        const double z[] = {0, 0, fmax(0.0, -slip[k])};
        OWNED(rb_lcp_proof) proof;
        CHECK_OK(prove_dense(3, M, q, NULL, NULL, z, &proof));
        assert_int_equal(proof.undecided, slip[k] == 0.0);
        CHECK_MAX(fabs(proof.z[2] - z[2]), proof.error[2], "lambda- with slip %g", slip[k]);
    }
    const double K[] = {1, 0, 0, 0, 2, -2, 0, -2, 2};
    for (int k = 0; k < 2; k++) {
        const double q[] = {1, slip[k], -slip[k]};
        const double z[] = {0, fmax(0.0, -slip[k] / 2), fmax(0.0, slip[k] / 2)};
        OWNED(rb_lcp_proof) proof;
        CHECK_OK(prove_dense(3, K, q, NULL, NULL, z, &proof));
        assert_true(proof.isolated);
        for (int i = 0; i < 3; i++)
            CHECK_MAX(fabs(proof.z[i] - z[i]), proof.error[i], "z_%d", i);
    }
}

/* q_1 = -M_12 z_2 exactly: z_1 = w_1 = 0. */
TEST(a_degenerate_pair_is_undecided)
{
    const double M[] = {2, -1, 1, 2}, q[] = {-3, -6}, z[] = {0, 3};
    OWNED(rb_lcp_proof) proof;
    CHECK_OK(prove_dense(2, M, q, NULL, NULL, z, &proof));
    assert_int_equal(proof.undecided, 1);
    assert_int_equal(proof.state[0], RB_LCP_UNDECIDED);
    CHECK_MAX(proof.bound, 1e-14, "bound");
}

static rb_status prove_without_memory(void *context)
{
    const double M[] = {2, -1, 1, 2}, q[] = {-3, -6}, z[] = {0, 3};
    int p[] = {0, 2, 4}, i[] = {0, 1, 0, 1};
    rb_sparse sparse = {2, 2, p, i, (double *)(uintptr_t)M};
    rb_lcp_proof proof;
    const rb_status s = rb_lcp_prove(&(rb_lcp_mixed_problem){&sparse, q, NULL, NULL}, z, &proof);
    rb_lcp_proof_free(&proof);
    return s;
}

TEST(allocations_that_fail_are_said)
{
    assert_true(alloc_fail_each(prove_without_memory, NULL) > 20);
}

/* ---- Against fractions ------------------------------------------------------------------- */

/* Small integers; a positive diagonal; q that make a pair degenerate; parts of Hilbert's matrix;
 * nearly dependent rows; a contact in the pivoted form with symmetric data.  Every second one
 * with rows and columns in units of up to 2^40. */
static void pose(int number, problem *p)
{
    exact_lcp *e = &p->of_integers;
    memset(e, 0, sizeof *e);
    seed_by(4711u, number);
    const int kind = number % 6, scaled = number / 6 % 2;
    const int n = e->n = kind == 5 ? 6 : 1 + below(5);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            e->M[i][j] = below(7) - 3 + (kind == 1 && i == j ? 5 : 0);
        e->q[i] = below(7) - 3;
    }
    if (kind == 2) { /* q = -M z with z of 0 and 1: w is zero wherever z is */
        int z[EXACT_MOST];
        for (int i = 0; i < n; i++) {
            z[i] = below(2);
            e->M[i][i] += 4;
        }
        for (int i = 0; i < n; i++) {
            e->q[i] = below(3) ? 0 : 2 * !z[i];
            for (int j = 0; j < n; j++)
                e->q[i] -= e->M[i][j] * z[j];
        }
    }
    for (int i = 0; i < n && (kind == 3 || kind == 4); i++)
        for (int j = 0; j < n; j++)
            e->M[i][j] = kind == 3         ? 2520 / (i + j + 1)
                         : i == n - 1 && i ? e->M[0][j] * 30000 + (j == n - 1)
                                           : e->M[i][j];
    if (kind == 5) { /* p1 p2 gamma1 gamma2 nu1 nu2, mu = 1: two elements that mirror each other */
        const int a = 3 + below(3), b = below(3), c = below(2), d = below(5) - 2, far = below(2);
        memset(e->M, 0, sizeof e->M);
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                const int own = i == j ? a : b, across = i == j ? 0 : (i ? c : -c);
                e->M[i][j] = own - across;
                e->M[i][2 + j] = across;
                e->M[2 + i][j] = -across - own;
                e->M[2 + i][2 + j] = own;
            }
        for (int i = 0; i < 2; i++) {
            e->M[2 + i][4 + i] = 1;
            e->M[4 + i][i] = 2;
            e->M[4 + i][2 + i] = -1;
            e->q[i] = far && i ? 3 : -below(4);
            e->q[2 + i] = d * (i ? -1 : 1);
            e->q[4 + i] = 0;
        }
    }
    put_into_units(scaled, p);
}

/* 1: an exact solution lies within the bounds; the list is rounded to doubles. */
static int holds(const problem *p, const rb_lcp_proof *proof, const exact_list *all)
{
    for (int k = 0; k < all->count; k++) {
        int within = 1;
        for (int i = 0; i < p->of_integers.n; i++) {
            const double z = all->z[k][i] / p->column[i];
            within &= fabs(z - proof->z[i]) <= proof->error[i] * (1.0 + 1e-12) + 0x1p-53 * z;
        }
        if (within)
            return 1;
    }
    return 0;
}

/* All solutions, of regular bases and others. */
TEST(what_is_proved_has_a_solution)
{
    static exact_list of_bases, all;
    static problem p;
    int proved = 0, tried = 0, solvable = 0, shown = 0, kinds[6] = {0};
    for (int number = 0; number < PROBLEMS; number++) {
        if (!is_in_turn(number / 12, PARTS))
            continue;
        pose(number, &p);
        const int n = p.of_integers.n;
        exact_solutions(&p.of_integers, &of_bases, &all);
        /* from each solution, and from z that are none */
        int regular = 0;
        for (int k = 0; k < of_bases.count + 2; k++) {
            double z[EXACT_MOST];
            for (int i = 0; i < n; i++)
                z[i] = (k < of_bases.count ? of_bases.z[k][i]
                        : below(3)         ? below(9) / 3.0
                                           : 0.0) /
                       p.column[i];
            OWNED(rb_lcp_proof) proof;
            const rb_status s = prove_dense(n, p.M, p.q, NULL, NULL, z, &proof);
            tried++;
            assert_int_equal(s, proof.proved ? RB_OK : RB_UNDECIDED);
            if (!proof.proved)
                continue;
            proved++;
            kinds[number % 6]++;
            regular = 1;
            if (!holds(&p, &proof, &all))
                fail_msg("problem %d, start %d: proved, but no solution lies there", number, k);
            if (k < of_bases.count)
                CHECK_MAX(proof.nearby, 1e-14, "problem %d: z is exact but for rounding", number);
        }
        solvable += of_bases.count > 0;
        shown += regular && of_bases.count > 0;
    }
    for (int k = 0; k < 6; k++)
        assert_true(kinds[k] > 0);
    CHECK_MAX(0.7, (double)shown / solvable, "%d of %d problems proved", shown, solvable);
    if (getenv("ROLLBEM_TEST_ALL")) { /* as docs/proof.md says */
        print_message("%d proofs of %d tries; %d of %d problems\n", proved, tried, shown, solvable);
        CHECK_ABS(proved, 24925, 3, "proofs");
    }
}

/* ---- Numbers of solutions ----------------------------------------------------------------- */

static rb_status count_dense(int n, const double *M, const double *q, int count, const double *z,
                             rb_lcp_number *number)
{
    OWNED(rb_sparse) sparse = {0};
    CHECK_OK(rb_sparse_from_dense(n, n, M, n, &sparse));
    const rb_lcp_mixed_problem p = {&sparse, q, NULL, NULL};
    return rb_lcp_prove_number(&p, NULL, count, z, 0.0, number);
}

/* 1: the points half way between two solutions are solutions: there are infinitely many. */
static int has_segment(const exact_lcp *e, const exact_list *all)
{
    for (int k = 0; k < all->count; k++)
        for (int l = 0; l < k; l++) {
            int is = 1;
            for (int i = 0; i < e->n; i++) {
                double w = e->q[i];
                for (int j = 0; j < e->n; j++)
                    w += e->M[i][j] * 0.5 * (all->z[k][j] + all->z[l][j]);
                is &= w >= -1e-9 && (all->z[k][i] + all->z[l][i] == 0.0 || fabs(w) < 1e-9);
            }
            if (is)
                return 1;
        }
    return 0;
}

/* No solution has a smaller sum than what is proved of all. */
static double check_absence(int number, const problem *p, const exact_list *all)
{
    const int n = p->of_integers.n;
    OWNED(rb_sparse) sparse = {0};
    rb_lcp_proof proof = {0};
    CHECK_OK(rb_sparse_from_dense(n, n, p->M, n, &sparse));
    const rb_lcp_mixed_problem posed = {&sparse, p->q, NULL, NULL};
    CHECK_OK(rb_lcp_prove_absence(&posed, &proof));
    for (int k = 0; k < all->count; k++) {
        double sum = 0.0;
        for (int i = 0; i < n; i++)
            sum += all->z[k][i] / p->column[i];
        CHECK_MAX(proof.least_sum, sum * (1.0 + 1e-12), "problem %d", number);
    }
    return proof.least_sum;
}

/* No number below what is said to exist, none above what is said at most; most problems counted. */
TEST(numbers_of_solutions_are_right)
{
    static exact_list of_bases, all;
    static problem p;
    int counted = 0, tried = 0, none = 0, several = 0, absent = 0;
    for (int number = 0; number < PROBLEMS; number++) {
        if (!is_in_turn(number / 12, PARTS))
            continue;
        pose(number, &p);
        const int n = p.of_integers.n;
        exact_solutions(&p.of_integers, &of_bases, &all);
        double z[20 * EXACT_MOST];
        const int known = all.count < 20 ? all.count : 20;
        for (int k = 0; k < known; k++)
            for (int i = 0; i < n; i++)
                z[k * n + i] = all.z[k][i] / p.column[i];
        rb_lcp_number found;
        CHECK_OK(count_dense(n, p.M, p.q, known, z, &found));
        tried++;
        absent += isinf(check_absence(number, &p, &all));
        if (found.least > all.count)
            fail_msg("problem %d: at least %d of %d", number, found.least, all.count);
        if (found.most >= 0 && (all.count > found.most || has_segment(&p.of_integers, &all)))
            fail_msg("problem %d: at most %d of %d", number, found.most, all.count);
        counted += found.least == found.most;
        none += found.most == 0;
        several += found.least == found.most && found.least > 1;
        rb_lcp_number_free(&found);
    }
    CHECK_MAX(0.5, (double)counted / tried, "%d of %d counted", counted, tried);
    assert_true(none > 0 && several > 0 && absent > 0);
    if (getenv("ROLLBEM_TEST_ALL")) { /* as docs/proof.md says */
        print_message(
            "%d of %d counted, %d of them without solution, %d with several; %d absent by "
            "Farkas' lemma\n",
            counted, tried, none, several, absent);
        CHECK_ABS(counted, 6873, 3, "counted");
        CHECK_ABS(none, 1274, 3, "without a solution");
    }
}

/* Solutions at (0, 0) degenerate: w = 0 and z = 0, and still one in all. */
TEST(a_degenerate_solution_is_counted_once)
{
    const double M[] = {2, -1, 1, 2}, q[] = {-3, -6}, z[] = {0, 3};
    rb_lcp_number found;
    CHECK_OK(count_dense(2, M, q, 1, z, &found));
    assert_int_equal(found.least, 1);
    assert_int_equal(found.most, 1);
    rb_lcp_number_free(&found);
}

/* z_1 + z_2 = 1: a segment of solutions, of which nothing is counted; M z >= 0 has none for q < 0.
 */
TEST(segments_are_left_open_and_absence_is_proved)
{
    const double M[] = {1, 1, 1, 1}, q[] = {-1, -1}, z[] = {1, 0, 0, 1};
    rb_lcp_number found;
    CHECK_OK(count_dense(2, M, q, 2, z, &found));
    assert_int_equal(found.most, -1);
    assert_true(found.least <= 2 && found.open > 0);
    rb_lcp_number_free(&found);
    const double skew[] = {0, -1, 1, 0}, low[] = {-1, -1}, zero[] = {0, 0};
    CHECK_OK(count_dense(2, skew, low, 0, z, &found));
    assert_int_equal(found.most, 0);
    rb_lcp_number_free(&found);
    OWNED(rb_sparse) sparse = {0};
    CHECK_OK(rb_sparse_from_dense(2, 2, skew, 2, &sparse));
    const rb_lcp_mixed_problem p = {&sparse, low, NULL, NULL};
    OWNED(rb_lcp_proof) proof;
    CHECK_STATUS(rb_lcp_prove(&p, zero, &proof), RB_UNDECIDED);
    CHECK_OK(rb_lcp_prove_absence(&p, &proof));
    assert_true(isinf(proof.least_sum));
}

/* [[0, 1], [-1, e]]: z = (0, 1/e), which rounding hides from linear programs. */
TEST(large_solutions_are_not_excluded)
{
    const double e = 0x1p-50, M[] = {0, -1, 1, e}, q[] = {-1, -1};
    OWNED(rb_sparse) sparse = {0};
    CHECK_OK(rb_sparse_from_dense(2, 2, M, 2, &sparse));
    const rb_lcp_mixed_problem p = {&sparse, q, NULL, NULL};
    rb_lcp_proof proof = {0};
    CHECK_OK(rb_lcp_prove_absence(&p, &proof));
    CHECK_MAX(proof.least_sum, 0x1p50, "the sum of the solution");
}

static rb_status count_without_memory(void *context)
{
    const double M[] = {1, 1, 1, 1}, q[] = {-1, -1}, z[] = {1, 0, 0, 1};
    int p[] = {0, 2, 4}, i[] = {0, 1, 0, 1};
    rb_sparse sparse = {2, 2, p, i, (double *)(uintptr_t)M};
    rb_lcp_number number;
    const rb_lcp_mixed_problem posed = {&sparse, q, NULL, NULL};
    const rb_status s = rb_lcp_prove_number(&posed, NULL, 2, z, 0.0, &number);
    if (s == RB_OK)
        rb_lcp_number_free(&number);
    return s;
}

TEST(allocations_of_numbers_that_fail_are_said)
{
    assert_true(alloc_fail_each(count_without_memory, NULL) > 20);
}

RUN_TESTS(NULL, NULL)
