/* What follows from the numbers of a case by formulas: radius, modulus, Dundurs' constants,
 * half-width, load and pressure of Hertz's contact (4.4, 4.5). */
#include "rolling/body/body.h"
#include "rolling/case/internal.h"

#include <gsl/gsl_math.h>

/* (1 - nu^2)/E, in plane stress 1/E: what a half-plane adds to 1/E*. */
double rb_rolling_compliance(rb_bem_material m)
{
    return (1.0 - m.poisson) / (2.0 * m.shear);
}

double rb_rolling_modulus(const rb_rolling_case *rc)
{
    return 1.0 / (rb_rolling_compliance(rb_rolling_material(rc, &rc->a)) +
                  (rc->elastic_b ? rb_rolling_compliance(rb_rolling_material(rc, &rc->b)) : 0.0));
}

/* c of kernels (Flamant): the coupling compliance of a half-plane. */
static double coupling(rb_bem_material m)
{
    return (1.0 - 2.0 * m.poisson) / (4.0 * m.shear);
}

/* Solves a^2/(4R) (2 ln(4R/a) - 1) = delta for a, the compression of a half-cylinder
 * (theory-solvers.md 6).  Newton's method starts where the contact is never wider: at the overlap
 * of the rigid shapes, or at 0.7 R.  It ends at rounding, because the width of the
 * automatic zone, and with it every result, follows from a. */
static double half_width_of_approach(double radius, double approach)
{
    enum { ROUNDS = 60 };
    double a = fmin(sqrt(2.0 * radius * approach), 0.7 * radius);

    for (int k = 0; k < ROUNDS; k++) {
        const double l = log(4.0 * radius / a);
        const double excess = a * a / (4.0 * radius) * (2.0 * l - 1.0) - approach;
        if (k == 0 && excess < 0.0)
            return a;
        const double step = excess / (a / radius * (l - 1.0));
        a -= step;
        if (fabs(step) <= 1e-15 * a)
            break;
    }
    return a;
}

/* In a bore the difference of the radii, not that of their inverses, which may agree in
 * most of their digits. */
double rb_rolling_radius(const rb_rolling_case *rc)
{
    const double a = rc->a.radius, b = rc->b.radius;
    if (rc->ellipse.radius > 0.0)
        return rc->ellipse.radius;
    if (rc->gap == RB_GAP_WAVE) /* of the crest */
        return gsl_pow_2(rc->period / (2.0 * M_PI)) / rc->amplitude;
    return b < 0.0 && isfinite(b) && isfinite(a) ? a * b / (a + b) : 1.0 / (1.0 / a + 1.0 / b);
}

int rb_rolling_has_radius(const rb_rolling_case *rc)
{
    return isfinite(rb_rolling_radius(rc));
}

double rb_rolling_larger_radius(const rb_rolling_case *rc)
{
    return fmax(rc->a.radius, isfinite(rc->b.radius) ? fabs(rc->b.radius) : 0.0);
}

double rb_rolling_hertz_half_width(const rb_rolling_case *rc, double load)
{
    return sqrt(4.0 * load * rb_rolling_radius(rc) / (M_PI * rb_rolling_modulus(rc)));
}

double rb_rolling_hertz_load(const rb_rolling_case *rc, double half_width)
{
    return M_PI * rb_rolling_modulus(rc) * gsl_pow_2(half_width) / (4.0 * rb_rolling_radius(rc));
}

/* Hertz's formulas hold: a round gap, one contact, nothing soft between the bodies, and none that
 * relaxes while it rolls. */
static int is_hertzian(const rb_rolling_case *rc)
{
    return rb_rolling_has_radius(rc) && !(rc->interlayer_normal > 0.0) && rc->period == 0.0 &&
           !(rc->formulation != RB_STATIC && rb_rolling_relaxes(rc));
}

double rb_rolling_contact_half_width(const rb_rolling_case *rc, double load)
{
    return is_hertzian(rc) ? rb_rolling_hertz_half_width(rc, load)
                           : rb_rolling_half_width_beyond_hertz(rc, load);
}

rb_rolling_derived rb_rolling_derive(const rb_rolling_case *rc)
{
    const rb_rolling_body *a = &rc->a;
    rb_rolling_derived d = {.radius = rb_rolling_radius(rc), .modulus = rb_rolling_modulus(rc)};
    const int has_radius = rb_rolling_has_radius(rc);

    d.dundurs = (coupling(rb_rolling_material(rc, a)) -
                 (rc->elastic_b ? coupling(rb_rolling_material(rc, &rc->b)) : 0.0)) *
                d.modulus;
    /* What presses the bodies: a load, given or by the formula of another quantity, or an approach.
     */
    d.load = rb_rolling_has_ellipse(rc) ? M_PI_2 * rc->ellipse.a * rc->ellipse.pressure
             : !isnan(rc->half_width)   ? rb_rolling_hertz_load(rc, rc->half_width)
             : isnan(rc->max_pressure)  ? rc->load
             : isnan(rc->pressed_by)    ? rb_rolling_pressure_load(rc)
                                        : rc->pressed_by;
    d.approach = !isnan(d.load) ? NAN : isnan(rc->approach) ? a->radius / 2.0 : rc->approach;
    /* Under an approach by that load which flattens its lower half, 2P/(pi E*) = approach/2; in a
     * history the bodies may be apart. */
    const double down = fmax(0.0, d.approach);
    const double P = isnan(d.load) ? 0.25 * M_PI * d.modulus * down : d.load;
    d.half_width = !isnan(d.load) || !has_radius
                       ? rb_rolling_contact_half_width(rc, P)
                       : rb_rolling_within_period(rc, half_width_of_approach(d.radius, down));
    d.stress = P == 0.0 ? 0.0
               : is_hertzian(rc) || (isnan(d.load) && has_radius)
                   ? d.modulus * d.half_width / (2.0 * d.radius)
                   : 2.0 * P / (M_PI * d.half_width);
    /* what lies between the bodies bears no more where nothing else gives way */
    if (isnan(d.load) && rc->interlayer_normal > 0.0)
        d.stress = fmin(d.stress, down / rc->interlayer_normal);
    d.strain = has_radius ? d.half_width / d.radius : 2.0 * d.stress / d.modulus;
    return d;
}

double rb_rolling_zone_half_width(const rb_rolling_case *rc, double load)
{
    const rb_rolling_derived d = rb_rolling_derive(rc);
    const double P = isnan(load) ? d.load : load;

    if (!rb_rolling_has_radius(rc))
        return isnan(P) ? d.half_width : rb_rolling_contact_half_width(rc, P);
    const double hertz = isnan(P) ? d.half_width : rb_rolling_hertz_half_width(rc, P),
                 soft = isnan(P) ? sqrt(2.0 * d.radius * d.approach)
                                 : cbrt(1.5 * d.radius * rc->interlayer_normal * P);
    return rc->interlayer_normal > 0.0 ? fmax(hertz, soft) : hertz;
}

int rb_rolling_pressing_is_given(const rb_rolling_case *rc)
{
    return !isnan(rc->load) || !isnan(rc->approach) || !isnan(rc->half_width) ||
           !isnan(rc->max_pressure) || rb_rolling_has_ellipse(rc);
}

void rb_rolling_press_by_load(rb_rolling_case *rc)
{
    rc->half_width = rc->max_pressure = rc->pressed_by = rc->wheel_load = NAN;
    rc->transverse_radius = rc->transverse_radius_b = INFINITY;
    rc->strips = 0;
}

int rb_rolling_has_ellipse(const rb_rolling_case *rc)
{
    return !isnan(rc->wheel_load);
}

int rb_rolling_has_heat(const rb_rolling_case *rc)
{
    return rc->heat_a.conductivity > 0.0;
}

int rb_rolling_is_tilted(const rb_rolling_case *rc)
{
    return rc->tilt != 0.0 || !isnan(rc->moment);
}

double rb_rolling_tilt(const rb_rolling_case *rc)
{
    return isnan(rc->moment) ? rc->tilt : isnan(rc->tilted_by) ? 0.0 : rc->tilted_by;
}

double rb_rolling_mu_beta(const rb_rolling_case *rc)
{
    return rb_rolling_largest_mu(rc) * fabs(rb_rolling_derive(rc).dundurs);
}

int rb_rolling_force_is_given(const rb_rolling_case *rc)
{
    return !isnan(rc->force) || !isnan(rc->force_ratio) || rc->free_axle;
}

rb_rolling_plan rb_rolling_plan_of(const rb_rolling_case *rc)
{
    return (rb_rolling_plan){rc->contact_elements, rc->near_field, rc->outer_elements,
                             rc->outer_refinement, NULL,           INFINITY};
}

int rb_rolling_has_fine_boundary(const rb_rolling_plan *plan)
{
    return plan->outer_refinement > 1.0 || plan->outer_elements >= RB_ROLLING_FINE_BOUNDARY_FROM;
}

void rb_rolling_coarsen_boundary(rb_rolling_plan *plan)
{
    plan->outer_elements = 0;
    plan->outer_refinement = 0.0;
}
