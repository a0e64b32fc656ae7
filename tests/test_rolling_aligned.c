/* Equal elements aligned with the contact and the second-order slip operator: Carter's
 * law, its dissipation, many elements, bodies with memory, what is refused. */
#include "cases.h"
#include "rolling/case/closed_forms.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* nu = 1/2 on a rigid plane is uncoupled, a = 0.05 on R = 50. */
static rb_rolling_case carter(int n)
{
    rb_rolling_case rc = half_plane(RB_STEADY, n);
    set(&rc, "poisson 0.5 half-width 0.05 gap parabola mesh aligned slip-operator second");
    return rc;
}

/* Errors of physics.md P1.2, within a factor of 1.2; the largest of the three at each n. */
TEST(carters_law_has_second_order)
{
    static const double ratio[3] = {0.2, 0.5, 0.8};
    static const double error[3][4] = {{7.5e-5, 1.9e-5, 4.7e-6, 1.2e-6},
                                       {1.3e-4, 3.2e-5, 8.1e-6, 2.0e-6},
                                       {2.2e-4, 5.6e-5, 1.4e-5, 3.5e-6}};
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 4; j++) {
            const int n = 50 << j;
            rb_rolling_case rc = with(carter(n), "creep-ratio %g", ratio[k]);
            OWNED(rb_rolling_solution) s = solved(&rc);
            CHECK_ABS(s.force_ratio, rb_closed_carter_force_ratio(ratio[k]), 1.2 * error[k][j],
                      "s = %g, n = %d", ratio[k], n);
            assert_int_equal(s.contact, n);
            CHECK_REL(s.half_width, 0.05, 1e-4, "half-width");
        }
}

/* The first order of the upstream difference on the same elements. */
TEST(the_upstream_difference_has_first_order)
{
    double error[2];
    for (int j = 0; j < 2; j++) {
        rb_rolling_case rc = with(carter(100 << j), "creep-ratio 0.5 slip-operator upstream");
        OWNED(rb_rolling_solution) s = solved(&rc);
        error[j] = fabs(s.force_ratio + 0.75);
    }
    CHECK_REL(error[0], 2.7e-3, 0.05, "n = 100");
    CHECK_REL(error[0] / error[1], 2.0, 0.05, "order");
}

TEST(a_given_force_finds_its_creepage)
{
    static const double error[3] = {1.3e-4, 2.7e-5, 1.1e-5};
    for (int j = 0; j < 3; j++) {
        rb_rolling_case rc = with(carter(50 << j), "force-ratio -0.6");
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.creep_ratio, 1.0 - sqrt(0.4), 1.2 * error[j], "n = %d", 50 << j);
        CHECK_ABS(s.force_ratio, -0.6, 1e-12, "the force itself");
    }
}

/* Slip and traction belong to the same point: no mean of two tractions. */
TEST(dissipation_balances_the_creepage)
{
    static const double error[3] = {1.3e-3, 2.7e-4, 9e-5};
    for (int j = 0; j < 3; j++) {
        rb_rolling_case rc = with(carter(50 << j), "creep-ratio 0.5");
        OWNED(rb_rolling_solution) s = solved(&rc);
        double power[400], sum = 0.0;
        assert_true(s.n <= 400);
        rb_rolling_friction_power(&s, power);
        for (int i = 0; i < s.n; i++)
            sum += power[i] * s.h[i];
        CHECK_REL(s.dissipation, -s.creepage * s.tangential_load, error[j], "n = %d", 50 << j);
        CHECK_REL(sum, s.dissipation, 1e-12, "power density, n = %d", 50 << j);
    }
}

TEST(transforms_reach_seven_digits)
{
    const int n = getenv("ROLLBEM_TEST_ALL") ? 100000 : 20000;
    rb_rolling_case rc = with(carter(n), "creep-ratio 0.5");
    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_true(s.large);
    CHECK_ABS(s.force_ratio, -0.75, 1e-8, "n = %d", n);
}

/* f = 4, V tau = a_g, xi R/(mu a_g) = 0.5, similar bodies: -0.390667 on elements aligned
 * to the exact edges.  Behind the leading edge the pressure changes within L/(1 + f), a
 * fifth of a_g, which the estimate of the edge has to resolve. */
TEST(bodies_with_memory_converge_too)
{
    static const double error[3] = {2e-3, 4e-4, 6e-5};
    for (int j = 0; j < 3; j++) {
        rb_rolling_case rc = carter(100 << j);
        const double half_of_glassy = 0.5 * rc.mu * rb_rolling_derive(&rc).strain;
        set(&rc, "relaxation-time 0.05 relaxation-ratio 4 speed 1 creep-ratio nan creep %g",
            half_of_glassy);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.force_ratio, -0.390667, error[j], "n = %d", 100 << j);
    }
}

/* Bentall and Johnson, beta = 0.3, mu = beta/2: xi R/(beta a) = -0.715826. */
TEST(dissimilar_bodies_roll_freely)
{
    rb_rolling_case rc = carter(100);
    rc.a.poisson = 2.0 / 7.0; /* (1-2nu)/(2(1-nu)) = 0.3 */
    set(&rc, "mu 0.15 force 0");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.creepage * rc.a.radius / (0.3 * 0.05), -0.715826, 2e-4, "n = 100");
}

/* Aligned and fitted elements of a wheel tend to the same force, both with second order. */
TEST(wheels_take_aligned_elements_too)
{
    double ratio[3];
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = carter(k < 2 ? 100 << k : 200);
        set(&rc, "support hub near-field exact creep-ratio 0.5");
        if (k == 2) {
            set(&rc, "mesh fitted slip-operator upstream");
        }
        OWNED(rb_rolling_solution) s = solved(&rc);
        ratio[k] = s.force_ratio;
    }
    CHECK_ABS(ratio[0], ratio[2], 6e-5, "n = 100");
    CHECK_ABS(ratio[1], ratio[2], 2e-5, "n = 200");
}

TEST(what_cannot_be_aligned_is_refused)
{
    rb_rolling_case rc = with(carter(60), "contact-elements 8");
    CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, "aligned");
    rc = carter(60);
    rc.formulation = RB_STATIC;
    CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, "steady");
    rc = carter(60);
    rc.mesh = RB_MESH_FITTED;
    CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, "equal elements");
}

/* Where an edge jumps between two meshes, the pressure at it is no square root; the edge
 * that is told still lies before the midpoint of the first open element. */
TEST(edge_lies_before_the_first_open_midpoint)
{
    rb_rolling_case rc = rolling_case("support hub mesh aligned normals surface near-field plain "
                                      "contact-elements 25 zone 2 mu 3 approach 0.04");
    OWNED(rb_rolling_solution) s = solved(&rc);
    for (int i = 1; i + 1 < s.n; i++) {
        const int open = s.zone[i] == RB_ZONE_SEPARATED;
        if (open && s.zone[i + 1] != RB_ZONE_SEPARATED)
            CHECK_MAX(s.x[i], s.contact_from + 1e-9 * s.h[i], "left edge");
        if (open && s.zone[i - 1] != RB_ZONE_SEPARATED)
            CHECK_MAX(s.contact_to, s.x[i] + 1e-9 * s.h[i], "right edge");
    }
}

/* Nine elements in contact tell the edges that others are aligned to; with fewer they
 * stay equal ones, and that is said. */
TEST(nine_elements_tell_the_edges)
{
    int nine = 0, eight = 0;
    for (int k = 0; k < 12; k++) {
        rb_rolling_case rc = carter(13);
        const double a = rb_rolling_derive(&rc).half_width;
        int touch = 0;
        set(&rc, "creep-ratio 0.5 slip-operator upstream zone %g mesh uniform",
            (1.2 + 0.05 * k) * a);
        OWNED(rb_rolling_solution) first = solved(&rc);
        for (int i = 0; i < first.n; i++)
            touch += first.zone[i] != RB_ZONE_SEPARATED;
        rc.mesh = RB_MESH_ALIGNED;
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_int_equal(s.equal_instead, touch < 9);
        nine += touch == 9;
        eight += touch < 9;
    }
    assert_true(nine > 0 && eight > 0);
}

/* The levels before the last one tell its edges to a part of an element: it is solved
 * once and corrected in a few steps. */
TEST(many_elements_are_solved_once)
{
    rb_rolling_case rc = with(carter(30000), "creep-ratio 0.4");
    rb_rolling_case equal = rc;
    equal.mesh = RB_MESH_UNIFORM;
    rb_rolling_model model = solved_model(&equal);
    const int steps = model.iterations;
    rb_rolling_model_free(&model);
    model = solved_model(&rc);
    CHECK_MAX(model.iterations, 1.5 * steps, "steps");
    assert_int_equal(model.equal_instead, 0);
    assert_int_equal(model.mesh.n, 30000 + 8);
    rb_rolling_model_free(&model);
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_ABS(s.force_ratio, rb_closed_carter_force_ratio(0.4), 2e-9, "Q/(mu P)");
}

/* Rolling freely, the leading edge of this contact is found .0076 elements beyond that of
 * each mesh: ten meshes would not bring it to rest. */
TEST(an_edge_that_drifts_ends_the_rounds)
{
    rb_rolling_case rc = carter(6400);
    set(&rc, "support-b halfplane radius-b plane young-b 70000 poisson-b 0.3 force-ratio 0");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    assert_false(model.equal_instead);
    assert_true(model.iterations <= 9);
    CHECK_REL(model.state.xi, 1.137795e-4, 1e-6, "free creepage");
}

RUN_TESTS(NULL, NULL)
