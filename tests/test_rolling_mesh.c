/* Contact meshes by themselves: where elements end, and the gap at their midpoints. */
#include "check.h"
#include "study/internal.h"

#include <gsl/gsl_math.h>
#include <string.h>

static rb_rolling_case plane(int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.contact_elements = elements;
    return rc;
}

static double length(const rb_rolling_mesh *mesh, int i)
{
    return mesh->ends[i + 1] - mesh->ends[i];
}

static void check_refused(rb_status s, const rb_message *why, const char *words)
{
    CHECK_STATUS(s, RB_EINVAL);
    if (!strstr(why->text, words))
        fail_msg("'%s' does not say '%s'", why->text, words);
}

/* ---- Equal elements ---------------------------------------------------------------- */

TEST(equal_elements_are_equal_along_the_surface)
{
    rb_rolling_mesh mesh;
    rb_rolling_case rc = plane(7);
    CHECK_STATUS(rb_rolling_mesh_uniform(&rc, NULL, -2.0, 5.0, &mesh, NULL), RB_OK);
    assert_int_equal(mesh.n, 7);
    for (int i = 0; i <= 8; i++)
        CHECK_ABS(mesh.ends[i], i - 2.0, 1e-14, "end %d of a half-plane", i);
    rb_rolling_mesh_free(&mesh);

    rc.a.support = RB_BEM_ARC;
    CHECK_STATUS(rb_rolling_mesh_uniform(&rc, NULL, -20.0, 30.0, &mesh, NULL), RB_OK);
    CHECK_REL(mesh.ends[0], -20.0, 1e-14, "first end");
    CHECK_REL(mesh.ends[7], 30.0, 1e-14, "last end");
    const double arc = 50.0 * (asin(0.6) - asin(-0.4)) / 7.0;
    for (int i = 0; i <= 7; i++)
        CHECK_REL(50.0 * (asin(mesh.ends[i + 1] / 50.0) - asin(mesh.ends[i] / 50.0)), arc,
                  1e-13, "arc %d", i);
    rb_rolling_mesh_free(&mesh);
}

TEST(meshes_stay_on_the_lower_half)
{
    rb_rolling_mesh mesh;
    rb_message why;
    rb_rolling_case rc = rb_rolling_case_defaults();
    check_refused(rb_rolling_mesh_uniform(&rc, NULL, 1.0, 1.0, &mesh, &why), &why,
                  "is empty");
    check_refused(rb_rolling_mesh_uniform(&rc, NULL, -1.0, 50.0, &mesh, &why), &why,
                  "wider than the radius, 50 mm");
    check_refused(rb_rolling_mesh_uniform(&rc, NULL, -50.0, 1.0, &mesh, &why), &why,
                  "wider than the radius, 50 mm");
    rc.contact_elements = 3;
    check_refused(rb_rolling_mesh_uniform(&rc, NULL, -49.0, 49.0, &mesh, &why), &why,
                  "no room for the element before it");
    check_refused(rb_rolling_mesh_fitted(&rc, NULL, 2.0, 1.0, &mesh, &why), &why,
                  "is empty");
}

/* ---- The gap ----------------------------------------------------------------------- */

TEST(the_gap_is_that_of_both_bodies)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    const double x = 3.0, a = 50.0 - sqrt(2500.0 - 9.0), b = 20.0 - sqrt(400.0 - 9.0);
    CHECK_REL(rb_rolling_initial_gap(&rc, x), a, 1e-13, "a circle on a plane");
    rc.b.radius = 20.0;
    CHECK_REL(rb_rolling_initial_gap(&rc, x), a + b, 1e-13, "two circles");
    rc.gap = RB_GAP_PARABOLA;
    CHECK_REL(rb_rolling_initial_gap(&rc, x), 4.5 * (1 / 50.0 + 1 / 20.0), 1e-14,
              "two parabolas");
    assert_true(rb_rolling_is_convex(&rc));
    rc.gap = RB_GAP_TABLE;
    assert_false(rb_rolling_is_convex(&rc));
}

TEST(what_is_worn_is_linear_between_its_points)
{
    const double x[] = {-1.0, 0.0, 3.0}, y[] = {0.1, 0.4, 0.1};
    static const double at[][2] = {{-1.1, 0.0}, {-1.0, 0.1}, {-0.5, 0.25}, {0.0, 0.4},
                                   {1.0, 0.3},  {3.0, 0.1},  {3.1, 0.0}};
    rb_rolling_case rc = plane(10);
    rc.gap = RB_GAP_PARABOLA;
    rc.worn = (rb_rolling_table){3, x, y};
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        CHECK_ABS(rb_rolling_worn_depth(&rc, at[k][0]), at[k][1], 1e-15, "x = %g",
                  at[k][0]);
        CHECK_REL(rb_rolling_initial_gap(&rc, at[k][0]),
                  gsl_pow_2(at[k][0]) / 100.0 + at[k][1], 1e-14, "gap");
    }
    assert_false(rb_rolling_is_convex(&rc));
    rc.worn.n = 1; /* at a point alone */
    CHECK_ABS(rb_rolling_worn_depth(&rc, -1.0), 0.1, 0.0, "one point");
    CHECK_ABS(rb_rolling_worn_depth(&rc, -0.9), 0.0, 0.0, "beside it");
}

/* The cubic through (-1, 0), (0, y), (1, 0) with natural ends: y (1 - 1.5 s^2 + 0.5 s^3),
 * s = |x|. */
TEST(an_irregularity_rides_with_the_material)
{
    const double x[] = {-1.0, 0.0, 1.0}, y[] = {0.0, 0.2, 0.0};
    const double places[] = {-4.0, -3.6, -3.0, -2.8, -2.0, -1.9};
    double gap[6];
    rb_rolling_case rc = plane(10);
    rc.gap = RB_GAP_PARABOLA;
    rc.irregularity = (rb_rolling_table){3, x, y};
    assert_false(rb_rolling_is_convex(&rc));
    CHECK_STATUS(rb_rolling_gap_along(&rc, 3.0, 6, places, gap), RB_OK);
    for (int i = 0; i < 6; i++) {
        const double s = fmin(1.0, fabs(places[i] + 3.0));
        const double own = 0.2 * (1.0 - 1.5 * s * s + 0.5 * s * s * s);
        CHECK_ABS(gap[i], gsl_pow_2(places[i]) / 100.0 + own, 1e-15, "x = %g", places[i]);
    }
}

TEST(elements_stand_within_bodies_and_table)
{
    const double x[] = {-3.0, -1.0, 0.0, 2.0}, y[] = {1.0, 0.1, 0.0, 1.0};
    double from, to;
    rb_rolling_profile *profile;
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_extent(&rc, &from, &to);
    CHECK_REL(to, 47.5, 1e-15, "0.95 R");
    CHECK_REL(from, -47.5, 1e-15, "0.95 R");
    rc.b.radius = 2.0;
    rb_rolling_extent(&rc, &from, &to);
    CHECK_REL(to, 1.9, 1e-15, "0.95 of the smaller radius");
    CHECK_STATUS(rb_rolling_profile_create(4, x, y, 0.0, &profile, NULL), RB_OK);
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    rb_rolling_extent(&rc, &from, &to);
    CHECK_REL(to, 1.9, 1e-15, "wheels end before the table");
    rc.a.support = RB_BEM_HALFPLANE;
    rb_rolling_extent(&rc, &from, &to);
    CHECK_REL(from, -3.0, 1e-15, "half-planes under a table are flat");
    CHECK_REL(to, 2.0, 1e-15, "half-planes under a table are flat");
    rb_rolling_profile_free(profile);
}

/* ---- Fitted elements --------------------------------------------------------------- */

/* -cos(theta) between the edges; beyond them elements begin as long as the last inside
 * and grow by a half each. */
TEST(fitted_elements_meet_both_edges)
{
    const rb_rolling_case rc = plane(20);
    rb_rolling_mesh mesh;
    CHECK_STATUS(rb_rolling_mesh_fitted(&rc, NULL, -1.0, 3.0, &mesh, NULL), RB_OK);
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
        CHECK_REL(mesh.gap[i],
                  rb_rolling_initial_gap(&rc, 0.5 * (mesh.ends[i] + mesh.ends[i + 1])),
                  1e-14, "gap %d", i);
    rb_rolling_mesh_free(&mesh);
}

/* As many elements as reach the room that is asked for, at most 64, and none beyond the
 * lower half of the wheel. */
TEST(fitted_elements_reach_as_far_as_asked)
{
    const rb_rolling_case rc = plane(60);
    const double step = 2.0 * gsl_pow_2(sin(0.5 * M_PI / 60.0)); /* of a patch of 2 */
    rb_rolling_span span = {.from = -1.0, .to = 1.0, .margin_left = 2.5 * step};
    rb_rolling_mesh mesh;
    span.margin_right = step * (pow(1.5, 9) - 1.0) / 0.5 * 1.0001;
    CHECK_STATUS(rb_rolling_mesh_spans(&rc, rc.contact_elements, 1, &span, &mesh, NULL),
                 RB_OK);
    assert_int_equal(mesh.n, 60 + 6 + 10); /* nine do not reach it */
    rb_rolling_mesh_free(&mesh);

    span = (rb_rolling_span){.from = -1e-9, .to = 1e-9, .margin_right = 10.0};
    CHECK_STATUS(rb_rolling_mesh_spans(&rc, rc.contact_elements, 1, &span, &mesh, NULL),
                 RB_OK);
    assert_int_equal(mesh.n, 60 + 6 + 64);
    rb_rolling_mesh_free(&mesh);

    /* 0.1 is left of 47.5, where an element beside the edge is 0.065 long */
    CHECK_STATUS(rb_rolling_mesh_fitted(&rc, NULL, -47.4, 47.4, &mesh, NULL), RB_OK);
    assert_int_equal(mesh.n, 60 + 2 + 2);
    CHECK_REL(mesh.ends[0], -47.5, 1e-14, "to the end of what there is");
    CHECK_REL(mesh.ends[64], 47.5, 1e-14, "to the end of what there is");
    CHECK_REL(length(&mesh, 64), 1.5 * length(&mesh, 63), 1e-9, "there is room for it");
    rb_rolling_mesh_free(&mesh);
    /* 0.075 are less than 1.25 elements: one longer one */
    CHECK_STATUS(rb_rolling_mesh_fitted(&rc, NULL, -1.0, 47.425, &mesh, NULL), RB_OK);
    CHECK_REL(mesh.ends[mesh.n], 47.5, 1e-14, "to the end of what there is");
    CHECK_MAX(mesh.n, 60 + 6 + 2, "elements");
    rb_rolling_mesh_free(&mesh);
}

/* A single element of more than half of what is left of the wheel has but half of it. */
TEST(the_element_before_the_mesh_stays_on_the_wheel)
{
    const rb_rolling_case rc = plane(4);
    rb_rolling_mesh mesh;
    CHECK_STATUS(rb_rolling_mesh_fitted(&rc, NULL, -30.0, 47.0, &mesh, NULL), RB_OK);
    CHECK_REL(length(&mesh, mesh.n), fmin(1.5 * length(&mesh, mesh.n - 1), 1.25), 1e-12,
              "of 2.5 mm");
    CHECK_MAX(mesh.ends[mesh.n + 1], 50.0, "on the wheel");
    rb_rolling_mesh_free(&mesh);
}

/* ---- Several patches --------------------------------------------------------------- */

static int count_between(const rb_rolling_mesh *mesh, double from, double to)
{
    int n = 0;
    for (int i = 0; i < mesh->n; i++)
        n += mesh->ends[i] > from - 1e-12 && mesh->ends[i + 1] < to + 1e-12;
    return n;
}

static int has_end(const rb_rolling_mesh *mesh, double x)
{
    for (int i = 0; i <= mesh->n; i++)
        if (mesh->ends[i] == x)
            return 1;
    return 0;
}

TEST(patches_share_the_elements_by_their_width)
{
    static const struct {
        int elements;
        double to[2];
        int across[2];
    } rows[] = {{60, {1.0, 6.0}, {20, 40}},  /* widths 1 and 2 */
                {60, {1.0, 13.0}, {15, 54}}, /* at least a quarter of all */
                {16, {1.0, 6.0}, {12, 12}}}; /* at least 12 */
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const rb_rolling_case rc = plane(rows[k].elements);
        const rb_rolling_span span[2] = {{.from = 0.0, .to = rows[k].to[0]},
                                         {.from = 4.0, .to = rows[k].to[1]}};
        rb_rolling_mesh mesh;
        CHECK_STATUS(
            rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL), RB_OK);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(count_between(&mesh, span[i].from, span[i].to),
                             rows[k].across[i]);
            assert_true(has_end(&mesh, span[i].from) && has_end(&mesh, span[i].to));
        }
        rb_rolling_mesh_free(&mesh);
    }
}

/* From either edge by a half longer each until they meet, all stretched alike: between
 * equal patches symmetric. */
TEST(elements_between_patches_meet)
{
    static const double edges[] = {0.001, 0.01, 0.1, 1.0, 10.0}; /* distances from 0 */
    const rb_rolling_case rc = plane(60);
    for (size_t k = 0; k < sizeof edges / sizeof *edges; k++) {
        const double e = edges[k];
        const rb_rolling_span span[2] = {{.from = -1.0 - e, .to = -e},
                                         {.from = e, .to = 1.0 + e}};
        const double step = gsl_pow_2(sin(0.5 * M_PI / 30.0));
        rb_rolling_mesh mesh;
        CHECK_STATUS(
            rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL), RB_OK);
        const int n = count_between(&mesh, -e, e), first = 6 + 30;
        int side = 0; /* so many elements of either side, unstretched, are no longer */
        while (2.0 * step * (pow(1.5, side + 1) - 1.0) / 0.5 <= 2.0 * e)
            side++;
        assert_int_equal(n, side > 0 ? 2 * side : 1);
        assert_true(mesh.ends[first] == -e && mesh.ends[first + n] == e);
        for (int i = 0; i < n; i++) {
            CHECK_REL(length(&mesh, first + i), length(&mesh, first + n - 1 - i), 1e-9,
                      "edge %g, element %d: symmetric", e, i);
            if (i > 0 && 2 * i < n - 1)
                CHECK_REL(length(&mesh, first + i), 1.5 * length(&mesh, first + i - 1),
                          1e-9, "edge %g, element %d: grows", e, i);
        }
        if (n > 1) /* stretched by less than another element of either side would need */
            assert_true(length(&mesh, first) > 0.999 * step &&
                        length(&mesh, first) < 2.5 * step);
        rb_rolling_mesh_free(&mesh);
    }
}

TEST(patches_far_apart_have_64_elements_between_them)
{
    const rb_rolling_case rc = plane(60);
    const rb_rolling_span span[2] = {{.from = -20.0, .to = -19.9999},
                                     {.from = 19.9999, .to = 20.0}};
    rb_rolling_mesh mesh;
    CHECK_STATUS(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL),
                 RB_OK);
    const int n = count_between(&mesh, -19.9999, 19.9999);
    assert_in_range(n, 60, 64);
    for (int i = 0; i < mesh.n; i++)
        assert_true(length(&mesh, i) > 0.0);
    rb_rolling_mesh_free(&mesh);
}

/* A narrow and a wide patch: the smaller elements grow alone until they are as long. */
TEST(unequal_elements_grow_until_they_are_alike)
{
    const rb_rolling_case rc = plane(60);
    const rb_rolling_span span[2] = {{.from = -0.1, .to = 0.0}, {.from = 1.0, .to = 9.0}};
    rb_rolling_mesh mesh;
    CHECK_STATUS(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL),
                 RB_OK);
    const int n = count_between(&mesh, 0.0, 1.0), first = 6 + 15;
    assert_in_range(n, 6, 24);
    CHECK_REL(length(&mesh, first + 1), 1.5 * length(&mesh, first), 1e-9, "on the left");
    CHECK_REL(length(&mesh, first + n - 1) / length(&mesh, first),
              8.0 * gsl_pow_2(sin(0.5 * M_PI / 59.0)) /
                  (0.1 * gsl_pow_2(sin(0.5 * M_PI / 15.0))),
              1e-9, "as the elements beside them");
    rb_rolling_mesh_free(&mesh);
}

/* ---- The mesh of a result ---------------------------------------------------------- */

TEST(a_result_has_the_elements_of_its_mesh)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = plane(20);
        rb_rolling_mesh mesh, again;
        double x[32], h[32];
        rc.a.support = k % 2 ? RB_BEM_HUB : RB_BEM_HALFPLANE;
        if (k < 2)
            CHECK_STATUS(rb_rolling_mesh_uniform(&rc, NULL, -7.0, 9.0, &mesh, NULL),
                         RB_OK);
        else
            CHECK_STATUS(rb_rolling_mesh_fitted(&rc, NULL, -7.0, 9.0, &mesh, NULL),
                         RB_OK);
        for (int i = 0; i < mesh.n; i++) {
            const double y[2] = {k % 2 ? sqrt(2500.0 - gsl_pow_2(mesh.ends[i])) : 0.0,
                                 k % 2 ? sqrt(2500.0 - gsl_pow_2(mesh.ends[i + 1]))
                                       : 0.0};
            x[i] = 0.5 * (mesh.ends[i] + mesh.ends[i + 1]);
            h[i] = hypot(length(&mesh, i), y[1] - y[0]); /* chords of the wheel */
        }
        const rb_rolling_elements elements = {
            .n = mesh.n, .x = x, .h = h, .are_equal = k < 2};
        CHECK_STATUS(rb_rolling_mesh_of_result(&rc, &elements, &again, NULL), RB_OK);
        assert_int_equal(again.n, mesh.n);
        for (int i = 0; i <= mesh.n + 1; i++)
            CHECK_ABS(again.ends[i], mesh.ends[i], 1e-11, "mesh %d, end %d", k, i);
        for (int i = 0; i < mesh.n; i++)
            CHECK_ABS(again.gap[i], mesh.gap[i], 1e-11, "mesh %d, gap %d", k, i);
        rb_rolling_mesh_free(&again);
        rb_rolling_mesh_free(&mesh);
    }
}

/* Whatever the case asks for, a result has its own elements. */
TEST(a_result_may_have_other_elements_than_its_case)
{
    const double x[] = {-1.0, 0.0, 1.0}, h[] = {1.0, 1.0, 1.0};
    for (int equal = 0; equal < 2; equal++) {
        const rb_rolling_case rc = plane(20);
        const rb_rolling_elements elements = {.n = 3, .x = x, .h = h, .are_equal = equal};
        rb_rolling_mesh mesh;
        CHECK_STATUS(rb_rolling_mesh_of_result(&rc, &elements, &mesh, NULL), RB_OK);
        assert_int_equal(mesh.n, 3);
        for (int i = 0; i <= 3; i++)
            CHECK_ABS(mesh.ends[i], i - 1.5, 1e-14, "end %d", i);
        rb_rolling_mesh_free(&mesh);
    }
}

TEST(elements_out_of_order_are_refused)
{
    const double x[] = {0.0, 2.0, 1.0}, h[] = {1.0, 1.0, 1.0}, far[] = {0.0, 1.0, 60.0};
    const rb_rolling_case rc = plane(20);
    rb_rolling_elements elements = {.n = 3, .x = x, .h = h};
    rb_rolling_mesh mesh;
    rb_message why;
    check_refused(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &why), &why,
                  "element 3 ends before it begins");
    assert_null(mesh.ends);
    elements.x = far;
    memset(&mesh, 1, sizeof mesh);
    check_refused(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &why), &why,
                  "wider than the radius");
    assert_null(mesh.ends);
}

RUN_TESTS(NULL, NULL)
