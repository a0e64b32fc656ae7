/* Error bars. */
#include "program/report/report.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

json_t *rb_report_json_errors(const rb_rolling_errors *e)
{
    json_t *errors = json_object();
    const int of_cycle = !isnan(e->scalar.fretting.work); /* those of steps are in the history */
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const int is_there =
            (r->condition == RB_FOR_ALL && !of_cycle) || !isnan(rb_rolling_number(r, &e->scalar));
        if (r->error_bar && is_there)
            rb_report_json_set(&errors, r->name,
                               rb_report_json_number(rb_rolling_number(r, &e->scalar)));
    }
    return errors;
}

void rb_report_errors(FILE *out, const rb_rolling_solution *s, const rb_rolling_errors *e,
                      int width)
{
    enum { COLUMN = 42 };
    void *before = rb_locale_begin();
    int at = 0; /* characters in the line so far */
    fputs("  error bars (estimated from coarser meshes)\n", out);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double value = rb_rolling_number(r, s);
        const double error = rb_rolling_number(r, &e->scalar);
        if (!r->error_bar || isnan(value) || isnan(error))
            continue;
        char text[120];
        /* to the digit of the error bar, but all before the point; far below the bar a
         * value is rounding */
        const double size = fabs(value) / error, first = floor(log10(fabs(value)));
        const double digits = size > 1.0 ? first - fmin(floor(log10(error)), 0.0) + 1.0 : 1.0;
        snprintf(text, sizeof text, "%-17s %.*g +- %.1g%s%s", r->name,
                 digits < 8.0 ? (int)digits : 8, size < 1e-3 ? 0.0 : value + 0.0, error, /* no -0 */
                 r->unit ? " " : "", r->unit ? rb_unit_name(s->units, r->unit) : "");
        const int column = (at + COLUMN) / COLUMN * COLUMN; /* behind a blank */
        if (at > 0 && column + (int)strlen(text) <= width)
            at += fprintf(out, "%*s%s", column - at, "", text);
        else
            at = fprintf(out, "%s%s", at > 0 ? "\n    " : "    ", text) - (at > 0);
    }
    fputs(at > 0 ? "\n" : "", out);
    rb_locale_end(before);
}
