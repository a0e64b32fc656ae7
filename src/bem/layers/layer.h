/* A layer on a rigid or elastic base; not installed. */
#ifndef ROLLBEM_BEM_LAYERS_LAYER_H
#define ROLLBEM_BEM_LAYERS_LAYER_H

#include "bem/bem.h"

#include <complex.h>

/* ---- Waves ------------------------------------------------------------------------- */

/* What a layer and its bond do to a unit wave of pressure [0] and of f' = 1 on the
 * surface [1] (L2): the half-plane's functions of eta = k y, (1 + eta) exp(-eta) and eta
 * exp(-eta), plus c eta sinh eta + d (eta cosh eta - sinh eta). */
typedef struct {
    double complex c[2], d[2];
} rb_bem_layer_wave;

/* At al = wave number times thickness, its real part > 0. */
void rb_bem_layer_wave_at(const rb_bem_surface *body, double complex al, rb_bem_layer_wave *wave);

/* What the layer has over the half-plane (L3): Z = c L - c (1, 1, beta) of pressure,
 * friction and coupling; of friction on a smooth base without the membrane, whose kernel is
 * rb_bem_layer_membrane (L9). */
void rb_bem_layer_remainder_at(const rb_bem_surface *body, double complex al, double complex Z[3]);

double rb_bem_layer_membrane(const rb_bem_surface *body, double X);

/* Its limit for al -> 0, which is real. */
void rb_bem_layer_longest_waves(const rb_bem_surface *body, double Z[3]);

/* The base's compliance over the layer's glassy one, to which L.N and L.T tend for long
 * waves; 0 for a rigid base. */
double rb_bem_layer_base_compliance(const rb_bem_surface *body);

/* ---- Its kernel, tabulated --------------------------------------------------------- */

/* The integral of (L3) over all waves as a function of X = (x - s)/d, for |X| up to a
 * reach: pressure, friction and, of both, the coupling. */
typedef struct rb_bem_layer_table rb_bem_layer_table;

/* One table serves all bodies of the same ratios, and all threads: the last ones are
 * kept.  Give it back when done.  NULL: out of memory. */
const rb_bem_layer_table *rb_bem_layer_table_of(const rb_bem_surface *body, double reach);
void rb_bem_layer_table_release(const rb_bem_layer_table *table);

/* Means over a strip of half-length b > 0 whose middle lies X from the point, both over
 * d; [2] is the coupling. */
typedef struct {
    double of[4]; /* the last one: of no meaning */
} rb_bem_layer_kernel;
rb_bem_layer_kernel rb_bem_layer_mean(const rb_bem_layer_table *table, double X, double b);
/* The integral from 0 to X. */
rb_bem_layer_kernel rb_bem_layer_integral(const rb_bem_layer_table *table, double X);

/* ---- Displacements ----------------------------------------------------------------- */

/* The smooth remainder of a layer over a half-plane of its material (L3), of points and strips that
 * are `reach` apart at most: scale h (mean of the kernel + everywhere).  RB_ENOMEM.  Give its table
 * back when done. */
typedef struct {
    const rb_bem_layer_table *table;
    double scale;         /* (1 - nu)/(pi shear) */
    double everywhere[2]; /* by the datum of an elastic base: of pressure, of friction */
    double d;
} rb_bem_layer_remainder;
rb_status rb_bem_layer_remainder_of(const rb_bem_surface *body, double reach,
                                    rb_bem_layer_remainder *k);
/* What a load of 1 from 0 to x displaces at 0, with the sign of x. */
rb_bem_layer_kernel rb_bem_layer_primitive(const rb_bem_layer_remainder *k, double x);

/* The smooth remainder of a layer over a half-plane of its material (L3): displacements
 * of `points` abscissae x under n strips between ends (n + 1), added to W, 2 points x 2n
 * column-major as in rb_bem_surface_displacement.  RB_ENOMEM. */
rb_status rb_bem_layer_add_remainder(const rb_bem_surface *body, int points, const double *x, int n,
                                     const double *ends, double *W);

/* Adds that part of w_N under given tractions to w, without a matrix.  RB_ENOMEM. */
rb_status rb_bem_layer_add_normal(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                  int points, const double *x, double *w);

/* ---- Stress ------------------------------------------------------------------------ */

/* Transforms int t(x) exp(-ikx) dx of tractions that are linear between nodes. */
void rb_bem_edge_load_wave(const rb_bem_edge_load *load, double k, double complex *p,
                           double complex *q);

#endif
