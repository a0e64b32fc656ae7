/* What src/lcp keeps to itself.  The delayed-update tableau: after any pivots it is the
 * one solved for from the data.  The guard of Lemke's method against rounding: errors
 * planted in the tableau's constants and in its driving column are seen, and taken out in
 * the cheaper way that will do. */
#include "check.h"
#include "lcp/lemke/lemke.h"
#include "numbers.h"

/* A multiple of the columns that go through the blocks together. */
enum { N = 64, LDM = 65 };

static double M_[N * LDM], q_[N], cover_[N];
static const lcp_data data_ = {{N, M_, LDM, q_}, cover_};
static unsigned long long seed = 7;

static double uniform(void)
{
    return uniform_of(&seed);
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
    CHECK_OK(rb_lcp_tableau_create(&data_, t));
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
            CHECK_ABS(a[i], b[i], 1e-9 * (1.0 + fabs(b[i])), "%d pivots, T(%d, %d)", pivots, i, c);
    }
    for (int i = 0; i < N; i++)
        CHECK_ABS(t->q[i], anew->q[i], 1e-9 * (1.0 + fabs(anew->q[i])), "%d pivots, q(%d)", pivots,
                  i);
}

static void take_basis(const lcp_tableau *t, lcp_tableau *anew)
{
    memcpy(anew->basis, t->basis, N * sizeof *t->basis);
    memcpy(anew->nonbasis, t->nonbasis, (N + 1) * sizeof *t->nonbasis);
    memcpy(anew->place, t->place, (2 * N + 1) * sizeof *t->place);
    CHECK_OK(rb_lcp_tableau_rebuild(anew));
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
    CHECK_OK(rb_lcp_tableau_create(&data_, &anew));
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
    CHECK_OK(rb_lcp_tableau_rebuild(&t));
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
    for (int i = 0, refused = 1; refused; i++) {
        refused = REFUSED_FROM(i, rb_lcp_tableau_rebuild(&t));
        assert_true(refused || i > 2);
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

/* ---- The guard --------------------------------------------------------------------- */

enum { ROWS = 40, PIVOTS = 25 };

/* z_i for w_i in the first rows, then z0 for the next w: at the point x, 2 ROWS + 1,
 * which is positive where the variable is basic and 0 elsewhere.  The tableau was rebuilt
 * never and refreshed at the last but one pivot, when z0 was what it is. */
typedef struct {
    lemke l;
    rb_lcp_info info;
    double room[6 * ROWS + 1], x[2 * ROWS + 1];
    int tied[ROWS];
} bench;

static void choose_point(bench *b, double z0)
{
    memset(b->x, 0, sizeof b->x);
    for (int i = 0; i < ROWS; i++) {
        const int v = b->l.t.basis[i];
        b->l.t.q[i] = b->x[v] = v == 2 * ROWS ? z0 : 1.5 + uniform();
    }
    for (int i = 0; i < ROWS; i++) {
        q_[i] = b->x[i] - cover_[i] * b->x[2 * ROWS];
        for (int j = 0; j < ROWS; j++)
            q_[i] -= M_[i + j * LDM] * b->x[ROWS + j];
    }
}

static void bench_create(bench *b)
{
    lemke *l = &b->l;
    for (int i = 0; i < ROWS; i++) {
        cover_[i] = 2.0 + uniform();
        for (int j = 0; j < LDM; j++)
            M_[j + i * LDM] = uniform() + (i == j ? ROWS : 0.0);
    }
    *b = (bench){
        .l = {.n = ROWS, .data = {{ROWS, M_, LDM, q_}, cover_}, .posed.largest = ROWS + 1.0}};
    l->info = &b->info;
    l->a = b->room;
    l->other = l->a + ROWS;
    l->scratch = l->other + ROWS;
    l->r = l->scratch + ROWS;
    l->sum = l->r + ROWS;
    l->weight = l->sum + ROWS;
    l->tied = b->tied;
    CHECK_OK(rb_lcp_tableau_create(&l->data, &l->t));
    for (int k = 0; k < PIVOTS; k++) {
        const int column = k == PIVOTS - 1 ? ROWS : k;
        rb_lcp_tableau_column(&l->t, column, l->a);
        rb_lcp_tableau_pivot(&l->t, k, column, l->a);
    }
    choose_point(b, 0.5);
    b->info.iters = PIVOTS;
    l->checked = PIVOTS - 1;
    l->refreshed = lemke_z0(l);
}

/* max |q + M z + cover z0 - w| at the constants, written out. */
static double defect(const lemke *l)
{
    double x[2 * ROWS + 1] = {0}, worst = 0.0;
    for (int i = 0; i < ROWS; i++)
        x[l->t.basis[i]] = l->t.q[i];
    for (int i = 0; i < ROWS; i++) {
        double r = q_[i] + cover_[i] * x[2 * ROWS] - x[i];
        for (int j = 0; j < ROWS; j++)
            r += M_[i + j * LDM] * x[ROWS + j];
        worst = fmax(worst, fabs(r));
    }
    return worst;
}

static int some_row(const lemke *l, int is_w)
{
    for (int i = 0; i < ROWS; i++)
        if ((l->t.basis[i] < ROWS) == is_w && l->t.basis[i] != 2 * ROWS)
            return i;
    return -1;
}

/* Whether the errors are in the rows of w or in those of z. */
TEST(small_errors_are_refined_and_large_ones_rebuilt)
{
    for (int k = 0; k < 8; k++) {
        static bench b;
        lemke *l = &b.l;
        bench_create(&b);
        const int rebuilt = k >= 4, row = some_row(l, k % 2);
        const double most = rb_norm_inf(ROWS, l->t.q);
        l->t.q[row] += (rebuilt ? 1e-8 : 5e-13) * most;
        const double before = defect(l), kept = l->t.q[row];
        assert_true(before > 1e-13 * most);

        CHECK_OK(rb_lcp_lemke_keep_accurate(l));
        CHECK_ABS(l->t.q[row], kept, 0.0, "z0 has not fallen, and few pivots were made");
        l->refreshed = 1001.0 * lemke_z0(l);
        if (k % 4 > 1) { /* many pivots since the last time */
            l->refreshed = lemke_z0(l);
            l->checked = PIVOTS - 50 - ROWS / 4;
        }
        CHECK_OK(rb_lcp_lemke_keep_accurate(l));
        CHECK_MAX(defect(l), rebuilt ? 1e-13 * most : 0.05 * before, "case %d", k);
        assert_int_equal(l->rebuilt, rebuilt ? PIVOTS : 0);
        assert_int_equal(l->checked, PIVOTS);
        CHECK_ABS(l->refreshed, lemke_z0(l), 0.0, "z0 at the refresh");
        rb_lcp_tableau_free(&l->t);
    }
}

/* Moves the basic variable of a row, and q with it so that the point stays one of the
 * problem. */
static void move_basic(const lemke *l, int row, double to)
{
    const int v = l->t.basis[row];
    const double change = to - l->t.q[row];
    if (v < ROWS)
        q_[v] += change;
    else
        for (int i = 0; i < ROWS; i++)
            q_[i] -= M_[i + (v - ROWS) * LDM] * change;
}

/* Where the constant is zero on the path the refined one is zero, too, and not what
 * rounding leaves of it, in whichever row; one that is not small is no zero. */
TEST(zeros_stay_zero)
{
    for (int tie = 0; tie < ROWS; tie++) {
        static bench b;
        lemke *l = &b.l;
        bench_create(&b);
        const int wrong = tie == 0 ? 1 : 0;
        const double right = l->t.q[wrong];
        if (l->t.basis[tie] != 2 * ROWS) {
            move_basic(l, tie, 1e-13);
            l->t.q[tie] = l->t.q[wrong] = 0.0;
            l->refreshed = 1001.0 * lemke_z0(l);
            CHECK_OK(rb_lcp_lemke_keep_accurate(l));
            CHECK_ABS(l->t.q[tie], 0.0, 0.0, "a zero, row %d", tie);
            CHECK_REL(l->t.q[wrong], right, 1e-9, "no zero, row %d", wrong);
        }
        rb_lcp_tableau_free(&l->t);
    }
}

/* For entering variables of all kinds: w, z, and z0 where it is not basic. */
TEST(a_wrong_column_does_not_hold)
{
    static bench b;
    lemke *l = &b.l;
    bench_create(&b);
    for (int c = 0; c <= ROWS; c++) {
        const int entering = l->t.nonbasis[c], row = some_row(l, c % 2);
        rb_lcp_tableau_column(&l->t, c, l->a);
        const double right = l->a[row];
        assert_true(rb_lcp_lemke_column_holds(l, entering));
        l->a[row] += 1e-9 * rb_norm_inf(ROWS, l->a);
        assert_false(rb_lcp_lemke_column_holds(l, entering));
        l->rebuilt = PIVOTS; /* just now: better than this it cannot be */
        assert_true(rb_lcp_lemke_column_holds(l, entering));
        l->rebuilt = 0;
        l->a[row] = right;
    }
    const int c = ROWS, row = PIVOTS - 1; /* z0 leaves again */
    rb_lcp_tableau_column(&l->t, c, l->a);
    rb_lcp_tableau_pivot(&l->t, row, c, l->a);
    assert_int_equal(l->t.nonbasis[c], 2 * ROWS);
    rb_lcp_tableau_column(&l->t, c, l->a);
    assert_true(rb_lcp_lemke_column_holds(l, 2 * ROWS));
    l->a[row] += 1e-9 * rb_norm_inf(ROWS, l->a);
    assert_false(rb_lcp_lemke_column_holds(l, 2 * ROWS));
    rb_lcp_tableau_free(&l->t);
}

/* The basic point has the errors of the constants; a solution is solved for anew. */
TEST(only_a_solution_is_polished)
{
    for (int solved = 0; solved < 2; solved++) {
        static bench b;
        lemke *l = &b.l;
        double z[ROWS];
        bench_create(&b);
        choose_point(&b, 0.0);
        for (int i = 0; i < ROWS; i++)
            l->t.q[i] += l->t.basis[i] >= ROWS ? 1e-7 : 0.0;
        rb_lcp_lemke_answer(l, solved, z);
        for (int i = 0; i < ROWS; i++)
            CHECK_ABS(z[i], b.x[ROWS + i] + (i < PIVOTS - 1 && !solved ? 1e-7 : 0.0), 1e-11,
                      "z(%d)", i + 1);
        CHECK_MAX(b.info.res, solved ? 1e-13 : 1e-4, "residual");
        assert_true(solved || b.info.res > 1e-8);
        rb_lcp_tableau_free(&l->t);
    }
}

RUN_TESTS(NULL, NULL)
