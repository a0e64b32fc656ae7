/* Steps of a transient or of a static history. */
#include "report/internal.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* The columns in their order; new ones at the end. */
static const struct {
    const char *name, *key; /* in tables, in JSON */
    size_t column;          /* offset in rb_rolling_history */
    int whole;              /* 1: of whole numbers */
    int has_error;
} columns[] = {
#define COLUMN(name, key, member, whole, has_error)                                      \
    {                                                                                    \
        name, key, offsetof(rb_rolling_history, member), whole, has_error                \
    }
    COLUMN("distance_a", "distance", distance, 0, 0),
    COLUMN("creepage_1", "creepage", creepage, 0, 1),
    COLUMN("shift_mm", "shift", shift, 0, 1),
    COLUMN("approach_mm", "approach", approach, 0, 1),
    COLUMN("normal_load_N/mm", "normal_load", normal_load, 0, 1),
    COLUMN("tangential_load_N/mm", "tangential_load", tangential_load, 0, 1),
    COLUMN("force_ratio_1", "force_ratio", force_ratio, 0, 1),
    COLUMN("stick_elements", "stick", stick, 1, 0),
    COLUMN("slip_elements", "slip", slipping, 1, 0),
    COLUMN("residual_1", "residual", residual, 0, 0),
    COLUMN("max_pressure_MPa", "max_pressure", max_pressure, 0, 1),
    COLUMN("contact_from_mm", "contact_from", contact_from, 0, 1),
    COLUMN("contact_to_mm", "contact_to", contact_to, 0, 1),
    COLUMN("dissipation_N/mm", "dissipation", dissipation, 0, 1),
    COLUMN("moment_N", "moment", moment, 0, 1),
#undef COLUMN
};

enum { COLUMNS = sizeof columns / sizeof columns[0] };

static rb_report_series series_of(const rb_rolling_history *h, int j)
{
    void *column;
    memcpy(&column, (const char *)h + columns[j].column, sizeof column);
    return (rb_report_series){.name = columns[j].name,
                              .key = columns[j].key,
                              .x = columns[j].whole ? NULL : column,
                              .k = columns[j].whole ? column : NULL};
}

/* All columns, or those that have errors; returns how many. */
static int all_series(const rb_rolling_history *h, int errors, rb_report_series *series)
{
    int n = 0;
    for (int j = 0; j < COLUMNS; j++)
        if (!errors || columns[j].has_error)
            series[n++] = series_of(h, j);
    return n;
}

static void print_meaning(FILE *out, const rb_rolling_history *h)
{
    fprintf(out,
            "# distance in a = %.9g mm, the Hertz half-width of the largest load of the "
            "history\n"
            "# creepage and dissipation (friction power per unit speed): "
            "means over the step, 0 at rest; shift: so far\n"
            "# moment: int x p dx, > 0: the load acts ahead of x = 0; edges of the "
            "contact: nan without contact\n",
            h->half_width);
}

rb_status rb_report_history(FILE *out, const rb_rolling_history *h,
                            const rb_rolling_history *errors, const char *command,
                            int bare)
{
    rb_report_series series[2 * COLUMNS], error[COLUMNS];
    int n = all_series(h, 0, series);

    if (errors)
        n += rb_report_add_errors(all_series(errors, 1, error), error, series + n);
    if (!bare) {
        rb_report_print_head(out, command);
        print_meaning(out, h);
    }
    rb_report_print_names(out, n, series, bare);
    rb_report_print_rows(out, h->n, n, series);
    return rb_report_print_end(out);
}

json_t *rb_report_json_history(const rb_rolling_history *h,
                               const rb_rolling_history *errors)
{
    rb_report_series series[COLUMNS];
    json_t *history = json_object();

    rb_report_json_series(&history, h->n, all_series(h, 0, series), series);
    rb_report_json_set(&history, "half_width", rb_report_json_number(h->half_width));
    rb_report_json_set(&history, "step", rb_report_json_number(h->step));
    rb_report_json_set(&history, "steady_from",
                       h->steady_from < 0 ? json_null() : json_integer(h->steady_from));
    if (errors) {
        json_t *object = json_object();
        rb_report_json_series(&object, h->n, all_series(errors, 1, series), series);
        rb_report_json_set(&history, "errors", object);
    }
    return history;
}

/* The last step's values with their errors. */
static void print_errors(FILE *out, const rb_rolling_history *h,
                         const rb_rolling_history *errors)
{
    rb_report_series value[COLUMNS], error[COLUMNS];
    const int n = all_series(h, 1, value), last = h->n - 1;

    all_series(errors, 1, error);
    fputs("  error bars at the end (estimated from coarser meshes and longer steps)\n",
          out);
    for (int j = 0; j < n; j++)
        if (!isnan(value[j].x[last]) && !isnan(error[j].x[last]))
            fprintf(out, "    %-16s %.8g +- %.1g\n", value[j].key, value[j].x[last] + 0.0,
                    error[j].x[last]);
}

void rb_report_history_summary(FILE *out, const rb_rolling_history *h,
                               const rb_rolling_history *errors)
{
    const int last = h->n - 1;
    fprintf(out, "  history   %d steps", h->n);
    if (h->step > 0.0)
        fprintf(out, " of %.5g mm, rolled %.5g a (a = %.5g mm)", h->step,
                h->distance[last], h->half_width);
    if (h->steady_from >= 0)
        fprintf(out, "; steady from step %d, %.4g a, on", h->steady_from + 1,
                h->distance[h->steady_from]);
    fputc('\n', out);
    if (errors)
        print_errors(out, h, errors);
}
