/* A curve through points, of which gap tables are made. */
#ifndef ROLLBEM_ROLLING_BODY_INTERPOLANT_H
#define ROLLBEM_ROLLING_BODY_INTERPOLANT_H

#include "rolling/body/gap.h"

/* A curve through n >= 3 points with increasing x: a cubic spline, with zero curvature at both
 * ends, that breaks off at the corners of the data and where it would leave them.  Beyond the ends
 * it goes straight on.  is_smooth: 1: one spline in any case.  RB_ENOMEM. */
typedef struct rb_rolling_interpolant rb_rolling_interpolant;
rb_status rb_rolling_interpolant_create(int n, const double *x, const double *y, int is_smooth,
                                        rb_rolling_interpolant **interpolant);
void rb_rolling_interpolant_free(rb_rolling_interpolant *interpolant);
double rb_rolling_interpolant_at(const rb_rolling_interpolant *interpolant, double x);
/* Number and abscissae of its points; of its corners, and by how much the slope is larger behind
 * each; borrowed. */
int rb_rolling_interpolant_rows(const rb_rolling_interpolant *interpolant, const double **x);
int rb_rolling_interpolant_corners(const rb_rolling_interpolant *interpolant, const double **x,
                                   const double **bend);
/* Number of its points with too few around them to tell a corner from a curve: beside these it
 * stays between its points. */
int rb_rolling_interpolant_untold(const rb_rolling_interpolant *interpolant);

struct rb_rolling_profile {
    rb_rolling_interpolant *curve; /* owned */
    double from, to, radius;
};

/* Corners of the profile, as of its interpolant. */
int rb_rolling_profile_corners(const rb_rolling_profile *profile, const double **x,
                               const double **bend);

#endif
