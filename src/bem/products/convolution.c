/* Products with a Toeplitz matrix by Fourier transforms. */
#include "bem/products/fourier.h"

#include "bem/bem.h"

#include <stdlib.h>
#include <string.h>

struct rb_bem_convolution {
    int n;
    fftw_complex *t; /* size/2 + 1: the transform of t, over `size` */
    double *work;
    rb_fourier fourier;
};

void rb_bem_convolution_free(rb_bem_convolution *c)
{
    if (!c)
        return;
    rb_fourier_free(&c->fourier);
    fftw_free(c->t);
    fftw_free(c->work);
    free(c);
}

rb_bem_convolution *rb_bem_convolution_create(int n, const double *t)
{
    rb_bem_convolution *c = calloc(1, sizeof *c);

    if (c && rb_fourier_make(2 * n, &c->fourier)) {
        c->n = n;
        c->t = (fftw_complex *)rb_fourier_alloc(&c->fourier);
        c->work = rb_fourier_alloc(&c->fourier);
    }
    if (!c || !c->t || !c->work) {
        rb_bem_convolution_free(c);
        return NULL;
    }
    rb_fourier_kernel(&c->fourier, n, t, (double *)c->t);
    return c;
}

void rb_bem_convolution_apply(const rb_bem_convolution *c, const double *r, double *w)
{
    fftw_complex *z = rb_fourier_forward(&c->fourier, c->n, r, c->work);

    rb_fourier_times(&c->fourier, c->t[0], z);
    rb_fourier_backward(&c->fourier, c->work);
    memcpy(w, c->work, (size_t)c->n * sizeof *w);
}
