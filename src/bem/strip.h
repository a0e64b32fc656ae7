/* The uniformly loaded strip on a half-plane in complex form: displacement and traction
 * anywhere below it. */
#ifndef ROLLBEM_BEM_STRIP_H
#define ROLLBEM_BEM_STRIP_H

#include "bem/bem.h"

#include <complex.h>

/* A straight element as the loaded part of the edge of the half-plane on its left. */
typedef struct {
    double complex middle, along; /* midpoint, unit tangent */
    double h;                     /* length */
    double shear, kappa;          /* kappa = 3 - 4 nu */
    double unit;                  /* length inside the logarithm */
} rb_strip;

rb_strip rb_strip_between(double complex from, double complex to, rb_bem_material material,
                          double unit);
rb_strip rb_strip_on(const rb_bem_mesh *mesh, int j, rb_bem_material material, double unit);

/* The same strip on another half-plane. */
rb_strip rb_strip_in(rb_strip strip, rb_bem_material material);

/* Midpoint and outward normal of element j as complex numbers. */
double complex rb_strip_midpoint(const rb_bem_mesh *mesh, int j);
double complex rb_strip_outward(const rb_bem_mesh *mesh, int j);

/* Depth of the point below the edge; negative outside the half-plane. */
double rb_strip_depth(const rb_strip *strip, double complex z);

/* What answers f and conj(f), where the strip carries the traction f = fx + i fy per
 * length: same f + other conj(f). */
typedef struct {
    double complex same, other;
} rb_strip_answer;

static inline double complex rb_strip_under(rb_strip_answer answer, double complex f)
{
    return answer.same * f + answer.other * conj(f);
}

/* Displacement ux + i uy at z. */
rb_strip_answer rb_strip_displacement(const rb_strip *strip, double complex z);
/* The same at n points, at most RB_STRIP_POINTS, from what the kernels of a boundary element there
 * compute (kernels.h): view = Lam + i Th. */
enum { RB_STRIP_POINTS = 32 };
void rb_strip_displacements(const rb_strip *strip, int n, const double *x, const double *y,
                            const double complex *view, rb_strip_answer *answer);
/* Traction tx + i ty at z on a section with outward normal nx + i ny. */
rb_strip_answer rb_strip_traction(const rb_strip *strip, double complex z, double complex normal);
/* The same from what these kernels compute at a point that is not the element's own: Lam + i Th and
 * turned = q Z. */
rb_strip_answer rb_strip_traction_of(const rb_strip *strip, double complex view,
                                     double complex turned, double complex normal);

/* Stress (sxx, syy, sxy) at z under a traction that is f in the middle of the strip and
 * changes by `slope` per length along it. */
void rb_strip_linear_stress(const rb_strip *strip, double complex z, double complex f,
                            double complex slope, double stress[3]);

#endif
