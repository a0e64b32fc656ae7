/* A stack of bonded layers on a rigid or elastic base (L6, L7); not installed. */
#ifndef ROLLBEM_BEM_LAYERS_STACK_H
#define ROLLBEM_BEM_LAYERS_STACK_H

#include "bem/bem.h"

/* Waves exp(ikx) with y into the body: u_x = i U, u_y = W, both times k, s_xy = i X, s_yy = Y, and
 * the shear modulus of the first layer as the unit of stress. */
enum { RB_STACK_U, RB_STACK_W, RB_STACK_X, RB_STACK_Y };

/* One layer, or the base: d/d(ky) of a state is A times the state.  (U, W) of a half-plane of its
 * material is -half (X, Y). */
typedef struct {
    double thickness; /* [length]; of the base INFINITY */
    double A[4][4];
    double half[2][2];
    double poisson;
} rb_bem_stack_row;

typedef struct {
    int n; /* layers; row[n] is the base */
    int elastic_base;
    double height; /* of all layers [length] */
    rb_bem_stack_row *row;
} rb_bem_stack_rows;

/* NULL: no memory.  Free it when done. */
rb_bem_stack_rows *rb_bem_stack_rows_of(const rb_bem_surface *body);
void rb_bem_stack_rows_free(rb_bem_stack_rows *rows);

/* Compliances at the wave number k > 0: (U, W) = -C[j] (X, Y) on the upper face of row j, j = 0 ...
 * n; and, unless NULL, the tractions of the lower face of row j, down[j] times those of the upper
 * one times exp(-k thickness). */
void rb_bem_stack_compliances(const rb_bem_stack_rows *rows, double k, double (*C)[2][2],
                              double (*down)[2][2]);

/* exp(-A eta) = a[0] - a[1] A + a[2] A^2 - a[3] A^3, because (A^2 - 1)^2 = 0; times exp(-eta). */
void rb_bem_stack_factors(double eta, double a[4]);
/* The state at the distance eta/k above a lower face on which it is s, both times exp(-eta); a: the
 * factors of eta. */
void rb_bem_stack_lift(const rb_bem_stack_row *row, const double a[4], const double s[4],
                       double to[4]);

/* ---- The kernel (L7) --------------------------------------------------------------- */

/* The integral of (L3) over all waves as a function of X = (x - s)/d, d the thickness of the first
 * layer, 0 <= X <= reach: pressure, friction and the coupling. */
typedef struct rb_bem_stack_kernel rb_bem_stack_kernel;
rb_bem_stack_kernel *rb_bem_stack_kernel_create(const rb_bem_surface *body, double reach);
void rb_bem_stack_kernel_at(const rb_bem_stack_kernel *kernel, double X, double of[3]);
void rb_bem_stack_kernel_free(rb_bem_stack_kernel *kernel);

/* ---- Stress inside ----------------------------------------------------------------- */

/* As rb_bem_layer_field of bem.h, for a surface with a stack. */
typedef struct rb_bem_stack_field rb_bem_stack_field;
rb_status rb_bem_stack_field_create(const rb_bem_surface *body, const rb_bem_edge_load *load,
                                    rb_bem_stack_field **field, rb_message *why);
rb_status rb_bem_stack_field_add(rb_bem_stack_field *field, rb_bem_points points, double *stress,
                                 rb_message *why);
void rb_bem_stack_field_free(rb_bem_stack_field *field);

#endif
