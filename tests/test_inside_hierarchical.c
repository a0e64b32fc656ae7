/* Boundary elements behind a hierarchical matrix against the dense one and the integrals. */
#include "bem/hierarchical/hierarchical.h"
#include "bem/hierarchical/hierarchical_parts.h"
#include "bem/incompressible.h"
#include "bem/internal.h"
#include "bem/hierarchical/mixed.h"
#include "bem/system.h"
#include "bem_shapes.h"

static const rb_bem_material steel = {82000.0, 0.28};

enum { CONTACT = 20 };

/* A wheel on a hub, contact -half ... half. */
static rb_bem_mesh wheel(rb_bem_support support, double half, int outer)
{
    const rb_bem_cylinder cylinder = {
        .radius = 50.0, .support = support, .arc = 0.5, .hub_ratio = 0.3, .outer_elements = outer};
    double ends[CONTACT + 2];
    rb_bem_mesh mesh;
    for (int i = 0; i < CONTACT + 2; i++)
        ends[i] = half * (2.0 * i / CONTACT - 1.0);
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, CONTACT, ends, &mesh, &message));
    return mesh;
}

/* A square hole about (x, y), side 1, 4 m elements. */
static void put_square(rb_bem_mesh *mesh, int first, int m, double x, double y)
{
    const double corner[5][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {0, 0}};
    for (int k = 0; k <= 4 * m; k++) {
        const double *a = corner[k / m], *b = corner[k < 4 * m ? k / m + 1 : 4];
        const double part = (double)(k % m) / m, px = x - 0.5 + a[0] + part * (b[0] - a[0]),
                     py = y - 0.5 + a[1] + part * (b[1] - a[1]);
        if (k < 4 * m) {
            mesh->x0[first + k] = px;
            mesh->y0[first + k] = py;
        }
        if (k > 0) {
            mesh->x1[first + k - 1] = px;
            mesh->y1[first + k - 1] = py;
        }
    }
}

/* A disc with two square holes, both held, under tractions on its rim. */
static rb_bem_mesh plate(double second_x)
{
    enum { RIM = 300, SIDE = 32 };
    rb_bem_mesh mesh;
    assert_int_equal(rb_bem_mesh_alloc(RIM + 8 * SIDE, &mesh), RB_OK);
    put_circle(&mesh, 0, RIM, 3.0, 1, 0.0);
    put_square(&mesh, RIM, SIDE, -1.3, 0.2);
    put_square(&mesh, RIM + 4 * SIDE, SIDE, second_x, 0.2);
    for (int j = 0; j < mesh.n; j++) {
        const double angle = 2.0 * M_PI * j / RIM;
        if (j < RIM)
            give(&mesh, j, RB_BEM_TRACTION, cos(3.0 * angle), 1.0 + sin(angle));
        else
            give(&mesh, j, RB_BEM_DISPLACEMENT, 0.1 * sin(angle), 0.0);
    }
    return mesh;
}

static double *units(const rb_bem_mesh *mesh, rb_bem_material material)
{
    double *unit = NOT_NULL(rb_alloc((size_t)mesh->n, 1));
    for (int j = 0; j < mesh->n; j++)
        unit[j] = material.shear / hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
    return unit;
}

/* A x for unknowns x, from the integrals of the dense assembly. */
static void multiply(const rb_bem_mesh *mesh, rb_bem_material material, const double *unit,
                     const double *x, double *y)
{
    const size_t dofs = 2 * (size_t)mesh->n;
    SCRATCH double *H = rb_alloc(dofs, dofs), *G = rb_alloc(dofs, dofs);
    OWNED(rb_held_contours) held;
    assert_true(H && G);
    CHECK_OK(rb_bem_assemble(mesh, material, H, G, (int)dofs, NULL));
    CHECK_OK(rb_held_contours_find(mesh, material, &held));
    memset(y, 0, dofs * sizeof *y);
    for (size_t j = 0; j < dofs; j++)
        for (size_t i = 0; i < dofs; i++) {
            y[i] +=
                x[j] * (mesh->condition[j] == RB_BEM_DISPLACEMENT ? -unit[j / 2] * G[i + j * dofs]
                                                                  : H[i + j * dofs]);
            if (held.count)
                y[i] += x[j] * rb_held_contours_term(&held, (int)i, (int)j);
        }
}

/* Numbers stored / 4 n^2. */
static double stored_part(const rb_hierarchical *h)
{
    const double dofs = 2.0 * h->matrix.n;
    double stored = 0.0;
    for (int i = 0; i < rb_hierarchical_clusters(h); i++) {
        const double kept = h->cluster[i].e.kept, others = h->cluster[i].e.m - kept;
        stored += (4.0 * kept + others) * others;
    }
    return stored / (dofs * dofs);
}

/* Largest error of a known solution; frees the mesh. */
static double solution_error(rb_bem_mesh mesh, rb_bem_material material, double tolerance,
                             double *ratio)
{
    const size_t dofs = 2 * (size_t)mesh.n;
    SCRATCH double *unit = units(&mesh, material), *x = rb_alloc(dofs, 1),
                   *b = rb_alloc(2 * dofs, 1);
    rb_hierarchical *h;

    assert_true(x && b);
    for (size_t k = 0; k < dofs; k++)
        x[k] = sin(0.01 * (double)k) + (k % 2 ? 0.3 : 0.0);
    multiply(&mesh, material, unit, x, b);
    memcpy(b + dofs, b, dofs * sizeof *b);
    CHECK_OK(rb_hierarchical_create(&mesh, material, unit, tolerance, &h));
    *ratio = stored_part(h);
    CHECK_OK(rb_hierarchical_solve(h, 2, b));
    double error = 0.0;
    for (size_t k = 0; k < dofs; k++) {
        error = fmax(error, fabs(b[k] - x[k]));
        CHECK_ABS(b[k], b[dofs + k], 0.0, "both columns");
    }
    rb_hierarchical_free(h);
    rb_bem_mesh_free(&mesh);
    return error;
}

/* The error follows the tolerance, and the matrix is small. */
TEST(solves_what_the_dense_matrix_says)
{
    double ratio;
    CHECK_MAX(solution_error(wheel(RB_BEM_HUB, 2.5, 900), steel, 1e-5, &ratio), 1e-3, "hub, 1e-5");
    CHECK_MAX(ratio, 0.25, "numbers stored");
    CHECK_MAX(solution_error(wheel(RB_BEM_HUB, 2.5, 900), steel, 1e-8, &ratio), 1e-6, "hub, 1e-8");
    CHECK_MAX(solution_error(wheel(RB_BEM_ARC, 2.5, 900), steel, 1e-8, &ratio), 1e-6, "arc, 1e-8");
}

/* Held contours with corners, where their terms are no kernel's. */
TEST(incompressible_bodies)
{
    const rb_bem_material rubber = {1.0, 0.5};
    double ratio;
    CHECK_MAX(solution_error(plate(1.1), rubber, 1e-8, &ratio), 1e-6, "1e-8");
    CHECK_MAX(solution_error(plate(1.1), rubber, 1e-11, &ratio), 1e-9, "1e-11");
}

/* Two holes at the same place: their rows are the same. */
TEST(singular_systems_are_refused)
{
    OWNED(rb_bem_mesh) mesh = plate(-1.3);
    for (int dense = 0; dense < 2; dense++) {
        rb_bem_system *system;
        CHECK_STATUS(rb_bem_system_create_as(&mesh, steel, dense, &system, &message), RB_SINGULAR);
        assert_null(system);
        assert_non_null(strstr(message.text, "singular"));
    }
}

/* ---- Behind the system ------------------------------------------------------------- */

static void condense(const rb_bem_mesh *mesh, rb_bem_material material, int dense, int subtracted,
                     double *F)
{
    held_system *system;
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_system_create_as(mesh, material, dense, &system, &message));
    CHECK_OK((subtracted ? rb_bem_condense_subtracted
                         : rb_bem_condense)(system, RB_BEM_NORMALS_OBSTACLE, &f, &message));
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * (CONTACT + 1)));
    if (!subtracted)
        return;
    /* the same under two loads alone */
    enum { ROWS = 2 * (CONTACT + 1), LOADS = 2, N = 2 * CONTACT };
    double r[LOADS * N], w[LOADS * ROWS], w0[ROWS], again[LOADS * ROWS];
    for (int j = 0; j < LOADS * N; j++)
        r[j] = j < N ? sin(1.0 + j) : j == N + 3;
    CHECK_OK(
        rb_bem_displacement_subtracted(system, RB_BEM_NORMALS_OBSTACLE, LOADS, r, w, w0, &message));
    /* ... by GMRES, where the matrix is dense and not factored */
    held_system *few;
    CHECK_OK(rb_bem_system_create_for_few(mesh, material, INFINITY, &few, &message));
    CHECK_OK(rb_bem_displacement_subtracted(few, RB_BEM_NORMALS_OBSTACLE, LOADS, r, again, w0,
                                            &message));
    assert_true(few->is_assembled);
    for (int i = 0; i < LOADS * ROWS && dense; i++)
        CHECK_ABS(again[i], w[i], 1e-9 * rb_norm_inf(LOADS * ROWS, w), "row %d by GMRES", i);
    /* a solution errs by a part of the largest displacement, by clusters more than by the matrix */
    double most = 0.0;
    for (int i = 0; i < N * ROWS; i++)
        most = fmax(most, fabs(F[i]));
    for (int i = 0; i < LOADS * ROWS; i++) {
        double want = 0.0;
        for (int j = 0; j < N; j++)
            want += F[i % ROWS + j * ROWS] * r[i / ROWS * N + j];
        CHECK_ABS(w[i], want, (dense ? 1e-11 : 1e-8) * most, "row %d of load %d", i % ROWS,
                  i / ROWS);
        CHECK_ABS(w0[i % ROWS], f.w0[i % ROWS], 1e-12 * most, "row %d without loads", i % ROWS);
    }
}

/* Neighbours that differ by orders of length, both supports, and loads whose singular
 * part is subtracted: what these leave is multiplied by a tree of clusters then. */
TEST(the_flexibility_is_the_dense_one)
{
    enum { M = CONTACT + 1, SIZE = 2 * M * 2 * CONTACT };
    const rb_bem_support support[] = {RB_BEM_HUB, RB_BEM_ARC, RB_BEM_HUB};
    const double half[] = {0.01, 0.5, 2.5};
    const rb_bem_material incompressible = {1.0, 0.5};
    for (int k = 0; k < 12; k++) {
        OWNED(rb_bem_mesh) mesh = wheel(support[k % 3], half[k % 3], 300);
        double F[2][SIZE], most = 0.0;
        for (int dense = 0; dense < 2; dense++)
            condense(&mesh, k < 6 ? steel : incompressible, dense, k / 3 % 2, F[dense]);
        for (int i = 0; i < SIZE; i++)
            most = fmax(most, fabs(F[1][i]));
        for (int i = 0; i < SIZE; i++)
            CHECK_ABS(F[0][i], F[1][i], 1e-6 * most, "case %d, entry %d", k, i);
    }
}

/* Corners; an incompressible body, where the mean pressure on each held contour is not
 * determined and is made zero. */
TEST(plates_are_solved_as_by_the_dense_matrix)
{
    const double poisson[] = {0.3, 0.5, 0.4999999};
    OWNED(rb_bem_mesh) mesh = plate(1.1);
    const size_t dofs = 2 * (size_t)mesh.n;
    SCRATCH double *u = rb_alloc(dofs, 2), *t = rb_alloc(dofs, 2);

    assert_true(u && t);
    for (int k = 0; k < 3; k++) {
        const rb_bem_material material = {1.0, poisson[k]};
        for (int dense = 0; dense < 2; dense++) {
            held_system *system;
            CHECK_OK(rb_bem_system_create_as(&mesh, material, dense, &system, NULL));
            CHECK_OK(rb_bem_system_solve(system, NULL, u + (size_t)dense * dofs,
                                         t + (size_t)dense * dofs));
        }
        const double most_u = rb_norm_inf(dofs, u), most_t = rb_norm_inf(dofs, t);
        for (size_t i = 0; i < dofs; i++) {
            CHECK_ABS(u[i], u[dofs + i], 1e-6 * most_u, "u of %d", (int)i);
            CHECK_ABS(t[i], t[dofs + i], 1e-5 * most_t, "t of %d", (int)i);
        }
    }
}

/* H u = G t at some points of a long boundary, from its own integrals. */
static void check_identity(const rb_bem_mesh *mesh, const double *u, const double *t)
{
    const double log_size = log(rb_bem_mesh_size(mesh));
    double scale = 0.0;
    for (int j = 0; j < 2 * mesh->n; j++)
        scale = fmax(scale, fabs(u[j]));
    for (int i = 0; i < mesh->n; i += 97) {
        double sum[2] = {0.0, 0.0};
        const double px = 0.5 * (mesh->x0[i] + mesh->x1[i]), py = 0.5 * (mesh->y0[i] + mesh->y1[i]);
        for (int j = 0; j < mesh->n; j++) {
            const rb_bem_segment element = {mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j]};
            rb_bem_blocks b = rb_bem_element_integrals(element, px, py, i == j, steel);
            /* logarithms over the size of the mesh, as everywhere */
            const double length = hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
            const double more = length * (3.0 - 4.0 * steel.poisson) * log_size /
                                (8.0 * M_PI * steel.shear * (1.0 - steel.poisson));
            b.G[0] += more;
            b.G[3] += more;
            for (int k = 0; k < 2; k++)
                sum[k] += b.H[k] * u[2 * j] + b.H[2 + k] * u[2 * j + 1] - b.G[k] * t[2 * j] -
                          b.G[2 + k] * t[2 * j + 1];
        }
        CHECK_ABS(sum[0], 0.0, 1e-6 * scale, "x of point %d", i);
        CHECK_ABS(sum[1], 0.0, 1e-6 * scale, "y of point %d", i);
    }
}

TEST(long_boundaries_are_solved)
{
    OWNED(rb_bem_mesh) mesh = wheel(RB_BEM_HUB, 0.5, 2800);
    held_system *system;
    OWNED(rb_bem_flexibility) f;
    const size_t dofs = 2 * (size_t)mesh.n;
    double *u = rb_alloc(dofs, 1), *t = rb_alloc(dofs, 1), load[2 * CONTACT];

    assert_true(u && t && mesh.n >= RB_BEM_HIERARCHICAL);
    for (int k = 0; k < 2 * CONTACT; k++)
        load[k] = 1.0 + sin(k);
    CHECK_OK(rb_bem_system_create(&mesh, steel, &system, &message));
    assert_true(isnan(rb_bem_system_rcond(system)));
    CHECK_OK(rb_bem_system_solve(system, load, u, t));
    check_identity(&mesh, u, t);

    /* the condensed flexibility says the same of the contact */
    CHECK_OK(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &message));
    double r[2 * CONTACT], w[2 * CONTACT + 2];
    for (int j = 0; j < CONTACT; j++) {
        r[j] = load[2 * j + 1];
        r[CONTACT + j] = load[2 * j];
    }
    rb_bem_flexibility_apply(&f, r, w);
    for (int i = 0; i < CONTACT + 1; i++) {
        const double *ui = u + 2 * (mesh.contact_first + i);
        CHECK_ABS(w[i], ui[1], 1e-9 * fabs(w[0]), "w_N of %d", i);
        CHECK_ABS(w[CONTACT + 1 + i], ui[0], 1e-9 * fabs(w[0]), "w_T of %d", i);
    }
    free(u);
    free(t);
}

typedef struct {
    rb_bem_mesh mesh;
    rb_bem_material material;
} solid;

static rb_status solve_by_clusters(void *of)
{
    const solid *b = of;
    held_system *system = NULL;
    SCRATCH double *u = rb_alloc(2 * (size_t)b->mesh.n, 2);
    rb_status s = u ? rb_bem_system_create_as(&b->mesh, b->material, 0, &system, NULL) : RB_ENOMEM;
    if (s == RB_OK)
        s = rb_bem_system_solve(system, NULL, u, u + 2 * b->mesh.n);
    return s;
}

/* Eight clusters: one thread. */
TEST(clusters_tell_of_missing_memory)
{
    solid b = {wheel(RB_BEM_HUB, 0.5, 90), steel};
    assert_in_range(b.mesh.n, 128, 250);
    assert_true(alloc_fail_each(solve_by_clusters, &b) > 20);
    b.material.poisson = 0.5;
    assert_true(alloc_fail_every_call(solve_by_clusters, &b) > 20);
    rb_bem_mesh_free(&b.mesh);
}

TEST(failing_allocations)
{
    OWNED(rb_bem_mesh) mesh = wheel(RB_BEM_HUB, 2.5, 20);
    SCRATCH double *unit = units(&mesh, steel);
    for (int k = 0, refused = 1; refused; k++) {
        rb_hierarchical *h;
        refused = REFUSED_FROM(k, rb_hierarchical_create(&mesh, steel, unit, 1e-6, &h));
        assert_true(refused ? h == NULL : h != NULL);
        rb_hierarchical_free(h);
    }
    held_system *system;
    CHECK_OK(rb_bem_system_create_as(&mesh, steel, 0, &system, NULL));
    for (int k = 0, refused = 1; refused; k++) {
        OWNED(rb_bem_flexibility) f;
        refused =
            REFUSED_FROM(k, rb_bem_condense_subtracted(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL));
    }
}

/* What stands for all that is far is a closed polygon: a uniform pressure on it takes no
 * volume from an incompressible body, and displaces nothing outside. */
TEST(a_pressed_circle_displaces_nothing_outside)
{
    enum { n = 12, rows = 2 * n };
    const rb_bem_material rubber = {1.0, 0.5};
    OWNED(rb_bem_mesh) mesh = circle(n, 1.0);
    double unit[n];
    int order[n], row[rows];
    OWNED(rb_mixed) a;
    OWNED(rb_mixed_rows) r;
    for (int j = 0; j < n; j++)
        unit[j] = 1.0;
    for (int i = 0; i < rows; i++)
        row[i] = i;
    CHECK_OK(rb_mixed_make(&mesh, rubber, unit, 0, order, &a));
    CHECK_OK(rb_mixed_rows_make(&a, rows, row, NULL, 0, &r));
    for (int points = 3; points < 20; points += 4) {
        double *G = rb_alloc(rows, 2 * (size_t)points), largest;
        CHECK_OK(rb_mixed_far(&a, &r, (rb_circle){3.0, -1.5, 1.7}, points,
                              (rb_matrix_view){G, 1, rows}));
        largest = rb_norm_inf((size_t)rows * 2 * (size_t)points, G);
        assert_true(largest > 0.01 && largest < 100.0);
        for (int i = 0; i < rows; i++) {
            double sum = 0.0;
            for (int q = 0; q < points; q++) {
                const double outward = 2.0 * M_PI * (q + 0.5) / points;
                sum +=
                    cos(outward) * G[i + 2 * q * rows] + sin(outward) * G[i + (2 * q + 1) * rows];
            }
            CHECK_ABS(sum, 0.0, 1e-13 * largest * points, "%d points, row %d", points, i);
        }
        free(G);
    }
}

RUN_TESTS(NULL, NULL)
