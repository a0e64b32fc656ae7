#include "bem/fourier.h"
#include "rollbem/blas.h"

#ifdef _OPENMP
#include <omp.h>
#endif
#include <pthread.h>
#include <string.h>

/* Below this length a transform is over before a second thread has begun. */
enum { THREADS_FROM = 1 << 17 };

/* The smallest even 2^a 3^b 5^c >= least: FFTW transforms such lengths fastest. */
static int good_size(int least)
{
    for (int size = least + least % 2;; size += 2) {
        int rest = size;
        while (rest % 2 == 0)
            rest /= 2;
        while (rest % 3 == 0)
            rest /= 3;
        while (rest % 5 == 0)
            rest /= 5;
        if (rest == 1)
            return size;
    }
}

double *rb_fourier_alloc(const rb_fourier *f)
{
    return fftw_alloc_real((size_t)f->size + 2);
}

/* FFTW's planner is not reentrant, nor is the end of a plan.  No critical section of
 * OpenMP, as threads of the caller meet here in a build without OpenMP, too. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

int rb_fourier_make(int least, rb_fourier *f)
{
    *f = (rb_fourier){.size = good_size(least)};
    double *work = rb_fourier_alloc(f);
    fftw_complex *transform = (fftw_complex *)work;

    if (work) {
        pthread_mutex_lock(&planner);
        static int prepared;

        if (!prepared)
            prepared = fftw_init_threads();
#ifdef _OPENMP
        fftw_plan_with_nthreads(f->size >= THREADS_FROM ? rb_blas_loop_threads() : 1);
#endif
        f->forward = fftw_plan_dft_r2c_1d(f->size, work, transform, FFTW_ESTIMATE);
        f->backward = fftw_plan_dft_c2r_1d(f->size, transform, work, FFTW_ESTIMATE);
        pthread_mutex_unlock(&planner);
    }
    fftw_free(work);
    if (f->forward && f->backward)
        return 1;
    rb_fourier_free(f);
    return 0;
}

void rb_fourier_free(rb_fourier *f)
{
    pthread_mutex_lock(&planner);
    if (f->forward)
        fftw_destroy_plan(f->forward);
    if (f->backward)
        fftw_destroy_plan(f->backward);
    pthread_mutex_unlock(&planner);
    memset(f, 0, sizeof *f);
}

/* Buffers of fftw_alloc_real() are aligned alike, as FFTW's new-array calls ask. */
fftw_complex *rb_fourier_forward(const rb_fourier *f, int n, const double *x, double *work)
{
    if (x != work)
        memcpy(work, x, (size_t)n * sizeof *work);
    memset(work + n, 0, (size_t)(f->size + 2 - n) * sizeof *work);
    fftw_execute_dft_r2c(f->forward, work, (fftw_complex *)work);
    return (fftw_complex *)work;
}

void rb_fourier_backward(const rb_fourier *f, double *work)
{
    fftw_execute_dft_c2r(f->backward, (fftw_complex *)work, work);
}
