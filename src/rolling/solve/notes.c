/* Notes on how to read a result.  Each is a function that computes from the case and the
 * state as solved whether its sentence holds, and writes it; the table at the end has all of
 * them, those that change the meaning of the result first.  tests/test_sentences.c has a case
 * that must say it, and a near one that must not, for each. */
#include "bem/bem.h"
#include "base/units.h"
#include "rolling/body/internal.h"
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "rolling/case/ellipse.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"
#include "rolling/solve/model.h"
#include "rolling/solve/notes.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <gsl/gsl_math.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Strains are of the order of approach/R and a/R: from these on linear elasticity is
 * inaccurate, from those below it does not hold at all. */
static const double inaccurate_approach = 0.02, inaccurate_width = 0.1;
/* An element by itself has other states from kappa = 1 on, several together a little
 * earlier (theory-rolling.md F3). */
static const double not_unique = 0.95;
static const double broken_approach = 0.1, broken_width = 0.3;

/* What a note answers besides 0, it has nothing to say, and 1. */
enum { NO_MEMORY = -1 };

/* Writes the sentence of a note that applies. */
RB_PRINTF(2, 3)
static int write_note(char *text, const char *format, ...)
{
    va_list args;
    void *before = rb_locale_begin();
    va_start(args, format);
    vsnprintf(text, RB_ROLLING_NOTE_LENGTH, format, args);
    va_end(args);
    rb_locale_end(before);
    return 1;
}

const char *rb_rolling_below_zero(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    /* steps need equal elements, and these cannot end at the edges of several patches */
    return rc && (rc->mesh == RB_MESH_ALIGNED || rb_rolling_has_steps(rc) || s->patches > 1)
               ? "smaller than its error on these elements; take more of them"
               : "smaller than its error on these elements; take more of them or --mesh aligned";
}

int rb_rolling_is_below_zero(double dissipation, double load)
{
    return dissipation < -1e-12 * load;
}

/* ---- Strains ----------------------------------------------------------------------- */

static double widest_patch(const rb_rolling_solution *s)
{
    double widest = s->patches > 0 ? 0.0 : s->half_width;

    for (int k = 0; k < s->patches; k++)
        widest = fmax(widest, 0.5 * (s->patch[k].to - s->patch[k].from));
    return widest;
}

static int wide_arc(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double radius = rb_unit_shown(s->units, "mm", rc->a.radius), a = widest_patch(s);
    const int bore = rc->b.radius < 0.0;

    if (!((bore || rc->interlayer_normal > 0.0) && a > inaccurate_width * radius))
        return 0;
    return write_note(text,
                      "The contact spans %.3g degrees of %s. Half-planes hold for small arcs: "
                      "expect errors of the order (a/R)^2 = %.2g.",
                      360.0 / acos(-1.0) * asin(fmin(a / radius, 1.0)),
                      bore ? "the journal" : "body A", a / radius * (a / radius));
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
    double width =
        widest_patch(s) / (rc->b.radius < 0.0 ? rb_unit_shown(s->units, "mm", d.radius) : radius);
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
                   ? write_note(
                         text,
                         "The strains are far beyond linear elasticity (%s): treat the numbers as "
                         "a test problem.",
                         how_large)
                   : write_note(
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
           write_note(text,
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
    return write_note(
        text,
        "The thinnest layer, cover or rim is compressed by %.0f %% of its thickness: linear "
        "elasticity is inaccurate there.",
        100.0 * s->max_strain);
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
    return write_note(
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

/* ---- Bodies that relax, tables, the datum ------------------------------------------ */

/* Bodies that relax roll by an element in a step.  Overshoot: what the displacement by the
 * pressure before a step grows in it, as a part of the glassy one (V6); beyond 1 the
 * pressure behind it would have to pull under a given approach. */
static int short_memory(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double much = 0.8;
    const int rolls = rc->formulation == RB_TRANSIENT;

    if (rc->formulation == RB_STEADY || !isnan(s->load_error) || s->n == 0)
        return 0;
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
    if (!(overshoot > much))
        return 0;
    return write_note(
        text,
        "In one step (%s%.2g s) the bodies relax so much that under the given approach the "
        "pressure may fall too far, to zero even, and come back: take %.2g %s.",
        rolls ? "one element, " : "", step, rolls ? ceil(2.0 * overshoot) : 0.5 * step / overshoot,
        rolls ? "times as many --contact-elements" : "s as --time-step");
}

/* A row of a history at rest, of which more steps did not help. */
static int row_of_steps(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->rows.changed > 0 &&
           write_note(
               text,
               "Row %d of the history is not certain: twice the steps still change its tractions "
               "by %.2g of what the load makes. Give rows between, or --increments.",
               s->rows.changed, s->rows.changes);
}

/* Of friction that falls with the slid distance; kinetic energy is no part of the model. */
static int jumps(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->rows.jumped > 0 &&
           write_note(
               text,
               "In row %d of the history the contact jumps to full sliding, at shift %.4g %s, "
               "force %.4g %s; the energy that is set free is no part of the model.",
               s->rows.jumped, s->rows.jump_shift, rb_unit_name(s->units, "mm"), s->rows.jump_force,
               rb_unit_name(s->units, "N/mm"));
}

/* At rest friction falls with the slid distance, over a length of the surface that elements must
 * show (F6). */
static int coarse_fall(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    double longest = 0.0;

    if (rc->formulation != RB_STATIC || !rb_rolling_law_depends_on_state(rc))
        return 0;
    const double falls = rb_rolling_law_at_rest(rc, 0.0) - rc->mu,
                 p0 = rb_unit_stored(s->units, "MPa", s->max_pressure);
    for (int i = 0; i < s->n; i++)
        if (s->zone[i] > RB_ZONE_STICK)
            longest = fmax(longest, rb_unit_stored(s->units, "mm", s->h[i]));
    const double needs = rc->friction.memory * rb_rolling_derive(rc).modulus / (falls * p0);
    return falls > 0.0 && longest > needs &&
           write_note(
               text,
               "Friction falls over %.2g %s of the surface behind the edge of stick, and the "
               "elements are longer, %.2g %s: give %.0f --contact-elements.",
               rb_unit_shown(s->units, "mm", needs), rb_unit_name(s->units, "mm"),
               rb_unit_shown(s->units, "mm", longest), rb_unit_name(s->units, "mm"),
               ceil(rc->contact_elements * longest / needs));
}

static int stick_edge(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->stick_edge &&
           write_note(
               text,
               "The pressure is singular at the edge of what sticks and does not wear: the largest "
               "value, %.4g %s, belongs to the mesh. Read the pressure in the middle.",
               s->max_pressure, rb_unit_name(s->units, "MPa"));
}

/* A number of corners, at most MOST of them with their places. */
static int list_corners(char *text, const char *option, rb_units units, int corners,
                        const double *x)
{
    enum { MOST = 4 };
    char places[120] = "";

    for (int k = 0; k < corners && k < MOST; k++)
        rb_append(places, sizeof places, "%s%.5g",
                  k == 0                              ? ""
                  : k + 1 == corners || k + 1 == MOST ? " and "
                                                      : ", ",
                  rb_unit_shown(units, "mm", x[k]));
    return corners > 0 &&
           write_note(
               text,
               "The table of --%s has %d corner%s, at x = %s %s%s: the slope of the curve through "
               "its points jumps there.",
               option, corners, corners > 1 ? "s" : "", places, rb_unit_name(units, "mm"),
               corners > MOST ? " and so on" : "");
}

static int tell_few_rows(char *text, const char *option, const rb_rolling_interpolant *curve)
{
    const double *x;
    const int untold = rb_rolling_interpolant_untold(curve);

    return untold > 0 &&
           write_note(text,
                      "The table of --%s has %d rows, too few around %d of them to tell corners "
                      "from curves: what is drawn there stays between its points. Give it more "
                      "rows.",
                      option, rb_rolling_interpolant_rows(curve, &x), untold);
}

static int gap_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double *x = NULL, *bend;
    const int corners =
        rc->gap == RB_GAP_TABLE ? rb_rolling_interpolant_corners(rc->profile->curve, &x, &bend) : 0;

    return list_corners(text, "gap", s->units, corners, x);
}

static int gap_rows(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->gap == RB_GAP_TABLE && tell_few_rows(text, "gap", rc->profile->curve);
}

static int irregularity(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text,
                        int of_rows)
{
    const rb_rolling_table *table = &rc->irregularity;
    const double *x, *bend;
    rb_rolling_interpolant *curve = NULL;

    if (table->n == 0)
        return 0;
    if (rb_rolling_interpolant_create(table->n, table->x, table->y, 0, &curve) != RB_OK)
        return NO_MEMORY;
    const int corners = rb_rolling_interpolant_corners(curve, &x, &bend);
    const int said = of_rows ? tell_few_rows(text, "irregularity", curve)
                             : list_corners(text, "irregularity", s->units, corners, x);
    rb_rolling_interpolant_free(curve);
    return said;
}

static int irregularity_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return irregularity(rc, s, text, 0);
}

static int irregularity_rows(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return irregularity(rc, s, text, 1);
}

/* The elements are too long for the tables of the case. */
static int coarse_elements(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double much = 1.5;
    int wanted;

    if (rb_rolling_elements_for_tables(rc, rc->contact_elements, &wanted) != RB_OK)
        return NO_MEMORY;
    if (!(wanted > much * rc->contact_elements) || s->n >= wanted)
        return 0;
    return write_note(
        text,
        "The tables of the case have shorter waves than the elements show, which see them "
        "at their midpoints alone: give %d --contact-elements for %d.",
        wanted, rc->contact_elements);
}

static int pressed_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double much = 0.02;
    const double rise = rb_unit_shown(s->units, "MPa", rb_rolling_rise_in_patches(rc, s, 2.0));

    return rise > much * s->max_pressure &&
           write_note(
               text,
               "The %s has corners in the contact, where the pressure is infinite: p0 rises by "
               "%.2g %s each time the elements are halved.%s",
               rc->worn.n > 0 ? "worn table" : "gap", rise, rb_unit_name(s->units, "MPa"),
               rc->worn.n > 0 ? " Give the table more rows." : "");
}

static int punch_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->mesh == RB_MESH_PUNCH && s->n > 0 && (s->p[0] > 0.0 || s->p[s->n - 1] > 0.0) &&
           write_note(text,
                      "The punch presses with a corner, where the pressure is infinite: p0 is "
                      "the mean of the last element and grows with their number.");
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
        /* what relaxes does so within V tau, with ln(sqrt(x^2 + d^2)/x), which is positive */
        double all = of_own * log(datum / mean);
        for (int k = 0; k < body->memory.n && rc->formulation == RB_STEADY; k++) {
            const double reach = fmax(mean, rc->speed * body->memory.time[k]);
            all += of_own * body->memory.ratio[k] * log(hypot(1.0, datum / reach));
        }
        return all;
    }
    const rb_bem_material base = rb_rolling_base_material(rc, body);
    const double of_base = (1.0 - base.poisson) / base.shear;
    double of_layers = 0.0, stiffness = 0.0, depth = 0.0; /* against stretching or bending */
    for (int k = 0; k < rb_rolling_layers(body); k++) {
        const double above = depth;
        const rb_rolling_layer_properties layer = rb_rolling_layer_of(body, k);
        const rb_bem_material m =
            body->stack ? rb_bem_material_from_young(layer.young, layer.poisson) : own;
        const double of_layer = (1.0 - m.poisson) / m.shear, ratio = of_base / of_layer;
        depth += layer.thickness;
        of_layers += of_layer * log(fmax(depth, mean) / fmax(above, mean));
        stiffness += ratio * (along ? depth - above : gsl_pow_3(depth) - gsl_pow_3(above));
    }
    if (!(body->base_young > 0.0))
        return of_layers;
    return of_layers +
           of_base * log(datum / fmax(fmax(depth, mean), along ? stiffness : cbrt(stiffness)));
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
    if (mean_compliance(rc, &rc->a, a, shifted) +
            (rc->elastic_b ? mean_compliance(rc, &rc->b, a, shifted) : 0.0) >=
        0.0)
        return 0;
    if (rises)
        return write_note(
            text, "The approach is negative: the datum, the distance along the surface from "
                  "which it is measured, is too near. Give a larger --datum.");
    return write_note(
        text,
        "The datum, the distance of zero displacement, is so near that uniform tractions move "
        "the surface against themselves: other solutions exist for the same %s. Give a "
        "larger --datum.",
        shifted ? "shift" : "approach");
}

/* ---- What a strip does not tell ---------------------------------------------------- */

static int strip_of_ellipse(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->ellipse.radius > 0.0 &&
           write_note(
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
           write_note(text,
                      "At small creepage strips give %.2g %% %s creep force than the ellipse, by "
                      "Kalker's C11; ellipse_force_kalker has its slope.",
                      100.0 * fabs(more), more < 0.0 ? "less" : "more");
}

/* ---- What is given, perhaps in other units ----------------------------------------- */

static int is_creepage_given(const rb_rolling_case *rc)
{
    return !isnan(rc->creep) || !isnan(rc->creep_ratio);
}

static int static_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation == RB_STATIC && is_creepage_given(rc) &&
           write_note(text,
                      "In a static case --creep does not change the tractions; use --formulation "
                      "steady to roll.");
}

static int no_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation == RB_STEADY && !is_creepage_given(rc) &&
           !rb_rolling_force_is_given(rc) &&
           write_note(text,
                      "No --creep, --creep-ratio, --force or --force-ratio is given: the wheel "
                      "rolls at creepage 0.");
}

/* The largest tension across a smooth base (L9), within a few thicknesses of the contact; NAN
 * without memory.  sign: of the friction on the body. */
static double tension_of_base(const rb_rolling_case *rc, const rb_rolling_body *body,
                              const rb_rolling_solution *s, double sign)
{
    enum { POINTS = 60 };
    const double mm = rb_unit_stored(s->units, "mm", 1.0),
                 MPa = rb_unit_stored(s->units, "MPa", 1.0),
                 from = mm * s->contact_from - 4.0 * body->layer,
                 to = mm * s->contact_to + 4.0 * body->layer;
    double length[RB_ROLLING_TERMS], xy[2 * POINTS], stress[3 * POINTS], most = 0.0;
    rb_arena scratch = {0};
    const size_t n = (size_t)s->n;
    double *x = rb_arena_doubles(&scratch, n, 3), *p = x ? x + n : NULL, *q = x ? p + n : NULL;
    rb_bem_layer_field *field = NULL;

    if (!x)
        return NAN;
    for (int i = 0; i < s->n; i++) {
        x[i] = mm * s->x[i];
        p[i] = MPa * s->p[i];
        q[i] = sign * MPa * s->q[i];
    }
    for (int k = 0; k < POINTS; k++) {
        xy[2 * k] = from + k * (to - from) / (POINTS - 1);
        xy[2 * k + 1] = body->layer;
    }
    const rb_bem_surface surface = rb_rolling_halfplane_surface(rc, body, length);
    const rb_bem_edge_load load = {s->n, x, p, q};
    const rb_bem_points points = {POINTS, xy};
    rb_status status = rb_bem_halfplane_stress_linear(&load, points, stress);
    if (status == RB_OK)
        status = rb_bem_layer_field_create(&surface, &load, &field, NULL);
    if (status == RB_OK)
        status = rb_bem_layer_field_add(field, points, stress, NULL);
    rb_bem_layer_field_free(field);
    for (int k = 0; k < POINTS && status == RB_OK; k++)
        most = fmax(most, stress[3 * k + 1]);
    rb_arena_free(&scratch);
    return status == RB_ENOMEM ? NAN : most / MPa;
}

static int base_pulls(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double small = 0.01;
    double most = 0.0;

    if (!rb_rolling_slides_on_base(rc) || !(s->max_pressure > 0.0) || rc->period > 0.0)
        return 0;
    if (rc->a.layer_base == RB_BASE_SMOOTH)
        most = tension_of_base(rc, &rc->a, s, 1.0);
    if (rc->elastic_b && rc->b.layer_base == RB_BASE_SMOOTH)
        most = fmax(most, tension_of_base(rc, &rc->b, s, -1.0));
    if (isnan(most))
        return NO_MEMORY;
    return most > small * s->max_pressure &&
           write_note(
               text,
               "Beside the contact the smooth base pulls at its layer, with up to %.2g p0. "
               "In a strip between two equal rolls that is the stress of the middle plane; a "
               "layer that nothing holds down would lift off there.",
               most / s->max_pressure);
}

static int strained_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation != RB_STATIC && s->bulk_strain != 0.0 &&
           write_note(
               text,
               "The creepage is that of the unstrained bodies: the bulk stresses shift every "
               "creepage by %.4g.",
               s->bulk_strain);
}

static int slips_both_ways(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    int ways = 0;

    for (int i = 0; i < s->n; i++)
        ways |= s->zone[i] == RB_ZONE_SLIP_NEGATIVE   ? 1
                : s->zone[i] == RB_ZONE_SLIP_POSITIVE ? 2
                                                      : 0;
    return rc->formulation == RB_STATIC && rb_rolling_is_strained(rc) && ways == 3 &&
           !rb_rolling_has_steps(rc) &&
           write_note(
               text, "The contact slips in both directions: where it does, friction depends on the "
                     "order in which force and bulk stress came, and in how many steps "
                     "(--increments, --history).");
}

/* The slowest element tells where full sliding begins: its slip is what the creepage may
 * be less, because Coulomb's friction does not change with it. */
static int percent(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double far = 20.0;
    const double side = s->creepage > 0.0 ? 1.0 : -1.0;
    double slowest = INFINITY;

    if (rc->formulation != RB_STEADY || isnan(rc->creep) || s->contact == 0 || s->stick > 0 ||
        s->yielding > 0 || !(rb_rolling_largest_mu(rc) > 0.0) ||
        rb_rolling_law_depends_on_state(rc))
        return 0;
    for (int i = 0; i < s->n; i++)
        if (s->zone[i] != RB_ZONE_SEPARATED)
            slowest = fmin(slowest, side * s->slip[i]);
    const double begins = s->creepage - side * slowest;
    if (!(fabs(s->creepage) > far * fabs(begins)))
        return 0;
    return write_note(
        text,
        "xi = %.3g is far beyond full sliding, which begins at %.3g. If the creepage is "
        "meant in per cent, write --creep %g%%.",
        s->creepage, begins, s->creepage);
}

static int radians(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->a.support == RB_BEM_ARC && rc->a.arc < 2.0 &&
           write_note(text, "The arc is %g degrees. If it is meant in radians, write --arc %grad.",
                      rc->a.arc, rc->a.arc);
}

/* Numbers in m, N and Pa that are taken for mm, N and MPa: a pressure that nothing bears (diamond's
 * hardness is 1e5 MPa), or a stiff body that a load presses flat. */
static int other_units(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double hardest = 1e5, stiff = 1e3, flat = 0.5, width = widest_patch(s) / rc->a.radius;
    static const char ask[] = "If the numbers are in m, N/m and Pa, write --units si; a number may "
                              "also have its unit, as 210GPa or 500kN/m.";

    if (s->units != RB_UNITS_MM)
        return 0;
    if (s->max_pressure > hardest)
        return write_note(text, "p0 = %.3g MPa is more than diamond bears, %.3g MPa. %s",
                          s->max_pressure, hardest, ask);
    return !isnan(rc->load) && rc->a.young > stiff && rc->gap != RB_GAP_TABLE &&
           rc->b.radius > 0.0 && !(rc->interlayer_normal > 0.0) && width > flat &&
           write_note(text, "The load presses a stiff body flat (a = %.2g R). %s", width, ask);
}

/* ---- What is not unique ------------------------------------------------------------ */

/* Beyond full sliding the force does not change: it does not tell the creepage.  At the end
 * of a range of solutions an element sticks whose friction is at its bound.  An interface that
 * hardens carries more with more slip. */
static int not_unique_motion(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double at_bound = 1.0 - 1e-9;
    int held = s->stick, sides = 0;

    for (int i = 0; i < s->n; i++) {
        held -= s->zone[i] == RB_ZONE_STICK &&
                fabs(s->q[i]) >= at_bound * (s->mu ? s->mu[i] : rc->mu) * s->p[i];
        sides |= s->zone[i] == RB_ZONE_SLIP_NEGATIVE   ? 1
                 : s->zone[i] == RB_ZONE_SLIP_POSITIVE ? 2
                                                       : 0;
    }
    if (!rb_rolling_force_is_given(rc) || held > 0 || s->contact == 0 || s->yielding > 0 ||
        !(rb_rolling_largest_mu(rc) > 0.0) || rb_rolling_law_depends_on_state(rc))
        return 0;
    if (sides == 3)
        return write_note(
            text,
            "%s slide towards both sides: the %s is not unique, a range of it gives the "
            "same tractions.",
            s->stick == 0 ? "No element sticks, and they"
                          : "What sticks is at the bound of its friction, and the others",
            s->formulation == RB_STATIC ? "shift" : "creepage");
    return s->formulation != RB_STATIC &&
           write_note(
               text,
               "The whole contact slides: the creepage is not unique, every one beyond it gives "
               "the same force.");
}

static int steep_fall(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->kappa > not_unique &&
           write_note(text,
                      "Friction falls so steeply with the slip velocity (kappa = %.3g) that other "
                      "solutions may exist; the start decides which one is found.",
                      s->kappa);
}

static int angle_of_arc(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation != RB_STATIC && !rb_rolling_can(rc, RB_BODY_TURNS) &&
           write_note(text,
                      "On an arc support the answer depends on the angle of the wheel; --support "
                      "hub and halfplane do not have this.");
}

/* ---- Zones, edges, slip ------------------------------------------------------------ */

static int yields(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->yielding > 0 &&
           write_note(
               text, "The interface yields: zone 4 with q < 0, zone 5 with q > 0. The column shift "
                     "is slip and yielding together, plastic is the yielded part.");
}

static int equal_elements(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->equal_instead &&
           write_note(text,
                      "Elements could not be fitted to the contact edges; equal ones were used.");
}

/* Whether the pressure stops falling towards this edge of the patch, as at a corner. */
static int is_abrupt(const rb_rolling_solution *s, const rb_rolling_patch *patch, int side)
{
    int outer = side > 0 ? s->n - 1 : 0;

    while (outer >= 0 && outer < s->n &&
           (s->zone[outer] == RB_ZONE_SEPARATED ||
            side * s->x[outer] > side * (side > 0 ? patch->to : patch->from)))
        outer -= side;
    const int next = outer - side, further = next - side;
    return further >= 0 && further < s->n && s->p[next] >= s->p[further];
}

/* The first edge that is only known to an element, and why. */
static int uncertain_edge(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    for (int k = 0; k < s->patches; k++)
        for (int side = -1; side <= 1; side += 2) {
            const rb_rolling_patch *patch = &s->patch[k];
            if (!(patch->bounded & (side < 0 ? RB_LEFT_BOUNDED : RB_RIGHT_BOUNDED)))
                continue;
            const double x = side < 0 ? patch->from : patch->to;
            const char *mm = rb_unit_name(s->units, "mm");
            if (patch->contact < RB_ROLLING_PATCH_LEAST)
                return write_note(
                    text,
                    "Only %d element%s the contact that begins at x = %.4g %s: its edges "
                    "are uncertain by one element.",
                    patch->contact, patch->contact == 1 ? " carries" : "s carry", patch->from, mm);
            return is_abrupt(s, patch, side)
                       ? write_note(
                             text,
                             "The pressure ends abruptly at the edge x = %.4g %s, the position of "
                             "which is uncertain by one element.",
                             x, mm)
                       : write_note(
                             text,
                             "The edge at x = %.4g %s is uncertain by one element: the pressure "
                             "beside it does not follow the power law of a smooth edge.",
                             x, mm);
        }
    return 0;
}

/* Slip between two midpoints that the mean of their tractions does not oppose. */
static int negative_power(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rb_rolling_is_below_zero(s->dissipation, s->normal_load) &&
           write_note(text, "The dissipation, %.2g %s, is below zero: it is %s.", s->dissipation,
                      rb_unit_name(s->units, "N/mm"), rb_rolling_below_zero(rc, s));
}

/* What the force does beside free rolling goes into slip at the trailing edge; the least is
 * no number that is given, which rounding would put on either side. */
static int short_slip(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation == RB_STEADY && s->slipping == 0 && s->stick > 0 &&
           fabs(s->force_ratio) > 1.0001e-3 &&
           write_note(text,
                      "No element slips, and the dissipation is 0: the slip at the trailing edge, "
                      "which the force drives, is shorter than an element; take more of them.");
}

/* Where no creepage is given nobody asks for the slip of (12), which is one of rolling. */
static int slip_violations(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation == RB_STATIC && is_creepage_given(rc) &&
           rb_rolling_largest_mu(rc) > 0.0 && s->slip_violations > 0 &&
           write_note(
               text,
               "In %d of %d elements the slip computed afterwards points along the friction, not "
               "against it; for rolling use --formulation steady.",
               s->slip_violations, s->n);
}

/* ---- All of them ------------------------------------------------------------------- */

static const struct {
    const char *name;
    int (*says)(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text);
    int of_columns; /* 1: how the columns of the table of tractions must be read */
} all_notes[] = {
    {"wide-arc", wide_arc, 0},
    {"strains", strains, 0},
    {"large-tilt", large_tilt, 0},
    {"thin-and-strained", thin_and_strained, 0},
    {"strip-of-ellipse", strip_of_ellipse, 0},
    {"slope-of-strips", slope_of_strips, 0},
    {"flat-layer", flat_layer, 0},
    {"near-datum", near_datum, 0},
    {"base-pulls", base_pulls, 0},
    {"short-memory", short_memory, 0},
    {"row-of-steps", row_of_steps, 0},
    {"jumps", jumps, 0},
    {"coarse-fall", coarse_fall, 0},
    {"stick-edge", stick_edge, 0},
    {"gap-corners", gap_corners, 0},
    {"irregularity-corners", irregularity_corners, 0},
    {"gap-rows", gap_rows, 0},
    {"irregularity-rows", irregularity_rows, 0},
    {"coarse-elements", coarse_elements, 0},
    {"pressed-corners", pressed_corners, 0},
    {"punch-corners", punch_corners, 0},
    {"static-creepage", static_creepage, 0},
    {"no-creepage", no_creepage, 0},
    {"strained-creepage", strained_creepage, 0},
    {"slips-both-ways", slips_both_ways, 0},
    {"percent", percent, 0},
    {"radians", radians, 0},
    {"other-units", other_units, 0},
    {"not-unique", not_unique_motion, 0},
    {"steep-fall", steep_fall, 0},
    {"angle-of-arc", angle_of_arc, 0},
    {"yields", yields, 1},
    {"equal-elements", equal_elements, 0},
    {"uncertain-edge", uncertain_edge, 0},
    {"negative-power", negative_power, 0},
    {"short-slip", short_slip, 0},
    {"slip-violations", slip_violations, 1},
};

enum { NOTES = sizeof all_notes / sizeof *all_notes };
_Static_assert((int)NOTES <= (int)RB_ROLLING_OWN_NOTES, "kinds of the callers come behind");

const char *rb_rolling_note_name(int k)
{
    return k >= 0 && k < NOTES ? all_notes[k].name : NULL;
}

const char rb_rolling_notes_missing[] = "Notes on this result may be missing: out of memory.";

rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    rb_rolling_note_list list = {.n = 0};

    for (int k = 0; k < NOTES; k++) {
        const int said = all_notes[k].says(rc, s, list.text[list.n]);
        if (said == NO_MEMORY)
            list.status = RB_ENOMEM;
        else if (said)
            list.kind[list.n++] = k;
    }
    return list;
}

rb_rolling_row_notes rb_rolling_find_row_notes(const rb_rolling_case *rc,
                                               const rb_rolling_solution *s)
{
    const rb_rolling_note_list found = rb_rolling_find_notes(rc, s);
    rb_rolling_row_notes row = {.n = 0, .status = found.status};

    for (int k = 0; k < found.n; k++)
        if (!all_notes[found.kind[k]].of_columns)
            rb_rolling_add_note(&row, found.kind[k], found.text[k]);
    return row;
}
