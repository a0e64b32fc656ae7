/* Mixed problems: classical solutions, support, refusals. */
#include "bem_shapes.h"

static const rb_bem_material material = {.shear = 80.0, .poisson = 0.3};

/* Elements 0 ... n - 1 of a circle are centred on the axes (n a multiple of 4).  Held by
 * symmetry alone: ux = 0 at the top and bottom, uy = 0 at the left and right. */
static void hold_by_symmetry(rb_bem_mesh *mesh, int n)
{
    mesh->condition[2 * (n / 4)] = mesh->condition[2 * (3 * n / 4)] = RB_BEM_DISPLACEMENT;
    mesh->condition[1] = mesh->condition[2 * (n / 2) + 1] = RB_BEM_DISPLACEMENT;
}

/* Pressure p on elements first ... first + n - 1 of a circle about the origin; outward:
 * +1 where the body lies inside, -1 in a hole. */
static void press(rb_bem_mesh *mesh, int first, int n, double p, double outward)
{
    for (int j = first; j < first + n; j++) {
        const double x = midpoint_x(mesh, j), y = midpoint_y(mesh, j), r = hypot(x, y);
        const double t[2] = {-p * outward * x / r, -p * outward * y / r};
        for (int k = 0; k < 2; k++)
            if (mesh->condition[2 * j + k] == RB_BEM_TRACTION)
                mesh->value[2 * j + k] = t[k];
    }
}

/* Largest error of the radial displacement against `want` on a circle, relative. */
static double radial_error(const rb_bem_mesh *mesh, const double *u, int first, int n, double want)
{
    double error = 0.0;
    for (int j = first; j < first + n; j++) {
        const double x = midpoint_x(mesh, j), y = midpoint_y(mesh, j), r = hypot(x, y);
        error = fmax(error, hypot(u[2 * j] - want * x / r, u[2 * j + 1] - want * y / r));
    }
    return error / fabs(want);
}

static void solve_boundary(const rb_bem_mesh *mesh, double *u, double *t)
{
    held_system *system;
    CHECK_OK(rb_bem_system_create(mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, NULL, u, t));
}

/* u_r = -p R (1-2nu)/(2G) */
static double disc_error(int n)
{
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_alloc(n, &mesh));
    put_circle(&mesh, 0, n, 2.0, 1, -M_PI / n);
    hold_by_symmetry(&mesh, n);
    press(&mesh, 0, n, 5.0, 1.0);
    SCRATCH double *u = rb_alloc(2 * (size_t)n, 1), *t = rb_alloc(2 * (size_t)n, 1);
    solve_boundary(&mesh, u, t);
    return radial_error(&mesh, u, 0, n, -5.0 * 2.0 * 0.4 / (2.0 * 80.0));
}

/* Lame, internal pressure p: u_r(r) = p a^2/(2G (b^2-a^2)) [(1-2nu) r + b^2/r] */
static double lame(double r)
{
    const double a = 1.0, b = 2.0, p = 3.0;
    return p * a * a / (2.0 * 80.0 * (b * b - a * a)) * (0.4 * r + b * b / r);
}

static double thick_ring_error(int n)
{
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_alloc(2 * n, &mesh));
    put_circle(&mesh, 0, n, 2.0, 1, -M_PI / n);
    put_circle(&mesh, n, n, 1.0, -1, M_PI / n);
    hold_by_symmetry(&mesh, n);
    press(&mesh, n, n, 3.0, -1.0);
    SCRATCH double *u = rb_alloc(4 * (size_t)n, 1), *t = rb_alloc(4 * (size_t)n, 1);
    solve_boundary(&mesh, u, t);
    const double error =
        fmax(radial_error(&mesh, u, 0, n, lame(2.0)), radial_error(&mesh, u, n, n, lame(1.0)));
    return error;
}

static void check_first_order(double (*error)(int), int n, double bound, const char *what)
{
    const double e[3] = {error(n), error(2 * n), error(4 * n)};
    print_errors(what, e[0], e[1], e[2], 2.0);
    CHECK_MAX(e[2], bound, "%s on %d elements", what, 4 * n);
    CHECK_ABS(order(e[0], e[1]), 1.0, 0.2, "order of %s", what);
    CHECK_ABS(order(e[1], e[2]), 1.0, 0.15, "order of %s", what);
}

TEST(disc_under_pressure)
{
    check_first_order(disc_error, 80, 1e-3, "disc");
}

/* Columns of a power of two of numbers are set further apart in memory. */
TEST(discs_of_any_size_are_solved)
{
    CHECK_REL(256.0 * disc_error(256), 252.0 * disc_error(252), 0.01, "n error");
}

TEST(thick_ring_under_internal_pressure)
{
    check_first_order(thick_ring_error, 40, 5.5e-3, "ring");
}

/* Given displacements of the exact solution all round, nu = 0.3: the tractions come out. */
static double dirichlet_error(int n)
{
    OWNED(rb_bem_mesh) mesh = circle(n, 2.0);
    double *u = rb_alloc(2 * (size_t)n, 1), *t = rb_alloc(2 * (size_t)n, 1), error = 0.0;
    for (int j = 0; j < n; j++) /* strain 0.01 along x, t_x = 2G (1-nu)/(1-2nu) 0.01 n_x */
        give(&mesh, j, RB_BEM_DISPLACEMENT, 0.01 * midpoint_x(&mesh, j), 0.0);
    solve_boundary(&mesh, u, t);
    for (int j = 0; j < n; j++) {
        const double x = midpoint_x(&mesh, j), y = midpoint_y(&mesh, j), r = hypot(x, y);
        const double along = 2 * 80.0 * 0.7 / 0.4 * 0.01, across = 2 * 80.0 * 0.3 / 0.4 * 0.01;
        error = fmax(error, hypot(t[2 * j] - along * x / r, t[2 * j + 1] - across * y / r));
    }
    free(u);
    free(t);
    return error;
}

TEST(given_displacements_give_the_tractions)
{
    check_first_order(dirichlet_error, 40, 5.5e-3, "tractions");
}

/* ---- The solution itself ----------------------------------------------------------- */

/* H u = G t holds for what solve() returns, and what was given is returned. */
TEST(the_solution_satisfies_the_equations)
{
    const double ends[] = {-8.0, -5.0, -1.0, 2.0, 4.0, 7.0};
    const rb_bem_cylinder cylinder = {.radius = 50.0, .support = RB_BEM_ARC, .arc = 0.5};
    OWNED(rb_bem_mesh) mesh;
    held_system *system;
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, 4, ends, &mesh, NULL));
    give(&mesh, 20, RB_BEM_TRACTION, 3.0, -1.0);
    give(&mesh, 21, RB_BEM_TRACTION, 1.0, 0.0); /* along one axis alone */
    give(&mesh, 22, RB_BEM_TRACTION, 0.0, 1.0);
    const size_t d = 2 * (size_t)mesh.n;
    SCRATCH double *H = rb_alloc(d, d), *G = rb_alloc(d, d), *u = rb_alloc(d, 1),
                   *t = rb_alloc(d, 1);
    double load[8] = {0.1, 1.0, 0.2, 3.0, -0.3, 2.0, 0.0, 0.5};
    CHECK_OK(rb_bem_assemble(&mesh, material, H, G, (int)d, NULL));
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, load, u, t));
    const double scale = rb_norm_inf(d, u);
    for (size_t i = 0; i < d; i++) {
        double residual = 0.0;
        for (size_t j = 0; j < d; j++)
            residual += H[i + j * d] * u[j] - G[i + j * d] * t[j];
        CHECK_ABS(residual, 0.0, 1e-12 * scale, "row %d", (int)i);
        const double given = i < 8 ? load[i] : mesh.value[i];
        CHECK_ABS(mesh.condition[i] == RB_BEM_DISPLACEMENT ? u[i] : t[i], given, 0.0, "dof %d",
                  (int)i);
    }
    CHECK_MAX(1e-6, rb_bem_system_rcond(system), "condition");
    assert_int_equal(rb_bem_system_mesh(system)->n, mesh.n);
    double assembly, factor;
    rb_bem_system_seconds(system, &assembly, &factor);
    assert_true(assembly > 0.0 && factor > 0.0);
}

/* Lengths in other units, and moduli: A is as well conditioned. */
TEST(the_condition_is_that_of_any_units)
{
    double rcond[2];
    for (int k = 0; k < 2; k++) {
        const double length = k ? 1e3 : 1.0;
        double ends[] = {-8.0, -5.0, -1.0, 2.0, 4.0, 7.0};
        for (int i = 0; i < 6; i++)
            ends[i] *= length;
        const rb_bem_cylinder cylinder = {
            .radius = 50.0 * length, .support = RB_BEM_ARC, .arc = 0.5};
        rb_bem_material other = material;
        other.shear *= k ? 1e-6 : 1.0;
        OWNED(rb_bem_mesh) mesh;
        held_system *system;
        CHECK_OK(rb_bem_mesh_cylinder(&cylinder, 4, ends, &mesh, NULL));
        CHECK_OK(rb_bem_system_create(&mesh, other, &system, NULL));
        rcond[k] = rb_bem_system_rcond(system);
    }
    CHECK_REL(rcond[1], rcond[0], 1e-6, "condition");
}

/* ---- Support (B6) ------------------------------------------------------------------ */

/* A ring that is pulled outside, whose hole is held all around, or along x alone. */
static void pull_ring(double nu, int all_around, double *u, double *t)
{
    enum { n = 40 };
    OWNED(rb_bem_mesh) mesh = ring(n, 2.0, 1.0);
    for (int j = 0; j < n; j++) {
        mesh.condition[2 * (n + j)] = RB_BEM_DISPLACEMENT;
        if (all_around)
            mesh.condition[2 * (n + j) + 1] = RB_BEM_DISPLACEMENT;
        mesh.value[2 * j] = 0.3 + 0.1 * cos(2.0 * M_PI * j / n);
        mesh.value[2 * j + 1] = 0.2 * sin(4.0 * M_PI * j / n);
    }
    mesh.condition[1] = RB_BEM_DISPLACEMENT; /* the rightmost element, along y */
    mesh.value[1] = 0.0;
    held_system *system;
    CHECK_OK(rb_bem_system_create(&mesh, (rb_bem_material){1.0, nu}, &system, &message));
    CHECK_OK(rb_bem_system_solve(system, NULL, u, t));
    if (all_around && nu == 0.5) {
        double mean = 0.0;
        for (int j = n; j < 2 * n; j++)
            mean += t[2 * j] * (mesh.y1[j] - mesh.y0[j]) - t[2 * j + 1] * (mesh.x1[j] - mesh.x0[j]);
        CHECK_ABS(mean, 0.0, 1e-10, "mean pressure on the hole");
    }
}

/* Displacements go on to nu = 1/2, and so do tractions but for the pressure that a hole
 * which is held all around leaves open: there its mean is zero. */
TEST(incompressible_bodies_are_a_limit)
{
    enum { n = 80 };
    for (int all = 0; all < 2; all++) {
        double u[2][2 * n], t[2][2 * n];
        pull_ring(0.5, all, u[0], t[0]);
        pull_ring(0.5 - 1e-6, all, u[1], t[1]);
        const double size[2] = {rb_norm_inf(2 * n, u[0]), rb_norm_inf(2 * n, t[0])};
        for (int i = 0; i < 2 * n; i++) {
            CHECK_ABS(u[1][i], u[0][i], 1e-4 * size[0], "%d: u of %d", all, i);
            if (!all)
                CHECK_ABS(t[1][i], t[0][i], 1e-3 * size[1], "%d: t of %d", all, i);
        }
    }
}

static void expect_free(rb_bem_mesh *mesh, const char *motions)
{
    rb_bem_system *system;
    CHECK_STATUS(rb_bem_system_create(mesh, material, &system, &message), RB_EINVAL);
    assert_null(system);
    if (!strstr(message.text, motions))
        fail_msg("'%s' does not say '%s'", message.text, motions);
}

TEST(a_body_without_support_is_refused)
{
    enum { n = 16 };
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_alloc(n, &mesh));
    put_circle(&mesh, 0, n, 1.0, 1, -M_PI / n);
    expect_free(&mesh, "free in translation along x, translation along y, rotation;");
    mesh.condition[0] = RB_BEM_DISPLACEMENT;
    expect_free(&mesh, "free in translation along y, rotation;");
    mesh.condition[1] = RB_BEM_DISPLACEMENT;
    expect_free(&mesh, "free in rotation;");
    mesh.condition[2 * (n / 2)] = RB_BEM_DISPLACEMENT; /* opposite, same height */
    expect_free(&mesh, "free in rotation;");
    mesh.condition[1] = RB_BEM_TRACTION;
    mesh.condition[2 * 3] = RB_BEM_DISPLACEMENT; /* another height, but x only */
    expect_free(&mesh, "free in translation along y;");
    mesh.condition[1] = RB_BEM_DISPLACEMENT;
    held_system *system;
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
}

/* Two bodies, one of them held: the count sees a support, the matrix does not. */
TEST(a_second_body_without_support_is_singular)
{
    enum { n = 16 };
    OWNED(rb_bem_mesh) mesh;
    rb_bem_system *system;
    CHECK_OK(rb_bem_mesh_alloc(2 * n, &mesh));
    put_circle(&mesh, 0, n, 1.0, 1, 0.0);
    put_circle(&mesh, n, n, 1.0, 1, 0.0);
    for (int j = n; j < 2 * n; j++) {
        mesh.x0[j] += 5.0;
        mesh.x1[j] += 5.0;
    }
    give(&mesh, 0, RB_BEM_DISPLACEMENT, 0.0, 0.0);
    give(&mesh, 5, RB_BEM_DISPLACEMENT, 0.0, 0.0);
    CHECK_SAYS(rb_bem_system_create(&mesh, material, &system, &message), RB_SINGULAR, "singular");
    assert_null(system);
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(bad_input_is_refused)
{
    enum { n = 16 };
    OWNED(rb_bem_mesh) mesh = circle(n, 1.0);
    rb_bem_system *system;
    rb_bem_flexibility f;
    double H[4 * n * n];
    give(&mesh, 0, RB_BEM_DISPLACEMENT, 0.0, 0.0);
    give(&mesh, 5, RB_BEM_DISPLACEMENT, 0.0, 0.0);
    CHECK_SAYS(rb_bem_system_create(&mesh, (rb_bem_material){0.0, 0.3}, &system, &message),
               RB_EINVAL, "shear");
    CHECK_STATUS(rb_bem_assemble(&mesh, material, H, NULL, 2 * n - 1, &message), RB_EINVAL);
    assert_string_equal(message.text, "leading dimension 31: expected at least 32");
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, &message));
    CHECK_SAYS(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &message), RB_EINVAL,
               "no contact");
    assert_int_equal(f.n, 0);
    rb_bem_system_free(system);
    mesh.x0[3] = NAN;
    CHECK_STATUS(rb_bem_assemble(&mesh, material, H, NULL, 2 * n, &message), RB_EINVAL);
    CHECK_STATUS(rb_bem_system_create(&mesh, material, &system, &message), RB_EINVAL);
    rb_bem_system_free(NULL);
}

TEST(failing_memory_is_reported)
{
    const double ends[] = {-0.2, -0.1, 0.1, 0.2};
    const rb_bem_cylinder cylinder = {
        .radius = 1.0, .support = RB_BEM_HUB, .hub_ratio = 0.4, .outer_elements = 20};
    double H[40000], u[200], t[200];
    for (int count = 0, failed = 1; failed; count++) {
        OWNED(rb_bem_mesh) mesh = {0};
        held_system *system = NULL;
        OWNED(rb_bem_flexibility) f = {0};
        rb_message why = {.text = ""};
        char expected[sizeof why.text];
        alloc_fail_after(count);
        rb_status s = rb_bem_mesh_cylinder(&cylinder, 2, ends, &mesh, NULL);
        if (s == RB_OK) {
            give(&mesh, 5, RB_BEM_TRACTION, 1.0, 1.0);
            s = rb_bem_system_create(&mesh, material, &system, &why);
            snprintf(expected, sizeof expected,
                     "boundary elements: out of memory for %d elements (%.3g MB)", mesh.n,
                     1e-6 * rb_bem_system_bytes(mesh.n, mesh.contact_n));
            assert_string_equal(why.text, s == RB_OK ? "" : expected);
        }
        if (s == RB_OK)
            s = rb_bem_system_solve(system, NULL, u, t);
        if (s == RB_OK)
            s = rb_bem_condense(system, RB_BEM_NORMALS_SURFACE, &f, NULL);
        if (s == RB_OK)
            s = rb_bem_assemble(&mesh, material, H, NULL, 2 * mesh.n, NULL);
        failed = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(s, failed ? RB_ENOMEM : RB_OK);
        assert_true(mesh.n <= 100);
    }
}

RUN_TESTS(NULL, NULL)
