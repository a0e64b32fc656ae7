#define _DEFAULT_SOURCE /* madvise */
#include "bem/large.h"

#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

double *rb_large_alloc(size_t rows, size_t cols)
{
    const size_t page = (size_t)2 << 20, line = 64;
    if (cols && rows > (SIZE_MAX - page) / sizeof(double) / cols)
        return NULL;
    const size_t bytes = rows * cols * sizeof(double), unit = bytes < page ? line : page;
    const size_t whole = (bytes / unit + 1) * unit;
    double *p = aligned_alloc(unit, whole);
#ifdef MADV_HUGEPAGE
    if (p && unit == page)
        madvise(p, whole, MADV_HUGEPAGE);
#endif
    return p;
}
