/* For builds with --coverage (make coverage), linked with --wrap for _exit and kill:
 * processes that end by _exit, workers and HDF5's own, count as well, and so do those of
 * tests that limit the size of files or let allocations fail.  A worker whose socket is
 * closed ends by itself: it gets the time to before it is killed. */
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>

void __gcov_dump(void);
_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);
int __real_kill(pid_t pid, int signal);
int __wrap_kill(pid_t pid, int signal);
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

/* A process that is no child of this one is killed at once. */
int __wrap_kill(pid_t pid, int signal)
{
    const struct timespec millisecond = {0, 1000000};
    siginfo_t ended = {.si_pid = 0};

    for (int k = 0; k < 100 && signal == SIGKILL && ended.si_pid == 0; k++) {
        if (waitid(P_PID, (id_t)pid, &ended, WEXITED | WNOHANG | WNOWAIT) != 0)
            break;
        nanosleep(&millisecond, NULL);
    }
    return __real_kill(pid, signal);
}
