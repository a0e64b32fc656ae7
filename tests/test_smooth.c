/* Smooth derivatives (theory-solvers.md D8): Carter's slopes to second order; the jump at a change
 * of zones against a solution on its other side; where zones change; refusals. */
#include "case_words.h"
#include "analysis/sensitivity/derivatives.h"

#include <gsl/gsl_math.h>
#include <string.h>

#define ROLLING "support halfplane formulation steady load 500 "
#define FIXED ROLLING "mesh uniform zone 1.2 contact-elements 50 "
#define ALIGNED ROLLING "gap parabola mesh aligned "

/* A solved case and its derivatives with respect to one input. */
typedef struct {
    rb_case *c;
    rb_case_result r;
    rb_case_derivatives all;
    const rb_case_derivative *by;
} differentiated;

static void differentiated_free(differentiated *d)
{
    rb_case_derivatives_free(&d->all);
    rb_case_result_free(&d->r);
    rb_case_free(d->c);
}

/* With respect to one input, or to n of them. */
static rb_status differentiate_by(const words *w, const char *name, double value, int n,
                                  const char *const *inputs, int smooth, differentiated *d,
                                  rb_message *why)
{
    d->c = case_of(RB_CASE_SINGLE, w, name, value);
    if (rb_case_solve(rb_case_resolved(d->c), NULL, NULL, &d->r, why) != RB_OK)
        fail_msg("%s", why->text);
    const rb_status s = (smooth ? rb_case_differentiate_smoothly : rb_case_differentiate)(
        d->c, &d->r.model, n, inputs, &d->all, why);
    d->by = d->all.of;
    if (s == RB_OK)
        assert_int_equal(d->all.n, n);
    if (s == RB_OK && d->by->status != RB_OK)
        *why = d->by->why;
    return s == RB_OK ? d->by->status : s;
}

static rb_status differentiate(const words *w, const char *name, double value, const char *input,
                               int smooth, differentiated *d, rb_message *why)
{
    return differentiate_by(w, name, value, 1, &input, smooth, d, why);
}

static double slope_of(const char *result, const words *w, const char *name, double value,
                       const char *input, int smooth)
{
    differentiated d;
    if (differentiate(w, name, value, input, smooth, &d, &message) != RB_OK)
        fail_msg("%s", message.text);
    const double slope =
        rb_rolling_number(rb_rolling_find_result(&rb_rolling_solution_scalars, result),
                          &d.by->d.value[!d.by->d.has[0]]);
    differentiated_free(&d);
    return slope;
}

static double slope_of_Q(const words *w, const char *name, double value, const char *input,
                         int smooth)
{
    return slope_of("tangential_load", w, name, value, input, smooth);
}

/* ---- Carter ------------------------------------------------------------------------ */

/* Q/(mu P) = s (2 - s) by s, Q/P by mu; the same of the dissipation D = |xi| Q, by its unit. */
enum { Q_BY_S, Q_BY_MU, D_BY_S, D_BY_MU, SLOPES };
static const char *const slope_name[SLOPES] = {"Q by s", "Q by mu", "D by s", "D by mu"};

/* Root mean squares of their errors over s. */
static void carter_errors(const char *elements, const char *mesh, int smooth, double error[SLOPES])
{
    enum { PLACES = 53 };
    const words w = {
        {ROLLING "similar yes gap parabola mu 0.3 mesh", mesh, "contact-elements", elements}};
    const double mu = 0.3, P = 500.0, E = 94500.0 / (2.0 * (1.0 - 0.1 * 0.1)),
                 unit = mu * sqrt(4.0 * P / (M_PI * E * 50.0)); /* mu a/R */
    double sum[SLOPES] = {0.0};
    int missed = 0;
    for (int k = 0; k < PLACES; k++) {
        const double s = 0.05 + 0.9 * k / (PLACES - 1) + 1e-3 * sin(k);
        static const char *const inputs[] = {"mu", "creep"};
        differentiated d;
        const rb_status found =
            differentiate_by(&w, "creep", -s * unit, 2, inputs, smooth, &d, &message);
        if (found != RB_OK && strstr(message.text, "too short") && ++missed * 8 < PLACES) {
            differentiated_free(&d);
            continue; /* of few elements none stick */
        }
        CHECK_OK(found);
        const rb_rolling_solution *by_mu = &d.by[0].d.value[0], *by_xi = &d.by[1].d.value[0];
        const double got[SLOPES] = {by_xi->tangential_load * -unit / (mu * P),
                                    by_mu->tangential_load / P,
                                    by_xi->dissipation * -1.0 / (mu * P),
                                    by_mu->dissipation / (unit * P)},
                     want[SLOPES] = {2.0 * (1.0 - s), s * s, 4.0 * s - 3.0 * s * s, s * s * s};
        assert_string_equal(d.by[1].name, "creep");
        differentiated_free(&d);
        for (int j = 0; j < SLOPES; j++)
            sum[j] += pow(got[j] - want[j], 2.0);
    }
    for (int j = 0; j < SLOPES; j++)
        error[j] = sqrt(sum[j] / (PLACES - missed));
}

TEST(carter_slopes_are_of_second_order)
{
    static const char *const meshes[] = {"aligned", "fitted"}, *const elements[] = {"50", "100",
                                                                                    "200"};
    for (int m = 0; m < 2; m++) {
        if (!is_in_turn(m, 2))
            continue;
        double e[3][SLOPES], exact[SLOPES];
        for (int k = 0; k < 3; k++)
            carter_errors(elements[k], meshes[m], 1, e[k]);
        carter_errors("200", meshes[m], 0, exact);
        for (int by = 0; by < SLOPES; by++) {
            const double first = log2(e[0][by] / e[1][by]), second = log2(e[1][by] / e[2][by]);
            const int of_D = by >= D_BY_S;
            if (!(first > 1.8 && second > 1.8 && e[2][by] < (of_D ? 1e-4 : 5e-5)))
                fail_msg("%s, %s: errors %.3g %.3g %.3g, orders %.2f %.2f", meshes[m],
                         slope_name[by], e[0][by], e[1][by], e[2][by], first, second);
            if (!(exact[by] > (of_D ? 15.0 : 50.0) * e[2][by]))
                fail_msg("%s, %s: exact derivatives %.3g, smooth ones %.3g", meshes[m],
                         slope_name[by], exact[by], e[2][by]);
        }
    }
}

/* The table of docs/theory-solvers.md, to its digits; columns of 25 to 400 aligned elements. */
TEST(carter_errors_are_those_of_the_page)
{
    static const char *const elements[] = {"25", "50", "100", "200", "400"};
    static const double shown[][5] = {{2.4e-2, 1.2e-2, 5.7e-3, 2.8e-3, 1.4e-3},
                                      {3.0e-3, 6.0e-4, 1.5e-4, 3.6e-5, 8.8e-6},
                                      {1.4e-2, 6.8e-3, 3.3e-3, 1.6e-3, 8.0e-4},
                                      {2.6e-3, 4.4e-4, 1.0e-4, 2.3e-5, 5.8e-6}};
    for (int k = 0; k < 5; k++) {
        if (!is_in_turn(k, 5))
            continue;
        for (int smooth = 0; smooth < 2; smooth++) {
            double e[SLOPES];
            carter_errors(elements[k], "aligned", smooth, e);
            for (int of_mu = 0; of_mu < 2; of_mu++) {
                const double want = shown[2 * of_mu + smooth][k];
                CHECK_TWO_DIGITS(e[of_mu ? Q_BY_MU : Q_BY_S], want, "%s, %s", elements[k],
                                 smooth ? "smooth" : "exact");
            }
        }
    }
}

/* Cattaneo's shift at a given force is mu (d(P) - d(P - Q/mu)), d(P) = 2 P (ln(2 datum/a) + 1/2)/
 * (pi E*); its derivative by mu is 2 (P ln(c/a) + (P - Pc)/2)/(pi E*), c the half-width that sticks
 * and Pc = P - Q/mu.  Exact derivatives are 3.6, 2.4 and 1.8 % off here. */
TEST(deviations_are_those_of_the_continuum)
{
    static const char *const elements[] = {"100", "200", "400"};
    static const double bound[] = {2.5e-3, 6e-4, 1.5e-4};
    const double E = 210000.0 / (2.0 * 0.91), P = 100.0, Q = 32.0, mu = 0.5,
                 want = 2.0 * (P * log(0.6) + 0.5 * Q / mu) / (M_PI * E);
    for (int k = 0; k < 3; k++) {
        const words w = {{"support halfplane similar yes gap parabola young 210000 poisson 0.3 "
                          "radius 100 load 100 formulation static force 32 contact-elements",
                          elements[k]}};
        rb_case *c = case_of(RB_CASE_SINGLE, &w, "mu", mu);
        rb_case_result r;
        rb_case_tolerances t;
        rb_rolling_solution deviation;
        CHECK_OK(rb_case_solve(rb_case_resolved(c), NULL, NULL, &r, &message));
        CHECK_OK(rb_case_read_tolerances(c, "mu=0.01", &t, &message));
        CHECK_OK(rb_case_deviations(c, &r.model, &t, &deviation, &message));
        CHECK_REL(deviation.tangential_shift, 0.01 * fabs(want), bound[k], "%s elements",
                  elements[k]);
        rb_case_result_free(&r);
        rb_case_free(c);
    }
}

/* Where there are no smooth derivatives deviations take those of the discrete case: on equal
 * elements under edges that move, and for friction with memory. */
TEST(deviations_without_smooth_derivatives)
{
    static const struct {
        const char *words, *input, *of;
    } rows[] = {{FIXED "creep-ratio 0.5 mu", "radius", "radius=1%"},
                {ALIGNED "friction-law exponential mu-fall 0.3 slip-scale 1 speed 1000 memory 1e-3 "
                         "creep-ratio 0.5 mu",
                 "mu", "mu=1%"}};
    for (int k = 0; k < 2; k++) {
        const words w = {{rows[k].words, "0.3"}};
        differentiated d;
        rb_case_tolerances t;
        rb_rolling_solution deviation;
        rb_message why;
        CHECK_STATUS(differentiate(&w, "tol", 1e-9, rows[k].input, 1, &d, &why), RB_EINVAL);
        differentiated_free(&d);
        CHECK_OK(differentiate(&w, "tol", 1e-9, rows[k].input, 0, &d, &message));
        CHECK_OK(rb_case_read_tolerances(d.c, rows[k].of, &t, &message));
        CHECK_OK(rb_case_deviations(d.c, &d.r.model, &t, &deviation, &message));
        CHECK_REL(deviation.tangential_load,
                  0.01 * d.by->value * fabs(d.by->d.value[!d.by->d.has[0]].tangential_load), 1e-9,
                  "%s", rows[k].input);
        differentiated_free(&d);
    }
}

/* ---- Changes of zones -------------------------------------------------------------- */

static int zones_that_differ(const rb_rolling_solution *a, const rb_rolling_solution *b)
{
    int n = 0;
    assert_int_equal(a->n, b->n);
    for (int i = 0; i < a->n; i++)
        n += a->zone[i] != b->zone[i];
    return n;
}

/* With one stick zone on elements that stay, tractions are piecewise linear in creepage
 * and mu: zones change exactly where the derivative says, and behind that the derivative
 * is the one of the exchange. */
TEST(jumps_are_those_of_solutions)
{
    static const struct {
        words w;
        const char *input;
        double value[3];
    } tests[] = {
        {{{FIXED "similar yes"}}, "creep", {-8e-4, -1.13e-3, -2.01e-3}},
        {{{FIXED "similar yes creep -1.1e-3"}}, "mu", {0.21, 0.3, 0.41}},
        {{{FIXED "similar yes interlayer-tangential 1e-6"}}, "creep", {-8e-4, -1.13e-3, -2.02e-3}},
        {{{FIXED "similar yes slip-operator second"}}, "creep", {-8e-4, -1.13e-3, -2.01e-3}},
        {{{FIXED "similar yes slip-operator second"}}, "force-ratio", {0.23, 0.5, 0.71}},
    };
    int sides[2] = {0, 0};
    for (size_t t = 0; t < sizeof tests / sizeof *tests; t++)
        for (int k = 0; k < 3; k++) {
            const words *w = &tests[t].w;
            const char *input = tests[t].input;
            const double value = tests[t].value[k];
            const int by_force = strcmp(input, "force-ratio") == 0;
            differentiated smooth, exact, before, behind;
            CHECK_OK(differentiate(w, input, value, input, 1, &smooth, &message));
            CHECK_OK(differentiate(w, input, value, input, 0, &exact, &message));
            const double *at = smooth.by->d.stays;
            assert_true(at[0] < 0.0 && at[1] > 0.0);
            const int next = at[1] < -at[0];
            const double part = 0.5 - fabs(at[next]) / (at[1] - at[0]);
            sides[next]++;
            CHECK_OK(
                differentiate(w, input, value + 0.999999 * at[next], input, 0, &before, &message));
            CHECK_OK(
                differentiate(w, input, value + 1.000001 * at[next], input, 0, &behind, &message));
            assert_int_equal(zones_that_differ(&before.r.solution, &smooth.r.solution), 0);
            assert_int_equal(zones_that_differ(&behind.r.solution, &smooth.r.solution), 1);
            const rb_rolling_solution *a = &smooth.by->d.value[0], *b = &exact.by->d.value[0],
                                      *c = &behind.by->d.value[0];
            if (by_force)
                CHECK_REL(b->creepage + (a->creepage - b->creepage) / part, c->creepage, 1e-9,
                          "creepage %zu %d", t, k);
            else
                CHECK_REL(b->tangential_load + (a->tangential_load - b->tangential_load) / part,
                          c->tangential_load, 1e-9, "Q %zu %d", t, k);
            for (int i = 0; i < a->n; i++)
                CHECK_ABS(b->q[i] + (a->q[i] - b->q[i]) / part, c->q[i],
                          1e-8 * exact.r.solution.max_pressure / fabs(value), "q[%d] %zu %d", i, t,
                          k);
            differentiated_free(&smooth);
            differentiated_free(&exact);
            differentiated_free(&before);
            differentiated_free(&behind);
        }
    assert_true(sides[0] > 1 && sides[1] > 1);
}

/* Both sides of the change meet, also where elements move, bodies differ and friction
 * falls; the exact derivatives jump. */
TEST(smooth_derivatives_are_continuous)
{
    static const struct {
        const char *result, *input;
        double value;
        const char *w;
    } tests[] = {
        {"tangential_load", "creep", -1.1e-3, ALIGNED "similar yes contact-elements 80"},
        {"dissipation", "creep", -1.1e-3, ALIGNED "similar yes contact-elements 80"},
        {"dissipation", "load", 500.0, ALIGNED "young-b 70000 contact-elements 80 creep -1.1e-3"},
        {"max_temperature", "creep", -1.1e-3,
         ALIGNED "similar yes contact-elements 80 conductivity 50 heat-capacity 3.5 speed 1000"},
        {"tangential_load", "mu", 0.3, ALIGNED "similar yes contact-elements 80 creep -1.1e-3"},
        {"tangential_load", "load", 500.0, ALIGNED "similar yes contact-elements 80 creep -1.1e-3"},
        {"tangential_load", "mu", 0.3, ALIGNED "young-b 70000 contact-elements 80 creep -1.1e-3"},
        {"tangential_load", "creep", -1.1e-3,
         ROLLING "gap parabola mesh fitted young-b 70000 contact-elements 60"},
        {"tangential_load", "creep", -1.5e-3,
         FIXED "similar yes friction-law exponential mu-fall 0.3 slip-scale 5 speed 1000"},
        {"tangential_load", "creep", -1.3e-3,
         ROLLING "gap parabola mesh aligned similar yes layer-thickness 1 base-young 300000 "
                 "base-poisson 0.3 contact-elements 60"},
        {"tangential_load", "shift", 1.5e-3,
         "support halfplane load 500 similar yes gap parabola mesh aligned formulation static "
         "contact-elements 60"},
    };
    for (size_t t = 0; t < sizeof tests / sizeof *tests; t++) {
        const words *w = &(const words){{tests[t].w}};
        const char *input = tests[t].input;
        double value = tests[t].value, step = 0.0, slope[2][2];
        differentiated d;
        for (double to = INFINITY; fabs(to) > 0.1 * step;) { /* to first order each time */
            CHECK_OK(differentiate(w, input, value, input, 1, &d, &message));
            const double *at = d.by->d.stays;
            to = at[at[1] < -at[0]];
            value += 0.999 * to;
            step = 0.004 * (at[1] - at[0]);
            differentiated_free(&d);
        }
        for (int smooth = 0; smooth < 2; smooth++)
            for (int side = 0; side < 2; side++)
                slope[smooth][side] =
                    slope_of(tests[t].result ? tests[t].result : "tangential_load", w, input,
                             value + (side ? step : -step), input, smooth);
        const double jump = fabs(slope[0][1] - slope[0][0]), left = fabs(slope[1][1] - slope[1][0]);
        CHECK_MAX(1e-3 * fabs(slope[0][0]), jump, "jump of case %zu", t);
        CHECK_MAX(left / jump, 0.05, "case %zu", t);
    }
}

/* Free rolling has zones of its own, which jump while the case slides fully: its slopes add up
 * to the difference, and their second differences nearly vanish. */
TEST(free_rolling_is_smooth_too)
{
    enum { PLACES = 7 };
    const words w = {
        {ROLLING "poisson 0.2 gap parabola mesh aligned creep -3e-2 contact-elements 240"}};
    const double step = 1e-3;
    double slope[2][PLACES], kink[2] = {0.0, 0.0}, sum = 0.0, xi[2] = {0.0, 0.0};
    for (int k = 0; k < PLACES; k++)
        for (int smooth = 0; smooth < 2; smooth++) {
            differentiated d;
            CHECK_OK(differentiate(&w, "mu", 0.06 + k * step, "mu", smooth, &d, &message));
            slope[smooth][k] = d.by->d.value[0].free_creepage;
            xi[k > 0] = d.r.solution.free_creepage;
            differentiated_free(&d);
        }
    for (int smooth = 0; smooth < 2; smooth++)
        for (int k = 1; k + 1 < PLACES; k++)
            kink[smooth] = fmax(kink[smooth], fabs(slope[smooth][k - 1] - 2.0 * slope[smooth][k] +
                                                   slope[smooth][k + 1]));
    for (int k = 0; k + 1 < PLACES; k++)
        sum += 0.5 * step * (slope[1][k] + slope[1][k + 1]);
    CHECK_REL(sum, xi[1] - xi[0], 2e-3, "slopes of free rolling");
    CHECK_MAX(kink[1], 0.03 * kink[0], "kinks of free rolling, exact %g", kink[0]);
}

/* On equal elements the one at the leading edge may slip. Its zone does not move with the
 * creepage, so that in the middle between two changes of the other one nothing is added. */
TEST(a_zone_at_an_edge_does_not_count)
{
    const words w = {{ROLLING "mesh uniform zone 1.2 contact-elements 60 similar yes"}};
    differentiated d;
    double value = -1.13e-3;
    CHECK_OK(differentiate(&w, "creep", value, "creep", 1, &d, &message));
    value += 0.5 * (d.by->d.stays[0] + d.by->d.stays[1]);
    const int *zone = d.r.solution.zone;
    int last = d.r.solution.n - 1;
    while (zone[last] == RB_ZONE_SEPARATED)
        last--;
    assert_int_equal(zone[last], RB_ZONE_SLIP_POSITIVE);
    assert_int_equal(zone[last - 1], RB_ZONE_STICK);
    differentiated_free(&d);
    CHECK_REL(slope_of_Q(&w, "creep", value, "creep", 1),
              slope_of_Q(&w, "creep", value, "creep", 0), 1e-9, "in the middle");
}

/* ---- Without matrices, and refusals ------------------------------------------------ */

/* A model that is solved by Fourier transforms, and a copy of it with matrices. */
TEST(transforms_have_the_same_smooth_derivatives)
{
    static const char *const inputs[] = {"mu", "load", "creep"};
    const words w = {{ALIGNED "similar yes creep -1.1e-3 contact-elements 400"}};
    differentiated fast;
    OWNED(rb_rolling_model) dense;
    OWNED(rb_case_derivatives) all;
    CHECK_OK(differentiate_by(&w, NULL, 0.0, 3, inputs, 1, &fast, &message));
    assert_null(fast.r.model.bodies.F);
    CHECK_OK(rb_rolling_variant_with_matrix(&fast.r.model, &dense, &message));
    CHECK_OK(rb_case_differentiate_smoothly(fast.c, &dense, 3, inputs, &all, &message));
    for (int k = 0; k < 3; k++) {
        CHECK_REL(fast.by[k].d.value[0].tangential_load, all.of[k].d.value[0].tangential_load, 1e-7,
                  "Q by %s", all.of[k].name);
        CHECK_REL(fast.by[k].d.value[0].max_pressure, all.of[k].d.value[0].max_pressure, 1e-6,
                  "p0 by %s", all.of[k].name);
        CHECK_REL(fast.by[k].d.value[0].dissipation, all.of[k].d.value[0].dissipation, 1e-6,
                  "dissipation by %s", all.of[k].name);
    }
    differentiated_free(&fast);
}

TEST(what_has_no_smooth_derivatives)
{
    static const struct {
        const char *input, *reason, *w;
    } tests[] = {
        {"creep", "an interface that yields",
         FIXED "similar yes creep -1e-3 yield-stress 30 hardening 100 interlayer-tangential 1e-6"},
        {"creep", "friction with memory",
         FIXED "similar yes creep -1e-3 friction-law rational mu 0.2 mu-fall 0.2 slip-scale 5 "
               "speed 1000 memory 0.1"},
        {"load", "moves the edges of the contact over the elements; give --mesh aligned",
         FIXED "similar yes creep -1e-3"},
        {"load", "fitting the mesh to them did not converge: take more elements, or --derivatives",
         ROLLING "similar yes creep -2e-3 mesh aligned contact-elements 13 zone 2"},
        /* the only element that slips is the last one */
        {"creep-ratio", "too short",
         ROLLING "similar yes mu 0.6 mesh aligned contact-elements 12 creep-ratio 0.1"},
        {"creep-ratio", "too short",
         "support hub load 500 mu 0.3 formulation steady mesh fitted contact-elements 20 "
         "creep-ratio 0.7 outer-elements 200"},
    };
    for (size_t t = 0; t < sizeof tests / sizeof *tests; t++) {
        differentiated d;
        CHECK_STATUS(
            differentiate(&(const words){{tests[t].w}}, NULL, 0.0, tests[t].input, 1, &d, &message),
            RB_EINVAL);
        if (!strstr(message.text, tests[t].reason))
            fail_msg("%s: %s", tests[t].reason, message.text);
        differentiated_free(&d);
    }
}

TEST(between_two_zones_there_are_none)
{
    const words w = {{FIXED "similar yes"}};
    differentiated d;
    CHECK_OK(differentiate(&w, "creep", -1e-3, "creep", 1, &d, &message));
    const double there = -1e-3 + d.by->d.stays[1];
    differentiated_free(&d);
    CHECK_STATUS(differentiate(&w, "creep", there, "creep", 1, &d, &message), RB_EINVAL);
    assert_non_null(strstr(message.text, "1 element stands exactly between two zones"));
    differentiated_free(&d);
}

/* What is rounding is 0, as of exact derivatives: free rolling does not know the creepage. */
TEST(rounding_is_no_derivative)
{
    const words w = {{ALIGNED "contact-elements 200"}};
    differentiated d;
    CHECK_OK(differentiate(&w, "creep", 5e-4, "creep", 1, &d, &message));
    assert_true(d.by->d.value[0].free_creepage == 0.0);
    differentiated_free(&d);
}

/* Where nothing changes its zone both derivatives are the same. */
TEST(without_zones_to_change_they_are_exact)
{
    const words w = {{ALIGNED "similar yes contact-elements 60"}};
    CHECK_REL(slope_of_Q(&w, "creep", -9e-3, "mu", 1), 500.0, 1e-9, "full sliding");
    CHECK_REL(slope_of_Q(&w, "creep", -1e-6, "creep", 1),
              slope_of_Q(&w, "creep", -1e-6, "creep", 0), 1e-14, "full stick");
}

RUN_TESTS(NULL, NULL)
