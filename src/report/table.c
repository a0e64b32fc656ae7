/* The traction table. */
#include "report/internal.h"
#include "rollbem/case.h"

#include <stdlib.h>
#include <string.h>

rb_status rb_report_table(FILE *out, const rb_rolling_case *rc,
                          const rb_rolling_solution *s, const char *command,
                          const rb_report_style *style)
{
    const rb_report_columns columns = {&rb_rolling_solution_columns, s, 0, s->units};
    rb_report_cells c = rb_report_begin_columns(out, style, command, 1, &columns);

    rb_report_comment(&c, "%s, %s; residual %.3g",
                      rb_case_word("formulation", (int)s->formulation),
                      rb_status_text(s->status), s->residual);
    for (int k = 0; k < s->patches && s->patches > 1; k++)
        rb_report_comment(&c,
                          "patch %d: from %.9g to %.9g %s, p0 = %.9g %s, P = %.9g, Q = "
                          "%.9g %s",
                          k + 1, s->patch[k].from, s->patch[k].to,
                          rb_unit_name(s->units, "mm"), s->patch[k].max_pressure,
                          rb_unit_name(s->units, "MPa"), s->patch[k].normal_load,
                          s->patch[k].tangential_load, rb_unit_name(s->units, "N/mm"));
    if (rc)
        rb_report_comment_notes(&c, rc, s);
    return rb_report_end_columns(&c, s->n, 1, &columns);
}

/* ---- For a terminal ---------------------------------------------------------------- */

enum { BRIEF_ROWS = 20, BRIEF_WIDTH = 24 };

/* The fewest digits that read back equal. */
static const char *shortest(double x, char text[RB_ROLLING_HEADING])
{
    for (int digits = 1; digits <= 17; digits++) {
        snprintf(text, RB_ROLLING_HEADING, "%.*g", digits, x);
        if (strtod(text, NULL) == x)
            break;
    }
    return text;
}

/* The contact and an element at either side. */
static void brief_range(const rb_rolling_solution *s, int *from, int *to)
{
    for (*from = 0; *from < s->n - 1 && s->zone[*from] == RB_ZONE_SEPARATED;)
        ++*from;
    for (*to = s->n; *to > *from + 1 && s->zone[*to - 1] == RB_ZONE_SEPARATED;)
        --*to;
    *from -= *from > 0;
    *to += *to < s->n;
}

rb_status rb_report_brief_table(FILE *out, const rb_rolling_solution *s, int width)
{
    static const char *const names[] = {"x", "p", "q", "slip", "zone"};
    const int wide = width >= 4 * BRIEF_WIDTH; /* else without the slip */
    char text[RB_ROLLING_HEADING];
    int from, to;
    brief_range(s, &from, &to);
    const int step = (to - from + BRIEF_ROWS - 1) / BRIEF_ROWS;

    for (int i = from - 1; i < to; i += i < from ? 1 : step) {
        for (int j = 0; j < rb_rolling_solution_columns.n; j++) {
            const rb_rolling_result *r = &rb_rolling_solution_columns.row[j];
            const int whole = r->kind == RB_RESULT_WHOLE;
            int k = 0;
            while (k < 5 && (strcmp(r->name, names[k]) != 0 || (k == 3 && !wide)))
                k++;
            if (k == 5)
                continue;
            fprintf(out, "%*s", whole ? 6 : BRIEF_WIDTH,
                    i < from ? rb_rolling_heading(r, s->units, text)
                             : shortest(rb_rolling_entry(r, s, i) + 0.0, text));
        }
        fputc('\n', out);
    }
    fprintf(out, "%d of %d elements; all, with every column: rollbem ... > FILE\n",
            (to - from + step - 1) / step, s->n);
    return rb_report_flush(out);
}
