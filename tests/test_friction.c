/* The problem, its measure, and Newton on both forms. */
#include "check.h"
#include "lcp/friction/friction.h"
#include "numbers.h"
#include "friction_problems.h"

/* Equation (13), written down a second time: by the disjunction of *Acary* (2) for the
 * projection instead of the library's formula. */
static double measure_again(int d, int nc, const double *mu, const double *r, const double *u,
                            const double *q)
{
    double sum = 0.0, norm = 0.0;
    for (int c = 0; c < nc; c++) {
        const double *rc = r + c * d, *uc = u + c * d, m = mu[c];
        double z[3] = {0}, p[3] = {0}, t = 0.0, s = 0.0;
        for (int a = 1; a < d; a++)
            s += uc[a] * uc[a];
        z[0] = rc[0] - uc[0] - m * sqrt(s);
        for (int a = 1; a < d; a++)
            z[a] = rc[a] - uc[a], t += z[a] * z[a];
        t = sqrt(t);
        if (z[0] >= 0.0 && t <= m * z[0]) {
            memcpy(p, z, sizeof p);
        } else if (z[0] > -m * t) {
            /* foot of the perpendicular on the ray (1, m z_T/t) */
            const double along = (z[0] + m * t) / (1.0 + m * m);
            p[0] = along;
            for (int a = 1; a < d; a++)
                p[a] = along * m * z[a] / t;
        }
        for (int a = 0; a < d; a++) {
            sum += (rc[a] - p[a]) * (rc[a] - p[a]);
            norm += q[c * d + a] * q[c * d + a];
        }
    }
    return sqrt(sum / norm);
}

/* A local problem with a planted solution: W = B B' + I/2 (m x m), contact by contact
 * separated, stuck or slipping, q = u - W r. */
static void plant(int d, int nc, unsigned seed, rb_friction_problem *p, double *r)
{
    const int m = d * nc;
    *p = zero_local(d, nc);
    SCRATCH double *B = rb_alloc((size_t)m, (size_t)m);
    for (int k = 0; k < m * m; k++)
        B[k] = uniform_from(&seed) / sqrt(m);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            p->W[i + j * m] = 0.5 * (i == j);
            for (int k = 0; k < m; k++)
                p->W[i + j * m] += B[i + k * m] * B[j + k * m];
        }
    for (int c = 0; c < nc; c++) {
        double *rc = r + c * d, *uc = p->q + c * d, dir[2], t = 0.0;
        p->mu[c] = 0.1 + 0.4 * fabs(uniform_from(&seed));
        for (int a = 0; a < d - 1; a++)
            dir[a] = uniform_from(&seed), t = hypot(t, dir[a]);
        memset(rc, 0, (size_t)d * sizeof *rc);
        switch (c % 3) {
        case 0: /* separated */
            for (int a = 0; a < d; a++)
                uc[a] = a ? dir[a - 1] : 0.3;
            break;
        case 1: /* stuck */
            rc[0] = 1.0;
            for (int a = 1; a < d; a++)
                rc[a] = 0.6 * p->mu[c] * dir[a - 1] / t;
            break;
        default: /* slipping */
            rc[0] = 2.0;
            for (int a = 1; a < d; a++) {
                rc[a] = p->mu[c] * 2.0 * dir[a - 1] / t;
                uc[a] = -0.7 * dir[a - 1] / t;
            }
        }
    }
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++)
            p->q[i] -= p->W[i + j * m] * r[j];
}

/* 1e-14 of the sums |q| + |W| |r|, as (13) counts them. */
static double floor_again(const rb_friction_problem *p, const double *r)
{
    const int m = p->dimension * p->contacts;
    double sums = 0.0, size = 0.0;
    for (int i = 0; i < m; i++) {
        double sum = fabs(p->q[i]);
        for (int j = 0; j < m; j++)
            sum += fabs(p->W[i + j * m] * r[j]);
        sums += sum * sum;
        size += p->q[i] * p->q[i];
    }
    return 1e-14 * sqrt(sums / size);
}

TEST(the_measure_is_equation_13)
{
    unsigned seed = 3;
    for (int d = 2; d <= 3; d++) {
        enum { NC = 7 };
        OWNED(rb_friction_problem) p;
        double r[3 * NC], u[3 * NC];
        rb_friction_errors error, same;
        plant(d, NC, 5, &p, r);
        CHECK_OK(rb_friction_error(&p, r, NULL, u, &error));
        CHECK_MAX(error.residual, 1e-14, "planted solution, d = %d", d);
        CHECK_REL(error.floor, floor_again(&p, r), 1e-12, "floor, d = %d", d);
        for (int trial = 0; trial < 50; trial++) {
            for (int k = 0; k < d * NC; k++)
                r[k] = 3.0 * uniform_from(&seed);
            CHECK_OK(rb_friction_error(&p, r, NULL, u, &error));
            for (int i = 0; i < d * NC; i++) {
                double want = p.q[i];
                for (int j = 0; j < d * NC; j++)
                    want += p.W[i + j * d * NC] * r[j];
                CHECK_ABS(u[i], want, 1e-12, "u = W r + q, row %d", i);
            }
            CHECK_REL(error.residual, measure_again(d, NC, p.mu, r, u, p.q), 1e-12, "trial %d",
                      trial);
        }
        make_sparse(&p);
        CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &same));
        CHECK_REL(same.residual, error.residual, 1e-13, "sparse W");
        CHECK_REL(same.floor, floor_again(&p, r), 1e-12, "floor of a sparse W");
    }
}

/* Two springs in series per contact: n = 2 m, K = blocks [2 -1; -1 1 + held/..], H picks
 * the outer ends.  held 0: chains of free bodies, K singular. */
static void series_of_springs(int d, int nc, double held, rb_friction_problem *p)
{
    const int m = d * nc, n = 2 * m;
    OWNED(rb_triplets) K = {.rows = n, .cols = n}, H = {.rows = n, .cols = m};
    *p = zero_global(d, nc, n);
    for (int k = 0; k < m; k++) {
        const int i = 2 * k, j = 2 * k + 1;
        rb_triplets_add(&K, i, i, 1.0 + held);
        rb_triplets_add(&K, i, j, -1.0);
        rb_triplets_add(&K, j, i, -1.0);
        rb_triplets_add(&K, j, j, 1.0);
        rb_triplets_add(&H, j, k, 1.0);
    }
    CHECK_OK(rb_sparse_from_triplets(&K, &p->K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
    for (int c = 0; c < nc; c++) {
        p->mu[c] = 0.5;
        /* pressed down by 1, pulled along T1 by 0.2 (sticks), 0.8 (slips); lifted */
        p->f[2 * c * d] = c % 3 == 2 ? 0.4 : -1.0;
        p->f[2 * (c * d + 1)] = c % 3 == 1 ? 0.8 : 0.2;
        p->w[c * d + 1] = 0.01 * c;
    }
}

TEST(condensation_gives_the_same_problem)
{
    enum { NC = 6, M = 3 * NC };
    OWNED(rb_friction_problem) p, local;
    rb_friction_info info;
    double r[M], u[M], v[2 * M], r2[M], u2[M];
    series_of_springs(3, NC, 1.0, &p);
    CHECK_OK(rb_friction_condense(&p, &local, &message));
    /* springs in series: W = 2, q = w + f */
    for (int j = 0; j < M; j++) {
        assert_int_equal(local.Ws.p[j + 1] - local.Ws.p[j], 1);
        CHECK_REL(local.Ws.x[j], 2.0, 1e-14, "W[%d]", j);
        CHECK_ABS(local.q[j], p.w[j] + p.f[2 * j], 1e-14, "q[%d]", j);
    }
    rb_friction_options opt = rb_friction_defaults();
    opt.tol = 1e-14;
    CHECK_OK(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, u, v}, &info));
    CHECK_OK(
        rb_friction_solve("nsn-ac", &local, &opt, &(rb_friction_solution){r2, u2, NULL}, &info));
    for (int k = 0; k < M; k++) {
        CHECK_ABS(r[k], r2[k], 1e-12, "r[%d]", k);
        CHECK_ABS(u[k], u2[k], 1e-12, "u[%d]", k);
    }
    CHECK_REL(measure_again(3, NC, p.mu, r, u, local.q) + 1.0, 1.0, 1e-12, "by hand");
    r[0] += 0.1;
    rb_friction_errors error, local_error;
    CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &error));
    CHECK_OK(rb_friction_error(&local, r, NULL, NULL, &local_error));
    CHECK_REL(error.residual, local_error.residual, 1e-12, "(13) on both forms");
}

/* Chains of `size` springs, held at one end with stiffness 1, touched at the other ends;
 * K of one chain is tridiagonal, and K^-1 at its end is 1 + (size - 1). */
static void chains(int size, int nc, rb_friction_problem *p)
{
    const int m = 2 * nc, n = m * size;
    OWNED(rb_triplets) K = {.rows = n, .cols = n}, H = {.rows = n, .cols = m};
    *p = zero_global(2, nc, n);
    for (int k = 0; k < m; k++) {
        const int last = (k + 1) * size - 1;
        for (int at = k * size; at <= last; at++) {
            rb_triplets_add(&K, at, at, at < last ? 2.0 : 1.0);
            if (at < last) {
                rb_triplets_add(&K, at, at + 1, -1.0);
                rb_triplets_add(&K, at + 1, at, -1.0);
            }
        }
        rb_triplets_add(&H, last, k, 1.0);
        p->f[last] = k % 2 ? 0.2 * (k % 5) : -1.0;
    }
    CHECK_OK(rb_sparse_from_triplets(&K, &p->K));
    CHECK_OK(rb_sparse_from_triplets(&H, &p->H));
    for (int c = 0; c < nc; c++)
        p->mu[c] = 0.3;
}

/* Masses (one degree of freedom), bodies inverted densely and bodies for CHOLMOD. */
TEST(bodies_of_every_size_are_condensed)
{
    static const int sizes[] = {1, 2, 6, 12, 13, 40};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        rb_friction_problem p, local;
        chains(sizes[s], 5, &p);
        CHECK_OK(rb_friction_condense(&p, &local, &message));
        for (int j = 0; j < 10; j++) {
            assert_int_equal(local.Ws.p[j + 1] - local.Ws.p[j], 1);
            CHECK_REL(local.Ws.x[j], (double)sizes[s], 1e-12, "W of %d", sizes[s]);
            CHECK_ABS(local.q[j], sizes[s] * p.f[(j + 1) * sizes[s] - 1], 1e-10, "q");
        }
        rb_friction_problem_free(&local);
        p.K.x[0] = 0.0; /* the first mass is gone; longer chains lose their hold */
        if (sizes[s] == 1)
            CHECK_STATUS(rb_friction_condense(&p, &local, &message), RB_SINGULAR);
        rb_friction_problem_free(&p);
    }
}

/* The same structure under other loads: as if each were solved by itself. */
TEST(a_handle_solves_one_load_after_another)
{
    for (int global = 0; global < 2; global++) {
        OWNED(rb_friction_problem) p;
        rb_friction_handle *handle;
        rb_friction_info warm, cold;
        double r[90], u[90], r2[90], u2[90], planted[90];
        if (global)
            chains(3, 20, &p);
        else
            plant(2, 20, 9, &p, planted);
        const int m = 2 * p.contacts;
        CHECK_OK(rb_friction_setup(&p, &handle, &message));
        for (int load = 0; load < 4; load++) {
            static const char *const solvers[] = {"nsgs-ac", "auto", "nsgs-ac", "nsgs-aa"};
            for (int k = 0; load && k < m; k++)
                *(global ? &p.w[k] : &p.q[k]) += 1e-3 * (k % 7);
            p.mu[load] *= 0.9;
            CHECK_OK(rb_friction_update(handle, &message));
            CHECK_OK(rb_friction_handle_solve(handle, solvers[load], NULL,
                                              &(rb_friction_solution){r, u, NULL}, &warm));
            CHECK_OK(rb_friction_solve(solvers[load], &p, NULL,
                                       &(rb_friction_solution){r2, u2, NULL}, &cold));
            for (int k = 0; k < m; k++)
                CHECK_ABS(r[k], r2[k], 1e-6, "load %d, r[%d]", load, k);
            assert_true(warm.iters <= cold.iters);
        }
        /* solved already: nothing is left to do */
        CHECK_OK(rb_friction_handle_solve(handle, "nsgs-ac", NULL,
                                          &(rb_friction_solution){r, u, NULL}, &warm));
        assert_int_equal(warm.iters, 0);
        p.mu[0] = -1.0;
        CHECK_STATUS(rb_friction_update(handle, &message), RB_EINVAL);
        rb_friction_handle_free(handle);
        CHECK_STATUS(rb_friction_setup(&p, &handle, &message), RB_EINVAL);
        assert_null(handle);
    }
    rb_friction_handle_free(NULL);
}

TEST(a_structure_held_by_friction_alone_is_solved)
{
    enum { NC = 2, M = 3 * NC, N = 2 * M };
    rb_friction_problem p, local;
    rb_friction_info info;
    rb_friction_facts facts;
    double r[M], u[M], v[N];
    rb_friction_errors error;
    series_of_springs(3, NC, 0.0, &p);
    p.f[2 * 4] = 0.3; /* contact 2 sticks too */
    CHECK_SAYS(rb_friction_condense(&p, &local, &message), RB_SINGULAR, "nullity 6");
    CHECK_OK(rb_friction_examine(&p, 1, &facts));
    assert_int_equal(facts.nullity, 6);
    assert_int_equal(facts.rank, 6);
    assert_int_equal(facts.hyperstaticity, 0);
    CHECK_OK(rb_friction_solve("nsn-ac", &p, NULL, &(rb_friction_solution){r, u, v}, &info));
    /* every force goes through to the ground: r = -f */
    for (int c = 0; c < NC; c++)
        for (int a = 0; a < 3; a++)
            CHECK_ABS(r[3 * c + a], -p.f[2 * (3 * c + a)], 1e-10, "contact %d, %d", c, a);
    CHECK_OK(rb_friction_error(&p, r, v, u, &error));
    CHECK_MAX(error.residual, 1e-8, "measure");
    v[1] += 1e-3; /* a displacement that the forces do not balance counts */
    CHECK_OK(rb_friction_error(&p, r, v, u, &error));
    assert_true(error.residual > 1e-5);

    /* a motion that no contact sees: the message says so */
    rb_sparse_free(&p.H);
    CHECK_OK(rb_sparse_from_triplets(&(rb_triplets){.rows = N, .cols = M}, &p.H));
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, NULL, &(rb_friction_solution){r, u, v}, &info),
                 RB_SINGULAR);
    assert_non_null(strstr(info.msg.text, "without any velocity at the contacts"));
    rb_friction_problem_free(&p);
}

/* Every Newton method on planted problems, dense and sparse, from its own residual. */
TEST(newton_solves_planted_problems)
{
    const char *names[] = {"nsn-ac", "nsn-jm",     "nsn-nm",     "nsn-fb",
                           "auto",   "nsn-ac-nls", "nsn-jm-nls", "nsn-fb-nls"};
    for (int d = 2; d <= 3; d++)
        for (int nc = 1; nc <= 45; nc += 22)
            for (size_t s = 0; s < sizeof names / sizeof *names; s++) {
                OWNED(rb_friction_problem) p;
                rb_friction_info info;
                double r[135], u[135], planted[135];
                plant(d, nc, 7u + (unsigned)nc, &p, planted);
                if (nc > 40)
                    make_sparse(&p);
                CHECK_OK(rb_friction_solve(names[s], &p, NULL, &(rb_friction_solution){r, u, NULL},
                                           &info));
                CHECK_MAX(measure_again(d, nc, p.mu, r, u, p.q), 1.0001e-8, "%s d %d nc %d",
                          names[s], d, nc);
                CHECK_ABS(info.residual, measure_again(d, nc, p.mu, r, u, p.q), 1e-13, "%s",
                          names[s]);
                assert_true(info.flops > 0.0 && (info.iters > 0 || nc == 1));
            }
}

TEST(facts_are_reported)
{
    OWNED(rb_friction_problem) p;
    rb_friction_facts facts;
    double r[9];
    plant(3, 3, 4, &p, r);
    CHECK_OK(rb_friction_examine(&p, 1, &facts));
    assert_int_equal(facts.rank, 9);
    assert_int_equal(facts.indefinite, 0);
    CHECK_MAX(facts.asymmetry, 1e-14, "symmetric W");
    p.W[1] += 0.5;
    p.W[80] = -1.0;
    CHECK_OK(rb_friction_examine(&p, 1, &facts));
    assert_int_equal(facts.indefinite, 1);
    assert_true(facts.asymmetry > 0.05);
    for (int k = 0; k < 9; k++)
        p.W[8 + 9 * k] = p.W[k * 9 + 8] = 0.0;
    CHECK_OK(rb_friction_examine(&p, 1, &facts));
    assert_int_equal(facts.rank, 8);
    assert_int_equal(facts.hyperstaticity, 1);
}

TEST(zero_q_has_the_trivial_solution)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    double r[6], u[6];
    plant(2, 3, 4, &p, r);
    memset(p.q, 0, 6 * sizeof *p.q);
    CHECK_OK(rb_friction_solve("auto", &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
    for (int k = 0; k < 6; k++)
        CHECK_ABS(r[k], 0.0, 0.0, "r[%d]", k);
    CHECK_ABS(info.residual, 0.0, 0.0, "residual");
}

static void refuse(rb_friction_problem *p, const char *words)
{
    rb_friction_info info;
    double r[9], u[9];
    CHECK_STATUS(rb_friction_solve("nsn-ac", p, NULL, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_EINVAL);
    if (!strstr(info.msg.text, words))
        fail_msg("'%s' lacks '%s'", info.msg.text, words);
}

TEST(bad_problems_are_refused)
{
    rb_friction_problem p;
    rb_friction_info info;
    rb_friction_options opt = rb_friction_defaults();
    double r[9], u[9];
    plant(3, 3, 4, &p, r);
    p.dimension = 4;
    refuse(&p, "dimension 4");
    p.dimension = 3, p.contacts = 0;
    refuse(&p, "0 contacts");
    p.contacts = 3, p.mu[1] = -0.1;
    refuse(&p, "contact 2");
    p.mu[1] = NAN;
    refuse(&p, "mu: entry 2");
    p.mu[1] = 0.1, p.W[7] = INFINITY;
    refuse(&p, "W: entry 8");
    p.W[7] = 0.0, p.q[0] = NAN;
    refuse(&p, "q: entry 1");
    p.q[0] = 1.0;
    make_sparse(&p);
    p.Ws.cols = 8;
    refuse(&p, "9 x 8");
    p.Ws.cols = 9;
    CHECK_STATUS(rb_friction_solve("newton", &p, NULL, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "'newton'"));
    opt.tol = 0.0;
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_EINVAL);
    rb_friction_problem_free(&p);

    series_of_springs(2, 1, 1.0, &p);
    p.K.x[1] = 5.0;
    refuse(&p, "not symmetric");
    p.K.x[1] = -1.0, p.dofs = 3;
    refuse(&p, "K is 4 x 4");
    p.dofs = 0;
    refuse(&p, "0 degrees of freedom");
    p.dofs = 4;
    double *entries = p.H.x;
    p.H.x = NULL;
    refuse(&p, "H is missing");
    p.H.x = entries;
    free(p.f);
    p.f = NULL;
    refuse(&p, "f is missing");
    rb_friction_problem_free(&p);
    rb_friction_problem_free(NULL);
}

/* Without friction K is a half-line.  A contact that pulls with just the force that
 * closes it, u = 0, is no solution, though the point (-1, 0) has ||z_T|| <= 0 z_N in
 * floating point: 0 <= -0. */
TEST(a_frictionless_contact_does_not_pull)
{
    for (int d = 2; d <= 3; d++) {
        double W[9] = {0.0}, q[3] = {1.0}, mu[1] = {0.0}, pulls[3] = {-1.0}, r[3], u[3];
        for (int a = 0; a < d; a++)
            W[a * (d + 1)] = 1.0;
        const rb_friction_problem p = local_with(d, 1, mu, W, q);
        rb_friction_errors error;
        CHECK_OK(rb_friction_error(&p, pulls, NULL, NULL, &error));
        CHECK_ABS(error.residual, 1.0, 1e-15, "it pulls");
        rb_friction_options opt = rb_friction_defaults();
        opt.r0 = pulls;
        int count;
        const rb_friction_solver *all = rb_friction_solvers(&count);
        for (int k = 0; k < count; k++) {
            if (d == 3 && (all[k].needs & RB_FRICTION_ONLY_2D))
                continue;
            CHECK_OK(rb_friction_solve(all[k].name, &p, &opt, &(rb_friction_solution){r, u, NULL},
                                       NULL));
            CHECK_ABS(r[0], 0.0, 1e-7, "%s", all[k].name);
        }
    }
}

TEST(success_is_never_claimed_above_the_tolerance)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    rb_friction_options opt = rb_friction_defaults();
    double r[30], u[30], planted[30];
    plant(3, 10, 4, &p, planted);
    opt.max_iters = 1;
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_MAXITER);
    assert_true(info.residual > opt.tol);
    assert_string_equal(rb_friction_status_text(RB_MAXITER, opt.tol, &info), "iteration limit");
    /* from the solution: nothing to do; a tolerance below rounding: solved to rounding */
    opt.r0 = planted, opt.tol = 1e-300;
    CHECK_OK(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, u, NULL}, &info));
    assert_int_equal(info.iters, 0);
    assert_string_equal(rb_friction_status_text(RB_OK, opt.tol, &info), "solved-to-rounding");
    opt.r0 = NULL, opt.tol = 1e-8, opt.max_iters = 0, opt.seconds = 1e-9;
    CHECK_STATUS(rb_friction_solve("nsn-ac", &p, &opt, &(rb_friction_solution){r, u, NULL}, &info),
                 RB_INTERRUPTED);
}

/* The number of allocations of a solve, each of which has failed once. */
static int fail_each(const char *solver, const rb_friction_problem *p)
{
    rb_friction_info info;
    double r[9], u[9];
    int count = 0;
    for (rb_status s = RB_ENOMEM; s != RB_OK && count < 400; count++) {
        alloc_fail_after(count);
        s = rb_friction_solve(solver, p, NULL, &(rb_friction_solution){r, u, NULL}, &info);
        const int refused = alloc_failed();
        alloc_succeed();
        assert_true(s == RB_OK || refused);
    }
    return count;
}

typedef struct {
    const char *solver;
    const rb_friction_problem *p;
} job;

static rb_status solve_anew(void *context)
{
    const job *own = context;
    double r[9], u[9];
    return rb_friction_solve(own->solver, own->p, NULL, &(rb_friction_solution){r, u, NULL}, NULL);
}

/* Each alone, where the ones after it succeed. */
TEST(each_failing_allocation_is_reported)
{
    static const char *const names[] = {
        "auto",    "nsn-ac",      "nsn-fb",        "nsn-ac-hybrid",    "nsgs-ac", "nsgs-aa",
        "nsgs-fp", "fixed-point", "extragradient", "soclcp-smoothing", "admm"};
    rb_friction_problem p[3];
    double r[9];
    int calls = 0;
    plant(3, 3, 4, &p[0], r);
    plant(3, 3, 4, &p[1], r);
    make_sparse(&p[1]);
    series_of_springs(3, 2, 1.0, &p[2]);
    for (int k = 0; k < 3; k++) {
        for (size_t i = 0; i < sizeof names / sizeof *names; i++)
            calls += alloc_fail_each(solve_anew, &(job){names[i], &p[k]});
        rb_friction_problem_free(&p[k]);
    }
    assert_true(calls > 10);
}

TEST(failing_allocations_are_reported)
{
    static const char *const solvers[] = {"auto",    "nsn-ac",      "nsn-ac-hybrid",
                                          "nsgs-ac", "fixed-point", "soclcp-smoothing"};
    rb_friction_problem p[2];
    double r[9];
    plant(3, 3, 4, &p[0], r);
    series_of_springs(3, 2, 1.0, &p[1]);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) {
            const int count = fail_each(solvers[i], &p[k]);
            if (count <= 3 || count >= 400)
                print_error("%s: %d allocations\n", solvers[i], count);
            assert_true(count > 3 && count < 400);
        }
        rb_friction_problem_free(&p[k]);
    }
}

RUN_TESTS(NULL, NULL)
