/* What is solved does not depend on units: the scaled measure, and every solver. */
#include "check.h"
#include "friction_problems.h"
#include "rollbem/friction.h"
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

/* The scaled measure written down a second time, from the disjunction of cases. */
static double measure_again(const rb_friction_problem *p, const double *r)
{
    const int d = p->dimension, m = d * p->contacts;
    double sum = 0.0, norm = 0.0;
    for (int c = 0; c < p->contacts; c++) {
        double z[3] = {0.0}, u[3] = {0.0}, t = 0.0, s = 0.0;
        const double k = 1.0 / p->W[(size_t)(c * d) * (size_t)(m + 1)], mu = p->mu[c];
        for (int a = 0; a < d; a++) {
            u[a] = p->q[c * d + a];
            norm += u[a] * u[a];
            for (int j = 0; j < m; j++)
                u[a] += p->W[c * d + a + j * m] * r[j];
            s += a ? u[a] * u[a] : 0.0;
        }
        u[0] += mu * sqrt(s);
        for (int a = 0; a < d; a++) {
            z[a] = r[c * d + a] - k * u[a];
            t += a ? z[a] * z[a] : 0.0;
        }
        t = sqrt(t);
        const double along = (z[0] + mu * t) / (1.0 + mu * mu);
        const int inside = z[0] >= 0.0 && t <= mu * z[0], apex = !inside && along <= 0.0;
        for (int a = 0; a < d; a++) {
            const double face = a ? along * mu * z[a] / t : along;
            const double e = r[c * d + a] - (inside ? z[a] : apex ? 0.0 : face);
            sum += e / k * (e / k);
        }
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
        CHECK_REL(first.scaled, measure_again(&p, r), 1e-12, "by hand, d = %d", d);
        rescale(&p, 1e-6, 1e3);
        for (int i = 0; i < d * NC; i++)
            r[i] *= 1e9;
        CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &again));
        CHECK_REL(again.scaled, first.scaled, 1e-12, "in other units");
        assert_true(again.residual > 10.0 * first.scaled); /* (13) adds forces to velocities */
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
        CHECK_OK(rb_friction_read(outside_data(files[k]), &p, &heard));
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
        CHECK_OK(rb_friction_soclcp(&p, NULL, x, y, &info));
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
                rb_message note = {""};
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
