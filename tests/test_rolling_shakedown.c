/* Shakedown of a half-plane that is rolled over (S1), against McEwen's closed stress
 * below Hertz's pressure with friction (Johnson, Contact Mechanics, 4.2 and 7.1). */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

enum { N = 1201 };

/* (sxx - szz)/2 and sxz at depth z, a = p0 = 1, friction mu p towards +x. */
static void stress_below(double mu, double x, double z, double *half, double *shear)
{
    const double A = 1.0 - x * x + z * z, B = sqrt(A * A + 4.0 * x * x * z * z);
    const double m2 = fmax(0.5 * (B + A), 0.0), n2 = fmax(0.5 * (B - A), 0.0);
    const double m = sqrt(m2), n = copysign(sqrt(n2), x), d = fmax(m2 + n2, 1e-12);
    const double sxx = -(m * (1.0 + (z * z + n2) / d) - 2.0 * z),
                 szz = -m * (1.0 - (z * z + n2) / d), sxz = -n * (m2 - z * z) / d;
    const double sxx_q = n * (2.0 - (z * z - m2) / d) - 2.0 * x;

    *half = 0.5 * (sxx + mu * sxx_q - szz - mu * sxz);
    *shear = sxz + mu * sxx;
}

/* Smallest radius about the axis that holds the path at this depth: by scanning centres. */
static double needed_at(double mu, double z)
{
    static double s[N], t[N];
    double least = INFINITY;
    for (int i = 0; i < N; i++)
        stress_below(mu, -2.0 + 4.0 * i / (N - 1), z, &s[i], &t[i]);
    for (int k = -400; k <= 400; k++) {
        double most = 0.0;
        for (int i = 0; i < N; i++)
            most = fmax(most, hypot(s[i] + 0.001 * k, t[i]));
        least = fmin(least, most);
    }
    return least;
}

static rb_rolling_case sliding(double mu)
{
    rb_rolling_case rc = half_plane(RB_STEADY, 60);
    set(&rc, "poisson 0.3 radius 1e4 similar gap parabola half-width 1 mu %g creep -1 mesh fitted",
        mu);
    return rc;
}

static rb_status limit_of(const rb_rolling_case *rc, rb_rolling_shakedown *limit, double *p0,
                          rb_message *why)
{
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) s;
    rb_status status = rb_rolling_solve_model(rc, &model, &s, why);
    *p0 = 2.0 * s.normal_load / (acos(-1.0) * s.hertz_half_width);
    if (status == RB_OK)
        status = rb_rolling_shakedown_find(&model, limit, why);
    return status;
}

TEST(johnsons_map_is_met)
{
    /* both sides of the coefficient from which on the surface yields first */
    const int step = getenv("ROLLBEM_TEST_ALL") ? 1 : 2;
    for (int k = 0; k <= 5; k += step) {
        const double mu = 0.1 * k;
        const rb_rolling_case rc = sliding(mu);
        rb_rolling_shakedown limit;
        double p0, want = 0.0;
        CHECK_OK(limit_of(&rc, &limit, &p0, &message));
        for (int j = 0; j <= 60; j++)
            want = fmax(want, needed_at(mu, 0.01 * j));
        CHECK_REL(limit.shear_yield / p0, want, 3e-3, "mu = %g", mu);
        if (k == 0) {
            CHECK_REL(p0 / limit.shear_yield, 4.0, 1e-3, "free rolling");
            CHECK_ABS(limit.y, 0.5, 0.02, "its depth");
        }
        if (k >= 4)
            CHECK_ABS(limit.y, 0.0, 0.02, "mu = %g: at the surface", mu);
    }
}

TEST(what_is_no_half_plane_is_refused)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = sliding(0.1);
        rb_rolling_shakedown limit;
        double p0;
        if (k)
            rc.a.support = RB_BEM_HUB;
        else
            rc.a.layer = 2.0;
        CHECK_SAYS(limit_of(&rc, &limit, &p0, &message), RB_EINVAL, k ? "half-plane" : "layer");
    }
}

RUN_TESTS(NULL, NULL)
