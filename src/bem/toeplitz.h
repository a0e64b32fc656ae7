/* Toeplitz operators; not installed. */
#ifndef ROLLBEM_BEM_TOEPLITZ_H
#define ROLLBEM_BEM_TOEPLITZ_H

#include "rollbem/bem.h"

/* 1 where all n_c + 1 elements are of one length, to rounding. */
int rb_bem_ends_equal(int n_c, const double *ends);

/* a + b with b mirrored (4.5), into a, where both are Toeplitz operators of one size:
 * returns 1; otherwise 0 and nothing is changed.  Points and w0 are not looked at. */
int rb_bem_toeplitz_add(rb_bem_flexibility *a, const rb_bem_flexibility *b);

#endif
