/* Error bars are what theory.md 5.1 says of the coarser runs: three times the spread over
 * n/2, 0.7 n and n contact elements, and one and a half times the difference that half of
 * the boundary makes; here these runs are made one by one. */
#include "check.h"
#include "rollbem/rolling.h"

#include <string.h>

static const struct {
    double contact, boundary;
} parts[] = {{0.5, 1.0}, {0.7, 1.0}, {1.0, 0.5}};

static rb_rolling_case plain_case(rb_bem_support support)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = support;
    rc.a.hub_ratio = 0.5;
    rc.elastic_b = 1;
    rc.b = rc.a;
    rc.b.support = RB_BEM_HALFPLANE;
    rc.b.radius = INFINITY;
    rc.b.young *= 2.0;
    rc.half_width = 0.01 * rc.a.radius;
    rc.formulation = RB_STEADY;
    rc.mu = 0.3;
    rc.creep_ratio = 0.4;
    rc.contact_elements = 40;
    rc.outer_elements = support == RB_BEM_HALFPLANE ? 0 : 80;
    rc.mesh = RB_MESH_UNIFORM;
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

/* contact: the values with n/2, 0.7 n and n elements; boundary: that with half of it. */
static double wanted_bar(const double contact[3], int has_boundary, double boundary)
{
    const double most = fmax(contact[0], fmax(contact[1], contact[2]));
    const double least = fmin(contact[0], fmin(contact[1], contact[2]));
    return 3.0 * (most - least) +
           (has_boundary ? 1.5 * fabs(contact[2] - boundary) : 0.0);
}

/* Rounding is on top, and nothing else. */
static void check_bar(const char *name, double got, double want, double size)
{
    CHECK_ABS(got, want, 1e-9 * want + 1e-8 * size, "bar of %s", name);
}

static void bars_of_a_solution(rb_bem_support support)
{
    static const char *const names[] = {"tangential_load", "approach", "max_pressure",
                                        "force_ratio", "half_width"};
    rb_rolling_case rc = plain_case(support);
    rb_rolling_solution own, run[3];
    rb_rolling_errors errors;
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_solve_with_errors(&rc, 0, &own, &errors, &why), RB_OK);
    for (int k = 0; k < 3; k++) {
        const rb_rolling_case coarser = coarser_case(&rc, k);
        CHECK_STATUS(rb_rolling_solve(&coarser, &run[k], &why), RB_OK);
    }
    int seen = 0;
    for (int j = 0; j < rb_rolling_solution_scalars.n; j++) {
        const rb_rolling_result *row = &rb_rolling_solution_scalars.row[j];
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
            if (strcmp(row->name, names[i]) != 0)
                continue;
            const double contact[] = {rb_rolling_number(row, &run[0]),
                                      rb_rolling_number(row, &run[1]),
                                      rb_rolling_number(row, &own)};
            check_bar(row->name, rb_rolling_number(row, &errors.scalar),
                      wanted_bar(contact, support != RB_BEM_HALFPLANE,
                                 rb_rolling_number(row, &run[2])),
                      fabs(contact[2]));
            seen++;
        }
    }
    assert_int_equal(seen, sizeof names / sizeof names[0]);
    for (int k = 0; k < 3; k++)
        rb_rolling_solution_free(&run[k]);
    rb_rolling_solution_free(&own);
}

static void a_solution_s_bars_are_of_its_coarser_runs(void **state)
{
    (void)state;
    bars_of_a_solution(RB_BEM_HALFPLANE);
    bars_of_a_solution(RB_BEM_HUB);
}

static void a_curve_s_bars_are_of_its_coarser_curves(void **state)
{
    enum { POINTS = 5 };
    (void)state;
    const rb_rolling_case rc = plain_case(RB_BEM_HALFPLANE);
    rb_rolling_curve own, errors, run[2];
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_curve_with_errors(&rc, RB_OVER_CREEP_RATIO, 0.2, 1.0, POINTS,
                                              &own, &errors, &why),
                 RB_OK);
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = coarser_case(&rc, k);
        CHECK_STATUS(rb_rolling_curve_solve(&coarser, RB_OVER_CREEP_RATIO, 0.2, 1.0,
                                            POINTS, &run[k], &why),
                     RB_OK);
    }
    for (int i = 0; i < POINTS; i++) {
        const double Q[] = {run[0].tangential_load[i], run[1].tangential_load[i],
                            own.tangential_load[i]};
        check_bar("tangential_load", errors.tangential_load[i], wanted_bar(Q, 0, 0.0),
                  fabs(Q[2]));
    }
    const double free_creepage[] = {run[0].free_creepage, run[1].free_creepage,
                                    own.free_creepage};
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

/* Of each rolled step the largest of its own bar and its neighbours'. */
static void a_history_s_bars_are_of_its_coarser_histories(void **state)
{
    enum { STEPS = 10 };
    (void)state;
    rb_rolling_case rc = plain_case(RB_BEM_HALFPLANE);
    rc.formulation = RB_TRANSIENT;
    rc.zone = 1.5 * rc.half_width;
    rc.distance = 0.8;
    rc.steps = STEPS;
    rb_rolling_model model, others[2];
    rb_rolling_history own, errors, run[2];
    rb_message why = {""};
    CHECK_STATUS(rb_rolling_history_with_errors(&rc, NULL, NULL, NULL, &model, &own,
                                                &errors, &why),
                 RB_OK);
    for (int k = 0; k < 2; k++) {
        const rb_rolling_case coarser = coarser_case(&rc, k);
        CHECK_STATUS(
            rb_rolling_history_run(&coarser, NULL, NULL, NULL, &others[k], &run[k], &why),
            RB_OK);
        assert_int_equal(run[k].distance[0] == 0.0, 1);
    }
    double bar[STEPS + 1] = {0.0};
    assert_int_equal(own.n, STEPS + 1);
    for (int i = 1; i <= STEPS; i++) {
        const double x = own.distance[i];
        const double Q[] = {at_distance(&run[0], run[0].tangential_load, x),
                            at_distance(&run[1], run[1].tangential_load, x),
                            own.tangential_load[i]};
        bar[i] = wanted_bar(Q, 0, 0.0);
    }
    for (int i = 1; i <= STEPS; i++) {
        double want = bar[i];
        for (int k = i > 1 ? i - 1 : 1; k <= i + 1 && k <= STEPS; k++)
            want = fmax(want, bar[k]);
        check_bar("tangential_load", errors.tangential_load[i], want,
                  fabs(own.tangential_load[STEPS]));
    }
    for (int k = 0; k < 2; k++) {
        rb_rolling_history_free(&run[k]);
        rb_rolling_model_free(&others[k]);
    }
    rb_rolling_history_free(&errors);
    rb_rolling_history_free(&own);
    rb_rolling_model_free(&model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_solution_s_bars_are_of_its_coarser_runs),
        cmocka_unit_test(a_curve_s_bars_are_of_its_coarser_curves),
        cmocka_unit_test(a_history_s_bars_are_of_its_coarser_histories),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
