/* For builds with --coverage (make coverage), linked with --wrap=_exit: processes that
 * end by _exit, workers and HDF5's own, count as well, and so do those of tests that
 * limit the size of files or let allocations fail. */
#include <stdlib.h>
#include <sys/resource.h>

void __gcov_dump(void);
_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);
void alloc_succeed(void) __attribute__((weak)); /* tests/failing_alloc.c */

static void lift_limits(void)
{
    const struct rlimit none = {RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_FSIZE, &none);
    setrlimit(RLIMIT_AS, &none);
    if (alloc_succeed)
        alloc_succeed();
}

__attribute__((constructor)) static void lift_limits_at_the_end(void)
{
    atexit(lift_limits);
}

_Noreturn void __wrap__exit(int code)
{
    lift_limits();
    __gcov_dump();
    __real__exit(code);
}
