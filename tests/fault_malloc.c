/* Loaded before a program (LD_PRELOAD): lets its allocations fail, those of libraries
 * too.  Counted from the start of main, in programs called rollbem only.
 *   FAULT_MALLOC=K   the K-th allocation fails
 *   FAULT_FROM=K     all from the K-th on fail
 *   FAULT_COUNT=FILE the number of allocations of main is written there */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static int counts;
static long *count, only, from; /* count: of all processes that main forks */

static int allowed(void)
{
    if (!counts)
        return 1;
    const long k = __atomic_add_fetch(count, 1, __ATOMIC_RELAXED);
    if (k != only && (from == 0 || k < from))
        return 1;
    errno = ENOMEM;
    return 0;
}

void *malloc(size_t size)
{
    return allowed() ? __libc_malloc(size) : NULL;
}

void *calloc(size_t n, size_t size)
{
    return allowed() ? __libc_calloc(n, size) : NULL;
}

void *realloc(void *p, size_t size)
{
    return allowed() ? __libc_realloc(p, size) : NULL;
}

void *memalign(size_t alignment, size_t size)
{
    return allowed() ? __libc_memalign(alignment, size) : NULL;
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return allowed() ? __libc_memalign(alignment, size) : NULL;
}

int posix_memalign(void **p, size_t alignment, size_t size)
{
    if (!allowed())
        return ENOMEM;
    *p = __libc_memalign(alignment, size);
    return *p ? 0 : ENOMEM;
}

/* ---- From the start of main to its end --------------------------------------------- */

typedef int program_main(int argc, char **argv, char **environment);

static program_main *real_main;

static long number(const char *name)
{
    const char *text = getenv(name);
    return text ? atol(text) : 0;
}

static int counted_main(int argc, char **argv, char **environment)
{
    const char *file = getenv("FAULT_COUNT");
    only = number("FAULT_MALLOC");
    from = number("FAULT_FROM");
    count = mmap(NULL, sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                 -1, 0);
    counts =
        count != MAP_FAILED && strncmp(program_invocation_short_name, "rollbem", 7) == 0;
    const int code = real_main(argc, argv, environment);
    const int counted = counts;
    counts = 0;
    FILE *out = counted && file ? fopen(file, "w") : NULL;
    if (out) {
        fprintf(out, "%ld\n", *count);
        fclose(out);
    }
    return code;
}

int __libc_start_main(program_main *start, int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
    int (*real)(program_main *, int, char **, void (*)(void), void (*)(void),
                void (*)(void), void *) = NULL;
    *(void **)&real = dlsym(RTLD_NEXT, "__libc_start_main");
    real_main = start;
    return real(counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}
