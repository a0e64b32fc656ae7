/* What src/bem keeps to itself: strips in complex form, transforms and circulants, the
 * kernels of layers and of rings, the interpolative decomposition, supports, clusters. */
#include "bem/hierarchical/cluster.h"
#include "bem/products/fourier.h"
#include "bem/internal.h"
#include "bem/large.h"
#include "bem/layers/layer.h"
#include "bem/layers/ring.h"
#include "bem/hierarchical/skeleton.h"
#include "bem/strip.h"
#include "bem_shapes.h"

#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>
#include <gsl/gsl_sf_expint.h>

static const rb_bem_material steel = {.shear = 82000.0, .poisson = 0.28};

/* ---- Strips ------------------------------------------------------------------------ */

/* One strip from x = -0.3 to 0.5 on the edge of y > 0. */
static rb_strip flat_strip(rb_bem_mesh *mesh)
{
    CHECK_OK(rb_bem_mesh_alloc(1, mesh));
    mesh->x0[0] = -0.3;
    mesh->x1[0] = 0.5;
    return rb_strip_on(mesh, 0, steel, 1.0);
}

TEST(the_strip_is_flamants_on_the_surface)
{
    const double ends[] = {-0.3, 0.5}, x[] = {-3.0, -0.31, -0.1, 0.1, 0.49, 40.0};
    double W[4 * 6];
    OWNED(rb_bem_mesh) mesh;
    const rb_strip strip = flat_strip(&mesh);
    CHECK_OK(rb_bem_surface_displacement(HALFPLANE(steel, 1.0), 1, ends, 6, x, W));
    /* the datum and the rotation-free constant differ: compare with the first point */
    for (int load = 0; load < 2; load++)
        for (int i = 1; i < 6; i++) {
            const double complex f = load ? 1.0 : I;
            const double complex u = rb_strip_under(rb_strip_displacement(&strip, x[i]), f) -
                                     rb_strip_under(rb_strip_displacement(&strip, x[0]), f);
            const double *column = W + 12 * load;
            CHECK_ABS(cimag(u), column[i] - column[0], 1e-18, "w_N at %g", x[i]);
            CHECK_ABS(creal(u), column[6 + i] - column[6], 1e-18, "w_T at %g", x[i]);
        }
}

TEST(its_tractions_are_those_of_the_stress)
{
    const double ends[] = {-0.3, 0.5}, p = 2.0, q = -0.7;
    const double xy[] = {0.1, 0.0, 0.2, 0.3, -1.0, 0.01, 5.0, 7.0};
    double sigma[12];
    OWNED(rb_bem_mesh) mesh;
    const rb_strip strip = flat_strip(&mesh);
    CHECK_OK(rb_bem_halfplane_stress(&(rb_bem_edge_load){1, ends, &p, &q}, (rb_bem_points){4, xy},
                                     sigma));
    for (int k = 0; k < 4; k++)
        for (int turn = 0; turn < 4; turn++) {
            const double nx = cos(0.3 + turn), ny = sin(0.3 + turn), *s = sigma + 3 * k;
            const double complex t = rb_strip_under(
                rb_strip_traction(&strip, xy[2 * k] + xy[2 * k + 1] * I, nx + ny * I), q + p * I);
            CHECK_ABS(creal(t), s[0] * nx + s[2] * ny, 1e-14, "t_x, point %d", k);
            CHECK_ABS(cimag(t), s[2] * nx + s[1] * ny, 1e-14, "t_y, point %d", k);
        }
}

/* Far away the strip is a force: no digit is lost there. */
TEST(far_away_it_keeps_its_digits)
{
    OWNED(rb_bem_mesh) mesh;
    CHECK_OK(rb_bem_mesh_alloc(1, &mesh));
    mesh.x0[0] = -5e-11;
    mesh.x1[0] = 5e-11;
    const rb_strip strip = rb_strip_on(&mesh, 0, steel, 1.0);
    const double complex z = 0.3 + 0.4 * I, F = 1e-10 * I;
    const double kappa = 3.0 - 4.0 * steel.poisson;
    const double complex point = -kappa * F * clog(z) + z * conj(F) / conj(z) - F * conj(clog(z));
    const double complex want = point / (4.0 * M_PI * steel.shear);
    const double complex got = rb_strip_under(rb_strip_displacement(&strip, z), I);
    CHECK_MAX(cabs(got - want), 1e-14 * cabs(want), "against the force");
}

/* Two strips of different length that share an end where the traction has a kink, against
 * the tent of the half-plane; the end itself included. */
TEST(linear_strips_make_a_tent)
{
    const double nodes[] = {-0.3, 0.1, 0.2}, p[] = {0.0, 2.0, 0.0}, q[] = {0.0, -0.7, 0.0};
    const double xy[] = {0.0, 0.3, 0.1, 0.2, 0.1, 0.0, -1.0, 0.01, 0.3, 0.0, 2.0, 1.0};
    const rb_strip left = rb_strip_between(-0.3, 0.1, steel, 1.0),
                   right = rb_strip_between(0.1, 0.2, steel, 1.0);
    const double complex top = q[1] + p[1] * I;
    double want[18], a[3], b[3];
    CHECK_OK(rb_bem_halfplane_stress_linear(&(rb_bem_edge_load){3, nodes, p, q},
                                            (rb_bem_points){6, xy}, want));
    for (int k = 0; k < 6; k++) {
        const double complex z = xy[2 * k] + xy[2 * k + 1] * I;
        rb_strip_linear_stress(&left, z, 0.5 * top, top / 0.4, a);
        rb_strip_linear_stress(&right, z, 0.5 * top, -top / 0.1, b);
        for (int i = 0; i < 3; i++)
            CHECK_ABS(a[i] + b[i], want[3 * k + i], 1e-10, "point %d, component %d", k, i);
    }
}

/* Turning strip and point together turns the stress: its invariants stay. */
TEST(linear_strips_do_not_know_their_direction)
{
    const double complex turn = cos(0.7) + sin(0.7) * I, z = 0.2 + 0.1 * I;
    const rb_strip flat = rb_strip_between(-0.3, 0.5, steel, 1.0),
                   turned = rb_strip_between(-0.3 * turn, 0.5 * turn, steel, 1.0);
    double a[3], b[3];
    rb_strip_linear_stress(&flat, z, 1.0 + 2.0 * I, 0.3 * I, a);
    rb_strip_linear_stress(&turned, z * turn, (1.0 + 2.0 * I) * turn, 0.3 * I * turn, b);
    const double c = cos(0.7), s = sin(0.7);
    CHECK_ABS(b[0], c * c * a[0] + s * s * a[1] - 2.0 * c * s * a[2], 1e-13, "sxx");
    CHECK_ABS(b[1], s * s * a[0] + c * c * a[1] + 2.0 * c * s * a[2], 1e-13, "syy");
    CHECK_ABS(b[2], c * s * (a[0] - a[1]) + (c * c - s * s) * a[2], 1e-13, "sxy");
}

/* ---- Transforms -------------------------------------------------------------------- */

/* The smallest even product of twos, threes and fives that has the room. */
TEST(transforms_have_lengths_that_are_quick)
{
    static const int all[][2] = {{1, 2},   {2, 2},   {3, 4},   {7, 8},     {11, 12},
                                 {13, 16}, {21, 24}, {26, 30}, {31, 32},   {41, 48},
                                 {51, 54}, {61, 64}, {91, 96}, {961, 972}, {2501, 2560}};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        OWNED(rb_fourier) f;
        assert_true(rb_fourier_make(all[k][0], &f));
        assert_int_equal(f.size, all[k][1]);
    }
}

/* Plans are kept from user to user, and shared; more of them than are kept work alike. */
TEST(plans_are_kept)
{
    enum { MANY = 40 };
    rb_fourier first, second, all[MANY];
    assert_true(rb_fourier_make(100, &first));
    assert_true(rb_fourier_make(99, &second));
    assert_ptr_equal(first.forward, second.forward);
    rb_fourier_free(&first);
    assert_null(first.forward);
    rb_fourier_free(&first); /* of nothing */
    rb_fourier_free(&second);
    assert_true(rb_fourier_make(100, &first));
    for (int round = 0; round < 2; round++) {
        for (int k = 0; k < MANY; k++)
            assert_true(rb_fourier_make(60 * (k + 1), &all[k]));
        for (int k = 0; k < MANY; k++) {
            double *x = NOT_NULL(rb_fourier_alloc(&all[k]));
            const double one[] = {0.0, 1.0};
            fftw_complex *z = rb_fourier_forward(&all[k], 2, one, x);
            for (int w = 0; w <= all[k].size / 2; w++) {
                CHECK_ABS(z[w][0], cos(2.0 * M_PI * w / all[k].size), 1e-14, "wave %d", w);
                CHECK_ABS(z[w][1], -sin(2.0 * M_PI * w / all[k].size), 1e-14, "wave %d", w);
            }
            fftw_free(x);
        }
        for (int k = 0; k < MANY; k++)
            rb_fourier_free(&all[k]);
    }
    rb_fourier_free(&first);
}

/* There and back; and a transform against its sum, as it is written down. */
TEST(transforms_are_their_sums)
{
    for (int n = 1; n < 70; n += 7) {
        OWNED(rb_fourier) f;
        assert_true(rb_fourier_make(n, &f));
        double x[80];
        for (int i = 0; i < n; i++)
            x[i] = sin(i * i + 1.0);
        double *work = rb_fourier_alloc(&f);
        fftw_complex *z = rb_fourier_forward(&f, n, x, work);
        for (int k = 0; k <= f.size / 2; k++) {
            double re = 0.0, im = 0.0;
            for (int i = 0; i < n; i++) {
                re += x[i] * cos(2.0 * M_PI * i * k / f.size);
                im -= x[i] * sin(2.0 * M_PI * i * k / f.size);
            }
            CHECK_ABS(z[k][0], re, 1e-13, "size %d, real part of wave %d", f.size, k);
            CHECK_ABS(z[k][1], im, 1e-13, "size %d, imaginary part of wave %d", f.size, k);
        }
        rb_fourier_backward(&f, work);
        for (int i = 0; i < f.size; i++)
            CHECK_ABS(work[i] / f.size, i < n ? x[i] : 0.0, 1e-15, "size %d, place %d", f.size, i);
        fftw_free(work);
    }
}

TEST(a_convolution_is_its_sum)
{
    for (int n = 1; n < 60; n += 11) {
        double t[119], r[60], w[60];
        for (int k = 0; k < 2 * n - 1; k++)
            t[k] = cos(k * k);
        for (int i = 0; i < n; i++)
            r[i] = sin(i * i + 1.0);
        rb_bem_convolution *c = NOT_NULL(rb_bem_convolution_create(n, t));
        rb_bem_convolution_apply(c, r, w);
        for (int i = 0; i < n; i++) {
            double want = 0.0;
            for (int j = 0; j < n; j++)
                want += t[n - 1 + i - j] * r[j];
            CHECK_ABS(w[i], want, 1e-13, "n = %d, row %d", n, i);
        }
        rb_bem_convolution_free(c);
    }
    rb_bem_convolution_free(NULL);
}

/* The preconditioner answers to distances alone, and is written out for distances up to
 * 2n; wave for wave, its differences are the other one over the symbol of A. */
TEST(every_wave_has_its_own_inverse)
{
    enum { n = 20, m = n + 1 };
    static const double stencil[] = {0.1, 0.9, -0.8, -0.2};
    double ends[m + 1];
    complex double wave[2][n];
    OWNED(rb_bem_flexibility) f;
    rb_bem_circulant *c;
    OWNED(rb_fourier) transform;

    for (int i = 0; i <= m; i++)
        ends[i] = i;
    CHECK_OK(rb_bem_flexibility_toeplitz(n, ends, HALFPLANE(steel, 30.0), &f, NULL));
    CHECK_OK(rb_bem_circulant_create(&f, stencil, stencil, &c));
    assert_true(rb_fourier_make(n + n / 8 + 2, &transform));
    const int size = transform.size;
    assert_in_range(size, n + 1, 2 * n - 1);
    double around[2][2 * n];
    for (int k = 0; k < 2; k++) {
        for (int at = 0; at < n; at++) {
            double one[n] = {0.0}, answer[n];
            one[at] = 1.0;
            for (int i = 0; i < n; i++)
                answer[i] = NAN;
            (k ? rb_bem_circulant_apply_difference : rb_bem_circulant_apply)(c, one, answer);
            for (int i = 0; i < n; i++) {
                const int d = (i - at + size) % size;
                if (at == 0 || d == size - at)
                    around[k][d] = answer[i];
                CHECK_ABS(answer[i], around[k][d], 1e-12 * fabs(around[k][0]),
                          "answer %d to %d, kind %d", i, at, k);
            }
        }
        for (int v = 0; v <= size / 2; v++) {
            wave[k][v] = 0.0;
            for (int d = 0; d < size; d++)
                wave[k][v] += around[k][d] * cexp(-2.0 * M_PI * I * v * d / size);
        }
        /* the mean, of which the symbol says nothing, is damped and not forgotten */
        assert_true(creal(wave[k][0]) > 0.01 * creal(wave[0][1]));
        assert_true(creal(wave[k][0]) < creal(wave[0][1]));
    }
    for (int v = 1; v <= size / 2; v++) {
        const double complex e = cexp(2.0 * M_PI * I * v / size);
        const double complex symbol =
            stencil[0] / e + stencil[1] + stencil[2] * e + stencil[3] * e * e;
        /* the middle wave of an even number has no imaginary part */
        const double complex want = wave[0][v] / symbol;
        CHECK_ABS(creal(wave[1][v]), creal(want), 1e-12 * cabs(want), "wave %d", v);
        if (2 * v < size)
            CHECK_ABS(cimag(wave[1][v]), cimag(want), 1e-12 * cabs(want), "wave %d", v);
    }
    rb_bem_circulant_free(c);
}

/* ---- Memory and clusters ----------------------------------------------------------- */

TEST(absurd_sizes_have_no_room)
{
    assert_null(rb_large_alloc(SIZE_MAX / sizeof(double), 2));
    free(rb_large_alloc(3, 0));
}

/* Of a long thin row of elements, the halves lie beside each other along it, whichever
 * way it lies, and circles reach to the ends of their elements and no further. */
TEST(clusters_are_cut_across_their_longer_side)
{
    enum { COUNT = 64 };
    rb_element e[COUNT];
    int order[COUNT];

    for (int along = 0; along < 2; along++) {
        for (int i = 0; i < COUNT; i++) {
            const double s = 10.0 * ((i * 37) % COUNT) + 100.0, t = -50.0 - i % 2;
            e[i] = (rb_element){.mx = along ? t : s, .my = along ? s : t, .a = 0.5};
        }
        rb_cluster_order(COUNT, e, 1, order);
        for (int i = 0; i < COUNT; i++) {
            const double s = along ? e[order[i]].my : e[order[i]].mx;
            assert_true((s < 100.0 + 5.0 * COUNT) == (i < COUNT / 2));
        }
        const rb_circle c = rb_cluster_circle(e, 0, COUNT);
        CHECK_REL(along ? c.y : c.x, 100.0 + 5.0 * (COUNT - 1), 1e-12, "middle");
        CHECK_REL(along ? c.x : c.y, -50.5, 1e-12, "middle");
        CHECK_REL(c.r, hypot(5.0 * (COUNT - 1), 0.5) + 0.5, 1e-12, "radius");
    }
}

/* ---- Supports and materials -------------------------------------------------------- */

/* Which places are one place is a question of the body's size. */
TEST(supports_are_judged_in_any_unit)
{
    enum { n = 16 };
    static const double radii[] = {1e-9, 1e-3, 1.0, 1e6};
    for (size_t k = 0; k < sizeof radii / sizeof *radii; k++) {
        OWNED(rb_bem_mesh) mesh;
        CHECK_OK(rb_bem_mesh_alloc(n, &mesh));
        put_circle(&mesh, 0, n, radii[k], 1, -M_PI / n);
        mesh.condition[0] = mesh.condition[1] = RB_BEM_DISPLACEMENT;
        CHECK_STATUS(rb_bem_support_check(&mesh, NULL), RB_EINVAL);
        mesh.condition[2 * (n / 2)] = RB_BEM_DISPLACEMENT; /* opposite, same height */
        CHECK_STATUS(rb_bem_support_check(&mesh, NULL), RB_EINVAL);
        mesh.condition[2 * 3] = RB_BEM_DISPLACEMENT;
        CHECK_OK(rb_bem_support_check(&mesh, NULL));
    }
}

TEST(materials_have_their_limits)
{
    static const struct {
        double shear, poisson;
        rb_status wanted;
    } all[] = {{1e-300, -1.0 + 1e-15, RB_OK}, {1e300, 0.5, RB_OK},        {1.0, -1.0, RB_EINVAL},
               {1.0, 0.5 + 1e-15, RB_EINVAL}, {1.0, NAN, RB_EINVAL},      {0.0, 0.3, RB_EINVAL},
               {-1.0, 0.3, RB_EINVAL},        {INFINITY, 0.3, RB_EINVAL}, {NAN, 0.3, RB_EINVAL}};

    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        CHECK_STATUS(
            rb_bem_material_check((rb_bem_material){all[k].shear, all[k].poisson}, &message),
            all[k].wanted);
        assert_true((message.text[0] != 0) == (all[k].wanted != RB_OK));
    }
}

/* ---- Rings ------------------------------------------------------------------------- */

/* exp(-2 m d), d = ln(radius/inner), whose sum has the primitive i ln(1 - q exp(ix)). */
static void falling_waves(const rb_bem_wheel *wheel, double m, double complex c[3])
{
    const double x = 2.0 * m * log(wheel->radius / wheel->inner);
    c[0] = m > 0.0 ? exp(-x) : 3.0;
    c[1] = m > 0.0 ? (1.0 + 2.0 * I) * exp(-x) : 0.0;
    c[2] = m > 0.0 ? exp(-x) : 0.0;
}

static double complex falling_sum(double d, double x)
{
    const double q = exp(-2.0 * d), half = sin(0.5 * x);
    return I * clog(-expm1(-2.0 * d) + 2.0 * q * half * half - I * q * sin(x));
}

/* Covers of half a radius to a millionth of it, whose sums have 50 to 2e7 waves. */
TEST(the_table_is_the_sum)
{
    for (double thickness = 0.5; thickness > 5e-7; thickness *= 0.03) {
        const rb_bem_wheel wheel = {.radius = 1.0, .inner = 1.0 - thickness};
        const double d = -log(wheel.inner), reach = fmin(1.0, 1e3 * thickness);
        const int last = (int)(RB_RING_REACH / d) + 2;
        OWNED(rb_ring_table) table;
        CHECK_OK(rb_ring_table_create(&wheel, falling_waves, last, NULL, fmin(1.0, 0.01 * d), reach,
                                      &table));
        for (int k = -200; k <= 200; k++) {
            const double x = copysign(reach * pow(1e-6, 1.0 - abs(k) / 200.0), k);
            const double complex sum = falling_sum(d, x);
            const double scale = 1.0 + cabs(sum);
            const rb_ring_answer at = rb_ring_table_at(&table, x);
            CHECK_ABS(at.N, creal(sum) + 3.0 * x, 2e-12 * scale, "N, %g at %g", d, x);
            CHECK_ABS(at.T, creal((1.0 + 2.0 * I) * sum), 2e-12 * scale, "T, %g at %g", d, x);
            CHECK_ABS(at.C, cimag(sum), 2e-12 * scale, "C, %g at %g", d, x);
        }
    }
}

/* ---- Layers ------------------------------------------------------------------------ */

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
    l->body = (rb_bem_surface){.material = {between(seed, 0.1, 5.0), between(seed, -0.5, 0.5)},
                               .datum = 10.0,
                               .terms = k % 3 == 2 ? 2 : k % 3,
                               .ratio = l->ratio,
                               .length = l->length,
                               .thickness = pow(10.0, between(seed, -2.0, 2.0)),
                               .elastic_base = k / 3 % 3 > 0};
    l->body.base = (rb_bem_material){l->body.material.shear * pow(10.0, between(seed, -2.0, 3.0)),
                                     between(seed, -0.5, 0.5)};
    for (int j = 0; j < 2; j++) {
        l->ratio[j] = pow(10.0, between(seed, -1.0, 1.0));
        l->length[j] = l->body.thickness * pow(10.0, between(seed, -2.0, 2.0));
    }
}

/* (L3) on the real axis, panels of one radian in all that is in it. */
static void integral_over_waves(const rb_bem_surface *body, double X, double b, double of[3])
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
        const double to = k < HALVINGS ? ldexp(width, k - HALVINGS) : (k - HALVINGS + 1) * width;
        for (size_t g = 0; g < ORDER; g++) {
            double al, weight;
            double complex Z[3];
            gsl_integration_glfixed_point(from, to, g, &al, &weight, rule);
            rb_bem_layer_remainder_at(body, al, Z);
            const double complex e = cexp(I * al * X) * sin(al * b) / (al * b);
            for (int c = 0; c < 3; c++)
                of[c] +=
                    weight / al * (c < 2 ? creal(Z[c] * e) - Z_0[c] * exp(-al) : cimag(Z[c] * e));
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
            const rb_bem_layer_table *table = NOT_NULL(rb_bem_layer_table_of(&l.body, fabs(X) + b));
            double want[3];
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
    const rb_bem_surface body = {
        .material = {1.0, 0.3}, .thickness = 1.0, .terms = 1, .ratio = &ratio, .length = &length};
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

/* ---- The interpolative decomposition: matrices of planted rank --------------------- */

enum { ROWS = 23, COLUMNS = 14, RANK = 5 };

/* K = sum of RANK products of smooth vectors, to 10^-decades the last. */
static void plant(double decades, double K[ROWS * COLUMNS])
{
    memset(K, 0, sizeof *K * ROWS * COLUMNS);
    for (int r = 0; r < RANK; r++)
        for (int j = 0; j < COLUMNS; j++)
            for (int i = 0; i < ROWS; i++)
                K[i + j * ROWS] += pow(10.0, -decades * r / (RANK - 1)) * cos(1.0 + r * (1.0 + i)) *
                                   sin(2.0 + (r + 1.0) * j);
}

static void decompose(const double *K, int kept, int *rank, int *order, double *T)
{
    OWNED(rb_skeleton) s;
    CHECK_OK(rb_skeleton_alloc(ROWS, COLUMNS, &s));
    memcpy(s.K, K, sizeof *K * ROWS * COLUMNS);
    CHECK_OK(rb_skeleton_factor(&s, 1e-9));
    *rank = s.rank;
    CHECK_OK(rb_skeleton_split(&s, kept < 0 ? *rank : kept, order, T));
}

static double worst_column(const double *K, int kept, const int *order, const double *T)
{
    double worst = 0.0;
    for (int j = kept; j < COLUMNS; j++)
        for (int i = 0; i < ROWS; i++) {
            double sum = 0.0;
            for (int k = 0; k < kept; k++)
                sum += K[i + order[k] * ROWS] * T[k + (j - kept) * kept];
            worst = fmax(worst, fabs(sum - K[i + order[j] * ROWS]));
        }
    return worst;
}

TEST(the_rank_is_found)
{
    double K[ROWS * COLUMNS], T[COLUMNS * COLUMNS];
    int rank, order[COLUMNS], times[COLUMNS] = {0};

    plant(3.0, K);
    decompose(K, -1, &rank, order, T);
    assert_int_equal(rank, RANK);
    CHECK_MAX(worst_column(K, rank, order, T), 1e-12, "all columns");
    for (int i = 0; i < COLUMNS; i++) {
        times[order[i]]++;
        assert_true(i == 0 || i == rank || order[i] > order[i - 1]);
    }
    for (int i = 0; i < COLUMNS; i++)
        assert_int_equal(times[i], 1);
}

/* Below the tolerance nothing counts; more may be kept than needed. */
TEST(what_is_small_is_left_out)
{
    double K[ROWS * COLUMNS], T[COLUMNS * COLUMNS];
    int rank, order[COLUMNS];

    plant(16.0, K);
    decompose(K, -1, &rank, order, T);
    assert_int_equal(rank, 3);
    CHECK_MAX(worst_column(K, rank, order, T), 1e-8, "to the tolerance");
    plant(3.0, K);
    decompose(K, RANK + 2, &rank, order, T);
    CHECK_MAX(worst_column(K, RANK + 2, order, T), 1e-11, "two more");
    memset(K, 0, sizeof K);
    decompose(K, 2, &rank, order, T);
    assert_int_equal(rank, 0);
    for (int i = 0; i < 2 * (COLUMNS - 2); i++)
        CHECK_ABS(T[i], 0.0, 0.0, "of nothing");
}

/* Matrices of many columns are shortened first, where they have as many rows: the rank
 * and the columns are those of any other. */
TEST(wide_matrices_are_shortened)
{
    static const int size[][2] = {{130, 100}, {100, 100}, {90, 100}, {130, 95}};
    for (int k = 0; k < 4; k++) {
        const int rows = size[k][0], columns = size[k][1];
        SCRATCH double *K = rb_alloc((size_t)rows, (size_t)columns),
                       *T = rb_alloc((size_t)columns, (size_t)columns);
        int order[100];
        OWNED(rb_skeleton) s;
        assert_true(K && T);
        CHECK_OK(rb_skeleton_alloc(rows, columns, &s));
        for (int j = 0; j < columns; j++)
            for (int i = 0; i < rows; i++) {
                for (int r = 0; r < RANK; r++)
                    K[i + j * rows] += cos(1.0 + r * (1.0 + i)) * sin(2.0 + (r + 1.0) * j);
                s.K[i + (size_t)j * (size_t)s.ld] = K[i + j * rows];
            }
        CHECK_OK(rb_skeleton_factor(&s, 1e-9));
        assert_int_equal(s.rank, RANK);
        CHECK_OK(rb_skeleton_split(&s, RANK, order, T));
        for (int j = RANK; j < columns; j++)
            for (int i = 0; i < rows; i++) {
                double sum = 0.0;
                for (int r = 0; r < RANK; r++)
                    sum += K[i + order[r] * rows] * T[r + (j - RANK) * RANK];
                CHECK_ABS(sum, K[i + order[j] * rows], 1e-11, "size %d: %d %d", k, i, j);
            }
    }
}

RUN_TESTS(NULL, NULL)
