/* An interface that yields: CONTACT's cases, steady and rolled from a shift, a brush law
 * in closed form, the limits of a large and of a small yield stress, the law recomputed
 * from the printed columns alone, both solvers, histories, and what is refused. */

#include "cases.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static rb_rolling_solution valid(const rb_rolling_case *rc)
{
    rb_rolling_solution s = solved(rc);
    CHECK_MAX(s.residual, 1e-10, "residual");
    return s;
}

/* The bodies of CONTACT's examples_plast: two of steel, R = 500, P = 178.9.  A row of its
 * elements, 2B = 200 wide, is displaced along x by friction as a line is whose datum is
 * 2B exp(nu/(1-nu)): Cerruti's solution integrated over the width. */
static rb_rolling_case plastic_example(double hardening)
{
    return rolling_case("support halfplane young %g poisson 0.28 datum %g similar radius 500 "
                        "gap parabola mu 0.5 load 178.9 creep -0.0004 formulation steady "
                        "mesh uniform slip-operator upstream yield-stress 35 hardening %g",
                        2.0 * 82000.0 * 1.28, 200.0 * exp(0.28 / 0.72), hardening);
}

/* FX/(FSTAT FN) and the elements that stick, slip and yield, as CONTACT prints them for
 * testbank/examples_plast/carter_plast; its solver stops at 1e-5. */
static const struct {
    double hardening, h;
    int n;
    double ratio;
    int stick, slip, yield;
} carter_plast[] = {
    {4018000.0, 0.08, 30, 0.6562, 12, 11, 3},  {123000.0, 0.08, 30, 0.6420, 11, 8, 7},
    {0.0, 0.08, 30, 0.5959, 9, 4, 13},         {-20500.0, 0.08, 30, 0.5509, 8, 3, 15},
    {4018000.0, 0.04, 55, 0.6478, 25, 21, 5},  {123000.0, 0.04, 55, 0.6340, 22, 15, 14},
    {0.0, 0.04, 55, 0.5896, 19, 7, 25},        {-20500.0, 0.04, 55, 0.5457, 17, 4, 30},
    {4018000.0, 0.02, 105, 0.6436, 52, 41, 8}, {123000.0, 0.02, 105, 0.6299, 46, 29, 26},
    {0.0, 0.02, 105, 0.5864, 39, 12, 50},      {-20500.0, 0.02, 105, 0.5430, 34, 5, 62},
};

TEST(contact_program_is_met)
{
    static const rb_contact_solver by[] = {RB_SOLVER_NEWTON, RB_SOLVER_LEMKE};

    for (size_t k = 0; k < sizeof carter_plast / sizeof *carter_plast; k++)
        for (int j = 0; j < 2 && (j == 0 || carter_plast[k].n < 60); j++) {
            rb_rolling_case rc = plastic_example(carter_plast[k].hardening);
            rc.contact_elements = carter_plast[k].n;
            rc.zone = 0.5 * carter_plast[k].n * carter_plast[k].h;
            rc.contact.solver = by[j];
            OWNED(rb_rolling_solution) s = valid(&rc);
            CHECK_ABS(s.force_ratio, carter_plast[k].ratio, 1e-4, "case %zu", k + 1);
            assert_int_equal(s.solver, by[j]);
            assert_int_equal(s.stick, carter_plast[k].stick);
            assert_int_equal(s.slipping - s.yielding, carter_plast[k].slip);
            assert_int_equal(s.yielding, carter_plast[k].yield);
        }
}

static void count_zones(const rb_contact_state *state, int *stick, int *slip, int *yield)
{
    *stick = *slip = *yield = 0;
    for (int i = 0; i < state->n; i++) {
        *stick += state->zone[i] == RB_ZONE_STICK;
        *slip += state->zone[i] == RB_ZONE_SLIP_NEGATIVE || state->zone[i] == RB_ZONE_SLIP_POSITIVE;
        *yield += state->zone[i] >= RB_ZONE_YIELD_NEGATIVE;
    }
}

/* Of testbank/examples_plast/catt2d_plast: a shift with FX = 0.6 FSTAT FN, then steps of
 * one element with the creepage -0.0004; what has yielded rides with the material. */
TEST(rolling_from_a_shift_is_met)
{
    static const struct {
        double ratio;
        int stick, slip, yield;
    } want[] = {{0.6, 14, 8, 4},    {0.6051, 17, 4, 5}, {0.6100, 16, 4, 6},
                {0.6146, 14, 4, 8}, {0.6189, 13, 4, 9}, {0.6230, 12, 4, 10}};
    rb_rolling_case rc = plastic_example(123000.0);
    OWNED(rb_rolling_mesh) mesh;
    OWNED(rb_rolling_bodies) bodies;
    OWNED(rb_contact_state) x;
    enum { N = 30 };
    double r[2 * N], w[2 * (N + 1)], w_T[N], yielded[N + 1] = {0}, own[N];

    rc.contact_elements = N;
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.2, 1.2, &mesh, &message));
    CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, &message));
    CHECK_OK(rb_contact_state_alloc(N, &x));
    for (int step = 0; step < 6; step++) {
        const rb_rolling_past past = {w_T, yielded, 0.08};
        OWNED(rb_contact_problem) p;
        int stick, slip, yield;
        set(&rc, "formulation %s creep %g force-ratio %g", step ? "transient" : "static",
            step ? -0.0004 : NAN, step ? NAN : 0.6);
        CHECK_OK(rb_rolling_problem_create(&rc, &mesh, &bodies, step ? &past : NULL, &p, &message));
        CHECK_OK(rb_rolling_problem_solve(&p, &rc, step > 0, &x, &message));
        double Q = 0.0;
        for (int i = 0; i < N; i++)
            Q += 0.08 * x.q[i];
        count_zones(&x, &stick, &slip, &yield);
        CHECK_ABS(Q / (0.5 * 178.9), want[step].ratio, 1e-4, "step %d", step);
        assert_int_equal(stick, want[step].stick);
        assert_int_equal(slip, want[step].slip);
        assert_int_equal(yield, want[step].yield);
        memcpy(r, x.p, sizeof x.p[0] * N);
        memcpy(r + N, x.q, sizeof x.q[0] * N);
        rb_bem_flexibility_apply(&bodies.f, r, w);
        memcpy(w_T, w + N + 2, sizeof w_T);
        rb_contact_yielded(&p, x.plastic, NULL, own);
        for (int i = 0; i < N; i++)
            yielded[i] = i + 1 < N ? yielded[i + 1] + own[i + 1] : 0.0;
    }
}

/* Rigid bodies between which the layer alone gives way: from the leading edge q grows by
 * xi/L_T per length to the yield stress, by xi/(L_T + 1/k) to mu p, and is mu p then. */
static double brush_force(const rb_rolling_case *rc, double a)
{
    const double L = rc->interlayer_tangential, xi = fabs(rc->creep),
                 most = rc->mu / (2.0 * rc->a.radius * rc->interlayer_normal);
    const double elastic = xi / L, plastic = xi / (L + 1.0 / rc->hardening);
    const double s1 = rc->yield_stress / elastic;
    /* most (2 a s - s^2) = yield + plastic (s - s1) */
    const double b = 2.0 * a * most - plastic, c = rc->yield_stress - plastic * s1;
    const double s2 = (b + sqrt(b * b - 4.0 * most * c)) / (2.0 * most), end = 2.0 * a;
    const double slides =
        most * (a * (end * end - s2 * s2) - (gsl_pow_3(end) - gsl_pow_3(s2)) / 3.0);

    return 0.5 * elastic * s1 * s1 + c * (s2 - s1) + 0.5 * plastic * (s2 * s2 - s1 * s1) + slides;
}

TEST(brushes_converge_to_second_order)
{
    static const double hardening[] = {2e4, 4e5, 2e6};
    static const int n[] = {50, 100, 200};

    for (int k = 0; k < 3; k++) {
        double error[3];
        for (int j = 0; j < 3; j++) {
            rb_rolling_case rc = rolling_case("support halfplane young 1e13 poisson 0.5 "
                                              "gap parabola interlayer-normal 1e-6 "
                                              "interlayer-tangential 2e-6 yield-stress 900 "
                                              "hardening %g formulation steady mesh aligned "
                                              "slip-operator second contact-elements %d",
                                              hardening[k], n[j]);
            rc.load = 2.0 / (3.0 * rc.a.radius * rc.interlayer_normal);
            rc.creep =
                0.4 * rc.mu * rc.interlayer_tangential / (rc.a.radius * rc.interlayer_normal);
            OWNED(rb_rolling_solution) s = valid(&rc);
            assert_true(s.stick > 0 && s.yielding > 0 && s.slipping > s.yielding);
            const double want = brush_force(&rc, s.half_width);
            error[j] = fabs(-s.tangential_load - want) / (rc.mu * rc.load);
            CHECK_MAX(error[j], 1.3e-3 * gsl_pow_2(50.0 / n[j]), "k = %g, n = %d", hardening[k],
                      n[j]);
        }
    }
}

/* ---- The law, from the printed columns --------------------------------------------- */

/* Slip of element i by the displacements of A and B together, where these are known. */
static double slip_of(const rb_rolling_case *rc, const rb_rolling_solution *s, int i)
{
    if (rc->formulation == RB_STATIC)
        return s->tangential_shift + s->ut[i];
    if (rc->slip_operator == RB_SLIP_UPSTREAM)
        return s->creepage * (s->x[i + 1] - s->x[i]) + s->ut[i] - s->ut[i + 1];
    const double t = 0.0740956;
    return s->creepage * (s->x[i + 1] - s->x[i]) + (1.0 - t) / 4.0 * s->ut[i - 1] +
           (3.0 + 3.0 * t) / 4.0 * s->ut[i] - (5.0 + 3.0 * t) / 4.0 * s->ut[i + 1] +
           (1.0 + t) / 4.0 * s->ut[i + 2];
}

/* What of it the layer takes. */
static double plastic_of(const rb_rolling_case *rc, const rb_rolling_solution *s, int i)
{
    const double *u = s->plastic;
    return rc->formulation == RB_STATIC            ? u[i]
           : rc->slip_operator == RB_SLIP_UPSTREAM ? u[i] - u[i + 1]
                                                   : 1.5 * u[i] - 2.0 * u[i + 1] + 0.5 * u[i + 2];
}

/* Natural residuals of both bounds, in units of p0 and of the largest slip. */
static double law_violation(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    double stress = rc->mu * s->max_pressure, length = 0.0, worst = 0.0;

    for (int i = 0; i < s->n; i++)
        length = fmax(length, fabs(s->shift[i]));
    for (int i = 1; i < s->n - 2 && length > 0.0; i++) {
        const double q = fabs(s->q[i]), tau = rc->yield_stress + rc->hardening * s->plastic[i];
        /* a layer that has softened to nothing carries no friction */
        const double with = s->q[i] == 0.0 ? -s->shift[i] : s->q[i],
                     against = with > 0.0 ? -1.0 : 1.0;
        const double slip = against * slip_of(rc, s, i), plastic = plastic_of(rc, s, i);
        if (s->zone[i] == RB_ZONE_SEPARATED)
            continue;
        CHECK_ABS(slip, against * s->shift[i], 1e-6 * length, "slip of element %d", i);
        worst = fmax(worst, fabs(fmin((rc->mu * s->p[i] - q) / stress, (slip - plastic) / length)));
        worst = fmax(worst, fabs(fmin((fmax(tau, 0.0) - q) / stress, plastic / length)));
    }
    return worst;
}

static int draw(unsigned *seed, int n)
{
    *seed = *seed * 1103515245u + 12345u;
    return (int)(*seed >> 16) % n;
}

/* Bodies, controls, meshes, layers by a fixed seed; Lemke's and Newton's answers are the
 * same one. */
TEST(law_holds_by_the_columns)
{
    unsigned seed = 5;
    int yielding = 0, both_bounds = 0;
    for (int k = 0; k < 40; k++) {
        rb_rolling_case rc = rb_rolling_case_defaults();
        const double E[] = {2e5, 7e4, 5e3};
        set(&rc, "radius 100 support %s young 2e5 poisson 0.3",
            draw(&seed, 5) ? "halfplane" : "hub");
        rc.elastic_b = draw(&seed, 3) > 0;
        rc.b.young = E[draw(&seed, 3)];
        set(&rc, "poisson-b 0.3 mu %g load 200", draw(&seed, 2) ? 0.3 : 0.8);
        rc.formulation = draw(&seed, 4) ? RB_STEADY : RB_STATIC;
        if (rc.formulation == RB_STATIC)
            rc.shift = (draw(&seed, 2) ? 1.0 : -1.0) * 1e-4 * (1 + draw(&seed, 20));
        else
            rc.creep_ratio = (draw(&seed, 2) ? 0.1 : -0.1) * (1 + draw(&seed, 20));
        rc.mesh =
            rc.formulation == RB_STATIC ? RB_MESH_UNIFORM : (rb_rolling_mesh_kind)draw(&seed, 3);
        rc.slip_operator = rc.mesh == RB_MESH_ALIGNED ? RB_SLIP_SECOND : RB_SLIP_UPSTREAM;
        rc.contact_elements = 30;
        rc.yield_stress = rc.mu * rb_rolling_derive(&rc).stress * (0.05 + 0.1 * draw(&seed, 10));
        const rb_rolling_derived d = rb_rolling_derive(&rc);
        const double of[] = {0.0, 0.01, 0.3, 10.0, 1000.0, -0.01, -0.05};
        set(&rc, "hardening %g solver newton", of[draw(&seed, 7)] * d.modulus / d.half_width);
        OWNED(rb_rolling_solution) newton = valid(&rc), lemke;
        CHECK_MAX(law_violation(&rc, &newton), 1e-7, "case %d", k);
        yielding += newton.yielding > 0;
        for (int i = 1; i < newton.n - 2; i++)
            both_bounds += newton.zone[i] == RB_ZONE_SLIP_NEGATIVE &&
                           plastic_of(&rc, &newton, i) > 1e-3 * fabs(newton.shift[i]);
        set(&rc, "solver lemke lcp-form %s", draw(&seed, 2) ? "kwak" : "pivoted");
        if (rc.hardening >= 0.0) {
            lemke = valid(&rc);
            CHECK_ABS(lemke.tangential_load, newton.tangential_load, 1e-9 * rc.load, "case %d", k);
            assert_int_equal(lemke.yielding, newton.yielding);
            rb_rolling_solution_free(&lemke);
        }
    }
    assert_true(yielding > 20 && both_bounds > 10);
}

/* A yield stress that nothing reaches leaves every bit as it is without. */
TEST(large_yield_stress_is_elastic)
{
    const rb_rolling_formulation of[] = {RB_STATIC, RB_STEADY, RB_TRANSIENT};

    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = plastic_example(0.0);
        set(&rc, "yield-stress none interlayer-tangential 1e-6 mesh %s shift %g creep %g",
            k == 1 ? "fitted" : "uniform", k == 0 ? 1e-3 : NAN, k == 0 ? NAN : rc.creep);
        rc.formulation = of[k];
        rc.distance = k == 2 ? 1.0 : 0.0;
        OWNED(rb_rolling_solution) elastic = valid(&rc);
        set(&rc, "yield-stress 1e4 hardening 1e5");
        OWNED(rb_rolling_solution) layer = valid(&rc);
        assert_int_equal(layer.yielding, 0);
        for (int i = 0; i < elastic.n; i++) {
            CHECK_ABS(layer.q[i], elastic.q[i], k < 2 ? 0.0 : 1e-12 * elastic.max_pressure,
                      "formulation %d, q of element %d", k, i);
            assert_true(layer.plastic[i] == 0.0);
        }
    }
}

/* Without hardening the layer is the bound min(mu p, yield); below every mu p it is the
 * only one, and a tenth of it in full sliding is that times the width of the contact. */
TEST(small_yield_stress_is_a_bound)
{
    rb_rolling_case rc = plastic_example(0.0);
    set(&rc, "mesh fitted contact-elements 60 creep -0.01 yield-stress 0.5");
    OWNED(rb_rolling_solution) s = valid(&rc);
    for (int i = 0; i < s.n; i++)
        CHECK_ABS(s.q[i], fmin(rc.mu * s.p[i], rc.yield_stress), 1e-9, "element %d", i);
    CHECK_REL(s.tangential_load, 2.0 * s.half_width * rc.yield_stress, 1e-3, "Q");
}

static void count_call(const rb_contact_state *state, void *context)
{
    ++*(int *)context;
}

/* The iterations that are told are those that a trace sees, of the laws too. */
TEST(iterations_are_counted)
{
    rb_rolling_case rc = plastic_example(123000.0);
    set(&rc, "contact-elements 30 zone 1.2 solver newton");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    int calls = 0;
    model.problem.trace = count_call;
    model.problem.trace_context = &calls;
    CHECK_OK(rb_rolling_problem_solve(&model.problem, &rc, 0, &model.state, NULL));
    assert_int_equal(model.state.iterations, calls);
    assert_true(calls > 3);
}

/* ---- Histories --------------------------------------------------------------------- */

typedef struct {
    double *before; /* n: yielded after the step before */
    int n, steps, yields;
} yield_record;

/* Bound and growth of what has yielded, step by step. */
static int see_step(const rb_rolling_model *m, const rb_rolling_history *h, int step, int steps,
                    void *context)
{
    yield_record *c = context;
    const rb_contact_problem *p = &m->problem;
    (void)h;
    (void)step;
    (void)steps;
    if (!c->before) {
        c->n = p->n;
        c->before = calloc((size_t)p->n, sizeof *c->before);
    }
    OWNED(rb_rolling_solution) s;
    CHECK_OK(rb_rolling_model_solution(m, &s, &message));
    for (int i = 0; i < p->n; i++) {
        const double tau = m->rc->yield_stress + m->rc->hardening * s.plastic[i];
        const double own = s.plastic[i] - c->before[i];
        CHECK_MAX(fabs(s.q[i]) - fmin(tau, m->rc->mu * s.p[i]), 1e-9 * s.max_pressure,
                  "step %d, element %d", step, i);
        CHECK_MAX(-own, 1e-15, "step %d, element %d", step, i);
        if (own > 1e-9) {
            CHECK_ABS(fabs(s.q[i]), tau, 1e-9 * s.max_pressure, "step %d, element %d", step, i);
            assert_true(s.q[i] * s.shift[i] < 0.0);
            c->yields++;
        }
        c->before[i] = s.plastic[i];
    }
    c->steps++;
    return 0;
}

/* To and fro: what has yielded grows in both directions. */
TEST(shift_to_and_fro_hardens)
{
    static const double shift[] = {1e-3, 2e-3, 3e-3, 1e-3, -1e-3, -3e-3, 0.0, 3e-3};
    rb_rolling_case rc = plastic_example(5000.0);
    rb_rolling_program program = {.n = 8, .shift = shift};
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) history;
    yield_record c = {0};

    set(&rc, "formulation static creep nan contact-elements 40");
    CHECK_OK(rb_rolling_history_run(&rc, &program, &(rb_rolling_observer){see_step, &c}, &model,
                                    &history, &message));
    assert_int_equal(c.steps, 8);
    assert_true(c.yields > 40);
    free(c.before);
}

/* What has yielded leaves the contact with the material. */
TEST(a_transient_becomes_steady)
{
    rb_rolling_case rc = plastic_example(123000.0);
    set(&rc, "contact-elements 60 zone 1.25 creep nan force-ratio 0.6");
    OWNED(rb_rolling_solution) steady = valid(&rc);
    set(&rc, "formulation transient distance 5");
    OWNED(rb_rolling_solution) end = valid(&rc);
    CHECK_REL(end.creepage, steady.creepage, 5e-3, "xi");
    assert_true(abs(end.yielding - steady.yielding) <= 1);
    double most = 0.0, most_steady = 0.0;
    for (int i = 0; i < end.n; i++)
        most = fmax(most, end.plastic[i]);
    for (int i = 0; i < steady.n; i++)
        most_steady = fmax(most_steady, steady.plastic[i]);
    CHECK_REL(most, most_steady, 5e-2, "the most that has yielded");
}

/* ---- A given force, and what is refused -------------------------------------------- */

TEST(forces_find_their_creepage)
{
    static const double hardening[] = {0.0, 123000.0, 4018000.0, -20500.0};

    for (int k = 0; k < 4; k++)
        for (int j = 0; j < 2; j++) {
            rb_rolling_case rc = plastic_example(hardening[k]);
            set(&rc, "contact-elements 60 zone 1.25 creep nan force-ratio %g", j ? 0.5 : 0.2);
            OWNED(rb_rolling_solution) s = valid(&rc);
            CHECK_ABS(s.force_ratio, rc.force_ratio, 1e-10, "k = %g", hardening[k]);
            set(&rc, "creep %g force-ratio nan", s.creepage);
            OWNED(rb_rolling_solution) again = valid(&rc);
            CHECK_ABS(again.force_ratio, s.force_ratio, 1e-10, "k = %g", hardening[k]);
        }
}

static void refused(rb_rolling_case rc, const char *words)
{
    OWNED(rb_rolling_solution) s;
    CHECK_SAYS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL, words);
}

TEST(bad_layers_are_refused)
{
    rb_rolling_case rc = plastic_example(0.0);
    rc.yield_stress = -1.0;
    refused(rc, "yield-stress: expected a number > 0 or none, got -1");
    rc = plastic_example(NAN);
    refused(rc, "hardening: expected a number, got nan");
    rc = plastic_example(100.0);
    rc.yield_stress = 0.0;
    refused(rc, "--yield-stress");
    rc = plastic_example(-1e8);
    refused(rc, "softening by 1e+08 MPa/mm has no unique solution");
    rc = plastic_example(0.0);
    set(&rc, "contact-elements 30 zone 1.25 creep nan force 80");
    refused(rc, "force: Q = 80");
    set(&rc, "hardening -20500 force -55");
    refused(rc, "force: Q = -55");
}

RUN_TESTS(NULL, NULL)
