/* Steps of a transient or of a static history. */
#include "rollbem/report.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>

typedef struct {
    const char *name, *unit; /* JSON; the table's column is name_unit */
    size_t offset;
    int whole;
} column;

#define NUMBER(member, unit)                                                             \
    {                                                                                    \
#member, unit, offsetof(rb_rolling_history, member), 0                           \
    }

static const column columns[] = {
    NUMBER(distance, "a"),
    NUMBER(creepage, "1"),
    NUMBER(shift, "mm"),
    NUMBER(approach, "mm"),
    NUMBER(normal_load, "N/mm"),
    NUMBER(tangential_load, "N/mm"),
    NUMBER(force_ratio, "1"),
    {"stick", "elements", offsetof(rb_rolling_history, stick), 1},
    {"slip", "elements", offsetof(rb_rolling_history, slipping), 1},
    NUMBER(residual, "1"),
};

enum { COLUMNS = sizeof columns / sizeof columns[0] };

static double value(const rb_rolling_history *h, const column *c, int i)
{
    const void *place = (const char *)h + c->offset;
    return c->whole ? (*(int *const *)place)[i] : (*(double *const *)place)[i];
}

rb_status rb_report_history(FILE *out, const rb_rolling_history *h, const char *command,
                            int bare)
{
    if (!bare) {
        fprintf(out, "# rollbem %s\n# %s\n", RB_VERSION, command);
        for (const char *const *line = rb_report_conventions; *line; line++)
            fprintf(out, "# %s\n", *line);
        fprintf(out, "# distance in Hertz half-widths; creepage: mean over the step\n# ");
    }
    for (int j = 0; j < COLUMNS; j++)
        fprintf(out, "%s_%s%c", columns[j].name, columns[j].unit,
                j + 1 < COLUMNS ? '\t' : '\n');
    for (int i = 0; i < h->n; i++)
        for (int j = 0; j < COLUMNS; j++)
            fprintf(out, "%.17g%c", value(h, &columns[j], i),
                    j + 1 < COLUMNS ? '\t' : '\n');
    return fflush(out) == 0 && !ferror(out) ? RB_OK : RB_EWRITE;
}

json_t *rb_report_json_history(const rb_rolling_history *h)
{
    json_t *history = json_object();
    for (int j = 0; j < COLUMNS; j++) {
        json_t *list = json_array();
        for (int i = 0; i < h->n; i++) {
            const double v = value(h, &columns[j], i);
            json_array_append_new(list, columns[j].whole ? json_integer((json_int_t)v)
                                                         : rb_report_json_number(v));
        }
        json_object_set_new(history, columns[j].name, list);
    }
    json_object_set_new(history, "step", rb_report_json_number(h->step));
    json_object_set_new(history, "steady_from",
                        h->steady_from < 0 ? json_null() : json_integer(h->steady_from));
    return history;
}

void rb_report_history_summary(FILE *out, const rb_rolling_history *h)
{
    const int last = h->n - 1;
    fprintf(out, "  history   %d steps", h->n);
    if (h->step > 0.0)
        fprintf(out, " of %.5g mm, rolled %.5g a", h->step, h->distance[last]);
    if (h->steady_from >= 0)
        fprintf(out, "; steady from step %d, %.4g a, on", h->steady_from + 1,
                h->distance[h->steady_from]);
    fputc('\n', out);
}
