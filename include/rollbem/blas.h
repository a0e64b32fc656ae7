/* Which of OpenBLAS' kernels run: a library older than the processor may not know it and
 * take slow ones (0.3.21 takes those of 2004 for a server of 2023: four times slower). */
#ifndef ROLLBEM_BLAS_H
#define ROLLBEM_BLAS_H

#include "rollbem/base.h"

RB_PUBLIC_BEGIN

/* "SkylakeX", "Haswell", ...: what is in use. */
const char *rb_blas_core(void);

/* The kernels that this processor could run and OpenBLAS did not choose, as a value of
 * the environment variable OPENBLAS_CORETYPE, which it reads when it is loaded; NULL:
 * none. */
const char *rb_blas_better_core(void);

/* Lets BLAS use that many threads (0: one per processor, or
 * what OPENBLAS_NUM_THREADS says) and returns how many it used
 * before.  Threads cost the small products of Lemke and Newton more than they bring. */
int rb_blas_threads(int threads);

/* Threads of a loop that the library runs by OpenMP: as many as OMP_NUM_THREADS says, but
 * four a processor at most.  Tens of thousands of them end the process by a signal. */
int rb_blas_loop_threads(void);

/* Under a limit of address space (ulimit -v) a thread of OpenBLAS that gets no buffer
 * waits for it for ever.  1: there is room for all; where it has one thread only, OpenMP
 * is reduced to one too if need be. */
int rb_blas_has_room(void);

RB_PUBLIC_END

#endif
