/* Large matrices that are written whole before they are read. */
#ifndef ROLLBEM_BEM_LARGE_H
#define ROLLBEM_BEM_LARGE_H

#include <stddef.h>

/* rows x cols doubles, not set, from the start of a cache line; in huge pages where the
 * system has them, because touching small pages for the first time costs many times the
 * writing.  Released with free(). */
double *rb_large_alloc(size_t rows, size_t cols);

#endif
