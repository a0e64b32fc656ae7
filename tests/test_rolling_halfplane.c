/* Hertz, Carter, Bentall-Johnson, Cattaneo-Mindlin on the half-plane: no error but that
 * of the contact mesh. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* nu = 1/2 on a rigid plane: a similar pair, so that Carter holds (theory.md 4.5). */
static rb_rolling_case incompressible_wheel(void)
{
    rb_rolling_case rc = half_plane(RB_STATIC, 200);
    set(&rc, "poisson 0.5 gap parabola half-width %g", 1e-4 * rc.a.radius);
    return rc;
}

/* `across` equal elements over 2a, the edges a fraction `offset` of an element from an
 * element's end, five more elements at each side. */
static void align(rb_rolling_case *rc, int across, double offset)
{
    rc->contact_elements = across + 10;
    rc->zone = rc->half_width * (across + 10) / (across + 2.0 * offset);
}

/* Coulomb's law, complementarity and the force, from the printed table alone. */
static void check_honest(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    double P = 0.0;
    for (int i = 0; i < s->n; i++) {
        CHECK_MAX(-s->p[i], 0.0, "adhesion at %d", i);
        CHECK_MAX(fabs(s->q[i]), rc->mu * s->p[i] + 1e-10 * s->max_pressure, "Coulomb at %d", i);
        CHECK_MAX(-s->gap[i], 1e-10 * s->half_width, "penetration at %d", i);
        P += s->p[i] * s->h[i];
    }
    CHECK_REL(P, s->normal_load, 1e-14, "load of the table");
    CHECK_MAX(s->residual, 1e-10, "residual");
    CHECK_MAX(s->load_error, 1e-10, "load error");
}

TEST(hertz_at_any_alignment)
{
    for (int k = 0; k <= 4; k++) {
        rb_rolling_case rc = with(incompressible_wheel(), "mu 0");
        align(&rc, 200, 0.25 * k);
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double a = rc.half_width, P = rb_rolling_hertz_load(&rc, a);
        const double p0 = 2.0 * P / (M_PI * a);
        double square = 0.0;
        for (int i = 0; i < s.n; i++)
            square += gsl_pow_2(s.p[i] - p0 * sqrt(fmax(0.0, 1.0 - gsl_pow_2(s.x[i] / a)))) *
                      s.h[i] / (2.0 * a);
        check_honest(&rc, &s);
        CHECK_REL(s.max_pressure, p0, 1e-3, "p0, offset %g", 0.25 * k);
        CHECK_REL(s.normal_load, P, 1e-10, "load, offset %g", 0.25 * k);
        CHECK_REL(s.half_width, a, 2e-3, "half-width, offset %g", 0.25 * k);
        CHECK_MAX(sqrt(square) / p0, 3e-3, "rms of p, offset %g", 0.25 * k);
    }
}

/* The compression of a half-cylinder, which the default datum reproduces (B6). */
TEST(hertz_by_approach)
{
    rb_rolling_case rc = incompressible_wheel();
    const double a = rc.half_width, R = rc.a.radius;
    align(&rc, 200, 0.5);
    set(&rc, "half-width nan mu 0");
    rc.approach = a * a / (4.0 * R) * (2.0 * log(4.0 * R / a) - 1.0);
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.normal_load, rb_rolling_hertz_load(&rc, a), 1e-3, "load of an approach");
}

static double carter(double s)
{
    return s >= 1.0 ? 1.0 : s * (2.0 - s);
}

static rb_rolling_solution rolling_at(rb_rolling_case rc, double ratio)
{
    set(&rc, "formulation steady creep-ratio %g", ratio);
    return solved(&rc);
}

TEST(carter_on_200_equal_elements)
{
    for (int k = 1; k <= 9; k++) {
        rb_rolling_case rc = incompressible_wheel();
        const double a = rc.half_width;
        align(&rc, 200, 0.3);
        OWNED(rb_rolling_solution) s = rolling_at(rc, 0.1 * k);
        const double h = s.h[0];
        check_honest(&rc, &s);
        CHECK_ABS(-s.force_ratio, carter(0.1 * k), 3e-3, "s = %g", 0.1 * k);
        CHECK_ABS(s.stick_from, a * (1.0 - 2.0 * (1.0 - 0.1 * k)), 1.5 * h, "s = %g", 0.1 * k);
        CHECK_ABS(s.stick_to, a, 1.5 * h, "s = %g", 0.1 * k);
        assert_int_equal(s.slip_violations, 0);
    }
}

TEST(carter_halves_its_error_with_the_mesh)
{
    for (int k = 2; k <= 8; k += 3) {
        double error[2];
        for (int fine = 0; fine < 2; fine++) {
            rb_rolling_case rc = incompressible_wheel();
            align(&rc, fine ? 200 : 100, 0.0);
            OWNED(rb_rolling_solution) s = rolling_at(rc, 0.1 * k);
            error[fine] = -s.force_ratio - carter(0.1 * k);
        }
        /* 1.61e-3 at s = 0.7 and 0.8 is the scheme's own first-order error */
        CHECK_MAX(fabs(error[1]), k < 7 ? 1.5e-3 : 1.65e-3, "s = %g", 0.1 * k);
        CHECK_ABS(error[0] / error[1], 2.0, 0.15, "order, s = %g", 0.1 * k);
    }
}

TEST(beyond_full_sliding_everything_slides)
{
    rb_rolling_case rc = incompressible_wheel();
    OWNED(rb_rolling_solution) s = rolling_at(rc, -1.2);
    CHECK_REL(s.force_ratio, 1.0, 1e-12, "s = -1.2");
    assert_int_equal(s.stick, 0);
}

TEST(carter_on_a_fitted_mesh)
{
    const int n[] = {50, 100, 200};
    const double bound[] = {3e-4, 1.5e-4, 3e-5};
    for (int mesh = 0; mesh < 3; mesh++)
        for (int k = 1; k <= 10; k++) {
            const double ratio = k == 10 ? 0.95 : 0.1 * k;
            rb_rolling_case rc = incompressible_wheel();
            set(&rc, "mesh fitted contact-elements %d", n[mesh]);
            OWNED(rb_rolling_solution) s = rolling_at(rc, ratio);
            check_honest(&rc, &s);
            CHECK_ABS(-s.force_ratio, carter(ratio), bound[mesh], "n = %d, s = %g", n[mesh], ratio);
        }
}

TEST(carter_under_force_control)
{
    for (int k = 1; k <= 10; k++) {
        const double ratio = k == 10 ? 0.99 : 0.1 * k;
        rb_rolling_case rc = incompressible_wheel();
        set(&rc, "formulation steady mesh fitted force-ratio %g", -ratio);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.force_ratio, -ratio, 1e-10, "given force");
        CHECK_REL(s.creep_ratio, 1.0 - sqrt(1.0 - ratio), 2e-4, "Q/(mu P) = %g", ratio);
    }
}

TEST(both_forms_agree)
{
    for (int dissimilar = 0; dissimilar < 2; dissimilar++) {
        rb_rolling_case rc = incompressible_wheel();
        set(&rc, "poisson %g solver lemke contact-elements 100", dissimilar ? 0.28 : 0.5);
        OWNED(rb_rolling_solution) pivoted = rolling_at(rc, 0.4);
        rc.contact.lcp_form = RB_LCP_KWAK;
        OWNED(rb_rolling_solution) kwak = rolling_at(rc, 0.4);
        assert_int_equal(pivoted.lcp_form, RB_LCP_PIVOTED);
        assert_int_equal(kwak.lcp_form, RB_LCP_KWAK);
        for (int i = 0; i < kwak.n; i++) {
            CHECK_ABS(pivoted.p[i], kwak.p[i], 1e-9 * kwak.max_pressure, "p, element %d", i);
            CHECK_ABS(pivoted.q[i], kwak.q[i], 1e-9 * kwak.max_pressure, "q, element %d", i);
        }
    }
}

/* On the half-plane nothing but the upstream difference knows left from right. */
TEST(the_signs_of_creepage_mirror_for_similar_bodies)
{
    rb_rolling_case rc = incompressible_wheel();
    OWNED(rb_rolling_solution) plus = rolling_at(rc, 0.4), minus = rolling_at(rc, -0.4);
    for (int i = 0; i < plus.n; i++)
        CHECK_ABS(plus.q[i], -minus.q[i], 1e-10 * plus.max_pressure, "q, element %d", i);
    CHECK_ABS(plus.free_creepage, 0.0, 1e-12 * plus.creepage, "free rolling");
}

/* Aluminium on steel (theory-solvers.md 6). */
static rb_rolling_case aluminium_on_steel(double mu)
{
    return rolling_case("poisson 0.31 young %g poisson-b 0.28 young-b %g radius-b 50 "
                        "support halfplane support-b halfplane gap parabola formulation steady "
                        "mesh fitted contact-elements 200 half-width 0.1 force 0 mu %g",
                        2.0 * 23000.0 * 1.31, 2.0 * 82000.0 * 1.28, mu);
}

TEST(bentall_johnson_free_rolling)
{
    rb_rolling_case rc = aluminium_on_steel(10.0);
    rb_rolling_solution s = solved(&rc);
    CHECK_REL(s.normal_load, 16.20192, 1e-6, "load");
    CHECK_REL(s.creepage, -3.67269e-4, 1e-3, "mu -> infinity");
    rb_rolling_solution_free(&s);
    rc.force = NAN; /* asked for beside another creepage: the same */
    rc.creep = 0.0;
    s = solved(&rc);
    CHECK_REL(s.free_creepage, -3.67269e-4, 1e-3, "free creepage of a case at xi = 0");
    rb_rolling_solution_free(&s);
    rc = aluminium_on_steel(1e-4);
    s = solved(&rc);
    CHECK_REL(s.creepage, -2.0 * 0.143834 * 0.004 * 0.457386, 5e-3, "mu -> 0");
    rb_rolling_solution_free(&s);
}

TEST(cattaneo_mindlin)
{
    for (int k = 1; k <= 9; k += 2) {
        rb_rolling_case rc = incompressible_wheel();
        const double a = rc.half_width, c = a * sqrt(1.0 - 0.1 * k);
        align(&rc, 200, 0.0);
        rc.force_ratio = 0.1 * k;
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double bound = rc.mu * 2.0 * s.normal_load / (M_PI * a);
        double square = 0.0;
        check_honest(&rc, &s);
        for (int i = 0; i < s.n; i++) {
            const double outer = sqrt(fmax(0.0, 1.0 - gsl_pow_2(s.x[i] / a)));
            const double inner = c / a * sqrt(fmax(0.0, 1.0 - gsl_pow_2(s.x[i] / c)));
            square += gsl_pow_2(s.q[i] / bound - outer + inner) * s.h[i] / (2.0 * a);
        }
        CHECK_MAX(sqrt(square), 2e-3, "rms of q, Q/(mu P) = %g", 0.1 * k);
        CHECK_ABS(s.stick_to, c, 1.01 * s.h[0], "stick, Q/(mu P) = %g", 0.1 * k);
        CHECK_ABS(s.stick_from, -c, 1.01 * s.h[0], "stick, Q/(mu P) = %g", 0.1 * k);
    }
}

TEST(a_zone_that_fills_says_how_wide_it_should_be)
{
    rb_rolling_case rc = incompressible_wheel();
    rb_rolling_solution s;
    rc.zone = 0.8 * rc.half_width;
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_ZONE);
    const char *to = NOT_NULL(strstr(message.text, " to "));
    rc.zone = atof(to + 4);
    rb_rolling_solution_free(&s);
    s = solved(&rc);
    assert_int_equal(s.zone[0], RB_ZONE_SEPARATED);
    rb_rolling_solution_free(&s);
}

TEST(a_gap_that_never_closes_is_no_contact)
{
    const double x[] = {-100.0, 0.0, 100.0}, gap[] = {1.1, 1.0, 1.1};
    rb_rolling_case rc = incompressible_wheel();
    OWNED(rb_rolling_solution) s;
    rb_rolling_profile *profile;
    CHECK_OK(rb_rolling_profile_create(3, x, gap, 0.0, &profile, NULL));
    set(&rc, "half-width nan approach 0.5");
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_NO_CONTACT);
    rb_rolling_profile_free(profile);
}

/* A profile of the parabola itself gives the parabola's answer. */
TEST(a_table_gap_is_the_gap_it_tabulates)
{
    enum { POINTS = 41 };
    double x[POINTS], gap[POINTS];
    rb_rolling_profile *profile;
    rb_rolling_case rc = incompressible_wheel();
    for (int i = 0; i < POINTS; i++) {
        x[i] = 2.0 * rc.half_width * (i - POINTS / 2) / (POINTS / 2);
        gap[i] = x[i] * x[i] / (2.0 * rc.a.radius);
    }
    CHECK_OK(rb_rolling_profile_create(POINTS, x, gap, 0.0, &profile, NULL));
    OWNED(rb_rolling_solution) want = rolling_at(rc, 0.4);
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    OWNED(rb_rolling_solution) got = rolling_at(rc, 0.4);
    CHECK_REL(got.max_pressure, want.max_pressure, 1e-5, "p0");
    CHECK_ABS(got.force_ratio, want.force_ratio, 1e-5, "Q");
    rb_rolling_profile_free(profile);
}

TEST(every_failed_allocation_is_reported)
{
    rb_rolling_case rc = incompressible_wheel();
    set(&rc, "contact-elements 12 formulation steady creep-ratio 0.4");
    for (int count = 0, refused = 1; refused; count++) {
        OWNED(rb_rolling_solution) s;
        refused = REFUSED_FROM(count, rb_rolling_solve(&rc, &s, NULL));
    }
}

RUN_TESTS(NULL, NULL)
