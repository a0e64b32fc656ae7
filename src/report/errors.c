/* Error bars. */
#include "rollbem/report.h"

#include <jansson.h>
#include <math.h>

json_t *rb_report_json_errors(const rb_rolling_errors *e)
{
    json_t *errors = json_object();
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const int is_there =
            r->condition == RB_FOR_ALL || !isnan(rb_rolling_number(r, &e->scalar));
        if (r->error_bar && is_there)
            rb_report_json_set(&errors, r->name,
                               rb_report_json_number(rb_rolling_number(r, &e->scalar)));
    }
    return errors;
}

void rb_report_errors(FILE *out, const rb_rolling_solution *s, const rb_rolling_errors *e)
{
    void *before = rb_locale_begin();
    fputs("  error bars (estimated from coarser meshes)\n", out);
    for (int k = 0; k < rb_rolling_solution_scalars.n; k++) {
        const rb_rolling_result *r = &rb_rolling_solution_scalars.row[k];
        const double value = rb_rolling_number(r, s);
        const double error = rb_rolling_number(r, &e->scalar);
        if (r->error_bar && !isnan(value) && !isnan(error))
            fprintf(out, "    %-17s %.8g +- %.1g%s%s\n", r->name, value + 0.0, error,
                    r->unit ? " " : "", /* + 0.0: no -0 */
                    r->unit ? rb_unit_name(s->units, r->unit) : "");
    }
    rb_locale_end(before);
}
