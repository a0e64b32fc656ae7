/* The stress on a grid, what it leaves out, and its files. */
#include "cases.h"
#include "check.h"
#include "program/report/report.h"

#include <gsl/gsl_math.h>

static rb_rolling_case pressed(rb_bem_support support)
{
    rb_rolling_case rc = rolling_case("half-width 5 contact-elements 24 outer-elements 40");
    rc.a.support = support;
    return rc;
}

/* Rows follow the surface; every answer is that of the point alone. */
TEST(grid_holds_the_stress_of_its_points)
{
    static const rb_bem_support supports[] = {RB_BEM_HALFPLANE, RB_BEM_ARC};
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case rc = pressed(supports[k]);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_stress_grid) grid;
        assert_int_equal(rb_rolling_model_create(&rc, &model, NULL), RB_OK);
        assert_int_equal(rb_rolling_stress_on_grid(&model, 9, 4, 6.0, &grid, NULL), RB_OK);
        for (int i = 0; i < 36; i++) {
            const rb_rolling_stress *at = &grid.at[i];
            const double xy[] = {at->x, at->y};
            rb_rolling_stress alone;
            CHECK_ABS(at->y - rb_rolling_surface(&rc, at->x), 2.0 * (i / 9), 1e-12, "depth of %d",
                      i);
            assert_true(grid.inside[i]);
            assert_int_equal(rb_rolling_stress_at(&model, 1, xy, &alone, NULL), RB_OK);
            CHECK_ABS(at->von_mises, alone.von_mises, 1e-9 * model.problem.stress, "point %d", i);
        }
    }
}

/* A disc between two opposite forces: two radial fields and a uniform tension, which free its
 * circle of stress (Hertz 1883). */
static rb_rolling_stress of_disc(double P, double D, double x, double y)
{
    const double z = D - y, below = gsl_pow_2(x * x + y * y), above = gsl_pow_2(x * x + z * z);
    const double c = 2.0 * P / M_PI;
    rb_rolling_stress s = {.x = x, .y = y};
    s.sxx = c / D - c * (x * x * y / below + x * x * z / above);
    s.syy = c / D - c * (y * y * y / below + z * z * z / above);
    s.sxy = c * (x * z * z / above - x * y * y / below);
    s.max_shear = hypot(0.5 * (s.sxx - s.syy), s.sxy);
    return s;
}

/* Two discs that touch in .014 R and are held in arcs of .005 R: farther than .3 R from both ends
 * of the diameter they are those of two forces, up to the square of .014/.3. */
TEST(a_whole_disc_is_that_of_two_forces)
{
    const double P = 1000.0, D = 100.0, centre = 4.0 * P / (M_PI * D);
    const rb_rolling_case rc =
        with(rolling_case("similar support arc arc 0.3 poisson 0.5 load 1000 "
                          "mu 0 outer-elements 400"),
             "radius-b 50");
    OWNED(rb_rolling_model) model;
    rb_rolling_mirror *mirror;
    CHECK_OK(rb_rolling_model_create(&rc, &model, &message));
    CHECK_OK(rb_rolling_mirror_create(&model, &mirror, &message));
    for (int of_b = 0; of_b < 2; of_b++) {
        OWNED(rb_rolling_stress_grid) grid;
        int far = 0;
        CHECK_OK(rb_rolling_stress_on_grid(of_b ? &mirror->model : &model, 61, 21, INFINITY, &grid,
                                           &message));
        for (int k = 0; k < 61 * 21; k++) {
            const rb_rolling_stress *got = &grid.at[k], want = of_disc(P, D, got->x, got->y);
            CHECK_MAX(hypot(got->x, got->y - 0.5 * D), 0.5 * D * (1.0 + 1e-12), "on the disc");
            if (fmin(hypot(got->x, got->y), hypot(got->x, got->y - D)) < 15.0)
                continue;
            CHECK_ABS(got->sxx, want.sxx, 0.005 * centre, "sxx at (%g, %g)", got->x, got->y);
            CHECK_ABS(got->syy, want.syy, 0.005 * centre, "syy at (%g, %g)", got->x, got->y);
            CHECK_ABS(got->sxy, want.sxy, 0.005 * centre, "sxy at (%g, %g)", got->x, got->y);
            CHECK_ABS(got->max_shear, want.max_shear, 0.005 * centre, "shear");
            far++;
        }
        CHECK_REL(grid.at[20 * 61].max_shear, centre, 3e-4, "4 P/(pi D) at the centre");
        assert_in_range(far, 900, 1000);
    }
    rb_rolling_mirror_free(mirror);
}

/* From the surface to the hub or the bond, all around; a half-plane has no end. */
TEST(a_whole_wheel_ends_where_its_material_does)
{
    static const struct {
        const char *words;
        double inner; /* radius */
    } wheels[] = {{"support arc outer-elements 40", 0.0},
                  {"support hub hub-ratio 0.4 outer-elements 40", 20.0},
                  {"support hub cover-thickness 8", 42.0}};
    for (size_t k = 0; k < sizeof wheels / sizeof *wheels; k++) {
        const rb_rolling_case rc =
            with(rolling_case("half-width 5 contact-elements 24"), "%s", wheels[k].words);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_stress_grid) grid;
        int outside = 0;
        CHECK_OK(rb_rolling_model_create(&rc, &model, &message));
        CHECK_OK(rb_rolling_stress_on_grid(&model, 33, 9, INFINITY, &grid, &message));
        for (int i = 0; i < 33 * 9; i++)
            outside += !grid.inside[i] || isnan(grid.at[i].sxx);
        assert_int_equal(outside, 0); /* corners of the polygon included */
        CHECK_ABS(grid.at[16].y, 0.0, 1e-12, "below the contact");
        CHECK_ABS(grid.at[16].x, 0.0, 1e-12, "in the middle of the row");
        CHECK_REL(grid.at[0].y, 100.0, 1e-12, "opposite it");
        for (int i = 0; i < 33; i++)
            CHECK_ABS(hypot(grid.at[8 * 33 + i].x, grid.at[8 * 33 + i].y - 50.0), wheels[k].inner,
                      1e-9, "inner circle");
    }
    const rb_rolling_case rc = pressed(RB_BEM_HALFPLANE);
    OWNED(rb_rolling_model) model;
    rb_rolling_stress_grid grid;
    CHECK_OK(rb_rolling_model_create(&rc, &model, &message));
    CHECK_SAYS(rb_rolling_stress_on_grid(&model, 9, 4, INFINITY, &grid, &message), RB_EINVAL,
               "a half-plane has no end");
}

/* rb_rolling_inside says where rb_rolling_stress_at has an answer. */
TEST(inside_is_where_there_is_stress)
{
    const rb_rolling_case rc = pressed(RB_BEM_HUB);
    OWNED(rb_rolling_model) model;
    int count = 0;
    assert_int_equal(rb_rolling_model_create(&rc, &model, NULL), RB_OK);
    for (int k = 0; k < 400; k++) {
        const double xy[] = {-57.0 + 6.03 * (k % 20), -7.0 + 6.07 * (k / 20)};
        int inside;
        rb_rolling_stress s;
        assert_int_equal(rb_rolling_inside(&model, 1, xy, &inside), RB_OK);
        const rb_status status = rb_rolling_stress_at(&model, 1, xy, &s, NULL);
        assert_int_equal(status, inside ? RB_OK : RB_EINVAL);
        count += inside;
    }
    /* area of the ring over that of a cell */
    CHECK_REL(count, M_PI * (50.0 * 50.0 - 15.0 * 15.0) / (6.03 * 6.07), 0.05, "count");
}

/* A roof of pressure and friction against a thousand constant strips. */
TEST(linear_tractions_are_the_limit_of_strips)
{
    enum { STRIPS = 2000 };
    static const double nodes[] = {-1.0, 0.25, 1.0}, p[] = {0.0, 1.0, 0.0}, q[] = {0.0, -0.3, 0.0};
    static const double xy[] = {0.0, 0.5, 0.9, 0.1, -2.0, 0.3, 0.2, 3.0};
    static double ends[STRIPS + 1], ps[STRIPS], qs[STRIPS];
    double linear[12], strips[12];
    for (int i = 0; i <= STRIPS; i++)
        ends[i] = -1.0 + 2.0 * i / STRIPS;
    for (int i = 0; i < STRIPS; i++) {
        const double x = 0.5 * (ends[i] + ends[i + 1]);
        ps[i] = x < 0.25 ? (x + 1.0) / 1.25 : (1.0 - x) / 0.75;
        qs[i] = -0.3 * ps[i];
    }
    assert_int_equal(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){3, nodes, p, q},
                                                    (rb_bem_points){4, xy}, linear),
                     RB_OK);
    assert_int_equal(rb_bem_halfplane_stress(&(rb_bem_edge_load){STRIPS, ends, ps, qs},
                                             (rb_bem_points){4, xy}, strips),
                     RB_OK);
    for (int c = 0; c < 12; c++)
        CHECK_ABS(linear[c], strips[c], 1e-6, "component %d", c);
}

/* Sliding: sxx = 2 mu p0 at the edge that is pulled, and -p - 2 mu p0 x/a between. */
TEST(sliding_pulls_at_the_edge)
{
    enum { N = 401 };
    static double x[N], p[N], q[N], xy[2 * N], s[3 * N];
    for (int j = 0; j < N; j++) {
        x[j] = -cos(M_PI * j / (N - 1));
        p[j] = j == 0 || j == N - 1 ? 0.0 : sqrt(1.0 - x[j] * x[j]);
        q[j] = -0.3 * p[j];
        xy[2 * j] = x[j];
    }
    assert_int_equal(
        rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){N, x, p, q}, (rb_bem_points){N, xy}, s),
        RB_OK);
    for (int j = 0; j < N; j++) {
        CHECK_ABS(s[3 * j], -p[j] + 0.6 * x[j], 5e-3, "sxx at %g", x[j]);
        CHECK_ABS(s[3 * j + 1], -p[j], 1e-10, "syy at %g", x[j]);
        CHECK_ABS(s[3 * j + 2], -q[j], 1e-10, "sxy at %g", x[j]);
    }
}

TEST(bad_linear_tractions_are_refused)
{
    const double nodes[] = {0.0, 1.0}, back[] = {1.0, 0.0}, none[] = {0.0, 0.0},
                 above[] = {0.0, -1.0}, xy[] = {0.0, 1.0};
    double s[3];
    assert_int_equal(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){1, nodes, none, none},
                                                    (rb_bem_points){1, xy}, s),
                     RB_EINVAL);
    assert_int_equal(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){2, back, none, none},
                                                    (rb_bem_points){1, xy}, s),
                     RB_EINVAL);
    assert_int_equal(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){2, nodes, none, none},
                                                    (rb_bem_points){1, above}, s),
                     RB_EINVAL);
    alloc_fail_after(0);
    const rb_status status = rb_bem_halfplane_stress_linear(
        &(rb_bem_edge_load){2, nodes, none, none}, (rb_bem_points){1, xy}, s);
    alloc_succeed();
    assert_int_equal(status, RB_ENOMEM);
}

TEST(bad_grids_are_refused)
{
    const rb_rolling_case rc = pressed(RB_BEM_HALFPLANE);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_stress_grid) grid;
    rb_message why = {.text = ""};
    assert_int_equal(rb_rolling_model_create(&rc, &model, NULL), RB_OK);
    assert_int_equal(rb_rolling_stress_on_grid(&model, 1, 4, 0.0, &grid, &why), RB_EINVAL);
    assert_non_null(strstr(why.text, "got 1 x 4"));
    assert_int_equal(rb_rolling_stress_on_grid(&model, 1 << 20, 1 << 20, 0.0, &grid, NULL),
                     RB_EINVAL);
}

/* Grid and maxima, then the ParaView file, on each failing allocation. */
TEST(stress_without_memory)
{
    const rb_rolling_case rc = pressed(RB_BEM_HUB);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) solution;
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    int refused = 1, refusals = 0;
    assert_int_equal(rb_rolling_solve_model(&rc, &model, &solution, NULL), RB_OK);
    for (int k = 0; refused; k++) {
        OWNED(rb_rolling_stress_grid) grid = {0};
        FILE *file = NOT_NULL(fopen("/dev/null", "w"));
        alloc_fail_after(k);
        rb_status s = rb_rolling_stress_on_grid(&model, 6, 4, 0.0, &grid, NULL);
        const rb_report_stress stress = {.nx = 6,
                                         .ny = 4,
                                         .n = 24,
                                         .at = grid.at,
                                         .inside = grid.inside,
                                         .maxima = &maxima,
                                         .rc = &rc,
                                         .s = &solution};
        if (s == RB_OK)
            s = rb_report_vtk(file, RB_REPORT_VTU, &stress);
        refused = alloc_failed();
        alloc_succeed();
        refusals += refused;
        assert_int_equal(s, refused ? RB_ENOMEM : RB_OK);
        fclose(file);
    }
    assert_true(refusals > 10);
}

TEST(full_disc_is_told)
{
    const rb_rolling_case rc = pressed(RB_BEM_HALFPLANE);
    static const rb_rolling_stress at[4];
    rb_rolling_solution solution = {.max_pressure = 1.0};
    static const rb_rolling_stress_maxima maxima;
    const rb_report_stress stress = {
        .n = 4, .at = at, .maxima = &maxima, .rc = &rc, .s = &solution};
    static const rb_report_style style = {.bare = 0};
    FILE *full = fopen("/dev/full", "w");
    if (!full)
        skip();
    assert_int_equal(rb_report_stress_table(full, &stress, NULL, "x", &style), RB_EWRITE);
    fclose(full);
    full = fopen("/dev/full", "w");
    assert_int_equal(rb_report_vtk(full, RB_REPORT_VTU, &stress), RB_EWRITE);
    fclose(full);
}

RUN_TESTS(NULL, NULL)
