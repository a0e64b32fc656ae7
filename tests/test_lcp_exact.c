/* Random problems of small integers against their solutions without rounding: what is listed,
 * what is found, and "no solution".  10 000 problems; a twentieth of them in every run. */
#include "check.h"

#include "integer_lcp.h"
#include "lcp/lcp.h"

enum { PROBLEMS = 10000, PARTS = 20 };

/* Entries of -3 ... 3, of -1 ... 1, with a positive diagonal, skew, or of low rank; rows and
 * columns in units of up to 2^40. */
static void pose(int number, problem *p)
{
    exact_lcp *e = &p->of_integers;
    seed_by(77u, number);
    const int kind = number % 5, scaled = number / 5 % 2, few = kind == 1;
    const int n = e->n = 1 + below(6), most = few ? 1 : 3;
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            e->M[i][j] = below(2 * most + 1) - most;
        e->q[i] = below(2 * most + 1) - most;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            if (kind == 2 && i == j)
                e->M[i][j] = 1 + below(3);
            if (kind == 3 && j >= i)
                e->M[i][j] = i == j ? 0 : -e->M[j][i];
            if (kind == 4) /* two rows and all of them */
                e->M[i][j] = i < 2 ? e->M[i][j] : e->M[i % 2][j] * (1 + i / 3);
        }
    put_into_units(scaled, p);
}

/* The number of the solution in a list, or -1. */
static int find(const exact_list *list, int n, const double *z)
{
    for (int k = 0; k < list->count; k++) {
        double apart = 0.0;
        for (int i = 0; i < n; i++)
            apart = fmax(apart, fabs(z[i] - list->z[k][i]) / (1e-3 + fabs(list->z[k][i])));
        if (apart < 1e-9)
            return k;
    }
    return -1;
}

/* |min(z, w)| of the integers, z in their units. */
static double residual(const exact_lcp *e, const double *z)
{
    double worst = 0.0;
    for (int i = 0; i < e->n; i++) {
        double w = e->q[i], terms = fabs(w);
        for (int j = 0; j < e->n; j++) {
            w += e->M[i][j] * z[j];
            terms += fabs(e->M[i][j] * z[j]);
        }
        worst = fmax(worst, fabs(fmin(z[i], w)) / fmax(terms, 1.0));
    }
    return worst;
}

static exact_list of_bases, all_points;

TEST(all_solutions_are_those_of_fractions)
{
    int solvable = 0, singular = 0, undecided = 0, several = 0, only_singular = 0;
    for (int k = 0; k < PROBLEMS; k++) {
        problem p;
        if (!is_in_turn(k, PARTS))
            continue;
        OWNED(rb_lcp_solutions) all;
        pose(k, &p);
        const int n = p.of_integers.n;
        exact_solutions(&p.of_integers, &of_bases, &all_points);
        CHECK_OK(
            rb_lcp_enumerate(&(rb_lcp_problem){n, p.M, n, p.q}, NULL, NULL, 0.0, &all, &message));
        undecided += all.undecided;
        singular += all.singular > 0;
        solvable += all_points.count > 0;
        several += of_bases.count > 1;
        only_singular += of_bases.count == 0 && all_points.count > 0;
        if ((all.count > 0) != (all_points.count > 0) || all.bases != 1 << n)
            fail_msg("problem %d: %d listed, %d undecided; there are %d", k, all.count,
                     all.undecided, all_points.count);
        int found = 0;
        for (int a = 0; a < all.count; a++) {
            double z[EXACT_MOST];
            for (int i = 0; i < n; i++)
                z[i] = all.z[i + a * n] * p.column[i];
            CHECK_MAX(residual(&p.of_integers, z), 1e-10, "problem %d, solution %d", k, a);
            const int is = find(&of_bases, n, z);
            found += is >= 0;
            if (is < 0 && !all.singular_basis[a])
                fail_msg("problem %d, solution %d: of no regular basis", k, a);
            for (int b = 0; b < a; b++) {
                double y[EXACT_MOST];
                for (int i = 0; i < n; i++)
                    y[i] = all.z[i + b * n] * p.column[i];
                if (is >= 0 && find(&of_bases, n, y) == is)
                    fail_msg("problem %d: solutions %d and %d are the same", k, a, b);
            }
        }
        if (found != of_bases.count)
            fail_msg("problem %d: %d of %d solutions of regular bases", k, found, of_bases.count);
    }
    print_message("%d solvable, %d of singular bases only, %d several, %d with singular bases, %d "
                  "bases undecided\n",
                  solvable, only_singular, several, singular, undecided);
    assert_int_equal(undecided, 0);
    assert_true(several > 20 && singular > 100);
    assert_true(only_singular > 0 || !getenv("ROLLBEM_TEST_ALL"));
}

TEST(what_solvers_say_is_so)
{
    static const char *const names[] = {"auto", "lemke", "lemke-sparse", "newton"};
    int open = 0, none = 0, proved = 0;
    for (int k = 0; k < PROBLEMS; k++) {
        problem p;
        if (!is_in_turn(k, PARTS))
            continue;
        pose(k, &p);
        const int n = p.of_integers.n;
        OWNED(rb_sparse) M;
        CHECK_OK(rb_sparse_from_dense(n, n, p.M, n, &M));
        exact_solutions(&p.of_integers, &of_bases, &all_points);
        none += all_points.count == 0;
        for (int s = 0; s < 4; s++) {
            double z[EXACT_MOST];
            rb_lcp_info info;
            const rb_status got =
                rb_lcp_solve(names[s], &(rb_lcp_mixed_problem){.M = &M, .q = p.q}, NULL, z, &info);
            for (int i = 0; i < n; i++)
                z[i] *= p.column[i];
            if (got == RB_OK)
                CHECK_MAX(residual(&p.of_integers, z), 1e-9, "problem %d by %s", k, names[s]);
            if (got == RB_OK ? all_points.count == 0
                             : got == RB_NO_SOLUTION && all_points.count > 0)
                fail_msg("problem %d: %s says '%s', there are %d", k, names[s], rb_status_text(got),
                         all_points.count);
            proved += s == 0 && got == RB_NO_SOLUTION;
            open += s == 0 && got != RB_OK && got != RB_NO_SOLUTION;
        }
    }
    print_message("auto: %d without solution, %d proved, %d left open\n", none, proved, open);
}

/* ---- Games --------------------------------------------------------------------------- */

enum { STRATEGIES = 4, MOST_VERTICES = 80 };

/* A vertex of {v >= 0, C v <= 1}: all its tight inequalities, and v. */
typedef struct {
    int labels;
    double v[STRATEGIES];
} vertex;

/* C: others x own, whole numbers > 0.  Zero is left out.  Returns how many. */
static int exact_vertices(int own, int others, int C[STRATEGIES][STRATEGIES], int own_label,
                          int other_label, vertex *found)
{
    int count = 0;
    for (int S = 1; S < 1 << own; S++)
        for (int T = 1; T < 1 << others; T++) {
            exact_whole A[EXACT_MOST][EXACT_MOST + 1], x[EXACT_MOST], over;
            int column[STRATEGIES], columns = 0, rows = 0, labels = 0, feasible = 1;
            for (int i = 0; i < own; i++)
                if (S >> i & 1)
                    column[columns++] = i;
            for (int j = 0; j < others; j++)
                if (T >> j & 1) {
                    for (int c = 0; c < columns && rows < EXACT_MOST; c++)
                        A[rows][c] = C[j][column[c]];
                    A[rows++][columns] = 1;
                }
            if (rows != columns || !exact_solve(rows, columns, A, x, &over))
                continue;
            vertex next = {0, {0}};
            for (int i = 0; i < own; i++)
                labels |= S >> i & 1 ? 0 : 1 << (own_label + i);
            for (int c = 0; c < columns; c++) {
                feasible &= x[c] >= 0;
                labels |= x[c] == 0 ? 1 << (own_label + column[c]) : 0;
                next.v[column[c]] = (double)x[c] / (double)over;
            }
            for (int j = 0; j < others; j++) {
                exact_whole sum = 0;
                for (int c = 0; c < columns; c++)
                    sum += C[j][column[c]] * x[c];
                feasible &= sum <= over;
                labels |= sum == over ? 1 << (other_label + j) : 0;
            }
            next.labels = labels;
            for (int k = 0; k < count && feasible; k++)
                feasible = found[k].labels != labels;
            if (feasible)
                found[count++] = next;
        }
    return count;
}

/* Payoffs 0 ... 2, most games degenerate: the extreme equilibria are those of fractions, each
 * is in a set, and any mixture within a set is an equilibrium. */
TEST(extreme_equilibria_are_those_of_fractions)
{
    static vertex xs[MOST_VERTICES], ys[MOST_VERTICES];
    int degenerate = 0;
    for (int k = 0; k < PROBLEMS / 5; k++) {
        if (!is_in_turn(k, PARTS))
            continue;
        seed = 5u + 7919u * (unsigned)k;
        for (int l = 0; l < 4; l++)
            uniform_from(&seed);
        const int m = 1 + below(STRATEGIES), n = 1 + below(STRATEGIES), most = 1 + below(3);
        double A[16], B[16], shift = below(3) - 1.0, unit = exp2(below(81) - 40.0);
        int of_x[STRATEGIES][STRATEGIES], of_y[STRATEGIES][STRATEGIES];
        for (int i = 0; i < m; i++)
            for (int j = 0; j < n; j++) {
                const int a = below(most + 1), b = below(most + 1);
                of_y[i][j] = 1 + a;                    /* A y <= 1 */
                of_x[j][i] = 1 + b;                    /* B'x <= 1 */
                A[i + j * m] = unit * (a + shift * j); /* a constant per column changes nothing */
                B[i + j * m] = b / unit;
            }
        const int nx = exact_vertices(m, n, of_x, 0, m, xs),
                  ny = exact_vertices(n, m, of_y, m, 0, ys);
        int count = 0;
        for (int a = 0; a < nx; a++)
            for (int b = 0; b < ny; b++)
                count += (xs[a].labels | ys[b].labels) == (1 << (m + n)) - 1;
        OWNED(rb_lcp_solutions) all;
        const rb_lcp_game game = {m, n, A, B, m};
        CHECK_OK(rb_lcp_bimatrix_enumerate(&game, 0.0, &all, &message));
        if (all.count != count || all.undecided)
            fail_msg("game %d: %d listed, %d undecided, there are %d", k, all.count, all.undecided,
                     count);
        degenerate += all.sets != all.count;
        for (int s = 0; s < all.sets; s++) {
            double z[8] = {0.0}, regret[8], payoff[2], sum[2] = {0.0, 0.0};
            for (int l = all.set[s]; l < all.set[s + 1]; l++) /* a mixture of x, another of y */
                for (int i = 0; i < m + n; i++)
                    z[i] += all.z[i + all.member[l] * (m + n)] * (1.0 + ((i < m) ? l : l * l) % 5);
            for (int i = 0; i < m + n; i++)
                sum[i >= m] += z[i];
            for (int i = 0; i < m + n; i++)
                z[i] /= sum[i >= m];
            const rb_lcp_game plain = {m, n, A, B, m};
            rb_lcp_bimatrix_regret(&plain, z, regret, payoff);
            for (int i = 0; i < m + n; i++)
                CHECK_MAX(fmin(z[i], regret[i] * (i < m ? 1.0 / unit : unit)), 1e-12,
                          "game %d, set %d", k, s);
        }
        /* the players change places */
        double At[16], Bt[16];
        for (int i = 0; i < m; i++)
            for (int j = 0; j < n; j++) {
                At[j + i * n] = B[i + j * m];
                Bt[j + i * n] = A[i + j * m];
            }
        OWNED(rb_lcp_solutions) mirrored;
        CHECK_OK(
            rb_lcp_bimatrix_enumerate(&(rb_lcp_game){n, m, At, Bt, n}, 0.0, &mirrored, &message));
        assert_int_equal(mirrored.count, all.count);
        assert_int_equal(mirrored.sets, all.sets);
    }
    assert_true(degenerate > 20);
}

RUN_TESTS(NULL, NULL)
