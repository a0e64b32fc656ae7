/* A Prony series and the moduli to which it is fitted, drawn. */
#include "program/report/internal.h"

#include <gsl/gsl_statistics.h>
#include <math.h>

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *view)
{
    enum { SAMPLES = 200 };
    const rb_report_prony *p = view;
    const rb_prony_data *d = p->data;
    const rb_prony_series *s = p->series;
    double low, high, storage, loss;

    gsl_stats_minmax(&low, &high, d->omega, 1, (size_t)d->n);
    rb_report_let_text(out, "title", "{/:Bold Prony series}   %d term%s, deviation %.2g %% (rms)",
                       s->terms, rb_plural(s->terms), 100.0 * s->rms);
    rb_report_let_text(out, "y_label", "storage and loss modulus  [%s]",
                       rb_unit_name(p->units, "MPa"));
    fprintf(out, "key_font = ',%.3g'\n", rb_report_key_font(canvas));
    fputs("$table << EOD\nomega storage loss\n", out);
    for (int i = 0; i < d->n; i++)
        fprintf(out, "%.6g %.6g %.6g\n", d->omega[i], rb_unit_shown(p->units, "MPa", d->storage[i]),
                rb_unit_shown(p->units, "MPa", d->loss[i]));
    fputs("EOD\n$fitted << EOD\nomega storage loss\n", out);
    for (int k = 0; k <= SAMPLES; k++) {
        const double omega = low * pow(high / low, (double)k / SAMPLES);
        rb_prony_moduli(s, omega, &storage, &loss);
        fprintf(out, "%.6g %.6g %.6g\n", omega, rb_unit_shown(p->units, "MPa", storage),
                rb_unit_shown(p->units, "MPa", loss));
    }
    fputs("EOD\n", out);
}

rb_status rb_report_prony_picture(FILE *out, rb_report_canvas canvas, const rb_report_prony *p,
                                  rb_message *why)
{
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "prony", write_inputs, p, why);
}
