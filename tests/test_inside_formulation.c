/* What src/rolling keeps to itself of problems and laws: a step's past, controls,
 * friction laws by their formulas, the coefficients of an iteration. */
#include "cases.h"
#include "check.h"
#include "posed.h"
#include "rolling/case/derived.h"
#include "rolling/solve/formulation.h"
#include "rolling/solve/law.h"
#include "rolling/solve/law_iteration.h"
#include "rolling/solve/model.h"
#include "rolling/solve/solution.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* ---- Problems ---------------------------------------------------------------------- */

TEST(a_step_begins_with_its_past)
{
    double before[N], u[N];
    for (int i = 0; i < N; i++) {
        before[i] = 1e-4 * i * i;
        u[i] = 1e-3 * i;
    }
    rb_rolling_case rc = with(posed_plane(RB_TRANSIENT), "yield-stress 50 hardening 100");
    const rb_rolling_past past = {before, u, 0.07}, smooth = {before, NULL, 0.07};
    posed d = pose(&rc, &past);
    for (int i = 0; i < N; i++) {
        CHECK_ABS(d.p.d_T[i], d.bodies.f.w0[M + i] - before[i], 1e-18, "d_T %d", i);
        CHECK_ABS(d.p.e_T[i], 0.07, 0.0, "e_T %d", i);
        CHECK_REL(d.p.yield[i], 50.0 + 0.1 * i, 1e-14, "yield stress %d", i);
        CHECK_ABS(d.p.d_N[i], d.mesh.gap[i] + d.bodies.f.w0[i], 1e-18, "d_N %d", i);
    }
    rb_rolling_set_past(&rc, &d.bodies, &smooth, &d.p);
    for (int i = 0; i < N; i++)
        CHECK_ABS(d.p.yield[i], 50.0, 0.0, "nothing has yielded");
    rb_rolling_set_past(&rc, &d.bodies, NULL, &d.p);
    for (int i = 0; i < N; i++)
        CHECK_ABS(d.p.d_T[i], d.bodies.f.w0[M + i], 0.0, "from rest");
    CHECK_ABS(d.p.e_T[0], 0.0, 0.0, "from rest");
    release(&d);
}

TEST(each_control_gives_its_unknown)
{
    rb_rolling_case rc = posed_plane(RB_STEADY);
    posed d = pose(&rc, NULL);
    rb_contact_problem *p = &d.p;
    const rb_rolling_derived derived = rb_rolling_derive(&rc);
    const double scale = 0.3 * derived.half_width / derived.radius;

    assert_int_equal(p->load_given, 1);
    assert_int_equal(p->force_given, 0);
    CHECK_ABS(p->load, 500.0, 0.0, "P");
    CHECK_ABS(p->xi, 0.0, 0.0, "no creepage is 0");
    rc.creep_ratio = 0.5;
    rb_rolling_set_control(&rc, p);
    CHECK_REL(p->xi, 0.5 * scale, 1e-14, "xi R/(mu a)");
    set(&rc, "creep-ratio nan creep 0.01");
    rb_rolling_set_control(&rc, p);
    CHECK_ABS(p->xi, 0.01, 0.0, "xi");
    set(&rc, "creep nan force-ratio -0.4");
    rb_rolling_set_control(&rc, p);
    assert_int_equal(p->force_given, 1);
    CHECK_ABS(p->force_ratio, -0.4, 0.0, "Q/(mu P)");
    CHECK_ABS(p->xi, 0.0, 0.0, "an unknown");
    set(&rc, "force-ratio nan force 60");
    rb_rolling_set_control(&rc, p);
    CHECK_REL(p->force_ratio, 0.4, 1e-14, "of the known load");
    CHECK_ABS(p->force, 0.0, 0.0, "of the known load");
    rc.friction.heat = -0.1; /* mu is not known */
    rb_rolling_set_control(&rc, p);
    CHECK_ABS(p->force_ratio, 0.0, 0.0, "mu is not known");
    CHECK_ABS(p->force, 60.0, 0.0, "mu is not known");
    rc.friction.heat = 0.0;
    rc.friction.law = RB_FRICTION_linear;
    rb_rolling_set_control(&rc, p);
    CHECK_ABS(p->force, 60.0, 0.0, "mu is not known");
    set(&rc, "friction-law constant load nan approach 0.02");
    rb_rolling_set_control(&rc, p);
    assert_int_equal(p->load_given, 0);
    CHECK_ABS(p->delta, 0.02, 0.0, "the approach");
    CHECK_ABS(p->force, 60.0, 0.0, "the load is not known");
    set(&rc, "force nan free-axle");
    rb_rolling_set_control(&rc, p);
    assert_int_equal(p->force_given, 1);
    CHECK_REL(p->axle, 1.0 / 50.0, 1e-15, "1/R");
    rc.free_axle = 0;
    rc.formulation = RB_STATIC;
    rb_rolling_set_control(&rc, p);
    CHECK_ABS(p->axle, 0.0, 0.0, "none");
    CHECK_REL(p->xi, 0.002, 1e-14, "a tenth of the approach");
    rc.shift = 0.003;
    rb_rolling_set_control(&rc, p);
    CHECK_ABS(p->xi, 0.003, 0.0, "the shift");
    rc.force_ratio = 0.2; /* without friction no force is given */
    p->mu = 0.0;
    rb_rolling_set_control(&rc, p);
    assert_int_equal(p->force_given, 0);
    CHECK_ABS(p->xi, 0.003, 0.0, "the shift");
    set(&rc, "shift nan approach nan load 500");
    CHECK_ABS(rb_rolling_wanted_shift(&rc), 0.0, 0.0, "under a load");
    release(&d);
}

TEST(ratios_come_from_load_and_friction)
{
    rb_rolling_case rc = with(posed_plane(RB_STEADY), "creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double P = rb_rolling_model_load(&model), Q = rb_rolling_model_force(&model);
    CHECK_REL(P, 500.0, 1e-9, "P");
    CHECK_REL(rb_rolling_force_ratio(&model), Q / (0.3 * P), 1e-12, "Q/(mu P)");
    CHECK_REL(rb_rolling_ratio_of_creepage(&model, model.state.xi), 0.5, 1e-9, "there");
    CHECK_REL(rb_rolling_creepage_of_ratio(&model, 0.5), model.state.xi, 1e-9, "back");
    model.half_width = 0.0;
    assert_true(isnan(rb_rolling_ratio_of_creepage(&model, 0.1)));
    model.half_width = 1.0;
    model.problem.mu = 0.0;
    assert_true(isnan(rb_rolling_ratio_of_creepage(&model, 0.1)));
    memset(model.state.p, 0, sizeof(double) * (size_t)model.state.n);
    assert_true(isnan(rb_rolling_force_ratio(&model)));
}

/* Q of Coulomb's full sliding is -mu P beyond that creepage, whatever couples. */
TEST(everything_slides_at_the_sliding_creepage)
{
    static const double mu[] = {0.05, 0.3, 1.0};
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = with(posed_plane(RB_STEADY), "mu %g contact-elements 30", mu[k]);
        posed d = pose(&rc, NULL);
        rc.creep = rb_rolling_sliding_creepage(&rc, &d.p);
        release(&d);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_REL(rb_rolling_force_ratio(&model), -1.0, 1e-9, "mu = %g", mu[k]);
    }
}

/* ---- Laws -------------------------------------------------------------------------- */

static rb_rolling_case law(rb_rolling_friction_law which, double m1, double m2)
{
    rb_rolling_case rc = rolling_case("formulation steady");
    rc.friction = (rb_rolling_friction){.law = which, .fall = {m1, m2}, .slip_scale = {3.0, 7.0}};
    return rc;
}

/* A term without a fall has no scale: 0/0 would be no number. */
TEST(each_law_is_its_formula)
{
    static const double velocities[] = {0.0, 0.5, 3.0, 6.0, 7.0, 10.0, 14.0, 1e9};
    for (size_t k = 0; k < sizeof velocities / sizeof *velocities; k++) {
        const double v = velocities[k];
        rb_rolling_case rc = law(RB_FRICTION_exponential, 0.2, 0.1);
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + 0.2 * pow(0.5, v / 3.0) + 0.1 * pow(0.5, v / 7.0), 1e-14,
                  "exponential at %g", v);
        rc.friction.law = RB_FRICTION_rational;
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + 0.2 * 3.0 / (3.0 + v) + 0.1 * 49.0 / (49.0 + v * v), 1e-14,
                  "rational at %g", v);
        rc.friction.law = RB_FRICTION_linear;
        CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                  0.3 + (v < 6.0 ? 0.2 - 0.2 * v / 6.0 : 0.0) +
                      (v < 14.0 ? 0.1 - 0.1 * v / 14.0 : 0.0),
                  1e-14, "linear at %g", v);
        rc.friction.law = RB_FRICTION_constant;
        CHECK_ABS(rb_rolling_law_mu(&rc, 9.0, v, 0.0), 0.3, 0.0, "constant at %g", v);
        for (int one = 0; one < 2; one++) {
            rc = law(RB_FRICTION_exponential, one ? 0.2 : 0.0, one ? 0.0 : 0.1);
            rc.friction.slip_scale[one] = 0.0;
            CHECK_REL(rb_rolling_law_mu(&rc, 9.0, v, 0.0),
                      0.3 + (one ? 0.2 * pow(0.5, v / 3.0) : 0.1 * pow(0.5, v / 7.0)), 1e-14,
                      "one term at %g", v);
        }
    }
}

TEST(a_table_is_linear_between_its_rows)
{
    const double x[] = {-1.0, 0.0, 3.0}, y[] = {0.7, 0.7, 0.1};
    const rb_rolling_table t = {3, x, y}, one = {1, x + 1, y + 2};
    rb_rolling_case rc = law(RB_FRICTION_table, 0.0, 0.0);
    CHECK_ABS(rb_rolling_table_at(&t, -9.0), 0.7, 0.0, "before");
    CHECK_ABS(rb_rolling_table_at(&t, -1.0), 0.7, 0.0, "the first row");
    CHECK_ABS(rb_rolling_table_at(&t, 0.0), 0.7, 0.0, "a row");
    CHECK_REL(rb_rolling_table_at(&t, 1.0), 0.5, 1e-15, "between");
    CHECK_ABS(rb_rolling_table_at(&t, 3.0), 0.1, 0.0, "the last row, to the digit");
    CHECK_ABS(rb_rolling_table_at(&t, 9.0), 0.1, 0.0, "behind");
    const rb_rolling_table falls = {2, x + 1, y + 1};
    CHECK_REL(rb_rolling_table_at(&falls, 1e-9), 0.7 - 0.2e-9, 1e-15, "behind a row");
    CHECK_REL(rb_rolling_table_at(&falls, 1.5), 0.4, 1e-15, "in the middle of two");
    CHECK_ABS(rb_rolling_table_at(&one, 5.0), 0.1, 0.0, "a single row");
    CHECK_ABS(rb_rolling_table_at(&one, -5.0), 0.1, 0.0, "a single row");
    rc.friction.table = t;
    CHECK_REL(rb_rolling_law_mu(&rc, 1.0, 5.0, 0.0), 0.5, 1e-15, "of the place alone");
    CHECK_REL(rb_rolling_law_at_rest(&rc, 2.0), 0.3, 1e-14, "of the place alone");
    CHECK_ABS(rb_rolling_largest_mu(&rc), 0.7, 0.0, "largest");
    assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), 0);
    assert_int_equal(rb_rolling_law_depends_on_state(&rc), 0);
}

TEST(heat_adds_its_part)
{
    rb_rolling_case rc = law(RB_FRICTION_constant, 0.0, 0.0);
    rc.friction.heat = -0.2;
    rc.friction.heat_from = 100.0;
    rc.friction.heat_range = 50.0;
    CHECK_ABS(rb_rolling_law_mu(&rc, 0.0, 0.0, 20.0), 0.3, 0.0, "cold");
    CHECK_REL(rb_rolling_law_mu(&rc, 0.0, 0.0, 110.0), 0.26, 1e-14, "a fifth");
    CHECK_REL(rb_rolling_law_mu(&rc, 0.0, 0.0, 900.0), 0.1, 1e-14, "all of it");
    rc.heat_a.temperature = 125.0;
    CHECK_REL(rb_rolling_law_at_rest(&rc, 0.0), 0.2, 1e-14, "a warm body");
    assert_int_equal(rb_rolling_law_depends_on_state(&rc), 1);
    CHECK_ABS(rb_rolling_largest_mu(&rc), 0.3, 0.0, "heat takes off");
    rc.friction.heat = 0.2;
    CHECK_REL(rb_rolling_largest_mu(&rc), 0.5, 1e-15, "heat adds");
}

TEST(the_largest_coefficient_is_at_rest_or_fast)
{
    static const struct {
        double m1, m2, largest;
    } rows[] = {{0.2, 0.1, 0.6}, {0.2, -0.1, 0.5}, {-0.1, -0.2, 0.3}, {0.0, 0.0, 0.3}};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = law(RB_FRICTION_rational, rows[k].m1, rows[k].m2);
        CHECK_REL(rb_rolling_largest_mu(&rc), rows[k].largest, 1e-14, "row %d", k);
        assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), k < 3);
        assert_int_equal(rb_rolling_law_depends_on_state(&rc), k < 3);
        rc.formulation = RB_STATIC;
        assert_int_equal(rb_rolling_law_depends_on_state(&rc), 0);
        rc.friction.law = RB_FRICTION_constant; /* knows no falls */
        CHECK_ABS(rb_rolling_largest_mu(&rc), 0.3, 0.0, "row %d", k);
        assert_int_equal(rb_rolling_law_depends_on_slip(&rc.friction), 0);
    }
}

/* The steepest fall of each term by differences; two terms by no less than their sum. */
TEST(the_steepest_fall_is_that_of_the_formula)
{
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_exponential, RB_FRICTION_rational,
                                                   RB_FRICTION_linear};
    for (int k = 0; k < 3; k++) {
        double of[2];
        for (int term = 0; term < 2; term++) {
            const rb_rolling_case rc = law(laws[k], term ? 0.0 : 0.2, term ? 0.1 : 0.0);
            of[term] = 0.0;
            for (double v = 0.0; v < 20.0; v += 1e-3)
                of[term] = fmax(of[term], (rb_rolling_law_mu(&rc, 0.0, v, 0.0) -
                                           rb_rolling_law_mu(&rc, 0.0, v + 1e-4, 0.0)) /
                                              1e-4);
            CHECK_REL(rb_rolling_law_steepest(&rc, 0.1), of[term], 1e-3, "law %d, term %d", k,
                      term);
        }
        const rb_rolling_case both = law(laws[k], 0.2, 0.1), rising = law(laws[k], 0.2, -0.1);
        CHECK_REL(rb_rolling_law_steepest(&both, 0.1), of[0] + of[1], 1e-3, "both");
        CHECK_REL(rb_rolling_law_steepest(&rising, 0.1), of[0], 1e-3, "what rises is not steep");
    }
    const rb_rolling_case constant = law(RB_FRICTION_constant, 0.0, 0.0);
    CHECK_ABS(rb_rolling_law_steepest(&constant, 0.1), 0.0, 0.0, "constant");
}

/* With a memory: of the coefficient that a particle has behind an element, when it had that at rest
 * before.  A long memory reaches the bound, and no memory exceeds it by more than exp(-2). */
TEST(the_steepest_fall_with_memory_is_that_of_the_formula)
{
    static const rb_rolling_friction_law laws[] = {RB_FRICTION_exponential, RB_FRICTION_rational,
                                                   RB_FRICTION_linear};
    static const double memory[] = {1e-6, 1e-3, 1e-2, 0.1, 1.0, 1e3}, h = 1e-3, length = 0.1;
    for (int k = 0; k < 6; k++)
        for (int term = 0; term < 6; term++) {
            rb_rolling_case rc = law(laws[term / 2], term % 2 ? 0.0 : 0.2, term % 2 ? 0.1 : 0.0);
            double steepest = 0.0, before = 0.0;
            rc.speed = 100.0;
            rc.friction.memory = memory[k];
            rc.friction.memory_slip = 0.05;
            for (double v = 0.0; v < 60.0; v += h) {
                const double rest = rb_rolling_law_mu(&rc, 0.0, 0.0, 0.0),
                             mu = rb_rolling_law_mu(&rc, 0.0, v, 0.0),
                             slid = fmax(v, rc.friction.memory_slip) * length / rc.speed,
                             now = mu + (rest - mu) * exp(-slid / memory[k]);
                steepest = v > 0.0 ? fmax(steepest, (before - now) / h) : 0.0;
                before = now;
            }
            const double bound = rb_rolling_law_steepest(&rc, length);
            CHECK_MAX(steepest, (1.0 + exp(-2.0)) * bound * (1.0 + 1e-3), "%d, %d", k, term);
            if (k == 0 || k == 5)
                CHECK_REL(bound, steepest, 2e-2, "%d, %d", k, term);
        }
}

/* ---- Iterations over laws ---------------------------------------------------------- */

/* A made-up state: open elements are at rest; with a memory d each forgets the one
 * upstream of it over the way max(v, s0) e_T/V that it slides. */
TEST(coefficients_forget_from_the_leading_edge_on)
{
    for (int steady = 0; steady < 2; steady++) {
        rb_rolling_case rc = falling_case(steady ? RB_STEADY : RB_TRANSIENT, 0.2, 20.0);
        rc.creep_ratio = 0.5;
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_solution) solution;
        double mu[100], before[100];
        CHECK_OK(rb_rolling_solve_model(&rc, &model, &solution, &message));
        rb_contact_state *s = &model.state;
        const double *e_T = model.problem.e_T, rest = falling_mu(&rc, 0.0);
        for (int i = 0; i < s->n; i++) {
            s->zone[i] = i % 7 == 3 ? RB_ZONE_SEPARATED : RB_ZONE_SLIP_NEGATIVE;
            s->lambda[i] = e_T[i] * 0.01 * (i % 5);
            before[i] = 0.25 + 0.001 * i;
        }
        for (int k = 0; k < 3; k++) { /* no memory, with it, with a past */
            case_of_model(&model)->friction.memory = k ? 0.01 : 0.0;
            case_of_model(&model)->friction.memory_slip = 15.0;
            model.carried.mu = k == 2 ? before : NULL;
            CHECK_OK(rb_rolling_law_coefficients(&model, mu, &message));
            double upstream = rest;
            for (int i = s->n - 1; i >= 0; i--) {
                const double v = 10.0 * (i % 5), now = falling_mu(&rc, v);
                const double from = steady ? upstream : k == 2 ? before[i] : rest;
                const double kept = exp(-fmax(v, 15.0) * e_T[i] / rc.speed / 0.01);
                const double want = s->zone[i] == RB_ZONE_SEPARATED ? rest
                                    : k == 0                        ? now
                                                                    : now + (from - now) * kept;
                CHECK_REL(mu[i], want, 1e-13, "%d %d: element %d", steady, k, i);
                upstream = want;
            }
        }
        model.carried.mu = NULL;
    }
}

TEST(starts_slide_up_to_their_place)
{
    rb_rolling_case rc = with(falling_case(RB_STEADY, 0.2, 20.0), "creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const double *x = model.bodies.f.x;
    CHECK_OK(rb_rolling_law_start(&model, x[10], NULL));
    for (int i = 0; i < model.problem.n; i++)
        CHECK_ABS(model.problem.bound[i], i < 10 ? 0.2 : 0.4, 1e-12, "element %d", i);
    case_of_model(&model)->friction.heat = -0.1;
    case_of_model(&model)->friction.heat_range = 50.0;
    CHECK_OK(rb_rolling_law_start(&model, x[0], NULL));
    CHECK_ABS(model.problem.bound[0], 0.4, 1e-12, "at rest and cold");
    CHECK_OK(rb_rolling_law_start(&model, INFINITY, NULL));
    CHECK_ABS(model.problem.bound[5], 0.1, 1e-12, "fast and warm");
}

/* The given coefficients that an iteration starts from count where bodies roll. */
TEST(bounds_start_where_they_are_told)
{
    const double x[] = {-0.1, 0.1}, y[] = {0.21, 0.31};
    const rb_rolling_table start = {2, x, y};
    rb_rolling_case rc = with(falling_case(RB_STEADY, 0.2, 20.0), "creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    for (int k = 0; k < 2; k++) {
        case_of_model(&model)->formulation = k ? RB_STATIC : RB_TRANSIENT;
        rb_rolling_start_bounds(model.rc, &start, &model.bodies, &model.problem);
        for (int i = 0; i < model.problem.n; i++) {
            const double at = model.bodies.f.x[i];
            CHECK_ABS(model.problem.bound[i], k ? 0.4 : 0.26 + 0.5 * fmin(0.1, fmax(-0.1, at)),
                      1e-12, "at %g", at);
        }
        CHECK_ABS(model.problem.mu, 0.4, 1e-15, "the scale");
    }
}

static rb_rolling_model steep_model(void)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.2, 1.0);
    set(&rc, "contact-elements 10 creep-ratio 0.6");
    return solved_model(&rc);
}

/* With as many contact problems as it is given, and no more. */
TEST(newtons_method_ends_with_its_problems)
{
    static const int most[] = {0, 1, 3};
    for (int k = 0; k < 3; k++) {
        OWNED(rb_rolling_model) model = steep_model();
        int left = most[k];
        for (int i = 0; i < model.problem.n; i++)
            model.problem.bound[i] *= i % 2 ? 0.9 : 1.0;
        CHECK_STATUS(rb_rolling_law_newton(&model, 0.0, &left, &message), RB_MAXITER);
        assert_int_equal(left, -1);
    }
}

typedef struct {
    rb_rolling_model model;
    double bound[60]; /* of its solution */
} held_model;

/* From the same coefficients every time, whatever a run without memory has left. */
static rb_status go_to_rest(void *context)
{
    held_model *from = context;
    int left = 2000;
    for (int i = 0; i < from->model.problem.n; i++)
        from->model.problem.bound[i] = from->bound[i] * (i % 2 ? 0.9 : 1.0);
    return rb_rolling_law_newton(&from->model, 1e-12, &left, NULL);
}

static rb_status set_friction(void *context)
{
    return rb_rolling_model_friction(context, NULL);
}

TEST(newtons_method_may_have_no_memory)
{
    held_model from = {.model = steep_model()};
    rb_rolling_model *const model = &from.model;
    assert_true(model->problem.n <= 60);
    memcpy(from.bound, model->problem.bound, (size_t)model->problem.n * sizeof(double));
    assert_true(alloc_fail_each(go_to_rest, &from) > 5);
    case_of_model(model)->heat_a = (rb_rolling_heat){.conductivity = 40.0, .heat_capacity = 3.5};
    case_of_model(model)->friction.heat = -0.1;
    case_of_model(model)->friction.heat_range = 100.0;
    assert_true(alloc_fail_each(set_friction, model) > 2);
    rb_rolling_model_free(model);
}

RUN_TESTS(NULL, NULL)
