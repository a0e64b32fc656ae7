/* Numbers that look random and are the same everywhere. */
#ifndef ROLLBEM_TESTS_NUMBERS_H
#define ROLLBEM_TESTS_NUMBERS_H

#include <stdlib.h>

/* Between -1 and 1, from a seed of the caller. */
static inline double uniform_of(unsigned long long *seed)
{
    *seed = *seed * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*seed >> 11) / 4503599627370496.0 - 1.0;
}

/* The same by a shorter generator. */
static inline double uniform_from(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (double)(*seed >> 8) / (1u << 24) * 2.0 - 1.0;
}

/* Between two numbers, by the C library's generator. */
static inline double between(double low, double high)
{
    return low + (high - low) * (rand() / (double)RAND_MAX);
}

#endif
