/* Closed forms: forces as integrals of the tractions, published numbers, limits. */
#include "check.h"
#include "rolling/case/closed_forms.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>

enum { HERTZ, CARTER, CATTANEO };

typedef struct {
    int kind;
    double mu, p0, a, ratio;
} traction;

/* In x = a sin t the square roots at the edges are smooth. */
static double integrand(double t, void *context)
{
    const traction *c = context;
    const double x = c->a * sin(t), dx = c->a * cos(t);
    switch (c->kind) {
    case HERTZ:
        return dx * rb_closed_hertz_pressure(c->p0, c->a, x);
    case CARTER:
        return dx * rb_closed_carter_traction(c->mu, c->p0, c->a, c->ratio, x);
    default:
        return dx * rb_closed_cattaneo_traction(c->mu, c->p0, c->a, c->ratio, x);
    }
}

static double integral(traction c)
{
    gsl_integration_workspace *ws = gsl_integration_workspace_alloc(200);
    gsl_function f = {integrand, &c};
    double result, error;
    gsl_integration_qag(&f, -M_PI_2, M_PI_2, 1e-9 * c.p0 * c.a, 1e-9, 200, GSL_INTEG_GAUSS61, ws,
                        &result, &error);
    gsl_integration_workspace_free(ws);
    return result;
}

TEST(hertz_pressure_carries_the_load)
{
    const double R = 25.0, E = 51572.3, P = 16.20192;
    const double a = rb_closed_hertz_half_width(P, R, E);
    const double p0 = rb_closed_hertz_max_pressure(P, a);
    CHECK_REL(a, 0.1, 1e-6, "half-width");
    CHECK_REL(rb_closed_hertz_load(a, R, E), P, 1e-14, "load");
    CHECK_REL(p0, E * a / (2.0 * R), 1e-14, "p0 = E* a/(2R)");
    CHECK_REL(integral((traction){HERTZ, 0.0, p0, a, 0.0}), P, 1e-8, "load");
    CHECK_ABS(rb_closed_hertz_pressure(p0, a, 1.01 * a), 0.0, 0.0, "outside");
}

TEST(carter_traction_sums_to_s_2_minus_s)
{
    const double mu = 0.3, p0 = 500.0, a = 0.2, P = M_PI * a * p0 / 2.0;
    for (int k = -12; k <= 12; k++) {
        const double s = 0.1 * k;
        const double want = rb_closed_carter_force_ratio(s);
        const double Q = integral((traction){CARTER, mu, p0, a, s});
        CHECK_ABS(Q / (mu * P), want, 1e-7, "s = %g", s);
        if (fabs(s) <= 1.0) {
            CHECK_ABS(rb_closed_carter_creep_ratio(want), s, 1e-7, "s = %g", s);
            CHECK_ABS(fabs(want), fabs(s) * (2.0 - fabs(s)), 1e-15, "s = %g", s);
        }
    }
    assert_true(rb_closed_carter_force_ratio(0.5) < 0.0); /* braked: Q < 0 */
}

TEST(carter_sticks_at_the_leading_edge)
{
    const double mu = 0.3, p0 = 500.0, a = 0.2, s = 0.4;
    for (int k = 1; k < 100; k++) {
        const double x = a * (-1.0 + 0.02 * k);
        const double q = rb_closed_carter_traction(mu, p0, a, s, x);
        const double bound = mu * rb_closed_hertz_pressure(p0, a, x);
        if (x < a - 2.0 * a * (1.0 - s))
            CHECK_REL(q, -bound, 1e-14, "x = %g", x);
        else
            assert_true(fabs(q) < bound);
    }
}

TEST(cattaneo_traction_sums_to_the_force)
{
    const double mu = 0.2, p0 = 800.0, a = 0.3, P = M_PI * a * p0 / 2.0;
    for (int k = -10; k <= 10; k++) {
        const double ratio = 0.1 * k;
        const double Q = integral((traction){CATTANEO, mu, p0, a, ratio});
        CHECK_ABS(Q / (mu * P), ratio, 1e-7, "Q/(mu P) = %g", ratio);
    }
    CHECK_REL(rb_closed_cattaneo_stick(0.64), 0.6, 1e-14, "stick");
    const rb_closed_worn worn = rb_closed_worn_limit(rb_closed_cattaneo_stick(0.8));
    CHECK_REL(worn.volume, 0.426563, 1e-6, "worn volume");
    CHECK_REL(worn.depth, 0.328159, 1e-6, "worn depth");
    CHECK_REL(worn.mid_pressure, 1.341641, 1e-6, "p(0) of the worn contact");
}

/* Of two parts whose squares add up to 1 the ratios beta/mu are inverse; little sticks
 * where friction is low: K(c/a) = pi/2 and K' = ln(4a/c) to second order. */
TEST(spence_of_complementary_parts)
{
    const double beta = 0.01;
    CHECK_REL(rb_closed_spence_friction(beta, sqrt(0.5)), beta, 1e-14, "mu = beta");
    CHECK_REL(rb_closed_spence_friction(beta, 0.6) * rb_closed_spence_friction(beta, 0.8),
              beta * beta, 1e-14, "0.6 and 0.8");
    CHECK_REL(rb_closed_spence_friction(beta, 1e-4), beta * M_PI / (2.0 * log(4e4)), 1e-8,
              "little friction");
    CHECK_REL(rb_closed_spence_friction(2.0 * beta, 0.3),
              2.0 * rb_closed_spence_friction(beta, 0.3), 1e-14, "in proportion to beta");
    assert_true(isnan(rb_closed_spence_friction(beta, 0.0)));
    assert_true(isnan(rb_closed_spence_friction(beta, 1.0)));
}

/* theory-solvers.md 6: aluminium on steel */
TEST(bentall_johnson_published_numbers)
{
    const double beta = 0.143834, R = 25.0;
    const rb_closed_bentall_johnson b = rb_closed_bentall_johnson_stick(beta, 0.1, R, 51572.3);
    CHECK_REL(b.creepage, 3.67269e-4, 1e-5, "mu -> infinity");
    CHECK_REL(rb_closed_bentall_johnson_slip(beta, 0.1, R), 2.0 * beta * 0.1 / R * 0.457386, 1e-5,
              "mu -> 0");
    const rb_closed_bentall_johnson similar = rb_closed_bentall_johnson_stick(0.0, 0.1, R, 51572.3);
    CHECK_REL(similar.mid_pressure, 51572.3 * 0.1 / (2.0 * R), 1e-14, "Hertz at beta = 0");
    CHECK_ABS(similar.creepage, 0.0, 0.0, "no creepage at beta = 0");
}

/* The same with the load put in by Hertz: P/E* = pi a^2/(4R). */
TEST(half_cylinder_approach)
{
    const double R = 50.0, E = 94500.0 / 0.99, P = 100.0;
    const double a = rb_closed_hertz_half_width(P, R, E);
    CHECK_REL(rb_closed_half_cylinder_approach(P, R, E, a),
              a * a / (4.0 * R) * (2.0 * log(4.0 * R / a) - 1.0), 1e-13, "P = pi E* a^2/4R");
}

/* Johnson: 4 k without traction, 1/friction where the surface decides; McEwen's stress. */
TEST(shakedown_limit)
{
    CHECK_REL(rb_closed_shakedown_limit(0.0), 4.0, 1e-6, "free rolling");
    CHECK_REL(rb_closed_shakedown_limit(0.2), 3.20236, 1e-5, "below the surface");
    CHECK_REL(rb_closed_shakedown_limit(0.5), 2.0, 1e-9, "at the surface");
}

RUN_TESTS(NULL, NULL)
