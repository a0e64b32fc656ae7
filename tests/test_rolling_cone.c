/* The rolling problems through the cone solvers of src/lcp/friction: a third opinion. */
#include "cases.h"
#include "check.h"
#include "lcp/friction/friction.h"
#include "rolling/rolling.h"
#include "solved.h"

/* Steady rolling of dissimilar bodies: W is not symmetric. */
static rb_rolling_case dissimilar_rolling(void)
{
    rb_rolling_case rc = half_plane(RB_STEADY, 40);
    set(&rc, "poisson 0.28 gap parabola half-width %g creep-ratio 0.5", 1e-3 * rc.a.radius);
    return rc;
}

TEST(cone_solvers_agree_with_lemke)
{
    static const char *const names[] = {"auto", "nsn-ac", "nsgs-ac", "lemke"};
    rb_rolling_case rc = dissimilar_rolling();
    OWNED(rb_rolling_model) model = solved_model(&rc);
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        OWNED(rb_contact_state) cone;
        CHECK_OK(rb_contact_state_alloc(model.mesh.n, &cone));
        cone.delta = model.state.delta;
        cone.xi = model.state.xi;
        rb_contact_options by = rb_contact_defaults();
        by.solver = RB_SOLVER_CONE;
        by.cone_solver = rb_friction_cone_solver(names[k]);
        if (rb_contact_solve(&model.problem, &by, 0, &cone, &message) != RB_OK)
            fail_msg("%s: %s", names[k], message.text);
        assert_int_equal(cone.solver, RB_SOLVER_CONE);
        for (int i = 0; i < cone.n; i++) {
            CHECK_ABS(cone.p[i], model.state.p[i], 1e-8 * model.problem.stress, "%s: p %d",
                      names[k], i);
            CHECK_ABS(cone.q[i], model.state.q[i], 1e-8 * model.problem.stress, "%s: q %d",
                      names[k], i);
        }
    }
}

TEST(a_case_may_name_a_cone_solver)
{
    rb_rolling_case rc = dissimilar_rolling();
    OWNED(rb_rolling_solution) cone;
    OWNED(rb_rolling_solution) lemke = solved(&rc);
    rc.contact.solver = RB_SOLVER_CONE;
    CHECK_STATUS(rb_rolling_solve(&rc, &cone, &message), RB_EINVAL);
    rc.contact.cone_solver.name = "nsn-ac"; /* nobody has handed it in */
    CHECK_SAYS(rb_rolling_solve(&rc, &cone, &message), RB_EINVAL, "nsn-ac");
    rc.contact.cone_solver = rb_friction_cone_solver("no-such");
    CHECK_STATUS(rb_rolling_solve(&rc, &cone, &message), RB_EINVAL);
    rc.contact.cone_solver = rb_friction_cone_solver("nsn-ac");
    CHECK_OK(rb_rolling_solve(&rc, &cone, &message));
    assert_int_equal(cone.solver, RB_SOLVER_CONE);
    CHECK_MAX(cone.residual, 1e-10, "residual");
    CHECK_ABS(cone.force_ratio, lemke.force_ratio, 1e-9, "Q");
}

static const rb_contact_state *known; /* of the case at hand */
static double known_stress;

/* The solution, with rounding where there is no contact. */
static rb_status solve_roughly(const char *name, const rb_contact_cone *cone, double tol, double *r,
                               int *iterations, rb_message *why)
{
    (void)name, (void)tol, (void)iterations, (void)why;
    for (int i = 0; i < cone->n; i++) {
        const int open = known->zone[i] == RB_ZONE_SEPARATED;
        r[2 * i] = open ? (i % 2 ? 1e-18 : -1e-18) : known->p[i] / known_stress;
        r[2 * i + 1] = open ? 1e-19 : known->q[i] / known_stress;
    }
    return RB_OK;
}

TEST(separated_elements_carry_nothing)
{
    rb_rolling_case rc = dissimilar_rolling();
    int separated = 0;
    OWNED(rb_rolling_model) model = solved_model(&rc);
    known = &model.state;
    known_stress = model.problem.stress;
    rc.contact.solver = RB_SOLVER_CONE;
    rc.contact.cone_solver = (rb_contact_cone_solver){"rough", solve_roughly};
    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_string_equal(s.cone_solver, "rough");
    CHECK_MAX(s.residual, 1e-10, "residual");
    for (int i = 0; i < s.n; i++)
        if (s.zone[i] == RB_ZONE_SEPARATED) {
            separated++;
            if (s.p[i] != 0.0 || s.q[i] != 0.0)
                fail_msg("element %d is open with p = %g, q = %g", i, s.p[i], s.q[i]);
        }
    assert_true(separated > 0);
}

RUN_TESTS(NULL, NULL)
