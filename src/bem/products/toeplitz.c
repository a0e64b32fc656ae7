/* Flexibilities that depend on the distance between two elements alone: the half-plane
 * (B6) on equal elements, the disc on equal arcs.  Their matrices are Toeplitz matrices,
 * and a product by Fourier transforms takes n log n operations and memory for a few n
 * numbers. */
#include "bem/products/fourier.h"
#include "bem/internal.h"
#include "bem/surface.h"
#include "bem/wheel.h"

#include <float.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N, T };

/* w_N = t_N * r_N + s * r_T, w_T = t_T * r_T - s * r_N.  Elastic bodies have t even and s
 * odd in the distance, so that the transform of t is real and that of s imaginary; bodies
 * with memory have neither.  Those whose surface is alike everywhere have one t for both.
 * Transforms of length >= 2n + 1 let nothing wrap around.  `base`, the mean of t, times
 * the sum of the tractions is added apart: with a deep datum it would drown the rest in
 * rounding.  work: room for one product, so that an operator serves one thread at a time. */
typedef struct {
    int n, coupled, alike; /* alike: t_T is t_N */
    int symmetric;         /* t even and s odd */
    int flat;              /* 0: the elements lie on a disc */
    double base[2];
    double *t[2], *s; /* 2n + 1: of distances -n ... n elements */
    /* Transforms, t less its base: size/2 + 1 numbers, complex ones, or where `symmetric`
     * the real parts of t and the imaginary ones of s. */
    double *t_hat[2], *s_hat;
    double *work[2];
    rb_fourier fourier;
    double *cosine, *sine; /* m: of the angle to the obstacle's frame; NULL: none */
    double *turned;        /* 2n: tractions in the surface's frame */
    rb_arena memory;       /* of all arrays but work */
} toeplitz;

static void toeplitz_free(void *data)
{
    toeplitz *o = data;
    if (!o)
        return;
    rb_fourier_free(&o->fourier);
    for (int k = 0; k < 2; k++)
        fftw_free(o->work[k]);
    rb_arena_free(&o->memory);
    free(o);
}

/* ---- Products ---------------------------------------------------------------------- */

static int all_zero(int n, const double *x)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0.0)
            return 0;
    return 1;
}

/* Of many tractions, each of which moves every point: in more digits than double. */
static double sum_of(int n, const double *x)
{
    long double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += x[i];
    return (double)sum;
}

static void transform_back(const toeplitz *o, double constant, double *work, double *w)
{
    rb_fourier_backward(&o->fourier, work);
    for (int i = 0; i <= o->n; i++)
        w[i] = work[i] + constant;
}

/* One traction, no coupling: the product with t. */
static void apply_alone(const toeplitz *o, int k, const double *r, double *w)
{
    if (all_zero(o->n, r)) {
        memset(w, 0, ((size_t)o->n + 1) * sizeof *w);
        return;
    }
    fftw_complex *z = rb_fourier_forward(&o->fourier, o->n, r, o->work[0]);
    if (o->symmetric)
        rb_fourier_times_real(&o->fourier, o->t_hat[k], z);
    else
        rb_fourier_times(&o->fourier, o->t_hat[k], z);
    transform_back(o, o->base[k] * sum_of(o->n, r), o->work[0], w);
}

/* Both at once. */
static void apply_coupled(const toeplitz *o, const double *r, double *w)
{
    const rb_fourier *f = &o->fourier;
    fftw_complex *p = rb_fourier_forward(f, o->n, r, o->work[N]);
    fftw_complex *q = rb_fourier_forward(f, o->n, r + o->n, o->work[T]);

    if (!o->symmetric)
        rb_fourier_times_coupled(f, o->t_hat[N], o->t_hat[T], o->s_hat, p, q);
    for (int k = 0; o->symmetric && k <= f->size / 2; k++) {
        /* Mode k of both, p and q, for real transforms of t and imaginary ones of s. */
        const double t_N = o->t_hat[N][k], t_T = o->t_hat[T][k], s = o->s_hat[k];
        const double p0 = p[k][0], p1 = p[k][1], q0 = q[k][0], q1 = q[k][1];

        p[k][0] = t_N * p0 - s * q1;
        p[k][1] = t_N * p1 + s * q0;
        q[k][0] = t_T * q0 + s * p1;
        q[k][1] = t_T * q1 - s * p0;
    }
    transform_back(o, o->base[N] * sum_of(o->n, r), o->work[N], w);
    transform_back(o, o->base[T] * sum_of(o->n, r + o->n), o->work[T], w + o->n + 1);
}

static void toeplitz_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    const toeplitz *o = f->data;

    if (o->cosine) {
        rb_wheel_turn(o->cosine, o->sine, 1, f->n, r, o->turned);
        r = o->turned;
    }
    if (o->coupled) {
        apply_coupled(o, r, w);
    } else {
        apply_alone(o, N, r, w);
        apply_alone(o, T, r + f->n, w + f->m);
    }
    if (o->cosine)
        rb_wheel_turn(o->cosine, o->sine, -1, f->m, w, w);
}

static rb_status toeplitz_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    const toeplitz *o = f->data;
    const size_t n = (size_t)f->n, m = (size_t)f->m, ld = (size_t)ldf;

    for (size_t j = 0; j < n; j++) {
        double *column_N = F + j * ld, *column_T = F + (j + n) * ld, e[4];
        for (size_t i = 0; i < m; i++) {
            /* Entries of point i and element j in the surface's frames: NN, TN, NT, TT. */
            const size_t k = (size_t)o->n + i - j;

            e[0] = o->t[N][k];
            e[2] = o->s[k];
            e[1] = -e[2];
            e[3] = o->t[T][k];
            if (o->cosine)
                rb_wheel_turn_block((rb_direction){o->cosine[i], o->sine[i]},
                                    (rb_direction){o->cosine[j], o->sine[j]}, e);
            column_N[i] = e[0];
            column_N[m + i] = e[1];
            column_T[i] = e[2];
            column_T[m + i] = e[3];
        }
    }
    return RB_OK;
}

/* ---- Construction ------------------------------------------------------------------ */

/* From the distances 0 ... n of a symmetric body to those of both signs. */
static void mirror(toeplitz *o)
{
    for (int k = 1; k <= o->n; k++) {
        o->t[N][o->n - k] = o->t[N][o->n + k];
        o->t[T][o->n - k] = o->t[T][o->n + k];
        o->s[o->n - k] = -o->s[o->n + k];
    }
}

/* The transform of a kernel less its base, with FFTW's factor `size` of a transform and
 * its inverse.  part: 0 of t, 1 of s, which is all there is of a symmetric body. */
static void transform(const toeplitz *o, const double *kernel, double base, int part, double *hat)
{
    const int n = o->n, size = o->fourier.size;
    double *line = o->work[0];

    memset(line, 0, (size_t)size * sizeof *line);
    for (int k = -n; k <= n; k++)
        line[k < 0 ? size + k : k] = kernel[n + k] - base;
    fftw_complex *z = rb_fourier_forward(&o->fourier, size, line, line);
    for (int j = 0; j <= size / 2; j++) {
        if (o->symmetric) {
            hat[j] = z[j][part] / size;
        } else {
            hat[2 * j] = z[j][0] / size;
            hat[2 * j + 1] = z[j][1] / size;
        }
    }
}

static void set_transforms(toeplitz *o)
{
    const int n = o->n;

    for (int k = N; k <= T; k++) {
        o->base[k] = sum_of(n + 1, o->t[k] + n) / (n + 1);
        if (k == N || !o->alike)
            transform(o, o->t[k], o->base[k], 0, o->t_hat[k]);
    }
    o->coupled = !all_zero(2 * n + 1, o->s);
    if (o->coupled)
        transform(o, o->s, 0.0, 1, o->s_hat);
}

static int toeplitz_add(rb_bem_flexibility *a, const rb_bem_flexibility *b)
{
    if (b->apply != toeplitz_apply)
        return 0;
    toeplitz *o = a->data;
    const toeplitz *other = b->data;
    if (!o->flat || !other->flat || (o->alike && !other->alike))
        return 0;
    for (int k = 0; k <= 2 * o->n; k++) {
        o->t[N][k] += other->t[N][k];
        if (!o->alike)
            o->t[T][k] += other->t[T][k];
        o->s[k] -= other->s[k];
    }
    o->symmetric = o->symmetric && other->symmetric;
    set_transforms(o);
    return 1;
}

/* An operator without kernels at the midpoints of the ends; NULL without memory. */
static toeplitz *start(int n_c, const double *ends, int alike, rb_bem_flexibility *f)
{
    toeplitz *o = rb_bem_flexibility_points(n_c, f) == RB_OK ? calloc(1, sizeof *o) : NULL;
    if (!o)
        return NULL;
    f->data = o;
    f->apply = toeplitz_apply;
    f->matrix = toeplitz_matrix;
    f->add_mirrored = toeplitz_add;
    f->free_data = toeplitz_free;
    rb_bem_flexibility_place(ends, f);
    o->n = n_c;
    o->alike = alike;
    if (!rb_fourier_make(2 * n_c + 1, &o->fourier))
        return NULL;
    const size_t distances = 2 * (size_t)n_c + 1, half = (size_t)o->fourier.size / 2 + 1;
    for (int k = 0; k < 2; k++) {
        o->t[k] = k && alike ? o->t[N] : rb_arena_doubles(&o->memory, distances, 1);
        o->t_hat[k] = k && alike ? o->t_hat[N] : rb_arena_doubles(&o->memory, half, 2);
        o->work[k] = rb_fourier_alloc(&o->fourier);
    }
    o->s = rb_arena_doubles(&o->memory, distances, 1);
    o->s_hat = rb_arena_doubles(&o->memory, half, 2);
    return !o->memory.failed && o->work[N] && o->work[T] ? o : NULL;
}

rb_status rb_bem_flexibility_toeplitz(int n_c, const double *ends, const rb_bem_surface *body,
                                      rb_bem_flexibility *f, rb_message *why)
{
    *f = (rb_bem_flexibility){0};
    if (n_c > 1 << 28)
        return rb_fail(why, RB_EINVAL, "contact elements: %d, expected at most %d", n_c, 1 << 28);
    rb_status s = rb_bem_surface_check(body, why);
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s != RB_OK)
        return s;
    const double h = (ends[n_c + 1] - ends[0]) / (n_c + 1), strip[2] = {-0.5 * h, 0.5 * h},
                 rounding = 8.0 * DBL_EPSILON * fmax(fabs(ends[0]), fabs(ends[n_c + 1]));
    for (int i = 0; i <= n_c; i++)
        if (!(fabs(ends[i + 1] - ends[i] - h) <= 1e-9 * h + rounding))
            return rb_fail(why, RB_EINVAL,
                           "half-plane by Fourier transforms: %d elements of "
                           "different lengths, expected equal ones",
                           n_c + 1);
    /* One strip seen from distances -n ... n elements, or 0 ... n where both sides are alike. */
    const int symmetric = body->terms == 0, first = symmetric ? 0 : -n_c;
    const size_t points = (size_t)(n_c - first) + 1;
    const int alike = body->thickness == 0.0 && !(body->datum_tangential > 0.0);
    toeplitz *o = start(n_c, ends, alike, f);
    double *x = rb_alloc(points, 1), *W = rb_alloc(2 * points, 2);

    s = o && x && W ? RB_OK : RB_ENOMEM;
    if (s == RB_OK) {
        for (int i = first; i <= n_c; i++)
            x[i - first] = i * h;
        s = rb_bem_surface_displacement(body, 1, strip, (int)points, x, W);
    }
    if (s == RB_OK) {
        o->flat = 1;
        o->symmetric = symmetric;
        memcpy(o->t[N] + n_c + first, W, points * sizeof *W);
        if (!o->alike)
            memcpy(o->t[T] + n_c + first, W + 3 * points, points * sizeof *W);
        memcpy(o->s + n_c + first, W + 2 * points, points * sizeof *W);
        if (symmetric)
            mirror(o);
        set_transforms(o);
    }
    free(x);
    free(W);
    return rb_bem_flexibility_end("half-plane", n_c, s, f, why);
}

/* ---- Disc and wheel ---------------------------------------------------------------- */

/* The first element that begins a part `tol` of an arc elsewhere than equal arcs do; 0:
 * none. */
static int other_arc(int n_c, const double *ends, double radius, double tol)
{
    const double first = asin(ends[0] / radius);
    const double h = (asin(ends[n_c + 1] / radius) - first) / (n_c + 1);

    for (int i = 1; i <= n_c; i++)
        if (!(fabs(asin(ends[i] / radius) - (first + i * h)) <= tol * h))
            return i;
    return 0;
}

/* From the response of disc.c, outwards and counter-clockwise, to n inwards.  The
 * translation -conj(P) exp(2 i alpha) of theory.md's letters is added to it:
 * displacements are then measured from where the load is held, and the flexibility is
 * symmetric. */
static rb_status disc_response(const void *body, int n, double h, double *N_, double *T_, double *C)
{
    const rb_bem_disc *disc = body;
    const double scale = disc->radius / (4.0 * M_PI * disc->material.shear);

    for (int k = 0; k <= n; k++) {
        double u[4];
        const rb_status s = rb_bem_disc_response(disc, h, k * h, u);
        if (s != RB_OK)
            return s;
        const double shift = scale * 2.0 * sin(0.5 * h) * cos(k * h);
        N_[k] = u[0] - shift;
        T_[k] = u[3] + shift;
        C[k] = 0.5 * (u[1] - u[2]);
    }
    return RB_OK;
}

rb_status rb_wheel_on_equal_arcs(int n_c, const double *ends, double radius,
                                 rb_wheel_responds *responds, const void *body,
                                 rb_bem_normals normals, rb_bem_flexibility *f)
{
    const double first = asin(ends[0] / radius);
    const double h = (asin(ends[n_c + 1] / radius) - first) / (n_c + 1);
    toeplitz *o = start(n_c, ends, 0, f);

    if (!o)
        return RB_ENOMEM;
    for (int i = 0; i < f->m; i++) /* arcs are longer than their projections */
        f->h[i] = radius * h;
    if (normals == RB_BEM_NORMALS_OBSTACLE) {
        /* Turns by the angle from the lowest point. */
        o->cosine = rb_arena_doubles(&o->memory, (size_t)f->m, 1);
        o->sine = rb_arena_doubles(&o->memory, (size_t)f->m, 1);
        o->turned = rb_arena_doubles(&o->memory, (size_t)f->m, 2);
        if (o->memory.failed)
            return RB_ENOMEM;
        for (int i = 0; i < f->m; i++) {
            o->cosine[i] = cos(first + (i + 0.5) * h);
            o->sine[i] = sin(first + (i + 0.5) * h);
        }
    }
    double *const t_N = o->t[N] + n_c, *const t_T = o->t[T] + n_c, *const s = o->s + n_c;
    const rb_status status = responds(body, n_c, h, t_N, t_T, s);
    if (status == RB_OK) {
        o->symmetric = 1;
        s[0] = 0.0;
        mirror(o);
        set_transforms(o);
    }
    return status;
}

rb_status rb_bem_flexibility_disc(int n_c, const double *ends, const rb_bem_disc *disc,
                                  rb_bem_normals normals, rb_bem_flexibility *f, rb_message *why)
{
    const double radius = disc->radius;
    rb_status s = rb_bem_material_check(disc->material, why);

    *f = (rb_bem_flexibility){0};
    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s == RB_OK && !(isfinite(radius) && fabs(ends[0]) < radius && fabs(ends[n_c + 1]) < radius))
        s = rb_fail(why, RB_EINVAL, "disc of radius %g: contact from %g to %g is wider", radius,
                    ends[0], ends[n_c + 1]);
    if (s != RB_OK)
        return s;
    const int other = other_arc(n_c, ends, radius, 1e-6);
    if (other)
        return rb_fail(why, RB_EINVAL,
                       "disc: contact element %d has another length than the others", other);
    s = rb_wheel_on_equal_arcs(n_c, ends, radius, disc_response, disc, normals, f);
    return rb_bem_flexibility_end("disc", n_c, s, f, why);
}

/* To rounding, which is that of angles up to pi/2 beside an arc. */
int rb_wheel_has_equal_arcs(int n_c, const double *ends, double radius)
{
    const double h = (asin(ends[n_c + 1] / radius) - asin(ends[0] / radius)) / (n_c + 1);
    return other_arc(n_c, ends, radius, 1e-12 + 8.0 * DBL_EPSILON / h) == 0;
}
