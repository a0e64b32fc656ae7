/* Wear of one small contact: each step recomputed from the one before it, and refusals. */
#include "cases.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static rb_rolling_case plane(int elements)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);
    set(&rc, "similar gap parabola load 500 zone 1.6");
    return rc;
}

typedef struct {
    rb_rolling_wear_history h;
    rb_rolling_solution last;
    int counted, stop_at;
    double worn[3], p[3], x; /* at an element, after each step */
    rb_status status;
    rb_message why;
} run;

static int see(rb_rolling_solution *s, const rb_rolling_wear_history *h, int step, int steps,
               void *context)
{
    run *r = context;
    const int k = s->n / 2 + 2;
    assert_int_equal(step, r->counted);
    assert_int_equal(h->n, step + 1);
    assert_true(steps >= step);
    if (step < 3) {
        r->worn[step] = s->worn ? s->worn[k] : 0.0;
        r->p[step] = s->p[k];
        r->x = s->x[k];
    }
    return ++r->counted == r->stop_at;
}

static void start(run *r, const rb_rolling_case *rc, const rb_rolling_wear *wear)
{
    const rb_rolling_wear_observer observer = {see, r};
    r->why.text[0] = '\0';
    r->counted = 0;
    r->status = rb_rolling_wear_run(rc, wear, &observer, &r->h, &r->last, &r->why);
}

static void finish(run *r)
{
    rb_rolling_wear_history_free(&r->h);
    rb_rolling_solution_free(&r->last);
}

TEST(a_step_takes_off_what_its_pressure_wears)
{
    for (int law = 0; law < 2; law++) {
        run r = {.stop_at = -1};
        const rb_rolling_case rc = plane(40);
        const rb_rolling_wear wear = {.law = law ? RB_WEAR_DISSIPATION : RB_WEAR_ARCHARD,
                                      .slides = 1,
                                      .coefficient = 1e-8,
                                      .way = 1000.0,
                                      .steps = 2};
        start(&r, &rc, &wear);
        CHECK_OK(r.status);
        assert_int_equal(r.counted, 3);
        assert_int_equal(r.h.n, 3);
        assert_int_equal(r.h.slides, 1);
        assert_int_equal(r.h.rolls, 0);
        const double depth = 1e-8 * (law ? 0.3 : 1.0) * 500.0; /* per pressure, of a step */
        CHECK_ABS(r.worn[0], 0.0, 0.0, "nothing before");
        /* second order: the trapezium rule is, too (W4) */
        const double change[] = {fabs(r.p[1] - r.p[0]), fabs(r.p[2] - r.p[1])};
        CHECK_ABS(r.worn[1], depth * 0.5 * (r.p[0] + r.p[1]), 0.1 * depth * change[0],
                  "first step");
        CHECK_ABS(r.worn[2] - r.worn[1], depth * 0.5 * (r.p[1] + r.p[2]), 0.1 * depth * change[1],
                  "second step");
        for (int k = 0; k < 3; k++) {
            CHECK_REL(r.h.way[k], 500.0 * k, 1e-15, "way %d", k);
            CHECK_REL(r.h.worn[k], depth * k * 500.0, 1e-9, "volume %d", k);
            CHECK_REL(r.h.normal_load[k], 500.0, 1e-9, "load %d", k);
            CHECK_REL(r.h.work[k], 150.0, 1e-9, "friction of full sliding, %d", k);
            CHECK_ABS(r.h.radius[k], 50.0, 0.0, "radius %d", k);
            CHECK_MAX(r.h.residual[k], 1e-10, "residual %d", k);
        }
        double most = 0.0;
        for (int i = 0; i < r.last.n; i++)
            most = fmax(most, r.last.worn[i]);
        CHECK_ABS(r.h.max_depth[2], most, 0.0, "deepest");
        CHECK_REL(r.h.max_pressure[2], r.last.max_pressure, 1e-15, "p0");
        CHECK_REL(r.h.contact_to[2], r.last.contact_to, 1e-15, "edge");
        CHECK_REL(r.h.approach[2], r.last.approach, 1e-15, "approach");
        assert_true(r.last.tangential_load < 0.0); /* A slides towards +x */
        finish(&r);
    }
}

/* The residual of the last step with matrices. */
static double dense_residual(const rb_rolling_case *rc, const rb_rolling_solution *last)
{
    const rb_rolling_elements at = {last->n, last->x, last->h, 1};
    rb_rolling_case worn = *rc;
    OWNED(rb_rolling_model) model = {0};
    rb_contact_violation violation;
    worn.worn = (rb_rolling_table){last->n, last->x, last->worn};
    worn.force_ratio = -1.0;
    worn.contact.solver = RB_SOLVER_LEMKE; /* which has the matrix */
    CHECK_OK(rb_rolling_model_of_result(&worn, NULL, &at, &model, NULL));
    assert_non_null(model.bodies.F);
    memcpy(model.state.p, last->p, (size_t)last->n * sizeof(double));
    memcpy(model.state.q, last->q, (size_t)last->n * sizeof(double));
    model.state.delta = last->approach;
    model.state.xi = last->creepage;
    CHECK_OK(rb_contact_residual(&model.problem, &model.state, &violation));
    return violation.gap / last->approach;
}

/* Without a matrix: the equations of the worn gap hold with the matrix, a step takes off
 * what its pressure wears, and fretting goes as on fewer elements. */
TEST(many_elements_wear_without_a_matrix)
{
    for (int slides = 0; slides < 2; slides++) {
        if (!is_in_turn(slides, 2))
            continue;
        double depth[2];
        for (int many = 0; many < 2; many++) {
            run r = {.stop_at = -1};
            rb_rolling_case rc = plane(many ? RB_ROLLING_LARGE : 200);
            const rb_rolling_wear wear = {.slides = slides,
                                          .coefficient = 1e-8,
                                          .way = slides ? 1000.0 : 1e4,
                                          .steps = 2,
                                          .increments = 2};
            rc.elastic_b = slides;
            rc.b.young = 50000.0;
            rc.interlayer_normal = slides ? 1e-6 : 0.0;
            if (!slides)
                rc.shift = 5e-4;
            start(&r, &rc, &wear);
            CHECK_OK(r.status);
            depth[many] = r.h.max_depth[2];
            CHECK_MAX(r.h.residual[2], 1e-10, "residual");
            if (slides) {
                CHECK_REL(r.h.worn[2], 1e-8 * 1000.0 * 500.0, 1e-9, "volume");
                /* the first step again, as eight */
                run again = {.stop_at = -1};
                rb_rolling_wear half = wear;
                half.way = 500.0;
                half.steps = 8;
                start(&again, &rc, &half);
                CHECK_OK(again.status);
                CHECK_REL(r.worn[1], again.last.worn[r.last.n / 2 + 2], 2e-4, "first step");
                finish(&again);
                CHECK_MAX(dense_residual(&rc, &r.last), 1e-9, "by the matrix");
            }
            finish(&r);
        }
        CHECK_REL(depth[1], depth[0], slides ? 1e-4 : 2e-2, "deepest");
    }
}

/* What wears without sliding friction is pressed without a force. */
TEST(smooth_surfaces_wear_by_archard)
{
    run r = {.stop_at = -1};
    rb_rolling_case rc = with(plane(40), "mu 0 load nan");
    const rb_rolling_wear wear = {.slides = 1, .coefficient = 1e-8, .way = 1000.0, .steps = 1};
    rc.half_width = rb_rolling_hertz_half_width(&rc, 500.0); /* means this load */
    start(&r, &rc, &wear);
    CHECK_OK(r.status);
    CHECK_REL(r.h.worn[1], 1e-5 * 500.0, 1e-9, "volume of the load");
    CHECK_ABS(r.h.work[1], 0.0, 0.0, "no friction");
    finish(&r);
}

/* Of the second cycle every increment counts: here it slides as a whole, to s and back,
 * so that each place of the middle slides 4 s, and the work is mu P 4 s. */
TEST(fretting_counts_one_closed_cycle)
{
    run r = {.stop_at = -1};
    rb_rolling_case rc = plane(40);
    const rb_rolling_wear wear = {.coefficient = 1e-9, .way = 100.0, .steps = 1, .increments = 3};
    rc.mu = 0.01; /* it sticks for a small part of the cycle alone */
    rc.shift = 0.05;
    start(&r, &rc, &wear);
    CHECK_OK(r.status);
    CHECK_REL(r.h.work[1], 0.01 * 500.0 * 4.0 * 0.05, 0.02, "work of a cycle");
    CHECK_REL(r.h.worn[1], 1e-9 * 100.0 * 4.0 * 0.05 * 500.0, 0.02, "K P 4 s cycles");
    CHECK_ABS(r.h.way[1], 100.0, 0.0, "cycles");
    assert_int_equal(r.h.slides, 0);
    finish(&r);
}

/* (W3) a round wheel stays round: R = R_before - turns K power, the power of its end. */
TEST(a_rolling_wheel_shrinks)
{
    for (int law = 0; law < 2; law++) {
        run r = {.stop_at = -1};
        rb_rolling_case rc = plane(40);
        const rb_rolling_wear wear = {.law = law ? RB_WEAR_DISSIPATION : RB_WEAR_ARCHARD,
                                      .coefficient = 1e-9,
                                      .way = 1e6,
                                      .steps = 2};
        rc.formulation = RB_STEADY;
        rc.creep = 0.01; /* slides everywhere */
        start(&r, &rc, &wear);
        CHECK_OK(r.status);
        assert_int_equal(r.h.rolls, 1);
        /* Archard's law: friction is mu p everywhere */
        const double depth = r.last.dissipation / (law ? 1.0 : rc.mu);
        CHECK_REL(r.h.radius[1] - r.h.radius[2], 1e-9 * 5e5 * depth, 1e-9, "law %d: second step",
                  law);
        CHECK_ABS(r.h.radius[0], 50.0, 0.0, "before");
        for (int k = 0; k < 3; k++) {
            CHECK_REL(r.h.max_depth[k], 50.0 - r.h.radius[k], 1e-12, "depth %d", k);
            CHECK_REL(r.h.worn[k], M_PI * (2500.0 - gsl_pow_2(r.h.radius[k])), 1e-12, "ring %d", k);
        }
        CHECK_REL(r.h.work[2], r.last.dissipation, 1e-12, "power");
        CHECK_REL(r.h.radius_before, 50.0, 0.0, "before");
        finish(&r);
        const rb_rolling_wear much = {.coefficient = 1e-2, .way = 1e6, .steps = 1};
        start(&r, &rc, &much);
        CHECK_STATUS(r.status, RB_EINVAL);
        assert_non_null(strstr(r.why.text, "of the radius, 50 mm; take more steps"));
        assert_int_equal(r.h.n, 1); /* what there was before */
        finish(&r);
    }
}

TEST(a_scar_that_outgrows_its_zone)
{
    run r = {.stop_at = -1};
    rb_rolling_case rc = plane(40);
    const rb_rolling_wear wear = {.slides = 1, .coefficient = 1e-7, .way = 1e4, .steps = 3};
    start(&r, &rc, &wear); /* of half-planes it is widened */
    CHECK_OK(r.status);
    assert_true(r.last.n > 40);
    CHECK_REL(r.h.worn[3], 1e-3 * 500.0, 1e-9, "volume");
    CHECK_REL(r.last.x[r.last.n - 1] - r.last.x[0], (r.last.n - 1) * r.last.h[0], 1e-12,
              "equal elements");
    CHECK_REL(r.last.h[0], 3.2 / 40.0, 1e-12, "of the same length");
    finish(&r);
    const rb_rolling_wear flat = {.slides = 1, .coefficient = 1e-2, .way = 1e6, .steps = 3};
    start(&r, &rc, &flat); /* until nothing is left of it */
    CHECK_STATUS(r.status, RB_ZONE);
    assert_non_null(strstr(r.why.text, "as wide as a body"));
    assert_non_null(strstr(r.why.text, "the radius is 50 mm; wear off less"));
    finish(&r);
    /* of wheels by elements of the same arc, so that nothing worn is lost */
    rc = plane(16);
    set(&rc, "support hub outer-elements 30");
    rc.elastic_b = 0;
    start(&r, &rc, &wear);
    CHECK_OK(r.status);
    assert_true(r.last.n > 16);
    CHECK_REL(r.h.worn[3], 1e-3 * 500.0, 1e-12, "volume on a wheel");
    const double ends = 0.5 * r.last.h[0] + r.last.x[r.last.n - 1];
    CHECK_REL(r.last.n * asin(1.6 / 50.0) / 16.0, asin(ends / 50.0), 1e-4, "the same arcs");
    finish(&r);
}

TEST(an_observer_ends_the_run)
{
    run r = {.stop_at = 2};
    const rb_rolling_case rc = plane(20);
    const rb_rolling_wear wear = {.slides = 1, .coefficient = 1e-8, .way = 1000.0, .steps = 5};
    start(&r, &rc, &wear);
    CHECK_STATUS(r.status, RB_INTERRUPTED);
    assert_non_null(strstr(r.why.text, "interrupted after step 1 of 5"));
    assert_int_equal(r.h.n, 2);
    assert_int_equal(r.last.n, 20);
    finish(&r);
}

TEST(wear_that_makes_no_sense_is_refused)
{
    const rb_rolling_wear fine = {
        .slides = 1, .coefficient = 1e-8, .way = 1.0, .steps = 1, .increments = 1};
#define REFUSED(words, ...)                                                                        \
    do {                                                                                           \
        rb_rolling_case rc = plane(20);                                                            \
        rb_rolling_wear wear = fine;                                                               \
        run r = {.stop_at = -1};                                                                   \
        __VA_ARGS__;                                                                               \
        start(&r, &rc, &wear);                                                                     \
        CHECK_STATUS(r.status, RB_EINVAL);                                                         \
        if (!strstr(r.why.text, words))                                                            \
            fail_msg("'%s' does not say '%s'", r.why.text, words);                                 \
        assert_int_equal(r.counted, 0);                                                            \
        finish(&r);                                                                                \
    } while (0)
#define STEADY rc.formulation = RB_STEADY, wear.slides = 0
    REFUSED("not in a transient", rc.formulation = RB_TRANSIENT);
    REFUSED("wear-coefficient: expected a number > 0, got 0", wear.coefficient = 0.0);
    REFUSED("wear-coefficient: expected a number > 0", wear.coefficient = INFINITY);
    REFUSED("wear-coefficient: expected a number > 0", wear.coefficient = NAN);
    REFUSED("slide: expected a number > 0, got -1", wear.way = -1.0);
    REFUSED("slide: expected a number > 0", wear.way = INFINITY);
    REFUSED("wear-steps: expected a whole number in [1, 1e+06], got 0", wear.steps = 0);
    REFUSED("wear-steps: expected a whole number in [1, 1e+06]", wear.steps = 1000001);
    REFUSED("quarter: expected a whole number in [1, 100000], got 0", wear.slides = 0,
            wear.increments = 0);
    REFUSED("friction dissipates nothing", rc.mu = 0.0, wear.law = RB_WEAR_DISSIPATION);
    REFUSED("friction dissipates nothing", rc.mu = 0.0, wear.slides = 0);
    REFUSED("between which and its opposite A moves", wear.slides = 0);
    REFUSED("takes one coefficient of friction", wear.law = RB_WEAR_DISSIPATION,
            rc.friction.law = RB_FRICTION_linear);
    REFUSED("needs equal elements", rc.mesh = RB_MESH_FITTED);
    REFUSED("--slide needs --formulation static", rc.formulation = RB_STEADY);
    REFUSED("of one elastic material only", STEADY, rc.a.layer = 1.0);
    REFUSED("yield-stress: no wear", rc.yield_stress = 1.0);
    REFUSED("mu: expected a number >= 0", rc.mu = -0.1);
#undef STEADY
#undef REFUSED
}

/* The element at a corner of a worn table, where the slope turns by s: its pressure rises
 * by E* s ln 3 / (2 pi) as elements become three times shorter, without end.  The bar of
 * p0 is wide enough for ten times, and a note says how much. */
TEST(corners_have_no_largest_pressure)
{
    static const double x[] = {-0.2, -0.1, 0.0, 0.1, 0.2}, depth[] = {0.0, 1e-4, 0.0, 1e-4, 0.0};
    double p[3];
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = with(plane(k == 0 ? 61 : k == 1 ? 183 : 549), "mu 0 mesh uniform");
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors e;
        rc.worn = (rb_rolling_table){5, x, depth};
        CHECK_OK(rb_rolling_solve_with_errors(&rc, &s, &e, NULL));
        const rb_rolling_note_list list = rb_rolling_find_notes(&rc, &s);
        p[k] = s.p[s.n / 2];
        CHECK_ABS(s.x[s.n / 2], 0.0, 1e-12, "at the corner");
        CHECK_REL(s.max_pressure, p[k], 1e-12, "the largest");
        const double rise = rb_rolling_derive(&rc).modulus * 2e-3 / (2.0 * M_PI);
        if (k > 0)
            CHECK_REL(p[k] - p[k - 1], rise * log(3.0), k == 1 ? 0.05 : 0.01, "ln 3, %d", k);
        CHECK_MAX(rise * log(10.0), e.scalar.max_pressure, "bar");
        CHECK_MAX(e.scalar.max_pressure, 10.0 * rise * log(10.0), "not absurdly wide");
        assert_int_equal(list.n, 1);
        assert_non_null(strstr(list.text[0], "The worn table has corners in the contact"));
        CHECK_REL(strtod(strstr(list.text[0], "by ") + 3, NULL), rise * log(2.0), 0.05, "note");
    }
}

/* No note where the table's rows are closer than elements, or a soft third body rounds
 * the corner off. */
TEST(corners_that_elements_do_not_see_are_not_noted)
{
    double x[401], depth[401];
    for (int i = 0; i <= 400; i++) {
        x[i] = -1.0 + 0.005 * i;
        depth[i] = 1e-3 * gsl_pow_2(1.0 - x[i] * x[i]);
    }
    for (int soft = 0; soft < 2; soft++) {
        rb_rolling_case rc = plane(60);
        static const double rows[] = {-0.2, 0.0, 0.2}, kink[] = {1e-4, 0.0, 1e-4};
        set(&rc, "mu 0 interlayer-normal %g", soft ? 1e-6 : 0.0);
        rc.worn = soft ? (rb_rolling_table){3, rows, kink} : (rb_rolling_table){401, x, depth};
        OWNED(rb_rolling_solution) s = solved(&rc);
        const rb_rolling_note_list list = rb_rolling_find_notes(&rc, &s);
        for (int i = 0; i < list.n; i++)
            assert_null(strstr(list.text[i], "corners"));
    }
}

RUN_TESTS(NULL, NULL)
