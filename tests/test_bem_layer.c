/* The tabulated kernel of a layer: against integrals over all waves on the real axis, far
 * away, between the pieces of its table and where memory is short. */
#include "bem/layer.h"
#include "bem_shapes.h"
#include "check.h"

#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_expint.h>
#include <stdint.h>

static double chance(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static double between(uint64_t *seed, double from, double to)
{
    return from + (to - from) * chance(seed);
}

typedef struct {
    double ratio[2], length[2];
    rb_bem_surface body;
} layer;

/* Every third on a rigid base, two in three with memory. */
static void any_layer(uint64_t *seed, int k, layer *l)
{
    l->body =
        (rb_bem_surface){.material = {between(seed, 0.1, 5.0), between(seed, -0.5, 0.5)},
                         .datum = 10.0,
                         .terms = k % 3 == 2 ? 2 : k % 3,
                         .ratio = l->ratio,
                         .length = l->length,
                         .thickness = pow(10.0, between(seed, -2.0, 2.0)),
                         .elastic_base = k / 3 % 3 > 0};
    l->body.base =
        (rb_bem_material){l->body.material.shear * pow(10.0, between(seed, -2.0, 3.0)),
                          between(seed, -0.5, 0.5)};
    for (int j = 0; j < 2; j++) {
        l->ratio[j] = pow(10.0, between(seed, -1.0, 1.0));
        l->length[j] = l->body.thickness * pow(10.0, between(seed, -2.0, 2.0));
    }
}

/* (L3) on the real axis, panels of one radian in all that is in it. */
static void integral_over_waves(const rb_bem_surface *body, double X, double b,
                                double of[3])
{
    enum { ORDER = 24, HALVINGS = 24, LAST = 24 };
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(ORDER);
    const int panels = (int)ceil(LAST * fmax(2.0, 0.1 * (fabs(X) + b)));
    const double width = (double)LAST / panels;
    double Z_0[3], from = 0.0;

    rb_bem_layer_longest_waves(body, Z_0);
    for (int c = 0; c < 3; c++)
        of[c] = c < 2 ? -Z_0[c] * gsl_sf_expint_E1(LAST) : 0.0;
    for (int k = 0; k < panels + HALVINGS; k++) {
        const double to =
            k < HALVINGS ? ldexp(width, k - HALVINGS) : (k - HALVINGS + 1) * width;
        for (size_t g = 0; g < ORDER; g++) {
            double al, weight;
            double complex Z[3];
            gsl_integration_glfixed_point(from, to, g, &al, &weight, rule);
            rb_bem_layer_remainder_at(body, al, Z);
            const double complex e = cexp(I * al * X) * sin(al * b) / (al * b);
            for (int c = 0; c < 3; c++)
                of[c] += weight / al *
                         (c < 2 ? creal(Z[c] * e) - Z_0[c] * exp(-al) : cimag(Z[c] * e));
        }
        from = to;
    }
    gsl_integration_glfixed_table_free(rule);
}

/* Places and strips of all sizes; memory from a hundredth to a hundred thicknesses, bases
 * softer and stiffer. */
TEST(kernels_are_integrals_over_waves)
{
    uint64_t seed = 7;
    for (int k = 0; k < 90; k++) {
        layer l;
        any_layer(&seed, k, &l);
        double most = 1.0; /* in which rounding is counted */
        for (int j = 0; j < l.body.terms; j++)
            most += l.ratio[j];
        most = fmax(most, rb_bem_layer_base_compliance(&l.body));
        for (int trial = 0; trial < 6; trial++) {
            const double X = pow(10.0, between(&seed, -2.0, 2.0)) * (trial % 2 ? -1 : 1),
                         b = pow(10.0, between(&seed, -5.0, 1.0));
            const rb_bem_layer_table *table = rb_bem_layer_table_of(&l.body, fabs(X) + b);
            double want[3];
            assert_non_null(table);
            const rb_bem_layer_kernel got = rb_bem_layer_mean(table, X, b);
            rb_bem_layer_table_release(table);
            integral_over_waves(&l.body, X, b, want);
            for (int c = 0; c < 3; c++)
                CHECK_ABS(got.of[c] / most, want[c] / most, 2e-13,
                          "layer %d, X = %g, b = %g, component %d", k, X, b, c);
        }
    }
}

/* On a rigid base nothing is felt far away, exp(-0.739 X) at nu = 1/2: the remainder is
 * the half-plane's logarithm and its coupling, with the other sign. */
TEST(far_away_the_base_holds)
{
    static const double poisson[] = {0.5, 0.4, 0.0, -0.5};
    for (int k = 0; k < 4; k++) {
        const rb_bem_surface body = {.material = {1.0, poisson[k]}, .thickness = 3.0};
        const double beta = (1.0 - 2.0 * poisson[k]) / (2.0 * (1.0 - poisson[k]));
        for (double X = 50.0; X < 1e12; X *= 7.3) {
            const rb_bem_layer_table *table = rb_bem_layer_table_of(&body, X + 1.0);
            const rb_bem_layer_kernel got = rb_bem_layer_mean(table, X, 1e-8),
                                      back = rb_bem_layer_mean(table, -X, 1e-8);
            rb_bem_layer_table_release(table);
            for (int c = 0; c < 2; c++) {
                CHECK_REL(got.of[c], log(X), 1e-13, "X = %g, component %d", X, c);
                CHECK_REL(back.of[c], log(X), 1e-13, "X = %g, component %d", -X, c);
            }
            CHECK_ABS(got.of[2], -0.5 * M_PI * beta, 1e-13, "X = %g, coupling", X);
            CHECK_ABS(back.of[2], 0.5 * M_PI * beta, 1e-13, "X = %g, coupling", -X);
        }
    }
}

/* A table that was made longer has the bits of one that was made at once, also after nine
 * others, of which eight are kept; strips and their halves agree. */
TEST(tables_are_alike_however_they_are_made)
{
    enum { PLACES = 30 };
    const double ratio = 2.0, length = 0.7;
    const rb_bem_surface body = {.material = {1.0, 0.3},
                                 .thickness = 1.0,
                                 .terms = 1,
                                 .ratio = &ratio,
                                 .length = &length};
    rb_bem_layer_kernel first[2 * PLACES];
    for (int round = 0; round < 2; round++) {
        if (round == 0)
            rb_bem_layer_table_release(rb_bem_layer_table_of(&body, 3.0));
        for (int k = 0; k < 9 && round == 1; k++) {
            const rb_bem_surface other = {.material = {1.0, 0.01 * k}, .thickness = 1.0};
            rb_bem_layer_table_release(rb_bem_layer_table_of(&other, 1.0));
        }
        const rb_bem_layer_table *table = rb_bem_layer_table_of(&body, 600.0);
        for (int k = 0; k < 2 * PLACES; k++) {
            const double X = 0.01 * pow(1.4, k / 2) * (k % 2 ? -1.0 : 1.0);
            const rb_bem_layer_kernel whole = rb_bem_layer_mean(table, X, 0.4),
                                      left = rb_bem_layer_mean(table, X - 0.2, 0.2),
                                      right = rb_bem_layer_mean(table, X + 0.2, 0.2);
            for (int c = 0; c < 3; c++) {
                CHECK_ABS(whole.of[c], 0.5 * (left.of[c] + right.of[c]), 1e-13,
                          "X = %g, halves, component %d", X, c);
                assert_true(round == 0 || whole.of[c] == first[k].of[c]);
            }
            first[k] = whole;
        }
        rb_bem_layer_table_release(table);
    }
}

TEST(short_memory_leaves_no_table)
{
    const double ratio = 2.0;
    for (int i = 0, done = 0; !done; i++) {
        const double length = 0.5 + 0.01 * i;
        const rb_bem_surface body = {.material = {1.0, 0.3},
                                     .thickness = 1.0,
                                     .terms = 1,
                                     .ratio = &ratio,
                                     .length = &length};
        alloc_fail_after(i);
        const rb_bem_layer_table *table = rb_bem_layer_table_of(&body, 20.0);
        done = !alloc_failed();
        alloc_succeed();
        assert_true(done == (table != NULL));
        assert_true(!done || i > 8);
        if (table)
            rb_bem_layer_table_release(table);
    }
}

RUN_TESTS(NULL, NULL)
