/* What a profile of the gap tells: its ends, rows, corners, radius and values. */
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"

#include <stdlib.h>

double rb_rolling_profile_radius(const rb_rolling_profile *profile)
{
    return profile->radius;
}

void rb_rolling_profile_free(rb_rolling_profile *profile)
{
    if (profile)
        rb_rolling_interpolant_free(profile->curve);
    free(profile);
}

void rb_rolling_profile_range(const rb_rolling_profile *profile, double *from, double *to)
{
    *from = profile->from;
    *to = profile->to;
}

int rb_rolling_profile_rows(const rb_rolling_profile *profile, const double **x)
{
    return rb_rolling_interpolant_rows(profile->curve, x);
}

int rb_rolling_profile_corners(const rb_rolling_profile *profile, const double **x,
                               const double **bend)
{
    return rb_rolling_interpolant_corners(profile->curve, x, bend);
}

double rb_rolling_profile_gap(const rb_rolling_profile *profile, double x)
{
    return rb_rolling_interpolant_at(profile->curve, x);
}
