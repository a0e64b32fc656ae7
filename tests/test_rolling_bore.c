/* A cylinder in a bore: outer race, journal, internal gear. */
#include "cases.h"
#include "refused.h"
#include "rolling/case/closed_forms.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* Similar bodies, the bore wider than the cylinder by a part of its radius. */
static rb_rolling_case in_bore(double wider, rb_rolling_gap gap)
{
    rb_rolling_case rc = half_plane(RB_STATIC, 100);
    rc.a.poisson = 0.3;
    rc.b = rc.a;
    set(&rc, "radius-b %g mesh fitted", -(1.0 + wider) * rc.a.radius);
    rc.elastic_b = 1;
    rc.gap = gap;
    return rc;
}

static double modulus_of(const rb_rolling_case *rc)
{
    return 0.5 * rc->a.young / (1.0 - gsl_pow_2(rc->a.poisson));
}

/* Under parabolas it is Hertz's contact of 1/R = 1/R_A - 1/R_B, and Carter's. */
TEST(parabolas_are_one_of_the_difference_of_curvatures)
{
    rb_rolling_case rc = in_bore(0.1, RB_GAP_PARABOLA);
    const double R = 1.1 * rc.a.radius / 0.1, a = 0.05;
    set(&rc, "load %g formulation steady creep-ratio 0.4",
        rb_closed_hertz_load(a, R, modulus_of(&rc)));
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(rb_rolling_radius(&rc), R, 1e-13, "combined radius");
    CHECK_REL(s.half_width, a, 2e-4, "half-width");
    CHECK_REL(s.max_pressure, rb_closed_hertz_max_pressure(rc.load, a), 3e-4, "p0");
    CHECK_REL(s.creepage, 0.4 * rc.mu * a / R, 1e-9, "creepage");
    CHECK_ABS(s.force_ratio, -0.64, 5e-4, "Carter");
}

/* Under circles the load of half-planes is in closed form at any arc. */
TEST(a_conforming_arc_carries_the_load_of_its_closed_form)
{
    static const double wider[] = {0.5, 0.02, 1e-4}, part[] = {0.05, 0.3, 0.6, 0.9};
    for (int w = 0; w < 3; w++)
        for (int k = 0; k < 4; k++) {
            rb_rolling_case rc = in_bore(wider[w], RB_GAP_EXACT);
            const double a = part[k] * rc.a.radius, E = modulus_of(&rc);
            rc.load =
                rb_closed_circle_load(a, rc.a.radius, E) + rb_closed_circle_load(a, rc.b.radius, E);
            OWNED(rb_rolling_solution) s = solved(&rc);
            CHECK_REL(s.half_width, a, 3e-4, "bore wider by %g, a/R = %g", wider[w], part[k]);
        }
}

/* Small arcs are Hertz's, with a first deviation of 3/8 a^2 R (1/R_A^3 - 1/R_B^3) and
 * a next one of 15/64 a^4 R (1/R_A^5 - 1/R_B^5) < 1.2 (a/R_A)^4. */
TEST(a_journal_on_a_small_arc_is_hertzs)
{
    const double A = 50.0, B = 51.0, E = 1e5, R = A * B / (B - A);
    for (int k = 1; k <= 3; k++) {
        const double a = pow(10.0, -k) * A;
        const double P = rb_closed_circle_load(a, A, E) + rb_closed_circle_load(a, -B, E);
        const double series = 1.0 + 0.375 * a * a * R * (1.0 / gsl_pow_3(A) - 1.0 / gsl_pow_3(B));
        CHECK_REL(P / rb_closed_hertz_load(a, R, E), series, 1.2 * gsl_pow_4(a / A), "a/R = %g",
                  a / A);
    }
}

/* The gap keeps its digits where the radii agree in most of theirs. */
TEST(a_tight_bore_keeps_its_gap)
{
    for (int k = 1; k <= 12; k++) {
        const rb_rolling_case rc = in_bore(pow(10.0, -k), RB_GAP_EXACT);
        const long double A = rc.a.radius, B = -rc.b.radius, x = 0.7 * rc.a.radius;
        const long double want =
            x * x / (A + sqrtl(A * A - x * x)) - x * x / (B + sqrtl(B * B - x * x));
        CHECK_REL(rb_rolling_initial_gap(&rc, (double)x), (double)want,
                  1e-15 + 1e-18 * pow(10.0, k), "bore wider by 1e-%d", k);
        CHECK_REL(rb_rolling_radius(&rc), (double)(A * B / (B - A)), 1e-15, "radius");
    }
}

/* Dissimilar bodies roll freely by eta a/R of the combined radius, as outside each other
 * (Bentall and Johnson). */
TEST(free_rolling_knows_the_combined_radius_alone)
{
    double creepage[2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = in_bore(0.25, RB_GAP_PARABOLA);
        rc.b.young *= 3.0;
        set(&rc, "half-width 0.02 formulation steady force 0");
        if (k == 1) { /* outside, with the same combined radius, 250 mm */
            set(&rc, "radius 300 radius-b 1500");
        }
        OWNED(rb_rolling_solution) s = solved(&rc);
        creepage[k] = s.creepage;
    }
    assert_true(fabs(creepage[0]) > 1e-8);
    CHECK_REL(creepage[0], creepage[1], 1e-9, "free creepage");
}

TEST(what_does_not_fit_is_refused)
{
    ACCEPTED(PLANE, rc.elastic_b = 1, rc.b.radius = -50.001);
    ACCEPTED(HUB, rc.elastic_b = 1, rc.b.radius = -51.0);
    REFUSED("a bore must be larger than body A", PLANE, rc.elastic_b = 1, rc.b.radius = -50.0);
    REFUSED("a bore must be larger than body A", PLANE, rc.elastic_b = 1, rc.b.radius = -1.0);
    REFUSED("a bore has no wheel's boundary", PLANE, rc.elastic_b = 1, rc.b.radius = -60.0,
            rc.b.support = RB_BEM_HUB);
    REFUSED("expected > 0, or < 0 of a bore", PLANE, rc.elastic_b = 1, rc.b.radius = 0.0);
    REFUSED("radius-b: expected a number or plane", PLANE, rc.elastic_b = 1,
            rc.b.radius = -INFINITY);
    REFUSED("radius: expected a number > 0, got -5", rc.a.radius = -5.0);
    REFUSED("half-width: expected less than", PLANE, rc.elastic_b = 1, rc.b.radius = -60.0,
            rc.half_width = 50.0);
    REFUSED("wider than the radius", PLANE, rc.elastic_b = 1, rc.b.radius = -60.0, rc.zone = 55.0);
}

RUN_TESTS(NULL, NULL)
