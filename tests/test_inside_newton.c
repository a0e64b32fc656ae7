/* Newton with a matrix: the problem on pairs of elements, the cold start from it, and the
 * answers beside Lemke's. */
#include "cases.h"
#include "lcp/contact/dense.h"
#include "rolling/study/internal.h"
#include "rolling/body/internal.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* A steel wheel on a plane of aluminium; half-planes or a wheel on its hub. */
static rb_rolling_case steady(rb_bem_support support, int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();

    rc.a = (rb_rolling_body){
        .young = 210000.0, .poisson = 0.28, .radius = 500.0, .support = support, .hub_ratio = 0.5};
    rc.b = rc.a;
    rc.b.young = 70000.0;
    set(&rc,
        "radius-b plane formulation steady half-width 10 mu 0.1 creep-ratio 0.4 "
        "contact-elements %d",
        elements);
    rc.elastic_b = support == RB_BEM_HALFPLANE;
    return rc;
}

/* ---- Elements in pairs ------------------------------------------------------------- */

static double pair_mean(int n, const double *x, int k)
{
    return 2 * k + 1 < n ? 0.5 * (x[2 * k] + x[2 * k + 1]) : x[2 * k];
}

static double pair_sum(int n, const double *x, int k)
{
    return 2 * k + 1 < n ? x[2 * k] + x[2 * k + 1] : x[2 * k];
}

/* What the fine problem answers to the tractions of the pairs: mean gaps, and slips that
 * are differences of mean displacements upstream, or mean ones. */
static void check_pairs(const rb_rolling_model *model, const rb_contact_problem *half,
                        const rb_contact_state *fine, const rb_contact_state *coarse)
{
    const rb_contact_problem *p = &model->problem;
    const int n = p->n, m = half->n, inner = p->differences ? m - 1 : m;
    SCRATCH double *gap = rb_alloc((size_t)n, 2), *half_gap = rb_alloc((size_t)m, 2);
    SCRATCH double *r = rb_alloc((size_t)n, 2), *w = rb_alloc((size_t)n + 1, 2);

    rb_contact_kinematics(p, fine, gap, gap + n);
    rb_contact_kinematics(half, coarse, half_gap, half_gap + m);
    memcpy(r, fine->p, (size_t)n * sizeof *r);
    memcpy(r + n, fine->q, (size_t)n * sizeof *r);
    rb_bem_flexibility_apply(&model->bodies.f, r, w);
    const double *w_T = w + n + 1;
    for (int i = 0; i <= n; i++)
        w[n + 1 + i] += fine->xi * (p->differences ? -model->bodies.f.x[i] : 1.0);
    for (int k = 0; k < m; k++)
        CHECK_ABS(half_gap[k], pair_mean(n, gap, k), 1e-11 * p->gap_length, "gap %d", k);
    for (int k = 0; k < inner; k++) {
        const double want = p->differences
                                ? 0.5 * (pair_mean(n + 1, w_T, k) - pair_mean(n, w_T, k + 1))
                                : pair_mean(n, w_T, k);
        const int alone = p->differences && n % 2 && k == inner - 1;
        if (!alone)
            CHECK_ABS(half_gap[m + k], want, 1e-11 * p->slip_length, "slip %d", k);
    }
}

static void check_half(const rb_rolling_model *model)
{
    const rb_contact_problem *p = &model->problem;
    OWNED(rb_contact_problem) half;
    OWNED(rb_contact_state) fine, coarse;

    CHECK_OK(rb_contact_halve(p, &half));
    assert_int_equal(half.n, (p->n + 1) / 2);
    CHECK_OK(rb_contact_state_alloc(p->n, &fine));
    CHECK_OK(rb_contact_state_alloc(half.n, &coarse));
    for (int k = 0; k < half.n; k++) {
        coarse.p[k] = p->stress * rand() / RAND_MAX;
        coarse.q[k] = 0.2 * p->stress * rand() / RAND_MAX;
        coarse.zone[k] = rand() % 4;
        CHECK_REL(half.load_N[k], pair_sum(p->n, p->load_N, k), 1e-14, "load %d", k);
        CHECK_REL(half.force_T[k], pair_sum(p->n, p->force_T, k), 1e-14, "force %d", k);
    }
    coarse.delta = 3.0;
    coarse.xi = 7e-4;
    rb_contact_start_from_half(&coarse, &fine);
    assert_int_equal(fine.zone[p->n - 1], coarse.zone[half.n - 1]);
    check_pairs(model, &half, &fine, &coarse);
}

TEST(pairs_answer_as_their_elements_do)
{
    srand(3);
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 40 + k / 2);
        if (k % 2) {
            set(&rc, "formulation static creep-ratio nan shift 0.01");
        }
        OWNED(rb_rolling_model) model = solved_model(&rc);
        check_half(&model);
    }
}

/* ---- Cold starts ------------------------------------------------------------------- */

/* Newton alone from nothing, and Lemke. */
static void check_beside_lemke(rb_rolling_model *model)
{
    rb_contact_problem *p = &model->problem;
    rb_rolling_case rc = *model->rc;
    OWNED(rb_contact_state) newton, lemke;

    CHECK_OK(rb_contact_state_alloc(p->n, &newton));
    CHECK_OK(rb_contact_state_alloc(p->n, &lemke));
    CHECK_OK(rb_contact_newton(p, 0, &newton));
    rc.contact.solver = RB_SOLVER_LEMKE;
    CHECK_OK(rb_rolling_problem_solve(p, &rc, 0, &lemke, NULL));
    assert_int_equal(lemke.solver, RB_SOLVER_LEMKE);
    for (int i = 0; i < p->n; i++) {
        CHECK_ABS(newton.p[i], lemke.p[i], 1e-10 * p->stress, "p of %d", i);
        CHECK_ABS(newton.q[i], lemke.q[i], 1e-10 * p->stress, "q of %d", i);
    }
    CHECK_REL(newton.delta, lemke.delta, 1e-10, "delta");
    CHECK_ABS(newton.xi, lemke.xi, 1e-10 * p->slip_length / p->e_T[0], "xi");
}

/* mu = 0.1, where an undamped Newton without the coarse start has cycled; all controls. */
TEST(cold_starts_end_where_lemke_does)
{
    static const int elements[] = {101, 102, 150, 151, 400, 500, 600};

    for (int k = 0; k < 7; k++) {
        rb_rolling_case rc = steady(k == 1 ? RB_BEM_HUB : RB_BEM_HALFPLANE, elements[k]);
        if (k % 2) {
            set(&rc, "creep-ratio nan force-ratio -0.6");
        }
        if (k == 3)
            rc.mesh = RB_MESH_FITTED;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_OK(rb_rolling_model_add_matrix(&model, NULL)); /* Lemke's */
        check_beside_lemke(&model);
    }
}

/* On a rigid plane under mu beta = 0.86 the steps go round in circles, and without the
 * path that leads out of them Newton alone solves none of these. */
TEST(circles_are_left_on_a_path)
{
    static const struct {
        int elements;
        double force_ratio;
    } cases[] = {{30, NAN}, {63, NAN}, {70, NAN}, {150, -0.5}};

    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        rb_rolling_case rc = steady(RB_BEM_HALFPLANE, cases[k].elements);
        set(&rc, "poisson 0.3 mu 3 zone %g force-ratio %g", 1.7 * rc.half_width,
            cases[k].force_ratio);
        rc.elastic_b = 0;
        if (!isnan(rc.force_ratio))
            rc.creep_ratio = NAN;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_OK(rb_rolling_model_add_matrix(&model, NULL)); /* Lemke's */
        check_beside_lemke(&model);
    }
}

/* Where nothing sticks under a given creepage no element is held, which only a given
 * force needs: Newton ends by itself, without the fall back to Lemke, and all of the
 * contact slides the way the creepage says. */
TEST(full_sliding_needs_no_other_solver)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
        const double sign = k % 2 ? -1.0 : 1.0;
        set(&rc, "creep-ratio %g solver newton", 4.0 * sign);
        if (k < 2)
            rc.b.young = rc.a.young;
        OWNED(rb_rolling_solution) s = solved(&rc);
        assert_int_equal(s.solver, RB_SOLVER_NEWTON);
        assert_int_equal(s.stick, 0);
        for (int i = 0; i < s.n; i++)
            CHECK_ABS(s.q[i], -sign * rc.mu * s.p[i], 1e-9 * s.max_pressure, "case %d, element %d",
                      k, i);
    }
}

/* The levels below share one number of steps, the finest one adds a few. */
TEST(steps_grow_by_levels)
{
    for (int similar = 0; similar < 2; similar++) {
        rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
        rb_contact_state cold;
        int few = 0;
        if (similar)
            rc.b.young = rc.a.young;
        for (int doubled = 0; doubled < 3; doubled++, rc.contact_elements *= 2) {
            OWNED(rb_rolling_model) model = solved_model(&rc);
            CHECK_OK(rb_contact_state_alloc(model.mesh.n, &cold));
            CHECK_OK(rb_contact_newton(&model.problem, 0, &cold));
            if (doubled == 0)
                few = cold.iterations;
            CHECK_MAX(cold.iterations, few + 6 * doubled, "level %d", doubled);
            rb_contact_state_free(&cold);
        }
    }
}

/* ---- The LU that is kept ----------------------------------------------------------- */

/* The reduced problem of the zones by a kept LU or by a new one; returns the changes that
 * it was solved over. */
static int direct(rb_contact_problem *p, rb_contact_unknowns unknowns, rb_contact_lu lu,
                  rb_contact_state *s, rb_contact_reduced *r)
{
    CHECK_OK(rb_contact_reduced_alloc(p, unknowns, s, r));
    rb_contact_reduced_clear(p, r, s);
    rb_contact_reduced_right_side(p, s, r);
    rb_contact_elimination *elimination;
    CHECK_OK(rb_contact_elimination_begin(p, s->zone, lu, r, &elimination));
    rb_contact_elimination_solve(elimination, r);
    rb_contact_elimination_end(elimination);
    return r->changes;
}

/* A few elements anywhere go into any zone; at least one sticks. */
static void disturb(int count, rb_contact_state *s)
{
    for (int k = 0; k < count; k++)
        s->zone[rand() % s->n] = rand() % 4;
    s->zone[s->n / 2] = RB_ZONE_STICK;
}

/* Returns the changes that the kept LU was used over. */
static int check_kept(rb_contact_problem *p, rb_contact_unknowns unknowns, rb_contact_state *s)
{
    rb_contact_reduced kept, fresh;

    direct(p, unknowns, RB_LU_NEW, s, &fresh);
    rb_contact_reduced_free(&fresh);
    disturb(3, s);
    rb_contact_problem changed = *p; /* the same matrices under other controls */
    changed.force_given = rand() % 2;
    changed.load_given = rand() % 2;
    changed.delta = 0.1;
    changed.force_ratio = 0.3;
    const int changes = direct(&changed, unknowns, RB_LU_KEPT, s, &kept);
    assert_int_equal(direct(&changed, unknowns, RB_LU_NEW, s, &fresh), 0);
    const double scale = rb_norm_inf((size_t)fresh.size, fresh.x);
    for (int i = 0; i < fresh.size; i++)
        CHECK_ABS(kept.x[i], fresh.x[i], 1e-9 * scale, "unknown %d of %d, %d changes", i,
                  fresh.size, changes);
    rb_contact_reduced_free(&kept);
    rb_contact_reduced_free(&fresh);
    return changes;
}

TEST(a_kept_lu_serves_other_zones)
{
    rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    OWNED(rb_contact_state) s;
    int changes = 0;

    srand(5);
    CHECK_OK(rb_contact_state_alloc(model.mesh.n, &s));
    for (int k = 0; k < 60; k++) {
        memcpy(s.zone, model.state.zone, (size_t)s.n * sizeof(int));
        disturb(3, &s);
        changes += check_kept(&model.problem, (rb_contact_unknowns)(1 + k % 3), &s);
    }
    assert_true(changes > 60);
}

/* From no contact to all in stick: nothing that is kept may be used. */
TEST(a_kept_lu_gives_way_to_a_new_one)
{
    rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    rb_contact_problem *p = &model.problem;
    rb_contact_reduced r;
    OWNED(rb_contact_state) s;

    CHECK_OK(rb_contact_state_alloc(p->n, &s));
    p->load_given = 0;
    p->delta = 0.1;
    assert_int_equal(direct(p, RB_BOTH, RB_LU_KEPT, &s, &r), 0);
    rb_contact_reduced_free(&r);
    for (int i = 0; i < p->n; i++)
        s.zone[i] = RB_ZONE_STICK;
    assert_int_equal(direct(p, RB_BOTH, RB_LU_KEPT, &s, &r), 0);
    rb_contact_reduced_free(&r);
    for (int i = 0; i < p->n; i++)
        s.zone[i] = i % 2 ? RB_ZONE_SLIP_NEGATIVE : RB_ZONE_STICK;
    assert_int_equal(direct(p, RB_BOTH, RB_LU_KEPT, &s, &r), 0);
    rb_contact_reduced_free(&r);
}

/* Zones solved with the friction of `bound`, by what is kept or anew. */
static void solve_with(rb_rolling_model *model, const double *bound, int anew, rb_contact_state *s)
{
    rb_contact_problem *p = &model->problem;

    rb_contact_set_friction(p, p->mu, bound);
    if (anew)
        p->op->kind->forget(p->op);
    CHECK_OK(rb_contact_solve_zones(p, RB_BOTH, s));
}

/* As laws change it from round to round: the LU of other coefficients of friction, up to
 * a hundredth away, leads to what one of these gives. */
TEST(a_kept_lu_serves_friction_that_changes)
{
    static const double change[] = {1e-9, 1e-4, 0.05, 0.09, 2.0};
    rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const int n = model.mesh.n;
    OWNED(rb_contact_state) kept, fresh;
    SCRATCH double *bound = rb_alloc((size_t)n, 1);

    CHECK_OK(rb_contact_state_alloc(n, &kept));
    CHECK_OK(rb_contact_state_alloc(n, &fresh));
    memcpy(kept.zone, model.state.zone, (size_t)n * sizeof(int));
    memcpy(fresh.zone, model.state.zone, (size_t)n * sizeof(int));
    for (int k = 0; k < 5; k++) {
        solve_with(&model, NULL, 1, &kept); /* which is kept */
        for (int i = 0; i < n; i++)
            bound[i] = rc.mu * (1.0 + change[k] * (i % 3) / 2.0);
        rb_contact_set_friction(&model.problem, rc.mu, bound);
        OWNED(rb_contact_reduced) r;
        assert_int_equal(direct(&model.problem, RB_BOTH, RB_LU_KEPT, &kept, &r), 0);
        assert_int_equal(r.slight > 0, k < 4);
        solve_with(&model, NULL, 1, &kept);
        solve_with(&model, bound, 0, &kept);
        solve_with(&model, bound, 1, &fresh);
        const double p0 = rb_norm_inf((size_t)n, fresh.p);
        for (int i = 0; i < n; i++) {
            CHECK_ABS(kept.p[i], fresh.p[i], 1e-12 * p0, "pressure %d, %g", i, change[k]);
            CHECK_ABS(kept.q[i], fresh.q[i], 1e-12 * p0, "friction %d, %g", i, change[k]);
        }
    }
}

/* ---- A block that has no inverse --------------------------------------------------- */

/* How the approach grows with the load where the zones stay. */
static double compliance(rb_contact_problem problem, rb_contact_state *s)
{
    CHECK_OK(rb_contact_solve_zones(&problem, RB_BOTH, s));
    const double delta = s->delta, load = problem.load;
    problem.load *= 2.0;
    CHECK_OK(rb_contact_solve_zones(&problem, RB_BOTH, s));
    return (s->delta - delta) / load;
}

/* The datum of half-planes adds the same displacement per load everywhere: 2 ln(ratio) /
 * (pi E*).  Where that makes the compliance vanish, a given approach has no solution and
 * the tractions' block no inverse; under a given load the tractions are what they were
 * with any other datum. */
TEST(a_given_load_does_not_feel_the_datum)
{
    rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 60);
    OWNED(rb_rolling_model) usual = solved_model(&rc), critical;
    rb_contact_problem *p;
    OWNED(rb_contact_state) s;

    CHECK_OK(rb_contact_state_alloc(usual.mesh.n, &s));
    memcpy(s.zone, usual.state.zone, (size_t)s.n * sizeof(int));
    const double soft = compliance(usual.problem, &s);
    rc.a.datum =
        rb_rolling_datum(&rc, &rc.a) * exp(-0.5 * M_PI * rb_rolling_derive(&rc).modulus * soft);
    rc.b.datum = rc.a.datum;
    critical = solved_model(&rc);
    p = &critical.problem;
    assert_int_equal(p->n, s.n);
    CHECK_ABS(critical.mesh.ends[p->n], usual.mesh.ends[p->n], 0.0, "zone");
    p->op->kind->forget(p->op); /* a new LU, of just these zones */
    CHECK_ABS(compliance(*p, &s), 0.0, 1e-9 * soft, "compliance");
    CHECK_OK(rb_contact_solve_zones(p, RB_BOTH, &s));
    for (int i = 0; i < p->n; i++) {
        CHECK_ABS(s.p[i], usual.state.p[i], 1e-9 * p->stress, "pressure %d", i);
        CHECK_ABS(s.q[i], usual.state.q[i], 1e-9 * p->stress, "friction %d", i);
    }
}

/* ---- Memory ------------------------------------------------------------------------ */

TEST(failing_allocations)
{
    rb_rolling_case rc = steady(RB_BEM_HALFPLANE, 120);
    OWNED(rb_rolling_model) model = solved_model(&rc);

    for (int k = 0, refused = 1; refused; k += 1 + k / 10) {
        OWNED(rb_contact_state) cold;
        CHECK_OK(rb_contact_state_alloc(model.mesh.n, &cold));
        refused = REFUSED_FROM(k, rb_contact_newton(&model.problem, 0, &cold));
    }
}

RUN_TESTS(NULL, NULL)
