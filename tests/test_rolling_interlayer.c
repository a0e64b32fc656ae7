/* An elastic third body: the brush law between rigid bodies, half-planes with a
 * tangential layer, and that meshes, formulations and solvers agree on it. */
#include "cases.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* Bodies so stiff that the layer alone gives way: P = 2 a^3/(3 R L_N) with a = 1. */
static rb_rolling_case brushes(int n, double s)
{
    rb_rolling_case rc =
        rolling_case("support halfplane young 1e13 poisson 0.5 gap parabola interlayer-normal 1e-6 "
                     "interlayer-tangential 2e-6 formulation steady mesh aligned "
                     "slip-operator second contact-elements %d",
                     n);
    rc.load = 2.0 / (3.0 * rc.a.radius * rc.interlayer_normal);
    rc.creep = s * rc.mu * rc.interlayer_tangential / (rc.a.radius * rc.interlayer_normal);
    return rc;
}

/* |Q|/(mu P) = 1 - (1 - s)^3, s = xi R L_N/(mu L_T a). */
TEST(brushes_meet_their_law)
{
    static const double s[] = {0.2, 0.5, 0.8};
    static const int n[] = {50, 100, 200};
    static const double bound[] = {3e-4, 2.7e-4, 9e-4};     /* with 50 elements */
    static const double error[] = {2.5e-4, 6.3e-5, 1.6e-5}; /* of s = 0.5: theory-rolling.md I2 */

    for (int j = 0; j < 3; j++)
        for (int k = 0; k < 3; k++) {
            const double coarse = n[0] / (double)n[j];
            /* above s = 3/4 the element at the leading edge slips, whatever its length */
            const double finer = s[k] > 0.75 ? pow(coarse, 0.7) : gsl_pow_2(coarse);
            const rb_rolling_case rc = brushes(n[j], s[k]);
            OWNED(rb_rolling_solution) it = solved(&rc);
            CHECK_ABS(it.force_ratio, -(1.0 - gsl_pow_3(1.0 - s[k])), bound[k] * finer,
                      "n = %d, s = %g", n[j], s[k]);
            if (k == 1)
                CHECK_TWO_DIGITS(fabs(it.force_ratio + 0.875), error[j], "n = %d", n[j]);
            CHECK_ABS(it.half_width, 1.0, 1e-4 * gsl_pow_2(coarse), "n = %d: half-width", n[j]);
            CHECK_ABS(it.stick_from, -1.0 + 2.0 * s[k], 2.0 / n[j] + 1e-3,
                      "n = %d, s = %g: start of stick", n[j], s[k]);
            CHECK_MAX(it.residual, 1e-10, "residual");
        }
}

/* Brushes that nowhere slip, under an approach: the N elements in contact have q = -xi k h/L_T from
 * the leading one on, by products as by matrices.  Residuals are fractions of the pressure that
 * the layer bears, not of Hertz's of the same approach, 4e5 times as large. */
TEST(brushes_under_an_approach_meet_their_law)
{
    static const int n[] = {60, 300};

    for (int k = 0; k < 2; k++) {
        const rb_rolling_case rc = rolling_case(
            "support halfplane young 1e6 poisson 0.3 similar radius 50 gap parabola mu 1000 "
            "interlayer-normal 0.01 interlayer-tangential 0.01 formulation steady creep 1e-5 "
            "approach 0.001 mesh uniform contact-elements %d",
            n[k]);
        OWNED(rb_rolling_solution) it = solved(&rc);
        const double N = it.contact, h = it.h[n[k] / 2];
        CHECK_REL(it.tangential_load, -1e-5 * h * h * N * (N + 1.0) / 2.0 / 0.01, 3e-3, "n = %d",
                  n[k]);
        CHECK_REL(it.max_pressure, 0.1, 2e-3, "n = %d: p0", n[k]);
    }
}

/* Half-planes with a tangential layer: slope of the creep curve over Carter's,
 * Lam = L_T E* / a. */
static rb_rolling_case layered(double lam, int n, double ratio)
{
    rb_rolling_case rc = half_plane(RB_STEADY, n);
    set(&rc, "young 200000 poisson 0.3 similar gap parabola half-width 0.05");
    rc.interlayer_tangential = lam * rc.half_width / rb_rolling_derive(&rc).modulus;
    set(&rc, "creep-ratio %g mesh aligned slip-operator second", ratio);
    return rc;
}

TEST(layer_lowers_the_slope)
{
    static const double lam[] = {0.01, 0.1, 0.3, 1.0, 3.0, 10.0};
    static const double slope[] = {0.9875, 0.9116, 0.7937, 0.5538, 0.2970, 0.11289};

    for (int k = 0; k < 6; k++) {
        const rb_rolling_case rc = layered(lam[k], 100, 1e-3);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(-s.force_ratio / 2e-3, slope[k], 1e-3, "Lam = %g", lam[k]);
    }
}

TEST(layer_moves_the_whole_curve)
{
    static const double s[] = {0.5, 1.0, 2.0}, ratio[] = {0.4890, 0.7849, 0.9713};

    for (int k = 0; k < 3; k++) {
        const rb_rolling_case rc = layered(1.0, 200, s[k]);
        OWNED(rb_rolling_solution) it = solved(&rc);
        CHECK_ABS(-it.force_ratio, ratio[k], 1e-4, "s = %g", s[k]);
    }
}

/* Fitted and equal elements, a transient that has become steady, both solvers. */
TEST(formulations_agree)
{
    rb_rolling_case rc = layered(1.0, 100, 0.5);
    rc.interlayer_normal = 0.5 * rc.interlayer_tangential;
    OWNED(rb_rolling_solution) aligned = solved(&rc);
    set(&rc, "slip-operator upstream mesh fitted");
    OWNED(rb_rolling_solution) fitted = solved(&rc);
    rc.contact.solver = RB_SOLVER_LEMKE;
    OWNED(rb_rolling_solution) lemke = solved(&rc);
    CHECK_REL(fitted.force_ratio, aligned.force_ratio, 2e-3, "fitted");
    CHECK_REL(fitted.max_pressure, aligned.max_pressure, 1e-3, "fitted: p0");
    CHECK_REL(lemke.force_ratio, fitted.force_ratio, 1e-9, "Lemke");
    set(&rc, "solver newton mesh uniform creep-ratio nan force-ratio %g", fitted.force_ratio);
    OWNED(rb_rolling_solution) uniform = solved(&rc);
    set(&rc, "formulation transient distance 4");
    OWNED(rb_rolling_solution) rolled = solved(&rc);
    CHECK_REL(uniform.creep_ratio, fitted.creep_ratio, 3e-2, "equal elements");
    CHECK_REL(rolled.creep_ratio, uniform.creep_ratio, 5e-3, "a transient's end");
}

/* The load is carried by half-planes and layer in series: a soft layer widens the
 * contact. */
TEST(normal_compliance_widens_the_contact)
{
    rb_rolling_case rc = layered(0.0, 100, 0.5);
    double before = 0.0;
    for (int k = 0; k < 4; k++) {
        rc.interlayer_normal = k * 0.5 * rc.half_width / rb_rolling_derive(&rc).modulus;
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_true(s.half_width > before);
        before = s.half_width;
    }
}

/* A first third body widens the contact, and by little: so do derivatives by it at 0. */
TEST(a_thin_third_body_changes_little)
{
    static const double compliance[] = {0.0, 1e-13, 1e-10};
    double a[3];
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = rolling_case("support halfplane gap parabola young 210000 poisson 0.3 "
                                          "similar radius 100 load 900");
        rc.interlayer_normal = compliance[k];
        a[k] = rb_rolling_contact_half_width(&rc, 900.0);
    }
    CHECK_REL((a[1] - a[0]) / compliance[1], (a[2] - a[0]) / compliance[2], 1e-3, "da/dL");
}

TEST(negative_compliance_is_refused)
{
    rb_rolling_case rc = layered(1.0, 60, 0.5);
    rc.interlayer_normal = -1e-9;
    CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, "interlayer");
}

RUN_TESTS(NULL, NULL)
