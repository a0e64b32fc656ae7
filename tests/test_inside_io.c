/* The process of its own in which HDF5 reads: its answers, its ends, its silence. */
#define _GNU_SOURCE
#include "check.h"
#include "failing_call.h"
#include "base/io/child.h"
#include "scratch.h"

#include <signal.h>
#include <sys/resource.h>

typedef enum { ANSWERS, REFUSES, CRASHES, IS_KILLED, ENDS, IS_LOUD } deed;

static rb_status do_it(FILE *out, const void *context, rb_message *why)
{
    struct rlimit core;
    switch (*(const deed *)context) {
    case ANSWERS:
        fputs("an answer", out);
        return getrlimit(RLIMIT_CORE, &core) == 0 && core.rlim_cur == 0 ? RB_OK : RB_EINVAL;
    case REFUSES:
        fputs("half of it", out);
        return rb_fail(why, RB_EFORMAT, "it is bad");
    case CRASHES:
        signal(SIGSEGV, SIG_DFL);
        raise(SIGSEGV);
        return RB_OK;
    case IS_KILLED:
        raise(SIGKILL);
        return RB_OK;
    case ENDS:
        fputs("no ending, of many bytes: 0123456789012345678901234567890123456789", out);
        fflush(out);
        _exit(0);
    case IS_LOUD:
        fputs("something for people", stderr);
        return RB_OK;
    }
    return RB_OK;
}

static rb_status in_child(deed what, char **bytes, size_t *size, rb_message *why)
{
    why->text[0] = '\0';
    return rb_io_in_child("it", do_it, &what, bytes, size, why);
}

TEST(a_child_answers_or_is_located)
{
    static const struct {
        deed what;
        rb_status status;
        const char *words;
    } bad[] = {{REFUSES, RB_EFORMAT, "it is bad"},
               {CRASHES, RB_ENOMEM, "it: HDF5 crashed: out of memory, or a damaged file"},
               {IS_KILLED, RB_ENOMEM, "it: out of memory"},
               {ENDS, RB_ENOMEM, "it: out of memory"}};
    char *bytes;
    size_t size;
    CHECK_OK(in_child(ANSWERS, &bytes, &size, &message));
    assert_int_equal(size, strlen("an answer"));
    assert_memory_equal(bytes, "an answer", size);
    free(bytes);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        CHECK_STATUS(in_child(bad[k].what, &bytes, &size, &message), bad[k].status);
        assert_string_equal(message.text, bad[k].words);
        assert_null(bytes);
    }
}

TEST(a_child_without_means_is_told)
{
    static const struct {
        const char *call;
        int error;
        const char *words;
    } all[] = {{"pipe", EMFILE, "it: out of memory: Too many open files"},
               {"fork", EAGAIN, "it: out of memory"},
               {"fdopen", ENOMEM, "it: out of memory"}};
    SCRATCH char *bytes;
    size_t size;
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const int next = dup(0);
        close(next);
        fail_call(all[k].call, all[k].error, 1);
        CHECK_STATUS(in_child(ANSWERS, &bytes, &size, &message), RB_ENOMEM);
        assert_true(calls_succeed());
        assert_string_equal(message.text, all[k].words);
        assert_null(bytes);
        const int after = dup(0);
        close(after);
        assert_int_equal(after, next); /* no descriptor is left open */
    }
    fail_call("waitpid", EINTR, 1);
    CHECK_OK(in_child(ANSWERS, &bytes, &size, &message));
    assert_true(calls_succeed());
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1); /* nobody is left to wait for */
}

TEST(a_child_is_quiet)
{
    SCRATCH char *bytes;
    size_t size;
    struct stat st;
    const int own = dup(2), file = open(path, O_WRONLY | O_TRUNC);
    dup2(file, 2);
    const rb_status s = in_child(IS_LOUD, &bytes, &size, &message);
    dup2(own, 2);
    close(own);
    close(file);
    CHECK_OK(s);
    assert_int_equal(size, 0);
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_size, 0);
}

RUN_TESTS(make_path, remove_path)
