/* Boundary elements behind a hierarchical matrix against the dense one and the integrals.
 */
#include "bem/hierarchical.h"
#include "bem/internal.h"
#include "bem/system.h"
#include "check.h"

#include <gsl/gsl_math.h>
#include <string.h>

static const rb_bem_material steel = {82000.0, 0.28};

enum { CONTACT = 20 };

/* A wheel on a hub, contact -half ... half. */
static rb_bem_mesh wheel(rb_bem_support support, double half, int outer)
{
    const rb_bem_cylinder cylinder = {.radius = 50.0,
                                      .support = support,
                                      .arc = 0.5,
                                      .hub_ratio = 0.3,
                                      .outer_elements = outer};
    double ends[CONTACT + 2];
    rb_bem_mesh mesh;
    rb_message why;
    for (int i = 0; i < CONTACT + 2; i++)
        ends[i] = half * (2.0 * i / CONTACT - 1.0);
    CHECK_STATUS(rb_bem_mesh_cylinder(&cylinder, CONTACT, ends, &mesh, &why), RB_OK);
    return mesh;
}

static double *units(const rb_bem_mesh *mesh)
{
    double *unit = rb_alloc((size_t)mesh->n, 1);
    assert_non_null(unit);
    for (int j = 0; j < mesh->n; j++)
        unit[j] =
            steel.shear / hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
    return unit;
}

/* A x for unknowns x, from the integrals of the dense assembly. */
static void multiply(const rb_bem_mesh *mesh, const double *unit, const double *x,
                     double *y)
{
    const size_t dofs = 2 * (size_t)mesh->n;
    double *H = rb_alloc(dofs, dofs), *G = rb_alloc(dofs, dofs);
    assert_true(H && G);
    CHECK_STATUS(rb_bem_assemble(mesh, steel, H, G, (int)dofs, NULL), RB_OK);
    memset(y, 0, dofs * sizeof *y);
    for (size_t j = 0; j < dofs; j++)
        for (size_t i = 0; i < dofs; i++)
            y[i] += x[j] * (mesh->condition[j] == RB_BEM_DISPLACEMENT
                                ? -unit[j / 2] * G[i + j * dofs]
                                : H[i + j * dofs]);
    free(H);
    free(G);
}

static double solution_error(rb_bem_support support, double tolerance, double *ratio)
{
    rb_bem_mesh mesh = wheel(support, 2.5, 900);
    const size_t dofs = 2 * (size_t)mesh.n;
    double *unit = units(&mesh), *x = rb_alloc(dofs, 1), *b = rb_alloc(2 * dofs, 1);
    rb_hierarchical *h;

    assert_true(x && b);
    for (size_t k = 0; k < dofs; k++)
        x[k] = sin(0.01 * (double)k) + (k % 2 ? 0.3 : 0.0);
    multiply(&mesh, unit, x, b);
    memcpy(b + dofs, b, dofs * sizeof *b);
    CHECK_STATUS(rb_hierarchical_create(&mesh, steel, unit, tolerance, &h), RB_OK);
    *ratio = rb_hierarchical_ratio(h);
    CHECK_STATUS(rb_hierarchical_solve(h, 2, b), RB_OK);
    double error = 0.0;
    for (size_t k = 0; k < dofs; k++) {
        error = fmax(error, fabs(b[k] - x[k]));
        CHECK_ABS(b[k], b[dofs + k], 0.0, "both columns");
    }
    rb_hierarchical_free(h);
    free(unit);
    free(x);
    free(b);
    rb_bem_mesh_free(&mesh);
    return error;
}

/* The error follows the tolerance, and the matrix is small. */
static void solves_what_the_dense_matrix_says(void **state)
{
    (void)state;
    double ratio;
    CHECK_MAX(solution_error(RB_BEM_HUB, 1e-5, &ratio), 1e-3, "hub, 1e-5");
    CHECK_MAX(ratio, 0.25, "numbers stored");
    CHECK_MAX(solution_error(RB_BEM_HUB, 1e-8, &ratio), 1e-6, "hub, 1e-8");
    CHECK_MAX(solution_error(RB_BEM_ARC, 1e-8, &ratio), 1e-6, "arc, 1e-8");
}

/* ---- Behind the system
 * ----------------------------------------------------------------- */

static void condense(const rb_bem_mesh *mesh, rb_bem_material material, int dense,
                     double *F)
{
    rb_bem_system *system;
    rb_bem_flexibility f;
    rb_message why;
    CHECK_STATUS(rb_bem_system_create_as(mesh, material, dense, &system, &why), RB_OK);
    CHECK_STATUS(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &why), RB_OK);
    CHECK_STATUS(rb_bem_flexibility_matrix(&f, F, 2 * (CONTACT + 1)), RB_OK);
    rb_bem_flexibility_free(&f);
    rb_bem_system_free(system);
}

/* Neighbours that differ by orders of length, and both supports: the same flexibility,
 * and the same gaps between neighbours. */
static void the_flexibility_is_the_dense_one(void **state)
{
    (void)state;
    enum { M = CONTACT + 1, SIZE = 2 * M * 2 * CONTACT };
    const rb_bem_support support[] = {RB_BEM_HUB, RB_BEM_ARC, RB_BEM_HUB};
    const double half[] = {0.01, 0.5, 2.5};
    for (int k = 0; k < 3; k++) {
        rb_bem_mesh mesh = wheel(support[k], half[k], 300);
        double F[2][SIZE], most = 0.0;
        for (int dense = 0; dense < 2; dense++)
            condense(&mesh, steel, dense, F[dense]);
        for (int i = 0; i < SIZE; i++)
            most = fmax(most, fabs(F[1][i]));
        for (int i = 0; i < SIZE; i++)
            CHECK_ABS(F[0][i], F[1][i], 1e-6 * most, "case %d, entry %d", k, i);
        rb_bem_mesh_free(&mesh);
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
        const double px = 0.5 * (mesh->x0[i] + mesh->x1[i]),
                     py = 0.5 * (mesh->y0[i] + mesh->y1[i]);
        for (int j = 0; j < mesh->n; j++) {
            double H[4], G[4];
            rb_bem_element_integrals(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j],
                                     px, py, i == j, steel, H, G);
            /* logarithms over the size of the mesh, as everywhere */
            const double length =
                hypot(mesh->x1[j] - mesh->x0[j], mesh->y1[j] - mesh->y0[j]);
            const double more = length * (3.0 - 4.0 * steel.poisson) * log_size /
                                (8.0 * M_PI * steel.shear * (1.0 - steel.poisson));
            G[0] += more;
            G[3] += more;
            for (int k = 0; k < 2; k++)
                sum[k] += H[k] * u[2 * j] + H[2 + k] * u[2 * j + 1] - G[k] * t[2 * j] -
                          G[2 + k] * t[2 * j + 1];
        }
        CHECK_ABS(sum[0], 0.0, 1e-6 * scale, "x of point %d", i);
        CHECK_ABS(sum[1], 0.0, 1e-6 * scale, "y of point %d", i);
    }
}

static void long_boundaries_are_solved(void **state)
{
    (void)state;
    rb_bem_mesh mesh = wheel(RB_BEM_HUB, 0.5, 2800);
    rb_bem_system *system;
    rb_bem_flexibility f;
    rb_message why;
    const size_t dofs = 2 * (size_t)mesh.n;
    double *u = rb_alloc(dofs, 1), *t = rb_alloc(dofs, 1), load[2 * CONTACT];

    assert_true(u && t && mesh.n >= RB_BEM_HIERARCHICAL);
    for (int k = 0; k < 2 * CONTACT; k++)
        load[k] = 1.0 + sin(k);
    CHECK_STATUS(rb_bem_system_create(&mesh, steel, &system, &why), RB_OK);
    assert_true(isnan(rb_bem_system_rcond(system)));
    CHECK_STATUS(rb_bem_system_solve(system, load, u, t), RB_OK);
    check_identity(&mesh, u, t);

    /* the condensed flexibility says the same of the contact */
    CHECK_STATUS(rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, &why), RB_OK);
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
    rb_bem_flexibility_free(&f);
    rb_bem_system_free(system);
    rb_bem_mesh_free(&mesh);
    free(u);
    free(t);
}

static void failing_allocations(void **state)
{
    (void)state;
    rb_bem_mesh mesh = wheel(RB_BEM_HUB, 2.5, 20);
    double *unit = units(&mesh);
    for (int k = 0, refused = 1; refused; k++) {
        rb_hierarchical *h;
        alloc_fail_after(k);
        const rb_status s = rb_hierarchical_create(&mesh, steel, unit, 1e-6, &h);
        refused = alloc_failed();
        alloc_succeed();
        assert_int_equal(s, refused ? RB_ENOMEM : RB_OK);
        assert_true(refused ? h == NULL : h != NULL);
        rb_hierarchical_free(h);
    }
    free(unit);
    rb_bem_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_what_the_dense_matrix_says),
        cmocka_unit_test(the_flexibility_is_the_dense_one),
        cmocka_unit_test(long_boundaries_are_solved),
        cmocka_unit_test(failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
