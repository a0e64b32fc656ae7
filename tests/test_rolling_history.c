/* Sequences: Cattaneo to Carter, loading histories, bad programs, interruption. */
#include "check.h"
#include "cases.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static void run(const rb_rolling_case *rc, const rb_rolling_program *program,
                rb_rolling_model *model, rb_rolling_history *history)
{
    CHECK_OK(rb_rolling_history_run(rc, program, NULL, model, history, &message));
}

static void release(rb_rolling_model *model, rb_rolling_history *history)
{
    rb_rolling_model_free(model);
    rb_rolling_history_free(history);
}

/* CONTACT, n = 200, c = h (theory-solvers.md 6): distance/a, 1e4 |xi|. */
static const double contact_says[][2] = {{0.04, 1.214}, {0.1, 1.243}, {0.2, 1.298}, {0.4, 1.432},
                                         {0.6, 1.619},  {0.8, 2.027}, {1.0, 2.818}, {1.4, 2.393},
                                         {2.0, 2.371},  {3.0, 2.389}};

TEST(from_cattaneo_to_carter)
{
    rb_rolling_case rc = steel_wheel(200);
    rb_rolling_model model;
    rb_rolling_history h;
    set(&rc, "formulation transient force-ratio -0.64 distance 3");
    run(&rc, NULL, &model, &h);
    CHECK_REL(h.step / model.half_width, 0.01, 1e-9, "c = h");
    for (size_t j = 0; j < sizeof contact_says / sizeof *contact_says; j++) {
        int k = 0;
        while (k < h.n - 1 && h.distance[k] < contact_says[j][0] - 1e-9)
            k++;
        CHECK_REL(1e4 * h.creepage[k], contact_says[j][1], 1e-2, "distance %g", contact_says[j][0]);
    }
    for (int k = 0; k < h.n; k++) {
        CHECK_ABS(h.force_ratio[k], -0.64, 1e-10, "step %d", k);
        CHECK_MAX(h.residual[k], 1e-10, "step %d", k);
    }
    release(&model, &h);
}

/* Steps of other lengths than the element: the displacement is evaluated where the
 * particle was. */
TEST(other_steps_tell_the_same_story)
{
    rb_rolling_case rc = steel_wheel(100);
    rb_rolling_model model[2];
    rb_rolling_history h[2];
    set(&rc, "formulation transient force-ratio -0.64 distance 0.4");
    run(&rc, NULL, &model[0], &h[0]);
    rc.steps = 53;
    run(&rc, NULL, &model[1], &h[1]);
    assert_int_equal(h[1].n, 54);
    CHECK_REL(h[1].creepage[53], h[0].creepage[h[0].n - 1], 1e-2, "c other than h");
    release(&model[0], &h[0]);
    release(&model[1], &h[1]);
}

TEST(other_steps_on_a_wheel)
{
    rb_rolling_case rc = wheel_on_rail(RB_BEM_HUB, 60);
    rb_rolling_model model;
    rb_rolling_history h;
    double end[3];
    set(&rc, "formulation transient force-ratio -0.64 distance 1");
    for (int k = 0; k < 3; k++) {
        rc.steps = k == 0 ? 0 : 17 * (2 * k - 1) + 2; /* h, 1.6 h, 0.57 h */
        run(&rc, NULL, &model, &h);
        end[k] = h.creepage[h.n - 1];
        CHECK_MAX(h.residual[h.n - 1], 1e-10, "steps %d", rc.steps);
        release(&model, &h);
    }
    CHECK_REL(end[1], end[0], 3e-2, "longer");
    CHECK_REL(end[2], end[0], 3e-2, "shorter");
}

/* c = h: the limit is the steady state with the upstream difference, not merely near it. */
TEST(the_limit_is_the_steady_state)
{
    for (int dissimilar = 0; dissimilar < 2; dissimilar++) {
        rb_rolling_case rc = with(steel_wheel(40), "formulation transient creep 2e-4 distance 40");
        rb_rolling_model model;
        rb_rolling_history h;
        rc.elastic_b = !dissimilar;
        run(&rc, NULL, &model, &h);
        rc.formulation = RB_STEADY;
        OWNED(rb_rolling_solution) steady = solved(&rc);
        for (int i = 0; i < steady.n; i++)
            CHECK_ABS(model.state.q[i], steady.q[i], 1e-3 * rc.mu * steady.max_pressure,
                      "q, element %d", i);
        CHECK_ABS(h.force_ratio[h.n - 1], steady.force_ratio, 1e-4, "Q");
        assert_true(h.steady_from > 0 && h.steady_from < h.n);
        release(&model, &h);
    }
}

/* Without friction nothing changes from the first step that rolls on, behind the one at
 * rest. */
TEST(without_friction_all_of_it_is_steady)
{
    rb_rolling_case rc = with(steel_wheel(10), "formulation transient mu 0 distance 0.5");
    rb_rolling_model model;
    rb_rolling_history h;
    run(&rc, NULL, &model, &h);
    assert_true(h.n > 2);
    assert_int_equal(h.steady_from, 1);
    release(&model, &h);
}

/* Mindlin-Deresiewicz: loaded to Q1 and back to Q2, the friction is the sum of Cattaneo's
 * for Q1 and twice the negative of that for (Q1 - Q2)/2. */
TEST(unloading_follows_mindlin_and_deresiewicz)
{
    const double force[] = {0.0, 0.3, 0.6, 0.4, 0.2, 0.0, -0.1};
    rb_rolling_case rc = steel_wheel(200);
    const rb_rolling_program program = {.n = 7, .force_ratio = force};
    rb_rolling_model model;
    rb_rolling_history h;
    run(&rc, &program, &model, &h);
    assert_int_equal(h.n, 7);
    const double a = model.half_width, bound = rc.mu * 2.0 * rc.load / (M_PI * a);
    const double q1 = 0.6, q2 = -0.1;
    const double c1 = sqrt(1.0 - q1), c2 = sqrt(1.0 - 0.5 * (q1 - q2));
    double square = 0.0;
    for (int i = 0; i < model.mesh.n; i++) {
        const double x = model.bodies.f.x[i] / a;
        const double outer = sqrt(fmax(0.0, 1.0 - x * x));
        const double first = outer - sqrt(fmax(0.0, c1 * c1 - x * x));
        const double back = outer - sqrt(fmax(0.0, c2 * c2 - x * x));
        const double error = model.state.q[i] / bound - (first - 2.0 * back);
        square += error * error * model.bodies.f.h[i] / (2.0 * a);
    }
    CHECK_MAX(sqrt(square), 4e-3, "rms of q");
    for (int k = 0; k < h.n; k++)
        CHECK_ABS(h.force_ratio[k], force[k], 1e-10, "row %d", k + 1);
    release(&model, &h);
}

/* Load and force go to and fro: every second state is the one before the last, in which elements
 * are undecided between stick and slip, and on 60 elements Newton's method and Lemke's fail on the
 * force; the shift that has this force is found then. */
TEST(states_that_return_exactly_are_solved)
{
    const double load[] = {10.1067, 14.4382, 10.1067, 14.4382, 10.1067};
    const double force[] = {-0.82759, 0.58121, -0.82759, 0.58121, -0.82759};
    const rb_rolling_program program = {.n = 5, .load = load, .force = force};
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.young = rc.b.young = 66785.5;
    rc.a.poisson = rc.b.poisson = 0.4028;
    rc.a.radius = 29.517;
    rc.mu = 0.172;
    rc.elastic_b = 1;
    rc.increments = 1;
    for (rc.contact_elements = 56; rc.contact_elements <= 64; rc.contact_elements += 4) {
        rb_rolling_model model;
        rb_rolling_history h;
        run(&rc, &program, &model, &h);
        assert_int_equal(h.n, 5);
        for (int k = 0; k < 5; k++) {
            CHECK_MAX(h.residual[k], 1e-10, "%d elements, row %d", rc.contact_elements, k + 1);
            CHECK_REL(h.tangential_load[k], force[k], 1e-10, "row %d", k + 1);
        }
        for (int k = 2; k < 5; k++)
            CHECK_REL(h.shift[k], h.shift[k - 2], 1e-8, "shift of row %d", k + 1);
        release(&model, &h);
    }
}

/* The shift that a given force causes, given back as a shift, causes that force. */
TEST(shift_and_force_are_two_sides_of_one_history)
{
    const double force[] = {0.2, 0.5, 0.3}, load[] = {150.0, 178.0, 160.0};
    rb_rolling_case rc = with(steel_wheel(60), "load nan approach nan zone auto");
    rb_rolling_program program = {.n = 3, .force_ratio = force, .load = load};
    rb_rolling_model model;
    rb_rolling_history by_force, by_shift;
    run(&rc, &program, &model, &by_force);
    rb_rolling_model_free(&model);
    program.force_ratio = NULL;
    program.shift = by_force.shift;
    run(&rc, &program, &model, &by_shift);
    for (int k = 0; k < 3; k++) {
        CHECK_ABS(by_shift.force_ratio[k], force[k], 1e-9, "row %d", k + 1);
        CHECK_REL(by_shift.normal_load[k], load[k], 1e-10, "row %d", k + 1);
    }
    rb_rolling_history_free(&by_force);
    release(&model, &by_shift);
}

/* A load that grows on the way: at every step the given one. */
TEST(loads_vary_along_the_way)
{
    const double distance[] = {0.0, 1.0, 2.0}, load[] = {100.0, 178.0, 120.0},
                 creep[] = {1e-4, 2e-4, 1e-4};
    rb_rolling_case rc = with(steel_wheel(40), "formulation transient load nan zone auto");
    const rb_rolling_program program = {.n = 3, .distance = distance, .load = load, .creep = creep};
    rb_rolling_model model;
    rb_rolling_history h;
    run(&rc, &program, &model, &h);
    for (int k = 0; k < h.n; k++) {
        const double d = fmin(h.distance[k], 2.0);
        const double want = d <= 1.0 ? 100.0 + 78.0 * d : 178.0 - 58.0 * (d - 1.0);
        CHECK_REL(h.normal_load[k], want, 2e-2, "distance %g", d);
        const double middle = d - 0.5 * h.step / model.half_width;
        if (k > 0 && middle < 0.95) /* the mean over a step, not the value at its end */
            CHECK_REL(h.creepage[k], 1e-4 * (1.0 + middle), 1e-2, "distance %g", d);
    }
    release(&model, &h);
}

typedef struct {
    const char *word;
    rb_rolling_program program;
    rb_rolling_formulation formulation;
} bad_program;

TEST(bad_programs_name_the_row)
{
    static const double back[] = {0.0, 1.0, 0.5}, twice[] = {0.0, 1.0, 1.0},
                        hole[] = {1.0, NAN, 1.0}, negative[] = {1.0, 1.0, -1.0},
                        way[] = {0.0, 1.0, 2.0};
    const bad_program bad[] = {
        {"row 3: distance", {.n = 3, .distance = back}, RB_TRANSIENT},
        {"row 3: distance", {.n = 3, .distance = twice}, RB_TRANSIENT},
        {"row 2: load", {.n = 3, .load = hole}, RB_STATIC},
        {"row 3: load", {.n = 3, .load = negative}, RB_STATIC},
        {"row 1: shift", {.n = 3, .distance = way, .shift = way}, RB_TRANSIENT},
        {"row 3: force-ratio", {.n = 3, .force_ratio = way}, RB_STATIC}, /* 2 mu P */
        {"column distance", {.n = 3, .load = way + 1}, RB_TRANSIENT},
        {"1 row", {.n = 0, .load = way}, RB_STATIC},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = steel_wheel(20);
        rb_rolling_model model;
        rb_rolling_history h;
        rc.formulation = bad[k].formulation;
        CHECK_SAYS(rb_rolling_history_run(&rc, &bad[k].program, NULL, &model, &h, &message),
                   RB_EINVAL, bad[k].word);
        release(&model, &h);
    }
}

static int stop_at_five(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                        int steps, void *context)
{
    (void)model;
    (void)steps;
    *(int *)context = history->n;
    return step == 4;
}

TEST(an_interrupted_run_keeps_its_steps)
{
    rb_rolling_case rc = with(steel_wheel(20), "formulation transient creep 1e-4 distance 2");
    rb_rolling_model model;
    rb_rolling_history h;
    int counted = 0;
    CHECK_STATUS(rb_rolling_history_run(&rc, NULL, &(rb_rolling_observer){stop_at_five, &counted},
                                        &model, &h, &message),
                 RB_INTERRUPTED);
    assert_int_equal(counted, 5);
    assert_int_equal(h.n, 5);
    assert_true(h.normal_load[4] > 0.0);
    release(&model, &h);
}

/* The truth: four times as many elements and steps.  The elements do not end at the edges
 * of the contact. */
static void count_history(double creep, double force_ratio, double zone, tally *of_force,
                          tally *of_creepage)
{
    rb_rolling_case rc = steel_wheel(60), finer = steel_wheel(240);
    rb_rolling_model model;
    rb_rolling_history h, truth;
    rc.zone = finer.zone = zone * rb_rolling_hertz_half_width(&rc, rc.load);
    finer.contact_elements = 4 * rc.contact_elements;
    set(&rc, "creep %g force-ratio %g distance 2", creep, force_ratio);
    set(&finer, "creep %g force-ratio %g distance 2", creep, force_ratio);
    rc.formulation = finer.formulation = RB_TRANSIENT;
    CHECK_OK(rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &h, NULL));
    rb_rolling_model_free(&model);
    assert_int_equal(h.errors->n, h.n);
    finer.steps = 4 * (h.n - 1);
    run(&finer, NULL, &model, &truth);
    for (int k = 1; k < h.n && 4 * k < truth.n; k++) {
        const double *xi = truth.creepage + 4 * k - 3;
        tally_count(of_force, h.force_ratio[k] - truth.force_ratio[4 * k],
                    h.errors->force_ratio[k]);
        tally_count(of_creepage, 1e4 * (h.creepage[k] - 0.25 * (xi[0] + xi[1] + xi[2] + xi[3])),
                    1e4 * h.errors->creepage[k]);
    }
    rb_rolling_history_free(&truth);
    release(&model, &h);
}

/* Steps and elements err against each other and partly cancel, in the spread less than in
 * the error: the bars are about eleven times too wide in the median. */
TEST(error_bars_hold_finer_runs)
{
    /* five spreads, as 200 random cases need; 15 was that of three */
    tally of_force = {.wide = 25.0}, of_creepage = {.wide = 25.0};
    for (int k = 1; k <= 4; k++) {
        count_history(1e-4 * k, NAN, 1.06 + 0.067 * k, &of_force, &of_creepage);
        count_history(NAN, -0.2 * k, 1.06 + 0.067 * k, &of_force, &of_creepage);
    }
    tally_check(&of_force, "force");
    tally_check(&of_creepage, "creepage");
}

/* Static increments: no steps, the same rows on all meshes. */
TEST(error_bars_hold_mindlin)
{
    const double force[] = {0.3, 0.6, 0.9, 0.4, -0.2};
    const rb_rolling_program program = {.n = 5, .force_ratio = force};
    rb_rolling_case rc = steel_wheel(60), finer = steel_wheel(240);
    rb_rolling_model model;
    rb_rolling_history h, truth;
    rc.zone = finer.zone = 1.17 * rb_rolling_hertz_half_width(&rc, rc.load);
    run(&finer, &program, &model, &truth);
    rb_rolling_model_free(&model);
    CHECK_OK(rb_rolling_history_with_errors(&rc, &program, NULL, &model, &h, NULL));
    for (int k = 0; k < 5; k++) {
        const double unit = rc.mu * model.half_width * model.half_width / rc.a.radius;
        CHECK_MAX(fabs(h.shift[k] - truth.shift[k]) / unit, h.errors->shift[k] / unit, "row %d",
                  k + 1);
        CHECK_MAX(h.errors->shift[k] / unit, 0.02, "of a shift of 1");
        CHECK_MAX(h.errors->force_ratio[k], 1e-12, "a given force has no error");
    }
    rb_rolling_history_free(&truth);
    release(&model, &h);
}

static int stop_in_companion(const rb_rolling_model *model, const rb_rolling_history *history,
                             int step, int steps, void *context)
{
    (void)history;
    (void)steps;
    (void)context;
    return !model && step == 1;
}

TEST(companions_can_be_interrupted)
{
    rb_rolling_case rc = with(steel_wheel(20), "formulation transient creep 1e-4 distance 1");
    rb_rolling_model model;
    rb_rolling_history h;
    CHECK_STATUS(rb_rolling_history_with_errors(
                     &rc, NULL, &(rb_rolling_observer){stop_in_companion, NULL}, &model, &h, NULL),
                 RB_INTERRUPTED);
    assert_int_equal(h.n, 11); /* the run itself is complete */
    assert_null(h.errors);
    release(&model, &h);
}

TEST(every_failed_allocation_is_reported)
{
    rb_rolling_case rc = steel_wheel(12);
    set(&rc, "formulation transient creep 1e-4 distance 0.5 steps 2");
    for (int count = 0, refused = 1; refused; count++) {
        rb_rolling_model model;
        rb_rolling_history h;
        refused =
            REFUSED_FROM(count, rb_rolling_history_with_errors(&rc, NULL, NULL, &model, &h, NULL));
        release(&model, &h);
    }
}

/* ---- Refusals and starts ----------------------------------------------------------- */

TEST(ways_that_lead_nowhere_are_refused)
{
    static const double distance[] = {0.0, -1.0, NAN, 1e8};
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = steel_wheel(20);
        rb_rolling_model model;
        rb_rolling_history h;
        set(&rc, "formulation transient creep 1e-4");
        rc.distance = distance[k];
        CHECK_SAYS(rb_rolling_history_run(&rc, NULL, NULL, &model, &h, &message), RB_EINVAL,
                   k == 0  ? "distance: expected > 0, got 0"
                   : k < 3 ? "distance: expected a number > 0"
                           : "expected at most 1e+07");
        assert_int_equal(h.n, 0);
        release(&model, &h);
    }
}

/* Keeps the states of a run, which follow it to the same history; what does not fit is
 * refused. */
static int keep_state(const rb_rolling_model *model, const rb_rolling_history *history, int step,
                      int steps, void *context)
{
    CHECK_OK(rb_rolling_states_keep(model, history, step, steps, context));
    return 0;
}

/* A history whose states are kept. */
static void run_recorded(const rb_rolling_case *rc, rb_rolling_states *states,
                         rb_rolling_model *model, rb_rolling_history *h)
{
    const rb_rolling_observer observer = {keep_state, states};
    CHECK_OK(rb_rolling_history_run(rc, NULL, &observer, model, h, &message));
}

TEST(states_are_followed_to_the_same_history)
{
    rb_rolling_case rc = steel_wheel(20);
    OWNED(rb_rolling_states) states = {0};
    rb_rolling_model model, again;
    rb_rolling_history h, followed;
    set(&rc, "formulation transient creep 1e-4 distance 0.5 increments 2");
    run_recorded(&rc, &states, &model, &h);
    CHECK_SAYS(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message),
               RB_EINVAL, "half-width 0: expected > 0");
    release(&again, &followed);
    states.half_width = h.half_width;
    CHECK_OK(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message));
    assert_int_equal(followed.n, h.n);
    for (int k = 0; k < h.n; k++) {
        CHECK_ABS(followed.distance[k], h.distance[k], 1e-13, "distance of step %d", k);
        CHECK_REL(followed.normal_load[k], h.normal_load[k], 1e-13, "P of step %d", k);
        CHECK_ABS(followed.tangential_load[k], h.tangential_load[k], 1e-13, "Q of step %d", k);
        CHECK_ABS(followed.creepage[k], h.creepage[k], 1e-15, "xi of step %d", k);
        CHECK_ABS(followed.approach[k], h.approach[k], 0.0, "approach of step %d", k);
        CHECK_ABS(followed.dissipation[k], h.dissipation[k], 1e-12, "power of %d", k);
        CHECK_MAX(followed.residual[k], 1e-9, "residual of step %d", k);
        assert_int_equal(followed.stick[k], h.stick[k]);
    }
    release(&again, &followed);
    states.p[(states.steps - 1) * states.n + states.n / 2] *= 1.01;
    CHECK_OK(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message));
    CHECK_MAX(1e-4, followed.residual[h.n - 1], "a changed state");
    CHECK_MAX(followed.residual[h.n - 2], 1e-9, "the state before");
    release(&again, &followed);
    states.steps--;
    CHECK_SAYS(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message),
               RB_EINVAL, "steps, the program has");
    release(&again, &followed);
    release(&model, &h);
}

/* Interfaces that yield and laws with memory: what the particles carry follows from the states,
 * and coefficients of another law or what yields elsewhere leave a residual. */
TEST(states_bring_what_particles_carry)
{
    for (int k = 0; k < 2; k++) {
        OWNED(rb_rolling_states) states = {0};
        rb_rolling_case rc = with(steel_wheel(20), "formulation transient creep 2e-3 distance 1");
        rb_rolling_model model, again;
        rb_rolling_history h, followed;
        if (k == 0) {
            set(&rc, "yield-stress 8 hardening 20000 interlayer-tangential 3e-6");
        } else {
            set(&rc, "speed 3000 friction-law rational mu-fall 0.1 slip-scale 20");
            rc.friction.memory = 0.002;
            rc.friction.memory_slip = 1.0;
        }
        run_recorded(&rc, &states, &model, &h);
        states.half_width = h.half_width;
        CHECK_OK(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message));
        for (int step = 0; step < h.n; step++) {
            CHECK_MAX(followed.residual[step], 1e-9, "residual of step %d", step);
            CHECK_REL(followed.dissipation[step], h.dissipation[step], 1e-9, "power of %d", step);
        }
        release(&again, &followed);
        if (k == 0)
            rc.hardening *= 1.01;
        else
            rc.friction.memory *= 1.01;
        CHECK_OK(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message));
        CHECK_MAX(1e-6, followed.residual[h.n - 1], "another state variable");
        release(&again, &followed);
        release(&model, &h);
    }
}

/* A ratio refers to the load, which a given approach finds: with the states' own loads
 * they follow it, and a creepage that is another one is seen. */
TEST(states_of_a_ratio_are_followed)
{
    rb_rolling_case rc = with(steel_wheel(20), "formulation transient load nan approach 6e-3");
    OWNED(rb_rolling_states) states = {0};
    rb_rolling_model model, again;
    rb_rolling_history h, followed;
    rc.b.young *= 0.5; /* dissimilar: the load changes on the way */
    set(&rc, "creep-ratio 0.5 distance 0.5");
    rc.zone *= 2.0;
    run_recorded(&rc, &states, &model, &h);
    states.half_width = h.half_width;
    for (int k = 0; k < 2; k++) {
        const double creepage = states.xi[states.steps - 1];
        CHECK_OK(rb_rolling_history_follow(&rc, &states, NULL, &again, &followed, &message));
        CHECK_ABS(followed.creepage[h.n - 1], creepage, 1e-15, "creepage");
        CHECK_REL(again.problem.xi, model.problem.xi, 1e-12, "the wanted one");
        if (k == 0)
            CHECK_MAX(followed.residual[h.n - 1], 1e-9, "residual");
        else
            CHECK_MAX(1e-5, followed.residual[h.n - 1], "another creepage");
        release(&again, &followed);
        states.xi[states.steps - 1] *= 1.001;
    }
    release(&model, &h);
}

/* With the coefficient of its row a force may be too large: at rest as on the way. */
TEST(a_row_s_friction_bounds_its_force)
{
    rb_rolling_case rc = steel_wheel(20);
    rb_rolling_model model;
    rb_rolling_history h;
    const double mu[] = {0.3, 0.1}, force[] = {0.2 * rc.load, 0.2 * rc.load};
    const rb_rolling_program program = {.n = 2, .mu = mu, .force = force};
    rc.formulation = RB_STATIC;
    CHECK_SAYS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL,
               "row 2");
    release(&model, &h);
}

/* Friction and force are linear between the rows of a time, what friction holds is not. */
TEST(friction_between_rows_bounds_the_force)
{
    rb_rolling_case rc = steel_wheel(12);
    rb_rolling_model model;
    rb_rolling_history h;
    const double P = rc.load, mu[] = {0.1, 0.9}, load[] = {0.1 * P, 0.9 * P},
                 force[] = {0.009 * P, 0.8 * P}, time[] = {0.0, 1.0};
    const rb_rolling_program program = {
        .n = 2, .time = time, .mu = mu, .load = load, .force = force};
    set(&rc, "formulation static time-step 0.25 relaxation-time 1 relaxation-ratio 1");
    CHECK_STATUS(rb_rolling_history_run(&rc, &program, NULL, &model, &h, &message), RB_EINVAL);
    print_message("%s\n", message.text);
    assert_true(h.n > 0);
    release(&model, &h);
}

RUN_TESTS(NULL, NULL)
