/* Every solver of the registry, the canonical SOCLCP, and the files of other projects. */
#include "check.h"
#include "friction_problems.h"
#include "lcp/friction/friction.h"
#include "numbers.h"

/* A chain of contacts, each coupled to its neighbours, W block tridiagonal and positive
 * definite: sparse, and with a load that separates, sticks and slips. */
static void chain(int d, int nc, rb_friction_problem *p)
{
    const int m = d * nc;
    unsigned seed = 11u * (unsigned)nc + (unsigned)d;
    *p = zero_local(d, nc);
    for (int i = 0; i < m; i++)
        for (int j = i; j < m; j++) {
            const int apart = j / d - i / d;
            const double w = i == j ? 2.0 : apart > 1 ? 0.0 : 0.25 * uniform_from(&seed);
            p->W[i + j * m] = p->W[j + i * m] = w;
        }
    for (int c = 0; c < nc; c++) {
        p->mu[c] = c % 5 == 4 ? 0.0 : 0.2 + 0.3 * fabs(uniform_from(&seed));
        for (int a = 0; a < d; a++)
            p->q[c * d + a] = a ? uniform_from(&seed) : c % 3 ? -1.0 : 0.5;
    }
}

/* The disjunction of *Acary* (2), looked at contact by contact; largest violation. */
static double violation(const rb_friction_problem *p, const double *r, const double *u)
{
    const int d = p->dimension;
    double worst = 0.0;
    for (int c = 0; c < p->contacts; c++) {
        const double *rc = r + c * d, *uc = u + c * d, mu = p->mu[c];
        const double rt = d == 2 ? fabs(rc[1]) : hypot(rc[1], rc[2]);
        const double ut = d == 2 ? fabs(uc[1]) : hypot(uc[1], uc[2]);
        double power = mu * rc[0] * ut; /* + r_T.u_T = 0: slip against the friction */
        for (int a = 1; a < d; a++)
            power += rc[a] * uc[a];
        worst = fmax(worst, fmax(-rc[0], -uc[0]));
        worst = fmax(worst, fmax(rt - mu * rc[0], fabs(rc[0] * uc[0])));
        worst = fmax(worst, fabs(power));
    }
    return worst;
}

TEST(every_solver_obeys_coulomb)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    assert_true(count >= 15);
    for (int d = 2; d <= 3; d++)
        for (int k = 0; k < count; k++) {
            if (d == 3 && (all[k].needs & RB_FRICTION_ONLY_2D))
                continue;
            OWNED(rb_friction_problem) p;
            rb_friction_info info;
            double r[180], u[180], reference[180];
            chain(d, 60, &p);
            CHECK_OK(rb_friction_solve("nsgs-ac", &p, NULL,
                                       &(rb_friction_solution){reference, u, NULL}, &info));
            if (k % 2)
                make_sparse(&p);
            const rb_status s = rb_friction_solve(all[k].name, &p, NULL,
                                                  &(rb_friction_solution){r, u, NULL}, &info);
            if (s != RB_OK)
                print_error("%s in %dD: %s\n", all[k].name, d, rb_status_text(s));
            CHECK_OK(s);
            CHECK_MAX(violation(&p, r, u), 1e-6, "%s in %dD", all[k].name, d);
            for (int i = 0; i < 60 * d; i++)
                CHECK_ABS(r[i], reference[i], 1e-6, "%s in %dD, r[%d]", all[k].name, d, i);
            assert_true(info.flops > 0.0 && info.seconds > 0.0);
        }
}

/* A block on the ground that only friction holds: K = 0 on both of its motions. */
static void a_loose_block(rb_friction_problem *p)
{
    int at[] = {0, 1};
    double zero[] = {0.0, 0.0}, one[] = {1.0, 1.0};
    *p = zero_global(2, 1, 2);
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 2, .cols = 2, .nz = 2, .row = at, .col = at, .x = zero}, &p->K));
    CHECK_OK(rb_sparse_from_triplets(
        &(rb_triplets){.rows = 2, .cols = 2, .nz = 2, .row = at, .col = at, .x = one}, &p->H));
    p->mu[0] = 0.5, p->f[0] = -2.0, p->f[1] = 0.7;
}

TEST(solvers_without_need_of_w_take_a_singular_k)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        double r[2], u[2], v[2];
        a_loose_block(&p);
        const rb_status s =
            rb_friction_solve(all[k].name, &p, NULL, &(rb_friction_solution){r, u, v}, &info);
        if (all[k].needs & RB_FRICTION_NEEDS_W) {
            CHECK_STATUS(s, RB_SINGULAR);
            assert_non_null(strstr(info.msg.text, "nullity 2"));
        } else if (!strncmp(all[k].name, "nsn-jm", 6)) {
            /* at r_N = 0 its disc is a point: nothing holds the block along T */
            CHECK_STATUS(s, RB_SINGULAR);
        } else {
            if (s != RB_OK)
                print_error("%s: %s\n", all[k].name, rb_status_text(s));
            CHECK_OK(s);
            CHECK_ABS(r[0], 2.0, 1e-7, "%s: r_N", all[k].name);
            CHECK_ABS(r[1], -0.7, 1e-7, "%s: r_T", all[k].name);
            CHECK_ABS(v[1], 0.0, 1e-7, "%s: it stays", all[k].name);
        }
    }
}

/* Drawn beyond what friction can hold, nothing is in balance. */
TEST(what_has_no_solution_is_not_solved)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        double r[2], u[2], v[2];
        a_loose_block(&p);
        p.f[1] = 1.5;
        const rb_status s =
            rb_friction_solve(all[k].name, &p, NULL, &(rb_friction_solution){r, u, v}, &info);
        if (s <= 0)
            print_error("%s: %s\n", all[k].name, rb_status_text(s));
        assert_true(s > 0);
    }
}

TEST(the_iteration_limit_is_that_of_the_whole_call)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    for (int k = 0; k < count; k++)
        for (int most = 1; most <= 3; most += 2) {
            OWNED(rb_friction_problem) p;
            rb_friction_info info;
            rb_friction_options opt = rb_friction_defaults();
            double r[120], u[120];
            opt.tol = 1e-14;
            opt.max_iters = most;
            chain(2, 60, &p);
            rb_friction_solve(all[k].name, &p, &opt, &(rb_friction_solution){r, u, NULL}, &info);
            CHECK_MAX(info.iters, most, "%s with --max-iters %d", all[k].name, most);
        }
}

TEST(info_may_be_null)
{
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    OWNED(rb_friction_problem) p;
    double r[20], u[20];
    chain(2, 10, &p);
    for (int k = 0; k < count; k++)
        CHECK_OK(
            rb_friction_solve(all[k].name, &p, NULL, &(rb_friction_solution){r, u, NULL}, NULL));
    CHECK_STATUS(rb_friction_solve("none", &p, NULL, &(rb_friction_solution){r, u, NULL}, NULL),
                 RB_EINVAL);
    CHECK_MAX(violation(&p, r, u), 1e-6, "without info");
    const double M[] = {2.0}, q[] = {-1.0};
    const int one[] = {1};
    const rb_friction_soclcp_problem cone = {1, M, q, 1, one};
    CHECK_OK(rb_friction_solve_soclcp(&cone, NULL, r, u, NULL));
    CHECK_ABS(r[0], 0.5, 1e-7, "half a line");
    assert_non_null(rb_friction_status_text(RB_OK, 1e-8, NULL));
}

/* ---- The canonical SOCLCP ---------------------------------------------------------- */

TEST(cones_of_every_size)
{
    enum { N = 14, CONES = 6 };
    const int size[CONES] = {3, 1, 5, 2, 1, 2};
    unsigned seed = 5;
    double M[N * N], B[N * N], q[N], want[N], planted[N], x[N], y[N];
    for (int k = 0; k < N * N; k++)
        B[k] = uniform_from(&seed);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            M[i + j * N] = (i == j) + 0.5 * (i > j) - 0.5 * (i < j); /* monotone */
            for (int k = 0; k < N; k++)
                M[i + j * N] += B[i + k * N] * B[j + k * N];
        }
    /* on the boundary: x = a (1, e), y = b (1, -e); inside, or zero */
    for (int k = 0, at = 0; k < CONES; at += size[k++]) {
        double e[5], norm = 0.0;
        for (int a = 1; a < size[k]; a++)
            e[a] = uniform_from(&seed), norm = hypot(norm, e[a]);
        const double ax = k % 3 == 2 ? 0.0 : 1.5, ay = k % 3 == 1 ? 0.0 : 0.5;
        want[at] = size[k] == 1 && k % 3 == 0 ? 0.0 : ax;
        planted[at] = ay;
        for (int a = 1; a < size[k]; a++) {
            want[at + a] = ax * e[a] / norm * (k % 3 == 1 ? 0.3 : 1.0);
            planted[at + a] = -ay * e[a] / norm * (k % 3 == 2 ? 0.3 : 1.0);
        }
    }
    for (int i = 0; i < N; i++) {
        q[i] = planted[i];
        for (int j = 0; j < N; j++)
            q[i] -= M[i + j * N] * want[j];
    }
    const rb_friction_soclcp_problem p = {N, M, q, CONES, size};
    rb_friction_options opt = rb_friction_defaults();
    rb_friction_info info;
    opt.tol = 1e-12;
    CHECK_MAX(rb_friction_soclcp_error(&p, want, y), 1e-14, "planted");
    CHECK_OK(rb_friction_solve_soclcp(&p, &opt, x, y, &info));
    for (int i = 0; i < N; i++) {
        CHECK_ABS(x[i], want[i], 1e-9, "x[%d]", i);
        CHECK_ABS(y[i], planted[i], 1e-9, "y[%d]", i);
    }
}

/* With M = I the solution is the projection of -q, in closed form (docs/friction.md). */
TEST(the_closest_point_of_a_cone)
{
    const double M[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const int size[] = {3};
    /* outside, inside, and inside the polar cone, whose closest point is the apex */
    const double point[3][3] = {{0.5, 3.0, -4.0}, {6.0, 3.0, -4.0}, {-6.0, 3.0, -4.0}};
    const double want[3][3] = {{2.75, 1.65, -2.2}, {6.0, 3.0, -4.0}, {0.0, 0.0, 0.0}};
    for (int k = 0; k < 3; k++) {
        double q[3], x[3], y[3];
        rb_friction_info info;
        for (int i = 0; i < 3; i++)
            q[i] = -point[k][i];
        const rb_friction_soclcp_problem p = {3, M, q, 1, size};
        CHECK_OK(rb_friction_solve_soclcp(&p, NULL, x, y, &info));
        assert_int_equal(info.contact, -1);
        for (int i = 0; i < 3; i++) {
            CHECK_ABS(x[i], want[k][i], 1e-7, "point %d, x[%d]", k, i);
            CHECK_ABS(y[i], want[k][i] - point[k][i], 1e-7, "point %d, y[%d]", k, i);
        }
    }
}

/* x = (1, e), y = (1, -e) / 2 on one cone of 200 entries: W = 1, q = y - x. */
TEST(a_cone_of_any_size)
{
    enum { N = 200 };
    const int size[] = {N};
    static double M[N * N], q[N], x[N], y[N];
    unsigned seed = 9;
    double norm = 0.0;
    for (int i = 1; i < N; i++)
        x[i] = uniform_from(&seed), norm = hypot(norm, x[i]);
    x[0] = norm;
    for (int i = 0; i < N; i++) {
        M[i + i * N] = 1.0;
        q[i] = (i ? -0.5 : 0.5) * x[i] - x[i];
    }
    const rb_friction_soclcp_problem p = {N, M, q, 1, size};
    rb_friction_info info;
    CHECK_MAX(rb_friction_soclcp_error(&p, x, y), 1e-14, "planted");
    CHECK_OK(rb_friction_solve_soclcp(&p, NULL, x, y, &info));
    CHECK_ABS(x[0], norm, 1e-6, "x_0");
}

TEST(bad_cones_are_refused)
{
    const double M[] = {1.0, 0.0, 0.0, 1.0}, q[] = {-1.0, NAN}, fine[] = {-1.0, 1.0};
    const int ones[] = {1, 1}, three[] = {3}, none[] = {0, 2};
    double x[2], y[2];
    rb_friction_info info;
    rb_friction_soclcp_problem p = {2, M, q, 2, ones};
    CHECK_STATUS(rb_friction_solve_soclcp(&p, NULL, x, y, &info), RB_EINVAL);
    assert_non_null(strstr(info.msg.text, "q: entry 2"));
    p = (rb_friction_soclcp_problem){2, M, fine, 1, three};
    CHECK_STATUS(rb_friction_solve_soclcp(&p, NULL, x, y, &info), RB_EINVAL);
    p = (rb_friction_soclcp_problem){2, M, fine, 2, none};
    CHECK_STATUS(rb_friction_solve_soclcp(&p, NULL, x, y, &info), RB_EINVAL);
    p = (rb_friction_soclcp_problem){2, M, fine, 2, ones};
    CHECK_OK(rb_friction_solve_soclcp(&p, NULL, x, y, &info));
    CHECK_ABS(x[0], 1.0, 1e-7, "an LCP is one with half-lines");
    CHECK_ABS(y[1], 1.0, 1e-7, "its slack");
}

/* ---- Memory ------------------------------------------------------------------------ */

TEST(failing_allocations_are_reported)
{
    int solvers;
    const rb_friction_solver *all = rb_friction_solvers(&solvers);
    for (int k = 0; k < solvers; k++) {
        OWNED(rb_friction_problem) p;
        rb_friction_info info;
        double r[10], u[10];
        chain(2, 5, &p);
        int count = 0;
        for (rb_status s = RB_ENOMEM; s != RB_OK && count < 300; count++) {
            alloc_fail_after(count);
            s = rb_friction_solve(all[k].name, &p, NULL, &(rb_friction_solution){r, u, NULL},
                                  &info);
            const int refused = alloc_failed();
            alloc_succeed();
            assert_true(s == RB_OK || refused);
        }
        assert_true(count > 3 && count < 300);
    }
}

/* ---- Files of other projects ------------------------------------------------------- */

static void solve_outside(const char *file)
{
    OWNED(rb_friction_problem) p;
    rb_friction_info info;
    double r[900], u[900];
    rb_friction_errors error;
    CHECK_OK(rb_friction_read(outside_data(file), &p, &message));
    CHECK_OK(rb_friction_solve(NULL, &p, NULL, &(rb_friction_solution){r, u, NULL}, &info));
    CHECK_OK(rb_friction_error(&p, r, NULL, NULL, &error));
    CHECK_MAX(error.residual, 1e-8, "%s", file);
}

TEST(fclib_files_are_solved)
{
    solve_outside("fclib/CubeH8.hdf5");
    solve_outside("fclib/Capsules-i125-1213.hdf5");
    solve_outside("fclib/LMGC_100_PR_PerioBox-i00361-60-03000.hdf5");
}

TEST(siconos_files_are_solved)
{
    solve_outside("siconos/fc2d/FC2D_SliderCrankLagrangian00000.dat");
    solve_outside("siconos/fc2d/FrictionContactProblem00394.dat");
    solve_outside("siconos/fc2d/FrictionContactProblem00031.dat");
    solve_outside("siconos/fc2d/FrictionContactProblem00071.dat");
    solve_outside("siconos/fc2d/FrictionContactProblem00727.dat");
    solve_outside("siconos/fc3d/FC3D_Example1_SBM.dat");
    solve_outside("siconos/fc3d/FrictionContact3D_1c.dat");
    solve_outside("siconos/fc3d/Rover11035.dat");
    solve_outside("siconos/fc3d/Rover1039.dat");
    solve_outside("siconos/fc3d/NESpheres_10_1.dat");
    solve_outside("siconos/fc3d/OneObject-i100000-499.hdf5.dat");
    solve_outside("siconos/fc3d/Capsules-i101-404.dat");
}

TEST(the_soclcp_file_is_solved)
{
    /* from its README: the same reaction three times, slope 0.1 */
    const double want[] = {1.303196, -0.041211, -0.123632};
    OWNED(rb_friction_soclcp_data) d;
    rb_friction_info info;
    double x[9], y[9];
    CHECK_OK(rb_friction_soclcp_read(outside_data("siconos/soclcp/Example1_SOCLCP_SBM.dat"), &d,
                                     &message));
    CHECK_OK(rb_friction_solve_soclcp(&d.problem, NULL, x, y, &info));
    for (int i = 0; i < 9; i++)
        CHECK_ABS(x[i] / (i % 3 ? 1.0 : d.tau[i / 3]), want[i % 3], 1e-6, "x[%d]", i);
}

TEST(other_text_files_are_refused)
{
    rb_friction_problem p;
    CHECK_SAYS(rb_friction_read(outside_data("siconos/lcp/lcp_mmc.dat"), &p, &message), RB_EFORMAT,
               "rollbem lcp");
    CHECK_STATUS(
        rb_friction_read(outside_data("siconos/soclcp/Example1_SOCLCP_SBM.dat"), &p, &message),
        RB_EFORMAT);
    CHECK_STATUS(rb_friction_read("/nowhere", &p, &message), RB_ENOENT);
    CHECK_STATUS(rb_friction_read_as(outside_data("fclib/CubeH8.hdf5"), RB_FRICTION_FILE_SICONOS,
                                     &p, &message),
                 RB_EFORMAT);
}

/* ---- Profiles ---------------------------------------------------------------------- */

TEST(profiles_count_as_dolan_and_more_do)
{
    /* three problems, two solvers; the third is solved by neither */
    const double cost[] = {1.0, 4.0, INFINITY, 3.0, 2.0, INFINITY};
    const double tau[] = {1.0, 2.0, 3.0};
    const double want[] = {1.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 3, 1.0 / 3, 2.0 / 3};
    double rho[6];
    rb_friction_profile(3, 2, cost, 3, tau, rho);
    for (int k = 0; k < 6; k++)
        CHECK_ABS(rho[k], want[k], 1e-15, "rho[%d]", k);
}

/* The table of docs/friction.md says of every solver what the program says. */
TEST(the_documentation_lists_every_solver)
{
    static char text[200000];
    int count;
    const rb_friction_solver *all = rb_friction_solvers(&count);
    FILE *doc = fopen("docs/friction.md", "r");
    if (!doc)
        skip(); /* not run from the project's folder */
    text[fread(text, 1, sizeof text - 1, doc)] = '\0';
    fclose(doc);
    const char *at = NOT_NULL(strstr(text, "| name | family | method |"));
    for (int k = 0; k < count; k++) {
        char line[300];
        snprintf(line, sizeof line, "\n| `%s` | %s | %s%s |\n", all[k].name, all[k].method,
                 all[k].summary, all[k].needs & RB_FRICTION_ONLY_2D ? " (2D)" : "");
        at = strstr(at, line);
        if (!at)
            fail_msg("docs/friction.md has no line, in its place, '%s'", line + 1);
        at += strlen(line) - 1;
    }
    assert_int_not_equal(at[1], '|');
}

RUN_TESTS(NULL, NULL)
