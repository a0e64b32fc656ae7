/* The strip in complex form, and the flexibility whose singular part it is (B10). */
#include "bem_shapes.h"
#include "check.h"
#include "bem/strip.h"

#include <gsl/gsl_math.h>
#include <string.h>

static const rb_bem_material steel = {.shear = 82000.0, .poisson = 0.28};

/* One strip from x = -0.3 to 0.5 on the edge of y > 0. */
static rb_strip flat_strip(rb_bem_mesh *mesh)
{
    CHECK_STATUS(rb_bem_mesh_alloc(1, mesh), RB_OK);
    mesh->x0[0] = -0.3;
    mesh->x1[0] = 0.5;
    return rb_strip_on(mesh, 0, steel, 1.0);
}

TEST(the_strip_is_flamants_on_the_surface)
{
    const double ends[] = {-0.3, 0.5}, x[] = {-3.0, -0.31, -0.1, 0.1, 0.49, 40.0};
    double W[4 * 6];
    rb_bem_mesh mesh;
    const rb_strip strip = flat_strip(&mesh);
    CHECK_STATUS(rb_bem_surface_displacement(HALFPLANE(steel, 1.0), 1, ends, 6, x, W),
                 RB_OK);
    /* the datum and the rotation-free constant differ: compare with the first point */
    for (int load = 0; load < 2; load++)
        for (int i = 1; i < 6; i++) {
            const double complex f = load ? 1.0 : I;
            const double complex u =
                rb_strip_under(rb_strip_displacement(&strip, x[i]), f) -
                rb_strip_under(rb_strip_displacement(&strip, x[0]), f);
            const double *column = W + 12 * load;
            CHECK_ABS(cimag(u), column[i] - column[0], 1e-18, "w_N at %g", x[i]);
            CHECK_ABS(creal(u), column[6 + i] - column[6], 1e-18, "w_T at %g", x[i]);
        }
    rb_bem_mesh_free(&mesh);
}

TEST(its_tractions_are_those_of_the_stress)
{
    const double ends[] = {-0.3, 0.5}, p = 2.0, q = -0.7;
    const double xy[] = {0.1, 0.0, 0.2, 0.3, -1.0, 0.01, 5.0, 7.0};
    double sigma[12];
    rb_bem_mesh mesh;
    const rb_strip strip = flat_strip(&mesh);
    CHECK_STATUS(rb_bem_halfplane_stress(&(rb_bem_edge_load){1, ends, &p, &q},
                                         (rb_bem_points){4, xy}, sigma),
                 RB_OK);
    for (int k = 0; k < 4; k++)
        for (int turn = 0; turn < 4; turn++) {
            const double nx = cos(0.3 + turn), ny = sin(0.3 + turn), *s = sigma + 3 * k;
            const double complex t = rb_strip_under(
                rb_strip_traction(&strip, xy[2 * k] + xy[2 * k + 1] * I, nx + ny * I),
                q + p * I);
            CHECK_ABS(creal(t), s[0] * nx + s[2] * ny, 1e-14, "t_x, point %d", k);
            CHECK_ABS(cimag(t), s[2] * nx + s[1] * ny, 1e-14, "t_y, point %d", k);
        }
    rb_bem_mesh_free(&mesh);
}

/* Far away the strip is a force: no digit is lost there. */
TEST(far_away_it_keeps_its_digits)
{
    rb_bem_mesh mesh;
    CHECK_STATUS(rb_bem_mesh_alloc(1, &mesh), RB_OK);
    mesh.x0[0] = -5e-11;
    mesh.x1[0] = 5e-11;
    const rb_strip strip = rb_strip_on(&mesh, 0, steel, 1.0);
    const double complex z = 0.3 + 0.4 * I, F = 1e-10 * I;
    const double kappa = 3.0 - 4.0 * steel.poisson;
    const double complex point =
        -kappa * F * clog(z) + z * conj(F) / conj(z) - F * conj(clog(z));
    const double complex want = point / (4.0 * M_PI * steel.shear);
    const double complex got = rb_strip_under(rb_strip_displacement(&strip, z), I);
    CHECK_MAX(cabs(got - want), 1e-14 * cabs(want), "against the force");
    rb_bem_mesh_free(&mesh);
}

/* Two strips of different length that share an end where the traction has a kink, against
 * the tent of the half-plane; the end itself included. */
TEST(linear_strips_make_a_tent)
{
    const double nodes[] = {-0.3, 0.1, 0.2}, p[] = {0.0, 2.0, 0.0},
                 q[] = {0.0, -0.7, 0.0};
    const double xy[] = {0.0, 0.3, 0.1, 0.2, 0.1, 0.0, -1.0, 0.01, 0.3, 0.0, 2.0, 1.0};
    const rb_strip left = rb_strip_between(-0.3, 0.1, steel, 1.0),
                   right = rb_strip_between(0.1, 0.2, steel, 1.0);
    const double complex top = q[1] + p[1] * I;
    double want[18], a[3], b[3];
    CHECK_STATUS(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){3, nodes, p, q},
                                                (rb_bem_points){6, xy}, want),
                 RB_OK);
    for (int k = 0; k < 6; k++) {
        const double complex z = xy[2 * k] + xy[2 * k + 1] * I;
        rb_strip_linear_stress(&left, z, 0.5 * top, top / 0.4, a);
        rb_strip_linear_stress(&right, z, 0.5 * top, -top / 0.1, b);
        for (int i = 0; i < 3; i++)
            CHECK_ABS(a[i] + b[i], want[3 * k + i], 1e-10, "point %d, component %d", k,
                      i);
    }
}

/* Turning strip and point together turns the stress: its invariants stay. */
TEST(linear_strips_do_not_know_their_direction)
{
    const double complex turn = cos(0.7) + sin(0.7) * I, z = 0.2 + 0.1 * I;
    const rb_strip flat = rb_strip_between(-0.3, 0.5, steel, 1.0),
                   turned = rb_strip_between(-0.3 * turn, 0.5 * turn, steel, 1.0);
    double a[3], b[3];
    rb_strip_linear_stress(&flat, z, 1.0 + 2.0 * I, 0.3 * I, a);
    rb_strip_linear_stress(&turned, z * turn, (1.0 + 2.0 * I) * turn, 0.3 * I * turn, b);
    const double c = cos(0.7), s = sin(0.7);
    CHECK_ABS(b[0], c * c * a[0] + s * s * a[1] - 2.0 * c * s * a[2], 1e-13, "sxx");
    CHECK_ABS(b[1], s * s * a[0] + c * c * a[1] + 2.0 * c * s * a[2], 1e-13, "syy");
    CHECK_ABS(b[2], c * s * (a[0] - a[1]) + (c * c - s * s) * a[2], 1e-13, "sxy");
}

/* A wheel with a hub, n equal elements over a zone of half-width a = 1 on R = 1000. */
static rb_bem_system *wheel_system(int n)
{
    const rb_bem_cylinder cylinder = {
        .radius = 1000.0, .support = RB_BEM_HUB, .hub_ratio = 0.3};
    double *ends = rb_alloc((size_t)n + 2, 1);
    rb_bem_mesh mesh;
    rb_bem_system *system = NULL;
    for (int i = 0; i < n + 2; i++)
        ends[i] = -1.0 + 2.0 * i / n;
    CHECK_STATUS(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, NULL), RB_OK);
    CHECK_STATUS(rb_bem_system_create(&mesh, steel, &system, NULL), RB_OK);
    rb_bem_mesh_free(&mesh);
    free(ends);
    return system;
}

/* Largest difference of two columns' differences: rigid motion of the wheel drops out. */
static double distance_from_halfplane(int n, int subtracted)
{
    rb_bem_system *system = wheel_system(n);
    rb_bem_flexibility f, flat;
    const int m = n + 1;
    double *ends = rb_alloc((size_t)n + 2, 1),
           *F = rb_alloc(2 * (size_t)m, 2 * (size_t)n),
           *H = rb_alloc(2 * (size_t)m, 2 * (size_t)n);
    double worst = 0.0, size = 0.0;
    for (int i = 0; i < n + 2; i++)
        ends[i] = -1.0 + 2.0 * i / n;
    CHECK_STATUS((subtracted ? rb_bem_condense_subtracted : rb_bem_condense)(
                     system, RB_BEM_NORMALS_OBSTACLE, &f, NULL),
                 RB_OK);
    CHECK_STATUS(
        rb_bem_flexibility_surface(n, ends, HALFPLANE(steel, 1000.0), &flat, NULL),
        RB_OK);
    CHECK_STATUS(rb_bem_flexibility_matrix(&f, F, 2 * m), RB_OK);
    CHECK_STATUS(rb_bem_flexibility_matrix(&flat, H, 2 * m), RB_OK);
    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < 2 * m; i++) {
            const size_t at = (size_t)i + (size_t)j * 2 * m, first = at - (size_t)(i % m);
            worst = fmax(worst, fabs((F[at] - F[first]) - (H[at] - H[first])));
            size = fmax(size, fabs(H[at] - H[first]));
        }
    rb_bem_flexibility_free(&f);
    rb_bem_flexibility_free(&flat);
    rb_bem_system_free(system);
    free(ends);
    free(F);
    free(H);
    return worst / size;
}

TEST(the_near_field_is_the_half_planes)
{
    CHECK_MAX(distance_from_halfplane(20, 1), 2e-3, "a/R = 1e-3, subtracted");
    assert_true(distance_from_halfplane(20, 0) > 5.0 * distance_from_halfplane(20, 1));
}

/* A block in contact below, whose left side and top glide along rigid walls, the one
 * held in x and the other in y: with and without the subtraction it gives way alike, the
 * nearer the finer. */
static double distance_on_gliding_sides(int side)
{
    const int touch = side / 5, first = 2 * side / 5;
    static const double corner[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    rb_bem_mesh mesh;
    rb_bem_system *system;
    rb_bem_flexibility f[2];
    double *F[2], worst = 0.0, size = 0.0;
    CHECK_STATUS(rb_bem_mesh_alloc(4 * side, &mesh), RB_OK);
    for (int j = 0; j < 4 * side; j++) {
        const double *a = corner[j / side], *b = corner[j / side + 1];
        const double from = (double)(j % side) / side, to = from + 1.0 / side;
        mesh.x0[j] = a[0] + from * (b[0] - a[0]);
        mesh.y0[j] = a[1] + from * (b[1] - a[1]);
        mesh.x1[j] = a[0] + to * (b[0] - a[0]);
        mesh.y1[j] = a[1] + to * (b[1] - a[1]);
        if (j / side >= 2)
            mesh.condition[2 * j + (j / side == 2)] = RB_BEM_DISPLACEMENT;
        if (j >= first && j < first + touch)
            mesh.condition[2 * j] = mesh.condition[2 * j + 1] = RB_BEM_CONTACT;
    }
    for (int j = 4 * side; j-- > 0;) { /* ends meet to the last digit */
        mesh.x1[j] = mesh.x0[(j + 1) % (4 * side)];
        mesh.y1[j] = mesh.y0[(j + 1) % (4 * side)];
    }
    mesh.contact_first = first;
    mesh.contact_n = touch;
    rb_message why = {""};
    if (rb_bem_system_create(&mesh, steel, &system, &why) != RB_OK)
        fail_msg("%s", why.text);
    const int m = touch + 1, all = 2 * m * 2 * touch;
    for (int k = 0; k < 2; k++) {
        CHECK_STATUS((k ? rb_bem_condense_subtracted
                        : rb_bem_condense)(system, RB_BEM_NORMALS_OBSTACLE, &f[k], &why),
                     RB_OK);
        F[k] = rb_alloc((size_t)all, 1);
        CHECK_STATUS(rb_bem_flexibility_matrix(&f[k], F[k], 2 * m), RB_OK);
    }
    for (int i = 0; i < all; i++) {
        worst = fmax(worst, fabs(F[1][i] - F[0][i]));
        size = fmax(size, fabs(F[0][i]));
    }
    for (int k = 0; k < 2; k++) {
        rb_bem_flexibility_free(&f[k]);
        free(F[k]);
    }
    rb_bem_system_free(system);
    rb_bem_mesh_free(&mesh);
    return worst / size;
}

TEST(sides_may_glide)
{
    const double coarse = distance_on_gliding_sides(10),
                 fine = distance_on_gliding_sides(20);
    CHECK_MAX(fine, 0.03, "20 elements a side");
    CHECK_MAX(fine, 0.9 * coarse, "against 10");
}

TEST(a_hollow_contact_is_refused)
{
    /* a square whose lower side is bent inwards */
    static const double x[] = {0, 1, 2, 2, 0}, y[] = {0, 0.5, 0, 2, 2};
    rb_bem_mesh mesh;
    rb_bem_system *system;
    rb_bem_flexibility f;
    rb_message why = {""};
    CHECK_STATUS(rb_bem_mesh_alloc(5, &mesh), RB_OK);
    for (int j = 0; j < 5; j++) {
        mesh.x0[j] = x[j];
        mesh.y0[j] = y[j];
        mesh.x1[j] = x[(j + 1) % 5];
        mesh.y1[j] = y[(j + 1) % 5];
    }
    mesh.condition[0] = mesh.condition[1] = RB_BEM_CONTACT;
    mesh.contact_n = 1;
    for (int dof = 4; dof < 8; dof++) /* the right and the upper side */
        mesh.condition[dof] = RB_BEM_DISPLACEMENT;
    if (rb_bem_system_create(&mesh, steel, &system, &why) != RB_OK)
        fail_msg("%s", why.text);
    CHECK_STATUS(rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &f, &why),
                 RB_EINVAL);
    assert_non_null(strstr(why.text, "outside the half-plane"));
    CHECK_STATUS(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &why), RB_OK);
    rb_bem_flexibility_free(&f);
    rb_bem_system_free(system);
    rb_bem_mesh_free(&mesh);
}

/* Every contact element alone has the field of its mirror image, mirrored. */
TEST(fields_have_their_mirror_images)
{
    enum { n = 4, P = 3 };
    static const double depth[P] = {0.1, 0.6, 40.0}, aside[P] = {0.2, -0.9, 30.0};
    for (int support = 0; support < 2; support++) {
        const rb_bem_cylinder cylinder = {.radius = 100.0,
                                          .support = support ? RB_BEM_ARC : RB_BEM_HUB,
                                          .arc = 0.5,
                                          .hub_ratio = 0.3};
        const double ends[n + 2] = {-1.0, -0.5, 0.0, 0.5, 1.0, 1.5};
        rb_bem_mesh mesh;
        rb_bem_system *system;
        CHECK_STATUS(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, NULL), RB_OK);
        CHECK_STATUS(rb_bem_system_create(&mesh, steel, &system, NULL), RB_OK);
        for (int load = 0; load < 2 * n; load++) {
            double s[2][3 * P];
            const double sign = load % 2 ? 1.0 : -1.0; /* of friction the mirror's */
            for (int side = 0; side < 2; side++) {
                double t[2 * n] = {0.0}, xy[2 * P];
                rb_bem_field *field;
                t[side ? 2 * (n - 1 - load / 2) + load % 2 : load] = side ? sign : 1.0;
                for (int k = 0; k < P; k++) {
                    xy[2 * k] = side ? -aside[k] : aside[k];
                    xy[2 * k + 1] = depth[k];
                }
                CHECK_STATUS(rb_bem_field_create(system, t, &field, NULL), RB_OK);
                CHECK_STATUS(
                    rb_bem_field_stress(field, (rb_bem_points){P, xy}, s[side], NULL),
                    RB_OK);
                rb_bem_field_free(field);
            }
            for (int k = 0; k < 3 * P; k++)
                CHECK_ABS(s[1][k], (k % 3 == 2 ? -1.0 : 1.0) * s[0][k], 1e-9,
                          "load %d, stress %d, support %d", load, k, support);
        }
        rb_bem_system_free(system);
        rb_bem_mesh_free(&mesh);
    }
}

TEST(every_failed_allocation_is_reported)
{
    rb_bem_system *system = wheel_system(4);
    int refused = 1;
    for (int count = 0; refused; count++) {
        rb_bem_flexibility f;
        alloc_fail_after(count);
        const rb_status s =
            rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL);
        refused = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(s, refused ? RB_ENOMEM : RB_OK);
        rb_bem_flexibility_free(&f);
    }
    const double t[8] = {0.0, 1.0, 0.1, 2.0, 0.1, 2.0, 0.0, 1.0};
    refused = 1;
    for (int count = 0; refused; count++) {
        rb_bem_field *field;
        alloc_fail_after(count);
        const rb_status s = rb_bem_field_create(system, t, &field, NULL);
        refused = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(s, refused ? RB_ENOMEM : RB_OK);
        rb_bem_field_free(field);
    }
    rb_bem_system_free(system);
}

RUN_TESTS(NULL, NULL)
