#include "rollbem/blas.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

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
