/* A timer's signal writes the line, because what is waited for is one call of BLAS as
 * often as not: by functions that a signal handler may call. */
#include "program/cli/wait.h"

#include "base/base.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { FIRST = 2, PROCESSOR = 20 };

static struct {
    int terminal;
    volatile sig_atomic_t shown, rests; /* rests: ticks until the line comes back */
    time_t start;
    long next; /* second of the processor that is told next */
    struct sigaction before;
} line;

static time_t seconds_of(clockid_t clock)
{
    struct timespec now = {0, 0};
    clock_gettime(clock, &now);
    return now.tv_sec;
}

/* Behind the text, which ends with a zero and has room for 240 characters. */
static void append(char *text, const char *more)
{
    size_t at = strlen(text);
    while (*more && at < 239)
        text[at++] = *more++;
    text[at] = '\0';
}

static void add_number(char *text, long number)
{
    const char digit[2] = {(char)('0' + number % 10), '\0'};
    if (number >= 10)
        add_number(text, number / 10);
    append(text, digit);
}

static void tick(int signal_number)
{
    const int kept = errno;
    const char *phase = rb_phase_now();
    const long seconds = line.terminal ? (long)(seconds_of(CLOCK_MONOTONIC) - line.start)
                                       : (long)seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    char text[240] = "";

    (void)signal_number;
    if (line.rests > 0)
        line.rests--;
    if (line.terminal ? line.rests > 0 : seconds < line.next)
        return;
    while (line.next <= seconds)
        line.next *= 2;
    append(text, line.terminal ? "\r\033[K" : "rollbem: ");
    add_number(text, seconds);
    append(text, line.terminal ? " s" : " s of the processor so far");
    append(text, phase ? ": " : "");
    append(text, phase ? phase : "");
    append(text, line.terminal ? "\r" : "\n"); /* who writes next writes over it */
    line.shown = write(STDERR_FILENO, text, strlen(text)) > 0;
    errno = kept;
}

void cli_wait_begin(void)
{
    const struct sigaction act = {.sa_handler = tick, .sa_flags = SA_RESTART};
    const struct itimerval every = {{1, 0}, {FIRST, 0}};

    line.terminal = isatty(STDERR_FILENO);
    line.shown = line.rests = 0;
    line.start = seconds_of(CLOCK_MONOTONIC);
    line.next = PROCESSOR;
    sigaction(SIGALRM, &act, &line.before);
    setitimer(ITIMER_REAL, &every, NULL);
}

void cli_wait_rest(void)
{
    line.rests = FIRST;
    line.shown = 0;
}

void cli_wait_end(void)
{
    static const struct itimerval never;
    static const char clear[] = "\r\033[K";

    setitimer(ITIMER_REAL, &never, NULL);
    sigaction(SIGALRM, &line.before, NULL);
    if (line.terminal && line.shown && write(STDERR_FILENO, clear, strlen(clear)) < 0)
        line.shown = 0;
}
