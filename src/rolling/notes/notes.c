/* All notes on how to read a result, and those that hold for a solution.
 * tests/test_sentences.c has a case that must say each of them, and a near one that must not. */
#include "base/base.h"
#include "rolling/notes/note.h"
#include "rolling/results/results.h"
#include "rolling/solve/solution.h"

#include <string.h>

static const struct {
    const rb_rolling_note *row;
    int n;
} tables[] = {{rb_rolling_notes_on_models, RB_NOTES_ON_MODELS},
              {rb_rolling_notes_on_steps, RB_NOTES_ON_STEPS},
              {rb_rolling_notes_on_elements, RB_NOTES_ON_ELEMENTS},
              {rb_rolling_notes_on_inputs, RB_NOTES_ON_INPUTS},
              {rb_rolling_notes_on_answers, RB_NOTES_ON_ANSWERS}};

enum {
    TABLES = sizeof tables / sizeof *tables,
    NOTES = RB_NOTES_ON_MODELS + RB_NOTES_ON_STEPS + RB_NOTES_ON_ELEMENTS + RB_NOTES_ON_INPUTS +
            RB_NOTES_ON_ANSWERS
};
_Static_assert((int)NOTES <= (int)RB_ROLLING_OWN_NOTES, "kinds of the callers come behind");

/* Note k of all tables; NULL: there are no more. */
static const rb_rolling_note *note_of_kind(int k)
{
    for (int t = 0; t < TABLES && k >= 0; k -= tables[t++].n)
        if (k < tables[t].n)
            return &tables[t].row[k];
    return NULL;
}

const char *rb_rolling_note_name(int k)
{
    const rb_rolling_note *note = note_of_kind(k);
    return note ? note->name : NULL;
}

const char rb_rolling_notes_missing[] = "Notes on this result may be missing: out of memory.";

rb_rolling_note_list rb_rolling_find_notes(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    rb_rolling_note_list list = {.n = 0};

    for (int k = 0; k < NOTES; k++) {
        const int said = note_of_kind(k)->says(rc, s, list.text[list.n]);
        if (said == RB_NOTE_NO_MEMORY)
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
        if (note_of_kind(found.kind[k])->doors != RB_NOTE_OF_COLUMNS)
            rb_rolling_add_note(&row, found.kind[k], found.text[k]);
    return row;
}

rb_status rb_rolling_add_step_notes(rb_rolling_study_notes *all, const rb_rolling_case *rc,
                                    const rb_rolling_solution *s, int step, int steps)
{
    rb_rolling_row_notes row = {.n = 0};

    if (step == 0)
        memset(all, 0, sizeof *all);
    if (step + 1 < steps) {
        const rb_rolling_note_list found = rb_rolling_find_notes(rc, s);
        row.status = found.status;
        for (int k = 0; k < found.n; k++)
            if (note_of_kind(found.kind[k])->doors == RB_NOTE_EVERYWHERE)
                rb_rolling_add_note(&row, found.kind[k], found.text[k]);
    }
    rb_rolling_add_row_notes(all, step, &row);
    return row.status;
}

rb_status rb_rolling_note_step(rb_rolling_study_notes *all, const rb_rolling_case *rc,
                               rb_units units, const rb_rolling_model *model, int step, int steps,
                               rb_message *why)
{
    rb_rolling_solution solution = {0};
    rb_status s = step + 1 < steps ? rb_rolling_tractions_solution(model, &solution, why) : RB_OK;

    rb_rolling_solution_convert(&solution, units);
    if (s == RB_OK)
        s = rb_rolling_add_step_notes(all, rc, &solution, step, steps);
    rb_rolling_solution_free(&solution);
    return s == RB_ENOMEM ? rb_fail(why, s, "out of memory for notes") : s;
}
