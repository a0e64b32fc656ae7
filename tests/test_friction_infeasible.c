/* Proofs that a friction problem has no solution: each is checked from W and q alone. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

enum { MOST = 90 };

static double W[MOST * MOST], q[MOST], mu[MOST];

static unsigned long long state_of_random = 3;

static double uniform(void)
{
    return uniform_of(&state_of_random);
}

static rb_friction_problem problem(int d, int contacts)
{
    return local_with(d, contacts, mu, W, q);
}

/* What y proves, from the definition: 0 <= y'(W r + q)_N <= y'q_N + miss sum W_NN r_N. */
static double proof(const rb_friction_problem *p, const double *y)
{
    const int d = p->dimension, m = d * p->contacts;
    double load = 0.0, miss = 0.0;
    for (int c = 0; c < p->contacts; c++) {
        double h[3] = {0}, t = 0.0;
        assert_true(y[c] >= 0.0);
        load += y[c] * q[c * d];
        for (int a = 0; a < d; a++)
            for (int e = 0; e < p->contacts; e++)
                h[a] -= y[e] * W[e * d + (c * d + a) * m];
        for (int a = 1; a < d; a++)
            t = hypot(t, h[a]);
        const double own = W[(c * d) * (m + 1)];
        miss = fmax(miss, (mu[c] * t - h[0]) / (own > 1e-12 ? own : 1.0));
    }
    return load >= 0.0 ? 0.0 : miss > 0.0 ? -load / miss : INFINITY;
}

static double given(const rb_friction_problem *p)
{
    double sum = 0.0;
    for (int i = 0; i < p->dimension * p->contacts; i++)
        sum += fabs(q[i]);
    return sum;
}

static void check_infeasible(const rb_friction_problem *p, const char *what)
{
    double y[MOST], least;
    CHECK_OK(rb_friction_infeasible(p, y, &least));
    CHECK_MAX(1e8 * given(p), least, "%s", what);
    CHECK_MAX(1e8 * given(p), proof(p, y), "%s", what);
}

/* Nothing gives way at a contact that closes. */
TEST(nothing_can_push)
{
    memset(W, 0, sizeof W);
    q[0] = -2.0, q[1] = 3.0, mu[0] = 0.5;
    const rb_friction_problem p = problem(2, 1);
    check_infeasible(&p, "W = 0");
}

/* A free body of mass 1 between two walls that close: their normals are opposite. */
TEST(two_walls_close)
{
    for (int d = 2; d <= 3; d++) {
        const int m = 2 * d;
        memset(W, 0, sizeof W);
        for (int a = 0; a < d; a++) {
            W[a * (m + 1)] = W[(d + a) * (m + 1)] = 1.0;
            W[a + (d + a) * m] = W[d + a + a * m] = a ? 1.0 : -1.0;
        }
        for (int k = 0; k < m; k++)
            q[k] = 0.3 * k;
        q[0] = -1.0, q[d] = -0.5, mu[0] = mu[1] = 0.7;
        const rb_friction_problem p = problem(d, 2);
        check_infeasible(&p, "walls");
        q[0] = 0.6; /* one of them opens faster */
        double y[2], least;
        CHECK_OK(rb_friction_infeasible(&p, y, &least));
        CHECK_MAX(least, 1e8 * given(&p), "no proof where there is a solution");
    }
}

/* W = G G' with G' y_N = 0 for a given y >= 0, and y'q_N < 0; without the latter every
 * such problem has a solution, as W is then positive on what q asks for. */
TEST(planted_proofs_are_found)
{
    static double G[MOST * MOST];
    for (int k = 0; k < 40; k++) {
        const int d = 2 + k % 2, nc = 2 + k % 12, m = d * nc, n = m - 1;
        double plan[MOST] = {0}, size = 0.0, load = 0.0;
        for (int c = 0; c < nc; c++) {
            plan[c * d] = fmax(0.0, uniform() + 0.5);
            size += plan[c * d] * plan[c * d];
            mu[c] = 0.5 + 0.5 * uniform();
        }
        if (size == 0.0)
            continue;
        for (int j = 0; j < n; j++) {
            double along = 0.0;
            for (int i = 0; i < m; i++)
                along += (G[i + j * m] = uniform()) * plan[i];
            for (int i = 0; i < m; i++)
                G[i + j * m] -= along / size * plan[i];
        }
        for (int i = 0; i < m; i++) {
            q[i] = uniform();
            load += q[i] * plan[i];
            for (int j = 0; j < m; j++) {
                W[i + j * m] = 0.0;
                for (int l = 0; l < n; l++)
                    W[i + j * m] += G[i + l * m] * G[j + l * m];
            }
        }
        const rb_friction_problem p = problem(d, nc);
        for (int i = 0; i < m; i++)
            q[i] -= (load + 1.0) / size * plan[i];
        check_infeasible(&p, "planted");
        for (int unit = -1; unit <= 1; unit += 2) { /* of the velocities */
            for (int i = 0; i < m; i++)
                q[i] *= unit < 0 ? 0x1p-40 : 0x1p80;
            check_infeasible(&p, "planted, in another unit");
        }
        for (int i = 0; i < m; i++)
            q[i] *= 0x1p-40;
        for (int i = 0; i < m; i++)
            q[i] += 2.0 / size * plan[i];
        double y[MOST], least;
        CHECK_OK(rb_friction_infeasible(&p, y, &least));
        CHECK_MAX(least, 1e8 * given(&p), "problem %d has a solution", k);
    }
}

/* A body of mass 1 between walls that close by `closing`, each contact in a unit of its own. */
static rb_friction_problem walls(int d, double closing, double first, double second)
{
    const int m = 2 * d;
    memset(W, 0, sizeof W);
    for (int a = 0; a < d; a++) {
        W[a * (m + 1)] = first * first;
        W[(d + a) * (m + 1)] = second * second;
        W[a + (d + a) * m] = W[d + a + a * m] = (a ? 1.0 : -1.0) * first * second;
    }
    for (int k = 0; k < m; k++)
        q[k] = 0.3 * k;
    q[0] = -1.0 * first, q[d] = (1.0 - closing) * second, mu[0] = mu[1] = 0.7;
    return problem(d, 2);
}

/* "infeasible" is said where no rounding is in the proof, and not a hair beside it. */
TEST(what_is_proved_is_proved_without_rounding)
{
    double least, given_load;
    for (int d = 2; d <= 3; d++)
        for (int unit = -1; unit <= 1; unit++) {
            const double first = exp2(20.0 * unit), second = exp2(-13.0 * unit);
            rb_friction_problem p = walls(d, 1e-9, first, second);
            assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), 1);
            p = walls(d, 0.0, first, second); /* they just do not close */
            assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), 0);
            p = walls(d, 1e-9, first, second);
            W[0] *= 1.0 + 0x1p-52; /* and a little of the push is left */
            assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), 0);
        }
    /* W_N, 3 bodies in a row between walls: y = 1 everywhere; and one wall pushed twice as far
     * as y = (1, 2): a lever */
    static const double lever[] = {4.0, -2.0, -2.0, 1.0};
    memset(W, 0, sizeof W);
    for (int k = 0; k < 4; k++)
        W[(k / 2 * 2) * 4 + k % 2 * 2] = lever[k] / 3.0;
    mu[0] = mu[1] = 0.0;
    q[0] = 0.9, q[2] = -0.5, q[1] = q[3] = 0.0;
    rb_friction_problem p = problem(2, 2);
    assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), 1);
    q[0] = 1.1;
    assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), 0);
}

/* Masses of 1e10 on 1: a load of 1e11 holds, which the bound of a proof with rounding lies
 * below. */
TEST(a_heavy_body_on_a_light_one_is_not_hopeless)
{
    double least, given_load;
    for (int d = 2; d <= 3; d++)
        for (int k = 6; k <= 16; k++) {
            const int m = 2 * d;
            rb_friction_problem p = walls(d, 0.0, 1.0, 1.0);
            for (int a = 0; a < d; a++) {
                W[a + (d + a) * m] = W[d + a + a * m] = -1.0;
                W[(d + a) * (m + 1)] = 1.0 + pow(10.0, -k);
            }
            memset(q, 0, sizeof q);
            q[0] = -9.81;
            const double rest = W[d * (m + 1)] - 1.0; /* rest r_2 = 9.81 */
            assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), rest == 0.0);
            if (k <= 13)
                CHECK_MAX(least, 2.01 * 9.81 * pow(10.0, k), "the solution obeys the bound");
            /* a mass of 1e14 stands on one of 1; above nothing is claimed */
            double r[6], u[6];
            rb_friction_info info;
            const rb_friction_solution at = {r, u, NULL};
            const rb_status s = rb_friction_solve("auto", &p, NULL, &at, &info);
            assert_int_equal(s == RB_OK || s == RB_INACCURATE, k <= 14);
            if (k > 14)
                continue;
            CHECK_REL(r[d], 9.81 / rest, 1e-5, "k = %d by %s", k, info.solver);
            CHECK_REL(r[0], r[d] + 9.81, 1e-5, "k = %d by %s", k, info.solver);
        }
}

/* The same walls around a body that is free in the plane: H' = [1 0; 0 1; -1 0; 0 1]. */
TEST(a_global_problem_without_solution)
{
    for (int closes = 0; closes < 2; closes++) {
        OWNED(rb_friction_problem) p = zero_global(2, 2, 2);
        rb_triplets K = {.rows = 2, .cols = 2}, H = {.rows = 2, .cols = 4};
        double least, given_load;
        for (int i = 0; i < 2; i++) {
            rb_triplets_add(&K, i, i, 0.7);
            rb_triplets_add(&H, i, i, 0.3);
            rb_triplets_add(&H, i, 2 + i, i ? 0.3 : -0.3);
            p.mu[i] = 0.4;
        }
        CHECK_OK(rb_sparse_from_triplets(&K, &p.K));
        CHECK_OK(rb_sparse_from_triplets(&H, &p.H));
        rb_triplets_free(&K);
        rb_triplets_free(&H);
        p.w[0] = -0.2;
        p.w[2] = closes ? 0.1 : 0.3;
        p.f[0] = 0.123;
        assert_int_equal(rb_friction_has_no_solution(&p, &least, &given_load), closes);
    }
}

/* A block without stiffness on a floor, of d coordinates, N first; `unit` of its contact.  It is
 * pushed by `along` and pressed by `down`.  Beside it two masses on a spring, held by nothing. */
static int block_floats(int d, double unit, double along, double down, double friction)
{
    OWNED(rb_friction_problem) p = zero_global(d, 1, d + 2);
    rb_triplets K = {.rows = d + 2, .cols = d + 2}, H = {.rows = d + 2, .cols = d};
    int floats;
    for (int i = 0; i < d; i++)
        rb_triplets_add(&H, i, i, unit);
    for (int i = 0; i < 2; i++) {
        rb_triplets_add(&K, d + i, d + i, 0.3);
        rb_triplets_add(&K, d + i, d + 1 - i, -0.3);
    }
    CHECK_OK(rb_sparse_from_triplets(&K, &p.K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p.H));
    rb_triplets_free(&K);
    rb_triplets_free(&H);
    p.mu[0] = friction;
    p.f[0] = -down;
    p.f[d - 1] = along;
    p.f[d] = 0.125, p.f[d + 1] = -0.125;
    p.w[0] = 0.2;
    CHECK_OK(rb_friction_floats(&p, &floats));
    if (floats)
        return floats;
    p.f[d] += 0x1p-20; /* and not a hair more on the spring */
    CHECK_OK(rb_friction_floats(&p, &floats));
    assert_int_equal(floats, 1);
    return 0;
}

/* Said where nothing holds, and not where friction just holds. */
TEST(what_nothing_holds_has_no_equilibrium)
{
    for (int d = 2; d <= 3; d++)
        for (int k = -1; k <= 1; k++) {
            const double unit = exp2(30.0 * k);
            assert_int_equal(block_floats(d, unit, 0.0, -1.0, 0.3), 1); /* lifted */
            assert_int_equal(block_floats(d, unit, 0.31, 1.0, 0.3), 1); /* pushed away */
            assert_int_equal(block_floats(d, unit, -0.31, 1.0, 0.3), 1);
            assert_int_equal(block_floats(d, unit, 1e-3, 1.0, 0.0), 1);
            assert_int_equal(block_floats(d, unit, 0.29, 1.0, 0.3), 0);
            assert_int_equal(block_floats(d, unit, 0.5, 1.0, 0.5), 0);
            assert_int_equal(block_floats(d, unit, 0.0, 1.0, 0.0), 0);
            assert_int_equal(block_floats(d, unit, 0.0, 0.0, 0.3), 0);
        }
}

TEST(global_problems_are_condensed_first)
{
    double y[1], least;
    rb_friction_problem p = problem(2, 1);
    p.form = RB_FRICTION_GLOBAL;
    CHECK_STATUS(rb_friction_infeasible(&p, y, &least), RB_EINVAL);
}

TEST(short_memory_is_reported)
{
    memset(W, 0, sizeof W);
    q[0] = -2.0, q[1] = 3.0, mu[0] = 0.5;
    const rb_friction_problem p = problem(2, 1);
    for (int i = 0, refused = 1; refused; i++) {
        double y[1], least;
        refused = REFUSED_FROM(i, rb_friction_infeasible(&p, y, &least));
    }
}

RUN_TESTS(NULL, NULL)
