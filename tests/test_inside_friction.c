/* What the friction solvers are made of: one contact alone, W in blocks, one Newton step,
 * pauses, smoothed projections. */
#include "check.h"
#include "lcp/friction/internal.h"
#include "lcp/friction/smoothing.h"
#include "packing.h"
#include "numbers.h"
#include "friction_problems.h"

/* A A' + shift, with a part that is not symmetric */
static void positive_definite(int d, double unsymmetric, unsigned *seed, double *W)
{
    double a[9];
    for (int k = 0; k < d * d; k++)
        a[k] = uniform_from(seed);
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            W[i + j * d] = (i == j) * 0.1 + unsymmetric * (i < j ? 1.0 : -1.0) * (i != j);
            for (int k = 0; k < d; k++)
                W[i + j * d] += a[i + k * d] * a[j + k * d];
        }
}

static void velocity(int d, const double *W, const double *q, const double *r, double *u)
{
    for (int a = 0; a < d; a++) {
        u[a] = q[a];
        for (int b = 0; b < d; b++)
            u[a] += W[a + b * d] * r[b];
    }
}

/* How far (r, u) is from Coulomb's law, u = W r + q */
static double violation(int d, double mu, const double *r, const double *u)
{
    const double rt = d == 2 ? fabs(r[1]) : hypot(r[1], r[2]);
    const double ut = d == 2 ? fabs(u[1]) : hypot(u[1], u[2]);
    double power = mu * r[0] * ut;
    for (int a = 1; a < d; a++)
        power += r[a] * u[a];
    return fmax(fmax(fmax(-r[0], -u[0]), rt - mu * r[0]), fmax(fabs(r[0] * u[0]), fabs(power)));
}

TEST(one_contact_obeys_coulomb)
{
    unsigned seed = 5;
    int states[3] = {0, 0, 0}; /* open, stuck, sliding */
    for (int k = 0; k < 6000; k++) {
        const int d = 2 + k % 2;
        const double mu = k % 11 ? fabs(uniform_from(&seed)) : 0.0;
        double W[9], q[3], r[3] = {0.0, 0.0, 0.0}, u[3];
        rb_friction_contact c;
        positive_definite(d, k % 3 ? 0.0 : 1e-2, &seed, W);
        rb_friction_contact_init(d, mu, W, &c);
        double lambda = 0.0; /* then of the time before */
        for (int again = 0; again < 3; again++) {
            for (int a = 0; a < d; a++)
                q[a] = uniform_from(&seed) - (a == 0) * 0.5;
            const int steps = rb_friction_contact_exact(&c, &lambda, q, r);
            assert_true(steps > 0 && steps < 20);
            velocity(d, W, q, r, u);
            CHECK_MAX(violation(d, mu, r, u), 1e-11, "contact %d, d = %d, mu = %g", k, d, mu);
            const double rt = d == 2 ? fabs(r[1]) : hypot(r[1], r[2]);
            states[r[0] == 0.0 ? 0 : rt < mu * r[0] * (1.0 - 1e-9) ? 1 : 2]++;
        }
    }
    assert_true(states[0] > 500 && states[1] > 500 && states[2] > 500);
}

/* Compliances 2^-40 times as large carry 2^40 times the force, to the last bit; the root
 * lambda is a compliance. */
TEST(one_contact_has_no_unit)
{
    unsigned seed = 7;
    for (int k = 0; k < 500; k++) {
        const int d = 2 + k % 2;
        double W[9], q[3], r[3] = {0.0}, scaled[3] = {0.0}, lambda = 0.0, small = 0.0;
        rb_friction_contact c;
        positive_definite(d, k % 3 ? 0.0 : 1e-2, &seed, W);
        for (int a = 0; a < d; a++)
            q[a] = uniform_from(&seed) - (a == 0) * 0.5;
        rb_friction_contact_init(d, 0.3, W, &c);
        rb_friction_contact_exact(&c, &lambda, q, r);
        for (int a = 0; a < d * d; a++)
            W[a] *= 0x1p-40;
        rb_friction_contact_init(d, 0.3, W, &c);
        rb_friction_contact_exact(&c, &small, q, scaled);
        for (int a = 0; a < d; a++)
            CHECK_ABS(0x1p-40 * scaled[a], r[a], 0.0, "contact %d: r[%d]", k, a);
        CHECK_ABS(0x1p40 * small, lambda, 0.0, "contact %d: lambda", k);
    }
}

/* Elimination and Newton on Alart-Curnier's function are two ways to the same force. */
TEST(elimination_agrees_with_newton)
{
    unsigned seed = 7;
    for (int k = 0; k < 200; k++) {
        const int d = 2 + k % 2;
        double W[9], q[3], r[3] = {0.0, 0.0, 0.0}, s[3] = {0.0, 0.0, 0.0};
        rb_friction_contact c;
        positive_definite(d, 0.0, &seed, W);
        rb_friction_contact_init(d, 0.3, W, &c);
        for (int a = 0; a < d; a++)
            q[a] = a ? uniform_from(&seed) : -0.3 - fabs(uniform_from(&seed));
        const double rho[] = {1.0 / W[0], 1.0 / (W[d + 1] + (d == 3 ? W[8] : 0.0))};
        double lambda = 0.0;
        assert_true(rb_friction_contact_exact(&c, &lambda, q, r) > 0);
        assert_true(rb_friction_contact_newton(&c, rho, q, s) > 0);
        for (int a = 0; a < d; a++)
            CHECK_ABS(s[a], r[a], 1e-7, "contact %d, r[%d]", k, a);
    }
}

/* A block need not be symmetric: stick and sliding to either side, and Newton's steps. */
TEST(newton_obeys_coulomb_with_unsymmetric_blocks)
{
    unsigned seed = 11;
    int states[3] = {0, 0, 0};
    for (int k = 0; k < 1200; k++) {
        const int d = 2 + k % 2;
        double W[9], q[3], r[3] = {0.0, 0.0, 0.0}, u[3];
        rb_friction_contact c;
        positive_definite(d, 0.15, &seed, W);
        rb_friction_contact_init(d, 0.4, W, &c);
        for (int a = 0; a < d; a++)
            q[a] = a ? 2.0 * uniform_from(&seed) : -0.2 - fabs(uniform_from(&seed));
        const double rho[] = {1.0 / W[0], 1.0 / W[d + 1]};
        assert_true(rb_friction_contact_newton(&c, rho, q, r) > 0);
        velocity(d, W, q, r, u);
        CHECK_MAX(violation(d, 0.4, r, u), 1e-9, "contact %d, d = %d", k, d);
        const double rt = d == 2 ? r[1] : hypot(r[1], r[2]);
        states[fabs(rt) < 0.4 * r[0] * (1.0 - 1e-9) ? 0 : rt < 0.0 ? 1 : 2]++;
    }
    assert_true(states[0] > 100 && states[1] > 100 && states[2] > 100);
}

TEST(a_singular_block_is_left_to_newton)
{
    const double loose[] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0};
    const double upside_down[] = {-1.0, 0.0, 0.0, 1.0};
    const double q[] = {-1.0, 0.2, 0.1}, away[] = {0.0, 1.0, 2.0};
    double r[] = {7.0, 8.0, 9.0}, lambda = 0.0;
    rb_friction_contact c;
    rb_friction_contact_init(3, 0.3, loose, &c);
    assert_int_equal(rb_friction_contact_exact(&c, &lambda, q, r), 0);
    CHECK_ABS(r[0], 7.0, 0.0, "r as it was");
    rb_friction_contact_init(2, 0.3, upside_down, &c);
    assert_int_equal(rb_friction_contact_exact(&c, &lambda, q, r), 0);
    assert_int_equal(rb_friction_contact_exact(&c, &lambda, away, r), 1); /* open all the same */
    CHECK_ABS(r[0], 0.0, 0.0, "it opens");
}

/* nc contacts, about a third of the blocks, one of them on the diagonal empty */
static void random_problem(int d, int nc, unsigned *seed, rb_friction_problem *p)
{
    const int m = d * nc;
    *p = (rb_friction_problem){.form = RB_FRICTION_LOCAL_DENSE,
                               .dimension = d,
                               .contacts = nc,
                               .W = rb_alloc((size_t)m, (size_t)m)};
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++)
            if ((i / d + 2 * (j / d)) % 3 == 0 && i / d + j / d != 2)
                p->W[i + j * m] = (i + j) % 4 ? uniform_from(seed) : 0.0;
}

TEST(blocks_multiply_as_the_matrix_does)
{
    unsigned seed = 3;
    for (int k = 0; k < 4; k++) {
        OWNED(rb_friction_problem) p;
        OWNED(rb_friction_blocks) b;
        const int d = 2 + k % 2, nc = 7, m = d * nc;
        double x[21], y[21];
        random_problem(d, nc, &seed, &p);
        for (int i = 0; i < m; i++)
            x[i] = i / d == 4 ? 0.0 : uniform_from(&seed);
        if (k / 2)
            make_sparse(&p);
        CHECK_OK(rb_friction_blocks_init(&p, &b));
        for (int c = 0; c < nc; c++)
            assert_int_equal(b.i[b.diag[c]], c);
        rb_friction_blocks_apply(&b, x, y);
        for (int i = 0; i < m; i++) {
            double sum = 0.0;
            for (int j = 0; j < m; j++)
                sum += p.W[i + j * m] * x[j];
            CHECK_ABS(y[i], sum, 1e-14, "d = %d, form %d, row %d", d, (int)p.form, i);
        }
    }
}

/* (A + B W) dr + F, with some contacts open (A = 1, B = 0), by the dense and by the
 * sparse LU (which large orders take) */
TEST(a_newton_step_solves_its_system)
{
    unsigned seed = 9;
    static const int sizes[] = {5, 130};
    for (int k = 0; k < 4; k++) {
        OWNED(rb_friction_problem) p;
        OWNED(rb_friction_system) s;
        const int d = 2 + k % 2, nc = sizes[k / 2], m = d * nc, dd = d * d;
        double *A = rb_alloc((size_t)m, 3 * (size_t)d + 3), *B = A + m * d;
        double *F = B + m * d, *dr = F + m, *y = dr + m;
        const rb_friction_linearised at = {F, A, B};
        random_problem(d, nc, &seed, &p);
        for (int j = 0; j < m && k / 2; j++) /* thin it out */
            for (int i = 0; i < m; i++)
                if (abs(i / d - j / d) > 3)
                    p.W[i + j * m] = 0.0;
        make_sparse(&p);
        for (int i = 0; i < m; i++)
            F[i] = uniform_from(&seed);
        for (int i = 0; i < m * d; i++) {
            const int open = (i / dd) % 5 == 1;
            A[i] = (i % dd % (d + 1) == 0) * (open ? 1.0 : 5.0);
            B[i] = open ? 0.0 : uniform_from(&seed);
        }
        rb_friction_shared shared = {.problem = &p, .local = &p};
        rb_friction_task task = {.shared = &shared, .problem = &p, .d = d, .contacts = nc, .m = m};
        CHECK_OK(rb_friction_system_init(&task, task.n, &s));
        CHECK_OK(rb_friction_system_step(&s, &at, NULL, dr, NULL));
        assert_true((s.lu != NULL) == (k / 2));
        rb_friction_blocks_apply(&shared.blocks, dr, y);
        for (int c = 0; c < nc; c++)
            for (int a = 0; a < d; a++) {
                double sum = F[c * d + a];
                for (int b = 0; b < d; b++)
                    sum += A[c * dd + a + b * d] * dr[c * d + b] +
                           B[c * dd + a + b * d] * y[c * d + b];
                CHECK_ABS(sum, 0.0, 1e-11, "d = %d, nc = %d, row %d", d, nc, c * d + a);
            }
        rb_friction_blocks_free(&shared.blocks);
        free(A);
    }
}

/* r -> M r + b in four dimensions, u = 2 r - 1: GMRES needs four products. */
TEST(acceleration_solves_a_linear_iteration)
{
    enum { M = 4 };
    const double b[M] = {1.0, -2.0, 0.5, 3.0};
    unsigned seed = 21;
    double matrix[M * M], r[M] = {0.0}, u[M], start[M];
    OWNED(rb_anderson) a;
    for (int k = 0; k < M * M; k++)
        matrix[k] = 0.6 * uniform_from(&seed); /* on its own it need not converge */
    CHECK_OK(rb_anderson_init(M, &a));
    for (int k = 0; k < M + 3; k++) {
        memcpy(start, r, sizeof r);
        for (int i = 0; i < M; i++) {
            r[i] = b[i];
            for (int j = 0; j < M; j++)
                r[i] += matrix[i + j * M] * start[j];
        }
        for (int i = 0; i < M; i++)
            u[i] = 2.0 * r[i] - 1.0;
        rb_anderson_step(&a, start, r, u);
    }
    for (int i = 0; i < M; i++) {
        double next = b[i];
        for (int j = 0; j < M; j++)
            next += matrix[i + j * M] * r[j];
        CHECK_ABS(r[i], next, 1e-8, "fixed point, r[%d]", i);
        CHECK_ABS(u[i], 2.0 * r[i] - 1.0, 1e-8, "u goes along, u[%d]", i);
    }
}

TEST(acceleration_goes_back_where_it_was_led_astray)
{
    static const double led_to[] = {1.0, 1.5, 40.0};
    double r[1] = {0.0}, u[1] = {0.0}, start[1];
    OWNED(rb_anderson) a;
    CHECK_OK(rb_anderson_init(1, &a));
    for (int k = 0; k < 3; k++) {
        start[0] = k == 1 ? 1.0 : r[0];
        r[0] = u[0] = led_to[k];
        rb_anderson_step(&a, start, r, u);
    }
    CHECK_ABS(r[0], 1.5, 0.0, "the last point before the extrapolation");
    CHECK_ABS(u[0], 1.5, 0.0, "with its velocity");
}

/* A pile: every contact pressed by its neighbours, W_NN tridiagonal. */
static void pile(int nc, double coupling, rb_friction_problem *p)
{
    const int m = 2 * nc;
    *p = zero_local(2, nc);
    for (int i = 0; i < m; i++) {
        p->W[i + i * m] = 2.0;
        if (i + 2 < m)
            p->W[i + (i + 2) * m] = p->W[i + 2 + i * m] = -coupling;
        p->q[i] = i % 2 ? 0.05 : -1.0;
    }
    for (int c = 0; c < nc; c++)
        p->mu[c] = 0.5;
}

TEST(acceleration_saves_sweeps)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info plain, fast;
    double r[60], s[60], u[60];
    pile(30, 1.0, &p);
    CHECK_OK(rb_friction_solve("nsgs-ac", &p, NULL, &(rb_friction_solution){r, u, NULL}, &plain));
    CHECK_OK(rb_friction_solve("nsgs-aa", &p, NULL, &(rb_friction_solution){s, u, NULL}, &fast));
    CHECK_MAX((double)fast.iters, plain.iters / 5.0, "%d sweeps without", plain.iters);
    for (int k = 0; k < 60; k++)
        CHECK_ABS(s[k], r[k], 1e-4, "r[%d]", k);
}

/* K dv - H dr = -e and B H' dv + A dr = -F of bodies in a row, each of which touches the
 * next one.  Operations: the blocks B H', and dense LU with its two substitutions. */
TEST(a_step_of_all_bodies_solves_its_system)
{
    unsigned seed = 6;
    for (int sparse = 0; sparse < 2; sparse++) {
        const int nc = sparse ? 60 : 3, m = 2 * nc, n = m + 2;
        OWNED(rb_triplets) tk = {.rows = n, .cols = n}, th = {.rows = n, .cols = m};
        OWNED(rb_friction_problem)
        p = {.form = RB_FRICTION_GLOBAL, .dimension = 2, .contacts = nc, .dofs = n};
        double *A = rb_alloc((size_t)m, 7), *B = A + 2 * m, *F = B + 2 * m, *dr = F + m,
               *y = dr + m, *e = rb_alloc((size_t)n, 2), *dv = e + n, estimate;
        const rb_friction_linearised at = {F, A, B};
        for (int i = 0; i < n; i++) {
            rb_triplets_add(&tk, i, i, 2.0 + 0.1 * i);
            e[i] = uniform_from(&seed);
        }
        for (int j = 0; j < m; j++) {
            rb_triplets_add(&th, j, j, 1.0);
            rb_triplets_add(&th, j + 2, j, -1.0);
            F[j] = uniform_from(&seed);
        }
        for (int k = 0; k < 2 * m; k++) {
            A[k] = (k % 4 % 3 == 0) * 3.0 + uniform_from(&seed);
            B[k] = uniform_from(&seed);
        }
        CHECK_OK(rb_sparse_from_triplets(&tk, &p.K));
        CHECK_OK(rb_sparse_from_triplets(&th, &p.H));
        OWNED(rb_friction_system) s;
        rb_friction_task task = {.problem = &p, .d = 2, .contacts = nc, .m = m, .n = n};
        CHECK_OK(rb_friction_system_init(&task, task.n, &s));
        CHECK_OK(rb_friction_system_estimate(&s, &estimate));
        CHECK_OK(rb_friction_system_step(&s, &at, e, dr, dv));
        assert_true((s.lu != NULL) == sparse);
        const double order = n + m, lu = 2.0 / 3.0 * order * order * order;
        if (!sparse) {
            CHECK_REL(estimate, lu, 1e-15, "estimate");
            CHECK_REL(s.flops, 2.0 * 2.0 * 2.0 * m * 2.0 + lu + 2.0 * order * order, 1e-15,
                      "operations");
        } else {
            assert_true(estimate < 0.1 * lu && s.flops < 0.1 * lu);
        }
        for (int i = 0; i < n; i++) {
            const double turned = (i < m ? dr[i] : 0.0) - (i > 1 ? dr[i - 2] : 0.0);
            CHECK_ABS((2.0 + 0.1 * i) * dv[i] - turned, -e[i], 1e-12, "motion %d", i);
        }
        for (int j = 0; j < m; j++)
            y[j] = dv[j] - dv[j + 2];
        for (int j = 0; j < m; j++) {
            const int own = 4 * (j / 2) + j % 2, first = j / 2 * 2;
            CHECK_ABS(A[own] * dr[first] + A[own + 2] * dr[first + 1] + B[own] * y[first] +
                          B[own + 2] * y[first + 1],
                      -F[j], 1e-12, "contact equation %d", j);
        }
        free(A);
        free(e);
    }
}

/* A pile that shrugs off what happens a few contacts away: seven sweeps leave Newton one
 * step. One in which every contact feels all the others: Newton goes from zero as if
 * there had been no sweeps. */
TEST(the_hybrid_sees_what_sweeps_are_worth)
{
    for (int strong = 0; strong < 2; strong++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info newton, hybrid;
        double r[120], u[120];
        pile(60, strong ? 1.0 : 0.9, &p);
        for (int c = 0; c < 60; c++) {
            p.q[2 * c] = strong ? -1.0 : 0.1 * (c % 9) - 0.5;
            p.q[2 * c + 1] = strong ? 0.05 * (c - 30) : 0.2 * (c % 5) - 0.3;
        }
        CHECK_OK(rb_friction_solve("nsn-ac-nls", &p, NULL, &(rb_friction_solution){r, u, NULL},
                                   &newton));
        CHECK_OK(rb_friction_solve("nsn-ac-hybrid", &p, NULL, &(rb_friction_solution){r, u, NULL},
                                   &hybrid));
        assert_true(newton.iters > 2);
        assert_int_equal(hybrid.iters, 7 + (strong ? newton.iters : 1));
    }
}

/* Contacts that push each other the more, the more they are pushed: no solution.  Sweeps
 * that may yield pause where they stall, and go on when they are asked again. */
TEST(sweeps_that_stall_yield)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info = {0};
    OWNED(rb_friction_shared) shared;
    double r[8] = {0.0}, u[8], v[1], best[8];
    rb_friction_record record = {.r = best, .error = INFINITY};
    pile(4, 3.0, &p);
    CHECK_OK(rb_friction_shared_init(&p, &shared, NULL));
    rb_friction_task task = {.shared = &shared,
                             .problem = shared.problem,
                             .measure = &shared.measure,
                             .best = &record,
                             .budget = INFINITY,
                             .opt = rb_friction_defaults(),
                             .info = &info,
                             .d = 2,
                             .contacts = 4,
                             .m = 8,
                             .r = r,
                             .u = u,
                             .v = v};
    const rb_friction_method *method = &rb_friction_sweeps;
    void *sweeps = calloc(1, method->size);
    CHECK_OK(method->start(&task, RB_FRICTION_SWEEP_YIELD, sweeps));
    CHECK_STATUS(method->go_on(sweeps), RB_MAXITER);
    assert_int_equal(info.iters, 16);
    assert_true(info.flops >= task.budget);
    task.budget = 2.0 * info.flops;
    CHECK_STATUS(method->go_on(sweeps), RB_MAXITER);
    assert_true(info.iters > 16 && info.iters < 40);
    method->finish(sweeps);
    free(sweeps);
}

/* From zero: what the solver has spent, operations and those beside; INFINITY: not solved, or more
 * than most. */
static double spent_by(const char *name, const rb_friction_problem *p, double most)
{
    const rb_friction_solver *solver = rb_friction_solver_named(name);
    const size_t m = (size_t)(p->dimension * p->contacts);
    SCRATCH double *r = rb_alloc(m, 3);
    double v[1];
    rb_friction_info info = {0};
    OWNED(rb_friction_shared) shared;
    CHECK_OK(rb_friction_shared_init(p, &shared, NULL));
    rb_friction_record record = {.r = r + 2 * m, .error = INFINITY};
    rb_friction_task task = {.shared = &shared,
                             .problem = shared.problem,
                             .measure = &shared.measure,
                             .best = &record,
                             .opt = rb_friction_defaults(),
                             .info = &info,
                             .d = p->dimension,
                             .contacts = p->contacts,
                             .m = (int)m,
                             .budget = most,
                             .r = r,
                             .u = r + m,
                             .v = v};
    const rb_status s = rb_friction_run(&task, solver->run, solver->variant, 0);
    const double spent = rb_friction_task_spent(&task);
    return s == RB_OK && spent <= most ? spent : INFINITY;
}

/* What the shares of auto's members bound is their time, in which a system of Newton's method
 * counts more than its operations: with operations alone a heap of discs took 9.7 times as long as
 * the sweeps that solve it, and the files on which the sweeps end near a solution, but not at it,
 * wait for Newton's method. */
TEST(auto_spends_little_beside_its_best_member)
{
    static const char *const members[] = {"nsgs-aa", "admm", "nsn-ac", "nsn-fb", "nsn-fb-nls"};
    static const char *const packings[] = {"boxes 100 0.1 4", "boxes 150 2 5",   "discs 200 0.2 5",
                                           "discs 330 0.5 6", "bricks 50 0.2 4", "bricks 60 1 5"};
    static const char *const files[] = {
        "siconos/fc3d/Capsules-i101-404.dat", "siconos/fc3d/OneObject-i100000-499.hdf5.dat",
        "siconos/fc2d/FrictionContactProblem00727.dat", "fclib/Capsules-i125-1213.hdf5"};
    const int own = sizeof packings / sizeof *packings,
              all = own + (getenv("ROLLBEM_DATA") ? 4 : 0);
    for (int k = 0; k < all; k++) {
        OWNED(rb_friction_problem) p;
        if (k < own)
            packing(packings[k], &p);
        else
            CHECK_OK(rb_friction_read(outside_data(files[k - own]), &p, &message));
        const double spent = spent_by("auto", &p, INFINITY);
        double best = spent;
        for (size_t i = 0; i < sizeof members / sizeof *members; i++)
            best = fmin(best, spent_by(members[i], &p, best));
        CHECK_MAX(spent, 3.0 * best, "%s", k < own ? packings[k] : files[k - own]);
    }
}

/* A method that pauses and goes on arrives where it does without pauses. */
TEST(pauses_change_nothing)
{
    static const char *const names[] = {"nsgs-aa", "nsgs-ac",     "nsn-fb", "extragradient",
                                        "nsgs-fp", "fixed-point", "admm"};
    OWNED(rb_friction_problem) p;
    packing("spheres 20 0.4 3", &p);
    const int m = 3 * p.contacts;
    double *whole = rb_alloc((size_t)m, 4), *r = whole + m, *u = r + m, *best = u + m;
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const rb_friction_solver *solver = rb_friction_solver_named(names[k]);
        rb_friction_info info, parts = {0};
        OWNED(rb_friction_shared) shared;
        double v[1];
        rb_friction_record record = {.r = best, .error = INFINITY};
        CHECK_OK(
            rb_friction_solve(names[k], &p, NULL, &(rb_friction_solution){whole, u, NULL}, &info));
        CHECK_OK(rb_friction_shared_init(&p, &shared, NULL));
        memset(r, 0, (size_t)m * sizeof *r);
        rb_friction_task task = {.shared = &shared,
                                 .problem = shared.problem,
                                 .measure = &shared.measure,
                                 .best = &record,
                                 .opt = rb_friction_defaults(),
                                 .info = &parts,
                                 .d = 3,
                                 .contacts = p.contacts,
                                 .m = m,
                                 .r = r,
                                 .u = u,
                                 .v = v};
        void *state_of = calloc(1, solver->run->size);
        int pauses = -1;
        rb_status s = solver->run->start(&task, solver->variant, state_of);
        for (; s == RB_OK; pauses++) {
            task.budget = (pauses + 2) * info.flops / 5.0;
            s = solver->run->go_on(state_of);
            if (s == RB_OK || rb_friction_task_spent(&task) < task.budget)
                break;
            s = RB_OK;
        }
        solver->run->finish(state_of);
        free(state_of);
        CHECK_OK(s);
        rb_friction_scale_back(&shared.scaling, r, u);
        assert_true(pauses >= 1);
        assert_int_equal(parts.iters, info.iters);
        assert_int_equal(memcmp(r, whole, (size_t)m * sizeof *r), 0);
    }
    free(whole);
}

/* Its spectral values s and those of x obey s - mu^2/s = x, along the same axis; D is its
 * derivative. */
TEST(smoothed_projections_obey_their_definition)
{
    unsigned seed = 11;
    double zero = 0.0, own = NAN, slope = NAN;
    rb_friction_smoothed(1, 0.0, &zero, &own, &slope);
    CHECK_ABS(own, 0.0, 0.0, "the tip of the cone, not smoothed");
    CHECK_ABS(slope, 0.5, 0.0, "its derivative");
    for (int n = 1; n <= 3; n++)
        for (int trial = 0; trial < 20; trial++) {
            const double mu = 0.3 + 0.1 * trial, step = 1e-5;
            double x[3], P[3], D[9], up[3], down[3], t = 0.0, along = 0.0;
            for (int a = 0; a < n; a++)
                x[a] = 3.0 * uniform_from(&seed);
            for (int a = 1; a < n; a++)
                t = hypot(t, x[a]);
            const double least = rb_friction_smoothed(n, mu, x, P, D);
            CHECK_REL(least, fmin(fabs(x[0] - t), fabs(x[0] + t)), 1e-12, "n = %d", n);
            for (int a = 1; a < n; a++)
                along += P[a] * x[a] / t;
            for (int side = n == 1 ? 1 : -1; side <= 1; side += 2) {
                const double s = P[0] + side * along;
                assert_true(s > 0.0);
                CHECK_ABS(s - mu * mu / s, x[0] + side * t, 1e-10, "n = %d, mu = %g", n, mu);
            }
            for (int b = 0; b < n; b++) {
                x[b] += step;
                rb_friction_smoothed(n, mu, x, up, NULL);
                x[b] -= 2.0 * step;
                rb_friction_smoothed(n, mu, x, down, NULL);
                x[b] += step;
                for (int a = 0; a < n; a++)
                    CHECK_ABS(D[a + b * n], (up[a] - down[a]) / (2.0 * step), 1e-8,
                              "n = %d, D(%d, %d)", n, a, b);
            }
        }
}

RUN_TESTS(NULL, NULL)
