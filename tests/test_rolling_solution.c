/* What a solution says, recomputed from the model that it is taken from. */
#include "cases.h"
#include "solved.h"

/* Every part of the work of a wheel takes some of its time. */
TEST(the_parts_of_the_time_are_within_the_whole)
{
    rb_rolling_case rc = with(rolled_plane(RB_STATIC), "support hub outer-elements 40");
    rb_rolling_solution s = solved(&rc);
    const double part[] = {s.seconds_assembly, s.seconds_factor, s.seconds_condense, s.seconds_lcp};
    double sum = 0.0;
    for (int k = 0; k < 4; k++) {
        assert_true(part[k] > 0.0);
        sum += part[k];
    }
    CHECK_MAX(sum, s.seconds_total, "seconds");
    rb_rolling_solution_free(&s);

    const rb_rolling_case flat = rolled_plane(RB_STATIC); /* without a boundary */
    s = solved(&flat);
    CHECK_ABS(s.seconds_assembly + s.seconds_factor, 0.0, 0.0, "seconds of no boundary");
    rb_rolling_solution_free(&s);
}

TEST(sums_are_those_of_the_tractions)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = rolled_plane(k ? RB_STEADY : RB_STATIC);
        if (!k)
            rc.force_ratio = 0.5;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        OWNED(rb_rolling_solution) s = solution_of(&model);
        double P = 0.0, Q = 0.0, M = 0.0;
        for (int i = 0; i < s.n; i++) {
            P += s.p[i] * s.h[i];
            Q += s.q[i] * s.h[i];
            M += s.x[i] * s.p[i] * s.h[i];
        }
        CHECK_REL(s.normal_load, P, 1e-13, "P");
        CHECK_REL(s.tangential_load, Q, 1e-12, "Q");
        CHECK_ABS(s.load_error, fabs(P - 500.0) / 500.0, 1e-13, "load error");
        CHECK_REL(s.force_ratio, Q / (0.3 * P), 1e-12, "Q/(mu P)");
        CHECK_REL(s.half_width, 0.5 * (s.contact_to - s.contact_from), 1e-14, "a");
        CHECK_REL(s.hertz_half_width, rb_rolling_hertz_half_width(&rc, P), 1e-12, "Hertz");
        CHECK_REL(s.datum, 2.0 * 50.0 / exp(1.0), 1e-12, "2 R/e");
        assert_true(isnan(s.support_balance) && isnan(s.kappa) && isnan(s.peclet));
        assert_int_equal(s.boundary_elements, 0);
        if (k) {
            CHECK_ABS(s.resistance_moment, M, 1e-12 * P, "M");
            CHECK_ABS(s.resistance_ratio, M / (P * 50.0), 1e-13, "M/(P R)");
            CHECK_ABS(s.hysteresis, 0.0, 0.0, "elastic");
            CHECK_REL(s.creepage, model.state.xi, 0.0, "xi");
            assert_true(isnan(s.tangential_shift));
        } else {
            assert_true(isnan(s.resistance_moment) && isnan(s.resistance_ratio) &&
                        isnan(s.hysteresis) && isnan(s.dissipation));
            CHECK_REL(s.tangential_shift, model.state.xi, 1e-15, "the shift");
        }
    }
}

/* A shift before the state's own is added; the creepage of a contact at rest is the given
 * one, or its ratio. */
TEST(shift_and_creepage_at_rest)
{
    rb_rolling_case rc = with(rolled_plane(RB_STATIC), "shift 0.001");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    for (int k = 0; k < 3; k++) {
        model.shift = 0.01 * k;
        case_of_model(&model)->creep = k == 1 ? 0.02 : NAN;
        case_of_model(&model)->creep_ratio = k == 2 ? 0.5 : NAN;
        OWNED(rb_rolling_solution) s = solution_of(&model);
        CHECK_REL(s.tangential_shift, 0.001 + 0.01 * k, 1e-12, "shift %d", k);
        CHECK_ABS(s.creepage,
                  k == 0   ? 0.0
                  : k == 1 ? 0.02
                           : 0.5 * 0.3 * s.hertz_half_width / 50.0,
                  1e-15, "creepage %d", k);
    }
    model.problem.load_given = 0;
    OWNED(rb_rolling_solution) s = solution_of(&model);
    assert_true(isnan(s.load_error));
}

/* Slip against the zone is counted, of each zone; as small as rounding it is none. */
TEST(slip_that_pushes_is_a_violation)
{
    const rb_rolling_case rc = rolled_plane(RB_STEADY);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    static const int zones[] = {RB_ZONE_STICK,          RB_ZONE_SLIP_NEGATIVE,
                                RB_ZONE_SLIP_POSITIVE,  RB_ZONE_YIELD_NEGATIVE,
                                RB_ZONE_YIELD_POSITIVE, RB_ZONE_SEPARATED};
    static const int counts[6][3] = {{1, 0, 1}, {1, 0, 0}, {0, 0, 1},
                                     {1, 0, 0}, {0, 0, 1}, {0, 0, 0}};
    const double length = model.problem.slip_length;
    for (int k = 0; k < 6; k++)
        for (int sign = -1; sign <= 1; sign++) {
            for (int i = 0; i < model.state.n; i++) {
                model.state.zone[i] = RB_ZONE_SEPARATED;
                model.state.lambda[i] = 0.0;
            }
            model.state.zone[5] = zones[k];
            model.state.lambda[5] = sign * 1e-6 * length;
            model.state.zone[7] = RB_ZONE_STICK;
            model.state.lambda[7] = 1e-11 * length;
            OWNED(rb_rolling_solution) s = solution_of(&model);
            assert_int_equal(s.slip_violations, counts[k][sign + 1]);
        }
}

/* Two thousand boundary elements have no dense matrix. */
TEST(many_boundary_elements_are_called_hierarchical)
{
    rb_rolling_case rc = rolled_plane(RB_STATIC);
    set(&rc, "support hub outer-elements 1500 contact-elements 12");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    OWNED(rb_rolling_solution) s = solution_of(&model);
    assert_true(s.boundary_elements > 2000);
    assert_int_equal(s.hierarchical, 1);
}

/* Solved again with another load: as from the start, whatever the model held. */
TEST(a_model_solves_the_next_case_as_the_first)
{
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = rolled_plane(RB_STEADY), next;
        OWNED(rb_rolling_model) model = {0};
        rc.mesh = k == 1 || k == 4 ? RB_MESH_FITTED : RB_MESH_UNIFORM;
        next = rc;
        next.mesh = k == 2 ? RB_MESH_FITTED : k == 4 ? RB_MESH_UNIFORM : rc.mesh;
        next.load = 700.0;
        next.contact_elements += k == 5 ? 2 : 0;
        if (k != 3)
            model = solved_model(&rc);
        CHECK_OK(rb_rolling_model_reuse(&next, NULL, &model, NULL));
        OWNED(rb_rolling_model) fresh = solved_model(&next);
        assert_int_equal(model.state.n, fresh.state.n);
        for (int i = 0; i < fresh.state.n; i++) {
            CHECK_ABS(model.state.p[i], fresh.state.p[i], 0.0, "%d: p %d", k, i);
            CHECK_ABS(model.state.q[i], fresh.state.q[i], 0.0, "%d: q %d", k, i);
        }
        assert_int_equal(model.same_bodies, 0);
    }
}

/* A given ratio of the creepage refers to the load that an approach leads to. */
TEST(a_ratio_is_met_under_an_approach)
{
    rb_rolling_case rc = with(rolled_plane(RB_STEADY), "load nan approach 0.05");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.creep_ratio, 0.5, 1e-10, "xi R/(mu a)");
    CHECK_REL(s.creepage, 0.5 * 0.3 * rb_rolling_hertz_half_width(&rc, s.normal_load) / 50.0, 1e-10,
              "of the load that was found");
    CHECK_ABS(s.approach, 0.05, 0.0, "the approach");
}

/* On elements between given places; where they do not hold the contact, that is said. */
TEST(elements_may_stand_where_they_are_told)
{
    rb_rolling_case rc = rolled_plane(RB_STATIC);
    rb_rolling_solution s;
    CHECK_OK(rb_rolling_solve_between(&rc, -2.0, 1.6, &s, &message));
    assert_int_equal(s.n, 24);
    CHECK_REL(s.h[3], 0.15, 1e-12, "3.6 mm");
    CHECK_REL(s.normal_load, 500.0, 1e-9, "load");
    rb_rolling_solution_free(&s);
    CHECK_STATUS(rb_rolling_solve_between(&rc, -0.3, 0.3, &s, &message), RB_ZONE);
    CHECK_STATUS(s.status, RB_ZONE);
    assert_non_null(strstr(message.text, "widen the zone"));
    assert_int_equal(s.n, 24); /* what there is */
    rb_rolling_solution_free(&s);
    CHECK_STATUS(rb_rolling_solve_between(&rc, 0.3, 0.3, &s, &message), RB_EINVAL);
    assert_null(s.p);
    rc.mu = -1.0;
    CHECK_STATUS(rb_rolling_solve_between(&rc, -2.0, 2.0, &s, &message), RB_EINVAL);
    assert_null(s.p);
}

/* Fewer than five elements in contact do not tell its edges, and that is said. */
TEST(few_elements_do_not_tell_the_edges)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(rolled_plane(RB_STEADY), "contact-elements %d", k ? 40 : 5);
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_int_equal(s.edges_bounded, !k);
    }
}

/* Hertz: P/2 (delta - a^2/(8 R)).  On any body dE/d(delta) = P without friction.  What
 * relaxes or yields has no such energy. */
TEST(strain_energy_is_the_work_of_pressing)
{
    rb_rolling_case rc = with(rolled_plane(RB_STATIC), "mu 0 contact-elements 400");
    rb_rolling_solution s = solved(&rc);
    const double a = s.hertz_half_width;
    CHECK_REL(s.strain_energy, 0.5 * s.normal_load * (s.approach - a * a / (8.0 * rc.a.radius)),
              1e-4, "Hertz");
    CHECK_ABS(s.nip_width, s.contact_to - s.contact_from, 0.0, "nip");
    CHECK_REL(s.nip_width, 2.0 * a, 2e-2, "2a");
    rb_rolling_solution_free(&s);

    const int supports[] = {RB_BEM_HALFPLANE, RB_BEM_HUB, RB_BEM_ARC};
    for (int k = 0; k < 3; k++) {
        double energy[3], load = 0.0;
        for (int j = 0; j < 3; j++) {
            rb_rolling_case pressed = rolled_plane(RB_STATIC);
            set(&pressed, "mu 0 zone 4 load nan approach %g", 0.1 * (1.0 + 0.01 * (j - 1)));
            pressed.a.support = supports[k];
            s = solved(&pressed);
            energy[j] = s.strain_energy;
            load = j == 1 ? s.normal_load : load;
            rb_rolling_solution_free(&s);
        }
        CHECK_REL((energy[2] - energy[0]) / (2.0 * 0.1 * 0.01), load, 2e-2, "support %d", k);
    }
    rc = rolled_plane(RB_STEADY);
    rc.a.memory = (rb_rolling_memory){1, {1e-3}, {1.0}};
    s = solved(&rc);
    assert_true(isnan(s.strain_energy));
    rb_rolling_solution_free(&s);
}

RUN_TESTS(NULL, NULL)
