/* The gap between the bodies, given by a table, and the elements along it. */
#ifndef ROLLBEM_ROLLING_BODY_GAP_H
#define ROLLBEM_ROLLING_BODY_GAP_H

#include "rolling/case/inputs.h"

/* ---- Gaps by tables ------------------------------------------------------------- */

/* A measured gap g_0(x) [length]: n points with increasing x, interpolated by cubic
 * splines between the corners of the data; the pressure follows the curvature of the gap,
 * and that of a spline is continuous.  noise 0: the curve passes through the points.  noise > 0:
 * standard deviation of the noise of the points [length]; the spline is the smoothest curve whose
 * root mean square distance to the points is that small.  RB_EINVAL: too few points, x
 * does not increase, or the smallest gap is at an end, so that the table does not enclose
 * a contact; why names the row.  RB_ENOMEM. */
rb_status rb_rolling_profile_create(int n, const double *x, const double *gap, double noise,
                                    rb_rolling_profile **profile, rb_message *why);

void rb_rolling_profile_free(rb_rolling_profile *profile);

/* As rb_rolling_profile_create, but one cubic spline without corners, which changes smoothly with
 * its points: of a gap that is searched for. */
rb_status rb_rolling_profile_smooth(int n, const double *x, const double *gap,
                                    rb_rolling_profile **profile, rb_message *why);

/* As rb_rolling_profile_create, of a body that ends where the table ends: the smallest gap may be
 * there. */
rb_status rb_rolling_profile_punch(int n, const double *x, const double *gap, double noise,
                                   rb_rolling_profile **profile, rb_message *why);

/* The radius of the parabola that is nearest to the gap around its smallest value, in the lowest
 * tenth of its range [length]; NAN: the gap has none: it is flat, a roof or hollow there. */
double rb_rolling_profile_radius(const rb_rolling_profile *profile);
/* The first and the last x of the profile. */
void rb_rolling_profile_range(const rb_rolling_profile *profile, double *from, double *to);
/* The gap at any x.  Beyond the ends it is extrapolated by straight lines; a contact
 * there is not accepted. */
double rb_rolling_profile_gap(const rb_rolling_profile *profile, double x);

/* ---- The elements --------------------------------------------------------------- */

/* The undeformed gap of the profile at x, including the worn depth. */
double rb_rolling_initial_gap(const rb_rolling_case *rc, double x);

/* 1: the mesh is a whole period, and its ends are one place. */
int rb_rolling_fills_period(const rb_rolling_case *rc, const rb_rolling_mesh *mesh);

/* The elements of a result; borrowed. */
typedef struct {
    int n;
    const double *x, *h; /* n: midpoints, lengths */
    int are_equal;
} rb_rolling_elements;

/* Reconstructs the mesh of a result: equal elements from the two outer ends, fitted
 * elements from every element. */
rb_status rb_rolling_mesh_of_result(const rb_rolling_case *rc, const rb_rolling_elements *elements,
                                    rb_rolling_mesh *mesh, rb_message *why);

#endif
