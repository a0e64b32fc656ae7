/* A layer on a rigid or elastic base; not installed. */
#ifndef ROLLBEM_BEM_LAYER_H
#define ROLLBEM_BEM_LAYER_H

#include "rollbem/bem.h"

#include <complex.h>

/* What a layer and its bond do to a unit wave of pressure [0] and of f' = 1 on the
 * surface [1] (L2): the half-plane's functions of eta = k y, (1 + eta) exp(-eta) and eta
 * exp(-eta), plus c eta sinh eta + d (eta cosh eta - sinh eta). */
typedef struct {
    double complex c[2], d[2];
} rb_bem_layer_wave;

/* At al = wave number times thickness > 0. */
void rb_bem_layer_wave_at(const rb_bem_surface *body, double al, rb_bem_layer_wave *wave);

/* The smooth remainder of a layer over a half-plane of its material (L3): displacements
 * of `points` abscissae x under n strips between ends (n + 1), added to W, 2 points x 2n
 * column-major as in rb_bem_surface_displacement.  RB_ENOMEM. */
rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points,
                                     const double *x, int n, const double *ends,
                                     double *W);

/* Adds that part of w_N under given tractions to w, without a matrix.  RB_ENOMEM. */
rb_status rb_bem_layer_add_normal(const rb_bem_surface *body,
                                  const rb_bem_edge_load *load, int points,
                                  const double *x, double *w);

#endif
