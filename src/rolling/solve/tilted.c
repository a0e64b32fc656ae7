/* The tilt under which the pressure has a given moment (U3). */
#include "rolling/body/mesh.h"
#include "rolling/case/derived.h"
#include "rolling/solve/pressed.h"
#include "rolling/solve/zone.h"

#include <gsl/gsl_math.h>

/* Distance from the moment over P a, and of both ends of a bracket over the strain where the mesh
 * makes it jump. */
static const double NEAR = 1e-10, NARROW = 1e-14;

/* Hertz's a/R per half-width of the line of action, or that of a flat punch as wide as the contact
 * is now. */
static double slope_of(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    return rb_rolling_has_radius(rc)
               ? s->normal_load * rb_rolling_radius(rc)
               : M_PI_4 * gsl_pow_2(s->half_width) * rb_rolling_derive(rc).modulus;
}

/* Secants, kept between tilts with too little and too much moment, which grows with the tilt.
 * widest: the half-width of the potential contact that the last one needs. */
static rb_status search_tilt(rb_rolling_case *at, double wanted, double near, double *widest,
                             rb_message *why)
{
    enum { MOST = 60 };
    const double strain = rb_rolling_derive(at).strain;
    double low = NAN, high = NAN, before = NAN, off_before = NAN;

    for (int k = 0; k < MOST; k++) {
        rb_rolling_solution s;
        const rb_status status = rb_rolling_try(at, &s, widest, why);
        const double x = at->tilt, off = s.resistance_moment - wanted;
        if (status == RB_ZONE && k > 0) { /* so much tilt moves the contact off its zone */
            *(x > before ? &high : &low) = x;
            at->tilt = 0.5 * (x + before);
            continue;
        }
        if (status != RB_OK)
            return status;
        if (fabs(off) <= near * s.normal_load * s.half_width || high - low <= NARROW * strain)
            return RB_OK;
        *(off < 0.0 ? &low : &high) = x;
        const double first = slope_of(at, &s), slope = isnan(before) || x == before
                                                           ? first
                                                           : (off - off_before) / (x - before);
        double next = x - off / (slope > 0.05 * first ? slope : first);
        const double most = fmax(strain, fabs(x)); /* a contact at a corner asks for much tilt */
        next = fmin(fmax(next, x - most), x + most);
        if (!isnan(low) && !isnan(high) && !(next > low && next < high))
            next = 0.5 * (low + high);
        before = x;
        off_before = off;
        at->tilt = next;
    }
    return rb_fail(why, RB_MAXITER, "moment: no tilt was found with %g N", wanted);
}

/* Equilibrium needs a pressure on either side of the load, where A can touch. */
static rb_status check_arm(const rb_rolling_case *rc, rb_message *why)
{
    double from, to;

    rb_rolling_extent(rc, &from, &to);
    if (rc->zone > 0.0) {
        from = fmax(from, -rc->zone);
        to = fmin(to, rc->zone);
    }
    const double arm = rc->moment / rb_rolling_derive(rc).load;
    return !isnan(arm) && !(arm > from && arm < to)
               ? rb_refuse(why, "moment",
                           "the load acts at M/P = %.4g mm, and A touches between %.4g and "
                           "%.4g mm at most: it topples",
                           arm, from, to)
               : RB_OK;
}

rb_status rb_rolling_find_tilt(rb_rolling_case *rc, rb_message *why)
{
    /* to which the tilt has to be known for the zone */
    static const double ROUGHLY = 1e-2;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double start =
        rb_rolling_has_radius(rc) && !isnan(d.load) ? rc->moment / (d.load * d.radius) : 0.0;
    rb_rolling_case at = *rc;
    double widest = 0.0;
    rb_status s = check_arm(rc, why);

    at.moment = at.tilted_by = NAN;
    at.tilt = start;
    /* In a zone of its own, so that a case which gives the zone has the same tilt. */
    if (s == RB_OK && rc->mesh == RB_MESH_UNIFORM && rc->zone == 0.0) {
        s = search_tilt(&at, rc->moment, ROUGHLY, &widest, why);
        at.zone = widest;
        at.tilt = start;
    }
    if (s == RB_OK)
        s = search_tilt(&at, rc->moment, NEAR, &widest, why);
    if (s == RB_OK) {
        rc->tilted_by = at.tilt;
        rc->zone = at.zone;
    }
    return s;
}
