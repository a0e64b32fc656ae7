/* Contact meshes by themselves: where elements end, and the gap at their midpoints. */
#include "check.h"
#include "cases.h"

#include <gsl/gsl_math.h>

static double length(const rb_rolling_mesh *mesh, int i)
{
    return mesh->ends[i + 1] - mesh->ends[i];
}

/* ---- Equal elements ---------------------------------------------------------------- */

TEST(equal_elements_are_equal_along_the_surface)
{
    rb_rolling_mesh mesh;
    rb_rolling_case rc = half_plane(RB_STATIC, 7);
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -2.0, 5.0, &mesh, NULL));
    assert_int_equal(mesh.n, 7);
    for (int i = 0; i <= 8; i++)
        CHECK_ABS(mesh.ends[i], i - 2.0, 1e-14, "end %d of a half-plane", i);
    rb_rolling_mesh_free(&mesh);

    rc.a.support = RB_BEM_ARC;
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -20.0, 30.0, &mesh, NULL));
    CHECK_REL(mesh.ends[0], -20.0, 1e-14, "first end");
    CHECK_REL(mesh.ends[7], 30.0, 1e-14, "last end");
    const double arc = 50.0 * (asin(0.6) - asin(-0.4)) / 7.0;
    for (int i = 0; i <= 7; i++)
        CHECK_REL(50.0 * (asin(mesh.ends[i + 1] / 50.0) - asin(mesh.ends[i] / 50.0)), arc, 1e-13,
                  "arc %d", i);
    rb_rolling_mesh_free(&mesh);
}

TEST(meshes_stay_on_the_lower_half)
{
    rb_rolling_mesh mesh;
    rb_rolling_case rc = rb_rolling_case_defaults();
    CHECK_SAYS(rb_rolling_mesh_uniform(&rc, NULL, 1.0, 1.0, &mesh, &message), RB_EINVAL,
               "is empty");
    CHECK_SAYS(rb_rolling_mesh_uniform(&rc, NULL, -1.0, 50.0, &mesh, &message), RB_EINVAL,
               "wider than the radius, 50 mm");
    CHECK_SAYS(rb_rolling_mesh_uniform(&rc, NULL, -50.0, 1.0, &mesh, &message), RB_EINVAL,
               "wider than the radius, 50 mm");
    rc.contact_elements = 3;
    CHECK_SAYS(rb_rolling_mesh_uniform(&rc, NULL, -49.0, 49.0, &mesh, &message), RB_EINVAL,
               "no room for the element before it");
    CHECK_SAYS(rb_rolling_mesh_fitted(&rc, NULL, 2.0, 1.0, &mesh, &message), RB_EINVAL, "is empty");
}

/* ---- The gap ----------------------------------------------------------------------- */

/* ---- Fitted elements --------------------------------------------------------------- */

/* -cos(theta) between the edges; beyond them elements begin as long as the last inside
 * and grow by a half each. */
TEST(fitted_elements_meet_both_edges)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, 20);
    OWNED(rb_rolling_mesh) mesh;
    CHECK_OK(rb_rolling_mesh_fitted(&rc, NULL, -1.0, 3.0, &mesh, NULL));
    assert_int_equal(mesh.n, 20 + 6 + 6);
    for (int i = 0; i <= 20; i++)
        CHECK_ABS(mesh.ends[6 + i], 1.0 - 2.0 * cos(M_PI * i / 20.0), 1e-14, "end %d", i);
    for (int k = 0; k < 6; k++) {
        const double want = length(&mesh, 6) * pow(1.5, k);
        CHECK_REL(length(&mesh, 26 + k), want, 1e-12, "element %d upstream", k);
        CHECK_REL(length(&mesh, 5 - k), want, 1e-12, "element %d downstream", k);
    }
    CHECK_REL(length(&mesh, 32), 1.5 * length(&mesh, 31), 1e-12, "before the mesh");
    for (int i = 0; i < mesh.n; i++)
        CHECK_REL(mesh.gap[i], rb_rolling_initial_gap(&rc, 0.5 * (mesh.ends[i] + mesh.ends[i + 1])),
                  1e-14, "gap %d", i);
}

/* A single element of more than half of what is left of the wheel has but half of it. */
TEST(the_element_before_the_mesh_stays_on_the_wheel)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, 4);
    OWNED(rb_rolling_mesh) mesh;
    CHECK_OK(rb_rolling_mesh_fitted(&rc, NULL, -30.0, 47.0, &mesh, NULL));
    CHECK_REL(length(&mesh, mesh.n), fmin(1.5 * length(&mesh, mesh.n - 1), 1.25), 1e-12,
              "of 2.5 mm");
    CHECK_MAX(mesh.ends[mesh.n + 1], 50.0, "on the wheel");
}

/* ---- Several patches --------------------------------------------------------------- */

/* ---- The mesh of a result ---------------------------------------------------------- */

TEST(a_result_has_the_elements_of_its_mesh)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = half_plane(RB_STATIC, 20);
        OWNED(rb_rolling_mesh) mesh, again;
        double x[32], h[32];
        rc.a.support = k % 2 ? RB_BEM_HUB : RB_BEM_HALFPLANE;
        if (k < 2)
            CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -7.0, 9.0, &mesh, NULL));
        else
            CHECK_OK(rb_rolling_mesh_fitted(&rc, NULL, -7.0, 9.0, &mesh, NULL));
        for (int i = 0; i < mesh.n; i++) {
            const double y[2] = {k % 2 ? sqrt(2500.0 - gsl_pow_2(mesh.ends[i])) : 0.0,
                                 k % 2 ? sqrt(2500.0 - gsl_pow_2(mesh.ends[i + 1])) : 0.0};
            x[i] = 0.5 * (mesh.ends[i] + mesh.ends[i + 1]);
            h[i] = hypot(length(&mesh, i), y[1] - y[0]); /* chords of the wheel */
        }
        const rb_rolling_elements elements = {.n = mesh.n, .x = x, .h = h, .are_equal = k < 2};
        CHECK_OK(rb_rolling_mesh_of_result(&rc, &elements, &again, NULL));
        assert_int_equal(again.n, mesh.n);
        for (int i = 0; i <= mesh.n + 1; i++)
            CHECK_ABS(again.ends[i], mesh.ends[i], 1e-11, "mesh %d, end %d", k, i);
        for (int i = 0; i < mesh.n; i++)
            CHECK_ABS(again.gap[i], mesh.gap[i], 1e-11, "mesh %d, gap %d", k, i);
    }
}

/* Whatever the case asks for, a result has its own elements. */
TEST(a_result_may_have_other_elements_than_its_case)
{
    const double x[] = {-1.0, 0.0, 1.0}, h[] = {1.0, 1.0, 1.0};
    for (int equal = 0; equal < 2; equal++) {
        const rb_rolling_case rc = half_plane(RB_STATIC, 20);
        const rb_rolling_elements elements = {.n = 3, .x = x, .h = h, .are_equal = equal};
        OWNED(rb_rolling_mesh) mesh;
        CHECK_OK(rb_rolling_mesh_of_result(&rc, &elements, &mesh, NULL));
        assert_int_equal(mesh.n, 3);
        for (int i = 0; i <= 3; i++)
            CHECK_ABS(mesh.ends[i], i - 1.5, 1e-14, "end %d", i);
    }
}

TEST(elements_out_of_order_are_refused)
{
    const double x[] = {0.0, 2.0, 1.0}, h[] = {1.0, 1.0, 1.0}, far[] = {0.0, 1.0, 60.0};
    const rb_rolling_case rc = half_plane(RB_STATIC, 20);
    rb_rolling_elements elements = {.n = 3, .x = x, .h = h};
    rb_rolling_mesh mesh;
    CHECK_SAYS(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &message), RB_EINVAL,
               "element 3 ends before it begins");
    assert_null(mesh.ends);
    elements.x = far;
    memset(&mesh, 1, sizeof mesh);
    CHECK_SAYS(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &message), RB_EINVAL,
               "wider than the radius");
    assert_null(mesh.ends);
}

RUN_TESTS(NULL, NULL)
