#define _XOPEN_SOURCE 700 /* setenv */
#include "check.h"
#include "base/blas.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

TEST(a_better_core_is_another_one)
{
    const char *core = rb_blas_core(), *better = rb_blas_better_core();
    assert_true(strlen(core) > 0);
    if (better)
        assert_string_not_equal(core, better);
}

TEST(the_caller_sets_the_number_of_threads)
{
    unsetenv("OPENBLAS_NUM_THREADS");
    const int at_first = rb_blas_threads(1);
    assert_int_equal(rb_blas_threads(0), 1); /* 0: one for each processor */
    const int most = rb_blas_threads(at_first);
    assert_true(most >= 1);
    setenv("OPENBLAS_NUM_THREADS", "1", 1); /* whoever starts the program decides */
    rb_blas_threads(1);
    rb_blas_threads(0);
    assert_int_equal(rb_blas_threads(at_first), 1);
}

/* Bytes of address space in use, of which a sanitizer's shadow takes terabytes. */
static rlim_t in_use(void)
{
    unsigned long pages = 0;
    FILE *f = NOT_NULL(fopen("/proc/self/statm", "r"));
    assert_int_equal(fscanf(f, "%lu", &pages), 1);
    fclose(f);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}

/* With so many MB of address space left and eight threads of OpenMP, in a process of its
 * own, as the limit stays: 10 times the threads of OpenMP afterwards (8 without it) and
 * whether there is room. */
static int room_with(rlim_t megabytes, int threads)
{
    const rlim_t limit = megabytes == RLIM_INFINITY ? RLIM_INFINITY : in_use() + (megabytes << 20);
    const pid_t child = fork();
    int status;
    if (child == 0) {
        const struct rlimit most = {limit, RLIM_INFINITY};
        int others = 8;
        rb_blas_threads(threads);
#ifdef _OPENMP
        omp_set_num_threads(others);
#endif
        const int room = setrlimit(RLIMIT_AS, &most) != 0 ? 9 : rb_blas_has_room();
#ifdef _OPENMP
        others = omp_get_max_threads();
#endif
        _exit(10 * others + room);
    }
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status));
    return WEXITSTATUS(status);
}

/* 160 MB for each thread of BLAS and each other one of OpenMP; one thread of BLAS can do
 * with one buffer, several cannot. */
TEST(memory_for_the_buffers_is_asked_for_first)
{
#ifdef _OPENMP
    const int alone = 11;
#else
    const int alone = 81;
#endif
    assert_int_equal(room_with(RLIM_INFINITY, 1), 81);
    assert_int_equal(room_with(1 << 14, 1), 81);
    assert_int_equal(room_with(300, 1), alone);
    assert_int_equal(room_with(100, 1), 80);
    const int before = rb_blas_threads(2);
    if (rb_blas_threads(before) == 2)
        assert_int_equal(room_with(300, 2), 80);
}

/* Idle threads of the program's OpenMP sleep, unless the environment says otherwise: libgomp counts
 * how often they look for work before. */
TEST(the_program_waits_passively)
{
    const char *build = getenv("B") ? getenv("B") : "build";
    char command[400], line[200] = "";
    snprintf(
        command, sizeof command,
        "nm %s/rollbem 2>/dev/null | grep -qw '[Tt] GOMP_parallel' && "
        "env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT OMP_DISPLAY_ENV=verbose %s/rollbem --version "
        "2>&1 | grep SPINCOUNT",
        build, build);
    FILE *output = NOT_NULL(popen(command, "r"));
    const int spoke = fgets(line, sizeof line, output) != NULL;
    pclose(output);
    if (!spoke) { /* OpenMP is not part of the program, or another one */
        print_message("left out: no libgomp within the program\n");
        skip();
    }
    assert_non_null(strstr(line, "'0'"));
}

RUN_TESTS(NULL, NULL)
