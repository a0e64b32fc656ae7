/* What every GMRES (Saad and Schultz 1986) has in common: one cycle, between products that its
 * caller makes.  Not installed. */
#ifndef ROLLBEM_BASE_GMRES_H
#define ROLLBEM_BASE_GMRES_H

#include <stddef.h>

/* A basis of the space that b, A b, A A b, ... span, and in it the x that leaves least of b - A x.
 */
typedef struct {
    int n, used; /* unknowns; vectors of the basis that were multiplied, 0 at first */
    int most;    /* of them, borrowed with their memory: */
    double **v;  /* most + 1 vectors of n, those up to used + 1 need to be there */
    double
        *small; /* RB_GMRES_SMALL(most) doubles: rotated Hessenberg matrix, rotations, right side */
} rb_gmres;

#define RB_GMRES_SMALL(most) ((size_t)(most) * (size_t)((most) + 3) + (size_t)((most) + 1))

/* v[0]: b on entry, of length one on return.  Returns the length of b; 0: x is 0. */
double rb_gmres_begin(rb_gmres *g);
/* v[used + 1]: A v[used] on entry, orthogonal to the vectors before on return, when `used` has
 * grown by one.  Returns the length of what the best x of this space leaves of b; 0 also where the
 * space is exhausted. */
double rb_gmres_step(rb_gmres *g);
/* x, n, a vector of none of the first `used`: the best one. */
void rb_gmres_combine(rb_gmres *g, double *x);

#endif
