/* Kernels and threads of OpenBLAS; rb_blas_better_core is in rollbem/base.h. */
#ifndef ROLLBEM_SRC_BASE_BLAS_H
#define ROLLBEM_SRC_BASE_BLAS_H

#include "base/base.h"

/* The name of the kernels in use: "SkylakeX", "Haswell", ... */
const char *rb_blas_core(void);

/* Number of OpenMP threads that the library uses in a loop: the value of OMP_NUM_THREADS,
 * but at most four per processor, because tens of thousands of threads would crash the
 * process. */
int rb_blas_loop_threads(void);

/* Under a limit of address space (ulimit -v) an OpenBLAS thread that gets no buffer waits
 * for it forever.  Returns 1 if there is enough address space for all threads.  If
 * OpenBLAS has one thread only, the function reduces OpenMP to one thread where
 * necessary. */
int rb_blas_has_room(void);

#endif
