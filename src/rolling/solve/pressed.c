/* The load under which the largest pressure is a given one. */
#include "rolling/body/body.h"
#include "rolling/case/derived.h"
#include "rolling/solve/model.h"
#include "rolling/solve/pressed.h"
#include "rolling/results/results.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

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

rb_status rb_rolling_try(const rb_rolling_case *trial, rb_rolling_solution *s, double *widest,
                         rb_message *why)
{
    rb_rolling_model model = {0};
    rb_rolling_solution all = {0};
    const rb_status status = rb_rolling_solve_model(trial, &model, &all, why);

    *s = rb_rolling_scalars_of(&all);
    if (status == RB_OK) {
        double from, to;
        s->resistance_moment = rb_contact_moment(&model.problem, &model.state);
        rb_rolling_contact_edges(model.rc, &model.mesh, &model.state, &from, &to);
        if (widest)
            *widest = ROOM * fmax(fabs(from), fabs(to));
    }
    rb_rolling_solution_free(&all);
    rb_rolling_model_free(&model);
    return status;
}

/* The pressure under a load; the case is that of the search, without the largest pressure. */
static rb_status pressure_under(const rb_rolling_case *rc, double load, double *pressure,
                                double *widest, rb_message *why)
{
    rb_rolling_case trial = *rc;
    rb_rolling_solution s;

    trial.load = load;
    const rb_status status = rb_rolling_try(&trial, &s, widest, why);
    *pressure = s.max_pressure;
    return status;
}

/* Secants in ln P over ln p, kept between loads with too little and too much pressure.  follows: 1:
 * the zone is a multiple of the contact's half-width under each load, and at.zone is set to it; 0:
 * a zone that fills has too much load; where it may grow, a contact that reaches the end of the
 * gap's table has. */
static rb_status search_load(rb_rolling_case *at, double wanted, int follows, double near,
                             double *load, rb_message *why)
{
    enum { MOST = 60, WIDER = 4 }; /* solves; wider zones under one load */
    /* a rough load needs a rough bracket only */
    const double narrow = follows ? 0.1 * near : NARROW;
    double multiple = NAN, served = NAN, low = NAN, high = NAN, before = NAN, off_before = NAN;
    double x = log(*load);
    int wider = 0, full = 0; /* whether high is a load with a contact that does not fit */
    rb_message fullness = {0};

    for (int k = 0; k < MOST; k++) {
        double pressure, widest;
        *load = exp(x);
        const double width = rb_rolling_contact_half_width(at, *load);
        if (follows)
            at->zone = isnan(multiple) ? 0.0 : multiple * width;
        const rb_status s = pressure_under(at, *load, &pressure, &widest, why);
        if (s == RB_ZONE && follows && !isnan(multiple) && wider++ < WIDER) {
            multiple *= 1.3; /* the contact has grown faster */
            continue;
        }
        if (s == RB_ZONE && !(high - low <= narrow) && !(isnan(low) && k >= MOST / 2)) {
            multiple = served;
            wider = 0;
            full = 1;
            fullness = *why;
            high = x;
            x = isnan(low) ? x - M_LN2 : 0.5 * (low + high);
            continue;
        }
        if (s > RB_OK && s != RB_ZONE) { /* a solver's words name no option */
            const rb_message reason = *why;
            return rb_fail(why, s, "max-pressure: its search ended under %g N/mm: %s", *load,
                           reason.text);
        }
        if (s != RB_OK)
            return s;
        if (follows && isnan(multiple)) {
            multiple = widest / width;
            continue; /* the same load again, in this zone */
        }
        served = multiple;
        wider = 0;
        const double off = log(pressure / wanted);
        if (fabs(off) <= near || (high - low <= narrow && !(full && off < 0.0)))
            return RB_OK;
        if (high - low <= narrow) /* every contact that fits has too little pressure */
            return rb_fail(why, RB_ZONE, "%s", fullness.text);
        if (off >= 0.0)
            full = 0;
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
    return rb_fail(why, RB_MAXITER, "max-pressure: no load was found with %g MPa", wanted);
}

rb_status rb_rolling_find_load(rb_rolling_case *rc, rb_message *why)
{
    /* to which the load has to be known for the zone */
    static const double ROUGHLY = 1e-2;
    const double wanted = rc->max_pressure, start = rb_rolling_pressure_load(rc);
    rb_rolling_case at = *rc;
    rb_status s = RB_OK;

    at.max_pressure = at.pressed_by = NAN;
    /* On equal elements a zone that grows by steps would make the pressure jump.  A zone of its own
     * is found first, and the load from the beginning in this zone: a case that gives the zone has
     * the same load, to the last bit. */
    if (rc->mesh == RB_MESH_UNIFORM && rc->zone == 0.0) {
        double load = start;
        s = search_load(&at, wanted, 1, ROUGHLY, &load, why);
    }
    double load = start;
    if (s == RB_OK)
        s = search_load(&at, wanted, 0, NEAR, &load, why);
    if (s == RB_ZONE && rc->gap == RB_GAP_TABLE && rc->zone == 0.0) /* the zone is the search's */
        return rb_fail(why, s,
                       "max-pressure: no load was found whose contact stays within the "
                       "table of the gap");
    if (s == RB_OK && rc->gap == RB_GAP_TABLE) {
        rb_rolling_case finer = at;
        double pressure;
        finer.contact_elements *= 2;
        s = pressure_under(&finer, load, &pressure, NULL, why);
        if (s == RB_OK && pressure > CORNER * wanted)
            s = rb_refuse(why, "max-pressure",
                          "the pressure is unbounded at a corner of the gap: give --load");
    }
    if (s == RB_OK) {
        rc->pressed_by = load;
        rc->zone = at.zone;
    }
    return s;
}
