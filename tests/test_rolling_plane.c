/* Plane stress: the formulas of plane strain with nu/(1 + nu) and the same shear modulus
 * (theory.md B2), in every kind of body. */
#include "cases.h"
#include "refused.h"
#include "solved.h"

/* The constants of plane strain that a thin disc of E and nu has. */
static void set_equivalent(double *young, double *poisson)
{
    *young *= (1.0 + 2.0 * *poisson) / pow(1.0 + *poisson, 2.0);
    *poisson /= 1.0 + *poisson;
}

static rb_rolling_case in_plane_strain(rb_rolling_case rc)
{
    rc.plane = RB_PLANE_STRAIN;
    set_equivalent(&rc.a.young, &rc.a.poisson);
    set_equivalent(&rc.b.young, &rc.b.poisson);
    set_equivalent(&rc.a.base_young, &rc.a.base_poisson);
    set_equivalent(&rc.a.core_young, &rc.a.core_poisson);
    return rc;
}

static rb_rolling_case thin_disc(rb_bem_support support)
{
    rb_rolling_case rc =
        rolling_case("plane stress poisson 0.35 young-b 200000 poisson-b 0.28 half-width 0.5 "
                     "contact-elements 30 mesh fitted formulation steady creep-ratio 0.4");
    rc.a.support = support;
    return rc;
}

static void check_equivalent(const rb_rolling_case *rc, const char *name)
{
    const rb_rolling_case strain = in_plane_strain(*rc);
    OWNED(rb_rolling_solution) one = solved(rc), other = solved(&strain);
    assert_int_equal(one.n, other.n);
    CHECK_REL(one.normal_load, other.normal_load, 1e-12, "%s: load", name);
    for (int i = 0; i < one.n; i++) {
        CHECK_ABS(one.p[i] / one.max_pressure, other.p[i] / one.max_pressure, 1e-9,
                  "%s: p of element %d", name, i);
        CHECK_ABS(one.q[i] / one.max_pressure, other.q[i] / one.max_pressure, 1e-9,
                  "%s: q of element %d", name, i);
        CHECK_ABS(one.un[i] / one.approach, other.un[i] / one.approach, 1e-9,
                  "%s: un of element %d", name, i);
    }
}

TEST(every_body_has_the_constants_of_plane_stress)
{
    rb_rolling_case rc = thin_disc(RB_BEM_HALFPLANE);
    check_equivalent(&rc, "half-plane");
    rc.a.layer = 0.7;
    check_equivalent(&rc, "layer");
    set(&rc, "base-young 20000 base-poisson 0.2");
    check_equivalent(&rc, "layer on an elastic base");
    rc = thin_disc(RB_BEM_ARC);
    check_equivalent(&rc, "arc");
    rc = thin_disc(RB_BEM_HUB);
    check_equivalent(&rc, "hub");
    rc.a.cover = 5.0;
    check_equivalent(&rc, "cover");
    set(&rc, "core-young 210000 core-poisson 0.3");
    check_equivalent(&rc, "cover on an elastic core");
    rc = thin_disc(RB_BEM_HUB);
    set(&rc, "relaxation-time 0.01 relaxation-ratio 2 speed 100");
    check_equivalent(&rc, "relaxing hub");
}

/* 1/E* = 1/E_A + 1/E_B, whatever Poisson's ratios are, and twice the Dundurs' constant of
 * plane stress is E* [(1 - nu_A)/E_A - (1 - nu_B)/E_B]. */
TEST(a_thin_disc_is_as_stiff_as_its_young_modulus)
{
    const rb_rolling_case rc = thin_disc(RB_BEM_HALFPLANE);
    const rb_rolling_derived d = rb_rolling_derive(&rc);
    const double E = 1.0 / (1.0 / 94500.0 + 1.0 / 200000.0);
    CHECK_REL(d.modulus, E, 1e-14, "E*");
    CHECK_REL(d.dundurs, 0.5 * E * (0.65 / 94500.0 - 0.72 / 200000.0), 1e-13, "beta");
    CHECK_REL(d.load, acos(-1.0) * E * 0.25 / (4.0 * 50.0), 1e-14, "Hertz's load");
}

/* sxx, syy, sxy follow from the tractions alone, whatever the plane problem is; the third
 * one is nu (sxx + syy) or 0. */
TEST(nothing_presses_a_thin_disc_from_its_side)
{
    for (int plane = 0; plane < 2; plane++) {
        rb_rolling_case rc = thin_disc(RB_BEM_HALFPLANE);
        rc.plane = plane ? RB_PLANE_STRESS : RB_PLANE_STRAIN;
        OWNED(rb_rolling_model) model = solved_model(&rc);
        const double xy[] = {0.0, 0.3, 0.4, 0.2};
        rb_rolling_stress at[2];
        CHECK_OK(rb_rolling_stress_at(&model, 2, xy, at, NULL));
        for (int k = 0; k < 2; k++) {
            CHECK_ABS(at[k].szz, plane ? 0.0 : 0.35 * (at[k].sxx + at[k].syy), 1e-9,
                      "szz of point %d", k);
            CHECK_REL(
                at[k].von_mises,
                sqrt(0.5 * (pow(at[k].sxx - at[k].syy, 2.0) + pow(at[k].syy - at[k].szz, 2.0) +
                            pow(at[k].szz - at[k].sxx, 2.0)) +
                     3.0 * at[k].sxy * at[k].sxy),
                1e-12, "von Mises of point %d", k);
        }
    }
}

/* No residual stress changes the pressure at the surface, and none acts across a disc:
 * p0/k = 2.  Where friction decides at the surface the disc bears less than plane strain. */
TEST(a_thin_disc_shakes_down_below_two_k)
{
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = thin_disc(RB_BEM_HALFPLANE);
        rb_rolling_shakedown limit[2];
        set(&rc, "mu %g creep-ratio nan creep %g", k ? 0.3 : 0.0, k ? -1.0 : 0.0);
        for (int plane = 0; plane < 2; plane++) {
            rc.plane = plane ? RB_PLANE_STRESS : RB_PLANE_STRAIN;
            OWNED(rb_rolling_model) model = solved_model(&rc);
            CHECK_OK(rb_rolling_shakedown_find(&model, &limit[plane], NULL));
            rb_rolling_shakedown again = limit[plane];
            again.shear_yield = NAN;
            CHECK_OK(rb_rolling_shakedown_at(&model, &again, NULL));
            CHECK_REL(again.shear_yield, limit[plane].shear_yield, 1e-12, "again");
            if (k == 0 && plane == 1) {
                CHECK_REL(limit[1].shear_yield, 0.5 * rb_rolling_derive(&rc).stress, 5e-3, "p0/2");
                CHECK_ABS(limit[1].y, 0.0, 1e-12, "at the surface");
            }
        }
        assert_true(limit[1].shear_yield / rb_rolling_derive(&rc).stress > 0.49);
    }
}

/* A thin disc of nu = 1/2 can be compressed in its plane, a long body cannot. */
TEST(what_is_compressible_depends_on_the_plane)
{
    ACCEPTED(rc.plane = RB_PLANE_STRESS, HUB, rc.a.cover = 5.0, rc.a.core_young = 1e5,
             rc.a.poisson = 0.5);
    ACCEPTED(HUB, rc.a.cover = 5.0, rc.a.core_young = 1e5, rc.a.poisson = 0.5);
    ACCEPTED(rc.a.poisson = -0.6);
    ACCEPTED(rc.plane = RB_PLANE_STRESS, rc.a.poisson = -0.49);
    REFUSED("(-0.5, 0.5] in plane stress", rc.plane = RB_PLANE_STRESS, rc.a.poisson = -0.5);
    REFUSED("base-poisson: expected in (-0.5", rc.plane = RB_PLANE_STRESS, PLANE, rc.a.layer = 1.0,
            rc.a.base_young = 1e5, rc.a.base_poisson = -0.6);
}

RUN_TESTS(NULL, NULL)
