/* The flexibility whose singular part is a strip in complex form (B10); the strip itself:
 * test_inside_bem.c. */
#include "bem_shapes.h"
#include "check.h"

#include <gsl/gsl_math.h>

static const rb_bem_material steel = {.shear = 82000.0, .poisson = 0.28};

/* A wheel with a hub, n equal elements over a zone of half-width a = 1 on R = 1000. */
static rb_bem_system *wheel_system(int n)
{
    const rb_bem_cylinder cylinder = {.radius = 1000.0, .support = RB_BEM_HUB, .hub_ratio = 0.3};
    SCRATCH double *ends = rb_alloc((size_t)n + 2, 1);
    OWNED(rb_bem_mesh) mesh;
    rb_bem_system *system = NULL;
    for (int i = 0; i < n + 2; i++)
        ends[i] = -1.0 + 2.0 * i / n;
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, NULL));
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, NULL));
    return system;
}

/* Largest difference of two columns' differences: rigid motion of the wheel drops out. */
static double distance_from_halfplane(int n, int subtracted)
{
    held_system *system = wheel_system(n);
    OWNED(rb_bem_flexibility) f, flat;
    const int m = n + 1;
    SCRATCH double *ends = rb_alloc((size_t)n + 2, 1), *F = rb_alloc(2 * (size_t)m, 2 * (size_t)n),
                   *H = rb_alloc(2 * (size_t)m, 2 * (size_t)n);
    double worst = 0.0, size = 0.0;
    for (int i = 0; i < n + 2; i++)
        ends[i] = -1.0 + 2.0 * i / n;
    CHECK_OK((subtracted ? rb_bem_condense_subtracted
                         : rb_bem_condense)(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL));
    CHECK_OK(rb_bem_flexibility_surface(n, ends, HALFPLANE(steel, 1000.0), &flat, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * m));
    CHECK_OK(rb_bem_flexibility_matrix(&flat, H, 2 * m));
    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < 2 * m; i++) {
            const size_t at = (size_t)i + (size_t)j * 2 * m, first = at - (size_t)(i % m);
            worst = fmax(worst, fabs((F[at] - F[first]) - (H[at] - H[first])));
            size = fmax(size, fabs(H[at] - H[first]));
        }
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
    OWNED(rb_bem_mesh) mesh;
    held_system *system;
    rb_bem_flexibility f[2];
    double *F[2], worst = 0.0, size = 0.0;
    CHECK_OK(rb_bem_mesh_alloc(4 * side, &mesh));
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
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, &message));
    const int m = touch + 1, all = 2 * m * 2 * touch;
    for (int k = 0; k < 2; k++) {
        CHECK_OK((k ? rb_bem_condense_subtracted : rb_bem_condense)(system, RB_BEM_NORMALS_OBSTACLE,
                                                                    &f[k], &message));
        F[k] = rb_alloc((size_t)all, 1);
        CHECK_OK(rb_bem_flexibility_matrix(&f[k], F[k], 2 * m));
    }
    for (int i = 0; i < all; i++) {
        worst = fmax(worst, fabs(F[1][i] - F[0][i]));
        size = fmax(size, fabs(F[0][i]));
    }
    for (int k = 0; k < 2; k++) {
        rb_bem_flexibility_free(&f[k]);
        free(F[k]);
    }
    return worst / size;
}

TEST(sides_may_glide)
{
    const double coarse = distance_on_gliding_sides(10), fine = distance_on_gliding_sides(20);
    CHECK_MAX(fine, 0.03, "20 elements a side");
    CHECK_MAX(fine, 0.9 * coarse, "against 10");
}

TEST(a_hollow_contact_is_refused)
{
    /* a square whose lower side is bent inwards */
    static const double x[] = {0, 1, 2, 2, 0}, y[] = {0, 0.5, 0, 2, 2};
    OWNED(rb_bem_mesh) mesh;
    held_system *system;
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_mesh_alloc(5, &mesh));
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
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, &message));
    CHECK_SAYS(rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &f, &message), RB_EINVAL,
               "outside the half-plane");
    CHECK_OK(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &message));
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
        OWNED(rb_bem_mesh) mesh;
        held_system *system;
        CHECK_OK(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, NULL));
        CHECK_OK(rb_bem_system_create(&mesh, steel, &system, NULL));
        /* the midpoints, along the contour, and beyond them nothing */
        double nodes[n + 2] = {0.0};
        for (int c = 0; c < n; c++) {
            const double h = hypot(mesh.x1[c] - mesh.x0[c], mesh.y1[c] - mesh.y0[c]);
            nodes[c + 1] = nodes[n + 1] + 0.5 * h;
            nodes[n + 1] += h;
        }
        for (int load = 0; load < 2 * n; load++) {
            double s[2][3 * P];
            const double sign = load % 2 ? 1.0 : -1.0; /* of friction the mirror's */
            for (int side = 0; side < 2; side++) {
                double p[n + 2] = {0.0}, q[n + 2] = {0.0}, xy[2 * P];
                rb_bem_field *field;
                const int at = 1 + (side ? n - 1 - load / 2 : load / 2);
                *(load % 2 ? p + at : q + at) = side ? sign : 1.0;
                for (int k = 0; k < P; k++) {
                    xy[2 * k] = side ? -aside[k] : aside[k];
                    xy[2 * k + 1] = depth[k];
                }
                CHECK_OK(rb_bem_field_create(system, &(rb_bem_edge_load){n + 2, nodes, p, q},
                                             &field, NULL));
                CHECK_OK(rb_bem_field_stress(field, (rb_bem_points){P, xy}, s[side], NULL));
                rb_bem_field_free(field);
            }
            for (int k = 0; k < 3 * P; k++)
                CHECK_ABS(s[1][k], (k % 3 == 2 ? -1.0 : 1.0) * s[0][k], 1e-9,
                          "load %d, stress %d, support %d", load, k, support);
        }
    }
}

/* Of a rim so thin that GMRES does not converge the matrix is factored after all. */
TEST(few_loads_of_a_thin_rim)
{
    enum { N = 4, ROWS = 2 * (N + 1) };
    const rb_bem_material soft = {1.0, 0.4999};
    const rb_bem_cylinder cylinder = {
        .radius = 10.0, .support = RB_BEM_HUB, .hub_ratio = 0.95, .outer_elements = 200};
    const double ends[N + 2] = {-0.02, -0.01, 0.0, 0.01, 0.02, 0.03}, r[2 * N] = {1.0, 0.5, -0.2};
    double w[2][ROWS], w0[ROWS];
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, N, ends, &mesh, NULL));
    for (int few = 0; few < 2; few++) {
        held_system *system;
        CHECK_OK((few ? rb_bem_system_create_for_few
                      : rb_bem_system_create_within)(&mesh, soft, INFINITY, &system, NULL));
        assert_int_equal(rb_bem_system_rcond(system) > 0.0, !few);
        CHECK_OK(rb_bem_displacement_subtracted(system, RB_BEM_NORMALS_OBSTACLE, 1, r, w[few], w0,
                                                NULL));
        assert_true(rb_bem_system_rcond(system) > 0.0);
    }
    for (int i = 0; i < ROWS; i++)
        CHECK_REL(w[1][i], w[0][i], 1e-12, "row %d", i);
}

TEST(every_failed_allocation_is_reported)
{
    held_system *system = wheel_system(4), *few;
    for (int count = 0, refused = 1; refused; count++) {
        OWNED(rb_bem_flexibility) f;
        refused = REFUSED_FROM(
            count, rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL));
    }
    for (int count = 0, refused = 1; refused; count++) {
        const double r[8] = {1.0};
        double w[10], w0[10];
        refused = REFUSED_FROM(count, rb_bem_displacement_subtracted(
                                          system, RB_BEM_NORMALS_OBSTACLE, 1, r, w, w0, NULL));
    }
    CHECK_OK(rb_bem_system_create_for_few(rb_bem_system_mesh(system), steel, INFINITY, &few, NULL));
    for (int count = 0, refused = 1; refused; count++) {
        const double r[8] = {1.0};
        double w[10], w0[10];
        refused = REFUSED_FROM(
            count, rb_bem_displacement_subtracted(few, RB_BEM_NORMALS_OBSTACLE, 1, r, w, w0, NULL));
    }
    const double x[] = {0.0, 0.1, 1.0}, p[] = {0.0, 2.0, 0.0}, q[] = {0.0, 0.1, 0.0};
    const rb_bem_edge_load load = {3, x, p, q};
    for (int count = 0, refused = 1; refused; count++) {
        rb_bem_field *field;
        refused = REFUSED_FROM(count, rb_bem_field_create(system, &load, &field, NULL));
        rb_bem_field_free(field);
    }
}

RUN_TESTS(NULL, NULL)
