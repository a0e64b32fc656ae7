/* Notes on steps in time and along a history. */
#include "bem/bem.h"
#include "base/units.h"
#include "rolling/body/internal.h"
#include "rolling/case/internal.h"
#include "rolling/notes/note.h"
#include "rolling/solve/solution.h"

#include <math.h>

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
    return rb_rolling_write_note(
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
           rb_rolling_write_note(
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
           rb_rolling_write_note(
               text,
               "In row %d of the history the contact jumps to full sliding, at shift %.4g %s, "
               "force %.4g %s; the energy that is set free is no part of the model.",
               s->rows.jumped, s->rows.jump_shift, rb_unit_name(s->units, "mm"), s->rows.jump_force,
               rb_unit_name(s->units, "N/mm"));
}

/* Of the last row the note on the answer says it. */
static int not_unique_row(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text)
{
    (void)rc;
    return s->rows.not_unique > 0 &&
           rb_rolling_write_note(
               text,
               "In step %d nothing is held, and elements slide towards both sides: its %s is not "
               "unique, a range of it gives the same tractions, and slip and friction work with "
               "it.",
               s->rows.not_unique, s->formulation == RB_STATIC ? "shift" : "creepage");
}

const rb_rolling_note rb_rolling_notes_on_steps[] = {
    {"short-memory", short_memory, RB_NOTE_EVERYWHERE},
    {"row-of-steps", row_of_steps, RB_NOTE_EVERYWHERE},
    {"jumps", jumps, RB_NOTE_EVERYWHERE},
    {"not-unique-row", not_unique_row, RB_NOTE_EVERYWHERE},
};
