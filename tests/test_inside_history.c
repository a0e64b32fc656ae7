/* What src/rolling/history keeps to itself: displacements where particles were a step ago, the
 * program of its steps, what the material carries along. */
#include "cases.h"
#include "check.h"
#include "rolling/history/internal.h"
#include "rolling/solve/formulation.h"
#include "solved.h"

#include <gsl/gsl_math.h>

/* ---- Former places ----------------------------------------------------------------- */

enum { ELEMENTS = 12, LARGE = RB_ROLLING_LARGE };

static rb_rolling_case plane_ahead(int elastic_b, int elements)
{
    rb_rolling_case rc = half_plane(RB_TRANSIENT, elements);
    rc.a.poisson = 0.3;
    rc.elastic_b = elastic_b;
    return rc;
}

typedef struct {
    rb_rolling_mesh mesh;
    rb_rolling_bodies bodies;
    double *p, *q, *w; /* n, n, 2m: made up, and what they displace */
} pressed;

static pressed press(const rb_rolling_case *rc, double from, double to)
{
    pressed d;
    CHECK_OK(rb_rolling_mesh_uniform(rc, NULL, from, to, &d.mesh, &message));
    CHECK_OK(rb_rolling_bodies_create(rc, NULL, &d.mesh, &d.bodies, &message));
    const int n = d.mesh.n;
    d.p = rb_alloc((size_t)n, 2);
    d.q = d.p + n;
    assert_non_null(d.p);
    d.w = rb_alloc(2 * (size_t)n + 2, 1);
    assert_non_null(d.w);
    for (int i = 0; i < n; i++) {
        d.p[i] = i % 3 == 1 ? 0.0 : 3.0 + sin(5.0 * i);
        d.q[i] = i % 4 == 2 ? 0.0 : cos(3.0 * i);
    }
    CHECK_OK(rb_rolling_displacement(&d.bodies, d.p, d.q, d.w));
    return d;
}

static void release_pressed(pressed *d)
{
    rb_rolling_mesh_free(&d->mesh);
    rb_rolling_bodies_free(&d->bodies);
    free(d->p);
    free(d->w);
}

static double largest(const pressed *d)
{
    return rb_norm_inf(2 * (size_t)d->mesh.n + 2, d->w);
}

/* A step of k elements finds what stands k midpoints upstream; half elements lie between,
 * where the displacement is smooth. */
TEST(whole_elements_ahead_are_their_midpoints)
{
    for (int k = 0; k < 4; k++) { /* with body B, with an interface */
        rb_rolling_case rc = plane_ahead(k % 2, ELEMENTS);
        rc.interlayer_tangential = k / 2 ? 1e-4 : 0.0;
        pressed d = press(&rc, -3.0, 3.0);
        double w_T[ELEMENTS];
        for (int steps = 1; steps <= 3; steps++) {
            OWNED(rb_arena) memory = {0};
            rb_rolling_former_place ahead;
            CHECK_OK(rb_rolling_former_place_create(&rc, &d.bodies, steps * 6.0 / ELEMENTS, &memory,
                                                    &ahead));
            rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
            for (int i = 0; i + steps <= ELEMENTS; i++)
                CHECK_ABS(w_T[i], d.w[ELEMENTS + 1 + i + steps], 1e-12 * largest(&d),
                          "case %d: %d elements ahead of %d", k, steps, i);
        }
        release_pressed(&d);
    }
}

/* A longer mesh has midpoints where the shorter one has none; half a step lies on the
 * line between its neighbours as far as the bodies differ from half-planes. */
TEST(places_beyond_the_mesh_are_those_of_a_longer_one)
{
    const rb_rolling_case rc = plane_ahead(1, ELEMENTS), longer = plane_ahead(1, ELEMENTS + 4);
    pressed d = press(&rc, -3.0, 3.0), more = press(&longer, -3.5, 4.5);
    OWNED(rb_arena) memory = {0};
    rb_rolling_former_place ahead;
    double w_T[ELEMENTS], W_T[2 * 2 * ELEMENTS], outside[2] = {0.0, 0.0};
    memset(more.p, 0, sizeof(double) * (ELEMENTS + 4));
    memset(more.q, 0, sizeof(double) * (ELEMENTS + 4));
    memcpy(more.p + 1, d.p, sizeof(double) * ELEMENTS);
    memcpy(more.q + 1, d.q, sizeof(double) * ELEMENTS);
    CHECK_OK(rb_rolling_displacement(&more.bodies, more.p, more.q, more.w));
    CHECK_OK(rb_rolling_former_place_create(&rc, &d.bodies, 1.5, &memory, &ahead));
    rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
    for (int i = 0; i < ELEMENTS; i++)
        CHECK_ABS(w_T[i], more.w[ELEMENTS + 5 + i + 4], 1e-12 * largest(&d), "element %d", i);

    memset(W_T, 0, sizeof W_T);
    CHECK_OK(rb_rolling_displacement_outside(&rc, &d.bodies, W_T));
    for (int j = 0; j < ELEMENTS; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += W_T[2 * j + k] * d.p[j] + W_T[2 * (ELEMENTS + j) + k] * d.q[j];
    CHECK_ABS(outside[0], more.w[ELEMENTS + 5], 1e-12 * largest(&d), "downstream");
    CHECK_ABS(outside[1], more.w[ELEMENTS + 5 + 1 + ELEMENTS + 1], 1e-12 * largest(&d), "upstream");
    release_pressed(&more);
    release_pressed(&d);
}

/* A wheel differs from its half-plane by what is smooth along the surface. */
TEST(a_wheel_is_nearly_on_the_line_of_its_midpoints)
{
    rb_rolling_case rc = with(plane_ahead(0, ELEMENTS), "support hub outer-elements 60");
    pressed d = press(&rc, -0.6, 0.6);
    OWNED(rb_arena) memory = {0};
    rb_rolling_former_place ahead;
    double w_T[ELEMENTS], W_T[2 * 2 * ELEMENTS], outside[2] = {0.0, 0.0};
    const double h = d.bodies.f.h[ELEMENTS / 2];
    CHECK_OK(rb_rolling_former_place_create(&rc, &d.bodies, h, &memory, &ahead));
    rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
    for (int i = 0; i < ELEMENTS; i++)
        CHECK_ABS(w_T[i], d.w[ELEMENTS + 2 + i], 1e-5 * largest(&d), "element %d", i);
    memset(W_T, 0, sizeof W_T);
    CHECK_OK(rb_rolling_displacement_outside(&rc, &d.bodies, W_T));
    for (int j = 0; j < ELEMENTS; j++)
        for (int k = 0; k < 2; k++)
            outside[k] += W_T[2 * j + k] * d.p[j] + W_T[2 * (ELEMENTS + j) + k] * d.q[j];
    /* beyond the tractions the displacement falls on along a smooth curve */
    rc.contact_elements = ELEMENTS + 4;
    pressed more = press(&rc, -0.7, 0.9);
    memset(more.p, 0, sizeof(double) * (ELEMENTS + 4));
    memset(more.q, 0, sizeof(double) * (ELEMENTS + 4));
    memcpy(more.p + 1, d.p, sizeof(double) * ELEMENTS);
    memcpy(more.q + 1, d.q, sizeof(double) * ELEMENTS);
    CHECK_OK(rb_rolling_displacement(&more.bodies, more.p, more.q, more.w));
    CHECK_ABS(outside[0], more.w[ELEMENTS + 5], 2e-2 * largest(&d), "downstream");
    CHECK_ABS(outside[1], more.w[ELEMENTS + 5 + ELEMENTS + 2], 2e-2 * largest(&d), "upstream");
    release_pressed(&more);
    release_pressed(&d);
}

/* Without a matrix, by distance alone; the interface acts under each point, linear
 * between midpoints. */
TEST(large_contacts_look_ahead_alike)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = plane_ahead(1, LARGE);
        const double h = 6.0 / LARGE;
        rc.interlayer_tangential = k ? 1e-4 : 0.0;
        pressed d = press(&rc, -3.0, 3.0);
        double *w_T = rb_alloc(LARGE, 2), *half = w_T + LARGE;
        OWNED(rb_arena) memory = {0};
        rb_rolling_former_place ahead;
        assert_non_null(w_T);
        assert_null(d.bodies.F);
        CHECK_OK(rb_rolling_former_place_create(&rc, &d.bodies, 2.0 * h, &memory, &ahead));
        rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
        for (int i = 0; i + 2 <= LARGE; i += 50)
            CHECK_ABS(w_T[i], d.w[LARGE + 1 + i + 2], 1e-11 * largest(&d), "element %d", i);
        /* what an interface adds half an element ahead */
        CHECK_OK(rb_rolling_former_place_create(&rc, &d.bodies, 0.5 * h, &memory, &ahead));
        rb_rolling_former_place_apply(&ahead, &d.bodies, d.p, d.q, w_T);
        rc.interlayer_tangential = 0.0;
        pressed without = press(&rc, -3.0, 3.0);
        rb_rolling_former_place_apply(&ahead, &without.bodies, d.p, d.q, half);
        for (int i = 0; i < LARGE; i += 7) {
            const double next = i + 1 < LARGE ? d.q[i + 1] : 0.0;
            CHECK_ABS(w_T[i] - half[i], k ? 1e-4 * 0.5 * (d.q[i] + next) : 0.0, 1e-13,
                      "interface at %d", i);
        }
        const int last = LARGE - 1;
        CHECK_ABS(w_T[last] - half[last], k ? 0.5e-4 * d.q[last] : 0.0, 1e-13, "last");
        release_pressed(&without);
        free(w_T);
        release_pressed(&d);
    }
}

TEST(memory_for_what_is_ahead_may_be_refused)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = plane_ahead(0, k ? LARGE : ELEMENTS);
        pressed d = press(&rc, -1.0, 1.0);
        OWNED(rb_arena) memory = {0};
        rb_rolling_former_place ahead;
        assert_int_equal(d.bodies.F == NULL, k);
        alloc_fail_after(0);
        CHECK_STATUS(rb_rolling_former_place_create(&rc, &d.bodies, 0.01, &memory, &ahead),
                     RB_ENOMEM);
        alloc_succeed();
        assert_true(!ahead.W_T && !ahead.response);
        release_pressed(&d);
    }
}

/* Half-way through a half-plane without a matrix: one element ahead is the next
 * midpoint. */
TEST(large_contacts_know_what_is_ahead)
{
    rb_rolling_case rc = half_plane(RB_STATIC, RB_ROLLING_LARGE);
    set(&rc, "young 209920 poisson 0.3 gap parabola load 100");
    OWNED(rb_rolling_mesh) mesh;
    OWNED(rb_rolling_bodies) bodies;
    OWNED(rb_arena) memory = {0};
    rb_rolling_former_place ahead;
    const int n = RB_ROLLING_LARGE, m = n + 1;

    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -0.2, 0.2, &mesh, NULL));
    CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, NULL));
    assert_null(bodies.F);
    CHECK_OK(rb_rolling_former_place_create(&rc, &bodies, bodies.f.h[0], &memory, &ahead));
    SCRATCH double *r = calloc((size_t)(2 * n), sizeof *r), *w = calloc((size_t)(2 * m), sizeof *w),
                   *w_T = calloc((size_t)n, sizeof *w_T);
    for (int i = n / 3; i < 2 * n / 3; i++) {
        r[i] = 1.0 + 0.3 * sin(0.01 * i);
        r[n + i] = cos(0.02 * i);
    }
    CHECK_OK(rb_rolling_displacement(&bodies, r, r + n, w));
    rb_rolling_former_place_apply(&ahead, &bodies, r, r + n, w_T);
    for (int i = 0; i < n; i++)
        CHECK_ABS(w_T[i], w[m + i + 1], 1e-11 * fabs(w[m + n / 2]), "element %d", i);
}

/* What a step of 1.3 elements brings, with a matrix and by transforms. */
TEST(an_interface_moves_with_the_steps)
{
    double *w[2];
    const int n = 1501;
    double *p = rb_alloc((size_t)n, 2), *q = p + n;

    for (int i = 0; i < n - 1; i++)
        q[i] = 100.0 * rand() / RAND_MAX;
    for (int large = 0; large < 2; large++) {
        rb_rolling_case rc = with(plane_ahead(0, n), "young 210000 poisson 0.28 radius 500");
        OWNED(rb_rolling_mesh) mesh;
        OWNED(rb_rolling_bodies) bodies;
        OWNED(rb_arena) memory = {0};
        rb_rolling_former_place ahead;
        set(&rc, "solver %s interlayer-tangential 1e-2", large ? "newton" : "lemke");
        CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -1.3, 1.3, &mesh, NULL));
        CHECK_OK(rb_rolling_bodies_create(&rc, NULL, &mesh, &bodies, NULL));
        assert_int_equal(bodies.F == NULL, large);
        CHECK_OK(rb_rolling_former_place_create(&rc, &bodies, 1.3 * 2.6 / n, &memory, &ahead));
        w[large] = rb_alloc((size_t)n, 1);
        rb_rolling_former_place_apply(&ahead, &bodies, p, q, w[large]);
    }
    for (int i = 0; i < n; i++)
        CHECK_ABS(w[0][i], w[1][i], 1e-9, "element %d", i);
    free(w[0]);
    free(w[1]);
    free(p);
}

/* ---- Programs ---------------------------------------------------------------------- */

static rb_rolling_case relaxing_press(void)
{
    return rolling_case("support halfplane relaxation-time 2 relaxation-ratio 0.5 load 10");
}

static rb_rolling_case rolling_press(void)
{
    return rolling_case("formulation transient load 10");
}

TEST(no_part_of_a_row_is_longer_than_the_time_step)
{
    const double time[] = {0.0, 1.0, 3.0, 3.0, 3.3}, load[] = {1.0, 2.0, 6.0, 7.0, 8.0};
    const rb_rolling_program program = {.n = 5, .time = time, .load = load},
                             timeless = {.n = 5, .load = load};
    static const struct {
        double step;
        int parts[5];
    } rows[] = {{0.0, {1, 1, 1, 1, 1}},  {0.5, {1, 2, 4, 1, 1}},
                {0.3, {1, 4, 7, 1, 1}},  {0.1, {1, 10, 20, 1, 3}}, /* 0.3/0.1, to rounding */
                {10.0, {1, 1, 1, 1, 1}}, {1e-9, {1, 10000000, 10000000, 1, 10000000}}};
    rb_rolling_case rc = relaxing_press();
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++)
        for (int r = 0; r < 5; r++) {
            rc.time_step = rows[k].step;
            assert_int_equal(rb_rolling_program_parts(&program, &rc, r), rows[k].parts[r]);
            assert_int_equal(rb_rolling_program_parts(&timeless, &rc, r), 1);
        }
    for (int part = 1; part <= 4; part++)
        CHECK_ABS(rb_rolling_program_row(&program, &rc, 2, part, 4).load, 2.0 + part, 0.0,
                  "part %d of the way from 2 to 6", part);
    CHECK_ABS(rb_rolling_program_row(&program, &rc, 0, 1, 1).load, 1.0, 0.0, "row 1");
    assert_true(isnan(rb_rolling_program_row(&program, &rc, 2, 1, 2).approach));
}

/* Loads are those of the end of a step, creepages the mean over it, exact over rows that
 * lie inside. */
TEST(a_rolled_step_has_the_mean_creepage)
{
    const double distance[] = {0.0, 1.0, 3.0}, creep[] = {0.0, 1.0, 5.0},
                 load[] = {10.0, 20.0, 40.0}, equal[] = {0.1, 0.1, 0.1};
    const rb_rolling_program program = {
        .n = 3, .distance = distance, .creep = creep, .load = load, .force_ratio = equal};
    static const struct {
        double from, to, creep, load;
    } steps[] = {{0.0, 0.5, 0.25, 15.0},      {0.0, 1.0, 0.5, 20.0},
                 {0.5, 1.5, 1.125, 25.0}, /* 0.75 and 1.5, half each */
                 {0.0, 2.0, 1.25, 30.0},      {2.0, 3.0, 4.0, 40.0},
                 {0.0, 3.0, 13.0 / 6.0, 40.0}};
    const rb_rolling_case rc = rolling_press();
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        const rb_rolling_case at =
            rb_rolling_program_step(&program, &rc, steps[k].from, steps[k].to);
        CHECK_REL(at.creep, steps[k].creep, 1e-15, "step %zu: creepage", k);
        CHECK_REL(at.load, steps[k].load, 1e-15, "step %zu: load", k);
        CHECK_ABS(at.force_ratio, 0.1, 0.0, "to the last digit");
        assert_true(isnan(at.approach));
    }
}

/* At rest a creepage means nothing: the first step goes on from the last row there. */
TEST(rolling_begins_with_the_last_row_at_rest)
{
    const double distance[] = {0.0, 0.0, 0.0, 1.0}, creep[] = {9.0, 5.0, 1.0, 3.0};
    const rb_rolling_program program = {.n = 4, .distance = distance, .creep = creep},
                             still = {.n = 3, .distance = distance}, timeless = {.n = 3};
    const rb_rolling_case rc = rolling_press();
    CHECK_REL(rb_rolling_program_step(&program, &rc, 0.0, 0.5).creep, 1.5, 1e-15,
              "mean of 1 and 2");
    CHECK_REL(rb_rolling_program_step(&program, &rc, 0.5, 1.0).creep, 2.5, 1e-15, "then");
    assert_int_equal(rb_rolling_program_at_rest(&program), 3);
    assert_int_equal(rb_rolling_program_at_rest(&still), 3);
    assert_int_equal(rb_rolling_program_at_rest(&timeless), 3);
}

TEST(results_refer_to_the_largest_mu)
{
    const double mu[] = {0.1, 0.4, 0.2};
    rb_rolling_case rc = rolling_press();
    const rb_rolling_program with = {.n = 3, .mu = mu}, without = {.n = 3},
                             empty = {.n = 0, .mu = mu};
    CHECK_ABS(rb_rolling_program_base(&with, &rc).mu, 0.4, 0.0, "largest");
    CHECK_ABS(rb_rolling_program_base(&without, &rc).mu, 0.3, 0.0, "the case's");
    CHECK_ABS(rb_rolling_program_base(&empty, &rc).mu, 0.3, 0.0, "the case's");
}

#define REFUSED(words, rc, ...)                                                                    \
    do {                                                                                           \
        const rb_rolling_program program = {__VA_ARGS__};                                          \
        const rb_rolling_case one = rc;                                                            \
        rb_message why = {.text = ""};                                                             \
        CHECK_STATUS(rb_rolling_program_check(&program, &one, &why), RB_EINVAL);                   \
        if (!strstr(why.text, words))                                                              \
            fail_msg("'%s' does not say '%s'", why.text, words);                                   \
    } while (0)
#define ACCEPTED(rc, ...)                                                                          \
    do {                                                                                           \
        const rb_rolling_program program = {__VA_ARGS__};                                          \
        const rb_rolling_case one = rc;                                                            \
        rb_message why = {.text = ""};                                                             \
        if (rb_rolling_program_check(&program, &one, &why) != RB_OK)                               \
            fail_msg("%s", why.text);                                                              \
    } while (0)
TEST(programs_that_make_no_sense_are_refused)
{
    const double d[] = {0.0, 0.0, 1.0}, late[] = {0.1, 0.2, 1.0}, back[] = {0.0, 2.0, 1.0},
                 twice[] = {0.0, 1.0, 1.0}, load[] = {1.0, 2.0, 3.0}, none[] = {1.0, NAN, 3.0},
                 far[] = {0.0, 0.4, 0.8}, pull[] = {1.0, 2.0, -3.0};
    rb_rolling_case rest = rb_rolling_case_defaults(), steady = rest, table = rest;
    steady.formulation = RB_STEADY;
    table.friction =
        (rb_rolling_friction){.law = RB_FRICTION_table, .table = {.n = 3, .x = d, .y = load}};

    ACCEPTED(rest, .n = 3, .load = load);
    ACCEPTED(rolling_press(), .n = 3, .distance = d, .load = load);
    ACCEPTED(relaxing_press(), .n = 3, .time = d, .load = load);
    REFUSED("expected 1 row", rest, .n = 0, .load = load);
    REFUSED("steady rolling has none", steady, .n = 3, .load = load);
    REFUSED("needs a column distance", rolling_press(), .n = 3, .load = load);
    REFUSED("is for transient", rest, .n = 3, .distance = d, .load = load);
    REFUSED("column time is for static", rolling_press(), .n = 3, .distance = d, .time = d);
    REFUSED("is for viscoelastic bodies", rest, .n = 3, .time = d);
    REFUSED("column mu cannot be combined with a table", table, .n = 3, .mu = load);
    REFUSED("row 2: load is not a number", rest, .n = 3, .load = none);
    REFUSED("row 1: expected distance 0", rolling_press(), .n = 3, .distance = late);
    REFUSED("row 3: distance 1 is less", rolling_press(), .n = 3, .distance = back);
    REFUSED("row 3: distance 1 twice", rolling_press(), .n = 3, .distance = twice);
    REFUSED("needs a column time", relaxing_press(), .n = 3, .load = load);
    REFUSED("row 1: expected time 0", relaxing_press(), .n = 3, .time = late);
    REFUSED("row 3: time 1 is before", relaxing_press(), .n = 3, .time = back);
    REFUSED("history: row 3: load: expected a number >= 0, got -3", rest, .n = 3, .load = pull);

    rb_rolling_case fine = relaxing_press();
    fine.time_step = 1.0000001e-7; /* 1e7 steps */
    ACCEPTED(fine, .n = 3, .time = d);
    fine.time_step = 4e-8; /* of a row no more than 1e7 count */
    ACCEPTED(fine, .n = 2, .time = twice);
    REFUSED("time-step: 4e-08 s makes 2e+07 steps", fine, .n = 3, .time = far, .load = load);
}

static void check_rows(const double *got, const double *wanted, int n, const char *what)
{
    for (int r = 0; r < n; r++)
        CHECK_ABS(got[r], wanted[r], 1e-15 * fabs(wanted[r]), "row %d: %s", r, what);
}

TEST(increments_press_first_and_load_then)
{
    rb_rolling_case rc = rolling_case("increments 2 approach 0.1 shift 0.02");
    rb_rolling_program program;
    OWNED(rb_arena) memory = {0};
    CHECK_OK(rb_rolling_program_of_case(&rc, &memory, &program));
    static const double approach[] = {0.05, 0.1, 0.1, 0.1}, shift[] = {0.0, 0.0, 0.01, 0.02};
    assert_int_equal(program.n, 4);
    assert_null(program.load);
    assert_null(program.distance);
    check_rows(program.approach, approach, 4, "approach");
    check_rows(program.shift, shift, 4, "shift");

    set(&rc, "approach nan shift nan load 10");
    CHECK_OK(rb_rolling_program_of_case(&rc, &memory, &program));
    assert_int_equal(program.n, 2); /* a shift of 0 loads nothing */
    CHECK_ABS(program.load[0], 5.0, 0.0, "half the load");
    CHECK_ABS(program.load[1], 10.0, 0.0, "the load");

    rc.force = -2.0;
    CHECK_OK(rb_rolling_program_of_case(&rc, &memory, &program));
    assert_int_equal(program.n, 4);
    assert_null(program.shift);
    CHECK_ABS(program.force[2], -1.0, 0.0, "half the force");
}

TEST(a_transient_rolls_under_its_loads)
{
    rb_rolling_case rc = with(rolling_press(), "distance 3 increments 2 force-ratio 0.5");
    rb_rolling_program program;
    OWNED(rb_arena) memory = {0};
    CHECK_OK(rb_rolling_program_of_case(&rc, &memory, &program));
    static const double load[] = {5.0, 10.0, 10.0, 10.0, 10.0},
                        ratio[] = {0.0, 0.0, 0.25, 0.5, 0.5},
                        distance[] = {0.0, 0.0, 0.0, 0.0, 3.0};
    assert_int_equal(program.n, 5);
    check_rows(program.load, load, 5, "load");
    check_rows(program.force_ratio, ratio, 5, "Q/(mu P)");
    check_rows(program.distance, distance, 5, "distance");

    set(&rc, "force-ratio nan creep 0.001 increments 1");
    CHECK_OK(rb_rolling_program_of_case(&rc, &memory, &program));
    assert_int_equal(program.n, 2); /* driven by its creepage: no force at rest */
    assert_null(program.force);
    assert_null(program.force_ratio);
    assert_null(program.shift);
}

/* ---- What rides along -------------------------------------------------------------- */

/* Whole elements ahead are rows of F, which does not know of half-planes. */
TEST(whole_elements_ahead_are_known)
{
    for (int hub = 0; hub < 2; hub++) {
        const rb_rolling_case rc = wheel_on_rail(hub ? RB_BEM_HUB : RB_BEM_ARC, 20);
        OWNED(rb_rolling_model) model = solved_model(&rc);
        const int n = model.mesh.n, m = n + 1;
        const double *F = model.bodies.F, size = fabs(F[0]);
        for (int k = 0; k <= 3; k++) {
            OWNED(rb_arena) memory = {0};
            rb_rolling_former_place ahead;
            CHECK_OK(rb_rolling_former_place_create(&rc, &model.bodies, k * model.bodies.f.h[n / 2],
                                                    &memory, &ahead));
            for (int j = 0; j < 2 * n; j++)
                for (int i = 0; i + k < m && i < n; i++)
                    CHECK_ABS(ahead.W_T[i + j * n], F[m + i + k + j * 2 * m], 1e-12 * size,
                              "%d ahead of %d, column %d", k, i, j);
        }
    }
}

/* A quarter ahead of a midpoint lies a midpoint of elements half as long, two of which
 * carry what one did. */
TEST(a_quarter_ahead_is_a_midpoint_of_halves)
{
    rb_rolling_case rc = wheel_on_rail(RB_BEM_HUB, 20);
    set(&rc, "datum 100 datum-b 100 outer-elements 200");
    OWNED(rb_rolling_model) coarse = solved_model(&rc);
    rc.contact_elements *= 2;
    OWNED(rb_rolling_model) fine = solved_model(&rc);
    const int n = coarse.mesh.n, m = 2 * n + 1;
    OWNED(rb_arena) memory = {0};
    rb_rolling_former_place ahead;
    CHECK_OK(rb_rolling_former_place_create(&rc, &coarse.bodies, 0.25 * coarse.bodies.f.h[n / 2],
                                            &memory, &ahead));
    const double *F = fine.bodies.F, size = fabs(F[m + 4 * n * m]); /* TT */
    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < n; i++) {
            const double *a = F + (size_t)(4 * j * m) + m + 2 * i + 1, *b = a + 2 * m;
            CHECK_ABS(ahead.W_T[i + j * n], *a + *b, 5e-3 * size, "%d, column %d of %d", i, j,
                      2 * n);
        }
}

/* Steps of less than an element: what has yielded comes from between midpoints, and from
 * beyond the mesh comes nothing. */
static int check_yielded(const rb_rolling_model *model, const rb_rolling_history *h, int step,
                         int steps, void *context)
{
    static double before[100];
    const double *x = model->bodies.f.x, c = h->step / h->substeps[step];
    const int n = model->mesh.n;
    (void)steps;
    assert_int_equal(h->substeps[step], 1); /* the states between rows are not seen */
    for (int i = 0; i < n && step > 0; i++) {
        double want = 0.0;
        for (int j = 0; j < n; j++) {
            const double next = j + 1 < n ? before[j + 1] : 0.0, place = x[i] + c;
            if (x[j] <= place && place < x[j + 1])
                want = before[j] + (next - before[j]) * (place - x[j]) / (x[j + 1] - x[j]);
        }
        CHECK_ABS(model->carried.yielded[i], want, 1e-9 * *(double *)context, "step %d, element %d",
                  step, i);
    }
    rb_rolling_yielded(model, before);
    for (int i = 0; i < n; i++)
        *(double *)context = fmax(*(double *)context, before[i]);
    return 0;
}

TEST(what_has_yielded_rides_along)
{
    double most = 0.0;
    rb_rolling_case rc = steel_wheel(20);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    const rb_rolling_observer observer = {check_yielded, &most};
    set(&rc,
        "formulation transient creep-ratio 1.5 distance 1 steps 16 interlayer-tangential 1e-6");
    rc.yield_stress = 0.05 * rb_rolling_derive(&rc).stress;
    CHECK_OK(rb_rolling_history_run(&rc, NULL, &observer, &model, &h, &message));
    assert_true(most > 0.0);
    assert_true(h.step < 0.7 * model.bodies.f.h[0]);
}

static const double F = 3.0, TAU = 1.0; /* of the bodies with one term */

/* Tractions, and what the terms keep of them, move by an element, each direction for
 * itself, and nothing comes in; the displacement that they bring along is that of kept
 * and former tractions through the glassy body (V6). */
TEST(the_past_moves_with_the_material)
{
    enum { N = 6, TAIL = 3, ALL = N + TAIL };
    rb_rolling_case rc = rb_rolling_case_defaults();
    OWNED(rb_rolling_mesh) mesh;
    OWNED(rb_arena) memory = {0};
    OWNED(rb_rolling_memory_track) track;
    double w0[2 * (N + 1)], past[2 * ALL], own[2 * ALL], sum[2 * ALL], w[2 * (ALL + 1)];
    set(&rc, "support halfplane relaxation-time 2 relaxation-ratio 0.5 contact-elements %d", N);
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -0.3, 0.3, &mesh, NULL));
    CHECK_OK(rb_rolling_memory_track_create(&rc, &mesh, TAIL, &memory, &track, NULL));
    for (int rolls = 0; rolls < 2; rolls++) {
        for (int i = 0; i < 2 * ALL; i++) {
            track.traction[i] = own[i] = 1.0 + i;
            track.body[0].past[i] = past[i] = 50.0 - i * i;
        }
        for (int i = 0; i < 2 * ALL && rolls; i++) {
            const int last = i % ALL == ALL - 1;
            own[i] = last ? 0.0 : 2.0 + i;
            past[i] = last ? 0.0 : 50.0 - (i + 1) * (i + 1);
        }
        rb_rolling_memory_track_begin(&track, 3.0, rolls, w0);
        const rb_bem_fading f = rb_bem_fading_over(2.0, 3.0);
        for (int i = 0; i < 2 * ALL; i++) {
            CHECK_ABS(track.traction[i], own[i], 0.0, "traction %d", i);
            CHECK_ABS(track.body[0].past[i], past[i], 0.0, "past %d", i);
            sum[i] = 0.5 * (f.kept * past[i] + f.before * own[i]);
        }
        rb_bem_flexibility_apply(&track.body[0].f, sum, w);
        for (int i = 0; i <= N; i++) {
            CHECK_REL(w0[i], w[TAIL + i], 1e-12, "w_N %d", i);
            CHECK_REL(w0[N + 1 + i], w[ALL + 1 + TAIL + i], 1e-12, "w_T %d", i);
        }
    }
}

/* x F y over the elements of a body. */
static double work_of(const rb_bem_flexibility *f, const double *a, const double *b)
{
    double w[2 * 8], sum = 0.0;
    rb_bem_flexibility_apply(f, b, w);
    for (int i = 0; i < f->n; i++)
        sum += f->h[i] * (a[i] * w[i] + a[f->n + i] * w[f->m + i]);
    return sum;
}

/* A dashpot loses (1/tau) int e F e dt, with e = e_0 exp(-t/tau) + d (1 - exp(-t/tau))
 * tau/step for a change d of the traction.  After a long step and a short one, both
 * of e_0 and d are there; from rest and at a held traction, one of them alone. */
TEST(a_step_loses_what_its_dashpot_does)
{
    enum { N = 6 };
    static const double steps[] = {1e-4, 0.0099, 0.0101, 1.0, 9.0};
    rb_rolling_case rc = rolling_case(
        "support halfplane relaxation-time %g relaxation-ratio %g contact-elements %d", TAU, F, N);
    OWNED(rb_rolling_mesh) mesh;
    CHECK_OK(rb_rolling_mesh_uniform(&rc, NULL, -0.3, 0.3, &mesh, NULL));
    for (int j = 0; j < 15; j++) {
        const double step = steps[j / 3];
        const int kind = j % 3; /* from rest; held; both */
        const long double r = (long double)(step / TAU), faded = -expm1l(-r);
        const double f0 = (double)(-0.5L * expm1l(-2.0L * r)),
                     f1 = (double)(0.5L * faded * faded / r),
                     f2 = (double)((r - 2.0L * faded - 0.5L * expm1l(-2.0L * r)) / (r * r));
        OWNED(rb_arena) memory = {0};
        OWNED(rb_rolling_memory_track) track;
        double e[2 * N] = {0.0}, d[2 * N], next[2 * N];
        CHECK_OK(rb_rolling_memory_track_create(&rc, &mesh, 0, &memory, &track, NULL));
        for (int i = 0; i < 2 * N; i++)
            next[i] = 2.0 + i * i;
        if (kind > 0)
            rb_rolling_memory_track_end(&track, 0.5, next, next + N);
        for (int i = 0; i < 2 * N; i++) {
            if (kind > 0)
                e[i] = track.traction[i] - track.body[0].past[i];
            next[i] += kind == 2 ? 3.0 * i - 4.0 : 0.0;
            d[i] = next[i] - track.traction[i];
        }
        const rb_bem_flexibility *f = &track.body[0].f;
        const double was = track.lost;
        rb_rolling_memory_track_end(&track, step, next, next + N);
        const double want =
            F * (f0 * work_of(f, e, e) + 2.0 * f1 * work_of(f, d, e) + f2 * work_of(f, d, d));
        CHECK_REL(track.lost - was, want, kind == 2 ? 1e-7 : 1e-9, "step %g, %d", step, kind);
    }
}

RUN_TESTS(NULL, NULL)
