#include "report/fem_internal.h"

#include <errno.h>
#include <math.h>
#include <string.h>

FILE *rb_report_fem_script(rb_report_picture_kind kind)
{
    static const char *const terminals[] = {
        "pngcairo size 1920,1080 font 'DejaVu Sans,24' linewidth 2 background '#ffffff'",
        "svg size 1280,720 font 'DejaVu Sans,18' linewidth 1.4 background '#ffffff'",
        "pdfcairo size 13.33in,7.5in font 'DejaVu Sans,20' linewidth 1.5"};
    FILE *script = tmpfile();
    if (script)
        fprintf(script,
                "set encoding utf8\nset terminal %s enhanced\nset tics out nomirror\n"
                "set border 3 linecolor rgb '#444444' linewidth 0.7\n",
                terminals[kind]);
    return script;
}

rb_status rb_report_fem_draw(FILE *script, FILE *out, rb_message *why)
{
    if (!script)
        return rb_fail(why, RB_EWRITE, "temporary file: %s", strerror(errno));
    const rb_status s = rb_report_gnuplot(script, out, why);
    fclose(script);
    return s;
}

double rb_report_fem_round(double x)
{
    const double ten = pow(10.0, floor(log10(x))), lead = x / ten * (1.0 + 1e-12);
    return (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0) * ten;
}
