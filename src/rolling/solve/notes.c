/* Notes on how to read a result; notes that change its meaning come first. */
#include "rolling/solve/results.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* Strains are of the order of approach/R and a/R: from these on linear elasticity is
 * inaccurate, from those below it does not hold at all. */
static const double inaccurate_approach = 0.02, inaccurate_width = 0.1;
/* An element by itself has other states from kappa = 1 on, several together a little
 * earlier (theory.md F3). */
static const double not_unique = 0.95;
static const double broken_approach = 0.1, broken_width = 0.3;

RB_PRINTF(2, 3)
static void add(rb_rolling_note_list *list, const char *format, ...)
{
    va_list args;
    if (list->n == RB_ROLLING_NOTES)
        return;
    void *before = rb_locale_begin();
    va_start(args, format);
    vsnprintf(list->text[list->n++], sizeof list->text[0], format, args);
    va_end(args);
    rb_locale_end(before);
}

const char *rb_rolling_below_zero(const rb_rolling_case *rc)
{
    /* steps need equal elements */
    return rc && (rc->mesh == RB_MESH_ALIGNED || rb_rolling_has_steps(rc))
               ? "smaller than its error on these elements; take more of them"
               : "smaller than its error on these elements; take more of them or --mesh aligned";
}

int rb_rolling_is_below_zero(double dissipation, double load)
{
    return dissipation < -1e-12 * load;
}

static void note_strain(rb_rolling_note_list *list, const rb_rolling_case *rc,
                        const rb_rolling_solution *s)
{
    double widest = s->patches > 0 ? 0.0 : s->half_width;
    for (int k = 0; k < s->patches; k++)
        widest = fmax(widest, 0.5 * (s->patch[k].to - s->patch[k].from));
    const double radius = rb_unit_shown(s->units, "mm", rc->a.radius);
    const double approach = s->approach / radius;
    /* in a bore a wide arc is little strain, and a part of a circle instead of a plane */
    const int bore = rc->b.radius < 0.0;
    const double width =
        widest / (bore ? rb_unit_shown(s->units, "mm", rb_rolling_derive(rc).radius) : radius);
    if (bore && widest > inaccurate_width * radius)
        add(list,
            "The contact spans %.3g degrees of the journal. Half-planes hold for small arcs: "
            "expect errors of the order (a/R)^2 = %.2g.",
            360.0 / acos(-1.0) * asin(fmin(widest / radius, 1.0)),
            widest / radius * (widest / radius));
    if (approach > broken_approach || width > broken_width)
        add(list,
            "The strains are far beyond linear elasticity (approach = %.2g R, a = %.2g R): treat "
            "the numbers as a test problem.",
            approach, width);
    else if (approach > inaccurate_approach || width > inaccurate_width)
        add(list,
            "The strains are large for linear elasticity (approach = %.2g R, a = %.2g R): expect "
            "errors of that order.",
            approach, width);
}

/* Bodies that relax roll by an element in a step.  Overshoot: what the displacement by the
 * pressure before a step grows in it, as a part of the glassy one (V6); beyond 1 the
 * pressure behind it would have to pull under a given approach. */
static void note_short_memory(rb_rolling_note_list *list, const rb_rolling_case *rc,
                              const rb_rolling_solution *s)
{
    static const double much = 0.8;
    const int rolls = rc->formulation == RB_TRANSIENT;

    if (rc->formulation == RB_STEADY || !isnan(s->load_error) || s->n == 0)
        return;
    const double step = rolls ? rb_unit_stored(s->units, "mm", s->h[0]) / rc->speed : rc->time_step;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};
    double glassy = 0.0, left = 0.0;

    for (int b = 0; b < 1 + rc->elastic_b; b++) {
        const rb_bem_material material = rb_rolling_material(rc, bodies[b]);
        const double compliance = (1.0 - material.poisson) / material.shear;
        glassy += compliance;
        for (int k = 0; k < bodies[b]->memory.n && step > 0.0; k++)
            left += compliance * bodies[b]->memory.ratio[k] *
                    rb_bem_fading_over(bodies[b]->memory.time[k], step).before;
    }
    const double overshoot = left / glassy;
    if (overshoot > much)
        add(list,
            "In one step (%s%.2g s) the bodies relax so much that under the given approach the "
            "pressure may fall too far, to zero even, and come back: take %.2g %s.",
            rolls ? "one element, " : "", step,
            rolls ? ceil(2.0 * overshoot) : 0.5 * step / overshoot,
            rolls ? "times as many --contact-elements" : "s as --time-step");
}

static void note_corners(rb_rolling_note_list *list, const rb_rolling_case *rc,
                         const rb_rolling_solution *s)
{
    static const double much = 0.02;
    double longest = 0.0;

    for (int i = 0; i < s->n; i++)
        if (s->p[i] > 0.0)
            longest = fmax(longest, rb_unit_stored(s->units, "mm", s->h[i]));
    if (!(longest > 0.0))
        return;
    const double rise = rb_unit_shown(
        s->units, "MPa",
        rb_rolling_rise_at_corners(rc, rb_unit_stored(s->units, "mm", s->contact_from),
                                   rb_unit_stored(s->units, "mm", s->contact_to), longest, 2.0));
    if (rise > much * s->max_pressure)
        add(list,
            "The worn table has corners in the contact, where the pressure is infinite: p0 rises "
            "by %.2g %s each time the elements are halved. Give the table more rows.",
            rise, rb_unit_name(s->units, "MPa"));
}

/* How far a uniform traction of one on a strip of half-width a moves it on average, times pi:
 * positive unless the datum, from which displacements are measured, is too near.  Beyond
 * the length that a stiff layer stretches or bends over the base moves alone. */
static double mean_compliance(const rb_rolling_case *rc, const rb_rolling_body *body, double a,
                              int along)
{
    const double mean = 2.0 * exp(-1.5) * a; /* of the distances within the strip */
    const double given = rb_rolling_datum(rc, body), radius = fabs(body->radius);
    const double datum =
        isfinite(given) ? given : 2.0 / exp(1.0) * (isfinite(radius) ? radius : rc->a.radius);
    const rb_bem_material own = rb_rolling_material(rc, body);
    const double of_own = (1.0 - own.poisson) / own.shear;

    if (!(body->layer > 0.0)) {
        /* what relaxes does so within V tau */
        double all = of_own * log(datum / mean);
        for (int k = 0; k < body->memory.n && rc->formulation == RB_STEADY; k++)
            all += of_own * body->memory.ratio[k] *
                   log(datum / fmax(mean, rc->speed * body->memory.time[k]));
        return all;
    }
    const double thickness = fmax(body->layer, mean), of_layer = of_own * log(thickness / mean);
    if (!(body->base_young > 0.0))
        return of_layer;
    const rb_bem_material base = rb_rolling_base_material(rc, body);
    const double of_base = (1.0 - base.poisson) / base.shear, ratio = of_base / of_own;
    const double length = thickness * fmax(1.0, along ? ratio : cbrt(ratio));
    return of_layer + of_base * log(datum / length);
}

/* Then the flexibility is indefinite; rolling steadily under a load takes differences of
 * displacements alone. */
static void note_datum(rb_rolling_note_list *list, const rb_rolling_case *rc,
                       const rb_rolling_solution *s)
{
    const double a = rb_unit_stored(s->units, "mm", s->half_width);
    const int shifted = rc->formulation == RB_STATIC && rb_rolling_largest_mu(rc) > 0.0 &&
                        !rb_rolling_force_is_given(rc);

    const int rises = !shifted && isnan(rc->approach);

    if (!(a > 0.0) || (rises && !(s->approach < 0.0)))
        return;
    if (mean_compliance(rc, &rc->a, a, shifted) +
            (rc->elastic_b ? mean_compliance(rc, &rc->b, a, shifted) : 0.0) >=
        0.0)
        return;
    if (rises)
        add(list, "The approach is negative: the datum, the depth of zero displacement from which "
                  "it is measured, is too near. Give a larger --datum.");
    else
        add(list,
            "The datum, the depth of zero displacement, is so near that uniform tractions move the "
            "surface against themselves: other solutions exist for the same %s. Give a larger "
            "--datum.",
            shifted ? "shift" : "approach");
}

rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    rb_rolling_note_list list = {.n = 0};
    note_strain(&list, rc, s);
    /* What a layer, cover or rim bears is a matter of its own thickness. */
    static const double large = 0.1, thick = 0.01;
    const rb_rolling_body *const bodies[] = {&rc->a, &rc->b};

    if (rb_rolling_has_thickness(rc) && s->max_strain >= large)
        add(&list,
            "the thinnest layer, cover or rim is compressed by %.0f %% of its thickness: linear "
            "elasticity is inaccurate there",
            100.0 * s->max_strain);
    for (int b = 0; b < 1 + rc->elastic_b; b++)
        if (rc->formulation != RB_STATIC && bodies[b]->layer > 0.0 && isfinite(bodies[b]->radius) &&
            bodies[b]->layer >= thick * fabs(bodies[b]->radius))
            add(&list,
                "layer%s: computed as flat at thickness/R = %.2g; the free creepage of a round "
                "cover differs by about %.0f %%, see --cover-thickness%s",
                b ? " of B" : "", bodies[b]->layer / fabs(bodies[b]->radius),
                280.0 * bodies[b]->layer / fabs(bodies[b]->radius), b ? "-b" : "");
    note_datum(&list, rc, s);
    note_short_memory(&list, rc, s);
    note_corners(&list, rc, s);
    const int creeps = !isnan(rc->creep) || !isnan(rc->creep_ratio);
    const int force = rb_rolling_force_is_given(rc);
    if (rc->formulation == RB_STATIC && creeps)
        add(&list, "In a static case --creep does not change the tractions; use --formulation "
                   "steady to roll.");
    if (rc->formulation == RB_STEADY && !creeps && !force)
        add(&list, "No --creep, --creep-ratio, --force or --force-ratio is given: the wheel rolls "
                   "at creepage 0.");
    /* Given values that look as if they were meant in other units. */
    const int arcs = rc->a.support == RB_BEM_ARC;
    if (rc->formulation == RB_STEADY && !isnan(rc->creep) && fabs(s->creep_ratio) > 20.0)
        add(&list,
            "xi R/(mu a) = %.3g is far beyond full sliding, which begins near 1. If the creepage "
            "is meant in per cent, write --creep %g%%.",
            s->creep_ratio, s->creepage);
    if (arcs && rc->a.arc < 2.0)
        add(&list, "The arc is %g degrees. If it is meant in radians, write --arc %grad.",
            rc->a.arc, rc->a.arc);
    /* Beyond full sliding the force does not change: it does not tell the creepage.  At the end of
     * a range of solutions an element sticks whose friction is at its bound. */
    const double at_bound = 1.0 - 1e-9;
    int held = s->stick, sides = 0;
    for (int i = 0; i < s->n; i++) {
        held -= s->zone[i] == RB_ZONE_STICK &&
                fabs(s->q[i]) >= at_bound * (s->mu ? s->mu[i] : rc->mu) * s->p[i];
        sides |= s->zone[i] == RB_ZONE_SLIP_NEGATIVE   ? 1
                 : s->zone[i] == RB_ZONE_SLIP_POSITIVE ? 2
                                                       : 0;
    }
    const int slides = force && held == 0 && rb_rolling_largest_mu(rc) > 0.0 && s->contact > 0 &&
                       !rb_rolling_law_depends_on_state(rc);
    if (slides && sides == 3)
        add(&list,
            "%s slide towards both sides: the %s is not unique, a range of it gives the same "
            "tractions.",
            s->stick == 0 ? "No element sticks, and they"
                          : "What sticks is at the bound of its friction, and the others",
            s->formulation == RB_STATIC ? "shift" : "creepage");
    else if (slides && s->formulation != RB_STATIC)
        add(&list, "The whole contact slides: the creepage is not unique, every larger one gives "
                   "the same force.");
    if (s->kappa > not_unique)
        add(&list,
            "Friction falls so steeply with the slip velocity (kappa = %.3g) that other solutions "
            "may exist; the start decides which one is found.",
            s->kappa);
    if (rc->formulation != RB_STATIC && !rb_rolling_body_can(&rc->a, RB_BODY_TURNS))
        add(&list, "On an arc support the answer depends on the angle of the wheel; --support hub "
                   "and halfplane do not have this.");
    if (s->yielding > 0)
        add(&list, "The interface yields: zone 4 with q < 0, zone 5 with q > 0. The column shift "
                   "is slip and yielding together, plastic is the yielded part.");
    if (s->equal_instead)
        add(&list,
            "Fitting the mesh to the contact edges did not converge; equal elements were used.");
    if (s->edges_bounded && s->contact > 0)
        add(&list,
            "The pressure ends abruptly at one edge; its position is uncertain by one element.");
    /* Slip between two midpoints that the mean of their tractions does not oppose. */
    if (rb_rolling_is_below_zero(s->dissipation, s->normal_load))
        add(&list, "The dissipation, %.2g %s, is below zero: it is %s.", s->dissipation,
            rb_unit_name(s->units, "N/mm"), rb_rolling_below_zero(rc));
    /* What the force does beside free rolling goes into slip at the trailing edge; the least is no
     * number that is given, which rounding would put on either side. */
    if (rc->formulation == RB_STEADY && s->slipping == 0 && s->stick > 0 &&
        fabs(s->force_ratio) > 1.0001e-3)
        add(&list, "No element slips, and the dissipation is 0: the slip at the trailing edge, "
                   "which the force drives, is shorter than an element; take more of them.");
    if (rc->formulation == RB_STATIC && rb_rolling_largest_mu(rc) > 0.0 && s->slip_violations > 0)
        add(&list,
            "In %d of %d elements the slip computed afterwards points along the friction, not "
            "against it; for rolling use --formulation steady.",
            s->slip_violations, s->n);
    return list;
}
