/* Several bonded layers (L6 to L8): compliance, contact, stress and bonds. */
#include "cases.h"
#include "bem/bem.h"
#include "cli_run.h"
#include "solved.h"

#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_gamma.h>

/* .1 mm of 400 GPa, .05 mm of 3 GPa, .3 mm of 70 GPa, on 210 GPa or on a rigid base. */
static const double hard_thickness[] = {.1, .05, .3}, hard_young[] = {400e3, 3e3, 70e3},
                    hard_poisson[] = {.2, .4, .33};
static const rb_bem_stack hard = {3, hard_thickness, hard_young, hard_poisson};

static void put_on(rb_rolling_body *body, const rb_bem_stack *stack)
{
    body->stack = stack;
    body->layer = stack->thickness[0];
    body->young = stack->young[0];
    body->poisson = stack->poisson[0];
}

static rb_bem_surface surface_of(const rb_bem_stack *stack, double base_young, double base_poisson)
{
    rb_bem_surface s =
        rb_bem_halfplane(rb_bem_material_from_young(stack->young[0], stack->poisson[0]), 30.0);
    s.thickness = stack->thickness[0];
    s.stack = stack;
    s.elastic_base = base_young > 0.0;
    if (s.elastic_base)
        s.base = rb_bem_material_from_young(base_young, base_poisson);
    return s;
}

/* Of a generator that is the same everywhere. */
static double between(double least, double most)
{
    static uint64_t numbers = 7;
    numbers = numbers * 6364136223846793005u + 1442695040888963407u;
    return least + (most - least) * ((double)(numbers >> 11) / 9007199254740992.0);
}

enum { STRIPS = 24, POINTS = 6, ENTRIES = 4 * STRIPS * POINTS };

static void displace(const rb_bem_surface *s, double W[ENTRIES])
{
    static const double x[POINTS] = {-2.0, -0.97, 0.03, 0.5, 40.0, 3e3};
    double ends[STRIPS + 1];
    for (int i = 0; i <= STRIPS; i++)
        ends[i] = -1.0 + 2.0 * i / STRIPS;
    memset(W, 0, ENTRIES * sizeof *W);
    CHECK_OK(rb_bem_surface_displacement(s, STRIPS, ends, POINTS, x, W));
}

static void check_alike(const rb_bem_surface *got, const rb_bem_surface *want, double factor,
                        double bound, const char *what)
{
    double a[ENTRIES], b[ENTRIES], most = 0.0, largest = 0.0;
    displace(got, a);
    displace(want, b);
    for (int i = 0; i < ENTRIES; i++) {
        most = fmax(most, fabs(a[i] - factor * b[i]));
        largest = fmax(largest, fabs(b[i]));
    }
    CHECK_MAX(most / largest, bound, "%s", what);
}

/* A layer cut into parts is the layer, also one of the base's material, which is a half-plane; E
 * times f: 1/f of the displacements. */
TEST(cut_layers_are_one)
{
    for (int k = 0; k < 12; k++) {
        const double d = exp(between(-2.0, 2.0)), E = exp(between(0.0, 4.0)),
                     nu = k == 3 ? 0.5 : between(-0.5, 0.5), part = between(0.1, 0.9),
                     base = k % 3 ? E * exp(between(-5.0, 5.0)) : 0.0;
        const double thickness[] = {part * d, 0.5 * (1.0 - part) * d, 0.5 * (1.0 - part) * d},
                     young[] = {E, E, E}, poisson[] = {nu, nu, nu}, eight[] = {8 * E, 8 * E, 8 * E};
        const rb_bem_stack stack = {3, thickness, young, poisson},
                           stiff = {3, thickness, eight, poisson};
        const rb_bem_surface cut = surface_of(&stack, base, 0.3),
                             stiffer = surface_of(&stiff, 8.0 * base, 0.3);
        rb_bem_surface one = cut;
        one.stack = NULL;
        one.thickness = d;
        check_alike(&cut, &one, 1.0, 1e-12, "a layer cut into three");
        check_alike(&stiffer, &cut, 0.125, 1e-14, "eight times as stiff");
        const rb_bem_surface same = surface_of(&stack, E, nu);
        rb_bem_surface half = rb_bem_halfplane(same.material, same.datum);
        check_alike(&same, &half, 1.0, 1e-12, "layers of the base's material");
    }
}

/* Layers of very different stiffness, a random one of which is cut. */
TEST(random_stacks)
{
    enum { MOST = 6 };
    for (int k = 0; k < 10; k++) {
        double t[MOST + 1], E[MOST + 1], nu[MOST + 1], t2[MOST + 1], E2[MOST + 1], nu2[MOST + 1];
        const int n = 2 + k % (MOST - 1), at = (int)between(0.0, n);
        for (int j = 0, i = 0; j < n; j++, i++) {
            t[j] = exp(between(-3.0, 1.0));
            E[j] = exp(between(-4.0, 4.0));
            nu[j] = between(-0.4, 0.5);
            t2[i] = t[j];
            E2[i] = E[j];
            nu2[i] = nu[j];
            if (j == at) {
                t2[i] = 0.4 * t[j];
                t2[++i] = 0.6 * t[j];
                E2[i] = E[j];
                nu2[i] = nu[j];
            }
        }
        const rb_bem_stack stack = {n, t, E, nu}, cut = {n + 1, t2, E2, nu2};
        const double base = k % 2 ? 1.0 : 0.0;
        const rb_bem_surface a = surface_of(&cut, base, 0.3), b = surface_of(&stack, base, 0.3);
        check_alike(&a, &b, 1.0, 1e-11, "a layer of a stack, cut");
    }
}

/* ---- Contact ----------------------------------------------------------------------- */

/* R 50, P 500 on three layers, by Chebyshev's polynomials. */
TEST(a_parabola_on_three_layers)
{
    static const struct {
        double base, p0, approach, bound;
    } rows[] = {{210e3, 462.9217, .0116444, 3e-5}, {0.0, 497.3620, .0055193, 1e-4}};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc =
            rolling_case("support halfplane base-young %g base-poisson 0.3 radius 50 load 500 mu 0 "
                         "gap parabola zone %g contact-elements 240",
                         rows[k].base, k ? 0.8 : 0.9);
        put_on(&rc.a, &hard);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(s.max_pressure, rows[k].p0, rows[k].bound, "p0, base %g", rows[k].base);
        CHECK_REL(s.approach, rows[k].approach, 1e-5, "approach, base %g", rows[k].base);
    }
}

/* E grows or falls exponentially over a depth of 1: rows of the modulus in their middles under the
 * contact a = R = 1, of second order in their number. */
TEST(a_graded_body)
{
    static const struct {
        double top, base;
        int n;
        double P, p0;
    } rows[] = {{1, 5, 8, 1.931594, 1.307639},
                {1, 5, 16, 1.924916, 1.304344},
                {5, 1, 8, 1.573681, .908142},
                {5, 1, 16, 1.577481, .909234}};
    for (int k = 0; k < 4; k++) {
        double t[16], E[16], nu[16];
        const int n = rows[k].n;
        for (int j = 0; j < n; j++) {
            t[j] = 1.0 / n;
            E[j] = rows[k].top * pow(rows[k].base / rows[k].top, (j + 0.5) / n);
            nu[j] = 0.3;
        }
        const rb_bem_stack graded = {n, t, E, nu};
        rb_rolling_case rc =
            rolling_case("support halfplane base-young %g base-poisson 0.3 radius 1000 "
                         "load %g mu 0 gap parabola formulation steady creep 0 "
                         "mesh fitted contact-elements 100",
                         rows[k].base, 1e-3 * rows[k].P);
        put_on(&rc.a, &graded);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_REL(s.half_width, 1.0, 3e-4, "a, %g to %g, %d rows", rows[k].top, rows[k].base, n);
        CHECK_REL(1e3 * s.max_pressure, rows[k].p0, 2e-4, "p0, %g to %g, %d rows", rows[k].top,
                  rows[k].base, n);
    }
}

/* E = y^K: geometric rows of the mean moduli, against p0 = E a^(1 + K)/(Gamma(2 + K) B R) and
 * P = p0 a sqrt(pi) Gamma((3 + K)/2)/Gamma(2 + K/2) of a = 1 (Giannakopoulos and Pallot). */
TEST(a_power_law_of_depth)
{
    static const struct {
        double K, B;
        int n;
        double from, to, of_exact;
    } rows[] = {{.2, 1.925213383, 8, .05, 50, 1.0084},
                {.2, 1.925213383, 16, .02, 200, 1.0034},
                {.5, 2.358834720, 8, .05, 50, 1.0346},
                {.5, 2.358834720, 16, .02, 200, 1.0179}};
    for (int k = 0; k < 4; k++) {
        double t[16], E[16], nu[16], above = 0.0;
        const int n = rows[k].n;
        const double K = rows[k].K, ratio = pow(rows[k].to / rows[k].from, 1.0 / (n - 1));
        for (int j = 0; j < n; j++) {
            const double below = rows[k].from * pow(ratio, j);
            t[j] = below - above;
            E[j] = (pow(below, 1.0 + K) - pow(above, 1.0 + K)) / ((1.0 + K) * t[j]);
            nu[j] = 0.3;
            above = below;
        }
        const rb_bem_stack graded = {n, t, E, nu};
        const double p0 = 1.0 / (gsl_sf_gamma(2.0 + K) * rows[k].B),
                     P = p0 * M_SQRTPI * gsl_sf_gamma(1.5 + 0.5 * K) / gsl_sf_gamma(2.0 + 0.5 * K);
        rb_rolling_case rc =
            rolling_case("support halfplane base-young %g base-poisson 0.3 radius 1000 "
                         "load %g mu 0 gap parabola zone 1.3 contact-elements 260",
                         pow(rows[k].to, K), 1e-3 * P);
        put_on(&rc.a, &graded);
        OWNED(rb_rolling_solution) s = solved(&rc);
        CHECK_ABS(1e3 * s.max_pressure / p0, rows[k].of_exact, 1.5e-3, "K = %g, %d rows", K, n);
    }
}

/* In every formulation, with friction: a layer and the same cut into two; the bodies exchanged. */
TEST(all_regimes_and_both_bodies)
{
    static const double t[] = {.3, .7}, E[] = {5e3, 5e3}, nu[] = {.35, .35};
    static const rb_bem_stack two = {2, t, E, nu};
    static const char *const regimes[] = {
        "formulation steady creep-ratio 0.5 mesh fitted contact-elements 50",
        "formulation steady force-ratio 0.3 mesh aligned contact-elements 50",
        "formulation static force-ratio 0.5 increments 4",
        "formulation transient force-ratio 0.4 distance 0.5",
        "formulation steady creep 0.002 friction-law linear mu-fall 0.1 slip-scale 10 speed 1000"};
    for (size_t k = 0; k < sizeof regimes / sizeof *regimes; k++) {
        rb_rolling_case one = rolling_case(
                            "support halfplane young 5e3 poisson 0.35 layer-thickness 1 "
                            "base-young 7e4 base-poisson 0.3 mu 0.3 radius 20 load "
                            "100 young-b 2e5 poisson-b 0.25 support-b halfplane %s",
                            regimes[k]),
                        cut = one, other = one;
        put_on(&cut.a, &two);
        rb_rolling_body turned = cut.a;
        other.a = one.b;
        other.b = turned;
        other.a.radius = 20.0;
        other.b.radius = INFINITY;
        other.a.datum = other.b.datum = one.a.datum = one.b.datum = cut.a.datum = cut.b.datum =
            15.0;
        double *const signs[] = {&other.creep, &other.creep_ratio, &other.force_ratio};
        for (int i = 0; i < 3; i++)
            *signs[i] = -*signs[i];
        OWNED(rb_rolling_solution) s = solved(&one), s_cut = solved(&cut), s_other = solved(&other);
        CHECK_REL(s_cut.max_pressure, s.max_pressure, 1e-10, "p0, %s", regimes[k]);
        CHECK_REL(s_cut.stick_length, s.stick_length, 1e-9, "stick, %s", regimes[k]);
        CHECK_REL(s_cut.tangential_load, s.tangential_load, 1e-9, "Q, %s", regimes[k]);
        CHECK_REL(s_other.max_pressure, s.max_pressure, 1e-9, "p0 exchanged, %s", regimes[k]);
        CHECK_REL(s_other.tangential_load, -s.tangential_load, 1e-8, "Q exchanged, %s", regimes[k]);
    }
}

/* ---- Stress ------------------------------------------------------------------------ */

enum { NODES = 801 };

static void ellipse(const rb_rolling_case *rc, rb_rolling_model *model)
{
    static double x[NODES], p[NODES], q[NODES];
    rb_rolling_solution s;
    for (int i = 0; i < NODES; i++) {
        const double t = -cos(M_PI * i / (NODES - 1));
        x[i] = 0.6 * t;
        p[i] = 500.0 * sqrt(fmax(0.0, 1.0 - t * t));
        q[i] = 0.3 * p[i];
    }
    CHECK_OK(rb_rolling_model_of_nodes(rc, NODES, x, p, q, model, &s, &message));
}

/* 500 MPa on .6 mm, q = .3 p, on three layers: by 400 Gauss points (bodies.md). */
TEST(points_and_bonds_of_three_layers)
{
    static const double xy[] = {0, .05, .3, .12, -.6, .3, .2, .8},
                        want[4][3] = {{-168.635, -502.633, -93.568},
                                      {-277.144, -419.726, -48.503},
                                      {-102.237, -134.576, 48.578},
                                      {-57.9715, -315.608, -66.1529}};
    static const struct {
        double value, x;
    } bonds[2][3][3] = {{{{12.377, -.9888}, {40.704, .4015}, {761.092, -.3106}},
                         {{12.381, -.9978}, {72.225, .5084}, {8.0615, -1.0035}},
                         {{1.7325, -1.2868}, {136.372, .5257}, {NAN, NAN}}},
                        {{{13.524, -.9837}, {39.643, -.0951}, {831.93, -.3172}},
                         {{13.991, -.9921}, {65.317, .4974}, {8.650, -.9962}},
                         {{6.0415, -1.1817}, {126.133, .5114}, {2.976, -1.1817}}}};
    for (int rigid = 0; rigid < 2; rigid++) {
        if (!is_in_turn(rigid, 2))
            continue;
        rb_rolling_case rc = rolling_case("support halfplane base-young %g base-poisson 0.3 load 1",
                                          rigid ? 0.0 : 210e3);
        OWNED(rb_rolling_model) model = {0};
        rb_rolling_stress at[4];
        OWNED(rb_rolling_stress_maxima) most = {.bonds = 0};
        put_on(&rc.a, &hard);
        ellipse(&rc, &model);
        if (!rigid) {
            CHECK_OK(rb_rolling_stress_at(&model, 4, xy, at, &message));
            for (int k = 0; k < 4; k++) {
                const double got[] = {at[k].sxx, at[k].syy, at[k].sxy};
                for (int c = 0; c < 3; c++)
                    CHECK_ABS(got[c], want[k][c], 2e-3, "point %d, component %d", k, c);
            }
            CHECK_ABS(at[1].szz, .4 * (at[1].sxx + at[1].syy), 1e-10, "szz of the second layer");
        }
        CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &most, &message));
        for (int j = 0; j < 3; j++) {
            const rb_rolling_extremum got[] = {most.bond[j].peel, most.bond[j].shear,
                                               most.bond[j].tension_above};
            for (int i = 0; i < 3; i++) {
                if (isnan(bonds[rigid][j][i].value))
                    continue;
                CHECK_REL(got[i].value, bonds[rigid][j][i].value, 2e-4, "rigid %d, bond %d, %d",
                          rigid, j + 1, i);
                CHECK_ABS(got[i].x, bonds[rigid][j][i].x, 1e-3, "its place, bond %d, %d", j + 1, i);
            }
        }
        assert_int_equal(most.bonds, 3);
        assert_true(isnan(most.bond[2].tension_below.value) == rigid);
    }
}

/* Twelve layers of the base's material, each of an eighth of Hertz's half-width: the shear of the
 * half-plane at 0.5, 0.75 and 1 a. */
TEST(every_bond_of_many_layers)
{
    enum { LAYERS = 12 };
    static const struct {
        int bond;
        double shear, x;
    } hertz[] = {{4, 0.25, 0.8660}, {6, 0.2390, 0.8899}, {8, 0.21796, 0.9502}};
    double t[LAYERS], E[LAYERS], nu[LAYERS];
    rb_rolling_case rc = rolling_case(
        "support halfplane young 2e5 poisson 0.3 base-young 2e5 base-poisson 0.3 gap parabola mu 0 "
        "radius 50 load 500 mesh fitted contact-elements 100");
    const double a = rb_rolling_derive(&rc).half_width;
    const rb_bem_stack stack = {LAYERS, t, E, nu};
    for (int k = 0; k < LAYERS; k++) {
        t[k] = a / 8.0;
        E[k] = 2e5;
        nu[k] = 0.3;
    }
    put_on(&rc.a, &stack);
    OWNED(rb_rolling_model) model;
    OWNED(rb_rolling_solution) s;
    OWNED(rb_rolling_stress_maxima) most = {.bonds = 0}, again = {.bonds = 0};
    CHECK_OK(rb_rolling_solve_model(&rc, &model, &s, &message));
    CHECK_OK(rb_rolling_stress_maxima_find(&model, 0.0, &most, &message));
    assert_int_equal(most.bonds, LAYERS);
    for (size_t k = 0; k < sizeof hertz / sizeof *hertz; k++) {
        const rb_rolling_extremum *shear = &most.bond[hertz[k].bond - 1].shear;
        CHECK_REL(shear->value / s.max_pressure, hertz[k].shear, 2e-4, "bond %d", hertz[k].bond);
        CHECK_ABS(fabs(shear->x) / a, hertz[k].x, 2e-3, "bond %d", hertz[k].bond);
        assert_true(isnan(most.bond[hertz[k].bond - 1].peel.x));
    }
    char name[RB_ROLLING_PLACE];
    const rb_rolling_bond_maxima *last = &most.bond[LAYERS - 1];
    assert_string_equal(rb_rolling_place_name(last->shear.material, name), "layer 12");
    assert_int_equal(rb_rolling_place_named("layer 12"), last->shear.material);
    assert_int_equal(last->tension_below.material, RB_MATERIAL_BASE);
    /* at its own place each is found again, on the side of the bond that it belongs to */
    CHECK_OK(rb_rolling_stress_maxima_alloc(LAYERS, &again));
    for (int k = 0; rb_rolling_maximum(&most, k); k++) {
        *rb_rolling_maximum(&again, k) = *rb_rolling_maximum(&most, k);
        if (!isnan(rb_rolling_maximum(&again, k)->x))
            rb_rolling_maximum(&again, k)->value = NAN;
    }
    CHECK_OK(rb_rolling_stress_maxima_at(&model, &again, &message));
    for (int k = 0; rb_rolling_maximum(&most, k); k++)
        CHECK_ABS(rb_rolling_maximum(&again, k)->value, rb_rolling_maximum(&most, k)->value,
                  1e-9 * s.max_pressure, "maximum %d", k);
}

TEST(names_of_bonds)
{
    static const char *const bad[] = {"bond_0_peel", "bond_x_peel",  "bond_2_pull",
                                      "bond_2peel",  "bond_-1_peel", "max_shear"};
    rb_rolling_maximum_result r;
    int k, part, of_b;
    assert_true(rb_rolling_find_bond_number("bond_37_tension_below_y_b", &k, &part, &of_b));
    assert_true(k == 6 + 36 * 4 + 3 && part == 2 && of_b == 1);
    assert_string_equal(rb_rolling_describe_maximum(k, part, of_b, &r)->name,
                        "bond_37_tension_below_y_b");
    assert_string_equal(rb_rolling_describe_maximum(k, 0, 1, &r)->meaning,
                        "tension below bond 37 in B");
    assert_string_equal(rb_rolling_describe_maximum(2, 1, 0, &r)->name, "von_mises_x");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_false(rb_rolling_find_bond_number(bad[i], &k, &part, &of_b));
    assert_int_equal(rb_rolling_place_named("layer 0"), -1);
    assert_int_equal(rb_rolling_place_named("layer 1 or below"), -1);
    assert_int_equal(rb_rolling_place_named("base"), RB_MATERIAL_BASE);
}

/* Inside a layer and cut: the same stress; across a bond syy, sxy and the strain along x go on. */
TEST(stress_of_cut_layers)
{
    static const double t[] = {.3, .7}, E[] = {5e3, 5e3}, nu[] = {.35, .35};
    static const rb_bem_stack two = {2, t, E, nu};
    static const double depth[] = {0.0, .1, .3, .65, 1.0, 1.4, 6.0};
    for (int rigid = 0; rigid < 2; rigid++) {
        rb_rolling_case one = rolling_case(
                            "support halfplane young 5e3 poisson 0.35 layer-thickness 1 "
                            "base-young %g base-poisson 0.3 load 1",
                            rigid ? 0.0 : 7e4),
                        cut = one;
        OWNED(rb_rolling_model) a = {0}, b = {0};
        put_on(&cut.a, &two);
        ellipse(&one, &a);
        ellipse(&cut, &b);
        for (int k = 0; k < (rigid ? 5 : 7); k++) {
            const double xy[] = {-.4, depth[k], .2, depth[k], 2.5, depth[k]};
            rb_rolling_stress x[3], y[3];
            CHECK_OK(rb_rolling_stress_at(&a, 3, xy, x, &message));
            CHECK_OK(rb_rolling_stress_at(&b, 3, xy, y, &message));
            for (int i = 0; i < 3; i++) {
                CHECK_ABS(y[i].sxx, x[i].sxx, 1e-8, "sxx at (%g, %g)", xy[2 * i], depth[k]);
                CHECK_ABS(y[i].syy, x[i].syy, 1e-8, "syy at (%g, %g)", xy[2 * i], depth[k]);
                CHECK_ABS(y[i].sxy, x[i].sxy, 1e-8, "sxy at (%g, %g)", xy[2 * i], depth[k]);
            }
        }
    }
    rb_rolling_case rc = rolling_case("support halfplane base-young 2e5 base-poisson 0.3 load 1");
    OWNED(rb_rolling_model) model = {0};
    put_on(&rc.a, &hard);
    ellipse(&rc, &model);
    for (int j = 0; j < 2; j++) {
        const double bond = j ? hard_thickness[0] + hard_thickness[1] : hard_thickness[0];
        const double xy[] = {.25, bond, .25, nextafter(bond, 1.0)};
        rb_rolling_stress at[2];
        double strain[2];
        CHECK_OK(rb_rolling_stress_at(&model, 2, xy, at, &message));
        for (int i = 0; i < 2; i++) {
            const double v = hard_poisson[j + i];
            strain[i] = ((1.0 - v) * at[i].sxx - v * at[i].syy) * (1.0 + v) / hard_young[j + i];
        }
        CHECK_ABS(at[0].syy, at[1].syy, 1e-9, "syy across bond %d", j + 1);
        CHECK_ABS(at[0].sxy, at[1].sxy, 1e-9, "sxy across bond %d", j + 1);
        CHECK_ABS(strain[0], strain[1], 1e-13, "strain across bond %d", j + 1);
    }
}

/* Each failing allocation is said, and a stack that is none. */
TEST(memory_and_bad_stacks)
{
    static const double x[] = {-1.0, 0.0, 1.0}, p[] = {0.0, 1.0, 0.0}, xy[] = {.2, .04, .2, .3};
    const rb_bem_edge_load load = {3, x, p, p};
    double thickness[] = {.1, .05, .3}, young[] = {400e3, 3e3, 70e3};
    const rb_bem_stack stack = {3, thickness, young, hard_poisson};
    double W[ENTRIES], s[6];
    int k = -1, refused = 1;
    while (refused) { /* each time others, whose table is not kept */
        thickness[1] = .05 + 1e-3 * ++k;
        const rb_bem_surface body = surface_of(&stack, 2e5, 0.3);
        refused = REFUSED_FROM(k, rb_bem_surface_displacement(&body, 2, x, 1, x, W));
    }
    assert_true(k > 3);
    const rb_bem_surface body = surface_of(&stack, 2e5, 0.3);
    rb_bem_layer_field *field = NULL;
    for (k = 0; REFUSED_FROM(k, rb_bem_layer_field_create(&body, &load, &field, NULL)); k++)
        assert_null(field);
    assert_true(k > 3);
    CHECK_STATUS(
        rb_bem_layer_field_add(field, (rb_bem_points){1, (double[]){0.0, -1e-9}}, s, &message),
        RB_EINVAL);
    for (k = 0; REFUSED_FROM(k, rb_bem_layer_field_add(field, (rb_bem_points){2, xy}, s, NULL));
         k++)
        ;
    CHECK_STATUS(
        rb_bem_layer_field_add(field, (rb_bem_points){1, (double[]){1e5, 0.1}}, s, &message),
        RB_EINVAL);
    rb_bem_layer_field_free(field);
    for (k = 0; k < 3; k++) {
        rb_bem_surface bad = body;
        rb_bem_stack other = stack;
        other.n = k == 0 ? 1 : 3;
        thickness[2] = k == 1 ? 0.0 : .3;
        young[2] = k == 2 ? -1.0 : 70e3;
        bad.stack = &other;
        CHECK_STATUS(rb_bem_layer_field_create(&bad, &load, &field, &message), RB_EINVAL);
        assert_null(field);
    }
}

/* ---- Doors ------------------------------------------------------------------------- */

TEST(doors_and_refusals)
{
    static const char file[] = "printf 'thickness [um], young [GPa], poisson\\n100 400 .2\\n50 3 "
                               ".4\\n300 70 .33\\n' > s.csv; ";
    static const struct {
        const char *more, *says;
    } lines[] = {
        {"--young 3", "--young: the first row of --layers says it"},
        {"--layer-thickness 3", "--layer-thickness: the first row of --layers says it"},
        {"--support hub", "layers: for the support halfplane only"},
        {"--plane stress", "--plane: stress: several layers are in plane strain"},
        {"--similar --layers-b s.csv", "--similar: B has the layers of --layers-b"},
        {"--layers-b s.csv --poisson-b .3", "--poisson-b: the first row of --layers-b says it"},
        {"--relaxation-time 1 --relaxation-ratio 1 --formulation steady --speed 3",
         "--relaxation-time: several layers are elastic"},
        {"--formulation steady --speed 3 --conductivity 3 --heat-capacity 3", "conductivity"},
    };
    char line[600];
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        if (!is_in_turn((int)k, 4))
            continue;
        snprintf(line, sizeof line,
                 "%s \"$R\" --support halfplane --layers s.csv --load 100 --creep 0 %s", file,
                 lines[k].more);
        assert_int_not_equal(shell(line), 0);
        if (!strstr(err, lines[k].says) || strchr(err, '\n') != err + strlen(err) - 1)
            fail_msg("%s: %s", lines[k].more, err);
    }
    snprintf(line, sizeof line,
             "%s \"$R\" --support halfplane --layers s.csv --base-young 210GPa --base-poisson .3 "
             "--radius 50 --load 500 --mu .2 --similar --formulation steady --creep-ratio .4 "
             "--derivatives --json --output s.json && \"$R\" check s.json",
             file);
    if (shell(line))
        fail_msg("%s", err);
    assert_non_null(strstr(out, "valid"));
    assert_non_null(strstr(err, "A: 3 layers, the first of E = 400000 MPa, nu = 0.2, 0.1 mm thick, "
                                "all 0.45 mm on E = 210000 MPa, nu = 0.3; B: the same"));
    if (shell("printf '1 5e3 .6\\n' > bad; \"$R\" --support halfplane --layers bad --load 1") == 0)
        fail_msg("poisson .6");
    assert_non_null(strstr(err, "bad:1: poisson: expected a number above -1, at most 0.5"));
}

RUN_TESTS(enter_folder, leave_folder)
