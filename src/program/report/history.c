/* Steps of a transient or of a static history. */
#include "program/report/internal.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

static rb_report_columns columns_of(const rb_rolling_history *h, int kind)
{
    return (rb_report_columns){
        .columns = &rb_rolling_history_columns, .owner = h, .kind = kind, .units = h->units};
}

/* The history, and what stands beside its values.  Returns how many. */
static int parts_of(const rb_rolling_history *h, rb_report_columns part[3])
{
    int n = 0;

    part[n++] = columns_of(h, RB_REPORT_VALUES);
    if (h->errors)
        part[n++] = columns_of(h->errors, RB_REPORT_ERRORS);
    if (h->deviations)
        part[n++] = columns_of(h->deviations, RB_REPORT_DEVIATIONS);
    return n;
}

rb_status rb_report_history(FILE *out, const rb_rolling_history *h,
                            const rb_rolling_note_list *notes, const char *command,
                            const rb_report_style *style)
{
    rb_report_columns part[3];
    const int parts = parts_of(h, part);
    rb_report_cells c = rb_report_begin_columns(out, style, command, parts, part);

    rb_report_comment(
        &c, "distance in a = %.9g %s, the Hertz half-width of the largest load of the history",
        h->half_width, rb_unit_name(h->units, "mm"));
    rb_report_comment(&c, "creepage and dissipation (friction power per unit speed): means over "
                          "the step, 0 at rest; shift: so far");
    rb_report_comment(&c, "moment: int x p dx, > 0: the load acts ahead of x = 0; edges of the "
                          "contact: NaN without contact");
    const rb_status noted = rb_report_comment_notes(&c, notes);
    return noted == RB_OK ? rb_report_end_columns(&c, h->n, parts, part) : noted;
}

json_t *rb_report_json_history(const rb_rolling_history *h)
{
    rb_report_columns part[3];
    const int parts = parts_of(h, part);
    json_t *history = json_object();

    rb_report_json_columns(&history, h->n, &part[0], 0);
    rb_report_json_set(&history, "half_width", rb_report_json_number(h->half_width));
    rb_report_json_set(&history, "step", rb_report_json_number(h->step));
    rb_report_json_set(&history, "steady_from",
                       h->steady_from < 0 ? json_null() : json_integer(h->steady_from));
    rb_report_json_set(&history, "cycle_work", rb_report_json_number(h->cycle_work));
    rb_report_json_set(&history, "cycle_rows", json_integer(h->cycle_rows));
    if (h->rows.changed > 0) {
        rb_report_json_set(&history, "row_changes", rb_report_json_number(h->rows.changes));
        rb_report_json_set(&history, "row_changed", json_integer(h->rows.changed));
    }
    if (h->rows.jumped > 0) {
        rb_report_json_set(&history, "jump_row", json_integer(h->rows.jumped));
        rb_report_json_set(&history, "jump_shift", rb_report_json_number(h->rows.jump_shift));
        rb_report_json_set(&history, "jump_force", rb_report_json_number(h->rows.jump_force));
    }
    for (int k = 1; k < parts; k++) {
        json_t *object = json_object();
        rb_report_json_columns(&object, h->n, &part[k], 0);
        rb_report_json_set(&history, part[k].kind == RB_REPORT_ERRORS ? "errors" : "tolerances",
                           object);
    }
    return history;
}

json_t *rb_report_json_states(const rb_rolling_states *s)
{
    const int steps = s->steps, n = s->n;
    const size_t apart = (size_t)n;
    json_t *states = json_object();

    rb_report_json_set(&states, "motion", rb_report_json_numbers(steps, s->xi));
    rb_report_json_set(&states, "p_MPa", rb_report_json_lists(steps, n, apart, s->p, NULL, NULL));
    rb_report_json_set(&states, "q_MPa", rb_report_json_lists(steps, n, apart, s->q, NULL, NULL));
    rb_report_json_set(&states, "shift_mm",
                       rb_report_json_lists(steps, n, apart, s->lambda, NULL, NULL));
    if (rb_norm_inf((size_t)steps * apart, s->plastic) > 0.0) /* the interface yields */
        rb_report_json_set(&states, "plastic_mm",
                           rb_report_json_lists(steps, n, apart, s->plastic, NULL, NULL));
    rb_report_json_set(&states, "zone", rb_report_json_lists(steps, n, apart, NULL, s->zone, NULL));
    return states;
}

/* The relaxation time of the stress that the steps of a static history resolve least:
 * longer than half of it, and not so long that its end is all that is seen.  NAN: none. */
static double unresolved(const rb_rolling_memory *m, const rb_rolling_history *h)
{
    double most = 0.5, time = NAN;
    for (int k = 0; k < m->n; k++)
        for (int i = 1; i < h->n; i++) {
            const double of_stress = m->time[k] / (1.0 + m->ratio[k]);
            const double steps = (h->time[i] - h->time[i - 1]) / of_stress;
            if (m->ratio[k] > 0.0 && steps > most && steps < 100.0) {
                most = steps;
                time = of_stress;
            }
        }
    return time;
}

/* The last step's values with their errors or deviations; a deviation of 0 is none. */
static void write_last(FILE *out, const rb_rolling_history *h, const rb_rolling_history *beside,
                       const char *format)
{
    for (int j = 0; j < rb_rolling_history_columns.n; j++) {
        const rb_rolling_result *r = &rb_rolling_history_columns.row[j];
        if ((beside == h->errors && !r->error_bar) || !rb_rolling_has_column(r, beside))
            continue;
        const double value = rb_rolling_entry(r, h, h->n - 1);
        const double x = rb_rolling_entry(r, beside, h->n - 1);
        const char *name = rb_report_unit_name(h->units, r->unit);
        const char *unit = strcmp(name, "1") == 0 ? "" : name;
        if (!isnan(value) && !isnan(x) && (x > 0.0 || beside == h->errors))
            fprintf(out, format, r->name, value + 0.0, x, *unit ? " " : "", unit);
    }
}

void rb_report_history_summary(FILE *out, const rb_rolling_case *rc, const rb_rolling_history *h)
{
    void *before = rb_locale_begin();
    const int last = h->n - 1;
    fprintf(out, "  history   %d steps", h->n);
    if (h->step > 0.0)
        fprintf(out, " of %.5g %s, rolled %.5g a (a = %.5g %s)", h->step,
                rb_unit_name(h->units, "mm"), h->distance[last], h->half_width,
                rb_unit_name(h->units, "mm"));
    if (h->steady_from >= 0)
        fprintf(out, "; steady from step %d, %.4g a, on", h->steady_from + 1,
                h->distance[h->steady_from]);
    fputc('\n', out);
    if (h->step == 0.0 && h->friction_work[last] > 0.0) {
        fprintf(out, "  friction  %.5g %s of work", h->friction_work[last],
                rb_unit_name(h->units, "N"));
        if (h->cycle_rows > 0)
            fprintf(out, ", %.5g %s in the last cycle of %d rows", h->cycle_work,
                    rb_unit_name(h->units, "N"), h->cycle_rows);
        fputc('\n', out);
    }
    if (h->time && h->step == 0.0) {
        double time = unresolved(&rc->a.memory, h);
        if (isnan(time) && rc->elastic_b)
            time = unresolved(&rc->b.memory, h);
        if (!isnan(time))
            fprintf(out,
                    "            the stress relaxes within %.2g s of such a step: --time-step %.1g "
                    "follows it\n",
                    time, 0.2 * time);
    }
    if (h->errors) {
        fputs("  error bars at the end (estimated from coarser meshes and longer steps)\n", out);
        write_last(out, h, h->errors, "    %-16s %.8g +- %.1g%s%s\n");
    }
    if (h->deviations) {
        fputs("  standard deviations at the end from those of --tolerance, to first order\n", out);
        write_last(out, h, h->deviations, "    %-16s %.6g +- %.2g%s%s\n");
    }
    rb_locale_end(before);
}
