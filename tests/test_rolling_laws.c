/* Friction laws (theory-rolling.md 4.11): coefficients that depend on slip velocity, memory and
 * temperature, proven by formulas of their own and by Coulomb's law with them. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

/* Wheel and rail of veldep_fric.inp (CONTACT): 92 elements there, 81 in contact. */
static rb_rolling_case rail(double slip_scale)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){.young = 2.0 * 82000.0 * 1.28,
                             .poisson = 0.28,
                             .radius = 460.0,
                             .support = RB_BEM_HALFPLANE};
    set(&rc, "similar load 3111.08 formulation steady creep 0.0009999 speed 45000 "
             "contact-elements 93 zone 4.65 mu 0.18");
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_exponential,
                                        .fall = {0.12, 0.0},
                                        .slip_scale = {slip_scale, slip_scale}};
    return rc;
}

static double ratio_of(const rb_rolling_case *rc)
{
    OWNED(rb_rolling_model) model = solved_model(rc);
    return rb_rolling_force_ratio(&model);
}

/* ---- Laws ------------------------------------------------------------------------- */

static double by_formula(const rb_rolling_case *rc, double v)
{
    const double *m = rc->friction.fall, *s = rc->friction.slip_scale;
    switch (rc->friction.law) {
    case RB_FRICTION_exponential:
        return rc->mu + m[0] * exp(-log(2.0) * v / s[0]) + m[1] * exp(-log(2.0) * v / s[1]);
    case RB_FRICTION_rational:
        return rc->mu + m[0] * s[0] / (s[0] + v) + m[1] * s[1] * s[1] / (s[1] * s[1] + v * v);
    default:
        return rc->mu + (v < 2.0 * s[0] ? m[0] - 0.5 * m[0] * v / s[0] : 0.0) +
               (v < 2.0 * s[1] ? m[1] - 0.5 * m[1] * v / s[1] : 0.0);
    }
}

/* Slip velocity for the coefficient of element i: of the step, or of second-order slip, at its
 * place; on graded elements by the straight line through those half-way to both neighbours (F1). */
static double velocity_at(const rb_rolling_model *model, const double *slip, int i)
{
    const double *x = model->bodies.f.x, *e = model->problem.e_T;
    const int sticks = model->state.zone[i] == RB_ZONE_STICK;
    const double own = sticks ? 0.0 : slip[i] / e[i];

    if (model->rc->formulation != RB_STEADY || model->rc->mesh != RB_MESH_FITTED || i == 0)
        return fabs(own) * model->rc->speed;
    const double behind = model->state.zone[i - 1] == RB_ZONE_STICK ? 0.0 : slip[i - 1] / e[i - 1];
    const double from = 0.5 * (x[i - 1] + x[i]), to = 0.5 * (x[i] + x[i + 1]);
    return fabs(behind + (own - behind) * (x[i] - from) / (to - from)) * model->rc->speed;
}

/* (K1) to (K3) with the coefficients that the slip of each element gives, upstream to
 * downstream with memory (F2); `before`: of the particles before a step. */
static void check_state(const rb_rolling_model *model, const double *before, const char *what)
{
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *s = &model->state;
    const rb_rolling_friction *f = &model->rc->friction;
    const double V = model->rc->speed, rest = by_formula(model->rc, 0.0);
    const int second = model->rc->slip_operator == RB_SLIP_SECOND;
    const int is_linear = !before && (second || model->rc->mesh == RB_MESH_FITTED);
    double *gap = rb_alloc((size_t)p->n, 2), *slip = gap + p->n, mu = rest, next = NAN,
           v_next = 0.0;

    assert_non_null(gap);
    rb_contact_kinematics(p, s, gap, slip);
    for (int i = p->n - 1; i >= 0; i--) {
        const double v = velocity_at(model, slip, i);
        const double now = by_formula(model->rc, v), small = 1e-9 * p->stress;
        const double upstream = before ? before[i] : mu;
        mu = s->p[i] == 0.0 ? rest : now;
        if (f->memory > 0.0 && s->p[i] > 0.0) {
            const int touches = i + 1 < p->n && s->p[i + 1] > 0.0;
            const double own = s->zone[i] == RB_ZONE_STICK ? 0.0 : fabs(slip[i]) / p->e_T[i] * V;
            const double by = second && touches ? 0.5 * (v + v_next) : own;
            const double t = fmax(by, f->memory_slip) * p->e_T[i] / V / f->memory;
            const double ahead = is_linear && touches ? next : now;
            /* d mu/dt = law - mu, the law linear from `ahead` at 0 to `now` at t */
            mu = (upstream - ahead) * exp(-t) + now -
                 (now - ahead) * (t > 1e-4 ? -expm1(-t) / t : 1.0 - 0.5 * t);
        }
        next = now;
        v_next = v;
        CHECK_ABS((p->bound[i] - mu) * (s->p[i] > 0.0 ? s->p[i] / p->stress : 1.0), 0.0, 1e-10,
                  "%s: mu of element %d", what, i);
        CHECK_ABS(fmin(gap[i] / p->gap_length, s->p[i] / p->stress), 0.0, 1e-9, "%s: contact %d",
                  what, i);
        assert_true(fabs(s->q[i]) <= mu * s->p[i] + small);
        if (fabs(s->q[i]) < mu * s->p[i] - small)
            CHECK_ABS(slip[i], 0.0, 1e-9 * p->slip_length, "%s: stick %d", what, i);
        else
            assert_true(s->q[i] * slip[i] <= 1e-9 * p->slip_length * p->stress);
    }
    free(gap);
}

/* Every law, with and without memory, on every mesh, by matrices and by transforms. */
TEST(coefficients_follow_from_the_slip)
{
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_exponential, RB_FRICTION_rational,
                                                   RB_FRICTION_linear};
    for (int k = 0; k < 3; k++)
        for (int mesh = 0; mesh < 4; mesh++)
            for (int memory = 0; memory < 2; memory++) {
                char what[80];
                rb_rolling_case rc = rail(100.0);
                set(&rc, "zone %g slip-operator %s contact-elements %d", mesh == 0 ? 4.65 : 0.0,
                    mesh == 2 ? "second" : "upstream", mesh == 3 ? 1501 : 60);
                rc.friction.law = laws[k];
                rc.friction.fall[1] = 0.05;
                rc.friction.slip_scale[1] = 60.0;
                rc.friction.memory = memory ? 0.002 : 0.0;
                rc.friction.memory_slip = memory ? 1.0 : 0.0;
                rc.mesh = mesh == 1   ? RB_MESH_FITTED
                          : mesh == 2 ? RB_MESH_ALIGNED
                                      : RB_MESH_UNIFORM;
                if (mesh == 3 && (k > 0 || memory))
                    continue;
                OWNED(rb_rolling_model) model = solved_model(&rc);
                snprintf(what, sizeof what, "law %d, mesh %d, memory %d", k, mesh, memory);
                check_state(&model, NULL, what);
            }
}

/* A law is a scale of its own: all terms at no slip. */
TEST(ratios_refer_to_the_largest_coefficient)
{
    rb_rolling_case rc = rail(100.0);
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.force_ratio, s.tangential_load / (0.3 * s.normal_load), 1e-12, "ratio");
    CHECK_REL(s.creep_ratio, rc.creep * 460.0 / (0.3 * s.hertz_half_width), 1e-12, "creep ratio");
    CHECK_REL(s.mu[s.n - 1], 0.3, 1e-14, "mu at rest");
    const double slope = 0.12 * log(2.0) / 100.0;
    CHECK_REL(s.kappa, 45000.0 * slope * 495.0 * 1.0491 / 113889.0, 5e-3, "kappa");
}

/* ---- Figures of theory-rolling.md 4.11 ----------------------------------------------------- */

/* CONTACT: 0.5941, 45 in adhesion, 36 in slip. */
TEST(the_rail_case_is_met)
{
    static const double memory[] = {0.0, 0.0005, 0.001, 0.003, 0.01},
                        want[] = {0.59433, 0.59814, 0.60199, 0.61158, 0.61996};
    for (int k = 0; k < 5; k++) {
        rb_rolling_case rc = rail(100.0);
        rc.friction.memory = memory[k];
        rc.friction.memory_slip = 1.0;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(-s.force_ratio, want[k], 1e-5, "memory %g", memory[k]);
        CHECK_MAX(s.residual, 1e-10, "memory %g", memory[k]);
        if (k == 0) {
            CHECK_ABS(-s.force_ratio, 0.5941, 5e-4, "CONTACT");
            assert_int_equal(s.stick, 45);
            assert_int_equal(s.slipping, 36);
        }
    }
}

/* From coefficients at rest and from those of fast sliding. */
TEST(steep_laws_have_two_solutions)
{
    static const double kinetic = 0.18, place = 0.0;
    static const rb_rolling_table sliding = {1, &place, &kinetic};
    static const double scale[] = {100.0, 50.0, 20.0, 15.5, 10.0, 5.0, 2.0};
    for (int k = 0; k < 7; k++) {
        rb_rolling_case rc = rail(scale[k]);
        OWNED(rb_rolling_model) rest = solved_model(&rc);
        double kappa;
        rb_rolling_plan plan = rb_rolling_plan_of(&rc);
        plan.start = &sliding;
        OWNED(rb_rolling_model) fast = {0};
        CHECK_OK(rb_rolling_model_reuse(&rc, &plan, &fast, NULL));
        check_state(&rest, NULL, "from rest");
        check_state(&fast, NULL, "from sliding");
        CHECK_OK(rb_rolling_law_kappa(&rest, &kappa));
        CHECK_REL(kappa, 17.073 / scale[k], 1e-3, "kappa");
        const double difference =
            fabs(rb_rolling_force_ratio(&rest) - rb_rolling_force_ratio(&fast));
        if (kappa < 1.12)
            CHECK_MAX(difference, 1e-9, "kappa = %g", kappa);
        else
            assert_true(difference > 1e-4);
    }
}

/* Rising and falling creepage: each point is a solution; they agree where friction falls
 * gently. Where it does not, equal elements have two branches, of the mesh as its upstream slip:
 * similar bodies have no slip by their own traction (F3), and fitted elements have one. */
TEST(curves_have_two_branches)
{
    enum { POINTS = 16 };
    static const double scale[] = {100.0, 50.0, 20.0, 10.0, 5.0, 2.0};
    for (int k = 0; k < 12; k++) {
        rb_rolling_case rc = rail(scale[k % 6]);
        OWNED(rb_rolling_curve) c;
        double widest = 0.0;
        if (k >= 6) {
            set(&rc, "zone auto mesh fitted contact-elements 60");
        }
        rc.creep = NAN;
        CHECK_OK(rb_rolling_curve_solve(
            &rc, &(rb_rolling_range){RB_OVER_CREEP, 0.0, 0.003, POINTS, RB_UNITS_MM}, &c,
            &message));
        assert_int_equal(c.n, 2 * POINTS);
        assert_int_equal(c.rising, POINTS);
        for (int i = 0; i < c.n; i++) {
            CHECK_MAX(c.residual[i], 1e-10, "point %d", i);
            assert_int_equal(c.branch[i], i < POINTS ? 1 : 2);
            CHECK_ABS(c.creepage[i], c.creepage[c.n - 1 - i], 1e-15, "creepage %d", i);
            widest = fmax(widest, fabs(c.force_ratio[i] - c.force_ratio[c.n - 1 - i]));
        }
        if (c.kappa[0] < 0.9 || rc.mesh == RB_MESH_FITTED)
            CHECK_MAX(widest, 1e-8, "kappa = %g", c.kappa[0]);
        else
            assert_true(widest > 3e-4);
    }
}

/* Fitted elements take the slip at their midpoints: Q is of second order, as with constant
 * friction, and that of aligned elements, whose slip is of second order by itself. */
TEST(fitted_elements_are_of_second_order)
{
    enum { MESHES = 4 };
    static const int n[MESHES] = {40, 80, 160, 640};
    static const char *const laws[] = {"friction-law exponential", "friction-law linear",
                                       "friction-law exponential memory 1e-4,0.5",
                                       "friction-law rational memory 1e-5,0.1"};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; k++) {
        double Q[MESHES];
        rb_rolling_case rc = with(similar_planes(RB_STEADY, 320),
                                  "zone auto creep-ratio 0.5 speed 1000 mu 0.2 mu-fall 0.1 "
                                  "slip-scale 5 slip-operator second mesh aligned");
        set(&rc, "%s", laws[k]);
        const double by_other = ratio_of(&rc);
        for (int m = 0; m < MESHES; m++) {
            set(&rc, "slip-operator upstream mesh fitted contact-elements %d", n[m]);
            Q[m] = ratio_of(&rc);
        }
        print_message("# %s: %.2g %.2g %.2g, aligned %.2g\n", laws[k], Q[0] / Q[3] - 1.0,
                      Q[1] / Q[3] - 1.0, Q[2] / Q[3] - 1.0, by_other / Q[3] - 1.0);
        for (int m = 0; m < MESHES - 1; m++)
            CHECK_REL(Q[m], Q[3], 2.0 / (n[m] * n[m]), "%s, %d elements", laws[k], n[m]);
        CHECK_REL(by_other, Q[3], 2e-5, "aligned");
    }
}

/* Two states of the same problem, both to rounding: a change of mu by one of the two
 * residuals would be 1e-13, they are 1e-4 apart, and half-way between them Coulomb's law
 * is violated.  One element at the end of the stick zone sticks in one of them and slips
 * in the other: the difference falls with the elements (theory-rolling.md F3). */
TEST(one_element_more_may_stick)
{
    static const double creep[] = {0.0009, 0.0012}, apart[] = {1.3044e-4, 3.7478e-5};
    /* 186 elements show the same once more */
    for (int k = 0; k < (getenv("ROLLBEM_TEST_ALL") ? 2 : 1); k++) {
        rb_rolling_case rc = rail(17.6); /* kappa = 0.97 */
        OWNED(rb_rolling_solutions) found;
        set(&rc, "contact-elements %d creep %g tol 1e-12", 93 * (k + 1), creep[k]);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        rb_contact_violation middle;
        CHECK_OK(rb_rolling_find_solutions(&model, &found, &message));
        assert_int_equal(found.n, 2);
        const rb_rolling_solution *s = found.solution;
        CHECK_ABS(fabs(s[1].force_ratio - s[0].force_ratio), apart[k], 1e-8, "apart");
        assert_int_equal(abs(s[1].stick - s[0].stick), 1);
        for (int i = 0; i < 2; i++)
            CHECK_MAX(s[i].residual, 5e-13, "solution %d", i);
        for (int i = 0; i < s[0].n; i++) {
            model.state.q[i] = 0.5 * (s[0].q[i] + s[1].q[i]);
            model.problem.bound[i] = 0.5 * (s[0].mu[i] + s[1].mu[i]);
        }
        CHECK_OK(rb_contact_residual(&model.problem, &model.state, &middle));
        assert_true(middle.scaled > 1e-5);
    }
}

/* Laws so steep that the iteration leaves every solution: Newton's method holds one, on
 * bodies whose pressure and friction are coupled. */
TEST(steep_laws_are_solved)
{
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_exponential, RB_FRICTION_rational,
                                                   RB_FRICTION_linear};
    for (int k = 0; k < 9; k++) {
        rb_rolling_case rc = rail(4.8 / (1 + k % 3)); /* kappa = 2.5 ... 7.5 */
        double kappa;
        char what[40];
        set(&rc, "zone auto mesh fitted contact-elements 60 creep -0.002");
        rc.friction.law = laws[k / 3];
        rc.elastic_b = 0;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_OK(rb_rolling_law_kappa(&model, &kappa));
        assert_true(kappa > 1.5);
        snprintf(what, sizeof what, "law %d, kappa = %g", k / 3, kappa);
        check_state(&model, NULL, what);
    }
}

/* Short steps have kappa far above 1, and none of their solutions attracts the iteration:
 * step 19 here ended after 2000 rounds. */
TEST(short_steps_are_solved)
{
    if (!is_in_turn(0, 3))
        skip();
    rb_rolling_case rc = with(rail(500.0), "load 12500");
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    rc.a.young = rc.b.young = 210000.0;
    set(&rc,
        "poisson 0.3 poisson-b 0.3 formulation transient creep nan force-ratio -0.5 zone auto "
        "contact-elements 1500 distance %g steps 19",
        19.0 * 0.2 / 116.0);
    CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &message));
    assert_int_equal(h.n, 20);
    check_state(&model, NULL, "the last step");
    for (int k = 0; k < h.n; k++) {
        CHECK_MAX(h.residual[k], 1e-10, "step %d", k);
        CHECK_ABS(h.force_ratio[k], -0.5, 1e-9, "step %d", k);
    }
}

/* The contact of dissimilar bodies moves with the creepage: meshes are fitted again, and
 * the branch goes on from the coefficients before. */
TEST(branches_outlive_their_mesh)
{
    IN_TURN(1, 8);
    rb_rolling_case rc = with(rail(2.0), "zone auto mesh fitted contact-elements 60 creep nan");
    OWNED(rb_rolling_curve) c;
    double widest = 0.0;
    rc.elastic_b = 0;
    CHECK_OK(rb_rolling_curve_solve(
        &rc, &(rb_rolling_range){RB_OVER_CREEP, -0.003, 0.003, 13, RB_UNITS_MM}, &c, &message));
    for (int i = 0; i < c.n; i++) {
        CHECK_MAX(c.residual[i], 1e-10, "point %d", i);
        widest = fmax(widest, fabs(c.force_ratio[i] - c.force_ratio[c.n - 1 - i]));
    }
    assert_true(widest > 1e-5 && widest < 1e-3);
}

/* All solutions of the rail case; each is one by the formula. */
TEST(all_solutions_are_found)
{
    static const struct {
        double scale;
        int n;
        double ratio[3];
    } all[] = {{100.0, 1, {0.594329}},
               {15.5, 1, {0.537422}},
               {10.0, 2, {0.530975, 0.530624}},
               {5.0, 3, {0.527508, 0.526808, 0.526376}}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        rb_rolling_case rc = rail(all[k].scale);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        OWNED(rb_rolling_solutions) found;
        CHECK_OK(rb_rolling_find_solutions(&model, &found, &message));
        assert_int_equal(found.n, all[k].n);
        assert_int_equal(found.failed, 0);
        for (int i = 0; i < found.n; i++) {
            const rb_rolling_solution *s = &found.solution[i];
            CHECK_ABS(-s->force_ratio, all[k].ratio[i], 1e-6, "solution %d", i);
            CHECK_MAX(s->residual, 1e-10, "solution %d", i);
            memcpy(model.state.p, s->p, (size_t)s->n * sizeof(double));
            memcpy(model.state.q, s->q, (size_t)s->n * sizeof(double));
            memcpy(model.state.lambda, s->shift, (size_t)s->n * sizeof(double));
            memcpy(model.state.zone, s->zone, (size_t)s->n * sizeof(int));
            model.state.delta = s->approach;
            memcpy(model.problem.bound, s->mu, (size_t)s->n * sizeof(double));
            check_state(&model, NULL, "one of all");
        }
    }
    rb_rolling_case rc = with(rail(10.0), "creep nan force-ratio -0.2");
    OWNED(rb_rolling_solutions) none;
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_SAYS(rb_rolling_find_solutions(&model, &none, &message), RB_EINVAL,
               "at a given creepage");
}

/* ---- A given force ----------------------------------------------------------------- */

TEST(a_force_is_met_on_the_rising_branch)
{
    for (int k = 0; k < 5; k++) {
        rb_rolling_case rc = with(rail(100.0), "creep nan force-ratio %g", k < 2 ? -0.7 : NAN);
        rc.force = k == 2 ? 600.0 : k == 3 ? -750.0 : NAN;
        rc.free_axle = k == 4;
        if (k == 1) { /* P is not known beforehand */
            set(&rc, "load nan approach 0.09");
        }
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_MAX(s.residual, 1e-10, "case %d", k);
        if (k < 2)
            CHECK_ABS(s.force_ratio, -0.7, 1e-9, "ratio, case %d", k);
        if (k == 2 || k == 3)
            CHECK_REL(s.tangential_load, rc.force, 1e-9, "force, case %d", k);
        if (k == 4)
            CHECK_ABS(s.tangential_load, -s.resistance_moment / 460.0, 1e-7, "axle");
        assert_true(s.creepage * s.tangential_load <= 0.0);
        assert_true(fabs(s.creepage) < 0.0021); /* where the force is the largest */
        set(&rc, "force nan force-ratio nan creep %g", s.creepage);
        rc.free_axle = 0;
        CHECK_ABS(ratio_of(&rc), s.force_ratio, 1e-8, "the same by its creepage, %d", k);
    }
}

/* Much friction between unlike bodies, whose contact has several states at a creepage;
 * the law alone would leave one. */
static rb_rolling_case wheel_on_layer(void)
{
    static const double worn_x[] = {-0.9, -0.3, 0.2, 0.8}, worn_depth[] = {0.0, 2e-4, 3e-4, 0.0};
    rb_rolling_case rc =
        rolling_case("support hub support-b halfplane young-b 200000 poisson-b 0.28 radius-b 80 "
                     "layer-thickness-b 2 formulation steady gap parabola");
    rc.worn.n = 4;
    rc.worn.x = worn_x;
    rc.worn.y = worn_depth;
    set(&rc, "normals obstacle near-field plain mesh fitted contact-elements 40 half-width 1 "
             "speed 3000 mu 3");
    rc.friction = (rb_rolling_friction){
        .law = RB_FRICTION_rational, .fall = {0.1, 0.05}, .slip_scale = {20.0, 5.0}};
    return rc;
}

/* The same by a force ratio under a load that is not known beforehand. */
TEST(a_force_is_met_between_states_of_one_creepage)
{
    for (int k = 0; k < 4; k++) {
        double Q = 0.0, kappa;
        rb_rolling_case rc = with(wheel_on_layer(), "force %g", k < 3 ? 160.0 + 20.0 * k : NAN);
        if (k == 3) {
            set(&rc, "half-width nan approach 0.0588 force-ratio 0.034");
        }
        rb_rolling_model model = solved_model(&rc);
        const double xi = model.state.xi;
        check_state(&model, NULL, "between states");
        CHECK_MAX(model.state.residual, 1e-10, "case %d", k);
        for (int i = 0; i < model.mesh.n; i++)
            Q += model.bodies.f.h[i] * model.state.q[i];
        if (k < 3)
            CHECK_REL(Q, rc.force, 1e-9, "force, case %d", k);
        else
            CHECK_ABS(rb_rolling_force_ratio(&model), 0.034, 1e-11, "ratio");
        CHECK_OK(rb_rolling_law_kappa(&model, &kappa));
        assert_true(kappa < 1.0);
        rb_rolling_model_free(&model);
        for (int side = -1; side <= 1; side += 2) { /* it grows there */
            rb_rolling_case near = rc;
            set(&near, "force nan force-ratio nan creep %g", (1.0 + 0.01 * side) * xi);
            model = solved_model(&near);
            assert_true(side * (rb_rolling_model_force(&model) - Q) > 0.0);
            rb_rolling_model_free(&model);
        }
    }
}

TEST(the_largest_force_is_told)
{
    rb_rolling_case rc = with(rail(100.0), "creep nan force -800");
    OWNED(rb_rolling_model) model;
    double force, at;
    CHECK_STATUS(rb_rolling_model_create(&rc, &model, &message), RB_EINVAL);
    const char *largest = NOT_NULL(strstr(message.text, "the largest is "));
    assert_int_equal(sscanf(largest, "the largest is %lf N/mm, at creepage %lf", &force, &at), 2);
    CHECK_REL(force, -754.453, 1e-5, "largest force");
    rc.force = NAN;
    for (int k = -1; k <= 1; k++) {
        rc.creep = at * (1.0 + 0.05 * k);
        const double Q = ratio_of(&rc) * 0.3 * 3111.08;
        if (k == 0)
            CHECK_REL(Q, force, 1e-5, "at that creepage");
        else
            assert_true(fabs(Q) < fabs(force));
    }
}

/* Unlike bodies roll freely at a creepage of their own: at creepage 0 this wheel is on
 * the falling branch of the other direction, where the search for a force begins. */
TEST(a_force_is_met_from_beyond_free_rolling)
{
    rb_rolling_case rc = rolling_case("poisson 0");
    rc.b = (rb_rolling_body){
        .young = 900000.0, .poisson = -0.5, .radius = INFINITY, .support = RB_BEM_HALFPLANE};
    set(&rc, "approach 0.01 formulation steady mesh fitted slip-operator upstream "
             "contact-elements 100 speed 1000 force-ratio 0.9");
    rc.elastic_b = 1;
    rc.friction = (rb_rolling_friction){
        .law = RB_FRICTION_exponential, .fall = {0.2, 0.0}, .slip_scale = {5.0, 5.0}};
    rb_rolling_model model = solved_model(&rc);
    CHECK_REL(rb_rolling_force_ratio(&model), 0.9, 1e-9, "force");
    const double creepage = model.state.xi, Q = rb_rolling_model_force(&model);
    rb_rolling_model_free(&model);
    set(&rc, "force-ratio nan creep %g", creepage);
    model = solved_model(&rc);
    CHECK_REL(rb_rolling_model_force(&model), Q, 1e-3, "at that creepage");
    rb_rolling_model_free(&model);
}

/* ---- Steps ------------------------------------------------------------------------- */

typedef struct {
    double *before;
    int n;
} steps_record;

static int see_step(const rb_rolling_model *model, const rb_rolling_history *h, int step, int steps,
                    void *context)
{
    steps_record *record = context;
    const int n = model->mesh.n;
    (void)steps;
    if (model->rc->formulation == RB_TRANSIENT)
        check_state(model, record->before, "step");
    assert_true(step < 200 && n <= record->n);
    const double *mu = model->problem.bound, way = h->step / model->bodies.f.h[0];
    assert_true(way > 0.5 && way <= 1.0 + 1e-9); /* of an element, towards the next */
    for (int i = 0; i < n; i++)
        record->before[i] = mu[i] + way * ((i + 1 < n ? mu[i + 1] : 0.3) - mu[i]);
    return 0;
}

/* Every step by the formula; with memory it becomes steady rolling. */
TEST(steps_remember_their_friction)
{
    for (int memory = 0; memory < 2; memory++) {
        rb_rolling_case rc = rail(100.0);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) history;
        double room[200];
        steps_record record = {room, 200};
        rc.contact_elements = 47;
        rc.friction.memory = memory ? 0.003 : 0.0;
        rc.friction.memory_slip = 1.0;
        const double steady = ratio_of(&rc);
        set(&rc, "formulation transient distance 6");
        rc.a.datum = rc.b.datum = 10.0; /* stiff, so that it is steady soon */
        CHECK_OK(rb_rolling_history_run(&rc, NULL, &(rb_rolling_observer){see_step, &record},
                                        &model, &history, &message));
        if (memory) /* without it the steps jump between solutions */
            CHECK_ABS(history.force_ratio[history.n - 1], steady, 2e-3, "steady at last");
    }
}

/* ---- mu over the rolled way -------------------------------------------------------- */

/* A wheel that rolls on a rigid plane (pressure and friction are coupled) or on its like. */
static rb_rolling_case on_its_way(int coupled, rb_rolling_formulation formulation)
{
    rb_rolling_case rc = rail(100.0);
    set(&rc, "creep nan zone auto contact-elements 40 mu 0.2 datum 10 datum-b 10");
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
    rc.formulation = formulation;
    rc.elastic_b = !coupled;
    return rc;
}

static rb_rolling_history run_of(const rb_rolling_case *rc, const rb_rolling_program *program,
                                 rb_rolling_step *see, void *context, rb_rolling_model *model)
{
    const rb_rolling_observer observer = {see, context};
    rb_rolling_history history;
    CHECK_OK(rb_rolling_history_run(rc, program, &observer, model, &history, &message));
    return history;
}

/* The same numbers, to the last bit, as the case's own mu. */
TEST(a_column_of_one_mu_is_that_mu)
{
    static const double load[] = {800.0, 2500.0, 3000.0, 3000.0},
                        shift[] = {0.0, 0.004, 0.008, -0.002},
                        creep[] = {0.0, 0.001, 0.0003, 0.0005}, distance[] = {0.0, 0.3, 0.7, 1.1},
                        mu[] = {0.2, 0.2, 0.2, 0.2};
    for (int k = 0; k < 6; k++) { /* at rest, rolling, with friction that falls; B twice */
        rb_rolling_case rc = on_its_way(k % 2, k < 2 ? RB_STATIC : RB_TRANSIENT);
        rb_rolling_program program = {.n = 4, .load = load};
        rb_rolling_model model[2];
        rb_rolling_history h[2];
        *(k < 2 ? &program.shift : &program.creep) = k < 2 ? shift : creep;
        program.distance = k < 2 ? NULL : distance;
        if (k >= 4)
            rc.friction = (rb_rolling_friction){.law = RB_FRICTION_rational,
                                                .fall = {0.1, 0.0},
                                                .slip_scale = {100.0, 1.0},
                                                .memory = 0.01,
                                                .memory_slip = 1.0};
        h[0] = run_of(&rc, &program, NULL, NULL, &model[0]);
        program.mu = mu;
        rc.mu = 0.7; /* what the column replaces */
        h[1] = run_of(&rc, &program, NULL, NULL, &model[1]);
        const size_t steps = (size_t)h[0].n * sizeof(double),
                     bytes = (size_t)model[0].mesh.n * sizeof(double);
        assert_int_equal(h[0].n, h[1].n);
        assert_null(h[0].mu);
        for (int i = 0; i < h[1].n; i++)
            CHECK_ABS(h[1].mu[i], 0.2, 0.0, "mu of step %d", i);
        assert_memory_equal(h[0].tangential_load, h[1].tangential_load, steps);
        assert_memory_equal(h[0].force_ratio, h[1].force_ratio, steps);
        assert_memory_equal(h[0].approach, h[1].approach, steps);
        assert_memory_equal(h[0].residual, h[1].residual, steps);
        assert_int_equal(model[0].mesh.n, model[1].mesh.n);
        assert_memory_equal(model[0].state.p, model[1].state.p, bytes);
        assert_memory_equal(model[0].state.q, model[1].state.q, bytes);
        for (int j = 0; j < 2; j++) {
            rb_rolling_model_free(&model[j]);
            rb_rolling_history_free(&h[j]);
        }
    }
}

/* Coulomb's law of a step with the mu that the rows say, and the slip that the tractions
 * before it and after it leave. */
typedef struct {
    const rb_rolling_program *program;
    double w[200]; /* of the step before: at the same places, and one element ahead */
    int steps, slips;
} way_seen;

static int see_way(const rb_rolling_model *model, const rb_rolling_history *h, int step, int steps,
                   void *context)
{
    way_seen *record = context;
    const rb_rolling_program *program = record->program;
    const rb_contact_problem *p = &model->problem;
    const rb_contact_state *s = &model->state;
    const int n = p->n, m = n + 1, rolls = model->rc->formulation == RB_TRANSIENT;
    double w[200], mu = program->mu[step < program->n ? step : program->n - 1];
    (void)steps;
    assert_true(2 * m <= 200);
    CHECK_OK(rb_rolling_displacement(&model->bodies, s->p, s->q, w));
    if (rolls) {
        int r = 1;
        while (r + 1 < program->n && program->distance[r] < h->distance[step])
            r++;
        const double from = program->distance[r - 1], to = program->distance[r],
                     t = (h->distance[step] - from) / (to - from);
        mu = (1.0 - t) * program->mu[r - 1] + t * program->mu[r];
    }
    CHECK_ABS(h->mu[step], mu, 1e-12, "mu of step %d", step);
    for (int i = 0; i < n; i++) {
        const double before = step > 0 ? record->w[m + i + rolls] : 0.0,
                     slip = s->xi * (rolls ? h->step : 1.0) + w[m + i] - before,
                     small = 1e-9 * p->stress;
        if (s->p[i] == 0.0)
            continue;
        assert_true(fabs(s->q[i]) <= mu * s->p[i] + small);
        if (fabs(s->q[i]) < mu * s->p[i] - small)
            CHECK_ABS(slip, 0.0, 1e-9 * p->slip_length, "step %d, element %d", step, i);
        else
            assert_true(s->q[i] * slip <= 1e-9 * p->slip_length * p->stress);
        record->slips += fabs(slip) > 1e-6 * p->slip_length;
    }
    memcpy(record->w, w, 2 * (size_t)m * sizeof *w);
    record->steps++;
    return 0;
}

/* Friction falls and rises again, at rest under a shift that stays and rolling. */
TEST(steps_have_the_friction_of_their_way)
{
    static const double load[] = {3000.0, 3000.0, 3000.0, 3000.0, 3000.0},
                        shift[] = {0.0, 0.005, 0.005, 0.005, -0.004},
                        creep[] = {0.001, 0.001, 0.001, 0.001, 0.001},
                        distance[] = {0.0, 0.3, 0.5, 0.8, 1.5}, mu[] = {0.3, 0.3, 0.1, 0.4, 0.05};
    for (int k = 0; k < 4; k++) {
        const int rolls = k >= 2;
        rb_rolling_case rc = on_its_way(k % 2, rolls ? RB_TRANSIENT : RB_STATIC);
        rb_rolling_program program = {.n = 5, .load = load, .mu = mu};
        rb_rolling_model model;
        way_seen record = {.program = &program};
        *(rolls ? &program.creep : &program.shift) = rolls ? creep : shift;
        program.distance = rolls ? distance : NULL;
        rc.load = 3000.0;
        rc.increments = 1; /* what is seen of a row is its last step */

        rb_rolling_history h = run_of(&rc, &program, NULL, NULL, &model);
        const double way = h.half_width, element = model.bodies.f.h[0];
        rb_rolling_model_free(&model);
        rb_rolling_history_free(&h);
        double whole[5];
        for (int r = 0; r < 5 && rolls; r++)
            whole[r] = round(distance[r] * way / element) * element / way;
        program.distance = rolls ? whole : NULL;
        h = run_of(&rc, &program, see_way, &record, &model);
        assert_int_equal(record.steps, h.n);
        assert_true(record.slips > 10);
        if (!rolls) /* less friction lets slip what stuck, more friction holds it */
            assert_true(h.slipping[2] > h.slipping[1] && h.slipping[3] == 0 &&
                        fabs(h.tangential_load[3] - h.tangential_load[2]) <
                            1e-9 * fabs(h.tangential_load[2]));
        rb_rolling_model_free(&model);
        rb_rolling_history_free(&h);
    }
}

/* Rolled on far enough, a contact whose friction has changed is that of the new mu; so it
 * is with friction that falls with the slip, whose kinetic limit the column is. */
TEST(friction_that_has_changed_becomes_steady)
{
    static const double mu[] = {0.3, 0.3, 0.15, 0.15}, distance[] = {0.0, 1.0, 1.01, 12.0};
    for (int falls = 0; falls < 2; falls++) {
        rb_rolling_case rc = with(on_its_way(0, RB_TRANSIENT), "creep 0.0008");
        const rb_rolling_program program = {.n = 4, .distance = distance, .mu = mu};
        OWNED(rb_rolling_model) model;
        if (falls)
            rc.friction = (rb_rolling_friction){.law = RB_FRICTION_exponential,
                                                .fall = {0.05, 0.0},
                                                .slip_scale = {100.0, 1.0},
                                                .memory = 0.003,
                                                .memory_slip = 1.0};
        OWNED(rb_rolling_history) h = run_of(&rc, &program, NULL, NULL, &model);
        set(&rc, "mu 0.15 formulation steady mesh uniform zone %g contact-elements %d",
            model.mesh.ends[model.mesh.n], model.mesh.n);
        OWNED(rb_rolling_solution) steady = solved(&rc);
        CHECK_REL(h.tangential_load[h.n - 1], steady.tangential_load, 1e-3, "force");
        CHECK_REL(h.force_ratio[h.n - 1], steady.force_ratio, 1e-3, "ratio");
        assert_true(fabs(h.tangential_load[0]) < 1e-6 * fabs(steady.tangential_load));
        assert_int_equal(h.stick[h.n - 1], steady.stick);
    }
}

TEST(bad_ways_are_refused)
{
    static const double mu[] = {0.3, -0.1}, distance[] = {0.0, 1.0}, place = 0.0;
    rb_rolling_case rc = on_its_way(0, RB_TRANSIENT);
    rb_rolling_program program = {.n = 2, .distance = distance, .mu = mu};
    rb_rolling_model model;
    rb_rolling_history h;
    CHECK_STATUS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL);
    assert_string_equal(message.text, "history: row 2: mu: expected a number >= 0, got -0.1");
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_table, .table = {1, &place, mu}};
    CHECK_SAYS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL,
               "a column mu cannot be combined with a table");
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_constant};
    static const double less[] = {0.1, 0.3}, load[] = {100.0, 12500.0}, force[] = {10.0, 3700.0};
    const rb_rolling_program between = {
        .n = 2, .distance = distance, .mu = less, .load = load, .force = force};
    CHECK_SAYS(rb_rolling_history_run(&rc, &between, NULL, &model, &h, &message), RB_EINVAL,
               "step 2: force: Q = ");
    assert_non_null(strstr(message.text, "friction carries at most mu P = "));
    rb_rolling_model_free(&model);
    rb_rolling_history_free(&h);
    rc.force = 800.0; /* mu P becomes 0 */
    program.mu = distance;
    CHECK_SAYS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL,
               "history: row 1: force");
}

/* One step of an element's length at 0.1 % creepage from the steady state of 0.09999 %
 * (case 2 and 3 of veldep_fric.inp): from below CONTACT has 0.5977, 77 stick, 4 slip. */
TEST(a_step_has_two_starts)
{
    static const double kinetic = 0.18;
    double ratio[2];
    for (int start = 0; start < 2; start++) {
        rb_rolling_case rc = rail(100.0);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        const int n = model.mesh.n, m = n + 1;
        SCRATCH double *w = rb_alloc(2 * (size_t)m, 1), *before = rb_alloc((size_t)n, 1);
        assert_true(w && before);
        CHECK_OK(rb_rolling_displacement(&model.bodies, model.state.p, model.state.q, w));
        const rb_rolling_past past = {.w_T = w + m + 1, .step = 0.1};
        memcpy(before, model.problem.bound, (size_t)n * sizeof *before);
        rb_contact_problem_free(&model.problem);
        case_of_model(&model)->formulation = RB_TRANSIENT;
        case_of_model(&model)->creep = 0.001;
        model.carried.mu = before;
        CHECK_OK(rb_rolling_problem_create(model.rc, &model.mesh, &model.bodies, &past,
                                           &model.problem, &message));
        for (int i = 0; i < n && start; i++)
            model.problem.bound[i] = kinetic;
        const rb_status s = rb_rolling_model_resolve(&model, 1, &message);
        if (s != RB_OK)
            print_error("%s\n", message.text);
        CHECK_OK(s);
        check_state(&model, before, start ? "from above" : "from below");
        ratio[start] = -rb_rolling_force_ratio(&model);
        int stick = 0;
        for (int i = 0; i < n; i++)
            stick += model.state.zone[i] == RB_ZONE_STICK;
        if (start == 0) {
            CHECK_ABS(ratio[0], 0.5977, 5e-4, "CONTACT");
            CHECK_ABS(ratio[0], 0.5978, 6e-5, "theory-rolling.md F5");
            assert_int_equal(stick, 77);
        }
    }
    assert_true(ratio[0] - ratio[1] > 1e-3);
}

/* ---- Heat -------------------------------------------------------------------------- */

static rb_rolling_case warm(double creep_ratio)
{
    rb_rolling_case rc = with(rail(100.0),
                              "load nan creep nan half-width 6 zone auto mesh fitted "
                              "contact-elements 60 creep-ratio %g mu 0.3",
                              creep_ratio);
    const rb_rolling_heat steel = {50.0, 3.5, 20.0};
    rc.heat_a = rc.heat_b = steel;
    rc.friction = (rb_rolling_friction){
        .law = RB_FRICTION_constant, .heat = -0.18, .heat_from = 20.0, .heat_range = 400.0};
    return rc;
}

/* Coefficients by the printed temperatures, and the residual with them. */
TEST(warm_surfaces_have_another_friction)
{
    static const double ratio[] = {0.5, 2.0, 8.0};
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = warm(ratio[k % 3]);
        if (k >= 3)
            rc.friction.heat = 0.2;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_MAX(s.residual, 1e-10, "case %d", k);
        assert_true(s.max_temperature > 25.0);
        for (int i = 0; i < s.n; i++) {
            const double part = (s.temperature[i] - 20.0) / 400.0;
            const double mu =
                0.3 + rc.friction.heat * (s.p[i] > 0.0 ? fmin(fmax(part, 0.0), 1.0) : 0.0);
            CHECK_ABS(s.mu[i], mu, 1e-9, "case %d, element %d", k, i);
        }
        if (k % 3 == 2) /* full sliding */
            assert_true(k < 3 ? s.force_ratio > -0.95 : s.force_ratio < -0.6);
    }
}

/* Bodies of unlike warmth that change places, at the opposite creepage: what friction remembers
 * begins with the coefficient that they have where they touch, not with that of one of them. */
TEST(warm_and_cold_bodies_may_change_places)
{
    static const rb_rolling_heat hot = {50.0, 3.5, 120.0}, cold = {20.0, 2.0, 0.0};
    rb_rolling_solution s[2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = warm(k ? -0.5 : 0.5);
        rc.heat_a = k ? cold : hot;
        rc.heat_b = k ? hot : cold;
        rc.friction.memory = 0.05;
        rc.friction.memory_slip = 1.0;
        s[k] = solved(&rc);
    }
    CHECK_REL(s[1].force_ratio, -s[0].force_ratio, 1e-9, "Q");
    for (int i = 0; i < s[0].n; i++)
        CHECK_REL(s[1].mu[i], s[0].mu[i], 1e-9, "element %d", i);
    rb_rolling_solution_free(&s[0]);
    rb_rolling_solution_free(&s[1]);
}

/* Far along the way the steps are as warm as steady rolling. */
TEST(steps_become_warm)
{
    rb_rolling_case rc = with(warm(2.0), "mesh uniform");
    rb_rolling_solution s;
    CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
    const double steady = s.force_ratio;
    rb_rolling_solution_free(&s);
    set(&rc, "formulation transient distance 4");
    CHECK_OK(rb_rolling_solve(&rc, &s, &message));
    CHECK_ABS(s.force_ratio, steady, 2e-3, "transient");
    for (int i = 0; i < s.n; i++) {
        const double part = (s.temperature[i] - 20.0) / 400.0;
        const double mu = 0.3 - 0.18 * (s.p[i] > 0.0 ? fmin(fmax(part, 0.0), 1.0) : 0.0);
        CHECK_ABS(s.mu[i], mu, 1e-9, "element %d", i);
    }
    rb_rolling_solution_free(&s);
}

/* Pressed and loaded at rest nothing is warm: the force is the given one, and not that of
 * the largest coefficient. */
TEST(heat_changes_no_force_at_rest)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(warm(NAN),
                                  "formulation static mesh uniform conductivity none "
                                  "conductivity-b 0 force %g force-ratio %g",
                                  k == 0 ? 500.0 : NAN, k == 0 ? NAN : 0.4);
        rc.friction.heat = 0.2;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(s.tangential_load, k == 0 ? 500.0 : 0.4 * 0.3 * s.normal_load, 1e-9,
                  "force, case %d", k);
    }
}

/* ---- At rest (F6) ------------------------------------------------------------------ */

/* Cattaneo and Mindlin with a static coefficient 1.5 times the kinetic one, lengths in units of
 * mu p0 a/E* = 1e-3 mm; datum: of both bodies [a]. */
static rb_rolling_case pushed(int elements, double distance, double datum)
{
    rb_rolling_case rc = rolling_case(
        "support halfplane gap parabola similar young 210000 poisson 0.3 radius 100 half-width 1 "
        "mu 0.2 formulation static contact-elements %d datum %g datum-b %g",
        elements, datum, datum);
    rc.friction = (rb_rolling_friction){.law = RB_FRICTION_exponential,
                                        .fall = {0.1, 0.0},
                                        .memory = 1e-3 * distance,
                                        .memory_slip = 1.0};
    return rc;
}

/* That of full sliding with the kinetic coefficient. */
static double kinetic(const rb_rolling_case *rc)
{
    return rc->mu * rb_rolling_derive(rc).load;
}

static double largest_of(rb_rolling_case rc, double *shift)
{
    rb_rolling_model model;
    double force;

    rc.force = 1.49 * kinetic(&rc);
    CHECK_STATUS(rb_rolling_model_create(&rc, &model, &message), RB_EINVAL);
    const char *largest = NOT_NULL(strstr(message.text, "the largest is "));
    assert_int_equal(
        sscanf(largest, "the largest is %lf N/mm, at a shift of %lf mm", &force, shift), 2);
    rb_rolling_model_free(&model);
    return force / kinetic(&rc);
}

/* Values of a second program, which follows the shift in 200 increments and more; for short
 * distances slip spreads like a crack whose toughness is the work of the fall, and the largest
 * force is that of c = 0.096 (+-1e-3). */
TEST(a_static_coefficient_counts_by_its_distance)
{
    static const struct {
        int elements;
        double distance, datum, force;
    } of[] = {{400, 0.005, 36.788, 1.0162},
              {200, 0.02, 36.788, 1.0398},
              {100, 0.05, 36.788, 1.0722},
              {100, 0.05, 100.0, 1.0722},
              {100, 0.2, 36.788, 1.1700}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        if (!is_in_turn((int)k, 5))
            continue;
        double at;
        const rb_rolling_case rc = pushed(of[k].elements, of[k].distance, of[k].datum);
        CHECK_ABS(largest_of(rc, &at), of[k].force, 1.2e-3, "d %g, datum %g", of[k].distance,
                  of[k].datum);
    }
}

TEST(the_coefficients_at_rest_follow_from_the_slip)
{
    rb_rolling_case rc = pushed(60, 0.3, 36.788);
    rc.shift = 4e-3;
    OWNED(rb_rolling_model) model = solved_model(&rc);
    int slips = 0;
    for (int i = 0; i < model.mesh.n; i++) {
        const double slid =
            model.state.zone[i] > RB_ZONE_STICK ? fabs(model.state.lambda[i]) / 3e-4 : 0.0;
        if (model.state.zone[i] != RB_ZONE_SEPARATED)
            CHECK_ABS(model.problem.bound[i], 0.2 + 0.1 * exp(-slid), 1e-9, "element %d", i);
        slips += slid > 0.0;
    }
    assert_true(slips > 10);
    /* neither speed nor scale counts, and beside the distance the kind of law neither */
    const double Q = rb_rolling_model_force(&model);
    rc.friction.law = RB_FRICTION_linear;
    rc.friction.slip_scale[0] = 7.0;
    rc.speed = 3.0;
    OWNED(rb_rolling_model) other = solved_model(&rc);
    CHECK_REL(rb_rolling_model_force(&other), Q, 1e-12, "force");
}

/* Under a shift that grows the contact jumps to full sliding, from the largest force, however many
 * rows are given; with a long distance it slides before the force falls. */
TEST(jumps_are_told)
{
    static const struct {
        int rows;
        double distance;
    } of[] = {{12, 0.05}, {1, 0.05}, {12, 0.2}, {12, 0.5}};
    for (int k = 0; k < 4; k++) {
        double shift[13], most, at;
        const rb_rolling_case rc = pushed(60, of[k].distance, 36.788);
        const rb_rolling_program program = {.n = of[k].rows + 1, .shift = shift};
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        for (int row = 0; row <= of[k].rows; row++)
            shift[row] = 6e-3 * row / of[k].rows;
        CHECK_OK(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message));
        most = -largest_of(rc, &at) * kinetic(&rc);
        if (of[k].distance == 0.5) {
            assert_int_equal(h.rows.jumped, 0);
            CHECK_REL(h.tangential_load[h.n - 1], -1.2501 * kinetic(&rc), 1e-3, "at the end");
            continue;
        }
        assert_int_equal(h.rows.jumped, 1 + (int)ceil(-at / 6e-3 * of[k].rows));
        CHECK_REL(h.rows.jump_force, most, 5e-3, "%d rows: force", of[k].rows);
        CHECK_REL(h.rows.jump_shift, -at, 5e-3, "%d rows: shift", of[k].rows);
        CHECK_REL(h.tangential_load[h.n - 1], -kinetic(&rc), 1e-3, "at the end");
    }
}

/* Computed in other steps again, a first row begins with bodies that have not slid: similar ones
 * slide as little while they are pressed together, so that a row before it changes nothing. */
TEST(a_first_row_jumps_as_a_second_one_does)
{
    static const double shift[] = {0.0, 6e-3}, load[] = {900.0, 900.0};
    const rb_rolling_case rc = with(pushed(36, 0.05, 36.788), "half-width nan load 900");
    const rb_rolling_program one = {.n = 1, .shift = shift + 1, .load = load},
                             two = {.n = 2, .shift = shift, .load = load};
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_model) other;
    OWNED(rb_rolling_history) h;
    OWNED(rb_rolling_history) want;
    CHECK_OK(rb_rolling_history_run(&rc, &one, NULL, &model, &h, &message));
    CHECK_OK(rb_rolling_history_run(&rc, &two, NULL, &other, &want, &message));
    assert_int_equal(want.rows.jumped, 2);
    assert_int_equal(h.rows.jumped, 1);
    assert_int_equal(h.substeps[0], 2 * want.substeps[1]); /* half of them press */
    CHECK_REL(h.rows.jump_force, want.rows.jump_force, 1e-9, "force");
    CHECK_REL(h.rows.jump_shift, want.rows.jump_shift, 1e-9, "shift");
    CHECK_REL(h.friction_work[0], want.friction_work[1], 1e-9, "work");
}

/* In as many steps from the beginning: dissimilar bodies slide while they are pressed together. */
TEST(a_first_row_does_not_depend_on_the_steps_tried_before)
{
    static const double shift[] = {4e-3}, load[] = {900.0};
    const rb_rolling_program program = {.n = 1, .shift = shift, .load = load};
    rb_rolling_case rc = rolling_case("support halfplane gap parabola young 210000 poisson 0.1 "
                                      "radius 100 load 900 mu 0.2 formulation static "
                                      "contact-elements 16");
    rc.friction = pushed(16, 0.2, NAN).friction;
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_model) other;
    OWNED(rb_rolling_history) h;
    OWNED(rb_rolling_history) want;
    CHECK_OK(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message));
    assert_true(h.substeps[0] >= 4);
    rc.increments = h.substeps[0] / 2; /* to press, and as many to load */
    CHECK_OK(rb_rolling_history_run(&rc, &program, NULL, &other, &want, &message));
    assert_int_equal(want.substeps[0], h.substeps[0]);
    for (int i = 0; i < model.mesh.n; i++)
        CHECK_ABS(model.state.q[i], other.state.q[i], 1e-9 * h.max_pressure[0], "element %d", i);
}

/* Slip in either sense takes friction away, and time gives it back to what sticks. */
TEST(friction_at_rest_falls_in_both_senses)
{
    static const double shift[] = {0.0, 4e-3, -4e-3, 4e-3},
                        load[] = {900.0, 900.0, 900.0, 0.0, 900.0, 900.0},
                        lifted[] = {0.0, 4e-3, 0.0, 0.0, 0.0, 4e-3};
    const rb_rolling_case rc = pushed(60, 0.5, 36.788);
    for (int lifts = 0; lifts < 2; lifts++) {
        const rb_rolling_program program = {
            .n = lifts ? 6 : 4, .load = lifts ? load : NULL, .shift = lifts ? lifted : shift};
        rb_rolling_case of = rc;
        if (lifts)
            set(&of, "half-width nan load 900");
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        CHECK_OK(rb_rolling_history_run(&of, &program, NULL, &model, &h, &message));
        const double first = fabs(h.tangential_load[1]), again = fabs(h.tangential_load[h.n - 1]);
        assert_true(again < (1.0 - 1e-3) * first);
        assert_int_equal(h.rows.jumped, 0);
    }
}

typedef struct {
    double *bound;
    int *zone;
    int rows;
} bounds_seen;

static int see_bounds(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                      int steps, void *context)
{
    bounds_seen *record = context;
    const size_t n = (size_t)model->mesh.n;

    (void)h;
    (void)steps;
    if (!record->bound) {
        record->bound = NOT_NULL(rb_alloc(n, 4));
        record->zone = NOT_NULL(calloc(4 * n, sizeof *record->zone));
    }
    memcpy(record->bound + n * (size_t)step, model->problem.bound, n * sizeof(double));
    memcpy(record->zone + n * (size_t)step, model->state.zone, n * sizeof(int));
    record->rows = step + 1;
    return 0;
}

TEST(what_sticks_heals)
{
    static const double shift[] = {0.0, 4e-3, 3.9e-3, 3.9e-3}, time[] = {0.0, 1e-3, 2e-3, 0.3};
    const rb_rolling_program program = {.n = 4, .shift = shift, .time = time};
    rb_rolling_case rc = with(pushed(40, 0.5, 36.788),
                              "half-width nan load 900 relaxation-time 1e-4 relaxation-ratio 1e-4 "
                              "increments 1");
    rc.friction.memory_slip = 2e-3; /* d/s0 = 0.25 s */
    bounds_seen record = {NULL, NULL, 0};
    const rb_rolling_observer observer = {see_bounds, &record};
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    CHECK_OK(rb_rolling_history_run(&rc, &program, &observer, &model, &h, &message));
    const int n = model.mesh.n;
    int healed = 0;
    assert_int_equal(record.rows, 4);
    for (int i = 0; i < n; i++) {
        const double before = record.bound[2 * n + i];
        if (record.zone[2 * n + i] != RB_ZONE_STICK || record.zone[3 * n + i] != RB_ZONE_STICK)
            continue;
        CHECK_ABS(record.bound[3 * n + i], 0.3 + (before - 0.3) * exp(-0.298 / 0.25), 1e-9,
                  "element %d", i);
        healed += before < 0.299;
    }
    assert_true(healed > 5);
    free(record.bound);
    free(record.zone);
}

/* Also where the bodies are apart: a column mu moves the coefficients, and time restores them. */
TEST(what_is_apart_remembers_its_coefficients)
{
    static const double load[] = {900.0, 0.0, 0.0}, shift[] = {4e-3, 4e-3, 4e-3},
                        mu[] = {0.2, 0.1, 0.1}, time[] = {0.0, 1e-3, 0.3};
    for (int heals = 0; heals < 2; heals++) {
        const rb_rolling_program program = {.n = 3,
                                            .load = load,
                                            .shift = shift,
                                            .mu = heals ? NULL : mu,
                                            .time = heals ? time : NULL};
        rb_rolling_case rc = with(pushed(40, 0.5, 36.788), "half-width nan load 900");
        if (heals)
            set(&rc, "relaxation-time 1e-4 relaxation-ratio 1e-4");
        rc.friction.memory_slip = 2e-3; /* d/s0 = 0.25 s */
        bounds_seen record = {NULL, NULL, 0};
        const rb_rolling_observer observer = {see_bounds, &record};
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_history) h;
        CHECK_OK(rb_rolling_history_run(&rc, &program, &observer, &model, &h, &message));
        const double *first = record.bound, *second = first + model.mesh.n,
                     *third = second + model.mesh.n;
        int slid = 0;
        assert_int_equal(record.rows, 3);
        for (int i = 0; i < model.mesh.n; i++) {
            if (heals)
                CHECK_ABS(third[i], 0.3 + (second[i] - 0.3) * exp(-0.299 / 0.25), 1e-12,
                          "element %d", i);
            else
                CHECK_ABS(second[i], first[i] - 0.1, 1e-12, "element %d", i);
            slid += first[i] < 0.299;
        }
        assert_true(slid > 5);
        free(record.bound);
        free(record.zone);
    }
}

/* A column mu moves the coefficients of what sticks as well. */
TEST(a_kinetic_coefficient_may_change_at_rest)
{
    static const double shift[] = {0.0, 1e-4, 2e-4}, mu[] = {0.3, 0.3, 0.2};
    const rb_rolling_program program = {.n = 3, .shift = shift, .mu = mu};
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    const rb_rolling_case rc = pushed(40, 0.5, 36.788);
    CHECK_OK(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message));
    int sticks = 0;
    for (int i = 0; i < model.mesh.n; i++) {
        if (model.state.zone[i] == RB_ZONE_STICK) {
            CHECK_ABS(model.problem.bound[i], 0.3, 1e-12, "element %d", i);
            sticks++;
        }
    }
    assert_true(sticks > 10);
}

/* ---- Refusals ---------------------------------------------------------------------- */

static void refused(const rb_rolling_case *rc, const char *says)
{
    CHECK_SAYS(rb_rolling_case_check(rc, &message), RB_EINVAL, says);
}

TEST(bad_laws_are_refused)
{
    rb_rolling_case rc = with(rail(100.0), "mu-fall -0.2");
    refused(&rc, "expected mu >= 0 everywhere, got -0.02");
    rc = rail(-1.0);
    refused(&rc, "slip-scale: expected a number > 0");
    rc = rail(100.0);
    rc.speed = 0.0;
    refused(&rc, "needs the speed of rolling");
    rc = rail(100.0);
    rc.friction.memory = 1.0;
    refused(&rc, "memory: expected a number > 0, got 0");
    rc = warm(1.0);
    rc.friction.heat = -0.31;
    refused(&rc, "expected mu >= 0 everywhere, got -0.01");
    rc = warm(1.0);
    rc.friction.heat_range = 0.0;
    refused(&rc, "mu-heat: expected a number > 0 as the third");
    rc = warm(1.0);
    rc.heat_a.conductivity = 0.0;
    refused(&rc, "needs temperatures");
    /* on short elements the static coefficient counts for nothing */
    rc = pushed(40, 0.0, 36.788);
    rc.friction.memory_slip = 0.0;
    refused(&rc,
            "a static coefficient of 0.3 above the kinetic one of 0.2 needs a sliding distance "
            "in static contact, add --memory; without it the result on fine meshes is that of "
            "mu = 0.2");
    rc.friction.fall[0] = 0.0;
    CHECK_OK(rb_rolling_case_check(&rc, &message));
    rc.friction.fall[0] = -0.1; /* below it: friction that rises with slip keeps it */
    CHECK_OK(rb_rolling_case_check(&rc, &message));
}

RUN_TESTS(NULL, NULL)
