/* The JSON of a solved case, whole: what the commands write and the certificate writes again. */
#include "program/report/internal.h"
#include "analysis/sensitivity/derivatives.h"
#include "rolling/case/case.h"

#include <jansson.h>

static void set_result(json_t **root, const rb_case_result *r, const rb_rolling_states *states,
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

static json_t *solutions(const rb_rolling_solutions *all)
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

json_t *rb_report_json_document(const rb_report_document *d)
{
    const rb_resolved_case *c = rb_case_resolved(d->words);
    json_t *root = rb_report_json_start(d->command);

    if (d->notes)
        rb_report_json_set(&root, "notes", rb_report_json_notes(d->notes));
    rb_report_json_set(&root, "units", rb_report_json_units(c->units));
    rb_report_json_set(&root, "input_hash", rb_report_json_input_hash(d->words));
    rb_report_json_set(&root, "inputs", rb_report_json_inputs(d->words));
    if (d->result)
        set_result(&root, d->result, d->states, d->slopes);
    if (d->stress)
        rb_report_json_stress(&root, d->stress);
    if (d->crack)
        rb_report_json_crack(&root, d->crack);
    if (d->crack && d->faces)
        rb_report_json_crack_faces(&root, d->crack);
    if (d->solutions)
        rb_report_json_set(&root, "solutions", solutions(d->solutions));
    if (d->derivatives)
        rb_report_json_derivatives(&root, d->derivatives);
    if (d->deviations)
        rb_report_json_tolerances(&root, d->deviations);
    if (d->derivatives_of || d->uncertain)
        rb_report_json_asked(&root, d->derivatives_of, d->words);
    if (d->uncertain)
        rb_report_json_uncertain(&root, d->uncertain, c->units);
    return root;
}
