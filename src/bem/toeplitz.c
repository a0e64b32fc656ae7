/* The half-plane on equal elements (B6): the response depends on the distance between two
 * elements alone, so that its flexibility is Toeplitz and a product takes Fourier
 * transforms, n log n work and memory of a few n. */
#include "bem/toeplitz.h"
#include "bem/fourier.h"
#include "bem/internal.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* w_N = t * r_N + s * r_T, w_T = t * r_T - s * r_N, with t even, s odd in the distance.
 * Transforms of length >= 2n + 1 let nothing wrap around.  The transform of t less
 * its mean `base` is real, that of s imaginary; `base` times the sum of the tractions is
 * added apart: with a deep datum it would drown the rest in rounding.
 * work: room for one product, so that an operator serves one thread at a time. */
typedef struct {
    int n, coupled;
    double base;
    double *t, *s;         /* n + 1 each: distances 0 ... n elements; s(-k) = -s(k) */
    double *t_hat, *s_hat; /* size/2 + 1: real and imaginary part of the transforms */
    double *work[2];
    rb_fourier fourier;
} toeplitz;

static void toeplitz_free(void *data)
{
    toeplitz *o = data;
    if (!o)
        return;
    rb_fourier_free(&o->fourier);
    fftw_free(o->work[0]);
    fftw_free(o->work[1]);
    free(o->t);
    free(o->s);
    free(o->t_hat);
    free(o->s_hat);
    free(o);
}

static toeplitz *toeplitz_alloc(int n)
{
    toeplitz *o = calloc(1, sizeof *o);
    if (!o)
        return NULL;
    o->n = n;
    if (rb_fourier_make(2 * n + 1, &o->fourier)) {
        const size_t half = (size_t)o->fourier.size / 2 + 1;
        o->t = rb_alloc((size_t)n + 1, 1);
        o->s = rb_alloc((size_t)n + 1, 1);
        o->t_hat = rb_alloc(half, 1);
        o->s_hat = rb_alloc(half, 1);
        for (int k = 0; k < 2; k++)
            o->work[k] = rb_fourier_alloc(&o->fourier);
    }
    if (o->t && o->s && o->t_hat && o->s_hat && o->work[0] && o->work[1])
        return o;
    toeplitz_free(o);
    return NULL;
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
static void apply_alone(const toeplitz *o, const double *r, double *w)
{
    if (all_zero(o->n, r)) {
        memset(w, 0, ((size_t)o->n + 1) * sizeof *w);
        return;
    }
    fftw_complex *z = rb_fourier_forward(&o->fourier, o->n, r, o->work[0]);
    for (int k = 0; k <= o->fourier.size / 2; k++) {
        z[k][0] *= o->t_hat[k];
        z[k][1] *= o->t_hat[k];
    }
    transform_back(o, o->base * sum_of(o->n, r), o->work[0], w);
}

/* Both at once: i s_hat is the transform of s. */
static void apply_coupled(const toeplitz *o, const double *r, double *w)
{
    const rb_fourier *f = &o->fourier;
    fftw_complex *N = rb_fourier_forward(f, o->n, r, o->work[0]);
    fftw_complex *T = rb_fourier_forward(f, o->n, r + o->n, o->work[1]);

    for (int k = 0; k <= f->size / 2; k++) {
        const double t = o->t_hat[k], s = o->s_hat[k];
        const double n0 = N[k][0], n1 = N[k][1], t0 = T[k][0], t1 = T[k][1];
        N[k][0] = t * n0 - s * t1;
        N[k][1] = t * n1 + s * t0;
        T[k][0] = t * t0 + s * n1;
        T[k][1] = t * t1 - s * n0;
    }
    transform_back(o, o->base * sum_of(o->n, r), o->work[0], w);
    transform_back(o, o->base * sum_of(o->n, r + o->n), o->work[1], w + o->n + 1);
}

static void toeplitz_apply(const rb_bem_flexibility *f, const double *r, double *w)
{
    const toeplitz *o = f->data;

    if (o->coupled) {
        apply_coupled(o, r, w);
        return;
    }
    apply_alone(o, r, w);
    apply_alone(o, r + f->n, w + f->m);
}

static rb_status toeplitz_matrix(const rb_bem_flexibility *f, double *F, int ldf)
{
    const toeplitz *o = f->data;
    const size_t n = (size_t)f->n, m = (size_t)f->m, ld = (size_t)ldf;

    for (size_t j = 0; j < n; j++) {
        double *N = F + j * ld, *T = F + (j + n) * ld;
        for (size_t i = 0; i < m; i++) {
            const size_t k = i > j ? i - j : j - i;
            const double s = i > j ? o->s[k] : -o->s[k];
            N[i] = T[m + i] = o->t[k];
            T[i] = s;
            N[m + i] = -s;
        }
    }
    return RB_OK;
}

/* ---- Construction ------------------------------------------------------------------ */

/* Transforms of t and s, with FFTW's factor `size` of a transform and its inverse. */
static void set_transforms(toeplitz *o)
{
    const rb_fourier *f = &o->fourier;
    const int n = o->n, size = f->size;
    double *even = o->work[0], *odd = o->work[1];

    o->base = sum_of(n + 1, o->t) / (n + 1);
    memset(even, 0, (size_t)size * sizeof *even);
    memset(odd, 0, (size_t)size * sizeof *odd);
    even[0] = o->t[0] - o->base;
    for (int k = 1; k <= n; k++) {
        even[k] = even[size - k] = o->t[k] - o->base;
        odd[k] = o->s[k];
        odd[size - k] = -o->s[k];
    }
    fftw_complex *even_hat = rb_fourier_forward(f, size, even, even);
    fftw_complex *odd_hat = rb_fourier_forward(f, size, odd, odd);
    for (int k = 0; k <= size / 2; k++) {
        o->t_hat[k] = even_hat[k][0] / size;
        o->s_hat[k] = odd_hat[k][1] / size;
    }
    o->coupled = !all_zero(n + 1, o->s);
}

/* One strip seen from distances 0 ... n elements. */
static rb_status set_response(toeplitz *o, double h, rb_bem_material material,
                              double datum)
{
    const double strip[2] = {-0.5 * h, 0.5 * h};
    const int m = o->n + 1;
    double *x = rb_alloc((size_t)m, 1), *W = rb_alloc(2 * (size_t)m, 2);
    rb_status s = x && W ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        for (int i = 0; i < m; i++)
            x[i] = i * h;
        s = rb_bem_halfplane_displacement(1, strip, material, datum, m, x, W);
    }
    if (s == RB_OK) {
        memcpy(o->t, W, (size_t)m * sizeof *W);
        memcpy(o->s, W + 2 * m, (size_t)m * sizeof *W);
        set_transforms(o);
    }
    free(x);
    free(W);
    return s;
}

int rb_bem_ends_equal(int n_c, const double *ends)
{
    const double h = (ends[n_c + 1] - ends[0]) / (n_c + 1);
    const double rounding = 8.0 * DBL_EPSILON * fmax(fabs(ends[0]), fabs(ends[n_c + 1]));

    for (int i = 0; i <= n_c; i++)
        if (!(fabs(ends[i + 1] - ends[i] - h) <= 1e-9 * h + rounding))
            return 0;
    return 1;
}

static rb_status check(int n_c, const double *ends, rb_bem_material material,
                       double datum, rb_message *why)
{
    rb_status s = rb_bem_material_check(material, why);

    if (s == RB_OK)
        s = rb_bem_ends_check(n_c, ends, why);
    if (s == RB_OK && !rb_bem_ends_equal(n_c, ends))
        s = rb_fail(why, RB_EINVAL,
                    "half-plane by Fourier transforms: %d elements of "
                    "different lengths, expected equal ones",
                    n_c + 1);
    if (s == RB_OK && n_c > 1 << 28)
        s = rb_fail(why, RB_EINVAL, "contact elements: %d, expected at most %d", n_c,
                    1 << 28);
    if (s == RB_OK && !(datum > 0.0 && isfinite(datum)))
        s = rb_fail(why, RB_EINVAL, "datum = %g: expected a depth > 0", datum);
    return s;
}

rb_status rb_bem_flexibility_toeplitz(int n_c, const double *ends,
                                      rb_bem_material material, double datum,
                                      rb_bem_flexibility *f, rb_message *why)
{
    *f = (rb_bem_flexibility){0};
    rb_status s = check(n_c, ends, material, datum, why);
    if (s != RB_OK)
        return s;
    s = rb_bem_flexibility_points(n_c, f);
    toeplitz *o = s == RB_OK ? toeplitz_alloc(n_c) : NULL;
    if (o) {
        f->data = o;
        f->apply = toeplitz_apply;
        f->matrix = toeplitz_matrix;
        f->free_data = toeplitz_free;
        for (int i = 0; i < f->m; i++) {
            f->x[i] = 0.5 * (ends[i] + ends[i + 1]);
            f->h[i] = ends[i + 1] - ends[i];
        }
        s = set_response(o, (ends[n_c + 1] - ends[0]) / (n_c + 1), material, datum);
    }
    if (!o || s != RB_OK) {
        rb_bem_flexibility_free(f);
        return rb_fail(why, RB_ENOMEM, "half-plane: no memory for %d contact elements",
                       n_c);
    }
    return RB_OK;
}

int rb_bem_toeplitz_add(rb_bem_flexibility *a, const rb_bem_flexibility *b)
{
    if (a->apply != toeplitz_apply || b->apply != toeplitz_apply || a->n != b->n)
        return 0;
    toeplitz *o = a->data;
    const toeplitz *other = b->data;
    for (int k = 0; k <= o->n; k++) {
        o->t[k] += other->t[k];
        o->s[k] -= other->s[k];
    }
    set_transforms(o);
    return 1;
}
