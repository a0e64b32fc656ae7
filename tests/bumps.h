/* A surface of bumps as a table, which makes several contacts. */
#ifndef ROLLBEM_TESTS_BUMPS_H
#define ROLLBEM_TESTS_BUMPS_H

#include "cases.h"

#include <gsl/gsl_math.h>

enum { POINTS = 1201, MOST = 20 };

typedef struct {
    rb_rolling_case rc;
    rb_rolling_profile *profile;
    double x[POINTS], gap[POINTS];
} table;

/* Bumps of radius 10 at places x, so much higher than the lowest. */
static inline table *bumps(int n, const double *x, const double *height)
{
    table *t = NOT_NULL(calloc(1, sizeof *t));
    const double half = fmax(fabs(x[0]), fabs(x[n - 1])) + 1.5;
    for (int i = 0; i < POINTS; i++) {
        t->x[i] = half * (2.0 * i / (POINTS - 1) - 1.0);
        t->gap[i] = INFINITY;
        for (int k = 0; k < n; k++)
            t->gap[i] = fmin(t->gap[i], gsl_pow_2(t->x[i] - x[k]) / 20.0 + height[k]);
    }
    CHECK_OK(rb_rolling_profile_create(POINTS, t->x, t->gap, 0.0, &t->profile, &message));
    t->rc = rolling_case("support halfplane contact-elements 40 load 30");
    t->rc.gap = RB_GAP_TABLE;
    t->rc.profile = t->profile;
    return t;
}

static inline void bumps_free(table *t)
{
    rb_rolling_profile_free(t->profile);
    free(t);
}
HELD_TYPE(table, bumps_free)
#define held_table HELD(table)

#endif
