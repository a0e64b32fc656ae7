/* Control-C and similar signals end a long run after the current case or step. */
#include "program/cli/interrupt.h"

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
}

void cli_interrupts_leave(void)
{
    for (int k = 0; k < SIGNALS; k++)
        sigaction(signals[k], &before[k], NULL);
}

int cli_interrupted(void)
{
    return interrupted;
}
