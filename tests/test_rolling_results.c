/* What follows from a solved model: creep curves, stress, dissipation, error bars. */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"
#include "numbers.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static rb_rolling_case wheel_on_plane(double poisson)
{
    return rolling_case("poisson %g support halfplane gap parabola half-width 0.005 mesh fitted",
                        poisson);
}

static double carter(double s)
{
    return s >= 1.0 ? 1.0 : s * (2.0 - s);
}

TEST(a_creep_curve_is_carters)
{
    rb_rolling_case rc = with(wheel_on_plane(0.5), "contact-elements 100");
    OWNED(rb_rolling_curve) c;
    CHECK_OK(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, -1.2, 1.2, 49, RB_UNITS_MM}, &c, NULL));
    assert_int_equal(c.n, 49);
    for (int k = 0; k < c.n; k++) {
        const double s = c.creep_ratio[k];
        CHECK_ABS(s, -1.2 + 0.05 * k, 1e-12, "point %d", k);
        CHECK_ABS(c.force_ratio[k], -(s < 0 ? -1 : 1) * carter(fabs(s)), 1.5e-4, "s = %g", s);
        CHECK_ABS(c.stick_ratio[k], fmax(0.0, 1.0 - fabs(s)), 0.016, "s = %g", s);
        CHECK_MAX(c.residual[k], 1e-10, "s = %g", s);
    }
    CHECK_ABS(c.free_creepage, 0.0, 1e-15, "free rolling");
}

/* On a cosine mesh elements are not lengths: Carter's stick at s = 0.1 is 0.90 of the
 * contact and 0.80 of the elements. */
TEST(the_stick_ratio_is_one_of_lengths)
{
    rb_rolling_case rc = with(wheel_on_plane(0.5), "contact-elements 100");
    OWNED(rb_rolling_curve) c;
    OWNED(rb_rolling_solution) s;
    CHECK_OK(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.1, 0.1, 1, RB_UNITS_MM}, &c, NULL));
    CHECK_ABS(c.stick_ratio[0], 0.9, 0.01, "s = 0.1");
    set(&rc, "formulation steady creep-ratio 0.1");
    CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
    double stuck = 0.0;
    for (int i = 0; i < s.n; i++)
        stuck += s.zone[i] == RB_ZONE_STICK ? s.h[i] : 0.0;
    CHECK_REL(s.stick_length, stuck, 1e-14, "sum over the table");
    CHECK_REL(s.stick_length, s.stick_to - s.stick_from, 1e-9, "one strip");
}

/* Each point of a curve is what the same case says alone, dissimilar bodies included. */
TEST(a_curve_agrees_with_single_solves)
{
    rb_rolling_case rc = wheel_on_plane(0.3);
    OWNED(rb_rolling_curve) c;
    set(&rc, "mesh uniform zone %g", 1.6 * rc.half_width);
    CHECK_OK(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){1, -2e-4, 2e-4, 9, RB_UNITS_MM}, &c, NULL));
    for (int k = 0; k < c.n; k++) {
        set(&rc, "formulation steady creep %g", c.creepage[k]);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(c.force_ratio[k], s.force_ratio, 1e-10, "xi = %g", c.creepage[k]);
        CHECK_ABS(c.dissipation[k], s.dissipation, 1e-10 * s.normal_load, "xi = %g", c.creepage[k]);
    }
}

TEST(bad_curves_are_refused)
{
    rb_rolling_case rc = wheel_on_plane(0.5);
    rb_rolling_curve c;
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.0, NAN, 5, RB_UNITS_MM}, &c, NULL),
        RB_EINVAL);
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.0, 1.0, 0, RB_UNITS_MM}, &c, NULL),
        RB_EINVAL);
    rc.mu = 0.0;
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){0, 0.0, 1.0, 5, RB_UNITS_MM}, &c, NULL),
        RB_EINVAL);
}

/* ---- Stress ------------------------------------------------------------------------ */

static void check_extremum(const char *name, rb_rolling_extremum got, double value, double x,
                           double y, double p0, double a)
{
    CHECK_REL(got.value, value * p0, 3e-3, "%s, value", name);
    CHECK_ABS(fabs(got.x), x * a, 1e-2 * a, "%s, x", name);
    CHECK_ABS(got.y, y * a, 1e-2 * a, "%s, y", name);
}

TEST(hertz_below_the_surface)
{
    rb_rolling_case rc = with(wheel_on_plane(0.3), "mu 0");
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
    const double a = rc.half_width, p0 = 2.0 * model.problem.load / (M_PI * a);
    check_extremum("max shear", m.max_shear, 0.30028, 0.0, 0.78615, p0, a);
    check_extremum("von Mises", m.von_mises, 0.55752, 0.0, 0.70429, p0, a);
    check_extremum("orthogonal shear", m.orthogonal_shear, 0.25, 0.866, 0.5, p0, a);
}

/* Full sliding, friction on A towards +x (xi < 0). */
TEST(full_sliding_below_the_surface)
{
    rb_rolling_case rc = wheel_on_plane(0.3);
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    set(&rc, "similar mu 0.2 formulation steady creep-ratio -1.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
    const double a = rc.half_width, p0 = 2.0 * model.problem.load / (M_PI * a);
    check_extremum("max shear", m.max_shear, 0.31899, 0.625, 0.601, p0, a);
    assert_true(m.max_shear.x > 0.0);
}

/* The wheel's own boundary elements see the same stress as the half-plane, up to a/R. */
TEST(a_wheel_has_the_stress_of_the_half_plane)
{
    rb_rolling_case rc = wheel_on_plane(0.3);
    OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
    set(&rc, "support hub half-width %g mu 0", 1e-3 * rc.a.radius);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
    const double a = rc.half_width, p0 = 2.0 * model.problem.load / (M_PI * a);
    check_extremum("max shear", m.max_shear, 0.30028, 0.0, 0.78615, p0, a);
    check_extremum("von Mises", m.von_mises, 0.55752, 0.0, 0.70429, p0, a);
}

/* Where friction pulls, at the edge on the very surface, the elements' ends leave no
 * mark. */
TEST(the_pulled_edge_of_a_wheel_is_that_of_the_half_plane)
{
    double tension[2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = wheel_on_plane(0.3);
        OWNED(rb_rolling_stress_maxima) m = {.bonds = 0};
        rc.a.support = k ? RB_BEM_HUB : RB_BEM_HALFPLANE;
        rc.b = rc.a;
        set(&rc, "half-width %g mu 0.2 formulation steady creep-ratio -2", 1e-3 * rc.a.radius);
        rc.elastic_b = 1;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &m, NULL));
        tension[k] = m.tension.value;
    }
    CHECK_REL(tension[1], tension[0], 2e-2, "largest principal stress");
}

/* On y = 0 inside the contact: syy = -p, sxy = -q (A lies above its surface), but in the elements
 * at the edges, whose tractions (B14) replaces. */
TEST(the_surface_carries_the_tractions)
{
    enum { REPLACED = 5 };
    rb_rolling_case rc = with(wheel_on_plane(0.3), "formulation steady creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double *p = model.state.p;
    int counted = 0;
    for (int i = REPLACED; i + REPLACED < model.mesh.n; i++) {
        const double xy[] = {model.bodies.f.x[i], 0.0};
        rb_rolling_stress s;
        CHECK_OK(rb_rolling_stress_at(&model, 1, xy, &s, NULL));
        CHECK_ABS(s.principal_1 + s.principal_2, s.sxx + s.syy, 1e-10 * model.problem.stress,
                  "trace");
        if (!(p[i - REPLACED] > 0.0 && p[i + REPLACED] > 0.0))
            continue;
        counted++;
        CHECK_ABS(s.syy, -p[i], 1e-10 * model.problem.stress, "syy at %d", i);
        CHECK_ABS(s.sxy, -model.state.q[i], 1e-10 * model.problem.stress, "sxy at %d", i);
    }
    assert_true(counted > 0.6 * model.mesh.n);
    const double above[] = {0.0, -1e-3};
    rb_rolling_stress s;
    CHECK_STATUS(rb_rolling_stress_at(&model, 1, above, &s, NULL), RB_EINVAL);
}

/* In these the surface carries Hertz's pressure, which the elements' own means miss. */
TEST(the_edges_of_the_surface_carry_hertz)
{
    rb_rolling_case rc = with(wheel_on_plane(0.3), "similar mu 0 mesh uniform contact-elements 60");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double a = rc.half_width, p0 = 2.0 * model.problem.load / (M_PI * a);
    double field = 0.0, means = 0.0;
    for (int i = 0; i < model.mesh.n; i++) {
        const double x = model.bodies.f.x[i], xy[] = {x, 0.0},
                     hertz = fabs(x) < a ? p0 * sqrt(1.0 - gsl_pow_2(x / a)) : 0.0;
        rb_rolling_stress s;
        CHECK_OK(rb_rolling_stress_at(&model, 1, xy, &s, NULL));
        field = fmax(field, fabs(s.syy + hertz));
        means = fmax(means, fabs(model.state.p[i] - hertz));
    }
    CHECK_MAX(field / p0, 1e-3, "surface of %d elements", model.mesh.n);
    assert_true(field < 0.2 * means);
}

/* Of points outside the body the first is named, on every support by the same number. */
TEST(a_point_outside_has_its_index)
{
    const rb_bem_support supports[] = {RB_BEM_HALFPLANE, RB_BEM_HUB, RB_BEM_ARC};
    const double xy[] = {0.0, 1.0, 0.1, 1.0, 0.0, -1.0, 0.0, -2.0};
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = wheel_on_plane(0.3);
        rb_rolling_stress s[4];
        rc.a.support = supports[k];
        rc.contact_elements = 12;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_STATUS(rb_rolling_stress_at(&model, 4, xy, s, &message), RB_EINVAL);
        if (!strstr(message.text, "point 2 at (0, -1) lies outside the body"))
            fail_msg("support %d: '%s'", k, message.text);
    }
}

/* ---- Dissipation (theory-solvers.md 6) ----------------------------------------------------- */

/* D = -xi Q + (1/R) int x p dx for bodies similar or not. */
TEST(dissipation_is_the_work_of_the_forces)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = wheel_on_plane(k & 1 ? 0.3 : 0.5);
        set(&rc, "contact-elements 200 formulation steady creep-ratio %g", k & 2 ? -0.6 : 0.6);
        OWNED(rb_rolling_solution) s = solved(&rc);
        double moment = 0.0;
        for (int i = 0; i < s.n; i++)
            moment += s.x[i] * s.p[i] * s.h[i];
        const double work = -s.creepage * s.tangential_load + moment / rc.a.radius;
        CHECK_REL(s.dissipation, work, 1e-3, "case %d", k);
    }
}

/* ---- Error bars -------------------------------------------------------------------- */

/* Carter by creepage and by force, Cattaneo by force; Hertz in all of them. */
static void count_random_case(int fitted, tally *t)
{
    rb_rolling_case rc = wheel_on_plane(0.5);
    const int kind = rand() % 3;
    const double s = between(0.05, 0.95);
    OWNED(rb_rolling_solution) so;
    rb_rolling_errors e;

    set(&rc, "mesh %s contact-elements %d", fitted ? "fitted" : "uniform", 40 + rand() % 60);
    if (!fitted)
        rc.zone = rc.half_width * between(1.1, 1.4);
    rc.formulation = kind == 2 ? RB_STATIC : RB_STEADY;
    if (kind == 0)
        rc.creep_ratio = s;
    else
        rc.force_ratio = -s;
    CHECK_OK(rb_rolling_solve_with_errors(&rc, &so, &e, NULL));
    const double a = rc.half_width, p0 = 2.0 * so.normal_load / (M_PI * a);
    tally_count(t, so.max_pressure - p0, e.scalar.max_pressure);
    tally_count(t, so.half_width - a, e.scalar.half_width);
    tally_count(t, so.force_ratio + (kind == 0 ? carter(s) : s), e.scalar.force_ratio);
    if (kind == 1)
        tally_count(t, so.creepage - (1.0 - sqrt(1.0 - s)) * rc.mu * a / rc.a.radius,
                    e.scalar.creepage);
    if (kind == 2)
        tally_count(t, so.stick_to - a * sqrt(1.0 - s), e.scalar.stick_to);
}

TEST(error_bars_hold_the_truth)
{
    srand(3);
    for (int fitted = 0; fitted < 2; fitted++) {
        tally t = {0};
        for (int k = 0; k < 120; k++)
            count_random_case(fitted, &t);
        tally_check(&t, fitted ? "fitted" : "uniform");
    }
}

/* Three times the spread are three errors of a method of first order, nine of one of
 * second order, as on fitted meshes: more where the error changes its sign. */
TEST(error_bars_of_curves_hold_the_truth)
{
    for (int fitted = 0; fitted < 2; fitted++) {
        rb_rolling_case rc = wheel_on_plane(0.5);
        OWNED(rb_rolling_curve) c, e;
        tally t = {.wide = fitted ? 20.0 : 10.0};
        set(&rc, "mesh %s contact-elements 80", fitted ? "fitted" : "uniform");
        CHECK_OK(rb_rolling_curve_with_errors(
            &rc, &(rb_rolling_range){0, 0.03, 0.97, 100, RB_UNITS_MM}, NULL, NULL, &c, &e, NULL));
        assert_int_equal(e.n, 100);
        for (int k = 0; k < c.n; k++)
            tally_count(&t, c.force_ratio[k] + carter(c.creep_ratio[k]), e.force_ratio[k]);
        for (int k = 0; k < c.n; k++)
            CHECK_ABS(c.stick_ratio[k], 1.0 - c.creep_ratio[k], e.stick_ratio[k], "stick at s = %g",
                      c.creep_ratio[k]);
        tally_check(&t, fitted ? "fitted" : "uniform");
    }
}

TEST(refinement_reaches_the_accuracy)
{
    rb_rolling_case rc = with(wheel_on_plane(0.5), "formulation steady creep-ratio 0.4");
    rb_rolling_solution s;
    rb_rolling_errors e;
    int elements = 0;
    CHECK_OK(rb_rolling_solve_to_accuracy(&rc, 1e-3, &s, &e, &elements, NULL));
    CHECK_ABS(s.force_ratio, -0.64, 1e-3, "Q with %d elements", elements);
    CHECK_MAX(e.scalar.force_ratio, 1e-3, "its estimate");
    rb_rolling_solution_free(&s);
    CHECK_STATUS(rb_rolling_solve_to_accuracy(&rc, 2.0, &s, &e, &elements, NULL), RB_EINVAL);
    rc.contact_elements = 5;
    CHECK_STATUS(rb_rolling_solve_with_errors(&rc, &s, &e, NULL), RB_EINVAL);
}

/* A name is given once, and the columns of a study are numbered without a gap. */
static void check_names(const rb_rolling_results *table)
{
    char heading[RB_ROLLING_HEADING];
    for (int k = 0; k < table->n; k++) {
        const rb_rolling_result *r = &table->row[k];
        assert_true(r->name && *r->name && r->meaning && *r->meaning);
        assert_true(strlen(rb_rolling_heading(r, RB_UNITS_MM, heading)) + 1 < RB_ROLLING_HEADING);
        for (int i = 0; i < k; i++)
            assert_string_not_equal(table->row[i].name, r->name);
    }
}

TEST(every_result_stands_once)
{
    int studied = 0;
    check_names(&rb_rolling_solution_scalars);
    check_names(&rb_rolling_solution_columns);
    check_names(&rb_rolling_history_columns);
    check_names(&rb_rolling_curve_columns);
    check_names(&rb_rolling_stress_scalars);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++)
        studied += rb_rolling_solution_scalars.row[k].study > 0;
    for (int k = 1; k <= studied; k++) {
        const rb_rolling_result *r = rb_rolling_study_column(k);
        if (!r || r->study != k)
            fail_msg("no result is column %d of a study", k);
    }
    assert_null(rb_rolling_study_column(studied + 1));
}

TEST(every_failed_allocation_is_reported)
{
    rb_rolling_case rc = with(wheel_on_plane(0.5), "contact-elements 12");
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    OWNED(rb_rolling_model) model = solved_model(&rc);
    for (int count = 0, refused = 1; refused && count < 100; count++) {
        refused = REFUSED_FROM(count, rb_rolling_stress_maxima_find(&model, 0.0, &maxima, NULL));
    }
    for (int count = 0, refused = 1; refused; count++) {
        OWNED(rb_rolling_curve) c, e;
        refused = REFUSED_FROM(count, rb_rolling_curve_with_errors(
                                          &rc, &(rb_rolling_range){0, 0.1, 0.5, 3, RB_UNITS_MM},
                                          NULL, NULL, &c, &e, NULL));
    }
}

/* ---- Units ------------------------------------------------------------------------- */

static rb_rolling_case case_of_any_kind(int k)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = k == 1 ? RB_BEM_ARC : k % 2 ? RB_BEM_HALFPLANE : RB_BEM_HUB;
    rc.elastic_b = k % 3 == 0;
    rc.b.young = 70000.0;
    set(&rc, "contact-elements 18 outer-elements 40 load 300 speed 1000");
    rc.formulation = k == 1 ? RB_STATIC : k == 3 ? RB_TRANSIENT : RB_STEADY;
    rc.mesh = k == 4 ? RB_MESH_FITTED : k == 5 ? RB_MESH_ALIGNED : RB_MESH_UNIFORM;
    if (k == 1) {
        set(&rc, "load nan approach 0.05");
    } else if (k == 2) {
        rc.force_ratio = -0.4;
    } else {
        rc.creep_ratio = 0.6;
    }
    if (k == 3) {
        set(&rc, "distance 0.5 steps 4");
    }
    if (k == 6) {
        set(&rc, "friction-law exponential mu-fall 0.1 slip-scale 20");
    }
    return rc;
}

/* The case with another unit of length and of stress. */
static rb_rolling_case in_units(rb_rolling_case rc, double length, double stress)
{
    rc.a.radius *= length;
    rc.b.radius *= length;
    rc.a.young *= stress;
    rc.b.young *= stress;
    rc.approach *= length;
    rc.load *= stress * length;
    return rc;
}

static double factor_of(const rb_rolling_result *r, double length, double stress)
{
    const char *unit = r->unit ? r->unit : "1";
    if (strcmp(unit, "mm") == 0)
        return length;
    if (strcmp(unit, "MPa") == 0)
        return stress;
    if (strcmp(unit, "N/mm") == 0)
        return stress * length;
    if (strcmp(unit, "N") == 0)
        return stress * length * length;
    return strcmp(unit, "1") == 0 ? 1.0 : NAN;
}

/* No bound of the program knows a length or a stress: in units a thousand million times
 * as large or small every number and every column is the same but for its unit. */
TEST(no_result_knows_its_unit)
{
    static const double units[][2] = {{0x1p-12, 0x1p-30}, {0x1p20, 0x1p24}};
    for (int k = 0; k < 7; k++)
        for (int u = 0; u < 2; u++) {
            const double length = units[u][0], stress = units[u][1];
            const rb_rolling_case rc = case_of_any_kind(k), other = in_units(rc, length, stress);
            OWNED(rb_rolling_solution) s, t;
            if (rb_rolling_solve(&rc, &s, &message) != RB_OK ||
                rb_rolling_solve(&other, &t, &message) != RB_OK)
                fail_msg("case %d: %s", k, message.text);
            assert_int_equal(s.n, t.n);
            const double one[] = {s.half_width, s.max_pressure, s.normal_load};
            for (int i = 0; i < rb_rolling_solution_scalars.n; i++) {
                const rb_rolling_result *r = &rb_rolling_solution_scalars.row[i];
                const double a = rb_rolling_number(r, &s), b = rb_rolling_number(r, &t),
                             factor = factor_of(r, length, stress);
                if (r->kind == RB_RESULT_SECONDS || isnan(factor) ||
                    strcmp(r->name, "iterations") == 0)
                    continue;
                const double size = fmax(fabs(a), factor == 1.0      ? 1.0
                                                  : factor == length ? one[0]
                                                  : factor == stress ? one[1]
                                                                     : one[2] * fmin(1.0, one[0]));
                assert_int_equal(!isnan(a), !isnan(b));
                if (!isnan(a))
                    CHECK_ABS(b / factor, a, 1e-8 * size, "case %d, units %d: %s", k, u, r->name);
            }
            for (int i = 0; i < s.n; i++) {
                CHECK_ABS(t.x[i] / length, s.x[i], 1e-8 * one[0], "%d: x of %d", k, i);
                CHECK_ABS(t.p[i] / stress, s.p[i], 1e-8 * one[1], "%d: p of %d", k, i);
                CHECK_ABS(t.q[i] / stress, s.q[i], 1e-8 * one[1], "%d: q of %d", k, i);
                CHECK_ABS(t.slip[i], s.slip[i], 1e-10, "%d: slip of %d", k, i);
                assert_int_equal(t.zone[i], s.zone[i]);
            }
        }
}

RUN_TESTS(NULL, NULL)
