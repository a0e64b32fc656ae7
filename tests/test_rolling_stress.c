/* Stress below a contact: its parts, closed forms on the axis and far away, maxima and
 * where they are looked for. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static rb_rolling_case hertz(int elements)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);
    set(&rc, "poisson 0.3 mu 0 gap parabola half-width 1");
    return rc;
}

static rb_rolling_stress at(const rb_rolling_model *model, double x, double y)
{
    const double xy[2] = {x, y};
    rb_rolling_stress s;
    CHECK_OK(rb_rolling_stress_at(model, 1, xy, &s, NULL));
    return s;
}

/* Everything follows from sxx, syy, sxy in plane strain. */
static void check_parts(const rb_rolling_stress *s, double nu)
{
    const double mean = 0.5 * (s->sxx + s->syy), szz = nu * (s->sxx + s->syy);
    const double radius = sqrt(gsl_pow_2(0.5 * (s->sxx - s->syy)) + gsl_pow_2(s->sxy));
    const double small = 1e-12 * (fabs(mean) + radius);
    CHECK_ABS(s->szz, szz, small, "szz");
    CHECK_ABS(s->principal_1, mean + radius, small, "larger");
    CHECK_ABS(s->principal_2, mean - radius, small, "smaller");
    CHECK_ABS(s->max_shear, radius, small, "Tresca");
    CHECK_ABS(s->hydrostatic, (s->sxx + s->syy + szz) / 3.0, small, "mean of three");
    const double a = s->principal_1, b = s->principal_2;
    CHECK_ABS(s->von_mises, sqrt(a * a + b * b + szz * szz - a * b - b * szz - szz * a), small,
              "Mises");
}

/* McEwen on the axis: sxx = -p0 [(1 + 2 y^2)/sqrt(1 + y^2) - 2 y], syy = -p0/sqrt(1+y^2). */
TEST(the_axis_has_its_closed_form)
{
    const rb_rolling_case rc = hertz(200);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double p0 = rb_rolling_derive(&rc).stress;
    for (int k = 1; k <= 8; k++) {
        const double y = 0.25 * k, root = sqrt(1.0 + y * y);
        const rb_rolling_stress s = at(&model, 0.0, y);
        CHECK_ABS(s.sxx, -p0 * ((1.0 + 2.0 * y * y) / root - 2.0 * y), 2e-3 * p0, "sxx at %g", y);
        CHECK_ABS(s.syy, -p0 / root, 2e-3 * p0, "syy at %g", y);
        CHECK_ABS(s.sxy, 0.0, 1e-9 * p0, "sxy at %g", y);
        check_parts(&s, 0.3);
        const rb_rolling_stress off = at(&model, 0.3 * k, y);
        check_parts(&off, 0.3);
    }
}

/* Flamant's point load from far away: srr = -2 P cos(angle)/(pi r), on either side of the
 * distance where strips of constant traction take over. */
TEST(far_away_it_is_a_point_load)
{
    const rb_rolling_case rc = hertz(60);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double P = rb_rolling_derive(&rc).load;
    const double width = model.mesh.ends[60] - model.mesh.ends[0];
    for (double far = 15.0; far < 1e7; far *= far < 100.0 ? 1.3 : 30.0) {
        const double r = far * width, x = 0.6 * r, y = 0.8 * r;
        const double radial = -2.0 * P * 0.8 / (M_PI * r);
        const rb_rolling_stress s = at(&model, x, y);
        CHECK_ABS(s.sxx, radial * 0.36, 1e-2 / far / far * -radial * 20.0, "sxx %g", far);
        CHECK_ABS(s.syy, radial * 0.64, 1e-2 / far / far * -radial * 20.0, "syy %g", far);
        CHECK_ABS(s.sxy, radial * 0.48, 1e-2 / far / far * -radial * 20.0, "sxy %g", far);
    }
    /* and up to where numbers end, alone and among many */
    for (int many = 0; many < 2; many++)
        for (double r = 1e6; r < 1e302; r *= 1e5) {
            enum { MANY = 60 };
            double xy[2 * MANY];
            rb_rolling_stress s[MANY];
            for (int k = 0; k < MANY; k++) {
                xy[2 * k] = 0.6 * r;
                xy[2 * k + 1] = 0.8 * r;
            }
            CHECK_OK(rb_rolling_stress_at(&model, many ? MANY : 1, xy, s, NULL));
            const double radial = -2.0 * P * 0.8 / (M_PI * r), nu = rc.a.poisson;
            CHECK_REL(s->sxx, radial * 0.36, 1e-12, "sxx %g", r);
            CHECK_REL(s->syy, radial * 0.64, 1e-12, "syy %g", r);
            CHECK_REL(s->sxy, radial * 0.48, 1e-12, "sxy %g", r);
            CHECK_REL(s->max_shear, -0.5 * radial, 1e-12, "max_shear %g", r);
            CHECK_REL(s->von_mises, -radial * sqrt(1.0 - nu + nu * nu), 1e-12, "von_mises %g", r);
        }
    /* near and far ones in one list as each by itself */
    const double xy[] = {0.1, 0.2, 40.0 * width, 1.0, -0.3, 0.5, 3.0, 90.0 * width};
    rb_rolling_stress all[4];
    CHECK_OK(rb_rolling_stress_at(&model, 4, xy, all, NULL));
    for (int k = 0; k < 4; k++) {
        const rb_rolling_stress s = at(&model, xy[2 * k], xy[2 * k + 1]);
        CHECK_ABS(all[k].sxx, s.sxx, 0.0, "sxx of point %d", k);
        CHECK_ABS(all[k].syy, s.syy, 0.0, "syy of point %d", k);
        CHECK_ABS(all[k].sxy, s.sxy, 0.0, "sxy of point %d", k);
    }
}

TEST(places_outside_are_named)
{
    const double xy[] = {0.0, 0.0, 0.1, 0.2, 0.3, -1e-9};
    rb_rolling_stress s[3];
    const rb_rolling_case rc = hertz(20);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    int inside[3];
    CHECK_SAYS(rb_rolling_stress_at(&model, 0, xy, s, &message), RB_EINVAL, "0 points");
    CHECK_OK(rb_rolling_stress_at(&model, 2, xy, s, &message));
    CHECK_SAYS(rb_rolling_stress_at(&model, 3, xy, s, &message), RB_EINVAL,
               "point 2 at (0.3, -1e-09)");
    CHECK_OK(rb_rolling_inside(&model, 3, xy, inside));
    assert_true(inside[0] && inside[1] && !inside[2]);
    CHECK_ABS(rb_rolling_surface(&rc, 0.4), 0.0, 0.0, "flat");
}

/* p0: 0.300 at 0.786 a; Mises of nu = 0.3: 0.558 at 0.704 a; sxy: 1/4 at 0.866 a, a/2; no
 * tension but rounding.  A depth that ends before them ends the search. */
TEST(maxima_are_hertzs)
{
    const rb_rolling_case rc = hertz(100);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    const double p0 = rb_rolling_derive(&rc).stress;
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
    CHECK_REL(m.max_shear.value, 0.30028 * p0, 1e-3, "Tresca");
    CHECK_ABS(m.max_shear.y, 0.7861, 5e-3, "its depth");
    CHECK_ABS(m.max_shear.x, 0.0, 5e-3, "its place");
    CHECK_REL(m.von_mises.value, 0.5577 * p0, 2e-3, "Mises");
    CHECK_ABS(m.von_mises.y, 0.704, 1e-2, "its depth");
    CHECK_REL(m.orthogonal_shear.value, 0.25 * p0, 2e-3, "sxy");
    CHECK_ABS(fabs(m.orthogonal_shear.x), 0.866, 1e-2, "its place");
    CHECK_ABS(m.orthogonal_shear.y, 0.5, 1e-2, "its depth");
    CHECK_ABS(m.tension.value, 0.0, 2e-2 * p0, "no tension");
    const rb_rolling_stress s = at(&model, m.von_mises.x, m.von_mises.y);
    CHECK_REL(s.von_mises, m.von_mises.value, 1e-12, "the stress there");
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.3, &m, NULL));
    CHECK_ABS(m.max_shear.y, 0.3, 1e-6, "the deepest place that is looked at");
    CHECK_ABS(m.von_mises.y, 0.3, 1e-6, "the deepest place that is looked at");
    assert_true(m.orthogonal_shear.y <= 0.3 + 1e-12);
}

/* Stuck under large friction, elements graded: sxx has a sharp peak behind each edge. */
static rb_rolling_case stuck(void)
{
    rb_rolling_case rc = hertz(31);
    set(&rc, "mu 3 support-b halfplane radius-b %g young-b %g mesh fitted", 0.5 * rc.a.radius,
        0.05 * rc.a.young);
    return rc;
}

/* Of several peaks the highest, on its top: no point of a fine row has more.  Mirror
 * images have the same. */
TEST(the_highest_of_several_peaks_is_found)
{
    const rb_rolling_case rc = stuck();
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_rolling_stress_maxima m, again; /* of one material: no bonds */
    double tension = 0.0, mises = 0.0;
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
    for (int k = -1200; k <= 1200; k++) {
        const rb_rolling_stress s = at(&model, 1e-3 * k, 0.0);
        tension = fmax(tension, s.principal_1);
        mises = fmax(mises, s.von_mises);
    }
    assert_true(m.tension.value >= tension);
    assert_true(m.von_mises.value >= mises);
    CHECK_REL(m.tension.value, tension, 1e-3, "not far above the row");
    again = m;
    again.max_shear.value = again.tension.value = NAN;
    again.tension.x = -m.tension.x;
    CHECK_OK(rb_rolling_stress_maxima_at(&model, &again, NULL));
    CHECK_REL(again.tension.value, m.tension.value, 1e-6, "the mirror image");
    CHECK_REL(again.max_shear.value, m.max_shear.value, 1e-12, "at its own place");
    again.orthogonal_shear.y = -0.1;
    CHECK_STATUS(rb_rolling_stress_maxima_at(&model, &again, NULL), RB_EINVAL);
}

/* At the ends of a wheel's elements, which are its corners, as next to them. */
TEST(ends_of_elements_are_not_seen)
{
    rb_rolling_case rc = hertz(24);
    set(&rc, "support hub outer-elements 40 mesh fitted mu 0.3 formulation steady creep 2e-3");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const rb_bem_mesh *mesh = rb_bem_system_mesh(model.bodies.system_a);
    const double p0 = rb_rolling_derive(&rc).stress;
    for (int c = 1; c < mesh->contact_n; c++) {
        const int j = mesh->contact_first + c;
        const double x = mesh->x0[j], step = 1e-3 * (mesh->x1[j] - x);
        const double there = at(&model, x, mesh->y0[j]).sxx;
        for (int side = -1; side <= 1; side += 2) {
            const double near = x + side * step;
            const double next = at(&model, near, rb_rolling_surface(&rc, near)).sxx;
            CHECK_ABS(there, next, 5e-3 * p0, "end %d", c);
        }
    }
}

/* A half-width beyond either edge, evenly down to 2.5 half-widths. */
TEST(a_grid_lies_under_the_contact)
{
    const rb_rolling_case rc = hertz(60);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_rolling_stress_grid grid;
    double from, to;
    rb_rolling_contact_edges(model.rc, &model.mesh, &model.state, &from, &to);
    CHECK_OK(rb_rolling_stress_on_grid(&model, 5, 3, 0.0, &grid, NULL));
    const double a = 0.5 * (to - from);
    for (int k = 0; k < 15; k++) {
        CHECK_ABS(grid.at[k].x, from - a + 4.0 * a * (k % 5) / 4.0, 1e-12, "x of %d", k);
        CHECK_ABS(grid.at[k].y, 2.5 * a * (k / 5) / 2.0, 1e-12, "y of %d", k);
        assert_int_equal(grid.inside[k], 1);
        const rb_rolling_stress s = at(&model, grid.at[k].x, grid.at[k].y);
        CHECK_ABS(grid.at[k].sxx, s.sxx, 1e-12 * fabs(s.sxx), "sxx of %d", k);
    }
    rb_rolling_stress_grid_free(&grid);
    CHECK_OK(rb_rolling_stress_on_grid(&model, 2, 2, 0.7, &grid, NULL));
    CHECK_ABS(grid.at[3].y, 0.7, 1e-15, "the given depth");
    rb_rolling_stress_grid_free(&grid);
    assert_null(grid.at);
    for (int k = 0; k < 3; k++) {
        const int nx = k == 0 ? 1 : k == 1 ? 2 : 20000, ny = k == 1 ? 1 : 20000;
        CHECK_SAYS(rb_rolling_stress_on_grid(&model, nx, ny, 0.0, &grid, &message), RB_EINVAL,
                   "grid: expected 2 x 2");
        assert_null(grid.at);
    }
    memset(model.state.zone, 0, sizeof(int) * 60);
    CHECK_STATUS(rb_rolling_stress_on_grid(&model, 2, 2, 0.0, &grid, &message), RB_NO_CONTACT);
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    rb_rolling_shakedown limit;
    CHECK_STATUS(rb_rolling_stress_maxima_find(&model, 0.0, &m, &message), RB_NO_CONTACT);
    CHECK_SAYS(rb_rolling_shakedown_find(&model, &limit, &message), RB_NO_CONTACT,
               "no contact, no stress");
}

/* The wheel is a polygon: between it and its circle there is stress, outside the circle
 * and in the hub there is none. */
TEST(a_wheel_has_stress_up_to_its_circle)
{
    rb_rolling_case rc = with(hertz(16), "support hub outer-elements 40");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const rb_bem_mesh *mesh = rb_bem_system_mesh(model.bodies.system_a);
    rb_rolling_stress s;
    int inside, chords = 0;
    for (int j = 0; j < mesh->n; j++) {
        const double mx = 0.5 * (mesh->x0[j] + mesh->x1[j]);
        const double my = 0.5 * (mesh->y0[j] + mesh->y1[j]);
        const double circle = rb_rolling_surface(&rc, mx);
        if (fabs(mx) > 20.0 || my > 10.0 || !(mesh->x0[j] < mesh->x1[j]))
            continue;
        assert_true(circle < my);
        chords++;
        for (int k = 0; k < 2; k++) {
            const double xy[2] = {mx, k ? circle : circle - 0.2 * (mesh->x1[j] - mesh->x0[j])};
            CHECK_OK(rb_rolling_inside(&model, 1, xy, &inside));
            assert_int_equal(inside, k);
            assert_int_equal(rb_rolling_stress_at(&model, 1, xy, &s, &message),
                             k ? RB_OK : RB_EINVAL);
        }
    }
    assert_true(chords > 16);
    const double hub[] = {0.0, 50.0}, deep[] = {0.0, 30.0}, above[] = {0.0, 101.0};
    CHECK_OK(rb_rolling_inside(&model, 1, hub, &inside));
    assert_int_equal(inside, 0);
    CHECK_OK(rb_rolling_inside(&model, 1, above, &inside));
    assert_int_equal(inside, 0);
    CHECK_OK(rb_rolling_inside(&model, 1, deep, &inside));
    assert_int_equal(inside, 1);
}

/* Where normals are those of the rim and nothing rubs, the rim carries no shear along itself,
 * however steep it is against the ground; just below it there is what the depth makes of p'. */
TEST(a_rim_that_does_not_rub_carries_no_shear)
{
    const rb_rolling_case rc =
        with(hertz(40), "support hub radius 100 half-width 15 normals surface gap exact");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double p0 = rb_rolling_peak_pressure(&model), depth = 0.02;
    static const double x[] = {-12.3, -7.1, 5.3, 11.2};
    for (int k = 0; k < 4; k++) {
        const double s = x[k] / 100.0, c = sqrt(1.0 - s * s), r = 100.0 - depth;
        const rb_rolling_stress in = at(&model, r * s, 100.0 - r * c);
        const double shear = s * c * (in.syy - in.sxx) + (c * c - s * s) * in.sxy;
        CHECK_ABS(shear, 0.0, 5e-3 * p0, "x = %g", x[k]);
    }
}

/* A grid that reaches beyond the wheel and into its hub: what is outside is no number. */
TEST(a_wide_grid_stays_on_the_lower_half)
{
    rb_rolling_case rc = with(hertz(16), "support hub outer-elements 40 half-width 25 gap exact");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    OWNED(rb_rolling_stress_grid) grid;
    int outside = 0;
    CHECK_OK(rb_rolling_stress_on_grid(&model, 9, 7, 60.0, &grid, NULL));
    for (int k = 0; k < 63; k++) {
        outside += !grid.inside[k];
        assert_int_equal(isnan(grid.at[k].sxx), !grid.inside[k]);
        assert_int_equal(isnan(grid.at[k].von_mises), !grid.inside[k]);
        assert_true(fabs(grid.at[k].x) <= 45.0 * (1.0 + 1e-12)); /* 0.9 R */
        assert_true(isfinite(grid.at[k].y));
    }
    assert_in_range(outside, 5, 40);
}

/* ---- Shakedown --------------------------------------------------------------------- */

/* Tresca's circle with the residual stress 2 c: at the best depth of Hertz p0/4, whatever
 * the residual stress does for sxx - syy. */
TEST(shakedown_of_a_frictionless_contact_is_sxy)
{
    const rb_rolling_case rc = hertz(80);
    rb_rolling_model model = solved_model(&rc);
    rb_rolling_shakedown limit;
    CHECK_OK(rb_rolling_shakedown_find(&model, &limit, NULL));
    CHECK_REL(limit.shear_yield, 0.25 * rb_rolling_derive(&rc).stress, 3e-3, "p0/4");
    CHECK_ABS(limit.y, 0.5, 2e-2, "depth");
    CHECK_ABS(fabs(limit.x), 0.866, 3e-2, "place");
    const rb_rolling_stress s = at(&model, limit.x, limit.y);
    CHECK_ABS(0.5 * (s.sxx - s.syy) + 0.5 * limit.residual, 0.0, 5e-2 * limit.shear_yield,
              "the residual stress evens the others out");
    CHECK_REL(hypot(0.5 * (s.sxx - s.syy + limit.residual), s.sxy), limit.shear_yield, 1e-9,
              "Mohr's circle there");
    rb_rolling_shakedown again = limit;
    again.shear_yield = NAN;
    CHECK_OK(rb_rolling_shakedown_at(&model, &again, NULL));
    CHECK_REL(again.shear_yield, limit.shear_yield, 1e-12, "again");
    again.y = -1.0;
    CHECK_STATUS(rb_rolling_shakedown_at(&model, &again, NULL), RB_EINVAL);
    rb_rolling_model_free(&model);

    rb_rolling_case wheel = with(hertz(16), "support hub outer-elements 40");
    model = solved_model(&wheel);
    CHECK_SAYS(rb_rolling_shakedown_find(&model, &limit, &message), RB_EINVAL,
               "shakedown: of a half-plane");
    rb_rolling_model_free(&model);
}

/* A grid and the maxima end at a rigid base; points below it are refused, and a residual
 * stress of two materials is not looked for. */
TEST(a_rigid_base_has_no_stress)
{
    rb_rolling_case rc = hertz(16);
    rb_rolling_stress s;
    rb_rolling_stress_grid grid;
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    rb_rolling_shakedown limit;
    rc.a.layer = 0.4 * rc.half_width;
    const double xy[] = {0.0, 1.01 * rc.a.layer};
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_SAYS(rb_rolling_stress_at(&model, 1, xy, &s, &message), RB_EINVAL,
               "lies outside the body");
    CHECK_OK(rb_rolling_stress_on_grid(&model, 3, 3, 0.0, &grid, &message));
    CHECK_REL(grid.at[8].y, rc.a.layer, 1e-12, "the last row lies on the base");
    assert_false(isnan(grid.at[8].sxx));
    rb_rolling_stress_grid_free(&grid);
    CHECK_OK(rb_rolling_stress_on_grid(&model, 3, 3, 2.0 * rc.a.layer, &grid, &message));
    assert_false(isnan(grid.at[5].sxx));
    assert_true(isnan(grid.at[8].sxx));
    rb_rolling_stress_grid_free(&grid);
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 3.0 * rc.a.layer, &m, &message));
    CHECK_MAX(m.max_shear.y, rc.a.layer, "the largest shear lies in the layer");
    CHECK_SAYS(rb_rolling_shakedown_find(&model, &limit, &message), RB_EINVAL,
               "shakedown: of one material");
}

TEST(a_cover_that_relaxes_on_an_elastic_core_is_refused)
{
    rb_rolling_case rc = hertz(16);
    set(&rc, "support hub cover-thickness %g relaxation-time 0.01 relaxation-ratio 1",
        0.1 * rc.a.radius);
    CHECK_OK(rb_rolling_stress_check(&rc, &message));
    rc.a.core_young = 2e5;
    CHECK_SAYS(rb_rolling_stress_check(&rc, &message), RB_EINVAL, "it depends on the past");
    rc.a.memory.n = 0;
    CHECK_OK(rb_rolling_stress_check(&rc, &message));
}

RUN_TESTS(NULL, NULL)
