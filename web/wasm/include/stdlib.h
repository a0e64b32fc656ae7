/* The library's own, and what it leaves out where paths do not exist (absent.c). */
#include_next <stdlib.h>
#ifndef ROLLBEM_WASM_STDLIB_H
#define ROLLBEM_WASM_STDLIB_H

char *realpath(const char *restrict path, char *restrict to);

#endif
