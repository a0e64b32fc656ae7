/* Bimatrix games by Lemke and Howson's method, and all solutions of small problems. */
#include "check.h"

#include "lcp/lcp.h"
#include "numbers.h"

static unsigned long long state_of_random = 77;

static double uniform(void)
{
    return uniform_of(&state_of_random);
}

enum { N = 40, LD = N + 3 };

static double A[LD * N], B[LD * N];
static const rb_lcp_game two = {2, 2, A, B, LD};

/* What the better player could gain by another strategy, from the definition; also
 * refuses what are no probabilities. */
static double gain(int m, int n, const double *z)
{
    const double *x = z, *y = z + m;
    double sum_x = 0.0, sum_y = 0.0, got_a = 0.0, got_b = 0.0, best_a = -INFINITY,
           best_b = -INFINITY;
    for (int i = 0; i < m; i++) {
        double row = 0.0;
        assert_true(x[i] >= 0.0);
        sum_x += x[i];
        for (int j = 0; j < n; j++) {
            row += A[i + j * LD] * y[j];
            got_b += x[i] * B[i + j * LD] * y[j];
        }
        got_a += x[i] * row;
        best_a = fmax(best_a, row);
    }
    for (int j = 0; j < n; j++) {
        double column = 0.0;
        assert_true(y[j] >= 0.0);
        sum_y += y[j];
        for (int i = 0; i < m; i++)
            column += B[i + j * LD] * x[i];
        best_b = fmax(best_b, column);
    }
    CHECK_ABS(sum_x, 1.0, 1e-14, "row player");
    CHECK_ABS(sum_y, 1.0, 1e-14, "column player");
    return fmax(best_a - got_a, best_b - got_b);
}

static void random_game(int m, int n, int integers)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            A[i + j * LD] = integers ? floor(2.0 * uniform()) : uniform();
            B[i + j * LD] = integers ? floor(2.0 * uniform()) : 10.0 + 100.0 * uniform();
        }
}

TEST(random_games_are_solved)
{
    double z[2 * N];
    rb_lcp_info info;
    for (int k = 0; k < 60; k++) {
        const int m = 1 + (7 * k) % N, n = 1 + (11 * k) % N;
        const rb_lcp_game game = {m, n, A, B, LD};
        random_game(m, n, 0);
        CHECK_OK(rb_lcp_bimatrix(&game, k % (m + n), NULL, z, &info));
        CHECK_MAX(gain(m, n, z), 1e-10, "game %d", k);
        CHECK_MAX(info.res, 1e-11, "game %d", k);
    }
}

/* Payoffs of few values tie everywhere: degenerate games. */
TEST(games_of_small_integers_do_not_cycle)
{
    double z[2 * N];
    rb_lcp_info info;
    for (int k = 0; k < 400; k++) {
        const int few = k % 50 == 0, m = few ? 30 : 1 + k % 13, n = few ? 30 : 1 + k % 11;
        const rb_lcp_game game = {m, n, A, B, LD};
        random_game(m, n, 1);
        CHECK_OK(rb_lcp_bimatrix(&game, k % (m + n + 1) - 1, NULL, z, &info));
        CHECK_MAX(gain(m, n, z), 1e-12, "game %d", k);
    }
}

/* ---- Long paths -------------------------------------------------------------------- */

/* r = -R / (1 - sum R) with R = others times the inverse of first, d x d by rows: the facets of
 * the polar of the polytope, in the coordinates of those at first. */
static void facets(int d, const double *first, const double *others, double *r)
{
    double T[20][40];
    for (int i = 0; i < d; i++)
        for (int j = 0; j < 2 * d; j++)
            T[i][j] = j < d ? first[i * d + j] : i == j - d;
    for (int c = 0; c < d; c++) {
        int p = c;
        for (int i = c; i < d; i++)
            if (fabs(T[i][c]) > fabs(T[p][c]))
                p = i;
        for (int j = 0; j < 2 * d; j++) {
            const double x = T[p][j];
            T[p][j] = T[c][j];
            T[c][j] = x;
        }
        const double pivot = T[c][c];
        for (int j = 0; j < 2 * d; j++)
            T[c][j] /= pivot;
        for (int i = 0; i < d; i++) {
            const double factor = i == c ? 0.0 : T[i][c];
            for (int j = 0; factor != 0.0 && j < 2 * d; j++)
                T[i][j] -= factor * T[c][j];
        }
    }
    for (int i = 0; i < d; i++) {
        double sum = 0.0;
        for (int j = 0; j < d; j++) {
            r[i * d + j] = 0.0;
            for (int k = 0; k < d; k++)
                r[i * d + j] += others[i * d + k] * T[k][d + j];
            sum += r[i * d + j];
        }
        for (int j = 0; j < d; j++)
            r[i * d + j] /= sum - 1.0;
    }
}

/* The game of dual cyclic polytopes (Savani and von Stengel, Econometrica 74, 2006). */
static void polytope_game(int d)
{
    double curve[40][20], mean[20] = {0}, first[400], others[400], R[400], most[2] = {0.0, 0.0};
    const double pi = acos(-1.0);
    int at[41];
    for (int k = 0; k < 2 * d; k++) {
        const int l = k + 1, even = l % 2 == 0;
        for (int c = 0; c < d; c++) {
            const double angle = (c / 2 + 1) * pi * k / d;
            curve[k][c] = c % 2 ? sin(angle) : cos(angle);
            mean[c] += curve[k][c] / (2 * d);
        }
        at[l == 1 || l == d ? l : l < d ? (even ? l + 1 : l - 1) : (even ? l - 1 : l + 1)] = k;
    }
    for (int player = 0; player < 2; player++) {
        for (int i = 0; i < d; i++)
            for (int c = 0; c < d; c++) {
                const int from = player ? i : at[d + 1 + i], to = player ? d + i : at[1 + i];
                first[i * d + c] = curve[from][c] - mean[c];
                others[i * d + c] = curve[to][c] - mean[c];
            }
        facets(d, first, others, R);
        for (int k = 0; k < d * d; k++)
            most[player] = fmax(most[player], fabs(R[k]));
        for (int i = 0; i < d; i++)
            for (int j = 0; j < d; j++)
                *(player ? &B[j + i * LD] : &A[i + j * LD]) = R[i * d + j] / most[player];
    }
}

/* Numbers of pivots by Gale's evenness condition, in integers: Fibonacci's numbers less 1 from
 * the first label.  With a threshold for pivots of 1e-11 of the column, paths from d = 16 on
 * were lost. */
TEST(long_paths_have_the_pivots_that_they_should)
{
    static const struct {
        int d, label, pivots;
    } paths[] = {{12, 1, 6764}, {12, 7, 176}, {12, 9, 396},    {14, 1, 28656}, {14, 8, 464},
                 {14, 9, 464},  {16, 9, 752}, {16, 1, 121392}, {18, 9, 1972},  {18, 10, 1972}};
    double z[2 * N];
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++) {
        const int d = paths[k].d;
        rb_lcp_info info;
        polytope_game(d);
        CHECK_OK(
            rb_lcp_bimatrix(&(rb_lcp_game){d, d, A, B, LD}, paths[k].label - 1, NULL, z, &info));
        CHECK_MAX(gain(d, d, z), 1e-12, "d = %d", d);
        assert_int_equal(info.iters, paths[k].pivots);
        assert_int_equal(info.label, paths[k].label - 1);
    }
}

/* Without a label, one whose path is short is found in a fraction of the pivots. */
TEST(labels_take_turns_on_long_paths)
{
    double z[2 * N];
    rb_lcp_info info;
    rb_lcp_options opt = rb_lcp_defaults();
    polytope_game(18);
    const rb_lcp_game game = {18, 18, A, B, LD};
    CHECK_OK(rb_lcp_bimatrix(&game, -1, NULL, z, &info));
    CHECK_MAX(gain(18, 18, z), 1e-12, "gain");
    CHECK_MAX(info.iters, 60000, "pivots");
    assert_true(info.label > 0);
    opt.max_iters = 500;
    CHECK_STATUS(rb_lcp_bimatrix(&game, -1, &opt, z, &info), RB_MAXITER);
    CHECK_STATUS(rb_lcp_bimatrix(&game, 0, &opt, z, &info), RB_MAXITER);
    opt.max_iters = 0;
    opt.seconds = 1e-3;
    CHECK_STATUS(rb_lcp_bimatrix(&game, 0, &opt, z, &info), RB_TIME_LIMIT);
    CHECK_STATUS(rb_lcp_bimatrix(&game, -2, &opt, z, &info), RB_EINVAL);
}

/* Battle of the sexes: two pure equilibria and a mixed one, (2/3, 1/3) and (1/3, 2/3). */
static void battle_of_the_sexes(void)
{
    memset(A, 0, sizeof A);
    memset(B, 0, sizeof B);
    A[0] = B[1 + LD] = 2.0;
    B[0] = A[1 + LD] = 1.0;
}

TEST(all_equilibria_of_a_game)
{
    OWNED(rb_lcp_solutions) all;
    int mixed = 0;
    battle_of_the_sexes();
    CHECK_OK(rb_lcp_bimatrix_enumerate(&two, 0.0, &all, &message));
    assert_int_equal(all.count, 3);
    assert_int_equal(all.bases, 12); /* of both polytopes: 4 over 2 each */
    assert_int_equal(all.sets, 3);
    for (int k = 0; k < 3; k++) {
        const double *z = all.z + 4 * k;
        CHECK_MAX(gain(2, 2, z), 1e-15, "equilibrium %d", k);
        if (z[0] > 0.01 && z[0] < 0.99) {
            mixed++;
            CHECK_REL(z[0], 2.0 / 3.0, 1e-15, "x");
            CHECK_REL(z[2], 1.0 / 3.0, 1e-15, "y");
        }
    }
    assert_int_equal(mixed, 1);
}

/* The row player does not care: x = (1, 0) with y = (1, 0), (1/2, 1/2); x = (0, 1) with y = (1/2,
 * 1/2), (0, 1); and all equal payoffs: every pair of pure strategies, in one set. */
TEST(indifferent_players_have_sets_of_equilibria)
{
    OWNED(rb_lcp_solutions) all;
    OWNED(rb_lcp_solutions) equal;
    memset(A, 0, sizeof A);
    memset(B, 0, sizeof B);
    CHECK_OK(rb_lcp_bimatrix_enumerate(&two, 0.0, &equal, NULL));
    assert_int_equal(equal.count, 4);
    assert_int_equal(equal.sets, 1);
    assert_int_equal(equal.set[1], 4);
    A[0] = A[1 + LD] = 1.0; /* matching pennies for the one, nothing at stake for the other */
    CHECK_OK(rb_lcp_bimatrix_enumerate(&two, 0.0, &all, NULL));
    assert_int_equal(all.count, 4);
    assert_int_equal(all.sets, 3);
    for (int k = 0; k < 4; k++) {
        const double *z = all.z + 4 * k;
        CHECK_MAX(gain(2, 2, z), 1e-15, "equilibrium %d", k);
        assert_true(z[0] == 0.0 || z[0] == 1.0);
        assert_true(z[2] == 0.5 || z[2] == z[0]);
    }
}

/* A nondegenerate game has an odd number of equilibria, and every label leads to one of
 * them. */
TEST(every_label_leads_to_an_equilibrium)
{
    for (int k = 0; k < 30; k++) {
        const int m = 2 + k % 3, n = 2 + k % 4;
        const rb_lcp_game game = {m, n, A, B, LD};
        OWNED(rb_lcp_solutions) all;
        double z[N];
        random_game(m, n, 0);
        CHECK_OK(rb_lcp_bimatrix_enumerate(&game, 0.0, &all, NULL));
        assert_int_equal(all.count % 2, 1);
        for (int label = 0; label < m + n; label++) {
            int found = 0;
            CHECK_OK(rb_lcp_bimatrix(&game, label, NULL, z, NULL));
            for (int s = 0; s < all.count; s++) {
                double apart = 0.0;
                for (int i = 0; i < m + n; i++)
                    apart = fmax(apart, fabs(z[i] - all.z[i + s * (m + n)]));
                found |= apart < 1e-9;
            }
            assert_true(found);
        }
    }
}

/* What each strategy loses against the best reply, written out; what was in the arrays
 * before does not matter. */
TEST(regrets_are_those_of_the_definition)
{
    const int m = 3, n = 4;
    const rb_lcp_game game = {m, n, A, B, LD};
    for (int k = 0; k < 20; k++) {
        double z[7], regret[7], payoff[2] = {1e9, 1e9}, best[2] = {-INFINITY, -INFINITY};
        double of[7], worst = 0.0;
        random_game(m, n, 0);
        for (int j = 0; j < n && k % 2; j++) /* losses for all */
            for (int i = 0; i < m; i++) {
                A[i + j * LD] -= 5.0;
                B[i + j * LD] -= 500.0;
            }
        for (int i = 0; i < m + n; i++)
            z[i] = fabs(uniform());
        for (int i = 0; i < m + n; i++) {
            of[i] = 0.0;
            for (int l = 0; l < (i < m ? n : m); l++)
                of[i] += i < m ? A[i + l * LD] * z[m + l] : B[l + (i - m) * LD] * z[l];
            best[i >= m] = fmax(best[i >= m], of[i]);
        }
        for (int i = 0; i < m + n; i++)
            worst = fmax(worst, fmin(z[i], best[i >= m] - of[i]));
        CHECK_REL(rb_lcp_bimatrix_regret(&game, z, regret, payoff), worst, 1e-12, "worst");
        for (int i = 0; i < 2; i++)
            CHECK_REL(payoff[i], best[i], 1e-12, "payoff of player %d", i);
        for (int i = 0; i < m + n; i++)
            CHECK_ABS(regret[i], best[i >= m] - of[i], 1e-11, "regret %d", i);
        z[k % 7] = NAN;
        assert_true(isnan(rb_lcp_bimatrix_regret(&game, z, regret, payoff)));
    }
}

typedef struct {
    int pivots, entering, leaving, first, labels;
} story;

/* A label that was doubled enters next, by its other variable. */
static void follow(const rb_lcp_pivot *pivot, void *context)
{
    story *s = context;
    assert_int_equal(pivot->pivot, s->pivots);
    assert_int_equal(pivot->n, s->labels);
    assert_int_equal(pivot->attempt, 3);
    assert_true(pivot->row >= 0 && pivot->row < s->labels && pivot->ratio >= 0.0);
    assert_null(pivot->basis);
    if (s->pivots == 0)
        s->first = pivot->entering;
    else
        assert_int_equal(pivot->entering % s->labels, s->leaving % s->labels);
    if (s->pivots)
        assert_int_not_equal(pivot->entering, s->leaving);
    s->leaving = pivot->leaving;
    s->pivots++;
}

TEST(the_trace_follows_the_labels)
{
    for (int k = 0; k < 40; k++) {
        const int m = 1 + k % 7, n = 1 + k % 5, label = k % (m + n);
        const rb_lcp_game game = {m, n, A, B, LD};
        double z[2 * N];
        rb_lcp_info info;
        story s = {.labels = m + n};
        rb_lcp_options opt = rb_lcp_defaults();
        opt.trace = follow;
        opt.trace_context = &s;
        opt.attempt = 3;
        random_game(m, n, 0);
        CHECK_OK(rb_lcp_bimatrix(&game, label, &opt, z, &info));
        assert_int_equal(info.iters, s.pivots);
        assert_int_equal(s.first, m + n + label); /* its probability */
        assert_int_equal(s.leaving % (m + n), label);
    }
}

/* ---- All solutions of a problem ---------------------------------------------------- */

/* M = -1, q = 1: z = 0 and z = 1; with a box [0, 3] z = 3 is another, since w(3) < 0. */
TEST(one_variable_by_hand)
{
    const double M[] = {-1.0}, q[] = {1.0}, high[] = {3.0}, low[] = {0.0};
    rb_lcp_solutions all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){1, M, 1, q}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 2);
    assert_int_equal(all.bases, 2);
    assert_int_equal(all.singular, 0);
    CHECK_ABS(all.z[0] + all.z[1], 1.0, 1e-15, "z");
    rb_lcp_solutions_free(&all);
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){1, M, 1, q}, low, high, 0.0, &all, NULL));
    assert_int_equal(all.count, 3);
    CHECK_ABS(all.z[0] + all.z[1] + all.z[2], 4.0, 1e-15, "z");
    rb_lcp_solutions_free(&all);
}

/* Rows of the sizes 1e8, 1e154 and 1: fractions give two solutions, z = (1e8 / 24.75, 0, 4e6)
 * and one whose z2 is 3e-155. */
TEST(solutions_of_any_size_are_listed)
{
    const double M[] = {24.75, 12.75, 0.0, -1e154, -25.0, -25.0, -25.0, 0.0, -25.0};
    const double q[] = {1.0 / 3.0, -1e-8, 1e8};
    OWNED(rb_lcp_solutions) all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){3, M, 3, q}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 2);
    assert_int_equal(all.undecided, 0);
    const double *large = all.z[2] > 0.0 ? all.z : all.z + 3, *small = all.z + 3 - (large - all.z);
    CHECK_REL(large[0], (1e8 - 1.0 / 3.0) / 24.75, 1e-13, "z1");
    CHECK_ABS(large[1], 0.0, 0.0, "z2");
    CHECK_REL(large[2], 4e6, 1e-13, "z3");
    /* w1 = w2 = 0: 12.75 z1 = 1e-8 + 25 z2, 24.75 z1 + 1/3 = 1e154 z2 */
    CHECK_REL(small[0], 1e-8 / 12.75, 1e-13, "z1");
    CHECK_REL(small[1], (24.75e-8 / 12.75 + 1.0 / 3.0) / 1e154, 1e-13, "z2");
    CHECK_ABS(small[2], 0.0, 0.0, "z3");
}

/* M = 1: z = -q cut off by its box, whatever ends that has. */
TEST(boxes_of_every_kind_are_enumerated)
{
    static const struct {
        double low, high, q, z;
    } all[] = {{-INFINITY, 2.0, -1.0, 1.0},
               {-INFINITY, 2.0, -3.0, 2.0},
               {-INFINITY, 2.0, 7.0, -7.0},
               {-1.0, INFINITY, 3.0, -1.0},
               {-INFINITY, INFINITY, 3.0, -3.0},
               {-1.0, 2.0, -3.0, 2.0},
               {-1.0, 2.0, 3.0, -1.0},
               {0.5, 0.5, 3.0, 0.5},
               {0.5, 0.5, -3.0, 0.5}};
    enum { BOXES = sizeof all / sizeof *all };
    const double M[] = {1.0, 0.0, 0.0, 1.0};
    for (int k = 0; k < BOXES * BOXES; k++) { /* two at a time */
        const int a = k % BOXES, b = k / BOXES;
        const double low[] = {all[a].low, all[b].low}, q[] = {all[a].q, all[b].q};
        const double high[] = {all[a].high, all[b].high};
        OWNED(rb_lcp_solutions) found;
        CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){2, M, 2, q}, low, high, 0.0, &found, NULL));
        assert_int_equal(found.count, 1);
        CHECK_ABS(found.z[0], all[a].z, 0.0, "z(1), boxes %d and %d", a, b);
        CHECK_ABS(found.z[1], all[b].z, 0.0, "z(2), boxes %d and %d", a, b);
    }
    rb_lcp_solutions_free(NULL);
}

/* A P-matrix has one solution, which several bases give when it is degenerate; M = 0 with
 * q = 0 leaves z free, which is a basis without inverse. */
TEST(solutions_are_listed_once)
{
    const double M[] = {2.0, 1.0, 1.0, 2.0}, zero[] = {0.0, 0.0};
    rb_lcp_solutions all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){2, M, 2, zero}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 1);
    CHECK_ABS(all.z[0] + all.z[1], 0.0, 0.0, "z");
    rb_lcp_solutions_free(&all);
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){1, zero, 1, zero}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 1);
    assert_int_equal(all.singular, 1);
    assert_int_equal(all.undecided, 0);
    rb_lcp_solutions_free(&all);
}

/* Of singular bases: M = [0 1; 0 0], q = (-1, 0) is solved by (t, 1) for every t, of which
 * the bases of z2 alone and of both have one; M = 0 with q = -1 has none, and says so. */
TEST(singular_bases_are_decided)
{
    const double M[] = {0.0, 0.0, 1.0, 0.0}, q[] = {-1.0, 0.0}, none[] = {-1.0, -1.0};
    const double zero[4] = {0.0}, high[] = {2.0, 3.0};
    rb_lcp_solutions all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){2, M, 2, q}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.undecided, 0);
    assert_int_equal(all.singular, 3);
    assert_true(all.count >= 1);
    for (int k = 0; k < all.count; k++) {
        CHECK_ABS(all.z[2 * k + 1], 1.0, 1e-12, "z2");
        assert_true(all.z[2 * k] >= 0.0);
        assert_int_equal(all.singular_basis[k], 1);
    }
    rb_lcp_solutions_free(&all);
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){2, zero, 2, none}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 0);
    assert_int_equal(all.singular, 3);
    assert_int_equal(all.undecided, 0);
    rb_lcp_solutions_free(&all);
    /* in a box they are at its upper end */
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){2, zero, 2, none}, NULL, high, 0.0, &all, NULL));
    assert_int_equal(all.count, 1);
    assert_int_equal(all.undecided, 0);
    CHECK_ABS(all.z[0], 2.0, 0.0, "z1");
    CHECK_ABS(all.z[1], 3.0, 0.0, "z2");
    rb_lcp_solutions_free(&all);
}

/* diag(1e-7, 1e7): once taken for singular; M = -1 in units of 1e6 and 1e-6: four solutions,
 * which are not one; units of powers of two change nothing, bit by bit. */
TEST(units_change_no_solution)
{
    const double apart[] = {1e-7, 0.0, 0.0, 1e7}, minus[] = {-1.0, 0.0, 0.0, -1.0};
    const double of_apart[] = {-1e-4, -1e4}, of_minus[] = {1e-6, 1e6};
    rb_lcp_solutions all;
    CHECK_OK(
        rb_lcp_enumerate(&(rb_lcp_problem){2, apart, 2, of_apart}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 1);
    CHECK_REL(all.z[0], 1000.0, 1e-15, "z1");
    CHECK_REL(all.z[1], 0.001, 1e-15, "z2");
    rb_lcp_solutions_free(&all);
    CHECK_OK(
        rb_lcp_enumerate(&(rb_lcp_problem){2, minus, 2, of_minus}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 4);
    rb_lcp_solutions_free(&all);
    for (int k = 0; k < 100; k++) {
        double M[49], S[49], q[7], p[7], column[7];
        const int n = 4 + k % 4;
        OWNED(rb_lcp_solutions) plain;
        OWNED(rb_lcp_solutions) scaled;
        for (int i = 0; i < n * n; i++)
            M[i] = S[i] = floor(3.5 * uniform() + 0.5);
        for (int i = 0; i < n; i++)
            q[i] = p[i] = floor(3.5 * uniform() + 0.5);
        for (int i = 0; i < n; i++) {
            const double row = exp2(floor(40.0 * uniform()));
            column[i] = exp2(floor(40.0 * uniform()));
            p[i] *= row;
            for (int j = 0; j < n; j++) {
                S[i + j * n] *= row;
                S[j + i * n] *= column[i];
            }
        }
        CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){n, M, n, q}, NULL, NULL, 0.0, &plain, NULL));
        CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){n, S, n, p}, NULL, NULL, 0.0, &scaled, NULL));
        assert_int_equal(plain.count, scaled.count);
        assert_int_equal(plain.undecided + scaled.undecided, 0);
        for (int i = 0; i < n * plain.count; i++) /* in the same order */
            CHECK_ABS(scaled.z[i] * column[i % n], plain.z[i], 0.0, "problem %d, entry %d", k, i);
    }
}

TEST(a_search_for_all_solutions_ends_in_time)
{
    static double M[16 * 16], q[16];
    OWNED(rb_lcp_solutions) all;
    for (int i = 0; i < 256; i++)
        M[i] = uniform();
    for (int i = 0; i < 16; i++)
        q[i] = uniform();
    CHECK_STATUS(
        rb_lcp_enumerate(&(rb_lcp_problem){16, M, 16, q}, NULL, NULL, 1e-4, &all, &message),
        RB_TIME_LIMIT);
    assert_non_null(strstr(message.text, "of 65536 complementary bases"));
    assert_true(all.bases > 0 && all.bases < 65536);
}

/* Three places of each boxed variable: 3^13 are tried, 3^14 are not. */
TEST(too_many_bases_are_refused)
{
    enum { BOXED = 14 };
    double M[BOXED * BOXED] = {0.0}, q[BOXED], low[BOXED], high[BOXED];
    OWNED(rb_lcp_solutions) all;
    for (int i = 0; i < BOXED; i++) {
        M[i * BOXED + i] = 1.0;
        q[i] = 0.0;
        low[i] = -1.0;
        high[i] = 1.0;
    }
    CHECK_SAYS(
        rb_lcp_enumerate(&(rb_lcp_problem){BOXED, M, BOXED, q}, low, high, 0.0, &all, &message),
        RB_EINVAL, "4.78e+06 complementary bases");
}

/* Lemke's answers are among them. */
TEST(what_lemke_finds_is_listed)
{
    for (int k = 0; k < 100; k++) {
        const int n = 1 + k % 7;
        double M[49], q[7], z[7];
        OWNED(rb_lcp_solutions) all = {0};
        int found = 0;
        for (int i = 0; i < n * n; i++)
            M[i] = uniform();
        for (int i = 0; i < n; i++)
            q[i] = uniform();
        if (rb_lcp_lemke(&(rb_lcp_problem){n, M, n, q}, NULL, z, NULL) != RB_OK)
            continue;
        CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){n, M, n, q}, NULL, NULL, 0.0, &all, NULL));
        for (int s = 0; s < all.count; s++) {
            double apart = 0.0;
            for (int i = 0; i < n; i++)
                apart = fmax(apart, fabs(z[i] - all.z[i + s * n]));
            found |= apart < 1e-8 * (1.0 + rb_norm_inf((size_t)n, z));
        }
        assert_true(found);
    }
}

/* ---- Bad input --------------------------------------------------------------------- */

TEST(bad_input_is_named)
{
    double z[2 * N];
    rb_lcp_info info;
    rb_lcp_solutions all;
    const double low[] = {1.0, 0.0}, high[] = {0.0, 1.0}, zero[] = {0.0, 0.0};
    static const double big[23 * 23];
    battle_of_the_sexes();
    CHECK_STATUS(rb_lcp_bimatrix(&(rb_lcp_game){0, 2, A, B, LD}, 0, NULL, z, &info), RB_EINVAL);
    CHECK_STATUS(rb_lcp_bimatrix(&(rb_lcp_game){2, 2, A, B, 1}, 0, NULL, z, &info), RB_EINVAL);
    CHECK_STATUS(rb_lcp_bimatrix(&two, 4, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "label 5: expected 1 to 4"));
    CHECK_STATUS(rb_lcp_bimatrix(&two, -2, NULL, z, &info), RB_EINVAL);
    CHECK_STATUS(rb_lcp_bimatrix(&(rb_lcp_game){2, 0, A, B, LD}, 0, NULL, z, &info), RB_EINVAL);
    CHECK_SAYS(rb_lcp_bimatrix_enumerate(&(rb_lcp_game){2, 0, A, B, LD}, 0.0, &all, &message),
               RB_EINVAL, "a game of 2 by 0");
    const double right = A[LD];
    A[LD] = -INFINITY;
    CHECK_STATUS(rb_lcp_bimatrix(&two, 0, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "A(1, 2)"));
    A[LD] = right;
    rb_lcp_options opt = rb_lcp_defaults();
    opt.max_iters = 1;
    CHECK_STATUS(rb_lcp_bimatrix(&two, 0, &opt, z, &info), RB_MAXITER);
    B[1] = NAN;
    CHECK_STATUS(rb_lcp_bimatrix(&two, 0, NULL, z, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "B(2, 1)"));
    CHECK_SAYS(rb_lcp_enumerate(&(rb_lcp_problem){2, A, LD, low}, low, high, 0.0, &all, &message),
               RB_EINVAL, "bounds 1 are [1, 0]");
    CHECK_SAYS(
        rb_lcp_enumerate(&(rb_lcp_problem){23, big, 23, big}, NULL, NULL, 0.0, &all, &message),
        RB_EINVAL, "order 22");
    CHECK_SAYS(rb_lcp_enumerate(&(rb_lcp_problem){2, B, LD, zero}, NULL, NULL, 0.0, &all, &message),
               RB_EINVAL, "M(2, 1) = nan");
}

/* z = 1e600 would solve, which is no number: it cannot be listed, and "no solution" would be
 * wrong. */
TEST(points_beyond_the_largest_number_are_not_listed)
{
    const double M[] = {1e-300}, q[] = {-1e300};
    OWNED(rb_lcp_solutions) all;
    CHECK_OK(rb_lcp_enumerate(&(rb_lcp_problem){1, M, 1, q}, NULL, NULL, 0.0, &all, NULL));
    assert_int_equal(all.count, 0);
    assert_int_equal(all.undecided, 1);
}

static rb_status solve_anew(void *context)
{
    double z[4];
    OWNED(rb_lcp_solutions) all;
    const rb_status s = rb_lcp_bimatrix(context, 0, NULL, z, NULL);
    const rb_status t = rb_lcp_bimatrix_enumerate(context, 0.0, &all, NULL);
    return s == RB_OK ? t : s;
}

TEST(short_memory_is_reported)
{
    battle_of_the_sexes();
    for (int i = 0;; i++) {
        double z[4];
        OWNED(rb_lcp_solutions) all;
        alloc_fail_after(i);
        const rb_status s = rb_lcp_bimatrix(&two, 0, NULL, z, NULL);
        const rb_status t = rb_lcp_bimatrix_enumerate(&two, 0.0, &all, NULL);
        const int refused = alloc_failed();
        alloc_succeed();
        assert_true(refused == (s == RB_ENOMEM || t == RB_ENOMEM));
        if (!refused)
            break;
    }
    assert_true(alloc_fail_each(solve_anew, (void *)&two) > 3);
}

RUN_TESTS(NULL, NULL)
