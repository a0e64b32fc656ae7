/* Strokes that are not small beside the contact: the table of two programs, volumes, symmetry,
 * what a small stroke and a share of 0 do, what is refused (theory-rolling.md 4.9, W5). */
#include "cases.h"
#include "check.h"
#include "rolling/case/closed_forms.h"
#include "rolling/rolling.h"

#include <gsl/gsl_math.h>

/* Similar half-planes, a = 1, so little friction that nothing but the shift slides. */
static rb_rolling_case cylinder(int elements, double zone, double stroke)
{
    rb_rolling_case rc = half_plane(RB_STATIC, elements);
    set(&rc, "young 200000 poisson 0.3 similar gap parabola mu 1e-6 shift %.17g", stroke);
    rc.load = rb_rolling_derive(&rc).modulus * M_PI / (4.0 * rc.a.radius);
    rc.zone = zone;
    return rc;
}

typedef struct {
    rb_rolling_wear_history h;
    rb_rolling_solution last;
    double a, b, p; /* depths R/a^2 of A and B, p(0)/p0 */
} worn;

/* K 4 S N P = 4 a^3/R, of both together. */
static worn run(const rb_rolling_case *rc, double share, int steps)
{
    const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                  .coefficient = 1e-9,
                                  .share = share,
                                  .way = 1.0 / (rc->a.radius * 1e-9 * rc->load * rc->shift),
                                  .steps = steps,
                                  .increments = 1};
    worn w;
    CHECK_OK(rb_rolling_wear_run(rc, &wear, NULL, &w.h, &w.last, &message));
    const int last = w.h.n - 1, n = w.last.n;
    w.a = w.h.max_depth[last] * rc->a.radius;
    w.b = w.h.worn_b ? w.h.max_depth_b[last] * rc->a.radius : 0.0;
    w.p = (n % 2 ? w.last.p[n / 2] : 0.5 * (w.last.p[n / 2] + w.last.p[n / 2 - 1])) /
          rb_closed_hertz_max_pressure(rc->load, 1.0);
    return w;
}

static void worn_free(worn *w)
{
    rb_rolling_wear_history_free(&w->h);
    rb_rolling_solution_free(&w->last);
}

/* Depths and volumes of another program with 40 elements a half-width and 80 steps of first order,
 * which are good for 2e-3; its pressures are those of 8 positions. */
TEST(strokes_wear_as_a_second_program_says)
{
    static const struct {
        double stroke, share, p, edge, a, b;
    } rows[] = {
        {0.3, 0.5, 0.4354, 1.9125, 0.7778, 0.7626}, {0.5, 0.5, 0.4381, 1.8625, 0.7925, 0.7405},
        {1.0, 0.5, 0.4467, 1.7875, 0.8450, 0.6493}, {1.0, 0.2, 0.4259, 1.9125, 1.2675, 0.2687},
        {1.0, 0.8, 0.5666, 1.6125, 0.3725, 1.0304}, {1.0, 1.0, 0.7015, 1.4375, 0.0, 1.3099},
        {2.0, 0.5, 0.5400, 1.7100, 0.8967, 0.4573},
    };
    for (int k = 0; k < (int)(sizeof rows / sizeof *rows); k++) {
        if (!is_in_turn(k, 4))
            continue;
        const rb_rolling_case rc = cylinder(100, 2.5, rows[k].stroke);
        worn w = run(&rc, rows[k].share, 20);
        const int last = w.h.n - 1;
        if (k < 3) { /* theory-rolling.md W5 */
            static const double shown[][3] = {
                {0.4373, 0.7771, 0.7619}, {0.4399, 0.7917, 0.7398}, {0.4492, 0.8440, 0.6485}};
            CHECK_ABS(w.p, shown[k][0], 6e-5, "S %g: p(0) as shown", rows[k].stroke);
            CHECK_ABS(w.a, shown[k][1], 6e-5, "S %g: A as shown", rows[k].stroke);
            CHECK_ABS(w.b, shown[k][2], 6e-5, "S %g: B as shown", rows[k].stroke);
        }
        const double volume = 4.0 / rc.a.radius;
        CHECK_ABS(w.a, rows[k].a, 2.5e-3, "S %g: depth of A", rows[k].stroke);
        CHECK_ABS(w.b, rows[k].b, 2.5e-3, "S %g: depth of B", rows[k].stroke);
        CHECK_REL(w.p, rows[k].p, rows[k].stroke > 1.0 ? 0.02 : 0.01, "S %g: p(0)", rows[k].stroke);
        CHECK_ABS(w.h.contact_to[last], rows[k].edge, 0.075, "S %g: edge, to 1.5 elements",
                  rows[k].stroke);
        CHECK_REL(w.h.worn[last], (1.0 - rows[k].share) * volume, 1e-5, "volume of A");
        CHECK_REL(w.h.worn_b[last], rows[k].share * volume, 1e-5, "volume of B");
        CHECK_REL(w.h.stroke[last], rows[k].stroke, 1e-5, "stroke");
        assert_int_equal(w.h.positions, rows[k].stroke <= 0.5 ? 8 : 16 * (int)ceil(rows[k].stroke));
        CHECK_MAX(w.h.residual[last], 1e-10, "residual in the middle");
        for (int i = 0; i < w.last.n; i++)
            assert_true(w.last.worn[i] >= 0.0);
        worn_free(&w);
    }
}

/* From a tenth of the half-width on, and where B wears: what both wear in one place is the limit.
 */
TEST(small_strokes_and_bodies_that_do_not_wear_need_no_positions)
{
    rb_rolling_case rc = cylinder(60, 2.4, 0.09);
    worn below = run(&rc, 0.5, 4);
    rc.shift = 0.115;
    worn above = run(&rc, 0.5, 4);
    assert_int_equal(below.h.positions, 0);
    assert_int_equal(above.h.positions, 8);
    CHECK_REL(above.a, below.a, 2e-3, "A");
    CHECK_REL(above.b, below.b, 2e-3, "B");
    CHECK_REL(above.p, below.p, 2e-3, "p(0)");
    worn_free(&below);
    worn_free(&above);
    worn near = run(&rc, 0.0, 4);
    rc.shift = 2.0;
    worn far = run(&rc, 0.0, 4);
    assert_true(far.h.positions == 0 && !far.h.worn_b);
    CHECK_REL(far.a, near.a, 1e-6, "share 0: no dependence on the stroke");
    worn_free(&near);
    worn_free(&far);
}

/* Unlike bodies are pressed otherwise on the way back, by as much: the sum is symmetric.  The zone
 * grows with the scar. */
TEST(both_senses_of_unlike_bodies)
{
    rb_rolling_case rc = cylinder(30, 0.0, 0.4);
    set(&rc, "young-b 60000 poisson-b 0.1 mu 0.6 shift 0.4");
    rc.load = rb_rolling_derive(&rc).modulus * M_PI / (4.0 * rc.a.radius);
    worn w = run(&rc, 0.5, 4);
    const int n = w.last.n, last = w.h.n - 1;
    assert_int_equal(w.h.positions, 16);
    for (int i = 0; i < n; i++)
        CHECK_ABS(w.last.worn[i], w.last.worn[n - 1 - i], 1e-6 * w.h.max_depth[last], "x = %g",
                  w.last.x[i]);
    CHECK_REL(w.h.worn[last], w.h.worn_b[last], 1e-9, "equal shares");
    assert_true(w.h.contact_to[last] > 1.5); /* wider than the zone at first */
    worn_free(&w);
}

/* Error bars hold the table's depths. */
TEST(strokes_have_error_bars)
{
    const rb_rolling_case rc = cylinder(60, 2.4, 0.5);
    const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                  .coefficient = 1e-9,
                                  .share = 0.5,
                                  .way = 1.0 / (rc.a.radius * 1e-9 * rc.load * rc.shift),
                                  .steps = 6,
                                  .increments = 1};
    worn w;
    CHECK_OK(rb_rolling_wear_with_errors(&rc, &wear, NULL, &w.h, &w.last, &message));
    const double R = rc.a.radius;
    CHECK_ABS(w.h.max_depth[6] * R, 0.7925, w.h.errors->max_depth[6] * R + 1e-3, "A");
    CHECK_ABS(w.h.max_depth_b[6] * R, 0.7405, w.h.errors->max_depth_b[6] * R + 1e-3, "B");
    CHECK_MAX(w.h.errors->max_depth[6] * R, 0.1, "bar");
    worn_free(&w);
}

TEST(what_strokes_are_refused)
{
    const rb_rolling_wear wear = {.law = RB_WEAR_ARCHARD,
                                  .coefficient = 1e-9,
                                  .share = 0.5,
                                  .way = 10.0,
                                  .steps = 2,
                                  .increments = 1};
    rb_rolling_wear_history h;
    rb_rolling_solution last;
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = cylinder(40, 2.0, k == 1 ? 5.6 : 0.3);
        const double x[] = {-1.0, 0.0, 1.0}, depth[] = {0.0, 1e-5, 0.0};
        static const char *const says[] = {"two cylinders", "half-widths, at most 5", "--worn", ""};
        if (k == 0)
            rc.b.radius = 3.0 * rc.a.radius;
        if (k == 2)
            rc.worn = (rb_rolling_table){3, x, depth};
        const rb_status s = rb_rolling_wear_run(&rc, &wear, NULL, &h, &last, &message);
        CHECK_ABS(s, k < 3 ? RB_EINVAL : RB_OK, 0, "%d: %s", k, message.text);
        if (k < 3)
            assert_non_null(strstr(message.text, says[k]));
        rb_rolling_wear_history_free(&h);
        rb_rolling_solution_free(&last);
    }
}

RUN_TESTS(NULL, NULL)
