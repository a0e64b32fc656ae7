/* What src/rolling/study keeps to itself: error bars from runs that are made up or solved here,
 * and the start of a fine solution from a coarse one. */
#include "cases.h"
#include "solved.h"
#include "rolling/solve/coarse.h"
#include "rolling/study/internal.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/zone.h"

#include <float.h>
#include <gsl/gsl_math.h>

/* ---- Error bars -------------------------------------------------------------------- */

TEST(bars_are_three_or_five_times_the_spread)
{
    static const double runs[][3] = {
        {1.0, 1.2, 1.1},
        {3.0, 2.0, 1.0},
        {2.0, 2.5, 3.0},
        {1.0, 1.0, 1.0},
        {1.0, 1.0 - 2e-16, 2.0}}; /* the last turns by rounding alone */
    static const double wanted[] = {5.0 * 0.2, 3.0 * 2.0, 3.0 * 1.0, 0.0, 3.0 * 1.0};
    for (int k = 0; k < 5; k++) {
        CHECK_ABS(rb_rolling_contact_error(runs[k], runs[k][2]), wanted[k], 1e-14, "contact %d", k);
        CHECK_ABS(rb_rolling_boundary_error(3, runs[k], 4.0), 2.0 * (4.0 - runs[k][2]), 1e-14,
                  "boundary %d", k);
        CHECK_ABS(rb_rolling_boundary_error(2, runs[k], 4.0), 0.0, 0.0, "no boundary");
    }
    const double gone[] = {NAN, 1.0, 1.0};
    assert_true(isnan(rb_rolling_contact_error(gone, 1.0)));
    assert_true(isnan(rb_rolling_contact_error(runs[0], NAN)));
}

TEST(coarser_runs_have_half_and_seven_tenths)
{
    static const int elements[] = {20, 28, 40}, steps[] = {4, 5, 7};
    static const double boundary[] = {3.0, 3.0, 1.5};
    rb_rolling_case rc = carter_case(40);
    assert_int_equal(rb_rolling_error_runs(&rc), 2);
    rc.elastic_b = 1;
    rc.b.support = RB_BEM_HUB;
    assert_int_equal(rb_rolling_error_runs(&rc), 3);
    rc.elastic_b = 0; /* not read */
    assert_int_equal(rb_rolling_error_runs(&rc), 2);
    rc.a.support = RB_BEM_ARC;
    assert_int_equal(rb_rolling_error_runs(&rc), 3);
    rc.outer_refinement = 3.0;
    rc.steps = 7;
    for (int k = 0; k < 3; k++) {
        const rb_rolling_case run = rb_rolling_error_run(&rc, k);
        assert_int_equal(run.contact_elements, elements[k]);
        assert_int_equal(run.steps, steps[k]);
        CHECK_ABS(run.outer_refinement, boundary[k], 1e-15, "run %d", k);
    }
    rc.outer_refinement = 0.0;
    rc.steps = 0;
    CHECK_ABS(rb_rolling_error_run(&rc, 2).outer_refinement, 0.5, 0.0, "of one");
    CHECK_ABS(rb_rolling_error_run(&rc, 0).outer_refinement, 1.0, 0.0, "of one");
    assert_int_equal(rb_rolling_error_run(&rc, 0).steps, 0);
}

TEST(too_few_elements_cannot_be_halved)
{
    rb_rolling_case rc = carter_case(12);
    CHECK_OK(rb_rolling_error_check(&rc, &message));
    rc.contact_elements = 11;
    CHECK_SAYS(rb_rolling_error_check(&rc, &message), RB_EINVAL,
               "expected 12 contact elements or more, got 11");
    rc.contact_elements = 12;
    rc.outer_elements = 15; /* nothing to a half-plane */
    CHECK_OK(rb_rolling_error_check(&rc, &message));
    rc.a.support = RB_BEM_HUB;
    CHECK_SAYS(rb_rolling_error_check(&rc, &message), RB_EINVAL,
               "expected 16 outer elements or more, got 15");
    rc.outer_elements = 16;
    CHECK_OK(rb_rolling_error_check(&rc, &message));
    rc.outer_elements = 0;
    CHECK_OK(rb_rolling_error_check(&rc, &message));
}

TEST(the_power_of_an_edge_is_that_of_a_root)
{
    rb_rolling_case rc = carter_case(40);
    CHECK_REL(rb_rolling_edge_power(&rc, 500.0, -0.01, 2.0, 0.25), 0.3 * 500.0 * 0.01 * 0.125,
              1e-12, "similar bodies");
    rc.elastic_b = 0;
    const double beta = rb_rolling_derive(&rc).dundurs;
    CHECK_REL(rb_rolling_edge_power(&rc, 500.0, 0.01, 2.0, 0.04),
              0.3 * 500.0 * (0.01 + beta * 2.0 / 50.0) * 0.008, 1e-12, "unlike ones");
}

/* Every scalar with a bar: three spreads of solutions found here, and what no mesh tells
 * apart, recomputed; of a plain case and of one whose slip turns round over few elements. */
static void check_bars(const rb_rolling_case *rc)
{
    rb_rolling_solution own, run[3];
    rb_rolling_errors e;
    CHECK_OK(rb_rolling_solve_with_errors(rc, &own, &e, &message));
    for (int k = 0; k < 3; k++) {
        rb_rolling_case coarser = rb_rolling_error_run(rc, k % 2);
        if (k == 2)
            coarser.contact_elements = (int)(0.6 * rc->contact_elements);
        run[k] = solved(&coarser);
    }
    const double rounding = fmax(own.residual, rc->contact.tol), a = own.hertz_half_width;
    const double P = own.normal_load, R = rb_rolling_radius(rc);
    const double h = rb_rolling_longest_element(own.n, own.zone, own.h);
    const struct {
        rb_rolling_error_scale scale;
        double least;
    } scales[] = {
        {RB_SCALE_LOAD, rounding * P},
        {RB_SCALE_FRICTION, rounding * rc->mu * P},
        {RB_SCALE_ONE, rounding},
        {RB_SCALE_APPROACH, rounding * fabs(own.approach)},
        {RB_SCALE_CREEPAGE, rounding * fmax(rc->mu * a / R, fabs(own.creepage))},
        {RB_SCALE_WIDTH, rounding * a + (rc->mesh == RB_MESH_UNIFORM ? 0.1 * h : 0.0)},
        {RB_SCALE_PRESSURE, rounding * own.max_pressure},
        {RB_SCALE_POWER, rb_rolling_edge_power(rc, P, own.creepage, a, h / (2.0 * own.half_width))},
        {RB_SCALE_MOMENT, rounding * P * a},
        {RB_SCALE_STRAIN, rounding * a / R},
        {RB_SCALE_WORK, rounding * P * a / R},
        {RB_SCALE_ELEMENT, h}};
    int counted = 0;
    for (int j = 0; j < rb_rolling_solution_scalars.n; j++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[j];
        const double v[] = {rb_rolling_number(r, &run[0]), rb_rolling_number(r, &run[1])};
        for (size_t k = 0; k < sizeof scales / sizeof *scales; k++) {
            const double value = rb_rolling_number(r, &own);
            if (r->error_bar != scales[k].scale || isnan(value + v[0] + v[1]))
                continue;
            /* a fourth mesh, for three that see the edges in the same phase */
            const double other = rb_rolling_number(r, &run[2]);
            const double spread = fmax(fmax(value, other), fmax(v[0], v[1])) -
                                  fmin(fmin(value, other), fmin(v[0], v[1]));
            const int turns = (v[1] - v[0]) * (value - v[1]) <
                              -1e-6 * fmax(gsl_pow_2(v[1] - v[0]), gsl_pow_2(value - v[1]));
            const double bar =
                fmax(rb_rolling_contact_error(v, value), (turns ? 4.0 : 2.0) * spread) +
                scales[k].least;
            /* between unlike bodies p0 has more: what the pressure may be at a limit of stick */
            if (r->error_bar == RB_SCALE_PRESSURE && !rc->elastic_b)
                CHECK_MAX(bar, (1.0 + 1e-9) * rb_rolling_number(r, &e.scalar), "%s", r->name);
            else
                CHECK_REL(rb_rolling_number(r, &e.scalar), bar, 1e-9, "%s", r->name);
            counted++;
        }
        if (r->error_bar == RB_SCALE_NONE && r->kind != RB_RESULT_WHOLE)
            assert_true(isnan(rb_rolling_number(r, &e.scalar)));
    }
    assert_true(counted >= 12);
    for (int k = 0; k < 3; k++)
        rb_rolling_solution_free(&run[k]);
    rb_rolling_solution_free(&own);
}

TEST(every_scalar_has_its_bar)
{
    rb_rolling_case rc = carter_case(40);
    check_bars(&rc);
    set(&rc, "creep-ratio nan force-ratio -0.5");
    rc.elastic_b = 0;
    check_bars(&rc);
}

TEST(a_history_has_bars_of_its_steps)
{
    const double distance[] = {0.0, 0.0, 0.6}, load[] = {300.0, 500.0, 500.0},
                 force[] = {0.0, -50.0, -60.0};
    const rb_rolling_program program = {.n = 3, .distance = distance, .load = load, .force = force};
    rb_rolling_case rc = with(carter_case(24), "formulation transient creep-ratio nan load nan");
    rb_rolling_model model;
    rb_rolling_history h, run[2];
    CHECK_OK(rb_rolling_history_with_errors(&rc, &program, NULL, &model, &h, &message));
    rb_rolling_model_free(&model);
    assert_non_null(h.errors);
    assert_int_equal(h.errors->n, h.n);
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = rb_rolling_error_run(&rc, k);
        CHECK_OK(rb_rolling_history_run(&coarser, &program, NULL, &model, &run[k], &message));
        rb_rolling_model_free(&model);
    }
    for (int i = 0; i < 2; i++) { /* at rest: the same steps */
        const double at[] = {run[0].approach[i], run[1].approach[i]};
        CHECK_ABS(h.errors->approach[i], rb_rolling_contact_error(at, h.approach[i]), 1e-14,
                  "approach of step %d", i);
    }
    /* the last one ends where theirs ends; its bar is no less than its own and its
     * neighbour's */
    const int last = h.n - 1;
    const double end[] = {run[0].approach[run[0].n - 1], run[1].approach[run[1].n - 1]};
    assert_true(h.errors->approach[last] >= rb_rolling_contact_error(end, h.approach[last]));
    assert_true(h.errors->approach[last] >= 0.0);
    for (int i = 2; i < h.n; i++)
        assert_true(h.errors->creepage[i] >= 0.0 && h.errors->dissipation[i] > 0.0);
    for (int k = 0; k < 2; k++)
        rb_rolling_history_free(&run[k]);
    rb_rolling_history_free(&h);
    assert_null(h.errors);

    rb_rolling_case memory = carter_case(24);
    const rb_rolling_program timed = {.n = 2, .time = distance, .load = load};
    set(&memory, "formulation static creep-ratio nan relaxation-time 1 relaxation-ratio 0.5");
    CHECK_SAYS(rb_rolling_history_with_errors(&memory, &timed, NULL, &model, &h, &message),
               RB_EINVAL, "a history in time has no error bars");
    rb_rolling_history_free(&h);
}

/* Each that makes coarser runs refuses a case that cannot be halved. */
TEST(nothing_is_halved_below_its_least)
{
    rb_rolling_case rc = carter_case(4);
    rb_rolling_solution s = {0};
    rb_rolling_errors errors;
    rb_rolling_curve curve, bars;
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    CHECK_STATUS(rb_rolling_error_check(&rc, &message), RB_EINVAL);
    CHECK_STATUS(rb_rolling_estimate_errors(&rc, &s, NULL, NULL, &errors, &message), RB_EINVAL);
    assert_true(isnan(errors.scalar.normal_load));
    CHECK_STATUS(rb_rolling_curve_with_errors(&rc, &(rb_rolling_range){0, 0.0, 1.0, 2, RB_UNITS_MM},
                                              NULL, NULL, &curve, &bars, &message),
                 RB_EINVAL);
    set(&rc, "formulation transient distance 1");
    CHECK_STATUS(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &h, &message), RB_EINVAL);
}

/* ---- Starts from coarse solutions -------------------------------------------------- */

enum { COARSE = 8, FINE = 24 };

typedef struct {
    rb_rolling_mesh mesh;
    rb_contact_state state;
    double ends[FINE + 2], p[FINE], q[FINE];
    int zone[FINE];
} line;

/* Elements of length h from 0 on. */
static void make(line *l, int n, double h)
{
    memset(l, 0, sizeof *l);
    for (int i = 0; i < n + 2; i++)
        l->ends[i] = i * h;
    l->mesh = (rb_rolling_mesh){.n = n, .ends = l->ends};
    l->state = (rb_contact_state){.n = n, .p = l->p, .q = l->q, .zone = l->zone};
}

/* Three fine elements in each coarse one: its middle has its values, the others lie on
 * the line to its neighbour; beyond the outermost midpoints they stay. */
TEST(tractions_are_linear_between_midpoints)
{
    line coarse, fine;
    const rb_rolling_case rc = half_plane(RB_STATIC, FINE);
    make(&coarse, COARSE, 3.0);
    make(&fine, FINE, 1.0);
    for (int j = 0; j < COARSE; j++) {
        coarse.p[j] = 6.0 + j * j;
        coarse.q[j] = j % 2 ? 3.0 : -3.0;
        coarse.zone[j] = RB_ZONE_STICK;
    }
    coarse.state.delta = 0.4;
    coarse.state.xi = 0.05;
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++) {
        const int j = i / 3, other = i % 3 == 0 ? j - 1 : i % 3 == 2 ? j + 1 : j;
        const int to = other < 0 || other == COARSE ? j : other;
        CHECK_REL(fine.p[i], coarse.p[j] + (coarse.p[to] - coarse.p[j]) / 3.0, 1e-14, "p of %d", i);
        CHECK_REL(fine.q[i], coarse.q[j] + (coarse.q[to] - coarse.q[j]) / 3.0, 1e-14, "q of %d", i);
    }
    CHECK_ABS(fine.state.delta, 0.4, 0.0, "approach");
    CHECK_ABS(fine.state.xi, 0.05, 0.0, "creepage");
}

/* A coarse contact of elements first ... last, whose p^2 falls linearly to the edges,
 * slips left of x = 12 and sticks right of it; a fine line for its start. */
static void make_contact(line *coarse, line *fine, int first, int last, const double edge[2],
                         int slip)
{
    make(coarse, COARSE, 3.0);
    make(fine, FINE, 1.0);
    for (int j = first; j <= last; j++) {
        const double x = 3.0 * j + 1.5;
        coarse->p[j] = sqrt(x < 12.0 ? x - edge[0] : edge[1] - x);
        coarse->zone[j] = j < 4 ? slip : RB_ZONE_STICK;
    }
}

/* Zones are those of the coarse element within its edges, which lie between midpoints:
 * there an open element takes the zone of its loaded neighbour. */
TEST(zones_end_at_the_coarse_edges)
{
    line coarse, fine;
    const rb_rolling_case rc = half_plane(RB_STATIC, FINE);
    double from, to;
    /* open elements reach to 6 and from 18 on */
    make_contact(&coarse, &fine, 2, 5, (double[]){4.9, 20.3}, RB_ZONE_SLIP_NEGATIVE);
    coarse.p[1] = coarse.p[6] = 0.0;
    /* five elements and more have edges of their own */
    coarse.zone[6] = RB_ZONE_SEPARATED;
    rb_rolling_contact_edges(&rc, &coarse.mesh, &coarse.state, &from, &to);
    CHECK_ABS(from, 6.0, 0.0, "four elements end at their ends");
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++)
        assert_int_equal(fine.zone[i], i < 6    ? RB_ZONE_SEPARATED
                                       : i < 12 ? RB_ZONE_SLIP_NEGATIVE
                                       : i < 18 ? RB_ZONE_STICK
                                                : RB_ZONE_SEPARATED);
}

/* Elements of a fine line that is wider than the coarse one are open, and have the
 * tractions of its last element on their side. */
TEST(nothing_is_known_beyond_the_coarse_line)
{
    const rb_rolling_case rc = half_plane(RB_STATIC, FINE);
    line *coarse = calloc(1, sizeof *coarse);
    SCRATCH double *ends = rb_alloc(COARSE + 2, 1), *p = rb_alloc(COARSE, 1);
    SCRATCH int *zone = rb_alloc_int(COARSE);
    line fine;
    assert_true(coarse && ends && p && zone);
    make(coarse, COARSE, 3.0);
    make(&fine, FINE, 2.0); /* from -12 to 36 over 0 to 24 */
    for (int i = 0; i < FINE + 2; i++)
        fine.ends[i] -= 12.0;
    for (int j = 0; j < COARSE; j++) {
        p[j] = 1.0 + j;
        zone[j] = RB_ZONE_STICK;
    }
    memcpy(ends, coarse->ends, (COARSE + 2) * sizeof *ends);
    coarse->mesh.ends = ends; /* arrays of their own end where they end */
    coarse->state.p = coarse->state.q = p;
    coarse->state.zone = zone;
    rb_rolling_start_from(&rc, &coarse->mesh, &coarse->state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++) {
        if (i >= 6 && i < 18)
            continue;
        assert_int_equal(fine.zone[i], RB_ZONE_SEPARATED);
        CHECK_ABS(fine.p[i], i < 6 ? 1.0 : COARSE, 0.0, "p of %d", i);
    }
    free(coarse);
}

TEST(open_elements_inside_the_edges_join_their_neighbour)
{
    line coarse, fine;
    const rb_rolling_case rc = half_plane(RB_STATIC, FINE);
    double from, to;
    /* the edges lie in open elements */
    make_contact(&coarse, &fine, 1, 6, (double[]){2.2, 21.8}, RB_ZONE_SLIP_POSITIVE);
    rb_rolling_contact_edges(&rc, &coarse.mesh, &coarse.state, &from, &to);
    CHECK_ABS(from, 2.2, 1e-12, "in the open element");
    CHECK_ABS(to, 21.8, 1e-12, "in the open element");
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    for (int i = 0; i < FINE; i++)
        assert_int_equal(fine.zone[i], i < 2    ? RB_ZONE_SEPARATED
                                       : i < 12 ? RB_ZONE_SLIP_POSITIVE
                                       : i < 22 ? RB_ZONE_STICK
                                                : RB_ZONE_SEPARATED);
    coarse.zone[3] = RB_ZONE_SEPARATED; /* a gap inside: of both the left neighbour */
    coarse.zone[4] = RB_ZONE_SLIP_NEGATIVE;
    rb_rolling_start_from(&rc, &coarse.mesh, &coarse.state, &fine.mesh, &fine.state);
    assert_int_equal(fine.zone[10], RB_ZONE_SLIP_POSITIVE);
}

TEST(a_quarter_of_the_elements_or_40_start)
{
    assert_int_equal(rb_rolling_coarse_elements(0), 40);
    assert_int_equal(rb_rolling_coarse_elements(4 * RB_ROLLING_TRANSFORMS - 1), 40);
    assert_int_equal(rb_rolling_coarse_elements(4 * RB_ROLLING_TRANSFORMS), RB_ROLLING_TRANSFORMS);
    assert_int_equal(rb_rolling_coarse_elements(40000), 10000);
}

RUN_TESTS(NULL, NULL)
