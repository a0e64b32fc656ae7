/* Performance profiles (Dolan and More), drawn. */
#include "program/report/internal.h"

static void write_script(FILE *out, rb_report_canvas canvas, const void *view)
{
    const rb_report_profiles *p = view;
    const rb_report_place place = rb_report_place_of(canvas);
    if (place.titled)
        fprintf(out,
                "set label 1 '{/:Bold Performance profiles}   %d problem%s' at screen "
                "0.5, 0.955 center\n",
                p->problems, p->problems == 1 ? "" : "s");
    fprintf(out,
            RB_REPORT_GRID "set logscale x\nset xrange [1:1000]\nset yrange [0:1.05]\n"
                           "set tmargin at screen %g\n"
                           "set xlabel 'τ: %s over the least of all solvers'\n"
                           "set ylabel 'share of problems solved' offset 1,0\n"
                           "set key outside right samplen 2 font ',%.3g'\n$profiles << EOD\n",
            0.9 + place.up, p->measure, (p->solvers > 12 ? 0.8 : 1.0) * rb_report_key_font(canvas));
    for (int k = 0; k < p->n; k++) {
        fprintf(out, "%.4g", p->tau[k]);
        for (int s = 0; s < p->solvers; s++)
            fprintf(out, " %.4g", p->rho[k + s * p->n]);
        fputc('\n', out);
    }
    fputs("EOD\nplot ", out);
    for (int s = 0; s < p->solvers; s++)
        fprintf(out,
                "%s$profiles using 1:%d with steps linecolor rgb '%s' dashtype %s "
                "linewidth 1.8 title '%s'",
                s ? ", " : "", s + 2, rb_report_colour(s), rb_report_dashes(s), p->solver[s]);
    fputc('\n', out);
}

rb_status rb_report_profiles_picture(FILE *out, rb_report_canvas canvas,
                                     const rb_report_profiles *profiles, rb_message *why)
{
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, NULL, write_script, profiles, why);
}
