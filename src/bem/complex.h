/* CMPLX of C11, which clang's library headers may lack: keeps the sign of a zero, on
 * which the side of a branch cut hangs. */
#ifndef ROLLBEM_BEM_COMPLEX_H
#define ROLLBEM_BEM_COMPLEX_H

#include <complex.h>
#include <string.h>

static inline double complex complex_of(double re, double im)
{
    const double parts[2] = {re, im};
    double complex z;
    memcpy(&z, parts, sizeof z);
    return z;
}

#endif
