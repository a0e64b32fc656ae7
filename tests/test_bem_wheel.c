/* The flexibility of wheels by their waves (B12): against the sum of Michell's waves,
 * against boundary elements and against the flat layer. */
#include "check.h"
#include "michell.h"

#include <gsl/gsl_math.h>

static double *matrix_of(const rb_bem_flexibility *f)
{
    double *F = malloc(sizeof(double) * 4 * (size_t)f->m * (size_t)f->n);
    CHECK_OK(rb_bem_flexibility_matrix(f, F, 2 * f->m));
    return F;
}

static double *wheel_matrix(const rb_bem_wheel *wheel, rb_bem_normals normals, int n,
                            const double *ends)
{
    OWNED(rb_bem_flexibility) f;
    CHECK_OK(rb_bem_flexibility_wheel(n, ends, wheel, normals, &f, &message));
    double *F = matrix_of(&f);
    return F;
}

/* A ring, a cover on a rigid core, the same incompressible, covers on soft and hard
 * cores, a thick one on a small hub. */
static const rb_bem_wheel wheels[] = {{10.0, 5.0, {3.0, 0.3}, 0, NULL, NULL, 0.0, {0.0, 0.0}},
                                      {10.0, 9.0, {3.0, 0.4}, 0, NULL, NULL, 0.0, {0.0, 0.0}},
                                      {10.0, 9.0, {3.0, 0.5}, 0, NULL, NULL, 0.0, {0.0, 0.0}},
                                      {10.0, 8.0, {3.0, 0.48}, 0, NULL, NULL, 4.0, {5.0, 0.25}},
                                      {10.0, 9.0, {3.0, 0.3}, 0, NULL, NULL, 6.0, {1e4, 0.3}},
                                      {10.0, 4.0, {3.0, -0.5}, 0, NULL, NULL, 0.1, {1.0, 0.5}}};
enum { WHEELS = sizeof wheels / sizeof *wheels };

enum { N = 24, M = N + 1 };
static const double HALF_ARC = 0.01;

/* Equal arcs. */
static void arcs(double radius, double *ends)
{
    for (int i = 0; i < N + 2; i++)
        ends[i] = radius * sin(HALF_ARC * (2 * i - N));
}

/* Over the disc in closed form, whose waves 0 and 1 are known, a wheel has the waves of
 * its inner contour; all are summed one by one. */
TEST(the_flexibility_is_the_sum_of_its_waves)
{
    enum { LAST = 400, EXACT = 60 };
    static cplx C[LAST + 1][4];
    for (int k = 0; k < WHEELS; k++) {
        const rb_bem_wheel *w = wheels + k;
        const double ka = 3.0 - 4.0 * w->material.poisson,
                     G = w->radius / (2.0 * w->material.shear);
        const rb_bem_disc disc = {w->radius, w->material};
        double ends[N + 2], largest = 0.0;
        OWNED(rb_bem_flexibility) f;
        arcs(w->radius, ends);
        SCRATCH double *F = wheel_matrix(w, RB_BEM_NORMALS_SURFACE, N, ends);
        CHECK_OK(rb_bem_flexibility_disc(N, ends, &disc, RB_BEM_NORMALS_SURFACE, &f, NULL));
        SCRATCH double *D = matrix_of(&f);
        for (int m = 0; m <= LAST; m++) {
            const double out = 0.5 * ka / (m + 1), in = m > 1 ? 0.5 / (m - 1) : 0.0;
            /* of the disc as it is held: 0 and 1 are motions, wave 1 has ka/4 as well */
            const double own[4] = {m == 0   ? 0.5 * (ka - 1.0)
                                   : m == 1 ? 0.25 * ka - 1.0
                                            : out + in,
                                   m == 0   ? 0.0
                                   : m == 1 ? 0.25 * ka
                                            : out - in,
                                   m == 0   ? 0.0
                                   : m == 1 ? 0.25 * ka
                                            : out - in,
                                   m == 0   ? 0.0
                                   : m == 1 ? 0.25 * ka + 1.0
                                            : out + in};
            if (m * log(w->radius / w->inner) < 18.0 && m <= EXACT * 3)
                wheel_answers(w, m, 1.0, C[m]);
            else
                for (int i = 0; i < 4; i++)
                    C[m][i] = G * own[i];
            for (int i = 0; i < 4; i++)
                C[m][i] -= G * own[i];
        }
        for (int i = 0; i < 4 * M * N; i++)
            largest = fmax(largest, fabs(F[i]));
        for (int j = 0; j < N; j += 5)
            for (int i = 0; i < M; i++) {
                const double x = 2.0 * HALF_ARC * (i - j);
                double sum[4] = {0.0};
                for (int m = 0; m <= LAST; m++) {
                    const double load = (m ? 2.0 * sin(m * HALF_ARC) / m : HALF_ARC) / M_PI;
                    sum[0] += load * creal(C[m][0]) * cos(m * x);
                    sum[1] -= load * creal(C[m][1]) * sin(m * x);
                    sum[2] += load * creal(C[m][2]) * sin(m * x);
                    sum[3] += load * creal(C[m][3]) * cos(m * x);
                }
                for (int b = 0; b < 4; b++) {
                    const int at = i + b % 2 * M + (j + b / 2 * N) * 2 * M;
                    CHECK_ABS(F[at] - D[at], sum[b], 1e-11 * largest,
                              "wheel %d, block %d, %d under %d", k, b, i, j);
                }
            }
    }
}

/* A load over three arcs is that over each of them; in frames of the obstacle the same is
 * turned. */
TEST(uneven_arcs_and_frames)
{
    enum { FEW = N / 2, m = FEW + 1 };
    for (int k = 0; k < WHEELS; k++) {
        double ends[N + 2], few[FEW + 2], largest = 0.0;
        int middle[m];
        arcs(wheels[k].radius, ends);
        SCRATCH double *F = wheel_matrix(wheels + k, RB_BEM_NORMALS_SURFACE, N, ends);
        for (int i = 0, at = 0; i <= m; i++) { /* of 1 and 3 arcs in turns */
            few[i] = ends[at];
            if (i < m)
                middle[i] = at + i % 2;
            at += 1 + 2 * (i % 2);
        }
        SCRATCH double *A = wheel_matrix(wheels + k, RB_BEM_NORMALS_SURFACE, FEW, few),
                       *B = wheel_matrix(wheels + k, RB_BEM_NORMALS_OBSTACLE, FEW, few);
        for (int i = 0; i < 4 * M * N; i++)
            largest = fmax(largest, fabs(F[i]));
        for (int j = 0; j < FEW; j++)
            for (int i = 0; i < m; i++) {
                const double to = HALF_ARC * (2 * middle[i] + 1 - N),
                             from = HALF_ARC * (2 * middle[j] + 1 - N);
                double own[2][2], turned[2][2];
                for (int a = 0; a < 2; a++)
                    for (int b = 0; b < 2; b++) {
                        double sum = 0.0;
                        for (int l = -(j % 2); l <= j % 2; l++)
                            sum += F[middle[i] + a * M + (middle[j] + l + b * N) * 2 * M];
                        own[a][b] = A[i + a * m + (j + b * FEW) * 2 * m];
                        turned[a][b] = B[i + a * m + (j + b * FEW) * 2 * m];
                        CHECK_ABS(own[a][b], sum, 1e-12 * largest, "wheel %d, %d %d", k, i, j);
                    }
                /* normal (-sin, cos), tangent (cos, sin) of the surface */
                const double t[2] = {cos(to), sin(to)}, f[2] = {cos(from), sin(from)};
                const double R[2][2] = {{t[0], t[1]}, {-t[1], t[0]}},
                             S[2][2] = {{f[0], -f[1]}, {f[1], f[0]}};
                for (int a = 0; a < 2; a++)
                    for (int b = 0; b < 2; b++) {
                        double want = 0.0;
                        for (int c = 0; c < 2; c++)
                            for (int d = 0; d < 2; d++)
                                want += R[a][c] * own[c][d] * S[d][b];
                        CHECK_ABS(turned[a][b], want, 1e-12 * largest, "wheel %d turned", k);
                    }
            }
    }
}

/* Largest difference over the largest entry. */
static double apart(int n, const double *A, const double *B)
{
    double largest = 0.0, worst = 0.0;
    for (int k = 0; k < 4 * (n + 1) * n; k++) {
        largest = fmax(largest, fabs(B[k]));
        worst = fmax(worst, fabs(A[k] - B[k]));
    }
    return worst / largest;
}

/* Of a cover or a ring, n elements in contact and the others as much finer. */
static double boundary_error(int kind, rb_bem_normals normals, int n)
{
    const rb_bem_material rubber = {3.0, 0.4}, steel = {30.0, 0.3};
    const rb_bem_cylinder cylinder = {.radius = 100.0,
                                      .support = RB_BEM_HUB,
                                      .hub_ratio = 0.3,
                                      .cover = kind ? 5.0 : 0.0,
                                      .refinement = n / 10.0};
    const rb_bem_wheel wheel = {.radius = 100.0,
                                .inner = kind ? 95.0 : 30.0,
                                .material = rubber,
                                .hub = kind == 2 ? 30.0 : 0.0,
                                .core = steel};
    double ends[80];
    OWNED(rb_bem_mesh) mesh = {0}, core = {0};
    held_system *system = NULL;
    OWNED(rb_bem_flexibility) f;
    for (int i = 0; i < n + 2; i++)
        ends[i] = 4.0 * (2.0 * i / n - 1.0);
    CHECK_OK(rb_bem_mesh_cylinder(&cylinder, n, ends, &mesh, &message));
    if (kind == 2) {
        CHECK_OK(rb_bem_mesh_core(&cylinder, &mesh, &core, &message));
        CHECK_OK(rb_bem_system_create_bonded(&mesh, rubber, &core, steel, &system, &message));
    } else {
        CHECK_OK(rb_bem_system_create(&mesh, rubber, &system, &message));
    }
    CHECK_OK(rb_bem_condense_subtracted(system, normals, &f, &message));
    SCRATCH double *A = matrix_of(&f), *B = wheel_matrix(&wheel, normals, n, ends);
    return apart(n, A, B);
}

TEST(boundary_elements_come_to_it)
{
    for (int kind = 0; kind < 3; kind++)
        for (int normals = 0; normals < 2; normals++) {
            const double coarse = boundary_error(kind, (rb_bem_normals)normals, 20),
                         fine = boundary_error(kind, (rb_bem_normals)normals, 40);
            CHECK_MAX(coarse, kind ? 4e-3 : 6e-3, "kind %d, normals %d", kind, normals);
            CHECK_MAX(fine, 0.6 * coarse, "kind %d, normals %d", kind, normals);
        }
}

/* The thinner the cover, the less its roundness matters. */
TEST(a_thin_cover_is_a_layer)
{
    for (int elastic = 0; elastic < 2; elastic++) {
        const rb_bem_material rubber = {3.0, 0.45}, steel = {30.0, 0.3};
        for (double d = 1e-2; d > 1e-6; d *= 1e-2) {
            const rb_bem_wheel wheel = {.radius = 1.0,
                                        .inner = 1.0 - d,
                                        .material = rubber,
                                        .hub = elastic ? 0.5 : 0.0,
                                        .core = steel};
            const rb_bem_surface layer = {.material = rubber,
                                          .datum = 1.0,
                                          .thickness = d,
                                          .elastic_base = elastic,
                                          .base = steel};
            double ends[N + 2];
            OWNED(rb_bem_flexibility) f;
            for (int i = 0; i < N + 2; i++)
                ends[i] = 4.0 * d * (2.0 * i / N - 1.0);
            CHECK_OK(rb_bem_flexibility_surface(N, ends, &layer, &f, NULL));
            SCRATCH double *A = matrix_of(&f),
                           *B = wheel_matrix(&wheel, RB_BEM_NORMALS_SURFACE, N, ends);
            /* the datum of the base is at will: a motion per force */
            for (int block = 0; block < 2 && elastic; block++) {
                const int at = block * M + block * N * 2 * M;
                const double off = A[at] - B[at];
                for (int j = 0; j < N; j++)
                    for (int i = 0; i < M; i++)
                        A[at + i + j * 2 * M] -= off;
            }
            CHECK_MAX(apart(N, A, B), 10.0 * d, "d %g, elastic %d", d, elastic);
        }
    }
}

TEST(displacement_anywhere)
{
    for (int k = 0; k < WHEELS; k++) {
        double ends[N + 2], x[M], p[N], q[N], w[M], largest = 0.0;
        const rb_bem_edge_load load = {N, ends, p, q};
        arcs(wheels[k].radius, ends);
        for (int j = 0; j < N; j++) {
            p[j] = 1.0 + 0.1 * j;
            q[j] = 0.5 - 0.2 * (j % 3);
        }
        for (int i = 0; i < M; i++)
            x[i] = wheels[k].radius * sin(HALF_ARC * (2 * i + 1 - N));
        SCRATCH double *F = wheel_matrix(wheels + k, RB_BEM_NORMALS_OBSTACLE, N, ends);
        CHECK_OK(rb_bem_wheel_normal(wheels + k, &load, M, x, w));
        for (int i = 0; i < M; i++)
            largest = fmax(largest, fabs(w[i]));
        for (int i = 0; i < M; i++) {
            double want = 0.0;
            for (int j = 0; j < N; j++)
                want += F[i + j * 2 * M] * p[j] + F[i + (j + N) * 2 * M] * q[j];
            CHECK_ABS(w[i], want, 1e-11 * largest, "wheel %d at %d", k, i);
        }
        x[0] = wheels[k].radius;
        CHECK_STATUS(rb_bem_wheel_normal(wheels + k, &load, M, x, w), RB_EINVAL);
        CHECK_STATUS(rb_bem_wheel_normal(wheels + k, &load, 0, x, w), RB_EINVAL);
    }
}

/* Of one half-plane or of two in contact, without products. */
static double *surface_matrix(int n, const double *ends, const rb_bem_surface *above,
                              const rb_bem_surface *below)
{
    rb_bem_flexibility a, b, f;
    CHECK_OK(rb_bem_flexibility_surface(n, ends, above, &f, NULL));
    if (below) {
        a = f;
        CHECK_OK(rb_bem_flexibility_surface(n, ends, below, &b, NULL));
        CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
    }
    double *F = matrix_of(&f);
    rb_bem_flexibility_free(&f);
    return F;
}

/* On equal, fitted and rough elements and on equal arcs, under tractions that jump. */
TEST(products_are_the_matrix)
{
    enum { n = 300, m = n + 1 };
    static double ends[n + 2], r[2 * n], w[2 * m], want[2 * m];
    srand(3);
    for (int k = 0; k < 8 * WHEELS; k++) {
        const rb_bem_wheel *wheel = wheels + k % WHEELS;
        const int kind = k / WHEELS % 4;
        const rb_bem_normals normals = (rb_bem_normals)(k / WHEELS / 4);
        for (int i = 0; i < n + 2; i++) {
            const double t = 2.0 * i / (n + 1) - 1.0;
            ends[i] = 1.5 * (kind == 0   ? t
                             : kind == 1 ? sin(0.49 * M_PI * t)
                             : kind == 2 ? wheel->radius / 1.5 * sin(asin(1.5 / wheel->radius) * t)
                                         : t + 0.3 * (rand() % 100) / 100.0 / n);
        }
        for (int i = 0; i < 2 * n; i++)
            r[i] = (rand() % 1000) / 1000.0 - 0.3;
        rb_bem_flexibility f;
        double largest = 0.0;
        SCRATCH double *F = wheel_matrix(wheel, normals, n, ends);
        CHECK_OK(rb_bem_flexibility_wheel_products(n, ends, wheel, normals, &f, NULL));
        rb_bem_flexibility_apply(&f, r, w);
        for (int i = 0; i < m; i++) /* chords, equal arcs as well */
            CHECK_REL(
                f.h[i],
                2.0 * wheel->radius *
                    sin(0.5 * (asin(ends[i + 1] / wheel->radius) - asin(ends[i] / wheel->radius))),
                1e-12, "wheel %d, elements %d, length of element %d", k % WHEELS, kind, i);
        memset(want, 0, sizeof want);
        for (int j = 0; j < 2 * n; j++)
            for (int i = 0; i < 2 * m; i++)
                want[i] += F[i + j * 2 * m] * r[j];
        for (int i = 0; i < 2 * m; i++)
            largest = fmax(largest, fabs(want[i]));
        for (int i = 0; i < 2 * m; i++)
            CHECK_ABS(w[i], want[i], 1e-11 * largest, "wheel %d, elements %d, row %d", k % WHEELS,
                      kind, i);
        double *G = matrix_of(&f);
        CHECK_ABS(apart(n, G, F), 0.0, kind == 2 ? 1e-12 : 1e-15, "matrix"); /* 2: differences */
        free(G);
        rb_bem_flexibility_free(&f);
    }
}

/* Half-planes, one whose friction has another datum, layers on rigid and elastic bases, and what
 * remembers. */
enum { FLAT_BODIES = 7 };
static void flat_bodies(rb_bem_surface body[FLAT_BODIES])
{
    static const double ratio[] = {2.0, 0.5}, length[] = {0.4, 3.0};
    const rb_bem_material soft = rb_bem_material_from_young(10.0, 0.48),
                          stiff = rb_bem_material_from_young(70.0, 0.3);
    for (int k = 0; k < FLAT_BODIES; k++)
        body[k] = rb_bem_halfplane(k % 2 ? stiff : soft, 1.0 + k);
    body[1].datum_tangential = 7.0;
    for (int k = 2; k < 5; k++)
        body[k].thickness = k == 3 ? 0.05 : 0.8;
    body[3].elastic_base = body[4].elastic_base = 1;
    body[3].base = body[4].base = stiff;
    for (int k = 4; k < FLAT_BODIES; k++) {
        body[k].terms = k == 5 ? 1 : 2;
        body[k].ratio = ratio;
        body[k].length = length;
    }
    body[6].datum_memory = 0.3;
}

/* The waves of a thin layer are shorter than the elements of a line of 3. */
static int is_thin(const rb_bem_surface *body, int n)
{
    return body->thickness > 0.0 && body->thickness < 8.0 * 3.0 / (n + 1);
}

/* One body, or two in contact, which are one product where their steps are the same. */
static void check_flat_products(int n, const double *ends, const rb_bem_surface *above,
                                const rb_bem_surface *below, const char *what)
{
    const int m = n + 1;
    rb_bem_flexibility f;
    SCRATCH double *r = rb_alloc(2 * (size_t)n, 1), *w = rb_alloc(4 * (size_t)m, 1);
    double *want = w + 2 * m, largest = 0.0;

    for (int i = 0; i < 2 * n; i++)
        r[i] = (rand() % 1000) / 1000.0 - 0.3;
    CHECK_OK(rb_bem_flexibility_surface_products(n, ends, above, &f, NULL));
    if (below) {
        rb_bem_flexibility a = f, b;
        const void *one = f.data;
        CHECK_OK(rb_bem_flexibility_surface_products(n, ends, below, &b, NULL));
        CHECK_OK(rb_bem_flexibility_pair(&a, &b, &f, NULL));
        assert_int_equal(f.data == one, is_thin(above, n) == is_thin(below, n));
    }
    SCRATCH double *G = surface_matrix(n, ends, above, below), *H = matrix_of(&f);
    CHECK_ABS(apart(n, H, G), 0.0, 1e-15, "%s: matrix", what);
    rb_bem_flexibility_apply(&f, r, w);
    for (int i = 0; i < 2 * m; i++) {
        want[i] = 0.0;
        for (int j = 0; j < 2 * n; j++)
            want[i] += G[i + j * 2 * m] * r[j];
        largest = fmax(largest, fabs(want[i]));
    }
    for (int i = 0; i < 2 * m; i++)
        CHECK_ABS(w[i], want[i], 1e-11 * largest, "%s: row %d", what, i);
    rb_bem_flexibility_free(&f);
}

TEST(products_of_flat_bodies_are_the_matrix)
{
    enum { n = 100 };
    static double ends[n + 2];
    rb_bem_surface body[FLAT_BODIES];
    char what[60];

    srand(4);
    flat_bodies(body);
    for (int kind = 0; kind < 3; kind++) {
        if (!is_in_turn(kind, 3))
            continue;
        for (int i = 0; i < n + 2; i++) {
            const double t = 2.0 * i / (n + 1) - 1.0;
            ends[i] = 1.5 * (kind == 0   ? t
                             : kind == 1 ? sin(0.49 * M_PI * t)
                                         : t + 0.3 * (rand() % 100) / 100.0 / n);
        }
        for (int a = 0; a < FLAT_BODIES; a++)
            for (int b = -1; b < FLAT_BODIES; b++) {
                snprintf(what, sizeof what, "elements %d, bodies %d and %d", kind, a, b);
                check_flat_products(n, ends, body + a, b < 0 ? NULL : body + b, what);
            }
    }
}

TEST(bad_wheels_are_refused)
{
    rb_bem_wheel wheel = wheels[3];
    double ends[4] = {-0.1, 0.0, 0.1, 0.2};
    rb_bem_flexibility f;
    wheel.core.shear = 1e-90;
    CHECK_SAYS(rb_bem_flexibility_wheel(2, ends, &wheel, RB_BEM_NORMALS_SURFACE, &f, &message),
               RB_SINGULAR, "singular");
    wheel = wheels[3];
    wheel.hub = wheel.inner;
    CHECK_STATUS(rb_bem_flexibility_wheel(2, ends, &wheel, RB_BEM_NORMALS_SURFACE, &f, &message),
                 RB_EINVAL);
    ends[3] = wheel.radius;
    CHECK_SAYS(rb_bem_flexibility_wheel(2, ends, wheels, RB_BEM_NORMALS_SURFACE, &f, &message),
               RB_EINVAL, "is wider");
    CHECK_STATUS(rb_bem_flexibility_wheel(0, ends, wheels, RB_BEM_NORMALS_SURFACE, &f, &message),
                 RB_EINVAL);
}

RUN_TESTS(NULL, NULL)
