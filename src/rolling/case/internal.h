/* What src/rolling alone asks of a case. */
#ifndef ROLLBEM_ROLLING_CASE_INTERNAL_H
#define ROLLBEM_ROLLING_CASE_INTERNAL_H

#include "rolling/case/derived.h"

#include <math.h>

/* (1 - nu^2)/E of a half-plane, in plane stress 1/E, and E*: 1/E* is the sum of both bodies'. */
double rb_rolling_compliance(rb_bem_material material);
double rb_rolling_modulus(const rb_rolling_case *rc);
/* rb_rolling_contact_half_width where Hertz's formula does not hold (half_width.c). */
double rb_rolling_half_width_beyond_hertz(const rb_rolling_case *rc, double load);
/* A contact is no longer than its period. */
static inline double rb_rolling_within_period(const rb_rolling_case *rc, double half_width)
{
    return rc->period > 0.0 ? fmin(half_width, 0.5 * rc->period) : half_width;
}
/* 1 if the boundary of wheels outside the contact is finer than needed for finding the
 * contact; the second function sets the plan to the default boundary. */
int rb_rolling_has_fine_boundary(const rb_rolling_plan *plan);
void rb_rolling_coarsen_boundary(rb_rolling_plan *plan);
/* 1: a bulk stress is given; and the strain along the surface that it makes in A less that in B
 * (U1): displacements differ by so much times x; and the larger of both, without its sign. */
static inline int rb_rolling_is_strained(const rb_rolling_case *rc)
{
    return rc->bulk_stress != 0.0 || rc->bulk_stress_b != 0.0;
}
double rb_rolling_bulk_strain(const rb_rolling_case *rc);
double rb_rolling_largest_bulk_strain(const rb_rolling_case *rc);
/* 1: load, approach, half-width, largest pressure or the load of an ellipse; 0: approach = R/2. */
int rb_rolling_pressing_is_given(const rb_rolling_case *rc);
/* Forgets the half-width, largest pressure or wheel load that were given: load or approach are set
 * instead. */
void rb_rolling_press_by_load(rb_rolling_case *rc);
/* 1: the load is that of an ellipse (E2). */
int rb_rolling_has_ellipse(const rb_rolling_case *rc);
/* 1: the gap has a shape of its own, that of a table or a wave, not that of the bodies' radii. */
static inline int rb_rolling_gap_has_shape(const rb_rolling_case *rc)
{
    return rc->gap == RB_GAP_TABLE || rc->gap == RB_GAP_WAVE;
}
/* 1 if temperatures are computed. */
int rb_rolling_has_heat(const rb_rolling_case *rc);
/* 1: a layer on a rigid base gives way under equal pressure, or under equal friction, everywhere
 * (P1). */
int rb_rolling_mean_compresses(const rb_rolling_case *rc);
int rb_rolling_mean_shears(const rb_rolling_case *rc);
/* 1: a tilt or a moment is given; and the tilt (U3). */
int rb_rolling_is_tilted(const rb_rolling_case *rc);
double rb_rolling_tilt(const rb_rolling_case *rc);
/* 1: Q, a force ratio or a free axle is given, and no creepage. */
int rb_rolling_force_is_given(const rb_rolling_case *rc);

/* 1 if products are computed by Fourier transforms: half-planes, and covers in steady
 * rolling, with equal elements, solved by Newton's method. */
int rb_rolling_has_transforms(const rb_rolling_case *rc);

/* Compression of the thinnest layer, cover or rim divided by its thickness; what: which
 * of them it is (may be NULL).  The approach is divided between two elastic bodies by
 * their compliances, but no body is compressed more than the pressure can compress its
 * material.  NAN: neither body has a layer, cover or rim. */
double rb_rolling_strain(const rb_rolling_case *rc, double approach, double pressure,
                         const char **what);

#endif
