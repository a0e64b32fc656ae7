/* A real transform by a complex one of half the length; plans are kept from case to case. */
#include "bem/products/fourier.h"
#include "base/sizes.h"
#include "base/blas.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

double *rb_fourier_alloc(const rb_fourier *f)
{
    return fftw_alloc_real((size_t)f->size + 2);
}

/* FFTW's planner is not reentrant, nor is the end of a plan.  No critical section of
 * OpenMP, as threads of the caller meet here in a build without OpenMP, too. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

/* A plan takes longer than the transforms of a small contact, so those of the last lengths are kept
 * from case to case.  Many users share one: executing it changes nothing in it. */
enum { KEPT = 16, KEPT_UP_TO = 1 << 15 };
static struct {
    rb_fourier f;
    int users;
    unsigned used; /* when, counted in calls */
} kept[KEPT];
static unsigned calls;

/* 1: a plan of f's length is kept, and is f's now.  Within the planner's lock. */
static int take_kept(rb_fourier *f)
{
    for (int k = 0; k < KEPT; k++)
        if (kept[k].f.forward && kept[k].f.size == f->size) {
            *f = kept[k].f;
            kept[k].users++;
            kept[k].used = ++calls;
            return 1;
        }
    return 0;
}

static void destroy(rb_fourier *f)
{
    if (f->forward)
        fftw_destroy_plan(f->forward);
    if (f->backward)
        fftw_destroy_plan(f->backward);
    fftw_free(f->turn);
    memset(f, 0, sizeof *f);
}

/* In the place of the one that has not been used for longest.  Within the planner's lock. */
static void keep_plan(const rb_fourier *f)
{
    int oldest = -1;

    for (int k = 0; k < KEPT && f->size <= KEPT_UP_TO; k++)
        if (kept[k].users == 0 && (oldest < 0 || kept[k].used < kept[oldest].used))
            oldest = k;
    if (oldest < 0)
        return;
    destroy(&kept[oldest].f);
    kept[oldest].f = *f;
    kept[oldest].users = 1;
    kept[oldest].used = ++calls;
}

/* Where the program or the library ends. */
__attribute__((destructor)) static void destroy_kept(void)
{
    pthread_mutex_lock(&planner);
    for (int k = 0; k < KEPT; k++)
        if (kept[k].users == 0)
            destroy(&kept[k].f);
    pthread_mutex_unlock(&planner);
}

/* Within the planner's lock.  0: out of memory. */
static int plan(rb_fourier *f)
{
    const int half = f->size / 2;
    fftw_complex *work = fftw_alloc_complex((size_t)half + 1);
    static int prepared;

    f->turn = fftw_alloc_complex((size_t)half / 2 + 1);
    if (work && f->turn) {
        if (!prepared)
            prepared = fftw_init_threads();
#ifdef _OPENMP
        fftw_plan_with_nthreads(f->size >= RB_FOURIER_THREADS_FROM ? rb_blas_loop_threads() : 1);
#endif
        f->forward = fftw_plan_dft_1d(half, work, work, FFTW_FORWARD, FFTW_ESTIMATE);
        f->backward = fftw_plan_dft_1d(half, work, work, FFTW_BACKWARD, FFTW_ESTIMATE);
        for (int k = 0; k <= half / 2; k++) {
            f->turn[k][0] = cos(M_PI * k / half);
            f->turn[k][1] = -sin(M_PI * k / half);
        }
    }
    fftw_free(work);
    if (f->forward && f->backward)
        return 1;
    destroy(f);
    return 0;
}

int rb_fourier_make(int least, rb_fourier *f)
{
    static const int primes[] = {2, 3, 5};

    /* The smallest even 2^a 3^b 5^c >= least: FFTW transforms such lengths fastest. */
    *f = (rb_fourier){0};
    for (int size = least + least % 2, rest = 0; rest != 1; size += 2) {
        rest = f->size = size;
        for (int k = 0; k < 3; k++)
            while (rest % primes[k] == 0)
                rest /= primes[k];
    }
    pthread_mutex_lock(&planner);
    int made = take_kept(f);
    if (!made && (made = plan(f)))
        keep_plan(f);
    pthread_mutex_unlock(&planner);
    return made;
}

void rb_fourier_free(rb_fourier *f)
{
    int is_kept = 0;

    if (!f->forward)
        return;
    pthread_mutex_lock(&planner);
    for (int k = 0; k < KEPT && !is_kept; k++)
        if (kept[k].f.forward == f->forward) {
            kept[k].users--;
            is_kept = 1;
        }
    if (!is_kept)
        destroy(f);
    pthread_mutex_unlock(&planner);
    memset(f, 0, sizeof *f);
}

/* Even and odd values are the real and the imaginary parts of half as many complex ones,
 * whose transform Z has X_k = E_k + w^k O_k with E_k = (Z_k + conj Z_-k)/2 and
 * O_k = (Z_k - conj Z_-k)/(2i), w = exp(-2 pi i/size).  FFTW plans a complex transform
 * twenty times as fast as a real one, whose plan takes longer than a small contact.
 * Buffers of fftw_alloc_real() are aligned alike, as FFTW's new-array calls ask. */
fftw_complex *rb_fourier_forward(const rb_fourier *f, int n, const double *x, double *work)
{
    const int half = f->size / 2;
    fftw_complex *z = (fftw_complex *)work;

    if (x != work)
        memcpy(work, x, (size_t)n * sizeof *work);
    memset(work + n, 0, (size_t)(f->size + 2 - n) * sizeof *work);
    fftw_execute_dft(f->forward, z, z);
    const double even = z[0][0], odd = z[0][1];
    for (int k = 1; k <= half / 2; k++) {
        double *a = z[k], *b = z[half - k];
        const double E[2] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] - b[1])},
                     O[2] = {0.5 * (a[1] + b[1]), 0.5 * (b[0] - a[0])};
        const double *w = f->turn[k],
                     turned[2] = {w[0] * O[0] - w[1] * O[1], w[0] * O[1] + w[1] * O[0]};
        a[0] = E[0] + turned[0];
        a[1] = E[1] + turned[1];
        b[0] = E[0] - turned[0];
        b[1] = turned[1] - E[1];
    }
    z[0][0] = even + odd;
    z[half][0] = even - odd;
    z[0][1] = z[half][1] = 0.0;
    return z;
}

/* Z_k = E_k + i O_k, times 2. */
void rb_fourier_backward(const rb_fourier *f, double *work)
{
    const int half = f->size / 2;
    fftw_complex *z = (fftw_complex *)work;
    const double first = z[0][0], last = z[half][0];

    for (int k = 1; k <= half / 2; k++) {
        double *a = z[k], *b = z[half - k];
        const double E[2] = {a[0] + b[0], a[1] - b[1]}, turned[2] = {a[0] - b[0], a[1] + b[1]};
        const double *w = f->turn[k], O[2] = {w[0] * turned[0] + w[1] * turned[1],
                                              w[0] * turned[1] - w[1] * turned[0]};
        a[0] = E[0] - O[1];
        a[1] = E[1] + O[0];
        b[0] = E[0] + O[1];
        b[1] = O[0] - E[1];
    }
    z[0][0] = first + last;
    z[0][1] = first - last;
    fftw_execute_dft(f->backward, z, z);
}

fftw_complex *rb_fourier_kernel(const rb_fourier *f, int n, const double *t, double *work)
{
    const int size = f->size;

    memset(work, 0, (size_t)size * sizeof *work);
    for (int k = 1 - n; k < n; k++)
        work[k < 0 ? size + k : k] = t[n - 1 + k] / size;
    return rb_fourier_forward(f, size, work, work);
}

void rb_fourier_times(const rb_fourier *f, const double *by, fftw_complex *z)
{
    for (int k = 0; k <= f->size / 2; k++) {
        const double re = z[k][0], im = z[k][1];
        z[k][0] = by[2 * k] * re - by[2 * k + 1] * im;
        z[k][1] = by[2 * k] * im + by[2 * k + 1] * re;
    }
}

void rb_fourier_times_real(const rb_fourier *f, const double *by, fftw_complex *z)
{
    for (int k = 0; k <= f->size / 2; k++) {
        z[k][0] *= by[k];
        z[k][1] *= by[k];
    }
}

void rb_fourier_times_coupled(const rb_fourier *f, const double *N, const double *T,
                              const double *C, fftw_complex *a, fftw_complex *b)
{
    for (int k = 0; k <= f->size / 2; k++) {
        const double *n = N + 2 * k, *t = T + 2 * k, *c = C + 2 * k;
        const double x[2] = {a[k][0], a[k][1]}, y[2] = {b[k][0], b[k][1]};

        a[k][0] = n[0] * x[0] - n[1] * x[1] + c[0] * y[0] - c[1] * y[1];
        a[k][1] = n[0] * x[1] + n[1] * x[0] + c[0] * y[1] + c[1] * y[0];
        b[k][0] = t[0] * y[0] - t[1] * y[1] - c[0] * x[0] + c[1] * x[1];
        b[k][1] = t[0] * y[1] + t[1] * y[0] - c[0] * x[1] - c[1] * x[0];
    }
}
