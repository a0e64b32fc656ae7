/* What the program does when it starts: OpenBLAS' best kernels for this processor, which
 * it reads from the environment while it is loaded, hence the second start; one thread. */
#ifndef ROLLBEM_BENCH_FAST_BLAS_H
#define ROLLBEM_BENCH_FAST_BLAS_H

#include "base/blas.h"

#include <stdlib.h>
#include <unistd.h>

static inline void fast_blas(char **argv)
{
    const char *core = rb_blas_better_core();
    if (core && !getenv("OPENBLAS_CORETYPE") && setenv("OPENBLAS_CORETYPE", core, 1) == 0)
        execv("/proc/self/exe", argv);
    rb_blas_threads(1);
}

#endif
