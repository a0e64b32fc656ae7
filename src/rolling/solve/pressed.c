/* The load under which the largest pressure is a given one. */
#include "rolling/solve/results.h"

#include <gsl/gsl_math.h>

/* Relative distance from the pressure, and of both ends of a bracket where its mesh makes it jump.
 * A gap with corners has a larger pressure on finer elements, by so much at least on twice as
 * many. */
static const double NEAR = 1e-10, NARROW = 1e-13, CORNER = 1.1;
/* The potential contact over the half-width of the contact, on equal elements. */
static const double ROOM = 1.25;

int rb_rolling_pressure_is_hertz(const rb_rolling_case *rc)
{
    return rb_rolling_can(rc, RB_BODY_FLAT | RB_BODY_HOMOGENEOUS | RB_BODY_ELASTIC) &&
           rc->gap == RB_GAP_PARABOLA && rc->worn.n == 0 && rc->irregularity.n == 0 &&
           rc->interlayer_normal == 0.0 && rc->a.strip == 0.0 &&
           (rb_rolling_largest_mu(rc) == 0.0 || !rb_rolling_couples(rc));
}

/* The pressure under a load; the case is that of the search, without the largest pressure.
 * widest: NULL, or the half-width of the potential contact that it needs. */
static rb_status pressure_under(const rb_rolling_case *rc, double load, double *pressure,
                                double *widest, rb_message *why)
{
    rb_rolling_case trial = *rc;
    rb_rolling_model model = {0};
    rb_rolling_solution s = {0};
    trial.load = load;
    const rb_status status = rb_rolling_solve_model(&trial, &model, &s, why);
    if (status == RB_OK) {
        double from, to;
        *pressure = s.max_pressure;
        rb_rolling_contact_edges(model.rc, &model.mesh, &model.state, &from, &to);
        if (widest)
            *widest = ROOM * fmax(fabs(from), fabs(to));
    }
    rb_rolling_solution_free(&s);
    rb_rolling_model_free(&model);
    return status;
}

rb_status rb_rolling_find_load(rb_rolling_case *rc, rb_message *why)
{
    enum { MOST = 60 };
    const double wanted = rc->max_pressure, start = rb_rolling_pressure_load(rc);
    rb_rolling_case at = *rc;
    at.max_pressure = at.pressed_by = NAN;
    /* On equal elements a zone that grows by steps would make the pressure jump: it is a multiple
     * of the half-width. */
    const int follows = rc->mesh == RB_MESH_UNIFORM && rc->zone == 0.0;
    double multiple = NAN, low = NAN, high = NAN, x = log(start), before = NAN, off_before = NAN;
    rb_status s = RB_OK;

    for (int k = 0; k < MOST && s == RB_OK; k++) {
        double pressure, widest;
        const double load = exp(x), width = rb_rolling_contact_half_width(rc, load);
        at.zone = follows && !isnan(multiple) ? multiple * width : rc->zone;
        s = pressure_under(&at, load, &pressure, &widest, why);
        if (s == RB_ZONE && follows && !isnan(multiple)) {
            multiple *= 1.3; /* the contact has grown faster */
            s = RB_OK;
            continue;
        }
        if (s != RB_OK)
            break;
        if (follows && isnan(multiple)) {
            multiple = widest / width;
            continue; /* the same load again, in this zone */
        }
        const double off = log(pressure / wanted);
        if (fabs(off) <= NEAR || (high - low) <= NARROW) {
            rc->pressed_by = load;
            rc->zone = at.zone;
            break;
        }
        *(off < 0.0 ? &low : &high) = x;
        /* the slope of ln P over ln p is 2 under Hertz's pressure */
        const double slope =
            isnan(before) || off == off_before ? 2.0 : (x - before) / (off - off_before);
        double next = x - off * (slope > 0.2 && slope < 20.0 ? slope : 2.0);
        next = fmin(fmax(next, x - M_LN2), x + M_LN2);
        if (!isnan(low) && !isnan(high) && !(next > low && next < high))
            next = 0.5 * (low + high);
        before = x;
        off_before = off;
        x = next;
    }
    if (s == RB_OK && isnan(rc->pressed_by))
        s = rb_fail(why, RB_MAXITER, "max-pressure: no load was found with %g MPa", wanted);
    if (s == RB_OK && rc->gap == RB_GAP_TABLE) {
        double finer;
        at.contact_elements *= 2;
        s = pressure_under(&at, rc->pressed_by, &finer, NULL, why);
        if (s == RB_OK && finer > CORNER * wanted)
            s = rb_fail(
                why, RB_EINVAL,
                "max-pressure: the pressure is unbounded at a corner of the gap: give --load");
    }
    return s;
}
