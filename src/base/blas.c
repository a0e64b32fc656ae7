/* Which kernels OpenBLAS uses, and how many threads loops and products may take. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "base/blas.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#ifdef _OPENMP
#include <omp.h>
#endif

const char *rb_blas_core(void)
{
    return openblas_get_corename();
}

#if defined(__x86_64__) && defined(__GNUC__)
static int in_use(const char *const *cores)
{
    for (; *cores; cores++)
        if (strcmp(*cores, rb_blas_core()) == 0)
            return 1;
    return 0;
}

const char *rb_blas_better_core(void)
{
    static const char *const wide[] = {"SkylakeX", "Cooperlake", "SapphireRapids", NULL},
                             *const avx2[] = {"Haswell", "Zen", "SkylakeX", NULL};
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        return in_use(wide) ? NULL : "SkylakeX";
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return in_use(avx2) ? NULL : "Haswell";
    return NULL;
}
#else
const char *rb_blas_better_core(void)
{
    return NULL;
}
#endif

int rb_blas_threads(int threads)
{
    const int before = openblas_get_num_threads();
    if (threads > 0)
        openblas_set_num_threads(threads);
    else if (!getenv("OPENBLAS_NUM_THREADS"))
        openblas_set_num_threads(openblas_get_num_procs());
    return before;
}

static int is_room_for(size_t bytes)
{
    void *room = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room != MAP_FAILED)
        munmap(room, bytes);
    return room != MAP_FAILED;
}

int rb_blas_loop_threads(void)
{
#ifdef _OPENMP
    static _Atomic int most; /* asking costs more than a short loop */
    if (most == 0)
        most = 4 * omp_get_num_procs();
    const int wanted = omp_get_max_threads();
    return wanted < most ? wanted : most;
#else
    return 1;
#endif
}

int rb_blas_has_room(void)
{
    const size_t buffer = (size_t)160 << 20; /* OpenBLAS: 32 to 128 MB each */
    const int threads = openblas_get_num_threads();
    struct rlimit limit;
    double a = 1.0;
    lapack_int pivot;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return 1;
    if (!is_room_for(buffer * (size_t)(threads + rb_blas_loop_threads() - 1))) {
        if (threads > 1 || !is_room_for(buffer))
            return 0;
#ifdef _OPENMP
        omp_set_num_threads(1);
#endif
    }
    /* takes one and keeps it */
    LAPACKE_dgetrf_work(LAPACK_COL_MAJOR, 1, 1, &a, 1, &pivot);
    return 1;
}
