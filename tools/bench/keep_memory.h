/* Memory that malloc gives back to the system and gets again costs small meshes up to four times
 * their solution, or nothing, as the heap of the process happens to lie: it keeps all, as the
 * program has it do (src/program/cli/main.c). */
#ifndef ROLLBEM_KEEP_MEMORY_H
#define ROLLBEM_KEEP_MEMORY_H

#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 25);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_TOP_PAD, 1 << 26);
#endif
}

#endif
