/* What flat bodies share: checks, and the kernel of a strip with and without memory (V2); not
 * installed. */
#ifndef ROLLBEM_BEM_SURFACE_H
#define ROLLBEM_BEM_SURFACE_H

#include "bem/bem.h"

/* Points at y >= 0 under a load whose xs abscissae increase. */
int rb_bem_edge_load_is_valid(const rb_bem_edge_load *load, int xs, rb_bem_points points);

/* RB_EINVAL: material, datum, terms or thickness out of range. */
rb_status rb_bem_surface_check(const rb_bem_surface *body, rb_message *why);

/* What the memory of a body adds to the element integrals of the half-plane (V2), for a
 * strip of half-length b whose middle lies at distance x upstream (+x) of it:
 *   log = sum f_k (E_k - 1) int ln|x - s| ds,  sign = sum f_k (E_k - 1) int sgn(x - s) ds
 * with (E u)(x) = (1/L) int_0^inf exp(-r/L) u(x + r) dr. */
void rb_bem_memory_integrals(const rb_bem_surface *body, double x, double b, double *log,
                             double *sign);

/* Displacement at a point under a strip of half-length b whose middle lies X upstream of
 * it: w_N = -K int p ln|(x-s)/d| + c int q sgn(x-s),  K = 2(1-nu^2)/(pi E) = (1-nu)/(pi
 * G) w_T = -K int q ln|(x-s)/d| - c int p sgn(x-s),  c = (1-2nu)(1+nu)/(2E) =
 * (1-2nu)/(4G) both times what the memory makes of the integrals (V2).  A layer's
 * logarithm is that of the distance over its thickness (L3). */
typedef struct {
    const rb_bem_surface *body;
    double K, c, depth, slow; /* slow: 1 + sum f_k */
    double raised;            /* what the memory of the datum adds to w per force p or q */
    double sheared;           /* what the tangential datum adds to w_T per force q */
} rb_bem_strip_kernel;
rb_bem_strip_kernel rb_bem_strip_kernel_of(const rb_bem_surface *body);

#endif
