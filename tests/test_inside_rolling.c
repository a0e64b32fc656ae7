/* What src/rolling keeps to itself of surfaces and meshes: gaps, elements, overlaps that
 * a mesh has missed. */
#include "bumps.h"
#include "cases.h"
#include "check.h"
#include "profiles.h"
#include "solved.h"
#include "rolling/body/far_field.h"
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/zone.h"

#include <gsl/gsl_math.h>

/* ---- Surfaces and meshes ----------------------------------------------------------- */

static double length(const rb_rolling_mesh *mesh, int i)
{
    return mesh->ends[i + 1] - mesh->ends[i];
}

TEST(the_gap_is_that_of_both_bodies)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    const double x = 3.0, a = 50.0 - sqrt(2500.0 - 9.0), b = 20.0 - sqrt(400.0 - 9.0);
    CHECK_REL(rb_rolling_initial_gap(&rc, x), a, 1e-13, "a circle on a plane");
    rc.b.radius = 20.0;
    CHECK_REL(rb_rolling_initial_gap(&rc, x), a + b, 1e-13, "two circles");
    rc.gap = RB_GAP_PARABOLA;
    CHECK_REL(rb_rolling_initial_gap(&rc, x), 4.5 * (1 / 50.0 + 1 / 20.0), 1e-14, "two parabolas");
    assert_true(rb_rolling_is_convex(&rc));
    rc.gap = RB_GAP_TABLE;
    assert_false(rb_rolling_is_convex(&rc));
}

/* Bytes between two numbers do not make another body; any byte of a number does. */
TEST(bodies_are_compared_by_their_numbers)
{
    static const size_t size = sizeof(rb_rolling_body);
    const rb_rolling_body like =
        with(half_plane(RB_STEADY, 12), "relaxation-time 1 relaxation-ratio 1").a;
    rb_rolling_body x, y;
    int numbers = 0;
    memset(&x, 0, size);
    memcpy(&x, &like, size);
    for (size_t k = 0; k < size; k++) {
        memcpy(&y, &x, size);
        ((unsigned char *)&y)[k] ^= 1;
        numbers += !rb_rolling_same_body(&x, &y);
    }
    /* support, what holds the layer and the count of terms are ints, the layers a pointer, all
     * others doubles */
    assert_int_equal(numbers, (int)(13 * sizeof(double) + 3 * sizeof(int) + sizeof(void *) +
                                    2 * RB_ROLLING_TERMS * sizeof(double)));
}

TEST(what_is_worn_is_linear_between_its_points)
{
    const double x[] = {-1.0, 0.0, 3.0}, y[] = {0.1, 0.4, 0.1};
    static const double at[][2] = {{-1.1, 0.0}, {-1.0, 0.1}, {-0.5, 0.25}, {0.0, 0.4},
                                   {1.0, 0.3},  {3.0, 0.1},  {3.1, 0.0}};
    rb_rolling_case rc = half_plane(RB_STATIC, 10);
    rc.gap = RB_GAP_PARABOLA;
    rc.worn = (rb_rolling_table){3, x, y};
    for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
        CHECK_ABS(rb_rolling_worn_depth(&rc, at[k][0]), at[k][1], 1e-15, "x = %g", at[k][0]);
        CHECK_REL(rb_rolling_initial_gap(&rc, at[k][0]), gsl_pow_2(at[k][0]) / 100.0 + at[k][1],
                  1e-14, "gap");
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
    rb_rolling_case rc = half_plane(RB_STATIC, 10);
    rc.gap = RB_GAP_PARABOLA;
    rc.irregularity = (rb_rolling_table){3, x, y};
    assert_false(rb_rolling_is_convex(&rc));
    CHECK_OK(rb_rolling_gap_along(&rc, 3.0, 6, places, gap));
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
    CHECK_OK(rb_rolling_profile_create(4, x, y, 0.0, &profile, NULL));
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

/* As many elements as reach the room that is asked for, at most 64, and none beyond the
 * lower half of the wheel. */
TEST(fitted_elements_reach_as_far_as_asked)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, 60);
    const double step = 2.0 * gsl_pow_2(sin(0.5 * M_PI / 60.0)); /* of a patch of 2 */
    rb_rolling_span span = {.from = -1.0, .to = 1.0, .margin_left = 2.5 * step};
    rb_rolling_mesh mesh;
    span.margin_right = step * (pow(1.5, 9) - 1.0) / 0.5 * 1.0001;
    CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 1, &span, &mesh, NULL));
    assert_int_equal(mesh.n, 60 + 6 + 10); /* nine do not reach it */
    rb_rolling_mesh_free(&mesh);

    span = (rb_rolling_span){.from = -1e-9, .to = 1e-9, .margin_right = 10.0};
    CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 1, &span, &mesh, NULL));
    assert_int_equal(mesh.n, 60 + 6 + 64);
    rb_rolling_mesh_free(&mesh);

    /* 0.1 is left of 47.5, where an element beside the edge is 0.065 long */
    CHECK_OK(rb_rolling_mesh_fitted(&rc, NULL, -47.4, 47.4, &mesh, NULL));
    assert_int_equal(mesh.n, 60 + 2 + 2);
    CHECK_REL(mesh.ends[0], -47.5, 1e-14, "to the end of what there is");
    CHECK_REL(mesh.ends[64], 47.5, 1e-14, "to the end of what there is");
    CHECK_REL(length(&mesh, 64), 1.5 * length(&mesh, 63), 1e-9, "there is room for it");
    rb_rolling_mesh_free(&mesh);
    /* 0.075 are less than 1.25 elements: one longer one */
    CHECK_OK(rb_rolling_mesh_fitted(&rc, NULL, -1.0, 47.425, &mesh, NULL));
    CHECK_REL(mesh.ends[mesh.n], 47.5, 1e-14, "to the end of what there is");
    CHECK_MAX(mesh.n, 60 + 6 + 2, "elements");
    rb_rolling_mesh_free(&mesh);
}

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
        const rb_rolling_case rc = half_plane(RB_STATIC, rows[k].elements);
        const rb_rolling_span span[2] = {{.from = 0.0, .to = rows[k].to[0]},
                                         {.from = 4.0, .to = rows[k].to[1]}};
        OWNED(rb_rolling_mesh) mesh;
        CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL));
        for (int i = 0; i < 2; i++) {
            assert_int_equal(count_between(&mesh, span[i].from, span[i].to), rows[k].across[i]);
            assert_true(has_end(&mesh, span[i].from) && has_end(&mesh, span[i].to));
        }
    }
}

/* From either edge by a half longer each until they meet, all stretched alike: between
 * equal patches symmetric. */
TEST(elements_between_patches_meet)
{
    static const double edges[] = {0.001, 0.01, 0.1, 1.0, 10.0}; /* distances from 0 */
    const rb_rolling_case rc = half_plane(RB_STATIC, 60);
    for (size_t k = 0; k < sizeof edges / sizeof *edges; k++) {
        const double e = edges[k];
        const rb_rolling_span span[2] = {{.from = -1.0 - e, .to = -e}, {.from = e, .to = 1.0 + e}};
        const double step = gsl_pow_2(sin(0.5 * M_PI / 30.0));
        OWNED(rb_rolling_mesh) mesh;
        CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL));
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
                CHECK_REL(length(&mesh, first + i), 1.5 * length(&mesh, first + i - 1), 1e-9,
                          "edge %g, element %d: grows", e, i);
        }
        if (n > 1) /* stretched by less than another element of either side would need */
            assert_true(length(&mesh, first) > 0.999 * step && length(&mesh, first) < 2.5 * step);
    }
}

TEST(patches_far_apart_have_64_elements_between_them)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, 60);
    const rb_rolling_span span[2] = {{.from = -20.0, .to = -19.9999},
                                     {.from = 19.9999, .to = 20.0}};
    OWNED(rb_rolling_mesh) mesh;
    CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL));
    const int n = count_between(&mesh, -19.9999, 19.9999);
    assert_in_range(n, 60, 64);
    for (int i = 0; i < mesh.n; i++)
        assert_true(length(&mesh, i) > 0.0);
}

/* A narrow and a wide patch: the smaller elements grow alone until they are as long. */
TEST(unequal_elements_grow_until_they_are_alike)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, 60);
    const rb_rolling_span span[2] = {{.from = -0.1, .to = 0.0}, {.from = 1.0, .to = 9.0}};
    OWNED(rb_rolling_mesh) mesh;
    CHECK_OK(rb_rolling_mesh_spans(&rc, rc.contact_elements, 2, span, &mesh, NULL));
    const int n = count_between(&mesh, 0.0, 1.0), first = 6 + 15;
    assert_in_range(n, 6, 24);
    CHECK_REL(length(&mesh, first + 1), 1.5 * length(&mesh, first), 1e-9, "on the left");
    CHECK_REL(length(&mesh, first + n - 1) / length(&mesh, first),
              8.0 * gsl_pow_2(sin(0.5 * M_PI / 59.0)) / (0.1 * gsl_pow_2(sin(0.5 * M_PI / 15.0))),
              1e-9, "as the elements beside them");
}

/* The spline goes through the points, or where they are smoothed through as many places,
 * at most 1001 of them; a parabola is smoothed to itself, and goes on straight beyond its
 * ends. */
TEST(smoothed_splines_have_as_many_points)
{
    static double x[6001], gap[6001];
    static const int counts[][2] = {{3, 3}, {9, 9}, {301, 301}, {6001, 1001}};
    for (int k = 0; k < 4; k++) {
        const int n = counts[k][0];
        for (int i = 0; i < n; i++) {
            x[i] = -3.0 + 7.0 * i / (n - 1);
            gap[i] = 0.5 * (x[i] - 0.3) * (x[i] - 0.3);
        }
        for (int smooth = 0; smooth < 2; smooth++) {
            rb_rolling_profile *profile = profile_of(n, x, gap, smooth ? 1e-3 : 0.0);
            const double *at;
            double from, to;
            const int rows = rb_rolling_profile_rows(profile, &at);
            assert_int_equal(rows, smooth ? counts[k][1] : n);
            for (int i = 0; i < rows; i++)
                CHECK_ABS(at[i], -3.0 + 7.0 * i / (rows - 1), 1e-12, "place %d", i);
            rb_rolling_profile_range(profile, &from, &to);
            CHECK_ABS(from, -3.0, 0.0, "from");
            CHECK_ABS(to, 4.0, 0.0, "to");
            const double end = rb_rolling_profile_gap(profile, 4.0);
            CHECK_ABS(rb_rolling_profile_gap(profile, 6.0) - end,
                      2.0 * (rb_rolling_profile_gap(profile, 5.0) - end), 1e-12, "straight on");
            for (int i = 0; i < rows && smooth; i += 1 + rows / 50)
                CHECK_ABS(rb_rolling_profile_gap(profile, at[i]),
                          0.5 * (at[i] - 0.3) * (at[i] - 0.3), 1e-8, "parabola at %g", at[i]);
            rb_rolling_profile_free(profile);
        }
    }
}

/* ---- Missed contacts --------------------------------------------------------------- */

/* Solved on elements over a part of the table alone. */
static rb_rolling_model solved_between(const rb_rolling_case *rc, double from, double to)
{
    rb_rolling_model model;
    rb_rolling_mesh mesh;
    CHECK_OK(rb_rolling_model_begin(rc, NULL, &model, &message));
    CHECK_OK(rb_rolling_mesh_uniform(rc, NULL, from, to, &mesh, &message));
    const rb_status s = rb_rolling_model_build(&model, &mesh, &message);
    if (s != RB_OK && s != RB_ZONE)
        fail_msg("%s", message.text);
    return model;
}

/* Elements under one bump: the others overlap, each in a stretch of its own around its
 * place, from as far from the mesh as they are. */
TEST(every_bump_that_overlaps_is_found)
{
    static const double x[] = {-5.0, -2.5, 0.0, 3.0, 6.0}, height[5] = {0.0};
    held_table *t = bumps(5, x, height);
    rb_rolling_model model = solved_between(&t->rc, -0.4, 0.4);
    rb_rolling_overlap o;
    assert_int_equal(model.state.status, RB_ZONE);
    CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
    assert_int_equal(o.count, 4);
    for (int k = 0; k < 4; k++) {
        const double place = x[k < 2 ? k : k + 1];
        assert_true(o.from[k] < place && place < o.to[k]);
        CHECK_ABS(0.5 * (o.from[k] + o.to[k]), place, 0.1, "bump %d", k);
        CHECK_MAX(o.to[k] - o.from[k], 1.0, "stretch %d", k);
    }
    rb_rolling_model_free(&model);

    /* where its own elements see it, a bump is no overlap */
    model = solved_between(&t->rc, -3.5, 4.0);
    CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
    assert_int_equal(o.count, 2);
    rb_rolling_model_free(&model);
}

/* The surface sinks by what the pressed half-plane gives way there: a bump that is just
 * too low does not overlap, one a little higher does. */
TEST(a_bump_overlaps_where_the_surface_has_not_sunk)
{
    const double x[] = {0.0, 4.0}, flat[] = {0.0, 1e-4};
    table *t = bumps(2, x, flat);
    rb_rolling_model model = solved_between(&t->rc, -0.5, 0.5);
    rb_rolling_overlap o;
    /* w_N of the resultant at a distance against the approach, from the closed form of
     * the half-plane: -2 P/(pi E') ln(r) up to the same datum */
    const double E = 94500.0 / 0.99, P = rb_rolling_model_load(&model);
    double w[2 * 41];
    CHECK_OK(rb_rolling_displacement(&model.bodies, model.state.p, model.state.q, w));
    const double far = w[0] - 2.0 * P / (M_PI * E) * log(4.0 / fabs(model.bodies.f.x[0]));
    const double limit = model.state.delta - far; /* gaps below it overlap */
    rb_rolling_model_free(&model);
    bumps_free(t);
    for (int k = 0; k < 2; k++) {
        const double height[] = {0.0, limit * (k ? 1.05 : 0.95)};
        t = bumps(2, x, height);
        model = solved_between(&t->rc, -0.5, 0.5);
        CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
        assert_int_equal(o.count, k ? 0 : 1);
        assert_int_equal(model.state.status, k ? RB_OK : RB_ZONE);
        rb_rolling_model_free(&model);
        bumps_free(t);
    }
}

/* Likewise the rim of a wheel, by what elements that reach the bump tell of it. */
TEST(a_wheel_sinks_as_its_elements_tell)
{
    enum { WIDE = 112, M = WIDE + 1 };
    const double x[] = {0.0, 6.0};
    for (int k = 0; k < 4; k++) {
        rb_rolling_overlap o;
        double w[2 * M], height[] = {0.0, 0.5};
        table *t = bumps(2, x, height);
        set(&t->rc, "support %s contact-elements %d", k < 2 ? "hub" : "arc", WIDE);
        rb_rolling_model model = solved_between(&t->rc, -0.5, 6.5);
        CHECK_OK(rb_rolling_displacement(&model.bodies, model.state.p, model.state.q, w));
        const int at = (int)(6.5 / 7.0 * WIDE);
        CHECK_ABS(model.bodies.f.x[at], 6.0, 0.05, "there");
        height[1] = (model.state.delta - w[at]) * (k % 2 ? 1.05 : 0.95);
        rb_rolling_model_free(&model);
        bumps_free(t);
        t = bumps(2, x, height);
        t->rc.a.support = k < 2 ? RB_BEM_HUB : RB_BEM_ARC;
        model = solved_between(&t->rc, -0.5, 0.5);
        CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
        assert_int_equal(o.count, k % 2 ? 0 : 1);
        rb_rolling_model_free(&model);
        bumps_free(t);
    }
}

TEST(more_overlaps_than_there_is_room_end_in_one)
{
    double x[MOST], height[MOST] = {0.0};
    for (int k = 0; k < MOST; k++)
        x[k] = 1.5 * (k - MOST / 2);
    held_table *t = bumps(MOST, x, height);
    OWNED(rb_rolling_model) model = solved_between(&t->rc, -0.5, 0.5);
    rb_rolling_overlap o;
    CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
    assert_int_equal(o.count, RB_MOST_OVERLAPS);
    CHECK_ABS(o.to[RB_MOST_OVERLAPS - 1], x[MOST - 1], 0.3, "up to the last one");
}

/* The surface of a wheel sinks by what its boundary elements say: known from elements
 * that reach there, with a bump that is too high to touch. */
TEST(a_wheel_sinks_as_on_elements_that_reach_there)
{
    static const double places[] = {2.17, 3.0, 3.4, 4.2};
    for (int place = 0; place < 4; place++) {
        const double x[] = {0.0, places[place]}, high[] = {0.0, 0.05};
        table *t = bumps(2, x, high);
        double w[2 * 41], limit = NAN;
        t->rc.a.support = RB_BEM_HUB;
        OWNED(rb_rolling_model) near = solved_between(&t->rc, -0.5, 0.5);
        rb_rolling_model model = solved_between(&t->rc, -0.5, x[1] + 0.5); /* as much load */
        CHECK_OK(rb_rolling_displacement(&model.bodies, model.state.p, model.state.q, w));
        for (int i = 0; i + 1 < model.mesh.n; i++)
            if (model.bodies.f.x[i] <= x[1] && model.bodies.f.x[i + 1] > x[1])
                limit = near.state.delta - w[i];
        rb_rolling_model_free(&model);
        bumps_free(t);
        for (int k = 0; k < 2; k++) {
            const double height[] = {0.0, limit * (k ? 1.01 : 0.99)};
            rb_rolling_overlap o;
            t = bumps(2, x, height);
            t->rc.a.support = RB_BEM_HUB;
            model = solved_between(&t->rc, -0.5, 0.5);
            CHECK_OK(rb_rolling_find_overlap(&model, &model.state, &o));
            assert_int_equal(o.count, k ? 0 : 1);
            rb_rolling_model_free(&model);
            bumps_free(t);
        }
    }
}

/* ---- The far field of wheels ------------------------------------------------------- */

static double largest_difference(const rb_rolling_bodies *x, const rb_rolling_bodies *y)
{
    double most = 0.0, scale = 0.0;

    assert_int_equal(x->f.n, y->f.n);
    for (int k = 0; k < 4 * x->f.m * x->f.n; k++) {
        most = fmax(most, fabs(x->F[k] - y->F[k]));
        scale = fmax(scale, fabs(y->F[k]));
    }
    return most / scale;
}

/* Displacements by boundary elements have errors of h/R close to a load: on the mesh that a far
 * field was taken from few points leave them out, from equal elements on fitted ones they differ;
 * beside a half-plane and a wheel; and x, h of boundary elements. */
TEST(a_far_field_moves_from_mesh_to_mesh)
{
    static const char *const rows[] = {
        "support hub hub-ratio 0.3", "support arc", "support hub hub-ratio 0.6 half-width 10",
        "support hub young-b 1e5 interlayer-normal 1e-5 interlayer-tangential 2e-5",
        "support arc young-b 1e5 support-b hub hub-ratio-b 0.4 radius-b 30"};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const rb_rolling_case rc = with(with(rb_rolling_case_defaults(),
                                             "gap parabola formulation steady mesh fitted "
                                             "creep-ratio 0.4 half-width 2 contact-elements 60"),
                                        "%s", rows[k]);
        OWNED(rb_rolling_model) fitted = solved_model(&rc), equal;
        rb_rolling_mesh mesh;
        rb_rolling_plan plan = rb_rolling_plan_of(&rc);
        assert_true(rb_rolling_has_far_field(&rc));
        CHECK_OK(rb_rolling_model_begin(&rc, NULL, &equal, &message));
        plan.elements = 30;
        CHECK_OK(rb_rolling_mesh_uniform(&rc, &plan, 1.2 * fitted.mesh.ends[0],
                                         1.2 * fitted.mesh.ends[fitted.mesh.n], &mesh, &message));
        CHECK_OK(rb_rolling_model_build(&equal, &mesh, &message));
        const rb_rolling_model *const of[] = {&fitted, &equal};
        for (int i = 0; i < 2; i++) {
            rb_rolling_far_field *far;
            rb_rolling_bodies near;
            CHECK_OK(rb_rolling_far_field_create(of[i], 0, &far, &message));
            CHECK_OK(rb_rolling_bodies_near(&rc, far, &fitted.mesh, &near, &message));
            CHECK_MAX(largest_difference(&near, &fitted.bodies), i ? 3e-3 : 1e-3, "row %zu", k);
            for (int j = 0; j < near.f.m; j++) {
                CHECK_REL(near.f.h[j], fitted.bodies.f.h[j], 1e-12, "length of %d", j);
                CHECK_ABS(near.f.x[j], fitted.bodies.f.x[j], 1e-12, "place of %d", j);
            }
            rb_rolling_bodies_free(&near);
            rb_rolling_far_field_free(far);
        }
    }
}

/* Where a far field is matched it moves the elements under the tractions of the model as the
 * boundaries do, whether these are solved for the tractions alone or wholly; and most of that, a
 * line, goes to meshes with other elements. */
TEST(a_far_field_is_matched_to_the_boundaries)
{
    static const char *const rows[] = {"support hub hub-ratio 0.3",
                                       "support arc young-b 1e5 interlayer-normal 1e-5",
                                       "support arc young-b 1e5 support-b hub radius-b 30"};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const rb_rolling_case rc = with(with(rb_rolling_case_defaults(),
                                             "gap parabola formulation steady mesh fitted "
                                             "creep-ratio 0.4 half-width 2 contact-elements 40"),
                                        "%s", rows[k]);
        OWNED(rb_rolling_model) whole = solved_model(&rc), led, coarse;
        const rb_bem_flexibility *f = &whole.bodies.f;
        const rb_rolling_elements elements = {.n = f->n, .x = f->x, .h = f->h};
        rb_rolling_mesh mesh;
        rb_rolling_plan plan = rb_rolling_plan_of(&rc);
        const size_t n = (size_t)f->n, rows_of_w = 2 * (n + 1);
        SCRATCH double *w = rb_alloc(rows_of_w, 4);
        double *want = w + 3 * rows_of_w;
        /* the far field of a coarse boundary under equal elements moves the model's */
        plan.elements = 30;
        plan.outer_refinement = 0.5;
        CHECK_OK(rb_rolling_model_begin(&rc, &plan, &coarse, &message));
        CHECK_OK(rb_rolling_mesh_uniform(&rc, &plan, 1.2 * whole.mesh.ends[0],
                                         1.2 * whole.mesh.ends[whole.mesh.n], &mesh, &message));
        CHECK_OK(rb_rolling_model_build(&coarse, &mesh, &message));
        CHECK_OK(rb_rolling_model_begin(&rc, NULL, &led, &message));
        CHECK_OK(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &message));
        CHECK_OK(rb_rolling_far_field_create(&coarse, 0, &led.far, &message));
        CHECK_OK(rb_rolling_model_build(&led, &mesh, &message));
        assert_true(!led.bodies.system_a && !led.bodies.system_b);
        CHECK_OK(rb_rolling_displacement(&whole.bodies, led.state.p, led.state.q, want));
        CHECK_OK(rb_rolling_displacement(&led.bodies, led.state.p, led.state.q, w));
        CHECK_OK(rb_rolling_far_field_match(&led, led.far, &message));
        assert_true(rb_rolling_far_field_matches(led.far, f->n));
        assert_false(rb_rolling_far_field_matches(led.far, f->n + 1));
        rb_rolling_far_field *own;
        memcpy(whole.state.p, led.state.p, n * sizeof *w);
        memcpy(whole.state.q, led.state.q, n * sizeof *w);
        CHECK_OK(rb_rolling_far_field_create(&whole, 1, &own, &message));
        for (int i = 0; i < 2; i++) {
            rb_rolling_bodies near;
            CHECK_OK(rb_rolling_bodies_near(&rc, i ? own : led.far, &led.mesh, &near, &message));
            CHECK_OK(rb_rolling_displacement(&near, led.state.p, led.state.q,
                                             w + (size_t)(i + 1) * rows_of_w));
            rb_rolling_bodies_free(&near);
        }
        rb_rolling_far_field_free(own);
        const double size = rb_norm_inf(rows_of_w, want);
        double unmatched = 0.0;
        for (size_t i = 0; i < rows_of_w; i++) {
            unmatched = fmax(unmatched, fabs(w[i] - want[i]));
            for (size_t l = 1; l < 3; l++)
                CHECK_ABS(w[i + l * rows_of_w], want[i], 1e-9 * size, "row %zu: %zu, %zu", k, i, l);
        }
        assert_true(unmatched > 1e-5 * size);
        /* on the same places, one element more: two in place of the first */
        CHECK_OK(rb_rolling_mesh_of_result(&rc, &elements, &mesh, &message));
        rb_rolling_mesh other;
        CHECK_OK(rb_rolling_mesh_alloc(mesh.n + 1, &other));
        memcpy(other.ends + 1, mesh.ends, (size_t)(mesh.n + 2) * sizeof *mesh.ends);
        other.ends[0] = mesh.ends[0];
        other.ends[1] = 0.5 * (mesh.ends[0] + mesh.ends[1]);
        CHECK_OK(rb_rolling_mesh_set_gap(&rc, &other));
        rb_rolling_bodies near;
        SCRATCH double *r = rb_alloc(n + 1, 2), *moved = rb_alloc(n + 2, 2);
        for (size_t i = 0; i < n; i++) {
            r[i + 1] = led.state.p[i];
            r[n + 2 + i] = led.state.q[i];
        }
        r[0] = r[1];
        r[n + 1] = r[n + 2];
        CHECK_OK(rb_rolling_bodies_near(&rc, led.far, &other, &near, &message));
        CHECK_OK(rb_rolling_displacement(&near, r, r + n + 1, moved));
        double most = 0.0;
        for (size_t i = 1; i <= n; i++)
            for (size_t a = 0; a < 2; a++)
                most = fmax(most, fabs(moved[a * (n + 2) + i + 1] - want[a * (n + 1) + i]));
        CHECK_MAX(most, 0.3 * unmatched, "row %zu: %g of %g", k, most / size, unmatched / size);
        rb_rolling_bodies_free(&near);
        rb_rolling_mesh_free(&other);
        rb_rolling_mesh_free(&mesh);
    }
}

/* On fitted elements that have moved and grown with the edges a half-plane keeps matrix and LU: the
 * solution is that of elements that have their own. */
TEST(a_stretched_contact_is_that_of_its_elements)
{
    static const char *const rows[] = {"creep-ratio 0.4", "young-b 1e5 poisson-b 0.3 creep -1e-3",
                                       "young-b 1e5 poisson-b 0.3 force-ratio 0.5",
                                       "similar creep-ratio 0.6"};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_rolling_case rc =
            with(half_plane(RB_STEADY, 60), "half-width 1 mesh fitted %s", rows[k]);
        OWNED(rb_rolling_model) one = solved_model(&rc), own;
        const rb_rolling_span span = {.from = 0.93 * one.mesh.ends[6],
                                      .to = 0.95 * one.mesh.ends[one.mesh.n - 6]};
        rb_rolling_mesh mesh[2];
        double scale, along;
        for (int i = 0; i < 2; i++)
            CHECK_OK(rb_rolling_mesh_spans(&rc, 60, 1, &span, &mesh[i], &message));
        assert_int_equal(mesh[0].n, one.mesh.n);
        /* without an edge in sight, so that many elements are in contact */
        CHECK_OK(rb_rolling_model_begin(&rc, NULL, &own, &message));
        const rb_contact_operator *op = one.problem.op;
        CHECK_STATUS(rb_rolling_model_build(&one, &mesh[0], &message), RB_ZONE);
        assert_ptr_equal(one.problem.op, op);
        assert_int_equal(one.state.solver, RB_SOLVER_NEWTON);
        CHECK_STATUS(rb_rolling_model_build(&own, &mesh[1], &message), RB_ZONE);
        CHECK_MAX(largest_difference(&one.bodies, &own.bodies), 1e-12, "row %zu", k);
        const rb_contact_state *a = &one.state, *b = &own.state;
        CHECK_REL(a->delta, b->delta, 1e-10, "row %zu: approach", k);
        CHECK_ABS(a->xi, b->xi, 1e-10 * 1e-2, "row %zu: creepage", k);
        for (int i = 0; i < a->n; i++) {
            CHECK_ABS(a->p[i], b->p[i], 1e-9 * one.problem.stress, "row %zu: pressure %d", k, i);
            CHECK_ABS(a->q[i], b->q[i], 1e-9 * one.problem.stress, "row %zu: friction %d", k, i);
        }
        /* other lengths are not a stretched mesh, and a layer is no half-plane */
        own.mesh.ends[3] += 1e-6;
        assert_false(
            rb_rolling_bodies_stretch(&rc, &one.mesh, &own.mesh, &one.bodies, &scale, &along));
        own.mesh.ends[3] -= 1e-6;
        rc.a.layer = 1.0;
        assert_false(
            rb_rolling_bodies_stretch(&rc, &one.mesh, &own.mesh, &one.bodies, &scale, &along));
    }
}

RUN_TESTS(NULL, NULL)
