/* Flexibilities of the contact: the half-plane and the pair of bodies. */
#include "bem_shapes.h"
#include "check.h"
#include "bem/bem.h"

#include <complex.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_math.h>

static const rb_bem_material steel = {.shear = 82000.0, .poisson = 0.28};
static const double uneven[] = {-1.0, -0.7, -0.65, 0.1, 0.4, 0.5, 1.1};
enum { n_uneven = 5 };

static double log_distance(double s, void *point)
{
    return log(fabs(s - *(double *)point));
}

/* int ln(|x - s|/d) ds by quadrature; the singular point, if inside, splits the strip */
static double quadrature(double s1, double s2, double x, double d)
{
    gsl_integration_workspace *ws = gsl_integration_workspace_alloc(200);
    gsl_function f = {log_distance, &x};
    const double cut = x > s1 && x < s2 ? x : s1;
    double left = 0.0, right, error;
    if (cut > s1)
        gsl_integration_qags(&f, s1, cut, 0, 1e-13, 200, ws, &left, &error);
    gsl_integration_qags(&f, cut, s2, 0, 1e-13, 200, ws, &right, &error);
    gsl_integration_workspace_free(ws);
    return left + right - (s2 - s1) * log(d);
}

TEST(halfplane_is_flamants_integral)
{
    enum { n = n_uneven, m = n + 1 };
    const double datum = 30.0, K = (1.0 - steel.poisson) / (M_PI * steel.shear),
                 c = (1.0 - 2.0 * steel.poisson) / (4.0 * steel.shear);
    double F[2 * m * 2 * n];
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_flexibility_halfplane(n, uneven, steel, datum, &f, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * m));
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            const double *N = F + 2 * m * j, *T = F + 2 * m * (n + j), x = f.x[i];
            const double want = -K * quadrature(uneven[j], uneven[j + 1], x, datum);
            const double sign = fabs(x - uneven[j]) - fabs(x - uneven[j + 1]);
            CHECK_REL(N[i], want, 1e-12, "NN %d %d", i, j);
            CHECK_REL(T[m + i], want, 1e-12, "TT %d %d", i, j);
            CHECK_ABS(T[i], c * sign, 1e-15 * c, "NT %d %d", i, j);
            CHECK_ABS(N[m + i], -c * sign, 1e-15 * c, "TN %d %d", i, j);
        }
}

/* One strip far away: int ln|s/d| ds = 2b [ln(X/d) - (b/X)^2/6 - ...]; the two ends of
 * the primitive agree in their first seven digits. */
TEST(distant_strips_lose_no_digits)
{
    const int n = 1000000;
    const double h = 1e-9, X = h * (n - 1), K = (1.0 - steel.poisson) / (M_PI * steel.shear);
    const double ends[] = {0.0, h, X, X + h};
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_flexibility_surface(2, ends, HALFPLANE(steel, 40.0), &f, NULL));
    double w[6];
    rb_bem_flexibility_apply(&f, (const double[]){1.0, 0.0, 0.0, 0.0}, w);
    CHECK_REL(w[2], -K * h * (log(X / 40.0) - pow(0.5 * h / X, 2) / 6.0), 1e-14, "far");
}

TEST(apply_is_the_matrix_and_ldf_is_kept)
{
    enum { n = n_uneven, m = n + 1, ld = 2 * m + 3 };
    double F[ld * 2 * n], r[2 * n], w[2 * m];
    rb_bem_flexibility a, b, f;
    CHECK_OK(rb_bem_flexibility_surface(n, uneven, HALFPLANE(steel, 7.0), &a, NULL));
    CHECK_OK(rb_bem_flexibility_surface(n, uneven, HALFPLANE(steel, 9.0), &b, NULL));
    CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
    for (int i = 0; i < ld * 2 * n; i++)
        F[i] = -77.0;
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, ld));
    CHECK_STATUS(rb_bem_flexibility_matrix(&f, F, 2 * m - 1), RB_EINVAL);
    for (int j = 0; j < 2 * n; j++)
        CHECK_ABS(F[ld * j + 2 * m], -77.0, 0.0, "below column %d", j);
    for (int i = 0; i < 2 * n; i++)
        r[i] = sin(1.0 + i);
    rb_bem_flexibility_apply(&f, r, w);
    for (int i = 0; i < 2 * m; i++) {
        double want = 0.0;
        for (int j = 0; j < 2 * n; j++)
            want += F[i + ld * j] * r[j];
        CHECK_ABS(w[i], want, 1e-18, "row %d", i);
    }
    rb_bem_flexibility_free(&f);
}

/* Half-planes under elements three times as long, and elsewhere: by a scale and a logarithm. */
TEST(stretched_elements_are_those_of_longer_ends)
{
    enum { n = n_uneven, m = n + 1, entries = 2 * m * 2 * n };
    const double scale = 3.0, K = 2.0 * (1.0 - steel.poisson) / (M_PI * steel.shear);
    double longer[m + 1], F[2][entries];
    for (int i = 0; i <= m; i++)
        longer[i] = 0.3 + scale * uneven[i];
    for (int k = 0; k < 2; k++) {
        const double *ends = k ? longer : uneven;
        rb_bem_flexibility a, b;
        OWNED(rb_bem_flexibility) f;
        CHECK_OK(rb_bem_flexibility_surface(n, ends, HALFPLANE(steel, 7.0), &a, NULL));
        CHECK_OK(rb_bem_flexibility_surface(n, ends, HALFPLANE(steel, 9.0), &b, NULL));
        CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
        if (k == 0)
            CHECK_OK(rb_bem_flexibility_stretch(&f, longer, scale, -K * log(scale)));
        CHECK_OK(rb_bem_flexibility_matrix(&f, F[k], 2 * m));
        CHECK_REL(f.x[1], 0.5 * (longer[1] + longer[2]), 1e-14, "midpoint");
        CHECK_REL(f.h[1], longer[2] - longer[1], 1e-14, "length");
    }
    for (int k = 0; k < entries; k++)
        CHECK_ABS(F[0][k], F[1][k], 1e-14 * fabs(F[1][0]), "entry %d", k);
}

/* Two bodies of one material: twice the compliance, no coupling, B's w0_T turned round. */
TEST(identical_bodies_lose_their_coupling)
{
    enum { n = n_uneven, m = n + 1 };
    double A[2 * m * 2 * n], F[2 * m * 2 * n];
    rb_bem_flexibility a, b, f;
    CHECK_OK(rb_bem_flexibility_surface(n, uneven, HALFPLANE(steel, 7.0), &a, NULL));
    CHECK_OK(rb_bem_flexibility_surface(n, uneven, HALFPLANE(steel, 7.0), &b, NULL));
    CHECK_OK(rb_bem_flexibility_matrix(&a, A, 2 * m));
    a.w0[1] = a.w0[m + 1] = 3.0;
    b.w0[1] = b.w0[m + 1] = 5.0;
    CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
    assert_null(a.x);
    assert_null(b.data);
    CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * m));
    for (int j = 0; j < 2 * n; j++)
        for (int i = 0; i < 2 * m; i++) {
            const int coupling = (i < m) != (j < n);
            CHECK_ABS(F[i + 2 * m * j], coupling ? 0.0 : 2.0 * A[i + 2 * m * j], 1e-20,
                      "entry %d %d", i, j);
        }
    CHECK_ABS(f.w0[1], 8.0, 0.0, "w0_N");
    CHECK_ABS(f.w0[m + 1], -2.0, 0.0, "w0_T");
    rb_bem_flexibility_free(&f);
}

/* A load of which neither sum nor moment is left does not feel the datum, nor the ends of
 * the line, and varies over `width` elements. */
static void wavelet(int n, double width, double *r)
{
    for (int i = 0; i < n; i++) {
        const double x = (i - 0.5 * n) / width;
        r[i] = (1.0 - 2.0 * x * x) * exp(-x * x);
    }
}

/* The preconditioner takes back what a half-plane makes of such loads, with an interface
 * that yields in between or without, and the differences upstream of what it slides. */
TEST(a_line_is_nearly_inverted_by_its_waves)
{
    enum { n = 200, m = n + 1 };
    static const double stencil[] = {0.1, 0.9, -0.8, -0.2};
    double ends[m + 1], r[2 * n] = {0.0}, w[2 * m], line[n], loose[n], stiff[n];

    for (int i = 0; i <= m; i++)
        ends[i] = i / 64.0;
    for (int i = 0; i < n; i++) {
        loose[i] = 3e-8;
        stiff[i] = 1e-8;
    }
    for (int k = 0; k < 6; k++) {
        OWNED(rb_bem_flexibility) f;
        rb_bem_circulant *c;
        CHECK_OK(rb_bem_flexibility_toeplitz(n, ends, HALFPLANE(steel, 30.0), &f, NULL));
        if (k % 2)
            CHECK_OK(rb_bem_flexibility_add_compliance(&f, loose, stiff));
        CHECK_OK(rb_bem_circulant_create(&f, stencil, stencil, &c));
        double worst[2] = {0.0};
        for (int tangential = 0; tangential < 2; tangential++) {
            memset(r, 0, sizeof r);
            wavelet(n, k < 2 ? 1.0 : k < 4 ? 4.0 : 10.0, r + tangential * n);
            rb_bem_flexibility_apply(&f, r, w);
            const double *moved = w + tangential * m;
            for (int i = 0; i < n; i++) {
                line[i] = moved[i];
                if (tangential)
                    line[i] = stencil[0] * moved[i > 0 ? i - 1 : 0] + stencil[1] * moved[i] +
                              stencil[2] * moved[i + 1] +
                              stencil[3] * moved[i + 2 < m ? i + 2 : i + 1];
            }
            if (tangential)
                rb_bem_circulant_apply_difference(c, line, line);
            else
                rb_bem_circulant_apply(c, line, line);
            for (int i = n / 10; i < n - n / 10; i++)
                worst[tangential] = fmax(worst[tangential], fabs(line[i] - r[i + tangential * n]));
        }
        CHECK_MAX(worst[0], k < 2 ? 1e-3 : 2e-4, "pressure, case %d", k);
        CHECK_MAX(worst[1], k < 2 ? 1e-3 : 1e-4, "friction, case %d", k);
        rb_bem_circulant_free(c);
    }
}

TEST(bad_input_is_refused)
{
    rb_bem_flexibility a, b, f;
    const double flat[] = {0.0, 1.0, 1.0}, two[] = {0.0, 1.0, 2.0}, odd[] = {0.0, NAN, 2.0};
    const struct {
        int n;
        const double *ends;
        rb_bem_material material;
        double datum;
        const char *text;
    } bad[] = {
        {0, two, steel, 1.0, "at least 1"},    {1, flat, steel, 1.0, "increasing"},
        {1, odd, steel, 1.0, "increasing"},    {1, two, steel, 0.0, "datum"},
        {1, two, steel, NAN, "datum"},         {1, two, {-1.0, 0.3}, 1.0, "shear"},
        {1, two, {1.0, 0.51}, 1.0, "Poisson"}, {1, two, {1.0, NAN}, 1.0, "Poisson"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        CHECK_SAYS(rb_bem_flexibility_surface(bad[k].n, bad[k].ends,
                                              HALFPLANE(bad[k].material, bad[k].datum), &f,
                                              &message),
                   RB_EINVAL, bad[k].text);
        assert_null(f.x);
    }
    const double moved[] = {0.0, 1.0, 2.1};
    CHECK_OK(rb_bem_flexibility_surface(1, two, HALFPLANE(steel, 1.0), &a, NULL));
    CHECK_OK(rb_bem_flexibility_surface(1, moved, HALFPLANE(steel, 1.0), &b, NULL));
    CHECK_SAYS(rb_bem_flexibility_pair(&a, &b, &f, &message), RB_EINVAL,
               "point 1 at x = 1.5 on A, 1.55 on B");
    assert_null(a.x);
    for (int e = -6; e <= 6; e += 6) /* of any unit of length */
        for (int k = 0; k < 2; k++) {
            const double h = pow(10.0, e), ends_a[] = {-h, 0.0, h},
                         ends_b[] = {-h, 0.0, h * (1.0 + (k ? 1e-8 : 1e-10))};
            CHECK_OK(rb_bem_flexibility_surface(1, ends_a, HALFPLANE(steel, h), &a, NULL));
            CHECK_OK(rb_bem_flexibility_surface(1, ends_b, HALFPLANE(steel, h), &b, NULL));
            CHECK_STATUS(rb_bem_flexibility_pair(&a, &b, &f, NULL), k ? RB_EINVAL : RB_OK);
            rb_bem_flexibility_free(&f);
        }
    CHECK_OK(rb_bem_flexibility_surface(1, two, HALFPLANE(steel, 1.0), &a, NULL));
    CHECK_OK(rb_bem_flexibility_surface(n_uneven, uneven, HALFPLANE(steel, 1.0), &b, NULL));
    CHECK_STATUS(rb_bem_flexibility_pair(&a, &b, &f, NULL), RB_EINVAL);
}

/* Every allocation refused in its turn: no leak (asan), nothing left behind. */
TEST(failing_memory_is_reported)
{
    for (int count = 0, failed = 1; failed; count++) {
        OWNED(rb_bem_flexibility) a = {0}, b = {0}, f = {0};
        double F[2 * (n_uneven + 1) * 2 * n_uneven];
        alloc_fail_after(count);
        rb_status s = rb_bem_flexibility_surface(n_uneven, uneven, HALFPLANE(steel, 1.0), &a, NULL);
        if (s == RB_OK)
            s = rb_bem_flexibility_surface(n_uneven, uneven, HALFPLANE(steel, 1.0), &b, NULL);
        if (s == RB_OK)
            s = rb_bem_flexibility_pair(&a, &b, &f, NULL);
        if (s == RB_OK)
            s = rb_bem_flexibility_matrix(&f, F, 2 * f.m);
        failed = alloc_failed();
        alloc_succeed();
        CHECK_STATUS(s, failed ? RB_ENOMEM : RB_OK);
    }
    rb_bem_flexibility_free(NULL);
}

RUN_TESTS(NULL, NULL)
