/* What is solved does not depend on units: the scaled measure, and every solver. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

/* W = B B' + 1, q random: some contacts open, some stick, some slip. */
static void random_problem(int d, int nc, unsigned seed, rb_friction_problem *p)
{
    const int m = d * nc;
    SCRATCH double *B = rb_alloc((size_t)m, (size_t)m);
    *p = zero_local(d, nc);
    for (int k = 0; k < m * m; k++)
        B[k] = uniform_from(&seed) / sqrt(m);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < m; j++) {
            p->W[i + j * m] = i == j;
            for (int k = 0; k < m; k++)
                p->W[i + j * m] += B[i + k * m] * B[j + k * m];
        }
    for (int i = 0; i < m; i++)
        p->q[i] = uniform_from(&seed) - (i % d ? 0.0 : 0.3);
    for (int c = 0; c < nc; c++)
        p->mu[c] = 0.1 + 0.4 * fabs(uniform_from(&seed));
}

/* W times a, q times b; the global form likewise: K over a, f times b/a, w times b. */
static void rescale(rb_friction_problem *p, double a, double b)
{
    const int m = p->dimension * p->contacts;
    for (int k = 0; p->form == RB_FRICTION_LOCAL_DENSE && k < m * m; k++)
        p->W[k] *= a;
    for (int k = 0; p->form == RB_FRICTION_LOCAL_SPARSE && k < p->Ws.p[m]; k++)
        p->Ws.x[k] *= a;
    for (int k = 0; p->form != RB_FRICTION_GLOBAL && k < m; k++)
        p->q[k] *= b;
    if (p->form != RB_FRICTION_GLOBAL)
        return;
    for (int k = 0; k < p->K.p[p->dofs]; k++)
        p->K.x[k] /= a;
    for (int k = 0; k < p->dofs; k++)
        p->f[k] *= b / a;
    for (int k = 0; k < m; k++)
        p->w[k] *= b;
}

/* The scaled measure written down a second time: a search over the points of the law.  In
 * the plane slip has two directions, in space a circle of them. */
static double measure_again(const rb_friction_problem *p, const double *r)
{
    const int d = p->dimension, m = d * p->contacts, directions = d == 2 ? 2 : 100000;
    double sum = 0.0, norm = 0.0;
    for (int c = 0; c < p->contacts; c++) {
        const double own = p->W[(size_t)(c * d) * (size_t)(m + 1)], mu = p->mu[c];
        const double first = p->W[0], D = exp2(-floor(0.5 * (ilogb(own / first) + 1)));
        double s[3] = {0.0}, u[3] = {0.0}, least, stick = 0.0, open = 0.0;
        for (int a = 0; a < d; a++) {
            s[a] = r[c * d + a] * own;
            u[a] = p->q[c * d + a];
            norm += D * D * u[a] * u[a];
            for (int j = 0; j < m; j++)
                u[a] += p->W[c * d + a + j * m] * r[j];
            open += s[a] * s[a];
            stick += u[a] * u[a];
        }
        least = open + (u[0] < 0.0 ? u[0] * u[0] : 0.0);
        const double t = d == 2 ? fabs(s[1]) : hypot(s[1], s[2]);
        if (s[0] >= 0.0 && t <= mu * s[0])
            least = fmin(least, stick);
        for (int k = 0; k < directions; k++) {
            const double angle = 2.0 * acos(-1.0) * k / directions;
            const double v[3] = {0.0, d == 2 ? 1.0 - 2.0 * k : cos(angle), sin(angle)};
            /* (s, u) on the rays (1, -mu v) and v, or stick on the first of them */
            double a0 = s[0], b0 = 0.0, far = u[0] * u[0], stuck = stick;
            for (int a = 1; a < d; a++) {
                a0 -= mu * v[a] * s[a];
                b0 += v[a] * u[a];
            }
            a0 = fmax(a0 / (1.0 + mu * mu), 0.0);
            b0 = fmax(b0, 0.0);
            for (int a = 0; a < d; a++) {
                const double ds = s[a] - (a ? -mu * v[a] * a0 : a0),
                             du = a ? u[a] - b0 * v[a] : 0.0;
                far += ds * ds + du * du;
                stuck += ds * ds;
            }
            least = fmin(least, fmin(far, stuck));
        }
        sum += D * D * least;
    }
    return sqrt(sum / norm);
}

TEST(the_scaled_measure_sees_no_units)
{
    for (int d = 2; d <= 3; d++) {
        enum { NC = 6 };
        OWNED(rb_friction_problem) p;
        double r[3 * NC];
        rb_friction_errors first, again;
        unsigned seed = 17;
        random_problem(d, NC, 4u, &p);
        for (int i = 0; i < d * NC; i++)
            r[i] = uniform_from(&seed);
        CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &first));
        /* in space the direction of slip is not the very best one */
        const double best = measure_again(&p, r);
        CHECK_MAX(best, first.scaled * (1.0 + 1e-12), "by hand, d = %d", d);
        CHECK_MAX(first.scaled, best * (d == 2 ? 1.0 + 1e-12 : 1.1), "by hand, d = %d", d);
        rescale(&p, 1e-6, 1e3);
        for (int i = 0; i < d * NC; i++)
            r[i] *= 1e9;
        CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &again));
        CHECK_REL(again.scaled, first.scaled, 1e-12, "in other units");
        assert_true(again.residual > 10.0 * first.scaled); /* (13) adds forces to velocities */
    }
}

/* Powers of two as the unit of each contact by itself: what a solver finds is the same, bit
 * by bit, and so is the measure. */
TEST(units_of_single_contacts_change_nothing)
{
    enum { NC = 7 };
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int trial = 0; trial < 4; trial++) {
        const int d = 2 + trial % 2, m = d * NC, global = trial > 1;
        OWNED(rb_friction_problem) p;
        double r[2][3 * NC], u[2][3 * NC], unit[NC];
        random_problem(d, NC, 31u + (unsigned)trial, &p);
        unsigned seed = 5u + (unsigned)trial;
        for (int c = 0; c < NC; c++)
            unit[c] = exp2(floor(20.0 * uniform_from(&seed)));
        if (global) { /* K = 1, H = W's factor is not needed: any H will do */
            p.form = RB_FRICTION_GLOBAL;
            p.dofs = m;
            p.f = rb_copy((size_t)m, p.q);
            p.w = rb_alloc((size_t)m, 1);
            rb_triplets t = {.rows = m, .cols = m};
            for (int i = 0; i < m; i++) {
                rb_triplets_add(&t, i, i, 2.0);
                p.w[i] = 0.1 * p.q[i];
            }
            CHECK_OK(rb_sparse_from_triplets(&t, &p.K));
            rb_triplets_free(&t);
            CHECK_OK(rb_sparse_from_dense(m, m, p.W, m, &p.H));
        }
        for (int k = 0; k < count; k++) {
            rb_friction_info info[2];
            rb_status got[2];
            if (d == 3 && (all[k].needs & RB_FRICTION_ONLY_2D))
                continue;
            for (int with = 0; with < 2; with++) {
                for (int i = 0; with && i < m; i++) {
                    const double D = unit[i / d];
                    for (int j = 0; !global && j < m; j++)
                        p.W[i + j * m] *= D * unit[j / d];
                    for (int l = global ? p.H.p[i] : 0; global && l < p.H.p[i + 1]; l++)
                        p.H.x[l] *= D;
                    *(global ? &p.w[i] : &p.q[i]) *= D;
                }
                got[with] =
                    rb_friction_solve(all[k].name, &p, NULL,
                                      &(rb_friction_solution){r[with], u[with], NULL}, &info[with]);
            }
            for (int i = 0; i < m; i++) { /* back */
                const double D = 1.0 / unit[i / d];
                for (int j = 0; !global && j < m; j++)
                    p.W[i + j * m] *= D / unit[j / d];
                for (int l = global ? p.H.p[i] : 0; global && l < p.H.p[i + 1]; l++)
                    p.H.x[l] *= D;
                *(global ? &p.w[i] : &p.q[i]) *= D;
            }
            assert_int_equal(got[0], got[1]);
            /* Lemke's path begins with one speed for all, which is another one in other units, and
             * smoothing knows u and the balance of forces apart. */
            const int same = strcmp(all[k].name, "lemke") != 0 &&
                             !(global && strcmp(all[k].name, "soclcp-smoothing") == 0);
            for (int i = 0; i < m && !same && got[0] == RB_OK; i++)
                CHECK_ABS(r[1][i] * unit[i / d], r[0][i], 1e-7, "%s: r", all[k].name);
            if (!same)
                continue;
            assert_int_equal(info[0].iters, info[1].iters);
            CHECK_ABS(info[1].scaled, info[0].scaled, 0.0, "%s: scaled", all[k].name);
            CHECK_ABS(info[1].worst, info[0].worst, 0.0, "%s: worst", all[k].name);
            for (int i = 0; i < m; i++) {
                CHECK_ABS(r[1][i] * unit[i / d], r[0][i], 0.0, "%s: r", all[k].name);
                CHECK_ABS(u[1][i] / unit[i / d], u[0][i], 0.0, "%s: u", all[k].name);
            }
        }
    }
}

/* Contacts in units of 10^-6 to 10^6: the same forces and velocities. */
TEST(contacts_in_any_units_are_solved)
{
    enum { NC = 8 };
    for (int trial = 0; trial < 50; trial++) {
        const int d = 2 + trial % 2, m = d * NC;
        OWNED(rb_friction_problem) p;
        double r[2][3 * NC], u[2][3 * NC], unit[NC];
        unsigned seed = 100u + (unsigned)trial;
        random_problem(d, NC, 900u + (unsigned)trial, &p);
        rb_friction_options opt = rb_friction_defaults();
        opt.tol = 1e-10;
        for (int with = 0; with < 2; with++) {
            rb_friction_info info;
            for (int i = 0; i < m && with; i++) {
                unit[i / d] = i % d ? unit[i / d] : pow(10.0, 6.0 * uniform_from(&seed));
                p.q[i] *= unit[i / d];
            }
            for (int k = 0; k < m * m && with; k++)
                p.W[k] *= unit[k % m / d] * unit[k / m / d];
            CHECK_OK(rb_friction_solve(NULL, &p, &opt,
                                       &(rb_friction_solution){r[with], u[with], NULL}, &info));
        }
        for (int i = 0; i < m; i++) {
            CHECK_ABS(r[1][i] * unit[i / d], r[0][i], 1e-7, "problem %d, r", trial);
            CHECK_ABS(u[1][i] / unit[i / d], u[0][i], 1e-7, "problem %d, u", trial);
        }
    }
}

/* Bodies that stick, W = 1 + 0.1, q = -1 in every row: nothing falls through the floor.  (13)
 * divides by mu the velocities with which it does. */
TEST(no_mu_hides_a_penetration)
{
    static const double all[] = {1.0, 1e4, 1e8, 1e9, 1e10, 1e12, 1e14, 1e100, 1e300};
    int count, solved = 0, trials = 0;
    const rb_friction_solver *solvers = rb_friction_solvers(&count);
    for (int trial = 0; trial < 18; trial++) {
        if (!is_in_turn(trial / 2, 3))
            continue;
        trials++;
        const int d = 2 + trial % 2, m = 2 * d;
        const double mu = all[trial / 2];
        OWNED(rb_friction_problem) p = zero_local(d, 2);
        double r[6], u[6];
        for (int i = 0; i < m; i++) {
            p.q[i] = -1.0;
            for (int j = 0; j < m; j++)
                p.W[i + j * m] = 0.1 + (i == j);
        }
        p.mu[0] = p.mu[1] = mu;
        for (int k = 0; k < count; k++) {
            rb_friction_info info;
            if (d == 3 && (solvers[k].needs & RB_FRICTION_ONLY_2D))
                continue;
            const rb_status s = rb_friction_solve(solvers[k].name, &p, NULL,
                                                  &(rb_friction_solution){r, u, NULL}, &info);
            if (k == 0)
                CHECK_OK(s);
            if (s != RB_OK)
                continue;
            solved++;
            /* at mu = 1 the tangents slip in space */
            for (int i = 0; i < m; i++)
                CHECK_MAX(-u[i - i % d], 1e-7, "%s at mu = %g: u_N", solvers[k].name, mu);
            for (int i = 0; i < m && mu > 1.5; i++) {
                CHECK_ABS(u[i], 0.0, 1e-7, "%s at mu = %g: u", solvers[k].name, mu);
                CHECK_REL(r[i], 1.0 / (1.0 + 0.1 * m), 1e-6, "%s at mu = %g", solvers[k].name, mu);
            }
        }
    }
    assert_true(18 * solved > 120 * trials);
}

/* A contact that is a million times lighter than its neighbours, and penetrates by two
 * tolerances of its own velocities: not seen in the norm over all. */
TEST(a_small_contact_counts_as_well)
{
    static const double all[] = {0.0, 1.0, 1e9};
    for (int k = 0; k < 3; k++) {
        OWNED(rb_friction_problem) p = zero_local(2, 3);
        double r[6], u[6];
        rb_friction_errors error;
        for (int c = 0; c < 3; c++) {
            p.W[(2 * c) * 7] = p.W[(2 * c + 1) * 7] = 1.0;
            p.q[2 * c] = c == 1 ? -1e-3 : -1.0;
            p.mu[c] = all[k];
        }
        rb_friction_info info;
        CHECK_OK(rb_friction_solve(NULL, &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
        CHECK_MAX(info.worst, 1e-8, "solved, mu %g", all[k]);
        r[2] *= 1.0 - 2e-8;
        CHECK_OK(rb_friction_error(&p, r, NULL, u, &error));
        CHECK_MAX(error.scaled, 1e-10, "the norm, mu %g", all[k]);
        assert_int_equal(error.contact, 1);
        CHECK_REL(error.worst, 1e-8, 0.02, "its own, mu %g", all[k]);
    }
}

typedef struct {
    rb_status status;
    int iters;
} outcome;

static outcome solved(const char *solver, rb_friction_problem *p, double tol)
{
    const size_t m = (size_t)(p->dimension * p->contacts);
    SCRATCH double *r = rb_alloc(m, 1), *u = rb_alloc(m, 1);
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    opt.tol = tol;
    opt.max_iters = 2000;
    outcome o = {rb_friction_solve(solver, p, &opt, &(rb_friction_solution){r, u, NULL}, &info), 0};
    o.iters = info.iters;
    return o;
}

/* Multiplying by powers of two changes no digit: nothing may differ.  Powers of ten
 * change the last digits of the data: where Newton or acceleration is as sensitive as on
 * OneObject, that moves the count by some in a hundred. */
static void same_in_other_units(const char *name, rb_friction_problem *p, double tol)
{
    static const double by[][2] = {{0x1p-20, 0x1p10}, {1e-6, 1e-3}, {1e3, 1e6}};
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++) {
        const outcome first = solved(all[k].name, p, tol);
        for (int i = 0; i < 3 && first.status != RB_EINVAL; i++) {
            rescale(p, by[i][0], by[i][1]);
            const outcome o = solved(all[k].name, p, tol);
            rescale(p, 1.0 / by[i][0], 1.0 / by[i][1]);
            const double most = i ? 0.1 * first.iters : 0.0;
            if (o.status != first.status)
                print_error("%s, %s: %s, in other units %s\n", name, all[k].name,
                            rb_status_text(first.status), rb_status_text(o.status));
            CHECK_STATUS(o.status, first.status);
            CHECK_ABS(o.iters, first.iters, most, "%s, %s, units %d", name, all[k].name, i);
        }
    }
}

TEST(every_solver_in_other_units)
{
    for (int d = 2; d <= 3; d++) {
        OWNED(rb_friction_problem) p;
        random_problem(d, 20, 8u, &p);
        same_in_other_units(d == 2 ? "plane" : "space", &p, 1e-8);
        same_in_other_units(d == 2 ? "plane" : "space", &p, 1e-12);
    }
}

TEST(every_solver_on_files_in_other_units)
{
    static const char *const files[] = {"siconos/fc2d/FC2D_SliderCrankLagrangian00000.dat",
                                        "siconos/fc2d/FrictionContactProblem00394.dat",
                                        "siconos/fc2d/FrictionContactProblem00031.dat",
                                        "siconos/fc3d/FC3D_Example1_SBM.dat",
                                        "siconos/fc3d/FrictionContact3D_1c.dat",
                                        "siconos/fc3d/Rover11035.dat",
                                        "siconos/fc3d/Rover1039.dat",
                                        "siconos/fc3d/NESpheres_10_1.dat",
                                        "siconos/fc3d/OneObject-i100000-499.hdf5.dat",
                                        "fclib/CubeH8.hdf5",
                                        "packings/scale_small.dat"};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        OWNED(rb_friction_problem) p;
        CHECK_OK(rb_friction_read(outside_data(files[k]), &p, &message));
        same_in_other_units(files[k], &p, 1e-8);
    }
}

/* One contact, W about 1e-9, q about 1e-3: took 21 671 iterations and was not solved. */
TEST(a_light_touch_is_solved_at_once)
{
    double W[] = {1e-9, 3e-10, 0.0, 3e-10, 1e-9, 1e-10, 0.0, 1e-10, 1e-9};
    double q[] = {-1e-3, 5e-3, 0.0}, mu[] = {0.5};
    rb_friction_problem p = {
        .form = RB_FRICTION_LOCAL_DENSE, .dimension = 3, .contacts = 1, .W = W, .q = q, .mu = mu};
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++) {
        if (all[k].needs & RB_FRICTION_ONLY_2D)
            continue;
        const outcome o = solved(all[k].name, &p, 1e-8);
        CHECK_OK(o.status);
        const int slow = !strncmp(all[k].method, "projection", 10);
        CHECK_MAX(o.iters, slow ? 300 : 12, "%s", all[k].name);
    }
}

/* y in other units than x: s y = M x + q. */
TEST(cones_in_other_units)
{
    const int size[] = {3, 1, 2};
    enum { N = 6 };
    unsigned seed = 21;
    double M[N * N], q[N], x[N], y[N], B[N * N];
    for (int k = 0; k < N * N; k++)
        B[k] = uniform_from(&seed);
    for (int i = 0; i < N; i++)
        q[i] = uniform_from(&seed);
    int iters = 0;
    for (int k = 0; k < 3; k++) {
        const double s = k == 0 ? 1.0 : k == 1 ? 0x1p-30 : 1e9;
        double qs[N];
        for (int i = 0; i < N; i++) {
            qs[i] = s * q[i];
            for (int j = 0; j < N; j++) {
                M[i + j * N] = s * (i == j);
                for (int l = 0; l < N; l++)
                    M[i + j * N] += s * B[i + l * N] * B[j + l * N];
            }
        }
        const rb_friction_soclcp_problem p = {N, M, qs, 3, size};
        rb_friction_info info;
        CHECK_OK(rb_friction_solve_soclcp(&p, NULL, x, y, &info));
        if (k)
            assert_int_equal(info.iters, iters);
        iters = info.iters;
    }
}

/* Where (13) is asked for, it decides in every solver; else a note says where it is above
 * the tolerance.  W of a thousandth: (13) wants smaller forces at open contacts. */
TEST(the_measure_of_acary_decides_where_asked)
{
    int count, notes = 0;
    const rb_friction_solver *solvers = rb_friction_solvers(&count);
    for (int trial = 0; trial < 12; trial++) {
        OWNED(rb_friction_problem) p;
        double r[18], u[18];
        random_problem(2 + trial % 2, 6, 77u + (unsigned)trial, &p);
        rescale(&p, 1e-3, 1.0);
        for (int s = 0; s < count; s++)
            for (int acary = 0; acary < 2; acary++) {
                rb_friction_options opt = rb_friction_defaults();
                rb_friction_info info;
                rb_friction_errors again;
                rb_message note = {.text = ""};
                const rb_friction_solution at = {r, u, NULL};
                if ((solvers[s].needs & RB_FRICTION_ONLY_2D) && p.dimension != 2)
                    continue;
                opt.tol = 1e-5;
                opt.measure = acary ? RB_FRICTION_BY_ACARY : RB_FRICTION_BY_SCALED;
                const rb_status got = rb_friction_solve(solvers[s].name, &p, &opt, &at, &info);
                if (s == 0)
                    CHECK_OK(got);
                if (got != RB_OK)
                    continue;
                CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &again));
                CHECK_REL(info.residual, again.residual, 1e-9, "%s", solvers[s].name);
                CHECK_REL(info.scaled, again.scaled, 1e-9, "%s", solvers[s].name);
                CHECK_MAX(acary ? info.residual : info.scaled, opt.tol, "%s, %s", solvers[s].name,
                          acary ? "(13)" : "scaled");
                assert_int_equal(rb_friction_note(opt.tol, &info, &note), info.residual > opt.tol);
                assert_int_equal(note.text[0] != '\0', info.residual > opt.tol);
                notes += note.text[0] != '\0';
            }
    }
    assert_true(notes > 5);
}

RUN_TESTS(NULL, NULL)
