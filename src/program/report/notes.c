/* The notes on how to read a result, where results are written. */
#include "program/report/internal.h"

#include <jansson.h>

void rb_report_note(FILE *out, const char *text, int colour)
{
    fprintf(out, "rollbem: %snote:%s %s\n", colour ? "\033[33m" : "", colour ? "\033[0m" : "",
            text);
}

void rb_report_notes(FILE *out, const rb_rolling_note_list *notes, int colour)
{
    for (int k = 0; k < notes->n; k++)
        rb_report_note(out, notes->text[k], colour);
    if (notes->status != RB_OK)
        rb_report_note(out, rb_rolling_notes_missing, colour);
}

rb_status rb_report_comment_notes(const rb_report_cells *c, const rb_rolling_note_list *notes)
{
    for (int k = 0; notes && k < notes->n; k++)
        rb_report_comment(c, "note: %s", notes->text[k]);
    return notes ? notes->status : RB_OK;
}

json_t *rb_report_json_notes(const rb_rolling_note_list *notes)
{
    json_t *list = notes->status == RB_OK ? json_array() : NULL;
    for (int k = 0; k < notes->n; k++)
        rb_report_json_append(&list, json_string(notes->text[k]));
    return list;
}
