#define _XOPEN_SOURCE 700 /* setenv */
#include "check.h"
#include "rollbem/blas.h"

#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static void a_better_core_is_another_one(void **state)
{
    (void)state;
    const char *core = rb_blas_core(), *better = rb_blas_better_core();
    assert_true(strlen(core) > 0);
    if (better)
        assert_string_not_equal(core, better);
}

static void the_caller_sets_the_number_of_threads(void **state)
{
    (void)state;
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

/* In a process of its own: the limit stays. */
static int room_below(rlim_t limit)
{
    const pid_t child = fork();
    int status;
    if (child == 0) {
        const struct rlimit most = {limit, RLIM_INFINITY};
        _exit(setrlimit(RLIMIT_AS, &most) != 0 ? 2 : rb_blas_has_room());
    }
    assert_true(child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void memory_for_the_buffers_is_asked_for_first(void **state)
{
    (void)state;
    if (SANITIZED)
        skip();
    assert_int_equal(room_below(RLIM_INFINITY), 1);
    assert_int_equal(room_below((rlim_t)1 << 40), 1);
    assert_int_equal(room_below((rlim_t)64 << 20), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_better_core_is_another_one),
        cmocka_unit_test(the_caller_sets_the_number_of_threads),
        cmocka_unit_test(memory_for_the_buffers_is_asked_for_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
