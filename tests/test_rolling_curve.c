/* Curves: where their points lie, that each is its case, refusals. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

static rb_rolling_case carter(int elements)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);
    set(&rc, "similar load 500 speed 1000");
    return rc;
}

static rb_rolling_case relaxing(void)
{
    return with(carter(24), "relaxation-time 1e-3 relaxation-ratio 1 creep 0");
}

static rb_rolling_curve run(const rb_rolling_case *rc, rb_rolling_variable over, double from,
                            double to, int points)
{
    const rb_rolling_range range = {.over = over, .from = from, .to = to, .points = points};
    rb_rolling_curve c;
    const double start = rb_seconds();
    CHECK_OK(rb_rolling_curve_solve(rc, &range, &c, &message));
    CHECK_MAX(c.seconds, rb_seconds() - start, "no more than have passed");
    CHECK_MAX(-c.seconds, 0.0, "time");
    return c;
}

static void check_point(const rb_rolling_curve *c, int k, const rb_rolling_case *rc)
{
    OWNED(rb_rolling_solution) s = solved(rc);
    double contact = 0.0, stick = 0.0;
    for (int i = 0; i < s.n; i++) {
        contact += s.zone[i] != RB_ZONE_SEPARATED ? s.h[i] : 0.0;
        stick += s.zone[i] == RB_ZONE_STICK ? s.h[i] : 0.0;
    }
    CHECK_REL(c->creepage[k], s.creepage, 1e-9, "point %d: creepage", k);
    CHECK_REL(c->creep_ratio[k], s.creep_ratio, 1e-9, "point %d: its ratio", k);
    CHECK_REL(c->normal_load[k], s.normal_load, 1e-9, "point %d: P", k);
    CHECK_REL(c->tangential_load[k], s.tangential_load, 1e-8, "point %d: Q", k);
    CHECK_REL(c->force_ratio[k], s.force_ratio, 1e-8, "point %d: Q/(mu P)", k);
    CHECK_REL(c->stick_ratio[k], stick / contact, 1e-9, "point %d: stick", k);
    CHECK_REL(c->dissipation[k], s.dissipation, 1e-7, "point %d: power", k);
    CHECK_ABS(c->resistance_moment[k], s.resistance_moment, 1e-9 * s.normal_load * s.half_width,
              "point %d: M", k);
    CHECK_ABS(c->resistance_ratio[k], s.resistance_ratio, 1e-9, "point %d: M/(P R)", k);
    CHECK_ABS(c->hysteresis[k], s.hysteresis, 1e-9 * s.normal_load, "point %d: lost", k);
    CHECK_ABS(c->speed[k], rc->speed, 1e-9 * rc->speed, "point %d: speed", k);
    CHECK_MAX(c->residual[k], 1e-9, "point %d: residual", k);
}

TEST(every_point_is_its_case)
{
    for (int over = 0; over < 2; over++) {
        rb_rolling_case rc = carter(40);
        const double scale = over == RB_OVER_CREEP_RATIO ? 1.0 : 0.01;
        rc.force_ratio = 0.3; /* not read */
        rb_rolling_curve c = run(&rc, (rb_rolling_variable)over, -0.5 * scale, 1.5 * scale, 5);
        set(&rc, "force-ratio nan formulation steady");
        assert_int_equal(c.n, 5);
        assert_int_equal(c.rising, 5);
        assert_null(c.branch);
        for (int k = 0; k < 5; k++) {
            const double wanted = (-0.5 + 0.5 * k) * scale;
            *(over == RB_OVER_CREEP ? &rc.creep : &rc.creep_ratio) = wanted;
            if (k != 1) /* nothing is dissipated there */
                check_point(&c, k, &rc);
            CHECK_ABS(over == RB_OVER_CREEP ? c.creepage[k] : c.creep_ratio[k], wanted,
                      1e-9 * scale, "point %d", k);
        }
        CHECK_ABS(c.free_creepage, 0.0, 0.0, "similar bodies");
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(c.half_width, s.hertz_half_width, 1e-9, "Hertz's");
        CHECK_REL(c.stick_step, 1.0 / s.contact, 1e-9, "one element");
        rb_rolling_curve_free(&c);
        assert_null(c.creepage);
    }
}

TEST(a_single_point_is_the_first)
{
    rb_rolling_case rc = carter(20);
    OWNED(rb_rolling_curve) c = run(&rc, RB_OVER_CREEP_RATIO, 0.4, 0.9, 1);
    assert_int_equal(c.n, 1);
    CHECK_REL(c.creep_ratio[0], 0.4, 1e-9, "from");
}

/* Equal steps of its logarithm, each with bodies of its own. */
TEST(speeds_have_their_own_bodies)
{
    rb_rolling_case rc = relaxing();
    OWNED(rb_rolling_curve) c = run(&rc, RB_OVER_SPEED, 100.0, 10000.0, 3);
    rc.formulation = RB_STEADY;
    assert_int_equal(c.n, 3);
    for (int k = 0; k < 3; k++) {
        rc.speed = 100.0 * pow(10.0, k);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(c.speed[k], rc.speed, 1e-12, "speed %d", k);
        CHECK_REL(c.resistance_moment[k], s.resistance_moment, 1e-8, "M of %d", k);
        CHECK_REL(c.hysteresis[k], s.hysteresis, 1e-6, "lost at %d", k);
    }
    assert_true(isnan(c.free_creepage));
    assert_true(c.iterations > 0);
}

/* Between midpoints of four elements nothing touches. */
TEST(a_curve_without_contact_says_so)
{
    rb_rolling_case rc = with(relaxing(), "load nan approach 1e-9 zone 1 contact-elements 4");
    OWNED(rb_rolling_curve) c;
    const rb_rolling_range range = {.over = RB_OVER_SPEED, .from = 1.0, .to = 2.0, .points = 2};
    CHECK_SAYS(rb_rolling_curve_solve(&rc, &range, &c, &message), RB_NO_CONTACT, "no contact");
    assert_int_equal(c.n, 1);
    CHECK_ABS(c.stick_ratio[0], 0.0, 0.0, "nothing sticks");
    CHECK_ABS(c.stick_step, 0.0, 0.0, "nothing sticks");
}

/* Unlike bodies move the contact: fitted and aligned meshes follow it, and every point is
 * still its case. */
TEST(meshes_follow_the_contact)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = carter(40);
        set(&rc, "poisson 0 mu 1 mesh %s", k ? "aligned" : "fitted");
        rc.elastic_b = 0;
        OWNED(rb_rolling_curve) c = run(&rc, RB_OVER_CREEP_RATIO, -2.0, 2.0, 3);
        rc.formulation = RB_STEADY;
        for (int i = 0; i < 3; i += 2) {
            rc.creep_ratio = -2.0 + 2.0 * i;
            OWNED(rb_rolling_solution) s = solved(&rc);
            CHECK_REL(c.tangential_load[i], s.tangential_load, 2e-4, "Q of %d", i);
            CHECK_REL(c.resistance_moment[i], s.resistance_moment, 1e-2, "M of %d", i);
        }
    }
}

/* A friction law that falls: there and back, each point from the one before it. */
TEST(falling_friction_goes_there_and_back)
{
    rb_rolling_case rc = with(carter(24), "friction-law exponential mu-fall 0.2 slip-scale 2");
    for (int k = 0; k < 2; k++) {
        rc.mesh = k ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        OWNED(rb_rolling_curve) c = run(&rc, RB_OVER_CREEP_RATIO, 0.2, 1.2, 3);
        static const double ratio[] = {0.2, 0.7, 1.2, 1.2, 0.7, 0.2};
        assert_int_equal(c.n, 6);
        assert_int_equal(c.rising, 3);
        for (int i = 0; i < 6; i++) {
            CHECK_REL(c.creep_ratio[i], ratio[i], 1e-9, "point %d", i);
            assert_int_equal(c.branch[i], i < 3 ? 1 : 2);
            assert_true(c.kappa[i] > 0.0);
            CHECK_REL(c.kappa[i], c.kappa[5 - i], 1e-2, "there and back, %d", i);
            CHECK_MAX(c.residual[i], 1e-9, "residual of %d", i);
        }
        CHECK_REL(c.tangential_load[2], c.tangential_load[3], 1e-3, "where it turns");
    }
}

/* A mild law has one solution, so that each point is its case; a heated one has its
 * temperature too. */
TEST(warm_curves_have_the_temperatures_of_their_cases)
{
    rb_rolling_case rc = carter(24);
    rc.heat_a = (rb_rolling_heat){.conductivity = 40.0, .heat_capacity = 3.5};
    rb_rolling_curve c = run(&rc, RB_OVER_CREEP_RATIO, 0.4, 1.2, 2);
    rc.formulation = RB_STEADY;
    for (int k = 0; k < 2; k++) {
        rc.creep_ratio = k ? 1.2 : 0.4;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(c.max_temperature[k], s.max_temperature, 1e-8, "point %d", k);
    }
    rb_rolling_curve_free(&c);
    c = run(&rc, RB_OVER_SPEED, 1000.0, 2000.0, 2); /* heat depends on it */
    assert_true(c.max_temperature[1] > c.max_temperature[0]);
    rb_rolling_curve_free(&c);
}

/* Friction that depends on the slip does so on the speed, of which slip is a part. */
TEST(speeds_change_the_friction_of_a_law)
{
    rb_rolling_case rc = with(carter(24), "creep 0.1 friction-law exponential mu-fall 0.1");
    rc.friction.slip_scale[0] = 100.0;
    OWNED(rb_rolling_curve) c = run(&rc, RB_OVER_SPEED, 1000.0, 4000.0, 3);
    rc.formulation = RB_STEADY;
    for (int k = 0; k < 3; k++) {
        rc.speed = 1000.0 * (1 << k);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(c.force_ratio[k], s.force_ratio, 1e-8, "V = %g", rc.speed);
        /* all of it slides: mu(V xi) < mu(0) */
        CHECK_ABS(c.force_ratio[k],
                  -(rc.mu + 0.1 * pow(2.0, -rc.speed * 0.1 / 100.0)) / (rc.mu + 0.1), 1e-3, "law");
    }
}

static void refused(rb_rolling_case rc, rb_rolling_range range, const char *words)
{
    OWNED(rb_rolling_curve) c;
    CHECK_SAYS(rb_rolling_curve_solve(&rc, &range, &c, &message), RB_EINVAL, words);
    assert_int_equal(c.n, 0);
}

TEST(ranges_that_make_no_sense_are_refused)
{
    rb_rolling_case smooth = with(carter(20), "mu 0");
    refused(carter(20), (rb_rolling_range){RB_OVER_CREEP, NAN, 1.0, 3, RB_UNITS_MM},
            "finite numbers");
    refused(carter(20), (rb_rolling_range){RB_OVER_CREEP, 0.0, INFINITY, 3, RB_UNITS_MM},
            "finite numbers");
    refused(carter(20), (rb_rolling_range){RB_OVER_CREEP, 0.0, 0.1, 0, RB_UNITS_MM}, "points: exp");
    refused(carter(20), (rb_rolling_range){RB_OVER_CREEP, 0.0, 0.1, 1000001, RB_UNITS_MM},
            "points: expected 1 ... 1000000");
    refused(smooth, (rb_rolling_range){RB_OVER_CREEP_RATIO, 0.0, 1.0, 3, RB_UNITS_MM},
            "has no meaning at mu = 0");
    refused(relaxing(), (rb_rolling_range){RB_OVER_SPEED, 0.0, 1.0, 3, RB_UNITS_MM},
            "expected from and to > 0");
    refused(relaxing(), (rb_rolling_range){RB_OVER_SPEED, 1.0, -1.0, 3, RB_UNITS_MM},
            "expected from and to > 0");
    refused(carter(20), (rb_rolling_range){RB_OVER_SPEED, 1.0, 2.0, 3, RB_UNITS_MM},
            "no body is viscoelastic");
    OWNED(rb_rolling_curve) c = run(&smooth, RB_OVER_CREEP, 0.0, 0.01, 2);
    assert_true(isnan(c.free_creepage));
    assert_true(isnan(c.creep_ratio[1]));
}

/* Where the first element of each point's mesh begins. */
static rb_status note_mesh(const rb_rolling_model *model, int k, void *begins, rb_message *why)
{
    (void)why;
    ((double *)begins)[k] = model->mesh.ends[0];
    return RB_OK;
}

/* A mesh is fitted again where the point's solution on the mesh of the first one has an edge that
 * is a hundredth of the half-width away. */
TEST(a_hundredth_of_the_half_width_is_followed)
{
    int stay = 0, follow = 0;
    for (int k = 0; k < 6; k++) {
        const double last = -0.99 + 0.01 * k;
        rb_rolling_case rc = with(carter(16), "mesh fitted formulation steady");
        const rb_rolling_range range = {
            .over = RB_OVER_CREEP_RATIO, .from = -1.0, .to = last, .points = 2};
        double from[2], to[2], begins[2];
        set(&rc, "poisson 0.2 creep-ratio -1");
        rc.elastic_b = 0;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        for (int i = 0; i < 2; i++) {
            rb_rolling_contact_edges(model.rc, &model.mesh, &model.state, &from[i], &to[i]);
            case_of_model(&model)->creep_ratio = last;
            CHECK_OK(rb_rolling_model_control(&model, NULL));
        }
        const double moved =
            fmax(fabs(from[1] - from[0]), fabs(to[1] - to[0])) / (0.5 * (to[0] - from[0]));
        OWNED(rb_rolling_curve) c;
        CHECK_OK(rb_rolling_curve_observe(&rc, &range, note_mesh, begins, &c, &message));
        assert_int_equal(begins[1] != begins[0], moved > 0.01);
        stay += moved > 0.006 && moved <= 0.01;
        follow += moved > 0.01 && moved < 0.015;
    }
    assert_true(stay > 0 && follow > 0);
}

RUN_TESTS(NULL, NULL)
