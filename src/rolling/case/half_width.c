/* The half-width of a contact to which Hertz's formula does not apply: on a wave (P1), under a
 * table without a radius, on a third body that gives way, of bodies that relax while they roll
 * (A1). */
#include "rolling/body/body.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"

#include <gsl/gsl_math.h>

/* What terms of relaxation add to the compliance of a body under a contact of half-width a that
 * rolls steadily, as a part of the glassy one (A1): the whole of f_k where it rolls slowly, nothing
 * where it passes before anything relaxes. */
static double relaxed_part(const rb_rolling_case *rc, const rb_rolling_memory *memory, double a)
{
    double all = 0.0, sum = 0.0;

    for (int k = 0; k < memory->n; k++)
        all += memory->ratio[k];
    for (int k = 0; k < memory->n; k++) {
        const double z = rc->speed * memory->time[k] / a;
        sum += memory->ratio[k] / (1.0 + z + 1.15 * z * z / pow(1.0 + all, 0.6));
    }
    return sum;
}

/* Half of where a table without a radius is no higher than 2P/(pi E*) above its lowest place, as
 * Hertz's gap at the edge of the contact.  NAN: there is no table. */
static double half_of_low_part(const rb_rolling_case *rc, double load)
{
    const double *x;
    if (!rc->profile) /* which is refused */
        return NAN;
    const int rows = rb_rolling_profile_rows(rc->profile, &x);
    int lowest = 0, first, last;

    for (int i = 1; i < rows; i++)
        if (rb_rolling_profile_gap(rc->profile, x[i]) <
            rb_rolling_profile_gap(rc->profile, x[lowest]))
            lowest = i;
    const double level = rb_rolling_profile_gap(rc->profile, x[lowest]) +
                         2.0 * load / (M_PI * rb_rolling_modulus(rc));
    for (first = lowest; first > 0 && rb_rolling_profile_gap(rc->profile, x[first - 1]) <= level;)
        first--;
    for (last = lowest;
         last + 1 < rows && rb_rolling_profile_gap(rc->profile, x[last + 1]) <= level;)
        last++;
    /* between two rows by the chord */
    double from = x[first], to = x[last];
    if (first > 0) {
        const double low = rb_rolling_profile_gap(rc->profile, x[first]),
                     high = rb_rolling_profile_gap(rc->profile, x[first - 1]);
        from -= (x[first] - x[first - 1]) * (level - low) / (high - low);
    }
    if (last + 1 < rows) {
        const double low = rb_rolling_profile_gap(rc->profile, x[last]),
                     high = rb_rolling_profile_gap(rc->profile, x[last + 1]);
        to += (x[last + 1] - x[last]) * (level - low) / (high - low);
    }
    return 0.5 * (to - from);
}

/* (P1) Westergaard's, of a wave. */
static double half_width_on_wave(const rb_rolling_case *rc, double load)
{
    const double flattens = M_PI * rb_rolling_modulus(rc) * rc->amplitude; /* load per period */
    return rc->period / M_PI * asin(sqrt(fmin(1.0, load / flattens)));
}

static double half_width_alone(const rb_rolling_case *rc, double load)
{
    enum { ROUNDS = 100 };
    const int relaxes = rc->formulation != RB_STATIC && rb_rolling_relaxes(rc);
    const double soft = 1.5 * rb_rolling_radius(rc) * rc->interlayer_normal * load;

    if (!rb_rolling_has_radius(rc))
        return half_of_low_part(rc, load);
    const double hertz = rb_rolling_hertz_half_width(rc, load);
    if ((!(soft > 0.0) && !relaxes) || !(hertz > 0.0))
        return hertz;
    /* a^3 = A(a) a + B, with the pressure of A flatter the more B gives way: the right side grows
     * like a at most, so that iterates come nearer by a third or more. */
    const double rigid = rb_rolling_modulus(rc) *
                         rb_rolling_compliance(rb_rolling_material(rc, &rc->a)),
                 other = 1.0 - rigid;
    double a = fmax(hertz, cbrt(soft));
    for (int k = 0; k < ROUNDS; k++) {
        const double relaxed = relaxes ? rigid * relaxed_part(rc, &rc->a.memory, a) +
                                             other * relaxed_part(rc, &rc->b.memory, a)
                                       : 0.0;
        const double t = soft / (a * a * a);
        const double flatter = 1.0 + 0.162 * t * (t + 0.052) / ((t + 0.0174) * (t + 0.364));
        const double next = cbrt(hertz * hertz * (1.0 + relaxed) * a * flatter + soft);
        const double step = next - a;
        a = next;
        if (fabs(step) <= 1e-15 * a)
            break;
    }
    return a;
}

double rb_rolling_half_width_beyond_hertz(const rb_rolling_case *rc, double load)
{
    return rc->gap == RB_GAP_WAVE && rc->interlayer_normal == 0.0
               ? half_width_on_wave(rc, load)
               : rb_rolling_within_period(rc, half_width_alone(rc, load));
}

double rb_rolling_pressure_load(const rb_rolling_case *rc)
{
    enum { ROUNDS = 60 };
    const double p = rc->max_pressure;
    if (rb_rolling_has_radius(rc))
        return M_PI * rb_rolling_radius(rc) * gsl_pow_2(p) / rb_rolling_modulus(rc);
    double load = p; /* 2P/(pi a) = p, a that of the load */
    for (int k = 0; k < ROUNDS; k++)
        load = 0.5 * M_PI * p * rb_rolling_contact_half_width(rc, load);
    return load;
}
