/* Stress in a layer and in its base (L5). */
#include "cases.h"
#include "check.h"
#include "bem/bem.h"
#include "solved.h"

#include <gsl/gsl_math.h>

enum { NODES = 81 };

typedef struct {
    double x[NODES], p[NODES], q[NODES];
    rb_bem_edge_load load;
} traction;

/* Hertz's pressure on -1 ... 1 and friction that changes its sign. */
static void set_traction(traction *t)
{
    for (int i = 0; i < NODES; i++) {
        t->x[i] = -cos(M_PI * i / (NODES - 1));
        t->p[i] = sqrt(fmax(0.0, 1.0 - t->x[i] * t->x[i]));
        t->q[i] = (0.2 + 0.3 * t->x[i]) * t->p[i];
    }
    t->load = (rb_bem_edge_load){NODES, t->x, t->p, t->q};
}

static rb_bem_surface layer(double thickness, double young, double poisson, double base_young,
                            double base_poisson)
{
    rb_bem_surface s = rb_bem_halfplane(rb_bem_material_from_young(young, poisson), 100.0);
    s.thickness = thickness;
    s.elastic_base = base_young > 0.0;
    if (s.elastic_base)
        s.base = rb_bem_material_from_young(base_young, base_poisson);
    return s;
}

/* sxx, syy, sxy at a point of the surface's body. */
static void stress_in(const rb_bem_surface *body, double x, double y, double s[3])
{
    traction t;
    rb_bem_layer_field *field;
    const double xy[2] = {x, y};
    set_traction(&t);
    CHECK_OK(rb_bem_halfplane_stress_linear(&t.load, (rb_bem_points){1, xy}, s));
    if (body->thickness == 0.0)
        return;
    CHECK_OK(rb_bem_layer_field_create(body, &t.load, &field, NULL));
    CHECK_OK(rb_bem_layer_field_add(field, (rb_bem_points){1, xy}, s, NULL));
    rb_bem_layer_field_free(field);
}

static const double places[][2] = {{0.0, 0.1}, {0.7, 0.6},  {-1.3, 0.3},
                                   {0.2, 2.0}, {-0.5, 5.0}, {6.0, 1.2}};
enum { PLACES = sizeof places / sizeof *places };

/* A layer of its base's material is a half-plane, in the layer and below it. */
TEST(a_layer_of_its_base_is_a_halfplane)
{
    static const double nu[] = {-0.4, 0.3, 0.5}, thickness[] = {0.2, 0.7, 3.0};
    for (int m = 0; m < 3; m++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < PLACES; i++) {
                const rb_bem_surface body = layer(thickness[k], 2.0, nu[m], 2.0, nu[m]),
                                     half = layer(0.0, 2.0, nu[m], 0.0, 0.0);
                double got[3], want[3];
                stress_in(&body, places[i][0], places[i][1], got);
                stress_in(&half, places[i][0], places[i][1], want);
                for (int c = 0; c < 3; c++)
                    CHECK_ABS(got[c], want[c], 1e-10, "nu = %g, d = %g, point %d, component %d",
                              nu[m], thickness[k], i, c);
            }
}

/* The strain along x of a rigid base's surface is zero. */
TEST(a_rigid_base_does_not_stretch)
{
    static const double nu[] = {0.0, 0.3, 0.5}, thickness[] = {0.2, 0.7, 3.0};
    for (int m = 0; m < 3; m++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < PLACES; i++) {
                const rb_bem_surface body = layer(thickness[k], 2.0, nu[m], 0.0, 0.0);
                double s[3];
                stress_in(&body, places[i][0], thickness[k], s);
                CHECK_ABS((1.0 - nu[m]) * s[0] - nu[m] * s[1], 0.0, 1e-10,
                          "nu = %g, d = %g, x = %g", nu[m], thickness[k], places[i][0]);
            }
}

/* Across the bond syy, sxy and the strain along x are continuous, sxx is not. */
TEST(the_bond_holds)
{
    static const double base[][2] = {{0.3, 0.45}, {20.0, 0.1}, {1e4, 0.3}};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < PLACES; i++) {
            const double d = 0.4, nu = 0.3, x = places[i][0];
            const rb_bem_surface body = layer(d, 2.0, nu, base[k][0], base[k][1]);
            double in[3], below[3];
            stress_in(&body, x, d, in);
            stress_in(&body, x, nextafter(d, 1.0), below);
            CHECK_ABS(in[1], below[1], 1e-11, "syy, base %d, x = %g", k, x);
            CHECK_ABS(in[2], below[2], 1e-11, "sxy, base %d, x = %g", k, x);
            CHECK_ABS(((1.0 - nu) * in[0] - nu * in[1]) / body.material.shear,
                      ((1.0 - base[k][1]) * below[0] - base[k][1] * below[1]) / body.base.shear,
                      1e-10, "strain, base %d, x = %g", k, x);
        }
}

/* d s_xx/dx + d s_xy/dy = 0 and d s_xy/dx + d s_yy/dy = 0, by central differences. */
TEST(the_field_is_in_equilibrium)
{
    const rb_bem_surface body = layer(0.8, 2.0, 0.3, 9.0, 0.2);
    const double h = 1e-3;
    for (int i = 0; i < PLACES; i++) {
        const double x = places[i][0], y = places[i][1];
        double east[3], west[3], down[3], up[3];
        stress_in(&body, x + h, y, east);
        stress_in(&body, x - h, y, west);
        stress_in(&body, x, y + h, down);
        stress_in(&body, x, y - h, up);
        CHECK_ABS(east[0] - west[0] + down[2] - up[2], 0.0, 2.0 * h * 2e-4, "x, point %d", i);
        CHECK_ABS(east[2] - west[2] + down[1] - up[1], 0.0, 2.0 * h * 2e-4, "y, point %d", i);
    }
}

/* On a rigid base the strain across the layer, from the stress, adds up to the
 * displacement of the surface, which comes from the transfer functions (L2). */
TEST(strains_add_up_to_the_displacement_of_the_surface)
{
    enum { DEPTHS = 100, STRIPS = NODES - 1 };
    const double d = 0.7, nu = 0.3, x = 0.25;
    const rb_bem_surface body = layer(d, 2.0, nu, 0.0, 0.0);
    traction t;
    double sum = 0.0, w = 0.0, W[4 * STRIPS];
    set_traction(&t);
    for (int k = 0; k < DEPTHS; k++) {
        double s[3];
        stress_in(&body, x, d * (k + 0.5) / DEPTHS, s);
        sum += ((1.0 - nu) * s[1] - nu * s[0]) / (2.0 * body.material.shear) * d / DEPTHS;
    }
    CHECK_OK(rb_bem_surface_displacement(&body, STRIPS, t.x, 1, &x, W));
    for (int j = 0; j < STRIPS; j++)
        w += W[2 * j] * 0.5 * (t.p[j] + t.p[j + 1]) +
             W[2 * (j + STRIPS)] * 0.5 * (t.q[j] + t.q[j + 1]);
    CHECK_REL(-sum, w, 2e-4, "w_N at x = %g", x);
}

/* Thick: the half-plane of the layer, to (a/d)^1 of a rigid base.  Thin: that of the
 * base, to d/a. */
TEST(its_limits_are_half_planes)
{
    const rb_bem_surface of_layer = layer(0.0, 2.0, 0.3, 0.0, 0.0);
    double last[2] = {INFINITY, INFINITY};
    for (int k = 1; k <= 3; k++) {
        const rb_bem_surface thick = layer(20.0 * pow(4.0, k), 2.0, 0.3, 0.0, 0.0),
                             thin = layer(0.4 * pow(4.0, -k), 2.0, 0.3, 20.0, 0.2);
        double off[2] = {0.0, 0.0}, got[3], want[3];
        for (int c = 0; c < 3; c++) {
            stress_in(&thick, 0.3, 0.7, got);
            stress_in(&of_layer, 0.3, 0.7, want);
            off[0] = fmax(off[0], fabs(got[c] - want[c]));
            stress_in(&thin, 0.3, 0.7, got);
            off[1] = fmax(off[1], fabs(got[c] - want[c])); /* no constant is in it */
        }
        for (int j = 0; j < 2; j++) {
            CHECK_MAX(off[j], 0.4 * last[j], "limit %d, step %d", j, k);
            last[j] = off[j];
        }
    }
    CHECK_MAX(last[0], 1e-3, "thick");
    CHECK_MAX(last[1], 2e-3, "thin");
}

/* Steady, a layer that relaxes on an elastic base is glassy where it passes fast, and
 * rubbery where it passes slowly. */
TEST(a_relaxing_layer_lies_between_two_elastic_ones)
{
    const double ratio = 3.0;
    for (int k = 0; k < 2; k++) {
        const double length = k ? 1e-7 : 1e9;
        rb_bem_surface body = layer(0.5, 8.0, 0.3, 9.0, 0.2);
        const rb_bem_surface elastic = layer(0.5, k ? 2.0 : 8.0, 0.3, 9.0, 0.2);
        body.terms = 1;
        body.ratio = &ratio;
        body.length = &length;
        for (int i = 0; i < PLACES; i++) {
            double got[3], want[3];
            stress_in(&body, places[i][0], places[i][1], got);
            stress_in(&elastic, places[i][0], places[i][1], want);
            for (int c = 0; c < 3; c++)
                CHECK_ABS(got[c], want[c], 1e-5, "%s, point %d, component %d", k ? "slow" : "fast",
                          i, c);
        }
    }
}

TEST(bad_input)
{
    traction t;
    rb_bem_layer_field *field;
    rb_bem_surface body = layer(0.5, 2.0, 0.3, 0.0, 0.0);
    static const double outside[][2] = {{0.0, -1e-9}, {0.0, 0.51}, {0.0, NAN}};
    double s[3] = {0.0, 0.0, 0.0};
    set_traction(&t);
    CHECK_OK(rb_bem_layer_field_create(&body, &t.load, &field, &message));
    for (int k = 0; k < 3; k++)
        CHECK_STATUS(rb_bem_layer_field_add(field, (rb_bem_points){1, outside[k]}, s, &message),
                     RB_EINVAL);
    const double far[2] = {1e4, 0.1};
    CHECK_STATUS(rb_bem_layer_field_add(field, (rb_bem_points){1, far}, s, &message), RB_EINVAL);
    rb_bem_layer_field_free(field);
    rb_bem_layer_field_free(NULL);
    body.thickness = 0.0;
    CHECK_STATUS(rb_bem_layer_field_create(&body, &t.load, &field, &message), RB_EINVAL);
    body.thickness = 1e-5; /* too thin for so wide a load */
    const double inside[2] = {0.0, 5e-6};
    CHECK_OK(rb_bem_layer_field_create(&body, &t.load, &field, &message));
    CHECK_STATUS(rb_bem_layer_field_add(field, (rb_bem_points){1, inside}, s, &message), RB_EINVAL);
    rb_bem_layer_field_free(field);
    t.x[3] = t.x[1]; /* the same as t.x[2] would be a jump */
    body.thickness = 0.5;
    CHECK_STATUS(rb_bem_layer_field_create(&body, &t.load, &field, &message), RB_EINVAL);
    assert_null(field);
}

/* A half-plane that relaxes has the stress that its tractions make in an elastic one; so
 * has a layer of it on a rigid base. */
TEST(what_relaxes_everywhere_alike_has_the_elastic_stress)
{
    static const double xy[] = {0.2, 0.3, -0.4, 0.8, 0.9, 0.1};
    for (int k = 0; k < 2; k++) {
        rb_rolling_case rc = rolling_case("support halfplane layer-thickness %g "
                                          "relaxation-time 0.01 relaxation-ratio 2 half-width 1 "
                                          "formulation steady creep-ratio 0.4 speed 100",
                                          k ? 1.5 : 0.0);
        rb_rolling_stress relaxing[3], elastic[3];
        OWNED(rb_rolling_model) model = solved_model(&rc);
        CHECK_OK(rb_rolling_stress_at(&model, 3, xy, relaxing, NULL));
        case_of_model(&model)->a.memory.n = 0; /* the same tractions */
        CHECK_OK(rb_rolling_stress_at(&model, 3, xy, elastic, NULL));
        for (int i = 0; i < 3; i++) {
            CHECK_REL(relaxing[i].sxx, elastic[i].sxx, 1e-12, "sxx, point %d", i);
            CHECK_REL(relaxing[i].von_mises, elastic[i].von_mises, 1e-12, "point %d", i);
        }
    }
}

RUN_TESTS(NULL, NULL)
