/* Frictional contact problems on second-order cones, in two and three dimensions.
 * References: *Acary* (2017) and *Kanno*, docs/theory.md. */
#ifndef ROLLBEM_FRICTION_H
#define ROLLBEM_FRICTION_H

#include "rollbem/base.h"
#include "rollbem/sparse.h"

/* Per contact [N, T] (d = 2) or [N, T1, T2] (d = 3), N first: m = d n_c.
 * uhat = u + mu ||u_T|| e_N;  K* contains uhat, complementary to r in the cone
 * K = {||r_T|| <= mu r_N}.
 * Global form: K v = H r + f, u = H' v + w; K symmetric, may be singular.
 * Local form: u = W r + q, W dense or sparse. */
typedef enum {
    RB_FRICTION_LOCAL_DENSE,
    RB_FRICTION_LOCAL_SPARSE,
    RB_FRICTION_GLOBAL
} rb_friction_form;

typedef struct {
    rb_friction_form form;
    int dimension; /* d: 2 or 3 */
    int contacts;  /* n_c */
    double *mu;    /* n_c, >= 0; owned, as all arrays here */
    double *W;     /* LOCAL_DENSE: m x m column-major */
    rb_sparse Ws;  /* LOCAL_SPARSE: m x m */
    double *q;     /* local: m */
    int dofs;      /* GLOBAL: n */
    rb_sparse K;   /* n x n, both triangles */
    rb_sparse H;   /* n x m */
    double *f;     /* n */
    double *w;     /* m */
} rb_friction_problem;

void rb_friction_problem_free(rb_friction_problem *problem);

#endif
