/* Rolling cases that several tests share. */
#ifndef ROLLBEM_TESTS_CASES_H
#define ROLLBEM_TESTS_CASES_H

#include "rollbem/rolling.h"

#include <math.h>

/* A wheel, a half-plane in its contact, on a rigid plane. */
static inline rb_rolling_case half_plane(rb_rolling_formulation formulation, int elements)
{
    rb_rolling_case rc = rb_rolling_case_defaults();
    rc.a.support = RB_BEM_HALFPLANE;
    rc.formulation = formulation;
    rc.contact_elements = elements;
    return rc;
}

/* B flat and of A's material, which is set before. */
static inline void on_its_like(rb_rolling_case *rc)
{
    rc->b = rc->a;
    rc->b.radius = INFINITY;
    rc->elastic_b = 1;
}

/* The same on a plane of its own material: Carter's bodies. */
static inline rb_rolling_case similar_planes(rb_rolling_formulation formulation, int elements)
{
    rb_rolling_case rc = half_plane(formulation, elements);
    on_its_like(&rc);
    rc.load = 500.0;
    return rc;
}

/* The same at half the creepage of full sliding. */
static inline rb_rolling_case carter_case(int elements)
{
    rb_rolling_case rc = similar_planes(RB_STEADY, elements);
    rc.creep_ratio = 0.5;
    return rc;
}

/* Similar steel bodies (theory.md 6): CONTACT's case. */
static inline rb_rolling_case steel_wheel(int across)
{
    rb_rolling_case rc = half_plane(RB_STATIC, across + 10);
    rc.a.poisson = 0.28;
    rc.a.young = 2.0 * 82000.0 * 1.28;
    rc.a.radius = 500.0;
    on_its_like(&rc);
    rc.gap = RB_GAP_PARABOLA;
    rc.load = 178.896;
    rc.zone = rb_rolling_hertz_half_width(&rc, rc.load) * (across + 10) / across;
    return rc;
}

/* A rubber-like wheel on a steel rail: both bodies count, and they are coupled. */
static inline rb_rolling_case wheel_on_rail(rb_bem_support support, int across)
{
    rb_rolling_case rc = steel_wheel(across);
    rc.a.support = support;
    rc.a.young /= 3.0;
    rc.a.poisson = 0.4;
    rc.load *= 100.0;
    rc.zone = 1.2 * rb_rolling_hertz_half_width(&rc, rc.load);
    return rc;
}

/* Dissimilar bodies that roll, but where they are pressed together alone. */
static inline rb_rolling_case rolled_plane(rb_rolling_formulation formulation)
{
    rb_rolling_case rc = half_plane(formulation, 24);
    rc.a.poisson = 0.3;
    rc.load = 500.0;
    rc.speed = 1000.0;
    rc.distance = 0.3;
    if (formulation != RB_STATIC)
        rc.creep_ratio = 0.5;
    return rc;
}

/* Twelve elements in full sliding, which warm A. */
static inline rb_rolling_case warm_sliding(rb_rolling_formulation formulation)
{
    rb_rolling_case rc = half_plane(formulation, 12);
    rc.speed = 1000.0;
    rc.half_width = 1.0;
    rc.creep_ratio = 2.0;
    rc.heat_a = (rb_rolling_heat){.conductivity = 40.0, .heat_capacity = 3.5};
    return rc;
}

/* Similar planes whose friction falls with the slip velocity. */
static inline rb_rolling_case falling_case(rb_rolling_formulation formulation, double fall,
                                           double scale)
{
    rb_rolling_case rc = similar_planes(formulation, 24);
    rc.speed = 1000.0;
    rc.distance = 0.3;
    rc.mu = 0.2;
    rc.friction.law = RB_FRICTION_exponential;
    rc.friction.fall[0] = fall;
    rc.friction.slip_scale[0] = scale;
    return rc;
}

static inline double falling_mu(const rb_rolling_case *rc, double v)
{
    return rc->mu + rc->friction.fall[0] * exp(-log(2.0) * v / rc->friction.slip_scale[0]);
}

#endif
