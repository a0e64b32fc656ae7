/* Viscoelastic half-planes and layers in rolling contact: Hunter's exact solution, limits
 * of speed, figures of CONTACT, asymptotes of thick and thin layers. */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_expint.h>

static double moment_of(const rb_rolling_solution *s)
{
    double M = 0.0;
    for (int i = 0; i < s->n; i++)
        M += s->x[i] * s->p[i] * s->h[i];
    CHECK_ABS(s->resistance_moment, M, 1e-13 * s->normal_load * s->half_width, "resistance_moment");
    return M;
}

/* What creepage and resistance feed is lost in friction and in the bodies. */
static void check_energy(const rb_rolling_case *rc, const rb_rolling_solution *s, double bound,
                         const char *what)
{
    const double R = 1.0 / (1.0 / rc->a.radius + 1.0 / rc->b.radius);
    const double fed = moment_of(s) / R - s->creepage * s->tangential_load;
    CHECK_REL(s->dissipation + s->hysteresis, fed, bound, "%s: energy", what);
    CHECK_REL(s->resistance_ratio, moment_of(s) / (s->normal_load * R), 1e-13, "%s", what);
    CHECK_REL(s->hysteresis_factor,
              1.5 * M_PI * moment_of(s) /
                  (s->normal_load * 0.5 * (s->contact_to - s->contact_from)),
              1e-12, "%s: Tabor's factor", what);
}

/* A frictionless cylinder R = 100 with a_g = 1 on a rigid plane, one relaxation time. */
static rb_rolling_case hunter(double f, double length, int n)
{
    rb_rolling_case rc =
        rolling_case("support halfplane formulation steady contact-elements %d radius 100 "
                     "young 1000 poisson 0.3 speed 1 half-width 1 gap parabola mu 0 creep 0 "
                     "mesh fitted",
                     n);
    rc.a.memory = (rb_rolling_memory){1, {length}, {f}};
    return rc;
}

/* docs/theory-bodies.md (V3): f, V tau/a_g, leading and trailing edge, p_max/p0g, M/(P a_g). The
 * formulas were first evaluated with p_max/p0g = 0.3115114 in the last row; the maximum
 * of V3's pressure is 0.4428963, which the solution meets as it does in the other rows. */
static const double rows[8][6] = {
    {1, 0.1, 1.4135769, -1.3649042, 0.7078300, 0.0473514},
    {1, 1, 1.3698037, -1.0148946, 0.8318884, 0.2621595},
    {1, 3, 1.2558838, -0.8442050, 0.9553298, 0.2462507},
    {1, 10, 1.1283544, -0.8863649, 0.9930890, 0.1334710},
    {4, 0.1, 2.2355433, -2.1566171, 0.4474386, 0.0778542},
    {4, 1, 2.1922928, -1.5023576, 0.5770909, 0.5920417},
    {4, 10, 1.5142122, -0.5617763, 0.9747033, 0.5284636},
    {10, 1, 3.2840158, -2.4506076, 0.4428963, 0.7617544},
};

TEST(hunters_solution_is_met)
{
    for (int k = 0; k < 8; k++) {
        const double *row = rows[k];
        rb_rolling_case rc = hunter(row[0], row[1], 200);
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double E = rc.a.young / (1.0 - gsl_pow_2(rc.a.poisson));
        const double a = 0.5 * (row[2] - row[3]);
        CHECK_ABS(s.contact_to, row[2], 1e-3 * a, "row %d: leading edge", k);
        CHECK_ABS(s.contact_from, row[3], 1e-3 * a, "row %d: trailing edge", k);
        CHECK_REL(s.max_pressure, row[4] * E / 200.0, 2e-3, "row %d: p_max", k);
        CHECK_ABS(moment_of(&s) / s.normal_load, row[5], 1e-4, "row %d: M/P", k);
        check_energy(&rc, &s, 1e-3, "Hunter");
    }
}

/* Four times the elements, a sixteenth of the error of M or less, in every row and on
 * both meshes that meet the edges; the rows have seven digits.  There is an order only
 * where the elements resolve V tau/(1 + f) behind the leading edge: the short memories
 * begin with more of them. */
TEST(the_moment_is_of_second_order)
{
    static const int coarse[8] = {100, 50, 50, 50, 100, 50, 50, 50};
    for (int k = 0; k < 16; k++) {
        const double *want = rows[k / 2];
        double error[2];
        for (int j = 0; j < 2; j++) {
            rb_rolling_case rc = hunter(want[0], want[1], coarse[k / 2] << 2 * j);
            rc.mesh = k % 2 ? RB_MESH_ALIGNED : RB_MESH_FITTED;
            OWNED(rb_rolling_solution) s = solved(&rc);
            error[j] = fabs(s.resistance_moment / s.normal_load - want[5]);
        }
        CHECK_ABS(error[1], 0.0, error[0] / 16.0 + 6e-8, "row %d, mesh %d", k / 2, k % 2);
    }
}

/* Lemke in both forms, Newton with a matrix and without on equal elements; 4: the fitted
 * mesh and the solver of the case. */
static void choose_solver(int k, rb_rolling_case *rc)
{
    if (k == 4)
        return;
    set(rc, "mesh uniform zone 2.5 solver %s lcp-form %s", k < 2 ? "lemke" : "newton",
        k == 1 ? "kwak" : "pivoted");
    if (k == 3)
        rc->contact_elements = 1600;
}

/* Nothing drives the axle: Q = -M/R, whichever solver. */
TEST(a_free_axle_is_turned_by_friction)
{
    double xi[5];
    for (int k = 0; k < 5; k++) {
        rb_rolling_case rc = with(hunter(2.0, 0.8, 60), "mu 0.3 creep nan free-axle");
        choose_solver(k, &rc);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.tangential_load, -moment_of(&s) / rc.a.radius, 1e-10 * rc.mu * s.normal_load,
                  "solver %d: Q = -M/R", k);
        if (k > 2)
            check_energy(&rc, &s, 1e-3, "free axle");
        assert_true(s.residual < 1e-9);
        xi[k] = s.creepage;
    }
    CHECK_REL(xi[1], xi[0], 1e-9, "Kwak's form");
    CHECK_REL(xi[2], xi[0], 1e-9, "Newton");
    CHECK_REL(xi[3], xi[4], 2e-3, "many elements against fitted ones");
}

/* Rollers of unequal radii: equilibrium about each axle by itself, whichever is larger.
 * What both drives give is the resistance of both curvatures. */
TEST(only_the_axle_of_a_is_free)
{
    for (int k = 0; k < 4; k++) {
        OWNED(rb_rolling_curve) c;
        rb_rolling_case rc = hunter(2.0, 0.8, 60);
        const double R = k % 2 ? 20.0 : 500.0;
        const rb_rolling_range range = {RB_OVER_SPEED, 1.0, 2.0, 2, RB_UNITS_MM};
        set(&rc, "mu 0.3 creep nan free-axle young-b %g radius-b %g", k < 2 ? 1e5 : 1000.0, R);
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double M = moment_of(&s), Q = s.tangential_load;
        CHECK_MAX(-M, 0.0, "case %d: it resists", k);
        CHECK_ABS(s.torque_a, 0.0, 1e-10 * s.normal_load * rc.a.radius, "case %d: A", k);
        CHECK_REL(Q, -M / rc.a.radius, 1e-9, "case %d: Q = -M/R_A", k);
        CHECK_REL(s.torque_b, M - Q * R, 1e-12, "case %d: B", k);
        CHECK_REL(s.torque_b / R, M * (1.0 / R + 1.0 / rc.a.radius), 1e-9, "case %d: B drives both",
                  k);
        CHECK_OK(rb_rolling_curve_solve(&rc, &range, &c, &message));
        CHECK_ABS(c.torque_a[0], 0.0, 1e-10 * s.normal_load * rc.a.radius, "curve");
        CHECK_REL(c.torque_b[0], s.torque_b, 1e-6, "case %d: curve", k);
    }
}

/* Over the speed M/(P R) rises from nothing, has one maximum and falls; each point is the
 * case at that speed. */
TEST(resistance_has_a_maximum_over_the_speed)
{
    enum { POINTS = 9 };
    rb_rolling_curve c;
    rb_rolling_case rc = hunter(1.0, 1.0, 40);
    int turns = 0;
    CHECK_OK(rb_rolling_curve_solve(
        &rc, &(rb_rolling_range){RB_OVER_SPEED, 1e-2, 1e2, POINTS, RB_UNITS_MM}, &c, &message));
    assert_int_equal(c.n, POINTS);
    for (int k = 1; k + 1 < POINTS; k++) {
        CHECK_REL(c.speed[k] / c.speed[k - 1], sqrt(10.0), 1e-12, "point %d", k);
        turns += c.resistance_ratio[k] > c.resistance_ratio[k - 1] &&
                 c.resistance_ratio[k] > c.resistance_ratio[k + 1];
    }
    assert_int_equal(turns, 1);
    CHECK_REL(c.resistance_moment[4], 0.2621595 * c.normal_load[4], 1e-5, "Hunter");
    CHECK_REL(c.hysteresis[4], c.resistance_moment[4] / rc.a.radius, 1e-3, "energy");
    rb_rolling_curve_free(&c);
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){RB_OVER_SPEED, 0.0, 1.0, 3, RB_UNITS_MM},
                               &c, &message),
        RB_EINVAL);
    rc.a.memory.n = 0;
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, &(rb_rolling_range){RB_OVER_SPEED, 1.0, 2.0, 3, RB_UNITS_MM},
                               &c, &message),
        RB_EINVAL);
}

/* Slow: Hertz with the rubbery modulus; fast: with the glassy one. */
TEST(speed_has_its_limits)
{
    const double f = 3.0;
    for (int fast = 0; fast < 2; fast++) {
        rb_rolling_case rc = hunter(f, fast ? 1e5 : 1e-5, 100);
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double wide = fast ? 1.0 : sqrt(1.0 + f);
        CHECK_REL(s.half_width, wide, 1e-3, "fast %d", fast);
        CHECK_REL(s.max_pressure, 2.0 * s.normal_load / (M_PI * wide), 2e-3, "fast %d", fast);
        const double L = rc.a.memory.time[0],
                     moment =
                         fast ? f / (2.0 * L) * (log(2.0 * L) + 0.25 - M_EULER) : f * L / (1.0 + f);
        CHECK_REL(moment_of(&s) / s.normal_load, moment, 2e-2, "fast %d", fast);
    }
}

/* ---- CONTACT's visc_cylindr: two cylinders on a grid of 99 elements, x0 = -0.08 ---- */

typedef struct {
    double tau, xi, p_max, approach, power;
    int contact, stick;
} contact_row;

static rb_rolling_case two_cylinders(double tau)
{
    rb_rolling_case rc = rolling_case("support halfplane radius 100 young %g poisson 0.4 "
                                      "datum 1000 speed 1000 load 600 force-ratio -0.6 "
                                      "gap parabola formulation steady",
                                      2.0 * 1143.0 * 1.4);
    rc.a.memory = (rb_rolling_memory){1, {tau}, {1.0}};
    rc.b = rc.a;
    rc.elastic_b = 1;
    return rc;
}

TEST(contacts_figures_are_met)
{
    static const contact_row want[4] = {{0.009, 1.36501e-2, 78.737, 2.36732, 913.55, 62, 37},
                                        {2.0, 9.9451e-3, 85.299, 1.43536, 1010.3, 56, 35},
                                        {1e-12, 1.37836e-2, 60.314, 2.50844, 1437.85, 80, 51},
                                        {INFINITY, 9.7916e-3, 85.288, 1.32372, NAN, 56, 36}};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = two_cylinders(want[k].tau);
        if (isinf(want[k].tau)) /* its elastic case */
            rc.a.memory.n = rc.b.memory.n = 0;
        rb_rolling_mesh mesh;
        OWNED(rb_rolling_bodies) bodies;
        OWNED(rb_contact_problem) problem;
        OWNED(rb_contact_state) s;
        CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -8.0, 7.84, &mesh, NULL));
        rb_rolling_mesh_free(&mesh);
        rb_rolling_case grid = rc;
        grid.contact_elements = 99;
        CHECK_OK(rb_rolling_mesh_uniform(&grid, NULL, -8.0, 7.84, &mesh, NULL));
        CHECK_OK(rb_rolling_bodies_create(&grid, NULL, &mesh, &bodies, NULL));
        CHECK_OK(rb_rolling_problem_create(&grid, &mesh, &bodies, NULL, &problem, NULL));
        CHECK_OK(rb_contact_state_alloc(99, &s));
        CHECK_OK(rb_rolling_problem_solve(&problem, &grid, 0, &s, NULL));
        int contact = 0, stick = 0;
        double power = 0.0, p_max = 0.0;
        for (int i = 0; i < 99; i++) {
            contact += s.zone[i] != RB_ZONE_SEPARATED;
            stick += s.zone[i] == RB_ZONE_STICK;
            power += fabs(s.q[i] * s.lambda[i]);
            p_max = fmax(p_max, s.p[i]);
        }
        CHECK_REL(s.xi, want[k].xi, 2e-4, "tau %g: creepage", want[k].tau);
        CHECK_REL(p_max, want[k].p_max, 5e-4, "tau %g: p_max", want[k].tau);
        CHECK_REL(s.delta, want[k].approach, 2e-4, "tau %g: approach", want[k].tau);
        if (!isnan(want[k].power))
            CHECK_REL(power * grid.speed, want[k].power, 1e-3, "tau %g: power", want[k].tau);
        assert_int_equal(contact, want[k].contact);
        assert_int_equal(stick, want[k].stick);
        rb_rolling_mesh_free(&mesh);
    }
}

/* ---- The datum of bodies with memory (V2) ------------------------------------------- */

/* G(z) = Re[exp(iz) E1(iz)] by cosine and sine integrals, and as CONTACT's strip has it:
 * (pi/2) int_0^w (Struve's H0 - Y0) dt - ln 2w - gamma, w = z/2, of which its first terms for
 * short memories are known. */
TEST(the_memory_of_a_datum_has_closed_forms)
{
    static const struct {
        double z, G;
    } want[] = {{0.1, 1.8660764}, {1.0, 0.3433780}, {10.0, 0.0094885}};
    for (size_t k = 0; k < sizeof want / sizeof *want; k++)
        CHECK_ABS(rb_bem_memory_of_datum(want[k].z), want[k].G, 5e-8, "G(%g)", want[k].z);
    for (double z = 1e-7; z < 1e5; z *= 3.0) {
        const double s2 = 1.0 / (z * z), far = s2 * (1.0 - s2 * (6.0 - 120.0 * s2)),
                     G = -gsl_sf_Ci(z) * cos(z) - (gsl_sf_Si(z) - M_PI_2) * sin(z);
        CHECK_REL(rb_bem_memory_of_datum(z), z > 1e3 ? far : G, 1e-10 + 1e-15 * z * z * (z < 1e3),
                  "G(%g)", z);
        /* ln(2/z) - gamma and 2 (1/z)^2 - 36 (1/z)^4 */
        if (z < 1e-6)
            CHECK_ABS(rb_bem_memory_of_strip(z), -log(z) - M_EULER, 10.0 * z, "strip, %g", z);
        if (z > 1e3)
            CHECK_REL(rb_bem_memory_of_strip(z), 2.0 * s2 * (1.0 - 18.0 * s2),
                      4e3 * s2 * s2 + 1e-12, "strip, %g", z);
    }
}

/* Under a given approach the load rises from the rubbery to the glassy one with the speed
 * (fretting.md 8: figures of a prototype). */
TEST(the_load_rises_with_the_speed)
{
    static const struct {
        double V, one, two;
    } want[] = {{1e-3, 175.582, 140.466}, {1.0, 176.905, 140.959}, {3.0, 184.477, NAN},
                {10.0, 210.802, 150.473}, {30.0, 248.46, NAN},     {100.0, 293.64, 168.447},
                {300.0, 324.36, NAN},     {1e3, 341.555, 209.059}, {1e4, 350.104, 293.272},
                {1e5, 351.057, 341.505},  {1e6, 351.153, NAN},     {1e7, 351.163, 351.057}};
    for (size_t k = 0; k < sizeof want / sizeof *want; k++)
        for (int two = 0; two < 2; two++) {
            if (two && isnan(want[k].two))
                continue;
            rb_rolling_case rc = rolling_case(
                "support halfplane young 3200 poisson 0.4 radius 100 gap parabola mu 0.3 "
                "formulation steady force-ratio -0.6 approach 0.5 mesh fitted "
                "contact-elements 100 relaxation-time %s relaxation-ratio %s "
                "speed %g similar",
                two ? "0.01,1" : "1", two ? "1,0.5" : "1", want[k].V);
            rc.b.radius = 100.0;
            OWNED(rb_rolling_solution) s = solved(&rc);
            CHECK_REL(s.normal_load, two ? want[k].two : want[k].one, 2e-5, "%d terms, V = %g",
                      1 + two, want[k].V);
        }
}

/* ---- Layers ------------------------------------------------------------------------ */

static rb_rolling_case layered(double thickness, double nu, int n)
{
    rb_rolling_case rc = hunter(0.0, 1.0, n);
    rc.a.memory.n = 0;
    set(&rc, "poisson %g layer-thickness %g", nu, thickness);
    return rc;
}

/* P (1 - c1 a^2/d^2) = pi E* a^2/(4R) to (a/d)^4 */
TEST(thick_layers_have_their_series)
{
    static const double nu[2] = {0.3, 0.5}, c1[2] = {0.715969, 1.023603};
    for (int k = 0; k < 2; k++)
        for (int j = 1; j <= 2; j++) {
            const double ratio = 0.1 * j;
            rb_rolling_case rc = layered(1.0 / ratio, nu[k], 200);
            OWNED(rb_rolling_solution) s = solved(&rc);
            const double a = s.half_width, d = rc.a.layer, E = rc.a.young / (1.0 - nu[k] * nu[k]),
                         hertz = M_PI * E * a * a / (4.0 * rc.a.radius);
            CHECK_REL(s.normal_load * (1.0 - c1[k] * a * a / (d * d)), hertz,
                      2.0 * gsl_pow_4(ratio) + 2e-4, "nu %g, a/d %g", nu[k], ratio);
        }
}

/* delta = a^2/(2R), P = 2 a^3 M/(3 R d) */
TEST(thin_layers_are_mattresses)
{
    static const double want[3] = {0.99701, 0.99910, 0.99973};
    for (int k = 0; k < 3; k++) {
        const double nu = 0.3, d = 1.0 / (5 << k);
        rb_rolling_case rc = layered(d, nu, 200);
        set(&rc, "half-width nan approach %g", 1.0 / (2.0 * rc.a.radius));
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double M = rc.a.young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
        const double ratio = s.normal_load / (2.0 * M / (3.0 * rc.a.radius * d));
        CHECK_REL(ratio, want[k], 1e-3, "a/d = %d", 5 << k);
        CHECK_ABS(ratio, 1.0, k == 2 ? 1e-3 : 5e-3, "a/d = %d: mattress", 5 << k);
    }
}

/* nu = 1/2: delta = a^2/(6R), P = 2 G a^5/(15 R d^3), which thin layers reach slowly: no
 * further from it than 1.5 times the deviations of physics P5, and less far the thinner
 * they are. */
TEST(thin_incompressible_layers_have_their_limit)
{
    static const double deviation[4] = {0.409, 0.115, 0.031, 0.006};
    double before = INFINITY;
    for (int k = 0; k < 4; k++) {
        const double d = 1.0 / (5 << k);
        rb_rolling_case rc = layered(d, 0.5, 200);
        set(&rc, "half-width nan approach %g", 1.0 / (6.0 * rc.a.radius));
        OWNED(rb_rolling_solution) s = solved(&rc);
        const double limit = 2.0 * rc.a.young / 3.0 / (15.0 * rc.a.radius * d * d * d),
                     off = fabs(s.normal_load / limit - 1.0);
        CHECK_MAX(off, 1.5 * deviation[k], "a/d = %d", 5 << k);
        CHECK_MAX(off, 0.5 * before, "a/d = %d", 5 << k);
        before = off;
    }
}

/* Elements longer than an incompressible layer is thick are refused with the number that
 * would do, which does: load to 3 % of four times as many.  A compressible layer takes
 * any. */
TEST(layers_must_be_resolved)
{
    for (int steps = 0; steps < 3; steps++) {
        rb_rolling_case rc = layered(0.05, 0.5, 24);
        rb_rolling_solution s[2];
        int enough = 0;
        set(&rc, "half-width nan approach %g mesh uniform formulation %s increments %d creep %g",
            1.0 / (6.0 * rc.a.radius), steps == 1 ? "static" : "steady", steps == 1 ? 3 : 1,
            steps == 1 ? NAN : 0.0);
        rb_rolling_curve curve;
        CHECK_STATUS(steps == 2
                         ? rb_rolling_curve_solve(
                               &rc, &(rb_rolling_range){RB_OVER_CREEP, 0.0, 1e-3, 2, RB_UNITS_MM},
                               &curve, &message)
                         : rb_rolling_solve(&rc, &s[0], &message),
                     RB_EINVAL);
        if (steps == 2)
            rb_rolling_curve_free(&curve);
        const char *take = NOT_NULL(strstr(message.text, "take "));
        assert_int_equal(sscanf(take, "take %d contact elements", &enough), 1);
        for (int j = 0; j < 2; j++) {
            rc.contact_elements = enough << 2 * j;
            CHECK_OK(rb_rolling_solve(&rc, &s[j], &message));
        }
        CHECK_REL(s[0].normal_load, s[1].normal_load, 0.03, "%d elements", enough);
        rb_rolling_solution_free(&s[0]);
        rb_rolling_solution_free(&s[1]);
        set(&rc, "poisson 0.3 contact-elements 24");
        CHECK_OK(rb_rolling_solve(&rc, &s[0], &message));
        rb_rolling_solution_free(&s[0]);
    }
}

/* Where elements are so long that no solver gets anywhere, that is the reason given. */
TEST(hopeless_layers_are_refused)
{
    rb_rolling_case rc = layered(3e-4, 0.5, 20);
    OWNED(rb_rolling_solution) s;
    set(&rc, "radius 50 young 94500 half-width nan approach 1e-4 gap exact mu 0.3 creep 1e-3 "
             "mesh uniform zone 0.4");
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL,
               "may not be longer than the thickness");
}

/* Free rolling of a covered roll, docs/physics: xi R/c at nu = 0.5, c/d = 1. */
TEST(incompressible_covers_stretch_in_the_nip)
{
    static const double mu[2] = {0.1, 0.3}, want[2] = {0.16692, 0.16488};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = layered(2.0, 0.5, 100);
        set(&rc, "half-width 2 mu %g creep nan force 0", mu[k]);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.creepage * rc.a.radius / 2.0, want[k], 4e-3 * want[k] + 4e-4, "mu = %g", mu[k]);
    }
}

/* A layer on a half-plane of its own material is that half-plane. */
TEST(a_layer_of_the_same_material_is_none)
{
    rb_rolling_solution s[2];
    rb_rolling_case rc = with(layered(0.0, 0.3, 60), "mu 0.3 creep nan creep-ratio 0.5");
    CHECK_OK(rb_rolling_solve(&rc, &s[0], NULL));
    set(&rc, "layer-thickness 0.7 base-young %g base-poisson %g", rc.a.young, rc.a.poisson);
    CHECK_OK(rb_rolling_solve(&rc, &s[1], NULL));
    CHECK_REL(s[1].tangential_load, s[0].tangential_load, 1e-8, "Q");
    CHECK_REL(s[1].approach, s[0].approach, 1e-8, "approach");
    CHECK_REL(s[1].max_pressure, s[0].max_pressure, 1e-8, "p0");
    rb_rolling_solution_free(&s[0]);
    rb_rolling_solution_free(&s[1]);
}

/* ---- All solvers, and many elements ------------------------------------------------ */

/* Lemke in both forms and Newton on the same equal elements; the transforms against
 * fitted ones. */
TEST(all_solvers_agree)
{
    for (int kind = 0; kind < 2; kind++) {
        double Q[5], M[5];
        for (int k = 0; k < 5; k++) {
            rb_rolling_case rc = kind ? layered(1.5, 0.45, 60) : hunter(2.0, 0.8, 60);
            set(&rc, "mu 0.3 creep nan creep-ratio 0.7");
            choose_solver(k, &rc);
            OWNED(rb_rolling_solution) s = solved(&rc);
            assert_int_equal(s.large, k == 3);
            Q[k] = s.tangential_load;
            M[k] = moment_of(&s);
        }
        for (int k = 1; k < 3; k++)
            CHECK_REL(Q[k], Q[0], 1e-9, "kind %d, solver %d", kind, k);
        CHECK_REL(Q[3], Q[4], 5e-3, "kind %d, many elements", kind);
        CHECK_ABS(M[3], M[4], 3e-3 * fabs(M[4]) + 2e-3, "kind %d, many elements", kind);
    }
}

/* What friction cannot turn, and what does not go with it. */
TEST(bad_axles_are_refused)
{
    static const char *const word[4] = {"more than friction carries", "it needs steady rolling",
                                        "expected mu > 0", "excludes"};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = hunter(2.0, 0.8, 40);
        OWNED(rb_rolling_solution) s = {0};
        set(&rc, "creep %g free-axle", k == 3 ? 0.001 : NAN);
        rc.mu = k == 2 ? 0.0 : k == 0 ? 1e-3 : 0.3;
        if (k == 1) {
            rc.formulation = RB_STATIC;
            rc.a.memory.n = 0;
            rc.mesh = RB_MESH_UNIFORM;
        }
        CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, word[k]);
    }
}

TEST(bad_bodies_are_refused)
{
    const struct {
        double time, ratio, speed, layer;
        rb_bem_support support;
        rb_rolling_formulation formulation;
        const char *word;
    } bad[] = {
        {-1, 1, 1, 0, RB_BEM_HALFPLANE, RB_STEADY, "relaxation-time: expected a number > 0"},
        {1, -1, 1, 0, RB_BEM_HALFPLANE, RB_STEADY, "relaxation-ratio: expected a number >= 0"},
        {1, 1, 0, 0, RB_BEM_HALFPLANE, RB_STEADY, "speed"},
        {1, 1, 1, 0, RB_BEM_ARC, RB_STEADY, "halfplane"},
        {1, 1, 0, 0, RB_BEM_HALFPLANE, RB_TRANSIENT, "speed"},
        {1, 1, 1, -1, RB_BEM_HALFPLANE, RB_STEADY, "thickness"},
        {1, 1, 1, 2, RB_BEM_ARC, RB_STEADY, "halfplane"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = hunter(bad[k].ratio, bad[k].time, 60);
        rc.speed = bad[k].speed;
        rc.a.layer = bad[k].layer;
        rc.a.support = bad[k].support;
        rc.formulation = bad[k].formulation;
        CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, bad[k].word);
    }
}

RUN_TESTS(NULL, NULL)
