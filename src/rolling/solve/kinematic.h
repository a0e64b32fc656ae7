/* The kinematic operator A (theory.md 4.2), and the contact operator with it by products. */
#ifndef ROLLBEM_ROLLING_SOLVE_KINEMATIC_H
#define ROLLBEM_ROLLING_SOLVE_KINEMATIC_H

#include "rolling/case/inputs.h"

/* (A w)_i = sum over k of stencil_k w_{i-1+k}, w the tangential displacement of the n
 * elements and of one downstream and two upstream of them. */
typedef struct {
    int n, differences; /* 0: A = I */
    double stencil[4];
    double local[4]; /* the stencil on what the interlayer adds to w */
    double *outside; /* 2 x 2n: displacement one element downstream and two upstream; NULL
                        where A does not ask for it; owned */
} rb_rolling_kinematic;

/* Row i of A w for the displacement w of the n elements and the one upstream; outside: of
 * one element downstream and the second one upstream. */
static inline double rb_rolling_kinematic_row(const rb_rolling_kinematic *A, const double *w,
                                              const double outside[2], int i)
{
    const double *a = A->stencil;
    if (!A->outside)
        return A->differences ? w[i] - w[i + 1] : w[i];
    const double before = i > 0 ? w[i - 1] : outside[0],
                 second = i + 1 < A->n ? w[i + 2] : outside[1];
    return a[0] * before + a[1] * w[i] + a[2] * w[i + 1] + a[3] * second;
}

/* ---- transform_operator.c ------------------------------------------------------- */

/* Products of F and A by Fourier transforms; f: its arrays are borrowed; A: taken over, also on
 * failure.  compliance: of the interlayer.  RB_ENOMEM. */
rb_status rb_rolling_transform_operator(const rb_bem_flexibility *f, double compliance,
                                        rb_rolling_kinematic *A, rb_contact_operator **op);

#endif
