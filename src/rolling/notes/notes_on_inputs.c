/* Notes on what is given: not used, not enough, or perhaps in other units. */
#include "base/units.h"
#include "rolling/body/internal.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"
#include "rolling/notes/note.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <math.h>

static int static_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation == RB_STATIC && rb_rolling_creepage_is_given(rc) &&
           rb_rolling_write_note(
               text, "In a static case --creep does not change the tractions; use --formulation "
                     "steady to roll.");
}

static int no_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->formulation == RB_STEADY && !rb_rolling_creepage_is_given(rc) &&
           !rb_rolling_force_is_given(rc) &&
           rb_rolling_write_note(
               text, "No --creep, --creep-ratio, --force or --force-ratio is given: the wheel "
                     "rolls at creepage 0.");
}

static int strained_creepage(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation != RB_STATIC && s->bulk_strain != 0.0 &&
           rb_rolling_write_note(
               text,
               "The creepage is that of the unstrained bodies: the bulk stresses shift every "
               "creepage by %.4g.",
               s->bulk_strain);
}

static int slips_both_ways(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->formulation == RB_STATIC && rb_rolling_is_strained(rc) &&
           rb_rolling_slips_both_ways(s->n, s->zone) && !rb_rolling_has_steps(rc) &&
           rb_rolling_write_note(
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
    return rb_rolling_write_note(
        text,
        "xi = %.3g is far beyond full sliding, which begins at %.3g. If the creepage is "
        "meant in per cent, write --creep %g%%.",
        s->creepage, begins, s->creepage);
}

static int radians(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)s;
    return rc->a.support == RB_BEM_ARC && rc->a.arc < 2.0 &&
           rb_rolling_write_note(
               text, "The arc is %g degrees. If it is meant in radians, write --arc %grad.",
               rc->a.arc, rc->a.arc);
}

/* Numbers in m, N and Pa that are taken for mm, N and MPa: a pressure that nothing bears (diamond's
 * hardness is 1e5 MPa), or a stiff body that a load presses flat. */
static int other_units(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    const double hardest = 1e5, stiff = 1e3, flat = 0.5,
                 width = rb_rolling_widest_patch(s) / rc->a.radius;
    static const char ask[] = "If the numbers are in m, N/m and Pa, write --units si; a number may "
                              "also have its unit, as 210GPa or 500kN/m.";

    if (s->units != RB_UNITS_MM)
        return 0;
    if (s->max_pressure > hardest)
        return rb_rolling_write_note(text, "p0 = %.3g MPa is more than diamond bears, %.3g MPa. %s",
                                     s->max_pressure, hardest, ask);
    return !isnan(rc->load) && rc->a.young > stiff && rc->gap != RB_GAP_TABLE &&
           rc->b.radius > 0.0 && !(rc->interlayer_normal > 0.0) && width > flat &&
           rb_rolling_write_note(text, "The load presses a stiff body flat (a = %.2g R). %s", width,
                                 ask);
}

const rb_rolling_note rb_rolling_notes_on_inputs[] = {
    {"static-creepage", static_creepage, RB_NOTE_EVERYWHERE},
    {"no-creepage", no_creepage, RB_NOTE_EVERYWHERE},
    {"strained-creepage", strained_creepage, RB_NOTE_EVERYWHERE},
    {"slips-both-ways", slips_both_ways, RB_NOTE_EVERYWHERE},
    {"percent", percent, RB_NOTE_EVERYWHERE},
    {"radians", radians, RB_NOTE_EVERYWHERE},
    {"other-units", other_units, RB_NOTE_EVERYWHERE},
};
