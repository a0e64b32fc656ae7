/* Derivatives of solutions: against central differences of solved cases on the same
 * elements with the same zones, forward against adjoint, Carter's slopes, both sides of a
 * border. */
#include "case_words.h"
#include "analysis/sensitivity/derivatives.h"
#include "analysis/sensitivity/sensitivity.h"

#include <string.h>

static rb_case *solved(const words *w, const char *name, double value, rb_case_result *r)
{
    rb_case *c = case_of(RB_CASE_SINGLE, w, name, value);
    if (rb_case_solve(rb_case_resolved(c), NULL, NULL, r, &message) != RB_OK)
        fail_msg("%s", message.text);
    return c;
}

static double value_of(const rb_rolling_solution *s, const char *name)
{
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++)
        if (strcmp(rb_rolling_solution_scalars.row[k].name, name) == 0)
            return rb_rolling_number(&rb_rolling_solution_scalars.row[k], s);
    fail_msg("no result %s", name);
    return NAN;
}

static const rb_case_derivative *of(const rb_case_derivatives *all, const char *name)
{
    for (int k = 0; k < all->n; k++)
        if (strcmp(all->of[k].name, name) == 0)
            return &all->of[k];
    fail_msg("no derivative with respect to %s", name);
    return NULL;
}

/* ---- Against differences of solutions ------------------------------------------------ */

#define PLANES "support halfplane load 500 mesh uniform zone 1.2 "
#define ROLLING "formulation steady "
#define FALLING                                                                                    \
    "support halfplane load 500 formulation steady similar yes creep -1e-3 friction-law "          \
    "exponential mu 0.2 mu-fall 0.2 slip-scale 5 speed 1000 tol 1e-13 "
#define NARROW "support halfplane mu 0.2 contact-elements 40 formulation static "

static const words regimes[] = {
    {{PLANES ROLLING "similar yes creep-ratio 0.5"}},
    {{PLANES ROLLING "young-b 70000 poisson-b 0.33 creep -1e-3"}},
    {{PLANES ROLLING
      "similar yes force-ratio -0.6 interlayer-tangential 1e-6 interlayer-normal 1e-7"}},
    {{PLANES ROLLING "similar yes force 90 slip-operator second"}},
    {{"support halfplane mesh uniform zone 1.2 " ROLLING
      "similar yes approach 0.015 creep-ratio 0.3"}},
    {{"support halfplane mesh uniform zone 1.2 " ROLLING "similar yes half-width 0.9 creep 5e-4"}},
    {{PLANES ROLLING "young-b 70000 creep -2e-3 friction-law exponential mu 0.2 mu-fall 0.2 "
                     "slip-scale 5 speed 1000 tol 1e-13"}},
    {{PLANES ROLLING "similar yes creep -1e-3 friction-law rational mu 0.2 mu-fall 0.2 slip-scale "
                     "5 speed 1000 memory 0.1 tol 1e-13"}},
    {{PLANES ROLLING
      "similar yes creep -1e-3 yield-stress 30 hardening 100 interlayer-tangential 1e-6"}},
    /* it yields where the surfaces slide, too */
    {{PLANES ROLLING "similar yes creep -3e-3 yield-stress 5 hardening 1e5 interlayer-tangential "
                     "1e-5 slip-operator second"}},
    {{PLANES ROLLING "young-b 70000 creep 1.5e-3 conductivity 50 heat-capacity 3.5 speed 1000"}},
    {{PLANES ROLLING "similar yes creep 1e-3 conductivity 50 heat-capacity 3.8 speed 1000 mu-heat "
                     "-0.2,0,0.3 tol 1e-13"}},
    {{PLANES ROLLING "similar yes creep -1e-3 relaxation-time 1e-3 relaxation-ratio 1 speed 1000"}},
    {{PLANES ROLLING "creep 1e-3 layer-thickness 2 base-young 200000 base-poisson 0.3"}},
    {{PLANES "formulation static shift 1e-3"}},
    {{PLANES "formulation static similar yes shift 2e-3 friction-law linear mu 0.2 mu-fall 0.1 "
             "memory 1e-3 tol 1e-13"}},
    /* automatic zones that follow a soft third body, or are tightened around narrow contacts */
    {{NARROW "load 20 young-b 1e4 interlayer-normal 1e-4 force-ratio 0.3"}},
    {{NARROW "load 20 layer-thickness 0.02 force-ratio 0.3"}},
    {{NARROW "approach 0.01 young-b 1e4 interlayer-normal 1e-4 shift 1e-4"}},
    {{"support hub load 500 mesh uniform zone 1.5 contact-elements 30 " ROLLING "creep-ratio 0.4"}},
    /* its unit is a half-width with a third body */
    {{"support halfplane mesh uniform zone 1.2 " ROLLING
      "similar yes approach 0.015 creep-ratio 0.3 interlayer-normal 2e-6"}},
};

/* Five values around that of the case; 1: all have its zones. */
static int differences(const words *w, const rb_case_derivative *d, double step,
                       const rb_rolling_solution *at, rb_case_result r[4])
{
    static const double place[] = {-2.0, -1.0, 1.0, 2.0};
    int same = 1;

    for (int k = 0; k < 4; k++) {
        rb_case_free(solved(w, d->name, d->value + place[k] * step, &r[k]));
        same &= r[k].solution.n == at->n &&
                memcmp(r[k].solution.zone, at->zone, (size_t)at->n * sizeof(int)) == 0;
    }
    return same;
}

static int compare_input(const words *w, const rb_case_derivative *d, const rb_rolling_solution *at)
{
    static const double weight[] = {1.0, -8.0, 8.0, -1.0};
    rb_case_result r[4];
    /* A law of friction is iterated to 1e-13, and p0 at a limit of stick (E4) has eight times the
     * errors of the elements that it is continued from: a small step shows them. */
    const double step = (strstr(w->word[0], "friction-law") ? 5e-4 : 1e-4) * fabs(d->value);

    /* of a list only its first number is set here, if it has no others */
    if (d->d.sides != 1 || d->value == 0.0 || strchr(d->name, '2') ||
        strncmp(d->name, "mu-heat", 7) == 0)
        return 0;
    const int same = differences(w, d, step, at, r);
    for (int k = 0; k < rb_rolling_solution_scalars.n && same; k++) {
        const rb_rolling_result *q = &rb_rolling_solution_scalars.row[k];
        const double x = rb_rolling_number(q, at), got = rb_rolling_number(q, &d->d.value[0]);
        double want = 0.0;
        if (!rb_sensitivity_has(q) || isnan(x) || strncmp(q->name, "contact_", 8) == 0 ||
            strcmp(q->name, "half_width") == 0 || /* edges end at midpoints: kinks */
            strcmp(q->name, "stick_length") == 0) /* by elements, its derivative by none */
            continue;
        for (int j = 0; j < 4; j++)
            want += weight[j] * rb_rolling_number(q, &r[j].solution) / (12.0 * step);
        const double moment = 0.1 * at->normal_load * at->half_width;
        const double least = strcmp(q->name, "resistance_moment") == 0  ? moment
                             : strcmp(q->name, "resistance_ratio") == 0 ? moment / 2.5e4
                                                                        : 0.0;
        const double scale = fmax(fabs(x), least);
        CHECK_ABS(got, want, 1e-8 * fabs(want) + 3e-9 * scale / fabs(d->value), "%s by %s", q->name,
                  d->name);
    }
    for (int i = 0; i < at->n && same; i++) {
        double p = 0.0, q = 0.0;
        for (int j = 0; j < 4; j++) {
            p += weight[j] * r[j].solution.p[i] / (12.0 * step);
            q += weight[j] * r[j].solution.q[i] / (12.0 * step);
        }
        const double small = 3e-9 * at->max_pressure / fabs(d->value);
        CHECK_ABS(d->d.value[0].p[i], p, 1e-8 * fabs(p) + small, "p by %s", d->name);
        CHECK_ABS(d->d.value[0].q[i], q, 1e-8 * fabs(q) + small, "q by %s", d->name);
    }
    for (int k = 0; k < 4; k++)
        rb_case_result_free(&r[k]);
    return same;
}

TEST(derivatives_are_those_of_solutions)
{
    for (size_t k = 0; k < sizeof regimes / sizeof *regimes; k++) {
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&regimes[k], NULL, 0.0, &r);
        int compared = 0;
        if (rb_case_differentiate(c, &r.model, 0, NULL, &all, &message) != RB_OK)
            fail_msg("regime %d: %s", (int)k, message.text);
        for (int j = 0; j < all.n; j++) {
            if (all.of[j].status != RB_OK)
                fail_msg("regime %d, %s: %s", (int)k, all.of[j].name, all.of[j].why.text);
            compared += compare_input(&regimes[k], &all.of[j], &r.solution);
        }
        if (compared < 4)
            fail_msg("regime %d: only %d inputs compared", (int)k, compared);
    }
}

/* Coefficients by the slips at both sides of an element, and what is kept of them (F1, F2); by
 * inputs that leave fitted elements in their places, which are found less exactly. */
TEST(laws_of_midpoints_are_differentiated)
{
    static const words w[] = {{{FALLING "mesh fitted"}},
                              {{FALLING "mesh fitted memory 1e-4"}},
                              {{FALLING "mesh uniform zone 1.2 memory 1e-4 slip-operator second"}}};
    static const char *const inputs[] = {"creep", "mu", "mu-fall", "slip-scale", "speed"};
    for (size_t k = 0; k < sizeof w / sizeof *w; k++) {
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&w[k], NULL, 0.0, &r);
        int compared = 0;
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        for (int j = 0; j < all.n; j++)
            for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
                if (strcmp(all.of[j].name, inputs[i]) == 0)
                    compared += compare_input(&w[k], &all.of[j], &r.solution);
        assert_int_equal(compared, sizeof inputs / sizeof *inputs);
    }
}

/* A layer that yields needs the matrix that its solution has not. */
TEST(a_model_without_a_matrix_is_given_one)
{
    static const words w[] = {
        {{PLANES ROLLING "similar yes creep -1e-3 yield-stress 30 contact-elements 160"}},
        {{PLANES ROLLING
          "similar yes creep -1e-3 yield-stress 30 contact-elements 160 tol 1e-13"}}};
    rb_case_result r[2];
    rb_case_derivatives all[2];
    for (int k = 0; k < 2; k++) {
        held_case *c = solved(&w[k], NULL, 0.0, &r[k]);
        assert_int_equal(r[k].model.bodies.F != NULL, k);
        if (rb_case_differentiate(c, &r[k].model, 0, NULL, &all[k], &message) != RB_OK)
            fail_msg("%s", message.text);
        assert_int_equal(r[k].model.bodies.F != NULL, k);
    }
    assert_int_equal(all[0].n, all[1].n);
    for (int j = 0; j < all[0].n; j++) {
        const rb_rolling_solution *a = all[0].of[j].d.value, *b = all[1].of[j].d.value;
        assert_string_equal(all[0].of[j].name, all[1].of[j].name);
        CHECK_OK(all[0].of[j].status);
        CHECK_ABS(a->tangential_load, b->tangential_load, 1e-6 * fabs(b->tangential_load) + 1e-12,
                  "Q by %s", all[0].of[j].name);
    }
    for (int k = 0; k < 2; k++) {
        rb_case_derivatives_free(&all[k]);
        rb_case_result_free(&r[k]);
    }
}

/* ---- Forward and adjoint ----------------------------------------------------------- */

/* Also by the rates that fits take, from fewer places. */
TEST(forward_is_adjoint)
{
    static const size_t some[] = {1, 2, 6, 8, 9, 12};
    for (size_t k = 0; k < sizeof some / sizeof *some; k++) {
        OWNED(rb_case_result) r;
        rb_sensitivity *s;
        OWNED(rb_contact_state) weight;
        OWNED(rb_sensitivity_rate) adjoint;
        rb_case_number number[RB_CASE_NUMBERS_MAX];
        held_case *c = solved(&regimes[some[k]], NULL, 0.0, &r);
        const rb_contact_problem *p = &r.model.problem;
        int n;
        CHECK_OK(rb_sensitivity_create(&r.model, 1, &s, &message));
        CHECK_OK(rb_case_numbers(c, number, &n, &message));
        CHECK_OK(rb_contact_state_alloc(p->n, &weight));
        CHECK_OK(rb_sensitivity_rate_alloc(p->n, &adjoint));
        memcpy(weight.p, p->force_N, (size_t)p->n * sizeof(double));
        memcpy(weight.q, p->force_T, (size_t)p->n * sizeof(double));
        weight.xi = 1e5; /* Q + 1e5 xi + 1e3 delta: all that there is */
        weight.delta = 1e3;
        CHECK_OK(rb_sensitivity_adjoint(s, &weight, &adjoint, &message));
        for (int j = 0; j < n; j++) {
            OWNED(rb_sensitivity_derivative) d;
            CHECK_OK(rb_sensitivity_differentiate(s, &number[j].input, &d, &message));
            const int side = d.has[0] ? 0 : 1;
            OWNED(rb_contact_state) y;
            OWNED(rb_sensitivity_rate) rate;
            double mu;
            CHECK_OK(rb_contact_state_alloc(p->n, &y));
            CHECK_OK(rb_sensitivity_rates(s, &number[j].input, &rate, &mu, &message));
            CHECK_OK(rb_sensitivity_tangent(s, &d.rate, side ? 1 : -1, &y, &message));
            double want = 1e5 * y.xi + 1e3 * y.delta, size = fabs(want);
            for (int i = 0; i < p->n; i++) {
                want += p->force_N[i] * y.p[i] + p->force_T[i] * y.q[i];
                size += fabs(p->force_T[i] * y.q[i]);
            }
            CHECK_ABS(rb_sensitivity_dot(&adjoint, &d.rate), want, 1e-11 * size, "regime %d by %s",
                      (int)some[k], number[j].name);
            CHECK_ABS(rb_sensitivity_dot(&adjoint, &rate), want, 1e-6 * size,
                      "regime %d: rate by %s", (int)some[k], number[j].name);
        }
        rb_sensitivity_free(s);
    }
}

/* ---- By gap and mu of every element ------------------------------------------------ */

/* All coefficients together are mu, and the gap of a radius is x^2/(2R). */
TEST(vectors_add_up)
{
    static const words some[] = {
        {{"support halfplane datum 100 datum-b 100 gap parabola load 500 mesh uniform zone "
          "1.2 " ROLLING "similar yes creep 1e-3"}},
        {{"support halfplane datum 100 datum-b 100 gap parabola load 500 mesh uniform zone "
          "1.2 " ROLLING "young-b 70000 force-ratio -0.5"}},
        {{"support halfplane datum 100 gap parabola approach 0.03 mesh uniform zone 1.2 " ROLLING
          "creep -5e-4"}},
        /* solved without a matrix */
        {{"support halfplane datum 100 datum-b 100 gap parabola load 500 mesh uniform zone "
          "1.2 " ROLLING "similar yes creep 1e-3 contact-elements 300"}}};
    for (size_t k = 0; k < sizeof some / sizeof *some; k++) {
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&some[k], NULL, 0.0, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        const int n = all.n_x;
        assert_int_equal(n, r.solution.n);
        for (int f = 0; f < RB_CASE_OVER_X_N; f++) {
            const char *name = rb_case_over_x_names[f];
            const double *gap = all.over_x + 2 * f * n, *mu = gap + n;
            double by_radius = 0.0, by_mu = 0.0, size = 0.0;
            for (int i = 0; i < n; i++) {
                const double x = r.solution.x[i];
                by_radius -= gap[i] * x * x / (2.0 * 50.0 * 50.0);
                size += fabs(gap[i]) * x * x / (2.0 * 50.0 * 50.0);
                by_mu += mu[i];
            }
            CHECK_ABS(by_radius, value_of(&of(&all, "radius")->d.value[0], name),
                      1e-7 * size + 1e-12 * fabs(value_of(&r.solution, name)), "%s by radius",
                      name);
            CHECK_ABS(by_mu, value_of(&of(&all, "mu")->d.value[0], name),
                      1e-8 * fabs(by_mu) + 1e-9 * fabs(value_of(&r.solution, name)), "%s by mu",
                      name);
        }
    }
}

/* ---- Layers of both bodies --------------------------------------------------------- */

/* Where two layers are compressed equally, a thinner one has the largest strain and a thicker
 * one leaves it to the other. What the pressure compresses of thin ones has one side. */
TEST(strain_of_two_layers_has_two_sides)
{
    static const words layers[] = {
        {{PLANES ROLLING
          "similar yes creep 1e-3 layer-thickness 2 base-young 200000 base-poisson 0.3"}},
        {{PLANES ROLLING "similar yes creep 1e-3 layer-thickness 0.01 base-young 200000 "
                         "base-poisson 0.3 contact-elements 300 gap parabola"}}};
    static const char *const name = "layer-thickness-b";
    for (size_t k = 0; k < sizeof layers / sizeof *layers; k++) {
        rb_case_result r, near[2];
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&layers[k], NULL, 0.0, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 1, &name, &all, &message));
        const rb_case_derivative *d = &all.of[0];
        assert_int_equal(d->status, RB_OK);
        const double h = 1e-6 * d->value, at = r.solution.max_strain, size = at / d->value;
        for (int side = 0; side < 2; side++) {
            rb_case_free(solved(&layers[k], name, d->value + (side ? h : -h), &near[side]));
            const double want = (near[side].solution.max_strain - at) / (side ? h : -h);
            CHECK_ABS(d->d.value[d->d.sides == 1 ? 0 : side].max_strain, want, 1e-4 * size,
                      "case %zu, side %d", k, side);
            rb_case_result_free(&near[side]);
        }
        assert_int_equal(d->d.sides, k == 0 ? 2 : 1);
        if (k == 0) /* of that result alone */
            CHECK_ABS(d->d.value[1].max_pressure, d->d.value[0].max_pressure, 0.0, "both sides");
        rb_case_result_free(&r);
    }
}

/* A force of 0 without friction is that of every creepage at which the surfaces slide. */
TEST(a_force_without_friction_tells_no_creepage)
{
    static const words w = {{PLANES ROLLING "young-b 70000 mu 0 force 0"}};
    static const char *const names[] = {"load", "mu"};
    OWNED(rb_case_derivatives) all;
    OWNED(rb_case_result) r;
    held_case *c = solved(&w, NULL, 0.0, &r);

    CHECK_OK(rb_case_differentiate(c, &r.model, 2, names, &all, &message));
    assert_int_equal(of(&all, "load")->status, RB_OK);
    assert_int_equal(of(&all, "mu")->status, RB_EINVAL);
    assert_non_null(strstr(of(&all, "mu")->why.text, "does not tell the creepage"));
}

/* ---- Carter ------------------------------------------------------------------------ */

/* Root mean square of d(Q/(mu P))/ds - 2 (1 - s) over s = 0.05 ... 0.95. */
static double carter_error(const char *elements, const char *mesh)
{
    double sum = 0.0;
    for (int k = 0; k < 19; k++) {
        static const char *const names[] = {"creep-ratio"};
        const double s = 0.05 * (k + 1);
        const words w = {{"support halfplane similar yes load 20 " ROLLING "mesh", mesh,
                          "contact-elements", elements}};
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&w, "creep-ratio", -s, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 1, names, &all, &message));
        const rb_case_derivative *d = of(&all, "creep-ratio");
        sum += pow(-value_of(&d->d.value[0], "force_ratio") - 2.0 * (1.0 - s), 2.0);
    }
    return sqrt(sum / 19.0);
}

TEST(carter_slopes)
{
    CHECK_MAX(carter_error("50", "aligned"), 2.45e-2, "50 elements");
    CHECK_MAX(carter_error("100", "aligned"), 1.03e-2, "100 elements");
    CHECK_MAX(carter_error("50", "fitted"), 2.45e-2, "50 fitted elements");
}

/* ---- Elements that move (D6) ------------------------------------------------------- */

/* Elements of an automatic zone grow with Hertz's half-width: derivatives are those of
 * solves that choose their own zones. */
TEST(equal_elements_move_with_their_zone)
{
    static const words moving[] = {
        {{"support halfplane load 500 mesh uniform " ROLLING "similar yes creep-ratio 0.5"}},
        {{"support halfplane load 500 mesh uniform " ROLLING "young-b 70000 force 60"}},
        {{"support hub load 500 mesh uniform contact-elements 30 " ROLLING
          "creep-ratio 0.4 outer-elements 60"}},
    };
    for (size_t k = 0; k < sizeof moving / sizeof *moving; k++) {
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&moving[k], NULL, 0.0, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        assert_int_equal(all.elements, RB_SENSITIVITY_ZONE);
        assert_true(compare_input(&moving[k], of(&all, "load"), &r.solution));
        assert_true(compare_input(&moving[k], of(&all, "young"), &r.solution));
    }
}

/* Contacts of half-planes are similar: with a creepage ratio Q is proportional to P, and
 * lengths to the root of P R, so on any elements that move with the contact. */
TEST(fitted_elements_move_with_the_edges)
{
    static const char *const meshes[] = {"uniform", "aligned", "fitted"};
    for (int k = 0; k < 6; k++) {
        const words w = {{"support halfplane gap parabola load 500 " ROLLING "mesh", meshes[k % 3],
                          "creep-ratio 0.5 young 94500", k < 3 ? "poisson-b" : "young-b",
                          k < 3 ? "0.1" : "70000", "young-b", k < 3 ? "94500" : "70000"}};
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&w, NULL, 0.0, &r);
        const rb_rolling_solution *s = &r.solution;
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        assert_int_equal(all.elements, k % 3 ? RB_SENSITIVITY_EDGES : RB_SENSITIVITY_ZONE);
        const rb_rolling_solution *by_P = &of(&all, "load")->d.value[0],
                                  *by_R = &of(&all, "radius")->d.value[0];
        CHECK_REL(by_P->tangential_load, s->tangential_load / 500.0, 1e-6, "Q by P");
        CHECK_REL(by_P->max_pressure, 0.5 * s->max_pressure / 500.0, 1e-6, "p0 by P");
        CHECK_REL(by_P->half_width, 0.5 * s->half_width / 500.0, 1e-5, "a by P");
        CHECK_ABS(by_R->tangential_load, 0.0, 3e-6 * fabs(s->tangential_load), "Q by R");
        if (k >= 3)
            CHECK_REL(by_P->free_creepage, 0.5 * s->free_creepage / 500.0, 5e-3,
                      "free rolling by P");
    }
}

/* The length that sticks: Carter's 2a - 2 |xi| R/mu, Cattaneo's 2a sqrt(1 - Q/(mu P)). */
TEST(stick_grows_between_changes_of_zones)
{
    static const char *const meshes[] = {"fitted", "aligned", "uniform"};
    for (int k = 0; k < 3; k++) {
        const words w = {{"support halfplane similar yes gap parabola young 210000 poisson 0.3 "
                          "radius 100 half-width 1 mu 0.3 contact-elements 100 creep 0.0015 "
                          "formulation steady mesh",
                          meshes[k]}};
        const double bound = k < 2 ? 0.012 : 0.03;
        OWNED(rb_case_result) r;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&w, NULL, 0.0, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        CHECK_REL(of(&all, "creep")->d.value[0].stick_length, -200.0 / 0.3, bound, "by xi");
        CHECK_REL(of(&all, "mu")->d.value[0].stick_length, 2.0 * 0.0015 * 100.0 / 0.09, bound,
                  "by mu");
        CHECK_REL(of(&all, "half-width")->d.value[0].stick_length, 2.0, bound, "by a");
    }
    const words w = {{"support halfplane similar yes gap parabola young 210000 poisson 0.3 radius "
                      "100 half-width 1 mu 0.3 contact-elements 200 force-ratio 0.5"}};
    OWNED(rb_case_result) r;
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
    CHECK_REL(of(&all, "force-ratio")->d.value[0].stick_length, -1.0 / sqrt(0.5), 0.02, "by Q");
    CHECK_REL(of(&all, "half-width")->d.value[0].stick_length, 2.0 * sqrt(0.5), 0.02, "by a");
    CHECK_ABS(of(&all, "mu")->d.value[0].stick_length, 0.0, 1e-6, "by mu");
}

/* Where two elements have nearly the largest pressure: stresses scale with P and E. */
TEST(peaks_stay_with_their_elements)
{
    const words w = {{"support halfplane gap parabola load 500 " ROLLING
                      "mesh fitted creep -0.0019 contact-elements 100"}};
    static const char *const names[] = {"load", "young"};
    OWNED(rb_case_result) r;
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 2, names, &all, &message));
    const rb_case_derivative *by_P = of(&all, "load"), *by_E = of(&all, "young");
    CHECK_REL(by_P->value * by_P->d.value[0].max_pressure +
                  by_E->value * by_E->d.value[0].max_pressure,
              r.solution.max_pressure, 1e-6, "p0");
}

/* On fitted elements by mu, against solves that are fitted anew. */
TEST(fitted_slopes_are_those_of_fitted_solves)
{
    const words w = {{"support halfplane load 500 " ROLLING
                      "mesh fitted contact-elements 120 young-b 70000 creep 1e-3"}};
    static const char *const names[] = {"mu", "creep", "load"};
    rb_case_result r, left, right;
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 3, names, &all, &message));
    for (int k = 0; k < 3; k++) {
        const rb_case_derivative *d = of(&all, names[k]);
        const double step = 0.03 * d->value;
        rb_case_free(solved(&w, names[k], d->value - step, &left));
        rb_case_free(solved(&w, names[k], d->value + step, &right));
        CHECK_ABS(d->d.value[0].tangential_load,
                  (right.solution.tangential_load - left.solution.tangential_load) / (2.0 * step),
                  4e-3 * fabs(r.solution.tangential_load / d->value), "Q by %s", names[k]);
        rb_case_result_free(&left);
        rb_case_result_free(&right);
    }
    rb_case_result_free(&r);
}

/* On aligned elements under strong coupling by the creepage, against solves that are aligned
 * anew, whose edges rest to 1e-4 elements. */
TEST(aligned_slopes_are_those_of_aligned_solves)
{
    const words w = {{"support halfplane load 2000 formulation steady mu 0.5 mesh aligned "
                      "contact-elements 24 creep 1e-3"}};
    static const char *const names[] = {"creep"};
    OWNED(rb_case_result) r, left, right;
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, names, &all, &message));
    rb_case_free(solved(&w, "creep", 0.9999e-3, &left));
    rb_case_free(solved(&w, "creep", 1.0001e-3, &right));
    CHECK_REL(of(&all, "creep")->d.value[0].tangential_load,
              (right.solution.tangential_load - left.solution.tangential_load) / 2e-7, 1e-3,
              "Q by creep");
}

/* ---- Borders and ends of ranges ---------------------------------------------------- */

/* The creepage at which an element begins to slip: on one side the slope of one element
 * more in stick. */
static void look_at_both_sides(const words *w, int has_matrix)
{
    double low = 4e-4, high = 5e-4;
    rb_case_result r, left, right;
    rb_case_derivatives all, one;
    rb_case *c = solved(w, "creep", low, &r);
    const int stick = r.solution.stick;
    rb_case_result_free(&r);
    rb_case_free(c);
    while (high - low > 2e-19) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high)
            break;
        c = solved(w, "creep", middle, &r);
        *(r.solution.stick == stick ? &low : &high) = middle;
        rb_case_result_free(&r);
        rb_case_free(c);
    }
    static const char *const names[] = {"creep"};
    c = solved(w, "creep", low, &r);
    assert_int_equal(r.model.bodies.F != NULL, has_matrix);
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, names, &all, &message));
    assert_int_equal(all.degenerate, 1);
    const rb_case_derivative *d = of(&all, "creep");
    assert_int_equal(d->d.sides, 2);
    held_case *a = solved(w, "creep", low * (1.0 - 1e-6), &left),
              *b = solved(w, "creep", low * (1.0 + 1e-6), &right);
    CHECK_OK(rb_case_differentiate(a, &left.model, 1, names, &one, &message));
    CHECK_REL(d->d.value[0].tangential_load, of(&one, "creep")->d.value[0].tangential_load, 1e-9,
              "left");
    rb_case_derivatives_free(&one);
    CHECK_OK(rb_case_differentiate(b, &right.model, 1, names, &one, &message));
    CHECK_REL(d->d.value[1].tangential_load, of(&one, "creep")->d.value[0].tangential_load, 1e-9,
              "right");
    assert_true(fabs(d->d.value[1].tangential_load - d->d.value[0].tangential_load) >
                1e-3 * fabs(d->d.value[0].tangential_load));
    rb_case_derivatives_free(&one);
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
    rb_case_result_free(&left);
    rb_case_result_free(&right);
    rb_case_free(c);
}

TEST(both_sides_of_a_border)
{
    look_at_both_sides(&(words){{PLANES ROLLING "similar yes"}}, 1);
    look_at_both_sides(&(words){{PLANES ROLLING "similar yes contact-elements 160"}}, 0);
}

/* Numbers at an end of their range have the other side alone. */
TEST(ends_of_ranges)
{
    const words w = {{PLANES ROLLING "similar yes creep -5e-4"}};
    OWNED(rb_case_result) r, some;
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
    const rb_case_derivative *d = of(&all, "interlayer-tangential");
    assert_int_equal(d->d.sides, 2);
    assert_false(d->d.has[0]);
    assert_true(d->d.has[1]);
    rb_case_free(solved(&w, "interlayer-tangential", 1e-11, &some));
    CHECK_REL(d->d.value[1].tangential_load,
              (some.solution.tangential_load - r.solution.tangential_load) / 1e-11, 1e-4,
              "interlayer");
}

/* Heat brings the coefficient to 0, but not below. */
TEST(what_heat_takes_away)
{
    const words w = {{PLANES ROLLING "similar yes creep 2e-3 speed 1000 conductivity 50 "
                                     "heat-capacity 3.8 mu 0.2 mu-heat -0.2,0,1 tol 1e-13"}};
    const double step = 1e-6;
    rb_case_result r, some[2];
    OWNED(rb_case_derivatives) all;
    held_case *c = solved(&w, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
    CHECK_OK(of(&all, "mu-heat")->status);
    const rb_case_derivative *d = of(&all, "mu");
    CHECK_OK(d->status);
    assert_false(d->d.has[0]);
    for (int j = 0; j < 2; j++)
        rb_case_free(solved(&w, "mu", 0.2 + (j + 1) * step, &some[j]));
    CHECK_REL(d->d.value[1].tangential_load,
              (-1.5 * r.solution.tangential_load + 2.0 * some[0].solution.tangential_load -
               0.5 * some[1].solution.tangential_load) /
                  step,
              1e-6, "Q by mu");
    for (int j = 0; j < 2; j++)
        rb_case_result_free(&some[j]);
    rb_case_result_free(&r);
}

/* Whoever computes them again, from a state in which the last digits are others, finds the same to
 * what is taken for rounding of other results. */
TEST(last_digits_of_a_state_warm_nothing)
{
    static const words cases[] = {
        {{PLANES ROLLING "similar yes force-ratio 0.5 speed 3000 conductivity 50 heat-capacity 3.5 "
                         "conductivity-b 20 heat-capacity-b 2"}},
        {{"support hub outer-elements 60 contact-elements 12 load 500 " ROLLING
          "young-b 70000 creep 2e-3 speed 3000 conductivity 50 heat-capacity 3.5"}},
    };
    rb_case_number *number = calloc(RB_CASE_NUMBERS_MAX, sizeof *number);

    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        rb_case_derivatives all[2];
        rb_case_result r;
        int numbers;
        held_case *c = solved(&cases[k], NULL, 0.0, &r);
        for (int moved = 0; moved < 2; moved++) {
            for (int i = 0; i < r.model.mesh.n && moved; i++) {
                r.model.state.p[i] *= 1.0 + (i % 3 - 1) * 2e-15;
                r.model.state.q[i] *= 1.0 + (i % 5 - 2) * 1e-15;
                r.model.state.lambda[i] *= 1.0 + (i % 7 - 3) * 1e-15;
            }
            CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all[moved], &message));
        }
        CHECK_OK(rb_case_numbers(c, number, &numbers, &message));
        assert_int_equal(numbers, all[0].n);
        for (int j = 0; j < numbers; j++) {
            const int side = !all[0].of[j].d.has[0];
            if (all[0].of[j].status == RB_OK)
                CHECK_ABS(all[1].of[j].d.value[side].max_temperature,
                          all[0].of[j].d.value[side].max_temperature,
                          1e-10 * fmax(1.0, r.solution.max_temperature) / number[j].input.scale,
                          "by %s", number[j].name);
        }
        rb_case_derivatives_free(&all[0]);
        rb_case_derivatives_free(&all[1]);
        rb_case_result_free(&r);
    }
    free(number);
}

/* Without friction an element that does not slide has no direction: a coefficient that begins to
 * grow lets it rest, or finds one. */
TEST(friction_begins_where_nothing_slides)
{
    static const words cases[] = {
        {{PLANES ROLLING "similar yes creep 0"}},
        {{PLANES "similar yes"}},
        {{PLANES "similar yes contact-elements 400"}}, /* transforms */
        {{PLANES "contact-elements 61"}},              /* one element in the middle */
        {{PLANES "contact-elements 61 " ROLLING "creep 0"}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        OWNED(rb_case_result) r, some;
        OWNED(rb_case_derivatives) all;
        held_case *c = solved(&cases[k], "mu", 0.0, &r);
        CHECK_OK(rb_case_differentiate(c, &r.model, 0, NULL, &all, &message));
        const rb_case_derivative *d = of(&all, "mu");
        assert_int_equal(d->status, RB_OK);
        assert_false(d->d.has[0]);
        rb_case_free(solved(&cases[k], "mu", 1e-6, &some));
        CHECK_ABS(d->d.value[1].tangential_load, some.solution.tangential_load / 1e-6, 5e-3,
                  "Q, case %zu", k);
        double sum = 0.0;
        for (int i = 0; i < all.n_x; i++)
            sum += fabs(all.over_x[(2 * RB_CASE_OVER_X_FORCE + 1) * all.n_x + i]) *
                   (r.model.problem.bound[i] == 0.0 && fabs(r.model.state.lambda[i]) < 1e-15);
        CHECK_ABS(sum, 0.0, 1e-12, "one element with friction, case %zu", k);
    }
}

/* ---- Units and refusals ------------------------------------------------------------ */

TEST(units_of_derivatives)
{
    static const char *const names[] = {"load"};
    rb_case_result r;
    rb_case_derivatives all;
    rb_case *c = solved(&regimes[0], NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, names, &all, &message));
    assert_int_equal(all.n, 1);
    const double p0 = all.of[0].d.value[0].max_pressure;
    rb_case_derivatives_convert(&all, RB_UNITS_SI);
    CHECK_REL(all.of[0].value, 5e5, 1e-14, "load in N/m");
    CHECK_REL(all.of[0].d.value[0].max_pressure, p0 * 1e6 / 1e3, 1e-13, "Pa per N/m");
    CHECK_REL(all.of[0].d.value[0].normal_load, 1.0, 1e-10, "P by P");
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
    rb_case_free(c);
    /* of a number that was given in the units of the case: all slides, Q = -mu P */
    static const words metres = {
        {"units si support halfplane load 5e5 " ROLLING "creep 1e-2 contact-elements 20"}};
    c = solved(&metres, NULL, 0.0, &r);
    CHECK_OK(rb_case_differentiate(c, &r.model, 1, names, &all, &message));
    CHECK_REL(all.of[0].value, 500.0, 1e-14, "load in N/mm");
    CHECK_REL(all.of[0].d.value[0].tangential_load, -0.3, 1e-10, "Q by P");
    rb_case_derivatives_free(&all);
    rb_case_result_free(&r);
    rb_case_free(c);
}

static rb_status factorise(void *model)
{
    rb_sensitivity *s;
    const rb_status status = rb_sensitivity_create(model, 1, &s, &message);
    rb_sensitivity_free(s);
    return status;
}

TEST(laws_without_memory)
{
    rb_case_result r;
    held_case *c = solved(&regimes[7], NULL, 0.0, &r);
    (void)c;
    assert_true(alloc_fail_each(factorise, &r.model) > 10);
    rb_case_result_free(&r);
}

TEST(steps_are_refused)
{
    const words w = {{PLANES "formulation static increments 3"}};
    OWNED(rb_case_result) r;
    rb_sensitivity *s;
    held_case *c = solved(&w, NULL, 0.0, &r);
    (void)c;
    CHECK_STATUS(rb_sensitivity_create(&r.model, 1, &s, &message), RB_EINVAL);
    assert_null(s);
    assert_non_null(strstr(message.text, "this case has several"));
}

RUN_TESTS(NULL, NULL)
