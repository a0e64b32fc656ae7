/* The delayed-update tableau: after any pivots it is the one solved for from the data. */
#include "check.h"
#include "lcp/tableau.h"

#include <string.h>

/* A multiple of the columns that go through the blocks together. */
enum { N = 64, LDM = 65 };

static double M_[N * LDM], q_[N], cover_[N];
static const lcp_data data_ = {{N, M_, LDM, q_}, cover_};
static unsigned long long seed = 7;

static double uniform(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 4503599627370496.0 - 1.0;
}

static int below(int n)
{
    return (int)(0.5 * (1.0 + uniform()) * n);
}

/* M random with a fifth of its entries zero. */
static void make_tableau(lcp_tableau *t)
{
    for (int k = 0; k < N * LDM; k++)
        M_[k] = uniform() < -0.6 ? 0.0 : uniform();
    for (int i = 0; i < N; i++) {
        q_[i] = uniform();
        cover_[i] = 2.0 + uniform();
    }
    CHECK_STATUS(rb_lcp_tableau_create(&data_, t), RB_OK);
}

/* Pivots of size: anywhere in the column, rows and columns come again and again. */
static void pivot_somewhere(lcp_tableau *t, double *a)
{
    const int c = below(N + 1);
    int r = below(N);
    rb_lcp_tableau_column(t, c, a);
    for (int i = 0; i < 10; i++) {
        const int other = below(N);
        if (fabs(a[other]) > fabs(a[r]))
            r = other;
    }
    if (fabs(a[r]) > 0.1)
        rb_lcp_tableau_pivot(t, r, c, a);
}

static void check_same(lcp_tableau *t, lcp_tableau *anew, int pivots)
{
    double a[N], b[N];
    for (int c = 0; c <= N; c++) {
        rb_lcp_tableau_column(t, c, a);
        rb_lcp_tableau_column(anew, c, b);
        for (int i = 0; i < N; i++)
            CHECK_ABS(a[i], b[i], 1e-9 * (1.0 + fabs(b[i])), "%d pivots, T(%d, %d)",
                      pivots, i, c);
    }
    for (int i = 0; i < N; i++)
        CHECK_ABS(t->q[i], anew->q[i], 1e-9 * (1.0 + fabs(anew->q[i])),
                  "%d pivots, q(%d)", pivots, i);
}

static void take_basis(const lcp_tableau *t, lcp_tableau *anew)
{
    memcpy(anew->basis, t->basis, N * sizeof *t->basis);
    memcpy(anew->nonbasis, t->nonbasis, (N + 1) * sizeof *t->nonbasis);
    memcpy(anew->place, t->place, (2 * N + 1) * sizeof *t->place);
    CHECK_STATUS(rb_lcp_tableau_rebuild(anew), RB_OK);
}

/* Every so often some columns, any and in any order, are brought up to date. */
static void advance_some(lcp_tableau *t)
{
    int columns[N + 1], count = 0;
    const double share = uniform();
    for (int c = 0; c <= N; c++)
        if (uniform() > share)
            columns[count++] = c;
    for (int i = count - 1; i > 0; i--) {
        const int j = below(i + 1), c = columns[i];
        columns[i] = columns[j];
        columns[j] = c;
    }
    rb_lcp_tableau_advance(t, count, columns);
    for (int i = 0; i < count; i++)
        assert_int_equal(rb_lcp_tableau_behind(t, columns[i]), 0);
}

/* Blocks begin and end, memory for pivots runs out, columns stand at different pivots,
 * inside blocks and at their ends. */
TEST(any_pivots_give_the_tableau_of_the_basis)
{
    lcp_tableau t, anew;
    double a[N];
    make_tableau(&t);
    assert_true(t.depth < t.capacity && t.capacity < 150);
    CHECK_STATUS(rb_lcp_tableau_create(&data_, &anew), RB_OK);
    for (int k = 1; k <= 150; k++) {
        pivot_somewhere(&t, a);
        if (k % 9 == 0)
            advance_some(&t);
        if (k % 7)
            continue;
        take_basis(&t, &anew);
        check_same(&t, &anew, k);
    }
    rb_lcp_tableau_free(&t);
    rb_lcp_tableau_free(&anew);
}

TEST(a_combination_is_the_sum_of_its_columns)
{
    lcp_tableau t;
    double a[N], scratch[N], sum[N], want[N], weight[N + 1];
    make_tableau(&t);
    for (int k = 0; k < 100; k++) {
        pivot_somewhere(&t, a);
        if (k % 11 == 0)
            advance_some(&t);
        memset(want, 0, sizeof want);
        for (int c = 0; c <= N; c++) {
            weight[c] = k % 3 && uniform() > 0.0 ? 0.0 : uniform();
            rb_lcp_tableau_column(&t, c, a);
            for (int i = 0; i < N; i++)
                want[i] += weight[c] * a[i];
        }
        rb_lcp_tableau_combine(&t, weight, scratch, sum);
        const double zero = 1e-11 * (1.0 + rb_norm_inf(N, want));
        for (int i = 0; i < N; i++)
            CHECK_ABS(sum[i], want[i], zero, "%d pivots, row %d", k + 1, i);
    }
    rb_lcp_tableau_free(&t);
}

/* Lemke's method asks next for the complement of what leaves, and the rows with the least
 * ratios leave first: their columns are brought up to date with the one that is wanted,
 * as many as go through the blocks together. */
TEST(the_next_columns_are_looked_for_by_their_ratios)
{
    lcp_tableau t;
    double a[N], driving[N];
    int row[N], rows = 0;
    make_tableau(&t);
    for (int k = 0; k < 30; k++) { /* w_k leaves, first for z0, then for z_k */
        rb_lcp_tableau_column(&t, k ? k : N, a);
        if (a[k] != 0.0)
            rb_lcp_tableau_pivot(&t, k, k ? k : N, a);
    }
    for (int i = 0; i < N; i++) { /* ratios 1, 2, ... in an order of their own */
        const int place = 37 * i % N;
        t.q[i] = i % 11 == 10 ? -1.0 : 1.0 + place;
        driving[i] = i % 4 == 0 ? 1.0 : i % 4 == 1 ? -2.0 : -1.0;
    }
    for (int i = 0; i < N; i++)
        if (driving[i] < 0.0 && t.basis[i] != 2 * N)
            row[rows++] = i;
    for (int i = 1; i < rows; i++) /* by ratios; those of negative constants are zero */
        for (int j = i; j > 0 && fmax(t.q[row[j]], 0.0) / -driving[row[j]] <
                                     fmax(t.q[row[j - 1]], 0.0) / -driving[row[j - 1]];
             j--) {
            const int swap = row[j];
            row[j] = row[j - 1];
            row[j - 1] = swap;
        }
    const int wanted = 40;
    int expected[N + 1] = {0}, count = 1;
    expected[wanted] = 1;
    for (int i = 0; i < rows && count < t.group; i++) {
        const int place = t.place[rb_lcp_complement(N, t.basis[row[i]])];
        if (place < 0 && !expected[-1 - place]) {
            expected[-1 - place] = 1;
            count++;
        }
    }
    assert_true(t.group < rows);
    int behind[N + 1];
    for (int c = 0; c <= N; c++)
        behind[c] = rb_lcp_tableau_behind(&t, c);
    rb_lcp_tableau_fetch(&t, wanted, driving);
    for (int c = 0; c <= N; c++)
        assert_int_equal(rb_lcp_tableau_behind(&t, c), expected[c] ? 0 : behind[c]);
    rb_lcp_tableau_free(&t);
}

TEST(without_pivots_nothing_changes)
{
    lcp_tableau t;
    double a[N];
    make_tableau(&t);
    rb_lcp_tableau_flush(&t);
    CHECK_STATUS(rb_lcp_tableau_rebuild(&t), RB_OK);
    for (int c = 0; c < N; c++) {
        rb_lcp_tableau_column(&t, c, a);
        for (int i = 0; i < N; i++)
            CHECK_ABS(a[i], M_[i + c * LDM], 0.0, "M(%d, %d)", i, c);
    }
    rb_lcp_tableau_free(&t);
}

TEST(short_memory_leaves_the_tableau)
{
    lcp_tableau t;
    double a[N];
    make_tableau(&t);
    for (int k = 0; k < 20; k++)
        pivot_somewhere(&t, a);
    for (int i = 0;; i++) {
        alloc_fail_after(i);
        const rb_status s = rb_lcp_tableau_rebuild(&t);
        const int refused = alloc_failed();
        alloc_succeed();
        if (!refused) {
            CHECK_STATUS(s, RB_OK);
            assert_true(i > 2);
            break;
        }
        CHECK_STATUS(s, RB_ENOMEM);
    }
    rb_lcp_tableau_free(&t);
}

/* A column of zeros: of two equal ones rounding may leave a pivot. */
TEST(a_singular_basis_is_told)
{
    lcp_tableau t;
    make_tableau(&t);
    memset(M_ + LDM, 0, N * sizeof *M_);
    for (int k = 0; k < 2; k++) { /* z_0, z_1 for w_0, w_1 */
        t.basis[k] = N + k;
        t.place[N + k] = k;
        t.nonbasis[k] = k;
        t.place[k] = -1 - k;
    }
    CHECK_STATUS(rb_lcp_tableau_rebuild(&t), RB_SINGULAR);
    rb_lcp_tableau_free(&t);
}

RUN_TESTS(NULL, NULL)
