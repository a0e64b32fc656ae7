/* What fretting does to the surfaces in one cycle: the closed forms of Cattaneo's contact under a
 * reversing force (Q1), identities between bodies, signs and loads, and what is refused. */
#include "cases.h"
#include "check.h"
#include "random_case.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

#define STEEL "support halfplane gap parabola young 210000 poisson 0.3 radius 100 mu 0.5 load 500 "

static const double reverses[] = {0.0, 0.6, -0.6, 0.6}, twice[] = {0.0, 0.6, -0.6, 0.6, -0.6, 0.6};

static void run(const rb_rolling_case *rc, const rb_rolling_program *program,
                rb_rolling_solution *s)
{
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_history) h;
    rb_rolling_case frets = *rc;
    frets.fretting = 1;
    CHECK_OK(rb_rolling_history_run(&frets, program, NULL, &model, &h, &message));
    CHECK_OK(rb_rolling_model_solution(&model, s, &message));
    if (h.cycle_rows > 0)
        CHECK_REL(s->fretting.work, h.cycle_work, 1e-12, "work of the cycle");
}

static void run_reversal(const rb_rolling_case *rc, rb_rolling_solution *s)
{
    run(rc, &(rb_rolling_program){.n = 4, .force_ratio = reverses}, s);
}

/* ---- Cattaneo and Mindlin ---------------------------------------------------------- */

/* Similar bodies, r = Q/(mu P): slip in c < |x| < a, with the distance s from one end of the cycle
 * to the other. */
TEST(cattaneo_in_closed_form)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 400");
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const double a = d.half_width, p0 = d.stress, c = a * sqrt(0.4), bound = 0.5 * p0;
    OWNED(rb_rolling_solution) s;
    run_reversal(&rc, &s);
    CHECK_REL(p0, 428.53275, 1e-7, "p0");
    CHECK_REL(s.fretting.work, 0.0368862, 1e-4, "work");
    CHECK_REL(s.fretting.fretting_work.value, 0.114359, 2e-4, "largest work");
    CHECK_REL(s.fretting.fretting_work.at / a, 0.9138, 2e-3, "its place");
    CHECK_REL(s.fretting.ruiz_1.value, 0.0571796, 2e-4, "largest Ruiz 1");
    CHECK_REL(s.fretting.ruiz_2.value, 9.60785, 3e-3, "largest Ruiz 2");
    CHECK_REL(s.fretting.ruiz_2.at / a, 0.9681, 5e-3, "its place");
    CHECK_REL(s.fretting.swt.value, 0.477465, 2e-4, "SWT at the edge");
    CHECK_REL(s.fretting.swt.at / a, 1.0, 1e-4, "its place");
    CHECK_REL(s.fretting.tresca_shear.value, 165.9700, 2e-4, "largest shear");
    for (int i = 0; i < s.n; i++) {
        const double x = fabs(s.x[i]), p = p0 * sqrt(fmax(0.0, 1.0 - gsl_pow_2(x / a)));
        if (x < 0.98 * c) {
            assert_true(s.fretting_work[i] == 0.0 && s.slip_range[i] == 0.0);
            CHECK_ABS(s.tension[i], -p, 3e-3 * p0, "in stick at %g a", x / a);
        }
        if (x < 1.02 * c || x > 0.98 * a)
            continue;
        const double root = sqrt(x * x - c * c),
                     slip = 2.0 * bound / (d.modulus * a) * (x * root - c * c * acosh(x / c)),
                     tension = -p + 2.0 * bound * root / a,
                     strain = 2.0 * bound * root / a * 0.91 / 210000.0;
        CHECK_ABS(s.slip_range[i], slip, 3e-6, "slip at %g a", x / a);
        CHECK_ABS(s.fretting_work[i], 2.0 * 0.5 * p * slip, 4e-4, "work at %g a", x / a);
        CHECK_ABS(s.ruiz_1[i], 0.5 * p * slip, 2e-4, "Ruiz 1 at %g a", x / a);
        CHECK_ABS(s.tension[i], tension, 1.0, "tension at %g a", x / a);
        CHECK_ABS(s.ruiz_2[i], fmax(tension, 0.0) * 0.5 * p * slip, 0.04, "Ruiz 2 at %g a", x / a);
        /* the strain goes from one sign of the friction to the other */
        CHECK_ABS(s.swt[i], fmax(tension, 0.0) * strain, 2e-3, "SWT at %g a", x / a);
        CHECK_REL(s.tresca_shear[i], bound * sqrt(0.6), 2e-3, "shear at %g a", x / a);
    }
    for (int i = 0; i < s.n; i++) { /* alike bodies, and a force that reverses */
        CHECK_ABS(s.tension_b[i], s.tension[i], 1e-7, "tension in B");
        CHECK_ABS(s.swt_b[i], s.swt[i], 1e-9, "SWT in B");
        CHECK_ABS(s.fretting_work[i], s.fretting_work[s.n - 1 - i], 1e-9, "on either side");
    }
}

/* At the edge the stress has one component: (2 mu p0)^2 r over the modulus of the plane. */
TEST(thin_discs_have_their_own_strain)
{
    rb_rolling_case rc = rolling_case(STEEL "similar plane stress contact-elements 200");
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    OWNED(rb_rolling_solution) s;
    run_reversal(&rc, &s);
    CHECK_REL(s.fretting.swt.value, gsl_pow_2(d.stress) * 0.6 / 210000.0, 5e-4, "SWT");
}

/* ---- Identities -------------------------------------------------------------------- */

/* B's of a pair are A's of the exchanged one whose force is the opposite; the cycle goes twice,
 * for the first time does not close between unlike bodies. */
TEST(bodies_change_places)
{
    rb_rolling_case rc = rolling_case(STEEL "young-b 70000 poisson-b 0.33 contact-elements 60"),
                    other = rc;
    double opposite[6];
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_solution) t;
    for (int k = 0; k < 6; k++)
        opposite[k] = -twice[k];
    other.a.young = rc.b.young;
    other.a.poisson = rc.b.poisson;
    other.b.young = rc.a.young;
    other.b.poisson = rc.a.poisson;
    run(&rc, &(rb_rolling_program){.n = 6, .force_ratio = twice}, &s);
    run(&other, &(rb_rolling_program){.n = 6, .force_ratio = opposite}, &t);
    CHECK_REL(s.fretting.work, t.fretting.work, 1e-9, "work");
    assert_true(fabs(s.fretting.swt.value - s.fretting.swt_b.value) > 0.1);
    for (int i = 0; i < s.n; i++) {
        CHECK_ABS(t.fretting_work[i], s.fretting_work[i], 1e-9, "work");
        CHECK_ABS(t.slip_range[i], s.slip_range[i], 1e-11, "slip range");
        CHECK_ABS(t.tension[i], s.tension_b[i], 1e-6, "tension");
        CHECK_ABS(t.swt_b[i], s.swt[i], 1e-9, "SWT");
        CHECK_ABS(t.ruiz_2[i], s.ruiz_2_b[i], 1e-7, "Ruiz 2");
        CHECK_ABS(t.tresca_shear_b[i], s.tresca_shear[i], 1e-6, "shear");
    }
}

/* The same stress along both bodies, which does not change in the cycle, strains them alike. */
TEST(a_constant_bulk_stress_adds_itself)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 60"), pulled = rc;
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_solution) t;
    pulled.bulk_stress = pulled.bulk_stress_b = 80.0;
    run_reversal(&rc, &s);
    run_reversal(&pulled, &t);
    for (int i = 0; i < s.n; i++) {
        CHECK_ABS(t.slip_range[i], s.slip_range[i], 1e-11, "slip range");
        CHECK_ABS(t.tension[i], s.tension[i] + 80.0, 1e-6, "tension");
        CHECK_ABS(t.tension_b[i], s.tension_b[i] + 80.0, 1e-6, "tension in B");
        if (s.tension[i] > 0.0)
            CHECK_REL(t.swt[i], s.swt[i] * (s.tension[i] + 80.0) / s.tension[i], 1e-6, "SWT");
    }
}

/* Bulk stress in phase with the force, X/(mu p0) = 1 in B: work of a closed cycle by other means
 * (fretting.md 1), and a tension in B that A does not have. */
TEST(bulk_stress_in_phase_works_more)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 100 increments 25");
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const double X = 0.5 * d.stress, ratio[] = {0.0, 0.6, 0.0, -0.6, 0.0, 0.6, 0.0, -0.6, 0.0, 0.6},
                 bulk[] = {0.0, X, 0.0, -X, 0.0, X, 0.0, -X, 0.0, X};
    OWNED(rb_rolling_solution) s;
    run(&rc, &(rb_rolling_program){.n = 10, .force_ratio = ratio, .bulk_stress_b = bulk}, &s);
    CHECK_REL(s.fretting.work / (gsl_pow_2(0.5 * d.stress) * gsl_pow_2(d.half_width) / d.modulus),
              0.40368, 1e-2, "work");
    assert_true(s.fretting.swt_b.value > 1.5 * s.fretting.swt.value);
}

/* A layer of the base's own material is no layer. */
TEST(a_layer_of_the_same_material)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 40"), layered = rc;
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_solution) t;
    layered.a.layer = 0.5;
    layered.a.base_young = rc.a.young;
    layered.a.base_poisson = rc.a.poisson;
    run_reversal(&rc, &s);
    run_reversal(&layered, &t);
    CHECK_REL(t.fretting.work, s.fretting.work, 1e-8, "work");
    for (int i = 0; i < s.n; i++) {
        CHECK_ABS(t.tension[i], s.tension[i], 1e-4, "tension");
        CHECK_ABS(t.swt[i], s.swt[i], 1e-6, "SWT");
    }
}

/* A cylinder that is held by an arc, a/R = 7e-4: half-planes to a part of that order, but for the
 * edges, which a force shifts. */
TEST(on_a_cylinder)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 100 load 5"), wheel = rc;
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_solution) t;
    wheel.a.support = RB_BEM_ARC;
    run_reversal(&rc, &s);
    run(&wheel, &(rb_rolling_program){.n = 6, .force_ratio = twice}, &t);
    CHECK_REL(t.fretting.work, s.fretting.work, 0.01, "work");
    CHECK_REL(t.fretting.swt.value, s.fretting.swt.value, 0.03, "SWT");
    CHECK_REL(t.fretting.swt_b.value, s.fretting.swt.value, 0.03, "SWT in B");
    CHECK_REL(t.fretting.tresca_shear.value, s.fretting.tresca_shear.value, 0.01, "shear");
}

/* ---- The cycle --------------------------------------------------------------------- */

/* The last one counts, and what stands before it does not. */
TEST(the_last_cycle_counts)
{
    static const double larger[] = {0.0, 0.9, -0.9, 0.9, 0.6, -0.6, 0.6, -0.6, 0.6};
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 60");
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_solution) t;
    run(&rc, &(rb_rolling_program){.n = 9, .force_ratio = larger}, &s);
    run_reversal(&rc, &t);
    CHECK_REL(s.fretting.work, t.fretting.work, 1e-9, "work");
    CHECK_REL(s.fretting.slip_range.value, t.fretting.slip_range.value, 1e-9, "slip range");
    assert_true(s.fretting_work[0] == 0.0 && s.tension[0] > 0.0);
}

TEST(what_has_no_cycle_is_refused)
{
    static const double open[] = {0.0, 0.6, -0.6, 0.5}, half[] = {0.0, 0.6, 0.0, -0.6, 0.0};
    static const struct {
        const char *words;
        rb_rolling_program program;
        const char *says;
    } bad[] = {
        {"similar", {.n = 4, .force_ratio = open}, "end with no cycle"},
        {"similar", {.n = 5, .force_ratio = half}, "does not close"},
        {"young-b 70000 poisson-b 0.33", {.n = 4, .force_ratio = reverses}, "from row 2"},
        {"similar mu 0", {.n = 1, .force_ratio = open}, "nothing frets"},
        {"similar formulation transient", {.n = 1, .force_ratio = open}, "what rolls has no cycle"},
        {"similar relaxation-time 1 relaxation-ratio 1",
         {.n = 4, .force_ratio = reverses},
         "it needs elastic bodies"},
        {"period 20", {.n = 4, .force_ratio = reverses}, "without --period"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        rb_rolling_case rc = rolling_case(STEEL "contact-elements 30 fretting");
        set(&rc, "%s", bad[k].words);
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_model) model;
        CHECK_SAYS(rb_rolling_history_run(&rc, &bad[k].program, NULL, &model, &h, &message),
                   RB_EINVAL, bad[k].says);
    }
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 30 fretting");
    static const int rows[][2] = {{0, 3}, {3, 3}, {4, 2}, {2, 5}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_model) model;
        rc.cycle_from = rows[k][0];
        rc.cycle_to = rows[k][1];
        CHECK_SAYS(rb_rolling_history_run(&rc,
                                          &(rb_rolling_program){.n = 4, .force_ratio = reverses},
                                          NULL, &model, &h, &message),
                   RB_EINVAL, "two rows of the history, 1 to 4");
        assert_string_equal(message.about, "cycle");
    }
}

/* The rows between which it lies; a smaller one behind a larger one is as if that had not been. */
TEST(a_cycle_of_given_rows)
{
    static const double all[] = {0.0, 0.6, -0.6, 0.6, -0.3, 0.6, 0.1},
                        small[] = {0.0, 0.6, -0.3, 0.6};
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 60");
    for (int k = 0; k < 2; k++) {
        OWNED(rb_rolling_solution) s;
        OWNED(rb_rolling_solution) t;
        rc.cycle_from = rc.cycle_to = 0;
        run(&rc, &(rb_rolling_program){.n = 4, .force_ratio = k ? small : reverses}, &t);
        rc.cycle_from = k ? 4 : 2;
        rc.cycle_to = k ? 6 : 4;
        run(&rc, &(rb_rolling_program){.n = 7, .force_ratio = all}, &s);
        for (int i = 0; i < rb_rolling_solution_scalars.n; i++) {
            const rb_rolling_result *r = &rb_rolling_solution_scalars.row[i];
            const double want = rb_rolling_number(r, &t);
            if (r->condition == RB_FOR_FRETTING && r->error_bar)
                CHECK_ABS(rb_rolling_number(r, &s), want, 1e-6 * want, "cycle %d: %s", k, r->name);
        }
    }
    rc.cycle_from = 3;
    rc.cycle_to = 5;
    rc.fretting = 1;
    OWNED(rb_rolling_history) h;
    OWNED(rb_rolling_model) model;
    CHECK_SAYS(rb_rolling_history_run(&rc, &(rb_rolling_program){.n = 7, .force_ratio = all}, NULL,
                                      &model, &h, &message),
               RB_EINVAL, "from row 3 of the history to row 5 does not close");
}

/* ---- Error bars -------------------------------------------------------------------- */

/* Alike and unlike bodies, rigid planes, layers; loads and bulk stresses that go with the force. */
static void random_cycle(random_case *c, rb_rolling_case *rc, rb_rolling_program *program,
                         double column[3][12])
{
    const double young = random_log(c, 1e3, 2e5), load = young * random_log(c, 1e-4, 2e-2);
    const int kind = random_choice(c, 4), varies = !random_choice(c, 3),
              pulls = kind < 2 && !random_choice(c, 3), n = 10;
    const double ratio[] = {random_between(c, 0.2, 0.85), random_between(c, -0.85, -0.2)};
    random_add(c, "support halfplane gap parabola young %.6g poisson %.4g radius %.5g mu %.4g",
               young, random_between(c, 0.0, 0.49), random_log(c, 3.0, 300.0),
               random_log(c, 0.1, 0.8));
    if (kind == 1)
        random_add(c, " young-b %.6g poisson-b %.4g", young * random_log(c, 0.3, 3.0),
                   random_between(c, 0.0, 0.49));
    else if (kind != 2)
        random_add(c, " similar");
    if (kind == 3)
        random_add(c, " layer-thickness %.4g base-young %.6g base-poisson 0.3",
                   random_log(c, 0.1, 10.0), young * random_log(c, 0.3, 10.0));
    random_add(c, " contact-elements %d", 40 + random_choice(c, 40));
    *rc = rolling_case("%s", c->line);
    rc->fretting = 1;
    const double X = pulls ? random_between(c, -0.3, 0.3) * sqrt(load * young / 300.0) : 0.0;
    for (int k = 0; k < n; k++) {
        column[0][k] = load * (k == 0 || k % 2 ? 1.0 : 1.0 - 0.3 * varies);
        column[1][k] = k == 0 ? 0.0 : ratio[k % 2 == 0];
        column[2][k] = X * column[1][k];
    }
    *program = (rb_rolling_program){.n = n,
                                    .load = column[0],
                                    .force_ratio = column[1],
                                    .bulk_stress = pulls ? column[2] : NULL};
}

/* They hold the difference from four times the elements: of a hundred cases all but one in a
 * hundred.  A cycle that does not close within these rows has none, nor has one whose force is not
 * found. */
TEST(error_bars_hold)
{
    enum { CASES = 100, TURNS = 25 };
    int bars = 0, missed = 0;
    for (int k = 0; k < CASES; k++) {
        random_case c = {.state = (uint64_t)(k + 1) * 0x9e3779b97f4a7c15u};
        double column[3][12];
        rb_rolling_program program;
        rb_rolling_case rc;
        if (!is_in_turn(k, TURNS))
            continue;
        random_cycle(&c, &rc, &program, column);
        OWNED(rb_rolling_model) coarse;
        OWNED(rb_rolling_model) fine = {0};
        OWNED(rb_rolling_history) h;
        OWNED(rb_rolling_history) g = {0};
        OWNED(rb_rolling_solution) s = {0};
        OWNED(rb_rolling_solution) t = {0};
        rb_rolling_errors errors;
        if (rb_rolling_history_with_errors(&rc, &program, NULL, &coarse, &h, &message) != RB_OK)
            continue;
        rc.contact_elements = 4 * rc.contact_elements + 1;
        if (rb_rolling_history_run(&rc, &program, NULL, &fine, &g, &message) != RB_OK)
            continue;
        CHECK_OK(rb_rolling_model_solution(&coarse, &s, &message));
        CHECK_OK(rb_rolling_model_solution(&fine, &t, &message));
        assert_true(rb_rolling_errors_of_cycle(&h, &errors));
        assert_true(isnan(errors.scalar.normal_load));
        for (int i = 0; i < rb_rolling_solution_scalars.n; i++) {
            const rb_rolling_result *r = &rb_rolling_solution_scalars.row[i];
            const double value = rb_rolling_number(r, &s), want = rb_rolling_number(r, &t),
                         bar = rb_rolling_number(r, &errors.scalar);
            if ((r->condition != RB_FOR_FRETTING && r->condition != RB_FOR_FRETTING_B) ||
                !r->error_bar || isnan(value))
                continue;
            bars++;
            if (!(fabs(value - want) <= bar)) {
                print_message("case %d, %s: %s = %.5g +- %.2g, %.5g\n", k, c.line, r->name, value,
                              bar, want);
                missed++;
            }
        }
    }
    print_message("%d of %d bars missed\n", missed, bars);
    assert_true(bars >= 10);
    CHECK_MAX(missed, 1.0 + 0.01 * bars, "bars that do not hold");
}

/* Without the cycle a solution of such a case has nothing of it. */
TEST(without_a_history_there_is_nothing)
{
    rb_rolling_case rc = rolling_case(STEEL "similar contact-elements 30 fretting");
    OWNED(rb_rolling_solution) s;
    CHECK_OK(rb_rolling_solve(&rc, &s, &message));
    assert_true(isnan(s.fretting.work) && isnan(s.fretting_work[3]) && isnan(s.swt_b[3]));
    rc.fretting = 0;
    OWNED(rb_rolling_solution) t;
    CHECK_OK(rb_rolling_solve(&rc, &t, &message));
    assert_null(t.fretting_work);
    assert_null(t.swt_b);
}

RUN_TESTS(NULL, NULL)
