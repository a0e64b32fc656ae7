/* malloc, calloc and realloc of the library under test, failing on demand.  Linked with
 * --wrap, so that no product code knows of it. */
#define _GNU_SOURCE
#include "fault_calls.h"

#include "check.h"

#include <errno.h>

static int remaining = -1; /* < 0: never fail */
static int refused, by_calls, once;

void alloc_fail_after(int count)
{
    remaining = count;
    refused = 0;
}

void alloc_succeed(void)
{
    remaining = -1;
    by_calls = once = 0;
}

int alloc_failed(void)
{
    return refused;
}

static void check_work(int n, rb_status s)
{
    if (s != RB_ENOMEM && s != RB_OK)
        print_error("failure %d of memory: status %d\n", n, s);
    assert_true(s == RB_ENOMEM || s == RB_OK);
}

int alloc_fail_each(rb_status (*work)(void *context), void *context)
{
    for (int n = 0;; n++) {
        alloc_fail_after(n);
        once = 1;
        const rb_status s = work(context);
        alloc_succeed();
        if (!refused) {
            assert_int_equal(s, RB_OK);
            return n;
        }
        check_work(n, s);
    }
}

int alloc_fail_every_call(rb_status (*work)(void *context), void *context)
{
    static uintptr_t room[CALLS], walked[STACKS];
    calls = room;
    stacks = walked;
    find_program();
    for (int n = 0;; n++) {
        refused = 0;
        by_calls = 1;
        const rb_status s = work(context);
        by_calls = 0;
        if (!refused) {
            assert_int_equal(s, RB_OK);
            return n;
        }
        check_work(n, s);
    }
}

static int refuses(const void *caller, const void *frame)
{
    if (by_calls)
        return !refused && has_new_call(caller, frame);
    if (once && refused)
        return 0;
    if (remaining > 0)
        remaining--;
    else
        return remaining == 0;
    return 0;
}

static int allowed(const void *caller, const void *frame)
{
    if (!refuses(caller, frame))
        return 1;
    refused = 1;
    errno = ENOMEM;
    return 0;
}

#define ALLOWED allowed(__builtin_return_address(0), __builtin_frame_address(0))

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
    return ALLOWED ? __real_malloc(size) : NULL;
}

void *__wrap_calloc(size_t n, size_t size)
{
    return ALLOWED ? __real_calloc(n, size) : NULL;
}

void *__wrap_realloc(void *p, size_t size)
{
    return ALLOWED ? __real_realloc(p, size) : NULL;
}

void *__wrap_aligned_alloc(size_t alignment, size_t size)
{
    return ALLOWED ? __real_aligned_alloc(alignment, size) : NULL;
}
