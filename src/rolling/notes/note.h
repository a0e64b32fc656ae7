/* What the notes of src/rolling/solve/notes_on_*.c are made of.  A note is one function, which
 * computes from the case and the state as solved whether its sentence holds, and writes it; and
 * one row of the table at the end of its file, with its name and the doors through which it goes.
 */
#ifndef ROLLBEM_ROLLING_NOTES_NOTE_H
#define ROLLBEM_ROLLING_NOTES_NOTE_H

#include "base/base.h"
#include "rolling/notes/notes.h"

/* The doors of a note. */
typedef enum {
    RB_NOTE_EVERYWHERE, /* standard error, # lines, JSON, Python, rows of curves and studies */
    RB_NOTE_OF_COLUMNS, /* how the columns of the table of tractions must be read: not of rows */
    RB_NOTE_OF_AN_END   /* not of a step before the last one: rb_rolling_rows tells of those */
} rb_rolling_note_doors;

typedef struct {
    const char *name;
    /* 0: nothing to say; 1: text[RB_ROLLING_NOTE_LENGTH] has the sentence; or no memory */
    int (*says)(const rb_rolling_case *rc, const rb_rolling_solution *s, char *text);
    rb_rolling_note_doors doors;
} rb_rolling_note;

enum { RB_NOTE_NO_MEMORY = -1 };

/* The tables, in the order in which notes are said: first what changes the meaning of the
 * result. */
enum {
    RB_NOTES_ON_MODELS = 9,
    RB_NOTES_ON_STEPS = 4,
    RB_NOTES_ON_ELEMENTS = 9,
    RB_NOTES_ON_INPUTS = 7,
    RB_NOTES_ON_ANSWERS = 9
};
extern const rb_rolling_note rb_rolling_notes_on_models[RB_NOTES_ON_MODELS],
    rb_rolling_notes_on_steps[RB_NOTES_ON_STEPS],
    rb_rolling_notes_on_elements[RB_NOTES_ON_ELEMENTS],
    rb_rolling_notes_on_inputs[RB_NOTES_ON_INPUTS],
    rb_rolling_notes_on_answers[RB_NOTES_ON_ANSWERS];

/* ---- note.c ---------------------------------------------------------------------------- */

/* Writes the sentence of a note that applies; returns 1. */
int rb_rolling_write_note(char *text, const char *format, ...) RB_PRINTF(2, 3);

/* Half the width of the widest patch, in the units of the solution. */
double rb_rolling_widest_patch(const rb_rolling_solution *s);
int rb_rolling_creepage_is_given(const rb_rolling_case *rc);

/* ---- datum.c --------------------------------------------------------------------------- */

/* How far a uniform traction of one on a strip of half-width a moves it on average, times pi:
 * positive unless the datum, from which displacements are measured, is too near.  along: 1 a
 * traction along the surface, 0 across it. */
double rb_rolling_mean_compliance(const rb_rolling_case *rc, const rb_rolling_body *body, double a,
                                  int along);

/* ---- smooth_base.c --------------------------------------------------------------------- */

/* The largest tension across the smooth base of a layer (L9), within a few thicknesses of the
 * contact, in the units of the solution; NAN without memory.  sign: 1 for the body on which the
 * friction is q, -1 for the other one. */
double rb_rolling_tension_of_base(const rb_rolling_case *rc, const rb_rolling_body *body,
                                  const rb_rolling_solution *s, double sign);

#endif
