/* Rings in waves around the circumference, and their sum as a table (B12). */
#ifndef ROLLBEM_BEM_LAYERS_RING_H
#define ROLLBEM_BEM_LAYERS_RING_H

#include "bem/bem.h"

#include <complex.h>

/* The product of wave number and thickness ln(R/r) from which on an inner contour is out
 * of reach: its trace falls like exp(-2 x). */
#define RB_RING_REACH 20.0

/* u_r = U cos m theta, u_theta = V sin m theta, and stresses S and T of an arc alike:
 * (U, V) = K (S, T)/(2 G). */
typedef struct {
    double complex uu, uv, vu, vv;
} rb_ring_compliance;

/* dy/d ln r = M y of y = (2 G U, 2 G V, r S, r T); and E = exp(M step), for steps over which it
 * changes by some powers of ten at most. */
void rb_ring_equations(double m, double nu, double M[4][4]);
void rb_ring_transfer(double m, double nu, double step, double E[4][4]);

/* The disc without a hole, m > 1; kappa = 3 - 4 nu. */
rb_ring_compliance rb_ring_of_disc(double m, double kappa);
/* From the inner contour of a ring, with compliance K, to its outer one. */
rb_ring_compliance rb_ring_across(double m, double nu, double inner, double outer,
                                  rb_ring_compliance K);

/* A wheel without memory, at its outer contour. */
rb_ring_compliance rb_ring_of_wheel(const rb_bem_wheel *wheel, double m);

/* Primitive over x of the disc's answer to a unit load at angle 0, its waves m >= 2, over
 * R/(4 pi G): N = T is the real part, C below the imaginary one. */
double complex rb_ring_disc_primitive(double kappa, double x);

/* What a unit load at angle 0 does at angle x, over R/(4 pi G): normal, tangential, and
 * normal by friction, which is minus the tangential one by pressure. */
typedef struct {
    double N, T, C;
} rb_ring_answer;

/* Coefficients of wave m, a whole number or any from `rb_ring_smooth_from` on, between
 * which they are smooth:
 * N = Re sum c[0] exp(imx), T = Re sum c[1] exp(imx), C = Im sum c[2] exp(imx). */
typedef void rb_ring_waves(const rb_bem_wheel *wheel, double m, double complex c[3]);
enum { rb_ring_smooth_from = 512 };

/* A primitive over x of an answer that is not summed, analytic on either side of 0; N and T
 * are odd, C is even. */
typedef rb_ring_answer rb_ring_primitive(const rb_bem_wheel *wheel, double x);

/* The primitive over x of the sum of waves m <= last, and of `rest` (NULL: nothing), for
 * abs(x) <= reach. */
typedef struct {
    double smallest;   /* from there on panels grow with abs(x); rest is not resolved below */
    int panels;        /* on either side of 0 */
    int sides;         /* 1: N and T are odd, C is even, and x > 0 stands for both */
    double *chebyshev; /* owned */
} rb_ring_table;

/* RB_ENOMEM; free in any case. */
rb_status rb_ring_table_create(const rb_bem_wheel *wheel, rb_ring_waves *waves, int last,
                               rb_ring_primitive *rest, double smallest, double reach,
                               rb_ring_table *table);
void rb_ring_table_free(rb_ring_table *table);
rb_ring_answer rb_ring_table_at(const rb_ring_table *table, double x);

#endif
