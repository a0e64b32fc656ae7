/* Picture of what the last cycle of a history does to the surfaces: work of friction, Ruiz's second
 * parameter and SWT over x, of A and of an elastic B. */
#include "program/report/internal.h"

#include <math.h>

enum { PANELS = 3 };

typedef struct {
    const rb_rolling_case *rc;
    const rb_rolling_solution *s;
    rb_report_length length; /* of one unit of the x axis */
    const double *a[PANELS]; /* of the friction, which is that of both, and of A */
    const double *b[PANELS]; /* of B; NULL: there is none, or it is that of A */
    double from, to;         /* in those units */
} view;

static rb_status write_table(FILE *out, const void *of, const rb_report_style *style)
{
    return rb_report_table(out, NULL, of, NULL, "", style);
}

static int is_shown(const view *v, int i)
{
    const double x = v->s->x[i] / v->length.size;
    return x >= v->from && x <= v->to;
}

static void let_panel(FILE *out, const view *v, int k)
{
    static const char *const label[] = {"work  [%s]", "Ruiz 2  [%s]", "SWT  [%s]"},
                             *const unit[] = {"N/mm", "MPa.N/mm", "MPa"},
                             *const colour[] = {"#1f4e79", "#c0392b", "#6c3483"};
    char name[20], text[80], raised[40];
    double most = 0.0;

    for (int i = 0; i < v->s->n; i++)
        if (is_shown(v, i))
            most = fmax(most, fmax(v->a[k][i], v->b[k] ? v->b[k][i] : 0.0));
    most = most > 0.0 ? most : 1.0;
    const struct {
        const char *name;
        double x;
    } range[] = {
        {"from%d", 0.0}, {"to%d", 1.08 * most}, {"step%d", rb_report_round_step(most / 5.0)}};
    for (size_t j = 0; j < sizeof range / sizeof *range; j++) {
        rb_format(name, sizeof name, range[j].name, k + 1);
        rb_report_let(out, name, range[j].x);
    }
    rb_format(name, sizeof name, "label%d", k + 1);
    rb_format(text, sizeof text, label[k],
              rb_report_raised(rb_unit_name(v->s->units, unit[k]), raised));
    rb_report_let_text(out, name, "%s", text);
    rb_format(name, sizeof name, "colour%d", k + 1);
    rb_report_let_text(out, name, "%s", colour[k]);
    rb_format(name, sizeof name, "band%d", k + 1);
    rb_report_let_whole(out, name, v->b[k] ? 3 : 0);
}

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *context)
{
    const view *v = context;
    const rb_rolling_solution *s = v->s;
    const char *unit = rb_unit_name(s->units, "N/mm");

    (void)canvas;
    rb_report_let_table(out, "table", write_table, s);
    rb_report_let_units(out, s->units);
    fputs("$drawn << EOD\nx work ruiz_2 swt none ruiz_2_b swt_b\n", out);
    for (int i = 0; i < s->n; i++) {
        if (!is_shown(v, i))
            continue;
        fprintf(out, "%.9g", s->x[i] / v->length.size);
        for (int k = 0; k < PANELS; k++)
            fprintf(out, " %.9g", v->a[k][i]);
        for (int k = 0; k < PANELS; k++)
            fprintf(out, " %.9g", v->b[k] ? v->b[k][i] : 0.0);
        fputc('\n', out);
    }
    fputs("EOD\n", out);
    rb_report_let(out, "x_from", v->from);
    rb_report_let(out, "x_to", v->to);
    rb_report_let(out, "x_step", 0.0);
    rb_report_let_whole(out, "few", 0);
    rb_report_let_text(out, "title",
                       "{/:Bold Last cycle}   P = %s %s,  Q = %s %s at its end,  work %s %s",
                       RB_REPORT_NUMBER(s->normal_load, 5), unit,
                       RB_REPORT_NUMBER(rb_report_tidy(s->tangential_load, s->normal_load), 5),
                       unit, RB_REPORT_NUMBER(s->fretting.work, 4), rb_unit_name(s->units, "N"));
    rb_report_let_bodies(out, v->rc, s->units);
    for (int k = 0; k < PANELS; k++)
        let_panel(out, v, k);
    rb_report_let_text(out, "x_label", "x %s", v->length.label);
}

rb_status rb_report_fretting_picture(FILE *out, rb_report_canvas canvas, const rb_rolling_case *rc,
                                     const rb_rolling_solution *s, rb_message *why)
{
    if (isnan(s->fretting.work) || s->n < 1)
        return rb_fail(why, RB_EINVAL, "no cycle to draw");
    view v = {.rc = rc,
              .s = s,
              .length = rb_report_length_axis(s->units, s->half_width),
              .a = {s->fretting_work, s->ruiz_2, s->swt},
              .b = {NULL, s->ruiz_2_b, s->swt_b}};
    double from = s->x[0], to = s->x[s->n - 1];
    if (s->contact > 0) {
        const double margin = 0.15 * (s->contact_to - s->contact_from);
        from = fmax(from, s->contact_from - margin);
        to = fmin(to, s->contact_to + margin);
    }
    v.from = from / v.length.size;
    v.to = to / v.length.size;
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "history", write_inputs, &v, why);
}
