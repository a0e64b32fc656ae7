/* The combined smoothing and regularisation method of Hayashi, Yamashita and Fukushima
 * (SIAM J. Optim. 15, 2005), free of what it is applied to. */
#ifndef ROLLBEM_FRICTION_SMOOTHING_H
#define ROLLBEM_FRICTION_SMOOTHING_H

#include "lcp/friction/internal.h"

/* x in L^n (n = 1: half-line).  P: smoothed projection with parameter mu (0: the
 * projection), D: n x n its derivative or NULL.  Returns the smallest non-zero
 * |spectral value| of x, INFINITY if there is none. */
double rb_friction_smoothed(int n, double mu, const double *x, double *P, double *D);

typedef struct {
    int n; /* of the unknown z and of H */
    void *context;
    /* H_{mu,eps}(z), n entries; gap (NULL: not wanted): smallest non-zero |spectral
     * value| of x - y. */
    void (*residual)(void *context, double mu, double eps, const double *z, double *H, double *gap);
    /* dz with H + H'(z) dz = 0 */
    rb_status (*step)(void *context, double mu, double eps, const double *z, const double *H,
                      double *dz);
    /* 1: z solves the problem */
    int (*accepts)(void *context, const double *z);
    int (*late)(void *context);
} rb_friction_smooth_problem;

/* z: start on entry.  iters: grows by the Newton steps.  RB_MAXITER, RB_SINGULAR,
 * RB_INTERRUPTED: z is the last iterate. */
rb_status rb_friction_smooth(const rb_friction_smooth_problem *problem, int limit, double *z,
                             int *iters);

#endif
