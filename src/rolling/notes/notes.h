/* Notes on a solution, and on the rows of a curve or a study. */
#ifndef ROLLBEM_ROLLING_NOTES_NOTES_H
#define ROLLBEM_ROLLING_NOTES_NOTES_H

#include "rolling/case/inputs.h"

/* Notes on results that must be read with care, one line each, every one of which the state
 * as solved bears out (src/rolling/solve/notes_on_*.c). */
enum { RB_ROLLING_NOTES = 56, RB_ROLLING_NOTE_LENGTH = 320 };

/* The notes on all rows: how many have a note of each kind, the first of them from 0, and what it
 * says of that one. */
typedef struct rb_rolling_study_notes {
    int rows, count[RB_ROLLING_NOTES], first[RB_ROLLING_NOTES];
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
} rb_rolling_study_notes;

typedef struct {
    int n;
    int kind[RB_ROLLING_NOTES]; /* which note, see rb_rolling_note_name */
    char text[RB_ROLLING_NOTES][RB_ROLLING_NOTE_LENGTH];
    rb_status status; /* RB_ENOMEM: notes are missing */
} rb_rolling_note_list;
extern const char rb_rolling_notes_missing[]; /* the sentence that says so */
rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s);
/* "static-creepage", ... of kind k = 0, 1, ...; NULL after the last one. */
const char *rb_rolling_note_name(int k);

/* The notes on one row of a curve or a study: the first few of them. */
enum { RB_ROLLING_ROW_NOTES = 6 };
typedef struct {
    int n, kind[RB_ROLLING_ROW_NOTES];
    char text[RB_ROLLING_ROW_NOTES][RB_ROLLING_NOTE_LENGTH];
    rb_status status; /* RB_ENOMEM: notes are missing */
} rb_rolling_row_notes;
/* Those of a solved case in the units of the solution, but for those on columns of its table. */
rb_rolling_row_notes rb_rolling_find_row_notes(const rb_rolling_case *rc,
                                               const rb_rolling_solution *s);
/* One more, of a kind of the caller's from RB_ROLLING_OWN_NOTES on. */
enum { RB_ROLLING_OWN_NOTES = 38 };
void rb_rolling_add_note(rb_rolling_row_notes *notes, int kind, const char *text);

/* Adds the notes of a row to those on all rows (rb_rolling_study_notes). */
void rb_rolling_add_row_notes(rb_rolling_study_notes *all, int row,
                              const rb_rolling_row_notes *notes);
/* Further rows behind those of `all`. */
void rb_rolling_join_study_notes(rb_rolling_study_notes *all, const rb_rolling_study_notes *more);
/* One line for each kind, with the rows that it is true of; row: "case", "point". */
rb_rolling_note_list rb_rolling_list_study_notes(const rb_rolling_study_notes *all,
                                                 const char *row);
/* Adds the notes of a step, step = 0 ... steps - 1, of which 0 begins anew.  Those of the last step
 * are found from its solution and are not added.  RB_ENOMEM: some are missing. */
rb_status rb_rolling_add_step_notes(rb_rolling_study_notes *all, const rb_rolling_case *rc,
                                    const rb_rolling_solution *s, int step, int steps);
/* The same of a step that the model has just computed; units: of the numbers in the notes. */
rb_status rb_rolling_note_step(rb_rolling_study_notes *all, const rb_rolling_case *rc,
                               rb_units units, const rb_rolling_model *model, int step, int steps,
                               rb_message *why);
/* To the notes on the last step, those of other kinds on steps before it, with their numbers; of:
 * may be NULL. */
void rb_rolling_list_step_notes(const rb_rolling_study_notes *of, const char *step,
                                rb_rolling_note_list *notes);
/* 1: the friction power is negative by more than rounding errors, which is an error of
 * the mesh; the text of the note about it. */
int rb_rolling_is_below_zero(double dissipation, double load);
const char *rb_rolling_below_zero(const rb_rolling_case *rc, const rb_rolling_solution *s);

#endif
