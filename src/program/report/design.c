/* A design: its variables, its result and its constraints. */
#include "program/report/internal.h"
#include "analysis/design/design.h"

#include <jansson.h>
#include <math.h>

static const char *unit_of_result(const rb_rolling_result *r)
{
    return r ? r->unit : NULL;
}

rb_status rb_report_design_table(FILE *out, const rb_design *d, rb_units units, const char *command,
                                 const rb_report_style *style)
{
    rb_report_cells c =
        rb_report_cells_begin(out, style, "variable unit x_of_gap start value low high");

    rb_report_comment_origin(&c, command);
    rb_report_comment(&c, "%s %s: %.10g, at the start %.10g [%s]", d->largest ? "largest" : "least",
                      rb_design_name(d), rb_unit_shown(units, rb_design_unit(d), d->value),
                      rb_unit_shown(units, rb_design_unit(d), d->start),
                      rb_report_unit_name(units, rb_design_unit(d)));
    for (int k = 0; k < d->constraints; k++) {
        const rb_design_constraint *k_ = &d->constraint[k];
        const char *unit = unit_of_result(k_->result);
        rb_report_comment(&c, "%s %s %.10g: %.10g [%s]", rb_design_result_name(k_->result),
                          k_->at_least ? ">=" : "<=", rb_unit_shown(units, unit, k_->bound),
                          rb_unit_shown(units, unit, k_->value), rb_report_unit_name(units, unit));
    }
    for (int j = 0; j < d->n; j++) {
        const rb_design_variable *v = &d->variable[j];
        const int is_gap = j >= d->gap_from && j < d->gap_from + d->gap_n;
        rb_report_cell_text(&c, v->name);
        rb_report_cell_text(&c, rb_report_unit_name(units, v->unit));
        rb_report_cell_number(&c,
                              is_gap ? rb_unit_shown(units, "mm", d->gap_x[j - d->gap_from]) : NAN);
        rb_report_cell_number(&c, rb_unit_shown(units, v->unit, v->start));
        rb_report_cell_number(&c, rb_unit_shown(units, v->unit, v->value));
        rb_report_cell_number(&c, rb_unit_shown(units, v->unit, v->low));
        rb_report_cell_number(&c, rb_unit_shown(units, v->unit, v->high));
        rb_report_cells_end_row(&c);
    }
    return rb_report_flush(out);
}

static json_t *number(rb_units units, const char *unit, double x)
{
    return rb_report_json_number(rb_unit_shown(units, unit, x));
}

void rb_report_json_design(json_t **root, const rb_design *d, rb_units units)
{
    const char *unit = rb_design_unit(d);
    json_t *design = json_object(), *variables = json_object(), *all = json_array();

    rb_report_json_set(&design, "result", json_string(rb_design_name(d)));
    rb_report_json_set(&design, "largest", json_boolean(d->largest));
    rb_report_json_set(&design, "unit", json_string(rb_report_unit_name(units, unit)));
    rb_report_json_set(&design, "start", number(units, unit, d->start));
    rb_report_json_set(&design, "value", number(units, unit, d->value));
    rb_report_json_set(&design, "evaluations", json_integer(d->evaluations));
    rb_report_json_set(&design, "status",
                       json_string(d->status == RB_OK ? "solved" : rb_status_text(d->status)));
    for (int j = 0; j < d->n; j++) {
        const rb_design_variable *v = &d->variable[j];
        const rb_report_named numbers[] = {{"start", rb_unit_shown(units, v->unit, v->start)},
                                           {"value", rb_unit_shown(units, v->unit, v->value)},
                                           {"low", rb_unit_shown(units, v->unit, v->low)},
                                           {"high", rb_unit_shown(units, v->unit, v->high)}};
        json_t *one = rb_report_json_named(4, numbers);
        if (j >= d->gap_from && j < d->gap_from + d->gap_n)
            rb_report_json_set(&one, "x", number(units, "mm", d->gap_x[j - d->gap_from]));
        rb_report_json_set(&variables, v->name, one);
    }
    rb_report_json_set(&design, "variables", variables);
    for (int k = 0; k < d->constraints; k++) {
        const rb_design_constraint *c = &d->constraint[k];
        json_t *one = json_object();
        rb_report_json_set(&one, "result", json_string(rb_design_result_name(c->result)));
        rb_report_json_set(&one, "at_least", json_boolean(c->at_least));
        rb_report_json_set(&one, "bound", number(units, unit_of_result(c->result), c->bound));
        rb_report_json_set(&one, "value", number(units, unit_of_result(c->result), c->value));
        rb_report_json_append(&all, one);
    }
    rb_report_json_set(&design, "constraints", all);
    rb_report_json_set(root, "design", design);
}
