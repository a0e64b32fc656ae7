/* The guard of Lemke's tableau against rounding: errors planted in its constants and in
 * its driving column are seen, and taken out in the cheaper way that will do. */
#include "check.h"
#include "lcp/lemke.h"

#include <string.h>

enum { N = 40, LDM = 43, PIVOTS = 25 };

static double M_[N * LDM], q_[N], cover_[N];
static unsigned long long seed = 11;

static double uniform(void)
{
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(seed >> 11) / 4503599627370496.0 - 1.0;
}

/* z_i for w_i in the first rows, then z0 for the next w: at the point x, 2 N + 1, which
 * is positive where the variable is basic and 0 elsewhere.  The tableau was rebuilt never
 * and refreshed at the last but one pivot, when z0 was what it is. */
typedef struct {
    lemke l;
    rb_lcp_info info;
    double room[6 * N + 1], x[2 * N + 1];
    int tied[N];
} bench;

static void choose_point(bench *b, double z0)
{
    memset(b->x, 0, sizeof b->x);
    for (int i = 0; i < N; i++) {
        const int v = b->l.t.basis[i];
        b->l.t.q[i] = b->x[v] = v == 2 * N ? z0 : 1.5 + uniform();
    }
    for (int i = 0; i < N; i++) {
        q_[i] = b->x[i] - cover_[i] * b->x[2 * N];
        for (int j = 0; j < N; j++)
            q_[i] -= M_[i + j * LDM] * b->x[N + j];
    }
}

static void bench_create(bench *b)
{
    lemke *l = &b->l;
    for (int i = 0; i < N; i++) {
        cover_[i] = 2.0 + uniform();
        for (int j = 0; j < LDM; j++)
            M_[j + i * LDM] = uniform() + (i == j ? N : 0.0);
    }
    *b = (bench){.l = {.n = N, .data = {{N, M_, LDM, q_}, cover_}, .largest = N + 1.0}};
    l->info = &b->info;
    l->a = b->room;
    l->other = l->a + N;
    l->scratch = l->other + N;
    l->r = l->scratch + N;
    l->sum = l->r + N;
    l->weight = l->sum + N;
    l->tied = b->tied;
    CHECK_STATUS(rb_lcp_tableau_create(&l->data, &l->t), RB_OK);
    for (int k = 0; k < PIVOTS; k++) {
        const int column = k == PIVOTS - 1 ? N : k;
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
    double x[2 * N + 1] = {0}, worst = 0.0;
    for (int i = 0; i < N; i++)
        x[l->t.basis[i]] = l->t.q[i];
    for (int i = 0; i < N; i++) {
        double r = q_[i] + cover_[i] * x[2 * N] - x[i];
        for (int j = 0; j < N; j++)
            r += M_[i + j * LDM] * x[N + j];
        worst = fmax(worst, fabs(r));
    }
    return worst;
}

static int some_row(const lemke *l, int is_w)
{
    for (int i = 0; i < N; i++)
        if ((l->t.basis[i] < N) == is_w && l->t.basis[i] != 2 * N)
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
        const double most = rb_norm_inf(N, l->t.q);
        l->t.q[row] += (rebuilt ? 1e-8 : 5e-13) * most;
        const double before = defect(l), kept = l->t.q[row];
        assert_true(before > 1e-13 * most);

        CHECK_STATUS(rb_lcp_lemke_keep_accurate(l), RB_OK);
        CHECK_ABS(l->t.q[row], kept, 0.0, "z0 has not fallen, and few pivots were made");
        l->refreshed = 1001.0 * lemke_z0(l);
        if (k % 4 > 1) { /* many pivots since the last time */
            l->refreshed = lemke_z0(l);
            l->checked = PIVOTS - 50 - N / 4;
        }
        CHECK_STATUS(rb_lcp_lemke_keep_accurate(l), RB_OK);
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
    if (v < N)
        q_[v] += change;
    else
        for (int i = 0; i < N; i++)
            q_[i] -= M_[i + (v - N) * LDM] * change;
}

/* Where the constant is zero on the path the refined one is zero, too, and not what
 * rounding leaves of it, in whichever row; one that is not small is no zero. */
TEST(zeros_stay_zero)
{
    for (int tie = 0; tie < N; tie++) {
        static bench b;
        lemke *l = &b.l;
        bench_create(&b);
        const int wrong = tie == 0 ? 1 : 0;
        const double right = l->t.q[wrong];
        if (l->t.basis[tie] != 2 * N) {
            move_basic(l, tie, 1e-13);
            l->t.q[tie] = l->t.q[wrong] = 0.0;
            l->refreshed = 1001.0 * lemke_z0(l);
            CHECK_STATUS(rb_lcp_lemke_keep_accurate(l), RB_OK);
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
    for (int c = 0; c <= N; c++) {
        const int entering = l->t.nonbasis[c], row = some_row(l, c % 2);
        rb_lcp_tableau_column(&l->t, c, l->a);
        const double right = l->a[row];
        assert_true(rb_lcp_lemke_column_holds(l, entering));
        l->a[row] += 1e-9 * rb_norm_inf(N, l->a);
        assert_false(rb_lcp_lemke_column_holds(l, entering));
        l->rebuilt = PIVOTS; /* just now: better than this it cannot be */
        assert_true(rb_lcp_lemke_column_holds(l, entering));
        l->rebuilt = 0;
        l->a[row] = right;
    }
    const int c = N, row = PIVOTS - 1; /* z0 leaves again */
    rb_lcp_tableau_column(&l->t, c, l->a);
    rb_lcp_tableau_pivot(&l->t, row, c, l->a);
    assert_int_equal(l->t.nonbasis[c], 2 * N);
    rb_lcp_tableau_column(&l->t, c, l->a);
    assert_true(rb_lcp_lemke_column_holds(l, 2 * N));
    l->a[row] += 1e-9 * rb_norm_inf(N, l->a);
    assert_false(rb_lcp_lemke_column_holds(l, 2 * N));
    rb_lcp_tableau_free(&l->t);
}

/* The basic point has the errors of the constants; a solution is solved for anew. */
TEST(only_a_solution_is_polished)
{
    for (int solved = 0; solved < 2; solved++) {
        static bench b;
        lemke *l = &b.l;
        double z[N];
        bench_create(&b);
        choose_point(&b, 0.0);
        for (int i = 0; i < N; i++)
            l->t.q[i] += l->t.basis[i] >= N ? 1e-7 : 0.0;
        rb_lcp_lemke_answer(l, solved, z);
        for (int i = 0; i < N; i++)
            CHECK_ABS(z[i], b.x[N + i] + (i < PIVOTS - 1 && !solved ? 1e-7 : 0.0), 1e-11,
                      "z(%d)", i + 1);
        CHECK_MAX(b.info.res, solved ? 1e-13 : 1e-4, "residual");
        assert_true(solved || b.info.res > 1e-8);
        rb_lcp_tableau_free(&l->t);
    }
}

RUN_TESTS(NULL, NULL)
