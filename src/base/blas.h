/* Which kernels OpenBLAS uses.  A version of OpenBLAS that is older than the processor
 * may not recognise it and choose slow kernels (0.3.21 chooses kernels of 2004 on a
 * server of 2023, which are four times slower). */
#ifndef ROLLBEM_SRC_BASE_BLAS_H
#define ROLLBEM_SRC_BASE_BLAS_H

#include "base/base.h"

/* The name of the kernels in use: "SkylakeX", "Haswell", ... */
const char *rb_blas_core(void);

/* The name of faster kernels that this processor can run although OpenBLAS did not choose
 * them; NULL: there are none.  The name is a value for the environment variable
 * OPENBLAS_CORETYPE, which OpenBLAS reads when it is loaded. */
const char *rb_blas_better_core(void);

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
