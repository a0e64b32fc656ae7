/* Steps of a transient or of a static history. */
#include "report/internal.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

/* Columns; those from FIRST to before LAST have errors. */
enum { COLUMNS = 10, FIRST = 1, LAST = 7, ERRORS = LAST - FIRST };

static void series_of(const rb_rolling_history *h, rb_report_series series[COLUMNS])
{
    const rb_report_series all[COLUMNS] = {
        {"distance_a", "distance", h->distance, NULL, 0},
        {"creepage_1", "creepage", h->creepage, NULL, 0},
        {"shift_mm", "shift", h->shift, NULL, 0},
        {"approach_mm", "approach", h->approach, NULL, 0},
        {"normal_load_N/mm", "normal_load", h->normal_load, NULL, 0},
        {"tangential_load_N/mm", "tangential_load", h->tangential_load, NULL, 0},
        {"force_ratio_1", "force_ratio", h->force_ratio, NULL, 0},
        {"stick_elements", "stick", NULL, h->stick, 0},
        {"slip_elements", "slip", NULL, h->slipping, 0},
        {"residual_1", "residual", h->residual, NULL, 0}};
    memcpy(series, all, sizeof all);
}

rb_status rb_report_history(FILE *out, const rb_rolling_history *h,
                            const rb_rolling_history *errors, const char *command,
                            int bare)
{
    rb_report_series series[COLUMNS + ERRORS];
    int columns = COLUMNS;

    series_of(h, series);
    if (errors) {
        rb_report_series error[COLUMNS];
        series_of(errors, error);
        columns += rb_report_add_errors(ERRORS, error + FIRST, series + COLUMNS);
    }
    if (!bare) {
        rb_report_print_head(out, command);
        fputs("# distance in Hertz half-widths; creepage: mean over the step\n", out);
    }
    rb_report_print_names(out, columns, series, bare);
    rb_report_print_rows(out, h->n, columns, series);
    return rb_report_print_end(out);
}

json_t *rb_report_json_history(const rb_rolling_history *h,
                               const rb_rolling_history *errors)
{
    rb_report_series series[COLUMNS];
    json_t *history = json_object();

    series_of(h, series);
    rb_report_json_series(history, h->n, COLUMNS, series);
    json_object_set_new(history, "step", rb_report_json_number(h->step));
    json_object_set_new(history, "steady_from",
                        h->steady_from < 0 ? json_null() : json_integer(h->steady_from));
    if (errors) {
        json_t *object = json_object();
        series_of(errors, series);
        rb_report_json_series(object, h->n, ERRORS, series + FIRST);
        json_object_set_new(history, "errors", object);
    }
    return history;
}

/* The last step's values with their errors. */
static void print_errors(FILE *out, const rb_rolling_history *h,
                         const rb_rolling_history *errors)
{
    rb_report_series value[COLUMNS], error[COLUMNS];

    series_of(h, value);
    series_of(errors, error);
    fputs("  error bars at the end (estimated from coarser meshes and longer steps)\n",
          out);
    for (int j = FIRST; j < LAST; j++)
        if (!isnan(value[j].x[h->n - 1]) && !isnan(error[j].x[h->n - 1]))
            fprintf(out, "    %-16s %.8g +- %.1g\n", value[j].key,
                    value[j].x[h->n - 1] + 0.0, error[j].x[h->n - 1]);
}

void rb_report_history_summary(FILE *out, const rb_rolling_history *h,
                               const rb_rolling_history *errors)
{
    const int last = h->n - 1;
    fprintf(out, "  history   %d steps", h->n);
    if (h->step > 0.0)
        fprintf(out, " of %.5g mm, rolled %.5g a", h->step, h->distance[last]);
    if (h->steady_from >= 0)
        fprintf(out, "; steady from step %d, %.4g a, on", h->steady_from + 1,
                h->distance[h->steady_from]);
    fputc('\n', out);
    if (errors)
        print_errors(out, h, errors);
}
