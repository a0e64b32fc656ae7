/* Tables of the gap whose patches lie where no element stands: they are found, fitted,
 * refused where they cannot be. */
#include "cases.h"
#include "bumps.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* ---- Fitted ------------------------------------------------------------------------ */

/* Each patch carries Hertz's pressure of its load on elements of its own. */
TEST(elements_are_fitted_to_every_patch)
{
    static const double x[] = {-6.0, 0.0, 6.0}, height[] = {0.0, 1e-4, 5e-4};
    held_table *t = bumps(3, x, height);
    set(&t->rc, "mesh fitted mu 0");
    OWNED(rb_rolling_solution) s = solved(&t->rc);
    assert_int_equal(s.patches, 3);
    assert_int_equal(s.equal_instead, 0);
    for (int k = 0; k < 3; k++) {
        const double a = 0.5 * (s.patch[k].to - s.patch[k].from);
        CHECK_REL(s.patch[k].normal_load, M_PI * 94500.0 / 0.99 * a * a / (4.0 * 10.0), 0.02,
                  "patch %d", k);
        CHECK_ABS(s.patch[k].peak, x[k], 0.02, "patch %d", k);
    }
    assert_true(s.patch[0].normal_load > s.patch[1].normal_load &&
                s.patch[1].normal_load > s.patch[2].normal_load);
}

/* More patches than elements are fitted to: equal ones instead, and it is said. */
TEST(too_many_patches_have_equal_elements)
{
    double x[17], height[17] = {0.0};
    for (int k = 0; k < 17; k++)
        x[k] = 1.0 * (k - 8);
    held_table *t = bumps(17, x, height);
    set(&t->rc, "mesh fitted load 60 contact-elements 100");
    OWNED(rb_rolling_solution) s = solved(&t->rc);
    assert_int_equal(s.patches, 17);
    assert_int_equal(s.equal_instead, 1);
    CHECK_REL(s.h[0], s.h[s.n - 1], 1e-9, "equal elements");
}

/* Aligned elements have two edges: of one patch. */
TEST(several_patches_cannot_be_aligned)
{
    static const double x[] = {-2.0, 2.0}, height[] = {0.0, 0.0};
    held_table *t = bumps(2, x, height);
    OWNED(rb_rolling_solution) s;
    t->rc.mesh = RB_MESH_ALIGNED;
    CHECK_SAYS(rb_rolling_solve(&t->rc, &s, &message), RB_EINVAL,
               "the contact has several patches");
}

/* Patches that nearly touch are fitted as one; with equal elements they are the same. */
TEST(patches_side_by_side_are_fitted_as_one)
{
    static const double x[] = {-0.35, 0.35}, height[] = {0.0, 0.0};
    held_table *t = bumps(2, x, height);
    t->rc.mu = 0.0;
    for (int k = 0; k < 12; k++) {
        set(&t->rc, "load %g mesh fitted contact-elements 40", 1300.0 + 80.0 * k);
        OWNED(rb_rolling_solution) s = solved(&t->rc);
        set(&t->rc, "mesh uniform contact-elements 200");
        OWNED(rb_rolling_solution) fine = solved(&t->rc);
        CHECK_REL(s.normal_load, t->rc.load, 1e-9, "load %d", k);
        CHECK_MAX(s.residual, 1e-10, "residual %d", k);
        CHECK_ABS(s.contact_from, fine.contact_from, 0.02, "left edge %d", k);
        CHECK_ABS(s.contact_to, fine.contact_to, 0.02, "right edge %d", k);
        CHECK_REL(s.approach, fine.approach, 2e-3, "approach %d", k);
        assert_int_equal(s.equal_instead, 0);
    }
}

/* A groove of a hundredth of the contact does not divide the fitted elements: they reach
 * from one of Hertz's edges to the other. */
TEST(a_narrow_groove_is_fitted_over)
{
    enum { ROWS = 1601 };
    static double x[ROWS], gap[ROWS];
    rb_rolling_case rc = rb_rolling_case_defaults();
    rb_rolling_profile *profile;
    for (int i = 0; i < ROWS; i++) {
        x[i] = 0.002 * (i - ROWS / 2);
        gap[i] = x[i] * x[i] / 100.0 + 0.01 * exp(-pow((x[i] - 0.3) / 0.004, 2.0));
    }
    CHECK_OK(rb_rolling_profile_create(ROWS, x, gap, 0.0, &profile, NULL));
    set(&rc,
        "support halfplane mu 0 formulation static mesh fitted contact-elements 200 load 1800");
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    OWNED(rb_rolling_solution) s = solved(&rc);
    const double a = sqrt(4.0 * 1800.0 * 50.0 * 0.99 / (M_PI * 94500.0));
    assert_int_equal(s.patches, 2);
    assert_int_equal(s.equal_instead, 0);
    CHECK_REL(-s.contact_from, a, 2e-3, "left edge");
    CHECK_REL(s.contact_to, a, 2e-3, "right edge");
    rb_rolling_profile_free(profile);
}

/* A table and its mirror image, shifted the other way, have mirrored contacts, whatever
 * elements are taken and wherever the patches are. */
TEST(mirrored_tables_have_mirrored_contacts)
{
    static const struct {
        int n;
        double x[3], height[3], load;
    } tables[] = {{1, {0.7}, {0.0}, 200.0},
                  {2, {-0.4, 0.35}, {0.0, 2e-4}, 900.0},
                  {2, {-5.0, 2.0}, {0.0, 1e-3}, 300.0},
                  {3, {-6.0, 0.3, 5.0}, {2e-4, 0.0, 5e-4}, 500.0}};
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++)
        for (int fitted = 0; fitted < 2; fitted++) {
            rb_rolling_solution s[2];
            for (int side = 0; side < 2; side++) {
                double x[3], height[3];
                const int n = tables[k].n;
                for (int i = 0; i < n; i++) {
                    x[i] = side ? -tables[k].x[n - 1 - i] : tables[k].x[i];
                    height[i] = tables[k].height[side ? n - 1 - i : i];
                }
                held_table *t = bumps(n, x, height);
                set(&t->rc,
                    "mesh %s load %g poisson 0.2 formulation static creep nan "
                    "creep-ratio nan shift %g contact-elements 48",
                    fitted ? "fitted" : "uniform", tables[k].load, side ? -2e-4 : 2e-4);
                s[side] = solved(&t->rc);
            }
            const double p0 = s[0].max_pressure;
            const int n = s[0].n, patches = s[0].patches;
            assert_int_equal(s[1].n, n);
            assert_int_equal(s[1].patches, patches);
            assert_int_equal(s[1].equal_instead, s[0].equal_instead);
            for (int i = 0; i < n; i++) {
                const int j = n - 1 - i;
                CHECK_ABS(s[1].x[j], -s[0].x[i], 1e-7, "%d %d: x of %d", (int)k, fitted, i);
                CHECK_ABS(s[1].p[j], s[0].p[i], 1e-5 * p0, "%d %d: p of %d", (int)k, fitted, i);
                CHECK_ABS(s[1].q[j], -s[0].q[i], 1e-5 * p0, "%d %d: q of %d", (int)k, fitted, i);
            }
            CHECK_ABS(s[1].contact_from, -s[0].contact_to, 1e-6, "left end");
            CHECK_ABS(s[1].stick_from, -s[0].stick_to, 1e-6, "stick");
            for (int i = 0; i < patches; i++) {
                const rb_rolling_patch *a = &s[0].patch[i], *b = &s[1].patch[patches - 1 - i];
                CHECK_ABS(b->from, -a->to, 1e-6, "patch %d", i);
                CHECK_ABS(b->peak, -a->peak, 1e-6, "its peak, %d", i);
                CHECK_REL(b->normal_load, a->normal_load, 1e-6, "its load, %d", i);
            }
            rb_rolling_solution_free(&s[0]);
            rb_rolling_solution_free(&s[1]);
        }
}

/* ---- Zones ------------------------------------------------------------------------- */

/* A zone that is too narrow is refused with the width that would do. */
TEST(a_narrow_zone_is_told_its_width)
{
    rb_rolling_case rc = rolling_case("support halfplane half-width 1 zone 0.8");
    rb_rolling_solution s;
    double wide = 0.0, given = 0.0;
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_ZONE);
    rb_rolling_solution_free(&s);
    const char *at = NOT_NULL(strstr(message.text, "half-width "));
    assert_int_equal(sscanf(at, "half-width %lg mm; widen it to %lg", &given, &wide), 2);
    CHECK_ABS(given, 0.8, 1e-12, "the given one");
    assert_true(wide > 1.05 && wide < 2.0);
    rc.zone = wide;
    s = solved(&rc);
    CHECK_ABS(s.half_width, 1.0, 0.05, "the contact");
    rb_rolling_solution_free(&s);
}

/* The width that would do is that of the side that reaches further. */
TEST(a_zone_is_as_wide_as_its_longer_side)
{
    static const double height[] = {0.0, 1e-4};
    for (int side = -1; side < 2; side += 2) {
        const double near = -1.0 * side, far = 3.0 * side;
        const double x[] = {fmin(near, far), fmax(near, far)};
        held_table *t = bumps(2, x, height);
        double given = 0.0, wide = 0.0;
        rb_rolling_solution s = solved(&t->rc);
        const double from = s.x[0] - 0.5 * s.h[0];
        const double to = s.x[s.n - 1] + 0.5 * s.h[s.n - 1];
        rb_rolling_solution_free(&s);
        t->rc.zone = 0.5;
        CHECK_STATUS(rb_rolling_solve(&t->rc, &s, &message), RB_ZONE);
        rb_rolling_solution_free(&s);
        const char *at = NOT_NULL(strstr(message.text, "half-width "));
        assert_int_equal(sscanf(at, "half-width %lg mm; widen it to %lg", &given, &wide), 2);
        CHECK_REL(wide, side < 0 ? -from : to, 1e-3, "side %d", side);
        assert_true(wide > 3.0);
    }
}

/* Far from each other and narrow: equal elements would be too many. */
TEST(patches_too_far_apart_need_fitted_elements)
{
    static const double x[] = {-30.0, 30.0}, height[] = {0.0, 0.0};
    held_table *t = bumps(2, x, height);
    OWNED(rb_rolling_solution) s;
    set(&t->rc, "load 1 formulation steady creep-ratio 0.5");
    t->rc.contact.solver = RB_SOLVER_LEMKE; /* not without a matrix */
    CHECK_SAYS(rb_rolling_solve(&t->rc, &s, &message), RB_ZONE, "equal elements would be needed");
}

/* Without a table there is nothing beyond the radius: a soft interface spreads the
 * contact so far. */
TEST(a_contact_as_wide_as_the_wheel_is_refused)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    OWNED(rb_rolling_solution) s;
    set(&rc, "support halfplane mu 0 load 100 interlayer-normal 1e4 contact-elements 20");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_ZONE, "the contact does not end within");
}

/* A given zone and the widest one fail alike: so much more than the given one is said. */
TEST(a_zone_without_an_end_is_told_a_third_more)
{
    static const double x[] = {0.0}, height[] = {0.0};
    held_table *t = bumps(1, x, height);
    OWNED(rb_rolling_solution) s;
    set(&t->rc, "load 1e6 zone 0.5");
    CHECK_SAYS(rb_rolling_solve(&t->rc, &s, &message), RB_ZONE,
               "half-width 0.5 mm; widen it to 0.65 mm");
}

/* What is irregular beyond the wheel is never met. */
TEST(places_beyond_the_wheel_are_not_looked_at)
{
    enum { ROWS = 61 };
    double x[ROWS], y[ROWS] = {0.0};
    for (int i = 0; i < ROWS; i++)
        x[i] = 10.0 * (i - 30);
    y[1] = y[ROWS - 2] = -1.0;
    rb_rolling_case rc = half_plane(RB_TRANSIENT, 16);
    set(&rc, "half-width 0.5 mu 0 creep 1e-3 distance 0.5 zone 0.8");
    OWNED(rb_rolling_solution) even = solved(&rc);
    rc.irregularity = (rb_rolling_table){ROWS, x, y};
    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_int_equal(s.n, even.n);
    for (int i = 0; i < s.n; i++)
        CHECK_ABS(s.p[i], even.p[i], 1e-9 * even.max_pressure, "element %d", i);
}

/* On half-planes products do for so many elements. */
TEST(half_planes_have_elements_for_patches_far_apart)
{
    static const double x[] = {-30.0, 30.0}, height[] = {0.0, 0.0};
    held_table *t = bumps(2, x, height);
    set(&t->rc, "load 1 mu 0");
    OWNED(rb_rolling_solution) s = solved(&t->rc);
    assert_int_equal(s.patches, 2);
    assert_int_equal(s.large, 1);
    CHECK_MAX(3000, s.n, "elements");
    CHECK_REL(s.patch[0].normal_load, 0.5, 1e-3, "half of the load");
}

RUN_TESTS(NULL, NULL)
