/* Notes on what the model of the case leaves out: large strains, arcs and tilts, flat layers in
 * place of round covers, strips in place of ellipses, a datum that is near, a base that pulls. */
#include "bem/bem.h"
#include "base/units.h"
#include "rolling/body/internal.h"
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/notes/note.h"
#include "rolling/solve/solution.h"

#include <math.h>

/* Strains are of the order of approach/R and a/R: from the first limits on linear elasticity is
 * inaccurate, from the second ones on it does not hold at all. */
static const double inaccurate_approach = 0.02, inaccurate_width = 0.1;
static const double broken_approach = 0.1, broken_width = 0.3;

static int wide_arc(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double radius = rb_unit_shown(s->units, "mm", rc->a.radius),
                 a = rb_rolling_widest_patch(s);
    const int bore = rc->b.radius < 0.0;

    if (!((bore || rc->interlayer_normal > 0.0) && a > inaccurate_width * radius))
        return 0;
    return rb_rolling_write_note(
        text,
        "The contact spans %.3g degrees of %s. Half-planes hold for small arcs: "
        "expect errors of the order (a/R)^2 = %.2g.",
        360.0 / acos(-1.0) * asin(fmin(a / radius, 1.0)), bore ? "the journal" : "body A",
        a / radius * (a / radius));
}

/* Of Hertz's contact a = 2 R p0/E*; what a third body gives way strains neither body, and a
 * wide arc in a bore is little strain. */
static int strains(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double radius = rb_unit_shown(s->units, "mm", rc->a.radius);
    const double p0 = rb_unit_stored(s->units, "MPa", s->max_pressure);
    const double third = rb_unit_shown(s->units, "mm", rc->interlayer_normal * p0);
    const double approach = (s->approach - third) / radius;
    const rb_rolling_derived d = rb_rolling_derive(rc);
    double width = rb_rolling_widest_patch(s) /
                   (rc->b.radius < 0.0 ? rb_unit_shown(s->units, "mm", d.radius) : radius);
    if (third > 0.0 || !isfinite(radius))
        width = third > 0.0 ? fmin(width, 2.0 * p0 / d.modulus) : 2.0 * p0 / d.modulus;
    /* a contact with a/R strains by p0/E* = a/(2 R) */
    const double bulk = s->largest_bulk_strain, bulk_width = 2.0 * bulk;

    if (approach > inaccurate_approach || fmax(width, bulk_width) > inaccurate_width) {
        const int broken = approach > broken_approach || fmax(width, bulk_width) > broken_width;
        char how_large[80];
        if (bulk_width > fmax(width, approach))
            rb_format(how_large, sizeof how_large, "bulk strain = %.2g", bulk);
        else if (isfinite(radius))
            rb_format(how_large, sizeof how_large, "approach = %.2g R, a = %.2g R",
                      s->approach / radius, width);
        else
            rb_format(how_large, sizeof how_large, "2 p0/E* = %.2g", width);
        return broken
                   ? rb_rolling_write_note(
                         text,
                         "The strains are far beyond linear elasticity (%s): treat the numbers as "
                         "a test problem.",
                         how_large)
                   : rb_rolling_write_note(
                         text,
                         "The strains are large for linear elasticity (%s): expect errors of that "
                         "order.",
                         how_large);
    }
    return 0;
}

/* A gap g0 - X x is that of a turned body up to X^2. */
static int large_tilt(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double large = 0.1;

    (void)rc;
    return fabs(s->tilt) > large &&
           rb_rolling_write_note(
               text,
               "The tilt of %.3g is not a small angle: expect errors of the order of its "
               "square, %.2g.",
               s->tilt, s->tilt * s->tilt);
}

/* What a layer, cover or rim bears is a matter of its own thickness. */
static int thin_and_strained(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double large = 0.1;

    if (!(rb_rolling_has_thickness(rc) && s->max_strain >= large))
        return 0;
    return rb_rolling_write_note(
        text,
        "The thinnest layer, cover or rim is compressed by %.0f %% of its thickness: linear "
        "elasticity is inaccurate there.",
        100.0 * s->max_strain);
}

static int strip_of_ellipse(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->ellipse.radius > 0.0 &&
           rb_rolling_write_note(
               text,
               "The strip through the middle of the ellipse has its half-width and largest "
               "pressure. Stress inside, shakedown (p0/k = 4 for 4.7 of an ellipse without "
               "friction), approach and heat are those of a line contact; forces are per width "
               "there.");
}

/* (E3) Their slopes at no creepage. */
static int slope_of_strips(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double small = 1e-5, told = 0.01;
    double strips, kalker;

    if (!(s->ellipse.radius > 0.0) || !rb_rolling_ellipse_slides_alike(rc))
        return 0;
    rb_rolling_ellipse_forces(rc, small, &strips, &kalker);
    const double more = strips / kalker - 1.0;
    return fabs(more) > told &&
           rb_rolling_write_note(
               text,
               "At small creepage strips give %.2g %% %s creep force than the ellipse, by "
               "Kalker's C11; ellipse_force_kalker has its slope.",
               100.0 * fabs(more), more < 0.0 ? "less" : "more");
}

/* A cover of radius R under P rolls freely at a creepage above that of the flat layer by
 * k P/(E R): k follows nu, and friction that lets the surface slide everywhere makes it
 * twice as large as one that holds it.  Measured on covers of t/R = 0.01 to 0.2 with a/t =
 * 0.6 to 3.5 (docs/cookbook.md). */
static int flat_layer(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double thick = 0.01, held = 0.45, free_to_slide = 1.25;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    const double P = rb_unit_stored(s->units, "N/mm", s->normal_load);
    double shift = 0.0, thickest[2] = {0.0, 0.0};

    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const double R = fabs(bodies[b]->radius), t = bodies[b]->stack ? 0.0 : bodies[b]->layer;
        if (rc->formulation == RB_STATIC || !(t > 0.0) || !isfinite(R) || t < thick * R ||
            bodies[b]->layer_base == RB_BASE_SMOOTH) /* a strip, and no cover */
            continue;
        thickest[b] = t / R;
        shift +=
            (b ? -1.0 : 1.0) * (0.075 + 0.45 * bodies[b]->poisson) * P / (bodies[b]->young * R);
    }
    const int both = thickest[0] > 0.0 && thickest[1] > 0.0, b = !(thickest[0] > 0.0);
    if (thickest[b] == 0.0)
        return 0;
    return rb_rolling_write_note(
        text,
        "The layer%s computed as flat at thickness/R = %.2g. %s at a creepage that is %s by "
        "about %.2g (much friction) to %.2g (little); see --cover-thickness%s.",
        both ? "s are"
        : b  ? " of B is"
             : " is",
        thickest[b], both ? "Round covers roll freely" : "A round cover rolls freely",
        shift < 0.0 ? "lower" : "higher", held * fabs(shift), free_to_slide * fabs(shift),
        b ? "-b" : "");
}

/* Then the flexibility is indefinite; rolling steadily under a load takes differences of
 * displacements alone. */
static int near_datum(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double a = rb_unit_stored(s->units, "mm", s->half_width);
    const int shifted = rc->formulation == RB_STATIC && rb_rolling_largest_mu(rc) > 0.0 &&
                        !rb_rolling_force_is_given(rc);

    const int rises = !shifted && isnan(rc->approach);

    if (!(a > 0.0) || (rises && !(s->approach < 0.0)))
        return 0;
    if (rb_rolling_mean_compliance(rc, &rc->a, a, shifted) +
            (rc->elastic_b ? rb_rolling_mean_compliance(rc, &rc->b, a, shifted) : 0.0) >=
        0.0)
        return 0;
    if (rises)
        return rb_rolling_write_note(
            text, "The approach is negative: the datum, the distance along the surface from "
                  "which it is measured, is too near. Give a larger --datum.");
    return rb_rolling_write_note(
        text,
        "The datum, the distance of zero displacement, is so near that uniform tractions move "
        "the surface against themselves: other solutions exist for the same %s. Give a "
        "larger --datum.",
        shifted ? "shift" : "approach");
}

static int base_pulls(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double small = 0.01;
    double most = 0.0;

    if (!rb_rolling_slides_on_base(rc) || !(s->max_pressure > 0.0) || rc->period > 0.0)
        return 0;
    if (rc->a.layer_base == RB_BASE_SMOOTH)
        most = rb_rolling_tension_of_base(rc, &rc->a, s, 1.0);
    if (rc->elastic_b && rc->b.layer_base == RB_BASE_SMOOTH)
        most = fmax(most, rb_rolling_tension_of_base(rc, &rc->b, s, -1.0));
    if (isnan(most))
        return RB_NOTE_NO_MEMORY;
    return most > small * s->max_pressure &&
           rb_rolling_write_note(
               text,
               "Beside the contact the smooth base pulls at its layer, with up to %.2g p0. "
               "In a strip between two equal rolls that is the stress of the middle plane; a "
               "layer that nothing holds down would lift off there.",
               most / s->max_pressure);
}

const rb_rolling_note rb_rolling_notes_on_models[] = {
    {"wide-arc", wide_arc, RB_NOTE_EVERYWHERE},
    {"strains", strains, RB_NOTE_EVERYWHERE},
    {"large-tilt", large_tilt, RB_NOTE_EVERYWHERE},
    {"thin-and-strained", thin_and_strained, RB_NOTE_EVERYWHERE},
    {"strip-of-ellipse", strip_of_ellipse, RB_NOTE_EVERYWHERE},
    {"slope-of-strips", slope_of_strips, RB_NOTE_EVERYWHERE},
    {"flat-layer", flat_layer, RB_NOTE_EVERYWHERE},
    {"near-datum", near_datum, RB_NOTE_EVERYWHERE},
    {"base-pulls", base_pulls, RB_NOTE_EVERYWHERE},
};
