/* Real Fourier transforms in place (FFTW); not installed. */
#ifndef ROLLBEM_BEM_PRODUCTS_FOURIER_H
#define ROLLBEM_BEM_PRODUCTS_FOURIER_H

#include <fftw3.h>

typedef struct {
    int size;                    /* even, quick to transform */
    fftw_plan forward, backward; /* of half as many complex numbers */
    fftw_complex *turn;          /* size/4 + 1 roots of unity */
} rb_fourier;

/* Length at least `least`; 0 without memory, f is then empty. */
int rb_fourier_make(int least, rb_fourier *f);
void rb_fourier_free(rb_fourier *f);

/* Room for one sequence and its transform, size/2 + 1 numbers; fftw_free(). */
double *rb_fourier_alloc(const rb_fourier *f);

/* x (n values, zeros behind them) to its transform, and back without the factor 1/size. */
fftw_complex *rb_fourier_forward(const rb_fourier *f, int n, const double *x, double *work);
void rb_fourier_backward(const rb_fourier *f, double *work);

/* The transform over `size` of a kernel at distances 1 - n ... n - 1, in work. */
fftw_complex *rb_fourier_kernel(const rb_fourier *f, int n, const double *t, double *work);

/* z times a complex number (two of `by`), or a real one, for each wave. */
void rb_fourier_times(const rb_fourier *f, const double *by, fftw_complex *z);
void rb_fourier_times_real(const rb_fourier *f, const double *by, fftw_complex *z);
/* a becomes N a + C b, b becomes T b - C a, for complex N, T and C of each wave. */
void rb_fourier_times_coupled(const rb_fourier *f, const double *N, const double *T,
                              const double *C, fftw_complex *a, fftw_complex *b);

#endif
