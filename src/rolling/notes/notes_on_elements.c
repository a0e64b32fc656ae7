/* Notes on elements that are too long, and on corners, at which the pressure is infinite. */
#include "base/units.h"
#include "rolling/body/interpolant.h"
#include "rolling/body/mesh.h"
#include "rolling/case/internal.h"
#include "rolling/solve/law.h"
#include "rolling/notes/note.h"
#include "rolling/solve/resolution.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <math.h>

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
           rb_rolling_write_note(
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
           rb_rolling_write_note(
               text,
               "The pressure is singular at the edge of what sticks and does not wear: the largest "
               "value, %.4g %s, belongs to the mesh. Read the pressure in the middle.",
               s->max_pressure, rb_unit_name(s->units, "MPa"));
}

/* A number of corners, at most MOST of them with their places. */
static int say_corners(char *text, const char *option, rb_units units,
                       const rb_rolling_interpolant *curve)
{
    enum { MOST = 4 };
    char places[120] = "";
    const double *x, *bend;
    const int corners = rb_rolling_interpolant_corners(curve, &x, &bend);

    for (int k = 0; k < corners && k < MOST; k++)
        rb_append(places, sizeof places, "%s%.5g",
                  k == 0                              ? ""
                  : k + 1 == corners || k + 1 == MOST ? " and "
                                                      : ", ",
                  rb_unit_shown(units, "mm", x[k]));
    return corners > 0 &&
           rb_rolling_write_note(
               text,
               "The table of --%s has %d corner%s, at x = %s %s%s: the slope of the curve through "
               "its points jumps there.",
               option, corners, corners > 1 ? "s" : "", places, rb_unit_name(units, "mm"),
               corners > MOST ? " and so on" : "");
}

/* A table of so few rows that corners cannot be told from curves. */
static int say_few_rows(char *text, const char *option, rb_units units,
                        const rb_rolling_interpolant *curve)
{
    const double *x;
    const int untold = rb_rolling_interpolant_untold(curve);

    (void)units;
    return untold > 0 &&
           rb_rolling_write_note(
               text,
               "The table of --%s has %d rows, too few around %d of them to tell corners "
               "from curves: what is drawn there stays between its points. Give it more "
               "rows.",
               option, rb_rolling_interpolant_rows(curve, &x), untold);
}

static int gap_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->gap == RB_GAP_TABLE && say_corners(text, "gap", s->units, rc->profile->curve);
}

static int gap_rows(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rc->gap == RB_GAP_TABLE && say_few_rows(text, "gap", s->units, rc->profile->curve);
}

/* One of the two sentences above about the table of --irregularity. */
static int irregularity(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text,
                        int (*say)(char *text, const char *option, rb_units units,
                                   const rb_rolling_interpolant *curve))
{
    const rb_rolling_table *table = &rc->irregularity;
    rb_rolling_interpolant *curve = NULL;

    if (table->n == 0)
        return 0;
    if (rb_rolling_interpolant_create(table->n, table->x, table->y, 0, &curve) != RB_OK)
        return RB_NOTE_NO_MEMORY;
    const int said = say(text, "irregularity", s->units, curve);
    rb_rolling_interpolant_free(curve);
    return said;
}

static int irregularity_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return irregularity(rc, s, text, say_corners);
}

static int irregularity_rows(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return irregularity(rc, s, text, say_few_rows);
}

/* The elements are too long for the tables of the case. */
static int coarse_elements(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    static const double much = 1.5;
    int wanted;

    if (rb_rolling_elements_for_tables(rc, rc->contact_elements, &wanted) != RB_OK)
        return RB_NOTE_NO_MEMORY;
    if (!(wanted > much * rc->contact_elements) || s->n >= wanted)
        return 0;
    return rb_rolling_write_note(
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
           rb_rolling_write_note(
               text,
               "The %s has corners in the contact, where the pressure is infinite: p0 rises by "
               "%.2g %s each time the elements are halved.%s",
               rc->worn.n > 0 ? "worn table" : "gap", rise, rb_unit_name(s->units, "MPa"),
               rc->worn.n > 0 ? " Give the table more rows." : "");
}

static int punch_corners(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    return rb_rolling_presses_with_end(rc, s) &&
           rb_rolling_write_note(
               text, "The punch presses with a corner, where the pressure is infinite: p0 is "
                     "the mean of the last element and grows with their number.");
}

const rb_rolling_note rb_rolling_notes_on_elements[] = {
    {"coarse-fall", coarse_fall, RB_NOTE_EVERYWHERE},
    {"stick-edge", stick_edge, RB_NOTE_EVERYWHERE},
    {"gap-corners", gap_corners, RB_NOTE_EVERYWHERE},
    {"irregularity-corners", irregularity_corners, RB_NOTE_EVERYWHERE},
    {"gap-rows", gap_rows, RB_NOTE_EVERYWHERE},
    {"irregularity-rows", irregularity_rows, RB_NOTE_EVERYWHERE},
    {"coarse-elements", coarse_elements, RB_NOTE_EVERYWHERE},
    {"pressed-corners", pressed_corners, RB_NOTE_EVERYWHERE},
    {"punch-corners", punch_corners, RB_NOTE_EVERYWHERE},
};
