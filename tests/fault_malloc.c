/* Loaded before a program (LD_PRELOAD): lets its allocations fail, those of libraries
 * too, from the start of main to its end.  In place of main a server runs, which forks a
 * process that goes on with main for every fault_request; its output goes to the files
 * out and err, FAULT_CALLS names the file that keeps the calls that have seen a failure,
 * FAULT_CODE_END says how far in the program calls count (hexadecimal; empty: all), and
 * FAULT_KERNELS names a file of those that use memory without a look: from, to (hexadecimal). */
#define _GNU_SOURCE
#include "fault_calls.h"
#include "fault_malloc.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

/* Shared by all processes that main forks. */
typedef struct {
    long allocations;
    int refused;
} tally;

static int counts;
static tally *run;
static fault_request request;

/* ---- Allocations ------------------------------------------------------------------- */

static int refuses(long k, const void *caller, const void *frame)
{
    if (request.by_calls)
        return !run->refused && has_new_call(caller, frame);
    return (k == request.only || (request.from && k >= request.from)) && !is_unchecked(caller);
}

static int allowed(const void *caller, const void *frame)
{
    if (!counts)
        return 1;
    const long k = __atomic_add_fetch(&run->allocations, 1, __ATOMIC_RELAXED);
    if (!refuses(k, caller, frame))
        return 1;
    run->refused = 1;
    errno = ENOMEM;
    return 0;
}

#define ALLOWED allowed(__builtin_return_address(0), __builtin_frame_address(0))

void *malloc(size_t size)
{
    return ALLOWED ? __libc_malloc(size) : NULL;
}

void *calloc(size_t n, size_t size)
{
    return ALLOWED ? __libc_calloc(n, size) : NULL;
}

void *realloc(void *p, size_t size)
{
    return ALLOWED ? __libc_realloc(p, size) : NULL;
}

void *memalign(size_t alignment, size_t size)
{
    return ALLOWED ? __libc_memalign(alignment, size) : NULL;
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return ALLOWED ? __libc_memalign(alignment, size) : NULL;
}

int posix_memalign(void **p, size_t alignment, size_t size)
{
    if (!ALLOWED)
        return ENOMEM;
    *p = __libc_memalign(alignment, size);
    return *p ? 0 : ENOMEM;
}

void alloc_succeed(void);

/* ---- From the start of main to its end --------------------------------------------- */

typedef int program_main(int argc, char **argv, char **environment);

static program_main *real_main;

static void *map_shared(size_t size, const char *file)
{
    const int fd = file ? open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666) : -1;
    if (file && (fd < 0 || ftruncate(fd, (off_t)size) != 0))
        abort();
    void *at = mmap(NULL, size, PROT_READ | PROT_WRITE,
                    file ? MAP_SHARED : MAP_SHARED | MAP_ANONYMOUS, fd, 0);
    if (at == MAP_FAILED)
        abort();
    close(fd);
    return at;
}

static void redirect(int to, const char *file)
{
    const int fd = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0 || dup2(fd, to) < 0)
        abort();
    close(fd);
}

/* Called by the program where it keeps its counters (tests/coverage.c). */
void alloc_succeed(void)
{
    counts = 0;
}

static int counted_main(int argc, char **argv, char **environment)
{
    counts = 1;
    const int code = real_main(argc, argv, environment);
    counts = 0;
    return code;
}

static int serve(int argc, char **argv, char **environment)
{
    fault_reply reply;
    calls = map_shared(CALLS * sizeof *calls, getenv("FAULT_CALLS"));
    stacks = map_shared(STACKS * sizeof *stacks, NULL);
    run = map_shared(sizeof *run, NULL);
    find_program();
    FILE *ranges = fopen(getenv("FAULT_KERNELS"), "r");
    for (; ranges && kernels < KERNELS; kernels++)
        if (fscanf(ranges, "%" SCNxPTR " %" SCNxPTR, &kernel[kernels][0], &kernel[kernels][1]) != 2)
            break;
    if (ranges)
        fclose(ranges);
    const char *end = getenv("FAULT_CODE_END");
    if (end && *end)
        code_end = base + strtoul(end, NULL, 16);
    unsetenv("FAULT_CODE_END");
    unsetenv("FAULT_KERNELS");
    unsetenv("FAULT_CALLS");
    unsetenv("LD_PRELOAD");
    while (read(FAULT_REQUESTS, &request, sizeof request) == sizeof request) {
        *run = (tally){0};
        call_parts = request.parts > 0 ? (unsigned)request.parts : 1;
        call_part = (unsigned)request.part;
        const pid_t pid = fork();
        if (pid == 0) {
            close(FAULT_REQUESTS);
            close(FAULT_REPLIES);
            redirect(1, "out");
            redirect(2, "err");
            return counted_main(argc, argv, environment);
        }
        if (waitpid(pid, &reply.status, 0) != pid)
            abort();
        reply.refused = run->refused;
        reply.allocations = run->allocations;
        if (write(FAULT_REPLIES, &reply, sizeof reply) != sizeof reply)
            abort();
    }
    _exit(0);
}

int __libc_start_main(program_main *start, int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
    int (*real)(program_main *, int, char **, void (*)(void), void (*)(void), void (*)(void),
                void *) = NULL;
    *(void **)&real = dlsym(RTLD_NEXT, "__libc_start_main");
    real_main = start;
    return real(getenv("FAULT_CALLS") ? serve : start, argc, argv, init, fini, rtld_fini,
                stack_end);
}
