/* Notes on the answer: where it is not unique, its zones and edges, slip and dissipation. */
#include "base/units.h"
#include "rolling/body/internal.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"
#include "rolling/notes/note.h"
#include "rolling/solve/patches.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <math.h>

/* An element by itself has other states from kappa = 1 on, several together a little
 * earlier (theory-rolling.md F3). */
static const double not_unique = 0.95;

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

/* Beyond full sliding the force does not change: it does not tell the creepage.  At the end
 * of a range of solutions an element sticks whose friction is at its bound. */
static int not_unique_motion(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const int held =
        s->stick - rb_rolling_count_at_bound(rc, s->n, s->zone, s->p, s->q, s->mu, rc->mu);

    if (!rb_rolling_force_is_given(rc) || held > 0 || s->contact == 0 ||
        (s->yielding > 0 && rb_rolling_carries_more_with_slip(rc)) ||
        !(rb_rolling_largest_mu(rc) > 0.0) || rb_rolling_law_depends_on_state(rc))
        return 0;
    if (rb_rolling_slips_both_ways(s->n, s->zone))
        return rb_rolling_write_note(
            text,
            "%s slide towards both sides: the %s is not unique, a range of it gives the "
            "same tractions.",
            s->stick == 0 ? "No element sticks, and they"
                          : "What sticks is at the bound of its friction, and the others",
            s->formulation == RB_STATIC ? "shift" : "creepage");
    return s->formulation != RB_STATIC &&
           rb_rolling_write_note(
               text,
               "The whole contact slides: the creepage is not unique, every one beyond it gives "
               "the same force.");
}

static int steep_fall(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->kappa > not_unique &&
           rb_rolling_write_note(
               text,
               "Friction falls so steeply with the slip velocity (kappa = %.3g) that other "
               "solutions may exist; the start decides which one is found.",
               s->kappa);
}

static int angle_of_arc(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation != RB_STATIC && !rb_rolling_can(rc, RB_BODY_TURNS) &&
           rb_rolling_write_note(
               text, "On an arc support the answer depends on the angle of the wheel; --support "
                     "hub and halfplane do not have this.");
}

static int yields(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->yielding > 0 &&
           rb_rolling_write_note(
               text, "The interface yields: zone 4 with q < 0, zone 5 with q > 0. The column shift "
                     "is slip and yielding together, plastic is the yielded part.");
}

static int equal_elements(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->equal_instead &&
           rb_rolling_write_note(
               text, "Elements could not be fitted to the contact edges; equal ones were used.");
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
                return rb_rolling_write_note(
                    text,
                    "Only %d element%s the contact that begins at x = %.4g %s: its edges "
                    "are uncertain by one element.",
                    patch->contact, patch->contact == 1 ? " carries" : "s carry", patch->from, mm);
            return is_abrupt(s, patch, side)
                       ? rb_rolling_write_note(
                             text,
                             "The pressure ends abruptly at the edge x = %.4g %s, the position of "
                             "which is uncertain by one element.",
                             x, mm)
                       : rb_rolling_write_note(
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
           rb_rolling_write_note(text, "The dissipation, %.2g %s, is below zero: it is %s.",
                                 s->dissipation, rb_unit_name(s->units, "N/mm"),
                                 rb_rolling_below_zero(rc, s));
}

/* What the force does beside free rolling goes into slip at the trailing edge; the least is
 * no number that is given, which rounding would put on either side. */
static int short_slip(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation == RB_STEADY && s->slipping == 0 && s->stick > 0 &&
           fabs(s->force_ratio) > 1.0001e-3 &&
           rb_rolling_write_note(
               text, "No element slips, and the dissipation is 0: the slip at the trailing edge, "
                     "which the force drives, is shorter than an element; take more of them.");
}

/* Where no creepage is given nobody asks for the slip of (12), which is one of rolling. */
static int slip_violations(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation == RB_STATIC && rb_rolling_creepage_is_given(rc) &&
           rb_rolling_largest_mu(rc) > 0.0 && s->slip_violations > 0 &&
           rb_rolling_write_note(
               text,
               "In %d of %d elements the slip computed afterwards points along the friction, not "
               "against it; for rolling use --formulation steady.",
               s->slip_violations, s->n);
}

const rb_rolling_note rb_rolling_notes_on_answers[] = {
    {"not-unique", not_unique_motion, RB_NOTE_OF_AN_END},
    {"steep-fall", steep_fall, RB_NOTE_EVERYWHERE},
    {"angle-of-arc", angle_of_arc, RB_NOTE_EVERYWHERE},
    {"yields", yields, RB_NOTE_OF_COLUMNS},
    {"equal-elements", equal_elements, RB_NOTE_EVERYWHERE},
    {"uncertain-edge", uncertain_edge, RB_NOTE_EVERYWHERE},
    {"negative-power", negative_power, RB_NOTE_EVERYWHERE},
    {"short-slip", short_slip, RB_NOTE_EVERYWHERE},
    {"slip-violations", slip_violations, RB_NOTE_OF_COLUMNS},
};
