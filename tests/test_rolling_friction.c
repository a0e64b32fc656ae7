/* What lies between the bodies: a coefficient of friction that depends on the place, and
 * an interface that yields. */
#include "cases.h"
#include "refused.h"
#include "lcp/friction/friction.h"
#include "rolling/rolling.h"
#include "solved.h"

/* Half as much friction over the middle of the contact as at its ends. */
static const double places[] = {-0.6, -0.2, 0.2, 0.6}, values[] = {0.4, 0.2, 0.2, 0.4};
static const rb_rolling_table sand = {4, places, values};

static rb_rolling_case steady(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = RB_BEM_HALFPLANE};
    set(&rc,
        "gap parabola formulation steady half-width 1 creep-ratio 0.5 contact-elements 41 mu 0.4");
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_table, .table = sand};
    return rc;
}

/* (K1) to (K3) of every element with the friction of its own place, from F itself. */
static void check_laws(const rb_rolling_model *model)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *s = &model->state;
    double *gap = rb_alloc((size_t)p->n, 2), *slip = gap + p->n;

    rb_contact_kinematics(p, s, gap, slip);
    for (int i = 0; i < p->n; i++) {
        const double x = 0.5 * (model->mesh.ends[i] + model->mesh.ends[i + 1]);
        const double mu = fabs(x) < 0.2 ? 0.2 : fmin(0.4, 0.2 + 0.5 * (fabs(x) - 0.2));
        const double most = mu * s->p[i], small = 1e-9 * p->stress;
        CHECK_ABS(fmin(gap[i] / p->gap_length, s->p[i] / p->stress), 0.0, 1e-9, "gap %d", i);
        assert_true(fabs(s->q[i]) <= most + small);
        if (fabs(s->q[i]) < most - small)
            CHECK_ABS(slip[i], 0.0, 1e-9 * p->slip_length, "stick %d", i);
        else
            assert_true(s->q[i] * slip[i] <= 1e-9 * p->slip_length * p->stress);
    }
    free(gap);
}

static void check_residual(const rb_rolling_model *model)
{
    rb_contact_violation violation;
    CHECK_OK(rb_contact_residual(&model->problem, &model->state, &violation));
    CHECK_MAX(violation.scaled, 1e-9, "residual");
}

/* Lemke on both forms, Newton, a cone solver; every formulation and mesh. */
TEST(each_element_has_its_bound)
{
    OWNED(rb_rolling_model) first = {0};
    for (int k = 0; k < 8; k++) {
        rb_rolling_case rc = steady();
        rc.contact.solver = k == 2 ? RB_SOLVER_NEWTON : k == 3 ? RB_SOLVER_CONE : RB_SOLVER_LEMKE;
        rc.contact.lcp_form = k == 1 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        rc.contact.cone_solver = rb_friction_cone_solver("nsn-ac");
        if (k == 4)
            rc.mesh = RB_MESH_FITTED;
        if (k >= 5)
            rc.creep_ratio = NAN;
        if (k == 5)
            rc.force_ratio = -0.7;
        if (k == 6) {
            rc.formulation = RB_STATIC;
            rc.force = 0.15 * rb_rolling_derive(&rc).load;
        }
        if (k == 7)
            rc.force_ratio = 1.0;
        rb_rolling_model model = solved_model(&rc);
        check_laws(&model);
        const double Q = rb_contact_capacity(&model.problem, &model.state);
        OWNED(rb_rolling_solution) s;
        CHECK_OK(rb_rolling_model_solution(&model, &s, NULL));
        CHECK_REL(s.force_ratio, s.tangential_load / Q, 1e-12, "ratio, case %d", k);
        if (k == 5 || k == 7)
            CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-9, "given ratio, case %d", k);
        if (k == 6)
            CHECK_REL(s.tangential_load, rc.force, 1e-9, "given force");
        if (k == 7)
            assert_int_equal(s.stick, 0);
        for (int i = 0; k > 0 && k < 4 && i < model.mesh.n; i++)
            CHECK_ABS(model.state.q[i], first.state.q[i], 1e-8 * model.problem.stress,
                      "solver %d, element %d", k, i);
        if (k == 0)
            first = model;
        else
            rb_rolling_model_free(&model);
    }
}

/* Matrices and transforms, transient steps, a curve: the same law everywhere. */
TEST(large_contacts_and_steps_too)
{
    rb_rolling_case rc = with(steady(), "contact-elements 1501");
    rb_rolling_model model = solved_model(&rc);
    assert_null(rb_contact_operator_matrix(model.problem.op).F);
    check_laws(&model);
    rb_rolling_model_free(&model);

    OWNED(rb_rolling_history) history;
    rc = steady();
    set(&rc, "formulation transient distance 1");
    CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &history, NULL));
    check_laws(&model);
    rb_rolling_model_free(&model);

    OWNED(rb_rolling_curve) curve;
    rc = steady();
    CHECK_OK(rb_rolling_curve_solve(
        &rc, &(rb_rolling_range){RB_OVER_CREEP_RATIO, 0.5, 3.0, 6, RB_UNITS_MM}, &curve, NULL));
    CHECK_ABS(curve.force_ratio[5], -1.0, 1e-9, "full sliding");
}

/* One value everywhere gives the bytes of one coefficient. */
TEST(an_even_table_is_one_coefficient)
{
    static const double even[] = {0.4, 0.4};
    rb_rolling_case rc = steady();
    rc.friction.table = (rb_rolling_table){2, places, even};
    OWNED(rb_rolling_model) table = solved_model(&rc);
    rc.friction.law = RB_FRICTION_constant;
    OWNED(rb_rolling_model) one = solved_model(&rc);
    for (int i = 0; i < one.mesh.n; i++) {
        CHECK_ABS(table.state.p[i], one.state.p[i], 0.0, "p %d", i);
        CHECK_ABS(table.state.q[i], one.state.q[i], 0.0, "q %d", i);
    }
}

/* ---- A yielding interface ---------------------------------------------------------- */

/* Its own displacement, and nothing else, is what F r has more. */
TEST(an_interface_yields_by_itself)
{
    for (int large = 0; large < 2; large++) {
        rb_rolling_case rc = with(steady(), "contact-elements %d", large ? 1501 : 31);
        OWNED(rb_rolling_mesh) mesh;
        OWNED(rb_rolling_bodies) with, without;
        CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.3, 1.3, &mesh, NULL));
        CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &without, NULL));
        set(&rc, "interlayer-normal 2e-5 interlayer-tangential 3e-5");
        CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &with, NULL));
        const int n = mesh.n, m = n + 1;
        SCRATCH double *r = rb_alloc(2 * (size_t)n, 1), *w = rb_alloc(2 * (size_t)m, 2);
        for (int i = 0; i < 2 * n; i++)
            r[i] = 100.0 * rand() / RAND_MAX;
        rb_bem_flexibility_apply(&with.f, r, w);
        rb_bem_flexibility_apply(&without.f, r, w + 2 * m);
        for (int i = 0; i < m; i++) {
            CHECK_ABS(w[i] - w[2 * m + i], i < n ? 2e-5 * r[i] : 0.0, 1e-12, "N %d", i);
            CHECK_ABS(w[m + i] - w[3 * m + i], i < n ? 3e-5 * r[n + i] : 0.0, 1e-12, "T %d", i);
        }
    }
}

/* Steady rolling over an interface much softer than the bodies: bristles, whose friction
 * grows by xi / c per length from the leading edge on until it meets the bound. */
TEST(a_soft_interface_is_a_brush)
{
    const double c = 1e-2;
    for (int large = 0; large < 2; large++) {
        rb_rolling_case rc = with(steady(),
                                  "friction-law constant interlayer-tangential %g creep-ratio nan "
                                  "creep 0.4 contact-elements %d mesh uniform",
                                  c, large ? 1501 : 201);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        check_residual(&model);
        const double slope = rc.creep / c, scale = model.problem.stress;
        double lead = 0.0;
        for (int i = 0; i < model.mesh.n; i++)
            if (model.state.p[i] > 0.0)
                lead = model.mesh.ends[i + 1];
        for (int i = 0; i < model.mesh.n; i++) {
            const double x = 0.5 * (model.mesh.ends[i] + model.mesh.ends[i + 1]);
            const double most = rc.mu * model.state.p[i];
            const double want = -fmin(most, slope * fmax(0.0, lead - x));
            CHECK_ABS(model.state.q[i], want, 0.03 * rc.mu * scale, "large %d, q at %g", large, x);
        }
    }
}

TEST(bad_tables_are_refused)
{
    static const double back[] = {0.0, 0.0}, negative[] = {0.4, -0.1};
    const struct {
        rb_rolling_table table;
        const char *says;
    } bad[] = {{{2, back, values}, "row 2: expected x to increase"},
               {{2, places, negative}, "row 2: expected mu >= 0"},
               {{0, NULL, NULL}, "expected a row or more"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = steady();
        rc.friction.table = bad[k].table;
        CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, bad[k].says);
    }
    rb_rolling_case rc = steady();
    rc.interlayer_tangential = -1.0;
    CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL,
               "interlayer-tangential: expected a number >= 0");
}

/* Whichever row has it; mu beside a table counts for nothing. */
TEST(the_largest_of_a_table_is_that_of_any_row)
{
    const double x[] = {-1.0, 0.0, 3.0};
    for (int at = 0; at < 3; at++) {
        const double y[] = {at == 0 ? 0.2 : 0.15, at == 1 ? 0.2 : 0.1, at == 2 ? 0.2 : 0.05};
        rb_rolling_case rc = rolling_case("formulation steady");
        rc.friction =
            (rb_rolling_friction){.law = RB_FRICTION_table, .table = (rb_rolling_table){3, x, y}};
        CHECK_ABS(rb_rolling_largest_mu(&rc), 0.2, 0.0, "row %d", at);
    }
}

TEST(tables_of_no_friction_are_refused)
{
    const double x[3] = {-1.0, 0.0, 1.0}, back[3] = {-1.0, 1.0, 1.0}, gone[3] = {-1.0, NAN, 1.0},
                 mu[3] = {0.0, 0.2, 0.3}, less[3] = {0.2, -0.1, 0.3}, lost[3] = {0.2, NAN, 0.3};
#define MU(x, y)                                                                                   \
    rc.friction.law = RB_FRICTION_table, rc.friction.table = (rb_rolling_table){3, x, y}
    ACCEPTED(MU(x, mu));
    REFUSED("friction-law: expected a row", MU(x, mu); rc.friction.table.n = 0);
    REFUSED("friction-law: row 3: expected x to increase, got 1", MU(back, mu));
    REFUSED("friction-law: row 2: expected x to increase", MU(gone, mu));
    REFUSED("friction-law: row 2: expected mu >= 0, got -0.1", MU(x, less));
    REFUSED("friction-law: row 2: expected mu >= 0", MU(x, lost));
#undef MU
}

#define FALLS                                                                                      \
    STEADY;                                                                                        \
    rc.speed = 1.0;                                                                                \
    rc.friction.law = RB_FRICTION_rational;                                                        \
    rc.friction.fall[1] = 0.1;                                                                     \
    rc.friction.slip_scale[1] = 1.0
TEST(ranges_of_friction_laws)
{
    ACCEPTED(FALLS);
    ACCEPTED(FALLS; rc.formulation = RB_STATIC; rc.speed = 0.0; rc.friction.memory = 0.01;
             rc.friction.memory_slip = 0.001);
    REFUSED("needs a sliding distance in static contact", FALLS; rc.formulation = RB_STATIC;
            rc.speed = 0.0);
    ACCEPTED(FALLS; rc.friction.slip_scale[0] = -1.0); /* of no fall */
    ACCEPTED(FALLS; rc.friction.fall[0] = -rc.mu; rc.friction.slip_scale[0] = 1.0);
    REFUSED("expected mu >= 0 everywhere", FALLS; rc.friction.fall[0] = -0.31;
            rc.friction.slip_scale[0] = 1.0);
    REFUSED("mu-fall: expected a number", FALLS; rc.friction.fall[0] = INFINITY);
    REFUSED("slip-scale: expected a number > 0", FALLS; rc.friction.slip_scale[1] = 0.0);
    REFUSED("slip-scale: expected a number > 0", FALLS; rc.friction.slip_scale[1] = INFINITY);
    REFUSED("friction-law: rational: needs the speed", FALLS; rc.speed = 0.0);
    REFUSED("speed: expected a number > 0, got inf", FALLS; rc.speed = INFINITY);
    ACCEPTED(FALLS; rc.friction.memory = 1.0; rc.friction.memory_slip = 1.0);
    REFUSED("memory: expected a number > 0", FALLS; rc.friction.memory = -1.0);
    REFUSED("memory: expected a number > 0", FALLS; rc.friction.memory = INFINITY);
    REFUSED("memory: expected a number > 0", FALLS; rc.friction.memory = 1.0);

    ACCEPTED(WARM; rc.friction.heat = -0.3; rc.friction.heat_range = 100.0);
    ACCEPTED(rc.friction.heat = -0.3; rc.friction.heat_range = 100.0); /* at rest */
    REFUSED("expected mu >= 0 everywhere", WARM; rc.friction.heat = -0.31;
            rc.friction.heat_range = 100.0);
    REFUSED("mu-heat: needs temperatures", STEADY; rc.friction.heat = -0.1;
            rc.friction.heat_range = 100.0);
    REFUSED("mu-heat: expected a number, got inf", WARM; rc.friction.heat = INFINITY);
    REFUSED("mu-heat: expected a number > 0 as the third, got 0", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_range = 0.0);
    REFUSED("mu-heat: expected a number > 0 as the third", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_range = INFINITY);
    REFUSED("mu-heat: expected a number, got nan", WARM; rc.friction.heat = -0.1;
            rc.friction.heat_from = NAN; rc.friction.heat_range = 100.0);
}

RUN_TESTS(NULL, NULL)
