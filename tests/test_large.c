/* Large contacts on half-planes: no matrix, the same answers. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <cblas.h>
#include <gsl/gsl_math.h>

/* Steel cylinder on a plane of steel, of a softer metal, or rigid. */
typedef enum { SIMILAR, DISSIMILAR, RIGID } pairing;

static rb_rolling_case steady(pairing pair, int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = RB_BEM_HALFPLANE};
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    rc.elastic_b = pair != RIGID;
    if (pair == DISSIMILAR) {
        rc.b.young = 60000.0;
        rc.b.poisson = 0.1;
    }
    set(&rc, "gap parabola formulation steady half-width 1 creep-ratio 0.4 contact-elements %d",
        elements);
    return rc;
}

/* ---- Friction laws ----------------------------------------------------------------- */

/* The law's coefficients are followed from coarse elements to fine ones, and so is the
 * creepage of a force; the matrix begins on the fine elements, at rest. */
TEST(a_law_that_is_followed_equals_one_begun_at_rest)
{
    for (int k = 0; k < 4; k++) {
        if (!is_in_turn(k, 4))
            continue;
        rb_rolling_case rc = steady(k % 2 ? SIMILAR : DISSIMILAR, 200);
        OWNED(rb_rolling_solution) followed = {0}, begun = {0};
        set(&rc, "friction-law exponential mu-fall 0.1 slip-scale 2 speed 1000");
        if (k > 1) {
            set(&rc, "creep-ratio nan force-ratio -0.5");
        }
        CHECK_OK(rb_rolling_solve(&rc, &followed, &message));
        rc.contact.solver = RB_SOLVER_LEMKE;
        CHECK_OK(rb_rolling_solve(&rc, &begun, &message));
        CHECK_REL(followed.creepage, begun.creepage, 1e-9, "creepage");
        CHECK_REL(followed.force_ratio, begun.force_ratio, 1e-9, "force");
        CHECK_ABS(followed.free_creepage, begun.free_creepage, 1e-12, "free rolling");
        for (int i = 0; i < followed.n; i++) {
            assert_int_equal(followed.zone[i], begun.zone[i]);
            CHECK_ABS(followed.q[i], begun.q[i], 1e-9 * begun.max_pressure, "q of %d", i);
        }
        rb_rolling_solution_free(&begun);
    }
}

/* ---- Against the dense path -------------------------------------------------------- */

/* The model's problem once more, with the matrix. */
static void compare_with_matrix(const rb_rolling_case *rc)
{
    OWNED(rb_rolling_model) model = solved_model(rc);
    rb_rolling_case dense = *rc;
    OWNED(rb_rolling_bodies) bodies;
    OWNED(rb_contact_problem) problem;
    OWNED(rb_contact_state) state;

    if (rb_rolling_is_large(rc, &model.mesh)) {
        assert_null(model.bodies.F);
        assert_null(rb_contact_operator_matrix(model.problem.op).F);
    } else
        assert_int_equal(model.bodies.transforms.n, rc->contact_elements);
    dense.contact.solver = RB_SOLVER_LEMKE; /* which needs the matrix */
    CHECK_OK(rb_rolling_bodies_create(&dense, NULL, &model.mesh, &bodies, &message));
    assert_non_null(bodies.F);
    CHECK_OK(rb_rolling_problem_create(&dense, &model.mesh, &bodies, NULL, &problem, &message));
    CHECK_REL(model.problem.gap_length, problem.gap_length, 1e-12, "scale of gaps");
    CHECK_REL(model.problem.slip_length, problem.slip_length, 1e-3, "scale of slips");
    assert_int_equal(rb_contact_operator_response(model.problem.op).coupled,
                     rb_contact_operator_response(problem.op).coupled);
    CHECK_OK(rb_contact_state_alloc(model.mesh.n, &state));
    dense.contact.solver = RB_SOLVER_NEWTON;
    memcpy(state.zone, model.state.zone, (size_t)state.n * sizeof(int));
    CHECK_OK(rb_rolling_problem_solve(&problem, &dense, 1, &state, &message));
    for (int i = 0; i < state.n; i++) {
        assert_int_equal(state.zone[i], model.state.zone[i]);
        CHECK_ABS(model.state.p[i], state.p[i], 1e-9 * problem.stress, "p of %d", i);
        CHECK_ABS(model.state.q[i], state.q[i], 1e-9 * problem.stress, "q of %d", i);
    }
    CHECK_REL(model.state.delta, state.delta, 1e-11, "delta");
    CHECK_REL(model.state.xi, state.xi, 1e-9, "xi");
}

TEST(equals_the_matrix_in_steady_rolling)
{
    rb_rolling_case rc = steady(DISSIMILAR, RB_ROLLING_LARGE);
    if (is_in_turn(0, 2))
        compare_with_matrix(&rc);
    rc = steady(SIMILAR, RB_ROLLING_LARGE);
    set(&rc, "creep-ratio nan force-ratio -0.5");
    if (is_in_turn(1, 2))
        compare_with_matrix(&rc);
}

TEST(equals_the_matrix_in_static_contact)
{
    rb_rolling_case rc = steady(RIGID, RB_ROLLING_LARGE);
    set(&rc, "formulation static half-width nan creep-ratio nan approach 0.01 shift 0.0007");
    compare_with_matrix(&rc);
}

TEST(equals_the_matrix_that_it_helps)
{
    rb_rolling_case rc = with(steady(DISSIMILAR, 300), "mesh uniform");
    compare_with_matrix(&rc);
    rc = steady(RIGID, 300);
    set(&rc,
        "mesh uniform slip-operator upstream interlayer-normal 1e-6 interlayer-tangential 2e-6");
    compare_with_matrix(&rc);
}

/* A layer that yields, by products and by the matrix: pairs, controls, hardening as a
 * share of that of the bodies, softening, both ways that it follows the material. */
TEST(equals_the_matrix_where_a_layer_yields)
{
    static const double hardening[] = {0.0, 1e4, 1e7, -1e4};
    int yielding = 0, slipping = 0;

    for (int k = 0; k < 24; k++) {
        const int is_static = k % 3 == 2, given_force = (k / 4) % 2;
        rb_rolling_case rc = with(steady((pairing)(k % 3), is_static ? 260 : 200), "mesh uniform");
        rc.slip_operator = k % 2 ? RB_SLIP_SECOND : RB_SLIP_UPSTREAM;
        set(&rc, "interlayer-normal %g interlayer-tangential %g force-ratio %g", k % 5 ? 0.0 : 1e-6,
            k % 5 == 1 ? 2e-6 : 0.0, given_force ? -0.35 : NAN);
        rc.creep_ratio = given_force || is_static ? NAN : k % 2 ? 0.7 : -0.7;
        if (is_static) {
            set(&rc,
                "formulation static slip-operator upstream shift %g half-width nan "
                "approach %g load %g",
                given_force ? NAN : 1e-3, given_force ? NAN : 2e-3, given_force ? 200.0 : NAN);
        }
        rc.hardening = hardening[k % 4];
        rc.yield_stress = 0.5 * rc.mu * rb_rolling_derive(&rc).stress;
        compare_with_matrix(&rc);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_MAX(s.residual, 1e-10, "case %d", k);
        yielding += s.yielding > 15;
        slipping += s.slipping > 5;
    }
    assert_true(yielding >= 12 && slipping >= 20);
}

/* Where it is asked for, a model that was solved without one has the matrix of the bodies
 * with a tangential third body, and its state satisfies the problem of that matrix. */
TEST(the_matrix_can_be_added)
{
    rb_rolling_case rc = steady(DISSIMILAR, RB_ROLLING_TRANSFORMS);
    set(&rc, "mesh aligned slip-operator second interlayer-normal 1e-6 interlayer-tangential 2e-6");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_contact_violation with, without;
    assert_null(model.bodies.F);
    CHECK_OK(rb_contact_residual(&model.problem, &model.state, &without));
    CHECK_OK(rb_rolling_model_add_matrix(&model, NULL));
    assert_non_null(model.bodies.F);
    assert_ptr_equal(rb_contact_operator_matrix(model.problem.op).F, model.bodies.F);
    CHECK_OK(rb_contact_residual(&model.problem, &model.state, &with));
    CHECK_MAX(without.scaled, 1e-10, "by products");
    CHECK_MAX(with.scaled, 1e-10, "by the matrix");
    OWNED(rb_contact_lcp) lcp;
    CHECK_OK(rb_rolling_model_lcp(&model, &lcp, NULL));
    CHECK_OK(rb_rolling_model_add_matrix(&model, NULL)); /* once */
}

/* What GMRES leaves is more than so small a tolerance: the matrix solves once more. */
TEST(a_small_tolerance_is_met_by_the_matrix)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(steady(DISSIMILAR, 400), "mesh uniform tol 5e-13");
        if (k) {
            set(&rc, "creep-ratio nan force-ratio 0.5");
        }
        OWNED(rb_rolling_model) model = solved_model(&rc);
        assert_int_equal(model.state.solver, RB_SOLVER_NEWTON);
        CHECK_MAX(model.state.residual, rc.contact.tol, "residual");
    }
}

/* Products with the matrices of an operator, or numbers that no solve can end with. */
typedef struct {
    rb_contact_matrix K;
    int n, lie, count;
    double *room;
} watched;

static void watched_apply(void *context, const double *r, const double **gap, const double **slip)
{
    watched *of = context;
    const int n = of->n;

    of->count++;
    *gap = of->room;
    *slip = of->room + n;
    cblas_dgemv(CblasColMajor, CblasNoTrans, n, 2 * n, 1.0, of->K.F, of->K.ldf, r, 1, 0.0, of->room,
                1);
    cblas_dgemv(CblasColMajor, CblasNoTrans, n, 2 * n, 1.0, of->K.S, n, r, 1, 0.0, of->room + n, 1);
    for (int i = 0; i < 2 * n && of->lie; i++)
        of->room[i] = NAN;
}

static void watched_precondition(void *context, int tangential, double *line)
{
    (void)context;
    (void)tangential;
    (void)line;
}

static void watched_free(void *context)
{
    free(((watched *)context)->room);
}

/* p, its own products replaced by others that are counted. */
static void watch(rb_contact_problem *p, watched *by)
{
    rb_contact_operator *op;

    *by = (watched){.K = rb_contact_operator_matrix(p->op), .n = p->n};
    by->room = rb_alloc((size_t)p->n, 2);
    const rb_contact_products products = {watched_apply, watched_precondition, watched_free, by,
                                          NULL};
    CHECK_OK(rb_contact_operator_products(p->n, &products, &op));
    rb_contact_operator_add_products(p->op, op);
}

/* Zones of many elements are solved by the products, and by the matrices where these do
 * not come to an end; few elements by the matrices at once. */
TEST(the_matrix_stands_in_for_products)
{
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = with(steady(DISSIMILAR, k == 2 ? 60 : 240), "mesh uniform");
        rc.contact.solver = RB_SOLVER_LEMKE; /* which keeps the matrix */
        OWNED(rb_rolling_model) model = solved_model(&rc);
        const int n = model.mesh.n;
        double *gap = rb_alloc((size_t)n, 3), *p = gap + n, *q = p + n;
        watched by;
        memcpy(p, model.state.p, (size_t)n * sizeof *p);
        memcpy(q, model.state.q, (size_t)n * sizeof *q);
        assert_int_equal(model.bodies.transforms.n, 0);
        watch(&model.problem, &by);
        by.lie = k == 1;
        by.count = 0;
        CHECK_OK(rb_contact_try_zones(&model.problem, &model.state, gap));
        assert_int_equal(by.count > 0, k < 2);
        for (int i = 0; i < n; i++) {
            CHECK_ABS(model.state.p[i], p[i], 1e-9 * model.problem.stress, "p of %d", i);
            CHECK_ABS(model.state.q[i], q[i], 1e-9 * model.problem.stress, "q of %d", i);
        }
        free(gap);
    }
}

/* ---- Residual from the solution alone ---------------------------------------------- */

/* Displacement of the pair at two points, strip by strip, without transforms. */
static void displacement(const rb_rolling_case *rc, const rb_rolling_solution *s, const double x[2],
                         double w_N[2], double w_T[2])
{
    const rb_rolling_body *body[2] = {&rc->a, &rc->b};

    w_N[0] = w_N[1] = w_T[0] = w_T[1] = 0.0;
    for (int b = 0; b < 1 + rc->elastic_b; b++)
        for (int j = 0; j < s->n; j++) {
            const double ends[2] = {s->x[j] - 0.5 * s->h[j], s->x[j] + 0.5 * s->h[j]};
            const double sign = b ? -1.0 : 1.0;
            double W[8];
            const rb_bem_surface plane = rb_bem_halfplane(
                rb_bem_material_from_young(body[b]->young, body[b]->poisson), 2.0 * 500.0 / M_E);
            rb_bem_surface_displacement(&plane, 1, ends, 2, x, W);
            for (int k = 0; k < 2; k++) {
                w_N[k] += W[k] * s->p[j] + sign * W[4 + k] * s->q[j];
                w_T[k] += sign * W[2 + k] * s->p[j] + W[6 + k] * s->q[j];
            }
        }
}

/* Every 331st element: gap and slip of the printed tractions obey Signorini and Coulomb. */
static void check_rows(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    for (int i = 7; i < s->n - 1; i += 331) {
        const double x[2] = {s->x[i], s->x[i + 1]}, limit = rc->mu * s->p[i];
        double w_N[2], w_T[2];
        displacement(rc, s, x, w_N, w_T);
        const double gap = x[0] * x[0] / 1000.0 + w_N[0] - s->approach;
        const double slip = s->creepage * (x[1] - x[0]) + w_T[0] - w_T[1];
        CHECK_ABS(gap, s->gap[i], 1e-12, "gap of %d", i);
        CHECK_ABS(slip, s->shift[i], 1e-12, "shift of %d", i);
        CHECK_ABS(fmin(gap / s->approach, s->p[i] / s->max_pressure), 0.0, 1e-9,
                  "complementarity of %d", i);
        assert_true(fabs(s->q[i]) <= limit * (1.0 + 1e-12));
        CHECK_ABS(fmin(fmax(slip, 0.0) / s->h[i], (limit + s->q[i]) / s->max_pressure), 0.0, 1e-9,
                  "slip forwards of %d", i);
        CHECK_ABS(fmin(fmax(-slip, 0.0) / s->h[i], (limit - s->q[i]) / s->max_pressure), 0.0, 1e-9,
                  "slip backwards of %d", i);
    }
}

TEST(residual_is_true)
{
    for (int pair = SIMILAR; pair <= RIGID; pair++) {
        const rb_rolling_case rc = steady((pairing)pair, 4000);
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_int_equal(s.large, 1);
        CHECK_MAX(s.residual, 1e-10, "pair %d", pair);
        CHECK_MAX(s.load_error, 1e-12, "pair %d", pair);
        check_rows(&rc, &s);
    }
}

/* Newton's steps from nothing go round in circles here: the friction coefficient is
 * reached by way of smaller ones. */
TEST(much_friction_is_reached_step_by_step)
{
    rb_rolling_case rc = with(steady(RIGID, RB_ROLLING_LARGE), "mu 2 creep-ratio 0.5");

    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_int_equal(s.large, 1);
    assert_true(s.stick > 100);
    CHECK_MAX(s.residual, 1e-10, "residual");
    check_rows(&rc, &s);
}

/* ---- Closed forms ------------------------------------------------------------------ */

/* A problem that is given up says so after a few steps, and the state stays one that another solve
 * may start from. */
TEST(a_search_ends_at_its_step_limit)
{
    rb_rolling_case rc = with(steady(RIGID, 400), "poisson 0.1 mu 1 mesh uniform");
    OWNED(rb_rolling_model) model = solved_model(&rc);

    set(&rc, "mu 30");
    rb_contact_set_friction(&model.problem, rc.mu, NULL);
    CHECK_SAYS(rb_rolling_problem_solve(&model.problem, &rc, 0, &model.state, &message), RB_MAXITER,
               "mu beta = 13.3");
    assert_true(model.problem.step_limit > 0);
    assert_true(model.state.iterations < 2 * model.problem.step_limit);
    set(&rc, "mu 1");
    rb_contact_set_friction(&model.problem, rc.mu, NULL);
    CHECK_OK(rb_rolling_problem_solve(&model.problem, &rc, 0, &model.state, &message));
    assert_int_equal(model.problem.step_limit, 0);
}

/* Carter: Q/(mu P) = s (2 - s); Hertz: p0 = E* a/(2R).  First order in 1/n. */
TEST(carter)
{
    for (int n = 5000; n <= 80000; n *= 4) {
        const rb_rolling_case rc = steady(SIMILAR, n);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(-s.force_ratio, 0.64, 1.5 / n, "n = %d", n);
        CHECK_REL(s.half_width, 1.0, 0.5 / n, "n = %d", n);
        CHECK_REL(s.max_pressure, 210000.0 / (1 - 0.28 * 0.28) / 2 / 1000.0, 0.5 / n, "n = %d", n);
        CHECK_REL(s.stick_from, -0.2, 15.0 / n, "n = %d", n);
        CHECK_ABS(s.free_creepage, 0.0, 0.0, "n = %d", n);
        assert_int_equal(s.slip_violations, 0);
        CHECK_MAX(s.residual, 1e-9, "n = %d", n);
    }
}

/* Cattaneo and Mindlin: c/a = sqrt(1 - Q/(mu P)). */
TEST(cattaneo)
{
    rb_rolling_case rc = steady(SIMILAR, 20000);
    set(&rc, "formulation static creep-ratio nan force-ratio 0.6");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_REL(s.force_ratio, 0.6, 1e-10, "Q/(mu P)");
    CHECK_REL(s.stick_to, sqrt(0.4), 5e-4, "stick");
    CHECK_REL(s.stick_from, -sqrt(0.4), 5e-4, "stick");
}

/* The same elements find free rolling too: beta = 0.3, mu = beta/2. */
TEST(driven_contacts_know_how_they_roll_freely)
{
    rb_rolling_case rc = with(steady(RIGID, RB_ROLLING_LARGE), "poisson %g mu 0.15", 2.0 / 7.0);
    OWNED(rb_rolling_solution) s = solved(&rc);
    assert_int_equal(s.large, 1);
    CHECK_REL(s.free_creepage * rc.a.radius / 0.3, -0.715826, 1e-3, "free creepage");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    double creepage;
    CHECK_MAX(model.state.iterations, 10, "steps from the solution on fewer elements");
    alloc_fail_after(0);
    CHECK_STATUS(rb_rolling_free_creepage(&model, &creepage, NULL), RB_ENOMEM);
    alloc_succeed();
}

/* Free rolling of dissimilar cylinders at very small friction (Bentall and Johnson). */
TEST(bentall_johnson)
{
    rb_rolling_case rc = with(steady(RIGID, 6000), "mu 1e-3 creep-ratio nan force 0");
    OWNED(rb_rolling_solution) s = solved(&rc);
    const double beta = (1 - 2 * 0.28) / (2 * (1 - 0.28));
    CHECK_REL(fabs(s.creepage), 2 * beta * s.half_width / 500.0 * 0.457386, 5e-3, "xi");
    CHECK_ABS(s.tangential_load / (rc.mu * s.normal_load), 0.0, 1e-9, "Q");
}

TEST(frictionless_and_sliding)
{
    rb_rolling_case rc = with(steady(RIGID, 2000), "mu 0 creep-ratio nan creep 1e-3");
    rb_rolling_solution s;
    CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
    CHECK_ABS(s.tangential_load, 0.0, 0.0, "Q");
    rb_rolling_solution_free(&s);
    rc = steady(SIMILAR, 2000);
    set(&rc, "creep-ratio nan force-ratio -1");
    CHECK_OK(rb_rolling_solve(&rc, &s, NULL));
    CHECK_REL(s.force_ratio, -1.0, 1e-10, "Q/(mu P)");
    assert_int_equal(s.stick, 0);
    rb_rolling_solution_free(&s);
}

/* ---- Work and memory --------------------------------------------------------------- */

/* Newton steps of all levels: they grow with the number of levels only. */
TEST(steps_hardly_grow)
{
    rb_rolling_case rc = steady(SIMILAR, 2000);
    rb_rolling_model model = solved_model(&rc);
    const int few = model.iterations;
    rb_rolling_model_free(&model);
    rc.contact_elements = 128000;
    model = solved_model(&rc);
    CHECK_MAX(model.iterations, few + 24, "steps at 2000: %d", few);
    rb_rolling_model_free(&model);
}

/* What needs a matrix says so: the LCP and the cones. */
TEST(without_a_matrix_some_refuse)
{
    const rb_rolling_case rc = steady(SIMILAR, 1500);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_contact_lcp lcp;
    rb_contact_cone cone;

    CHECK_SAYS(rb_rolling_model_lcp(&model, &lcp, &message), RB_EINVAL,
               "1500 contact elements are too many");
    CHECK_STATUS(rb_contact_cone_create(&model.problem, 0.0, 0.0, &cone, &message), RB_EINVAL);
}

TEST(failing_allocations)
{
    const rb_rolling_case given = steady(DISSIMILAR, RB_ROLLING_LARGE);
    for (int k = 0, refused = 1; k < 60 && refused; k++) { /* up to the coarser start */
        OWNED(rb_rolling_model) model;
        rb_rolling_mesh mesh;
        CHECK_OK(rb_rolling_model_begin(&given, NULL, &model, NULL));
        CHECK_OK(rb_rolling_mesh_uniform(&given, NULL, -1.3, 1.3, &mesh, NULL));
        refused = REFUSED_FROM(k, rb_rolling_model_build(&model, &mesh, NULL));
    }
    const rb_rolling_case rc = steady(DISSIMILAR, RB_ROLLING_LARGE);

    for (int k = 0, refused = 1, runs = 0; refused; k += 1 + k / 12, runs++) {
        OWNED(rb_rolling_model) model;
        alloc_fail_after(k);
        const rb_status s = rb_rolling_model_create(&rc, &model, &message);
        refused = alloc_failed();
        alloc_succeed();
        if (!refused)
            CHECK_OK(s);
        else if (s != RB_OK) /* a refused guess of the zone is no failure */
            CHECK_STATUS(s, RB_ENOMEM);
        assert_true(runs < 200);
    }
}

RUN_TESTS(NULL, NULL)
