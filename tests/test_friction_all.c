/* All solutions of plane friction problems: springs and rods with known numbers of them, problems
 * of whole numbers against fractions, and what is refused. */
#include "check.h"

#include "exact.h"
#include "friction_problems.h"
#include "numbers.h"
#include "lcp/friction/friction.h"

enum {
    OPEN = 1 << RB_FRICTION_OPEN,
    STICK = 1 << RB_FRICTION_STICK,
    PLUS = 1 << RB_FRICTION_SLIP_PLUS,
    MINUS = 1 << RB_FRICTION_SLIP_MINUS
};

static double W[16 * 16], q[16], mu[8];

static rb_friction_problem problem(int contacts)
{
    return local_with(2, contacts, mu, W, q);
}

/* Klarbring's node (Ingenieur-Archiv 60, 1990): W = K^-1, K = [1 0.8; 0.8 1], q = W f. */
TEST(one_two_three_solutions_of_a_node)
{
    static const struct {
        double mu;
        int count;
    } cases[] = {{1.2, 1}, {1.5, 2}, {2.0, 3}};
    W[0] = W[3] = 1.0 / 0.36;
    W[1] = W[2] = -0.8 / 0.36;
    q[0] = (-1.0 + 0.8 * 1.5) / 0.36;
    q[1] = (0.8 - 1.5) / 0.36;
    for (int k = 0; k < 3; k++) {
        OWNED(rb_friction_solutions) all;
        mu[0] = cases[k].mu;
        const rb_friction_problem p = problem(1);
        CHECK_OK(rb_friction_all(&p, 0.0, &all, &message));
        assert_int_equal(all.count, cases[k].count);
        assert_int_equal(all.tried, 4);
        assert_int_equal(all.undecided, 0);
        assert_int_equal(all.states[0], OPEN);
        CHECK_ABS(all.r[0], 0.0, 0.0, "separated");
        if (k > 0) { /* K r = -f: stick, at mu = 1.5 on its border */
            assert_int_equal(all.states[1], k == 1 ? STICK | MINUS : STICK);
            CHECK_REL(all.r[2], 1.0, 1e-14, "r_N of stick");
            CHECK_REL(all.r[3], 1.5, 1e-14, "r_T of stick");
        }
        if (k == 2) {
            assert_int_equal(all.states[2], MINUS);
            CHECK_REL(all.r[4], 1.0 / 3.0, 1e-14, "r_N of slip");
            CHECK_REL(all.r[5], 2.0 / 3.0, 1e-14, "r_T of slip");
        }
    }
}

/* The end of a rod on the ground, at an angle (Painleve). */
static void rod(double angle, double unit, int at, int m)
{
    const double c = cos(angle), s = sin(angle);
    W[at + at * m] = unit * (1.0 + 3.0 * c * c);
    W[at + 1 + at * m] = W[at + (at + 1) * m] = unit * 3.0 * s * c;
    W[at + 1 + (at + 1) * m] = unit * (1.0 + 3.0 * s * s);
}

/* Three solutions of each rod, in any unit: 3, 9, 27. */
TEST(rods_have_three_solutions_each)
{
    static const double units[] = {1.0, 1e-8, 1e6};
    int count = 1;
    for (int nc = 1; nc <= 3; nc++) {
        const int m = 2 * nc;
        OWNED(rb_friction_solutions) all;
        memset(W, 0, sizeof W);
        for (int c = 0; c < nc; c++) {
            rod(1.0, units[c], 2 * c, m);
            q[2 * c] = 0.5 * sqrt(units[c]);
            q[2 * c + 1] = 3.0 * sqrt(units[c]);
            mu[c] = 2.2;
        }
        const rb_friction_problem p = problem(nc);
        assert_int_equal(rb_friction_may_have_several(&p), 1);
        CHECK_OK(rb_friction_all(&p, 0.0, &all, &message));
        count *= 3;
        assert_int_equal(all.count, count);
        assert_int_equal(all.undecided, 0);
        if (nc == 1) {
            const double want[3][2] = {{0.0, 0.0}, {0.632432, -1.236342}, {0.444483, -0.977863}};
            for (int k = 0; k < 3; k++)
                for (int a = 0; a < 2; a++)
                    CHECK_ABS(all.r[2 * k + a], want[k][a], 1e-6, "solution %d", k + 1);
        }
    }
    OWNED(rb_friction_solutions) one;
    rod(0.6, 1.0, 0, 2);
    q[0] = -1.0, q[1] = -0.5, mu[0] = 0.5;
    const rb_friction_problem p = problem(1);
    assert_int_equal(rb_friction_may_have_several(&p), 0);
    CHECK_OK(rb_friction_all(&p, 0.0, &one, &message));
    assert_int_equal(one.count, 1);
    assert_int_equal(one.states[0], STICK);
    CHECK_ABS(one.r[0], 0.3144, 1e-4, "r_N");
    CHECK_ABS(one.r[1], 0.0309, 1e-4, "r_T");
}

/* Two contacts at one point share its force in any way: singular states, whose extremes are
 * listed; and as a global problem. */
TEST(shared_loads_have_their_extremes)
{
    for (int global = 0; global < 2; global++) {
        OWNED(rb_friction_problem) p;
        OWNED(rb_friction_solutions) all;
        int ends = 0;
        if (global) {
            rb_triplets K = {.rows = 2, .cols = 2}, H = {.rows = 2, .cols = 4};
            p = zero_global(2, 2, 2);
            for (int i = 0; i < 2; i++) {
                rb_triplets_add(&K, i, i, 1.0);
                rb_triplets_add(&H, i, i, 1.0);
                rb_triplets_add(&H, i, 2 + i, 1.0);
            }
            CHECK_OK(rb_sparse_from_triplets(&K, &p.K));
            CHECK_OK(rb_sparse_from_triplets(&H, &p.H));
            rb_triplets_free(&K);
            rb_triplets_free(&H);
            p.f[0] = -1.0, p.f[1] = -0.3;
        } else {
            p = zero_local(2, 2);
            for (int i = 0; i < 4; i++) {
                p.q[i] = i % 2 ? -0.3 : -1.0;
                for (int j = 0; j < 4; j++)
                    p.W[i + 4 * j] = (i + j) % 2 == 0;
            }
        }
        p.mu[0] = p.mu[1] = 0.5;
        CHECK_OK(rb_friction_all(&p, 0.0, &all, &message));
        assert_int_equal(all.undecided, 0);
        assert_true(all.singular > 0 && all.count >= 2);
        for (int k = 0; k < all.count; k++) {
            const double *r = all.r + 4 * k;
            CHECK_REL(r[0] + r[2], 1.0, 1e-12, "shared");
            CHECK_REL(r[1] + r[3], 0.3, 1e-12, "shared");
            ends += fabs(fabs(r[0] - r[2]) - 1.0) < 1e-12;
        }
        assert_int_equal(ends, 2);
    }
}

/* mu = 0: closed or open; and a body between walls that close, which has no solution. */
TEST(without_friction_and_without_solution)
{
    OWNED(rb_friction_solutions) all;
    OWNED(rb_friction_solutions) none;
    memset(W, 0, sizeof W);
    W[0] = W[3] = 1.0;
    W[1] = W[2] = 0.9;
    q[0] = -1.0, q[1] = 5.0, mu[0] = 0.0;
    rb_friction_problem p = problem(1);
    CHECK_OK(rb_friction_all(&p, 0.0, &all, &message));
    assert_int_equal(all.count, 1);
    assert_int_equal(all.tried, 2);
    assert_int_equal(all.states[0], STICK);
    CHECK_ABS(all.r[0], 1.0, 1e-15, "r_N");
    CHECK_ABS(all.r[1], 0.0, 0.0, "r_T");
    CHECK_ABS(all.u[1], 5.9, 1e-14, "u_T");
    memset(W, 0, sizeof W);
    for (int a = 0; a < 2; a++) {
        W[5 * a] = W[5 * (2 + a)] = 1.0;
        W[a + 4 * (2 + a)] = W[2 + a + 4 * a] = a ? 1.0 : -1.0;
    }
    q[0] = -1.0, q[1] = 0.0, q[2] = 0.5, q[3] = 0.0;
    mu[0] = mu[1] = 0.3;
    p = problem(2);
    CHECK_OK(rb_friction_all(&p, 0.0, &none, &message));
    assert_int_equal(none.count, 0);
    assert_int_equal(none.undecided, 0);
}

/* ---- Against fractions ----------------------------------------------------------------- */

/* r of a state of whole numbers; 1: it is a solution, exactly.  regular: its matrix is. */
static int exact_state(int nc, int *state, int w[8][8], const int *of_q, const int *of_mu,
                       double *r, int *regular)
{
    exact_whole A[EXACT_MOST][EXACT_MOST + 1], x[EXACT_MOST], over = 1, f[8] = {0}, u[8];
    int column[8], along[8], unknowns = 0, rows[8], equations = 0;
    for (int c = 0; c < nc; c++) { /* r of contact c is x (1, along), or x and another x */
        if (state[c] == RB_FRICTION_OPEN)
            continue;
        rows[equations++] = 2 * c;
        column[unknowns] = 2 * c;
        along[unknowns++] = state[c] == RB_FRICTION_SLIP_PLUS    ? -of_mu[c]
                            : state[c] == RB_FRICTION_SLIP_MINUS ? of_mu[c]
                                                                 : 0;
        if (state[c] == RB_FRICTION_STICK) {
            rows[equations++] = 2 * c + 1;
            column[unknowns] = 2 * c + 1;
            along[unknowns++] = 0;
        }
    }
    for (int i = 0; i < equations; i++) {
        for (int j = 0; j < unknowns; j++)
            A[i][j] = w[rows[i]][column[j]] + (along[j] ? along[j] * w[rows[i]][column[j] + 1] : 0);
        A[i][unknowns] = -of_q[rows[i]];
    }
    *regular = exact_solve(equations, unknowns, A, x, &over);
    if (!*regular)
        return 0;
    for (int j = 0; j < unknowns; j++) {
        f[column[j]] += x[j];
        if (along[j])
            f[column[j] + 1] += along[j] * x[j];
    }
    int is = 1;
    for (int i = 0; i < 2 * nc; i++) {
        u[i] = of_q[i] * over;
        for (int j = 0; j < 2 * nc; j++)
            u[i] += w[i][j] * f[j];
        r[i] = (double)f[i] / (double)over;
    }
    for (int c = 0; c < nc && is; c++) {
        const exact_whole rn = f[2 * c], rt = f[2 * c + 1];
        is = rn >= 0 && u[2 * c] >= 0;
        is &= state[c] != RB_FRICTION_STICK || (rt <= of_mu[c] * rn && -rt <= of_mu[c] * rn);
        is &= state[c] != RB_FRICTION_SLIP_PLUS || u[2 * c + 1] >= 0;
        is &= state[c] != RB_FRICTION_SLIP_MINUS || u[2 * c + 1] <= 0;
    }
    return is;
}

/* How far r and u of one contact are from Coulomb's law, as a part of their sizes and 1. */
static double off_the_law(double friction, double w, double rn, double rt, double un, double ut)
{
    const double open = fmax(fmax(fabs(rn), fabs(rt)) * w, -un);
    const double stick = fmax(fmax(fabs(un), fabs(ut)), fmax(-rn, fabs(rt) - friction * rn) * w);
    const double slip = fmax(fmax(fabs(un), -rn * w), fabs(rt + copysign(friction * rn, ut)) * w);
    const double size = fmax(1.0, fmax(fmax(fabs(rn), fabs(rt)) * w, fmax(fabs(un), fabs(ut))));
    return fmin(fmin(open, stick), slip) / size;
}

/* W of whole numbers, symmetric or not, mu 1 to 3, contacts in units of their own. */
TEST(all_solutions_are_those_of_fractions)
{
    enum { PROBLEMS = 10000, PARTS = 97 };
    static exact_list list;
    int several = 0, degenerate = 0, undecided = 0, solvers, claims = 0, proved = 0;
    for (int k = 0; k < PROBLEMS; k++) {
        if (!is_in_turn(k, PARTS))
            continue;
        unsigned seed = 11u + 104729u * (unsigned)k;
        for (int l = 0; l < 4; l++)
            uniform_from(&seed);
        const int nc = 1 + k % 4, m = 2 * nc, most = k / 4 % 2 ? 1 : 3;
        int w[8][8], of_q[8], of_mu[4], singular = 0;
        double unit[4];
        for (int i = 0; i < m; i++) {
            of_q[i] = (int)floor((most + 0.5) * (uniform_from(&seed)) + 0.5);
            for (int j = 0; j < m; j++)
                w[i][j] = (int)floor((most + 0.5) * (uniform_from(&seed)) + 0.5);
        }
        for (int i = 0; i < m; i++) {
            for (int j = 0; j < i && k / 8 % 2; j++)
                w[i][j] = w[j][i];
            w[i][i] = 1 + abs(w[i][i]) + (k / 16 % 2 ? 4 : 0);
        }
        for (int c = 0; c < nc; c++) {
            of_mu[c] = 1 + (int)(1.5 * (uniform_from(&seed) + 1.0));
            mu[c] = of_mu[c];
            unit[c] = k % 2 ? exp2(floor(k % 4 == 1 ? 40.0 * uniform_from(&seed)
                                                    : 3.0 * uniform_from(&seed)))
                            : 1.0;
        }
        for (int i = 0; i < m; i++) {
            q[i] = of_q[i] * unit[i / 2];
            for (int j = 0; j < m; j++)
                W[i + j * m] = w[i][j] * unit[i / 2] * unit[j / 2];
        }
        list.count = 0;
        for (int number = 0; number < 1 << (2 * nc); number++) {
            int states[4], regular;
            double r[EXACT_MOST] = {0.0};
            for (int c = 0; c < nc; c++)
                states[c] = number >> (2 * c) & 3;
            if (exact_state(nc, states, w, of_q, of_mu, r, &regular))
                exact_keep(m, r, &list);
            singular += !regular;
        }
        OWNED(rb_friction_solutions) all;
        const rb_friction_problem p = problem(nc);
        CHECK_OK(rb_friction_all(&p, 0.0, &all, &message));
        undecided += all.undecided;
        several += list.count > 1;
        degenerate += all.singular > 0;
        int found = 0;
        for (int a = 0; a < all.count; a++) {
            rb_friction_errors e;
            int is = -1;
            CHECK_OK(rb_friction_error(&p, all.r + a * m, NULL, NULL, &e));
            CHECK_MAX(e.worst, 1e-9, "problem %d, solution %d", k, a);
            for (int b = 0; b < list.count; b++) {
                double apart = 0.0;
                for (int i = 0; i < m; i++)
                    apart = fmax(apart, fabs(all.r[i + a * m] * unit[i / 2] - list.z[b][i]) /
                                            (1e-3 + fabs(list.z[b][i])));
                is = apart < 1e-9 ? b : is;
            }
            found += is >= 0;
            if (is < 0 && !all.singular_state[a])
                fail_msg("problem %d, solution %d: of no regular state", k, a);
        }
        if (found != list.count || (all.singular == 0) != (singular == 0))
            fail_msg("problem %d: %d of %d solutions, %d states singular, there are %d", k, found,
                     list.count, all.singular, singular);
        /* What any solver calls a solution is one, and there is one; what is proved to have
         * none has none. */
        const rb_friction_solver *solver = rb_friction_solvers(&solvers);
        for (int l = 0; l < solvers; l++) {
            double r[8], u[8], off = 0.0, least, given;
            rb_friction_options options = rb_friction_defaults();
            options.max_iters = 3000;
            const rb_status said = rb_friction_solve(solver[l].name, &p, &options,
                                                     &(rb_friction_solution){r, u, NULL}, NULL);
            if (l == 0 && said != RB_OK && rb_friction_has_no_solution(&p, &least, &given)) {
                proved++;
                if (all.count)
                    fail_msg("problem %d: proved to have no solution, and has %d", k, all.count);
            }
            if (said != RB_OK)
                continue;
            for (int c = 0; c < nc; c++)
                off = fmax(off, off_the_law(of_mu[c], w[2 * c][2 * c], r[2 * c] * unit[c],
                                            r[2 * c + 1] * unit[c], u[2 * c] / unit[c],
                                            u[2 * c + 1] / unit[c]));
            claims++;
            if (!all.count || !(off <= 1e-6))
                fail_msg("problem %d: %s says solved, off by %g; there are %d", k, solver[l].name,
                         off, all.count);
        }
    }
    print_message("%d claims of solvers, %d proofs that there is none\n", claims, proved);
    assert_int_equal(undecided, 0);
    assert_true(several > 3 && degenerate > 10);
}

/* ---- Refusals ------------------------------------------------------------------------- */

TEST(what_is_refused_is_named)
{
    rb_friction_solutions all;
    static double many[18 * 18], of_q[18];
    double of_mu[9];
    for (int i = 0; i < 18; i++) {
        many[19 * i] = 1.0;
        of_q[i] = i % 2 ? 0.1 : -1.0;
    }
    for (int c = 0; c < 9; c++)
        of_mu[c] = 0.5;
    rb_friction_problem p = local_with(2, 9, of_mu, many, of_q);
    CHECK_SAYS(rb_friction_all(&p, 0.0, &all, &message), RB_EINVAL,
               "9 contacts: expected at most 8");
    p = local_with(3, 2, of_mu, many, of_q);
    CHECK_SAYS(rb_friction_all(&p, 0.0, &all, &message), RB_EINVAL, "dimension 3");
    memset(many, 0, sizeof many);
    for (int i = 0; i < 14; i++)
        many[15 * i] = 1.0;
    p = local_with(2, 7, of_mu, many, of_q);
    CHECK_STATUS(rb_friction_all(&p, 1e-4, &all, &message), RB_TIME_LIMIT);
    assert_true(all.tried > 0 && all.tried < 16384);
    rb_friction_solutions_free(&all);
    of_q[3] = NAN;
    CHECK_STATUS(rb_friction_all(&p, 0.0, &all, &message), RB_EINVAL);
    of_q[3] = 0.0;
    p = local_with(2, 2, of_mu, many, of_q);
    for (int i = 0, refused = 1; refused; i++) {
        memset(&all, 0, sizeof all);
        refused = REFUSED_FROM(i, rb_friction_all(&p, 0.0, &all, &message));
        rb_friction_solutions_free(&all);
    }
}

RUN_TESTS(NULL, NULL)
