/* The interpolative decomposition on matrices of planted rank. */
#include "bem/skeleton.h"
#include "check.h"

#include <string.h>

enum { ROWS = 23, COLUMNS = 14, RANK = 5 };

/* K = sum of RANK products of smooth vectors, to 10^-decades the last. */
static void plant(double decades, double K[ROWS * COLUMNS])
{
    memset(K, 0, sizeof *K * ROWS * COLUMNS);
    for (int r = 0; r < RANK; r++)
        for (int j = 0; j < COLUMNS; j++)
            for (int i = 0; i < ROWS; i++)
                K[i + j * ROWS] += pow(10.0, -decades * r / (RANK - 1)) *
                                   cos(1.0 + r * (1.0 + i)) * sin(2.0 + (r + 1.0) * j);
}

static void decompose(const double *K, int kept, int *rank, int *order, double *T)
{
    rb_skeleton s;
    CHECK_STATUS(rb_skeleton_alloc(ROWS, COLUMNS, &s), RB_OK);
    memcpy(s.K, K, sizeof *K * ROWS * COLUMNS);
    CHECK_STATUS(rb_skeleton_factor(&s, 1e-9), RB_OK);
    *rank = s.rank;
    CHECK_STATUS(rb_skeleton_split(&s, kept < 0 ? *rank : kept, order, T), RB_OK);
    rb_skeleton_free(&s);
}

static double worst_column(const double *K, int kept, const int *order, const double *T)
{
    double worst = 0.0;
    for (int j = kept; j < COLUMNS; j++)
        for (int i = 0; i < ROWS; i++) {
            double sum = 0.0;
            for (int k = 0; k < kept; k++)
                sum += K[i + order[k] * ROWS] * T[k + (j - kept) * kept];
            worst = fmax(worst, fabs(sum - K[i + order[j] * ROWS]));
        }
    return worst;
}

TEST(the_rank_is_found)
{
    double K[ROWS * COLUMNS], T[COLUMNS * COLUMNS];
    int rank, order[COLUMNS], seen[COLUMNS] = {0};

    plant(3.0, K);
    decompose(K, -1, &rank, order, T);
    assert_int_equal(rank, RANK);
    CHECK_MAX(worst_column(K, rank, order, T), 1e-12, "all columns");
    for (int i = 0; i < COLUMNS; i++) {
        seen[order[i]]++;
        assert_true(i == 0 || i == rank || order[i] > order[i - 1]);
    }
    for (int i = 0; i < COLUMNS; i++)
        assert_int_equal(seen[i], 1);
}

/* Below the tolerance nothing counts; more may be kept than needed. */
TEST(what_is_small_is_left_out)
{
    double K[ROWS * COLUMNS], T[COLUMNS * COLUMNS];
    int rank, order[COLUMNS];

    plant(16.0, K);
    decompose(K, -1, &rank, order, T);
    assert_int_equal(rank, 3);
    CHECK_MAX(worst_column(K, rank, order, T), 1e-8, "to the tolerance");
    plant(3.0, K);
    decompose(K, RANK + 2, &rank, order, T);
    CHECK_MAX(worst_column(K, RANK + 2, order, T), 1e-11, "two more");
    memset(K, 0, sizeof K);
    decompose(K, 2, &rank, order, T);
    assert_int_equal(rank, 0);
    for (int i = 0; i < 2 * (COLUMNS - 2); i++)
        CHECK_ABS(T[i], 0.0, 0.0, "of nothing");
}

/* Matrices of many columns are shortened first, where they have as many rows: the rank
 * and the columns are those of any other. */
TEST(wide_matrices_are_shortened)
{
    static const int size[][2] = {{130, 100}, {100, 100}, {90, 100}, {130, 95}};
    for (int k = 0; k < 4; k++) {
        const int rows = size[k][0], columns = size[k][1];
        double *K = rb_alloc((size_t)rows, (size_t)columns),
               *T = rb_alloc((size_t)columns, (size_t)columns);
        int order[100];
        rb_skeleton s;
        assert_true(K && T);
        CHECK_STATUS(rb_skeleton_alloc(rows, columns, &s), RB_OK);
        for (int j = 0; j < columns; j++)
            for (int i = 0; i < rows; i++) {
                for (int r = 0; r < RANK; r++)
                    K[i + j * rows] +=
                        cos(1.0 + r * (1.0 + i)) * sin(2.0 + (r + 1.0) * j);
                s.K[i + (size_t)j * (size_t)s.ld] = K[i + j * rows];
            }
        CHECK_STATUS(rb_skeleton_factor(&s, 1e-9), RB_OK);
        assert_int_equal(s.rank, RANK);
        CHECK_STATUS(rb_skeleton_split(&s, RANK, order, T), RB_OK);
        for (int j = RANK; j < columns; j++)
            for (int i = 0; i < rows; i++) {
                double sum = 0.0;
                for (int r = 0; r < RANK; r++)
                    sum += K[i + order[r] * rows] * T[r + (j - RANK) * RANK];
                CHECK_ABS(sum, K[i + order[j] * rows], 1e-11, "size %d: %d %d", k, i, j);
            }
        rb_skeleton_free(&s);
        free(K);
        free(T);
    }
}

RUN_TESTS(NULL, NULL)
