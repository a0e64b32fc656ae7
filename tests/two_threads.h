/* A test in a process whose OpenBLAS has two threads. */
#ifndef TWO_THREADS_H
#define TWO_THREADS_H

#include "check.h"
#include "base/blas.h"

/* Calls the test twice: with OPENBLAS_NUM_THREADS unset and, forced, with 2.  Skips it where
 * the library has one thread. */
static inline void with_two_threads(void (*test)(int forced))
{
    const char *given = getenv("OPENBLAS_NUM_THREADS");
    char before[20];
    snprintf(before, sizeof before, "%s", given ? given : "");
    for (int forced = 0; forced < 2; forced++) {
        if (forced)
            setenv("OPENBLAS_NUM_THREADS", "2", 1);
        else
            unsetenv("OPENBLAS_NUM_THREADS");
        rb_blas_threads(2);
        if (rb_blas_threads(2) != 2)
            skip();
        test(forced);
    }
    if (given)
        setenv("OPENBLAS_NUM_THREADS", before, 1);
    else
        unsetenv("OPENBLAS_NUM_THREADS");
}

#endif
