/* Performance profiles (Dolan and More), drawn. */
#include "program/report/internal.h"

static void write_inputs(FILE *out, rb_report_canvas canvas, const void *view)
{
    const rb_report_profiles *p = view;

    rb_report_let_text(out, "title", "{/:Bold Performance profiles}   %d problem%s", p->problems,
                       rb_plural(p->problems));
    rb_report_let_text(out, "x_label", "τ: %s over the least of all solvers", p->measure);
    fprintf(out, "small_font = ',%.3g'\n",
            (p->solvers > 12 ? 0.8 : 1.0) * rb_report_key_font(canvas));
    rb_report_let_whole(out, "n", p->solvers);
    fputs("$table << EOD\ntau", out);
    for (int s = 0; s < p->solvers; s++)
        fprintf(out, " \"%s\"", p->solver[s]);
    fputc('\n', out);
    for (int k = 0; k < p->n; k++) {
        fprintf(out, "%.4g", p->tau[k]);
        for (int s = 0; s < p->solvers; s++)
            fprintf(out, " %.4g", p->rho[k + s * p->n]);
        fputc('\n', out);
    }
    fputs("EOD\n", out);
}

rb_status rb_report_profiles_picture(FILE *out, rb_report_canvas canvas,
                                     const rb_report_profiles *profiles, rb_message *why)
{
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, "profiles", write_inputs, profiles,
                          why);
}
