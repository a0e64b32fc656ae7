/* The half-plane by Fourier transforms against its dense matrix. */
#include "bem_shapes.h"
#include "check.h"
#include "bem/bem.h"

#include <gsl/gsl_math.h>

typedef rb_status make(int, const double *, const rb_bem_surface *, rb_bem_flexibility *,
                       rb_message *);

static double *equal_ends(int n, double from, double to)
{
    double *ends = NOT_NULL(rb_alloc((size_t)n + 2, 1));
    for (int i = 0; i <= n + 1; i++)
        ends[i] = (from * (n - i) + to * i) / n;
    return ends;
}

static const rb_bem_material steel = {82000.0, 0.28}, rubber = {1.0, 0.5},
                             aluminium = {23000.0, 0.31};

static const double one_depth[2];

/* sheared: depths of zero tangential displacement over those of zero normal displacement, or 0 */
static rb_bem_flexibility built(make *by, int n, rb_bem_material a, const rb_bem_material *b,
                                double datum, const double sheared[2])
{
    SCRATCH double *ends = equal_ends(n, -1.3e-3, 1.1e-3);
    rb_bem_flexibility f, of_a, of_b;
    rb_bem_surface above = *HALFPLANE(a, datum);
    above.datum_tangential = sheared[0] * datum;
    CHECK_OK(by(n, ends, &above, &of_a, &message));
    f = of_a;
    if (b) {
        rb_bem_surface below = *HALFPLANE(*b, 2.0 * datum);
        below.datum_tangential = sheared[1] * datum;
        CHECK_OK(by(n, ends, &below, &of_b, &message));
        CHECK_OK(rb_bem_flexibility_pair(&of_a, &of_b, &f, &message));
    }
    return f;
}

static double largest(size_t n, const double *x)
{
    return rb_norm_inf(n, x);
}

/* Entries, products with random tractions, points: relative to the largest entry. */
static void compare(int n, rb_bem_material a, const rb_bem_material *b, double datum,
                    const double sheared[2])
{
    OWNED(rb_bem_flexibility) dense = built(rb_bem_flexibility_surface, n, a, b, datum, sheared);
    OWNED(rb_bem_flexibility) fast = built(rb_bem_flexibility_toeplitz, n, a, b, datum, sheared);
    const int m = dense.m, ld = 2 * m + 3;
    SCRATCH double *F = rb_alloc((size_t)ld, 2 * (size_t)n),
                   *T = rb_alloc((size_t)ld, 2 * (size_t)n);
    SCRATCH double *r = rb_alloc(2 * (size_t)n, 1), *w = rb_alloc(4 * (size_t)m, 1);

    assert_true(F && T && r && w);
    assert_int_equal(fast.n, n);
    assert_int_equal(fast.m, m);
    CHECK_OK(rb_bem_flexibility_matrix(&dense, F, ld));
    CHECK_OK(rb_bem_flexibility_matrix(&fast, T, ld));
    const double scale = largest((size_t)ld * 2 * (size_t)n, F);
    for (size_t k = 0; k < (size_t)ld * 2 * (size_t)n; k++)
        CHECK_ABS(T[k], F[k], 1e-13 * scale, "n = %d, entry %zu", n, k);
    for (int i = 0; i < m; i++) {
        CHECK_ABS(fast.x[i], dense.x[i], 0.0, "x");
        CHECK_ABS(fast.h[i], dense.h[i], 0.0, "h");
        CHECK_ABS(fast.w0[i] + fast.w0[m + i], 0.0, 0.0, "w0");
    }
    srand(7);
    double sum = 0.0;
    for (int j = 0; j < 2 * n; j++)
        sum += fabs(r[j] = rand() / (double)RAND_MAX - 0.3);
    rb_bem_flexibility_apply(&dense, r, w);
    rb_bem_flexibility_apply(&fast, r, w + 2 * m);
    for (int i = 0; i < 2 * m; i++)
        CHECK_ABS(w[2 * m + i], w[i], 1e-14 * scale * sum, "n = %d, row %d", n, i);
}

TEST(equals_the_dense_matrix)
{
    const int n[] = {1, 2, 3, 7, 64, 201};
    static const double sheared[][2] = {{0.0, 0.0}, {1.5, 0.0}, {0.0, 1.5}, {1.5, 0.7}};
    for (size_t k = 0; k < sizeof n / sizeof *n; k++)
        for (int j = 0; j < 4; j++) {
            compare(n[k], steel, NULL, 10.0, sheared[j]);
            compare(n[k], rubber, NULL, 1.0, sheared[j]);
            compare(n[k], steel, &aluminium, 10.0, sheared[j]);
            compare(n[k], steel, &steel, 10.0, sheared[j]);
        }
}

/* A pair of two kinds keeps both; two matrices become one, in the place of the first. */
TEST(pairs_of_any_kind_agree)
{
    enum { n = 12, m = n + 1 };
    make *const kind[] = {rb_bem_flexibility_surface, rb_bem_flexibility_toeplitz};
    double F[4][4 * m * n], w[4][2 * m], r[2 * n], *ends = equal_ends(n, -1.0, 2.0);

    for (int j = 0; j < 2 * n; j++)
        r[j] = sin(1.0 + j);
    for (int k = 0; k < 4; k++) {
        rb_bem_flexibility a, b, f;
        CHECK_OK(kind[k / 2](n, ends, HALFPLANE(steel, 9.0), &a, NULL));
        CHECK_OK(kind[k % 2](n, ends, HALFPLANE(aluminium, 4.0), &b, NULL));
        const double *first = rb_bem_flexibility_stored(&a);
        CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
        assert_ptr_equal(rb_bem_flexibility_stored(&f), k == 0 ? first : NULL);
        CHECK_OK(rb_bem_flexibility_matrix(&f, F[k], 2 * m));
        rb_bem_flexibility_apply(&f, r, w[k]);
        double stored[2 * m];
        CHECK_OK(rb_bem_flexibility_store(&f));
        assert_non_null(rb_bem_flexibility_stored(&f));
        assert_memory_equal(rb_bem_flexibility_stored(&f), F[k], sizeof F[k]);
        rb_bem_flexibility_apply(&f, r, stored);
        for (int i = 0; i < 2 * m; i++)
            CHECK_ABS(stored[i], w[k][i], 1e-13 * largest(2 * m, w[k]), "pair %d", k);
        rb_bem_flexibility_free(&f);
        for (int i = 0; i < 4 * m * n; i++)
            CHECK_ABS(F[k][i], F[0][i], 1e-13 * largest(4 * m * n, F[0]), "pair %d", k);
        for (int i = 0; i < 2 * m; i++)
            CHECK_ABS(w[k][i], w[0][i], 1e-13 * largest(2 * m, w[0]), "pair %d", k);
    }
    free(ends);
}

/* A deep datum adds a constant that must not drown the rest. */
TEST(keeps_differences_under_a_deep_datum)
{
    enum { n = 500 };
    OWNED(rb_bem_flexibility)
    near = built(rb_bem_flexibility_toeplitz, n, steel, NULL, 1.0, one_depth);
    OWNED(rb_bem_flexibility)
    deep = built(rb_bem_flexibility_toeplitz, n, steel, NULL, 1e12, one_depth);
    double r[2 * n] = {0}, w[4 * (n + 1)];
    for (int j = 0; j < n; j++)
        r[j] = j % 2 ? 1.0 : -1.0;
    rb_bem_flexibility_apply(&near, r, w);
    rb_bem_flexibility_apply(&deep, r, w + 2 * (n + 1));
    const double scale = largest(n, w);
    for (int i = 0; i < n; i++)
        CHECK_ABS(w[2 * (n + 1) + i], w[i], 1e-12 * scale, "row %d", i);
}

TEST(long_lines_work)
{
    enum { n = 200000 };
    OWNED(rb_bem_flexibility)
    f = built(rb_bem_flexibility_toeplitz, n, steel, NULL, 10.0, one_depth);
    double *r = rb_alloc(2 * n, 1), *w = rb_alloc(2 * (size_t)f.m, 1), one[2];
    const double ends[2] = {-1.3e-3 + 1000 * 2.4e-3 / n, -1.3e-3 + 1001 * 2.4e-3 / n};
    double W[8];
    assert_true(r && w);
    r[1000] = 3.0;
    r[n + 1000] = -2.0;
    rb_bem_flexibility_apply(&f, r, w);
    for (int i = 0; i < f.m; i += 19997) {
        one[0] = f.x[i];
        one[1] = f.x[i] + 1.0;
        CHECK_OK(rb_bem_surface_displacement(HALFPLANE(steel, 10.0), 1, ends, 2, one, W));
        CHECK_REL(w[i], 3.0 * W[0] - 2.0 * W[4], 1e-9, "N of row %d", i);
        CHECK_REL(w[f.m + i], 3.0 * W[2] - 2.0 * W[6], 1e-9, "T of row %d", i);
    }
    free(r);
    free(w);
}

static void refuse(int n, const double *ends, rb_bem_material material, double datum,
                   const char *word)
{
    OWNED(rb_bem_flexibility) f;
    CHECK_SAYS(rb_bem_flexibility_toeplitz(n, ends, HALFPLANE(material, datum), &f, &message),
               RB_EINVAL, word);
    assert_null(f.x);
}

/* ---- The disc ---------------------------------------------------------------------- */

static double *equal_arcs(int n, double radius, double from, double to)
{
    double *ends = equal_ends(n, from, to);
    for (int i = 0; i <= n + 1; i++)
        ends[i] = radius * sin(ends[i]);
    return ends;
}

static rb_bem_flexibility disc(int n, double radius, double from, double to, rb_bem_normals normals)
{
    SCRATCH double *ends = equal_arcs(n, radius, from, to);
    rb_bem_flexibility f;
    CHECK_OK(
        rb_bem_flexibility_disc(n, ends, &(rb_bem_disc){radius, steel}, normals, &f, &message));
    return f;
}

/* Products are those of the matrix, in both frames; the matrix is symmetric. */
TEST(the_disc_is_symmetric)
{
    enum { n = 90, m = n + 1 };
    static double F[2 * m * 2 * n], r[2 * n], w[2 * m];
    for (int normals = 0; normals < 2; normals++) {
        OWNED(rb_bem_flexibility) f = disc(n, 40.0, -1.2, 0.7, (rb_bem_normals)normals);
        CHECK_OK(rb_bem_flexibility_matrix(&f, F, 2 * m));
        const double scale = largest(sizeof F / sizeof *F, F);
        for (int i = 0; i < 2 * n; i++) {
            r[i] = sin(3.0 * i * i);
            for (int j = 0; j < i; j++) {
                const int row = i < n ? i : i + 1, column = j < n ? j : j + 1;
                CHECK_ABS(F[row + j * 2 * m], F[column + i * 2 * m], 1e-13 * scale, "entry %d, %d",
                          i, j);
            }
        }
        rb_bem_flexibility_apply(&f, r, w);
        for (int i = 0; i < 2 * m; i++) {
            double sum = 0.0;
            for (int j = 0; j < 2 * n; j++)
                sum += F[i + j * 2 * m] * r[j];
            CHECK_ABS(w[i], sum, 1e-12 * scale, "row %d", i);
        }
    }
}

/* From the frame of the obstacle to that of the surface at this angle; way -1: back. */
static void turn(double angle, double way, const double in[2], double out[2])
{
    const double c = cos(angle), s = way * sin(angle);
    out[0] = c * in[0] - s * in[1];
    out[1] = s * in[0] + c * in[1];
}

/* The obstacle's frame is the surface's, turned by the angle of each point and element. */
TEST(the_obstacles_frame_is_turned_by_the_angle)
{
    enum { n = 24, m = n + 1 };
    static double F[2][2 * m * 2 * n];
    const double from = -1.2, h = (0.7 - from) / n;
    for (int normals = 0; normals < 2; normals++) {
        OWNED(rb_bem_flexibility) f = disc(n, 40.0, from, 0.7, (rb_bem_normals)normals);
        CHECK_OK(rb_bem_flexibility_matrix(&f, F[normals], 2 * m));
    }
    const double *own = F[RB_BEM_NORMALS_SURFACE], *turned = F[RB_BEM_NORMALS_OBSTACLE];
    const double scale = largest(sizeof F[0] / sizeof F[0][0], own);
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++)
            for (int b = 0; b < 2; b++) {
                const double load[2] = {b == 0, b == 1}, at = from + (j + 0.5) * h;
                double r[2], w[2], want[2];
                turn(at, 1.0, load, r);
                for (int a = 0; a < 2; a++)
                    w[a] =
                        own[a * m + i + j * 2 * m] * r[0] + own[a * m + i + (n + j) * 2 * m] * r[1];
                turn(from + (i + 0.5) * h, -1.0, w, want);
                for (int a = 0; a < 2; a++)
                    CHECK_ABS(turned[a * m + i + (b * n + j) * 2 * m], want[a], 1e-13 * scale,
                              "%d%d of point %d, element %d", a, b, i, j);
            }
}

/* A rigid motion apart it is the reference: u and what is expected differ by c, t e_x. */
TEST(the_disc_is_the_reference_but_for_a_translation)
{
    enum { n = 40, m = n + 1, j = 13 };
    static double r[2 * n], w[2 * m];
    const double radius = 40.0, h = 2.0 / n;
    OWNED(rb_bem_flexibility) f = disc(n, radius, -1.1, 0.9, RB_BEM_NORMALS_SURFACE);
    r[j] = -0.6; /* p_r = 0.6, p_t = 1.3 */
    r[n + j] = 1.3;
    rb_bem_flexibility_apply(&f, r, w);
    double first[2] = {0.0, 0.0};
    for (int i = 0; i < m; i++) {
        double u[4], angle = -1.1 + (i + 0.5) * h - 0.5 * M_PI;
        CHECK_OK(rb_bem_disc_response(&(rb_bem_disc){radius, steel}, h, (i - j) * h, u));
        const double dr = -w[i] - (0.6 * u[0] + 1.3 * u[2]);
        const double dt = w[m + i] - (0.6 * u[1] + 1.3 * u[3]);
        const double dx = dr * cos(angle) - dt * sin(angle), dy = dr * sin(angle) + dt * cos(angle);
        if (i == 0) {
            first[0] = dx;
            first[1] = dy;
        }
        CHECK_ABS(dx, first[0], 1e-13 * fabs(u[0]) + 1e-18, "x of point %d", i);
        CHECK_ABS(dy, first[1], 1e-13 * fabs(u[0]) + 1e-18, "y of point %d", i);
    }
}

/* Near its load the disc answers like a half-plane, to the order of the angle. */
TEST(a_short_arc_is_a_half_plane)
{
    enum { n = 50, m = n + 1 };
    static double r[2 * n], w[2 * m], v[2 * m];
    SCRATCH double *ends = equal_arcs(n, 1e4, -1e-7, 1e-7);
    OWNED(rb_bem_flexibility)
    half, f = disc(n, 1e4, -1e-7, 1e-7, RB_BEM_NORMALS_OBSTACLE);
    CHECK_OK(rb_bem_flexibility_toeplitz(n, ends, HALFPLANE(steel, 1.0), &half, NULL));
    for (int i = 0; i < n; i++) {
        r[i] = 1.0 + sin(i);
        r[n + i] = cos(i);
    }
    rb_bem_flexibility_apply(&f, r, w);
    rb_bem_flexibility_apply(&half, r, v);
    for (int i = 1; i < m; i++) {
        CHECK_ABS(w[i] - w[0], v[i] - v[0], 1e-5 * fabs(v[n / 2] - v[0]), "N of %d", i);
        CHECK_ABS(w[m + i] - w[m], v[m + i] - v[m], 1e-5 * fabs(v[n / 2] - v[0]), "T of %d", i);
    }
}

TEST(bad_discs_are_refused)
{
    const double equal[] = {-1.5, -0.5, 0.5, 1.5};
    rb_bem_flexibility f;
    CHECK_STATUS(rb_bem_flexibility_disc(2, equal, &(rb_bem_disc){2.0, steel},
                                         RB_BEM_NORMALS_SURFACE, &f, &message),
                 RB_EINVAL);
    assert_non_null(strstr(message.text, "another length"));
    CHECK_STATUS(rb_bem_flexibility_disc(2, equal, &(rb_bem_disc){1.5, steel},
                                         RB_BEM_NORMALS_SURFACE, &f, &message),
                 RB_EINVAL);
    assert_non_null(strstr(message.text, "radius 1.5: contact from -1.5 to 1.5 is wider"));
    const double tilted[] = {-1.0, 0.0, 1.0, 2.0};
    for (int k = 0; k < 2; k++) {
        double ends[4];
        for (int i = 0; i < 4; i++)
            ends[i] = k ? -tilted[3 - i] : tilted[i];
        CHECK_STATUS(rb_bem_flexibility_disc(2, ends, &(rb_bem_disc){1.9, steel},
                                             RB_BEM_NORMALS_SURFACE, &f, &message),
                     RB_EINVAL);
        assert_non_null(strstr(message.text, k ? "from -2 to 1 is" : "from -1 to 2 is"));
    }
    SCRATCH double *ends = equal_arcs(6, 3.0, -0.5, 0.5);
    for (int k = 0, refused = 1; refused; k++) {
        refused = REFUSED_FROM(k, rb_bem_flexibility_disc(6, ends, &(rb_bem_disc){3.0, steel},
                                                          RB_BEM_NORMALS_OBSTACLE, &f, &message));
        rb_bem_flexibility_free(&f);
        assert_true(k < 40);
    }
}

/* Whether elements are equal does not depend on the unit of length, nor on where they
 * lie, but for the rounding of their places. */
TEST(equal_lengths_are_those_of_any_unit)
{
    enum { n = 6 };
    for (int e = -9; e <= 9; e += 3)
        for (int side = -1; side <= 1; side++) {
            const double h = pow(10.0, e), far = 1e8 * side * h;
            double ends[n + 2];
            OWNED(rb_bem_flexibility) f;
            for (int i = 0; i < n + 2; i++)
                ends[i] = far + i * h;
            CHECK_OK(rb_bem_flexibility_toeplitz(n, ends, HALFPLANE(steel, h), &f, NULL));
            ends[2] += 1e-6 * h;
            refuse(n, ends, steel, h, "different lengths");
        }
}

TEST(bad_input)
{
    const double equal[] = {0, 1, 2, 3}, unequal[] = {0, 1, 2, 3.0001}, falling[] = {0, 1, 1, 3};
    refuse(2, unequal, steel, 1.0, "different lengths");
    refuse(2, falling, steel, 1.0, "increasing");
    refuse(0, equal, steel, 1.0, "at least 1");
    refuse(2, equal, steel, 0.0, "datum");
    refuse(2, equal, steel, INFINITY, "datum");
    refuse(2, equal, (rb_bem_material){-1.0, 0.3}, 1.0, "");
    refuse(2, equal, (rb_bem_material){1.0, 0.6}, 1.0, "");

    OWNED(rb_bem_flexibility) f =
        built(rb_bem_flexibility_toeplitz, 5, steel, NULL, 1.0, one_depth);
    double F[144];
    CHECK_STATUS(rb_bem_flexibility_matrix(&f, F, 11), RB_EINVAL);
}

TEST(failing_allocations)
{
    SCRATCH double *ends = equal_ends(6, 0.0, 1.0);
    for (int k = 0, refused = 1; refused; k++) {
        OWNED(rb_bem_flexibility) f;
        refused = REFUSED_FROM(
            k, rb_bem_flexibility_toeplitz(6, ends, HALFPLANE(steel, 1.0), &f, &message));
        assert_true(k < 40);
    }
}

RUN_TESTS(NULL, NULL)
