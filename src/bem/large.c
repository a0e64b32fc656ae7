#define _DEFAULT_SOURCE /* madvise */
#include "bem/large.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

double *rb_large_alloc(size_t rows, size_t cols)
{
    if (cols && rows > SIZE_MAX / sizeof(double) / cols)
        return NULL;
    const size_t bytes = rows * cols * sizeof(double), page = (size_t)2 << 20;
    double *p = malloc(bytes ? bytes : 1);
#ifdef MADV_HUGEPAGE
    const uintptr_t first = ((uintptr_t)p + page - 1) / page * page,
                    last = ((uintptr_t)p + bytes) / page * page;
    if (p && first < last)
        madvise((char *)p + (first - (uintptr_t)p), last - first, MADV_HUGEPAGE);
#endif
    return p;
}
