/* A thin layer on cmocka: comparisons of doubles that print both values and fail on NaN
 * (cmocka 1.1.5 compares as float), allocations that fail on demand, outside data. */
#ifndef ROLLBEM_TESTS_CHECK_H
#define ROLLBEM_TESTS_CHECK_H

#include "rollbem/api.h"
#include "rollbem/bem.h"
#include "rolling/case/case.h"
#include "base/base.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* cmocka hands every test a state, which hardly any of them looks at. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

/* A test: TEST(what_it_claims) { ... }.  They run in the order of the file. */
#define TEST(name) TEST_WITH(NULL, NULL, name)
/* The same with what is done before it and behind it. */
#define TEST_WITH(before, behind, name)                                                            \
    static void name(void **state);                                                                \
    __attribute__((constructor)) static void add_##name(void)                                      \
    {                                                                                              \
        const struct CMUnitTest test = {#name, name, before, behind, NULL};                        \
        add_test_(__LINE__, &test);                                                                \
    }                                                                                              \
    static void name(void **state)
/* At the end of the file: main, with what is done before all of them and behind them.  The program
 * takes the name of a test, or a pattern with * and ?, and then runs that alone. */
#define RUN_TESTS(before, behind)                                                                  \
    int main(int argc, char **argv)                                                                \
    {                                                                                              \
        if (argc > 1)                                                                              \
            cmocka_set_test_filter(argv[1]);                                                       \
        return run_all_tests(before, behind);                                                      \
    }

static struct {
    int count, line[100];
    struct CMUnitTest test[100];
} all_tests_;

/* By lines: the order in which constructors run is the compiler's. */
static inline void add_test_(int line, const struct CMUnitTest *test)
{
    int k = all_tests_.count++;
    if (k == 100)
        abort();
    for (; k > 0 && all_tests_.line[k - 1] > line; k--) {
        all_tests_.line[k] = all_tests_.line[k - 1];
        all_tests_.test[k] = all_tests_.test[k - 1];
    }
    all_tests_.line[k] = line;
    all_tests_.test[k] = *test;
}

/* ROLLBEM_TEST_FILTER: the functions of this name alone, which may have * and ?. */
static inline int run_all_tests(int (*before)(void **), int (*behind)(void **))
{
    if (getenv("ROLLBEM_TEST_FILTER"))
        cmocka_set_test_filter(getenv("ROLLBEM_TEST_FILTER"));
    return _cmocka_run_group_tests("tests", all_tests_.test, (size_t)all_tests_.count, before,
                                   behind);
}

/* OWNED(rb_bem_mesh) mesh: it is freed, by rb_bem_mesh_free, where its block ends. */
#define OWNED(type) __attribute__((cleanup(type##_free))) type
/* SCRATCH double *x: so is what x points to. */
#define SCRATCH __attribute__((cleanup(free_scratch_)))
/* held_case *c: what it points to is freed where the block of c ends; held_api, held_system. */
#define HELD(type) __attribute__((cleanup(type##_release_))) type
#define held_api HELD(rb_api)
#define held_case HELD(rb_case)
#define held_system HELD(rb_bem_system)
#define HELD_TYPE(type, release)                                                                   \
    static inline void type##_release_(type **held)                                                \
    {                                                                                              \
        release(*held);                                                                            \
    }
typedef struct rb_api rb_api;
typedef struct rb_case rb_case;
typedef struct rb_bem_system rb_bem_system;
void rb_api_free(rb_api *a);
void rb_case_free(rb_case *c);
void rb_bem_system_free(rb_bem_system *system);
HELD_TYPE(rb_api, rb_api_free)
HELD_TYPE(rb_case, rb_case_free)
HELD_TYPE(rb_bem_system, rb_bem_system_free)

static inline void free_scratch_(void *address)
{
    void *memory;
    memcpy(&memory, address, sizeof memory);
    free(memory);
}

/* The pointer, which must not be NULL. */
#define NOT_NULL(pointer) ((__typeof__(pointer))not_null_((pointer), #pointer, __FILE__, __LINE__))

static inline void *not_null_(const void *pointer, const char *text, const char *file, int line)
{
    if (!pointer) {
        print_error("%s is NULL\n", text);
        _fail(file, line);
    }
    return (void *)pointer;
}

/* |got - want| <= tol; the rest is a printf format naming the case. */
#define CHECK_ABS(got, want, tol, ...) check_close_(got, want, tol, __FILE__, __LINE__, __VA_ARGS__)
/* |got - want| <= tol |want| */
#define CHECK_REL(got, want, tol, ...)                                                             \
    check_close_(got, want, (tol)*fabs(want), __FILE__, __LINE__, __VA_ARGS__)
/* A number as a page prints it, with two digits. */
#define CHECK_TWO_DIGITS(got, want, ...)                                                           \
    CHECK_ABS(got, want, 0.06 * pow(10.0, floor(log10(fabs(want)))), __VA_ARGS__)
/* got <= bound */
#define CHECK_MAX(got, bound, ...) check_max_(got, bound, __FILE__, __LINE__, __VA_ARGS__)
/* The status of a call, before which `message` is empty. */
#define CHECK_STATUS(call, want)                                                                   \
    check_status_((strchr(#call, '(') ? message.text[0] = '\0' : 0, (int)(call)), want, #call,     \
                  __FILE__, __LINE__)
#define CHECK_OK(call) CHECK_STATUS(call, RB_OK)
/* The same, and what f(..., &message) said has these words. */
#define CHECK_SAYS(call, want, words)                                                              \
    do {                                                                                           \
        CHECK_STATUS(call, want);                                                                  \
        check_said_(words, __FILE__, __LINE__);                                                    \
    } while (0)

/* For what a call has to say: f(..., &message). */
static rb_message message __attribute__((unused));

static inline void check_status_(int got, int want, const char *call, const char *file, int line)
{
    if (got == want)
        return;
    print_error("%s: status %d, want %d: %s\n", call, got, want, message.text);
    _fail(file, line);
}

static inline void check_said_(const char *words, const char *file, int line)
{
    if (strstr(message.text, words))
        return;
    print_error("'%s' does not say '%s'\n", message.text, words);
    _fail(file, line);
}

static inline void check_fail_(const char *file, int line, const char *format, va_list args)
{
    char text[400];
    vsnprintf(text, sizeof text, format, args);
    print_error("%s\n", text);
    _fail(file, line);
}

static inline void check_close_(double got, double want, double tol, const char *file, int line,
                                const char *format, ...)
{
    if (fabs(got - want) <= tol)
        return;
    va_list args;
    va_start(args, format);
    print_error("got %.17g, want %.17g, difference %.3g > %.3g: ", got, want, fabs(got - want),
                tol);
    check_fail_(file, line, format, args);
    va_end(args);
}

static inline void check_max_(double got, double bound, const char *file, int line,
                              const char *format, ...)
{
    if (got <= bound)
        return;
    va_list args;
    va_start(args, format);
    print_error("got %.6g, allowed %.6g: ", got, bound);
    check_fail_(file, line, format, args);
    va_end(args);
}

/* What error bars held and how wide they were. */
typedef struct {
    double wide; /* bars beyond so many times the error are too wide; 0: ten */
    int held, all, narrow;
} tally;

static inline void tally_count(tally *t, double error, double bar)
{
    if (fabs(error) < 1e-10) /* met exactly: nothing to hold */
        return;
    t->all++;
    t->held += fabs(error) <= bar;
    t->narrow += bar <= (t->wide > 0.0 ? t->wide : 10.0) * fabs(error);
}

/* 95 of 100 hold the error, half of them are not too wide. */
static inline void tally_check(const tally *t, const char *of)
{
    CHECK_MAX(1.0 - (double)t->held / t->all, 0.05, "%s: held %d of %d", of, t->held, t->all);
    CHECK_MAX(0.5, (double)t->narrow / t->all, "%s: too wide in the median", of);
}

/* The next allocations of the library succeed `count` times, then every one fails until
 * alloc_succeed().  alloc_failed() tells whether one was refused. */
void alloc_fail_after(int count);
void alloc_succeed(void);
int alloc_failed(void);

/* The call where its k-th allocation and all after it fail: it says that there is no memory,
 * or needs no more than k and ends well.  Whether one was refused. */
#define REFUSED_FROM(k, ...)                                                                       \
    (alloc_fail_after(k),                                                                          \
     check_refused_from_(k, (int)(__VA_ARGS__), #__VA_ARGS__, __FILE__, __LINE__))

static inline int check_refused_from_(int k, int got, const char *call, const char *file, int line)
{
    const int refused = alloc_failed();
    alloc_succeed();
    if (got != (refused ? RB_ENOMEM : RB_OK)) {
        print_error("%s: status %d, allocations from %d on %s\n", call, got, k,
                    refused ? "failed" : "were not needed");
        _fail(file, line);
    }
    return refused;
}

/* Does the work again and again; in the k-th run the k-th allocation fails and those
 * after it succeed, until there is none left.  The work returns RB_ENOMEM, or RB_OK where
 * it does without.  How many allocations there were. */
int alloc_fail_each(rb_status (*work)(void *context), void *context);

/* Does the work again and again; in each run the first allocation fails that is reached
 * through a call which none has failed behind before, until there is none.  The work
 * returns as above.  How many runs had a failure. */
int alloc_fail_every_call(rb_status (*work)(void *context), void *context);

/* Path of `name` below the folder ROLLBEM_DATA; skips the test when it is not set.
 * Static storage. */
static inline const char *outside_data(const char *name)
{
    static char path[1024];
    const char *root = getenv("ROLLBEM_DATA");
    if (!root || !*root)
        skip();
    snprintf(path, sizeof path, "%s/%s", root, name);
    return path;
}

/* A test that is too long for every run takes its items in turn: 1 where item k belongs to this
 * run, one of `parts`.  The turn is ROLLBEM_TEST_TURN (tests/run takes the day of the year and
 * prints it), 0 where it is not set.  ROLLBEM_TEST_TURNS runs so many turns at once, from that one
 * on; ROLLBEM_TEST_ALL runs all. */
static inline int is_in_turn(int k, int parts)
{
    const char *turn = getenv("ROLLBEM_TEST_TURN"), *turns = getenv("ROLLBEM_TEST_TURNS");
    const int waits = parts - 1 - (k + (turn ? atoi(turn) : 0) + parts - 1) % parts;
    return getenv("ROLLBEM_TEST_ALL") || waits < (turns ? atoi(turns) : 1);
}

/* At the beginning of a test that is one of several of a kind, the k-th: it is skipped unless it is
 * its turn. */
#define IN_TURN(k, parts)                                                                          \
    do {                                                                                           \
        if (!is_in_turn(k, parts))                                                                 \
            skip();                                                                                \
    } while (0)

/* 1 under the address sanitizer, which reserves terabytes and replaces malloc. */
#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

#endif
