/* Error bars are what theory-solvers.md 5.1 says of the coarser runs: three times the spread over
 * n/2, 0.7 n and n contact elements, and one and a half times the difference that half of
 * the boundary makes; here these runs are made one by one. */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

static const struct {
    double contact, boundary;
} parts[] = {{0.5, 1.0}, {0.7, 1.0}, {1.0, 0.5}, {0.6, 1.0}};

static rb_rolling_case plain_case(rb_bem_support support)
{
    rb_rolling_case rc = rolling_case("hub-ratio 0.5");
    rc.a.support = support;
    rc.elastic_b = 1;
    rc.b = rc.a;
    set(&rc, "support-b halfplane radius-b plane");
    rc.b.young *= 2.0;
    set(&rc,
        "half-width %g formulation steady mu 0.3 creep-ratio 0.4 contact-elements 40 "
        "outer-elements %d mesh uniform",
        0.01 * rc.a.radius, support == RB_BEM_HALFPLANE ? 0 : 80);
    return rc;
}

static rb_rolling_case coarser_case(const rb_rolling_case *rc, int k)
{
    rb_rolling_case coarser = *rc;
    coarser.contact_elements = (int)(parts[k].contact * rc->contact_elements);
    coarser.steps = (int)ceil(parts[k].contact * rc->steps);
    coarser.outer_refinement = parts[k].boundary;
    return coarser;
}

/* contact: the values with n/2, 0.7 n and n elements, five times whose spread where they
 * do not follow in order; boundary: that with half of it. */
static double wanted_bar(const double contact[3], int has_boundary, double boundary)
{
    const double most = fmax(contact[0], fmax(contact[1], contact[2]));
    const double least = fmin(contact[0], fmin(contact[1], contact[2]));
    const int turns = (contact[1] - contact[0]) * (contact[2] - contact[1]) <
                      -1e-6 * (most - least) * (most - least);
    return (turns ? 5.0 : 3.0) * (most - least) +
           (has_boundary ? 2.0 * fabs(contact[2] - boundary) : 0.0);
}

/* A solution has a fourth mesh, of 0.6 n: twice the spread of all, four times where the others do
 * not follow in order, if that is more. */
static double wanted_bar_of_four(const double contact[4], int has_boundary, double boundary)
{
    const double most = fmax(contact[3], fmax(contact[0], fmax(contact[1], contact[2])));
    const double least = fmin(contact[3], fmin(contact[0], fmin(contact[1], contact[2])));
    const double first = contact[1] - contact[0], second = contact[2] - contact[1];
    const int turns = first * second < -1e-6 * fmax(first * first, second * second);
    return fmax(wanted_bar(contact, 0, 0.0), (turns ? 4.0 : 2.0) * (most - least)) +
           (has_boundary ? 2.0 * fabs(contact[2] - boundary) : 0.0);
}

/* Rounding is on top, and nothing else. */
static void check_bar(const char *name, double got, double want, double size)
{
    CHECK_ABS(got, want, 1e-9 * want + 1e-8 * size, "bar of %s", name);
}

/* Slip over a part of an element at an edge: mu P (|xi| + |beta| a/R) share^1.5. */
static double edge_power(const rb_rolling_case *rc, double P, double creepage, double a,
                         double share)
{
    const double beta = fabs(rb_rolling_derive(rc).dundurs);
    return rc->mu * P * (fabs(creepage) + beta * a / rc->a.radius) * pow(share, 1.5);
}

/* Given values have bars as well: rounding, which is not zero. */
static void check_rounding(const char *name, double bar, double size)
{
    CHECK_MAX(bar, 1e-7 * size, "bar of %s", name);
    CHECK_MAX(1e-17 * size, bar, "bar of %s is zero", name);
}

static void bars_of_a_solution(rb_bem_support support)
{
    static const char *const names[] = {"tangential_load", "approach", "max_pressure",
                                        "force_ratio", "half_width"};
    rb_rolling_case rc = plain_case(support);
    rb_rolling_solution own, run[4];
    rb_rolling_errors errors;
    CHECK_OK(rb_rolling_solve_with_errors(&rc, &own, &errors, &message));
    assert_true(isnan(errors.stress.max_shear.value) && isnan(errors.stress.tension.y));
    for (int k = 0; k < 4; k++) {
        const rb_rolling_case coarser = coarser_case(&rc, k);
        CHECK_OK(rb_rolling_solve(&coarser, &run[k], &message));
    }
    int counted = 0;
    double longest = 0.0;
    for (int i = 0; i < own.n; i++)
        longest = fmax(longest, own.zone[i] == RB_ZONE_SEPARATED ? 0.0 : own.h[i]);
    for (int j = 0; j < rb_rolling_solution_scalars.n; j++) {
        const rb_rolling_result *row = &rb_rolling_solution_scalars.row[j];
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
            if (strcmp(row->name, names[i]) != 0)
                continue;
            const double contact[] = {rb_rolling_number(row, &run[0]),
                                      rb_rolling_number(row, &run[1]), rb_rolling_number(row, &own),
                                      rb_rolling_number(row, &run[3])};
            check_bar(
                row->name, rb_rolling_number(row, &errors.scalar),
                wanted_bar_of_four(contact, support != RB_BEM_HALFPLANE,
                                   rb_rolling_number(row, &run[2])) +
                    (strcmp(names[i], "half_width") == 0 ? 0.1 * longest : 0.0), /* equal ones */
                fabs(contact[2]));
            counted++;
        }
    }
    assert_int_equal(counted, sizeof names / sizeof names[0]);
    check_rounding("normal_load", errors.scalar.normal_load, own.normal_load);
    if (support == RB_BEM_HALFPLANE) {
        const double D[] = {run[0].dissipation, run[1].dissipation, own.dissipation,
                            run[3].dissipation};
        check_bar("dissipation", errors.scalar.dissipation,
                  wanted_bar_of_four(D, 0, 0.0) + edge_power(&rc, own.normal_load, own.creepage,
                                                             own.hertz_half_width,
                                                             longest / (2.0 * own.half_width)),
                  own.dissipation);
    }
    for (int k = 0; k < 4; k++)
        rb_rolling_solution_free(&run[k]);
    rb_rolling_solution_free(&own);
}

TEST(a_solution_s_bars_are_of_its_coarser_runs)
{
    bars_of_a_solution(RB_BEM_HALFPLANE);
    bars_of_a_solution(RB_BEM_HUB);
}

TEST(stresses_have_bars_where_they_are_asked_for)
{
    const rb_rolling_case rc = plain_case(RB_BEM_HALFPLANE);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) own, again;
    OWNED(rb_rolling_stress_maxima) maxima = {.bonds = 0};
    OWNED(rb_rolling_errors) errors, alone;
    CHECK_OK(rb_rolling_solve_model(&rc, &model, &own, &message));
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &maxima, &message));
    CHECK_OK(rb_rolling_estimate_errors(&rc, &own, &maxima, NULL, &errors, &message));
    CHECK_OK(rb_rolling_solve_with_errors(&rc, &again, &alone, &message));
    assert_true(errors.scalar.max_pressure == alone.scalar.max_pressure &&
                errors.scalar.force_ratio == alone.scalar.force_ratio);
    assert_true(isnan(alone.stress.max_shear.value));
    assert_true(errors.stress.max_shear.value > 1e-9 * own.max_pressure);
    CHECK_MAX(errors.stress.max_shear.value, 0.1 * own.max_pressure, "bar of max_shear");
    assert_true(errors.stress.von_mises.y > 0.0);
    CHECK_MAX(errors.stress.von_mises.y, own.half_width, "bar of its depth");
}

TEST(a_curve_s_bars_are_of_its_coarser_curves)
{
    enum { POINTS = 5 };
    const rb_rolling_case rc = plain_case(RB_BEM_HALFPLANE);
    const rb_rolling_range range = {RB_OVER_CREEP_RATIO, 0.2, 1.0, POINTS, RB_UNITS_MM};
    rb_rolling_curve own, errors, run[2];
    CHECK_OK(rb_rolling_curve_with_errors(&rc, &range, NULL, NULL, &own, &errors, &message));
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = coarser_case(&rc, k);
        CHECK_OK(rb_rolling_curve_solve(&coarser, &range, &run[k], &message));
    }
    for (int i = 0; i < POINTS; i++) {
        const double Q[] = {run[0].tangential_load[i], run[1].tangential_load[i],
                            own.tangential_load[i]};
        check_bar("tangential_load", errors.tangential_load[i], wanted_bar(Q, 0, 0.0), fabs(Q[2]));
        const double stick[] = {run[0].stick_ratio[i], run[1].stick_ratio[i], own.stick_ratio[i]};
        check_bar("stick_ratio", errors.stick_ratio[i], wanted_bar(stick, 0, 0.0) + own.stick_step,
                  1.0);
        const double D[] = {run[0].dissipation[i], run[1].dissipation[i], own.dissipation[i]};
        check_bar("dissipation", errors.dissipation[i],
                  wanted_bar(D, 0, 0.0) + edge_power(&rc, own.normal_load[i], own.creepage[i],
                                                     own.half_width, own.stick_step),
                  own.dissipation[i]);
        check_rounding("normal_load", errors.normal_load[i], own.normal_load[i]);
    }
    const double free_creepage[] = {run[0].free_creepage, run[1].free_creepage, own.free_creepage};
    check_bar("free_creepage", errors.free_creepage, wanted_bar(free_creepage, 0, 0.0),
              fabs(own.free_creepage));
    for (int k = 0; k < 2; k++)
        rb_rolling_curve_free(&run[k]);
    rb_rolling_curve_free(&errors);
    rb_rolling_curve_free(&own);
}

/* Linear between the steps of a history that began at rest. */
static double at_distance(const rb_rolling_history *h, const double *column, double x)
{
    int k = 0;
    while (k + 2 < h->n && h->distance[k + 1] < x)
        k++;
    return column[k] + (column[k + 1] - column[k]) * (x - h->distance[k]) /
                           (h->distance[k + 1] - h->distance[k]);
}

/* A mean over a step belongs to its middle; the step at rest has none. */
static double mean_at(const rb_rolling_history *h, const double *column, double x)
{
    double middle[2];
    int k = 1;
    for (;; k++) {
        for (int j = 0; j < 2; j++)
            middle[j] = 0.5 * (h->distance[k + j - 1] + h->distance[k + j]);
        if (k + 2 >= h->n || middle[1] >= x)
            break;
    }
    return column[k] + (column[k + 1] - column[k]) * (x - middle[0]) / (middle[1] - middle[0]);
}

/* The largest of bar[1] ... bar[steps] at i and beside it. */
static double with_neighbours(const double *bar, int i, int steps)
{
    double most = bar[i];
    for (int k = i > 1 ? i - 1 : 1; k <= i + 1 && k <= steps; k++)
        most = fmax(most, bar[k]);
    return most;
}

/* Of each rolled row the largest of its own bar and its neighbours'.  Rows of one step are fewer on
 * a coarser mesh; rows of several steps stay, and have fewer. */
static void bars_of_a_history(double distance, int force_is_given)
{
    enum { STEPS = 10 };
    rb_rolling_case rc = plain_case(RB_BEM_HALFPLANE);
    set(&rc, "formulation transient zone %g distance %g steps %d", 1.5 * rc.half_width, distance,
        STEPS);
    if (force_is_given) {
        set(&rc, "creep-ratio nan force-ratio 0.5");
    }
    rb_rolling_model model, others[3];
    rb_rolling_history own, run[3];
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &own, &message));
    for (int k = 0; k < 3; k++) {
        rb_rolling_case coarser = coarser_case(&rc, k);
        if (k == 2) {
            coarser = rc;
            coarser.contact_elements = (int)(0.85 * rc.contact_elements);
            coarser.steps = (int)ceil(0.85 * rc.steps);
        }
        if (own.substeps[STEPS] > 1)
            coarser.steps = STEPS;
        CHECK_OK(rb_rolling_history_run(&coarser, NULL, NULL, &others[k], &run[k], &message));
    }
    double force[STEPS + 1] = {0.0}, creepage[STEPS + 1] = {0.0}, power[STEPS + 1] = {0.0};
    assert_int_equal(own.n, STEPS + 1);
    assert_int_equal(own.substeps[STEPS], distance < 0.75 ? 1 : 3); /* elements of 0.075 a */
    for (int i = 1; i <= STEPS; i++) {
        const double x = own.distance[i], middle = 0.5 * (own.distance[i - 1] + x);
        double Q[4] = {0.0, 0.0, own.tangential_load[i]};
        double xi[4] = {0.0, 0.0, own.creepage[i]}, D[4] = {0.0, 0.0, own.dissipation[i]};
        for (int k = 0; k < 3; k++) {
            const int at = k < 2 ? k : 3;
            Q[at] = at_distance(&run[k], run[k].tangential_load, x);
            xi[at] = mean_at(&run[k], run[k].creepage, middle);
            D[at] = mean_at(&run[k], run[k].dissipation, middle);
        }
        force[i] = wanted_bar_of_four(Q, 0, 0.0);
        creepage[i] = wanted_bar_of_four(xi, 0, 0.0);
        power[i] = wanted_bar_of_four(D, 0, 0.0) +
                   edge_power(&rc, own.normal_load[i], own.creepage[i],
                              0.5 * (own.contact_to[i] - own.contact_from[i]),
                              1.0 / (own.stick[i] + own.slipping[i]));
    }
    for (int i = 1; i <= STEPS; i++) {
        check_bar("tangential_load", own.errors->tangential_load[i],
                  with_neighbours(force, i, STEPS), fabs(own.tangential_load[STEPS]));
        check_bar("creepage", own.errors->creepage[i], with_neighbours(creepage, i, STEPS),
                  fabs(own.creepage[STEPS]));
        check_bar("dissipation", own.errors->dissipation[i], with_neighbours(power, i, STEPS),
                  own.dissipation[STEPS]);
    }
    for (int k = 0; k < 3; k++) {
        rb_rolling_history_free(&run[k]);
        rb_rolling_model_free(&others[k]);
    }
    rb_rolling_history_free(&own);
    rb_rolling_model_free(&model);
}

TEST(a_history_s_bars_are_of_its_coarser_histories)
{
    bars_of_a_history(0.7, 0);
    bars_of_a_history(0.7, 1);
    bars_of_a_history(1.6, 0);
}

/* Slip within the last element of the contact does work that elements which all stick do not show.
 */
TEST(work_of_slip_within_an_element_has_a_bar)
{
    rb_rolling_case rc = half_plane(RB_TRANSIENT, 60);
    set(&rc, "gap parabola radius 100 mu 0.559 young 210000 poisson 0.193 similar load 50 "
             "creep-ratio 0.338 distance 0.5 steps 30");
    rb_rolling_case fine = rc;
    rb_rolling_model model, fine_model;
    rb_rolling_history own, truth;
    int unseen = 0;

    fine.contact_elements *= 4;
    fine.steps *= 4;
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &own, &message));
    CHECK_OK(rb_rolling_history_run(&fine, NULL, NULL, &fine_model, &truth, &message));
    const int rest = own.n - rc.steps;
    for (int i = rest; i < own.n; i++) {
        const double work = truth.friction_work[truth.n - fine.steps + 4 * (i - rest) + 3];
        unseen += own.friction_work[i] == 0.0 && work > 0.0;
        CHECK_ABS(own.friction_work[i], work, own.errors->friction_work[i], "step %d", i);
    }
    assert_true(unseen > 0);
    rb_rolling_history_free(&own);
    rb_rolling_history_free(&truth);
    rb_rolling_model_free(&model);
    rb_rolling_model_free(&fine_model);
}

/* A history and one of finer elements: the bars of a column at a row hold the latter. */
static void check_column(const rb_rolling_history *own, const rb_rolling_history *truth,
                         const char *name, int row, int fine_row, double most)
{
    const rb_rolling_result *r =
        NOT_NULL(rb_rolling_find_result(&rb_rolling_history_columns, name));
    const double bar = rb_rolling_column(r, own->errors)[row];
    CHECK_ABS(rb_rolling_column(r, own)[row], rb_rolling_column(r, truth)[fine_row], bar,
              "%s in row %d", name, row);
    CHECK_MAX(bar, most, "%s is not absurdly wide", name);
}

/* The approach on 14, 19 and 28 elements agrees by chance to an eighth of its error; on 23 it does
 * not. */
TEST(a_fourth_mesh_of_a_history_sees_what_three_agree_in)
{
    rb_rolling_case rc =
        rolling_case("support halfplane gap parabola radius 100 young 210000 poisson 0.3 young-b "
                     "271586 poisson-b 0.2235 support-b halfplane radius-b plane mu 0.1861 "
                     "half-width 3.466 formulation transient contact-elements 28 distance 1.96 "
                     "steps 22 creep-ratio -0.274");
    rb_rolling_case fine = rc;
    OWNED(rb_rolling_model) model = {0}, fine_model = {0};
    OWNED(rb_rolling_history) own, truth;
    fine.contact_elements *= 5;
    fine.steps *= 5;
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &own, &message));
    CHECK_OK(rb_rolling_history_run(&fine, NULL, NULL, &fine_model, &truth, &message));
    check_column(&own, &truth, "approach", own.n - 1, truth.n - 1, 5e-4);
}

/* All elements of the last row slide one way, and of five times as many not all: Q/(mu P) was
 * -1 +- 1e-15 for -.99989.  Where A slides much faster all do. */
TEST(a_row_that_slides_may_hide_stick)
{
    rb_rolling_case rc = rolling_case(
        "support halfplane gap parabola radius 100 young 210000 poisson 0 mu 0.07604 half-width "
        "0.438 formulation transient contact-elements 54 distance 1 creep-ratio 0.549");
    rb_rolling_case fine = with(rc, "contact-elements 270");
    OWNED(rb_rolling_model) model = {0}, fine_model = {0};
    OWNED(rb_rolling_history) own, truth;
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &own, &message));
    CHECK_OK(rb_rolling_history_run(&fine, NULL, NULL, &fine_model, &truth, &message));
    assert_int_equal(own.stick[own.n - 1], 0);
    assert_true(truth.force_ratio[truth.n - 1] > -0.9999);
    check_column(&own, &truth, "force_ratio", own.n - 1, truth.n - 1, 2e-3);
    check_column(&own, &truth, "tangential_load", own.n - 1, truth.n - 1, 0.05);
    rc.creep_ratio = 30.0;
    OWNED(rb_rolling_model) sliding = {0};
    OWNED(rb_rolling_history) slides;
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &sliding, &slides, &message));
    CHECK_MAX(slides.errors->force_ratio[slides.n - 1], 1e-9, "full sliding");
}

/* Unlike bodies that are pressed do work of first order in the number of increments, which the
 * program chooses: with two of them it was 0.102 +- 0.003, with 128 it is 0.042.  What vanishes by
 * symmetry is known to rounding, which is not that of 1e-17. */
TEST(work_of_pressing_has_the_bar_of_its_increments)
{
    const double load[] = {1643.1, 1261.5}, force_ratio[] = {0.0, -0.2068};
    const rb_rolling_program program = {.n = 2, .load = load, .force_ratio = force_ratio};
    const rb_rolling_case rc =
        rolling_case("support halfplane gap exact radius 100 young 210000 poisson 0.236 mu 0.1215 "
                     "formulation static contact-elements 55");
    rb_rolling_case fine = rc;
    OWNED(rb_rolling_model) model = {0}, fine_model = {0};
    OWNED(rb_rolling_history) own, truth;
    fine.increments = 128;
    fine.contact_elements *= 2;
    CHECK_OK(rb_rolling_history_with_errors(&rc, &program, NULL, &model, &own, &message));
    CHECK_OK(rb_rolling_history_run(&fine, &program, NULL, &fine_model, &truth, &message));
    for (int i = 0; i < 2; i++)
        check_column(&own, &truth, "friction_work", i, i, 0.4);
    check_column(&own, &truth, "moment", 0, 0, 1e-4);
    assert_true(own.errors->shift[0] > 1e-17 && own.errors->shift[0] < 1e-9);
}

/* Fretting wear, whose first row is that of few increments of a cycle and whose stick zone begins
 * to slip between two rows of half as many steps. */
TEST(bars_of_fretting_hold_finer_cycles)
{
    const rb_rolling_case rc =
        rolling_case("support halfplane gap parabola radius 100 young 210000 poisson 0 mu 0.3406 "
                     "half-width 1.036 formulation static force-ratio 0.626 contact-elements 57");
    const rb_rolling_wear wear = {
        .coefficient = 1.483e-8, .share = 0.5, .way = 1e4, .steps = 5, .increments = 4};
    static const char *const names[] = {"worn", "max_depth", "max_depth_b", "work", "stroke"};
    rb_rolling_wear other = wear;
    rb_rolling_wear_history own, truth;
    rb_rolling_solution last;
    other.steps *= 4;
    other.increments *= 4;
    CHECK_OK(rb_rolling_wear_with_errors(&rc, &wear, NULL, &own, &last, &message));
    rb_rolling_solution_free(&last);
    CHECK_OK(rb_rolling_wear_run(&rc, &other, NULL, &truth, &last, &message));
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        const rb_rolling_result *r =
            NOT_NULL(rb_rolling_find_result(&rb_rolling_wear_columns, names[k]));
        for (int i = 1; i < own.n; i++)
            CHECK_ABS(rb_rolling_column(r, &own)[i], rb_rolling_column(r, &truth)[4 * i],
                      rb_rolling_column(r, own.errors)[i], "%s in row %d", names[k], i);
        CHECK_MAX(rb_rolling_column(r, own.errors)[own.n - 1],
                  rb_rolling_column(r, &own)[own.n - 1], "%s is not absurdly wide", names[k]);
    }
    rb_rolling_wear_history_free(&own);
    rb_rolling_wear_history_free(&truth);
    rb_rolling_solution_free(&last);
}

RUN_TESTS(NULL, NULL)
