/* Steps that may be interrupted: what each thread was told to ask. */
#include "base/base.h"

static _Thread_local rb_interrupt present;

rb_interrupt rb_interrupt_by(rb_interrupt next)
{
    const rb_interrupt before = present;
    present = next;
    return before;
}

int rb_interrupted(void)
{
    return present.asked && present.asked(present.context);
}

int rb_interrupted_in_loop(int *stop)
{
    int stopped;

    if (rb_interrupted()) {
#pragma omp atomic write
        *stop = 1;
    }
#pragma omp atomic read
    stopped = *stop;
    return stopped;
}
