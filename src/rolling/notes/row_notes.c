/* Notes on the rows of a curve or a study, counted by their kinds. */
#include "base/base.h"
#include "rolling/notes/notes.h"

#include <stdio.h>
#include <string.h>

void rb_rolling_add_note(rb_rolling_row_notes *notes, int kind, const char *text)
{
    if (notes->n == RB_ROLLING_ROW_NOTES)
        return;
    notes->kind[notes->n] = kind;
    snprintf(notes->text[notes->n++], sizeof notes->text[0], "%s", text);
}

static void add_rows(rb_rolling_study_notes *all, int kind, int first, int count, const char *text)
{
    if (kind < 0 || kind >= RB_ROLLING_NOTES || count == 0)
        return;
    if (all->count[kind] == 0) {
        all->first[kind] = first;
        snprintf(all->text[kind], sizeof all->text[0], "%s", text);
    }
    all->count[kind] += count;
}

void rb_rolling_add_row_notes(rb_rolling_study_notes *all, int row,
                              const rb_rolling_row_notes *notes)
{
    all->rows++;
    for (int k = 0; k < notes->n; k++)
        add_rows(all, notes->kind[k], row, 1, notes->text[k]);
}

void rb_rolling_join_study_notes(rb_rolling_study_notes *all, const rb_rolling_study_notes *more)
{
    for (int k = 0; k < RB_ROLLING_NOTES; k++)
        add_rows(all, k, all->rows + more->first[k], more->count[k], more->text[k]);
    all->rows += more->rows;
}

rb_rolling_note_list rb_rolling_list_study_notes(const rb_rolling_study_notes *all, const char *row)
{
    rb_rolling_note_list list = {.n = 0};

    for (int k = 0; k < RB_ROLLING_NOTES; k++) {
        if (all->count[k] == 0)
            continue;
        const int others = all->count[k] - 1;
        char *text = list.text[list.n];
        snprintf(text, RB_ROLLING_NOTE_LENGTH, "%s", all->text[k]);
        if (all->count[k] == all->rows && others > 0)
            rb_append(text, RB_ROLLING_NOTE_LENGTH, " (all %d %ss)", all->rows, row);
        else if (all->rows > 1)
            rb_append(text, RB_ROLLING_NOTE_LENGTH, " (%s %d", row, all->first[k] + 1);
        if (all->count[k] != all->rows && others > 0)
            rb_append(text, RB_ROLLING_NOTE_LENGTH, " and %d other%s", others,
                      others > 1 ? "s" : "");
        if (all->count[k] != all->rows)
            rb_append(text, RB_ROLLING_NOTE_LENGTH, " of %d)", all->rows);
        list.kind[list.n++] = k;
    }
    return list;
}

void rb_rolling_list_step_notes(const rb_rolling_study_notes *of, const char *step,
                                rb_rolling_note_list *notes)
{
    if (!of)
        return;
    const rb_rolling_note_list earlier = rb_rolling_list_study_notes(of, step);
    for (int k = 0; k < earlier.n && notes->n < RB_ROLLING_NOTES; k++) {
        int known = 0;
        for (int j = 0; j < notes->n; j++)
            known |= notes->kind[j] == earlier.kind[k];
        if (known)
            continue;
        notes->kind[notes->n] = earlier.kind[k];
        memcpy(notes->text[notes->n++], earlier.text[k], sizeof earlier.text[k]);
    }
}
