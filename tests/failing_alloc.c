/* malloc, calloc and realloc of the library under test, failing on demand.  Linked with
 * --wrap, so that no product code knows of it. */
#include "check.h"

#include <errno.h>

static int remaining = -1; /* < 0: never fail */
static int refused;

void alloc_fail_after(int count)
{
    remaining = count;
    refused = 0;
}

void alloc_succeed(void)
{
    remaining = -1;
}

int alloc_failed(void)
{
    return refused;
}

static int allowed(void)
{
    if (remaining < 0)
        return 1;
    if (remaining > 0) {
        remaining--;
        return 1;
    }
    refused = 1;
    errno = ENOMEM;
    return 0;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *p, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *p, size_t size);

void *__wrap_malloc(size_t size)
{
    return allowed() ? __real_malloc(size) : NULL;
}

void *__wrap_calloc(size_t n, size_t size)
{
    return allowed() ? __real_calloc(n, size) : NULL;
}

void *__wrap_realloc(void *p, size_t size)
{
    return allowed() ? __real_realloc(p, size) : NULL;
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return allowed() ? __real_aligned_alloc(alignment, size) : NULL;
}
