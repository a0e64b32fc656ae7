/* Finite cylinders by boundary elements: they tend to the half-plane as a/R falls, in
 * both supports; where they differ from it; the case of *Addi* (theory.md 4.3, 6, 7).
 * The measured figures stand in docs/library.md. */
#include "cases.h"
#include "rolling/case/closed_forms.h"
#include "rolling/rolling.h"
#include "solved.h"

#include <gsl/gsl_math.h>

static const rb_bem_support wheels[] = {RB_BEM_ARC, RB_BEM_HUB};

static const char *name_of(rb_bem_support support)
{
    return support == RB_BEM_ARC ? "arc" : support == RB_BEM_HUB ? "hub" : "halfplane";
}

/* nu = 1/2 on a rigid plane, steady, s = 0.4: Carter's case on a wheel. */
static rb_rolling_case wheel(rb_bem_support support, double ratio)
{
    rb_rolling_case rc =
        rolling_case("poisson 0.5 half-width %g formulation steady creep-ratio 0.4", 50.0 * ratio);
    rc.a.support = support;
    return rc;
}

static rb_rolling_solution valid(const rb_rolling_case *rc)
{
    rb_rolling_solution s = solved(rc);
    CHECK_MAX(s.residual, 1e-10, "residual, %s", name_of(rc->a.support));
    for (int i = 0; i < s.n; i++) {
        CHECK_MAX(-s.p[i], 0.0, "adhesion at %d", i);
        CHECK_MAX(fabs(s.q[i]), rc->mu * s.p[i] + 1e-10 * s.max_pressure, "Coulomb at %d", i);
        CHECK_MAX(s.p[i] > 0.0 ? fabs(s.gap[i]) : -s.gap[i], 1e-10 * s.half_width, "gap at %d", i);
    }
    return s;
}

/* Root mean square over the contact of what differs, p in p0 and q in mu p0. */
typedef struct {
    double p, q;
} distance;

static distance between(const rb_rolling_case *rc, const rb_rolling_solution *s,
                        const rb_rolling_solution *want)
{
    distance d = {0.0, 0.0};
    assert_int_equal(s->n, want->n);
    for (int i = 0; i < s->n; i++) {
        d.p += gsl_pow_2((s->p[i] - want->p[i]) / want->max_pressure);
        d.q += gsl_pow_2((s->q[i] - want->q[i]) / (rc->mu * want->max_pressure));
    }
    d.p = sqrt(d.p / want->contact);
    d.q = sqrt(d.q / want->contact);
    return d;
}

/* The same potential contact for every support. */
static distance from_halfplane(rb_rolling_case rc)
{
    rc.zone = 1.3 * rc.half_width;
    OWNED(rb_rolling_solution) s = valid(&rc);
    rc.a.support = RB_BEM_HALFPLANE;
    OWNED(rb_rolling_solution) want = valid(&rc);
    const distance d = between(&rc, &s, &want);
    return d;
}

TEST(tractions_tend_to_the_halfplane_with_first_order)
{
    for (int k = 0; k < 2; k++) {
        distance last = from_halfplane(wheel(wheels[k], 1e-3));
        for (double ratio = 1e-4; ratio > 1e-7; ratio *= 0.1) {
            const distance d = from_halfplane(wheel(wheels[k], ratio));
            CHECK_ABS(last.p / d.p, 10.0, 0.5, "p, %s, a/R = %g", name_of(wheels[k]), ratio);
            CHECK_ABS(last.q / d.q, 10.0, 0.5, "q, %s, a/R = %g", name_of(wheels[k]), ratio);
            CHECK_MAX(d.p, 4.0 * ratio, "p, %s, a/R = %g", name_of(wheels[k]), ratio);
            CHECK_MAX(d.q, 6.0 * ratio, "q, %s, a/R = %g", name_of(wheels[k]), ratio);
            last = d;
        }
    }
}

/* With nu < 1/2 pressure also stretches the surface, and constant elements see a stretch
 * only to first order: what is left at a/R -> 0 falls with all elements. */
TEST(compressible_wheels_need_small_elements_too)
{
    for (int k = 0; k < 2; k++) {
        double last = 0.0;
        for (int fine = 1; fine <= 4; fine *= 2) {
            rb_rolling_case rc = wheel(wheels[k], 1e-5);
            set(&rc, "poisson 0.3 poisson-b 0.3 contact-elements %d outer-elements %d", 39 * fine,
                75 * fine);
            rc.elastic_b = 1;
            const distance d = from_halfplane(rc);
            CHECK_MAX(d.q, 1e-2, "q, %s", name_of(wheels[k]));
            if (fine > 1)
                CHECK_MAX(d.q, last / 1.6, "q, %s, %d times as fine", name_of(wheels[k]), fine);
            last = d.q;
        }
    }
}

/* Aluminium on steel (theory-solvers.md 6), both of them wheels, mu -> infinity. */
static double bentall_johnson_error(rb_bem_support support, int elements)
{
    rb_rolling_case rc = with(wheel(support, 2e-5), "young 60260 poisson 0.31");
    rc.b = rc.a;
    set(&rc,
        "young-b 209920 poisson-b 0.28 gap parabola mesh fitted contact-elements %d mu 10 "
        "creep-ratio nan force 0",
        elements);
    OWNED(rb_rolling_solution) s = valid(&rc);
    const double modulus = rb_rolling_derive(&rc).modulus, R = rb_rolling_radius(&rc);
    const rb_closed_bentall_johnson want =
        rb_closed_bentall_johnson_stick(rb_rolling_derive(&rc).dundurs, rc.half_width, R, modulus);
    return fabs(s.creepage + want.creepage) / want.creepage;
}

/* Fitted meshes take the near field of every load exactly: what is left is the mesh of
 * the half-plane and the size of the wheel, a/R = 2e-5. */
TEST(bentall_johnson_on_two_wheels)
{
    for (int k = 0; k < 2; k++) {
        CHECK_MAX(bentall_johnson_error(wheels[k], 50), 5e-4, "%s", name_of(wheels[k]));
        CHECK_MAX(bentall_johnson_error(wheels[k], 100), 2e-4, "%s", name_of(wheels[k]));
    }
}

/* On equal elements too the exact near field leaves a compressible wheel nothing but its
 * size to differ from the half-plane by. */
TEST(the_exact_near_field_spares_the_small_elements)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = wheel(wheels[k], 1e-5);
        set(&rc, "poisson 0.3 poisson-b 0.3 near-field exact");
        rc.elastic_b = 1;
        CHECK_MAX(from_halfplane(rc).q, 1e-4, "q, %s", name_of(wheels[k]));
    }
}

/* delta = P (1 - nu^2)/(pi E) [2 ln(4R/a) - 1 + k]: k belongs to the support alone. */
static double support_constant(const rb_rolling_case *rc)
{
    OWNED(rb_rolling_solution) s = valid(rc);
    const double modulus = rb_rolling_derive(rc).modulus;
    return (s.approach - rb_closed_half_cylinder_approach(s.normal_load, rc->a.radius, modulus,
                                                          rc->half_width)) *
           M_PI * modulus / s.normal_load;
}

TEST(approach_differs_by_a_constant_of_the_support)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(wheel(wheels[k], 1e-4), "mesh fitted contact-elements 40");
        const double want = support_constant(&rc);
        for (double ratio = 1e-6; ratio > 1e-9; ratio *= 0.01) {
            rc.half_width = ratio * rc.a.radius;
            CHECK_ABS(support_constant(&rc), want, 1e-4, "%s, a/R = %g", name_of(wheels[k]), ratio);
        }
    }
}

/* (B9) */
TEST(a_contact_of_1e_8_of_the_radius_keeps_its_digits)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(wheel(wheels[k], 1e-8), "mesh fitted contact-elements 50");
        OWNED(rb_rolling_solution) s = valid(&rc);
        CHECK_ABS(s.force_ratio, rb_closed_carter_force_ratio(0.4), 3e-4, "Carter, %s",
                  name_of(wheels[k]));
        CHECK_REL(s.max_pressure, rb_closed_hertz_max_pressure(s.normal_load, rc.half_width), 1e-3,
                  "p0, %s", name_of(wheels[k]));
        CHECK_REL(s.half_width, rc.half_width, 1e-3, "half-width, %s", name_of(wheels[k]));
        CHECK_MAX(s.load_error, 1e-10, "load, %s", name_of(wheels[k]));
    }
}

static double creepage_of_force(rb_rolling_case rc, double ratio, double *approach)
{
    set(&rc, "creep-ratio nan force-ratio %g", ratio);
    OWNED(rb_rolling_solution) s = valid(&rc);
    const double creepage = s.creepage;
    CHECK_ABS(s.force_ratio, ratio, 1e-10, "given force");
    *approach = s.approach;
    return creepage;
}

/* Braking and driving are mirror images about the creepage of free rolling, which is of
 * the order of (a/R)^2, that is of delta/R but for a logarithm (4.3). */
TEST(the_two_signs_mirror_up_to_delta_over_R)
{
    for (int k = 0; k < 2; k++) {
        double last_sum = 0.0, last_approach = 0.0;
        for (double ratio = 1e-1; ratio > 5e-4; ratio *= 0.1) {
            rb_rolling_case rc = with(wheel(wheels[k], ratio), "mesh fitted contact-elements 50");
            double approach;
            const double sum =
                creepage_of_force(rc, -0.64, &approach) + creepage_of_force(rc, 0.64, &approach);
            const double slope = sum / (approach / rc.a.radius);
            CHECK_ABS(slope, 0.7, 0.51, "%s, a/R = %g", name_of(wheels[k]), ratio);
            if (last_sum > 0.0)
                CHECK_ABS(log(last_sum / sum) / log(last_approach / approach), 1.1, 0.1,
                          "exponent, %s, a/R = %g", name_of(wheels[k]), ratio);
            last_sum = sum;
            last_approach = approach;
        }
    }
}

static double free_creepage(rb_rolling_case rc)
{
    OWNED(rb_rolling_solution) s = valid(&rc);
    return s.free_creepage;
}

/* The surface's strain under the load, which is all that free rolling then has: (a/R)^2
 * times a number of the support. */
TEST(free_rolling_of_an_incompressible_wheel)
{
    const double want[] = {0.4999, 0.8518};
    for (int k = 0; k < 2; k++)
        for (double ratio = 1e-2; ratio > 5e-5; ratio *= 0.1)
            CHECK_REL(free_creepage(wheel(wheels[k], ratio)) / gsl_pow_2(ratio), want[k], 2e-3,
                      "%s, a/R = %g", name_of(wheels[k]), ratio);
}

/* (4.3): the surface's own normals make a creepage delta/R of the approach. */
TEST(normals_of_the_surface_cost_a_creepage_of_delta_over_R)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = with(wheel(wheels[k], 1e-3), "contact-elements 100 mu 0.4");
        OWNED(rb_rolling_solution) flat, round;
        flat = valid(&rc);
        rc.normals = RB_BEM_NORMALS_SURFACE;
        round = valid(&rc);
        CHECK_REL(round.free_creepage - flat.free_creepage, flat.approach / rc.a.radius, 0.25, "%s",
                  name_of(wheels[k]));
        CHECK_ABS(-flat.force_ratio, 0.644, 3e-3, "obstacle, %s", name_of(wheels[k]));
        CHECK_ABS(-round.force_ratio, 0.630, 3e-3, "surface, %s", name_of(wheels[k]));
    }
}

/* They turn pressure into a part of Q and friction into a part of P. */
TEST(normals_of_the_surface_share_the_forces)
{
    rb_rolling_case rc = with(wheel(RB_BEM_HUB, 0.1), "normals surface");
    OWNED(rb_rolling_solution) s = solved(&rc);
    double p = 0.0;
    for (int i = 0; i < s.n; i++)
        p += s.p[i] * s.h[i];
    assert_true(fabs(p / s.normal_load - 1.0) > 1e-5);
    assert_int_equal(s.patches, 1);
    CHECK_REL(s.patch[0].normal_load, s.normal_load, 1e-12, "P of the one patch");
    CHECK_REL(s.patch[0].tangential_load, s.tangential_load, 1e-12, "its Q");
}

static double support_balance(rb_rolling_case rc, int outer, int fine)
{
    set(&rc, "contact-elements %d outer-elements %d", 30 * fine, outer * fine);
    OWNED(rb_rolling_solution) s = valid(&rc);
    return fabs(s.support_balance);
}

/* At least first order in the size of the elements: graded outside a small contact, equal
 * on the whole circle in Addi's case. */
TEST(the_support_carries_the_load)
{
    for (int k = 0; k < 4; k++) {
        rb_rolling_case rc = with(wheel(wheels[k % 2], 0.02), "poisson 0.3");
        if (k > 1) {
            rc = rb_rolling_case_defaults();
            rc.a.support = wheels[k % 2];
        }
        double last = INFINITY;
        for (int fine = 1; fine <= 4; fine *= 2) {
            const double balance = support_balance(rc, k > 1 ? 52 : 60, fine);
            CHECK_MAX(balance, fmin(1e-2 / fine, last / 2.0), "%s%s, %d times as fine",
                      name_of(wheels[k % 2]), k > 1 ? ", Addi" : "", fine);
            last = balance;
        }
    }
}

/* Contact and stick in units of R, at 120 elements. */
typedef struct {
    rb_bem_support support;
    double mu;
    rb_bem_normals normals;
    double contact_from, contact_to, stick_from, stick_to;
} zones;

TEST(the_case_of_addi)
{
    const zones want[] = {
        {RB_BEM_ARC, 0.3, RB_BEM_NORMALS_OBSTACLE, -0.52, 0.55, -0.21, 0.34},
        {RB_BEM_ARC, 0.1, RB_BEM_NORMALS_OBSTACLE, -0.54, 0.57, 0.06, 0.14},
        {RB_BEM_HUB, 0.3, RB_BEM_NORMALS_OBSTACLE, -0.66, 0.70, -0.62, 0.57},
        {RB_BEM_HUB, 0.1, RB_BEM_NORMALS_OBSTACLE, -0.66, 0.70, -0.61, 0.35},
        {RB_BEM_ARC, 0.3, RB_BEM_NORMALS_SURFACE, -0.69, 0.66, -0.18, 0.08},
        {RB_BEM_ARC, 0.1, RB_BEM_NORMALS_SURFACE, -0.68, 0.66, NAN, NAN},
        {RB_BEM_HUB, 0.3, RB_BEM_NORMALS_SURFACE, -0.79, 0.79, -0.65, 0.56},
        {RB_BEM_HUB, 0.1, RB_BEM_NORMALS_SURFACE, -0.79, 0.78, -0.34, 0.08},
    };

    for (size_t k = 0; k < sizeof want / sizeof *want; k++) {
        rb_rolling_case rc = rolling_case("mu %g contact-elements 120", want[k].mu);
        rc.a.support = want[k].support;
        rc.normals = want[k].normals;
        OWNED(rb_rolling_solution) s = valid(&rc);
        const double R = rc.a.radius, element = 1.5 * s.h[0] / R;
        CHECK_ABS(s.contact_from / R, want[k].contact_from, element, "case %zu", k);
        CHECK_ABS(s.contact_to / R, want[k].contact_to, element, "case %zu", k);
        CHECK_MAX(fabs(s.support_balance), 1e-3, "support, case %zu", k);
        if (isnan(want[k].stick_from)) {
            CHECK_MAX(s.stick, 2, "case %zu", k);
        } else {
            CHECK_ABS(s.stick_from / R, want[k].stick_from, element, "case %zu", k);
            CHECK_ABS(s.stick_to / R, want[k].stick_to, element, "case %zu", k);
        }
    }
}

/* Without a shift both halves of the contact are mirror images: p even, q odd. */
TEST(a_symmetric_case_has_a_symmetric_answer)
{
    const int mirrored[] = {[RB_ZONE_SEPARATED] = RB_ZONE_SEPARATED,
                            [RB_ZONE_STICK] = RB_ZONE_STICK,
                            [RB_ZONE_SLIP_NEGATIVE] = RB_ZONE_SLIP_POSITIVE,
                            [RB_ZONE_SLIP_POSITIVE] = RB_ZONE_SLIP_NEGATIVE};
    for (int k = 0; k < 16; k++) {
        rb_rolling_case rc = rolling_case("mesh %s", k & 2 ? "fitted" : "uniform");
        rc.a.support = wheels[k % 2];
        if (k & 4) {
            set(&rc, "young-b %g radius-b 80", 2.0 * rc.a.young);
            rc.b.support = wheels[k / 2 % 2];
        }
        set(&rc, "approach %g shift 0", k & 8 ? 0.02 : 5.0);
        OWNED(rb_rolling_solution) s = valid(&rc);
        const double bound = 1e-9 * s.max_pressure;
        for (int i = 0, j = s.n - 1; i < s.n; i++, j--) {
            CHECK_ABS(s.p[i], s.p[j], bound, "case %d: p of %d and %d", k, i, j);
            CHECK_ABS(s.q[i], -s.q[j], bound, "case %d: q of %d and %d", k, i, j);
            assert_int_equal(s.zone[i], mirrored[s.zone[j]]);
        }
    }
}

/* Its slip of (12) contradicts the state wherever it sticks; what solves for the slip
 * does not. */
TEST(slip_afterwards_contradicts_stick)
{
    rb_rolling_case rc = rolling_case("creep 0.1");
    rb_rolling_solution s = valid(&rc);
    assert_true(s.slip_violations >= s.stick);
    for (int i = 0; i + 1 < s.n; i++)
        if (s.zone[i] == RB_ZONE_STICK && s.zone[i + 1] == RB_ZONE_STICK)
            CHECK_ABS(s.slip[i], rc.creep, 1e-12, "element %d", i);
    rb_rolling_solution_free(&s);
    set(&rc, "formulation steady creep 0.01");
    s = valid(&rc);
    assert_true(s.stick > 0 && s.slipping > 0);
    assert_int_equal(s.slip_violations, 0);
    rb_rolling_solution_free(&s);
}

/* nu = 1/2 on a hub is the limit of nu -> 1/2, not a singular system. */
TEST(an_incompressible_wheel_on_a_hub)
{
    rb_rolling_case rc = wheel(RB_BEM_HUB, 0.01);
    rc.zone = 1.3 * rc.half_width;
    OWNED(rb_rolling_solution) s = valid(&rc);
    rc.a.poisson = 0.5 - 1e-7;
    OWNED(rb_rolling_solution) limit = valid(&rc);
    const distance d = between(&rc, &s, &limit);
    CHECK_MAX(d.p, 1e-6, "p");
    CHECK_MAX(d.q, 1e-5, "q");
    CHECK_REL(s.approach, limit.approach, 1e-6, "approach");
    CHECK_MAX(fabs(s.support_balance), 1e-3, "support");
}

/* A small arc gives way like a bonded punch, 2 P/(pi E*) ln(c2/c1) more at c1 than at c2; its
 * elements are as fine as it is, and become finer with all others.  Right at .1 and .2 degrees:
 * .027911 and .026335 mm, as dense systems of many elements find. */
TEST(a_small_arc_has_elements_of_its_own)
{
    static const struct {
        double arc, approach;
    } rows[] = {{1e-6, NAN}, {1e-3, NAN}, {0.1, 0.027911}, {0.2, 0.026335}};
    const double rate = 2.0 * 1000.0 * 0.75 / (M_PI * 210000.0);
    double found[4];
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        const rb_rolling_case rc = rolling_case(
            "young 210000 radius 50 gap parabola load 1000 mu 0 support arc poisson 0.5 arc %g",
            rows[k].arc);
        OWNED(rb_rolling_solution) s;
        rb_rolling_errors e;
        CHECK_OK(rb_rolling_solve_with_errors(&rc, &s, &e, &message));
        found[k] = s.approach;
        CHECK_MAX(s.boundary_elements, 500, "elements at %g degrees", rows[k].arc);
        if (k > 0)
            CHECK_ABS(found[k - 1] - found[k], rate * log(rows[k].arc / rows[k - 1].arc),
                      2e-3 * rate, "%g degrees", rows[k].arc);
        if (isnan(rows[k].approach))
            continue;
        CHECK_REL(s.approach, rows[k].approach, 1e-3, "%g degrees", rows[k].arc);
        CHECK_ABS(s.approach, rows[k].approach, e.scalar.approach, "bar");
        CHECK_MAX(e.scalar.approach, 3e-3 * s.approach, "bar");
    }
}

TEST(every_failed_allocation_is_reported)
{
    for (int fitted = 0; fitted < 2; fitted++) {
        rb_rolling_case rc = wheel(RB_BEM_HUB, 0.05);
        set(&rc, "contact-elements 10 outer-elements 16");
        if (fitted)
            set(&rc, "mesh fitted formulation steady creep-ratio 0.5 gap parabola");
        else
            set(&rc, "zone %g", 1.5 * rc.half_width);
        for (int count = 0, refused = 1; refused; count++) {
            OWNED(rb_rolling_solution) s;
            refused = REFUSED_FROM(count, rb_rolling_solve(&rc, &s, NULL));
        }
    }
}

/* The edges are found with few elements around the contact: the answer still has all of
 * them, and its mesh ends where its own contact does. */
TEST(many_outer_elements_fit_their_own_contact)
{
    rb_rolling_case rc = wheel(RB_BEM_HUB, 0.02);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) s;
    set(&rc, "poisson 0.28 mesh fitted contact-elements 40 outer-elements 610");
    CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, NULL));
    const double *ends = model.mesh.ends + (model.mesh.n - rc.contact_elements) / 2;
    const double h = ends[1] - ends[0];
    assert_true(s.boundary_elements > 610);
    assert_int_equal(model.rc->outer_elements, 610);
    CHECK_ABS(s.contact_from, ends[0], 0.5 * h, "left edge");
    CHECK_ABS(s.contact_to, ends[rc.contact_elements], 0.5 * h, "right edge");
}

RUN_TESTS(NULL, NULL)
