/* The JSON of a solved case, and of solutions of one case that differ. */
#include "program/report/internal.h"
#include "rollbem/case.h"

#include <jansson.h>

void rb_report_json_result(json_t **root, const rb_case_result *r, const rb_rolling_states *states,
                           const rb_case_slopes *slopes)
{
    json_t *summary = rb_report_json_summary(&r->solution);
    if (r->has_errors)
        rb_report_json_set(&summary, "errors", rb_report_json_errors(&r->errors));
    rb_report_json_set(root, "summary", summary);
    rb_report_json_set(root, "table", rb_report_json_table(&r->solution));
    if (r->history.n == 0)
        return;
    json_t *history = rb_report_json_history(&r->history);
    if (states && states->n > 0)
        rb_report_json_set(&history, "states", rb_report_json_states(states));
    if (slopes && slopes->n > 0)
        rb_report_json_slopes(&history, slopes);
    rb_report_json_set(root, "history", history);
}

json_t *rb_report_json_solutions(const rb_rolling_solutions *all)
{
    json_t *list = json_array();
    for (int k = 0; k < all->n; k++) {
        json_t *one = json_object();
        rb_report_json_set(&one, "summary", rb_report_json_summary(&all->solution[k]));
        rb_report_json_set(&one, "table", rb_report_json_table(&all->solution[k]));
        rb_report_json_append(&list, one);
    }
    return list;
}
