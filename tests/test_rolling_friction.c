/* A coefficient of friction that depends on the place: the bound of every element. */
#include "check.h"
#include "rollbem/friction.h"
#include "rollbem/rolling.h"

#include <stdlib.h>
#include <string.h>

/* Half as much friction over the middle of the contact as at its ends. */
static const double places[] = {-0.6, -0.2, 0.2, 0.6}, values[] = {0.4, 0.2, 0.2, 0.4};
static const rb_rolling_friction_table sand = {4, places, values};

static rb_rolling_case steady(void)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = RB_BEM_HALFPLANE};
    rc.gap = RB_GAP_PARABOLA;
    rc.formulation = RB_STEADY;
    rc.half_width = 1.0;
    rc.creep_ratio = 0.5;
    rc.contact_elements = 41;
    rc.mu = 0.4;
    rc.friction = sand;
    return rc;
}

static rb_rolling_model solved(const rb_rolling_case *rc)
{
    rb_rolling_model model;
    rb_message why = {""};
    const rb_status s = rb_rolling_model_create(rc, &model, &why);
    if (s != RB_OK)
        print_error("%s\n", why.text);
    CHECK_STATUS(s, RB_OK);
    return model;
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
        CHECK_ABS(fmin(gap[i] / p->gap_length, s->p[i] / p->stress), 0.0, 1e-9, "gap %d",
                  i);
        assert_true(fabs(s->q[i]) <= most + small);
        if (fabs(s->q[i]) < most - small)
            CHECK_ABS(slip[i], 0.0, 1e-9 * p->slip_length, "stick %d", i);
        else
            assert_true(s->q[i] * slip[i] <= 1e-9 * p->slip_length * p->stress);
    }
    free(gap);
}

/* Lemke on both forms, Newton, a cone solver; every formulation and mesh. */
static void each_element_has_its_bound(void **state)
{
    (void)state;
    rb_rolling_model first = {0};
    for (int k = 0; k < 8; k++) {
        rb_rolling_case rc = steady();
        rc.solver = k == 2 ? RB_SOLVER_NEWTON : k == 3 ? RB_SOLVER_CONE : RB_SOLVER_LEMKE;
        rc.lcp_form = k == 1 ? RB_LCP_KWAK : RB_LCP_PIVOTED;
        rc.cone_solvers = rb_friction_cone_solvers();
        rc.cone_solver = "nsn-ac";
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
        rb_rolling_model model = solved(&rc);
        check_laws(&model);
        const double Q = rb_contact_capacity(&model.problem, &model.state);
        rb_rolling_solution s;
        CHECK_STATUS(rb_rolling_model_solution(&model, &s, NULL), RB_OK);
        CHECK_REL(s.force_ratio, s.tangential_load / Q, 1e-12, "ratio, case %d", k);
        if (k == 5 || k == 7)
            CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-9, "given ratio, case %d", k);
        if (k == 6)
            CHECK_REL(s.tangential_load, rc.force, 1e-9, "given force");
        if (k == 7)
            assert_int_equal(s.stick, 0);
        rb_rolling_solution_free(&s);
        for (int i = 0; k > 0 && k < 4 && i < model.mesh.n; i++)
            CHECK_ABS(model.state.q[i], first.state.q[i], 1e-8 * model.problem.stress,
                      "solver %d, element %d", k, i);
        if (k == 0)
            first = model;
        else
            rb_rolling_model_free(&model);
    }
    rb_rolling_model_free(&first);
}

/* Matrices and transforms, transient steps, a curve: the same law everywhere. */
static void large_contacts_and_steps_too(void **state)
{
    (void)state;
    rb_rolling_case rc = steady();
    rc.contact_elements = 1501;
    rb_rolling_model model = solved(&rc);
    assert_null(rb_contact_operator_matrix(model.problem.op).F);
    check_laws(&model);
    rb_rolling_model_free(&model);

    rb_rolling_history history;
    rc = steady();
    rc.formulation = RB_TRANSIENT;
    rc.distance = 1.0;
    CHECK_STATUS(rb_rolling_history_run(&rc, NULL, NULL, NULL, &model, &history, NULL),
                 RB_OK);
    check_laws(&model);
    rb_rolling_history_free(&history);
    rb_rolling_model_free(&model);

    rb_rolling_curve curve;
    rc = steady();
    CHECK_STATUS(
        rb_rolling_curve_solve(&rc, RB_OVER_CREEP_RATIO, 0.5, 3.0, 6, &curve, NULL),
        RB_OK);
    CHECK_ABS(curve.force_ratio[5], -1.0, 1e-9, "full sliding");
    rb_rolling_curve_free(&curve);
}

/* One value everywhere gives the bytes of one coefficient. */
static void an_even_table_is_one_coefficient(void **state)
{
    static const double even[] = {0.4, 0.4};
    (void)state;
    rb_rolling_case rc = steady();
    rc.friction = (rb_rolling_friction_table){2, places, even};
    rb_rolling_model table = solved(&rc);
    rc.friction.n = 0;
    rb_rolling_model one = solved(&rc);
    for (int i = 0; i < one.mesh.n; i++) {
        CHECK_ABS(table.state.p[i], one.state.p[i], 0.0, "p %d", i);
        CHECK_ABS(table.state.q[i], one.state.q[i], 0.0, "q %d", i);
    }
    rb_rolling_model_free(&table);
    rb_rolling_model_free(&one);
}

static void bad_tables_are_refused(void **state)
{
    static const double back[] = {0.0, 0.0}, negative[] = {0.4, -0.1};
    const struct {
        rb_rolling_friction_table table;
        double mu;
        const char *says;
    } bad[] = {{{2, back, values}, 0.4, "row 2: expected x to increase"},
               {{2, places, negative}, 0.4, "row 2: expected mu >= 0"},
               {sand, 0.3, "the largest value of the friction table, 0.4, got 0.3"}};
    (void)state;
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = steady();
        rb_message why = {""};
        rc.friction = bad[k].table;
        rc.mu = bad[k].mu;
        CHECK_STATUS(rb_rolling_case_check(&rc, &why), RB_EINVAL);
        if (!strstr(why.text, bad[k].says))
            fail_msg("%s", why.text);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_element_has_its_bound),
                                       cmocka_unit_test(large_contacts_and_steps_too),
                                       cmocka_unit_test(an_even_table_is_one_coefficient),
                                       cmocka_unit_test(bad_tables_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
