/* Control-C and similar signals end a long run; what its finished steps or cases gave is kept. */
#include "program/cli/interrupt.h"

#include "base/base.h"

#include <signal.h>
#include <stddef.h>

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};

enum { SIGNALS = sizeof signals / sizeof signals[0] };

static struct sigaction before[SIGNALS];
static volatile sig_atomic_t interrupted;

static void note_interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

static int is_interrupted(void *context)
{
    (void)context;
    return interrupted;
}

void cli_interrupts_catch(void)
{
    /* the second one ends the program at once */
    const struct sigaction act = {.sa_handler = note_interrupt, .sa_flags = SA_RESETHAND};
    interrupted = 0;
    for (int k = 0; k < SIGNALS; k++) {
        sigaction(signals[k], NULL, &before[k]);
        if (signals[k] != SIGHUP || before[k].sa_handler != SIG_IGN) /* nohup */
            sigaction(signals[k], &act, NULL);
    }
    rb_interrupt_by((rb_interrupt){is_interrupted, NULL});
}

void cli_interrupts_leave(void)
{
    rb_interrupt_by((rb_interrupt){NULL, NULL});
    for (int k = 0; k < SIGNALS; k++)
        sigaction(signals[k], &before[k], NULL);
}

int cli_interrupted(void)
{
    return interrupted;
}
