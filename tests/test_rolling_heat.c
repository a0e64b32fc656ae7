/* Flash temperature: the moving strip against quadrature, the closed form of an elliptic
 * source, two bodies, low and high speed, steps against the steady state, refusals. */
#include "rolling/case/closed_forms.h"
#include "cases.h"
#include "solved.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_bessel.h>

/* ---- The strip --------------------------------------------------------------------- */

typedef struct {
    double P, conductivity;
} source;

/* Carslaw and Jaeger: a line of heat on the surface that a body passes. */
static double line_source(double t, void *context)
{
    const source *s = context;
    const double z = fabs(s->P * t);
    return exp(s->P * t - z) * gsl_sf_bessel_K0_scaled(z) / (M_PI * s->conductivity);
}

static double quadrature(const source *s, double from, double to)
{
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    gsl_function f = {line_source, (void *)s};
    const double ends[3] = {from, fmin(fmax(0.0, from), to), to};
    double sum = 0.0, part, error;

    for (int k = 0; k < 2; k++)
        if (ends[k + 1] > ends[k]) {
            gsl_integration_qags(&f, ends[k], ends[k + 1], 0.0, 1e-12, 1000, w, &part, &error);
            sum += part;
        }
    gsl_integration_workspace_free(w);
    return sum;
}

TEST(strip_meets_quadrature)
{
    static const double ends[][2] = {{-0.5, 0.5}, {0.5, 1.5},  {-1.5, -0.5}, {7.5, 8.5},
                                     {-9, -8},    {0.0, 0.01}, {-3.0, 5.0}};
    static const double P[] = {0.02, 0.3, 1.0, 8.0, 40.0};

    for (size_t k = 0; k < sizeof P / sizeof *P; k++)
        for (size_t j = 0; j < sizeof ends / sizeof *ends; j++) {
            const rb_rolling_heat steel = {50.0, 3.5, 0.0};
            const source s = {P[k], 50.0};
            const double speed = 2.0 * P[k] * 50.0 / 3.5;
            const double want = quadrature(&s, ends[j][0], ends[j][1]);
            const double got = rb_rolling_heat_response(&steel, speed, ends[j][0], ends[j][1]);
            /* far upstream both are rounding against the response of the strip itself */
            const double own = rb_rolling_heat_response(&steel, speed, -0.5, 0.5);
            CHECK_ABS(got, want, 1e-10 * fabs(want) + 1e-13 * own, "P = %g, %g ... %g", P[k],
                      ends[j][0], ends[j][1]);
        }
}

/* ---- Below the surface (T4) -------------------------------------------------------- */

/* All heat of a uniform band |x| < 1 enters the body; k T/(H a). */
static double below_band(double peclet, double x, double y)
{
    rb_rolling_case rc = {.formulation = RB_STEADY, .a.support = RB_BEM_HALFPLANE};
    double middle = 0.0, length = 2.0, heat = 1.0;
    const rb_rolling_solution s = {.n = 1, .x = &middle, .h = &length, .heat_a = &heat};
    rb_rolling_stress at = {.x = x, .y = y};

    rc.heat_a = (rb_rolling_heat){1.0, 1.0, 0.0};
    rc.speed = 2.0 * peclet;
    CHECK_STATUS(rb_rolling_temperature_inside(&rc, &s, 0, 1, &at, &message), RB_OK);
    return at.temperature;
}

/* Adaptive quadrature in numpy, 1e-14. */
TEST(temperature_below_a_band)
{
    static const struct {
        double peclet, t[4];
    } band[] = {{0.1, {1.843677, 1.656507, 2.084438, 1.177646}},
                {1.0, {0.822124, 0.605941, 0.768439, 0.427494}},
                {10.0, {0.259262, 0.061769, 0.168066, 0.094589}},
                {100.0, {0.040010, 0.000016, 0.016784, 0.000801}}};
    static const double at[4][2] = {{-1.0, 0.1}, {-1.0, 0.5}, {0.0, 0.1}, {-3.0, 0.5}};

    for (size_t k = 0; k < sizeof band / sizeof *band; k++)
        for (int j = 0; j < 4; j++)
            CHECK_ABS(below_band(band[k].peclet, at[j][0], at[j][1]), band[k].t[j], 6e-7,
                      "Pe = %g, (%g, %g)", band[k].peclet, at[j][0], at[j][1]);
    /* at the surface that of (T1), which no panel meets; just below it, too */
    CHECK_ABS(below_band(1.0, -1.0, 0.0), 0.875381, 6e-7, "surface");
    CHECK_ABS(below_band(1.0, -1.0, 1e-9), below_band(1.0, -1.0, 0.0), 1e-8, "just below");
    /* exp(u) alone has no double there */
    assert_true(isfinite(below_band(1e6, -1.0, 1e-4)));
}

/* Far downstream the body carries all of the heat, 2 H a, with it. */
TEST(heat_goes_with_the_body)
{
    double carried = 0.0;

    for (int k = 0; k < 4000; k++)
        carried += 0.05 * below_band(1.0, -40.0, 0.05 * (k + 0.5));
    CHECK_ABS(2.0 * carried, 2.0, 1e-10, "c V int T dy");
}

/* Elliptic heat, 1 W/mm, of steel that slides on aluminium or on a plastic, a = 1: the share of
 * steel and the largest rise, by quadrature of another program. */
TEST(shares_of_elliptic_heat)
{
    static const struct {
        rb_rolling_heat b;
        double speed, share, rise;
    } known[] = {
        {{200.0, 2.43, 0.0}, 1.0, .265218, 7.5514},   {{200.0, 2.43, 0.0}, 10.0, .315895, 4.5723},
        {{200.0, 2.43, 0.0}, 100.0, .375319, 2.0490}, {{200.0, 2.43, 0.0}, 1000.0, .383646, .69378},
        {{.31, 2.0, 0.0}, 1.0, .967210, 28.347},      {{.31, 2.0, 0.0}, 10.0, .950119, 14.625},
        {{.31, 2.0, 0.0}, 100.0, .945856, 5.3780},    {{.31, 2.0, 0.0}, 1000.0, .945760, 1.7120}};
    static const struct {
        double x, depth, rise[2][2]; /* of A and B at V = 10 and 100 on aluminium */
    } below[] = {{-.5, .1, {{4.15379, 4.21775}, {1.71116, 1.86068}}},
                 {-.5, .5, {{3.27567, 3.61364}, {.70655, 1.29963}}},
                 {-2.0, .2, {{2.55852, 2.79943}, {1.02377, 1.07275}}}};
    rb_rolling_case rc = rolling_case("support halfplane gap parabola similar radius 1000 "
                                      "half-width 1 mu 1e-4 formulation steady creep 1e-3 "
                                      "mesh fitted contact-elements 200");
    rc.heat_a = (rb_rolling_heat){50.0, 3.77, 0.0};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        rc.speed = known[k].speed;
        rc.heat_b = known[k].b;
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double heat = (s.heat_into_a + s.heat_into_b) / 1000.0; /* kW/m, W/mm */
        CHECK_ABS(s.heat_share_a, known[k].share, 2e-4, "share, case %d", (int)k);
        CHECK_REL(s.max_temperature / heat, known[k].rise, 1e-3, "rise, case %d", (int)k);
        for (int j = 0; j < 6 && (k == 1 || k == 2); j++) {
            const int i = j / 2, of_b = j % 2;
            rb_rolling_stress at = {.x = below[i].x, .y = of_b ? -below[i].depth : below[i].depth};
            CHECK_OK(rb_rolling_temperature_inside(&rc, &s, of_b, 1, &at, &message));
            CHECK_REL(at.temperature / heat, below[i].rise[k - 1][of_b], 5e-4, "below, %d %d",
                      (int)k, j);
        }
    }
}

/* Exchanged bodies: what was A's is B's, to rounding; the sum is the friction power. */
TEST(each_body_has_its_heat)
{
    rb_rolling_case rc = rb_rolling_case_defaults(), other;
    rc.formulation = RB_STEADY;
    rc.a.support = RB_BEM_HALFPLANE;
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    rc.elastic_b = 1;
    rc.approach = NAN;
    rc.load = 500.0;
    rc.mu = 0.3;
    rc.creep = 0.02;
    rc.contact_elements = 40;
    rc.speed = 200.0;
    rc.heat_a = (rb_rolling_heat){50.0, 3.77, 0.0};
    rc.heat_b = (rb_rolling_heat){0.31, 2.0, 0.0};
    other = rc;
    other.creep = -rc.creep;
    other.heat_a = rc.heat_b;
    other.heat_b = rc.heat_a;
    rb_rolling_solution s = {0}, t = {0};
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_OK);
    CHECK_STATUS(rb_rolling_solve(&other, &t, &message), RB_OK);
    CHECK_REL(s.heat_into_a + s.heat_into_b, rc.speed * s.dissipation, 1e-12, "all of it");
    CHECK_REL(t.heat_share_a, s.heat_into_b / (s.heat_into_a + s.heat_into_b), 1e-10, "shares");
    for (int k = 0; k < 9; k++) {
        rb_rolling_stress a = {.x = -2.0 + 0.4 * k, .y = 0.05 * k * k}, b = a;
        b.y = -a.y;
        CHECK_STATUS(rb_rolling_temperature_inside(&rc, &s, 0, 1, &a, &message), RB_OK);
        CHECK_STATUS(rb_rolling_temperature_inside(&other, &t, 1, 1, &b, &message), RB_OK);
        CHECK_REL(b.temperature, a.temperature, 1e-9, "point %d", k);
    }
    for (int i = 0; i < s.n; i += 7) { /* the surface is that of (T1) */
        rb_rolling_stress a = {.x = s.x[i]};
        CHECK_STATUS(rb_rolling_temperature_inside(&rc, &s, 0, 1, &a, &message), RB_OK);
        CHECK_REL(a.temperature, s.temperature[i], 1e-9, "element %d", i);
    }
    rb_rolling_solution_free(&s);
    rb_rolling_solution_free(&t);
    rc.heat_b.conductivity = 0.0; /* insulated: A takes all */
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_OK);
    CHECK_ABS(s.heat_share_a, 1.0, 0.0, "insulated B");
    rc.heat_a.temperature = 20.0; /* conduction adds: no share of friction alone */
    rc.heat_b = (rb_rolling_heat){0.31, 2.0, 0.0};
    CHECK_STATUS(rb_rolling_solve(&rc, &t, &message), RB_OK);
    assert_true(isnan(t.heat_share_a) && t.heat_into_a < s.heat_into_a);
    rb_rolling_solution_free(&s);
    rb_rolling_solution_free(&t);
}

/* ---- An elliptic source ------------------------------------------------------------ */

/* Similar bodies that slide so fast that the strain does not count: H = mu p xi V. */
static rb_rolling_case sliding(double peclet, int n)
{
    rb_rolling_case rc = half_plane(RB_STEADY, n);
    set(&rc, "poisson 0.3 similar gap parabola half-width 5e-3 mu 1e-3 creep 0.1 mesh aligned "
             "slip-operator second conductivity 50 heat-capacity 3.5 temperature 0 "
             "conductivity-b 50 heat-capacity-b 3.5 temperature-b 0");
    rc.speed = peclet * 2.0 * 50.0 / 3.5 / rc.half_width;
    return rc;
}

static double closed_maximum(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    const double p0 = rb_closed_hertz_max_pressure(s->normal_load, rc->half_width);
    /* each surface passes at its own speed */
    return rb_closed_flash_temperature(
        rc->mu * p0 * fabs(rc->creep) * rc->speed, rc->half_width, rc->speed,
        sqrt(rc->heat_a.conductivity * rc->heat_a.heat_capacity * (1.0 - 0.5 * rc->creep)) +
            sqrt(rc->heat_b.conductivity * rc->heat_b.heat_capacity * (1.0 + 0.5 * rc->creep)));
}

/* The elements alone, under the heat of Hertz's pressure at their midpoints. */
TEST(element_sum_meets_the_closed_form)
{
    static const int n[] = {50, 100, 200};
    static const double error[] = {2.6e-4, 7.1e-5, 2.8e-5}; /* theory-rolling.md T3 */
    const rb_rolling_heat body = {50.0, 3.5, 0.0};
    const double speed = 1e6 * 2.0 * 50.0 / 3.5;

    for (int k = 0; k < 3; k++) {
        const double h = 2.0 / n[k];
        double warmest = 0.0;
        for (int i = 0; i < n[k]; i++) {
            double rise = 0.0;
            for (int j = 0; j < n[k]; j++) {
                const double x = (j + 0.5) * h - 1.0, from = (j - i - 0.5) * h;
                rise += sqrt(1.0 - x * x) * rb_rolling_heat_response(&body, speed, from, from + h);
            }
            warmest = fmax(warmest, rise);
        }
        const double closed = rb_closed_flash_temperature(1.0, 1.0, speed, sqrt(50.0 * 3.5));
        CHECK_TWO_DIGITS(fabs(warmest / closed - 1.0), error[k], "n = %d", n[k]);
    }
}

TEST(elliptic_source_meets_its_closed_form)
{
    static const int n[] = {50, 100, 200, 400};
    static const double error[] = {4.6e-4, 1.6e-4, 5.3e-5, 1.8e-5}; /* theory-rolling.md T3 */

    for (int k = 0; k < 4; k++) {
        const rb_rolling_case rc = sliding(1e6, n[k]);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_TWO_DIGITS(fabs(s.max_temperature / closed_maximum(&rc, &s) - 1.0), error[k],
                         "n = %d", n[k]);
        CHECK_ABS(s.max_temperature_at / rc.half_width, -0.65223, 40.0 / gsl_pow_2(n[k]),
                  "n = %d: its place", n[k]);
        CHECK_REL(s.peclet, 1e6, 1e-3, "Peclet number");
    }
}

/* Heat that spreads along the surface counts by 6 % at Pe = 1 and less than 1e-3 from 10
 * on. */
TEST(high_peclet_number_is_a_limit)
{
    static const double peclet[] = {100.0, 10.0, 1.0}, bound[] = {3e-5, 1e-3, 0.08};

    for (int k = 0; k < 3; k++) {
        const rb_rolling_case rc = sliding(peclet[k], 200);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(s.max_temperature, closed_maximum(&rc, &s), bound[k], "Pe = %g", peclet[k]);
    }
}

/* All meshes give the same, to their order. */
TEST(meshes_agree)
{
    static const rb_rolling_mesh_kind mesh[] = {RB_MESH_UNIFORM, RB_MESH_FITTED};

    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = sliding(5e3, 200);
        rc.mesh = mesh[k];
        rc.slip_operator = RB_SLIP_UPSTREAM;
        OWNED(rb_rolling_solution) s = solved(&rc);
        double power = 0.0, column[1000];
        CHECK_REL(s.max_temperature, closed_maximum(&rc, &s), 3e-3, "mesh %d", mesh[k]);
        assert_true(s.n < 1000);
        rb_rolling_friction_power(&s, column);
        for (int i = 0; i < s.n; i++)
            power += column[i] * s.h[i];
        CHECK_REL(power, s.dissipation, 1e-12, "mesh %d: all power is heat", mesh[k]);
    }
}

/* ---- Two bodies -------------------------------------------------------------------- */

TEST(surfaces_in_contact_are_equally_warm)
{
    rb_rolling_case rc = sliding(2000.0, 100);
    rc.heat_b = (rb_rolling_heat){200.0, 2.4, 0.0};
    rb_rolling_solution s = solved(&rc);
    double rise = 0.0;
    for (int i = 0; i < s.n; i++) {
        rise = fmax(rise, s.temperature[i]);
        if (s.zone[i] != RB_ZONE_SEPARATED)
            CHECK_ABS(s.temperature[i], s.temperature_b[i], 1e-11 * s.max_temperature, "element %d",
                      i);
    }
    CHECK_REL(s.max_temperature, closed_maximum(&rc, &s), 1e-3, "shares e/(e1 + e2)");
    rb_rolling_solution_free(&s);
    rc.heat_b.conductivity = 0.0; /* all of it goes into A */
    s = solved(&rc);
    CHECK_REL(s.max_temperature, closed_maximum(&rc, &s), 1e-3, "B insulates");
    rb_rolling_solution_free(&s);
}

/* Without friction: T_m in contact, and behind it each body cools to its own. */
TEST(conduction_between_bodies)
{
    rb_rolling_case rc = sliding(1e4, 200);
    set(&rc, "mu 0 creep 0 temperature 100 conductivity-b 20 heat-capacity-b 2 temperature-b 20");
    OWNED(rb_rolling_solution) s = solved(&rc);
    const double e1 = sqrt(50.0 * 3.5), e2 = sqrt(20.0 * 2.0), a = s.half_width;
    const double middle = (e1 * 100.0 + e2 * 20.0) / (e1 + e2);
    for (int i = 0; i < s.n; i++) {
        const double x = s.x[i];
        if (fabs(x) < 0.9 * a)
            CHECK_ABS(s.temperature[i], middle, 0.05, "x/a = %g", x / a);
        if (x > 1.02 * a)
            CHECK_ABS(s.temperature[i], 100.0, 1e-6, "before the contact");
        if (x < -1.02 * a) {
            const double part = 2.0 / M_PI * asin(sqrt(2.0 * a / (a - x)));
            CHECK_ABS(s.temperature[i], 100.0 + (middle - 100.0) * part, 0.6, "A behind, x/a = %g",
                      x / a);
            CHECK_ABS(s.temperature_b[i], 20.0 + (middle - 20.0) * part, 0.6, "B behind, x/a = %g",
                      x / a);
        }
    }
}

/* ---- Two speeds -------------------------------------------------------------------- */

/* Blok: each surface moves with its own speed, V (1 -+ xi/2), V their mean.  Full sliding at up to
 * xi = 2, where one of them rests: equal bodies are sqrt(2) times as warm there as the speed V of
 * both would tell. */
TEST(surfaces_have_their_own_speeds)
{
    static const double creep[] = {-2.0, -1.9, -1.0, 0.5, 1.0, 1.9, 2.0};
    for (int unlike = 0; unlike < 3; unlike++)
        for (size_t k = 0; k < sizeof creep / sizeof *creep; k++) {
            rb_rolling_case rc = sliding(1e5, 100);
            rc.creep = creep[k];
            if (unlike)
                rc.heat_b = (rb_rolling_heat){unlike > 1 ? 0.0 : 20.0, 2.0, 0.0};
            if (unlike > 1 && creep[k] == 2.0)
                continue; /* A rests, and B takes no heat */
            OWNED(rb_rolling_solution) s = solved(&rc);
            CHECK_REL(s.max_temperature, closed_maximum(&rc, &s), 2e-3, "bodies %d, creep %g",
                      unlike, creep[k]);
            for (int i = 0; i < s.n; i++)
                if (s.zone[i] != RB_ZONE_SEPARATED)
                    CHECK_ABS(s.temperature[i], s.temperature_b[i], 1e-9 * s.max_temperature,
                              "element %d", i);
            if (creep[k] != 2.0)
                continue;
            rb_rolling_case one = with(rc, "creep 0.002");
            OWNED(rb_rolling_solution) slow = solved(&one);
            if (!unlike)
                CHECK_REL(s.max_temperature / 1000.0, M_SQRT2 * slow.max_temperature, 2e-3,
                          "12754 K for 9016 K");
        }
}

/* Bodies that change places at the opposite creepage are equally warm, also where their surfaces
 * move against each other; so are those on all meshes. */
TEST(bodies_may_change_places)
{
    static const double creep[] = {0.3, 1.7, 3.0};
    for (size_t k = 0; k < sizeof creep / sizeof *creep; k++) {
        double warm[4];
        for (int j = 0; j < 4; j++) {
            rb_rolling_case rc = sliding(300.0, 120);
            const rb_rolling_heat one = {50.0, 3.5, 20.0}, other = {20.0, 2.0, 5.0};
            rc.creep = j % 2 ? -creep[k] : creep[k];
            rc.heat_a = j % 2 ? other : one;
            rc.heat_b = j % 2 ? one : other;
            if (j > 1)
                set(&rc, "mesh fitted slip-operator upstream");
            OWNED(rb_rolling_solution) s = solved(&rc);
            warm[j] = s.max_temperature;
        }
        CHECK_REL(warm[1], warm[0], 1e-6, "creep %g", creep[k]);
        CHECK_REL(warm[3], warm[2], 1e-6, "creep %g, fitted", creep[k]);
        /* where a surface hardly moves, or the other way, an edge is warmest, to which equal
         * elements come as near as half of one */
        CHECK_REL(warm[2], warm[0],
                  k == 0   ? 3e-3
                  : k == 1 ? 1e-2
                           : 5e-2,
                  "creep %g: meshes", creep[k]);
    }
}

/* What neither turns nor conducts gets warmer for ever; steps want both to pass. */
TEST(resting_surfaces_are_refused_where_nothing_takes_the_heat)
{
    rb_rolling_solution s;
    rb_rolling_case rc = with(sliding(1e4, 40), "creep 2 conductivity-b 0");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "it gets warmer for ever");
    set(&rc, "formulation transient distance 1 mesh uniform slip-operator upstream "
             "conductivity-b 50 creep 1.9999");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "of A, V = ");
    set(&rc, "creep -2.5");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "of B, V = -");
}

/* ---- Steps ------------------------------------------------------------------------- */

TEST(steps_tend_to_the_steady_state)
{
    static const int steps[] = {0, 300};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = with(sliding(1e4, 120), "mesh uniform slip-operator upstream");
        if (k > 1) /* A is the slower one */
            set(&rc, "creep 1.2 conductivity-b 20");
        OWNED(rb_rolling_solution) steady = solved(&rc);
        set(&rc, "formulation transient distance 3");
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_model) model;
        rc.steps = steps[k % 2];
        CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &message));
        CHECK_REL(h.max_temperature[h.n - 1], steady.max_temperature, 1e-2, "%d steps", h.n);
        /* it rises along the way; the peak between elements is known to 1e-5 */
        for (int i = 1; i < h.n; i++)
            assert_true(h.max_temperature[i] >= h.max_temperature[i - 1] * (1.0 - 1e-5));
        CHECK_ABS(h.max_temperature[0], 0.0, 0.0, "at rest nothing is warm");
    }
}

TEST(curve_has_the_temperature_of_its_cases)
{
    rb_rolling_case rc = sliding(500.0, 60);
    OWNED(rb_rolling_curve) curve;
    CHECK_OK(rb_rolling_curve_solve(&rc, &(rb_rolling_range){1, 0.05, 0.1, 2, RB_UNITS_MM}, &curve,
                                    &message));
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(curve.max_temperature[1], s.max_temperature, 1e-9, "last point");
}

/* Beside free rolling the power of coarse elements falls through zero: so does the heat. */
TEST(power_below_zero_heats_nothing)
{
    rb_rolling_case rc = half_plane(RB_STEADY, 20);
    set(&rc, "half-width 1 mu 1 speed 1000 conductivity 50 heat-capacity 3.5 temperature 0 "
             "conductivity-b 50 heat-capacity-b 3.5 temperature-b 0 creep -0.005");
    OWNED(rb_rolling_solution) far = solved(&rc);
    rc.creep = far.free_creepage * 0.99999;
    OWNED(rb_rolling_solution) above = solved(&rc);
    rc.creep = far.free_creepage * 1.00001;
    OWNED(rb_rolling_solution) below = solved(&rc);
    assert_true(above.dissipation > 0.0 && below.dissipation < 0.0);
    assert_true(above.max_temperature > 0.0 && above.max_temperature < 1e-3 * far.max_temperature);
    CHECK_ABS(below.max_temperature, 0.0, 0.0, "without heat");
}

/* ---- Without, and refused ---------------------------------------------------------- */

TEST(other_cases_have_no_temperature)
{
    rb_rolling_case rc = with(sliding(500.0, 60), "conductivity none");
    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_null(s.temperature);
    assert_null(s.temperature_b);
    assert_true(isnan(s.max_temperature) && isnan(s.peclet));
}

TEST(meaningless_cases_are_refused)
{
    const rb_rolling_case good = sliding(500.0, 60);
    rb_rolling_case bad[7];
    for (int k = 0; k < 7; k++)
        bad[k] = good;
    bad[0].speed = 0.0;
    bad[1].heat_a.heat_capacity = 0.0;
    set(&bad[2], "formulation static slip-operator upstream");
    bad[3].a.layer = 1.0;
    bad[4].heat_b.conductivity = -1.0;
    bad[5].heat_b.temperature = NAN;
    set(&bad[6], "contact-elements 5000 conductivity-b 40");
    static const char *const words[] = {"--speed",     "heat capacity",  "bodies that roll",
                                        "homogeneous", "conductivity-b", "temperature-b",
                                        "4000"};
    for (int k = 0; k < 7; k++) {
        CHECK_SAYS(rb_rolling_case_check(&bad[k], &message), RB_EINVAL, words[k]);
    }
}

/* Step by step heat goes along the depth only: a slow case is refused, not approximated. */
TEST(slow_steps_are_refused)
{
    rb_rolling_case rc = sliding(5.0, 60);
    OWNED(rb_rolling_solution) s;
    set(&rc, "mesh uniform slip-operator upstream formulation transient distance 1");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, "diffusivity");
}

/* ---- Parts ------------------------------------------------------------------------- */

/* A case of steps that is solved without them has no heat behind it. */
TEST(without_steps_no_heat_is_known)
{
    rb_rolling_case rc = with(warm_sliding(RB_TRANSIENT), "distance 1");
    OWNED(rb_rolling_solution) s;
    CHECK_OK(rb_rolling_solve_between(&rc, -1.3, 1.3, &s, NULL));
    CHECK_ABS(s.max_temperature, 0.0, 0.0, "nothing is warm");
}

int main(void)
{
    gsl_set_error_handler_off();
    return run_all_tests(NULL, NULL);
}
