/* What a sequence of steps must have in common with a single case, where it ends, what
 * its columns say, and what rides through the contact. */
#include "cases.h"
#include "check.h"
#include "rolling/rolling.h"

static const rb_bem_support supports[] = {RB_BEM_ARC, RB_BEM_HUB, RB_BEM_HALFPLANE};
enum { KINDS = 12 };

/* Support, body B and normal control of the k-th kind of case. */
static rb_rolling_case kind_of_case(int k)
{
    rb_rolling_case rc = rolling_case("gap parabola");
    rc.a.support = supports[k % 3];
    rc.elastic_b = k / 3 % 2;
    rc.b.young = 70000.0;
    set(&rc, "poisson-b 0.33 contact-elements 30 zone 2");
    if (k < KINDS / 2)
        rc.load = 1000.0;
    else
        rc.approach = 0.03;
    return rc;
}

static void run(const rb_rolling_case *rc, const rb_rolling_program *program,
                rb_rolling_model *model, rb_rolling_history *h)
{
    CHECK_OK(rb_rolling_history_run(rc, program, NULL, model, h, &message));
}

static void release(rb_rolling_model *model, rb_rolling_history *h)
{
    rb_rolling_model_free(model);
    rb_rolling_history_free(h);
}

static void solve_steps(const rb_rolling_case *rc, rb_rolling_solution *s)
{
    CHECK_OK(rb_rolling_solve(rc, s, &message));
}

static void check_same(const rb_rolling_solution *a, const rb_rolling_solution *b, int k)
{
    const double p0 = b->max_pressure;

    assert_int_equal(a->n, b->n);
    assert_int_equal(a->formulation, b->formulation);
    for (int i = 0; i < a->n; i++) {
        CHECK_ABS(a->p[i], b->p[i], 1e-9 * p0, "kind %d: p, element %d", k, i);
        CHECK_ABS(a->q[i], b->q[i], 1e-9 * p0, "kind %d: q, element %d", k, i);
        CHECK_ABS(a->slip[i], b->slip[i], 1e-10, "kind %d: slip, element %d", k, i);
        assert_int_equal(a->zone[i], b->zone[i]);
    }
    CHECK_REL(a->tangential_shift, b->tangential_shift, 1e-8, "kind %d: shift", k);
    CHECK_REL(a->creepage, b->creepage, 1e-9, "kind %d: creepage of (12)", k);
    CHECK_REL(a->creep_ratio, b->creep_ratio, 1e-9, "kind %d: its ratio", k);
    CHECK_REL(a->normal_load, b->normal_load, 1e-9, "kind %d: P", k);
}

/* Static contact, a static history of one row and a transient that stays at rest are one
 * problem; the creepage enters (12) in all of them. */
TEST(one_step_at_rest_is_a_static_case)
{
    static const double start[] = {0.0}, force[] = {0.4};
    for (int k = 0; k < KINDS; k++)
        for (int by_force = 0; by_force < 2; by_force++) {
            rb_rolling_case rc = with(kind_of_case(k), "creep-ratio 0.5 increments 1");
            rb_rolling_model model;
            rb_rolling_history h;
            rb_rolling_solution single, step;
            rb_rolling_case one = rc;
            if (by_force)
                one.force_ratio = 0.4;
            else
                one.shift = 1e-3;
            solve_steps(&one, &single);
            const rb_rolling_program row = {.n = 1,
                                            .force_ratio = by_force ? force : NULL,
                                            .shift = by_force ? NULL : &one.shift};
            run(&rc, &row, &model, &h);
            CHECK_OK(rb_rolling_model_solution(&model, &step, NULL));
            check_same(&step, &single, k);
            rb_rolling_solution_free(&step);
            release(&model, &h);
            if (by_force) {
                const rb_rolling_program rest = {.n = 1, .distance = start, .force_ratio = force};
                rc.creep_ratio = NAN; /* in rolling a force stands in its place */
                one.creep_ratio = NAN;
                rb_rolling_solution_free(&single);
                solve_steps(&one, &single);
                rc.formulation = RB_TRANSIENT;
                run(&rc, &rest, &model, &h);
                CHECK_OK(rb_rolling_model_solution(&model, &step, NULL));
                single.creepage = step.creepage = 1.0; /* there is none */
                single.creep_ratio = step.creep_ratio = 1.0;
                check_same(&step, &single, k);
                rb_rolling_solution_free(&step);
                release(&model, &h);
            }
            rb_rolling_solution_free(&single);
        }
}

/* The shift of a history is the whole one, in its column and in the solution. */
TEST(shifts_add_up)
{
    const double shift[] = {1e-3, 3e-3, 4e-3};
    const rb_rolling_program program = {.n = 3, .shift = shift};
    for (int k = 0; k < KINDS; k++) {
        const rb_rolling_case rc = kind_of_case(k);
        rb_rolling_model model;
        rb_rolling_history h;
        OWNED(rb_rolling_solution) s;
        run(&rc, &program, &model, &h);
        CHECK_OK(rb_rolling_model_solution(&model, &s, NULL));
        for (int i = 0; i < 3; i++)
            CHECK_REL(h.shift[i], shift[i], 1e-12, "kind %d, row %d", k, i + 1);
        CHECK_REL(s.tangential_shift, shift[2], 1e-12, "kind %d", k);
        release(&model, &h);
    }
}

/* ---- Pressing in increments -------------------------------------------------------- */

/* Steel on a rigid plane, half-plane: beta/mu = 0.952. */
static rb_rolling_case spence(int elements)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);

    set(&rc, "young 209920 poisson 0.3 gap parabola load 100");
    return rc;
}

/* Half-width of the stick of the state over that of its contact; an element that is half
 * on either side counts by the place where |q| and mu p cross. */
static double stick_part(const rb_rolling_model *model)
{
    const rb_contact_state *state = &model->state;
    double stick = 0.0, contact = 0.0;

    for (int i = 0; i < state->n; i++) {
        stick += state->zone[i] == RB_ZONE_STICK ? model->bodies.f.h[i] : 0.0;
        contact += state->zone[i] != RB_ZONE_SEPARATED ? model->bodies.f.h[i] : 0.0;
    }
    return stick / contact;
}

typedef struct {
    double first, last; /* stick over contact in the second half of the increments */
    double least, most;
} spread;

static int watch_stick(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                       int steps, void *context)
{
    spread *s = context;
    const double c = stick_part(model);

    (void)h;
    if (step == 0)
        s->first = c;
    if (step >= steps / 2) {
        s->least = fmin(s->least, c);
        s->most = fmax(s->most, c);
    }
    s->last = c;
    return 0;
}

/* Spence: the rate of the tractions under a load that grows on a parabola is that of a
 * flat punch as wide as the contact of the moment, and of that one step is enough because
 * its contact does not grow.  So the stick of the flat punch is that of the parabola, and
 * it does not depend on the load. */
static double stick_under_a_flat_punch(int elements)
{
    const rb_rolling_case rc = spence(elements);
    rb_rolling_mesh mesh;
    OWNED(rb_rolling_model) model;

    CHECK_OK(rb_rolling_model_begin(&rc, NULL, &model, NULL));
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -0.1, 0.1, &mesh, NULL));
    memset(mesh.gap, 0, (size_t)mesh.n * sizeof(double));
    model.mesh = mesh;
    CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &model.bodies, NULL));
    CHECK_OK(rb_rolling_problem_create(&rc, &mesh, &model.bodies, NULL, &model.problem, NULL));
    CHECK_OK(rb_contact_state_alloc(mesh.n, &model.state));
    CHECK_OK(rb_rolling_problem_solve(&model.problem, &rc, 0, &model.state, NULL));
    return stick_part(&model);
}

TEST(increments_press_as_spence)
{
    rb_rolling_case rc = spence(400);
    rb_rolling_model model;
    rb_rolling_history h;
    spread s = {.least = 1.0};
    const double punch = stick_under_a_flat_punch(400);

    CHECK_OK(rb_rolling_model_create(&rc, &model, NULL));
    CHECK_ABS(stick_part(&model), 0.298, 0.01, "in one step");
    rb_rolling_model_free(&model);
    rc.increments = 60;
    CHECK_OK(rb_rolling_history_run(&rc, NULL, &(rb_rolling_observer){watch_stick, &s}, &model, &h,
                                    NULL));
    assert_int_equal(h.n, 60);
    CHECK_ABS(s.last, punch, 0.01, "the flat punch");
    CHECK_ABS(s.last, 0.687, 0.01, "in increments");
    CHECK_MAX(s.most - s.least, 0.03, "at all loads");
    for (int k = 0; k < h.n; k++)
        CHECK_REL(h.normal_load[k], 100.0 * (k + 1) / 60, 1e-10, "row %d", k + 1);
    release(&model, &h);
}

/* After pressing as many increments of shift or force lead to what the case asks for. */
TEST(increments_end_where_the_case_says)
{
    for (int k = 0; k < KINDS; k++)
        for (int by_force = 0; by_force < 2; by_force++) {
            rb_rolling_case rc = kind_of_case(k);
            OWNED(rb_rolling_solution) s;
            set(&rc, "increments 4 zone auto shift %g force-ratio %g", by_force ? NAN : 2e-3,
                by_force ? -0.3 : NAN);
            solve_steps(&rc, &s);
            if (k < KINDS / 2)
                CHECK_REL(s.normal_load, rc.load, 1e-9, "kind %d: P", k);
            else
                CHECK_REL(s.approach, rc.approach, 1e-12, "kind %d: approach", k);
            if (by_force)
                CHECK_REL(s.force_ratio, -0.3, 1e-9, "kind %d: Q/(mu P)", k);
            else
                CHECK_REL(s.tangential_shift, 2e-3, 1e-12, "kind %d: shift", k);
            assert_int_equal(s.formulation, RB_STATIC);
        }
}

static int count_steps(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                       int steps, void *context)
{
    (void)step;
    (void)steps;
    if (model && h->distance[h->n - 1] == 0.0)
        ++*(int *)context;
    return 0;
}

/* Similar bodies do not care how they are pressed (their pressure causes no slip), and a
 * transient presses as a static case does. */
TEST(similar_bodies_press_at_once)
{
    rb_rolling_case rc = spence(40);
    OWNED(rb_rolling_solution) one, many;
    rb_rolling_model model;
    rb_rolling_history h;
    int at_rest = 0;

    rc.elastic_b = 1;
    rc.b = rc.a;
    set(&rc, "radius-b plane force-ratio 0.5");
    solve_steps(&rc, &one);
    rc.increments = 5;
    solve_steps(&rc, &many);
    for (int i = 0; i < one.n; i++)
        CHECK_ABS(many.q[i], one.q[i], 1e-9 * one.max_pressure, "q, element %d", i);
    set(&rc, "formulation transient distance 0.5");
    CHECK_OK(rb_rolling_history_run(&rc, NULL, &(rb_rolling_observer){count_steps, &at_rest},
                                    &model, &h, NULL));
    assert_int_equal(at_rest, 10);
    CHECK_REL(h.distance[h.n - 1], 0.5, 1e-15, "rolled");
    release(&model, &h);
}

/* ---- Where a history ends ---------------------------------------------------------- */

TEST(histories_end_on_their_last_row)
{
    static const double distance[] = {0.0, 1.0, 2.0}, up_and_down[] = {100.0, 400.0, 100.0},
                        force[] = {0.0, 0.5, 0.5}, away[] = {0.0, 2.0}, let_go[] = {100.0, 0.01},
                        pulled[] = {0.0, 0.5};
    const rb_rolling_program programs[] = {
        {.n = 3, .distance = distance, .load = up_and_down, .force_ratio = force},
        {.n = 2, .distance = away, .load = let_go, .force_ratio = pulled}};
    for (int j = 0; j < 2; j++)
        for (int k = 0; k < 6; k++) {
            rb_rolling_case rc = kind_of_case(k);
            rb_rolling_model model;
            rb_rolling_history h;
            set(&rc, "formulation transient load nan zone auto contact-elements 60");
            run(&rc, &programs[j], &model, &h);
            const int last = h.n - 1, row = programs[j].n - 1;
            assert_true(h.distance[last] == 2.0);
            CHECK_REL(h.normal_load[last], programs[j].load[row], 1e-9, "P");
            CHECK_REL(h.force_ratio[last], 0.5, 1e-9, "Q/(mu P)");
            for (int i = 0; i < h.n; i++) {
                CHECK_MAX(h.normal_load[i], 400.0 * (1.0 + 1e-12), "no load is beyond");
                assert_true(isfinite(h.force_ratio[i]));
            }
            release(&model, &h);
        }
}

/* Under a given force the last creepage does not jump with the place where the way ends. */
TEST(the_last_creepage_is_one_of_many)
{
    rb_rolling_case rc = spence(50);
    double end[5];

    rc.elastic_b = 1;
    rc.b = rc.a;
    rc.b.radius = INFINITY;
    set(&rc, "zone %g formulation transient force-ratio -0.64",
        1.25 * rb_rolling_hertz_half_width(&rc, rc.load));
    for (int k = 0; k < 5; k++) {
        rb_rolling_model model;
        rb_rolling_history h;
        rc.distance = 1.3 + 0.012 * k;
        run(&rc, NULL, &model, &h);
        CHECK_MAX(h.step, model.bodies.f.h[0] * (1.0 + 1e-9), "at most an element");
        end[k] = h.creepage[h.n - 1];
        CHECK_REL(end[k], end[0], 0.02, "distance %g", rc.distance);
        release(&model, &h);
    }
}

/* A creepage ratio refers to the load of the step, which a given approach only brings. */
TEST(ratios_refer_to_the_load_of_the_step)
{
    for (int k = KINDS / 2; k < KINDS; k++) {
        rb_rolling_case rc = kind_of_case(k);
        rb_rolling_model model;
        rb_rolling_history h;
        OWNED(rb_rolling_solution) s;
        set(&rc, "formulation transient creep-ratio 0.4 distance 0.3");
        run(&rc, NULL, &model, &h);
        CHECK_OK(rb_rolling_model_solution(&model, &s, NULL));
        CHECK_REL(s.creep_ratio, 0.4, 1e-9, "kind %d", k);
        release(&model, &h);
    }
}

/* ---- Columns ----------------------------------------------------------------------- */

TEST(columns_are_those_of_the_solution)
{
    for (int k = 0; k < KINDS; k++) {
        rb_rolling_case rc = with(kind_of_case(k), "formulation transient creep 2e-3 distance 0.7");
        rb_rolling_model model;
        rb_rolling_history h;
        OWNED(rb_rolling_solution) s;
        double moment = 0.0;
        run(&rc, NULL, &model, &h);
        CHECK_OK(rb_rolling_model_solution(&model, &s, NULL));
        const int last = h.n - 1;
        for (int i = 0; i < s.n; i++)
            moment += s.x[i] * s.p[i] * s.h[i];
        CHECK_REL(h.moment[last], moment, 1e-12, "kind %d: moment", k);
        CHECK_REL(h.max_pressure[last], s.max_pressure, 1e-12, "kind %d: p0", k);
        CHECK_REL(h.contact_from[last], s.contact_from, 1e-12, "kind %d: from", k);
        CHECK_REL(h.contact_to[last], s.contact_to, 1e-12, "kind %d: to", k);
        CHECK_REL(h.dissipation[last], s.dissipation, 1e-12, "kind %d: power", k);
        assert_true(h.dissipation[0] == 0.0 && h.creepage[0] == 0.0);
        release(&model, &h);
    }
}

/* In a steady state D = -xi Q + (1/R) int x p dx (theory-solvers.md 6). */
TEST(power_and_moment_balance_when_steady)
{
    rb_rolling_case rc = with(spence(160), "formulation transient creep 1e-3 distance 12");
    rb_rolling_model model;
    rb_rolling_history h;

    run(&rc, NULL, &model, &h);
    const int last = h.n - 1;
    assert_true(h.steady_from > 0);
    CHECK_REL(h.dissipation[last],
              -h.creepage[last] * h.tangential_load[last] + h.moment[last] / rc.a.radius, 0.01,
              "energy");
    assert_true(h.moment[last] > 0.0);
    release(&model, &h);
}

/* ---- Irregular surfaces ------------------------------------------------------------ */

/* A round flat of depth d [mm] and half-length l around x. */
typedef struct {
    double x[21], gap[21];
} spot;

static spot make_spot(double x, double l, double d)
{
    spot s;
    for (int i = 0; i < 21; i++) {
        const double t = (i - 10) / 10.0;
        s.x[i] = x + l * t;
        s.gap[i] = i == 0 || i == 20 ? 0.0 : d * (1.0 - t * t) * (1.0 - t * t);
    }
    return s;
}

static rb_rolling_case with_spot(const rb_rolling_case *rc, const spot *s)
{
    rb_rolling_case other = *rc;
    other.irregularity.n = 21;
    other.irregularity.x = s->x;
    other.irregularity.y = s->gap;
    return other;
}

/* An irregularity of height 0 is none: the history comes to the steady state. */
TEST(nothing_passes_unnoticed)
{
    const spot flat = make_spot(0.3, 0.2, 0.0);
    for (int k = 0; k < KINDS; k++) {
        rb_rolling_case rc = kind_of_case(k);
        rb_rolling_model model[2];
        rb_rolling_history h[2];
        set(&rc, "formulation transient creep 3e-3 distance %g", k == 2 ? 8.0 : 1.0);
        const rb_rolling_case moving = with_spot(&rc, &flat);
        run(&rc, NULL, &model[0], &h[0]);
        run(&moving, NULL, &model[1], &h[1]);
        assert_int_equal(h[0].n, h[1].n);
        for (int i = 0; i < h[0].n; i++)
            CHECK_ABS(h[1].tangential_load[i], h[0].tangential_load[i], 1e-9 * h[0].normal_load[i],
                      "kind %d, step %d", k, i);
        if (k == 2) {
            OWNED(rb_rolling_solution) steady;
            rc.formulation = RB_STEADY;
            solve_steps(&rc, &steady);
            CHECK_REL(h[1].force_ratio[h[1].n - 1], steady.force_ratio, 3e-3, "steady");
        }
        release(&model[0], &h[0]);
        release(&model[1], &h[1]);
    }
}

/* Pressures of all steps, and of how many. */
typedef struct {
    double p[300][80];
    int n;
} film;

static int take(const rb_rolling_model *model, const rb_rolling_history *h, int step, int steps,
                void *context)
{
    film *f = context;

    (void)h;
    (void)steps;
    memcpy(f->p[step], model->state.p, (size_t)model->mesh.n * sizeof(double));
    f->n = step + 1;
    return step + 1 == 300;
}

/* A bump that lies before the contact rides through it from +x to -x, by the rolled
 * distance: there the pressure differs most from that without it, and what is behind it
 * is as before. */
TEST(a_bump_passes_from_front_to_back)
{
    static film smooth, bumpy;
    for (int k = 0; k < 6; k++) {
        rb_rolling_case rc = kind_of_case(k);
        const double start = 2.6;
        const spot bump = make_spot(start, 0.25, -5e-4);
        rb_rolling_model model[2];
        rb_rolling_history h[2];
        int inside = 0;
        set(&rc, "contact-elements 80 formulation transient creep 2e-3 distance 6");
        rb_rolling_case moving = with_spot(&rc, &bump);
        CHECK_OK(rb_rolling_history_run(&rc, NULL, &(rb_rolling_observer){take, &smooth}, &model[0],
                                        &h[0], NULL));
        CHECK_OK(rb_rolling_history_run(&moving, NULL, &(rb_rolling_observer){take, &bumpy},
                                        &model[1], &h[1], NULL));
        assert_int_equal(smooth.n, bumpy.n);
        for (int step = 0; step < bumpy.n; step++) {
            const double x = start - h[1].distance[step] * h[1].half_width;
            const double *p = bumpy.p[step], *q = smooth.p[step];
            int at = 0;
            for (int i = 1; i < 80; i++)
                at = p[i] - q[i] > p[at] - q[at] ? i : at;
            if (fabs(x) > 0.8 * h[1].half_width)
                continue;
            CHECK_ABS(model[1].bodies.f.x[at], x, 0.051, "kind %d, step %d", k, step);
            inside++;
        }
        assert_true(inside > 20);
        const int last = h[1].n - 1;
        CHECK_REL(h[1].max_pressure[last], h[0].max_pressure[last], 1e-3, "kind %d: p0 behind it",
                  k);
        release(&model[0], &h[0]);
        release(&model[1], &h[1]);
    }
}

/* A hole as wide as the contact and deeper than the approach: nothing touches for a
 * while, and a ratio to no load is no number, nor is it infinite. */
TEST(contact_may_be_lost_and_found)
{
    const spot hole = make_spot(9.0, 6.0, 0.5);
    for (int k = KINDS / 2; k < KINDS; k++) {
        rb_rolling_case rc = kind_of_case(k);
        rb_rolling_model model;
        rb_rolling_history h;
        int lost = 0;
        set(&rc, "formulation transient creep 1e-3 distance 28 steps 80");
        const rb_rolling_case moving = with_spot(&rc, &hole);
        run(&moving, NULL, &model, &h);
        for (int i = 0; i < h.n; i++) {
            assert_false(isinf(h.force_ratio[i]) || isinf(h.contact_to[i]));
            if (h.normal_load[i] > 0.0)
                continue;
            lost++;
            assert_true(isnan(h.force_ratio[i]) && isnan(h.contact_from[i]));
            assert_true(h.tangential_load[i] == 0.0 && h.max_pressure[i] == 0.0);
        }
        assert_true(lost > 5);
        CHECK_REL(h.normal_load[h.n - 1], h.normal_load[0], 0.02, "kind %d: found", k);
        release(&model, &h);
    }
}

static int find_widest(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                       int steps, void *context)
{
    double *widest = context;

    (void)h;
    (void)steps;
    *widest = step == 0 ? 0.0 : *widest;
    for (int i = 0; i < model->mesh.n; i++)
        if (model->state.p[i] > 0.0)
            *widest = fmax(*widest, fabs(model->bodies.f.x[i]));
    return 0;
}

/* A flat under a given load widens the contact beyond that at rest: an automatic zone
 * grows, a given one is refused with a line. */
TEST(zones_grow_with_what_passes)
{
    rb_rolling_case rc = with(spence(60), "formulation transient force-ratio 0 distance 12");
    const spot flat = make_spot(0.9, 0.45, 3e-3);
    rb_rolling_model model;
    rb_rolling_history h;
    double widest = 0.0;

    rb_rolling_case moving = with_spot(&rc, &flat);
    CHECK_OK(rb_rolling_history_run(&moving, NULL, &(rb_rolling_observer){find_widest, &widest},
                                    &model, &h, NULL));
    const double a = h.half_width;
    CHECK_MAX(1.7 * a, widest, "a wide contact");
    CHECK_MAX(widest, model.mesh.ends[model.mesh.n], "in the zone");
    assert_true(h.distance[h.n - 1] == 12.0);
    release(&model, &h);
    moving.zone = 1.3 * a;
    CHECK_SAYS(rb_rolling_history_run(&moving, NULL, NULL, &model, &h, &message), RB_ZONE,
               "widen the zone");
    release(&model, &h);
}

TEST(bad_irregularities_are_refused)
{
    static const double x[] = {0.0, 1.0, 2.0}, back[] = {0.0, 1.0, 1.0}, open[] = {0.0, 1.0, 0.5},
                        closed[] = {0.0, 1.0, 0.0}, hole[] = {0.0, NAN, 0.0};
    const struct {
        const char *word;
        rb_rolling_formulation formulation;
        int n;
        const double *x, *gap;
    } bad[] = {{"needs 3 points", RB_TRANSIENT, 2, x, closed},
               {"row 3: expected an x larger", RB_TRANSIENT, 3, back, closed},
               {"row 3: expected gap 0", RB_TRANSIENT, 3, x, open},
               {"row 2: not a finite", RB_TRANSIENT, 3, x, hole},
               {"transient", RB_STEADY, 3, x, closed}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = kind_of_case(0);
        rc.formulation = bad[k].formulation;
        rc.irregularity.n = bad[k].n;
        rc.irregularity.x = bad[k].x;
        rc.irregularity.y = bad[k].gap;
        CHECK_SAYS(rb_rolling_case_check(&rc, &message), RB_EINVAL, bad[k].word);
    }
}

TEST(every_failed_allocation_is_reported)
{
    const spot bump = make_spot(0.3, 0.2, -1e-4);
    rb_rolling_case rc = kind_of_case(2);

    set(&rc, "contact-elements 12 formulation transient increments 2 force-ratio 0.3 distance 0.4");
    const rb_rolling_case moving = with_spot(&rc, &bump);
    for (int count = 0, refused = 1; refused; count++) {
        rb_rolling_model model;
        rb_rolling_history h;
        refused =
            REFUSED_FROM(count, rb_rolling_history_run(&moving, NULL, NULL, &model, &h, NULL));
        release(&model, &h);
    }
}

/* Steps without contact have no edge whose power is uncertain. */
TEST(lost_contact_has_error_bars)
{
    const spot hole = make_spot(9.0, 6.0, 0.5);
    rb_rolling_case rc = kind_of_case(KINDS - 1);
    rb_rolling_model model;
    rb_rolling_history h;
    int lost = 0;
    set(&rc, "support halfplane formulation transient creep 1e-3 distance 14 steps 20");
    const rb_rolling_case moving = with_spot(&rc, &hole);
    CHECK_OK(rb_rolling_history_with_errors(&moving, NULL, NULL, &model, &h, NULL));
    for (int i = 0; i < h.n; i++) {
        lost += h.normal_load[i] == 0.0;
        assert_true(isfinite(h.errors->dissipation[i]));
    }
    assert_true(lost > 2);
    release(&model, &h);
}

RUN_TESTS(NULL, NULL)
