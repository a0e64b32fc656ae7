/* The traction table. */
#include "program/report/internal.h"
#include "rolling/case/case.h"

rb_status rb_report_table(FILE *out, const rb_rolling_case *rc, const rb_rolling_solution *s,
                          const rb_rolling_note_list *notes, const char *command,
                          const rb_report_style *style)
{
    const rb_report_scales by =
        style->dimensionless ? rb_report_scales_of(rc, s) : (rb_report_scales){.mu = 0.0};
    const rb_report_columns columns = {.columns = &rb_rolling_solution_columns,
                                       .owner = s,
                                       .units = s->units,
                                       .scales = style->dimensionless ? &by : NULL};
    rb_report_cells c = rb_report_begin_columns(out, style, command, 1, &columns);
    rb_report_comment_scales(&c, &columns);

    rb_report_comment(&c, "%s, %s; residual %.3g", rb_case_word("formulation", (int)s->formulation),
                      rb_status_text(s->status), s->residual);
    if (!isnan(s->accuracy_elements)) {
        char boundary[RB_NUMBER_TEXT];
        rb_report_comment(
            &c, "accuracy_elements %.0f, accuracy_boundary %s", s->accuracy_elements,
            isnan(s->accuracy_boundary) ? "NaN" : rb_number_text(s->accuracy_boundary, boundary));
    }
    for (int k = 0; k < s->patches && s->patches > 1; k++)
        rb_report_comment(&c, "patch %d: from %.9g to %.9g %s, p0 = %.9g %s, P = %.9g, Q = %.9g %s",
                          k + 1, s->patch[k].from, s->patch[k].to, rb_unit_name(s->units, "mm"),
                          s->patch[k].max_pressure, rb_unit_name(s->units, "MPa"),
                          s->patch[k].normal_load, s->patch[k].tangential_load,
                          rb_unit_name(s->units, "N/mm"));
    const rb_status noted = rb_report_comment_notes(&c, notes);
    return noted == RB_OK ? rb_report_end_columns(&c, s->n, 1, &columns) : noted;
}
