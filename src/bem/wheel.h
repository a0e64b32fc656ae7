/* The kernel of a wheel, which its matrix and its products share (B12). */
#ifndef ROLLBEM_BEM_WHEEL_H
#define ROLLBEM_BEM_WHEEL_H

#include "bem/layers/ring.h"
#include "bem/bem.h"

/* RB_EINVAL, RB_SINGULAR: wheel and ends of n_c contact elements. */
rb_status rb_wheel_check(int n_c, const double *ends, const rb_bem_wheel *wheel, rb_message *why);

/* The angles of m = n + 1 midpoints, then of m + 1 ends, owned by the caller; NULL
 * without memory.  h: the m chords. */
double *rb_wheel_angles(double radius, int n, const double *ends);
void rb_wheel_chords(double radius, int n, const double *ends, double *h);

/* ---- Frames ---- */

/* Of a surface at an angle from the lowest point, where it has the obstacle's frame. */
typedef struct {
    double cosine, sine;
} rb_direction;

/* Normal and tangential components, `count` of each one after the other, from the frame
 * of the obstacle to that of the surface (way = 1), or back (way = -1); from and to may be
 * the same. */
void rb_wheel_turn(const double *cosine, const double *sine, int way, int count, const double *from,
                   double *to);
/* B = (NN, TN, NT, TT), from a load in direction `from` to a point in direction `to`: from
 * the frames of the surface into the obstacle's. */
void rb_wheel_turn_block(rb_direction to, rb_direction from, double B[4]);

/* The primitive over the angle of the answer of the glassy wheel to a unit load. */
typedef struct {
    double kappa, scale, datum;
    rb_ring_table inner; /* owned: what the wheel has over the half-plane */
} rb_wheel_kernel;

/* For smallest <= abs(x) <= reach, or 0.  RB_ENOMEM. */
rb_status rb_wheel_kernel_create(const rb_bem_wheel *wheel, double smallest, double reach,
                                 rb_wheel_kernel *kernel);
void rb_wheel_kernel_free(rb_wheel_kernel *kernel);
/* [length/stress] */
rb_ring_answer rb_wheel_kernel_at(const rb_wheel_kernel *kernel, double x);

/* What a body that is alike at every angle does at arcs 0 ... n after a load on one arc of
 * angle h, normals those of its surface: N and T as above, C the normal one by friction.
 * RB_ENOMEM. */
typedef rb_status rb_wheel_responds(const void *body, int n, double h, double *N, double *T,
                                    double *C);
/* Of the glassy wheel, an rb_bem_wheel. */
rb_wheel_responds rb_wheel_response;

/* The flexibility of such a body as a Toeplitz matrix, and whether the elements are equal
 * arcs, as it asks.  RB_ENOMEM; free in any case. */
int rb_wheel_has_equal_arcs(int n_c, const double *ends, double radius);
rb_status rb_wheel_on_equal_arcs(int n_c, const double *ends, double radius,
                                 rb_wheel_responds *responds, const void *body,
                                 rb_bem_normals normals, rb_bem_flexibility *f);

#endif
