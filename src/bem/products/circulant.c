/* A preconditioner: the inverse of the flexibility of an infinite line of equal elements,
 * whose eigenvectors are Fourier modes, restricted to the given line. */
#include "bem/products/fourier.h"
#include "bem/bem.h"
#include "bem/internal.h"

#include <complex.h>
#include <gsl/gsl_math.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct rb_bem_circulant {
    int n;
    double *inverse;          /* size/2 + 1: 1/(transform of the kernel), over `size` */
    fftw_complex *difference; /* size/2 + 1: that over the symbol of A */
    double *tangential;       /* size/2 + 1: the transform of F_TT's kernel */
    double *yielding;         /* size/2 + 1, behind it: scratch */
    double *work;
    rb_fourier fourier;
};

void rb_bem_circulant_free(rb_bem_circulant *c)
{
    if (!c)
        return;
    rb_fourier_free(&c->fourier);
    fftw_free(c->work);
    free(c->inverse);
    free(c->difference);
    free(c->tangential);
    free(c);
}

/* Transform of t_j = -int ln|s| ds over [j - 1/2, j + 1/2]:
 * sum over m of pi/|w| sin(w/2)/(w/2), w = theta + 2 pi m; sin(w/2) is sin(theta/2) or
 * minus that. */
static double log_kernel(double theta)
{
    double sum = 0.0;
    for (int m = -4; m <= 4; m++) {
        const double w = theta + 2.0 * M_PI * m;
        sum += (m % 2 ? -1.0 : 1.0) / (fabs(w) * w);
    }
    return 2.0 * M_PI * sin(0.5 * theta) * sum;
}

/* f's factor on t_j, from the displacements that differ most: whatever the body, near its
 * load it answers like a half-plane. */
static rb_status kernel_scale(const rb_bem_flexibility *f, double *scale)
{
    const double t0 = 1.0 + M_LN2, t1 = 1.0 - 1.5 * log(1.5) - 0.5 * M_LN2;
    const int j = f->n / 2;
    double *r = rb_alloc(2 * (size_t)f->n, 1), *w = rb_alloc(2 * (size_t)f->m, 1);
    const rb_status s = r && w ? RB_OK : RB_ENOMEM;

    if (s == RB_OK) {
        r[j] = 1.0;
        rb_bem_flexibility_apply(f, r, w);
        const double own = f->compliance ? f->compliance[j] : 0.0;
        *scale = (w[j] - own - w[j + 1]) / (t0 - t1);
    }
    free(r);
    free(w);
    return s;
}

/* The symbol of A: sum over k of stencil_k exp(i (k-1) theta), e = exp(i theta). */
static double complex symbol(const double stencil[4], double complex e)
{
    return stencil[0] * conj(e) + stencil[1] + stencil[2] * e + stencil[3] * e * e;
}

rb_status rb_bem_circulant_create(const rb_bem_flexibility *f, const double stencil[4],
                                  const double local[4], rb_bem_circulant **circulant)
{
    double scale = 1.0;
    rb_bem_circulant *c = calloc(1, sizeof *c);

    *circulant = NULL;
    if (c && rb_fourier_make(f->n + f->n / 8 + 2, &c->fourier)) {
        const size_t half = (size_t)c->fourier.size / 2 + 1;
        c->n = f->n;
        c->inverse = rb_alloc(half, 1);
        c->difference = calloc(half, sizeof *c->difference);
        c->tangential = rb_alloc(half, 2);
        c->yielding = c->tangential + half;
        c->work = rb_fourier_alloc(&c->fourier);
    }
    if (!c || !c->inverse || !c->difference || !c->tangential || !c->work ||
        kernel_scale(f, &scale) != RB_OK) {
        rb_bem_circulant_free(c);
        return RB_ENOMEM;
    }
    const double *all = f->compliance;
    const double own[2] = {all ? all[f->n / 2] : 0.0, all ? all[f->n + f->n / 2] : 0.0};
    /* Of F_NN, and of A F_TT; own is what the interface adds to either.  The mean, which
     * the datum of the body decides and for which the symbol vanishes, gets numbers that
     * do no harm. */
    const int size = c->fourier.size;

    for (int k = 1; k <= size / 2; k++) {
        const double theta = 2.0 * M_PI * k / size, body = scale * log_kernel(theta);
        const double complex e = cos(theta) + I * sin(theta);
        const double complex x =
            1.0 / ((body * symbol(stencil, e) + own[1] * symbol(local, e)) * size);
        c->inverse[k] = 1.0 / ((body + own[0]) * size);
        c->difference[k][0] = creal(x);
        c->difference[k][1] = cimag(x);
        c->tangential[k] = body + own[1];
    }
    c->tangential[0] = 4.0 * c->tangential[1];
    c->inverse[0] = 0.25 * c->inverse[1];
    c->difference[0][0] = 0.5 * c->inverse[0];
    *circulant = c;
    return RB_OK;
}

void rb_bem_circulant_apply(const rb_bem_circulant *c, const double *w, double *r)
{
    fftw_complex *z = rb_fourier_forward(&c->fourier, c->n, w, c->work);

    rb_fourier_times_real(&c->fourier, c->inverse, z);
    rb_fourier_backward(&c->fourier, c->work);
    memcpy(r, c->work, (size_t)c->n * sizeof *r);
}

void rb_bem_circulant_apply_difference(const rb_bem_circulant *c, const double *w, double *r)
{
    fftw_complex *z = rb_fourier_forward(&c->fourier, c->n, w, c->work);

    rb_fourier_times(&c->fourier, c->difference[0], z);
    rb_fourier_backward(&c->fourier, c->work);
    memcpy(r, c->work, (size_t)c->n * sizeof *r);
}

void rb_bem_circulant_apply_yielding(const rb_bem_circulant *c, double hardening, const double *w,
                                     double *r)
{
    fftw_complex *z = rb_fourier_forward(&c->fourier, c->n, w, c->work);

    for (int k = 0; k <= c->fourier.size / 2; k++)
        c->yielding[k] = 1.0 / ((1.0 + hardening * c->tangential[k]) * c->fourier.size);
    rb_fourier_times_real(&c->fourier, c->yielding, z);
    rb_fourier_backward(&c->fourier, c->work);
    memcpy(r, c->work, (size_t)c->n * sizeof *r);
}
