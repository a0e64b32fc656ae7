/* Calls: what each leaves, its threads of BLAS, and how another thread stops it. */
#include "program/api/internal.h"

#include "base/units.h"

#include <gsl/gsl_errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void rb_api_name_option(rb_message *why)
{
    const rb_message said = *why;

    if (said.about[0])
        rb_fail(why, RB_EINVAL, "--%s", said.text);
}

int rb_api_ended(rb_api *a, rb_status s)
{
    a->status = s;
    if (s == RB_EINVAL)
        rb_api_name_option(&a->why);
    if (s == RB_OK || !a->why.text[0])
        snprintf(a->why.text, sizeof a->why.text, "%s", s == RB_OK ? "" : rb_status_text(s));
    /* also of what no option is to blame for, which rb_case_locate has not seen */
    if (s != RB_OK && a->words)
        rb_unit_translate(rb_case_units(a->words, RB_GIVEN_ARGUMENT), a->why.text,
                          sizeof a->why.text);
    return s;
}

int rb_api_refuse(rb_api *a, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    a->why.about[0] = '\0';
    vsnprintf(a->why.text, sizeof a->why.text, format, args);
    va_end(args);
    return rb_api_ended(a, RB_EINVAL);
}

/* Threads of BLAS cost small problems more than they bring, as in the program; whoever
 * else uses BLAS in this process has his own again when the last call is over. */
static _Atomic int calls;
static int threads_outside;

static int is_stopped(void *context)
{
    rb_api *a = context;
    const rb_interrupt *outside = &a->outside;
    a->interrupted =
        a->interrupted || a->stopped || (outside->asked && outside->asked(outside->context));
    return a->interrupted;
}

void rb_api_call_begins(rb_api *a)
{
    if (calls++ == 0)
        threads_outside = getenv("OPENBLAS_NUM_THREADS") ? 0 : rb_blas_threads(1);
    a->outside = rb_interrupt_by((rb_interrupt){is_stopped, a});
}

/* Whatever made of a step that was stopped, or went on without it. */
rb_status rb_api_call_ends(rb_api *a, rb_status s)
{
    rb_interrupt_by(a->outside);
    if (--calls == 0)
        rb_blas_threads(threads_outside); /* 0: as the variable says */
    return !a->interrupted || s == RB_INTERRUPTED ? s
                                                  : rb_fail(&a->why, RB_INTERRUPTED, "interrupted");
}

void rb_api_forget_call(rb_api *a)
{
    a->why.text[0] = '\0';
    a->stopped = 0;
    a->interrupted = 0;
    a->done = 0;
    a->total = 0;
}

void rb_api_stop(rb_api *a)
{
    a->stopped = 1;
}

void rb_api_stop_until(rb_api *a, const volatile int *over)
{
    const struct timespec little = {0, 1000000};

    while (!__atomic_load_n(over, __ATOMIC_ACQUIRE)) {
        rb_api_stop(a);
        nanosleep(&little, NULL);
    }
}

void rb_api_progress(const rb_api *a, int *done, int *total)
{
    *done = a->done;
    *total = a->total;
}

int rb_api_status(const rb_api *a)
{
    return a->status;
}

const char *rb_api_message(const rb_api *a)
{
    return a->why.text;
}
