/* Friction that depends on the state: the coefficients of a state, starts, the uniqueness
 * number, forces, each recomputed here; and in how many solves they are found. */
#include "cases.h"
#include "analysis/sensitivity/sensitivity.h"
#include "solved.h"

/* ---- The coefficients of a state --------------------------------------------------- */

TEST(each_element_has_the_coefficient_of_its_slip)
{
    rb_rolling_case rc = with(falling_case(RB_STEADY, 0.2, 20.0), "creep-ratio 0.7");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    const rb_contact_state *s = &model.state;
    int slides = 0;
    for (int i = 0; i < s->n; i++) {
        const double v = fabs(s->lambda[i]) / model.problem.e_T[i] * rc.speed;
        if (s->p[i] == 0.0)
            continue;
        CHECK_MAX(fabs(s->q[i]), falling_mu(&rc, v) * s->p[i] + 1e-8 * model.problem.stress,
                  "bound of %d", i);
        if (s->zone[i] == RB_ZONE_STICK)
            continue;
        slides++;
        CHECK_ABS(fabs(s->q[i]), falling_mu(&rc, v) * s->p[i], 1e-8 * model.problem.stress,
                  "friction of %d", i);
    }
    assert_true(slides > 3);
    CHECK_MAX(s->residual, 1e-10, "residual");
}

/* The residual that is told is that with the coefficients of the state, which a loose
 * tolerance shows. */
TEST(the_residual_is_that_of_the_law)
{
    double largest = 0.0;
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = falling_case(RB_STEADY, 0.2, 20.0);
        set(&rc, "creep-ratio %g tol 1e-3", 0.2 + 0.15 * k);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        rb_contact_violation v;
        CHECK_OK(rb_contact_residual(&model.problem, &model.state, &v));
        CHECK_ABS(model.state.residual, v.scaled, 1e-13, "residual");
        CHECK_MAX(v.scaled, 1e-3, "residual");
        largest = fmax(largest, v.scaled);
    }
    CHECK_MAX(1e-8, largest, "that a loose tolerance leaves");
}

/* Warm surfaces lose heat_range's part of `heat`. */
TEST(warm_elements_have_another_coefficient)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.0, 1.0);
    set(&rc, "creep-ratio 2 conductivity 40 heat-capacity 3.5 temperature 20 temperature-b 20");
    rc.friction.heat = -0.1;
    rc.friction.heat_from = 20.5;
    rc.friction.heat_range = 200.0;
    OWNED(rb_rolling_solution) s = solved(&rc);
    for (int i = 0; i < s.n; i++) {
        const double part = fmin(1.0, fmax(0.0, (s.temperature[i] - 20.5) / 200.0));
        if (s.zone[i] != RB_ZONE_SEPARATED)
            CHECK_ABS(s.mu[i], 0.2 - 0.1 * part, 1e-8, "element %d", i);
    }
    assert_true(s.max_temperature > 21.0);
    CHECK_MAX(s.residual, 1e-10, "residual");
}

/* The heat of earlier steps is gone with their history: who asks for the coefficients then is
 * told so. */
TEST(after_a_history_its_heat_is_unknown)
{
    rb_rolling_case rc = falling_case(RB_TRANSIENT, 0.0, 1.0);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) history;
    rb_sensitivity *s;
    set(&rc, "distance 0.5 steps 3 creep-ratio 2 conductivity 40 heat-capacity 3.5 temperature 20 "
             "temperature-b 20");
    rc.friction.heat = -0.1;
    rc.friction.heat_range = 200.0;
    CHECK_OK(rb_rolling_history_run(&rc, NULL, NULL, &model, &history, &message));
    CHECK_SAYS(rb_sensitivity_create(&model, 0, &s, &message), RB_EINVAL,
               "while their history runs");
    assert_null(s);
}

/* ---- Uniqueness -------------------------------------------------------------------- */

/* (F3) V max(-dmu/dv) times, steadily the largest p_i S_ii/e_T, in a step the largest
 * eigenvalue of S diag(p)/e_T, here by many more rounds. */
TEST(kappa_is_slope_times_answer)
{
    for (int steady = 0; steady < 2; steady++) {
        rb_rolling_case rc = falling_case(steady ? RB_STEADY : RB_TRANSIENT, 0.2, 20.0);
        OWNED(rb_rolling_model) model;
        OWNED(rb_rolling_solution) s;
        rc.creep_ratio = 0.5;
        CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, NULL));
        const int n = model.problem.n;
        const double *S = rb_contact_operator_matrix(model.problem.op).S;
        const double slope = rc.speed * 0.2 * log(2.0) / 20.0, *p = model.state.p;
        double largest = 0.0, kappa, v[100], w[100];
        for (int i = 0; i < n; i++) {
            v[i] = 1.0;
            largest = fmax(largest, steady ? p[i] * S[i + (n + i) * n] : 0.0);
        }
        for (int k = 0; k < 500 && !steady; k++) {
            for (int i = 0; i < n; i++) {
                w[i] = 0.0;
                for (int j = 0; j < n && p[i] > 0.0; j++)
                    w[i] += S[i + (n + j) * n] * p[j] * v[j];
            }
            largest = rb_norm_inf((size_t)n, w);
            for (int i = 0; i < n; i++)
                v[i] = w[i] / largest;
        }
        CHECK_OK(rb_rolling_law_kappa(&model, &kappa));
        CHECK_REL(kappa, slope * largest / model.problem.e_T[0], steady ? 1e-12 : 1e-6, "steady %d",
                  steady);
        CHECK_ABS(s.kappa, kappa, 0.0, "of the solution");
    }
}

/* ---- Forces ------------------------------------------------------------------------ */

static double force_at(rb_rolling_case rc, double creepage)
{
    set(&rc, "force nan force-ratio nan creep %g", creepage);
    OWNED(rb_rolling_solution) s = solved(&rc);
    return s.tangential_load;
}

/* Either direction, as a force or as a ratio, in steady rolling and in steps; from a few
 * dozen contact problems. */
TEST(forces_are_met_in_few_solves)
{
    static const double ratios[] = {-0.7, 0.35, 0.0, 0.05};
    for (int k = 0; k < 8; k++) {
        rb_rolling_case rc = falling_case(k % 2 ? RB_TRANSIENT : RB_STEADY, 0.1, 40.0);
        const double wanted = ratios[k / 2] * 0.3 * 500.0;
        if (k < 4)
            rc.force = wanted;
        else
            rc.force_ratio = ratios[k / 2];
        if (k % 2 && wanted == 0.0)
            continue;
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(s.tangential_load, wanted, 1e-7, "force %d", k);
        CHECK_ABS(s.force_ratio, s.tangential_load / (0.3 * 500.0), 1e-9, "ratio %d", k);
        CHECK_MAX(s.residual, 1e-10, "force %d", k);
        CHECK_MAX(s.iterations, 400, "solves for force %d", k);
        if (k % 2 == 0)
            CHECK_ABS(force_at(rc, s.creepage), wanted, 1e-6, "at its creepage, %d", k);
    }
}

/* To a tenth of the tolerance, which a loose one shows. */
TEST(forces_are_met_to_a_tenth_of_the_tolerance)
{
    double worst = 0.0;
    for (int k = 0; k < 25; k++) {
        rb_rolling_case rc = falling_case(RB_STEADY, 0.1, 40.0);
        set(&rc, "tol 1e-2 force %g", -5.0 * (k + 0.5));
        OWNED(rb_rolling_model) model = solved_model(&rc);
        const double capacity = rb_contact_capacity(&model.problem, &model.state);
        const double off = fabs(rb_rolling_model_force(&model) - rc.force);
        CHECK_MAX(off, 0.1 * rc.contact.tol * capacity, "force %g", rc.force);
        worst = fmax(worst, off / (rc.contact.tol * capacity));
    }
    CHECK_MAX(0.05, worst, "and not to much less");
}

/* The rising branch ends where Q is largest: a force beyond it is refused with that
 * maximum and its creepage. */
TEST(the_largest_force_is_that_of_a_scan)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.2, 4.0);
    rb_rolling_solution s;
    double largest = 0.0, place = 0.0, told = 0.0, at = 0.0;
    for (int k = 1; k <= 60; k++) {
        const double Q = -force_at(rc, 1e-4 * k);
        if (Q > largest) {
            largest = Q;
            place = 1e-4 * k;
        }
    }
    rc.force = -199.0;
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL);
    rb_rolling_solution_free(&s);
    const char *from = NOT_NULL(strstr(message.text, "the largest is "));
    assert_int_equal(sscanf(from, "the largest is %lg N/mm, at creepage %lg", &told, &at), 2);
    CHECK_REL(told, -largest, 5e-3, "largest force");
    CHECK_ABS(at, place, 1.5e-4, "its creepage");
    rc.force = 0.99 * told;
    s = solved(&rc);
    CHECK_REL(s.tangential_load, rc.force, 1e-7, "a little less is met");
    CHECK_MAX(s.creepage, at, "on the rising branch");
    rb_rolling_solution_free(&s);
}

/* The axle is driven by nothing: Q R = -M. */
TEST(a_free_axle_has_no_moment)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.1, 40.0);
    set(&rc, "relaxation-time 2e-4 relaxation-ratio 1 free-axle");
    OWNED(rb_rolling_solution) s = solved(&rc);
    CHECK_ABS(s.tangential_load, -s.resistance_moment / 50.0, 1e-7, "Q = -M/R");
    assert_true(s.resistance_moment > 0.0);
}

/* ---- Steep laws -------------------------------------------------------------------- */

/* The iteration turns back and forth, or leaves every solution: shorter steps and
 * Newton's method find one that satisfies the law. */
TEST(steep_laws_are_solved_in_few_steps)
{
    static const double scale[] = {4.0, 1.0, 0.4, 0.2};
    for (int k = 0; k < 4; k++)
        for (int steady = 0; steady < 2; steady++) {
            rb_rolling_case rc = falling_case(steady ? RB_STEADY : RB_TRANSIENT, 0.2, scale[k]);
            set(&rc, "creep-ratio 0.6 steps %d", steady ? 0 : 3);
            OWNED(rb_rolling_solution) s = solved(&rc);
            print_message("# kappa %g: %d iterations\n", s.kappa, s.iterations);
            CHECK_MAX(s.residual, 1e-10, "scale %g", scale[k]);
            CHECK_MAX(s.iterations, 150, "scale %g", scale[k]);
        }
}

/* Unlike bodies, kappa from 2.5 to 7.5: Newton's method, whose directions end as soon as
 * they have reduced the residual to a thousandth. */
TEST(newtons_method_needs_few_contact_problems)
{
    for (int k = 1; k <= 3; k += 2) {
        rb_rolling_case rc = with(falling_case(RB_STEADY, 0.12, 4.8 / k),
                                  "young %g poisson 0.28 radius 460 mu 0.18 load 3111.08 speed "
                                  "45000 creep -0.002 contact-elements 60 mesh fitted",
                                  2.0 * 82000.0 * 1.28);
        rc.elastic_b = 0;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        double kappa;
        CHECK_OK(rb_rolling_law_kappa(&model, &kappa));
        print_message("# kappa %g: %d iterations\n", kappa, model.iterations);
        assert_true(kappa > 2.0);
        CHECK_MAX(model.state.residual, 1e-10, "kappa %g", kappa);
        CHECK_MAX(model.iterations, k == 1 ? 1300 : 800, "kappa %g", kappa);
    }
}

/* ---- All solutions ----------------------------------------------------------------- */

TEST(all_solutions_of_one_are_one)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.1, 200.0);
    rb_rolling_solutions all;
    set(&rc, "contact-elements 12 creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    int touch = 0;
    for (int i = 0; i < model.state.n; i++)
        touch += model.state.p[i] > 0.0;
    CHECK_OK(rb_rolling_find_solutions(&model, &all, &message));
    assert_int_equal(all.n, 1);
    assert_int_equal(all.starts, touch + 1);
    assert_int_equal(all.failed, 0);
    rb_rolling_solutions_free(&all);
    model.problem.force_given = 1;
    CHECK_SAYS(rb_rolling_find_solutions(&model, &all, &message), RB_EINVAL,
               "not under a given force");
    model.problem.force_given = 0;
    for (int k = 0; k < 2; k++) {
        case_of_model(&model)->formulation = k ? RB_STEADY : RB_TRANSIENT;
        case_of_model(&model)->friction.fall[0] = k ? 0.0 : 0.1;
        CHECK_SAYS(rb_rolling_find_solutions(&model, &all, &message), RB_EINVAL,
                   "all solutions: only for steady rolling with");
    }
}

/* Starts that lead to no state within the tolerance are counted, and the others stay. */
TEST(starts_that_fail_are_counted)
{
    rb_rolling_case rc = falling_case(RB_STEADY, 0.1, 200.0);
    OWNED(rb_rolling_solutions) all;
    set(&rc, "contact-elements 6 creep-ratio 0.5");
    OWNED(rb_rolling_model) model = solved_model(&rc);
    case_of_model(&model)->contact.tol = 1e-300; /* rounding leaves more */
    model.problem.rounding = 0.0;
    CHECK_OK(rb_rolling_find_solutions(&model, &all, &message));
    assert_int_equal(all.n, 1);
    assert_true(all.starts > 1);
    assert_int_equal(all.failed, all.starts);
}

/* Each differs from the others, the largest force first, and is proven. */
TEST(several_solutions_are_told_apart)
{
    rb_rolling_case rc = with(falling_case(RB_STEADY, 0.2, 0.2), "creep-ratio 0.3");
    OWNED(rb_rolling_solutions) all;
    OWNED(rb_rolling_model) model = solved_model(&rc);
    CHECK_OK(rb_rolling_find_solutions(&model, &all, NULL));
    assert_true(all.n >= 2);
    for (int k = 0; k < all.n; k++) {
        CHECK_MAX(all.solution[k].residual, 1e-10, "solution %d", k);
        assert_true(k == 0 || fabs(all.solution[k].tangential_load) <=
                                  fabs(all.solution[k - 1].tangential_load));
        for (int j = 0; j < k; j++) {
            double difference = 0.0;
            for (int i = 0; i < model.state.n; i++)
                difference = fmax(difference, fabs(all.solution[k].q[i] - all.solution[j].q[i]));
            assert_true(difference > 1e-6 * 0.4 * model.problem.stress);
        }
    }
}

/* Friction that grows with the speed to twice its value at rest: the last of it would
 * take any speed, and a force of that much is refused with what a very large one brings. */
TEST(forces_that_only_great_speed_reaches_are_refused)
{
    rb_rolling_case rc = falling_case(RB_STEADY, -0.1, 40.0);
    OWNED(rb_rolling_solution) s;
    double told = 0.0, at = 0.0;
    set(&rc, "friction-law rational force %g", -100.0 * (1.0 - 1e-12));
    CHECK_STATUS(rb_rolling_solve(&rc, &s, &message), RB_EINVAL);
    const char *from = NOT_NULL(strstr(message.text, "the largest is "));
    assert_int_equal(sscanf(from, "the largest is %lg N/mm, at creepage %lg", &told, &at), 2);
    CHECK_MAX(1e3, at, "creepage");
    CHECK_REL(told, -500.0 * (0.2 - 0.1 / (1.0 + at * rc.speed / 40.0)), 1e-6,
              "everything slides at that speed");
}

/* ---- Newton's method by itself ----------------------------------------------------- */

/* Anywhere on the way to the largest force, which is refused in the end. */
TEST(the_way_to_a_force_may_have_no_memory)
{
    int refused = 0;
    for (int count = 40; count < 8000; count = count * 6 / 5) {
        rb_rolling_case rc = falling_case(RB_STEADY, 0.2, 4.0);
        OWNED(rb_rolling_solution) s;
        set(&rc, "contact-elements 8 force -199");
        alloc_fail_after(count);
        const rb_status status = rb_rolling_solve(&rc, &s, NULL);
        const int failed = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(status, failed ? RB_ENOMEM : RB_EINVAL);
        refused += failed;
    }
    assert_true(refused > 10);
}

TEST(kappa_of_no_pressure_is_nothing)
{
    rb_rolling_case rc = with(falling_case(RB_TRANSIENT, 0.2, 20.0), "creep-ratio 0.5");
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) s;
    double kappa;
    CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, NULL));
    memset(model.state.p, 0, (size_t)model.state.n * sizeof *model.state.p);
    CHECK_OK(rb_rolling_law_kappa(&model, &kappa));
    CHECK_ABS(kappa, 0.0, 0.0, "kappa");
}

/* The first step of rolling, with these coefficients to begin the iteration. */
static rb_rolling_solution first_step(const rb_rolling_case *rc, const rb_rolling_table *start)
{
    const double a = rb_rolling_derive(rc).half_width;
    rb_rolling_solution s;
    rb_message why = {.text = ""};
    if (rb_rolling_step_between(rc, -1.2 * a, 1.2 * a, NULL, start, rc->distance * a, &s, &why) !=
        RB_OK)
        fail_msg("%s", why.text);
    return s;
}

/* Where there is one solution, it does not depend on the start. */
TEST(steps_may_start_elsewhere)
{
    const double x[] = {-1.0, 1.0}, y[] = {0.2, 0.3};
    const rb_rolling_table start = {2, x, y};
    rb_rolling_case rc = with(falling_case(RB_TRANSIENT, 0.1, 200.0), "creep-ratio 0.5");
    OWNED(rb_rolling_solution) s = first_step(&rc, NULL), t = first_step(&rc, &start);
    CHECK_REL(t.tangential_load, s.tangential_load, 1e-8, "Q");
}

/* Where there are several, it does: little friction to begin with stays less. */
TEST(a_step_finds_the_solution_of_its_start)
{
    const double x[] = {-1.0, 1.0}, y[] = {0.2, 0.2};
    const rb_rolling_table start = {2, x, y};
    rb_rolling_case rc = with(falling_case(RB_TRANSIENT, 0.2, 0.05), "creep-ratio 2");
    OWNED(rb_rolling_solution) s = first_step(&rc, NULL), t = first_step(&rc, &start);
    CHECK_MAX(s.residual, 1e-10, "from rest");
    CHECK_MAX(t.residual, 1e-10, "from little friction");
    CHECK_MAX(-t.tangential_load, -0.995 * s.tangential_load, "-Q");
}

RUN_TESTS(NULL, NULL)
