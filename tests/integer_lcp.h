/* LCPs of small integers, in any units, for comparison with their exact solutions. */
#ifndef ROLLBEM_TESTS_INTEGER_LCP_H
#define ROLLBEM_TESTS_INTEGER_LCP_H

#include "exact.h"
#include "numbers.h"

static unsigned seed;

/* 0 ... n - 1 */
static inline int below(int n)
{
    return (int)((uniform_from(&seed) + 1.0) * 0.5 * n) % n;
}

typedef struct {
    exact_lcp of_integers;
    double M[EXACT_MOST * EXACT_MOST], q[EXACT_MOST], column[EXACT_MOST]; /* z_i = column_i z'_i */
} problem;

static inline void seed_by(unsigned first, int number)
{
    seed = first + 1000003u * (unsigned)number;
    for (int k = 0; k < 4; k++)
        uniform_from(&seed);
}

/* M and q from the integers, with rows and columns in units of up to 2^40 if scaled. */
static inline void put_into_units(int scaled, problem *p)
{
    const exact_lcp *e = &p->of_integers;
    const int n = e->n;
    for (int i = 0; i < n; i++) {
        const double row = scaled ? exp2(below(81) - 40) : 1.0;
        p->column[i] = scaled ? exp2(below(81) - 40) : 1.0;
        p->q[i] = row * e->q[i];
        for (int j = 0; j < n; j++)
            p->M[i + j * n] = row * e->M[i][j];
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            p->M[i + j * n] *= p->column[j];
}

#endif
