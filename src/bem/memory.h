/* Fading memory of a viscoelastic half-plane in steady rolling; not installed. */
#ifndef ROLLBEM_BEM_MEMORY_H
#define ROLLBEM_BEM_MEMORY_H

#include "rollbem/bem.h"

/* What the memory of a body adds to the element integrals of the half-plane (V2), for a
 * strip of half-length b whose middle lies at distance x upstream (+x) of it:
 *   log = sum f_k (E_k - 1) int ln|x - s| ds,  sign = sum f_k (E_k - 1) int sgn(x - s) ds
 * with (E u)(x) = (1/L) int_0^inf exp(-r/L) u(x + r) dr. */
void rb_bem_memory_integrals(const rb_bem_surface *body, double x, double b, double *log,
                             double *sign);

#endif
