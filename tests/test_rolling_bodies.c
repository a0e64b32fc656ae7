/* Two elastic bodies (4.5), each with its own support. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"
#include "numbers.h"

static rb_rolling_case steady_wheel(rb_bem_support support, double poisson)
{
    rb_rolling_case rc = rolling_case("poisson %g gap parabola formulation steady mesh fitted "
                                      "contact-elements 50 half-width 0.005",
                                      poisson);
    rc.a.support = support;
    return rc;
}

/* nu = 1/2 on a rigid plane and two similar cylinders of any nu are one problem,
 * Carter's. */
TEST(similar_cylinders_are_an_incompressible_wheel_on_a_rigid_plane)
{
    for (int k = 1; k <= 9; k += 4) {
        rb_rolling_case rigid = steady_wheel(RB_BEM_HALFPLANE, 0.5);
        rb_rolling_case pair = steady_wheel(RB_BEM_HALFPLANE, 0.2);
        pair.b = pair.a;
        pair.b.radius = 3.0 * pair.a.radius;
        pair.elastic_b = 1;
        rigid.creep_ratio = pair.creep_ratio = 0.1 * k;
        OWNED(rb_rolling_solution) one = solved(&rigid), two = solved(&pair);
        assert_int_equal(one.n, two.n);
        CHECK_ABS(two.force_ratio, one.force_ratio, 1e-9, "s = %g", 0.1 * k);
        for (int i = 0; i < one.n; i++)
            CHECK_ABS(two.q[i] / two.max_pressure, one.q[i] / one.max_pressure, 1e-8,
                      "q, element %d", i);
    }
}

/* The same by boundary elements: two equal wheels with a hub are mirror images, so that
 * not even the shape of the wheels couples pressure and slip. */
TEST(equal_wheels_lose_their_coupling)
{
    rb_rolling_case rc = steady_wheel(RB_BEM_HUB, 0.28);
    rc.b = rc.a;
    set(&rc, "half-width %g creep-ratio 0.4", 0.02 * rc.a.radius);
    rc.elastic_b = 1;
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_ABS(s.free_creepage, 0.0, 1e-9 * s.creepage, "free rolling of equal wheels");
    CHECK_ABS(s.force_ratio, -0.64, 2e-2, "Carter, a/R = 0.02");
}

/* Who is A and who is B: mirrored, the creepage and the friction change their sign. */
TEST(exchanging_the_bodies_mirrors_the_result)
{
    rb_rolling_case rc = steady_wheel(RB_BEM_HUB, 0.1);
    rc.b = rc.a;
    set(&rc, "poisson-b 0.4 young-b %g support-b arc mesh uniform half-width %g creep-ratio 0.3",
        3.0 * rc.a.young, 0.01 * rc.a.radius);
    rc.zone = 1.3 * rc.half_width;
    OWNED(rb_rolling_solution) ab = solved(&rc);
    const rb_rolling_body a = rc.a;
    rc.a = rc.b;
    rc.b = a;
    rc.creep_ratio = -0.3;
    OWNED(rb_rolling_solution) ba = solved(&rc);
    for (int i = 0; i < ab.n; i++) {
        CHECK_ABS(ab.p[i], ba.p[i], 1e-7 * ab.max_pressure, "p, element %d", i);
        CHECK_ABS(ab.q[i], -ba.q[i], 1e-7 * ab.max_pressure, "q, element %d", i);
    }
}

/* Aluminium on steel (theory-solvers.md 6), free rolling, both wheels with hubs. */
static double finite_free_creepage(double ratio, double mu)
{
    rb_rolling_case rc = with(steady_wheel(RB_BEM_HUB, 0.31), "young %g", 2.0 * 23000.0 * 1.31);
    rc.b = rc.a;
    set(&rc, "poisson-b 0.28 young-b %g mu %g contact-elements 60 half-width %g force 0",
        2.0 * 82000.0 * 1.28, mu, ratio * rc.a.radius);
    OWNED(rb_rolling_solution) s = solved(&rc);
    return s.creepage * rb_rolling_radius(&rc) / rc.half_width;
}

TEST(finite_cylinders_tend_to_bentall_and_johnson)
{
    /* xi R/a of the closed forms: a/R = 0.1/25 there */
    const double mu_infinite = -3.67269e-4 / 0.004, mu_zero = -2.0 * 0.143834 * 0.457386;
    const double coarse = finite_free_creepage(1e-2, 10.0) - mu_infinite;
    const double fine = finite_free_creepage(1e-6, 10.0) - mu_infinite;
    CHECK_MAX(fabs(fine), 1e-3 * fabs(mu_infinite), "mu -> infinity, a/R = 1e-6");
    CHECK_MAX(fabs(fine), 0.1 * fabs(coarse), "a/R = %g against %g", 1e-6, 1e-2);
    CHECK_REL(finite_free_creepage(1e-6, 1e-4), mu_zero, 5e-3, "mu -> 0, a/R = 1e-6");
}

static double log_uniform(double a, double b)
{
    return exp(between(log(a), log(b)));
}

TEST(force_control_never_fails_on_wheels)
{
    srand(5);
    for (int k = 0; k < 12; k++) {
        rb_rolling_case rc = steady_wheel(k % 2 ? RB_BEM_HUB : RB_BEM_ARC, between(0.0, 0.5));
        const double ratio = log_uniform(1e-6, 0.1);
        rc.b = rc.a;
        rc.b.young *= log_uniform(0.1, 10.0);
        rc.b.poisson = between(0.0, 0.5);
        set(&rc, "hub-ratio %g gap exact contact-elements 20", between(0.2, 0.9));
        rc.elastic_b = k % 3 > 0;
        rc.half_width = ratio * rb_rolling_radius(&rc);
        rc.mu = fmin(10.0, log_uniform(1e-6, 0.1) / ratio);
        rc.force_ratio = k % 4 ? between(-0.999, 0.999) : 0.999;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-10, "case %d", k);
        CHECK_MAX(s.load_error, 1e-10, "case %d", k);
        CHECK_MAX(s.residual, 1e-10, "case %d", k);
    }
}

/* More than any machine has is refused before a matrix is allocated; a contact without a
 * matrix of the same size is not. */
TEST(at_rest_relaxing_bodies_need_steps_in_time)
{
    static const double time = 0.1, ratio = 1.0;
    rb_rolling_case rc = steady_wheel(RB_BEM_HALFPLANE, 0.3);
    rc.a.memory = (rb_rolling_memory){.n = 1, .ratio = {ratio}, .time = {time}};
    rc.formulation = RB_STATIC;
    OWNED(rb_rolling_mesh) mesh;
    OWNED(rb_rolling_bodies) bodies;
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.0, 1.0, &mesh, &message));
    CHECK_STATUS(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, &message), RB_EINVAL);
    assert_string_equal(message.text, "relaxation-time: bodies that relax and do not roll steadily "
                                      "need a history of steps in time");
}

TEST(absurd_sizes_are_refused)
{
    enum { n = 1000000 };
    rb_rolling_case rc = with(steady_wheel(RB_BEM_HALFPLANE, 0.3), "mesh uniform");
    rb_rolling_mesh mesh = {.n = n};
    rb_rolling_bodies bodies;

    CHECK_MAX(rb_rolling_bytes(&rc, n, 0, 2 * n), 1e9, "no matrix");
    rc.contact.solver = RB_SOLVER_LEMKE;
    CHECK_SAYS(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, &message), RB_EINVAL,
               "a contact of 1000000 elements would need 1.92e+05");
    set(&rc, "support hub solver newton");
    CHECK_MAX(rb_bem_system_bytes(600, 200), rb_rolling_bytes(&rc, 200, 600, 300), "a wheel");
}

RUN_TESTS(NULL, NULL)
