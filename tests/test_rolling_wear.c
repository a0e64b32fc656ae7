/* Wear: volume, implicit steps of any length, the uniform pressure that a cylinder and a
 * punch wear to, fretting with a zone that sticks, turns of a wheel, going on. */
#include "cases.h"
#include "check.h"
#include "rolling/case/closed_forms.h"
#include "rolling/rolling.h"

#include <gsl/gsl_math.h>

/* Similar half-planes, a = 1. */
static rb_rolling_case cylinder(int elements, double zone)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);
    set(&rc, "young 200000 poisson 0.3 similar gap parabola");
    rc.load = rb_rolling_derive(&rc).modulus * M_PI / (4.0 * rc.a.radius);
    rc.zone = zone;
    return rc;
}

/* Sliding until K S p0 is so many times the gap a^2/(2R) at the edge. */
static rb_rolling_wear sliding(const rb_rolling_case *rc, double units, int steps)
{
    const double p0 = rb_closed_hertz_max_pressure(rc->load, 1.0);
    return (rb_rolling_wear){.law = RB_WEAR_ARCHARD,
                             .slides = 1,
                             .coefficient = 1e-9,
                             .way = units / (2.0 * rc->a.radius) / (1e-9 * p0),
                             .steps = steps};
}

typedef struct {
    rb_rolling_wear_history h;
    rb_rolling_solution last;
} worn;

static worn run(const rb_rolling_case *rc, const rb_rolling_wear *wear)
{
    worn w;
    CHECK_OK(rb_rolling_wear_run(rc, wear, NULL, &w.h, &w.last, &message));
    return w;
}

static void worn_free(worn *w)
{
    rb_rolling_wear_history_free(&w->h);
    rb_rolling_solution_free(&w->last);
}

static double half_width(const worn *w)
{
    return 0.5 * (w->h.contact_to[w->h.n - 1] - w->h.contact_from[w->h.n - 1]);
}

/* Largest second difference of the pressure inside the contact, but for its edges. */
static double roughness(const rb_rolling_solution *s)
{
    double most = 0.0;
    for (int i = 3; i + 3 < s->n; i++)
        if (s->p[i - 3] > 0.0 && s->p[i + 3] > 0.0)
            most = fmax(most, fabs(s->p[i - 1] - 2.0 * s->p[i] + s->p[i + 1]));
    return most;
}

/* The worn volume is K P S to rounding, in any number of steps, and each step is stable:
 * 1.56 a is the half-width after two units. */
TEST(sliding_wears_its_volume)
{
    static const int steps[] = {100, 10, 1};
    const rb_rolling_case rc = cylinder(200, 6.0);

    for (int k = 0; k < 3; k++) {
        const rb_rolling_wear wear = sliding(&rc, 2.0, steps[k]);
        worn w = run(&rc, &wear);
        double volume = 0.0;
        for (int i = 0; i < w.last.n; i++)
            volume += w.last.worn[i] * w.last.h[i];
        CHECK_REL(volume, wear.coefficient * rc.load * wear.way, 1e-12, "%d steps", steps[k]);
        CHECK_REL(w.h.worn[w.h.n - 1], volume, 1e-12, "%d steps: recorded", steps[k]);
        CHECK_ABS(half_width(&w), 1.56, 0.035, "%d steps: half-width, to half an element",
                  steps[k]);
        CHECK_MAX(roughness(&w.last), 0.02 * w.h.max_pressure[0], "%d steps: saw teeth", steps[k]);
        CHECK_MAX(w.h.residual[w.h.n - 1], 1e-10, "%d steps: residual of the worn gap", steps[k]);
        worn_free(&w);
    }
}

/* K S P = 4 a^3/R against values of a second program; steps of first order err
 * by 5.7e-2, 2.7e-2, 1.3e-2. */
TEST(steps_are_of_second_order)
{
    static const double error[] = {3.8e-4, -1.7e-4, -3.3e-4}; /* theory-rolling.md W4 */
    static const int steps[] = {5, 10, 20};
    const rb_rolling_case rc = cylinder(300, 4.0);
    for (int k = 0; k < 3; k++) {
        if (!is_in_turn(k, 3))
            continue;
        const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                      .slides = 1,
                                      .coefficient = 1e-9,
                                      .way = 4.0 / rc.a.radius / (1e-9 * rc.load),
                                      .steps = steps[k]};
        worn w = run(&rc, &wear);
        CHECK_TWO_DIGITS(w.last.p[150] / (0.43639 * w.h.max_pressure[0]) - 1.0, error[k],
                         "%d steps: p(0)", steps[k]);
        CHECK_REL(w.h.max_depth[w.h.n - 1], 1.5417 / rc.a.radius, 1e-3, "%d steps: depth",
                  steps[k]);
        for (int i = 0; i < w.last.n; i++)
            assert_true(w.last.worn[i] >= 0.0);
        worn_free(&w);
    }
}

/* What sticks keeps c = a sqrt(1 - Q/(mu P)), and the slip zone unloads: closed form of the limit,
 * which more cycles do not leave.  Its pressure has no bound at c, and no error bar. */
TEST(partial_slip_ends_in_its_limit)
{
    double worn_before = 0.0;
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = cylinder(108, 1.35); /* 0.025 a: c between two elements */
        set(&rc, "mu 0.5 force-ratio %g", 1.0 - 0.6 * 0.6);
        const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                      .coefficient = 1e-8,
                                      .way = k ? 1e10 : 1e8,
                                      .steps = 10,
                                      .increments = 2};
        worn w = run(&rc, &wear);
        const double c = 0.6, middle = 0.5 * (1.0 + c * c) / c;
        CHECK_REL(0.5 * (w.last.p[53] + w.last.p[54]), middle * w.h.max_pressure[0], 0.05, "p(0)");
        assert_int_equal(w.last.stick_edge, 1);
        assert_int_equal(w.h.stick_edge, 1);
        if (k)
            CHECK_REL(w.h.worn[10], worn_before, 0.01, "the limit");
        worn_before = w.h.worn[10];
        worn_free(&w);
    }
}

/* Bars hold the converged values, cover the steps, and are absent where there is no limit. */
TEST(wear_has_error_bars)
{
    rb_rolling_case rc = cylinder(60, 2.4);
    worn w;
    for (int steps = 1; steps < 8; steps += 3) {
        const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                      .slides = 1,
                                      .coefficient = 1e-9,
                                      .way = 4.0 / rc.a.radius / (1e-9 * rc.load),
                                      .steps = steps};
        CHECK_OK(rb_rolling_wear_with_errors(&rc, &wear, NULL, &w.h, &w.last, &message));
        const int last = w.h.n - 1;
        assert_non_null(w.h.errors);
        assert_null(w.h.errors->worn_b);
        CHECK_ABS(w.h.max_depth[last], 1.5417 / rc.a.radius, w.h.errors->max_depth[last], "depth");
        CHECK_ABS(w.h.contact_to[last], 1.9625, w.h.errors->contact_to[last] + 0.0125, "edge");
        CHECK_MAX(w.h.errors->worn[last], 1e-9 * w.h.worn[last], "volume by P");
        worn_free(&w);
    }
    set(&rc, "mu 0.5 force-ratio 0.6 zone 1.35");
    const rb_rolling_wear frets = {.law = RB_WEAR_ARCHARD,
                                   .coefficient = 1e-8,
                                   .way = 1e5,
                                   .steps = 2,
                                   .increments = 2,
                                   .share = 0.5};
    CHECK_OK(rb_rolling_wear_with_errors(&rc, &frets, NULL, &w.h, &w.last, &message));
    assert_true(isnan(w.h.errors->max_pressure[2]) && w.h.errors->worn_b[2] > 0.0 &&
                w.h.errors->worn[1] > 0.0);
    worn_free(&w);
    rc.contact_elements = 5; /* too few to be halved */
    CHECK_STATUS(rb_rolling_wear_with_errors(&rc, &frets, NULL, &w.h, &w.last, &message),
                 RB_EINVAL);
    worn_free(&w);
}

/* Late: p = P/(2b) and V = 2 b^3/(3R), from any number of steps. */
TEST(cylinder_wears_to_uniform_pressure)
{
    const rb_rolling_case rc = cylinder(50, 0.0); /* the zone grows with the scar */
    const rb_rolling_wear wear = sliding(&rc, 400.0, 40);
    worn w = run(&rc, &wear);
    const int last = w.h.n - 1;
    const double b = half_width(&w);

    CHECK_ABS(b, 7.78, 0.3, "half-width of (3 R V/2)^(1/3)");
    CHECK_REL(w.h.worn[last], 2.0 * gsl_pow_3(b) / (3.0 * rc.a.radius), 0.02, "volume");
    CHECK_REL(w.h.worn[last], wear.coefficient * rc.load * wear.way, 1e-12,
              "volume, on wider meshes too");
    for (int i = 0; i < w.last.n; i++)
        if (fabs(w.last.x[i]) < 0.8 * b)
            CHECK_REL(w.last.p[i], rc.load / (2.0 * b), 0.05, "p at x = %g", w.last.x[i]);
    worn_free(&w);
}

/* A flat punch with rounded corners: from 1/sqrt at its edges to P/(2c). */
TEST(punch_wears_to_uniform_pressure)
{
    enum { ROWS = 401 };
    double x[ROWS], gap[ROWS];
    rb_rolling_profile *profile;
    rb_rolling_case rc = cylinder(150, 1.5);
    for (int k = 0; k < ROWS; k++) {
        x[k] = 2.0 * (2.0 * k / (ROWS - 1) - 1.0);
        const double beyond = fmax(0.0, fabs(x[k]) - 1.0);
        gap[k] = 5.0 * beyond * beyond;
    }
    CHECK_OK(rb_rolling_profile_create(ROWS, x, gap, 0.0, &profile, &message));
    rc.gap = RB_GAP_TABLE;
    rc.profile = profile;
    const rb_rolling_wear wear = sliding(&rc, 50.0, 30);
    worn w = run(&rc, &wear);
    double mean = 0.0, off = 0.0, n = 0.0;
    for (int i = 0; i < w.last.n; i++)
        if (fabs(w.last.x[i]) < 0.9) {
            mean += w.last.p[i];
            n++;
        }
    mean /= n;
    for (int i = 0; i < w.last.n; i++)
        if (fabs(w.last.x[i]) < 0.9)
            off = fmax(off, fabs(w.last.p[i] / mean - 1.0));
    CHECK_MAX(off, 0.02, "p/mean - 1");
    CHECK_REL(mean, rc.load / (2.0 * half_width(&w)), 0.05, "P/(2c)");
    CHECK_REL(w.h.worn[w.h.n - 1], wear.coefficient * rc.load * wear.way, 1e-12, "volume");
    worn_free(&w);
    rb_rolling_profile_free(profile);
}

/* Partial slip: nothing wears where it sticks, and the law of dissipation takes the
 * friction work of the cycle. */
TEST(fretting_spares_what_sticks)
{
    rb_rolling_case rc = cylinder(120, 1.5);
    rc.force_ratio = 0.75; /* c = a/2 */
    const rb_rolling_wear wear = {
        .law = RB_WEAR_DISSIPATION, .coefficient = 1e-8, .way = 100.0, .steps = 2, .increments = 8};
    worn w = run(&rc, &wear);
    double slip = 0.0;
    for (int i = 0; i < w.last.n; i++) {
        if (fabs(w.last.x[i]) < 0.45)
            CHECK_ABS(w.last.worn[i], 0.0, 0.0, "x = %g sticks", w.last.x[i]);
        slip = fmax(slip, w.last.worn[i]);
        CHECK_REL(w.last.worn[i], w.last.worn[w.last.n - 1 - i], 1e-6, "symmetric");
    }
    assert_true(slip > 0.0);
    /* of a step that is short enough the volume is K times the work */
    const double work = w.h.work[1] * 50.0;
    CHECK_REL(w.h.worn[1], wear.coefficient * work, 0.02, "K times the work");
    worn_free(&w);
}

/* What sticks ends inside of elements, which once moved the scar by up to half an element: volumes
 * of 50 and 60 elements lay 4 % below and 1.4 % above.  Now the error falls with the elements, and
 * bars hold the volume of 400 and more, 4.174e-5 mm2, on which two series of meshes agree whose
 * elements end otherwise. */
TEST(an_edge_of_stick_has_its_place_in_an_element)
{
    static const double VOLUME = 4.174e-5;
    static const struct {
        int elements;
        double within;
    } rows[] = {{40, 0.012}, {50, 0.010}, {60, 0.009}};
    const rb_rolling_wear wear = {
        .law = RB_WEAR_ARCHARD, .coefficient = 1e-8, .way = 1e6, .steps = 10, .increments = 2};
    double most = INFINITY;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        rb_rolling_case rc = half_plane(RB_STATIC, rows[k].elements);
        set(&rc, "young 210000 poisson 0.3 similar gap parabola radius 100 load 100 mu 0.5 "
                 "force-ratio 0.64 zone auto");
        worn w;
        if (k == 2)
            CHECK_OK(rb_rolling_wear_with_errors(&rc, &wear, NULL, &w.h, &w.last, &message));
        else
            w = run(&rc, &wear);
        CHECK_REL(w.h.worn[10], VOLUME, rows[k].within, "%d elements", rows[k].elements);
        CHECK_MAX(w.h.worn[10], most, "%d elements", rows[k].elements);
        if (w.h.errors) {
            CHECK_ABS(w.h.worn[10], VOLUME, w.h.errors->worn[10], "bar");
            CHECK_MAX(w.h.errors->worn[10], 0.02 * VOLUME, "bar");
        }
        most = w.h.worn[10];
        worn_free(&w);
    }
}

/* Where the elements do not take their place about what sticks, or hardly anything is worn, the
 * volume is of first order in their length, and its bar holds that of 400 elements. */
TEST(bars_hold_where_the_order_is_the_first)
{
    static const struct {
        const char *words;
        double coefficient, volume, most;
    } rows[] = {{"similar mu 0.5 zone auto", 1e-12, 3.7196e-9, 0.1},
                {"similar mu 0.5 zone 0.45", 1e-8, 4.174e-5, 0.3},
                {"mu 0.5 young-b 70000 poisson-b 0.33 zone auto", 1e-10, 8.6057e-7, 0.1}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                      .coefficient = rows[k].coefficient,
                                      .way = 1e6,
                                      .steps = 10,
                                      .increments = 4};
        rb_rolling_case rc = half_plane(RB_STATIC, 60);
        set(&rc, "young 210000 poisson 0.3 gap parabola radius 100 load 100 force-ratio 0.64");
        set(&rc, "%s", rows[k].words);
        worn w;
        CHECK_OK(rb_rolling_wear_with_errors(&rc, &wear, NULL, &w.h, &w.last, &message));
        CHECK_ABS(w.h.worn[10], rows[k].volume, w.h.errors->worn[10], "%s", rows[k].words);
        CHECK_MAX(w.h.errors->worn[10], rows[k].most * rows[k].volume, "%s", rows[k].words);
        worn_free(&w);
    }
}

/* An element on which the contact has only begun to lean when the second stage comes: it was left
 * as it stood there, and carried 150 MPa where 101.4 are right. */
TEST(elements_at_a_growing_edge_do_not_stand_out)
{
    static const int steps[] = {5, 10, 20};
    rb_rolling_case rc = half_plane(RB_STATIC, 30);
    set(&rc, "radius 100 mu 0.27 young 210000 poisson 0.222 similar load 200 shift 0.01");
    rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD, .coefficient = 1e-9, .way = 1e6};

    wear.increments = 8;
    for (int k = 0; k < 3; k++) {
        wear.steps = steps[k];
        worn w = run(&rc, &wear);
        for (int i = 1; i < w.h.n; i++)
            CHECK_MAX(w.h.max_pressure[i] / w.h.max_pressure[i - 1], 1.0, "%d steps, %d", steps[k],
                      i);
        CHECK_REL(w.h.max_pressure[w.h.n - 1], 101.31, 2e-3, "%d steps: p0 in the end", steps[k]);
        worn_free(&w);
    }
}

/* Far beyond the elastic displacement a cycle is four strokes long. */
TEST(gross_slip_wears_four_strokes)
{
    rb_rolling_case rc = cylinder(100, 2.0);
    const double p0 = rb_closed_hertz_max_pressure(rc.load, 1.0);
    rc.shift = 50.0;
    const rb_rolling_wear wear = {
        .law = RB_WEAR_ARCHARD, .coefficient = 1e-10, .way = 10.0, .steps = 1, .increments = 4};
    worn w = run(&rc, &wear);
    CHECK_REL(w.h.max_depth[1], 1e-10 * p0 * 10.0 * 4.0 * 50.0, 0.02, "depth");
    worn_free(&w);
}

/* A round wheel stays round: dz = K D per turn. */
TEST(wheel_loses_its_radius)
{
    rb_rolling_case rc = with(cylinder(60, 0.0), "formulation steady mesh fitted creep-ratio 0.5");
    const rb_rolling_wear wear = {
        .law = RB_WEAR_DISSIPATION, .coefficient = 1e-7, .way = 1000.0, .steps = 4};
    worn w = run(&rc, &wear);
    const int last = w.h.n - 1;
    for (int k = 1; k <= last; k++) { /* of second order: with the mean work */
        const double before = k > 1 ? w.h.work[k - 1] : w.h.work[1];
        CHECK_REL(w.h.radius[k - 1] - w.h.radius[k], 250.0 * 1e-7 * 0.5 * (before + w.h.work[k]),
                  k > 1 ? 1e-9 : 1e-6, "step %d", k);
        assert_true(w.h.radius[k] < w.h.radius[k - 1]);
    }
    CHECK_REL(w.h.worn[last], M_PI * (gsl_pow_2(rc.a.radius) - gsl_pow_2(w.h.radius[last])), 1e-12,
              "volume");
    worn_free(&w);
}

/* Carter: it slides where abs(q) = mu p, so that Archard's law takes K xi abs(Q)/mu per
 * turn, in partial and in full sliding. */
TEST(archard_s_wheel_loses_what_creepage_feeds)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = cylinder(50, 0.0);
        const double s = k % 2 ? 2.0 : 0.5;
        set(&rc, "formulation steady mesh %s creep-ratio %g", k < 2 ? "fitted" : "uniform", s);
        const rb_rolling_wear wear = {
            .law = RB_WEAR_ARCHARD, .coefficient = 1e-9, .way = 1.0, .steps = 1};
        worn w = run(&rc, &wear);
        const double a = w.last.hertz_half_width, P = w.last.normal_load;
        const double fed = s * rc.mu * a / rc.a.radius * P * (s < 1.0 ? s * (2.0 - s) : 1);
        CHECK_REL(w.h.max_depth[1], 1e-9 * fed, k < 2 ? 2e-3 : 2e-2, "s = %g", s);
        worn_free(&w);
    }
}

/* Ten steps, or five and then five more from the profile they left. */
TEST(wear_goes_on)
{
    rb_rolling_case rc = cylinder(160, 5.0);
    const rb_rolling_wear ten = sliding(&rc, 2.0, 10), five = sliding(&rc, 1.0, 5);
    worn all = run(&rc, &ten), first = run(&rc, &five);
    rc.worn.n = first.last.n;
    rc.worn.x = first.last.x;
    rc.worn.y = first.last.worn;
    worn second = run(&rc, &five);
    for (int i = 0; i < all.last.n; i++) {
        CHECK_ABS(second.last.worn[i], all.last.worn[i], 1e-12 * all.h.max_depth[10],
                  "depth of element %d", i);
        CHECK_ABS(second.last.p[i], all.last.p[i], 1e-9 * all.h.max_pressure[10],
                  "pressure of element %d", i);
    }
    worn_free(&all);
    worn_free(&first);
    worn_free(&second);
}

static rb_rolling_wear shared(rb_rolling_wear wear, double share)
{
    wear.share = share;
    return wear;
}

/* The volumes are as the shares wherever B loses its own: in the contact, on its track,
 * from its radius outside A or around it.  The sum is what A would lose alone. */
TEST(volumes_are_as_the_shares)
{
    static const double radius_b[] = {INFINITY, INFINITY, INFINITY, 80.0, -70.0};
    for (int k = 0; k < 5; k++) {
        rb_rolling_case rc = cylinder(60, 3.0);
        rb_rolling_wear wear = sliding(&rc, 0.05, 3);
        rc.b.radius = radius_b[k];
        if (k > 0)
            wear = (rb_rolling_wear){.law = RB_WEAR_DISSIPATION,
                                     .coefficient = 1e-10,
                                     .way = 1e4,
                                     .steps = 3,
                                     .increments = 4};
        if (k == 1)
            rc.force_ratio = 0.6;
        if (k > 1) {
            set(&rc, "formulation steady creep-ratio 0.5");
        }
        const rb_rolling_wear both = shared(wear, 0.3), none = shared(wear, 0.0);
        worn w = run(&rc, &both), alone = run(&rc, &none);
        const int last = w.h.n - 1;
        assert_null(alone.h.worn_b);
        assert_null(alone.h.radius_b);
        assert_true((w.h.radius_b != NULL) == (k > 2));
        CHECK_REL(w.h.worn_b[last], 3.0 / 7.0 * w.h.worn[last], k > 2 ? 1e-4 : 1e-7,
                  "B's volume, kind %d", k);
        CHECK_REL(w.h.worn_b[last] + w.h.worn[last], alone.h.worn[last], 1e-4,
                  "both volumes, kind %d", k);
        if (k == 0)
            CHECK_REL(w.h.worn_b[last], 0.3 * wear.coefficient * rc.load * wear.way, 1e-9,
                      "a track loses s K P S");
        if (k > 2)
            CHECK_REL(w.h.max_depth_b[last] / w.h.max_depth[last],
                      3.0 / 7.0 * rc.a.radius / fabs(rc.b.radius), 1e-4, "depths");
        if (k > 2) /* outside B shrinks, around A it grows */
            assert_true(w.h.radius_b[last] < radius_b[k]);
        worn_free(&w);
        worn_free(&alone);
    }
}

/* Fretting, the gap is that of both; sliding, that of A's part of the coefficient. */
TEST(the_gap_knows_what_wears_in_it)
{
    rb_rolling_case rc = cylinder(60, 3.0);
    rb_rolling_wear one = sliding(&rc, 0.5, 3);
    const rb_rolling_wear some = shared(one, 0.25);
    worn w = run(&rc, &some);
    one.coefficient *= 0.75;
    worn alone = run(&rc, &one);
    for (int i = 0; i < w.last.n; i++)
        CHECK_REL(w.last.worn[i] + 1e-12, alone.last.worn[i] + 1e-12, 1e-9, "depth %d", i);
    CHECK_REL(w.h.max_depth[3], alone.h.max_depth[3], 1e-9, "largest depth");
    worn_free(&w);
    worn_free(&alone);
    rc.force_ratio = 0.6;
    one = (rb_rolling_wear){.coefficient = 1e-6, .way = 1e3, .steps = 2, .increments = 4};
    const rb_rolling_wear half = shared(one, 0.5);
    w = run(&rc, &half);
    alone = run(&rc, &one);
    CHECK_REL(w.h.max_depth[2], 0.5 * alone.h.max_depth[2], 1e-12, "A's half");
    CHECK_REL(w.h.max_depth_b[2], 0.5 * alone.h.max_depth[2], 1e-12, "B's half");
    for (int i = 0; i < w.last.n; i++)
        CHECK_ABS(w.last.worn[i], alone.last.worn[i], 0.0, "gap %d", i);
    worn_free(&w);
    worn_free(&alone);
}

TEST(shares_lie_between_0_and_1)
{
    static const double shares[] = {-0.1, 1.1, NAN};
    const rb_rolling_case rc = cylinder(60, 3.0);
    for (int k = 0; k < 3; k++) {
        OWNED(rb_rolling_wear_history) h;
        OWNED(rb_rolling_solution) last;
        const rb_rolling_wear wear = shared(sliding(&rc, 0.1, 1), shares[k]);
        CHECK_SAYS(rb_rolling_wear_run(&rc, &wear, NULL, &h, &last, &message), RB_EINVAL,
                   "wear-share: expected a number in [0, 1]");
    }
}

TEST(meaningless_wear_is_refused)
{
    const rb_rolling_case good = cylinder(60, 0.0);
    enum { BAD = 6 };
    rb_rolling_case bad[BAD] = {good, good, good, good, good, good};
    rb_rolling_wear wear[BAD];
    static const char *const words[] = {"transient",      "coefficient", "dissipates nothing",
                                        "equal elements", "one elastic", "one elastic"};
    for (int k = 0; k < BAD; k++)
        wear[k] = sliding(&good, 1.0, 2);
    set(&bad[0], "formulation transient distance 1");
    wear[1].coefficient = 0.0;
    bad[2].mu = 0.0;
    wear[2].law = RB_WEAR_DISSIPATION;
    bad[3].mesh = RB_MESH_FITTED;
    for (int k = 4; k < BAD; k++) { /* a radius that shrinks means no layer or cover */
        set(&bad[k], "formulation steady creep 1e-3");
        wear[k].slides = 0;
    }
    bad[4].a.layer = 1.0;
    set(&bad[5], "support hub cover-thickness 1");
    for (int k = 0; k < BAD; k++) {
        worn w;
        CHECK_SAYS(rb_rolling_wear_run(&bad[k], &wear[k], NULL, &w.h, &w.last, &message), RB_EINVAL,
                   words[k]);
        worn_free(&w);
    }
}

/* A stroke by its force and by the ratio of that is one stroke. */
TEST(strokes_may_be_forces)
{
    double depth[2];
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = cylinder(24, 1.5);
        set(&rc, "force %g force-ratio %g", k ? NAN : 0.5 * rc.mu * rc.load, k ? 0.5 : NAN);
        const rb_rolling_wear wear = {
            .law = RB_WEAR_ARCHARD, .coefficient = 1e-9, .way = 1e3, .steps = 1, .increments = 4};
        worn w = run(&rc, &wear);
        depth[k] = w.h.max_depth[w.h.n - 1];
        assert_true(depth[k] > 0.0);
        worn_free(&w);
    }
    CHECK_REL(depth[1], depth[0], 1e-9, "a ratio");
}

/* The law of dissipation takes one coefficient where surfaces slide; Archard's law, and
 * wheels that roll, take any. */
TEST(friction_laws_wear_where_they_can)
{
    worn w;
    for (int k = 0; k < 3; k++) {
        rb_rolling_case rc = cylinder(12, 1.5);
        rb_rolling_wear wear = {.law = k ? RB_WEAR_DISSIPATION : RB_WEAR_ARCHARD,
                                .coefficient = 1e-12,
                                .way = 1.0,
                                .steps = 1,
                                .slides = k < 2};
        set(&rc, "friction-law exponential mu-fall 0.1 slip-scale 100 speed 1");
        if (k == 2) {
            set(&rc, "formulation steady creep 1e-3 zone auto");
        }
        CHECK_STATUS(rb_rolling_wear_run(&rc, &wear, NULL, &w.h, &w.last, &message),
                     k == 1 ? RB_EINVAL : RB_OK);
        if (k == 1)
            assert_non_null(strstr(message.text, "the law of dissipation takes one"));
        worn_free(&w);
    }
}

RUN_TESTS(NULL, NULL)
