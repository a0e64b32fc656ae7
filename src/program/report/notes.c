/* The notes on how to read a result, where results are written. */
#include "program/report/internal.h"

#include <jansson.h>

void rb_report_note(FILE *out, const char *text, int colour)
{
    fprintf(out, "rollbem: %snote:%s %s\n", colour ? "\033[33m" : "", colour ? "\033[0m" : "",
            text);
}

void rb_report_notes(FILE *out, const rb_rolling_case *rc, const rb_rolling_solution *s, int colour)
{
    const rb_rolling_note_list list = rb_rolling_find_notes(rc, s);
    for (int k = 0; k < list.n; k++)
        rb_report_note(out, list.text[k], colour);
}

void rb_report_comment_notes(const rb_report_cells *c, const rb_rolling_case *rc,
                             const rb_rolling_solution *s)
{
    const rb_rolling_note_list list = rb_rolling_find_notes(rc, s);
    for (int k = 0; k < list.n; k++)
        rb_report_comment(c, "note: %s", list.text[k]);
}

json_t *rb_report_json_notes(const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    const rb_rolling_note_list found = rb_rolling_find_notes(rc, s);
    json_t *list = json_array();
    for (int k = 0; k < found.n; k++)
        rb_report_json_append(&list, json_string(found.text[k]));
    return list;
}
