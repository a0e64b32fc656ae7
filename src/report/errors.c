/* Error bars. */
#include "rollbem/report.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>

#define FIELD(member, unit)                                                              \
    {                                                                                    \
#member, unit, offsetof(rb_rolling_solution, member),                            \
            offsetof(rb_rolling_errors, member)                                          \
    }

static const struct {
    const char *name, *unit;
    size_t value, error;
} fields[] = {
    FIELD(normal_load, "N/mm"), FIELD(tangential_load, "N/mm"),
    FIELD(force_ratio, ""),     FIELD(approach, "mm"),
    FIELD(creepage, ""),        FIELD(free_creepage, ""),
    FIELD(half_width, "mm"),    FIELD(max_pressure, "MPa"),
    FIELD(stick_from, "mm"),    FIELD(stick_to, "mm"),
    FIELD(dissipation, "N/mm"),
};

enum { FIELDS = sizeof fields / sizeof fields[0] };

static double number_at(const void *object, size_t offset)
{
    return *(const double *)((const char *)object + offset);
}

json_t *rb_report_json_errors(const rb_rolling_errors *e)
{
    json_t *errors = json_object();
    for (int k = 0; k < FIELDS; k++)
        rb_report_json_set(&errors, fields[k].name,
                           rb_report_json_number(number_at(e, fields[k].error)));
    return errors;
}

void rb_report_errors(FILE *out, const rb_rolling_solution *s, const rb_rolling_errors *e)
{
    fputs("  error bars (estimated from coarser meshes)\n", out);
    for (int k = 0; k < FIELDS; k++) {
        const double value = number_at(s, fields[k].value);
        const double error = number_at(e, fields[k].error);
        if (!isnan(value) && !isnan(error))
            fprintf(out, "    %-16s %.8g +- %.1g %s\n", fields[k].name, value + 0.0,
                    error, fields[k].unit); /* + 0.0: no -0 */
    }
}
