/* A file of its own for a test or a group of tests, made before and removed behind. */
#ifndef SCRATCH_H
#define SCRATCH_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char path[40];

/* For cmocka, before and behind a test or a group. */
static inline int make_path(void **state)
{
    snprintf(path, sizeof path, "/tmp/rollbem-test-XXXXXX");
    const int fd = mkstemp(path);
    return fd < 0 || close(fd) != 0;
}

static inline int remove_path(void **state)
{
    return remove(path);
}

#endif
