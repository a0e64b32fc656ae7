/* Displacement and stress inside the body (B8), from exact and from computed boundary
 * values. */
#include "bem_shapes.h"

#include <complex.h>

static const rb_bem_material material = {.shear = 80.0, .poisson = 0.3};

/* ---- Boundary values of a field known in closed form ------------------------------- */

/* phi = z^2 + i z/2, psi = 2 z - i z^2: a bending, a shear, a stretch and a rotation */
static void known_field(double x, double y, double u[2], double s[3])
{
    const double G = material.shear, kap = 3.0 - 4.0 * material.poisson;
    const double complex z = x + y * I, phi = z * z + 0.5 * I * z, d = 2.0 * z + 0.5 * I,
                         psi = 2.0 * z - I * z * z, dpsi = 2.0 - 2.0 * I * z;
    const double complex w = (kap * phi - z * conj(d) - conj(psi)) / (2.0 * G);
    const double complex m = 2.0 * (conj(z) * 2.0 + dpsi);
    u[0] = creal(w);
    u[1] = cimag(w);
    const double mean = 2.0 * creal(d);
    s[0] = mean - 0.5 * creal(m);
    s[1] = mean + 0.5 * creal(m);
    s[2] = 0.5 * cimag(m);
}

static void boundary_values(const rb_bem_mesh *mesh, double *u, double *t)
{
    for (int j = 0; j < mesh->n; j++) {
        const double dx = mesh->x1[j] - mesh->x0[j], dy = mesh->y1[j] - mesh->y0[j],
                     h = hypot(dx, dy), n[2] = {dy / h, -dx / h};
        double s[3];
        known_field(midpoint_x(mesh, j), midpoint_y(mesh, j), u + 2 * j, s);
        t[2 * j] = s[0] * n[0] + s[2] * n[1];
        t[2 * j + 1] = s[2] * n[0] + s[1] * n[1];
    }
}

typedef struct {
    double u, s;
} errors;

/* Largest errors at points `depth` element lengths below elements all round, over
 * three places along it. */
static errors error_at_depth(int n, double depth)
{
    OWNED(rb_bem_mesh) mesh = ring(n, 1.0, 0.4);
    SCRATCH double *u = rb_alloc(2 * (size_t)mesh.n, 1), *t = rb_alloc(2 * (size_t)mesh.n, 1);
    errors e = {0, 0};
    boundary_values(&mesh, u, t);
    for (int j = 0; j < mesh.n; j += n / 20)
        for (int place = -1; place <= 1; place++) {
            const double dx = mesh.x1[j] - mesh.x0[j], dy = mesh.y1[j] - mesh.y0[j];
            const double xy[2] = {midpoint_x(&mesh, j) + 0.3 * place * dx - depth * dy,
                                  midpoint_y(&mesh, j) + 0.3 * place * dy + depth * dx};
            double got_u[2], got[3], want_u[2], want[3];
            CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                     (rb_bem_points){1, xy}, got_u, got, NULL));
            known_field(xy[0], xy[1], want_u, want);
            for (int c = 0; c < 2; c++)
                e.u = fmax(e.u, fabs(got_u[c] - want_u[c]));
            for (int c = 0; c < 3; c++)
                e.s = fmax(e.s, fabs(got[c] - want[c]));
        }
    return e;
}

/* Stress is of order 5, u of order 0.05.  u is second order everywhere; so is stress from
 * one element inwards; closer, the constant tractions of neighbours jump: first order. */
TEST(a_known_field_is_reproduced)
{
    const struct {
        double depth, u, s, order_s;
    } row[] = {{0.0, 1e-5, 0.12, 0.95},
               {0.1, 1e-5, 0.06, 0.95},
               {0.5, 1e-5, 0.02, 1.0},
               {1.0, 1e-5, 0.003, 1.7},
               {3.0, 1e-5, 0.002, 1.7}};
    for (int k = 0; k < 5; k++) {
        const errors coarse = error_at_depth(60, row[k].depth),
                     fine = error_at_depth(120, row[k].depth),
                     finest = error_at_depth(240, row[k].depth);
        print_errors("displacement", coarse.u, fine.u, finest.u, 2.0);
        print_errors("stress", coarse.s, fine.s, finest.s, 2.0);
        CHECK_MAX(finest.u, row[k].u, "u at depth %g", row[k].depth);
        CHECK_MAX(finest.s, row[k].s, "stress at depth %g", row[k].depth);
        CHECK_MAX(1.65, order(coarse.u, fine.u), "order of u at depth %g", row[k].depth);
        CHECK_MAX(1.65, order(fine.u, finest.u), "order of u at depth %g", row[k].depth);
        CHECK_MAX(row[k].order_s, order(coarse.s, fine.s), "order at depth %g", row[k].depth);
        CHECK_MAX(row[k].order_s, order(fine.s, finest.s), "order at depth %g", row[k].depth);
    }
}

/* A rigid motion has no stress, on the surface and off it, and comes out to second order
 * because it is linear along the contour. */
TEST(rigid_motions_have_no_stress)
{
    enum { n = 64 };
    OWNED(rb_bem_mesh) mesh = circle(n, 2.0);
    double u[2 * n], t[2 * n] = {0}, got[2], s[3];
    for (int j = 0; j < n; j++) {
        u[2 * j] = 0.3 - 0.1 * midpoint_y(&mesh, j);
        u[2 * j + 1] = -0.2 + 0.1 * midpoint_x(&mesh, j);
    }
    for (int k = 0; k < 30; k++) {
        const double r = k * 1.9 / 29, xy[2] = {r * cos(3.0 * k), r * sin(3.0 * k)};
        CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t}, (rb_bem_points){1, xy},
                                 got, s, NULL));
        CHECK_ABS(got[0], 0.3 - 0.1 * xy[1], 5e-4, "ux %d", k);
        CHECK_ABS(got[1], -0.2 + 0.1 * xy[0], 5e-4, "uy %d", k);
        CHECK_ABS(rb_norm_inf(3, s), 0.0, material.shear * 0.1 * 0.03, "stress %d", k);
    }
}

/* ---- Diametral compression --------------------------------------------------------- */

/* Pressure 1 on arcs of half-angle alpha about the top and bottom; at the centre
 * sxx = (2/pi)(sin 2 alpha - alpha), syy = -(2/pi)(sin 2 alpha + alpha)  (Hondros).
 * The arcs end at element ends: alpha = (2k + 1) pi/n. */
static errors compression_error(int n, double alpha)
{
    OWNED(rb_bem_mesh) mesh = pressed_disc(n, alpha);
    held_system *system;
    double *u = rb_alloc(2 * (size_t)n, 1), *t = rb_alloc(2 * (size_t)n, 1), s[3], at[2];
    CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
    CHECK_OK(rb_bem_system_solve(system, NULL, u, t));
    CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                             (rb_bem_points){1, (const double[]){0, 0}}, at, s, NULL));
    CHECK_ABS(hypot(at[0], at[1]), 0.0, 1e-12, "the centre stays");
    CHECK_ABS(s[2], 0.0, 1e-12, "no shear at the centre");
    const double sxx = 2 / M_PI * (sin(2 * alpha) - alpha),
                 syy = -2 / M_PI * (sin(2 * alpha) + alpha);
    const errors e = {.s = fmax(fabs(s[0] / sxx - 1), fabs(s[1] / syy - 1))};
    free(u);
    free(t);
    return e;
}

TEST(diametral_compression_at_the_centre)
{
    const double alpha = M_PI / 20.0;
    /* n alpha/pi odd */
    const double coarse = compression_error(60, alpha).s, fine = compression_error(180, alpha).s,
                 finest = compression_error(540, alpha).s;
    print_errors("compression", coarse, fine, finest, 3.0);
    CHECK_MAX(finest, 2e-3, "error on 540 elements");
    CHECK_ABS(order(coarse, fine) / log2(3), 1.15, 0.15, "order");
    CHECK_ABS(order(fine, finest) / log2(3), 1.1, 0.1, "order");
}

/* A polygon held at two sides and pulled at a third one, in another unit of length:
 * stresses stay, displacements become as many times as long. */
TEST(no_unit_of_length_is_preferred)
{
    enum { n = 24, P = 3 };
    static const double inside[2 * P] = {0.1, 0.2, -0.5, 0.3, 0.0, -0.93};
    double u[2][2 * P], s[2][3 * P];
    for (int k = 0; k < 2; k++) {
        const double unit = k ? 1e-3 : 1.0;
        OWNED(rb_bem_mesh) mesh = circle(n, unit);
        held_system *system;
        double at[2 * n], t[2 * n], xy[2 * P];
        for (int i = 0; i < 2 * P; i++)
            xy[i] = unit * inside[i];
        for (int j = 0; j < 8; j++)
            give(&mesh, 3 * j, RB_BEM_DISPLACEMENT, 0.0, j == 2 ? 1e-3 * unit : 0.0);
        give(&mesh, 4, RB_BEM_TRACTION, 1.0, 3.0);
        CHECK_OK(rb_bem_system_create(&mesh, material, &system, NULL));
        CHECK_OK(rb_bem_system_solve(system, NULL, at, t));
        CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, at, t}, (rb_bem_points){P, xy},
                                 u[k], s[k], NULL));
    }
    for (int i = 0; i < 2 * P; i++)
        CHECK_ABS(1e3 * u[1][i], u[0][i], 1e-14, "displacement %d", i);
    for (int i = 0; i < 3 * P; i++)
        CHECK_ABS(s[1][i], s[0][i], 1e-11, "stress %d", i);
}

/* ---- Equilibrium ------------------------------------------------------------------- */

TEST(the_field_is_in_equilibrium)
{
    enum { n = 60 };
    OWNED(rb_bem_mesh) mesh = ring(n, 1.0, 0.4);
    double u[4 * n], t[4 * n];
    boundary_values(&mesh, u, t);
    for (int j = 0; j < 2 * n; j += 5)
        for (double depth = 0.1; depth < 1.0; depth *= 2.0) {
            const double dx = mesh.x1[j] - mesh.x0[j], dy = mesh.y1[j] - mesh.y0[j],
                         x = midpoint_x(&mesh, j) + 0.2 * dx - depth * dy,
                         y = midpoint_y(&mesh, j) + 0.2 * dy + depth * dx, h = 1e-4 * hypot(dx, dy);
            const double xy[8] = {x + h, y, x - h, y, x, y + h, x, y - h};
            double s[12];
            CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                     (rb_bem_points){4, xy}, NULL, s, NULL));
            CHECK_ABS((s[0] - s[3] + s[8] - s[11]) / (2 * h), 0.0, 1e-4, "x, %d, %g", j, depth);
            CHECK_ABS((s[2] - s[5] + s[7] - s[10]) / (2 * h), 0.0, 1e-4, "y, %d, %g", j, depth);
        }
}

/* ---- Refusals ---------------------------------------------------------------------- */

TEST(bad_input_is_refused)
{
    enum { n = 20 };
    OWNED(rb_bem_mesh) mesh = ring(n, 1.0, 0.4);
    double u[4 * n] = {0}, t[4 * n] = {0}, s[9];
    const double outside[] = {0.5, 0.5, 1.5, 0.0, 0.7, 0.0}, hole[] = {0.1, 0.1},
                 nan[] = {NAN, 0.0};
    CHECK_SAYS(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                               (rb_bem_points){3, outside}, NULL, s, &message),
               RB_EINVAL, "point 1 at (1.5, 0) lies outside");
    CHECK_STATUS(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                 (rb_bem_points){1, hole}, NULL, s, NULL),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t}, (rb_bem_points){1, nan},
                                 NULL, s, NULL),
                 RB_EINVAL);
    CHECK_STATUS(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                 (rb_bem_points){-1, hole}, NULL, s, NULL),
                 RB_EINVAL);
    CHECK_OK(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t}, (rb_bem_points){0, hole},
                             NULL, s, NULL));
    CHECK_STATUS(rb_bem_interior(&(rb_bem_boundary){&mesh, {0, 0.3}, u, t},
                                 (rb_bem_points){0, hole}, NULL, s, NULL),
                 RB_EINVAL);
    mesh.x1[3] += 0.1;
    CHECK_STATUS(rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                 (rb_bem_points){0, hole}, NULL, s, NULL),
                 RB_EINVAL);
}

TEST(failing_memory_is_reported)
{
    enum { n = 20 };
    OWNED(rb_bem_mesh) mesh = ring(n, 1.0, 0.4);
    double u[4 * n] = {0}, t[4 * n] = {0}, s[3];
    const double xy[] = {0.7, 0.0};
    for (int count = 0, failed = 1; failed; count++) {
        failed = REFUSED_FROM(count, rb_bem_interior(&(rb_bem_boundary){&mesh, material, u, t},
                                                     (rb_bem_points){1, xy}, NULL, s, NULL));
    }
}

RUN_TESTS(NULL, NULL)
