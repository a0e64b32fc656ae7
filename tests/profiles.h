/* Profiles that must be accepted. */
#ifndef ROLLBEM_TESTS_PROFILES_H
#define ROLLBEM_TESTS_PROFILES_H

#include "check.h"
#include "rolling/rolling.h"

static inline rb_rolling_profile *profile_of(int n, const double *x, const double *gap,
                                             double noise)
{
    rb_rolling_profile *profile;
    CHECK_OK(rb_rolling_profile_create(n, x, gap, noise, &profile, &message));
    return profile;
}

#endif
