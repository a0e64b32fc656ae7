/* The name of the computation that runs, for progress displays. */
#include "base/base.h"

#include <stdatomic.h>

static const char *_Atomic phase;

void rb_phase(const char *what)
{
    atomic_store(&phase, what);
}

const char *rb_phase_now(void)
{
    return atomic_load(&phase);
}
