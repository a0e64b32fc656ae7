/* Performance profiles (Dolan and More), drawn. */
#include "report/internal.h"

static void write_script(FILE *out, rb_report_canvas canvas, const void *view)
{
    const rb_report_profiles *p = view;
    (void)canvas;
    fprintf(out,
            "set logscale x\nset xrange [1:1000]\nset yrange [0:1.05]\n"
            "set xlabel 'tau: %s over the least of all solvers'\n"
            "set ylabel 'share of %d problems solved'\nset key outside right\nset grid\n"
            "$profiles << EOD\n",
            p->measure, p->problems);
    for (int k = 0; k < p->n; k++) {
        fprintf(out, "%.4g", p->tau[k]);
        for (int s = 0; s < p->solvers; s++)
            fprintf(out, " %.4g", p->rho[k + s * p->n]);
        fputc('\n', out);
    }
    fputs("EOD\nplot ", out);
    for (int s = 0; s < p->solvers; s++)
        fprintf(out, "%s$profiles using 1:%d with steps lw 2 dt %d title '%s'",
                s ? ", " : "", s + 2, 1 + s / 8, p->solver[s]);
    fputc('\n', out);
}

rb_status rb_report_profiles_picture(FILE *out, rb_report_canvas canvas,
                                     const rb_report_profiles *profiles, rb_message *why)
{
    return rb_report_draw(out, canvas, RB_REPORT_CHART, write_script, profiles, why);
}
