/* The target named in FUZZ_TARGET for libFuzzer. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static fuzz_run *run;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    const char *name = getenv("FUZZ_TARGET");
    (void)argc;
    (void)argv;
    for (const fuzz_target *t = fuzz_targets; t->run; t++)
        if (name && strcmp(name, t->name) == 0)
            run = t->run;
    if (!run) {
        fprintf(stderr, "FUZZ_TARGET: no such target\n");
        exit(64);
    }
    if (fuzz_begin() != 0)
        exit(73);
    atexit(fuzz_end);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    run(data, size);
    return 0;
}
