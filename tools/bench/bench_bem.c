/* Speed of the boundary elements: every figure beside its rival, timed in the same
 * rounds. One thread, processor time, medians; the pipeline: all threads, wall time. */
#include "bem/column.h"
#include "bem/large.h"
#include "bem/system.h"
#include "base/blas.h"

#include <gsl/gsl_sort.h>
#include <cblas.h>
#include <gsl/gsl_math.h>
#include <lapacke.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

enum { n = 1600, rounds = 9 };

static const rb_bem_material material = {80.0, 0.3};

/* ---- One element's columns, by every way ------------------------------------------- */

typedef void fill_columns(const rb_bem_mesh *mesh, int j, const rb_points *points,
                          double *const out[4]);

static void closed_form(const rb_column_variant *variant, const rb_bem_mesh *mesh, int j,
                        const rb_points *points, double *const out[4])
{
    const rb_element e = rb_element_make(mesh->x0[j], mesh->y0[j], mesh->x1[j], mesh->y1[j], 1.0);
    const rb_constants k = rb_constants_make(&e, material);
    variant->fill(&k, &e, j, points, out);
}

static void best_variant(const rb_bem_mesh *mesh, int j, const rb_points *points,
                         double *const out[4])
{
    closed_form(rb_column_variant_get(0), mesh, j, points, out);
}

static const rb_column_variant *variant_named(const char *name)
{
    const rb_column_variant *v;
    for (int i = 0; (v = rb_column_variant_get(i)); i++)
        if (strcmp(v->name, name) == 0)
            return v;
    return rb_column_variant_get(0);
}

static void avx2_variant(const rb_bem_mesh *mesh, int j, const rb_points *points,
                         double *const out[4])
{
    closed_form(variant_named("AVX2"), mesh, j, points, out);
}

static void plain_variant(const rb_bem_mesh *mesh, int j, const rb_points *points,
                          double *const out[4])
{
    closed_form(variant_named("plain"), mesh, j, points, out);
}

/* The closed form as one would write it first: 2 logarithms, 2 arctangents of libm. */
static void scalar_closed_form(const rb_bem_mesh *mesh, int j, const rb_points *points,
                               double *const out[4])
{
    const double nu = material.poisson, C = 1 / (8 * M_PI * material.shear * (1 - nu)),
                 D = -1 / (4 * M_PI * (1 - nu)), kap = 3 - 4 * nu;
    const double dx = mesh->x1[j] - mesh->x0[j], dy = mesh->y1[j] - mesh->y0[j], h = hypot(dx, dy),
                 tx = dx / h, ty = dy / h, a = 0.5 * h;
    const double mx = 0.5 * (mesh->x0[j] + mesh->x1[j]), my = 0.5 * (mesh->y0[j] + mesh->y1[j]);
    const double cc = tx * tx - ty * ty, ss = 2 * tx * ty;
    for (int i = 0; i < points->n; i++) {
        const double rx = mx - points->x[i], ry = my - points->y[i];
        const double X = rx * tx + ry * ty, d = rx * ty - ry * tx, x1 = X - a, x2 = X + a;
        const double q1 = x1 * x1 + d * d, q2 = x2 * x2 + d * d, l1 = log(q1), l2 = log(q2);
        const double Th = i == j ? 0.0 : atan2(d, x1) - atan2(d, x2), Lam = 0.5 * (l2 - l1);
        const double L = 0.5 * (x2 * l2 - x1 * l1) - 2 * a + d * Th;
        const double dQ = d * (x2 / q2 - x1 / q1), dP = d * d * (1 / q2 - 1 / q1);
        const double m = 2 * (1 - nu) * Th, k = (1 - 2 * nu) * Lam;
        const double g = C * (a - kap * L), g1 = C * (a - d * Th), g2 = C * d * Lam;
        out[0][2 * i] = D * (m - cc * dQ - ss * dP) + 0.5 * (i == j);
        out[1][2 * i + 1] = D * (m + cc * dQ + ss * dP) + 0.5 * (i == j);
        out[0][2 * i + 1] = D * (cc * dP - ss * dQ - k);
        out[1][2 * i] = D * (cc * dP - ss * dQ + k);
        out[2][2 * i] = g + cc * g1 + ss * g2;
        out[3][2 * i + 1] = g - cc * g1 - ss * g2;
        out[2][2 * i + 1] = out[3][2 * i] = ss * g1 - cc * g2;
    }
}

/* Four Gauss points per element (useless near the element: rivals in speed only). */
typedef struct {
    double x[4], y[4], weight[4], nx, ny, C, D, kap, one_2nu;
} gauss_element;

static gauss_element gauss_element_make(const rb_bem_mesh *mesh, int j)
{
    const double at[2] = {0.86113631159405257, 0.33998104358485626},
                 weight[2] = {0.34785484513745386, 0.65214515486254614};
    const double nu = material.poisson, hx = 0.5 * (mesh->x1[j] - mesh->x0[j]),
                 hy = 0.5 * (mesh->y1[j] - mesh->y0[j]), a = hypot(hx, hy);
    gauss_element g = {.nx = hy / a,
                       .ny = -hx / a,
                       .C = 1 / (8 * M_PI * material.shear * (1 - nu)),
                       .D = -1 / (4 * M_PI * (1 - nu)),
                       .kap = 3 - 4 * nu,
                       .one_2nu = 1 - 2 * nu};
    for (int k = 0; k < 4; k++) {
        const double s = k % 2 ? at[k / 2] : -at[k / 2];
        g.x[k] = 0.5 * (mesh->x0[j] + mesh->x1[j]) + s * hx;
        g.y[k] = 0.5 * (mesh->y0[j] + mesh->y1[j]) + s * hy;
        g.weight[k] = a * weight[k / 2];
    }
    return g;
}

RB_INLINE void gauss_add(const gauss_element *g, int k, double px, double py, int own_logarithm,
                         rb_influence *to)
{
    const double rx = g->x[k] - px, ry = g->y[k] - py, rr = rx * rx + ry * ry;
    const double over = 1 / rr, wt = g->weight[k] * g->D, wu = g->weight[k] * g->C;
    const double rn = wt * (rx * g->nx + ry * g->ny) * over, xx = rx * rx * over,
                 xy = rx * ry * over, yy = ry * ry * over;
    const double lead = -0.5 * g->kap * (own_logarithm ? rb_log(rr) : log(rr));
    const double skew = wt * g->one_2nu * (rx * g->ny - ry * g->nx) * over;
    to->Hxx += rn * (g->one_2nu + 2 * xx);
    to->Hyy += rn * (g->one_2nu + 2 * yy);
    to->Hxy += 2 * rn * xy - skew;
    to->Hyx += 2 * rn * xy + skew;
    to->Gxx += wu * (lead + xx);
    to->Gyy += wu * (lead + yy);
    to->Gxy += wu * xy;
}

/* Past the caches, like ours. */
static void send(double *to, const double *from, int count)
{
    for (int i = 0; i < count; i += 2) {
#if defined(__x86_64__)
        _mm_stream_pd(to + i, _mm_loadu_pd(from + i));
#else
        to[i] = from[i];
        to[i + 1] = from[i + 1];
#endif
    }
}

/* The inner loop is the compiler's to vectorise. */
RB_INLINE void gauss(const rb_bem_mesh *mesh, int j, const rb_points *points, int own_logarithm,
                     double *const out[4])
{
    enum { block = 32 }; /* divides n */
    const gauss_element g = gauss_element_make(mesh, j);
    for (int first = 0; first < points->n; first += block) {
        double column[4][2 * block];
        const double *x = points->x + first, *y = points->y + first;
        for (int i = 0; i < block; i++) {
            rb_influence sum = {0};
            for (int k = 0; k < 4; k++)
                gauss_add(&g, k, x[i], y[i], own_logarithm, &sum);
            column[0][2 * i] = sum.Hxx;
            column[0][2 * i + 1] = sum.Hyx;
            column[1][2 * i] = sum.Hxy;
            column[1][2 * i + 1] = sum.Hyy;
            column[2][2 * i] = sum.Gxx;
            column[2][2 * i + 1] = column[3][2 * i] = sum.Gxy;
            column[3][2 * i + 1] = sum.Gyy;
        }
        for (int c = 0; c < 4; c++)
            send(out[c] + 2 * first, column[c], 2 * block);
    }
}

/* As one would write it first. */
static void gauss_libm(const rb_bem_mesh *mesh, int j, const rb_points *points,
                       double *const out[4])
{
    gauss(mesh, j, points, 0, out);
}

#if !defined(__x86_64__)
#define WIDEST
#elif defined(__clang__)
#define WIDEST __attribute__((target("avx512f,avx512dq,avx512vl")))
#else
#define WIDEST __attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512")))
#endif

WIDEST static void gauss_wide(const rb_bem_mesh *mesh, int j, const rb_points *points,
                              double *const out[4])
{
    gauss(mesh, j, points, 1, out);
}

static void gauss_4(const rb_bem_mesh *mesh, int j, const rb_points *points, double *const out[4])
{
    if (strcmp(rb_column_variant_get(0)->name, "AVX-512") == 0)
        gauss_wide(mesh, j, points, out);
    else
        gauss(mesh, j, points, 1, out);
}

/* Nothing but the stores, past the caches. */
static void stores_only(const rb_bem_mesh *mesh, int j, const rb_points *points,
                        double *const out[4])
{
    (void)mesh;
    for (int c = 0; c < 4 && out[c]; c++)
        for (int i = 0; i < 2 * points->n; i += 2) {
#if defined(__x86_64__)
            _mm_stream_pd(out[c] + i, _mm_set1_pd(j));
#else
            out[c][i] = out[c][i + 1] = j;
#endif
        }
}

/* ---- Timing ------------------------------------------------------------------------ */

static double processor_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double median(int count, double *x)
{
    gsl_sort(x, 1, (size_t)count);
    return x[count / 2];
}

static rb_bem_mesh circle(int elements)
{
    rb_bem_mesh mesh = {0};
    if (rb_bem_mesh_alloc(elements, &mesh) != RB_OK)
        exit(70);
    for (int j = 0; j < elements; j++) {
        const double a = 2 * M_PI * j / elements, b = 2 * M_PI * ((j + 1) % elements) / elements;
        mesh.x0[j] = cos(a);
        mesh.y0[j] = sin(a);
        mesh.x1[j] = cos(b);
        mesh.y1[j] = sin(b);
    }
    return mesh;
}

/* ns per pair of element and point, into A with room for both matrices */
static double once(fill_columns *fill, const rb_bem_mesh *mesh, const rb_points *points, double *A,
                   int with_G)
{
    const size_t ld = 2 * (size_t)mesh->n;
    const double start = processor_seconds();
    for (int j = 0; j < mesh->n; j++) {
        double *at = A + 4 * (size_t)j * ld;
        double *const out[4] = {at, at + ld, with_G ? at + 2 * ld : NULL,
                                with_G ? at + 3 * ld : NULL};
        fill(mesh, j, points, out);
    }
    return (processor_seconds() - start) * 1e9 / mesh->n / mesh->n;
}

typedef struct {
    const char *name;
    fill_columns *fill;
    int with_G;
    double ns[rounds], middle;
} way;

static void show(const char *what, double value, const char *unit, const char *goal)
{
    printf("%-58s %8.2f %s%s%s\n", what, value, unit, *goal ? "   goal " : "", goal);
}

static void assembly(void)
{
    way ways[] = {{"streaming stores alone, H", stores_only, 0, {0}, 0},
                  {"streaming stores alone, H and G", stores_only, 1, {0}, 0},
                  {"closed form, best, H", best_variant, 0, {0}, 0},
                  {"closed form, best, H and G", best_variant, 1, {0}, 0},
                  {"closed form, AVX2, H and G", avx2_variant, 1, {0}, 0},
                  {"closed form, plain, H and G", plain_variant, 1, {0}, 0},
                  {"closed form, scalar with libm, H and G", scalar_closed_form, 1, {0}, 0},
                  {"Gauss, 4 points, vectorised with our logarithm", gauss_4, 1, {0}, 0},
                  {"Gauss, 4 points, libm's logarithm", gauss_libm, 1, {0}, 0}};
    enum { count = sizeof ways / sizeof *ways };
    rb_bem_mesh mesh = circle(n);
    double *x = rb_alloc(n, 2), *y = x + n, *A = rb_large_alloc(2 * n, 4 * n);
    rb_points points = {0};
    if (!x || !A)
        exit(70);
    for (int j = 0; j < n; j++) {
        x[j] = 0.5 * (mesh.x0[j] + mesh.x1[j]);
        y[j] = 0.5 * (mesh.y0[j] + mesh.y1[j]);
    }
    if (rb_points_make(n, x, y, &points) != RB_OK)
        exit(70);
    once(stores_only, &mesh, &points, A, 1); /* touch the memory */
    for (int round = 0; round < rounds; round++)
        for (int w = 0; w < count; w++)
            ways[w].ns[round] = once(ways[w].fill, &mesh, &points, A, ways[w].with_G);
    printf("assembly, %d elements, one thread, %s, ns per pair\n", n, rb_bem_vector_name());
    for (int w = 0; w < count; w++) {
        ways[w].middle = median(rounds, ways[w].ns);
        show(ways[w].name, ways[w].middle, "ns", "");
    }
    show("H / its stores", ways[2].middle / ways[0].middle, "times", "<= 2");
    show("H and G / their stores", ways[3].middle / ways[1].middle, "times", "<= 1.6");
    show("scalar closed form / ours", ways[6].middle / ways[3].middle, "times", ">= 12");
    show("vectorised Gauss / ours", ways[7].middle / ways[3].middle, "times", ">= 8");
    show("Gauss with libm / ours", ways[8].middle / ways[3].middle, "times", "");
    rb_points_free(&points);
    rb_bem_mesh_free(&mesh);
    free(A);
    free(x);
}

/* ---- From mesh to flexibility ------------------------------------------------------ */

/* The LU alone of the same order, of a matrix that has been touched. */
static double lu_alone(int order)
{
    const size_t size = (size_t)order;
    double *A = rb_large_alloc(size, size);
    lapack_int *pivot = malloc(size * sizeof *pivot);
    unsigned state = 1;
    if (!A || !pivot)
        exit(70);
    for (size_t k = 0; k < size * size; k++) {
        state = state * 1664525u + 1013904223u;
        A[k] = state / 4294967296.0 - 0.5;
    }
    const int threads = rb_blas_threads(0);
    const double start = rb_seconds();
    LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, order, order, A, order, pivot);
    const double seconds = rb_seconds() - start;
    rb_blas_threads(threads);
    free(pivot);
    free(A);
    return seconds;
}

static rb_bem_mesh wheel(int elements, int n_c)
{
    const rb_bem_cylinder cylinder = {
        .radius = 1.0, .support = RB_BEM_ARC, .arc = 0.5, .outer_elements = elements - n_c - 1};
    double *ends = rb_alloc((size_t)n_c + 2, 1);
    rb_bem_mesh mesh;
    for (int i = 0; i < n_c + 2; i++)
        ends[i] = 0.02 * (2.0 * i / n_c - 1.0);
    if (rb_bem_mesh_cylinder(&cylinder, n_c, ends, &mesh, NULL) != RB_OK)
        exit(70);
    free(ends);
    return mesh;
}

static void pipeline(int elements, int repeat)
{
    double ratio[9], assemble[9], factor[9], condense[9], alone[9];
    rb_bem_mesh mesh = wheel(elements, elements / 40);
    for (int k = 0; k < repeat; k++) {
        rb_bem_system *system;
        rb_bem_flexibility f;
        alone[k] = lu_alone(2 * mesh.n);
        const double start = rb_seconds();
        if (rb_bem_system_create_as(&mesh, material, 1, &system, NULL) != RB_OK)
            exit(70);
        const double made = rb_seconds();
        if (rb_bem_condense(system, RB_BEM_NORMALS_OBSTACLE, &f, NULL) != RB_OK)
            exit(70);
        const double end = rb_seconds();
        rb_bem_system_seconds(system, &assemble[k], &factor[k]);
        condense[k] = end - made;
        ratio[k] = (end - start) / alone[k];
        rb_bem_flexibility_free(&f);
        rb_bem_system_free(system);
    }
    printf("mesh to flexibility, dense, n = %d, n_c = %d, all threads\n", mesh.n, mesh.contact_n);
    show("assembly", 1e3 * median(repeat, assemble), "ms", "");
    show("LU and condition", 1e3 * median(repeat, factor), "ms", "");
    show("condensation", 1e3 * median(repeat, condense), "ms", "");
    show("dgetrf alone", 1e3 * median(repeat, alone), "ms", "");
    show("all / dgetrf alone", median(repeat, ratio), "times", elements >= 4000 ? "<= 1.15" : "");
    rb_bem_mesh_free(&mesh);
}

int main(int argc, char **argv)
{
    (void)argc;
    const char *core = rb_blas_better_core();
    if (core && !getenv("OPENBLAS_CORETYPE") && setenv("OPENBLAS_CORETYPE", core, 1) == 0)
        execv("/proc/self/exe", argv); /* read only while OpenBLAS is loaded */
    assembly();
    printf("OpenBLAS kernels: %s\n", rb_blas_core());
    fflush(stdout);
    pipeline(500, 9);
    pipeline(2000, 5);
    pipeline(4000, 3);
    return 0;
}
